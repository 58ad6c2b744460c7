"""How tight may the curve be: minimum_pitch()."""

from __future__ import annotations

import math
from dataclasses import dataclass
from enum import StrEnum

import numpy as np

from core import kernels
from core.dragon import SIZE_MIN, Dragon, checked_number, checked_size
from core.errors import InvalidValue
from core.kinematics import end_theta
from core.paths import START_TURNS_MAX, Spiral
from core.search import MARGIN_MAX, NO_PIECES, Search

# Half width of the bracket around a contact [m of head travel].
CONTACT_WIDTH = 2e-11
# The descent ends when the clearance left above the margin is below this [m]; a bisection closes the bracket.
GAIN_MIN = 2e-10
# The pitch is bisected to this width [m]; rounding of a clearance is near 1e-14 m.
PITCH_WIDTH = 2e-13
# Where no bound on the change of a clearance with the pitch is at hand, so many pitches are tried, evenly spaced.
SCAN_SAMPLES = 1000
# Islands below the minimum pitch are looked for at so many pitches, evenly spaced.
ISLAND_SAMPLES = 400
# A contact this close to the circle or the start, with the pair still approaching, is on it [m of head travel].
ON_CIRCLE = 1e-4
# From the instant found just below the minimum pitch, the bottom of the graze is within this [m of head travel].
BOTTOM_WITHIN = 0.01


# The descent begins with this clearance above the margin [m]; the windows narrow when it has fallen by this factor [1].
GAIN_FIRST = 0.02
GAIN_FACTOR = 0.25
# The far side of a window of little clearance is looked for in steps of this at the first gain [m of head radius].
WINDOW_STEP = 2e-3

# Head radii from an inner to an outer one [m].
Window = tuple[float, float]
ALL: Window = (0.0, math.inf)


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
    evaluations: ways from the start to the circle that were marched
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


# Change of a clearance with the growth b, at a fixed head radius r_0, in the frame in which the head stands at angle 0:
# handle k stands at radius rho_k = r_0 + b psi_k and angle psi_k. With f = b^2 delta^2 + 2 rho (rho + b delta) (1 -
# cos delta),
#     a_{k+1} = a_k (1 - b f_rho / f_delta) + 2 rho (rho + b delta) delta sin delta / f_delta,   a = d rho / db,
#     d delta / db = -(f_rho a_k + f_b) / f_delta <= 0.
# 1 - b f_rho / f_delta is the rate of a link, in [0, 1] while no handle turns back, and the last term is in [0,
# delta], so 0 <= a_k <= psi_k: radii grow and angles fall with b. With f_delta >= 2 rho (rho + b delta) sin delta,
#     f_rho / f_delta <= (2 / rho) tan(delta / 2),  f_b / f_delta <= (delta / rho) tan(delta / 2) + b delta^2 /
# (rho^2 sin delta),
# and as sum(delta_l psi_l + delta_l^2 / 2) = psi^2 / 2, with t = tan(delta / 2) / (delta / 2) for the largest delta,
#     |d psi_k / db| <= t psi_k^2 / (2 r_0) + (b / r_0^2) (delta / sin delta) psi_k.
# A point of a bench moves at most 1 + (2 o + w) / c times its handles. Only benches inside the leaders' reach count,
# and radii grow with b, so the reach at the largest b and the angles at the smallest b serve; all falls with r_0.


def _sensitivity(search: Search, radius: float, low: float, high: float) -> float:
    """Bound on |d separation / d pitch| at every head radius >= radius, pitches in [low, high].

    Dimensionless; inf where no bound holds.
    """
    chord, shortest, overhang, half_width, *_ = (float(extreme) for extreme in search.extremes)
    b_low, b_high = low / (2.0 * math.pi), high / (2.0 * math.pi)
    curvature = max(kernels.spiral_curvature(radius / b) / b for b in (b_low, b_high))
    if 0.5 * curvature * chord > 0.97:
        return math.inf
    delta = 2.0 * math.asin(0.5 * chord / radius)
    leaders = search.dragon.uniform_from + 1
    rear = radius + b_high * (leaders + 1) * delta
    reach = kernels.leaders_reach(b_high, radius, rear, search.ring) + search.margin
    reach = kernels.radius_beyond(b_high, reach, search.ring)

    def moved(psi: float) -> float:
        angle = math.tan(0.5 * delta) / delta * psi * psi / radius
        angle += b_high / radius**2 * delta / math.sin(delta) * psi
        return math.hypot(psi, (reach + b_high * delta) * angle)

    share = 1.0 + 2.0 * (overhang + half_width) / shortest
    return share * (moved((reach - radius) / b_low + delta) + moved((leaders + 1) * delta)) / (2.0 * math.pi)


class _PitchSearch:
    """Ways from the start to the circle for one dragon: which pitches are free of contact."""

    def __init__(self, dragon: Dragon, radius: float, start_turns: float, margin: float) -> None:
        self.radius, self.start_turns, self.margin = radius, start_turns, margin
        self.lowest = radius / start_turns
        self.search = Search(dragon, Spiral(max(self.lowest, SIZE_MIN), start_turns), margin)
        self.evaluations = 0
        self.scan_step: float | None = None

    def way(
        self, pitch: float, extra: float = 0.0, window: Window = ALL, width: float = 0.0
    ) -> tuple[str, dict[str, float]]:
        """March from the start to the circle, or through a window: 'reached' proves clearances > margin + extra [m].

        width: half width of the bracket around a contact, 0 if any instant of it will do [m of travel]
        """
        search = self.search
        path = Spiral(pitch, self.start_turns)
        search.use(path, self.margin + extra)
        self.evaluations += 1
        inner, outer = window
        if window is ALL and end_theta(search.dragon, path)[0] > self.radius / path.growth:
            return "folded", dict.fromkeys(kernels.MARCH_FIELDS, 0.0)
        inside = outer < path.growth * path.start_theta
        start = search.travel_at(outer / path.growth) if inside else 0.0
        stop = search.travel_at(max(inner, self.radius) / path.growth)
        return search.march(max(stop, 0.0), width, start=start, opening=not inside)

    def weak_windows(self, pitch: float, gain: float, windows: list[Window]) -> list[Window]:
        """Parts of the windows outside which every clearance is proven to exceed margin + gain [m of head radius]."""
        weak = []
        leaders = self.search.dragon.uniform_from + 1
        for inner, outer in windows:
            while outer > inner:
                state, found = self.way(pitch, gain, (inner, outer))
                if state == "reached":
                    break
                search, growth = self.search, self.search.growth
                step = WINDOW_STEP * math.sqrt(gain / GAIN_FIRST)
                begin = search.theta_at(found["proven"]) * growth
                outer = search.theta_at(max(found["touching"], found["proven"])) * growth
                while outer > inner:
                    outer = max(inner, outer - step)
                    travel = search.travel_at(outer / growth)
                    if outer > self.radius and search.clearance(travel, leaders)[0] > self.margin + 2 * gain:
                        break
                weak.append((outer, begin))
        return weak

    def is_clear(self, pitch: float) -> bool:
        """Is the whole way proven free of contact?"""
        return self.way(pitch)[0] == "reached"

    def top(self) -> tuple[float, float]:
        """A feasible pitch to descend from, and up to which every larger one is feasible by the ring bound [m].

        The ring bound holds for growths up to those of its derivation, so a pitch beyond is not asked about; where it
        clears nothing (a circle hardly wider than a bench is long), the two are the same pitch, cleared by a march
        and no larger than the circle's radius.
        """
        chord, shortest, *_ = (float(extreme) for extreme in self.search.extremes)
        foot2 = self.radius**2 - 0.25 * chord**2
        limits = [shortest / 1.67, self.radius**2 / (1.5708 * chord)] + (
            [0.5 * math.sqrt(foot2)] if foot2 > 0.0 else []
        )
        growths = [0.999 * min(limits) * 0.95**k for k in range(200)]
        for growth in growths:
            if self._ring_clears(0.95 * growth, growth):
                low = growth
                for factor in (0.95, 0.99):
                    while self._ring_clears(factor * low, low):
                        low *= factor
                return 2.0 * math.pi * low, 2.0 * math.pi * growth
        for growth in growths:
            if max(self.lowest, SIZE_MIN) < 2.0 * math.pi * growth < self.radius and self.is_clear(
                2.0 * math.pi * growth
            ):
                return (2.0 * math.pi * growth,) * 2
        return (self.lowest,) * 2

    def _ring_clears(self, low: float, high: float) -> bool:
        """Does the ring bound clear the circle and all outside it for all growths in [low, high]?"""
        return float(kernels.ring_least(low, high, self.radius, *self.search.extremes)) > self.margin

    def next_below(self, pitch: float, gain: float) -> float:
        """A pitch down to which all are feasible, given a clearance of margin + gain all the way at `pitch` [m]."""
        search = self.search
        if search.dragon.uniform_from > 1:
            return pitch
        search.margin = self.margin + gain
        below = pitch
        for low in (0.9 * pitch, 0.99 * pitch, 0.999 * pitch):
            carried = pitch - gain / _sensitivity(search, self.radius, low, pitch)
            below = carried if carried >= low else below
        search.use(Spiral(below, self.start_turns), self.margin)
        # the body repeats in place only what its first bench met after the start
        return below if search.clear_radius < below * self.start_turns else pitch

    def descend(self, top: float) -> tuple[float, float, str]:
        """From a feasible pitch down to (infeasible, feasible), close together, and how the way down is justified [m].

        A proven clearance of margin + gain carries down to next_below(gain). Whenever the gain has fallen to
        GAIN_FACTOR of what it was, the parts of the way with a clearance that large that it would carry further down
        than the answer is likely to be (the floor) are left out until then, so that only narrow windows remain.
        """
        pitch, gain = top, GAIN_FIRST
        windows, floor, narrowed = [ALL], -math.inf, gain
        pace = 2.0
        while gain > GAIN_MIN:
            below = self.next_below(pitch, gain)
            if below >= pitch:
                return *self.scan(pitch), "scan"
            if not all(self.way(pitch, gain, window)[0] == "reached" for window in windows):
                gain, pace = 0.6 * gain, 1.1
                if gain < GAIN_FACTOR * narrowed:
                    wide = 4.0 * gain * gain / (pitch - below)
                    windows, narrowed = self.weak_windows(pitch, wide, windows), gain
                    floor = max(floor, self.next_below(pitch, wide))
                continue
            pitch, gain = max(below, floor), pace * gain
            if pitch <= self.lowest:
                return self.lowest, self.lowest, "bound"
            if pitch <= floor:
                windows, floor, narrowed = [ALL], -math.inf, gain
        return *self.infeasible_below(pitch), "bound"

    def scan(self, pitch: float) -> tuple[float, float]:
        """(infeasible, feasible) by trying SCAN_SAMPLES pitches down to the lowest, then by bisection [m]."""
        self.scan_step = (pitch - self.lowest) / SCAN_SAMPLES
        for k in range(1, SCAN_SAMPLES + 1):
            below = pitch - self.scan_step if k < SCAN_SAMPLES else self.lowest
            if not self.is_clear(below):
                return self.bisect(below, pitch)
            pitch = below
        return self.lowest, self.lowest

    def infeasible_below(self, pitch: float) -> tuple[float, float]:
        """(infeasible, feasible) around the border just below a pitch with less than GAIN_MIN above the margin.

        On these last steps of 4 GAIN_MIN and more [m] the ways are proven at each pitch tried, not in between: an
        infeasible strip narrower than such a step would be passed over, an error below 1e-9 m.
        """
        step = 4.0 * GAIN_MIN
        while pitch - step > self.lowest and self.is_clear(pitch - step):
            pitch, step = pitch - step, 2.0 * step
        return self.bisect(max(pitch - step, self.lowest), pitch)

    def bisect(self, infeasible: float, feasible: float) -> tuple[float, float]:
        """The same with a bracket of PITCH_WIDTH [m]."""
        while feasible - infeasible > PITCH_WIDTH:
            middle = 0.5 * (infeasible + feasible)
            state, found = self.way(middle)
            if state == "stuck" and found["touching"] < 0.0:
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
        state, found = self.way(infeasible, width=CONTACT_WIDTH)
        search, growth = self.search, self.search.growth
        stop = search.travel_at(self.radius / growth)
        pair = (int(found["first"]), int(found["second"]))
        travel = found["touching"] - (CONTACT_WIDTH if state == "touched" else 0.0)
        if state == "touched_at_start":
            return LimitedBy.START, pair, growth * 2.0 * math.pi * self.start_turns
        if state == "folded":
            return LimitedBy.START, None, None
        end = min(travel + BOTTOM_WITHIN, stop)
        if stop - travel < ON_CIRCLE and search.gap_rate(end, pair) < 0.0:
            return LimitedBy.CIRCLE, pair, self.radius
        return LimitedBy.GRAZE, pair, growth * search.theta_at(search.bottom(travel, end, pair, 1e-12))


def minimum_pitch(
    dragon: Dragon, *, turning_radius: float = 4.5, start_turns: float = 16.0, margin: float = 0.0
) -> MinimumPitch:
    """The smallest pitch such that every larger one lets the head reach the turning circle without contact.

    turning_radius: [m]; start_turns: turns from the centre to the start; margin: [m], clearance required
    The least clearance on the way, as a function of the pitch, is brought down to the margin: from a pitch at which the
    ring bound of `core/kernels.py` clears everything, each proven clearance clears all pitches within clearance /
    sensitivity below it, so no feasible-looking gap is stepped over. Where that sensitivity has no bound (handles that
    turn back, bench-by-bench dragons, a start inside the region where benches can touch) a stated scan takes its place.
    raises: InvalidValue; also when the dragon cannot reach the circle at any pitch
    source: the model of Yang et al., section 2.5; their bisection of the contact radius cannot converge, because that
        radius jumps over the circle

    >>> round(minimum_pitch(Dragon()).pitch, 9)
    0.450337393
    """
    radius = checked_size("turning_radius", turning_radius)
    turns = checked_number("start_turns", start_turns, "turns", 0.0, START_TURNS_MAX, open_low=True)
    margin = checked_number("margin", margin, "m", 0.0, MARGIN_MAX)
    search = _PitchSearch(dragon, radius, turns, margin)
    top, proven_up_to = search.top()
    if max(top, search.lowest) < SIZE_MIN:
        raise InvalidValue(
            "turning_radius", f"turning_radius must allow pitches of {SIZE_MIN:g} m and more, got {radius:g} m"
        )
    if not search.is_clear(max(top, search.lowest)):
        raise InvalidValue(
            "turning_radius",
            f"turning_radius must be larger for this dragon: at no pitch tried can it dance down to {radius:g} m",
        )
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
        search.evaluations,
    )
