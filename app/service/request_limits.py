"""Limits of a request before any call sees it: its query, its body, and the bytes of all bodies at once."""

from __future__ import annotations

from starlette.datastructures import Headers
from starlette.requests import Request
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from app.service.middleware import Layer
from app.service.pages import long_address
from app.service.problems import CLOSE, Refused
from app.settings import Settings
from core.quantities import Quantity

# Larger bodies are read and answered in a thread of their own [bytes]; smaller ones take under 2 ms to read.
LARGE = 64_000
# Path of the messages of assistants, which may hold a file in base64.
MESSAGES = "/mcp"


class RequestLimits(Layer):
    """Answers 414 to a long query, 400 to a length stated twice, and 413 as soon as a body is too long.

    A person who followed a long address gets a page, a program a problem.
    While this process holds as many bytes of bodies as it may, a further large one gets 503.
    """

    def __init__(self, app: ASGIApp, settings: Settings) -> None:
        super().__init__(app)
        self.bytes_max, self.query_max = settings.body_bytes_max, settings.query_bytes_max
        self.held, self.held_max, self.retry_after = 0, settings.bodies_bytes_max, settings.retry_after
        # Paths of the calls that take a file, which have limits of their own.
        self.files_max = {"/grade": settings.grade_bytes_max, "/places": settings.places_bytes_max}
        self.files_max[MESSAGES] = max(self.files_max.values()) * 4 // 3 + LARGE

    async def answer(self, scope: Scope, receive: Receive, send: Send) -> None:
        read, most = 0, self.files_max.get(scope["path"], self.bytes_max)

        async def receive_limited() -> Message:
            nonlocal read
            message = await receive()
            more = len(message.get("body", b""))
            read, self.held = read + more, self.held + more
            if read > most:
                raise self._refused(most, "more")
            if read > LARGE and self.held > self.held_max:
                raise self._full()
            return message

        headers, query = Headers(scope=scope), scope["query_string"]
        if len(query) > self.query_max and (page := long_address(Request(scope), len(query), self.query_max)):
            return await page(scope, receive, send)
        if refused := self._refused_head(headers, query, most):
            return await self.refuse(refused, scope, receive, send)
        try:
            return await self.app(scope, receive_limited, send)
        finally:
            self.held -= read

    def _full(self) -> Refused:
        values = {"most": Quantity(self.held_max, "bytes"), "seconds": Quantity(self.retry_after, "s")}
        words, after = "The limit of {most} of bodies at once is reached", {"Retry-After": str(self.retry_after)}
        return Refused(503, words, None, CLOSE | after, reason="try again in {seconds}.", **values)

    def _refused_head(self, headers: Headers, query: bytes, most: int) -> Refused | None:
        if len(query) > self.query_max:
            words, got = "The query must have at most {most} bytes", len(query)
            return Refused(414, words, None, CLOSE, got=got, reason="ask in a body.", most=self.query_max)
        stated = headers.get("content-length", "0")
        if "transfer-encoding" in headers and "content-length" in headers:
            words = "The length of a body is stated twice: send Content-Length or Transfer-Encoding, not both."
            return Refused(400, words, {"name": "Content-Length"}, CLOSE)
        return self._refused(most, int(stated)) if stated.isdecimal() and int(stated) > most else None

    def _refused(self, most: int, got: int | str) -> Refused:
        words, why = "The body must be at most {most} bytes", "ask for less in one request."
        return Refused(413, words, {"pointer": ""}, CLOSE, got=got, reason=why, most=most)
