"""Cards: at most eight cues, chosen by the rule, and every other one left out in the open."""

import random

import pytest

from core.people.cards import CUES_MOST, TOGETHER, CueKind, card_of
from core.people.cues import BenchCues, FastestMoment, Meeting, Pause, Side, Stand

pytestmark = pytest.mark.uncompiled


def card(meetings, pauses, speed=1.5):
    stands = [Stand(time, time, 0.0, time, 0.0) for time in (0.0, 1.0, 1_000.0)]
    fastest = FastestMoment(500.0, speed, 1.0, 3, 0.0, 0.0)
    return card_of(BenchCues(3, *stands[:2], 0.0, 1.0, 2, 4, tuple(meetings), fastest, tuple(pauses), stands[2]))


def meeting(time, gap=1.0, side=Side.LEFT, *, oncoming=True):
    return Meeting(time, int(time), side, gap, oncoming, 0.0, 0.0)


def times(cues, kind):
    return [cue.time for cue in cues if cue.kind is kind]


def test_the_nearest_meetings_have_a_place_and_the_others_are_counted():
    gaps = [3.0, 1.0, 2.5, 0.5, 4.0, 2.0, 1.5, 3.5]
    result = card([meeting(100.0 + 20.0 * k, gap) for k, gap in enumerate(gaps)], [])
    cues = result.cues
    assert times(cues, CueKind.MEETING) == [120.0, 140.0, 160.0, 200.0, 220.0]
    assert [cue.time for cue in result.left_out] == [100.0, 180.0, 240.0]
    assert result.least_left_out == 3.0
    assert [cue.time for cue in cues] == sorted(cue.time for cue in cues)
    assert (len(cues), cues[0].kind, cues[-1].kind) == (CUES_MOST, CueKind.BEGIN, CueKind.DONE)


def test_the_longest_pauses_come_before_all_meetings():
    lengths = [3.0, 9.0, 1.0, 5.0, 2.0, 4.0, 8.0]
    pauses = [Pause(10.0 * k, 10.0 * k + length, 0.0, 0.0) for k, length in enumerate(lengths, 1)]
    met = [meeting(100.0 + 20.0 * k) for k in range(9)]
    result = card(met, pauses)
    assert times(result.cues, CueKind.PAUSE) == [10.0, 20.0, 40.0, 50.0, 60.0, 70.0]
    assert times(result.left_out, CueKind.PAUSE) == [30.0]
    assert len(result.cues) == CUES_MOST
    # Of equal meetings the earlier ones have a place.
    few = card(met, pauses[:3]).cues
    assert times(few, CueKind.PAUSE) == [10.0, 20.0, 30.0]
    assert times(few, CueKind.MEETING) == [100.0, 120.0]


@pytest.mark.parametrize(("speed", "counts"), [(1.0, False), (1.01, False), (1.0101, True), (1.5, True)])
def test_a_bench_that_is_never_faster_has_no_fastest_moment(speed, counts):
    assert bool(times(card([], [], speed).cues, CueKind.FASTEST)) == counts


def test_meetings_one_after_the_other_on_one_side_are_one_cue():
    met = [
        meeting(10.0, 2.0), meeting(12.0), meeting(13.0, 0.7, Side.RIGHT), meeting(12.0 + TOGETHER, 3.0),
        meeting(13.0 + TOGETHER, 0.9, oncoming=False), meeting(23.0 + 2.0 * TOGETHER, 2.0),
    ]  # fmt: skip
    result = card(met, [], 1.0)
    cues = [cue for cue in result.cues if cue.nearest]
    assert [[one.time for one in cue.meetings] for cue in cues] == [[10.0, 12.0, 22.0], [13.0], [23.0], [43.0]]
    assert (cues[0].time, cues[0].since, cues[0].until, cues[0].nearest) == (12.0, 10.0, 22.0, met[1])
    assert result.least_left_out is None


@pytest.mark.parametrize("seed", range(50))
def test_whatever_happens_nothing_is_lost_and_nobody_left_out_is_nearer(seed):
    some = random.Random(seed)
    met = [
        meeting(time, some.uniform(0, 8), some.choice([*Side]), oncoming=some.random() < 0.5)
        for time in sorted(some.uniform(2, 900) for _ in range(some.randrange(40)))
    ]
    begins = sorted(some.sample(range(2, 900), some.randrange(9)))
    pauses = [Pause(float(one), one + some.uniform(0.1, 1.0), 0.0, 0.0) for one in begins]
    result = card(met, pauses, some.choice([1.0, 2.0]))
    everything = (*result.cues, *result.left_out)
    assert sorted((one for cue in everything for one in cue.meetings), key=lambda one: one.time) == met
    assert sorted(times(everything, CueKind.PAUSE)) == begins
    assert len(times(result.cues, CueKind.PAUSE)) == min(len(pauses), CUES_MOST - 2)
    assert len(result.cues) == CUES_MOST or not result.left_out
    kept = [cue.nearest.gap for cue in result.cues if cue.nearest]
    assert result.least_left_out is None or max(kept, default=0.0) <= result.least_left_out
