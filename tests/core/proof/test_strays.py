"""A claim about strays: both of its ends are proven, and nothing beyond them."""

from functools import cache

import numpy as np
import pytest

from core import Dance, Dragon, Line, Route, Spiral, bench_outlines, tolerance, trajectory
from core.errors import ProofRefused
from core.proof import prove_tolerance, verify
from core.tolerance.curve import time_on_circle
from tests.support.forgeries import DROPPED, assert_refused, stretches, through_json
from tests.support.refused import refused
from tests.support.shown_poses import overlap
from tests.support.slow_search import in_plane

DANCE = Dance(Dragon(12), Spiral(0.7, 5.0))
SPAN = {"start": 40.0, "stop": time_on_circle(DANCE, 1.5)}
# Largest difference of poses rebuilt in doubles from those in balls [m].
REBUILT = 1e-12


@cache
def known():
    return tolerance(DANCE, **SPAN)


@cache
def small():
    return through_json(prove_tolerance(DANCE, known().stray, exhibit=known().exhibit, **SPAN))


def test_both_ends_of_a_tolerance_are_proven():
    proof = verify(small())
    shown = small()["claim"]["shown"]
    assert f"while every hole is within {known().stray!r} m of its place and every chord keeps its" in proof.statement
    a, b = known().benches or ()
    assert f"benches {a} and {b} overlap in a pose with strays below {shown!r} m" in proof.statement
    upper = known().stray_bracket[1]
    assert upper is not None
    assert upper < shown < upper + 2e-9
    lists = [len(sides) for bench in (0, 1) for tile in stretches(small(), bench) for sides in tile[2]]
    assert set(lists) == {1, 9}  # both ways of 16. are used
    with pytest.raises(ProofRefused, match=r"with strays up to 0\.0\d+ m benches 0 and \d+ may touch when handle 0"):
        prove_tolerance(DANCE, upper, **SPAN)


def test_the_pose_of_a_certificate_is_a_contact_in_doubles_too():
    pose = small()["overlap"]
    dragon = DANCE.dragon
    headings = np.array(pose["headings"])
    steps = dragon.chords[:, None] * in_plane(np.exp(1j * headings))
    handles = pose["head"] - np.concatenate([np.zeros((1, 2)), steps.cumsum(axis=0)])
    strays = np.hypot(*(handles - trajectory(DANCE, pose["time"]).position).T)
    assert strays.max() < small()["claim"]["shown"] + REBUILT
    assert overlap(*bench_outlines(dragon, handles)[pose["benches"]]) > 0.0


@pytest.mark.thorough
def test_benches_of_many_sizes_are_proven_to_the_end_of_the_run():
    dragon = Dragon.of([2.6, 1.9, 2.2, 2.0, 2.4], [0.3, 0.5, 0.3, 0.3, 0.2], [0.2, 0.2, 0.3, 0.1, 0.2])
    dance = Dance(dragon, Spiral(1.2, 3.0))
    stray = tolerance(dance).stray
    assert stray > 0.01
    assert f"to {dance.end.time - 5e-10!r} s." in verify(prove_tolerance(dance, stray)).statement


def another_side(content):
    sides = next(sides for tile in stretches(content) for sides in tile[2] if len(sides) == 1)
    sides[0] = (sides[0] + 32) % 64


@pytest.mark.parametrize(
    "change, reason",
    [
        *DROPPED,
        (lambda c: c["claim"].__setitem__("stray", 1.003 * c["claim"]["stray"]), "not apart by face|pairs are missing"),
        (lambda c: c["claim"].__setitem__("stray", c["claim"]["shown"]), "not apart by"),
        ("claim.shown += -2e-9", "to be within"),
        ("claim.stop += 1e-6", "short of"),
        ("claim.pitch = 0.6999", "not apart by face|to be within"),
        (another_side, "not apart by face"),
        ("overlap.headings.3 += 0.1", "to be within"),
        ("overlap.time = -1.0", "not one of this dragon in this time"),
        ("delete overlap.headings.-1", "not one of this dragon"),
        ("overlap.benches = [1, 3]", "not shown to overlap in the pose"),
        ("overlap.benches = [0, 1]", "share no handle"),
        ("delete overlap", "overlap is missing"),
        ("delete claim.shown", "overlap is unknown"),
        ("claim.margin = 0.01", "claim.margin is unknown"),
        ("claim.stray = 0.9", r"stray must be at most half the chord"),
        ("sweeps.0.stretches.0.2.0 = [128]", r"\[0\] must be a side, from 0 to 127, got 128"),
        ("sweeps.0.stretches.0.2.0 = [1, 2]", "must be a list of 1 or 9 sides"),
        ('sweeps.0.stretches.0.2 = "0000"', "highest theta, lowest theta, sides"),
    ],
)
def test_a_forged_certificate_of_a_stray_is_refused(change, reason):
    assert_refused(small(), change, reason)


@pytest.mark.parametrize(
    "path, stray, stop, field",
    [
        (Route([Line((0.0, 0.0), (30.0, 0.0))]), 0.01, 5.0, "path"),
        *((DANCE.path, stray, 1.0, "stray") for stray in (0.0, 0.83)),
    ],
)
def test_what_is_no_claim_about_strays_is_refused_by_name(path, stray, stop, field):
    with refused(field):
        prove_tolerance(Dance(Dragon(4), path), stray, stop=stop)
