"""First contact: against the reference, against a slow search that shares no code, at grazes, at the edges."""

from functools import cache

import numpy as np
import pytest
from hypothesis import HealthCheck, assume, given, settings
from hypothesis import strategies as st

from core import (
    Dance,
    Dragon,
    EndReason,
    FailureKind,
    Judgement,
    Outcome,
    Spiral,
    Turn,
    check,
    clearance_profile,
    first_contact,
    least_clearance,
    minimum_pitch,
    quick_check,
)
from core.contact.march import BRACKET
from core.contact.search import MARGIN_MAX
from core.design.pitch_bands import BORDER_WIDTH
from tests.support.depth import examples, some, thorough
from tests.support.near import assert_near
from tests.support.random_dances import random_dance
from tests.support.reference import reference_cases
from tests.support.refused import refused
from tests.support.slow_search import SlowDance

CASES = reference_cases("first_contact")
# Times are promised to this [s] and places to what the head moves meanwhile [m].
ACCURACY = 1e-9
# Rounding of a separation at some ten metres from the centre [m].
ROUNDING = 1e-13
# The clearance of the slow search at its own contact is rounding; pairs this close to the margin are tied [m].
TIED = 1e-9
# Half width of the window around a graze in which the slow search looks for its bottom [s].
AROUND = 0.1
DANCE = Dance(Dragon(), Spiral())


@pytest.mark.uncompiled
@pytest.mark.parametrize("name", CASES)
def test_every_case_of_the_reference_is_met(name):
    case = CASES[name]
    dance = Dance(Dragon(**case["dragon"]), Spiral(case["pitch"], case["start_turns"]), case["head_speed"])
    contact = first_contact(dance)
    assert contact.outcome == case["outcome"]
    if contact.outcome is Outcome.CONTACT:
        result = contact.time, contact.head.theta, contact.head.radius, *contact.point
        assert_near(result, [case["time"], case["head_theta"], case["head_radius"], *case["point"]], ACCURACY)
        assert list(contact.benches) == case["benches"]
        assert (contact.corner.bench, contact.corner.name) == tuple(case["corner"].values())
        assert (contact.edge.bench, contact.edge.name) == tuple(case["edge"].values())
        clear, within = contact.time_bracket
        assert within - ACCURACY <= clear <= contact.time <= within
        assert contact.end is None
    elif contact.outcome is Outcome.CLEAR:
        assert (contact.time, contact.time_bracket, contact.benches, contact.gap) == (None, None, None, None)
        assert contact.certificate.clear_until == contact.end.time


def assert_as_slow_search(dance, margin=0.0):
    contact = first_contact(dance, margin=margin)
    slow = SlowDance.of(dance.dragon, dance.path)
    touch = slow.first_touch(margin)
    if touch is None:
        assert contact.outcome is Outcome.CLEAR
        return
    time, pair = touch
    assert contact.outcome is (Outcome.CONTACT if time else Outcome.CONTACT_AT_START)
    assert_near(contact.time, time, ACCURACY)
    if time and contact.benches != pair:  # two pairs at once
        assert_near(slow.pair_gap(time, contact.benches), margin, TIED)


# Seed, whether benches are given one by one, and the margin in parts of the clearance at the start.
SEEDS = [
    *some([(seed, False, 0.0) for seed in (*range(4), *range(5, 12), 13)], 6),
    *some([(seed, True, 0.0) for seed in range(100, 110)], 4),
    *some([(seed, seed % 2 == 1, 0.4) for seed in (200, 201, 202, 203, 205)], 2),
    *thorough((4, False, 0.0), (12, False, 0.0), (204, False, 0.4)),
]


@pytest.mark.parametrize(("seed", "bench_by_bench", "margin"), SEEDS)
def test_random_dragons_touch_when_and_where_the_slow_search_says(seed, bench_by_bench, margin):
    dance, slow = random_dance(seed, bench_by_bench)
    assert_as_slow_search(dance, margin * float(slow.clearance([0.0])[0][0]))


@pytest.mark.parametrize("benches", [223, 224, 1000, 100_000])
def test_benches_that_the_contact_does_not_reach_change_nothing(benches):
    few, many = (first_contact(Dance(Dragon(count), Spiral())) for count in (30, benches))
    assert (many.time, many.benches, many.time_bracket) == (few.time, few.benches, few.time_bracket)


@pytest.mark.thorough
def test_the_last_bench_that_matters_is_found_among_three_hundred():
    """Short benches on tight spirals, where neighbouring rings meet; a slow search of 60 benches finds the same."""
    many, few = (Dragon(benches, 0.7, 0.7, 0.2, 0.1) for benches in (300, 60))
    assert_as_slow_search(Dance(many, Spiral(0.2055, 5.5)))  # at the start
    contact = first_contact(Dance(many, Spiral(0.2232, 12.0)))
    time, pair = SlowDance.of(few, Spiral(0.2232, 12.0)).first_touch()
    assert contact.benches == pair == (0, 31)
    assert_near(contact.time, time, ACCURACY)


# Start inside the region in which rings can touch: pairs far down the body are met before the body repeats itself.
@pytest.mark.parametrize(
    "dance",
    [
        Dance(Dragon(8, 1.0, 2.0, 0.1, 0.1), Spiral(0.9, 1.4)),
        *thorough(
            Dance(Dragon(40, 1.0, 2.0, 0.1, 0.3), Spiral(0.42, 2.6)),
            Dance(Dragon(60, 0.6, 1.4, 0.2, 0.2), Spiral(0.36, 4.3)),
            Dance(Dragon(60, 1.4, 1.4, 0.2, 0.2), Spiral(0.38, 2.9)),
        ),
    ],
    ids=["one-turn", "long-overhang", "short-head", "uniform"],
)
def test_a_start_near_the_centre_is_searched_with_all_pairs(dance):
    assert_as_slow_search(dance)


def test_contact_at_the_start_names_a_touching_pair():
    contact = first_contact(Dance(Dragon(), Spiral(0.35)))
    assert (contact.outcome, contact.time, contact.time_bracket) == (Outcome.CONTACT_AT_START, 0.0, None)
    assert SlowDance.of(Dragon(), Spiral(0.35)).pair_gap(0.0, contact.benches) <= 0.0


def test_overhangs_that_cross_over_a_short_bench_touch_at_the_start():
    assert first_contact(Dance(Dragon(3, 1.0, 1.0, 0.1, 0.4), Spiral(2.0, 5.0))).outcome is Outcome.CONTACT_AT_START


@pytest.mark.parametrize(
    ("dance", "reason"),
    [
        *((Dance(Dragon(benches), Spiral(0.1, 40.0)), EndReason.FOLD) for benches in (1, 2)),
        (Dance(Dragon(12, 1.0, 1.0, 0.05, 0.0), Spiral(3.0, 4.0)), EndReason.CENTRE),
    ],
    ids=["a lone bench", "two that share a handle", "wide, to its centre"],
)
def test_a_dance_without_a_pair_that_meets_is_clear_to_its_end(dance, reason):
    contact = first_contact(dance)
    assert (contact.outcome, contact.end, contact.end.reason) == (Outcome.CLEAR, dance.end, reason)


@pytest.mark.parametrize("pitch", [0.8, 1.2, 1.5])
def test_a_clear_dance_takes_hardly_more_steps_than_a_colliding_one(pitch):
    colliding, clear = (first_contact(Dance(Dragon(), Spiral(each))) for each in (0.55, pitch))
    assert (colliding.outcome, clear.outcome) == (Outcome.CONTACT, Outcome.CLEAR)
    assert clear.certificate.steps < 1.6 * colliding.certificate.steps


# -- grazes: pitches at which a dip of the clearance just reaches the margin, so that the time of contact jumps --

JUMPS = [
    (Dragon(30, 2.0, 2.2, 0.3, 0.275), 8.0, 0.55, 0.60, 0.0),
    *thorough(
        (Dragon(), 16.0, 0.4503, 0.4504, 0.0),
        (Dragon(40), 10.0, 0.50, 0.51, 0.05),
        *some(
            [
                (Dragon(40), 8.0, 0.632, 0.633, 0.0),
                (Dragon(60, 3.0, 2.0, 0.3, 0.0), 9.0, 0.499, 0.500, 0.0),
                (Dragon(40), 10.0, 0.679, 0.680, 0.05),
            ],
            0,
        ),
    ),
]
# Distance from the jump on both sides, and least jump of the head's way that counts [m].
BESIDE = 1e-7
JUMP = 0.2


def jump_between(dragon, turns, low, high, margin):
    """A pitch within 1e-12 m above the largest jump of the head's radius at first contact."""

    def radius(pitch):
        contact = first_contact(Dance(dragon, Spiral(pitch, turns)), margin=margin)
        return contact.head.radius if contact.head else 0.0

    below, above = radius(low), radius(high)
    while high - low > 1e-12:
        middle = 0.5 * (low + high)
        there = radius(middle)
        if abs(below - there) >= abs(there - above):
            high, above = middle, there
        else:
            low, below = middle, there
    return high


@pytest.mark.parametrize(("dragon", "turns", "low", "high", "margin"), JUMPS)
def test_a_graze_is_met_just_below_a_jump_and_passed_just_above(dragon, turns, low, high, margin):
    pitch = jump_between(dragon, turns, low, high, margin)
    tight, wide = Spiral(pitch - BESIDE, turns), Spiral(pitch + BESIDE, turns)
    met, passed = (first_contact(Dance(dragon, spiral), margin=margin) for spiral in (tight, wide))
    assert met.outcome is Outcome.CONTACT
    assert met.time_bracket[1] - met.time_bracket[0] <= ACCURACY
    later = passed.time if passed.time is not None else passed.end.time
    assert later - met.time > JUMP
    dips = (SlowDance.of(dragon, path).dip(met.time - AROUND, met.time + AROUND, met.benches) for path in (tight, wide))
    (met_bottom, met_least), (bottom, least) = dips
    assert margin - 10 * BESIDE <= met_least <= margin < least <= margin + 10 * BESIDE
    assert met.time < met_bottom
    graze = passed.certificate.least_clearance
    assert graze.benches == met.benches
    assert_near(graze.clearance, least, ROUNDING)
    assert_near(graze.time, bottom, 1e-5)


@cache
def undecided_dance():
    """Benches 0 and 19 graze to the last digits, and others overlap some seconds later."""
    return Dance(Dragon(60), Spiral(minimum_pitch(Dragon(60)).pitch_bracket[1] - BORDER_WIDTH))


def test_an_undecided_contact_names_the_pair_that_surely_overlaps_and_carries_no_bound():
    dance = undecided_dance()
    contact, least = first_contact(dance), least_clearance(dance)
    assert (contact.outcome, contact.time, contact.benches) == (Outcome.UNDECIDED, None, None)
    clear, within = contact.time_bracket
    slow = SlowDance.of(dance.dragon, dance.path)
    bottom, graze = slow.dip(clear - AROUND, clear + AROUND, (0, 19))
    assert clear <= bottom
    assert_near(graze, 0.0, ROUNDING)
    free = Dance(Dragon(60), Spiral(dance.path.pitch + BORDER_WIDTH))
    assert_near(within, first_contact(free).time, ACCURACY)
    gaps, pairs = slow.clearance([within + 1e-6])
    assert gaps[0] < 0.0
    assert tuple(pairs[0]) == contact.overlapping
    assert (least.distance, least.at_least) == (0.0, None)
    assert slow.pair_gap(least.time + 1e-6, least.benches) < 0.0


SLOW = Dragon(20, 1.2, 1.2, 0.8, 0.25)


@pytest.mark.parametrize("start", [-194.0, -15.0, -12.1])
def test_a_slow_contact_before_time_zero_is_decided_as_the_same_one_after_it(start):
    """On the way in a turn is the spiral from the same turns; the benches close by 4 mm per metre."""
    turn, spiral = Dance(SLOW, Turn(1.0, 1.5, start_turns=8.0)), Dance(SLOW, Spiral(1.0, 8.0))
    later, contact, least = first_contact(spiral), first_contact(turn, start=start), least_clearance(turn, start=start)
    assert (later.outcome, contact.outcome) == (Outcome.CONTACT, Outcome.CONTACT)
    clear, within = contact.time_bracket
    assert within - ACCURACY <= clear <= contact.time <= within
    assert_near([contact.time, least.time], [later.time + turn.begin] * 2, ACCURACY)
    assert contact.benches == later.benches
    assert (least.distance, least.at_least, least.benches) == (0.0, 0.0, contact.benches)
    assert check(turn, start=start).verdict is Judgement.FAILS


@pytest.mark.parametrize("judge", [check, quick_check])
def test_a_contact_that_is_certain_but_perhaps_not_the_first_fails(judge):
    dance = undecided_dance()
    contact, report = first_contact(dance, start=dance.begin), judge(dance)
    failure = report.failures[0]
    assert report.verdict is Judgement.FAILS
    assert (failure.kind, failure.benches) == (FailureKind.CONTACT, contact.overlapping)
    assert (failure.time, failure.time_bracket) == (contact.time_bracket[1], contact.time_bracket)
    assert_near(report.stop, failure.time, ACCURACY)
    assert "at the latest; up to 216." in failure.message


def test_without_a_certain_contact_an_undecided_search_stays_undecided():
    dance = undecided_dance()
    stop = first_contact(dance).time_bracket[0] + 1.0
    contact, report = first_contact(dance, stop=stop), check(dance, stop=stop)
    assert (contact.outcome, contact.overlapping, contact.time_bracket[1]) == (Outcome.UNDECIDED, None, stop)
    assert report.verdict is Judgement.UNDECIDED
    assert [failure.kind for failure in report.failures] == [FailureKind.UNDECIDED]
    assert report.least_clearance.at_least is None


def test_a_margin_between_a_graze_and_zero_is_met_at_the_graze():
    dance = Dance(Dragon(), Spiral(0.4504))
    graze = first_contact(dance).certificate.least_clearance
    above, below = (first_contact(dance, margin=graze.clearance * factor) for factor in (1.001, 0.999))
    assert (above.outcome, below.outcome) == (Outcome.CONTACT, Outcome.CONTACT)
    assert above.time - graze.time < AROUND < below.time - graze.time


# -- margin ------------------------------------------------------------------------------------------


@pytest.mark.parametrize("pitch", [0.52, 0.55, 0.62])
@pytest.mark.parametrize("margin", [1e-6, 0.05, 0.12])
def test_at_first_contact_with_a_margin_shapely_measures_the_margin(pitch, margin):
    contact = first_contact(Dance(Dragon(40), Spiral(pitch, 10.0)), margin=margin)
    slow = SlowDance.of(Dragon(40), Spiral(pitch, 10.0))
    if contact.outcome is Outcome.CONTACT_AT_START:
        assert slow.clearance([0.0])[0][0] <= margin
        return
    assert contact.outcome is Outcome.CONTACT
    assert_near(slow.pair_gap(contact.time, contact.benches), margin, TIED)
    proven, overlapping = slow.clearance(contact.time_bracket)[0]
    assert overlapping - ROUNDING <= margin <= proven + ROUNDING


@given(st.floats(0.0, 0.2), st.floats(0.0, 0.2))
@settings(max_examples=30, deadline=None)
def test_a_larger_margin_is_never_met_later(one, other):
    dance = Dance(Dragon(30), Spiral(0.6, 8.0))
    less, more = (first_contact(dance, margin=margin).time for margin in sorted((one, other)))
    assert more <= less + ACCURACY


# -- laws ----------------------------------------------------------------------------------------------


DANCES = st.integers(0, 10_000).map(lambda seed: random_dance(seed, seed % 3 == 0))


# Three random dances in ten have a contact: about once in a hundred runs fifty without one come before ten with one.
@settings(max_examples=examples(8, 25), deadline=None, suppress_health_check=[HealthCheck.filter_too_much])
@given(DANCES)
def test_all_is_clear_just_before_first_contact_and_not_just_after(both):
    dance, slow = both
    contact = first_contact(dance)
    assume(contact.outcome is Outcome.CONTACT)
    clear, within = contact.time_bracket
    gaps, _ = slow.clearance([*(clear * (1.0 - np.array([0.0, 1e-9, 1e-6, 1e-3, 0.01, 0.1, 0.5]))), within])
    assert gaps[:-1].min() > -ROUNDING
    assert gaps[-1] <= ROUNDING


@settings(max_examples=examples(15, 40), deadline=None)
@given(DANCES, st.floats(0.1, 10.0), st.floats(0.1, 10.0))
def test_lengths_and_speed_scale_the_answer(both, k, speed):
    dance, _ = both
    contact, dragon, spiral = first_contact(dance), dance.dragon, dance.path
    large = Dragon.of(k * dragon.lengths, k * dragon.widths, k * dragon.overhangs)
    scaled = first_contact(Dance(large, Spiral(k * spiral.pitch, spiral.start_turns), speed))
    assert scaled.outcome is contact.outcome
    if contact.outcome is Outcome.CONTACT:
        assert scaled.time * speed == pytest.approx(k * contact.time, rel=1e-9, abs=ACCURACY * max(1.0, speed))
        assert_near(scaled.point, k * np.array(contact.point), 1e-8 * max(1.0, k))


def test_the_bracket_is_as_narrow_as_promised():
    low, high = first_contact(DANCE).time_bracket
    assert 0.0 < high - low <= 2.1 * BRACKET


# -- limits ----------------------------------------------------------------------------------------------


@pytest.mark.parametrize("margin", [0.0, MARGIN_MAX])
def test_a_margin_at_its_limits_is_accepted(margin):
    assert first_contact(Dance(Dragon(5), Spiral()), margin=margin).outcome is not Outcome.UNDECIDED


@pytest.mark.parametrize("margin", [-1e-12, MARGIN_MAX * 1.001, float("nan"), float("inf"), "0", None])
def test_a_margin_beyond_its_limits_is_refused(margin):
    with refused("margin"):
        first_contact(DANCE, margin=margin)


def test_the_gap_of_a_contact_is_the_margin_and_at_the_start_what_there_is():
    for margin in (0.0, 0.05, 0.15):
        contact = first_contact(DANCE, margin=margin)
        assert contact.outcome is Outcome.CONTACT
        assert_near(contact.gap, margin, ACCURACY)
    at_start = first_contact(DANCE, margin=0.2)
    assert at_start.outcome is Outcome.CONTACT_AT_START
    assert clearance_profile(DANCE, 0.0).clearance - ROUNDING <= at_start.gap <= 0.2
