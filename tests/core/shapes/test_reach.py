"""The ground of a bench: every place lies in it, and it is hardly larger than all places."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from core import Dragon, InvalidValue
from core.kernels.constants import DIRECTIONS
from core.shapes.reach import SIZES_MAX, bench_hulls, directions, gains, reach, supports
from tests.support.depth import examples
from tests.support.random_strays import moved_points, random_strays

ROUNDING = 1e-11  # [m]
TIGHT = 1e-3  # supports exceed what places reach by at most this of the stray [1]
SHAPES = [(1.65, 0.275, 0.3, 0.05), (2.86, 0.275, 0.3, 0.26), (1.65, 0.275, 0.3, 0.82), (1.0, 0.0, 0.2, 0.3)]
IDS = ["body", "head", "half a chord", "no overhang"]


def outline(chord: float, overhang: float, half_width: float) -> np.ndarray:
    along = np.linspace(-0.5 * chord - overhang, 0.5 * chord + overhang, 25)
    return np.array([(x, y) for x in [*along, -0.5 * chord, 0.5 * chord] for y in (-half_width, half_width)])


def test_a_point_moves_by_what_the_derivation_says() -> None:
    chord, points = 1.65, outline(1.65, 0.275, 0.15)
    strays = random_strays(np.random.default_rng(1), chord, 0.3, 1000)
    assert np.hypot(*strays.reshape(-1, 2).T).max() <= 0.3 + ROUNDING
    front, rear = strays @ np.array([1.0, 1.0j]), None
    z = points @ np.array([1.0, 1.0j])
    front, rear = front[:, :1], front[:, 1:]
    linear = z + front * (0.5 + z / chord) + rear * (0.5 - z / chord)
    moved = moved_points(points, strays, chord) @ np.array([1.0, 1.0j])
    assert np.abs(moved - linear).max() < ROUNDING


@pytest.mark.parametrize(("chord", "overhang", "width", "stray"), SHAPES, ids=IDS)
def test_every_place_lies_in_one_of_the_hulls(chord: float, overhang: float, width: float, stray: float) -> None:
    hulls = bench_hulls(supports(chord, overhang, 0.5 * width, stray))
    planes = (hulls * directions()).sum(axis=-1)
    strays = random_strays(np.random.default_rng(2), chord, stray, examples(4_000, 20_000))
    for point in outline(chord, overhang, 0.5 * width):
        moved = moved_points(point[None], strays, chord)[:, 0]
        within = (moved @ directions().T <= planes[:, None] + ROUNDING).all(axis=-1)
        assert within.any(axis=0).all()


@pytest.mark.parametrize(("chord", "overhang", "width", "stray"), SHAPES, ids=IDS)
def test_supports_are_hardly_larger_than_what_places_reach(
    chord: float, overhang: float, width: float, stray: float
) -> None:
    corners = np.array([[0.5 * chord + overhang, 0.5 * width], [0.5 * chord, 0.5 * width]])
    strays = random_strays(np.random.default_rng(3), chord, stray, examples(100_000, 400_000))
    ahead = directions()[: DIRECTIONS // 4 + 1]
    reached = [(moved_points(corner[None], strays, chord)[:, 0] @ ahead.T).max(axis=0) for corner in corners]
    spare = supports(chord, overhang, 0.5 * width, stray)[:, : len(ahead)] - reached
    assert spare.min() >= -ROUNDING
    assert np.median(spare) < TIGHT * stray
    assert spare.max() < 10 * TIGHT * stray


@settings(max_examples=30, deadline=None)
@given(scale=st.floats(0.1, 10.0), stray=st.floats(0.001, 0.8))
def test_a_larger_bench_with_a_larger_stray_has_a_larger_ground(scale: float, stray: float) -> None:
    small, large = (
        bench_hulls(supports(1.65, 0.275, 0.15, stray)),
        bench_hulls(supports(1.65 * scale, 0.275 * scale, 0.15 * scale, stray * scale)),
    )
    assert large == pytest.approx(small * scale, rel=1e-12, abs=1e-11)


def test_corners_go_round_and_the_ends_mirror_each_other() -> None:
    front, middle, rear = bench_hulls(supports(1.65, 0.275, 0.15, 0.1))
    for hull in (front, middle, rear):
        edges = np.roll(hull, -1, axis=0) - hull
        following = np.roll(edges, -1, axis=0)
        assert (edges[:, 0] * following[:, 1] - edges[:, 1] * following[:, 0] >= -ROUNDING).all()
    assert np.roll(-rear, DIRECTIONS // 2, axis=0) == pytest.approx(front, abs=0.0)
    assert middle[:, 1].max() == pytest.approx(0.25, abs=1e-4)  # between the holes no side moves further than they do


def test_the_bounds_of_a_dragon_hold_its_hulls_on_the_same_chords() -> None:
    dragon = Dragon.of([3.0, 2.2, 2.4, 2.2, 2.2], [0.3, 0.3, 0.4, 0.3, 0.3], [0.2, 0.275, 0.2, 0.275, 0.275])
    ground = reach(dragon, 0.05)
    assert (ground.bounds.chords == dragon.chords).all()
    assert ground.bounds.uniform_from == dragon.uniform_from
    assert len(ground.hulls) == 3
    for k, kind in enumerate(ground.kinds.tolist()):
        half = np.abs(ground.hulls[kind]).max(axis=(0, 1))
        assert 0.5 * ground.bounds.lengths[k] >= half[0] > 0.5 * dragon.lengths[k] + 0.05
        assert 0.5 * ground.bounds.widths[k] >= half[1] > 0.5 * dragon.widths[k] + 0.05


def test_a_dragon_of_too_many_sizes_is_refused() -> None:
    lengths = np.linspace(2.0, 3.0, SIZES_MAX + 2)
    dragon = Dragon.of(lengths, np.full(lengths.size, 0.3), np.full(lengths.size, 0.2))
    with pytest.raises(InvalidValue, match=rf"at most {SIZES_MAX} different sizes .* 0.01 m, got {SIZES_MAX + 2}"):
        reach(dragon, 0.01)


def test_a_corner_goes_as_far_as_the_gain_says_and_no_point_further() -> None:
    dragon, stray = Dragon(2), 0.01
    for k, gain in enumerate(gains(dragon).tolist()):
        chord, x, y = float(dragon.chords[k]), 0.5 * float(dragon.lengths[k]), 0.15
        corners = np.array([[x, y], [x, -y], [-x, y], [-x, -y]])
        strays = random_strays(np.random.default_rng(k), chord, stray, 20_000)
        moved = moved_points(corners, strays, chord)
        furthest = np.hypot(*np.moveaxis(moved - corners, -1, 0)).max()
        assert 0.99 * gain * stray < furthest <= gain * stray * (1.0 + 1e-12)
