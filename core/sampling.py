"""Searches that other modules share: the place from which a claim holds, and the lowest samples.

Functions are sampled first. Then the result is refined: a border by bisected() or falls_to_zero(), a minimum among the
lowest samples of dips(). Searches that need more stand beside their users: those of core/kernels never call back into
Python (core/kernels/__init__.py); border() of pitch_bands.py also looks for its upper end, and each look starts from
the dip of the last one; refined_dip() may change its pair; nearest_rotated(), the sharpest bend, the stray of three
benches and the exhibit compare a whole grid in each round; _grazes() and _dips_ahead() look for dips of a
single pair or below a known gap; _simple() and _grazing() of safe.py step along a secant,
since each value takes a whole march; and the grader's chains search for many places at once.
"""

from __future__ import annotations

from collections.abc import Callable
from decimal import Decimal

import numpy as np
from numpy.typing import NDArray

from core.values import Floats


def bisected(
    holds: Callable[[float], bool | None],
    low: float,
    high: float,
    *,
    width: float = 0.0,
    relative: float = 0.0,
    middle: Callable[[float, float], float] = lambda a, b: 0.5 * (a + b),
) -> tuple[float, float]:
    """Both ends of a bracket around the border beyond which a claim holds.

    holds: the claim, which is False at low and True at high; the search ends when it returns None
    width, relative: the bracket is at most width + relative |high| wide, or its ends are neighbouring numbers
    middle: function of both ends that gives the next place to test

    >>> bisected(lambda x: x * x >= 2.0, 1.0, 2.0, width=0.1)
    (1.375, 1.4375)
    """
    while high - low > width + relative * abs(high):
        between = middle(low, high)
        if not low < between < high or (found := holds(between)) is None:
            break
        low, high = (low, between) if found else (between, high)
    return low, high


def falls_to_zero(
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
        found = value(middle)
        low, above, high, below = (middle, found, high, below) if found > 0 else (low, above, middle, found)
    return high


def dips(samples: Floats, most: int) -> NDArray[np.intp]:
    """Indices of inner samples that are not higher than their neighbours: at most `most`, the lowest first.

    samples: (N,)

    >>> dips(np.array([5.0, 3.0, 4.0, 1.0, 2.0]), 5)
    array([3, 1])
    """
    inner = 1 + np.flatnonzero((samples[1:-1] <= samples[:-2]) & (samples[1:-1] <= samples[2:]))
    return inner[np.argsort(samples[inner], kind="stable")[:most]]
