"""Exact separation of two rectangles, against tables, its own laws, and shapely."""

from __future__ import annotations

import math

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from core import kernels
from core.errors import SIZE_MAX, SIZE_MIN, InvalidValue
from core.shapes.overlaps import separation
from core.shapes.rectangles import bench_poses, corners, frames

pytestmark = pytest.mark.uncompiled

Floats = NDArray[np.float64]

# Rounding of distances and points within ten metres of the origin: a few ulp of 10 m [m].
ROUNDING = 2e-14
# shapely's polygons have rounded corners and its distance squares coordinates: measured 4e-15 m, here with room [m].
ORACLE_ROUNDING = 2e-14

SQUARE = (2.0, 2.0)
HALF_DIAGONAL = math.sqrt(2.0)
BENCH = (2.2, 0.3)

# name: pose a, size a, pose b, size b, separation, witness a, witness b, normal
TABLE = {
    "apart end to end": ((0, 0, 0), SQUARE, (5, 0, 0), SQUARE, 3.0, (1, 0), (4, 0), (1, 0)),
    "touching": ((0, 0, 0), SQUARE, (0, 2, 0), SQUARE, 0.0, (0, 1), (0, 1), (0, 1)),
    "overlapping, witnesses crossed": ((0, 0, 0), SQUARE, (1.5, 0, 0), SQUARE, -0.5, (1, 0), (0.5, 0), (1, 0)),
    "corner to corner": ((0, 0, 0), SQUARE, (5, 6, 0), SQUARE, 5.0, (1, 1), (4, 5), (0.6, 0.8)),
    "touching at corners only": ((0, 0, 0), SQUARE, (2, -2, 0), SQUARE, 0.0, (1, -1), (1, -1), None),
    "corner of b to edge of a": (
        (0, 0, 0), SQUARE, (3, 0.25, math.pi / 4), SQUARE,
        2 - HALF_DIAGONAL, (1, 0.25), (3 - HALF_DIAGONAL, 0.25), (1, 0),
    ),
    "corner of a to edge of b": (
        (0, 0, math.pi / 4), SQUARE, (-3, 0, 0), SQUARE,
        2 - HALF_DIAGONAL, (-HALF_DIAGONAL, 0), (-2, 0), (-1, 0),
    ),
    "parallel edges share a stretch": ((0, 0, 0), SQUARE, (1, -3, math.pi), SQUARE, 1.0, (0.5, -1), (0.5, -2), (0, -1)),
    "parallel across": ((0, 0, 0), (4, 2), (0.5, 3, math.pi / 2), (2, 6), 1.0, (0, 1), (0, 2), (0, 1)),
    "one inside the other": ((0, 0, 0), (8, 4), (0, 1, 0), (2, 1), -1.5, (0, 2), (0, 0.5), (0, 1)),
    "crossing without a corner inside": (
        (0, 0, 0), (4, 1), (1, 0.25, math.pi / 2), (4, 1), -1.5, (2, 0), (0.5, 0), (1, 0),
    ),
    "the same place": ((1, 1, 0), BENCH, (1, 1, 0), BENCH, -0.3, (1, 1.15), (1, 0.85), (0, 1)),
}  # fmt: skip

lengths = st.floats(0.01, 4.0)
headings = st.one_of(
    st.floats(-7.0, 7.0),
    st.integers(-8, 8).map(lambda k: k * math.pi / 4),
    st.integers(-4, 4).map(lambda k: k * math.pi / 2 + 1e-9),
)
coordinates = st.one_of(st.floats(-4.0, 4.0), st.integers(-4, 4).map(float))
poses = st.tuples(coordinates, coordinates, headings).map(np.array)
sizes = st.tuples(lengths, lengths).map(np.array)
pairs = st.tuples(poses, sizes, poses, sizes)
Pair = tuple[Floats, Floats, Floats, Floats]


def random_pairs(count: int, seed: int) -> Pair:
    """Rectangles near each other, a third of them at multiples of 45 degrees."""
    random = np.random.default_rng(seed)
    pose = random.uniform(-1.0, 1.0, (2, count, 3)) * [3.0, 3.0, math.pi]
    square_on = random.random((2, count)) < 1 / 3
    pose[square_on, 2] = random.integers(0, 8, square_on.sum()) * math.pi / 4
    size = random.uniform(0.1, 3.0, (2, count, 2))
    return pose[0], size[0], pose[1], size[1]


def minkowski_separation(a: Floats, b: Floats) -> Floats:
    """Oracle: signed distance from the origin to the boundary of the Minkowski difference of two corner lists."""
    difference = (b[:, :, None] - a[:, None, :]).reshape(-1, 16, 2)
    hull = shapely.convex_hull(shapely.multipoints(difference))
    origin = shapely.points(0.0, 0.0)
    return shapely.distance(shapely.boundary(hull), origin) * np.where(shapely.intersects(hull, origin), -1.0, 1.0)


def outside(points: Floats, pose: Floats, size: Floats) -> Floats:
    """How far a point lies outside a rectangle: 0 on its boundary, negative within. (..., 2) -> (...)."""
    offset = points - pose[..., :2]
    cos, sin = np.cos(pose[..., 2]), np.sin(pose[..., 2])
    along = np.abs(offset[..., 0] * cos + offset[..., 1] * sin) - size[..., 0] / 2
    across = np.abs(offset[..., 1] * cos - offset[..., 0] * sin) - size[..., 1] / 2
    return np.maximum(along, across)


@pytest.mark.parametrize("row", TABLE.values(), ids=TABLE.keys())
def test_separation_witnesses_and_normal_are_those_of_the_table(row: tuple) -> None:
    pose_a, size_a, pose_b, size_b, distance, witness_a, witness_b, normal = row
    result = separation(pose_a, size_a, pose_b, size_b)
    np.testing.assert_allclose(result.separation, distance, rtol=0, atol=ROUNDING)
    np.testing.assert_allclose(result.witness_a, witness_a, rtol=0, atol=ROUNDING)
    np.testing.assert_allclose(result.witness_b, witness_b, rtol=0, atol=ROUNDING)
    if normal is not None:
        np.testing.assert_allclose(result.normal, normal, rtol=0, atol=ROUNDING)


@settings(deadline=None)
@given(pairs)
def test_witnesses_differ_by_separation_times_unit_normal(pair: Pair) -> None:
    result = separation(*pair)
    np.testing.assert_allclose(
        result.witness_b - result.witness_a, result.separation * result.normal, rtol=0, atol=ROUNDING
    )
    assert np.hypot(*result.normal) == pytest.approx(1.0, rel=0, abs=ROUNDING)


@settings(deadline=None)
@given(pairs)
def test_witnesses_lie_on_the_boundary_of_their_own_rectangle(pair: Pair) -> None:
    result = separation(*pair)
    assert outside(result.witness_a, *pair[:2]) == pytest.approx(0.0, abs=ROUNDING)
    assert outside(result.witness_b, *pair[2:]) == pytest.approx(0.0, abs=ROUNDING)


@settings(deadline=None)
@given(pairs)
def test_moving_b_back_by_the_separation_makes_them_touch(pair: Pair) -> None:
    pose_a, size_a, pose_b, size_b = pair
    result = separation(*pair)
    moved = pose_b - np.append(result.separation * result.normal, 0.0)
    assert separation(pose_a, size_a, moved, size_b).separation == pytest.approx(0.0, abs=ROUNDING)


@settings(deadline=None)
@given(pairs, coordinates, coordinates, st.floats(-3.0, 3.0))
def test_separation_ignores_rigid_motion(pair: Pair, dx: float, dy: float, turn: float) -> None:
    pose_a, size_a, pose_b, size_b = pair
    cos, sin = math.cos(turn), math.sin(turn)
    motion = np.array([[cos, -sin, 0.0], [sin, cos, 0.0], [0.0, 0.0, 1.0]])
    moved_a, moved_b = (motion @ pose + [dx, dy, turn] for pose in (pose_a, pose_b))
    moved = separation(moved_a, size_a, moved_b, size_b).separation
    assert moved == pytest.approx(separation(*pair).separation, rel=0, abs=ROUNDING)


@settings(deadline=None)
@given(pairs)
def test_separation_ignores_the_order_of_the_pair(pair: Pair) -> None:
    pose_a, size_a, pose_b, size_b = pair
    assert separation(pose_b, size_b, pose_a, size_a).separation == pytest.approx(
        separation(*pair).separation, rel=0, abs=ROUNDING
    )


@settings(deadline=None)
@given(pairs, st.floats(0.1, 1000.0))
def test_scaling_every_length_scales_the_separation(pair: Pair, scale: float) -> None:
    pose_a, size_a, pose_b, size_b = pair
    factors = [scale, scale, 1.0]
    scaled = separation(pose_a * factors, size_a * scale, pose_b * factors, size_b * scale).separation
    assert scaled == pytest.approx(separation(*pair).separation * scale, rel=0, abs=ROUNDING * scale)


@settings(deadline=None)
@given(pairs)
def test_gap_alone_equals_the_separation(pair: Pair) -> None:
    def gap_within(limit: float) -> float:
        kernels.pair_gaps(frames(*pair[:2])[None], frames(*pair[2:])[None], limit, out := np.empty(1))
        return out[0]

    gap = gap_within(kernels.NO_LIMIT)
    assert gap == pytest.approx(separation(*pair).separation, rel=0, abs=ROUNDING)
    assert gap_within(max(gap, 0.0) + ROUNDING) == gap
    if gap > ROUNDING:
        assert gap / 2 < gap_within(gap / 2) <= gap + ROUNDING


def test_separation_equals_the_minkowski_oracle_on_random_pairs() -> None:
    pair = random_pairs(20_000, seed=1)
    result = separation(*pair).separation
    assert np.mean(result < 0) > 0.1
    oracle = minkowski_separation(corners(*pair[:2]), corners(*pair[2:]))
    np.testing.assert_allclose(result, oracle, rtol=0, atol=ORACLE_ROUNDING)


def test_separation_of_extreme_sizes_equals_the_oracle() -> None:
    random = np.random.default_rng(7)
    size = 10 ** random.uniform(math.log10(SIZE_MIN), math.log10(SIZE_MAX), (2, 5_000, 2))
    reach = size.sum(axis=(0, 2))[:, None]
    pose = np.concatenate([random.uniform(-0.5, 0.5, (2, 5_000, 2)) * reach, random.uniform(-3, 3, (2, 5_000, 1))], -1)
    result = separation(pose[0], size[0], pose[1], size[1]).separation
    oracle = minkowski_separation(corners(pose[0], size[0]), corners(pose[1], size[1]))
    np.testing.assert_array_less(np.abs(result - oracle), ORACLE_ROUNDING * reach[:, 0])


def test_distance_of_far_rectangles_is_exact_in_relative_terms() -> None:
    pose_a, size_a, pose_b, size_b = random_pairs(5_000, seed=2)
    pose_b[:, :2] += np.random.default_rng(3).uniform(-1e7, 1e7, (5_000, 2))
    oracle = shapely.distance(shapely.polygons(corners(pose_a, size_a)), shapely.polygons(corners(pose_b, size_b)))
    np.testing.assert_allclose(separation(pose_a, size_a, pose_b, size_b).separation, oracle, rtol=1e-14, atol=0)


def test_rectangles_far_from_the_origin_lose_nothing() -> None:
    pose_a, size_a, pose_b, size_b = random_pairs(2_000, seed=4)
    step = 2.0**-20  # coordinates on this grid stay exact when the offset is added
    for pose in (pose_a, pose_b):
        pose[:, :2] = np.round(pose[:, :2] / step) * step
    near = separation(pose_a, size_a, pose_b, size_b)
    offset = [2.0**29, -(2.0**28), 0.0]
    far = separation(pose_a + offset, size_a, pose_b + offset, size_b)
    np.testing.assert_array_equal(far.separation, near.separation)
    np.testing.assert_array_equal(far.normal, near.normal)


# Nearly parallel edges: the gaps of two faces are equal but for rounding, while the corners that they point at lie
# up to rounding / turn apart along the edge, so a corner may be a little beside the face that seems to decide.
@pytest.mark.parametrize("turn", [1e-15, 1e-12, 1e-9, 1e-8, 1e-7, -1e-8, 1e-6])
@pytest.mark.parametrize("gap", [-0.1, -1e-9, 0.0, 1e-9, 1e-6])
def test_nearly_parallel_edges_keep_their_distance_and_witnesses(turn: float, gap: float) -> None:
    little = 10 ** np.linspace(-12, -3, 200)
    shift = np.concatenate([np.linspace(-2.5, 2.5, 401), little, -little])
    pose = np.stack([shift, np.full_like(shift, 0.3 + gap), np.full_like(shift, turn)], axis=-1)
    still, size = np.zeros_like(pose), np.full((shift.size, 2), BENCH)
    result = separation(still, size, pose, size)
    oracle = minkowski_separation(corners(still, size), corners(pose, size))
    np.testing.assert_allclose(result.separation, oracle, rtol=0, atol=ORACLE_ROUNDING)
    np.testing.assert_allclose(outside(result.witness_a, still, size), 0.0, rtol=0, atol=ROUNDING)
    np.testing.assert_allclose(outside(result.witness_b, pose, size), 0.0, rtol=0, atol=ROUNDING)


def test_witness_of_parallel_edges_does_not_depend_on_rounding() -> None:
    for tilt in (-1e-16, 0.0, 1e-16):
        result = separation([0, 0, 0.7 + tilt], BENCH, [-math.sin(0.7), math.cos(0.7), 0.7], BENCH)
        middle = [-0.15 * math.sin(0.7), 0.15 * math.cos(0.7)]
        np.testing.assert_allclose(result.witness_a, middle, rtol=0, atol=ROUNDING)


def test_features_name_the_corner_or_edge_that_holds_each_witness() -> None:
    pose_a, size_a, pose_b, size_b = random_pairs(5_000, seed=5)
    out = np.empty((5_000, kernels.SEPARATION_COLUMNS))
    kernels.pair_separations(frames(pose_a, size_a), frames(pose_b, size_b), out)
    features = out[:, kernels.FEATURE_A : kernels.FEATURE_B + 1].T.astype(int)
    witnesses = out[:, kernels.WITNESS_AX : kernels.WITNESS_AY + 1], out[:, kernels.WITNESS_BX : kernels.WITNESS_BY + 1]
    rows = np.arange(5_000)
    for feature, witness, corner in zip(
        features, witnesses, (corners(pose_a, size_a), corners(pose_b, size_b)), strict=True
    ):
        start, end = corner[rows, feature % 4], corner[rows, (feature + 1) % 4]
        along, to = end - start, witness - start
        off_edge = np.abs(along[:, 0] * to[:, 1] - along[:, 1] * to[:, 0]) / np.hypot(*along.T)
        is_corner = feature < 4
        assert 0.1 < is_corner.mean() < 0.9
        np.testing.assert_allclose(np.hypot(*to.T)[is_corner], 0.0, atol=ROUNDING)
        np.testing.assert_allclose(off_edge[~is_corner], 0.0, atol=ROUNDING)


def test_batch_equals_a_loop_and_shapes_broadcast() -> None:
    pose_a, size_a, pose_b, size_b = (column[:12] for column in random_pairs(12, seed=6))
    batch = separation(pose_a.reshape(3, 4, 3), size_a.reshape(3, 4, 2), pose_b.reshape(3, 4, 3), size_b[0])
    for k in range(12):
        one = separation(pose_a[k], size_a[k], pose_b[k], size_b[0])
        for name in ("separation", "witness_a", "witness_b", "normal"):
            np.testing.assert_array_equal(getattr(batch, name)[k // 4, k % 4], getattr(one, name))
    assert separation(pose_a[:, None], BENCH, pose_b[:5], BENCH).normal.shape == (12, 5, 2)
    assert separation(np.empty((0, 3)), BENCH, [0, 0, 0], BENCH).witness_a.shape == (0, 2)


def test_inputs_are_left_as_they_were() -> None:
    pair = random_pairs(3, seed=8)
    copies = [column.copy() for column in pair]
    for column in pair:
        column.flags.writeable = False
    separation(*pair)
    for column, copy in zip(pair, copies, strict=True):
        np.testing.assert_array_equal(column, copy)


def test_corners_run_front_left_front_right_rear_right_rear_left() -> None:
    result = corners(np.array([[1.0, 2.0, math.pi / 2], [0.0, 0.0, 0.0]]), np.array([4.0, 2.0]))
    np.testing.assert_allclose(result[0], [[0, 4], [2, 4], [2, 0], [0, 0]], rtol=0, atol=ROUNDING)
    np.testing.assert_allclose(result[1], [[2, 1], [2, -1], [-2, -1], [-2, 1]], rtol=0, atol=0)


@pytest.mark.parametrize("handles", [None, 1.0, [[0.0, 0.0, 0.0]], [0.0, 0.0], "handles", [["a", "b"]]])
def test_handles_that_are_no_places_are_refused(handles: object) -> None:
    with pytest.raises(InvalidValue, match=r"^handles must be places of shape"):
        bench_poses(handles)  # type: ignore[arg-type]


@pytest.mark.parametrize("number", [math.nan, math.inf])
def test_handles_must_be_finite(number: float) -> None:
    with pytest.raises(InvalidValue, match=r"^handles must be finite"):
        bench_poses(np.array([[number, 0.0], [0.0, 0.0]]))


@given(st.integers(1, 6), st.integers(0, 3), st.data())
def test_poses_of_many_instants_equal_those_one_by_one(benches: int, instants: int, data: st.DataObject) -> None:
    numbers = 2 * (benches + 1) * instants
    places = st.lists(st.floats(-100.0, 100.0), min_size=numbers, max_size=numbers)
    handles = np.array(data.draw(places)).reshape(instants, benches + 1, 2)
    poses = bench_poses(handles)
    assert poses.shape == (instants, benches, 3)
    for k in range(instants):
        assert np.array_equal(poses[k], bench_poses(handles[k]))
        np.testing.assert_allclose(poses[k, :, :2], 0.5 * (handles[k, 1:] + handles[k, :-1]), atol=1e-14)
        reach = np.hypot(*(handles[k, :-1] - handles[k, 1:]).T)
        along = np.stack([np.cos(poses[k, :, 2]), np.sin(poses[k, :, 2])], axis=-1) * reach[:, None]
        np.testing.assert_allclose(along, handles[k, :-1] - handles[k, 1:], atol=1e-12)
