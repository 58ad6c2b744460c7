"""Clearance along time against a slow search; the least over a stretch below every sample, and proven from below."""

import numpy as np
import pytest

from core import (
    Arc,
    Budget,
    Dance,
    Dragon,
    EndReason,
    Line,
    Outcome,
    Route,
    Spiral,
    Turn,
    clearance_profile,
    first_contact,
    least_clearance,
)
from core.contact.gaps import PROOF_WIDTHS
from tests.core.contact.test_first_contact import ROUNDING
from tests.support.near import assert_near
from tests.support.random_dances import random_dance
from tests.support.shared_dances import CROSSING, UNLIKE
from tests.support.slow_performance import SlowPerformance
from tests.support.slow_search import SlowDance

PROVEN = 1.1e-5  # [m]: a least clearance is proven to this
SAME = 1e-12  # [m], [s]
DANCE = Dance(Dragon(), Spiral())
SHORT = Dance(Dragon(30), Spiral())
TURN = Turn(1.7)


@pytest.mark.parametrize(
    "dance, start, stop",
    [
        (DANCE, 0.0, 412.0),
        (Dance(Dragon(60), Spiral(0.7)), 100.0, 250.0),
        (Dance(Dragon(40, head_length=2.2), TURN), -10.0, 60.0),
        (Dance(UNLIKE, TURN), 0.0, 40.0),
    ],
    ids=["default", "wide coil", "turn", "benches of many sizes"],
)
def test_the_least_clearance_is_below_dense_samples_and_proven(dance, start, stop):
    least = least_clearance(dance, start=start, stop=stop)
    profile = clearance_profile(dance, np.linspace(start, stop, 800))
    lowest = min(profile.clearance.min(), *(graze.clearance for graze in profile.grazes))
    assert least.at_least <= least.distance <= lowest + SAME
    assert least.distance - least.at_least < PROVEN
    there = clearance_profile(dance, least.time)
    assert_near(there.clearance, least.distance, SAME)
    assert tuple(there.benches) == least.benches


def test_no_least_clearance_is_claimed_where_benches_overlap_at_the_start():
    dance = Dance(Dragon(), Spiral(0.3))
    least = least_clearance(dance)
    there = clearance_profile(dance, 0.0)
    assert least.distance == there.clearance < -0.1
    assert (least.at_least, least.time, least.benches) == (None, 0.0, tuple(there.benches))


def test_a_touch_to_the_last_digit_claims_nothing():
    """The head passes its own tail at a distance of 0."""
    arcs = Arc((0.0, 5.0), 5.0, -np.pi / 2, np.pi), Arc((-10.0, 5.125), 4.875, np.pi / 2, np.pi)
    lines = [Line((-8.0, 0.0), (0.0, 0.0)), Line((0.0, 10.0), (-10.0, 10.0)), Line((-10.0, 0.25), (60.0, 0.25))]
    dance = Dance(
        Dragon.of([1.5] * 34, [0.25] * 34, [0.0] * 34), Route([lines[0], arcs[0], lines[1], arcs[1], lines[2]])
    )
    least = least_clearance(dance, stop=dance.begin + 0.05)
    assert (least.distance, least.at_least, least.benches) == (0.0, None, (0, 33))


def test_a_long_tail_on_the_coil_of_a_turn_costs_next_to_nothing():
    budget = Budget(1e9)
    least_clearance(Dance(Dragon(20_000), Turn(1.7, start_turns=60.0)), start=0.0, stop=20.0, budget=budget)
    assert budget.left > 1e9 - 1e5


# Beyond the width of the proof: its own rounding [m].
PROOF_ROUNDING = 1e-9


@pytest.mark.parametrize("before", [0.0, 1e-12, 1e-7])
@pytest.mark.parametrize(
    "dance",
    [Dance(Dragon(40), Spiral(1.2, 8.0)), Dance(Dragon(), Spiral(0.9))],
)
def test_the_least_clearance_of_a_run_to_its_fold_or_just_before_it_is_proven(dance, before):
    stop = dance.end.time - before
    least = least_clearance(dance, stop=stop)
    assert dance.end.reason is EndReason.FOLD
    assert 0.0 < least.distance - least.at_least <= PROOF_WIDTHS[0] + PROOF_ROUNDING
    towards_the_fold = stop * (1.0 - np.linspace(1.0, 0.0, 400) ** 4)
    assert least.at_least <= clearance_profile(dance, towards_the_fold).clearance.min()
    assert first_contact(dance, stop=stop).outcome is Outcome.CLEAR


def test_a_least_clearance_that_takes_more_steps_than_a_search_may_is_proven_within_a_millimetre():
    least = least_clearance(Dance(Dragon(20), Spiral(2.0, 6.0)))
    assert 0.0 < least.distance - least.at_least <= PROOF_WIDTHS[1] + PROOF_ROUNDING


# -- clearance along time --------------------------------------------------------------------------------


@pytest.mark.parametrize("seed", range(400, 406))
def test_the_profile_is_the_least_separation_of_all_pairs(seed):
    dance, slow = random_dance(seed)
    times = np.linspace(0.0, 0.999 * dance.end.time, 25)
    profile, (least, pairs) = clearance_profile(dance, times), slow.clearance(times)
    assert_near(profile.clearance, least, 1e-10)
    for k in np.flatnonzero((profile.benches != pairs).any(axis=1)):
        assert_near(slow.pair_gap(times[k], tuple(profile.benches[k])), least[k], 1e-10)


@pytest.mark.parametrize(
    "danced, slow, times",
    [
        # At pitch 0.55 the benches overlap from 412.47 to 415.02 s, are clear to 415.375 s and overlap again.
        (SHORT, SlowDance.of(SHORT.dragon, SHORT.path), np.linspace(405.0, 416.0, 50)),
        (CROSSING, SlowPerformance(CROSSING.parts), [40.0, 60.0]),
    ],
    ids=["one", "several"],
)
def test_the_grazes_of_a_profile_are_the_bottoms_of_its_dips(danced, slow, times):
    profile = clearance_profile(danced, times)
    assert profile.grazes
    for graze in profile.grazes:
        values, pairs = slow.clearance(graze.time + np.linspace(-1e-3, 1e-3, 11))
        assert_near(graze.clearance, values[5], ROUNDING)
        assert values.min() >= graze.clearance - ROUNDING
        assert [*getattr(graze, "dragons", ()), *graze.benches] == [*pairs[5]]
