"""Stretches of a path on which benches break a limit, against shapely at the same samples."""

from __future__ import annotations

import math

import numpy as np
import pytest
import shapely

from core import Area, Dance, Dragon, InvalidValue, Legs, Line, Route, Venue, bench_outlines, trajectory
from core.breaches import Breach, BreachKind, breaches
from core.motion.places import handle_places
from tests.support.random_squares import box, polygon

LANE = Dance(Dragon(3), Route([Line((0, 0), (30, 0))]))
EMPTY_SQUARE = box("plain", -9, -9, 48, 18)
TREE = box("tree", 14, 0.2, 2, 2)
BEND = Dance(Dragon(6), Legs([(0, 0), (12, 0), (18, 6), (12, 12), (0, 12)], [0, 3], radius=4.0))
ROOM = Venue(box("room", -1, -1, 21.5, 14), (box("stage", 9, 4, 4, 4),))


def kinds(result: tuple[Breach, ...]) -> set[BreachKind]:
    return {one.kind for one in result}


def samples(dance: Dance) -> np.ndarray:
    """The times of the samples: 0.3 m of the head's way apart."""
    begin, until = dance.span()
    way = dance.clock.travel(until) - dance.clock.travel(begin)
    return np.linspace(begin, until, int(way / 0.3) + 2)


def test_a_bench_beside_a_tree_marks_the_stretch_between_its_handles() -> None:
    venue = Venue(EMPTY_SQUARE, (TREE,))
    assert breaches(LANE, venue) == ()
    (one,) = breaches(LANE, venue, margin=0.06)
    assert one.kind is BreachKind.MARGIN
    # The benches are 0.15 m wide on this side; the longest one reaches 0.275 m beyond its handles.
    assert 14.0 - 2.9 - 0.35 < one.start < 14.0
    assert 16.0 < one.end < 16.0 + 2.9 + 0.35
    assert one.points[0].tolist() == pytest.approx([one.start, 0.0])
    assert one.points[-1].tolist() == pytest.approx([one.end, 0.0])
    assert kinds(breaches(LANE, venue, stray=0.06)) == {BreachKind.STRAY}
    assert kinds(breaches(LANE, venue, margin=0.06, stray=0.06)) == {BreachKind.MARGIN, BreachKind.STRAY}


def test_a_bench_far_outside_the_square_or_inside_a_stage_is_marked() -> None:
    far = Venue(box("far", 60, 60, 9, 9))
    (one,) = breaches(LANE, far)
    assert (one.kind, one.start < 0.5, one.end > 29.5) == (BreachKind.MARGIN, True, True)
    wide = Venue(EMPTY_SQUARE, (box("stage", -4, -4, 40, 8),))
    assert kinds(breaches(LANE, wide)) == {BreachKind.MARGIN}


def test_fast_handles_are_marked_where_they_are_fast() -> None:
    times = samples(BEND)
    speed, s = trajectory(BEND, times).speed, handle_places(BEND, times)
    most = float(speed.max())
    assert breaches(BEND, speed_limit=1.001 * most) == ()
    limit = 0.5 * (1.0 + most)
    result = breaches(BEND, speed_limit=limit)
    assert kinds(result) == {BreachKind.SPEED}
    inside = np.any([(one.start <= s) & (s <= one.end) for one in result], axis=0)
    assert inside[speed > limit].all()
    for one in result:
        fast = s[speed > limit]
        assert np.abs(fast - one.start).min() == pytest.approx(0.15)
        assert np.abs(fast - one.end).min() == pytest.approx(0.15)


@pytest.mark.parametrize("margin", [0.0, 0.4, 1.0])
def test_the_marked_places_are_those_of_a_slow_look_with_shapely(margin: float) -> None:
    result = [one for one in breaches(BEND, ROOM, margin=margin) if one.kind is BreachKind.MARGIN]
    times = samples(BEND)
    rows, places = shapely.polygons(bench_outlines(BEND.dragon, trajectory(BEND, times).position)), []
    square, stage = polygon(ROOM.square), polygon(ROOM.obstacles[0])
    for row, s in zip(rows, handle_places(BEND, times), strict=True):
        for k, bench in enumerate(row):
            others = [one for i, one in enumerate(row) if abs(i - k) > 1]
            near = min([bench.distance(one) for one in (square.boundary, stage, *others)])
            if near <= margin or not square.contains(bench):
                places.append((s[k + 1], s[k]))
    for low, high in places:
        assert any(one.start <= low and high <= one.end for one in result)
    edges = {round(edge, 6) for place in places for edge in place}
    assert {round(edge, 6) for one in result for edge in (one.start, one.end)} <= edges


def test_many_benches_and_edges_cost_few_samples() -> None:
    corners = [(40 * math.cos(k * math.tau / 900), 40 * math.sin(k * math.tau / 900)) for k in range(900)]
    round_square = Venue(Area("round", ((*corners, corners[0]),)))
    dance = Dance(Dragon(100), Route([Line((-100, 0), (100, 0))]))
    before, after = breaches(dance, round_square)
    assert kinds((before, after)) == {BreachKind.MARGIN}
    assert before.end == pytest.approx(60.0, abs=3.0)
    assert after.start == pytest.approx(140.0, abs=3.0)


def test_only_the_asked_time_is_looked_at() -> None:
    venue = Venue(EMPTY_SQUARE, (TREE,))
    begin, until = LANE.span()
    (one,) = breaches(LANE, venue, margin=0.06, start=0.5 * until)
    assert one.start > breaches(LANE, venue, margin=0.06)[0].start + 0.5
    assert breaches(LANE, venue, margin=0.06, stop=begin + 1.0) == ()


def test_a_wrong_number_is_named() -> None:
    with pytest.raises(InvalidValue, match="margin must be zero or more, got -1 m"):
        breaches(LANE, margin=-1.0)
    with pytest.raises(InvalidValue, match="speed_limit must be "):
        breaches(LANE, speed_limit=0.0)
