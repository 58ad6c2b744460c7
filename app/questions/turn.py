"""The question turn: two arcs between two coils."""

from __future__ import annotations

from typing import Self

from pydantic import Field

import core
from app.wire.fields import Answer, Wire
from app.wire.paths import TurnFields, TurnPath
from app.wire.question import Command, Question, Terms
from core.language import say
from core.values import Point


class TurnQuery(TurnFields):
    """Two tangent arcs between two coils."""


class TurnRequest(Wire, strict=True):
    """Two tangent arcs between two coils, as a path."""

    path: TurnPath = Field(default_factory=lambda: TurnPath(kind="turn"), description="The turn")


class Turn(Answer):
    """Two tangent arcs between two coils: the first clockwise, the second counter-clockwise.

    pitch: pitch of both coils [m]
    turning_diameter: diameter of the circle in which the turn lies [m]
    ratio: radius of the first arc divided by that of the second
    entry_radius: distance of the entry from the centre [m]
    exit_radius: distance of the exit from the centre [m]
    radii: radii of both arcs [m]
    centres: centres of both arcs, x and y [m]
    angles: angle of each arc [rad]
    entry: start of the turn, x and y [m]
    tangent_point: point where the two arcs meet, x and y, or where the curvature of the clothoid between them is 0 [m]
    exit: end of the turn, x and y [m]
    length: length of the turn: both arcs, and clothoids [m]
    """

    pitch: float
    turning_diameter: float
    ratio: float
    entry_radius: float
    exit_radius: float
    radii: Point
    centres: tuple[Point, Point]
    angles: Point
    entry: Point
    tangent_point: Point
    exit: Point
    length: float

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
