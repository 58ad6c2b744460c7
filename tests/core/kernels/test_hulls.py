"""Separation of benches that are unions of hulls: shapely's, and witnesses that keep their promise."""

import math

import numpy as np
import shapely

from core.kernels import Rings, Scene, meet, spiral_curve
from core.kernels.constants import CHAIN_COLUMNS, DIRECTIONS, MX, MY, SIZE_COLUMNS, UX, UY
from core.shapes.reach import bench_hulls, directions, supports
from tests.support.near import assert_near
from tests.support.slow_search import in_plane

# The largest gap along an axis falls short of the distance by no more than this part of it [1].
SHORT = 1.0 - math.cos(math.pi / DIRECTIONS)
ROUNDING = 1e-12  # [m]
# Of a head and of a bench of the body with this stray.
HULLS = np.stack([bench_hulls(supports(chord, 0.275, 0.15, 0.08)) for chord in (2.86, 1.65)])


def test_the_separation_is_that_of_the_nearest_hulls_in_either_order():
    """Edges at rest: test_a_stray_brings_benches_nearer_to_a_wall_by_it_and_at_most_half_more."""
    chain = np.zeros((2, CHAIN_COLUMNS))
    scene = Scene(spiral_curve(0.1), 0.0, Rings(), np.zeros((2, SIZE_COLUMNS)), 2, 0)
    scene.kinds.lay(HULLS.reshape(-1, 2), np.array([0, 1], dtype=np.int64), directions())
    rng = np.random.default_rng(4)
    apart = 0
    for places, angles in zip(rng.uniform(-1.6, 1.6, (200, 2, 2)), rng.uniform(-np.pi, np.pi, (200, 2)), strict=True):
        turns = in_plane(np.exp(1j * angles))
        chain[:, [MX, MY]], chain[:, [UX, UY]] = places, turns
        moved = [hull @ [[c, s], [-s, c]] + place for hull, (c, s), place in zip(HULLS, turns, places, strict=True)]
        first, second = (shapely.convex_hull(shapely.multipoints(hulls)) for hulls in moved)
        distance = shapely.distance(first[:, None], second).min()
        meet(scene, 1, 0, chain)
        separation = scene.met.separation
        meet(scene, 0, 1, chain)
        met = scene.met
        assert_near(met.separation, separation, ROUNDING)
        assert met.separation <= distance + ROUNDING
        assert met.separation >= (1.0 - SHORT) * distance - ROUNDING or not distance
        assert_near(met.bx - met.ax, met.separation * met.nx, ROUNDING)
        assert_near(met.by - met.ay, met.separation * met.ny, ROUNDING)
        apart += distance > 0.0
    assert 50 < apart < 195
