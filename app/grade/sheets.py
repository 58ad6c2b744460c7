"""The tables of a sheet, in whichever layout it has.

Input: a grid of cells. Output: its tables, and remarks on a sheet that holds none of the contest's. State: none.
"""

from __future__ import annotations

from app.grade.grid import Cell, Grid
from app.grade.layout import SheetTable, bare_table, holds_angles, wide_table
from app.grade.lists import lists_of
from app.grade.words import note

# Most cells of a sheet, blanks included: a list of result1 has 337,120.
RECTANGLE_MAX = 2_000_000


def tables_of(grid: Grid) -> list[SheetTable]:
    """The tables of a sheet; none if no numbers are recognised. The grid's notes say what was left out."""
    cells = _rectangle(grid)
    if not cells:
        return []
    if holds_angles(grid, cells):
        grid.notes.append(note("angles", title=grid.title))
        return []
    if long := lists_of(grid, cells):
        return long
    turned = [list(line) for line in zip(*cells, strict=True)]
    table = wide_table(grid, cells, turned=False) or wide_table(grid, turned, turned=True) or bare_table(grid, cells)
    return [table] if table else []


def _rectangle(grid: Grid) -> list[list[Cell]]:
    """The cells as a rectangle that begins at the first one; cut off where a stray cell makes it too large."""
    width = max((k + 1 for row in grid.rows for k, cell in enumerate(row) if cell is not None), default=0)
    height = max((k + 1 for k, row in enumerate(grid.rows) if any(cell is not None for cell in row)), default=0)
    height = min(height, RECTANGLE_MAX // max(width, 1))
    return [(list(row) + [None] * width)[:width] for row in grid.rows[:height]]
