"""Fields of the service's requests as options of the command, refused in the service's words."""

from __future__ import annotations

import inspect
import sys
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from pathlib import Path
from types import UnionType
from typing import Annotated, Any, TypeVar, Union, get_args, get_origin

import typer
from pydantic import BaseModel

from app.files.disk import object_words, read_dance
from app.wire.dances import TimeRange
from app.wire.messages import checked
from app.wire.question import DanceQuery, Strays
from app.wire.refusals import refusing
from core import BenchDragonError, InvalidValue

Model = TypeVar("Model", bound=BaseModel)
Number = TypeVar("Number", int, float)
Json = Annotated[bool, typer.Option("--json", help="Print the service's JSON instead of a table.")]
# Parameters of a command that also answers for the dance in a file.
FILE = inspect.Parameter(
    "file",
    inspect.Parameter.KEYWORD_ONLY,
    default=None,
    annotation=Annotated[
        Path | None, typer.Argument(help="Dance as a .toml or .json file, as for check: any dragon, any path.")
    ],
)
CONTEXT = inspect.Parameter("context", inspect.Parameter.KEYWORD_ONLY, annotation=typer.Context)


def given(context: typer.Context, *names: str) -> list[str]:
    """The named options that were given on the command line."""
    sources = {name: context.get_parameter_source(name) for name in names}
    return [name for name, source in sources.items() if source is not None and source.name == "COMMANDLINE"]


def unused(context: typer.Context, names: Iterable[str], why: str) -> None:
    """Refuse named options that were given but have no use here. why: the rest of the message, with what to change"""
    for name in given(context, *names):
        raise InvalidValue.in_words(name, f"--{name.replace('_', '-')} {why}")


def numbers(option: str, text: str, kind: Callable[[str], Number]) -> list[Number]:
    """A list such as 0,60,120. raises: InvalidValue naming the entry that is not a number"""
    found = []
    for k, word in enumerate(text.split(",")):
        try:
            found.append(kind(word))
        except ValueError as error:
            what = "a whole number" if kind is int else "a number"
            rule = f"{option}[{k}] must be {what}, as in --{option} 0,1,2"
            raise InvalidValue.in_words(f"{option}.{k}", f"{rule}, got {word!r:.60}") from error
    return found


def of_file(file: Path, body: type[Model], context: typer.Context, instead: str = "") -> Model:
    """The request for the dance in a file, as for `check`, with the options of the question.

    Fields of other questions in the file, such as a venue, are ignored; of strays a note says so.
    instead: which strays count in place of those in the file, for a question about strays
    raises: InvalidValue, OSError
    """
    unused(context, DanceQuery.model_fields, "cannot be combined with FILE, which describes the dance")
    told, own = read_dance(file), body.model_fields.keys()
    if instead and (strays := [name for name in Strays.model_fields if told.get(name) and name not in own]):
        print(f"{file}: not counted: {', '.join(strays)}: {instead}.", file=sys.stderr)
    told = {name: value for name, value in told.items() if name in own or name not in _asked_of_a_dance()}
    told |= {name: context.params[name] for name in given(context, *own)}
    if steps := _steps(body, context):
        told["times"] = {name: context.params[name] for name in steps}
    if isinstance(told.get("times"), str):
        told["times"] = numbers("times", told["times"], float)
    return checked(body, told, object_words(file))


def _steps(body: type[BaseModel], context: typer.Context) -> list[str]:
    """The options that give a range of instants in place of the times in the FILE."""
    return given(context, *TimeRange.model_fields) if "times" in body.model_fields else []


@contextmanager
def _in_options(body: type[BaseModel] | None, context: typer.Context) -> Iterator[None]:
    """Context that removes "times." from refusals of --start, --stop and --step, if those options were given."""
    try:
        yield
    except BenchDragonError as error:
        if body is None or not _steps(body, context):
            raise
        raise error.renamed(lambda name: name.removeprefix("times.")) from error


def _asked_of_a_dance() -> set[str]:
    from app.questions.registry import QUESTIONS  # It imports all questions in 0.2 s, and only a FILE needs it.

    bodies = [question.body for question in QUESTIONS.values() if question.body]
    return {name for body in bodies if "dragon" in body.model_fields for name in body.model_fields}


def asks(
    model: type[BaseModel], body: type[BaseModel] | None = None, instead: str = ""
) -> Callable[[Callable[..., None]], Callable[..., None]]:
    """Turn the fields of a request into options of a command, whose first argument becomes the request.

    body: the request made from a FILE instead, if the command takes one
    instead: as for of_file()
    """

    def decorated(command: Callable[..., None]) -> Callable[..., None]:
        own = {p.name: p for p in list(inspect.signature(command, eval_str=True).parameters.values())[1:]}
        fields = [
            inspect.Parameter(
                name,
                inspect.Parameter.KEYWORD_ONLY,
                default=field.default,
                annotation=Annotated[_plain(field.annotation), typer.Option(help=field.description)],
            )
            for name, field in model.model_fields.items()
        ]
        added = [FILE, CONTEXT] if body else []

        def asked(**values: Any) -> None:
            context = values["context"] if "context" in own else values.pop("context", None)
            file = values.pop("file", None) if body else None
            flat = {name: values.pop(name) for name in model.model_fields}
            with _in_options(body if file else None, context):
                request = of_file(file, body, context, instead) if body and file else checked(model, flat)
                with refusing(request):
                    command(request, **values)

        parameters = [p.replace(kind=inspect.Parameter.KEYWORD_ONLY) for p in own.values()]
        parameters += [p for p in added if p.name not in own] + fields
        asked.__signature__ = inspect.Signature(parameters)  # type: ignore[attr-defined]
        asked.__annotations__ = {p.name: p.annotation for p in parameters}
        asked.__name__, asked.__doc__ = command.__name__, command.__doc__
        return asked

    return decorated


def _plain(annotation: Any) -> Any:
    """A type without the limits of pydantic, which not every version of typer accepts."""
    if get_origin(annotation) is Annotated:
        return _plain(get_args(annotation)[0])
    if get_origin(annotation) in (Union, UnionType):
        return Union[tuple(map(_plain, get_args(annotation)))]  # noqa: UP007
    return annotation
