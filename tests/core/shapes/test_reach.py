"""The ground of a bench: every place lies in it, and it is hardly larger than all places."""

import numpy as np
import pytest

from core import Dragon
from core.kernels.constants import DIRECTIONS
from core.shapes.reach import SIZES_MAX, bench_hulls, directions, gains, reach, supports
from tests.support.depth import examples, thorough
from tests.support.random_strays import moved_points, random_strays
from tests.support.refused import refused

ROUNDING = 1e-11  # [m]
TIGHT = 1e-3  # supports exceed what places reach by at most this of the stray [1]
# Chord, overhang, half width and stray [m].
SHAPES = pytest.mark.parametrize(
    "chord, overhang, half_width, stray",
    [
        *((1.65, 0.275, 0.15, 0.05), (2.86, 0.275, 0.15, 0.26)),
        *thorough((1.65, 0.275, 0.15, 0.82), (1.0, 0.0, 0.1, 0.3)),
    ],
    ids=["body", "head", "half a chord", "no overhang"],
)


def outline(chord, overhang, half_width):
    half = 0.5 * chord
    x = [*np.linspace(-half - overhang, half + overhang, 25), -half, half]
    return np.stack([x + x, np.repeat([-half_width, half_width], len(x))], axis=-1)


@SHAPES
def test_every_place_lies_in_one_of_the_hulls(chord, overhang, half_width, stray):
    hulls = bench_hulls(supports(chord, overhang, half_width, stray))
    planes = (hulls * directions()).sum(axis=-1)
    strays = random_strays(np.random.default_rng(2), chord, stray, examples(3_000, 20_000))
    for point in outline(chord, overhang, half_width):
        moved = moved_points(point[None], strays, chord)[:, 0]
        assert (moved @ directions().T <= planes[:, None] + ROUNDING).all(axis=-1).any(axis=0).all()


@SHAPES
def test_supports_are_hardly_larger_than_what_places_reach(chord, overhang, half_width, stray):
    corners = np.array([[0.5 * chord + overhang, half_width], [0.5 * chord, half_width]])
    strays = random_strays(np.random.default_rng(3), chord, stray, examples(100_000, 400_000))
    ahead = directions()[: DIRECTIONS // 4 + 1]
    reached = [(moved_points(corner[None], strays, chord)[:, 0] @ ahead.T).max(axis=0) for corner in corners]
    spare = supports(chord, overhang, half_width, stray)[:, : len(ahead)] - reached
    assert spare.min() >= -ROUNDING
    assert np.median(spare) < TIGHT * stray
    assert spare.max() < 10 * TIGHT * stray


def test_the_bounds_of_a_dragon_hold_its_hulls_on_the_same_chords():
    dragon = Dragon.of([3.0, 2.2, 2.4, 2.2, 2.2], [0.3, 0.3, 0.4, 0.3, 0.3], [0.2, 0.275, 0.2, 0.275, 0.275])
    ground = reach(dragon, 0.05)
    bounds = ground.bounds
    assert (bounds.chords == dragon.chords).all()
    assert bounds.uniform_from == dragon.uniform_from
    assert len(ground.hulls) == 3
    kinds = ground.kinds
    half = np.abs(ground.hulls).max(axis=(1, 2))[kinds]
    inner, outer = (np.stack([each.lengths, each.widths], axis=-1)[: len(kinds)] / 2.0 for each in (dragon, bounds))
    assert (outer >= half).all()
    assert (half > inner + 0.05).all()


def test_a_dragon_of_too_many_sizes_is_refused():
    lengths = np.linspace(2.0, 3.0, SIZES_MAX + 2)
    with refused("dragon.lengths", got=SIZES_MAX + 2):
        reach(Dragon.of(lengths, np.full(lengths.size, 0.3), np.full(lengths.size, 0.2)), 0.01)


@pytest.mark.parametrize("k", [0, 1])
def test_a_corner_goes_as_far_as_the_gain_says_and_no_point_further(k):
    dragon = Dragon(2)
    stray = 0.01
    gain, chord, x = (float(column[k]) for column in (gains(dragon), dragon.chords, 0.5 * dragon.lengths))
    corners = np.array([[x, 0.15], [x, -0.15], [-x, 0.15], [-x, -0.15]])
    strays = random_strays(np.random.default_rng(k), chord, stray, 20_000)
    furthest = np.linalg.norm(moved_points(corners, strays, chord) - corners, axis=-1).max()
    assert 0.99 * gain * stray < furthest <= gain * stray * (1.0 + 1e-12)
