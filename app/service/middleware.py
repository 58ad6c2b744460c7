"""Middleware for every request: body size, HEAD, security headers, internal errors, counts and times."""

from __future__ import annotations

import logging
from time import perf_counter

from prometheus_client import CollectorRegistry, Counter, Histogram
from starlette.datastructures import Headers, MutableHeaders
from starlette.requests import Request
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from app.service.problems import Refused, http_problem, server_problem
from app.wire.problem import ErrorItem

logger = logging.getLogger("uvicorn.error")

SELF_ONLY = "default-src 'self'"
# Swagger UI uses inline styles and icons from data: addresses.
DOCS_POLICY = "default-src 'self'; style-src 'self' 'unsafe-inline'; img-src 'self' data:"


class BodyLimit:
    """Answers 413 as soon as a body exceeds the limit, by its stated length or while it streams in."""

    def __init__(self, app: ASGIApp, bytes_max: int) -> None:
        self.app, self.bytes_max = app, bytes_max

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        if scope["type"] != "http":
            return await self.app(scope, receive, send)
        read = 0

        async def counted() -> Message:
            nonlocal read
            message = await receive()
            read += len(message.get("body", b""))
            if read > self.bytes_max:
                raise self._refused()
            return message

        stated = Headers(scope=scope).get("content-length", "0")
        if stated.isdecimal() and int(stated) > self.bytes_max:
            response = await http_problem(Request(scope), self._refused())
            return await response(scope, receive, send)
        return await self.app(scope, counted, send)

    def _refused(self) -> Refused:
        detail = f"The body must be at most {self.bytes_max} bytes: ask for less in one request."
        return Refused(413, detail, [ErrorItem(pointer="", detail=detail)], {"Connection": "close"})


class HeadAsGet:
    """Answers HEAD like GET without the body, so that the headers are the same."""

    def __init__(self, app: ASGIApp) -> None:
        self.app = app

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        if scope["type"] != "http" or scope["method"] != "HEAD":
            return await self.app(scope, receive, send)

        async def without_body(message: Message) -> None:
            if message["type"] == "http.response.body":
                message = {**message, "body": b""}
            await send(message)

        return await self.app({**scope, "method": "GET"}, receive, without_body)


class SafetyHeaders:
    """Tells browsers to load only from this service and to trust the stated content type."""

    def __init__(self, app: ASGIApp) -> None:
        self.app = app

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        if scope["type"] != "http":
            return await self.app(scope, receive, send)
        policy = DOCS_POLICY if scope["path"] == "/docs" else SELF_ONLY

        async def guarded(message: Message) -> None:
            if message["type"] == "http.response.start":
                headers = MutableHeaders(scope=message)
                headers["Content-Security-Policy"] = policy
                headers["X-Content-Type-Options"] = "nosniff"
                headers["Referrer-Policy"] = "no-referrer"
                # Browsers revalidate the page's files, so that modules of two versions never mix.
                headers.setdefault("Cache-Control", "no-cache")
            await send(message)

        return await self.app(scope, receive, guarded)


class Mistakes:
    """Answers 500 when the service itself fails, keeps the connection, and writes the traceback only to the log."""

    def __init__(self, app: ASGIApp) -> None:
        self.app = app

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        started = False

        async def noted(message: Message) -> None:
            nonlocal started
            started = True
            await send(message)

        try:
            await self.app(scope, receive, noted)
        except Exception:
            if started or scope["type"] != "http":
                raise
            logger.exception("%s %s failed", scope["method"], scope["path"])
            await server_problem()(scope, receive, send)


class Metrics:
    """Counts requests by path and status, and their times by path."""

    def __init__(self, app: ASGIApp, registry: CollectorRegistry) -> None:
        self.app = app
        self.requests = Counter("bench_dragon_requests", "Requests answered", ("path", "status"), registry=registry)
        self.seconds = Histogram("bench_dragon_request_seconds", "Time to answer", ("path",), registry=registry)

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        if scope["type"] != "http":
            return await self.app(scope, receive, send)
        started, status = perf_counter(), 500

        async def noted(message: Message) -> None:
            nonlocal status
            if message["type"] == "http.response.start":
                status = message["status"]
            await send(message)

        try:
            await self.app(scope, receive, noted)
        finally:
            # The path of the route, so that unknown paths cannot create new labels without end.
            path = getattr(scope.get("route"), "path", "other")
            self.requests.labels(path, status).inc()
            self.seconds.labels(path).observe(perf_counter() - started)
