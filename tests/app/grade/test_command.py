"""bench-dragon grade: files, folders, numbers, a summary; exit code 0 for every verdict."""

from __future__ import annotations

import csv
import json
from pathlib import Path

import numpy as np
import pytest

from app.files.tables import Language
from app.grade.report import typed
from app.grade.shortcuts import explained
from tests.app.command import run
from tests.app.grade.students import CONTACT, contact_workbook, spiral


@pytest.fixture(scope="module")
def class_of_three(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("class")
    for name, data in (
        ("li", contact_workbook(spiral(np.array([412.48])))),
        ("wang", contact_workbook(spiral(np.array([CONTACT])))),
        ("zhao", b"PK\x03\x04 cut off"),
    ):
        (folder / name).mkdir()
        (folder / name / "result2.xlsx").write_bytes(data)
    return folder


def test_a_folder_is_graded_by_path_with_exit_code_0(class_of_three: Path, tmp_path: Path) -> None:
    summary = tmp_path / "summary.csv"
    done = run("grade", str(class_of_three), "--json", "--summary", str(summary))
    assert done.returncode == 0
    assert done.stderr.splitlines() == ["grading: 25 %", "grading: 50 %", "grading: 100 %"]
    files = json.loads(done.stdout)["files"]
    assert [Path(file["file"]).parent.name for file in files] == ["li", "wang", "zhao"]
    assert [file["verdict"] for file in files] == ["wrong", "right", "unreadable"]
    assert [one["error"] for one in files[0]["diagnosis"]] == ["other_instant", "time_steps"]
    assert "in steps of 0.01 / 0.02 / 0.04 / 0.08 s" in files[0]["diagnosis"][1]["words"]
    with summary.open(encoding="utf-8-sig", newline="") as lines:
        assert [row["verdict"] for row in csv.DictReader(lines)] == ["wrong", "right", "unreadable"]


def test_files_stand_in_the_order_given(class_of_three: Path) -> None:
    given = [str(class_of_three / name / "result2.xlsx") for name in ("zhao", "wang")]
    files = json.loads(run("grade", *given, "--json").stdout)["files"]
    assert [file["file"] for file in files] == given


def test_the_words_are_in_the_language_chosen(class_of_three: Path) -> None:
    done = run("grade", str(class_of_three / "li" / "result2.xlsx"), "--language", "zh")
    assert "以 0.01 / 0.02 / 0.04 / 0.08 s 为步长搜索" in done.stdout


def test_a_wrong_speed_is_called_so_in_chinese(tmp_path: Path) -> None:
    position, speed = spiral(np.array([CONTACT]))
    speed[0, 5] += 1.0
    (tmp_path / "result2.xlsx").write_bytes(contact_workbook((position, speed)))
    done = run("grade", str(tmp_path / "result2.xlsx"), "--language", "zh")
    assert "误差最大：D7，第5节龙身，412.473838 s 时，速度：" in done.stdout


def test_a_file_that_is_missing_is_told_and_the_others_are_graded(class_of_three: Path) -> None:
    given = ["missing.xlsx", str(class_of_three / "wang" / "result2.xlsx")]
    done = run("grade", *given, "--json")
    assert [file["verdict"] for file in json.loads(done.stdout)["files"]] == ["unreadable", "right"]


def test_an_empty_folder_is_named(tmp_path: Path) -> None:
    done = run("grade", str(tmp_path))
    assert (done.returncode, done.stdout) == (2, "")
    assert f"{tmp_path} must hold a file that ends in .xlsx" in done.stderr


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ((), "give at least one FILE or one number"),
        (("--pitch", "wide"), "pitch must be a number [m], got 'wide'"),
        (("--pitch", "-1"), "pitch must be more than 0"),
        (("missing.xlsx",), "missing.xlsx: No such file or directory"),
    ],
)
def test_wrong_usage_is_one_line(arguments: tuple[str, ...], words: str) -> None:
    done = run("grade", *arguments)
    assert (done.returncode, done.stdout) == (2, "")
    assert words in done.stderr
    assert done.stderr.count("\n") == 1


@pytest.mark.parametrize("ending", ["xlsx", "csv"])
def test_the_turn_that_the_command_writes_is_graded_right(tmp_path: Path, ending: str) -> None:
    file = tmp_path / f"result4.{ending}"
    done = run("trajectory", "--path", "turn", "--start", "-100", "--stop", "100", "--output", str(file))
    assert (done.returncode, done.stderr) == (0, f"{file}: 224 handles at 201 instants\n")
    [found] = json.loads(run("grade", str(file), "--json").stdout)["files"]
    assert (found["workbook"], found["verdict"]) == ("result4", "right")


# Number, as it is typed, and the shortcut that gives it; empty: none is known.
TYPED = [
    ("collision_time", 412.47, 2, ""),
    ("collision_time", 412.48, 2, "time_steps"),
    ("collision_time", 406.43, 2, "loose_angle"),
    ("collision_time", 407.4, 1, "literal_corners"),
    ("collision_time", 412.8, 1, ""),
    ("pitch", 0.4202, 4, "pose_on_circle"),
    ("pitch", 0.4171, 4, "pose_on_circle_head"),
    ("pitch", 0.4052, 4, "one_corner"),
    ("pitch", 0.4503, 4, "truncated"),
    ("pitch", 0.450274, 6, "pitch_time_steps"),
    ("pitch", 0.450297, 6, "pitch_time_steps"),
    ("pitch", 0.450333, 6, "pitch_time_steps"),
    ("pitch", 0.4321, 4, ""),
    ("turn_length", 12.93, 2, "other_entry"),
    ("turn_length", 12.99, 2, "other_entry"),
    ("turn_length", 13.06, 2, "other_entry"),
    ("turn_length", 13.08, 2, ""),
    ("turn_length", 13.0, 1, ""),
    ("turn_length", 13.3, 1, ""),
    ("turn_length", 13.62, 2, ""),
    ("speed", 1.2470, 4, "speed_time_steps"),
    ("speed", 1.4063, 4, "speed_time_steps"),
    ("speed", 1.247, 3, "speed_time_steps"),
    ("speed", 1.3194, 4, ""),
    ("speed", 2.0, 0, ""),
    ("speed", 1.3, 1, ""),
]


@pytest.mark.parametrize(("name", "value", "decimals", "error"), TYPED)
def test_a_number_is_traced_to_its_shortcut(name: str, value: float, decimals: int, error: str) -> None:
    found = explained(name, value, 0.5 * 10.0**-decimals)
    assert [one.error for one in found][:1] == [error] * bool(error)


@pytest.mark.parametrize(
    ("text", "verdict", "expected"),
    [("13.62", "right", 13.62), ("12.949437944", "right", 12.95), ("13.5", "wrong", 13.62)],
)
def test_the_shortest_turn_is_a_right_answer_to_question_4_too(text: str, verdict: str, expected: float) -> None:
    found = typed("turn_length", text, Language.ENGLISH)
    assert (found.verdict, round(found.expected, 2)) == (verdict, expected)
    assert bool(found.notes) is (expected == 12.95)


@pytest.mark.parametrize(("text", "digits"), [("1", 1), ("0.4503374", 7), ("1.250", 4)])
def test_the_digits_that_were_graded_are_told(text: str, digits: int) -> None:
    assert typed("speed", text, Language.ENGLISH).digits == digits
