"""The kit: all files of a folder, which changes only when all are ready.

One run writes at a time, first into a new folder inside the given one. When all files are ready, the report of an
earlier kit is removed, the new files take their places, other files of the earlier kit are removed, and the new report
comes last. So a folder with a report holds only files of the report's run.
"""

from __future__ import annotations

import io
import os
import shutil
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Self
from zipfile import ZIP_DEFLATED, ZIP_STORED, ZipFile, ZipInfo

import orjson

from app.contest import films
from app.contest.answers import Result, answers
from app.contest.report import report, report_pdf
from app.contest.solved import ContestRequest, Solved, solve
from app.contest.tables import paper_tables
from app.extras import MissingPackage, require
from app.files.disk import write_whole
from app.files.lock import FolderLock
from app.files.tables import XLSX_DECIMALS, instant_sheet, trajectory_sheets
from app.files.workbooks import Worksheet, workbook
from app.wire.question import Terms
from core import InvalidValue
from core.language import Listed, say

FIGURES, TABLES = "figures", "tables"
# What is handed in for each question: workbooks, tables, and figures.
PARTS = {
    1: ("result1.xlsx", "positions", "speeds", "snapshots"),
    2: ("result2.xlsx", "contact", "clearance"),
    3: ("staircase",),
    4: ("result4.xlsx", "turn-positions", "turn-speeds", "geometry"),
    5: ("amplification",),
}
# The workbook of a question, and the answer that it needs.
WORKBOOKS = {1: ("result1.xlsx", "inwards"), 2: ("result2.xlsx", "contact"), 4: ("result4.xlsx", "around")}
# Folder for files until all are ready, the file that comes last, and the name of the lock.
UNFINISHED, REPORT, ROLE = ".unfinished", "report.md", ".contest"
ON_PAPER = "report.pdf"
# Endings of files that an archive makes smaller.
TEXTS = (".csv", ".json", ".md", ".svg", ".tex")
# Files that a kit may hold or lack.
OPTIONAL = (
    "result4.xlsx",
    ON_PAPER,
    *(f"{name}{ending}" for name in films.FILMS for ending in (".mp4", ".gif")),
    *(f"{TABLES}/turn-{name}.{ending}" for name in ("positions", "speeds") for ending in ("csv", "md", "tex")),
    *(
        f"{FIGURES}/{name}.{ending}"
        for name in ("positions", "snapshots", "clearance", "staircase", "geometry", "amplification", "sensitivity")
        for ending in ("pdf", "svg", "png")
    ),
)


@dataclass
class Kit:
    """The written kit.

    solved, results: the answers; files: their names in order of writing
    question: the only one that the kit is about; None: all
    missing: reason why there are no pictures; no_turn: reason why questions 4 and 5 have no answer
    """

    solved: Solved
    results: list[Result]
    no_turn: str
    question: int | None = None
    files: list[str] = field(default_factory=list)
    missing: MissingPackage | None = None

    @classmethod
    def of(
        cls, request: ContestRequest, terms: Terms, progress: films.StepProgress, question: int | None = None
    ) -> Self:
        """A kit that has its answers. question: the only one that it is about, None for all; raises: as solve"""
        solved = solve(request, terms, lambda share: progress(say("answers"), share), question)
        return cls(solved, answers(solved, question), solved.why_no_turn, question)


def write_kit(
    folder: Path,
    request: ContestRequest,
    shot: films.Wanted,
    progress: films.StepProgress,
) -> Kit:
    """Write the kit; without matplotlib, or without a font for the language, it lacks figures and films.

    progress: called with the name of the current step, and its finished share
    raises: InvalidValue, also while another run writes into the folder; OutsideRun, TooMuchWork, OSError
    """
    lock = FolderLock(folder, ROLE)
    if not lock.take():
        words = "another run writes into {folder}: wait until it is done, or give another FOLDER"
        raise InvalidValue.in_words("folder", words, folder=str(folder))
    unfinished = folder / UNFINISHED
    try:
        kit = Kit.of(request, Terms(), progress)
        shutil.rmtree(unfinished, ignore_errors=True)
        for name, data in files_of(kit, shot, progress):
            (unfinished / name).parent.mkdir(parents=True, exist_ok=True)
            write_whole(unfinished / name, data)
            kit.files.append(name)
        _take_over(folder, kit.files)
    finally:
        try:
            shutil.rmtree(unfinished, ignore_errors=True)
        finally:
            lock.give_back()
    return kit


def _take_over(folder: Path, names: list[str]) -> None:
    """Put finished files into their places, and remove those of an earlier kit. names: the report is last"""
    (folder / REPORT).unlink(missing_ok=True)
    for name in {*OPTIONAL} - {*names}:
        (folder / name).unlink(missing_ok=True)
    for name in names:
        (folder / name).parent.mkdir(exist_ok=True)
        os.replace(folder / UNFINISHED / name, folder / name)


def files_of(kit: Kit, shot: films.Wanted, progress: films.StepProgress) -> Iterator[films.NamedFile]:
    """Name and bytes of each file as it is made, the report last. kit: receives the reason why there are no pictures"""
    solved, parts = kit.solved, PARTS.get(kit.question or 0)
    tables = [table for table in paper_tables(solved, kit.question) if parts is None or table.name in parts]
    for name, sheets in _workbooks(solved).items():
        if parts is None or name in parts:
            yield name, workbook(sheets(), XLSX_DECIMALS)
    yield "answers.json", orjson.dumps(kit.results, option=orjson.OPT_INDENT_2) + b"\n"
    for table in tables:
        for ending, text in (("csv", table.to_csv()), ("md", table.to_markdown()), ("tex", table.to_latex())):
            yield f"{TABLES}/{table.name}.{ending}", text.encode("utf-8-sig" if ending == "csv" else "utf-8")
    drawn, filmed = [], []
    try:
        require("figures", "folder", "a figure")
        from app.contest.figures import figures

        with films.films_beside(solved, shot, progress) as wait_for_films:
            for figure in figures(solved, lambda share: progress(say("figures"), share), parts):
                drawn.append(figure)
                for ending, data in figure.files.items():
                    yield f"{FIGURES}/{figure.name}.{ending}", data
            for name, data in wait_for_films():
                filmed.append(name)
                yield name, data
    except MissingPackage as missing:
        kit.missing = missing
    if parts is not None:
        return
    page = report(solved, kit.results, tables, drawn, filmed)
    try:
        require("paper", "folder", ON_PAPER)
        yield ON_PAPER, report_pdf(solved, kit.results, tables, drawn, solved.budget)
    except MissingPackage as missing:
        page += "\n" + say("Not in this kit: report.pdf, because ") + missing.message + "\n"
    if kit.missing:
        page += "\n" + say("Not in this kit: figures and films, because ") + kit.missing.message + "\n"
    yield REPORT, page.encode()


def zip_of(
    request: ContestRequest,
    shot: films.Wanted,
    terms: Terms,
    progress: films.StepProgress,
    question: int | None = None,
) -> bytes:
    """The kit as a ZIP archive with the same bytes for the same request.

    question: the only one that it is about, None for all; raises: as write_kit, but for the folder
    """
    require("xlsx", "language", "contest")
    sink = io.BytesIO()
    kit = Kit.of(request, terms, progress, question)
    with ZipFile(sink, "w") as archive:
        for name, data in files_of(kit, shot, progress):
            # Without a time of its own, which is then the first that an archive can have.
            archive.writestr(ZipInfo(name), data, ZIP_DEFLATED if name.endswith(TEXTS) else ZIP_STORED)
    return sink.getvalue()


def workbook_alone(request: ContestRequest, terms: Terms, question: int | None) -> bytes:
    """The workbook of a question, without the rest of the kit. raises: as zip_of; InvalidValue without a workbook"""
    require("xlsx", "language", "contest")
    if question not in WORKBOOKS:
        raise InvalidValue(
            "question", "must be {numbers} for a workbook alone", got=question, numbers=Listed(WORKBOOKS)
        )
    name, needed = WORKBOOKS[question]
    solved = solve(request, terms, terms.progress, question, (needed,))
    return workbook(_workbooks(solved)[name](), XLSX_DECIMALS)


def _workbooks(solved: Solved) -> dict[str, Callable[[], list[Worksheet]]]:
    """What makes the sheets of each workbook, by its name."""
    books: dict[str, Callable[[], list[Worksheet]]] = {
        "result1.xlsx": lambda: trajectory_sheets(solved.inwards),
        "result2.xlsx": lambda: [instant_sheet(solved.meeting)],
    }
    if turned := solved.turned:
        books["result4.xlsx"] = lambda: trajectory_sheets(turned.around)
    return books
