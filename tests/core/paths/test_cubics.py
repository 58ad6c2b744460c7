"""Curves through waypoints as cubics: exact lengths, true bounds on curvature, few of them, and an end to cutting."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from core import Clothoid, Coil, Route, Waypoints
from core.kernels.constants import CREST, K_END, K_SLOPE, K_START, PIECE_KIND, S_END, S_START
from core.paths import cubics
from tests.support.near import assert_near
from tests.support.refused import refused
from tests.support.slow_curve import spline_length, spline_of

ARC_ERROR = 1e-10  # [m]
# A place is an arc length, good to some 1e-15 of all of it; next to a sharp crest it moves the curvature most. Relative
# to the curvature plus one, for crests below 40 / m on curves below 1 km [1].
CURVATURE_ERROR = 1e-9
SHARPEST = 40.0  # [1/m]


def points_of(x, y):
    return tuple(map(tuple, np.stack(np.broadcast_arrays(x, y), axis=-1).tolist()))


def zigzag(count, step=6.0, height=5.0):
    return points_of(step * np.arange(count), height * (np.arange(count) % 2))


def circle(count):
    angles = np.linspace(0.0, 6.0, count)
    return points_of(0.7 * count * np.cos(angles), 0.7 * count * np.sin(angles))


WANDER = points_of(*np.cumsum(np.random.default_rng(7).normal(0.0, 4.0, (7, 2)), axis=0).T)


@pytest.mark.parametrize("points, most", [(zigzag(300), 6), (circle(300), 1.01), (WANDER, math.inf)])
def test_the_length_of_many_legs_is_that_of_a_finer_quadrature_in_few_cubics(points, most):
    route = Route([Waypoints(points)])
    spline, knots = spline_of(points)
    assert_near(route.end, spline_length(spline, knots, knots[-1]), ARC_ERROR)
    assert len(route.table) <= most * len(points)


def assert_bounded(route):
    """The curvature of every row lies between its bounds, and is monotonic where these are its values at the ends."""
    checked = 0
    for row in route.table:
        places = np.linspace(row[S_START], row[S_END], 34)[1:]
        bends = route.curvature(places)
        error = CURVATURE_ERROR * (1.0 + np.abs(bends).max())
        low, high = sorted((row[K_START], row[K_END]))
        if max(-low, high) > SHARPEST:
            continue
        checked += 1
        assert low - error <= bends.min() <= bends.max() <= high + error
        assert (np.abs(np.diff(bends)) <= row[K_SLOPE] * np.diff(places) + 2.0 * error).all()
        if row[PIECE_KIND] != CREST:
            assert_near(bends[-1], row[K_END], error)
            assert (np.diff(bends) * math.copysign(1.0, row[K_END] - row[K_START]) >= -error).all()
        else:
            ends = route.curvature(np.array([row[S_START] + 1e-12, row[S_END]]))
            excess = max(high - ends.max(), ends.min() - low)
            assert excess <= cubics.CREST_EXCESS * max(1.0, np.abs(ends).max()) + error
    assert checked


legs = st.lists(st.tuples(st.floats(0.5, 20.0), st.floats(-2.0, 2.0)), min_size=2, max_size=12)


@settings(max_examples=40, deadline=None)
@given(legs)
def test_the_curvature_of_every_cubic_lies_between_its_bounds(steps):
    along, turned = np.array(steps).T
    places = np.cumsum(along * np.exp(1j * np.cumsum(turned)))
    assert_bounded(Route([Waypoints(((0.0, 0.0), *points_of(places.real, places.imag)))]))


def test_a_zigzag_has_crests_and_they_are_bounded():
    route = Route([Waypoints(zigzag(8), start_heading=0.0, end_heading=1.0)])
    assert (route.table[:, PIECE_KIND] == CREST).any()
    assert_bounded(route)


@pytest.mark.parametrize(
    "piece",
    [Coil(40.0, 3.0, 0.3), Coil(0.5, 0.0, 4.0), Clothoid((0.0, 0.0), 0.0, -0.6, 0.4, 12.0)],
    ids=["inwards", "outwards", "clothoid"],
)
def test_the_curvature_of_a_spiral_lies_between_its_bounds(piece):
    assert_bounded(Route([piece]))


def test_a_joint_belongs_to_the_piece_behind_it():
    route = Route([Waypoints(zigzag(200))])
    smooth = route.table[::-1][route.table[::-1, PIECE_KIND] != CREST]
    assert_near(route.curvature(smooth[:, S_END]), smooth[:, K_END], CURVATURE_ERROR)


STOPPING = {
    "there and back": zigzag(1_000, 0.0, 1.0),
    "there and almost back, to the limits": zigzag(1_000, 1e-3, 1e5),
}
SQUARE = 1e-3 * (np.arange(1_001) // 2 % 2)
HOSTILE = {
    "in a square of a millimetre": points_of(SQUARE[:-1], SQUARE[1:]),
    "anywhere": points_of(*np.random.default_rng(1).uniform(-1e5, 1e5, (1_000, 2)).T),
}


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("points", STOPPING.values(), ids=STOPPING)
def test_a_curve_that_comes_to_rest_is_refused(points):
    with refused("path.pieces.0.points"):
        Route([Waypoints(points)])


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("points", HOSTILE.values(), ids=HOSTILE)
def test_points_far_apart_and_close_together_make_a_finite_path(points):
    table = Route([Waypoints(points)]).table
    assert np.isfinite(table).all()
    assert (table[:, S_END] > table[:, S_START]).all()
    assert len(table) <= 30 * len(points)


def test_a_curve_of_too_many_cubics_is_refused(monkeypatch):
    pieces = [Waypoints(zigzag(20))]
    cuts = len(Route(pieces).table)
    monkeypatch.setattr(cubics, "CUBICS_MAX", cuts)
    assert len(Route(pieces).table) == cuts
    monkeypatch.setattr(cubics, "CUBICS_MAX", cuts - 1)
    with refused("path.pieces.0.points", most=cuts - 1):
        Route(pieces)
