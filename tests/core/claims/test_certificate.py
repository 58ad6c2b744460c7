"""Certificates carry a claim, and show its sentences."""

from __future__ import annotations

import core
from core import Dance, Dragon, Spiral
from core.claims.certificate import Certificate, claim_words
from core.claims.claim import ClaimKind

DANCE = Dance(Dragon(5), Spiral())


def test_every_certificate_shows_the_sentences_of_its_claim() -> None:
    contact, strays = core.first_contact(DANCE, stop=10.0), core.tolerance(DANCE, stop=10.0)
    for certificate in (contact.certificate, strays.certificate, core.envelope(DANCE, stop=1.0).certificate):
        assert isinstance(certificate, Certificate)
        assert certificate.method == claim_words(certificate.claim)
        table = certificate._repr_html_()
        assert '<tr><th scope="row">method</th><td>' in table
        assert "claim" not in table
        assert "method" not in repr(certificate)  # too long for a line


def test_a_probability_has_its_claim_too() -> None:
    found = core.contact_probability(DANCE, core.Wobble(), 3, 1, stop=10.0)
    assert found.claim.kind is ClaimKind.CONTACT_PROBABILITY
    assert found.claim.within == 3 - found.strayed
    assert found.method == claim_words(found.claim)
