"""The question maximum_head_speed: the highest head speed that keeps a limit."""

from __future__ import annotations

from pydantic import Field

import core
from app.wire import evidence
from app.wire.answers import SENTENCES
from app.wire.dances import DanceFields
from app.wire.fields import Answer, Instant, SpeedLimit, UniformDragon, Wire, measure
from app.wire.paths import AnyPath, TurnFields, TurnPath
from app.wire.question import Command, Question, Terms
from app.wire.readings import head_words
from core.language import say
from core.quantities import format_number


class SpeedLimitField(Wire):
    """Speed limit for every handle."""

    speed_limit: SpeedLimit = measure(
        "m/s", "Highest speed allowed for any handle", 2.0, label="Speed limit", hint="of every handle"
    )


class MaximumHeadSpeedQuery(SpeedLimitField, TurnFields, UniformDragon):
    """Highest head speed through a turn that keeps a limit."""

    def to_dance(self, benches_max: int) -> core.Dance:
        """raises: TooLarge, InvalidValue"""
        return core.Dance(self.to_dragon(benches_max), self.to_turn())


class MaximumHeadSpeedRequest(SpeedLimitField, DanceFields, strict=True):
    """Highest head speed that keeps a limit, on any path."""

    path: AnyPath = Field(default_factory=lambda: TurnPath(kind="turn"), description="The path; a turn by default")
    start: Instant | None = measure("s", "Start, at head_speed; default: when the whole dragon is on the path", None)
    stop: Instant | None = measure(
        "s", "End time, at head_speed, before any bench folds; default: the end of the path", None
    )


class MaximumHeadSpeed(Answer, of=core.MaximumHeadSpeed, leave=()):
    """The largest constant head speed at which no handle ever exceeds the limit; passages keep their ratio to it."""

    sentences: list[str] = SENTENCES
    words: evidence.Words | None = evidence.WORDS


def maximum_head_speed(request: MaximumHeadSpeedQuery | MaximumHeadSpeedRequest, terms: Terms) -> MaximumHeadSpeed:
    """The largest constant head speed at which no handle ever exceeds the limit."""
    dance, limit = request.to_dance(terms.settings.checked_benches_max), request.speed_limit
    if isinstance(request, MaximumHeadSpeedQuery):
        result = core.maximum_head_speed(dance, limit, budget=terms.budget)
    else:
        # Core takes times at a head speed of 1 m/s.
        start, stop = (None if time is None else time * request.head_speed for time in (request.start, request.stop))
        result = core.maximum_head_speed(dance, limit, start=start, stop=stop, budget=terms.budget)
    words = evidence.head_words(result) if terms.words else None
    return MaximumHeadSpeed.from_result(result, sentences=head_words(result, limit), words=words)


def _title(request: SpeedLimitField) -> str:
    return say("Maximum head speed for {speed} m/s", speed=format_number(request.speed_limit))


QUESTION = Question(
    maximum_head_speed,
    MaximumHeadSpeed,
    flat=MaximumHeadSpeedQuery,
    body=MaximumHeadSpeedRequest,
    command=Command(
        "The largest constant head speed at which no handle exceeds the limit on the way through a turn.", _title
    ),
)
