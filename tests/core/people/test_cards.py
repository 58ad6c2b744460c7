"""Cards: at most eight cues, chosen by the rule, and every other one left out in the open."""

import random

import pytest

from core.people.cards import CUES_MOST, TOGETHER, TURNS, CueKind, card_of
from core.people.cues import BenchCues, Meeting, Pause, Side, Stand, Turning
from core.people.fastest import FastestMoment

pytestmark = pytest.mark.uncompiled


def card(meetings, pauses, speed=1.5, turns=(), ahead=2):
    stands = [Stand(time, time, 0.0, time, 0.0) for time in (0.0, 1.0, 1_000.0)]
    fastest = FastestMoment(500.0, speed, 1.0, 3, 0.0, 0.0)
    more = tuple(meetings), fastest, tuple(pauses), stands[2], tuple(turns)
    return card_of(BenchCues(3, *stands[:2], 0.0, 1.0, ahead, 4, *more))


def meeting(time, gap=1.0, side=Side.LEFT, *, oncoming=True):
    return Meeting(time, int(time), side, gap, oncoming, 0.0, 0.0)


def times(cues, kind):
    return [cue.time for cue in cues if cue.kind is kind]


@pytest.mark.parametrize("speed, counts", [(1.0, False), (1.01, False), (1.0101, True), (1.5, True)])
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


@pytest.mark.parametrize("ahead, before", [(None, 6), (2, TURNS)], ids=["head", "another bench"])
def test_the_head_has_its_turns_before_all_meetings_and_others_their_largest(ahead, before):
    turns = [Turning(100.0 * k, 100.0 * k + 5.0, 0.0, (-1) ** k * k, 0.0, ((0.0, 0.0),)) for k in range(1, 7)]
    met = [meeting(10.0 + 50.0 * k) for k in range(8)]
    result = card(met, [], 1.0, turns, ahead)
    assert times(result.cues, CueKind.TURN) == [100.0 * k for k in range(7 - before, 7)]
    assert len(result.cues) == CUES_MOST


def rank(cue):
    """The order in which cues have a place: by kind, the longest pauses and the nearest meetings first."""
    gap = cue.nearest.gap if cue.nearest else 0.0
    return [*CueKind].index(cue.kind), gap or cue.since - cue.until, cue.time


@pytest.mark.parametrize("seed", range(50))
def test_the_first_by_the_rule_have_a_place_and_nothing_is_lost(seed):
    some = random.Random(seed)
    met = [
        meeting(time, some.choice([0.5, 1.0, 2.0, 4.0]), some.choice([*Side]), oncoming=some.random() < 0.5)
        for time in sorted(some.uniform(2, 900) for _ in range(some.randrange(40)))
    ]
    begins = sorted(some.sample(range(2, 900, 3), some.randrange(9)))
    pauses = [Pause(float(one), one + some.choice([0.5, 1.0, 2.0]), 0.0, 0.0) for one in begins]
    result = card(met, pauses, some.choice([1.0, 2.0]))
    ranked = sorted((*result.cues, *result.left_out), key=rank)
    in_time = [tuple(sorted(cues, key=lambda cue: cue.time)) for cues in (ranked[:CUES_MOST], ranked[CUES_MOST:])]
    assert [result.cues, result.left_out] == in_time
    assert sorted((one for cue in ranked for one in cue.meetings), key=lambda one: one.time) == met
    assert sorted(times(ranked, CueKind.PAUSE)) == begins
    assert result.cues[0].kind == CueKind.BEGIN
    assert result.cues[-1].kind == CueKind.DONE
    left_out = [cue.nearest.gap for cue in result.left_out if cue.nearest]
    assert result.least_left_out == min(left_out, default=None)
