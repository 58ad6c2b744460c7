"""Cues: every number of a bench held against the trajectory, and the words of refusals."""

from __future__ import annotations

import math

import numpy as np
import pytest

import core
from core import Arc, Budget, Dance, Dragon, InvalidValue, Line, Passage, Route, Spiral
from core.motion.places import handle_places
from core.people.cues import FASTEST_WIDTH, FOLLOWED_MAX, Side, bench_cues

pytestmark = pytest.mark.uncompiled

# Step of the slow search [s].
STEP = 0.01
# Rounding of places and speeds [m], [m/s].
ROUNDING = 1e-10
THERE_AND_BACK = Route(
    [Line((0, 0), (30, 0)), Arc((30, 1.6), 1.6, -math.pi / 2, math.pi), Line((30, 3.2), (0, 3.2))], 24.0
)
# Waits, walks, pauses twice (two passages of the second pause), hurries, and waits again.
PASSAGES = (
    Passage(0.0, until_time=5.0), Passage(0.5, until_time=9.0), Passage(0.0, until_time=12.0),
    Passage(1.0, until_time=20.0), Passage(0.0, until_time=23.0), Passage(0.0, until_time=24.5),
    Passage(1.5, until_s=18.0), Passage(0.0, until_time=60.0),
)  # fmt: skip
PAUSED = Dance(Dragon(12), THERE_AND_BACK, 1.0, PASSAGES)


def test_begin_pauses_and_end_are_those_of_the_clock() -> None:
    cues = bench_cues(PAUSED, [0, 5, 11], start=2.0, stop=50.0)
    for one in cues:
        assert (one.start.time, one.begin.time, one.head_speed) == (2.0, 5.0, 0.5)
        assert [(pause.begin, pause.end) for pause in one.pauses] == [(9.0, 12.0), (20.0, 24.5)]
        assert one.done.time == pytest.approx(24.5 + (18.0 - 10.0) / 1.5, abs=ROUNDING)
        for at in (one.start, one.begin, one.done, *one.pauses):
            time = getattr(at, "time", getattr(at, "begin", None))
            x, y = core.trajectory(PAUSED, [time]).position[0, one.bench]
            assert (at.x, at.y) == pytest.approx((x, y), abs=ROUNDING)
        assert one.start.s == handle_places(PAUSED, [2.0])[0, one.bench]
        later = core.trajectory(PAUSED, [5.0, 5.001]).position[:, one.bench]
        way = later[1] - later[0]
        assert one.direction == pytest.approx(math.atan2(way[1], way[0]), abs=1e-6)
    assert [(one.ahead, one.behind) for one in cues] == [(None, 1), (4, 6), (10, None)]


def test_the_fastest_moment_is_the_fastest_of_small_steps() -> None:
    end = 24.5 + 8.0 / 1.5
    times = np.arange(2.0, end, STEP)
    speed = core.trajectory(PAUSED, times).speed
    for one in bench_cues(PAUSED, start=2.0, stop=50.0):
        both = speed[:, one.bench : one.bench + 2]
        assert both.max() - ROUNDING <= one.fastest.speed <= both.max() + STEP
        assert one.fastest.handle in (one.bench, one.bench + 1)
        # Just before a change of speed, at its own time.
        before = core.trajectory(PAUSED, [one.fastest.time - FASTEST_WIDTH, one.fastest.time])
        assert before.speed[:, one.fastest.handle].max() == pytest.approx(one.fastest.speed, abs=1e-5)
        assert before.position[1, one.fastest.handle] == pytest.approx((one.fastest.x, one.fastest.y), abs=ROUNDING)
        assert one.fastest.head_speed == 1.5


def test_a_bench_meets_those_that_come_back_and_sees_them_on_its_left() -> None:
    dance = Dance(Dragon(12), THERE_AND_BACK)
    cues = bench_cues(dance, reach=5.0)
    met = {(one.bench, meeting.bench) for one in cues for meeting in one.meetings}
    assert (6, 0) in met
    assert (0, 6) in met
    for one in cues:
        assert [meeting.time for meeting in one.meetings] == sorted(meeting.time for meeting in one.meetings)
        for meeting in one.meetings:
            handles = core.trajectory(dance, [meeting.time]).position[0]
            assert (meeting.x, meeting.y) == pytest.approx(
                0.5 * (handles[one.bench] + handles[one.bench + 1]), abs=1e-9
            )
            assert meeting.side is Side.LEFT
            assert meeting.gap <= 5.0


def test_meetings_stand_at_the_first_time_at_which_the_head_is_there() -> None:
    steady = Dance(Dragon(12), THERE_AND_BACK)
    slow = Dance(Dragon(12), THERE_AND_BACK, 0.5)
    pairs = zip(bench_cues(steady, [4])[0].meetings, bench_cues(slow, [4])[0].meetings, strict=True)
    assert [b.time / a.time for a, b in pairs] == pytest.approx([2.0] * len(bench_cues(steady, [4])[0].meetings))


@pytest.mark.parametrize("waits", [0.0, 50.0])
def test_a_clock_that_rounds_puts_no_moment_before_the_dance(waits: float) -> None:
    lane = Route([Line((0.0, 0.0), (30.0, 0.0))])
    for tenths in range(3, 21):
        passages = [Passage(0.0, until_time=waits)] if waits else []
        dance = Dance(Dragon(3), lane, tenths / 10.0, passages)
        (cues,) = bench_cues(dance, [1])
        assert cues.begin.time == dance.begin
        assert cues.done.time == dance.end.time


@pytest.mark.parametrize(
    ("dance", "options", "message"),
    [
        (PAUSED, {"benches": []}, f"benches must name from 1 to {FOLLOWED_MAX} benches, got 0"),
        (PAUSED, {"benches": [0, 12]}, "benches[1] must be at most 11, got 12"),
        (PAUSED, {"benches": [0.5]}, "benches[0] must be a whole number, got 0.5"),
        (PAUSED, {"reach": -1.0}, "reach must be zero or more, got -1 m"),
        (PAUSED, {"start": 30.0, "stop": 50.0},
         "stop must be after the head begins to walk, got 50 s: it stands still from 30 s on"),
        (Dance(Dragon(9), Spiral()), {}, "stop must be given"),
        (Dance(Dragon(), Spiral()), {"stop": Dance(Dragon(), Spiral()).end.time}, "and speeds grow without bound"),
    ],
    ids=["no bench", "no such bench", "half a bench", "reach", "stands still", "no stop", "fold"],
)  # fmt: skip
def test_what_cannot_be_is_refused_in_one_sentence(dance: Dance, options: dict[str, object], message: str) -> None:
    with pytest.raises(InvalidValue) as caught:
        bench_cues(dance, **options)  # type: ignore[arg-type]
    assert message in str(caught.value)


def test_more_than_the_most_benches_need_a_choice() -> None:
    with pytest.raises(InvalidValue, match="benches must name from 1 to"):
        bench_cues(Dance(Dragon(FOLLOWED_MAX + 1), Spiral()), stop=5.0)
    assert len(bench_cues(Dance(Dragon(100_000), Spiral()), [99_999], stop=1.0, budget=Budget())) == 1
