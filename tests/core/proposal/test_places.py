"""Places of figures, against all places on a fine grid."""

import math

import numpy as np
import pytest

from core import Dragon, Figure, Route
from core.proposal.figures import Shape
from core.proposal.free_ground import FreeGround
from core.proposal.needs import Needs
from core.proposal.places import base_rotation, placements, sampled
from tests.support.depth import further
from tests.support.near import assert_near
from tests.support.random_squares import random_case

NEEDS = Needs(Dragon(8), 0.0, 0.0)
OVAL = Shape(Figure.RING, (5.0, 3.0, 3.0))


@pytest.mark.parametrize("seed", further([5, 1, 12], 1))
def test_no_place_of_a_fine_grid_has_much_more_room(seed):
    ground = FreeGround(random_case(seed).venue)
    outline = sampled(Route(OVAL.pieces), NEEDS)

    def turned(angle):
        cos = math.cos(angle)
        sin = math.sin(angle)
        return outline.points @ np.array([[cos, sin], [-sin, cos]])

    def room_of(points):
        return float((ground.clearance(points) - outline.sides).min())

    best = placements(ground, NEEDS, OVAL, 1)
    most = -math.inf
    grid = np.mgrid[tuple(slice(low, high) for low, high in zip(ground.low, ground.high, strict=True))]
    for angle in base_rotation(ground) + math.pi / 8 * np.arange(8):
        points = turned(angle)
        for place in grid.reshape(2, -1).T:
            if ground.roughly(place + points[::9]).min() > most:
                most = max(most, room_of(place + points))
    if most > 0.0:
        ((room, (*place, angle)),) = best
        assert room >= most - 2.0 * ground.node_error
        assert_near(room, room_of(place + turned(angle)), 2.0 * ground.node_error)
