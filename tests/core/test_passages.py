"""Clock: passages change only the times of the head."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from core import (
    Area,
    Dance,
    Dragon,
    InvalidValue,
    Legs,
    Passage,
    Spiral,
    Venue,
    check,
    clearance_profile,
    contact_check,
    envelope,
    first_contact,
    first_excess,
    highest_speed,
    least_clearance,
    maximum_head_speed,
    sharpest_bend,
    tolerance,
    trajectory,
    venue_clearance,
)
from core.dance import Clock

# Head at 0.5 m/s up to 20 m (40 s), still until 100 s, at 2 m/s up to 60 m (120 s), then at 1 m/s.
PASSAGES = [Passage(0.5, until_s=20.0), Passage(0.0, until_time=100.0), Passage(2.0, until_s=60.0)]
SPIRAL = Spiral(0.55, 16.0)
DRAGON = Dragon(20)
DANCE, STEADY = Dance(DRAGON, SPIRAL, 1.0, PASSAGES), Dance(DRAGON, SPIRAL)
LATER = 60.0  # delay of everything after the last passage [s]
PAUSE = {"start": 50.0, "stop": 80.0}
ROOM = Venue(Area("square", (((-20, -20), (20, -20), (20, 20), (-20, 20), (-20, -20)),)))
PASSED = st.lists(
    st.tuples(st.floats(0.0, 3.0).filter(lambda v: v == 0.0 or v > 0.05), st.floats(0.1, 50.0), st.booleans()),
    max_size=6,
)


def test_times_and_places_are_those_of_the_passages() -> None:
    clock = DANCE.clock
    travels = {
        -3.0: -3.0,
        0.0: 0.0,
        10.0: 5.0,
        40.0: 20.0,
        70.0: 20.0,
        100.0: 20.0,
        110.0: 40.0,
        120.0: 60.0,
        130.0: 70.0,
    }
    assert {time: clock.travel(time) for time in travels} == travels
    assert [clock.time(travel) for travel in (-3.0, 0.0, 5.0, 20.0, 40.0, 60.0, 70.0)] == [-3, 0, 10, 40, 110, 120, 130]
    assert clock.speed(np.array([-1.0, 0.0, 40.0, 99.0, 100.0, 120.0])).tolist() == [1.0, 0.5, 0.0, 0.0, 2.0, 1.0]


@settings(max_examples=60, deadline=None)
@given(PASSED, st.floats(-20.0, 400.0))
def test_a_place_is_first_reached_at_its_time(passed: list[tuple[float, float, bool]], time: float) -> None:
    passages, end = [], (0.0, 0.0)
    for speed, lasts, by_time in passed:
        end = (end[0] + lasts, end[1] + speed * lasts)
        passages.append(Passage(speed, None, end[0]) if by_time or speed == 0.0 else Passage(speed, end[1]))
    clock = Clock(1.5, passages)
    travel = clock.travel(time)
    first = clock.time(travel)
    assert first <= time + 1e-9
    assert clock.travel(first) == pytest.approx(travel, abs=1e-9)
    assert clock.travel(first - 0.1) < travel
    assert clock.steady(np.array([time])).item() * 1.5 == pytest.approx(travel, abs=1e-9)


def test_handles_stand_where_they_stand_without_passages_and_move_by_the_speed_of_the_head() -> None:
    times = np.array([0.0, 10.0, 40.0, 70.0, 100.0, 110.0, 250.0])
    motion, steady = trajectory(DANCE, times), trajectory(STEADY, DANCE.clock.steady(times))
    assert (motion.position == steady.position).all()
    np.testing.assert_allclose(motion.speed, steady.speed * DANCE.clock.speed(times)[:, None], rtol=1e-15)
    assert not motion.velocity[2:4].any()


def test_a_contact_is_at_the_same_place_at_the_time_of_that_place() -> None:
    contact, steady = first_contact(DANCE), first_contact(STEADY)
    assert contact.time == pytest.approx(steady.time + LATER, abs=1e-9)
    assert (contact.benches, contact.head) == (steady.benches, steady.head)
    assert contact.time_bracket is not None
    assert contact.time_bracket[1] - contact.time_bracket[0] <= 1e-9
    assert "0 m/s until 100 s" in contact.certificate.method
    judged = contact_check(contact)
    assert judged is not None
    assert judged.agree
    assert DANCE.end.time == pytest.approx(STEADY.end.time + LATER, abs=1e-9)


def test_a_contact_in_a_slow_passage_has_a_bracket_as_narrow_as_any() -> None:
    slow = first_contact(Dance(DRAGON, SPIRAL, 1.0, [Passage(0.1, until_s=430.0)]))
    assert slow.time == pytest.approx(10.0 * first_contact(STEADY).time, abs=1e-8)
    assert slow.time_bracket is not None
    assert slow.time_bracket[1] - slow.time_bracket[0] <= 1e-9


def test_nothing_happens_in_a_pause_but_every_question_has_an_answer() -> None:
    there = DANCE.clock.steady(np.array(PAUSE["start"])).item()
    gap = clearance_profile(STEADY, there).clearance
    assert first_contact(DANCE, **PAUSE).end.time == PAUSE["stop"]
    assert least_clearance(DANCE, **PAUSE).distance == gap
    assert least_clearance(DANCE, **PAUSE).time == PAUSE["start"]
    bend = sharpest_bend(STEADY, start=there, stop=there + 1e-9)
    assert sharpest_bend(DANCE, **PAUSE).angle == pytest.approx(bend.angle, abs=1e-9)
    assert highest_speed(DANCE, **PAUSE).speed == 0.0
    assert first_excess(DANCE, 1e-3, **PAUSE) is None
    assert check(DANCE, venue=ROOM, speed_limit=0.1, **PAUSE).passed
    assert (envelope(DANCE, **PAUSE).start, envelope(DANCE, **PAUSE).stop) == (50.0, 80.0)
    assert clearance_profile(DANCE, [50.0, 60.0]).clearance.tolist() == [gap, gap]


def test_speeds_are_judged_passage_by_passage() -> None:
    result = highest_speed(DANCE, stop=300.0)
    assert (result.passage, result.time) == (2, 100.0)
    assert result.speed == pytest.approx(2.0 * highest_speed(STEADY, start=20.0, stop=60.0).speed, rel=1e-12)
    excess = first_excess(DANCE, 1.5, stop=300.0)
    assert excess is not None
    assert excess.time_bracket == (100.0, 100.0)
    report = check(DANCE, speed_limit=1.5, stop=300.0)
    assert [(failure.kind.value, failure.time) for failure in report.failures] == [("speed", 100.0)]
    assert check(DANCE, speed_limit=1.5, stop=99.0).passed


def test_a_dance_is_played_faster_as_a_whole_until_a_passage_reaches_the_limit() -> None:
    limit = 3.0
    result = maximum_head_speed(DANCE, limit, stop=300.0)
    assert result.passage == 2
    played = DANCE.played(result.head_speed)
    assert played.clock.travels == pytest.approx(DANCE.clock.travels)
    faster = highest_speed(played, stop=300.0 / result.head_speed)
    assert faster.speed == pytest.approx(limit, rel=1e-9)
    assert faster.time == pytest.approx(result.time, abs=1e-9)


def test_a_stray_and_a_venue_are_met_at_the_time_of_their_place() -> None:
    small = Venue(Area("square", (((-12, -12), (6.0, -12), (6.0, 12), (-12, 12), (-12, -12)),)))
    ours = venue_clearance(DANCE, small, start=130.0, stop=400.0).areas[0]
    theirs = venue_clearance(STEADY, small, start=70.0, stop=340.0).areas[0]
    assert theirs.time is not None
    assert ours.time == pytest.approx(theirs.time + LATER, abs=1e-9)
    result, steady = tolerance(DANCE, start=400.0, stop=440.0), tolerance(STEADY, start=340.0, stop=380.0)
    assert (result.stray, result.benches) == (steady.stray, steady.benches)
    assert result.time == pytest.approx(steady.time + LATER, abs=1e-9)


@pytest.mark.parametrize(
    ("field", "passages"),
    [
        ("passages.0.speed", [Passage(-1.0, 5.0)]),
        ("passages.0.speed", [Passage(1e-9, 5.0)]),
        ("passages.0", [Passage(1.0)]),
        ("passages.0", [Passage(1.0, 5.0, 5.0)]),
        ("passages.0.until_time", [Passage(0.0, 5.0)]),
        ("passages.0.until_s", [Passage(1.0, 0.0)]),
        ("passages.1.until_s", [Passage(1.0, 5.0), Passage(2.0, 5.0)]),
        ("passages.1.until_time", [Passage(0.5, 5.0), Passage(0.0, until_time=9.0)]),
        ("passages.1", [Passage(1.0, 5.0), 3.0]),
        ("passages", [Passage(1.0, 5.0)] * 1001),
        ("passages", "slow"),
    ],
)
def test_invalid_passages_are_refused_by_name(field: str, passages: list[Passage]) -> None:
    with pytest.raises(InvalidValue) as refused:
        Dance(DRAGON, SPIRAL, 1.0, passages)
    assert refused.value.field == field


def test_a_dance_with_passages_is_judged_to_the_very_end_of_its_path() -> None:
    # The place at the rounded time of the end lies an ulp behind the end of this path.
    points = [(-80, -16), (0, -16), (16, -8), (0, 0), (-16, 8), (0, 16), (80, 16)]
    path = Legs(points, [0, 5])
    dance = Dance(Dragon(benches=8), path, passages=[Passage(0.5, until_s=20.0), Passage(0.0, until_time=100.0)])
    assert dance.clock.steady(np.array(dance.end.time)) > dance.steady.end.time
    bend, steady = sharpest_bend(dance, start=dance.begin), sharpest_bend(dance.steady, start=dance.steady.begin)
    assert bend is not None
    assert steady is not None
    assert bend.angle == steady.angle


@pytest.mark.parametrize("ends", ["until_s", "until_time"])
def test_however_many_passages_there_are_each_node_has_one_rounding(ends: str) -> None:
    passages = [Passage(0.5202767152444515 + 0.001 * k, **{ends: 150.6993216995924 * (k + 1)}) for k in range(1000)]
    clock = Dance(Dragon(30), Spiral(0.55, 300), 1.0, passages).clock
    time = travel = Fraction(0)
    for k, passage in enumerate(passages, start=1):
        if passage.until_s is not None:
            time, travel = (
                time + (Fraction(passage.until_s) - travel) / Fraction(passage.speed),
                Fraction(passage.until_s),
            )
        else:
            end = Fraction(passage.until_time or 0.0)
            time, travel = end, travel + (end - time) * Fraction(passage.speed)
        if k % 100 == 0:
            assert (clock.times[k], clock.travels[k]) == (float(time), float(travel))


def test_a_bracket_stays_true_after_a_thousand_passages() -> None:
    ends = [150.6993216995924 * (k + 1) for k in range(1000)]
    steady = Dance(Dragon(30), Spiral(0.55, 300))
    contact = first_contact(Dance(steady.dragon, steady.path, 1.0, [Passage(0.5202767152444515, end) for end in ends]))
    known = first_contact(steady).time_bracket
    assert known is not None
    assert contact.time_bracket is not None
    # The place of the head at a time after all passages, in exact fractions.
    speed = Fraction(0.5202767152444515)
    clear, touching = (
        Fraction(time) - Fraction(ends[-1]) / speed + Fraction(ends[-1]) for time in contact.time_bracket
    )
    assert clear <= Fraction(known[1])
    assert touching >= Fraction(known[0])
