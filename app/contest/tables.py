"""The tables that the contest requires in a paper, as CSV, Markdown and LaTeX."""

from __future__ import annotations

import csv
import io
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np

import core
from app.contest.solved import Solved
from app.files.tables import XLSX_DECIMALS
from app.files.workbooks import rounded_away
from core import Dance
from core.language import say
from core.values import Floats

# Most columns of a LaTeX table in normal type; a table with more fits on the page with these commands.
COLUMNS_MOST, SMALLER = 4, "\\footnotesize\\setlength{\\tabcolsep}{3pt}"


@dataclass(frozen=True)
class KitTable:
    """A table of numbers with named rows and columns.

    name: of its files; caption: a sentence; corner: head of the column with the names of the rows
    columns, rows: their names; numbers: (R, C), in the units that the names give
    """

    name: str
    caption: str
    corner: str
    columns: Sequence[str]
    rows: Sequence[str]
    numbers: Floats

    def lines(self) -> list[list[str]]:
        """The line of heads, then a line for each row: its name and its numbers, in the contest's format."""
        rows = zip(self.rows, rounded_away(self.numbers, XLSX_DECIMALS).tolist(), strict=True)
        numbered = [[name, *(f"{value:.{XLSX_DECIMALS}f}" for value in row)] for name, row in rows]
        return [[self.corner, *self.columns], *numbered]

    def to_csv(self) -> str:
        sink = io.StringIO()
        csv.writer(sink, lineterminator="\n").writerows(self.lines())
        return sink.getvalue()

    def to_markdown(self) -> str:
        heads, *lines = self.lines()
        return in_markdown([heads, ["---", *["---:"] * len(self.columns)], *lines])

    def to_latex(self) -> str:
        """A table for the packages booktabs and, in Chinese, ctex. Negative numbers have a minus sign, not a hyphen."""
        heads, *lines = (
            " & ".join(f"$-${cell[1:]}" if cell.startswith("-") else cell for cell in line) for line in self.lines()
        )
        body = "".join(f"    {line} \\\\\n" for line in lines)
        return (
            f"\\begin{{table}}[htbp]\n  \\centering{SMALLER if len(self.columns) > COLUMNS_MOST else ''}\n"
            f"  \\caption{{{self.caption}}}\n  \\label{{tab:{self.name}}}\n"
            f"  \\begin{{tabular}}{{l{'r' * len(self.columns)}}}\n    \\toprule\n"
            f"    {heads} \\\\\n    \\midrule\n{body}"
            "    \\bottomrule\n  \\end{tabular}\n\\end{table}\n"
        )


def in_markdown(lines: Iterable[Sequence[str]]) -> str:
    """A table in Markdown. lines: its heads, the rule below them ("---" in each column), its rows"""
    return "".join(f"| {' | '.join(line)} |\n" for line in lines)


def paper_tables(solved: Solved, question: int | None = None) -> list[KitTable]:
    """Tables of questions 1 and 4 at the instants that the contest requires, and of question 2 at first contact.

    question: the only one, None for all
    """
    tables: list[KitTable] = []
    if question in (None, 1):
        tables += _over_time(solved, solved.spiral, solved.table_times, ("", say("Question 1")))
    if question in (None, 2):
        tables.append(_at_contact(solved))
    if question in (None, 4) and solved.turned:
        tables += _over_time(solved, solved.turned.dance, solved.turn_times, ("turn-", say("Question 4")))
    return tables


def _names(solved: Solved) -> list[str]:
    """The names of the handles in the tables."""
    names = solved.names
    return [names[k] for k in solved.handles]


def _over_time(solved: Solved, dance: Dance, times: Floats, begin: tuple[str, str]) -> list[KitTable]:
    """Tables of positions and of speeds at times [s]. begin: first part of their names, and of their captions"""
    prefix, question = begin
    motion = core.trajectory(dance, times)
    handles, place = _names(solved), say("{name} {axis} (m)")
    columns = [f"{time:g} s" for time in times.tolist()]
    axes = [place.format(name=handle, axis=axis) for handle in handles for axis in "xy"]
    places = motion.position[:, solved.handles].transpose(1, 2, 0).reshape(len(axes), times.size)
    speeds = [f"{handle} (m/s)" for handle in handles]
    corner, note = say("handle"), ""
    touch = solved.contact.time
    if dance is solved.spiral and touch is not None and touch < times[-1]:
        note = say(" (benches have touched at {touch:.6f} s)", touch=touch)
    of_places = say("{question}: positions{note}", question=question, note=note)
    of_speeds = say("{question}: speeds{note}", question=question, note=note)
    return [
        KitTable(f"{prefix}positions", of_places, corner, columns, axes, places),
        KitTable(f"{prefix}speeds", of_speeds, corner, columns, speeds, motion.speed[:, solved.handles].T),
    ]


def _at_contact(solved: Solved) -> KitTable:
    """The table of question 2: at first contact, or at the end of a run without one."""
    numbers = np.column_stack([solved.meeting.position[0], solved.meeting.speed[0]])[solved.handles]
    columns = say("x (m)|y (m)|speed (m/s)").split("|")
    touched = solved.contact.time is not None
    note = "" if touched else say(" (no contact, end of the run)")
    caption = say(
        "Question 2: positions and speeds at {solved.met_at:.6f} s{note}",
        solved=solved,
        note=note,
    )
    return KitTable("contact", caption, say("handle"), columns, _names(solved), numbers)
