"""How deep inside its circle may a turn begin?"""

from __future__ import annotations

from typing import Self

from pydantic import Field

import core
from app.questions.question import Question
from app.questions.turn import Turn
from app.settings import Settings
from app.wire.answers import Pair, Point
from app.wire.dances import DragonFields, UniformDragon
from app.wire.models import Margin, measure
from app.wire.paths import TurnCircle


class ShortestTurnFields(TurnCircle):
    """A turn to be made as short as it may be."""

    margin: Margin = 0.0


class ShortestTurnQuery(ShortestTurnFields, UniformDragon):
    """How deep inside its circle may a turn begin?"""


class ShortestTurnRequest(ShortestTurnFields, DragonFields, strict=True):
    """How deep inside its circle may a turn begin, for any dragon?"""


class ShortestTurn(Turn):
    """The turn whose entry lies as deep inside the circle as this dragon can dance."""

    entry_bracket: Point = measure("m", "Entry radii: infeasible, feasible")
    limited_by: core.TurnLimit = Field(
        description="bend: a chord cannot follow; contact: benches come nearer than the margin, or touch if it is 0; "
        "centre: nothing down to the centre"
    )
    benches: Pair | None = Field(
        description="The pair that comes nearer than the margin, or touches, just below; null if none does"
    )
    time: float | None = measure("s", "When, at a head speed of 1 m/s; 0 is the entry into the turn")
    scan_step: float = measure(
        "m",
        "Entries down from the circle were tried this far apart, each one proven: a narrower range of "
        "infeasible ones is not excluded",
    )
    evaluations: int = Field(description="Entries tried")

    @classmethod
    def of_shortest(cls, found: core.ShortestTurn) -> Self:
        return cls.known(found, **Turn.of(found.turn).model_dump())


def shortest_turn(asked: ShortestTurnQuery | ShortestTurnRequest, settings: Settings) -> ShortestTurn:
    """The turn that begins as deep inside its circle as the dragon can dance, and what keeps it from going deeper."""
    found = core.shortest_turn(
        asked.to_dragon(settings.checked_benches_max),
        asked.pitch,
        asked.turning_diameter / 2,
        asked.ratio,
        start_turns=asked.start_turns,
        margin=asked.margin,
    )
    return ShortestTurn.of_shortest(found)


QUESTION = Question(shortest_turn, ShortestTurn, flat=ShortestTurnQuery, body=ShortestTurnRequest)
