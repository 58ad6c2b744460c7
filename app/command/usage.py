"""One line in the service's words for each mistake that the parser of options finds."""

from __future__ import annotations

import difflib
import inspect
import re
from contextlib import suppress
from enum import EnumType
from importlib import import_module
from pathlib import Path
from typing import Annotated, Any, Literal, get_args, get_origin

import typer
from rich.markup import escape
from typer.core import TyperGroup

from app.command.show import PIECE
from app.wire.messages import ALIKE_SLIP, fault_of
from app.wire.numbers import number_of
from core.errors import BenchDragonError
from core.language import Language, Listed, Phrases, phrase, say, spoken
from core.quantities import Given, fill_message

# Class of every mistake that the parser reports; typer gives it no public name.
Misuse: Any = typer.BadParameter.__base__
# What the parser says of arguments for which a command has no place, and of an option with a value that it cannot have.
EXTRA = re.compile(r"Got unexpected extra arguments?(?:\(s\))? \((.*)\)")
NO_VALUE = re.compile(r"Option '?(.*?)'? does not take a value\.")
EMPTY = "must not be an empty name: the current folder is ."
# The parser's own words in a help, by their names in typer.rich_utils, and two that have no name there.
USAGE, SHOW_HELP = phrase("Usage: "), phrase("Show this message and exit.")
HELP_WORDS: Phrases = {
    "ARGUMENTS_PANEL_TITLE": "Arguments",
    "OPTIONS_PANEL_TITLE": "Options",
    "COMMANDS_PANEL_TITLE": "Commands",
    "DEFAULT_STRING": "[default: {}]",
    "ENVVAR_STRING": "[env var: {}]",
    "REQUIRED_LONG_STRING": "[required]",
}
# What rich keeps in one line of a help: by itself it takes a Chinese sentence for one word.
WORD = re.compile(rf"(?:{PIECE.pattern})\s*")


class ExplainedMistake(typer.BadParameter):
    """A mistake with a complete message in the service's words."""


class Commands(TyperGroup):
    """Commands; an unknown name is answered with the known one that is most like it."""

    def resolve_command(self, ctx: Any, args: list[str]) -> Any:
        if self.get_command(ctx, args[0]) is None:
            raise ExplainedMistake(unknown(args[0], self.list_commands(ctx)))
        return super().resolve_command(ctx, args)


# typer's types of values are its own and change from version to version. So what a value must be is read from the
# annotation, and only the one method that converts a value is replaced.
def explain_values(command: Any) -> None:
    """Let the options and arguments of a command say in the service's words which values they take."""
    annotations = inspect.signature(command.callback, eval_str=True).parameters if command.callback else {}
    for parameter in command.params:
        if parameter.name in annotations:
            _explain(parameter, *_taken(annotations[parameter.name].annotation))


def _explain(parameter: Any, kind: Any, declared: Any) -> None:
    convert = parameter.process_value

    def convert_or_explain(context: Any, value: Any) -> Any:
        try:
            if kind in (int, float) and isinstance(value, str):
                number_of(value)
            return convert(context, value)
        except (typer.BadParameter, ValueError) as error:
            if isinstance(error, typer.BadParameter) and type(error) is not typer.BadParameter:  # one that is missing
                raise
            raise ExplainedMistake(_value_message(parameter, kind, declared, str(value))) from error

    parameter.process_value = convert_or_explain


def _taken(annotation: Any) -> tuple[Any, Any]:
    """Type of the values that an option or argument takes, and what its annotation declares beside."""
    kind, *declared = get_args(annotation) if get_origin(annotation) is Annotated else [annotation]
    while get_origin(kind) not in (None, Literal):
        kind = next(one for one in get_args(kind) if one is not type(None))
    return kind, declared[0] if declared else None


def message_of(error: Any) -> str:
    """One line for a Misuse: what is wrong, where, and what to change; else the error's own message."""
    if isinstance(error, (ExplainedMistake, BenchDragonError)):
        return error.message
    if hasattr(error, "possibilities"):
        return unknown(error.option_name, [option for one in error.ctx.command.params for option in one.opts])
    if hasattr(error, "param_type") and error.param is not None and not error.message:
        return fill_message("{name} is missing", {"name": _name(error.param)})
    text = error.format_message()
    if found := EXTRA.fullmatch(text):
        return fill_message("{words} must be left out: see --help", {"words": Given(found, found[1])})
    if found := NO_VALUE.fullmatch(text):
        return fill_message("{words} must stand without a value", {"words": Given(found, found[1])})
    if text == "Missing command.":
        return say("a command is missing: see --help")
    words = re.sub(r"\s+", " ", text.removeprefix("Invalid value: ")).rstrip(".")
    return f"{words[:1].lower()}{words[1:]}"


def say_help(command: Any) -> None:
    """Let the help of a command, and the parser's words in it, be in the language that is spoken."""
    for one in (command, *command.params):
        # A unit such as [m] must not be read as a style of rich.
        one.help = escape(say(one.help)) if one.help else ""
    format_help, get_usage = command.format_help, command.get_usage

    def format_in_words(context: Any, formatter: Any) -> None:
        parser: Any = import_module("typer.rich_utils")  # This takes 0.1 s, and only a help needs it.
        highlight = parser.OptionHighlighter()
        highlight.highlights = [*highlight.highlights, f"(?P<usage>{say(USAGE)})"]

        def folded(text: Any) -> Any:
            """Text of which nothing is cut off; in English rich cuts long names."""
            text = highlight(text)
            text.overflow = None if spoken() is Language.ENGLISH else "fold"
            return text

        for name, words in HELP_WORDS.items():
            setattr(parser, name, say(words))
        parser.highlighter = folded
        if spoken() is not Language.ENGLISH:
            with suppress(ImportError):  # a private module of rich
                import_module("rich._wrap").re_word = WORD  # type: ignore[attr-defined]
        command.get_help_option(context).help = say(SHOW_HELP)
        format_help(context, formatter)

    command.format_help = format_in_words
    command.get_usage = lambda context: get_usage(context).replace(USAGE, say(USAGE), 1)


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
    if near:
        return fill_message(
            "{word} is unknown here: did you mean {near}?",
            {"word": Given(word, word), "near": Given(near, bare[near[0]])},
        )
    return fill_message("{word} is unknown here: see --help", {"word": Given(word, word)})


def _name(parameter: Any) -> str:
    """What a user calls an option or argument."""
    argument = parameter.param_type_name == "argument"
    return str((parameter.metavar or parameter.name.upper()) if argument else parameter.opts[0])


def _value_message(parameter: Any, kind: Any, declared: Any, value: str) -> str:
    """Message for a value that an option or argument cannot take. kind, declared: see _taken()"""
    name = _name(parameter)
    if getattr(declared, "parser", None) is path:
        return fill_message(f"{{name}} {EMPTY}", {"name": name})
    choices = get_args(kind) if get_origin(kind) is Literal else list(kind) if isinstance(kind, EnumType) else []
    if choices:
        *most, last = [str(getattr(choice, "value", choice)) for choice in choices]
        allowed = say("{first} or {last}", first=Listed(most), last=last)
        return fill_message(
            "{name} must be {allowed}, got {value}", {"name": name, "allowed": allowed, "value": Given(value, value)}
        )
    if getattr(declared, "min", None) is not None and re.fullmatch(r"[-+]?\d+", value):
        values = {"name": name, "least": declared.min, "most": declared.max, "value": value}
        return fill_message("{name} must be from {least} to {most}, got {value}", values)
    wrong = {"type": "int_parsing" if kind is int else "float_parsing", "input": value}
    return fault_of({**wrong, "loc": ("query", parameter.name)}, None).with_field(name).message
