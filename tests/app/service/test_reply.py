"""The time of an answer is estimated once, and what the event loop gives up is computed once more."""

import time
from contextlib import ExitStack

import httpx
import pytest

from app.files.tables import XLSX_TYPE
from app.service import routes
from app.service.main import create_app
from app.service.problems import Refused
from app.service.short_tries import SHORT
from app.settings import Settings
from app.wire.fields import Answer, Wire
from app.wire.question import JSON, UNKNOWN_COST, Question, calls_of
from core import TooMuchWork
from core.kernels import Halted
from tests.app.service.test_problems import ask
from tests.support.job_service import wait_for

# Every computation here ends within this time [s].
SOON = 10.0


class Count(Wire):
    """A request without values."""


class CountAnswer(Answer):
    """How often this answer was computed."""

    computed: int


class Counting:
    """A question that counts how often its time is estimated and its answer computed."""

    def __init__(self, cost, work):
        """cost: estimated time [s]"""
        self.estimated = self.computed = 0
        self.cost = cost
        self.work = work

    def estimate(self, request):
        self.estimated += 1
        return self.cost

    def question(self):
        def counting(request, terms):
            """How often this answer was computed."""
            self.computed += 1
            try:
                self.work(terms, self.computed)
            except Halted as halted:
                raise TooMuchWork("", "must be less") from halted
            return CountAnswer(computed=self.computed)

        return Question(counting, CountAnswer, flat=Count, body=Count, cost=self.estimate)


# What a question does before it answers, from its terms and the number of its computation.


def quick(terms, number):
    """No work."""


def slow_at_first(terms, number):
    """The first computation takes longer than the event loop may, as on a busy machine."""
    if number == 1:
        until_stopped(terms, number)


def long(terms, number):
    """Work that its search announces as long."""
    terms.budget.take_time()


def until_stopped(terms, number):
    """Work that only its budget ends."""
    end = time.monotonic() + SOON
    while time.monotonic() < end:
        terms.budget.look()


@pytest.fixture
def app():
    return create_app(Settings(heavy_max=1))


def answer_of(app, counting, method="GET"):
    routes.add_calls(app.router, calls_of(counting.question()))
    return ask(app, "/counting", method)


def heavy_lane_full(app):
    return app.state.lanes.slot(UNKNOWN_COST, JSON, "another client")


@pytest.mark.parametrize(
    "method, cost, work, computed",
    [
        ("GET", SHORT, quick, 1),
        ("GET", SHORT, long, 2),
        ("GET", 2 * SHORT, quick, 1),
        ("GET", UNKNOWN_COST, long, 1),
        ("POST", SHORT, long, 1),
        ("POST", UNKNOWN_COST, long, 1),
    ],
)
def test_an_answer_is_estimated_once_and_computed_once_more_at_most(app, method, cost, work, computed):
    counting = Counting(cost, work)
    assert answer_of(app, counting, method).json() == {"computed": computed}
    assert counting.estimated == 1
    assert counting.computed == computed


def test_what_the_loop_gives_up_needs_no_slot_among_long_computations(app):
    counting = Counting(SHORT, slow_at_first)
    with heavy_lane_full(app):
        assert answer_of(app, counting).json() == {"computed": 2}


def test_what_goes_on_for_longer_moves_to_a_slot_among_long_computations(app):
    def slow(terms, number):
        if number == 1:
            until_stopped(terms, number)
        wait_for(lambda: (running(app, "cheap"), running(app, "heavy")) == (0.0, 1.0))

    counting = Counting(SHORT, slow)
    assert answer_of(app, counting).json() == {"computed": 2}
    assert counting.estimated == 1
    assert running(app, "cheap") == running(app, "heavy") == 0.0


def test_what_goes_on_for_longer_ends_where_no_slot_is_free(app):
    counting = Counting(SHORT, until_stopped)
    with heavy_lane_full(app):
        answer = answer_of(app, counting)
        assert (answer.status_code, running(app, "cheap"), running(app, "heavy")) == (503, 0.0, 1.0)
    assert "limit of 1 heavy computation at once" in answer.json()["detail"]
    assert counting.estimated == 1
    assert counting.computed == 2


def test_workbooks_have_slots_of_their_own():
    lanes = create_app(Settings(workbooks_max=1, retry_after=7)).state.lanes
    with ExitStack() as slots:
        for cost, form in ((0.0, XLSX_TYPE), (0.0, JSON), (UNKNOWN_COST, JSON)):
            slots.enter_context(lanes.slot(cost, form, ""))
        with pytest.raises(Refused) as refused:
            slots.enter_context(lanes.slot(0.0, XLSX_TYPE, ""))
    assert refused.value.status_code == 503
    assert int((refused.value.headers or {})["Retry-After"]) >= 7


def running(app, lane):
    """Number of computations in a lane, by the metric of operators."""
    return app.state.registry.get_sample_value("bench_dragon_computations", {"lane": lane}) or 0.0


def test_sentences_are_in_the_language_that_the_client_accepts(client):
    methods = {}
    for header in ("zh-CN,zh;q=0.9,en;q=0.1", "de, en-GB;q=0.5", ""):
        answer = client.get("/collision-time?benches=3", headers={"Accept-Language": header})
        assert "Accept-Language" in answer.headers["Vary"]
        methods[answer.headers["ETag"]] = answer.json()["certificate"]["method"]
    chinese, english = methods.values()
    assert chinese[:5] == "3 节板凳"
    assert english[:9] == "3 benches"


def test_a_job_speaks_the_language_of_its_request(service_with):
    with httpx.Client(base_url=service_with(data=True).url) as client:
        headers = {"Accept-Language": "zh", "Prefer": "respond-async"}
        job = client.get("/collision-time?benches=3", headers=headers).headers["Location"]
        wait_for(lambda: client.get(f"{job}/result").status_code == 200)
        assert client.get(f"{job}/result").json()["certificate"]["method"].startswith("3 节板凳")
