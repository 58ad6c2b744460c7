"""A sheet of paper: its frame and title block, text without overlaps, and the scale. All lengths in mm."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from functools import lru_cache
from typing import Any, Literal

import numpy as np
from matplotlib.artist import Artist
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.font_manager import FontProperties
from matplotlib.patches import Patch, PathPatch, Polygon, Rectangle
from matplotlib.path import Path as Outline

from core import Budget, InvalidValue
from core.errors import quantities
from core.language import say
from core.values import Floats

PaperName = Literal["A4", "A3"]
# Shorter and longer side [mm].
PAPERS: dict[PaperName, tuple[float, float]] = {"A4": (210.0, 297.0), "A3": (297.0, 420.0)}
# Margin of the paper, height of the title block, and space inside a frame [mm].
MARGIN, BLOCK, PAD = 10.0, 30.0, 3.0
# Scales found on rulers, 1 to each of these.
RATIOS = (10, 20, 25, 50, 100, 200, 250, 500, 1000, 2000, 2500, 5000, 10_000, 20_000, 25_000, 50_000)
# Lengths of a scale bar [m], and the longest on paper [mm].
BARS = (0.5, 1, 2, 5, 10, 20, 50, 100, 200, 500, 1000, 2000)
BAR_MOST = 50.0
MM = 25.4
POINT = MM / 72.0


@dataclass(frozen=True, slots=True)
class Paper:
    """A sheet by its name, its width and its height [mm]."""

    name: PaperName
    width: float
    height: float

    @property
    def room(self) -> tuple[float, float, float, float]:
        """Left, bottom, right and top of the area above the title block [mm]."""
        return MARGIN, MARGIN + BLOCK, self.width - MARGIN, self.height - MARGIN


@dataclass(frozen=True, slots=True)
class Scale:
    """1 : ratio, with the world's `middle` [m] in the middle of a sheet's room."""

    paper: Paper
    ratio: int
    middle: tuple[float, float]

    def on_paper(self, points: Floats) -> Floats:
        """Points (..., 2) [mm] of points (..., 2) [m]."""
        left, bottom, right, top = self.paper.room
        centre = np.array([0.5 * (left + right), 0.5 * (bottom + top)])
        placed: Floats = (points - np.array(self.middle)) * (1000.0 / self.ratio) + centre
        return placed

    @property
    def bar(self) -> float:
        """Length of the scale bar [m]."""
        return float(max((one for one in BARS if one * 1000.0 / self.ratio <= BAR_MOST), default=BARS[0]))


def scale_of(name: PaperName, low: Floats, high: Floats) -> Scale:
    """The largest scale at which a box fits on the paper, with the paper upright or across.

    low, high: corners of the box, (2,) [m]
    raises: InvalidValue if it fits at no scale
    """
    short, long = PAPERS[name]
    size, middle = (high - low) * 1000.0, (0.5 * (low + high)).tolist()
    for ratio in RATIOS:
        for paper in (Paper(name, long, short), Paper(name, short, long)):
            left, bottom, right, top = paper.room
            room = np.array([right - left, top - bottom]) - 2.0 * PAD
            if (size / ratio <= room).all():
                return Scale(paper, ratio, (middle[0], middle[1]))
    values = quantities("m", 6, got=max(size) / 1000.0, most=min(PAPERS[name]) * RATIOS[-1] / 1000.0)
    rule = "must be less than {most} across, to fit on {paper} at 1:{ratio}"
    raise InvalidValue("path", rule, paper=name, ratio=RATIOS[-1], **values)


Box = tuple[float, float, float, float]


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
    """A page with coordinates in mm, x to the right and y up. State: boxes that are taken, where no text may go.

    raises: Halted from all that draws, once the budget is stopped
    """

    paper: Paper
    family: tuple[str, ...]
    budget: Budget
    taken: Floats = field(default_factory=lambda: np.empty((0, 4)))

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
        self.taken = np.concatenate([self.taken, boxes.reshape(-1, 4)])

    def entry(self, x: float, y: float, words: str, size: float, *, bold: bool = False) -> None:
        """Write text from a point on, without layout, because a table has thousands of entries."""
        self.budget.look()
        self.entries.words.append((x, y, words, size, bold))

    def label(self, words: str, size: float, places: Iterable[Sequence[float]], room: Box, **look: Any) -> bool:
        """Write text at the first of the places where it is inside the room and overlaps nothing; False: none."""
        self.budget.look()
        wide, high = 0.5 * self.width(words, size) + 0.3, 0.5 * size * POINT + 0.2
        for x, y in places:
            box = np.array([x - wide, y - high, x + wide, y + high])
            inside = bool((box[:2] > room[:2]).all() and (box[2:] < room[2:]).all())
            if inside and not ((self.taken[:, :2] < box[2:]) & (self.taken[:, 2:] > box[:2])).all(axis=1).any():
                self.take(box)
                # The baseline of a line of type is a third of its height below its middle.
                self.words(x, y - 0.36 * size * POINT, words, size, ha="center", **look)
                return True
        return False


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


@dataclass(frozen=True, slots=True)
class Title:
    """The content of the title block of every sheet.

    title: of the plan; facts: of the dance, in lines; verdict: of the check; geographic: True if y points north
    """

    title: str
    facts: Sequence[str]
    verdict: str
    passes: bool
    geographic: bool


def title_block(sheet: Sheet, title: Title, subtitle: str, number: str, scale: Scale | None) -> tuple[float, float]:
    """Draw the title block; returns the left and the right end of the free cell for a legend [mm].

    scale: of the map on the sheet; None: a sheet of tables, whose notes also take the place of the scale bar
    """
    paper = sheet.paper
    left, bottom, right, top = MARGIN, MARGIN, paper.width - MARGIN, MARGIN + BLOCK
    sheet.frame((left, bottom, right, top))
    last, bar = right - 24.0, right - 24.0 - 60.0
    first = left + max(62.0, 0.42 * (bar - left))
    for x in (first, bar, last) if scale else (first, last):
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
    if scale is not None:
        _scale_bar(sheet, scale, bar + 5.0, bottom, top)
    return first, bar if scale else last


def _scale_bar(sheet: Sheet, scale: Scale, x: float, bottom: float, top: float) -> None:
    length = scale.bar
    wide = length * 1000.0 / scale.ratio
    sheet.words(x, top - 8.0, f"1:{scale.ratio}", 14.0, fontweight="bold")
    y = bottom + 9.0
    sheet.axes.add_patch(Rectangle((x, y), wide, 1.6, facecolor="white", edgecolor="black", linewidth=0.4))
    sheet.axes.add_patch(Rectangle((x, y), 0.5 * wide, 1.6, facecolor="black", linewidth=0.0))
    for share in (0.0, 0.5, 1.0):
        words = f"{length * share:g}" + (" m" if share == 1.0 else "")
        sheet.words(x + share * wide, y + 2.4, words, 6.0, ha="center")
    note = say("print at 100 %: this bar is {wide:g} mm long", wide=wide)
    sheet.words(x - 3.0, bottom + 3.0, note, 6.0, within=56.0)


def north_arrow(sheet: Sheet, x: float, y: float, geographic: bool) -> None:
    """Draw an arrow up: north if that is known, else the y axis."""
    left, right = (np.array([(x, y + 9.0), (x + side, y), (x, y + 2.0)]) for side in (-2.0, 2.0))
    sheet.shape(left, facecolor="black", linewidth=0.0, zorder=9)
    sheet.shape(right, facecolor="white", edgecolor="black", linewidth=0.4, zorder=9)
    sheet.words(x, y + 10.0, "N" if geographic else "y", 9.0, ha="center", fontweight="bold")
    sheet.take(np.array([x - 3.0, y - 1.0, x + 3.0, y + 14.0]))
