"""The paper's figures 6, 7 and 8 from live numbers, as SVG or PNG bytes.

The same numbers give the same bytes, so an answer may carry a strong ETag.
"""

from __future__ import annotations

from collections.abc import Callable

import matplotlib
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from app.files.drawing import canvas, draw_venue, file_bytes, in_turn, look_around
from app.files.fonts import families
from core import Budget, Dragon, MinimumPitch, Venue, first_contact, trajectory
from core.dance import Dance
from core.design.pitch_scan import JUMP_WIDTH, SCAN_FROM, SCAN_TO, PitchScan
from core.language import say
from core.plots import GREY, VERMILION, draw_scan
from core.quantities import format_number
from core.questions import question_about


def figure_file(draw: Callable[[], Figure], format: str, budget: Budget | None = None) -> bytes:
    """The file of a figure. raises: MissingPackage without a font; Halted once the budget is stopped"""
    family = families()

    def drawn() -> bytes:
        with matplotlib.rc_context({"font.family": family}):
            return file_bytes(draw(), format)

    return in_turn(drawn, budget)


@question_about("dance", Dance, "the figure was not drawn")
def trajectory_figure(
    dance: Dance,
    *,
    venue: Venue | None = None,
    time: float = 300.0,
    format: str = "svg",
    budget: Budget | None = None,
) -> bytes:
    """Figure 6: every handle at one instant, coloured by its speed, on any path and in any venue.

    time: [s]; raises: OutsideRun after the end of the run
    """
    result = trajectory(dance, [time], budget=budget)

    def drawn() -> Figure:
        figure = canvas(7.2, 6.2)
        axes = result.plot(figure.add_subplot())
        if venue:
            draw_venue(axes, venue, [result.position[0]])
            look_around(figure, axes, result.position[0])
        if spiral := dance.path.spiral:
            pitch = format_number(spiral.pitch)
            title = say("Handles and their speeds at {time:g} s (pitch {pitch} m)", time=time, pitch=pitch)
            axes.set_title(title, fontsize=11)
        return figure

    return figure_file(drawn, format, budget)


@question_about("dance", Dance, "the figure was not drawn")
def contact_figure(
    dance: Dance,
    *,
    venue: Venue | None = None,
    margin: float = 0.0,
    start: float | None = None,
    stop: float | None = None,
    format: str = "svg",
    budget: Budget | None = None,
) -> bytes:
    """Figure 7: the dance at first contact with the two benches marked, and corner, edge and point enlarged.

    Without a contact it shows the dance just before the run ends, and the title says so.
    """
    contact = first_contact(dance, margin=margin, start=start, stop=stop, budget=budget)

    def drawn() -> Figure:
        figure = canvas(11.0 if contact.benches else 7.2, 6.0)
        axes = contact.plot(figure.add_subplot(1, 2, 1) if contact.benches else figure.add_subplot())
        draw_venue(axes, venue)
        if contact.benches:
            enlarged = contact.plot(figure.add_subplot(1, 2, 2), enlarged=True)
            axes.indicate_inset_zoom(enlarged, edgecolor="black", linewidth=0.8)
        return figure

    return figure_file(drawn, format, budget)


@question_about("dragon", Dragon, "the figure was not drawn")
def pitch_scan_figure(
    dragon: Dragon,
    scanned: tuple[PitchScan, MinimumPitch],
    *,
    turning_radius: float = 4.5,
    start_turns: float = 16.0,
    margin: float = 0.0,
    format: str = "svg",
    budget: Budget | None = None,
) -> bytes:
    """Figure 8: radius of the head at first contact against the pitch, jumps left blank, minimum pitch marked.

    scanned: the result of scan_near_minimum(); the rest: its arguments
    raises: TooMuchWork once the budget is stopped
    """
    scan, least = scanned
    pitches = np.array([SCAN_FROM, SCAN_TO]) * least.pitch

    def drawn() -> Figure:
        figure = canvas(9.0, 5.6)
        axes = figure.add_subplot()
        near_words = say("first contact")
        radius, title = say("radius of the head at first contact [m]"), say("No contact at any of these pitches")
        if margin:
            kept = format_number(margin)
            near_words = say("first within {margin} m of each other", margin=kept)
            radius = say(
                "radius of the head when two benches are first within {margin} m of each other [m]", margin=kept
            )
            title = say("Never within {margin} m at any of these pitches", margin=kept)
        if scan.pitch.size and margin:
            title = say(
                "Radius of the head when two benches are first within {margin} m of each other, against the pitch",
                margin=kept,
            )
        elif scan.pitch.size:
            title = say("Radius of the head at first contact, against the pitch")
        _draw_scan(axes, scan, least, turning_radius, near_words)
        axes.plot(pitches, start_turns * pitches, color=GREY, linewidth=0.9, zorder=1, label=say("start of the dance"))
        axes.set(xlim=(pitches[0], pitches[-1]), xlabel=say("pitch [m]"), ylabel=radius)
        axes.set_ylim(0.0, 1.2 * scan.radius.max(initial=turning_radius))
        axes.legend(loc="lower left", fontsize=9)
        axes.set_title(title, fontsize=11)
        near = axes.inset_axes((0.56, 0.64, 0.41, 0.33))
        _draw_scan(near, scan, least, turning_radius, near_words)
        near.set(xlim=(0.995 * least.pitch, 1.005 * least.pitch))
        near.set(ylim=(0.94 * turning_radius, 1.05 * turning_radius))
        near.tick_params(labelsize=8)
        axes.indicate_inset_zoom(near, edgecolor="black", linewidth=0.7)
        return figure

    return figure_file(drawn, format, budget)


def _draw_scan(axes: Axes, scan: PitchScan, least: MinimumPitch, turning_radius: float, near: str) -> None:
    draw_scan(axes, np.stack([scan.pitch, scan.radius], axis=-1), scan.pieces, JUMP_WIDTH, near)
    circle = say("turning circle, {radius} m", radius=format_number(turning_radius))
    axes.axhline(turning_radius, color="black", linewidth=0.9, linestyle="dashed", label=circle)
    pitch = say("minimum pitch, {pitch:.9f} m", pitch=least.pitch)
    axes.axvline(least.pitch, color=VERMILION, linewidth=1.2, linestyle="dashdot", label=pitch)
