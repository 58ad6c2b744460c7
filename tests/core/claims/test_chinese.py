"""Every claim in Chinese says what it says in English."""

import re

import pytest

from tests.support.every_kind import SENTENCES

# Latin letters that are neither a unit nor a name.
ENGLISH = re.compile(r"(?<![A-Za-z])(?!Clopper|Pearson)[A-Za-z]{4,}")
NUMBER = re.compile(r"-?\d+(?:\.\d+)?")


@pytest.mark.parametrize(("english", "chinese"), SENTENCES.values(), ids=SENTENCES)
def test_nothing_is_left_in_english_and_no_number_is_left_out(english, chinese):
    assert not ENGLISH.search(chinese)
    # A margin counts as once: the Chinese of an undecided search says "or too near" in its place.
    assert set(NUMBER.findall(chinese)) >= set(NUMBER.findall(english)) - {"0.05"}
