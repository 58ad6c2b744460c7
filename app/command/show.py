"""Output for people: tables with units or the service's JSON, and a progress bar."""

from __future__ import annotations

import sys
import threading
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from typing import Any

from pydantic import BaseModel
from rich import box
from rich.console import Console
from rich.progress import Progress
from rich.table import Table
from rich.text import Text

from app.questions.check import LeastClearance, Nearest, Report
from app.questions.overlaps import OverlapsAnswer
from app.questions.paper import PaperNumber, PublishedNumber
from app.wire import answers
from app.wire.models import Answer, unit_of
from core import Judgement
from core.errors import said, said_bound

# Decimals of lengths and speeds on a terminal.
SHOWN_DECIMALS = 6
# Width of a table besides its entries: for each column, and at its sides [characters].
COLUMN_SPACE, TABLE_SPACE = 3, 1
# Width of a table where standard output is no terminal [characters].
PIPE_WIDTH = 120
# Fields that are proven, shown with all digits; and the words for a null that is an answer.
PROVEN = frozenset({"clear_until", "proven_from", "proven_up_to"})
SAID_BY_NULL = {"proven_up_to": "every larger pitch", "scan_step": "no scan"}
# Entries of a list in a table; a longer one is only counted.
LISTED_MOST = 50
# Separations of two benches: below zero they overlap.
SEPARATIONS = frozenset({"gap", "clearance"})
# A progress bar appears after this wait [s].
SHOWN_WAIT = 1.0

Part = Table | Text | str


@contextmanager
def waiting(what: str) -> Iterator[Callable[[float], None]]:
    """A progress bar on standard error after SHOWN_WAIT; yields a function of the share done."""
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


@contextmanager
def steps() -> Iterator[Callable[[str, float], None]]:
    """Progress over several things on standard error, a line for each that is done where that is no terminal."""
    if sys.stderr.isatty():
        with Progress(console=Console(stderr=True), transient=True) as bar:
            tasks: dict[str, Any] = {}

            def told(what: str, share: float) -> None:
                if what not in tasks:
                    tasks[what] = bar.add_task(what, total=1.0)
                bar.update(tasks[what], completed=share)

            yield told
        return
    yield lambda what, share: print(what, file=sys.stderr, flush=True) if share >= 1.0 else None


def print_json(data: bytes) -> None:
    sys.stdout.buffer.write(data + b"\n")
    sys.stdout.buffer.flush()


def new_console() -> Console:
    return Console(highlight=False, markup=False, width=None if sys.stdout.isatty() else PIPE_WIDTH)


def print_parts(*parts: Part) -> None:
    console = new_console()
    for part in parts:
        console.print(part)


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
        table.add_row(name, _near(value, margin) if name in ("outcome", "limited by") else value)
    print_parts(table)


def _polygon_words(value: answers.Polygon | answers.MultiPolygon) -> str:
    several = [value.coordinates] if isinstance(value, answers.Polygon) else value.coordinates
    rings = [ring for polygon in several for ring in polygon]
    holes, points = len(rings) - len(several), sum(map(len, rings))
    return f"{len(several)} {plural('polygon', several)}, {holes} {plural('hole', range(holes))}, {points} points"


def _near(word: str, margin: float) -> str:
    """The words for an outcome, because with a margin a contact need not be a touch."""
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
        elif isinstance(value, answers.Polygon | answers.MultiPolygon):
            yield label, _polygon_words(value)
        elif isinstance(value, list) and len(value) > LISTED_MOST:
            yield label, f"{len(value)}, listed by --json"
        elif isinstance(value, BaseModel):
            yield from _flat(value, f"{label}: ", benches=benches)
        elif isinstance(value, float) and name in SEPARATIONS:
            yield label, _separation(value, " m")
        elif value is not None:
            unit = unit_of(field)
            exact = isinstance(value, (float, tuple)) and (name in PROVEN or name.endswith("_bracket"))
            words = _digits(value) if exact else _shown(value)
            yield label, f"{words} {unit if value != [] else ''}".rstrip()
        elif name in SAID_BY_NULL:
            yield label, SAID_BY_NULL[name]


def _digits(value: float | tuple[float | None, ...]) -> str:
    """A proven value with all its digits, because a rounded one could claim more than is proven."""
    ends = value if isinstance(value, tuple) else (value,)
    return ", ".join("unknown" if end is None else said(end) for end in ends)


def _separation(metres: float, unit: str = "", decimals: int = 9) -> str:
    """A separation of two benches [m]; below zero by how much they overlap."""
    shown = _shown(float(metres), decimals)
    return (f"overlap by {shown[1:]}" if shown.startswith("-") else shown) + unit


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
    """Short description of the benches that the engines judged. benches: of the dragon"""
    if len(judged) == benches:
        return f"all {benches} benches"
    if len(judged) == len(("a", "b")):
        return f"only benches {_shown(judged)}"
    return f"{len(judged)} benches from {judged[0]} to {judged[-1]}, of {benches:,}: those near the pair"


def _shown(value: Any, decimals: int = 9) -> str:
    if isinstance(value, (tuple, list)):
        return ", ".join(_shown(entry, 12) for entry in value) or "none"
    if isinstance(value, bool):
        return "yes" if value else "no"
    # Adding 0.0 turns a rounded -0.0 into 0.0.
    return f"{round(value, decimals) + 0.0:.{decimals}f}" if isinstance(value, float) else str(value)


def new_table(title: str, *columns: str, header: bool = True) -> Table:
    table = Table(title=title, box=box.SIMPLE, show_header=header, title_justify="left", title_style="bold")
    for k, name in enumerate(columns):
        table.add_column(name, justify="right" if k and header else "left", overflow="fold")
    return table


def clearance_tables(columns: dict[str, Any]) -> list[Part]:
    """Clearance at every instant, and the local minima between them."""
    table = new_table("Clearance", "time [s]", "clearance [m]", "benches")
    for time, clearance, benches in zip(columns["time"], columns["clearance"], columns["benches"], strict=True):
        table.add_row(said(time), _separation(clearance), _shown(tuple(benches)))
    grazes = new_table("Local minima", "time [s]", "clearance [m]", "benches")
    for graze in columns["grazes"]:
        grazes.add_row(_shown(graze.time), _separation(graze.clearance), _shown(graze.benches))
    return [table, grazes if columns["grazes"] else "No local minimum between the first and the last instant."]


def curve_table(columns: dict[str, Any]) -> Part:
    """How far people may stray at each pitch."""
    table = new_table("How far people may stray", "pitch [m]", "stray [m]", "shown to touch [m]", "limited by")
    for pitch, stray, touching, limit in zip(*columns.values(), strict=True):
        table.add_row(said(pitch), said(stray), "unknown" if touching is None else said(touching), limit.value)
    return table


def overlap_tables(answer: OverlapsAnswer, margin: float = 0.0) -> list[Part]:
    title = f"Pairs nearer than {said(margin)} m" if margin else "Overlapping pairs"
    table = new_table(title, "benches", "separation [m]", "witness a [m]", "witness b [m]")
    for one in answer.overlaps:
        table.add_row(_shown(one.benches), _separation(one.separation), _shown(one.witness_a), _shown(one.witness_b))
    check = answer.cross_check
    found = ", ".join(f"{engine.value} {len(pairs)}" for engine, pairs in check.engines.items())
    asked = "All four engines" if not check.left_out else "The engines that can judge a margin"
    return [table, f"{asked} {'agree' if check.agree else 'DISAGREE'}; pairs found: {found}"]


def paper_tables(rows: Sequence[PaperNumber], literature: Sequence[PublishedNumber]) -> list[Part]:
    """The numbers side by side, then each reason with its evidence; then the numbers of other publications."""
    table = new_table("The paper beside this program", "quantity", "paper", "here", "difference")
    for one in rows:
        name = f"{one.quantity} [{one.unit}], {one.source}"
        table.add_row(name, str(one.paper), _shown(one.ours), f"{one.difference:+.6f}")
    parts: list[Part] = [table]
    for one in rows:
        facts = [f"  {fact.what}: {_shown(fact.value)} {fact.unit}" for fact in one.evidence]
        parts += [Text(one.quantity, style="bold"), one.reason, *facts, ""]
    others = new_table("Other publications", "quantity", "published", "here", "difference")
    for other in literature:
        difference = f"{other.difference:+.6f}"
        others.add_row(f"{other.quantity} [{other.unit}]", str(other.published), _shown(other.ours), difference)
    parts.append(others)
    for other in literature:
        known = [f"{found.words} {found.evidence}" for found in other.diagnosis] or ["No known shortcut gives it."]
        parts += [Text(f"{other.published} {other.unit}: {other.source}", style="bold"), *known, ""]
    return parts


VERDICTS = {
    Judgement.PASSES: "Passes. Nothing fails.",
    Judgement.FAILS: "Fails. What fails, in order of time:",
    Judgement.UNDECIDED: "Undecided. Nothing is known to fail, but this is not decided:",
}


def report_tables(report: Report, *, margin: float, benches: int) -> list[Part]:
    """The verdict, the failures in order of time, and the measured values. margin: [m]; benches: of the dragon"""
    verdict = VERDICTS[report.verdict]
    facts = new_table(f"From {report.start:.3f} to {report.stop:.3f} s", "what", "value", "at", "who")
    for name, value, time, who in _measured(report, margin, benches):
        facts.add_row(name, value, "" if time is None else f"{time:.6f} s", who)
    origin = report.origin
    words = "x = y = 0 is longitude {:.6f}, latitude {:.6f}: the middle of the square."
    where = [words.format(origin.longitude, origin.latitude)] if origin else []
    return [Text(verdict, style="bold"), *(f"  {one.message}" for one in report.failures), "", facts, *where]


def _measured(report: Report, margin: float, benches: int) -> Iterator[tuple[str, str, float | None, str]]:
    """Rows of quantity, value, time and benches."""
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
        least_words = _distance(least) if least.distance >= 0.0 else _separation(least.distance, " m", SHOWN_DECIMALS)
        yield "least clearance", least_words, least.time, f"benches {_shown(least.benches)}"
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
            f"{plural('handle', speed.handles)} {_shown(speed.handles)}",
        )
    else:
        yield "highest speed", "grows without bound", report.stop, "towards the fold"
    if bend := report.sharpest_bend:
        yield "sharpest bend", f"{bend.angle:.6f} rad", bend.time, f"benches {_shown(bend.benches)}"


def plural(word: str, things: Sequence[Any]) -> str:
    return word if len(things) == 1 else f"{word}s"


def _distance(found: LeastClearance | Nearest) -> str:
    least = found.at_least
    proven = "not proven" if least is None else f"proven: at least {said_bound(least, SHOWN_DECIMALS, -1)} m"
    return f"{found.distance:.6f} m, {proven}"
