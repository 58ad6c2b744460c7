"""Tolerance of several dragons: random strays on its safe side, verified poses on the other, and its limits."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from core import (
    Area,
    Budget,
    Dance,
    Dragon,
    Limit,
    Line,
    Outcome,
    OutsideRun,
    Part,
    Performance,
    Route,
    Spiral,
    TooMuchWork,
    Venue,
    first_encounter,
    performance_least_clearance,
    performance_tolerance,
    tolerance,
)
from core.tolerance.exhibit import CHORD_WITHIN
from tests.support.random_strays import random_strays
from tests.support.slow_performance import SlowPerformance
from tests.support.slow_search import rectangles_gap

# Random strays of each pair of benches at each time [1]; times looked at, and their distance [s].
STRAYS, TIMES, STEP = 4000, 9, 0.05
# Rounding of a chord that was computed from places of hundreds of metres [m].
ROUNDED = 1e-12
OPPOSITE = Performance([Part(Dance(Dragon(60), Spiral(1.1, 8.0, rotation=turn))) for turn in (0.0, math.pi)])
STREETS = [Line((-40.0, 0.0), (40.0, 0.0)), Line((0.0, -40.0), (0.0, 40.0))]
CROSSING = Performance(
    [Part(Dance(Dragon(5), Route([street]), 1.0 + 0.1 * k), 15.0 * k) for k, street in enumerate(STREETS)]
)
LANES = Performance(
    [
        Part(Dance(Dragon(5), Route([lane])))
        for lane in (Line((-40.0, 0.0), (40.0, 0.0)), Line((40.0, 0.5), (-40.0, 0.5)))
    ]
)


def rectangle(holes, dragon, bench):
    """Centres, directions and half sides of a bench whose two holes are at (N, 2, 2)."""
    along = holes[:, 0] - holes[:, 1]
    side = np.array([dragon.lengths[bench], dragon.widths[bench]]) / 2.0
    return holes.mean(axis=1), along / np.linalg.norm(along, axis=1)[:, None], np.tile(side, (len(holes), 1))


def strayed(rng, handles, dragon, bench, stray):
    """Holes (STRAYS, 2, 2) of a bench that stray by no more than `stray` and keep its chord."""
    front, rear = handles[bench], handles[bench + 1]
    along = (front - rear) / np.linalg.norm(front - rear)
    turned = np.array([along, [-along[1], along[0]]])
    return np.stack([front, rear]) + random_strays(rng, float(dragon.chords[bench]), stray, STRAYS) @ turned


@pytest.mark.parametrize(
    ("performance", "stop"),
    [(OPPOSITE, 200.0), (CROSSING, None), (LANES, None)],
    ids=["one spiral", "crossing", "lanes"],
)
def test_no_random_stray_touches_and_the_pose_beyond_does(performance: Performance, stop: float | None) -> None:
    answer = performance_tolerance(performance, stop=stop)
    assert answer.stray > 0.0
    assert answer.limited_by is Limit.BENCHES
    assert answer.dragons == (0, 1)
    assert answer.time is not None
    assert answer.benches is not None
    slow, rng, nearest = SlowPerformance(performance.parts), np.random.default_rng(49), math.inf
    times = np.clip(answer.time + STEP * (np.arange(TIMES) - TIMES // 2), answer.start, answer.stop)
    dragons = [part.dance.dragon for part in performance.parts]
    for places in zip(*(part.handles(times) for part in slow.parts), strict=True):
        pairs = {answer.benches, *((a, b) for a in range(3) for b in range(3))}
        for benches in pairs:
            holes = [
                strayed(rng, own, dragon, bench, answer.stray)
                for own, dragon, bench in zip(places, dragons, benches, strict=True)
            ]
            one, two = (
                rectangle(own, dragon, bench) for own, dragon, bench in zip(holes, dragons, benches, strict=True)
            )
            gaps = rectangles_gap(*one, *two)
            assert gaps.min() > 0.0
            nearest = min(nearest, float(gaps.min()))
    least = performance_least_clearance(performance, stop=stop)
    assert least is not None
    assert nearest < 0.5 * least.distance  # these strays do reach far
    pose = answer.exhibit
    assert pose is not None
    assert answer.stray_bracket == (answer.stray, pose.stray)
    assert 0.0 < pose.stray - answer.stray < 0.02 * answer.stray
    rectangles = []
    for part, dragon, own, bench in zip(slow.parts, dragons, pose.handles, pose.benches, strict=True):
        chords = np.linalg.norm(own[1:] - own[:-1], axis=1)
        np.testing.assert_allclose(chords, dragon.chords, rtol=0, atol=CHORD_WITHIN + ROUNDED)
        ways = np.linalg.norm(own - part.handles(np.array([pose.time]))[0], axis=1)
        assert ways.max() <= pose.stray + 1e-9
        rectangles.append(rectangle(own[None, bench : bench + 2], dragon, bench))
    assert rectangles_gap(*rectangles[0], *rectangles[1])[0] == pytest.approx(-pose.depth, rel=1e-3)
    assert pose.depth > 0.0


def test_the_stray_is_the_one_with_which_no_encounter_comes_about() -> None:
    answer = performance_tolerance(OPPOSITE, stop=200.0)
    assert answer.certificate is not None
    claim = answer.certificate.claim
    assert (claim.stray, claim.start, claim.clear_until) == (answer.stray, 0.0, 200.0)
    met = first_encounter(OPPOSITE, stray=answer.stray, stop=200.0)
    assert met.outcome is Outcome.CLEAR
    assert met.certificate.claim == claim
    assert first_encounter(OPPOSITE, stray=1.001 * answer.stray, stop=200.0).outcome is Outcome.CONTACT


def test_a_single_dragon_has_its_own_tolerance_to_the_last_bit() -> None:
    alone = Dance(Dragon(30), Spiral(1.1, 8.0))
    answer, own = performance_tolerance(Performance([Part(alone)])), tolerance(alone)
    assert answer.own == (own,)
    assert (answer.stray, answer.stray_bracket, answer.limited_by) == (own.stray, own.stray_bracket, own.limited_by)
    assert (answer.time, answer.benches, answer.dragons) == (own.time, own.benches, (0,))
    assert answer.certificate is None


def test_the_venue_limits_and_a_delay_shifts_its_time() -> None:
    venue = Venue(Area("square", (((-50, -0.9), (50, -0.9), (50, 50), (-50, 50), (-50, -0.9)),)))
    lanes = [Line((-40.0, 0.0), (40.0, 0.0)), Line((40.0, 9.0), (-40.0, 9.0))]
    parts = [Part(Dance(Dragon(3), Route([lane]))) for lane in lanes]
    for delay in (0.0, 30.0):
        performance = Performance([replace(parts[0], delay=delay, name="east"), parts[1]], venue)
        answer = performance_tolerance(performance)
        own = tolerance(parts[0].dance, venue)
        assert (answer.stray, answer.limited_by, answer.area) == (own.stray, Limit.VENUE, "square")
        assert answer.dragons == (0,)
        assert answer.own[0] == own
        assert own.time is not None
        assert answer.time == own.time + delay
        assert answer.exhibit is not None
        assert answer.exhibit.time == answer.time
        assert "east" in repr(answer)
        assert answer.certificate is not None
        assert answer.certificate.claim.stray == answer.stray


def test_dragons_that_touch_have_no_safe_stray() -> None:
    met, answer = first_encounter(OPPOSITE), performance_tolerance(OPPOSITE)
    assert answer.stray == 0.0
    assert answer.certificate is None
    assert (answer.time, answer.dragons, answer.benches) == (met.time, met.dragons, met.benches)


def test_a_dragon_that_stands_all_the_time_has_the_tolerance_of_its_place() -> None:
    parts = [CROSSING.parts[0], replace(CROSSING.parts[1], delay=500.0)]
    answer = performance_tolerance(Performance(parts), stop=40.0)
    assert answer.own[1].start == parts[1].dance.begin
    assert answer.own[1].stop < parts[1].dance.begin + 0.01
    assert answer.dragons == (0, 1) or answer.limited_by is Limit.CHORD
    with pytest.raises(OutsideRun):
        performance_tolerance(CROSSING, start=-1.0)


def test_a_spent_budget_is_an_error() -> None:
    with pytest.raises(TooMuchWork):
        performance_tolerance(OPPOSITE, budget=Budget(2e4))
