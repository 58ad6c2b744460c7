"""The five questions of the contest on a strip: answers, what is handed in, and a check of one's own in place."""

import re
from io import BytesIO
from zipfile import ZipFile

import pytest

from tests.support.students import contact_workbook

STRIP = "?door=contest&time=end"
PNG = b"\x89PNG\r\n\x1a\n" + bytes(200)


@pytest.fixture(scope="module")
def files(tmp_path_factory):
    folder = tmp_path_factory.mktemp("mine")
    contents = {"result2.xlsx": contact_workbook(), "screenshot.png": PNG}
    for name, data in contents.items():
        (folder / name).write_bytes(data)
    return [folder / name for name in contents]


def test_a_student_finds_all_five_answers_checks_their_own_and_hands_in(open_page, files):
    person = open_page(STRIP).presses("#to-five").sees({"#five-cards li": 5, "#question-5 .value": "1.246266 m/s"})
    person.reads({"#question-2 .value": "412.473838 s", "#question-3 .value": "0.450338 m"})
    person.sees({"#question-4 .value": "13.621245 m", "#question-4": "no ratio changes this length"})
    assert person.findings("#five") == []
    # In place: a right number with its unit, a wrong one, a workbook, a screenshot.
    person.types({"#mine-3": "0.450338 m"}).sees({"#question-3 .verdicts": ["right", "Read as 0.450338."]})
    person.types({"#mine-5": "1.3"}).sees({"#question-5 .verdicts": "infeasible"})
    # A verdict is of the number that stands there.
    person.at("#mine-5").fill("")
    person.sees({"#question-5 .verdicts > *": 0})
    for file, words in zip(files, ("right", "The file is a picture, such as a screenshot"), strict=True):
        person.takes(file, "#question-2 input[type=file]").sees({"#question-2 .verdicts": words})
    # As a job, so that a busy machine has the time that it needs.
    data = person.saves("#question-2 .buttons button:last-child", "bench-dragon-question-2.zip")
    with ZipFile(BytesIO(data)) as archive:
        assert {"result2.xlsx", "figures/clearance.pdf"} <= set(archive.namelist())
    person.sees({"#question-2 .made a": "bench-dragon-question-2.zip", "#jobs li": "Question 2"})
    # The archive is judged as it was handed out, and so is the workbook alone.
    archive = files[0].with_name("bench-dragon-question-2.zip")
    archive.write_bytes(data)
    person.takes(archive, "#question-2 input[type=file]").sees({"#question-2 .verdicts h3": "result2.xlsx"})
    person.sees({"#question-2 .verdicts": "672 of 672 cells right"})
    alone = person.saves("#question-2 .buttons button:has-text('Hand in')", "result2.xlsx")
    with ZipFile(BytesIO(data)) as whole, ZipFile(BytesIO(alone)) as book:
        assert whole.read("result2.xlsx") == alone
        assert "xl/workbook.xml" in book.namelist()
    person.speaks("zh").sees({"#question-4": "任何半径比都不改变这一长度", "#question-3 .verdicts": "正确"})


def test_a_dance_of_an_answer_is_shown_with_the_contests_numbers(open_page):
    person = open_page(f"{STRIP}&benches=20&pitch=0.7").presses("#to-five").sees({"#question-5 .value": True})
    person.presses("#question-5 .buttons button:first-child").arrives("**path=turn**")
    person.settles().holds({"#benches": "223", "#pitch": "1.7", "#head_speed": re.compile("^1.24626635")})
    assert person.address()["handle"] == "3"
    person.sees({"#head-speed .value": "1.246 m/s"})
    # The map of turns by keys: the marker begins at the contest's turn.
    person.presses("#question-4 button:has-text('How much shorter?')").sees(
        {"#question-4 output": "2 : 1, 4.5 m: 13.621 m"}
    )
    person.at("#question-4 .turns").press("ArrowDown")
    person.sees({"#question-4 output": "2 : 1, 4.303 m: 13.003 m"})
    person.at("#question-4 .turns").press("Enter")
    person.settles().holds({"#ratio": "2", "#entry_radius": "4.303"})
