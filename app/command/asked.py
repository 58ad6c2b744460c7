"""The commands that ask a question and print its answer: each follows from the question itself."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

from app.command import show
from app.command.options import Json, asks
from app.wire.labels import fields_of
from app.wire.question import Command, Question, Terms, Wire
from app.wire.refusals import refusing

# Fields of which a request about a dance, or about several, has one.
DANCES = frozenset({"dragon", "dances"})


def command_of(question: Question, command: Command) -> Callable[..., None]:
    """The command that asks a question: a function whose parameters are its options."""

    def ask(request: Any, json: Json = False) -> None:
        title = command.title(request)
        with show.waiting(title) as progress:
            answer = question.answer(request, Terms(progress=progress))
        parts = command.parts(answer) if command.parts else fields_of(title, answer, request)
        show.print_result(answer, json, parts)

    options, body = command.options or question.flat, question.body
    assert options is not None, f"{question.name} has neither a query nor options"
    if body and not DANCES & body.model_fields.keys():  # a FILE holds a dance
        body = None
    ask.__name__, ask.__doc__ = question.name, command.help
    return asks(options, body, command.instead, command.file)(ask)


def write_answer(question: Question, request: Wire, title: str, output: Path, form: str = "") -> bytes:
    """Write the answer as a file, and return it. title: what a progress bar names; form: the default one without"""
    with refusing(request), show.waiting(title) as progress:
        data = question.to_bytes(request, Terms(progress=progress), form or question.forms[0])
    show.write(output, data)
    return data
