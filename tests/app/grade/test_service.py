"""POST /grade on the real service: a file as the body, numbers in the query, a limit of its own, nothing kept."""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path

import httpx
import numpy as np
import pytest

from tests.support.serving import Service, serving
from tests.support.students import CONTACT, SPIRAL_TIMES, contact_workbook, spiral, workbook

FILE = {"Content-Type": "application/octet-stream"}


def graded(client: httpx.Client, data: bytes, **query: str) -> dict[str, object]:
    answer = client.post("/grade", content=data, params=query, headers=FILE).raise_for_status()
    assert answer.headers["cache-control"] == "no-store"
    return dict(answer.json())


@pytest.fixture(scope="module")
def second() -> bytes:
    return contact_workbook(spiral(np.array([CONTACT])))


@pytest.fixture(scope="module")
def first() -> bytes:
    return workbook(spiral(), SPIRAL_TIMES)


def test_the_service_answers_what_the_command_answers(client: httpx.Client, second: bytes, tmp_path: Path) -> None:
    from tests.support.command import run

    file = tmp_path / "result2.xlsx"
    file.write_bytes(second)
    for language in ("en", "zh"):
        answer = json.loads(run("grade", str(file), "--pitch", "0.4202", "--language", language, "--json").stdout)
        answer["files"][0]["file"] = "result2.xlsx"
        assert graded(client, second, name="result2.xlsx", pitch="0.4202", language=language) == answer


def test_a_file_longer_than_other_bodies_is_taken(client: httpx.Client) -> None:
    # A full result1 of 17 digits, stored rather than packed tightly, and padded beyond the limit of other bodies.
    data = workbook(spiral(), SPIRAL_TIMES, 15)
    assert graded(client, data, name="result1.xlsx")["files"][0]["verdict"] == "right"  # type: ignore[index]
    [file] = graded(client, b"text " * 1_000_000)["files"]  # type: ignore[misc]
    assert file["verdict"] == "unreadable"


def test_a_typed_answer_that_is_no_number_is_refused_in_words(client: httpx.Client) -> None:
    answer = client.post("/grade?pitch=abc")
    assert answer.status_code == 422
    assert answer.json()["detail"] == 'pitch must be a number [m] in digits, such as 0.4503, got "abc"'


@pytest.fixture(scope="module")
def strict(tmp_path_factory: pytest.TempPathFactory, first: bytes) -> Iterator[Service]:
    """A service that takes files of one length at most, and grades for a moment only."""
    log = tmp_path_factory.mktemp("strict") / "log"
    with serving(log, grade_bytes_max=len(first), grade_seconds=0.2) as service:
        yield service


def test_a_file_beyond_the_limit_is_refused(strict: Service, first: bytes) -> None:
    answer = httpx.post(f"{strict.url}/grade", content=first + b"x", headers=FILE, timeout=60)
    assert answer.status_code == 413
    words = f"The body must be at most {len(first)} bytes, got {len(first) + 1}: ask for less in one request."
    assert answer.json()["detail"] == words


def test_the_deadline_ends_the_grading(strict: Service, first: bytes) -> None:
    answer = httpx.post(f"{strict.url}/grade", content=first, headers=FILE, timeout=60)
    assert answer.status_code == 422
    assert "it was not graded within 0.2 s" in answer.json()["detail"]


def test_nothing_of_the_file_is_logged(strict: Service) -> None:
    httpx.post(f"{strict.url}/grade?name=secret.xlsx", content=b"secret,words", headers=FILE, timeout=60)
    log = strict.log.read_text()
    assert "POST /grade" in log
    assert "words" not in log


@pytest.mark.parametrize(
    ("query", "headers", "status", "words"),
    [
        ({}, {"Content-Type": "application/json"}, 415, "The body must be the file itself"),
        ({"pitch": "wide"}, FILE, 422, "pitch"),
        ({"language": "fr"}, FILE, 422, "language must be"),
        ({"colour": "red"}, FILE, 422, '"colour" is unknown here'),
    ],
)
def test_wrong_requests_get_a_clear_word(
    client: httpx.Client, query: dict[str, str], headers: dict[str, str], status: int, words: str
) -> None:
    answer = client.post("/grade", content=b"a,b", params=query, headers=headers)
    assert (answer.status_code, answer.headers["content-type"]) == (status, "application/problem+json")
    assert words in answer.json()["detail"]


@pytest.mark.parametrize("name", ["%C0%EE.csv", "%ED%B2%80.csv", "%FF"])
def test_a_name_in_another_encoding_is_no_obstacle(client: httpx.Client, name: str) -> None:
    answer = client.post(f"/grade?name={name}", content=b"a,b", headers=FILE).raise_for_status()
    assert answer.json()["files"][0]["verdict"] == "unreadable"


def test_a_guess_stands_beside_the_diagnosis(client: httpx.Client) -> None:
    [answer] = client.post("/grade?pitch=0.4202").raise_for_status().json()["answers"]
    [guess] = answer["possible"]
    assert (answer["verdict"], answer["diagnosis"], guess["error"]) == ("wrong", [], "pose_on_circle")
    assert 0.01 < guess["probability"] < 0.05


def test_nothing_to_grade_is_refused(client: httpx.Client) -> None:
    answer = client.post("/grade")
    assert answer.status_code == 422
    assert answer.json()["detail"].startswith("Send a workbook or CSV as the body")
