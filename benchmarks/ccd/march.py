"""Our own engine for one corner and one edge: the march of core/kernels/marching.py, with the bounds of the kernels.

In the frame of the edge's bench the edge is at rest and the corner is at q(x) after the travel x. K of
core/kernels/gap_curvature.py bounds the second derivative of e . q for every unit vector e fixed in that bench; here e
is the direction outwards from the edge. So over a step h the corner is at least as far out as least_between() gives
from the two ends: if that exceeds the margin and the rounding G of core/kernels/pairs.py, the corner did not meet the
edge in between. A step that is not proven is halved or ends at the crossing; contact is claimed where the corner is
within the margin for certain, a bracket after the last proven travel.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from benchmarks.ccd.motion import OUTWARDS, Motion, Point, local_corner, moved_edge
from core import kernels
from core.kernels.constants import CENTRE_SPEED, FREE, MX, MY, UY
from core.values import Floats

# Half width of the bracket around a contact, and the widest one where rounding hides a slow contact [m].
BRACKET, BRACKET_MOST = 1e-10, 1e-5
# First step [m], and how much it grows at most from one to the next [1].
FIRST, GROWS = 0.01, 2.0
# Distance ahead at which a contact is tested if rounding hides its beginning [m].
PEEK = 1e-4
# Steps after which a march gives up [1].
STEPS_MOST = 100_000
# Part of the largest provable step that is tried next, and width of a crossing in brackets [1].
ROOM, CROSSING = 0.95, 1e-3


class Undecided(Exception):
    """Rounding hides whether the corner meets the edge."""


class Step(NamedTuple):
    """A step: how far the corner is out at both ends, less the margin [m], K [1/m], its width and rounding G [m]."""

    before: float
    after: float
    bend: float
    h: float
    rounding: float


class March:
    """The state of one march. travel: the corner did not meet the edge before this [m]"""

    def __init__(self, motion: Motion) -> None:
        self.motion, self.query, self.stage = motion, motion.query, motion.stage
        self.corner = local_corner(motion.stage, self.query.corner_bench, self.query.corner)
        self.outwards = OUTWARDS[self.query.edge]
        self.edge = self.out(moved_edge(motion.stage, self.query, self.query.margin)[0])
        self.pair = sorted((self.query.corner_bench, self.query.edge_bench))
        begun = self.stage.search.place - self.query.place
        self.slack = self.stage.search.travel_rounding(begun, begun + self.query.span)
        self.travel = 0.0

    def out(self, q: Point) -> float:
        """Distance of a point of the edge's bench along the direction outwards [m]."""
        return self.outwards[0] * q[0] + self.outwards[1] * q[1]

    def gap(self, rows: Floats) -> float:
        """Distance of the corner out from the moved edge [m]."""
        mx, my, ux, uy = rows[self.query.corner_bench, MX : UY + 1].tolist()
        ox, oy, vx, vy = rows[self.query.edge_bench, MX : UY + 1].tolist()
        x = mx + self.corner[0] * ux - self.corner[1] * uy - ox
        y = my + self.corner[0] * uy + self.corner[1] * ux - oy
        return self.out((x * vx + y * vy, y * vx - x * vy)) - self.edge

    def gap_after(self, travel: float) -> float:
        """The same after a travel [m]."""
        return self.gap(self.motion.rows(travel / self.query.span))

    def look(self, start: float, h: float) -> Step | None:
        """A step from a travel on, wider by what rounding may move its ends; None where no bound is known."""
        search, (a, b) = self.stage.search, self.pair
        h += 2.0 * self.slack
        self.motion.evaluations += 2
        bends = kernels.pair_curvatures(search.scene, search.probe, self.query.place - start + self.slack, h, a, b)
        bend = bends[self.pair.index(self.query.edge_bench)]
        if bend >= FREE:
            return None
        before, after, motion = search.probed, search.probed_later, search.motion
        apart = math.hypot(before[a, MX] - before[b, MX], before[a, MY] - before[b, MY])
        apart += h * float(motion[a, CENTRE_SPEED] + motion[b, CENTRE_SPEED])
        rounding = kernels.pair_rounding(a, b, apart, search.sizes, before, after)
        return Step(self.gap(before), self.gap(after), bend, h, rounding)

    def crossing(self, low: float, high: float, width: float) -> float:
        """Travel at which the gap falls to 0, positive at low and negative at high: Illinois with bisections [m]."""
        above, below, last = self.gap_after(low), self.gap_after(high), 0
        for k in range(100):
            if high - low <= width:
                break
            middle = low + (high - low) * above / (above - below)
            if not low < middle < high or k % 4 == 3:
                middle = 0.5 * (low + high)
            value = self.gap_after(middle)
            if value > 0.0:
                low, above, below, last = middle, value, below * (0.5 if last == 1 else 1.0), 1
            else:
                high, below, above, last = middle, value, above * (0.5 if last == -1 else 1.0), -1
        return high

    def meets(self, travel: float) -> bool:
        """Whether the corner is at the edge or beyond it for certain, wherever rounding may put the head."""
        step = self.look(travel, 0.0)
        if step is None:
            return False
        return max(step.before, step.after) + step.bend * step.h * step.h / 8.0 + step.rounding < 0.0

    def advance(self, h: float) -> float | None:
        """Advance by a step if it is proven; returns the width of the next one [m], or None if it is not proven."""
        step = self.look(self.travel, h)
        if step is None:
            return None
        spare = least_between(step.before, step.after, step.bend, step.h) - step.rounding
        if not spare > 0.0:
            return None
        self.travel += h
        return min(ROOM * math.sqrt(8.0 * spare / step.bend + step.h * step.h), GROWS * h)

    def bracketed(self, high: float) -> float | None:
        """The time of a contact on the way up to a travel, if all before a bracket around it is proven."""
        target = self.crossing(self.travel, high, BRACKET * CROSSING)
        bracket = BRACKET
        while bracket <= BRACKET_MOST:
            before, after = target - bracket, min(target + bracket, self.query.span)
            if self.meets(after) and (before <= self.travel or self.advance(before - self.travel) is not None):
                return target / self.query.span
            bracket *= 10.0
        return None


def march(motion: Motion) -> float | None:
    """Time in [0, 1] at which the corner first meets the edge; None if it is proven not to.

    raises: Undecided
    """
    state, span = March(motion), motion.query.span
    h = min(FIRST, span)
    for _ in range(STEPS_MOST):
        if state.travel >= span:
            return None
        h = min(h, span - state.travel)
        wider = state.advance(h)
        if wider is None:
            end = state.travel + h
            if h < PEEK and state.gap_after(end) > 0.0:
                end = min(state.travel + PEEK, span)
            time = state.bracketed(end) if state.gap_after(end) <= 0.0 < state.gap_after(state.travel) else None
            if time is not None:
                return time
            h *= 0.5
            if h < state.slack:
                raise Undecided
        else:
            h = wider
    raise Undecided


def least_between(start: float, end: float, bend: float, h: float) -> float:
    """Least value on an interval of width h of a function with these ends and |second derivative| <= bend."""
    rise, sag = end - start, bend * h * h
    if 2.0 * abs(rise) >= sag:
        return min(start, end)
    return 0.5 * (start + end) - 0.125 * sag - 0.5 * rise * rise / sag
