"""Drawings of a dance and its answers on axes of matplotlib. Only this module of core imports matplotlib, on demand.

Lengths are in metres on both axes, x to the right. Colours are safe for colour-blind readers (cividis; Okabe and Ito's
set) and differ in brightness, hatch or line style for print.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, Protocol

import numpy as np

from core.display import TOUCHING
from core.extras import wanted
from core.language import Phrases, say
from core.paths.route import Route
from core.paths.spiral import Spiral
from core.values import Floats, Point

if TYPE_CHECKING:
    from matplotlib.axes import Axes

VERMILION, BLUE, GREY, PALE = TOUCHING, "#0072B2", "#7F7F7F", "#DDDDDD"
# Most benches that an SVG shows as shapes; for more it holds one raster picture.
SHAPES_MAX = 3_000
# Length of the arrow ahead of the head, and distance of its label inwards [m].
HEAD_ARROW, HEAD_LABEL = 1.2, 1.0
# Half the side of the enlarged view, in widths of the wider bench, and its minimum, in margins.
ENLARGED_WIDTHS = 1.5
ENLARGED_MARGINS = 1.5


class BenchFeature(Protocol):
    """A corner or an edge of a bench, by its name."""

    @property
    def bench(self) -> int: ...
    @property
    def name(self) -> str: ...


def wanted_axes(axes: Axes | None, what: str) -> Axes:
    """The given axes, or those of a new figure.

    raises: ImportError naming the extra `figures` if matplotlib is not installed
    """
    if axes is not None:
        return axes
    new_axes: Axes = wanted("matplotlib.pyplot", "figures", what).subplots(layout="constrained")[1]
    return new_axes


def plan(axes: Axes) -> None:
    """Axes of a map: equal scales in x and y."""
    axes.set_aspect("equal")
    axes.set_xlabel("x [m]")
    axes.set_ylabel("y [m]")
    axes.tick_params(labelsize=9)


def draw_dance(axes: Axes, path: Spiral | Route, handles: Floats, outlines: Floats, linewidth: float = 0.5) -> None:
    """Draw the path and every bench, faint, in metres. handles: (n + 1, 2) [m]; outlines: corners (n, 4, 2) [m]"""
    plan(axes)
    axes.plot(*path.drawn(handles).T, color=PALE, linewidth=0.6, zorder=1)
    _draw_benches(axes, outlines, facecolor="none", edgecolor=GREY, linewidth=linewidth, zorder=2)
    axes.autoscale_view()


def _draw_benches(axes: Axes, outlines: Floats, **style: Any) -> None:
    from matplotlib.collections import PolyCollection

    axes.add_collection(PolyCollection(list(outlines), rasterized=len(outlines) > SHAPES_MAX, **style))


def draw_speeds(axes: Axes, handles: Floats, speed: Floats) -> None:
    """Draw every handle, coloured by its speed, with a colour bar. handles: (n + 1, 2) [m]; speed: (n + 1,) [m/s]"""
    dots = axes.scatter(
        handles[:, 0], handles[:, 1], c=speed, s=16, cmap="cividis", zorder=3, linewidths=0,
        rasterized=len(handles) > SHAPES_MAX,
    )  # fmt: skip
    bar = axes.figure.colorbar(dots, ax=axes, label=say("speed of the handle [m/s]"), shrink=0.85)
    bar.ax.ticklabel_format(useOffset=False)


def mark_head(axes: Axes, head: Floats, tangent: Floats, centre: Point) -> None:
    """Draw a ring around the head, an arrow in its direction of travel, and its label on the side of the centre."""
    ahead, out = head + HEAD_ARROW * tangent, head - np.array(centre)
    inwards = head - HEAD_LABEL * out / max(float(np.hypot(*out)), HEAD_LABEL)
    arrow = {"arrowstyle": "->", "color": VERMILION, "shrinkA": 5, "linewidth": 1.5}
    axes.plot(*head, marker="o", markersize=9, markerfacecolor="none", markeredgecolor=VERMILION, zorder=4)
    axes.annotate("", (ahead[0], ahead[1]), xytext=(head[0], head[1]), arrowprops=arrow, zorder=5)
    axes.text(inwards[0], inwards[1], say("head"), color=VERMILION, fontsize=10, ha="center", va="center", zorder=5)


def mark_pair(axes: Axes, outlines: Floats, benches: Sequence[int]) -> None:
    """Draw the two touching benches, filled: one plain, one hatched."""
    from matplotlib.patches import Polygon

    for k, (bench, colour, hatch) in enumerate(zip(benches, (VERMILION, BLUE), ("", "////"), strict=True)):
        label = say("bench {bench}", bench=bench) if bench else say("bench 0 (head)")
        style: dict[str, Any] = {"facecolor": colour, "hatch": hatch, "label": label, "zorder": 3 + k}
        axes.add_patch(Polygon(outlines[bench], edgecolor="black", alpha=0.85, linewidth=0.6, **style))


# Words for the corners and edges of a bench, by their names.
FEATURES: Phrases = {
    "front": "front edge",
    "rear": "rear edge",
    "inner": "inner edge",
    "outer": "outer edge",
    "front-outer": "front-outer corner",
    "front-inner": "front-inner corner",
    "rear-outer": "rear-outer corner",
    "rear-inner": "rear-inner corner",
}


def feature_words(feature: BenchFeature) -> str:
    return say("{feature} of bench {bench}", feature=say(FEATURES[feature.name]), bench=feature.bench)


def draw_enlarged(
    axes: Axes, outlines: Floats, benches: Sequence[int], point: Sequence[float], half: float,
    corner: BenchFeature | None, edge: BenchFeature | None, centre: Point,
) -> None:  # fmt: skip
    """Draw the surroundings of a contact: both benches, corner, edge, point; two corners or two edges may meet too.

    outlines: corners (n, 4, 2) [m]; point: x, y [m]; half: half the side of the view [m]
    centre: of the path (x, y) [m], on the side of inner edges
    """
    plan(axes)
    _draw_benches(axes, outlines, facecolor="white", edgecolor=GREY, linewidth=0.8, zorder=2)
    mark_pair(axes, outlines, benches)
    if edge:
        sides = _edge(outlines[edge.bench], edge.name, centre)
        axes.plot(*sides.T, color="black", linewidth=2.5, zorder=6, label=feature_words(edge))
    nearest = feature_words(corner) if corner else say("nearest point")
    axes.plot(
        *point, marker="o", linestyle="none", markersize=11, markerfacecolor="white", markeredgecolor="black",
        markeredgewidth=2, zorder=7, label=nearest,
    )  # fmt: skip
    x, y = point
    axes.set(xlim=(x - half, x + half), ylim=(y - half, y + half))


def _edge(outline: Floats, name: str, centre: Point) -> Floats:
    """The two ends of a named edge of one bench; outline: (4, 2) front-left, front-right, rear-right, rear-left."""
    sides = sorted((outline[[0, 3]], outline[[1, 2]]), key=lambda side: float(np.hypot(*(side.mean(axis=0) - centre))))
    return {"front": outline[[0, 1]], "rear": outline[[2, 3]], "inner": sides[0], "outer": sides[1]}[name]


def draw_clearance(axes: Axes, time: Floats, clearance: Floats, grazes: Sequence[tuple[float, float]]) -> None:
    """Draw the clearance against time, its local minima as dots. grazes: time [s], clearance [m]"""
    axes.plot(time, clearance, color=BLUE, linewidth=1.4, marker="." if time.size == 1 else "", label=say("clearance"))
    if grazes:
        axes.plot(*np.transpose(grazes), "o", color=VERMILION, markersize=5, label=say("graze"))
    axes.axhline(0.0, color="black", linewidth=0.8, linestyle="dashed", label=say("touch"))
    axes.set(xlabel=say("time [s]"), ylabel=say("clearance of the nearest pair [m]"))
    axes.legend(fontsize=9)


def draw_scan(axes: Axes, points: Floats, pieces: Sequence[tuple[int, int]], jump: float, label: str) -> None:
    """Draw the radius of the head at first contact against the pitch: a staircase, its jumps dotted.

    points: (N, 2) pitch, radius [m]; pieces: (start, end) indices; jump: largest distance between two pitches with a
    jump between them [m]; label: of the staircase
    """
    from matplotlib.collections import LineCollection

    stairs = [points[a:b] for a, b in pieces if b - a > 1]
    axes.add_collection(LineCollection(stairs, colors=BLUE, linewidths=1.8, label=label if stairs else None))
    alone = np.array([a for a, b in pieces if b - a == 1], dtype=np.int64)
    axes.plot(*points[alone].T, ".", color=BLUE, label=None if stairs else label)
    falls = [points[a - 1 : a + 1] for a, _ in pieces[1:] if points[a, 0] - points[a - 1, 0] <= jump]
    jump_label = say("jump") if falls else None
    axes.add_collection(LineCollection(falls, colors=GREY, linewidths=0.8, linestyles="dotted", label=jump_label))
