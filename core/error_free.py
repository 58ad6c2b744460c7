"""Error-free transformations: sums and products of doubles, and what rounding took from them.

The same for single numbers inside the loops: core/kernels/double_double.py, with the source.
"""

from __future__ import annotations

from typing import TypeVar

import numpy as np

from core.kernels.constants import HIGH, LOW
from core.values import Floats

# 2^27 + 1, which splits a double in two halves of 26 bits [1].
SPLITTER = 134217729.0

Reals = TypeVar("Reals", float, Floats)


def two_sum(a: Reals, b: Reals) -> tuple[Reals, Reals]:
    """a + b in doubles, and what rounding took from it.

    >>> two_sum(1.0, 1e-20)
    (1.0, 1e-20)
    """
    total = a + b
    added = total - a
    return total, (a - (total - added)) + (b - added)


def two_product(a: Reals, b: Reals) -> tuple[Reals, Reals]:
    """a b in doubles, and what rounding took from it.

    >>> two_product(1.0 + 2.0**-30, 1.0 + 2.0**-30)[1] == 2.0**-60
    True
    """
    product = a * b
    (a_high, a_low), (b_high, b_low) = _halves(a), _halves(b)
    return product, ((a_high * b_high - product) + a_high * b_low + a_low * b_high) + a_low * b_low


def _halves(a: Reals) -> tuple[Reals, Reals]:
    c = SPLITTER * a
    high = c - (c - a)
    return high, a - high


def paired(high: Floats, low: Floats | float = 0.0) -> Floats:
    """Numbers in double-double (N, 2), from doubles (N,) and what these have lost in rounding."""
    pairs = np.empty((high.size, 2))
    pairs[:, HIGH], pairs[:, LOW] = high, low
    return pairs
