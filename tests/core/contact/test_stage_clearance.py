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
from tests.support.near import assert_near
from tests.support.refused import refused
from tests.support.shared_dances import CROSSING, EAST, OPPOSITE, on_lanes, side_by_side
from tests.support.slow_performance import SlowPerformance

# Accuracy of slow clearances [m].
GAP = 1e-9


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
