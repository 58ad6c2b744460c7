"""Tables of benches in workbooks (.xlsx), as the CSV that a request takes."""

from __future__ import annotations

import csv
import io

from app.grade.grid import Cell, Grid, UnreadableTable
from app.grade.workbook import sheets_of
from core import Budget, InvalidValue
from core.language import Listed, say


def benches_of(data: bytes, budget: Budget) -> tuple[str, list[str]]:
    """The first sheet of a workbook that is not empty as CSV, and notes on what is left out.

    raises: InvalidValue at the field `file`; MissingPackage without openpyxl; Halted when the budget ends
    """
    try:
        grids, notes = sheets_of(data, budget)
    except UnreadableTable as error:
        raise InvalidValue.in_words("file", "{sentence}", sentence=str(error.reason).rstrip(".。")) from error
    sheets = [grid for grid in grids if any(cell is not None for row in grid.rows for cell in row)]
    if not sheets:
        raise InvalidValue("file", "must have a sheet with benches, one in a line", got="empty sheets")
    remarks = [str(note) for note in (*notes, *sheets[0].notes)]
    if len(sheets) > 1:
        others = Listed(grid.title for grid in sheets[1:])
        remarks.append(
            say("The benches are those of sheet {title}; left out: {others}.", title=sheets[0].title, others=others)
        )
    return _csv(sheets[0]), remarks


def _csv(grid: Grid) -> str:
    text = io.StringIO()
    rows = ([_entry(cell) for cell in row] for row in grid.rows)
    csv.writer(text, lineterminator="\n").writerows(row for row in rows if any(row))
    return text.getvalue()


def _entry(cell: Cell) -> str:
    """A cell as an entry; whole numbers as they are typed, because a name may be one."""
    return "" if cell is None else cell if isinstance(cell, str) else repr(cell).removesuffix(".0")
