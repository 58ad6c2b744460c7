"""The shortest turn: the deepest entry inside its circle.

A closed form says whether handles can follow: the radius of a bend must be at least half a chord over ROUTE_SINE_LIMIT
(core/kernels/constants.py). The sum of the arcs' radii is S = sqrt(E^2 + growth^2) for the entry radius E (see Turn).
Both radii shrink with E, and so does that of the coil at the entry: so there is one least entry.

Contacts are tested entry by entry, from the circle down. On the coil before the entry, first_contact() tests the
spiral. From the entry on it tests the route, but only until the leading benches are out of reach, see below. The
benches behind them repeat their meetings in the same places (core/contact/first_contact.py), so nothing touches later
either, for coils of any length.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from enum import StrEnum

import numpy as np

from core import kernels
from core.contact.answer import FirstContact, Outcome
from core.contact.coils import STRETCH, TwoCoils, beyond, free_arc
from core.contact.first_contact import contact_within
from core.contact.search import MARGIN_MAX
from core.dance import Dance
from core.dragon import Dragon, Stray, checked_stray, told_chords
from core.errors import (
    InvalidValue,
    Quantity,
    TooMuchWork,
    asked_of,
    checked_number,
    checked_size,
    quantities,
    too_much,
)
from core.kernels import Budget, Halted
from core.paths.following import follows
from core.paths.spiral import Spiral
from core.paths.turn import Turn
from core.sampling import bisected
from core.shown import Shown, worded
from core.tolerance.reach import reach

# Step between the tried entry radii, as a part of the turning radius [1]; the last one is one step from the centre,
ENTRY_STEP = 0.01
# and the border is bisected to this width [m].
ENTRY_WIDTH = 1e-9
# Largest work of all entries together [1], see core/kernels/constants.py: about 8 s, because a step on a route takes
# longer than one on a spiral. The default turn takes about 90,000.
TURN_WORK = 2.5e7
# The deepest entry that Turn accepts [m].
ENTRY_MIN = 1e-3
# Additional length of the coils, as a part of the necessary one, so that rounding cannot end them too early [1].
SPARE_TURNS = 1e-9

# The pair and the time [s] of a first contact; None if the search is undecided.
Touch = tuple[tuple[int, int] | None, float | None]
UNDECIDED: Touch = (None, None)


class TurnLimit(StrEnum):
    """Reason against a deeper entry: a chord cannot follow, two benches come within the margin, or none down to the
    deepest entry that is tried."""

    BEND = "bend"
    CONTACT = "contact"
    CENTRE = "centre"


@dataclass(frozen=True, slots=True, repr=False)
class ShortestTurn(Shown):
    """The turn with the smallest entry radius such that all larger ones up to the circle can be danced.

    turn: at the feasible end of entry_bracket (infeasible, feasible) [m]; limited_by: see TurnLimit
    benches, time: the pair that comes within the margin just below, and its time [s at 1 m/s, 0 at the entry], or None
    scan_step: distance between the tried entries [m]; a narrower range of infeasible ones above is not excluded
    evaluations: number of tried entries, each with a proof
    """

    turn: Turn
    entry_bracket: tuple[float, float]
    limited_by: TurnLimit
    benches: tuple[int, int] | None
    time: float | None
    scan_step: float
    evaluations: int

    def _line(self) -> str:
        pair = f" of benches {self.benches[0]} and {self.benches[1]}" if self.benches else ""
        entry = f"entry at a radius of {worded(self.turn.entry_radius, 'm')}, length {worded(self.turn.length, 'm')}"
        return f"{entry}, limited by {self.limited_by.value}{pair}"


@asked_of("dragon", Dragon)
def shortest_turn(
    dragon: Dragon,
    pitch: float,
    turning_radius: float = 4.5,
    ratio: float = 2.0,
    *,
    start_turns: float = 16.0,
    margin: float = 0.0,
    stray: float | Stray = 0.0,
    budget: Budget | None = None,
) -> ShortestTurn:
    """The smallest entry radius at which nothing touches and every handle can follow, searched from the circle inwards.

    pitch, turning_radius, margin [m]; stray: largest distance of every hole from its place [m]; ratio: radius of the
    first arc over that of the second; start_turns: of the coils
    Each tried entry is proven. The entries are ENTRY_STEP of the turning radius apart, so this is a scan that may miss
    a narrower infeasible range.
    entry_bracket is at most ENTRY_WIDTH wide, or wider if the budget is spent; budget: default: TURN_WORK
    raises: TooMuchWork if it is stopped, or spent before an infeasible entry was found; InvalidValue (turning_radius)
        if even the turn at the circle cannot be danced

    >>> round(shortest_turn(Dragon(), 1.7).turn.entry_radius, 6)
    4.285762
    """
    radius = checked_size("turning_radius", turning_radius)
    kept = checked_number("margin", margin, "m", 0.0, MARGIN_MAX), checked_stray(stray, dragon)

    def turn_at(entry: float) -> Turn:
        return Turn(pitch, radius, ratio, start_turns=start_turns, entry_radius=entry)

    budget = (budget or Budget()).within(TURN_WORK)

    def touching(entry: float, clear: float | None) -> Touch | None:
        try:
            return _contact(budget, dragon, turn_at(entry), start_turns, kept, clear)
        except Halted as halted:
            raise _too_much(budget, dragon, entry, radius) from halted

    def decided(entry: float, clear: float | None) -> Touch | None:
        touch = touching(entry, clear)
        if touch == UNDECIDED and budget.left <= 0.0:
            raise _too_much(budget, dragon, entry, radius)
        return touch

    border, floor = _follow_border(dragon, turn_at, radius)
    evaluations, limit = 1, decided(radius, None)
    if limit is not None:
        raise _refusal(radius, limit, *kept)
    feasible = infeasible = radius
    while limit is None and infeasible > floor:
        feasible, infeasible = infeasible, max(infeasible - ENTRY_STEP * radius, floor)
        evaluations, limit = evaluations + 1, decided(infeasible, feasible)
    if limit is None:
        limited_by = TurnLimit.CENTRE if border is None else TurnLimit.BEND
        bracket = (border or 0.0, floor)
        return ShortestTurn(turn_at(floor), bracket, limited_by, None, None, ENTRY_STEP * radius, evaluations)

    def is_clear(entry: float) -> bool | None:
        nonlocal evaluations, feasible, limit
        if budget.left <= 0.0:
            return None
        evaluations, found = evaluations + 1, touching(entry, feasible)
        if found == UNDECIDED and budget.left <= 0.0:  # undecided only because the work is spent
            return None
        if found is None:
            feasible = entry
        elif found[0]:
            limit = found
        return found is None

    bracket = bisected(is_clear, infeasible, feasible, width=ENTRY_WIDTH)
    return ShortestTurn(turn_at(bracket[1]), bracket, TurnLimit.CONTACT, *limit, ENTRY_STEP * radius, evaluations)


def _follow_border(dragon: Dragon, turn_at: Callable[[float], Turn], radius: float) -> tuple[float | None, float]:
    """Bracket of the entry radius from which chords fit the bends [m]; its lower end is None if the deepest entry fits.

    raises: InvalidValue (turning_radius) if a chord cannot follow even at the circle
    """
    if not follows(dragon, turn_at(radius)):
        bend = "a turn that begins on the circle bends to a radius of {bend}, too tight for the longest chord ({chord})"
        sharpest, chord = 1.0 / turn_at(radius).sharpest[0], float(dragon.chords.max())
        told = quantities("m", got=radius) | quantities("m", 4, bend=sharpest) | quantities("m", 6, chord=chord)
        raise InvalidValue("turning_radius", f"must be larger: {bend}", **told)
    low, high = min(max(ENTRY_STEP * radius, ENTRY_MIN), radius), radius
    if follows(dragon, turn_at(low)):
        return None, low
    return bisected(lambda entry: follows(dragon, turn_at(entry)), low, high, width=ENTRY_WIDTH)


def _contact(
    budget: Budget, dragon: Dragon, danced: Turn, start_turns: float, kept: tuple[float, float], clear: float | None
) -> Touch | None:
    """The first contact of a dance through the turn, with time 0 at its entry; None if proven clear.

    kept: margin and stray [m]; clear: a larger radius down to which the coil is known to be clear [m]
    """
    margin, stray = kept
    coil = Spiral(danced.pitch, start_turns)
    before, start = (
        coil.length - coil.growth * float(kernels.spiral_arc(r / coil.growth)) if r else 0.0
        for r in (danced.entry_radius, clear)
    )
    if before > start:
        found = contact_within(budget, Dance(dragon, coil), margin=margin, stray=stray, start=start, stop=before)
        if found.outcome is not Outcome.CLEAR:
            return _touch(found, before)
    stop, followed = way_followed(reach(dragon, stray).bounds if stray else dragon, danced, margin)
    arc = stop - danced.length - coils_of(danced).arc(0.0)
    turns = max(start_turns, (1.0 + SPARE_TURNS) * kernels.spiral_theta(arc / coil.growth) / (2.0 * math.pi))
    entry, radius = danced.entry_radius, danced.turning_radius
    path = Turn(danced.pitch, radius, danced.ratio, start_turns=turns, entry_radius=entry)
    found = contact_within(budget, Dance(dragon.leading(followed.benches), path), margin=margin, stray=stray, stop=stop)
    return None if found.outcome is Outcome.CLEAR else _touch(found, 0.0)


def _touch(found: FirstContact, zero: float) -> Touch:
    return found.benches, None if found.time is None else found.time - zero


def way_followed(dragon: Dragon, danced: Turn, margin: float) -> tuple[float, Dragon]:
    """Travel of the head from the entry that needs a search [m], and the benches that matter until then, see
    core/contact/coils.py."""
    coils, chords = coils_of(danced), dragon.chords
    whole = danced.length + STRETCH * float(chords.sum())
    out = free_arc(dragon, coils, margin)
    if out is None or danced.length + out >= whole:
        return whole, dragon
    head = coils.growth * float(kernels.spiral_theta((out - coils.arc(0.0)) / coils.growth))
    behind = danced.length + out + coils.arc(beyond(dragon, coils.growth, head, margin))
    count = max(int(np.searchsorted(np.cumsum(chords), behind)) + 2, dragon.uniform_from + 2)
    return danced.length + out, dragon.leading(count)


def coils_of(danced: Turn) -> TwoCoils:
    """The coils before and after a turn."""
    extent = max(math.hypot(*c) + r for c, r in zip(danced.centres, danced.radii, strict=True))
    return TwoCoils(danced.pitch / (2.0 * math.pi), math.pi, extent, danced.length, danced.entry_radius)


def _too_much(budget: Budget, dragon: Dragon, entry: float, radius: float) -> TooMuchWork:
    """The error if the budget ends before the shortest turn is found. entry: the radius tried last [m]"""
    rule = "must be smaller, or benches fewer or more alike: turns down to an entry radius of {entry} were not all"
    rule += " decided {then}; the {benches} chords are {shortest} to {longest} long"
    sizes = {"entry": Quantity(entry, "m", 6), **told_chords(dragon)}
    return too_much(budget, "turning_radius", rule, Quantity(radius, "m"), **sizes)


def _refusal(radius: float, touch: Touch, margin: float, stray: float) -> InvalidValue:
    """The error if no turn can begin on the circle."""
    (benches, time), told = touch, quantities("m", got=radius, margin=margin, stray=stray)
    if benches is None or time is None:
        what = "benches come so near to the margin of {margin} that it is not decided whether they keep it"
    else:
        near = "come within {margin}" if margin else "touch"
        near = f"may {near} with strays up to {{stray}}" if stray else near
        what = f"benches {{a}} and {{b}} {near} {{time}} {'after' if time >= 0.0 else 'before'} the entry at 1 m/s"
        told |= {"a": benches[0], "b": benches[1], "time": Quantity(round(abs(time), 6), "s")}
    rule = f"must be larger, or the pitch: in a turn that begins on the circle {what}"
    return InvalidValue("turning_radius", rule, **told)
