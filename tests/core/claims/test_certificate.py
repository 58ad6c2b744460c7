"""Certificates carry a claim, and show its sentences."""

import pytest

import core
from core import Dance, Dragon, InvalidValue, Spiral
from core.claims.claim import ClaimKind
from core.words.claims import claim_words

DANCE = Dance(Dragon(5), Spiral())


def test_every_certificate_shows_the_sentences_of_its_claim():
    chance = core.contact_probability(DANCE, core.Wobble(), 3, 1, stop=10.0)
    assert chance.claim.kind == ClaimKind.CONTACT_PROBABILITY
    assert chance.claim.within == 3 - chance.strayed
    certificate = core.first_contact(DANCE, stop=10.0).certificate
    for result in (certificate, chance):
        assert result.method == claim_words(result.claim)
    table = certificate._repr_html_()
    assert ">method</th><td>" in table
    assert "claim" not in table
    assert "method" not in repr(certificate)  # too long for a line


def test_a_certificate_has_words_in_two_languages_and_in_no_other_one():
    certificate = core.first_contact(DANCE, stop=10.0).certificate
    assert certificate.in_words() == certificate.in_words("en") == certificate.method
    assert certificate.in_words("zh").startswith("5 节板凳（龙头长 3.41 m，")
    with pytest.raises(InvalidValue, match="language must be en or zh, got 'fr'"):
        certificate.in_words("fr")
