"""Stretches of a path on which benches break a limit, against shapely at the same samples."""

import numpy as np
import pytest
import shapely

from core import Dance, Dragon, Legs, Venue, bench_outlines, check, trajectory
from core.breaches import BreachKind, breaches_and_gaps
from core.motion.places import handle_places
from tests.support.random_squares import box, polygon
from tests.support.refused import refused
from tests.support.shared_dances import lane

LANE = Dance(Dragon(3), lane((0, 0), (30, 0)))
SQUARE = box("plain", -9, -9, 48, 18)
TREE = Venue(SQUARE, (box("tree", 14, 0.2, 2, 2),))
BEND = Dance(Dragon(6), Legs([(0, 0), (12, 0), (18, 6), (12, 12), (0, 12)], [0, 3], radius=4.0))
ROOM = Venue(box("room", -1, -1, 21.5, 14), (box("stage", 9, 4, 4, 4),))


def breaches(*args, **options):
    return breaches_and_gaps(*args, **options)[0]


def kinds(*args, **options):
    return {one.kind for one in breaches(*args, **options)}


def sampled():
    """Times 0.3 m of the head's way apart."""
    begin, until = BEND.span()
    way = BEND.clock.travel(until) - BEND.clock.travel(begin)
    times = np.linspace(begin, until, int(way / 0.3) + 2)
    return trajectory(BEND, times), handle_places(BEND, times)


def test_a_bench_beside_a_tree_marks_the_stretch_between_its_handles():
    assert breaches(LANE, TREE) == ()
    (one,) = breaches(LANE, TREE, margin=0.06)
    assert one.kind is BreachKind.MARGIN
    # The benches are 0.15 m wide on this side; the longest one reaches 0.275 m beyond its handles.
    assert 14.0 - 2.9 - 0.35 < one.start < 14.0
    assert 16.0 < one.end < 16.0 + 2.9 + 0.35
    assert one.points[[0, -1]] == pytest.approx(np.array([[one.start, 0.0], [one.end, 0.0]]))
    assert kinds(LANE, TREE, margin=0.06, stray=0.3) == {BreachKind.MARGIN, BreachKind.STRAY}


@pytest.mark.parametrize("dance, venue", [(LANE, TREE), (BEND, ROOM)], ids=["a tree", "a bend in a room"])
def test_nothing_is_marked_where_the_check_passes_with_people_who_stray(dance, venue):
    verdicts = set()
    for stray in (0.03, 0.3, 0.5, 0.54, 0.56, 0.7, 0.8):
        verdict = check(dance, venue=venue, stray=stray).verdict
        marked = kinds(dance, venue, stray=stray)
        assert marked == (set() if verdict == "passes" else {BreachKind.STRAY})
        verdicts.add(verdict)
    assert verdicts == {"passes", "fails"}


def test_only_the_asked_time_is_looked_at():
    begin, until = LANE.span()
    (whole,), (late,) = (breaches(LANE, TREE, margin=0.06, start=start) for start in (None, 0.5 * until))
    assert late.start > whole.start + 0.5
    assert breaches(LANE, TREE, margin=0.06, stop=begin + 1.0) == ()


def test_fast_handles_are_marked_where_they_are_fast():
    motion, s = sampled()
    most = float(motion.speed.max())
    assert breaches(BEND, speed_limit=1.001 * most) == ()
    limit = 0.5 * (1.0 + most)
    fast = s[motion.speed > limit]
    result = breaches(BEND, speed_limit=limit)
    assert np.any([(one.start <= fast) & (fast <= one.end) for one in result], axis=0).all()
    assert {one.kind for one in result} == {BreachKind.SPEED}


@pytest.mark.parametrize("margin", [0.0, 0.4, 1.0])
def test_the_marked_places_are_those_of_a_slow_look_with_shapely(margin):
    result = [one for one in breaches(BEND, ROOM, margin=margin) if one.kind is BreachKind.MARGIN]
    motion, places = sampled()
    square = polygon(ROOM.square)
    stage = polygon(ROOM.obstacles[0])
    marked = []
    for row, s in zip(shapely.polygons(bench_outlines(BEND.dragon, motion.position)), places, strict=True):
        for k, bench in enumerate(row):
            others = [one for i, one in enumerate(row) if abs(i - k) > 1]
            near = min(map(bench.distance, (square.boundary, stage, *others)))
            if near <= margin or not square.contains(bench):
                marked.append((s[k + 1], s[k]))
    for low, high in marked:
        assert any(one.start <= low and high <= one.end for one in result)
    assert {round(edge, 6) for one in result for edge in (one.start, one.end)} <= set(np.ravel(marked).round(6))


def test_a_wrong_number_is_named():
    with refused("margin"):
        breaches(LANE, margin=-1.0)
