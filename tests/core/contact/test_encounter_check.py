"""The four engines' verdict on a whole scene."""

from dataclasses import replace

import pytest

from core import Dance, Dragon, Engine, Part, Performance, Spiral, Verdict, encounter_check, first_encounter
from tests.support.reference_encounters import CASES, performance_of

STREETS = performance_of(CASES["streets that cross, both at once"])


def test_other_benches_that_meet_at_the_same_time_are_named():
    met = first_encounter(performance_of(CASES["two dragons in one spiral, opposite"]), start=1.0)
    check = encounter_check(met)
    assert check.agree
    assert set(check.engines.values()) == {Verdict(before=False, after=True)}
    # Half a turn apart everything happens twice.
    assert {met.benches, check.together[0][1]} == {(3, 0), (0, 3)}
    assert [len(judged) for judged in check.judged] == [60, 60]


def test_what_a_dragon_does_by_itself_does_not_count():
    # The first dragon overlaps itself long before the second one comes.
    tight = Part(Dance(Dragon(40), Spiral(0.45, 6.0)))
    other = Part(Dance(Dragon(3), Spiral(1.5, 6.0, (6.0, 0.0)), 1.5))
    assert encounter_check(first_encounter(Performance([tight, other]))).agree


@pytest.mark.parametrize("shift", [-1e-3, 1e-3])
def test_an_encounter_at_another_time_is_not_confirmed(shift):
    met = first_encounter(STREETS, start=51.0)
    bracket = tuple(end + shift for end in met.time_bracket)
    assert not encounter_check(replace(met, time_bracket=bracket)).agree


def test_a_margin_leaves_the_angle_sum_out_and_no_encounter_has_no_check():
    check = encounter_check(first_encounter(STREETS, start=51.0, margin=0.2))
    assert (check.agree, check.left_out) == (True, (Engine.ANGLE_SUM,))
    assert encounter_check(first_encounter(STREETS, start=51.0, stop=60.0)) is None
