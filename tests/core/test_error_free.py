"""Sums and products with their rounding errors, against fractions."""

from fractions import Fraction

import numpy as np
import pytest

from core.error_free import two_product, two_sum

NUMBERS = np.random.default_rng(3)
A, B = (NUMBERS.uniform(-1.0, 1.0, 200) * 10.0 ** NUMBERS.integers(-12, 12, 200) for _ in range(2))


@pytest.mark.parametrize(
    "operation, exact", [(two_sum, Fraction.__add__), (two_product, Fraction.__mul__)], ids=["sum", "product"]
)
def test_nothing_is_lost_of_numbers_and_arrays(operation, exact):
    highs, lows = operation(A, B)
    for a, b, high, low in zip(A.tolist(), B.tolist(), highs.tolist(), lows.tolist(), strict=True):
        assert Fraction(high) + Fraction(low) == exact(Fraction(a), Fraction(b))
        assert operation(a, b) == (high, low)
    assert np.count_nonzero(lows) > 100
