"""Layers around every call: its name, language and headers, HEAD, internal errors, counts and times."""

from __future__ import annotations

import logging
import re
import time
import uuid
from urllib.parse import quote

from fastapi import Request
from prometheus_client import CollectorRegistry, Counter, Histogram
from starlette.datastructures import Headers as RequestHeaders
from starlette.requests import ClientDisconnect
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from app.logs import request_id
from app.service.negotiation import language_of
from app.service.problems import Refused, http_problem, server_problem
from core.language import speaking

logger = logging.getLogger("uvicorn.error")

# Headers of every response that does not have its own. Browsers load only from this service, trust the stated content
# type, and ask again for each file of the page, so that modules of two versions never mix.
SAFETY = (
    (b"content-security-policy", b"default-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'"),
    (b"x-content-type-options", b"nosniff"),
    (b"referrer-policy", b"no-referrer"),
    (b"cache-control", b"no-cache"),
)
# A name that a client may give its request.
REQUEST_ID = re.compile(r"[A-Za-z0-9._:-]{1,100}")


class Layer:
    """A layer around every call; other events, such as the start of the service, pass through."""

    def __init__(self, app: ASGIApp) -> None:
        self.app = app

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        await (self.answer if scope["type"] == "http" else self.app)(scope, receive, send)

    async def answer(self, scope: Scope, receive: Receive, send: Send) -> None:
        raise NotImplementedError

    async def refuse(self, refused: Refused, scope: Scope, receive: Receive, send: Send) -> None:
        """Send the problem of a refused request."""
        await (await http_problem(Request(scope), refused))(scope, receive, send)


class Headers(Layer):
    """Gives each request a name, in the answer and in the log: that of its client in X-Request-ID, or a new one; and
    each response the headers of SAFETY, but those that it has: a page that needs another policy brings it."""

    async def answer(self, scope: Scope, receive: Receive, send: Send) -> None:
        client_name = RequestHeaders(scope=scope).get("x-request-id", "")
        name = client_name if REQUEST_ID.fullmatch(client_name) else uuid.uuid4().hex
        request_id.set(name)

        async def send_with_headers(message: Message) -> None:
            if message["type"] == "http.response.start":
                own = dict(message["headers"])
                safety = [header for header in SAFETY if header[0] not in own]
                message["headers"] = [*message["headers"], *safety, (b"x-request-id", name.encode())]
            await send(message)

        await self.app(scope, receive, send_with_headers)


class Spoken(Layer):
    """Answers, also errors, in the language that the client accepts."""

    async def answer(self, scope: Scope, receive: Receive, send: Send) -> None:
        with speaking(language_of(RequestHeaders(scope=scope).get("accept-language"))):
            await self.app(scope, receive, send)


class HeadAsGet(Layer):
    """Answers HEAD like GET without the body, with the same headers; it makes no job, as HEAD changes nothing."""

    async def answer(self, scope: Scope, receive: Receive, send: Send) -> None:
        if scope["method"] != "HEAD":
            return await self.app(scope, receive, send)

        async def without_body(message: Message) -> None:
            if message["type"] == "http.response.body":
                message = {**message, "body": b""}
            await send(message)

        headers = [(name, value) for name, value in scope["headers"] if name != b"prefer"]
        return await self.app({**scope, "method": "GET", "headers": headers, "is_head": True}, receive, without_body)


class Outcomes(Layer):
    """Counts requests by path and status, and their times by path; answers 500 where the service itself fails.

    Then it keeps the connection, and writes the traceback only to the log. A client that ends its connection within its
    body counts as a 400, although nobody reads the answer.
    """

    def __init__(self, app: ASGIApp, registry: CollectorRegistry) -> None:
        super().__init__(app)
        self.requests = Counter("bench_dragon_requests", "Requests answered", ("path", "status"), registry=registry)
        self.seconds = Histogram("bench_dragon_request_seconds", "Time to answer", ("path",), registry=registry)

    async def answer(self, scope: Scope, receive: Receive, send: Send) -> None:
        began, status = time.perf_counter(), 0

        async def send_and_note(message: Message) -> None:
            nonlocal status
            if message["type"] == "http.response.start":
                status = message["status"]
            await send(message)

        try:
            await self.app(scope, receive, send_and_note)
        except Exception as error:
            if status:
                raise
            if isinstance(error, ClientDisconnect):
                await self.refuse(Refused(400, "The body ended too soon."), scope, receive, send_and_note)
            else:
                logger.exception("%s %s failed", scope["method"], quote(scope["path"]))
                await server_problem()(scope, receive, send_and_note)
        finally:
            # The path of the route, so that unknown paths cannot create new labels without end.
            path = getattr(scope.get("route"), "path", "other")
            self.requests.labels(path, status or 500).inc()
            self.seconds.labels(path).observe(time.perf_counter() - began)
