"""bench-dragon grade: files, folders, numbers, a summary; exit code 0 for every verdict."""

from __future__ import annotations

import csv
import json
import os
import subprocess
from pathlib import Path

import numpy as np
import pytest

import core
from app.files.tables import Language
from app.grade.numbers import SEARCH_END, TURN_LENGTH_LEAST, TURN_OF_TWO_LEAST, gives
from app.grade.report import typed
from app.grade.shortcuts import pitch_grids, right_answer, shortcuts
from tests.support.command import COMMAND, ENVIRONMENT, PATIENCE, run
from tests.support.students import CONTACT, contact_workbook, spiral


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
    paths = [str(class_of_three / name / "result2.xlsx") for name in ("zhao", "wang")]
    files = json.loads(run("grade", *paths, "--json").stdout)["files"]
    assert [file["file"] for file in files] == paths


def test_the_words_are_in_the_language_chosen(class_of_three: Path) -> None:
    done = run("grade", str(class_of_three / "li" / "result2.xlsx"), "--language", "zh")
    assert "以 0.01 / 0.02 / 0.04 / 0.08 s 为步长搜索" in done.stdout


def test_a_wrong_speed_is_called_so_in_chinese(tmp_path: Path) -> None:
    position, speed = spiral(np.array([CONTACT]))
    speed[0, 5] += 1.0
    (tmp_path / "result2.xlsx").write_bytes(contact_workbook((position, speed)))
    done = run("grade", str(tmp_path / "result2.xlsx"), "--language", "zh")
    assert "误差最大：D7，第5节龙身，412.473838 s 时，速度：" in done.stdout


def test_a_file_that_is_missing_is_reported_and_the_others_are_graded(class_of_three: Path) -> None:
    files = ["missing.xlsx", str(class_of_three / "wang" / "result2.xlsx")]
    done = run("grade", *files, "--json")
    assert [file["verdict"] for file in json.loads(done.stdout)["files"]] == ["unreadable", "right"]


@pytest.mark.parametrize("coding", ["utf-8", "gbk", "ascii"])
def test_a_class_with_names_of_another_encoding_loses_nothing(tmp_path: Path, coding: str) -> None:
    """Folders of a ZIP from Chinese Windows, unpacked on Linux, one that is text in no encoding, and one that turns."""
    names = ["李".encode("gbk"), "王".encode(), b"\xff\xfe\x81", "Li\u202e".encode()]
    for name in names:
        folder = os.path.join(os.fsencode(tmp_path), b"class", name)
        os.makedirs(folder)
        Path(os.fsdecode(os.path.join(folder, b"result2.xlsx"))).write_bytes(
            contact_workbook(spiral(np.array([CONTACT])))
        )
    summary = tmp_path / "summary.csv"

    def graded_class(*options: str) -> bytes:
        environment = ENVIRONMENT | {"PYTHONIOENCODING": f"{coding}:backslashreplace"}
        command = [COMMAND, "grade", str(tmp_path / "class"), *options]
        return subprocess.run(command, check=True, capture_output=True, timeout=PATIENCE, env=environment).stdout

    answer = graded_class("--json", "--summary", str(summary))
    files, folders = json.loads(answer)["files"], ["Li\\u202e", "王", "李", "\\xff\\xfe\\x81"]
    assert [Path(file["file"]).parent.name for file in files] == folders
    assert {file["verdict"] for file in files} == {"right"}
    assert [len(file["notes"]) for file in files] == [0, 0, 1, 1]
    with summary.open(encoding="utf-8-sig", newline="") as lines:
        assert [Path(row["file"]).parent.name for row in csv.DictReader(lines)] == folders
    assert "\\xff" in graded_class("--language", "zh").decode(coding)


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
    [result] = json.loads(run("grade", str(file), "--json").stdout)["files"]
    assert (result["workbook"], result["verdict"]) == ("result4", "right")


# Kind of a number, the number as it is typed, and the shortcut that gives it: the one that is certain with so many
# digits, and the one that is only a guess; empty: none.
TYPED = [
    ("collision_time", "412.48000", "", "time_steps"),
    ("collision_time", "406.43", "", "loose_angle"),
    ("collision_time", "406.4287", "loose_angle", ""),
    ("collision_time", "407.4", "", "literal_corners"),
    ("collision_time", "407.41428", "literal_corners", ""),
    ("collision_time", "412.46", "", ""),
    ("collision_time", "412.478", "", ""),
    ("collision_time", "412.8", "", ""),
    ("pitch", "0.4202", "", "pose_on_circle"),
    ("pitch", "0.4202169", "pose_on_circle", ""),
    ("pitch", "0.4171", "", "pose_on_circle_head"),
    ("pitch", "0.4052", "", "one_corner"),
    ("pitch", "0.4052212", "one_corner", ""),
    ("pitch", "0.4205", "", "pose_on_circle"),
    ("pitch", "0.41", "", ""),
    ("pitch", "0.43", "", ""),
    ("pitch", "0.450274", "", "pitch_time_steps"),
    ("pitch", "0.450273532", "pitch_time_steps", ""),
    ("pitch", "0.44818336", "pitch_radius_steps", ""),
    ("pitch", "0.4503194714", "pitch_angle_steps", ""),
    ("pitch", "0.4503313691", "", "pitch_angle_steps"),
    ("pitch", "0.4503313750", "", ""),
    ("pitch", "0.4503202350", "pitch_parts_steps", ""),
    ("pitch", "0.449610", "", ""),
    ("pitch", "0.450333", "", ""),
    ("pitch", "0.4321", "", ""),
    ("turn_length", "14.14", "", "arcs_not_tangent"),
    ("turn_length", "14.137167", "arcs_not_tangent", ""),
    ("speed", "1.4063", "", "speed_time_steps"),
    ("speed", "1.406277", "speed_time_steps", ""),
    ("speed", "1.2470", "", ""),
    ("speed", "1.3194", "", ""),
    ("speed", "2.0", "", ""),
    ("speed", "1.4", "", ""),
]


@pytest.mark.parametrize(("name", "text", "certain", "guess"), TYPED)
def test_a_number_is_traced_to_its_shortcut_as_far_as_its_digits_go(
    name: str, text: str, certain: str, guess: str
) -> None:
    result = typed(name, text, Language.ENGLISH)
    assert result.verdict == "wrong"
    assert [one.error for one in result.diagnosis] == [certain] * bool(certain)
    assert [one.error for one in result.possible] == [guess] * bool(guess)
    for one in result.possible:
        assert one.evidence.endswith(
            f"One in {round(1.0 / one.probability)} numbers with as many digits fits a known error by chance."
        )


@pytest.mark.parametrize(
    ("text", "words"),
    [
        # The overlaps were found by scipy's brentq on the gap of the nearest benches.
        ("0.449610", "from 4.586996 m to 4.559133 m ... more than 27.9 mm apart"),
        ("0.4503313691", "from 4.573875 m to 4.571339 m ... more than 2.54 mm apart"),
        ("0.46", ""),
        ("0.44", ""),
    ],
)
def test_a_pitch_that_is_a_little_too_small_is_reported_where_benches_overlap(text: str, words: str) -> None:
    """Many ways to sample the dance give such a pitch, so none of them is the diagnosis."""
    result = typed("pitch", text, Language.ENGLISH)
    assert result.diagnosis == []
    assert all(part in " ".join(result.notes) for part in words.split(" ... "))
    assert ("overlap" in " ".join(result.notes)) is bool(words)


def test_a_pitch_where_a_search_stopped_is_traced_to_all_steps_that_give_it() -> None:
    """A bisection that stopped at 1e-8 m ends up to half of that beside its limit; two steps have the same limit."""
    [guess] = typed("pitch", "0.4503313691", Language.ENGLISH).possible
    assert "0.05 / 0.25 rad" in guess.words
    assert "the number is 0.450331367 m; the given value is 0.450331369 m" in guess.evidence


def test_pitches_where_searches_stopped_fit_by_chance_no_oftener_than_stated() -> None:
    random = np.random.default_rng(44)
    [guess] = typed("pitch", "0.4503313691", Language.ENGLISH).possible
    off = right_answer("pitch") - 0.4503313691
    pitches = right_answer("pitch") + random.uniform(-off, off, 2000)
    known = [*shortcuts("pitch"), *pitch_grids()]
    fits = sum(any(gives(one, pitch, SEARCH_END) for one in known) for pitch in pitches.tolist())
    assert 0 < fits / pitches.size <= 1.5 * guess.probability


def test_no_pitch_of_two_decimals_has_a_cause() -> None:
    for hundredths in range(30, 60):
        result = typed("pitch", f"0.{hundredths}", Language.ENGLISH)
        assert (result.diagnosis, result.possible) == ([], [])


def test_the_stated_chance_is_that_of_random_numbers() -> None:
    """Of all pitches of four decimals as far from the right one as 0.4202, or nearer, so many fit a known error."""
    texts = [f"{k / 10000:.4f}" for k in range(4202, 4806)]
    known = [*shortcuts("pitch"), *pitch_grids()]
    fits = [text for text in texts if any(gives(one, float(text), 0.5e-4) for one in known)]
    [guess] = typed("pitch", "0.4202", Language.ENGLISH).possible
    assert guess.probability == pytest.approx(len(fits) / len(texts), rel=0.2)


@pytest.mark.parametrize(
    ("name", "text", "verdict", "words"),
    [
        ("collision_time", "412.47", "right", ""),
        ("collision_time", "412.48", "rounded", "to the nearest digit the right one is 412.47 s"),
        ("collision_time", "412.473838", "right", ""),
        ("collision_time", "412.47383765", "right", ""),
        ("pitch", "0.4503", "rounded", "0.4504 m is the smallest of as many digits"),
        ("pitch", "0.45033", "rounded", "0.45034 m is the smallest of as many digits"),
        ("pitch", "0.45", "rounded", "0.46 m is the smallest of as many digits"),
        ("pitch", "0.4504", "right", "rounded up, as a pitch must be"),
        ("pitch", "0.46", "right", "rounded up, as a pitch must be"),
        ("speed", "1.25", "right", ""),
        ("speed", "1.247", "rounded", "to the nearest digit the right one is 1.246 m/s"),
    ],
)
def test_a_number_right_to_its_last_digit_is_not_accused(name: str, text: str, verdict: str, words: str) -> None:
    result = typed(name, text, Language.ENGLISH)
    assert (result.verdict, result.diagnosis, result.possible) == (verdict, [], [])
    assert words in " ".join(result.notes)
    assert bool(result.notes) is bool(words)


@pytest.mark.parametrize(
    "text", ["8.215", "8.2271", "9.4153", "11.7915", "11.8105", "11.8336", "12.949437944", "13.06", "13.5"]
)
def test_every_turn_that_may_be_possible_is_a_right_answer_to_question_4(text: str) -> None:
    result = typed("turn_length", text, Language.ENGLISH)
    assert (result.verdict, result.diagnosis, result.possible) == ("right", [], [])
    stated = "both places" if float(text) > TURN_OF_TWO_LEAST else "the ratio and both places"
    assert f"right if {stated} are stated" in result.notes[0]


def test_no_shorter_turn_has_arcs_of_two_to_one() -> None:
    assert core.shortest_turn(core.Dragon(), 1.7).length_bracket[0] == pytest.approx(TURN_OF_TWO_LEAST, abs=1e-7)


@pytest.mark.parametrize("ratio", [1.0, pytest.param(None, marks=pytest.mark.deep)], ids=["equal arcs", "any ratio"])
def test_the_shortest_right_turn_is_the_proven_one(ratio: float | None) -> None:
    """Equal arcs give the least of all ratios."""
    low = core.turn_length_bounds(core.Dragon(), 1.7, ratio=ratio, budget=core.Budget(1e10))[0]
    assert TURN_LENGTH_LEAST <= low < TURN_LENGTH_LEAST + 1e-7


@pytest.mark.parametrize(
    ("text", "verdict"),
    [
        ("13.62", "right"),
        ("8.2146", "wrong"),
        ("8.1", "wrong"),
        ("13.8", "wrong"),
        ("20.5", "wrong"),
    ],
)
def test_other_turns_are_graded_against_the_one_of_the_contest(text: str, verdict: str) -> None:
    result = typed("turn_length", text, Language.ENGLISH)
    assert (result.verdict, result.notes) == (verdict, [])


@pytest.mark.parametrize(("text", "digits"), [("1", 1), ("0.4503374", 7), ("1.250", 4), ("1.2462663581", 7)])
def test_the_digits_that_were_graded_are_reported(text: str, digits: int) -> None:
    assert typed("speed", text, Language.ENGLISH).digits == digits
