"""Broad phase: pairs of rectangles near each other, against all pairs."""

from __future__ import annotations

import numpy as np
import pytest

from core import kernels
from core.shapes.rectangles import frames, meeting_pairs


@pytest.mark.parametrize("count", [2, 5, 64, 301])
@pytest.mark.parametrize("chained", [False, True])
def test_exact_pairs_are_those_of_all_whose_gap_is_within_the_margin(count: int, chained: bool) -> None:
    rng = np.random.default_rng(count)
    poses, margin = rng.random((count, 3)) * [20.0, 20.0, 6.0], 0.1
    rectangles = frames(poses, rng.random((count, 2)) + 0.2)
    a, b = np.triu_indices(count, 2 if chained else 1)
    kernels.pair_gaps(rectangles[a], rectangles[b], kernels.NO_LIMIT, gaps := np.empty(len(a)))
    near = {(int(i), int(j)) for i, j, gap in zip(a, b, gaps, strict=True) if gap <= margin}
    result = meeting_pairs(rectangles, margin, chained, exact=True).tolist()
    assert len(result) == len(near)
    assert set(map(tuple, result)) == near


def test_the_search_stops_soon_after_it_found_more_than_asked() -> None:
    rectangles = frames(np.zeros((50, 3)), np.ones((50, 2)))
    boxes = np.tile([-1.0, -1.0, 1.0, 1.0], (50, 1))
    kernels.grow_tree(boxes, tree := np.empty((32, kernels.BOX_COLUMNS)))
    meetings = kernels.Meetings(rectangles, boxes, tree, np.arange(50), kernels.Budget())
    meetings.find(0.0, True, False, 60, 10**9, pairs := np.zeros((100, 2), dtype=np.int64))
    assert 60 < meetings.count < 60 + 50
    assert len(np.unique(pairs[: meetings.count], axis=0)) == meetings.count
