"""One line in the service's words for each mistake that the parser of options finds."""

from __future__ import annotations

import ast
import difflib
import re
from pathlib import Path
from typing import Any

import typer

from app.wire.messages import ALIKE_SLIP, fault_of

# Class of every mistake that the parser reports; typer gives it no public name.
Misuse: Any = typer.BadParameter.__base__
# The value that stands in quotes at the beginning of the parser's message.
QUOTED = re.compile(r"""('.*'|".*"|\S+) is not """, re.DOTALL)
EMPTY = "must not be an empty name: the current folder is ."


def message_of(error: Any) -> str:
    """One line for a Misuse: what is wrong, where, and what to change; else the parser's own message."""
    parameter, quoted = getattr(error, "param", None), QUOTED.match(error.message or "")
    if hasattr(error, "possibilities"):
        return unknown(error.option_name, [option for one in error.ctx.command.params for option in one.opts])
    if parameter is not None and not error.message:
        own = parameter.metavar or parameter.name.upper()
        name = own if parameter.param_type_name == "argument" else parameter.opts[0]
        return f"{name} is missing" if hasattr(error, "param_type") else f"{name} {EMPTY}"  # refused by path()
    if parameter is not None and quoted:
        return _unfit(parameter, quoted[1])
    words = re.sub(r"\s+", " ", error.format_message().removeprefix("Invalid value: ")).rstrip(".")
    if command := re.match(r"No such command '([^']*)'", words):
        return unknown(command[1], error.ctx.command.list_commands(error.ctx))
    return f"{words[:1].lower()}{words[1:]}"


def path(text: str | Path) -> Path:
    """The place with that name; an empty one, as from an unset variable, is refused: it would be the current folder."""
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


def _unfit(parameter: Any, quoted: str) -> str:
    """Message for a value that an option cannot take. quoted: the value as the parser quotes it"""
    value = ast.literal_eval(quoted) if quoted[0] in "'\"" else quoted
    option, kind = parameter.opts[0], parameter.type
    if getattr(kind, "choices", None):
        *most, last = [str(getattr(choice, "value", choice)) for choice in kind.choices]
        return f"{option} must be {', '.join(most)} or {last}, got {value}"
    if " range" in kind.name and re.fullmatch(r"[-+]?\d+", value):
        return f"{option} must be from {kind.min} to {kind.max}, got {value}"
    wrong = {"type": "int_parsing" if "int" in kind.name else "float_parsing", "input": value}
    return fault_of({**wrong, "loc": ("query", parameter.name)}, None).named(option).message
