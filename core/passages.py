"""Passages: parts of a dance with other speeds of the head, and pauses; checked one by one."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from decimal import Decimal, localcontext
from typing import NamedTuple

from core.checks import checked_number
from core.display import Readable
from core.errors import InvalidValue
from core.quantities import Given, Parameter, Quantity
from core.values import Point

HEAD_SPEED_MIN = 1e-6  # [m/s]
HEAD_SPEED_MAX = 1e4  # [m/s]
TIME_MAX = 1e12  # [s]
S_MAX = 1e9  # [m]
PASSAGES_MAX = 1_000
# Digits in which the ends of passages are added up [1].
NODE_DIGITS = 60


@dataclass(frozen=True, slots=True)
class Passage(Readable):
    """A part of the dance with one speed of the head. It begins where the passage before it ends, or at time 0.

    speed: speed of the head, 0 for a pause [m/s]
    until_s: arc length of the head at its end; None if a time ends it [m]
    until_time: time of its end; None if a place ends it [s]

    >>> from core import Dance, Dragon, Spiral, first_contact
    >>> slow = Dance(Dragon(), Spiral(), 1.0, [Passage(0.5, until_time=100.0)])
    >>> round(first_contact(slow).time, 6)
    462.473838
    """

    speed: float
    until_s: float | None = None
    until_time: float | None = None


class Period(NamedTuple):
    """An interval of time with one speed of the head.

    begin, end: [s]; first, last: travels of the head then [m]; speed: [m/s]
    passage: its index, None outside all passages; origin: a time [s] and its travel [m], from which all others follow
    """

    begin: float
    end: float
    first: float
    last: float
    speed: float
    passage: int | None
    origin: Point

    def time(self, travel: float) -> float:
        """Time at which the head has travelled this far, within the period [s]."""
        return min(max(self.origin[0] + (travel - self.origin[1]) / self.speed, self.begin), self.end)

    def travel(self, time: float) -> float:
        """Travel of the head at a time of the period [m]."""
        return self.origin[1] + (time - self.origin[0]) * self.speed


# With passages 0 to n - 1, node k is the time and the travel at which passage k begins, node n where the last one ends;
# node 0 is time 0 at travel 0. They are added up in decimals, so that each has one rounding however many there are.
def nodes(passages: Sequence[Passage]) -> tuple[list[float], list[float]]:
    """Times [s] and travels [m] of the nodes. raises: InvalidValue for a passage that ends before it begins"""
    times, travels = [0.0], [0.0]
    with localcontext() as context:
        context.prec = NODE_DIGITS
        node = Decimal(0), Decimal(0)
        for k, passage in enumerate(passages):
            node = _ended(k, passage, *node)
            times.append(float(node[0]))
            travels.append(float(node[1]))
    return times, travels


def _ended(k: int, passage: Passage, time: Decimal, travel: Decimal) -> tuple[Decimal, Decimal]:
    """Time and travel of the end of a passage, from those of its beginning. raises: InvalidValue"""
    if passage.until_time is not None:
        if passage.until_time <= float(time):
            rule, got = "must be after the passage begins, at {begin}", Quantity(passage.until_time, "s")
            raise InvalidValue(f"passages.{k}.until_time", rule, got=got, begin=Quantity(float(time), "s", 9))
        end = Decimal(passage.until_time)
        return end, travel + (end - time) * Decimal(passage.speed)
    until = passage.until_s
    assert until is not None
    if until <= float(travel):
        rule = "must be further than where the passage begins, at {begin}"
        raise InvalidValue(
            f"passages.{k}.until_s", rule, got=Quantity(until, "m"), begin=Quantity(float(travel), "m", 9)
        )
    return time + (Decimal(until) - travel) / Decimal(passage.speed), Decimal(until)


def checked_passages(passages: object) -> tuple[Passage, ...]:
    """Passages whose numbers are checked one by one. raises: InvalidValue"""
    if not isinstance(passages, (list, tuple)):
        raise InvalidValue("passages", "must be a list of Passage objects", got=Given(passages))
    if len(passages) > PASSAGES_MAX:
        raise InvalidValue("passages", "must be at most {most}", got=len(passages), most=PASSAGES_MAX)
    return tuple(_checked(f"passages.{k}", passage) for k, passage in enumerate(passages))


def _checked(name: str, passage: object) -> Passage:
    if not isinstance(passage, Passage):
        raise InvalidValue(name, "must be a Passage", got=Given(passage))
    speed = checked_number(f"{name}.speed", passage.speed, "m/s", 0.0, HEAD_SPEED_MAX)
    if 0.0 < speed < HEAD_SPEED_MIN:
        rule, least = "must be 0, for a pause, or at least {least}", Quantity(HEAD_SPEED_MIN, "m/s")
        raise InvalidValue(f"{name}.speed", rule, got=Quantity(speed, "m/s"), least=least)
    s, time = passage.until_s, passage.until_time
    if (s is None) == (time is None):
        got = "neither" if s is None else "both"
        raise InvalidValue(name, "must end at until_s [m] or at until_time [s]", got=got)
    if s is None:
        return Passage(speed, None, checked_number(f"{name}.until_time", time, "s", -TIME_MAX, TIME_MAX))
    if speed == 0.0:
        rule = "must be given: a pause does not reach {place}"
        raise InvalidValue(f"{name}.until_time", rule, place=Parameter("until_s"))
    return Passage(speed, checked_number(f"{name}.until_s", s, "m", -S_MAX, S_MAX))
