"""The command bench-dragon plan: a dance as a PDF to print."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Annotated

import typer

from app.command import show
from app.extras import require
from app.files.disk import checked_output, object_words, read_dance, write_whole
from app.files.tables import Language
from app.questions.plan import PlanRequest
from app.questions.plan import plan as plan_of
from app.wire.messages import checked
from app.wire.question import Terms
from app.wire.refusals import refusing


def plan(
    file: Annotated[Path, typer.Argument(help="Dragon, path, venue and limits as for check: .toml or .json.")],
    output: Annotated[Path, typer.Option(help="Write a .pdf file.")] = Path("plan.pdf"),
    paper: Annotated[str | None, typer.Option(metavar="A4|A3", help="Size of the paper; default: A4.")] = None,
    title: Annotated[str | None, typer.Option(help="Title of the plan")] = None,
    spacing: Annotated[float | None, typer.Option(help="Distance of the chalk marks along the path [m]")] = None,
    clear: Annotated[
        float | None, typer.Option(help="Width of the zone to keep clear [m]; default: the margin, or 0.5 m")
    ] = None,
    language: Annotated[Language | None, typer.Option(help="Language of the words; default: en.")] = None,
) -> None:
    """A PDF to print, true to scale: map, place of each person, points to paint, times (extra figures)."""
    checked_output("output", output, (".pdf",))
    require("figures", "output", "A plan")
    given = {"paper": paper, "title": title, "spacing": spacing, "clear": clear, "language": language}
    told = read_dance(file) | {name: value for name, value in given.items() if value is not None}
    asked = checked(PlanRequest, told, object_words(file))
    with refusing(asked), show.waiting("plan") as progress:
        data = plan_of(asked, Terms(progress=progress))
    write_whole(output, data)
    print(output, file=sys.stderr)
