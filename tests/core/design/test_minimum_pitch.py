"""Minimum pitch: against the reference, against first contact and slow scans beside the answer, at the edges."""

import numpy as np
import pytest

from core import (
    Dance,
    Dragon,
    LimitedBy,
    Spiral,
    first_contact,
    minimum_pitch,
)
from tests.campaigns.sweep_pitch import judged, random_case
from tests.support.near import assert_near
from tests.support.reference import reference
from tests.support.refused import refused
from tests.support.slow_pitch import SlowWay
from tests.support.slow_search import SlowDance, arc_length

CASES = reference("minimum_pitch")["cases"]
# Pitches are promised to this [m].
ACCURACY = 1e-9
# The same where single pitches are bisected and rounding hides nothing [m].
CLOSELY = 2e-12
# The largest pitch there is [m].
WIDEST = 1e4
# Widest bracket, relative to the pitch, if a clearance changes by less than 1e-6 m per metre of pitch [1].
WIDE_BRACKET = 2e-6
# Its head bench of 1.97 m stretches far across a circle of 0.85 m radius, and folds on it.
FOLDING = Dragon(14, 2.21, 1.47, 0.06, 0.12)


@pytest.mark.parametrize("case", CASES, ids=[case["name"] for case in CASES])
def test_every_case_of_the_reference_is_met(case):
    dragon = Dragon(**case["dragon"])
    radius = case["turning_diameter"] / 2
    islands = case["other_feasible_intervals"]
    result = minimum_pitch(dragon, turning_radius=radius, start_turns=case["start_turns"])
    assert_near(result.pitch, case["pitch"], ACCURACY)
    assert result.limited_by == case["limited_by"]
    assert result.pitch_bracket[0] <= case["pitch"] + ACCURACY
    assert result.pitch_bracket[1] - result.pitch_bracket[0] <= ACCURACY
    assert result.benches == (tuple(case["benches"]) if "benches" in case else None)
    assert result.head_radius == (pytest.approx(case["head_radius"], abs=1e-6) if "head_radius" in case else None)
    assert_near(result.other_feasible_intervals, islands, ACCURACY)


def test_benches_out_of_reach_change_nothing():
    few, many = (minimum_pitch(Dragon(benches)).pitch for benches in (80, 10_000))
    assert_near(many, few, 1e-12)


def test_where_a_handle_turns_back_the_claim_names_the_step_of_the_scan_and_the_begin_of_the_proof():
    """The fold of its head limits the pitch; with 40 digits: 0.525552677857343."""
    result = minimum_pitch(FOLDING, turning_radius=0.85, start_turns=5.0)
    assert result.justified_by == "scan"
    assert result.proven_up_to is None
    assert result.pitch + result.scan_step < result.proven_from < WIDEST
    assert_near(result.pitch_bracket, (0.525552677857343, result.pitch), ACCURACY)
    assert (result.limited_by, result.benches, result.bench, result.head_radius) == (LimitedBy.FOLD, None, 0, 0.85)


def listed(overhang):
    """Bench 2 alone with this overhang, chords of 1 m."""
    overhangs = np.array([0.2, 0.2, overhang, 0.2, 0.2])
    return Dragon.of(1.0 + 2.0 * overhangs, np.full(5, 0.3), overhangs)


@pytest.mark.parametrize(
    "dragon, margin, field",
    [
        (Dragon(5, 2.0, 2.0, 0.3, 0.5), 0.0, "dragon.overhang"),
        (listed(0.9), 0.0, "dragon.overhangs.0"),
        (listed(0.5), 0.4, "margin"),
        (Dragon(40), 1.0999, "margin"),
        (listed(0.7999999), 0.0, "dragon.overhangs.0"),
    ],
)
def test_benches_that_meet_on_a_straight_line_are_refused(dragon, margin, field):
    """Equality too: any bend brings the inner corners nearer.

    Those that are hardly apart lean to each other on the widest spiral allowed: no circle mends that.
    """
    with refused(field):
        minimum_pitch(dragon, turning_radius=1000.0, margin=margin)
    assert SlowWay.of(dragon, WIDEST, 16.0, 1.0).least() <= margin


def test_a_start_inside_a_graze_passes_it_and_names_the_pair_that_repeats_it():
    """All benches alike: what 0 and 9 would meet before the start, 1 and 10 meet after it, at the same pitch."""
    dragon = Dragon(50, 2.4, 2.4, 0.13, 0.042)
    margin = 0.343
    results = {
        turns: minimum_pitch(dragon, turning_radius=2.64, start_turns=turns, margin=margin) for turns in (4.06, 12.0)
    }
    inside, before = results.values()
    assert before.benches == (0, 9)
    assert inside.benches == (1, 10)
    assert_near(inside.pitch, before.pitch, ACCURACY)
    assert inside.head_radius < inside.pitch * 4.06 < before.head_radius
    for turns, result in results.items():
        dance = SlowDance.of(dragon, Spiral(result.pitch, turns))
        there = float(dance.way - dance.growth * arc_length(result.head_radius / dance.growth))
        assert_near(dance.pair_gap(there, result.benches), margin, ACCURACY)


SHORT = Dragon(6, 1.21, 0.93, 0.61, 0.0)
NEARLY_APART = Dragon(8, 2.0, 2.0, 0.3, 0.49925)


@pytest.mark.parametrize(
    "dragon, radius, turns, margin, limited_by",
    [
        # with benches nearly as wide as the circle no ring bound holds at lower pitches
        (SHORT, 1.32, 10.0, 0.29, LimitedBy.START),
        # the tail stands on the outward extension
        (Dragon(20), 4.5, 0.2, 0.0, LimitedBy.START),
        # the dance would begin inside the circle before any benches touch, or they cannot
        (Dragon(20), 6.8, 16.0, 0.0, LimitedBy.START),
        (Dragon(2), 4.5, 16.0, 0.0, LimitedBy.START),
        # with 3 mm left on a straight line the corners of benches lean that far inwards up to a pitch of 1,400 m
        (NEARLY_APART, 2.0, 3.0, 0.0, LimitedBy.CIRCLE),
        # one bench, which folds before the circle at every pitch up to 2.4 m
        (Dragon(1), 0.7535, 1.605, 0.0, LimitedBy.FOLD),
    ],
)
def test_every_larger_pitch_is_proven_by_bounds(dragon, radius, turns, margin, limited_by):
    result = minimum_pitch(dragon, turning_radius=radius, start_turns=turns, margin=margin)
    assert (result.limited_by, result.justified_by, result.proven_up_to) == (limited_by, "bound", None)
    assert result.proven_from == result.pitch
    assert result.scan_step is None
    low, high = result.pitch_bracket
    assert high - low <= max(ACCURACY, WIDE_BRACKET * high)
    assert judged(dragon, radius, turns, margin, np.random.default_rng(1))[1] == ""
    if limited_by is LimitedBy.START:
        assert result.pitch == radius / turns
        assert result.other_feasible_intervals == ()
        assert result.benches is result.head_radius is None
    if limited_by is LimitedBy.FOLD:  # by 40 digits
        assert_near(result.pitch, 2.434860824509272, ACCURACY)


def test_just_above_the_infeasible_end_of_a_bracket_a_pitch_is_feasible():
    """The proven bands end 9e-12 m above it."""
    dragon, radius, turns, margin = random_case(382)
    low, high = minimum_pitch(dragon, turning_radius=radius, start_turns=turns, margin=margin).pitch_bracket
    assert low + CLOSELY < high
    dances = [Dance(dragon, Spiral(pitch, turns)) for pitch in (low, low + CLOSELY)]
    assert [first_contact(dance, margin=margin).head.radius > radius for dance in dances] == [True, False]
