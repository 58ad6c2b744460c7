"""The question turn_time: how long the head takes through a turn, if no handle may exceed a speed."""

from __future__ import annotations

from typing import Any, Self

from pydantic import Field

import core
from app.questions.maximum_head_speed import SpeedLimitField
from app.questions.turn import Turn
from app.wire import evidence
from app.wire.answers import SENTENCES
from app.wire.dances import DragonFields
from app.wire.fields import UniformDragon
from app.wire.paths import TurnFields, TurnPath
from app.wire.question import Command, Question, Terms
from app.wire.readings import time_words
from core.language import say
from core.quantities import format_number


class TurnTimeQuery(SpeedLimitField, TurnFields, UniformDragon):
    """Time of the head through a turn."""


class TurnTimeRequest(SpeedLimitField, DragonFields, strict=True):
    """Time of the head through a turn, for any dragon."""

    path: TurnPath = Field(default_factory=lambda: TurnPath(kind="turn"), description="The turn")


class TurnTime(Turn, of=core.TurnTime):
    """The turn, and how long the head takes through it as fast as the limit allows."""

    head_speed: float
    time: float
    handles: list[int]
    sentences: list[str] = SENTENCES
    words: evidence.Words | None = evidence.WORDS

    @classmethod
    def from_core(cls, result: core.TurnTime, **own: Any) -> Self:
        return cls.from_result(result, **own, **Turn.of(result.turn).model_dump())


def turn_time(request: TurnTimeQuery | TurnTimeRequest, terms: Terms) -> TurnTime:
    """How long the head takes through a turn at the highest speed at which no handle exceeds the limit."""
    dragon = request.to_dragon(terms.settings.checked_benches_max)
    path = request.to_turn() if isinstance(request, TurnTimeQuery) else request.path.to_path()
    result = core.turn_time(dragon, path, request.speed_limit, budget=terms.budget)
    how = say("The length of both arcs over the maximum speed of the head, which is proven.")
    words = evidence.time_words(say("Time through this turn"), result, [how]) if terms.words else None
    return TurnTime.from_core(result, sentences=[time_words(result, request.speed_limit)], words=words)


def _title(request: SpeedLimitField) -> str:
    return say("Time through the turn with no handle above {speed} m/s", speed=format_number(request.speed_limit))


QUESTION = Question(
    turn_time,
    TurnTime,
    flat=TurnTimeQuery,
    body=TurnTimeRequest,
    command=Command(
        "How long the head takes through a turn at the highest speed at which no handle exceeds the limit.", _title
    ),
)
