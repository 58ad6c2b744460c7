"""A class on one table: points of every file and team by a rubric, and files that two teams handed in alike.

Input: one row for each file, and the rubric as a teacher writes it. Output: the points, and remarks. State: none.

Equal bytes are pointed out: a workbook that was saved twice differs in its bytes, so that equal ones are copies, or
were written by a program that writes the same for everyone, as this one does. A blank form is no remark, for it holds
nothing that anybody worked on, nor are right numbers in plain text, which are the same for all. Files of different
bytes are compared by their wrong numbers, the same cells of each: right ones are the same for all, wrong ones rarely.
"""

from __future__ import annotations

import csv
import io
from collections import Counter, defaultdict
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass
from itertools import combinations, pairwise

import numpy as np

from app.grade.judged import Rating
from app.grade.unusual import DECIMALS_LEAST
from app.grade.words import word
from core import InvalidValue
from core.language import Listed, say
from core.quantities import Given

# What a rubric may state: the points of each question, those of a typed number among them, and the share of them for
# right numbers with fewer decimals [1].
TYPED, ROUNDED = ("question3", "question5"), "rounded"
DEFAULT = {"result1": 40.0, "result2": 20.0, "question3": 10.0, "result4": 40.0, "question5": 10.0, ROUNDED: 0.9}
# Most points of a workbook, and decimals of points.
POINTS_MAX, DECIMALS = 1000.0, 1
# Fewest wrong numbers that two files share, and least share of those compared, so that it is pointed out.
SHARED_LEAST, SHARED_SHARE = 3, 0.5
# Most files with one number of which all are compared with each other.
MANY = 8
# Most files that a remark names.
NAMED = 10


@dataclass(frozen=True)
class ClassRow:
    """A graded file. team, file: names; workbook: a name of DEFAULT or None; digest: of its bytes

    cells, right, rounded, missing: numbers of its cells that the contest requires, that are right, that are right to
        fewer decimals, and that are missing
    unusual: some of its wrong numbers, as FileAnswer has them
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
    unusual: tuple[str, ...] = ()


def rubric_of(text: str) -> dict[str, float]:
    """The points by what they are for, from a CSV with lines such as `result1,40`; empty: the usual ones.

    Cells may be divided by semicolons or tabs too, and decimals by a comma then, as in tables of other languages.
    raises: InvalidValue naming the line
    """
    rubric, is_known = dict(DEFAULT), not text.strip()
    divider = next((one for one in (";", "\t") if one in text), ",")
    lines: list[list[str]] = []
    with suppress(csv.Error):  # of a cell that no rubric has
        lines = list(csv.reader(io.StringIO(text.lstrip("\ufeff")), delimiter=divider))
    for k, line in enumerate(lines, start=1):
        name = line[0].strip() if line else ""
        if not name or (k == 1 and name not in DEFAULT):  # the heads
            continue
        if name not in DEFAULT:
            words = "line {line} of the rubric must begin with one of {names}"
            raise InvalidValue.in_words("rubric", words, got=Given(name), line=k, names=str(Listed(DEFAULT)))
        most = 1.0 if name == ROUNDED else POINTS_MAX
        try:
            value = float(line[1].replace(",", "."))
        except (IndexError, ValueError):
            value = -1.0
        if not 0.0 <= value <= most:
            words = "line {line} of the rubric must have a number from 0 to {most} behind {name}"
            got = Given(line[1] if len(line) > 1 else "")
            raise InvalidValue.in_words("rubric", words, got=got, line=k, most=f"{most:g}", name=name)
        rubric[name], is_known = value, True
    if not is_known:
        words = "the rubric must be a CSV file with lines such as {line}"
        raise InvalidValue.in_words("rubric", words, got=Given(text), line="result1,40")
    return rubric


def rubric_text(rubric: dict[str, float]) -> str:
    """The file that a teacher edits, as CSV."""
    lines = [f"{name},{value:g}" for name, value in rubric.items()]
    return "\n".join([",".join([word("rubric_what"), word("rubric_points")]), *lines]) + "\n"


def points_of(row: ClassRow, rubric: dict[str, float]) -> float:
    """Points of a file: a cell that is right has an equal part of them, one that is rounded a share of that part."""
    if not row.cells:
        return 0.0
    return round(most_of(row, rubric) * (row.right + rubric[ROUNDED] * row.rounded) / row.cells, DECIMALS)


def most_of(row: ClassRow, rubric: dict[str, float]) -> float:
    """Points of a file whose numbers are all right."""
    return 0.0 if row.workbook is None or row.workbook == ROUNDED else rubric.get(row.workbook, 0.0)


def team_most(rows: Sequence[ClassRow], rubric: dict[str, float]) -> float:
    """Points of a team whose numbers are all right. A question without a workbook counts once a number is typed."""
    named = {row.workbook for row in rows}
    return sum(value for name, value in rubric.items() if name != ROUNDED and (name not in TYPED or name in named))


def scheme(rubric: dict[str, float]) -> str:
    """The rubric in words."""
    points = str(Listed(f"{name} {value:g}" for name, value in rubric.items() if name != ROUNDED))
    return word("scheme", points=points, share=f"{rubric[ROUNDED]:g}")


def team_points(rows: Sequence[ClassRow], rubric: dict[str, float]) -> list[tuple[str, float]]:
    """Points of each team, the most first: of several files for one workbook the best counts."""
    best: dict[str, dict[str | None, float]] = defaultdict(dict)
    for row in rows:
        of_team = best[row.team]
        of_team[row.workbook] = max(of_team.get(row.workbook, 0.0), points_of(row, rubric))
    points = {team: round(sum(of_team.values()), DECIMALS) for team, of_team in best.items()}
    return sorted(points.items(), key=lambda one: (-one[1], one[0]))


def remarks(rows: Sequence[ClassRow]) -> list[tuple[list[ClassRow], str]]:
    """Files of several teams that are alike, each group with its remark: of equal bytes, then of wrong numbers."""
    same = defaultdict(list)
    for row in rows:
        if row.digest and row.missing < row.cells and not _is_plain(row):
            same[row.digest].append(row)
    groups = [group for group in same.values() if _teams(group) > 1]
    found = [(group, word("alike", files=names_of(group))) for group in groups]
    whole = {frozenset(map(id, group)) for group in groups}
    for group, shared in _sharing(rows):
        if frozenset(map(id, group)) not in whole:
            count, most = len(shared), min(len(row.unusual) for row in group)
            values = {"files": names_of(group), "count": count, "most": most, "number": min(shared)}
            found.append((group, word("same_wrong", **values)))
    return found


def alike(rows: Sequence[ClassRow]) -> list[str]:
    """The remarks on files that are alike."""
    return [words for _, words in remarks(rows)]


def _is_plain(row: ClassRow) -> bool:
    """True for right numbers in plain text, which are the same bytes for everyone who writes them alike."""
    return row.file.lower().endswith(".csv") and row.verdict in (Rating.RIGHT, Rating.ROUNDED, Rating.INCOMPLETE)


def _sharing(rows: Sequence[ClassRow]) -> list[tuple[list[ClassRow], set[str]]]:
    """Groups of files of several teams in which most of the numbers compared are the same wrong ones, with these.

    A file with fewer decimals than another may be a rounded copy of it: they are compared to the fewer decimals.
    Of a number in many files only neighbours are compared: who shares a table has its numbers in a row of neighbours.
    """
    from scipy.sparse import coo_array  # type: ignore[import-untyped]
    from scipy.sparse.csgraph import connected_components  # type: ignore[import-untyped]

    numbers = [set(row.unusual) for row in rows]
    decimals = [max((DECIMALS_LEAST, *map(_decimals, row.unusual))) for row in rows]
    rounded = {
        count: [{_rounded(number, count) for number in some if _is_place(number)} for some in numbers]
        for count in set(decimals)
    }
    pairs = Counter({pair: n for pair, n in _pairs(numbers).items() if decimals[pair[0]] == decimals[pair[1]]})
    for count, some in rounded.items():
        own = _pairs(some).items()
        pairs += Counter(
            {(a, b): n for (a, b), n in own if decimals[a] != decimals[b] and count == min(decimals[a], decimals[b])}
        )
    linked = [
        (a, b)
        for (a, b), count in pairs.items()
        if rows[a].team != rows[b].team
        and count >= max(SHARED_LEAST, SHARED_SHARE * min(len(numbers[a]), len(numbers[b])))
    ]
    if not linked:
        return []
    links = coo_array((np.ones(len(linked)), np.array(linked).T), shape=(len(rows), len(rows)))
    groups: dict[int, list[int]] = defaultdict(list)
    for k, label in enumerate(connected_components(links, directed=False)[1].tolist()):
        groups[label].append(k)
    shared = []
    for group in groups.values():
        fewest = min(decimals[k] for k in group)
        compared = rounded[fewest] if len({decimals[k] for k in group}) > 1 else numbers
        shared.append((group, set.intersection(*(compared[k] for k in group))))
    return [([rows[k] for k in group], some) for group, some in shared if some and len(group) > 1]


def _pairs(numbers: Sequence[set[str]]) -> Counter[tuple[int, int]]:
    """How many numbers each two of the files have in common; of one in many files, only neighbours have it."""
    holders: dict[str, list[int]] = defaultdict(list)
    for k, own in enumerate(numbers):
        for number in own:
            holders[number].append(k)
    every = holders.values()
    return Counter(pair for some in every for pair in (combinations(some, 2) if len(some) <= MANY else pairwise(some)))


def _is_place(number: str) -> bool:
    """True for x and y: speeds are so near to one another that few decimals tell nothing."""
    return not number.startswith("v ")


def _decimals(number: str) -> int:
    """Decimals of a number as unusual_of() gives it, without zeros at the end."""
    return len(number.rpartition(": ")[2].partition(".")[2].rstrip("0"))


def _rounded(number: str, decimals: int) -> str:
    """A number as unusual_of() gives it, with so many decimals."""
    cell, _, value = number.rpartition(": ")
    with suppress(ValueError):
        return f"{cell}: {float(value):.{decimals}f}"
    return number


def _teams(group: Sequence[ClassRow]) -> int:
    return len({row.team for row in group})


def names_of(group: Sequence[ClassRow], but: ClassRow | None = None) -> str:
    """The files, each with its team, without one of them; of many the first ones."""
    some = [row for row in group[: NAMED + 1] if row is not but][:NAMED]
    names, more = str(Listed(f"{row.team}/{row.file}" for row in some)), len(group) - len(some) - (but is not None)
    return say("{entries} and {count} more", entries=names, count=more) if more > 0 else names


def names_beside(rows: Sequence[ClassRow], groups: Sequence[Sequence[ClassRow]]) -> list[str]:
    """Of each row the files that are alike it, as names_of() has them: of the largest group that it is in."""
    largest = {id(row): group for group in sorted(groups, key=len) for row in group}
    return [names_of(largest[id(row)], row) if id(row) in largest else "" for row in rows]
