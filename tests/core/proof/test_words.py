"""Claims in words: every number that matters, as it stands in the certificate."""

import pytest

from core import Dragon
from core.proof.words import RUNS_LISTED, apart_words, contact_words, dragon_words, near_words, runs


def mixed(kinds):
    """A dragon with two benches of each of these lengths."""
    lengths = [2.0 + 0.1 * (k // 2) for k in range(2 * kinds)]
    return Dragon.of(lengths, [0.3] * len(lengths), [0.2] * len(lengths))


def test_runs_of_equal_benches_are_counted():
    assert runs(Dragon(5)) == [[1, 3.41, 0.3, 0.275], [4, 2.2, 0.3, 0.275]]
    assert [count for count, *_ in runs(mixed(3))] == [2, 2, 2]


def test_a_dragon_is_described_run_by_run_until_there_are_too_many():
    assert dragon_words(mixed(1)) == "A dragon of 2 benches (2 of 2 m by 0.3 m, overhang 0.2 m)"
    assert dragon_words(mixed(RUNS_LISTED)).count("overhang") == RUNS_LISTED
    more = dragon_words(mixed(RUNS_LISTED + 1))
    assert more == "A dragon of 10 benches with the sizes that the certificate lists"


@pytest.mark.parametrize(
    ("margin", "apart", "near"),
    [
        (0.0, "no two benches except neighbours touch", "benches 0 and 8 overlap"),
        (
            0.1 + 0.2,
            "no two benches except neighbours come nearer to one another than 0.30000000000000004 m",
            "benches 0 and 8 are nearer than 0.30000000000000004 m",
        ),
    ],
    ids=["touching", "margin"],
)
def test_a_margin_is_named_with_all_its_digits(margin, apart, near):
    assert (apart_words(margin), near_words([0, 8], margin)) == (apart, near)
    clear = contact_words([0, 8], margin, -3.0, 9.5, "1e-10", clear=True)
    assert clear == f"{apart} from -3 s to 9.5 - 1e-10 s, and {near} at 9.5 + 1e-10 s."
    at_start = contact_words([0, 8], margin, 0.0, 0.0, "1e-10", clear=False)
    assert at_start.startswith(f"{near} at 0 + 1e-10 s, within 2e-10 s of the start")
    assert at_start.endswith("no time before is claimed to be clear.")
