"""The least clearance over a stretch of a dance: below every sample, and proven from below."""

from __future__ import annotations

import numpy as np
import pytest

from core import (
    Dance,
    Dragon,
    EndReason,
    Outcome,
    Route,
    Spiral,
    Turn,
    clearance_profile,
    first_contact,
    least_clearance,
)
from core.contact.least_clearance import PROOF_WIDTHS

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
