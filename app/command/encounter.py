"""The command encounter: when benches of two dragons first touch, or come within a margin."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from app.command import show
from app.command.options import Json, asks, of_file
from app.command.usage import path_argument
from app.extras import require
from app.files.disk import checked_output
from app.questions import encounter as encounters
from app.questions.collision_time import Contact
from app.questions.encounter import Encounter, EncounterRequest
from app.wire.performances import PerformanceSpan
from app.wire.question import Terms
from app.wire.refusals import refusing
from core import FirstEncounter
from core.errors import format_number


class EncounterOptions(Contact, PerformanceSpan):
    """The fields of POST /encounter that are options."""


@asks(EncounterOptions)
def encounter(
    options: EncounterOptions,
    context: typer.Context,
    file: Annotated[
        Path, path_argument("FILE", "Several dances, as [[dances]] of a .toml file or as dances of a .json file.")
    ],
    figure: Annotated[
        Path | None, typer.Option(help="Draw all dragons at their encounter into a .svg or .png file.")
    ] = None,
    json: Json = False,
) -> None:
    """First time that benches of two dragons touch, or come within a margin."""
    ending = checked_output("figure", figure, (".svg", ".png")) if figure else ""
    if figure:
        require("figures", "figure", "--figure")
    request = of_file(file, EncounterRequest, context)
    with refusing(request), show.waiting("encounter"):
        result = encounters.encounter_of(request, Terms())
        answer = Encounter.of(result, request, Terms())
        drawn = _drawn(result, ending[1:]) if figure else b""
    if figure:
        show.write(figure, drawn)
    near = f"First time that benches of two dragons are within {format_number(request.margin)} m of each other"
    title = near if request.margin else "First encounter"
    if stray := request.to_stray():
        title += f" that may come about with strays up to {format_number(stray)} m"
    show.print_answer(title, answer, json, margin=request.margin, benches=request.benches)


def _drawn(encounter: FirstEncounter, format: str) -> bytes:
    from app.files.performances import encounter_figure  # matplotlib takes a second to import

    return encounter_figure(encounter.performance, encounter, format=format)
