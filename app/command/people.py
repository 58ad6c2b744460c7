"""The commands on people: what the carriers of each bench have to know, and who carries when."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Literal

import typer

from app.cards.crew import lack_words
from app.command import show
from app.command.asked import write_answer
from app.command.options import Json, asks, changed, numbers, of_file
from app.command.usage import path_argument
from app.extras import require
from app.files.disk import checked_output
from app.files.tables import CSV_TYPE
from app.questions.crew import QUESTION as CREW
from app.questions.crew import Crew, CrewFields, CrewRequest, PointBody, Roll
from app.questions.cues import QUESTION as CUES
from app.questions.cues import CuesRequest
from app.questions.plan import PDF_TYPE
from app.wire.labels import Table
from app.wire.messages import checked
from app.wire.question import JSON, Terms
from app.wire.refusals import refusing
from core import InvalidValue
from core.errors import Given
from core.language import Listed, say

FILE_HELP = "Dragon, path, venue and limits as for check: .toml or .json."
# Form of a file by its ending.
FORMS = {".pdf": PDF_TYPE, ".csv": CSV_TYPE, ".json": JSON}


def cues(
    context: typer.Context,
    file: Annotated[
        Path,
        path_argument("FILE", FILE_HELP),
    ],
    output: Annotated[Path, typer.Option(help="Write a .pdf (extra paper), .csv or .json file.")] = Path("cues.pdf"),
    first_bench: Annotated[int | None, typer.Option(help="First bench with a card; default: 0, the head.")] = None,
    last_bench: Annotated[int | None, typer.Option(help="Last bench with a card; default: the tail.")] = None,
    bench: Annotated[
        list[str] | None, typer.Option(help="Name or number of a bench with a card; may be given several times.")
    ] = None,
    reach: Annotated[float | None, typer.Option(help="Largest gap of a meeting [m]; default: 8")] = None,
    part: Annotated[
        str | None, typer.Option(help="Of several dragons, the one whose benches get cards: its name or its number.")
    ] = None,
    step_length: Annotated[float | None, typer.Option(help="Length of a step [m]; default: 0.75")] = None,
    spacing: Annotated[float | None, typer.Option(help="Distance of the chalk marks along the path [m]")] = None,
    title: Annotated[str | None, typer.Option(help="Title of the dance on every card")] = None,
    map_up: Annotated[
        Literal["north", "way"] | None, typer.Option(help="What is up on the pictures: north, or the way of the bench.")
    ] = None,
    address: Annotated[
        str | None, typer.Option(help="Address of the page with this dance, for a code on each card.")
    ] = None,
    labels: Annotated[
        bool | None, typer.Option("--labels", help="Labels to cut with the code of each bench, in place of cards.")
    ] = None,
) -> None:
    """A card for each bench: where to stand, when to walk, whom it meets and how near, where it is fastest."""
    ending = checked_output("output", output, tuple(FORMS))
    if ending == ".pdf":
        require("paper", "output", "A card on paper")
    request = changed(
        file, CuesRequest, context, part=part, first_bench=first_bench, last_bench=last_bench, cards=bench or None,
        reach=reach, step_length=step_length, spacing=spacing, title=title, map_up=map_up, address=address,
        labels=labels,
    )  # fmt: skip
    write_answer(CUES, request, say("cues"), output, FORMS[ending])


@asks(CrewFields)
def crew(
    options: CrewFields,
    context: typer.Context,
    file: Annotated[Path, path_argument("FILE", FILE_HELP)],
    point: Annotated[
        list[str] | None, typer.Option(help="A place X,Y [m] at which people change; may be given several times.")
    ] = None,
    output: Annotated[Path | None, typer.Option(help="Write a .pdf (extra paper), .csv or .json file.")] = None,
    json: Json = False,
) -> None:
    """Who carries which bench when: shifts, spare carriers, minutes and metres of each, and who is where at a time."""
    ending = checked_output("output", output, tuple(FORMS)) if output else ""
    if ending == ".pdf":
        require("paper", "output", "A timeline")
    request = of_file(file, CrewRequest, context)
    if point:
        request = request.model_copy(update={"points": [_point(text) for text in point]})
    with refusing(request), show.waiting(say("crew")) as progress:
        terms = Terms(progress=progress)
        data = CREW.to_bytes(request, terms, FORMS[ending] if output else JSON)
    if output:
        show.write(output, data)
    elif json:
        show.print_json(data)
    else:
        _print_crew(Crew.model_validate_json(data))


def _point(text: str) -> PointBody:
    """A point of an option. raises: InvalidValue"""
    entries = numbers("point", text, float)
    if len(entries) != 2:
        raise InvalidValue.in_words("point", "--point must be X,Y [m]", got=Given(text))
    return checked(PointBody, dict(zip("xy", entries, strict=True)))


def _print_crew(answer: Crew) -> None:
    title = say(
        "{answer.people} people, {answer.spares} of them spares; {answer.changes} changes",
        answer=answer,
    )
    heads = say("person"), say("benches"), say("time [s]"), say("way [m]")
    table = Table(title, *heads, say("longest [s]"))
    for one in answer.carriers:
        benches = str(Listed(dict.fromkeys(spell.bench for spell in one.spells))) or say("none")
        table.add(one.label, benches, *(f"{value:.1f}" for value in (one.time, one.way, one.longest)))
    words = lack_words(answer.enough, len(answer.unrelieved))
    # Before the table, which may have hundreds of rows.
    few = [say("{words}.", words=say("; ").join(words).capitalize())] if answer.spares < answer.enough else []
    show.print_parts(*few, table, *([_roll_table(answer.at)] if answer.at else []))


def _roll_table(roll: Roll) -> Table:
    time = roll.clock or f"{roll.time:g} s"
    heads = say("bench"), say("people"), "x [m]", "y [m]", say("mark [m]")
    table = Table(say("Who is where at {time}", time=time), *heads)
    for one in roll.benches:
        name = f"{one.bench} {one.name}".rstrip()
        table.add(name, " ".join(one.people), f"{one.x:.2f}", f"{one.y:.2f}", f"{one.mark:g}")
    if roll.resting:
        table.add(say("rest"), " ".join(roll.resting), "", "", "")
    return table
