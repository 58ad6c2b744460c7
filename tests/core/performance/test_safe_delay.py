"""Safe delays: exact ones of streets that cross, and random performances against first encounters and a slow look."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from core import (
    Arc,
    Budget,
    Dance,
    Dragon,
    InvalidValue,
    Line,
    Outcome,
    Part,
    Passage,
    Performance,
    Route,
    SafeDelays,
    Spiral,
    TooMuchWork,
    first_encounter,
    safe_delay,
)
from core.performance.safe_delay import END_WIDTH
from tests.support.depth import some
from tests.support.slow_performance import SlowPerformance

# Width of a bench of the default dragon, and half of the square that two of them cross [m].
WIDTH = 0.3
# Step of a slow look at a performance [s].
STEP = 0.05


def streets(one: int, two: int, **options: Any) -> Performance:
    """Two processions of this many benches, which cross at right angles in the middle of both streets."""
    lines = [Line((-60.0, 0.0), (60.0, 0.0)), Line((0.0, -60.0), (0.0, 60.0))]
    dances = [Dance(Dragon(n), Route([line]), **options) for n, line in zip((one, two), lines, strict=True)]
    return Performance([Part(dance) for dance in dances])


def wait(dragon: Dragon, margin: float = 0.0) -> float:
    """How long another procession must wait until this one has crossed the square of both streets [s]."""
    return float(dragon.chords.sum()) + 2.0 * float(dragon.overhangs[0]) + WIDTH + margin


@pytest.mark.parametrize(("one", "two"), [(5, 5), (12, 3), (1, 4)])
def test_processions_that_cross_wait_until_the_other_one_is_past(one: int, two: int) -> None:
    delays = safe_delay(streets(one, two), 1, -60.0, 60.0)
    ends = [end for interval in delays.safe for end in interval]
    exact = [-60.0, -wait(Dragon(two)), wait(Dragon(one)), 60.0]
    assert ends == pytest.approx(exact, rel=0, abs=END_WIDTH)
    assert ends[1] <= exact[1]
    assert ends[2] >= exact[2]
    assert delays.undecided == ()
    mirrored = [end for interval in safe_delay(streets(one, two), 0, -60.0, 60.0).safe for end in interval]
    assert mirrored == pytest.approx([-end for end in reversed(exact)], rel=0, abs=END_WIDTH)


def test_slower_processions_wait_longer() -> None:
    delays = safe_delay(streets(5, 5, head_speed=0.5), 1, 0.0, 60.0)
    assert delays.safe[0] == pytest.approx((2.0 * wait(Dragon(5)), 60.0), rel=0, abs=END_WIDTH)


def performances(seed: int) -> tuple[Performance, int]:
    """Two or three small dragons on streets and arcs, one of them perhaps with a pause; and the one that is delayed."""
    rng = np.random.default_rng(seed)
    parts = []
    for k in range(int(rng.integers(2, 4))):
        dragon = Dragon(int(rng.integers(1, 6)), *rng.uniform((2.0, 1.4, 0.1, 0.1), (3.4, 2.2, 0.3, 0.3)))
        turn = rng.uniform(0.0, 2.0 * np.pi)
        ahead = 25.0 * np.array([np.cos(turn), np.sin(turn)])
        aside = rng.uniform(-4.0, 4.0) * np.array([-np.sin(turn), np.cos(turn)])
        piece: Arc | Line = Line(tuple((aside - ahead).tolist()), tuple((aside + ahead).tolist()))
        if rng.random() < 0.4:
            centre = tuple(rng.uniform(-4.0, 4.0, 2).tolist())
            piece = Arc(centre, rng.uniform(5.0, 9.0), turn, float(rng.choice([-4.5, 4.5])))
        pauses = k == 0 and rng.random() < 0.5
        passages = [Passage(0.5, until_time=14.0), Passage(0.0, until_time=17.0)] if pauses else []
        dance = Dance(dragon, Route([piece]), rng.uniform(0.6, 1.4), passages)
        parts.append(Part(dance, rng.uniform(0.0, 8.0)))
    return Performance(parts), int(rng.integers(len(parts)))


@pytest.mark.parametrize("seed", some(range(60), 6))
def test_random_performances_meet_nobody_at_safe_delays_and_somebody_at_others(seed: int) -> None:
    performance, k = performances(seed)
    margin = 0.0 if seed % 2 else 0.3
    delays = safe_delay(performance, k, -15.0, 25.0, margin=margin)
    rng = np.random.default_rng(seed)
    tried = rng.uniform(-15.0, 25.0, 12).tolist() + [end for interval in delays.safe for end in interval]
    safe = 0
    for delay in tried:
        parts = list(performance.parts)
        parts[k] = replace(parts[k], delay=delay)
        delayed = Performance(parts)
        met = first_encounter(delayed, margin=margin)
        near = min([abs(end - delay) for interval in delays.safe + delays.undecided for end in interval], default=99.0)
        if any(low <= delay <= high for low, high in delays.safe):
            safe += 1
            assert met.outcome is Outcome.CLEAR, delay
            if safe < 3:
                times = np.arange(delayed.begin, delayed.end.time, STEP)
                assert SlowPerformance(parts).clearance(times)[0].min() > margin
        elif near > END_WIDTH and not any(low <= delay <= high for low, high in delays.undecided):
            assert met.outcome in (Outcome.CONTACT, Outcome.CONTACT_AT_START), delay
    assert sum(high - low for low, high in delays.undecided) < 1.0


def test_dragons_that_fold_are_judged_until_before_that() -> None:
    turned = [Part(Dance(Dragon(20), Spiral(1.6, 5.0, centre))) for centre in ((0.0, 0.0), (15.5, 0.0))]
    performance = Performance(turned)
    with pytest.raises(InvalidValue, match=r"stop must be given, before 123\.9\d* s, when a bench of parts\[0\]"):
        safe_delay(performance, 1)
    with pytest.raises(InvalidValue, match=r"before 63\.9\d* s, when a bench of parts\[1\] may fold, got 70 s"):
        safe_delay(performance, 1, -60.0, 0.0, stop=70.0)
    delays = safe_delay(performance, 1, -5.0, 20.0, stop=60.0)
    for low, high in delays.safe:
        for delay in (low, 0.5 * (low + high), high):
            met = first_encounter(Performance([turned[0], replace(turned[1], delay=delay)]), stop=60.0)
            assert met.outcome is Outcome.CLEAR


def test_no_delay_is_safe_while_two_others_meet_and_all_are_without_others() -> None:
    crossing = streets(4, 4)
    third = Part(Dance(Dragon(2), Route([Line((100.0, 0.0), (120.0, 0.0))])), name="third")
    delays = safe_delay(replace(crossing, parts=[*crossing.parts, third]), "third", 0.0, 20.0)
    assert (delays.safe, delays.undecided, delays.part) == ((), (), 2)
    alone = safe_delay(Performance([third]), "third", 0.0, 20.0)
    assert alone.safe == ((0.0, 20.0),)
    assert repr(alone) == "<SafeDelays: delays of third from 0 to 20 s: safe 0 to 20 s>"


@pytest.mark.parametrize("place", ["beginning", "end"])
def test_dragons_that_stand_on_the_same_ground_meet_at_all_delays_of_a_fortnight(place: str) -> None:
    """Found by one sample, not by one for every third of a second."""
    lanes = [Line((0.0, 0.0), (40.0, 0.0)), Line((0.0, 0.0), (0.0, 40.0))]
    if place == "end":
        lanes = [Line(lane.end, lane.start) for lane in lanes]
    crossing = Performance([Part(Dance(Dragon(3), Route([lane]))) for lane in lanes])
    delays = safe_delay(crossing, 1, -1e6, 1e6)
    assert (delays.safe, delays.undecided) == ((), ())
    assert delays.marches < 60
    for delay in (-1e6, -50.0, 50.0, 1e6):
        parts = [crossing.parts[0], replace(crossing.parts[1], delay=delay)]
        assert first_encounter(Performance(parts)).outcome is not Outcome.CLEAR


def test_following_two_benches_through_the_delays_is_work() -> None:
    lanes = [Line((0.0, 0.0), (1000.0, 0.0)), Line((1000.0, 0.0), (0.0, 0.0))]
    against = Performance([Part(Dance(Dragon(3), Route([lane]))) for lane in lanes])
    with pytest.raises(TooMuchWork):
        safe_delay(against, 1, -900.0, 900.0, budget=Budget(1e6))


def test_a_stray_makes_the_safe_intervals_shorter() -> None:
    nominal, straying = (safe_delay(streets(3, 3), 1, 0.0, 30.0, stray=stray) for stray in (0.0, 0.05))
    assert isinstance(straying, SafeDelays)
    assert 0.1 < straying.safe[0][0] - nominal.safe[0][0] < 0.6


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"part": 2}, "part must be a dragon's name, or its number below 2, got 2"),
        ({"part": True}, "part must be a dragon's name, or its number below 2, got True"),
        ({"part": "north"}, "part must be a dragon's name, or its number below 2, got 'north'"),
        ({"least": 5.0, "most": 5.0}, "most must be more than least (5 s), got 5 s"),
        ({"most": 1e9}, "most must be at most 1e+06 s"),
        ({"margin": -1.0}, "margin must be"),
    ],
)
def test_impossible_questions_are_refused(arguments: dict[str, Any], message: str) -> None:
    with pytest.raises(InvalidValue) as error:
        safe_delay(streets(2, 2), **({"part": 1} | arguments))
    assert message.split(",")[0] in str(error.value)


def test_a_question_ends_with_its_budget() -> None:
    with pytest.raises(TooMuchWork):
        safe_delay(streets(5, 5), 1, -60.0, 60.0, budget=Budget(work=2e3))
