"""Lengths between which an answer to the question for the shortest turn is justifiable.

The search is the one for the shortest turn, with two differences: arcs may be as tight as half the longest chord, and a
turn counts as possible if none of its sampled poses overlaps, without a proof. So the proven bound may be lower than
the shortest turn, but never higher.
"""

from __future__ import annotations

from core import kernels
from core.design.shortest_turn import RATIOS_WORK, SHORTEST_WORK, TurnSearch
from core.design.turn_bounds import least_entry
from core.design.turn_circle import CheckedCircle, checked_circle
from core.design.turn_moves import apart_from_circle
from core.dragon import Dragon, chord_values
from core.kernels import Budget, Halted
from core.paths.turn import Turn
from core.quantities import Quantity
from core.questions import question_about, too_much


@question_about("dragon", Dragon)
def turn_length_bounds(
    dragon: Dragon,
    pitch: float,
    turning_radius: float = 4.5,
    ratio: float | None = 2.0,
    *,
    start_turns: float = 16.0,
    budget: Budget | None = None,
) -> tuple[float, float]:
    """Lengths between which an answer to "the shortest turn of two arcs inside the circle" is justifiable [m].

    pitch, turning_radius [m]; ratio: radius of the first arc over that of the second, None: any; start_turns: of the
    coils
    low: proven: in every shorter turn an arc is tighter than half the longest chord, which then is the diameter of the
        bend, or two benches overlap. shortest_turn() asks for 1 / ROUTE_SINE_LIMIT of that, so its answer is between
    high: the turn that begins and ends on the circle, which needs no choice
    budget: default: SHORTEST_WORK, with a free ratio RATIOS_WORK
    raises: InvalidValue; TooMuchWork

    >>> [round(length, 4) for length in turn_length_bounds(Dragon(), 1.7)]
    [11.7729, 13.6212]
    """
    circle = checked_circle(pitch, turning_radius, ratio, start_turns, any_ratio=True)
    work = (budget or Budget()).within(RATIOS_WORK if ratio is None else SHORTEST_WORK)
    search, longest = _Lengths(dragon, circle, 0.0, work), circle.turn().length
    try:
        low = search.searched().length_bracket[0]
        work.afford()
    except Halted as halted:
        rule = (
            "must be smaller, or benches fewer: no length was proven {then}; the {benches} chords are {shortest} "
            "to {longest} "
            "long"
        )
        size = Quantity(circle.radius, "m")
        raise too_much(work, "turning_radius", rule, size, **chord_values(dragon)) from halted
    return min(low, longest), longest


class _Lengths(TurnSearch):
    """Search for a length below which no turn is justifiable."""

    def __init__(self, dragon: Dragon, circle: CheckedCircle, stray: float, budget: Budget) -> None:
        super().__init__(dragon, circle, stray, budget)
        self.least *= kernels.ROUTE_SINE_LIMIT
        self.inner = least_entry(self.growth, self.radius, self.least)

    def _from_circle(self) -> Turn:
        return self.circle.turn()

    def _allows(self, danced: Turn) -> bool:
        ends = danced.entry_radius, danced.exit_radius
        return self.overlap.deepest(apart_from_circle(self.pitch, *ends, danced.ratio)) <= 0.0
