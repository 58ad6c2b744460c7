"""Cues of several dragons: every meeting and no other, against small steps and shapely; the rest as for one dance."""

from dataclasses import replace
from functools import cache
from itertools import pairwise

import numpy as np
import pytest
from shapely import LineString, Polygon

from core import (
    Dance,
    Dragon,
    OutsideRun,
    Part,
    Passage,
    Performance,
    Spiral,
    bench_cues,
    bench_outlines,
    trajectory,
)
from core.people.meetings import EVEN
from core.quantities import Quantity
from tests.core.people.test_meetings import DANCES
from tests.support.near import assert_near
from tests.support.refused import refused
from tests.support.shared_dances import lane

# Time between two looks of the slow search [s].
STEP = 0.01
PERFORMANCE = Performance(
    [
        Part(Dance(Dragon(4), lane((0.0, 0.0), (30.0, 0.0))), name="east"),
        Part(Dance(Dragon(3), lane((30.0, 2.0), (0.0, 2.0)), 1.3, [Passage(0.0, until_time=9.0)]), 4.0),
        Part(Dance(Dragon(3, 3.0), lane((12.0, -12.0), (12.0, 20.0))), 16.0),
    ]
)


@cache
def rows_of(performance):
    """Times, and the corners of each bench of each dragon at them."""
    times = np.arange(*performance.span(), STEP)
    pairs = zip(performance.parts, trajectory(performance, times), strict=True)
    corners = [bench_outlines(part.dance.dragon, motion.position) for part, motion in pairs]
    return times, {(j, b): some[:, b] for j, some in enumerate(corners) for b in range(some.shape[1])}


def slow_meetings(times, rows, bench, reach):
    """Changes of sign of the way ahead of every other bench, in small steps, unless a third bench hides it."""
    met = []
    here = rows[bench]
    along = here[:, 0] - here[:, 3]
    left = here[:, 0] - here[:, 1]
    for other, there in rows.items():
        if other[0] == bench[0] and abs(other[1] - bench[1]) <= 1:
            continue
        away = (there - here).mean(axis=1)
        ahead = (away * along).sum(axis=1) / np.linalg.norm(along, axis=1)
        for before, after in pairwise(np.flatnonzero(np.abs(ahead) > EVEN).tolist()):
            if ahead[before] * ahead[after] > 0.0:
                continue
            k = before + int(np.abs(ahead[before : after + 1]).argmin())
            third = {name: Polygon(corners[k]) for name, corners in rows.items()}
            pair = third.pop(bench), third.pop(other)
            sight = LineString([shape.centroid for shape in pair])
            gap = pair[0].distance(pair[1])
            if gap <= reach and not any(shape.intersects(sight) for shape in third.values()):
                met.append((times[k], *other, bool(left[k] @ away[k] > 0.0), gap))
    return sorted(met)


ALONE = [Performance([Part(DANCES[name][0])]) for name in ("unequal benches", "three rows")]


@pytest.mark.parametrize("performance, dragon", [*((PERFORMANCE, k) for k in range(3)), *((one, 0) for one in ALONE)])
def test_meetings_are_those_of_a_slow_search_in_small_steps(performance, dragon):
    count = 0
    for one in bench_cues(performance, dragon=dragon, reach=4.0):
        slow = slow_meetings(*rows_of(performance), (dragon, one.bench), 4.0)
        abreast = [m for m in one.meetings if not m.ahead]
        met = sorted((m.time, m.dragon or 0, m.bench, m.side.value == "left", max(m.gap, 0.0)) for m in abreast)
        assert [m[1:4] for m in met] == [m[1:4] for m in slow]
        assert_near([m[0] for m in met], [m[0] for m in slow], 2 * STEP)
        assert_near([m[4] for m in met], [m[4] for m in slow], 0.05)
        count += len(met)
    assert count > 1


def test_a_dragon_that_meets_no_other_has_the_cues_of_its_dance_on_the_clock_of_the_performance():
    coil = Dance(Dragon(20), Spiral(0.7, 4.0), 0.9, [Passage(0.5, until_time=10.0), Passage(0.0, until_time=14.0)])
    far = Part(Dance(Dragon(3), lane((200.0, 0.0), (300.0, 0.0))))
    performance = Performance([far, Part(coil, 7.0)])
    alone = bench_cues(coil, [0, 5, 19], start=0.0, stop=38.0)
    several = bench_cues(performance, [0, 5, 19], dragon=1, start=performance.begin, stop=45.0)
    for cues, other in zip(alone, several, strict=True):
        assert other.start == replace(cues.start, time=performance.begin)
        assert other.turns[0].begin == cues.turns[0].begin + 7.0
        assert other.fastest == replace(cues.fastest, time=cues.fastest.time + 7.0)
        assert [other.begin.time, other.done.time] == [cues.begin.time + 7.0, cues.done.time + 7.0]
        assert [pause.end - 7.0 for pause in other.pauses] == [pause.end for pause in cues.pauses]


@pytest.mark.parametrize(
    "dragon, start, stop, still",
    [(1, None, 12.0, 7.81), (0, 31.0, 40.0, 31.0)],
    ids=["pause", "after"],
)
def test_a_dragon_that_never_walks_is_named(dragon, start, stop, still):
    with refused("stop", dragon=dragon) as refusal:
        bench_cues(PERFORMANCE, dragon=dragon, start=start, stop=stop)
    assert str(refusal.value.values["begin"]) == str(Quantity(still, "s"))


def test_a_stop_before_the_fold_is_needed():
    folding = Performance([Part(Dance(Dragon(20), Spiral(0.7, 4.0))), PERFORMANCE.parts[0]])
    for stop in (None, folding.end.time):
        with refused("stop"):
            bench_cues(folding, dragon=1, stop=stop)
    with refused("stop", OutsideRun):
        bench_cues(PERFORMANCE, stop=900.0)
