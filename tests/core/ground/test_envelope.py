"""The envelope against sampled poses, against dense sampling, and against grounds known from formulas."""

import math

import numpy as np
import pytest
import shapely

from core import (
    Arc,
    Dance,
    Dragon,
    Legs,
    Route,
    Spiral,
    Turn,
    Waypoints,
    bench_outlines,
    envelope,
    trajectory,
)
from tests.support.depth import examples
from tests.support.refused import refused
from tests.support.shared_dances import lane

POSES = 10_000
RING = 5.0  # radius of a round dance [m]
WINDING = Waypoints(((0.0, 0.0), (25.0, 0.0), (35.0, 8.0), (28.0, 16.0), (10.0, 12.0)))
MIXED = Dragon.of([3.4, 1.5, 2.2, 4.0, 2.2], [0.3, 0.5, 0.3, 0.2, 0.3], [0.2, 0.1, 0.275, 0.5, 0.275])
ZIGZAG = Legs([(0.0, 0.0), (12.0, 0.0), (15.0, 4.0), (16.0, 4.0), (16.5, 7.0), (30.0, 7.0)], range(5), radius=0.0)
ROUNDS = Dance(Dragon(6), Route([Arc((0.0, 0.0), RING, 0.0, 15.0)], start=40.0))
WOUND = Dance(MIXED, Route([WINDING], start=15.0), 0.7)
# Dances, each with start and stop [s].
DANCES = {
    "the default up to its contact": (Dance(Dragon(examples(40, 223)), Spiral()), 350.0, 412.4738),
    "to the fold": (Dance(Dragon(20), Spiral()), 415.0, None),
    "the contest's turn": (Dance(Dragon(20), Turn(1.7)), -10.0, 50.0),
    "waypoints, benches of many sizes": (WOUND, None, None),
    "corners": (Dance(Dragon(3), ZIGZAG), None, None),
    "rounds": (ROUNDS, None, None),
    "straight on": (Dance(Dragon(3), lane((0.0, 0.0), (20.0, 5.0), start=9.0)), None, None),
}


def ground(result):
    return shapely.MultiPolygon([(rings[0], rings[1:]) for rings in result.polygons])


def outlines(dance, times):
    """Corners (T n, 4, 2) of all benches."""
    return bench_outlines(dance.dragon, trajectory(dance, times).position).reshape(-1, 4, 2)


@pytest.mark.parametrize("name", DANCES)
def test_ten_thousand_poses_are_inside_of_valid_polygons(name):
    dance, start, stop = DANCES[name]
    result = envelope(dance, start=start, stop=stop)
    polygons = ground(result)
    assert polygons.is_valid
    assert polygons.area == pytest.approx(result.area)
    assert result.excess <= 1e-3
    random = np.random.default_rng(15)
    times = random.uniform(result.start, result.stop, math.ceil(POSES / dance.dragon.benches))
    corners = outlines(dance, [result.start, result.stop, *times])
    edges = np.roll(corners, -1, axis=1) - corners
    points = np.concatenate([corners, corners + edges * random.uniform(size=(len(corners), 4, 1))])
    shapely.prepare(polygons)
    assert shapely.contains_xy(polygons, points.reshape(-1, 2)).all()


@pytest.mark.parametrize(
    "dance, start, stop",
    [
        (Dance(Dragon(3), Spiral()), 432.4, None),
        (Dance(Dragon(4), Turn(1.7)), 3.0, 3.6),
        (Dance(MIXED, Route([WINDING], start=15.0)), 20.0, 20.6),
        (Dance(Dragon.of([2.2, 3.0] * 3, [0.3] * 6, [0.275] * 6), lane((0.0, 0.0), (90.0, 0.0), start=40.0)), 0.0, 2.0),
    ],
    ids=["to the fold", "turn", "waypoints", "two sizes"],
)
def test_no_point_is_further_from_a_bench_than_the_excess(dance, start, stop):
    result = envelope(dance, start=start, stop=stop)
    times = result.stop - (result.stop - result.start) * np.linspace(1.0, 0.0, 1_501) ** (1.0 if stop else 3.0)
    benches = shapely.polygons(outlines(dance, times))
    border = shapely.points(shapely.get_coordinates(shapely.segmentize(ground(result).boundary, 0.1)))
    _, furthest = shapely.STRtree(benches).query_nearest(border, return_distance=True, all_matches=False)
    assert len(furthest) == len(border)
    assert 1e-4 < furthest.max() <= result.excess <= 1e-3
    sampled = shapely.union_all(benches[::20])
    assert sampled.area < result.area
    assert ground(result).covers(sampled)


def test_the_distance_of_spectators_from_a_straight_dance():
    result = envelope(Dance(Dragon(3), lane((0.0, 0.0), (50.0, 0.0), start=9.0)))
    for line in ([(0.0, 2.0), (30.0, 2.0)], [(20.0, 2.0)], [(-9.0, 5.0), (25.0, 2.0), (60.0, 7.0)]):
        assert 2.0 - 0.15 - result.excess < result.distance(line) < 2.0 - 0.15
    for line in ([(10.0, -3.0), (11.0, 3.0)], [(10.0, 0.1)]):
        assert result.distance(line) == 0.0
    for line, field in (([], "line"), ([(1.0,)], "line.0"), ([(1.0, math.nan)], "line.0.1")):
        with refused(field):
            result.distance(line)
