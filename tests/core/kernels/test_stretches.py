"""Stretches of a route under a bench: the sharpest curvature on them, and how fast a spiral's curvature changes."""

import numpy as np
import pytest

from core.kernels import spiral_arc, spiral_curvature, steepest_curvature
from core.kernels.constants import CREST, HANDLE_SPEED, OMEGA, PIECE_KIND, PLACE, S_END
from tests.support.intervals import on_route

# Places next to a joint [m]; change of the curvature over that distance, and other rounding [1/m].
BESIDE, ROUNDING = 1e-8, 1e-7


@pytest.mark.parametrize("seed", range(200, 230))
def test_the_sharpest_curvature_of_a_stretch_is_that_of_dense_samples(seed):
    """A bench turns at most as fast as its faster handle on that curvature: OMEGA = sharpest curvature HANDLE_SPEED."""
    at = on_route(seed)
    table = at.path.table
    beside = np.concatenate([table[:-1, S_END] - BESIDE, table[:-1, S_END] + BESIDE])
    rear, front = -at.chains[[0, -1], :, PLACE]
    for k in range(at.dragon.benches):
        places = np.concatenate([np.linspace(rear[k + 1], front[k], 500), beside])
        places = places[(rear[k + 1] <= places) & (places <= front[k])]
        sampled = np.abs(at.path.curvature(places)).max()
        sharpest = at.motion[k, OMEGA] / at.motion[k, HANDLE_SPEED]
        assert sharpest >= sampled - ROUNDING
        assert sharpest <= sampled + ROUNDING or (table[:, PIECE_KIND] == CREST).any()


def test_no_curvature_of_a_spiral_changes_faster_than_its_bound():
    theta = np.concatenate([np.linspace(0.0, 3.0, 3_001), np.geomspace(3.0, 300.0, 500)[1:]])
    curvature, arc, bound = (
        np.array([function(at) for at in theta.tolist()])
        for function in (spiral_curvature, spiral_arc, steepest_curvature)
    )
    slope = np.abs(np.diff(curvature) / np.diff(arc))
    outwards = np.maximum.accumulate(slope[::-1])[::-1]
    assert (outwards <= bound[:-1]).all()
    assert (bound[:-1] <= 1.1 * outwards)[theta[:-1] > 0.5].all()
