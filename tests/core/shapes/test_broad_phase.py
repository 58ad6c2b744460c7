"""The broad phase: it misses no pair, and refuses what is too much."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from core.checks import SIZE_MAX
from core.errors import TooLarge
from core.shapes.overlaps import Engine, overlaps
from core.shapes.rectangles import CROSS_CANDIDATES_MAX, PAIRS_MAX, frames, meeting_pairs
from tests.support.refused import refused
from tests.support.scenes import WIDTH, all_pairs, crowd


def close_pairs(poses, lengths, widths, *, margin=0.0, chained=False):
    """Pairs whose upright boxes come within the margin."""
    frame = frames(poses, np.stack([lengths, widths], axis=-1))
    return meeting_pairs(frame, margin, chained, exact=False)


@settings(deadline=None, max_examples=50)
@given(st.integers(0, 2**32), st.integers(0, 60), st.sampled_from([0.0, 1e-9, 0.3]), st.sampled_from([0.0, 1e3, 1e8]))
def test_broad_phase_is_a_superset_of_the_narrow_phase(seed, count, margin, shift):
    pose, length, width = crowd(count, seed, side=12.0)
    scene = pose + np.array([shift, -shift, 0.0]), length, width
    narrow = all_pairs(scene, margin)
    assert set(map(tuple, narrow.tolist())) <= set(map(tuple, close_pairs(*scene, margin=margin).tolist()))
    for engine in (Engine.SEPARATING_AXIS, *((Engine.FCL, Engine.SHAPELY) if not shift else ())):
        np.testing.assert_array_equal(overlaps(*scene, engine=engine, margin=margin, chained=False).pairs, narrow)


MIXED = crowd(1_000, seed=3, side=70.0, smallest=1e-3, largest=20.0)
WITH_GIANTS = tuple(column.copy() for column in MIXED)
WITH_GIANTS[0][:2, :2] = [[1e9, -1e9], [-1e9, 5.0]]
WITH_GIANTS[1][2] = SIZE_MAX
LAYOUTS = {
    "mixed sizes": MIXED,
    "in a row": (np.arange(1_000)[:, None] * [0.7, 0.0, 0.0], *np.full((2, 1_000), 0.9)),
    "all in one place": (np.zeros((300, 3)), *np.ones((2, 300))),
    "a giant and two far away": WITH_GIANTS,
}


@pytest.mark.parametrize("scene", LAYOUTS.values(), ids=LAYOUTS)
def test_separating_axis_finds_what_all_pairs_finds(scene):
    result = overlaps(*scene, chained=False).pairs
    np.testing.assert_array_equal(result, all_pairs(scene))
    assert len(result) > 100


def test_close_benches_that_do_not_overlap_are_refused_when_too_many_must_be_looked_at():
    count = 7_000  # their boxes all meet: 24 million pairs
    poses = np.arange(count)[:, None] * [0.25, -0.25, 0.0] + [0.0, 0.0, math.pi / 4]
    with refused("benches", TooLarge, most=20_000_000):
        overlaps(poses, np.full(count, SIZE_MAX), np.full(count, WIDTH))


# n benches in one place are n (n - 1) / 2 pairs
@pytest.mark.parametrize("find, limit", [(overlaps, PAIRS_MAX), (close_pairs, CROSS_CANDIDATES_MAX)])
def test_as_many_pairs_as_the_limit_allows_are_found(find, limit):
    most = (1 + math.isqrt(1 + 8 * limit)) // 2
    poses = np.zeros((most + 1, 3))
    size = np.ones(most + 1)
    result = find(poses[1:], size[1:], size[1:], chained=False)
    assert len(getattr(result, "pairs", result)) == most * (most - 1) // 2
    with refused("benches", TooLarge, most=limit):
        find(poses, size, size, chained=False)
