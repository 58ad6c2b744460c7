"""Passages of a dance in requests, and the time of day at its times."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from typing import Annotated

from pydantic import AfterValidator
from pydantic_core import PydanticCustomError

from app.wire.fields import Instant, Wire, measure
from core import InvalidValue, Passage
from core.passages import checked_passages, nodes
from core.quantities import Parameter, Quantity

DAY = 86_400  # [s]
CLOCK = re.compile(r"([01]\d|2[0-3]):([0-5]\d)(?::([0-5]\d))?", re.ASCII)


def checked_clock(text: str | None) -> str | None:
    """The text, if it is a time of day."""
    if text is not None and not CLOCK.fullmatch(text):
        raise PydanticCustomError("rule", "must be a time of day such as 19:30 or 19:30:15")
    return text


StartClock = Annotated[
    str | None,
    AfterValidator(checked_clock),
    measure(
        "",
        "Time of day at time 0, such as 19:30 or 19:30:15: failures, tables and films then show it too",
        label="Starts at",
    ),
]


BeginClock = Annotated[
    str | None,
    AfterValidator(checked_clock),
    measure(
        "",
        "Time of day at which the dance starts, such as 19:30, in place of start_clock: at start if that "
        "is given, else when the whole dragon is on the path",
        label="Starts at",
    ),
]


def clock_at_zero(begin_clock: str, begin: float) -> str:
    """The time of day at time 0 of a dance that begins at a time of the day.

    begin_clock: that time of day; begin: the time at which the dance begins [s], to a millionth of a second

    >>> clock_at_zero("19:30", 44.898), time_of_day(44.898, clock_at_zero("19:30", 44.898))
    ('19:29:15.102', '19:30:00')
    """
    hours, minutes, seconds = (float(part) for part in f"{begin_clock}:00".split(":")[:3])
    micro = round((3600.0 * hours + 60.0 * minutes + seconds - begin) * 1e6) % (DAY * 1_000_000)
    seconds, rest = divmod(micro, 1_000_000)
    fraction = f".{rest:06d}".rstrip("0") if rest else ""
    return f"{seconds // 3600:02d}:{seconds // 60 % 60:02d}:{seconds % 60:02d}{fraction}"


def minutes_and_seconds(time: float) -> str:
    """A time [s] in minutes, seconds and tenths.

    >>> minutes_and_seconds(83.06), minutes_and_seconds(-4.19), minutes_and_seconds(-0.04)
    ('1:23.1', '-0:04.2', '0:00.0')
    """
    tenths = round(abs(time) * 10.0)
    minutes, rest = divmod(tenths, 600)
    sign = "-" if time < 0.0 and tenths else ""
    return f"{sign}{minutes}:{rest // 10:02d}.{rest % 10}"


def time_of_day(time: float, start_clock: str) -> str:
    """The time of day at a time of the dance [s], rounded down to the second; after midnight it begins again at 00:00.

    start_clock: at time 0, as clock_at_zero() gives it, or without a fraction of a second

    >>> time_of_day(412.5, "19:30"), time_of_day(-1.0, "00:00:00")
    ('19:36:52', '23:59:59')
    """
    clock, _, fraction = start_clock.partition(".")
    match = CLOCK.fullmatch(clock)
    assert match
    hours, minutes, seconds = (int(part or 0) for part in match.groups())
    now = 3600 * hours + 60 * minutes + seconds + time
    if fraction:  # the sum of two fractions is good to a millionth of a second
        now = round(now + float(f"0.{fraction}"), 6)
    now = math.floor(now) % DAY
    return f"{now // 3600:02d}:{now // 60 % 60:02d}:{now % 60:02d}"


class PassageBody(Wire, strict=True):
    """A stretch of the dance at a speed of its own, from the end of the passage before it, or from time 0."""

    speed: float = measure(
        "m/s", "Speed of the head; 0: a pause, which has a duration or ends at a time", label="Speed of the passage",
        ge=0, le=20,
    )  # fmt: skip
    until_s: float | None = measure(
        "m", "Place of the head at which the passage ends, along the path from where it is at time 0", None,
        label="until, in metres", ge=-1e6, le=1e6,
    )  # fmt: skip
    until_time: Instant | None = measure(
        "s", "Time at which the passage ends, in place of a place", None, label="until, in seconds"
    )
    duration: float | None = measure(
        "s", "Duration of the passage, in place of its end", None, label="for, in seconds", gt=0, le=1e6
    )


def passages_of(bodies: Sequence[PassageBody]) -> list[Passage]:
    """The passages of a request, where a duration becomes the time at its end. raises: InvalidValue

    >>> passages_of([PassageBody(speed=0.5, until_s=20.0), PassageBody(speed=0.0, duration=10.0)])[1].until_time
    50.0
    """
    passages: list[Passage] = []
    for k, body in enumerate(bodies):
        until = body.until_time
        if body.duration is not None:
            for name in ("until_s", "until_time"):
                if getattr(body, name) is not None:
                    rule, other = "must be left out beside {other}, at which the passage ends", Parameter(name)
                    raise InvalidValue(f"passages.{k}.duration", rule, got=Quantity(body.duration, "s"), other=other)
            until = nodes(checked_passages(passages))[0][-1] + body.duration
        passages.append(Passage(body.speed, body.until_s, until))
    return passages
