"""Sweeps: their stretches join, and over each of them every pair has a face between it."""

import pytest

from core import Dance, Dragon, Spiral, Turn, first_contact
from core.proof import prove_clear, prove_collision_time, prove_tolerance, verify
from tests.support.depth import thorough


@pytest.mark.parametrize(
    "prove, dance, last, options, sweeps",
    [
        (prove_clear, Dance(Dragon(8), Turn(1.7)), 15.0, {"start": 8.0}, 6),
        (prove_tolerance, Dance(Dragon(8), Spiral(0.7, 4.0)), 0.2, {"start": 1.0, "stop": 8.0}, 6),
        *thorough((prove_collision_time, Dance(Dragon(12, 1.5, 2.2, 0.3, 0.15), Spiral(0.55, 4.0)), None, {}, 10)),
    ],
)
def test_every_pair_in_its_own_right_proves_the_same_as_equal_benches_taken_once(prove, dance, last, options, sweeps):
    last = last or first_contact(dance).time
    once, each = (prove(dance, last, every_pair=every, **options) for every in (False, True))
    assert len(once["sweeps"]) == 2
    assert len(each["sweeps"]) == sweeps
    assert verify(once).statement == verify(each).statement
    assert verify(each).pair_proofs > verify(once).pair_proofs
