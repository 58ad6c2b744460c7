"""The question tolerance: the largest proven stray of people without a contact."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field

import core
from app.questions.encounter import EncounterCertificate
from app.wire import evidence
from app.wire.answers import SENTENCES
from app.wire.dances import PlacedDance, SpanFields
from app.wire.fields import Answer, DanceQuery, TurningDiameter, Wire, measure
from app.wire.performances import SeveralFields
from app.wire.question import Command, Question, Terms
from app.wire.readings import stray_words
from core import InvalidValue
from core.language import phrase, say
from core.quantities import Quantity
from core.tolerance.curve import time_on_circle
from core.values import Point

SizeError = Annotated[float, Field(ge=0, le=5)]


class CircleQuery(DanceQuery):
    """A dance on the way to a turning circle."""

    turning_diameter: TurningDiameter = measure("m", "Diameter of the circle at which the head stops", 9.0)


class SizeErrors(Wire):
    """Errors of sizes, on the way to a turning circle."""

    length_error: SizeError = measure("m", "Largest error of the distance between the two holes of a bench", 0.0)
    pitch_error: SizeError = measure("m", "Largest error of the pitch of the painted spiral", 0.0)


class ToleranceQuery(SizeErrors, CircleQuery):
    """Largest proven stray on the way to a turning circle."""


class SpanOrCircle(SpanFields):
    """A stretch of a dance; on a spiral also the way to a turning circle."""

    turning_diameter: TurningDiameter | None = measure(
        "m",
        "Diameter of the circle at which the head stops, on a spiral, in place of an end time; default: none, the "
        "whole stretch from start to stop counts",
        None,
    )


class DanceTolerance(SizeErrors, SpanOrCircle, PlacedDance, strict=True):
    """Largest proven stray in any dance, for contacts of benches and with a venue."""


class ToleranceRequest(SeveralFields, DanceTolerance, strict=True):
    """Largest proven stray in any dance, or in several on one clock, for contacts of benches and with a venue."""


class Shown(Answer, of=core.Exhibit):
    """A pose of the whole dragon with unchanged chords, in which the benches that limit the stray overlap."""

    handles: list[Point]
    depth: float
    stray: float


class StrayProof(Answer, of=core.StrayProof, leave=()):
    """Evidence for the safe stray."""

    method: str
    claim: core.StrayClaim


class Tolerance(Answer, of=core.Tolerance, leave=("independent",)):
    """Largest distance of every hole from its place, at any time, without any contact.

    stray_with_errors: proven safe whatever the sizes are within length_error and pitch_error, 0: none is known to be;
        null without such errors [m]
    """

    simple: float
    stray_with_errors: float | None
    stray_bracket: tuple[float, float | None]
    exhibit: Shown | None
    sentences: list[str] = SENTENCES
    words: evidence.Words | None = evidence.WORDS
    certificate: StrayProof


class ShownTogether(Answer, of=core.PerformanceExhibit):
    """Poses of one or two whole dragons with unchanged chords, in which the benches that limit the stray overlap."""

    handles: list[list[Point]]
    depth: float
    stray: float


class PerformanceTolerance(Answer, of=core.PerformanceTolerance, leave=("performance",)):
    """Largest distance of every hole of several dragons from its place, at any time, without any contact.

    names: their names; null for a dragon without one
    """

    dragons: list[int]
    names: list[str | None]
    time: float | None
    exhibit: ShownTogether | None
    own: list[float] = measure("m", "Safe stray of each dragon by itself in the venue")
    start: float
    certificate: EncounterCertificate | None


def tolerance(request: ToleranceQuery | DanceTolerance, terms: Terms) -> Tolerance | PerformanceTolerance:
    """Largest proven stray of people without a contact, and a pose that touches with a slightly larger one."""
    if isinstance(request, ToleranceRequest) and request.dances is not None:
        return _together(request, terms)
    dance, budget = request.to_dance(terms.settings.checked_benches_max), terms.budget
    venue = request.to_place(dance.dragon).venue if isinstance(request, DanceTolerance) else None
    start, stop = span_of(request, dance)
    with_errors = _with_errors(request, dance, budget, placed=venue is not None)
    result = core.tolerance(dance, venue, start=start, stop=stop, budget=budget)
    pose = (
        None if result.exhibit is None else Shown.from_result(result.exhibit, handles=result.exhibit.handles.tolist())
    )
    sentences = stray_words(result, dance.dragon, request.turning_diameter)
    words = evidence.stray_words(result) if terms.words else None
    own = {"exhibit": pose, "stray_with_errors": with_errors, "sentences": sentences, "words": words}
    return Tolerance.from_result(result, **own)


def _together(request: ToleranceRequest, terms: Terms) -> PerformanceTolerance:
    """The tolerance of several dances on one clock. raises: TooLarge, InvalidValue"""
    performance, _ = request.to_placed(terms.settings)
    for name in ("turning_diameter", *SizeErrors.model_fields):
        if value := getattr(request, name):
            raise InvalidValue(name, "must be left out beside dances", got=Quantity(value, "m"))
    result = core.tolerance(performance, start=request.start, stop=request.stop, budget=terms.budget)
    pose = None
    if result.exhibit is not None:
        handles = [own.tolist() for own in result.exhibit.handles]
        pose = ShownTogether.from_result(result.exhibit, handles=handles)
    names = [performance.parts[k].name for k in result.dragons]
    own = [one.stray for one in result.own]
    return PerformanceTolerance.from_result(result, exhibit=pose, names=names, own=own)


def span_of(request: CircleQuery | SpanOrCircle, dance: core.Dance) -> tuple[float | None, float | None]:
    """Start and stop of the time asked about [s]; None as for core. raises: InvalidValue"""
    start, stop = (request.start, request.stop) if isinstance(request, SpanOrCircle) else (None, None)
    if request.turning_diameter is None:
        return start, stop
    if dance.path.spiral is None or stop is not None:
        rule = "must be left out, unless the path is a spiral and stop is left out"
        raise InvalidValue("turning_diameter", rule, got=Quantity(request.turning_diameter, "m"))
    circle = time_on_circle(dance, request.turning_diameter / 2)
    if start is not None and start >= circle:
        rule = "must be before the head is on the turning circle, at {circle}"
        raise InvalidValue("start", rule, got=Quantity(start, "s"), circle=Quantity(round(circle, 6), "s"))
    return start, circle


def _with_errors(
    request: ToleranceQuery | DanceTolerance, dance: core.Dance, budget: core.Budget, *, placed: bool
) -> float | None:
    errors = {"length_error": request.length_error, "pitch_error": request.pitch_error}
    if not any(errors.values()):
        return None
    spiral = dance.path.spiral
    if request.turning_diameter is None or placed or spiral is None:
        field = next(name for name, error in errors.items() if error)
        rule = "must be 0, unless the dance has no venue and ends on a circle of a spiral (turning_diameter)"
        raise InvalidValue(field, rule, got=Quantity(errors[field], "m"))
    radius = request.turning_diameter / 2
    return core.uncertain_tolerance(dance.dragon, spiral.pitch, **errors, turning_radius=radius, budget=budget)


# Why a question that looks for the largest stray ignores strays in a FILE: the end of a note to the user.
STRAYS_IGNORED = phrase("the answer is the largest stray, by people and by the play of pins together")
QUESTION = Question(
    tolerance,
    Tolerance,
    flat=ToleranceQuery,
    body=ToleranceRequest,
    several=PerformanceTolerance,
    command=Command(
        "Largest proven stray without contact, and a pose that touches with a slightly larger one.\n\n"
        "Without a FILE: on the way to the turning circle. With a FILE: in the whole dance.",
        lambda request: say("Tolerance to strays"),
        instead=STRAYS_IGNORED,
    ),
)
