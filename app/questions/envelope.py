"""The question envelope: the ground that benches sweep."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from importlib.util import find_spec
from typing import Annotated, Any, Self

from pydantic import Field

import core
from app.files import outlines
from app.files.outlines import DXF_TYPE, GEOJSON_TYPE, NamedGround
from app.wire.answers import MultiPolygon, Polygon
from app.wire.dances import DanceFields, SpanFields
from app.wire.fields import Answer, Instant, measure
from app.wire.geojson import geometry_of
from app.wire.options import PathOptions
from app.wire.paths import Point
from app.wire.performances import SeveralDances
from app.wire.question import JSON, Command, Output, Question, Terms
from core.language import say

# Largest number of points of a line of spectators.
LINE_MOST = 1_000
# Time for the default dance up to its contact [s], measured on 2026-11-22.
SECONDS = 2.5


class WholeSpan(SpanFields):
    """A stretch of a dance, which a contact does not end."""

    stop: Instant | None = measure("s", "End time; default: the end of the run, also if benches touch before", None)


class EnvelopeOptions(WholeSpan, PathOptions):
    """The fields of an envelope as options."""


class EnvelopeRequest(SeveralDances, WholeSpan, DanceFields, strict=True):
    """The ground that benches sweep in any dance, or in each of several on one clock."""

    spectators: list[Point] | None = measure(
        "m",
        "Points of a line along which spectators stand, x and y; default: none",
        None,
        min_length=1,
        max_length=LINE_MOST,
        fail_fast=True,
    )


class SweepProof(Answer, of=core.SweepProof, leave=()):
    """Proven bounds of the envelope."""

    method: str
    claim: core.GroundClaim


class Envelope(Answer, of=core.Envelope):
    """The ground that benches sweep.

    envelope: GeoJSON geometry in metres that holds every pose of every bench, holes kept
    distance: least distance of the spectators' line from it, 0 where they meet: no bench comes nearer; null without
        them [m]
    """

    envelope: Annotated[Polygon | MultiPolygon, Field(discriminator="type")]
    excess: float
    area: float
    start: float
    stop: float
    distance: float | None
    certificate: SweepProof

    @classmethod
    def of(cls, result: core.Envelope, request: EnvelopeRequest) -> Self:
        distance = None if request.spectators is None else result.distance(request.spectators)
        return cls.from_result(result, envelope=geometry_of(result.polygons), distance=distance)


class NamedDragon(Answer):
    """One of several dragons.

    name: name of the dragon; null without one
    """

    name: str | None


class DragonEnvelope(Envelope, NamedDragon):
    """The ground that one of several dragons sweeps; times are those of its own dance, which is 0 at its delay."""


class PerformanceEnvelope(Answer):
    """The ground that each of several dragons sweeps.

    dances: the ground of each dragon, in the order of the dances; of one that stands, a thousandth of a second of its
        dance there
    distance: least distance of the spectators' line from the ground of any dragon, 0 where they meet; null without it
        [m]
    start: start of the time asked about [s]
    stop: end of the time asked about [s]
    """

    dances: list[DragonEnvelope]
    distance: float | None
    start: float
    stop: float

    @classmethod
    def together(
        cls, results: Sequence[core.Envelope], request: EnvelopeRequest, performance: core.Performance
    ) -> Self:
        grounds = [
            DragonEnvelope(**Envelope.of(result, request).model_dump(), name=part.name)
            for result, part in zip(results, performance.parts, strict=True)
        ]
        distances = [one.distance for one in grounds if one.distance is not None]
        start, stop = performance.span(request.start, request.stop)
        return cls(dances=grounds, distance=min(distances, default=None), start=start, stop=stop)


# Forms of an envelope besides JSON: media type -> function of the grounds of all dragons.
FORMS = {GEOJSON_TYPE: outlines.ground_geojson}
if find_spec("ezdxf"):
    FORMS[DXF_TYPE] = outlines.ground_dxf


def envelope(request: EnvelopeRequest, terms: Terms, form: str = JSON) -> Envelope | PerformanceEnvelope | bytes:
    """The ground that benches sweep, as polygons that hold every pose and reach at most 1 mm further."""
    answer, writers = _with_file(request, terms)
    return answer if form == JSON else writers["output"](form)


def _with_file(
    request: EnvelopeRequest, terms: Terms
) -> tuple[Envelope | PerformanceEnvelope, dict[str, Callable[[str], bytes]]]:
    """The answer, and what writes it as a file. raises: TooLarge, InvalidValue"""
    span: dict[str, Any] = {"start": request.start, "stop": request.stop, "budget": terms.budget}
    if request.dances is None:
        result = core.envelope(request.to_dance(terms.settings.checked_benches_max), **span)
        return Envelope.of(result, request), {"output": lambda form: FORMS[form]([NamedGround(result)])}
    performance = request.to_performance(terms.settings)
    results = core.envelope(performance, **span)
    grounds = [NamedGround(one, k, performance.parts[k].name) for k, one in enumerate(results)]
    answer = PerformanceEnvelope.together(results, request, performance)
    return answer, {"output": lambda form: FORMS[form](grounds)}


def _cost(request: EnvelopeRequest, form: str = JSON) -> float:
    return SECONDS * len(request.dances or [None])


QUESTION = Question(
    envelope,
    Envelope,
    None,
    EnvelopeRequest,
    (JSON, *FORMS),
    _cost,
    several=PerformanceEnvelope,
    command=Command(
        "The ground that benches sweep: polygons proven to hold every pose and to reach at most 1 mm further.\n\n"
        "Of a FILE of several dragons, the ground of each.",
        lambda request: say("Ground that benches sweep"),
        options=EnvelopeOptions,
        outputs={
            "output": Output(
                "Write the polygons to a .geojson, .json or .dxf file (extra dxf), in metres.",
                {".geojson": GEOJSON_TYPE, ".json": GEOJSON_TYPE, ".dxf": DXF_TYPE},
                extras={".dxf": "dxf"},
            )
        },
        solve=_with_file,
    ),
)
