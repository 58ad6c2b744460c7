"""Curves through waypoints as cubics: exact lengths, true bounds on curvature, few of them, and an end to cutting."""

from __future__ import annotations

import math
from itertools import pairwise
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.interpolate import CubicSpline

from core import InvalidValue, Route, Waypoints
from core.kernels.constants import CREST, K_END, K_SLOPE, K_START, PIECE_KIND, S_END, S_START
from core.paths import cubics
from tests.support.near import assert_near

ARC_ERROR = 1e-10  # [m]
# A place is an arc length, good to some 1e-15 of all of it; next to a sharp crest it moves the curvature most. Relative
# to the curvature plus one, for crests below 40 / m on curves below 1 km [1].
CURVATURE_ERROR = 1e-9
SHARPEST = 40.0  # [1/m]

Points = tuple[tuple[float, float], ...]


def zigzag(count: int) -> Points:
    return tuple((6.0 * k, 5.0 * (k % 2)) for k in range(count))


def circle(count: int) -> Points:
    radius, angles = 0.7 * count, np.linspace(0.0, 6.0, count)
    return tuple(zip((radius * np.cos(angles)).tolist(), (radius * np.sin(angles)).tolist(), strict=True))


def wander(count: int) -> Points:
    steps = np.random.default_rng(count).normal(0.0, 4.0, (count, 2))
    return tuple(map(tuple, np.cumsum(steps, axis=0).tolist()))


def fine_length(points: Points) -> float:
    """Arc length of the natural spline by 24-point Gauss-Legendre on 64 equal parts of each leg [m]."""
    knots = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1))])
    speed = CubicSpline(knots, points, bc_type="natural").derivative()
    stops = np.concatenate([np.linspace(a, b, 65)[:-1] for a, b in pairwise(knots)])
    widths = np.diff([*stops, knots[-1]])
    nodes, weights = np.polynomial.legendre.leggauss(24)
    places = stops[:, None] + 0.5 * widths[:, None] * (1.0 + nodes)
    return math.fsum((0.5 * widths * (np.linalg.norm(speed(places), axis=-1) @ weights)).tolist())


@pytest.mark.parametrize("points", [zigzag(60), zigzag(300), circle(300), wander(7)], ids=len)
def test_the_length_of_many_legs_is_that_of_a_finer_quadrature(points: Points) -> None:
    route = Route([Waypoints(points)])
    assert_near(route.end, fine_length(points), ARC_ERROR)


@pytest.mark.parametrize(("points", "most"), [(zigzag(300), 6), (circle(300), 1.01)], ids=["zigzag", "circle"])
def test_a_leg_takes_few_cubics(points: Points, most: float) -> None:
    assert len(Route([Waypoints(points)]).table) <= most * len(points)


def assert_bounded(route: Route) -> None:
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


@settings(max_examples=60, deadline=None)
@given(legs)
def test_the_curvature_of_every_cubic_lies_between_its_bounds(steps: list[tuple[float, float]]) -> None:
    along, turned = np.array(steps).T
    heading = np.cumsum(turned)
    points = np.cumsum(np.stack([along * np.cos(heading), along * np.sin(heading)], axis=-1), axis=0)
    assert_bounded(Route([Waypoints(((0.0, 0.0), *map(tuple, points.tolist())))]))


def test_a_zigzag_has_crests_and_they_are_bounded() -> None:
    route = Route([Waypoints(zigzag(8), start_heading=0.0, end_heading=1.0)])
    assert (route.table[:, PIECE_KIND] == CREST).any()
    assert_bounded(route)


def test_places_in_any_order_are_found_on_their_pieces() -> None:
    route = Route([Waypoints(zigzag(200))])
    s = np.random.default_rng(3).uniform(route.begin - 1.0, route.end + 1.0, 2_000)
    in_order = np.argsort(s)
    assert (route.position(s)[in_order] == route.position(s[in_order])).all()
    assert (route.position(s[:50]) == [route.position(one) for one in s[:50]]).all()
    # a joint belongs to the piece behind it
    joints = np.concatenate([route.table[:, S_END], route.table[::-1, S_END]])
    behind = route.table[np.searchsorted(route.table[:-1, S_END], joints)]
    known = behind[:, PIECE_KIND] != CREST
    assert np.abs(route.curvature(joints) - behind[:, K_END])[known].max() < CURVATURE_ERROR


STOPPING: dict[str, Points] = {
    "there and back": tuple((float(k % 2), 0.0) for k in range(1_000)),
    "there and back, almost": tuple((float(k % 2), 1e-9 * k) for k in range(1_000)),
    "there and back, to the limits": tuple((1e5 * (k % 2), 0.0) for k in range(1_000)),
    "there and almost back, to the limits": tuple((1e5 * (k % 2), 1e-3 * k) for k in range(1_000)),
}
HOSTILE: dict[str, Points] = {
    "there and almost back": tuple((1e5 * (k % 2), 1e2 * k) for k in range(1_000)),
    "in a square of a millimetre": tuple((1e-3 * (k // 2 % 2), 1e-3 * ((k + 1) // 2 % 2)) for k in range(1_000)),
    "anywhere": tuple(map(tuple, np.random.default_rng(1).uniform(-1e5, 1e5, (1_000, 2)).tolist())),
}


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("points", STOPPING.values(), ids=STOPPING)
def test_a_curve_that_comes_to_rest_is_refused(points: Points) -> None:
    with pytest.raises(InvalidValue, match="stop or turn on the spot, as between points") as e:
        Route([Waypoints(points)])
    assert e.value.field == "path.pieces.0.points"


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("points", HOSTILE.values(), ids=HOSTILE)
def test_points_far_apart_and_close_together_make_a_finite_path(points: Points) -> None:
    table = Route([Waypoints(points)]).table
    assert np.isfinite(table).all()
    assert (table[:, S_END] > table[:, S_START]).all()
    assert len(table) <= 30 * len(points)


def test_a_curve_of_too_many_cubics_is_refused(monkeypatch: Any) -> None:
    cuts = len(Route([Waypoints(zigzag(20))]).table)
    monkeypatch.setattr(cubics, "CUBICS_MAX", cuts)
    assert len(Route([Waypoints(zigzag(20))]).table) == cuts
    monkeypatch.setattr(cubics, "CUBICS_MAX", cuts - 1)
    with pytest.raises(InvalidValue, match=f"at most {cuts - 1} cubics: take fewer points") as e:
        Route([Waypoints(zigzag(20))])
    assert e.value.field == "path.pieces.0.points"
