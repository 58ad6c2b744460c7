"""The command bench-dragon: the questions of the HTTP service, asked from a terminal.

The options of a command are the fields of the service's request, with the same names, limits and descriptions; a FILE
holds the body of a request. Answers go to standard output, as tables for people or, with --json, as the service's
JSON; progress and messages go to standard error. The exit code is 0 for every answer, also when benches touch or a
check fails, and 2 for wrong usage.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator
from contextlib import contextmanager, nullcontext
from importlib import import_module
from typing import Annotated, Any

import typer

import core
from app.command.asked import command_of
from app.command.options import LANGUAGE
from app.command.show import language_of_terminal
from app.command.streams import output_fault
from app.command.usage import Commands, Misuse, explain_values, message_of, say_help
from app.extras import NotTypeset
from core.errors import BenchDragonError
from core.kernels import COMPILED
from core.language import Language, named_language, say, speaking, spoken

# Module of each command, in the order of the help; none for a command that follows from its question. This module, or
# that of the question, is imported when its command is called, or the help lists it.
MODULE_OF = {
    "trajectory": "trajectory",
    "figures": "figures",
    "envelope": "",
    "film": "",
    "contest": "contest",
    "grade": "grade",
    "places": "places",
    "maps": "",
    "plan": "",
    "safety-sheet": "",
    "cues": "",
    "crew": "",
    "collision-time": "",
    "encounter": "",
    "safe-delay": "",
    "clearance": "",
    "minimum-pitch": "",
    "turn": "",
    "shortest-turn": "",
    "turn-time": "",
    "quickest-turn": "",
    "tolerance": "",
    "tolerance-curve": "",
    "contact-probability": "",
    "maximum-head-speed": "",
    "check": "",
    "propose": "",
    "overlaps": "",
    "paper": "",
    "serve": "serve",
    "mcp": "mcp",
    "prove": "prove",
    "jobs": "jobs",
    "sweep": "sweep",
}


# Module of the question that a command asks, where it has another name.
QUESTION_OF = {"film": "films", "propose": "proposals"}


@contextmanager
def _errors_in_one_line(language: Language | None) -> Iterator[None]:
    """Context that turns errors that a user can correct into one line on standard error and exit code 2, and a failure
    of the typesetter into one line and exit code 1.

    language: of all words; None for that which is spoken
    """
    with speaking(language or spoken()):
        try:
            yield
            return
        except BrokenPipeError:  # The reader has what it wanted: typer ends the command without a word.
            raise
        except (BenchDragonError, Misuse, OSError) as error:
            message = output_fault(error) if isinstance(error, OSError) else message_of(error)
            if message:  # Without any argument the parser prints the help.
                print(say("Error: {message}", message=message), file=sys.stderr)
        except NotTypeset as error:
            print(say("Error: {message}", message=error), file=sys.stderr)
            raise typer.Exit(1) from None
        raise typer.Exit(2)


def _language_option() -> Any:
    """The option of each command that chooses the language of its words."""

    def command(
        language: Annotated[
            Language | None,
            typer.Option(help="Language of the words; default: that of the terminal."),
        ] = None,
    ) -> None: ...

    app_of_one = typer.Typer(add_completion=False)
    app_of_one.command()(command)
    option = typer.main.get_command(app_of_one).params[0]
    option.expose_value = False
    return option


def _entry(command: str) -> Any:
    """The function of a command, or a typer app of several."""
    name, module = command.replace("-", "_"), MODULE_OF[command]
    if module:
        return getattr(import_module(f"app.command.{module}"), name)
    return command_of(import_module(f"app.questions.{QUESTION_OF.get(name, name)}").QUESTION)


HELP = {"help_option_names": ["-h", "--help"]}


def _with_known_language(arguments: list[str]) -> tuple[list[str], Language | None]:
    """Arguments with the code of the language after --language, of one without words here that of English; and this
    language, in which mistakes in the arguments are told too. Beside --help it may stand anywhere: it is taken out."""
    known, language, rest = list[str](), None, iter(arguments)
    for argument in rest:
        option, mark, after = argument.partition("=")
        name = after if mark or option != "--language" else next(rest, None)
        if option != "--language" or name is None:
            known.append(argument)
            continue
        language = named_language(name)
        if language is None:
            print(say("Warning: there are no words in {name!r}, so they are in English.", name=name), file=sys.stderr)
        language = language or Language.ENGLISH
        if not {*HELP["help_option_names"]} & {*arguments}:
            known += [option, language]
    return known, language


class _Commands(Commands):
    """The commands, imported one by one; each mistake in their use is reported in one line."""

    def main(self, *further: Any, **extra: Any) -> Any:
        # Also what a shell shows while it completes a line.
        with speaking(language_of_terminal()):
            return super().main(*further, **extra)

    def make_context(self, info_name: Any, args: list[str], *further: Any, **extra: Any) -> Any:
        # Without any argument the parser prints the help and raises an error, although the user made no mistake.
        known, language = _with_known_language(args)
        with _errors_in_one_line(language) if args else nullcontext():
            say_help(self)
            context = super().make_context(info_name, known, *further, **extra)
            if language:
                context.meta[LANGUAGE] = language
            return context

    def list_commands(self, ctx: Any) -> list[str]:
        return list(MODULE_OF)

    def get_command(self, ctx: Any, cmd_name: str) -> Any:
        if cmd_name not in MODULE_OF:
            return None
        entry = _entry(cmd_name)
        if not isinstance(entry, typer.Typer):
            # typer makes a command only of an app: this one has no other command.
            app_of_one = typer.Typer(context_settings=HELP, add_completion=False)
            app_of_one.command(cmd_name)(entry)
            entry = app_of_one
        command = typer.main.get_command(entry)
        command.name = cmd_name
        for one in (command, *getattr(command, "commands", {}).values()):
            if not any(parameter.name == "language" for parameter in one.params):
                one.params.append(_language_option())
            say_help(one)
            explain_values(one)
        return command

    def invoke(self, ctx: Any) -> Any:
        with _errors_in_one_line(ctx.meta.get(LANGUAGE)):
            result = super().invoke(ctx)
            sys.stdout.flush()
            return result


app = typer.Typer(
    name="bench-dragon",
    cls=_Commands,
    help="Positions of every bench of a dancing dragon, the first contact of two benches, and the smallest pitch.",
    no_args_is_help=True,
    pretty_exceptions_enable=False,
    context_settings=HELP,
)


def _print_version(wanted: bool) -> None:
    if wanted:
        print(f"bench-dragon {core.__version__}{'' if COMPILED else ', not compiled: many times slower'}")
        raise typer.Exit


@app.callback()
def bench_dragon(
    version: Annotated[
        bool, typer.Option("--version", callback=_print_version, is_eager=True, help="Print the version and exit.")
    ] = False,
) -> None:
    """Options that come before a command."""
