"""Four engines on the whole dragon around a contact: they confirm found contacts, and no forged ones."""

import math
from dataclasses import replace

import numpy as np
import pytest

from core import Dance, Dragon, Outcome, Spiral, bench_poses, first_contact, trajectory
from core.contact.cross_check import (
    CHECK_TRAVEL,
    CLOSE_MAX,
    TOGETHER_DEPTH,
    WHOLE_BENCHES,
    contact_check,
    judged_benches,
    judged_contact,
)
from core.shapes.engines import Engine
from core.shapes.overlaps import Verdict
from tests.campaigns.hunt_contacts import random_dragon
from tests.support.depth import examples
from tests.support.scenes import lengths_and_widths, unlinked_pairs

EXACT = (Engine.SEPARATING_AXIS, Engine.FCL, Engine.SHAPELY)
AS_REPORTED, NEVER, ALWAYS = (Verdict(before=a, after=b) for a, b in ((False, True), (False, False), (True, True)))
AT_ONCE = Verdict(before=None, after=True)
DRAGON = Dragon()
DANCE = Dance(DRAGON, Spiral())
# Difference of a wrong time from that of first contact [s]; far above CHECK_TRAVEL.
WRONG = 1e-4

as_dragon_and_pair = pytest.mark.parametrize("whole", [True, False], ids=["dragon", "pair"])


@pytest.fixture(scope="module")
def contact():
    return first_contact(DANCE)


def poses_around(contact, travel):
    """Poses before and after a contact, of that travel of the head each."""
    step = travel / contact.dance.head_speed
    return bench_poses(trajectory(contact.dance, [contact.time - step, contact.time + step]).position)


def moved(contact, shift):
    """A contact that is claimed so much later than it is [s]."""
    low, high = contact.time_bracket
    return replace(contact, time=low + shift, time_bracket=(low + shift, high + shift))


def assert_judged(check, agree, verdict, engines=Engine):
    """These engines, and no others, all find this, and agree or not with what is claimed."""
    assert check.agree == agree
    assert check.engines == dict.fromkeys(engines, verdict)


# -- what is true ---------------------------------------------------------------------------------------------


def test_the_whole_dragon_is_as_reported_on_random_dragons():
    random = np.random.default_rng(1)
    checked = 0
    for _ in range(examples(20, 200)):
        dragon = random_dragon(random)
        pitch = dragon.widths.max() + random.uniform(0.1, 0.4)
        path = Spiral(pitch, random.uniform(5.0, 9.0) / pitch)
        margin = random.choice([0.0, 0.0, 0.03])
        head_speed = random.choice([0.01, 1.0, 5.0])
        contact = first_contact(Dance(dragon, path, head_speed), margin=margin)
        check = contact_check(contact)
        if check is None:
            assert contact.outcome is Outcome.CLEAR
            continue
        assert check.judged == tuple(range(dragon.benches))
        assert check.left_out == ((Engine.ANGLE_SUM,) if margin else ())
        if contact.outcome is Outcome.CONTACT_AT_START:
            assert all(check.engines[engine] == AT_ONCE for engine in EXACT)
            continue
        assert check.agree, (dragon, path, margin, check)
        before, after = poses_around(contact, 2.0 * CHECK_TRAVEL)
        assert unlinked_pairs(before, lengths_and_widths(dragon), margin) == set()
        assert unlinked_pairs(after, lengths_and_widths(dragon), margin) == {contact.benches, *check.together}
        checked += 1
    assert checked > examples(6, 60)


def test_a_start_in_the_middle_of_a_contact_is_judged_there(contact):
    result = first_contact(DANCE, start=contact.time + 0.5)
    assert result.outcome is Outcome.CONTACT_AT_START
    assert contact_check(result).agree
    # The whole dance has an earlier contact, so the claim of a first one must fail the check.
    forged = contact_check(replace(result, outcome=Outcome.CONTACT))
    assert all(verdict.before for verdict in forged.engines.values())
    assert not forged.agree


# -- what is forged -------------------------------------------------------------------------------------------


@as_dragon_and_pair
@pytest.mark.parametrize(
    "shift, benches, verdict",
    [(0.0, (0, 9), NEVER), (-WRONG, (0, 8), NEVER), (WRONG, (0, 8), ALWAYS)],
    ids=["wrong pair", "too early", "too late"],
)
def test_a_wrong_pair_or_time_is_noticed_by_every_engine(contact, whole, shift, benches, verdict):
    assert_judged(contact_check(replace(moved(contact, shift), benches=benches), whole=whole), False, verdict)


@pytest.mark.parametrize(
    "instants, verdict",
    [([0], ALWAYS), ([1], NEVER), ([0, 1], Verdict(before=True, after=False))],
    ids=["before", "after", "both"],
)
@pytest.mark.parametrize("margin", [0.0, 0.02])
def test_a_third_bench_is_noticed_by_every_engine_but_not_by_the_pair_alone(instants, verdict, margin):
    contact = first_contact(DANCE, margin=margin)
    poses = poses_around(contact, CHECK_TRAVEL)
    poses[instants, 100] = poses[instants, 150] + [0.4, 0.05, 0.3]
    check, of_pair = (
        judged_contact(poses, lengths_and_widths(DRAGON), contact.benches, margin=margin, whole=whole)
        for whole in (True, False)
    )
    assert_judged(check, False, verdict, EXACT if margin else Engine)
    assert check.together == ()
    assert (of_pair.agree, of_pair.judged) == (True, contact.benches)


@pytest.mark.parametrize("deep, together", [(0.5, True), (2.0, False)], ids=["hardly", "deep"])
def test_a_pair_that_meets_at_the_same_instant_is_hardly_within_the_margin(deep, together):
    # four benches across two others: both pairs side by side, one of them deeper after than it can be by then
    apart = np.array([[0, 0, 0], [50, 9, 0], [0, 0.6, 0], [50, -9, 0], [20, 0, 0], [60, 9, 0], [20, 0.6, 0]], float)
    after = apart.copy()
    after[[2, 6], 1] = 0.5 - np.array([0.1, deep]) * TOGETHER_DEPTH
    check = judged_contact(np.array([apart, after]), np.tile([2.0, 0.5], (7, 1)), (0, 2))
    assert_judged(check, together, AS_REPORTED if together else NEVER)
    assert check.together == (((4, 6),) if together else ())


def test_an_engine_that_differs_makes_them_disagree():
    poses = np.array([[[0.0, 0.0, 0.0], [9.0, 9.0, 0.0], [0.0, y, math.pi / 2]] for y in (5.0, 0.0)])
    check = judged_contact(poses, np.tile([2.0, 0.3], (3, 1)), (0, 2))
    assert [engine for engine, verdict in check.engines.items() if verdict != AS_REPORTED] == [Engine.ANGLE_SUM]
    assert not check.agree


# -- whom the engines judge -----------------------------------------------------------------------------------


def test_of_too_crowded_benches_the_pair_alone_is_judged():
    most = (1 + math.isqrt(1 + 8 * CLOSE_MAX)) // 2
    for count, judged in ((most, most), (most + 1, 2)):
        assert len(judged_benches(np.zeros((count, 3)), np.ones((count, 2)), (0, 2), 0.0)) == judged


def test_benches_left_out_make_no_neighbours_of_those_beside_them():
    # In a long straight row only benches near the pair are judged. Bench 1 is far off: 0 and 2 stand side by side.
    count = WHOLE_BENCHES + 1
    poses = np.zeros((2, count, 3))
    poses[..., 0] = 100.0 * np.arange(count)
    poses[:, 2, :2] = [[0.0, 0.55], [0.0, 0.45]]
    check = judged_contact(poses, np.tile([2.0, 0.5], (count, 1)), (0, 2))
    assert 1 not in check.judged
    assert_judged(check, True, AS_REPORTED)


@as_dragon_and_pair
@pytest.mark.parametrize(
    "dance, left_out",
    [
        (Dance(Dragon(59, 3.48, 2.2, 0.08, 0.26), Spiral(0.21, 9.4)), (Engine.ANGLE_SUM,)),
        (Dance(Dragon(60), Spiral(0.25, 8.0)), ()),
    ],
)
def test_the_angle_sum_is_left_out_where_benches_cross_at_the_start_with_no_corner_inside(dance, left_out, whole):
    check = contact_check(first_contact(dance), whole=whole)
    assert_judged(check, True, AT_ONCE, check.engines)
    assert check.left_out == left_out


@pytest.mark.parametrize("stray, margin, wrong", [(0.02, 0.0, WRONG), (0.05, 0.03, 0.2)])
def test_with_a_stray_the_grounds_of_all_benches_are_judged(stray, margin, wrong):
    contact = first_contact(DANCE, margin=margin, stray=stray)
    check = contact_check(contact)
    assert_judged(check, True, AS_REPORTED, check.engines)
    assert len(check.judged) == DRAGON.benches
    for shift, verdict in ((-wrong, NEVER), (wrong, ALWAYS)):
        forged = contact_check(moved(contact, shift))
        assert forged.engines[Engine.SHAPELY] == verdict
        assert not forged.agree
    other = (contact.benches[0], contact.benches[1] + 1)
    assert not contact_check(replace(contact, benches=other)).agree
