"""Bounds on the gaps of two benches, on an interval and outside a radius, against dense samples."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import pytest

from core import Dance, Dragon, Spiral, kernels
from core.contact.search import ContactSearch
from tests.support.depth import some
from tests.support.slow_search import SlowDance, rectangles_gap

# Instants within an interval, and how many apart the second differences are taken; those are means of the derivative.
INSTANTS, APART = 121, 20
# Rounding of a projected corner, relative to the largest coordinate [1], and of a travel, relative to the way [1].
ROUNDING, ULP = 2e-14, 2.3e-16


def random_interval(rng: np.random.Generator) -> tuple[Dragon, Spiral, float, float]:
    """A dragon, a spiral, and an interval of time, close to the end of the run or further out."""
    while True:
        benches = int(rng.integers(3, 7))
        growth = 10 ** rng.uniform(-1.5, 0.3)
        chords = growth * 10 ** (rng.uniform(-0.3, 1.0) + rng.uniform(-0.5, 0.7, benches))
        if rng.random() < 0.4:
            chords[1:] = chords[1]
        overhangs, widths = chords * rng.uniform(0.0, 0.4, benches), chords * 10 ** rng.uniform(-1.5, 0.0, benches)
        if min(widths.min(), chords.min()) < 2e-3:
            continue
        dragon, spiral = Dragon.of(chords + 2 * overhangs, widths, overhangs), Spiral(2 * np.pi * growth, 30.0)
        end = Dance(dragon, spiral).end
        theta = end.theta + 10 ** rng.uniform(-3.0, 1.3)
        start = spiral.length - spiral.growth * 0.5 * (theta * np.hypot(1.0, theta) + np.arcsinh(theta))
        h = 10 ** rng.uniform(-3.0, 0.0) * chords.min()
        if start + h < end.time:
            return dragon, spiral, float(start), float(h)


def frames(dance: SlowDance, times: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Centres and directions of all benches, (T, n, 2)."""
    handles = dance.handles(times)
    return 0.5 * (handles[:, 1:] + handles[:, :-1]), -np.diff(handles, axis=1) / dance.chords[:, None]


class Sampled(NamedTuple):
    """An interval on a spiral with its bounds, and the benches at INSTANTS of it.

    half: (n, 2) half lengths and widths [m]; centres, along: (INSTANTS, n, 2); apart: of APART instants [m]
    rounding: of a coordinate [m]
    """

    scene: kernels.Scene
    interval: kernels.Interval
    sizes: np.ndarray
    motion: np.ndarray
    half: np.ndarray
    centres: np.ndarray
    along: np.ndarray
    apart: float
    rounding: float

    def distance(self, a: int, b: int) -> float:
        """Upper bound of the distance of two centres over the interval [m]."""
        at_first = float(np.linalg.norm(self.centres[0, b] - self.centres[0, a]))
        return at_first + self.interval.h * float(self.motion[[a, b], kernels.CENTRE_SPEED].sum())


def sampled(seed: int) -> Sampled:
    dragon, spiral, start, h = random_interval(np.random.default_rng(seed))
    half = 0.5 * np.stack([dragon.lengths, dragon.widths, np.hypot(dragon.lengths, dragon.widths)], axis=1)
    sizes = np.zeros((dragon.benches + 1, kernels.SIZE_COLUMNS))
    sizes[:-1] = np.column_stack([dragon.chords, half])
    motion = np.zeros((dragon.benches + 1, kernels.MOTION_COLUMNS))
    curve = kernels.spiral_curve(spiral.growth)
    scene = kernels.Scene(curve, spiral.length, kernels.Rings(), sizes, dragon.benches, 0)
    interval = kernels.Interval(scene, *np.zeros((2, dragon.benches + 1, kernels.CHAIN_COLUMNS)), motion)
    while not interval.lay_out(spiral.length - start, h, dragon.benches):  # too wide for any bound
        h *= 0.5
    times = np.linspace(start, start + h, INSTANTS)
    centres, along = frames(SlowDance.of(dragon, spiral), times)
    rounding = ROUNDING * np.abs(centres).max() + ULP * spiral.length * motion[:-1, kernels.HANDLE_SPEED].max()
    apart = APART * (times[1] - times[0])
    return Sampled(scene, interval, sizes, motion, half[:, :2], centres, along, apart, rounding)


def checked_pairs(benches: int) -> list[tuple[int, int]]:
    return [(a, b) for a in range(benches) for b in range(a + 2, benches)]


@pytest.mark.parametrize("seed", some(range(30), 12))
def test_no_two_benches_are_nearer_over_an_interval_than_their_bound(seed: int) -> None:
    at = sampled(seed)
    for a, b in checked_pairs(len(at.half)):
        least, _ = kernels.pair_least(at.scene, at.interval, a, b, 0.0, at.distance(a, b))
        first, second = ((at.centres[:, k], at.along[:, k], at.half[k : k + 1]) for k in (a, b))
        assert least <= rectangles_gap(*first, *second).min() + at.rounding


@pytest.mark.parametrize("seed", some(range(40, 60), 8))
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
