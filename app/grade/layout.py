"""Layout of a sheet: the handle, the instant and the unit of every number.

Input: a grid of cells. Output: tables of positions, speeds, or both at one instant, with the place of every number in
the grid. State: none. Labels decide, in both languages and both orientations; without labels the order decides.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, field, replace
from enum import StrEnum

import numpy as np
from numpy.typing import NDArray

from app.grade.cells import OddCells
from app.grade.grid import Cell, Grid, normalized
from app.grade.labels import ANGLE, SPEED, SPEED_WORD, Label, X, Y, instant_of, label_of
from app.grade.words import Note
from core.values import Floats

Ints = NDArray[np.int64]

# Handles of the contest's dragon: the head's is 0, the rear one of the tail is the last.
BENCHES = 223
HANDLES = BENCHES + 1
# Number of first rows and columns that may hold labels.
MARGIN = 8
# Words for places, in a text that may name speeds too.
PLACE_WORD = re.compile(r"位置|坐标|position|coordinate", re.IGNORECASE)
# Fewer labels than this may be chance and are ignored.
LABELS_LEAST = 3


class TableKind(StrEnum):
    """Kind of a table: x and y; speeds; or x, y and speed at one instant."""

    POSITION = "position"
    SPEED = "speed"
    CONTACT = "contact"


# Title of a table by its kind, if its sheet has none.
SHEETS = {TableKind.POSITION: "position", TableKind.SPEED: "speeds", TableKind.CONTACT: "contact"}
COMPONENTS = {TableKind.POSITION: (X, Y), TableKind.SPEED: (SPEED,), TableKind.CONTACT: (X, Y, SPEED)}


@dataclass(frozen=True)
class SheetTable:
    """Numbers of a sheet and their places.

    times: (T,) [s]; one NaN for the instant of first contact
    handles: (H,) by their labels; values: (T, H, C), converted from the units of the labels to m and m/s, NaN where
        there is none; row, column: of the same shape, places in the grid from 0
    by_order: (H,) handles by their order in the sheet
    """

    title: str
    kind: TableKind
    times: Floats
    handles: Ints
    by_order: Ints
    values: Floats
    row: Ints
    column: Ints
    notes: list[Note] = field(default_factory=list)


def wide_table(grid: Grid, cells: list[list[Cell]], *, turned: bool) -> SheetTable | None:
    """The table of a sheet with a line for each handle. turned: True if rows and columns of the sheet were swapped"""
    labels = _label_columns(cells)
    counts = [sum(label is not None and label.handle is not None for label in column) for column in labels]
    aside = int(np.argmax(counts))
    if counts[aside] < LABELS_LEAST:
        return None
    first = next(k for k, label in enumerate(labels[aside]) if label and label.handle is not None)
    heads = cells[max(0, first - MARGIN) : first]
    lines = _lines(labels[aside])
    components = {k: label.component for k, label in _head_labels(heads, aside).items()}
    if {X, Y} <= set(components.values()) and len(components) <= len(COMPONENTS[TableKind.CONTACT]) + 1:
        return _contact(grid, cells, lines, _head_labels(heads, aside), turned)
    return _over_time(
        grid, cells, lines, _times(heads, cells, aside), _names_speeds(grid, heads, cells, turned), turned
    )


def _names_speeds(grid: Grid, heads: list[list[Cell]], cells: list[list[Cell]], turned: bool) -> bool:
    """True if the title of a sheet, or a text before its numbers, names speeds and no places."""
    above = [row[0] for row in cells[:MARGIN]] if turned else []
    texts = [grid.title, *(cell for row in heads for cell in row), *above]
    words = " ".join(normalized(text) for text in texts if isinstance(text, str))
    return SPEED_WORD.search(words) is not None and PLACE_WORD.search(words) is None


def _label_columns(cells: list[list[Cell]]) -> list[list[Label | None]]:
    """Meaning of every cell in the first columns."""
    return [[label_of(row[k]) for row in cells] for k in range(min(MARGIN, len(cells[0])))]


def holds_angles(grid: Grid, cells: list[list[Cell]]) -> bool:
    """True if a sheet says that it holds angles, and names neither a place nor a speed."""
    texts = [grid.title, *(cell for row in cells for cell in row[:MARGIN] if isinstance(cell, str))]
    texts += [cell for row in cells[:MARGIN] for cell in row if isinstance(cell, str)]
    components = {label.component for text in texts if (label := label_of(text))}
    return ANGLE in components and not components & {X, Y, SPEED}


def _head_labels(heads: list[list[Cell]], aside: int) -> dict[int, Label]:
    """Columns whose heading names x, y or a speed but no handle."""
    columns = {}
    for row in heads:
        for k, cell in enumerate(row):
            label = label_of(cell)
            if k != aside and label and label.component in COMPONENTS[TableKind.CONTACT] and label.handle is None:
                columns[k] = label
    return columns


def _lines(labels: list[Label | None]) -> list[tuple[int, Label]]:
    """Lines with their labels. Where most labels without an axis stand above a line without one, that line is their y
    (merged cells); one such line alone is a remark below the table, or a blank."""
    lines = [(k, label) for k, label in enumerate(labels) if label is not None and label.handle is not None]
    open_below = {k for k, label in lines if label.component is None and labels[k + 1 : k + 2] == [None]}
    if 2 * len(open_below) <= len(lines):
        return lines
    expanded: list[tuple[int, Label]] = []
    for k, label in lines:
        both = [(k, replace(label, component=X)), (k + 1, replace(label, component=Y))]
        expanded += both if k in open_below else [(k, label)]
    return expanded


def _times(heads: list[list[Cell]], cells: list[list[Cell]], aside: int) -> dict[int, float]:
    """Columns and their instants; by their order if no heading gives them."""
    instants = (
        {k: t for k, cell in enumerate(row) if k > aside and (t := instant_of(cell)) is not None} for row in heads
    )
    best: dict[int, float] = max(instants, key=len, default={})
    if best and np.all(np.diff(list(best.values())) > 0):
        return best
    columns = range(aside + 1, len(cells[0]))
    start = -100.0 if len(columns) == 201 else 0.0
    return {k: start + n for n, k in enumerate(columns)}


def _numbered(lines: list[tuple[int, Label]]) -> tuple[Ints, Ints]:
    """Handle of every line, by its label and by its order. The tail follows the last body bench with a label."""
    handles = [label.handle for _, label in lines if label.handle is not None]
    assert len(handles) == len(lines)
    last = max([BENCHES - 2, *handles])
    by_label = [handle if handle >= 0 else last - handle for handle in handles]
    order = {handle: n for n, handle in enumerate(dict.fromkeys(by_label))}
    return np.array(by_label), np.array([order[handle] for handle in by_label])


def _over_time(
    grid: Grid,
    cells: list[list[Cell]],
    lines: list[tuple[int, Label]],
    times: dict[int, float],
    names_speeds: bool,
    turned: bool,
) -> SheetTable | None:
    """Positions or speeds of handles at instants. says_speed: whether a text beside the numbers names speeds"""
    components = {label.component for _, label in lines}
    by_speed = SPEED in components or (X not in components and names_speeds)
    if not by_speed and X not in components:
        # Labels without an axis: two lines for each handle are x above y.
        twice = len(lines) > 1 and lines[0][1].handle == lines[1][1].handle
        if twice:
            lines = [(k, replace(label, component=n % 2)) for n, (k, label) in enumerate(lines)]
        by_speed = not twice
    if by_speed:
        lines = [(k, replace(label, component=SPEED)) for k, label in lines if label.component in (None, SPEED)]
    return _table_of(grid, cells, TableKind.SPEED if by_speed else TableKind.POSITION, lines, times, turned)


def _contact(
    grid: Grid, cells: list[list[Cell]], lines: list[tuple[int, Label]], heads: dict[int, Label], turned: bool
) -> SheetTable:
    """x, y and speed of handles at one instant."""
    columns = {label.component: (k, label.unit) for k, label in heads.items()}
    rows = [k for k, _ in lines]
    shape = (1, len(rows), len(COMPONENTS[TableKind.CONTACT]))
    values, row, column = np.full(shape, np.nan), np.zeros(shape, dtype=np.int64), np.zeros(shape, dtype=np.int64)
    odd = OddCells(turned)
    for component, (k, unit) in columns.items():
        assert component is not None
        values[0, :, component] = [odd.value(cells[n][k], n, k) * unit for n in rows]
        row[0, :, component], column[0, :, component] = rows, k
    above, aside = (column, row) if turned else (row, column)
    return SheetTable(
        grid.title, TableKind.CONTACT, np.array([np.nan]), *_numbered(lines), values, above, aside, odd.notes()
    )


def _table_of(
    grid: Grid,
    cells: list[list[Cell]],
    kind: TableKind,
    lines: list[tuple[int, Label]],
    times: dict[int, float],
    turned: bool,
) -> SheetTable | None:
    """The table of the given lines and instants."""
    components = COMPONENTS[kind]
    lines = [(k, label) for k, label in lines if label.component in components]
    if not lines or not times:
        return None
    by_label, places = _numbered(lines)
    handles = np.array(list(dict.fromkeys(by_label.tolist())))
    shape = (len(times), handles.size, len(components))
    values, row, odd = np.full(shape, np.nan), np.zeros(shape, dtype=np.int64), OddCells(turned)
    for (k, label), place in zip(lines, places, strict=True):
        at = (slice(None), place, components.index(label.component or 0))
        values[at] = [odd.value(cells[k][n], k, n) * label.unit for n in times]
        row[at] = k
    column = np.broadcast_to(np.array(list(times), dtype=np.int64)[:, None, None], shape)
    above, aside = (column, row) if turned else (row, column)
    instants = np.array(list(times.values()))
    return SheetTable(grid.title, kind, instants, handles, np.arange(handles.size), values, above, aside, odd.notes())


def bare_table(grid: Grid, cells: list[list[Cell]]) -> SheetTable | None:
    """A table of numbers without labels of handles, recognised by its size."""
    numeric = [k for k, row in enumerate(cells) if sum(isinstance(cell, float) for cell in row) > len(row) // 2]
    # A line of numbers above those of the handles can only hold times.
    first = next((k for k in numeric[:2] if len(cells) - k in (HANDLES, 2 * HANDLES)), None)
    if first is None:
        return None
    twice = len(cells) - first == 2 * HANDLES
    numbered = enumerate(range(first, len(cells)))
    lines = [(k, Label(n // 2 if twice else n, n % 2 if twice else SPEED, 1.0)) for n, k in numbered]
    aside = next(k for k, cell in enumerate(cells[first]) if isinstance(cell, float)) - 1
    if not twice and len(cells[first]) - aside - 1 == len(COMPONENTS[TableKind.CONTACT]):
        heads = {aside + 1 + c: Label(None, c, 1.0) for c in COMPONENTS[TableKind.CONTACT]}
        return _contact(grid, cells, lines, heads, False)
    kind = TableKind.POSITION if twice else TableKind.SPEED
    return _table_of(grid, cells, kind, lines, _times(cells[:first], cells, aside), False)
