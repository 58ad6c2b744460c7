"""Search for the feasible pitches, from the widest spiral down."""

from __future__ import annotations

import math
from enum import StrEnum

import numpy as np

from core.checks import SIZE_MAX
from core.contact.brackets import TOUCHES
from core.contact.search import ContactSearch
from core.design.pitch_bands import BORDER_WIDTH, Descent
from core.design.straight import Straight, too_near
from core.design.ways import CONTACT_WIDTH, Ways
from core.errors import InvalidValue
from core.kernels import Ended, Halted
from core.paths.spiral import Spiral
from core.quantities import quantities
from core.sampling import bisect
from core.values import Interval, Pair

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
    """Reason against a smaller pitch.

    >>> from core import Dragon, minimum_pitch
    >>> minimum_pitch(Dragon()).limited_by
    <LimitedBy.GRAZE: 'graze'>
    """

    GRAZE = "graze"
    CIRCLE = "circle"
    START = "start"
    FOLD = "fold"


class JustifiedBy(StrEnum):
    """Evidence for every larger pitch. BOUND: all are proven; SCAN: below a pitch only single ones are proven.

    >>> from core import Dragon, minimum_pitch
    >>> minimum_pitch(Dragon()).justified_by
    <JustifiedBy.BOUND: 'bound'>
    """

    BOUND = "bound"
    SCAN = "scan"


# A single bench: if one growth is feasible, every larger one is too, so a bisection finds the minimum. With the head at
# a radius rho, f = b^2 delta^2 + 2 rho (rho + b delta) (1 - cos delta) has a root f = c^2 before its first maximum
# (spiral.py) or none. At a fixed rho and delta f grows with b. Its first maximum does not come nearer: in units of b,
# with theta = rho / b, it is the first zero of h = delta + theta (1 - cos delta) + theta (theta + delta) sin delta, and
# where h = 0
#     theta (theta + delta) dh / d theta = -theta^2 (1 - cos delta) - delta (2 theta + delta) < 0,
# so once h is 0, it is negative for all larger theta. If h > 0 on (0, delta), this also holds for all smaller theta,
# that is all larger b. So the root stays as b grows, at every radius from the circle outwards.


class PitchSearch:
    """Search for the feasible pitches, whose ways are free of contact, from the widest spiral down.

    scanned_from, scan_step: pitch below which single pitches were tried, and step between them [m]; None without a scan
    """

    def __init__(self, ways: Ways, lowest: float | None = None) -> None:
        """lowest: the least pitch to try, by default that of the ways [m]"""
        self.ways, self.search, self.bands = ways, ways.search, ways.bands
        self.lowest = ways.lowest if lowest is None else lowest
        self.radius, self.start_turns, self.margin = ways.radius, ways.start_turns, ways.margin
        self.is_clear = ways.is_clear
        self.alone = ways.search.dragon.benches == 1 and ways.search.copies == 1
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
                if self.search.copies > 1:
                    rule = "must be fewer: no pitch up to {most} lets so many reach a turning circle of {radius}"
                    values = quantities("m", 6, most=SIZE_MAX, radius=self.radius)
                    raise InvalidValue("dragons", rule, got=self.search.copies, **values)
                result = self.ways.march(SIZE_MAX)
                if result.ended in TOUCHES and result.pair[1] - result.pair[0] == 2:
                    raise dragon_too_near(self.search, result.pair[0], self.margin)
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

    def bisect(self, infeasible: float, feasible: float) -> Interval:
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

    def islands(self, pitch: float) -> tuple[Interval, ...]:
        """Feasible intervals between the lowest pitch and an infeasible one, to the resolution of the grid [m]."""
        grid = np.linspace(pitch, self.lowest, ISLAND_SAMPLES).tolist()
        intervals: list[tuple[float, float]] = []
        touching: tuple[float, int, int] | None = None
        end = 0.0
        for k, sample in enumerate(grid):
            feasible = False
            if touching is None or not self.ways.still_touches(sample, *touching):
                result = self.ways.march(sample)
                feasible = result.ended is Ended.REACHED
                touching = None
                if result.ended not in (Ended.REACHED, Ended.BENCH_FOLDED) and result.touching is not None:
                    radius = self.search.theta_at(result.touching) * self.search.growth
                    touching = (radius, *result.pair)
            if feasible and not end:
                end, _ = bisect(lambda pitch: not self.is_clear(pitch), sample, grid[k - 1], width=PITCH_WIDTH)
            elif end and not feasible:
                intervals.insert(0, (self.bisect(sample, grid[k - 1])[1], end))
                end = 0.0
        return ((self.lowest, end), *intervals) if end else tuple(intervals)

    def limit(self, infeasible: float) -> tuple[LimitedBy, Pair | None, float | None]:
        """Limit of the minimum pitch, the pair that meets just below it, and the radius of the head there [m]."""
        graze = self.bands.graze
        if self.scan_step is None and graze and graze[1] < infeasible * self.start_turns:
            self.search.use(Spiral(infeasible, self.start_turns), self.margin)
            travel = self.search.travel_at(graze[1] / self.search.growth)
            return self._met(travel, travel, graze[0])
        below = BELOW
        result = self.ways.march(infeasible - below, width=CONTACT_WIDTH)
        # on a wide spiral rounding hides a contact at so small a distance below
        while result.hidden and below < PASSED_OVER_WIDE * infeasible:
            below *= 10.0
            result = self.ways.march(infeasible - below, width=CONTACT_WIDTH)
        if result.ended is Ended.REACHED:
            result = self.ways.march(infeasible, width=CONTACT_WIDTH)
        if result.hidden:  # but a contact at an end of the way is never hidden
            result = self.ways.march(infeasible)
        if result.ended is Ended.TOUCHED_AT_START:
            return LimitedBy.START, result.pair, self.search.growth * 2.0 * math.pi * self.start_turns
        if result.ended is Ended.BENCH_FOLDED:
            return LimitedBy.FOLD, None, self.radius
        if result.touching is None:
            raise Halted(self.search.budget)  # rounding hides whether any pitch below is feasible
        travel = result.touching - (CONTACT_WIDTH if result.ended is Ended.TOUCHED else 0.0)
        return self._met(travel, travel + BOTTOM_WITHIN, result.pair)

    def _met(self, travel: float, end: float, pair: Pair) -> tuple[LimitedBy, Pair, float]:
        """Limit of a pair that meets after a travel: contact on the circle, or a graze at its dip before `end` [m]."""
        search, growth = self.search, self.search.growth
        end = min(end, stop := search.travel_at(self.radius / growth))
        if stop - travel < ON_CIRCLE and search.gap_rate(end, pair) < 0.0:
            return LimitedBy.CIRCLE, pair, self.radius
        return LimitedBy.GRAZE, pair, growth * search.theta_at(search.bottom(travel, end, pair, 1e-12))


def dragon_too_near(search: ContactSearch, a: int, margin: float) -> InvalidValue:
    """The error for benches a and a + 2 that no pitch keeps apart; it names the stray if that is the only cause."""
    straight = Straight(search.nominal)
    if straight.gap <= margin:
        return too_near(search.nominal, straight.at, margin)
    if not search.stray:
        return too_near(search.dragon, a, margin)
    why = "on a straight line, and so on every wide enough spiral, benches {a} and {b} may then touch"
    if margin:
        why = (
            "on a straight line, and so on every wide enough spiral, benches {a} and {b} may then come within {margin}"
        )
    values = quantities("m", got=search.stray, margin=margin)
    return InvalidValue("stray", f"must be smaller: {why}", a=a, b=a + 2, **values)
