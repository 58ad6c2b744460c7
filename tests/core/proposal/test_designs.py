"""Designs laid out: at time 0 the whole dragon stands on its path, in the square or in a street."""

import math

import numpy as np
import pytest

from core import Budget, Dance, Dragon, Figure, Gate, Venue, trajectory
from core.proposal.designs import Design, laid_out, street_length, with_gates
from core.proposal.figures import Shape
from core.proposal.free_ground import FreeGround
from core.proposal.gates import with_streets
from core.proposal.legs import LegFinder
from core.proposal.needs import Needs
from tests.support.random_squares import box

NEEDS = Needs(Dragon(8), 0.05, 0.0)
GATES = (Gate((0.0, 15.0), 0.0), Gate((40.0, 10.0), math.pi))
SHAPES = [
    Shape(Figure.RING, (6.0, 4.0, 4.0)),
    Shape(Figure.SERPENTINE, (4.0, 6.0, 3.0)),
    Shape(Figure.SPIRAL, (6.0, 3.4, 1.6)),
]


@pytest.fixture(scope="module")
def ways():
    venue = with_streets(Venue(box("square", 0, 0, 40, 30)), GATES, (3.0, 3.0), street_length(NEEDS))
    return LegFinder(FreeGround(venue, (np.array([0.0, 0.0]), np.array([40.0, 30.0]))), NEEDS, Budget())


def design(shape):
    return Design(shape.figure, shape, (20.0, 15.0, 0.3))


def handles_at(route, time):
    return trajectory(Dance(NEEDS.dragon, route), time).position


@pytest.mark.parametrize("shape", SHAPES, ids=lambda shape: shape.figure.value)
def test_without_gates_the_whole_dragon_is_on_the_path_and_with_gates_it_begins_and_ends_in_a_street(ways, shape):
    route = laid_out(design(shape), NEEDS, ways)
    assert math.dist(handles_at(route, 0.0)[-1], route.position(route.begin)) < 2e-3
    assert route.end > 0.3 * NEEDS.length
    gated = [laid_out(one, NEEDS, ways) for one in with_gates(design(shape), GATES, NEEDS, ways)]
    assert any(gated)
    for route in filter(None, gated):
        assert handles_at(route, 0.0)[1:, 0].max() < 0.0
        assert handles_at(route, route.end)[:, 0].min() > 40.0


def test_a_figure_that_is_too_short_is_not_laid_out(ways):
    assert laid_out(design(Shape(Figure.RING, (2.0, 2.0, 2.0))), NEEDS, ways) is None
