"""The tables of a sheet, in whichever layout it has.

Input: a grid of cells. Output: its tables, and remarks on a sheet that holds none of the contest's. State: none.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import replace

import numpy as np

from app.grade.expected import Workbook, times_of
from app.grade.grid import Cells, Grid, normalized
from app.grade.handles import names_in
from app.grade.labels import SPEED_WORD, X, Y
from app.grade.layout import (
    COMPONENTS,
    SHEETS,
    Orientation,
    SheetTable,
    TableKind,
    bare_tables,
    holds_angles,
    holds_curve,
    wide_tables,
)
from app.grade.lists import lists_of
from app.grade.words import note

# Most cells of a sheet, blanks included: a list of result1 has 337,120.
RECTANGLE_MAX = 2_000_000
# Zeros after the decimal point, two at least, because programs write one of their own.
ZEROS = re.compile(r"[.,](0{2,})\s*$")
# Words for places in the title of a sheet.
PLACE_WORD = re.compile(r"位置|坐标|position|coordinate", re.IGNORECASE)


def tables_of(grids: Sequence[Grid]) -> list[SheetTable]:
    """The tables of the sheets of a file. The notes of each grid say what was left out."""
    every = [Orientation(grid.title, _rectangle(grid)) for grid in grids]
    sides = (side for upright in every for side in (upright, upright.swapped()))
    named = next(filter(None, (names_in(side.cells) for side in sides)), frozenset())
    tables = [table for grid, upright in zip(grids, every, strict=True) for table in _tables_of(grid, upright, named)]
    return at_contact(with_both_axes(tables))


def _tables_of(grid: Grid, upright: Orientation, named: frozenset[int]) -> list[SheetTable]:
    """The tables of a sheet; none if no numbers are recognised. named: handles that have names in the file"""
    if not upright.cells:
        return []
    if holds_angles(upright):
        grid.notes.append(note("angles", title=grid.title))
        return []
    if holds_curve(upright.cells):
        grid.notes.append(note("curve"))
        return []
    tables = [replace(one, shown=_shown(one, grid.words)) for one in next(filter(None, _readings(upright, named)), [])]
    # The title of a sheet does not tell one table of it from another.
    return [_titled(table) for table in tables] if len(tables) == 1 else [replace(table, title="") for table in tables]


def _shown(table: SheetTable, words: list[list[str]] | None) -> int | None:
    """The fewest decimals of most of the numbers of a table that are all whole, such as 1.00; None for other ones."""
    known = np.isfinite(table.values)
    if words is None or not known.any() or (table.values[known] % 1.0).any():
        return None
    places = zip(table.row[known].tolist(), table.column[known].tolist(), strict=True)
    counts = [len(found[1]) for row, column in places if (found := ZEROS.search(words[row][column]))]
    return int(np.median(counts)) if 2 * len(counts) > known.sum() else None


def _readings(upright: Orientation, named: frozenset[int]) -> Iterator[list[SheetTable]]:
    """What a sheet may hold, the surest first: a list, lines of handles with names, with numbers, or without labels."""
    yield lists_of(upright)
    sides = upright, upright.swapped()
    for numbered in (False, True):
        yield from (wide_tables(side, numbered=numbered, named=named) for side in sides)
    yield from map(bare_tables, sides)


def _titled(table: SheetTable) -> SheetTable:
    """The table, with a remark where the title of its sheet names the other kind."""
    words = normalized(table.title)
    names = (TableKind.POSITION, PLACE_WORD.search(words)), (TableKind.SPEED, SPEED_WORD.search(words))
    named = [kind for kind, match in names if match]
    if table.kind is TableKind.CONTACT or len(named) != 1 or table.kind in named:
        return table
    remark = note("titled_otherwise", title=table.title, kind=note(SHEETS[table.kind]))
    return replace(table, notes=[*table.notes, remark])


def with_both_axes(tables: list[SheetTable]) -> list[SheetTable]:
    """The tables of a file; two of positions, of which one holds only x and the other only y, are one."""
    lacking = {axis: [one for one in tables if _lacks(one, axis)] for axis in (X, Y)}
    joined = dict(zip(map(id, lacking[Y]), map(_joined, lacking[Y], lacking[X]), strict=False))
    second = {id(one) for one in lacking[X][: len(joined)]}
    return [joined.get(id(one), one) for one in tables if id(one) not in second]


def _lacks(table: SheetTable, axis: int) -> bool:
    """True for a table of positions of which one axis has no numbers, but the other one has."""
    if table.kind is not TableKind.POSITION:
        return False
    has_numbers = _axes_of(table)
    return not has_numbers[axis] and has_numbers[1 - axis]


def _axes_of(table: SheetTable) -> list[bool]:
    """Whether x and y have numbers."""
    return [bool(np.isfinite(table.values[..., axis]).any()) for axis in (X, Y)]


def _joined(one: SheetTable, other: SheetTable) -> SheetTable:
    """The positions of two tables, of which each has one axis."""
    times = np.union1d(one.times, other.times)
    handles = np.array(list(dict.fromkeys([*one.handles.tolist(), *other.handles.tolist()])))
    places = {handle: n for n, handle in enumerate(handles.tolist())}
    shape = (times.size, handles.size, len(COMPONENTS[TableKind.POSITION]))
    values, row, column = np.full(shape, np.nan), np.zeros(shape, dtype=np.int64), np.zeros(shape, dtype=np.int64)
    for table in (one, other):
        axes = np.flatnonzero(_axes_of(table))
        lines = np.array([places[handle] for handle in table.handles.tolist()])
        at = np.ix_(np.searchsorted(times, table.times), lines, axes)
        for whole, part in ((values, table.values), (row, table.row), (column, table.column)):
            whole[at] = part[..., axes]
    are_alike = np.array_equal(one.handles, handles) and np.array_equal(other.handles, handles)
    by_order = one.by_order if are_alike else handles
    title = " / ".join(dict.fromkeys(table.title for table in (one, other) if table.title))
    notes = [*one.notes, *(remark for remark in other.notes if remark not in one.notes)]
    return SheetTable(title, one.kind, times, handles, by_order, values, row, column, notes)


def at_contact(tables: list[SheetTable]) -> list[SheetTable]:
    """The tables of a file at one instant that only result2 can have, as one; others as they are."""
    by_kind = {table.kind: table for table in tables}
    first = by_kind.get(TableKind.POSITION)
    if first is None or len(by_kind) != len(tables) or any(not _is_of_result2(table) for table in tables):
        return tables
    speed = by_kind.get(TableKind.SPEED)
    if speed is None:
        blank, nowhere = np.full_like(first.values[..., :1], np.nan), np.zeros_like(first.row[..., :1])
        speed = replace(first, values=blank, row=nowhere, column=nowhere, notes=[])
    elif not np.array_equal(speed.handles, first.handles):
        return tables
    parts = first, speed
    joined = replace(
        first,
        title=" / ".join(dict.fromkeys(table.title for table in tables)),
        kind=TableKind.CONTACT,
        values=np.concatenate([one.values for one in parts], axis=-1),
        row=np.concatenate([one.row for one in parts], axis=-1),
        column=np.concatenate([one.column for one in parts], axis=-1),
        notes=[*first.notes, *speed.notes],
    )
    return [joined]


def _is_of_result2(table: SheetTable) -> bool:
    """True for one instant that result1 and result4 do not have."""
    others = np.concatenate([times_of(Workbook.RESULT1), times_of(Workbook.RESULT4)])
    return table.times.size == 1 and bool(np.isfinite(table.times[0])) and table.times[0] not in others


def _rectangle(grid: Grid) -> Cells:
    """The cells as a rectangle that begins at the first one; cut off where a stray cell makes it too large."""
    width = max((k + 1 for row in grid.rows for k, cell in enumerate(row) if cell is not None), default=0)
    height = max((k + 1 for k, row in enumerate(grid.rows) if any(cell is not None for cell in row)), default=0)
    height = min(height, RECTANGLE_MAX // max(width, 1))
    return [(list(row) + [None] * width)[:width] for row in grid.rows[:height]]
