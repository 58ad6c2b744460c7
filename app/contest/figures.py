"""The figures of a student's paper: each is drawn once and written as PDF, SVG and PNG."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from itertools import zip_longest
from typing import Any

import matplotlib
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Circle
from matplotlib.patheffects import withStroke

import core
from app.contest.sensitivity import Panel, panels
from app.contest.solved import Solved
from app.files.drawing import canvas, file_bytes, in_turn
from app.files.fonts import families
from core import Dance, bench_outlines
from core.design.pitch_scan import JUMP_WIDTH, scan_near_minimum
from core.language import say
from core.plots import BLUE, GREY, PALE, VERMILION, draw_dance
from core.values import Progress

FORMATS = ("pdf", "svg", "png")
PNG_DPI = 160
# Colours of the handles shown: safe for colour-blind readers and different in brightness (Okabe and Ito).
COLOURS = ("#D55E00", "#0072B2", "#009E73", "#CC79A7", "#56B4E9", "#E69F00", "#000000")
# Number of instants of a curve over time.
CURVE = 400
# The clearance is drawn over this last part of the way to first contact [1].
CLEARANCE_FROM = 0.72
# Text beside a point, by an offset in points; a white edge keeps it readable on a line.
BESIDE: dict[str, Any] = {
    "textcoords": "offset points",
    "path_effects": [withStroke(linewidth=3.0, foreground="white")],
}
# Number of pitches of the staircase.
STAIRS = 60

# A figure with its caption.
Captioned = tuple[Figure, str]


@dataclass(frozen=True)
class Drawn:
    """name: of the files; caption: of the figure in the report; files: bytes by format"""

    name: str
    caption: str
    files: dict[str, bytes]


def figures(solved: Solved, progress: Progress, names: Sequence[str] | None = None) -> Iterator[Drawn]:
    """Every figure, or those of these names, in turn. raises: MissingPackage without a font for the language"""
    family = families()
    of_turn = (geometry, amplification) if solved.turned else ()
    every = (positions, snapshots, clearance, staircase, *of_turn, sensitivity)
    kinds = [draw for draw in every if names is None or draw.__name__ in names]
    for k, draw in enumerate(kinds, start=1):
        drawn = in_turn(partial(_drawn, draw, solved, family), solved.budget)
        progress(k / len(kinds))
        yield drawn


def _drawn(draw: Callable[[Solved], Captioned], solved: Solved, family: Sequence[str]) -> Drawn:
    with matplotlib.rc_context({"font.family": family}):
        figure, caption = draw(solved)
        # The layout is the same for all three files, and takes as long as writing one. With the engine "none", a
        # placeholder, savefig would still draw twice.
        figure.draw_without_rendering()
        figure.set_layout_engine(None)
        return Drawn(draw.__name__, caption, {kind: file_bytes(figure, kind, PNG_DPI) for kind in FORMATS})


def positions(solved: Solved) -> Captioned:
    """Question 1: place of every handle at the last second, and the speeds of some handles over time."""
    figure, stop = canvas(11.5, 4.8), solved.stop
    places, rates = figure.subplots(1, 2, width_ratios=(1.15, 1.0))
    figure.set_layout_engine("constrained", wspace=0.06)
    handles = solved.inwards.position[-1]
    draw_dance(places, solved.spiral.path, handles, bench_outlines(solved.dragon, handles), linewidth=0.3)
    dots = places.scatter(*handles.T, c=solved.inwards.speed[-1], s=11, cmap="cividis", zorder=3, linewidths=0)
    bar = figure.colorbar(dots, ax=places, label=say("speed of the handle [m/s]"), shrink=0.85)
    bar.ax.ticklabel_format(useOffset=False)
    ring: dict[str, Any] = {"markersize": 9, "markerfacecolor": "none", "markeredgecolor": VERMILION}
    places.plot(*handles[0], "o", label=say("head"), **ring)
    places.legend(loc="upper right", fontsize=8)
    places.set_title(say("Handles at {stop:g} s", stop=stop), fontsize=10)
    names = solved.names
    for k, colour in zip(solved.handles, COLOURS, strict=False):
        rates.plot(solved.inwards.time, solved.inwards.speed[:, k], color=colour, linewidth=1.3, label=names[k])
    rates.set(xlabel=say("time [s]"), ylabel=say("speed [m/s]"))
    rates.ticklabel_format(useOffset=False)
    rates.legend(fontsize=8, loc="lower left")
    rates.set_title(say("Speeds of the handles that the paper shows"), fontsize=10)
    caption = say(
        "Positions of all handles at {stop:g} s, coloured by speed (left), and speeds over time (right).",
        stop=stop,
    )
    return figure, caption


def snapshots(solved: Solved) -> Captioned:
    """Questions 1 and 2: the dance at its start, half way, at the last second and at first contact."""
    stop = solved.stop
    times = [0.0, 0.5 * stop, stop, solved.met_at]
    figure = canvas(9.0, 9.0)
    motion = core.trajectory(solved.spiral, times)
    extent = 1.22 * float(np.abs(motion.position).max())
    view = (-extent, extent)
    pair = solved.contact.benches or ()
    for axes, time, handles in zip(figure.subplots(2, 2).flat, times, motion.position, strict=True):
        outlines = bench_outlines(solved.dragon, handles)
        draw_dance(axes, solved.spiral.path, handles, outlines, linewidth=0.4)
        axes.fill(*outlines[0].T, color=VERMILION, zorder=4, label=say("head"))
        title = f"{time:g} s"
        if time == solved.met_at and pair:
            for k in filter(None, pair):  # Bench 0 is the head.
                axes.fill(*outlines[k].T, color=BLUE, zorder=4, label=say("bench {k}", k=k))
            title = say("First contact, {time:.6f} s", time=time)
        axes.set(xlim=view, ylim=view)
        axes.set_title(title, fontsize=10)
        axes.legend(loc="upper right", fontsize=8)
    return figure, say("Every bench at four instants.")


def clearance(solved: Solved) -> Captioned:
    """Question 2: the smallest distance between two benches over time, with its local minima."""
    figure = canvas(8.0, 4.6)
    axes = figure.subplots()
    profile = core.clearance_profile(solved.spiral, np.linspace(CLEARANCE_FROM * solved.met_at, solved.met_at, CURVE))
    grazes = [(graze.time, 1e3 * graze.clearance) for graze in profile.grazes]
    time = np.concatenate([profile.time, [t for t, _ in grazes]])
    gap = np.concatenate([1e3 * profile.clearance, [g for _, g in grazes]])
    order = np.argsort(time)
    axes.plot(time[order], gap[order], color=BLUE, linewidth=1.2, label=say("smallest clearance"))
    if grazes:
        label = say("graze (local minimum)")
        axes.plot(*np.transpose(grazes), "o", color=VERMILION, markersize=4, label=label)
    axes.axhline(0.0, color="black", linewidth=0.8, linestyle="dashed", label=say("touch"))
    axes.set(xlabel=say("time [s]"), ylabel=say("clearance of the nearest pair [mm]"))
    axes.legend(fontsize=8)
    until = say("first contact") if solved.contact.time is not None else say("the end of the run")
    caption = say(
        "Clearance over time up to {until}, with its grazes; some are only fractions of a millimetre deep.", until=until
    )
    if near := solved.contact.certificate.least_clearance:
        caption += say(
            " The closest graze before it leaves {gap:.3f} mm at {near.time:.3f} s.",
            gap=1000.0 * near.clearance,
            near=near,
        )
    return figure, caption


def staircase(solved: Solved) -> Captioned:
    """Question 3: radius of the head at first contact, against the pitch."""
    figure, radius, least = canvas(8.0, 4.8), solved.request.turning_radius, solved.pitch.pitch
    scan, _ = scan_near_minimum(
        solved.dragon,
        samples=STAIRS,
        turning_radius=radius,
        start_turns=solved.request.start_turns,
        margin=0.0,
        budget=solved.budget,
    )
    axes = figure.subplots()
    _stairs(axes, scan, radius, least)
    axes.set(xlabel=say("pitch [m]"), ylabel=say("radius of the head at first contact [m]"))
    axes.set_ylim(0.0, 1.25 * float(scan.radius.max(initial=radius)))
    axes.legend(loc="lower left", fontsize=8)
    near = axes.inset_axes((0.56, 0.60, 0.41, 0.36))
    _stairs(near, scan, radius, least)
    near.set(xlim=(0.995 * least, 1.005 * least), ylim=(0.94 * radius, 1.05 * radius))
    near.tick_params(labelsize=7)
    axes.indicate_inset_zoom(near, edgecolor="black", linewidth=0.7)
    over = solved.pitch.limited_by.value == "graze"
    jump = say(", and jumps over the circle at the minimum pitch") if over else ""
    falls = say("The head's radius at first contact falls in jumps")
    return figure, falls + say(" as the pitch grows{jump}.", jump=jump)


def _stairs(axes: Axes, scan: core.PitchScan, radius: float, least: float) -> None:
    for k, (a, b) in enumerate(scan.pieces):
        label = say("first contact") if k == 0 else None
        axes.plot(scan.pitch[a:b], scan.radius[a:b], color=BLUE, linewidth=1.6, label=label)
    for a, _ in scan.pieces[1:]:
        if scan.pitch[a] - scan.pitch[a - 1] <= JUMP_WIDTH:
            fall = slice(a - 1, a + 1)
            axes.plot(scan.pitch[fall], scan.radius[fall], color=GREY, linewidth=0.8, linestyle="dotted")
    label = say("turning circle, {radius:g} m", radius=radius)
    axes.axhline(radius, color="black", linewidth=0.9, linestyle="dashed", label=label)
    label = say("minimum pitch, {least:.9f} m", least=least)
    axes.axvline(least, color=VERMILION, linewidth=1.1, linestyle="dashdot", label=label)


def geometry(solved: Solved) -> Captioned:
    """Question 4: the two arcs between the coils, with their centres and radii."""
    assert solved.turned
    turn, figure = solved.turned.path, canvas(7.0, 6.6)
    axes, radius = figure.subplots(), turn.turning_radius
    axes.set_aspect("equal")
    axes.set(xlabel="x [m]", ylabel="y [m]")
    for s0, s1, colour, label in _stretches(turn):
        axes.plot(*turn.position(np.linspace(s0, s1, CURVE)).T, color=colour, linewidth=2.0, label=label)
    axes.add_patch(Circle((0.0, 0.0), radius, fill=False, linestyle="dashed", color=GREY, linewidth=1.0))
    for k, (centre, size) in enumerate(zip(turn.centres, turn.radii, strict=True), start=1):
        axes.add_patch(Circle(centre, size, fill=False, color=PALE, linewidth=1.0))
        end = turn.entry if k == 1 else turn.exit
        axes.plot(*np.transpose([centre, end]), color=GREY, linewidth=0.9, linestyle="dotted")
        axes.plot(*centre, "k+", markersize=9)
        axes.annotate(f"$C_{k}$, {size:.4f} m", centre, (8, -12), fontsize=9, **BESIDE)
    names = say("entry"), say("joint"), say("exit")
    for point, name in zip((turn.entry, turn.tangent_point, turn.exit), names, strict=True):
        axes.plot(*point, "ko", markersize=5, zorder=6)
        axes.annotate(name, point, (8, 8), fontsize=10, zorder=7, **BESIDE)
    axes.set(xlim=(-1.6 * radius, 1.6 * radius), ylim=(-1.5 * radius, 1.5 * radius))
    axes.legend(loc="upper left", fontsize=8, framealpha=1.0)
    caption = say(
        "The turn: two tangent arcs inside the circle of {diameter:g} m, {turn.length:.7f} m long at every ratio.",
        diameter=2 * radius,
        turn=turn,
    )
    return figure, caption


def _stretches(turn: core.Turn) -> list[tuple[float, float, str, str]]:
    """Beginning and end [m], colour and name of each drawn piece."""
    middle, reach = turn.radii[0] * turn.angles[0], 8.0 * (2.2 * turn.turning_radius)
    return [
        (max(turn.begin, -reach), 0.0, BLUE, say("coil inwards")),
        (0.0, middle, VERMILION, say("first arc")),
        (middle, turn.length, "#E69F00", say("second arc")),
        (turn.length, min(turn.end, turn.length + reach), "#009E73", say("coil outwards")),
    ]


def amplification(solved: Solved) -> Captioned:
    """Question 5: speeds of handles on the way through the turn, divided by that of the head."""
    assert solved.turned
    figure, turn, fastest = canvas(8.0, 4.6), solved.turned.path, solved.turned.fastest
    axes = figure.subplots()
    peak = fastest.time_at_unit_head_speed
    travel = np.unique(np.concatenate([np.linspace(-5.0, peak + 40.0, 2 * CURVE), [peak]]))
    rates = core.trajectory(Dance(solved.dragon, turn), travel).speed
    names = solved.names
    for k, colour in zip((1, 2, 3, 8, 20), COLOURS[1:], strict=False):
        if k <= solved.dragon.benches:
            # Handles near the head are drawn on top: the handles behind repeat their motion later.
            axes.plot(travel, rates[:, k], color=colour, linewidth=1.0, label=names[k], zorder=2.0 + 1.0 / k)
    label = say("fastest handle")
    axes.plot(travel, rates.max(axis=1), color="black", linewidth=1.8, linestyle="dashed", label=label)
    axes.plot(peak, fastest.speed_ratio, "o", color=VERMILION, markersize=7, label=f"{fastest.speed_ratio:.6f}")
    axes.axvspan(0.0, turn.length, color=PALE, alpha=0.5, label=say("head on the arcs"))
    axes.set(xlabel=say("place of the head after the entry [m]"), ylabel=say("speed divided by the head's speed"))
    axes.legend(fontsize=8, loc="upper right")
    caption = say(
        "Speed amplification in the turn: at most {fastest.speed_ratio:.6f}, so a limit of "
        "{solved.request.speed_limit:g} m/s allows a head speed of {fastest.head_speed:.6f} m/s.",
        fastest=fastest,
        solved=solved,
    )
    return figure, caption


def sensitivity(solved: Solved) -> Captioned:
    """Change of the answers with the numbers of the problem."""
    drawn = panels(solved)
    columns = (len(drawn) + 1) // 2
    figure = canvas(4.5 * columns, 7.0)
    for axes, panel in zip_longest(figure.subplots(2, columns).flat, drawn):
        if panel:
            _draw_panel(axes, panel)
        else:
            axes.set_axis_off()
    caption = say(
        "Sensitivity: minimum pitch against width, turning diameter and length of the bodies; "
        "first contact against width and length; maximum head speed against the ratio of the arcs. "
        "Small dots are samples, joined only if the answer has no jumps; large dots are the values "
        "of the problem.",
    )
    return figure, caption


def _draw_panel(axes: Axes, panel: Panel) -> None:
    x, y = np.array(panel.points, dtype=np.float64).T if panel.points else np.empty((2, 0))
    axes.plot(x, y, color=BLUE, linewidth=1.2 if panel.smooth else 0.0, marker=".", markersize=4)
    axes.ticklabel_format(useOffset=False)
    axes.plot(*panel.own, "o", color=VERMILION, markersize=7)
    axes.set(xlabel=panel.varied, ylabel=panel.answer)
    axes.grid(color=PALE, linewidth=0.6)
    axes.tick_params(labelsize=8)
