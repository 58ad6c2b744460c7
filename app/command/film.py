"""The command bench-dragon film: the dance as a film."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Annotated

import typer

from app.command import show
from app.command.options import asks
from app.command.paths import PathOptions, dance_of
from app.extras import require
from app.files.disk import checked_output, write_whole
from app.files.film_spec import ENDINGS, GIF_TYPE
from app.questions import films
from app.questions.films import FilmFields, FilmRequest
from app.wire.question import Terms


class FilmOptions(FilmFields, PathOptions):
    """The fields of POST /films as options."""


@asks(FilmOptions, FilmRequest)
def film(
    asked: FilmOptions | FilmRequest,
    context: typer.Context,
    output: Annotated[Path, typer.Option(help="Write a .mp4 file (extra film), or a .gif.")] = Path("dance.mp4"),
) -> None:
    """A film of the dance; with a FILE, of any dragon on any path and in any venue."""
    gif = checked_output("output", output, (".mp4", ".gif")) == ENDINGS[GIF_TYPE]
    require("figures" if gif else "film", "output", "A .gif" if gif else "A .mp4 (a .gif does not need it)")
    form = GIF_TYPE if gif else films.FORM
    with show.waiting(f"film {output}") as progress:
        terms = Terms(progress=progress)
        data = films.filmed(asked, dance_of(asked, context, terms.settings.drawn_benches_max), terms, form)
    write_whole(output, data)
    print(output, file=sys.stderr)
