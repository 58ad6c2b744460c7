"""Every claim in English and in Chinese."""

import re

import pytest

from core import Dance, Dragon, Spiral
from core.claims.claim import ClaimKind, DanceSummary, StrayClaim
from core.language import Language, speaking
from core.words.claims import claim_words
from tests.support.every_kind import CLAIMS, SENTENCES

NUMBER = re.compile(r"-?\d+(?:\.\d+)?")


@pytest.mark.parametrize("name", CLAIMS)
def test_a_claim_has_these_sentences(name):
    words = []
    for language in Language:
        with speaking(language):
            words.append(claim_words(CLAIMS[name]))
    assert words == SENTENCES[name]


def test_every_kind_of_claim_is_among_them():
    assert {claim.kind for claim in CLAIMS.values()} == set(ClaimKind)
    assert SENTENCES.keys() == CLAIMS.keys()


def test_numbers_have_all_their_digits_but_a_safe_stray_only_those_that_are_proven():
    dance = DanceSummary.of(Dance(Dragon(5), Spiral(0.1 + 0.2, 8.0)))
    words = claim_words(StrayClaim(ClaimKind.SAFE_STRAY, dance, False, 0.0, 1.0 / 3.0, 0.0299999999999999, False, None))
    assert "0.30000000000000004 m pitch" in words
    assert "to 0.3333333333333333 s" in words
    assert "within 0.029999999999 m of" in words


@pytest.mark.parametrize("english, chinese", SENTENCES.values(), ids=SENTENCES)
def test_no_number_is_left_out_in_chinese(english, chinese):
    assert set(NUMBER.findall(chinese)) >= set(NUMBER.findall(english))
