"""Paths on the wire, told apart by `kind`: spiral, turn, waypoints, and a route of pieces.

What core refuses is named by its place in the body: core knows no `path.` before the fields of a turn, and knows a
curve through waypoints as the only piece of a route.
"""

from __future__ import annotations

from typing import Annotated, Any, Literal

from pydantic import ConfigDict, Discriminator, Field, Tag

import core
from app.wire.models import Angle, Coordinate, Pitch, StartTurns, TurningDiameter, Wire, check_limit, measure
from core import InvalidValue, Route, Spiral

# A sharp zigzag of 1,000 points becomes a path in 0.02 s, 1,000 arcs too (measured 2026-11-21).
POINTS_MAX = 1_000
PIECES_MAX = 1_000

Radius = Annotated[float, Field(ge=1e-3, le=1e4)]
Point = Annotated[list[Coordinate], Field(min_length=2, max_length=2)]
Start = Annotated[
    float,
    measure("m", "How far from the beginning of the path the head is at time 0", ge=-1e6, le=1e6),
]
# An entry deeper inside the circle makes the turn shorter.
EntryRadius = Annotated[float | None, measure("m", "Where the turn begins; null: on the circle", ge=1e-3, le=100)]


class SpiralFields(Wire):
    """The spiral of the dance."""

    pitch: Pitch = 0.55
    start_turns: StartTurns = 16.0

    def to_path(self) -> Spiral:
        """raises: InvalidValue"""
        return Spiral(self.pitch, self.start_turns)


class TurnCircle(Wire):
    """Two coils, and the circle in which the dance turns from the one to the other."""

    pitch: Pitch = 1.7
    turning_diameter: TurningDiameter = measure("m", "Diameter of the circle in which the turn lies", 9.0)
    ratio: float = Field(2.0, ge=0.01, le=100, description="Radius of the first arc over that of the second")
    start_turns: StartTurns = 16.0


class TurnFields(TurnCircle):
    """A coil inwards, two tangent arcs and the same coil outwards; time 0 is when the head enters the first arc."""

    entry_radius: EntryRadius = None

    def to_turn(self) -> core.Turn:
        """raises: InvalidValue"""
        return core.Turn(
            self.pitch,
            self.turning_diameter / 2,
            self.ratio,
            start_turns=self.start_turns,
            entry_radius=self.entry_radius,
        )

    def to_path(self) -> core.Turn:
        """raises: InvalidValue, named by the place in a body"""
        try:
            return self.to_turn()
        except InvalidValue as error:
            raise error.named(f"path.{error.field}") from error


class SpiralPath(SpiralFields):
    """An Archimedean spiral, danced inwards."""

    # A body without a kind is a spiral too, but a client must name what tells the paths apart.
    model_config = ConfigDict(strict=True, json_schema_extra={"required": ["kind"]})

    kind: Literal["spiral"] = Field("spiral", description="Kind of path")


class TurnPath(TurnFields, strict=True):
    """A turn between two coils."""

    kind: Literal["turn"] = Field(description="Kind of path")


class LinePiece(Wire, strict=True):
    """A straight piece."""

    kind: Literal["line"] = Field(description="Kind of piece")
    start: Point = measure("m", "Where it begins, x and y")
    end: Point = measure("m", "Where it ends, x and y")

    def to_piece(self) -> core.Piece:
        return core.Line(_point(self.start), _point(self.end))


class ArcPiece(Wire, strict=True):
    """Part of a circle."""

    kind: Literal["arc"] = Field(description="Kind of piece")
    centre: Point = measure("m", "Centre of the circle, x and y")
    radius: Radius = measure("m", "Radius of the circle")
    start_angle: Angle = measure("rad", "Direction from the centre to where it begins")
    sweep: Angle = measure("rad", "Angle covered, counter-clockwise positive")

    def to_piece(self) -> core.Piece:
        return core.Arc(_point(self.centre), self.radius, self.start_angle, self.sweep)


class CoilPiece(Wire, strict=True):
    """Part of a spiral: inwards (clockwise) if it ends nearer to its centre, else outwards (counter-clockwise)."""

    kind: Literal["coil"] = Field(description="Kind of piece")
    pitch: Pitch = 0.55
    start_turns: float = measure("turns", "Turns between the centre and where it begins", ge=0, le=200)
    end_turns: float = measure("turns", "Turns between the centre and where it ends", ge=0, le=200)
    centre: Point = measure("m", "Centre of the spiral, x and y", [0.0, 0.0])
    rotation: Angle = measure("rad", "Of the whole spiral about its centre", 0.0)

    def to_piece(self) -> core.Piece:
        return core.Coil(self.pitch, self.start_turns, self.end_turns, _point(self.centre), self.rotation)


class WaypointsPiece(Wire, strict=True):
    """A smooth curve through points, without a jump of curvature."""

    kind: Literal["waypoints"] = Field(description="Kind of piece, or of path")
    points: list[Point] = measure("m", "Points to pass, x and y", min_length=2, max_length=POINTS_MAX, fail_fast=True)
    start_heading: Angle | None = measure("rad", "Direction at the start; null: no curvature there", None)
    end_heading: Angle | None = measure("rad", "Direction at the end; null: no curvature there", None)

    def to_piece(self) -> core.Piece:
        return core.Waypoints(tuple(map(_point, self.points)), self.start_heading, self.end_heading)


def _placed(piece: LinePiece | ArcPiece | CoilPiece | WaypointsPiece, place: str) -> core.Piece:
    """The piece of core. raises: InvalidValue, named by its place in a body"""
    try:
        return piece.to_piece()
    except InvalidValue as error:
        raise error.named(error.field.replace(piece.kind, place, 1)) from error


class WaypointsPath(WaypointsPiece, strict=True):
    """A smooth curve through points as the whole path."""

    start: Start = 0.0

    def to_path(self) -> Route:
        """raises: InvalidValue"""
        try:
            return Route((_placed(self, "path"),), self.start)
        except InvalidValue as error:
            raise error.named(error.field.replace("path.pieces.0", "path", 1)) from error


def _point(value: list[float]) -> tuple[float, float]:
    return (value[0], value[1])


AnyPiece = Annotated[LinePiece | ArcPiece | CoilPiece | WaypointsPiece, Field(discriminator="kind")]


class RoutePath(Wire, strict=True):
    """Pieces joined into one path; where two meet, place and direction agree."""

    kind: Literal["route"] = Field(description="Kind of path")
    pieces: list[AnyPiece] = Field(
        min_length=1, max_length=PIECES_MAX, fail_fast=True, description="In the order they are danced"
    )
    start: Start = 0.0

    def to_path(self) -> Route:
        """raises: TooLarge, InvalidValue"""
        points = sum(len(piece.points) for piece in self.pieces if isinstance(piece, WaypointsPiece))
        check_limit("path.pieces", "waypoints", points, POINTS_MAX, "take fewer")
        return Route([_placed(piece, f"path.pieces.{k}") for k, piece in enumerate(self.pieces)], self.start)


def _kind(value: Any) -> str:
    """What a path says it is; a spiral if it does not say, or is no object at all."""
    kind = value.get("kind", "spiral") if isinstance(value, dict) else getattr(value, "kind", "spiral")
    return kind if isinstance(kind, str) else str(kind)


AnyPath = Annotated[
    Annotated[SpiralPath, Tag("spiral")]
    | Annotated[TurnPath, Tag("turn")]
    | Annotated[RoutePath, Tag("route")]
    | Annotated[WaypointsPath, Tag("waypoints")],
    Discriminator(_kind),
]
# What OpenAPI needs to know of AnyPath, whose choice pydantic leaves to a function.
BY_KIND: dict[str, Any] = {
    "propertyName": "kind",
    "mapping": {
        "spiral": "#/components/schemas/SpiralPath",
        "turn": "#/components/schemas/TurnPath",
        "route": "#/components/schemas/RoutePath",
        "waypoints": "#/components/schemas/WaypointsPath",
    },
}
KINDS = frozenset({"spiral", "turn", "route", "waypoints", "line", "arc", "coil"})
