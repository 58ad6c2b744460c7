"""Crew: every bench has its people at every moment, nobody carries two at once, and minutes and metres add up."""

from __future__ import annotations

import math
from itertools import pairwise
from typing import Any

import numpy as np
import pytest

from core import Arc, Dance, Dragon, InvalidValue, Line, Passage, Route, Spiral, TooLarge
from core.motion.places import handle_places
from core.people.crew import PEOPLE_MAX, SAMPLE, SPELLS_MAX, Crew, Relief, crew, places_near

pytestmark = pytest.mark.uncompiled

DANCE, START, STOP = Dance(Dragon(6), Spiral()), 0.0, 100.0
NEEDED = [8, 2, 2, 3, 2, 2]
# Rounding of sums of times and ways [s], [m], and the error with which a bench is at its place of a change [m].
ROUNDING, AT_PLACE = 1e-9, 0.01
THERE_AND_BACK = Route(
    [Line((0, 0), (60, 0)), Arc((60, 1.6), 1.6, -math.pi / 2, math.pi), Line((60, 3.2), (0, 3.2))], 24.0
)
RELIEFS = [
    Relief(), Relief(4, 20.0), Relief(7, 9.0, rest=25.0), Relief(40, 33.0), Relief(5, None, [10.0, 40.0], 3.0),
    Relief(6, 30.0, [25.0], 10.0), Relief(1, 100.0 / 3.0),
]  # fmt: skip


def planned(relief: Relief) -> Crew:
    return crew(DANCE, NEEDED, relief, start=START, stop=STOP)


@pytest.mark.parametrize("relief", RELIEFS, ids=repr)
def test_every_bench_has_its_people_and_nobody_two_benches(relief: Relief) -> None:
    result = planned(relief)
    assert result.people == sum(NEEDED) + relief.spares
    moments = {time for one in result.spells for time in (one.begin, one.end)}
    for time in sorted({*np.arange(START, STOP + 0.5, 0.5).tolist(), *moments}):
        benches = result.on_benches(time)
        assert [len(people) for people in benches] == NEEDED
        everyone = [person for people in benches for person in people]
        assert len(set(everyone)) == len(everyone)
    for person in range(result.people):
        for before, after in pairwise(result.of(person)):
            assert after.begin - before.end >= relief.rest
            assert after.begin > before.end


@pytest.mark.parametrize("relief", RELIEFS, ids=repr)
def test_minutes_and_metres_add_up_to_those_of_the_benches(relief: Relief) -> None:
    result = planned(relief)
    s = handle_places(DANCE, [START, STOP])
    ways = (s[1] - s[0])[:-1]
    assert sum(one.time for one in result.carried) == pytest.approx(sum(NEEDED) * (STOP - START), abs=ROUNDING)
    assert sum(one.way for one in result.carried) == pytest.approx(float(np.dot(NEEDED, ways)), abs=ROUNDING)
    for one in result.spells:
        places = handle_places(DANCE, [one.begin, one.end])[:, one.bench]
        assert [one.s, one.until_s] == pytest.approx(places.tolist(), abs=ROUNDING)
    for person, carried in enumerate(result.carried):
        assert carried.longest == max((one.end - one.begin for one in result.of(person)), default=0.0)


def test_at_a_change_those_go_out_who_have_carried_longest() -> None:
    result = planned(Relief(3, 25.0))
    for moment in (25.0, 50.0, 75.0):
        out = [one for one in result.spells if one.end == moment]
        on = [one for one in result.spells if one.begin < moment < one.end]
        assert len(out) == 3
        assert max(one.begin for one in out) <= min(one.begin for one in on)
        # Each of them is relieved by one who comes in on the same bench.
        came = {one.relieved: one.bench for one in result.spells if one.begin == moment}
        assert came == {one.person: one.bench for one in out}


def test_with_rest_nobody_comes_in_too_early_and_the_others_carry_on() -> None:
    result = planned(Relief(2, 10.0, rest=25.0))
    # At 10 s both spares come in; those who went out then may come in at 40 s, 70 s, and so on.
    assert sorted({one.begin for one in result.spells}) == [0.0, 10.0, 40.0, 70.0]


def test_a_bench_changes_where_it_passes_the_place_and_the_next_one_after_it() -> None:
    passages = (Passage(0.5, until_s=30.0), Passage(0.0, until_time=70.0))
    dance = Dance(Dragon(4), THERE_AND_BACK, 1.2, passages)
    result = crew(dance, [2, 2, 2, 2], Relief(2, None, [50.0]))
    changes = [one for one in result.spells if one.relieved is not None]
    assert [one.bench for one in changes] == [0, 0, 1, 1, 2, 2, 3, 3]
    for one in changes:
        assert one.s == pytest.approx(50.0, abs=AT_PLACE)
    # Those who come from bench 0 go to bench 1.
    assert {one.person for one in changes if one.bench == 1} == {0, 1}


def test_the_places_near_a_point_are_those_of_a_fine_scan() -> None:
    spiral = Spiral(pitch=1.1, start_turns=9.0)
    for path, point in ((spiral, (4.0, 0.3)), (THERE_AND_BACK, (20.0, 1.5)), (THERE_AND_BACK, (60.0, 1.6))):
        begin, end = max(path.begin, -20.0), min(path.end, 250.0)
        s = np.linspace(begin, end, 200_001)
        away = np.hypot(*(path.position(s) - np.array(point)).T)
        inner = 1 + np.flatnonzero((away[1:-1] < away[:-2]) & (away[1:-1] <= away[2:]) & (away[1:-1] <= 2.0))
        places = places_near(path, point, begin, end, 2.0)
        # At the middle of the arc all places of it are equally near.
        if point == (60.0, 1.6):
            assert len(places) >= 1
            assert all(np.hypot(*(path.position(one) - np.array(point))) <= 2.0 for one in places)
        else:
            assert places == pytest.approx(s[inner].tolist(), abs=2 * (end - begin) / 200_000)
            assert len(places) >= 2
    assert places_near(THERE_AND_BACK, (20.0, 40.0), 0.0, 100.0, 2.0) == []
    assert SAMPLE < 1.6


@pytest.mark.parametrize(
    ("needed", "relief", "words"),
    [
        (NEEDED, Relief(2, 0.0), "relief.shift must be positive, got 0 s"),
        (NEEDED, Relief(2, 100.0), "relief.shift must be shorter than the dance, which takes 100 s, got 100 s"),
        (NEEDED, Relief(0, 10.0), "relief.spares must be at least 1 where people change, got 0: nobody could come in"),
        (NEEDED, Relief(0, None, [3.0]), "relief.spares must be at least 1 where people change"),
        (NEEDED, Relief(1.5), "relief.spares must be a whole number, got 1.5"),
        (NEEDED, Relief(-1), "relief.spares must be zero or more, got -1"),
        (NEEDED, Relief(2, 10.0, rest=-1.0), "relief.rest must be zero or more, got -1 s"),
        (NEEDED, Relief(2, None, [0.0, math.nan]), "relief.places[1] must be a finite number"),
        ([8, 2], Relief(), "needed must have a number of people for each of the 6 benches, got 2"),
        ([8, 2, 2, 0, 2, 2], Relief(), "needed[3] must be positive, got 0"),
        ([8, 2, 2, 2.5, 2, 2], Relief(), "needed[3] must be a whole number, got 2.5"),
    ],
    ids=lambda value: value if isinstance(value, str) else "",
)  # fmt: skip
def test_what_cannot_be_is_refused_in_one_sentence(needed: Any, relief: Relief, words: str) -> None:
    with pytest.raises(InvalidValue) as caught:
        crew(DANCE, needed, relief, start=START, stop=STOP)
    assert str(caught.value).startswith(words)


def test_more_people_or_changes_than_the_limits_are_refused() -> None:
    with pytest.raises(TooLarge, match="people must be at most"):
        crew(DANCE, NEEDED, Relief(PEOPLE_MAX), start=START, stop=STOP)
    with pytest.raises(TooLarge, match="changes of people must be at most"):
        crew(DANCE, NEEDED, Relief(1, 0.5 * STOP / SPELLS_MAX), start=START, stop=STOP)
