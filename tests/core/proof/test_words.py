"""Claims in words: every number that matters, as it stands in the certificate."""

import numpy as np

from core import Dragon
from core.proof.words import RUNS_LISTED, contact_words, dragon_words, runs


def mixed(kinds):
    """A dragon with two benches of each of these lengths."""
    lengths = 2.0 + 0.1 * np.arange(kinds).repeat(2)
    return Dragon.of(lengths, 0.3 * np.ones(2 * kinds), 0.2 * np.ones(2 * kinds))


def test_runs_of_equal_benches_are_counted():
    assert runs(Dragon(5)) == [[1, 3.41, 0.3, 0.275], [4, 2.2, 0.3, 0.275]]
    assert [count for count, *_ in runs(mixed(3))] == [2, 2, 2]
    for kinds, listed in ((RUNS_LISTED, RUNS_LISTED), (RUNS_LISTED + 1, 0)):
        assert dragon_words(mixed(kinds)).count("overhang") == listed


def test_a_contact_at_the_start_claims_no_time_before_and_a_margin_has_all_its_digits():
    words = contact_words([0, 8], 0.1 + 0.2, 0.0, 0.0, "1e-10", clear=False)
    assert words.startswith("benches 0 and 8 are nearer than 0.30000000000000004 m at 0 + 1e-10 s")
    assert words.endswith("no time before is claimed to be clear.")
