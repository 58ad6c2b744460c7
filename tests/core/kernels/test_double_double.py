"""Angles of spirals in double-double beyond the centre. Their arc lengths: tests/core/motion/test_long_paths.py."""

import numpy as np

from core.error_free import paired
from core.kernels import spiral_thetas


def test_beyond_the_centre_there_is_no_angle():
    s = paired(np.array([10.0, 11.0]))
    spiral_thetas(0.1, 0.0, 10.0, 0.0, s, thetas := np.ones_like(s))
    assert not thetas.any()
