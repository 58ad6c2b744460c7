"""Searches in one variable that several modules use: bisect(), crossing(), fall_to_zero() and dips().

A function is sampled first. bisect() or fall_to_zero() then narrows a border between two samples, and dips() names the
samples around which a minimum may lie.

These searches stand beside their users instead, because they need more:
- the loops of core/kernels, which never call back into Python;
- Bands.border() in core/design/pitch_bands.py, which also looks for its upper end, from the dip of the last look;
- refined() in core/contact/gaps.py, whose nearest pair may change on the way;
- the sharpest bend (core/extremes), the stray of three benches and the exhibit (core/tolerance), which compare a whole
  grid in each round;
- grazes() and _dips_ahead() in core/contact, which look for dips of one pair, or for dips below a known gap;
- _simple() and _grazing() in core/tolerance/safe.py, which step along a secant, since each value takes a whole march;
- the chains of app/grade, which search for many places at once.
"""

from __future__ import annotations

from collections.abc import Callable
from decimal import Decimal

import numpy as np
from numpy.typing import NDArray

from core.values import Floats

# Most rounds of a false position [1].
ROUNDS = 100


def bisect(
    holds: Callable[[float], bool | None],
    low: float,
    high: float,
    *,
    width: float = 0.0,
    relative: float = 0.0,
    middle: Callable[[float, float], float] = lambda a, b: 0.5 * (a + b),
) -> tuple[float, float]:
    """The bracket (low, high) around the border beyond which a claim holds.

    holds: the claim, which is False at low and True at high; the search ends when it returns None
    width, relative: the bracket is at most width + relative |high| wide, or its ends are neighbouring numbers
    middle: function of both ends that gives the next place to test

    >>> bisect(lambda x: x * x >= 2.0, 1.0, 2.0, width=0.1)
    (1.375, 1.4375)
    """
    while high - low > width + relative * abs(high):
        between = middle(low, high)
        if not low < between < high or (answer := holds(between)) is None:
            break
        low, high = (low, between) if answer else (between, high)
    return low, high


# Input:  a bracket [low, high], and a function that is positive at low and not at high.
# State:  the bracket; `above` and `below`, the function at its ends, halved where an end stays; `last`, the end that
#         moved last.
# Output: the upper end of a bracket no wider than `width`.
def crossing(value: Callable[[float], float], low: float, high: float, width: float) -> float:
    """Place where a function falls to zero, too far by `width` at most; method: as in crossing() of core/kernels."""
    above, below, last = value(low), value(high), 0
    if above <= 0.0:
        return low
    for k in range(ROUNDS):
        if high - low <= width:
            break
        middle = low + (high - low) * above / (above - below) if below < 0.0 else 0.5 * (low + high)
        if not low < middle < high or k % 4 == 3:
            middle = 0.5 * (low + high)
            if not low < middle < high:
                break
        between = value(middle)
        if between > 0.0:
            low, above = middle, between
            below, last = (0.5 * below if last == 1 else below), 1
        else:
            high, below = middle, between
            above, last = (0.5 * above if last == -1 else above), -1
    return high


def fall_to_zero(
    value: Callable[[Decimal], Decimal], low: Decimal, high: Decimal, above: Decimal, below: Decimal, width: Decimal
) -> Decimal:
    """Place where a function falls to 0 or below; never too early, and too late by less than a width.

    above, below: its positive value at low, and its value at high, 0 or negative

    Method: false position with an occasional bisection.
    """
    looks = 0
    while high - low > width:
        looks += 1
        middle = (low + high) / 2
        if looks % 3:  # alternately a little beyond the zero and before it, so that both ends approach it
            middle = low + (high - low) * above / (above - below) + (width / 3 if looks % 3 == 1 else -width / 3)
            middle = min(max(middle, low + width / 4), high - width / 4)
        there = value(middle)
        low, above, high, below = (middle, there, high, below) if there > 0 else (low, above, middle, there)
    return high


def dips(samples: Floats, most: int) -> NDArray[np.intp]:
    """Indices of inner samples that are not higher than their neighbours: at most `most`, the lowest first.

    samples: (N,)

    >>> dips(np.array([5.0, 3.0, 4.0, 1.0, 2.0]), 5)
    array([3, 1])
    """
    inner = 1 + np.flatnonzero((samples[1:-1] <= samples[:-2]) & (samples[1:-1] <= samples[2:]))
    return inner[np.argsort(samples[inner], kind="stable")[:most]]
