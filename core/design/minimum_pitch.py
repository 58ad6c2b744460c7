"""How tight may the curve be: minimum_pitch()."""

from __future__ import annotations

import math
from dataclasses import dataclass
from enum import StrEnum

import numpy as np

from core import kernels
from core.contact.search import MARGIN_MAX, THETA_ROUNDING, Budget, Marched, Search
from core.dance import EndReason, RunEnd, end_theta
from core.design.pitch_bands import BORDER_WIDTH, Strips
from core.design.straight import Straight
from core.dragon import Dragon
from core.errors import InvalidValue, TooMuchWork
from core.paths.spiral import START_TURNS_MAX, Spiral
from core.shown import Shown, worded
from core.values import SIZE_MAX, SIZE_MIN, checked_number, checked_size, checked_type

# Half width of the bracket around a contact [m of head travel].
CONTACT_WIDTH = 2e-11
# Just below what the strips prove, an infeasible pitch is looked for: an error below this [m of pitch].
PASSED_OVER = 1e-9
# On spirals so wide that a clearance hardly changes with the pitch it is looked for down to this part of it, and the
# bracket is as wide [1].
PASSED_OVER_WIDE = 1e-6
# The pitch is bisected to this width [m]; closer to a graze or a contact on the circle rounding hides which it is.
PITCH_WIDTH = 2.0 * BORDER_WIDTH
# All ways and strips together do at most so much work, see core/kernels/constants.py: about 5 s; the default
# case does about 150,000 [1].
PITCH_WORK = 4e7
# A march of one way does at most so much of it. What that leaves undecided is marched once more, in finer steps and
# with less work; so many pitches that stay undecided end a bisection [1].
WAY_WORK = 5e6
FINER_WORK = 1e6
UNDECIDED_MAX = 4
# Where no bound on the change of a clearance with the pitch is at hand, so many pitches are tried.
SCAN_SAMPLES = 1000
# Islands below the minimum pitch are looked for at so many pitches, evenly spaced.
ISLAND_SAMPLES = 400
# The growth from which on a bound clears every spiral is found this well [1].
TOP_WIDTH = 0.02
# From there the bounds are asked about such ranges of growths, as parts of the upper one, further and further down [1].
RANGES = (0.95, 0.99, 0.998)
# A way that ends this close to a fold, where handles are fast, is marched in finer steps [m of head travel].
NEAR_FOLD = 0.1
# What limits the pitch is looked at this far below it, where a graze has become a contact of some length [m of pitch].
BELOW = 1e-11
# How much nearer the bound for wide spirals must let a march begin, and in what steps it is asked how near [1].
NEARER = 0.8
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
    FOLD = "fold"


@dataclass(frozen=True, slots=True, repr=False)
class MinimumPitch(Shown):
    """The smallest pitch such that every larger one is free of contact down to the turning circle.

    pitch: [m]; pitch_bracket: (infeasible, feasible) [m], twice the same where the start limits it without benches;
        what lies in between is undecided: more than 1e-9 m on wide spirals and where a fold vanishes within the way
    limited_by: a graze on the way, contact exactly on the circle, the start: the dance would touch there, or, without
        benches, begin inside the circle; or the fold: a bench could not follow the head as far as the circle
    benches: the pair that touches just below; head_radius: of the head then [m], at a fold that of the circle
    other_feasible_intervals: [m], islands below pitch, found on a grid of ISLAND_SAMPLES pitches
    justified_by: how every larger pitch is known to be feasible: 'bound': proven for all; 'scan': below proven_from
        single ones are proven, scan_step [m] apart at most: a narrower range of infeasible ones is not excluded there
    proven_from, proven_up_to: every pitch in between is proven feasible [m]; the first is pitch itself without a scan,
        the second None for every larger pitch, without end
    scan_step: None without a scan
    evaluations: ways from the start to the circle that were marched, and strips of pitches, see
    `core/design/pitch_bands.py`
    """

    pitch: float
    pitch_bracket: tuple[float, float]
    limited_by: LimitedBy
    benches: tuple[int, int] | None
    head_radius: float | None
    other_feasible_intervals: tuple[tuple[float, float], ...]
    justified_by: str
    proven_from: float
    proven_up_to: float | None
    scan_step: float | None
    evaluations: int

    def _line(self) -> str:
        pair = f" of benches {self.benches[0]} and {self.benches[1]}" if self.benches else ""
        limit = f"{worded(self.pitch, 'm')}, limited by {self.limited_by.value}{pair}"
        scan = f"scanned every {worded(self.scan_step, 'm')} up to {worded(self.proven_from, 'm')}, then "
        most = "without end" if self.proven_up_to is None else f"up to {worded(self.proven_up_to, 'm')}"
        return f"{limit}; {scan if self.scan_step else ''}proven {most}"


# One bench alone: what is feasible at one growth is so at every larger one, so a bisection finds the minimum. With the
# head at a radius rho, f = b^2 delta^2 + 2 rho (rho + b delta) (1 - cos delta) has a root f = c^2 before its first
# crest (spiral.py) or none. At a fixed rho and delta f grows with b. Its first crest does not come nearer: in units of
# b, with theta = rho / b, it is the first zero of h = delta + theta (1 - cos delta) + theta (theta + delta) sin delta,
# and where h = 0
#     theta (theta + delta) dh / d theta = -theta^2 (1 - cos delta) - delta (2 theta + delta) < 0,
# so h, once 0, is negative for all larger theta: where h > 0 on (0, delta) it is so for all smaller theta, all larger
# b. So the root stays as b grows, at every radius from the circle outwards.


class _PitchSearch:
    """Ways from the start to the circle for one dragon: which pitches are free of contact."""

    def __init__(self, dragon: Dragon, radius: float, start_turns: float, margin: float) -> None:
        self.radius, self.start_turns, self.margin = radius, start_turns, margin
        self.lowest = max(radius / start_turns, SIZE_MIN)
        self.search = Search(dragon, Spiral(self.lowest, start_turns), margin, work=WAY_WORK, budget=Budget(PITCH_WORK))
        self.strips = Strips(self.search, radius, start_turns, margin)
        self.ways = 0
        self.alone = dragon.benches == 1
        self.scanned_from: float | None = None
        self.scan_step: float | None = None

    def way(self, pitch: float, width: float = 0.0, work: float = WAY_WORK) -> tuple[str, Marched]:
        """March from the start to the circle: 'reached' proves every clearance on the way larger than the margin.

        width: half width of the bracket around a contact, 0 if any instant of it will do [m of travel]; work: at most
        raises: TooMuchWork where all ways and strips have done PITCH_WORK
        """
        search = self.search
        if search.budget.left <= 0.0:
            raise self.too_much(pitch)
        path = Spiral(pitch, self.start_turns)
        search.use(path, self.margin)
        search.work = work
        self.ways += 1
        self.start_nearer(path)
        circle = self.radius / path.growth
        stop = max(search.travel_at(circle), 0.0)
        width = width and max(width, 2.0 * search.travel_rounding(0.0, stop))
        fold, bench = (0.0, None) if self.strips.bent_little else end_theta(search.dragon, path)
        if fold > circle * (1.0 - THETA_ROUNDING):
            return "folded" if fold > circle * (1.0 + THETA_ROUNDING) else "stuck", Marched(0.0)
        for state, travel in () if width else (("touched_at_start", 0.0), ("touched", stop)):
            # a look at both ends decides most ways that are not clear, without laying out a long dragon
            gap, pair = search.clearance(travel, min(LOOKED_AT, search.room))
            if gap <= self.margin and search.surely_within(travel, pair):
                return state, Marched(0.0, travel, pair)
        if bench is None or search.travel_at(fold) - stop > NEAR_FOLD:
            return search.march(stop, width)
        end = RunEnd(EndReason.FOLD, search.travel_at(fold), fold, bench)
        last = min(stop, search.last_travel(end.time, True))
        state, found = search.march(last, width or CONTACT_WIDTH)
        if (state == "stuck" and found.touching is None) or (state == "reached" and last < stop):
            state = "reached" if search.clear_to_fold(min(found.proven, last), end) else "stuck"
        return state, found

    def start_nearer(self, path: Spiral) -> None:
        """Let the march begin where the bound for wide spirals says that nothing touches further out.

        Only where it says so at NEARER of the radius from which the ring bound does: short benches on wide spirals.
        """
        search, clears = self.search, self.strips.straight.clears
        radius = min(search.clear_radius, path.growth * path.start_theta)
        if NEARER * radius <= self.radius or not clears(path.growth, NEARER * radius, self.margin):
            return
        while radius > self.radius and clears(path.growth, NEARER * radius, self.margin):
            radius *= NEARER
        search.clear_beyond(max(radius, self.radius))

    def too_much(self, pitch: float) -> TooMuchWork:
        """The error where the work is done before the pitch is found; pitch: the one that was to be tried next [m]."""
        dragon = self.search.dragon
        k = int(dragon.chords[: dragon.uniform_from + 1].argmin())
        alike = all((column[1:] == column[1:2]).all() for column in (dragon.lengths, dragon.widths, dragon.overhangs))
        field = f"dragon.lengths.{k}"
        if alike:
            field = "dragon.head_length" if k == 0 and dragon.uniform_from else "dragon.body_length"
        return TooMuchWork.of(
            field,
            f"must be larger, or benches fewer: their minimum pitch was not found by {PITCH_WORK:g} steps of work, "
            f"each a bench placed or a pair of benches tried; the shortest of {dragon.benches} chords is "
            f"{float(dragon.chords[k]):g} m long, the turning circle {2.0 * self.radius:g} m across, and the next "
            f"pitch to be tried was {pitch:g} m",
            float(dragon.lengths[k]),
            "m",
        )

    def is_clear(self, pitch: float) -> bool | None:
        """Is the whole way free of contact? None where neither is known, within rounding of a graze."""
        for width, work in ((0.0, WAY_WORK), (CONTACT_WIDTH, FINER_WORK)):
            state, found = self.way(pitch, width, work)
            if state != "stuck" or found.touching is not None:
                return state == "reached"
        return None

    def top(self) -> tuple[float, float | None]:
        """A feasible pitch to descend from, and up to which every larger one is feasible [m], None: without end.

        From the least growth at which the bound of `core/design/straight.py` clears that growth and every larger one,
        it and the ring bound are asked about ranges of growths further down.
        raises: InvalidValue where that is beyond
        the largest pitch allowed, and that pitch is infeasible
        """
        turn = 2.0 * math.pi
        lowest, growth = self.lowest / turn, SIZE_MAX / turn
        clears = self.strips.straight.clears
        if not clears(growth, self.radius, self.margin):
            if not self.is_clear(SIZE_MAX):
                rule = f"must be larger for this dragon, which gets to such a circle at no pitch up to {SIZE_MAX:g} m"
                raise InvalidValue.of("turning_radius", rule, self.radius, "m")
            return SIZE_MAX, SIZE_MAX
        beyond = 0.5 * lowest
        while growth > lowest and growth - beyond > TOP_WIDTH * growth:
            middle = math.sqrt(beyond * growth)
            beyond, growth = (beyond, middle) if clears(middle, self.radius, self.margin) else (middle, growth)
        for factor in RANGES:
            while growth > lowest and self.strips.clears(factor * growth, growth, self.radius):
                growth *= factor
        return turn * max(growth, lowest), None

    def descend(self, top: float) -> tuple[float, float, str]:
        """From a feasible pitch down to (infeasible, feasible) [m], close together, and what justifies the way down."""
        if self.alone:
            pitch = self.lowest if self.is_clear(self.lowest) else top
            return *((pitch, pitch) if pitch < top else self.bisect(self.lowest, top)), "bound"
        pitch, stopped = self.strips.descend(top, self.lowest)
        if stopped == "lowest":
            return pitch, pitch, "bound"
        if stopped != "unbounded":
            step = max(PITCH_WIDTH, 2.0 * math.ulp(pitch))
            while step <= max(PASSED_OVER, PASSED_OVER_WIDE * pitch) and pitch - step > self.lowest:
                if self.grazes(pitch - step) or self.is_clear(pitch - step) is False:
                    # single pitches below the strips may be clear too, but are not proven with all between
                    return self.bisect(pitch - step, pitch)[0] if step <= PASSED_OVER else pitch - step, pitch, "bound"
                step *= 2.0
        # strips are proven however far outside a way starts; this one may begin inside what stops them
        return *self.scan(pitch), "scan"

    def grazes(self, pitch: float) -> bool:
        """Is the pair whose graze ended the strips within the margin on the way, as far as its dip is followed?"""
        if not self.strips.graze:
            return False
        pair, radius = self.strips.graze
        gap, radius = self.strips.dip(pitch, radius, pair)
        if gap > self.margin or radius > pitch * self.start_turns:
            return False
        return self.search.surely_within(self.search.travel_at(radius / self.search.growth), pair)

    def scan(self, pitch: float) -> tuple[float, float]:
        """(infeasible, feasible) by trying SCAN_SAMPLES pitches down to the lowest, then by bisection [m].

        They stand closer together further down, each the same part below the one before.
        """
        factor = (self.lowest / pitch) ** (1.0 / SCAN_SAMPLES)
        self.scanned_from, self.scan_step = pitch, (1.0 - factor) * pitch
        below, left = pitch, UNDECIDED_MAX
        for k in range(1, SCAN_SAMPLES + 1):
            below = factor * below if k < SCAN_SAMPLES else self.lowest
            clear = self.is_clear(below)
            if clear is False:
                return self.bisect(below, pitch)
            if clear and left == UNDECIDED_MAX:
                pitch = below
            left -= clear is None
            if not left:
                break
        return self.lowest, pitch

    def bisect(self, infeasible: float, feasible: float) -> tuple[float, float]:
        """The same with a bracket of PITCH_WIDTH [m], wider by what can be neither proven nor refuted in between."""
        undecided, left = infeasible, UNDECIDED_MAX
        while feasible - undecided > PITCH_WIDTH and left:
            middle = 0.5 * (undecided + feasible)
            if middle in (undecided, feasible):
                break
            clear = self.is_clear(middle)
            left -= clear is None
            undecided, feasible = (undecided, middle) if clear else (middle, feasible)
            infeasible = middle if clear is False else infeasible
        while undecided - infeasible > PITCH_WIDTH and left:
            middle = 0.5 * (infeasible + undecided)
            if middle in (infeasible, undecided):
                break
            clear = self.is_clear(middle)
            left -= clear is None
            infeasible, undecided = (middle, undecided) if clear is False else (infeasible, middle)
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
                touching = None
                if state not in ("reached", "folded") and result.touching is not None:
                    radius = self.search.theta_at(result.touching) * self.search.growth
                    touching = (radius, *result.benches)
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
        curve = kernels.spiral_curve(growth)
        scene = kernels.Scene(curve, place, search.rings, search.sizes, search.dragon.benches, 0)
        return float(kernels.gap_at(scene, place, a, b, search.rows[0])) <= self.margin

    def _end_of_island(self, feasible: float, infeasible: float) -> float:
        while infeasible - feasible > PITCH_WIDTH:
            middle = 0.5 * (feasible + infeasible)
            if middle in (feasible, infeasible):
                break
            feasible, infeasible = (middle, infeasible) if self.is_clear(middle) else (feasible, middle)
        return feasible

    def limit(self, infeasible: float) -> tuple[LimitedBy, tuple[int, int] | None, float | None]:
        """What meets just below the minimum pitch, and where."""
        graze = self.strips.graze
        if self.scan_step is None and graze and graze[1] < infeasible * self.start_turns:
            self.search.use(Spiral(infeasible, self.start_turns), self.margin)
            travel = self.search.travel_at(graze[1] / self.search.growth)
            return self._met(travel, travel, graze[0])
        below = BELOW
        state, found = self.way(infeasible - below, width=CONTACT_WIDTH)
        # on a wide spiral rounding hides what meets so little below
        while state == "stuck" and found.touching is None and below < PASSED_OVER_WIDE * infeasible:
            below *= 10.0
            state, found = self.way(infeasible - below, width=CONTACT_WIDTH)
        if state == "reached":
            state, found = self.way(infeasible, width=CONTACT_WIDTH)
        pair = found.benches
        if state == "touched_at_start":
            return LimitedBy.START, pair, self.search.growth * 2.0 * math.pi * self.start_turns
        if state == "folded":
            return LimitedBy.FOLD, None, self.radius
        assert found.touching is not None
        travel = found.touching - (CONTACT_WIDTH if state == "touched" else 0.0)
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
    From some pitch on all are feasible, without end: the spiral is so wide there that the dragon stands nearly straight
    (`core/design/straight.py`). Downwards from there strips of pitches are proven clear, each for all its pitches at
    once (`core/design/pitch_bands.py`), to where a pair of benches grazes: no infeasible pitch is stepped over. Where
    strips have no bound (benches so long that handles turn back on the way, or a start inside the region where benches
    can touch while ways from further out do touch) a stated scan takes their place.
    raises: InvalidValue; also where benches touch on a straight line, so that no pitch is large enough. TooMuchWork
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
    _check_straight(dragon, Straight(dragon), margin)
    search = _PitchSearch(dragon, radius, turns, margin)
    top, proven_up_to = search.top()
    infeasible = feasible = search.lowest
    justified_by = "bound"
    if top > search.lowest:
        infeasible, feasible, justified_by = search.descend(top)
    if feasible <= search.lowest:
        limited_by, pair, head_radius = LimitedBy.START, None, None
        islands: tuple[tuple[float, float], ...] = ()
    else:
        limited_by, pair, head_radius = search.limit(infeasible)
        islands = () if search.alone else search.islands(infeasible)
    return MinimumPitch(
        feasible,
        (infeasible, feasible),
        limited_by,
        pair,
        head_radius,
        islands,
        justified_by,
        search.scanned_from or feasible,
        proven_up_to,
        search.scan_step,
        search.ways + search.strips.marches,
    )


def _check_straight(dragon: Dragon, straight: Straight, margin: float) -> None:
    """Refuse a dragon whose benches come within the margin on a straight line, and so on every wide spiral.

    raises: InvalidValue (margin or the overhang)
    """
    if straight.gap > margin:
        return
    a, b = straight.at, straight.at + 2
    chord, front, rear = dragon.chords[a + 1], dragon.overhangs[a], dragon.overhangs[b]
    why = (
        f"on a straight line, and so on every wide enough spiral, benches {a} and {b} "
        + (f"are {straight.gap:.9g} m apart" if straight.gap > 0.0 else "touch")
        + f": the chord of bench {a + 1} between them is {chord:.9g} m, their overhangs {front:.9g} m and {rear:.9g} m"
    )
    if straight.gap > 0.0:
        raise InvalidValue("margin", f"margin must be less than {straight.gap:.9g} m, got {margin:.9g} m: {why}")
    if all((column[1:] == column[1]).all() for column in (dragon.lengths, dragon.widths)) and front == rear:
        body = dragon.lengths[a + 1]
        raise InvalidValue(
            "dragon.overhang",
            f"dragon.overhang must be less than a quarter of dragon.body_length ({body:g} m / 4 = {0.25 * body:g} m), "
            f"got {front:g} m: {why}",
        )
    raise InvalidValue(
        f"dragon.overhangs.{a}",
        f"dragon.overhangs[{a}] + dragon.overhangs[{b}] must be less than the chord of bench {a + 1} ({chord:.9g} m), "
        f"got {front:.9g} m + {rear:.9g} m: {why}",
    )
