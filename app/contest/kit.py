"""The kit: all files of a folder, each written when it is ready."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from pathlib import Path

import orjson

from app.contest import films
from app.contest.answers import Given, answers
from app.contest.report import report
from app.contest.solved import ContestRequest, Solved, solve
from app.contest.tables import paper_tables
from app.contest.words import Say
from app.extras import MissingPackage, require
from app.files.disk import write_whole
from app.files.tables import XLSX_DECIMALS, Language, instant_sheet, trajectory_sheets
from app.files.workbooks import workbook
from app.questions.question import Terms

FIGURES, TABLES = "figures", "tables"


@dataclass
class Kit:
    """What was written: names of files in this order; given: the answers; missing: why there are no pictures"""

    files: list[str] = field(default_factory=list)
    given: list[Given] = field(default_factory=list)
    missing: MissingPackage | None = None


def write_kit(
    folder: Path,
    asked: ContestRequest,
    language: Language,
    shot: films.Wanted,
    progress: Callable[[str, float], None],
) -> Kit:
    """Write everything. Without a font for the language, or without matplotlib, all but figures and films.

    progress: called with what is being done, and the share of it that is done
    raises: InvalidValue, OutsideRun, TooMuchWork, OSError
    """
    say, kit = Say(language), Kit()
    solved = solve(asked, Terms(), lambda share: progress(say("answers", "求解"), share))
    kit.given = answers(solved, say)
    tables = paper_tables(solved, say)

    def write(name: str, data: bytes) -> None:
        write_whole(folder / name, data)
        kit.files.append(name)

    for part in (TABLES, FIGURES):
        (folder / part).mkdir(parents=True, exist_ok=True)
    for name, data in _workbooks(solved, language):
        write(name, data)
    write("answers.json", orjson.dumps([one.to_json() for one in kit.given], option=orjson.OPT_INDENT_2) + b"\n")
    for table in tables:
        for ending, text in (("csv", table.to_csv()), ("md", table.to_markdown()), ("tex", table.to_latex())):
            write(f"{TABLES}/{table.name}.{ending}", text.encode())
    drawn, filmed = [], []
    try:
        require("figures", "folder", "a figure")
        from app.contest.figures import figures

        for figure in figures(solved, say, lambda share: progress(say("figures", "绘图"), share)):
            drawn.append(figure)
            for ending, data in figure.files.items():
                write(f"{FIGURES}/{figure.name}.{ending}", data)
        for name, data in films.films(solved, say, shot, progress):
            filmed.append(name)
            write(name, data)
    except MissingPackage as missing:
        kit.missing = missing
    write("report.md", report(solved, kit.given, tables, drawn, filmed, say).encode())
    return kit


def _workbooks(solved: Solved, language: Language) -> Iterator[tuple[str, bytes]]:
    for name, sheets in (
        ("result1.xlsx", trajectory_sheets(solved.inwards, language)),
        ("result2.xlsx", [instant_sheet(solved.meeting, language)]),
        ("result4.xlsx", trajectory_sheets(solved.around, language)),
    ):
        yield name, workbook(sheets, XLSX_DECIMALS)
