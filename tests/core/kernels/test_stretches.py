"""How fast a spiral's curvature changes. The sharpest curvature of a stretch bounds the turning in test_bounds.py."""

import numpy as np

from core.kernels import spiral_arc, spiral_curvature, steepest_curvature


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
