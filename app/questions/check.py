"""The question check: the verdict on a dance in its venue."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any, Self

from pydantic import Field

import core
from app.questions.collision_time import CollisionTime, Contact
from app.questions.encounter import Encounter
from app.wire.answers import SENTENCES, DragonPair, Point
from app.wire.clocks import clock_at_zero, time_of_day
from app.wire.dances import PlacedDance, SpanFields, clock_of
from app.wire.performances import SeveralFields
from app.wire.question import UNKNOWN_COST, Answer, Question, SpeedLimit, Terms, measure
from app.wire.readings import Limits, encounter_words, failure_words, speed_words
from core import Dance, Outcome, Performance, Venue
from core.language import say

if TYPE_CHECKING:
    from app.wire.degrees import Place


class DanceCheck(Contact, SpanFields, PlacedDance, strict=True):
    """One dance, its venue and limits."""

    speed_limit: SpeedLimit | None = measure(
        "m/s", "Highest speed allowed for any handle, to a millionth of it; default: no limit", None
    )
    details: bool = Field(
        True,
        description="false: the verdict and the failures alone, in a tenth of the time; least clearance, highest speed "
        "and sharpest bend are then null where no failure needs them",
    )


class CheckRequest(SeveralFields, DanceCheck, strict=True):
    """Verdict on a dance: dragon, path, venue and limits; or on several dances on one clock."""


class AreaClearance(Answer, of=core.AreaClearance):
    """Distance between the benches and the edges of the square or of one obstacle."""

    name: str
    outcome: Outcome
    time: float | None
    time_bracket: Point | None
    overlapping: int | None
    bench: int | None
    gap: float | None
    point: Point | None
    nearest: core.Nearest | None


class VenueClearance(Answer, of=core.VenueClearance):
    """Distances between the benches and the venue."""

    misplaced: core.Misplaced | None
    stray: core.Misplaced | None = Field(description="The same as misplaced, under its former name")
    areas: list[AreaClearance]


class HighestSpeed(Answer, of=core.HighestSpeed):
    """The highest speed of any handle over continuous time."""

    speed: float
    speed_bracket: tuple[float, float | None]
    time: float
    handles: list[int]
    passage: int | None
    sentences: list[str] = SENTENCES


class Failure(Answer, of=core.Failure):
    """One failed or undecided condition."""

    kind: core.FailureKind
    time: float
    benches: list[int]
    area: str | None
    names: list[str] = Field(description="Names of these benches, empty for one without; none where no bench has any")
    clock: str | None = Field(description="Time of day of that time, if start_clock or begin_clock is given")
    message: str
    sentence: str = Field(description="The same for people: without its time, and with benches as they are called")
    time_bracket: Point | None
    head: core.HeadState | None
    peak_speed: float | None
    peak_time: float | None

    @classmethod
    def of(cls, result: core.Failure, dragon: core.Dragon, start_clock: str | None, sentence: str = "") -> Self:
        clock = None if start_clock is None else time_of_day(result.time, start_clock)
        # A handle has the number of the bench behind it; the last handle is at the rear of the last bench.
        benches = [min(bench, dragon.benches - 1) for bench in result.benches]
        names = [dragon.names[bench] for bench in benches if dragon.names]
        return cls.from_result(result, names=names, clock=clock, sentence=sentence or result.message)


class Origin(Answer):
    """A place on earth."""

    longitude: float = measure("degrees", "Longitude, east positive")
    latitude: float = measure("degrees", "Latitude, north positive")


class Report(Answer, of=core.Report):
    """Verdict on the dance, which stops at a contact or a fold."""

    verdict: core.Judgement
    passed: bool
    failures: list[Failure]
    start: float
    stop: float
    first_contact: CollisionTime
    least_clearance: core.LeastClearance | None
    venue: VenueClearance | None
    highest_speed: HighestSpeed | None
    sharpest_bend: core.SharpestBend | None
    begins: str | None = Field(description="Time of day at start, if start_clock or begin_clock is given")
    ends: str | None = Field(description="Time of day at stop, if start_clock or begin_clock is given")
    origin: Origin | None = Field(
        description="Place of x = y = 0; null unless the venue was given in degrees or states it"
    )

    @classmethod
    def of(cls, result: core.Report, request: DanceCheck, terms: Terms, place: Place, clock: str | None) -> Self:
        dragon = result.first_contact.dance.dragon
        contact = CollisionTime.of(result.first_contact, request, terms)
        limits = limits_of(request, place.venue)
        failures = [
            Failure.of(failure, dragon, clock, failure_words(failure, dragon, limits)) for failure in result.failures
        ]
        venue = None if result.venue is None else VenueClearance.from_result(result.venue, stray=result.venue.misplaced)
        begins, ends = (None if clock is None else time_of_day(time, clock) for time in (result.start, result.stop))
        speed = result.highest_speed and HighestSpeed.from_result(
            result.highest_speed, sentences=[speed_words(result.highest_speed)]
        )
        own = {"failures": failures, "first_contact": contact, "venue": venue, "origin": place.origin}
        return cls.from_result(result, begins=begins, ends=ends, highest_speed=speed, **own)


class DragonFailure(Failure, of=core.PerformanceFailure):
    """One failed or undecided condition of a dragon, or of two together; times are those of the performance."""

    dragons: list[int]
    dragon_names: list[str | None] = Field(description="Their names; null for a dragon without one")

    @classmethod
    def in_performance(
        cls, result: core.PerformanceFailure, performance: Performance, clock: str | None, limits: Limits
    ) -> Self:
        parts, one = [performance.parts[k] for k in result.dragons], result.failure
        names = [part.name for part in parts]
        if one is not None:
            dragon, delay = parts[0].dance.dragon, parts[0].delay
            peak_time = None if one.peak_time is None else one.peak_time + delay
            own = Failure.of(replace(one, time=result.time, peak_time=peak_time), dragon, clock).model_dump()
            name = performance.name_of(result.dragons[0])
            sentence = say("{name}: {text}", name=name, text=failure_words(one, dragon, limits))
            own |= {"message": result.message, "sentence": sentence, "time_bracket": result.time_bracket}
            return cls(**own, dragons=result.dragons, dragon_names=names)
        households = [
            part.dance.dragon.names[bench] if part.dance.dragon.names else ""
            for part, bench in zip(parts, result.benches, strict=True)
        ]
        return cls.from_result(
            result,
            area=None,
            names=households if any(households) else [],
            clock=None if clock is None else time_of_day(result.time, clock),
            head=None,
            peak_speed=None,
            peak_time=None,
            dragon_names=names,
            sentence=encounter_words(result, performance, limits),
        )


class DragonsClearance(DragonPair, of=core.PerformanceLeastClearance):
    """The least clearance between two dragons over the performance."""

    distance: float
    at_least: float | None
    time: float


class PerformanceReport(Answer, of=core.PerformanceReport):
    """Verdict on several dances on one clock."""

    verdict: core.Judgement
    passed: bool
    failures: list[DragonFailure]
    start: float
    stop: float
    names: list[str | None] = Field(
        description="Names of the dragons, null for one without, in the order of the dances"
    )
    encounter: Encounter
    least_clearance: DragonsClearance | None
    reports: list[Report | None]
    begins: str | None = Field(description="Time of day at start, if start_clock or begin_clock is given")
    ends: str | None = Field(description="Time of day at stop, if start_clock or begin_clock is given")
    origin: Origin | None = Field(
        description="Place of x = y = 0; null unless the venue was given in degrees or states it"
    )

    @classmethod
    def of(cls, result: core.PerformanceReport, request: CheckRequest, terms: Terms, place: Place) -> Self:
        performance = result.performance
        clock = clock_of(request, performance)
        least, parts, limits = result.least_clearance, performance.parts, limits_of(request, place.venue)
        own: list[Report | None] = []
        for report, part in zip(result.reports, parts, strict=True):
            zero = None if clock is None else clock_at_zero(clock, -part.delay)
            own.append(None if report is None else Report.of(report, request, terms, place, zero))
        begins, ends = (None if clock is None else time_of_day(time, clock) for time in (result.start, result.stop))
        return cls.from_result(
            result,
            failures=[DragonFailure.in_performance(failure, performance, clock, limits) for failure in result.failures],
            names=[part.name for part in parts],
            encounter=Encounter.of(result.encounter, request, terms),
            least_clearance=None if least is None else DragonsClearance.from_result(least),
            reports=own,
            begins=begins,
            ends=ends,
            origin=place.origin,
        )


def limits_of(request: DanceCheck, venue: Venue | None) -> Limits:
    """What a request wants a dance to keep."""
    square = None if venue is None else venue.square.name
    return Limits(request.margin, request.total_stray or 0.0, request.speed_limit, square)


def check(request: DanceCheck, terms: Terms) -> Report | PerformanceReport:
    """Verdict on a dance in its venue: first contact, least clearance, venue, speed, sharpest bend."""
    if isinstance(request, CheckRequest) and request.dances is not None:
        performance, place = request.to_placed(terms.settings)
        return PerformanceReport.of(verdict_together(request, performance, terms), request, terms, place)
    dance = request.to_dance(terms.settings.checked_benches_max)
    place = request.to_place(dance.dragon)
    result = verdict_of(request, dance, place.venue, request.start, terms, details=request.details)
    return Report.of(result, request, terms, place, clock_of(request, dance))


def verdict_together(request: CheckRequest, performance: Performance, terms: Terms) -> core.PerformanceReport:
    """The verdict on several dances as an object of core. raises: InvalidValue"""
    limits: dict[str, Any] = {"margin": request.margin, "stray": request.to_stray(), "speed_limit": request.speed_limit}
    span: dict[str, Any] = {"start": request.start, "stop": request.stop, "details": request.details}
    return core.check(performance, budget=terms.budget, **limits, **span)


def verdict_of(
    request: DanceCheck, dance: Dance, venue: Venue | None, start: float | None, terms: Terms, *, details: bool = True
) -> core.Report:
    """The verdict as an object of core. start: of the time checked [s]; raises: InvalidValue"""
    limits: dict[str, Any] = {"margin": request.margin, "stray": request.to_stray(), "speed_limit": request.speed_limit}
    question = core.check if details else core.quick_check
    return question(dance, venue=venue, start=start, stop=request.stop, budget=terms.budget, **limits)


def _cost(request: CheckRequest) -> float:
    """A drawn dance of 60 benches through 20 waypoints takes 0.011 s, with four areas 0.016 s (measured 2026-11-22)."""
    if request.details or request.dances is not None or request.path.kind != "waypoints":
        return UNKNOWN_COST
    return 0.02 + 4e-4 * request.benches + 5e-4 * len(request.path.points)


QUESTION = Question(check, Report, body=CheckRequest, cost=_cost, several=PerformanceReport)
