"""Bounds on the bend of gaps along axes of a bench, on spirals and routes, against differences of dense samples."""

from __future__ import annotations

import numpy as np
import pytest

from core import Dragon, Spiral, kernels
from core.contact.search import ContactSearch
from core.kernels.constants import (
    CENTRE_PULL,
    CENTRE_SPEED,
    CORNER_PULL,
    CORNER_SPEED,
    CURVATURE_HIGH,
    CURVATURE_LOW,
    HALF_LENGTH,
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
    SHIFT_CORNER,
    SHIFT_OMEGA,
    SHIFT_PULL,
    THETA_HIGH,
    THETA_LOW,
    UX,
    UY,
)
from tests.core.kernels import test_bounds as route
from tests.core.kernels.test_pairs import APART, checked_pairs, sampled
from tests.support.depth import some

# Directions of axes fixed in a bench, from its length [rad].
AXES = (0.0, 0.7, 0.5 * np.pi, 2.5)


def bend(centres: np.ndarray, along: np.ndarray, half: np.ndarray, pair: tuple[int, int], apart: int) -> float:
    """Largest second difference, over these instants, of a corner of the second bench along axes of the first [m]."""
    i, j = pair
    left = np.stack([-along[..., 1], along[..., 0]], axis=-1)
    most = 0.0
    for front, side in ((1, 1), (1, -1), (-1, -1), (-1, 1)):
        corner = centres[:, j] + front * half[j, 0] * along[:, j] + side * half[j, 1] * left[:, j] - centres[:, i]
        x, y = (corner * along[:, i]).sum(-1), (corner * left[:, i]).sum(-1)
        for axis in AXES:
            gap = np.cos(axis) * x + np.sin(axis) * y
            most = max(most, float(np.abs(gap[2 * apart :] - 2 * gap[apart:-apart] + gap[: -2 * apart]).max()))
    return most


@pytest.mark.parametrize("seed", some(range(30), 12))
def test_gaps_along_body_axes_bend_no_more_than_their_bound(seed: int) -> None:
    at = sampled(seed)
    for a, b in checked_pairs(len(at.half)):
        for i, j in ((a, b), (b, a)):
            bound = kernels.axis_curvature(at.scene.curve.growth, i, j, at.distance(a, b), at.sizes, at.motion)
            result = bend(at.centres, at.along, at.half, (i, j), APART)
            assert result <= bound * at.apart**2 + 4.0 * at.rounding


@pytest.mark.parametrize("seed", range(100, 130))
def test_gaps_along_body_axes_on_a_route_bend_no_more_than_their_bound(seed: int) -> None:
    dragon, path, start, h = route.random_interval(np.random.default_rng(seed))
    sizes = route.sizes_of(dragon)
    motion, h = route.bounded(path, start, h, sizes)
    chains = np.array([route.laid_out(path, s, sizes) for s in np.linspace(start, start + h, route.INSTANTS)])
    centres, along = (chains[:, :-1, [x, y]] for x, y in ((MX, MY), (UX, UY)))
    rounding = 4.0 * route.ROUNDING * (1.0 + np.abs(centres).max())
    apart = route.APART * h / (route.INSTANTS - 1)
    for a, b in checked_pairs(dragon.benches):
        for i, j in ((a, b), (b, a)):
            distance = np.linalg.norm(centres[0, j] - centres[0, i]) + h * motion[[i, j], CENTRE_SPEED].sum()
            bound = kernels.axis_curvature(1.0, i, j, float(distance), sizes, motion)
            result = bend(centres, along, sizes[:, HALF_LENGTH:RADIUS], (i, j), route.APART)
            assert result <= bound * apart**2 + rounding


def worst_bend(turn: float, speed: float, pull: float, reach: float, step: float = 1e-3) -> float:
    """Second difference quotient of a gap whose axis turns, while a corner moves across it and is pulled along it."""
    times = np.array([-step, 0.0, step])
    gap = (0.5 * pull * times**2 - reach) * np.cos(turn * times) + speed * times * np.sin(turn * times)
    return float((gap[2] - 2.0 * gap[1] + gap[0]) / step**2)


def test_a_gap_bends_as_much_as_its_bound_where_everything_moves_as_badly_as_it_may() -> None:
    turn, centre, corner, pulls, distance, radius = 0.7, 1.1, 1.6, (0.4, 0.9), 3.0, 0.5
    motion, sizes = np.zeros((3, kernels.MOTION_COLUMNS)), np.zeros((3, kernels.SIZE_COLUMNS))
    motion[0, [OMEGA, OMEGA_PULL, CENTRE_SPEED, CENTRE_PULL]] = turn, turn**2, centre, pulls[0]
    motion[2, [CORNER_SPEED, CORNER_PULL]], sizes[2, RADIUS] = (corner, pulls[1]), radius
    reached = worst_bend(turn, centre + corner, sum(pulls), distance + radius)
    assert reached == pytest.approx(kernels.axis_curvature(1.0, 0, 2, distance, sizes, motion), rel=1e-5)


def test_a_gap_bends_across_growths_as_much_as_its_bound_where_benches_shift_as_badly_as_they_may() -> None:
    turn, corners, pulls, distance, radii = 0.7, (1.1, 1.6), (0.4, 0.9), 3.0, (0.5, 0.8)
    shifts, sizes = np.zeros((3, kernels.SHIFT_COLUMNS)), np.zeros((3, kernels.SIZE_COLUMNS))
    shifts[[0, 2], SHIFT_CORNER], shifts[[0, 2], SHIFT_PULL], shifts[0, SHIFT_OMEGA] = corners, pulls, turn
    sizes[[0, 2], RADIUS] = radii
    reached = worst_bend(turn, sum(corners), sum(pulls), distance + sum(radii))
    assert reached == pytest.approx(kernels.shift_curvature(0, 2, distance, sizes, shifts), rel=1e-5)


def worst(a: np.ndarray, b: np.ndarray) -> float:
    """The largest difference between a number in one range (low, high) and a number in another."""
    return float(np.abs(a[:, None] - b).max())


def turning_bound(growth: float, i: int, j: int, reach: float, radius: float, motion: np.ndarray) -> float:
    """K against the rotation of bench i, term by term as its derivation in gap_curvature.py has it [1/m]."""
    omega, other = motion[i, [OMEGA_LOW, OMEGA]], motion[j, [OMEGA_LOW, OMEGA]]
    slips, pulls = [], []
    for row in motion[[i, i + 1, j, j + 1]]:
        rate, r = row[[RATE_LOW, RATE_HIGH]], growth * row[[THETA_LOW, THETA_HIGH]]
        curvature = row[[CURVATURE_LOW, CURVATURE_HIGH]] / growth
        slips.append(worst(rate, omega * r) + omega[1] * growth)
        pulls.append(row[RATE_RATE] + worst(curvature * rate**2, omega**2 * r) + omega[1] ** 2 * growth)
    slip = sum(slips) / 2 + worst(omega, other) * radius
    pull = sum(pulls) / 2 + (worst(omega**2, other**2) + motion[j, OMEGA_RATE]) * radius
    return float(pull + 2 * omega[1] * slip + motion[i, OMEGA_RATE] * reach)


@pytest.mark.parametrize("seed", range(20))
def test_a_bound_has_every_term_of_its_derivation(seed: int) -> None:
    random, growth, distance, radius = np.random.default_rng(seed), 0.09, 2.5, 1.1
    motion, sizes = np.zeros((8, kernels.MOTION_COLUMNS)), np.zeros((8, kernels.SIZE_COLUMNS))
    sizes[:, RADIUS] = radius
    for low, high, least, most in (
        (RATE_LOW, RATE_HIGH, 0.9, 1.0),
        (THETA_LOW, THETA_HIGH, 40.0, 60.0),
        (CURVATURE_LOW, CURVATURE_HIGH, 0.015, 0.025),
        (OMEGA_LOW, OMEGA, 0.18, 0.25),
    ):
        motion[:, [low, high]] = np.sort(random.uniform(least, most, (8, 2)), axis=1)
    motion[:, [RATE_RATE, OMEGA_RATE]] = random.uniform(0.1, 0.3, (8, 2))
    turning = turning_bound(growth, 1, 5, distance + radius, radius, motion)
    motion[:, OMEGA_PULL] = turning  # the bound in the resting frame is then the larger one
    assert kernels.axis_curvature(growth, 1, 5, distance, sizes, motion) == pytest.approx(turning, rel=1e-12)


def test_bounds_on_a_pair_reach_as_far_as_its_centres_may_move() -> None:
    search = ContactSearch(Dragon(12), Spiral(), 0.0)
    place, h, (a, b) = search.place - 400.0, 0.25, (0, 9)
    result = kernels.pair_curvatures(search.scene, search.probe, place, h, a, b)
    centres, motion = search.probed[:, [MX, MY]], search.motion
    distance = np.linalg.norm(centres[b] - centres[a]) + h * motion[[a, b], CENTRE_SPEED].sum()
    for pair, bound in zip(((a, b), (b, a)), result, strict=True):
        assert bound == pytest.approx(
            kernels.axis_curvature(search.growth, *pair, float(distance), search.sizes, motion), rel=1e-12
        )
