"""Clock: the place of the head at a time, and the first time at which it is at a place.

A dance is a motion of the head along its path, with a clock for its times. Contacts depend only on the place of the
head. So searches for them work with places, and the clock turns a place into the first time at which the head is there.
"""

from __future__ import annotations

from bisect import bisect_left, bisect_right
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from core.errors import InvalidValue, said
from core.shown import Shown
from core.values import Floats, checked_number

HEAD_SPEED_MIN = 1e-6  # [m/s]
HEAD_SPEED_MAX = 1e4  # [m/s]
TIME_MAX = 1e12  # [s]
PLACE_MAX = 1e9  # [m]
PASSAGES_MAX = 1_000
# Largest relative error of a time that is turned into a place and back [1]: three operations each way.
TIME_ROUNDING = 1e-15
# Most passages that a sentence lists one by one [1].
LISTED = 6


@dataclass(frozen=True, slots=True)
class Passage(Shown):
    """A part of the dance with one speed of the head. It begins where the passage before it ends, or at time 0.

    speed: [m/s], 0 for a pause; until_s: place of the head, or until_time: time, at which the passage ends [m], [s]
    """

    speed: float
    until_s: float | None = None
    until_time: float | None = None

    def words(self) -> str:
        """The passage in a sentence, with all its digits."""
        end = f"{said(self.until_s)} m" if self.until_s is not None else f"{said(self.until_time or 0.0)} s"
        return f"{said(self.speed)} m/s until {end}"


class Stretch(NamedTuple):
    """An interval of time with one speed of the head.

    begin, end: [s]; first, last: places of the head then [m]; speed: [m/s]
    passage: its index, None outside all passages; origin: a time [s] and its place [m], from which all others follow
    """

    begin: float
    end: float
    first: float
    last: float
    speed: float
    passage: int | None
    origin: tuple[float, float]

    def time(self, place: float) -> float:
        """Time at which the head is at a place of the stretch [s]."""
        return min(max(self.origin[0] + (place - self.origin[1]) / self.speed, self.begin), self.end)

    def place(self, time: float) -> float:
        """Place of the head at a time of the stretch [m]."""
        return self.origin[1] + (time - self.origin[0]) * self.speed


# With passages 0 to n - 1, node k is the time and the place at which passage k begins, node n where the last one ends;
# node 0 is time 0 at place 0. speeds[k] holds from node k - 1 to node k, and head_speed before node 0 and after node n.
class Clock:
    """The place of the head at any time. Without passages the speed is head_speed, and a time is a place divided by it.

    slowest: the lowest speed at which it moves [m/s]
    """

    def __init__(self, head_speed: float, passages: Sequence[Passage] = ()) -> None:
        self.head_speed, self.passages = head_speed, passages
        self.times, self.places = [0.0], [0.0]
        for k, passage in enumerate(passages):
            time, place = self._ended(k, passage)
            self.times.append(time)
            self.places.append(place)
        self.speeds = [head_speed, *[passage.speed for passage in passages], head_speed]
        self.slowest = min([speed for speed in self.speeds if speed > 0.0]) if passages else head_speed

    def _ended(self, k: int, passage: Passage) -> tuple[float, float]:
        """Time and place at which a passage ends. raises: InvalidValue"""
        time, place = self.times[-1], self.places[-1]
        if passage.until_time is not None:
            if passage.until_time <= time:
                rule = f"must be after the passage begins, at {said(time)} s"
                raise InvalidValue.of(f"passages.{k}.until_time", rule, passage.until_time, "s")
            return passage.until_time, place + (passage.until_time - time) * passage.speed
        until = passage.until_s
        assert until is not None
        if until <= place:
            rule = f"must be further than where the passage begins, at {said(place)} m"
            raise InvalidValue.of(f"passages.{k}.until_s", rule, until, "m")
        return time + (until - place) / passage.speed, until

    def place(self, time: float) -> float:
        """Place of the head at a time [m]."""
        k = bisect_right(self.times, time)
        node = max(k - 1, 0)
        return self.places[node] + (time - self.times[node]) * self.speeds[k]

    def time(self, place: float) -> float:
        """First time at which the head is at a place [s]."""
        k = bisect_left(self.places, place)
        node = max(k - 1, 0)
        time = self.times[node] + (place - self.places[node]) / self.speeds[k]
        return min(time, self.times[k]) if k < len(self.times) else time

    def steady(self, times: Floats) -> Floats:
        """Times (...) at which the head would be at the same places with the constant speed head_speed [s]."""
        if not self.passages:
            return times
        k = np.searchsorted(self.times, times, side="right")
        node = np.maximum(k - 1, 0)
        places = np.array(self.places)[node] + (times - np.array(self.times)[node]) * np.array(self.speeds)[k]
        found: Floats = places / self.head_speed
        return found

    def of_steady(self, time: float) -> float:
        """First time at which the head is at its place at a time of the steady dance [s]."""
        return self.time(time * self.head_speed) if self.passages else time

    def speed(self, times: Floats) -> Floats:
        """Speed of the head at times (...) [m/s]; at a change the new speed."""
        found: Floats = np.array(self.speeds)[np.searchsorted(self.times, times, side="right")]
        return found

    def rounding(self, until: float) -> float:
        """Largest distance of the head from its place at a rounded time up to `until`, if there are passages [m]."""
        return TIME_ROUNDING * max(self.speeds) * max(abs(until), *self.times) if self.passages else 0.0

    def stretches(self, begin: float, until: float) -> Iterator[Stretch]:
        """The stretches of one speed between two times [s], in order."""
        edges = [begin, *(time for time in self.times if self.passages and begin < time < until), until]
        for start, end in pairwise(edges):
            k = bisect_right(self.times, start)
            node, passage = max(k - 1, 0), k - 1 if 0 < k <= len(self.passages) else None
            first, origin = self.place(start), (self.times[node], self.places[node])
            last = self.place(end) if end == until else self.places[self.times.index(end)]
            yield Stretch(start, end, first, last, self.speeds[k], passage, origin)

    def words(self) -> str:
        """The speeds of the head in a sentence."""
        after = f"{said(self.head_speed)} m/s"
        if not self.passages:
            return after
        if len(self.passages) > LISTED:
            return f"{after} after {len(self.passages)} passages given one by one"
        return f"{', '.join(passage.words() for passage in self.passages)}, and then at {after}"


def checked_passages(given: object) -> tuple[Passage, ...]:
    """Passages whose numbers are checked one by one. raises: InvalidValue"""
    rule = "passages must be a list of Passage"
    if not isinstance(given, (list, tuple)):
        raise InvalidValue("passages", f"{rule}, got {given!r:.60}")
    if len(given) > PASSAGES_MAX:
        raise InvalidValue("passages", f"passages must be at most {PASSAGES_MAX}, got {len(given)}")
    return tuple(_checked(f"passages.{k}", passage) for k, passage in enumerate(given))


def _checked(name: str, passage: object) -> Passage:
    if not isinstance(passage, Passage):
        raise InvalidValue(name, f"{name} must be a Passage, got {passage!r:.60}")
    speed = checked_number(f"{name}.speed", passage.speed, "m/s", 0.0, HEAD_SPEED_MAX)
    if 0.0 < speed < HEAD_SPEED_MIN:
        raise InvalidValue.of(
            f"{name}.speed", f"must be 0, for a pause, or at least {HEAD_SPEED_MIN:g} m/s", speed, "m/s"
        )
    place, time = passage.until_s, passage.until_time
    if (place is None) == (time is None):
        got = "neither" if place is None else "both"
        raise InvalidValue(name, f"{name} must end at until_s [m] or at until_time [s], got {got}")
    if place is None:
        return Passage(speed, None, checked_number(f"{name}.until_time", time, "s", -TIME_MAX, TIME_MAX))
    if speed == 0.0:
        raise InvalidValue(f"{name}.until_time", f"{name}.until_time must be given: a pause does not reach until_s")
    return Passage(speed, checked_number(f"{name}.until_s", place, "m", -PLACE_MAX, PLACE_MAX))
