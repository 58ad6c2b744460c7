"""Fields of the service's requests as options of the command, refused in the service's words."""

from __future__ import annotations

import inspect
import math
import sys
from collections.abc import Callable, Collection, Iterable, Iterator
from contextlib import contextmanager, nullcontext
from pathlib import Path
from types import UnionType
from typing import Annotated, Any, TypeVar, Union, get_args, get_origin

import typer
from pydantic import BaseModel

from app.command.usage import path_argument
from app.files.disk import display_name, object_words
from app.maps.dances import read_dance
from app.settings import Settings
from app.wire.clocks import clock_at_zero
from app.wire.dances import DanceFields, PathFields, SpanFields, TimeRange
from app.wire.messages import checked
from app.wire.numbers import number_of
from app.wire.performances import BESIDE_SEVERAL, PerformanceFields
from app.wire.question import DanceQuery, Strays
from app.wire.refusals import refusing
from core import BenchDragonError, Dance, InvalidValue, Performance
from core.dance import DEFAULT_SPAN
from core.errors import Given, Parameter, Value
from core.language import Listed, say

Model = TypeVar("Model", bound=BaseModel)
Number = TypeVar("Number", int, float)
Json = Annotated[bool, typer.Option("--json", help="Print the service's JSON instead of a table.")]
# Key in the context of a command of the language that its option chose.
LANGUAGE = "app.command.language"
# Mark in the context of a command whose instants follow from start, stop and step.
RANGED = "app.command.options.ranged"
CONTEXT = inspect.Parameter("context", inspect.Parameter.KEYWORD_ONLY, annotation=typer.Context)


def typed_options(context: typer.Context, *names: str) -> list[str]:
    """The named options that were given on the command line."""
    sources = {name: context.get_parameter_source(name) for name in names}
    return [name for name, source in sources.items() if source is not None and source.name == "COMMANDLINE"]


def unused(context: typer.Context, names: Iterable[str], why: str, **values: Value) -> None:
    """Refuse named options that were given but have no use here. why: the rest of the template, with what to change"""
    for name in typed_options(context, *names):
        raise InvalidValue.in_words(name, f"{{field}} {why}", field=f"--{name.replace('_', '-')}", **values)


def numbers(option: str, text: str, kind: Callable[[str], Number]) -> list[Number]:
    """A list such as 0,60,120. raises: InvalidValue naming the entry that is not a number"""
    entries = []
    for k, word in enumerate(text.split(",")):
        try:
            number_of(word)
            entries.append(kind(word))
        except ValueError as error:
            rule = "must be a number, as in --{option} 0,1,2"
            if kind is int:
                rule = "must be a whole number, as in --{option} 0,1,2"
            raise InvalidValue(f"{option}.{k}", rule, got=Given(word), option=Parameter(option)) from error
    return entries


def changed(file: Path, body: type[Model], context: typer.Context, **changes: Any) -> Model:
    """The request in a file, with the options that were given in place of its values. raises: InvalidValue, OSError"""
    if "language" in body.model_fields:
        changes["language"] = context.meta.get(LANGUAGE)
    values = read_dance(file, several=True) | {name: value for name, value in changes.items() if value is not None}
    return checked(body, values, object_words(file))


def of_file(file: Path, body: type[Model], context: typer.Context, instead: str = "") -> Model:
    """The request for the dance in a file, as for `check`, with the options of the question.

    Values for `check` that this question does not take, such as a venue, are ignored; a note names ignored strays.
    instead: which strays count in place of those in the file, for a question about strays
    raises: InvalidValue, OSError
    """
    from app.questions.check import CheckRequest  # The import takes 0.02 s, and only a FILE needs it.

    own = body.model_fields.keys()
    described = [name for name in DanceQuery.model_fields if "path" in own or name not in own]
    unused(context, described, "cannot be combined with FILE, which describes the dance")
    held = read_dance(file, several="dances" in own)
    _refuse_other(file, held, own)
    if instead and (strays := [name for name in Strays.model_fields if held.get(name) and name not in own]):
        words = say("{file}: ignored: {names}, because {why}.", file=file, names=Listed(strays), why=say(instead))
        print(words, file=sys.stderr)
    values = {name: value for name, value in held.items() if name in own or name not in CheckRequest.model_fields}
    given = {**context.params, "language": context.meta.get(LANGUAGE)}
    typed = {name: given[name] for name in typed_options(context, *own)}
    # An option that may be given several times is a tuple there.
    values |= {name: list(value) if isinstance(value, tuple) else value for name, value in typed.items()}
    if isinstance(values.get("times"), str):
        values["times"] = numbers("times", values["times"], float)
    elif "times" in own and (steps := _steps(held, body, context)):
        values["times"] = steps
    elif "time" in own and "start" in held:
        values.setdefault("time", held["start"])
    return _begun(checked(body, values, object_words(file)), held, context)


def _refuse_other(file: Path, held: dict[str, Any], own: Collection[str]) -> None:
    """Refuse a file of one dragon to a question about several, and one dance beside several.

    own: fields of the question
    """
    if "dances" in own and "path" not in own and "dances" not in held:
        words = "{file} must hold dances, each with a dragon and a path"
        raise InvalidValue.in_words("dances", words, file=display_name(file))
    if "dances" in held and (beside := [name for name in PathFields.model_fields if name in held]):
        raise InvalidValue(beside[0], BESIDE_SEVERAL)


def _steps(held: dict[str, Any], body: type[BaseModel], context: typer.Context) -> dict[str, Any]:
    """Evenly spaced instants from the options, and from start and stop of a file that holds no times; empty for none.

    The stop after a start of the file is that of the whole dance, 300 s later at most.
    """
    steps = {name: context.params[name] for name in typed_options(context, *TimeRange.model_fields)}
    ends = {} if "times" in held else {name: held[name] for name in SpanFields.model_fields if name in held}
    ends = checked(SpanFields, ends).model_dump(exclude_none=True)
    if steps or ends:
        context.meta[RANGED] = True
    if "start" in ends and "stop" not in ends | steps:
        start = (ends | steps)["start"]
        ends["stop"] = max(start, min(start + DEFAULT_SPAN, math.floor(_in_file(held).end.time)))
    return ends | steps


def _in_file(held: dict[str, Any]) -> Dance | Performance:
    """The dance in a file, or the dances of several. raises: InvalidValue"""
    if "dances" in held:
        several = checked(PerformanceFields, {"dances": held["dances"]})
        with refusing(several):
            return several.to_performance(Settings())
    request = checked(DanceFields, {name: held[name] for name in DanceFields.model_fields if name in held})
    with refusing(request):
        return request.to_dance(Settings().benches_max)


def _begun(request: Model, held: dict[str, Any], context: typer.Context) -> Model:
    """The request with the time of day at time 0, if the dance in a file begins at a time of day and not at the start
    of this question. raises: InvalidValue"""
    if not isinstance(request, DanceFields) or request.begin_clock is None or request.start_clock is not None:
        return request
    has_start = "start" in type(request).model_fields
    starts_elsewhere = bool(typed_options(context, "start")) if has_start else "start" in held
    if not starts_elsewhere:
        return request
    start = checked(SpanFields, {"start": held.get("start")}).start
    zero = clock_at_zero(request.begin_clock, _in_file(held).begin if start is None else start)
    return request.model_copy(update={"begin_clock": None, "start_clock": zero})


@contextmanager
def _in_options(context: typer.Context | None) -> Iterator[None]:
    """Context that removes "times." from refusals of start, stop and step, if these were given without `times`."""
    try:
        yield
    except BenchDragonError as error:
        if context is None or RANGED not in context.meta:
            raise
        raise error.renamed(lambda name: name.removeprefix("times.")) from error


def asks(
    model: type[BaseModel], body: type[BaseModel] | None = None, instead: str = "", file_help: str = ""
) -> Callable[[Callable[..., None]], Callable[..., None]]:
    """Turn the fields of a request into options of a command, whose first argument becomes the request.

    body: the request made from a FILE instead, if the command takes one
    instead: as for of_file()
    file_help: what a FILE holds that the command cannot do without; by default it may be left out
    """

    def decorated(command: Callable[..., None]) -> Callable[..., None]:
        own = {p.name: p for p in list(inspect.signature(command, eval_str=True).parameters.values())[1:]}
        fields = [
            inspect.Parameter(
                name,
                inspect.Parameter.KEYWORD_ONLY,
                default=field.default,
                annotation=Annotated[_without_limits(field.annotation), typer.Option(help=field.description)],
            )
            for name, field in model.model_fields.items()
            if name != "language"  # an option of every command
        ]
        added = [_file(body, file_help), CONTEXT] if body else []

        def run(**values: Any) -> None:
            context = values["context"] if "context" in own else values.pop("context", None)
            file = values.pop("file", None) if body else None
            flat = {name: values.pop(name) for name in model.model_fields if name != "language"}
            with _in_options(context):
                request = of_file(file, body, context, instead) if body and file else checked(model, flat)
                # A command with a FILE of its own names its fields itself.
                with nullcontext() if values.get("file") else refusing(request):
                    command(request, **values)

        parameters = [p.replace(kind=inspect.Parameter.KEYWORD_ONLY) for p in own.values()]
        parameters += [p for p in added if p.name not in own] + fields
        run.__signature__ = inspect.Signature(parameters)  # type: ignore[attr-defined]
        run.__annotations__ = {p.name: p.annotation for p in parameters}
        run.__name__ = command.__name__
        # Help keeps the ends of lines of all paragraphs but the first.
        run.__doc__ = "\n\n".join(" ".join(one.split()) for one in (command.__doc__ or "").split("\n\n"))
        return run

    return decorated


def _file(body: type[BaseModel], words: str) -> inspect.Parameter:
    """The argument FILE of a command that answers this request. words: its help, if it must be given"""
    path = ", any path" if "path" in body.model_fields else "; its path does not count"
    kind: Any = Path if words else Path | None
    default = inspect.Parameter.empty if words else None
    help_text = words or f"Dance as a .toml or .json file, as for check: any dragon{path}."
    annotation = Annotated[kind, path_argument("FILE", help_text)]
    return inspect.Parameter("file", inspect.Parameter.KEYWORD_ONLY, default=default, annotation=annotation)


def _without_limits(annotation: Any) -> Any:
    """A type without the limits of pydantic, which not every version of typer accepts."""
    if get_origin(annotation) is Annotated:
        return _without_limits(get_args(annotation)[0])
    if get_origin(annotation) in (Union, UnionType):
        return Union[tuple(map(_without_limits, get_args(annotation)))]  # noqa: UP007
    return annotation
