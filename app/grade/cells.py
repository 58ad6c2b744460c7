"""Numbers in cells, and remarks on cells that hold text instead.

Input: cells with their places. Output: numbers, NaN where there is none, and notes. State: `OddCells` counts the texts,
so that 80,000 cells with the same text give one note.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, field

import numpy as np

from app.files.workbooks import letters_of
from app.grade.grid import Cell, normalized
from app.grade.words import Note, note

# Most texts that are quoted, and most characters of each.
TEXTS_MOST, TEXT_LENGTH = 3, 30
# A unit of the contest behind a number.
UNIT = re.compile(r"(?<=[\d.])\s*(m/s|m|米/秒|米)$")


def cell_name(row: int, column: int) -> str:
    """Name of a cell in a spreadsheet; row and column are counted from 0.

    >>> cell_name(1, 27)
    'AB2'
    """
    return f"{letters_of(column)}{row + 1}"


@dataclass
class OddCells:
    """Cells of a table with text in the place of a number.

    turned: True if rows and columns of the sheet were swapped
    numbers: places of numbers stored as text; texts: places of each other text
    """

    turned: bool = False
    numbers: list[str] = field(default_factory=list)
    texts: dict[str, list[str]] = field(default_factory=dict)

    def value(self, cell: Cell, row: int, column: int) -> float:
        """Number in a cell, also as text, maybe with a decimal comma or its unit; NaN for a blank or other text."""
        if isinstance(cell, float):
            return cell
        if cell is None:
            return float("nan")
        place, text = cell_name(*((column, row) if self.turned else (row, column))), normalized(cell)
        bare = UNIT.sub("", text)
        try:
            number = float("nan" if "_" in bare else bare.replace(",", "."))  # Python reads 8.8_0 as 8.8
        except ValueError:
            number = float("nan")
        if np.isfinite(number):
            self.numbers.append(place)
            return number
        self.texts.setdefault(text[:TEXT_LENGTH], []).append(place)
        return float("nan")

    def notes(self) -> list[Note]:
        """One remark on each text, and one on the numbers that are stored as text."""
        kinds = [("text", {"text": text}, places) for text, places in self.texts.items()]
        remarks = [_remark_on(*kind) for kind in kinds[:TEXTS_MOST]]
        if self.numbers:
            remarks.append(_remark_on("text_number", {}, self.numbers))
        more = sum(len(places) for _, _, places in kinds[TEXTS_MOST:])
        return [*remarks, note("more_text", count=more)] if more else remarks


def _remark_on(code: str, values: dict[str, str], places: list[str]) -> Note:
    """The remark on one cell, or the one on several with their number and the first."""
    if len(places) == 1:
        return note(code, cell=places[0], **values)
    return note(f"{code}s", cell=places[0], count=f"{len(places):,}", **values)
