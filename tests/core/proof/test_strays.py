"""A claim about strays: both of its ends are proven, and nothing beyond them."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
import shapely
from flint import arb, ctx

from core import Dance, Dragon, InvalidValue, Line, Route, Spiral, Tolerance, bench_outlines, tolerance, trajectory
from core.errors import OutsideRun, ProofRefused
from core.proof import Certificate, prove_tolerance, verify
from core.proof.chain import Chain
from core.sampling import bisect
from core.tolerance.curve import time_on_circle
from tests.support.forgeries import FORGERIES, edit, places, put_at, refusal, stretches, through_json
from tests.support.forgeries import put_at as at

DANCE = Dance(Dragon(12), Spiral(0.7, 5.0))
STOP = time_on_circle(DANCE, 1.5)
# Largest difference of poses rebuilt in doubles from those in balls [m].
REBUILT = 1e-12


@pytest.fixture(scope="module")
def known() -> Tolerance:
    return tolerance(DANCE, stop=STOP)


@pytest.fixture(scope="module")
def small(known: Tolerance) -> Certificate:
    return through_json(prove_tolerance(DANCE, known.stray, exhibit=known.exhibit, stop=STOP))


def test_both_ends_of_a_tolerance_are_proven(small: Certificate, known: Tolerance) -> None:
    proof = verify(small)
    assert f"while every hole is within {known.stray!r} m of its place and every chord keeps its" in proof.statement
    assert f"no two benches except neighbours touch from 0 s to {STOP!r} s" in proof.statement
    a, b = known.benches or ()
    assert f"benches {a} and {b} overlap in a pose with strays below {small['claim']['shown']!r} m" in proof.statement
    assert known.stray_bracket[1] is not None
    assert known.stray_bracket[1] < small["claim"]["shown"] < known.stray_bracket[1] + 2e-9
    assert proof.pair_proofs > proof.stretches > 20
    lists = [len(sides) for bench in (0, 1) for tile in stretches(small, bench) for sides in tile[2]]
    assert set(lists) == {1, 9}  # both ways of 16. are used


def test_the_pose_of_a_certificate_is_a_contact_in_doubles_too(small: Certificate) -> None:
    pose, dragon = small["overlap"], DANCE.dragon
    headings = np.array(pose["headings"])
    steps = dragon.chords[:, None] * np.stack([np.cos(headings), np.sin(headings)], axis=-1)
    handles = pose["head"] - np.concatenate([np.zeros((1, 2)), steps.cumsum(axis=0)])
    strays = np.hypot(*(handles - trajectory(DANCE, pose["time"]).position).T)
    assert strays.max() < small["claim"]["shown"] + REBUILT
    one, other = (shapely.Polygon(bench_outlines(dragon, handles)[k]) for k in pose["benches"])
    assert one.intersection(other).area > 0.0


def test_with_a_stray_shown_to_touch_no_proof_is_found(known: Tolerance) -> None:
    assert known.stray_bracket[1] is not None
    with pytest.raises(ProofRefused, match=r"with strays up to 0\.0\d+ m benches 0 and \d+ may touch when handle 0"):
        prove_tolerance(DANCE, known.stray_bracket[1], stop=STOP)


def test_every_pair_in_its_own_right_proves_the_same() -> None:
    dance = Dance(Dragon(8), Spiral(0.7, 4.0))
    once, each = (prove_tolerance(dance, 0.2, start=1.0, stop=8.0, every_pair=every) for every in (False, True))
    assert (len(once["sweeps"]), len(each["sweeps"])) == (2, 6)
    assert verify(once).statement == verify(each).statement
    assert verify(once).statement.endswith("touch from 1 s to 8 s.")


def test_benches_of_many_sizes_are_proven_to_the_end_of_the_run() -> None:
    dragon = Dragon.of([2.6, 1.9, 2.2, 2.0, 2.4], [0.3, 0.5, 0.3, 0.3, 0.2], [0.2, 0.2, 0.3, 0.1, 0.2])
    dance = Dance(dragon, Spiral(1.2, 3.0))
    stray = tolerance(dance).stray
    assert stray > 0.01
    assert f"to {dance.end.time - 5e-10!r} s." in verify(prove_tolerance(dance, stray)).statement


@pytest.mark.parametrize("stray", [0.05, 0.3])
def test_benches_are_far_only_where_no_strays_of_both_can_bring_them_together(stray: float) -> None:
    with ctx.workprec(96):
        nominal, strayed = (Chain(DANCE.dragon, arb(0.7), 5.0, stray=most) for most in (0.0, stray))
        rear = arb(15.0)
        inner = [
            bisect(lambda theta, chain=chain: chain.far(0, rear, arb(theta)), 15.0, 60.0)[1] * 0.7 / math.tau
            for chain in (nominal, strayed)
        ]
    first, second = (math.sqrt(radius**2 - 0.25 * DANCE.dragon.chords[0] ** 2) for radius in inner)
    assert second - first == pytest.approx(2.0 * stray, rel=1e-9)


def another_heading(content: dict[str, Any]) -> None:
    content["overlap"]["headings"][3] += 0.1


def another_side(content: dict[str, Any]) -> None:
    sides = next(sides for tile in stretches(content) for sides in tile[2] if len(sides) == 1)
    sides[0] = (sides[0] + 32) % 64


# name: (change, why verify refuses it)
OWN: dict[str, tuple[Callable[[dict[str, Any]], Any], str]] = {
    "a stray a little larger": (
        lambda c: c["claim"].__setitem__("stray", 1.003 * c["claim"]["stray"]), "not apart by face|pairs are missing",
    ),
    "a stray that is shown to touch": (lambda c: c["claim"].__setitem__("stray", c["claim"]["shown"]), "not apart by"),
    "a pose of smaller strays": (lambda c: c["claim"].__setitem__("shown", c["claim"]["shown"] - 2e-9), "to be within"),
    "a later stop": (lambda c: c["claim"].__setitem__("stop", c["claim"]["stop"] + 1e-6), "short of"),
    "an earlier start": (lambda c: c["claim"].__setitem__("start", -1e-6), "do not join"),
    "a narrower pitch": (at("claim", "pitch", put=0.6999), "not apart by face|to be within"),
    "another side": (another_side, "not apart by face"),
    "a pose with another bench turned": (another_heading, "to be within"),
    "a pose at another time": (lambda c: c["overlap"].__setitem__("time", c["overlap"]["time"] - 0.1), "to be within"),
    "a pose before the start": (at("overlap", "time", put=-1.0), "not one of this dragon in this time"),
    "a pose of another dragon": (lambda c: c["overlap"]["headings"].pop(), "not one of this dragon"),
    "another pair": (at("overlap", "benches", put=[1, 3]), "not shown to overlap in the pose"),
    "neighbours as the pair": (at("overlap", "benches", put=[0, 1]), "share no handle"),
    "no pose": (lambda c: c.pop("overlap"), "overlap is missing"),
    "a pose that is not claimed": (lambda c: c["claim"].pop("shown"), "overlap is unknown"),
    "a margin": (at("claim", "margin", put=0.01), "claim.margin is unknown"),
    "no stray": (at("claim", "stray", put=0), r"claim.stray must be positive, got 0 m"),
    "a stray of more than half a chord": (at("claim", "stray", put=0.9), r"stray must be at most half the chord"),
    "a side that no polygon has": (
        put_at("sweeps", 0, "stretches", 0, 2, 0, put=[128]), r"\[0\] must be a side, from 0 to 127, got 128",
    ),
    "two sides": (put_at("sweeps", 0, "stretches", 0, 2, 0, put=[1, 2]), "must be a list of 1 or 9 sides"),
    "faces as text": (put_at("sweeps", 0, "stretches", 0, 2, put="0000"), "highest theta, lowest theta, sides"),
}  # fmt: skip
SHARED = (
    "a stretch dropped",
    "a stretch twice",
    "the last stretch dropped",
    "the first stretch of the body dropped",
    "one stretch for all",
    "a pair left out",
    "a sweep dropped",
    "the head taken for a body bench",
)


@pytest.mark.parametrize("name", [*OWN, *SHARED])
def test_a_forged_certificate_of_a_stray_is_refused(small: Certificate, name: str) -> None:
    change, reason = OWN[name] if name in OWN else FORGERIES[name]
    with pytest.raises(ProofRefused, match=reason):
        verify(edit(change)(small))


@pytest.fixture(scope="module")
def tiny() -> Certificate:
    return through_json(prove_tolerance(Dance(Dragon(4), Spiral(0.6, 3.0)), 0.01, stop=1.0))


@pytest.mark.parametrize("put", [None, [], -1, True, [1], 1e15], ids=repr)
def test_no_change_of_any_member_escapes(tiny: Certificate, put: Any) -> None:
    messages = [refusal(edit(at(*place, put=put))(tiny)) for place in places(tiny)[1:] if place != ("digest",)]
    assert [words for words in messages if "Error(" in words] == []
    assert sum(map(bool, messages)) > 20


def test_what_is_no_claim_about_strays_is_an_invalid_value() -> None:
    line = Dance(Dragon(4), Route([Line((0.0, 0.0), (30.0, 0.0))]))
    with pytest.raises(InvalidValue, match="path must be a spiral"):
        prove_tolerance(line, 0.01, stop=5.0)
    for stray in (0.0, -0.1, 0.83, float("nan")):
        with pytest.raises(InvalidValue, match="stray must be"):
            prove_tolerance(DANCE, stray, stop=1.0)
    with pytest.raises(OutsideRun, match="stop must be"):
        prove_tolerance(DANCE, 0.01, stop=1e4)
