"""Random intervals of head travel on spirals and routes: their bounds, and the dragon at many instants of them."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from core import Dance, Dragon, Route, Spiral
from core.kernels import Interval, Rings, Scene, chain_rounding, climbs, place_chain, route_curve, spiral_curve
from core.kernels.constants import (
    CENTRE_SPEED,
    CHAIN_COLUMNS,
    HANDLE_SPEED,
    MOTION_COLUMNS,
    MX,
    MY,
    SIZE_COLUMNS,
    UX,
    UY,
)
from core.values import Floats
from tests.campaigns.rounding_sweep import random_dragon, random_path
from tests.support.slow_search import SlowDance, arc_length

# Rounding on routes: of a rate or direction on one some hundred metres long [1], and of coordinates there [m]; on
# spirals: of a projected corner, relative to the largest coordinate [1], and of a travel, relative to the way [1].
ROUNDING = 2e-13
CORNER = 2e-14
ULP = 2.3e-16


class Sampled(NamedTuple):
    """An interval on a path with its bounds, and the benches at instants `step` [m] apart, as complex numbers.

    sizes, motion: as the kernels have them; centres [m], along [1]: (T, n); rounding: of a coordinate [m]
    chains: (T, n + 1, columns), on a route; stride: instants over which differences are taken, which are means of the
    derivative
    """

    dragon: Dragon
    path: Spiral | Route
    interval: Interval
    sizes: Floats
    motion: Floats
    centres: NDArray[np.complex128]
    along: NDArray[np.complex128]
    step: float
    stride: int
    rounding: float
    chains: Floats = np.empty((0, 0, 0))

    def differences(self, values):
        """Difference quotients over the stride."""
        return (values[self.stride :] - values[: -self.stride]) / (self.stride * self.step)

    def distance(self, a, b):
        """Upper bound of the distance of two centres over the interval [m]."""
        speeds = self.motion[[a, b], CENTRE_SPEED]
        return float(abs(self.centres[0, b] - self.centres[0, a]) + self.interval.h * speeds.sum())


def sizes_of(dragon):
    """The sizes of a dragon as the kernels have them, (n + 1, columns)."""
    sizes = np.zeros((dragon.benches + 1, SIZE_COLUMNS))
    half = 0.5 * np.stack([dragon.lengths, dragon.widths, np.hypot(dragon.lengths, dragon.widths)], axis=1)
    sizes[:-1] = np.column_stack([dragon.chords, half])
    return sizes


def checked_pairs(benches):
    return [(a, b) for a in range(benches) for b in range(a + 2, benches)]


def on_spiral(seed):
    """Close to the end of the run or further out; places by the slow search."""
    rng = np.random.default_rng(seed)
    while True:
        benches = int(rng.integers(3, 7))
        growth = 10 ** rng.uniform(-1.5, 0.3)
        dragon = random_dragon(rng, benches, max(growth * 10 ** rng.uniform(-0.1, 1.7), 0.02))
        spiral = Spiral(2 * np.pi * growth, 30.0)
        end = Dance(dragon, spiral).end
        theta = end.theta + 10 ** rng.uniform(-3.0, 1.3)
        start = spiral.length - spiral.growth * arc_length(theta)
        h = 10 ** rng.uniform(-3.0, 0.0) * dragon.chords.min()
        if start + h < end.time:
            break
    sizes = sizes_of(dragon)
    motion = np.zeros((benches + 1, MOTION_COLUMNS))
    scene = Scene(spiral_curve(spiral.growth), spiral.length, Rings(), sizes, benches, 0)
    interval = Interval(scene, *np.zeros((2, benches + 1, CHAIN_COLUMNS)), motion)
    while not interval.lay_out(spiral.length - start, h, benches):  # too wide for any bound
        h *= 0.5
    times, step = np.linspace(start, start + h, 121, retstep=True)
    handles = SlowDance.of(dragon, spiral).handles(times) @ [1.0, 1.0j]
    centres = 0.5 * (handles[:, 1:] + handles[:, :-1])
    along = -np.diff(handles, axis=1) / dragon.chords
    rounding = CORNER * np.abs(centres).max() + ULP * spiral.length * motion[:, HANDLE_SPEED].max()
    return Sampled(dragon, spiral, interval, sizes, motion, centres, along, float(step), 20, rounding)


def on_route(seed):
    """At a joint more often than not."""
    rng = np.random.default_rng(seed)
    while True:
        benches = int(rng.integers(3, 9))
        path = random_path(rng)
        longest = min(1.9 / path.sharpest[0] if path.sharpest[0] else 2.0, 3.0)
        dragon = random_dragon(rng, benches, longest * 10 ** rng.uniform(-0.4, -0.02))
        begin = max(Dance(dragon, path, 1.0).earliest, path.begin)
        end = Dance(dragon, path).end.time
        h = 10 ** rng.uniform(-2.0, 0.0) * dragon.chords.min()
        start = rng.uniform(begin, end)
        if path.joints and rng.random() < 0.6:
            start = rng.choice(path.joints) + rng.uniform(-0.2, 1.0) * dragon.chords.sum()
        if begin <= start and start + h < end:
            break
    curve = route_curve(path.table)
    sizes = sizes_of(dragon)
    motion = np.zeros((benches + 1, MOTION_COLUMNS))

    def laid_out(s):
        chain = np.zeros((benches + 1, CHAIN_COLUMNS))
        place_chain(curve, -s, benches, sizes, chain)
        chain_rounding(curve, benches, sizes, chain)
        climbs(curve, benches, sizes, chain)
        return chain

    scene = Scene(curve, 0.0, Rings(), sizes, benches, 0)
    while True:
        interval = Interval(scene, laid_out(start), laid_out(start + h), motion)
        interval.h = h
        interval.handles = benches
        if interval.bound(True):
            break
        h *= 0.5
    places, step = np.linspace(start, start + h, 161, retstep=True)
    chains = np.array([laid_out(s) for s in places])
    centres, along = (chains[:, :-1, [x, y]] @ [1.0, 1.0j] for x, y in ((MX, MY), (UX, UY)))
    rounding = ROUNDING * (1.0 + np.abs(centres).max())
    return Sampled(dragon, path, interval, sizes, motion, centres, along, float(step), 8, rounding, chains)
