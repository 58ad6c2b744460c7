"""The contest kit, written by the real command and read again by other programs."""

from __future__ import annotations

import csv
import io
import json
import math
import re
import subprocess
import sys
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
from app.contest.figures import figures
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
from tests.support.command import COMMAND, PATIENCE, run
from tests.support.reference import reference
from tests.support.refusal_rows import assert_refused, assert_refused_in_one_line
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
# Numbers whose turn cannot be danced, which takes no time to find out.
NO_TURN = {"ratio": 100.0, "span": 10.0}


def kit_without(missing: str, folder: Path, language: str, *options: str) -> subprocess.CompletedProcess[str]:
    """A run of the command on a machine that lacks something. missing: code that hides it"""
    code = f"import sys\n{missing}\nfrom app.command.main import app\nsys.argv[0] = 'bench-dragon'\napp()"
    words = ["contest", folder, "--language", language, "--no-films", *options]
    command = [Path(COMMAND).with_name("python"), "-c", code, *words]
    done = subprocess.run(command, capture_output=True, text=True, timeout=PATIENCE)
    assert done.returncode == 1, done.stderr
    return done


def bare(language: str, factory: pytest.TempPathFactory) -> Path:
    """Folder of a kit whose figures nobody can draw."""
    folder = factory.mktemp(language)
    assert "Error: figures and films were not written: " in kit_without(FIGURES_EXTRA, folder, language).stderr
    return folder


@pytest.fixture(scope="module")
def chinese(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return bare("zh", tmp_path_factory)


@pytest.fixture(scope="module")
def english(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return bare("en", tmp_path_factory)


@pytest.fixture(scope="module")
def drawn(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, str]:
    """Folder of a whole kit, and what the command printed."""
    folder = tmp_path_factory.mktemp("drawn")
    done = run("contest", str(folder), *CHINESE)
    assert done.returncode == 0, done.stderr
    return folder, done.stdout


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


@pytest.mark.thorough
@pytest.mark.chinese_font
def test_the_readme_shows_the_last_line_that_the_command_prints(drawn: tuple[Path, str]) -> None:
    [(_, session)] = KITS
    command, lines = session.splitlines()
    assert command == f"$ bench-dragon contest kit {' '.join(CHINESE)} 2>/dev/null | tail -1"
    assert_alike(drawn[1].splitlines()[-1], lines)


@pytest.mark.parametrize("name", WORKBOOKS)
def test_a_workbook_has_the_labels_of_the_contest_to_the_blank_and_numbers_of_six_decimals(
    chinese: Path, name: str
) -> None:
    for sheet, known in zip(sheets(chinese, name), reference("contest_workbooks")["workbooks"][name], strict=True):
        assert (sheet.title, sheet.dimensions) == (known["title"], known["dimensions"])
        assert [cell.value for cell in sheet["A"]] == known["first_column"]
        top = [cell.value for cell in sheet[1]]
        assert (top[:4], top[-1]) == (known["first_row_start"], known["first_row_end"])
        assert sheet.freeze_panes == "B2"
        assert sheet.column_dimensions["A"].width > 15
        cells = [cell for row in sheet.iter_rows(min_row=2, min_col=2) for cell in row]
        assert {(cell.data_type, cell.number_format) for cell in cells} == {("n", "0.000000")}
        assert all(abs(cell.value * 1e6 - round(cell.value * 1e6)) < 1e-6 for cell in cells)


@pytest.mark.thorough
@pytest.mark.parametrize("name", WORKBOOKS)
def test_english_workbooks_have_the_same_numbers_in_the_same_cells(chinese: Path, english: Path, name: str) -> None:
    words, result = written(english, name)
    assert {"head", "tail (rear)"} <= {re.sub(r"(?<=[d)]) ?[xy(].*", "", word) for word in words}
    assert all(word.isascii() for word in words)
    assert result == written(chinese, name)[1]
    assert sum(map(len, result)) == sum(numbers(sheet).size for sheet in sheets(chinese, name))


@pytest.mark.parametrize(("name", "first", "own_words"), [("result1", 0, "trajectory"), ("result4", -100, "turn")])
def test_workbooks_hold_the_reference_numbers(chinese: Path, name: str, first: int, own_words: str) -> None:
    place, speed = map(numbers, sheets(chinese, name))
    known = reference(own_words)
    instants = known["tables"] if own_words == "turn" else [*known["selected"], *known["full"]]
    columns = [(round(one["time"]) - first, one["handles"]) for one in instants if float(one["time"]).is_integer()]
    inside = [(column, handle) for column, handles in columns if column < place.shape[1] for handle in handles]
    assert len({column for column, _ in inside}) >= 3
    for column, one in inside:
        k = one["handle"]
        result = [*place[2 * k : 2 * k + 2, column], speed[k, column]]
        assert result == pytest.approx([one["x"], one["y"], one["speed"]], rel=0, abs=SIX_DECIMALS)


def test_the_second_workbook_holds_the_dance_at_first_contact(chinese: Path) -> None:
    table = numbers(sheets(chinese, "result2")[0])
    handles = reference("trajectory")["full"][-1]["handles"]
    assert len(handles) == len(table) == 224
    values = np.array([[one["x"], one["y"], one["speed"]] for one in handles])
    # The reference's instant is 1e-9 s from ours at most, and handles move at 1 m/s.
    assert np.abs(table - values).max() <= SIX_DECIMALS + 1e-9


def test_the_answers_are_those_of_the_references_with_brackets(chinese: Path) -> None:
    answer = json.loads((chinese / "answers.json").read_bytes())
    assert [one["question"] for one in answer] == [1, 1, 1, 1, 1, 2, 2, 3, 4, 4, 4, 4, 4, 4, 4, 5]
    assert all(one["how"] for one in answer)
    wanted = {2: 412.473837682, 3: 0.450337393028, 5: reference("maximum_head_speed")["head_speed"]}
    for question, value in wanted.items():
        one = next(one for one in answer if one["question"] == question)
        low, high = one["bracket"]
        assert low <= one["value"] <= high < low + 2e-9
        assert one["value"] == pytest.approx(value, abs=1e-9)
    length, shorter, saved, even, *times = (one["value"] for one in answer if one["question"] == 4)
    # bench-dragon shortest-turn --pitch 1.7 --turning-diameter 9, and with --ratio 1
    assert [length, shorter, even] == pytest.approx([13.6212449, 11.799152353, 8.223983925], abs=5e-8)
    assert saved == length - shorter
    assert times[:2] == pytest.approx([10.92964, 12.09719], abs=1e-5)
    assert times[2] < times[0]


@pytest.mark.parametrize("name", TABLES)
def test_a_table_says_the_same_in_every_format(chinese: Path, name: str) -> None:
    files = {kind: (chinese / "tables" / f"{name}.{kind}").read_text(encoding="utf-8") for kind in ("csv", "md", "tex")}
    # Excel takes a CSV for UTF-8 if it begins with this mark.
    assert files["csv"].startswith("\ufeff")
    rows = list(csv.reader(files["csv"][1:].splitlines()))
    marked = [[cell.strip() for cell in line.strip("|").split("|")] for line in files["md"].splitlines()]
    latex = re.findall(r"^    (.*) \\\\$", files["tex"], re.MULTILINE)
    assert [marked[0], *marked[2:]] == rows
    assert [line.replace("$-$", "-").split(" & ") for line in latex] == rows
    assert not any(line.startswith("-") or " & -" in line for line in latex)
    assert files["tex"].count("\\toprule") == files["tex"].count("\\bottomrule") == 1


def test_the_paper_s_tables_hold_the_reference_numbers(chinese: Path) -> None:
    rows = list(csv.reader((chinese / "tables" / "positions.csv").read_text(encoding="utf-8-sig").splitlines()))[1:]
    selected = reference("trajectory")["selected"]
    assert len(selected) == len(rows[0]) - 1 == 6
    for column, one in enumerate(selected, start=1):
        places = [(one["handles"][k // 2]["x" if k % 2 == 0 else "y"], rows[k][column]) for k in range(len(rows))]
        assert max(abs(wanted - float(text)) for wanted, text in places) <= SIX_DECIMALS


def assert_drawn(files: dict[str, bytes]) -> None:
    assert files["pdf"].startswith(b"%PDF-")
    assert b"/Type3" not in files["pdf"]  # journals refuse such fonts
    assert b"<svg" in files["svg"]
    with Image.open(io.BytesIO(files["png"])) as picture:
        assert min(picture.size) > 600
        assert len(picture.convert("L").getcolors()) > 20


@pytest.mark.thorough
@pytest.mark.chinese_font
@pytest.mark.parametrize("name", FIGURES)
def test_a_figure_is_drawn_in_three_formats(drawn: tuple[Path, str], name: str) -> None:
    assert_drawn({kind: (drawn[0] / "figures" / f"{name}.{kind}").read_bytes() for kind in ("pdf", "svg", "png")})


def test_the_first_figure_shows_positions() -> None:
    solved = solve(ContestRequest(benches=9, stop=10.0, **NO_TURN), Terms(), lambda share: None)
    figure = next(figures(solved, Say(Language.ENGLISH), lambda share: None))
    assert figure.name == "positions"
    assert_drawn(figure.files)


def links_of(page: str, folder: Path) -> int:
    """Number of links of a report, each to a file that is there."""
    links = re.findall(r"\]\(([^)]+)\)", page)
    assert [link for link in links if not (folder / link).is_file()] == []
    return len(links)


def test_the_report_ties_everything_together(chinese: Path) -> None:
    page = (chinese / "report.md").read_text(encoding="utf-8")
    assert links_of(page, chinese) > 15
    numbers_of_all = ("412.473837682", "0.450337393", "13.6212449", "8.2239839", "1.246266358", "板凳")
    assert [number for number in numbers_of_all if number not in page] == []
    row = r"^\| 2 \| 首次碰撞时刻 \| 412\.473837682 s \| [\d., ]+ s \| 第 0 节与第 8 节板凳"
    assert re.search(row, page, re.MULTILINE)


@pytest.mark.thorough
@pytest.mark.chinese_font
def test_the_report_leads_to_every_figure(drawn: tuple[Path, str]) -> None:
    assert links_of((drawn[0] / "report.md").read_text(encoding="utf-8"), drawn[0]) > 40


@pytest.mark.thorough
def test_an_english_report_names_what_touches(english: Path) -> None:
    page = (english / "report.md").read_text(encoding="utf-8")
    row = r"^\| 2 \| first contact \| 412\.473837682 s \| [\d., ]+ s \| benches 0 and 8 touch; 139 proven"
    assert re.search(row, page, re.MULTILINE)


def test_an_english_archive_leads_to_no_figure_that_was_not_drawn(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, "matplotlib", None)
    request = ContestKitRequest(benches=9, stop=10.0, films=False, language=Language.ENGLISH, **NO_TURN)
    with ZipFile(io.BytesIO(contest_kit(request, Terms()))) as archive:
        assert archive.namelist()[-1] == "report.md"
        archive.extractall(tmp_path)
    page = (tmp_path / "report.md").read_text(encoding="utf-8")
    assert links_of(page, tmp_path) > 9
    assert "| 2 | " in page
    assert "Not in this kit: figures and films, because" in page.splitlines()[-1]
    assert "板凳" not in page


@pytest.mark.thorough
@pytest.mark.chinese_font
def test_the_service_makes_the_same_files_in_one_archive(drawn: tuple[Path, str], patient: str) -> None:
    folder, _ = drawn
    body = {"language": "zh", "films": False}
    got = httpx.post(f"{patient}/contest-kit", json=body, timeout=600).raise_for_status()
    assert got.headers["content-type"] == "application/zip"
    with ZipFile(io.BytesIO(got.content)) as archive:
        files = {name: archive.read(name) for name in archive.namelist()}
    written = [file for file in folder.rglob("*") if file.is_file() and not file.name.startswith(".")]
    assert files == {file.relative_to(folder).as_posix(): file.read_bytes() for file in written}
    assert list(files)[-1] == "report.md"


@pytest.mark.parametrize(
    "row",
    [
        '{"benches": 2001} -> /benches 2000 2001',
        '{"stop": 1e5} -> /stop 200000 44800448',
        '{"span": 1e5} -> /span 200000 89600448',
        '{"seconds": 120} -> /seconds 4000 14930',
        '{"overhang": 2} -> /overhang head_length',
        '{"language": "fr"} -> /language "en" "zh"',
        '{"folder": "kit"} -> /folder unknown',
    ],
)
def test_a_kit_beyond_a_limit_is_refused_before_any_work(client: httpx.Client, row: str) -> None:
    assert_refused(client, "/contest-kit", {}, row)


def test_a_kit_reports_its_progress_and_ends_when_it_is_stopped() -> None:
    shares: list[float] = []
    budget = Budget(math.inf)

    def listen(share: float) -> None:
        shares.append(share)
        if share > 0.2:
            budget.stop()

    request = ContestKitRequest(benches=5, films=False, language=Language.ENGLISH)
    with pytest.raises(TooMuchWork) as stopped:
        contest_kit(request, Terms(Settings(), budget, listen))
    assert stopped.value.field == "benches"
    assert shares == sorted(shares)
    assert shares[-1] < 0.5


def test_a_second_run_leaves_nothing_of_the_first_and_keeps_what_is_not_ours(tmp_path: Path) -> None:
    ours = ("dance.gif", "turn.mp4", "figures/geometry.png", ".unfinished/result1.xlsx")
    mine = ("notes.txt", "figures/mine.png")
    for name in (*ours, *mine):
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).write_text("old")
    options = ("--benches", "30", "--stop", "60", "--span", "20", "--turning-diameter", "4")
    done = kit_without(FONTS, tmp_path, "zh", *options)
    assert "questions 4 and 5 have no answer: path must not bend tighter than" in done.stderr
    assert "change --turning-diameter, --turn-pitch or --ratio" in done.stderr
    assert "fonts-wqy-microhei" in done.stderr
    entries = {str(file.relative_to(tmp_path)) for file in tmp_path.rglob("*") if file.is_file()}
    tables = {f"tables/{name}.{kind}" for name in TABLES[:3] for kind in ("csv", "md", "tex")}
    assert entries == {"result1.xlsx", "result2.xlsx", "answers.json", "report.md", ".contest.lock", *tables, *mine}
    answer = json.loads((tmp_path / "answers.json").read_bytes())
    assert {one["question"] for one in answer} == {1, 2, 3}
    report = (tmp_path / "report.md").read_text(encoding="utf-8")
    assert "共 30 节板凳" in report
    assert "result4" not in report
    assert sheets(tmp_path, "result1")[0].dimensions == "A1:BJ63"


@pytest.mark.thorough
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
    kit_without(FONTS, tmp_path, "zh", "--benches", "20")
    assert (tmp_path / "report.md").is_file()
    assert not (tmp_path / UNFINISHED).exists()


def test_a_folder_that_cannot_be_locked_and_a_time_after_the_fold_are_refused_in_one_line(tmp_path: Path) -> None:
    assert_refused_in_one_line(f"contest {tmp_path} --stop 500 -> stop ... 432.917924")
    lock = tmp_path / "locked" / ".contest.lock"
    lock.mkdir(parents=True)
    assert_refused_in_one_line(f"contest {lock.parent} --no-films -> {lock}: cannot be locked")


def test_a_run_without_contact_says_why_it_ends() -> None:
    request = ContestRequest(benches=40, pitch=0.8, stop=10.0, **NO_TURN)
    results = answers(solve(request, Terms(), lambda share: None), Say(Language.ENGLISH))
    [one] = [one for one in results if one.question == 2]
    assert re.fullmatch(r"the run ends there: bench \d+ folds and cannot follow any further", one.how)


def test_a_table_of_instants_after_the_contact_says_so() -> None:
    request = ContestRequest(benches=40, pitch=0.45, stop=300.0, **NO_TURN)
    solved = solve(request, Terms(), lambda share: None)
    captions = [table.caption for table in paper_tables(solved, Say(Language.ENGLISH))]
    text = f" (benches have touched at {solved.contact.time:.6f} s)"
    assert captions[:2] == [f"Question 1: positions{text}", f"Question 1: speeds{text}"]
    assert not any(text in caption for caption in captions[2:])


@pytest.mark.parametrize(
    ("changes", "count"),
    [({}, 5), ({"pitch": 0.8}, 3), pytest.param({"ratio": 2.0}, 6, marks=pytest.mark.thorough)],
    ids=["contact", "no contact", "contact and turn"],
)
def test_sensitivity_shows_first_contact_where_there_is_one(
    changes: dict[str, float], count: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("app.contest.sensitivity.VALUES", 7)
    request = ContestRequest(benches=40, stop=10.0, **NO_TURN | changes)
    drawn = panels(solve(request, Terms(), lambda share: None), Say(Language.ENGLISH))
    assert len(drawn) == count
    for panel in drawn:
        varied, result = zip(*panel.points, strict=True)
        assert min(varied) < panel.own[0] < max(varied), panel.varied
        assert min(result) < panel.own[1] < max(result), panel.answer
