"""The command bench-dragon: the questions of the HTTP service, asked from a terminal.

The options of a command are the fields of the service's request, with the same names, limits and words. Answers go
to standard output, as tables for people or, with --json, as the service's JSON; progress and messages go to standard
error. Exit code 0 for an answer, also when benches touch or a check fails; 2 for wrong usage.
"""

from __future__ import annotations

import sys
from collections.abc import Callable
from enum import StrEnum
from pathlib import Path
from typing import Annotated, Any

import typer
from pydantic import Field
from typer.core import TyperGroup

import core
from app import answers, prove, report, schemas, show, tables
from app.extras import require
from app.files import TABLE_ENDINGS, checked_output, read_dance, read_json, trajectory_writer, write_whole
from app.jobs.command import jobs
from app.options import asks, checked, given, numbers, unused
from app.refusals import refusing
from app.settings import WORKERS_MAX, Settings
from core import BenchDragonError, Dragon, InvalidValue, Route, Spiral, Venue
from core.values import Floats

Json = Annotated[bool, typer.Option("--json", help="The service's JSON instead of a table.")]


class _Commands(TyperGroup):
    """Turns what a user can mend into one line on standard error and exit code 2."""

    def invoke(self, ctx: Any) -> Any:
        try:
            return super().invoke(ctx)
        except BenchDragonError as error:
            message = error.message
        except BrokenPipeError:
            raise
        except OSError as error:
            message = f"{error.filename}: {error.strerror}" if error.filename else str(error)
        print(f"Error: {message}", file=sys.stderr)
        raise typer.Exit(2)


app = typer.Typer(
    name="bench-dragon",
    cls=_Commands,
    help="Where every bench of a dancing dragon is, when two first touch, and how tight the spiral may be.",
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
    """The options that stand before a command."""


class TrajectoryOptions(schemas.TimeRange, schemas.DanceQuery):
    """POST /trajectory, flat."""

    decimals: int | None = Field(
        None, ge=0, le=15, description="Decimals of x, y and speed; else all (xlsx and the table on a terminal: 6)"
    )
    times: str | None = Field(None, description="Instants such as 0,60,120, in place of --start, --stop and --step [s]")
    handles: str | None = Field(
        None, description="Handles in the table, such as 0,1,51, in place of those that the contest asks for"
    )

    def to_instants(self, dragon: Dragon, path: Spiral, cells_max: int, ranged: list[str]) -> Floats:
        """Instants (T,) [s], a list or a range, whose options `ranged` are given. raises: TooLarge, InvalidValue"""
        if self.times is None:
            return self.to_times(dragon.benches + 1, cells_max)
        if ranged:
            raise InvalidValue("times", f"--times takes the place of --{ranged[0]}: give one of the two")
        listed = checked(schemas.TrajectoryRequest, {"times": numbers("times", self.times, float)})
        return listed.to_times(dragon, path, cells_max)

    def to_handles(self, dragon: Dragon) -> list[int] | None:
        """The handles asked for; None: nobody says. raises: InvalidValue"""
        if self.handles is None:
            return None
        found = numbers("handles", self.handles, int)
        for k, handle in enumerate(found):
            if not 0 <= handle <= dragon.benches:
                raise InvalidValue(
                    f"handles.{k}", f"handles[{k}] must be from 0 to {dragon.benches} for this dragon, got {handle}"
                )
        return found


class InstantOptions(schemas.TrajectoryFigureQuery, schemas.ContactQuery):
    """The dance at one instant."""


class FigureOptions(InstantOptions, schemas.PitchScanQuery):
    """GET /figures, all three."""


class Format(StrEnum):
    """File formats of a figure."""

    PNG = "png"
    SVG = "svg"


class Kind(StrEnum):
    """The figures, by the names of the service."""

    TRAJECTORY = "trajectory"
    CONTACT = "contact"
    PITCH_SCAN = "pitch-scan"


# What of the options each figure is drawn from.
FIGURE_OPTIONS: dict[Kind, type[schemas.UniformDragon]] = {
    Kind.TRAJECTORY: schemas.TrajectoryFigureQuery,
    Kind.CONTACT: schemas.ContactQuery,
    Kind.PITCH_SCAN: schemas.PitchScanQuery,
}


@app.command()
@asks(TrajectoryOptions)
def trajectory(
    asked: TrajectoryOptions,
    context: typer.Context,
    output: Annotated[Path | None, typer.Option(help="Write a .csv, .xlsx, .arrow or .json file.")] = None,
    language: Annotated[tables.Language, typer.Option(help="Names in an xlsx file.")] = tables.Language.ENGLISH,
    json: Json = False,
) -> None:
    """Where every handle is, and how fast."""
    ending = checked_output("output", output, TABLE_ENDINGS) if output else ".json" if json else None
    if ending and asked.handles is not None:
        raise InvalidValue("handles", "--handles chooses rows of the table: leave it out with --output or --json")
    if output and json:
        raise InvalidValue("json", "--json prints the answer and --output writes it to a file: give one of the two")
    if ending != ".xlsx":
        unused(context, ["language"], "is for the names in an xlsx file: give --output with .xlsx, or leave it out")
    write = trajectory_writer(ending, asked.decimals, language) if ending else None
    settings = Settings()
    dragon, path = asked.to_dragon(settings.benches_max), asked.to_path()
    handles, ranged = asked.to_handles(dragon), given(context, "start", "stop", "step")
    times = asked.to_instants(dragon, path, settings.cells_max, ranged)
    with show.waiting("trajectory"):
        result = core.trajectory(core.Dance(dragon, path, asked.head_speed), times)
        data = write(result) if write else b""
    if output:
        write_whole(output, data)
        print(f"{output}: {dragon.benches + 1} handles at {times.size} instants", file=sys.stderr)
    elif json:
        show.print_json(data)
    else:
        end = core.Dance(dragon, path, asked.head_speed).end
        fold, all_instants = end if end.bench is not None else None, asked.times is not None
        shown = show.trajectory_tables(result, handles, all_instants=all_instants, decimals=asked.decimals, fold=fold)
        show.print_parts(*shown)


@app.command()
@asks(schemas.CollisionQuery)
def collision_time(asked: schemas.CollisionQuery, json: Json = False) -> None:
    """When two benches first touch, or come nearer than a margin, and how that is known."""
    dragon, path = asked.to_dragon(Settings().benches_max), asked.to_path()
    with show.waiting("first contact"):
        found = core.first_contact(core.Dance(dragon, path, asked.head_speed), margin=asked.margin)
        answer = answers.CollisionTime.of(found, dragon, path, asked)
    title = f"First time that two benches are nearer than {asked.margin:g} m" if asked.margin else "First contact"
    show.print_answer(title, answer, json, margin=asked.margin, benches=dragon.benches)


@app.command()
@asks(schemas.MinimumPitchQuery)
def minimum_pitch(asked: schemas.MinimumPitchQuery, json: Json = False) -> None:
    """The smallest pitch such that every larger one lets the head reach the turning circle."""
    dragon, radius = asked.to_dragon(Settings().benches_max), asked.turning_diameter / 2
    with show.waiting("minimum pitch"):
        found = core.minimum_pitch(dragon, turning_radius=radius, start_turns=asked.start_turns, margin=asked.margin)
        answer = answers.MinimumPitch.of(found, dragon, asked)
    gap = f" and no bench nearer than {asked.margin:g} m to another" if asked.margin else ""
    title = f"Minimum pitch for a turning circle of {asked.turning_diameter:g} m{gap}"
    show.print_answer(title, answer, json, margin=asked.margin, benches=dragon.benches)


@app.command()
@asks(schemas.TurnQuery)
def turn(asked: schemas.TurnQuery, json: Json = False) -> None:
    """Two tangent arcs that lead from a spiral inwards to the same one outwards."""
    show.print_answer("Turn", report.Turn.of(asked.to_turn()), json)


@app.command()
@asks(schemas.ShortestTurnQuery)
def shortest_turn(asked: schemas.ShortestTurnQuery, json: Json = False) -> None:
    """The turn that begins as deep inside its circle as the dragon can dance, and what limits it."""
    with show.waiting("shortest turn"):
        found = asked.to_shortest_turn(Settings().checked_benches_max)
    gap = f" with no bench nearer than {asked.margin:g} m to another" if asked.margin else ""
    show.print_answer(f"Shortest turn{gap}", report.ShortestTurn.of_shortest(found), json, margin=asked.margin)


@app.command()
@asks(schemas.MaximumHeadSpeedQuery)
def maximum_head_speed(asked: schemas.MaximumHeadSpeedQuery, json: Json = False) -> None:
    """The largest constant head speed at which no handle exceeds the limit on the way through a turn."""
    dragon, path = asked.to_dragon(Settings().checked_benches_max), asked.to_turn()
    with show.waiting("maximum head speed"):
        found = core.maximum_head_speed(core.Dance(dragon, path), asked.speed_limit)
    answer = report.MaximumHeadSpeed.model_validate(found)
    show.print_answer(f"Maximum head speed for {asked.speed_limit:g} m/s", answer, json)


@app.command()
def check(
    file: Annotated[Path, typer.Argument(help="Dragon, path, venue and limits as for POST /check, .toml or .json.")],
    figure: Annotated[Path | None, typer.Option(help="Draw the dance, in a .svg or .png file.")] = None,
    time: Annotated[
        float | None, typer.Option(help="When it is drawn; else at the first failure or the closest [s]")
    ] = None,
    cross_check: Annotated[
        str | None,
        typer.Option(metavar="dragon|pair|none", help="Whom independent engines judge; else as the file says."),
    ] = None,
    json: Json = False,
) -> None:
    """Can the dragon dance this path here? What fails is an answer: the exit code is 0."""
    if time is not None and figure is None:
        raise InvalidValue("time", "--time says when --figure draws the dance: give --figure too, or leave --time out")
    if figure:
        require("figures", "figure", "--figure")
    ending = checked_output("figure", figure, (".svg", ".png")) if figure else ""
    told = read_dance(file)
    if cross_check is not None and isinstance(told, dict):
        told["cross_check"] = cross_check
    asked = checked(schemas.CheckRequest, told)
    with refusing(asked), show.waiting("check"):
        dragon, path = asked.dragon.to_dragon(Settings().checked_benches_max), asked.path.to_path()
        place = asked.to_place(dragon)
        found = asked.to_report(dragon, path, place)
        answer = report.Report.of(found, dragon, path, asked, place.origin)
        drawn = _drawn_check(dragon, path, place.venue, asked.head_speed, answer, ending[1:], time) if figure else b""
    if figure:
        write_whole(figure, drawn)
        print(figure, file=sys.stderr)
    if json:
        show.print_json(answer.to_json())
    else:
        show.print_parts(*show.report_tables(answer, margin=asked.margin, benches=dragon.benches))


def _drawn_check(
    dragon: Dragon,
    path: Spiral | Route,
    venue: Venue | None,
    head_speed: float,
    answer: report.Report,
    format: str,
    time: float | None,
) -> bytes:
    from app import figures as draw
    from app.drawing import Format as Drawn

    if time is None:
        closest = answer.least_clearance.time if answer.least_clearance else answer.start
        time = answer.failures[0].time if answer.failures else closest
    try:
        kind = Drawn(format)
        return draw.trajectory_figure(dragon, path, venue=venue, time=time, head_speed=head_speed, format=kind)
    except BenchDragonError as error:
        raise error.named("time") if error.field.startswith("times") else error from error


@app.command()
@asks(InstantOptions)
def overlaps(
    asked: InstantOptions,
    context: typer.Context,
    file: Annotated[
        Path | None, typer.Argument(help="Benches as for POST /overlaps (- for standard input), not the dance.")
    ] = None,
    json: Json = False,
) -> None:
    """Which benches overlap, or are nearer than a margin, at one instant, by four engines."""
    settings = Settings()
    if file:
        unused(
            context,
            InstantOptions.model_fields,
            "is about a dance, and the benches are those of FILE: give one of them",
        )
        benches = checked(schemas.OverlapsRequest, read_json(file))
        poses, lengths, widths = benches.to_poses(settings.poses_max)
        margin, chained = benches.margin, benches.chained
    else:
        dragon, path = asked.to_dragon(settings.poses_max), asked.to_path()
        handles = core.trajectory(core.Dance(dragon, path, asked.head_speed), [asked.time]).position[0]
        poses, lengths, widths = core.bench_poses(handles), dragon.lengths, dragon.widths
        margin, chained = asked.margin, True
    with show.waiting("overlaps"):
        found = core.overlaps(poses, lengths, widths, margin=margin, chained=chained)
        check = core.cross_check(poses, lengths, widths, margin=margin, chained=chained)
    answer = answers.OverlapsAnswer.of(found, check)
    if json:
        show.print_json(answer.to_json())
    else:
        show.print_parts(*show.overlap_tables(answer, margin))


@app.command()
@asks(FigureOptions)
def figures(
    asked: FigureOptions,
    context: typer.Context,
    folder: Annotated[Path, typer.Argument(help="Where the files go; made if missing.")] = Path(),
    kind: Annotated[list[Kind] | None, typer.Option(help="Which, once or more; else all three.")] = None,
    format: Annotated[Format, typer.Option(help="File format.")] = Format.PNG,
) -> None:
    """The paper's figures 6, 7 and 8 from live numbers, as files."""
    require("figures", "format", "A figure")
    drawn = {field for one in kind or list(Kind) for field in FIGURE_OPTIONS[one].model_fields}
    why = f"has no part in the figure {' or '.join(kind or [])}: leave it out, or draw another --kind too"
    unused(context, FigureOptions.model_fields.keys() - drawn, why)
    folder.mkdir(parents=True, exist_ok=True)
    files = {one: folder / f"{one.value}.{format.value}" for one in kind or list(Kind)}
    for file in files.values():
        checked_output("format", file)
    for one in files:
        with show.waiting(f"figure {one.value}") as progress:
            data = _drawn(asked, one, format, progress)
        write_whole(files[one], data)
        print(files[one], file=sys.stderr)


def _drawn(asked: FigureOptions, kind: Kind, format: Format, progress: Callable[[float], None]) -> bytes:
    from app import figures as draw
    from app.drawing import Format as Drawn

    dragon, path = asked.to_dragon(Settings().drawn_benches_max), asked.to_path()
    kind_of_file = Drawn(format)
    speed, margin = asked.head_speed, asked.margin
    match kind:
        case Kind.TRAJECTORY:
            return draw.trajectory_figure(dragon, path, time=asked.time, head_speed=speed, format=kind_of_file)
        case Kind.CONTACT:
            return draw.contact_figure(dragon, path, head_speed=speed, margin=margin, format=kind_of_file)
        case Kind.PITCH_SCAN:
            return draw.pitch_scan_figure(
                dragon,
                turning_radius=asked.turning_diameter / 2,
                start_turns=asked.start_turns,
                margin=margin,
                samples=asked.samples,
                format=kind_of_file,
                progress=progress,
            )


@app.command()
def paper(json: Json = False) -> None:
    """What the paper reports beside what this program computes, with the reason for each difference."""
    from app import paper as reported

    with show.waiting("recomputing the paper"):
        found = reported.comparison()
    if json:
        show.print_json(answers.PaperTable.model_validate({"rows": found}).to_json())
        return
    show.print_parts(*show.paper_tables(found))


@app.command()
def serve(
    host: Annotated[str, typer.Option(help="Address to listen on.")] = "127.0.0.1",
    port: Annotated[int, typer.Option(min=0, max=65535, help="Port to listen on.")] = 8000,
    workers: Annotated[
        int | None, typer.Option(min=1, max=WORKERS_MAX, help="Processes that share the port; else one for each core.")
    ] = None,
) -> None:
    """The HTTP service."""
    require("service", "serve", "serve")
    from app import workers as processes

    count = processes.process_count(workers)
    try:
        processes.serve(host, port, count)
    except OSError as taken:
        print(f"Error: cannot listen on {host}:{port}: {taken.strerror}", file=sys.stderr)
        raise typer.Exit(2) from taken
    except SystemExit as stop:  # The port is taken, or the address is not ours; uvicorn has said so.
        raise typer.Exit(2 if stop.code else 0) from stop


proofs = typer.Typer()
proofs.callback(invoke_without_command=True)(prove.prove)
proofs.command()(asks(prove.CollisionClaim)(prove.collision_time))
proofs.command()(asks(prove.PitchClaim)(prove.minimum_pitch))
proofs.command()(asks(prove.ClearClaim)(prove.clear))
proofs.command()(asks(prove.TurnClaim)(prove.turn))
proofs.command()(prove.dance)
app.add_typer(proofs, name="prove")
app.add_typer(jobs, name="jobs")
