"""The ground that the last benches can reach when they are let go.

The front handle of the first loose bench still follows the path; behind it the benches are links that turn freely. A
point of loose bench k is no further from that handle than the chords of the loose benches before it and the distance of
its furthest corner from its own front handle. So the benches stay within the largest of these reaches R from a place of
the handle, and all places of the handle are a stretch of the path.

Between two of its points, L apart along the path and d apart in the plane, the stretch stays within
    sqrt(L^2 - d^2) / 2
of the line from one to the other: the sum of the distances of any point of it from both is at most L, so it lies in the
ellipse with the two as foci, and that is the shorter half axis. Nor is a point of the line further from the stretch,
which crosses the ellipse from one focus to the other. The polygons hold all points within R plus the largest of these
of the lines.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from core.checks import checked_count, checked_number
from core.claims.certificate import WithClaim
from core.claims.claim import ClaimKind, TailClaim
from core.dance import Dance
from core.display import WithArrays
from core.dragon import Dragon, Stray, checked_stray
from core.ground.tracks import stretches
from core.kernels import Budget
from core.language import say
from core.questions import question_about
from core.shapes.engines import GROWTH_MOST, Polygons, area_of, thickened

# Least and largest part of the excess that comes from the lines between points of the path [m].
EXCESS_MIN, EXCESS_MAX = 1e-3, 1.0
# First distance between two points along the path [m], and the rounding of their places and of the polygons [m].
STEP, ROUNDING = 0.25, 1e-8
# Work of a point with its share of the polygons, 2 us, and the budget of one question: half a million points [1].
POINT_WORK, TAIL_WORK = 20.0, 1e7


@dataclass(frozen=True, slots=True, repr=False)
class TailProof(WithClaim):
    """Evidence of the ground of a loose tail.

    claim: the claim as a kind and values

    >>> from core import Line, Route
    >>> proof = tail_reach(Dance(Dragon(5), Route([Line((0.0, 0.0), (40.0, 0.0))])), 2).certificate
    >>> proof.claim.kind
    <ClaimKind.LOOSE_TAIL: 'loose_tail'>
    """

    claim: TailClaim


@dataclass(frozen=True, slots=True, repr=False, eq=False)
class TailReach(WithArrays):
    """The ground that loose benches can reach.

    polygons: for each its outer ring, counter-clockwise, then its holes, clockwise; rings are closed, (points, 2) [m]
    benches: number of loose benches, the last ones
    reach: furthest that they come from the handle that still follows the path [m]
    excess: largest distance of any point of the polygons from ground within that reach [m]
    area: area of all polygons [m2]
    start: start of the time asked about [s]
    stop: end of the time asked about [s]
    certificate: evidence for the ground

    >>> from core import Line, Route
    >>> reached = tail_reach(Dance(Dragon(5), Route([Line((0.0, 0.0), (40.0, 0.0))])), 2)
    >>> round(reached.reach, 3), reached.benches
    (3.581, 2)
    """

    polygons: Polygons
    benches: int
    reach: float
    excess: float
    area: float
    start: float
    stop: float
    certificate: TailProof

    def _line(self) -> str:
        return say(
            "{count} loose benches within {reach:.3f} m, {area:.6g} m2",
            count=self.benches, reach=self.reach, area=self.area,
        )  # fmt: skip


@question_about("dance", Dance, "the ground that loose benches can reach was not found")
def tail_reach(
    dance: Dance,
    benches: int,
    *,
    stray: float | Stray = 0.0,
    start: float | None = None,
    stop: float | None = None,
    excess: float = 1e-2,
    budget: Budget | None = None,
) -> TailReach:
    """The ground that the last benches can reach if they are let go at any time, while the others dance on.

    benches: number of loose benches, at most all; stray: of the handle that still follows [m]
    start, stop: [s]; defaults: dance.begin and the end of the run
    excess: largest error of the stretch that the handle passes [m]; arcs around its ends and bends add 2 % of the reach
    Loose benches keep to the ground: they are links that turn freely, without any limit of speed or force.
    raises: InvalidValue; OutsideRun; TooMuchWork

    >>> from core import Line, Route
    >>> lane = Dance(Dragon(5), Route([Line((0.0, 0.0), (40.0, 0.0))]))
    >>> answer = tail_reach(lane, 2)
    >>> round(answer.reach, 3), answer.area > 2.0 * answer.reach * 30.0
    (3.581, True)
    """
    loose = checked_count("benches", benches, 1, dance.dragon.benches)
    excess = checked_number("excess", excess, "m", EXCESS_MIN, EXCESS_MAX)
    strayed = checked_stray(stray, dance.dragon)
    begin, until = dance.whole_span(start, stop)
    budget = (budget or Budget()).within(TAIL_WORK)
    first = dance.dragon.benches - loose
    lows, highs, spares = stretches(dance, dance.clock.travel(begin), dance.clock.travel(until))
    low, high = float(lows[first]), float(highs[first])
    step = STEP
    while True:
        count = 2 + math.ceil((high - low) / step)
        budget.afford(POINT_WORK * count)
        budget.afford()  # before so many points are placed
        places = np.linspace(low, high, count)
        points, length = dance.path.position(places), (high - low) / (count - 1)
        apart = np.hypot(*np.diff(points, axis=0).T)
        beside = 0.5 * math.sqrt(max(0.0, length**2 - float(apart.min()) ** 2)) + ROUNDING
        if beside <= excess:
            break
        step *= 0.5
    reach = reach_of(dance.dragon, first)
    polygons = thickened(points, reach + strayed + beside)
    most = (GROWTH_MOST - 1.0) * (reach + strayed + beside) + strayed + 2.0 * beside + float(spares[first])
    claim = TailClaim(ClaimKind.LOOSE_TAIL, begin, until, loose, reach, strayed, most)
    return TailReach(polygons, loose, reach, most, area_of(polygons), begin, until, TailProof(claim))


def reach_of(dragon: Dragon, first: int) -> float:
    """Furthest that a point of the benches from `first` on comes from its front handle [m]."""
    before = np.concatenate([[0.0], np.cumsum(dragon.chords[first:-1])])
    behind = dragon.chords[first:] + dragon.overhangs[first:]
    return float((before + np.hypot(behind, 0.5 * dragon.widths[first:])).max())
