"""Requests on the wire and what they become in core.

Queries are flat, bodies are nested; both are made of the same field groups. Unknown names are refused, and so
are values that are not finite. The limits here are narrower than core's own: they fit a dance in a real place,
so that a length in centimetres is noticed.
"""

from __future__ import annotations

import math
import re
from typing import Annotated, Any, Literal

import numpy as np
from pydantic import BaseModel, ConfigDict, Discriminator, Field, Tag, model_validator
from pydantic_core import PydanticCustomError

from app.settings import check_limit
from core import Dragon, InvalidValue, Spiral
from core.dragon import BENCHES_MAX, Floats

# The last instant of a range may miss `stop` by this share of a step, so that 0 to 0.3 by 0.1 has four instants.
LAST_STEP_TOLERANCE = 1e-9
# An object with more names than this is not looked into.
NAMES_MAX = 100
FEWER_CELLS = "take a larger step, a shorter range or fewer benches"

Length = Annotated[float, Field(ge=1e-3, le=50)]
Width = Annotated[float, Field(ge=1e-3, le=5)]
Overhang = Annotated[float, Field(ge=0, le=5)]
Pitch = Annotated[float, Field(ge=1e-3, le=10, description="Radial advance of the spiral per full turn [m]")]
StartTurns = Annotated[float, Field(gt=0, le=200, description="Turns between the centre and the start [turns]")]
Margin = Annotated[float, Field(ge=0, le=2, description="Clearance that counts as touching [m]")]
Coordinate = Annotated[float, Field(ge=-1e6, le=1e6)]
Instant = Annotated[float, Field(ge=-1e6, le=1e6)]


class Wire(BaseModel):
    """What comes in: no unknown names, no infinities, never changed."""

    model_config = ConfigDict(extra="forbid", frozen=True, allow_inf_nan=False)

    @model_validator(mode="before")
    @classmethod
    def _few_names(cls, value: Any) -> Any:
        # Each unknown name would become an error of its own: 300,000 of them took 2 s (measured 2026-11-21).
        if isinstance(value, dict) and len(value) > NAMES_MAX:
            counts = {"most": NAMES_MAX, "given": len(value)}
            raise PydanticCustomError("too_many_names", "at most {most} names, got {given}", counts)
        return value


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


class SpiralFields(Wire):
    """The spiral of the dance."""

    pitch: Pitch = 0.55
    start_turns: StartTurns = 16.0

    def to_path(self) -> Spiral:
        """raises: InvalidValue"""
        return Spiral(self.pitch, self.start_turns)


class HeadSpeed(Wire):
    """How fast the head dances."""

    head_speed: float = Field(1.0, ge=1e-3, le=20, description="Constant speed of the head [m/s]")


class UniformBody(UniformDragon, strict=True):
    """A head and a body of equal benches, in a body."""


class SpiralPath(SpiralFields, strict=True):
    """An Archimedean spiral, danced inwards."""

    kind: Literal["spiral"] = Field("spiral", description="Kind of path")


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
SHAPES = frozenset({"uniform", "bench_by_bench", "range", "list"})

AnyDragon = Annotated[
    Annotated[UniformBody, Tag("uniform")] | Annotated[BenchByBench, Tag("bench_by_bench")],
    Discriminator(_shape_of_dragon),
]
# A second kind of path turns this into a union told apart by `kind`.
AnyPath = SpiralPath
AnyTimes = Annotated[
    Annotated[TimeSteps, Tag("range")] | Annotated[list[Instant], Field(min_length=1, fail_fast=True), Tag("list")],
    Discriminator(_shape_of_times),
]


class Dance(HeadSpeed, strict=True):
    """A dragon on a path, as the body of a request."""

    dragon: AnyDragon = Field(default_factory=UniformBody, description="The dragon")
    path: AnyPath = Field(default_factory=SpiralPath, description="The path")


class TrajectoryRequest(Dance):
    """Where every handle is at every instant, and how fast."""

    times: AnyTimes = Field(
        default_factory=TimeSteps, description="Instants: evenly spaced, or a list; 0 is the start of the dance [s]"
    )
    decimals: int | None = Field(None, ge=0, le=15, description="Decimals of x, y and speed; null: full precision")

    def to_times(self, handles: int, cells_max: int) -> Floats:
        """Instants (T,) [s]. raises: TooLarge, InvalidValue"""
        if isinstance(self.times, TimeRange):
            return self.times.to_times(handles, cells_max)
        check_limit("times", "instants x handles", len(self.times) * handles, cells_max, FEWER_CELLS)
        return np.array(self.times, dtype=np.float64)


class DanceQuery(HeadSpeed, SpiralFields, UniformDragon):
    """A uniform dragon on a spiral, as query parameters."""


class CollisionQuery(DanceQuery):
    """When do two benches first touch?"""

    margin: Margin = 0.0


class MinimumPitchQuery(UniformDragon):
    """How tight may the spiral be?"""

    turning_diameter: float = Field(
        9.0, ge=2e-3, le=200, description="Diameter of the circle that the head must reach [m]"
    )
    start_turns: StartTurns = 16.0
    margin: Margin = 0.0


class TrajectoryFigureQuery(DanceQuery):
    """Every handle at one instant, drawn."""

    time: Instant = Field(300.0, description="The instant [s]")


class PitchScanQuery(MinimumPitchQuery):
    """First contact against the pitch, drawn."""

    samples: int = Field(101, ge=2, le=401, description="Pitches to sample; jumps between them are searched for")


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
    """Unit of every field by its name, from the end of its description."""
    found = {}
    for model in models:
        for name, field in model.model_fields.items():
            stated = re.search(r"\[([^\]]+)\]$", field.description or "")
            found[name] = stated[1] if stated else ""
        found |= _units(model.__subclasses__())
    return found


# Name of every field of a request -> its unit, empty for a pure number.
UNITS = _units(Wire.__subclasses__())
