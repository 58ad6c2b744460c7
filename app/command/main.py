"""The command bench-dragon: the questions of the HTTP service, asked from a terminal.

The options of a command are the fields of the service's request, with the same names, limits and descriptions; a FILE
holds the body of a request. Answers go to standard output, as tables for people or, with --json, as the service's
JSON; progress and messages go to standard error. The exit code is 0 for every answer, also when benches touch or a
check fails, and 2 for wrong usage.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator
from contextlib import contextmanager, nullcontext
from pathlib import Path
from typing import Annotated, Any

import typer
from typer.core import TyperGroup

import core
from app import questions
from app.command import contest, envelope, figures, film, grade, jobs, prove, show, sweep, trajectory
from app.command.options import Json, asks, unused
from app.command.usage import Misuse, told
from app.contest.solved import ContestRequest
from app.extras import require
from app.files.disk import (
    TABLE_ENDINGS,
    checked_output,
    object_words,
    read_dance,
    read_json,
    trajectory_writer,
    write_whole,
)
from app.files.tables import Language
from app.questions.check import CheckRequest
from app.questions.clearance import ClearanceQuery, ClearanceRequest
from app.questions.collision_time import CollisionQuery, CollisionRequest
from app.questions.contact_probability import ContactProbabilityQuery, ContactProbabilityRequest
from app.questions.envelope import EnvelopeQuery, EnvelopeRequest
from app.questions.figures import Format, InstantQuery, TrajectoryFigureRequest
from app.questions.films import FilmQuery, FilmRequest
from app.questions.maximum_head_speed import MaximumHeadSpeedQuery, MaximumHeadSpeedRequest
from app.questions.minimum_pitch import MinimumPitchQuery
from app.questions.overlaps import OverlapsRequest
from app.questions.question import Terms
from app.questions.shortest_turn import ShortestTurnQuery
from app.questions.tolerance import ToleranceQuery, ToleranceRequest
from app.questions.tolerance_curve import ToleranceCurveQuery
from app.questions.trajectory import TrajectoryRequest
from app.questions.turn import TurnQuery
from app.settings import WORKERS_MAX, Settings
from app.wire.dances import TimeRange
from app.wire.messages import checked
from app.wire.refusals import refusing
from core import BenchDragonError, InvalidValue
from core.errors import said


@contextmanager
def _one_line() -> Iterator[None]:
    """Context that turns errors that a user can correct into one line on standard error and exit code 2."""
    try:
        yield
        return
    except BenchDragonError as error:
        message = error.message
    except Misuse as error:
        message = told(error)
    except BrokenPipeError:
        raise
    except OSError as error:
        message = f"{error.filename or 'standard output'}: {error.strerror or error}"
    print(f"Error: {message}", file=sys.stderr)
    raise typer.Exit(2)


class _Commands(TyperGroup):
    """The commands; every mistake in their use is one line."""

    def make_context(self, info_name: Any, args: list[str], *further: Any, **extra: Any) -> Any:
        # Without any argument the parser prints the help, which it treats as a mistake too.
        with _one_line() if args else nullcontext():
            return super().make_context(info_name, args, *further, **extra)

    def invoke(self, ctx: Any) -> Any:
        with _one_line():
            result = super().invoke(ctx)
            sys.stdout.flush()
            return result


app = typer.Typer(
    name="bench-dragon",
    cls=_Commands,
    help="Where every bench of a dancing dragon is, when two benches first touch, and how tight the spiral may be.",
    no_args_is_help=True,
    pretty_exceptions_enable=False,
    context_settings={"help_option_names": ["-h", "--help"]},
)


def _print_version(asked: bool) -> None:
    if asked:
        print(f"bench-dragon {core.__version__}")
        raise typer.Exit


@app.callback()
def bench_dragon(
    version: Annotated[
        bool, typer.Option("--version", callback=_print_version, is_eager=True, help="Print the version and exit.")
    ] = False,
) -> None:
    """Options that come before a command."""


app.command("trajectory")(asks(trajectory.TrajectoryOptions, TrajectoryRequest)(trajectory.trajectory))
app.command()(figures.figures)
app.command("envelope")(asks(EnvelopeQuery, EnvelopeRequest)(envelope.envelope))
app.command("film")(asks(FilmQuery, FilmRequest)(film.film))
app.command("contest")(asks(ContestRequest)(contest.contest))
app.command()(grade.grade)


@app.command()
@asks(CollisionQuery, CollisionRequest)
def collision_time(asked: CollisionQuery | CollisionRequest, json: Json = False) -> None:
    """When two benches first touch, or come nearer than a margin, and how this is known."""
    with show.waiting("first contact"):
        answer = questions.collision_time.collision_time(asked, Terms())
    title = f"First time that two benches are nearer than {said(asked.margin)} m" if asked.margin else "First contact"
    if stray := asked.to_stray().total:
        title += f" that may come about with strays up to {said(stray)} m"
    show.print_answer(title, answer, json, margin=asked.margin, benches=asked.benches)


@app.command()
@asks(ClearanceQuery, ClearanceRequest)
def clearance(asked: ClearanceQuery | ClearanceRequest, json: Json = False) -> None:
    """Smallest distance between two benches that share no handle, and the pair, at every instant."""
    with show.waiting("clearance"):
        answer = questions.clearance.clearance(asked, Terms())
    if json:
        show.print_json(answer.to_json())
    else:
        show.print_parts(*show.clearance_tables(answer.columns))


@app.command()
@asks(MinimumPitchQuery)
def minimum_pitch(asked: MinimumPitchQuery, json: Json = False) -> None:
    """The smallest pitch such that every larger one lets the head reach the turning circle."""
    with show.waiting("minimum pitch"):
        answer = questions.minimum_pitch.minimum_pitch(asked, Terms())
    gap = f" and no bench nearer than {said(asked.margin)} m to another" if asked.margin else ""
    title = f"Minimum pitch for a turning circle of {said(asked.turning_diameter)} m{gap}"
    show.print_answer(title, answer, json, margin=asked.margin, benches=asked.benches)


@app.command()
@asks(TurnQuery)
def turn(asked: TurnQuery, json: Json = False) -> None:
    """Two tangent arcs that lead from a spiral inwards to the same one outwards."""
    show.print_answer("Turn", questions.turn.turn(asked, Terms()), json)


@app.command()
@asks(ShortestTurnQuery)
def shortest_turn(asked: ShortestTurnQuery, json: Json = False) -> None:
    """The turn with the deepest entry inside its circle that the dragon can dance, and what limits it."""
    with show.waiting("shortest turn"):
        answer = questions.shortest_turn.shortest_turn(asked, Terms())
    gap = f" with no bench nearer than {said(asked.margin)} m to another" if asked.margin else ""
    show.print_answer(f"Shortest turn{gap}", answer, json, margin=asked.margin)


@app.command()
@asks(ToleranceQuery, ToleranceRequest)
def tolerance(asked: ToleranceQuery | ToleranceRequest, json: Json = False) -> None:
    """How far people may stray before benches touch, proven, and a pose that shows where they do."""
    with show.waiting("tolerance"):
        answer = questions.tolerance.tolerance(asked, Terms())
    show.print_answer("How far people may stray", answer, json)


@app.command()
@asks(ToleranceCurveQuery)
def tolerance_curve(asked: ToleranceCurveQuery, json: Json = False) -> None:
    """How far people may stray against the pitch: proven safe, and shown to touch."""
    with show.waiting("tolerance curve") as progress:
        answer = questions.tolerance_curve.tolerance_curve(asked, Terms(progress=progress))
    if json:
        show.print_json(answer.to_json())
    else:
        show.print_parts(show.curve_table(answer.columns))


@app.command()
@asks(ContactProbabilityQuery, ContactProbabilityRequest)
def contact_probability(asked: ContactProbabilityQuery | ContactProbabilityRequest, json: Json = False) -> None:
    """How likely it is that benches touch when people wobble, from dances drawn at random."""
    with show.waiting("dances drawn at random") as progress:
        answer = questions.contact_probability.contact_probability(asked, Terms(progress=progress))
    show.print_answer("How likely a contact is when people wobble", answer, json)


@app.command()
@asks(MaximumHeadSpeedQuery, MaximumHeadSpeedRequest)
def maximum_head_speed(asked: MaximumHeadSpeedQuery | MaximumHeadSpeedRequest, json: Json = False) -> None:
    """The largest constant head speed at which no handle exceeds the limit on the way through a turn."""
    with show.waiting("maximum head speed"):
        answer = questions.maximum_head_speed.maximum_head_speed(asked, Terms())
    show.print_answer(f"Maximum head speed for {said(asked.speed_limit)} m/s", answer, json)


@app.command()
def check(
    file: Annotated[
        Path, typer.Argument(help="Dragon, path, venue and limits as for POST /check, as a .toml or .json file.")
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
            metavar="dragon|pair|none", help="Benches that independent engines check; default: as in the file."
        ),
    ] = None,
    json: Json = False,
) -> None:
    """Can the dragon dance this path here? A failure is an answer too: the exit code is 0."""
    if time is not None and figure is None:
        raise InvalidValue("time", "--time is the time that --figure draws: give --figure too, or leave --time out")
    if figure:
        require("figures", "figure", "--figure")
    ending = checked_output("figure", figure, (".svg", ".png")) if figure else ""
    write = (
        trajectory_writer(checked_output("output", output, TABLE_ENDINGS), None, Language.ENGLISH) if output else None
    )
    dance = read_dance(file)
    if cross_check is not None:
        dance["cross_check"] = cross_check
    asked = checked(CheckRequest, dance, object_words(file))
    with refusing(asked), show.waiting("check"):
        answer = questions.check.check(asked, Terms())
        drawn = _drawn_check(asked, answer, Format(ending[1:]), time) if figure else b""
        table = write(_danced(asked, answer)) if write else b""
    if figure:
        write_whole(figure, drawn)
        print(figure, file=sys.stderr)
    if output:
        write_whole(output, table)
        print(output, file=sys.stderr)
    if json:
        show.print_json(answer.to_json())
    else:
        show.print_parts(*show.report_tables(answer, margin=asked.margin, benches=asked.benches))


def _danced(asked: CheckRequest, answer: questions.check.Report) -> core.Trajectory:
    """Positions and speeds at every second of the stretch that was judged, within the run."""
    settings = Settings()
    dance = asked.to_dance(settings.checked_benches_max)
    stop = dance.end.time if asked.stop is None else min(asked.stop, dance.end.time)
    steps = TimeRange(start=answer.start, stop=stop)
    return core.trajectory(dance, steps.times_of(dance, settings.cells_max))


def _drawn_check(asked: CheckRequest, answer: questions.check.Report, format: Format, time: float | None) -> bytes:
    if time is None:
        closest = answer.least_clearance.time if answer.least_clearance else answer.start
        time = answer.failures[0].time if answer.failures else closest
    shown = {name: getattr(asked, name) for name in TrajectoryFigureRequest.model_fields if name != "time"}
    # The time does not come from the file, so a refusal of it must name the option.
    picture = TrajectoryFigureRequest.model_construct(**shown, time=time)
    with refusing(picture):
        return questions.figures.trajectory_figure(picture, Terms(), format.media_type)


@app.command()
@asks(InstantQuery)
def overlaps(
    asked: InstantQuery,
    context: typer.Context,
    file: Annotated[
        Path | None, typer.Argument(help="Benches as for POST /overlaps, in place of a dance (- for standard input).")
    ] = None,
    json: Json = False,
) -> None:
    """Benches that overlap, or are nearer than a margin, at one instant, according to four engines."""
    if file:
        why = "describes a dance, and FILE gives the benches: give one of the two"
        unused(context, InstantQuery.model_fields, why)
        benches = checked(OverlapsRequest, read_json(file))
    with show.waiting("overlaps"):
        if file:
            answer, margin = questions.overlaps.overlaps(benches, Terms()), benches.margin
        else:
            answer, margin = questions.overlaps.of_dance(asked, Terms()), asked.margin
    if json:
        show.print_json(answer.to_json())
    else:
        show.print_parts(*show.overlap_tables(answer, margin))


@app.command()
def paper(json: Json = False) -> None:
    """The paper's numbers beside those of this program, with the reason for each difference."""
    with show.waiting("recomputing the paper"):
        answer = questions.paper.paper(questions.paper.Nothing(), Terms())
    if json:
        show.print_json(answer.to_json())
    else:
        show.print_parts(*show.paper_tables(answer.rows, answer.literature))


@app.command()
def serve(
    host: Annotated[str, typer.Option(help="Address to listen on.")] = "127.0.0.1",
    port: Annotated[int, typer.Option(min=0, max=65535, help="Port to listen on.")] = 8000,
    workers: Annotated[
        int | None,
        typer.Option(min=1, max=WORKERS_MAX, help="Processes that share the port; default: one for each core."),
    ] = None,
) -> None:
    """Start the HTTP service and the web page."""
    require("service", "serve", "serve")
    from app.service import workers as processes

    count = processes.process_count(workers)
    try:
        processes.serve(host, port, count)
    except OSError as taken:
        print(f"Error: cannot listen on {host}:{port}: {taken.strerror}", file=sys.stderr)
        raise typer.Exit(2) from taken
    except SystemExit as stop:  # The port is taken, or the address is not local; uvicorn has printed it.
        raise typer.Exit(2 if stop.code else 0) from stop


proofs = typer.Typer()
proofs.callback(invoke_without_command=True)(prove.prove)
proofs.command()(asks(prove.CollisionClaim)(prove.collision_time))
proofs.command()(asks(prove.PitchClaim)(prove.minimum_pitch))
proofs.command()(asks(prove.ClearClaim)(prove.clear))
proofs.command()(asks(prove.StrayClaim)(prove.tolerance))
proofs.command()(asks(prove.TurnClaim)(prove.turn))
proofs.command()(prove.dance)
app.add_typer(proofs, name="prove")
app.add_typer(jobs.jobs, name="jobs")
app.add_typer(sweep.app, name="sweep")
