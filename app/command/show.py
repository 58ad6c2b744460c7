"""Output for people: tables with units or the service's JSON, and a progress bar."""

from __future__ import annotations

import os
import sys
import threading
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from pydantic import BaseModel
from rich import box
from rich.cells import cell_len
from rich.console import Console
from rich.progress import Progress
from rich.table import Table
from rich.text import Text

from app.files.disk import write_whole
from app.wire import answers
from app.wire.question import Answer, unit_of
from core.display import format_count
from core.errors import format_number
from core.language import Language

# Decimals of lengths and speeds on a terminal.
DISPLAY_DECIMALS = 6
# Width that a table takes beside its entries: for each column, and at both sides together [characters].
COLUMN_SPACE, TABLE_SPACE = 3, 1
# Width of a table where standard output is not a terminal [characters].
PIPE_WIDTH = 120
# Proven fields, which are shown with all digits; and the words for a null that is an answer.
PROVEN = frozenset({"clear_until", "proven_from", "proven_up_to"})
MEANING_OF_NULL = {"proven_up_to": "every larger pitch", "scan_step": "no scan"}
# Limits whose values are no words.
LIMITS = {"least_radius": "the least radius of a bend: half of the longest chord and 0.1 % more, which the proof needs"}
# Fields whose values the sentences beside them have.
UNSHOWN = frozenset({"claim"})
# Most entries of a list in a table; of a longer list only their number is shown.
LISTED_MOST = 50
# Fields that are separations of two benches: below zero the benches overlap.
SEPARATIONS = frozenset({"gap", "clearance"})
# A progress bar appears after this wait [s].
BAR_DELAY = 1.0
# Variables of the environment that name the locale of messages, the first that is set counts (POSIX, 8.2).
LOCALE = ("LC_ALL", "LC_MESSAGES", "LANG")

Part = Table | Text | str


def language_of_terminal() -> Language:
    """The language of the locale, if there are sentences in it; else English."""
    known = (os.environ.get(name) for name in LOCALE)
    locale = next(filter(None, known), "")
    code = locale.lower().partition("_")[0]
    return Language(code) if code in list(Language) else Language.ENGLISH


@contextmanager
def waiting(what: str) -> Iterator[Callable[[float], None]]:
    """A progress bar on standard error after BAR_DELAY; yields a function that takes the share done.

    what: what is waited for
    """
    if not sys.stderr.isatty():
        yield lambda share: None
        return
    bar = Progress(console=Console(stderr=True), transient=True)
    task = bar.add_task(what, total=None)
    timer = threading.Timer(BAR_DELAY, bar.start)
    timer.start()
    try:
        yield lambda share: bar.update(task, total=1.0, completed=share)
    finally:
        timer.cancel()
        timer.join()
        if bar.live.is_started:
            bar.stop()


@contextmanager
def steps() -> Iterator[Callable[[str, float], None]]:
    """Progress over several steps on standard error; without a terminal a line for each quarter of a step."""
    if sys.stderr.isatty():
        with Progress(console=Console(stderr=True), transient=True) as bar:
            tasks: dict[str, Any] = {}

            def advance(what: str, share: float) -> None:
                if what not in tasks:
                    tasks[what] = bar.add_task(what, total=1.0)
                bar.update(tasks[what], completed=share)

            yield advance
        return
    quarters: dict[str, int] = {}

    def print_quarter(what: str, share: float) -> None:
        quarter = int(4.0 * share + 1e-9)
        if quarter > quarters.get(what, 0):
            quarters[what] = quarter
            print(f"{what}: {25 * quarter} %", file=sys.stderr, flush=True)

    yield print_quarter


def print_json(data: bytes) -> None:
    sys.stdout.buffer.write(data + b"\n")
    sys.stdout.buffer.flush()


def new_console() -> Console:
    return Console(highlight=False, markup=False, width=None if sys.stdout.isatty() else PIPE_WIDTH)


def print_parts(*parts: Part) -> None:
    console = new_console()
    for part in parts:
        console.print(_fitted(part, console) if isinstance(part, Table) else part)


def _fitted(table: Table, console: Console) -> Table | str:
    """A table in which no number is broken, or its rows one below the other where the terminal is too narrow."""
    names = [str(column.header) if table.show_header else "" for column in table.columns]
    cells = [[str(cell) for cell in column.cells] for column in table.columns]
    widths = [
        max(map(cell_len, " ".join([name, *entries]).split()), default=0)
        for name, entries in zip(names, cells, strict=True)
    ]
    if table.show_header and TABLE_SPACE + sum(widths) + COLUMN_SPACE * len(widths) > console.width:
        rows = [
            [f"{name}: {cell}" for name, cell in zip(names, row, strict=True) if cell]
            for row in zip(*cells, strict=True)
        ]
        return "\n\n".join([str(table.title or ""), *map("\n".join, rows)]).strip()
    for column, width in zip(table.columns, widths, strict=True):
        column.min_width = width
    return table


def print_result(result: Answer | answers.Columns, json: bool, parts: Iterable[Part]) -> None:
    """Print an answer as JSON, or else its parts, which may be made only then."""
    if json:
        print_json(result.to_json())
    else:
        print_parts(*parts)


def write(file: Path, data: bytes) -> None:
    """Write a file as a whole, and name it on standard error. raises: OSError"""
    write_whole(file, data)
    print(file, file=sys.stderr)


def print_answer(title: str, answer: Answer, json: bool, *, margin: float = 0.0, benches: int = 0) -> None:
    """Print an answer as JSON, or as two columns: the name of each field, and its value with its unit.

    margin: clearance required [m]; 0: only a touch is a contact
    benches: of the dragon, if the answer names the benches judged
    """
    if json:
        print_json(answer.to_json())
        return
    table = new_table(title, "field", "value", header=False)
    for name, value in _flat(answer, benches=benches):
        table.add_row(name, near(value, margin) if name in ("outcome", "limited by") else value)
    print_parts(table)


def _polygon_words(value: answers.Polygon | answers.MultiPolygon) -> str:
    several = [value.coordinates] if isinstance(value, answers.Polygon) else value.coordinates
    rings = [ring for polygon in several for ring in polygon]
    holes, points = len(rings) - len(several), sum(map(len, rings))
    return f"{format_count(len(several), 'polygon')}, {format_count(holes, 'hole')}, {points} points"


def near(word: str, margin: float) -> str:
    """An outcome or a limit in words: with a margin a contact is not always a touch."""
    near = f"within {format_number(margin)} m"
    words = {"contact": near, "contact_at_start": f"{near} from the start on", "clear": f"never {near}"}
    return (words if margin else {}).get(word, LIMITS.get(word, word))


def _flat(answer: BaseModel, prefix: str = "", *, benches: int) -> Iterator[tuple[str, str]]:
    for name, field in type(answer).model_fields.items():
        value = getattr(answer, name)
        if name in UNSHOWN:
            continue
        label = prefix + name.replace("_", " ")
        if isinstance(value, answers.Feature):
            yield label, ", ".join(f"{word} {value_text(number)}" for word, number in value)
        elif isinstance(value, answers.PairCheck | answers.EncounterCheck):
            yield from ((f"{label}: {word}", text) for word, text in _check_words(value, benches))
        elif isinstance(value, answers.Polygon | answers.MultiPolygon):
            yield label, _polygon_words(value)
        elif isinstance(value, list) and value and isinstance(value[0], BaseModel) and len(value) <= LISTED_MOST:
            for k, one in enumerate(value):
                yield from _flat(one, f"{label}[{k}]: ", benches=benches)
        elif isinstance(value, list) and (count := sum(map(_entries, value))) > LISTED_MOST:
            yield label, f"{count}, listed by --json"
        elif isinstance(value, answers.DragonPair):
            yield label, _pair_text(value)
        elif isinstance(value, BaseModel):
            yield from _flat(value, f"{label}: ", benches=benches)
        elif isinstance(value, tuple) and value and isinstance(value[0], BaseModel):
            for k, one in enumerate(value):
                yield from _flat(one, f"{label}[{k}]: ", benches=benches)
        elif isinstance(value, float) and name in SEPARATIONS:
            yield label, separation(value, " m")
        elif value is not None:
            unit = unit_of(field)
            exact = isinstance(value, (float, tuple)) and (name in PROVEN or name.endswith("_bracket"))
            words = _digits(value, unit) if exact else f"{value_text(value)} {unit if value != [] else ''}".rstrip()
            yield label, words
        elif name in MEANING_OF_NULL:
            yield label, MEANING_OF_NULL[name]


def _entries(value: Any) -> int:
    """Number of the entries of a list in a list; 1 for anything else."""
    return len(value) if isinstance(value, list) else 1


def _digits(value: float | tuple[float | None, ...], unit: str) -> str:
    """A proven value with all its digits, because a rounded value could claim more than the proof."""
    ends = value if isinstance(value, tuple) else (value,)
    each = f" {unit}" if None in ends else ""
    words = ", ".join("unknown" if end is None else format_number(end) + each for end in ends)
    return words if each else f"{words} {unit}".rstrip()


def separation(metres: float, unit: str = "", decimals: int = 9) -> str:
    """A separation of two benches [m] in words; a negative one as the depth of the overlap."""
    words = value_text(float(metres), decimals)
    return (f"overlap by {words[1:]}" if words.startswith("-") else words) + unit


def _pair_text(pair: answers.Pair | answers.DragonPair) -> str:
    if isinstance(pair, answers.DragonPair):
        return ", ".join(f"{b} of dragon {k}" for b, k in zip(pair.benches, pair.dragons, strict=True))
    return value_text(pair)


def _check_words(check: answers.PairCheck | answers.EncounterCheck, benches: int) -> Iterator[tuple[str, str]]:
    yield "agree", value_text(check.agree)
    yield "judged", judged_words(check.judged, benches)
    for engine, verdict in check.engines.items():
        before = "" if verdict.before is None else f"before {value_text(verdict.before)}, "
        yield engine.value, f"{before}after {value_text(verdict.after)}"
    if check.together:
        yield "together", "; ".join(map(_pair_text, check.together))
    if check.left_out:
        yield "left out", value_text(check.left_out)


def judged_words(judged: Sequence[int] | Sequence[Sequence[int]], benches: int) -> str:
    """Short description of the benches that the engines judged, one list or one for each dragon. benches: of all"""
    several = [one for one in judged if not isinstance(one, int)]
    known = [bench for own in several for bench in own] or [one for one in judged if isinstance(one, int)]
    if len(known) == benches:
        return f"all {benches} benches"
    if len(known) == len(("a", "b")):
        return f"only benches {value_text(known)}"
    ends = "" if several else f", from {known[0]} to {known[-1]}"
    return f"{len(known)} of {benches:,} benches{ends}: those near the pair"


def value_text(value: Any, decimals: int = 9) -> str:
    if isinstance(value, (tuple, list)):
        return ", ".join(value_text(entry, 12) for entry in value) or "none"
    if isinstance(value, bool):
        return "yes" if value else "no"
    if value is None:
        return "none"
    # Adding 0.0 turns a rounded -0.0 into 0.0.
    return f"{round(value, decimals) + 0.0:.{decimals}f}" if isinstance(value, float) else str(value)


def new_table(title: str, *columns: str, header: bool = True) -> Table:
    table = Table(title=title, box=box.SIMPLE, show_header=header, title_justify="left", title_style="bold")
    for k, name in enumerate(columns):
        table.add_column(name, justify="right" if k and header else "left", overflow="fold")
    return table
