"""Claims: those that do not hold are refused, and an overlap on the way is shown or not."""

import math

import pytest

from core import Dance, Dragon, Spiral
from core.errors import ProofRefused
from core.proof import prove_collision_time, prove_minimum_pitch, verify
from tests.support.depth import thorough
from tests.support.forgeries import assert_refused
from tests.support.reference_contacts import GRAZING, SMALL, graze, proof_of
from tests.support.refused import refused


@pytest.mark.parametrize("later", [-1.0, -2.1e-10, 2.1e-10, 1e-6, 1.0])
def test_a_bracket_moved_off_the_contact_is_refused(later):
    with pytest.raises(ProofRefused, match="no two benches overlap" if later < 0 else "benches 0 and 4 overlap"):
        proof_of(SMALL, later=later)


# At pitch 0.55 the benches part again from 415.02 to 415.375 s: a contact after that is not the first.
@pytest.mark.parametrize(
    "benches, time, reason",
    [
        (1, 100.0, "no two benches overlap"),
        (2, 100.0, "no two benches overlap"),
        (223, 433.0, "folds"),
        *thorough((20, 415.5, "benches 0 and 8 overlap")),
    ],
)
def test_a_time_that_is_not_the_first_at_which_two_touch_is_refused(benches, time, reason):
    with pytest.raises(ProofRefused, match=reason):
        prove_collision_time(Dance(Dragon(benches), Spiral()), time)


@pytest.mark.parametrize("time", [-1.0, math.nan, math.inf, 1e9, "412"])
def test_a_time_that_is_no_time_of_the_dance_is_an_invalid_value(time):
    with refused("time"):
        prove_collision_time(Dance(Dragon(), Spiral()), time)


@pytest.mark.parametrize(
    "margin, below, above",
    [
        (0.0, "overlap when handle 0", "free of contact too"),
        *thorough((0.1, "nearer than the margin", "keeps the margin")),
    ],
)
def test_a_minimum_pitch_is_proven_and_one_off_it_refused(margin, below, above):
    certificate = graze(margin)
    assert "says nothing of larger pitches" in verify(certificate).statement
    for more, reason in ((-1e-8, below), (1.1e-6, above)):
        with pytest.raises(ProofRefused, match=reason):
            prove_minimum_pitch(Dragon(14), certificate["claim"]["pitch"] + more, **GRAZING, margin=margin)


# Changes of a certificate of a graze, and why both checkers refuse them.
OF_GRAZE = [
    ('overlap = {"benches": [0, 12], "head_theta": 40.0}', "overlap.* on the way"),  # within the circle
    ('overlap = {"benches": [0, 12], "head_theta": 43.0}', "not shown to overlap"),
    ('overlap = {"benches": [0, 12], "head_theta": 44.5}', "overlap.* on the way"),  # before the start
    ('overlap = {"start_within_circle": true}', "not shown to lie within the circle|does not lie within it"),
]


@pytest.mark.parametrize("edit, reason", OF_GRAZE)
def test_a_forged_overlap_on_the_way_to_the_circle_is_refused(edit, reason):
    assert_refused(graze(), edit, reason)
