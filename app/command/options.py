"""Fields of the service's requests as options of the command, refused in the service's words."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Iterable
from typing import Annotated, Any, TypeVar

import typer
from pydantic import BaseModel, ValidationError
from rich.markup import escape

from app.wire.dances import SHAPES
from app.wire.messages import message
from app.wire.refusals import refusing
from core import InvalidValue
from core.errors import spoken

Model = TypeVar("Model", bound=BaseModel)
Number = TypeVar("Number", int, float)


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


def asks(model: type[Model]) -> Callable[[Callable[..., None]], Callable[..., None]]:
    """Make the fields of a request the options of a command; the command gets the request as its first argument."""

    def decorated(command: Callable[..., None]) -> Callable[..., None]:
        own = list(inspect.signature(command, eval_str=True).parameters.values())[1:]
        fields = [
            inspect.Parameter(
                name,
                inspect.Parameter.KEYWORD_ONLY,
                default=field.default,
                annotation=Annotated[field.annotation, typer.Option(help=escape(field.description or ""))],
            )
            for name, field in model.model_fields.items()
        ]

        def asked(**values: Any) -> None:
            request = checked(model, {name: values.pop(name) for name in model.model_fields})
            with refusing(request):
                command(request, **values)

        parameters = [p.replace(kind=inspect.Parameter.KEYWORD_ONLY) for p in own] + fields
        asked.__signature__ = inspect.Signature(parameters)  # type: ignore[attr-defined]
        asked.__annotations__ = {p.name: p.annotation for p in parameters}
        asked.__name__, asked.__doc__ = command.__name__, command.__doc__
        return asked

    return decorated
