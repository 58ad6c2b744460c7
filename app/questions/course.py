"""The question course: the points of a path, and its bends that are too tight."""

from __future__ import annotations

from pydantic import Field

import core
from app.wire.answers import Point
from app.wire.dances import DragonFields
from app.wire.paths import AnyPath, SpiralPath
from app.wire.question import Answer, Question, Terms, measure

# A route of 1,000 points, measured 2026-11-22 [s].
SECONDS = 0.02


class CourseRequest(DragonFields, strict=True):
    """Points of a path, and its bends that are too tight for a dragon."""

    path: AnyPath = Field(default_factory=SpiralPath, description="The path")


class TightBend(Answer):
    """A stretch of the path that the longest bench cannot follow."""

    start: float = measure("m", "Start of the stretch, along the path")
    end: float = measure("m", "End of the stretch, along the path")
    points: list[Point] = measure("m", "Points along it, x and y")
    radius: float = measure("m", "Least radius there; of a curve through waypoints, at least this")
    least_radius: float = measure("m", "Least radius that the bench can follow")
    bench: int = Field(description="The bench with the longest chord")


class Course(Answer):
    """A path as it is drawn, whether or not it can be danced."""

    s: list[float] = measure("m", "Arc length along the path of P points, 0 where the head is at time 0")
    x: list[float] = measure("m", "P entries")
    y: list[float] = measure("m", "P entries")
    length: float = measure("m", "Length of the path")
    knots: list[float] = measure(
        "m", "Arc length of each waypoint (for a rounded corner, of its middle); empty for other paths"
    )
    bends: list[TightBend] = Field(description="Bends that are too tight, along the path")


def course(request: CourseRequest, terms: Terms) -> Course:
    """The path from its beginning to its end, and its bends that are too tight for the dragon."""
    result = core.course(request.path.to_path(), request.to_dragon(terms.settings.benches_max))
    x, y = result.points.T.tolist()
    bends = [TightBend.from_result(bend, points=bend.points.tolist()) for bend in result.bends]
    return Course(s=result.s.tolist(), x=x, y=y, length=result.length, knots=result.knots.tolist(), bends=bends)


QUESTION = Question(course, Course, body=CourseRequest, cost=lambda request: SECONDS)
