"""Sweeps: their stretches join, and over each of them every pair has a face between it."""

import pytest
from flint import arb, ctx

from core import Dance, Dragon, Spiral, Turn, first_contact
from core.proof import prove_clear, prove_collision_time, prove_tolerance, verify
from core.proof.chain import Chain
from core.proof.sweeps import SweepOverlap, proven_sweeps, searched_stretches
from tests.support.depth import thorough
from tests.support.proof_shapes import polygon


@pytest.mark.parametrize(
    ("prove", "dance", "last", "options", "sweeps"),
    [
        (prove_clear, Dance(Dragon(8), Turn(1.7)), 15.0, {"start": 8.0}, 6),
        (prove_tolerance, Dance(Dragon(8), Spiral(0.7, 4.0)), 0.2, {"start": 1.0, "stop": 8.0}, 6),
        *thorough((prove_collision_time, Dance(Dragon(12, 1.5, 2.2, 0.3, 0.15), Spiral(0.55, 4.0)), None, {}, 10)),
    ],
)
def test_every_pair_in_its_own_right_proves_the_same_as_equal_benches_taken_once(prove, dance, last, options, sweeps):
    last = last or first_contact(dance).time
    once, each = (prove(dance, last, every_pair=every, **options) for every in (False, True))
    assert (len(once["sweeps"]), len(each["sweeps"])) == (2, sweeps)
    assert verify(once).statement == verify(each).statement
    assert verify(each).pair_proofs > verify(once).pair_proofs


def test_a_sweep_into_a_contact_names_a_pair_that_overlaps_there():
    """The default dance first touches with the head at 26.17 rad, and benches 0 and 8."""
    with ctx.workprec(128):
        chain = Chain(Dragon(14), arb(0.55), 16.0)
        with pytest.raises(SweepOverlap) as met:
            proven_sweeps(chain, 28.0, 26.0, 1, searched_stretches(chain), lambda share: None, follows=False)
        a, b = met.value.a, met.value.b
        pose = chain.pose_at(a, arb(met.value.place))
        pose.grow_to(b - a + 1)
    first, second = (polygon(pose.centres[k - a], pose.along[k - a], chain.sizes[k]) for k in (a, b))
    assert first.intersection(second).area > 0.0
