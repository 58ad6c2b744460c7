"""Stays in an area against poses in small steps, looked at by shapely."""

import numpy as np
import pytest
import shapely

from core import (
    Area,
    Dance,
    Dragon,
    Part,
    Performance,
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
from tests.support.shared_dances import STREET, lane

STEP = 0.005  # [s]


HOLED = Area("yard", (*box("yard", -9, -9, 18, 18).rings, *box("hole", -8, -8, 16, 16).rings))
AROUND = Dance(Dragon(20), Turn(1.7))
THREE = [Dance(Dragon(5), lane(*way)) for way in (((0, 0), (60, 0)), ((38, -30), (38, 2)), ((80, 5), (39, 5)))]
# Dances, each 4 s after the one before.
CASES = {
    "a lane across a street": ([STREET], box("lane", 30, -9, 3.5, 18), 0.0),
    "a lane with a margin": ([STREET], box("lane", 30, 0.4, 3.5, 8.6), 0.5),
    "many sizes": ([WOUND], box("lane", 20, 6, 20, 2), 0.1),
    "the contest's turn": ([AROUND], box("lane", -1, -1, 31, 2.5), 0.0),
    "a thin wall": ([Dance(Dragon(4), Spiral(1.7))], box("wall", 10, -40, 0.01, 80), 0.0),
    "a hole that nobody leaves": ([AROUND], HOLED, 0.0),
    "one that nobody comes to": ([STREET], box("lane", 30, 1, 3.5, 8), 0.0),
    "one in which two of three stand at last": (THREE, box("lane", 37, -9, 3, 18), 0.0),
}


@pytest.mark.parametrize("name", CASES)
def test_benches_are_in_an_area_at_no_other_time_and_at_nearly_all_of_these(name):
    dances, area, margin = CASES[name]
    everyone = Performance([Part(dance, 4.0 * k) for k, dance in enumerate(dances)])
    results = stays(everyone, area, margin=margin, stop=min(everyone.begin + 90.0, everyone.end.time))
    times = np.arange(results[0].start, results[0].stop, STEP)
    for k, (motion, result) in enumerate(zip(trajectory(everyone, times), results, strict=True)):
        dragon = dances[k].dragon
        outlines = shapely.polygons(bench_outlines(dragon, motion.position))
        inside = (shapely.distance(polygon(area), outlines) <= margin).any(axis=1)
        said = np.zeros(len(times), dtype=bool)
        for one in result.stays:
            said |= (one.begin <= times) & (times <= one.end)
            for time, bench in ((one.begin, one.first), (one.end, one.last)):
                outline = bench_outlines(dragon, trajectory(everyone, time)[k].position)[bench]
                assert shapely.distance(polygon(area), shapely.Polygon(outline)) <= margin + 2e-3
        assert not (inside & ~said).any()
        assert (said & ~inside).sum() * STEP <= 0.02 * max(1, len(result.stays))
        assert_near(result.total, inside.sum() * STEP, 0.03 * max(1, len(result.stays)))
        assert [one.end for one in result.stays[-1:] if k] == [everyone.end.time] * min(k, 1)
    assert bool(results[0].stays) is ("that nobody" not in name)


def test_stays_end_where_the_dance_does_and_a_fold_needs_an_end():
    result = stays(STREET, box("lane", 50, -2, 20, 4), start=20.0)
    assert result.stays[-1].end == result.stop
    assert result.stays[-1].last == 0
    assert stays(Performance([Part(STREET)]), box("lane", 50, -2, 20, 4), start=20.0) == (result,)
    with refused("stop"):
        stays(Dance(Dragon(5), Spiral()), box("lane", -2, -2, 4, 4))
