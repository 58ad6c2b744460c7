"""Sweeps: their stretches join, and over each of them every pair has a face between it."""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np
import pytest
import shapely
from flint import arb, ctx

from core import Dance, Dragon, Spiral, bench_poses, first_contact, trajectory
from core.proof import prove_collision_time, verify
from core.proof.chain import Chain
from core.proof.pairs import Unproven
from core.proof.sweeps import SweepOverlap, proven_sweeps, recorded_stretches, searched_stretches
from core.shapes.rectangles import corners
from tests.core.proof.test_certificate import CONTACTS, DOUBLES
from tests.support.forgeries import stretches

# Places between which the head is swept [rad].
HIGH, LOW = 60.0, 52.0


def test_every_pair_in_its_own_right_proves_the_same_as_equal_benches_taken_once() -> None:
    case = CONTACTS["combo_e_body_longer_than_head"]
    dragon, path = Dragon(**(case["dragon"] | {"benches": 12})), Spiral(case["pitch"], 4.0)
    time = first_contact(Dance(dragon, path)).time
    assert time is not None
    once, each = (prove_collision_time(Dance(dragon, path), time, every_pair=every) for every in (False, True))
    assert (len(once["sweeps"]), len(each["sweeps"])) == (2, 10)
    assert verify(once).statement == verify(each).statement
    assert verify(each).pair_proofs > verify(once).pair_proofs


@pytest.mark.parametrize("benches", [13, 40])
def test_at_every_instant_every_pair_has_a_face_between_it_or_is_rings_apart(benches: int) -> None:
    dragon, path = Dragon(benches), Spiral(0.55, 9.0)
    time = first_contact(Dance(dragon, path)).time
    assert time
    certificate = prove_collision_time(Dance(dragon, path), time)
    handles = trajectory(Dance(dragon, path), np.linspace(0.0, 0.999 * time, 40)).position
    thetas = np.hypot(*np.moveaxis(handles, -1, 0)) / path.growth
    sizes = np.stack([dragon.lengths, dragon.widths], axis=-1)
    for poses, fronts in zip(bench_poses(handles), thetas, strict=True):
        corners_all = corners(poses, sizes)
        radii = np.hypot(*np.moveaxis(corners_all, -1, 0)).max(axis=-1)
        for a in range(benches - 2):
            tiles = stretches(certificate, min(a, 1))
            faces = next(faces for high, low, faces in tiles if low - DOUBLES <= fronts[a] <= high + DOUBLES)
            for b in range(a + 2, benches):
                if b - a - 2 < len(faces):
                    owner, other = (a, b) if faces[b - a - 2] < "4" else (b, a)
                    side = int(faces[b - a - 2]) % 4
                    heading = poses[owner, 2] + side * math.pi / 2
                    out = (corners_all[other] - poses[owner, :2]) @ [math.cos(heading), math.sin(heading)]
                    assert out.min() > sizes[owner, side % 2] / 2
                else:
                    assert shapely.Polygon(corners_all[b]).distance(shapely.Point(0.0, 0.0)) > radii[a]


@pytest.mark.parametrize("margin", [0.0, 0.05])
def test_stretches_join_from_the_highest_place_to_the_lowest_and_read_back_as_they_are(margin: float) -> None:
    shares: list[float] = []
    with ctx.workprec(128):
        chain = Chain(Dragon(9), arb(0.55), 16.0, margin)
        sweeps = proven_sweeps(chain, HIGH, LOW, 1, searched_stretches(chain), shares.append, follows=False)
        assert (
            proven_sweeps(chain, HIGH, LOW, 1, recorded_stretches(chain, sweeps), shares.append, follows=False)
            == sweeps
        )
        with pytest.raises(Unproven, match="short of"):
            proven_sweeps(chain, HIGH, LOW - 0.1, 1, recorded_stretches(chain, sweeps), shares.append, follows=False)
    assert [sweep["bench"] for sweep in sweeps] == [0, 1]
    for sweep in sweeps:
        tiles = sweep["stretches"]
        assert all(before[1] == after[0] for before, after in pairwise(tiles))
    assert (sweeps[0]["stretches"][0][0], sweeps[0]["stretches"][-1][1]) == (HIGH, LOW)
    rears = [float(chain.pose(0, place).places[1]) for place in (HIGH, LOW)]
    assert sweeps[1]["stretches"][0][0] >= rears[0] > rears[1] >= sweeps[1]["stretches"][-1][1]


def test_a_sweep_into_a_contact_names_a_pair_that_overlaps_there() -> None:
    """The default dance first touches with the head at 26.17 rad, and benches 0 and 8."""
    with ctx.workprec(128):
        chain = Chain(Dragon(14), arb(0.55), 16.0)
        with pytest.raises(SweepOverlap) as met:
            proven_sweeps(chain, 28.0, 26.0, 1, searched_stretches(chain), lambda share: None, follows=False)
        a, b = met.value.a, met.value.b
        pose = chain.pose_at(a, arb(met.value.place))
        pose.grow_to(b - a + 1)
    centres, along = (
        np.array([complex(value) for value in values]) for values in (pose.centres[:: b - a], pose.along[:: b - a])
    )
    poses = np.stack([centres.real, centres.imag, np.angle(along)], axis=-1)
    dragon = Dragon(14)
    sizes = np.stack([dragon.lengths, dragon.widths], axis=-1)[[a, b]]
    first, second = shapely.polygons(corners(poses, sizes))
    assert first.intersection(second).area > 0.0
