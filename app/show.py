"""Answers for people: tables with units or the service's JSON, and a bar while they wait."""

from __future__ import annotations

import re
import sys
import threading
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from typing import Any

import numpy as np
from pydantic import BaseModel
from rich import box
from rich.console import Console
from rich.progress import Progress
from rich.table import Table
from rich.text import Text

from app import answers, tables
from app.paper import Comparison
from app.report import LeastClearance, Nearest, Report
from core import Trajectory

# A trajectory on a terminal: the handles that the contest asks for, at this many instants.
SHOWN_HANDLES = (0, 1, 51, 101, 151, 201)
SHOWN_INSTANTS = 5
# Width of a table where standard output is no terminal [characters].
PIPE_WIDTH = 120
# What a null says where it is an answer.
SAID_BY_NULL = {"proven_up_to": "every larger pitch", "scan_step": "no scan"}
# A wait longer than this is shown [s].
SHOWN_WAIT = 1.0

Part = Table | Text | str


@contextmanager
def waiting(what: str) -> Iterator[Callable[[float], None]]:
    """A bar on standard error once the wait exceeds SHOWN_WAIT; yields the function that takes the share done."""
    if not sys.stderr.isatty():
        yield lambda share: None
        return
    bar = Progress(console=Console(stderr=True), transient=True)
    task = bar.add_task(what, total=None)
    timer = threading.Timer(SHOWN_WAIT, bar.start)
    timer.start()
    try:
        yield lambda share: bar.update(task, total=1.0, completed=share)
    finally:
        timer.cancel()
        timer.join()
        if bar.live.is_started:
            bar.stop()


def print_json(data: bytes) -> None:
    sys.stdout.buffer.write(data + b"\n")
    sys.stdout.buffer.flush()


def print_parts(*parts: Part) -> None:
    console = Console(highlight=False, markup=False, width=None if sys.stdout.isatty() else PIPE_WIDTH)
    for part in parts:
        console.print(part)


def print_answer(title: str, answer: answers.Answer, json: bool, *, benches: int = 0) -> None:
    """An answer as its JSON, or as two columns: each field by its name on the wire, and its value with its unit.

    benches: of the dragon, where the answer names those that were judged
    """
    if json:
        print_json(answer.to_json())
        return
    table = _table(title, "field", "value", header=False)
    for name, value in _flat(answer, benches=benches):
        table.add_row(name, value)
    print_parts(table)


def _flat(answer: BaseModel, prefix: str = "", *, benches: int) -> Iterator[tuple[str, str]]:
    for name, field in type(answer).model_fields.items():
        value = getattr(answer, name)
        label = prefix + name.replace("_", " ")
        if isinstance(value, answers.Feature):
            yield label, ", ".join(f"{word} {_shown(said)}" for word, said in value)
        elif isinstance(value, answers.ContactCheck):
            yield from ((f"{label}: {word}", said) for word, said in _check_words(value, benches))
        elif isinstance(value, BaseModel):
            yield from _flat(value, f"{label}: ", benches=benches)
        elif value is not None:
            unit = re.search(r"\[([^\]]+)\]$", field.description or "")
            yield label, f"{_shown(value)} {unit[1] if unit else ''}".rstrip()
        elif name in SAID_BY_NULL:
            yield label, SAID_BY_NULL[name]


def _check_words(check: answers.ContactCheck, benches: int) -> Iterator[tuple[str, str]]:
    yield "agree", _shown(check.agree)
    yield "judged", judged_words(check.judged, benches)
    for engine, verdict in check.engines.items():
        before = "" if verdict.before is None else f"before {_shown(verdict.before)}, "
        yield engine.value, f"{before}after {_shown(verdict.after)}"
    if check.together:
        yield "together", "; ".join(map(_shown, check.together))
    if check.left_out:
        yield "left out", _shown(check.left_out)


def judged_words(judged: Sequence[int], benches: int) -> str:
    """Which of so many benches the engines judged, in short."""
    if len(judged) == benches:
        return f"all {benches} benches"
    if len(judged) == len(("a", "b")):
        return f"benches {_shown(judged)} alone"
    return f"{len(judged)} benches from {judged[0]} to {judged[-1]}, of {benches:,}: those near the pair"


def _shown(value: Any, decimals: int = 9) -> str:
    if isinstance(value, (tuple, list)):
        return ", ".join(_shown(entry, 12) for entry in value) or "none"
    if isinstance(value, bool):
        return "yes" if value else "no"
    return f"{value:.{decimals}f}" if isinstance(value, float) else str(value)


def _table(title: str, *columns: str, header: bool = True) -> Table:
    table = Table(title=title, box=box.SIMPLE, show_header=header, title_justify="left", title_style="bold")
    for k, name in enumerate(columns):
        table.add_column(name, justify="right" if k and header else "left", overflow="fold")
    return table


def trajectory_tables(result: Trajectory) -> list[Part]:
    """A few handles at a few instants."""
    instants, handles = result.speed.shape
    rows = sorted({k for k in SHOWN_HANDLES if k < handles} | {handles - 1})
    columns = np.unique(np.linspace(0, instants - 1, SHOWN_INSTANTS).round().astype(int))
    names = tables.handle_names(handles - 1)
    x, y = result.position[..., 0], result.position[..., 1]
    shown: list[Part] = []
    for title, values in (("x [m]", x), ("y [m]", y), ("speed [m/s]", result.speed)):
        table = _table(title, "handle", *(f"{result.time[t]:g} s" for t in columns))
        for k in rows:
            table.add_row(f"{k} {names[k]}", *(f"{value:.6f}" for value in values[columns, k].round(6) + 0.0))
        shown.append(table)
    of_handles, of_instants = _plural("handle", range(handles)), _plural("instant", range(instants))
    return [
        *shown,
        f"{len(rows)} of {handles} {of_handles}, {len(columns)} of {instants} {of_instants}: --output has all.",
    ]


def overlap_tables(answer: answers.OverlapsAnswer) -> list[Part]:
    table = _table("Overlapping pairs", "benches", "separation [m]", "witness a [m]", "witness b [m]")
    for one in answer.overlaps:
        table.add_row(*map(_shown, (one.benches, one.separation, one.witness_a, one.witness_b)))
    check = answer.cross_check
    found = ", ".join(f"{engine.value} {len(pairs)}" for engine, pairs in check.engines.items())
    asked = "All four engines" if not check.left_out else "The engines that know a margin"
    return [table, f"{asked} {'agree' if check.agree else 'DISAGREE'}; pairs found: {found}"]


def paper_tables(rows: Sequence[Comparison]) -> list[Part]:
    """The numbers side by side, then each reason with its evidence."""
    table = _table("The paper beside this program", "quantity", "paper", "here", "difference")
    for one in rows:
        name = f"{one.quantity} [{one.unit}], {one.source}"
        table.add_row(name, str(one.paper), _shown(one.ours), f"{one.difference:+.6f}")
    parts: list[Part] = [table]
    for one in rows:
        facts = [f"  {fact.what}: {_shown(fact.value)} {fact.unit}" for fact in one.evidence]
        parts += [Text(one.quantity, style="bold"), one.reason, *facts, ""]
    return parts


def report_tables(report: Report, benches: int) -> list[Part]:
    """The verdict, what fails in order of time, and what was measured. benches: of the dragon"""
    verdict = "Nothing fails." if report.passed else "What fails, in order of time:"
    facts = _table(f"From {report.start:.3f} to {report.stop:.3f} s", "what", "value", "at", "who")
    for name, value, time, who in _measured(report, benches):
        facts.add_row(name, value, "" if time is None else f"{time:.6f} s", who)
    return [Text(verdict, style="bold"), *(f"  {one.message}" for one in report.failures), "", facts]


def _measured(report: Report, benches: int) -> Iterator[tuple[str, str, float | None, str]]:
    """What, how much, when, who."""
    contact = report.first_contact
    pair = f"benches {_shown(contact.benches)}" if contact.benches else ""
    yield "first contact", contact.outcome.value, contact.time, pair
    if check := contact.cross_check:
        yield (
            "cross-check",
            f"engines {'agree' if check.agree else 'DISAGREE'}",
            None,
            judged_words(check.judged, benches),
        )
    if least := report.least_clearance:
        yield "least clearance", _distance(least), least.time, f"benches {_shown(least.benches)}"
    for area in report.venue.areas if report.venue else ():
        yield (
            f"nearest to {area.name}",
            _distance(area.nearest),
            area.nearest.time,
            f"bench {area.nearest.bench}",
        )
    if speed := report.highest_speed:
        yield (
            "highest speed",
            f"{speed.speed:.6f} m/s",
            speed.time,
            f"{_plural('handle', speed.handles)} {_shown(speed.handles)}",
        )
    if bend := report.sharpest_bend:
        yield "sharpest bend", f"{bend.angle:.6f} rad", bend.time, f"benches {_shown(bend.benches)}"


def _plural(word: str, things: Sequence[Any]) -> str:
    return word if len(things) == 1 else f"{word}s"


def _distance(found: LeastClearance | Nearest) -> str:
    proven = "not proven" if found.at_least is None else f"proven: at least {found.at_least:.6f} m"
    return f"{found.distance:.6f} m, {proven}"
