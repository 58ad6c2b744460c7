"""Performance: several dances on one clock, among the obstacles of one venue.

Part k is at time t where its own dance is at t - delay. Before its head is at the beginning of its path, and the whole
dragon on it, the dragon stands there; after the end of its path it stays there. A fold ends the performance, because
the dance has no continuation then.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from core.checks import checked_list, checked_number, checked_type
from core.dance import Dance, EndReason, whole_seconds
from core.display import ROWS_MOST, Name, Readable, display, format_range
from core.dragon import Stray, checked_stray
from core.errors import InvalidValue, OutsideRun
from core.language import counted, say
from core.names import checked_name
from core.passages import TIME_MAX
from core.quantities import Given, Parameter, Quantity, Value, bound, quantities
from core.values import Floats, Interval
from core.venue import Venue

# Largest delay, forwards and back [s]: eleven days. Times of a performance keep 1e-10 s then.
DELAY_MAX = 1e6
# Largest number of parts, and of the benches of all together [1].
PARTS_MAX = 200
BENCHES_MAX = 1_000_000
# Length of the stretch of its dance that stands for a dragon which stands during a whole interval [s].
STANDING = 1e-3
COLOUR = re.compile("#[0-9a-fA-F]{6}")


@dataclass(frozen=True, repr=False)
class Part(Readable):
    """One dance of a performance.

    dance: the dance
    delay: time of the performance at time 0 of the dance [s]
    name: name of the dragon; None without
    colour: of the dragon in pictures, as #rrggbb; None: by its turn

    raises: InvalidValue

    >>> from core import Dragon, Spiral
    >>> Part(Dance(Dragon(20), Spiral()), delay=4.0, name="gold").delay
    4.0
    """

    dance: Dance
    delay: float = 0.0
    name: str | None = None
    colour: str | None = None

    def _line(self) -> str:
        span = format_range((self.begin, self.end), "s")
        return say("{dragon}, dances from {span}", dragon=self.dance.dragon._line(), span=span)

    def __post_init__(self) -> None:
        checked_type("dance", self.dance, Dance)
        object.__setattr__(self, "delay", checked_number("delay", self.delay, "s", -DELAY_MAX, DELAY_MAX))
        if self.name is not None:
            checked_name("name", self.name)
        if self.colour is not None and not (isinstance(self.colour, str) and COLOUR.fullmatch(self.colour)):
            raise InvalidValue("colour", "must be #rrggbb, such as #b3261e", got=Given(self.colour))

    @property
    def begin(self) -> float:
        """Time of the performance from which on it dances [s]."""
        return self.dance.begin + self.delay

    @property
    def end(self) -> float:
        """Time of the performance at which it folds, or is at the end of its path [s]."""
        return self.dance.end.time + self.delay

    @property
    def folds(self) -> bool:
        """True if a bench folds at the end."""
        return self.dance.end.reason is EndReason.FOLD

    def own_time(self, time: float) -> float:
        """Time of its own dance at a time of the performance, at which it is at its place [s]."""
        return min(max(time - self.delay, self.dance.begin), self.dance.end.time)

    def own_span(self, begin: float, until: float) -> Interval:
        """The stretch of its own dance between two times of the performance [s]; of a dragon that stands, STANDING at
        its place."""
        least, most = self.dance.begin, self.dance.end.time
        first = least if begin <= self.begin else self.own_time(begin)
        last = most if until >= self.end else self.own_time(until)
        if last - first < STANDING:
            return max(least, last - STANDING), min(most, first + STANDING)
        return first, last


@dataclass(frozen=True, slots=True, repr=False)
class PerformanceEnd(Readable):
    """End of a performance on which no benches of two dragons come within the margin, or touch if it is 0.

    reason: fold: a bench cannot follow any more; end: all paths end; stop: the requested time ends
    time: time of the end [s]
    dragon: the dragon that folds; None if none does
    bench: the bench that folds; None if none does

    >>> from core import Dragon, Line, Route
    >>> street = Dance(Dragon(5), Route([Line((0.0, 0.0), (40.0, 0.0))]))
    >>> Performance([Part(street), Part(street, delay=9.0)]).end
    <PerformanceEnd: reason end, time 49 s>
    """

    reason: EndReason
    time: float
    dragon: int | None = None
    bench: int | None = None


@dataclass(frozen=True, repr=False)
class Performance(Readable):
    """Dances on one clock, frozen and checked once.

    parts: at least one, in the order of the dragons' numbers
    venue: the square and its obstacles; None without
    begin: time from which on the first of them dances [s]
    end: end of the performance

    raises: InvalidValue for no part or too many, for two equal names, and for a part that has not begun when another
        one folds

    >>> from core import Dance, Dragon, Spiral
    >>> two = [Part(Dance(Dragon(60), Spiral(1.1, 8.0, rotation=turn))) for turn in (0.0, 3.141592653589793)]
    >>> performance = Performance(two)
    >>> performance.begin, round(performance.end.time, 3)
    (0.0, 217.61)
    """

    parts: Sequence[Part]
    venue: Venue | None = None
    begin: float = field(init=False, repr=False, compare=False)
    end: PerformanceEnd = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        parts = tuple(checked_list("parts", self.parts, "must be a list of Part objects"))
        if not 1 <= len(parts) <= PARTS_MAX:
            rule = "must be at least one" if not parts else "must be at most {most}"
            raise InvalidValue("parts", rule, got=len(parts), most=PARTS_MAX)
        for k, part in enumerate(parts):
            checked_type(f"parts.{k}", part, Part)
        object.__setattr__(self, "parts", parts)
        if self.venue is not None:
            checked_type("venue", self.venue, Venue)
        benches = sum(part.dance.dragon.benches for part in parts)
        if benches > BENCHES_MAX:
            raise InvalidValue("parts", "must have at most {most} benches in all", got=benches, most=BENCHES_MAX)
        self._refuse_equal_names()
        object.__setattr__(self, "begin", min(part.begin for part in parts))
        object.__setattr__(self, "end", self._end())
        self._refuse_late_parts()

    def _refuse_equal_names(self) -> None:
        first: dict[str, int] = {}
        for k, part in enumerate(self.parts):
            if part.name is not None and first.setdefault(part.name, k) != k:
                other = Parameter(f"parts.{first[part.name]}.name")
                raise InvalidValue(f"parts.{k}.name", "must differ from {other}", got=Given(part.name), other=other)

    def _end(self) -> PerformanceEnd:
        folding = [k for k, part in enumerate(self.parts) if part.folds]
        if not folding:
            return PerformanceEnd(EndReason.END, max(part.end for part in self.parts))
        k = min(folding, key=lambda k: self.parts[k].end)
        return PerformanceEnd(EndReason.FOLD, self.parts[k].end, k, self.parts[k].dance.end.bench)

    def _refuse_late_parts(self) -> None:
        for k, part in enumerate(self.parts):
            if self.end.dragon is not None and part.begin >= self.end.time:
                rule = "must let {part} begin, which is at {begin}, before bench {bench} of {other} folds at {end}"
                other, times = Parameter(f"parts.{self.end.dragon}"), quantities("s", 9, begin=part.begin)
                end_values: dict[str, Value] = {"bench": self.end.bench or 0, "end": bound(self.end.time, 9, "s")}
                got = Quantity(part.delay, "s")
                raise InvalidValue(
                    f"parts.{k}.delay", rule, got=got, part=Parameter(f"parts.{k}"), other=other, **times, **end_values
                )

    def _drawn_lines(self) -> list[Floats]:
        return [way for part in self.parts for way in part._drawn_lines()]

    def _rows(self) -> list[tuple[str, str]]:
        parts: list[tuple[str, str]] = [
            (Name(self.name_of(k)), part._line()) for k, part in enumerate(self.parts[:ROWS_MOST])
        ]
        more = len(self.parts) - len(parts)
        parts += [("dragons", say("and {count} more", count=more))] * (more > 0)
        return [*parts, *Readable._rows(self)[1:], ("begin", display(self.begin, "s")), ("end", self.end._line())]

    def _line(self) -> str:
        names = ", ".join(self.name_of(k) for k in range(min(len(self.parts), 6)))
        more = ", ..." if len(self.parts) > 6 else ""
        dragons = counted(len(self.parts), "{count} dragon", "{count} dragons")
        span = format_range((self.begin, self.end.time), "s")
        return say("{dragons} ({names}), from {span}", dragons=dragons, names=names + more, span=span)

    def name_of(self, k: int) -> str:
        """The name of a dragon, or its number."""
        return self.parts[k].name or say("dragon {k}", k=k)

    def number_of(self, part: int | str) -> int:
        """The number of a dragon, from its name or its number. raises: InvalidValue"""
        names = [one.name for one in self.parts]
        if isinstance(part, str) and part in names:
            return names.index(part)
        if isinstance(part, (int, np.integer)) and not isinstance(part, bool) and 0 <= part < len(names):
            return int(part)
        rule = "must be a dragon's name, or its number below {count}"
        raise InvalidValue("part", rule, got=Given(part), count=len(names))

    @property
    def default_times(self) -> Floats:
        """Whole seconds (T,) from `begin` on, for 300 s or to the end [s]; only `begin` if there is none between."""
        return whole_seconds(self.begin, self.end.time)

    def checked_stray(self, stray: float | Stray) -> float:
        """The largest stray of a hole of any dragon [m]. raises: InvalidValue"""
        return max(checked_stray(stray, part.dance.dragon) for part in self.parts)

    def span(self, start: float | None = None, stop: float | None = None) -> Interval:
        """start and stop [s], checked to lie between begin and end and in this order.

        None: `begin` for start, `end` for stop
        raises: InvalidValue; OutsideRun
        """
        last = self.end.time
        begin = self.begin if start is None else checked_number("start", start, "s", -TIME_MAX, TIME_MAX)
        until = last if stop is None else checked_number("stop", stop, "s", -TIME_MAX, TIME_MAX)
        if begin < self.begin:
            least = bound(self.begin, 6, "s", up=True)
            rule = "must be at least {least}, when the first dragon is on its path"
            raise OutsideRun("start", rule, got=Quantity(begin, "s"), least=least)
        for name, time, wrong in (("stop", until, until > last), ("start", begin, stop is None and begin >= last)):
            if wrong:
                rule = "must be at most {end}" if name == "stop" else "must be before {end}"
                raise OutsideRun(name, f"{rule}, when {{why}}", got=Quantity(time, "s"), **self._ending())
        if until <= begin:
            after = Quantity(begin, "s", 9)
            raise InvalidValue("stop", "must be after start ({start})", got=Quantity(until, "s"), start=after)
        return begin, until

    @property
    def ending(self) -> str:
        """What ends it, as a clause."""
        if self.end.dragon is None:
            return say("the last path ends")
        return say("bench {bench} of {dragon} folds", bench=self.end.bench, dragon=self.name_of(self.end.dragon))

    def _ending(self) -> dict[str, Value]:
        return {"end": bound(self.end.time, 9, "s"), "why": self.ending}
