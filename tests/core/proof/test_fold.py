"""Proofs of minimum pitches that a fold limits: true claims are proven and checked, false ones refused."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from flint import arb, ctx

from core import Dragon, LimitedBy, Spiral, minimum_pitch
from core.errors import ProofRefused
from core.paths.spiral import end_theta
from core.proof import Certificate, prove_minimum_pitch, verify
from core.proof.chain import Chain, delta, rises_to
from core.proof.fold import verify_fold
from core.proof.pairs import Unproven
from tests.support.depth import some
from tests.support.forgeries import edit, places, refusal, stretches, through_json
from tests.support.forgeries import put_at as at

DRAGON, RADIUS, TURNS = Dragon(14, 2.21, 1.47, 0.06, 0.12), 0.85, 5.0
ONE = Dragon(1, 2.21, 1.47, 0.06, 0.12)
# The minimum pitch of this dragon, by mpmath to 40 digits [m].
TRUE = 0.52555267785787
# This much below the true pitch the dragon folds before the circle; this much above it there is a certificate [m].
OFF = 1e-11
# The step below a minimum pitch, and a little more than it [m].
STEP, MORE_THAN_STEP = 1e-6, 1.1e-6
# Number of samples of a delta, and a little more than the distance between two of them [rad].
SAMPLES, SAMPLED = 200_001, 1e-4
# From this pitch on the head of one bench with a chord of 2 m reaches the centre (CREST_DELTA of core/kernels/fold.py);
# at this distance from it the balls still decide [m].
VANISHED, DECIDED = 2.1727687945055, 3e-7


@pytest.fixture(scope="module")
def folding() -> Certificate:
    pitch = minimum_pitch(DRAGON, turning_radius=RADIUS, start_turns=TURNS).pitch_bracket[1]
    return through_json(prove_minimum_pitch(DRAGON, pitch, turning_radius=RADIUS, start_turns=TURNS))


@pytest.fixture(scope="module")
def alone() -> Certificate:
    """One bench: it meets nobody, but it folds."""
    pitch = minimum_pitch(ONE, turning_radius=RADIUS, start_turns=TURNS).pitch_bracket[1]
    return through_json(prove_minimum_pitch(ONE, pitch, turning_radius=RADIUS, start_turns=TURNS))


def squared_distance(theta: float, deltas: Any) -> Any:
    """The squared distance of two handles in units of growth, by the law of cosines."""
    return theta**2 + (theta + deltas) ** 2 - 2.0 * theta * (theta + deltas) * np.cos(deltas)


def assert_folds(certificate: Certificate) -> None:
    """Dense samples show the fold of the head bench.

    At the first place its rear handle is more than half a turn behind, and a wall stands behind that: angles at which
    the distance is too short again. At the second place every angle up to that wall is too short.
    """
    claim, (before, after) = certificate["claim"], certificate["overlap"]["head_theta"]
    growth = (claim["pitch"] - STEP) / (2.0 * math.pi)
    assert claim["turning_radius"] / growth <= after < before <= 2.0 * math.pi * claim["start_turns"]
    _, length, _, overhang = certificate["dragon"][0]
    needed, deltas = ((length - 2.0 * overhang) / growth) ** 2, np.linspace(0.0, 2.0 * math.pi, SAMPLES)
    reached = int(np.argmax(squared_distance(before, deltas) >= needed))
    assert deltas[reached] > math.pi
    wall = reached + int(np.argmax(squared_distance(before, deltas[reached:]) < needed))
    assert wall > reached
    assert np.all(squared_distance(after, deltas[: wall + 1]) < needed)


@pytest.mark.uncompiled
def test_a_pitch_limited_by_a_fold_is_proven_and_checked(folding: Certificate) -> None:
    pitch = folding["claim"]["pitch"]
    assert abs(pitch - TRUE) < OFF
    assert folding["overlap"]["folds"] == 0
    assert_folds(folding)
    statement = verify(folding).statement
    for words in (
        f"with pitch {pitch!r} m every bench follows and no two benches except neighbours touch until the head is",
        "and with 1e-6 m less bench 0 cannot follow so far (it folds). This says nothing of larger pitches.",
    ):
        assert words in statement


@pytest.mark.parametrize(("more", "reason"), [(-OFF, "the chain folds"), (MORE_THAN_STEP, "is free of contact too")])
def test_a_pitch_off_the_one_that_a_fold_limits_is_refused(more: float, reason: str) -> None:
    for dragon in (DRAGON, ONE, Dragon(2, 2.21, 1.47, 0.06, 0.12)):
        pitch = minimum_pitch(dragon, turning_radius=RADIUS, start_turns=TURNS).pitch_bracket[1]
        with pytest.raises(ProofRefused, match=reason):
            prove_minimum_pitch(dragon, pitch + more, turning_radius=RADIUS, start_turns=TURNS)


def test_one_bench_has_a_certificate_that_it_follows(alone: Certificate) -> None:
    assert "every bench follows" in verify(alone).statement
    assert_folds(alone)
    assert {tile[2] for tile in stretches(alone)} == {""}


def random_case(seed: int) -> tuple[Dragon, float, float, float]:
    """dragon, turning radius [m], start turns, margin [m]: bench by bench, often with one that is twice as long"""
    random = np.random.default_rng(seed)
    benches = int(random.choice([1, 2, 3, 4, 6, 10]))
    chords = random.uniform(0.6, 2.0, benches)
    if benches > 1 and random.uniform() < 0.5:
        chords[int(random.integers(1, benches))] *= 2.0
    overhangs, widths = random.uniform(0.0, 0.1, benches), random.uniform(0.01, 0.06, benches)
    dragon = Dragon.of(chords + 2.0 * overhangs, widths, overhangs)
    radius = float(chords.max() * 10.0 ** random.uniform(-0.6, 0.1))
    turns = float(random.choice([random.uniform(0.5, 2.0), random.uniform(2.0, 8.0)]))
    return dragon, radius, turns, float(random.choice([0.0, 0.02]))


# Seeds of random_case() with a fold, by the bench that folds.
FOLDS = {0: (11, 15, 62, 113), 1: (3, 25, 121), 2: (70, 92, 135)}


@pytest.mark.parametrize(
    ("seed", "bench"), [(seed, bench) for bench, seeds in FOLDS.items() for seed in some(seeds, 2)]
)
def test_the_fold_of_any_bench_is_proven(seed: int, bench: int) -> None:
    dragon, radius, turns, margin = random_case(seed)
    result = minimum_pitch(dragon, turning_radius=radius, start_turns=turns, margin=margin)
    assert result.limited_by is LimitedBy.FOLD
    request = {"turning_radius": radius, "start_turns": turns, "margin": margin}
    certificate = through_json(prove_minimum_pitch(dragon, result.pitch_bracket[1], **request))
    assert f"bench {bench} cannot follow so far (it folds)" in verify(certificate).statement
    with pytest.raises(ProofRefused, match="folds"):
        prove_minimum_pitch(dragon, result.pitch_bracket[0] - OFF * (1.0 + result.pitch), **request)
    for other in {bench - 1, bench + 1, dragon.benches} - {-1}:
        with pytest.raises(ProofRefused):
            verify(edit(at("overlap", "folds", put=other))(certificate))


def test_a_fold_that_barely_exists_is_proven_and_the_limit_itself_is_undecided() -> None:
    one = Dragon(1, 2.2, 2.2, 0.02, 0.1)
    certificate = through_json(prove_minimum_pitch(one, VANISHED + DECIDED, turning_radius=0.2, start_turns=2.0))
    assert certificate["overlap"]["folds"] == 0
    verify(certificate)
    with pytest.raises(ProofRefused, match="not proven"):
        prove_minimum_pitch(one, VANISHED, turning_radius=0.2, start_turns=2.0)


def test_a_bend_where_a_fold_has_just_vanished_is_the_first_root() -> None:
    with ctx.workprec(96):
        chain = Chain(Dragon(1, 2.2, 2.2, 0.02, 0.1), arb(VANISHED + DECIDED), 2.0)
        growth = (VANISHED + DECIDED) / (2.0 * math.pi)
        for theta in np.linspace(0.97, 1.0, 60):
            result = float(delta(arb(theta), chain.needed[0]))
            before = np.linspace(0.0, result - SAMPLED, SAMPLES)
            assert result > math.pi
            assert np.all(squared_distance(theta, before) < (2.0 / growth) ** 2)


def test_no_fold_is_proven_where_every_bench_follows(folding: Certificate) -> None:
    before, after = folding["overlap"]["head_theta"]
    with ctx.workprec(96):
        chain = Chain(DRAGON, folding["claim"]["pitch"] - arb(STEP), TURNS)
        verify_fold(chain, 0, arb(before), arb(after))
        for shift in (before - after, 1e-3, 1.0, 10.0):
            with pytest.raises(Unproven):
                verify_fold(chain, 0, arb(before + shift), arb(after + shift))
        for bench in range(1, 14):
            with pytest.raises(Unproven):
                verify_fold(chain, bench, arb(before), arb(after))


def test_a_fold_with_a_shallow_wall_is_proven_only_from_close_to_it() -> None:
    """From farther out the delta might grow past the wall before the wall exists: then nothing is proven."""
    pitch = VANISHED * 0.999
    fold, bench = end_theta(Dragon(1, 2.2, 2.2, 0.02, 0.1), Spiral(pitch, 2.0))
    assert bench == 0
    with ctx.workprec(96):
        chain = Chain(Dragon(1, 2.2, 2.2, 0.02, 0.1), arb(pitch), 2.0)
        verify_fold(chain, 0, arb(fold * (1.0 + 1e-9)), arb(fold * (1.0 - 1e-9)))
        with pytest.raises(Unproven, match="no bound is found on the angle"):
            verify_fold(chain, 0, arb(fold * 1.01), arb(fold * (1.0 - 1e-9)))


@pytest.mark.parametrize("theta", [1.1, 2.0, 10.0, 100.0])
def test_a_distance_is_proven_to_rise_up_to_its_first_crest_only(theta: float) -> None:
    deltas = np.linspace(math.pi, 4.0 * math.pi, SAMPLES)
    distance = squared_distance(theta, deltas)
    crest = int(np.argmax(np.diff(distance) < 0.0))
    later = int(np.argmax(distance[crest:] > distance[crest] + SAMPLED)) + crest
    assert 0 < crest < later
    with ctx.workprec(96):
        assert rises_to(arb(theta), arb(float(deltas[crest]) - SAMPLED))
        assert not rises_to(arb(theta), arb(float(deltas[later])))


def claim(name: str, more: float) -> Callable[[dict[str, Any]], None]:
    """The change that adds to a number of the claim."""
    return lambda c: c["claim"].__setitem__(name, c["claim"][name] + more)


def shifted(first: float, last: float) -> Callable[[dict[str, Any]], None]:
    """The change that moves both places of the fold [rad]."""
    return lambda c: c["overlap"].__setitem__(
        "head_theta", [place + more for place, more in zip(c["overlap"]["head_theta"], (first, last), strict=True)]
    )


# name: (change, why core.proof.verify refuses it)
FORGERIES: dict[str, tuple[Callable[[dict[str, Any]], Any], str]] = {
    "another bench": (at("overlap", "folds", put=1), "not proven"),
    "the last bench": (at("overlap", "folds", put=13), "not proven"),
    "a bench behind the tail": (at("overlap", "folds", put=14), "bench 14 is not shown to fold on the way"),
    "places exchanged": (lambda c: c["overlap"]["head_theta"].reverse(), "not shown to fold on the way"),
    "one place": (shifted(-2.1e-8, 0.0), "not shown to fold"),
    "places before the fold": (shifted(1e-7, 1e-7), "not shown to fold|no bound is found"),
    "places within the circle": (shifted(-1e-3, -1e-3), "not shown to fold on the way"),
    "a fold within the circle": (shifted(0.0, -1e-3), "not shown to fold on the way"),
    "a fold outside the start": (shifted(30.0, 0.0), "not shown to fold on the way"),
    "places of nothing": (at("overlap", "head_theta", put=[0.0, 0.0]), "not shown to fold on the way"),
    "one place alone": (at("overlap", "head_theta", put=[10.0]), "must be a list of 2"),
    "a bench that is true": (at("overlap", "folds", put=True), "must be a whole number"),
    "a negative bench": (at("overlap", "folds", put=-1), "must be a whole number"),
    "a pair, too": (at("overlap", "benches", put=[0, 5]), "overlap.benches is unknown"),
    "a pair instead": (at("overlap", put={"benches": [0, 5], "head_theta": 11.0}), "not shown to overlap"),
    "the start instead": (at("overlap", put={"start_within_circle": True}), "not shown to lie within the circle"),
    "a smaller pitch": (claim("pitch", -1e-9), "not proven"),
    "a larger pitch": (claim("pitch", 1e-9), "not proven"),
    "a pitch above the step": (claim("pitch", MORE_THAN_STEP), "not proven"),
    "a smaller circle": (claim("turning_radius", -1e-9), "short of"),
    "a wider circle": (claim("turning_radius", 1e-2), "not shown to fold on the way"),
    "a start farther out": (claim("start_turns", 0.01), "do not join"),
    "a start at the circle": (at("claim", "start_turns", put=1.6), "not shown to fold on the way"),
    "a longer head": (at("dragon", 0, 1, put=2.2101), "not proven"),
    "a shorter head": (at("dragon", 0, 1, put=2.2099), "not proven"),
    "a wider body": (at("dragon", 1, 2, put=0.9), "not apart by face"),
    "a margin": (at("claim", "margin", put=0.6), "not apart by face"),
    "a stretch dropped": (lambda c: stretches(c).pop(7), "do not join"),
    "the last stretch dropped": (lambda c: stretches(c).pop(), "short of"),
    "the last stretches in one": (
        lambda c: stretches(c).__setitem__(slice(-20, None), [[stretches(c)[-20][0], *stretches(c)[-1][1:]]]),
        "not proven",
    ),
    "a pair left out": (lambda c: stretches(c)[-1].__setitem__(2, stretches(c)[-1][2][:-1]), "pairs are missing"),
    "no sweeps": (at("sweeps", put=[]), r"sweeps\[0\] is missing"),
    "another claim": (at("claim", "kind", put="collision-time"), "malformed"),
}  # fmt: skip
ALONE_FORGERIES: dict[str, tuple[Callable[[dict[str, Any]], Any], str]] = {
    "no sweeps": (at("sweeps", put=[]), r"sweeps\[0\] is missing"),
    "a stretch dropped": (lambda c: stretches(c).pop(7), "do not join"),
    "the last stretch dropped": (lambda c: stretches(c).pop(), "short of"),
    "one stretch for all": (
        lambda c: stretches(c).__setitem__(slice(None), [[stretches(c)[0][0], stretches(c)[-1][1], ""]]), "not proven",
    ),
    "a face": (lambda c: stretches(c)[0].__setitem__(2, "0"), "must have at most 0 faces"),
    "a second sweep": (lambda c: c["sweeps"].append(c["sweeps"][0]), "has 2 sweeps"),
    "a smaller pitch": (claim("pitch", -1e-9), "not proven"),
    "a second bench that is longer": (lambda c: c["dragon"].append([1, 6.0, 0.3, 0.275]), "not proven"),
    "a repetition": (at("repeats_from", put=1), "not alike"),
}  # fmt: skip


@pytest.mark.parametrize("name", FORGERIES)
def test_a_forged_certificate_of_a_fold_is_refused(folding: Certificate, name: str) -> None:
    change, reason = FORGERIES[name]
    with pytest.raises(ProofRefused, match=reason):
        verify(edit(change)(folding))


@pytest.mark.parametrize("name", ALONE_FORGERIES)
def test_a_forged_certificate_of_one_bench_is_refused(alone: Certificate, name: str) -> None:
    change, reason = ALONE_FORGERIES[name]
    with pytest.raises(ProofRefused, match=reason):
        verify(edit(change)(alone))


@pytest.mark.parametrize(
    "put", [None, "x", [], {}, -1, 0, 0.5, 1e15, 1e-300, math.nan, True, 10**20, [1], {"a": 1}], ids=repr
)
def test_no_change_of_any_member_escapes_or_shows_python(folding: Certificate, put: Any) -> None:
    content = {name: value for name, value in folding.items() if name not in ("digest", "sweeps")}
    messages = [refusal(edit(at(*place, put=put))(folding)) for place in places(content)[1:]]
    assert [m for m in messages if any(word in m for word in ("Error(", "None", "True", "False", "\n"))] == []
    assert sum(map(bool, messages)) > 10
