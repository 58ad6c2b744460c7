"""Exact separation of two rectangles, against its own laws and shapely."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from core import kernels
from core.checks import SIZE_MAX, SIZE_MIN
from core.shapes.overlaps import separation
from core.shapes.rectangles import bench_poses, corners, frames
from tests.support.near import assert_near
from tests.support.refused import refused
from tests.support.scenes import minkowski_separation, outside, random_pairs

pytestmark = pytest.mark.uncompiled

# Rounding of distances and points within ten metres of the origin: a few ulp of 10 m [m].
ROUNDING = 2e-14
# shapely's polygons have rounded corners and its distance squares coordinates: measured 4e-15 m, here with room [m].
ORACLE_ROUNDING = 2e-14

BENCH = (2.2, 0.3)


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
FIELDS = "separation", "witness_a", "witness_b", "normal"


def assert_separated(pose_a, size_a, pose_b, size_b):
    """The separations of pairs are those of the oracle; their witnesses lie on both boundaries, a step apart."""
    result = separation(pose_a, size_a, pose_b, size_b)
    oracle = minkowski_separation(corners(pose_a, size_a), corners(pose_b, size_b))
    step = result.separation[:, None] * result.normal
    assert_near(result.separation, oracle, ORACLE_ROUNDING)
    assert_near(result.witness_b - result.witness_a, step, ROUNDING)
    assert_near(np.hypot(*result.normal.T), 1.0, ROUNDING)
    assert_near(outside(result.witness_a, pose_a, size_a), 0.0, ROUNDING)
    assert_near(outside(result.witness_b, pose_b, size_b), 0.0, ROUNDING)
    # moved back by it, they touch
    back = pose_b - np.pad(step, ((0, 0), (0, 1)))
    assert_near(separation(pose_a, size_a, back, size_b).separation, 0.0, ROUNDING)


@settings(deadline=None, max_examples=60)
@given(pairs)
def test_witnesses_are_apart_by_the_separation_along_the_normal_and_the_gap_alone_equals_it(pair):
    assert_separated(*(part[None] for part in pair))

    def gap_within(limit):
        kernels.pair_gaps(frames(*pair[:2])[None], frames(*pair[2:])[None], limit, out := np.empty(1))
        return out[0]

    gap = gap_within(kernels.NO_LIMIT)
    assert_near(gap, separation(*pair).separation, ROUNDING)
    assert gap_within(max(gap, 0.0) + ROUNDING) == gap
    if gap > ROUNDING:
        assert gap / 2 < gap_within(gap / 2) <= gap + ROUNDING


def test_separation_of_extreme_sizes_equals_the_oracle():
    random = np.random.default_rng(7)
    size = 10 ** random.uniform(math.log10(SIZE_MIN), math.log10(SIZE_MAX), (2, 5_000, 2))
    reach = size.sum(axis=(0, 2))
    pose = random.uniform(-0.5, 0.5, (2, 5_000, 3)) * np.stack([reach, reach, np.full(5_000, 6.0)], axis=-1)
    result = separation(pose[0], size[0], pose[1], size[1]).separation
    oracle = minkowski_separation(*corners(pose, size))
    assert_near(result / reach, oracle / reach, ORACLE_ROUNDING)


def test_rectangles_far_from_the_origin_lose_nothing():
    pose_a, size_a, pose_b, size_b = random_pairs(2_000, seed=4)
    step = 2.0**-20  # coordinates on this grid stay exact when the offset is added
    for pose in (pose_a, pose_b):
        pose[:, :2] = np.round(pose[:, :2] / step) * step
    offset = [2.0**29, -(2.0**28), 0.0]
    near, far = (
        separation(pose_a + k * np.array(offset), size_a, pose_b + k * np.array(offset), size_b) for k in (0, 1)
    )
    np.testing.assert_array_equal(far.separation, near.separation)
    np.testing.assert_array_equal(far.normal, near.normal)


# Nearly parallel edges: the gaps of two faces are equal but for rounding, while the corners that they point at lie
# up to rounding / turn apart along the edge, so a corner may be a little beside the face that seems to decide.
@pytest.mark.parametrize("turn", [1e-15, 1e-12, 1e-9, 1e-8, 1e-7, -1e-8, 1e-6])
@pytest.mark.parametrize("gap", [-0.1, -1e-9, 0.0, 1e-9, 1e-6])
def test_nearly_parallel_edges_keep_their_distance_and_witnesses(turn, gap):
    little = 10 ** np.linspace(-12, -3, 200)
    shift = np.concatenate([np.linspace(-2.5, 2.5, 401), little, -little])
    pose = np.stack([shift, np.full_like(shift, 0.3 + gap), np.full_like(shift, turn)], axis=-1)
    still = np.zeros_like(pose)
    size = np.full((shift.size, 2), BENCH)
    assert_separated(still, size, pose, size)


def test_witness_of_parallel_edges_does_not_depend_on_rounding():
    for tilt in (-1e-16, 0.0, 1e-16):
        result = separation([0, 0, 0.7 + tilt], BENCH, [-math.sin(0.7), math.cos(0.7), 0.7], BENCH)
        middle = [-0.15 * math.sin(0.7), 0.15 * math.cos(0.7)]
        assert_near(result.witness_a, middle, ROUNDING)


def test_features_name_the_corner_or_edge_that_holds_each_witness():
    pose_a, size_a, pose_b, size_b = random_pairs(1_000, seed=5)
    out = np.empty((1_000, kernels.SEPARATION_COLUMNS))
    kernels.pair_separations(frames(pose_a, size_a), frames(pose_b, size_b), out)
    rows = np.arange(1_000)
    for column, x, corner in (
        (kernels.FEATURE_A, kernels.WITNESS_AX, corners(pose_a, size_a)),
        (kernels.FEATURE_B, kernels.WITNESS_BX, corners(pose_b, size_b)),
    ):
        feature = out[:, column].astype(int)
        start = corner[rows, feature % 4]
        end = corner[rows, (feature + 1) % 4]
        along = end - start
        to = out[:, x : x + 2] - start
        off_edge = np.abs(along[:, 0] * to[:, 1] - along[:, 1] * to[:, 0]) / np.hypot(*along.T)
        is_corner = feature < 4
        assert 0.1 < is_corner.mean() < 0.9
        assert np.where(is_corner, np.hypot(*to.T), off_edge).max() < ROUNDING


def test_batch_equals_a_loop_and_shapes_broadcast():
    pose_a, size_a, pose_b, size_b = random_pairs(12, seed=6)
    batch = separation(pose_a[:, None], size_a[:, None], pose_b[:5], size_b[0])
    for j, k in np.ndindex(12, 5):
        single = separation(pose_a[j], size_a[j], pose_b[k], size_b[0])
        assert all(np.array_equal(getattr(batch, name)[j, k], getattr(single, name)) for name in FIELDS)
    assert separation(np.empty((0, 3)), BENCH, [0, 0, 0], BENCH).witness_a.shape == (0, 2)


def test_corners_run_front_left_front_right_rear_right_rear_left():
    result = corners(np.array([1.0, 2.0, math.pi / 2]), np.array([4.0, 2.0]))
    assert_near(result, [[0, 4], [2, 4], [2, 0], [0, 0]], ROUNDING)


@pytest.mark.parametrize(
    "handles",
    [[0.0, 0.0], [[math.nan, 0.0], [0.0, 0.0]], [[math.inf, 0.0], [0.0, 0.0]]],
)
def test_handles_that_are_no_places_are_refused(handles):
    with refused("handles"):
        bench_poses(handles)


@settings(deadline=None, max_examples=60)
@given(st.integers(1, 6), st.integers(0, 3), st.integers(0, 2**32))
def test_poses_lie_between_the_handles_at_one_instant_or_many(benches, instants, seed):
    handles = np.random.default_rng(seed).uniform(-100.0, 100.0, (instants, benches + 1, 2))
    poses = bench_poses(handles)
    assert all(np.array_equal(pose, bench_poses(places)) for pose, places in zip(poses, handles, strict=True))
    x, y, heading = np.moveaxis(poses, -1, 0)
    front, rear = (part @ [1.0, 1.0j] for part in (handles[:, :-1], handles[:, 1:]))
    assert_near(x + 1j * y, 0.5 * (front + rear), 1e-14)
    assert_near(np.abs(front - rear) * np.exp(1j * heading), front - rear, 1e-12)
