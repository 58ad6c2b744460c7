"""Tables of benches in workbooks (.xlsx), as the CSV that a request takes."""

from __future__ import annotations

import csv
import io

from app.files.words import Say
from app.grade.grid import Cell, Grid, UnreadableTable
from app.grade.workbook import sheets_of
from core import Budget, InvalidValue


def benches_of(data: bytes, budget: Budget, say: Say) -> tuple[str, list[str]]:
    """The first sheet of a workbook that is not empty as CSV, and notes on what is left out.

    raises: InvalidValue at the field `file`; MissingPackage without openpyxl; Halted when the budget ends
    """
    try:
        grids, notes = sheets_of(data, budget)
    except UnreadableTable as error:
        raise InvalidValue.in_words(
            "file", "{sentence}", sentence=error.said.said(say.language).rstrip(".。")
        ) from error
    filled = [grid for grid in grids if any(cell is not None for row in grid.rows for cell in row)]
    if not filled:
        raise InvalidValue("file", "must have a sheet with benches, one in a line", got="empty sheets")
    told = [note.said(say.language) for note in (*notes, *filled[0].notes)]
    if len(filled) > 1:
        others = ", ".join(grid.title for grid in filled[1:])
        told.append(
            say(
                f"The benches are those of sheet {filled[0].title}; left out: {others}.",
                f"板凳取自工作表 {filled[0].title}；未读取：{others}。",
            )
        )
    return _csv(filled[0]), told


def _csv(grid: Grid) -> str:
    text = io.StringIO()
    rows = ([_entry(cell) for cell in row] for row in grid.rows)
    csv.writer(text, lineterminator="\n").writerows(row for row in rows if any(row))
    return text.getvalue()


def _entry(cell: Cell) -> str:
    """A cell as an entry; whole numbers as they are typed, because a name may be one."""
    return "" if cell is None else cell if isinstance(cell, str) else repr(cell).removesuffix(".0")
