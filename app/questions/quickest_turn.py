"""The question quickest_turn: the turn inside its circle that the head leaves soonest, if no handle exceeds a speed."""

from __future__ import annotations

import core
from app.questions.maximum_head_speed import SpeedLimitField
from app.questions.turn_time import TurnTime
from app.wire import evidence
from app.wire.dances import DragonFields
from app.wire.fields import Margin, UniformDragon
from app.wire.paths import TurnCircle
from app.wire.question import Command, Question, Terms
from app.wire.readings import time_words, turn_words
from core.design.quickest_turn import GRID
from core.language import joined, say
from core.quantities import format_number


class QuickestTurnFields(SpeedLimitField, TurnCircle):
    """The circle and the coils of the turn, and the limit of speed."""

    margin: Margin = 0.0


class QuickestTurnQuery(QuickestTurnFields, UniformDragon):
    """Quickest turn inside its circle."""


class QuickestTurnRequest(QuickestTurnFields, DragonFields, strict=True):
    """Quickest turn inside its circle, for any dragon."""


class QuickestTurn(TurnTime):
    """The quickest turn of a scan over entries and exits. It is proven that nothing touches in it, with everybody in
    their place, and that no handle exceeds the limit, not that no other turn is quicker.

    scan_step: distance between the tried entries, and exits, from which the time was lowered; none between is excluded
        [m]
    """

    scan_step: float


def quickest_turn(request: QuickestTurnQuery | QuickestTurnRequest, terms: Terms) -> QuickestTurn:
    """The turn of those in a scan that takes the head the shortest time, if no handle exceeds the limit."""
    dragon, radius = request.to_dragon(terms.settings.checked_benches_max), request.turning_diameter / 2
    result = core.quickest_turn(
        dragon, request.pitch, radius, request.ratio, speed_limit=request.speed_limit, start_turns=request.start_turns,
        margin=request.margin, budget=terms.budget,
    )  # fmt: skip
    sentences = [
        time_words(result, request.speed_limit),
        joined([turn_words(result.turn), say("A shorter turn bends more, so the head must go slower.")]),
    ]
    how = say(
        "With everybody in their place nothing touches in it, and no handle exceeds the limit: both are proven. "
        "That no turn is quicker is not: entries and exits {step} cm apart were tried, and the best ones refined.",
        step=format_number(100.0 * GRID * radius),
    )
    words = evidence.time_words(say("Quickest turn"), result, [how]) if terms.words else None
    return QuickestTurn.from_core(result, sentences=[*sentences, how], words=words, scan_step=GRID * radius)


def _title(request: SpeedLimitField) -> str:
    return say("Quickest turn with no handle above {speed} m/s", speed=format_number(request.speed_limit))


QUESTION = Question(
    quickest_turn,
    QuickestTurn,
    flat=QuickestTurnQuery,
    body=QuickestTurnRequest,
    command=Command("The turn inside its circle that takes the head the shortest time of those in a scan.", _title),
)
