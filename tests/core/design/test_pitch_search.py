"""Several dragons in one spiral: the minimum pitch against a slow search, and against the first encounter."""

from __future__ import annotations

import math

import numpy as np
import pytest

from core import (
    Dance,
    Dragon,
    InvalidValue,
    JustifiedBy,
    LimitedBy,
    MinimumPitch,
    Outcome,
    Part,
    Performance,
    Spiral,
    first_encounter,
    minimum_pitch,
)
from tests.support.depth import some
from tests.support.slow_pitch import SlowWays
from tests.support.slow_search import arc_length

# Difference in pitch at which the clearance is clearly on one side of the margin [m], and how exactly the slow search
# finds a dip between its samples [m].
BESIDE, SLOW = 1e-6, 2e-8


def random_case(seed: int) -> tuple[Dragon, int, float, float, float]:
    """A dragon, the number of dragons, the radius of the circle, the turns, and the margin."""
    rng = np.random.default_rng(seed)
    dragon = Dragon(int(rng.integers(4, 25)), *rng.uniform((2.0, 1.3, 0.05, 0.1), (3.6, 2.4, 0.3, 0.4)))
    return dragon, int(rng.integers(2, 7)), rng.uniform(3.0, 6.0), rng.uniform(6.0, 16.0), rng.choice([0.0, 0.04])


def reaches(dragon: Dragon, count: int, pitch: float, radius: float, turns: float, margin: float) -> bool:
    """True if no two dragons come within the margin until the heads are on the circle, by first_encounter()."""
    parts = [Part(Dance(dragon, Spiral(pitch, turns, rotation=math.tau * k / count))) for k in range(count)]
    growth = pitch / math.tau
    way = growth * (arc_length(math.tau * turns) - arc_length(radius / growth))
    met = first_encounter(Performance(parts), margin=margin, start=0.0, stop=float(way))
    assert met.outcome is not Outcome.UNDECIDED
    return met.outcome is Outcome.CLEAR


@pytest.mark.parametrize("seed", some(range(60), 6))
def test_no_dragons_meet_above_the_minimum_pitch_and_two_do_below_it(seed: int) -> None:
    dragon, count, radius, turns, margin = random_case(seed)
    try:
        result = minimum_pitch(dragon, turning_radius=radius, start_turns=turns, margin=margin, dragons=count)
    except InvalidValue:  # not even alone
        with pytest.raises(InvalidValue):
            minimum_pitch(dragon, turning_radius=radius, start_turns=turns, margin=margin)
        return
    alone = minimum_pitch(dragon, turning_radius=radius, start_turns=turns, margin=margin)
    assert result.pitch >= alone.pitch

    def least(pitch: float) -> float:
        return SlowWays.of(dragon, pitch, turns, radius, count).least() - margin

    assert least(result.pitch + BESIDE) > -SLOW
    for above in (BESIDE, 0.01, 0.3):
        assert reaches(dragon, count, result.pitch + above, radius, turns, margin)
    if result.dragons is None:
        assert (result.pitch, result.limited_by, result.benches) == (alone.pitch, alone.limited_by, alone.benches)
        return
    assert least(result.pitch - 10.0 * BESIDE) < SLOW
    assert not reaches(dragon, count, result.pitch - BESIDE, radius, turns, margin)
    assert result.pitch_bracket[1] - result.pitch_bracket[0] <= 1e-9
    for low, high in result.other_feasible_intervals:
        assert reaches(dragon, count, 0.5 * (low + high), radius, turns, margin)


def test_one_dragon_has_the_answer_of_today_to_the_last_bit() -> None:
    assert minimum_pitch(Dragon(), dragons=1) == minimum_pitch(Dragon())


@pytest.mark.parametrize(
    ("count", "pitch", "limited_by"),
    [(2, 0.896168293, LimitedBy.GRAZE), (3, 1.33822594, LimitedBy.GRAZE), (5, 2.23041593, LimitedBy.CIRCLE)],
)
def test_dragons_of_223_benches(count: int, pitch: float, limited_by: LimitedBy) -> None:
    result = minimum_pitch(Dragon(), dragons=count)
    assert result.pitch == pytest.approx(pitch, abs=1e-8)
    assert (result.limited_by, result.justified_by) == (limited_by, JustifiedBy.BOUND)
    assert result.proven_up_to is None
    assert result.dragons is not None
    assert f"bench {result.benches[1]} of dragon {result.dragons[1]}" in repr(result)


def test_strays_need_a_larger_pitch_by_at_least_what_two_benches_gain() -> None:
    straying = minimum_pitch(Dragon(40), dragons=2, stray=0.02)
    assert straying.dragons is not None
    assert straying.pitch - minimum_pitch(Dragon(40), dragons=2).pitch > 2.0 * 2.0 * 0.02 * 0.9


def test_more_dragons_than_fit_on_the_circle_are_refused_by_name() -> None:
    with pytest.raises(InvalidValue, match="dragons must be fewer, got 60: no pitch up to 10000 m lets so many"):
        minimum_pitch(Dragon(3), turning_radius=2.0, dragons=60)


@pytest.mark.parametrize(
    ("dragons", "message"),
    [
        (0, "dragons must be from 1 to 100, got 0"),
        (101, "dragons must be from 1 to 100, got 101"),
        (2.0, "dragons must be a whole number, got 2.0"),
        (True, "dragons must be a whole number, got True"),
    ],
)
def test_impossible_numbers_of_dragons_are_refused(dragons: object, message: str) -> None:
    with pytest.raises(InvalidValue) as error:
        minimum_pitch(Dragon(), dragons=dragons)  # type: ignore[arg-type]
    assert message in str(error.value)


def test_too_many_benches_in_all_are_refused() -> None:
    with pytest.raises(InvalidValue, match="at most 50000 benches in all"):
        minimum_pitch(Dragon(10_000), dragons=6)


def test_a_lone_dragon_that_limits_keeps_its_answer() -> None:
    result = minimum_pitch(Dragon(3), start_turns=3.0, dragons=2)
    alone = minimum_pitch(Dragon(3), start_turns=3.0)
    assert isinstance(result, MinimumPitch)
    assert (result.pitch, result.benches, result.dragons) == (alone.pitch, alone.benches, None)
    assert result.evaluations >= alone.evaluations
