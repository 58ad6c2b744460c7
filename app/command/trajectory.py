"""The command bench-dragon trajectory: tables on a terminal, and files."""

from __future__ import annotations

import sys
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Annotated

import numpy as np
import typer
from pydantic import Field
from rich.cells import cell_len

import core
from app.command import show
from app.command.options import Json, asks, numbers, typed_options
from app.command.paths import PathOptions, dance_of
from app.files import tables
from app.files.disk import checked_output, write_whole
from app.files.performance_tables import PerformanceTable, performance_file
from app.files.tables import PAPER_HANDLES, TABLE_ENDINGS, trajectory_writer
from app.questions.trajectory import TrajectoryRequest
from app.settings import Settings
from app.wire.dances import TimeRange, clock_of, handles_of
from app.wire.labels import Part, Table
from app.wire.messages import checked
from app.wire.question import measure
from core import Dragon, InvalidValue, RunEnd, Trajectory
from core.errors import Parameter
from core.language import counted, say

# Largest number of instants that a terminal shows, if that many fit.
PRINTED_INSTANTS = 7
# In a run that ends in a fold: a handle this many times faster than the head shows that the fold is near [1]; and the
# mark of such an instant.
FAST = 2.0
NEAR_FOLD = " *"
# With at least this many instants, even spacing is preferred to one or two instants more.
EVEN_INSTANTS = 5


class TrajectoryOptions(TimeRange, PathOptions):
    """The fields of POST /trajectory as options."""

    decimals: int | None = Field(
        None,
        ge=0,
        le=15,
        description="Decimals of x, y and speed; default: all (6 for xlsx and for the table on a terminal)",
    )
    times: str | None = measure("s", "Instants such as 0,60,120, instead of --start, --stop and --step", None)
    handles: str | None = Field(
        None, description="Handles in the table, such as 0,1,51; default: those that the contest asks for"
    )


@asks(TrajectoryOptions, TrajectoryRequest)
def trajectory(
    request: TrajectoryOptions | TrajectoryRequest,
    context: typer.Context,
    output: Annotated[Path | None, typer.Option(help="Write a .csv, .xlsx, .arrow or .json file.")] = None,
    json: Json = False,
) -> None:
    """Position and speed of every handle; of a FILE of several dragons, of each."""
    ending = checked_output("output", output, TABLE_ENDINGS) if output else ".json" if json else None
    if ending and typed_options(context, "handles"):
        words = "--handles chooses rows of the table: leave it out with --output or --json"
        raise InvalidValue.in_words("handles", words)
    if output and json:
        words = "--json prints the answer and --output writes it to a file: give one of the two"
        raise InvalidValue.in_words("json", words)
    settings = Settings()
    if isinstance(request, TrajectoryRequest) and request.dances is not None:
        _of_several(request, context, output, ending)
        return
    dance = dance_of(request, context, settings.benches_max)
    clock = clock_of(request, dance) if isinstance(request, TrajectoryRequest) else None
    write = trajectory_writer(ending, request.decimals, clock) if ending else None
    handles, times = _handles(context.params["handles"], dance.dragon), request.times
    if typed_options(context, "times") and (ranged := typed_options(context, "start", "stop", "step")):
        raise InvalidValue.in_words(
            "times", "--times replaces --{option}: give one of the two", option=Parameter(ranged[0])
        )
    if isinstance(times, str):
        request = checked(TrajectoryRequest, {"times": numbers("times", times, float), "decimals": request.decimals})
    instants = request.times_of(dance, settings.cells_max)
    if dance.path.spiral is not None and instants.size and instants.min() < 0.0:
        warning = say(
            "Warning: the dance begins at 0 s, and before it the head is on the outward extension of the same spiral; "
            "for the contest's turn give --path turn"
        )
        print(warning, file=sys.stderr)
    with show.waiting(say("trajectory")):
        result = core.trajectory(dance, instants)
        data = write(result) if write else b""
    if ending:
        _write(data, output, handles_of(dance), instants.size)
    else:
        fold, all_instants = dance.end if dance.end.bench is not None else None, isinstance(times, (str, list))
        look = _Look("", all_instants, request.decimals, fold)
        show.print_parts(*_parts(result, handles, tables.own_names(result), look))


def _of_several(
    request: TrajectoryRequest,
    context: typer.Context,
    output: Path | None,
    ending: str | None,
) -> None:
    """Print or write where the handles of several dragons are."""
    settings = Settings()
    performance = request.to_performance(settings)
    instants = request.times_of(performance, settings.cells_max)
    dragons = [part.dance.dragon for part in performance.parts]
    handles = _handles(context.params["handles"], min(dragons, key=lambda dragon: dragon.benches))
    with show.waiting(say("trajectory")):
        results = core.trajectory(performance, instants)
        clock = clock_of(request, performance)
        table = PerformanceTable(performance, results, request.decimals, clock)
        data = performance_file(ending, table) if ending else b""
    if ending:
        _write(data, output, handles_of(performance), instants.size)
        return
    all_instants = isinstance(request.times, list)
    for k, (part, result) in enumerate(zip(performance.parts, results, strict=True)):
        end = part.dance.end
        fold = replace(end, time=part.end) if part.folds else None
        names = tables.own_names(result, own=part.dance.dragon.names)
        look = _Look(f"{performance.name_of(k)}: ", all_instants, request.decimals, fold)
        show.print_parts(*_parts(result, handles, names, look))


def _write(data: bytes, output: Path | None, handles: int, instants: int) -> None:
    """Write a file, or print it."""
    if output is None:
        show.print_json(data)
        return
    write_whole(output, data)
    words = say("{file}: {handles} handles at {instants} instants", file=output, handles=handles, instants=instants)
    print(words, file=sys.stderr)


def _handles(text: str | None, dragon: Dragon) -> list[int] | None:
    """The handles in an option; None without the option. raises: InvalidValue"""
    if text is None:
        return None
    handles = numbers("handles", text, int)
    for k, handle in enumerate(handles):
        if not 0 <= handle <= dragon.benches:
            rule = "must be from 0 to {last} for this dragon"
            raise InvalidValue(f"handles.{k}", rule, got=handle, last=dragon.benches)
    return handles


@dataclass(frozen=True, slots=True)
class _Look:
    """The look of tables.

    title: what stands before the titles; decimals: of every number; None: show.DISPLAY_DECIMALS
    all_instants: all instants, in as many tables as needed; else up to PRINTED_INSTANTS, evenly spaced, in one table
    fold: end of the run, if it is a fold; instants just before it are marked, as speeds grow without bound there
    """

    title: str
    all_instants: bool
    decimals: int | None
    fold: RunEnd | None


def _parts(result: Trajectory, handles: Sequence[int] | None, names: Sequence[str], look: _Look) -> Iterator[Part]:
    """Tables of some handles at some instants.

    handles: those to show; None: those of the contest and the last; names: of all handles
    """
    fold, all_instants = look.fold, look.all_instants
    instants, number = result.speed.shape
    rows = list(handles) if handles else sorted({k for k in PAPER_HANDLES if k < number} | {number - 1})
    labels = [f"{k} {names[k]}" for k in rows]
    x, y = result.position[..., 0], result.position[..., 1]
    places = show.DISPLAY_DECIMALS if look.decimals is None else look.decimals
    instant_names = [_instant(result, t, fold) for t in range(instants)]
    widest = max(map(cell_len, [*labels, say("handle")]))
    room = show.new_console().width - show.TABLE_SPACE - show.COLUMN_SPACE - widest
    blocks = _blocks(result, rows, instant_names, room, all_instants, places)
    for what, values in (("x [m]", x), ("y [m]", y), (say("speed [m/s]"), result.speed)):
        for block in blocks:
            table = Table(f"{look.title}{what}", say("handle"), *(instant_names[t] for t in block))
            for k, label in zip(rows, labels, strict=True):
                table.add(label, *(_entry(value, places) for value in values[block, k]))
            yield table
    count = sum(map(len, blocks))
    of_handles = counted(number, "{rows} of {count} handle", "{rows} of {count} handles", rows=len(rows))
    of_instants = counted(instants, "{shown} of {count} instant", "{shown} of {count} instants", shown=count)
    texts = {"handles": of_handles, "instants": of_instants}
    if handles is None and not all_instants:
        yield say("{handles}, {instants}: --output has all, --handles and --times choose.", **texts)
    elif handles is None:
        yield say("{handles}, {instants}: --output has all, --handles chooses.", **texts)
    elif not all_instants:
        yield say("{handles}, {instants}: --output has all, --times chooses.", **texts)
    else:
        yield say("{handles}, {instants}: --output has all.", **texts)
    if fold and any(instant_names[t].endswith(NEAR_FOLD) for block in blocks for t in block):
        yield say(
            "{mark} Just before bench {bench} folds, at {time:.9f} s: towards that instant the speeds of handles "
            "behind it grow without bound.",
            mark=NEAR_FOLD.strip(), bench=fold.bench, time=fold.time,
        )  # fmt: skip


def _blocks(
    result: Trajectory, rows: Sequence[int], names: Sequence[str], room: int, all_instants: bool, decimals: int
) -> list[list[int]]:
    """The instants of each table, as many as fit into the room [characters]. names: of the instants"""
    instants = len(result.time)
    values = np.concatenate([result.position[:, rows].reshape(instants, -1), result.speed[:, rows]], axis=1)

    def width(t: int) -> int:
        return show.COLUMN_SPACE + max(map(len, [names[t], *(_entry(value, decimals) for value in values[t])]))

    if not all_instants:
        counts = range(min(PRINTED_INSTANTS, instants), 1, -1)
        even = [count for count in counts if count >= EVEN_INSTANTS and (instants - 1) % (count - 1) == 0]
        for count in (*even, *counts):
            spaced = np.linspace(0, instants - 1, count).round().astype(int).tolist()
            if sum(map(width, spaced)) <= room:
                return [spaced]
        return [[0]] if instants else []
    blocks: list[list[int]] = []
    left = 0
    for t in range(instants):
        taken = width(t)
        if not blocks or taken > left:
            blocks.append([])
            left = room
        blocks[-1].append(t)
        left -= taken
    return blocks


def _instant(result: Trajectory, t: int, fold: RunEnd | None) -> str:
    near = fold is not None and result.speed[t].max() > FAST * result.speed[t, 0]
    return f"{result.time[t]:.12g} s{NEAR_FOLD if near else ''}"


def _entry(value: float, decimals: int) -> str:
    return f"{round(value, decimals) + 0.0:.{decimals}f}"
