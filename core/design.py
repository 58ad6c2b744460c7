"""How tight may the curve be: minimum_pitch()."""

from __future__ import annotations

import math
from dataclasses import dataclass
from enum import StrEnum

import numpy as np

from core import kernels
from core.dragon import SIZE_MAX, SIZE_MIN, Dragon, checked_number, checked_size, checked_type
from core.errors import InvalidValue
from core.kinematics import end_theta
from core.paths import START_TURNS_MAX, Spiral
from core.search import MARGIN_MAX, NO_PIECES, Search
from core.strips import BORDER_WIDTH, Strips

# Half width of the bracket around a contact [m of head travel].
CONTACT_WIDTH = 2e-11
# Just below what the strips prove, an infeasible pitch is looked for this far down [m of pitch]: an error below 1e-9 m.
PASSED_OVER = 1e-9
# The pitch is bisected to this width [m]; rounding of a clearance is near 1e-14 m.
PITCH_WIDTH = 2e-13
# Where no bound on the change of a clearance with the pitch is at hand, so many pitches are tried, evenly spaced.
SCAN_SAMPLES = 1000
# Islands below the minimum pitch are looked for at so many pitches, evenly spaced.
ISLAND_SAMPLES = 400
# The ring bound wants d > 2 growth, where d^2 >= radius^2 - (1.67 growth)^2: growths below radius / this [1].
FOOT_LIMIT = 2.61
# What limits the pitch is looked at this far below it, where a graze has become a contact of some length [m of pitch].
BELOW = 1e-11
# At both ends of a way the pairs led by so many benches are looked at before it is marched.
LOOKED_AT = 2
# A contact this close to the circle or the start, with the pair still approaching, is on it [m of head travel].
ON_CIRCLE = 1e-4
# From the instant found just below the minimum pitch, the bottom of the graze is within this [m of head travel].
BOTTOM_WITHIN = 0.01


class LimitedBy(StrEnum):
    """What stops the pitch from being smaller."""

    GRAZE = "graze"
    CIRCLE = "circle"
    START = "start"


@dataclass(frozen=True, slots=True)
class MinimumPitch:
    """The smallest pitch such that every larger one is free of contact down to the turning circle.

    pitch: [m]; pitch_bracket: (infeasible, feasible) [m]
    limited_by: a graze on the way, contact exactly on the circle, or the start: the dance would touch
        there, or, without benches, begin inside the circle
    benches: the pair that touches just below; head_radius: of the head then [m]
    other_feasible_intervals: [m], islands below pitch, found on a grid of ISLAND_SAMPLES pitches
    justified_by: how every larger pitch up to proven_up_to [m] is known to be feasible: 'bound' or 'scan', in steps of
        scan_step [m]
    evaluations: ways from the start to the circle that were marched, and strips of pitches, see `core/strips.py`
    """

    pitch: float
    pitch_bracket: tuple[float, float]
    limited_by: LimitedBy
    benches: tuple[int, int] | None
    head_radius: float | None
    other_feasible_intervals: tuple[tuple[float, float], ...]
    justified_by: str
    proven_up_to: float
    scan_step: float | None
    evaluations: int


class _PitchSearch:
    """Ways from the start to the circle for one dragon: which pitches are free of contact."""

    def __init__(self, dragon: Dragon, radius: float, start_turns: float, margin: float) -> None:
        self.radius, self.start_turns, self.margin = radius, start_turns, margin
        self.lowest = radius / start_turns
        self.search = Search(dragon, Spiral(max(self.lowest, SIZE_MIN), start_turns), margin, work=math.inf)
        self.strips = Strips(self.search, radius, start_turns, margin)
        self.ways = 0
        self.scan_step: float | None = None

    def way(self, pitch: float, width: float = 0.0) -> tuple[str, dict[str, float]]:
        """March from the start to the circle: 'reached' proves every clearance on the way larger than the margin.

        width: half width of the bracket around a contact, 0 if any instant of it will do [m of travel]
        """
        search = self.search
        path = Spiral(pitch, self.start_turns)
        search.use(path, self.margin)
        self.ways += 1
        circle = self.radius / path.growth
        if not self.strips.bent_little and end_theta(search.dragon, path)[0] > circle:
            return "folded", dict.fromkeys(kernels.MARCH_FIELDS, 0.0)
        stop = max(search.travel_at(circle), 0.0)
        for state, travel in () if width else (("touched_at_start", 0.0), ("touched", stop)):
            # a look at both ends decides most ways that are not clear, without laying out a long dragon
            gap, pair = search.clearance(travel, min(LOOKED_AT, search.room))
            if gap <= self.margin:
                return state, {"touching": travel, "first": pair[0], "second": pair[1]}
        return search.march(stop, width)

    def is_clear(self, pitch: float) -> bool:
        """Is the whole way proven free of contact?"""
        return self.way(pitch)[0] == "reached"

    def top(self) -> tuple[float, float]:
        """A feasible pitch to descend from, and up to which every larger one is feasible by the ring bound [m].

        The ring bound holds for growths up to those of its derivation, so a pitch beyond is not asked about; where it
        clears nothing (a circle hardly wider than a bench is long), the two are the same pitch, cleared by a march
        and no larger than the circle's radius.
        """
        chord = float(self.search.extremes[0])
        foot2, lowest = self.radius**2 - 0.25 * chord**2, self.lowest / (2.0 * math.pi)
        limits = [self.radius**2 / (1.5708 * chord), self.radius / FOOT_LIMIT]
        limits += [0.5 * math.sqrt(foot2)] if foot2 > 0.0 else []
        growths = [growth for growth in (0.999 * min(limits) * 0.95**k for k in range(200)) if growth > lowest]
        for growth in growths:
            if self.strips.ring_clears(0.95 * growth, growth, self.radius):
                low = growth
                for factor in (0.95, 0.99):
                    while low > lowest and self.strips.ring_clears(factor * low, low, self.radius):
                        low *= factor
                return 2.0 * math.pi * max(low, lowest), 2.0 * math.pi * growth
        for growth in growths:
            if max(self.lowest, SIZE_MIN) < 2.0 * math.pi * growth < self.radius and self.is_clear(
                2.0 * math.pi * growth
            ):
                return (2.0 * math.pi * growth,) * 2
        return (self.lowest,) * 2

    def descend(self, top: float) -> tuple[float, float, str]:
        """From a feasible pitch down to (infeasible, feasible) [m], close together, and what justifies the way down."""
        if not self.strips.bent_little:
            return *self.scan(top), "scan"
        pitch, stopped = self.strips.descend(top, self.lowest)
        if stopped == "lowest":
            return pitch, pitch, "bound"
        if stopped != "unbounded":
            step = BORDER_WIDTH
            while step <= PASSED_OVER and pitch - step > self.lowest:
                if not self.is_clear(pitch - step):
                    return *self.bisect(pitch - step, pitch), "bound"
                step *= 2.0
        # strips are proven however far outside a way starts; this one may begin inside what stops them
        return *self.scan(pitch), "scan"

    def scan(self, pitch: float) -> tuple[float, float]:
        """(infeasible, feasible) by trying SCAN_SAMPLES pitches down to the lowest, then by bisection [m]."""
        self.scan_step = (pitch - self.lowest) / SCAN_SAMPLES
        for k in range(1, SCAN_SAMPLES + 1):
            below = pitch - self.scan_step if k < SCAN_SAMPLES else self.lowest
            if not self.is_clear(below):
                return self.bisect(below, pitch)
            pitch = below
        return self.lowest, self.lowest

    def bisect(self, infeasible: float, feasible: float) -> tuple[float, float]:
        """The same with a bracket of PITCH_WIDTH [m]."""
        while feasible - infeasible > PITCH_WIDTH:
            middle = 0.5 * (infeasible + feasible)
            state, found = self.way(middle)
            if middle in (infeasible, feasible) or (state == "stuck" and found["touching"] < 0.0):
                break
            infeasible, feasible = (infeasible, middle) if state == "reached" else (middle, feasible)
        return infeasible, feasible

    def islands(self, pitch: float) -> tuple[tuple[float, float], ...]:
        """Feasible intervals between the lowest pitch and an infeasible one, as far as the grid shows them [m]."""
        grid = np.linspace(pitch, self.lowest, ISLAND_SAMPLES).tolist()
        found: list[tuple[float, float]] = []
        touching: tuple[float, int, int] | None = None
        end = 0.0
        for k, sample in enumerate(grid):
            feasible = False
            if touching is None or not self.still_touches(sample, *touching):
                state, result = self.way(sample)
                feasible = state == "reached"
                radius = self.search.theta_at(result["touching"]) * self.search.growth
                pair = int(result["first"]), int(result["second"])
                touching = None if state in ("reached", "folded") or result["touching"] < 0.0 else (radius, *pair)
            if feasible and not end:
                end = self._end_of_island(sample, grid[k - 1])
            elif end and not feasible:
                found.insert(0, (self.bisect(sample, grid[k - 1])[1], end))
                end = 0.0
        return ((self.lowest, end), *found) if end else tuple(found)

    def still_touches(self, pitch: float, radius: float, a: int, b: int) -> bool:
        """Are benches a and b within the margin with this pitch too, the head at this radius?

        False where that radius is not on the way.
        """
        growth, search = pitch / (2.0 * math.pi), self.search
        if radius > pitch * self.start_turns:
            return False
        place = growth * kernels.spiral_arc(radius / growth)
        gap = kernels.gap_at(growth, NO_PIECES, place, search.room, a, b, search.sizes, search.rows[0])
        return float(gap) <= self.margin

    def _end_of_island(self, feasible: float, infeasible: float) -> float:
        while infeasible - feasible > PITCH_WIDTH:
            middle = 0.5 * (feasible + infeasible)
            feasible, infeasible = (middle, infeasible) if self.is_clear(middle) else (feasible, middle)
        return feasible

    def limit(self, infeasible: float) -> tuple[LimitedBy, tuple[int, int] | None, float | None]:
        """What meets just below the minimum pitch, and where."""
        graze = self.strips.graze
        if self.scan_step is None and graze and graze[1] < infeasible * self.start_turns:
            self.search.use(Spiral(infeasible, self.start_turns), self.margin)
            travel = self.search.travel_at(graze[1] / self.search.growth)
            return self._met(travel, travel, graze[0])
        state, found = self.way(infeasible - BELOW, width=CONTACT_WIDTH)
        if state == "reached":
            state, found = self.way(infeasible, width=CONTACT_WIDTH)
        pair = (int(found["first"]), int(found["second"]))
        if state == "touched_at_start":
            return LimitedBy.START, pair, self.search.growth * 2.0 * math.pi * self.start_turns
        if state == "folded":
            return LimitedBy.START, None, None
        travel = found["touching"] - (CONTACT_WIDTH if state == "touched" else 0.0)
        return self._met(travel, travel + BOTTOM_WITHIN, pair)

    def _met(self, travel: float, end: float, pair: tuple[int, int]) -> tuple[LimitedBy, tuple[int, int], float]:
        """Whether a pair that meets after a travel meets on the circle, or else where its dip, before `end`, is [m]."""
        search, growth = self.search, self.search.growth
        stop = search.travel_at(self.radius / growth)
        end = min(end, stop)
        if stop - travel < ON_CIRCLE and search.gap_rate(end, pair) < 0.0:
            return LimitedBy.CIRCLE, pair, self.radius
        return LimitedBy.GRAZE, pair, growth * search.theta_at(search.bottom(travel, end, pair, 1e-12))


def minimum_pitch(
    dragon: Dragon, *, turning_radius: float = 4.5, start_turns: float = 16.0, margin: float = 0.0
) -> MinimumPitch:
    """The smallest pitch such that every larger one lets the head reach the turning circle without contact.

    turning_radius: [m]; start_turns: turns from the centre to the start; margin: [m], clearance required
    From a pitch at which the bound of `core/kernels/rings.py` clears everything, strips of pitches are proven clear
    downwards, each for all its pitches at once (`core/strips.py`), to where a pair of benches grazes: no infeasible
    pitch is stepped over. Where strips have no bound (benches so long that they stand far across the circle, or a start
    inside the region where benches can touch while ways from further out do touch) a stated scan takes their place.
    raises: InvalidValue; also when the dragon cannot reach the circle at any pitch
    source: the model of Yang et al., section 2.5; their bisection of the contact radius cannot converge, because that
        radius jumps over the circle

    >>> round(minimum_pitch(Dragon()).pitch, 9)
    0.450337393
    """
    checked_type("dragon", dragon, Dragon)
    radius = checked_size("turning_radius", turning_radius)
    turns = checked_number("start_turns", start_turns, "turns", 0.0, START_TURNS_MAX, open_low=True)
    if radius > SIZE_MAX * turns:
        rule = f"must be at least {radius / SIZE_MAX:g} turns to start outside the circle at a pitch of {SIZE_MAX:g} m"
        raise InvalidValue.of("start_turns", rule, turns, "turns")
    margin = checked_number("margin", margin, "m", 0.0, MARGIN_MAX)
    search = _PitchSearch(dragon, radius, turns, margin)
    top, proven_up_to = search.top()
    if max(top, search.lowest) < SIZE_MIN:
        raise InvalidValue.of("turning_radius", f"must allow pitches of {SIZE_MIN:g} m and more", radius, "m")
    if not search.is_clear(max(top, search.lowest)):
        rule = "must be larger for this dragon, which dances down to such a circle at no pitch tried"
        raise InvalidValue.of("turning_radius", rule, radius, "m")
    infeasible = feasible = search.lowest
    justified_by = "bound"
    if top > search.lowest:
        infeasible, feasible, justified_by = search.descend(top)
    if feasible <= search.lowest:
        limited_by, pair, head_radius = LimitedBy.START, None, None
        islands: tuple[tuple[float, float], ...] = ()
    else:
        limited_by, pair, head_radius = search.limit(infeasible)
        islands = search.islands(infeasible)
    return MinimumPitch(
        feasible,
        (infeasible, feasible),
        limited_by,
        pair,
        head_radius,
        islands,
        justified_by,
        max(proven_up_to, search.lowest),
        search.scan_step,
        search.ways + search.strips.marches,
    )
