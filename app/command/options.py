"""Fields of the service's requests as options of the command, refused in the service's words."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Iterable
from pathlib import Path
from types import UnionType
from typing import Annotated, Any, TypeVar, Union, get_args, get_origin

import typer
from pydantic import BaseModel, ValidationError
from rich.markup import escape

from app.files.disk import read_dance
from app.questions import QUESTIONS
from app.wire.dances import SHAPES, DanceQuery, TimeRange
from app.wire.messages import message
from app.wire.refusals import refusing
from core import InvalidValue
from core.errors import spoken

Model = TypeVar("Model", bound=BaseModel)
Number = TypeVar("Number", int, float)
Json = Annotated[bool, typer.Option("--json", help="The service's JSON instead of a table.")]
# What a command gets that may be asked about the dance of a file.
FILE = inspect.Parameter(
    "file",
    inspect.Parameter.KEYWORD_ONLY,
    default=None,
    annotation=Annotated[
        Path | None, typer.Argument(help="A dance, .toml or .json, as check takes it: any dragon, any path.")
    ],
)
CONTEXT = inspect.Parameter("context", inspect.Parameter.KEYWORD_ONLY, annotation=typer.Context)


def checked(model: type[Model], values: object) -> Model:
    """The values as the service's own request; a wrong one is refused in the service's words."""
    try:
        return model.model_validate(values)
    except ValidationError as error:
        first = error.errors()[0]
        field = ".".join(str(part) for part in first["loc"] if part not in SHAPES)
        words = message({**first, "loc": ("", *first["loc"])}, model)
        # Words such as `times[1] must be ...` name the place in a list already.
        outer = field.rstrip("0123456789").rstrip(".") if "[" in words.partition(" ")[0] else field
        raise InvalidValue(field, f"{spoken(outer)}: {words}" if "." in outer else words) from error


def given(context: typer.Context, *names: str) -> list[str]:
    """Those of the options that stand on the command line."""
    sources = {name: context.get_parameter_source(name) for name in names}
    return [name for name, source in sources.items() if source is not None and source.name == "COMMANDLINE"]


def unused(context: typer.Context, names: Iterable[str], why: str) -> None:
    """Refuse those of the options that stand on the command line though nothing here uses them; why: and what to do."""
    for name in given(context, *names):
        raise InvalidValue(name, f"--{name.replace('_', '-')} {why}")


def numbers(option: str, text: str, kind: Callable[[str], Number]) -> list[Number]:
    """A list such as 0,60,120. raises: InvalidValue naming the entry that is no number"""
    found = []
    for k, word in enumerate(text.split(",")):
        try:
            found.append(kind(word))
        except ValueError as error:
            what = "a whole number" if kind is int else "a number"
            rule = f"{option}[{k}] must be {what}, as in --{option} 0,1,2"
            raise InvalidValue(f"{option}.{k}", f"{rule}, got {word!r:.60}") from error
    return found


def of_file(file: Path, body: type[Model], context: typer.Context) -> Model:
    """The request whose dance is that of a file, as `check` takes it, with what the options say of the question.

    What other questions ask of a dance, such as a venue, is left aside.
    raises: InvalidValue, OSError
    """
    unused(context, DanceQuery.model_fields, "is about a dance, and the dance is that of FILE: give one of them")
    told, own = read_dance(file), body.model_fields.keys()
    if isinstance(told, dict):
        told = {name: value for name, value in told.items() if name in own or name not in _asked_of_a_dance()}
        told |= {name: context.params[name] for name in given(context, *own)}
        if (
            steps := {name: context.params[name] for name in given(context, *TimeRange.model_fields)}
            if "times" in own
            else {}
        ):
            told["times"] = steps
        if isinstance(told.get("times"), str):
            told["times"] = numbers("times", told["times"], float)
    return checked(body, told)


def _asked_of_a_dance() -> set[str]:
    bodies = [question.body for question in QUESTIONS.values() if question.body]
    return {name for body in bodies if "dragon" in body.model_fields for name in body.model_fields}


def asks(
    model: type[BaseModel], body: type[BaseModel] | None = None
) -> Callable[[Callable[..., None]], Callable[..., None]]:
    """Make the fields of a request the options of a command; the command gets the request as its first argument.

    body: the request that a FILE of a dance becomes instead, where the command takes one
    """

    def decorated(command: Callable[..., None]) -> Callable[..., None]:
        own = {p.name: p for p in list(inspect.signature(command, eval_str=True).parameters.values())[1:]}
        fields = [
            inspect.Parameter(
                name,
                inspect.Parameter.KEYWORD_ONLY,
                default=field.default,
                annotation=Annotated[_plain(field.annotation), typer.Option(help=escape(field.description or ""))],
            )
            for name, field in model.model_fields.items()
        ]
        added = [FILE, CONTEXT] if body else []

        def asked(**values: Any) -> None:
            context = values["context"] if "context" in own else values.pop("context", None)
            file = values.pop("file", None) if body else None
            flat = {name: values.pop(name) for name in model.model_fields}
            request = of_file(file, body, context) if body and file else checked(model, flat)
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
    """A type without the limits of pydantic, which not every version of typer looks through."""
    if get_origin(annotation) is Annotated:
        return _plain(get_args(annotation)[0])
    if get_origin(annotation) in (Union, UnionType):
        return Union[tuple(map(_plain, get_args(annotation)))]  # noqa: UP007
    return annotation
