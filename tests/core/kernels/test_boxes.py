"""Broad phase: how it ends. Which pairs it finds: tests/core/shapes/test_overlaps.py."""

import numpy as np

from core.kernels import Budget, Meetings, grow_tree
from core.kernels.constants import BOX_COLUMNS
from core.shapes.rectangles import frames


def test_the_search_stops_soon_after_it_found_more_than_asked():
    rectangles = frames(np.zeros((50, 3)), np.ones((50, 2)))
    boxes = np.tile([-1.0, -1.0, 1.0, 1.0], (50, 1))
    grow_tree(boxes, tree := np.empty((32, BOX_COLUMNS)))
    meetings = Meetings(rectangles, boxes, tree, np.arange(50), Budget())
    meetings.find(0.0, True, False, 60, 10**9, pairs := np.zeros((100, 2), dtype=np.int64))
    assert 60 < meetings.count < 60 + 50
    assert len(np.unique(pairs[: meetings.count], axis=0)) == meetings.count
