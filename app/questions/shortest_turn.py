"""The question shortest_turn: the deepest entry of a turn inside its circle."""

from __future__ import annotations

from pydantic import Field

import core
from app.questions.turn import Turn
from app.wire.answers import TOTAL_STRAY, Pair, Point
from app.wire.dances import DragonFields
from app.wire.paths import TurnCircle
from app.wire.question import Margin, Question, Strays, Terms, UniformDragon, measure


class ShortestTurnFields(Strays, TurnCircle):
    """The circle and the coils of the turn to shorten."""

    margin: Margin = 0.0


class ShortestTurnQuery(ShortestTurnFields, UniformDragon):
    """Deepest entry of a turn inside its circle."""


class ShortestTurnRequest(ShortestTurnFields, DragonFields, strict=True):
    """Deepest entry of a turn inside its circle, for any dragon."""


class ShortestTurn(Turn):
    """The turn with the deepest entry inside the circle that this dragon can dance."""

    entry_bracket: Point = measure("m", "Entry radii: infeasible; feasible")
    limited_by: core.TurnLimit = Field(
        description="Reason against a deeper entry. bend: a chord cannot follow; contact: benches come nearer than the "
        "margin, or touch if it is 0; centre: nothing prevents it, down to the centre; undecided: rounding hides "
        "whether benches come within the margin at the lower end of entry_bracket"
    )
    benches: Pair | None = Field(description="The pair in contact at a slightly deeper entry; null if there is none")
    time: float | None = measure("s", "Time of that contact, at a head speed of 1 m/s; 0 is the entry into the turn")
    scan_step: float = measure(
        "m",
        "Distance between the entries tried from the circle inwards; each one is proven, but a narrower range of "
        "infeasible ones between two is not excluded",
    )
    evaluations: int = Field(description="Number of entries tried")
    stray: float | None = TOTAL_STRAY


def shortest_turn(asked: ShortestTurnQuery | ShortestTurnRequest, terms: Terms) -> ShortestTurn:
    """The turn that begins as deep inside its circle as the dragon can dance, and what prevents a deeper one."""
    found = core.shortest_turn(
        asked.to_dragon(terms.settings.checked_benches_max),
        asked.pitch,
        asked.turning_diameter / 2,
        asked.ratio,
        start_turns=asked.start_turns,
        margin=asked.margin,
        stray=asked.to_stray(),
        budget=terms.budget,
    )
    return ShortestTurn.known(found, stray=asked.total_stray, **Turn.of(found.turn).model_dump())


QUESTION = Question(shortest_turn, ShortestTurn, flat=ShortestTurnQuery, body=ShortestTurnRequest)
