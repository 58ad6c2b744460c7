"""Rectangles in decimals: their separation, and its axis."""

import math
from decimal import Decimal

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from core import separation
from core.contact.decimal_shapes import Bench, exact_gap, exact_separation
from tests.support.near import assert_near

DOUBLE = 1e-12  # [m]

boxes = st.tuples(
    *(st.floats(-2, 2), st.floats(-2, 2), st.floats(-math.pi, math.pi), st.floats(0.5, 3), st.floats(0.1, 1))
)


def bench(x, y, heading, length, width):
    place, (ux, uy) = (Decimal(x), Decimal(y)), map(Decimal, (math.cos(heading), math.sin(heading)))
    size = (ux * ux + uy * uy).sqrt()  # a direction in doubles has not quite the length 1
    return Bench(place, (ux / size, uy / size), Decimal(length) / 2, Decimal(width) / 2)


@pytest.mark.uncompiled
@settings(max_examples=100, deadline=None)
@given(boxes, boxes)
# corners that touch but for the last digits: the direction between them is rounding alone
@example((0.0, 0.0, 0.5, 1.0, 1.0), (-0.479425538604203, 0.8775825618903728, 0.5, 1.0, 1.0))
def test_rectangles_are_as_far_apart_as_in_doubles(a, b):
    pair = bench(*a), bench(*b)
    distance, axis = exact_separation(*pair)
    assert_near(float(distance), separation(a[:3], a[3:], b[:3], b[3:]).separation, DOUBLE)
    assert_near(float(exact_gap(*pair, axis)), float(distance), DOUBLE)
