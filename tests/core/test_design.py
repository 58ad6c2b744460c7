"""Minimum pitch: against the reference, against first contact on many pitches, at the edges."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from core import Dragon, InvalidValue, LimitedBy, MinimumPitch, Outcome, Spiral, first_contact, minimum_pitch
from tests.core.slow_search import SlowDance

CASES = json.loads((Path(__file__).parents[1] / "reference" / "minimum_pitch.json").read_text())["cases"]
# Pitches are promised to this [m].
ACCURACY = 1e-9
# Within this of its minimum a pitch is neither surely feasible nor surely not [m].
BESIDE = 1e-8


def is_feasible(dragon: Dragon, pitch: float, radius: float, turns: float, margin: float) -> bool:
    """Does first_contact() let the head reach the circle?"""
    if pitch * turns <= radius:
        return False
    try:
        found = first_contact(dragon, Spiral(pitch, turns), margin=margin)
    except InvalidValue:  # it folds at the start
        return False
    if found.outcome is Outcome.CLEAR:
        return found.end.theta * pitch / (2 * np.pi) <= radius
    return found.outcome is Outcome.CONTACT and found.head.radius <= radius


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
    found = answers[case["name"]]
    assert found.pitch == pytest.approx(case["pitch"], rel=0, abs=ACCURACY)
    assert found.limited_by == case["limited_by"]
    assert found.pitch_bracket[0] <= case["pitch"] + ACCURACY
    assert found.pitch_bracket[1] - found.pitch_bracket[0] <= ACCURACY
    if "benches" in case:
        assert list(found.benches) == case["benches"]
    if "head_radius" in case:
        assert found.head_radius == pytest.approx(case["head_radius"], rel=0, abs=1e-6)
    assert len(found.other_feasible_intervals) == len(case["other_feasible_intervals"])
    for ours, theirs in zip(found.other_feasible_intervals, case["other_feasible_intervals"], strict=True):
        np.testing.assert_allclose(ours, theirs, rtol=0, atol=ACCURACY)


@pytest.mark.parametrize("case", CASES, ids=[case["name"] for case in CASES])
def test_random_pitches_above_are_feasible_and_the_one_below_is_not(
    case: dict[str, Any], answers: dict[str, MinimumPitch]
) -> None:
    found = answers[case["name"]]
    dragon, radius, turns = Dragon(**case["dragon"]), case["turning_diameter"] / 2, case["start_turns"]
    margin = case.get("margin", 0.0)
    above = found.pitch + np.geomspace(BESIDE, 5.0, 60) * np.random.default_rng(7).uniform(0.5, 1.0, 60)
    assert [pitch for pitch in above if not is_feasible(dragon, pitch, radius, turns, margin)] == []
    assert not is_feasible(dragon, found.pitch - BESIDE, radius, turns, margin)


@pytest.mark.parametrize("case", CASES, ids=[case["name"] for case in CASES])
def test_below_the_answer_only_the_islands_are_feasible(case: dict[str, Any], answers: dict[str, MinimumPitch]) -> None:
    found = answers[case["name"]]
    dragon, radius, turns = Dragon(**case["dragon"]), case["turning_diameter"] / 2, case["start_turns"]
    islands = found.other_feasible_intervals
    for pitch in np.random.default_rng(8).uniform(radius / turns, found.pitch, 40):
        inside = any(low + BESIDE <= pitch <= high - BESIDE for low, high in islands)
        near = any(low - BESIDE <= pitch <= high + BESIDE for low, high in islands)
        feasible = is_feasible(dragon, pitch, radius, turns, case.get("margin", 0.0))
        assert inside <= feasible <= near


@pytest.mark.parametrize("radius", [2.5, 3.3, 4.1, 5.2])
@pytest.mark.parametrize("margin", [0.0, 0.05])
def test_the_least_separation_at_the_answer_is_the_margin(radius: float, margin: float) -> None:
    """Of a slow dance near where the head is said to be, distances by shapely."""
    found = minimum_pitch(Dragon(60), turning_radius=radius, margin=margin, start_turns=14.0)
    assert found.head_radius is not None
    dance = SlowDance.of(Dragon(60), Spiral(found.pitch, 14.0))
    theta = found.head_radius / dance.growth
    there = float(dance.way - dance.growth * 0.5 * (theta * np.sqrt(1 + theta**2) + np.arcsinh(theta)))
    if found.limited_by is LimitedBy.CIRCLE:
        assert found.head_radius == pytest.approx(radius, rel=0, abs=ACCURACY)
        least = dance.pair_gap(there, found.benches)
    else:
        assert found.limited_by is LimitedBy.GRAZE
        assert found.head_radius > radius
        least = dance.dip(there - 0.02, there + 0.02, found.benches)[1]
    assert least == pytest.approx(margin, rel=0, abs=ACCURACY)


@settings(max_examples=4, deadline=None)
@given(st.floats(2.5, 5.0), st.floats(0.01, 0.3))
def test_a_margin_or_a_tighter_circle_never_needs_a_smaller_pitch(radius: float, more: float) -> None:
    dragon = Dragon(40)
    plain = minimum_pitch(dragon, turning_radius=radius, start_turns=14.0).pitch
    assert minimum_pitch(dragon, turning_radius=radius, start_turns=14.0, margin=more).pitch >= plain - ACCURACY
    assert minimum_pitch(dragon, turning_radius=radius - more, start_turns=14.0).pitch >= plain - ACCURACY


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
    """At once around less than a turn, with benches nearly as wide as the circle, so that no ring bound holds."""
    dragon = Dragon(6, 1.21, 0.93, 0.61, 0.0)
    found = minimum_pitch(dragon, turning_radius=1.32, start_turns=10.0, margin=0.29)
    assert found.pitch == 1.32 / 10.0
    assert (found.limited_by, found.justified_by) == (LimitedBy.START, "bound")
    assert found.proven_up_to > 1.0
    for pitch in np.linspace(found.pitch + BESIDE, found.proven_up_to, 20):
        assert is_feasible(dragon, pitch, 1.32, 10.0, 0.29)


def test_where_benches_are_bent_too_much_for_a_bound_a_scan_is_said() -> None:
    found = minimum_pitch(Dragon(20), turning_radius=1.5, start_turns=12.0)
    assert (found.justified_by, found.limited_by) == ("scan", LimitedBy.CIRCLE)
    assert found.scan_step is not None
    assert is_feasible(Dragon(20), found.pitch + BESIDE, 1.5, 12.0, 0.0)
    assert not is_feasible(Dragon(20), found.pitch - BESIDE, 1.5, 12.0, 0.0)


def test_a_start_inside_a_graze_passes_it_and_names_the_pair_that_repeats_it() -> None:
    """All benches alike: what 0 and 9 would meet before the start, 1 and 10 meet after it, at the same pitch."""
    dragon, margin = Dragon(50, 2.4, 2.4, 0.13, 0.042), 0.343
    inside, before = (
        minimum_pitch(dragon, turning_radius=2.64, start_turns=turns, margin=margin) for turns in (4.06, 12.0)
    )
    assert (before.benches, inside.benches) == ((0, 9), (1, 10))
    assert inside.pitch == pytest.approx(before.pitch, rel=0, abs=ACCURACY)
    assert inside.head_radius < inside.pitch * 4.06 < before.head_radius
    for found, turns in ((inside, 4.06), (before, 12.0)):
        dance = SlowDance.of(dragon, Spiral(found.pitch, turns))
        theta = found.head_radius / dance.growth
        there = float(dance.way - dance.growth * 0.5 * (theta * np.sqrt(1 + theta**2) + np.arcsinh(theta)))
        assert dance.pair_gap(there, found.benches) == pytest.approx(margin, rel=0, abs=ACCURACY)


@pytest.mark.parametrize("radius", [6.8, 7.0, 50.0])
def test_a_wide_circle_is_limited_by_the_start(radius: float) -> None:
    """There the dance would begin inside the circle before any benches touch."""
    found = minimum_pitch(Dragon(), turning_radius=radius)
    assert found.pitch == radius / 16.0
    assert (found.limited_by, found.benches, found.head_radius) == (LimitedBy.START, None, None)
    assert found.other_feasible_intervals == ()


@pytest.mark.parametrize("benches", [1, 2])
def test_benches_that_cannot_touch_are_limited_by_the_start(benches: int) -> None:
    found = minimum_pitch(Dragon(benches), turning_radius=4.5)
    assert (found.pitch, found.limited_by) == (4.5 / 16.0, LimitedBy.START)


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
