"""Bounds on the separation of benches, also of those that are unions of hulls, against samples of an interval."""

import numpy as np

from core import Dragon, Spiral
from core.kernels import gap_at, pair_least, pair_most
from core.kernels.constants import CENTRE_SPEED, FREE, MX, MY
from tests.support.searches import search_on

ROUNDING = 1e-12  # [m]


def test_over_an_interval_two_benches_are_between_their_bounds_whether_they_stray_or_not():
    """The nearest they may be, and the most: what may touch for certain stays so."""
    rng = np.random.default_rng(6)
    touching = proven = 0
    for k in range(240):
        dragon = Dragon(9, 2.0, rng.uniform(1.2, 2.0), rng.uniform(0.1, 0.5))
        stray = rng.uniform(0.002, 0.1) * (k % 2)
        search = search_on(dragon, Spiral(0.5, 3.0), stray=stray)
        a = int(rng.integers(0, 3))
        b = int(rng.integers(a + 2, 9))
        h = 10 ** rng.uniform(-9.0, -1.0)
        place = search.place - rng.uniform(0.0, 6.0)
        most = pair_most(search.scene, search.probe, place, h, a, b)
        places = (place - np.linspace(0.0, h, 9)).tolist()
        gaps = [gap_at(search.scene, at, a, b, search.placed) for at in places]
        assert max(gaps) <= max(most, 0.0)
        touching += most <= 0.0
        if search.probe.lay_out(place, h, b + 1):
            centres = search.probed[[a, b]][:, [MX, MY]]
            distance = np.linalg.norm(centres[1] - centres[0]) + h * search.motion[[a, b], CENTRE_SPEED].sum()
            least, _ = pair_least(search.scene, search.probe, a, b, FREE, float(distance))
            assert least <= max(min(gaps), 0.0) + ROUNDING
            proven += least > 0.9 * min(gaps) > 0.0
    assert touching > 5
    assert proven > 60
