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


@pytest.mark.parametrize(
    "edit, field",
    [
        ('note = "x"', "note"),
        ("claim.margin = 0", "claim.margin"),
        ("sweeps.1.x = 0", "sweeps.1.x"),
        ("delete sweeps", "sweeps"),
        ('claim.kind = "x"', "claim.kind"),
        ("claim = []", "claim"),
        ('claim.time = "51"', "claim.time"),
        ("claim.time = 1e6", "claim.time"),
        ("precision = 52", "precision"),
        ("precision = 4097", "precision"),
        ("precision = 96.5", "precision"),
        ("dragon.1 = [1, 2, 3]", "dragon.1"),
        ("dragon.1.3 = 2.0", "dragon.overhangs.1"),
        ("dragon.0.2 = 0.0", "dragon.widths.0"),
        ("overlap.benches.0 = true", "overlap.benches.0"),
        ("sweeps.0.stretches.7 = [1, 2]", "sweeps.0.stretches.7"),
        ("sweeps.0.stretches.7.0 = Infinity", "sweeps.0.stretches.7.0"),
        ('sweeps.0.stretches.7.2 = "08"', "sweeps.0.stretches.7.2"),
        ('sweeps.0.stretches.0.2 = "4330"', "sweeps.0.stretches.0.2"),
        (f'repeats_from = "{"9" * 90}"', "repeats_from"),
    ],
)
def test_a_malformed_certificate_is_refused_by_its_member(edit, field):
    with pytest.raises(ProofRefused, match="malformed") as caught:
        verify(forged(small(), edit))
    assert caught.value.field == field


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
