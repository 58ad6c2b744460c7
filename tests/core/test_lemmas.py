"""The lemmas under the searches, each against dense random samples of what it claims."""

import math

import numpy as np

# Rounding of a distance beside its lower bound, relative [1].
ROUNDING = 1e-12


def test_points_of_two_rings_are_apart_by_the_bound_wherever_they_stand_to_each_other():
    """The radial gap G + growth x may be negative: core/kernels/rings.py."""
    rng = np.random.default_rng(7)
    count = 400_000
    growth, rho = 10 ** rng.uniform(-2.0, 1.0, count), 10 ** rng.uniform(-1.0, 1.5, count)
    gap = 2.0 * math.pi * growth * rng.uniform(0.0, 1.0, count)
    x = rng.uniform(-math.pi, math.pi, count)
    radial = gap + growth * x
    assert (radial < 0.0).mean() > 0.05

    def further():
        """Zero or more, as often as not [1]."""
        return rng.exponential(0.3, count) * rng.integers(0, 2, count)

    inner = rho * (1.0 + further())
    outer = np.maximum(inner + radial + further() * rho, rho)  # the bound assumes of the radii only that both reach rho
    distance = np.sqrt((outer - inner) ** 2 + 4.0 * outer * inner * np.sin(0.5 * x) ** 2)
    assert (distance >= gap / np.sqrt(1.0 + (0.5 * math.pi * growth / rho) ** 2) * (1.0 - ROUNDING)).all()
