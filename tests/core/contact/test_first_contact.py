"""First contact: against the reference, against a slow search that shares no code, at grazes, at the edges."""

from functools import cache

import pytest

from core import (
    Dance,
    Dragon,
    FailureKind,
    Judgement,
    Outcome,
    Spiral,
    Turn,
    check,
    first_contact,
    least_clearance,
    minimum_pitch,
    quick_check,
)
from core.claims.claim import ClaimKind
from core.contact.search import MARGIN_MAX
from core.design.pitch_bands import BORDER_WIDTH
from tests.campaigns.hunt_contacts import SlowLook, judged
from tests.support.depth import thorough
from tests.support.near import assert_near
from tests.support.reference import reference_cases
from tests.support.slow_search import RUN, SlowDance

CASES = reference_cases("first_contact")
# Times are promised to this [s] and places to what the head moves meanwhile [m].
ACCURACY = 1e-9
# Rounding of a separation at some ten metres from the centre [m].
ROUNDING = 1e-13
# Half width of the window around a graze in which the slow search looks for its bottom [s].
AROUND = 0.1


def assert_bracketed(contact):
    clear, within = contact.time_bracket
    assert within - ACCURACY <= clear <= contact.time <= within


@pytest.mark.uncompiled
@pytest.mark.parametrize("name", CASES)
def test_every_case_of_the_reference_is_met(name):
    case = CASES[name]
    dance = Dance(Dragon(**case["dragon"]), Spiral(case["pitch"], case["start_turns"]), case["head_speed"])
    contact = first_contact(dance)
    if fold := case.get("fold_time"):
        assert_near(dance.end.time, fold, 1e-9)
    assert contact.outcome == case["outcome"]
    if contact.outcome is Outcome.CONTACT:
        result = contact.time, contact.head.theta, contact.head.radius, *contact.point
        assert_near(result, [case["time"], case["head_theta"], case["head_radius"], *case["point"]], ACCURACY)
        assert list(contact.benches) == case["benches"]
        assert (contact.corner.bench, contact.corner.name) == tuple(case["corner"].values())
        assert (contact.edge.bench, contact.edge.name) == tuple(case["edge"].values())
        assert_bracketed(contact)
        assert contact.end is None
    elif contact.outcome is Outcome.CLEAR:
        assert (contact.time, contact.time_bracket, contact.benches, contact.gap) == (None, None, None, None)
        assert contact.certificate.clear_until == contact.end.time


# Start inside the region in which rings can touch: pairs far down the body are met before the body repeats itself.
@pytest.mark.parametrize(
    "dance",
    [
        Dance(Dragon(8, 1.0, 2.0, 0.1, 0.1), Spiral(0.9, 1.4)),
        Dance(Dragon(3, 1.0, 1.0, 0.1, 0.4), Spiral(2.0, 5.0)),
        Dance(Dragon(), Spiral(0.35)),
    ],
    ids=["one-turn", "overhangs-that-cross", "overlapping"],
)
def test_a_start_near_the_centre_is_searched_with_all_pairs(dance):
    """Other random dances: tests/core/test_hunts.py."""
    slow = SlowDance.of(dance.dragon, dance.path)
    look = SlowLook(slow, 0.0, RUN * min(slow.end(), dance.end.time))
    assert judged(dance, 0.0, 0.0, None, look)[1] == ""


# -- grazes: pitches at which a dip of the clearance just reaches the margin, so that the time of contact jumps --


@pytest.mark.parametrize(
    "dragon, path, margin",
    [(Dragon(), Spiral(0.4504), 0.0), *thorough((Dragon(40), Spiral(0.51, 10.0), 0.05))],
)
def test_a_graze_is_met_with_a_larger_margin_and_passed_with_a_smaller_one(dragon, path, margin):
    dance = Dance(dragon, path)
    graze = first_contact(dance, margin=margin).certificate.least_clearance
    bottom, least = SlowDance.of(dragon, path).dip(graze.time - AROUND, graze.time + AROUND, graze.benches)
    assert_near(graze.clearance, least, ROUNDING)
    assert_near(graze.time, bottom, 1e-5)
    spare = graze.clearance - margin
    met, passed = (first_contact(dance, margin=margin + part * spare) for part in (1.001, 0.999))
    assert met.outcome == Outcome.CONTACT
    assert met.benches == graze.benches
    assert met.time - graze.time < AROUND < (passed.time or passed.end.time) - graze.time


@cache
def undecided_dance():
    """Benches 0 and 19 graze to the last digits, and others overlap some seconds later."""
    return Dance(Dragon(60), Spiral(minimum_pitch(Dragon(60)).pitch_bracket[1] - BORDER_WIDTH))


def test_an_undecided_contact_names_the_pair_that_surely_overlaps_and_carries_no_bound():
    dance = undecided_dance()
    contact = first_contact(dance)
    least = least_clearance(dance)
    assert (contact.outcome, contact.time, contact.benches) == (Outcome.UNDECIDED, None, None)
    claim = contact.certificate.claim
    assert claim.kind == ClaimKind.UNDECIDED
    assert claim.benches == contact.overlapping
    assert (claim.clear_until, claim.time) == contact.time_bracket
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
    assert least.distance == 0.0
    assert least.at_least is None
    assert slow.pair_gap(least.time + 1e-6, least.benches) < 0.0


SLOW = Dragon(20, 1.2, 1.2, 0.8, 0.25)


@pytest.mark.parametrize("start", [-194.0, -15.0, -12.1])
def test_a_slow_contact_before_time_zero_is_decided_as_the_same_one_after_it(start):
    """On the way in a turn is the spiral from the same turns; the benches close by 4 mm per metre."""
    turn = Dance(SLOW, Turn(1.0, 1.5, start_turns=8.0))
    spiral = Dance(SLOW, Spiral(1.0, 8.0))
    later = first_contact(spiral)
    contact = first_contact(turn, start=start)
    least = least_clearance(turn, start=start)
    assert later.outcome == Outcome.CONTACT
    assert contact.outcome == Outcome.CONTACT
    assert_bracketed(contact)
    assert_near([contact.time, least.time], [later.time + turn.begin] * 2, ACCURACY)
    assert contact.benches == later.benches
    assert (least.distance, least.at_least, least.benches) == (0.0, 0.0, contact.benches)


@pytest.mark.parametrize("judge", [check, quick_check])
def test_a_contact_that_is_certain_but_perhaps_not_the_first_fails(judge):
    dance = undecided_dance()
    contact = first_contact(dance, start=dance.begin)
    report = judge(dance)
    failure = report.failures[0]
    assert report.verdict is Judgement.FAILS
    assert failure.kind == FailureKind.CONTACT
    assert failure.benches == contact.overlapping
    assert failure.time == contact.time_bracket[1]
    assert failure.time_bracket == contact.time_bracket
    assert_near(report.stop, failure.time, ACCURACY)
    assert "at the latest; up to 216." in failure.message


def test_without_a_certain_contact_an_undecided_search_stays_undecided():
    dance = undecided_dance()
    stop = first_contact(dance).time_bracket[0] + 1.0
    contact = first_contact(dance, stop=stop)
    report = check(dance, stop=stop)
    assert (contact.outcome, contact.overlapping, contact.time_bracket[1]) == (Outcome.UNDECIDED, None, stop)
    assert report.verdict is Judgement.UNDECIDED
    assert [failure.kind for failure in report.failures] == [FailureKind.UNDECIDED]
    assert report.least_clearance.at_least is None


# -- limits ----------------------------------------------------------------------------------------------


def test_the_largest_margin_is_accepted():
    assert first_contact(Dance(Dragon(5), Spiral()), margin=MARGIN_MAX).outcome is Outcome.CONTACT_AT_START
