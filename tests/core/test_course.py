"""Points of a path for a drawing, and its bends that are too tight."""

from __future__ import annotations

import math

import numpy as np
import pytest

from core import Dance, Dragon, InvalidValue, Legs, Route, Spiral, Waypoints, course
from core.paths.following import follows

LONG, SHORT = Dragon(4), Dragon(4, head_length=0.9, body_length=0.9, overhang=0.1)
CORNER = ((0.0, 0.0), (20.0, 0.0), (20.0, 20.0))


def test_points_follow_the_path_from_its_beginning_to_its_end() -> None:
    path = Legs(CORNER, [0, 1], radius=1.0)
    result = course(path, LONG)
    assert result.length == pytest.approx(38.0 + math.pi / 2.0)
    assert np.array_equal(result.points, path.position(result.s))
    assert result.points[[0, -1]] == pytest.approx(np.array([CORNER[0], CORNER[2]]))
    assert np.diff(result.s).max() <= 0.25


def test_a_tight_bend_is_reported_with_its_place_and_what_a_bench_needs() -> None:
    [bend] = course(Legs(CORNER, [0, 1], radius=1.0), LONG).bends
    assert (bend.start, bend.end, bend.radius) == pytest.approx((19.0, 19.0 + math.pi / 2.0, 1.0))
    assert bend.bench == 0
    assert follows(LONG, Legs(CORNER, [0, 1], radius=bend.least_radius * (1.0 + 1e-9)))
    assert not follows(LONG, Legs(CORNER, [0, 1], radius=bend.least_radius * (1.0 - 1e-9)))
    assert np.hypot(*(bend.points - [19.0, 1.0]).T) == pytest.approx(np.ones(len(bend.points)))
    with pytest.raises(InvalidValue, match="must not bend tighter"):
        Dance(LONG, Legs(CORNER, [0, 1], radius=1.0))


@pytest.mark.parametrize("path", [Legs(CORNER, [0, 1], radius=1.0), Spiral(0.3, 4.0)])
def test_what_can_be_danced_has_no_tight_bend(path: Route | Spiral) -> None:
    assert Dance(SHORT, path).end.time > 0.0
    assert course(path, SHORT).bends == ()


def test_a_bend_of_a_curve_through_points_is_too_tight_for_the_same_benches_as_a_dance() -> None:
    path = Route([Waypoints([(0, 0), (6, 0), (6.5, 1.0), (6, 2), (0, 2)])])
    for benches in (LONG, SHORT):
        try:
            Dance(benches, path)
        except InvalidValue:
            assert course(path, benches).bends
        else:
            assert course(path, benches).bends == ()


def test_a_path_of_another_type_is_refused() -> None:
    with pytest.raises(InvalidValue, match="path"):
        course("circle", LONG)  # type: ignore[arg-type]
