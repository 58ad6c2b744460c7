"""The largest stray that is safe: known bounds, benches held apart by the one between, benches that touch."""

import pytest

from core import Dance, Dragon, Legs, Outcome, Spiral, check, contact_check, first_contact, minimum_pitch, tolerance
from core.claims.claim import BenchBetween
from core.tolerance.curve import time_on_circle
from core.tolerance.safe import STRAY_MIN
from core.tolerance.tolerance import Limit
from tests.campaigns.adversaries import to_circle
from tests.core.test_breaches import BEND
from tests.core.tolerance.test_tolerance import BRACKET
from tests.support.near import assert_near

# pitch [m], a bound by hand and a contact found by hand [m], both sampled in time and rounded to 1e-5.
KNOWN = [(0.5, 0.02321, 0.02325), (0.55, 0.04654, 0.04668), (0.7, 0.11662, 0.11749), (1.0, 0.24298, 0.26305)]
ROUNDED = 2e-5
# Stray by the simple bound at each pitch [m], and the part of it by which that of the hulls may be smaller [1].
SIMPLE = {0.5: 0.01931, 0.55: 0.03874, 0.7: 0.09735, 1.0: 0.21590}
SIMPLE_SHORT = 1e-3


@pytest.mark.parametrize("pitch, bound, contact", KNOWN, ids=[f"{known[0]} m" for known in KNOWN])
def test_brackets_lie_between_the_bounds_and_the_contacts_known(pitch, bound, contact):
    dance, stop = to_circle(pitch)
    result = tolerance(dance, stop=stop)
    safe, touching = result.stray_bracket
    assert bound - ROUNDED < safe < touching < contact + ROUNDED
    assert touching < safe * (1.0 + BRACKET)
    assert result.limited_by is Limit.BENCHES
    assert result.independent == safe
    assert SIMPLE[pitch] * (1.0 - SIMPLE_SHORT) < result.simple < SIMPLE[pitch] + ROUNDED


@pytest.mark.parametrize("dance, stop, benches", [(*to_circle(0.42), None), (Dance(Dragon(), Spiral()), None, (0, 8))])
def test_where_benches_touch_as_they_are_nothing_is_called_safe(dance, stop, benches):
    result = tolerance(dance, stop=stop)
    assert result.stray == 0.0
    assert_near(result.time, first_contact(dance).time, 1e-6)
    assert benches in (None, result.benches)
    assert benches is None or result.stray_bracket[1] < 1e-6
    assert result.certificate.claim.touches


@pytest.mark.parametrize("above, known", [(1e-9, False), (3e-9, True)], ids=["1 nm", "3 nm"])
def test_a_stray_of_less_than_a_nanometre_counts_as_none(above, known):
    """The stray is about half of what the pitch exceeds the least one by."""
    dragon = Dragon(20)
    dance = Dance(dragon, Spiral(minimum_pitch(dragon, turning_radius=3.0, start_turns=8.0).pitch + above, 8.0))
    stray = tolerance(dance, stop=time_on_circle(dance, 3.0)).stray
    assert stray > STRAY_MIN if known else stray == 0.0


def test_on_the_way_to_a_fold_a_stray_that_is_safe_has_no_contact_either():
    """Benches 0 and 2 are nearest at the fold itself, and approach by 0.08 mm in the last micrometre of travel."""
    dance = Dance(Dragon(3, 1.54, 1.54, 0.14, 0.0), Spiral(0.445, 2.4))
    stray = tolerance(dance).stray
    assert stray > 0.0
    assert first_contact(dance, stray=stray).outcome is Outcome.CLEAR


def test_what_the_bench_between_holds_apart_is_no_failure_of_a_check():
    safe = tolerance(BEND)
    assert safe.independent < 0.55 < safe.stray
    report = check(BEND, stray=safe.stray)
    assert (report.passed, report.least_clearance) == (True, None)
    assert report.first_contact.certificate.claim.between is BenchBetween.HELD
    assert check(BEND, stray=safe.stray, margin=0.01).failures


def test_engines_agree_on_a_contact_beside_benches_that_are_held_apart():
    there_and_back = Legs([(-40, 0), (60, 0), (70, 10), (60, 20), (10, 1.9), (-40, 1.9)], [0], radius=5.0)
    contact = first_contact(Dance(Dragon(105), there_and_back), stray=0.7)
    assert contact.benches[1] > contact.benches[0] + 2
    assert contact.certificate.claim.between is BenchBetween.HELD
    assert contact_check(contact).agree
