"""The ground of a loose tail against chains that are bent at random, and against a lane whose ground is known."""

import math

import numpy as np
import pytest
import shapely

from core import Dance, Dragon, Route, Spiral, Turn, bench_outlines, tail_reach, trajectory
from tests.core.ground.test_envelope import MIXED, WINDING, WOUND, ground
from tests.support.refused import refused
from tests.support.shared_dances import lane
from tests.support.slow_search import in_plane

DANCES = {
    "a spiral": (Dance(Dragon(60), Spiral(1.7)), 3, 0.0, 100.0),
    "the contest's turn": (Dance(Dragon(20), Turn(1.7)), 1, -10.0, 40.0),
    "waypoints, benches of many sizes": (WOUND, 4, None, None),
    "the whole dragon": (Dance(MIXED, Route([WINDING], start=15.0)), 5, None, None),
}


def thrown(dance, benches, times, random):
    """Rear corners of loose benches behind a handle on the path, each turned at random, half of them nearly alike."""
    dragon = dance.dragon
    first = dance.dragon.benches - benches
    joint = trajectory(dance, times).position[:, first]
    spread = np.where(random.random(len(times)) < 0.5, 0.05, math.pi)[:, None]
    angles = random.uniform(-math.pi, math.pi, (len(times), 1)) + spread * random.uniform(
        -1.0, 1.0, (len(times), benches)
    )
    ways = in_plane(np.exp(1j * angles)) * dragon.chords[first:, None]
    handles = np.cumsum(np.concatenate([joint[:, None], ways], axis=1), axis=1)
    loose = Dragon.of(dragon.lengths[first:], dragon.widths[first:], dragon.overhangs[first:])
    return bench_outlines(loose, handles)[:, :, 2:].reshape(-1, 2)


@pytest.mark.parametrize("name", DANCES)
def test_a_tail_let_go_at_any_time_stays_in_its_ground_and_nearly_fills_it(name):
    dance, benches, start, stop = DANCES[name]
    result = tail_reach(dance, benches, start=start, stop=stop)
    polygons = ground(result)
    assert polygons.is_valid
    assert polygons.area == pytest.approx(result.area)
    assert result.excess < 0.03 * result.reach + 0.02
    random = np.random.default_rng(71)
    points = thrown(dance, benches, random.uniform(result.start, result.stop, 4_000), random)
    shapely.prepare(polygons)
    assert shapely.contains_xy(polygons, points).all()
    joint = trajectory(dance, np.linspace(result.start, result.stop, 3_000)).position[:, -1 - benches]
    way = shapely.LineString(joint)
    assert way.buffer(result.reach + result.excess, quad_segs=256).contains(polygons)
    assert shapely.distance(shapely.points(points), way).max() > 0.97 * result.reach


STRAIGHT = Dance(Dragon(3), lane((0.0, 0.0), (30.0, 0.0), start=9.0))


def test_the_last_bench_reaches_its_chord_and_overhang_and_a_stray_goes_further():
    result = tail_reach(STRAIGHT, 1)
    strayed = tail_reach(STRAIGHT, 1, stray=0.2)
    assert result.reach == pytest.approx(math.hypot(1.65 + 0.275, 0.15))
    way = result.stop - result.start
    exact = 2.0 * result.reach * way + math.pi * result.reach**2
    assert exact < result.area < exact * 1.03
    assert strayed.area > result.area + 2.0 * 0.2 * way
    assert "let go" in result.certificate.method


@pytest.mark.parametrize("benches", [0, 4, 1.5, True])
def test_only_benches_of_the_dragon_can_be_loose(benches):
    with refused("benches"):
        tail_reach(STRAIGHT, benches)
