"""The shortest turn: how deep inside its circle the entry may lie.

Whether handles can follow is known in closed form: a bend's radius must be at least half a chord over ROUTE_BEND_LIMIT
(core/kernels/constants.py). The arcs' radii add up to S = sqrt(E^2 + growth^2) for the entry radius E (see turn()), so
both shrink with E, and so does the coil's at the entry: the bend sets one least entry.

Whether benches touch is tried entry by entry, from the circle down. On the coil before the entry first_contact() on the
spiral answers. From the entry on it answers on the route, but only until the leading benches are out of reach, below;
whatever follows them then repeats, in place, what they met (core/contact.py), so nothing touches later either, however
long the coils.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from enum import StrEnum

import numpy as np

from core import kernels
from core.contact import FirstContact, Outcome, first_contact
from core.dragon import Dragon, checked_number, checked_size, checked_type
from core.errors import InvalidValue
from core.kinematics import follows
from core.paths import Spiral
from core.search import MARGIN_MAX
from core.turn import Turn, turn

# Entry radii are tried in steps of this part of the turning radius [1], down to one step from the centre ...
ENTRY_STEP = 0.01
# ... and the border is bisected to this width [m].
ENTRY_WIDTH = 1e-9
# turn() takes no deeper entry [m].
ENTRY_MIN = 1e-3
# Where the rings are clear is looked for in radii that grow by this factor [1], up to this one [m].
RADIUS_FACTOR = 1.1
RADIUS_MAX = 1e4
# No arc under a chord is longer by more [1].
STRETCH = 0.5 * math.pi
# Bounds must exceed the margin by this, far above their rounding [m].
CLEARLY = 1e-6
# A longer coil than needed by this part ends after the instant asked for also in rounding [1].
SPARE_TURNS = 1e-9

# The pair and the time [s] of a first contact; None where the search is undecided.
Touch = tuple[tuple[int, int] | None, float | None]


class TurnLimit(StrEnum):
    """What keeps the entry from lying deeper: a chord cannot follow, two benches come within the margin, or nothing
    down to the deepest entry that is tried."""

    BEND = "bend"
    CONTACT = "contact"
    CENTRE = "centre"


@dataclass(frozen=True, slots=True)
class ShortestTurn:
    """The turn with the smallest entry radius such that all larger ones up to the circle can be danced.

    turn: at the feasible end of entry_bracket (infeasible, feasible) [m]; limited_by: see TurnLimit
    benches, time: the pair that comes within the margin just below, and when [s at 1 m/s, 0 at the entry]; None if none
    scan_step: entries were tried so far apart [m]: a narrower range of infeasible ones above is not excluded
    evaluations: entries tried, each proven
    """

    turn: Turn
    entry_bracket: tuple[float, float]
    limited_by: TurnLimit
    benches: tuple[int, int] | None
    time: float | None
    scan_step: float
    evaluations: int


def shortest_turn(
    dragon: Dragon,
    pitch: float,
    turning_radius: float = 4.5,
    ratio: float = 2.0,
    *,
    start_turns: float = 16.0,
    margin: float = 0.0,
) -> ShortestTurn:
    """The smallest entry radius, coming from the turning circle, at which nothing touches and every handle can follow.

    pitch, turning_radius, margin [m]; ratio: radius of the first arc over that of the second; start_turns: of the coils
    Each entry tried is proven; between them, ENTRY_STEP of the turning radius apart, this is a scan and may miss a
    narrower infeasible range.
    raises: InvalidValue (turning_radius) when even the turn at the circle cannot be danced

    >>> round(shortest_turn(Dragon(), 1.7).turn.entry_radius, 6)
    4.285762
    """
    checked_type("dragon", dragon, Dragon)
    radius = checked_size("turning_radius", turning_radius)
    margin = checked_number("margin", margin, "m", 0.0, MARGIN_MAX)

    def turned(entry: float) -> Turn:
        return turn(pitch, radius, ratio, start_turns=start_turns, entry_radius=entry)

    def touching(entry: float, clear: float | None) -> Touch | None:
        return _contact(dragon, turned(entry), start_turns, margin, clear)

    bend, floor = _bend(dragon, turned, radius)
    evaluations, limit = 1, touching(radius, None)
    if limit is not None:
        raise InvalidValue.of("turning_radius", _refusal(limit, margin), radius, "m")
    feasible = infeasible = radius
    while limit is None and infeasible > floor:
        feasible, infeasible = infeasible, max(infeasible - ENTRY_STEP * radius, floor)
        evaluations, limit = evaluations + 1, touching(infeasible, feasible)
    if limit is None:
        limited_by = TurnLimit.CENTRE if bend is None else TurnLimit.BEND
        bracket = (0.0 if bend is None else bend, floor)
        return ShortestTurn(turned(floor), bracket, limited_by, None, None, ENTRY_STEP * radius, evaluations)
    while feasible - infeasible > ENTRY_WIDTH:
        middle = 0.5 * (feasible + infeasible)
        evaluations, found = evaluations + 1, touching(middle, feasible)
        if found is None:
            feasible = middle
        else:
            infeasible, limit = middle, found if found[0] else limit
    bracket = (infeasible, feasible)
    return ShortestTurn(turned(feasible), bracket, TurnLimit.CONTACT, *limit, ENTRY_STEP * radius, evaluations)


def _bend(dragon: Dragon, turned: Callable[[float], Turn], radius: float) -> tuple[float | None, float]:
    """Entry radii between which a chord begins to follow [m]: None for the first where it follows at the deepest tried.

    raises: InvalidValue (turning_radius) when one cannot follow even at the circle
    """
    if not follows(dragon, turned(radius).path):
        bend = 1.0 / turned(radius).path.sharpest[0]
        rule = (
            f"must be larger: a turn that begins on the circle bends to a radius of {bend:.4g} m, too tight for the "
            f"longest chord ({float(dragon.chords.max()):g} m)"
        )
        raise InvalidValue.of("turning_radius", rule, radius, "m")
    low, high = min(max(ENTRY_STEP * radius, ENTRY_MIN), radius), radius
    if follows(dragon, turned(low).path):
        return None, low
    while high - low > ENTRY_WIDTH:
        middle = 0.5 * (low + high)
        low, high = (low, middle) if follows(dragon, turned(middle).path) else (middle, high)
    return low, high


def _contact(dragon: Dragon, danced: Turn, start_turns: float, margin: float, clear: float | None) -> Touch | None:
    """The first contact of a dance through the turn, time 0 at its entry; None when proven clear.

    clear: a larger radius [m] down to which the coil is known to be
    """
    coil = Spiral(danced.pitch, start_turns)
    before, start = (
        coil.length - coil.growth * float(kernels.spiral_arc(r / coil.growth)) if r else 0.0
        for r in (danced.entry_radius, clear)
    )
    if before > start:
        found = first_contact(dragon, coil, margin=margin, start=start, stop=before)
        if found.outcome is not Outcome.CLEAR:
            return _touch(found, before)
    stop, front = _way(dragon, danced, margin)
    arc = stop - danced.length - _arc(danced, 0.0)
    turns = max(start_turns, (1.0 + SPARE_TURNS) * kernels.spiral_theta(arc / coil.growth) / (2.0 * math.pi))
    entry, radius = danced.entry_radius, danced.turning_radius
    path = turn(danced.pitch, radius, danced.ratio, start_turns=turns, entry_radius=entry).path
    found = first_contact(front, path, margin=margin, stop=stop)
    return None if found.outcome is Outcome.CLEAR else _touch(found, 0.0)


def _touch(found: FirstContact, zero: float) -> Touch:
    return found.benches, None if found.time is None else found.time - zero


# Let every arc's point lie within T of the centre, |C| + r at most, and let `rings` >= T be a radius from which the
# bounds of core/kernels/rings.py hold: two benches of one coil are apart by more than the margin (ring_least()),
# and so are two of different coils. Those lie half a turn apart: polar angles on their own coils differ by pi (2 m + 1)
# + x, |x| <= pi, for points in directions that differ by x, so in place of a pitch there is half of one,
# and no bench lies beside another of its turn.
#
# A bench with a handle within `rings` has its other one on the coil not further out than pi c / 2 of arc, as no arc
# under a chord is longer, and so no point further out than that radius + o + w / 2. A bench that stands on a coil, its
# handles from r outwards, has none further in than sqrt(r^2 - c^2 / 4) - w / 2. With r such that the latter is larger
# by the margin, nothing comes near a bench that is on the coil outwards from r: the leading benches need not be
# followed further. Until then nothing on the coil inwards comes near them that is likewise beyond their outermost
# point.
def _way(dragon: Dragon, danced: Turn, margin: float) -> tuple[float, Dragon]:
    """How far the head must be followed from the entry [m], and the benches that matter until then."""
    growth, chords = danced.pitch / (2.0 * math.pi), dragon.chords
    longest, overhang, half = float(chords.max()), float(dragon.overhangs.max()), 0.5 * float(dragon.widths.max())
    whole = danced.length + STRETCH * float(chords.sum())
    rings = _clear_rings(dragon, danced, margin)
    if rings is None or STRETCH * longest >= danced.length:
        return whole, dragon

    def beyond(handle: float) -> float:
        """Arc of the coil from the entry to where benches are clear of all whose handles are within a radius [m]."""
        points = handle + overhang + half
        return _arc(danced, math.hypot(points + margin + half + CLEARLY, 0.5 * longest))

    inner = growth * kernels.spiral_theta((_arc(danced, rings) - _arc(danced, 0.0) + STRETCH * longest) / growth)
    leaders = STRETCH * float(chords[: dragon.uniform_from + 1].sum())
    out = beyond(inner) + leaders
    if danced.length + out >= whole:
        return whole, dragon
    behind = danced.length + out + beyond(growth * kernels.spiral_theta((out - _arc(danced, 0.0)) / growth))
    count = max(int(np.searchsorted(np.cumsum(chords), behind)) + 2, dragon.uniform_from + 2)
    front = Dragon.of(dragon.lengths[:count], dragon.widths[:count], dragon.overhangs[:count])
    return danced.length + out, front


def _arc(danced: Turn, radius: float) -> float:
    """Arc of the coil from the entry outwards to a radius [m]."""
    growth = danced.pitch / (2.0 * math.pi)
    return growth * float(kernels.spiral_arc(radius / growth) - kernels.spiral_arc(danced.entry_radius / growth))


def _clear_rings(dragon: Dragon, danced: Turn, margin: float) -> float | None:
    """A radius around the arcs from which coils are clear of themselves and of each other [m], None if not known."""
    growth, chords = danced.pitch / (2.0 * math.pi), dragon.chords
    longest, shortest = float(chords.max()), float(chords.min())
    overhang, half = float(dragon.overhangs.max()), 0.5 * float(dragon.widths.max())
    radius = max(math.hypot(*c) + r for c, r in zip(danced.centres, danced.radii, strict=True))
    while radius <= RADIUS_MAX:
        sizes = (longest, shortest, overhang, half, longest, half)
        if kernels.ring_least(growth, growth, radius, *sizes) > margin:
            d = math.sqrt(radius * radius - 0.25 * longest * longest)
            inner = d - half
            q = 1.0 / d + 2.0 * growth * (0.5 * longest + 1.67 * growth + overhang) / d**3
            bows = 0.5 * q * overhang * (overhang + longest) + 0.125 * q * longest * longest
            bows += 2.0 * half * math.hypot(1.0, growth / inner)
            if math.pi * growth - bows > margin * math.hypot(1.0, 0.5 * math.pi * growth / inner):
                return radius
        radius *= RADIUS_FACTOR
    return None


def _refusal(touch: Touch, margin: float) -> str:
    """What is wrong with a circle on which no turn can begin."""
    benches, time = touch
    if benches is None or time is None:
        what = f"benches come so near to the margin of {margin:g} m that it is not decided whether they keep it"
    else:
        near = f"come nearer than {margin:g} m" if margin else "touch"
        side = f"{time:.6f} s after" if time >= 0.0 else f"{-time:.6f} s before"
        what = f"benches {benches[0]} and {benches[1]} {near} {side} the entry at 1 m/s"
    return f"must be larger, or the pitch: in a turn that begins on the circle {what}"
