"""The free ground: distances and widest circles against shapely."""

from __future__ import annotations

import numpy as np
import pytest
import shapely

from core import Area, Venue
from core.proposal.free_ground import WIDEST, FreeGround
from tests.support.random_squares import closed, polygon, random_case

SAME = 1e-9  # [m]: at coordinates to 50 m


@pytest.mark.parametrize("seed", range(8))
def test_clearances_and_the_widest_circle_are_those_of_shapely(seed: int) -> None:
    venue = random_case(seed).venue
    ground, square = FreeGround(venue), polygon(venue.square)
    obstacles = [polygon(one) for one in venue.obstacles]
    points = np.random.default_rng(seed).uniform(ground.low - 2.0, ground.high + 2.0, (400, 2))
    places = shapely.points(points)
    nearest = np.min([shapely.distance(one.boundary, places) for one in (square, *obstacles)], axis=0)
    free = (
        shapely.contains(square, places) & ~np.any([shapely.intersects(one, places) for one in obstacles], axis=0)
        if obstacles
        else shapely.contains(square, places)
    )
    clearance = ground.clearance(points)
    assert clearance == pytest.approx(np.where(free, nearest, -nearest), abs=SAME)
    held = (points > ground.low).all(axis=1) & (points < ground.high).all(axis=1)
    assert np.abs(ground.nearest_node(*points[held].T) - clearance[held]).max() <= ground.node_error + SAME
    assert np.abs(ground.roughly(points[held]) - clearance[held]).max() <= ground.node_error + SAME
    x, y, radius, most = ground.widest_circle()
    left = square.difference(shapely.union_all(obstacles))
    circles = [shapely.maximum_inscribed_circle(part, tolerance=1e-4) for part in shapely.get_parts(left)]
    widest = max(circle.length for circle in circles)
    assert radius == pytest.approx(float(ground.clearance(np.array([[x, y]]))[0]), abs=SAME)
    assert widest - WIDEST - 1e-3 <= radius <= widest + 1e-3
    assert most >= widest - SAME


def test_the_area_is_that_of_the_square_without_its_holes() -> None:
    ring, hole = closed([(0, 0), (10, 0), (10, 8), (0, 8)]), closed([(2, 2), (2, 4), (5, 4), (5, 2)])
    assert FreeGround(Venue(Area("square", (ring, hole)))).area == pytest.approx(74.0)
    tree = Area("tree", (closed([(8, 2), (9, 2), (9, 3)]),))
    assert FreeGround(Venue(Area("square", (ring,)), (tree,))).area == pytest.approx(80.0)
