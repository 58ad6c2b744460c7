"""Answers in the service's memory: repeated with the same bytes without computing, within a limit of memory."""

from __future__ import annotations

import httpx
from prometheus_client import CollectorRegistry

from app.service.kept_answers import KeptAnswers
from tests.app.service.test_deadlines import sample

REPEATED = "bench_dragon_repeated_total"


def test_a_question_that_is_asked_again_is_answered_from_memory(server: str, client: httpx.Client) -> None:
    before, request = sample(server, REPEATED), {"samples": 21, "benches": 39}
    first = client.get("/pitch-scan", params=request)
    assert sample(server, REPEATED) == before
    again = client.get("/pitch-scan", params=request)
    assert (again.content, again.headers["etag"]) == (first.content, first.headers["etag"])
    assert sample(server, REPEATED) == before + 1.0
    other = client.get("/pitch-scan", params=request | {"margin": 0.01})
    assert other.content != first.content
    assert sample(server, REPEATED) == before + 1.0


def test_an_end_that_may_be_moved_is_another_question_than_the_same_end_as_a_wish(client: httpx.Client) -> None:
    line = {"kind": "line", "start": [0, 0], "end": [40, 0]}
    body = {"dragon": {"benches": 4}, "path": {"kind": "route", "start": 5.0, "pieces": [line]}}
    moved = client.post("/trajectory", json=body | {"times": {"stop": 20}})
    assert moved.raise_for_status().json()["time"][0] > 0.0
    assert client.post("/trajectory", json=body | {"times": {"start": 0, "stop": 20}}).status_code == 422


def test_the_answers_kept_stay_within_their_room_and_the_latest_stay() -> None:
    kept = KeptAnswers(160, CollectorRegistry())
    for number in range(40):
        kept.keep(str(number), bytes(10))
        assert kept.get("0") is not None, "it was asked for all the time"
    assert [number for number in range(40) if kept.get(str(number)) is not None] == [0, *range(25, 40)]


def test_a_large_answer_is_not_kept_and_without_room_none_is() -> None:
    kept, none = KeptAnswers(160, CollectorRegistry()), KeptAnswers(0, CollectorRegistry())
    kept.keep("large", bytes(11))
    none.keep("small", b"{}")
    assert kept.get("large") is none.get("small") is None
