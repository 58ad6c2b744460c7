"""Answers in the service's memory: repeated with the same bytes without computing, within a limit of memory."""

from prometheus_client import CollectorRegistry

from app.service.kept_answers import KeptAnswers
from tests.support.asking import dance
from tests.support.serving import sample

REPEATED = "bench_dragon_repeated_total"


def test_a_question_that_is_asked_again_is_answered_from_memory(ask, server):
    before = sample(server, REPEATED)
    request = {"samples": 3, "benches": 39, "locate": False}
    first = ask.send("pitch-scan", **request)
    assert sample(server, REPEATED) == before
    again = ask.send("pitch-scan", **request)
    assert again.content == first.content
    assert again.headers["etag"] == first.headers["etag"]
    assert sample(server, REPEATED) == before + 1.0


def test_an_end_that_may_be_moved_is_another_question_than_the_same_end_as_a_wish(ask):
    body = dance(4, (0, 0), (40, 0))
    assert ask("trajectory", body | {"times": {"stop": 20}})["time"][0] > 0.0
    ask.refuses("/times/start", "trajectory", body | {"times": {"start": 0, "stop": 20}})


def test_the_answers_kept_stay_within_their_room_and_the_latest_stay():
    kept = KeptAnswers(160, CollectorRegistry())
    for number in range(40):
        kept.keep(str(number), bytes(10))
        assert kept.get("0") is not None, "it was asked for all the time"
    assert [number for number in range(40) if kept.get(str(number)) is not None] == [0, *range(25, 40)]


def test_a_large_answer_is_not_kept_and_without_room_none_is():
    kept = KeptAnswers(160, CollectorRegistry())
    none = KeptAnswers(0, CollectorRegistry())
    kept.keep("large", bytes(11))
    none.keep("small", b"{}")
    assert kept.get("large") is none.get("small") is None
