"""The lemma under the ring bound, against dense random samples of what it claims."""

import math

import numpy as np

# Rounding of a distance beside its lower bound, relative [1].
ROUNDING = 1e-12


def test_points_of_two_rings_are_apart_by_the_bound_wherever_they_stand_to_each_other():
    """The radial gap G + growth x may be negative, and of the radii only that both reach rho: core/kernels/rings.py."""
    rng = np.random.default_rng(7)
    count = 400_000
    growth, rho = 10 ** rng.uniform([[-2.0], [-1.0]], [[1.0], [1.5]], (2, count))
    gap = 2.0 * math.pi * growth * rng.random(count)
    x = rng.uniform(-math.pi, math.pi, count)
    inner = rho * (1.0 + rng.exponential(0.3, count) * rng.integers(0, 2, count))
    outer = np.maximum(inner + gap + growth * x, rho)
    distance = np.abs(outer - inner * np.exp(1j * x))
    assert (distance >= gap / np.sqrt(1.0 + (0.5 * math.pi * growth / rho) ** 2) * (1.0 - ROUNDING)).all()
