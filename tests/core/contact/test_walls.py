"""The walls of a venue: distances compared with shapely, first contacts with slow searches, and wrong starts."""

import math

import numpy as np
import pytest
import shapely

from core import (
    Arc,
    Area,
    Budget,
    Dance,
    Dragon,
    FailureKind,
    Line,
    Outcome,
    Passage,
    Route,
    Spiral,
    Venue,
    bench_outlines,
    check,
    trajectory,
    venue_clearance,
)
from tests.core.test_venue import SQUARE, STAGE, WELL, box, boxed
from tests.support.near import assert_near
from tests.support.random_squares import polygon

PROVEN = 1.1e-5  # [m]: a distance is proven to this
AT_MARGIN = 1e-8  # [m]: the distance at the time of first coming within the margin, and in closed form
VENUE = Venue(Area("square", (SQUARE,)), (Area("well", (WELL,)), Area("stage", (STAGE,))))
AROUND = boxed("square", -13, -14, 13.5, 12.5)
# Beside two sides of a stage, and round the corner between them.
CORNER = Dance(
    Dragon(12),
    Route([Line((-30, 0), (12, 0)), Arc((12, 2), 2, -0.5 * math.pi, 0.5 * math.pi), Line((14, 2), (14, 8))], 30.0),
)
# Along the x axis, beside which walls stand in a hall.
STRAIGHT = Route([Line((-60, 0), (60, 0))], start=60.0)
HALL = boxed("square", -70, -9, 70, 9)


def shapely_distances(dance, area, times):
    """Distance of every bench to the edges of an area, (..., n) [m]; 0 where they cross."""
    shapes = shapely.polygons(bench_outlines(dance.dragon, trajectory(dance, times).position))
    return shapely.distance(shapes, polygon(area).boundary)


def test_a_bench_that_is_not_the_head_may_be_the_first_to_touch():
    dance = Dance(Dragon.of([2.2] * 6, [0.3, 0.3, 0.3, 0.9, 0.3, 0.3], [0.275] * 6), STRAIGHT)
    result = venue_clearance(dance, Venue(HALL, (boxed("post", 20, 0.3, 20.5, 1),)), margin=0.05).areas[1]
    assert (result.outcome, result.bench, result.nearest.distance) == (Outcome.CONTACT, 3, 0.0)
    reached = 20.0 + 3 * 1.65 - 0.275
    assert_near([result.time, result.nearest.time, result.point[0]], [reached - 0.05, reached, 19.95], 1e-8)


TREE = Area("tree", (((0.0, -4.723129), (0.1, -5.723129), (-0.1, -5.723129), (0.0, -4.723129)),))
# The place of the least distance, found with slow_search.py and shapely: 3.0085432166 m at 6.50325 s.
TREE_DISTANCE = 3.0085432166
TREE_TIME = 6.5032


@pytest.mark.parametrize("stop", [8.36, None])
def test_a_tree_beside_the_last_metres_before_a_fold_is_seen(stop):
    dance = Dance(Dragon(1), Spiral(0.8, 2.38))
    tree = venue_clearance(dance, Venue(AROUND, (TREE,)), stop=stop).areas[1]
    assert tree.outcome is Outcome.CLEAR
    assert_near([tree.nearest.distance, *tree.nearest.wall], [TREE_DISTANCE, *TREE.rings[0][0]], 1e-8)
    assert tree.nearest.at_least <= TREE_DISTANCE
    assert_near(tree.nearest.time, TREE_TIME, 1e-3)


def test_far_trees_cost_a_quick_answer_nothing_and_near_ones_are_told_from_them():
    places = np.random.default_rng(70).uniform((-60, -7), (60, 7), (60, 2)).tolist()
    trees = tuple(boxed(f"tree {k}", x - 0.2, y - 0.2, x + 0.2, y + 0.2) for k, (x, y) in enumerate(places))
    dance, far = Dance(Dragon(12), STRAIGHT), [boxed(f"{k}", k, 5, k + 0.4, 5.4) for k in range(-50, 50)]
    venue = Venue(HALL, trees)
    quick, whole = (venue_clearance(dance, venue, stray=0.05, nearest=nearest).areas for nearest in (False, True))
    assert [area.outcome for area in quick] == [area.outcome for area in whole]
    assert len({area.outcome for area in quick}) > 1
    spent = []
    for obstacles in ((), far):
        budget = Budget(1e9)
        venue_clearance(dance, Venue(HALL, tuple(obstacles)), nearest=False, budget=budget)
        spent.append(1e9 - budget.left)
    assert spent[0] == spent[1] > 0.0


@pytest.mark.parametrize("before", [1.0, 1e-2, 1e-4, 1e-6])
def test_a_wall_just_before_the_fold_is_met_when_a_bench_gets_there(before):
    """A post whose corner is where the outer rear corner of the head stands at some time [s] before the fold."""
    dance = Dance(Dragon(3), Spiral(0.8, 3.0))
    at = dance.end.time - before
    rear = bench_outlines(dance.dragon, trajectory(dance, at).position)[2, 3]
    out = rear / np.hypot(*rear)
    corner = rear - 0.001 * out
    side = 0.02 * np.array([-out[1], out[0]])
    ring = [tuple(place) for place in (corner, corner + 0.5 * out - side, corner + 0.5 * out + side, corner)]
    post = Area("post", (tuple(ring),))
    result = venue_clearance(dance, Venue(AROUND, (post,)), start=dance.end.time - 2.0 * before).areas[1]
    assert shapely_distances(dance, post, at).min() == 0.0
    assert result.outcome in (Outcome.CONTACT, Outcome.CONTACT_AT_START)
    if result.time_bracket is not None:
        clear, touch = result.time_bracket
        assert clear <= at
        assert shapely_distances(dance, post, touch).min() < AT_MARGIN


@pytest.mark.parametrize("slope", [1e-2, 1e-4, 1e-7])
@pytest.mark.parametrize(
    "passages, pause", [([], 0.0), ([Passage(1.0, until_s=10.0), Passage(0.0, until_time=13.0)], 3.0)]
)
def test_a_wall_is_met_within_a_nanosecond_however_slowly_a_bench_comes_near(slope, passages, pause):
    left, right = ((x, 0.15 + slope * (30.0 - x)) for x in (-50.0, 55.0))
    wall = Area("wall", ((left, right, (55.0, 5.0), (-50.0, 5.0), left),))
    dance = Dance(Dragon(5), STRAIGHT, 1.0, passages)
    result = venue_clearance(dance, Venue(HALL, (wall,)), nearest=False).areas[1]
    assert result.outcome is Outcome.CONTACT
    clear, touching = result.time_bracket
    assert touching - clear <= 1e-9 * (1.0 + 1e-5)
    at = 29.725 + pause  # the head's front corner, at 0.15 m, is there
    rounding = 1e-16 / slope  # of the heights of the wall
    assert clear - rounding <= at <= touching + rounding


def test_a_wall_that_stays_at_the_margin_is_undecided_until_a_bench_is_surely_nearer():
    """A parallel wall at the margin but for its last digits, and a step of it further on."""
    ring = ((-50.0, 0.35), (40.0, 0.35), (40.0, 0.3), (50.0, 0.3), (50.0, 5.0), (-50.0, 5.0), (-50.0, 0.35))
    venue = Venue(HALL, (Area("wall", (ring,)),))
    dance = Dance(Dragon(5), STRAIGHT)
    margin = 0.35 - 0.15
    result = venue_clearance(dance, venue, margin=margin).areas[1]
    assert (result.outcome, result.bench, result.time, result.overlapping) == (Outcome.UNDECIDED, None, None, 0)
    touching = result.time_bracket[1]
    assert shapely_distances(dance, venue.obstacles[0], touching).min() < 0.2
    failures = check(dance, venue=venue, margin=margin, start=0.0).failures
    (failure,) = (failure for failure in failures if failure.area == "wall")
    assert (failure.kind, failure.benches, failure.time) == (FailureKind.VENUE, (0,), touching)
    assert failure.time_bracket == result.time_bracket


LAKE = box(-32, -1, 3, 1)


@pytest.mark.parametrize(
    "venue, misplaced",
    [
        (VENUE, None),
        (Venue(boxed("square", 100, 100, 120, 120)), "square"),
        (Venue(Area("square", (SQUARE, LAKE))), "square"),
        (Venue(VENUE.square, (Area("lake", (LAKE,)),)), "lake"),
    ],
    ids=["inside", "wholly outside", "in a hole", "in an obstacle"],
)
def test_a_dragon_that_starts_outside_or_in_an_obstacle_is_misplaced(venue, misplaced):
    result = venue_clearance(CORNER, venue)
    assert (result.misplaced and (result.misplaced.name, result.misplaced.bench)) == (misplaced and (misplaced, 0))
    assert result.areas[0].outcome is (Outcome.CONTACT if venue.square.rings[1:] else Outcome.CLEAR)
    for area in result.areas:
        assert area.nearest.distance == 0.0 or 0.0 <= area.nearest.distance - area.nearest.at_least < PROVEN
