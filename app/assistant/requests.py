"""Requests of an assistant: a call of the service from the arguments of a tool, and its response as content."""

from __future__ import annotations

import base64
import json
from pathlib import Path
from typing import Any
from urllib.parse import urlencode

import httpx2
from mcp import types

from app.assistant.tools import ToolCall, path_of
from app.wire.problem import PROBLEM_TYPE, Problem, problem_of
from app.wire.question import BYTES, JSON, short_json

# Longer answers are refused with advice: an assistant reads every character of an answer [characters].
ANSWER_MAX = 100_000
# Larger files of an answer are not sent [bytes].
FILE_MAX = 30_000_000
# What a client accepts of calls that make files, where a question has them in several forms.
ACCEPT = f"{JSON}, image/png;q=0.9, */*;q=0.8"
# Seconds are the limit of the service; this one is for a service that hangs.
HANGS = 3600.0


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
    app: Any,
    call: ToolCall,
    arguments: dict[str, Any],
    headers: dict[str, str],
    client: tuple[str, int],
    folder: Path | None,
) -> types.CallToolResult:
    """The answer of the service to a tool call; a problem of the service is an error of the tool, with all its parts.

    app: the service; headers: of the request, such as the token; client: address that limits of a client count
    """
    settings = app.state.settings
    try:
        rest = dict(arguments)
        path = path_of(call, rest)
        for name in [name for name in rest if f"{{{name}}}" in call.path]:
            del rest[name]
        content = None
        if call.takes_file:
            most = max(settings.grade_bytes_max, settings.places_bytes_max)
            content, headers = file_content(rest, folder, most), headers | {"Content-Type": BYTES}
        elif call.in_body:
            body = {name: value for name, value in rest.items() if name not in call.query}
            rest = {name: value for name, value in rest.items() if name in call.query}
            content, headers = json.dumps(body).encode(), headers | {"Content-Type": JSON}
        query = urlencode({name: _query_value(value) for name, value in rest.items() if value is not None}, doseq=True)
        transport = httpx2.ASGITransport(app=app, client=client, raise_app_exceptions=False)
        host = settings.hosts.split(",")[0] or "127.0.0.1"
        async with httpx2.AsyncClient(transport=transport, base_url=f"http://{host}", timeout=HANGS) as service:
            response = await service.request(
                call.method, f"{path}?{query}" if query else path, content=content, headers={"Accept": ACCEPT} | headers
            )
        return _result(call, response)
    except RefusedCall as refused:
        return _problem(json.loads(refused.problem.to_json()))


def _query_value(value: Any) -> Any:
    return json.dumps(value) if isinstance(value, bool | dict) else value


def _problem(problem: Any) -> types.CallToolResult:
    content = [types.TextContent(text=json.dumps(problem, ensure_ascii=False))]
    return types.CallToolResult(content=content, structured_content=problem, is_error=True)


def _result(call: ToolCall, response: httpx2.Response) -> types.CallToolResult:
    kind = response.headers.get("content-type", BYTES).partition(";")[0]
    if response.status_code >= 400:
        if kind != PROBLEM_TYPE:
            return _problem({"title": "The service failed", "status": response.status_code})
        return _problem(response.json())
    if kind == JSON:
        if len(response.content) > ANSWER_MAX:
            words, advice = "The answer must have at most {most} characters", "ask for fewer times or benches."
            raise _refused(413, "too-large", words, got=len(response.content), reason=advice, most=ANSWER_MAX)
        value = response.json()
        structured = value if isinstance(value, dict) else {"result": value}
        return types.CallToolResult(content=[types.TextContent(text=response.text)], structured_content=structured)
    if len(response.content) > FILE_MAX:
        raise _refused(413, "too-large", "The file must have at most {most} bytes.", most=FILE_MAX)
    if not response.content:
        return types.CallToolResult(content=[types.TextContent(text=f"Done: {response.status_code}")])
    data = base64.b64encode(response.content).decode()
    if kind.startswith("image/"):
        return types.CallToolResult(content=[types.ImageContent(data=data, mime_type=kind)])
    uri = f"bench-dragon:/{call.name}"
    file = types.BlobResourceContents(uri=uri, mime_type=kind, blob=data)
    return types.CallToolResult(content=[types.EmbeddedResource(resource=file)])
