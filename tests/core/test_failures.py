"""The first instant at which a limit of the speed is exceeded, and what is left undecided."""

import numpy as np
import pytest

import core.extremes.speed
from core import Dance, Dragon, FailureKind, Judgement, Spiral, Turn, check, highest_speed, trajectory
from core.extremes.speed import SPEED_ROUNDING

EXCESS_ERROR = 1e-9  # [s]: a first excess is bracketed so closely at 1 m/s and more
TURN = Turn(1.7)
WIDE = Spiral(1.2, 8.0)
SHORT = Dance(Dragon(40), WIDE)


def first_failure(dance, limit, **span):
    return check(dance, speed_limit=limit, **span).failures[0]


@pytest.mark.parametrize(
    "dance, limit, start, stop",
    [
        (Dance(Dragon(), TURN), 1.6047, -100.0, 100.0),
        (Dance(Dragon(), TURN, 1.9), 2.0, -50.0, 50.0),
        (SHORT, 2.0, 0.0, 500.0),
        (Dance(Dragon(5), WIDE, 2.5), 3.0, 50.0, None),
    ],
    ids=["close to the peak", "fast head", "to the fold", "late start"],
)
def test_a_speed_failure_is_at_the_first_instant_above_the_limit(dance, limit, start, stop):
    failure = first_failure(dance, limit, start=start, stop=stop)
    kept, above = failure.time_bracket
    assert failure.kind == FailureKind.SPEED
    assert failure.time == above
    assert above - kept < EXCESS_ERROR
    before = np.concatenate([np.linspace(start, kept, 2_000), kept - np.geomspace(1e-8, 1.0, 200)])
    assert trajectory(dance, before).speed.max() <= limit * (1.0 + SPEED_ROUNDING)
    speed = trajectory(dance, above).speed
    assert speed.max() > limit * (1.0 + SPEED_ROUNDING)
    assert speed[failure.benches[0]] >= speed.max() * (1.0 - SPEED_ROUNDING)  # on one arc handles are equally fast


def test_a_proof_that_runs_short_of_work_leaves_a_kept_limit_undecided_and_a_broken_one_broken(monkeypatch):
    dance = Dance(Dragon(), TURN)
    span = {"start": -100.0, "stop": 100.0}
    for name in ("LINKS_BUDGET", "EXCESS_LINKS"):
        monkeypatch.setattr(core.extremes.speed, name, 10)
    kept = check(dance, speed_limit=highest_speed(dance, **span).speed * (1.0 + 1e-9), **span)
    assert [failure.kind for failure in kept.failures] == [FailureKind.UNDECIDED]
    assert (kept.verdict, kept.passed) == (Judgement.UNDECIDED, False)
    broken = first_failure(dance, 1.5, **span)
    assert broken.kind is FailureKind.SPEED
    assert "at the latest" in broken.message
    assert trajectory(dance, broken.time).speed.max() > 1.5
