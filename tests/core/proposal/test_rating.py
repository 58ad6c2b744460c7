"""Ratings, against the tolerance that is proven."""

import math

import numpy as np
import pytest

from core import Arc, Dance, Dragon, Line, Route, Venue, tolerance
from core.proposal.free_ground import FreeGround
from core.proposal.needs import Needs
from core.proposal.places import sampled
from core.proposal.rating import STRANDS, rated, strands
from core.proposal.search import RATED_LOW
from tests.support.random_squares import box
from tests.support.shared_dances import lane, square

NEEDS = Needs(Dragon(12), 0.0, 0.0)


@pytest.mark.parametrize("radius", [4.6, 5.0, 5.3])
def test_the_stray_of_a_ring_in_a_box_is_rated_a_little_too_low(radius):
    route = Route([Arc((0.0, 0.0), radius, 0.0, 2.0 * math.pi + 24.0 / radius)])
    rating = rated(FreeGround(square(6)), NEEDS, route)
    proven = tolerance(Dance(NEEDS.dragon, route), square(6)).stray
    assert proven - 4.0 * RATED_LOW <= rating.stray <= proven + 0.01
    assert rating.length == pytest.approx(route.end)
    assert rating.turns == pytest.approx(route.end / (math.tau * radius), rel=1e-3)


def test_streets_do_not_count():
    ground = FreeGround(Venue(box("square", 0, 0, 20, 10)))
    route = lane((-30, 5), (50, 5))
    assert rated(ground, NEEDS, route).venue < 0.0
    assert rated(ground, NEEDS, route, (36.0, 36.0)).venue > 1.0


def test_the_room_between_two_lanes_is_their_distance_without_the_benches():
    turn = Arc((30, 2.5), 2.5, -0.5 * math.pi, math.pi)
    path = sampled(Route([Line((0, 0), (30, 0)), turn, Line((30, 5), (0, 5))]), NEEDS)
    # The nearest strands that are not parts of one bend are STRANDS chords apart, along the half circle.
    side = float(NEEDS.sides(np.array([1.0 / 2.5]))[0])
    across = 5.0 * math.sin(STRANDS * NEEDS.chord / 5.0)
    assert across - 2.0 * side <= strands(path, NEEDS) <= 5.0 - 0.3 + 1e-6
