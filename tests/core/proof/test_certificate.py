"""Proofs: claims that hold are proven and checked, claims and certificates that do not are refused."""

import pytest
from flint import ctx

from core import Dragon
from core.errors import ProofRefused
from core.proof import prove_collision_time, prove_minimum_pitch, verify
from core.proof.certificate import PRECISION
from tests.support.depth import examples, thorough
from tests.support.forgeries import FORGERIES, assert_refused, forged, through_json
from tests.support.reference import reference_cases
from tests.support.reference_contacts import CONTACTS, SMALL, proof_of, proven_then_only, random_contact, small

PITCHES = reference_cases("minimum_pitch")
# The reference pitches are rounded: this much more is free of contact [m].
PITCH_ROUNDING = 1e-9


@pytest.mark.uncompiled
@pytest.mark.parametrize(
    "name, benches",
    [
        ("n_5", 5),
        *thorough(
            ("default", 223),
            ("head_spacing_1.00", examples(20, 223)),
            ("combo_b", examples(20, 400)),
            ("combo_e_body_longer_than_head", examples(20, 120)),
        ),
    ],
)
def test_a_reference_contact_is_proven_and_checked(name, benches):
    """Twenty benches touch where the whole dragon does."""
    case = CONTACTS[name]
    certificate = through_json(
        proof_of(case | {"dragon": case["dragon"] | {"benches": benches}}, head_speed=case["head_speed"])
    )
    assert certificate["overlap"] == {"benches": case["benches"]}
    assert f"benches {case['benches'][0]} and {case['benches'][1]} overlap" in verify(certificate).statement


@pytest.mark.uncompiled
@pytest.mark.parametrize(
    "name, benches, start_turns",
    # Fewer benches, and some that start nearer, are limited by the same two as the whole dragon.
    [
        *thorough(("default R=6.36", examples(27, 223), 16.0)),
        ("default R=7", examples(11, 223), 16.0),
        ("default R=2", 11, 5.0),
    ],
)
def test_a_reference_pitch_is_proven_and_checked(name, benches, start_turns):
    case = PITCHES[name]
    pitch = case["pitch"] + PITCH_ROUNDING
    dragon = Dragon(**(case["dragon"] | {"benches": benches}))
    certificate = through_json(
        prove_minimum_pitch(dragon, pitch, turning_radius=case["turning_diameter"] / 2, start_turns=start_turns)
    )
    within = case["limited_by"] == "start"
    overlap = {"start_within_circle": True} if within else {"benches": case["benches"]}
    assert certificate["overlap"].items() >= overlap.items()
    assert repr(pitch) in verify(certificate).statement


@pytest.mark.parametrize("seed", [17, *thorough(0, 2, 8, 26, 35, 42, 55)])
def test_the_contact_of_a_random_dragon_given_bench_by_bench_is_proven_and_its_neighbourhood_refused(seed):
    dance, time = random_contact(seed)
    certificate, _ = proven_then_only(prove_collision_time, dance, time)
    assert certificate["repeats_from"] == dance.dragon.benches - 3


@pytest.mark.parametrize("change, reason", FORGERIES)
def test_a_forged_certificate_is_refused(change, reason):
    assert_refused(small(), change, reason)


def test_an_edit_of_what_no_proof_needs_is_refused_by_the_digest():
    versions = small() | {"versions": {"python-flint": "0", "flint": "0"}}
    without = {name: value for name, value in small().items() if name != "digest"}
    for certificate, reason in ((versions, "was changed"), (without, "malformed")):
        with pytest.raises(ProofRefused, match=reason):
            verify(certificate)


@pytest.mark.parametrize("precision", [53, 4096])
def test_a_certificate_is_checked_with_its_precision_or_with_that_of_our_own_if_that_is_more(precision, monkeypatch):
    used = []
    monkeypatch.setattr("core.proof.certificate.proven_sweeps", lambda *request: used.append(ctx.prec) or [])
    with pytest.raises(ProofRefused):
        verify(forged(small(), f"precision = {precision}"))
    assert used == [max(precision, PRECISION)]


def test_progress_rises_to_one_and_the_precision_is_left_as_it_was():
    before = ctx.prec
    proving = [0.0]
    checking = [0.0]
    verify(proof_of(SMALL, progress=proving.append), progress=checking.append)
    with pytest.raises(ProofRefused):
        proof_of(SMALL, later=1.0)
    assert ctx.prec == before
    for shares in (proving, checking):
        assert shares == sorted(shares)
        assert shares[-1] == 1.0
