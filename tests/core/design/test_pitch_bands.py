"""Bands: bounds on the shift with the pitch against difference quotients, proofs against samples."""

import math

import numpy as np
import pytest

from core import Spiral, kernels
from core.design.pitch_bands import Bands
from core.kernels import Ended
from core.kernels.constants import MX, MY, SHIFT_CENTRE, SHIFT_CORNER, SHIFT_OMEGA, SHIFT_PULL, UX, UY
from core.shapes.rectangles import corners
from tests.campaigns.hunt_contacts import random_dragon
from tests.support.scenes import lengths_and_widths
from tests.support.searches import search_on

# Rounding of a corner's place [m], of which a second difference quotient sees four times as much over the square step.
ROUNDING = 1e-13
# Difference quotients take steps of this part of the growth; what they leave out is the square of it [1].
STEP = 1e-3


def chain(search, growth, radius, benches):
    """Clearance with the head at a radius, and the rows of the chain, in the frame in which the head is at angle 0."""
    rows = np.zeros((search.room + 1, kernels.CHAIN_COLUMNS))
    leaders = min(search.dragon.uniform_from + 1, benches)
    place = growth * kernels.spiral_arc(radius / growth)
    curve = kernels.spiral_curve(growth)
    scene = kernels.Scene(curve, place, search.rings, search.sizes, search.dragon.benches, 0)
    gap, *_ = kernels.clearance_at(scene, place, benches, leaders, rows, search.motion)
    return gap, rows[:benches]


def random_bands(seed):
    """A random dragon and circle, and two pitches at which there may or may not be room."""
    rng = np.random.default_rng(seed)
    dragon = random_dragon(rng)
    radius = dragon.chords.max() * rng.uniform(0.7, 4.0)
    turns = rng.uniform(5.0, 20.0)
    margin = rng.choice([0.0, 0.2 * dragon.chords[-1]])
    high = min(10 ** rng.uniform(0.1, 0.9) * (dragon.widths.max() + margin), 3.0 * dragon.chords.min())
    bands = Bands(search_on(dragon, Spiral(high, turns), margin), radius, turns, margin)
    return bands, high / (1.0 + 10 ** rng.uniform(-3.5, -0.5)), high


@pytest.mark.parametrize("seed", range(40))
def test_no_bench_shifts_faster_with_the_growth_than_its_bounds(seed):
    """At random growths within a band, in one short step at a random radius."""
    bands, low, high = random_bands(seed)
    search = bands.search
    rng = np.random.default_rng(seed)
    dragon = bands.search.dragon
    low, high = low / math.tau, high / math.tau
    inner = bands.radius * rng.uniform(1.0, 2.0)
    outer = inner * (1.0 + 1e-6)
    search.use(Spiral(math.tau * low, bands.start_turns), -1e3)  # no pair is within such a margin
    band = bands.march_to(high)
    result = band.run(outer, inner, min(dragon.uniform_from + 1, dragon.benches), 0.0, 0.0, 9)
    assert (result.ended, result.steps) == (kernels.Ended.REACHED, 1)  # whose bounds are there still
    moved = int(np.count_nonzero(bands.shifts[:, SHIFT_CENTRE]))
    assert moved > 2
    sizes = lengths_and_widths(dragon)[:moved]
    for growth in rng.uniform(low, high, 8):
        step = STEP * growth
        radius = rng.uniform(inner, outer)
        if not low + step < growth < high - step:
            continue
        rows = np.stack([chain(search, growth + k * step, radius, moved)[1] for k in (-1, 0, 1)])
        heading = np.unwrap(np.arctan2(rows[..., UY], rows[..., UX]), axis=0)
        middles = rows[..., MX : MY + 1]
        before, at, after = corners(np.concatenate([middles, heading[..., None]], axis=-1), sizes)
        rounding = ROUNDING / step
        for column, moves, error in (
            (SHIFT_CENTRE, (middles[2] - middles[0])[:, None] / (2 * step), rounding),
            (SHIFT_CORNER, (after - before) / (2 * step), rounding),
            (SHIFT_PULL, (after - 2 * at + before) / step**2, 4 * rounding / step),
            (SHIFT_OMEGA, (heading[2] - heading[0])[:, None, None] / (2 * step), rounding / dragon.chords.min()),
        ):
            most = bands.shifts[:moved, column] * (1.0 + 10.0 * STEP**2) + error
            assert (np.linalg.norm(moves, axis=-1).max(axis=-1) <= most).all()


# No bound holds so far out, or benches are within the margin there.
NO_BOUND = {4, 5, 9, 10, 13, 17, 21, 28, 31, 41, 42, 46, 50, 55}


@pytest.mark.parametrize("seed", range(60))
def test_nothing_touches_at_any_pitch_of_what_a_band_proves(seed):
    """At 9 x 30 samples between the two pitches, down to the radius that is reached, often not the circle."""
    bands, low, high = random_bands(seed)
    result = bands.prove(low, high, 3.0 * bands.radius)
    assert (result.proven == 3.0 * bands.radius) == (seed in NO_BOUND)
    if seed in NO_BOUND:
        return
    outer = 3.0 * bands.radius
    benches = min(bands.search.dragon.benches, bands.search.room)
    for growth in np.linspace(low, high, 9) / (math.tau):
        for radius in np.linspace(result.proven, outer, 30):
            assert chain(bands.search, growth, radius, benches)[0] > bands.margin
    if result.ended is Ended.TOUCHED:
        growth = low / (math.tau)
        gap = chain(bands.search, growth, result.touching, benches)[0]
        assert gap <= bands.margin
