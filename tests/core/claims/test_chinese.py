"""Every claim in Chinese."""

from __future__ import annotations

import re

import pytest

from core.claims.certificate import claim_words
from tests.support.every_kind import CLAIMS, SENTENCES

# Latin letters that are neither a unit nor a name.
ENGLISH = re.compile(r"(?<![A-Za-z])(?!Clopper|Pearson)[A-Za-z]{4,}")
NUMBER = re.compile(r"-?\d+(?:\.\d+)?")


@pytest.mark.parametrize("name", CLAIMS)
def test_a_claim_has_these_sentences(name: str) -> None:
    assert claim_words(CLAIMS[name], "zh") == SENTENCES[name][1]


@pytest.mark.parametrize("name", CLAIMS)
def test_nothing_is_left_in_english_and_no_number_is_left_out(name: str) -> None:
    english, chinese = SENTENCES[name]
    assert not ENGLISH.search(chinese)
    # A margin counts as once: the Chinese of an undecided search says "or too near" in its place.
    assert set(NUMBER.findall(chinese)) >= set(NUMBER.findall(english)) - {"0.05"}
