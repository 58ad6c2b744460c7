"""Points of a path for a drawing, and its bends that are too tight."""

import math

import numpy as np
import pytest

from core import Dance, Dragon, InvalidValue, Legs, Route, Spiral, Waypoints, course
from core.paths.following import bends_widely

LONG = Dragon(4)
SHORT = Dragon(4, head_length=0.9, body_length=0.9, overhang=0.1)
CORNERS = ((0.0, 0.0), (20.0, 0.0), (20.0, 20.0))
BACK = ((0.0, 0.0), (40.0, 0.0), (5.0, 7.0))
TIGHT = Legs(CORNERS, [0, 1], radius=1.0)
LOOP = Route([Waypoints([(0, 0), (6, 0), (6.5, 1.0), (6, 2), (0, 2)])])


def test_points_follow_the_path_from_its_beginning_to_its_end():
    result = course(TIGHT, LONG)
    assert result.length == pytest.approx(38.0 + math.pi / 2.0)
    assert np.array_equal(result.points, TIGHT.position(result.s))
    assert result.points[[0, -1]] == pytest.approx(np.array(CORNERS[::2]))
    assert np.diff(result.s).max() <= 0.25


def test_a_tight_bend_is_reported_with_its_place_and_what_a_bench_needs():
    path = Legs(BACK, [0, 1], radius=1.0)
    [bend] = course(path, LONG).bends
    assert (bend.start, bend.end, bend.radius) == pytest.approx((*path.joints, 1.0))
    assert bend.bench == 0
    assert bend.reason == "backwards"
    for more in (1e-9, -1e-9):
        assert bends_widely(LONG, Legs(BACK, [0, 1], radius=bend.least_radius * (1.0 + more))) is (more > 0.0)
    x, y = path.pieces[1].centre
    assert np.linalg.norm(bend.points - [x, y], axis=1) == pytest.approx(np.ones(len(bend.points)))


@pytest.mark.parametrize(
    "path, dragon",
    [
        (TIGHT, LONG),
        (TIGHT, SHORT),
        (Legs(BACK, [0, 1], radius=1.0), LONG),
        (LOOP, LONG),
        (LOOP, SHORT),
        (Spiral(0.3, 4.0), SHORT),
    ],
)
def test_a_path_has_tight_bends_for_those_dragons_that_cannot_dance_it(path, dragon):
    try:
        Dance(dragon, path)
    except InvalidValue:
        assert course(path, dragon).bends
    else:
        assert course(path, dragon).bends == ()
