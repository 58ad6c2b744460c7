"""Tolerance of several dragons: random strays on its safe side, verified poses on the other, and its limits."""

import math
from dataclasses import replace

import numpy as np
import pytest

from core import (
    Dance,
    Dragon,
    Limit,
    Outcome,
    Part,
    Performance,
    Spiral,
    Venue,
    first_encounter,
    least_clearance,
    tolerance,
)
from core.tolerance.exhibit import CHORD_WITHIN
from tests.support.depth import further
from tests.support.near import assert_near
from tests.support.random_squares import box
from tests.support.random_strays import random_strays
from tests.support.shared_dances import CROSSING, EAST, OPPOSITE, on_lanes
from tests.support.slow_performance import SlowPerformance
from tests.support.slow_search import benches_of, nearest

# Random strays of each pair of benches at each time [1]; times looked at, and their distance [s].
STRAYS = 4000
TIMES = 9
STEP = 0.05
# Rounding of a chord that was computed from places of hundreds of metres [m].
ROUNDED = 1e-12
ANSWERS = {
    "crossing": (CROSSING, None),
    "lanes": (on_lanes(EAST, ((40.0, 0.5), (-40.0, 0.5))), None),
    "one spiral": (OPPOSITE, 200.0),
}


def strayed(rng, handles, dragon, bench, stray):
    """Two holes (STRAYS, 2, 2) of a bench that stray by no more than `stray` and keep its chord."""
    front = handles[bench]
    rear = handles[bench + 1]
    along = (front - rear) / np.linalg.norm(front - rear)
    turned = np.array([along, [-along[1], along[0]]])
    return np.stack([front, rear]) + random_strays(rng, float(dragon.chords[bench]), stray, STRAYS) @ turned


@pytest.mark.parametrize("name", further(ANSWERS, 2))
def test_no_random_stray_touches_and_the_pose_beyond_does(name):
    performance, stop = ANSWERS[name]
    answer = tolerance(performance, stop=stop)
    pose = answer.exhibit
    assert answer.limited_by == Limit.BENCHES
    assert answer.dragons == (0, 1)
    slow = SlowPerformance(performance.parts)
    rng = np.random.default_rng(49)
    least = math.inf
    times = np.clip(answer.time + STEP * (np.arange(TIMES) - TIMES // 2), answer.start, answer.stop)
    dragons = [part.dance.dragon for part in performance.parts]

    def gaps(first, second, pair):
        """Gaps (N,) of two benches whose holes are there (N, 2, 2) [m]."""
        placed = zip((first, second), slow.parts, pair, strict=True)
        return nearest(*(benches_of(holes, part.slow.sides[[k]]) for holes, part, k in placed))[0]

    for one, two in zip(*(part.handles(times) for part in slow.parts), strict=True):
        for a, b in {answer.benches, *np.ndindex(3, 3)}:
            holes = strayed(rng, one, dragons[0], a, answer.stray), strayed(rng, two, dragons[1], b, answer.stray)
            least = min(least, float(gaps(*holes, (a, b)).min()))
    # These strays do reach far.
    assert 0.0 < least < 0.5 * least_clearance(performance, stop=stop).distance
    assert answer.stray_bracket == (answer.stray, pose.stray)
    assert 0.0 < pose.stray - answer.stray < 0.02 * answer.stray
    for part, dragon, handles in zip(slow.parts, dragons, pose.handles, strict=True):
        chords = np.linalg.norm(np.diff(handles, axis=0), axis=1)
        assert_near(chords, dragon.chords, CHORD_WITHIN + ROUNDED)
        assert np.linalg.norm(handles - part.handles(np.array([pose.time]))[0], axis=1).max() <= pose.stray + 1e-9
    holes = (handles[None, k : k + 2] for handles, k in zip(pose.handles, pose.benches, strict=True))
    assert gaps(*holes, pose.benches)[0] == pytest.approx(-pose.depth, rel=1e-3)
    assert pose.depth > 0.0


def test_the_stray_is_the_one_with_which_no_encounter_comes_about():
    answer = tolerance(OPPOSITE, stop=200.0)
    claim = answer.certificate.claim
    assert claim.stray == answer.stray
    assert claim.clear_until == 200.0
    met = first_encounter(OPPOSITE, stray=answer.stray, stop=200.0)
    assert met.outcome == Outcome.CLEAR
    assert met.certificate.claim == claim
    assert first_encounter(OPPOSITE, stray=1.001 * answer.stray, stop=200.0).outcome is Outcome.CONTACT


def test_a_single_dragon_has_its_own_tolerance_to_the_last_bit():
    alone = Dance(Dragon(30), Spiral(1.1, 8.0))
    answer = tolerance(Performance([Part(alone)]))
    own = tolerance(alone)
    assert (answer.own, answer.certificate, answer.dragons) == ((own,), None, (0,))
    assert (answer.stray_bracket, answer.time, answer.benches) == (own.stray_bracket, own.time, own.benches)


@pytest.mark.parametrize("delay", [0.0, 30.0])
def test_the_venue_limits_and_a_delay_shifts_its_time(delay):
    venue = Venue(box("square", -50, -0.9, 100, 50.9))
    first, second = on_lanes(EAST, ((40.0, 9.0), (-40.0, 9.0)), benches=3).parts
    answer = tolerance(Performance([replace(first, delay=delay), second], venue))
    own = tolerance(first.dance, venue)
    assert (answer.stray, answer.limited_by, answer.area) == (own.stray, Limit.VENUE, "square")
    assert answer.dragons == (0,)
    assert answer.own[0] == own
    assert answer.time == answer.exhibit.time == own.time + delay
    assert answer.certificate.claim.stray == answer.stray


def test_dragons_that_touch_have_no_safe_stray():
    met = first_encounter(OPPOSITE)
    answer = tolerance(OPPOSITE)
    assert answer.stray == 0.0
    assert answer.certificate is None
    assert (answer.time, answer.dragons, answer.benches) == (met.time, met.dragons, met.benches)
