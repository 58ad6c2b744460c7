"""The shortest turn: no turn on a slow grid is shorter than its bracket, and the turn itself can be danced."""

from functools import cache

import numpy as np
import pytest

import core.design.shortest_turn
from core import (
    Budget,
    Dance,
    Dragon,
    InvalidValue,
    Outcome,
    Turn,
    TurnLimit,
    deepest_turn,
    first_contact,
    shortest_turn,
)
from core.design.turn_bounds import ENTRY_LEAST
from tests.support.depth import DEEP, further, some, thorough
from tests.support.near import assert_near

WHOLE = Dragon()
PITCH = 1.7
RADIUS = 4.5
# Lengths that others found with free entry and exit on grids of 2 mm, and bounds by hand: ratio, length [m].
SHORTEST = {2.0: 11.8105, 1.5: 9.4153, 1.2: 8.6309, 1.0: 8.2271, 0.8: 8.7917}
RATIOS = further(some(list(SHORTEST), 2), 1)
# By how much a grid of 2 mm may miss the shortest one [m]: its length changes by up to 7 m for each metre.
GRID_EXCESS = 0.06
LEAST = 1.43 / 0.999  # [m], the bend that the contest's head can follow
GRID = 0.04 if DEEP else 0.11  # [m], of the slow search
ROUNDED = 1e-8  # [m]


@cache
def answer(ratio):
    return shortest_turn(Dragon(), PITCH, RADIUS, ratio, budget=Budget(1e9))


def is_clear(turn):
    return first_contact(Dance(Dragon(), turn), start=-100.0, stop=500.0).outcome is Outcome.CLEAR


def compared(low, turns, dragon=WHOLE, least=LEAST):
    """How many turns of ratio, entry and exit are shorter than `low` and not; benches meet in each shorter one.

    Those count that stay in the circle, with no arc tighter than `least` [m].
    """
    shorter = longer = 0
    for ratio, entry, leaving in turns:
        try:
            turn = Turn(PITCH, RADIUS, ratio, entry_radius=entry, exit_radius=leaving)
        except InvalidValue:
            continue
        if min(turn.radii) < least - ROUNDED:
            continue
        if turn.length >= low:
            longer += 1
            continue
        shorter += 1
        assert first_contact(Dance(dragon, turn), start=-20.0, stop=60.0).time is not None
    return shorter, longer


@pytest.mark.parametrize("ratio", RATIOS)
def test_no_turn_on_a_slow_grid_is_shorter_than_the_bracket(ratio):
    """Every shorter turn on the grid has a contact."""
    low, high = answer(ratio).length_bracket
    assert 0.0 < high - low <= 1e-6
    radii = np.arange(1.5, RADIUS, GRID).tolist()
    shorter, longer = compared(low, ((ratio, entry, leaving) for entry in radii for leaving in radii))
    assert longer
    assert shorter or ratio > 1.3


@pytest.mark.parametrize("ratio", RATIOS)
def test_the_shortest_turn_is_danced_by_all_benches_and_shorter_than_any_that_was_found(ratio):
    result = answer(ratio)
    turn = answer(ratio).turn
    assert SHORTEST[ratio] - GRID_EXCESS < turn.length < SHORTEST[ratio]
    assert turn.length == result.length_bracket[1]
    assert min(turn.radii) >= LEAST - ROUNDED
    assert is_clear(turn)
    for radius, (low, high) in ((turn.entry_radius, result.entry_bracket), (turn.exit_radius, result.exit_bracket)):
        assert low <= radius <= high


def test_the_contests_turn_is_limited_by_the_least_radius_and_the_circle():
    """There both constraints of the closed forms hold: the second arc as tight as the head can follow, the exit on the
    circle. One bench has the same turn."""
    result = answer(2.0)
    alone = shortest_turn(Dragon(1), PITCH)
    assert result.limited_by == TurnLimit.LEAST_RADIUS
    assert result.turn.exit_radius == RADIUS
    assert_near(min(result.turn.radii), LEAST, 1e-9)
    assert result.turn.length < deepest_turn(Dragon(), PITCH).turn.length - 1.1
    assert alone.limited_by == TurnLimit.LEAST_RADIUS
    assert alone.overlaps == 0
    assert alone.length_bracket == result.length_bracket


@pytest.mark.parametrize("ratio, work", [(2.0, 1e6), *thorough((1.2, 1.2e7))])
def test_spent_work_leaves_a_wider_bracket_that_holds_the_narrow_one(ratio, work):
    whole = answer(ratio)
    brief = shortest_turn(Dragon(), PITCH, RADIUS, ratio, budget=Budget(work))
    assert brief.length_bracket[0] < whole.length_bracket[0] - 1e-3
    assert brief.length_bracket[1] >= whole.length_bracket[0]
    assert brief.entry_bracket[0] <= whole.turn.entry_radius <= brief.entry_bracket[1]


def test_benches_that_cannot_touch_are_limited_by_the_coil_that_they_can_follow():
    result = shortest_turn(Dragon(2), 0.5, 6.0, 5.0)
    assert result.limited_by == TurnLimit.LEAST_RADIUS
    assert result.evaluations > 0
    assert result.entry_bracket[1] - result.entry_bracket[0] < 1e-3


@pytest.mark.parametrize("ratio", [1.0, 2.0])
def test_an_arc_too_short_to_be_drawn_is_no_fault_of_the_request(ratio):
    """The shorter arc of ever shorter turns has less than a micrometre."""
    result = shortest_turn(Dragon(1), 0.5, 6.0, ratio, budget=Budget(4e6))
    assert result.length_bracket[0] < 5.102623 < result.length_bracket[1] + 1e-3


@pytest.mark.thorough
def test_every_dance_above_is_proven(monkeypatch):
    """A turn that the proof refuses is never the answer, even if it is the shortest by the closed forms."""
    proof = core.design.shortest_turn.contact_in
    touching = []
    known = answer(2.0)

    def contact_in(budget, dragon, danced, *more):
        if danced.exit_radius > 4.499 and danced.entry_radius < 4.45:
            touching.append(danced)
            return core.design.deepest_turn.Touch(Outcome.CONTACT)
        return proof(budget, dragon, danced, *more)

    monkeypatch.setattr(core.design.shortest_turn, "contact_in", contact_in)
    result = shortest_turn(Dragon(20), PITCH, budget=Budget(1e7))
    assert touching
    assert result.turn.exit_radius <= 4.499 or result.turn.entry_radius >= 4.45
    assert result.length_bracket[0] <= known.length_bracket[1]


@pytest.mark.parametrize("work", further([1e7, 1e10 if DEEP else 6e7], 1))
def test_no_turn_of_any_ratio_is_shorter_than_the_bracket_over_all_ratios(work):
    """Every shorter turn among random ones has a contact, and of each known ratio none is; also with work that is spent
    long before the bracket is narrow."""
    result = shortest_turn(Dragon(), PITCH, RADIUS, None, budget=Budget(work))
    low, high = result.length_bracket
    assert 5.0 < low < high == result.turn.length
    assert (high - low <= 1e-6) is (work == 1e10)
    rng = np.random.default_rng(3)
    ratios = np.exp(rng.uniform(-0.6, 0.6, 4_000 if DEEP else 400))
    shorter, longer = compared(low, ((ratio, *rng.uniform(1.6, RADIUS, 2).tolist()) for ratio in ratios.tolist()))
    assert longer
    assert shorter or work < 1e10
    assert all(length - GRID_EXCESS > low for length in SHORTEST.values())
    assert is_clear(result.turn)


def test_small_benches_are_limited_by_the_deepest_end_that_is_tried():
    """Neither an arc nor the coil there is as tight as the least radius."""
    small = Dragon(2, head_length=0.3, body_length=0.3, width=0.02, overhang=0.05)
    result = shortest_turn(small, PITCH, RADIUS, 1.0, budget=Budget(1e6))
    assert result.limited_by is TurnLimit.CENTRE
    assert min(result.turn.radii) > 0.1


@pytest.mark.parametrize("radius, ratio", [(1.0, 1.0), (0.5, 2.0), (0.2, None)])
def test_small_benches_in_a_small_circle_are_limited_by_the_least_radius_that_a_turn_may_begin_at(radius, ratio):
    small = Dragon(1, head_length=0.2, width=0.02, overhang=0.05)
    result = shortest_turn(small, PITCH, radius, ratio, budget=Budget(1e7))
    assert result.limited_by is TurnLimit.CENTRE
    ends = result.turn.entry_radius, result.turn.exit_radius
    assert_near(ends, (ENTRY_LEAST, ENTRY_LEAST), 1e-6)
    assert result.length_bracket[0] < result.turn.length < 0.003
