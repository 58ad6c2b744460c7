"""One line in the service's words for each mistake that the parser of options finds."""

from __future__ import annotations

import difflib
import re
from copy import copy
from pathlib import Path
from typing import Any

import typer
from typer.core import TyperGroup

from app.wire.messages import ALIKE_SLIP, fault_of

# Class of every mistake that the parser reports; typer gives it no public name.
Misuse: Any = typer.BadParameter.__base__
EMPTY = "must not be an empty name: the current folder is ."


class ExplainedMistake(typer.BadParameter):
    """A mistake with a complete message in the service's words."""


class Commands(TyperGroup):
    """Commands; an unknown name is answered with the known one that is most like it."""

    def resolve_command(self, ctx: Any, args: list[str]) -> Any:
        if self.get_command(ctx, args[0]) is None:
            raise ExplainedMistake(unknown(args[0], self.list_commands(ctx)))
        return super().resolve_command(ctx, args)


def explain_values(parameter: Any) -> None:
    """Let an option or argument say in the service's words which values it takes."""
    kind = copy(parameter.type)  # one object for all options of a type
    convert = kind.convert

    def convert_or_explain(value: Any, *context: Any) -> Any:
        try:
            return convert(value, *context)
        except typer.BadParameter as error:
            raise ExplainedMistake(_value_message(parameter, str(value))) from error

    kind.convert = convert_or_explain
    parameter.type = kind


def message_of(error: Any) -> str:
    """One line for a Misuse: what is wrong, where, and what to change; else the parser's own message."""
    if isinstance(error, ExplainedMistake):
        return error.message
    if hasattr(error, "possibilities"):
        return unknown(error.option_name, [option for one in error.ctx.command.params for option in one.opts])
    if hasattr(error, "param_type") and error.param is not None and not error.message:
        return f"{_name(error.param)} is missing"
    words = re.sub(r"\s+", " ", error.format_message().removeprefix("Invalid value: ")).rstrip(".")
    return f"{words[:1].lower()}{words[1:]}"


def path(text: str | Path) -> Path:
    """The path of a file or folder. An empty name, as of an unset variable, would be the current folder: refused."""
    if not str(text):
        raise ValueError
    return Path(text)


def path_argument(metavar: str, words: str) -> Any:
    """An argument with the name of a file or folder. metavar: its own name in help and messages; words: its help"""
    return typer.Argument(parser=path, metavar=metavar, help=words)


def unknown(word: str, known: list[str]) -> str:
    bare = {one.lstrip("-"): one for one in known}
    near = difflib.get_close_matches(word.lstrip("-"), bare, n=1, cutoff=ALIKE_SLIP)
    return f"{word} is unknown here: " + (f"did you mean {bare[near[0]]}?" if near else "see --help")


def _name(parameter: Any) -> str:
    """What a user calls an option or argument."""
    argument = parameter.param_type_name == "argument"
    return str((parameter.metavar or parameter.name.upper()) if argument else parameter.opts[0])


def _value_message(parameter: Any, value: str) -> str:
    """Message for a value that an option or argument cannot take."""
    name, kind = _name(parameter), parameter.type
    if kind.name == path.__name__:
        return f"{name} {EMPTY}"
    if getattr(kind, "choices", None):
        *most, last = [str(getattr(choice, "value", choice)) for choice in kind.choices]
        return f"{name} must be {', '.join(most)} or {last}, got {value}"
    if hasattr(kind, "min") and re.fullmatch(r"[-+]?\d+", value):
        return f"{name} must be from {kind.min} to {kind.max}, got {value}"
    wrong = {"type": "int_parsing" if "int" in kind.name else "float_parsing", "input": value}
    return fault_of({**wrong, "loc": ("query", parameter.name)}, None).with_field(name).message
