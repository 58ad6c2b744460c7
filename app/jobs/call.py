"""One call of the service as a value, and how it is put to the service within one process.

A job is a call: whatever the service answers can be worked out later, and the bytes are those of the direct call
because the same code makes them.
"""

from __future__ import annotations

import base64
from collections.abc import Mapping
from dataclasses import asdict, dataclass, field
from typing import Any, Self

import orjson
from starlette.datastructures import Headers, MutableHeaders
from starlette.types import ASGIApp, Message, Scope


@dataclass(frozen=True)
class Call:
    """A request of HTTP, without what its answer does not depend on."""

    method: str
    path: str
    query: str
    accept: str
    content_type: str
    body: bytes

    @classmethod
    def of(cls, scope: Scope, body: bytes) -> Self:
        """The call that a server has received."""
        headers = Headers(scope=scope)
        return cls(
            method=scope["method"],
            path=scope["path"].removeprefix(scope.get("root_path", "")),
            query=scope["query_string"].decode("latin-1"),
            accept=headers.get("accept", "*/*"),
            content_type=headers.get("content-type", ""),
            body=body,
        )

    def to_bytes(self) -> bytes:
        return orjson.dumps(asdict(self) | {"body": base64.b64encode(self.body).decode()})

    @classmethod
    def from_bytes(cls, data: bytes) -> Self:
        fields = orjson.loads(data)
        return cls(**fields | {"body": base64.b64decode(fields["body"])})


@dataclass
class Answer:
    """What the service said."""

    status: int = 500
    headers: MutableHeaders = field(default_factory=MutableHeaders)
    body: bytes = b""


async def ask(app: ASGIApp, call: Call, headers: Mapping[str, str], known: Mapping[str, Any]) -> Answer:
    """The app's answer to a call.

    headers: more than those of the call; known: of the scope, such as who asks
    """
    sent = {"accept": call.accept, "content-length": str(len(call.body)), **headers}
    if call.content_type:
        sent["content-type"] = call.content_type
    scope = {
        "type": "http",
        "asgi": {"version": "3.0", "spec_version": "2.4"},
        "http_version": "1.1",
        "method": call.method,
        "scheme": "http",
        "path": call.path,
        "raw_path": call.path.encode(),
        "root_path": "",
        "query_string": call.query.encode("latin-1"),
        "headers": [(name.encode("latin-1"), value.encode("latin-1")) for name, value in sent.items()],
        "client": None,
        "server": None,
        "state": {},
        **known,
    }
    answer, parts = Answer(), []

    async def receive() -> Message:
        return {"type": "http.request", "body": call.body, "more_body": False}

    async def send(message: Message) -> None:
        if message["type"] == "http.response.start":
            answer.status = message["status"]
            answer.headers = MutableHeaders(raw=list(message.get("headers", [])))
        else:
            parts.append(message.get("body", b""))

    await app(scope, receive, send)
    answer.body = b"".join(parts)
    return answer
