"""Designs laid out: at time 0 the whole dragon stands on its path, in the square or in a street."""

from __future__ import annotations

import math

import numpy as np
import pytest

from core import Budget, Dance, Dragon, Figure, Gate, Route, Venue, trajectory
from core.proposal.designs import Design, gate_poses, in_world, laid_out, stand_length, street_length, with_gates
from core.proposal.figures import Shape
from core.proposal.free_ground import FreeGround
from core.proposal.gates import with_streets
from core.proposal.legs import LegFinder
from core.proposal.needs import Needs
from tests.support.random_squares import box

NEEDS = Needs(Dragon(8), 0.05, 0.0)
SQUARE = Venue(box("square", 0, 0, 40, 30))
GATES = (Gate((0.0, 15.0), 0.0), Gate((40.0, 10.0), math.pi))
OVAL = Shape(Figure.RING, (6.0, 4.0, 4.0))
LANES = Shape(Figure.SERPENTINE, (4.0, 6.0, 3.0))
SPIRAL = Shape(Figure.SPIRAL, (6.0, 3.4, 1.6))
MIDDLE = (20.0, 15.0, 0.3)


def ways() -> LegFinder:
    venue = with_streets(SQUARE, GATES, 3.0, street_length(NEEDS))
    return LegFinder(FreeGround(venue, (np.array([0.0, 0.0]), np.array([40.0, 30.0]))), NEEDS, Budget())


def handles_at(route: Route, time: float) -> np.ndarray:
    return trajectory(Dance(NEEDS.dragon, route), [time]).position[0]


@pytest.mark.parametrize("shape", [OVAL, LANES, SPIRAL], ids=lambda shape: shape.figure.value)
def test_without_gates_the_whole_dragon_is_on_the_path_at_time_0(shape: Shape) -> None:
    route = laid_out(Design(shape.figure, shape, MIDDLE), NEEDS, ways())
    assert route is not None
    first = route.position(np.array([route.begin]))[0]
    assert np.hypot(*(handles_at(route, 0.0)[-1] - first)) < 2e-3
    assert route.end > 0.3 * NEEDS.length


@pytest.mark.parametrize("shape", [OVAL, LANES, SPIRAL], ids=lambda shape: shape.figure.value)
def test_with_gates_the_dance_begins_and_ends_in_a_street(shape: Shape) -> None:
    there = ways()
    designs = list(with_gates(Design(shape.figure, shape, MIDDLE), GATES, NEEDS, there))
    assert designs
    routes = [route for design in designs if (route := laid_out(design, NEEDS, there)) is not None]
    assert routes
    for route in routes:
        assert (handles_at(route, 0.0)[1:, 0] < 0.0).all()
        assert (handles_at(route, route.end)[:, 0] > 40.0).all()


def test_a_parade_leads_from_gate_to_gate() -> None:
    route = laid_out(Design(Figure.PARADE, None, (0.0, 0.0, 0.0), GATES), NEEDS, ways())
    assert route is not None
    assert route.position(np.array([route.begin]))[0] == pytest.approx([-stand_length(NEEDS), 15.0], abs=1e-9)
    assert route.position(np.array([route.end]))[0] == pytest.approx([40.0 + stand_length(NEEDS), 10.0], abs=1e-9)


def test_a_figure_that_is_too_short_is_not_laid_out() -> None:
    small = Shape(Figure.RING, (2.0, 2.0, 2.0))
    assert laid_out(Design(Figure.RING, small, MIDDLE), NEEDS, ways()) is None


def test_poses_at_a_gate_and_beside_another_pose() -> None:
    into, out = gate_poses(Gate((1.0, 2.0), 0.5 * math.pi), 3.0)
    assert into == pytest.approx((1.0, 5.0, 0.5 * math.pi))
    assert out == pytest.approx((1.0, 5.0, 1.5 * math.pi))
    assert in_world((1.0, 1.0, 0.5 * math.pi), (2.0, 0.0, 0.1)) == pytest.approx((1.0, 3.0, 0.5 * math.pi + 0.1))
