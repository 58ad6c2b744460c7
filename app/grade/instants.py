"""The time that numbers show, as exactly as their digits allow.

Input: numbers with their tolerances, and a motion. Output: the span of times in which most of them agree with it, and
the number in it with the fewest decimals. State: none. Argument: near a time each number is linear in it, so it agrees
within an interval; the numbers of a motion agree together where most of these overlap. A mean would be less exact, and
wrong numbers would move it.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from core.values import Floats

# Step of the derivatives by the time [s], and times that the span is found again from the middle of the last one.
STEP, TIMES = 1e-4, 3
# Slowest number that shows a time [m/s].
SLOWEST = 1e-3
# Most decimals of a time [s].
DECIMALS_MOST = 9

# The first and the last time [s].
Span = tuple[float, float]


def agreed_span(
    values: Floats, tolerance: Floats, numbers_at: Callable[[float], Floats], time: float, far: float
) -> Span:
    """The span of times in which most numbers agree with a motion [s]; both ends at `time` if none does.

    values, tolerance: of the same shape, NaN where there is no number; numbers_at: those of the motion at a time;
    far: largest distance of the span from `time` [s]
    """
    low, high = time, time
    for _ in range(TIMES):
        middle = 0.5 * (low + high)
        before, now, after = (numbers_at(middle + step) for step in (-STEP, 0.0, STEP))
        slope, off = (after - before) / (2.0 * STEP), values - now
        counts = np.isfinite(off) & (np.abs(slope) > SLOWEST)
        centre, half = middle + off[counts] / slope[counts], (tolerance / np.maximum(np.abs(slope), SLOWEST))[counts]
        lows, highs = np.maximum(centre - half, time - far), np.minimum(centre + half, time + far)
        near = lows < highs
        if not near.any():
            return time, time
        ends = np.concatenate([lows[near], highs[near]])
        depths = np.repeat([1, -1], near.sum())
        order = np.lexsort((-depths, ends))
        deepest = int(np.cumsum(depths[order]).argmax())
        low, high = ends[order[deepest : deepest + 2]].tolist()
    return low, high


def simplest(span: Span) -> float:
    """The number in a span that has the fewest decimals; its middle if it is very narrow.

    >>> simplest((0.4996, 0.5003)), simplest((0.12341, 0.12347))
    (0.5, 0.12344)
    """
    middle = 0.5 * (span[0] + span[1])
    rounded = (round(middle, decimals) for decimals in range(DECIMALS_MOST))
    return next((number for number in rounded if span[0] <= number <= span[1]), middle)


def decimals_of(span: Span, most: int) -> int:
    """The decimals that all numbers of a span nearly share, from 0 to `most`."""
    width = max(span[1] - span[0], 10.0**-DECIMALS_MOST)
    return int(np.clip(np.floor(-np.log10(width)), 0, most))
