"""The question check: the verdict on a dance in its venue."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any, Self

from pydantic import Field

import core
from app.questions.collision_time import CollisionTime, Contact
from app.questions.encounter import Encounter
from app.wire.answers import SENTENCES, DragonPair, Head, Pair, Point
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


class LeastClearance(Answer):
    """The least clearance over the dance."""

    distance: float = measure(
        "m",
        "Smallest distance found; 0 at the first touch, or at a later one if it is undecided which is the first; if "
        "benches overlap at the start, minus the depth",
    )
    at_least: float | None = measure(
        "m", "Proven lower bound; null: the search gave up before proving one, or the distance is below zero"
    )
    time: float = measure("s", "Time of the smallest distance")
    benches: Pair = Field(description="The pair at that distance")


class Nearest(Answer):
    """Smallest distance between the benches and the edges of one area."""

    distance: float = measure("m", "Smallest distance found; 0 at the first touch")
    at_least: float | None = measure("m", "Proven lower bound; null: the search gave up before proving one")
    time: float = measure("s", "Time of the smallest distance")
    bench: int = Field(description="The bench at that distance")
    point: Point = measure("m", "Nearest point of the bench, x and y")
    wall: Point = measure("m", "Nearest point of the area, x and y")


class AreaClearance(Answer):
    """Distance between the benches and the edges of the square or of one obstacle."""

    name: str = Field(description="Name of the area")
    outcome: Outcome = Field(description="Whether a bench comes within the margin, or touches if it is 0")
    time: float | None = measure("s", "First such time; null when clear or undecided")
    time_bracket: Point | None = measure(
        "s",
        "Two times: proven clear up to the first; within the margin at the second. If undecided, the second is the end "
        "of the search unless overlapping names a bench",
    )
    overlapping: int | None = Field(
        description="If undecided: the bench that is certainly within the margin, or touches, at the second of these "
        "times; null if none is, or not undecided"
    )
    bench: int | None = Field(description="The first bench within the margin, or touching if it is 0")
    gap: float | None = measure(
        "m", "Distance to the area at that time: the margin, or less if it is nearer from the start"
    )
    point: Point | None = measure("m", "Point of that bench nearest to the area, x and y")
    nearest: Nearest | None = Field(description="Smallest distance over the dance; null without details")


class Misplaced(Answer):
    """A bench that starts outside the square or inside an obstacle."""

    name: str = Field(description="Name of the square or of the obstacle")
    bench: int = Field(description="The bench")
    point: Point = measure("m", "Centre of the bench, x and y")


class VenueClearance(Answer):
    """Distances between the benches and the venue."""

    misplaced: Misplaced | None = Field(description="The first bench that starts outside the square or in an obstacle")
    stray: Misplaced | None = Field(description="The same as misplaced, under its former name")
    areas: list[AreaClearance] = Field(description="The square, then the obstacles")


class HighestSpeed(Answer):
    """The highest speed of any handle over continuous time."""

    speed: float = measure("m/s", "Highest speed found")
    speed_bracket: tuple[float, float | None] = measure(
        "m/s", "Highest speed found, then a proven upper bound (null if the search gave up before proving one)"
    )
    time: float = measure("s", "Time at which it is reached")
    handles: list[int] = Field(description="Handles that reach it at that time")
    passage: int | None = Field(description="Index of the passage in which it is reached; null: in none")
    sentences: list[str] = SENTENCES


class SharpestBend(Answer):
    """Largest angle between two consecutive benches."""

    angle: float = measure("rad", "Angle between their headings")
    time: float = measure("s", "Time at which it is reached")
    benches: Pair = Field(description="The two benches")


class Failure(Answer):
    """One failed or undecided condition."""

    kind: core.FailureKind = Field(description="Kind of failure")
    time: float = measure(
        "s",
        "First time of the failure, or the first at which it is certain; for an undecided condition, the time until "
        "which it is proven to hold; for a speed, the first instant above the limit",
    )
    benches: list[int] = Field(description="Benches at fault; for a speed, the handles")
    area: str | None = Field(description="Area of the venue; null if the venue is not involved")
    names: list[str] = Field(description="Names of these benches, empty for one without; none where no bench has any")
    clock: str | None = Field(description="Time of day of that time, if start_clock or begin_clock is given")
    message: str = Field(description="The failure in one sentence")
    sentence: str = Field(description="The same for people: without its time, and with benches as they are called")
    time_bracket: Point | None = measure(
        "s",
        "Two times: proven not to fail up to the first; failing at the second. Null for a fold, or at the start",
    )
    head: Head | None = Field(description="The head at that time")
    peak_speed: float | None = measure(
        "m/s", "For a speed: the highest over the dance; null if it grows without bound towards a fold"
    )
    peak_time: float | None = measure("s", "For a speed: the time of the highest, or of the fold")

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


class Report(Answer):
    """Verdict on the dance, which stops at a contact or a fold."""

    verdict: core.Judgement = Field(
        description="passes: nothing fails; fails: at least one condition certainly fails; undecided: neither is proven"
    )
    passed: bool = Field(description="True if the verdict is passes")
    failures: list[Failure] = Field(
        description="Failed and undecided conditions, in order of time, until the dance stops"
    )
    start: float = measure("s", "Start of the time checked")
    stop: float = measure("s", "End of the time checked")
    first_contact: CollisionTime = Field(
        description="First time two benches come within the margin, or touch if it is 0"
    )
    least_clearance: LeastClearance | None = Field(
        description="Least clearance of any two benches; null with fewer than three, without details, or if people may "
        "stray so far that two benches are apart only because the one between them holds them"
    )
    venue: VenueClearance | None = Field(
        description="Distances between the benches and the venue, up to the end of the time checked; null without a "
        "venue"
    )
    highest_speed: HighestSpeed | None = Field(
        description="Highest speed of any handle; null in a run to a fold, where speed has no bound, or without details"
    )
    sharpest_bend: SharpestBend | None = Field(
        description="Sharpest bend between two consecutive benches; null for a single bench, or without details"
    )
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


class DragonFailure(Failure):
    """One failed or undecided condition of a dragon, or of two together; times are those of the performance."""

    dragons: list[int] = Field(
        description="The dragon at fault, or the two that come within the margin, in the order of the dances; empty if "
        "it is undecided which"
    )
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


class DragonsClearance(DragonPair):
    """The least clearance between two dragons over the performance."""

    distance: float = measure(
        "m",
        "Smallest distance found; 0 at the first touch, or at a later one if it is undecided which is the first; if "
        "two dragons overlap at the start, minus the depth",
    )
    at_least: float | None = measure(
        "m", "Proven lower bound; null: the search gave up before proving one, or the distance is below zero"
    )
    time: float = measure("s", "Time of the smallest distance")


class PerformanceReport(Answer):
    """Verdict on several dances on one clock."""

    verdict: core.Judgement = Field(
        description="passes: nothing fails; fails: at least one condition certainly fails; undecided: neither is proven"
    )
    passed: bool = Field(description="True if the verdict is passes")
    failures: list[DragonFailure] = Field(
        description="Failed and undecided conditions of each dragon by itself, and the first encounter of two, in "
        "order of time"
    )
    start: float = measure("s", "Start of the time checked")
    stop: float = measure("s", "End of the time checked")
    names: list[str | None] = Field(
        description="Names of the dragons, null for one without, in the order of the dances"
    )
    encounter: Encounter = Field(
        description="First time that benches of two dragons come within the margin, or touch if it is 0"
    )
    least_clearance: DragonsClearance | None = Field(
        description="Least clearance between two dragons; null for a single one, or without details"
    )
    reports: list[Report | None] = Field(
        description="Verdict on each dragon by itself in the venue, on the clock of its own dance, which is 0 at its "
        "delay; null for one that stands during the whole time checked"
    )
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
    return core.performance_check(performance, budget=terms.budget, **limits, **span)


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
