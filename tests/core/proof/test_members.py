"""The members of a certificate: a malformed one is refused by its name."""

from __future__ import annotations

import math
import re
from typing import Any

import pytest

from core.errors import ProofRefused
from core.proof import Certificate, verify
from tests.support.forgeries import edit, places, refusal, through_json
from tests.support.forgeries import put_at as at
from tests.support.reference_contacts import SMALL, proof_of


@pytest.fixture(scope="module")
def small() -> Certificate:
    return through_json(proof_of(SMALL))


MALFORMED = {
    "an unknown member": (at("note", put="x"), "note", "note is unknown"),
    "an unknown member of the claim": (at("claim", "x", put=0), "claim.x", "claim.x is unknown"),
    "a margin of nothing": (
        at("claim", "margin", put=0),
        "claim.margin",
        "claim.margin must be positive (leave it out for no margin), got 0",
    ),
    "an unknown member of a sweep": (at("sweeps", 1, "x", put=0), "sweeps.1.x", "sweeps[1].x is unknown"),
    "a missing member": (lambda c: c.pop("sweeps"), "sweeps", "sweeps is missing"),
    "a claim without time": (lambda c: c["claim"].pop("time"), "claim.time", "claim.time is missing"),
    "a claim of another kind": (
        at("claim", "kind", put="x"),
        "claim.kind",
        'claim.kind must be collision-time, minimum-pitch, clear, contact or tolerance, got "x"',
    ),
    "a claim without a kind": (
        lambda c: c["claim"].pop("kind"),
        "claim.kind",
        "claim.kind must be collision-time, minimum-pitch, clear, contact or tolerance, got null",
    ),
    "an invalid claim": (at("claim", put=[]), "claim", "claim must be an object, got a list of 0"),
    "a time in words": (at("claim", "time", put="51"), "claim.time", 'claim.time must be a number, got "51"'),
    "a pitch below all": (at("claim", "pitch", put=-1), "claim.pitch", "claim.pitch must be positive, got -1 m"),
    "a time past the centre": (
        at("claim", "time", put=1e6), "claim.time", "claim.time must be at most 442.59 s, got 1000000 s",
    ),
    "no precision": (at("precision", put=0), "precision", "precision must be from 53 to 4096 bits, got 0"),
    "too little precision": (at("precision", put=52), "precision", "precision must be from 53 to 4096 bits, got 52"),
    "too much precision": (at("precision", put=4097), "precision", "precision must be from 53 to 4096 bits, got 4097"),
    "half a bit": (at("precision", put=96.5), "precision", "precision must be a whole number, got 96.5"),
    "a run of three": (at("dragon", 1, put=[1, 2, 3]), "dragon.1", "dragon[1] must be a list of 4, got a list of 3"),
    "half a bench": (at("dragon", 1, 0, put=0.5), "dragon.1.0", "dragon[1][0] must be a whole number, got 0.5"),
    "a bench without a chord": (
        at("dragon", 1, 3, put=2.0),
        "dragon.overhangs.1",
        "dragon.overhangs[1] must be less than half of dragon.lengths[1] (2.2 m / 2 = 1.1 m), got 2 m",
    ),
    "an overlap of one": (
        at("overlap", "benches", put=[3]), "overlap.benches", "overlap.benches must be a list of 2, got a list of 1",
    ),
    "a bench that is true": (
        at("overlap", "benches", 0, put=True),
        "overlap.benches.0",
        "overlap.benches[0] must be a whole number, got true",
    ),
    "a stretch of two": (
        at("sweeps", 0, "stretches", 7, put=[1, 2]),
        "sweeps.0.stretches.7",
        "sweeps[0].stretches[7] must be [highest theta, lowest theta, faces], got a list of 2",
    ),
    "a theta without end": (
        at("sweeps", 0, "stretches", 7, 0, put=math.inf),
        "sweeps.0.stretches.7.0",
        "sweeps[0].stretches[7][0] must be a number from -1e+15 to 1e+15, got inf",
    ),
    "a ninth face": (
        at("sweeps", 0, "stretches", 7, 2, put="08"),
        "sweeps.0.stretches.7.2",
        'sweeps[0].stretches[7][2] must be faces, digits from 0 to 7, got "08"',
    ),
    "a face for no bench": (
        at("sweeps", 0, "stretches", 0, 2, put="4330"),
        "sweeps.0.stretches.0.2",
        "sweeps[0].stretches[0][2] must have at most 3 faces, one for each bench behind, got 4",
    ),
    "a long text": (at("repeats_from", put="9" * 90), "repeats_from", f'must be a whole number, got "{"9" * 39}...'),
    "no second sweep": (lambda c: c["sweeps"].pop(), "sweeps", "sweeps[1] is missing"),
}  # fmt: skip


@pytest.mark.parametrize("name", MALFORMED)
def test_a_malformed_certificate_is_refused_by_its_member(small: Certificate, name: str) -> None:
    change, field, words = MALFORMED[name]
    with pytest.raises(ProofRefused) as e:
        verify(edit(change)(small))
    assert e.value.message.startswith("the certificate is malformed: ")
    assert e.value.message.endswith(words)
    assert e.value.field == field


@pytest.mark.parametrize(
    "put",
    [None, "x", [], {}, -1, 0, 0.5, 1e15, 1e-300, math.nan, True, 10**20, [1], {"a": 1}],
    ids=lambda put: f"{put!r}",
)
def test_no_change_of_any_member_escapes_or_shows_python(small: Certificate, put: Any) -> None:
    content = {name: value for name, value in small.items() if name != "digest"}
    messages = [refusal(edit(at(*place, put=put))(small)) for place in places(content)[1:]]
    assert [message for message in messages if re.search(r"Error\(|None|True|False|\n", message)] == []
    assert sum(map(bool, messages)) > 20


@pytest.mark.parametrize("value", [None, [], {}, "proof", 1.0])
def test_what_is_no_certificate_is_refused(value: Any) -> None:
    with pytest.raises(ProofRefused, match="malformed"):
        verify(value)
