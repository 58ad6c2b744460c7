"""Clearance between dragons: against a slow search that shares no code, in closed form, and its proven bound."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from core import (
    Budget,
    Dance,
    Dragon,
    InvalidValue,
    Line,
    OutsideRun,
    Part,
    Performance,
    Route,
    Spiral,
    TooMuchWork,
    first_encounter,
    performance_clearance,
    performance_least_clearance,
)
from core.contact.clearance import PROOF_WIDTHS
from tests.campaigns import hunt_encounters
from tests.support.slow_performance import SlowPerformance

# Accuracy of slow clearances, and of the least of a slow look, which refines its lowest samples [m].
GAP, LEAST = 1e-9, 1e-7
STREETS = [Line((-40.0, 0.0), (40.0, 0.0)), Line((0.0, -40.0), (0.0, 40.0))]
# The second one is later and faster, so that it goes behind the first.
CROSSING = Performance(
    [Part(Dance(Dragon(5), Route([street]), 1.0 + 0.1 * k), 15.0 * k) for k, street in enumerate(STREETS)]
)
OPPOSITE = Performance([Part(Dance(Dragon(60), Spiral(1.1, 8.0, rotation=turn))) for turn in (0.0, math.pi)])


@pytest.mark.parametrize("performance", [CROSSING, OPPOSITE], ids=["crossing", "one spiral"])
def test_every_clearance_is_that_of_all_pairs(performance: Performance) -> None:
    last = performance.end.time - 1.0
    times = np.linspace(performance.begin, last, 60)
    answer = performance_clearance(performance, times)
    gaps, pairs = SlowPerformance(performance.parts).clearance(times)
    np.testing.assert_allclose(answer.clearance, gaps, rtol=0, atol=GAP)
    # Where two pairs are equally near, either is an answer.
    assert (np.column_stack([answer.dragons, answer.benches]) == pairs).all(axis=1).mean() > 0.4
    alone = performance_clearance(performance, float(times[7]))
    assert alone.clearance.shape == ()
    assert (alone.clearance, alone.benches.tolist()) == (answer.clearance[7], answer.benches[7].tolist())


def test_a_graze_is_the_bottom_of_a_dip() -> None:
    answer = performance_clearance(CROSSING, [40.0, 60.0])
    (graze,) = answer.grazes
    around = np.linspace(graze.time - 0.05, graze.time + 0.05, 2001)
    gaps, pairs = SlowPerformance(CROSSING.parts).clearance(around)
    assert graze.clearance == pytest.approx(gaps.min(), rel=0, abs=GAP)
    assert graze.time == pytest.approx(around[gaps.argmin()], rel=0, abs=1e-4)
    assert [*graze.dragons, *graze.benches] == pairs[gaps.argmin()].tolist()
    least = performance_least_clearance(CROSSING)
    assert least is not None
    assert (least.distance, least.benches) == (pytest.approx(graze.clearance, rel=0, abs=1e-12), graze.benches)


@pytest.mark.parametrize("case", [case for case in range(13) if case != 11])  # 11 is refused
def test_the_least_clearance_of_random_performances_is_that_of_a_slow_look(case: int) -> None:
    performance, _, start, stop, look = hunt_encounters.random_case(49, case)
    low, _ = look.least()
    least = performance_least_clearance(performance, start=start, stop=stop)
    assert least is not None
    if low > LEAST:
        assert least.at_least is not None
        assert least.at_least <= low + GAP
        assert 0.0 < least.distance - least.at_least <= 1.01 * PROOF_WIDTHS[1]
        assert least.distance <= low + LEAST
        assert look.at(least.time) == pytest.approx(least.distance, rel=0, abs=GAP)
    else:
        assert least.distance <= 0.0
        assert look.at(least.time) <= GAP


def test_two_dragons_that_touch_have_the_least_clearance_zero_at_their_encounter() -> None:
    met, least = first_encounter(OPPOSITE), performance_least_clearance(OPPOSITE)
    assert least is not None
    assert (least.distance, least.at_least) == (0.0, 0.0)
    assert (least.time, least.dragons, least.benches) == (met.time, met.dragons, met.benches)


def test_dragons_that_overlap_at_the_start_have_a_negative_clearance_there() -> None:
    performance = Performance([CROSSING.parts[0], replace(CROSSING.parts[0], name="other")])
    least = performance_least_clearance(performance)
    assert least is not None
    assert (least.distance, least.at_least, least.time) == (pytest.approx(-0.3), None, performance.begin)


def test_a_stray_takes_ground_and_is_bounded_in_closed_form() -> None:
    lanes = [Line((-40.0, 0.0), (40.0, 0.0)), Line((40.0, 2.0), (-40.0, 2.0))]
    performance = Performance([Part(Dance(Dragon(1), Route([lane]))) for lane in lanes])
    without, strayed = (performance_least_clearance(performance, stray=stray) for stray in (0.0, 0.05))
    assert without is not None
    assert strayed is not None
    assert without.distance == pytest.approx(2.0 - 0.3, rel=0, abs=1e-12)
    # Both move 0.05 m towards each other, or turn: the corners beyond the holes swing further out.
    assert 0.09 < without.distance - strayed.distance < 0.13
    assert strayed.at_least is not None
    assert strayed.at_least <= strayed.distance


def test_the_bound_holds_up_to_a_fold() -> None:
    performance = Performance([Part(Dance(Dragon(3), Spiral(1.2, 2.0, (x, 0.0)))) for x in (0.0, 9.0)])
    least = performance_least_clearance(performance)
    assert least is not None
    assert least.at_least is not None
    assert least.distance - least.at_least < 1e-3
    late = performance_clearance(performance, performance.end.time)
    assert late.clearance >= least.at_least
    with pytest.raises(OutsideRun, match=r"times\[1\] must be at most .* when bench 0 of dragon 0 folds"):
        performance_clearance(performance, [0.0, performance.end.time + 1.0])


def test_one_dragon_alone_has_no_clearance_to_others() -> None:
    alone = Performance(CROSSING.parts[:1])
    assert performance_least_clearance(alone) is None
    with pytest.raises(InvalidValue, match="parts must be at least two"):
        performance_clearance(alone, 20.0)
    with pytest.raises(OutsideRun):
        performance_least_clearance(alone, stop=1e4)


def test_everyone_stands_before_and_after_and_no_times_give_no_rows() -> None:
    early, late = performance_clearance(CROSSING, [-100.0, 1000.0]).clearance
    first, last = performance_clearance(CROSSING, [CROSSING.begin, CROSSING.end.time]).clearance
    assert (early, late) == (first, last)
    assert performance_clearance(CROSSING, []).clearance.shape == (0,)


def test_a_spent_budget_is_an_error() -> None:
    with pytest.raises(TooMuchWork, match="the least clearance was not found"):
        performance_least_clearance(OPPOSITE, budget=Budget(1e2))
