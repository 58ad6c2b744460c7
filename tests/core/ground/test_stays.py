"""Stays in an area against poses in small steps, looked at by shapely."""

import numpy as np
import pytest
import shapely

from core import (
    Area,
    Dance,
    Dragon,
    Line,
    Part,
    Performance,
    Route,
    Spiral,
    Turn,
    bench_outlines,
    stays,
    trajectory,
)  # fmt: skip
from tests.core.ground.test_envelope import WOUND
from tests.support.near import assert_near
from tests.support.random_squares import box, polygon
from tests.support.refused import refused
from tests.support.shared_dances import STREET

STEP = 0.005  # [s]


HOLED = Area("yard", (*box("yard", -9, -9, 18, 18).rings, *box("hole", -8, -8, 16, 16).rings))
CASES = {
    "a lane across a street": (STREET, box("lane", 30, -9, 3.5, 18), 0.0),
    "a lane with a margin": (STREET, box("lane", 30, 0.4, 3.5, 8.6), 0.5),
    "many sizes": (WOUND, box("lane", 20, 6, 20, 2), 0.1),
    "the contest's turn": (Dance(Dragon(20), Turn(1.7)), box("lane", -1, -1, 31, 2.5), 0.0),
    "a thin wall": (Dance(Dragon(4), Spiral(1.7)), box("wall", 10, -40, 0.01, 80), 0.0),
    "a yard with a hole": (Dance(Dragon(20), Turn(1.7)), HOLED, 0.0),
    "one that nobody comes to": (STREET, box("lane", 30, 1, 3.5, 8), 0.0),
}


@pytest.mark.parametrize("name", CASES)
def test_benches_are_in_an_area_at_no_other_time_and_at_nearly_all_of_these(name):
    dance, area, margin = CASES[name]
    stop = None if isinstance(dance.path, Route) and not isinstance(dance.path, Turn) else dance.begin + 90.0
    result = stays(dance, area, margin=margin, stop=stop)
    times = np.arange(result.start, result.stop, STEP)
    corners = bench_outlines(dance.dragon, trajectory(dance, times).position)
    benches = shapely.polygons(corners.reshape(-1, 4, 2)).reshape(corners.shape[:2])
    inside = (shapely.distance(polygon(area), benches) <= margin).any(axis=1)
    said = np.zeros(len(times), dtype=bool)
    for one in result.stays:
        said |= (one.begin <= times) & (times <= one.end)
        for time, bench in ((one.begin, one.first), (one.end, one.last)):
            outline = shapely.Polygon(bench_outlines(dance.dragon, trajectory(dance, [time]).position)[0, bench])
            assert shapely.distance(polygon(area), outline) <= margin + 2e-3
    assert not (inside & ~said).any()
    assert (said & ~inside).sum() * STEP <= 0.02 * max(1, len(result.stays))
    assert_near(result.total, inside.sum() * STEP, 0.03 * max(1, len(result.stays)))
    if name == "one that nobody comes to":
        assert result.stays == ()


def test_each_of_several_dragons_is_in_an_area_also_while_it_stands_there():
    area = box("lane", 37, -9, 3, 18)
    ways = (((0, 0), (60, 0)), ((38, -30), (38, 2)), ((80, 5), (39, 5)))
    three = Performance([Part(Dance(Dragon(5), Route([Line(*way)])), 4.0 * k) for k, way in enumerate(ways)])
    results = stays(three, area)
    times = np.arange(*three.span(), STEP)
    motions = trajectory(three, times)
    for part, motion, result in zip(three.parts, motions, results, strict=True):
        corners = bench_outlines(part.dance.dragon, motion.position)
        benches = shapely.polygons(corners.reshape(-1, 4, 2)).reshape(corners.shape[:2])
        inside = (shapely.distance(polygon(area), benches) <= 0.0).any(axis=1)
        said = np.any([(one.begin <= times) & (times <= one.end) for one in result.stays], axis=0)
        assert (inside & ~said).any() == np.False_
        assert (said & ~inside).sum() * STEP <= 0.02
    assert [one.stays[-1].end == three.end.time for one in results] == [False, True, True]


def test_stays_end_where_the_dance_does_and_a_fold_needs_an_end():
    result = stays(STREET, box("lane", 50, -2, 20, 4), start=20.0)
    assert result.stays[-1].end == result.stop
    assert result.stays[-1].last == 0
    with refused("stop"):
        stays(Dance(Dragon(5), Spiral()), box("lane", -2, -2, 4, 4))
