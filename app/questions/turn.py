"""The question turn: two arcs between two coils."""

from __future__ import annotations

from typing import Self

from pydantic import Field

import core
from app.wire.answers import Point
from app.wire.fields import Answer, Wire, measure
from app.wire.paths import TurnFields, TurnPath
from app.wire.question import Command, Question, Terms
from core.language import say


class TurnQuery(TurnFields):
    """Two tangent arcs between two coils."""


class TurnRequest(Wire, strict=True):
    """Two tangent arcs between two coils, as a path."""

    path: TurnPath = Field(default_factory=lambda: TurnPath(kind="turn"), description="The turn")


class Turn(Answer):
    """Two tangent arcs between two coils: the first clockwise, the second counter-clockwise."""

    pitch: float = measure("m", "Pitch of both coils")
    turning_diameter: float = measure("m", "Diameter of the circle in which the turn lies")
    ratio: float = Field(description="Radius of the first arc divided by that of the second")
    entry_radius: float = measure("m", "Distance of the entry from the centre")
    exit_radius: float = measure("m", "Distance of the exit from the centre")
    radii: Point = measure("m", "Radii of both arcs")
    centres: tuple[Point, Point] = measure("m", "Centres of both arcs, x and y")
    angles: Point = measure("rad", "Angle of each arc")
    entry: Point = measure("m", "Start of the turn, x and y")
    tangent_point: Point = measure(
        "m", "Point where the two arcs meet, x and y, or where the curvature of the clothoid between them is 0"
    )
    exit: Point = measure("m", "End of the turn, x and y")
    length: float = measure("m", "Length of the turn: both arcs, and clothoids")

    @classmethod
    def of(cls, result: core.Turn | core.ClothoidTurn) -> Self:
        return cls.from_result(result, turning_diameter=2 * result.turning_radius)


def turn(request: TurnQuery | TurnRequest, terms: Terms) -> Turn:
    """Two tangent arcs that lead from a spiral inwards to the same spiral, rotated by half a turn, outwards."""
    return Turn.of(request.to_turn() if isinstance(request, TurnQuery) else request.path.to_path())


QUESTION = Question(
    turn,
    Turn,
    flat=TurnQuery,
    body=TurnRequest,
    cost=lambda request: 1e-3,
    command=Command(
        "Two tangent arcs that lead from a spiral inwards to the same spiral, rotated by half a turn, outwards.",
        lambda request: say("Turn"),
    ),
)
