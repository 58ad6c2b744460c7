"""How fast may the head dance?"""

from __future__ import annotations

from pydantic import Field

import core
from app.questions.question import Question
from app.settings import Settings
from app.wire.dances import DanceFields, UniformDragon
from app.wire.models import Answer, Instant, SpeedLimit, Wire, measure
from app.wire.paths import BY_KIND, AnyPath, TurnFields, TurnPath


class Limit(Wire):
    """What no handle may exceed."""

    speed_limit: SpeedLimit = measure("m/s", "Of every handle", 2.0)


class MaximumHeadSpeedQuery(Limit, TurnFields, UniformDragon):
    """How fast may the head dance through a turn?"""

    def to_dance(self, benches_max: int) -> core.Dance:
        """raises: TooLarge, InvalidValue"""
        return core.Dance(self.to_dragon(benches_max), self.to_turn())


class MaximumHeadSpeedRequest(Limit, DanceFields, strict=True):
    """How fast may the head dance, on any path?"""

    path: AnyPath = Field(
        default_factory=lambda: TurnPath(kind="turn"),
        description="The path; a turn where none is given",
        json_schema_extra={"discriminator": BY_KIND},
    )
    start: Instant | None = measure("s", "From when, at head_speed; null: when the whole dragon is on the path", None)
    stop: Instant | None = measure(
        "s", "Until when, at head_speed; null: the end of the path; before a bench folds", None
    )


class MaximumHeadSpeed(Answer):
    """The largest constant head speed at which no handle ever exceeds the limit."""

    head_speed: float = measure("m/s")
    head_speed_bracket: tuple[float | None, float] = measure(
        "m/s", "Proven to keep the limit (null where that proof was given up), found to reach it"
    )
    speed_ratio: float = Field(description="Highest speed of a handle over that of the head")
    handles: list[int] = Field(description="The handles that reach the limit together")
    time: float = measure("s", "When they do, at that head speed; 0 is the entry into the turn")
    time_at_unit_head_speed: float = measure("s", "The same at a head speed of 1 m/s")


def maximum_head_speed(asked: MaximumHeadSpeedQuery | MaximumHeadSpeedRequest, settings: Settings) -> MaximumHeadSpeed:
    """The largest constant head speed at which no handle ever exceeds the limit."""
    dance, limit = asked.to_dance(settings.checked_benches_max), asked.speed_limit
    if isinstance(asked, MaximumHeadSpeedQuery):
        return MaximumHeadSpeed.model_validate(core.maximum_head_speed(dance, limit))
    # Core takes times at a head speed of 1 m/s.
    start, stop = (None if time is None else time * asked.head_speed for time in (asked.start, asked.stop))
    return MaximumHeadSpeed.model_validate(core.maximum_head_speed(dance, limit, start=start, stop=stop))


QUESTION = Question(maximum_head_speed, MaximumHeadSpeed, flat=MaximumHeadSpeedQuery, body=MaximumHeadSpeedRequest)
