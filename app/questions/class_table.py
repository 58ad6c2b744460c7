"""The question class_table: the graded files of a class on one table, with points by a teacher's rubric."""

from __future__ import annotations

import csv
import io
from typing import Annotated

from pydantic import Field

from app.files.tables import CSV_TYPE, XLSX_TYPE
from app.files.workbooks import table_workbook
from app.grade.class_table import (
    TYPED,
    ClassRow,
    most_of,
    names_beside,
    points_of,
    remarks,
    rubric_of,
    rubric_text,
    scheme,
    team_most,
    team_points,
)
from app.grade.judged import Rating
from app.grade.words import word
from app.wire.fields import Answer, OneLine, Whole, Wire
from app.wire.question import JSON, Question, Terms
from app.wire.texts import text_to_cell
from core.language import joined

# Most files of a class, cells of one, unusual numbers of one, and characters of a rubric.
FILES_MAX, CELLS_MAX, UNUSUAL_MAX, RUBRIC_MAX = 2_000, 1_000_000, 40, 10_000


class GradedFile(Wire, strict=True):
    """A file that POST /grade has graded."""

    team: OneLine = Field(max_length=200, description="Who handed it in")
    file: OneLine = Field(max_length=200, description="Its name")
    workbook: OneLine | None = Field(
        None,
        max_length=20,
        description="result1, result2 or result4; question3 or question5 for a number; null if unknown",
    )
    verdict: Rating = Field(description="Its verdict", strict=False)
    cells: Whole = Field(0, ge=0, le=CELLS_MAX, description="Number of cells that the contest requires")
    right: Whole = Field(0, ge=0, le=CELLS_MAX, description="Number of those that are right")
    rounded: Whole | None = Field(
        None,
        ge=0,
        le=CELLS_MAX,
        description="Number of those that are not right, but to their decimals; null: all others, if the verdict is so",
    )
    missing: Whole = Field(0, ge=0, le=CELLS_MAX, description="Number of those that are missing")
    finding: str = Field("", max_length=1_000, description="The error behind wrong cells, in words")
    digest: OneLine = Field("", max_length=128, description="Digest of its bytes, such as SHA-256; empty: not compared")
    unusual: list[Annotated[OneLine, Field(max_length=100)]] = Field(
        [],
        max_length=UNUSUAL_MAX,
        description="Its numbers that are compared with those of others, as /grade gives them",
    )

    def to_row(self) -> ClassRow:
        rounded = self.rounded
        if rounded is None:
            rounded = self.cells - self.right - self.missing if self.verdict is Rating.ROUNDED else 0
        counts = {"cells": self.cells, "right": self.right, "rounded": rounded, "missing": self.missing}
        return ClassRow(
            self.team, self.file, self.workbook, self.verdict, **counts, digest=self.digest, unusual=tuple(self.unusual)
        )


class ClassTableRequest(Wire, strict=True):
    """The graded files of a class."""

    files: list[GradedFile] = Field(max_length=FILES_MAX, description="The files, in the order of the table")
    rubric: str = Field(
        "",
        max_length=RUBRIC_MAX,
        description="Points as CSV: lines such as `result1,40`, and `rounded,0.9`, the share of the points for right "
        "numbers with fewer decimals; empty: the usual ones",
    )


class ClassTable(Answer):
    """A class on one table.

    heads: heads of the columns: team, file, workbook, verdict, cells, right, points, finding, rounded, missing, points
        of the team, files that are alike, most points of the file, most points of the team
    rows: a row for each file, in its order
    teams: each team and its points, the most first [points]
    notes: remarks, such as that two teams handed in the same file
    rubric: the rubric as a file that a teacher may edit, as CSV
    scheme: the rubric in words
    """

    heads: list[str]
    rows: list[list[str | int | float]]
    teams: list[list[str | float]]
    notes: list[str]
    rubric: str
    scheme: str = Field(default="")


COLUMNS = (
    *("team", "file", "workbook", "verdict", "cells", "right", "points", "finding"),
    *("rounded", "missing", "team_points", "alike", "points_most", "team_most"),
)


def class_table(request: ClassTableRequest, terms: Terms, form: str) -> ClassTable | bytes:
    """The graded files of a class on one table, with points of every file and team, as JSON, CSV or a workbook."""
    rubric, rows = rubric_of(request.rubric), [one.to_row() for one in request.files]
    heads = [word(f"class_{name}") for name in COLUMNS]
    teams, notes, most = dict(team_points(rows, rubric)), remarks(rows), team_most(rows, rubric)
    beside = names_beside(rows, [group for group, _ in notes])
    table: list[list[str | int | float]] = [
        [
            row.team,
            row.file,
            row.workbook or "",
            word("class_rounded" if row.verdict is Rating.ROUNDED else row.verdict.value),
            row.cells,
            row.right,
            points_of(row, rubric),
            file.finding,
            row.rounded,
            row.missing,
            teams[row.team],
            names,
            most_of(row, rubric),
            most,
        ]
        for row, file, names in zip(rows, request.files, beside, strict=True)
    ]
    if form == JSON:
        every: list[list[str | float]] = [[team, points] for team, points in teams.items()]
        said = [words for _, words in notes]
        typed = {row.workbook for row in rows}.issuperset(TYPED)
        words = scheme(rubric) if typed else joined([scheme(rubric), word("scheme_typed")])
        return ClassTable(heads=heads, rows=table, teams=every, notes=said, rubric=rubric_text(rubric), scheme=words)
    if form == XLSX_TYPE:
        return table_workbook(word("class_sheet"), heads, table)
    cells = [[text_to_cell(cell) if isinstance(cell, str) else cell for cell in row] for row in table]
    sink = io.StringIO()
    csv.writer(sink, lineterminator="\n").writerows([heads, *cells])
    return sink.getvalue().encode("utf-8-sig")


QUESTION = Question(
    class_table, ClassTable, body=ClassTableRequest, forms=(JSON, CSV_TYPE, XLSX_TYPE), cost=lambda request, form: 0.01
)
