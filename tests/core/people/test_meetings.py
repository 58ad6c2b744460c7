"""Meetings, held against the trajectory with shapely; that none is missing: performance/test_cues.py."""

import math

import numpy as np
import pytest
from scipy.optimize import brentq
from shapely import Polygon

from core import Arc, Budget, Dance, Dragon, Line, Passage, Route, Spiral, bench_outlines, trajectory
from core.people.meetings import ABREAST, EVEN, meetings_between, steady_dance, travels_between
from tests.support.depth import further
from tests.support.near import assert_near
from tests.support.shared_dances import there_and_back

pytestmark = pytest.mark.uncompiled

# Difference of shapely's distance from ours [m], and of a travel at which |a| is at most ABREAST [m of a].
ROUNDING = 1e-11
UNEQUAL = Dragon.of([3.4, 2.2, 1.5, 2.6, 1.9, 2.2] * 2, [0.3] * 12, [0.2] * 12)
# There and back three times: the third row is hidden from the first one by the second.
THREE_ROWS = Route(
    [Line((0, 0), (20, 0)), Arc((20, 1.7), 1.7, -math.pi / 2, math.pi), Line((20, 3.4), (0, 3.4)),
     Arc((0, 5.1), 1.7, -math.pi / 2, -math.pi), Line((0, 6.8), (20, 6.8))], 14.0
)  # fmt: skip
# Dances, with the first and the last travel of the head [m].
DANCES = {
    "there and back": (Dance(Dragon(13), there_and_back(30)), 0.0, 36.0),
    "unequal benches": (Dance(UNEQUAL, there_and_back(30)), 0.0, 37.0),
    "three rows": (Dance(Dragon(20, 1.7, 1.7), THREE_ROWS), 10.0, 40.0),
    "spiral": (Dance(Dragon(30), Spiral(0.7, 4.0)), -6.0, 26.0),
}


def ahead(dance, bench, other, travel):
    """How far the middle of the other bench is before that of this one, along this one [m]."""
    handles = trajectory(steady_dance(dance), travel).position @ np.array([1.0, 1.0j])
    middles = 0.5 * (handles[1:] + handles[:-1])
    along = handles[bench] - handles[bench + 1]
    return float(((middles[other] - middles[bench]) / along).real * abs(along))


def meetings(dance, benches, first, last):
    return meetings_between(steady_dance(dance), benches, travels_between(first, last), 4.0, Budget())


@pytest.mark.parametrize("name", further(DANCES, 2))
def test_whom_a_bench_meets_is_abreast_of_it_at_the_gap(name):
    dance, *ends = DANCES[name]
    met = meetings(dance, range(dance.dragon.benches), *ends)
    assert met.gap.size > 20
    for bench, other, travel, gap in zip(*met[:3], met.gap, strict=True):
        assert abs(ahead(dance, bench, other, travel)) <= ABREAST + ROUNDING
        outlines = bench_outlines(dance.dragon, trajectory(steady_dance(dance), travel).position)
        assert_near(gap, Polygon(outlines[bench]).distance(Polygon(outlines[other])), ROUNDING)


def lap(length):
    """Once around a track with straights of that length, and then beside the first one, the same way."""
    turns = Arc((length, 3), 3, -math.pi / 2, math.pi), Arc((0, 3.8), 2.2, math.pi / 2, math.pi)
    straights = Line((-60, 0), (length, 0)), Line((length, 6), (0, 6)), Line((0, 1.6), (length, 1.6))
    return Dance(Dragon(60, 1.7, 1.7), Route([straights[0], turns[0], straights[1], turns[1], straights[2]], 66.0))


def test_benches_that_walk_side_by_side_do_not_meet_again_and_again():
    travel = 66.0
    other = min(range(40, 60), key=lambda one: abs(ahead(lap(20.0), 2, one, travel)))
    dance = lap(brentq(lambda length: ahead(lap(length), 2, other, travel), 19.0, 21.0, xtol=1e-14))
    side_by_side = [ahead(dance, 2, other, one) for one in np.linspace(travel - 1.0, travel + 4.0, 200)]
    assert max(map(abs, side_by_side)) < EVEN
    assert len(set(np.sign(side_by_side))) > 1
    assert meetings(dance, [2], travel - 1.0, travel + 4.0).other.size == 0


def test_meetings_are_the_same_for_few_benches_and_for_all_and_with_passages():
    dance, *ends = DANCES["spiral"]
    whole = meetings(dance, range(30), *ends)
    few = meetings(dance, [7, 3], *ends)
    assert_near(few.travel, whole.travel[np.isin(whole.own, [3, 7])], 1e-8)
    slow = Dance(dance.dragon, dance.path, 0.5, [Passage(0.25, until_s=9.0)])
    assert meetings(slow, [7, 3], *ends).travel.tolist() == few.travel.tolist()
