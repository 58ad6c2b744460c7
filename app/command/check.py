"""The command check: a verdict on one dance in its venue, or on several on one clock."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Annotated, Any, TypeAlias

import typer

import core
from app.command import show
from app.command.options import Json
from app.command.usage import path_argument
from app.extras import require
from app.files.disk import checked_output, object_words
from app.files.performance_tables import PerformanceTable, performance_file
from app.files.tables import TABLE_ENDINGS, trajectory_writer
from app.maps.dances import read_dance
from app.questions import check as checks
from app.questions import figures
from app.questions.check import CheckRequest, DragonsClearance, PerformanceReport, Report
from app.questions.figures import Format, TrajectoryFigureRequest
from app.settings import Settings
from app.wire.answers import Pair
from app.wire.dances import PlacedDance, TimeRange, clock_of
from app.wire.geojson import SQUARE
from app.wire.labels import Heading, Part, Table, judged_words, separation, value_text, value_word
from app.wire.messages import checked
from app.wire.question import Terms
from app.wire.refusals import refusing
from core import FailureKind, InvalidValue, Judgement
from core.errors import format_bound, format_number
from core.language import phrase, say


def check(
    file: Annotated[
        Path,
        path_argument("FILE", "Dragon and path, or dances; venue and limits, as for POST /check, as .toml or .json."),
    ],
    figure: Annotated[Path | None, typer.Option(help="Draw the dance into a .svg or .png file.")] = None,
    time: Annotated[
        float | None, typer.Option(help="Time to draw [s]; default: the first failure, else the least clearance")
    ] = None,
    output: Annotated[
        Path | None,
        typer.Option(help="Write positions and speeds at every second to a .csv, .xlsx, .arrow or .json file."),
    ] = None,
    cross_check: Annotated[
        str | None,
        typer.Option(
            metavar="dragon|pair|none",
            help="Benches that independent engines check a second time; default: as in the file.",
        ),
    ] = None,
    json: Json = False,
) -> None:
    """Verdict on a dance, or several: contacts, limits and venue. The exit code is 0, also for a dance that fails."""
    if time is not None and figure is None:
        words = "--time is the instant that --figure draws: give --figure too, or leave --time out"
        raise InvalidValue.in_words("time", words)
    if figure:
        require("figures", "figure", "--figure")
    ending = checked_output("figure", figure, (".svg", ".png")) if figure else ""
    suffix = checked_output("output", output, TABLE_ENDINGS) if output else ""
    dance = read_dance(file, several=True)
    if cross_check is not None:
        dance["cross_check"] = cross_check
    request = checked(CheckRequest, dance, object_words(file))
    with refusing(request), show.waiting(say("check")):
        answer = checks.check(request, Terms())
        drawn = _drawn(request, answer, Format(ending[1:]), time) if figure else b""
        table = _table(request, answer, suffix) if suffix else b""
    if figure:
        show.write(figure, drawn)
    if output:
        show.write(output, table)
    show.print_result(answer, json, _report_parts(answer, request))


def _table(request: CheckRequest, answer: Report | PerformanceReport, ending: str) -> bytes:
    """Positions and speeds at every second of the judged interval, within the run, as a file with that ending."""
    settings = Settings()
    if isinstance(answer, PerformanceReport):
        performance = request.to_performance(settings)
        seconds = TimeRange(start=answer.start, stop=answer.stop).times_of(performance, settings.cells_max)
        results = core.trajectory(performance, seconds)
        return performance_file(ending, PerformanceTable(performance, results, clock=clock_of(request, performance)))
    dance = request.to_dance(settings.checked_benches_max)
    stop = dance.end.time if request.stop is None else min(request.stop, dance.end.time)
    seconds = TimeRange(start=answer.start, stop=stop).times_of(dance, settings.cells_max)
    write = trajectory_writer(ending, None, clock_of(request, dance))
    return write(core.trajectory(dance, seconds))


def _drawn_performance(request: CheckRequest, answer: PerformanceReport, format: Format, time: float | None) -> bytes:
    """All dragons at a time, or at their encounter, else at the first failure or where two are nearest."""
    from app.files.performances import encounter_figure  # matplotlib takes a second to import

    performance, _ = request.to_placed(Settings())
    met = None
    if time is None and answer.encounter.dragons is not None:
        limits: dict[str, Any] = {"margin": request.margin, "stray": request.to_stray()}
        met = core.first_encounter(performance, start=request.start, stop=request.stop, **limits)
    elif time is None:
        closest = answer.least_clearance.time if answer.least_clearance else answer.start
        time = answer.failures[0].time if answer.failures else closest
    return encounter_figure(performance, met, time=time, format=format.value)


def _drawn(request: CheckRequest, answer: Report | PerformanceReport, format: Format, time: float | None) -> bytes:
    if isinstance(answer, PerformanceReport):
        return _drawn_performance(request, answer, format, time)
    if time is None:
        closest = answer.least_clearance.time if answer.least_clearance else answer.start
        time = answer.failures[0].time if answer.failures else closest
    fields = {name: getattr(request, name) for name in PlacedDance.model_fields}
    # The time comes from an option, not from the file, so a refusal of it must name the option.
    picture = TrajectoryFigureRequest.model_construct(**fields, time=time)
    with refusing(picture):
        return figures.trajectory_figure(picture, Terms(), format.media_type)


# What is measured, its value, its time [s], and whose it is.
Row: TypeAlias = tuple[str, str, float | None, str]
VERDICTS = {
    Judgement.PASSES: phrase("Passes. Nothing fails."),
    Judgement.FAILS: phrase("Fails. Failures in order of time:"),
    Judgement.UNDECIDED: phrase("Undecided. No failure is known, but these questions are open:"),
}


def _report_parts(report: Report | PerformanceReport, request: CheckRequest) -> Iterator[Part]:
    """The verdict, the failures in order of time, and the measured values."""
    yield Heading(say(VERDICTS[report.verdict]))
    yield from (f"  {one.clock + '  ' if one.clock else ''}{one.message}" for one in report.failures)
    if report.begins:
        yield say("Starts {begin}, ends {end}.", begin=report.begins, end=report.ends)
    yield ""
    title = say("From {start:.3f} to {stop:.3f} s", start=report.start, stop=report.stop)
    facts = Table(title, say("what"), say("value"), say("at"), say("who"))
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
    overlap = separation(least.distance, " m", show.DISPLAY_DECIMALS) if least.distance < 0.0 else ""
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
    bound = format_bound(least, show.DISPLAY_DECIMALS)
    return say("{distance:.6f} m, proven: at least {bound} m", distance=nearest.distance, bound=bound)
