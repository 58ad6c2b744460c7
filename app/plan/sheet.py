"""A sheet of paper: its frame and title block, and text without overlaps. All lengths in mm."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from functools import lru_cache
from typing import Any

import numpy as np
from matplotlib.artist import Artist
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.font_manager import FontProperties
from matplotlib.patches import Patch, PathPatch, Polygon, Rectangle
from matplotlib.path import Path as Outline

from app.plan.paper import BLOCK, MARGIN, Box, Paper, Places, Title
from core import Budget
from core.language import say
from core.values import Floats

MM = 25.4
POINT = MM / 72.0


class Entries(Artist):
    """Text drawn directly, without matplotlib's layout, which took half of the time of a table."""

    def __init__(self, family: tuple[str, ...]) -> None:
        super().__init__()
        self.family = list(family)
        self.words: list[tuple[float, float, str, float, bool]] = []
        self.set_zorder(9)  # above the grey bands of rows

    def draw(self, renderer: Any) -> None:
        figure = self.get_figure(root=True)
        dots = figure.dpi / MM if figure else 0.0
        graphics = renderer.new_gc()
        for x, y, words, size, bold in self.words:
            font = FontProperties(family=self.family, size=size, weight="bold" if bold else "normal")
            renderer.draw_text(graphics, x * dots, y * dots, words, font, 0.0)
        graphics.restore()


@dataclass
class Sheet:
    """A page with coordinates in mm, x to the right and y up. State: where text stands.

    raises: Halted from all that draws, once the budget is stopped
    """

    paper: Paper
    family: tuple[str, ...]
    budget: Budget
    places: Places = field(default_factory=Places)

    def __post_init__(self) -> None:
        self.figure = Figure(figsize=(self.paper.width / MM, self.paper.height / MM), dpi=72)
        FigureCanvasAgg(self.figure)
        self.axes = self.figure.add_axes((0.0, 0.0, 1.0, 1.0))
        self.axes.set(xlim=(0.0, self.paper.width), ylim=(0.0, self.paper.height))
        self.axes.axis("off")
        self.entries = Entries(self.family)
        self.axes.add_artist(self.entries)

    def frame(self, box: Box) -> Rectangle:
        """Draw a rectangle, and return it as the limit for other drawings."""
        left, bottom, right, top = box
        drawn = Rectangle((left, bottom), right - left, top - bottom, fill=False, linewidth=0.6, zorder=8)
        self.axes.add_patch(drawn)
        return drawn

    def line(self, points: Any, clip: Rectangle | None = None, **look: Any) -> None:
        x, y = np.asarray(points, dtype=np.float64).T
        options: dict[str, Any] = {"color": "black", "linewidth": 0.5, "solid_capstyle": "butt"} | look
        (drawn,) = self.axes.plot(x, y, **options)
        if clip is not None:
            drawn.set_clip_path(clip)

    def area(self, rings: Iterable[Floats], clip: Rectangle | None = None, **look: Any) -> None:
        """Fill a polygon with its holes."""
        parts = list(rings)
        codes = [[Outline.MOVETO, *[Outline.LINETO] * (len(ring) - 2), Outline.CLOSEPOLY] for ring in parts]
        self._add(PathPatch(Outline(np.concatenate(parts), np.concatenate(codes)), **look), clip)

    def shape(self, points: Floats, clip: Rectangle | None = None, **look: Any) -> None:
        self._add(Polygon(points, closed=True, **look), clip)

    def _add(self, patch: Patch, clip: Rectangle | None) -> None:
        self.budget.look()
        self.axes.add_patch(patch)
        if clip is not None:
            patch.set_clip_path(clip)

    def width(self, words: str, size: float, bold: bool = False) -> float:
        """Width of a text [mm]. size: of its type [pt]"""
        return size * sum(_width(character, bold, self.family) for character in words)

    def words(self, x: float, y: float, words: str, size: float = 7.0, *, within: float = 0.0, **look: Any) -> None:
        """Write text from a point on; `within`: its largest width, kept by smaller type if necessary [mm]."""
        bold = look.get("fontweight") == "bold"
        if within and (wide := self.width(words, size, bold)) > within:
            size *= within / wide
        place: dict[str, Any] = {"ha": "left", "va": "baseline", "zorder": 9, "parse_math": False} | look
        self.axes.text(x, y, words, fontsize=size, **place)

    def take(self, boxes: Floats) -> None:
        """Keep text out of boxes (N, 4) [mm]."""
        self.places.take(boxes)

    def entry(self, x: float, y: float, words: str, size: float, *, bold: bool = False) -> None:
        """Write text from a point on, without layout, because a table has thousands of entries."""
        self.budget.look()
        self.entries.words.append((x, y, words, size, bold))

    def label(self, words: str, size: float, places: Iterable[Sequence[float]], room: Box, **look: Any) -> bool:
        """Write text at the first of the places where it is inside the room and overlaps nothing; False: none."""
        self.budget.look()
        place = self.places.first_free(self.width(words, size) + 0.6, size * POINT + 0.4, places, room)
        if place is not None:
            # The baseline of a line of type is a third of its height below its middle.
            self.words(place[0], place[1] - 0.36 * size * POINT, words, size, ha="center", **look)
        return place is not None


@lru_cache(maxsize=5_000)
def _width(character: str, bold: bool, family: tuple[str, ...]) -> float:
    """Width of a character in type of 1 pt [mm]."""
    canvas = FigureCanvasAgg(Figure(figsize=(0.1, 0.1), dpi=72))
    font = FontProperties(family=list(family), size=100, weight="bold" if bold else "normal")
    # Measured between two other characters, because a space alone has no width.
    wide, bare = (
        canvas.get_renderer().get_text_width_height_descent(text, font, ismath=False)[0]
        for text in (f"|{character}|", "||")
    )
    return float(wide - bare) * POINT / 100.0


def title_block(sheet: Sheet, title: Title, subtitle: str, number: str) -> tuple[float, float]:
    """Draw the title block; returns the left and the right end of the free cell for notes [mm]."""
    paper = sheet.paper
    left, bottom, right, top = MARGIN, MARGIN, paper.width - MARGIN, MARGIN + BLOCK
    sheet.frame((left, bottom, right, top))
    last = right - 24.0
    first = left + max(62.0, 0.42 * (last - 60.0 - left))
    for x in (first, last):
        sheet.line([(x, bottom), (x, top)], linewidth=0.4)
    wide = first - left - 4.0
    sheet.words(left + 2.0, top - 6.0, title.title, 12.0, within=wide, fontweight="bold")
    sheet.words(left + 2.0, top - 11.0, subtitle, 8.5, within=wide)
    step = min(3.6, 9.0 / max(1, len(title.facts) - 1))
    for k, fact in enumerate(title.facts):
        sheet.words(left + 2.0, top - 15.5 - step * k, fact, 6.5, within=wide)
    colour = "#006400" if title.passes else "#B00000"
    sheet.words(left + 2.0, bottom + 2.0, title.verdict, 7.0, within=wide, color=colour, fontweight="bold")
    sheet.words(0.5 * (last + right), top - 6.0, paper.name, 12.0, ha="center", fontweight="bold")
    sheet.words(0.5 * (last + right), top - 12.0, say("sheet"), 6.5, ha="center")
    sheet.words(0.5 * (last + right), top - 17.0, number, 9.0, ha="center")
    sheet.words(0.5 * (last + right), bottom + 2.0, "Bench Dragon", 5.5, ha="center", color="#555555")
    return first, last


def north_arrow(sheet: Sheet, x: float, y: float, geographic: bool) -> None:
    """Draw an arrow up: north if that is known, else the y axis."""
    left, right = (np.array([(x, y + 9.0), (x + side, y), (x, y + 2.0)]) for side in (-2.0, 2.0))
    sheet.shape(left, facecolor="black", linewidth=0.0, zorder=9)
    sheet.shape(right, facecolor="white", edgecolor="black", linewidth=0.4, zorder=9)
    sheet.words(x, y + 10.0, "N" if geographic else "y", 9.0, ha="center", fontweight="bold")
    sheet.take(np.array([x - 3.0, y - 1.0, x + 3.0, y + 14.0]))
