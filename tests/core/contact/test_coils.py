"""Bounds in closed form on coils: benches are as far apart as stated."""

from __future__ import annotations

import math

import numpy as np
import pytest
import shapely

import core.design.deepest_turn
from core import (
    Dance,
    Dragon,
    Spiral,
    Turn,
    bench_poses,
    trajectory,
)
from core.contact.coils import rings_clear, wholly_outside
from core.shapes.rectangles import corners


def poses_on(coil: Spiral, turned: float, count: int, radius: float) -> np.ndarray:
    """Boxes of benches on a coil from a radius outwards, the coil turned about the centre."""
    dragon = Dragon(benches=count, head_length=2.2)
    theta = radius / coil.growth
    tail = Spiral(coil.pitch, theta / (2.0 * math.pi))
    poses = bench_poses(trajectory(Dance(dragon, tail), [0.0]).position[0])
    cos, sin = math.cos(turned), math.sin(turned)
    poses[:, :2] = poses[:, :2] @ np.array([[cos, sin], [-sin, cos]])
    poses[:, 2] += turned
    return shapely.polygons(corners(poses, np.stack([dragon.lengths, dragon.widths], axis=-1)))


# If the growth exceeds the chord, the foot of the perpendicular from the centre lies in front of the inner handle,
# and an overhang on that side reaches centimetres further in than the chord does.
@pytest.mark.parametrize("radius", [3.0, 8.0, 20.0])
@pytest.mark.parametrize(
    ("pitch", "chord", "overhang"),
    [(0.6, 1.65, 0.275), (3.0, 0.5, 0.2), (6.0, 0.5, 0.2), (9.0, 0.5, 0.24), (12.0, 0.5, 0.2), (9.9, 0.3, 0.14)],
)
def test_benches_claimed_wholly_outside_a_radius_are_outside(
    pitch: float, chord: float, overhang: float, radius: float
) -> None:
    dragon = Dragon(4, chord + 2.0 * overhang, chord + 2.0 * overhang, 0.05, overhang)
    beyond = wholly_outside(dragon, pitch / (2.0 * math.pi), radius)
    sizes = np.stack([dragon.lengths, dragon.widths], axis=-1)
    for further in np.linspace(0.0, pitch, 5):
        handles = trajectory(Dance(dragon, Spiral(pitch, (beyond + further) / pitch)), [0.0]).position[0]
        benches = shapely.polygons(corners(bench_poses(handles), sizes))
        assert shapely.distance(benches, shapely.Point(0.0, 0.0)).min() >= radius
    assert beyond < radius + chord + overhang


# A short head lies between no two benches, so its chord of 0.451 m does not weaken the bound.
@pytest.mark.parametrize("head_length", [2.2, 1.001])
@pytest.mark.parametrize("pitch", [0.9, 1.2, 1.7, 3.0])
def test_two_coils_claimed_apart_are_apart_by_more_than_the_margin(pitch: float, head_length: float) -> None:
    danced, dragon = Turn(pitch), Dragon(benches=60, head_length=head_length)
    radii = []
    # along a coil, with one between them, two benches are known to be 0.6 m apart
    for margin in np.linspace(0.0, min(0.5 * pitch - 0.35, 0.55), 5):
        clear = rings_clear(dragon, core.design.deepest_turn.coils_of(danced), margin)
        assert clear is not None
        radii.append(clear)
        one = shapely.STRtree(poses_on(Spiral(pitch, 16), 0.0, 60, clear))
        for shift in np.linspace(0.0, 2.0, 9):
            other = poses_on(Spiral(pitch, 16), math.pi, 60, clear + shift)
            assert one.query_nearest(other, return_distance=True)[1].min() > margin
    assert radii == sorted(radii)
    assert rings_clear(dragon, core.design.deepest_turn.coils_of(danced), 0.5 * pitch - 0.3) is None
