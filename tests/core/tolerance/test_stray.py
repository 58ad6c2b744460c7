"""Strays: people and play add up; what cannot be is refused with its limit."""

from __future__ import annotations

import pytest

from core import Dragon, InvalidValue, Stray
from core.tolerance.stray import checked_stray


def test_people_and_play_add_up() -> None:
    assert Stray(0.02, 0.055, 0.045).total == pytest.approx(0.025, abs=1e-15)
    assert Stray(0.01, 0.055, 0.045).total == 0.015  # and not 0.015000000000000001
    assert checked_stray(Stray(0.02, 0.055, 0.045), Dragon()) == Stray(0.02, 0.055, 0.045).total
    assert Stray(0.02, 0.055, 0.045).total > checked_stray(0.02, Dragon())


@pytest.mark.parametrize(
    ("given", "message"),
    [
        (-0.01, "stray must be zero or more, got -0.01 m"),
        (0.9, r"stray must be at most half the chord of bench 1 \(0.825[0-9]* m\), got 0.9 m"),
        (float("nan"), "stray must be a finite number"),
        ("0.1", "stray must be a number, got '0.1'"),
    ],
    ids=["negative", "beyond half a chord", "no number", "text"],
)
def test_strays_that_cannot_be_are_refused(given: object, message: str) -> None:
    with pytest.raises(InvalidValue, match=message):
        checked_stray(given, Dragon())


def test_a_pin_wider_than_its_hole_is_refused() -> None:
    with pytest.raises(
        InvalidValue, match=r"stray.pin must be no wider than its hole \(stray.hole = 0.05 m\), got 0.06 m"
    ):
        Stray(0.0, 0.05, 0.06)


def test_half_a_chord_is_the_limit() -> None:
    assert checked_stray(0.825, Dragon()) == 0.825
    with pytest.raises(InvalidValue):
        checked_stray(0.8251, Dragon())
