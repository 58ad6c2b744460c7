"""The question turn_time: how long the head takes through a turn, if no handle may exceed a speed."""

from __future__ import annotations

from typing import Self

from pydantic import Field

import core
from app.questions.maximum_head_speed import Limit
from app.questions.turn import Turn
from app.wire.dances import DragonFields
from app.wire.paths import TurnFields, TurnPath
from app.wire.question import Question, Terms, UniformDragon, measure


class TurnTimeQuery(Limit, TurnFields, UniformDragon):
    """Time of the head through a turn."""


class TurnTimeRequest(Limit, DragonFields, strict=True):
    """Time of the head through a turn, for any dragon."""

    path: TurnPath = Field(default_factory=lambda: TurnPath(kind="turn"), description="The turn")


class TurnTime(Turn):
    """The turn, and how long the head takes through it as fast as the limit allows."""

    head_speed: float = measure("m/s", "Largest constant speed of the head at which no handle exceeds the limit")
    time: float = measure("s", "Time of the head from the entry to the exit at that speed: the length over the speed")
    handles: list[int] = Field(description="Handles that reach the limit, all at once")

    @classmethod
    def timed(cls, found: core.TurnTime, **own: float) -> Self:
        return cls.known(found, **own, **Turn.of(found.turn).model_dump())


def turn_time(asked: TurnTimeQuery | TurnTimeRequest, terms: Terms) -> TurnTime:
    """How long the head takes through a turn at the highest speed at which no handle exceeds the limit."""
    dragon = asked.to_dragon(terms.settings.checked_benches_max)
    path = asked.to_turn() if isinstance(asked, TurnTimeQuery) else asked.path.to_path()
    return TurnTime.timed(core.turn_time(dragon, path, asked.speed_limit, budget=terms.budget))


QUESTION = Question(turn_time, TurnTime, flat=TurnTimeQuery, body=TurnTimeRequest)
