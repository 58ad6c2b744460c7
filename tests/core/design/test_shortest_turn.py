"""The shortest turn: no turn on a slow grid is shorter than its bracket, and the turn itself can be danced."""

from __future__ import annotations

import math
from collections.abc import Iterable
from functools import cache

import numpy as np
import pytest
from scipy.optimize import brentq

import core.design.shortest_turn
from core import (
    Arc,
    Budget,
    Coil,
    Dance,
    Dragon,
    InvalidValue,
    Outcome,
    Route,
    ShortestTurn,
    TooMuchWork,
    Turn,
    TurnLimit,
    deepest_turn,
    first_contact,
    shortest_turn,
)
from tests.support.depth import DEEP, some

PITCH, RADIUS = 1.7, 4.5
# Lengths that others found with free entry and exit on grids of 2 mm, and bounds by hand: ratio, length [m].
SHORTEST = {2.0: 11.8105, 1.5: 9.4153, 1.2: 8.6309, 1.0: 8.2271, 0.8: 8.7917}
# By how much a grid of 2 mm may miss the shortest one [m]: its length changes by up to 7 m for each metre.
GRID_EXCESS = 0.06
LEAST = 1.43 / 0.999  # [m], the bend that the contest's head can follow
GRID = 0.04 if DEEP else 0.11  # [m], of the slow search
ROUNDED = 1e-8  # [m], rounding of the oracle's arcs


@cache
def answer(ratio: float) -> ShortestTurn:
    return shortest_turn(Dragon(), PITCH, RADIUS, ratio, budget=Budget(1e9))


def point(radius: float, outwards: bool) -> tuple[complex, complex]:
    """Point of a coil at a radius [m] and the direction of travel there, by a difference quotient."""
    growth, step = PITCH / (2.0 * math.pi), 1e-6

    def at(r: float) -> complex:
        place = r * np.exp(1j * r / growth)
        return complex(-place if outwards else place)

    ahead = (at(radius + step) - at(radius - step)) * (1.0 if outwards else -1.0)
    return at(radius), ahead / abs(ahead)


def slow_turn(ratio: float, entry: float, leaving: float) -> tuple[float, Route] | None:
    """Length and path of the turn by solving for the second radius; None if arcs are too tight or leave the circle."""
    (begin, ahead), (end, away) = point(entry, False), point(leaving, True)

    def gap(r2: float) -> float:
        first, second = begin - 1j * ahead * ratio * r2, end + 1j * away * r2
        return abs(first - second) - (1.0 + ratio) * r2

    if gap(1e-3) * gap(60.0) > 0.0:
        return None
    r2 = float(brentq(gap, 1e-3, 60.0, xtol=1e-13))
    r1 = ratio * r2
    if min(r1, r2) < LEAST - ROUNDED:
        return None
    first, second = begin - 1j * ahead * r1, end + 1j * away * r2
    middle = first + (second - first) * r1 / (r1 + r2)
    sweep1 = np.angle((begin - first) / (middle - first)) % (2.0 * math.pi)
    sweep2 = np.angle((end - second) / (middle - second)) % (2.0 * math.pi)
    arcs = (
        Arc((first.real, first.imag), r1, float(np.angle(begin - first)), -float(sweep1)),
        Arc((second.real, second.imag), r2, float(np.angle(middle - second)), float(sweep2)),
    )
    coils = Coil(PITCH, 16.0, entry / PITCH), Coil(PITCH, leaving / PITCH, 16.0, rotation=math.pi)
    try:
        path = Route([coils[0], *arcs, coils[1]])
    except InvalidValue:  # the difference quotients leave a kink
        return None
    length = r1 * sweep1 + r2 * sweep2
    within = np.linalg.norm(path.position(path.joints[0] + np.linspace(0.0, length, 500)), axis=-1).max()
    return None if within > RADIUS + ROUNDED else (float(length), Route(path.pieces, start=path.joints[0]))


def compared(low: float, turns: Iterable[tuple[float, float, float]]) -> tuple[int, int]:
    """How many turns of ratio, entry and exit are shorter than `low` and not; benches meet in each shorter one."""
    shorter = longer = 0
    for ratio, entry, leaving in turns:
        turn = slow_turn(ratio, entry, leaving)
        if turn is None:
            continue
        if turn[0] >= low:
            longer += 1
            continue
        shorter += 1
        assert first_contact(Dance(Dragon(), turn[1]), start=-20.0, stop=60.0).time is not None
    return shorter, longer


@pytest.mark.parametrize("ratio", some(list(SHORTEST), 2))
def test_no_turn_on_a_slow_grid_is_shorter_than_the_bracket(ratio: float) -> None:
    """Every shorter turn on the grid has a contact; the grid is searched with lines, arcs and root finding alone."""
    low, high = answer(ratio).length_bracket
    assert 0.0 < high - low <= 1e-6
    radii = np.arange(1.5, RADIUS, GRID).tolist()
    shorter, longer = compared(low, ((ratio, entry, leaving) for entry in radii for leaving in radii))
    assert longer
    assert shorter or ratio > 1.3


@pytest.mark.parametrize("ratio", some(list(SHORTEST), 2))
def test_the_shortest_turn_is_danced_by_all_benches_and_shorter_than_any_that_was_found(ratio: float) -> None:
    result = answer(ratio)
    assert SHORTEST[ratio] - GRID_EXCESS < result.turn.length < SHORTEST[ratio]
    assert result.turn.length == result.length_bracket[1]
    again = slow_turn(ratio, result.turn.entry_radius, result.turn.exit_radius)
    assert again is not None
    assert again[0] == pytest.approx(result.turn.length, abs=1e-6)
    assert first_contact(Dance(Dragon(), result.turn), start=-100.0, stop=500.0).outcome is Outcome.CLEAR
    (entry_low, entry_high), (exit_low, exit_high) = result.entry_bracket, result.exit_bracket
    assert entry_low <= result.turn.entry_radius <= entry_high
    assert exit_low <= result.turn.exit_radius <= exit_high


def test_the_contests_turn_is_limited_by_the_bend_and_the_circle() -> None:
    """There both constraints of the closed forms hold: the second arc as tight as the head can follow, the exit on the
    circle."""
    result = answer(2.0)
    assert result.limited_by is TurnLimit.BEND
    assert min(result.turn.radii) == pytest.approx(LEAST, abs=1e-9)
    assert result.turn.exit_radius == RADIUS
    assert result.turn.length < deepest_turn(Dragon(), PITCH).turn.length - 1.1


def test_a_free_exit_is_never_longer_than_the_opposite_one() -> None:
    for dragon, pitch, ratio in ((Dragon(30, 2.2), 1.6, 1.7), (Dragon(20, 2.0, 2.0), 1.9, 2.5)):
        free = shortest_turn(dragon, pitch, ratio=ratio, budget=Budget(2e7))
        opposite = deepest_turn(dragon, pitch, ratio=ratio)
        assert free.length_bracket[1] <= opposite.turn.length + 1e-6


def test_spent_work_leaves_a_wider_bracket_that_holds_the_narrow_one() -> None:
    low, high = answer(1.2).length_bracket
    brief = shortest_turn(Dragon(), PITCH, RADIUS, 1.2, budget=Budget(1.2e7))
    assert brief.length_bracket[0] < low - 1e-3
    assert brief.length_bracket[1] >= low
    assert brief.entry_bracket[0] <= answer(1.2).turn.entry_radius <= brief.entry_bracket[1]
    assert high >= low


def test_work_that_ends_before_a_turn_was_danced_is_an_error() -> None:
    with pytest.raises(TooMuchWork, match="turning_radius must be smaller"):
        shortest_turn(Dragon(), PITCH, budget=Budget(1.0))


def test_a_stopped_search_is_an_error() -> None:
    budget = Budget()
    budget.stop()
    with pytest.raises(TooMuchWork):
        shortest_turn(Dragon(), PITCH, budget=budget)


@pytest.mark.parametrize(
    ("about", "field"),
    [
        ({"turning_radius": 1.4}, "turning_radius"),
        ({"ratio": 0.0}, "ratio"),
        ({"margin": -1.0}, "margin"),
        ({"start_turns": 2.0}, "start_turns"),
    ],
    ids=lambda value: str(value),
)
def test_what_no_turn_can_have_is_refused_by_its_name(about: dict, field: str) -> None:
    with pytest.raises(InvalidValue) as refused:
        shortest_turn(Dragon(), PITCH, **about)
    assert refused.value.field == field


def test_one_bench_is_limited_by_the_bend_alone() -> None:
    result = shortest_turn(Dragon(1), PITCH)
    assert (result.limited_by, result.overlaps) == (TurnLimit.BEND, 0)
    assert result.length_bracket == answer(2.0).length_bracket


def test_every_dance_above_is_proven(monkeypatch: pytest.MonkeyPatch) -> None:
    """A turn that the proof refuses is never the answer, even if it is the shortest by the closed forms."""
    own, refused, known = core.design.shortest_turn.contact_in, [], answer(2.0)

    def contact_in(budget: Budget, dragon: Dragon, danced: Turn, margin: float, stray: float) -> object:
        if danced.exit_radius > 4.499 and danced.entry_radius < 4.45:
            refused.append(danced)
            return core.design.deepest_turn.Touch(Outcome.CONTACT)
        return own(budget, dragon, danced, margin, stray)

    monkeypatch.setattr(core.design.shortest_turn, "contact_in", contact_in)
    result = shortest_turn(Dragon(20), PITCH, budget=Budget(1e7))
    assert refused
    assert result.turn.exit_radius <= 4.499 or result.turn.entry_radius >= 4.45
    assert result.length_bracket[0] <= known.length_bracket[1]


@cache
def over_all_ratios() -> ShortestTurn:
    return shortest_turn(Dragon(), PITCH, RADIUS, None, budget=Budget(1e10 if DEEP else 6e7))


def test_no_turn_of_any_ratio_is_shorter_than_the_bracket_over_all_ratios() -> None:
    """Every shorter turn among random ones has a contact, and of each known ratio none is; also with work that is spent
    long before the bracket is narrow."""
    result = over_all_ratios()
    low, high = result.length_bracket
    assert 5.0 < low < high == result.turn.length
    assert (high - low <= 1e-6) is DEEP
    rng = np.random.default_rng(3)
    ratios = np.exp(rng.uniform(-0.6, 0.6, 4_000 if DEEP else 400))
    shorter, longer = compared(low, ((ratio, *rng.uniform(1.6, RADIUS, 2).tolist()) for ratio in ratios.tolist()))
    assert longer
    assert shorter or not DEEP
    assert all(answer(ratio).turn.length > low for ratio in some(list(SHORTEST), 2))
    assert first_contact(Dance(Dragon(), result.turn), start=-100.0, stop=500.0).outcome is Outcome.CLEAR


@pytest.mark.deep
def test_over_all_ratios_equal_arcs_are_the_shortest() -> None:
    assert over_all_ratios().turn.length == pytest.approx(answer(1.0).turn.length, abs=1e-6)
    assert over_all_ratios().turn.ratio == pytest.approx(1.0, abs=1e-9)


def test_a_turn_danced_backwards_need_not_be_searched() -> None:
    """With another bench in the middle both are searched, and give the same bracket."""
    lengths = [3.41, *[2.2] * 9, 2.21, *[2.2] * 9]
    uneven = Dragon.of(lengths, [0.3] * 20, [0.275] * 20)
    both = shortest_turn(uneven, PITCH, RADIUS, 1.0, budget=Budget(1e9))
    one = shortest_turn(Dragon(20), PITCH, RADIUS, 1.0, budget=Budget(1e9))
    assert both.boxes > 1.5 * one.boxes
    assert both.length_bracket == pytest.approx(one.length_bracket, abs=1e-6)
    for result in (both, one):
        assert result.entry_bracket[0] <= 3.94 <= result.entry_bracket[1] <= RADIUS
        assert result.exit_bracket[0] <= 3.94 <= result.exit_bracket[1] <= RADIUS
