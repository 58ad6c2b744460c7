"""Borders and dips, against plain loops over all candidates."""

import math
from decimal import Decimal

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core.sampling import bisect, dips, fall_to_zero

pytestmark = pytest.mark.uncompiled


@given(st.floats(-1e3, 1e3), st.floats(0.0, 10.0), st.floats(0.0, 0.1))
def test_a_border_lies_in_its_bracket(border, width, relative):
    low, high = bisect(lambda x: x >= border, -1e3 - 1.0, 1e3, width=width, relative=relative)
    assert low < border <= high
    assert high - low <= width + relative * abs(high) or math.nextafter(low, math.inf) == high


def test_a_search_that_is_given_up_keeps_the_bracket_so_far_and_another_middle_is_asked():
    tried = []

    def holds(x):
        tried.append(x)
        return None if len(tried) == 3 else x >= 1.0

    assert bisect(holds, 0.0, 8.0) == (0.0, 2.0)
    assert tried == [4.0, 2.0, 1.0]
    tried.clear()
    bisect(lambda x: bool(tried.append(x)), 1.0, 16.0, width=5.0, middle=lambda a, b: math.sqrt(a * b))
    assert tried == [4.0, 8.0, math.sqrt(8.0 * 16.0)]


@pytest.mark.parametrize("accuracy", ["1e-20", "0.25"])
@pytest.mark.parametrize("zero", ["0.1", "0.5", "0.99"])
def test_a_function_is_followed_to_where_it_is_0(zero, accuracy):
    low = Decimal(0)
    high = Decimal(1)
    width = Decimal(accuracy)

    def value(x):
        return (Decimal(zero) - x) * (1 + x * x)

    result = fall_to_zero(value, low, high, value(low), value(high), width)
    assert value(result) <= 0 < value(result - width)


@given(st.lists(st.floats(-1e6, 1e6), max_size=12), st.integers(0, 4))
def test_dips_are_the_lowest_samples_that_no_neighbour_undercuts(samples, most):
    known = [k for k in range(1, len(samples) - 1) if samples[k] <= min(samples[k - 1], samples[k + 1])]
    assert dips(np.array(samples), most).tolist() == sorted(known, key=lambda k: samples[k])[:most]
