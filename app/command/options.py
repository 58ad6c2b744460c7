"""Fields of the service's requests as options of the command, refused in the service's words."""

from __future__ import annotations

import inspect
import math
import sys
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager, nullcontext
from copy import copy
from enum import EnumType
from pathlib import Path
from types import NoneType, UnionType
from typing import Annotated, Any, Literal, TypeVar, Union, get_args, get_origin

import typer
from pydantic import BaseModel
from pydantic.fields import FieldInfo

from app.command.usage import path_argument
from app.files.disk import display_name, ending_of, object_words, read_json
from app.maps.dances import read_dance
from app.settings import Settings
from app.wire.clocks import clock_at_zero
from app.wire.dances import DanceFields, PathFields, SpanFields, TimeRange
from app.wire.fields import HeadSpeed, SpiralFields, Strays, UniformDragon, Wire
from app.wire.messages import checked
from app.wire.numbers import numbers_of
from app.wire.options import PathOptions
from app.wire.paths import TurnFields
from app.wire.performances import BESIDE_SEVERAL, PerformanceFields
from app.wire.question import Command, Question
from app.wire.refusals import refusing
from core import BenchDragonError, Dance, InvalidValue, Performance
from core.dance import DEFAULT_SPAN
from core.language import Listed, say
from core.quantities import Parameter, Value

Model = TypeVar("Model", bound=BaseModel)
Json = Annotated[bool, typer.Option("--json", help="Print the service's JSON instead of a table.")]
# Key in the context of a command of the language that its option chose.
LANGUAGE = "app.command.language"
# Key in the context of a command of the objects in its request whose fields are options.
OBJECTS = "app.command.options.objects"
# Options that describe a path, those of a turn alone, and all that describe a dance.
OF_PATH = tuple(dict.fromkeys((*SpiralFields.model_fields, *TurnFields.model_fields)))
OF_TURN = tuple(name for name in OF_PATH if name not in SpiralFields.model_fields)
DESCRIBING = (*UniformDragon.model_fields, *HeadSpeed.model_fields, "path", *OF_PATH)
CONTEXT = inspect.Parameter("context", inspect.Parameter.KEYWORD_ONLY, annotation=typer.Context)


def typed_options(context: typer.Context, *names: str) -> list[str]:
    """The named options that were given on the command line."""
    sources = {name: context.get_parameter_source(name) for name in names}
    return [name for name, source in sources.items() if source is not None and source.name == "COMMANDLINE"]


def unused(context: typer.Context, names: Iterable[str], why: str, **values: Value) -> None:
    """Refuse named options that were given but have no use here. why: the rest of the template, with what to change"""
    for name in typed_options(context, *names):
        raise InvalidValue.in_words(name, f"{{field}} {why}", field=f"--{name.replace('_', '-')}", **values)


def of_options(options: type[BaseModel], question: Question, context: typer.Context) -> BaseModel:
    """The request in the options of a question; those with a path become a body. raises: InvalidValue"""
    given, body = context.params, question.body
    if body is None or not issubclass(options, PathOptions):
        return checked(options, {name: given[name] for name in options.model_fields if name in given})
    if given["path"] != "turn":
        unused(context, OF_TURN, "belongs to a turn: give --path turn too, or leave it out")
    values = _typed(body, context, question.command)
    context.meta[OBJECTS] = ("times", "dragon", "path")
    values["dragon"] = {name: given[name] for name in typed_options(context, *UniformDragon.model_fields)}
    values["path"] = {name: given[name] for name in typed_options(context, *OF_PATH)} | {"kind": given["path"]}
    return checked(body, values)


def _typed(body: type[BaseModel], context: typer.Context, command: Command | None) -> dict[str, Any]:
    """Fields of a request that were given as options. raises: InvalidValue"""
    given, values = {**context.params, "language": context.meta.get(LANGUAGE)}, dict[str, Any]()
    for name, field in body.model_fields.items():
        if fields := _object_of(field):
            if typed := typed_options(context, *fields):
                values[name] = {one: given[one] for one in typed}
                context.meta[OBJECTS] = (name,)
        elif typed_options(context, name):
            # An option that may be given several times is a tuple there.
            values[name] = list(given[name]) if isinstance(given[name], tuple) else given[name]
    for name, option in command.lists.items() if command else ():
        if typed_options(context, name):
            values[option.name] = [option.read(text) for text in given[name]]
    if "times" not in body.model_fields:
        return values
    steps = typed_options(context, *TimeRange.model_fields)
    if "times" in values:
        if steps:
            words = "--times replaces --{option}: give one of the two"
            raise InvalidValue.in_words("times", words, option=Parameter(steps[0]))
        values["times"] = numbers_of("times", values["times"], float)
    elif steps:
        values["times"] = {name: given[name] for name in steps}
    return values


def of_file(file: Path, body: type[Model], context: typer.Context, command: Command | None = None) -> Model:
    """The request for the dance in a file, as for `check`, with the options of the question.

    Values for `check` that this question does not take, such as a venue, are ignored; a note names ignored strays.
    raises: InvalidValue, OSError
    """
    from app.questions.check import CheckRequest  # The import takes 0.02 s, and only a FILE needs it.

    own, instead = body.model_fields.keys(), command.instead if command else ""
    described = [name for name in DESCRIBING if name not in own or ("path" in own and name not in OF_TURN)]
    unused(context, described, "cannot be combined with FILE, which describes the dance")
    typed = _typed(body, context, command)
    held = read_dance(file, several="dances" in own)
    _refuse_other(file, held, own)
    if instead and (strays := [name for name in Strays.model_fields if held.get(name) and name not in own]):
        words = say("{file}: ignored: {names}, because {why}.", file=file, names=Listed(strays), why=say(instead))
        print(words, file=sys.stderr)
    values = {name: value for name, value in held.items() if name in own or name not in CheckRequest.model_fields}
    values |= typed
    if "times" in own and not isinstance(typed.get("times", held.get("times")), list):
        if steps := _steps(held, typed.get("times", {})):
            values["times"], context.meta[OBJECTS] = steps, ("times",)
    elif "time" in own and "start" in held:
        values.setdefault("time", held["start"])
    return _begun(checked(body, values, object_words(file)), held, context)


def of_json(file: Path, body: type[Model], options: Iterable[str], context: typer.Context) -> Model:
    """The request in a file that holds no dance, in place of the options. raises: InvalidValue, OSError"""
    unused(context, options, "describes a dance, and FILE gives the benches: give one of the two")
    values = {} if ending_of(file) == ".toml" else read_json(file)
    if "benches" not in values:
        words = "{file} must be JSON with benches, each a rectangle with x, y, heading, length and width"
        why = "ask check or clearance about a dance"
        raise InvalidValue.in_words("file", words, reason=why, file=str(file))
    return checked(body, values)


def _refuse_other(file: Path, held: dict[str, Any], own: Collection[str]) -> None:
    """Refuse a file of one dragon to a question about several, and one dance beside several.

    own: fields of the question
    """
    if "dances" in own and "path" not in own and "dances" not in held:
        words = "{file} must hold dances, each with a dragon and a path"
        raise InvalidValue.in_words("dances", words, file=display_name(file))
    if "dances" in held and (beside := [name for name in PathFields.model_fields if name in held]):
        raise InvalidValue(beside[0], BESIDE_SEVERAL)


def _steps(held: dict[str, Any], steps: dict[str, Any]) -> dict[str, Any]:
    """Evenly spaced instants from the options, and from start and stop of a file that holds no times; empty for none.

    The stop after a start of the file is that of the whole dance, 300 s later at most. steps: in the options
    """
    ends = {} if "times" in held else {name: held[name] for name in SpanFields.model_fields if name in held}
    ends = checked(SpanFields, ends).model_dump(exclude_none=True)
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
def in_options(context: typer.Context) -> Iterator[None]:
    """Context in which refusals name the options, which have the names of fields without those of their objects."""
    try:
        yield
    except BenchDragonError as error:
        if OBJECTS not in context.meta:
            raise
        raise error.renamed(lambda name: _within(name, context.meta[OBJECTS])) from error


def _within(name: str, objects: Sequence[str]) -> str:
    """The name of a field without that of its object, if it is one of these."""
    outer, _, inner = name.partition(".")
    return inner if outer in objects and inner.isidentifier() else name


def asks(model: type[Wire]) -> Callable[[Callable[..., None]], Callable[..., None]]:
    """Turn the fields of a request into options of a command, whose first argument becomes the request."""

    def decorated(command: Callable[..., None]) -> Callable[..., None]:
        own = list(inspect.signature(command, eval_str=True).parameters.values())[1:]

        def run(**values: Any) -> None:
            request = checked(model, {name: values.pop(name) for name in model.model_fields if name in values})
            # A command with a FILE of its own names its fields itself.
            with nullcontext() if values.get("file") else refusing(request):
                command(request, **values)

        return with_options(run, [*own, *field_options(model.model_fields)], command.__name__, command.__doc__ or "")

    return decorated


def with_options(
    run: Callable[..., None], parameters: list[inspect.Parameter], name: str, words: str
) -> Callable[..., None]:
    """A function as a command with these parameters. words: its help"""

    def command(**values: Any) -> None:
        run(**values)

    parameters = [one.replace(kind=inspect.Parameter.KEYWORD_ONLY) for one in parameters]
    command.__signature__ = inspect.Signature(parameters)  # type: ignore[attr-defined]
    command.__annotations__ = {one.name: one.annotation for one in parameters}
    command.__name__ = name
    # Help keeps the ends of lines of all paragraphs but the first.
    command.__doc__ = "\n\n".join(" ".join(one.split()) for one in words.split("\n\n"))
    return command


def field_options(fields: Mapping[str, FieldInfo]) -> list[inspect.Parameter]:
    """The options for the fields of a request."""
    return [
        inspect.Parameter(
            name,
            inspect.Parameter.KEYWORD_ONLY,
            default=field.default,
            annotation=Annotated[Union[_words(field)], typer.Option(help=field.description)],  # noqa: UP007
        )
        for name, field in fields.items()
        if name != "language"  # an option of every command
    ]


def own_fields(body: type[BaseModel]) -> dict[str, FieldInfo]:
    """The fields of a request beside those of a dance that a word or a number gives, and those of its objects."""
    from app.questions.check import CheckRequest

    fields = dict[str, FieldInfo]()
    for name, field in body.model_fields.items():
        if name in CheckRequest.model_fields:
            continue
        if inner := _object_of(field):
            fields |= {one: _optional(part) for one, part in inner.items()}
        elif _is_word(field):
            fields[name] = field
    return fields


def _object_of(field: FieldInfo) -> Mapping[str, FieldInfo]:
    """The fields of the object that a field holds, if each is a word or a number; else none."""
    kind, *others = [one for one in _kinds(field.annotation) if one is not NoneType]
    inner = kind.model_fields if not others and isinstance(kind, type) and issubclass(kind, Wire) else {}
    return inner if all(map(_is_word, inner.values())) else {}


def _is_word(field: FieldInfo) -> bool:
    kinds = _kinds(field.annotation)
    return all(
        one in (int, float, str, bool, NoneType) or isinstance(one, EnumType) or get_origin(one) is Literal
        for one in kinds
    )


def _words(field: FieldInfo) -> tuple[Any, ...]:
    """The types of the values of an option: a text, where that or a number may stand."""
    kinds = _kinds(field.annotation)
    return tuple(one for one in kinds if one is not int or str not in kinds)


def _optional(field: FieldInfo) -> FieldInfo:
    """A field that may be left out."""
    field = copy(field)
    field.default, field.annotation = None, field.annotation | None  # type: ignore[operator, assignment]
    return field


def file_argument(body: type[Wire], words: str, options: type[Wire]) -> inspect.Parameter:
    """The argument FILE of a command that answers this request.

    words: its help; options: which stand in its place if they describe a dragon
    """
    path = ", any path" if "path" in body.model_fields else "; its path does not count"
    is_required = words and not issubclass(options, UniformDragon)
    kind: Any = Path if is_required else Path | None
    default = inspect.Parameter.empty if is_required else None
    help_text = words or f"Dance as a .toml or .json file, as for check: any dragon{path}."
    annotation = Annotated[kind, path_argument("FILE", help_text)]
    return inspect.Parameter("file", inspect.Parameter.KEYWORD_ONLY, default=default, annotation=annotation)


def _kinds(annotation: Any) -> list[Any]:
    """The types that a value may have, without the limits of pydantic, which not every version of typer accepts."""
    if get_origin(annotation) is Annotated:
        return _kinds(get_args(annotation)[0])
    several = get_origin(annotation) in (Union, UnionType)
    return [kind for one in get_args(annotation) for kind in _kinds(one)] if several else [annotation]
