"""Requests of an assistant: a call of the service from the arguments of a tool, and its response as content."""

from __future__ import annotations

import base64
import json
from collections.abc import Callable, Coroutine
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any
from urllib.parse import unquote, urlencode

from mcp import types
from starlette.datastructures import Headers
from starlette.types import ASGIApp, Message, Receive, Scope

from app.assistant.tools import ToolCall, path_of
from app.wire.fields import short_json
from app.wire.problem import PROBLEM_TYPE, Problem, problem_of
from app.wire.question import BYTES, JSON

# Longer answers are refused with advice: an assistant reads every character of an answer [characters].
ANSWER_MAX = 100_000
# Larger files of an answer are not sent [bytes].
FILE_MAX = 30_000_000
# What a client accepts of calls that make files, where a question has them in several forms.
ACCEPT = f"{JSON}, image/png;q=0.9, */*;q=0.8".encode()
# Parts and headers of the assistant's request that its calls have too.
CONNECTION = ("type", "asgi", "http_version", "scheme", "client", "server")
KEPT = (b"host", b"authorization", b"x-request-id")


@dataclass(frozen=True)
class ServiceRequest:
    """A request to the service. target: path and query, quoted; content_type: of the content, empty without one"""

    method: str
    target: str
    content: bytes = b""
    content_type: str = ""


@dataclass
class ServiceResponse:
    """The response of the service. kind: media type without parameters, empty if none is stated"""

    status: int = 0
    kind: str = ""
    content: bytearray = field(default_factory=bytearray)


Ask = Callable[[ServiceRequest], Coroutine[Any, Any, ServiceResponse]]


def asker(service: ASGIApp, connection: Scope, receive: Receive) -> Ask:
    """A function that sends requests to the service of this process, through all layers around its calls.

    connection: scope of the assistant's request, whose client, host, token and name its calls have too
    receive: waits for the end of the connection
    """
    kept = [header for header in connection["headers"] if header[0] in KEPT]

    async def ask(request: ServiceRequest) -> ServiceResponse:
        target, response, is_read = request.target.encode("ascii"), ServiceResponse(), False
        path, _, query = target.partition(b"?")
        headers = [*kept, (b"accept", ACCEPT), (b"content-length", str(len(request.content)).encode())]
        if request.content_type:
            headers.append((b"content-type", request.content_type.encode()))
        root = connection.get("root_path", "")
        scope = {name: connection[name] for name in CONNECTION}
        scope |= {"method": request.method, "root_path": root, "path": unquote(path.decode())}
        scope |= {"raw_path": path, "query_string": query, "headers": headers, "state": {}}

        async def receive_content() -> Message:
            nonlocal is_read
            if is_read:
                return await receive()
            is_read = True
            return {"type": "http.request", "body": request.content, "more_body": False}

        async def send(message: Message) -> None:
            if message["type"] == "http.response.start":
                response.status = message["status"]
                response.kind = Headers(raw=message["headers"]).get("content-type", "").partition(";")[0]
            response.content += message.get("body", b"")

        await service(scope, receive_content, send)
        return response

    return ask


class RefusedCall(Exception):
    """A request that the door refuses itself. problem: what is wrong"""

    def __init__(self, problem: Problem) -> None:
        super().__init__(problem.detail)
        self.problem = problem


def _refused(status: int, code: str, sentence: str, **values: Any) -> RefusedCall:
    return RefusedCall(problem_of(status, code, sentence, **values))


def file_content(arguments: dict[str, Any], folder: Path | None, most: int) -> bytes:
    """Content of the file that the arguments give.

    folder: where files may be read; None: nowhere; most: limit of the size [bytes]
    raises: RefusedCall for no file or two, content that is not base64, a name outside the folder, a file too large
    """
    name, text = arguments.pop("file", None), arguments.pop("content", None)
    if (name is None) == (text is None):
        raise _refused(422, "invalid-value", "file or content must be given, and not both.")
    if text is not None:
        try:
            return base64.b64decode(str(text), validate=True)
        except ValueError as error:
            raise _refused(422, "invalid-value", "content must be base64: {why}.", why=str(error)) from error
    if folder is None:
        raise _refused(403, "forbidden", "file must be left out: this door reads no files; give the content.")
    try:
        path = folder.joinpath(str(name)).resolve()
        if not path.is_relative_to(folder):
            raise _refused(403, "forbidden", "file must be in the folder of this door, got {name}.", name=str(name))
        if not path.is_file():
            raise _refused(404, "not-found", "file must be a file, got {name}.", name=str(name))
        if path.stat().st_size > most:
            raise _refused(413, "too-large", "file must have at most {most} bytes.", most=most)
        return path.read_bytes()
    except (OSError, ValueError) as error:
        why = getattr(error, "strerror", None) or "it cannot be a name"
        words = "file must be readable, got {name}: {why}."
        raise _refused(404, "not-found", words, name=short_json(str(name)), why=why) from error


async def answer(
    ask: Ask, call: ToolCall, arguments: dict[str, Any], folder: Path | None, most: int
) -> types.CallToolResult:
    """The answer of the service to a tool call; a problem of the service is an error of the tool, with all its parts.

    ask: sends a request to the service; folder, most: as file_content() has them
    """
    try:
        rest = dict(arguments)
        path = path_of(call, rest)
        for name in [name for name in rest if f"{{{name}}}" in call.path]:
            del rest[name]
        content, content_type = b"", ""
        if call.takes_file:
            content, content_type = file_content(rest, folder, most), BYTES
        elif call.in_body:
            body = {name: value for name, value in rest.items() if name not in call.query}
            rest = {name: value for name, value in rest.items() if name in call.query}
            content, content_type = json.dumps(body).encode(), JSON
        query = urlencode(
            {name: _query_value(value) for name, value in rest.items() if value is not None},
            doseq=True,
            errors="surrogatepass",
        )
        request = ServiceRequest(call.method, f"{path}?{query}" if query else path, content, content_type)
        return _result(call, await ask(request))
    except RefusedCall as refused:
        return _problem(json.loads(refused.problem.to_json()))


def _query_value(value: Any) -> Any:
    return json.dumps(value) if isinstance(value, bool | dict) else value


def _problem(problem: Any) -> types.CallToolResult:
    content = [types.TextContent(text=json.dumps(problem, ensure_ascii=False))]
    return types.CallToolResult(content=content, structured_content=problem, is_error=True)


def _result(call: ToolCall, response: ServiceResponse) -> types.CallToolResult:
    kind, content = response.kind or BYTES, response.content
    if response.status >= 400:
        if kind != PROBLEM_TYPE:
            return _problem({"title": "The service failed", "status": response.status})
        return _problem(json.loads(content))
    if kind == JSON:
        text = content.decode()
        if len(text) > ANSWER_MAX:
            words, advice = "The answer must have at most {most} characters", "ask for fewer times or benches."
            raise _refused(413, "too-large", words, got=len(text), reason=advice, most=ANSWER_MAX)
        value = json.loads(text)
        structured = value if isinstance(value, dict) else {"result": value}
        return types.CallToolResult(content=[types.TextContent(text=text)], structured_content=structured)
    if len(content) > FILE_MAX:
        raise _refused(413, "too-large", "The file must have at most {most} bytes.", most=FILE_MAX)
    if not content:
        return types.CallToolResult(content=[types.TextContent(text=f"Done: {response.status}")])
    data = base64.b64encode(content).decode()
    if kind.startswith("image/"):
        return types.CallToolResult(content=[types.ImageContent(data=data, mime_type=kind)])
    uri = f"bench-dragon:/{call.name}"
    file = types.BlobResourceContents(uri=uri, mime_type=kind, blob=data)
    return types.CallToolResult(content=[types.EmbeddedResource(resource=file)])
