"""Rectangles in decimals: their separation, and its axis."""

from __future__ import annotations

import math
from decimal import Decimal, localcontext

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from core import separation
from core.contact.decimal_shapes import CORNERS, DIGITS, Bench, beyond, corner_of, exact_gap
from core.contact.decimal_shapes import exact_separation as precise_separation

DOUBLE = 1e-12  # [m]
PRECISE = Decimal("1e-30")  # [m]

boxes = st.tuples(
    *(st.floats(-2, 2), st.floats(-2, 2), st.floats(-math.pi, math.pi), st.floats(0.5, 3), st.floats(0.1, 1))
)


@pytest.mark.uncompiled
@settings(max_examples=200, deadline=None)
@given(boxes, boxes)
# corners that touch but for the last digits: the direction between them is rounding alone
@example((0.0, 0.0, 0.5, 1.0, 1.0), (-0.479425538604203, 0.8775825618903728, 0.5, 1.0, 1.0))
def test_rectangles_are_as_far_apart_as_in_doubles(a: tuple[float, ...], b: tuple[float, ...]) -> None:
    def bench(x: float, y: float, heading: float, length: float, width: float) -> Bench:
        numbers = (x, y, math.cos(heading), math.sin(heading), 0.5 * length, 0.5 * width)
        dx, dy, ux, uy, half_length, half_width = map(Decimal, numbers)
        size = (ux * ux + uy * uy).sqrt()  # a direction in doubles has not quite the length 1
        return Bench((dx, dy), (ux / size, uy / size), half_length, half_width)

    first, second = bench(*a), bench(*b)
    distance, axis = precise_separation(first, second)
    result = separation(a[:3], a[3:], b[:3], b[3:]).separation
    assert float(distance) == pytest.approx(float(result), rel=0, abs=DOUBLE)
    assert float(exact_gap(first, second, axis)) == pytest.approx(float(distance), rel=0, abs=DOUBLE)


@pytest.mark.parametrize("owner", [0, 1])
@pytest.mark.parametrize("across", [Decimal(0), Decimal("0.1")], ids=["faces", "corners"])
def test_a_bench_that_passed_through_the_other_is_not_apart_along_the_axis_of_its_former_side(
    owner: int, across: Decimal
) -> None:
    """The gap along an axis chosen while the other bench lies to the left is negative once that lies to the right."""

    def bench(x: Decimal, y: Decimal) -> Bench:
        return Bench((x, y), (Decimal(1), Decimal(0)), Decimal(1), Decimal("0.2"))

    resting = bench(Decimal(0), Decimal(0))
    sides = [bench(30 * across, Decimal(2)), bench(30 * across, Decimal(-2))]
    left, right = ((resting, side) if owner == 0 else (side, resting) for side in sides)
    with localcontext() as context:
        context.prec = DIGITS
        distance, axis = precise_separation(*left)
        assert abs(exact_gap(*left, axis) - distance) < PRECISE
        assert exact_gap(*right, axis) < 0
        assert abs(precise_separation(*right)[0] - distance) < PRECISE


@pytest.mark.uncompiled
@settings(max_examples=100, deadline=None)
@given(boxes, boxes, st.floats(0.0, 1.0))
def test_a_corner_between_two_instants_is_no_further_out_than_its_bound(
    a: tuple[float, ...], b: tuple[float, ...], part: float
) -> None:
    """A rectangle that moves straight: no corner bends, and none is further from the other than at the worse end."""

    def bench(x: float, y: float, size: tuple[float, ...]) -> Bench:
        length, width = map(Decimal, size)
        return Bench((Decimal(x), Decimal(y)), (Decimal(1), Decimal(0)), length / 2, width / 2)

    own, start, end = bench(0.0, 0.0, a[3:]), bench(*a[:2], b[3:]), bench(*b[:2], b[3:])
    between = bench(a[0] + part * (b[0] - a[0]), a[1] + part * (b[1] - a[1]), b[3:])
    for corner in CORNERS:
        bound = beyond([(own, start), (own, end)], corner, Decimal(0))
        x, y = (abs(coordinate) for coordinate in corner_of(between, corner))
        dx, dy = x - own.half_length, y - own.half_width
        outside = (dx.max(Decimal(0)) ** 2 + dy.max(Decimal(0)) ** 2).sqrt()
        assert (outside or max(dx, dy)) <= bound + Decimal(DOUBLE)
