"""The command bench-dragon: the questions of the HTTP service, asked from a terminal.

The options of a command are the fields of the service's request, with the same names, limits and words. Answers go
to standard output, as tables for people or, with --json, as the service's JSON; progress and messages go to standard
error. Exit code 0 for an answer, also when benches touch; 2 for wrong usage.
"""

from __future__ import annotations

import inspect
import re
import sys
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from enum import StrEnum
from pathlib import Path
from typing import Annotated, Any, TypeVar

import numpy as np
import orjson
import typer
from pydantic import BaseModel, Field, ValidationError
from rich import box
from rich.console import Console
from rich.markup import escape
from rich.progress import Progress
from rich.table import Table
from rich.text import Text
from typer.core import TyperGroup

import core
from app import answers, prove, schemas, tables
from app.messages import message
from app.settings import Settings
from core import BenchDragonError, InvalidValue, Trajectory

# A wait longer than this is shown [s].
SHOWN_WAIT = 1.0
# A trajectory on a terminal: the handles that the contest asks for, at this many instants.
SHOWN_HANDLES = (0, 1, 51, 101, 151, 201)
SHOWN_INSTANTS = 5
# Width of a table where standard output is no terminal [characters].
PIPE_WIDTH = 120

Model = TypeVar("Model", bound=BaseModel)
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
    add_completion=False,
    pretty_exceptions_enable=False,
    context_settings={"help_option_names": ["-h", "--help"]},
)


class TrajectoryOptions(schemas.TimeRange, schemas.DanceQuery):
    """POST /trajectory, flat."""

    decimals: int | None = Field(None, ge=0, le=15, description="Decimals of x, y and speed; else all (xlsx: 6)")


class InstantOptions(schemas.TrajectoryFigureQuery, schemas.CollisionQuery):
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


def _checked(model: type[Model], values: object) -> Model:
    """The values as the service's own request; a wrong one is refused in the service's words."""
    try:
        return model.model_validate(values)
    except ValidationError as error:
        first = error.errors()[0]
        field = ".".join(str(part) for part in first["loc"])
        raise InvalidValue(field, message({**first, "loc": ("", *first["loc"])})) from error


def _asks(model: type[Model]) -> Callable[[Callable[..., None]], Callable[..., None]]:
    """Make the fields of a request the options of a command; the command gets the request as its first argument."""

    def decorated(command: Callable[..., None]) -> Callable[..., None]:
        own = list(inspect.signature(command, eval_str=True).parameters.values())[1:]
        fields = [
            inspect.Parameter(
                name,
                inspect.Parameter.KEYWORD_ONLY,
                default=field.default,
                annotation=Annotated[field.annotation, typer.Option(help=escape(field.description or ""))],
            )
            for name, field in model.model_fields.items()
        ]

        def asked(**values: Any) -> None:
            request = _checked(model, {name: values.pop(name) for name in model.model_fields})
            command(request, **values)

        parameters = [p.replace(kind=inspect.Parameter.KEYWORD_ONLY) for p in own] + fields
        asked.__signature__ = inspect.Signature(parameters)  # type: ignore[attr-defined]
        asked.__annotations__ = {p.name: p.annotation for p in parameters}
        asked.__name__, asked.__doc__ = command.__name__, command.__doc__
        return asked

    return decorated


@contextmanager
def _waiting(what: str) -> Iterator[Callable[[float], None]]:
    """A bar on standard error once the wait exceeds SHOWN_WAIT; yields the function that takes the share done."""
    if not sys.stderr.isatty():
        yield lambda share: None
        return
    bar = Progress(console=Console(stderr=True), transient=True)
    task = bar.add_task(what, total=None)
    timer = threading.Timer(SHOWN_WAIT, bar.start)
    timer.start()
    try:
        yield lambda share: bar.update(task, total=1.0, completed=share)
    finally:
        timer.cancel()
        timer.join()
        if bar.live.is_started:
            bar.stop()


def _print_json(data: bytes) -> None:
    sys.stdout.buffer.write(data + b"\n")
    sys.stdout.buffer.flush()


def _print(*parts: Table | Text | str) -> None:
    console = Console(highlight=False, markup=False, width=None if sys.stdout.isatty() else PIPE_WIDTH)
    for part in parts:
        console.print(part)


def _answer(title: str, answer: answers.Answer, json: bool) -> None:
    """An answer as its JSON, or as two columns: each field by its name on the wire, and its value with its unit."""
    if json:
        _print_json(answer.to_json())
        return
    table = _table(title, "field", "value", header=False)
    for name, value in _flat(answer):
        table.add_row(name, value)
    _print(table)


def _flat(answer: BaseModel, prefix: str = "") -> Iterator[tuple[str, str]]:
    for name, field in type(answer).model_fields.items():
        value = getattr(answer, name)
        label = prefix + name.replace("_", " ")
        if isinstance(value, answers.Feature):
            yield label, ", ".join(f"{word} {_shown(said)}" for word, said in value)
        elif isinstance(value, BaseModel):
            yield from _flat(value, f"{label}: ")
        elif isinstance(value, dict):
            for key, entry in value.items():
                yield f"{prefix}{key}", ", ".join(f"{word} {_shown(said)}" for word, said in entry)
        elif value is not None:
            unit = re.search(r"\[([^\]]+)\]$", field.description or "")
            yield label, f"{_shown(value)} {unit[1] if unit else ''}".rstrip()


def _shown(value: Any, decimals: int = 9) -> str:
    if isinstance(value, (tuple, list)):
        return ", ".join(_shown(entry, 12) for entry in value) or "none"
    if isinstance(value, bool):
        return "yes" if value else "no"
    return f"{value:.{decimals}f}" if isinstance(value, float) else str(value)


def _table(title: str, *columns: str, header: bool = True) -> Table:
    table = Table(title=title, box=box.SIMPLE, show_header=header, title_justify="left", title_style="bold")
    for k, name in enumerate(columns):
        table.add_column(name, justify="right" if k and header else "left", overflow="fold")
    return table


@app.command()
@_asks(TrajectoryOptions)
def trajectory(
    asked: TrajectoryOptions,
    output: Annotated[Path | None, typer.Option(help="Write a .csv, .xlsx, .arrow or .json file.")] = None,
    language: Annotated[tables.Language, typer.Option(help="Names in an xlsx file.")] = tables.Language.ENGLISH,
    json: Json = False,
) -> None:
    """Where every handle is, and how fast."""
    suffix = output.suffix.lower() if output else ".json" if json else ""
    write = _writer(suffix, asked.decimals, language) if suffix else lambda result: b""
    settings = Settings()
    dragon, path = asked.to_dragon(settings.benches_max), asked.to_path()
    times = asked.to_times(dragon.benches + 1, settings.cells_max)
    with _waiting("trajectory"):
        result = core.trajectory(dragon, path, times, head_speed=asked.head_speed)
        data = write(result)
    if output:
        output.write_bytes(data)
        print(f"{output}: {dragon.benches + 1} handles at {times.size} instants", file=sys.stderr)
    elif json:
        _print_json(data)
    else:
        _print(*_trajectory_tables(result))


def _writer(suffix: str, decimals: int | None, language: tables.Language) -> Callable[[Trajectory], bytes]:
    """What turns a trajectory into the bytes of a file with that suffix."""
    match suffix:
        case ".json":
            return lambda result: tables.trajectory_json(result, decimals=decimals)
        case ".csv":
            return lambda result: tables.trajectory_csv(result, decimals=decimals)
        case ".arrow":
            return lambda result: tables.trajectory_arrow(result, decimals=decimals)
        case ".xlsx":
            return lambda result: tables.trajectory_xlsx(result, decimals=decimals, language=language)
    raise InvalidValue("output", f"--output must end in .csv, .xlsx, .arrow or .json, got {suffix or 'no ending'}")


def _trajectory_tables(result: Trajectory) -> list[Table | str]:
    """A few handles at a few instants."""
    instants, handles = result.speed.shape
    rows = sorted({k for k in SHOWN_HANDLES if k < handles} | {handles - 1})
    columns = np.unique(np.linspace(0, instants - 1, SHOWN_INSTANTS).round().astype(int))
    names = tables.handle_names(handles - 1)
    x, y = result.position[..., 0], result.position[..., 1]
    shown: list[Table | str] = []
    for title, values in (("x [m]", x), ("y [m]", y), ("speed [m/s]", result.speed)):
        table = _table(title, "handle", *(f"{result.time[t]:g} s" for t in columns))
        for k in rows:
            table.add_row(f"{k} {names[k]}", *(f"{value:.6f}" for value in values[columns, k].round(6) + 0.0))
        shown.append(table)
    return [*shown, f"{len(rows)} of {handles} handles, {len(columns)} of {instants} instants: --output has all."]


@app.command()
@_asks(schemas.CollisionQuery)
def collision_time(asked: schemas.CollisionQuery, json: Json = False) -> None:
    """When two benches first touch, and how that is known."""
    dragon, path = asked.to_dragon(Settings().benches_max), asked.to_path()
    with _waiting("first contact"):
        found = core.first_contact(dragon, path, head_speed=asked.head_speed, margin=asked.margin)
        answer = answers.CollisionTime.of(found, dragon, path, asked.head_speed, asked.margin)
    _answer("First contact", answer, json)


@app.command()
@_asks(schemas.MinimumPitchQuery)
def minimum_pitch(asked: schemas.MinimumPitchQuery, json: Json = False) -> None:
    """The smallest pitch such that every larger one lets the head reach the turning circle."""
    dragon, radius = asked.to_dragon(Settings().benches_max), asked.turning_diameter / 2
    with _waiting("minimum pitch"):
        found = core.minimum_pitch(dragon, turning_radius=radius, start_turns=asked.start_turns, margin=asked.margin)
        answer = answers.MinimumPitch.of(found, dragon, asked.margin)
    _answer(f"Minimum pitch for a turning circle of {asked.turning_diameter:g} m", answer, json)


@app.command()
@_asks(InstantOptions)
def overlaps(
    asked: InstantOptions,
    file: Annotated[
        Path | None, typer.Argument(help="Benches as for POST /overlaps (- for standard input), not the dance.")
    ] = None,
    json: Json = False,
) -> None:
    """Which benches overlap at one instant, by four engines."""
    settings = Settings()
    if file:
        benches = _checked(schemas.OverlapsRequest, _read_json(file))
        poses, lengths, widths = benches.to_poses(settings.poses_max)
        margin, chained = benches.margin, benches.chained
    else:
        dragon, path = asked.to_dragon(settings.poses_max), asked.to_path()
        handles = core.trajectory(dragon, path, [asked.time], head_speed=asked.head_speed).position[0]
        poses, lengths, widths = core.bench_poses(handles), dragon.lengths, dragon.widths
        margin, chained = asked.margin, True
    with _waiting("overlaps"):
        found = core.overlaps(poses, lengths, widths, margin=margin, chained=chained)
        check = core.cross_check(poses, lengths, widths, margin=margin, chained=chained)
    answer = answers.OverlapsAnswer.of(found, check)
    if json:
        _print_json(answer.to_json())
    else:
        _print(*_overlap_tables(answer))


def _read_json(file: Path) -> object:
    try:
        return orjson.loads(sys.stdin.buffer.read() if str(file) == "-" else file.read_bytes())
    except orjson.JSONDecodeError as error:
        raise InvalidValue("file", f"{file} is not JSON: {error}") from error


def _overlap_tables(answer: answers.OverlapsAnswer) -> list[Table | str]:
    table = _table("Overlapping pairs", "benches", "separation [m]", "witness a [m]", "witness b [m]")
    for one in answer.overlaps:
        table.add_row(*map(_shown, (one.benches, one.separation, one.witness_a, one.witness_b)))
    check = answer.cross_check
    found = ", ".join(f"{engine.value} {len(pairs)}" for engine, pairs in check.engines.items())
    return [table, f"{'All four engines agree' if check.agree else 'THE ENGINES DISAGREE'}; pairs found: {found}"]


@app.command()
@_asks(FigureOptions)
def figures(
    asked: FigureOptions,
    folder: Annotated[Path, typer.Argument(help="Where the files go; made if missing.")] = Path(),
    kind: Annotated[list[Kind] | None, typer.Option(help="Which, once or more; else all three.")] = None,
    format: Annotated[Format, typer.Option(help="File format.")] = Format.PNG,
) -> None:
    """The paper's figures 6, 7 and 8 from live numbers, as files."""
    folder.mkdir(parents=True, exist_ok=True)
    for one in kind or list(Kind):
        with _waiting(f"figure {one.value}") as progress:
            data = _drawn(asked, one, format, progress)
        file = folder / f"{one.value}.{format.value}"
        file.write_bytes(data)
        print(file, file=sys.stderr)


def _drawn(asked: FigureOptions, kind: Kind, format: Format, progress: Callable[[float], None]) -> bytes:
    from app import figures as draw

    dragon, path = asked.to_dragon(Settings().drawn_benches_max), asked.to_path()
    kind_of_file = draw.Format(format)
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

    with _waiting("recomputing the paper"):
        found = reported.comparison()
    if json:
        _print_json(answers.PaperTable.model_validate({"rows": found}).to_json())
        return
    table = _table("The paper beside this program", "quantity", "paper", "here", "difference")
    for one in found:
        name = f"{one.quantity} [{one.unit}], {one.source}"
        table.add_row(name, str(one.paper), _shown(one.ours), f"{one.difference:+.6f}")
    _print(table)
    for one in found:
        facts = [f"  {fact.what}: {_shown(fact.value)} {fact.unit}" for fact in one.evidence]
        _print(Text(one.quantity, style="bold"), one.reason, *facts, "")


@app.command()
def serve(
    host: Annotated[str, typer.Option(help="Address to listen on.")] = "127.0.0.1",
    port: Annotated[int, typer.Option(min=0, max=65535, help="Port to listen on.")] = 8000,
) -> None:
    """The HTTP service."""
    import uvicorn

    try:
        uvicorn.run("app.main:create_app", factory=True, host=host, port=port)
    except SystemExit as stop:  # The port is taken, or the address is not ours; uvicorn has said so.
        raise typer.Exit(2 if stop.code else 0) from stop


proofs = typer.Typer()
proofs.callback(invoke_without_command=True)(prove.prove)
proofs.command()(_asks(prove.CollisionClaim)(prove.collision_time))
proofs.command()(_asks(prove.PitchClaim)(prove.minimum_pitch))
app.add_typer(proofs, name="prove")
