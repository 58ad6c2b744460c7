"""Poses that show a contact: they overlap, keep every chord, and stray little further than what is proven safe."""

from __future__ import annotations

import math

import numpy as np
import pytest
import shapely

from core import Dance, Dragon, Line, Route, Spiral, bench_outlines, separation, tolerance, trajectory
from core.tolerance.exhibit import Body, body, extended, nearest_rotated
from tests.campaigns.adversaries import to_circle
from tests.core.tolerance.test_tolerance import BRACKET

WIDE_SPIRAL = 6e-3  # the same of 40 benches with strays of 38 cm [1]
FAR = 0.6  # strays at which a chain bends visibly [m]
CHORD_ERROR = 1e-12  # [m]
GAP_ERROR = 1e-6  # [m]: the direction that keeps two corners apart is found by narrowing grids


def test_the_pose_that_is_shown_overlaps_little_also_where_the_first_one_tried_does_not() -> None:
    result = tolerance(Dance(Dragon(40, 2.6, 2.4, 0.2, 0.2), Spiral(1.1, start_turns=10)), stop=40.0)
    touching = result.stray_bracket[1]
    assert touching is not None
    assert touching < result.stray * (1.0 + WIDE_SPIRAL)


def test_the_benches_between_two_that_stray_far_stray_no_further() -> None:
    result = tolerance(Dance(Dragon(36, 3.6, 1.95, 0.2, 0.06), Spiral(1.08, start_turns=10)), stop=22.0)
    touching = result.stray_bracket[1]
    assert touching is not None
    assert result.stray > FAR
    assert touching < result.stray * (1.0 + BRACKET)


def test_the_shown_contact_is_one() -> None:
    dance, stop = to_circle(0.55)
    result = tolerance(dance, stop=stop)
    pose = result.exhibit
    assert pose is not None
    assert pose.benches == result.benches == (0, 19)
    nominal = trajectory(dance, pose.time).position
    assert np.hypot(*(pose.handles - nominal).T).max() == pose.stray == result.stray_bracket[1]
    chords = np.hypot(*np.diff(pose.handles, axis=0).T)
    assert np.abs(chords - dance.dragon.chords).max() < CHORD_ERROR
    a, b = (shapely.Polygon(bench_outlines(dance.dragon, pose.handles)[k]) for k in pose.benches)
    assert a.intersection(b).area > 0.0


@pytest.mark.parametrize("width", [0.5, 0.4])
def test_where_benches_next_but_one_limit_the_stray_a_pose_of_all_three_shows_a_contact(width: float) -> None:
    """Short chords and wide benches: a small bend of all three is enough."""
    dragon = Dragon(20, body_length=1.2, width=width)
    result = tolerance(Dance(dragon, Route([Line((0.0, 0.0), (50.0, 0.0))])))
    safe, touching = result.stray_bracket
    assert touching is not None
    assert result.exhibit is not None
    a, b = result.exhibit.benches
    assert b == a + 2
    assert "are held apart by it" in result.certificate.method
    assert 1.5 * result.independent < safe < touching < 1.06 * safe
    chords = np.hypot(*np.diff(result.exhibit.handles, axis=0).T)
    assert np.abs(chords - dragon.chords).max() < CHORD_ERROR
    rows = [shapely.Polygon(bench_outlines(dragon, result.exhibit.handles)[k]) for k in (a, b)]
    assert rows[0].intersection(rows[1]).area > 0.0


def test_the_pose_is_of_those_three_in_a_row_that_fold_with_the_least_strays() -> None:
    """The head and bench 2 come first where benches are taken to be independent, but fold with 10 cm only."""
    dance = Dance(Dragon(20, body_length=1.2, width=0.5), Spiral(5.0))
    result = tolerance(dance, stop=dance.path.travel_to(20.0))
    safe, touching = result.stray_bracket
    assert touching is not None
    assert result.exhibit is not None
    assert result.benches == result.exhibit.benches == (1, 3)
    assert 0.06 < safe < touching < 1.03 * safe


def test_without_a_stray_the_nearest_rotated_benches_have_the_gap_of_the_benches_as_they_are() -> None:
    rng = np.random.default_rng(8)
    apart = 0
    for x, y, one, other in rng.uniform([0.0, 0.0, -3.0, -3.0], [4.0, 4.0, 3.0, 3.0], (50, 4)).tolist():
        a, b = Body(0.0, 0.0, one, 1.65, 1.1, 0.15), Body(x, y, other, 1.65, 1.1, 0.15)
        known = separation([0.0, 0.0, one], [2.2, 0.3], [x, y, other], [2.2, 0.3])
        bearing = math.atan2(known.normal[1], known.normal[0])
        assert nearest_rotated(a, b, bearing, 0.0)[:3] == (pytest.approx(known.separation, abs=GAP_ERROR), 0.0, 0.0)
        apart += known.separation > 0.0
    assert 25 < apart < 50


def test_the_handles_around_two_benches_follow_and_stray_less_and_less() -> None:
    dragon, stray = Dragon(12), 0.05
    handles = trajectory(Dance(dragon, Spiral()), 200.0).position
    wanted = {k: body(dragon, handles, k).strays(way, 0.02, stray) for k, way in ((2, 0.5), (8, 2.5))}
    moved = extended(dragon.chords, handles, wanted)
    assert moved is not None
    assert np.hypot(*np.diff(moved, axis=0).T) == pytest.approx(dragon.chords, abs=CHORD_ERROR)
    for k, strays in wanted.items():
        assert np.array_equal(moved[k : k + 2], handles[k : k + 2] + strays)
        assert np.hypot(*strays.T).max() == pytest.approx(stray, abs=CHORD_ERROR)
    far = np.hypot(*(moved - handles).T)
    assert (np.diff(far[:4]) >= 0.0)[:2].all()
    assert (np.diff(far[9:]) <= 0.0).all()
