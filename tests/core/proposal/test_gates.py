"""Gates and streets: the ground that they add, and the places where they have no room."""

from __future__ import annotations

import math
from typing import Any

import pytest
import shapely

from core import Area, Gate, InvalidValue, Venue
from core.proposal.gates import checked_gates, with_streets
from tests.support.random_squares import closed, polygon

CORNERS = [(0, 0), (20, 0), (20, 12), (0, 12)]
HALL = Venue(Area("hall", (closed(CORNERS),)))
TURNED = Venue(Area("hall", (closed(CORNERS[::-1]),)))
# A circle of 40 corners: its sides are shorter than a street is wide.
ROUND = Venue(
    Area("round", (closed([(9 * math.cos(k * math.pi / 20), 9 * math.sin(k * math.pi / 20)) for k in range(40)]),))
)


@pytest.mark.parametrize("venue", [HALL, TURNED], ids=["counter-clockwise", "clockwise"])
@pytest.mark.parametrize("heading", [0.0, 0.4, -0.6])
def test_a_street_adds_its_own_ground_and_no_other(venue: Venue, heading: float) -> None:
    gate = checked_gates([Gate((0.1, 6.0), heading)], venue)[0]
    assert gate.point == pytest.approx((0.0, 6.0))
    before, after = polygon(venue.square), polygon(with_streets(venue, [gate], 3.0, 30.0).square)
    assert after.contains(before)
    # A parallelogram between the border and the street's end, whose middle line is 30 m long.
    assert after.area - before.area == pytest.approx(90.0)
    middle = shapely.LineString([gate.point, (-30.0 * math.cos(heading), 6.0 - 30.0 * math.sin(heading))])
    assert after.buffer(1e-9).contains(middle)


def test_a_street_may_begin_on_several_sides_of_a_round_square() -> None:
    gates = checked_gates([Gate((9.0, 0.0), math.pi), Gate((0.0, 9.0), -0.5 * math.pi)], ROUND)
    square = polygon(with_streets(ROUND, gates, 4.0, 25.0).square)
    assert square.contains(shapely.Point(30.0, 1.9))
    assert square.contains(shapely.Point(-1.9, 30.0))


def test_a_street_stays_within_its_width() -> None:
    gates = checked_gates([Gate((9.0, 0.0), math.pi)], ROUND)
    added = polygon(with_streets(ROUND, gates, 4.0, 25.0).square).difference(polygon(ROUND.square))
    added = added.buffer(-1e-6)  # without the slivers that rounding leaves along the border
    assert added.bounds[1] >= -2.0 - 1e-9
    assert added.bounds[3] <= 2.0 + 1e-9


@pytest.mark.parametrize(
    ("gates", "words"),
    [
        ([Gate((5, 6), 0.0)], r"gates\[0\]\.point must be on the border of the square: it is 5 m from it, more than 0"),
        ([Gate((0, 6), 0.0), Gate((20, 6), 0.0)], r"gates\[1\]\.heading must lead into the square, within 80 degrees"),
        ([Gate((0, 6), 0.0)] * 9, "gates must be at most 8 gates, got 9"),
        ([(0, 6, 0.0)], r"gates\[0\] must be a Gate"),
        (7, "gates must be a list of gates, got 7"),
    ],
    ids=["inside", "outwards", "many", "no gate", "no list"],
)
def test_a_wrong_gate_is_named(gates: Any, words: str) -> None:
    with pytest.raises(InvalidValue, match=words):
        checked_gates(gates, HALL)


@pytest.mark.parametrize("venue", [HALL, TURNED], ids=["counter-clockwise", "clockwise"])
@pytest.mark.parametrize("heading", [0.0, math.pi / 2, 0.6])
def test_at_a_corner_a_gate_may_lead_in_over_either_side(venue: Venue, heading: float) -> None:
    assert checked_gates([Gate((0.0, 0.0), heading)], venue)[0].point == (0.0, 0.0)
    with pytest.raises(InvalidValue, match="must lead into the square"):
        checked_gates([Gate((0.0, 0.0), heading + math.pi)], venue)


def test_a_street_without_room_is_refused() -> None:
    narrow = r"gates\[0\]\.point must have 3 m of border for its street, and the square is narrower there"
    corner = checked_gates([Gate((0.0, 0.5), 0.0)], HALL)
    with pytest.raises(InvalidValue, match=narrow):
        with_streets(HALL, corner, 3.0, 30.0)
    words = r"gates\[0\]\.point must lead to a straight street, 3 m wide and 30 m long, that does not meet the square"
    bay = Venue(Area("bay", (closed([(0, 0), (20, 0), (20, 12), (8, 12), (8, 4), (6, 4), (6, 12), (0, 12)]),)))
    inner = checked_gates([Gate((8.0, 8.0), 0.0)], bay)
    with pytest.raises(InvalidValue, match=words):
        with_streets(bay, inner, 3.0, 30.0)
