"""Answers for people: tables with units or the service's JSON, and a bar while they wait."""

from __future__ import annotations

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

from app.files import tables
from app.questions.check import LeastClearance, Nearest, Report
from app.questions.overlaps import OverlapsAnswer
from app.questions.paper import PaperNumber
from app.wire import answers
from app.wire.models import Answer, unit_of
from core import Judgement, RunEnd, Trajectory
from core.errors import said, said_bound

# A trajectory on a terminal: the handles that the contest asks for, at this many instants, or as many as fit.
SHOWN_HANDLES = (0, 1, 51, 101, 151, 201)
SHOWN_INSTANTS = 7
# Decimals of a trajectory on a terminal.
SHOWN_DECIMALS = 6
# A handle so many times faster than the head, on a run that ends in a fold, tells that the fold is near [1]; the mark
# of such an instant.
FAST = 2.0
NEAR_FOLD = " *"
# So many or more are shown at equal distances where that is possible, rather than one or two more.
EVEN_INSTANTS = 5
# What a table takes beside its entries: for each column, and at its sides [characters].
COLUMN_SPACE, TABLE_SPACE = 3, 1
# Width of a table where standard output is no terminal [characters].
PIPE_WIDTH = 120
# What a null says where it is an answer.
PROVEN = frozenset({"clear_until", "proven_from", "proven_up_to"})
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


def _console() -> Console:
    return Console(highlight=False, markup=False, width=None if sys.stdout.isatty() else PIPE_WIDTH)


def print_parts(*parts: Part) -> None:
    console = _console()
    for part in parts:
        console.print(part)


def print_answer(title: str, answer: Answer, json: bool, *, margin: float = 0.0, benches: int = 0) -> None:
    """An answer as its JSON, or as two columns: each field by its name on the wire, and its value with its unit.

    margin: what counts as a contact [m], told where it is more than a touch
    benches: of the dragon, where the answer names those that were judged
    """
    if json:
        print_json(answer.to_json())
        return
    table = _table(title, "field", "value", header=False)
    for name, value in _flat(answer, benches=benches):
        table.add_row(name, _near(value, margin) if name in ("outcome", "limited by") else value)
    print_parts(table)


def _near(word: str, margin: float) -> str:
    """The word of an outcome: with a margin a contact is no touch."""
    near = f"nearer than {said(margin)} m"
    words = {"contact": near, "contact_at_start": f"{near} from the start on", "clear": f"never {near}"}
    return words.get(word, word) if margin else word


def _flat(answer: BaseModel, prefix: str = "", *, benches: int) -> Iterator[tuple[str, str]]:
    for name, field in type(answer).model_fields.items():
        value = getattr(answer, name)
        label = prefix + name.replace("_", " ")
        if isinstance(value, answers.Feature):
            yield label, ", ".join(f"{word} {_shown(said)}" for word, said in value)
        elif isinstance(value, answers.PairCheck):
            yield from ((f"{label}: {word}", said) for word, said in _check_words(value, benches))
        elif isinstance(value, BaseModel):
            yield from _flat(value, f"{label}: ", benches=benches)
        elif value is not None:
            unit = unit_of(field)
            exact = isinstance(value, (float, tuple)) and (name in PROVEN or name.endswith("_bracket"))
            words = _digits(value) if exact else _shown(value)
            yield label, f"{words} {unit if value != [] else ''}".rstrip()
        elif name in SAID_BY_NULL:
            yield label, SAID_BY_NULL[name]


def _digits(value: float | tuple[float | None, ...]) -> str:
    """What is proven, with all its digits: a rounded one would say more than is proven."""
    ends = value if isinstance(value, tuple) else (value,)
    return ", ".join("unknown" if end is None else said(end) for end in ends)


def _check_words(check: answers.PairCheck, benches: int) -> Iterator[tuple[str, str]]:
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
    # Adding 0.0 turns a rounded -0.0 into 0.0.
    return f"{round(value, decimals) + 0.0:.{decimals}f}" if isinstance(value, float) else str(value)


def _table(title: str, *columns: str, header: bool = True) -> Table:
    table = Table(title=title, box=box.SIMPLE, show_header=header, title_justify="left", title_style="bold")
    for k, name in enumerate(columns):
        table.add_column(name, justify="right" if k and header else "left", overflow="fold")
    return table


def trajectory_tables(
    result: Trajectory,
    handles: Sequence[int] | None = None,
    *,
    all_instants: bool = False,
    decimals: int | None = None,
    fold: RunEnd | None = None,
) -> list[Part]:
    """Some handles at some instants.

    handles: which; None: those of the contest and the last
    decimals: of every number; None: SHOWN_DECIMALS
    fold: where the run ends with one: instants just before it are marked, as speeds grow without bound there
    all_instants: in as many tables as they take; else up to SHOWN_INSTANTS, evenly spaced, as many as fit one
    """
    instants, number = result.speed.shape
    rows = list(handles) if handles else sorted({k for k in SHOWN_HANDLES if k < number} | {number - 1})
    names = tables.handle_names(number - 1)
    labels = [f"{k} {names[k]}" for k in rows]
    x, y = result.position[..., 0], result.position[..., 1]
    places = SHOWN_DECIMALS if decimals is None else decimals
    instant_names = [_instant(result, t, fold) for t in range(instants)]
    blocks = _blocks(result, rows, labels, instant_names, all_instants, places)
    shown: list[Part] = []
    for title, values in (("x [m]", x), ("y [m]", y), ("speed [m/s]", result.speed)):
        for block in blocks:
            table = _table(title, "handle", *(instant_names[t] for t in block))
            for k, label in zip(rows, labels, strict=True):
                table.add_row(label, *(_entry(value, places) for value in values[block, k]))
            shown.append(table)
    count = sum(map(len, blocks))
    of_handles, of_instants = _plural("handle", range(number)), _plural("instant", range(instants))
    words = f"{len(rows)} of {number} {of_handles}, {count} of {instants} {of_instants}"
    choose = ["--handles"] * (handles is None) + ["--times"] * (not all_instants)
    verb = "choose" if len(choose) > 1 else "chooses"
    advice = ["--output has all", *([f"{' and '.join(choose)} {verb}"] if choose else [])]
    shown.append(f"{words}: {', '.join(advice)}.")
    if fold and any(instant_names[t].endswith(NEAR_FOLD) for block in blocks for t in block):
        when = f"Just before bench {fold.bench} folds, at {fold.time:.9f} s"
        shown.append(
            f"{NEAR_FOLD.strip()} {when}: towards that instant the speeds of handles behind it grow without bound."
        )
    return shown


def _blocks(
    result: Trajectory,
    rows: Sequence[int],
    labels: Sequence[str],
    names: Sequence[str],
    all_instants: bool,
    decimals: int,
) -> list[list[int]]:
    """The instants of each table: as many as fit into the width. names: of the instants"""
    instants = len(result.time)
    values = np.concatenate([result.position[:, rows].reshape(instants, -1), result.speed[:, rows]], axis=1)
    room = _console().width - TABLE_SPACE - COLUMN_SPACE - max(map(len, [*labels, "handle"]), default=0)

    def width(t: int) -> int:
        return COLUMN_SPACE + max(map(len, [names[t], *(_entry(value, decimals) for value in values[t])]))

    if not all_instants:
        counts = range(min(SHOWN_INSTANTS, instants), 1, -1)
        even = [count for count in counts if count >= EVEN_INSTANTS and (instants - 1) % (count - 1) == 0]
        for count in (*even, *counts):
            spaced = np.linspace(0, instants - 1, count).round().astype(int).tolist()
            if sum(map(width, spaced)) <= room:
                return [spaced]
        return [[0]] if instants else []
    blocks: list[list[int]] = []
    left = 0
    for t in range(instants):
        taken = width(t)
        if not blocks or taken > left:
            blocks.append([])
            left = room
        blocks[-1].append(t)
        left -= taken
    return blocks


def _instant(result: Trajectory, t: int, fold: RunEnd | None) -> str:
    near = fold is not None and result.speed[t].max() > FAST * result.speed[t, 0]
    return f"{result.time[t]:.12g} s{NEAR_FOLD if near else ''}"


def _entry(value: float, decimals: int) -> str:
    return f"{round(value, decimals) + 0.0:.{decimals}f}"


def clearance_tables(columns: dict[str, Any]) -> list[Part]:
    """Clearance at every instant, and the local minima between them."""
    table = _table("Clearance", "time [s]", "clearance [m]", "benches")
    for time, clearance, benches in zip(columns["time"], columns["clearance"], columns["benches"], strict=True):
        table.add_row(said(time), _shown(float(clearance)), _shown(tuple(benches)))
    grazes = _table("Local minima", "time [s]", "clearance [m]", "benches")
    for graze in columns["grazes"]:
        grazes.add_row(_shown(graze.time), _shown(graze.clearance), _shown(graze.benches))
    return [table, grazes if columns["grazes"] else "No local minimum between the first and the last instant."]


def overlap_tables(answer: OverlapsAnswer, margin: float = 0.0) -> list[Part]:
    title = f"Pairs nearer than {said(margin)} m" if margin else "Overlapping pairs"
    table = _table(title, "benches", "separation [m]", "witness a [m]", "witness b [m]")
    for one in answer.overlaps:
        table.add_row(*map(_shown, (one.benches, one.separation, one.witness_a, one.witness_b)))
    check = answer.cross_check
    found = ", ".join(f"{engine.value} {len(pairs)}" for engine, pairs in check.engines.items())
    asked = "All four engines" if not check.left_out else "The engines that know a margin"
    return [table, f"{asked} {'agree' if check.agree else 'DISAGREE'}; pairs found: {found}"]


def paper_tables(rows: Sequence[PaperNumber]) -> list[Part]:
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


VERDICTS = {
    Judgement.PASSES: "Passes. Nothing fails.",
    Judgement.FAILS: "Fails. What fails, in order of time:",
    Judgement.UNDECIDED: "Undecided. Nothing is known to fail, but this is not decided:",
}


def report_tables(report: Report, *, margin: float, benches: int) -> list[Part]:
    """The verdict, what fails in order of time, and what was measured. margin: [m]; benches: of the dragon"""
    verdict = VERDICTS[report.verdict]
    facts = _table(f"From {report.start:.3f} to {report.stop:.3f} s", "what", "value", "at", "who")
    for name, value, time, who in _measured(report, margin, benches):
        facts.add_row(name, value, "" if time is None else f"{time:.6f} s", who)
    origin = report.origin
    words = "x = y = 0 is longitude {:.6f}, latitude {:.6f}: the middle of the square."
    where = [words.format(origin.longitude, origin.latitude)] if origin else []
    return [Text(verdict, style="bold"), *(f"  {one.message}" for one in report.failures), "", facts, *where]


def _measured(report: Report, margin: float, benches: int) -> Iterator[tuple[str, str, float | None, str]]:
    """What, how much, when, who."""
    contact = report.first_contact
    pair = f"benches {_shown(contact.benches)}" if contact.benches else ""
    what = f"first nearer than {said(margin)} m" if margin else "first contact"
    yield what, _near(contact.outcome.value, margin), contact.time, pair
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
    else:
        yield "highest speed", "grows without bound", report.stop, "towards the fold"
    if bend := report.sharpest_bend:
        yield "sharpest bend", f"{bend.angle:.6f} rad", bend.time, f"benches {_shown(bend.benches)}"


def _plural(word: str, things: Sequence[Any]) -> str:
    return word if len(things) == 1 else f"{word}s"


def _distance(found: LeastClearance | Nearest) -> str:
    least = found.at_least
    proven = "not proven" if least is None else f"proven: at least {said_bound(least, SHOWN_DECIMALS, -1)} m"
    return f"{found.distance:.6f} m, {proven}"
