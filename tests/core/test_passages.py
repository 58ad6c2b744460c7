"""Clock: passages change only the times of the head."""

from fractions import Fraction
from itertools import accumulate

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from core import (
    Dance,
    Dragon,
    Legs,
    Passage,
    Spiral,
    check,
    clearance_profile,
    contact_check,
    envelope,
    first_contact,
    first_excess,
    highest_speed,
    maximum_head_speed,
    sharpest_bend,
    trajectory,
)
from core.dance import Clock
from tests.support.near import assert_near
from tests.support.refused import refused
from tests.support.shared_dances import square

# Head at 0.5 m/s up to 20 m (40 s), still until 100 s, at 2 m/s up to 60 m (120 s), then at 1 m/s.
PASSAGES = [Passage(0.5, until_s=20.0), Passage(0.0, until_time=100.0), Passage(2.0, until_s=60.0)]
SPIRAL = Spiral(0.55, 16.0)
DRAGON = Dragon(20)
DANCE = Dance(DRAGON, SPIRAL, 1.0, PASSAGES)
STEADY = Dance(DRAGON, SPIRAL)
LATER = 60.0  # delay of everything after the last passage [s]
PAUSE = {"start": 50.0, "stop": 80.0}
SPEEDS = st.floats(0.0, 3.0).filter(lambda speed: speed == 0.0 or speed > 0.05)


def test_times_and_places_are_those_of_the_passages():
    clock = DANCE.clock
    times = [-3, 0, 10, 40, 110, 120, 130]
    places = [-3, 0, 5, 20, 40, 60, 70]
    assert [clock.travel(time) for time in [*times, 70.0, 100.0]] == [*places, 20.0, 20.0]
    assert [clock.time(place) for place in places] == times
    assert clock.speed(np.array([-1.0, 0.0, 40.0, 99.0, 100.0, 120.0])).tolist() == [1.0, 0.5, 0.0, 0.0, 2.0, 1.0]


@settings(max_examples=60, deadline=None)
@given(st.lists(st.tuples(SPEEDS, st.floats(0.1, 50.0)), max_size=6), st.floats(-20.0, 400.0))
def test_a_place_is_first_reached_at_its_time(passed, time):
    ends = accumulate(lasts for _, lasts in passed)
    clock = Clock(1.5, [Passage(speed, None, end) for (speed, _), end in zip(passed, ends, strict=True)])
    travel = clock.travel(time)
    first = clock.time(travel)
    assert first <= time + 1e-9
    assert_near(clock.travel(first), travel, 1e-9)
    assert clock.travel(first - 0.1) < travel
    assert_near(clock.steady(np.array([time])).item() * 1.5, travel, 1e-9)


def test_handles_stand_where_they_stand_without_passages_and_move_by_the_speed_of_the_head():
    times = np.array([0.0, 10.0, 40.0, 70.0, 100.0, 110.0, 250.0])
    motion = trajectory(DANCE, times)
    steady = trajectory(STEADY, DANCE.clock.steady(times))
    assert (motion.position == steady.position).all()
    assert motion.speed == pytest.approx(steady.speed * DANCE.clock.speed(times)[:, None], rel=1e-15)
    assert not motion.velocity[2:4].any()


def test_a_contact_is_at_the_same_place_at_the_time_of_that_place():
    slow = Dance(DRAGON, SPIRAL, 1.0, [Passage(0.1, until_s=430.0)])
    contact, steady, in_passage = (first_contact(dance) for dance in (DANCE, STEADY, slow))
    assert_near(contact.time, steady.time + LATER, 1e-9)
    assert contact.benches == steady.benches
    assert contact.head == steady.head
    assert contact_check(contact).agree
    assert_near(DANCE.end.time, STEADY.end.time + LATER, 1e-9)
    assert_near(in_passage.time, 10.0 * steady.time, 1e-8)
    assert in_passage.time_bracket[1] - in_passage.time_bracket[0] <= 1e-9


def test_nothing_happens_in_a_pause_but_every_question_has_an_answer():
    there = DANCE.clock.steady(np.array(PAUSE["start"])).item()
    report = check(DANCE, venue=square(20), speed_limit=0.1, **PAUSE)
    swept = envelope(DANCE, **PAUSE)
    assert (report.passed, report.highest_speed.speed, report.first_contact.end.time) == (True, 0.0, PAUSE["stop"])
    gap = clearance_profile(STEADY, there).clearance
    assert report.least_clearance.distance == gap
    assert report.least_clearance.time == PAUSE["start"]
    bend = sharpest_bend(STEADY, start=there, stop=there + 1e-9)
    assert_near(report.sharpest_bend.angle, bend.angle, 1e-9)
    assert {"start": swept.start, "stop": swept.stop} == PAUSE


def test_speeds_are_judged_passage_by_passage():
    result = highest_speed(DANCE, stop=300.0)
    assert result.passage == 2
    assert result.time == 100.0
    assert result.speed == pytest.approx(2.0 * highest_speed(STEADY, start=20.0, stop=60.0).speed, rel=1e-12)
    assert first_excess(DANCE, 1.5, stop=300.0).time_bracket == (100.0, 100.0)


def test_a_dance_is_played_faster_as_a_whole_until_a_passage_reaches_the_limit():
    result = maximum_head_speed(DANCE, 3.0, stop=300.0)
    assert result.passage == 2
    played = DANCE.played(result.head_speed)
    assert played.clock.travels == pytest.approx(DANCE.clock.travels)
    faster = highest_speed(played, stop=300.0 / result.head_speed)
    assert faster.speed == pytest.approx(3.0, rel=1e-9)
    assert_near(faster.time, result.time, 1e-9)


@pytest.mark.parametrize(
    "field, passages",
    [
        ("passages.0.speed", [Passage(1e-9, 5.0)]),
        ("passages.0", [Passage(1.0, 5.0, 5.0)]),
        ("passages.1.until_s", [Passage(1.0, 5.0), Passage(2.0, 5.0)]),
        ("passages.1.until_time", [Passage(0.7, 5.0), Passage(2.0, until_time=5.0)]),
        ("passages.2.until_s", [Passage(0.7, until_time=1.0 / 3.0), Passage(0.3, until_time=1.0), Passage(2.0, 0.1)]),
        ("passages.1", [Passage(1.0, 5.0), 3.0]),
        ("passages", [Passage(1.0, 5.0)] * 1001),
    ],
)
def test_invalid_passages_are_refused_by_name(field, passages):
    with refused(field):
        Dance(DRAGON, SPIRAL, 1.0, passages)


def test_a_dance_with_passages_is_judged_to_the_very_end_of_its_path():
    # The place at the rounded time of the end lies an ulp behind the end of this path.
    path = Legs([(-80, -16), (0, -16), (16, -8), (0, 0), (-16, 8), (0, 16), (80, 16)], [0, 5])
    dance = Dance(Dragon(benches=8), path, passages=[Passage(0.5, until_s=20.0), Passage(0.0, until_time=100.0)])
    assert dance.clock.steady(np.array(dance.end.time)) > dance.steady.end.time
    assert sharpest_bend(dance, start=dance.begin).angle == sharpest_bend(dance.steady).angle


SLOW, EVERY = 0.5202767152444515, 150.6993216995924  # a speed [m/s] and an end [m] or [s] that no double holds


@pytest.mark.parametrize("ends", ["until_s", "until_time"])
def test_however_many_passages_there_are_each_node_has_one_rounding(ends):
    passages = [Passage(SLOW + 0.001 * k, **{ends: EVERY * (k + 1)}) for k in range(1000)]
    clock = Dance(Dragon(30), Spiral(0.55, 300), 1.0, passages).clock
    time = travel = Fraction(0)
    for k, passage in enumerate(passages, start=1):
        end = Fraction(getattr(passage, ends))
        speed = Fraction(passage.speed)
        if ends == "until_s":
            time, travel = time + (end - travel) / speed, end
        else:
            time, travel = end, travel + (end - time) * speed
        if k % 100 == 0:
            assert clock.times[k] == float(time)
            assert clock.travels[k] == float(travel)
