"""The parts of a figure: paper, path, venue, benches, marks, and its bytes in a file's format.

matplotlib's objects only, no pyplot: nothing global but the constant set below, so threads may draw. Colours are safe
for colour-blind readers (cividis; Okabe and Ito's set) and differ in brightness, hatch or line style for print.
"""

from __future__ import annotations

import io
from typing import Any

import matplotlib
import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.collections import PolyCollection
from matplotlib.figure import Figure

from core import Dragon, FirstContact, Route, Spiral, Venue, bench_poses
from core.errors import said
from core.shapes.rectangles import corners
from core.values import Floats

matplotlib.rcParams["svg.hashsalt"] = "bench-dragon"

VERMILION, BLUE, GREY, PALE = "#D55E00", "#0072B2", "#7F7F7F", "#DDDDDD"
PNG_DPI = 120
# Beyond this many benches an SVG holds them as one picture instead of as shapes.
SHAPES_MAX = 3_000
# Length of the arrow ahead of the head, and how far inwards its name stands [m].
HEAD_ARROW, HEAD_LABEL = 1.2, 1.0
# Half the side of the enlarged view, in widths of the wider bench.
ENLARGED_WIDTHS = 1.5
# And at least so many margins.
ENLARGED_MARGINS = 1.5
# A route is drawn this far around its start [m], as a line of so many points.
ROUTE_DRAWN = 2_000.0
PATH_POINTS = 20_000
# A venue is drawn as far around the dragon as this part of its extent [1].
AROUND = 0.6


def canvas(width: float, height: float) -> Figure:
    """Empty paper. width, height: [inch]"""
    figure = Figure(figsize=(width, height), layout="constrained")
    FigureCanvasAgg(figure)
    return figure


def file_bytes(figure: Figure, format: str) -> bytes:
    """The figure as a file, the same bytes for the same figure: no date, no version, no random names."""
    sink = io.BytesIO()
    metadata = {"Date": None} if format == "svg" else {"Software": None}
    figure.savefig(sink, format=format, dpi=PNG_DPI, metadata=metadata)
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
        axes.text(x, y, f" {area.name}", fontsize=8, zorder=6, ha="left", va="bottom", clip_on=True, parse_math=False)
    axes.autoscale_view()


def look_around(figure: Figure, axes: Axes, handles: Floats) -> None:
    """The dragon and what is near it in a venue, on paper of that shape."""
    low_corner, high_corner = handles.min(axis=0), handles.max(axis=0)
    around = AROUND * float((high_corner - low_corner).max())
    (left, low), (right, high) = (low_corner - around).tolist(), (high_corner + around).tolist()
    axes.set(xlim=(left, right), ylim=(low, high))
    width = figure.get_figwidth()
    figure.set_figheight(float(np.clip(0.75 * width * (high - low) / (right - left) + 1.0, 0.4 * width, 1.2 * width)))


def bench_outlines(dragon: Dragon, handles: Floats) -> Floats:
    """Corners (n, 4, 2) [m] of the benches. handles: (n + 1, 2) [m]"""
    return corners(bench_poses(handles), np.stack([dragon.lengths, dragon.widths], axis=-1))


def draw_dance(
    axes: Axes, path: Spiral | Route, venue: Venue | None, handles: Floats, outlines: Floats, linewidth: float
) -> None:
    """The path, the venue and every bench, faint, in metres."""
    _plan(axes)
    _draw_path(axes, path, handles)
    _draw_venue(axes, venue)
    _draw_benches(axes, outlines, facecolor="none", edgecolor=GREY, linewidth=linewidth, zorder=2)


def _draw_benches(axes: Axes, outlines: Floats, **style: Any) -> None:
    axes.add_collection(PolyCollection(list(outlines), rasterized=len(outlines) > SHAPES_MAX, **style))


def mark_head(axes: Axes, head: Floats, velocity: Floats) -> None:
    """A ring around the head, an arrow where it goes, its name on the inner side."""
    ahead = head + HEAD_ARROW * velocity / np.hypot(*velocity)
    inwards = head - HEAD_LABEL * head / max(float(np.hypot(*head)), HEAD_LABEL)
    arrow = {"arrowstyle": "->", "color": VERMILION, "shrinkA": 5, "linewidth": 1.5}
    axes.plot(*head, marker="o", markersize=9, markerfacecolor="none", markeredgecolor=VERMILION, zorder=4)
    axes.annotate("", (ahead[0], ahead[1]), xytext=(head[0], head[1]), arrowprops=arrow, zorder=5)
    axes.text(inwards[0], inwards[1], "head", color=VERMILION, fontsize=10, ha="center", va="center", zorder=5)


def mark_pair(axes: Axes, outlines: Floats, found: FirstContact, *, legend: bool = False) -> None:
    """The two benches that meet, filled: one plain, one hatched."""
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


def draw_enlarged(axes: Axes, outlines: Floats, found: FirstContact, width: float, margin: float) -> None:
    """The neighbourhood of the contact: corner, edge and point; two corners may meet, or two parallel edges.

    width: of the wider bench; margin: with one the two are only near [m]
    """
    assert found.point is not None
    _plan(axes)
    _draw_benches(axes, outlines, facecolor="white", edgecolor=GREY, linewidth=0.8, zorder=2)
    mark_pair(axes, outlines, found)
    corner, edge = found.corner, found.edge
    if edge:
        axes.plot(
            *_edge(outlines[edge.bench], edge.name).T, color="black", linewidth=2.5, zorder=6,
            label=f"{edge.name} edge of bench {edge.bench}",
        )  # fmt: skip
    nearest = f"{corner.name} corner of bench {corner.bench}" if corner else "nearest point"
    axes.plot(
        *found.point, marker="o", linestyle="none", markersize=11, markerfacecolor="white", markeredgecolor="black",
        markeredgewidth=2, zorder=7, label=nearest,
    )  # fmt: skip
    x, y = found.point
    half = max(ENLARGED_WIDTHS * width, ENLARGED_MARGINS * margin)
    axes.set(xlim=(x - half, x + half), ylim=(y - half, y + half))
    axes.legend(loc="upper right", fontsize=9, framealpha=0.95)
    place = f"({x:.6f} m, {y:.6f} m)"
    near = f"Nearer than {said(margin)} m: a gap of {found.gap:.6f} m at {place}"
    axes.set_title(near if margin else f"They meet at {place}", fontsize=11)


def _edge(outline: Floats, name: str) -> Floats:
    """The two ends of a named edge of one bench; outline: (4, 2) front-left, front-right, rear-right, rear-left."""
    sides = sorted((outline[[0, 3]], outline[[1, 2]]), key=lambda side: float(np.hypot(*side.mean(axis=0))))
    return {"front": outline[[0, 1]], "rear": outline[[2, 3]], "inner": sides[0], "outer": sides[1]}[name]
