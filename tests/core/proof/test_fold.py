"""Proofs of minimum pitches that a fold limits: true claims are proven and checked, false ones refused."""

import math
from functools import cache

import numpy as np
import pytest
from flint import arb, ctx

from core import Dragon, LimitedBy, Spiral, minimum_pitch
from core.errors import ProofRefused
from core.paths.spiral import end_theta
from core.proof import prove_minimum_pitch, verify
from core.proof.chain import Chain, rises_to
from core.proof.fold import verify_fold
from core.proof.pairs import Unproven
from tests.support.depth import thorough
from tests.support.forgeries import assert_refused, in_words, stretches, through_json
from tests.support.slow_search import chord_squared

DRAGONS = {name: Dragon(count, 2.21, 1.47, 0.06, 0.12) for name, count in (("one", 1), ("two", 2), ("many", 14))}
DRAGON = DRAGONS["many"]
WAY = {"turning_radius": 0.85, "start_turns": 5.0}
# This much below the true pitch the dragon folds before the circle; this much above it there is a certificate [m].
OFF = 1e-11
# Number of samples of a delta, and a little more than the distance between two of them [rad].
SAMPLES = 200_001
SAMPLED = 1e-4
# From this pitch on the head of one bench with a chord of 2 m reaches the centre: CREST_DELTA of core/kernels/fold.py.
ALONE = Dragon(1, 2.2, 2.2, 0.02, 0.1)
VANISHED = 2.1727687945055


@cache
def least_pitch(dragon):
    return minimum_pitch(dragon, **WAY).pitch_bracket[1]


@cache
def certificate_of(dragon):
    return through_json(prove_minimum_pitch(dragon, least_pitch(dragon), **WAY))


@pytest.mark.parametrize("more, reason", [(-OFF, "the chain folds"), (1.1e-6, "is free of contact too")])
@pytest.mark.parametrize("name", ["one", *thorough("two", "many")])
def test_a_pitch_off_the_one_that_a_fold_limits_is_refused(name, more, reason):
    with pytest.raises(ProofRefused, match=reason):
        prove_minimum_pitch(DRAGONS[name], least_pitch(DRAGONS[name]) + more, **WAY)


# Dragons whose ways end with a fold of this bench.
FOLDING = {
    "head": (DRAGON, WAY, 0),
    "alone": (DRAGONS["one"], WAY, 0),
    "long bench": (
        Dragon.of([1.2, 2.9, 1.2, 1.2], [0.05] * 4, [0.1] * 4),
        {"turning_radius": 1.2, "start_turns": 5.0},
        1,
    ),
    "behind": (Dragon.of([1.2, 1.2, 2.9], [0.05] * 3, [0.1] * 3), {"turning_radius": 1.2, "start_turns": 5.0}, 2),
}


@pytest.mark.parametrize("name", ["head", "alone", "long bench", *thorough("behind")])
@pytest.mark.parametrize("margin", [0.0, *thorough(0.02)])
def test_the_fold_of_any_bench_is_proven_and_of_no_other_one(name, margin):
    dragon, way, bench = FOLDING[name]
    result = minimum_pitch(dragon, **way, margin=margin)
    assert result.limited_by is LimitedBy.FOLD
    certificate = through_json(prove_minimum_pitch(dragon, result.pitch_bracket[1], **way, margin=margin))
    assert certificate["overlap"]["folds"] == bench
    statement = verify(certificate).statement
    assert f"with pitch {result.pitch_bracket[1]!r} m every bench follows" in statement
    assert f"bench {bench} cannot follow so far (it folds)" in statement
    with pytest.raises(ProofRefused, match="folds"):
        prove_minimum_pitch(dragon, result.pitch_bracket[0] - OFF * (1.0 + result.pitch), **way, margin=margin)
    for other in {bench - 1, bench + 1, dragon.benches} - {-1}:
        assert_refused(certificate, f"overlap.folds = {other}")


def test_a_fold_with_a_shallow_wall_is_proven_only_from_close_to_it():
    """From farther out the delta might grow past the wall before the wall exists: then nothing is proven."""
    pitch = VANISHED * 0.999
    fold, bench = end_theta(ALONE, Spiral(pitch, 2.0))
    assert bench == 0
    with ctx.workprec(96):
        chain = Chain(ALONE, arb(pitch), 2.0)
        inside = arb(fold * (1.0 - 1e-9))
        verify_fold(chain, 0, arb(fold * (1.0 + 1e-9)), inside)
        with pytest.raises(Unproven, match="no bound is found on the angle"):
            verify_fold(chain, 0, arb(fold * 1.01), inside)


@pytest.mark.parametrize("theta", [1.1, 2.0, 10.0, 100.0])
def test_a_distance_is_proven_to_rise_up_to_its_first_crest_only(theta):
    deltas = np.linspace(math.pi, 4.0 * math.pi, SAMPLES)
    distance = chord_squared(theta, deltas)
    crest = int(np.argmax(np.diff(distance) < 0.0))
    later = int(np.argmax(distance[crest:] > distance[crest] + SAMPLED)) + crest
    assert 0 < crest < later
    with ctx.workprec(96):
        assert rises_to(arb(theta), arb(float(deltas[crest]) - SAMPLED))
        assert not rises_to(arb(theta), arb(float(deltas[later])))


def shifted(first, last):
    """The change that moves both places of the fold [rad]."""
    return in_words(f"overlap.head_theta.0 += {first}; overlap.head_theta.1 += {last}")


def joined(first):
    """The change that joins the stretches from this one on."""
    return lambda c: stretches(c).__setitem__(slice(first, None), [[stretches(c)[first][0], *stretches(c)[-1][1:]]])


# (change, why core.proof.verify refuses it)
FORGERIES = {
    "many": [
        ("overlap.folds = 1", "not proven"),
        ("overlap.folds = 14", "bench 14 is not shown to fold on the way"),
        ("reverse overlap.head_theta", "not shown to fold on the way"),
        (shifted(-2.1e-8, 0.0), "not shown to fold"),
        (shifted(1e-7, 1e-7), "not shown to fold|no bound is found"),
        (shifted(0.0, -1e-3), "not shown to fold on the way"),
        (shifted(30.0, 0.0), "not shown to fold on the way"),
        ("overlap.head_theta = [10.0]", "must be a list of 2"),
        ("overlap.folds = true", "must be a whole number"),
        ("overlap.benches = [0, 5]", "overlap.benches is unknown"),
        ('overlap = {"benches": [0, 5], "head_theta": 11.0}', "not shown to overlap"),
        ('overlap = {"start_within_circle": true}', "not shown to lie within the circle"),
        ("claim.pitch += 1.1e-6", "not proven"),
        ("claim.turning_radius += -1e-9", "short of"),
        ("claim.start_turns += 0.01", "do not join"),
        ("claim.start_turns = 1.6", "not shown to fold on the way"),
        ("dragon.0.1 = 2.2101", "not proven"),
        ("dragon.1.2 = 0.9", "not apart by face"),
        ("claim.margin = 0.6", "not apart by face"),
        (joined(-20), "not proven"),
    ],
    "one": [
        (joined(0), "not proven"),
        ('sweeps.0.stretches.0.2 = "0"', "must have at most 0 faces"),
        ("dragon += [[1, 6.0, 0.3, 0.275]]", "not proven"),
    ],
}
OF_BOTH = [
    ("claim.pitch += -1e-9", "not proven"),
    ("sweeps = []", r"sweeps\[0\] is missing"),
    ("delete sweeps.0.stretches.7", "do not join"),
    ("delete sweeps.0.stretches.-1", "short of"),
]


@pytest.mark.parametrize(
    "dragon, change, reason", [(name, *row) for name in FORGERIES for row in [*FORGERIES[name], *OF_BOTH]]
)
def test_a_forged_certificate_of_a_fold_is_refused(dragon, change, reason):
    assert_refused(certificate_of(DRAGONS[dragon]), change, reason)
