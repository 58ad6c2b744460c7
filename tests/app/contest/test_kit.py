"""The contest kit, written by the real command and read again by other programs."""

from __future__ import annotations

import csv
import fcntl
import io
import json
import math
import os
import re
import subprocess
import time
from functools import cache
from pathlib import Path
from typing import Any
from zipfile import ZipFile

import httpx
import numpy as np
import openpyxl
import pytest
from PIL import Image

from app.contest.answers import answers
from app.contest.kit import UNFINISHED
from app.contest.sensitivity import panels
from app.contest.solved import ContestRequest, solve
from app.contest.tables import paper_tables
from app.files.tables import Language
from app.files.words import Say
from app.questions.contest_kit import ContestKitRequest, contest_kit
from app.settings import Settings
from app.wire.question import Terms
from core import Budget, TooMuchWork
from tests.support.command import COMMAND, run
from tests.support.reference import reference
from tests.test_docs import KITS, assert_alike

# Half of the last of six decimals, and the rounding of that decimal text [m and m/s].
SIX_DECIMALS = 0.5e-6 + 1e-14
WORKBOOKS = ("result1", "result2", "result4")
FIGURES = ("positions", "snapshots", "clearance", "staircase", "geometry", "amplification", "sensitivity")
CHINESE = ("--language", "zh", "--no-films")
TABLES = ("positions", "speeds", "contact", "turn-positions", "turn-speeds")


# matplotlib's own fonts alone, as on a machine without one for Chinese.
FONTS = """
from matplotlib import font_manager
font_manager.findSystemFonts = lambda *_, **__: []
own = font_manager.fontManager
own.ttflist = [font for font in own.ttflist if "matplotlib" in font.fname]
"""
# No matplotlib, as after an install without the extra figures.
FIGURES_EXTRA = 'sys.modules["matplotlib"] = None'


def kit_without(missing: str, folder: Path, language: str, *options: str) -> subprocess.CompletedProcess[str]:
    """A run of the command on a machine that lacks something. missing: code that hides it"""
    code = f"import sys\n{missing}\nfrom app.command.main import app\nsys.argv[0] = 'bench-dragon'\napp()"
    words = ["contest", folder, "--language", language, "--no-films", *options]
    command = [Path(COMMAND).with_name("python"), "-c", code, *words]
    return subprocess.run(command, capture_output=True, text=True, timeout=120)


def made(language: str, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Folder of a kit, which takes some seconds: all processes of the tests share the one of the first."""
    own = tmp_path_factory.getbasetemp()
    folder = (own.parent if "PYTEST_XDIST_WORKER" in os.environ else own) / f"kit-{language}"
    with folder.with_suffix(".lock").open("w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        if not (folder / "report.md").is_file():  # written last
            zh = language == "zh"
            done = run("contest", str(folder), *CHINESE) if zh else kit_without(FONTS, folder, "en")
            assert done.returncode == 0, done.stderr
            folder.with_suffix(".txt").write_text(done.stdout, encoding="utf-8")
    return folder


IN_CHINESE = pytest.param("zh", marks=pytest.mark.chinese_font)


@pytest.fixture(scope="module", params=[IN_CHINESE, pytest.param("en", marks=pytest.mark.deep)])
def kit(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> tuple[str, Path]:
    """Language and folder of a kit."""
    return request.param, made(request.param, tmp_path_factory)


@pytest.fixture(scope="module", params=[IN_CHINESE])
def chinese(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Path:
    return made(request.param, tmp_path_factory)


@pytest.fixture(scope="module")
def english(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Folder of a kit in English whose figures nobody can draw."""
    folder = tmp_path_factory.mktemp("english")
    done = kit_without(FIGURES_EXTRA, folder, "en")
    assert done.returncode == 1
    assert "Error: figures and films were not written: " in done.stderr
    return folder


@cache
def sheets(folder: Path, name: str) -> list[Any]:
    return list(openpyxl.load_workbook(folder / f"{name}.xlsx").worksheets)


def written(folder: Path, name: str) -> tuple[list[str], list[list[tuple[str, str, str]]]]:
    """Words of a workbook, and of each sheet the (place, style, text) of its numbers, as they stand in its file."""
    with ZipFile(folder / f"{name}.xlsx") as file:
        parts = [file.read(part).decode() for part in file.namelist() if part.startswith("xl/worksheets/")]
    words = [word for part in parts for word in re.findall("<t[^>]*>([^<]*)</t>", part)]
    return words, [re.findall(r'<c r="(\w+)" s="(\d+)"><v>([^<]*)</v>', part) for part in parts]


def numbers(sheet: Any) -> np.ndarray[Any, Any]:
    return np.array([row[1:] for row in sheet.iter_rows(min_row=2, values_only=True)])


def test_the_readme_shows_the_last_line_that_the_command_prints(chinese: Path) -> None:
    [(_, session)] = KITS
    command, lines = session.splitlines()
    assert command == f"$ bench-dragon contest kit {' '.join(CHINESE)} 2>/dev/null | tail -1"
    assert_alike(chinese.with_suffix(".txt").read_text(encoding="utf-8").splitlines()[-1], lines)


@pytest.mark.parametrize("name", WORKBOOKS)
def test_labels_are_the_contest_s_own_to_the_blank(chinese: Path, name: str) -> None:
    own = reference("contest_workbooks")["workbooks"][name]
    result = sheets(chinese, name)
    assert [sheet.dimensions for sheet in result] == [sheet["dimensions"] for sheet in own]
    assert [sheet.title for sheet in result] == [sheet["title"] for sheet in own]
    for sheet, known in zip(result, own, strict=True):
        assert [cell.value for cell in sheet["A"]] == known["first_column"]
        top = [cell.value for cell in sheet[1]]
        assert (top[:4], top[-1]) == (known["first_row_start"], known["first_row_end"])


@pytest.mark.parametrize("name", WORKBOOKS)
def test_english_workbooks_have_the_same_numbers_in_the_same_cells(chinese: Path, english: Path, name: str) -> None:
    words, result = written(english, name)
    assert any(word.startswith("head") for word in words)
    assert any(word.startswith("tail (rear)") for word in words)
    assert all(word.isascii() for word in words)
    assert result == written(chinese, name)[1]
    assert sum(map(len, result)) == sum(numbers(sheet).size for sheet in sheets(chinese, name))


@pytest.mark.parametrize("name", WORKBOOKS)
def test_every_cell_is_a_number_of_six_decimals_in_a_frozen_sheet(chinese: Path, name: str) -> None:
    for sheet in sheets(chinese, name):
        assert sheet.freeze_panes == "B2"
        assert sheet.column_dimensions["A"].width > 15
        cells = [cell for row in sheet.iter_rows(min_row=2, min_col=2) for cell in row]
        assert {cell.data_type for cell in cells} == {"n"}
        assert {cell.number_format for cell in cells} == {"0.000000"}
        assert all(abs(cell.value * 1e6 - round(cell.value * 1e6)) < 1e-6 for cell in cells)


def differences(place: Any, speed: Any, column: int, handles: list[Any]) -> list[float]:
    """Differences of both sheets from the reference at the instant of one column [m], [m/s]."""
    return [
        abs(result - wanted)
        for one in handles
        for result, wanted in (
            (place[2 * one["handle"], column], one["x"]),
            (place[2 * one["handle"] + 1, column], one["y"]),
            (speed[one["handle"], column], one["speed"]),
        )
    ]


@pytest.mark.parametrize(("name", "first", "own_words"), [("result1", 0, "trajectory"), ("result4", -100, "turn")])
def test_workbooks_hold_the_reference_numbers(chinese: Path, name: str, first: int, own_words: str) -> None:
    place, speed = map(numbers, sheets(chinese, name))
    known = reference(own_words)
    instants = known["tables"] if own_words == "turn" else [*known["selected"], *known["full"]]
    whole = [one for one in instants if float(one["time"]).is_integer() and one["time"] - first < place.shape[1]]
    assert len(whole) >= 3
    for one in whole:
        assert max(differences(place, speed, round(one["time"]) - first, one["handles"])) <= SIX_DECIMALS


def test_the_second_workbook_holds_the_dance_at_first_contact(chinese: Path) -> None:
    table = numbers(sheets(chinese, "result2")[0])
    handles = reference("trajectory")["full"][-1]["handles"]
    assert len(handles) == len(table) == 224
    values = np.array([[one["x"], one["y"], one["speed"]] for one in handles])
    # The reference's instant is 1e-9 s from ours at most, and handles move at 1 m/s.
    assert np.abs(table - values).max() <= SIX_DECIMALS + 1e-9


def test_the_answers_are_those_of_the_references_with_brackets(kit: tuple[str, Path]) -> None:
    answer = json.loads((kit[1] / "answers.json").read_bytes())
    assert [one["question"] for one in answer] == [1, 1, 1, 1, 1, 2, 2, 3, 4, 4, 4, 4, 4, 4, 4, 5]
    contact = next(one for one in answer if one["question"] == 2)
    pitch = next(one for one in answer if one["question"] == 3)
    speed = next(one for one in answer if one["question"] == 5)
    assert contact["value"] == pytest.approx(412.473837682, abs=1e-9)
    assert pitch["value"] == pytest.approx(0.450337393028, abs=1e-9)
    assert speed["value"] == pytest.approx(reference("maximum_head_speed")["head_speed"], abs=1e-9)
    for one in (contact, pitch, speed):
        low, high = one["bracket"]
        assert low <= one["value"] <= high
        assert high - low < 2e-9
    length, shorter, saved, even, own_time, short_time, quick_time = (
        one["value"] for one in answer if one["question"] == 4
    )
    assert length == pytest.approx(13.6212449, abs=5e-8)
    # bench-dragon shortest-turn --pitch 1.7 --turning-diameter 9, and with --ratio 1
    assert shorter == pytest.approx(11.799152353, abs=1e-8)
    assert saved == length - shorter
    assert even == pytest.approx(8.223983925, abs=1e-8)
    assert quick_time < own_time < short_time
    assert (own_time, short_time) == (pytest.approx(10.92964, abs=1e-5), pytest.approx(12.09719, abs=1e-5))
    assert all(one["how"] for one in answer)


@pytest.mark.parametrize("name", TABLES)
def test_a_table_says_the_same_in_every_format(kit: tuple[str, Path], name: str) -> None:
    files = {kind: (kit[1] / "tables" / f"{name}.{kind}").read_text(encoding="utf-8") for kind in ("csv", "md", "tex")}
    # Excel takes a CSV for UTF-8 if it begins with this mark.
    assert files["csv"].startswith("\ufeff")
    rows = list(csv.reader(files["csv"][1:].splitlines()))
    marked = [[cell.strip() for cell in line.strip("|").split("|")] for line in files["md"].splitlines()]
    latex = re.findall(r"^    (.*) \\\\$", files["tex"], re.MULTILINE)
    assert [marked[0], *marked[2:]] == rows
    assert [line.replace("$-$", "-").split(" & ") for line in latex] == rows
    assert not any(line.startswith("-") or " & -" in line for line in latex)
    assert files["tex"].count("\\toprule") == files["tex"].count("\\bottomrule") == 1


def test_the_paper_s_tables_hold_the_reference_numbers(kit: tuple[str, Path]) -> None:
    rows = list(csv.reader((kit[1] / "tables" / "positions.csv").read_text(encoding="utf-8-sig").splitlines()))[1:]
    selected = reference("trajectory")["selected"]
    assert len(selected) == len(rows[0]) - 1 == 6
    for column, one in enumerate(selected, start=1):
        places = [(one["handles"][k // 2]["x" if k % 2 == 0 else "y"], rows[k][column]) for k in range(len(rows))]
        assert max(abs(wanted - float(text)) for wanted, text in places) <= SIX_DECIMALS


@pytest.mark.parametrize("name", FIGURES)
def test_a_figure_is_drawn_in_three_formats(kit: tuple[str, Path], name: str) -> None:
    files = {kind: (kit[1] / "figures" / f"{name}.{kind}").read_bytes() for kind in ("pdf", "svg", "png")}
    assert files["pdf"].startswith(b"%PDF-")
    assert b"/Type3" not in files["pdf"]  # journals refuse such fonts
    assert b"<svg" in files["svg"]
    with Image.open(kit[1] / "figures" / f"{name}.png") as picture:
        assert min(picture.size) > 600
        assert len(picture.convert("L").getcolors()) > 20


def test_the_report_ties_everything_together(kit: tuple[str, Path]) -> None:
    language, folder = kit
    page = (folder / "report.md").read_text(encoding="utf-8")
    links = re.findall(r"\]\(([^)]+)\)", page)
    assert {link for link in links if not (folder / link).is_file()} == set()
    assert len(links) > 40
    for number in ("412.473837682", "0.450337393", "13.6212449", "8.2239839", "1.246266358"):
        assert number in page
    assert ("板凳" in page) is (language == "zh")
    rows = {
        "zh": ("首次碰撞时刻", "第 0 节与第 8 节板凳"),
        "en": ("first contact", "benches 0 and 8 touch; 139 proven"),
    }
    what, how = rows[language]
    assert re.search(rf"^\| 2 \| {what} \| 412\.473837682 s \| [\d., ]+ s \| {how}", page, re.MULTILINE)


def test_an_english_report_is_in_english_and_leads_to_no_figure_that_was_not_drawn(english: Path) -> None:
    page = (english / "report.md").read_text(encoding="utf-8")
    links = re.findall(r"\]\(([^)]+)\)", page)
    assert {link for link in links if not (english / link).is_file()} == set()
    assert len(links) > 15
    assert "| 2 | first contact | 412.473837682 s |" in page
    assert "Not in this kit: figures and films, because" in page.splitlines()[-1]
    assert "板凳" not in page


def test_the_service_makes_the_same_files_in_one_archive(chinese: Path, patient: str) -> None:
    body = {"language": "zh", "films": False}
    got = httpx.post(f"{patient}/contest-kit", json=body, timeout=600).raise_for_status()
    assert got.headers["content-type"] == "application/zip"
    with ZipFile(io.BytesIO(got.content)) as archive:
        files = {name: archive.read(name) for name in archive.namelist()}
    written = [file for file in chinese.rglob("*") if file.is_file() and not file.name.startswith(".")]
    assert files == {file.relative_to(chinese).as_posix(): file.read_bytes() for file in written}
    assert list(files)[-1] == "report.md"


@pytest.mark.parametrize(
    ("body", "place", "words"),
    [
        ({"benches": 2001}, "/benches", "benches must be at most 2000 here, got 2001: shorten the dragon"),
        ({"stop": 1e5}, "/stop", "cells of a sheet must be at most 200000 here, got 44800448"),
        ({"span": 1e5}, "/span", "cells of a sheet must be at most 200000 here, got 89600448"),
        ({"seconds": 120}, "/seconds", "millions of pixels must be at most 4000 here, got 14930: take shorter films"),
        ({"overhang": 2}, "/overhang", "overhang must be less than half of head_length"),
        ({"language": "fr"}, "/language", 'language must be "en" or "zh"'),
        ({"folder": "kit"}, "/folder", '"folder" is unknown here'),
    ],
)
def test_a_kit_beyond_a_limit_is_refused_before_any_work(
    client: httpx.Client, body: dict[str, Any], place: str, words: str
) -> None:
    got = client.post("/contest-kit", json=body)
    assert got.status_code == 422
    [error] = got.json()["errors"]
    assert error["pointer"] == place
    assert error["detail"].startswith(words)


def test_a_kit_reports_its_progress_and_ends_when_it_is_stopped() -> None:
    shares: list[float] = []
    budget = Budget(math.inf)

    def listen(share: float) -> None:
        shares.append(share)
        if share > 0.2:
            budget.stop()

    with pytest.raises(TooMuchWork, match="must be fewer, got 5: the kit was not made before it was stopped"):
        contest_kit(
            ContestKitRequest(benches=5, films=False, language=Language.ENGLISH), Terms(Settings(), budget, listen)
        )
    assert shares == sorted(shares)
    assert shares[-1] < 0.5


def test_a_second_run_leaves_nothing_of_the_first_and_keeps_what_is_not_ours(tmp_path: Path) -> None:
    ours = ("dance.gif", "turn.mp4", "figures/geometry.png", ".unfinished/result1.xlsx")
    mine = ("notes.txt", "figures/mine.png")
    for name in (*ours, *mine):
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).write_text("old")
    done = kit_without(FONTS, tmp_path, "zh", "--benches", "30", "--turning-diameter", "4")
    assert "questions 4 and 5 have no answer: path must not bend tighter than" in done.stderr
    assert "change --turning-diameter, --turn-pitch or --ratio" in done.stderr
    assert done.returncode == 1
    entries = {str(file.relative_to(tmp_path)) for file in tmp_path.rglob("*") if file.is_file()}
    tables = {f"tables/{name}.{kind}" for name in TABLES[:3] for kind in ("csv", "md", "tex")}
    assert entries == {"result1.xlsx", "result2.xlsx", "answers.json", "report.md", ".contest.lock", *tables, *mine}
    answer = json.loads((tmp_path / "answers.json").read_bytes())
    assert {one["question"] for one in answer} == {1, 2, 3}
    assert "result4" not in (tmp_path / "report.md").read_text(encoding="utf-8")


def test_a_second_run_into_the_same_folder_is_refused_until_the_first_has_ended_or_was_killed(tmp_path: Path) -> None:
    run("--version")  # Without this the second run would first wait for the process that forks it.
    first = subprocess.Popen([COMMAND, "contest", tmp_path, "--no-films"], stderr=subprocess.DEVNULL)
    try:
        while not (tmp_path / UNFINISHED).is_dir():
            assert first.poll() is None
            time.sleep(0.02)
        done = run("contest", str(tmp_path), "--no-films")
        assert first.poll() is None  # The refusal did not wait for the first.
        words = f"Error: another run writes into {tmp_path}: wait until it is done, or give another FOLDER\n"
        assert (done.returncode, done.stdout, done.stderr) == (2, "", words)
        assert (tmp_path / UNFINISHED).is_dir()
    finally:
        first.kill()
        first.wait()
    assert kit_without(FONTS, tmp_path, "zh", "--benches", "20").returncode == 1
    assert (tmp_path / "report.md").is_file()
    assert not (tmp_path / UNFINISHED).exists()


def test_a_folder_that_cannot_be_locked_is_reported_in_one_line(tmp_path: Path) -> None:
    (tmp_path / ".contest.lock").mkdir()
    done = run("contest", str(tmp_path), "--no-films")
    words = f"Error: {tmp_path}/.contest.lock: cannot be locked: unable to open database file\n"
    assert (done.returncode, done.stdout, done.stderr) == (2, "", words)


def test_a_run_without_contact_says_why_it_ends() -> None:
    request = ContestRequest(benches=40, pitch=0.8, stop=10.0, span=10.0)
    results = answers(solve(request, Terms(), lambda share: None), Say(Language.ENGLISH))
    [one] = [one for one in results if one.question == 2]
    assert re.fullmatch(r"the run ends there: bench \d+ folds and cannot follow any further", one.how)


def test_a_table_of_instants_after_the_contact_says_so() -> None:
    request = ContestRequest(benches=40, pitch=0.45, stop=300.0, span=10.0)
    solved = solve(request, Terms(), lambda share: None)
    captions = [table.caption for table in paper_tables(solved, Say(Language.ENGLISH))]
    text = f" (benches have touched at {solved.contact.time:.6f} s)"
    assert captions[:2] == [f"Question 1: positions{text}", f"Question 1: speeds{text}"]
    assert not any(text in caption for caption in captions[2:])


def test_a_time_after_the_fold_is_refused_in_one_line(tmp_path: Path) -> None:
    done = run("contest", str(tmp_path), "--stop", "500")
    assert done.returncode == 2
    assert done.stderr.startswith("Error: stop must be at most 432.917924")
    assert done.stderr.count("\n") == 1


def test_other_numbers_give_other_answers_and_without_a_chinese_font_all_but_pictures(tmp_path: Path) -> None:
    done = kit_without(FONTS, tmp_path, "zh", "--benches", "40", "--stop", "60", "--span", "20")
    assert done.returncode == 1, done.stderr
    assert all((tmp_path / f"{name}.xlsx").is_file() for name in WORKBOOKS)
    assert sheets(tmp_path, "result1")[0].dimensions == "A1:BJ83"
    assert "共 40 节板凳" in (tmp_path / "report.md").read_text(encoding="utf-8")
    assert "fonts-wqy-microhei" in done.stderr
    assert not (tmp_path / "figures").exists()


@pytest.mark.parametrize(("pitch", "count"), [(0.55, 6), (0.8, 4)])
def test_sensitivity_shows_first_contact_where_there_is_one(
    pitch: float, count: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("app.contest.sensitivity.VALUES", 7)
    request = ContestRequest(benches=40, pitch=pitch, stop=10.0, span=10.0)
    drawn = panels(solve(request, Terms(), lambda share: None), Say(Language.ENGLISH))
    assert len(drawn) == count
    for panel in drawn:
        varied, result = zip(*panel.points, strict=True)
        assert min(varied) < panel.own[0] < max(varied), panel.varied
        assert min(result) < panel.own[1] < max(result), panel.answer
