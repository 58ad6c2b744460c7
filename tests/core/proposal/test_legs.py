"""Legs stay on free ground, and go around what stands in their way."""

from __future__ import annotations

import math

import numpy as np
import pytest
import shapely

from core import Budget, Dragon, Venue
from core.proposal.free_ground import FreeGround
from core.proposal.legs import LegFinder, points_along
from core.proposal.needs import Needs
from core.proposal.walks import joined, moved
from tests.support.random_squares import box, polygon

SQUARE = box("square", 0, 0, 40, 30)
WALL = box("wall", 18, -1, 2, 24)
NEEDS = Needs(Dragon(8), 0.05, 0.0)
BEGIN, END = (4.0, 5.0, 0.0), (36.0, 5.0, 0.0)


def ways(*obstacles: object, needs: Needs = NEEDS) -> LegFinder:
    return LegFinder(FreeGround(Venue(SQUARE, obstacles)), needs, Budget())  # type: ignore[arg-type]


def test_a_free_leg_is_straight() -> None:
    (line,) = joined(ways().leg(BEGIN, END) or [])
    assert line == (pytest.approx(32.0), 0.0)


def test_a_wall_is_gone_around_with_room_on_both_sides() -> None:
    there = ways(WALL)
    assert there.leg(BEGIN, END) is None
    steps = there.around(BEGIN, END)
    assert steps is not None
    pose = BEGIN
    for step in steps:
        pose = moved(pose, step)
    assert pose[:2] == pytest.approx(END[:2], abs=1e-9)
    line = shapely.LineString(points_along(BEGIN, steps, 0.05))
    side = NEEDS.straight_side + NEEDS.free
    assert line.distance(polygon(WALL)) >= side
    assert line.distance(polygon(SQUARE).boundary) >= side


def test_points_are_close_and_on_the_steps() -> None:
    steps = [(3.0, 0.0), (2.0 * math.pi, 0.5), (1.0, -1.0)]
    points = points_along((0.0, 0.0, 0.0), steps)
    assert np.hypot(*np.diff(points, axis=0).T).max() <= 0.35
    pose = (0.0, 0.0, 0.0)
    for step in steps:
        pose = moved(pose, step)
    assert points[-1] == pytest.approx(pose[:2])


def test_the_narrowest_place_is_measured_and_no_leg_leads_through_it() -> None:
    gap = (box("wall", 18, -1, 2, 15.7), box("other", 18, 15, 2, 16))
    there = ways(*gap)
    assert there.around(BEGIN, END) is None
    assert there.narrowest(BEGIN, END) == pytest.approx(0.3, abs=2.0 * there.ground.node_error)
    assert ways().narrowest(BEGIN, END) > 5.0
    closed = ways(box("wall", 18, -1, 2, 32))
    assert closed.narrowest(BEGIN, END) == 0.0
