"""The contest kit, written by the real command and read again by other programs."""

import csv
import io
import json
import math
import re
import subprocess
import sys
import threading
import time
from concurrent.futures import ThreadPoolExecutor
from functools import cache
from pathlib import Path
from zipfile import ZipFile

import numpy as np
import openpyxl
import pytest
from PIL import Image

from app.contest.figures import figures
from app.contest.kit import UNFINISHED
from app.contest.sensitivity import panels
from app.contest.solved import ContestRequest, solve
from app.contest.tables import paper_tables
from app.files import drawing
from app.files.tables import XLSX_TYPE
from app.grade.report import graded
from app.questions.contest_kit import ContestKitRequest, contest_kit
from app.settings import Settings
from app.wire.question import Terms
from core import Budget, TooMuchWork
from core.language import Language
from tests.support.asking import assert_problem
from tests.support.command import COMMAND, PATIENCE, refusal, run, said
from tests.support.depth import further
from tests.support.near import assert_near
from tests.support.paper import sheets_of
from tests.support.reference import reference
from tests.support.refusal_rows import assert_refused, assert_refused_in_one_line
from tests.test_docs import KITS, assert_alike

WORKBOOKS = ("result1", "result2", "result4")
CHINESE = ("--language", "zh", "--no-films")
# Tables of the paper, and the numbers in each.
TABLES = {"positions": 84, "speeds": 42, "contact": 21, "turn-positions": 70, "turn-speeds": 35}


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


def kit_without(missing, folder, language, *options):
    """A run of the command on a machine that lacks something. missing: code that hides it"""
    code = f"import sys\n{missing}\nfrom app.command.main import app\nsys.argv[0] = 'bench-dragon'\napp()"
    words = ["contest", folder, "--language", language, "--no-films", *options]
    command = [Path(COMMAND).with_name("python"), "-c", code, *words]
    done = subprocess.run(command, capture_output=True, text=True, timeout=PATIENCE)
    assert done.returncode == 1, done.stderr
    return done


@pytest.fixture(scope="module")
def chinese(tmp_path_factory):
    """Folder of a kit whose figures nobody can draw."""
    folder = tmp_path_factory.mktemp("zh")
    assert "错误：图和动画没有写出：" in kit_without(FIGURES_EXTRA, folder, "zh").stderr
    return folder


@pytest.fixture(scope="module")
def drawn(tmp_path_factory):
    """Folder of a whole kit, and what the command printed."""
    folder = tmp_path_factory.mktemp("drawn")
    return folder, said("contest", str(folder), *CHINESE, aside=None)


@cache
def sheets(folder, name):
    return openpyxl.load_workbook(folder / f"{name}.xlsx").worksheets


@pytest.fixture(scope="module", autouse=True)
def sheets_are_dropped():
    """No other tests keep the cells of the workbooks, 90 MB."""
    yield
    sheets.cache_clear()


@pytest.mark.thorough
@pytest.mark.chinese_font
def test_the_readme_shows_the_last_line_that_the_command_prints(drawn):
    [(_, session)] = KITS
    command, lines = session.splitlines()
    assert command == f"$ bench-dragon contest kit {' '.join(CHINESE)} 2>/dev/null | tail -1"
    assert_alike(drawn[1].splitlines()[-1], lines)


@pytest.mark.parametrize("name", WORKBOOKS)
def test_a_workbook_has_the_labels_of_the_contest_to_the_blank_and_right_numbers_of_six_decimals(chinese, name):
    for sheet, known in zip(sheets(chinese, name), reference("contest_workbooks")["workbooks"][name], strict=True):
        assert sheet.title == known["title"]
        assert sheet.dimensions == known["dimensions"]
        assert [cell.value for cell in sheet["A"]] == known["first_column"]
        top = [cell.value for cell in sheet[1]]
        assert top[:4] == known["first_row_start"]
        assert top[-1] == known["first_row_end"]
        assert sheet.freeze_panes == "B2"
        assert sheet["B2"].number_format == "0.000000"
        values = 1e6 * np.array([row[1:] for row in sheet.iter_rows(min_row=2, values_only=True)])
        assert np.abs(values - values.round()).max() < 1e-6
    result = graded(f"{name}.xlsx", (chinese / f"{name}.xlsx").read_bytes(), Budget())
    assert (result.workbook, result.verdict, result.diagnosis) == (name, "right", [])


def test_the_answers_are_those_of_the_references_with_brackets(chinese):
    answer = json.loads((chinese / "answers.json").read_bytes())
    assert [result["question"] for result in answer] == [1] * 5 + [2] * 2 + [3] + [4] * 7 + [5]
    assert all(result["how"] for result in answer)
    for k, value in ((5, 412.473837682), (7, 0.450337393028), (15, reference("maximum_head_speed")["head_speed"])):
        low, high = answer[k]["bracket"]
        assert low <= answer[k]["value"] <= high < low + 2e-9
        assert_near(answer[k]["value"], value, 1e-9)


@pytest.mark.parametrize("name", TABLES)
def test_a_table_says_the_same_in_every_format_and_the_grader_finds_every_number_right(chinese, name):
    files = {kind: (chinese / "tables" / f"{name}.{kind}").read_text(encoding="utf-8") for kind in ("csv", "md", "tex")}
    # Excel takes a CSV for UTF-8 if it begins with this mark.
    assert files["csv"].startswith("\ufeff")
    result = graded(f"{name}.csv", files["csv"].encode(), Budget())
    assert sum(sheet.right for sheet in result.sheets) == TABLES[name]
    assert result.diagnosis == []
    rows = list(csv.reader(files["csv"][1:].splitlines()))
    marked = [[cell.strip() for cell in line.strip("|").split("|")] for line in files["md"].splitlines()]
    latex = re.findall(r"^    (.*) \\\\$", files["tex"], re.MULTILINE)
    assert [marked[0], *marked[2:]] == rows
    assert [line.replace("$-$", "-").split(" & ") for line in latex] == rows
    assert not any(line.startswith("-") or " & -" in line for line in latex)
    assert files["tex"].count("\\toprule") == files["tex"].count("\\bottomrule") == 1


def assert_drawn(files):
    assert files["pdf"].startswith(b"%PDF-")
    assert b"/Type3" not in files["pdf"]  # journals refuse such fonts
    assert b"<svg" in files["svg"]
    with Image.open(io.BytesIO(files["png"])) as picture:
        assert min(picture.size) > 600
        assert len(picture.convert("L").getcolors()) > 20


def test_the_first_figure_shows_positions():
    solved = solve(ContestRequest(benches=9, stop=10.0, **NO_TURN), Terms(), lambda share: None)
    figure = next(figures(solved, lambda share: None))
    assert figure.name == "positions"
    assert_drawn(figure.files)


def links_of(page, folder):
    """Number of links of a report, each to a file that is there."""
    links = re.findall(r"\]\(([^)]+)\)", page)
    assert [link for link in links if not (folder / link).is_file()] == []
    return len(links)


def test_the_report_ties_everything_together(chinese):
    page = (chinese / "report.md").read_text(encoding="utf-8")
    assert links_of(page, chinese) > 15
    # bench-dragon shortest-turn, turn-time and quickest-turn --pitch 1.7 --turning-diameter 9, and with --ratio 1
    turns = ("13.621244907", "11.799152353", "1.822092554", "8.22398392", "10.92964", "12.09718", "10.7828")
    words = ("412.473837682", "0.450337393", *turns, "1.246266358", "板凳")
    assert [word for word in words if word not in page] == []
    row = r"^\| 2 \| 首次碰撞时刻 \| 412\.473837682 s \| [\d., ]+ s \| 0 号与 8 号板凳"
    assert re.search(row, page, re.MULTILINE)


def assert_on_paper(folder):
    """The report on paper has the rows of the other one, in order."""
    markdown = (folder / "report.md").read_text(encoding="utf-8")
    words = "".join("".join(sheets_of((folder / "report.pdf").read_bytes())).split())
    cells = re.findall(r"^\| (.+) \|$", markdown, re.MULTILINE)
    place = 0
    for cell in cells:
        row = "".join(cell.replace(" | ", "").split())
        place = place if "---" in cell else words.find(row, place)
        assert place >= 0, row


@pytest.mark.thorough
@pytest.mark.chinese_font
def test_the_report_leads_to_every_figure(drawn):
    assert_on_paper(drawn[0])
    assert len(sheets_of((drawn[0] / "report.pdf").read_bytes())) > 4
    assert links_of((drawn[0] / "report.md").read_text(encoding="utf-8"), drawn[0]) > 40


def test_an_english_archive_leads_to_no_figure_that_was_not_drawn(tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "matplotlib", None)
    request = ContestKitRequest(benches=9, stop=10.0, films=False, language=Language.ENGLISH, **NO_TURN)
    with ZipFile(io.BytesIO(contest_kit(request, Terms()))) as archive:
        archive.extractall(tmp_path)
    page = (tmp_path / "report.md").read_text(encoding="utf-8")
    assert links_of(page, tmp_path) > 9
    assert "Not in this kit: figures and films, because" in page.splitlines()[-1]
    assert "板凳" not in page


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
        # The files of a question about a turn that nobody can dance would say nothing.
        '{"question": 5, "turning_diameter": 3} -> /path 2.86 1.432',
    ],
)
def test_a_kit_beyond_a_limit_is_refused_before_any_work(client, row):
    assert_refused(client, "/contest-kit", {}, row)


@pytest.mark.parametrize("question, name", [(1, "result1.xlsx"), (2, "result2.xlsx"), (4, "result4.xlsx")])
def test_the_workbook_of_a_question_comes_alone_as_in_its_archive(client, question, name):
    body = {"benches": 5, "language": "en", "question": question, "films": False, "stop": 10, "span": 3}
    alone = client.post("/contest-kit", json=body, headers={"Accept": XLSX_TYPE}).raise_for_status()
    with ZipFile(io.BytesIO(client.post("/contest-kit", json=body).raise_for_status().content)) as archive:
        assert archive.read(name) == alone.content


@pytest.mark.parametrize("question", [None, 3, 5])
def test_a_question_without_a_workbook_has_none_alone(client, question):
    body = {"benches": 5, "question": question}
    refused = client.post("/contest-kit", json=body, headers={"Accept": XLSX_TYPE})
    assert_problem(refused, 422)
    assert refused.json()["errors"][0]["pointer"] == "/question"


def stopped(budget, listen, **more):
    """The refusal of a kit of five benches that is stopped."""
    with pytest.raises(TooMuchWork) as refusal:
        contest_kit(ContestKitRequest(benches=5, language=Language.ENGLISH, **more), Terms(Settings(), budget, listen))
    return refusal.value


@pytest.mark.parametrize("films", further([False, True], 1))
def test_a_kit_reports_its_progress_and_ends_when_it_is_stopped(films):
    shares = []
    budget = Budget(math.inf)

    def listen(share):
        shares.append(share)
        if share > (0.3 if films else 0.2):  # films come last
            budget.stop()

    assert stopped(budget, listen, films=films, seconds=4.0).field == "benches"
    assert shares == sorted(shares)
    assert shares[-1] < (1.0 if films else 0.5)


def test_a_kit_that_waits_for_other_drawings_ends_when_it_is_stopped():
    budget = Budget(math.inf)
    solved = threading.Event()

    def long():
        solved.wait(PATIENCE)
        time.sleep(10 * drawing.LOOK_SECONDS)  # the kit's first drawing stands behind this one meanwhile
        budget.stop()

    def listen(share):
        if share > 0.16:  # all answers are there, no figure
            solved.set()

    with ThreadPoolExecutor(1) as others:
        others.submit(drawing.in_turn, long)
        refusal = stopped(budget, listen, films=False)
    assert refusal.field == "benches"
    assert refusal.values["count"] == 5


def test_a_second_run_leaves_nothing_of_the_first_and_keeps_what_is_not_ours(tmp_path):
    ours = ("dance.gif", "turn.mp4", "figures/geometry.png", ".unfinished/result1.xlsx")
    mine = {"notes.txt", "figures/mine.png"}
    for name in (*ours, *mine):
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).write_text("old")
    options = ("--benches", "30", "--stop", "60", "--span", "20", "--turning-diameter", "4")
    done = kit_without(FONTS, tmp_path, "zh", *options)
    assert "问题 4 和 5 没有答案" in done.stderr
    entries = {str(file.relative_to(tmp_path)) for file in tmp_path.rglob("*") if file.is_file()}
    tables = {f"tables/{name}.{kind}" for name in [*TABLES][:3] for kind in ("csv", "md", "tex")}
    written = {"result1.xlsx", "result2.xlsx", "answers.json", "report.md", "report.pdf", ".contest.lock", *tables}
    assert entries == written | mine
    assert {one["question"] for one in json.loads((tmp_path / "answers.json").read_bytes())} == {1, 2, 3}
    assert "result4" not in (tmp_path / "report.md").read_text(encoding="utf-8")
    assert_on_paper(tmp_path)
    assert sheets(tmp_path, "result1")[0].dimensions == "A1:BJ63"


@pytest.mark.thorough
def test_a_second_run_into_the_same_folder_is_refused_until_the_first_has_ended_or_was_killed(tmp_path):
    run("--version")  # Without this the second run would first wait for the process that forks it.
    first = subprocess.Popen([COMMAND, "contest", tmp_path, "--no-films"], stderr=subprocess.DEVNULL)
    try:
        while not (tmp_path / UNFINISHED).is_dir():
            assert first.poll() is None
            time.sleep(0.02)
        words = f"Error: another run writes into {tmp_path}: wait until it is done, or give another FOLDER\n"
        assert refusal("contest", str(tmp_path), "--no-films") == words
        assert first.poll() is None  # The refusal did not wait for the first.
        assert (tmp_path / UNFINISHED).is_dir()
    finally:
        first.kill()
        first.wait()
    kit_without(FONTS, tmp_path, "zh", "--benches", "20")
    assert (tmp_path / "report.md").is_file()
    assert not (tmp_path / UNFINISHED).exists()


def test_a_folder_that_cannot_be_locked_and_a_time_after_the_fold_are_refused_in_one_line(tmp_path):
    assert_refused_in_one_line(f"contest {tmp_path} --stop 500 -> stop ... 432.917924")
    lock = tmp_path / "locked" / ".contest.lock"
    lock.mkdir(parents=True)
    assert_refused_in_one_line(f"contest {lock.parent} --no-films -> {lock}: cannot be locked")


def test_a_table_of_instants_after_the_contact_says_so():
    request = ContestRequest(benches=40, pitch=0.45, stop=300.0, **NO_TURN)
    solved = solve(request, Terms(), lambda share: None)
    captions = [table.caption for table in paper_tables(solved)]
    text = f" (benches have touched at {solved.contact.time:.6f} s)"
    assert captions[:2] == [f"Question 1: positions{text}", f"Question 1: speeds{text}"]
    assert not any(text in caption for caption in captions[2:])


def test_sensitivity_shows_first_contact(monkeypatch):
    monkeypatch.setattr("app.contest.sensitivity.VALUES", 7)
    solved = solve(ContestRequest(benches=40, stop=10.0, **NO_TURN), Terms(), lambda share: None)
    drawn = panels(solved)
    assert len(drawn) == 5
    for panel in drawn:
        varied, result = zip(*panel.points, strict=True)
        assert min(varied) < panel.own[0] < max(varied), panel.varied
        assert min(result) < panel.own[1] < max(result), panel.answer
