"""The bounds on motion along routes against dense samples: rates, turning, second and third derivatives."""

from __future__ import annotations

import numpy as np
import pytest

from core import Dance, Dragon, Route, kernels
from core.kernels.constants import (
    CENTRE_PULL,
    CENTRE_SPEED,
    CHAIN_COLUMNS,
    CORNER_PULL,
    CORNER_SPEED,
    CROSSED,
    HANDLE_SPEED,
    MOTION_COLUMNS,
    OMEGA,
    OMEGA_PULL,
    RADIUS,
    RATE,
    RATE_HIGH,
    RATE_JERK,
    RATE_RATE,
    SIZE_COLUMNS,
    TX,
    UX,
)
from tests.campaigns.rounding_sweep import ROUTES
from tests.core.paths.test_route import TURN as TURN_PATH

# Instants within an interval. Differences of a derivative are means of the next one, over APART instants.
INSTANTS, APART = 161, 8
# Rounding of a sampled rate or direction on a route some hundred metres long [1], and of coordinates there [m].
ROUNDING = 2e-13


def random_interval(rng: np.random.Generator) -> tuple[Dragon, Route, float, float]:
    """A dragon, a route, and an interval of head travel, at a joint more often than not."""
    while True:
        benches = int(rng.integers(3, 9))
        path = TURN_PATH if rng.random() < 0.2 else ROUTES[int(rng.integers(len(ROUTES)))](rng)
        chords = min(1.9 / path.sharpest[0] if path.sharpest[0] else 2.0, 3.0) * 10 ** rng.uniform(-1.0, -0.02, benches)
        if rng.random() < 0.4:
            chords[1:] = chords[1]
        overhangs, widths = chords * rng.uniform(0.0, 0.4, benches), chords * 10 ** rng.uniform(-1.0, 0.0, benches)
        dragon = Dragon.of(chords + 2 * overhangs, widths, overhangs)
        begin, end = max(Dance(dragon, path, 1.0).earliest, path.begin), Dance(dragon, path).end.time
        h = 10 ** rng.uniform(-2.0, 0.0) * chords.min()
        start = rng.uniform(begin, end)
        if path.joints and rng.random() < 0.6:
            start = rng.choice(path.joints) + rng.uniform(-0.2, 1.0) * chords.sum()
        if begin <= start and start + h < end:
            return dragon, path, float(start), float(h)


def sizes_of(dragon: Dragon) -> np.ndarray:
    sizes = np.zeros((dragon.benches + 1, SIZE_COLUMNS))
    half = 0.5 * np.stack([dragon.lengths, dragon.widths, np.hypot(dragon.lengths, dragon.widths)], axis=1)
    sizes[:-1] = np.column_stack([dragon.chords, half])
    return sizes


def laid_out(path: Route, s: float, sizes: np.ndarray) -> np.ndarray:
    chain = np.zeros((len(sizes), CHAIN_COLUMNS))
    curve = kernels.route_curve(path.table)
    kernels.place_chain(curve, -s, len(sizes) - 1, sizes, chain)
    kernels.chain_rounding(curve, len(sizes) - 1, sizes, chain)
    kernels.climbs(curve, len(sizes) - 1, sizes, chain)
    return chain


def bounded(path: Route, start: float, h: float, sizes: np.ndarray) -> tuple[np.ndarray, float]:
    """Bounds of an interval that is narrow enough for any, and its width."""
    motion = np.zeros((len(sizes), MOTION_COLUMNS))
    scene = kernels.Scene(kernels.route_curve(path.table), 0.0, kernels.Rings(), sizes, len(sizes) - 1, 0)
    while True:
        interval = kernels.Interval(scene, *(laid_out(path, s, sizes) for s in (start, start + h)), motion)
        interval.h, interval.handles = h, len(sizes) - 1
        if interval.bound(True):
            return motion, h
        h *= 0.5


def differences(values: np.ndarray, step: float) -> np.ndarray:
    """Means of the derivative over APART instants."""
    return (values[APART:] - values[:-APART]) / (APART * step)


@pytest.mark.parametrize("seed", range(60))
def test_no_sampled_derivative_on_a_route_exceeds_its_bound(seed: int) -> None:
    dragon, path, start, h = random_interval(np.random.default_rng(seed))
    sizes = sizes_of(dragon)
    motion, h = bounded(path, start, h, sizes)
    n, step = dragon.benches, h / (INSTANTS - 1)
    chains = np.array([laid_out(path, s, sizes) for s in np.linspace(start, start + h, INSTANTS)])
    rate = chains[:, :, RATE]
    assert (rate >= 0.0).all()
    assert (rate.max(axis=0)[1:] <= motion[1:, RATE_HIGH] + ROUNDING).all()
    assert (np.maximum(rate[:, 1:], rate[:, :-1]).max(axis=0) <= motion[:-1, HANDLE_SPEED] + ROUNDING).all()
    climb = differences(rate, step)
    slack = 2.0 * ROUNDING / (APART * step)
    assert (np.abs(climb).max(axis=0)[1:] <= motion[1:, RATE_RATE] + slack).all()
    jerk = differences(climb, step)
    smooth = motion[1:, CROSSED] == 0.0
    assert (np.abs(jerk).max(axis=0)[1:] <= motion[1:, RATE_JERK] + 2.0 * slack / (APART * step))[smooth].all()

    velocity = rate[..., None] * chains[:, :, TX : TX + 2]
    along = chains[:, :n, UX : UX + 2]
    apart = velocity[:, :-1] - velocity[:, 1:]
    omega = (along[..., 0] * apart[..., 1] - along[..., 1] * apart[..., 0]) / dragon.chords
    assert (np.abs(omega).max(axis=0) <= motion[:-1, OMEGA] + 2.0 * ROUNDING / dragon.chords).all()
    spin = np.abs(differences(omega, step)).max(axis=0)
    assert (spin <= motion[:-1, OMEGA_PULL] + slack / dragon.chords).all()

    centre = 0.5 * (velocity[:, 1:] + velocity[:, :-1])
    assert (np.linalg.norm(centre, axis=-1).max(axis=0) <= motion[:-1, CENTRE_SPEED] + ROUNDING).all()
    pull = np.linalg.norm(differences(centre, step), axis=-1).max(axis=0)
    assert (pull <= motion[:-1, CENTRE_PULL] + slack).all()
    corner = centre + (omega * sizes[:-1, RADIUS])[..., None] * np.stack([-along[..., 1], along[..., 0]], axis=-1)
    assert (np.linalg.norm(corner, axis=-1).max(axis=0) <= motion[:-1, CORNER_SPEED] + ROUNDING).all()
    pull = np.linalg.norm(differences(corner, step), axis=-1).max(axis=0)
    assert (pull <= motion[:-1, CORNER_PULL] + slack * (1.0 + 2.0 * sizes[:-1, RADIUS] / dragon.chords)).all()
