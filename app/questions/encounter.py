"""The question encounter: the first time that benches of two dragons touch, or come within a margin."""

from __future__ import annotations

from typing import Any, Self

from pydantic import Field

import core
from app.questions.collision_time import Contact
from app.wire.answers import TOTAL_STRAY, DragonPair, EncounterCheck, Feature, Head, Pair, Point
from app.wire.claims import EncounterClaim
from app.wire.performances import PerformanceFields, PerformanceSpan
from app.wire.question import Answer, Question, Terms, measure
from core import Outcome


class EncounterRequest(Contact, PerformanceSpan, PerformanceFields, strict=True):
    """First time that benches of two dragons touch, or come within a margin."""


class OwnedFeature(Feature):
    """A corner or an edge of one bench of one dragon."""

    dragon: int = Field(description="Number of the dragon, in the order of the dances")


class EncounterEnd(Answer):
    """End of a performance in which no benches of two dragons come within the margin, or touch if it is 0."""

    reason: core.EndReason = Field(
        description="fold: a bench cannot follow any more; end: all paths end; stop: the requested time ends"
    )
    time: float = measure("s")
    dragon: int | None = Field(description="The dragon that folds; null if none does")
    bench: int | None = Field(description="Its bench that folds; null if none does")


class NearPass(DragonPair):
    """A local minimum of the clearance between dragons."""

    time: float = measure("s")
    clearance: float = measure("m")


class EncounterCertificate(Answer):
    """Evidence for the answer."""

    method: str = Field(description="The claim and its proof, in sentences")
    claim: EncounterClaim = Field(description="The claim as a kind and values")
    steps: int = Field(description="Number of proven steps")
    clear_until: float | None = measure(
        "s",
        "Time until which no benches of two dragons come within the margin, or touch if it is 0; null if no time is "
        "proven clear",
    )
    bound: float = measure("m/s^2", "Largest bound on the second derivative of a gap in time that a step used")
    least_clearance: NearPass | None = Field(
        description="The narrowest pass of two dragons seen before the encounter; null if none was"
    )


class Encounter(Answer):
    """First time that benches of two different dragons come within the margin, or touch if it is 0."""

    outcome: Outcome = Field(
        description="End of the search; contact: benches of two dragons come within the margin, or touch if it is 0"
    )
    margin: float = measure("m", "Required clearance; 0: only a touch counts")
    stray: float | None = TOTAL_STRAY
    time: float | None = measure(
        "s", "First time within the margin, or touching if it is 0; null when clear or undecided"
    )
    time_bracket: Point | None = measure(
        "s",
        "Two times: proven clear up to the first; within the margin at the second. If undecided, the second is the end "
        "of the search, unless overlapping names two benches",
    )
    overlapping: DragonPair | None = Field(
        description="If undecided: the benches that are certainly within the margin, or overlap, at the second of "
        "these times, perhaps not for the first time; null if none are, or not undecided"
    )
    dragons: Pair | None = Field(description="The two dragons, in the order of the dances, from 0")
    names: tuple[str | None, str | None] | None = Field(description="Their names; null for a dragon without one")
    benches: Pair | None = Field(description="Their benches that meet, or come nearer than the margin, one of each")
    heads: tuple[Head, Head] | None = Field(description="The heads of both at that time")
    gap: float | None = measure(
        "m",
        "Gap between the two benches at that time, each in its place: the margin, or less if they are nearer from the "
        "start, or more with a stray",
    )
    corner: OwnedFeature | None = Field(description="Corner that touches or is nearest")
    edge: OwnedFeature | None = Field(description="Edge that this corner touches or is nearest to")
    point: Point | None = measure("m", "Position of that corner, x and y")
    end: EncounterEnd | None = Field(description="End of the performance, when clear")
    certificate: EncounterCertificate = Field(description="Evidence for the answer")
    cross_check: EncounterCheck | None = Field(
        description="Verdicts of the engines on the benches of all dragons, 1e-6 m of travel of the faster head before "
        "and after the encounter (at the start: at the start and after it); with a stray on the two that meet. Null "
        "without an encounter or if not requested"
    )

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
            cross_check=None if check is None else EncounterCheck.of(check),
        )


def encounter(request: EncounterRequest, terms: Terms) -> Encounter:
    """First time that benches of two dragons touch or come within a margin, with the evidence."""
    return Encounter.of(encounter_of(request, terms), request, terms)


def encounter_of(request: EncounterRequest, terms: Terms) -> core.FirstEncounter:
    """The first encounter as an object of core. raises: TooLarge, InvalidValue"""
    performance = request.to_performance(terms.settings)
    limits: dict[str, Any] = {"margin": request.margin, "stray": request.to_stray()}
    return core.first_encounter(performance, start=request.start, stop=request.stop, budget=terms.budget, **limits)


def _owned(feature: core.Feature | None, dragon: int | None) -> OwnedFeature | None:
    return None if feature is None else OwnedFeature.from_result(feature, dragon=dragon)


QUESTION = Question(encounter, Encounter, body=EncounterRequest)
