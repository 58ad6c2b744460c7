"""The question course: the points of a path, its bends that are too tight, and where its dance breaks limits."""

from __future__ import annotations

from typing import Any

from pydantic import Field

import core
from app.wire.dances import PlacedDance, SpanFields
from app.wire.fields import Answer, Margin, SpeedLimit, Strays, measure
from app.wire.question import Question, Terms
from app.wire.readings import bench_words
from core import breaches as facts
from core.breaches import BreachKind, breaches_and_gaps
from core.language import say
from core.proposal.answer import told_apart
from core.values import Point

# A route of 1,000 points, measured 2026-11-22, and where its dance breaks limits, measured 2026-11-27 [s].
SECONDS, BREACHES_SECONDS = 0.02, 0.08


class CourseRequest(Strays, SpanFields, PlacedDance, strict=True):
    """Points of a path, its bends that are too tight for a dragon, and where the dance breaks a limit."""

    breaches: bool = Field(False, description="true: also the stretches on which the dance breaks a limit")
    margin: Margin = 0.0
    speed_limit: SpeedLimit | None = measure("m/s", "Highest speed allowed for any handle; default: no limit", None)


class TightBend(Answer, of=core.TightBend, leave=()):
    """A stretch of the path that a bench cannot follow.

    sentence: the bend in one sentence
    """

    points: list[Point]
    sentence: str


class Breach(Answer, of=facts.Breach):
    """A stretch of the path on which benches break a limit in a sample of the dance.

    kind: speed: a handle is faster than the limit; margin: a bench comes within the margin of another one or of the
        venue's edges, or stands outside; stray: it may, if people stray
    """

    kind: BreachKind
    start: float
    end: float
    points: list[Point]


class AreaGap(Answer, of=facts.AreaGap, leave=()):
    """How near the benches come to an area at samples of the dance."""


class Course(Answer, of=core.Course):
    """A path as it is drawn, whether or not it can be danced.

    x: p entries [m]
    y: p entries [m]
    breaches: stretches on which a limit is broken, at samples of the dance 0.3 m apart: a view, not a verdict, which
        POST /check gives; null unless asked for, and where the dragon cannot follow the path
    gaps: least distance of the benches, everybody in place, from the square's border and each obstacle, at the same
        samples; null as for breaches, and without a venue
    """

    s: list[float]
    x: list[float]
    y: list[float]
    length: float
    knots: list[float]
    bends: list[TightBend]
    breaches: list[Breach] | None
    gaps: list[AreaGap] | None


def course(request: CourseRequest, terms: Terms) -> Course:
    """The path from its beginning to its end, and its bends that are too tight for the dragon."""
    dragon = request.to_dragon(terms.settings.benches_max)
    result = core.course(request.path.to_path(), dragon)
    x, y = result.points.T.tolist()
    bends = [
        TightBend.from_result(bend, points=bend.points.tolist(), sentence=_bend_words(bend, dragon))
        for bend in result.bends
    ]
    broken, gaps = _at_samples(request, terms) if request.breaches and not bends else (None, None)
    lists = {"s": result.s.tolist(), "x": x, "y": y, "knots": result.knots.tolist()}
    return Course(**lists, length=result.length, bends=bends, breaches=broken, gaps=gaps)


def _bend_words(bend: core.TightBend, dragon: core.Dragon) -> str:
    radius, least = told_apart(bend.radius, bend.least_radius, 2)
    return say(
        "The bend is too tight, with a radius of {radius} m: {why}. With {least} m {bench} can always follow.",
        radius=radius, why=bend.reason.words, least=least, bench=bench_words(bend.bench, dragon),
    )  # fmt: skip


def _at_samples(request: CourseRequest, terms: Terms) -> tuple[list[Breach] | None, list[AreaGap] | None]:
    """The stretches on which the dance breaks a limit, and how near it comes to each area; None if the dragon cannot
    follow the path."""
    try:
        dance = request.to_dance(terms.settings.checked_benches_max)
        dance.span(request.start, request.stop)
    except core.InvalidValue:
        return None, None
    limits: dict[str, Any] = {"margin": request.margin, "stray": request.to_stray(), "speed_limit": request.speed_limit}
    span: dict[str, Any] = {"start": request.start, "stop": request.stop, "budget": terms.budget}
    broken, gaps = breaches_and_gaps(dance, request.to_place(dance.dragon).venue, **span, **limits)
    near = None if gaps is None else [AreaGap.from_result(one) for one in gaps]
    return [Breach.from_result(one, points=one.points.tolist()) for one in broken], near


def _cost(request: CourseRequest) -> float:
    return SECONDS + (BREACHES_SECONDS if request.breaches else 0.0)


QUESTION = Question(course, Course, body=CourseRequest, cost=_cost)
