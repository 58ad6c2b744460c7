"""Rectangles in decimals: their separation, and its axis."""

import math
from decimal import Decimal, localcontext

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from core import separation
from core.contact.decimal_shapes import CORNERS, DIGITS, Bench, beyond, corner_of, exact_gap, exact_separation
from tests.support.near import assert_near

DOUBLE = 1e-12  # [m]
PRECISE = Decimal("1e-30")  # [m]

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


@pytest.mark.parametrize("owner", [0, 1])
@pytest.mark.parametrize("x", ["0", "3"], ids=["faces", "corners"])
def test_a_bench_that_passed_through_the_other_is_not_apart_along_the_axis_of_its_former_side(owner, x):
    """The gap along an axis chosen while the other bench lies to the left is negative once that lies to the right."""
    resting, *sides = (bench(*place, 0.0, "2", "0.4") for place in (("0", "0"), (x, "2"), (x, "-2")))
    left, right = ((resting, side) if owner == 0 else (side, resting) for side in sides)
    with localcontext() as context:
        context.prec = DIGITS
        distance, axis = exact_separation(*left)
        assert abs(exact_gap(*left, axis) - distance) < PRECISE
        assert exact_gap(*right, axis) < 0
        assert abs(exact_separation(*right)[0] - distance) < PRECISE


@pytest.mark.uncompiled
@settings(max_examples=100, deadline=None)
@given(boxes, boxes, st.floats(0.0, 1.0))
def test_a_corner_between_two_instants_is_no_further_out_than_its_bound(a, b, part):
    """A rectangle that moves straight: no corner bends, and none is further from the other than at the worse end."""
    resting, start, end = (bench(*place, 0.0, *box[3:]) for place, box in (((0.0, 0.0), a), (a[:2], b), (b[:2], b)))
    between = bench(*(one + part * (other - one) for one, other in zip(a[:2], b[:2], strict=True)), 0.0, *b[3:])
    for corner in CORNERS:
        bound = beyond([(resting, start), (resting, end)], corner, Decimal(0))
        x, y = (abs(float(coordinate)) for coordinate in corner_of(between, corner))
        dx = x - float(resting.half_length)
        dy = y - float(resting.half_width)
        outside = math.hypot(max(dx, 0.0), max(dy, 0.0))
        assert (outside or max(dx, dy)) <= float(bound) + DOUBLE
