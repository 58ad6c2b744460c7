"""Cards: at most eight cues, chosen by the rule, and every other one left out in the open."""

from __future__ import annotations

import random

import pytest

from core.people.cards import CUES_MOST, TOGETHER, CueKind, card_of
from core.people.cues import BenchCues, FastestMoment, Meeting, Pause, Side, Stand

pytestmark = pytest.mark.uncompiled


def bench(meetings: list[Meeting], pauses: list[Pause], speed: float = 1.5) -> BenchCues:
    stands = [Stand(time, time, 0.0, time, 0.0) for time in (0.0, 1.0, 1_000.0)]
    fastest = FastestMoment(500.0, speed, 1.0, 3, 0.0, 0.0)
    return BenchCues(3, *stands[:2], 0.0, 1.0, 2, 4, tuple(meetings), fastest, tuple(pauses), stands[2])


def meeting(time: float, gap: float, side: Side = Side.LEFT, *, oncoming: bool = True) -> Meeting:
    return Meeting(time, int(time), side, gap, oncoming, 0.0, 0.0)


def test_the_nearest_meetings_have_a_place_and_the_others_are_counted() -> None:
    met = [meeting(100.0 + 20.0 * k, gap) for k, gap in enumerate([3.0, 1.0, 2.5, 0.5, 4.0, 2.0, 1.5, 3.5])]
    card = card_of(bench(met, []))
    assert len(card.cues) == CUES_MOST
    assert [cue.kind for cue in card.cues].count(CueKind.MEETING) == CUES_MOST - 3
    assert sorted(cue.nearest.gap for cue in card.cues if cue.nearest) == [0.5, 1.0, 1.5, 2.0, 2.5]
    assert card.least_left_out == 3.0
    assert [cue.time for cue in card.left_out] == [100.0, 180.0, 240.0]
    assert [cue.time for cue in card.cues] == sorted(cue.time for cue in card.cues)
    assert (card.cues[0].kind, card.cues[-1].kind) == (CueKind.BEGIN, CueKind.DONE)


def test_the_longest_pauses_come_before_all_meetings() -> None:
    lengths = [3.0, 9.0, 1.0, 5.0, 2.0, 4.0, 8.0]
    pauses = [Pause(10.0 * k, 10.0 * k + length, 0.0, 0.0) for k, length in enumerate(lengths, 1)]
    met = [meeting(100.0 + 20.0 * k, 1.0) for k in range(9)]
    card = card_of(bench(met, pauses))
    assert [cue.time for cue in card.cues if cue.kind is CueKind.PAUSE] == [10.0, 20.0, 40.0, 50.0, 60.0, 70.0]
    assert [cue.time for cue in card.left_out if cue.kind is CueKind.PAUSE] == [30.0]
    assert len(card.cues) == CUES_MOST
    # Of equal meetings the earlier ones have a place.
    card = card_of(bench(met, pauses[:3]))
    assert [cue.time for cue in card.cues if cue.kind is CueKind.PAUSE] == [10.0, 20.0, 30.0]
    assert [cue.time for cue in card.cues if cue.nearest] == [100.0, 120.0]


@pytest.mark.parametrize(("speed", "counts"), [(1.0, False), (1.01, False), (1.0101, True), (1.5, True)])
def test_a_bench_that_is_never_faster_has_no_fastest_moment(speed: float, counts: bool) -> None:
    kinds = [cue.kind for cue in card_of(bench([], [], speed)).cues]
    assert (CueKind.FASTEST in kinds) == counts


def test_meetings_one_after_the_other_on_one_side_are_one_cue() -> None:
    met = [
        meeting(10.0, 2.0), meeting(12.0, 1.0), meeting(13.0, 0.7, Side.RIGHT), meeting(12.0 + TOGETHER, 3.0),
        meeting(13.0 + TOGETHER, 0.9, oncoming=False), meeting(23.0 + 2.0 * TOGETHER, 2.0),
    ]  # fmt: skip
    card = card_of(bench(met, [], 1.0))
    cues = [cue for cue in card.cues if cue.nearest]
    assert [[one.time for one in cue.meetings] for cue in cues] == [[10.0, 12.0, 22.0], [13.0], [23.0], [43.0]]
    assert (cues[0].time, cues[0].since, cues[0].until, cues[0].nearest) == (12.0, 10.0, 22.0, met[1])
    assert card.least_left_out is None


def test_whatever_happens_nothing_is_lost_and_nobody_left_out_is_nearer() -> None:
    for seed in range(50):
        some = random.Random(seed)
        met = [
            meeting(some.uniform(2, 900), some.uniform(0, 8), some.choice([*Side]), oncoming=some.random() < 0.5)
            for _ in range(some.randrange(40))
        ]
        met.sort(key=lambda one: one.time)
        begins = sorted(some.sample(range(2, 900), some.randrange(9)))
        pauses = [Pause(float(one), one + some.uniform(0.1, 1.0), 0.0, 0.0) for one in begins]
        card = card_of(bench(met, pauses, some.choice([1.0, 2.0])))
        everything = [one for cue in (*card.cues, *card.left_out) for one in cue.meetings]
        assert sorted(everything, key=lambda one: one.time) == met
        assert sum(cue.kind is CueKind.PAUSE for cue in (*card.cues, *card.left_out)) == len(pauses)
        kept = [cue.nearest.gap for cue in card.cues if cue.nearest]
        assert len(card.cues) <= CUES_MOST
        assert not card.left_out or len(card.cues) == CUES_MOST
        assert sum(cue.kind is CueKind.PAUSE for cue in card.cues) == min(len(pauses), CUES_MOST - 2)
        assert card.least_left_out is None or not kept or max(kept) <= card.least_left_out
