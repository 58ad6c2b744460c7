"""The table of a class: points by a rubric that a teacher edits, for a spreadsheet, and no false remark."""

import csv
import io
from dataclasses import replace

import openpyxl
import pytest

from app.grade.class_table import ClassRow, alike, points_of, rubric_of, rubric_text, team_most, team_points
from app.grade.judged import Rating
from tests.support.asking import assert_problem

RIGHT = {"team": "Red", "file": "result1.xlsx", "workbook": "result1", "verdict": "right", "cells": 200, "right": 200}
ROUNDED = {"team": "Red", "file": "result2.xlsx", "workbook": "result2", "verdict": "rounded", "cells": 100, "right": 0}
HALF = {**RIGHT, "team": "Gold", "verdict": "wrong", "right": 100, "finding": "=SUM(A1)"}
PICTURE = {"team": "Gold", "file": "photo.png", "verdict": "unreadable"}
CLASS = [RIGHT, ROUNDED, HALF, PICTURE]


def row(team, digest, *, missing=0, cells=10):
    return ClassRow(team, "result1.xlsx", "result1", Rating.RIGHT, cells, cells - missing, missing, digest)


def test_points_follow_the_rubric_and_teams_are_ordered_by_them(client):
    usual = client.post("/class-table", json={"files": CLASS}).raise_for_status().json()
    assert [line[6] for line in usual["rows"]] == [40.0, 18.0, 20.0, 0.0]
    assert usual["teams"] == [["Red", 58.0], ["Gold", 20.0]]
    rubric = usual["rubric"].replace("result1,40", "result1,50").replace("rounded,0.9", "rounded,0.5")
    edited = client.post("/class-table", json={"files": CLASS, "rubric": rubric}).raise_for_status().json()
    assert edited["teams"] == [["Red", 60.0], ["Gold", 25.0]]
    assert edited["rubric"] == rubric
    chinese = client.post("/class-table", json={"files": CLASS}, headers={"Accept-Language": "zh"}).json()
    assert chinese["heads"][0] == "队伍"
    assert chinese["rows"][0][3] == "正确"


def test_a_typed_number_counts_for_its_question_and_then_in_what_everyone_may_reach(client):
    pitch = {"team": "Red", "file": "0.45 m", "workbook": "question3", "verdict": "right", "cells": 1, "right": 1}
    usual, typed = (
        client.post("/class-table", json={"files": files}).raise_for_status().json()
        for files in (CLASS, [*CLASS, pitch])
    )
    assert [line[13] for line in usual["rows"]] == [100.0] * 4
    assert "Questions 3 and 5 have no workbook" in usual["scheme"]
    assert [line[13] for line in typed["rows"]] == [110.0] * 5
    assert typed["teams"] == [["Red", 68.0], ["Gold", 20.0]]
    assert typed["rows"][4][12] == 10.0
    # Numbers that are right to three decimals of six were not rounded by anyone.
    assert typed["rows"][1][3] == "right to fewer decimals"


def test_points_fall_by_what_is_wrong_and_by_no_more():
    """A result1 of four decimals, and the same one with one slip; and no share for what is near by chance."""
    cells = 202_272
    rounded = ClassRow("Red", "a", "result1", Rating.ROUNDED, cells, 2_000, 0, rounded=cells - 2_000)
    slip = replace(rounded, verdict=Rating.WRONG, rounded=cells - 2_001)
    half = replace(rounded, verdict=Rating.WRONG, rounded=cells // 2 - 2_000)
    assert [points_of(one, rubric_of("")) for one in (rounded, slip, half)] == [36.0, 36.0, 18.0]


def test_the_table_opens_in_a_spreadsheet_and_no_cell_is_a_formula(client):
    sheet, text = (
        client.post("/class-table", json={"files": CLASS}, headers={"Accept": kind}).raise_for_status().content
        for kind in ("application/vnd.openxmlformats-officedocument.spreadsheetml.sheet", "text/csv")
    )
    lines = list(openpyxl.load_workbook(io.BytesIO(sheet)).active.iter_rows(values_only=True))
    assert [line[6] for line in lines] == ["points", 40, 18, 20, 0]
    assert lines[3][7] == "=SUM(A1)"
    cells = list(csv.reader(io.StringIO(text.decode("utf-8-sig"))))
    assert cells[3][7] == "'=SUM(A1)"


@pytest.mark.parametrize(
    "rubric, words",
    [
        (
            "what,points\nresult3,10\n",
            "line 2 of the rubric must begin with one of result1, result2, question3, result4, question5, rounded",
        ),
        ("result1,lots\n", "line 1 of the rubric must have a number from 0 to 1000 behind result1"),
        ("result1,40\nrounded,2\n", "line 2 of the rubric must have a number from 0 to 1 behind rounded"),
        ("result1,nan\n", "line 1 of the rubric must have a number"),
        ("PK\x03\x04 of another program", "the rubric must be a CSV file with lines such as result1,40"),
    ],
)
def test_a_rubric_that_cannot_be_read_is_refused_by_its_line(client, rubric, words):
    problem = client.post("/class-table", json={"files": CLASS, "rubric": rubric})
    assert_problem(problem, 422)
    assert words in problem.json()["detail"]


def test_a_rubric_reads_as_it_is_written():
    rubric = {"result1": 12.5, "result2": 0.0, "question3": 5.0, "result4": 30.0, "question5": 7.5, "rounded": 1.0}
    assert rubric_of("\ufeff" + rubric_text(rubric)) == rubric
    assert points_of(row("Red", ""), rubric) == 12.5
    # One of before questions 3 and 5 had points, as a table of another language.
    before = rubric_of("Wofür;Punkte\nresult1;12,5\nresult2;0\nresult4;30\nrounded;1\n")
    assert before == rubric | {"question3": 10.0, "question5": 10.0}
    assert team_most([row("Red", "")], before) == 42.5


def test_of_two_files_for_one_workbook_the_better_counts():
    worse = ClassRow("Red", "old.xlsx", "result1", Rating.WRONG, 10, 1, 0)
    assert team_points([worse, row("Red", ""), worse], rubric_of("")) == [("Red", 40.0)]


def test_only_equal_bytes_of_two_teams_are_pointed_out_and_no_blank_form():
    same = [row("Red", "a"), row("Gold", "b"), row("Blue", "a")]
    [remark] = alike(same)
    assert "Red/result1.xlsx, Blue/result1.xlsx" in remark
    assert "ask before you judge" in remark
    # One team twice, no digest, and a form that nobody filled in.
    assert alike([row("Red", "a"), row("Red", "a")]) == []
    assert alike([row("Red", ""), row("Gold", "")]) == []
    assert alike([row("Red", "a", missing=10), row("Gold", "a", missing=10)]) == []
    # Right numbers in plain text are the same for everyone who writes them alike.
    assert alike([replace(one, file="result1.csv") for one in same]) == []


def test_wrong_numbers_that_two_teams_share_are_counted_and_right_ones_accuse_nobody():
    shared = tuple(f"x {k} s 12: 8.17344{k}" for k in range(4))
    others = tuple(f"x {k} s 12: 5.17344{k}" for k in range(4))
    rows = [
        replace(row(team, digest), verdict=Rating.WRONG, unusual=unusual)
        for team, digest, unusual in [
            ("Red", "a", shared), ("Gold", "b", (*shared[:3], *others[3:])), ("Blue", "c", others), ("Green", "d", ()),
            ("Red", "e", shared),
        ]
    ]  # fmt: skip
    [remark] = alike(rows)
    assert "in 3 of the 4 cells that were compared" in remark
    assert "Red/result1.xlsx" in remark
    assert "Gold/result1.xlsx" in remark
    assert "Blue" not in remark
    assert "cop" not in remark
    assert alike([row(team, team) for team in ("Red", "Gold")]) == []
    # One of two files is a copy of the other that was rounded to fewer decimals.
    for decimals in (4, 5):
        rounded = tuple(f"{cell}: {float(value):.{decimals}f}0" for cell, value in (one.split(": ") for one in others))
        [remark] = alike(
            [replace(row(*one), unusual=some) for one, some in ((("Red", "a"), others), (("Blue", "b"), rounded))]
        )
        assert "in 4 of the 4 cells" in remark
