"""The command bench-dragon figures: pictures of a dance as files."""

from __future__ import annotations

import sys
from enum import StrEnum
from pathlib import Path
from typing import Annotated

import typer

from app.command import show
from app.command.options import asks, of_file, unused
from app.command.usage import path_argument
from app.extras import require
from app.files.disk import checked_output, ending_of
from app.maps.dances import DANCE_ENDINGS
from app.questions import figures as drawn
from app.questions.figures import Format
from app.questions.pitch_scan import ScanFields
from app.wire.question import Terms
from app.wire.refusals import refusing
from core import InvalidValue
from core.language import say
from core.quantities import Given


class FigureOptions(drawn.InstantQuery, ScanFields, drawn.WithLanguage):
    """The fields of all three GET /figures requests."""


class FigureKind(StrEnum):
    """The figures, by their names in the service."""

    TRAJECTORY = "trajectory"
    CONTACT = "contact"
    PITCH_SCAN = "pitch-scan"


FIGURES = {
    FigureKind.TRAJECTORY: drawn.TRAJECTORY,
    FigureKind.CONTACT: drawn.CONTACT,
    FigureKind.PITCH_SCAN: drawn.PITCH_SCAN,
}


def _is_dance(place: Path) -> bool:
    """True if the path names the file of a dance rather than a folder."""
    return not place.is_dir() and (place.exists() or ending_of(place) in DANCE_ENDINGS or str(place) == "-")


@asks(FigureOptions)
def figures(
    options: FigureOptions,
    context: typer.Context,
    file: Annotated[
        Path | None,
        path_argument("FILE", "Dance as a .toml or .json file, as for check: any dragon, path and venue."),
    ] = None,
    folder: Annotated[
        Path | None,
        path_argument(
            "FOLDER",
            "Folder for the files; created if missing. It may stand alone, or before FILE. Default: this folder.",
        ),
    ] = None,
    kind: Annotated[
        list[FigureKind] | None,
        typer.Option(help="Figure to draw; may be repeated. Default: all three, for a FILE the first two."),
    ] = None,
    format: Annotated[Format, typer.Option(help="File format.")] = Format.PNG,
) -> None:
    """The paper's figures 6, 7 and 8 from live numbers, as files."""
    require("figures", "format", "A figure")
    if file and not _is_dance(file):
        file, folder = folder, file
    folder = folder or Path()
    if folder.is_file():
        raise InvalidValue.in_words("folder", "FOLDER must be a folder, got the file {file}", file=str(folder))
    kinds = kind or list(FigureKind)[: 2 if file else None]
    used = {name for one in kinds for name in (FIGURES[one].flat or FigureOptions).model_fields}
    why = "does not apply to the figure {kinds}: leave it out, or draw another --kind too"
    unused(context, FigureOptions.model_fields.keys() - used, why, kinds=Given(kinds, say(" or ").join(kinds)))
    requests = {one: of_file(file, FIGURES[one].body or FigureOptions, context) if file else options for one in kinds}
    files = {one: folder / f"{one.value}.{format.value}" for one in kinds}
    for picture in files.values() if folder.exists() else ():
        checked_output("format", picture)
    drawings = {}
    for one, request in requests.items():
        with refusing(request), show.waiting(say("figure {name}", name=one.value)) as progress:
            drawings[one] = FIGURES[one].to_bytes(request, Terms(progress=progress), format.media_type)
    folder.mkdir(parents=True, exist_ok=True)
    for one, data in drawings.items():
        show.write(files[one], data)
    if file and not kind:
        name = FigureKind.PITCH_SCAN.value
        left_out = say(
            "{name} is left out: it is about all pitches, not about one path: --kind {name} draws it for the dragon of "
            "the FILE.",
            name=name,
        )
        print(left_out, file=sys.stderr)
