"""Output for people: tables with units or the service's JSON, and a progress bar."""

from __future__ import annotations

import os
import re
import sys
import threading
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from rich import box
from rich.cells import cell_len
from rich.console import Console
from rich.progress import Progress as Bar
from rich.table import Table as RichTable
from rich.text import Text

from app.command.interrupts import interrupts
from app.files.disk import write_whole
from app.wire.answers import Columns
from app.wire.fields import Answer
from app.wire.labels import Heading, Part, TextTable
from core.language import Language, named_language, say
from core.values import Progress

# Width that a table takes beside its entries: for each column, and at both sides together [characters].
COLUMN_SPACE, TABLE_SPACE = 3, 1
# Width of a table where standard output is not a terminal [characters].
PIPE_WIDTH = 120
# What a line may end after: a word with the space behind it, or a character that is two cells wide, with the brackets
# and the marks that belong to it.
WIDE = "\u1100-\u115f\u2e80-\ua4cf\uac00-\ud7a3\uf900-\ufaff\ufe30-\ufe6f\uff00-\uff60\uffe0-\uffe6"
PIECE = re.compile(rf"\s+|[（《【「『]*(?:[{WIDE}]|[^\s{WIDE}]+)[、。，；：！？）》】」』]*")
# A progress bar appears after this wait [s].
BAR_DELAY = 1.0
# Variables of the environment that name the locale of messages, the first that is set counts (POSIX, 8.2).
LOCALE = ("LC_ALL", "LC_MESSAGES", "LANG")


def language_of_terminal() -> Language:
    """The language of the locale, if there are sentences in it; else English."""
    known = (os.environ.get(name) for name in LOCALE)
    return named_language(next(filter(None, known), "")) or Language.ENGLISH


@contextmanager
def waiting(what: str) -> Iterator[Progress]:
    """A progress bar on standard error after BAR_DELAY; yields a function that takes the share done.

    what: what is waited for
    """
    if not sys.stderr.isatty():
        yield lambda share: interrupts.heed()
        return
    bar = Bar(console=Console(stderr=True), transient=True)
    task = bar.add_task(what, total=None)
    timer = threading.Timer(BAR_DELAY, bar.start)
    timer.start()

    def advance(share: float) -> None:
        interrupts.heed()
        bar.update(task, total=1.0, completed=share)

    try:
        yield advance
    finally:
        timer.cancel()
        timer.join()
        if bar.live.is_started:
            bar.stop()


@contextmanager
def steps() -> Iterator[Callable[[str, float], None]]:
    """Progress over several steps on standard error; without a terminal a line for each quarter of a step."""
    if sys.stderr.isatty():
        with Bar(console=Console(stderr=True), transient=True) as bar:
            tasks: dict[str, Any] = {}

            def advance(what: str, share: float) -> None:
                interrupts.heed()
                if what not in tasks:
                    tasks[what] = bar.add_task(what, total=1.0)
                bar.update(tasks[what], completed=share)

            yield advance
        return
    quarters: dict[str, int] = {}

    def print_quarter(what: str, share: float) -> None:
        interrupts.heed()
        quarter = int(4.0 * share + 1e-9)
        if quarter > quarters.get(what, 0):
            quarters[what] = quarter
            print(say("{name}: {text}", name=what, text=f"{25 * quarter} %"), file=sys.stderr, flush=True)

    yield print_quarter


def print_json(data: bytes) -> None:
    sys.stdout.buffer.write(data + b"\n")
    sys.stdout.buffer.flush()


def new_console() -> Console:
    return Console(highlight=False, markup=False, width=None if sys.stdout.isatty() else PIPE_WIDTH)


def print_parts(*parts: Part | RichTable) -> None:
    console = new_console()
    for part in parts:
        if isinstance(part, str):
            console.print(Text(part, style="bold") if isinstance(part, Heading) else part)
        else:
            console.print(_fitted(_rich(part, console.width) if isinstance(part, TextTable) else part, console))


def _fitted(table: RichTable, console: Console) -> RichTable | str:
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
    if table.show_header:
        for column, width in zip(table.columns, widths, strict=True):
            column.min_width = width
    return table


def print_result(result: Answer | Columns, json: bool, parts: Iterable[Part]) -> None:
    """Print an answer as JSON, or else its parts, which may be made only then."""
    if json:
        print_json(result.to_json())
    else:
        print_parts(*parts)


def write(file: Path, data: bytes, note: str = "") -> None:
    """Write a file as a whole, and name it on standard error. note: what is said beside; raises: OSError"""
    write_whole(file, data)
    print(say("{name}: {text}", name=file, text=note) if note else file, file=sys.stderr)


def _rich(table: TextTable, width: int) -> RichTable:
    """width: of the terminal, to which the lines are folded"""
    has_heads = bool(table.heads)
    rich = RichTable(title=table.title, box=box.SIMPLE, show_header=has_heads, title_justify="left", title_style="bold")
    for k, name in enumerate(table.heads or ("", "")):
        rich.add_column(name, justify="right" if k and has_heads else "left", overflow="fold")
    for line in _narrowed(table, width) if has_heads else _folded_lines(table.lines, width):
        rich.add_row(*line)
    return rich


def _narrowed(table: TextTable, width: int) -> Sequence[Sequence[str]]:
    """The lines of a table with heads; in one that is too wide the widest column is folded, if that is enough."""
    columns = list(zip(table.heads, *table.lines, strict=True))
    widths = [max(map(cell_len, column)) for column in columns]
    widest = widths.index(max(widths))
    room = width - TABLE_SPACE - COLUMN_SPACE * len(widths) - sum(widths) + widths[widest]
    needed = max(cell_len(piece) for cell in columns[widest] for piece in PIECE.findall(cell))
    if widths[widest] <= room or room < max(needed, 0.5 * widths[widest]):
        return table.lines
    return [[_folded(cell, room) if k == widest else cell for k, cell in enumerate(line)] for line in table.lines]


def _folded_lines(lines: Sequence[Sequence[str]], width: int) -> list[tuple[str, str]]:
    """Names and values in a table of a width, in which neither a number nor a word is broken that fits."""
    room = width - TABLE_SPACE - 2 * COLUMN_SPACE
    needed = max((cell_len(piece) for _, value in lines for piece in PIECE.findall(value)), default=0)
    named = [(_folded(name, max(width // 4, min(width // 2, room - needed))), value) for name, value in lines]
    room -= max((cell_len(line) for name, _ in named for line in name.split("\n")), default=0)
    return [(name, _folded(value, room)) for name, value in named]


def _folded(text: str, width: int) -> str:
    """The text in lines of at most a width, as far as its words allow. Chinese has few spaces."""
    lines: list[str] = []
    for paragraph in text.split("\n"):
        line = ""
        for piece in PIECE.findall(paragraph):
            if line.strip() and cell_len(f"{line}{piece}".rstrip()) > width:
                lines.append(line.rstrip())
                line = piece.lstrip()
            else:
                line += piece
        lines.append(line)
    return "\n".join(lines)
