"""Legs stay on free ground, and go around what stands in their way."""

import math
from functools import reduce

import numpy as np
import pytest
import shapely

from core import Budget, Dragon, Venue
from core.proposal.free_ground import FreeGround
from core.proposal.legs import LegFinder, points_along
from core.proposal.needs import Needs
from core.proposal.walks import joined, length_of, moved
from tests.support.near import assert_near
from tests.support.random_squares import box, polygon

SQUARE = box("square", 0, 0, 40, 30)
WALL = box("wall", 18, -1, 2, 24)
NEEDS = Needs(Dragon(8), 0.05, 0.0)
BEGIN = (4.0, 5.0, 0.0)
END = (36.0, 5.0, 0.0)


def ways(*obstacles):
    return LegFinder(FreeGround(Venue(SQUARE, obstacles)), NEEDS, Budget())


def test_a_wall_is_gone_around_with_room_on_both_sides():
    there = ways(WALL)
    assert there.leg(BEGIN, END) is None
    steps = there.around(BEGIN, END)
    assert_near(reduce(moved, steps, BEGIN)[:2], END[:2], 1e-9)
    line = shapely.LineString(points_along(BEGIN, steps, 0.05)[0])
    borders = polygon(WALL), polygon(SQUARE).boundary
    assert min(map(line.distance, borders)) >= NEEDS.straight_side + NEEDS.free


def test_points_are_on_the_steps():
    steps = [(3.0, 0.0), (2.0 * math.pi, 0.5), (1.0, -1.0)]
    points, travel = points_along(BEGIN, steps)
    assert travel[-1] == pytest.approx(4.0 + 2.0 * math.pi)
    assert np.linalg.norm(np.diff(points, axis=0), axis=1).max() <= 0.35
    assert points[-1] == pytest.approx(reduce(moved, steps, BEGIN)[:2])


def test_a_lane_in_which_benches_can_just_turn_is_passed():
    lane = ways(box("wall", 15, -1, 10, 4.5), box("other", 15, 6.5, 10, 24.5))
    assert lane.around((4.0, 12.0, 0.0), END) is not None


def test_a_walk_goes_straight_turns_once_where_the_lines_cross_and_goes_straight_on():
    there = ways(WALL)
    corner = (8.0, 25.0, 0.5 * math.pi)
    steps = joined(there.walk((2.0, 5.0, 0.0), corner))
    assert [curvature for _, curvature in steps] == [0.0, 1.0 / NEEDS.radii[0], 0.0]
    assert_near(reduce(moved, steps, (2.0, 5.0, 0.0)), corner, 1e-9)


def test_heedless_legs_lead_across_edges():
    ground = FreeGround(Venue(SQUARE, (WALL,)))
    legs = LegFinder(ground, NEEDS, Budget(), heedless=True)
    assert length_of(legs.leg(BEGIN, END)) == pytest.approx(32.0)


def test_no_leg_leads_through_a_gap_that_is_too_narrow():
    assert ways(box("wall", 18, -1, 2, 15.7), box("other", 18, 15, 2, 16)).around(BEGIN, END) is None
