"""The command bench-dragon trajectory: tables on a terminal, and files."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Annotated

import typer
from pydantic import Field

import core
from app.command import show
from app.command.options import Json, checked, given, numbers, unused
from app.files import tables
from app.files.disk import TABLE_ENDINGS, checked_output, trajectory_writer, write_whole
from app.questions.trajectory import TrajectoryRequest
from app.settings import Settings
from app.wire.dances import DanceQuery, TimeRange
from app.wire.models import measure
from core import Dragon, InvalidValue


class TrajectoryOptions(TimeRange, DanceQuery):
    """POST /trajectory, flat."""

    decimals: int | None = Field(
        None, ge=0, le=15, description="Decimals of x, y and speed; else all (xlsx and the table on a terminal: 6)"
    )
    times: str | None = measure("s", "Instants such as 0,60,120, in place of --start, --stop and --step", None)
    handles: str | None = Field(
        None, description="Handles in the table, such as 0,1,51, in place of those that the contest asks for"
    )


def trajectory(
    asked: TrajectoryOptions | TrajectoryRequest,
    context: typer.Context,
    output: Annotated[Path | None, typer.Option(help="Write a .csv, .xlsx, .arrow or .json file.")] = None,
    language: Annotated[tables.Language, typer.Option(help="Names in an xlsx file.")] = tables.Language.ENGLISH,
    json: Json = False,
) -> None:
    """Where every handle is, and how fast."""
    ending = checked_output("output", output, TABLE_ENDINGS) if output else ".json" if json else None
    if ending and given(context, "handles"):
        raise InvalidValue("handles", "--handles chooses rows of the table: leave it out with --output or --json")
    if output and json:
        raise InvalidValue("json", "--json prints the answer and --output writes it to a file: give one of the two")
    if ending != ".xlsx":
        unused(context, ["language"], "is for the names in an xlsx file: give --output with .xlsx, or leave it out")
    write = trajectory_writer(ending, asked.decimals, language) if ending else None
    settings = Settings()
    dance = asked.to_dance(settings.benches_max)
    handles, times = _handles(context.params["handles"], dance.dragon), asked.times
    if given(context, "times") and (ranged := given(context, "start", "stop", "step")):
        raise InvalidValue("times", f"--times takes the place of --{ranged[0]}: give one of the two")
    if isinstance(times, str):
        asked = checked(TrajectoryRequest, {"times": numbers("times", times, float)})
    instants = asked.times_of(dance, settings.cells_max)
    with show.waiting("trajectory"):
        result = core.trajectory(dance, instants)
        data = write(result) if write else b""
    if output:
        write_whole(output, data)
        print(f"{output}: {dance.dragon.benches + 1} handles at {instants.size} instants", file=sys.stderr)
    elif json:
        show.print_json(data)
    else:
        fold, all_instants = dance.end if dance.end.bench is not None else None, isinstance(times, (str, list))
        shown = show.trajectory_tables(result, handles, all_instants=all_instants, decimals=asked.decimals, fold=fold)
        show.print_parts(*shown)


def _handles(text: str | None, dragon: Dragon) -> list[int] | None:
    """The handles asked for; None: nobody says. raises: InvalidValue"""
    if text is None:
        return None
    found = numbers("handles", text, int)
    for k, handle in enumerate(found):
        if not 0 <= handle <= dragon.benches:
            rule = f"handles[{k}] must be from 0 to {dragon.benches} for this dragon, got {handle}"
            raise InvalidValue(f"handles.{k}", rule)
    return found
