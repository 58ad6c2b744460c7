"""The members of a certificate: a malformed one is refused by its name."""

import math
import re

import pytest

from core.errors import ProofRefused
from core.proof import verify
from tests.campaigns.differential import made
from tests.support.depth import thorough
from tests.support.forgeries import forged, places, put_at, refusal
from tests.support.reference_contacts import small

KINDS = "collision-time, minimum-pitch, clear, contact or tolerance"


@pytest.mark.parametrize(
    ("edit", "field", "words"),
    [
        ('note = "x"', "note", "note is unknown"),
        ("claim.margin = 0", "claim.margin", "must be positive (leave it out for no margin), got 0"),
        ("sweeps.1.x = 0", "sweeps.1.x", "sweeps[1].x is unknown"),
        ("delete sweeps", "sweeps", "sweeps is missing"),
        ('claim.kind = "x"', "claim.kind", f'claim.kind must be {KINDS}, got "x"'),
        ("claim = []", "claim", "claim must be an object, got a list of 0"),
        ('claim.time = "51"', "claim.time", 'claim.time must be a number, got "51"'),
        ("claim.time = 1e6", "claim.time", "must be at most 442.59 s, got 1000000 s"),
        ("precision = 52", "precision", "got 52"),
        ("precision = 4097", "precision", "got 4097"),
        ("precision = 96.5", "precision", "must be a whole number, got 96.5"),
        ("dragon.1 = [1, 2, 3]", "dragon.1", "dragon[1] must be a list of 4, got a list of 3"),
        ("dragon.1.3 = 2.0", "dragon.overhangs.1", "than half of dragon.lengths[1] (2.2 m / 2 = 1.1 m), got 2 m"),
        # Rectangles without interiors never overlap, although each face has a corner of the other before it.
        ("dragon.0.2 = 0.0", "dragon.widths.0", "must be from 0.001 to 10000 m, got 0 m"),
        ("overlap.benches.0 = true", "overlap.benches.0", "must be a whole number, got true"),
        ("sweeps.0.stretches.7 = [1, 2]", "sweeps.0.stretches.7", "lowest theta, faces], got a list of 2"),
        ("sweeps.0.stretches.7.0 = Infinity", "sweeps.0.stretches.7.0", "from -1e+15 to 1e+15, got inf"),
        ('sweeps.0.stretches.7.2 = "08"', "sweeps.0.stretches.7.2", 'must be faces, digits from 0 to 7, got "08"'),
        ('sweeps.0.stretches.0.2 = "4330"', "sweeps.0.stretches.0.2", "one for each bench behind, got 4"),
        (f'repeats_from = "{"9" * 90}"', "repeats_from", f'must be a whole number, got "{"9" * 39}...'),
    ],
)  # fmt: skip
def test_a_malformed_certificate_is_refused_by_its_member(edit, field, words):
    with pytest.raises(ProofRefused) as e:
        verify(forged(small(), edit))
    assert e.value.message.startswith("the certificate is malformed: ")
    assert e.value.message.endswith(words)
    assert e.value.field == field


@pytest.mark.parametrize(
    "kind",
    [
        "collision time",
        "route",
        *thorough("contact", "turn with a margin", "minimum pitch at a fold", "clear to the fold", "stray with a pose"),
    ],
)
def test_no_change_of_any_member_escapes_or_shows_python(kind):
    certificate = made(kind)
    values = [None, "x", [], {}, -1, 0, 0.5, 1e15, 1e-300, math.nan, True, 10**20, [1], {"a": 1}]
    for put in values:
        changes = [put_at(*place, put=put) for place in places(certificate)[1:] if place != ("digest",)]
        messages = [refusal(forged(certificate, change)) for change in changes]
        assert [words for words in messages if re.search(r"Error\(|None|True|False|\n", words)] == []
        assert sum(map(bool, messages)) > 10


@pytest.mark.parametrize("value", [None, [], {}, "proof", 1.0])
def test_what_is_no_certificate_is_refused(value):
    with pytest.raises(ProofRefused, match="malformed"):
        verify(value)
