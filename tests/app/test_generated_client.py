"""A client that openapi-python-client makes from /openapi.json asks the running service every question."""

from __future__ import annotations

import importlib
import inspect
import io
import json
import os
import re
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from types import ModuleType
from typing import Any, get_args

import httpx
import numpy as np
import pytest
from attrs import evolve

from app.files.tables import XLSX_TYPE
from app.questions.registry import QUESTIONS
from app.service.examples import EXAMPLES
from tests.app.conftest import ANSWER_TIMEOUT
from tests.support.depth import some
from tests.support.students import CONTACT, contact_workbook, spiral

PACKAGE = "generated_client"
WARNING = re.compile(r"^(?:WARNING|ERROR) parsing \S+ (\S+)", re.MULTILINE)
# Every call: its name, its method and its question.
CALLS = [
    (f"{question.name}_of" if question.flat and method == "POST" else question.name, method, question)
    for question in QUESTIONS.values()
    for method, request in (("GET", question.flat), ("POST", question.body))
    if request
]


@pytest.fixture(scope="module")
def words(server: str, tmp_path_factory: pytest.TempPathFactory) -> Iterator[str]:
    """Output of the generator, with its warnings; the client that it makes can be imported as PACKAGE."""
    folder = tmp_path_factory.mktemp("client")
    command = [sys.executable, "-m", "openapi_python_client", "generate", "--meta", "none"]
    command += ["--url", f"{server}/openapi.json", "--output-path", str(folder / PACKAGE)]
    path = os.pathsep.join([str(Path(sys.executable).parent), os.environ.get("PATH", "")])
    done = subprocess.run(command, cwd=folder, env=os.environ | {"PATH": path}, capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr
    sys.path.insert(0, str(folder))
    yield done.stdout + done.stderr
    sys.path.remove(str(folder))


@pytest.fixture(scope="module")
def own(words: str, server: str) -> Any:
    """The generated client of the running service."""
    client = importlib.import_module(f"{PACKAGE}.client")
    return client.Client(base_url=server, timeout=httpx.Timeout(ANSWER_TIMEOUT))


def call(tag: str, name: str) -> ModuleType:
    return importlib.import_module(f"{PACKAGE}.api.{tag}.{name}")


def body_of(module: ModuleType, body: Any) -> Any:
    """The body as the type that the generated call takes."""
    annotation = inspect.signature(module.sync_detailed, eval_str=True).parameters["body"].annotation
    kind = next(kind for kind in get_args(annotation) or (annotation,) if hasattr(kind, "from_dict"))
    return kind.from_dict(body)


def test_the_generator_warns_of_nothing_but_pictures_and_files(words: str) -> None:
    warned = WARNING.findall(words)
    assert len(warned) == words.count("WARNING") + words.count("ERROR")
    files = {question.path for question in QUESTIONS.values() if question.model is None}
    assert set(warned) == files - {QUESTIONS["maps"].path}  # Every map comes back as a file of bytes.


@pytest.mark.parametrize(
    ("name", "method", "question"), [c for c in CALLS if c[2].model], ids=[c[0] for c in CALLS if c[2].model]
)
def test_every_question_is_answered(own: Any, client: httpx.Client, name: str, method: str, question: Any) -> None:
    module, example = call("questions", name), EXAMPLES[f"{method} {question.path}"]
    request = example.query if example.body is None else {"body": body_of(module, example.body)}
    answer = module.sync(client=own, **request)
    response = client.request(method, question.path, params=example.query, json=example.body)
    assert answer.to_dict() == response.raise_for_status().json()


DRAWN = [c for c in CALLS if c[2].formats]


@pytest.mark.parametrize(
    ("name", "method", "formats"), [(*c[:2], c[2].formats) for c in DRAWN], ids=[c[0] for c in DRAWN]
)
def test_every_figure_is_drawn(own: Any, name: str, method: str, formats: Any) -> None:
    module = call("figures", name)
    known = importlib.import_module(f"{PACKAGE}.models.{'map_format' if name == 'maps' else 'format_'}")
    formats = known.MapFormat if name == "maps" else known.Format
    scan = {"samples": 3} if name.startswith("pitch_scan") else {}
    small: dict[str, Any] = scan | ({"benches": 9} if method == "GET" else {"dragon": {"benches": 9}})
    if name == "encounter_figure":
        small = {"dances": [small]}
    request = small if method == "GET" else {"body": body_of(module, small)}
    begins = {"svg": b"<?xml", "png": b"\x89PNG", "geojson": b"{", "kml": b"<?xml", "dxf": b"  0\n"}
    if name == "maps":
        request = {"body": body_of(module, small | {"origin": {"longitude": 8.5, "latitude": 47.4}})}
    for ending in formats:
        answer = module.sync_detailed(formats(ending), client=own, **request)
        assert answer.status_code == 200
        assert answer.content.startswith(begins[ending])


def test_a_refusal_comes_back_as_a_problem(own: Any) -> None:
    problem = call("questions", "collision_time").sync(client=own, overhang=2.0)
    assert (problem.status, type(problem).__name__) == (422, "Problem")
    assert problem.errors[0].name == "overhang"


def test_a_file_is_graded(own: Any) -> None:
    module, types = call("grading", "grade"), importlib.import_module(f"{PACKAGE}.types")
    file = types.File(payload=io.BytesIO(contact_workbook(spiral(np.array([CONTACT])))))
    answer = module.sync(client=own, body=file, name="result2.xlsx", pitch="0.450337393")
    assert (answer.files[0].workbook, answer.files[0].verdict, answer.files[0].diagnosis) == ("result2", "right", [])
    assert (answer.answers[0].verdict, answer.answers[0].unit) == ("right", "m")


def test_the_service_is_alive_and_ready(own: Any) -> None:
    assert call("service", "healthz").sync(client=own).status == "ok"
    assert call("service", "readyz").sync(client=own).status == "ready"


def test_a_job_comes_back_as_its_status(own: Any) -> None:
    later = call("jobs", "ask_later")
    job = later.sync(client=own, body=body_of(later, {"question": "collision_time", "request": {"pitch": 0.5}}))
    again = call("jobs", "job_status").sync(job.to_dict()["jobID"], client=own)
    assert (type(again).__name__, again.to_dict()["processID"]) == ("JobStatus", "collision_time")


@pytest.mark.parametrize("method", ["GET", "POST"])
def test_the_result_of_a_job_comes_back_as_the_direct_answer(own: Any, client: httpx.Client, method: str) -> None:
    name, example = {"GET": "minimum_pitch", "POST": "minimum_pitch_of"}[method], EXAMPLES[f"{method} /minimum-pitch"]
    later, request = call("jobs", "ask_later"), example.query if example.body is None else example.body
    job = later.sync(client=own, body=body_of(later, {"question": name, "request": request}))
    client.get(f"/jobs/{job.job_id}/events").raise_for_status()  # Its events end when it is finished.
    answer = client.request(method, "/minimum-pitch", params=example.query, json=example.body)
    result = call("jobs", "job_result").sync(job.job_id, client=own)
    assert json.loads(result.payload.read()) == answer.raise_for_status().json()


FILM = {"dragon": {"benches": 3}, "start": 1, "stop": 2, "seconds": 1, "height": 240}


@pytest.mark.parametrize(
    ("name", "request_", "accept", "begin"),
    [
        ("trajectory", {"dragon": {"benches": 3}}, "text/csv", b"time,handle"),
        ("trajectory", {"dragon": {"benches": 3}}, "application/vnd.apache.arrow.file", b"ARROW1"),
        ("trajectory_figure", {"benches": 3}, "image/svg+xml", b"<?xml"),
        ("trajectory_figure", {"benches": 3}, "image/png", b"\x89PNG"),
        ("maps", {"dragon": {"benches": 3}}, "image/vnd.dxf", b"  0\n"),
        ("plan", {"dragon": {"benches": 3}}, "application/pdf", b"%PDF"),
        ("crew", {"dragon": {"benches": 3}, "stop": 9}, "application/pdf", b"%PDF"),
        ("cues", {"dragon": {"benches": 3}, "stop": 9}, "application/pdf", b"%PDF"),
        ("films", FILM, "image/gif", b"GIF89a"),
        ("films", FILM, "video/mp4", b"\x00\x00\x00"),
        ("trajectory", {"dragon": {"benches": 3}}, XLSX_TYPE, b"PK\x03\x04"),
    ],
)
def test_a_file_made_by_a_job_comes_back_as_its_bytes(
    own: Any, client: httpx.Client, name: str, request_: dict[str, Any], accept: str, begin: bytes
) -> None:
    later = call("jobs", "ask_later")
    job = later.sync(client=own, body=body_of(later, {"question": name, "request": request_, "accept": accept}))
    client.get(f"/jobs/{job.job_id}/events").raise_for_status()
    assert call("jobs", "job_result").sync(job.job_id, client=own).payload.read().startswith(begin)


@pytest.mark.parametrize(
    ("accept", "begin"),
    some([("text/csv", b'"design","pitch"'), ("application/vnd.apache.parquet", b"PAR1")], 1),
)
def test_the_table_of_a_sweep_comes_back_as_its_bytes(
    own: Any, client: httpx.Client, accept: str, begin: bytes
) -> None:
    module = call("jobs", "sweep")
    request = {
        "question": "collision_time",
        "over": {"pitch": [0.5, 0.6]},
        "request": {"benches": 30},
        "accept": accept,
    }
    job = module.sync(client=own, body=body_of(module, request))
    client.get(f"/jobs/{job.job_id}/events").raise_for_status()
    assert call("jobs", "job_result").sync(job.job_id, client=own).payload.read().startswith(begin)


def test_the_result_of_a_failed_job_comes_back_as_its_problem(own: Any, client: httpx.Client) -> None:
    later = call("jobs", "ask_later")
    job = later.sync(client=own, body=body_of(later, {"question": "collision_time", "request": {"overhang": 2.0}}))
    client.get(f"/jobs/{job.job_id}/events").raise_for_status()
    problem = call("jobs", "job_result").sync(job.job_id, client=own)
    assert (problem.status, problem.errors[0].name) == (422, "overhang")
    strict = evolve(own, raise_on_unexpected_status=True)  # of a status that the description does not list
    assert call("jobs", "dismiss_job").sync_detailed(job.job_id, client=strict).status_code == 204
