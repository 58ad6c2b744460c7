"""Clothoids against Fresnel integrals to 50 digits, at their ends, as arcs and lines, and what they refuse."""

from __future__ import annotations

import math

import flint
import numpy as np
import pytest
from flint import acb, arb
from hypothesis import given, settings
from hypothesis import strategies as st

from core import (
    Arc,
    Budget,
    Clothoid,
    Dance,
    Dragon,
    InvalidValue,
    Line,
    Route,
    TooMuchWork,
    check,
    highest_speed,
    trajectory,
)
from core.kernels.constants import K_END, K_SLOPE, K_START, PART, S_END, S_START
from core.paths import pieces
from tests.support.exact_chain import BITS
from tests.support.near import assert_near
from tests.support.slow_route import ALMOST_AN_ARC, SlowRoute, clothoid_points

# Stated accuracy of a place up to 20 m from the origin [m]; one curve written in two ways [m].
PLACE, SAME = 1e-11, 1e-12
# The slow route's own rounding where the curvature hardly changes [m].
SLOW = 1e-9
DRAGON = Dragon(12, head_length=1.9, body_length=1.5, width=0.3, overhang=0.2)


def exact_place(piece: Clothoid, v: float) -> acb:
    """Place on a clothoid by Fresnel integrals of its own numbers [m]."""
    flint.ctx.prec = BITS
    first, last = arb(piece.start_curvature), arb(piece.end_curvature)
    slope, turn = (last - first) / arb(piece.length), acb(0, 1)
    unit = (arb.pi() / abs(slope)).sqrt()
    ends = [(arb(at) + first / slope) / unit for at in (0.0, v)]
    cosines = ends[1].fresnel_c() - ends[0].fresnel_c()
    sines = (ends[1].fresnel_s() - ends[0].fresnel_s()) * (1 if slope > 0 else -1)
    rotated = (turn * (arb(piece.heading) - first**2 / (2 * slope))).exp()
    return acb(*piece.start) + acb(cosines, sines) * unit * rotated


CASES = {
    "ramp": Clothoid((3.0, -2.0), 0.7, 0.0, 0.6, 3.0),
    "to both sides": Clothoid((-5.0, 4.0), 1e5, -0.6, 0.4, 12.0),
    "almost an arc": Clothoid((0.0, 0.0), -2.0, 0.3, 0.3 + 1e-9, 14.0),
    "almost a line": Clothoid((0.0, 0.0), 3.0, 1e-7, -1e-8, 15.0),
    "wound up": Clothoid((0.0, 0.0), 0.2, 0.0, 1.0, 1_000.0),
    "long": Clothoid((10.0, 10.0), -9.0, 0.0, 0.1, 10_000.0),
    "small": Clothoid((1.0, 1.0), 0.0, -900.0, 700.0, 0.01),
}


@pytest.mark.parametrize("name", CASES)
def test_places_are_those_of_fresnel_integrals(name: str) -> None:
    piece = CASES[name]
    route = Route([piece])
    for v in (piece.length * np.linspace(0.0, 1.0, 41)).tolist():
        exact = exact_place(piece, v)
        x, y = route.position(v).tolist()
        far = float(abs(exact))
        assert float(abs(acb(x, y) - exact)) < max(PLACE, 1e-12 * far)
    assert np.hypot(*np.subtract(piece.end, route.position(route.end))) < SAME


@settings(max_examples=60, deadline=None)
@given(st.floats(-1.5, 1.5), st.floats(-1.5, 1.5), st.floats(0.01, 30.0), st.floats(-3.0, 3.0))
def test_places_and_tangents_are_those_of_scipy(first: float, last: float, length: float, heading: float) -> None:
    piece = Clothoid((1.0, 2.0), heading, first, last, length)
    route = Route([piece])
    s = np.linspace(-1.0, length + 1.0, 101)
    points, tangents = clothoid_points(piece, s)
    slope = abs(last - first) / length
    own = (
        SLOW if slope * length**2 < ALMOST_AN_ARC else max(SLOW, 1e-14 * (abs(first) / slope + 1.0 / math.sqrt(slope)))
    )
    assert_near(route.position(s), points, own)
    assert_near(route.tangent(s), tangents, SLOW)
    bends = np.clip(first + (last - first) * s / length, min(first, last), max(first, last))
    assert_near(route.curvature(s), bends, SAME)


def test_a_clothoid_of_one_curvature_is_an_arc_or_a_line() -> None:
    s = np.linspace(-3.0, 12.0, 61)
    arc = Route([Arc((0.0, 2.0), 2.0, -0.5 * math.pi, 4.5)])
    assert_near(Route([Clothoid((0, 0), 0.0, 0.5, 0.5, 9.0)]).position(s), arc.position(s), SAME)
    line = Route([Line((0.0, 0.0), (9.0, 0.0))])
    assert_near(Route([Clothoid((0, 0), 0.0, 0.0, 0.0, 9.0)]).position(s), line.position(s), SAME)


def test_a_clothoid_danced_back_is_the_same_curve() -> None:
    ramp = CASES["to both sides"]
    back = Clothoid(ramp.end, ramp.end_heading + math.pi, -ramp.end_curvature, -ramp.start_curvature, ramp.length)
    s = np.linspace(0.0, ramp.length, 41)
    assert_near(Route([ramp]).position(s), Route([back]).position(ramp.length - s), 1e-9)  # its heading's ULP


def test_every_row_bounds_its_curvature_and_turns_little() -> None:
    table = Route([CASES["to both sides"]]).table
    lengths = table[:, S_END] - table[:, S_START]
    assert (np.abs(table[:, [K_START, K_END]]).max(axis=1) * lengths <= pieces.ROW_TURN * (1.0 + 1e-9)).all()
    assert table[0, K_START] == -0.6
    assert table[-1, K_END] == 0.4
    assert (table[1:, K_START] == table[:-1, K_END]).all()
    assert (table[:, K_SLOPE] >= 1.0 / 12.0).all()
    assert set(table[:, PART]) == {0.0}


def test_a_clothoid_that_turns_too_much_is_refused_before_it_is_laid_out() -> None:
    assert len(Route([Clothoid((0, 0), 0.0, 0.0, 1.0, 1_000.0)]).table) == 4_000
    with pytest.raises(InvalidValue) as refused:
        Clothoid((0, 0), 0.0, 0.0, -1.0, 1_000.1)
    assert refused.value.field == "clothoid.length"
    words = "must be at most 1000 m, where it would turn by 1000 rad at the larger of its curvatures, got 1000.1 m"
    assert words in str(refused.value)


def test_a_spent_budget_ends_the_layout() -> None:
    budget = Budget(1.0)
    budget.spend(2.0)
    with pytest.raises(TooMuchWork, match=r"path\.pieces\[0\]"):
        Route([CASES["wound up"]], budget=budget)


BLENDED = [Line((-30.0, 0.0), (0.0, 0.0)), Clothoid((0, 0), 0.0, 0.0, 0.5, 2.0)]
BLENDED += [Clothoid(BLENDED[-1].end, BLENDED[-1].end_heading, 0.5, 0.5, 4.0)]
BLENDED += [Clothoid(BLENDED[-1].end, BLENDED[-1].end_heading, 0.5, 0.0, 2.0)]


def bend_of(ramps: float) -> Route:
    """A line, a bend by 3 rad of curvature 0.5 / m between two ramps of that length [m], and a line."""
    pieces: list[Line | Clothoid] = [Line((-30.0, 0.0), (0.0, 0.0))]
    place, heading = (0.0, 0.0), 0.0
    for first, last, length in ((0.0, 0.5, ramps), (0.5, 0.5, 6.0 - ramps), (0.5, 0.0, ramps)):
        if length > 0.0:
            pieces.append(Clothoid(place, heading, first, last, length))
            place, heading = pieces[-1].end, pieces[-1].end_heading
    x, y = place
    return Route([*pieces, Line(place, (x + 30.0 * math.cos(heading), y + 30.0 * math.sin(heading)))], start=30.0)


def test_a_bend_that_is_blended_has_no_jump_of_curvature() -> None:
    route = Route(BLENDED, start=30.0)
    s = np.linspace(-1.0, route.end, 20_001)
    assert np.abs(np.diff(route.curvature(s))).max() < 0.5 / 2.0 * (s[1] - s[0]) * 1.001


def test_a_ramp_makes_the_fastest_handle_slower() -> None:
    """The same angle and the same sharpest curvature, left with a jump or over a ramp."""
    speeds = [highest_speed(Dance(DRAGON, bend_of(ramps)), start=-1.0).speed for ramps in (0.0, 1.0, 3.0)]
    assert speeds[0] > speeds[1] > speeds[2]


def test_handles_are_those_of_the_slow_route() -> None:
    route = Route(BLENDED, start=30.0)
    slow = SlowRoute.of(DRAGON, route)
    times = np.linspace(-5.0, route.end, 30)
    rates = np.diff(slow.handles(np.array([3.0 - 1e-5, 3.0 + 1e-5])), axis=0)[0] / 2e-5
    motion = trajectory(Dance(DRAGON, route), times)
    assert_near(motion.position, slow.handles(times), 1e-10)
    assert_near(trajectory(Dance(DRAGON, route), [3.0]).velocity[0], rates, 1e-5)


def test_a_growing_clothoid_at_the_beginning_is_calm() -> None:
    """No handle is faster than its leader where the curvature grows in the direction of travel."""
    assert Route([Clothoid((0, 0), 0.0, 0.1, 0.4, 40.0)]).calm_beginning
    assert Route([Clothoid((0, 0), 0.0, 0.0, -0.4, 40.0)]).calm_beginning
    assert not Route([Clothoid((0, 0), 0.0, 0.4, 0.1, 40.0)]).calm_beginning
    assert not Route([Clothoid((0, 0), 0.0, -0.1, 0.4, 40.0)]).calm_beginning


def test_check_judges_a_dance_on_clothoids() -> None:
    answer = check(Dance(DRAGON, Route(BLENDED, start=30.0)), speed_limit=2.0)
    assert answer.verdict.value == "passes"
