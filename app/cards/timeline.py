"""A crew on paper: a timeline with a row for each person, and the changes in order of time, on sheets of paper.

The same crew gives the same bytes on the same fonts and versions of the libraries, because the file holds no date.
"""

from __future__ import annotations

from dataclasses import dataclass
from importlib.resources import files

from app.cards.crew import CrewWords
from app.files.typeset import Face, typeset
from app.maps.marks import mark_name
from app.plan.paper import MARGIN, PAPERS, Paper, PaperName, Title
from app.plan.tables import PAD, Json, PlanTable, tables_sheet
from core import Budget
from core.language import say
from core.people.crew import Spell
from core.values import Progress

# Width of the column of labels, and of each of the three columns of numbers at the right [mm].
LABEL, NUMBER = 11.0, 17.0
# Steps from one time to the next on the axis [s], and the least distance of two on paper [mm].
TICKS = (1, 2, 5, 10, 15, 30, 60, 120, 300, 600, 900, 1800, 3600, 7200, 21_600, 86_400)
TICK_LEAST = 18.0


@dataclass(frozen=True, slots=True)
class CrewSheets:
    """The content of a file. title: of the dance; facts: lines of the title block; roll: a further table, or None"""

    crew: CrewWords
    title: str
    facts: list[str]
    face: Face
    budget: Budget
    size: PaperName = "A4"
    roll: PlanTable | None = None


def crew_pdf(sheets: CrewSheets, progress: Progress) -> bytes:
    """The bytes of the file. raises: Halted once the budget is stopped"""
    short, long = PAPERS[sheets.size]
    paper, title = Paper(long, short), Title(sheets.title, sheets.facts, "", True, False)
    people = say("carriers")
    notes = [
        say("17.2: the second of the {people} of bench 17 at the start", people=people),
        say("S3: the third spare, who comes in at a change"),
        say("in a bar: the bench that is carried then"),
        say("way: of the front handle along the path"),
    ]
    content = [{**title.sheet(say("Who carries which bench when"), paper), **_timeline(sheets, paper), "notes": notes}]
    tables = [table for table in (sheets.roll, _changes(sheets.crew)) if table and table.rows]
    if tables:
        content.append(tables_sheet(sheets.face, title.sheet(say("Who comes in where"), paper), tables, notes))
    progress(0.5)
    data = {"title": sheets.title, "paper": sheets.size, "sheet": say("sheet"), "sheets": content}
    template = files("app.cards").joinpath("crew.typ").read_bytes()
    content_of_file = typeset(template, sheets.face, data, sheets.budget)
    progress(1.0)
    return content_of_file


def _timeline(sheets: CrewSheets, paper: Paper) -> Json:
    """A row for each person, the times above the rows, and the widths of the columns [mm]."""
    crew = sheets.crew.crew
    wide = paper.width - 2.0 * (MARGIN + PAD) - LABEL - 3.0 * NUMBER
    unit, spells = wide / (crew.stop - crew.start), dict[int, list[Spell]]()
    for one in crew.spells:
        spells.setdefault(one.person, []).append(one)
    rows = list[list[object]]()
    for person, (label, carried) in enumerate(zip(sheets.crew.labels, crew.carried, strict=True)):
        sheets.budget.look()
        bars = [
            (unit * (one.begin - crew.start), unit * (one.end - one.begin), one.bench) for one in spells.get(person, [])
        ]
        rows.append([label, bars, _minutes(carried.time), f"{carried.way:.0f}", _minutes(carried.longest)])
    step = next((one for one in TICKS if one * unit >= TICK_LEAST), TICKS[-1])
    times, clock = range(0, int(crew.stop - crew.start) + 1, step), sheets.crew.words.clock.clock
    ticks = [(unit * time, clock(crew.start + time)) for time in times]
    columns = [say("time"), say("way [m]"), say("longest")]
    return {"rows": rows, "ticks": ticks, "columns": columns, "labels": LABEL, "bars": wide, "number": NUMBER}


def _minutes(time: float) -> str:
    """A duration [s] in minutes and whole seconds."""
    minutes, seconds = divmod(round(time), 60)
    return f"{minutes}:{seconds:02d}"


def _changes(crew: CrewWords) -> PlanTable:
    """Who comes in for whom, in order of time."""
    clock, labels = crew.words.clock.words, crew.labels
    rows = [
        [
            clock(one.begin), str(one.bench), labels[one.relieved or 0], labels[one.person],
            mark_name(crew.words.chalk.nearest(one.s)[0]),
        ]
        for one in crew.changes
    ]  # fmt: skip
    columns = [say("time"), say("bench"), say("goes out"), say("comes in"), say("near mark")]
    return PlanTable(say("Changes"), columns, rows)
