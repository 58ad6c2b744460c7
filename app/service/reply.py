"""One reply to one request: conditional, in a form that the client accepts, from memory or computed.

The event loop computes a short answer itself and stops it if it takes too long; all others are computed in threads. The
latest answers stay in memory, because many people look at the same dance.
"""

from __future__ import annotations

import asyncio
import collections
import hashlib
import time
import zlib
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from functools import partial
from threading import Event, Lock, Thread, Timer, get_ident
from typing import Annotated, Any

from fastapi import Depends, Request, Response
from fastapi.exceptions import RequestValidationError
from fastapi.routing import APIRoute
from prometheus_client import CollectorRegistry, Counter
from pydantic import ValidationError
from starlette.concurrency import run_in_threadpool
from starlette.datastructures import Headers
from starlette.responses import StreamingResponse

from app.jobs.task import Task, cost_of
from app.questions.registry import CALLS
from app.service.lanes import CHEAP, Lanes, client_of, watched
from app.service.middleware import Handler
from app.service.problems import Refused
from app.service.version import build
from app.settings import Settings
from app.wire.problem import ERRORS_MAX
from app.wire.question import BYTES, UNKNOWN_COST, Call, FileFormat, Terms, Wire
from app.wire.refusals import reworded
from core import BenchDragonError, Budget, TooMuchWork

RESPOND_ASYNC = "respond-async"
# Longest estimated time of a computation that the event loop runs itself [s]: a thread costs a third of a millisecond,
# a sixth of the answer (2026-11-22). A computation that takes longer is stopped, and repeated in a thread: first among
# the short ones, because a busy machine makes each longer, and if it is not over soon, among the long ones.
GLANCE = 0.005
# Time after such a stop during which the loop runs no computation [s]: of 40 at once, each would delay all others.
REST = 0.1
# Number of looks without a computation after which the thread that stops them waits for the next one to begin [1].
LOOKS_IDLE = 200
# Largest answer that is kept, relative to the room for all [1].
SHARE_MAX = 1 / 16
# gzip: level 1 makes 1.8 MB of a trajectory of 3.8 MB in 60 ms; level 6 makes 1.7 MB in 350 ms (2026-11-22).
GZIP_LEVEL, GZIP_WINDOW = 1, 31
# End of the tag of a compressed answer: other bytes need another tag.
GZIPPED = "-gzip"


def clock_of_this_thread() -> Callable[[], float]:
    """Clock of the calling thread's processor time [s], which any thread can read; outside Unix of elapsed time."""
    if not hasattr(time, "pthread_getcpuclockid"):
        return time.monotonic
    return partial(time.clock_gettime, time.pthread_getcpuclockid(get_ident()))


class Glances:
    """Computations that the event loop runs itself; a thread stops one that takes too long.

    turn: held by the computation that runs, so that the loop serves other requests between two of them
    The limit is on the processor time of the loop, because on a busy machine every wait is long.
    """

    def __init__(self) -> None:
        self.turn = asyncio.Lock()
        self._rests_until = 0.0
        self._now: tuple[float, Budget] | None = None
        self._clock: Callable[[], float] | None = None
        self._wake = Event()
        Thread(target=self._look, name="glances", daemon=True).start()

    @property
    def rests(self) -> bool:
        """Whether computations are left to threads, because one took too long a moment ago."""
        return time.monotonic() < self._rests_until

    def rest(self) -> None:
        """Leave computations to threads for REST seconds, because one took too long."""
        self._rests_until = time.monotonic() + REST

    @contextmanager
    def budget(self) -> Iterator[Budget]:
        """A budget for one computation, which is stopped when GLANCE is over."""
        budget = Budget(brief=True)
        self._clock = self._clock or clock_of_this_thread()
        self._now = self._clock(), budget
        if not self._wake.is_set():
            self._wake.set()
        try:
            yield budget
        finally:
            self._now = None

    def _look(self) -> None:
        while self._wake.wait():
            self._wake.clear()
            idle = 0
            while idle < LOOKS_IDLE:
                time.sleep(GLANCE / 2.0)
                now = self._now
                idle = 0 if now else idle + 1
                if now and self._clock and self._clock() - now[0] > GLANCE:
                    now[1].stop("at a glance")


class KeptAnswers:
    """Answers by their tags. A tag depends on everything that determines the answer: request, form and build.

    bytes_max: room for all of them [bytes]; the answer that was asked for least recently goes first
    """

    def __init__(self, bytes_max: int, registry: CollectorRegistry) -> None:
        self.bytes_max = bytes_max
        self._repeated = Counter("bench_dragon_repeated", "Answers given from memory", registry=registry)
        self._kept: collections.OrderedDict[str, bytes] = collections.OrderedDict()
        self._used = 0
        self._lock = Lock()

    def get(self, tag: str) -> bytes | None:
        with self._lock:
            found = self._kept.get(tag)
            if found is not None:
                self._kept.move_to_end(tag)
                self._repeated.inc()
            return found

    def keep(self, tag: str, answer: bytes) -> None:
        """Keep an answer, unless it is too large."""
        if len(answer) > SHARE_MAX * self.bytes_max:
            return
        with self._lock:
            if tag in self._kept:  # Two clients asked at the same time.
                return
            self._kept[tag] = answer
            self._used += len(answer)
            while self._used > self.bytes_max:
                self._used -= len(self._kept.popitem(last=False)[1])


class Reply:
    """Answers a request, unless the client already has the answer, prefers a job, or the service is full."""

    def __init__(self, request: Request) -> None:
        state = request.app.state
        self.request = request
        self.settings: Settings = state.settings
        self._comes_later = prefers_later(request.headers)
        self._lanes: Lanes = state.lanes
        self._glances: Glances = state.glances
        self._answers: KeptAnswers = state.answers
        self._least_cost = 0.0  # known from a first try [s]
        self._later: Callable[[Request, Task, float], Response] = state.later

    async def to_query(self, call: Call, asked: Wire, *form: FileFormat) -> Response:
        """The answer to a request without a body: at once if it should be quick, else from a thread."""
        is_quick = not form and self._is_quick(call, asked)
        if is_quick:
            async with self._glances.turn:
                if not self._glances.rests:
                    with suppress(TooMuchWork), self._glances.budget() as budget:
                        self.request.state.budget = budget
                        return self(call, asked)
                    self._glances.rest()
                    is_quick = budget.stopped  # Otherwise it came upon long work itself.
                    self._least_cost = 0.0 if is_quick else UNKNOWN_COST
        async with watched(self.request, self.settings.deadline_seconds):
            if is_quick:
                with suppress(TooMuchWork):
                    return await run_in_threadpool(self._soon, call, asked)
                self._least_cost = UNKNOWN_COST
            return await run_in_threadpool(self, call, asked, *form)

    def _soon(self, call: Call, asked: Wire) -> Response:
        """The answer in the lane of short ones. raises: TooMuchWork if it takes longer than these may"""
        whole, brief = self.request.state.budget, Budget(brief=True)
        self.request.state.budget = brief
        end = Timer(CHEAP, brief.stop, ["soon"])
        end.start()
        try:
            return self(call, asked)
        finally:
            end.cancel()
            self.request.state.budget = whole

    def __call__(self, call: Call, asked: Wire, *form: FileFormat) -> Response:
        """The answer to the request, in the best form that the client accepts.

        form: of the address of a figure or a map, for a client that accepts this form or any file
        raises: Refused (503, 429) when the lane of the computation is full, or the client's part of it
        """
        offers = [form[0].media_type, BYTES] if form else call.question.forms
        chosen = form_of(self._listed("accept"), offers, {"name": "Accept"})
        media_type = form[0].media_type if form else chosen
        tag = self._tag(asked, media_type)
        headers = {
            "ETag": f'"{tag}"',
            "Cache-Control": f"public, max-age={self.settings.cache_seconds}",
            "Vary": "Accept, Accept-Encoding",
        }
        known = tags_in(self._listed("if-none-match") or "")
        for one in (headers["ETag"], f'"{tag}{GZIPPED}"'):
            if one in known:
                return Response(status_code=304, headers={**headers, "ETag": one})
        if self._comes_later:
            given = asked.model_dump(mode="json", exclude_unset=True)
            return self._later(self.request, Task(call.name, given, media_type), cost_of(call, asked, media_type))
        data: bytes | Iterator[bytes] | None = self._answers.get(tag)
        if data is None:
            data = self._computed(call, asked, media_type)
            if isinstance(data, bytes):
                self._answers.keep(tag, data)
        if "*" in known:
            return Response(status_code=304, headers=headers)
        if self._zips(data):
            headers |= {"ETag": f'"{tag}{GZIPPED}"', "Content-Encoding": "gzip"}
            data = _gzipped(data) if isinstance(data, Iterator) else b"".join(_gzipped([data]))
        if isinstance(data, bytes):
            return Response(data, headers=headers, media_type=media_type)
        return StreamingResponse(data, headers=headers, media_type=media_type)

    def _computed(self, call: Call, asked: Wire, media_type: str) -> bytes | Iterator[bytes]:
        """The answer, computed in its lane."""
        cost = self._cost(call, asked, media_type)
        try:
            with self._lanes.of(cost, media_type).taken(cost, client_of(self.request)):
                return call.question.told(asked, Terms(self.settings, self.request.state.budget), media_type)
        except BenchDragonError as error:
            raise reworded(error, asked) from error

    def _is_quick(self, call: Call, asked: Wire) -> bool:
        """Whether the event loop may compute the answer itself; never a job, which is written to the disk first."""
        forms = call.question.forms
        if len(forms) > 1 or self._comes_later:
            return False
        return self._cost(call, asked, forms[0]) <= GLANCE

    def _cost(self, call: Call, asked: Wire, media_type: str) -> float:
        """Estimated time of the answer [s]. raises: InvalidValue for times that end before they begin"""
        try:
            return max(call.question.estimate(asked, media_type), self._least_cost)
        except BenchDragonError as error:
            raise reworded(error, asked) from error

    def _listed(self, name: str) -> str | None:
        """A header that may stand on several lines, as one list (RFC 9110, section 5.3); None if it is missing."""
        return ",".join(self.request.headers.getlist(name)) or None

    def _zips(self, data: bytes | Iterator[bytes]) -> bool:
        """Whether the answer is worth compressing, and the client accepts gzip."""
        least = self.settings.compressed_bytes_min
        large = least > 0 and (not isinstance(data, bytes) or len(data) >= least)
        return large and accepted(self._listed("accept-encoding") or "identity", ["identity", "gzip"]) == "gzip"

    def _tag(self, asked: Wire, media_type: str) -> str:
        """Strong tag: an answer depends only on the call, its values with all defaults, the form and the build."""
        values = "\n".join((build(), self.request.scope["path"], media_type, asked.model_dump_json()))
        return hashlib.blake2b(values.encode(), digest_size=16).hexdigest()


async def reply_query(request: Request) -> Reply:
    """Reply to a call that takes its values from the query. raises: Refused (422) for a name that is given twice"""
    given = request.query_params.multi_items()
    if len(given) > len(request.query_params):
        times = collections.Counter(name for name, _ in given)
        twice = sorted(name for name in times if times[name] > 1)[:ERRORS_MAX]
        raise Refused.names(twice, "is given more than once", "give it once")
    return Reply(request)


class QueryRoute(APIRoute):
    """A call that takes its values from the query, all of them validated at once; the endpoint describes it.

    FastAPI validates them one by one, which takes 0.3 ms more, a sixth of an answer (2026-11-22).
    """

    def get_route_handler(self) -> Handler:
        call = CALLS[self.name]

        async def handled(request: Request) -> Response:
            reply = await reply_query(request)
            try:
                wanted = call.asked.model_validate(dict(request.query_params))
            except ValidationError as error:
                found = [{**one, "loc": ("query", *one["loc"])} for one in error.errors(include_url=False)]
                raise RequestValidationError(found) from error
            return await reply.to_query(call, wanted)

        return handled


def _gzipped(blocks: Iterable[bytes]) -> Iterator[bytes]:
    packer = zlib.compressobj(GZIP_LEVEL, wbits=GZIP_WINDOW)
    for block in blocks:
        yield packer.compress(block)
    yield packer.flush()


QueryReply = Annotated[Reply, Depends(reply_query)]


def tags_in(header: str) -> list[str]:
    """Tags of an If-None-Match."""
    return [tag.strip().removeprefix("W/") for tag in header.split(",")]


def prefers_later(headers: Headers) -> bool:
    """Whether the client prefers a job to a wait (RFC 7240)."""
    wishes = ",".join(headers.getlist("prefer")).split(",")
    return any(wish.partition(";")[0].strip().lower() == RESPOND_ASYNC for wish in wishes)


def form_of(header: str | None, offers: Sequence[str], place: Mapping[str, str]) -> str:
    """The form of the answer.

    place: of the client's choice of form, for the refusal
    raises: Refused (406) if the client accepts none of the offers
    """
    chosen = accepted(header, offers)
    if chosen is None:
        told: dict[str, Any] = {"offers": " or ".join(offers), "asked": header[:100] if header else ""}
        raise Refused(406, "This call answers {offers}, but Accept asks for {asked}.", place, **told)
    return chosen


def accepted(header: str | None, offers: Sequence[str]) -> str | None:
    """The offer that an Accept header prefers, the earlier one if equal; None if it accepts none.

    >>> accepted("text/csv, */*;q=0.1", ["application/json", "text/csv"])
    'text/csv'
    """
    if not header or header == "*/*":
        return offers[0]
    liked: dict[str, float] = {}
    for entry in header.split(","):
        kind, *parameters = (part.strip().lower() for part in entry.split(";"))
        quality = next((part[2:] for part in parameters if part.startswith("q=")), "1")
        liked[kind] = float(quality) if quality.replace(".", "", 1).isdecimal() else 0.0

    def quality_of(offer: str) -> float:
        return next((liked[kind] for kind in (offer, f"{offer.partition('/')[0]}/*", "*/*") if kind in liked), 0.0)

    best = max(offers, key=quality_of)
    return best if quality_of(best) > 0 else None
