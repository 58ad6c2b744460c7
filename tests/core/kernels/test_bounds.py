"""The bounds on motion along routes and spirals against dense samples: rates, turning, second and third derivatives."""

import numpy as np
import pytest

from core.kernels.constants import (
    CENTRE_PULL,
    CENTRE_SPEED,
    CORNER_PULL,
    CORNER_SPEED,
    CROSSED,
    HANDLE_SPEED,
    OMEGA,
    OMEGA_PULL,
    RADIUS,
    RATE,
    RATE_HIGH,
    RATE_JERK,
    RATE_RATE,
)
from tests.support.intervals import ROUNDING, on_route, on_spiral


@pytest.mark.parametrize("seed", range(60))
def test_no_sampled_rate_on_a_route_exceeds_its_bound(seed):
    at = on_route(seed)
    handles = at.motion[1:].T
    smooth = handles[CROSSED] == 0.0
    rate = at.chains[:, :, RATE]
    assert (rate >= 0.0).all()
    climb = at.differences(rate)[:, 1:]
    stride = at.stride * at.step
    slack = 2.0 * ROUNDING / stride
    for values, bounds, rounding in (
        (rate[:, 1:], handles[RATE_HIGH], ROUNDING),
        (np.maximum(rate[:, 1:], rate[:, :-1]), at.motion[:-1, HANDLE_SPEED], ROUNDING),
        (climb, handles[RATE_RATE], slack),
        (at.differences(climb)[:, smooth], handles[RATE_JERK, smooth], 2.0 * slack / stride),
    ):
        assert (np.abs(values).max(axis=0) <= bounds + rounding).all()


@pytest.mark.parametrize("sample, seed", [*((on_spiral, k) for k in range(40)), *((on_route, k) for k in range(60))])
def test_no_sampled_motion_exceeds_its_bound(sample, seed):
    at = sample(seed)
    bounds = at.motion[:-1].T
    stride = at.stride * at.step
    swayed = 2.0 * at.rounding / at.dragon.chords
    radii = at.sizes[:-1, RADIUS]
    for places, speed, pull, rounding in (
        (at.centres, CENTRE_SPEED, CENTRE_PULL, at.rounding),
        (at.along, OMEGA, OMEGA_PULL, swayed),
        (at.centres + radii * at.along, CORNER_SPEED, CORNER_PULL, at.rounding + radii * swayed),
    ):
        velocity = at.differences(places)
        assert (np.abs(velocity).max(axis=0) <= bounds[speed] + 2.0 * rounding / stride).all()
        assert (np.abs(at.differences(velocity)).max(axis=0) <= bounds[pull] + 4.0 * rounding / stride**2).all()
