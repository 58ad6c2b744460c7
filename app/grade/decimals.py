"""Decimals of the numbers of a table, as a fair teacher reads them.

Input: numbers. Output: the decimals with which each counts. State: none. Argument: spreadsheets lose the zeros at the
end of a number, so one of ten has a decimal less than it was written with, and one of a hundred two; a whole number
shows none. So the numbers of an instant, of a handle, of x, y or speed, and of a size, count with the decimals that at
least half of them have: a few longer ones do not make the others wrong. Where more are shorter than lost zeros explain,
each counts with its own.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from app.grade.handles import Ints, Mask
from core.values import Floats

# Most decimals of a number in metres that a double holds, and difference of a number from a whole one, in its last
# decimal, that is rounding [1].
DECIMALS_MOST, WHOLE = 12, 1e-6
# Shares of numbers with fewer decimals than usual, and with at least two fewer, that lost zeros explain [1].
SHORTER, MUCH_SHORTER = 0.15, 0.03
# Fewest numbers with decimals of an instant, a handle and so on that show theirs; and decimals of one that has none.
GROUP_LEAST, WHOLE_GROUP = 5, 2
# Axes of the numbers of an instant, of a handle, and of a component; and the mark of too few numbers, more than any.
LINES, NONE = ((1, 2), (0, 2), (0, 1)), 99
# Share of the numbers that must not be whole to show their decimals against those of the other tables [1].
SHOWN = 0.05
# Share of the numbers of a file that may have fewer decimals than those that show none are taken to have [1].
FEWER = 0.2


def digits_of(values: Floats, beside: int = 0) -> Ints:
    """The decimals with which each number of a table counts. values: (T, H, C)

    beside: those of the whole file, for a table of whole numbers

    >>> digits_of(np.array([[[0.25], [0.5], [1.0], [0.1234], [0.75], [0.31]]])).ravel()
    array([2, 2, 2, 2, 2, 2])
    """
    counts, known = _counts(values), np.isfinite(values)
    shows = known & (counts > 0)
    if not shows.any():
        return np.full(values.shape, beside)
    each = [_usual_in_lines(counts, shows, axes) for axes in LINES] + [_usual_in_sizes(counts, shows, values)]
    usual = np.minimum.reduce(np.broadcast_arrays(*each))
    most = max((int(one[one < NONE].max(initial=0)) for one in each), default=0) or _usual(counts[shows])
    few = bool(beside and shows.sum() < SHOWN * known.sum())
    digits: Ints = np.minimum(usual, min(most, beside) if few else most)
    for axes in () if few else LINES[:2]:
        is_whole = (known.sum(axis=axes, keepdims=True) >= GROUP_LEAST) & ~shows.any(axis=axes, keepdims=True)
        digits = np.where(is_whole, np.minimum(digits, WHOLE_GROUP), digits)
    short = (digits - counts)[shows]
    if float((short > 0).mean()) > SHORTER or float((short > 1).mean()) > MUCH_SHORTER:
        digits[shows] = np.minimum(digits, counts)[shows]
    return digits


def usual_of(digits: Ints, values: Floats) -> int:
    """The decimals with which at least half of the numbers of a table count; 0 without numbers."""
    some = digits[np.isfinite(values)]
    return _usual(some) if some.size else 0


def decimals_of_file(tables: Sequence[Floats]) -> int:
    """Decimals with which the numbers of a file count that show none, such as equal speeds; 0 if none shows any."""
    digits = [digits_of(one)[np.isfinite(one) & (_counts(one) > 0)] for one in tables]
    every = np.concatenate(digits) if digits else np.zeros(0)
    return int(np.quantile(every, FEWER, method="lower")) if every.size else 0


def _usual_in_lines(counts: Ints, shows: Mask, axes: tuple[int, ...]) -> Ints:
    """The usual decimals in the numbers along some axes, which stay with length 1; NONE where too few show theirs."""
    present, usual = shows.sum(axis=axes, keepdims=True), np.zeros(1, dtype=np.int64)
    for k in range(1, DECIMALS_MOST + 1):
        usual = np.where(2 * (shows & (counts >= k)).sum(axis=axes, keepdims=True) >= present, k, usual)
    return np.where(present >= GROUP_LEAST, usual, NONE)


def _usual_in_sizes(counts: Ints, shows: Mask, values: Floats) -> Ints:
    """The usual decimals of the numbers of each power of ten, at each number; NONE at those that show none."""
    usual, sizes = np.full(values.shape, NONE), np.full(values.shape, np.inf)
    sizes[shows] = np.floor(np.log10(np.abs(values[shows])))
    for size in np.unique(sizes[shows]):
        cells = sizes == size
        # The longest of a few shows what they have: others lost their zeros.
        usual[cells] = _usual(counts[cells]) if cells.sum() >= GROUP_LEAST else counts[cells].max()
    return usual


def _counts(values: Floats) -> Ints:
    """Decimals of each number."""
    counts = np.full(values.shape, DECIMALS_MOST)
    for k in range(DECIMALS_MOST - 1, -1, -1):
        scaled = values * 10.0**k
        counts[np.abs(scaled - np.round(scaled)) < WHOLE] = k
    return counts


def _usual(counts: Ints) -> int:
    """The most decimals that at least half of the numbers have."""
    return int(np.quantile(counts, 0.5, method="higher"))
