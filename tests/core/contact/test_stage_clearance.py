"""Clearance between dragons: against a slow search that shares no code, in closed form, and its proven bound."""

from dataclasses import replace

import numpy as np
import pytest

from core import (
    OutsideRun,
    Performance,
    clearance_profile,
    first_encounter,
    least_clearance,
)
from core.contact.gaps import PROOF_WIDTHS
from tests.campaigns import hunt_encounters
from tests.support.depth import further
from tests.support.near import assert_near
from tests.support.refused import refused
from tests.support.shared_dances import CROSSING, EAST, OPPOSITE, on_lanes, side_by_side
from tests.support.slow_performance import SlowPerformance

# Accuracy of slow clearances, and of the least of a slow look, which refines its lowest samples [m].
GAP = 1e-9
LEAST = 1e-7


@pytest.mark.parametrize("performance", [CROSSING, OPPOSITE], ids=["crossing", "one spiral"])
def test_every_clearance_is_that_of_all_pairs(performance):
    times = np.linspace(performance.begin, performance.end.time - 1.0, 60)
    answer = clearance_profile(performance, times)
    gaps, pairs = SlowPerformance(performance.parts).clearance(times)
    assert_near(answer.clearance, gaps, GAP)
    # Where two pairs are equally near, either is an answer.
    assert (np.column_stack([answer.dragons, answer.benches]) == pairs).all(axis=1).mean() > 0.4
    alone = clearance_profile(performance, float(times[7]))
    assert alone.clearance.shape == ()
    assert alone.clearance == answer.clearance[7]


# Case 6 stops at a fold, and 11 is refused.
@pytest.mark.parametrize("case", further([*range(6), *range(7, 11), 12, 13], 3))
def test_the_least_clearance_of_random_performances_is_that_of_a_slow_look(case):
    performance, _, start, stop, look = hunt_encounters.random_case(49, case)
    low, _ = look.least()
    least = least_clearance(performance, start=start, stop=stop)
    if low > LEAST:
        assert least.at_least <= low + GAP
        assert 0.0 < least.distance - least.at_least <= 1.01 * PROOF_WIDTHS[1]
        assert least.distance <= low + LEAST
        assert_near(look.at(least.time), least.distance, GAP)
    else:
        assert least.distance <= 0.0
        assert look.at(least.time) <= GAP


def test_dragons_that_touch_have_no_clearance_at_their_encounter_and_below_zero_where_they_overlap():
    met = first_encounter(OPPOSITE)
    least = least_clearance(OPPOSITE)
    assert (least.distance, least.at_least, least.time, least.benches) == (0.0, 0.0, met.time, met.benches)
    both = Performance([CROSSING.parts[0], replace(CROSSING.parts[0], name="other")])
    least = least_clearance(both)
    assert (least.distance, least.at_least, least.time) == (pytest.approx(-0.3), None, both.begin)


def test_a_stray_takes_ground_and_is_bounded_in_closed_form():
    performance = on_lanes(EAST, ((40.0, 2.0), (-40.0, 2.0)), benches=1)
    without, strayed = (least_clearance(performance, stray=stray) for stray in (0.0, 0.05))
    assert_near(without.distance, 2.0 - 0.3, 1e-12)
    # Both move 0.05 m towards each other, or turn: the corners beyond the holes swing further out.
    assert 0.09 < without.distance - strayed.distance < 0.13
    assert strayed.at_least <= strayed.distance


def test_the_bound_holds_up_to_a_fold():
    performance = side_by_side()
    least = least_clearance(performance)
    assert least.distance - least.at_least < 1e-3
    assert clearance_profile(performance, performance.end.time).clearance >= least.at_least
    with refused("times.1", OutsideRun):
        clearance_profile(performance, [0.0, performance.end.time + 1.0])


def test_one_dragon_alone_has_no_clearance_to_others():
    alone = Performance(CROSSING.parts[:1])
    assert least_clearance(alone) is None
    with refused("parts"):
        clearance_profile(alone, 20.0)


def test_everyone_stands_before_and_after_and_no_times_give_no_rows():
    times = [-100.0, 1000.0], [CROSSING.begin, CROSSING.end.time]
    outside, ends = (clearance_profile(CROSSING, both).clearance.tolist() for both in times)
    assert outside == ends
    assert clearance_profile(CROSSING, []).clearance.shape == (0,)
