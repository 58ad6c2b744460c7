"""The paper's rule: angles that add up to a full turn."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from core.errors import InvalidValue
from core.shapes.overlaps import Engine, overlaps
from core.shapes.rectangles import (
    ANGLE_TOLERANCE,
    angle_sum_overlap,
    angle_sums,
    corners,
    literal_corners,
    paper_corners,
)
from tests.support.scenes import LENGTH, WIDTH, benches, crowd

Floats = NDArray[np.float64]
# Rounding of points and distances within ten metres of the origin [m].
ROUNDING = 2e-14


def as_set(points: Floats) -> set[tuple[float, float]]:
    return {(round(x, 12), round(y, 12)) for x, y in points.tolist()}


@pytest.mark.parametrize("heading", [0.0, 0.4, math.pi / 2, 2.5, -1.1])
def test_paper_corners_are_the_rectangle_whichever_way_its_arctan_points(heading: float) -> None:
    size = np.array([LENGTH, WIDTH])
    expected = as_set(corners(np.array([3.0, 1.0, heading]), size))
    assert as_set(paper_corners(np.array([3.0, 1.0, heading]), size)) == expected
    assert as_set(paper_corners(np.array([3.0, 1.0, heading + math.pi]), size)) == expected


@pytest.mark.parametrize("heading", [0.0, 0.4, math.pi / 4, math.pi / 2, 2.5])
def test_literal_corners_are_sheared_by_the_heading(heading: float) -> None:
    top_right, bottom_right, bottom_left, _ = literal_corners(np.array([3.0, 1.0, heading]), np.array([LENGTH, WIDTH]))
    across, along = top_right - bottom_right, bottom_right - bottom_left
    assert np.hypot(*along) == pytest.approx(LENGTH, abs=ROUNDING)
    assert np.hypot(*across) == pytest.approx(WIDTH, abs=ROUNDING)
    assert across @ along == pytest.approx(-LENGTH * WIDTH * math.sin(2.0 * heading), abs=ROUNDING)


def test_literal_corners_are_those_of_eq_12_as_printed() -> None:
    theta, cos, sin = 0.4, math.cos(0.4), math.sin(0.4)
    expected = [
        (LENGTH / 2 * cos - WIDTH / 2 * sin, LENGTH / 2 * sin - WIDTH / 2 * cos),
        (LENGTH / 2 * cos + WIDTH / 2 * sin, LENGTH / 2 * sin + WIDTH / 2 * cos),
        (-LENGTH / 2 * cos + WIDTH / 2 * sin, -LENGTH / 2 * sin + WIDTH / 2 * cos),
        (-LENGTH / 2 * cos - WIDTH / 2 * sin, -LENGTH / 2 * sin - WIDTH / 2 * cos),
    ]
    result = literal_corners(np.array([0.0, 0.0, theta]), np.array([LENGTH, WIDTH]))
    np.testing.assert_allclose(result, expected, rtol=0, atol=ROUNDING)


SQUARE = np.array([[1.0, 1.0], [1.0, -1.0], [-1.0, -1.0], [-1.0, 1.0]])


@pytest.mark.parametrize(
    ("point", "expected"),
    [
        ((0.2, -0.3), 2 * math.pi),
        ((1.0, 0.3), 2 * math.pi),
        ((1.0, 1.0), 2 * math.pi),
        ((1 + 1e-3, 0.0), 4 * math.atan(1e3)),
        ((1e4, 0.0), 4 * math.atan(1 / (1e4 - 1))),
    ],
    ids=["inside", "on an edge", "on a corner", "just outside", "far away"],
)
def test_angle_sum_is_a_full_turn_inside_and_less_outside(point: tuple[float, float], expected: float) -> None:
    assert angle_sums(np.array([point]), SQUARE) == pytest.approx(expected, rel=0, abs=ANGLE_TOLERANCE)


@pytest.mark.parametrize(("gap", "seen"), [(-1e-9, True), (0.0, True), (1e-13, True), (1e-12, False), (1e-9, False)])
def test_angle_sum_tolerance_reaches_less_than_a_picometre(gap: float, seen: bool) -> None:
    tip = np.array([[1.0 + gap, 0.0], [2.0, 0.5], [2.0, -0.5]])
    assert angle_sum_overlap(SQUARE, tip) == seen
    assert angle_sum_overlap(tip, SQUARE) == seen


def test_angle_sum_misses_a_crossing_without_a_corner_inside() -> None:
    crossing = benches((0, 0, 0), (0, 0, math.pi / 2))
    assert overlaps(*crossing, chained=False).pairs.tolist() == [[0, 1]]
    assert overlaps(*crossing, chained=False, engine=Engine.ANGLE_SUM).pairs.tolist() == []


@settings(deadline=None)
@given(st.integers(0, 2**32), st.integers(2, 40))
def test_angle_sum_finds_just_the_overlaps_with_a_corner_inside(seed: int, count: int) -> None:
    pose, length, width = crowd(count, seed, side=8.0)
    size = np.stack([length, width], axis=-1)
    offset = corners(pose, size)[:, None] - pose[None, :, None, :2]
    cos, sin = np.cos(pose[:, 2])[:, None], np.sin(pose[:, 2])[:, None]
    along = np.abs(offset[..., 0] * cos + offset[..., 1] * sin) <= length[:, None] / 2
    across = np.abs(offset[..., 1] * cos - offset[..., 0] * sin) <= width[:, None] / 2
    holds = (along & across).any(axis=-1)
    result = overlaps(pose, length, width, engine=Engine.ANGLE_SUM, chained=False).pairs
    np.testing.assert_array_equal(result, np.argwhere(np.triu(holds | holds.T, k=1)))


def test_the_angle_sum_rule_refuses_a_margin() -> None:
    with pytest.raises(InvalidValue, match="margin must be 0 m for the angle-sum rule") as caught:
        overlaps(*benches((0, 0, 0)), engine=Engine.ANGLE_SUM, margin=0.05)
    assert caught.value.field == "margin"
