"""Bands: bounds on the shift with the pitch against difference quotients, proofs against samples and the reference."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from core import Dragon, Spiral, kernels
from core.contact.search import ContactSearch
from core.design.pitch_bands import Bands
from core.kernels import Ended
from core.kernels.constants import MX, MY, SHIFT_CENTRE, SHIFT_CORNER, SHIFT_OMEGA, SHIFT_PULL, UX, UY
from core.values import Floats
from tests.support.reference import reference

CASES = reference("minimum_pitch")["cases"]
GRAZES = [case for case in CASES if case["limited_by"] != "start"]
# Pitches are promised to this [m].
ACCURACY = 1e-9
# Rounding of a corner's place [m], of which a second difference quotient sees four times as much over the square step.
ROUNDING = 1e-13
# Difference quotients take steps of this part of the growth; what they leave out is the square of it [1].
STEP = 1e-3


def chain(search: ContactSearch, growth: float, radius: float, benches: int) -> tuple[float, Floats]:
    """Clearance with the head at a radius, and the rows of the chain, in the frame in which the head is at angle 0."""
    rows = np.zeros((search.room + 1, kernels.CHAIN_COLUMNS))
    leaders = min(search.dragon.uniform_from + 1, benches)
    place = growth * kernels.spiral_arc(radius / growth)
    curve = kernels.spiral_curve(growth)
    scene = kernels.Scene(curve, place, search.rings, search.sizes, search.dragon.benches, 0)
    gap, *_ = kernels.clearance_at(scene, place, benches, leaders, rows, search.motion)
    return gap, rows[:benches]


def corners(dragon: Dragon, rows: Floats) -> Floats:
    """(n, 4, 2) [m]"""
    along = rows[:, UX : UY + 1]
    left = np.stack([-along[:, 1], along[:, 0]], axis=-1)
    half = 0.5 * np.stack([dragon.lengths[: len(rows)], dragon.widths[: len(rows)]], axis=-1)
    signs = ((1, 1), (1, -1), (-1, -1), (-1, 1))
    return np.stack(
        [rows[:, MX : MY + 1] + f * half[:, :1] * along + s * half[:, 1:] * left for f, s in signs],
        axis=1,
    )


def random_bands(seed: int) -> tuple[Bands, float, float]:
    """A random dragon and circle, and two pitches at which there may or may not be room."""
    rng = np.random.default_rng(seed)
    chord = 10 ** rng.uniform(-0.3, 0.5)
    chords = chord * np.array([10 ** rng.uniform(-0.4, 0.3), *rng.uniform(0.8, 1.2, int(rng.integers(0, 4))), 1.0])
    overhang, width = chord * rng.uniform(0.0, 0.3), chord * 10 ** rng.uniform(-1.5, -0.4)
    lengths = np.append(chords, np.full(int(rng.integers(5, 60)), chord)) + 2 * overhang
    dragon = Dragon.of(lengths, np.full(lengths.size, width), np.full(lengths.size, overhang))
    radius, turns = chords.max() * rng.uniform(0.7, 4.0), rng.uniform(5.0, 20.0)
    margin = rng.choice([0.0, 0.2 * chord])
    high = min(10 ** rng.uniform(0.1, 0.9) * (width + margin), 3.0 * chords.min())
    bands = Bands(ContactSearch(dragon, Spiral(high, turns), margin), radius, turns, margin)
    return bands, high / (1.0 + 10 ** rng.uniform(-3.5, -0.5)), high


@pytest.mark.parametrize("seed", range(40))
def test_no_bench_shifts_faster_with_the_growth_than_its_bounds(seed: int) -> None:
    """At random growths within a band, in one short step at a random radius."""
    bands, low, high = random_bands(seed)
    search, rng = bands.search, np.random.default_rng(seed)
    low, high = low / (2 * math.pi), high / (2 * math.pi)
    inner = bands.radius * rng.uniform(1.0, 2.0)
    outer = inner * (1.0 + 1e-6)
    leaders = min(search.dragon.uniform_from + 1, search.dragon.benches)
    search.use(Spiral(2 * math.pi * low, bands.start_turns), -1e3)  # no pair is within such a margin
    band = bands.march_to(high)
    assert band.run(outer, inner, leaders, 0.0, 0.0, 9) is kernels.Ended.REACHED
    assert band.result().steps == 1  # whose bounds are there still
    moved = int(np.count_nonzero(bands.shifts[:, SHIFT_CENTRE]))
    assert moved > 2
    for growth in rng.uniform(low, high, 8):
        step = STEP * growth
        radius = rng.uniform(inner, outer)
        rows = np.stack([chain(search, growth + k * step, radius, moved)[1] for k in (-1, 0, 1)])
        places = np.stack([corners(search.dragon, row) for row in rows])
        slack = 1.0 + 10.0 * STEP**2
        within = np.abs(growth - low) > step and np.abs(growth - high) > step
        if not within:
            continue
        centre = np.linalg.norm(rows[2, :, MX : MY + 1] - rows[0, :, MX : MY + 1], axis=-1) / (2 * step)
        corner = np.linalg.norm(places[2] - places[0], axis=-1).max(-1) / (2 * step)
        pull = np.linalg.norm(places[2] - 2 * places[1] + places[0], axis=-1).max(-1) / step**2
        heading = np.unwrap(np.arctan2(rows[:, :, UY], rows[:, :, UX]), axis=0)
        turn = np.abs(heading[2] - heading[0]) / (2 * step)
        bounds = bands.shifts[:moved]
        rounding = ROUNDING / step
        assert (centre <= bounds[:, SHIFT_CENTRE] * slack + rounding).all()
        assert (corner <= bounds[:, SHIFT_CORNER] * slack + rounding).all()
        assert (pull <= bounds[:, SHIFT_PULL] * slack + 4 * rounding / step).all()
        assert (turn <= bounds[:, SHIFT_OMEGA] * slack + rounding / search.dragon.chords.min()).all()


# No bound holds so far out.
NO_BOUND = {17, 29, 33, 47}


@pytest.mark.parametrize("seed", range(60))
def test_nothing_touches_at_any_pitch_of_what_a_band_proves(seed: int) -> None:
    """At 9 x 30 samples between the two pitches, down to the radius that is reached, often not the circle."""
    bands, low, high = random_bands(seed)
    state, result = bands.prove(low, high, 3.0 * bands.radius)
    assert (state is Ended.UNBOUNDED and not result.steps) == (seed in NO_BOUND)
    if seed in NO_BOUND:
        return
    outer = max(3.0 * bands.radius, result.proven)
    benches = min(bands.search.dragon.benches, bands.search.room)
    for growth in np.linspace(low, high, 9) / (2 * math.pi):
        for radius in np.linspace(result.proven, outer, 30):
            assert chain(bands.search, growth, radius, benches)[0] > bands.margin
    if state is Ended.TOUCHED:
        growth = low / (2 * math.pi)
        gap = chain(bands.search, growth, result.touching, benches)[0]
        assert gap <= bands.margin


def bands_of(case: dict[str, Any]) -> Bands:
    dragon, radius = Dragon(**case["dragon"]), case["turning_diameter"] / 2
    return Bands(ContactSearch(dragon, Spiral(1.0, case["start_turns"]), 0.0), radius, case["start_turns"], 0.0)


@pytest.mark.parametrize("case", GRAZES, ids=[case["name"] for case in GRAZES])
def test_a_band_is_proven_just_above_a_minimum_and_not_across_it(case: dict[str, Any]) -> None:
    bands, pitch = bands_of(case), case["pitch"]
    assert bands.prove(pitch + ACCURACY, pitch + 1e-6, math.inf)[0] is Ended.REACHED
    for below, above in ((ACCURACY, ACCURACY), (ACCURACY, 1e-4), (1e-4, 1e-3)):
        assert bands.prove(pitch - below, pitch + above, math.inf)[0] in (Ended.STUCK, Ended.TOUCHED)


def test_a_band_from_an_island_to_the_minimum_is_not_proven() -> None:
    """Ways with 16 turns are clear at both of its ends, not between them."""
    [case] = [case for case in CASES if case["other_feasible_intervals"]]
    bands, [[start, end]] = bands_of(case), case["other_feasible_intervals"]
    for low in np.linspace(start, end - ACCURACY, 5):
        assert bands.prove(low, case["pitch"] + ACCURACY, case["pitch"] * case["start_turns"])[0] is not Ended.REACHED


@pytest.mark.parametrize("seed", range(30))
def test_benches_of_a_short_dragon_are_no_closer_than_the_ring_bound(seed: int) -> None:
    """The dragons go around less than once, also at pitches below the width of a bench."""
    rng = np.random.default_rng(seed)
    dragon = Dragon(int(rng.integers(3, 12)), 2.2, rng.uniform(1.4, 2.2), rng.uniform(0.1, 0.5), rng.uniform(0.0, 0.3))
    bands = Bands(ContactSearch(dragon, Spiral(0.3, 16.0), 0.0), 3.0, 16.0, 0.0)
    search, bounds = bands.search, 0
    for growth in np.geomspace(0.01, 0.2, 8):
        for radius in np.linspace(1.5, 8.0, 12):
            bound = kernels.ring_least(growth, growth, radius, search.rings, bands.straight.total)
            bounds += bound > 0.0
            assert chain(search, growth, radius, dragon.benches)[0] >= bound
    assert bounds
