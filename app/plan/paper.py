"""Sizes of paper, and places of text on a sheet, where it overlaps nothing. All lengths in mm, x to the right, y up."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, fields
from itertools import product
from typing import Any, Literal

import numpy as np

from core.values import Floats

PaperName = Literal["A4", "A3"]
# Shorter and longer side [mm].
PAPERS: dict[PaperName, tuple[float, float]] = {"A4": (210.0, 297.0), "A3": (297.0, 420.0)}
# Margin of the paper, and height of the title block [mm].
MARGIN, BLOCK = 10.0, 30.0
Box = tuple[float, float, float, float]
# Side of the squares by which boxes are found [mm].
CELL = 8.0


@dataclass(frozen=True, slots=True)
class Paper:
    """A sheet, or a picture on one, by its width and height, its margin and the height of its title block [mm]."""

    width: float
    height: float
    margin: float = MARGIN
    block: float = BLOCK

    @property
    def room(self) -> Box:
        """Left, bottom, right and top of the area above the title block [mm]."""
        return self.margin, self.margin + self.block, self.width - self.margin, self.height - self.margin


def box_about(x: float, y: float, wide: float, high: float) -> Box:
    """Left, bottom, right and top of a box about a point."""
    return x - 0.5 * wide, y - 0.5 * high, x + 0.5 * wide, y + 0.5 * high


class TextRoom:
    """Where text may stand. State: boxes that are taken, each in all squares of CELL that it reaches."""

    def __init__(self) -> None:
        self._cells = defaultdict[tuple[int, int], set[Box]](set)

    def take(self, boxes: Floats) -> None:
        """Keep text out of boxes (N, 4). They are rounded, so that thousands on one spot are a few."""
        for left, low, right, high in np.round(boxes.reshape(-1, 4), 1).tolist():
            for cell in _cells_of((left, low, right, high)):
                self._cells[cell].add((left, low, right, high))

    def is_free(self, box: Box) -> bool:
        """True if a box overlaps none that is taken."""
        left, low, right, high = box
        return not any(
            one[0] < right and one[1] < high and one[2] > left and one[3] > low
            for cell in _cells_of(box)
            for one in self._cells.get(cell, ())
        )

    def first_free(
        self, wide: float, high: float, places: Iterable[Sequence[float]], room: Box
    ) -> tuple[float, float] | None:
        """The first place where a text of that size about it is inside the room and overlaps nothing; it is taken."""
        left, low, right, top = room
        for x, y in places:
            box = box_about(x, y, wide, high)
            inside = box[0] > left and box[1] > low and box[2] < right and box[3] < top
            if inside and self.is_free(box):
                self.take(np.array(box))
                return float(x), float(y)
        return None


def _cells_of(box: Box) -> Iterator[tuple[int, int]]:
    """The squares of CELL on the largest paper that a box reaches."""
    columns, rows = (
        range(int(max(first, 0.0) // CELL), int(min(last, PAPERS["A3"][1]) // CELL) + 1)
        for first, last in ((box[0], box[2]), (box[1], box[3]))
    )
    return product(columns, rows)


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

    def sheet(self, subtitle: str, paper: Paper) -> dict[str, Any]:
        """A sheet as the template takes it, with this title block. subtitle: what it shows"""
        size = {"width": paper.width, "height": paper.height}
        return {**size, **{one.name: getattr(self, one.name) for one in fields(self)}, "subtitle": subtitle}
