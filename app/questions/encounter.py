"""The question encounter: the first time that benches of two dragons touch, or come within a margin."""

from __future__ import annotations

from typing import Any, Self

import core
from app.questions.collision_time import Contact
from app.questions.figures import FORMATS, PICTURES
from app.wire.answers import SENTENCES, TOTAL_STRAY, DragonPair, EncounterCheck, OwnedFeature
from app.wire.fields import Answer
from app.wire.labels import with_strays
from app.wire.performances import FILE_OF_DANCES, PerformanceFields, PerformanceSpan
from app.wire.question import Command, Output, Question, Terms, Writer
from app.wire.readings import met_words
from core import Outcome
from core.language import say
from core.quantities import format_number
from core.values import Pair, Point


class EncounterRequest(Contact, PerformanceSpan, PerformanceFields, strict=True):
    """First time that benches of two dragons touch, or come within a margin."""


class NearPass(DragonPair, of=core.NearPass):
    """A local minimum of the clearance between dragons over time."""

    time: float
    clearance: float


class EncounterCertificate(Answer, of=core.EncounterEvidence, leave=()):
    """Evidence for the answer."""

    method: str
    claim: core.EncounterClaim
    least_clearance: NearPass | None


class Encounter(Answer, of=core.FirstEncounter, leave=("feature_dragons", "performance")):
    """First time that benches of two different dragons come within the margin, or touch if it is 0.

    names: their names; null for a dragon without one
    cross_check: verdicts of the engines on the benches of all dragons, 1e-6 m of travel of the faster head before and
        after the encounter (at the start: at the start and after it); with a stray on the two that meet. Null without
        an encounter or if not requested
    """

    outcome: Outcome
    margin: float
    stray: float | None = TOTAL_STRAY
    time: float | None
    overlapping: DragonPair | None
    dragons: Pair | None
    names: tuple[str | None, str | None] | None
    benches: Pair | None
    heads: tuple[core.HeadState, core.HeadState] | None
    gap: float | None
    corner: OwnedFeature | None
    edge: OwnedFeature | None
    point: Point | None
    end: core.PerformanceEnd | None
    sentences: list[str] = SENTENCES
    certificate: EncounterCertificate
    cross_check: EncounterCheck | None

    @classmethod
    def of(cls, result: core.FirstEncounter, request: Contact, terms: Terms) -> Self:
        check = None
        if request.cross_check != "none":
            check = core.encounter_check(result, whole=request.cross_check == "dragon", budget=terms.budget)
        corner, edge = map(_owned, (result.corner, result.edge), result.feature_dragons)
        parts, overlapping = result.performance.parts, result.overlapping
        return cls.from_result(
            result,
            stray=request.total_stray,
            overlapping=None if overlapping is None else DragonPair.of(overlapping),
            names=None if result.dragons is None else [parts[k].name for k in result.dragons],
            corner=corner,
            edge=edge,
            sentences=met_words(result),
            cross_check=None if check is None else EncounterCheck.of(check),
        )


def encounter(request: EncounterRequest, terms: Terms) -> Encounter:
    """First time that benches of two dragons touch or come within a margin, with the evidence."""
    return _with_figure(request, terms)[0]


def _with_figure(request: EncounterRequest, terms: Terms) -> tuple[Encounter, dict[str, Writer]]:
    """The answer, and what draws it. raises: TooLarge, InvalidValue"""
    performance = request.to_performance(terms.settings)
    limits: dict[str, Any] = {"margin": request.margin, "stray": request.to_stray(), "budget": terms.budget}
    result = core.first_encounter(performance, start=request.start, stop=request.stop, **limits)

    def draw(form: str) -> bytes:
        from app.files.performances import encounter_figure  # matplotlib takes a second to import

        return encounter_figure(performance, result, format=FORMATS[form], budget=terms.budget)

    return Encounter.of(result, request, terms), {"figure": draw}


def _owned(feature: core.Feature | None, dragon: int | None) -> OwnedFeature | None:
    return None if feature is None else OwnedFeature.from_result(feature, dragon=dragon)


class EncounterOptions(Contact, PerformanceSpan):
    """The fields of an encounter that are options."""


def _title(request: EncounterRequest) -> str:
    title = say("First encounter")
    if request.margin:
        near = format_number(request.margin)
        title = say("First time that benches of two dragons are within {margin} m of each other", margin=near)
    return with_strays(title, request.to_stray())


QUESTION = Question(
    encounter,
    Encounter,
    body=EncounterRequest,
    command=Command(
        "First time that benches of two dragons touch, or come within a margin.",
        _title,
        options=EncounterOptions,
        file=FILE_OF_DANCES,
        outputs={
            "figure": Output(
                "Draw all dragons at their encounter into a .svg or .png file.",
                PICTURES,
                extras=dict.fromkeys(PICTURES, "figures"),
            )
        },
        solve=_with_figure,
    ),
)
