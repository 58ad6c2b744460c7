"""Meetings: every one and no other, held against the trajectory with shapely and small steps."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.optimize import brentq
from shapely import Polygon

from core import Arc, Budget, Dance, Dragon, Line, Passage, Route, Spiral, TooMuchWork, bench_outlines, trajectory
from core.people.meetings import ABREAST, EVEN, meetings_between, steady_dance, travels_between
from tests.support.slow_meetings import ahead, same_meetings

pytestmark = pytest.mark.uncompiled

# Difference of shapely's distance from ours [m], and of a travel at which |a| is at most ABREAST [m of a].
ROUNDING = 1e-11
U_TURN = Route([Line((0, 0), (30, 0)), Arc((30, 1.6), 1.6, -math.pi / 2, math.pi), Line((30, 3.2), (0, 3.2))], 24.0)
# There and back three times: the third row is hidden from the first one by the second.
THREE_ROWS = Route(
    [Line((0, 0), (20, 0)), Arc((20, 1.7), 1.7, -math.pi / 2, math.pi), Line((20, 3.4), (0, 3.4)),
     Arc((0, 5.1), 1.7, -math.pi / 2, -math.pi), Line((0, 6.8), (20, 6.8))], 14.0
)  # fmt: skip
DANCES = {
    "spiral": (Dance(Dragon(30), Spiral(0.7, 4.0)), -6.0, 26.0),
    "there and back": (Dance(Dragon(13), U_TURN), 0.0, 36.0),
    "three rows": (Dance(Dragon(20, 1.7, 1.7), THREE_ROWS), 10.0, 40.0),
    "unequal benches": (
        Dance(Dragon.of([3.4, 2.2, 1.5, 2.6, 1.9, 2.2] * 2, [0.3] * 12, [0.2] * 12), U_TURN),
        0.0,
        37.0,
    ),
}


@pytest.mark.parametrize(("dance", "first", "last"), DANCES.values(), ids=DANCES)
def test_meetings_are_those_of_a_slow_search_in_small_steps(dance: Dance, first: float, last: float) -> None:
    benches = range(dance.dragon.benches)
    met = meetings_between(steady_dance(dance), benches, travels_between(first, last), 4.0, Budget())
    slow = same_meetings(met, dance, (first, last), 4.0, 0.02)
    assert len(slow) > 20
    assert (met.left > 0.0).tolist() == [one[4] for one in slow]
    assert met.gap == pytest.approx([one[3] for one in slow], abs=1e-7)
    for own, other, travel, gap in zip(*met[:3], met.gap, strict=True):
        assert abs(ahead(dance, own, other, travel)) <= ABREAST + ROUNDING
        outlines = bench_outlines(dance.dragon, trajectory(steady_dance(dance), travel).position)
        assert gap == pytest.approx(Polygon(outlines[own]).distance(Polygon(outlines[other])), abs=ROUNDING)


def lap(length: float) -> Dance:
    """Once around a track with straights of that length, and then beside the first one, the same way."""
    turns = Arc((length, 3), 3, -math.pi / 2, math.pi), Arc((0, 3.8), 2.2, math.pi / 2, math.pi)
    straights = Line((-60, 0), (length, 0)), Line((length, 6), (0, 6)), Line((0, 1.6), (length, 1.6))
    return Dance(Dragon(60, 1.7, 1.7), Route([straights[0], turns[0], straights[1], turns[1], straights[2]], 66.0))


def test_benches_that_walk_side_by_side_do_not_meet_again_and_again() -> None:
    travel = 66.0
    other = min(range(40, 60), key=lambda one: abs(ahead(lap(20.0), 2, one, travel)))
    dance = lap(brentq(lambda length: ahead(lap(length), 2, other, travel), 19.0, 21.0, xtol=1e-14))
    side_by_side = [ahead(dance, 2, other, one) for one in np.linspace(travel - 1.0, travel + 4.0, 200)]
    assert max(map(abs, side_by_side)) < EVEN
    assert len(set(np.sign(side_by_side))) > 1
    met = meetings_between(steady_dance(dance), [2], travels_between(travel - 1.0, travel + 4.0), 4.0, Budget())
    assert met.other.size == 0


def test_meetings_are_the_same_for_few_benches_and_for_all() -> None:
    dance, first, last = DANCES["spiral"]
    whole = meetings_between(steady_dance(dance), range(30), travels_between(first, last), 4.0, Budget())
    few = meetings_between(steady_dance(dance), [7, 3], travels_between(first, last), 4.0, Budget())
    kept = np.isin(whole.own, [3, 7])
    assert few.travel.tolist() == pytest.approx(whole.travel[kept].tolist(), abs=1e-8)
    assert few.other.tolist() == whole.other[kept].tolist()


def test_a_spent_budget_ends_the_search() -> None:
    dance, first, last = DANCES["spiral"]
    with pytest.raises(TooMuchWork, match="meetings were not found"):
        meetings_between(steady_dance(dance), range(30), travels_between(first, last), 4.0, Budget(work=100.0))


def test_passages_do_not_move_meetings() -> None:
    dance, first, last = DANCES["there and back"]
    slow = Dance(dance.dragon, dance.path, 0.5, [Passage(0.25, until_s=9.0)])
    both = [
        meetings_between(steady_dance(one), [4], travels_between(first, last), 4.0, Budget()) for one in (dance, slow)
    ]
    assert both[0].travel.tolist() == both[1].travel.tolist()
