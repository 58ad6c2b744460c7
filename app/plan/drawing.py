"""A map on a sheet of paper: its scale, its shapes as SVG, and its text. All lengths in mm, x to the right and y up."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from operator import itemgetter
from typing import Any

import numpy as np

from app.files.typeset import POINT, Face
from app.plan.paper import PAPERS, Box, Paper, PaperName, TextRoom, box_about
from core import Budget, InvalidValue
from core.quantities import quantities
from core.values import Floats, Point

# Space between a map and its frame, and width of the edge in which a line is broken that goes on beyond it [mm].
PAD, BROKEN_EDGE = 3.0, 6.0
# Scales found on rulers, 1 to each of these.
RATIOS = (
    10, 20, 25, 50, 75, 100, 125, 200, 250, 300, 400, 500, 750, 1000, 1250, 2000, 2500, 3000, 4000, 5000, 7500, 10_000,
    12_500, 20_000, 25_000, 50_000,
)  # fmt: skip
# Lengths of a scale bar, of which one is whole millimetres long [m], and the longest on paper [mm].
BARS = (0.5, 1, 2, 3, 5, 10, 15, 20, 30, 50, 100, 150, 200, 300, 500, 1000, 2000)
BAR_MOST = 50.0
# Parts of a millimetre in which shapes are written.
PARTS = 100


def turned_by(angle: float, points: Floats) -> Floats:
    """Points (..., 2) turned about the origin, counter-clockwise. angle: [rad]"""
    if not angle:
        return points
    cos, sin = math.cos(angle), math.sin(angle)
    turned: Floats = points @ np.array([[cos, sin], [-sin, cos]])
    return turned


@dataclass(frozen=True, slots=True)
class Scale:
    """1 : ratio, with the world's `middle` [m] in the middle of a sheet's room, turned counter-clockwise [rad]."""

    paper: Paper
    ratio: float
    middle: Point
    turned: float = 0.0

    def on_paper(self, points: Floats) -> Floats:
        """Points (..., 2) [mm] of points (..., 2) [m]."""
        left, bottom, right, top = self.paper.room
        centre = np.array([0.5 * (left + right), 0.5 * (bottom + top)])
        placed: Floats = turned_by(self.turned, points - np.array(self.middle)) * (1000.0 / self.ratio) + centre
        return placed

    @property
    def bar(self) -> float:
        """Length of the scale bar [m]: on paper in whole millimetres."""
        on_paper = ((one, one * 1000.0 / self.ratio) for one in BARS)
        return float(max((one for one, wide in on_paper if wide <= BAR_MOST and wide.is_integer()), default=BARS[0]))


def scale_of(name: PaperName, low: Floats, high: Floats) -> Scale:
    """scale_in() on a sheet, upright or across."""
    short, long = PAPERS[name]
    return scale_in((Paper(long, short), Paper(short, long)), low, high, name)


def scale_in(papers: Sequence[Paper], low: Floats, high: Floats, name: PaperName = "A4") -> Scale:
    """The largest scale at which a box fits on one of several papers. name: of the paper, for people

    low, high: corners of the box, (2,) [m]
    raises: InvalidValue if it fits at no scale
    """
    size, middle = (high - low) * 1000.0, (0.5 * (low + high)).tolist()
    for ratio in RATIOS:
        for paper in papers:
            left, bottom, right, top = paper.room
            room = np.array([right - left, top - bottom]) - 2.0 * PAD
            if (size / ratio <= room).all():
                return Scale(paper, ratio, (middle[0], middle[1]))
    short = min(min(paper.width, paper.height) for paper in papers)
    values = quantities("m", 6, got=max(size) / 1000.0, most=short * RATIOS[-1] / 1000.0)
    rule = "must be less than {most} across, to fit on {paper} at 1:{ratio}"
    raise InvalidValue("path", rule, paper=name, ratio=RATIOS[-1], **values)


def look(fill: str = "none", edge: str = "black", width: float = 0.0, dash: Sequence[float] = ()) -> str:
    """The look of a shape as attributes of SVG. width: of its line [pt]; dash: lengths in widths of the line"""
    if not width:
        return f'fill="{fill}"'
    wide = width * POINT * PARTS
    dashes = f' stroke-dasharray="{" ".join(f"{wide * one:.1f}" for one in dash)}"' if dash else ""
    return f'fill="{fill}" stroke="{edge}" stroke-width="{wide:.2f}"{dashes}'


# Fill of stone, and its pattern, a square with a line in its middle that is turned.
HATCHED, STEP = "url(#stone)", 1.5 * PARTS
PATTERN = (
    f'<pattern id="stone" width="{STEP}" height="{STEP}" patternUnits="userSpaceOnUse" patternTransform="rotate(45)">'
    f'<path d="M0 0H{STEP}V{STEP}H0z" fill="#D9D9D9"/><path d="M{STEP / 2} 0V{STEP}" {look(width=0.4)}/></pattern>'
)


def svg_of(box: Box, shapes: Iterable[str]) -> str:
    """A picture of a box on paper, with shapes in PARTS of a millimetre, y up."""
    left, bottom, right, top = (PARTS * one for one in box)
    frame, edge = f"M{left:g} {-top:g}H{right:g}V{-bottom:g}H{left:g}z", PARTS * BROKEN_EDGE
    inner = f"M{left + edge:g} {edge - top:g}H{right - edge:g}V{-bottom - edge:g}H{left + edge:g}z"
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="{left:g} {-top:g} {right - left:g} {top - bottom:g}">'
        f'<defs>{PATTERN}<clipPath id="box"><path d="{frame}"/></clipPath>'
        f'<clipPath id="edge"><path clip-rule="evenodd" d="{frame}{inner}"/></clipPath></defs>'
        f'<g clip-path="url(#box)" fill-rule="evenodd">{"".join(shapes)}</g></svg>'
    )


def outline(points: Floats, end: str = "z") -> str:
    """A line through points (N, 2) as commands of SVG. end: z closes it"""
    whole = np.rint(points * (PARTS, -PARTS)).astype(np.int64)
    return f"M{' '.join(map(str, whole.ravel().tolist()))}{end}"


@dataclass
class MapDrawing:
    """A map that is being drawn. State: its shapes, of which higher ones cover lower ones, its text, and what is taken;
    coordinates: their axis, place from the corner [mm] and words.

    raises: Halted from all that draws, once the budget is stopped
    """

    scale: Scale
    face: Face
    budget: Budget
    shapes: list[tuple[float, str]] = field(default_factory=list)
    texts: list[tuple[int, dict[str, Any]]] = field(default_factory=list)
    ticks: list[tuple[int, float, str]] = field(default_factory=list)
    places: TextRoom = field(default_factory=TextRoom)

    @property
    def room(self) -> Box:
        return self.scale.paper.room

    def shape(self, rings: Iterable[Floats], attributes: str, height: float, end: str = "z") -> None:
        """Draw rings, or lines if `end` is empty."""
        self.budget.look()
        self.shapes.append((height, f'<path d="{"".join(outline(ring, end) for ring in rings)}" {attributes}/>'))

    def line(self, points: Floats, height: float, width: float, colour: str = "black") -> None:
        """Draw a line. width: [pt]"""
        self.shape([points], look(edge=colour, width=width), height, "")

    def width(self, words: str, size: float, bold: bool = False) -> float:
        return self.face.width(words, size, bold)

    def write(self, words: str, x: float, y: float, size: float, order: int = 0, **look: Any) -> None:
        """Write text about a point. order: in which it is read; look: bold, colour, on_paper, and turned [degrees]"""
        left, _, _, top = self.room
        self.texts.append((order, {"words": words, "x": x - left, "y": top - y, "size": size, **look}))

    def label(
        self, words: str, size: float, places: Iterable[Sequence[float]], off: TextRoom | None = None, **more: Any
    ) -> bool:
        """Write text at the first of the places where it is inside the room and overlaps nothing; False: none.

        off: what it keeps off besides
        """
        self.budget.look()
        wide, high = self.width(words, size, more.get("bold", False)) + 0.6, size * POINT + 0.4
        if off is not None:
            places = [(x, y) for x, y in places if off.is_free(box_about(x, y, wide, high))]
        place = self.places.first_free(wide, high, places, self.room)
        if place is not None:
            self.write(words, *place, size, **more)
        return place is not None

    def to_json(self) -> dict[str, Any]:
        """The picture, its text in the order in which it is read, and the coordinates along its frame."""
        shapes = (shape for _, shape in sorted(self.shapes, key=itemgetter(0)))
        texts = [text for _, text in sorted(self.texts, key=itemgetter(0))]
        return {"picture": svg_of(self.room, shapes), "texts": texts, "ticks": self.ticks}
