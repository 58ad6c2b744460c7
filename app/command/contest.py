"""The command bench-dragon contest: prints every answer, and writes every file that a student hands in."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Annotated

import typer

from app.command import show
from app.command.options import asks
from app.command.usage import path_argument
from app.contest.films import Wanted
from app.contest.kit import write_kit
from app.contest.report import answer_table
from app.contest.solved import ContestRequest
from app.extras import require
from core import InvalidValue
from core.language import Language, say, speaking


@asks(ContestRequest)
def contest(
    request: ContestRequest,
    folder: Annotated[Path, path_argument("FOLDER", "Folder for the files; created if missing.")],
    language: Annotated[Language, typer.Option(help="Language of names, captions and the report.")] = Language.CHINESE,
    films: Annotated[bool, typer.Option(help="Write dance.mp4 and turn.mp4 (without the extra film: .gif).")] = True,
    gif: Annotated[bool, typer.Option(help="Write the films as .gif too.")] = False,
) -> None:
    """The contest kit (CUMCM 2024 A) in a folder: workbooks, answers, tables, figures, films and a report."""
    require("xlsx", "folder", "contest")
    if folder.exists() and not folder.is_dir():
        raise InvalidValue.in_words("folder", "FOLDER must be a folder, got the file {file}", file=str(folder))
    folder.mkdir(parents=True, exist_ok=True)
    with speaking(language):
        with show.steps() as progress:
            kit = write_kit(folder, request, Wanted(films, gif), progress)
        print(answer_table(kit.results), end="")
        for name in kit.files:
            print(folder / name, file=sys.stderr)
        if kit.no_turn:
            no_answer = say(
                "Error: questions 4 and 5 have no answer: {kit.no_turn}; change --turning-diameter, "
                "--turn-pitch or --ratio",
                kit=kit,
            )
            print(no_answer, file=sys.stderr)
        if kit.missing:
            print(say("Error: figures and films were not written: {why}", why=kit.missing.message), file=sys.stderr)
        if kit.no_turn or kit.missing:
            raise typer.Exit(1)
