"""Pieces: what they refuse, and curves through waypoints against SciPy."""

import math

import numpy as np
import pytest

from core import Clothoid, Route, Waypoints
from core.kernels.constants import S_START
from tests.support.near import assert_near
from tests.support.refused import refused
from tests.support.slow_curve import spline_length, spline_of

ARC_ERROR = 1e-10  # [m]: arc length of curves through waypoints


@pytest.mark.parametrize(
    "field, pieces",
    [
        ("waypoints.points", lambda: Waypoints(((0, 0),))),
        ("waypoints.points.1.1", lambda: Waypoints(((0, 0), (5, 10**400)))),
        ("clothoid.start.1", lambda: Clothoid((0, math.nan), 0.0, 0.0, 0.5, 2.0)),
    ],
)
def test_a_piece_that_cannot_be_is_refused_at_its_place(field, pieces):
    with refused(field):
        Route(pieces())


POINTS = ((0.0, 0.0), (6.0, 1.0), (11.0, 6.0), (9.0, 13.0), (2.0, 14.0), (-3.0, 9.0))


def test_the_curve_through_waypoints_is_scipys_without_a_jump_of_curvature():
    route = Route([Waypoints(POINTS)])
    spline, knots = spline_of(POINTS)
    for t in np.linspace(0.7, knots[-1] - 0.1, 12):
        assert_near(route.position(spline_length(spline, knots, t)), spline(t), ARC_ERROR)
    at_knots = [spline_length(spline, knots, t) for t in knots[1:-1]]
    assert_near(route.position(np.array(at_knots)), POINTS[1:-1], ARC_ERROR)
    inner = np.array([*at_knots, *route.table[1:, S_START]])
    assert_near(route.curvature(inner + 1e-7), route.curvature(inner - 1e-7), 1e-6)  # slope below 5 / m^2
    assert_near(route.curvature(np.array([route.begin, route.end])), [0.0, 0.0], 1e-9)  # natural ends


def test_waypoints_take_the_headings_at_their_ends():
    route = Route([Waypoints(POINTS, start_heading=0.3, end_heading=-2.0)])
    ends = route.tangent(np.array([route.begin, route.end]))
    assert_near(ends, [[math.cos(a), math.sin(a)] for a in (0.3, -2.0)], 1e-12)
