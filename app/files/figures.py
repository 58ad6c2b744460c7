"""The paper's figures 6, 7 and 8 from live numbers, as SVG or PNG bytes.

The same numbers give the same bytes, so an answer may carry a strong ETag.
"""

from __future__ import annotations

import threading
from collections.abc import Callable

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection

from app.files.drawing import (
    BLUE,
    GREY,
    SHAPES_MAX,
    VERMILION,
    bench_outlines,
    canvas,
    draw_dance,
    draw_enlarged,
    file_bytes,
    look_around,
    mark_head,
    mark_pair,
)
from core import (
    Dragon,
    EndReason,
    FirstContact,
    MinimumPitch,
    Outcome,
    Route,
    Spiral,
    Venue,
    first_contact,
    trajectory,
)
from core.dance import Dance
from core.design.pitch_scan import JUMP_WIDTH, SCAN_FROM, SCAN_TO, PitchScan, scan_near_minimum
from core.errors import said

# The figure of a run without contact shows the dance this long before its end [s], where the chain still exists.
BEFORE_END = 1e-6
# One drawing at a time: matplotlib does not promise that its font caches bear more.
_DRAWING = threading.Lock()


def trajectory_figure(
    dance: Dance,
    *,
    venue: Venue | None = None,
    time: float = 300.0,
    format: str = "svg",
) -> bytes:
    """Figure 6: every handle at one instant, coloured by its speed; on any path, in any venue.

    time: [s]; raises: OutsideRun after the end of the run
    """
    result = trajectory(dance, [time])
    handles, speed = result.position[0], result.speed[0]
    with _DRAWING:
        figure = canvas(7.2, 6.2)
        axes = figure.add_subplot()
        draw_dance(axes, dance.path, venue, handles, bench_outlines(dance.dragon, handles), linewidth=0.4)
        dots = axes.scatter(
            handles[:, 0],
            handles[:, 1],
            c=speed,
            s=16,
            cmap="cividis",
            zorder=3,
            linewidths=0,
            rasterized=len(handles) > SHAPES_MAX,
        )
        mark_head(axes, handles[0], result.velocity[0, 0])
        bar = figure.colorbar(dots, ax=axes, label="speed of the handle [m/s]", shrink=0.85)
        bar.ax.ticklabel_format(useOffset=False)
        if venue:
            look_around(figure, axes, handles)
        axes.set_title(f"Handles and their speeds at {time:g} s{_pitch_words(dance.path)}", fontsize=11)
        return file_bytes(figure, format)


def _pitch_words(path: Spiral | Route) -> str:
    return f" (pitch {said(path.pitch)} m)" if isinstance(path, Spiral) else ""


def contact_figure(
    dance: Dance,
    *,
    venue: Venue | None = None,
    margin: float = 0.0,
    start: float = 0.0,
    stop: float | None = None,
    format: str = "svg",
) -> bytes:
    """Figure 7: the dance at first contact, the two benches marked, corner, edge and point enlarged.

    Without a contact it shows the dance just before the run ends, and says so.
    """
    found = first_contact(dance, margin=margin, start=start, stop=stop)
    time = _shown_time(dance, found)
    handles = trajectory(dance, [time]).position[0]
    outlines = bench_outlines(dance.dragon, handles)
    with _DRAWING:
        figure = canvas(11.0 if found.benches else 7.2, 6.0)
        axes = figure.add_subplot(1, 2, 1) if found.benches else figure.add_subplot()
        draw_dance(axes, dance.path, venue, handles, outlines, linewidth=0.5)
        mark_pair(axes, outlines, found, legend=True)
        axes.autoscale_view()
        axes.set_title(_contact_title(found, margin), fontsize=11)
        if found.benches:
            enlarged = figure.add_subplot(1, 2, 2)
            draw_enlarged(enlarged, outlines, found, float(dance.dragon.widths[list(found.benches)].max()), margin)
            axes.indicate_inset_zoom(enlarged, edgecolor="black", linewidth=0.8)
        return file_bytes(figure, format)


def _shown_time(dance: Dance, found: FirstContact) -> float:
    if found.time is not None:
        return found.time
    if found.time_bracket is not None:
        return found.time_bracket[0]
    end = found.end or dance.end
    return end.time - BEFORE_END


def _contact_title(found: FirstContact, margin: float) -> str:
    what = f"First nearer than {said(margin)} m" if margin else "First contact"
    if found.outcome is Outcome.CONTACT:
        assert found.head is not None
        return f"{what}: {found.time:.6f} s, head at radius {found.head.radius:.6f} m"
    if found.outcome is Outcome.CONTACT_AT_START:
        return f"Nearer than {said(margin)} m from the start on" if margin else f"{what}: already at the start"
    if found.outcome is Outcome.CLEAR and found.end is not None:
        none = f"Never nearer than {said(margin)} m" if margin else "No contact"
        if found.end.reason is EndReason.FOLD:
            return f"{none}, but bench {found.end.bench} folds at {found.end.time:.6f} s"
        return f"{none}: the run ends clear at the {found.end.reason.value}, {found.end.time:.6f} s"
    return f"Undecided: clear up to {_shown_bracket(found)} s"


def _shown_bracket(found: FirstContact) -> str:
    return f"{found.time_bracket[0]:.6f}" if found.time_bracket else "an unknown time"


def pitch_scan_figure(
    dragon: Dragon,
    *,
    turning_radius: float = 4.5,
    start_turns: float = 16.0,
    margin: float = 0.0,
    samples: int = 101,
    format: str = "svg",
    progress: Callable[[float], None] = lambda share: None,
) -> bytes:
    """Figure 8: where the head stands at first contact against the pitch, its jumps as jumps, the minimum pitch marked.

    samples: pitches from SCAN_FROM to SCAN_TO times the minimum pitch; jumps between them are searched for
    """
    scan, least = scan_near_minimum(
        dragon,
        turning_radius=turning_radius,
        start_turns=start_turns,
        margin=margin,
        samples=samples,
        progress=progress,
    )
    pitches = np.array([SCAN_FROM, SCAN_TO]) * least.pitch
    with _DRAWING:
        figure = canvas(9.0, 5.6)
        axes = figure.add_subplot()
        near_words = f"first nearer than {said(margin)} m" if margin else "first contact"
        when = f"when two benches are {near_words}" if margin else f"at {near_words}"
        _draw_scan(axes, scan, least, turning_radius, near_words)
        axes.plot(pitches, start_turns * pitches, color=GREY, linewidth=0.9, zorder=1, label="start of the dance")
        axes.set(xlim=(pitches[0], pitches[-1]), xlabel="pitch [m]", ylabel=f"radius of the head {when} [m]")
        axes.set_ylim(0.0, 1.2 * scan.radius.max(initial=turning_radius))
        axes.legend(loc="lower left", fontsize=9)
        none = f"Never nearer than {said(margin)} m at any" if margin else "No contact at any"
        title = f"Where the head stands {when}, against the pitch" if scan.pitch.size else f"{none} of these pitches"
        axes.set_title(title, fontsize=11)
        near = axes.inset_axes((0.56, 0.64, 0.41, 0.33))
        _draw_scan(near, scan, least, turning_radius, near_words)
        near.set(xlim=(0.995 * least.pitch, 1.005 * least.pitch))
        near.set(ylim=(0.94 * turning_radius, 1.05 * turning_radius))
        near.tick_params(labelsize=8)
        axes.indicate_inset_zoom(near, edgecolor="black", linewidth=0.7)
        return file_bytes(figure, format)


def _draw_scan(axes: Axes, scan: PitchScan, least: MinimumPitch, turning_radius: float, near: str) -> None:
    points = np.stack([scan.pitch, scan.radius], axis=-1)
    axes.add_collection(LineCollection([points[a:b] for a, b in scan.pieces], colors=BLUE, linewidths=1.8, label=near))
    falls = [points[a - 1 : a + 1] for a, _ in scan.pieces[1:] if scan.pitch[a] - scan.pitch[a - 1] <= JUMP_WIDTH]
    axes.add_collection(LineCollection(falls, colors=GREY, linewidths=0.8, linestyles="dotted", label="jump"))
    circle = f"turning circle, {said(turning_radius)} m"
    axes.axhline(turning_radius, color="black", linewidth=0.9, linestyle="dashed", label=circle)
    axes.axvline(
        least.pitch, color=VERMILION, linewidth=1.2, linestyle="dashdot", label=f"minimum pitch, {least.pitch:.9f} m"
    )
