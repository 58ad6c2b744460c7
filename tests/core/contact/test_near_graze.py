"""Benches in decimals: the model of the kernels, contacts within a nanometre of a graze, and cases left to doubles."""

from decimal import Decimal, localcontext
from functools import cache

import pytest

import core.contact.near_graze
from core import (
    Arc,
    Clothoid,
    Coil,
    Dance,
    Dragon,
    Line,
    Outcome,
    Passage,
    Route,
    Spiral,
    Turn,
    Waypoints,
    bench_poses,
    first_contact,
    minimum_pitch,
    separation,
    trajectory,
)
from core.contact.decimal_shapes import DIGITS, exact_separation
from core.contact.near_graze import LAST_BENCH, NEGLIGIBLE, ExactPair, narrow_bracket
from core.kernels import Ended
from core.kernels.results import Marched
from tests.support.depth import thorough
from tests.support.near import assert_near
from tests.support.scenes import lengths_and_widths
from tests.support.searches import search_on

# Positions of the kernels [m]: on a route a kilometre long an arc length is good to 2e-13 m.
DOUBLE = 1e-12
PRECISE = Decimal("1e-30")  # [m]
BRACKET = 1e-9  # [s]
DRAGON = Dragon(60)
TURN = Turn(1.7)
RAMP = Clothoid((100, 0), 0.0, 0.0, 0.3, 12.0)
BEND = Route([Line((0, 0), (100, 0)), RAMP, Clothoid(RAMP.end, RAMP.end_heading, 0.3, -0.2, 20.0)], start=100.0)


@pytest.fixture(autouse=True)
def in_decimals():
    with localcontext() as context:
        context.prec = DIGITS
        yield


def pair_of(path, pair):
    search = search_on(DRAGON, path)
    search.resize(DRAGON.benches)
    return ExactPair(search, pair)


@pytest.mark.parametrize(
    "path, travel",
    [
        *((Spiral(), 412.4), (Spiral(0.45, 20.0), 300.0), (TURN, -30.0), (TURN, 14.0), (TURN, 60.0)),
        *((BEND, 2.0), (BEND, 25.0)),
    ],
    ids=["near contact", "another", "before the turn", "in the turn", "after the turn", "ramp", "clothoids"],
)
@pytest.mark.parametrize("pair", [(0, 19), (7, 31)])
def test_benches_stand_where_the_kernels_put_them(path, travel, pair):
    model = pair_of(path, pair)
    benches = model.benches(Decimal(travel))
    for bench in benches:
        assert abs(bench.along[0] ** 2 + bench.along[1] ** 2 - 1) < PRECISE
    poses = bench_poses(trajectory(Dance(DRAGON, path), travel).position)
    sizes = lengths_and_widths(DRAGON)
    result = separation(*(column[bench] for bench in pair for column in (poses, sizes))).separation
    assert_near(float(exact_separation(*benches)[0]), result, DOUBLE)


@pytest.mark.parametrize(
    "path",
    [
        *(Spiral(0.55, 1e3), Spiral(1.0, 1e4), Spiral(0.95, 1e5)),
        Route([Arc((1e5, -1e5), 1e4, 3.0, 6.0)], start=1e3),
        Route([Coil(1.7, 1e5, 9e4)], start=1e3),
    ],
    ids=["550 m", "10 km", "95 km", "arc", "170 km"],
)
def test_far_from_a_centre_a_link_is_as_exact_as_near_to_it(path):
    for bench in pair_of(path, (0, 10)).benches(Decimal(7)):
        assert abs((bench.along[0] ** 2 + bench.along[1] ** 2).sqrt() - 1) < NEGLIGIBLE


@cache
def grazing_spiral(margin, below):
    """A spiral whose pitch is that much below the least one [m]."""
    return Spiral(minimum_pitch(DRAGON, margin=margin).pitch_bracket[0] - below)


def assert_narrow(contact):
    clear, within = contact.time_bracket
    assert contact.outcome is Outcome.CONTACT
    assert clear < contact.time < within <= clear + BRACKET


@pytest.mark.parametrize("margin", [0.0, 0.05])
@pytest.mark.parametrize(
    "head_speed, below",
    [(1.0, 1e-9), (0.01, 1e-7), *thorough((0.01, 1e-11), (2.0, 1e-11))],
)
def test_within_a_nanometre_of_a_graze_the_bracket_is_narrow(margin, below, head_speed):
    spiral = grazing_spiral(margin, below)
    assert_narrow(first_contact(Dance(DRAGON, spiral, head_speed), margin=margin))


@pytest.mark.parametrize("margin, below", [(0.0, 1e-9), (0.05, 1e-7), *thorough((0.0, 1e-7))])
def test_with_passages_the_bracket_of_a_near_graze_is_as_narrow(margin, below):
    spiral = grazing_spiral(margin, below)
    steady = first_contact(Dance(DRAGON, spiral), margin=margin)
    passages = [Passage(1.5, until_s=30.0), Passage(0.0, until_time=50.0), Passage(1.0, until_s=100.0)]
    contact = first_contact(Dance(DRAGON, spiral, 1.0, passages), margin=margin)
    assert_narrow(contact)
    assert contact.benches == steady.benches
    assert_near(contact.time, steady.time + 20.0, BRACKET)  # 30 m in 50 s instead of 30 s


@pytest.fixture(scope="module")
def grazing():
    """A search on a spiral a nanometre of pitch below the least one, and its contact: a graze 2 mm of travel long."""
    search = search_on(DRAGON, grazing_spiral(0.0, 1e-9))
    result = search.approach(0.0, 300.0, 1.0)
    assert result.ended == Ended.TOUCHED
    assert result.half > 0.5 * BRACKET
    return search, result


@pytest.mark.parametrize(
    "changed, half, narrow",
    [
        ({}, 0.4 * BRACKET, True),
        ({"pair": (0, 18)}, 0.4 * BRACKET, False),
        ({}, 1e-3, True),
        ({}, 1e-2, False),
    ],
    ids=["alone", "a second pair is as near", "still within", "apart again"],
)
def test_a_bracket_is_narrowed_where_one_pair_is_near_and_not_apart_again(grazing, changed, half, narrow):
    search, result = grazing
    assert (narrow_bracket(search, result._replace(**changed), half) is not None) is narrow


@pytest.mark.parametrize("margin, alone", [(1e-3, False), *thorough((0.0, True))])
def test_where_another_pair_was_within_the_margin_earlier_the_bracket_stays(margin, alone):
    """Benches 0 and 11 pass each other 0.9 mm apart, 2.6 m of travel before benches 0 and 8 touch."""
    search = search_on(DRAGON, Spiral(), margin)
    assert (narrow_bracket(search, Marched(Ended.TOUCHED, 409.0, 412.48, (0, 8)), BRACKET) is not None) is alone


@pytest.mark.thorough
def test_benches_that_graze_between_two_instants_are_not_proven_apart_by_the_gaps_at_both(
    grazing,
):
    search, result = grazing
    pair, (before, after) = ExactPair(search, result.pair), (result.proven - 0.01, result.proven + 0.01)
    assert min(pair.gap(Decimal(before)), pair.gap(Decimal(after))) > 0
    assert not pair.stays_apart(before, after)
    assert pair.stays_apart(before, result.proven - 0.005)


@pytest.mark.parametrize("limit, earlier", [("LINK_STEPS", 0.0), *thorough(("INTERVALS_MAX", 1.0))])
def test_where_the_way_takes_too_many_intervals_or_a_link_too_many_steps_the_bracket_stays(
    monkeypatch, grazing, limit, earlier
):
    search, result = grazing
    monkeypatch.setattr(core.contact.near_graze, limit, 2)
    assert narrow_bracket(search, result._replace(proven=result.proven - earlier), 0.4 * BRACKET) is None


def test_a_curve_through_waypoints_and_benches_far_behind_are_followed_in_doubles_alone():
    assert not pair_of(Route([Waypoints(((0, 0), (80, 0), (160, 30)))], start=150.0), (0, 2)).can_follow
    assert pair_of(TURN, (0, 2)).can_follow
    assert pair_of(Spiral(), (0, LAST_BENCH)).can_follow
    assert not pair_of(Spiral(), (0, LAST_BENCH + 1)).can_follow
    contact = first_contact(Dance(Dragon(2_000, width=0.54), Spiral(start_turns=1_000)))
    assert contact.outcome is Outcome.CONTACT
    assert contact.benches[1] > LAST_BENCH


def test_where_a_travel_is_rounded_to_more_than_the_bracket_decimals_are_not_asked():
    contact = first_contact(Dance(Dragon(20), Spiral(0.3, 1_500), 0.01))
    assert contact.outcome is Outcome.CONTACT
    assert contact.time_bracket[1] - contact.time_bracket[0] > BRACKET
