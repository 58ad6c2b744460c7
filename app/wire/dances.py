"""Dragons, instants and dances in request bodies, and their conversion to core.

Queries are flat (question.py) and bodies are nested; both consist of the same groups of fields and become the same
dance.
"""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from typing import TYPE_CHECKING, Annotated, Any, Self, TypeVar

import numpy as np
from pydantic import Discriminator, Field, Tag

from app.settings import Settings
from app.wire.beats import BarsBody, music_of
from app.wire.benches import BenchCsv
from app.wire.clocks import BeginClock, PassageBody, StartClock, clock_at_zero, passages_of
from app.wire.fields import (
    AS_WHOLE,
    Coordinates,
    HeadSpeed,
    Instant,
    Length,
    Overhang,
    UniformDragon,
    Width,
    Wire,
    check_limit,
    measure,
    shallow,
)
from app.wire.paths import KINDS, AnyPath, SpiralPath
from core import Dance, Dragon, InvalidValue, Performance
from core.language import phrase
from core.passages import PASSAGES_MAX, Passage
from core.people.beats import Music
from core.quantities import Given, Parameter, quantities
from core.values import Floats

if TYPE_CHECKING:
    from app.wire.degrees import Place

# The last instant of a range may miss `stop` by this share of a step, so that 0 to 0.3 by 0.1 has four instants.
LAST_STEP_TOLERANCE = 1e-9
FEWER_CELLS = phrase("take a larger step, a shorter range or fewer benches")
# Nesting depth of objects and lists: a collection of features of polygons has nine levels.
VENUE_DEPTH_MAX = 20
# Fields that only a dragon given bench by bench has.
BENCH_LISTS = ("lengths", "widths", "overhangs")


# Number of a bench, 0 for the head.
BenchNumber = Annotated[int, Field(ge=0), AS_WHOLE]
Names = Annotated[
    list[str] | None,
    Field(description="Names of the benches, such as a household or a person, head first; empty: none"),
]


class BenchByBench(Wire, strict=True):
    """A dragon given bench by bench, head first; the three lists are equally long."""

    lengths: list[Length] = measure("m", "Length of each bench", min_length=1, fail_fast=True)
    widths: list[Width] = measure("m", "Width of each bench", min_length=1, fail_fast=True)
    overhangs: list[Overhang] = measure(
        "m", "Distance from a handle to the nearer end of its bench, for each bench", min_length=1, fail_fast=True
    )

    names: Names = None

    @property
    def benches(self) -> int:
        return len(self.lengths)

    def to_dragon(self, benches_max: int) -> Dragon:
        """raises: TooLarge, InvalidValue"""
        check_limit(
            "dragon.lengths", "benches must be at most {most} here", self.benches, benches_max, "shorten the dragon"
        )
        return Dragon.of(self.lengths, self.widths, self.overhangs).named(self.names or ())


class UniformBody(UniformDragon, strict=True):
    """A head and a body of equal benches, in a request body."""

    names: Names = None

    def to_dragon(self, benches_max: int) -> Dragon:
        """raises: TooLarge, InvalidValue"""
        return super().to_dragon(benches_max).named(self.names or ())


class TimeRange(Wire):
    """Evenly spaced instants from start to stop; stop is included if the step meets it."""

    start: Instant = measure("s", "First instant", 0.0)
    stop: Instant = measure("s", "Last instant, if the step meets it", 300.0)
    step: float = measure("s", "Time between two instants", 1.0, ge=1e-6, le=1e6)

    @property
    def stated(self) -> str:
        """Names of the ends that the caller gave: within() moves only others."""
        return ", ".join(name for name in ("start", "stop") if name in self.model_fields_set)

    def instants(self) -> int:
        """Number of instants, computed before any is allocated. raises: InvalidValue when stop lies before start"""
        if self.stop < self.start:
            values = quantities("s", got=self.stop, begin=self.start) | {"start": Parameter("times.start")}
            raise InvalidValue("times.stop", "must not be before {start} ({begin})", **values)
        return math.floor((self.stop - self.start) / self.step + LAST_STEP_TOLERANCE) + 1

    def within(self, dance: Dance | Performance) -> Self:
        """The range; a start or stop that was left out is moved to the nearest whole second of the run."""
        first, stated = float(dance.default_times[0]), self.model_fields_set
        stop = self.stop if "stop" in stated else max(first, min(self.stop, math.floor(dance.end.time)))
        # A stop before the run is refused by its own name.
        start = self.start if "start" in stated else min(first, stop)
        return self.model_copy(update={"start": start, "stop": stop})

    def times_of(self, dance: Dance | Performance, cells_max: int) -> Floats:
        """Instants (T,) [s], none of them after the stop. raises: TooLarge, InvalidValue"""
        instants = self.instants()
        check_limit(
            "times.step",
            "instants x handles must be at most {most} here",
            instants * handles_of(dance),
            cells_max,
            FEWER_CELLS,
        )
        return np.minimum(self.start + self.step * np.arange(instants, dtype=np.float64), self.stop)


def handles_of(dance: Dance | Performance) -> int:
    """Number of the handles of a dragon, or of all dragons."""
    dances = [dance] if isinstance(dance, Dance) else [part.dance for part in dance.parts]
    return sum(one.dragon.benches + 1 for one in dances)


def bench_of(field: str, word: int | str, dragon: Dragon) -> int:
    """The bench with that name, or else that number. raises: InvalidValue"""
    if isinstance(word, str):
        if word and word in dragon.names:
            return dragon.names.index(word)
        if not re.fullmatch(r"\d{1,9}", word, re.ASCII):
            raise InvalidValue(field, "must be the name or the number of a bench", got=Given(word))
    if int(word) >= dragon.benches:
        raise InvalidValue(field, "must be at most {most}, the tail", got=int(word), most=dragon.benches - 1)
    return int(word)


class TimeSteps(TimeRange, strict=True):
    """Evenly spaced instants, in a request body."""


def _shape_of_dragon(value: Any) -> str:
    if isinstance(value, BenchCsv) or (isinstance(value, dict) and "csv" in value):
        return "bench_csv"
    listed = isinstance(value, dict) and not value.keys().isdisjoint(BENCH_LISTS)
    return "bench_by_bench" if listed or isinstance(value, BenchByBench) else "uniform"


# Shape of the values over which a sweep varies a parameter; they have the unit of that parameter.
AXIS = "axis"
# Names of shapes, which pydantic puts into the place of an error although no body contains them.
SHAPES = frozenset({"uniform", "bench_by_bench", "bench_csv", "range", "list", AXIS}) | KINDS

# The type with required fields comes first: generated clients take the first that fits.
AnyDragon = Annotated[
    Annotated[BenchByBench, Tag("bench_by_bench")]
    | Annotated[BenchCsv, Tag("bench_csv")]
    | Annotated[UniformBody, Tag("uniform")],
    Discriminator(_shape_of_dragon),
]
AnyTimes = Annotated[
    Annotated[TimeSteps, Tag("range")] | Annotated[list[Instant], Field(min_length=1, fail_fast=True), Tag("list")],
    Discriminator(lambda value: "list" if isinstance(value, list) else "range"),
]


class DragonFields(Wire, strict=True):
    """A dragon, as the body of a request."""

    dragon: AnyDragon = Field(default_factory=UniformBody, description="The dragon")

    @property
    def benches(self) -> int:
        return self.dragon.benches

    def to_dragon(self, benches_max: int) -> Dragon:
        """raises: TooLarge, InvalidValue"""
        return self.dragon.to_dragon(benches_max)

    def most_benches(self, settings: Settings) -> int:
        """Largest number of benches: a dance that does not repeat itself is searched bench by bench."""
        return settings.benches_max if isinstance(self.dragon, UniformBody) else settings.checked_benches_max


class PathFields(HeadSpeed, DragonFields, strict=True):
    """A dragon on a path."""

    passages: list[PassageBody] = measure(
        "",
        "Stretches from time 0 on in which the head goes at other speeds than head_speed, one after the "
        "other; after the last one, head_speed holds. Contacts depend only on the place of the head; the time of a "
        "contact is the first time at which the head is there",
        [],
        label="Slower, faster, pauses",
        max_length=PASSAGES_MAX,
        fail_fast=True,
    )
    beats: list[BarsBody] = Field(
        [],
        max_length=PASSAGES_MAX,
        fail_fast=True,
        description="Bars of a drum from time 0 on, in place of passages: on each beat the head goes one step; after "
        "the last bar, head_speed holds. Plan, cue cards and film count in bars and beats, and the film has the drum",
    )
    path: AnyPath = Field(default_factory=SpiralPath, description="The path")

    @property
    def music(self) -> Music | None:
        """The beats of the dance; None without them. raises: InvalidValue"""
        return music_of(self.beats)

    def most_benches(self, settings: Settings) -> int:
        return super().most_benches(settings) if self.path.kind == "spiral" else settings.checked_benches_max

    def to_dance(self, benches_max: int) -> Dance:
        """raises: TooLarge, InvalidValue"""
        dragon, path = self.dragon.to_dragon(benches_max), self.path.to_path()
        return Dance(dragon, path, self.head_speed, self._passages())

    def _passages(self) -> Sequence[Passage]:
        """The passages, of which beats give their own. raises: InvalidValue"""
        if (music := self.music) is None:
            return passages_of(self.passages)
        if self.passages:
            other = Parameter("beats")
            raise InvalidValue("passages", "must be left out beside {other}, which give the speeds", other=other)
        return music.passages


class TypedWishes(Wire, strict=True):
    """What a dance was wished for on the page when it was proposed, as typed there."""

    end_by: str | None = Field(None, max_length=40, description="When it must end: a time of day, or minutes")
    laps: str | None = Field(None, max_length=40, description="How often it goes around")


class DanceFields(PathFields, strict=True):
    """A dragon on a path, as the body of a request."""

    start_clock: StartClock = None
    begin_clock: BeginClock = None
    wishes: TypedWishes | None = Field(
        None, description="What the next dance on the page is wished for; no answer depends on it"
    )


Starting = TypeVar("Starting", bound=DanceFields)


def clock_of(request: DanceFields, dance: Dance | Performance) -> str | None:
    """The time of day at time 0 of a dance, or of several on one clock; None if the request gives none.

    raises: InvalidValue if it gives it twice
    """
    if request.begin_clock is None:
        return request.start_clock
    if request.start_clock is not None:
        rule = "must be left out beside {other}, the time of day at time 0"
        other = Parameter("start_clock")
        raise InvalidValue("begin_clock", rule, got=Given(request.begin_clock), other=other)
    start = getattr(request, "start", None)
    return clock_at_zero(request.begin_clock, dance.begin if start is None else start)


def starting(request: Starting, dance: Dance | Performance) -> Starting:
    """A request for a span of a dance, which begins at the time of day that it says the dance begins at."""
    if request.begin_clock is None or getattr(request, "start", None) is not None:
        return request
    return request.model_copy(update={"start": dance.begin})


class SpanFields(Wire):
    """A stretch of a dance."""

    start: Instant | None = measure(
        "s",
        "Start time; default: when the whole dragon is on the path, with the head at its beginning or further on",
        None,
    )
    stop: Instant | None = measure("s", "End time; default: the end of the run", None)


class TimedDance(DanceFields):
    """A dance at given instants."""

    times: AnyTimes | None = measure(
        "s",
        "Instants, evenly spaced or as a list; 0 is the start of the dance; null: every second from 0 to 300 s. On a "
        "path other than a spiral, null is every second from 0 (or, if the dance has no time 0, from the first time "
        "at which the whole dragon is on the path) for 300 s or to the end of the path; a start or stop that is left "
        "out is moved into that run too. Of several dances, null is every second from their beginning for 300 s or to "
        "their end",
        None,
    )

    def instants(self) -> int:
        """Number of instants; an estimate for those that are left to the path. raises: InvalidValue"""
        times = self.times or TimeSteps()
        return len(times) if isinstance(times, list) else times.instants()

    def times_of(self, dance: Dance | Performance, cells_max: int) -> Floats:
        """Instants (T,) [s]. raises: TooLarge, InvalidValue"""
        times: list[float] | Floats
        is_endless = self.path.kind == "spiral" and isinstance(dance, Dance)
        if isinstance(self.times, list):
            times = self.times
        elif self.times is None and not is_endless:
            times = dance.default_times
        else:
            steps = self.times or TimeSteps()
            return (steps if is_endless else steps.within(dance)).times_of(dance, cells_max)
        check_limit(
            "times",
            "instants x handles must be at most {most} here",
            len(times) * handles_of(dance),
            cells_max,
            FEWER_CELLS,
        )
        return np.asarray(times, dtype=np.float64)


class VenueFields(Wire):
    """A venue, and the unit of its coordinates."""

    venue: Annotated[dict[str, Any] | None, shallow(VENUE_DEPTH_MAX)] = Field(
        None,
        description="GeoJSON with coordinates in metres or in degrees: the square (the polygon named square, otherwise "
        "the first one; its holes are outside) and the obstacles in it; null: an endless plain",
    )
    coordinates: Coordinates | None = Field(
        None,
        description="Unit of the venue's coordinates: metres, or degrees of longitude and latitude (WGS 84). Degrees "
        "are projected onto the plane that touches the earth in the middle of the square's bounding box, where x "
        "points east and y north; null: as the venue's crs says, otherwise metres",
    )

    def to_place(self, dragon: Dragon) -> Place:
        """raises: InvalidValue"""
        from app.wire.degrees import Place, place_of  # Venues take 50 ms to import, and most questions have none.

        if self.venue is None:
            if self.coordinates is not None:
                rule = "must stand beside a venue, whose unit it gives, got {unit} without one"
                advice = "give the venue, or leave coordinates out"
                raise InvalidValue("coordinates", f"{rule}: {advice}", unit=self.coordinates)
            return Place()
        return place_of(self.venue, self.coordinates, dragon)


class PlacedDance(VenueFields, DanceFields):
    """A dance and its venue."""
