"""The paper's figures 6, 7 and 8: their requests and drawings."""

from __future__ import annotations

from typing import Any

from pydantic import Field

import core
from app.questions.pitch_scan import ScanFields
from app.wire.dances import DragonFields, PlacedDance
from app.wire.fields import DanceQuery, Instant, Margin, UniformDragon, Wire, measure
from app.wire.performances import Moment, PerformanceSpan, PlacedPerformance, SeveralFields
from app.wire.question import FileFormat, Question, Terms
from core.design.pitch_scan import scan_near_minimum
from core.language import Language


class Format(FileFormat):
    """File format of a figure."""

    SVG = "svg", "image/svg+xml"
    PNG = "png", "image/png"


FORMATS = {one.media_type: one.value for one in Format}
FORMS = tuple(FORMATS)
# The same by the ending of a file.
PICTURES = {f".{one}": one.media_type for one in Format}


class WithLanguage(Wire):
    """The words of a figure."""

    language: Language = Field(Language.ENGLISH, description="Language of the words in the picture", strict=False)


class TimeQuery(DanceQuery):
    """The dance at one instant."""

    time: Instant = measure("s", "Instant of the poses", 300.0)


class TrajectoryFigureQuery(TimeQuery, WithLanguage):
    """Every handle at one instant, drawn."""


class TrajectoryFigureRequest(SeveralFields, PlacedDance, WithLanguage):
    """Every handle at one instant, drawn on any path; or every bench of several dragons."""

    time: Instant | None = measure(
        "s",
        "Instant to draw; default: 0, or the first time at which the whole dragon is on the path; of several dances "
        "their beginning",
        None,
    )


class ContactQuery(DanceQuery):
    """The dance at first contact."""

    margin: Margin = 0.0


class InstantQuery(TimeQuery, ContactQuery):
    """The dance at one instant, and what counts as a contact."""


class ContactFigureQuery(ContactQuery, WithLanguage):
    """The dance at first contact, drawn."""


class ContactFigureRequest(SeveralFields, PlacedDance, WithLanguage):
    """The dance at first contact, drawn on any path; or several dragons at their first encounter."""

    margin: Margin = 0.0
    start: Instant | None = measure(
        "s", "Start time; default: 0, or the first time at which the whole dragon is on the path", None
    )
    stop: Instant | None = measure("s", "End time; default: the end of the run", None)


class EncounterFigureRequest(PerformanceSpan, PlacedPerformance, WithLanguage, strict=True):
    """Several dragons at their first encounter, or at another time, drawn."""

    margin: Margin = 0.0
    time: Moment | None = measure(
        "s", "Instant to draw; default: the first encounter, without one the end of the time asked about", None
    )


class StaircaseQuery(ScanFields, UniformDragon, WithLanguage):
    """First contact against the pitch, drawn."""


class StaircaseRequest(ScanFields, DragonFields, WithLanguage, strict=True):
    """First contact against the pitch, of any dragon, drawn."""


def trajectory_figure(request: TrajectoryFigureQuery | TrajectoryFigureRequest, terms: Terms, form: str) -> bytes:
    """Every handle at one instant, coloured by its speed, on the given path and in the given venue."""
    from app.files import figures

    if isinstance(request, TrajectoryFigureRequest) and request.dances is not None:
        performance, _ = request.to_placed(terms.settings)
        time = performance.begin if request.time is None else request.time
        return _together(performance, None, time, FORMATS[form], terms)
    dance = request.to_dance(terms.settings.drawn_benches_max)
    venue = request.to_place(dance.dragon).venue if isinstance(request, PlacedDance) else None
    time = dance.default_start if request.time is None else request.time
    look: dict[str, Any] = {"format": FORMATS[form], "budget": terms.budget}
    return figures.trajectory_figure(dance, venue=venue, time=time, **look)


def contact_figure(request: ContactFigureQuery | ContactFigureRequest, terms: Terms, form: str) -> bytes:
    """The dance at first contact, with the pair that touches or is too near marked and enlarged."""
    from app.files import figures

    placed: dict[str, Any] = {}
    if isinstance(request, ContactFigureRequest) and request.dances is not None:
        performance, _ = request.to_placed(terms.settings)
        return _together(performance, request, None, FORMATS[form], terms)
    if not isinstance(request, ContactFigureRequest):
        dance = request.to_dance(terms.settings.drawn_benches_max)
    else:
        dance = request.to_dance(terms.settings.checked_benches_max)
        placed = {"venue": request.to_place(dance.dragon).venue, "start": request.start, "stop": request.stop}
    look: dict[str, Any] = {"format": FORMATS[form]}
    return figures.contact_figure(dance, margin=request.margin, budget=terms.budget, **look, **placed)


def encounter_figure(request: EncounterFigureRequest, terms: Terms, form: str) -> bytes:
    """Several dragons at their first encounter, with the two benches that meet enlarged, or at a given time."""
    performance, _ = request.to_placed(terms.settings)
    search = request if request.time is None else None
    return _together(performance, search, request.time, FORMATS[form], terms)


def _together(
    performance: core.Performance,
    search: EncounterFigureRequest | ContactFigureRequest | None,
    time: float | None,
    format: str,
    terms: Terms,
) -> bytes:
    """Several dragons, drawn at the first encounter of a search, or at a time [s]."""
    from app.files import performances

    result = None
    if search is not None:
        span: dict[str, Any] = {"start": search.start, "stop": search.stop}
        result = core.first_encounter(performance, margin=search.margin, budget=terms.budget, **span)
    return performances.encounter_figure(performance, result, time=time, format=format, budget=terms.budget)


def pitch_scan_figure(request: StaircaseQuery | StaircaseRequest, terms: Terms, form: str) -> bytes:
    """Radius of the head at first contact, against the pitch, with its jumps and the minimum pitch."""
    from app.files import figures

    dragon = request.to_dragon(min(terms.settings.drawn_benches_max, request.most_benches(terms.settings)))
    scanned = scan_near_minimum(
        dragon, samples=request.samples, progress=terms.progress, budget=terms.budget, **request.to_circle()
    )
    look: dict[str, Any] = {"format": FORMATS[form], "budget": terms.budget}
    look |= request.to_circle()
    return figures.pitch_scan_figure(dragon, scanned, **look)


DRAWN: dict[str, Any] = {"model": None, "forms": FORMS, "formats": Format}
TRAJECTORY = Question(trajectory_figure, flat=TrajectoryFigureQuery, body=TrajectoryFigureRequest, **DRAWN)
CONTACT = Question(contact_figure, flat=ContactFigureQuery, body=ContactFigureRequest, **DRAWN)
ENCOUNTER = Question(encounter_figure, body=EncounterFigureRequest, **DRAWN)
PITCH_SCAN = Question(pitch_scan_figure, flat=StaircaseQuery, body=StaircaseRequest, **DRAWN)
