"""Separation of benches that are unions of hulls: shapely's, witnesses that keep their promise, edges at rest."""

from __future__ import annotations

import math

import numpy as np
import pytest
import shapely

from core.kernels import Rings, Scene, meet, spiral_curve
from core.kernels.constants import CHAIN_COLUMNS, DIRECTIONS, HALF_LENGTH, MX, MY, RADIUS, SIZE_COLUMNS, UX, UY
from core.shapes.reach import bench_hulls, directions, supports

# The largest gap along an axis falls short of the distance by no more than this part of it [1].
SHORT = 1.0 - math.cos(math.pi / DIRECTIONS)
ROUNDING = 1e-12  # [m]
# Of a head and of a bench of the body with this stray.
HULLS = np.stack([bench_hulls(supports(chord, 0.275, 0.15, 0.08)) for chord in (2.86, 1.65)])


def scene_of(poses: np.ndarray, edges: int) -> tuple[Scene, np.ndarray]:
    """A scene whose benches, or last row as an edge at rest of 3 m, stand at x, y, heading; and its chain."""
    benches = len(poses) - edges
    sizes, chain = np.zeros((len(poses) + 1, SIZE_COLUMNS)), np.zeros((len(poses) + 1, CHAIN_COLUMNS))
    rows = [*range(benches), *range(benches + 1, len(poses) + 1)]
    x, y, heading = poses.T
    chain[np.ix_(rows, [MX, MY, UX, UY])] = np.stack([x, y, np.cos(heading), np.sin(heading)], axis=-1)
    sizes[benches + 1 :, [HALF_LENGTH, RADIUS]] = 1.5
    scene = Scene(spiral_curve(0.1), 0.0, Rings(), sizes, benches, edges)
    scene.kinds.lay(HULLS.reshape(-1, 2), np.array([0, 1], dtype=np.int64), directions())
    return scene, chain


def ground(kind: int, pose: np.ndarray) -> list[shapely.Polygon]:
    c, s = math.cos(pose[2]), math.sin(pose[2])
    return [shapely.Polygon(hull @ np.array([[c, s], [-s, c]]) + pose[:2]) for hull in HULLS[kind]]


@pytest.mark.parametrize("edges", [0, 1], ids=["two benches", "a bench and an edge"])
def test_the_separation_is_that_of_the_nearest_hulls_in_either_order(edges: int) -> None:
    rng = np.random.default_rng(4)
    apart = 0
    for _ in range(200):
        poses = np.column_stack([rng.uniform(-1.6, 1.6, (2, 2)), rng.uniform(-np.pi, np.pi, 2)])
        scene, chain = scene_of(poses, edges)
        meet(scene, 0, 1 + edges, chain)
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
        if not edges:
            separation = met.separation
            meet(scene, 1, 0, chain)
            assert scene.met.separation == pytest.approx(separation, abs=ROUNDING)
    assert 50 < apart < 195
