"""Passages of a dance in requests, and the time of day at its times."""

from __future__ import annotations

import math
import re
from typing import Annotated

from pydantic import AfterValidator, Field
from pydantic_core import PydanticCustomError

from app.wire.question import Instant, Wire, measure
from core import Passage

DAY = 86_400  # [s]
CLOCK = re.compile(r"([01]\d|2[0-3]):([0-5]\d)(?::([0-5]\d))?", re.ASCII)


def _clock(text: str | None) -> str | None:
    if text is not None and not CLOCK.fullmatch(text):
        raise PydanticCustomError("rule", "must be a time of day such as 19:30 or 19:30:15")
    return text


StartClock = Annotated[
    str | None,
    AfterValidator(_clock),
    Field(description="Time of day at time 0, such as 19:30 or 19:30:15: failures, tables and films then show it too"),
]


def time_of_day(time: float, start_clock: str) -> str:
    """The time of day at a time of the dance [s], rounded down to the second; after midnight it begins again at 00:00.

    start_clock: at time 0

    >>> time_of_day(412.5, "19:30"), time_of_day(-1.0, "00:00:00")
    ('19:36:52', '23:59:59')
    """
    match = CLOCK.fullmatch(start_clock)
    assert match
    hours, minutes, seconds = (int(part or 0) for part in match.groups())
    now = math.floor(3600 * hours + 60 * minutes + seconds + time) % DAY
    return f"{now // 3600:02d}:{now // 60 % 60:02d}:{now % 60:02d}"


class PassageBody(Wire, strict=True):
    """A stretch of the dance at a speed of its own, from the end of the passage before it, or from time 0."""

    speed: float = measure("m/s", "Speed of the head; 0: a pause, which ends at a time", ge=0, le=20)
    until_s: float | None = measure(
        "m", "Place of the head at which the passage ends, along the path from where it is at time 0", None,
        ge=-1e6, le=1e6,
    )  # fmt: skip
    until_time: Instant | None = measure("s", "Time at which the passage ends, in place of a place", None)

    def to_passage(self) -> Passage:
        return Passage(self.speed, self.until_s, self.until_time)
