"""The walls of a venue: distances compared with shapely, first contacts with slow searches, and wrong starts."""

from __future__ import annotations

import math

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from core import (
    Arc,
    Area,
    Coil,
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
    bench_poses,
    check,
    trajectory,
    venue_clearance,
)
from core.contact.search import ContactSearch
from core.shapes.rectangles import corners
from tests.core.test_venue import SQUARE, STAGE, WELL, box, boxed
from tests.support.depth import examples

SAME_DISTANCE = 1e-11  # [m]: ours and shapely's, at coordinates to 30 m
PROVEN = 1.1e-5  # [m]: a distance is proven to this
AT_MARGIN = 1e-8  # [m]: the distance at the time of first coming within the margin, and in closed form
TIME_ERROR = 1e-9  # [s]
DRAGON = Dragon(benches=12)
# Around a hall of 12 x 6 m with rounded corners, anti-clockwise; one lap is 2 (12 + 6) + 4 pi long.
LAP = Route(
    [
        Line((-30, 0), (12, 0)),
        Arc((12, 2), 2, -0.5 * math.pi, 0.5 * math.pi),
        Line((14, 2), (14, 8)),
        Arc((12, 8), 2, 0, 0.5 * math.pi),
        Line((12, 10), (0, 10)),
        Arc((0, 8), 2, 0.5 * math.pi, 0.5 * math.pi),
        Line((-2, 8), (-2, 2)),
    ],
    start=30.0,
)
VENUE = Venue(Area("square", (SQUARE,)), (Area("well", (WELL,)), Area("stage", (STAGE,))))
VENUE_ROUND = Venue(boxed("square", -13, -14, 13.5, 12.5))


def shapely_distances(dragon: Dragon, path: Spiral | Route, area: Area, times: np.ndarray) -> np.ndarray:
    """Distance of every bench to the edges of an area, (T, n) [m]; 0 where they cross."""
    sizes = np.broadcast_to(np.stack([dragon.lengths, dragon.widths], axis=-1), (times.size, dragon.benches, 2))
    shapes = shapely.polygons(corners(bench_poses(trajectory(Dance(dragon, path), times).position), sizes))
    return shapely.distance(shapes, shapely.Polygon(area.rings[0], area.rings[1:]).boundary)


@pytest.mark.parametrize("area", VENUE.areas, ids=lambda area: area.name)
def test_distances_on_sampled_poses_are_shapelys(area: Area) -> None:
    search = ContactSearch(DRAGON, LAP, 0.0, area.edges)
    times = np.linspace(0.0, LAP.end, 60)
    known = shapely_distances(DRAGON, LAP, area, times)
    for time, row in zip(times.tolist(), known, strict=True):
        distance, (bench, _) = search.clearance(time)
        assert max(distance, 0.0) == pytest.approx(row.min(), abs=SAME_DISTANCE)
        if distance > 0.0:
            assert row[bench] == pytest.approx(row.min(), abs=SAME_DISTANCE)


@pytest.mark.parametrize("k", range(3), ids=[area.name for area in VENUE.areas])
def test_the_least_distance_is_the_least_of_dense_samples(k: int) -> None:
    nearest = venue_clearance(Dance(DRAGON, LAP), VENUE).areas[k].nearest
    times = np.linspace(0.0, LAP.end, 4_000)
    sampled = shapely_distances(DRAGON, LAP, VENUE.areas[k], times).min()
    assert nearest.at_least is not None
    assert nearest.at_least <= nearest.distance <= sampled + SAME_DISTANCE
    assert nearest.distance - nearest.at_least < PROVEN
    there = shapely_distances(DRAGON, LAP, VENUE.areas[k], np.array([nearest.time]))[0]
    assert there[nearest.bench] == pytest.approx(nearest.distance, abs=SAME_DISTANCE)
    assert math.dist(nearest.point, nearest.wall) == pytest.approx(nearest.distance, abs=SAME_DISTANCE)
    boundary = shapely.Polygon(VENUE.areas[k].rings[0]).boundary
    assert boundary.distance(shapely.Point(nearest.wall)) < SAME_DISTANCE


@settings(max_examples=examples(10, 25), deadline=None)
@given(
    st.floats(-6.0, 18.0),
    st.floats(-4.0, 14.0),
    st.floats(0.2, 3.0),
    st.floats(0.0, 3.0),
    st.integers(3, 9),
    st.floats(0.0, 0.6),
)
def test_any_obstacle_is_met_when_a_slow_search_meets_it(
    x: float, y: float, radius: float, turned: float, sides: int, margin: float
) -> None:
    angles = turned + np.linspace(0.0, 2.0 * math.pi, sides, endpoint=False)
    ring = tuple((x + radius * math.cos(a), y + radius * math.sin(a)) for a in angles)
    post = Area("post", ((*ring, ring[0]),))
    venue = Venue(VENUE.square, (post,))
    result = venue_clearance(Dance(DRAGON, LAP), venue, margin=margin).areas[1]
    times = np.linspace(0.0, LAP.end, 1_500)
    slow = shapely_distances(DRAGON, LAP, post, times).min(axis=1)
    assert result.nearest.at_least is not None
    assert result.nearest.at_least <= slow.min() + SAME_DISTANCE
    assert result.nearest.distance <= slow.min() + PROVEN
    if result.outcome is Outcome.CLEAR:
        assert slow.min() > margin
        assert result.nearest.distance > margin
    elif result.outcome is Outcome.CONTACT_AT_START:
        assert slow[0] <= margin + SAME_DISTANCE
    else:
        assert result.outcome is Outcome.CONTACT
        assert result.time_bracket is not None
        clear, touching = result.time_bracket
        assert slow[times < clear].min() > margin
        assert shapely_distances(DRAGON, LAP, post, np.array([touching])).min() < margin + AT_MARGIN


def test_a_wall_across_the_way_is_met_where_the_head_reaches_it() -> None:
    route = Route([Line((-60, 0), (60, 0))], start=60.0)
    wall = Venue(boxed("square", -70, -9, 70, 9), (boxed("wall", 20, -1, 21, 1),))
    result = venue_clearance(Dance(DRAGON, route), wall, margin=0.25).areas[1]
    assert result.outcome is Outcome.CONTACT
    assert result.time == pytest.approx(20.0 - 0.275 - 0.25, abs=TIME_ERROR)
    assert result.bench == 0
    assert result.point is not None
    assert result.point[0] == pytest.approx(19.75, abs=AT_MARGIN)
    assert result.nearest.distance == 0.0
    assert result.nearest.time == pytest.approx(20.0 - 0.275, abs=TIME_ERROR)


def test_a_bench_that_is_not_the_head_may_be_the_first_to_touch() -> None:
    dragon = Dragon.of([2.2] * 6, [0.3, 0.3, 0.3, 0.9, 0.3, 0.3], [0.275] * 6)
    route = Route([Line((-60, 0), (60, 0))], start=60.0)
    square = Venue(boxed("square", -70, -9, 70, 9), (boxed("post", 20, 0.3, 20.5, 1),))
    result = venue_clearance(Dance(dragon, route), square).areas[1]
    assert result.bench == 3
    assert result.time == pytest.approx(20.0 + 3 * 1.65 - 0.275, abs=TIME_ERROR)
    assert result.nearest.distance == 0.0
    clear = venue_clearance(Dance(dragon, route), square, stop=20.0).areas[1]
    assert clear.outcome is Outcome.CLEAR
    assert clear.nearest.distance == pytest.approx(0.15, abs=SAME_DISTANCE)


def test_a_spiral_keeps_its_place_in_the_world() -> None:
    dragon = Dragon(40)
    known = shapely_distances(dragon, Spiral(), VENUE_ROUND.square, np.linspace(0.0, 400.0, 1_500))
    result = venue_clearance(Dance(dragon, Spiral()), VENUE_ROUND, stop=400.0)
    nearest = result.areas[0].nearest
    assert result.misplaced is None
    assert nearest.distance <= known.min() + SAME_DISTANCE
    assert nearest.distance == pytest.approx(known.min(), abs=1e-3)  # the samples are 0.27 s apart


@pytest.mark.parametrize(("start", "stop"), [(-60.0, -20.0), (-5.0, 0.0), (0.0, 1e-3)])
def test_a_spiral_has_its_place_also_before_its_start(start: float, stop: float) -> None:
    result = venue_clearance(Dance(Dragon(benches=9), Spiral()), VENUE_ROUND, start=start, stop=stop).areas[0].nearest
    known = shapely_distances(Dragon(benches=9), Spiral(), VENUE_ROUND.square, np.linspace(start, stop, 400))
    assert result.distance <= known.min() + PROVEN
    assert result.distance == pytest.approx(known.min(), abs=1e-3)


TREE = Area("tree", (((0.0, -4.723129), (0.1, -5.723129), (-0.1, -5.723129), (0.0, -4.723129)),))
# The place of the least distance, found with slow_search.py and shapely: 3.0085432166 m at 6.50325 s.
TREE_DISTANCE, TREE_TIME = 3.0085432166, 6.5032


@pytest.mark.parametrize("stop", [8.36, None])
def test_a_tree_beside_the_last_metres_before_a_fold_is_seen(stop: float | None) -> None:
    dance = Dance(Dragon(1), Spiral(0.8, 2.38))
    tree = venue_clearance(dance, Venue(VENUE_ROUND.square, (TREE,)), stop=stop).areas[1]
    assert tree.outcome is Outcome.CLEAR
    assert tree.nearest.distance == pytest.approx(TREE_DISTANCE, abs=1e-8)
    assert tree.nearest.at_least is not None
    assert tree.nearest.at_least <= TREE_DISTANCE
    assert tree.nearest.time == pytest.approx(TREE_TIME, abs=1e-3)


@pytest.mark.parametrize("before", [1.0, 1e-2, 1e-4, 1e-6])
def test_a_wall_just_before_the_fold_is_met_when_a_bench_gets_there(before: float) -> None:
    """A post whose corner is where the outer rear corner of the head stands at some time [s] before the fold."""
    dance = Dance(Dragon(3), Spiral(0.8, 3.0))
    at = dance.end.time - before
    ahead = shapely_distances(dance.dragon, dance.path, TREE, np.array([at - 1e-9 * before]))  # poses exist there
    assert np.isfinite(ahead).all()
    x, y = bench_outlines(dance.dragon, trajectory(dance, [at]).position)[0, 2, 3]
    out = np.array([x, y]) / np.hypot(x, y)
    side = np.array([-out[1], out[0]])
    corner = np.array([x, y]) - 0.001 * out
    ring = [tuple(corner + 0.5 * out + k * 0.02 * side) for k in (-1, 1)]
    post = Area("post", ((tuple(corner), *ring, tuple(corner)),))
    result = venue_clearance(dance, Venue(VENUE_ROUND.square, (post,)), start=dance.end.time - 2.0 * before).areas[1]
    touching = shapely_distances(dance.dragon, dance.path, post, np.array([at])).min()
    assert touching == 0.0
    assert result.outcome in (Outcome.CONTACT, Outcome.CONTACT_AT_START)
    if result.time_bracket is not None:
        clear, touch = result.time_bracket
        assert clear <= at
        assert shapely_distances(dance.dragon, dance.path, post, np.array([touch])).min() < AT_MARGIN


@pytest.mark.parametrize("slope", [1e-2, 1e-4, 1e-7])
@pytest.mark.parametrize("pause", [False, True])
def test_a_wall_is_met_within_a_nanosecond_however_slowly_a_bench_comes_near(slope: float, pause: bool) -> None:
    route = Route([Line((-60, 0), (60, 0))], start=60.0)
    passages = [Passage(1.0, until_s=10.0), Passage(0.0, until_time=13.0)] if pause else []

    def height(x: float) -> float:
        return 0.15 + slope * (30.0 - x)  # the head's front corner, at 0.15 m, is there at 29.725 s

    wall = Area(
        "wall", (((-50.0, height(-50.0)), (55.0, height(55.0)), (55.0, 5.0), (-50.0, 5.0), (-50.0, height(-50.0))),)
    )
    square = Venue(boxed("square", -70, -9, 70, 9), (wall,))
    result = venue_clearance(Dance(Dragon(5), route, 1.0, passages), square, nearest=False).areas[1]
    assert result.outcome is Outcome.CONTACT
    assert result.time_bracket is not None
    clear, touching = result.time_bracket
    assert touching - clear <= 1e-9 * (1.0 + 1e-5)
    at = 29.725 + (3.0 if pause else 0.0)
    rounding = 1e-16 / slope  # of the heights of the wall
    assert clear - rounding <= at <= touching + rounding


def test_a_wall_that_stays_at_the_margin_is_undecided_until_a_bench_is_surely_nearer() -> None:
    """A parallel wall at the margin but for its last digits, and a step of it further on."""
    route = Route([Line((-60, 0), (60, 0))], start=60.0)
    ring = ((-50.0, 0.35), (40.0, 0.35), (40.0, 0.3), (50.0, 0.3), (50.0, 5.0), (-50.0, 5.0), (-50.0, 0.35))
    venue = Venue(boxed("square", -70, -9, 70, 9), (Area("wall", (ring,)),))
    dance = Dance(Dragon(5), route)
    result = venue_clearance(dance, venue, margin=0.35 - 0.15).areas[1]
    assert (result.outcome, result.bench, result.time) == (Outcome.UNDECIDED, None, None)
    assert result.overlapping == 0
    assert result.time_bracket is not None
    touching = result.time_bracket[1]
    assert shapely_distances(dance.dragon, route, venue.obstacles[0], np.array([touching])).min() < 0.2
    failure = next(
        one for one in check(dance, venue=venue, margin=0.35 - 0.15, start=0.0).failures if one.area == "wall"
    )
    assert (failure.kind, failure.benches, failure.time_bracket) == (FailureKind.VENUE, (0,), result.time_bracket)
    assert failure.time == touching
    assert "at the latest" in failure.message


def test_a_dragon_inside_the_square_is_not_misplaced() -> None:
    assert venue_clearance(Dance(DRAGON, LAP), VENUE).misplaced is None


def test_a_dragon_wholly_outside_fails_though_it_touches_nothing() -> None:
    far = Venue(boxed("square", 100, 100, 120, 120))
    result = venue_clearance(Dance(DRAGON, LAP), far)
    assert result.misplaced is not None
    assert (result.misplaced.name, result.misplaced.bench) == ("square", 0)
    assert result.areas[0].outcome is Outcome.CLEAR


def test_the_first_bench_outside_is_named_with_its_place() -> None:
    small = Venue(boxed("square", -8, -5, 20, 20))
    result = venue_clearance(Dance(DRAGON, LAP), small)
    centres = bench_poses(trajectory(Dance(DRAGON, LAP), [0.0]).position[0])[:, 0]
    assert result.misplaced is not None
    assert result.misplaced.bench == int(np.argmax(centres < -8.0))
    assert result.misplaced.point == pytest.approx((centres[result.misplaced.bench], 0.0), abs=SAME_DISTANCE)


@pytest.mark.parametrize("hole", [True, False], ids=["hole", "obstacle"])
def test_a_bench_inside_a_hole_or_an_obstacle_is_reported(hole: bool) -> None:
    lake = box(-32, -1, 3, 1)
    square = Area("square", (SQUARE, lake) if hole else (SQUARE,))
    result = venue_clearance(Dance(DRAGON, LAP), Venue(square, () if hole else (Area("lake", (lake,)),)))
    assert result.misplaced is not None
    assert (result.misplaced.name, result.misplaced.bench) == ("square" if hole else "lake", 0)


def test_head_speed_scales_times_and_nothing_else() -> None:
    slow, fast = (venue_clearance(Dance(DRAGON, LAP, v), VENUE, margin=0.5) for v in (1.0, 2.5))
    for a, b in zip(slow.areas, fast.areas, strict=True):
        assert (a.outcome, a.bench) == (b.outcome, b.bench)
        assert a.nearest.distance == pytest.approx(b.nearest.distance, abs=SAME_DISTANCE)
        assert a.nearest.time == pytest.approx(2.5 * b.nearest.time, abs=1e-6)  # flat where they are nearest


def test_a_coil_with_its_centre_elsewhere_meets_a_post_at_its_centre() -> None:
    route = Route([Coil(1.7, 8, 1.2, centre=(3, -2))])
    post = Venue(boxed("square", -30, -30, 30, 30), (boxed("post", 2.9, -2.1, 3.1, -1.9),))
    nearest = venue_clearance(Dance(DRAGON, route), post).areas[1].nearest
    known = shapely_distances(DRAGON, route, post.obstacles[0], np.linspace(0.0, route.end, 2_000)).min()
    assert nearest.distance == pytest.approx(known, abs=1e-4)
    assert nearest.time == pytest.approx(route.end, abs=1.0)
