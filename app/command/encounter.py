"""The command encounter: when two of several dragons first meet."""

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
from app.wire.labels import fields_of, with_strays
from app.wire.performances import FILE_OF_DANCES, PerformanceSpan
from app.wire.question import Terms
from app.wire.refusals import refusing
from core import FirstEncounter
from core.errors import format_number
from core.language import say


class EncounterOptions(Contact, PerformanceSpan):
    """The fields of POST /encounter that are options."""


@asks(EncounterOptions)
def encounter(
    options: EncounterOptions,
    context: typer.Context,
    file: Annotated[Path, path_argument("FILE", FILE_OF_DANCES)],
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
    with refusing(request), show.waiting(say("encounter")):
        result = encounters.encounter_of(request, Terms())
        answer = Encounter.of(result, request, Terms())
        drawn = _drawn(result, ending[1:]) if figure else b""
    if figure:
        show.write(figure, drawn)
    title = say("First encounter")
    if request.margin:
        near = format_number(request.margin)
        title = say("First time that benches of two dragons are within {margin} m of each other", margin=near)
    title = with_strays(title, request.to_stray())
    show.print_result(answer, json, fields_of(title, answer, request))


def _drawn(encounter: FirstEncounter, format: str) -> bytes:
    from app.files.performances import encounter_figure  # matplotlib takes a second to import

    return encounter_figure(encounter.performance, encounter, format=format)
