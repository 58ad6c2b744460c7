"""The handles that the lines of a sheet stand for: by their names, by their numbers, or by their order."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from app.grade.grid import Cell, Cells, normalized
from app.grade.labels import Label, X, Y, is_handle_heading, label_of
from core.values import Floats

Ints = NDArray[np.int64]
Mask = NDArray[np.bool_]
# The labels of lines, None where there is none; and a line with its label.
Labels = list[Label | None]
Line = tuple[int, Label]

# Handles of the contest's dragon: the head's is 0, the rear one of the tail is the last.
BENCHES = 223
HANDLES = BENCHES + 1
# Most lines more, or less, than there are handles in a table that numbers them.
EXTRA_MOST = 3
# First lines in which names of handles are looked for: three tables below one another.
NAMED_LINES = 1_000
# Fewer labels than this may be chance and are ignored.
LABELS_LEAST = 3


def names_in(cells: Cells) -> frozenset[int]:
    """The handles that the first column with names of them names; none without one."""
    for column in zip(*cells[:NAMED_LINES], strict=True):
        labels = names_of(column)
        if count_of_handles(labels) >= LABELS_LEAST:
            return frozenset(numbered(lines_of(labels))[0].tolist())
    return frozenset()


def labels_in(column: list[Cell], names: frozenset[int]) -> Labels:
    """Labels in a column: numbers, and names if the sheet has names."""
    numbers = numbering(column, names)
    if not names:
        return numbers
    return [name or number for name, number in zip(names_of(column), numbers, strict=True)]


def names_of(column: Sequence[Cell]) -> Labels:
    return [label_of(cell) for cell in column]


def numbering(column: list[Cell], names: frozenset[int]) -> Labels:
    """Labels of a column that numbers the handles, or their lines of x and y, from 0 or 1; elsewhere None.

    It may do so again and again in tables below each other. names: handles that names label in another table, which
    need no heading
    """
    labels: Labels = [None] * len(column)
    numbers = [(k, cell) for k, cell in enumerate(column) if isinstance(cell, float)]
    # A table below another one begins with a smaller number, below a line of its own.
    begins = [n for n, ((k, a), (m, b)) in enumerate(pairwise(numbers), 1) if m > k + 1 and b <= a]
    end = 0
    for begin, after in pairwise([0, *begins, len(numbers)] if numbers else []):
        lines, run = zip(*numbers[begin:after], strict=True)
        heads = [normalized(cell) for cell in column[end : lines[0]] if isinstance(cell, str)]
        for n, handle in _numbers_of(run, heads, names).items():
            labels[lines[n]] = Label(handle, None, 1.0)
        end = lines[-1] + 1
    return labels


def _numbers_of(run: Sequence[float], heads: list[str], names: frozenset[int]) -> dict[int, int]:
    """The handles that the numbers below some headings number, by their places; none if they are other numbers."""
    numbers = np.array(run)
    # x stands above y in two lines of a number.
    once = numbers[::2] if np.array_equal(numbers[::2], numbers[1::2]) else numbers
    counts_all = abs(once.size - HANDLES) <= EXTRA_MOST or once.size == 2 * HANDLES
    is_counted = counts_all and once[0] in (0.0, 1.0) and bool(np.all(np.diff(once) == 1.0))
    are_handles = bool(np.all((once == np.round(once)) & (once >= 0.0) & (once < HANDLES)))
    is_unique = np.unique(once).size == once.size >= LABELS_LEAST
    is_headed = any(map(is_handle_heading, heads)) or names == set(once.tolist())
    is_sure = _lead_to_the_tail(once)
    if not (is_counted or is_sure or (is_unique and is_headed and are_handles)):
        return {}
    first = 1 if (is_counted and once[0] == 1.0) or (is_sure and once[-1] == HANDLES) else 0
    each = 2 if once.size == 2 * HANDLES else 1
    return {k: (number - first) // each for k, number in enumerate(numbers.astype(int).tolist())}


def _lead_to_the_tail(numbers: Floats) -> bool:
    """True if whole numbers grow in unequal steps from the head, or the first body, to the rear of the tail.

    Those of some handles do so, also if they count from 1, and no instants do.
    """
    steps, ends = np.diff(numbers), (numbers[0], numbers[-1])
    is_whole = bool(np.all(numbers == np.round(numbers)))
    is_uneven = numbers.size >= LABELS_LEAST and bool(steps.min() > 0.0) and bool(np.ptp(steps) > 0.0)
    return is_whole and is_uneven and ends in ((0.0, BENCHES), (1.0, BENCHES), (1.0, HANDLES))


def count_of_handles(labels: Labels) -> int:
    """Number of different labels of handles; tables on their side, below each other, repeat one in a column."""
    return len({(label.handle, label.component) for label in labels if label and label.handle is not None})


def lines_with_labels(labels: Labels) -> list[Line]:
    """Lines with their labels. Where most labels without an axis stand above a line without one, that line is their y
    (merged cells); one such line alone is a remark below the table, or a blank."""
    lines = lines_of(labels)
    open_below = {k for k, label in lines if label.component is None and labels[k + 1 : k + 2] == [None]}
    if 2 * len(open_below) <= len(lines):
        return lines
    expanded: list[Line] = []
    for k, label in lines:
        both = [(k, replace(label, component=X)), (k + 1, replace(label, component=Y))]
        expanded += both if k in open_below else [(k, label)]
    return expanded


def lines_of(labels: Labels) -> list[Line]:
    """Lines with a label of a handle."""
    return [(k, label) for k, label in enumerate(labels) if label is not None and label.handle is not None]


def numbered(lines: list[Line]) -> tuple[Ints, Ints]:
    """Handle of every line, by its label and by its order. The tail follows the last body bench with a label."""
    handles = [label.handle for _, label in lines if label.handle is not None]
    assert len(handles) == len(lines)
    last = max([BENCHES - 2, *handles])
    by_label = [handle if handle >= 0 else last - handle for handle in handles]
    order = {handle: n for n, handle in enumerate(dict.fromkeys(by_label))}
    return np.array(by_label), np.array([order[handle] for handle in by_label])
