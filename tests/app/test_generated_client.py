"""A client that openapi-python-client makes from /openapi.json asks the running service every question."""

import importlib
import inspect
import io
import os
import re
import subprocess
import sys
from typing import get_args

import httpx
import pytest

from app.questions.registry import CALLS
from app.service.examples import EXAMPLES
from tests.app.conftest import ANSWER_TIMEOUT
from tests.support.students import contact_workbook
from tests.support.wheels import PATH

pytestmark = pytest.mark.thorough  # the generator takes seconds
PACKAGE = "generated_client"
WARNING = re.compile(r"^(?:WARNING|ERROR) parsing \S+ (\S+)", re.MULTILINE)


@pytest.fixture(scope="module")
def words(server, tmp_path_factory):
    """Output of the generator, with its warnings; the client that it makes can be imported as PACKAGE."""
    folder = tmp_path_factory.mktemp("client")
    description = folder / "openapi.json"  # the generator itself waits five seconds for an address
    description.write_bytes(httpx.get(f"{server}/openapi.json", timeout=ANSWER_TIMEOUT).content)
    command = [sys.executable, "-m", "openapi_python_client", "generate", "--meta", "none"]
    command += ["--path", str(description), "--output-path", str(folder / PACKAGE)]
    # Its formatter would keep a cache where the first user of this machine has one.
    environment = os.environ | {"PATH": PATH, "RUFF_CACHE_DIR": str(folder / "cache")}
    done = subprocess.run(command, cwd=folder, env=environment, capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr
    sys.path.insert(0, str(folder))
    yield done.stdout + done.stderr
    sys.path.remove(str(folder))


@pytest.fixture(scope="module")
def own(words, server):
    """The generated client of the running service."""
    client = importlib.import_module(f"{PACKAGE}.client")
    return client.Client(base_url=server, timeout=httpx.Timeout(ANSWER_TIMEOUT))


def call(tag, name):
    return importlib.import_module(f"{PACKAGE}.api.{tag}.{name}")


def with_body(module, body):
    """The body as the type that the generated call takes."""
    annotation = inspect.signature(module.sync_detailed, eval_str=True).parameters["body"].annotation
    kind = next(kind for kind in get_args(annotation) or (annotation,) if hasattr(kind, "from_dict"))
    return {"body": kind.from_dict(body)}


def test_the_generator_warns_of_nothing(words):
    assert WARNING.findall(words) == []
    assert words.count("WARNING") + words.count("ERROR") == 0


ASKED = [one for one in CALLS.values() if one.question.model]


@pytest.mark.parametrize("asked", ASKED, ids=lambda one: one.name)
def test_every_question_is_answered(own, client, asked):
    module = call("questions", asked.name)
    path = asked.question.path
    example = EXAMPLES[f"{asked.method} {path}"]
    answer = module.sync(client=own, **(with_body(module, example.body) if example.body else example.query))
    response = client.request(asked.method, path, params=example.query, json=example.body)
    assert answer.to_dict() == response.raise_for_status().json()


def test_a_file_is_graded(own):
    module = call("grading", "grade")
    types = importlib.import_module(f"{PACKAGE}.types")
    file = types.File(payload=io.BytesIO(contact_workbook()))
    answer = module.sync(client=own, body=file, name="result2.xlsx", pitch="0.450337393")
    assert (answer.files[0].workbook, answer.files[0].verdict, answer.files[0].diagnosis) == ("result2", "right", [])
    assert answer.answers[0].verdict == "right"
    assert answer.answers[0].unit == "m"


def test_the_table_of_a_sweep_comes_back_as_its_bytes(own, client):
    body = {"question": "collision_time", "over": {"pitch": [0.5, 0.6]}, "request": {"benches": 30}}
    module = call("jobs", "sweep")
    job = module.sync(client=own, **with_body(module, body | {"accept": "application/vnd.apache.parquet"})).job_id
    client.get(f"/jobs/{job}/events").raise_for_status()  # Its events end when it is finished.
    assert call("jobs", "job_result").sync(job, client=own).payload.read().startswith(b"PAR1")
