"""Bands of pitches: each is an interval of pitches that are proven free of contact all at once.

The proof for one band is written above its loop in `core/kernels/band_march.py`.
"""

from __future__ import annotations

import math
from enum import Enum, auto
from itertools import pairwise

import numpy as np

from core import kernels
from core.contact.brackets import TRAVEL_ROUNDING
from core.contact.search import ContactSearch
from core.design.spread import Spread
from core.design.straight import Straight
from core.kernels import Ended
from core.kernels.results import Marched
from core.paths.spiral import Spiral
from core.values import Pair

# Lower end of the first band of a descent, as a part of its top [1]: the top is seldom far above the border. With it
# the default takes 14.7 ms and a circle of 4 m 5.9 ms, without it 17.7 and 9.0 ms (measured 2026-11-21).
FIRST_BAND = 0.9
# Half width of the bracket around the border of feasible pitches [m of pitch]. The gap of a graze this far above the
# border must exceed the proven error of gaps, 3e-13 m for benches 0 and 19 of the default (pair_rounding()).
BORDER_WIDTH = 5e-13
# A narrower band that is neither proven nor touching ends the descent [m of pitch].
BAND_MIN = 1e-11
# Shortest step in a band, as a part of its width [m of travel per m of pitch]: if a shorter one is needed, the band is
# too wide; and at least STEP_MIN [m of travel], as in a march without a bracket.
STEP_PER_WIDTH = 0.2
STEP_MIN = 1e-7
# Largest width, as a part of the pitch, of a band in which the border is searched along one graze; wider bands are
# halved [1].
WIDTH_FOLLOWED = 0.1
# Smallest width of a band that is still halved if no bound holds, as a part of its pitch [1].
UNBOUNDED_WITHIN = 1e-3
# Largest work of all bands of a descent together [1], see core/kernels/constants.py: about a second. The default case
# takes about 130,000.
BAND_WORK = 1e7
# There is no march if no bound of `clears` holds within this multiple of the turning radius, the start or the pitch
# [1].
FAR = 2.0
# First step along the way to the bottom of a dip [m of travel], and largest number of its doublings.
STRIDE, STRIDES = 2e-3, 10
# Precision of the bottom of a dip [m of travel].
BOTTOM_WIDTH = 1e-12
# Most attempts to find the pitch at which a dip reaches the margin.
LOOKS = 40


class Descent(Enum):
    """Reason why a descent through the pitches ended.

    LOWEST: all are clear; BORDER: a contact that becomes a graze, as computed, less than 2 BORDER_WIDTH below
    STUCK: the next BAND_MIN could not be proven; UNBOUNDED: no bound holds, or a handle moves backwards
    SPENT: BAND_WORK, or the budget, is spent
    """

    LOWEST = auto()
    BORDER = auto()
    STUCK = auto()
    UNBOUNDED = auto()
    SPENT = auto()


class Bands:
    """Proofs for one dragon and turning circle, each for an interval of pitches.

    A proven band holds for all ways to the circle from any start outside. Far out a bound holds that needs no chain of
    handles. Further in the march proves it for the leading benches, and the body repeats all their poses.
    work: of all bands together; marches: bands tried; graze: the pair that ends the last descent, and the radius of
        the head then [m], if it was found
    """

    def __init__(self, search: ContactSearch, radius: float, start_turns: float, margin: float) -> None:
        self.search, self.radius, self.start_turns, self.margin = search, radius, start_turns, margin
        self.work, self.marches = 0.0, 0
        self.graze: tuple[Pair, float] | None = None
        self.straight = Straight(search.dragon) if search.copies == 1 else Spread(search.dragon, search.copies)
        # outside the circle the path curves so little that no handle moves backwards and no bench folds
        most = 0.5 * kernels.SPIRAL_CURVATURE_MOST * float(search.rings.all_chord) / radius
        self.curved_little = most <= kernels.SINE_LIMIT
        self._make_room(search.room)

    def clears(self, low: float, high: float, radius: float) -> bool:
        """True if a bound excludes contacts from a head radius outwards for all growths in [low, high]."""
        return self.ring_clears(low, high, radius) or self.straight.clears(low, radius, self.margin)

    def ring_clears(self, low: float, high: float, radius: float) -> bool:
        """True if the ring bound excludes contacts from a head radius outwards for all growths in [low, high]."""
        if self.search.copies > 1:
            least = kernels.spirals_least(high, self.search.apart, radius, self.search.rings, low)
            return bool(least > self.margin + kernels.ring_rounding(high, radius, self.search.rings))
        return bool(kernels.ring_clears(low, high, radius, self.margin, self.search.rings, self.straight.total))

    def _make_room(self, benches: int) -> None:
        rows = self.search.copies * (benches + 1)
        self.rows = np.zeros((2, 2, rows, kernels.CHAIN_COLUMNS))
        self.motions = np.zeros((2, rows, kernels.MOTION_COLUMNS))
        self.shifts = np.zeros((rows, kernels.SHIFT_COLUMNS))

    def march_to(self, growth_high: float) -> kernels.BandMarch:
        """The march of the band from the growth of the search to a higher one [m/rad]."""
        search, curve = self.search, kernels.spiral_curve(growth_high)
        high = kernels.Scene(curve, search.place, search.rings, search.sizes, search.dragon.benches, 0)
        high.kinds = search.kinds
        search.copy(high)
        (before, after), (before_high, after_high) = self.rows
        low_interval = kernels.Interval(search.scene, before, after, self.motions[0])
        high_interval = kernels.Interval(high, before_high, after_high, self.motions[1])
        return kernels.BandMarch(low_interval, high_interval, self.shifts)

    def prove(self, low: float, high: float, outer: float) -> Marched:
        """A march for all pitches in [low, high] while the head's radius falls from outer to the circle [m].

        REACHED: all are clear; TOUCHED: the lowest one is not; STUCK: not provable in one band; UNBOUNDED and
        BENCH_FOLDED: perhaps not provable in narrower bands either, because no bound holds far out, a handle may move
        backwards, or a bench folds. The march is `proven` down to a radius, and `touching` at one.
        """
        search = self.search
        search.use(Spiral(low, self.start_turns), self.margin)
        clear = self._clear_radius(low / math.tau, high / math.tau)
        if clear >= kernels.FREE:
            return Marched(Ended.UNBOUNDED, outer)
        outer = min(outer, max(clear, self.radius))
        self.marches += 1
        rounding = TRAVEL_ROUNDING * outer * max(outer / (low / math.tau), 1.0)
        least_step = max(STEP_MIN, STEP_PER_WIDTH * (high - low))
        while True:
            march = self.march_to(high / math.tau)
            budget = min(BAND_WORK - self.work, search.budget.left)
            result = march.run(outer, self.radius, search.leaders, rounding, least_step, budget)
            self.work += result.work
            search.spend(result.work)
            search.budget.look()
            if result.ended is not Ended.CAPACITY:
                return result
            search.resize(min(4 * search.room, search.dragon.benches))
            self._make_room(search.room)

    def _clear_radius(self, low: float, high: float) -> float:
        """A radius from which on a bound exceeds the margin for all growths in [low, high]; FREE if too far out."""
        clear, far = self.radius, FAR * max(self.radius, 2.0 * math.pi * high * max(self.start_turns, 1.0))
        while not self.clears(low, high, clear):
            clear *= 1.05
            if clear > far:
                return kernels.FREE
        return clear

    def descend(self, top: float, lowest: float) -> tuple[float, Descent]:
        """The pitch down to which all pitches from `top` are proven clear [m], and the reason for that.

        A band that is not proven is halved, the upper half first. If its lowest pitch touches, the pitch at which that
        contact becomes a graze is searched for, and the band ends there instead.
        """
        proven, stopped = top, Descent.LOWEST
        ends = [lowest, FIRST_BAND * top, top] if lowest < FIRST_BAND * top else [lowest, top]
        bands = [(low, high, math.inf) for low, high in pairwise(ends)]
        while bands:
            low, high, outer = bands.pop()
            result = self.prove(low, high, outer)
            if result.ended is Ended.REACHED:
                proven = low
                continue
            outer = result.proven
            middle = math.sqrt(low * high)
            if self.work >= BAND_WORK or self.search.budget.left <= 0.0:
                return proven, Descent.SPENT
            if high - low < BAND_MIN:
                self.graze = None
                return proven, Descent.STUCK
            if result.ended in (Ended.UNBOUNDED, Ended.BENCH_FOLDED) and high - low < UNBOUNDED_WITHIN * high:
                return proven, Descent.UNBOUNDED
            border = None
            if result.ended is Ended.TOUCHED:
                bands, stopped, self.graze = [], Descent.BORDER, None
                if high - low <= WIDTH_FOLLOWED * high:
                    border = self.border(low, high, result)
            if border is None or border <= low:
                bands += [(low, middle, outer), (middle, high, outer)]
            else:
                bands.append((border, high, outer))
        return proven, stopped

    def border(self, low: float, high: float, contact: Marched) -> float | None:
        """A pitch in (low, high) just above that at which the contact at `low` becomes a graze [m]; None if it is lost.

        The search follows the dip of the pair from pitch to pitch, each time from the radius of the last one: first
        upwards until the dip is clear, then by false position (Illinois) to the pitch at which it reaches the margin.
        """
        assert contact.touching is not None
        pair = contact.pair
        below, radius = self.dip(low, contact.touching, pair)
        if below > self.margin:
            return None
        below -= self.margin
        above, end, last = 0.0, 0.0, 0
        pitch = low - below
        for _ in range(LOOKS):
            if not low < pitch < high:
                return None
            gap, radius = self.dip(pitch, radius, pair)
            gap -= self.margin
            if gap > 0.0:
                end, above = pitch, gap
                below = 0.5 * below if last > 0 else below
                last = 1
            else:
                low, below = pitch, gap
                above = 0.5 * above if last < 0 else above
                last = -1
            if end and end - low <= BORDER_WIDTH:
                break
            pitch = low + (end - low) * below / (below - above) if end else low - 1.5 * below + BORDER_WIDTH
            if end:
                pitch = min(max(pitch, low + 0.4 * BORDER_WIDTH), end - 0.4 * BORDER_WIDTH)
        if not end or end + BORDER_WIDTH >= high:
            return None
        self.graze = pair, radius
        return end + BORDER_WIDTH

    def dip(self, pitch: float, radius: float, pair: Pair) -> tuple[float, float]:
        """Least separation of a pair in its dip around a head radius, outside the circle, and the radius there [m]."""
        search = self.search
        search.use(Spiral(pitch, self.start_turns), self.margin)
        growth = search.growth
        stop = search.travel_at(self.radius / growth)
        travel = min(search.travel_at(radius / growth), stop)
        stride = STRIDE if search.gap_rate(travel, pair) < 0.0 else -STRIDE
        for _ in range(STRIDES):
            ahead = min(travel + stride, stop)
            if ahead == travel:
                break
            if (search.gap_rate(ahead, pair) < 0.0) != (stride > 0.0):
                travel = search.bottom(min(travel, ahead), max(travel, ahead), pair, BOTTOM_WIDTH)
                break
            travel, stride = ahead, 2.0 * stride
        search.budget.look()
        gap = kernels.gap_at(search.scene, search.place - travel, *pair, search.tried)
        return float(gap), growth * search.theta_at(travel)
