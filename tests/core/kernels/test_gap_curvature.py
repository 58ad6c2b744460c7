"""Bounds on the bend of gaps along axes of a bench, on spirals and routes, against differences of dense samples."""

import numpy as np
import pytest

from core import Dragon, Spiral
from core.kernels import axis_curvature, pair_curvatures, shift_curvature
from core.kernels.constants import (
    CENTRE_PULL,
    CENTRE_SPEED,
    CORNER_PULL,
    CORNER_SPEED,
    CURVATURE_HIGH,
    CURVATURE_LOW,
    HALF_LENGTH,
    MOTION_COLUMNS,
    MX,
    MY,
    OMEGA,
    OMEGA_LOW,
    OMEGA_PULL,
    OMEGA_RATE,
    RADIUS,
    RATE_HIGH,
    RATE_LOW,
    RATE_RATE,
    SHIFT_COLUMNS,
    SHIFT_CORNER,
    SHIFT_OMEGA,
    SHIFT_PULL,
    SIZE_COLUMNS,
    THETA_HIGH,
    THETA_LOW,
)
from tests.support.depth import some
from tests.support.intervals import checked_pairs, on_route, on_spiral
from tests.support.searches import search_on

# Directions of axes fixed in a bench, from its length [rad].
AXES = (0.0, 0.7, 0.5 * np.pi, 2.5)


def bend(at, i, j):
    """Largest second difference quotient, over these instants, of a corner of bench j along axes of bench i [1/m]."""
    (x, y), most = at.sizes[j, HALF_LENGTH:RADIUS], 0.0
    for corner in (x + 1j * y, x - 1j * y, -x - 1j * y, -x + 1j * y):
        seen = (at.centres[:, j] + corner * at.along[:, j] - at.centres[:, i]) * at.along[:, i].conj()
        gaps = (seen[:, None] * np.exp(-1j * np.array(AXES))).real
        most = max(most, float(np.abs(at.differences(at.differences(gaps))).max()))
    return most


@pytest.mark.parametrize(
    "sample, seed",
    [*((on_spiral, seed) for seed in some(range(30), 12)), *((on_route, seed) for seed in range(100, 130))],
)
def test_gaps_along_body_axes_bend_no_more_than_their_bound(sample, seed):
    at = sample(seed)
    growth = at.path.growth if isinstance(at.path, Spiral) else 1.0
    rounding = 4.0 * at.rounding / (at.stride * at.step) ** 2
    for pair in checked_pairs(at.dragon.benches):
        for i, j in (pair, pair[::-1]):
            bound = axis_curvature(growth, i, j, at.distance(i, j), at.sizes, at.motion)
            assert bend(at, i, j) <= bound + rounding


def worst_bend(turn, speed, pull, reach, step=1e-3):
    """Second difference quotient of a gap whose axis turns, while a corner moves across it and is pulled along it."""
    times = np.array([-step, 0.0, step])
    gap = (0.5 * pull * times**2 - reach) * np.cos(turn * times) + speed * times * np.sin(turn * times)
    return float((gap[2] - 2.0 * gap[1] + gap[0]) / step**2)


def test_a_gap_bends_as_much_as_its_bound_where_everything_moves_as_badly_as_it_may():
    """In time, and across growths."""
    turn, speeds, pulls, distance, radii = 0.7, (1.1, 1.6), (0.4, 0.9), 3.0, (0.5, 0.8)
    motion, shifts, sizes = (np.zeros((3, columns)) for columns in (MOTION_COLUMNS, SHIFT_COLUMNS, SIZE_COLUMNS))
    motion[0, [OMEGA, OMEGA_PULL, CENTRE_SPEED, CENTRE_PULL]] = turn, turn**2, speeds[0], pulls[0]
    motion[2, [CORNER_SPEED, CORNER_PULL]] = speeds[1], pulls[1]
    shifts[[0, 2], SHIFT_CORNER], shifts[[0, 2], SHIFT_PULL], shifts[0, SHIFT_OMEGA] = speeds, pulls, turn
    sizes[[0, 2], RADIUS] = radii
    for bound, reach in (
        (axis_curvature(1.0, 0, 2, distance, sizes, motion), distance + radii[1]),
        (shift_curvature(0, 2, distance, sizes, shifts), distance + sum(radii)),
    ):
        assert worst_bend(turn, sum(speeds), sum(pulls), reach) == pytest.approx(bound, rel=1e-5)


# As the derivation in gap_curvature.py, written down a second time with numpy, gave them on 2026-11-29 [1/m].
TURNING = [2.1377410196121263, 1.7776693484931232, 1.6244083083577288, 1.473346494985162, 1.7463799039409755]


@pytest.mark.parametrize("seed", range(len(TURNING)))
def test_a_bound_has_every_term_of_its_derivation(seed):
    random = np.random.default_rng(seed)
    motion = np.zeros((8, MOTION_COLUMNS))
    sizes = np.zeros((8, SIZE_COLUMNS))
    for low, high, least, most in (
        (RATE_LOW, RATE_HIGH, 0.9, 1.0),
        (THETA_LOW, THETA_HIGH, 40.0, 60.0),
        (CURVATURE_LOW, CURVATURE_HIGH, 0.015, 0.025),
        (OMEGA_LOW, OMEGA, 0.18, 0.25),
    ):
        motion[:, [low, high]] = np.sort(random.uniform(least, most, (8, 2)), axis=1)
    motion[:, [RATE_RATE, OMEGA_RATE]] = random.uniform(0.1, 0.3, (8, 2))
    motion[:, OMEGA_PULL] = sizes[:, RADIUS] = 1.1  # the bound in the resting frame is the larger one
    assert axis_curvature(0.09, 1, 5, 2.5, sizes, motion) == pytest.approx(TURNING[seed], rel=1e-12)


def test_bounds_on_a_pair_reach_as_far_as_its_centres_may_move():
    search = search_on(Dragon(12), Spiral())
    h = 0.25
    pair = (0, 9)
    result = pair_curvatures(search.scene, search.probe, search.place - 400.0, h, *pair)
    first, second = search.probed[pair, MX] + 1j * search.probed[pair, MY]
    distance = float(abs(second - first) + h * search.motion[pair, CENTRE_SPEED].sum())
    assert result == pytest.approx(
        [axis_curvature(search.growth, *each, distance, search.sizes, search.motion) for each in (pair, pair[::-1])],
        rel=1e-12,
    )
