"""Four engines on the whole dragon around a contact: they confirm found contacts, and no forged ones."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray

from core import Arc, Dance, Line, Route
from core.contact.answer import FirstContact, Outcome
from core.contact.cross_check import (
    CHECK_TRAVEL,
    CLOSE_MAX,
    TOGETHER_DEPTH,
    WHOLE_BENCHES,
    contact_check,
    judged_benches,
    judged_contact,
)
from core.contact.first_contact import first_contact
from core.dragon import Dragon
from core.motion.trajectory import trajectory
from core.paths.spiral import Spiral
from core.shapes.engines import Engine
from core.shapes.overlaps import Verdict, separation
from core.shapes.rectangles import bench_poses
from tests.support.depth import examples
from tests.support.scenes import unlinked_pairs

Floats = NDArray[np.float64]

EXACT = (Engine.SEPARATING_AXIS, Engine.FCL, Engine.SHAPELY)
AS_REPORTED = Verdict(before=False, after=True)
DRAGON, SPIRAL = Dragon(), Spiral()
# Difference of a wrong time from that of first contact [s]; far above CHECK_TRAVEL.
WRONG = 1e-4


@pytest.fixture(scope="module")
def contact() -> FirstContact:
    return first_contact(Dance(DRAGON, SPIRAL))


def sizes_of(dragon: Dragon) -> Floats:
    return np.stack([dragon.lengths, dragon.widths], axis=-1)


def poses_of(dragon: Dragon, path: Spiral | Route, times: list[float], head_speed: float = 1.0) -> Floats:
    return bench_poses(trajectory(Dance(dragon, path, head_speed), times).position)


def random_dragon(random: np.random.Generator) -> Dragon:
    count = int(random.integers(10, 60))
    if random.random() < 0.5:
        body = random.uniform(1.0, 2.5)
        return Dragon(count, body * random.uniform(0.8, 1.8), body, random.uniform(0.05, 0.3), 0.1 * body)
    lengths = random.uniform(1.0, 2.5, count)
    return Dragon.of(lengths, random.uniform(0.05, 0.25, count), lengths * random.uniform(0.0, 0.15, count))


# -- what is true ---------------------------------------------------------------------------------------------


@pytest.mark.parametrize("whole", [True, False], ids=["dragon", "pair"])
def test_all_engines_agree_on_the_default_dance(contact: FirstContact, whole: bool) -> None:
    check = contact_check(contact, whole=whole)
    assert check is not None
    assert check.agree
    assert check.judged == (tuple(range(223)) if whole else (0, 8))
    assert check.engines == dict.fromkeys(Engine, AS_REPORTED)
    assert (check.together, check.left_out) == ((), ())


def test_the_whole_dragon_is_as_reported_on_random_dragons() -> None:
    random = np.random.default_rng(1)
    checked = 0
    for _ in range(examples(60, 200)):
        dragon, path = random_dragon(random), Spiral(random.uniform(0.4, 0.7), random.uniform(8, 16))
        margin, head_speed = random.choice([0.0, 0.0, 0.03]), random.choice([0.01, 1.0, 5.0])
        contact = first_contact(Dance(dragon, path, head_speed), margin=margin)
        check = contact_check(contact)
        if check is None:
            assert contact.outcome is Outcome.CLEAR
            continue
        assert check.judged == tuple(range(dragon.benches))
        assert check.left_out == ((Engine.ANGLE_SUM,) if margin else ())
        if contact.outcome is Outcome.CONTACT_AT_START:
            assert all(check.engines[engine] == Verdict(before=None, after=True) for engine in EXACT)
            continue
        assert contact.time is not None
        assert check.agree, (dragon, path, margin, check)
        step = 2.0 * CHECK_TRAVEL / head_speed
        before, after = poses_of(dragon, path, [contact.time - step, contact.time + step], head_speed)
        assert unlinked_pairs(before, sizes_of(dragon), margin) == set()
        assert unlinked_pairs(after, sizes_of(dragon), margin) == {contact.benches, *check.together}
        checked += 1
    assert checked > examples(18, 60)


@pytest.mark.parametrize("whole", [True, False], ids=["dragon", "pair"])
def test_a_contact_at_the_start_has_no_before_and_may_have_others_beside_it(whole: bool) -> None:
    dragon, path = Dragon(60), Spiral(0.25, 8.0)
    contact = first_contact(Dance(dragon, path))
    assert (contact.outcome, contact.time) == (Outcome.CONTACT_AT_START, 0.0)
    check = contact_check(contact, whole=whole)
    assert check is not None
    assert check.agree
    assert check.engines == dict.fromkeys(Engine, Verdict(before=None, after=True))
    assert len(unlinked_pairs(poses_of(dragon, path, [0.0])[0], sizes_of(dragon))) > 1
    assert check.together == ()


def test_a_start_in_the_middle_of_a_contact_is_judged_there(contact: FirstContact) -> None:
    assert contact.time is not None
    result = first_contact(Dance(DRAGON, SPIRAL), start=contact.time + 0.5)
    assert result.outcome is Outcome.CONTACT_AT_START
    check = contact_check(result)
    assert check is not None
    assert check.agree
    # The whole dance has an earlier contact, so the claim of a first one must fail the check.
    forged = contact_check(replace(result, outcome=Outcome.CONTACT))
    assert forged is not None
    assert all(verdict.before for verdict in forged.engines.values())
    assert not forged.agree


def test_two_benches_of_a_straight_row_that_are_met_at_once_stand_together() -> None:
    # The head comes back across its own straight row and meets it where two benches overlap around their handle.
    path = Route((Line((0.0, 0.0), (100.0, 0.0)), Arc((100.0, 4.0), 4.0, -math.pi / 2, 1.5 * math.pi)))
    path = Route((*path.pieces, Line((96.0, 4.0), (96.0, -30.0))))
    met = []
    for overhang in (0.1, 0.2, 0.3, 0.4, 0.5):
        dragon = Dragon(40, 2.2, 2.2, 0.3, overhang)
        contact = first_contact(Dance(dragon, path), start=95.0)
        check = contact_check(contact)
        assert check is not None
        assert contact.benches is not None
        assert check.agree
        assert all(pair[0] == contact.benches[0] for pair in check.together)
        assert {abs(pair[1] - contact.benches[1]) for pair in check.together} <= {1}
        met.append(len(check.together))
    assert {0, 1} <= set(met)


def test_nothing_is_judged_where_nothing_touches() -> None:
    clear = first_contact(Dance(DRAGON, Spiral(0.8)))
    assert clear.outcome is Outcome.CLEAR
    assert contact_check(clear) is None


# -- what is forged -------------------------------------------------------------------------------------------


@pytest.mark.parametrize("whole", [True, False], ids=["dragon", "pair"])
def test_a_wrong_pair_is_noticed_by_every_engine(contact: FirstContact, whole: bool) -> None:
    check = contact_check(replace(contact, benches=(0, 9)), whole=whole)
    assert check is not None
    assert not check.agree
    assert check.engines == dict.fromkeys(Engine, Verdict(before=False, after=False))


@pytest.mark.parametrize(
    ("shift", "verdict"),
    [(-WRONG, Verdict(before=False, after=False)), (WRONG, Verdict(before=True, after=True))],
    ids=["too early", "too late"],
)
@pytest.mark.parametrize("whole", [True, False], ids=["dragon", "pair"])
def test_a_wrong_time_is_noticed_by_every_engine(
    contact: FirstContact, whole: bool, shift: float, verdict: Verdict
) -> None:
    assert contact.time_bracket is not None
    low, high = contact.time_bracket
    forged = replace(contact, time=low + shift, time_bracket=(low + shift, high + shift))
    check = contact_check(forged, whole=whole)
    assert check is not None
    assert not check.agree
    assert check.engines == dict.fromkeys(Engine, verdict)


@pytest.mark.parametrize("when", ["before", "after", "both"])
@pytest.mark.parametrize("margin", [0.0, 0.02])
def test_a_third_bench_is_noticed_by_every_engine_but_not_by_the_pair_alone(when: str, margin: float) -> None:
    contact = first_contact(Dance(DRAGON, SPIRAL), margin=margin)
    assert contact.time is not None
    assert contact.benches is not None
    poses = poses_of(DRAGON, SPIRAL, [contact.time - CHECK_TRAVEL, contact.time + CHECK_TRAVEL])
    moved = {"before": [0], "after": [1], "both": [0, 1]}[when]
    poses[moved, 100] = poses[moved, 150] + [0.4, 0.05, 0.3]
    check = judged_contact(poses, sizes_of(DRAGON), contact.benches, margin=margin)
    assert not check.agree
    assert check.together == ()
    wanted = Verdict(before=when != "after", after=when == "before")
    assert set(check.engines.values()) == {wanted}
    assert len(check.engines) == (3 if margin else 4)
    assert judged_contact(poses, sizes_of(DRAGON), contact.benches, margin=margin, whole=False).agree


@pytest.mark.parametrize(("deep", "together"), [(0.5, True), (2.0, False)], ids=["hardly", "deep"])
def test_a_pair_that_meets_at_the_same_instant_is_hardly_within_the_margin(deep: float, together: bool) -> None:
    # four benches across two others: both pairs side by side, one of them deeper after than it can be by then
    size = np.tile([2.0, 0.5], (7, 1))
    apart = np.array([[0, 0, 0], [50, 9, 0], [0, 0.6, 0], [50, -9, 0], [20, 0, 0], [60, 9, 0], [20, 0.6, 0]], float)
    after = apart.copy()
    after[2, 1] = 0.5 - 0.1 * TOGETHER_DEPTH
    after[6, 1] = 0.5 - deep * TOGETHER_DEPTH
    check = judged_contact(np.array([apart, after]), size, (0, 2))
    assert check.agree == together
    assert check.together == (((4, 6),) if together else ())
    assert set(check.engines.values()) == {Verdict(before=False, after=together)}


def test_an_engine_that_differs_makes_them_disagree() -> None:
    size = np.array([[2.0, 0.3], [2.0, 0.3], [2.0, 0.3]])
    before = np.array([[0.0, 0.0, 0.0], [9.0, 9.0, 0.0], [0.0, 5.0, math.pi / 2]])
    crossed = np.array([[0.0, 0.0, 0.0], [9.0, 9.0, 0.0], [0.0, 0.0, math.pi / 2]])
    check = judged_contact(np.array([before, crossed]), size, (0, 2))
    assert [engine for engine, verdict in check.engines.items() if verdict != AS_REPORTED] == [Engine.ANGLE_SUM]
    assert not check.agree


# -- whom the engines judge -----------------------------------------------------------------------------------


@pytest.mark.parametrize(("benches", "judged"), [(WHOLE_BENCHES, WHOLE_BENCHES), (WHOLE_BENCHES + 1, 119)])
def test_of_a_longer_dragon_those_near_the_pair_are_judged(benches: int, judged: int) -> None:
    dragon = Dragon(benches)
    check = contact_check(first_contact(Dance(dragon, SPIRAL)))
    assert check is not None
    assert check.agree
    assert len(check.judged) == judged
    assert {0, 8} < set(check.judged)


def test_near_are_all_that_touch_one_of_the_pair() -> None:
    random = np.random.default_rng(3)
    count = WHOLE_BENCHES + 500
    pose = np.stack([*random.uniform(0.0, 60.0, (2, count)), random.uniform(-4.0, 4.0, count)], axis=-1)
    size = np.stack([random.uniform(0.5, 3.0, count), random.uniform(0.1, 0.5, count)], axis=-1)
    judged = judged_benches(pose, size, (7, 1500), 0.1)
    assert len(judged) < count
    gaps = separation(pose[[7, 1500], None], size[[7, 1500], None], pose[None], size[None]).separation
    assert set(np.flatnonzero((gaps <= 0.1).any(axis=0)).tolist()) <= set(judged.tolist())


def test_of_too_crowded_benches_the_pair_alone_is_judged() -> None:
    most = (1 + math.isqrt(1 + 8 * CLOSE_MAX)) // 2
    for count, judged in ((most, most), (most + 1, 2)):
        crowd = np.zeros((count, 3))
        assert len(judged_benches(crowd, np.ones((count, 2)), (0, 2), 0.0)) == judged
    check = judged_contact(np.zeros((2, most + 1, 3)), np.ones((most + 1, 2)), (0, 2), at_start=True)
    assert check.judged == (0, 2)
    assert check.agree


def test_benches_left_out_make_no_neighbours_of_those_beside_them() -> None:
    # In a long straight row only benches near the pair are judged. Bench 1 is far off: 0 and 2 stand side by side.
    count = WHOLE_BENCHES + 1
    pose = np.zeros((count, 3))
    pose[:, 0] = 100.0 * np.arange(count)
    pose[2, :2] = [0.0, 0.45]
    size = np.tile([2.0, 0.5], (count, 1))
    before = pose.copy()
    before[2, 1] = 0.55
    check = judged_contact(np.array([before, pose]), size, (0, 2))
    assert 1 not in check.judged
    assert check.engines == dict.fromkeys(Engine, AS_REPORTED)


@pytest.mark.parametrize("whole", [True, False], ids=["dragon", "pair"])
def test_the_angle_sum_is_left_out_where_benches_cross_at_the_start_with_no_corner_inside(whole: bool) -> None:
    dance = Dance(Dragon(59, 3.48, 2.2, 0.08, 0.26), Spiral(0.21, 9.4))
    check = contact_check(first_contact(dance), whole=whole)
    assert check is not None
    assert check.agree
    assert check.left_out == (Engine.ANGLE_SUM,)


@pytest.mark.parametrize(("stray", "margin", "wrong"), [(0.02, 0.0, WRONG), (0.05, 0.03, 0.2)])
def test_with_a_stray_the_grounds_of_all_benches_are_judged(stray: float, margin: float, wrong: float) -> None:
    dance = Dance(DRAGON, SPIRAL)
    contact = first_contact(dance, margin=margin, stray=stray)
    check = contact_check(contact)
    assert check is not None
    assert check.agree
    assert len(check.judged) == DRAGON.benches
    assert set(check.engines.values()) == {AS_REPORTED}
    assert contact.time_bracket is not None
    for shift in (-wrong, wrong):
        bracket = (contact.time_bracket[0] + shift, contact.time_bracket[1] + shift)
        forged = contact_check(replace(contact, time_bracket=bracket))
        assert forged is not None
        assert forged.engines[Engine.SHAPELY] == Verdict(before=shift > 0.0, after=shift > 0.0)
        assert not forged.agree
    assert contact.benches is not None
    other = (contact.benches[0], contact.benches[1] + 1)
    assert not contact_check(replace(contact, benches=other)).agree
