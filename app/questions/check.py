"""The question check: the verdict on a dance in its venue."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import TYPE_CHECKING, Any, Self, TypeAlias

from pydantic import Field

import core
from app.files.tables import TABLE_EXTRAS
from app.questions import figures, trajectory
from app.questions.collision_time import CollisionTime, Contact
from app.questions.encounter import Encounter
from app.wire import evidence
from app.wire.answers import SENTENCES, DragonPair
from app.wire.clocks import clock_at_zero, time_of_day
from app.wire.dances import PlacedDance, SpanFields, TimeRange, clock_of
from app.wire.fields import Answer, CrossCheck, SpeedLimit, Wire, measure
from app.wire.geojson import SQUARE
from app.wire.labels import DISPLAY_DECIMALS, Heading, Part, TextTable, judged_words, separation, value_text, value_word
from app.wire.performances import SeveralFields
from app.wire.question import UNKNOWN_COST, Command, Output, Question, Terms, Writer
from app.wire.readings import (
    Limits,
    day_words,
    dragons_failure_words,
    failure_words,
    met_words,
    speed_words,
    way_words,
)
from app.wire.refusals import refusing
from core import Dance, FailureKind, Judgement, Performance, Venue
from core.language import phrase, say
from core.quantities import format_bound, format_number
from core.values import Pair, Point

if TYPE_CHECKING:
    from app.wire.degrees import Place


# What FILE holds for a question about a dance as for this one.
FILE_OF_CHECK = "Dragon, path, venue and limits as for check: .toml or .json."


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


class AreaClearance(Answer, of=core.AreaClearance, leave=()):
    """Distance between the benches and the edges of the square or of one obstacle."""

    name: str
    overlapping: int | None
    bench: int | None
    gap: float | None
    point: Point | None
    nearest: core.Nearest | None


class VenueClearance(Answer, of=core.VenueClearance, leave=()):
    """Distances between the benches and the venue.

    stray: the same as misplaced, under its former name
    """

    stray: core.Misplaced | None
    areas: list[AreaClearance]


class HighestSpeed(Answer, of=core.HighestSpeed, leave=()):
    """The highest speed of any handle over continuous time."""

    speed: float
    time: float
    handles: list[int]
    sentences: list[str] = SENTENCES
    words: evidence.Words | None = evidence.WORDS


class Failure(Answer, of=core.Failure, leave=()):
    """One failed or undecided condition.

    names: names of these benches, empty for one without; none where no bench has any
    clock: time of day of that time, if start_clock or begin_clock is given
    sentence: the same for people: without its time, and with benches as they are called
    """

    kind: core.FailureKind
    time: float
    area: str | None
    names: list[str]
    clock: str | None
    message: str
    sentence: str
    time_bracket: Point | None

    @classmethod
    def of(cls, result: core.Failure, dragon: core.Dragon, start_clock: str | None, sentence: str = "") -> Self:
        clock = _clock(result.time, start_clock)
        # A handle has the number of the bench behind it; the last handle is at the rear of the last bench.
        benches = [min(bench, dragon.benches - 1) for bench in result.benches]
        names = [dragon.names[bench] for bench in benches if dragon.names]
        return cls.from_result(result, names=names, clock=clock, sentence=sentence or result.message)


class Origin(Answer):
    """A place on earth.

    longitude: longitude, east positive [degrees]
    latitude: latitude, north positive [degrees]
    """

    longitude: float
    latitude: float


class Report(Answer, of=core.Report, leave=()):
    """Verdict on the dance, which stops at a contact or a fold.

    begins: time of day at start, if start_clock or begin_clock is given
    ends: time of day at stop, if start_clock or begin_clock is given
    origin: place of x = y = 0; null unless the venue was given in degrees or states it
    """

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
    sentences: list[str] = SENTENCES
    begins: str | None
    ends: str | None
    origin: Origin | None

    @classmethod
    def of(cls, result: core.Report, request: DanceCheck, terms: Terms, place: Place, clock: str | None) -> Self:
        dragon = result.first_contact.dance.dragon
        contact = CollisionTime.of(result.first_contact, request, terms)
        limits = limits_of(request, place.venue)
        failures = [
            Failure.of(failure, dragon, clock, failure_words(failure, dragon, limits)) for failure in result.failures
        ]
        venue = None if result.venue is None else VenueClearance.from_result(result.venue, stray=result.venue.misplaced)
        begins, ends = _clock(result.start, clock), _clock(result.stop, clock)
        speed = result.highest_speed and HighestSpeed.from_result(
            result.highest_speed,
            sentences=[speed_words(result.highest_speed)],
            words=evidence.speed_words(result.highest_speed) if terms.words else None,
        )
        words = [
            *way_words(result.first_contact.dance, result.start, result.stop, begins),
            *day_words(begins, ends),
            *place.words(),
        ]
        own = {"failures": failures, "first_contact": contact, "venue": venue, "origin": place.origin}
        own |= {"sentences": words}
        return cls.from_result(result, begins=begins, ends=ends, highest_speed=speed, **own)


class DragonFailure(Failure, of=core.PerformanceFailure):
    """One failed or undecided condition of a dragon, or of two together; times are those of the performance.

    dragon_names: their names; null for a dragon without one
    """

    dragons: list[int]
    dragon_names: list[str | None]

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
            sentence = dragons_failure_words(result, performance, limits)
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
            clock=_clock(result.time, clock),
            head=None,
            peak_speed=None,
            peak_time=None,
            dragon_names=names,
            sentence=dragons_failure_words(result, performance, limits),
        )


class DragonsClearance(DragonPair, of=core.PerformanceLeastClearance):
    """The least clearance between two dragons over the performance."""

    distance: float
    at_least: float | None
    time: float


class PerformanceReport(Answer, of=core.PerformanceReport, leave=("performance",)):
    """Verdict on several dances on one clock.

    names: names of the dragons, null for one without, in the order of the dances
    begins: time of day at start, if start_clock or begin_clock is given
    ends: time of day at stop, if start_clock or begin_clock is given
    origin: place of x = y = 0; null unless the venue was given in degrees or states it
    """

    verdict: core.Judgement
    passed: bool
    failures: list[DragonFailure]
    start: float
    stop: float
    names: list[str | None]
    encounter: Encounter
    least_clearance: DragonsClearance | None
    reports: list[Report | None]
    sentences: list[str] = SENTENCES
    begins: str | None
    ends: str | None
    origin: Origin | None

    @classmethod
    def of(cls, result: core.PerformanceReport, request: CheckRequest, terms: Terms, place: Place) -> Self:
        performance = result.performance
        clock = clock_of(request, performance)
        least, parts, limits = result.least_clearance, performance.parts, limits_of(request, place.venue)
        own: list[Report | None] = []
        for report, part in zip(result.reports, parts, strict=True):
            zero = None if clock is None else clock_at_zero(clock, -part.delay)
            own.append(None if report is None else Report.of(report, request, terms, place, zero))
        begins, ends = _clock(result.start, clock), _clock(result.stop, clock)
        return cls.from_result(
            result,
            failures=[DragonFailure.in_performance(failure, performance, clock, limits) for failure in result.failures],
            names=[part.name for part in parts],
            encounter=Encounter.of(result.encounter, request, terms),
            least_clearance=None if least is None else DragonsClearance.from_result(least),
            reports=own,
            sentences=[*([] if result.encounter.benches else met_words(result.encounter)), *day_words(begins, ends)],
            begins=begins,
            ends=ends,
            origin=place.origin,
        )


def _clock(time: float, start_clock: str | None) -> str | None:
    """The time of day at a time [s]; None if it is not known."""
    return None if start_clock is None else time_of_day(time, start_clock)


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


def verdict_together(request: DanceCheck, performance: Performance, terms: Terms) -> core.PerformanceReport:
    """The verdict on several dances as an object of core. raises: InvalidValue"""
    span: dict[str, Any] = {"start": request.start, "stop": request.stop, "details": request.details}
    return core.check(performance, budget=terms.budget, **request.to_limits(), **span)


def verdict_of(
    request: DanceCheck, dance: Dance, venue: Venue | None, start: float | None, terms: Terms, *, details: bool = True
) -> core.Report:
    """The verdict as an object of core. start: of the time checked [s]; raises: InvalidValue"""
    question, limits = core.check if details else core.quick_check, request.to_limits()
    return question(dance, venue=venue, start=start, stop=request.stop, budget=terms.budget, **limits)


def _cost(request: CheckRequest) -> float:
    """A drawn dance of 60 benches through 20 waypoints takes 0.011 s, with four areas 0.016 s (measured 2026-11-22)."""
    if request.details or request.dances is not None or request.path.kind != "waypoints":
        return UNKNOWN_COST
    return 0.02 + 4e-4 * request.benches + 5e-4 * len(request.path.points)


def _with_files(request: CheckRequest, terms: Terms) -> tuple[Report | PerformanceReport, dict[str, Writer]]:
    """The answer, and what draws the dance and writes it as a table."""
    answer = check(request, terms)
    return answer, {
        "figure": lambda form, time: _drawn(request, answer, terms, form, time),
        "output": lambda form: _table(request, answer, terms, form),
    }


def _table(request: CheckRequest, answer: Report | PerformanceReport, terms: Terms, form: str) -> bytes:
    """Positions and speeds at every second of the judged interval, within the run, as a file."""
    settings, stop = terms.settings, answer.stop
    dance: Dance | Performance
    if isinstance(answer, PerformanceReport):
        dance = request.to_performance(settings)
    else:
        dance = request.to_dance(settings.checked_benches_max)
        stop = dance.end.time if request.stop is None else min(request.stop, dance.end.time)
    seconds = TimeRange(start=answer.start, stop=stop).times_of(dance, settings.cells_max)
    data = trajectory.written(request, dance, core.trajectory(dance, seconds, budget=terms.budget), form)
    return data if isinstance(data, bytes) else b"".join(data)


def _drawn(
    request: CheckRequest, answer: Report | PerformanceReport, terms: Terms, form: str, time: float | None
) -> bytes:
    """The dance at a time, or at its first failure, else where two benches are nearest; dragons at their encounter."""
    meet = time is None and isinstance(answer, PerformanceReport) and answer.encounter.dragons is not None
    if time is None:
        closest = answer.least_clearance.time if answer.least_clearance else answer.start
        time = answer.failures[0].time if answer.failures else closest
    if isinstance(answer, PerformanceReport):
        from app.files.performances import encounter_figure  # matplotlib takes a second to import

        performance, _ = request.to_placed(terms.settings)
        limits: dict[str, Any] = {"margin": request.margin, "stray": request.to_stray(), "budget": terms.budget}
        met = core.first_encounter(performance, start=request.start, stop=request.stop, **limits) if meet else None
        return encounter_figure(performance, met, time=None if meet else time, format=figures.FORMATS[form])
    fields = {name: getattr(request, name) for name in PlacedDance.model_fields}
    # The time may come from an option, so a refusal of it must name the option.
    picture = figures.TrajectoryFigureRequest.model_construct(**fields, time=time)
    with refusing(picture):
        return figures.trajectory_figure(picture, terms, form)


# What is measured, its value, its time [s], and whose it is.
Row: TypeAlias = tuple[str, str, float | None, str]
VERDICTS = {
    Judgement.PASSES: phrase("Passes. Nothing fails."),
    Judgement.FAILS: phrase("Fails. Failures in order of time:"),
    Judgement.UNDECIDED: phrase("Undecided. No failure is known, but these questions are open:"),
}


def _parts(report: Report | PerformanceReport, request: CheckRequest) -> Iterator[Part]:
    """The verdict, the failures in order of time, and the measured values."""
    yield Heading(say(VERDICTS[report.verdict]))
    yield from (f"  {one.clock + '  ' if one.clock else ''}{one.message}" for one in report.failures)
    if report.begins:
        yield say("Starts {begin}, ends {end}.", begin=report.begins, end=report.ends)
    yield ""
    title = say("From {start:.3f} to {stop:.3f} s", start=report.start, stop=report.stop)
    facts = TextTable(title, say("what"), say("value"), say("at"), say("who"))
    rows = (
        _measured(report, request.margin, request.benches)
        if isinstance(report, Report)
        else _measured_together(report, request)
    )
    for name, value, time, who in rows:
        facts.add(name, value, "" if time is None else f"{time:.6f} s", who)
    yield facts
    if at := report.origin:
        yield say(
            "x = y = 0 is longitude {longitude:.6f}, latitude {latitude:.6f}: the middle of the square.",
            longitude=at.longitude, latitude=at.latitude,
        )  # fmt: skip


def _measured_together(report: PerformanceReport, request: CheckRequest) -> Iterator[Row]:
    """Rows of any two dragons, then those of each by itself."""
    met, dances = report.encounter, request.dances or []
    names = [name or say("dragon {k}", k=k) for k, name in enumerate(report.names)]

    def pair(dragons: Pair | None, benches: Pair | None) -> str:
        both = zip(dragons or (), benches or (), strict=True)
        return say(" and ").join(say("bench {bench} of {name}", bench=bench, name=names[k]) for k, bench in both)

    near = say("two dragons first within {margin} m", margin=format_number(met.margin))
    what = near if met.margin else say("first encounter")
    who = pair(met.dragons, met.benches)
    yield _with_strays(what, met.stray), value_word(met.outcome.value, met.margin), met.time, who
    if check := met.cross_check:
        yield say("cross-check"), _agreement(check.agree), None, ""
    if least := report.least_clearance:
        yield say("least clearance of two dragons"), _least(least), least.time, pair(least.dragons, least.benches)
    for name, dance, own in zip(names, dances, report.reports, strict=True):
        if own is None:
            yield say("{name}: stands", name=name), "", None, ""
            continue
        for what, value, time, who in _measured(own, request.margin, dance.benches):
            yield say("{name}: {text}", name=name, text=what), value, None if time is None else time + dance.delay, who


def _with_strays(what: str, stray: float | None) -> str:
    return say("{what} with strays up to {stray} m", what=what, stray=format_number(stray)) if stray else what


def _agreement(agree: bool) -> str:
    return say("engines agree") if agree else say("engines DISAGREE")


def _pair(benches: Pair) -> str:
    return say("benches {pair}", pair=value_text(benches))


def _least(least: core.LeastClearance | DragonsClearance) -> str:
    overlap = separation(least.distance, " m", DISPLAY_DECIMALS) if least.distance < 0.0 else ""
    return overlap or _distance(least)


def _measured(report: Report, margin: float, benches: int) -> Iterator[Row]:
    """Rows of quantity, value, time and benches."""
    contact = report.first_contact
    pair = _pair(contact.benches) if contact.benches else ""
    what = say("first within {margin} m", margin=format_number(margin)) if margin else say("first contact")
    yield _with_strays(what, contact.stray), value_word(contact.outcome.value, margin), contact.time, pair
    if check := contact.cross_check:
        yield say("cross-check"), _agreement(check.agree), None, judged_words(check.judged, benches)
    if least := report.least_clearance:
        yield say("least clearance"), _least(least), least.time, _pair(least.benches)
    for area in report.venue.areas if report.venue else ():
        if near := area.nearest:
            name = say("square") if area.name == SQUARE else area.name
            what, who = say("nearest to {name}", name=name), say("bench {k}", k=near.bench)
            yield what, _distance(near), near.time, who
    if speed := report.highest_speed:
        several, who = len(speed.handles) > 1, value_text(speed.handles)
        who = say("handles {which}", which=who) if several else say("handle {which}", which=who)
        yield say("highest speed"), f"{speed.speed:.6f} m/s", speed.time, who
    elif any(one.kind is FailureKind.FOLDS for one in report.failures):
        yield say("highest speed"), say("grows without bound"), report.stop, say("towards the fold")
    if bend := report.sharpest_bend:
        yield say("sharpest bend"), f"{bend.angle:.6f} rad", bend.time, _pair(bend.benches)


def _distance(nearest: core.LeastClearance | DragonsClearance | core.Nearest) -> str:
    least = nearest.at_least
    if least is None:
        return say("{distance:.6f} m, not proven", distance=nearest.distance)
    bound = format_bound(least, DISPLAY_DECIMALS)
    return say("{distance:.6f} m, proven: at least {bound} m", distance=nearest.distance, bound=bound)


class Checked(Wire):
    """What of a request may be an option."""

    cross_check: CrossCheck = "dragon"


class DrawnTime(Wire):
    """The instant of a picture."""

    time: float | None = measure("s", "Time to draw; default: the first failure, else the least clearance", None)


QUESTION = Question(
    check,
    Report,
    body=CheckRequest,
    cost=_cost,
    several=PerformanceReport,
    command=Command(
        "Verdict on a dance, or several: contacts, limits and venue. The exit code is 0, also for a dance that fails.",
        lambda request: say("check"),
        _parts,
        options=Checked,
        file="Dragon and path, or dances; venue and limits, as for POST /check, as .toml or .json.",
        outputs={
            "figure": Output(
                "Draw the dance into a .svg or .png file.",
                figures.PICTURES,
                extras=dict.fromkeys(figures.PICTURES, "figures"),
                options=DrawnTime,
            ),
            "output": Output(
                "Write positions and speeds at every second to a .csv, .xlsx, .arrow or .json file.",
                {ending: form for form, ending in trajectory.ENDINGS.items()},
                extras=TABLE_EXTRAS,
            ),
        },
        solve=_with_files,
    ),
)
