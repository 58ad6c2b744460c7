"""The command bench-dragon cues: what the carriers of each bench have to know."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from app.command import show
from app.command.usage import path_argument
from app.extras import require
from app.files.disk import checked_output, object_words
from app.files.tables import CSV_TYPE, Language
from app.maps.dances import read_dance
from app.questions.cues import QUESTION as CUES
from app.questions.cues import CuesRequest
from app.questions.plan import PDF_TYPE
from app.wire.messages import checked
from app.wire.question import JSON, Terms
from app.wire.refusals import refusing

# Form of a file by its ending.
FORMS = {".pdf": PDF_TYPE, ".csv": CSV_TYPE, ".json": JSON}


def cues(
    file: Annotated[
        Path,
        path_argument("FILE", "Dragon, path, venue and limits as for check: .toml or .json."),
    ],
    output: Annotated[Path, typer.Option(help="Write a .pdf (extra figures), .csv or .json file.")] = Path("cues.pdf"),
    first_bench: Annotated[int | None, typer.Option(help="First bench with a card; default: 0, the head.")] = None,
    last_bench: Annotated[int | None, typer.Option(help="Last bench with a card; default: the tail.")] = None,
    reach: Annotated[float | None, typer.Option(help="Largest gap of a meeting [m]; default: 8")] = None,
    step_length: Annotated[float | None, typer.Option(help="Length of a step [m]; default: 0.75")] = None,
    spacing: Annotated[float | None, typer.Option(help="Distance of the chalk marks along the path [m]")] = None,
    title: Annotated[str | None, typer.Option(help="Title of the dance on every card")] = None,
    language: Annotated[Language | None, typer.Option(help="Language of the words; default: en.")] = None,
) -> None:
    """A card for each bench: where to stand, when to walk, whom it meets and how near, where it is fastest."""
    ending = checked_output("output", output, tuple(FORMS))
    if ending == ".pdf":
        require("figures", "output", "A card on paper")
    changes = {
        "first_bench": first_bench, "last_bench": last_bench, "reach": reach, "step_length": step_length,
        "spacing": spacing, "title": title, "language": language,
    }  # fmt: skip
    values = read_dance(file) | {name: value for name, value in changes.items() if value is not None}
    request = checked(CuesRequest, values, object_words(file))
    with refusing(request), show.waiting("cues") as progress:
        data = CUES.to_bytes(request, Terms(progress=progress), FORMS[ending])
    show.write(output, data)
