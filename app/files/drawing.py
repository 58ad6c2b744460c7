"""Parts of a figure beyond those of core/plots.py: canvas, venue, and the bytes of its file.

They use matplotlib's objects, not pyplot: the only global state is the setting below, so threads may draw.
"""

from __future__ import annotations

import io
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from typing import Any, TypeVar

import matplotlib
import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.collections import PolyCollection
from matplotlib.figure import Figure

from core import Venue
from core.plots import PALE
from core.values import Floats

Value = TypeVar("Value")
matplotlib.rcParams["svg.hashsalt"] = "bench-dragon"
# TrueType: journals refuse fonts of type 3.
matplotlib.rcParams["pdf.fonttype"] = 42

# One drawing at a time: matplotlib does not guarantee that its font caches are safe for threads. Always in one thread:
# matplotlib opens the two files of a font once for each thread that draws, and forty threads answer requests.
_DRAWER = ThreadPoolExecutor(1, "drawing")
PNG_DPI = 120
# The whole square is drawn if it is at most this many times as large as the dance; else only the part around the dance.
SQUARE_MOST = 2.0
# Width of the part of a venue drawn around the dragon, as a fraction of the dragon's extent [1].
AROUND = 0.6


def in_turn(draw: Callable[[], Value]) -> Value:
    """The value of a drawing function, called when all earlier ones are done. It must not call in_turn() itself."""
    return _DRAWER.submit(draw).result()


def canvas(width: float, height: float) -> Figure:
    """An empty figure. width, height: [inch]"""
    figure = Figure(figsize=(width, height), layout="constrained")
    FigureCanvasAgg(figure)
    return figure


def file_bytes(figure: Figure, format: str, dpi: int = PNG_DPI) -> bytes:
    """Bytes of the figure's file: equal for equal figures, as they hold no date, no version and no random names."""
    sink = io.BytesIO()
    undated = {"pdf": {"CreationDate": None}, "svg": {"Date": None}, "png": {"Software": None}}[format]
    figure.savefig(sink, format=format, dpi=dpi, metadata=undated)
    return sink.getvalue()


def draw_venue(axes: Axes, venue: Venue | None) -> None:
    """Draw the square as an outline and the obstacles hatched, each with its name."""
    for area in venue.areas if venue else ():
        is_square = venue is not None and area is venue.square
        rings = [np.array(ring) for ring in area.rings]
        look: dict[str, Any] = {"facecolor": "none"} if is_square else {"facecolor": PALE, "hatch": "xx"}
        axes.add_collection(PolyCollection(rings, edgecolor="black", linewidth=1.0, zorder=1.5, **look))
        x, y = max(area.rings[0], key=lambda point: point[0] + point[1])
        axes.text(x, y, f" {area.name}", fontsize=8, zorder=6, ha="left", va="bottom", clip_on=True, parse_math=False)
    axes.autoscale_view()


def with_square(venue: Venue | None, low: Floats, high: Floats) -> tuple[Floats, Floats]:
    """Corners (2,) [m] of the drawn part: dance and square, or only the dance if the square is much larger."""
    if venue is None:
        return low, high
    square = np.array(venue.square.rings[0])
    least, most = np.minimum(low, square.min(axis=0)), np.maximum(high, square.max(axis=0))
    return (least, most) if (most - least <= SQUARE_MOST * (high - low)).all() else (low, high)


def look_around(figure: Figure, axes: Axes, handles: Floats) -> None:
    """Limit the view to the dragon and its surroundings in a venue, and give the figure the same proportions."""
    low_corner, high_corner = handles.min(axis=0), handles.max(axis=0)
    around = AROUND * float((high_corner - low_corner).max())
    (left, low), (right, high) = (low_corner - around).tolist(), (high_corner + around).tolist()
    axes.set(xlim=(left, right), ylim=(low, high))
    width = figure.get_figwidth()
    figure.set_figheight(float(np.clip(0.75 * width * (high - low) / (right - left) + 1.0, 0.4 * width, 1.2 * width)))
