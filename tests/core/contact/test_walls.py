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
    InvalidValue,
    Line,
    Outcome,
    Quantity,
    Route,
    Spiral,
    Venue,
    bench_poses,
    trajectory,
    venue_clearance,
)
from core.contact.search import Search
from core.shapes.rectangles import corners
from tests.core.test_venue import SQUARE, STAGE, WELL, box, boxed
from tests.depth import examples

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
    search = Search(DRAGON, LAP, 0.0, area.edges)
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
    found = venue_clearance(Dance(DRAGON, LAP), venue, margin=margin).areas[1]
    times = np.linspace(0.0, LAP.end, 1_500)
    slow = shapely_distances(DRAGON, LAP, post, times).min(axis=1)
    assert found.nearest.at_least is not None
    assert found.nearest.at_least <= slow.min() + SAME_DISTANCE
    assert found.nearest.distance <= slow.min() + PROVEN
    if found.outcome is Outcome.CLEAR:
        assert slow.min() > margin
        assert found.nearest.distance > margin
    elif found.outcome is Outcome.CONTACT_AT_START:
        assert slow[0] <= margin + SAME_DISTANCE
    else:
        assert found.outcome is Outcome.CONTACT
        assert found.time_bracket is not None
        clear, touching = found.time_bracket
        assert slow[times < clear].min() > margin
        assert shapely_distances(DRAGON, LAP, post, np.array([touching])).min() < margin + AT_MARGIN


def test_a_wall_across_the_way_is_met_where_the_head_reaches_it() -> None:
    route = Route([Line((-60, 0), (60, 0))], start=60.0)
    wall = Venue(boxed("square", -70, -9, 70, 9), (boxed("wall", 20, -1, 21, 1),))
    found = venue_clearance(Dance(DRAGON, route), wall, margin=0.25).areas[1]
    assert found.outcome is Outcome.CONTACT
    assert found.time == pytest.approx(20.0 - 0.275 - 0.25, abs=TIME_ERROR)
    assert found.bench == 0
    assert found.point is not None
    assert found.point[0] == pytest.approx(19.75, abs=AT_MARGIN)
    assert found.nearest.distance == 0.0
    assert found.nearest.time == pytest.approx(20.0 - 0.275, abs=TIME_ERROR)


def test_a_bench_that_is_not_the_head_may_be_the_first_to_touch() -> None:
    dragon = Dragon.of([2.2] * 6, [0.3, 0.3, 0.3, 0.9, 0.3, 0.3], [0.275] * 6)
    route = Route([Line((-60, 0), (60, 0))], start=60.0)
    square = Venue(boxed("square", -70, -9, 70, 9), (boxed("post", 20, 0.3, 20.5, 1),))
    found = venue_clearance(Dance(dragon, route), square).areas[1]
    assert found.bench == 3
    assert found.time == pytest.approx(20.0 + 3 * 1.65 - 0.275, abs=TIME_ERROR)
    assert found.nearest.distance == 0.0
    clear = venue_clearance(Dance(dragon, route), square, stop=20.0).areas[1]
    assert clear.outcome is Outcome.CLEAR
    assert clear.nearest.distance == pytest.approx(0.15, abs=SAME_DISTANCE)


def test_a_spiral_keeps_its_place_in_the_world() -> None:
    dragon = Dragon(40)
    known = shapely_distances(dragon, Spiral(), VENUE_ROUND.square, np.linspace(0.0, 400.0, 1_500))
    found = venue_clearance(Dance(dragon, Spiral()), VENUE_ROUND, stop=400.0)
    nearest = found.areas[0].nearest
    assert found.misplaced is None
    assert nearest.distance <= known.min() + SAME_DISTANCE
    assert nearest.distance == pytest.approx(known.min(), abs=1e-3)  # the samples are 0.27 s apart


@pytest.mark.parametrize(("start", "stop"), [(-60.0, -20.0), (-5.0, 0.0), (0.0, 1e-3)])
def test_a_spiral_has_its_place_also_before_its_start(start: float, stop: float) -> None:
    found = venue_clearance(Dance(Dragon(benches=9), Spiral()), VENUE_ROUND, start=start, stop=stop).areas[0].nearest
    known = shapely_distances(Dragon(benches=9), Spiral(), VENUE_ROUND.square, np.linspace(start, stop, 400))
    assert found.distance <= known.min() + PROVEN
    assert found.distance == pytest.approx(known.min(), abs=1e-3)


def test_a_spiral_too_tight_for_the_head_by_the_stop_is_refused() -> None:
    dance = Dance(Dragon(benches=3), Spiral())
    for stop, got in ((432.0, "432 s"), (None, "432.917")):
        with pytest.raises(InvalidValue, match=f"bench 0, got {got}") as refused:
            venue_clearance(dance, VENUE_ROUND, stop=stop)
        assert refused.value.field == "stop"
    last = refused.value.values["last"]
    assert isinstance(last, Quantity)
    assert venue_clearance(dance, VENUE_ROUND, stop=last.value).areas[0].outcome is Outcome.CLEAR


def test_a_dragon_inside_the_square_is_not_misplaced() -> None:
    assert venue_clearance(Dance(DRAGON, LAP), VENUE).misplaced is None


def test_a_dragon_wholly_outside_is_told_though_it_touches_nothing() -> None:
    far = Venue(boxed("square", 100, 100, 120, 120))
    found = venue_clearance(Dance(DRAGON, LAP), far)
    assert found.misplaced is not None
    assert (found.misplaced.name, found.misplaced.bench) == ("square", 0)
    assert found.areas[0].outcome is Outcome.CLEAR


def test_the_first_bench_outside_is_named_with_its_place() -> None:
    small = Venue(boxed("square", -8, -5, 20, 20))
    found = venue_clearance(Dance(DRAGON, LAP), small)
    centres = bench_poses(trajectory(Dance(DRAGON, LAP), [0.0]).position[0])[:, 0]
    assert found.misplaced is not None
    assert found.misplaced.bench == int(np.argmax(centres < -8.0))
    assert found.misplaced.point == pytest.approx((centres[found.misplaced.bench], 0.0), abs=SAME_DISTANCE)


@pytest.mark.parametrize("hole", [True, False], ids=["hole", "obstacle"])
def test_a_bench_inside_a_hole_or_an_obstacle_is_told(hole: bool) -> None:
    lake = box(-32, -1, 3, 1)
    square = Area("square", (SQUARE, lake) if hole else (SQUARE,))
    found = venue_clearance(Dance(DRAGON, LAP), Venue(square, () if hole else (Area("lake", (lake,)),)))
    assert found.misplaced is not None
    assert (found.misplaced.name, found.misplaced.bench) == ("square" if hole else "lake", 0)


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
