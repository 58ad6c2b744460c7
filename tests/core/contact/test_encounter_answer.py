"""How first encounters read, and their proofs in both languages."""

from dataclasses import replace

import pytest

from core import Outcome, Performance, first_encounter
from tests.support.shared_dances import on_lanes


def lanes(apart):
    """Two dragons that pass each other on parallel streets."""
    there, back = on_lanes(((-30.0, 0.0), (30.0, 0.0)), ((30.0, apart), (-30.0, apart)), benches=4).parts
    return Performance([replace(there, name="there"), back])


@pytest.mark.parametrize(
    "apart, query, words",
    [
        (0.36, {}, "no benches of two dragons touch until 60 s, where the last path ends>"),
        (0.2, {}, "bench 0 of there and bench 0 of dragon 1 touch at 29.725 s>"),
        (0.3, {}, "undecided from 29.72"),  # their sides touch, to rounding, all the way
    ],
)
def test_an_encounter_reads_as_a_sentence_with_dragons_benches_and_times(apart, query, words):
    met = first_encounter(lanes(apart), **query)
    assert repr(met).startswith(f"<FirstEncounter: {words}")
    if met.outcome is Outcome.UNDECIDED:
        assert met.certificate.claim.clear_until == met.time_bracket[0] == pytest.approx(29.725, abs=1e-4)
