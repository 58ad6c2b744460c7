"""One reply to one request: conditional, in a form that the client accepts, from memory, computed, or as a job."""

from __future__ import annotations

import hashlib
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, suppress
from functools import cached_property

from fastapi import Request, Response
from starlette.concurrency import run_in_threadpool
from starlette.responses import StreamingResponse

from app.jobs.task import Task, cost_of
from app.service.clients import client_of
from app.service.deadlines import watched
from app.service.kept_answers import KeptAnswers
from app.service.lanes import Lanes
from app.service.negotiation import AS_JOB, GZIPPED, accepted, form_of, gzipped, header_list, tags_in
from app.service.short_tries import SHORT, ShortTries
from app.service.version import build
from app.settings import Settings
from app.wire.dances import TimeRange
from app.wire.fields import Wire
from app.wire.question import BYTES, UNKNOWN_COST, Call, FileFormat, Terms
from app.wire.refusals import refusing
from core import Budget, TooMuchWork
from core.language import spoken


class Computation:
    """The answer to a call in one form, not yet computed.

    inputs: values of the query or the body; media_type: form of the answer; path: of the request
    words: whether the answer is wanted in words too
    """

    def __init__(self, call: Call, inputs: Wire, media_type: str, path: str, *, words: bool = False) -> None:
        self.call, self.inputs, self.media_type, self._path, self.words = call, inputs, media_type, path, words

    @cached_property
    def cost(self) -> float:
        """Estimated time [s]. raises: InvalidValue for times that end before they begin"""
        with refusing(self.inputs):
            return self.call.question.estimate(self.inputs, self.media_type)

    @cached_property
    def tag(self) -> str:
        """Strong tag: an answer depends on the call, its values with all defaults, form, language and build.

        Of times also on the ends that the caller gave, because the others may be moved.
        """
        times = getattr(self.inputs, "times", self.inputs)
        stated = times.stated if isinstance(times, TimeRange) else ""
        language = f"{spoken()} {self.words}"
        values = "\n".join((build(), self._path, self.media_type, language, self.inputs.model_dump_json(), stated))
        return hashlib.blake2b(values.encode(), digest_size=16).hexdigest()

    @property
    def task(self) -> Task:
        """The same computation as a job."""
        return Task(self.call.name, self.inputs.model_dump(mode="json", exclude_unset=True), self.media_type, spoken())

    def answer(self, terms: Terms) -> bytes | Iterator[bytes]:
        """The answer, whole or in blocks. raises: BenchDragonError in the words of the request"""
        with refusing(self.inputs):
            return self.call.question.encode(self.inputs, terms, self.media_type)


class Reply:
    """Answers a request, unless the client already has the answer, prefers a job, or the service is full."""

    def __init__(self, request: Request) -> None:
        state = request.app.state
        self.request, self.client = request, client_of(request)
        self.settings: Settings = state.settings
        self._as_job: bool = request.scope[AS_JOB]
        self._lanes: Lanes = state.lanes
        self._tries: ShortTries = state.short_tries
        self._answers: KeptAnswers = state.answers
        self._later: Callable[[Request, Task, float], Response] = state.later

    def __call__(self, call: Call, inputs: Wire, *form: FileFormat) -> Response:
        """The answer to a request with a body, in the best form that the client accepts.

        form: of the address of a figure or a map, for a client that accepts this form or any file
        raises: Refused: 406 if the client accepts no form; 503 or 429 if the lane of the computation, or the client's
            part of it, is full
        """
        computation = self._computation(call, inputs, *form)
        return self._response(computation, self.request.state.budget)

    async def to_query(self, call: Call, inputs: Wire, *form: FileFormat) -> Response:
        """The answer to a request without a body, as __call__: at once if it should be short, else from a thread.

        A thread repeats, once, what is not over soon in the event loop.
        """
        computation = self._computation(call, inputs, *form)
        if self._as_job or computation.cost > SHORT:  # The event loop does not wait for the disk, where jobs are kept.
            return await self._in_thread(computation)
        if not self._tries.resting:
            with suppress(TooMuchWork), self._tries.budget() as budget:
                return self._response(computation, budget)
            self._tries.rest()
            if not budget.stopped:  # It came upon long work itself.
                computation.cost = UNKNOWN_COST
                return await self._in_thread(computation)
        return await self._in_thread(computation, is_movable=True)

    async def _in_thread(self, computation: Computation, *, is_movable: bool = False) -> Response:
        async with watched(self.request, self.settings.deadline_seconds):
            budget = self.request.state.budget
            return await run_in_threadpool(self._response, computation, budget, is_movable=is_movable)

    def _computation(self, call: Call, inputs: Wire, *form: FileFormat) -> Computation:
        forms = [form[0].media_type] if form else call.question.forms
        # Who asks for bytes gets a file in its first form.
        offers = [*forms, BYTES] if call.question.model is None else forms
        media_type = form_of(header_list(self.request.headers, "accept"), offers, {"name": "Accept"})
        form_chosen = forms[0] if media_type == BYTES else media_type
        words = "accept-language" in self.request.headers
        return Computation(call, inputs, form_chosen, self.request.scope["path"], words=words)

    def _slot(self, computation: Computation, budget: Budget, *, is_movable: bool) -> AbstractContextManager[None]:
        if is_movable:
            return self._lanes.movable_slot(computation.cost, self.client, budget)
        return self._lanes.slot(computation.cost, computation.media_type, self.client)

    def _response(self, computation: Computation, budget: Budget, *, is_movable: bool = False) -> Response:
        """The answer with its headers. is_movable: whether its computation may move to another lane"""
        media_type, tag = computation.media_type, computation.tag
        headers = {
            "ETag": f'"{tag}"',
            "Cache-Control": f"public, max-age={self.settings.cache_seconds}",
            "Vary": "Accept, Accept-Encoding, Accept-Language",
        }
        header = header_list(self.request.headers, "if-none-match")
        known = tags_in(header) if header else []
        for one in (headers["ETag"], f'"{tag}{GZIPPED}"'):
            if one in known:
                return Response(status_code=304, headers={**headers, "ETag": one})
        if self._as_job:
            cost = cost_of(computation.call, computation.inputs, media_type)
            return self._later(self.request, computation.task, cost)
        data: bytes | Iterator[bytes] | None = self._answers.get(tag)
        if data is None:
            with self._slot(computation, budget, is_movable=is_movable):
                data = computation.answer(Terms(self.settings, budget, words=computation.words))
            if isinstance(data, bytes):
                self._answers.keep(tag, data)
        if "*" in known:
            return Response(status_code=304, headers=headers)
        if self._zips(data):
            headers |= {"ETag": f'"{tag}{GZIPPED}"', "Content-Encoding": "gzip"}
            data = gzipped(data) if isinstance(data, Iterator) else b"".join(gzipped([data]))
        if isinstance(data, bytes):
            return Response(data, headers=headers, media_type=media_type)
        return StreamingResponse(data, headers=headers, media_type=media_type)

    def _zips(self, data: bytes | Iterator[bytes]) -> bool:
        """Whether the answer is worth compressing, and the client accepts gzip."""
        least = self.settings.compressed_bytes_min
        is_large = least > 0 and (not isinstance(data, bytes) or len(data) >= least)
        codings = header_list(self.request.headers, "accept-encoding") or "identity"
        return is_large and accepted(codings, ["identity", "gzip"]) == "gzip"
