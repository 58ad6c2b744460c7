"""Separation of benches that are unions of hulls: shapely's, witnesses that keep their promise, edges at rest."""

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
# Of a head and of a bench of the body with this stray, and an edge at rest.
HULLS = np.stack([bench_hulls(supports(chord, 0.275, 0.15, 0.08)) for chord in (2.86, 1.65)])
EDGE = np.array([[[-1.5, 0.0], [1.5, 0.0]]])


@pytest.mark.parametrize("edges", [0, 1], ids=["two benches", "a bench and an edge"])
def test_the_separation_is_that_of_the_nearest_hulls_in_either_order(edges):
    sizes, chain, other = np.zeros((3, SIZE_COLUMNS)), np.zeros((3, CHAIN_COLUMNS)), 1 + edges
    sizes[2, [HALF_LENGTH, RADIUS]] = 1.5
    scene = Scene(spiral_curve(0.1), 0.0, Rings(), sizes, 2 - edges, edges)
    scene.kinds.lay(HULLS.reshape(-1, 2), np.array([0, 1], dtype=np.int64), directions())
    rng = np.random.default_rng(4)
    apart = 0
    for _ in range(200):
        shapes = []
        for row, hulls in ((0, HULLS[0]), (other, EDGE if edges else HULLS[1])):
            (x, y), angle = rng.uniform(-1.6, 1.6, 2), rng.uniform(-np.pi, np.pi)
            c, s = math.cos(angle), math.sin(angle)
            chain[row, [MX, MY, UX, UY]] = x, y, c, s
            shapes.append([shapely.MultiPoint(hull @ [[c, s], [-s, c]] + [x, y]).convex_hull for hull in hulls])
        meet(scene, 0, other, chain)
        met = scene.met
        distance = min(a.distance(b) for a in shapes[0] for b in shapes[1])
        if distance > 0.0:
            apart += 1
            assert (1.0 - SHORT) * distance - ROUNDING <= met.separation <= distance + ROUNDING
        else:
            assert met.separation <= ROUNDING
        normal = met.separation * np.array([met.nx, met.ny])
        assert normal == pytest.approx(np.array([met.bx - met.ax, met.by - met.ay]), abs=ROUNDING)
        if not edges:
            separation = met.separation
            meet(scene, 1, 0, chain)
            assert scene.met.separation == pytest.approx(separation, abs=ROUNDING)
    assert 50 < apart < 195
