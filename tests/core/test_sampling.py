"""Borders and dips, against plain loops over all candidates."""

from __future__ import annotations

import math
from decimal import Decimal

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core.sampling import bisect, dips, fall_to_zero

pytestmark = pytest.mark.uncompiled

FINITE = st.floats(-1e6, 1e6)


@given(st.floats(-1e3, 1e3), st.floats(0.0, 10.0), st.floats(0.0, 0.1))
def test_a_border_lies_in_its_bracket(border: float, width: float, relative: float) -> None:
    low, high = bisect(lambda x: x >= border, -1e3 - 1.0, 1e3, width=width, relative=relative)
    assert low < border <= high
    assert high - low <= width + relative * abs(high) or math.nextafter(low, math.inf) == high


def test_without_a_width_the_ends_are_neighbouring_numbers() -> None:
    low, high = bisect(lambda x: x * x >= 2.0, 0.0, 2.0)
    assert math.nextafter(low, 2.0) == high
    assert low * low < 2.0 <= high * high


def test_a_search_that_is_given_up_keeps_the_bracket_so_far() -> None:
    request: list[float] = []

    def holds(x: float) -> bool | None:
        request.append(x)
        return None if len(request) == 3 else x >= 1.0

    assert bisect(holds, 0.0, 8.0) == (0.0, 2.0)
    assert request == [4.0, 2.0, 1.0]


def test_another_middle_is_where_the_claim_is_asked() -> None:
    request: list[float] = []
    bisect(lambda x: bool(request.append(x)), 1.0, 16.0, width=5.0, middle=lambda a, b: math.sqrt(a * b))
    assert request == [4.0, 8.0, math.sqrt(8.0 * 16.0)]


@pytest.mark.parametrize("accuracy", ["1e-20", "0.25"])
@pytest.mark.parametrize("zero", ["0.1", "0.5", "0.99"])
def test_a_function_is_followed_to_where_it_is_0(zero: str, accuracy: str) -> None:
    where, width = Decimal(zero), Decimal(accuracy)

    def value(x: Decimal) -> Decimal:
        return (where - x) * (1 + x * x)

    low, high = Decimal(0), Decimal(1)
    result = fall_to_zero(value, low, high, value(low), value(high), width)
    assert value(result) <= 0
    assert value(result - width) > 0


@given(st.lists(FINITE, max_size=12), st.integers(0, 4))
def test_dips_are_the_lowest_samples_that_no_neighbour_undercuts(samples: list[float], most: int) -> None:
    known = [k for k in range(1, len(samples) - 1) if samples[k] <= min(samples[k - 1], samples[k + 1])]
    assert dips(np.array(samples), most).tolist() == sorted(known, key=lambda k: samples[k])[:most]
