"""The paper's figures 6, 7 and 8 from live numbers, as SVG or PNG bytes.

matplotlib's objects only, no pyplot: nothing global but the constants set below, so threads may draw.
The same numbers give the same bytes, so an answer may carry a strong ETag. Colours are safe for colour-blind
readers (cividis; Okabe and Ito's set) and differ in brightness, hatch or line style for print.
"""

from __future__ import annotations

import io
import threading
from collections.abc import Callable
from enum import StrEnum
from typing import Any

import matplotlib
import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.figure import Figure

from core import (
    Dragon,
    FirstContact,
    MinimumPitch,
    Outcome,
    Route,
    Spiral,
    Venue,
    bench_poses,
    first_contact,
    run_end,
    trajectory,
)
from core.dragon import Floats
from core.rectangles import corners
from core.scan import JUMP_WIDTH, SCAN_FROM, SCAN_TO, PitchScan, scan_near_minimum

matplotlib.rcParams["svg.hashsalt"] = "bench-dragon"

VERMILION, BLUE, GREY, PALE = "#D55E00", "#0072B2", "#7F7F7F", "#DDDDDD"
PNG_DPI = 120
# Beyond this many benches an SVG holds them as one picture instead of as shapes.
SHAPES_MAX = 3_000
# The figure of a run without contact shows the dance this long before its end [s], where the chain still exists.
BEFORE_END = 1e-6
# Length of the arrow ahead of the head, and how far inwards its name stands [m].
HEAD_ARROW, HEAD_LABEL = 1.2, 1.0
# Half the side of the enlarged view, in widths of the wider bench.
ENLARGED_WIDTHS = 1.5
# A route is drawn this far around its start [m], as a line of so many points.
ROUTE_DRAWN = 2_000.0
PATH_POINTS = 20_000
# A venue is drawn as far around the dragon as this part of its extent [1].
AROUND = 0.6
# One drawing at a time: matplotlib does not promise that its font caches bear more.
_DRAWING = threading.Lock()


class Format(StrEnum):
    """File format of a figure."""

    SVG = "svg"
    PNG = "png"


def _canvas(width: float, height: float) -> Figure:
    figure = Figure(figsize=(width, height), layout="constrained")
    FigureCanvasAgg(figure)
    return figure


def _bytes(figure: Figure, format: Format) -> bytes:
    sink = io.BytesIO()
    metadata = {"Date": None} if format is Format.SVG else {"Software": None}
    figure.savefig(sink, format=format.value, dpi=PNG_DPI, metadata=metadata)
    return sink.getvalue()


def _plan(axes: Axes) -> None:
    axes.set_aspect("equal")
    axes.set_xlabel("x [m]")
    axes.set_ylabel("y [m]")
    axes.tick_params(labelsize=9)


def _draw_path(axes: Axes, path: Spiral | Route, handles: Floats) -> None:
    """The path, faint: a spiral from the centre to the outermost handle or the start, a route as it is."""
    if isinstance(path, Route):
        s = np.linspace(max(path.begin, -ROUTE_DRAWN), min(path.end, ROUTE_DRAWN), PATH_POINTS)
        axes.plot(*path.position(s).T, color=PALE, linewidth=0.6, zorder=1)
        return
    radius = max(float(np.hypot(*handles.T).max()), path.growth * path.start_theta)
    theta = np.linspace(0.0, radius / path.growth, 120 * int(radius / path.pitch + 2))
    line = path.growth * theta * np.stack([np.cos(theta), np.sin(theta)])
    axes.plot(*line, color=PALE, linewidth=0.6, zorder=1)


def _draw_venue(axes: Axes, venue: Venue | None) -> None:
    """The square as an outline, obstacles hatched, each with its name."""
    for area in venue.areas if venue else ():
        obstacle = area is not venue.square if venue else False
        axes.add_collection(
            PolyCollection(
                [np.array(ring) for ring in area.rings],
                facecolor=PALE if obstacle else "none",
                edgecolor="black",
                hatch="xx" if obstacle else None,
                linewidth=1.0,
                zorder=1.5,
            )
        )
        x, y = max(area.rings[0], key=lambda point: point[0] + point[1])
        axes.text(x, y, f" {area.name}", fontsize=8, zorder=6, ha="left", va="bottom", clip_on=True)
    axes.autoscale_view()


def _look_around(figure: Figure, axes: Axes, handles: Floats) -> None:
    """The dragon and what is near it in a venue, on paper of that shape."""
    low_corner, high_corner = handles.min(axis=0), handles.max(axis=0)
    around = AROUND * float((high_corner - low_corner).max())
    (left, low), (right, high) = (low_corner - around).tolist(), (high_corner + around).tolist()
    axes.set(xlim=(left, right), ylim=(low, high))
    width = figure.get_figwidth()
    figure.set_figheight(float(np.clip(0.75 * width * (high - low) / (right - left) + 1.0, 0.4 * width, 1.2 * width)))


def _outlines(dragon: Dragon, handles: Floats) -> Floats:
    return corners(bench_poses(handles), np.stack([dragon.lengths, dragon.widths], axis=-1))


def _draw_benches(axes: Axes, outlines: Floats, **style: Any) -> None:
    axes.add_collection(PolyCollection(list(outlines), rasterized=len(outlines) > SHAPES_MAX, **style))


def trajectory_figure(
    dragon: Dragon,
    path: Spiral | Route,
    *,
    venue: Venue | None = None,
    time: float = 300.0,
    head_speed: float = 1.0,
    format: Format = Format.SVG,
) -> bytes:
    """Figure 6: every handle at one instant, coloured by its speed; on any path, in any venue.

    time: [s]; raises: OutsideRun after the end of the run
    """
    result = trajectory(dragon, path, [time], head_speed=head_speed)
    handles, speed = result.position[0], result.speed[0]
    with _DRAWING:
        figure = _canvas(7.2, 6.2)
        axes = figure.add_subplot()
        _plan(axes)
        _draw_path(axes, path, handles)
        _draw_venue(axes, venue)
        _draw_benches(axes, _outlines(dragon, handles), facecolor="none", edgecolor=GREY, linewidth=0.4, zorder=2)
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
        _mark_head(axes, handles[0], result.velocity[0, 0])
        bar = figure.colorbar(dots, ax=axes, label="speed of the handle [m/s]", shrink=0.85)
        bar.ax.ticklabel_format(useOffset=False)
        if venue:
            _look_around(figure, axes, handles)
        axes.set_title(f"Handles and their speeds at {time:g} s{_pitch_words(path)}", fontsize=11)
        return _bytes(figure, format)


def _pitch_words(path: Spiral | Route) -> str:
    return f" (pitch {path.pitch:g} m)" if isinstance(path, Spiral) else ""


def _mark_head(axes: Axes, head: Floats, velocity: Floats) -> None:
    """A ring around the head, an arrow where it goes, its name on the inner side."""
    ahead = head + HEAD_ARROW * velocity / np.hypot(*velocity)
    inwards = head - HEAD_LABEL * head / max(float(np.hypot(*head)), HEAD_LABEL)
    arrow = {"arrowstyle": "->", "color": VERMILION, "shrinkA": 5, "linewidth": 1.5}
    axes.plot(*head, marker="o", markersize=9, markerfacecolor="none", markeredgecolor=VERMILION, zorder=4)
    axes.annotate("", (ahead[0], ahead[1]), xytext=(head[0], head[1]), arrowprops=arrow, zorder=5)
    axes.text(inwards[0], inwards[1], "head", color=VERMILION, fontsize=10, ha="center", va="center", zorder=5)


def contact_figure(
    dragon: Dragon,
    path: Spiral | Route,
    *,
    venue: Venue | None = None,
    head_speed: float = 1.0,
    margin: float = 0.0,
    start: float = 0.0,
    stop: float | None = None,
    format: Format = Format.SVG,
) -> bytes:
    """Figure 7: the dance at first contact, the two benches marked, corner, edge and point enlarged.

    Without a contact it shows the dance just before the run ends, and says so.
    """
    found = first_contact(dragon, path, head_speed=head_speed, margin=margin, start=start, stop=stop)
    time = _shown_time(dragon, path, head_speed, found)
    handles = trajectory(dragon, path, [time], head_speed=head_speed).position[0]
    outlines = _outlines(dragon, handles)
    with _DRAWING:
        figure = _canvas(11.0 if found.benches else 7.2, 6.0)
        axes = figure.add_subplot(1, 2, 1) if found.benches else figure.add_subplot()
        _plan(axes)
        _draw_path(axes, path, handles)
        _draw_venue(axes, venue)
        _draw_benches(axes, outlines, facecolor="none", edgecolor=GREY, linewidth=0.5, zorder=2)
        _mark_pair(axes, outlines, found, legend=True)
        axes.autoscale_view()
        axes.set_title(_contact_title(found, margin), fontsize=11)
        if found.benches:
            enlarged = figure.add_subplot(1, 2, 2)
            _draw_enlarged(enlarged, outlines, found, float(dragon.widths[list(found.benches)].max()))
            axes.indicate_inset_zoom(enlarged, edgecolor="black", linewidth=0.8)
        return _bytes(figure, format)


def _shown_time(dragon: Dragon, path: Spiral | Route, head_speed: float, found: FirstContact) -> float:
    if found.time is not None:
        return found.time
    if found.time_bracket is not None:
        return found.time_bracket[0]
    end = found.end or run_end(dragon, path, head_speed=head_speed)
    return end.time - BEFORE_END


def _contact_title(found: FirstContact, margin: float) -> str:
    what = f"First approach to {margin:g} m" if margin else "First contact"
    if found.outcome is Outcome.CONTACT:
        assert found.head is not None
        return f"{what}: {found.time:.6f} s, head at radius {found.head.radius:.6f} m"
    if found.outcome is Outcome.CONTACT_AT_START:
        return f"{what}: already at the start"
    if found.outcome is Outcome.CLEAR and found.end is not None:
        return f"No contact: the run ends clear at the {found.end.reason.value}, {found.end.time:.6f} s"
    return f"Undecided: clear up to {_shown_bracket(found)} s"


def _shown_bracket(found: FirstContact) -> str:
    return f"{found.time_bracket[0]:.6f}" if found.time_bracket else "an unknown time"


def _mark_pair(axes: Axes, outlines: Floats, found: FirstContact, *, legend: bool = False) -> None:
    for k, (bench, colour, hatch) in enumerate(zip(found.benches or (), (VERMILION, BLUE), ("", "////"), strict=False)):
        label = f"bench {bench}" + (" (head)" if bench == 0 else "")
        axes.add_patch(
            matplotlib.patches.Polygon(
                outlines[bench],
                facecolor=colour,
                edgecolor="black",
                alpha=0.85,
                hatch=hatch,
                linewidth=0.6,
                label=label,
                zorder=3 + k,
            )
        )
    if legend and found.benches:
        axes.legend(loc="upper right", fontsize=9, framealpha=0.95)


def _draw_enlarged(axes: Axes, outlines: Floats, found: FirstContact, width: float) -> None:
    """The neighbourhood of the contact: corner, edge and point; two corners may meet, or two parallel edges."""
    assert found.point is not None
    _plan(axes)
    _draw_benches(axes, outlines, facecolor="white", edgecolor=GREY, linewidth=0.8, zorder=2)
    _mark_pair(axes, outlines, found)
    corner, edge = found.corner, found.edge
    if edge:
        axes.plot(
            *_edge(outlines[edge.bench], edge.name).T, color="black", linewidth=2.5, zorder=6,
            label=f"{edge.name} edge of bench {edge.bench}",
        )  # fmt: skip
    axes.plot(
        *found.point, marker="o", linestyle="none", markersize=11, markerfacecolor="white", markeredgecolor="black",
        markeredgewidth=2, zorder=7, label=f"{corner.name} corner of bench {corner.bench}" if corner else "nearest point",
    )  # fmt: skip
    x, y = found.point
    axes.set(xlim=(x - ENLARGED_WIDTHS * width, x + ENLARGED_WIDTHS * width))
    axes.set(ylim=(y - ENLARGED_WIDTHS * width, y + ENLARGED_WIDTHS * width))
    axes.legend(loc="upper right", fontsize=9, framealpha=0.95)
    axes.set_title(f"They meet at ({x:.6f} m, {y:.6f} m)", fontsize=11)


def _edge(outline: Floats, name: str) -> Floats:
    """The two ends of a named edge of one bench; outline: (4, 2) front-left, front-right, rear-right, rear-left."""
    sides = sorted((outline[[0, 3]], outline[[1, 2]]), key=lambda side: float(np.hypot(*side.mean(axis=0))))
    return {"front": outline[[0, 1]], "rear": outline[[2, 3]], "inner": sides[0], "outer": sides[1]}[name]


def pitch_scan_figure(
    dragon: Dragon,
    *,
    turning_radius: float = 4.5,
    start_turns: float = 16.0,
    margin: float = 0.0,
    samples: int = 101,
    format: Format = Format.SVG,
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
        figure = _canvas(9.0, 5.6)
        axes = figure.add_subplot()
        _draw_scan(axes, scan, least, turning_radius)
        axes.plot(pitches, start_turns * pitches, color=GREY, linewidth=0.9, zorder=1, label="start of the dance")
        axes.set(xlim=(pitches[0], pitches[-1]), xlabel="pitch [m]", ylabel="radius of the head at first contact [m]")
        axes.set_ylim(0.0, 1.2 * scan.radius.max(initial=turning_radius))
        axes.legend(loc="lower left", fontsize=9)
        none = "No contact at any of these pitches"
        title = "Where the head stands at first contact, against the pitch" if scan.pitch.size else none
        axes.set_title(title, fontsize=11)
        near = axes.inset_axes((0.56, 0.64, 0.41, 0.33))
        _draw_scan(near, scan, least, turning_radius)
        near.set(xlim=(0.995 * least.pitch, 1.005 * least.pitch))
        near.set(ylim=(0.94 * turning_radius, 1.05 * turning_radius))
        near.tick_params(labelsize=8)
        axes.indicate_inset_zoom(near, edgecolor="black", linewidth=0.7)
        return _bytes(figure, format)


def _draw_scan(axes: Axes, scan: PitchScan, least: MinimumPitch, turning_radius: float) -> None:
    points = np.stack([scan.pitch, scan.radius], axis=-1)
    axes.add_collection(
        LineCollection([points[a:b] for a, b in scan.pieces], colors=BLUE, linewidths=1.8, label="first contact")
    )
    falls = [points[a - 1 : a + 1] for a, _ in scan.pieces[1:] if scan.pitch[a] - scan.pitch[a - 1] <= JUMP_WIDTH]
    axes.add_collection(LineCollection(falls, colors=GREY, linewidths=0.8, linestyles="dotted", label="jump"))
    axes.axhline(
        turning_radius, color="black", linewidth=0.9, linestyle="dashed", label=f"turning circle, {turning_radius:g} m"
    )
    axes.axvline(
        least.pitch, color=VERMILION, linewidth=1.2, linestyle="dashdot", label=f"minimum pitch, {least.pitch:.9f} m"
    )
