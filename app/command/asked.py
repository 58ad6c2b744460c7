"""The commands that ask a question and print its answer or write it: each follows from the question itself."""

from __future__ import annotations

import inspect
import sys
from collections.abc import Callable, Iterable, Iterator, Mapping
from pathlib import Path
from typing import Annotated, Any, NamedTuple

import typer

from app.command import show
from app.command.options import (
    CONTEXT,
    Json,
    field_options,
    file_argument,
    in_options,
    of_file,
    of_json,
    of_options,
    own_fields,
    typed_options,
    unused,
    with_options,
)
from app.extras import require
from app.files.disk import checked_output
from app.settings import Settings
from app.wire.fields import Wire
from app.wire.labels import Part, fields_of
from app.wire.question import JSON, Command, Question, Terms, language_for
from app.wire.refusals import refusing
from core import InvalidValue
from core.language import speaking
from core.quantities import Parameter
from core.values import Progress

# Fields of which a request about a dance, or about several, has one.
DANCES = frozenset({"dragon", "dances"})


class Target(NamedTuple):
    """A file to write: its name, its form, and the further options about it."""

    file: Path
    form: str
    options: Mapping[str, Any]


def command_of(
    question: Question, rows: type[Wire] = Wire, printed: Callable[..., Iterable[Part]] | None = None
) -> Callable[..., None]:
    """The command that asks a question: a function whose parameters are its options.

    rows: options about what is printed
    printed: function of a request, the terms and these options that gives what is printed; None: the answer
    """
    command, body = question.command, question.body
    assert command is not None, question.name
    options = command.options or question.flat
    if question.flat and body and not DANCES & body.model_fields.keys():  # nothing that a file would describe
        body = None
    fields = options.model_fields if options else own_fields(body) if body else {}
    of_dance = body is not None and not DANCES.isdisjoint(body.model_fields)

    def run(context: typer.Context, file: Path | None = None, json: bool = False, **values: Any) -> None:
        targets = dict(_targets(command, context, values, json))
        if targets or json:
            why = "is about the printed table: leave it out with --output or --json"
            unused(context, rows.model_fields, why)
        with in_options(context):
            request: Any
            if file and body:
                request = of_file(file, body, context, command) if of_dance else of_json(file, body, fields, context)
            else:
                assert options is not None  # A FILE is missing only where options stand in its place.
                request = of_options(options, question, context)
            with refusing(request):
                if warning := command.warning(request):
                    print(warning, file=sys.stderr)
                if printed and not targets and not json:
                    chosen = {name: values[name] for name in rows.model_fields}
                    with show.waiting(command.title(request)) as progress:
                        parts = list(printed(request, _terms(progress), **chosen))
                    show.print_parts(*parts)
                else:
                    _answer(question, request, targets, json)

    parameters = [CONTEXT, *([file_argument(body, command.file, options or Wire)] if body else [])]
    for name, output in command.outputs.items():
        parameters.append(_option(name, Path | None, output.help, Path(output.default) if output.default else None))
        parameters += field_options(output.options.model_fields)
    parameters += [_option(name, list[str] | None, one.help) for name, one in command.lists.items()]
    if question.model:
        parameters.append(inspect.Parameter("json", inspect.Parameter.KEYWORD_ONLY, default=False, annotation=Json))
    return with_options(run, [*parameters, *field_options(fields | rows.model_fields)], question.name, command.help)


def _option(name: str, kind: Any, words: str, default: Any = None) -> inspect.Parameter:
    annotation = Annotated[kind, typer.Option(help=words)]
    return inspect.Parameter(name, inspect.Parameter.KEYWORD_ONLY, default=default, annotation=annotation)


def _targets(
    command: Command, context: typer.Context, values: Mapping[str, Any], json: bool
) -> Iterator[tuple[str, Target]]:
    """The files to write, by the names of their options. raises: InvalidValue, OSError, MissingPackage"""
    for name, output in command.outputs.items():
        file, is_typed = values[name], bool(typed_options(context, name))
        further = output.options.model_fields
        if json and is_typed and not command.solve:
            words = "--json prints the answer and --{option} writes it to a file: give one of the two"
            raise InvalidValue.in_words("json", words, option=Parameter(name))
        if (typed := typed_options(context, *further)) and not file:
            words = "--{name} is for the file of --{option}: give that too, or leave --{name} out"
            raise InvalidValue.in_words(typed[0], words, name=Parameter(typed[0]), option=Parameter(name))
        if file and (is_typed or not json):
            ending = checked_output(name, file, tuple(output.forms)) if output.forms else ""
            if extra := output.extras.get(ending):
                require(extra, name, str(file))
            if not output.forms:
                file.mkdir(exist_ok=True)
            yield name, Target(file, output.forms.get(ending, ""), {one: values[one] for one in further})


def _terms(progress: Progress) -> Terms:
    """The terms of an answer in a terminal, where a workbook may be as large as any other table."""
    settings = Settings()
    return Terms(settings.model_copy(update={"workbook_cells_max": settings.cells_max}), progress=progress)


def _answer(question: Question, request: Any, targets: dict[str, Target], json: bool) -> None:
    """Write the answer, or print it."""
    command = question.command
    assert command is not None
    title, files, answer = command.title(request), dict[str, bytes | dict[str, bytes]](), None
    with show.waiting(title) as progress:
        terms = _terms(progress)
        if command.solve:
            with speaking(language_for(request)):
                answer, writers = command.solve(request, terms)
                files = {name: writers[name](one.form, **one.options) for name, one in targets.items()}
        elif targets:
            files = {name: question.to_bytes(request, terms, one.form) for name, one in targets.items()}
        elif json:
            data = question.to_bytes(request, terms, JSON)
        else:
            with speaking(language_for(request)):
                answer = question.answer(request, terms)
    for name, made in files.items():
        file = targets[name].file
        for inner, part in made.items() if isinstance(made, dict) else [("", made)]:
            show.write(file / inner, part, command.outputs[name].note(request, part))
    if json:
        show.print_json(data if answer is None else answer.to_json())
    elif answer is not None:
        show.print_parts(*(command.parts(answer, request) if command.parts else fields_of(title, answer, request)))
