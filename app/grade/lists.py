"""Lists with a line for each handle and instant: time, handle, x, y, speed, in any order and under many names.

Input: the cells of a sheet. Output: tables of positions and speeds, or none. State: none.
"""

from __future__ import annotations

import re

import numpy as np

from app.grade.grid import Cell, Cells, normalized
from app.grade.handles import BENCHES, EXTRA_MOST, HANDLES, LABELS_LEAST, Ints
from app.grade.labels import TIME_WORD, heading_of, instant_of, is_handle_heading, label_of, stated_instant
from app.grade.layout import COMPONENTS, MARGIN, OVER_TIME, Numbers, SheetTable, Side, TableKind
from core.values import Floats

# Lines whose labels are looked at.
LOOK = 20
NUMBER = re.compile(r"\d+")
# Columns by what they hold: "time", "handle", "x", "y" and "v".
Columns = dict[str, int]


def lists_of(side: Side) -> list[SheetTable]:
    """Tables of positions and of speeds in a list, or the one of an instant; none if the sheet is not a list."""
    cells = side.cells
    for head, row in enumerate(cells[:MARGIN]):
        columns = _columns(row)
        if "time" in columns and len(columns) > 1 and "handle" not in columns:
            columns |= _labelled(cells[head + 1 :], columns)
        if {"time", "handle"} <= columns.keys() and len(columns) > len(("time", "handle")):
            return _over_time(side, head, columns)
        if {"handle", "x", "y"} <= columns.keys() and _is_numbered(cells[head + 1 :], columns["handle"]):
            return _at_contact(side, head, columns)
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


def _over_time(side: Side, head: int, columns: Columns) -> list[SheetTable]:
    """Tables of a list with a line for each handle and instant."""
    placed = [(instant_of(row[columns["time"]]), _handle_of(row[columns["handle"]])) for row in side.cells]
    lines = [n for n, (time, handle) in enumerate(placed) if n > head and time is not None and handle is not None]
    if not lines:
        return []
    handles, h = _numbered([placed[n][1] or 0 for n in lines])
    times, t = np.unique(np.array([placed[n][0] for n in lines], dtype=np.float64), return_inverse=True)
    kinds = [kind for kind in OVER_TIME if _axes(kind) <= columns.keys()]
    return [_table_of(side, head, columns, kind, (times, t, handles, h, lines)) for kind in kinds]


def _at_contact(side: Side, head: int, columns: Columns) -> list[SheetTable]:
    """The table of a list with a line for each handle at one instant."""
    named = [_handle_of(row[columns["handle"]]) for row in side.cells]
    lines = [n for n, handle in enumerate(named) if n > head and handle is not None]
    if not LABELS_LEAST <= len(lines) <= HANDLES + EXTRA_MOST:
        return []
    handles, h = _numbered([named[n] or 0 for n in lines])
    stated = stated_instant([[side.title], *side.cells[: head + 1]])
    once = (np.array([stated], dtype=np.float64), np.zeros(len(lines), dtype=np.int64), handles, h, lines)
    return [_table_of(side, head, columns, TableKind.CONTACT, once)]


def _axes(kind: TableKind) -> set[str]:
    return {"xyv"[component] for component in COMPONENTS[kind]}


def _table_of(
    side: Side,
    head: int,
    columns: Columns,
    kind: TableKind,
    places: tuple[Floats, Ints, Ints, Ints, list[int]],
) -> SheetTable:
    """The table of one kind. places: the times and the handles, each with its place by line; and the lines"""
    times, t, handles, h, lines = places
    numbers = []
    for c, component in enumerate(COMPONENTS[kind]):
        if (k := columns.get("xyv"[component])) is not None:
            label = label_of(side.cells[head][k])
            numbers.append(Numbers((t, h, c), lines, k, label.unit if label else 1.0))
    return side.table(kind, times, handles, numbers)
