"""Bounds on the gaps of two benches on an interval, against dense samples. Outside a radius: test_rings.py."""

import numpy as np
import pytest

from core.kernels import pair_least
from core.kernels.constants import HALF_LENGTH, RADIUS
from tests.support.depth import some
from tests.support.intervals import checked_pairs, on_spiral
from tests.support.slow_search import rectangles_gap


@pytest.mark.parametrize("seed", some(range(30), 12))
def test_no_two_benches_are_nearer_over_an_interval_than_their_bound(seed):
    at = on_spiral(seed)
    benches = [
        (*(np.stack([z[:, k].real, z[:, k].imag], axis=-1) for z in (at.centres, at.along)), at.sizes[k : k + 1])
        for k in range(at.dragon.benches)
    ]
    for a, b in checked_pairs(at.dragon.benches):
        least, _ = pair_least(at.interval.scene, at.interval, a, b, 0.0, at.distance(a, b))
        (ma, ua, first), (mb, ub, second) = benches[a], benches[b]
        gaps = rectangles_gap(ma, ua, first[:, HALF_LENGTH:RADIUS], mb, ub, second[:, HALF_LENGTH:RADIUS])
        assert least <= gaps.min() + at.rounding
