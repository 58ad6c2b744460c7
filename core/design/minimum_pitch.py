"""Minimum pitch: the tightest spiral that leads to the turning circle."""

from __future__ import annotations

import math
from dataclasses import dataclass
from enum import StrEnum

import numpy as np

from core.contact.march import TOUCHES
from core.contact.search import MARGIN_MAX, ContactSearch
from core.design.pitch_bands import BORDER_WIDTH, Descent
from core.design.straight import Straight, too_near
from core.design.ways import CONTACT_WIDTH, Ways
from core.display import Readable, display
from core.dragon import Dragon, Stray, checked_stray
from core.errors import SIZE_MAX, InvalidValue, Quantity, checked_number, checked_size, quantities, question_about
from core.kernels import Budget, Ended, Halted
from core.paths.spiral import START_TURNS_MAX, Spiral, end_theta
from core.sampling import bisect

# Distance below the proven bands at which an infeasible pitch is tried: the largest error of the answer [m of pitch].
PASSED_OVER = 1e-9
# The same, relative to the pitch [1], on spirals so wide that a clearance hardly changes with the pitch; it is also the
# width of the bracket there.
PASSED_OVER_WIDE = 1e-6
# Final width of the bisection [m]: closer to a graze or a contact on the circle, rounding hides which one it is.
PITCH_WIDTH = 2.0 * BORDER_WIDTH
# Number of undecided pitches that end a bisection.
UNDECIDED_MAX = 4
# Number of pitches in a scan, which is used if no bound on the change of a clearance with the pitch is known.
SCAN_SAMPLES = 1000
# Number of evenly spaced pitches in the search for islands below the minimum pitch.
ISLAND_SAMPLES = 400
# Relative precision of the least growth for which a bound clears that spiral and every wider one [1].
TOP_WIDTH = 0.02
# Lower end over upper end of the ranges of growths, below that growth, to which the bounds are applied [1].
RANGES = (0.95, 0.99, 0.998)
# Distance below the minimum pitch [m] at which its limit is examined, where a graze has become a longer contact.
BELOW = 1e-11
# A contact this close to the circle or the start, with the pair still approaching, counts as on it [m of head travel].
ON_CIRCLE = 1e-4
# Largest head travel between the contact found just below the minimum pitch and the bottom of the graze [m].
BOTTOM_WITHIN = 0.01


class LimitedBy(StrEnum):
    """Reason against a smaller pitch."""

    GRAZE = "graze"
    CIRCLE = "circle"
    START = "start"
    FOLD = "fold"


class JustifiedBy(StrEnum):
    """Evidence for every larger pitch. BOUND: all are proven; SCAN: below a pitch only single ones are proven."""

    BOUND = "bound"
    SCAN = "scan"


@dataclass(frozen=True, slots=True, repr=False)
class MinimumPitch(Readable):
    """The smallest pitch such that every larger one is free of contact down to the turning circle.

    pitch: [m]; pitch_bracket: (infeasible, feasible) [m], with equal ends if the start is the limit without a contact;
        pitches in between are undecided: more than 1e-9 m on wide spirals, or where a fold disappears on the way
    limited_by: a graze on the way; contact exactly on the circle; the start, where the dance would touch or, without a
        contact, begin inside the circle; or the fold: a bench could not follow the head as far as the circle
    benches: the pair that touches just below; bench: the one that folds there; head_radius: of the head then [m], at a
        fold that of the circle
    other_feasible_intervals: [m], islands below pitch, found on a grid of ISLAND_SAMPLES pitches
    justified_by: evidence for every larger pitch; with a scan, below proven_from only single ones are proven, at most
        scan_step [m] apart, and a narrower range of infeasible ones is not excluded there
    proven_from, proven_up_to: every pitch in between is proven feasible [m]; the first is `pitch` without a scan, the
        second is None for every larger pitch
    scan_step: of this scan for feasible pitches, None without one; a PitchScan samples the radius of first contact
    evaluations: number of ways marched from the start to the circle, plus that of bands of pitches (pitch_bands.py)
    """

    pitch: float
    pitch_bracket: tuple[float, float]
    limited_by: LimitedBy
    benches: tuple[int, int] | None
    bench: int | None
    head_radius: float | None
    other_feasible_intervals: tuple[tuple[float, float], ...]
    justified_by: JustifiedBy
    proven_from: float
    proven_up_to: float | None
    scan_step: float | None
    evaluations: int

    def _line(self) -> str:
        whose = f" of benches {self.benches[0]} and {self.benches[1]}" if self.benches else ""
        if self.bench is not None:
            whose = f" of bench {self.bench}"
        limit = f"{display(self.pitch, 'm')}, limited by {self.limited_by.value}{whose}"
        scan = f"scanned every {display(self.scan_step, 'm')} up to {display(self.proven_from, 'm')}, then "
        most = "for every larger pitch" if self.proven_up_to is None else f"up to {display(self.proven_up_to, 'm')}"
        return f"{limit}; {scan if self.scan_step else ''}proven {most}"


# A single bench: if one growth is feasible, every larger one is too, so a bisection finds the minimum. With the head at
# a radius rho, f = b^2 delta^2 + 2 rho (rho + b delta) (1 - cos delta) has a root f = c^2 before its first maximum
# (spiral.py) or none. At a fixed rho and delta f grows with b. Its first maximum does not come nearer: in units of b,
# with theta = rho / b, it is the first zero of h = delta + theta (1 - cos delta) + theta (theta + delta) sin delta, and
# where h = 0
#     theta (theta + delta) dh / d theta = -theta^2 (1 - cos delta) - delta (2 theta + delta) < 0,
# so once h is 0, it is negative for all larger theta. If h > 0 on (0, delta), this also holds for all smaller theta,
# that is all larger b. So the root stays as b grows, at every radius from the circle outwards.


class _PitchSearch:
    """Search for the feasible pitches, whose ways are free of contact, from the widest spiral down.

    scanned_from, scan_step: pitch below which single pitches were tried, and step between them [m]; None without a scan
    """

    def __init__(self, ways: Ways) -> None:
        self.ways, self.search, self.bands, self.lowest = ways, ways.search, ways.bands, ways.lowest
        self.radius, self.start_turns, self.margin = ways.radius, ways.start_turns, ways.margin
        self.is_clear = ways.is_clear
        self.alone = ways.search.dragon.benches == 1
        self.scanned_from: float | None = None
        self.scan_step: float | None = None

    def top(self) -> tuple[float, float | None]:
        """A feasible pitch for the descent, and the upper end of the feasible pitches above it [m]; None: no upper end.

        The bound of `core/design/straight.py` gives the least growth for which it clears that growth and every larger
        one. Below it, this bound and the ring bound are applied to ranges of growths.
        raises: InvalidValue if that growth is beyond the largest allowed pitch, and that pitch is infeasible
        """
        lowest, growth = self.lowest / math.tau, SIZE_MAX / math.tau

        def clears(wide: float) -> bool:
            return self.bands.straight.clears(wide, self.radius, self.margin)

        if not clears(growth):
            if not self.is_clear(SIZE_MAX):
                state, result = self.ways.march(SIZE_MAX)
                if state in TOUCHES and result.benches[1] - result.benches[0] == 2:
                    raise _too_near(self.search, result.benches[0], self.margin)
                rule = "must be larger: no pitch up to {most} lets this dragon reach the circle"
                values = quantities("m", got=self.radius) | quantities("m", 6, most=SIZE_MAX)
                raise InvalidValue("turning_radius", rule, **values)
            return SIZE_MAX, SIZE_MAX
        _, growth = bisect(clears, 0.5 * lowest, growth, relative=TOP_WIDTH, middle=lambda a, b: math.sqrt(a * b))
        for factor in RANGES:
            while growth > lowest and self.bands.clears(factor * growth, growth, self.radius):
                growth *= factor
        return math.tau * max(growth, lowest), None

    def descend(self, top: float) -> tuple[float, float, JustifiedBy]:
        """A narrow bracket (infeasible, feasible) below a feasible pitch [m], and the evidence for those above."""
        if self.alone:
            pitch = self.lowest if self.is_clear(self.lowest) else top
            return *((pitch, pitch) if pitch < top else self.bisect(self.lowest, top)), JustifiedBy.BOUND
        pitch, stopped = self.bands.descend(top, self.lowest)
        if stopped is Descent.LOWEST:
            return pitch, pitch, JustifiedBy.BOUND
        if stopped in (Descent.BORDER, Descent.STUCK):
            step = max(PITCH_WIDTH, 2.0 * math.ulp(pitch))
            while step <= max(PASSED_OVER, PASSED_OVER_WIDE * pitch) and pitch - step > self.lowest:
                if self.ways.grazes(pitch - step) or self.is_clear(pitch - step) is False:
                    # single pitches below the bands may be clear too, but the pitches in between are not all proven
                    below = self.bisect(pitch - step, pitch)[0] if step <= PASSED_OVER else pitch - step
                    return below, pitch, JustifiedBy.BOUND
                step *= 2.0
        # bands are proven for ways from any distance; the actual way may begin inside the contact that ends them
        return *self.scan(pitch), JustifiedBy.SCAN

    def scan(self, pitch: float) -> tuple[float, float]:
        """(infeasible, feasible) from SCAN_SAMPLES pitches down to the lowest, then by bisection [m].

        Each pitch is smaller than the one before by the same factor, so they are denser at the lower end.
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
        """The bracket narrowed to PITCH_WIDTH [m]; it stays wider by pitches that can be neither proven nor refuted."""
        refuted, left = infeasible, UNDECIDED_MAX

        def is_feasible(pitch: float, undecided: bool) -> bool | None:
            """True if a pitch is feasible; `undecided` if that is not known; None after too many unknown ones."""
            nonlocal refuted, left
            if not left:
                return None
            clear = self.is_clear(pitch)
            left -= clear is None
            refuted = pitch if clear is False else refuted
            return undecided if clear is None else clear

        below, feasible = bisect(lambda pitch: is_feasible(pitch, False), infeasible, feasible, width=PITCH_WIDTH)
        infeasible, _ = bisect(lambda pitch: is_feasible(pitch, True), refuted, below, width=PITCH_WIDTH)
        return infeasible, feasible

    def islands(self, pitch: float) -> tuple[tuple[float, float], ...]:
        """Feasible intervals between the lowest pitch and an infeasible one, to the resolution of the grid [m]."""
        grid = np.linspace(pitch, self.lowest, ISLAND_SAMPLES).tolist()
        intervals: list[tuple[float, float]] = []
        touching: tuple[float, int, int] | None = None
        end = 0.0
        for k, sample in enumerate(grid):
            feasible = False
            if touching is None or not self.ways.still_touches(sample, *touching):
                state, result = self.ways.march(sample)
                feasible = state is Ended.REACHED
                touching = None
                if state not in (Ended.REACHED, Ended.BENCH_FOLDED) and result.touching is not None:
                    radius = self.search.theta_at(result.touching) * self.search.growth
                    touching = (radius, *result.benches)
            if feasible and not end:
                end, _ = bisect(lambda pitch: not self.is_clear(pitch), sample, grid[k - 1], width=PITCH_WIDTH)
            elif end and not feasible:
                intervals.insert(0, (self.bisect(sample, grid[k - 1])[1], end))
                end = 0.0
        return ((self.lowest, end), *intervals) if end else tuple(intervals)

    def limit(self, infeasible: float) -> tuple[LimitedBy, tuple[int, int] | None, float | None]:
        """Limit of the minimum pitch, the pair that meets just below it, and the radius of the head there [m]."""
        graze = self.bands.graze
        if self.scan_step is None and graze and graze[1] < infeasible * self.start_turns:
            self.search.use(Spiral(infeasible, self.start_turns), self.margin)
            travel = self.search.travel_at(graze[1] / self.search.growth)
            return self._met(travel, travel, graze[0])
        below = BELOW
        state, result = self.ways.march(infeasible - below, width=CONTACT_WIDTH)
        # on a wide spiral rounding hides a contact at so small a distance below
        while state is Ended.STUCK and result.touching is None and below < PASSED_OVER_WIDE * infeasible:
            below *= 10.0
            state, result = self.ways.march(infeasible - below, width=CONTACT_WIDTH)
        if state is Ended.REACHED:
            state, result = self.ways.march(infeasible, width=CONTACT_WIDTH)
        if state is Ended.STUCK and result.touching is None:  # but a contact at an end of the way is never hidden
            state, result = self.ways.march(infeasible)
        if state is Ended.TOUCHED_AT_START:
            return LimitedBy.START, result.benches, self.search.growth * 2.0 * math.pi * self.start_turns
        if state is Ended.BENCH_FOLDED:
            return LimitedBy.FOLD, None, self.radius
        if result.touching is None:
            raise Halted(self.search.budget)  # rounding hides whether any pitch below is feasible
        travel = result.touching - (CONTACT_WIDTH if state is Ended.TOUCHED else 0.0)
        return self._met(travel, travel + BOTTOM_WITHIN, result.benches)

    def _met(self, travel: float, end: float, pair: tuple[int, int]) -> tuple[LimitedBy, tuple[int, int], float]:
        """Limit of a pair that meets after a travel: contact on the circle, or a graze at its dip before `end` [m]."""
        search, growth = self.search, self.search.growth
        end = min(end, stop := search.travel_at(self.radius / growth))
        if stop - travel < ON_CIRCLE and search.gap_rate(end, pair) < 0.0:
            return LimitedBy.CIRCLE, pair, self.radius
        return LimitedBy.GRAZE, pair, growth * search.theta_at(search.bottom(travel, end, pair, 1e-12))


@question_about("dragon", Dragon)
def minimum_pitch(
    dragon: Dragon,
    *,
    turning_radius: float = 4.5,
    start_turns: float = 16.0,
    margin: float = 0.0,
    stray: float | Stray = 0.0,
    budget: Budget | None = None,
) -> MinimumPitch:
    """The smallest pitch such that every larger one lets the head reach the turning circle without contact.

    turning_radius: [m]; start_turns: turns from the centre to the start; margin: [m], clearance required
    stray: largest distance of every hole from its place [m]; at the answer no benches can touch with such strays
    budget: default: PITCH_WORK
    Every pitch above a certain one is feasible, because the dragon is nearly straight on such a wide spiral
    (`core/design/straight.py`). Below it bands of pitches are proven clear, each for all its pitches at once
    (`core/design/pitch_bands.py`), down to a graze of two benches, so no infeasible pitch is missed. A scan, stated in
    the answer, replaces the bands if they have no bound: if benches are so long that handles move backwards on the way,
    or if the start lies inside the region where benches can touch while ways from further out do touch.
    raises: InvalidValue, also if benches touch on a straight line, so that no pitch is large enough; TooMuchWork
    source: the model of Yang et al., section 2.5; their bisection of the contact radius cannot converge, because that
        radius jumps over the circle

    >>> round(minimum_pitch(Dragon()).pitch, 9)
    0.450337393
    """
    radius = checked_size("turning_radius", turning_radius)
    turns = checked_number("start_turns", start_turns, "turns", 0.0, START_TURNS_MAX, open_low=True)
    if radius > SIZE_MAX * turns:
        rule = "must be at least {least} to start outside the circle at a pitch of {pitch}"
        limits = quantities("turns", 6, least=radius / SIZE_MAX) | quantities("m", 6, pitch=SIZE_MAX)
        raise InvalidValue("start_turns", rule, got=Quantity(turns, "turns"), **limits)
    margin = checked_number("margin", margin, "m", 0.0, MARGIN_MAX)
    ways = Ways(dragon, radius, turns, margin, checked_stray(stray, dragon), budget)
    straight = Straight(ways.search.dragon)
    if straight.gap <= margin:
        raise _too_near(ways.search, straight.at, margin)
    try:
        return _result(dragon, _PitchSearch(ways))
    except Halted as halted:
        raise ways.too_much() from halted


def _too_near(search: ContactSearch, a: int, margin: float) -> InvalidValue:
    """The error for benches a and a + 2 that no pitch keeps apart; it names the stray if that is the only cause."""
    straight = Straight(search.nominal)
    if straight.gap <= margin:
        return too_near(search.nominal, straight.at, margin)
    if not search.stray:
        return too_near(search.dragon, a, margin)
    near = "come within {margin}" if margin else "touch"
    why = f"on a straight line, and so on every wide enough spiral, benches {{a}} and {{b}} may then {near}"
    values = quantities("m", got=search.stray, margin=margin)
    return InvalidValue("stray", f"must be smaller: {why}", a=a, b=a + 2, **values)


def _result(dragon: Dragon, search: _PitchSearch) -> MinimumPitch:
    """The result of a search."""
    top, proven_up_to = search.top()
    infeasible, feasible, justified_by = search.lowest, search.lowest, JustifiedBy.BOUND
    if top > search.lowest:
        infeasible, feasible, justified_by = search.descend(top)
    is_limited = feasible > search.lowest
    limited_by, pair, head_radius = search.limit(infeasible) if is_limited else (LimitedBy.START, None, None)
    return MinimumPitch(
        pitch=feasible,
        pitch_bracket=(infeasible, feasible),
        limited_by=limited_by,
        benches=pair,
        bench=end_theta(dragon, Spiral(infeasible, search.start_turns))[1] if limited_by is LimitedBy.FOLD else None,
        head_radius=head_radius,
        other_feasible_intervals=search.islands(infeasible) if is_limited and not search.alone else (),
        justified_by=justified_by,
        proven_from=search.scanned_from or feasible,
        proven_up_to=proven_up_to,
        scan_step=search.scan_step,
        evaluations=search.ways.marched + search.bands.marches,
    )
