"""Gates and streets: the ground that they add, and the places where they have no room."""

import math

import pytest
import shapely

from core import Area, Gate, Venue
from core.proposal.gates import checked_gates, with_streets
from tests.support.random_squares import closed, polygon
from tests.support.refused import refused

CORNERS = [(0, 0), (20, 0), (20, 12), (0, 12)]
HALL = Venue(Area("hall", (closed(CORNERS),)))
TURNED = Venue(Area("hall", (closed(CORNERS[::-1]),)))
BAY = Venue(Area("bay", (closed([(0, 0), (20, 0), (20, 12), (8, 12), (8, 4), (6, 4), (6, 12), (0, 12)]),)))
# A circle of 40 corners: its sides are shorter than a street is wide.
ROUND = Venue(
    Area("round", (closed([(9 * math.cos(k * math.pi / 20), 9 * math.sin(k * math.pi / 20)) for k in range(40)]),))
)
WAYS_ROUND = pytest.mark.parametrize("venue", [HALL, TURNED], ids=["counter-clockwise", "clockwise"])


@WAYS_ROUND
@pytest.mark.parametrize("heading", [0.0, 0.4, -0.6])
def test_a_street_adds_its_own_ground_and_no_other(venue, heading):
    gate = checked_gates([Gate((0.1, 6.0), heading)], venue)[0]
    assert gate.point == pytest.approx((0.0, 6.0))
    before = polygon(venue.square)
    after = polygon(with_streets(venue, [gate], (3.0, 3.0), 30.0).square)
    assert after.contains(before)
    # A parallelogram between the border and the street's end, whose middle line is 30 m long.
    assert after.area - before.area == pytest.approx(90.0)
    middle = shapely.LineString([gate.point, (-30.0 * math.cos(heading), 6.0 - 30.0 * math.sin(heading))])
    assert after.buffer(1e-9).contains(middle)


def test_streets_may_begin_on_several_sides_of_a_round_square_and_stay_within_their_width():
    gates = checked_gates([Gate((9.0, 0.0), math.pi), Gate((0.0, 9.0), -0.5 * math.pi)], ROUND)
    both, one = (polygon(with_streets(ROUND, some, (4.0, 4.0), 25.0).square) for some in (gates, gates[:1]))
    assert both.contains(shapely.MultiPoint([(30.0, 1.9), (-1.9, 30.0)]))
    # Without the slivers that rounding leaves along the border.
    added = one.difference(polygon(ROUND.square)).buffer(-1e-6)
    assert -2.0 - 1e-9 <= added.bounds[1] < added.bounds[3] <= 2.0 + 1e-9


def test_a_street_has_the_size_that_its_gate_says_unless_the_dragon_needs_more():
    def streets(**sizes):
        return with_streets(HALL, checked_gates([Gate((0.0, 6.0), 0.0, **sizes)], HALL), (3.0, 2.0), 30.0).square

    own = polygon(streets(street_width=2.5, street_length=40.0))
    assert own.area - polygon(HALL.square).area == pytest.approx(100.0)
    for name, size in (("street_width", 1.9), ("street_length", 29.9)):
        with refused(f"gates.0.{name}"):
            streets(**{name: size})


@pytest.mark.parametrize("uses", [["both"] * 9, ["in"], ["out", "out"]])
def test_gates_are_some_with_a_way_in_and_a_way_out(uses):
    with refused("gates"):
        checked_gates([Gate((0, 6), 0.0, use) for use in uses], HALL)


@WAYS_ROUND
@pytest.mark.parametrize("heading", [0.0, math.pi / 2, 0.6])
def test_at_a_corner_a_gate_may_lead_in_over_either_side(venue, heading):
    assert checked_gates([Gate((0.0, 0.0), heading)], venue)[0].point == (0.0, 0.0)
    with refused("gates.0.heading"):
        checked_gates([Gate((0.0, 0.0), heading + math.pi)], venue)


@pytest.mark.parametrize("venue, point", [(HALL, (0.0, 0.5)), (BAY, (8.0, 8.0))], ids=["corner", "bay"])
def test_a_street_without_room_is_refused(venue, point):
    gates = checked_gates([Gate(point, 0.0)], venue)
    with refused("gates.0.point"):
        with_streets(venue, gates, (3.0, 3.0), 30.0)


WALLS = {
    "straight": [(0, 0), (10, 0), (10, -8), (26, -8), (26, 8), (10, 8), (10, 0.7), (0, 0.7)],
    "slanting": [(0, 0), (10, -4), (26, -8), (26, 8), (10, 5), (0, 0.7)],
    "aslant": [(0, 0), (6, -6), (26, -8), (26, 8), (10, 11), (0, 0.7)],
    "back again": [(0, 0), (0.4, -0.1), (-0.2, -0.8), (-0.1, -8), (26, -8), (26, 8), (0, 8), (0, 0.7)],
}


@pytest.mark.parametrize("heading", [0.0, 0.3, -1.2])
@pytest.mark.parametrize("ring", WALLS.values(), ids=WALLS)
def test_a_street_leaves_the_walls_ahead_of_its_gate(ring, heading):
    hall = Venue(Area("hall", (closed(ring),)))
    gate = checked_gates([Gate((0.0, 0.35), heading)], hall)[0]
    added = polygon(with_streets(hall, [gate], (2.4, 0.2), 30.0).square).difference(polygon(hall.square))
    assert added.buffer(-1e-6).bounds[2] <= 0.0
    # All of its width, but for what stands beside the gate.
    assert added.area == pytest.approx(2.4 * 30.0, rel=0.02)
