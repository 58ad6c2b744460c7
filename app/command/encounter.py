"""The commands on several dragons: when two of them first meet, and at which delays none do."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Annotated

import typer
from pydantic import Field

from app.command import show
from app.command.options import Json, asks, of_file
from app.command.usage import path_argument
from app.extras import require
from app.files.disk import checked_output
from app.questions import encounter as encounters
from app.questions import safe_delay as delays
from app.questions.collision_time import Contact
from app.questions.encounter import Encounter, EncounterRequest
from app.questions.safe_delay import DelayFields, SafeDelayRequest, SafeDelays
from app.wire.performances import PerformanceSpan
from app.wire.question import Terms
from app.wire.refusals import refusing
from core import FirstEncounter
from core.errors import format_bound, format_number
from core.language import say


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
    with refusing(request), show.waiting(say("encounter")):
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


class DelayOptions(DelayFields):
    """The fields of POST /safe-delay that are options."""

    part: str = Field(
        "1", description="The dragon that waits: its number in the order of the dances, from 0, or its name."
    )  # fmt: skip


@asks(DelayOptions)
def safe_delay(
    options: DelayOptions,
    context: typer.Context,
    file: Annotated[
        Path, path_argument("FILE", "Several dances, as [[dances]] of a .toml file or as dances of a .json file.")
    ],
    json: Json = False,
) -> None:
    """The delays of one dragon at which no benches of two dragons touch, or come within a margin."""
    request = of_file(file, SafeDelayRequest, context)
    with refusing(request), show.waiting(say("safe delays")):
        answer = delays.safe_delay(request, Terms())
    show.print_result(answer, json, _delay_parts(answer))


def _delay_parts(answer: SafeDelays) -> Iterator[show.Part]:
    """The intervals of delays, the safe ones and the undecided ones."""
    name = answer.name or f"dragon {answer.part}"
    span = f"from {format_number(answer.least)} to {format_number(answer.most)} s"
    for title, intervals in (("Safe", answer.safe), ("Undecided", answer.undecided)):
        if intervals:
            yield f"{title} delays of {name} {span}:"
            table = show.new_table("", "from [s]", "to [s]")
            for low, high in intervals:  # rounded inwards, so that they stay proven
                table.add_row(*(format_bound(low, 6, up=True), format_bound(high, 6)))
            yield table
        elif title == "Safe":
            yield f"No delay of {name} {span} is known to be safe."
