"""The model of wobbling people: its refusals, and the motion of a bench with its holes."""

from __future__ import annotations

from typing import Any

import pytest

from core import Dance, Dragon, InvalidValue, Spiral, Turn, Wobble
from core.tolerance.wobble import check_sizes

DANCE = Dance(Dragon(5), Spiral())


@pytest.mark.parametrize(
    ("fields", "message"),
    [
        ({"lateral": -0.01}, "model.lateral must be zero or more, got -0.01 m"),
        ({"correlation_time": 0.0}, "model.correlation_time must be positive, got 0 s"),
        ({"step": 1.01}, "model.step must be at most 1 s, 1 / 5 of model.correlation_time, got 1.01 s"),
        ({"step": 0}, "model.step must be positive, got 0 s"),
        ({"correlation_benches": 0}, "model.correlation_benches must be positive, got 0"),
        ({"hole": 0.05, "pin": 0.06}, "model.pin must be no wider than its model.hole (0.05 m), got 0.06 m"),
        ({"pitch_error": float("nan")}, "model.pitch_error must be a finite number, got nan m"),
    ],
    ids=lambda fields: next(iter(fields)) if isinstance(fields, dict) else "",
)
def test_a_model_that_cannot_be_is_refused(fields: dict[str, Any], message: str) -> None:
    with pytest.raises(InvalidValue) as refused:
        Wobble(**fields)
    assert refused.value.message == message


@pytest.mark.parametrize(
    ("dance", "model", "words"),
    [
        (DANCE, Wobble(lateral=0.2), "model.lateral must be at most 0.1 of the chord of bench 1 (0.165 m), got 0.2 m"),
        (
            DANCE,
            Wobble(hole=0.5),
            "model.hole must leave a play of at most 0.1 of the chord of bench 1 (0.165 m) around",
        ),
        (DANCE, Wobble(pitch_error=0.06), "model.pitch_error must be at most 0.1 of the pitch (0.055 m), got 0.06 m"),
        (Dance(Dragon(5), Turn(1.7)), Wobble(pitch_error=0.01), "model.pitch_error must be 0 on a path that is no"),
    ],
    ids=["lateral", "play", "pitch error", "no spiral"],
)
def test_a_model_that_does_not_fit_a_dance_is_refused(dance: Dance, model: Wobble, words: str) -> None:
    check_sizes(dance, Wobble())
    with pytest.raises(InvalidValue) as refused:
        check_sizes(dance, model)
    assert refused.value.message.startswith(words)
