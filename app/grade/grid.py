"""Plain grids of cells: the form of every file after reading."""

from __future__ import annotations

import re
import unicodedata
from dataclasses import dataclass, field

from app.grade.words import Note

Cell = float | str | None
Cells = list[list[Cell]]
# A speed's unit with a power, as in "m·s-1"; and a unit after a slash, as in "x/m" and "v/(m/s)".
PER_SECOND = re.compile(r"(?<=[m米])\s*[·⋅•*.]\s*(s|秒)\s*\^?\s*(?:-1|\(-1\)|\{-1\})", re.IGNORECASE)
A_UNIT = r"(?:[cm]?m|厘米|毫米|米|rad|deg|°|弧度|度|s|秒)(?:\s*/\s*(?:s|秒))?"
AFTER_SLASH = re.compile(
    rf"(?<![m米])\s*/\s*(?:[(\[]\s*({A_UNIT})\s*[)\]]|({A_UNIT})(?=$|[\s,;:=(\[_]))", re.IGNORECASE
)


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
    rows: Cells
    notes: list[Note] = field(default_factory=list)
    words: list[list[str]] | None = None


def normalized(text: str) -> str:
    """Text without blanks at its ends, and with half-width brackets, letters and digits and an ASCII minus sign; a unit
    after a slash stands in brackets.

    >>> normalized(" 龙尾（后） "), normalized("速度/(m/s)")
    ('龙尾(后)', '速度 (m/s)')
    """
    plain = unicodedata.normalize("NFKC", text).replace("\u2212", "-").strip()
    return AFTER_SLASH.sub(lambda found: f" ({found[1] or found[2]})", PER_SECOND.sub(r"/\1", plain))
