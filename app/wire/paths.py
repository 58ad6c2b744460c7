"""Paths in requests, distinguished by `kind`: spiral, turn, waypoints, and a route of pieces.

A refusal of core is renamed to its place in the body, because core does not put `path.` before the fields of a turn.
"""

from __future__ import annotations

import math
from dataclasses import fields
from typing import Annotated, Any, Literal

from pydantic import ConfigDict, Discriminator, Field, Tag

import core
from app.wire.fields import (
    AS_WHOLE,
    Angle,
    Coordinate,
    Margin,
    Pitch,
    SpiralFields,
    StartTurns,
    TurningDiameter,
    Wire,
    check_limit,
    measure,
)
from core import InvalidValue, Route, Spiral
from core.quantities import Quantity

# A sharp zigzag of 1,000 points, or a route of 1,000 arcs, becomes a path in 0.02 s (measured 2026-11-21).
POINTS_MAX = 1_000
PIECES_MAX = 1_000
# Largest sum over the clothoids of a route of length times larger curvature [rad]: 10,000 rows for the kernels, as many
# as a sharp zigzag of 1,000 points has.
TURNED_MAX = 2_500

Radius = Annotated[float, Field(ge=1e-3, le=1e4)]
Curvature = Annotated[float, Field(ge=-1e3, le=1e3)]
Point = Annotated[list[Coordinate], Field(min_length=2, max_length=2)]
Leg = Annotated[int, Field(ge=0, lt=POINTS_MAX), AS_WHOLE]
Start = Annotated[float, measure("m", "Distance of the head from the beginning of the path at time 0", ge=-1e6, le=1e6)]
# Longest clothoid of a turn [m].
CLOTHOID_MAX = 100.0
Middle = Annotated[
    float | None,
    measure(
        "m", "Length of a clothoid between the two arcs of the turn, which leads the curvature evenly from one to the "
        "other; default: none, so that the curvature jumps there", ge=1e-3, le=CLOTHOID_MAX,
    ),
]  # fmt: skip
Ends = Annotated[
    float,
    measure("m", "Length of the clothoids between the coils and the arcs, if there is one in the middle", ge=0,
            le=CLOTHOID_MAX),
]  # fmt: skip
# An entry deeper inside the circle makes the turn shorter.
EntryRadius = Annotated[
    float | None,
    measure(
        "m", "Distance from the centre at which the turn begins; default: on the circle",
        label="Turn entry", hint="from the centre", ge=1e-3, le=100,
    ),
]  # fmt: skip


ExitRadius = Annotated[
    float | None,
    measure(
        "m", "Distance from the centre at which the turn ends; default: that of its entry",
        label="Turn exit", hint="from the centre", ge=1e-3, le=100,
    ),
]  # fmt: skip


class WayToCircle(Wire):
    """A circle that the head must reach from a start on a spiral of any pitch."""

    turning_diameter: TurningDiameter = measure("m", "Diameter of the circle that the head must reach", 9.0)
    start_turns: StartTurns = 16.0


class Circle(WayToCircle):
    """A way to a circle, with a margin on it."""

    margin: Margin = 0.0

    def to_circle(self) -> dict[str, Any]:
        """Arguments of core."""
        return {"turning_radius": self.turning_diameter / 2, "start_turns": self.start_turns, "margin": self.margin}


class TurnCircle(Wire):
    """Two coils, and the circle in which the dance turns from one to the other."""

    pitch: Pitch = 1.7
    turning_diameter: TurningDiameter = measure(
        "m", "Diameter of the circle in which the turn lies", 9.0, label="Turning circle", hint="its diameter"
    )
    ratio: float = measure(
        "", "Radius of the first arc divided by that of the second", 2.0,
        label="Arc ratio", hint="first : second", ge=0.01, le=100,
    )  # fmt: skip
    start_turns: StartTurns = 16.0


class TurnFields(TurnCircle):
    """A coil inwards, two tangent arcs, and the same coil outwards, rotated by half a turn; or clothoids between them.
    Time 0: the head enters the turn."""

    entry_radius: EntryRadius = None
    exit_radius: ExitRadius = None
    middle: Middle = None
    ends: Ends = 0.0

    def to_turn(self) -> core.Turn | core.ClothoidTurn:
        """raises: InvalidValue"""
        circle = self.pitch, self.turning_diameter / 2, self.ratio
        turns, entry, leaving = self.start_turns, self.entry_radius, self.exit_radius
        if self.middle is None:
            if self.ends:
                rule = "must be 0 where no clothoid is in the middle"
                raise InvalidValue("ends", rule, got=Quantity(self.ends, "m"))
            return core.Turn(*circle, start_turns=turns, entry_radius=entry, exit_radius=leaving)
        return core.ClothoidTurn(
            *circle, middle=self.middle, ends=self.ends, start_turns=turns, entry_radius=entry, exit_radius=leaving
        )

    def to_path(self) -> core.Turn | core.ClothoidTurn:
        """raises: InvalidValue, named by its place in a body"""
        try:
            return self.to_turn()
        except InvalidValue as error:
            raise error.with_field(f"path.{error.field}") from error


class SpiralPath(SpiralFields):
    """An Archimedean spiral, danced inwards."""

    # A body without a kind is a spiral too, but the schema requires the kind because it discriminates the paths.
    model_config = ConfigDict(strict=True, json_schema_extra={"required": ["kind"]})

    kind: Literal["spiral"] = Field("spiral", description="Kind of path")
    centre: Point = measure("m", "Centre of the spiral, x and y; only places depend on it", [0.0, 0.0])
    rotation: Angle = measure("rad", "Rotation of the whole spiral about its centre", 0.0)
    clockwise: bool = Field(True, description="Direction of the dance; false: the mirror image, counter-clockwise")

    def to_path(self) -> Spiral:
        """raises: InvalidValue"""
        return Spiral(self.pitch, self.start_turns, _point(self.centre), self.rotation, self.clockwise)


class TurnPath(TurnFields, strict=True):
    """A turn between two coils."""

    kind: Literal["turn"] = Field(description="Kind of path")


class LinePiece(Wire, strict=True):
    """A straight piece."""

    kind: Literal["line"] = Field(description="Kind of piece")
    start: Point = measure("m", "Start, x and y")
    end: Point = measure("m", "End, x and y")

    def to_piece(self) -> core.Piece:
        return core.Line(_point(self.start), _point(self.end))


class ArcPiece(Wire, strict=True):
    """Part of a circle."""

    kind: Literal["arc"] = Field(description="Kind of piece")
    centre: Point = measure("m", "Centre of the circle, x and y")
    radius: Radius = measure("m", "Radius of the circle")
    start_angle: Angle = measure("rad", "Direction from the centre to the start of the arc")
    sweep: Angle = measure("rad", "Angle covered, counter-clockwise positive")

    def to_piece(self) -> core.Piece:
        return core.Arc(_point(self.centre), self.radius, self.start_angle, self.sweep)


class CoilPiece(Wire, strict=True):
    """Part of a spiral: inwards (clockwise) if it ends nearer to its centre, else outwards (counter-clockwise)."""

    kind: Literal["coil"] = Field(description="Kind of piece")
    pitch: Pitch = 0.55
    start_turns: float = measure("turns", "Turns between the centre and the start of the coil", ge=0, le=200)
    end_turns: float = measure("turns", "Turns between the centre and the end of the coil", ge=0, le=200)
    centre: Point = measure("m", "Centre of the spiral, x and y", [0.0, 0.0])
    rotation: Angle = measure("rad", "Rotation of the whole spiral about its centre", 0.0)

    def to_piece(self) -> core.Piece:
        return core.Coil(self.pitch, self.start_turns, self.end_turns, _point(self.centre), self.rotation)


class ClothoidPiece(Wire, strict=True):
    """A curve whose curvature changes evenly along it; at the larger one it would turn by at most 1,000 rad."""

    kind: Literal["clothoid"] = Field(description="Kind of piece")
    start: Point = measure("m", "Start, x and y")
    heading: Angle = measure("rad", "Direction at the start")
    start_curvature: Curvature = measure("1/m", "Curvature at the start, counter-clockwise positive")
    end_curvature: Curvature = measure("1/m", "Curvature at the end")
    length: float = measure("m", "Length along the curve", label="Length", ge=1e-3, le=1e4)

    @property
    def turned(self) -> float:
        """Angle by which it would turn at the larger of its curvatures [rad]."""
        return max(abs(self.start_curvature), abs(self.end_curvature)) * self.length

    def to_piece(self) -> core.Piece:
        curvatures = self.start_curvature, self.end_curvature
        return core.Clothoid(_point(self.start), self.heading, *curvatures, self.length)


class WaypointsPiece(Wire, strict=True):
    """A smooth curve through points, with continuous curvature."""

    kind: Literal["waypoints"] = Field(description="Kind of piece, or of path")
    points: list[Point] = measure(
        "m", "Points on the curve, x and y", min_length=2, max_length=POINTS_MAX, fail_fast=True
    )
    start_heading: Angle | None = measure("rad", "Direction at the start; default: zero curvature at the start", None)
    end_heading: Angle | None = measure("rad", "Direction at the end; default: zero curvature at the end", None)

    def to_piece(self) -> core.Piece:
        return core.Waypoints(tuple(map(_point, self.points)), self.start_heading, self.end_heading)


AnyPiece = Annotated[LinePiece | ArcPiece | CoilPiece | ClothoidPiece | WaypointsPiece, Field(discriminator="kind")]


def _placed(piece: AnyPiece, place: str) -> core.Piece:
    """The piece of core. raises: InvalidValue, named by its place in a body"""
    try:
        return piece.to_piece()
    except InvalidValue as error:
        raise error.renamed(lambda name: ".".join([place, *name.split(".")[1:]])) from error


class WaypointsPath(WaypointsPiece, strict=True):
    """A path through points: each leg between two of them is a curve or a straight line. It is smooth but at corners
    without a radius."""

    straight: list[Leg] = Field(
        default_factory=list,
        max_length=POINTS_MAX,
        fail_fast=True,
        description="Legs that are straight, from 0: leg k goes from point k to the next one. The others are curves, "
        "which leave and enter the straight legs beside them in their direction",
    )
    radius: float = measure(
        "m",
        "Radius of the arcs that round a corner of two straight legs, smaller where a leg is too short for it. 0 "
        "leaves the corners, each of which must turn by less than 90 degrees: handles pass them, and speeds jump there",
        5.0,
        ge=0.0,
        le=1e4,
    )
    start: Start = 0.0

    def to_path(self) -> Route:
        """raises: InvalidValue"""
        return core.Legs(
            [_point(point) for point in self.points],
            self.straight,
            radius=self.radius,
            start_heading=self.start_heading,
            end_heading=self.end_heading,
            start=self.start,
        )


def _point(value: list[float]) -> tuple[float, float]:
    return (value[0], value[1])


class RoutePath(Wire, strict=True):
    """Pieces joined into one path; place and direction must agree where two meet, but two lines may meet at a corner of
    less than 90 degrees."""

    kind: Literal["route"] = Field(description="Kind of path")
    pieces: list[AnyPiece] = Field(
        min_length=1, max_length=PIECES_MAX, fail_fast=True, description="Pieces in the order in which they are danced"
    )
    start: Start = 0.0

    def to_path(self) -> Route:
        """raises: TooLarge, InvalidValue"""
        points = sum(len(piece.points) for piece in self.pieces if isinstance(piece, WaypointsPiece))
        check_limit("path.pieces", "waypoints must be at most {most} here", points, POINTS_MAX, "take fewer")
        turned = math.ceil(sum(piece.turned for piece in self.pieces if isinstance(piece, ClothoidPiece)))
        check_limit(
            "path.pieces",
            "radians of clothoids must be at most {most} here",
            turned,
            TURNED_MAX,
            "take fewer or shorter ones",
        )
        return Route([_placed(piece, f"path.pieces.{k}") for k, piece in enumerate(self.pieces)], self.start)


def _kind(value: Any) -> str:
    """Kind of a path; spiral if none is given or the value is not an object."""
    return str(value.get("kind", "spiral") if isinstance(value, dict) else getattr(value, "kind", "spiral"))


# Schema of each kind of path: OpenAPI's discriminator, because pydantic leaves the choice to a function.
BY_KIND = {kind: f"#/components/schemas/{kind.title()}Path" for kind in ("spiral", "turn", "route", "waypoints")}
AnyPath = Annotated[
    Annotated[SpiralPath, Tag("spiral")]
    | Annotated[TurnPath, Tag("turn")]
    | Annotated[RoutePath, Tag("route")]
    | Annotated[WaypointsPath, Tag("waypoints")],
    Discriminator(_kind),
    Field(json_schema_extra={"discriminator": {"propertyName": "kind", "mapping": BY_KIND}}),
]
KINDS = frozenset({*BY_KIND, "line", "arc", "coil", "clothoid"})


def path_of(route: Route) -> dict[str, Any]:
    """A route of lines, arcs, coils and clothoids in a body."""
    return {"kind": "route", "start": route.start, "pieces": [_body_of(piece) for piece in route.pieces]}


def _body_of(piece: core.Piece) -> dict[str, Any]:
    numbers = ["pitch", "radius", "start_angle", "sweep", "start_turns", "end_turns", "rotation"]
    numbers += ["heading", "start_curvature", "end_curvature", "length"]
    own = {field.name for field in fields(piece)}
    body: dict[str, Any] = {"kind": type(piece).__name__.lower()}
    body |= {name: list(getattr(piece, name)) for name in ("start", "end", "centre") if name in own}
    return body | {name: getattr(piece, name) for name in numbers if name in own}
