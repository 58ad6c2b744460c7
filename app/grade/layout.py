"""Layout of a sheet: the handle, the instant and the unit of every number.

Input: a grid of cells. Output: tables of positions, speeds, or both at one instant, with the place of every number in
the grid. State: none. Labels decide, in both languages and both orientations; without labels the order decides.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field, replace
from enum import StrEnum

import numpy as np

from app.grade.cells import OddCells
from app.grade.grid import Cell, Cells, normalized
from app.grade.handles import (
    BENCHES,
    EXTRA_MOST,
    HANDLES,
    LABELS_LEAST,
    Ints,
    Labels,
    Line,
    count_of_handles,
    labels_in,
    lines_with_labels,
    names_in,
    names_of,
    numbered,
    numbering,
)
from app.grade.labels import (
    ANGLE,
    HANDLE_NAME,
    LENGTH,
    SPEED,
    TIME_WORD,
    Label,
    X,
    Y,
    heading_of,
    is_handle_heading,
    label_of,
    stated_instant,
)
from app.grade.words import Note
from core.values import Floats

# Columns of numbers by their instant [s], None for one that is not given, and component: place, and factor of the unit.
Columns = dict[tuple[float | None, int], tuple[int, float]]

# Handles and instants [s] of the tables that the paper of a solution prints, by the number of these: questions 1 and 4.
QUESTION_HANDLES = [0, 1, 51, 101, 151, 201, BENCHES]
QUESTION_TIMES = {len(times): times for times in (range(0, 301, 60), range(-100, 101, 50))}
# Number of first rows and columns that may hold labels.
MARGIN = 8
# Lines in which labels of a table beside another one are looked for, and most tables beside each other.
LINES_LOOKED_AT, TABLES_BESIDE_MOST = 20, 8


class TableKind(StrEnum):
    """Kind of a table: x and y; speeds; or x, y and speed at one instant."""

    POSITION = "position"
    SPEED = "speed"
    CONTACT = "contact"


# Title of a table by its kind, if its sheet has none.
SHEETS = {TableKind.POSITION: "position", TableKind.SPEED: "speeds", TableKind.CONTACT: "contact"}
# Kinds of tables over time.
OVER_TIME = (TableKind.POSITION, TableKind.SPEED)
COMPONENTS = {TableKind.POSITION: (X, Y), TableKind.SPEED: (SPEED,), TableKind.CONTACT: (X, Y, SPEED)}


@dataclass(frozen=True)
class SheetTable:
    """Numbers of a sheet and their places.

    times: (T,) [s]; of first contact the instant that the sheet states, or NaN
    handles: (H,) by their labels; values: (T, H, C), converted from the units of the labels to m and m/s, NaN where
        there is none; row, column: of the same shape, places in the grid from 0
    by_order: (H,) handles by their order in the sheet
    shown: decimals with which whole numbers are written, if all are whole and the file shows it; else None
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
    shown: int | None = None


@dataclass(frozen=True)
class Numbers:
    """Numbers of a table: where they stand in it, the rows and columns of their cells, and the factor of their unit."""

    at: tuple[Ints | int | slice, ...]
    row: Ints | list[int] | int
    column: Ints | list[int] | int
    unit: float


@dataclass(frozen=True)
class Orientation:
    """A sheet as its tables are read: upright, or with its rows and columns swapped.

    title: of the sheet; cells: a rectangle; turned: True if rows and columns were swapped
    """

    title: str
    cells: Cells
    turned: bool = False

    def swapped(self) -> Orientation:
        return Orientation(self.title, [list(line) for line in zip(*self.cells, strict=True)], not self.turned)

    def table(
        self, kind: TableKind, times: Floats, handles: Ints, numbers: Iterable[Numbers], by_order: Ints | None = None
    ) -> SheetTable:
        """A table of the sheet; handles without `by_order` stand in their order."""
        shape = (times.size, handles.size, len(COMPONENTS[kind]))
        values, row, column = np.full(shape, np.nan), np.zeros(shape, dtype=np.int64), np.zeros(shape, dtype=np.int64)
        odd = OddCells(self.turned)
        for part in numbers:
            row[part.at], column[part.at] = part.row, part.column
            places = zip(*(each.tolist() for each in np.broadcast_arrays(part.row, part.column)), strict=True)
            values[part.at] = [odd.value(self.cells[n][k], n, k) * part.unit for n, k in places]
        above, aside = (column, row) if self.turned else (row, column)
        order = np.arange(handles.size) if by_order is None else by_order
        return SheetTable(self.title, kind, times, handles, order, values, above, aside, odd.notes())


def wide_tables(side: Orientation, *, numbered: bool, named: frozenset[int] = frozenset()) -> list[SheetTable]:
    """The tables of a sheet with a line for each handle, below or beside each other; none if no column labels handles.

    numbered: True if numbers alone may label the handles; else they may in one table where names do in another
    named: handles that names label in other sheets of the file
    """
    tables: list[SheetTable] = []
    heads: Cells = []
    before, names = 0, named if numbered else names_in(side.cells)
    if not numbered and not names:
        return []
    for first, part in _beside(side.cells, names):
        columns = _first_columns(part, first)
        labels = [labels_in(column, names) for column in columns]
        # An index beside the names has as many numbers.
        counts = [count_of_handles(names_of(column)) for column in columns] if names else [0]
        if max(counts) < LABELS_LEAST:
            counts = [count_of_handles(column) for column in labels]
        if max(counts) < LABELS_LEAST:
            continue
        most = int(np.argmax(counts))
        aside = first + most
        heads = [([None] * (aside - before) + row)[: len(part[0])] for row in heads]
        before, end = aside, 0
        for lines in _blocks(part, lines_with_labels(labels[most])):
            above = part[max(end, lines[0][0] - MARGIN) : lines[0][0]]
            # A table without headings has those of the one above it, or beside it.
            heads = above if not heads or _columns(above, aside) or _instants(above, aside) else heads
            tables += _tables_of(replace(side, cells=part), lines, heads, aside)
            end = lines[-1][0] + 1
    return tables


def _beside(cells: Cells, names: frozenset[int]) -> list[tuple[int, Cells]]:
    """The tables that stand beside each other: the first column of each, and the cells without those of the others.

    A table begins with a column of labels that has numbers on both sides, and names other handles than the last one, or
    stands below another axis or beside the same instants.
    """
    rows = min(len(cells), MARGIN + LINES_LOOKED_AT)
    starts, last, end = [0], None, 0
    for k in range(len(cells[0])):
        labels = _labels_beside(cells, k, rows, names)
        if count_of_handles(labels) < LABELS_LEAST:
            continue
        lines = [n for n, label in enumerate(labels) if label and label.handle is not None]
        sides = range(end + 1, k), range(k + 1, len(cells[0]))
        if last is None:
            last = labels
        elif all(any(cells[n][c] is not None for n in lines for c in side) for side in sides) and (
            _differ(last, labels) or _repeat(cells[: lines[0]], starts[-1], end, k)
        ):
            starts.append(k)
            last = labels
        end = k
    if len(starts) > TABLES_BESIDE_MOST:
        starts = [0]
    ends = [*starts[1:], len(cells[0])]
    parts = zip(starts, ends, strict=True)
    return [(start, [[None] * start + row[start:end] for row in cells]) for start, end in parts]


def _labels_beside(cells: Cells, k: int, rows: int, names: frozenset[int]) -> Labels:
    """Labels in the first rows of a column."""
    some = names_of([row[k] for row in cells[:rows]])
    if names and count_of_handles(some) >= LABELS_LEAST:
        return some
    column = [row[k] for row in cells]
    first = next((cell for cell in column if isinstance(cell, float)), None)
    return numbering(column, names)[:rows] if first in (0.0, 1.0) else []


def _differ(labels: Labels, others: Labels) -> bool:
    """True if a line of two tables has labels of two handles, or of two components."""
    for label, other in zip(labels, others, strict=True):
        if other is None or other.handle is None:
            continue
        if label is None or label.handle != other.handle:
            return True
        if None not in (label.component, other.component) and label.component != other.component:
            return True
    return False


def _repeat(heads: Cells, start: int, end: int, k: int) -> bool:
    """True if two tables with equal labels, in the columns `end` and k, hold two axes, or the same instants again."""
    axes = [{_component_of(row[column]) for row in heads} - {None} for column in (end, k)]
    if all(axes) and axes[0].isdisjoint(axes[1]):
        return True
    left, right = (
        {time for row in heads for cell in row[side] if (time := heading_of(cell)[0]) is not None}
        for side in (slice(start, k), slice(k + 1, None))
    )
    return not left.isdisjoint(right)


def _component_of(cell: Cell) -> int | None:
    """x, y or speed, if a heading names it, and no handle."""
    label = heading_of(cell)[1]
    is_one = label and label.handle is None and label.component in COMPONENTS[TableKind.CONTACT]
    return label.component if label and is_one else None


def _tables_of(side: Orientation, lines: list[Line], heads: Cells, aside: int) -> list[SheetTable]:
    """The tables of some lines: those of their columns, if these are headed x and y; else those of their labels."""
    columns = _columns(heads, aside)
    if {X, Y} <= {component for _, component in columns}:
        return _by_columns(side, lines, heads, columns)
    times, stated = _times(heads, side.cells, aside), _stated(side.title, heads)
    if not columns and not _instants(heads, aside):
        handles = list(dict.fromkeys(numbered(lines)[0].tolist()))
        are_bare = all(label.component is None for _, label in lines) and len(handles) == len(lines)
        are_places = are_bare and _holds_places(side.cells[k][aside + 1 :] for k, _ in lines)
        if are_places and 1 < len(times) <= len(COMPONENTS[TableKind.CONTACT]):
            return _by_columns(side, lines, heads, _of_one_instant(list(times)))
        are_printed = handles == QUESTION_HANDLES and len(times) in QUESTION_TIMES
        if are_printed:
            times = dict(zip(times, map(float, QUESTION_TIMES[len(times)]), strict=True))
        is_unclear = not are_printed or (are_places and stated == SPEED)
        if is_unclear and len(handles) < HANDLES - EXTRA_MOST and isinstance(side.cells[lines[0][0]][aside], float):
            return []
    return _over_time(side, lines, times, stated)


def _holds_places(rows: Iterable[Sequence[Cell]]) -> bool:
    """True if a number is negative: places are on all sides of the centre, and speeds are not negative."""
    return any(isinstance(cell, float) and cell < 0.0 for row in rows for cell in row)


def _of_one_instant(columns: list[int]) -> Columns:
    """Columns without headings that hold x, y and perhaps the speed."""
    return {(None, component): (k, 1.0) for component, k in enumerate(columns)}


def _stated(title: str, heads: Cells) -> int:
    """The only component that headings name, or else the title of the sheet; the speed without one."""
    stated = {component for row in heads for cell in row if (component := _component_of(cell)) is not None}
    stated = stated or {component for component in [_component_of(title)] if component is not None}
    return stated.pop() if len(stated) == 1 else SPEED


def _blocks(cells: Cells, lines: list[Line]) -> list[list[Line]]:
    """Lines in tables that stand one below the other: each begins with the head again, below a line of its own."""
    blocks: list[list[Line]] = []
    for k, label in lines:
        before = blocks[-1][-1] if blocks else None
        is_new = before is None or (
            label.handle == 0
            and before[1].handle != 0
            and any(cell is not None for row in cells[before[0] + 1 : k] for cell in row)
        )
        if is_new:
            blocks.append([])
        blocks[-1].append((k, label))
    return blocks


def _first_columns(cells: Cells, first: int) -> Cells:
    """The columns from `first` on that may hold labels."""
    return [[row[k] for row in cells] for k in range(first, min(first + MARGIN, len(cells[0])))]


def holds_angles(side: Orientation) -> bool:
    """True if a sheet says that it holds angles, and names neither a place nor a speed."""
    components = {label.component for text in [side.title, *_margin(side.cells)] if (label := label_of(text))}
    return ANGLE in components and not components & {X, Y, SPEED}


def holds_curve(cells: Cells) -> bool:
    """True if a sheet has angles or radii beside x and y, but neither speeds nor handles, as a scan of a curve has."""
    texts = _margin(cells)
    labels = [label for text in texts if (label := label_of(text))]
    components, words = {label.component for label in labels}, [normalized(text) for text in texts]
    has_times = any(TIME_WORD.search(word) for word in words) and any(map(is_handle_heading, words))
    handles = {label.handle for label in labels if label.handle is not None}
    names_handles = len(handles) >= LABELS_LEAST or any(map(HANDLE_NAME.search, words))
    is_beside = {X, Y} <= components and bool(components & {ANGLE, LENGTH})
    return is_beside and SPEED not in components and not names_handles and not has_times


def _margin(cells: Cells) -> list[str]:
    """Texts in the first columns and rows."""
    texts = [cell for row in cells for cell in row[:MARGIN] if isinstance(cell, str)]
    return texts + [cell for row in cells[:MARGIN] for cell in row if isinstance(cell, str)]


def _columns(heads: Cells, aside: int) -> Columns:
    """Columns headed x, y or speed, but by no handle; the first of each. An instant may stand above several."""
    above = _instants(heads, aside)
    columns: Columns = {}
    labelled: dict[int, Label] = {}
    for row in heads:
        for k, cell in enumerate(row):
            time, label = heading_of(cell)
            if k != aside and label and label.component in COMPONENTS[TableKind.CONTACT] and label.handle is None:
                if time is None:
                    time = next((above[n] for n in range(k, aside, -1) if n in above), None)
                columns.setdefault((time, label.component), (k, label.unit))
                labelled.setdefault(k, label)
    for k in sorted(above.keys() - labelled.keys()):
        # An axis may stand above several instants.
        if (left := max((n for n in labelled if n < k), default=None)) is not None:
            columns.setdefault((above[k], labelled[left].component or X), (k, labelled[left].unit))
    return columns


def _instants(heads: Cells, aside: int) -> dict[int, float]:
    """Columns with an instant in their heading; of the line that has most of them."""
    return max(
        ({k: t for k, cell in enumerate(row) if k > aside and (t := heading_of(cell)[0]) is not None} for row in heads),
        key=len,
        default={},
    )


def _times(heads: Cells, cells: Cells, aside: int) -> dict[int, float]:
    """Columns and their instants; by their order if no heading gives them. Repeated ones are those of another table."""
    columns_at: dict[float, int] = {}
    for k, time in _instants(heads, aside).items():
        if time in columns_at:
            break
        columns_at[time] = k
    steps = np.diff(list(columns_at))
    if columns_at and (np.all(steps > 0) or np.all(steps < 0)):
        return {k: time for time, k in columns_at.items()}
    columns = range(aside + 1, len(cells[0]))
    start = -100.0 if len(columns) == 201 else 0.0
    return {k: start + n for n, k in enumerate(columns)}


def _over_time(side: Orientation, lines: list[Line], times: dict[int, float], stated: int = SPEED) -> list[SheetTable]:
    """Positions and speeds of handles at instants, in lines with labels of both.

    stated: component of lines whose labels name none
    """
    components = {label.component for _, label in lines}
    if not components & {X, Y, SPEED}:
        # Labels without an axis: two lines for each handle are x above y, and one line holds what is stated.
        twice = len(lines) > 1 and lines[0][1].handle == lines[1][1].handle
        lines = [(k, replace(label, component=n % 2 if twice else stated)) for n, (k, label) in enumerate(lines)]
    else:
        lines = [(k, replace(label, component=stated) if label.component is None else label) for k, label in lines]
    tables = (_table_of(side, kind, lines, times) for kind in OVER_TIME)
    return [table for table in tables if table]


def _by_columns(side: Orientation, lines: list[Line], heads: Cells, columns: Columns) -> list[SheetTable]:
    """Tables of columns for x, y and speed: at their instants, or at one that is stated above them, or not given."""
    times = sorted({time for time, _ in columns if time is not None})
    if not times:
        table = _columns_table(side, TableKind.CONTACT, lines, columns, [None])
        stated = stated_instant([[side.title], *heads])
        return [table if stated is None else replace(table, times=np.array([stated]))]
    timed = {component for time, component in columns if time is not None}
    kinds = [kind for kind in OVER_TIME if timed & set(COMPONENTS[kind])]
    return [_columns_table(side, kind, lines, columns, times) for kind in kinds]


def _columns_table(
    side: Orientation, kind: TableKind, lines: list[Line], columns: Columns, times: Sequence[float | None]
) -> SheetTable:
    """The table of columns for x, y or speed. times: of its instants [s]"""
    rows = [k for k, _ in lines]
    numbers = (
        Numbers((t, slice(None), c), rows, *columns[time, component])
        for t, time in enumerate(times)
        for c, component in enumerate(COMPONENTS[kind])
        if (time, component) in columns
    )
    handles, by_order = numbered(lines)
    return side.table(kind, np.array(times, dtype=np.float64), handles, numbers, by_order)


def _table_of(side: Orientation, kind: TableKind, lines: list[Line], times: dict[int, float]) -> SheetTable | None:
    """The table of the given lines and instants."""
    components = COMPONENTS[kind]
    lines = [(k, label) for k, label in lines if label.component in components]
    if not lines or not times:
        return None
    by_label, places = numbered(lines)
    numbers = (
        Numbers((slice(None), place, components.index(label.component or 0)), k, list(times), label.unit)
        for (k, label), place in zip(lines, places.tolist(), strict=True)
    )
    handles = np.array(list(dict.fromkeys(by_label.tolist())))
    return side.table(kind, np.array(list(times.values())), handles, numbers)


def bare_tables(side: Orientation) -> list[SheetTable]:
    """The tables of numbers without labels of handles, recognised by their size; none for another size."""
    cells = side.cells
    numeric = [k for k, row in enumerate(cells) if sum(isinstance(cell, float) for cell in row) > len(row) // 2]
    # A line of numbers above those of the handles can only hold times.
    first = next((k for k in numeric[:2] if len(cells) - k in (HANDLES, 2 * HANDLES)), None)
    if first is None:
        return []
    heads, twice = cells[:first], len(cells) - first == 2 * HANDLES
    numbered = enumerate(range(first, len(cells)))
    lines = [(k, Label(n // 2 if twice else n, None, 1.0)) for n, k in numbered]
    columns = [k for k, cell in enumerate(cells[first]) if isinstance(cell, float)]
    aside = columns[0] - 1
    if not twice and len(columns) <= len(COMPONENTS[TableKind.CONTACT]) + 1:
        names = {k for row in heads for k in columns if isinstance(row[k], str)}
        headed = _columns(heads, aside)
        components = {component for _, component in headed}
        if {X, Y} <= components:
            # A further number beside x and y, but no speed: points of a curve.
            is_curve = SPEED not in components and names - {k for k, _ in headed.values()}
            return [] if is_curve else _by_columns(side, lines, heads, headed)
        if names and not _instants(heads, aside):
            return []
        if not names and _holds_places(cells[first:]) and 1 < len(columns) <= len(COMPONENTS[TableKind.CONTACT]):
            return _by_columns(side, lines, heads, _of_one_instant(columns))
    return _over_time(side, lines, _times(heads, cells, aside))
