"""Parts of a figure beyond those of core/plots.py: canvas, venue, and the bytes of its file.

They use matplotlib's objects, not pyplot: the only global state is the setting below, so threads may draw.
"""

from __future__ import annotations

import io
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor, wait
from contextvars import copy_context
from dataclasses import dataclass
from typing import Any, TypeVar

import matplotlib
import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.collections import PolyCollection
from matplotlib.figure import Figure
from matplotlib.patheffects import Stroke
from matplotlib.text import Text

from core import Budget, Venue
from core.kernels import Halted
from core.plots import PALE
from core.shapes.engines import thickened, widest_place
from core.values import Floats

Value = TypeVar("Value")
matplotlib.rcParams["svg.hashsalt"] = "bench-dragon"
# TrueType: journals refuse fonts of type 3.
matplotlib.rcParams["pdf.fonttype"] = 42

# One drawing at a time: matplotlib does not guarantee that its font caches are safe for threads. Always in one thread:
# matplotlib opens the two files of a font once for each thread that draws, and forty threads answer requests.
_DRAWER = ThreadPoolExecutor(1, "drawing")
# Time between two looks at the budget of who waits for a drawing [s].
LOOK_SECONDS = 0.05
PNG_DPI = 120
# Width of the part of a venue drawn around the dragon, as a fraction of the dragon's extent [1].
AROUND = 0.6
# Size of the names of areas in a figure [pt], width of the paper around them as a part of it, and their distance from a
# small area [pixels].
NAME_TYPE, HALO, NAME_AWAY = 8.0, 0.35, 4.0
# Distance from a line within which no name of a square stands, if there is room elsewhere [m], and of the points of a
# line that a name may not cover [pixels].
LINE_AWAY, LINE_STEP = 0.5, 3.0


def in_turn(draw: Callable[[], Value], budget: Budget | None = None) -> Value:
    """The value of a drawing function, called when all earlier ones are done. It must not call in_turn() itself.

    raises: Halted once the budget is stopped; what has begun goes on for nobody, as matplotlib cannot stop
    """
    drawing = _DRAWER.submit(copy_context().run, draw)
    while budget is not None and not wait([drawing], LOOK_SECONDS).done:
        if budget.stopped:
            drawing.cancel()
            raise Halted(budget)
    return drawing.result()


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


def draw_venue(axes: Axes, venue: Venue | None, lines: Sequence[Floats] = ()) -> None:
    """Draw the square as an outline and the obstacles hatched, each with its name. lines: see AreaNames"""
    draw_areas(axes, venue)
    if venue:
        axes.add_artist(AreaNames(venue, lines))


def draw_areas(axes: Axes, venue: Venue | None) -> None:
    """Draw the square as an outline and the obstacles hatched."""
    for area in venue.areas if venue else ():
        is_square = venue is not None and area is venue.square
        rings = [np.array(ring) for ring in area.rings]
        look: dict[str, Any] = {"facecolor": "none"} if is_square else {"facecolor": PALE, "hatch": "xx"}
        axes.add_collection(PolyCollection(rings, edgecolor="black", linewidth=1.0, zorder=1.5, **look))
    axes.autoscale_view()


@dataclass(frozen=True, slots=True)
class NamePlaces:
    """Where the names of a venue's areas may stand: in the largest circle inside each, or beside one that is small.

    lines: where dragons are or will be, (P, 2) each [m]; names avoid them. The first area is the square.
    """

    venue: Venue
    lines: Sequence[Floats]

    def circles(self, view: tuple[float, float, float, float]) -> Floats:
        """Middle x, y and radius of the circle in each area (N, 3), that of the square in a view [m]."""
        others = [area.rings for area in self.venue.areas[1:]]
        covered = [polygon for line in self.lines for polygon in thickened(line, LINE_AWAY)]
        return np.array([widest_place(self.venue.square.rings, [*others, *covered], view), *map(widest_place, others)])

    @property
    def boxes(self) -> Floats:
        """Left, low, right and top of each area (N, 4) [m]."""
        outer = [np.array(area.rings[0]) for area in self.venue.areas]
        return np.array([[*ring.min(axis=0), *ring.max(axis=0)] for ring in outer])

    def middles(self, axes: Axes, sizes: Floats) -> Floats:
        """Middle of each name on the axes (N, 2). sizes: width and height of each (N, 2) [pixels]

        A name stands inside its circle if it fits there; that of the square always does. Else it stands at the first
        place beside the area where it covers no line and no name before it.
        """
        to_pixels, count = axes.transData.transform, len(sizes)
        points = np.concatenate([np.empty((0, 2)), *(_dense(to_pixels(line)) for line in self.lines)])
        (x_low, x_high), (y_low, y_high) = axes.get_xlim(), axes.get_ylim()
        circles = self.circles((x_low, y_low, x_high, y_high))
        centres, corners = to_pixels(circles[:, :2]), to_pixels(self.boxes.reshape(-1, 2)).reshape(-1, 4)
        radii = to_pixels(circles[:, :2] + np.array([1.0, 0.0]) * circles[:, 2:])[:, 0] - centres[:, 0]
        view, middles = axes.bbox.extents, np.empty((count, 2))
        for k, (x, y) in enumerate(centres.tolist()):
            half, (left, low, right, high) = 0.5 * sizes[k], corners[k]
            if k == 0 or np.hypot(*half) <= radii[k]:
                middles[k] = x, y
                continue
            beside, over = half + NAME_AWAY
            around = np.array([(right + beside, y), (left - beside, y), (x, high + over), (x, low - over)])
            is_free = [
                not (np.abs(points - one) <= half).all(axis=1).any()
                and not (np.abs(middles[:k] - one) < half + 0.5 * sizes[:k]).all(axis=1).any()
                and bool((one - half >= view[:2]).all() and (one + half <= view[2:]).all())
                for one in around
            ]
            middles[k] = around[is_free.index(True) if True in is_free else 0]
        return middles


def _dense(line: Floats) -> Floats:
    """A line (P, 2) with points at most about LINE_STEP apart."""
    along = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(line, axis=0).T))])
    at = np.linspace(0.0, along[-1], int(along[-1] / LINE_STEP) + 2)
    return np.stack([np.interp(at, along, line[:, 0]), np.interp(at, along, line[:, 1])], axis=1)


class AreaNames(Artist):
    """The names of the areas of a venue, with the paper around them, above the dragon.

    They are placed when they are drawn, because only then the scale is known. lines: see NamePlaces
    """

    def __init__(self, venue: Venue, lines: Sequence[Floats]) -> None:
        super().__init__()
        self.set(zorder=8, in_layout=False)
        self._places = NamePlaces(venue, lines)
        look: dict[str, Any] = {"fontsize": NAME_TYPE, "ha": "center", "va": "center", "parse_math": False}
        # The paper around a name is drawn with a path effect, which makes outlines of its letters; the name stays text.
        halo: dict[str, Any] = {"color": "white"}
        halo["path_effects"] = [Stroke(linewidth=2.0 * HALO * NAME_TYPE, foreground="white")]
        self._texts = [Text(text=area.name, **look) for area in venue.areas]
        self._halos = [Text(text=area.name, **look, **halo) for area in venue.areas]

    def draw(self, renderer: Any) -> None:
        axes = self.axes
        assert isinstance(axes, Axes)
        for text in (*self._texts, *self._halos):
            text.set_figure(axes.figure)
            text.set_clip_box(axes.bbox)
        sizes = np.array([text.get_window_extent(renderer).size for text in self._texts])
        for *both, middle in zip(self._halos, self._texts, self._places.middles(axes, sizes), strict=True):
            for text in both:
                text.set_position(middle)
                text.draw(renderer)


def look_around(figure: Figure, axes: Axes, handles: Floats) -> None:
    """Limit the view to the dragon and its surroundings in a venue, and give the figure the same proportions."""
    low_corner, high_corner = handles.min(axis=0), handles.max(axis=0)
    around = AROUND * float((high_corner - low_corner).max())
    (left, low), (right, high) = (low_corner - around).tolist(), (high_corner + around).tolist()
    axes.set(xlim=(left, right), ylim=(low, high))
    width = figure.get_figwidth()
    figure.set_figheight(float(np.clip(0.75 * width * (high - low) / (right - left) + 1.0, 0.4 * width, 1.2 * width)))
