"""Dance: a dragon that follows a path, and the times of its run; Clock: the travel of the head at a time.

A dance is a motion of the head along its path, with a clock for its times. The travel of the head is its s. Contacts
depend only on it, so searches work with travels, and the clock turns a travel into its first time.
"""

from __future__ import annotations

import math
from bisect import bisect_left, bisect_right
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace
from enum import StrEnum
from functools import cached_property
from itertools import pairwise

import numpy as np
from numpy.typing import ArrayLike

from core import kernels
from core.checks import checked_number, checked_type
from core.display import Readable
from core.dragon import Dragon
from core.errors import InvalidValue, OutsideRun
from core.language import phrase
from core.passages import HEAD_SPEED_MAX, HEAD_SPEED_MIN, TIME_MAX, Passage, Period, checked_passages, nodes
from core.paths.following import bends_widely, earliest_travel
from core.paths.refusal import refuse_tight_bends
from core.paths.route import Route
from core.paths.spiral import Spiral, end_theta
from core.quantities import Given, Quantity, Value, bound, fill_message, quantities
from core.values import Floats, Interval

# Length of the default table of whole seconds, as in the contest [s].
DEFAULT_SPAN = 300
# A run that stops nearer to its fold than this is searched up to the fold [m of head travel]. Handle speeds grow
# without bound there, so steps would shrink to nothing; a bound on the remaining motion replaces them.
NEAR_FOLD = 1e-5
# Largest relative error of a time that is turned into a travel and back [1]: each way three operations, and the
# rounding of a node's time and travel, 10 u in all.
TIME_ROUNDING = 2e-15


class EndReason(StrEnum):
    """Reason for the end of a run: a chord has no continuous solution any more, the head is at the centre of the spiral
    or at the end of the route, or the requested time is over.

    >>> Dance(Dragon(), Spiral()).end.reason
    <EndReason.FOLD: 'fold'>
    """

    FOLD = "fold"
    CENTRE = "centre"
    END = "end"
    STOP = "stop"


@dataclass(frozen=True, slots=True, repr=False)
class RunEnd(Readable):
    """End of a run on which no two benches come within the margin, or touch if it is 0.

    reason: fold: a bench cannot follow any more; centre: the head reaches the centre; end: the path ends; stop: the
        requested time ends
    time: time of the end [s]
    theta: polar angle of the head at that time, on a spiral that folds or ends [rad]
    bench: the bench that folds; None if none does

    >>> end = Dance(Dragon(), Spiral()).end
    >>> end.reason.value, round(end.time, 6), end.bench
    ('fold', 432.917924, 0)
    """

    reason: EndReason
    time: float
    theta: float | None
    bench: int | None

    @property
    def why(self) -> str:
        """The reason as a clause in words."""
        return fill_message(self.template, self.values)

    @property
    def template(self) -> str:
        """The reason as the template of a clause, for messages."""
        if self.reason is EndReason.FOLD:
            return phrase("bench {bench} folds")
        return phrase("the head is at the centre") if self.reason is EndReason.CENTRE else phrase("the path ends")

    @property
    def values(self) -> dict[str, Value]:
        """The values of that template."""
        return {} if self.bench is None else {"bench": self.bench}


# Nodes: see core/passages.py; without passages, the only node is time 0 at travel 0. speeds[k] holds from node k - 1 to
# node k, and head_speed before the first node and after the last one.
class Clock:
    """The travel of the head at any time. Without passages the speed is head_speed: a time is a travel divided by it.

    slowest: the lowest speed at which it moves [m/s]
    """

    def __init__(self, head_speed: float, passages: Sequence[Passage] = ()) -> None:
        self.head_speed, self.passages = head_speed, passages
        self.times, self.travels = nodes(passages) if passages else ([0.0], [0.0])
        self.speeds = [head_speed, *[passage.speed for passage in passages], head_speed]
        self.slowest = min(speed for speed in self.speeds if speed > 0.0) if passages else head_speed

    def travel(self, time: float) -> float:
        """Travel of the head at a time [m]."""
        k = bisect_right(self.times, time)
        node = max(k - 1, 0)
        return self.travels[node] + (time - self.times[node]) * self.speeds[k]

    def time(self, travel: float) -> float:
        """First time at which the head has travelled this far [s]."""
        k = bisect_left(self.travels, travel)
        node = max(k - 1, 0)
        time = self.times[node] + (travel - self.travels[node]) / self.speeds[k]
        return min(time, self.times[k]) if k < len(self.times) else time

    def steady(self, times: Floats) -> Floats:
        """Times (...) at which the head would be at the same places with the constant speed head_speed [s]."""
        if not self.passages:
            return times
        k = np.searchsorted(self.times, times, side="right")
        node = np.maximum(k - 1, 0)
        travels = np.array(self.travels)[node] + (times - np.array(self.times)[node]) * np.array(self.speeds)[k]
        steady: Floats = travels / self.head_speed
        return steady

    def of_steady(self, time: float) -> float:
        """First time at which the head is at its place at a time of the steady dance [s]."""
        return self.time(time * self.head_speed) if self.passages else time

    def speed(self, times: Floats) -> Floats:
        """Speed of the head at times (...) [m/s]; at a change the new speed."""
        return np.array(self.speeds)[np.searchsorted(self.times, times, side="right")]

    def rounding(self, until: float) -> float:
        """Largest distance of the head from its place at a rounded time up to `until`, if there are passages [m]."""
        return TIME_ROUNDING * max(self.speeds) * max(abs(until), *self.times) if self.passages else 0.0

    def periods(self, begin: float, until: float) -> Iterator[Period]:
        """The periods of one speed between two times [s], in order."""
        times = [begin, *(time for time in self.times if self.passages and begin < time < until), until]
        for start, end in pairwise(times):
            k = bisect_right(self.times, start)
            node, passage = max(k - 1, 0), k - 1 if 0 < k <= len(self.passages) else None
            first, origin = self.travel(start), (self.times[node], self.travels[node])
            last = self.travel(end) if end == until else self.travels[self.times.index(end)]
            yield Period(start, end, first, last, self.speeds[k], passage, origin)


@dataclass(frozen=True, repr=False)
class Dance(Readable):
    """A dragon that follows a path. Every question about a given path takes a dance.

    dragon: the benches
    path: the path
    head_speed: speed of the head outside the passages [m/s]
    passages: parts with other speeds, one after another from time 0 on
    end: end of the run: the fold or the centre of a spiral, the end of a route

    raises: InvalidValue for values of other types, for a dragon that cannot stand at the start of a spiral
        (path.start_turns), and for a route that a bench cannot follow (path); `earliest` refuses a short route

    >>> dance = Dance(Dragon(), Spiral())
    >>> dance.end.reason.value, round(dance.end.time, 3)
    ('fold', 432.918)
    """

    dragon: Dragon
    path: Spiral | Route
    head_speed: float = 1.0
    passages: Sequence[Passage] = ()
    end: RunEnd = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        checked_type("dragon", self.dragon, Dragon)
        checked_type("path", self.path, (Spiral, Route))
        object.__setattr__(self, "head_speed", checked_head_speed(self.head_speed))
        if type(self.passages) is not tuple or self.passages:
            object.__setattr__(self, "passages", checked_passages(self.passages))
        object.__setattr__(self, "end", _end(self.dragon, self.path, self.clock))

    def __repr__(self) -> str:
        more = f", passages={self.passages!r}" if self.passages else ""
        return f"Dance(dragon={self.dragon!r}, path={self.path!r}, head_speed={self.head_speed!r}{more})"

    @cached_property
    def clock(self) -> Clock:
        """Times and travels of the head."""
        return Clock(self.head_speed, self.passages)

    @property
    def steady(self) -> Dance:
        """The same dance without passages, its path in its own frame: the same contacts, at clock.steady() times."""
        path = self.path.standard
        return Dance(self.dragon, path, self.head_speed) if self.passages or path is not self.path else self

    def leading(self, benches: int) -> Dance:
        """The dance of the first benches, which those behind do not affect. The whole dance on a path with tight bends:
        fewer benches begin before bends where those have passed."""
        if self.path.spiral is None and not bends_widely(self.dragon, self.path.as_route(self.path.end)):
            return self
        return replace(self, dragon=self.dragon.leading(benches))

    def steady_times(self, times: Floats) -> Floats:
        """Times (...) at which the steady dance is at the same places [s]; always inside its run, despite rounding."""
        return np.clip(self.clock.steady(times), self.steady.earliest, self.steady.end.time)

    def played(self, head_speed: float) -> Dance:
        """The whole dance faster or slower, with this head_speed [m/s]; all places stay the same."""
        faster = head_speed / self.head_speed
        passages = [
            Passage(one.speed * faster, one.until_s, None if one.until_time is None else one.until_time / faster)
            for one in self.passages
        ]
        return Dance(self.dragon, self.path, head_speed, passages)

    @cached_property
    def earliest(self) -> float:
        """Time at which the last handle is at the beginning of the path [s]; -TIME_MAX if the path has no beginning.

        raises: InvalidValue (path) for a route too short for the dragon
        """
        if self.path.tail_begin is None:
            return -TIME_MAX
        return self.clock.time(earliest_travel(self.dragon, self.path, self.path.tail_begin))

    @property
    def begin(self) -> float:
        """Time at which the head is at the beginning of the path and the whole dragon on it [s].

        raises: InvalidValue (path) for a route too short for the dragon
        """
        return max(self.clock.time(self.path.begin), self.earliest)

    @property
    def default_start(self) -> float:
        """Start time of a question that gives none [s]: 0, or `begin` if the whole dragon is not on the path at 0.

        raises: InvalidValue (path) for a route too short for the dragon
        """
        return 0.0 if self.begin <= 0.0 <= self.end.time else self.begin

    @property
    def default_times(self) -> Floats:
        """Whole seconds (T,) from `default_start` on, for DEFAULT_SPAN or to the end of the run [s].

        Only `default_start` if the run is too short for a whole second.
        raises: InvalidValue (path) for a route too short for the dragon
        """
        return whole_seconds(self.default_start, self.end.time)

    def _rows(self) -> list[tuple[str, str]]:
        return [*super()._rows(), ("end", self.end._line())]

    def times(self, instants: ArrayLike) -> Floats:
        """The instants as a (T,) or () array of finite numbers within the run [s].

        raises: InvalidValue (times); OutsideRun (times) after the end of the run, or before the whole dragon is on
            the path
        """
        time = checked_instants(instants)
        earliest = self.earliest
        late, early = np.flatnonzero(time > self.end.time), np.flatnonzero(time < earliest)
        if late.size:
            raise self.after_the_end(time, int(late[0]))
        if early.size:
            k = int(early[0])
            raise self._before_the_start(_instant(time, k), float(time.flat[k]))
        return time

    def span(self, start: float | None = None, stop: float | None = None) -> Interval:
        """start and stop [s], checked to lie in the run and in this order.

        None: `default_start` for start, the end of the run for stop
        raises: InvalidValue; OutsideRun
        """
        until = self.end.time if stop is None else checked_number("stop", stop, "s", -TIME_MAX, TIME_MAX)
        begin = checked_number("start", self.default_start if start is None else start, "s", -TIME_MAX, TIME_MAX)
        if begin < self.earliest:
            raise self._before_the_start("start", begin)
        if until > self.end.time:
            raise self._past_the_end("stop", "must be at most", until)
        if until <= begin:
            if stop is None:
                raise self._past_the_end("start", "must be before", begin)
            after = Quantity(begin, "s", 9)
            raise InvalidValue("stop", "must be after start ({start})", got=Quantity(until, "s"), start=after)
        return begin, until

    def whole_span(self, start: float | None = None, stop: float | None = None) -> Interval:
        """span() of a question about the whole dance, which starts at `begin` unless it gives a start [s]."""
        return self.span(self.begin if start is None else start, stop)

    def _before_the_start(self, name: str, time: float) -> OutsideRun:
        rule, least = (
            "must be at least {least}, when the whole dragon is on the path",
            bound(self.earliest, 6, "s", up=True),
        )
        return OutsideRun(name, rule, got=Quantity(time, "s"), least=least)

    def _past_the_end(self, name: str, rule: str, time: float) -> OutsideRun:
        values = {"end": bound(self.end.time, 9, "s"), **self.end.values}
        return OutsideRun(name, f"{rule} {{end}}, when {self.end.template}", got=Quantity(time, "s"), **values)

    def after_the_end(self, time: Floats, index: int) -> OutsideRun:
        """The error for a time after the end of the run."""
        return self._past_the_end(_instant(time, index), "must be at most", float(time.flat[index]))

    def ends_by(self, stop: float) -> bool:
        """True if a run until `stop` [s] ends at a fold."""
        return stop >= self.end.time and self.end.reason is EndReason.FOLD

    def nears_fold(self, stop: float) -> bool:
        """True if a run until `stop` [s] ends at a fold or within NEAR_FOLD of it."""
        return self.ends_by(self.clock.time(self.clock.travel(stop) + NEAR_FOLD))


def checked_head_speed(head_speed: float) -> float:
    """The head speed [m/s], if it is in the allowed range."""
    return checked_number("head_speed", head_speed, "m/s", HEAD_SPEED_MIN, HEAD_SPEED_MAX)


def _end(dragon: Dragon, path: Spiral | Route, clock: Clock) -> RunEnd:
    """End of the run."""
    spiral = path.spiral
    if spiral is None:  # a route has bends to check and an end, a spiral a fold or a centre
        refuse_tight_bends(dragon, path.as_route(path.end), clock.time)
        return RunEnd(EndReason.END, clock.time(path.end), None, None)
    theta, bench = end_theta(dragon, spiral)
    if theta >= spiral.start_theta:
        rule, got = "must be more than {least}, where bench {bench} of this dragon folds", spiral.start_turns
        values = quantities("turns", 6, least=theta / math.tau) | {"bench": bench or 0}
        raise InvalidValue("path.start_turns", rule, got=Quantity(got, "turns"), **values)
    time = clock.time(spiral.length - spiral.growth * float(kernels.spiral_arc(theta)))
    return RunEnd(EndReason.CENTRE if bench is None else EndReason.FOLD, time, theta, bench)


def whole_seconds(start: float, end: float) -> Floats:
    """Whole seconds (T,) from start on, for DEFAULT_SPAN or to the end [s]; only start if there is none between."""
    # Both are whole numbers, so rounding cannot pass the end.
    first, last = math.ceil(start), math.floor(end)
    if first > last:
        return np.array([start])
    return np.arange(first, min(first + DEFAULT_SPAN, last) + 1, dtype=np.float64)


def checked_instants(instants: ArrayLike) -> Floats:
    """The instants as a (T,) or () array of finite numbers [s]. raises: InvalidValue (times)"""
    try:
        array = np.asarray(instants)
    except ValueError as error:
        raise InvalidValue("times", "must be a list of numbers in seconds, or one number") from error
    # NumPy would also accept "1", True and None as numbers.
    if array.dtype.kind not in "iuf":
        raise InvalidValue("times", "must be a list of numbers in seconds, or one number", got=Given(instants))
    if array.ndim > 1:
        raise InvalidValue("times", "must be a flat list of numbers in seconds, or one number")
    time = np.array(array, dtype=np.float64, order="C")
    wrong = np.flatnonzero(~np.isfinite(time))
    if wrong.size:
        got = Quantity(float(time.flat[wrong[0]]), "s")
        raise InvalidValue(_instant(time, int(wrong[0])), "must be finite", got=got)
    return time


def _instant(time: Floats, k: int) -> str:
    """Field name of one of the times."""
    return f"times.{k}" if time.ndim else "times"
