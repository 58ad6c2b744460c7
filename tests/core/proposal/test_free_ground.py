"""The free ground: distances and widest circles against shapely."""

import numpy as np
import pytest
import shapely

from core import Area, Venue
from core.proposal.free_ground import WIDEST, FreeGround
from tests.support.near import assert_near
from tests.support.random_squares import box, free_ground, polygon, random_case

SAME = 1e-9  # [m]: at coordinates to 50 m


@pytest.mark.parametrize("seed", range(8))
def test_clearances_and_the_widest_circle_are_those_of_shapely(seed):
    venue = random_case(seed).venue
    ground = FreeGround(venue)
    points = np.random.default_rng(seed).uniform(ground.low - 2.0, ground.high + 2.0, (400, 2))
    places = shapely.points(points)
    left, widest = free_ground(venue)
    borders = [polygon(one).boundary for one in (venue.square, *venue.obstacles)]
    nearest = np.min([shapely.distance(border, places) for border in borders], axis=0)
    clearance = ground.clearance(points)
    assert_near(clearance, np.where(shapely.contains(left, places), nearest, -nearest), SAME)
    held = ((points > ground.low) & (points < ground.high)).all(axis=1)
    for rough in (ground.nearest_node(*points[held].T), ground.roughly(points[held])):
        assert np.abs(rough - clearance[held]).max() <= ground.node_error + SAME
    x, y, radius, most = ground.widest_circle
    assert_near(radius, float(ground.clearance(np.array([[x, y]]))[0]), SAME)
    assert widest - WIDEST - 1e-3 <= radius <= widest + 1e-3
    assert widest - SAME <= most <= widest + WIDEST + 1e-3


@pytest.mark.parametrize("side", [2.0, 3.5, 17.0])
def test_the_bound_of_the_width_of_the_widest_circle_is_at_most_a_centimetre_above_it(side):
    *_, most = FreeGround(Venue(box("square", 0, 0, side, side))).widest_circle
    assert side <= 2.0 * most <= side + 0.01 + SAME


def test_the_area_is_that_of_the_square_without_its_holes():
    square = box("square", 0, 0, 10, 8)
    hall = Area("square", (*square.rings, *box("hole", 2, 2, 3, 2).rings))
    assert FreeGround(Venue(hall, (box("tree", 8, 2, 1, 1),))).area == pytest.approx(74.0)


@pytest.mark.parametrize("gap", [0.02, 0.3, 1.7])
def test_a_way_is_parted_just_where_a_gap_is_too_narrow(gap):
    walls = box("low", 5, -1, 2, 5.0 - 0.5 * gap), box("high", 5.3, 4.0 + 0.5 * gap, 2, 9)
    ground = FreeGround(Venue(box("square", 0, 0, 12, 8), walls))
    begins = np.array([[1.0, 3.0], [1.0, 5.0]])
    ends = np.array([[11.0, 1.0], [11.0, 2.0]])
    assert [ground.is_parted(begins, ends, 0.5 * gap + more) for more in (-0.004, 0.004)] == [False, True]
    assert not ground.is_parted(begins, ends, 0.0)
