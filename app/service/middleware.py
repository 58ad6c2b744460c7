"""Layers around every call: target, host, body size, HEAD, security headers, internal errors, counts and times."""

from __future__ import annotations

import asyncio
import logging
import re
import time
import uuid
from collections.abc import Callable, Coroutine
from typing import Any
from urllib.parse import quote, unquote

from fastapi import Request, Response
from prometheus_client import CollectorRegistry, Counter, Histogram
from starlette.datastructures import Headers
from starlette.requests import ClientDisconnect
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from app.logs import request_id
from app.service.lanes import limit
from app.service.problems import Refused, http_problem, server_problem
from app.settings import Settings
from app.wire.question import shown
from core.errors import Quantity

logger = logging.getLogger("uvicorn.error")

SELF_ONLY = "default-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'"
# Swagger UI uses inline styles and icons from data: addresses.
DOCS_POLICY = f"{SELF_ONLY}; style-src 'self' 'unsafe-inline'; img-src 'self' data:"
CLOSE = {"Connection": "close"}
# A target in absolute form, its host and its path.
ABSOLUTE = re.compile(rb"https?://([^/]+)(/.*)?", re.IGNORECASE)
# A host with or without a port, its name in group 1.
HOST = re.compile(r"([a-z0-9.-]+|\[[0-9a-f:.]+\])(?::[0-9]{1,5})?")
# Calls that answer under any host.
PROBES = ("/healthz", "/readyz")
# A name that a client may give its request.
REQUEST_ID = re.compile(r"[A-Za-z0-9._:-]{1,100}")
# Calls about jobs that wait for the disk at once in one process, and those that wait for their turn: more are refused.
JOB_CALLS, JOB_CALLS_WAITING = 4, 200
# Larger bodies are read and answered in a thread of their own [bytes]; smaller ones take under 2 ms to read.
LARGE = 64_000

Handler = Callable[[Request], Coroutine[Any, Any, Response]]


class Layer:
    """A layer around every call; other events, such as the start of the service, pass through."""

    def __init__(self, app: ASGIApp) -> None:
        self.app = app

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        await (self.answer if scope["type"] == "http" else self.app)(scope, receive, send)

    async def answer(self, scope: Scope, receive: Receive, send: Send) -> None:
        raise NotImplementedError


class RequestLimits(Layer):
    """Answers 414 to a long query, 400 to a length stated twice, and 413 as soon as a body is too long.

    While this process holds as many bytes of bodies as it may, a further large one gets 503.
    """

    def __init__(self, app: ASGIApp, settings: Settings) -> None:
        super().__init__(app)
        self.bytes_max, self.query_max = settings.body_bytes_max, settings.query_bytes_max
        self.held, self.held_max, self.retry_after = 0, settings.bodies_bytes_max, settings.retry_after
        # Paths of the calls that take a file, which have limits of their own.
        self.files_max = {"/grade": settings.grade_bytes_max, "/places": settings.places_bytes_max}

    async def answer(self, scope: Scope, receive: Receive, send: Send) -> None:
        read, most = 0, self.files_max.get(scope["path"], self.bytes_max)

        async def counted() -> Message:
            nonlocal read
            message = await receive()
            more = len(message.get("body", b""))
            read, self.held = read + more, self.held + more
            if read > most:
                raise self._refused(most, "more")
            if read > LARGE and self.held > self.held_max:
                raise self._full()
            return message

        if refused := self._refused_head(Headers(scope=scope), scope["query_string"], most):
            response = await http_problem(Request(scope), refused)
            return await response(scope, receive, send)
        try:
            return await self.app(scope, counted, send)
        finally:
            self.held -= read

    def _full(self) -> Refused:
        told = {"most": Quantity(self.held_max, "bytes"), "seconds": Quantity(self.retry_after, "s")}
        words, after = "The limit of {most} of bodies at once is reached", {"Retry-After": str(self.retry_after)}
        return Refused(503, words, None, CLOSE | after, reason="try again in {seconds}.", **told)

    def _refused_head(self, headers: Headers, query: bytes, most: int) -> Refused | None:
        if len(query) > self.query_max:
            words, got = "The query must have at most {most} bytes", len(query)
            return Refused(414, words, None, CLOSE, got=got, reason="ask in a body.", most=self.query_max)
        stated = headers.get("content-length", "0")
        if "transfer-encoding" in headers and "content-length" in headers:
            detail = "The length of a body is stated twice: send Content-Length or Transfer-Encoding, not both."
            return Refused(400, detail, {"name": "Content-Length"}, CLOSE)
        return self._refused(most, int(stated)) if stated.isdecimal() and int(stated) > most else None

    def _refused(self, most: int, got: int | str) -> Refused:
        words, why = "The body must be at most {most} bytes", "ask for less in one request."
        return Refused(413, words, {"pointer": ""}, CLOSE, got=got, reason=why, most=most)


class OriginForm(Layer):
    """Takes the target in absolute form as in origin form: GET http://host/turn as GET /turn (RFC 9112, 3.2.2).

    Its host then takes the place of the header Host.
    """

    async def answer(self, scope: Scope, receive: Receive, send: Send) -> None:
        if found := ABSOLUTE.fullmatch(scope["raw_path"]):
            host, path = found[1], found[2] or b"/"
            headers = [(b"host", host), *(one for one in scope["headers"] if one[0] != b"host")]
            scope = {**scope, "raw_path": path, "path": unquote(path.decode("ascii")), "headers": headers}
        await self.app(scope, receive, send)


class Hosts(Layer):
    """Answers 421 to a request for a host that the service is not, if a setting names those that it is.

    A page of a stranger can give its own name the address of this machine (DNS rebinding); its requests come under that
    name. Probes of health ask by whatever address there is, and their answers hold nothing.
    """

    def __init__(self, app: ASGIApp, settings: Settings) -> None:
        super().__init__(app)
        self.names = frozenset(settings.hosts.split(",")) if settings.hosts else None

    async def answer(self, scope: Scope, receive: Receive, send: Send) -> None:
        if self.names is None or scope["path"] in PROBES or self._name(scope) in self.names:
            return await self.app(scope, receive, send)
        words = "This service is not {host}: ask it under one of its names."
        got = Headers(scope=scope).get("host", "")
        refused = Refused(421, words, {"name": "Host"}, CLOSE, host=shown(got) if got else "a host without a name")
        return await (await http_problem(Request(scope), refused))(scope, receive, send)

    @staticmethod
    def _name(scope: Scope) -> str:
        """The host that is asked, without its port; empty if it is none."""
        match = HOST.fullmatch(Headers(scope=scope).get("host", "").lower())
        return match[1].rstrip(".") if match else ""


class RequestId(Layer):
    """Gives each request a name, in the answer and in the log: that of its client in X-Request-ID, or a new one."""

    async def answer(self, scope: Scope, receive: Receive, send: Send) -> None:
        given = Headers(scope=scope).get("x-request-id", "")
        name = given if REQUEST_ID.fullmatch(given) else uuid.uuid4().hex
        request_id.set(name)

        async def named(message: Message) -> None:
            if message["type"] == "http.response.start":
                message["headers"] = [*message["headers"], (b"x-request-id", name.encode())]
            await send(message)

        await self.app(scope, receive, named)


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


class SafetyHeaders(Layer):
    """Tells browsers to load only from this service and to trust the stated content type."""

    async def answer(self, scope: Scope, receive: Receive, send: Send) -> None:
        policy = DOCS_POLICY if scope["path"] == "/docs" else SELF_ONLY
        added = [
            (b"content-security-policy", policy.encode()),
            (b"x-content-type-options", b"nosniff"),
            (b"referrer-policy", b"no-referrer"),
        ]

        async def guarded(message: Message) -> None:
            if message["type"] == "http.response.start":
                headers = message["headers"] = [*message["headers"], *added]
                # Browsers revalidate the page's files, so that modules of two versions never mix.
                if not any(name == b"cache-control" for name, _ in headers):
                    headers.append((b"cache-control", b"no-cache"))
            await send(message)

        await self.app(scope, receive, guarded)


class Mistakes(Layer):
    """Answers 500 when the service itself fails, keeps the connection, and writes the traceback only to the log.

    A client that ends its connection within its body counts as a 400, although nobody reads the answer.
    """

    async def answer(self, scope: Scope, receive: Receive, send: Send) -> None:
        started = False

        async def noted(message: Message) -> None:
            nonlocal started
            started = True
            await send(message)

        try:
            await self.app(scope, receive, noted)
        except Exception as error:
            if started:
                raise
            if isinstance(error, ClientDisconnect):
                answer = await http_problem(Request(scope), Refused(400, "The body ended too soon."))
            else:
                logger.exception("%s %s failed", scope["method"], quote(scope["path"]))
                answer = server_problem()
            await answer(scope, receive, send)


class JobCalls(Layer):
    """Lets few calls about jobs at a time into the threads that all calls share, because each waits for the disk.

    The others wait for their turn outside, so that a thousand removals at once delay no page. A call keeps its place
    until its answer begins; calls with a body have limits of their own.
    """

    def __init__(self, app: ASGIApp, settings: Settings) -> None:
        super().__init__(app)
        self._places, self._waiting, self._retry_after = asyncio.Semaphore(JOB_CALLS), 0, settings.retry_after

    async def answer(self, scope: Scope, receive: Receive, send: Send) -> None:
        if not scope["path"].startswith("/jobs") or scope["method"] not in ("GET", "DELETE"):
            return await self.app(scope, receive, send)
        if self._waiting >= JOB_CALLS_WAITING:
            told = {"most": limit(JOB_CALLS_WAITING, "waiting call"), "seconds": Quantity(self._retry_after, "s")}
            words, after = "The limit of {most} about jobs is reached", {"Retry-After": str(self._retry_after)}
            refused = Refused(503, words, None, after, reason="try again in {seconds}.", **told)
            return await (await http_problem(Request(scope), refused))(scope, receive, send)
        self._waiting += 1
        try:
            await self._places.acquire()
        finally:
            self._waiting -= 1
        has_place = True

        def leave() -> None:
            nonlocal has_place
            if has_place:
                self._places.release()
            has_place = False

        async def leaving(message: Message) -> None:
            leave()
            await send(message)

        try:
            await self.app(scope, receive, leaving)
        finally:
            leave()


class Metrics(Layer):
    """Counts requests by path and status, and their times by path."""

    def __init__(self, app: ASGIApp, registry: CollectorRegistry) -> None:
        super().__init__(app)
        self.requests = Counter("bench_dragon_requests", "Requests answered", ("path", "status"), registry=registry)
        self.seconds = Histogram("bench_dragon_request_seconds", "Time to answer", ("path",), registry=registry)

    async def answer(self, scope: Scope, receive: Receive, send: Send) -> None:
        started, status = time.perf_counter(), 500

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
            self.seconds.labels(path).observe(time.perf_counter() - started)
