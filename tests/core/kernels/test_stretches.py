"""Stretches of a route under a bench: the sharpest curvature on them, and how fast a spiral's curvature changes."""

from __future__ import annotations

import numpy as np
import pytest

from core import kernels
from core.kernels.constants import CREST, HANDLE_SPEED, OMEGA, PIECE_KIND, PLACE, S_END
from tests.core.kernels.test_bounds import bounded, laid_out, random_interval, sizes_of

# Places next to a joint [m]; change of the curvature over that distance, and other rounding [1/m].
BESIDE, ROUNDING = 1e-8, 1e-7


@pytest.mark.parametrize("seed", range(200, 230))
def test_the_sharpest_curvature_of_a_stretch_is_that_of_dense_samples(seed: int) -> None:
    """A bench turns at most as fast as its faster handle on that curvature: OMEGA = sharpest curvature HANDLE_SPEED."""
    dragon, path, start, h = random_interval(np.random.default_rng(seed))
    sizes = sizes_of(dragon)
    motion, h = bounded(path, start, h, sizes)
    rear, front = (-laid_out(path, s, sizes)[:, PLACE] for s in (start, start + h))
    joints = path.table[:-1, S_END]
    for k in range(dragon.benches):
        beside = np.concatenate([joints - BESIDE, joints + BESIDE])
        places = np.concatenate([np.linspace(rear[k + 1], front[k], 500), beside])
        places = places[(rear[k + 1] <= places) & (places <= front[k])]
        sampled = np.abs(path.curvature(places)).max()
        sharpest = motion[k, OMEGA] / motion[k, HANDLE_SPEED]
        assert sharpest >= sampled - ROUNDING
        if not (path.table[:, PIECE_KIND] == CREST).any():
            assert sharpest <= sampled + ROUNDING


def test_no_curvature_of_a_spiral_changes_faster_than_its_bound() -> None:
    theta = np.concatenate([np.linspace(0.0, 3.0, 3_001), np.geomspace(3.0, 300.0, 500)[1:]])
    curvature = np.array([kernels.spiral_curvature(at) for at in theta.tolist()])
    arc = np.array([kernels.spiral_arc(at) for at in theta.tolist()])
    slope = np.abs(np.diff(curvature) / np.diff(arc))
    bound = np.array([kernels.steepest_curvature(at) for at in theta[:-1].tolist()])
    outwards = np.maximum.accumulate(slope[::-1])[::-1]
    assert (outwards <= bound).all()
    assert (bound <= 1.1 * outwards)[theta[:-1] > 0.5].all()
