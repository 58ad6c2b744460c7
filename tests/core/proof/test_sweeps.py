"""Sweeps: their stretches join, and over each of them every pair has a face between it."""

import math
from functools import partial

import numpy as np
import pytest
from flint import arb, ctx

from core import Dance, Dragon, Spiral, Turn, bench_poses, first_contact, trajectory
from core.proof import prove_clear, prove_collision_time, prove_tolerance, verify
from core.proof.chain import Chain
from core.proof.paths import chain_on, recorded_path
from core.proof.sweeps import SweepOverlap, proven_sweeps, searched_stretches
from core.shapes.rectangles import corners
from tests.support.depth import thorough
from tests.support.forgeries import stretches
from tests.support.proof_shapes import gap_by, polygon

# A place that two chains in balls have is the same to this [rad], [m].
DOUBLES = 1e-11
# Places between which the head is swept [rad].
HIGH, LOW = 60.0, 52.0


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


def turning():
    return prove_clear(Dance(Dragon(14), Turn(1.7)), 18.0, start=-8.0, margin=0.5)


def until_contact(benches):
    dance = Dance(Dragon(benches), Spiral(0.55, 9.0))
    return prove_collision_time(dance, first_contact(dance).time or math.inf)


@pytest.mark.parametrize(
    ("make", "path", "start", "letters"),
    [
        (partial(until_contact, 13), Spiral(0.55, 9.0), 0.0, {"0", "3"}),
        *thorough((partial(until_contact, 40), Spiral(0.55, 9.0), 0.0, {"0", "3", "far"})),
        (turning, Turn(1.7), -7.9, {"8", "9"}),
    ],
    ids=["13 on a spiral", "40 on a spiral", "turn"],
)
def test_at_every_instant_each_letter_of_a_certificate_keeps_its_pair_apart(make, path, start, letters):
    certificate = make()
    claim, dragon = certificate["claim"], Dragon(sum(run[0] for run in certificate["dragon"]))
    times = np.linspace(start, claim.get("stop", claim.get("time")) - 0.1, 40)
    chain, sizes = chain_on(dragon, recorded_path(path), 0.0), np.stack([dragon.lengths, dragon.widths], axis=-1)
    used = set()
    for time, poses in zip(times, bench_poses(trajectory(Dance(dragon, path), times).position), strict=True):
        shapes, chained = corners(poses, sizes), chain.pose_at(0, chain.place_after(arb(time)))
        chained.grow_to(dragon.benches)
        for a in range(dragon.benches - 2):
            place = float(chained.places[a])
            tiles = stretches(certificate, min(a, 1))
            _, _, faces, *rest = next(tile for tile in tiles if tile[1] - DOUBLES <= place <= tile[0] + DOUBLES)
            directions = iter(rest[0] if rest else [])
            for b in range(a + 2, dragon.benches):
                face = faces[b - a - 2] if b - a - 2 < len(faces) else "far"
                used.add(face)
                direction = next(directions) if face == "8" else 0.0
                assert gap_by(face, direction, poses, sizes, shapes, a, b) > claim.get("margin", 0.0)
    assert letters < used


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
