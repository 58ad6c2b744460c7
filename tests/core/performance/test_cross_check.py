"""The four engines' verdict on a whole scene."""

from __future__ import annotations

from dataclasses import replace

import pytest

from core import Dance, Dragon, Engine, Part, Performance, Spiral, Verdict, encounter_check, first_encounter
from tests.support.reference_encounters import CASES, performance_of


def test_other_benches_that_meet_at_the_same_time_are_named() -> None:
    met = first_encounter(performance_of(CASES["two dragons in one spiral, opposite"]), start=1.0)
    check = encounter_check(met)
    assert check is not None
    assert check.agree
    assert set(check.engines.values()) == {Verdict(before=False, after=True)}
    # Half a turn apart everything happens twice.
    assert {met.benches, check.together[0][1]} == {(3, 0), (0, 3)}
    assert [len(judged) for judged in check.judged] == [60, 60]
    assert repr(check) == "<EncounterCheck: 4 engines agree on 120 benches>"


def test_what_a_dragon_does_by_itself_does_not_count() -> None:
    # The first dragon overlaps itself long before the second one comes.
    tight = Part(Dance(Dragon(40), Spiral(0.45, 6.0)))
    other = Part(Dance(Dragon(3), Spiral(1.5, 6.0, (6.0, 0.0)), 1.5))
    met = first_encounter(Performance([tight, other]))
    check = encounter_check(met)
    assert check is not None
    assert check.agree


@pytest.mark.parametrize("shift", [-1e-3, 1e-3])
def test_an_encounter_at_another_time_is_not_confirmed(shift: float) -> None:
    met = first_encounter(performance_of(CASES["streets that cross, both at once"]), start=51.0)
    low, high = met.time_bracket or (0.0, 0.0)
    check = encounter_check(replace(met, time_bracket=(low + shift, high + shift)))
    assert check is not None
    assert not check.agree


def test_a_margin_leaves_the_angle_sum_out_and_no_encounter_has_no_check() -> None:
    performance = performance_of(CASES["streets that cross, both at once"])
    check = encounter_check(first_encounter(performance, start=51.0, margin=0.2))
    assert check is not None
    assert check.agree
    assert check.left_out == (Engine.ANGLE_SUM,)
    assert encounter_check(first_encounter(performance, start=51.0, stop=60.0)) is None
