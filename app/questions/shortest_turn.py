"""The question shortest_turn: the shortest turn inside its circle, with any exit or the one opposite to its entry."""

from __future__ import annotations

from pydantic import Field

import core
from app.questions.turn import Turn
from app.wire import evidence
from app.wire.answers import SENTENCES, TOTAL_STRAY
from app.wire.dances import DragonFields
from app.wire.fields import Margin, Strays, UniformDragon, measure
from app.wire.paths import TurnCircle
from app.wire.question import Command, Question, Terms
from app.wire.readings import limit_words, turn_words
from core.language import phrase, say
from core.quantities import format_bound, format_number
from core.values import Pair, Point

# Width of a bracket that the work did not suffice to make narrow [m]: others have 1 mm at most.
UNDECIDED_LEAST = 2e-3


class ShortestTurnFields(Strays, TurnCircle):
    """The circle and the coils of the turn to shorten."""

    margin: Margin = 0.0
    exit_opposite: bool = Field(
        False,
        description="true: the turn ends opposite to its entry, so that only the entry is searched; false: it may end "
        "anywhere on the coil outwards inside the circle",
    )
    any_ratio: bool = Field(
        False,
        description="true: the ratio is free too, so that `ratio` does not matter; a search of a minute, for a job",
    )
    any_bend: bool = Field(
        False,
        description="true: arcs may be as tight as every bench is proven to follow; false: at least half the longest "
        "distance of two handles over 0.999. For one ratio; a search of a minute, for a job",
    )


class ShortestTurnQuery(ShortestTurnFields, UniformDragon):
    """Shortest turn inside its circle."""


class ShortestTurnRequest(ShortestTurnFields, DragonFields, strict=True):
    """Shortest turn inside its circle, for any dragon."""


class ShortestTurn(Turn):
    """The shortest turn inside the circle that this dragon can dance.

    entry_bracket: entry radii. Free exit: least and greatest of the turns that may be as short as this one; opposite
        exit: infeasible; feasible [m]
    exit_bracket: exit radii, as entry_bracket; null for an opposite exit [m]
    limited_by: reason against a shorter turn. least_radius: a bend has the least radius that is taken for the longest
        chord, 0.1 % more than it needs, because a proof does (bend: the former name, which no answer has); circle: it
        begins or ends on the circle; contact: benches come nearer than the margin, or touch if it is 0; following
        (any_bend): in each shorter turn that is excluded a bench cannot follow, or benches touch; centre: nothing
        prevents it, down to the centre; undecided: rounding hides whether benches come within the margin at the lower
        end of entry_bracket
    benches: the pair in contact at a slightly deeper entry; null if there is none, and for a free exit
    time: time of that contact, at a head speed of 1 m/s; 0 is the entry into the turn [s]
    scan_step: distance between the entries tried from the circle inwards; each one is proven, but a narrower range of
        infeasible ones between two is not excluded. 0 for a free exit, whose search leaves no gap [m]
    evaluations: number of turns danced
    """

    length_bracket: Point | None = measure(
        "m",
        "Proven: no turn of two arcs inside the circle, with the ratio and the bends asked for, is shorter; the length "
        "of this one, which was danced without a contact. It is wider where the work was spent first. null for an "
        "opposite exit",
    )
    entry_bracket: Point
    exit_bracket: Point | None
    limited_by: core.TurnLimit
    benches: Pair | None
    time: float | None
    scan_step: float
    evaluations: int
    stray: float | None = TOTAL_STRAY
    sentences: list[str] = SENTENCES
    words: evidence.Words | None = evidence.WORDS


def shortest_turn(request: ShortestTurnQuery | ShortestTurnRequest, terms: Terms) -> ShortestTurn:
    """The shortest turn inside the circle that the dragon can dance, with a proven bracket, and what limits it."""
    dragon = request.to_dragon(terms.settings.checked_benches_max)
    about = {"start_turns": request.start_turns, "margin": request.margin, "stray": request.to_stray()}
    circle = (request.pitch, request.turning_diameter / 2)
    if request.any_bend and (request.any_ratio or request.exit_opposite):
        rule = "must be false with any_ratio or exit_opposite: the search over bends has one ratio, and any exit"
        raise core.InvalidValue("any_bend", rule)
    result: core.ShortestTurn | core.DeepestTurn
    if request.exit_opposite:
        if request.any_ratio:
            raise core.InvalidValue(
                "any_ratio", "must be false with exit_opposite: only a free exit is searched over ratios"
            )
        result = core.deepest_turn(dragon, *circle, request.ratio, **about, budget=terms.budget)
        own: dict[str, float | None] = {"length_bracket": None, "exit_bracket": None}
    else:
        if request.any_bend:
            result = core.followed_turn(dragon, *circle, request.ratio, **about, budget=terms.budget)
        else:
            ratio = None if request.any_ratio else request.ratio
            result = core.shortest_turn(dragon, *circle, ratio, **about, budget=terms.budget)
        own = {"benches": None, "time": None, "scan_step": 0.0}
    on_circle = core.Turn(*circle, result.turn.ratio, start_turns=request.start_turns).length
    sentences = [
        turn_words(result.turn),
        say("With both ends on the circle every ratio gives {length:.6f} m.", length=on_circle),
        limit_words(result.limited_by, request.margin, request.to_stray()),
    ]
    if isinstance(result, core.ShortestTurn) and (spent := _spent_words(result)):
        sentences.append(spent)
    words = evidence.shortest_words(result, request, dragon) if terms.words else None
    said = {"stray": request.total_stray, "sentences": sentences, "words": words}
    return ShortestTurn.from_result(result, **said, **own, **Turn.of(result.turn).model_dump())


def _spent_words(result: core.ShortestTurn) -> str:
    """What the work did not suffice to decide; empty if the bracket is as narrow as it should be."""
    low, high = result.length_bracket
    if high - low < UNDECIDED_LEAST:
        return ""
    template = phrase("The work was spent before it was decided whether turns of {low} m and more can be danced.")
    return say(template, low=format_bound(low, 3))


def _title(request: ShortestTurnQuery | ShortestTurnRequest) -> str:
    if not request.margin:
        return say("Shortest turn")
    return say("Shortest turn with no bench within {margin} m of another", margin=format_number(request.margin))


QUESTION = Question(
    shortest_turn,
    ShortestTurn,
    flat=ShortestTurnQuery,
    body=ShortestTurnRequest,
    command=Command("The shortest turn inside its circle that the dragon can dance, and what limits it.", _title),
)
