"""Requests on the wire and what they become in core.

Queries are flat, bodies are nested; both are made of the same field groups. Unknown names are refused, and so
are values that are not finite.
"""

from __future__ import annotations

import math
import re
from typing import Annotated, Any, get_args

import numpy as np
from pydantic import AfterValidator, Discriminator, Field, Tag
from pydantic_core import PydanticCustomError

from app.settings import check_limit
from app.wire.degrees import Coordinates, Place, place_of
from app.wire.measures import (
    Coordinate,
    CrossCheck,
    Instant,
    Length,
    Margin,
    Overhang,
    SpeedLimit,
    StartTurns,
    TurningDiameter,
    Width,
    Wire,
)
from app.wire.paths import KINDS, AnyPath, SpiralFields, SpiralPath, TurnCircle, TurnFields
from core import Dance, Dragon, InvalidValue, Report, Route, ShortestTurn, Spiral, check, shortest_turn
from core.dragon import BENCHES_MAX
from core.values import Floats

# The last instant of a range may miss `stop` by this share of a step, so that 0 to 0.3 by 0.1 has four instants.
LAST_STEP_TOLERANCE = 1e-9
FEWER_CELLS = "take a larger step, a shorter range or fewer benches"
# Objects and lists in one another: a collection of features of polygons has nine.
VENUE_DEPTH_MAX = 20


class Nothing(Wire):
    """No parameters at all."""


class UniformDragon(Wire):
    """A head and a body of equal benches."""

    benches: int = Field(223, ge=1, le=BENCHES_MAX, description="Number of benches")
    head_length: Length = Field(3.41, description="Length of the head's bench [m]")
    body_length: Length = Field(2.20, description="Length of every other bench [m]")
    width: Width = Field(0.30, description="Width of every bench [m]")
    overhang: Overhang = Field(0.275, description="From a handle to the nearer end of its bench [m]")

    def to_dragon(self, benches_max: int) -> Dragon:
        """raises: TooLarge, InvalidValue"""
        check_limit("dragon.benches", "benches", self.benches, benches_max, "shorten the dragon")
        return Dragon(self.benches, self.head_length, self.body_length, self.width, self.overhang)


class BenchByBench(Wire, strict=True):
    """A dragon given bench by bench, head first; the three lists are equally long."""

    lengths: list[Length] = Field(min_length=1, fail_fast=True, description="Length of each bench [m]")
    widths: list[Width] = Field(min_length=1, fail_fast=True, description="Width of each bench [m]")
    overhangs: list[Overhang] = Field(
        min_length=1, fail_fast=True, description="From a handle to the nearer end of its bench, for each bench [m]"
    )

    def to_dragon(self, benches_max: int) -> Dragon:
        """raises: TooLarge, InvalidValue"""
        check_limit("dragon.lengths", "benches", len(self.lengths), benches_max, "shorten the dragon")
        return Dragon.of(self.lengths, self.widths, self.overhangs)


class HeadSpeed(Wire):
    """How fast the head dances."""

    head_speed: float = Field(1.0, ge=1e-3, le=20, description="Constant speed of the head [m/s]")


class UniformBody(UniformDragon, strict=True):
    """A head and a body of equal benches, in a body."""


class TimeRange(Wire):
    """Evenly spaced instants, both ends included where the step meets them."""

    start: Instant = Field(0.0, description="First instant [s]")
    stop: Instant = Field(300.0, description="Last instant, if the step meets it [s]")
    step: float = Field(1.0, ge=1e-6, le=1e6, description="Between two instants [s]")

    def instants(self) -> int:
        """Number of instants, known before any is made.

        raises: InvalidValue when stop lies before start
        """
        if self.stop < self.start:
            raise InvalidValue(
                "times.stop", f"times.stop must not be before times.start ({self.start:g} s), got {self.stop:g} s"
            )
        return math.floor((self.stop - self.start) / self.step + LAST_STEP_TOLERANCE) + 1

    def to_times(self, handles: int, cells_max: int) -> Floats:
        """Instants (T,) [s]. raises: TooLarge, InvalidValue"""
        instants = self.instants()
        check_limit("times.step", "instants x handles", instants * handles, cells_max, FEWER_CELLS)
        return self.start + self.step * np.arange(instants, dtype=np.float64)


class TimeSteps(TimeRange, strict=True):
    """Evenly spaced instants, in a body."""


def _shape_of_dragon(value: Any) -> str:
    listed = isinstance(value, dict) and not value.keys().isdisjoint(BenchByBench.model_fields)
    return "bench_by_bench" if listed or isinstance(value, BenchByBench) else "uniform"


def _shape_of_times(value: Any) -> str:
    return "list" if isinstance(value, list) else "range"


# Names of shapes: pydantic puts them into the place of an error, though they stand in no body.
SHAPES = frozenset({"uniform", "bench_by_bench", "range", "list"}) | KINDS

AnyDragon = Annotated[
    Annotated[UniformBody, Tag("uniform")] | Annotated[BenchByBench, Tag("bench_by_bench")],
    Discriminator(_shape_of_dragon),
]
AnyTimes = Annotated[
    Annotated[TimeSteps, Tag("range")] | Annotated[list[Instant], Field(min_length=1, fail_fast=True), Tag("list")],
    Discriminator(_shape_of_times),
]


class DanceFields(HeadSpeed, strict=True):
    """A dragon on a path, as the body of a request."""

    dragon: AnyDragon = Field(default_factory=UniformBody, description="The dragon")
    path: AnyPath = Field(default_factory=SpiralPath, description="The path")


class TimedDance(DanceFields):
    """A dance at some instants."""

    times: AnyTimes | None = Field(
        None,
        description="Instants: evenly spaced, or a list; 0 is the start of the dance; null: every second from 0 to "
        "300 s; on a path that is no spiral every second from 0, or if the dance has no 0, from the first at which the "
        "whole dragon is on the path, for 300 s or to the end of the path [s]",
    )

    def to_times(self, dragon: Dragon, path: Spiral | Route, cells_max: int) -> Floats:
        """Instants (T,) [s]. raises: TooLarge, InvalidValue"""
        handles = dragon.benches + 1
        if self.times is None and isinstance(path, Route):
            times = Dance(dragon, path, self.head_speed).default_times
            check_limit("times", "instants x handles", len(times) * handles, cells_max, FEWER_CELLS)
            return times
        if not isinstance(self.times, list):
            return (self.times or TimeSteps()).to_times(handles, cells_max)
        check_limit("times", "instants x handles", len(self.times) * handles, cells_max, FEWER_CELLS)
        return np.array(self.times, dtype=np.float64)


class TrajectoryRequest(TimedDance):
    """Where every handle is at every instant, and how fast."""

    decimals: int | None = Field(None, ge=0, le=15, description="Decimals of x, y and speed; null: full precision")


class ClearanceRequest(TimedDance):
    """How near do two benches come over time, on any path?"""


def _shallow(value: dict[str, Any] | None) -> dict[str, Any] | None:
    """Deeper ones exhaust the stack of whoever walks them by recursion."""
    level: list[Any] = [value]
    for _ in range(VENUE_DEPTH_MAX):
        level = [inner for outer in level for inner in _inside(outer)]
    if level:
        raise PydanticCustomError("too_deep", "objects and lists in one another", {"most": VENUE_DEPTH_MAX})
    return value


def _inside(outer: Any) -> list[Any]:
    """Objects and lists right inside of an object or a list."""
    entries = outer.values() if isinstance(outer, dict) else outer if isinstance(outer, list) else ()
    return [inner for inner in entries if isinstance(inner, (dict, list))]


class PlacedDance(DanceFields):
    """A dance, and the place where it is danced."""

    venue: Annotated[dict[str, Any] | None, AfterValidator(_shallow)] = Field(
        None,
        description="GeoJSON with coordinates in metres, or in degrees: the square (the polygon named square, else the "
        "first one; its holes are outside) and the obstacles in it; null: an endless plain",
    )
    coordinates: Coordinates | None = Field(
        None,
        description="Of the venue: metres, or degrees of longitude and latitude (WGS 84), which are laid out on the "
        "plane that touches the earth in the middle of the square's bounding box, x to the east and y to the north "
        "from there; null: what the venue's crs says, else metres",
    )

    def to_place(self, dragon: Dragon) -> Place:
        """raises: InvalidValue"""
        if self.venue is None:
            if self.coordinates is not None:
                words = f"got {self.coordinates} without a venue: give the venue, or leave coordinates out"
                raise InvalidValue("coordinates", f"coordinates must stand beside the venue that they are of, {words}")
            return Place()
        return place_of(self.venue, self.coordinates, dragon)


class CheckRequest(PlacedDance):
    """Can this dragon dance this path here?"""

    margin: Margin = 0.0
    cross_check: CrossCheck = "dragon"
    speed_limit: SpeedLimit | None = Field(None, description="Of every handle; null: none [m/s]")
    start: Instant | None = Field(
        None, description="From when; null: the start of the dance, or when the whole dragon is on the path [s]"
    )
    stop: Instant | None = Field(None, description="Until when; null: the end of the run [s]")

    def to_report(self, dragon: Dragon, path: Spiral | Route, place: Place | None = None) -> Report:
        """place: as to_place() gives it. raises: InvalidValue, OutsideRun"""
        return check(
            Dance(dragon, path, self.head_speed),
            venue=(place or self.to_place(dragon)).venue,
            margin=self.margin,
            speed_limit=self.speed_limit,
            start=self.start,
            stop=self.stop,
        )


class TrajectoryFigureRequest(PlacedDance):
    """Every handle at one instant, drawn on any path."""

    time: Instant | None = Field(
        None,
        description="The instant; null: 0, or if the dance has no 0, when the whole dragon is on the path [s]",
    )

    def to_time(self, dragon: Dragon, path: Spiral | Route) -> float:
        """The instant [s]. raises: InvalidValue"""
        return Dance(dragon, path, self.head_speed).default_start if self.time is None else self.time


class ContactFigureRequest(PlacedDance):
    """The dance at first contact, drawn on any path."""

    margin: Margin = 0.0
    start: Instant | None = Field(
        None, description="From when; null: 0, or if the dance has no 0, when the whole dragon is on the path [s]"
    )
    stop: Instant | None = Field(None, description="Until when; null: the end of the run [s]")

    def to_start(self, dragon: Dragon, path: Spiral | Route) -> float:
        """From when [s]. raises: InvalidValue"""
        return Dance(dragon, path, self.head_speed).default_start if self.start is None else self.start


class DanceQuery(HeadSpeed, SpiralFields, UniformDragon):
    """A uniform dragon on a spiral, as query parameters."""


class ContactQuery(DanceQuery):
    """The dance at first contact."""

    margin: Margin = 0.0


class CollisionQuery(ContactQuery):
    """When do two benches first touch, or come nearer than a margin?"""

    cross_check: CrossCheck = "dragon"


class CircleQuery(UniformDragon):
    """A circle that the head of a uniform dragon must reach, from a start on a spiral of any pitch."""

    turning_diameter: TurningDiameter = Field(9.0, description="Diameter of the circle that the head must reach [m]")
    start_turns: StartTurns = 16.0
    margin: Margin = 0.0


class MinimumPitchQuery(CircleQuery):
    """How tight may the spiral be?"""

    cross_check: CrossCheck = "dragon"


class TrajectoryFigureQuery(DanceQuery):
    """Every handle at one instant, drawn."""

    time: Instant = Field(300.0, description="The instant [s]")


class PitchScanQuery(CircleQuery):
    """First contact against the pitch, drawn."""

    samples: int = Field(101, ge=2, le=401, description="Pitches to sample; jumps between them are searched for")


class TurnQuery(TurnFields):
    """Two tangent arcs between two coils."""


class ShortestTurnQuery(TurnCircle, UniformDragon):
    """How deep inside its circle may a turn begin?"""

    margin: Margin = 0.0

    def to_shortest_turn(self, benches_max: int) -> ShortestTurn:
        """raises: TooLarge, InvalidValue"""
        return shortest_turn(
            self.to_dragon(benches_max),
            self.pitch,
            self.turning_diameter / 2,
            self.ratio,
            start_turns=self.start_turns,
            margin=self.margin,
        )


class MaximumHeadSpeedQuery(TurnFields, UniformDragon):
    """How fast may the head dance through a turn?"""

    speed_limit: SpeedLimit = Field(2.0, description="Of every handle [m/s]")


class ClearanceQuery(TimeRange, DanceQuery):
    """How near do two benches come over time?"""


class BenchPose(Wire, strict=True):
    """One bench, anywhere."""

    x: Coordinate = Field(description="Centre [m]")
    y: Coordinate = Field(description="Centre [m]")
    heading: float = Field(ge=-1000, le=1000, description="Direction, counter-clockwise from the x axis [rad]")
    length: Length = Field(description="Along the heading [m]")
    width: Width = Field(description="Across the heading [m]")


class OverlapsRequest(Wire, strict=True):
    """Which of these benches overlap?"""

    benches: list[BenchPose] = Field(min_length=1, fail_fast=True, description="The benches, in order")
    margin: Margin = 0.0
    chained: bool = Field(True, description="Consecutive benches are neighbours, which are never a checked pair")

    def to_poses(self, poses_max: int) -> tuple[Floats, Floats, Floats]:
        """Poses (n, 3), lengths (n,) [m] and widths (n,) [m]. raises: TooLarge"""
        check_limit("benches", "benches", len(self.benches), poses_max, "ask for fewer in one request")
        rows = np.array([(b.x, b.y, b.heading, b.length, b.width) for b in self.benches], dtype=np.float64)
        return rows[:, :3], rows[:, 3], rows[:, 4]


def _units(models: list[type[Wire]]) -> dict[str, str]:
    """Unit of every field by its name, from the end of its description; of a kind of path also by kind and name."""
    found: dict[str, str] = {}
    for model in sorted(models, key=lambda model: "kind" in model.model_fields):
        kind = model.model_fields.get("kind")
        for name, field in model.model_fields.items():
            stated = re.search(r"\[([^\]]+)\]$", field.description or "")
            unit = stated[1] if stated else ""
            if kind:
                for word in get_args(kind.annotation):
                    found[f"{word}.{name}"] = unit
            found.setdefault(name, unit)
        for name, unit in _units(model.__subclasses__()).items():
            found.setdefault(name, unit)
    return found


# Name of every field of a request -> its unit, empty for a pure number.
UNITS = _units(Wire.__subclasses__())
