"""Plain grids of cells: the form of every file after reading."""

from __future__ import annotations

import unicodedata
from dataclasses import dataclass, field

from app.grade.words import Note

Cell = float | str | None


class UnreadableTable(Exception):
    """A file that cannot be graded. reason: with what to change"""

    def __init__(self, reason: Note) -> None:
        super().__init__(reason.code)
        self.reason = reason


@dataclass
class Grid:
    """Cells of one sheet, row by row; rows may differ in length.

    notes: remarks for the reader; words: the cells as they are written, if the file shows it
    """

    title: str
    rows: list[list[Cell]]
    notes: list[Note] = field(default_factory=list)
    words: list[list[str]] | None = None


def normalized(text: str) -> str:
    """Text without blanks at its ends, and with half-width brackets, letters and digits and an ASCII minus sign.

    >>> normalized(" 龙尾（后） ")
    '龙尾(后)'
    """
    return unicodedata.normalize("NFKC", text).replace("\u2212", "-").strip()
