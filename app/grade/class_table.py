"""A class on one table: points of every file and team by a rubric, and files that two teams handed in alike.

Input: one row for each file, and the rubric as a teacher writes it. Output: the points, and remarks. State: none.

A remark that two teams handed in the same file rests on its bytes alone: a workbook that was saved twice differs in its
bytes, so that equal ones are copies, or were written by a program that writes the same for everyone, as this one does.
A blank form is no remark: it holds nothing that anybody worked on.
"""

from __future__ import annotations

import csv
import io
from collections import defaultdict
from collections.abc import Sequence
from dataclasses import dataclass

from app.grade.judged import Rating
from app.grade.words import word
from core import InvalidValue
from core.language import Listed
from core.quantities import Given

# What a rubric may state: the points of each workbook, and the share of them for right numbers with fewer decimals [1].
WORKBOOKS, ROUNDED = ("result1", "result2", "result4"), "rounded"
DEFAULT = {"result1": 40.0, "result2": 20.0, "result4": 40.0, ROUNDED: 0.9}
# Most points of a workbook, and decimals of points.
POINTS_MAX, DECIMALS = 1000.0, 1


@dataclass(frozen=True)
class Row:
    """A graded file. team, file: names; workbook: result1, result2, result4 or None; digest: of its bytes

    cells, right, rounded, missing: numbers of its cells that the contest requires, that are right, that are right to
        fewer decimals, and that are missing
    """

    team: str
    file: str
    workbook: str | None
    verdict: Rating
    cells: int
    right: int
    missing: int
    digest: str = ""
    rounded: int = 0


def rubric_of(text: str) -> dict[str, float]:
    """The points by what they are for, from a CSV with lines such as `result1,40`; empty: the usual ones.

    raises: InvalidValue naming the line
    """
    rubric = dict(DEFAULT)
    for k, line in enumerate(csv.reader(io.StringIO(text.lstrip("\ufeff"))), start=1):
        name = line[0].strip() if line else ""
        if not name or (k == 1 and name not in DEFAULT):  # the heads
            continue
        if name not in DEFAULT:
            words = "line {line} of the rubric must begin with one of {names}"
            raise InvalidValue.in_words("rubric", words, got=Given(name), line=k, names=str(Listed(DEFAULT)))
        most = 1.0 if name == ROUNDED else POINTS_MAX
        try:
            value = float(line[1])
        except (IndexError, ValueError):
            value = -1.0
        if not 0.0 <= value <= most:
            words = "line {line} of the rubric must have a number from 0 to {most} behind {name}"
            got = Given(line[1] if len(line) > 1 else "")
            raise InvalidValue.in_words("rubric", words, got=got, line=k, most=f"{most:g}", name=name)
        rubric[name] = value
    return rubric


def rubric_text(rubric: dict[str, float]) -> str:
    """The file that a teacher edits, as CSV."""
    lines = [f"{name},{value:g}" for name, value in rubric.items()]
    return "\n".join([",".join([word("rubric_what"), word("rubric_points")]), *lines]) + "\n"


def points_of(row: Row, rubric: dict[str, float]) -> float:
    """Points of a file: a cell that is right has an equal part of them, one that is rounded a share of that part."""
    if row.workbook not in WORKBOOKS or not row.cells:
        return 0.0
    return round(rubric[row.workbook] * (row.right + rubric[ROUNDED] * row.rounded) / row.cells, DECIMALS)


def team_points(rows: Sequence[Row], rubric: dict[str, float]) -> list[tuple[str, float]]:
    """Points of each team, the most first: of several files for one workbook the best counts."""
    best: dict[str, dict[str | None, float]] = defaultdict(dict)
    for row in rows:
        of_team = best[row.team]
        of_team[row.workbook] = max(of_team.get(row.workbook, 0.0), points_of(row, rubric))
    points = {team: round(sum(of_team.values()), DECIMALS) for team, of_team in best.items()}
    return sorted(points.items(), key=lambda one: (-one[1], one[0]))


def alike(rows: Sequence[Row]) -> list[str]:
    """A remark on each file that several teams handed in byte for byte, but for blank forms."""
    groups: dict[str, list[Row]] = defaultdict(list)
    for row in rows:
        if row.digest and row.missing < row.cells:
            groups[row.digest].append(row)
    together = [group for group in groups.values() if len({row.team for row in group}) > 1]
    return [word("alike", files=str(Listed(f"{row.team}/{row.file}" for row in group))) for group in together]
