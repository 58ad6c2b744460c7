"""Pieces: what they refuse, and curves through waypoints against SciPy."""

from __future__ import annotations

import math
from collections.abc import Callable
from itertools import pairwise
from typing import Any

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from scipy.integrate import quad
from scipy.interpolate import CubicSpline

from core import Arc, Clothoid, Coil, InvalidValue, Line, Piece, Route, Waypoints
from core.kernels.constants import K_SLOPE, S_START
from tests.core.paths.test_route import Pen, legs
from tests.support.near import assert_near

ARC_ERROR = 1e-10  # [m]: arc length of curves through waypoints


@pytest.mark.parametrize(
    "piece",
    [Line((1, 1), (1, 1)), Arc((0, 0), 2, 0, 0), Coil(0.5, 4, 4)],
    ids=["line", "arc", "coil"],
)
def test_a_piece_of_zero_length_is_refused(piece: Line | Arc | Coil) -> None:
    with pytest.raises(InvalidValue, match=r"^path\.pieces\[0\] must be at least 1e-06 m long, got 0 m") as e:
        Route([piece])
    assert e.value.field == "path.pieces.0"


def test_waypoints_upon_each_other_are_refused() -> None:
    with pytest.raises(InvalidValue) as e:
        Route([Waypoints(((0, 0), (3, 0), (3, 0), (5, 1)))])
    assert e.value.field == "path.pieces.0.points.2"


def test_waypoints_that_stop_on_the_spot_are_refused() -> None:
    with pytest.raises(InvalidValue, match="must not make the curve stop") as e:
        Route([Waypoints(((0, 0), (1, 0), (0, 0)))])
    assert e.value.field == "path.pieces.0.points"


@pytest.mark.parametrize("bad", [math.nan, math.inf, "1", None])
def test_a_coordinate_that_is_no_finite_number_is_refused(bad: object) -> None:
    with pytest.raises(InvalidValue) as e:
        Line((0, 0), (1, bad))  # type: ignore[arg-type]
    assert e.value.field == "line.end.1"


RAMP = {"start": (0, 0), "heading": 0.0, "start_curvature": 0.0, "end_curvature": 0.5, "length": 2.0}
FIELDS_THAT_ARE_NONE: list[tuple[Callable[..., Piece], dict[str, Any], str, str]] = [
    (Waypoints, {"points": ((0, 0), (5, 5)), "start_heading": math.nan}, "start_heading", "finite number, got nan rad"),
    (Waypoints, {"points": ((0, 0), (5, 5)), "end_heading": math.inf}, "end_heading", "finite number, got inf rad"),
    (Waypoints, {"points": ((0, 0), (5, 5)), "start_heading": "north"}, "start_heading", "a number, got 'north'"),
    (Waypoints, {"points": ((0, 0), (5, 5)), "start_heading": 2e6}, "start_heading", "1e+06 rad, got 2000000 rad"),
    (Waypoints, {"points": None}, "points", "a list of points [x, y] in metres, got None"),
    (Waypoints, {"points": "ab"}, "points", "a list of points [x, y] in metres, got 'ab'"),
    (Waypoints, {"points": ((0, 0),)}, "points", "at least 2 points, got 1"),
    (Waypoints, {"points": ((0, 0), 7)}, "points[1]", "a point [x, y] in metres, got 7"),
    (Waypoints, {"points": ((0, 0), (5, 10**400))}, "points[1][1]", "from -100000 to 100000 m, got 1e308 or more"),
    (Line, {"start": 0, "end": 1}, "start", "a point [x, y] in metres, got 0"),
    (Line, {"start": (0, 0), "end": "ab"}, "end[0]", "a number, got 'a'"),
    (Arc, {"centre": (0, 0), "radius": 3, "start_angle": math.nan, "sweep": 1}, "start_angle", "got nan rad"),
    (Arc, {"centre": (0, 0), "radius": None, "start_angle": 0, "sweep": 1}, "radius", "a number, got None"),
    (Arc, {"centre": (0, 0), "radius": -3, "start_angle": 0, "sweep": 1}, "radius", "positive, got -3 m"),
    (Arc, {"centre": (0, 0), "radius": 3, "start_angle": 0, "sweep": True}, "sweep", "a number, got True"),
    (Clothoid, RAMP | {"start": (0, math.nan)}, "start[1]", "got nan m"),
    (Clothoid, RAMP | {"heading": "east"}, "heading", "a number, got 'east'"),
    (Clothoid, RAMP | {"end_curvature": 1001}, "end_curvature", "at most 1000 1/m, got 1001 1/m"),
    (Clothoid, RAMP | {"start_curvature": math.inf}, "start_curvature", "got inf 1/m"),
    (Clothoid, RAMP | {"length": 0}, "length", "positive, got 0 m"),
    (Coil, {"pitch": 0.5, "start_turns": 5, "end_turns": 3, "rotation": math.inf}, "rotation", "got inf rad"),
    (Coil, {"pitch": 0.5, "start_turns": "5", "end_turns": 3}, "start_turns", "a number, got '5'"),
    (Coil, {"pitch": 0.5, "start_turns": 5, "end_turns": -3}, "end_turns", "zero or more, got -3 turns"),
]  # fmt: skip


@pytest.mark.parametrize(
    ("kind", "values", "field", "words"),
    FIELDS_THAT_ARE_NONE,
    ids=[f"{k.__name__} {w}" for k, _, _, w in FIELDS_THAT_ARE_NONE],
)
def test_a_piece_refuses_an_invalid_field_when_it_is_made(
    kind: Callable[..., Piece], values: dict[str, Any], field: str, words: str
) -> None:
    with pytest.raises(InvalidValue) as e:
        kind(**values)
    name = f"{kind.__name__.lower()}.{field}"
    assert e.value.message.startswith(f"{name} must be ")
    assert e.value.message.endswith(words)
    assert e.value.field == name.replace("[", ".").replace("]", "")


POINTS = ((0.0, 0.0), (6.0, 1.0), (11.0, 6.0), (9.0, 13.0), (2.0, 14.0), (-3.0, 9.0))


def spline_of(points: tuple[tuple[float, float], ...]) -> tuple[CubicSpline, np.ndarray]:
    knots = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1))])
    return CubicSpline(knots, points, bc_type="natural"), knots


def arc_of(spline: CubicSpline, knots: np.ndarray, end: float) -> float:
    """Arc length of a spline from its beginning, by adaptive quadrature between the knots."""
    stops = [*knots[knots < end], end]
    speed = spline.derivative()
    return sum(
        quad(lambda t: float(np.linalg.norm(speed(t))), a, b, epsabs=1e-13, epsrel=1e-13, limit=200)[0]
        for a, b in pairwise(stops)
    )


def test_the_arc_length_through_waypoints_is_scipys() -> None:
    route = Route([Waypoints(POINTS)])
    spline, knots = spline_of(POINTS)
    assert_near(route.end - route.begin, arc_of(spline, knots, knots[-1]), ARC_ERROR)
    for t in np.linspace(0.7, knots[-1] - 0.1, 12):
        assert_near(route.position(arc_of(spline, knots, t)), spline(t), ARC_ERROR)


@settings(max_examples=25, deadline=None)
@given(legs)
def test_the_arc_length_through_random_waypoints_is_scipys(steps: list[tuple[float, float]]) -> None:
    pen = Pen(0j, 0.0)
    pen.waypoints(steps)
    points = pen.pieces[0].points
    spline, knots = spline_of(points)
    route = Route([Waypoints(points)])
    assert_near(route.end - route.begin, arc_of(spline, knots, knots[-1]), ARC_ERROR)


def test_the_curve_passes_through_its_waypoints_without_a_jump_of_curvature() -> None:
    route = Route([Waypoints(POINTS)])
    spline, knots = spline_of(POINTS)
    at_knots = [arc_of(spline, knots, t) for t in knots[1:-1]]
    assert_near(route.position(np.array(at_knots)), POINTS[1:-1], ARC_ERROR)
    inner = np.array([*at_knots, *route.table[1:, S_START]])
    step = 1e-7
    assert_near(route.curvature(inner + step), route.curvature(inner - step), 1e-6)  # slope below 5 / m^2
    assert np.abs(route.curvature(np.array([route.begin, route.end]))).max() < 1e-9  # natural ends


def test_waypoints_take_the_headings_at_their_ends() -> None:
    route = Route([Waypoints(POINTS, start_heading=0.3, end_heading=-2.0)])
    ends = route.tangent(np.array([route.begin, route.end]))
    assert_near(ends, np.array([[math.cos(a), math.sin(a)] for a in (0.3, -2.0)]), 1e-12)


def test_two_waypoints_are_a_line() -> None:
    a, b = Route([Waypoints(((0, 0), (3, 4)))]), Route([Line((0, 0), (3, 4))])
    s = np.linspace(0.0, 5.0, 11)
    assert_near(a.end, 5.0, 1e-14)
    assert_near(a.position(s), b.position(s), 1e-13)


@settings(deadline=None)
@given(st.floats(0.3, 3.0), st.floats(0.0, 12.0), st.floats(0.0, 12.0))
def test_a_coil_bends_no_faster_than_its_row_says(pitch: float, start: float, end: float) -> None:
    assume(abs(start - end) > 0.1)
    route = Route([Coil(pitch, start, end)])
    places = np.linspace(route.begin, route.end, 400)
    steepest = np.abs(np.diff(route.curvature(places)) / np.diff(places)).max()
    row = route.table[0]
    assert steepest <= row[K_SLOPE] * (1.0 + 1e-9) + 1e-9
    assert min(start, end) < 0.5 or steepest >= 0.4 * row[K_SLOPE]
