"""A small part of `make sweep-pitch`, and that the slow scan it trusts finds what it must."""

from __future__ import annotations

import pytest

from core import Dragon
from tests.campaigns.sweep_pitch import fault
from tests.support.slow_pitch import SlowWay

DRAGONS = 8
# Half the width of a reference value, see tests/reference [m].
REFERENCE = 1e-9


@pytest.mark.parametrize("seed", range(DRAGONS))
def test_the_minimum_pitch_of_a_random_dragon_is_that_of_a_slow_scan(seed: int) -> None:
    assert fault(seed)[1] == ""


@pytest.mark.parametrize("pitch", [0.5133809204234702])
def test_the_slow_scan_tells_the_two_sides_of_a_reference_value_apart(pitch: float) -> None:
    """A graze of benches 0 and 11 in the middle of the way, so the dip between the samples is found."""
    below, above = (SlowWay.of(Dragon(30), pitch + more, 16.0, 3.0).least() for more in (-REFERENCE, REFERENCE))
    assert below < 0.0 < above
