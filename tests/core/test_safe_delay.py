"""Safe delays: exact ones of streets that cross, and random performances against first encounters and a slow look."""

from contextlib import suppress
from dataclasses import replace

import numpy as np
import pytest

from core import (
    Budget,
    Dance,
    Dragon,
    InvalidValue,
    Outcome,
    Part,
    Performance,
    Spiral,
    TooMuchWork,
    first_encounter,
    safe_delay,
)
from core.safe_delay import END_WIDTH
from tests.campaigns.hunt_encounters import random_performance
from tests.support.depth import further, some
from tests.support.near import assert_near
from tests.support.refused import refused
from tests.support.shared_dances import lane, on_lanes
from tests.support.slow_performance import SlowPerformance

# Width of a bench of the default dragon, and half of the square that two of them cross [m].
WIDTH = 0.3
# Step of a slow look at a performance [s].
STEP = 0.05


def streets(*benches, head_speed=1.0):
    """Two processions of this many benches, which cross at right angles in the middle of both streets."""
    paths = lane((-60.0, 0.0), (60.0, 0.0)), lane((0.0, -60.0), (0.0, 60.0))
    return Performance([Part(Dance(Dragon(n), path, head_speed)) for n, path in zip(benches, paths, strict=True)])


def wait(benches):
    """How long another procession must wait until this one has crossed the square of both streets [s]."""
    dragon = Dragon(benches)
    return float(dragon.chords.sum()) + 2.0 * float(dragon.overhangs[0]) + WIDTH


def at_delay(performance, part, delay):
    """The performance in which this dragon begins so late."""
    parts = list(performance.parts)
    parts[part] = replace(parts[part], delay=delay)
    return Performance(parts)


@pytest.mark.parametrize("benches, speed", [((12, 3), 1.0), ((1, 4), 0.5)])
def test_processions_that_cross_wait_until_the_other_one_is_past(benches, speed):
    first, second = (wait(count) / speed for count in benches)
    crossing = streets(*benches, head_speed=speed)
    delays = safe_delay(crossing, 1, -60.0, 60.0)
    ends = np.ravel(delays.safe)
    assert_near(ends, [-60.0, -second, first, 60.0], END_WIDTH)
    assert ends[1] <= -second < first <= ends[2]
    assert delays.undecided == ()
    mirrored = safe_delay(crossing, 0, -60.0, 60.0).safe
    assert_near(np.ravel(mirrored), [-60.0, -first, second, 60.0], END_WIDTH)


def unfolding(rng):
    """A random performance of which no dragon folds."""
    while True:
        with suppress(InvalidValue):
            performance = random_performance(rng)
            if not any(part.dance.path.spiral for part in performance.parts):
                return performance


@pytest.mark.parametrize("seed", further(some(range(60), 6), 2))
def test_random_performances_meet_nobody_at_safe_delays_and_somebody_at_others(seed):
    rng = np.random.default_rng(seed)
    margin = 0.0 if seed % 2 else 0.3
    performance = unfolding(rng)
    k = int(rng.integers(len(performance.parts)))
    delays = safe_delay(performance, k, -15.0, 25.0, margin=margin)
    tried = np.random.default_rng(seed).uniform(-15.0, 25.0, 12).tolist()
    safe = 0
    for delay in tried + np.ravel(delays.safe).tolist():
        delayed = at_delay(performance, k, delay)
        met = first_encounter(delayed, margin=margin)
        around = [(low - END_WIDTH, high + END_WIDTH) for low, high in delays.safe + delays.undecided]
        if any(low <= delay <= high for low, high in delays.safe):
            safe += 1
            assert met.outcome is Outcome.CLEAR, f"delay {delay} s"
            if safe < 3:
                times = np.arange(delayed.begin, delayed.end.time, STEP)
                assert SlowPerformance(delayed.parts).clearance(times)[0].min() > margin
        elif not any(low <= delay <= high for low, high in around):
            assert met.outcome in (Outcome.CONTACT, Outcome.CONTACT_AT_START), f"delay {delay} s"
    assert sum(high - low for low, high in delays.undecided) < 1.0


def test_dragons_that_fold_are_judged_until_before_that():
    performance = Performance([Part(Dance(Dragon(20), Spiral(1.6, 5.0, (x, 0.0)))) for x in (0.0, 15.5)])
    for query in ({}, {"least": -60.0, "most": 0.0, "stop": 70.0}):
        with refused("stop"):
            safe_delay(performance, 1, **query)
    for delay in np.ravel(safe_delay(performance, 1, -5.0, 20.0, stop=60.0).safe).tolist():
        assert first_encounter(at_delay(performance, 1, delay), stop=60.0).outcome is Outcome.CLEAR


def test_no_delay_is_safe_while_two_others_meet_and_all_are_without_others():
    third = Part(Dance(Dragon(2), lane((100.0, 0.0), (120.0, 0.0))))
    assert safe_delay(Performance([*streets(4, 4).parts, third]), 2, 0.0, 20.0).safe == ()
    assert safe_delay(Performance([third]), 0, 0.0, 20.0).safe == ((0.0, 20.0),)


@pytest.mark.parametrize("step", [1, -1], ids=["beginning", "end"])
def test_dragons_that_stand_on_the_same_ground_meet_at_all_delays_of_a_fortnight(step):
    """Found by one sample, not by one for every third of a second."""
    ends = ((0.0, 0.0), (40.0, 0.0)), ((0.0, 0.0), (0.0, 40.0))
    crossing = on_lanes(*(pair[::step] for pair in ends), benches=3)
    delays = safe_delay(crossing, 1, -1e6, 1e6)
    assert delays.safe == ()
    assert delays.undecided == ()
    assert delays.marches < 60
    for delay in (-1e6, -50.0, 50.0, 1e6):
        assert first_encounter(at_delay(crossing, 1, delay)).outcome is not Outcome.CLEAR


def test_following_two_benches_through_the_delays_is_work():
    against = on_lanes(((0.0, 0.0), (1000.0, 0.0)), ((1000.0, 0.0), (0.0, 0.0)), benches=3)
    with pytest.raises(TooMuchWork):
        safe_delay(against, 1, -900.0, 900.0, budget=Budget(1e6))


def test_a_stray_makes_the_safe_intervals_shorter():
    nominal, straying = (safe_delay(streets(3, 3), 1, 0.0, 30.0, stray=stray) for stray in (0.0, 0.05))
    assert 0.1 < straying.safe[0][0] - nominal.safe[0][0] < 0.6
