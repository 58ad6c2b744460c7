"""Requests that no call can read get a problem; wrong values in those that can be read are in wire/test_refusals.py."""

import gzip

import pytest

from app.wire.question import BYTES, JSON
from tests.support.asking import assert_problem

HEADS = "GET, HEAD, OPTIONS, POST"


@pytest.mark.parametrize(
    "body, status, words",
    [
        *((body, 422, " JSON object") for body in (b"[]", b"3", b"null")),
        (b'{"times": [1, 2', 400, " JSON 15"),
        (b'{"a": "\xff"}', 400, " UTF-8 0xff 7"),
        (b"[" * 100_000, 400, " nests"),
    ],
    ids=["list", "number", "null", "cut off", "no UTF-8", "deep"],
)
def test_a_body_that_is_no_json_or_no_object_is_a_problem(client, body, status, words):
    assert_problem(client.post("/trajectory", content=body, headers={"Content-Type": JSON}), status, words)


@pytest.mark.parametrize("path, kind", [("/trajectory", JSON), ("/grade", "application/zip")])
def test_a_compressed_body_is_a_problem(client, path, kind):
    headers = {"Content-Type": kind, "Content-Encoding": "gzip"}
    answer = client.post(path, content=gzip.compress(b"{}"), headers=headers)
    assert_problem(answer, 415, "Content-Encoding gzip")
    assert answer.headers["accept-encoding"] == "identity"


def test_a_whole_number_may_have_a_fraction_of_nought(ask):
    """JSON has one type for numbers: 5.0 is the integer 5 of the schema."""
    assert len(ask("trajectory", {"dragon": {"benches": 5.0}, "times": [0]})["x"][0]) == 6


@pytest.mark.parametrize("kind", ["application/x-www-form-urlencoded", ""])
def test_another_content_type_is_a_problem(client, kind):
    answer = client.post("/trajectory", content=b"{}", headers={"Content-Type": kind})
    assert_problem(answer, 415, "Content-Type application/json")


def test_a_query_on_a_call_with_a_body_is_a_problem(ask):
    ask.refuses("pitch unknown", "trajectory", {}, pitch=0.5)


@pytest.mark.parametrize(
    "request_, status, allowed",
    [
        ("POST /nowhere", 404, ""),
        ("GET /trajectory/", 404, ""),
        ("GET /trajectory", 405, "OPTIONS, POST"),
        ("BREW /collision-time", 405, HEADS),
        ("POST /page/main.js", 405, "GET, HEAD, OPTIONS"),
    ],
)
def test_a_wrong_path_or_method_is_a_problem(client, request_, status, allowed):
    answer = client.request(*request_.split())
    assert_problem(answer, status)
    assert answer.headers.get("allow", "") == allowed


def test_an_unknown_format_is_not_found_and_the_known_ones_are_named(ask):
    assert_problem(ask.send("figures/contact.pdf"), 404, 'format "svg" "png" "pdf"')


@pytest.mark.parametrize(
    "call, accept",
    [
        ("collision-time", "application/json;q=0"),
        ("figures/contact.svg", "image/png"),
        ("paper", "text/csv"),
    ],
)
def test_a_media_type_that_the_call_does_not_offer_is_a_problem(ask, call, accept):
    assert_problem(ask.send(call, accept=accept), 406, f"Accept {accept}")


@pytest.mark.parametrize("call", ["grade", "places"])
def test_a_name_that_turns_the_writing_around_is_refused_and_not_repeated(client, call):
    refused = client.post(f"/{call}?name=Li\u202e.csv", content=b"{}", headers={"Content-Type": BYTES})
    assert_problem(refused, 422, "name line")
    assert "\u202e" not in refused.json()["detail"]
