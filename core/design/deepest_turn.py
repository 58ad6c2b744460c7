"""The deepest turn: the deepest entry inside its circle of a turn that leaves opposite to it.

A closed form says whether handles can follow: the radius of a bend must be at least half a chord over ROUTE_SINE_LIMIT
(core/kernels/constants.py). The sum of the arcs' radii is S = sqrt(E^2 + growth^2) for the entry radius E (see Turn).
Both radii shrink with E, and the radius of the coil at the entry shrinks too, so there is one least entry.

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
from typing import NamedTuple

import numpy as np

from core import kernels
from core.contact.answer import FirstContact, Outcome
from core.contact.coils import TwoCoils, beyond, free_arc
from core.contact.first_contact import contact_within
from core.dance import Dance
from core.design.turn_circle import checked_circle
from core.display import Readable, display
from core.dragon import Dragon, Stray, checked_stray, chord_values
from core.errors import InvalidValue, TooMuchWork
from core.kernels import Budget, Halted
from core.language import phrase, say
from core.paths.following import ARC_MOST, bends_widely, longest_arc
from core.paths.spiral import Spiral
from core.paths.turn import Turn
from core.quantities import Quantity, quantities
from core.questions import question_about, too_much
from core.sampling import bisect
from core.shapes.reach import reach

# Step between the tried entry radii, as a part of the turning radius [1]; the last radius is one step from the centre.
ENTRY_STEP = 0.01
# Width of the bracket of the entry radius [m].
ENTRY_WIDTH = 1e-9
# Largest work of all entries together [1], see core/kernels/constants.py: about 8 s, because a step on a route takes
# longer than one on a spiral. The default turn takes about 90,000.
TURN_WORK = 2.5e7
# The deepest entry that Turn accepts [m].
ENTRY_MIN = 1e-3
# Additional length of the coils, as a part of the necessary one, so that rounding cannot end them too early [1].
SPARE_TURNS = 1e-9

# If rounding hides whether benches meet at the deepest refused entry, entries down to this far below are tried [m].
LOOKED_BELOW = 1e-6


class Touch(NamedTuple):
    """Whether benches meet in a turn; if they do, the pair and the time [s at 1 m/s, 0 at the entry]."""

    outcome: Outcome
    benches: tuple[int, int] | None = None
    time: float | None = None


class TurnLimit(StrEnum):
    """Reason against a deeper entry: the least radius of a bend, two benches come within the margin, or none down to
    the deepest entry that is tried. LEAST_RADIUS: half of the longest chord over ROUTE_SINE_LIMIT, at which every bench
    can follow; tighter arcs that can be followed too (core/paths/following.py) are not tried. UNDECIDED: rounding hides
    whether two benches come within the margin. CIRCLE: the turn begins or ends on its circle (shortest_turn() alone).
    FOLLOWING: in each shorter turn that is excluded a bench cannot follow, or benches touch (followed_turn() alone).
    BEND: what LEAST_RADIUS was called; no answer has it.

    >>> from core import shortest_turn
    >>> shortest_turn(Dragon(), 1.7).limited_by
    <TurnLimit.LEAST_RADIUS: 'least_radius'>
    """

    BEND = "bend"
    LEAST_RADIUS = "least_radius"
    CONTACT = "contact"
    CENTRE = "centre"
    UNDECIDED = "undecided"
    CIRCLE = "circle"
    FOLLOWING = "following"

    @property
    def words(self) -> str:
        """The value as words.

        >>> TurnLimit.LEAST_RADIUS.words
        'the least radius of a bend'
        """
        words = {
            TurnLimit.LEAST_RADIUS: phrase("the least radius of a bend"),
            TurnLimit.FOLLOWING: phrase("what benches can follow"),
        }
        return say(words.get(self, self.value))


@dataclass(frozen=True, slots=True, repr=False)
class DeepestTurn(Readable):
    """The turn with the smallest entry radius such that all larger ones up to the circle can be danced.

    turn: the turn at the feasible end of entry_bracket
    entry_bracket: infeasible entry radius; feasible one [m]
    limited_by: reason against a shorter turn, see TurnLimit
    benches: the pair that comes within the margin just below; None if none does
    time: time of that, at a head speed of 1 m/s; 0 is the entry into the turn; None without a pair [s]
    scan_step: distance between the tried entries; a narrower range of infeasible ones above is not excluded [m]
    evaluations: number of tried entries, each with a proof

    Its exit is opposite to its entry; shortest_turn() has shorter turns with other exits.

    >>> deepest = deepest_turn(Dragon(), 1.7)
    >>> round(deepest.turn.length, 4), deepest.limited_by.value
    (12.9494, 'least_radius')
    """

    turn: Turn
    entry_bracket: tuple[float, float]
    limited_by: TurnLimit
    benches: tuple[int, int] | None
    time: float | None
    scan_step: float
    evaluations: int

    def _line(self) -> str:
        limit = self.limited_by.words
        if self.benches:
            limit = say("{limit} of benches {a} and {b}", limit=limit, a=self.benches[0], b=self.benches[1])
        radius, length = display(self.turn.entry_radius, "m"), display(self.turn.length, "m")
        return say(
            "entry at a radius of {radius}, length {length}, limited by {limit}",
            radius=radius, length=length, limit=limit,
        )  # fmt: skip


@question_about("dragon", Dragon)
def deepest_turn(
    dragon: Dragon,
    pitch: float,
    turning_radius: float = 4.5,
    ratio: float = 2.0,
    *,
    start_turns: float = 16.0,
    margin: float = 0.0,
    stray: float | Stray = 0.0,
    budget: Budget | None = None,
) -> DeepestTurn:
    """The smallest entry radius at which nothing touches and every handle can follow, searched from the circle inwards.

    pitch, turning_radius, margin [m]; stray: largest distance of every hole from its place [m]; ratio: radius of the
    first arc over that of the second; start_turns: of the coils
    Each tried entry is proven. The entries are ENTRY_STEP of the turning radius apart, so this is a scan that may miss
    a narrower infeasible range.
    entry_bracket is at most ENTRY_WIDTH wide, or wider if the budget is spent or by entries that can be neither proven
    nor refuted; budget: default: TURN_WORK
    raises: TooMuchWork if it is stopped, or spent before an infeasible entry was found; InvalidValue (turning_radius)
        if even the turn at the circle cannot be danced

    >>> round(deepest_turn(Dragon(), 1.7).turn.entry_radius, 6)
    4.285762
    """
    circle, stray = checked_circle(pitch, turning_radius, ratio, start_turns, margin), checked_stray(stray, dragon)
    radius, turn_at = circle.radius, circle.turn
    border, floor = _follow_border(dragon, turn_at, radius)
    entries = _Entries(dragon, turn_at, circle.margin, stray, (budget or Budget()).within(TURN_WORK))
    touch = entries.touch_at(radius)
    if touch.outcome is not Outcome.CLEAR:
        raise refusal(radius, touch, circle.margin, stray)
    entry, step = radius, ENTRY_STEP * radius
    while touch.outcome is Outcome.CLEAR and entry > floor:
        entry = max(entry - step, floor)
        touch = entries.touch_at(entry)
    if touch.outcome is Outcome.CLEAR:
        limited_by = TurnLimit.CENTRE if border is None else TurnLimit.LEAST_RADIUS
        return DeepestTurn(turn_at(floor), (border or 0.0, floor), limited_by, None, None, step, entries.evaluations)
    bracket, touch = entries.bracket(entry, floor)
    limited_by = TurnLimit.UNDECIDED if touch.outcome is Outcome.UNDECIDED else TurnLimit.CONTACT
    return DeepestTurn(turn_at(bracket[1]), bracket, limited_by, touch.benches, touch.time, step, entries.evaluations)


class _Entries:
    """Search for the entries whose turns are free of contact, from the circle inwards.

    margin, stray: [m]; feasible: the last entry found clear; refuted: the last one at which benches meet, and
        how [m]; None before there is one; evaluations: number of tried entries
    """

    def __init__(
        self,
        dragon: Dragon,
        turn_at: Callable[[float], Turn],
        margin: float,
        stray: float,
        budget: Budget,
    ) -> None:
        self.dragon, self.turn_at, self.budget = dragon, turn_at, budget
        self.margin, self.stray = margin, stray
        self.feasible: float | None = None
        self.refuted: tuple[float, Touch] | None = None
        self.evaluations = 0

    def touch_at(self, entry: float) -> Touch:
        """Whether benches meet in the turn with this entry radius [m].

        raises: TooMuchWork if the budget ends first, and benches are not known to meet at any other entry
        """
        try:
            touch = self._contact(self.turn_at(entry))
        except Halted as halted:
            raise _too_much(self.budget, self.dragon, entry, self.turn_at(entry).turning_radius) from halted
        self.evaluations += 1
        if touch.outcome is Outcome.UNDECIDED and self.budget.left <= 0.0 and not self.refuted:
            raise _too_much(self.budget, self.dragon, entry, self.turn_at(entry).turning_radius)
        if touch.outcome is Outcome.CLEAR:
            self.feasible = entry
        elif touch.outcome is not Outcome.UNDECIDED:
            self.refuted = entry, touch
        return touch

    def _contact(self, danced: Turn) -> Touch:
        """The first contact of a dance through the turn, with time 0 at its entry; CLEAR is proven.

        On the coil it begins where the turn of the last clear entry begins.
        """
        return contact_in(self.budget, self.dragon, danced, self.margin, self.stray, self.feasible)

    def bracket(self, refused: float, floor: float) -> tuple[tuple[float, float], Touch]:
        """The bracket (infeasible, feasible) above a refused entry [m], and how benches meet at its lower end.

        If rounding hides that they meet there, that end is a deeper entry at which they do; if there is none not far
        below and above `floor` [m], the end is undecided.
        """

        def is_clear(entry: float) -> bool | None:
            if self.budget.left <= 0.0:
                return None
            touch = self.touch_at(entry)
            if touch.outcome is Outcome.UNDECIDED and self.budget.left <= 0.0:  # only because the work is spent
                return None
            return touch.outcome is Outcome.CLEAR

        assert self.feasible is not None
        low, high = bisect(is_clear, refused, self.feasible, width=ENTRY_WIDTH)
        below = ENTRY_WIDTH
        while not self.refuted and below <= LOOKED_BELOW and low - below > floor and self.budget.left > 0.0:
            if self.touch_at(low - below).outcome is Outcome.CLEAR:
                break
            below *= 10.0
        if not self.refuted:
            return (low, high), Touch(Outcome.UNDECIDED)
        low, touch = self.refuted
        return (low, high), touch


def contact_in(
    budget: Budget, dragon: Dragon, danced: Turn, margin: float, stray: float, clear: float | None = None
) -> Touch:
    """The first contact of a dance through the turn, with time 0 at its entry; CLEAR is proven for coils of any length.

    clear: radius down to which the coil inwards is known to be free of contact [m]; None: it is searched from its start
    """
    coil = Spiral(danced.pitch, danced.start_turns)
    before, start = (
        coil.length - coil.growth * float(kernels.spiral_arc(r / coil.growth)) if r else 0.0
        for r in (danced.entry_radius, clear)
    )
    if before > start:
        contact = contact_within(budget, Dance(dragon, coil), margin=margin, stray=stray, start=start, stop=before)
        if contact.outcome is not Outcome.CLEAR:
            return _touch(contact, before)
    stop, followed = way_followed(reach(dragon, stray).bounds if stray else dragon, danced, margin)
    arc = stop - danced.length - coils_of(danced).arc(0.0)
    turns = max(danced.start_turns, (1.0 + SPARE_TURNS) * kernels.spiral_theta(arc / coil.growth) / (2.0 * math.pi))
    path = Turn(
        danced.pitch, danced.turning_radius, danced.ratio, start_turns=turns, entry_radius=danced.entry_radius,
        exit_radius=danced.exit_radius,
    )  # fmt: skip
    dance = Dance(dragon.leading(followed.benches), path)
    contact = contact_within(budget, dance, margin=margin, stray=stray, stop=stop)
    return _touch(contact, 0.0)


def _follow_border(dragon: Dragon, turn_at: Callable[[float], Turn], radius: float) -> tuple[float | None, float]:
    """Bracket of the entry radius from which chords fit the bends [m]; its lower end is None if the deepest entry fits.

    raises: InvalidValue (turning_radius) if a chord cannot follow even at the circle
    """
    refuse_bend(dragon, turn_at(radius))
    low, high = min(max(ENTRY_STEP * radius, ENTRY_MIN), radius), radius
    if bends_widely(dragon, turn_at(low)):
        return None, low
    return bisect(lambda entry: bends_widely(dragon, turn_at(entry)), low, high, width=ENTRY_WIDTH)


def refuse_bend(dragon: Dragon, danced: Turn) -> None:
    """Refuse the circle if a chord cannot follow a turn that begins on it. raises: InvalidValue (turning_radius)"""
    if not bends_widely(dragon, danced):
        why = "a turn that begins on the circle bends to a radius of {bend}, too tight for the longest chord ({chord})"
        sharpest, chord = 1.0 / danced.sharpest[0], float(dragon.chords.max())
        values = quantities("m", got=danced.turning_radius) | quantities("m", 4, bend=sharpest)
        values |= quantities("m", 6, chord=chord)
        raise InvalidValue("turning_radius", f"must be larger: {why}", **values)


def _touch(contact: FirstContact, zero: float) -> Touch:
    return Touch(contact.outcome, contact.benches, None if contact.time is None else contact.time - zero)


def way_followed(dragon: Dragon, danced: Turn, margin: float) -> tuple[float, Dragon]:
    """Travel of the head from the entry that needs a search [m], and the benches that matter until then, see
    core/contact/coils.py."""
    coils, chords = coils_of(danced), dragon.chords
    whole = danced.length + ARC_MOST * float(chords.sum())
    out = free_arc(dragon, coils, margin, longest_arc(dragon, danced))
    if out is None or danced.length + out >= whole:
        return whole, dragon
    head = coils.growth * float(kernels.spiral_theta((out - coils.arc(0.0)) / coils.growth))
    behind = danced.length + out + coils.arc(beyond(dragon, coils.growth, head, margin))
    count = max(int(np.searchsorted(np.cumsum(chords), behind)) + 2, dragon.uniform_from + 2)
    return danced.length + out, dragon.leading(count)


def coils_of(danced: Turn) -> TwoCoils:
    """The coils before and after a turn."""
    extent = max(math.hypot(*c) + r for c, r in zip(danced.centres, danced.radii, strict=True))
    extent = max(extent, danced.entry_radius, danced.exit_radius)
    return TwoCoils(danced.pitch / (2.0 * math.pi), math.pi, extent, danced.length, danced.exit_radius)


def _too_much(budget: Budget, dragon: Dragon, entry: float, radius: float) -> TooMuchWork:
    """The error if the budget ends before the shortest turn is found. entry: the radius tried last [m]"""
    rule = (
        "must be smaller, or benches fewer or more alike: turns down to an entry radius of {entry} were not all "
        "decided {then}; the {benches} chords are {shortest} to {longest} long"
    )
    sizes = {"entry": Quantity(entry, "m", 6), **chord_values(dragon)}
    return too_much(budget, "turning_radius", rule, Quantity(radius, "m"), **sizes)


UNDECIDED = phrase(
    "in a turn that begins on the circle benches come so near to the margin of {margin} that it is not decided whether "
    "they keep it"
)
# Contacts in a turn, by whether there is a margin, whether there is a stray, and whether they are after the entry.
NEAR: dict[tuple[bool, bool, bool], str] = {
    (False, False, False): phrase(
        "in a turn that begins on the circle benches {a} and {b} touch {time} before the entry at 1 m/s"
    ),
    (False, False, True): phrase(
        "in a turn that begins on the circle benches {a} and {b} touch {time} after the entry at 1 m/s"
    ),
    (False, True, False): phrase(
        "in a turn that begins on the circle benches {a} and {b} may touch with strays up to {stray} {time} "
        "before the entry at 1 m/s"
    ),
    (False, True, True): phrase(
        "in a turn that begins on the circle benches {a} and {b} may touch with strays up to {stray} {time} "
        "after the entry at 1 m/s"
    ),
    (True, False, False): phrase(
        "in a turn that begins on the circle benches {a} and {b} come within {margin} {time} before the entry at 1 m/s"
    ),
    (True, False, True): phrase(
        "in a turn that begins on the circle benches {a} and {b} come within {margin} {time} after the entry at 1 m/s"
    ),
    (True, True, False): phrase(
        "in a turn that begins on the circle benches {a} and {b} may come within {margin} with strays up to "
        "{stray} {time} before the entry at 1 m/s"
    ),
    (True, True, True): phrase(
        "in a turn that begins on the circle benches {a} and {b} may come within {margin} with strays up to "
        "{stray} {time} after the entry at 1 m/s"
    ),
}


def refusal(radius: float, touch: Touch, margin: float, stray: float) -> InvalidValue:
    """The error if no turn can begin on the circle."""
    (_, benches, time), values = touch, quantities("m", got=radius, margin=margin, stray=stray)
    if benches is None or time is None:
        why = UNDECIDED
    else:
        why = NEAR[bool(margin), bool(stray), time >= 0.0]
        values |= {"a": benches[0], "b": benches[1], "time": Quantity(round(abs(time), 6), "s")}
    return InvalidValue("turning_radius", f"must be larger, or the pitch: {why}", **values)
