"""The shortest turn: just deeper something touches or a bench cannot follow, at it and above nothing does."""

import math
from functools import cache

import numpy as np
import pytest

import core.design.deepest_turn
from core import (
    Dance,
    Dragon,
    Outcome,
    TooMuchWork,
    Turn,
    TurnLimit,
    deepest_turn,
    first_contact,
    least_clearance,
)
from core.design.deepest_turn import ENTRY_STEP, way_followed
from core.paths.following import bends_widely
from tests.support.depth import further
from tests.support.near import assert_near
from tests.support.slow_route import SlowRoute

ENTRY_ERROR = 1e-9  # [m]
STEP = 0.2  # [s], between the instants that are looked at
FINE_STEP = 2e-3  # [s], the same around the instant of least clearance
DEEPER = 1e-5  # [m], an entry clearly on the other side of the border

# A long head reaches the bend first; as short a head as the body lets benches touch first.
LONG = Dragon(150)
CONTACT = {
    "wide benches": (Dragon(150, head_length=2.2, width=0.45), {"pitch": 1.4, "ratio": 1.0}),
    "margin": (LONG, {"pitch": 1.7, "ratio": 1.0, "margin": 0.2}),
    "small dragon": (Dragon(150, 1.5, 1.5, 0.4, 0.2), {"pitch": 1.1, "ratio": 1.3}),
}
BEND = {
    "contest": (LONG, {"pitch": 1.7}),
    "equal arcs": (LONG, {"pitch": 1.7, "ratio": 1.0}),
}


@cache
def answer(name):
    dragon, request = (CONTACT | BEND)[name]
    return deepest_turn(dragon, **request)


def assert_all_clear(dragon, turn, margin=0.0):
    """All benches pass the turn, although only a part of the dance is followed."""
    way, front = way_followed(dragon, turn, margin)
    span = 1.6 * float(dragon.chords.sum())
    assert way < span
    assert front.benches < dragon.benches
    assert first_contact(Dance(dragon, turn), margin=margin, start=-100.0, stop=span).outcome is Outcome.CLEAR


def turn_with(result, entry):
    """The turn of an answer with another entry radius [m]."""
    return Turn(result.turn.pitch, result.turn.turning_radius, result.turn.ratio, entry_radius=entry)


def slow_clearance(dragon, turn, *span):
    """Least separation of the leading 30 benches that share no handle [m].

    span: start, stop and step [s]; by default from before any of them is in the turn until all are past it
    """
    slow = SlowRoute.of(dragon.leading(30), turn)
    span = span or (-5.0, turn.length + float(slow.chords.sum()) + 5.0, STEP)
    return float(slow.clearance(np.arange(*span))[0].min())


@pytest.mark.parametrize("name", further(CONTACT, 1))
def test_just_deeper_two_benches_come_within_the_margin_and_above_none_do(name):
    dragon, request = CONTACT[name]
    margin = request.get("margin", 0.0)
    result = answer(name)
    infeasible, feasible = result.entry_bracket
    assert result.limited_by is TurnLimit.CONTACT
    assert 0.0 < feasible - infeasible <= ENTRY_ERROR
    assert result.turn.entry_radius == feasible
    around = (result.time - 0.3, result.time + 0.3, FINE_STEP)
    assert slow_clearance(dragon, turn_with(result, infeasible - DEEPER), *around) <= margin
    assert slow_clearance(dragon, turn_with(result, feasible + DEEPER), *around) > margin
    assert slow_clearance(dragon, result.turn) > margin
    assert_all_clear(dragon, result.turn, margin)


@pytest.mark.parametrize("name", further(BEND, 1))
def test_just_deeper_a_bench_cannot_follow_and_above_all_do_without_contact(name):
    dragon, request = BEND[name]
    result = answer(name)
    ratio = request.get("ratio", 2.0)
    infeasible, feasible = result.entry_bracket
    assert (result.limited_by, result.benches, result.time) == (TurnLimit.LEAST_RADIUS, None, None)
    assert 0.0 < feasible - infeasible <= ENTRY_ERROR
    assert not bends_widely(dragon, turn_with(result, infeasible - ENTRY_ERROR))
    assert bends_widely(dragon, turn_with(result, feasible))
    assert slow_clearance(dragon, result.turn) > 0.0
    assert_all_clear(dragon, result.turn)
    # the sum of both radii is sqrt(entry^2 + growth^2), and the smaller one just fits the longest chord
    smaller = 0.5 * float(dragon.chords.max()) / core.kernels.ROUTE_SINE_LIMIT
    total = smaller * (1.0 + ratio) / min(1.0, ratio)
    growth = request["pitch"] / math.tau
    assert_near(feasible, math.sqrt(total**2 - growth**2), 2 * ENTRY_ERROR)


def test_nothing_limits_a_tiny_dragon_down_to_the_centre():
    result = deepest_turn(Dragon(5, 0.1, 0.1, 0.01, 0.01), 1.7)
    step = ENTRY_STEP * 4.5
    assert result.limited_by == TurnLimit.CENTRE
    assert result.entry_bracket == (0.0, step)
    assert result.scan_step == step


def test_one_bench_is_limited_by_the_bend():
    assert deepest_turn(Dragon(1), 1.7, ratio=1.0).limited_by is TurnLimit.LEAST_RADIUS


@pytest.mark.parametrize("work", [1e4, 4e4], ids=["on the first entry", "on one further in"])
def test_work_that_ends_before_the_turn_is_found_is_an_error(monkeypatch, work):
    monkeypatch.setattr(core.design.deepest_turn, "TURN_WORK", work)
    with pytest.raises(TooMuchWork, match=f"^turning_radius must .* within {work:g} steps of work"):
        deepest_turn(Dragon(), 1.7)


def test_work_that_ends_while_the_turn_is_bisected_leaves_a_wider_bracket(monkeypatch):
    (dragon, request), whole = CONTACT["margin"], answer("margin")
    monkeypatch.setattr(core.design.deepest_turn, "TURN_WORK", 4e5)
    low, high = deepest_turn(dragon.leading(30), **request).entry_bracket
    assert low <= whole.entry_bracket[0] < whole.entry_bracket[1] < high


@pytest.mark.thorough
def test_a_margin_that_an_entry_only_just_keeps_is_limited_by_the_pair_that_meets_deeper(monkeypatch):
    """Rounding hides whether the pair meets at that entry, so the lower end of the bracket is a deeper one."""
    dragon = Dragon(40)
    entry = 4.5
    for _ in range(3):  # steps of the scan
        entry -= 0.01 * 4.5

    def dance(entry_radius):
        return Dance(dragon, Turn(1.7, 4.5, 1.0, start_turns=16.0, entry_radius=entry_radius))

    def limit():
        result = deepest_turn(dragon, 1.7, ratio=1.0, margin=least.distance)
        return result.limited_by, result.benches, result.time is None, *result.entry_bracket

    least = least_clearance(dance(entry))
    *limited, infeasible, feasible = limit()
    assert limited == [TurnLimit.CONTACT, least.benches, False]
    assert infeasible < entry <= feasible < infeasible + 20 * ENTRY_ERROR
    assert first_contact(dance(infeasible), margin=least.distance).benches == least.benches
    assert first_contact(dance(feasible), margin=least.distance).outcome is Outcome.CLEAR
    monkeypatch.setattr(core.design.deepest_turn, "LOOKED_BELOW", 0.0)
    assert limit() == (TurnLimit.UNDECIDED, None, True, entry, feasible)
