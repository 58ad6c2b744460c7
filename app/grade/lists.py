"""Lists with a line for each handle and instant: time, handle, x, y, speed, in any order and under many names.

Input: the cells of a sheet. Output: tables of positions and speeds, or none. State: none.
"""

from __future__ import annotations

import re
from collections.abc import Sequence

import numpy as np

from app.grade.grid import Cell, Cells, normalized
from app.grade.handles import BENCHES, EXTRA_MOST, HANDLES, LABELS_LEAST, Ints
from app.grade.labels import TIME_WORD, heading_of, instant_of, is_handle_heading, label_of, stated_instant
from app.grade.layout import COMPONENTS, MARGIN, OVER_TIME, Numbers, Orientation, SheetTable, TableKind

# Lines whose labels are looked at.
LOOK = 20
NUMBER = re.compile(r"\d+")
# Columns by what they hold: "time", "handle", "x", "y" and "v".
Columns = dict[str, int]


def lists_of(side: Orientation) -> list[SheetTable]:
    """Tables of positions and of speeds in a list, or the one of an instant; none if the sheet is not a list."""
    for head, row in enumerate(side.cells[:MARGIN]):
        columns, below = _columns(row), side.cells[head + 1 :]
        if "time" in columns and len(columns) > 1 and "handle" not in columns:
            columns |= _labelled(below, columns)
        if {"time", "handle"} <= columns.keys() and len(columns) > len(("time", "handle")):
            kinds = [kind for kind in OVER_TIME if columns.keys() >= set(_axes(kind))]
            return _tables_of(side, head, columns, kinds, [instant_of(line[columns["time"]]) for line in below])
        if {"handle", "x", "y"} <= columns.keys() and _is_numbered(below, columns["handle"]):
            count = sum(_handle_of(line[columns["handle"]]) is not None for line in below)
            if not LABELS_LEAST <= count <= HANDLES + EXTRA_MOST:
                return []
            stated = stated_instant([[side.title], *side.cells[: head + 1]])
            instant = np.nan if stated is None else stated
            return _tables_of(side, head, columns, [TableKind.CONTACT], [instant] * len(below))
    return []


def _columns(heads: list[Cell]) -> Columns:
    """Columns of the time, the handle, x, y and v; the first of each."""
    columns: Columns = {}
    for k, cell in enumerate(heads):
        name, (time, label) = normalized(cell) if isinstance(cell, str) else "", heading_of(cell)
        if time is not None:
            continue  # A column of one instant, which no list has.
        if TIME_WORD.search(name):
            columns.setdefault("time", k)
        elif label and label.handle is None and label.component is not None and label.component < len("xyv"):
            columns.setdefault("xyv"[label.component], k)
        elif is_handle_heading(name):
            columns.setdefault("handle", k)
    return columns


def _handle_of(cell: Cell) -> int | None:
    """Number of a handle in a cell: a number, a label, or a text with a number."""
    if isinstance(cell, float):
        return int(cell) if cell.is_integer() else None
    if not isinstance(cell, str):
        return None
    if (label := label_of(cell)) and label.handle is not None:
        return label.handle
    number = NUMBER.search(normalized(cell))
    return int(number[0]) if number else None


def _labelled(rows: Cells, columns: Columns) -> Columns:
    """The column with labels of handles, where no heading names one."""
    for k in range(len(rows[0]) if rows else 0):
        labels = [label_of(row[k]) for row in rows[:LOOK]]
        if k not in columns.values() and labels and all(label and label.handle is not None for label in labels):
            return {"handle": k}
    return {}


def _is_numbered(rows: Cells, k: int) -> bool:
    """True if a column numbers the handles instead of naming them, each once."""
    numbers = [row[k] for row in rows if isinstance(row[k], float)]
    return 2 * len(numbers) > len(rows) and len(set(numbers)) == len(numbers)


def _numbered(labels: list[int]) -> tuple[Ints, Ints]:
    """The handles in their order, and the place of each line among them; the tail follows the last body bench. Numbers
    from 1 to that of all handles count from 1."""
    last = max([BENCHES - 2, *labels])
    handles, places = np.unique([one if one >= 0 else last - one for one in labels], return_inverse=True)
    counts_from_one = handles.size == HANDLES == handles[-1] and handles[0] == 1
    return handles - int(counts_from_one), places


def _tables_of(
    side: Orientation, head: int, columns: Columns, kinds: list[TableKind], instants: Sequence[float | None]
) -> list[SheetTable]:
    """Tables of a list, from its lines that have an instant and a handle. instants: of each line below the head [s]"""
    named = [_handle_of(line[columns["handle"]]) for line in side.cells[head + 1 :]]
    lines = [n for n, both in enumerate(zip(instants, named, strict=True)) if None not in both]
    if not lines:
        return []
    handles, h = _numbered([named[n] or 0 for n in lines])
    times, t = np.unique(np.array([instants[n] for n in lines], dtype=np.float64), return_inverse=True)
    rows = [head + 1 + n for n in lines]
    tables = []
    for kind in kinds:
        axes = [(c, columns[axis]) for c, axis in enumerate(_axes(kind)) if axis in columns]
        numbers = (Numbers((t, h, c), rows, k, _unit_of(side.cells[head][k])) for c, k in axes)
        tables.append(side.table(kind, times, handles, numbers))
    return tables


def _axes(kind: TableKind) -> list[str]:
    return ["xyv"[component] for component in COMPONENTS[kind]]


def _unit_of(heading: Cell) -> float:
    """The factor from the unit of a column to m or m/s."""
    label = label_of(heading)
    return label.unit if label else 1.0
