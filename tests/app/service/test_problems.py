"""Problems: their pointers and texts, and no traceback for an error of ours."""

import asyncio
from concurrent.futures import ThreadPoolExecutor

import httpx
import pytest

import core
from app.service.main import create_app
from app.service.negotiation import accepted
from app.settings import Settings
from app.wire.faults import pointer

pytestmark = pytest.mark.uncompiled


def test_an_index_into_what_is_no_list_in_the_body_is_left_out_of_a_pointer():
    assert pointer(["times", 300], {"times": {"stop": 600}}) == pointer(["times", 300], {}) == "/times"


@pytest.mark.parametrize(
    "header, expected",
    [
        (None, "application/json"),
        ("*/*", "application/json"),
        ("text/csv", "text/csv"),
        ("TEXT/CSV; charset=utf-8", "text/csv"),
        ("text/*, application/json;q=0.5", "text/csv"),
        ("text/csv;q=0.2, application/json;q=0.9", "application/json"),
        ("application/json;q=0, */*", "text/csv"),
        ("image/png", None),
        ("text/csv;q=nonsense", None),
        ("", "application/json"),
    ],
)
def test_accept_chooses_the_form(header, expected):
    assert accepted(header, ["application/json", "text/csv"]) == expected


def ask(app, path, method="GET"):
    async def answer():
        transport = httpx.ASGITransport(app)
        async with httpx.AsyncClient(transport=transport, base_url="http://here") as client:
            return await client.request(method, path)

    # In the main thread the browser of other tests has its event loop.
    with ThreadPoolExecutor(1) as thread:
        return thread.submit(asyncio.run, answer()).result()


ERRORS = [kind for kind in vars(core).values() if isinstance(kind, type) and issubclass(kind, core.BenchDragonError)]


@pytest.mark.parametrize("kind", ERRORS)
def test_every_error_of_core_is_a_problem_of_the_client(kind):
    def fail():
        raise kind.in_words("path.pitch", "pitch is wrong")

    app = create_app(Settings())
    app.add_api_route("/fail", fail)
    answer = ask(app, "/fail")
    (error,) = answer.json()["errors"]
    assert (answer.status_code, error["name"], error["detail"]) == (422, "pitch", "pitch is wrong")
    assert answer.json()["type"] == f"urn:problem-type:bench-dragon:{kind.code}"


def test_a_mistake_of_ours_shows_no_traceback():
    app = create_app(Settings())
    app.add_api_route("/mistake", lambda: 1 / 0)
    answer = ask(app, "/mistake")
    assert answer.status_code == 500
    assert answer.headers["content-type"] == "application/problem+json"
    assert "division" not in answer.text.lower()


def test_a_limit_on_defaults_points_to_the_value_to_give():
    answer = ask(create_app(Settings(benches_max=10)), "/trajectory", "POST")
    assert answer.status_code == 422
    assert answer.json()["errors"][0]["pointer"] == "/dragon/benches"


def test_readiness_waits_for_the_self_test():
    assert ask(create_app(Settings()), "/readyz").status_code == 503
