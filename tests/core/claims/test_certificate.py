"""Certificates carry a claim, and show its sentences."""

import pytest

import core
from core import Dance, Dragon, InvalidValue, Spiral
from core.claims.certificate import WithClaim, claim_words
from core.claims.claim import ClaimKind

DANCE = Dance(Dragon(5), Spiral())


def test_every_certificate_shows_the_sentences_of_its_claim():
    contact, strays = core.first_contact(DANCE, stop=10.0), core.tolerance(DANCE, stop=10.0)
    for certificate in (contact.certificate, strays.certificate, core.envelope(DANCE, stop=1.0).certificate):
        assert isinstance(certificate, WithClaim)
        assert certificate.method == claim_words(certificate.claim)
        table = certificate._repr_html_()
        assert '<tr><th scope="row">method</th><td>' in table
        assert "claim" not in table
        assert "method" not in repr(certificate)  # too long for a line


def test_a_probability_has_its_claim_too():
    result = core.contact_probability(DANCE, core.Wobble(), 3, 1, stop=10.0)
    assert result.claim.kind is ClaimKind.CONTACT_PROBABILITY
    assert result.claim.within == 3 - result.strayed
    assert result.method == claim_words(result.claim)


def test_a_certificate_has_words_in_two_languages_and_in_no_other_one():
    certificate = core.first_contact(DANCE, stop=10.0).certificate
    assert certificate.in_words() == certificate.in_words("en") == certificate.method
    assert certificate.in_words("zh").startswith("5 节板凳（龙头长 3.41 m，")
    with pytest.raises(InvalidValue, match="language must be en or zh, got 'fr'"):
        certificate.in_words("fr")
