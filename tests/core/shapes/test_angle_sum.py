"""The paper's rule: angles that add up to a full turn."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from core.shapes.overlaps import Engine, overlaps
from core.shapes.rectangles import (
    angle_sum_overlap,
    corners,
    paper_corners,
)
from tests.support.near import assert_near
from tests.support.refused import refused
from tests.support.scenes import LENGTH, WIDTH, benches, crowd, outside

SIZE = np.array([LENGTH, WIDTH])


@pytest.mark.parametrize("turn", [0.0, math.pi])
@pytest.mark.parametrize("heading", [0.0, 0.4, math.pi / 2, 2.5, -1.1])
def test_paper_corners_are_the_rectangle_whichever_way_its_arctan_points(heading, turn):
    expected = corners(np.array([3.0, 1.0, heading]), SIZE)
    result = paper_corners(np.array([3.0, 1.0, heading + turn]), SIZE)
    apart = np.linalg.norm(result[:, None] - expected[None], axis=-1)
    assert_near([apart.min(axis=0), apart.min(axis=1)], np.zeros((2, 4)), 1e-12)


SQUARE = np.array([[1.0, 1.0], [1.0, -1.0], [-1.0, -1.0], [-1.0, 1.0]])


@pytest.mark.parametrize("gap, seen", [(-1e-9, True), (0.0, True), (1e-13, True), (1e-12, False), (1e-9, False)])
def test_angle_sum_tolerance_reaches_less_than_a_picometre(gap, seen):
    tip = np.array([[1.0 + gap, 0.0], [2.0, 0.5], [2.0, -0.5]])
    assert angle_sum_overlap(SQUARE, tip) == seen
    assert angle_sum_overlap(tip, SQUARE) == seen


@settings(deadline=None, max_examples=50)
@given(st.integers(0, 2**32), st.integers(2, 40))
def test_angle_sum_finds_just_the_overlaps_with_a_corner_inside(seed, count):
    pose, length, width = crowd(count, seed, side=8.0)
    size = np.stack([length, width], axis=-1)
    holds = (outside(corners(pose, size)[:, None], pose[:, None], size[:, None]) <= 0.0).any(axis=-1)
    result = overlaps(pose, length, width, engine=Engine.ANGLE_SUM, chained=False).pairs
    np.testing.assert_array_equal(result, np.argwhere(np.triu(holds | holds.T, k=1)))


def test_the_angle_sum_rule_refuses_a_margin():
    with refused("margin"):
        overlaps(*benches((0, 0, 0)), engine=Engine.ANGLE_SUM, margin=0.05)
