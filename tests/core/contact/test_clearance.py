"""Clearance along time against a slow search; the least over a stretch below every sample, and proven from below."""

from __future__ import annotations

import numpy as np
import pytest

from core import (
    Dance,
    Dragon,
    EndReason,
    InvalidValue,
    Outcome,
    OutsideRun,
    Route,
    Spiral,
    Turn,
    clearance_profile,
    first_contact,
    least_clearance,
)
from core.contact.clearance import PROOF_WIDTHS
from tests.core.contact.test_first_contact import ROUNDING, random_dance
from tests.support.slow_search import SlowDance

PROVEN = 1.1e-5  # [m]: a least clearance is proven to this
TURN = Turn(1.7)


@pytest.mark.parametrize(
    ("dragon", "path", "start", "stop"),
    [
        (Dragon(), Spiral(), 0.0, 412.0),
        (Dragon(benches=60), Spiral(pitch=0.7), 100.0, 250.0),
        (Dragon(benches=40, head_length=2.2), TURN, -10.0, 60.0),
        (Dragon.of([2.6, 1.9, 2.2, 2.0, 2.4] * 4, [0.3, 0.5] * 10, [0.2] * 20), TURN, 0.0, 40.0),
    ],
    ids=["default", "wide coil", "turn", "benches of many sizes"],
)
def test_the_least_clearance_is_below_dense_samples_and_proven(
    dragon: Dragon, path: Spiral | Route, start: float, stop: float
) -> None:
    least = least_clearance(Dance(dragon, path), start=start, stop=stop)
    profile = clearance_profile(Dance(dragon, path), np.linspace(start, stop, 800))
    assert least is not None
    assert least.at_least is not None
    lowest = min(profile.clearance.min(), *(graze.clearance for graze in profile.grazes))
    assert least.at_least <= least.distance <= lowest + 1e-12
    assert least.distance - least.at_least < PROVEN
    there = clearance_profile(Dance(dragon, path), [least.time])
    assert there.clearance[0] == pytest.approx(least.distance, abs=1e-12)
    assert tuple(there.benches[0]) == least.benches


@pytest.mark.parametrize(("pitch", "depth"), [(0.3, 0.1), (0.5, 0.0)])
def test_no_least_clearance_is_claimed_where_benches_overlap_at_the_start(pitch: float, depth: float) -> None:
    dance = Dance(Dragon(), Spiral(pitch))
    least, there = least_clearance(dance), clearance_profile(dance, [0.0])
    assert least is not None
    if depth:
        assert least.distance == there.clearance[0] < -depth
        assert (least.at_least, least.time, least.benches) == (None, 0.0, tuple(there.benches[0]))
    else:
        assert (least.distance, least.at_least) == (0.0, 0.0)
        assert least.time == pytest.approx(first_contact(dance).time, abs=1e-9)


# Beyond the width of the proof: its own rounding [m].
PROOF_ROUNDING = 1e-9


@pytest.mark.parametrize("pitch", [0.7, 0.8, 0.9, 1.2])
def test_the_least_clearance_of_a_run_to_its_fold_is_proven(pitch: float) -> None:
    least = least_clearance(Dance(Dragon(), Spiral(pitch)))
    end = Dance(Dragon(), Spiral(pitch)).end
    assert end.reason is EndReason.FOLD
    assert least is not None
    assert least.at_least is not None
    assert 0.0 < least.distance - least.at_least <= PROOF_WIDTHS[0] + PROOF_ROUNDING
    towards_the_fold = end.time * (1.0 - np.linspace(1.0, 0.0, 400) ** 4)
    assert least.at_least <= clearance_profile(Dance(Dragon(), Spiral(pitch)), towards_the_fold).clearance.min()


def test_a_least_clearance_that_takes_more_steps_than_a_search_may_is_proven_within_a_millimetre() -> None:
    least = least_clearance(Dance(Dragon(20), Spiral(2.0, 6.0)))
    assert least is not None
    assert least.at_least is not None
    assert 0.0 < least.distance - least.at_least <= PROOF_WIDTHS[1] + PROOF_ROUNDING


def test_a_first_touch_is_a_least_clearance_of_zero() -> None:
    least = least_clearance(Dance(Dragon(), Spiral()))
    contact = first_contact(Dance(Dragon(), Spiral()))
    assert least is not None
    assert (least.distance, least.at_least, least.benches) == (0.0, 0.0, contact.benches)
    assert least.time == pytest.approx(contact.time, abs=1e-12)


@pytest.mark.parametrize("before", [1e-12, 1e-9, 1e-7, 1e-6])
@pytest.mark.parametrize(
    "dance", [Dance(Dragon(40), Spiral(1.2, 8.0)), Dance(Dragon(), Spiral(0.8))], ids=["short", "default"]
)
def test_a_stop_just_before_the_fold_is_proven_as_the_fold_is(dance: Dance, before: float) -> None:
    stop = dance.end.time - before
    least = least_clearance(dance, stop=stop)
    assert least is not None
    assert least.at_least is not None
    assert least.at_least >= least.distance - 1.01 * PROOF_WIDTHS[0]
    assert first_contact(dance, stop=stop).outcome is Outcome.CLEAR


# -- clearance along time --------------------------------------------------------------------------------


@pytest.mark.parametrize("seed", range(400, 406))
def test_the_profile_is_the_least_separation_of_all_pairs(seed: int) -> None:
    dragon, spiral = random_dance(seed, seed % 2 == 0)
    times = np.linspace(0.0, 0.999 * Dance(dragon, spiral).end.time, 25)
    profile = clearance_profile(Dance(dragon, spiral), times)
    slow, pairs = SlowDance.of(dragon, spiral).clearance(times)
    np.testing.assert_allclose(profile.clearance, slow, rtol=0, atol=1e-10)
    for k in np.flatnonzero((profile.benches != pairs).any(axis=1)):
        gap = SlowDance.of(dragon, spiral).pair_gap(times[k], tuple(profile.benches[k]))
        assert gap == pytest.approx(slow[k], abs=1e-10)


def test_the_grazes_of_a_profile_are_the_bottoms_of_its_dips() -> None:
    """At pitch 0.55 the benches overlap from 412.47 to 415.02 s, are clear to 415.375 s and overlap again."""
    profile = clearance_profile(Dance(Dragon(30), Spiral()), np.linspace(405.0, 416.0, 50))
    assert profile.grazes
    slow = SlowDance.of(Dragon(30), Spiral())
    for graze in profile.grazes:
        around = graze.time + np.linspace(-1e-3, 1e-3, 11)
        values, pairs = slow.clearance(around)
        assert graze.clearance == pytest.approx(values[5], abs=ROUNDING)
        assert values.min() >= graze.clearance - ROUNDING
        assert tuple(pairs[5]) == graze.benches


@pytest.mark.parametrize("benches", [1, 2])
def test_a_profile_needs_two_benches_that_share_no_handle(benches: int) -> None:
    with pytest.raises(InvalidValue) as refused:
        clearance_profile(Dance(Dragon(benches), Spiral()), [0.0])
    assert refused.value.field == "dragon.benches"


def test_a_profile_past_the_end_is_outside_the_run() -> None:
    with pytest.raises(OutsideRun) as refused:
        clearance_profile(Dance(Dragon(5), Spiral()), [0.0, 433.0])
    assert refused.value.field == "times.1"


def test_the_profile_of_one_time_is_that_instant() -> None:
    many = clearance_profile(Dance(Dragon(30), Spiral()), [400.0, 410.0])
    for k, time in enumerate([400.0, 410.0]):
        one = clearance_profile(Dance(Dragon(30), Spiral()), time)
        assert (one.time.shape, one.clearance.shape, one.benches.shape, one.grazes) == ((), (), (2,), ())
        assert one.clearance == many.clearance[k]
        assert one.benches.tolist() == many.benches[k].tolist()
