"""A small part of `make sweep-pitch`, and that the slow scan it trusts finds what it must."""

import pytest

from core import Dragon
from tests.campaigns.sweep_pitch import fault
from tests.support.depth import further
from tests.support.slow_pitch import SlowWay

# Half the width of a reference value, see tests/reference [m].
REFERENCE = 1e-9


@pytest.mark.parametrize("seed", further(range(8), 2))
def test_the_minimum_pitch_of_a_random_dragon_is_that_of_a_slow_scan(seed):
    assert fault(seed)[1] == ""


def test_the_slow_scan_tells_the_two_sides_of_a_reference_value_apart():
    """A graze of benches 0 and 11 in the middle of the way, so the dip between the samples is found."""
    pitch = 0.5133809204234702
    below, above = (SlowWay.of(Dragon(30), pitch + more, 16.0, 3.0).least() for more in (-REFERENCE, REFERENCE))
    assert below < 0.0 < above
