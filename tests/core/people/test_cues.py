"""Cues: every number of a bench held against the trajectory, and the words of refusals."""

import math

import pytest

from core import Dance, Dragon, Passage, Spiral, trajectory
from core.motion.places import handle_places
from core.people.cues import FOLLOWED_MAX, Side, bench_cues
from tests.support.near import assert_near
from tests.support.refused import refused
from tests.support.shared_dances import lane, there_and_back

pytestmark = pytest.mark.uncompiled

# Step of the slow search [s]; rounding of places and speeds [m], [m/s].
STEP = 0.01
ROUNDING = 1e-10
# Waits, walks, pauses twice (two passages of the second pause), hurries, and waits again.
PASSAGES = (
    Passage(0.0, until_time=5.0), Passage(0.5, until_time=9.0), Passage(0.0, until_time=12.0),
    Passage(1.0, until_time=20.0), Passage(0.0, until_time=23.0), Passage(0.0, until_time=24.5),
    Passage(1.5, until_s=18.0), Passage(0.0, until_time=60.0),
)  # fmt: skip
STEADY = Dance(Dragon(12), there_and_back(30))
PAUSED = Dance(STEADY.dragon, STEADY.path, 1.0, PASSAGES)
DONE = 24.5 + (18.0 - 10.0) / 1.5


def test_begin_pauses_and_end_are_those_of_the_clock():
    cues = bench_cues(PAUSED, [0, 5, 11], start=2.0, stop=50.0)
    for one in cues:
        assert (one.start.time, one.begin.time, one.head_speed) == (2.0, 5.0, 0.5)
        assert [(pause.begin, pause.end) for pause in one.pauses] == [(9.0, 12.0), (20.0, 24.5)]
        assert_near(one.done.time, DONE, ROUNDING)
        for at in (one.start, one.begin, one.done):
            assert_near((at.x, at.y), trajectory(PAUSED, at.time).position[one.bench], ROUNDING)
        assert one.start.s == handle_places(PAUSED, [2.0])[0, one.bench]
        before, after = trajectory(PAUSED, [5.0, 5.001]).position[:, one.bench]
        assert_near(one.direction, math.atan2(*(after - before)[::-1]), 1e-6)
    assert [(one.ahead, one.behind) for one in cues] == [(None, 1), (4, 6), (10, None)]


def test_a_bench_meets_those_that_come_back_and_sees_them_on_its_left():
    (cues,) = bench_cues(STEADY, [6], reach=5.0)
    assert cues.meetings
    for meeting in cues.meetings:
        middle = trajectory(STEADY, meeting.time).position[6:8].mean(axis=0)
        assert_near((meeting.x, meeting.y), middle, 1e-9)
        assert meeting.side is Side.LEFT


@pytest.mark.parametrize("waits", [0.0, 50.0])
def test_a_clock_that_rounds_puts_no_moment_before_the_dance(waits):
    passages = [Passage(0.0, until_time=waits)] if waits else []
    for tenths in range(3, 21):
        dance = Dance(Dragon(3), lane((0.0, 0.0), (30.0, 0.0)), tenths / 10.0, passages)
        (cues,) = bench_cues(dance, [1])
        assert cues.begin.time == dance.begin
        assert cues.done.time == dance.end.time


@pytest.mark.parametrize(
    "field, dance, options",
    [
        ("benches", PAUSED, {"benches": []}),
        ("benches.1", PAUSED, {"benches": [0, 12]}),
        ("benches.0", PAUSED, {"benches": [0.5]}),
        ("benches", Dance(Dragon(FOLLOWED_MAX + 1), Spiral()), {"stop": 5.0}),
        ("stop", PAUSED, {"start": 30.0, "stop": 50.0}),
        ("stop", Dance(Dragon(), Spiral()), {"stop": Dance(Dragon(), Spiral()).end.time}),
    ],
    ids=["no bench", "no such bench", "half a bench", "too many", "stands still", "fold"],
)
def test_what_cannot_be_is_refused(field, dance, options):
    with refused(field):
        bench_cues(dance, **options)
