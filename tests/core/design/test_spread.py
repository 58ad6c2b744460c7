"""Spread: the bound for several dragons on wide spirals, against dense samples of their ways."""

import math

import numpy as np
import pytest

from core.design.spread import Spread
from tests.campaigns.sweep_pitch import random_case
from tests.core.design.test_straight import assert_bounded
from tests.support.depth import further, some
from tests.support.slow_pitch import SlowWays


@pytest.mark.parametrize("seed", further(some(range(40), 12), 3))
def test_dragons_keep_a_cleared_margin_at_every_larger_growth(seed):
    dragon, radius, turns, _ = random_case(seed)
    radius = max(radius, 2.0 * float(dragon.lengths.max()))
    dragon, rng = dragon.leading(min(dragon.benches, 30)), np.random.default_rng(seed)
    count = int(rng.integers(2, 6))
    spread = Spread(dragon, count)
    bounds = 0

    def least(wider):
        return SlowWays.of(dragon, math.tau * wider, max(turns, 2.0 * radius / wider / math.pi), radius, count).least()

    for growth in spread.chord * 10.0 ** rng.uniform(-0.5, 2.0, 5):
        margins = [part * radius for part in (0.0, 0.1, 0.3, 1.0) if spread.clears(growth, radius, part * radius)]
        if margins:
            bounds += 1
            assert_bounded(rng, growth, margins[-1], least)
    assert bounds
