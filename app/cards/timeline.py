"""A crew on paper: a timeline with a row for each person, and the changes in order of time, on sheets of A4.

The same crew gives the same bytes on the same versions of the libraries, because the file holds no date.
"""

from __future__ import annotations

import io
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any

import matplotlib
import numpy as np
from matplotlib.backends.backend_pdf import PdfPages

from app.cards.crew import CrewWords
from app.files.drawing import in_turn
from app.maps.marks import mark_name
from app.plan.paper import MARGIN, PAPERS, Paper, Title
from app.plan.sheet import Sheet, title_block
from app.plan.tables import PlanTable, draw_tables
from core import Budget
from core.language import say
from core.people.crew import Spell

# Fonts as outlines of TrueType, so that every machine and every printer draws them alike.
FONTS: dict[Any, Any] = {"pdf.fonttype": 42}
# Height of a row and of the axis above the rows [mm], and type [pt].
ROW, AXIS, TYPE = 4.0, 9.0, 7.0
# Width of the column of labels, and of each of the three columns of numbers at the right [mm].
LABEL, NUMBER = 14.0, 17.0
# Steps from one time to the next on the axis [s], and the least distance of two on paper [mm].
TICKS = (1, 2, 5, 10, 15, 30, 60, 120, 300, 600, 900, 1800, 3600, 7200, 21_600, 86_400)
TICK_LEAST = 18.0
# Faces of the bars, in turn for benches one behind the other.
FACES = ("#CFE3F1", "#F7E3C6", "#D9EBD3")
# Least length of a bar that holds the number of its bench, beside that number [mm].
AROUND = 1.0


@dataclass(frozen=True, slots=True)
class CrewSheets:
    """The content of a file. title: of the dance; family: fonts; facts: lines of the title block;
    roll: a further table, or None"""

    crew: CrewWords
    title: str
    facts: list[str]
    family: tuple[str, ...]
    budget: Budget
    roll: PlanTable | None = None


def crew_pdf(sheets: CrewSheets, progress: Callable[[float], None] = lambda share: None) -> bytes:
    """The bytes of the file. raises: Halted once the budget is stopped"""
    sink = io.BytesIO()
    block = Title(sheets.title, sheets.facts, "", True, False)

    def drawn() -> bytes:
        with matplotlib.rc_context({"font.family": sheets.family, **FONTS}):
            pages = [*_timelines(sheets), *_tables(sheets)]
            metadata = {"Title": sheets.title, "Creator": "Bench Dragon", "CreationDate": None}
            with PdfPages(sink, metadata=metadata) as file:
                for k, (subtitle, sheet) in enumerate(pages, start=1):
                    left, right = title_block(sheet, block, subtitle, f"{k}/{len(pages)}")
                    _notes(sheet, say("carriers"), left, right)
                    file.savefig(sheet.figure)
                    progress(k / len(pages))
        return sink.getvalue()

    return in_turn(drawn, sheets.budget)


def _new_sheet(sheets: CrewSheets) -> Sheet:
    short, long = PAPERS["A4"]
    return Sheet(Paper("A4", long, short), sheets.family, sheets.budget)


def _notes(sheet: Sheet, people: str, left: float, right: float) -> None:
    """Write the meaning of the labels in the title block."""
    lines = [
        say("17.2: the second of the {people} of bench 17 at the start", people=people),
        say("S3: the third spare, who comes in at a change"),
        say("in a bar: the bench that is carried then"),
        say("way: of the front handle along the path"),
    ]
    for k, line in enumerate(lines):
        sheet.words(left + 2.0, MARGIN + 25.0 - 4.6 * k, line, 6.5, within=right - left - 4.0)


def _timelines(sheets: CrewSheets) -> Iterator[tuple[str, Sheet]]:
    """Sheets with a row for each person."""
    crew = sheets.crew.crew
    _, bottom, _, top = _new_sheet(sheets).paper.room
    rows, own = int((top - bottom - AXIS - 4.0) / ROW), dict[int, list[Spell]]()
    for one in crew.spells:
        own.setdefault(one.person, []).append(one)
    carried = crew.carried
    for first in range(0, crew.people, rows):
        sheet = _new_sheet(sheets)
        left, right = _draw_axis(sheet, sheets)
        for row, person in enumerate(range(first, min(first + rows, crew.people))):
            y, all_of = top - AXIS - ROW * (row + 1), carried[person]
            sheet.entry(MARGIN + 3.0, y + 1.2, sheets.crew.labels[person], TYPE)
            for one in own.get(person, ()):
                _draw_bar(sheet, sheets, one, (left, right), y)
            numbers = (_minutes(all_of.time), f"{all_of.way:.0f}", _minutes(all_of.longest))
            for k, words in enumerate(numbers, start=1):
                sheet.entry(right + NUMBER * k - sheet.width(words, TYPE), y + 1.2, words, TYPE)
        sheet.frame(sheet.paper.room)
        yield say("Who carries which bench when"), sheet


def _minutes(time: float) -> str:
    """A duration [s] in minutes and whole seconds."""
    minutes, seconds = divmod(round(time), 60)
    return f"{minutes}:{seconds:02d}"


def _draw_axis(sheet: Sheet, sheets: CrewSheets) -> tuple[float, float]:
    """Draw times above the rows and name the columns; returns where the bars begin and end [mm]."""
    crew = sheets.crew
    start, stop = crew.crew.start, crew.crew.stop
    room_left, bottom, room_right, top = sheet.paper.room
    left, right = room_left + LABEL, room_right - 3 * NUMBER - 3.0
    unit = (right - left) / (stop - start)
    step = next((one for one in TICKS if one * unit >= TICK_LEAST), TICKS[-1])
    for k in range(int((stop - start) / step) + 1):
        x = left + step * k * unit
        sheet.line([(x, bottom), (x, top - AXIS)], linewidth=0.25, color="#AAAAAA", zorder=0)
        words = crew.words.clock.clock(start + step * k)
        if x + sheet.width(words, 6.0) < right:
            sheet.entry(x, top - AXIS + 1.5, words, 6.0)
    for k, words in enumerate((say("time"), say("way [m]"), say("longest")), start=1):
        sheet.entry(right + NUMBER * k - sheet.width(words, 6.5, bold=True), top - AXIS + 1.5, words, 6.5, bold=True)
    return left, right


def _draw_bar(sheet: Sheet, sheets: CrewSheets, one: Spell, ends: tuple[float, float], y: float) -> None:
    """Draw a spell. ends: where the bars begin and end [mm]; y: below the row [mm]"""
    crew = sheets.crew.crew
    unit = (ends[1] - ends[0]) / (crew.stop - crew.start)
    left, right = (ends[0] + unit * (time - crew.start) for time in (one.begin, one.end))
    corners = [(left, y + 0.4), (right, y + 0.4), (right, y + ROW - 0.4), (left, y + ROW - 0.4)]
    sheet.shape(np.array(corners), facecolor=FACES[one.bench % 3], edgecolor="#555555", linewidth=0.3, zorder=2)
    words = str(one.bench)
    if sheet.width(words, TYPE) + AROUND < right - left:
        sheet.entry(0.5 * (left + right - sheet.width(words, TYPE)), y + 1.2, words, TYPE)


def _tables(sheets: CrewSheets) -> Iterator[tuple[str, Sheet]]:
    """Sheets with who is where at a time, and with the changes."""
    crew = sheets.crew
    chalk = crew.words.chalk
    rows = []
    for one in crew.changes:
        mark, _ = chalk.nearest(one.s)
        out = crew.labels[one.relieved or 0]
        rows.append([crew.words.clock.words(one.begin), str(one.bench), out, crew.labels[one.person], mark_name(mark)])
    columns = [
        say("time"),
        say("bench"),
        say("goes out"),
        say("comes in"),
        say("near mark"),
    ]
    tables = [PlanTable(say("Changes"), columns, rows)]
    tables = [sheets.roll, *tables] if sheets.roll else tables
    if not any(table.rows for table in tables):
        return
    for sheet in draw_tables(tables, lambda: _new_sheet(sheets)):
        sheet.frame(sheet.paper.room)
        yield say("Who comes in where"), sheet
