"""POST /grade on the real service: a file as the body, numbers in the query, a limit of its own, nothing kept."""

import json

import httpx
import pytest

from tests.support.asking import assert_problem
from tests.support.command import run
from tests.support.depth import further
from tests.support.serving import serving
from tests.support.students import SPIRAL_TIMES, by_xlsxwriter, contact_workbook, rows_of, spiral

FILE = {"Content-Type": "application/octet-stream"}


def graded(client, data, **query):
    answer = client.post("/grade", content=data, params=query, headers=FILE).raise_for_status()
    assert answer.headers["cache-control"] == "no-store"
    return answer.json()


@pytest.mark.parametrize("language", further(["en", "zh"], 1))
def test_the_service_answers_what_the_command_answers(client, tmp_path, language):
    file = tmp_path / "result2.xlsx"
    file.write_bytes(contact_workbook())
    answer = json.loads(run("grade", str(file), "--pitch", ".4202e0", "--language", language, "--json").stdout)
    answer["files"][0]["file"] = file.name
    assert graded(client, file.read_bytes(), name=file.name, pitch=".4202e0", language=language) == answer


def test_the_language_stated_comes_before_the_language_accepted(client):
    def answer(**query):
        sent = FILE | {"Accept-Language": "zh"}
        return client.post("/grade", content=b"a,b", params=query, headers=sent).json()

    assert answer() == answer(language="zh") != answer(language="en")


def test_a_file_beyond_the_limit_or_the_deadline_is_refused_and_nothing_of_it_is_logged(tmp_path):
    first = by_xlsxwriter(rows_of(spiral(), SPIRAL_TIMES))
    with serving(tmp_path / "log", grade_bytes_max=len(first), grade_seconds=0.2) as strict:
        large, late, _ = (
            httpx.post(f"{strict.url}/grade?name=secret.xlsx", content=content, headers=FILE, timeout=60)
            for content in (first + b"x", first, b"secret,words")
        )
    assert large.status_code == 413
    assert late.status_code == 422
    assert f"at most {len(first)} bytes, got {len(first) + 1}" in large.json()["detail"]
    assert "it was not graded within 0.2 s" in late.json()["detail"]
    log = strict.log.read_text()
    assert "POST /grade" in log
    assert "words" not in log


@pytest.mark.parametrize(
    "query, kind, content, status, words",
    [
        ("", "application/json", b"a,b", 415, "the file itself"),
        ("?pitch=wide", FILE["Content-Type"], b"a,b", 422, "pitch"),
        ("?language=fr", FILE["Content-Type"], b"a,b", 422, "language"),
        ("?colour=red", FILE["Content-Type"], b"a,b", 422, '"colour" is unknown'),
        ("", FILE["Content-Type"], b"", 422, "Send a workbook or CSV as the body"),
    ],
)
def test_wrong_requests_get_a_clear_word(client, query, kind, content, status, words):
    answer = client.post(f"/grade{query}", content=content, headers={"Content-Type": kind})
    assert_problem(answer, status)
    assert words in answer.json()["detail"]


@pytest.mark.parametrize("name", ["%C0%EE.csv", "%ED%B2%80.csv", "%FF"])
def test_a_name_in_another_encoding_is_no_obstacle(client, name):
    answer = client.post(f"/grade?name={name}", content=b"a,b", headers=FILE).raise_for_status()
    assert answer.json()["files"][0]["verdict"] == "unreadable"


@pytest.mark.parametrize(
    "name, text, notes",
    [
        ("pitch", "0,450338", ["Read as 0.450338.", "The comma counts as the decimal point."]),
        ("pitch", "0.450338 m", ["Read as 0.450338.", "The unit m is meant anyway and need not be written."]),
        ("speed", "1.246266M/S", ["Read as 1.246266.", "The unit m/s is meant anyway and need not be written."]),
        ("collision_time", " 412.473838 ", []),
        ("turn_length", "１３．６２１２４５", ["Read as 13.621245.", "Its digits are full-width ones"]),
        ("collision_time", "４１２，４７３８３８ 秒", ["Read as 412.473838.", "Its digits", "The unit s", "The comma"]),
        ("pitch", "45.0338 cm", ["Read as 0.450338.", "It was written in cm and is converted to m."]),
        ("pitch", "0。450338", ["Read as 0.450338.", "Its digits are full-width ones"]),
    ],
)
def test_a_number_is_read_as_people_type_it_and_notes_say_how(client, name, text, notes):
    [answer] = (
        client.post("/grade", params={name: text}, content=b"", headers=FILE).raise_for_status().json()["answers"]
    )
    assert answer["verdict"] == "right"
    assert [said[: len(words)] for said, words in zip(answer["notes"], notes, strict=False)] == notes


@pytest.mark.parametrize(
    "name, text, words",
    [
        ("pitch", "45.04", "in cm; the contest asks for m, which makes it 0.4504 m."),
        ("collision_time", "6.8746", "in min; the contest asks for s, which makes it 412.48 s."),
        ("speed", "4.4866", "in km/h; the contest asks for m/s, which makes it 1.24628 m/s."),
        ("pitch", "45.2", "it is 44.7 m larger than the smallest"),
    ],
)
def test_a_wrong_number_that_is_right_in_another_unit_is_recognised(client, name, text, words):
    [answer] = client.post("/grade", params={name: text}, content=b"", headers=FILE).json()["answers"]
    assert answer["verdict"] == "wrong"
    assert words in answer["notes"][0]


@pytest.mark.parametrize(
    "text, sentence",
    [
        ("45.03 ft", "“Length of the turn” must be in m, without another unit, got '45.03 ft'."),
        ("abc", "“Length of the turn” must be a number [m] in digits, such as 12.345, got 'abc'."),
        ("十三", "“Length of the turn” must be a number [m] in digits, such as 12.345, got '十三'."),
    ],
)
def test_what_is_no_number_of_its_unit_is_refused_in_a_sentence(client, text, sentence):
    problem = client.post("/grade", params={"turn_length": text}, content=b"", headers=FILE)
    assert_problem(problem, 422)
    assert problem.json()["sentence"] == sentence
