"""Separation of benches that are unions of hulls: shapely's, witnesses that keep their promise, edges at rest."""

from __future__ import annotations

import math

import numpy as np
import pytest
import shapely

from core import kernels
from core.kernels.constants import DIRECTIONS, HALF_LENGTH, MX, MY, RADIUS, UX, UY
from core.shapes.reach import bench_hulls, directions, supports

# The largest gap along an axis falls short of the distance by no more than this part of it [1].
SHORT = 1.0 - math.cos(math.pi / DIRECTIONS)
ROUNDING = 1e-12  # [m]
STRAY = 0.08


def scene_of(poses: np.ndarray, edges: int) -> tuple[kernels.Scene, np.ndarray]:
    """A scene whose benches, or last row as an edge at rest of 3 m, stand at x, y, heading; and its chain."""
    benches = len(poses) - edges
    sizes = np.zeros((len(poses) + 1, kernels.SIZE_COLUMNS))
    chain = np.zeros((len(poses) + 1, kernels.CHAIN_COLUMNS))
    rows = [*range(benches), *range(benches + 1, len(poses) + 1)]
    for row, (x, y, heading) in zip(rows, poses.tolist(), strict=True):
        chain[row, [MX, MY, UX, UY]] = x, y, math.cos(heading), math.sin(heading)
    sizes[benches + 1 :, [HALF_LENGTH, RADIUS]] = 1.5
    scene = kernels.Scene(kernels.spiral_curve(0.1), 0.0, kernels.Rings(), sizes, benches, edges)
    hulls = np.stack([bench_hulls(supports(2.86, 0.275, 0.15, STRAY)), bench_hulls(supports(1.65, 0.275, 0.15, STRAY))])
    scene.kinds.lay(hulls.reshape(-1, 2), np.array([0, 1], dtype=np.int64), directions())
    return scene, chain


def ground(kind: int, pose: np.ndarray) -> list[shapely.Polygon]:
    hulls = bench_hulls(supports(2.86 if kind == 0 else 1.65, 0.275, 0.15, STRAY))
    c, s = math.cos(pose[2]), math.sin(pose[2])
    return [shapely.Polygon(hull @ np.array([[c, s], [-s, c]]) + pose[:2]) for hull in hulls]


@pytest.mark.parametrize("edges", [0, 1], ids=["two benches", "a bench and an edge"])
def test_the_separation_is_that_of_the_nearest_hulls(edges: int) -> None:
    rng = np.random.default_rng(4)
    apart = 0
    for _ in range(400):
        poses = np.column_stack([rng.uniform(-1.6, 1.6, (2, 2)), rng.uniform(-np.pi, np.pi, 2)])
        scene, chain = scene_of(poses, edges)
        kernels.meet(scene, 0, 1 + edges, chain)
        met = scene.met
        along = 1.5 * np.array([math.cos(poses[1, 2]), math.sin(poses[1, 2])])
        line = shapely.LineString([poses[1, :2] - along, poses[1, :2] + along])
        others = [line] if edges else ground(1, poses[1])
        distance = min(a.distance(b) for a in ground(0, poses[0]) for b in others)
        if distance > 0.0:
            apart += 1
            assert (1.0 - SHORT) * distance - ROUNDING <= met.separation <= distance + ROUNDING
        else:
            assert met.separation <= ROUNDING
        between = np.array([met.bx - met.ax, met.by - met.ay])
        assert between == pytest.approx(met.separation * np.array([met.nx, met.ny]), abs=ROUNDING)
    assert 100 < apart < 390


def test_the_order_of_a_pair_does_not_matter() -> None:
    rng = np.random.default_rng(5)
    for _ in range(100):
        poses = np.column_stack([rng.uniform(-2.0, 2.0, (3, 2)), rng.uniform(-np.pi, np.pi, 3)])
        scene, chain = scene_of(poses, 0)
        kernels.meet(scene, 1, 2, chain)
        gap = scene.met.separation
        kernels.meet(scene, 2, 1, chain)
        assert scene.met.separation == pytest.approx(gap, abs=ROUNDING)
