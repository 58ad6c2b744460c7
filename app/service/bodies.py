"""Bodies of requests: their parts are counted before they are read, and large bodies are read in a thread.

Python reads a list or an object of JSON in 1 us and holds its lock meanwhile: 1.3 million of them took 1.5 s (measured
on 2026-11-22), in any thread. So their number is limited, by a count of the brackets that begin them.
"""

from __future__ import annotations

import asyncio
from typing import Annotated, Any

from anyio import CapacityLimiter, to_thread
from fastapi import Depends, Request, Response
from fastapi.exceptions import RequestValidationError
from starlette.types import Message

from app.service.clients import client_of
from app.service.deadlines import Handler, WatchedRoute
from app.service.lanes import Lanes
from app.service.problems import Refused, unreadable, validation_problem
from app.service.reply import Reply
from app.service.request_limits import LARGE
from app.settings import Settings
from app.wire.fields import short_json
from app.wire.problem import ERRORS_MAX
from app.wire.question import JSON
from app.wire.texts import Unreadable, json_of

# Estimated time to answer a large body, for the Retry-After of a full lane [s].
LARGE_COST = 1.0


class JsonRequest(Request):
    """A request whose body is JSON that states every name of an object once."""

    def __init__(self, request: Request, body: bytes) -> None:
        async def receive() -> Message:
            return {"type": "http.request", "body": body, "more_body": False}

        super().__init__(request.scope, receive)
        self._read: list[Any] = []

    async def json(self) -> Any:
        """raises: Unreadable"""
        if not self._read:
            self._read.append(json_of(await self.body()))
        return self._read[0]


class BodyRoute(WatchedRoute):
    """A call with a body; large bodies do not delay other requests."""

    def unwatched(self) -> Handler:
        answer = super().unwatched()

        async def small(original: Request) -> Response:
            refuse_type(original)
            if not (body := await original.body()):
                return await answer(original)
            request = JsonRequest(original, body)
            try:
                await request.json()
            except Unreadable as error:
                return unreadable(error)
            return await answer(request)

        async def in_thread(request: Request) -> Response:
            try:
                return await small(request)
            except RequestValidationError as error:  # Thousands of errors take as long to write as the body to read.
                return await validation_problem(request, error)

        async def handled(request: Request) -> Response:
            body = await request.body()
            if len(body) <= LARGE:
                return await small(request)
            refuse_parts(request, body)
            lanes: Lanes = request.app.state.lanes
            with lanes.large_bodies.slot(LARGE_COST, client_of(request)):
                # Threads separate from those that answer small requests.
                return await to_thread.run_sync(asyncio.run, in_thread(request), limiter=CapacityLimiter(1))

        return handled


def refuse_parts(request: Request, body: bytes, *, values: bool = False) -> None:
    """raises: Refused (422) for a body of more objects and lists than the service reads. values: count these too"""
    settings: Settings = request.app.state.settings
    parts = sum(map(body.count, (b"[", b"{", b",") if values else (b"[", b"{")))
    if parts > settings.parts_max:
        words = "The body must hold at most {most} objects and lists, got about {parts}."
        if values:
            words = "The body must hold at most {most} objects, lists and values, got about {parts}."
        raise Refused(422, words, {"pointer": ""}, most=settings.parts_max, parts=parts)


def content_type(request: Request) -> str:
    """Media type of the body without its parameters; empty if the request states none."""
    return request.headers.get("content-type", "").partition(";")[0].strip().lower()


def has_body(request: Request) -> bool:
    return request.headers.get("content-length", "0") != "0" or "transfer-encoding" in request.headers


def refuse_type(request: Request) -> None:
    """raises: Refused (415) for a body that is not JSON, or that is compressed"""
    kind = content_type(request)
    if has_body(request) and kind != JSON:
        values = {"got": kind or "no Content-Type", "reason": "send the header Content-Type: {type}.", "type": JSON}
        raise Refused(415, "The body must be {type}", {"name": "Content-Type"}, {"Accept-Post": JSON}, **values)
    if has_body(request):
        refuse_coded(request)


def refuse_coded(request: Request) -> None:
    """raises: Refused (415) for a body that is compressed"""
    coding = request.headers.get("content-encoding", "identity").strip()
    if coding.lower() != "identity":
        values = {"got": f"Content-Encoding: {short_json(coding)[1:-1]}", "reason": "send it as it is."}
        place, plainly = {"name": "Content-Encoding"}, {"Accept-Encoding": "identity"}
        raise Refused(415, "The body must not be compressed", place, plainly, **values)


async def reply_body(request: Request) -> Reply:
    """Reply to a call that takes a body and no query. raises: Refused (422) for a query"""
    await refuse_query(request)
    return Reply(request)


async def refuse_query(request: Request) -> None:
    """raises: Refused (422) when a request has query parameters but its call takes none"""
    if names := list(request.query_params)[:ERRORS_MAX]:
        raise Refused.names(names, "is unknown here", "this call takes no query parameters: leave it out")


BodyReply = Annotated[Reply, Depends(reply_body)]
