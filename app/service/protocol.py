"""HTTP/1.1 by uvicorn and h11, with a limit on every wait and problem details for requests that are not HTTP.

uvicorn ends a connection on which no request begins, but it waits for ever for the rest of a request that has begun,
and for a client that takes nothing of its answer. It also reads everything that has arrived before it does anything
else: 200,000 chunks of one byte took 1.6 s (measured on 2026-11-22).
"""

from __future__ import annotations

from asyncio import TimerHandle, Transport
from functools import cache
from typing import Any

import h11
from uvicorn.protocols.http.flow_control import FlowControl
from uvicorn.protocols.http.h11_impl import H11Protocol

from app.service.problems import problem
from app.settings import Settings
from core.quantities import Quantity

# Size of the pieces in which chunked bodies are read, with other work in between [bytes]: 700 chunks of one byte, 6 ms.
PIECE = 4096

# Time in which the first request of a connection must come when the service ends [s].
FIRST_SECONDS = 0.5

# Read once, because reading the environment takes 2 ms and a connection may ask only one question.
_settings = cache(Settings)


class _Flow(FlowControl):
    """Flow control that reads no more from the client while pieces of its last bytes are unread."""

    held = False

    def resume_reading(self) -> None:
        if self.held:
            self.read_paused = False
        else:
            super().resume_reading()


class Protocol(H11Protocol):
    """One connection.

    A timer runs while the client owes the rest of a head, and another while it owes the rest of a body or takes nothing
    of an answer.
    """

    def __init__(self, *args: Any, **kwargs: Any) -> None:
        super().__init__(*args, **kwargs)
        self.settings = _settings()
        self.left = bytearray()
        self._owed, self._leaves = "", False
        self._owing: TimerHandle | None = None
        self._stalled: TimerHandle | None = None

    def connection_made(self, transport: Transport) -> None:  # type: ignore[override]
        super().connection_made(transport)
        self.flow: _Flow = _Flow(transport)
        self._watch()

    def connection_lost(self, exc: Exception | None) -> None:
        for timer in (self._owing, self._stalled):
            if timer is not None:
                timer.cancel()
        self.left.clear()
        super().connection_lost(exc)

    def data_received(self, data: bytes) -> None:
        if self.left or (len(data) > PIECE and self._in_chunks(data)):
            first = not self.left
            self.left += data
            self.flow.held = True
            self.transport.pause_reading()
            if first:
                self._read_on()
            return
        super().data_received(data)
        self._watch()

    def _in_chunks(self, data: bytes) -> bool:
        if self.conn.their_state is h11.SEND_BODY:
            return any(name == b"transfer-encoding" for name, _ in self.headers)
        return b"chunked" in data.lower()

    def _read_on(self) -> None:
        """Read one piece; the next one follows when the loop has served other connections."""
        if self.transport.is_closing():
            return
        piece = bytes(self.left[:PIECE])
        del self.left[:PIECE]
        super().data_received(piece)
        self._watch()
        if self.left:
            self.loop.call_soon(self._read_on)
            return
        self.flow.held = False
        if not self.flow.read_paused and not self.transport.is_closing():
            self.transport.resume_reading()

    def on_response_complete(self) -> None:
        super().on_response_complete()
        self._watch()

    def shutdown(self) -> None:
        """End the connection when its answer is sent. A new one may still send its first request.

        Its client, such as a proxy, has begun to send it, and may not send it again elsewhere.
        """
        if self.cycle is None and not self.transport.is_closing():
            self._leaves = True
            self.loop.call_later(FIRST_SECONDS, super().shutdown)
        else:
            super().shutdown()

    def handle_events(self) -> None:
        super().handle_events()
        if self._leaves and self.cycle is not None:
            self.cycle.keep_alive = False

    def pause_writing(self) -> None:
        super().pause_writing()
        self._stalled = self.loop.call_later(self.settings.stalled_seconds, self.transport.abort)

    def resume_writing(self) -> None:
        super().resume_writing()
        if self._stalled is not None:
            self._stalled.cancel()

    def _watch(self) -> None:
        """Start, keep or stop the timer, by what the client owes now."""
        state = self.conn.their_state
        begun = self.timeout_keep_alive_task is None  # Between requests uvicorn has a timer of its own.
        owed = "head" if state is h11.IDLE and begun else "body" if state is h11.SEND_BODY else ""
        if owed == self._owed:
            return
        if self._owing is not None:
            self._owing.cancel()
        self._owed, self._owing = owed, None
        if owed:
            seconds = self.settings.head_seconds if owed == "head" else self.settings.body_seconds
            self._owing = self.loop.call_later(seconds, self._late, owed, seconds)

    def _late(self, owed: str, seconds: float) -> None:
        if self.transport.is_closing():
            return
        if self.conn.our_state in (h11.IDLE, h11.SEND_RESPONSE) and owed == "head":
            words = "The head of the request was not complete within {most}."
            self._refuse(408, "request-timeout", words, most=Quantity(seconds, "s", 6))
        else:
            self.transport.abort()

    def send_400_response(self, msg: str) -> None:
        self._refuse(400, "malformed-http", "The request is not valid HTTP/1.1.")

    def _refuse(self, status: int, code: str, words: str, **values: Any) -> None:
        headers = {"Connection": "close", "X-Content-Type-Options": "nosniff"}
        answer = problem(status, code, words, headers=headers, **values)
        for event in (
            h11.Response(status_code=status, headers=answer.raw_headers, reason=b""),
            h11.Data(data=bytes(answer.body)),
            h11.EndOfMessage(),
        ):
            if output := self.conn.send(event):
                self.transport.write(output)
        self.transport.close()
