"""Bounds on the gaps of two benches, on an interval and outside a radius, against dense samples."""

from __future__ import annotations

import numpy as np
import pytest

from core import Dragon, Spiral, kernels
from core.contact.search import ContactSearch
from core.kernels.constants import HALF_LENGTH, RADIUS
from tests.support.depth import some
from tests.support.intervals import checked_pairs, on_spiral
from tests.support.slow_search import SlowDance, rectangles_gap
from tests.support.thorough import thorough


@pytest.mark.parametrize("seed", some(range(30), 12))
def test_no_two_benches_are_nearer_over_an_interval_than_their_bound(seed: int) -> None:
    at = on_spiral(seed)
    benches = [
        (*(np.stack([z[:, k].real, z[:, k].imag], axis=-1) for z in (at.centres, at.along)), at.sizes[k : k + 1])
        for k in range(at.dragon.benches)
    ]
    for a, b in checked_pairs(at.dragon.benches):
        least, _ = kernels.pair_least(at.interval.scene, at.interval, a, b, 0.0, at.distance(a, b))
        (ma, ua, first), (mb, ub, second) = benches[a], benches[b]
        gaps = rectangles_gap(ma, ua, first[:, HALF_LENGTH:RADIUS], mb, ub, second[:, HALF_LENGTH:RADIUS])
        assert least <= gaps.min() + at.rounding


@pytest.mark.parametrize("seed", [40, 45, *thorough(*(seed for seed in range(41, 60) if seed != 45))])
def test_no_two_benches_outside_a_radius_are_closer_than_the_ring_bound(seed: int) -> None:
    rng = np.random.default_rng(seed)
    chord = 10 ** rng.uniform(-0.3, 0.5)
    head, width = chord * 10 ** rng.uniform(-0.4, 0.4), chord * 10 ** rng.uniform(-2.5, -0.4)
    overhang = rng.choice([0.0, rng.uniform(0.0, 0.3)]) * chord
    spiral = Spiral(max(1.2 * width, chord * 10 ** rng.uniform(-1.0, 0.4)), 200.0)
    dragon = Dragon(int(rng.integers(20, 70)), head + 2 * overhang, chord + 2 * overhang, width, overhang)
    search, dance = ContactSearch(dragon, spiral, 0.0), SlowDance.of(dragon, spiral)
    bounds = 0
    for radius in chord * np.geomspace(0.7, 12.0, 8):
        at = search.growth, float(radius), search.rings
        bound = kernels.ring_least(search.growth, *at) - kernels.ring_rounding(*at)
        if bound <= 0.0:
            continue
        bounds += 1
        theta = (radius + np.linspace(0.0, spiral.pitch, 9)) / spiral.growth
        times = spiral.length - spiral.growth * 0.5 * (theta * np.hypot(1.0, theta) + np.arcsinh(theta))
        assert dance.clearance(times)[0].min() >= bound
    assert bounds or search.clear_radius > 12.0 * chord
