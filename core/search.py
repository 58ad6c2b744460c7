"""Search: one dragon on one path, as the certified march of the kernels needs them.

The proof of a march is written above the loops that carry it out: `core/kernels/bounds.py`, `pairs.py` and `rings.py`.
"""

from __future__ import annotations

import math
from functools import cached_property

import numpy as np

from core import kernels
from core.dragon import Dragon, Floats
from core.kinematics import RunEnd
from core.paths import Spiral
from core.route import Route

MARGIN_MAX = 1e4  # [m]
# Steps after which a search gives up as undecided; the default case takes about a hundred.
STEP_BUDGET = 200_000
# And work after which it gives up [1]: a bench placed for a step, or 64 edges at rest tried against one. Of first
# contact, 2 to 5 s; of a least distance, whose steps end near a bench or an edge and cost more, about the same.
WORK_BUDGET = 2e7
NEAR_WORK_BUDGET = 5e6
EDGES_PER_WORK = 64
# A dance is sampled so many times at most [1], and with this share of the work.
SAMPLES = 20_000
SAMPLED_SHARE = 0.1
# Half width of the bracket around a contact [m of head travel] at head speeds of 1 m/s and more, and the least that
# rounding of the travel allows at lower ones.
BRACKET = 1e-10
BRACKET_MIN = 2e-11
# The same where benches meet so slowly that rounding hides the gap that near, for contacts within about 5e-5 m of a
# graze: the first one is 1e-9 s in all at 1 m/s, and core/precise.py narrows the wider ones to it [m of head travel].
# Below 1 m/s the same in seconds come first.
BRACKETS_GRAZING = (4.9e-10, 5e-9, 5e-8, 5e-7, 5e-6, 5e-5)
# What a travel may be off by, of the way [1], u = 2^-53: on a spiral its length to 5 u, two differences from it and the
# polar angle there 10 u (spiral_theta() ends within 7 u of the arc length left), a time from a travel and back 2 u.
TRAVEL_ROUNDING = 2e-15
# The last stretch before a fold, where handle speeds grow without bound: dismissed by a bound on the motion left [m].
FOLD_SLIVER = 1e-9
# No radius is known to be clear [m].
NO_BOUND = 1e150
# A spiral is no route.
NO_PIECES = np.empty((0, kernels.PIECE_COLUMNS))
# The kernels' word for a run without a graze [m].
NO_GRAZE = 1e150
# A march leaves out no pair.
NO_PAIR = (-1.0, -1.0)
# What the ring bound may be off by, of the lengths in it [1]: at most 64 sums, products and roots, with d^2 = radius^2
# - foot^2 at least a thousandth of radius^2 (core/kernels/rings.py), so that d is good to 2,000 u.
RING_ROUNDING = 1e-11


class Search:
    """The arrays that the kernels need for one dragon, and the path and margin they are used for now.

    extremes: longest and shortest chord, longest overhang, half width of all benches, chord and half width of those
        that can be the outer of a pair [m]; ring: the same for the kernels, see RING_... there
    sizes: (rows, 4) of the leading benches; edges: (E, 4) x, y, x, y of edges at rest [m], on routes only; with
        edges, the pairs are bench and edge alone: edge e is bench number room + 1 + e of a pair
    clear_radius: on a spiral, no pair whose inner bench leads at this radius or further out comes within the margin [m]
    work: what its marches may still do, see WORK_BUDGET
    place: what the kernels count places from, at time 0: arc length from the centre of a spiral, minus s on a route [m]
    """

    margin: float
    clear_radius: float

    def __init__(
        self,
        dragon: Dragon,
        path: Spiral | Route,
        margin: float,
        edges: Floats | None = None,
        *,
        work: float = WORK_BUDGET,
    ) -> None:
        self.dragon, self.work = dragon, work
        self.edges = np.empty((0, 4)) if edges is None else edges
        self.statics = -len(self.edges)
        alike = dragon.uniform_from
        # The constructor's share of a first contact: a few reductions of all columns, not many of one each.
        sizes = (dragon.chords, dragon.overhangs, 0.5 * dragon.widths, dragon.lengths)
        columns = np.array([column[: alike + 1] for column in sizes])
        outer = columns[:, min(2, alike) :]
        longest, overhang, half_width, self.longest = columns.max(axis=1).tolist()
        outer_chord, outer_overhang, outer_half_width, _ = outer.max(axis=1).tolist()
        shortest, outer_shortest = columns[0].min(), outer[0].min()
        self.extremes = (longest, shortest, overhang, half_width, outer_chord, outer_half_width)
        ring = (0.0, outer_chord, outer_shortest, outer_overhang, outer_half_width)
        self.ring = np.array(
            [*ring, longest, overhang, half_width, shortest, math.hypot(0.5 * self.longest, half_width), *NO_PAIR]
        )
        self.resize(dragon.benches if isinstance(path, Route) else min(dragon.benches, 255))
        self.use(path, margin)

    def use(self, path: Spiral | Route, margin: float) -> None:
        """Turn to another path or margin."""
        self.path, self.margin = path, margin
        if isinstance(path, Route):
            self.growth, self.pieces, self.place = 1.0, path.table, 0.0
            self.clear_radius = NO_BOUND
        else:
            self.growth, self.pieces, self.place = path.growth, NO_PIECES, path.length
            self.clear_radius = self._clear_radius()
        self.ring[0] = self.clear_radius

    def travel_rounding(self, *travels: float) -> float:
        """What travels up to these may be off by, in the kernels and as times [m]."""
        if isinstance(self.path, Route):
            return self.path.slide + TRAVEL_ROUNDING * max(map(abs, travels))
        return TRAVEL_ROUNDING * max(self.place, *(self.place - travel for travel in travels), *map(abs, travels))

    def resize(self, benches: int) -> None:
        """Room for so many leading benches, and the edges at rest after the row of the last handle."""
        dragon, edges = self.dragon, self.edges
        lengths, widths = dragon.lengths[:benches], dragon.widths[:benches]
        columns = [dragon.chords[:benches], 0.5 * lengths, 0.5 * widths, 0.5 * np.hypot(lengths, widths)]
        self.sizes = np.zeros((benches + 1 + len(edges), kernels.SIZE_COLUMNS))
        self.sizes[:benches] = np.stack(columns, axis=1)
        # A chain writes what is read of it, but march() asks how fast handle 1 is before it is placed.
        self.rows = np.empty((4, benches + 1 + len(edges), kernels.CHAIN_COLUMNS))
        self.rows[:, :2] = 0.0
        self.motion = np.zeros((benches + 1 + len(edges), kernels.MOTION_COLUMNS))
        self.pair = np.zeros(3, dtype=np.intp)
        if len(edges):
            along = edges[:, 2:4] - edges[:, 0:2]
            half = 0.5 * np.hypot(along[:, 0], along[:, 1])
            self.sizes[benches + 1 :, 1] = self.sizes[benches + 1 :, 3] = half
            self.rows[:, benches + 1 :] = 0.0
            self.rows[:, benches + 1 :, 6:8] = 0.5 * (edges[:, 0:2] + edges[:, 2:4])
            self.rows[:, benches + 1 :, 8:10] = along / (2.0 * half)[:, None]

    @property
    def room(self) -> int:
        """How many leading benches there is room for."""
        return int(self.sizes.shape[0]) - 1 - len(self.edges)

    @property
    def _step_work(self) -> float:
        return self.room * (1.0 + len(self.edges) / EDGES_PER_WORK)

    def samples(self, span: float, step: float) -> int:
        """How many instants to look at over a span [m]: a step apart [m], or as many as the work allows."""
        affordable = min(float(SAMPLES), SAMPLED_SHARE * self.work / self._step_work)
        return max(3, int(min(3.0 + span / step, affordable)))

    def ring_least(self, radius: float) -> float:
        """Lower bound of the separation of pairs whose inner bench leads at this radius or further out [m]."""
        least = float(kernels.ring_least(self.growth, self.growth, radius, *self.ring_extremes))
        return least - self.ring_rounding(radius, self.growth)

    def ring_rounding(self, radius: float, growth: float) -> float:
        """What kernels.ring_least() may be off by for growths up to this one [m]."""
        return RING_ROUNDING * (radius + 2.0 * math.pi * growth + float(self.longest))

    @cached_property
    def ring_extremes(self) -> tuple[float, ...]:
        """The extremes, but the shortest chord only of those benches that can lie between two others [m]."""
        longest, _, *others = (float(extreme) for extreme in self.extremes)
        alike = self.dragon.uniform_from
        return longest, float(self.dragon.chords[min(1, alike) : alike + 1].min()), *others

    def _clear_radius(self) -> float:
        """The least radius, within 1e-3, from which the ring bound exceeds the margin; 1e150 if none."""
        high = 1.0
        while self.ring_least(high) <= self.margin:
            high *= 4.0
            if high > 1e9:
                return NO_BOUND
        low = 0.0
        while high - low > 1e-3 * high:
            middle = 0.5 * (low + high)
            low, high = (low, middle) if self.ring_least(middle) > self.margin else (middle, high)
        return high * (1.0 + RING_ROUNDING)

    def travel_at(self, theta: float) -> float:
        """Head travel from the start of a spiral to theta [m]."""
        return self.place - self.growth * float(kernels.spiral_arc(theta))

    def theta_at(self, travel: float) -> float:
        """Head angle on a spiral after a travel [rad]."""
        return float(kernels.spiral_theta((self.place - travel) / self.growth))

    def march(
        self, stop: float, tolerance: float, *, start: float = 0.0, opening: bool = True
    ) -> tuple[str, dict[str, float]]:
        """kernels.march from start, or from where the ring bound ends, to stop [m of travel]: state, result by name.

        opening: nothing before the start was cleared, so all pairs are followed until the body repeats itself
        The way marched begins and ends beyond both by what a travel may be off by, so that what is said of travels, and
        of times, holds for the true ones.
        """
        rounding, asked = self.travel_rounding(start, stop), (start, stop)
        start -= rounding
        stop = min(stop + rounding, max(stop, self.place)) if isinstance(self.path, Spiral) else stop + rounding
        if isinstance(self.path, Spiral):
            clear_until = self.travel_at(self.clear_radius / self.growth) if self.clear_radius < NO_BOUND else start
            if clear_until > start:
                opening = False
                start = clear_until
        nothing = self.dragon.benches < 3 and not len(self.edges)
        if nothing or (start >= stop and not opening):
            return "reached", dict.fromkeys(kernels.MARCH_FIELDS, 0.0) | {"proven": asked[1], "graze_gap": NO_GRAZE}
        out = np.empty(32)
        while True:
            budget = min(float(STEP_BUDGET), max(self.work / self._step_work, 1.0))
            code = kernels.march(
                self.growth,
                self.pieces,
                self.place,
                start,
                stop,
                min(self.dragon.uniform_from + 1, self.dragon.benches),
                opening,
                self.margin,
                tolerance,
                rounding,
                int(budget),
                self.dragon.benches,
                self.statics,
                self.ring,
                self.sizes,
                self.rows,
                self.motion,
                self.pair,
                out,
            )
            state = kernels.MARCH_STATES[code]
            self.work -= out[4] * self._step_work
            if state != "capacity":
                found = dict(zip(kernels.MARCH_FIELDS, out.tolist(), strict=False))
                found["proven"] = asked[1] if state == "reached" else max(found["proven"] - rounding, asked[0])
                if state == "touched_at_start":
                    found["touching"] = asked[0]
                return state, found
            self.resize(min(4 * self.room, self.dragon.benches))

    def others_clear(self, pair: tuple[int, int], start: float, stop: float) -> bool:
        """Are all pairs but one proven to be clear between two travels [m]?"""
        self.ring[-2:] = pair
        state, _ = self.march(stop, 0.0, start=start)
        self.ring[-2:] = NO_PAIR
        return state == "reached"

    @staticmethod
    def last_travel(until: float, to_fold: bool) -> float:
        """How far to march for a run until a travel [m]: short of a fold by a sliver, see clear_to_fold()."""
        return until - (FOLD_SLIVER + 5e2 * TRAVEL_ROUNDING * until if to_fold else 0.0)

    def approach(self, begin: float, until: float, head_speed: float) -> tuple[str, dict[str, float], float]:
        """march() between two travels [m] with the bracket of a contact: state, result by name, its half width [m]."""
        tolerance = max(BRACKET * min(1.0, head_speed), BRACKET_MIN, 2.0 * self.travel_rounding(begin, until))
        state, found = self.march(until, tolerance, start=begin)
        proven = found["proven"]
        slowed = [wider * min(1.0, head_speed) for wider in BRACKETS_GRAZING]
        for wider in sorted({*slowed, *BRACKETS_GRAZING}):
            if state != "stuck" or found["touching"] < 0.0:
                break
            if wider > tolerance:
                tolerance = wider
                state, found = self.march(until, tolerance, start=begin)
                proven = max(proven, found["proven"])
        return state, found | {"proven": proven}, tolerance

    def place_leaders(self, travel: float, leaders: int) -> None:
        """Put so many leading benches, and no pair of them, into rows[0] as they are after a travel [m]."""
        self._clearance(travel, leaders, 0)

    def clearance(self, travel: float, leaders: int | None = None) -> tuple[float, tuple[int, int]]:
        """Clearance after a travel [m], and its pair; among pairs led by the first `leaders` benches only."""
        benches = self.room
        if leaders is None:
            leaders = benches
        elif isinstance(self.path, Spiral):
            benches = min(benches, leaders + self._followed(travel, leaders))
        gap = self._clearance(travel, benches, leaders)
        return gap, (int(self.pair[1]), int(self.pair[2]))

    def _clearance(self, travel: float, benches: int, leaders: int) -> float:
        gap: float = kernels.clearance_at(
            self.growth,
            self.pieces,
            self.place - travel,
            benches,
            leaders,
            self.statics,
            self.sizes,
            self.rows[0],
            self.motion,
            self.pair,
        )
        return gap

    def _followed(self, travel: float, leaders: int) -> int:
        """How many benches behind the leaders of a spiral can be as near to them as the leaders' own sizes."""
        start, growth = self.theta_at(travel), self.growth
        rear = growth * start + leaders * self.extremes[0]
        reach = kernels.leaders_reach(growth, growth * start, rear, self.ring) + self.longest
        beyond = kernels.radius_beyond(growth, reach, self.ring) / growth
        arc = growth * (kernels.spiral_arc(max(beyond, start)) - kernels.spiral_arc(start))
        return 2 + int(arc / self.extremes[1])

    def rates(self, travel: float) -> Floats:
        """Speed of every handle along the path over the head's after a travel, negative where one turns back [1]."""
        self.clearance(travel)
        return self.rows[0, : self.room + 1, 5].copy()

    def gap_rate(self, travel: float, pair: tuple[int, int]) -> float:
        """How fast a pair parts after a travel, per metre of head travel [1]."""
        return float(
            kernels.gap_rate_at(
                self.growth, self.pieces, self.place - travel, self.room, *pair, self.sizes, self.rows[1], np.empty(8)
            )
        )

    def bottom(self, low: float, high: float, pair: tuple[int, int], width: float) -> float:
        """Travel in [low, high] where a pair stops approaching [m]."""
        return float(
            kernels.crossing(
                self.growth,
                self.pieces,
                self.place,
                self.room,
                low,
                high,
                *pair,
                0.0,
                width,
                True,
                self.sizes,
                self.rows[1],
                np.empty(8),
            )
        )

    def clear_to_fold(self, travel: float, end: RunEnd) -> bool:
        """Is the clearance after a travel more than what is left of the motion to the fold can use up?"""
        if self.dragon.benches < 3:
            return True
        left = self.margin + self.motion_left(travel, end)
        return self.clearance(travel)[0] > left + self.gap_rounding(travel, left)

    def gap_rounding(self, travel: float, within: float) -> float:
        """What gaps of up to `within` [m] may be off by after a travel, see core/kernels/pairs.py [m]."""
        self.place_leaders(travel, self.room)
        kernels.chain_rounding(self.growth, self.pieces, self.room, self.sizes, self.rows[0])
        error, sway = self.rows[0, : self.room, kernels.ERROR].max(), self.rows[0, : self.room, kernels.SWAY].max()
        reach = 4.0 * float(self.ring[9]) + within
        return float(2.0 * (2.0 * error + (2.0 * sway + 50.0 * kernels.ULP) * reach))

    def motion_left(self, travel: float, end: RunEnd) -> float:
        """Bound on how far any two points of two benches approach each other from a travel to the fold [m].

        Bench m = end.bench folds: from delta_L to the crest, handle m + 1 moves by at most the change of both ends'
        angles; the handles before it move less than the head's travel rates there, those behind it less than it.
        """
        assert end.bench is not None
        self.clearance(travel)
        m, growth = end.bench, self.growth
        lead, rear = self.rows[0, m, 4], self.rows[0, m + 1, 4]
        fold = kernels.fold_theta(float((self.dragon.chords[m] / growth) ** 2))
        swing = abs(kernels.first_crest(fold) - (rear - lead)) + abs(lead - fold)
        moved = growth * swing * math.hypot(1.0, rear + swing)
        share = 1.0 + (2.0 * self.extremes[2] + 2.0 * self.extremes[3]) / self.extremes[1]
        return float(2.0 * share * moved)
