"""Straight: the bound for wide spirals against dense samples, and against its limit on a straight line."""

import math
from itertools import product

import numpy as np
import pytest

from core import kernels
from core.design.straight import Straight, curvature_most
from tests.campaigns.sweep_pitch import random_case
from tests.support.depth import further, some
from tests.support.near import assert_near
from tests.support.slow_pitch import SlowWay

# Rounding of a slow clearance on ways of metres [m], and on a wide spiral per metre of its growth [1].
ROUNDING = 1e-11
ROUNDING_PER_GROWTH = 1e-12
# From this growth on, in longest chords, a dragon of metres stands straight to a part of a thousand [1].
WIDE = 1e5


def assert_bounded(rng, growth, bound, least):
    """A dragon keeps to the bound at a growth and at a larger one; least: its slow clearance at a growth."""
    for wider in growth * np.array([1.0, 1.0 + 10.0 ** rng.uniform(-2.0, 1.0)]):
        assert least(wider) >= bound - ROUNDING - ROUNDING_PER_GROWTH * wider


@pytest.mark.parametrize("seed", further(some(range(40), 12), 4))
def test_benches_are_no_closer_than_the_bound_at_any_larger_growth(seed):
    dragon, radius, turns, _ = random_case(seed)
    straight = Straight(dragon)
    rng = np.random.default_rng(seed)
    bounds = 0

    def least(wider):
        return SlowWay.of(dragon, math.tau * wider, max(turns, radius / wider / math.pi), radius).least()

    for growth in straight.chord * 10.0 ** rng.uniform(-1.0, 3.0, 6):
        bound = straight.least(growth, radius)
        if bound != -1e150:
            bounds += 1
            assert_bounded(rng, growth, bound, least)
    assert bounds


@pytest.mark.parametrize("seed", range(40))
def test_the_bound_grows_to_the_gap_on_a_straight_line(seed):
    dragon, radius, _, _ = random_case(seed)
    straight = Straight(dragon)
    growth = WIDE * straight.chord
    if dragon.benches < 3:
        assert straight.least(growth, radius) > growth
        return
    ends, i, j = np.cumsum(dragon.chords), *np.triu_indices(dragon.benches, 2)  # along the line
    gap = (ends[j - 1] - ends[i] - dragon.overhangs[i] - dragon.overhangs[j]).min()
    assert (straight.gap <= 0.0) is bool(gap <= 0.0)
    if gap > 0.0:
        assert straight.gap == pytest.approx(gap, rel=1e-12)
        assert_near(straight.least(growth, radius), gap, 4.0 * straight.chord / WIDE)


def test_no_spiral_of_the_growth_or_a_larger_one_is_bent_more():
    further_out = np.geomspace(1.0, 9.0, 20).tolist()
    for radius, growth in product((0.1, 1.0, 7.0), np.geomspace(0.01, 100.0, 12).tolist()):
        most = curvature_most(growth, radius)
        for wider, factor in product(growth * np.geomspace(1.0, 50.0, 40), further_out):
            assert kernels.spiral_curvature(factor * radius / wider) / wider <= most * (1.0 + 1e-15)
