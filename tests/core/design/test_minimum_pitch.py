"""Minimum pitch: against the reference, against first contact on many pitches, at the edges."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.optimize import brentq

import core.design.ways
from core import (
    Dance,
    Dragon,
    InvalidValue,
    LimitedBy,
    MinimumPitch,
    Outcome,
    Spiral,
    TooMuchWork,
    first_contact,
    minimum_pitch,
)
from tests.campaigns.sweep_pitch import random_case
from tests.support.depth import examples, some
from tests.support.reference import reference
from tests.support.slow_pitch import SlowWay
from tests.support.slow_search import SlowDance, chord_squared

CASES = reference("minimum_pitch")["cases"]
# Pitches are promised to this [m].
ACCURACY = 1e-9
# Within this of its minimum a pitch is neither surely feasible nor surely not [m].
BESIDE = 1e-8
# The same where single pitches are bisected and rounding hides nothing [m].
CLOSELY = 2e-12
# The largest pitch there is [m].
WIDEST = 1e4
# Widest bracket, relative to the pitch, if a clearance changes by less than 1e-6 m per metre of pitch [1].
WIDE_BRACKET = 2e-6
# Its head bench of 1.97 m stretches far across a circle of 0.85 m radius, and folds on it.
FOLDING = Dragon(14, 2.21, 1.47, 0.06, 0.12)


def is_feasible(dragon: Dragon, pitch: float, radius: float, turns: float, margin: float) -> bool:
    """True if the head reaches the circle by first_contact()."""
    if pitch * turns <= radius:
        return False
    try:
        contact = first_contact(Dance(dragon, Spiral(pitch, turns)), margin=margin)
    except InvalidValue:  # it folds at the start
        return False
    if contact.outcome is Outcome.CLEAR:
        return contact.end.theta * pitch / (2 * np.pi) <= radius
    return contact.outcome is Outcome.CONTACT and contact.head.radius <= radius


@pytest.fixture(scope="module")
def answers() -> dict[str, MinimumPitch]:
    return {case["name"]: answer(case) for case in CASES}


def answer(case: dict[str, Any]) -> MinimumPitch:
    return minimum_pitch(
        Dragon(**case["dragon"]),
        turning_radius=case["turning_diameter"] / 2,
        start_turns=case["start_turns"],
        margin=case.get("margin", 0.0),
    )


@pytest.mark.parametrize("case", CASES, ids=[case["name"] for case in CASES])
def test_every_case_of_the_reference_is_met(case: dict[str, Any], answers: dict[str, MinimumPitch]) -> None:
    result = answers[case["name"]]
    assert result.pitch == pytest.approx(case["pitch"], rel=0, abs=ACCURACY)
    assert result.limited_by == case["limited_by"]
    assert result.pitch_bracket[0] <= case["pitch"] + ACCURACY
    assert result.pitch_bracket[1] - result.pitch_bracket[0] <= ACCURACY
    if "benches" in case:
        assert list(result.benches) == case["benches"]
    if "head_radius" in case:
        assert result.head_radius == pytest.approx(case["head_radius"], rel=0, abs=1e-6)
    assert len(result.other_feasible_intervals) == len(case["other_feasible_intervals"])
    for ours, theirs in zip(result.other_feasible_intervals, case["other_feasible_intervals"], strict=True):
        np.testing.assert_allclose(ours, theirs, rtol=0, atol=ACCURACY)


@pytest.mark.parametrize("case", CASES, ids=[case["name"] for case in CASES])
def test_random_pitches_above_are_feasible_and_the_one_below_is_not(
    case: dict[str, Any], answers: dict[str, MinimumPitch]
) -> None:
    result = answers[case["name"]]
    dragon, radius, turns = Dragon(**case["dragon"]), case["turning_diameter"] / 2, case["start_turns"]
    margin = case.get("margin", 0.0)
    above = result.pitch + np.geomspace(BESIDE, 5.0, 60) * np.random.default_rng(7).uniform(0.5, 1.0, 60)
    assert [pitch for pitch in above if not is_feasible(dragon, pitch, radius, turns, margin)] == []
    assert not is_feasible(dragon, result.pitch - BESIDE, radius, turns, margin)


@pytest.mark.parametrize("case", CASES, ids=[case["name"] for case in CASES])
def test_below_the_answer_only_the_islands_are_feasible(case: dict[str, Any], answers: dict[str, MinimumPitch]) -> None:
    result = answers[case["name"]]
    dragon, radius, turns = Dragon(**case["dragon"]), case["turning_diameter"] / 2, case["start_turns"]
    islands = result.other_feasible_intervals
    for pitch in np.random.default_rng(8).uniform(radius / turns, result.pitch, 40):
        inside = any(low + BESIDE <= pitch <= high - BESIDE for low, high in islands)
        near = any(low - BESIDE <= pitch <= high + BESIDE for low, high in islands)
        feasible = is_feasible(dragon, pitch, radius, turns, case.get("margin", 0.0))
        assert inside <= feasible <= near


def test_an_island_has_both_its_ends_between_pitches_that_touch() -> None:
    result = minimum_pitch(Dragon(30), turning_radius=6.3)
    [(low, high)] = result.other_feasible_intervals
    assert 6.3 / 16.0 < low < high < result.pitch
    for pitch, inside in ((low - CLOSELY, False), (low, True), (high, True), (high + CLOSELY, False)):
        assert is_feasible(Dragon(30), pitch, 6.3, 16.0, 0.0) == inside


@pytest.mark.parametrize("radius", [2.5, 3.3, 4.1, 5.2])
@pytest.mark.parametrize("margin", [0.0, 0.05])
def test_the_least_separation_at_the_answer_is_the_margin(radius: float, margin: float) -> None:
    """Checked with a slow dance near the stated place of the head, and distances by shapely."""
    result = minimum_pitch(Dragon(60), turning_radius=radius, margin=margin, start_turns=14.0)
    assert result.head_radius is not None
    dance = SlowDance.of(Dragon(60), Spiral(result.pitch, 14.0))
    theta = result.head_radius / dance.growth
    there = float(dance.way - dance.growth * 0.5 * (theta * np.sqrt(1 + theta**2) + np.arcsinh(theta)))
    if result.limited_by is LimitedBy.CIRCLE:
        assert result.head_radius == pytest.approx(radius, rel=0, abs=ACCURACY)
        least = dance.pair_gap(there, result.benches)
    else:
        assert result.limited_by is LimitedBy.GRAZE
        assert result.head_radius > radius
        least = dance.dip(there - 0.02, there + 0.02, result.benches)[1]
    assert least == pytest.approx(margin, rel=0, abs=ACCURACY)


@settings(max_examples=4, deadline=None)
@given(st.floats(2.5, 5.0), st.floats(0.01, 0.3))
def test_a_margin_or_a_tighter_circle_never_needs_a_smaller_pitch(radius: float, more: float) -> None:
    dragon = Dragon(40)
    minimum = minimum_pitch(dragon, turning_radius=radius, start_turns=14.0).pitch
    assert minimum_pitch(dragon, turning_radius=radius, start_turns=14.0, margin=more).pitch >= minimum - ACCURACY
    assert minimum_pitch(dragon, turning_radius=radius - more, start_turns=14.0).pitch >= minimum - ACCURACY


@settings(max_examples=5, deadline=None)
@given(st.floats(0.2, 5.0), st.floats(2.5, 5.0))
def test_scaling_every_length_scales_the_answer(k: float, radius: float) -> None:
    small = minimum_pitch(Dragon(40), turning_radius=radius)
    large = minimum_pitch(Dragon(40, k * 3.41, k * 2.2, k * 0.3, k * 0.275), turning_radius=k * radius)
    assert large.pitch == pytest.approx(k * small.pitch, rel=0, abs=ACCURACY * max(1.0, k))
    assert large.limited_by == small.limited_by


@pytest.mark.parametrize("benches", [100, 223, 10_000])
def test_benches_out_of_reach_change_nothing(benches: int) -> None:
    assert minimum_pitch(Dragon(benches)).pitch == pytest.approx(minimum_pitch(Dragon(80)).pitch, rel=0, abs=1e-12)


@pytest.mark.parametrize("changed", [2, -1])
def test_a_dragon_given_bench_by_bench_has_the_answer_of_the_uniform_one(changed: int) -> None:
    uniform = Dragon(14)
    lengths = np.array(uniform.lengths)
    lengths[changed] += 1e-9
    listed = Dragon.of(lengths, uniform.widths, uniform.overhangs)
    one, other = (minimum_pitch(dragon, turning_radius=3.0, start_turns=7.0) for dragon in (uniform, listed))
    assert other.pitch == pytest.approx(one.pitch, rel=0, abs=ACCURACY)
    assert (one.justified_by, other.justified_by) == ("bound", "bound")


def test_a_short_dragon_is_proven_up_from_its_start_whatever_bounds_hold_at_lower_pitches() -> None:
    """It goes around less than once, with benches nearly as wide as the circle, so that no ring bound holds."""
    dragon = Dragon(6, 1.21, 0.93, 0.61, 0.0)
    result = minimum_pitch(dragon, turning_radius=1.32, start_turns=10.0, margin=0.29)
    assert result.pitch == 1.32 / 10.0
    assert (result.limited_by, result.justified_by) == (LimitedBy.START, "bound")
    assert (result.proven_from, result.proven_up_to) == (result.pitch, None)
    for pitch in np.geomspace(result.pitch + BESIDE, WIDEST, 20):
        assert is_feasible(dragon, pitch, 1.32, 10.0, 0.29)


def test_benches_far_across_the_circle_are_proven_by_bands_too() -> None:
    result = minimum_pitch(Dragon(20), turning_radius=1.5, start_turns=12.0)
    assert (result.justified_by, result.limited_by, result.scan_step) == ("bound", LimitedBy.CIRCLE, None)
    assert is_feasible(Dragon(20), result.pitch + BESIDE, 1.5, 12.0, 0.0)
    assert not is_feasible(Dragon(20), result.pitch - BESIDE, 1.5, 12.0, 0.0)


def test_where_a_handle_turns_back_the_claim_names_the_step_of_the_scan_and_the_begin_of_the_proof() -> None:
    result = minimum_pitch(FOLDING, turning_radius=0.85, start_turns=5.0)
    assert (result.justified_by, result.proven_up_to) == ("scan", None)
    assert result.scan_step is not None
    assert result.pitch + result.scan_step < result.proven_from < WIDEST


@pytest.mark.parametrize("turns", [0.2, 0.3, 0.5])
def test_a_start_less_than_a_turn_out_is_proven_for_every_larger_pitch(turns: float) -> None:
    """The tail stands on the outward extension; the head begins on the circle at the least pitch."""
    result = minimum_pitch(Dragon(), start_turns=turns)
    assert result.pitch == 4.5 / turns
    assert (result.limited_by, result.justified_by, result.proven_up_to) == (LimitedBy.START, "bound", None)
    short = Dragon(40)  # a slow scan of all 223 takes minutes
    for pitch in np.geomspace(result.pitch, WIDEST, examples(4, 8)):
        assert SlowWay.of(short, pitch, turns, 4.5).least() > 0.0


def fold_on_the_circle(chord: float, radius: float, near: tuple[float, float]) -> float:
    """Pitch between two at which a head of this chord folds on the circle [m].

    The chord is then the largest distance of a point of the spiral near half a turn further out, by scipy.
    """

    def too_long(growth: float) -> float:
        theta = radius / growth

        def slope(delta: float) -> float:
            return float(delta + theta * (1.0 - np.cos(delta)) + theta * (theta + delta) * np.sin(delta))

        crest = brentq(slope, np.pi, 1.5 * np.pi, xtol=1e-15)
        return float(np.sqrt(chord_squared(theta, crest)) * growth - chord)

    growth = brentq(too_long, *(np.array(near) / (2.0 * np.pi)), xtol=1e-16)
    return float(2.0 * np.pi * growth)


def test_a_minimum_limited_by_the_fold_is_where_the_head_folds_on_the_circle() -> None:
    """With 40 digits: 0.525552677857343."""
    result = minimum_pitch(FOLDING, turning_radius=0.85, start_turns=5.0)
    expected = fold_on_the_circle(FOLDING.chords[0], 0.85, (0.5, 0.6))
    assert expected == pytest.approx(0.525552677857343, rel=0, abs=ACCURACY)
    assert result.pitch == pytest.approx(expected, rel=0, abs=ACCURACY)
    assert result.pitch_bracket[0] == pytest.approx(expected, rel=0, abs=ACCURACY)
    assert (result.limited_by, result.benches, result.bench, result.head_radius) == (LimitedBy.FOLD, None, 0, 0.85)
    assert "limited by fold of bench 0;" in repr(result)


def test_a_small_circle_is_reached_at_larger_pitches() -> None:
    """One bench, which folds before the circle at every pitch up to 2.4 m. With 40 digits: 2.434860824509272."""
    result = minimum_pitch(Dragon(1), turning_radius=0.7535, start_turns=1.605)
    expected = fold_on_the_circle(Dragon().chords[0], 0.7535, (2.3, 2.6))
    assert expected == pytest.approx(2.434860824509272, rel=0, abs=ACCURACY)
    assert result.pitch == pytest.approx(expected, rel=0, abs=ACCURACY)
    assert (result.limited_by, result.justified_by, result.proven_up_to) == (LimitedBy.FOLD, "bound", None)


def listed(overhang: float) -> Dragon:
    """Bench 2 alone with this overhang, chords of 1 m."""
    overhangs = np.array([0.2, 0.2, overhang, 0.2, 0.2])
    return Dragon.of(1.0 + 2.0 * overhangs, np.full(5, 0.3), overhangs)


@pytest.mark.parametrize(
    ("dragon", "margin", "field", "words"),
    [
        (Dragon(5, 2.2, 2.2, 0.3, 0.6), 0.0, "dragon.overhang", ("0.55 m", "0.6 m", "benches 0 and 2", "1 m")),
        (Dragon(5, 2.0, 2.0, 0.3, 0.5), 0.0, "dragon.overhang", ("0.5 m", "a quarter of dragon.body_length")),
        (Dragon(), 1.2, "margin", ("1.1 m", "1.2 m", "benches 0 and 2", "1.65 m", "0.275 m")),
        (listed(0.9), 0.0, "dragon.overhangs.0", ("dragon.overhangs[2]", "1 m", "0.9 m", "0.2 m")),
        (listed(0.5), 0.4, "margin", ("0.3 m", "0.4 m", "benches 0 and 2")),
    ],
)
def test_benches_that_meet_on_a_straight_line_are_refused(
    dragon: Dragon, margin: float, field: str, words: tuple[str, ...]
) -> None:
    """Equality too: any bend brings the inner corners nearer."""
    with pytest.raises(InvalidValue) as refused:
        minimum_pitch(dragon, turning_radius=1.0, margin=margin)
    assert refused.value.field == field
    assert all(word in refused.value.message for word in words)


@pytest.mark.parametrize(
    ("dragon", "margin", "field", "words"),
    [
        (Dragon(5, 2.2, 2.2, 0.3, 0.54999), 0.0, "dragon.overhang", ("must be smaller, got 0.54999 m", "4e-05 m")),
        (Dragon(40), 1.0999, "margin", ("must be smaller, got 1.0999 m", "nearer than that", "1.1 m apart")),
        (listed(0.7999999), 0.0, "dragon.overhangs.0", ("must be smaller, got 0.2 m + 0.7999999 m",)),
    ],
)
def test_benches_that_are_hardly_apart_on_a_straight_line_are_refused_by_what_keeps_them_apart(
    dragon: Dragon, margin: float, field: str, words: tuple[str, ...]
) -> None:
    """Their inner corners lean to each other on the widest spiral allowed: no circle mends that."""
    with pytest.raises(InvalidValue) as refused:
        minimum_pitch(dragon, turning_radius=1000.0, margin=margin)
    assert refused.value.field == field
    assert all(word in refused.value.message for word in words)
    assert "straight line" in refused.value.message
    assert SlowWay.of(dragon, WIDEST, 16.0, 1.0).least() <= margin


def test_benches_nearly_apart_on_a_straight_line_need_a_wide_spiral() -> None:
    """3 mm are left on the line: the corners of benches lean that far inwards up to a pitch of 1,400 m."""
    dragon = Dragon(8, 2.0, 2.0, 0.3, 0.49925)
    result = minimum_pitch(dragon, turning_radius=2.0, start_turns=3.0)
    assert (result.limited_by, result.justified_by, result.proven_up_to) == (LimitedBy.CIRCLE, "bound", None)
    low, high = result.pitch_bracket
    assert high - low <= WIDE_BRACKET * high
    beside = WIDE_BRACKET * high
    assert SlowWay.of(dragon, low - beside, 3.0, 2.0).least() < 0.0
    for pitch in np.geomspace(high + beside, WIDEST, 6):
        assert SlowWay.of(dragon, pitch, 3.0, 2.0).least() > 0.0


def test_a_start_so_far_in_that_no_pitch_lies_outside_the_circle_is_refused_by_name() -> None:
    with pytest.raises(
        InvalidValue, match=r"start_turns must be at least 0\.00045 turns.*got 0\.0001 turns"
    ) as refused:
        minimum_pitch(Dragon(), start_turns=1e-4)
    assert refused.value.field == "start_turns"


def test_a_start_inside_a_graze_passes_it_and_names_the_pair_that_repeats_it() -> None:
    """All benches alike: what 0 and 9 would meet before the start, 1 and 10 meet after it, at the same pitch."""
    dragon, margin = Dragon(50, 2.4, 2.4, 0.13, 0.042), 0.343
    inside, before = (
        minimum_pitch(dragon, turning_radius=2.64, start_turns=turns, margin=margin) for turns in (4.06, 12.0)
    )
    assert (before.benches, inside.benches) == ((0, 9), (1, 10))
    assert inside.pitch == pytest.approx(before.pitch, rel=0, abs=ACCURACY)
    assert inside.head_radius < inside.pitch * 4.06 < before.head_radius
    for result, turns in ((inside, 4.06), (before, 12.0)):
        dance = SlowDance.of(dragon, Spiral(result.pitch, turns))
        theta = result.head_radius / dance.growth
        there = float(dance.way - dance.growth * 0.5 * (theta * np.sqrt(1 + theta**2) + np.arcsinh(theta)))
        assert dance.pair_gap(there, result.benches) == pytest.approx(margin, rel=0, abs=ACCURACY)


@pytest.mark.parametrize("radius", [6.8, 7.0, 50.0])
def test_a_wide_circle_is_limited_by_the_start(radius: float) -> None:
    """There the dance would begin inside the circle before any benches touch."""
    result = minimum_pitch(Dragon(), turning_radius=radius)
    assert result.pitch == radius / 16.0
    assert (result.limited_by, result.benches, result.head_radius) == (LimitedBy.START, None, None)
    assert result.other_feasible_intervals == ()


@pytest.mark.parametrize("benches", [1, 2])
def test_benches_that_cannot_touch_are_limited_by_the_start(benches: int) -> None:
    result = minimum_pitch(Dragon(benches), turning_radius=4.5)
    assert (result.pitch, result.limited_by) == (4.5 / 16.0, LimitedBy.START)


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("turning_radius", 0.0),
        ("turning_radius", -4.5),
        ("turning_radius", float("nan")),
        ("turning_radius", 1.1e4),
        ("turning_radius", "4.5"),
        ("start_turns", 0.0),
        ("start_turns", 1e-4),
        ("start_turns", float("inf")),
        ("margin", -0.01),
        ("margin", 1.1e4),
    ],
)
def test_a_value_beyond_its_limits_is_refused_by_name(name: str, value: object) -> None:
    with pytest.raises(InvalidValue) as refused:
        minimum_pitch(Dragon(5), **{name: value})  # type: ignore[arg-type]
    assert refused.value.field == name


# Benches of millimetres, 30 cm wide: those beside the head's neighbour touch unless the spiral is nearly straight.
TINY = {"body_length": 0.00390625, "head_length": 1.0, "overhang": 0.0}


@pytest.mark.parametrize(
    "dragon",
    [
        pytest.param(Dragon(20, **TINY), id="4 mm", marks=pytest.mark.deep),
        pytest.param(Dragon(8, body_length=0.001, overhang=0.0), id="1 mm"),
    ],
)
def test_tiny_benches_on_wide_spirals_are_answered(dragon: Dragon) -> None:
    """Ways that begin kilometres further out than anything can touch took 1.4 s each, 30 minutes in all.

    Of benches of 1 mm rounding hides where the contact begins, so there was no answer.
    """
    result = minimum_pitch(dragon)
    assert (result.limited_by, result.benches, result.head_radius) == (LimitedBy.CIRCLE, (0, 2), 4.5)
    assert result.pitch - result.pitch_bracket[0] <= WIDE_BRACKET * result.pitch
    low, high = (SlowWay.of(dragon, pitch, 16.0, 4.5).least() for pitch in result.pitch_bracket)
    assert low < 0.0 < high


def test_work_that_ends_before_the_minimum_pitch_is_found_is_an_error(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(core.design.ways, "PITCH_WORK", 4e5)
    with pytest.raises(TooMuchWork) as caught:
        minimum_pitch(Dragon(body_length=0.001, overhang=0.0))
    assert caught.value.field == "dragon.body_length"
    assert "400000 steps of work" in caught.value.message
    assert "the shortest of 223 chords is 0.001 m long" in caught.value.message
    assert "must be larger, or benches fewer, got 0.001 m: " in caught.value.message


def test_just_above_the_infeasible_end_of_a_bracket_a_pitch_is_feasible() -> None:
    """The proven bands end 9e-12 m above it."""
    dragon, radius, turns, margin = random_case(382)
    low, high = minimum_pitch(dragon, turning_radius=radius, start_turns=turns, margin=margin).pitch_bracket
    assert low + CLOSELY < high
    assert not is_feasible(dragon, low, radius, turns, margin)
    assert is_feasible(dragon, low + CLOSELY, radius, turns, margin)


@pytest.mark.parametrize("seed", some([27, 62], 1))
def test_a_contact_on_the_circle_of_a_wide_spiral_is_claimed_there(seed: int) -> None:
    """Rounding hides a contact 1e-11 m of pitch below the border; the pair approaches on the whole way."""
    dragon, radius, turns, margin = random_case(seed)
    result = minimum_pitch(dragon, turning_radius=radius, start_turns=turns, margin=margin)
    assert (result.limited_by, result.head_radius) == (LimitedBy.CIRCLE, radius)
    way = SlowWay.of(dragon, result.pitch, turns, radius)
    assert way.least() == pytest.approx(margin, abs=ACCURACY)
