"""Several dragons in one spiral: the minimum pitch against a slow search."""

import numpy as np
import pytest

from core import (
    Dragon,
    InvalidValue,
    JustifiedBy,
    LimitedBy,
    minimum_pitch,
)
from tests.support.depth import further, some
from tests.support.near import assert_near
from tests.support.refused import refused
from tests.support.slow_pitch import SlowWays

# Difference in pitch at which the clearance is clearly on one side of the margin [m], and how exactly the slow search
# finds a dip between its samples [m].
BESIDE = 1e-6
SLOW = 2e-8


def random_case(seed):
    """A dragon, the number of dragons, the radius of the circle, the turns, and the margin."""
    rng = np.random.default_rng(seed)
    dragon = Dragon(int(rng.integers(4, 25)), *rng.uniform((2.0, 1.3, 0.05, 0.1), (3.6, 2.4, 0.3, 0.4)))
    return dragon, int(rng.integers(2, 7)), rng.uniform(3.0, 6.0), rng.uniform(6.0, 16.0), rng.choice([0.0, 0.04])


@pytest.mark.parametrize("seed", further(dict.fromkeys([30, 40, *some(range(60), 6)]), 2))
def test_no_dragons_meet_above_the_minimum_pitch_and_two_do_below_it(seed):
    dragon, count, radius, turns, margin = random_case(seed)
    request = {"turning_radius": radius, "start_turns": turns, "margin": margin}
    try:
        alone = minimum_pitch(dragon, **request)
    except InvalidValue as caught:
        with refused(caught.field):
            minimum_pitch(dragon, **request, dragons=count)
        return
    result = minimum_pitch(dragon, **request, dragons=count)
    assert result.pitch >= alone.pitch

    def least(pitch):
        return SlowWays.of(dragon, pitch, turns, radius, count).least() - margin

    assert least(result.pitch + BESIDE) > -SLOW
    assert min(least(result.pitch + above) for above in (0.01, 0.3)) > 0.0
    if result.dragons is None:
        assert (result.pitch, result.limited_by, result.benches) == (alone.pitch, alone.limited_by, alone.benches)
        return
    assert least(result.pitch - 10.0 * BESIDE) < SLOW
    assert result.pitch_bracket[1] - result.pitch_bracket[0] <= 1e-9
    for low, high in result.other_feasible_intervals:
        assert least(0.5 * (low + high)) > 0.0


@pytest.mark.parametrize(
    "count, pitch, limited_by",
    [(2, 0.896168293, LimitedBy.GRAZE), (5, 2.23041593, LimitedBy.CIRCLE)],
)
def test_dragons_of_223_benches(count, pitch, limited_by):
    result = minimum_pitch(Dragon(), dragons=count)
    assert_near(result.pitch, pitch, 1e-8)
    assert result.limited_by == limited_by
    assert result.justified_by == JustifiedBy.BOUND
    assert result.proven_up_to is None


def test_strays_need_a_larger_pitch_by_at_least_what_two_benches_gain():
    still, straying = (minimum_pitch(Dragon(40), dragons=2, stray=stray) for stray in (0.0, 0.02))
    assert straying.dragons == (0, 1)
    assert straying.pitch - still.pitch > 2.0 * 2.0 * 0.02 * 0.9


@pytest.mark.parametrize(
    "dragon, dragons",
    [(Dragon(3), 60), (Dragon(10_000), 6), (Dragon(3), 101)],
    ids=["on the circle", "benches in all", "at all"],
)
def test_more_dragons_than_fit_are_refused_by_name(dragon, dragons):
    with refused("dragons", got=dragons):
        minimum_pitch(dragon, turning_radius=2.0, dragons=dragons)
