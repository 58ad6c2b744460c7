"""Pieces: what they refuse, and curves through waypoints against SciPy."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from core import Arc, Clothoid, Coil, InvalidValue, Line, Piece, Route, Waypoints
from core.kernels.constants import K_SLOPE, S_START
from tests.support.near import assert_near
from tests.support.random_routes import Pen, legs
from tests.support.refused import refused
from tests.support.slow_curve import spline_length, spline_of

ARC_ERROR = 1e-10  # [m]: arc length of curves through waypoints


@pytest.mark.parametrize(
    ("piece", "field"),
    [
        *((piece, "path.pieces.0") for piece in (Line((1, 1), (1, 1)), Arc((0, 0), 2, 0, 0), Coil(0.5, 4, 4))),
        (Waypoints(((0, 0), (3, 0), (3, 0), (5, 1))), "path.pieces.0.points.2"),
        (Waypoints(((0, 0), (1, 0), (0, 0))), "path.pieces.0.points"),
    ],
    ids=["line", "arc", "coil", "waypoints upon each other", "waypoints that stop on the spot"],
)
def test_a_piece_of_zero_length_or_that_stops_is_refused(piece, field):
    with refused(field):
        Route([piece])


VALID: dict[Callable[..., Piece], dict[str, Any]] = {
    Line: {"start": (0, 0), "end": (5, 5)},
    Arc: {"centre": (0, 0), "radius": 3, "start_angle": 0, "sweep": 1},
    Clothoid: {"start": (0, 0), "heading": 0.0, "start_curvature": 0.0, "end_curvature": 0.5, "length": 2.0},
    Coil: {"pitch": 0.5, "start_turns": 5, "end_turns": 3},
    Waypoints: {"points": ((0, 0), (5, 5))},
}
UNITS = {
    Arc: {"radius": "m", "start_angle": "rad", "sweep": "rad"},
    Clothoid: {"heading": "rad", "start_curvature": "1/m", "end_curvature": "1/m", "length": "m"},
    Coil: {"pitch": "m", "start_turns": "turns", "end_turns": "turns", "rotation": "rad"},
    Waypoints: {"start_heading": "rad", "end_heading": "rad"},
}


@pytest.mark.parametrize("number", [math.nan, math.inf])
@pytest.mark.parametrize("kind", UNITS)
def test_a_number_that_is_not_finite_is_refused_with_its_unit(kind, number):
    for field, unit in UNITS[kind].items():
        with pytest.raises(InvalidValue) as caught:
            kind(**VALID[kind] | {field: number})
        assert (caught.value.field, caught.value.got.unit) == (f"{kind.__name__.lower()}.{field}", unit)


@pytest.mark.parametrize(
    ("kind", "field", "value", "place"),
    [
        *((Waypoints, "start_heading", value, "") for value in ("north", 2e6)),
        *((Waypoints, "points", value, "") for value in (None, "ab", ((0, 0),))),
        *((Waypoints, "points", ((0, 0), 7), ".1"), (Waypoints, "points", ((0, 0), (5, 10**400)), ".1.1")),
        *((Line, "start", 0, ""), (Line, "end", "ab", ".0"), (Clothoid, "start", (0, math.nan), ".1")),
        *((Line, "end", (1, value), ".1") for value in (math.nan, math.inf, "1", None)),
        *((Arc, "radius", None, ""), (Arc, "radius", -3, ""), (Arc, "sweep", True, "")),
        *((Clothoid, "heading", "east", ""), (Clothoid, "end_curvature", 1001, ""), (Clothoid, "length", 0, "")),
        *((Coil, "start_turns", "5", ""), (Coil, "end_turns", -3, "")),
    ],
)
def test_a_piece_refuses_an_invalid_field_when_it_is_made(kind, field, value, place):
    with refused(f"{kind.__name__.lower()}.{field}{place}"):
        kind(**VALID[kind] | {field: value})


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


@settings(max_examples=20, deadline=None)
@given(legs)
def test_the_arc_length_through_random_waypoints_is_scipys(steps):
    pen = Pen()
    pen.waypoints(steps)
    points = pen.pieces[0].points
    spline, knots = spline_of(points)
    route = Route([Waypoints(points)])
    assert_near(route.end - route.begin, spline_length(spline, knots, knots[-1]), ARC_ERROR)


def test_waypoints_take_the_headings_at_their_ends():
    route = Route([Waypoints(POINTS, start_heading=0.3, end_heading=-2.0)])
    ends = route.tangent(np.array([route.begin, route.end]))
    assert_near(ends, [[math.cos(a), math.sin(a)] for a in (0.3, -2.0)], 1e-12)


def test_two_waypoints_are_a_line():
    a, b = Route([Waypoints(((0, 0), (3, 4)))]), Route([Line((0, 0), (3, 4))])
    s = np.linspace(0.0, 5.0, 11)
    assert_near(a.end, 5.0, 1e-14)
    assert_near(a.position(s), b.position(s), 1e-13)


@settings(max_examples=50, deadline=None)
@given(st.floats(0.3, 3.0), st.floats(0.0, 12.0), st.floats(0.0, 12.0))
def test_a_coil_bends_no_faster_than_its_row_says(pitch, start, end):
    assume(abs(start - end) > 0.1)
    route = Route([Coil(pitch, start, end)])
    places = np.linspace(route.begin, route.end, 400)
    steepest = np.abs(np.diff(route.curvature(places)) / np.diff(places)).max()
    slope = route.table[0, K_SLOPE]
    assert steepest <= slope * (1.0 + 1e-9) + 1e-9
    assert min(start, end) < 0.5 or steepest >= 0.4 * slope
