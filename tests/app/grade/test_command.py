"""bench-dragon grade: files, folders, numbers, a summary; exit code 0 for every verdict."""

import csv
import json
import os
import shutil
from pathlib import Path

import numpy as np
import openpyxl
import pytest

import core
from app.grade.limits import TIGHTER_LENGTH, TIGHTER_TURN, WIDER_LENGTH
from app.grade.numbers import TURN_OF_TWO_LEAST, gives
from app.grade.report import typed
from app.grade.shortcuts import pitch_grids, shortcuts
from core.language import speaking
from tests.support.command import run, said
from tests.support.depth import further
from tests.support.near import assert_near
from tests.support.students import AT_CONTACT, contact_workbook, spiral


@pytest.fixture(scope="module")
def class_of_three(tmp_path_factory):
    folder = tmp_path_factory.mktemp("class")
    for name, data in (
        ("li", contact_workbook(spiral(np.array([412.48])))),
        ("wang", contact_workbook()),
        ("zhao", b"PK\x03\x04 cut off"),
    ):
        (folder / name).mkdir()
        (folder / name / "result2.xlsx").write_bytes(data)
    return folder


def rows_of(summary):
    """Its rows, heads among them."""
    if summary.suffix == ".xlsx":
        return [*openpyxl.load_workbook(summary).active.values]
    with summary.open(encoding="utf-8-sig", newline="") as lines:
        return list(csv.reader(lines))


def verdicts_in(summary):
    return [f"{Path(file).parent.name} {verdict}" for file, _, verdict, *_ in rows_of(summary)[1:]]


def verdicts_of(files):
    return [f"{Path(file['file']).parent.name} {file['verdict']}" for file in files]


def test_a_folder_is_graded_by_path_with_exit_code_0(class_of_three, tmp_path):
    summary = tmp_path / "summary.csv"
    done = run("grade", str(class_of_three), "--json", "--summary", str(summary))
    assert done.returncode == 0
    assert done.stderr.splitlines() == ["grading: 25 %", "grading: 50 %", "grading: 100 %"]
    files = json.loads(done.stdout)["files"]
    verdicts = ["li wrong", "wang right", "zhao unreadable"]
    assert verdicts_of(files) == verdicts
    assert [error["error"] for error in files[0]["diagnosis"]] == ["other_instant", "time_steps"]
    assert verdicts_in(summary) == verdicts


def test_a_class_has_the_points_of_a_rubric_and_equal_files_are_pointed_out(class_of_three, tmp_path):
    copy = class_of_three / "zhou" / "mine.xlsx"
    rubric = tmp_path / "rubric.csv"
    copy.parent.mkdir()
    copy.write_bytes((class_of_three / "wang" / "result2.xlsx").read_bytes())
    rubric.write_text("what,points\nresult2,55\n", encoding="utf-8")
    done = run("grade", str(class_of_three), "--rubric", str(rubric))
    shutil.rmtree(copy.parent)
    before, _, remark = done.stdout.partition("These are the same file")
    table = before.partition("Most points: ")[0].rpartition("team ")[2]
    points = dict(line.split(maxsplit=1) for line in table.splitlines()[2:] if line.strip())
    assert [points[team].strip() for team in ("wang", "zhou", "zhao")] == ["55 of 135", "55 of 135", "0 of 135"]
    assert "wang/result2.xlsx, zhou/mine.xlsx" in remark


def test_files_stand_in_the_order_given_and_a_missing_one_is_reported(class_of_three):
    paths = [str(class_of_three / name / "result2.xlsx") for name in ("zhao", "missing", "wang")]
    files = json.loads(run("grade", *paths, "--json").stdout)["files"]
    assert [file["file"] for file in files] == paths
    assert [file["verdict"] for file in files] == ["unreadable", "unreadable", "right"]


def test_the_words_are_in_the_language_chosen(class_of_three, tmp_path, monkeypatch):
    position, speed = spiral(AT_CONTACT)
    speed[0, 5] += 1.0
    monkeypatch.chdir(tmp_path)
    file = Path("=1+1.xlsx")
    summary = Path("grades.xlsx")
    file.write_bytes(contact_workbook((position, speed)))
    other = class_of_three / "li" / "result2.xlsx"
    done = run("grade", str(other), file.name, "--pitch", "0.4202", "--language", "zh", "--summary", str(summary))
    assert "以 0.01 / 0.02 / 0.04 / 0.08 s 为步长搜索" in done.stdout
    assert "误差最大的：D7（第5节龙身前把手，412.473838 s 时的速度），" in done.stdout
    assert "other_instant" not in done.stdout
    heads, number, *rows = rows_of(summary)
    assert heads == ("文件", "工作簿", "判定", "单元格", "正确", "缺少", "诊断", "小数位")
    assert number[0] == "最小螺距：0.4202 m"
    assert number[2] == "错误"
    assert number[6].endswith("；可能是：只检验圆上的位形")
    assert rows == [
        (str(other), "result2", "错误", 672, 1, 0, "时刻有误；按时间步长搜索（碰撞后）", None),
        ("=1+1.xlsx", "result2", "错误", 672, 671, 0, None, None),
    ]


def test_a_picture_is_drawn_only_where_it_shows_which_numbers_are_wrong(tmp_path):
    position, speed = spiral(AT_CONTACT)
    for changed, lines in (((position * [-1.0, 1.0], speed), 14), ((-position, -speed), 0), ((position, speed), 0)):
        file = tmp_path / "result2.xlsx"
        file.write_bytes(contact_workbook(changed))
        assert [line.strip() for line in run("grade", str(file)).stdout.splitlines()].count("#..") == lines


def test_a_class_with_names_of_another_encoding_loses_nothing(tmp_path):
    """Folders of a ZIP from Chinese Windows, unpacked on Linux, one that is text in no encoding, and one that turns."""
    for name in ("李".encode("gbk"), "王".encode(), b"\xff\xfe\x81", "Li\u202e".encode()):
        folder = Path(os.fsdecode(os.path.join(os.fsencode(tmp_path), b"class", name)))
        folder.mkdir(parents=True)
        (folder / "result2.xlsx").write_bytes(contact_workbook())
    summary = tmp_path / "summary.csv"
    files = json.loads(run("grade", str(tmp_path / "class"), "--json", "--summary", str(summary)).stdout)["files"]
    verdicts = ["Li\\u202e right", "王 right", "李 right", "\\xff\\xfe\\x81 right"]
    assert verdicts_of(files) == verdicts
    assert [len(file["notes"]) for file in files] == [0, 0, 1, 1]
    assert verdicts_in(summary) == verdicts
    assert "\\xff" in run("grade", str(tmp_path / "class"), "--language", "zh").stdout


@pytest.mark.parametrize("ending", further(["xlsx", "csv"], 1))
def test_the_turn_that_the_command_writes_is_graded_right(tmp_path, ending):
    file = tmp_path / f"result4.{ending}"
    options = "--path", "turn", "--start", "-100", "--stop", "100", "--output", str(file)
    said("trajectory", *options, aside=f"{file}: 224 handles at 201 instants\n")
    [result] = json.loads(run("grade", str(file), "--json").stdout)["files"]
    assert result["workbook"] == "result4"
    assert result["verdict"] == "right"


# A number as it is typed, its verdict, and the shortcut that gives it: certain, or with a ? only a guess with so many
# digits; after | what is said beside it.
TYPED = [
    "collision_time 412.48000 -> wrong ?time_steps",
    "collision_time 406.43 -> wrong ?loose_angle",
    "collision_time 406.4287 -> wrong loose_angle",
    "collision_time 407.4 -> wrong ?literal_corners",
    "collision_time 407.41428 -> wrong literal_corners",
    "collision_time 412.46 -> wrong | the nearest two benches are 0.366 mm apart, and they first touch 0.0138 s later",
    "collision_time 409.83 -> wrong | nearest pass before the contact: two benches come as near as 0.865 mm",
    "collision_time 412.478 -> wrong | the first contact is 0.00416 s earlier",
    "collision_time 412.8 -> wrong",
    "pitch 0.4202 -> wrong ?pose_on_circle",
    "pitch 0.4202169 -> wrong pose_on_circle",
    "pitch 0.4171 -> wrong ?pose_on_circle_head",
    "pitch 0.4052 -> wrong ?one_corner",
    "pitch 0.4052212 -> wrong one_corner",
    "pitch 0.4205 -> wrong ?pose_on_circle",
    "pitch 0.41 -> wrong",
    "pitch 0.43 -> wrong",
    "pitch 0.450274 -> wrong ?pitch_time_steps",
    "pitch 0.450273532 -> wrong pitch_time_steps",
    "pitch 0.44818336 -> wrong pitch_radius_steps",
    "pitch 0.4503194714 -> wrong pitch_angle_steps",
    (
        "pitch 0.4503313691 -> wrong ?pitch_angle_steps | overlap while the head goes from 4.573875 m to 4.571339 m "
        "from the centre: only a check of its way at radii more than 2.54 mm apart"
    ),
    "pitch 0.4503313750 -> wrong",
    "pitch 0.4503202350 -> wrong pitch_parts_steps",
    # The overlaps were found by scipy's brentq on the gap of the nearest benches. Many ways to sample the dance give
    # such a pitch, so none of them is the diagnosis.
    (
        "pitch 0.449610 -> wrong | overlap while the head goes from 4.586996 m to 4.559133 m from the centre: only a "
        "check of its way at radii more than 27.9 mm apart"
    ),
    "pitch 0.450333 -> wrong",
    "turn_length 14.14 -> wrong ?arcs_not_tangent",
    "turn_length 14.137167 -> wrong arcs_not_tangent",
    "speed 1.604793 -> wrong speed_ratio",
    "speed 1.4063 -> wrong ?speed_time_steps",
    "speed 1.406277 -> wrong speed_time_steps",
    "speed 1.2470 -> wrong",
    "speed 1.3194 -> wrong",
    "speed 2.0 -> wrong",
    "speed 1.4 -> wrong",
    "collision_time 412.47 -> right",
    "collision_time 412.48 -> rounded | to the nearest digit the right one is 412.47 s",
    "collision_time 412.473838 -> right",
    "collision_time 412.47383765 -> right",
    "pitch 0.4503 -> infeasible | 0.4504 m is the smallest of as many digits",
    "pitch 0.45033 -> infeasible | 0.45034 m is the smallest of as many digits",
    "pitch 0.45 -> infeasible | 0.46 m is the smallest of as many digits",
    "pitch 0.4504 -> right | rounded up, as a pitch must be",
    "pitch 0.46 -> right | rounded up, as a pitch must be",
    "speed 1.25 -> infeasible | 1.24 m/s is the highest of as many digits",
    "speed 1.24627 -> infeasible | 1.24626 m/s is the highest of as many digits",
    "speed 1.247 -> infeasible | exceeds 2 m/s: 1.246 m/s is the highest of as many digits",
    "speed 1.2463 -> infeasible | 1.2462 m/s is the highest of as many digits",
    "pitch 4.5e-1 -> infeasible | rounded down: benches touch at this pitch, and 0.46 m is",
    "pitch 4503E-4 -> infeasible | 0.4504 m is the smallest of as many digits",
    "pitch 0.004504e+2 -> right | to the nearest digit it is 0.4503 m",
    "collision_time 4e2 -> incomplete | too few to tell the number from a wrong one: at least 2 digits",
    "collision_time 5e2 -> incomplete | too few to tell the number from a wrong one",
    "collision_time 4.1e2 -> right",
    "pitch 1 -> incomplete | too few to tell the number from a wrong one",
    "pitch 1.0 -> wrong | too few to tell why",
    "pitch 0.5 -> incomplete | too few to tell the number from a wrong one",
    "speed 1 -> incomplete | too few to tell the number from a wrong one",
    "speed 1.2 -> right",
    "collision_time +412.47 -> right",
    "pitch .4504 -> right | rounded up, as a pitch must be",
    "pitch 0.4502 -> wrong | No known error",
    "pitch 0.4505 -> wrong | nothing touches, but so it does at smaller ones: it is 0.163 mm larger than the smallest",
    "speed 1.1 -> wrong | no handle exceeds 2 m/s, but the head may be 0.146 m/s faster",
    "speed 2 -> infeasible | too few to tell the number from a wrong one",
    "speed 1.3 -> infeasible | At this speed a handle exceeds 2 m/s: 1.2 m/s is the highest of as many digits",
    "speed 1.252 -> wrong",
    "speed 1.24 -> right | rounded down, as a highest speed must be",
    "speed 1.246 -> right",
    "pitch 0.42 -> wrong | too few to tell why",
    "pitch 0.44 -> wrong | too few to tell why",
    "pitch 0.4321 -> wrong | No known error",
    "turn_length 7.69 -> infeasible | shortest turn known, rounded down: 7.70 m is the smallest of as many digits",
    "turn_length 7.6935 -> right | right if the ratio, both radii and both places are stated",
    "turn_length 8.2147 -> right | right if the ratio and both places are stated",
    "turn_length 8.1 -> right | In every turn shorter than 8.2147138 m an arc is as tight as that",
    "turn_length 8 -> incomplete | too few to tell the number from a wrong one",
    "turn_length 8.215 -> right | right if the ratio and both places are stated",
    "turn_length 8.2271 -> right | right if the ratio and both places are stated",
    "turn_length 9.4153 -> right | right if the ratio and both places are stated",
    "turn_length 11.7915 -> right | right if the ratio and both places are stated",
    "turn_length 11.8105 -> right | right if both places are stated",
    "turn_length 11.8336 -> right | right if both places are stated",
    "turn_length 12.949437944 -> right | right if both places are stated",
    "turn_length 13.06 -> right | right if both places are stated",
    "turn_length 13.5 -> right | right if both places are stated",
    "turn_length 13.62 -> right |",
    "turn_length 9 -> incomplete | too few to tell the number from a wrong one",
    "turn_length 13 -> right | right if both places are stated",
    "turn_length 13.63 -> right | rounded up, as a shortest length must be; to the nearest digit it is 13.62 m",
    "turn_length 13.622 -> right | rounded up, as a shortest length must be",
    "turn_length 13.624 -> wrong | It is 2.76 mm longer than the turn of two arcs from the edge of the circle",
    "turn_length 7.1234 -> wrong | No known error",
    "turn_length 7.1 -> wrong | too few to tell why",
    "turn_length 13.8 -> wrong | too few to tell why",
    "turn_length 20.5 -> wrong | too few to tell why",
]


@pytest.mark.parametrize("row", TYPED)
def test_a_number_is_traced_to_its_shortcut_as_far_as_its_digits_go(row):
    number, answer = row.split(" -> ")
    graded, noted, note = answer.partition(" |")
    verdict, *errors = graded.split()
    result = typed(*number.split())
    assert result.verdict == verdict
    assert [*(one.error for one in result.diagnosis), *(f"?{one.error}" for one in result.possible)] == errors
    for one in result.possible:
        assert f"One in {round(1.0 / one.probability)} numbers with as many digits" in one.evidence
    notes = " ".join(result.notes)
    if verdict != "wrong" or "too few" in note:
        assert "benches overlap while" not in notes
    if noted or verdict != "wrong":
        assert bool(notes) is bool(note)
        assert note.strip() in notes


# A number, and the limit that it breaks: the values are those of bench-dragon speed, check and bounds.
BROKEN = """
speed        1.25      infeasible  2 m/s: handles 3, 4, 5, 6, 7 reach 2.006 m/s 11.584 s after the turn begins
speed        1.2463    infeasible  reach 2.0001 m/s
speed        1.4       wrong       reach 2.247 m/s
speed        1.24      right
pitch        0.4503    infeasible  benches 0 and 19 touch when the head is 4.576 m from the centre, before it reaches
pitch        0.4202    wrong       benches 0 and 21 touch
pitch        0.35      wrong       benches 0 and 23 touch at the start
pitch        0.001     wrong       the dragon cannot stand on this spiral
pitch        0.52      wrong
turn_length  7.69      infeasible  7.69341 m, the length of the shortest turn known that every bench can follow
turn_length  7.1       wrong       in every turn shorter than 8.2147138 m an arc is tighter
turn_length  13.8      wrong
collision_time  412.48  rounded
"""


@pytest.mark.parametrize("row", BROKEN.split("\n")[1:-1])
def test_a_number_beyond_its_limit_is_infeasible_and_says_by_how_much(row):
    name, text, verdict, *words = row.split(maxsplit=3)
    result = typed(name, text)
    assert result.verdict == verdict
    assert (result.breaks or "").startswith("breaks the limit" if words else "")
    assert "".join(words) in (result.breaks or "")
    with speaking("zh"):
        assert bool(typed(name, text).breaks) is bool(words)


@pytest.mark.parametrize(
    "number, headline",
    [
        ("collision_time 412.473838", "right"),
        ("collision_time 412.5", "right to its 4 digits; the contest asks for six decimals"),
        ("collision_time 413", "rounded, but not to the nearest"),
        ("pitch 0.4505", "possible, but not the smallest"),
        ("speed 1.1", "possible, but not the highest"),
        ("turn_length 13.8", "not the shortest"),
    ],
)
def test_the_first_line_says_how_a_number_differs_from_the_right_one(number, headline):
    assert typed(*number.split()).headline == headline


def test_a_limit_that_is_broken_stands_in_the_first_line_and_in_a_summary(tmp_path):
    for ending, language, verdict, words in (
        ("csv", "zh", "不可行", "速度达 2.006 m/s"),
        ("xlsx", "en", "infeasible", "reach 2.006 m/s"),
    ):
        summary = tmp_path / f"summary.{ending}"
        done = run("grade", "--speed", "1.25", "--language", language, "--summary", str(summary))
        headline = done.stdout.partition("\n  ")[0].replace("\n", " ")
        assert f"1.25 m/s{'：' if language == 'zh' else ': '}{verdict}" in headline
        _, row = rows_of(summary)
        assert row[2] == verdict
        assert words in row[6]
        assert row[6] in headline


def test_a_pitch_where_a_search_stopped_is_traced_to_all_steps_that_give_it():
    """A bisection that stopped at 1e-8 m ends up to half of that beside its limit; two steps have the same limit."""
    [guess] = typed("pitch", "0.4503313691").possible
    assert "0.05 / 0.25 rad" in guess.words
    assert "the number is 0.450331367 m; the given value is 0.450331369 m" in guess.evidence


def test_the_stated_chance_is_that_of_random_numbers():
    """Of all pitches of four decimals as far from the right one as 0.4202, or nearer, so many fit a known error."""
    texts = [f"{k / 10000:.4f}" for k in range(4202, 4806)]
    known = [*shortcuts("pitch"), *pitch_grids()]
    fits = [text for text in texts if any(gives(one, float(text), 0.5e-4) for one in known)]
    [guess] = typed("pitch", "0.4202").possible
    assert guess.probability == pytest.approx(len(fits) / len(texts), rel=0.2)


def test_no_shorter_turn_has_arcs_of_two_to_one():
    assert_near(core.shortest_turn(core.Dragon(), 1.7).length_bracket[0], TURN_OF_TWO_LEAST, 1e-7)


@pytest.mark.parametrize(
    "ratio", [pytest.param(1.0, marks=pytest.mark.thorough), pytest.param(None, marks=pytest.mark.deep)]
)
def test_the_shortest_right_turn_is_the_proven_one(ratio):
    """Equal arcs give the least of all ratios."""
    low = core.turn_length_bounds(core.Dragon(), 1.7, ratio=ratio, budget=core.Budget(1e10))[0]
    assert WIDER_LENGTH <= low < WIDER_LENGTH + 1e-7


def test_the_shortest_turn_known_with_a_tighter_arc_is_danced_without_contact():
    ratio, entry, leaving = TIGHTER_TURN
    dance = core.Dance(core.Dragon(), core.Turn(1.7, ratio=ratio, entry_radius=entry, exit_radius=leaving))
    assert TIGHTER_LENGTH - 1e-5 < dance.path.length <= TIGHTER_LENGTH < WIDER_LENGTH
    assert core.first_contact(dance).outcome is core.Outcome.CLEAR


@pytest.mark.parametrize(
    "text, digits",
    [
        ("1", 1),
        ("1.25e0", 3),
        ("0.125E+1", 3),
        ("124626.6358e-5", 7),
        ("0.4503374", 7),
        ("1.250", 4),
        ("1.2462663581", 7),
        ("0.45033739312345678", 17),
    ],
)
def test_the_digits_that_were_graded_are_reported(text, digits):
    assert typed("speed", text).digits == digits


@pytest.mark.parametrize(
    "number, is_rounded",
    [
        ("pitch 0.450338", False),
        ("pitch 0.4504", True),
        ("pitch 0.4503", True),
        ("speed 1.246266", False),
        ("speed 1.2463", True),
        ("collision_time 412.48", True),
        ("speed 2", False),
        ("pitch 0.47", False),
    ],
)
def test_a_right_number_of_too_few_decimals_counts_as_rounded_on_either_side_of_its_limit(number, is_rounded):
    assert typed(*number.split()).rounded is is_rounded
