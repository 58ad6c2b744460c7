"""Crew: every bench has its people at every moment, nobody carries two at once, and minutes and metres add up."""

import math
from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest

from core import Dance, Dragon, Passage, Spiral
from core.motion.places import handle_places
from core.people.crew import Relief, crew, places_near
from tests.support.near import assert_near
from tests.support.refused import refused
from tests.support.shared_dances import there_and_back

pytestmark = pytest.mark.uncompiled

DANCE = Dance(Dragon(6), Spiral())
START = 0.0
STOP = 100.0
NEEDED = [8, 2, 2, 3, 2, 2]
# Rounding of sums of times and ways [s], [m], and the error with which a bench is at its place of a change [m].
ROUNDING = 1e-9
AT_PLACE = 0.01
THERE_AND_BACK = there_and_back(60)
RELIEFS = [
    Relief(), Relief(7, 9.0, rest=25.0), Relief(40, 33.0), Relief(5, None, [10.0, 40.0], 3.0),
]  # fmt: skip


def planned(relief, needed=NEEDED):
    return crew(DANCE, needed, relief, start=START, stop=STOP)


@pytest.mark.parametrize("relief", RELIEFS, ids=repr)
def test_every_bench_has_its_people_nobody_two_and_minutes_and_metres_add_up(relief):
    result = planned(relief)
    assert result.people == sum(NEEDED) + relief.spares
    moments = {time for one in result.spells for time in (one.begin, one.end)}
    for time in sorted({*np.arange(START, STOP + 0.5, 0.5).tolist(), *moments}):
        benches = result.on_benches(time)
        assert [len(people) for people in benches] == NEEDED
        assert len({person for people in benches for person in people}) == sum(NEEDED)
    for person, carried in enumerate(result.carried):
        spells = result.of(person)
        for before, after in pairwise(spells):
            assert after.begin - before.end >= relief.rest
        assert carried.longest == max((one.end - one.begin for one in spells), default=0.0)
    s = handle_places(DANCE, [START, STOP])
    ways = float(np.dot(NEEDED, (s[1] - s[0])[:-1]))
    assert_near(sum(one.time for one in result.carried), sum(NEEDED) * (STOP - START), ROUNDING)
    assert_near(sum(one.way for one in result.carried), ways, ROUNDING)


@pytest.mark.parametrize("relief", RELIEFS[1:], ids=repr)
def test_with_enough_spares_everybody_goes_out_at_every_change_and_with_one_fewer_not(relief):
    enough = planned(relief).enough
    few, all_out, many = (len(planned(replace(relief, spares=k)).spells) for k in (enough - 1, enough, 500))
    assert few < all_out == many


def test_benches_of_which_nobody_ever_goes_out_are_named():
    # At the three changes two of the eight on the head go out, who are the first of those who have carried longest.
    assert planned(Relief(2, 25.0)).unrelieved == (1, 2, 3, 4, 5)
    assert planned(Relief(2, None, [25.0])).unrelieved == ()


def test_at_a_change_those_go_out_who_have_carried_longest():
    spells = planned(Relief(3, 25.0)).spells
    moment = 75.0
    out = [one for one in spells if one.end == moment]
    assert len(out) == 3
    assert max(one.begin for one in out) <= min(one.begin for one in spells if one.begin < moment < one.end)
    # Each of them is relieved by one who comes in on the same bench.
    came = {one.relieved: one.bench for one in spells if one.begin == moment}
    assert came == {one.person: one.bench for one in out}


def test_with_rest_nobody_comes_in_too_early_and_the_others_carry_on():
    # At 10 s both spares come in; those who went out then may come in at 40 s, 70 s, and so on.
    assert {one.begin for one in planned(Relief(2, 10.0, rest=25.0)).spells} == {0.0, 10.0, 40.0, 70.0}


def test_nobody_comes_in_at_a_moment_that_only_rounding_keeps_from_the_end():
    assert min(one.end - one.begin for one in planned(Relief(2, STOP / 30.0)).spells) > 1.0


def test_a_bench_changes_where_it_passes_the_place_and_the_next_one_after_it():
    passages = (Passage(0.5, until_s=30.0), Passage(0.0, until_time=70.0))
    result = crew(Dance(Dragon(4), THERE_AND_BACK, 1.2, passages), [2, 2, 2, 2], Relief(2, None, [50.0]))
    changes = [one for one in result.spells if one.relieved is not None]
    assert [one.bench for one in changes] == [0, 0, 1, 1, 2, 2, 3, 3]
    assert_near([one.s for one in changes], [50.0] * 8, AT_PLACE)
    # Those who come from bench 0 go to bench 1.
    assert {one.person for one in changes if one.bench == 1} == {0, 1}


@pytest.mark.parametrize(
    "path, point", [(Spiral(pitch=1.1, start_turns=9.0), (4.0, 0.3)), (THERE_AND_BACK, (20.0, 1.5))]
)
def test_the_places_near_a_point_are_those_of_a_fine_scan(path, point):
    begin = max(path.begin, -20.0)
    end = min(path.end, 250.0)
    s = np.linspace(begin, end, 200_001)
    away = np.linalg.norm(path.position(s) - point, axis=1)
    inner = 1 + np.flatnonzero((away[1:-1] < away[:-2]) & (away[1:-1] <= away[2:]) & (away[1:-1] <= 2.0))
    places = places_near(path, point, begin, end, 2.0)
    assert len(places) >= 2
    assert_near(places, s[inner], 2 * (end - begin) / 200_000)


@pytest.mark.parametrize(
    "field, relief, needed",
    [
        ("relief.spares", Relief(1.5, 10.0), NEEDED),
        ("relief.places.1", Relief(2, None, [0.0, math.nan]), NEEDED),
        ("needed.3", Relief(), [8, 2, 2, 0, 2, 2]),
    ],
)
def test_what_cannot_be_is_refused(field, relief, needed):
    with refused(field):
        planned(relief, needed)
