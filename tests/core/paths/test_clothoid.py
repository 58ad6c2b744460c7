"""Clothoids against Fresnel integrals to 50 digits, at their ends, as arcs and lines, and what they refuse."""

from __future__ import annotations

import math

import numpy as np
import pytest
from flint import acb
from hypothesis import given, settings
from hypothesis import strategies as st

from core import (
    Arc,
    Budget,
    Clothoid,
    Dance,
    Dragon,
    Judgement,
    Line,
    Route,
    TooMuchWork,
    check,
    highest_speed,
    trajectory,
)
from core.errors import Quantity
from core.kernels.constants import K_END, K_SLOPE, K_START, PART, S_END, S_START
from core.paths import pieces
from tests.support.exact_chain import clothoid_place
from tests.support.near import assert_near
from tests.support.random_routes import Pen
from tests.support.refused import refused
from tests.support.slow_route import ALMOST_AN_ARC, SlowRoute, clothoid_points

# Stated accuracy of a place up to 20 m from the origin [m]; one curve written in two ways [m].
PLACE, SAME = 1e-11, 1e-12
# The slow route's own rounding where the curvature hardly changes [m].
SLOW = 1e-9
DRAGON = Dragon(12, head_length=1.9, body_length=1.5, width=0.3, overhang=0.2)


CASES = {
    "ramp": Clothoid((3.0, -2.0), 0.7, 0.0, 0.6, 3.0),
    "to both sides": Clothoid((-5.0, 4.0), 1e5, -0.6, 0.4, 12.0),
    "almost an arc": Clothoid((0.0, 0.0), -2.0, 0.3, 0.3 + 1e-9, 14.0),
    "almost a line": Clothoid((0.0, 0.0), 3.0, 1e-7, -1e-8, 15.0),
    "wound up": Clothoid((0.0, 0.0), 0.2, 0.0, 1.0, 1_000.0),
    "long": Clothoid((10.0, 10.0), -9.0, 0.0, 0.1, 10_000.0),
    "small": Clothoid((1.0, 1.0), 0.0, -900.0, 700.0, 0.01),
}


@pytest.mark.parametrize("piece", CASES.values(), ids=CASES)
def test_places_are_those_of_fresnel_integrals(piece):
    route = Route([piece])
    for v in (piece.length * np.linspace(0.0, 1.0, 41)).tolist():
        exact = clothoid_place(piece, v)
        assert float(abs(acb(*route.position(v).tolist()) - exact)) < max(PLACE, 1e-12 * float(abs(exact)))
    assert_near(piece.end, route.position(route.end), SAME)


@settings(max_examples=40, deadline=None)
@given(st.floats(-1.5, 1.5), st.floats(-1.5, 1.5), st.floats(0.01, 30.0), st.floats(-3.0, 3.0))
def test_places_and_tangents_are_those_of_scipy(first, last, length, heading):
    piece = Clothoid((1.0, 2.0), heading, first, last, length)
    route, slope = Route([piece]), abs(last - first) / length
    s = np.linspace(-1.0, length + 1.0, 101)
    points, tangents = clothoid_points(piece, s)
    far = 0.0 if slope * length**2 < ALMOST_AN_ARC else abs(first) / slope + 1.0 / math.sqrt(slope)
    assert_near(route.position(s), points, max(SLOW, 1e-14 * far))
    assert_near(route.tangent(s), tangents, SLOW)
    assert_near(route.curvature(s), first + (last - first) * np.clip(s / length, 0.0, 1.0), SAME)


@pytest.mark.parametrize(
    ("curvature", "same"),
    [(0.5, Arc((0.0, 2.0), 2.0, -0.5 * math.pi, 4.5)), (0.0, Line((0.0, 0.0), (9.0, 0.0)))],
    ids=["arc", "line"],
)
def test_a_clothoid_of_one_curvature_is_an_arc_or_a_line(curvature, same):
    s = np.linspace(-3.0, 12.0, 61)
    clothoid = Clothoid((0, 0), 0.0, curvature, curvature, 9.0)
    assert_near(Route([clothoid]).position(s), Route([same]).position(s), SAME)


def test_a_clothoid_danced_back_is_the_same_curve():
    ramp = CASES["to both sides"]
    back = Clothoid(ramp.end, ramp.end_heading + math.pi, -ramp.end_curvature, -ramp.start_curvature, ramp.length)
    s = np.linspace(0.0, ramp.length, 41)
    assert_near(Route([ramp]).position(s), Route([back]).position(ramp.length - s), 1e-9)  # its heading's ULP


def test_every_row_bounds_its_curvature_and_turns_little():
    table = Route([CASES["to both sides"]]).table
    lengths = table[:, S_END] - table[:, S_START]
    assert (np.abs(table[:, [K_START, K_END]]).max(axis=1) * lengths <= pieces.ROW_TURN * (1.0 + 1e-9)).all()
    assert (table[0, K_START], table[-1, K_END]) == (-0.6, 0.4)
    assert (table[1:, K_START] == table[:-1, K_END]).all()
    assert (table[:, K_SLOPE] >= 1.0 / 12.0).all()
    assert set(table[:, PART]) == {0.0}


def test_a_clothoid_that_turns_too_much_is_refused_before_it_is_laid_out():
    assert len(Route([Clothoid((0, 0), 0.0, 0.0, 1.0, 1_000.0)]).table) == 4_000
    with refused("clothoid.length", most=Quantity(1000.0, "m", 6), turn=Quantity(1000.0, "rad", 6)):
        Clothoid((0, 0), 0.0, 0.0, -1.0, 1_000.1)


def test_a_spent_budget_ends_the_layout():
    budget = Budget(1.0)
    budget.spend(2.0)
    with pytest.raises(TooMuchWork, match=r"path\.pieces\[0\]"):
        Route([CASES["wound up"]], budget=budget)


def bend_of(ramps: float) -> Route:
    """A line, a bend by 3 rad of curvature 0.5 / m between two ramps of that length [m], and a line."""
    pen = Pen(-30.0 + 0j)
    pen.line(30.0)
    for first, last, length in ((0.0, 0.5, ramps), (0.5, 0.5, 6.0 - ramps), (0.5, 0.0, ramps)):
        if length > 0.0:
            pen.clothoid(first, last, length)
    pen.line(30.0)
    return Route(pen.pieces, start=30.0)


BLENDED = bend_of(2.0)


def test_a_bend_that_is_blended_has_no_jump_of_curvature():
    s = np.linspace(-1.0, 9.0, 20_001)
    assert np.abs(np.diff(BLENDED.curvature(s))).max() < 0.5 / 2.0 * (s[1] - s[0]) * 1.001


def test_a_ramp_makes_the_fastest_handle_slower():
    """The same angle and the same sharpest curvature, left with a jump or over a ramp."""
    speeds = [highest_speed(Dance(DRAGON, bend_of(ramps)), start=-1.0).speed for ramps in (3.0, 1.0, 0.0)]
    assert speeds == sorted(set(speeds))


def test_handles_are_those_of_the_slow_route_and_check_judges_their_dance():
    dance, slow = Dance(DRAGON, BLENDED), SlowRoute.of(DRAGON, BLENDED)
    times = np.linspace(-5.0, 20.0, 30)
    assert_near(trajectory(dance, times).position, slow.handles(times), 1e-10)
    before, after = slow.handles(np.array([3.0 - 1e-5, 3.0 + 1e-5]))
    assert_near(trajectory(dance, 3.0).velocity, (after - before) / 2e-5, 1e-5)
    assert check(dance, speed_limit=2.0).verdict is Judgement.PASSES


@pytest.mark.parametrize(
    ("first", "last", "calm"), [(0.1, 0.4, True), (0.0, -0.4, True), (0.4, 0.1, False), (-0.1, 0.4, False)]
)
def test_a_growing_clothoid_at_the_beginning_is_calm(first, last, calm):
    """No handle is faster than its leader where the curvature grows in the direction of travel."""
    assert Route([Clothoid((0, 0), 0.0, first, last, 40.0)]).calm_beginning is calm
