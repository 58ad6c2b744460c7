"""The server of the Model Context Protocol: what an assistant may ask, over the standard streams or in one message."""

from __future__ import annotations

import logging
from collections.abc import AsyncIterator, Iterable
from contextlib import asynccontextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import anyio
from mcp import MCPError, types
from mcp.server import Server
from mcp.server.stdio import stdio_server
from mcp.server.streamable_http_manager import StreamableHTTPSessionManager
from starlette.types import Message, Scope

from app.assistant import guide
from app.assistant.requests import Ask, answer
from app.assistant.tools import ToolCall, calls_of

# Each message over HTTP has a manager of its own, which would write three lines.
logging.getLogger("mcp.server.streamable_http_manager").setLevel(logging.WARNING)

INSTRUCTIONS = (
    "Bench Dragon checks a dance of benches joined by handles that follow a curve: where everyone is and how fast, "
    "when two benches first touch, how tight the spiral may be, how far people may stray. Lengths are in metres, times "
    "in seconds, angles in radians. An argument that is left out takes the value of problem A of the contest CUMCM "
    "2024. Each answer says how it is known (certificate). Errors name the argument, its value, unit and limit. "
    "Long questions: ask_later gives a job, job_status and job_result its answer."
)
INVALID_PARAMS, NO_RESOURCE = -32602, -32002


@dataclass(frozen=True)
class Toolbox:
    """What an assistant may call.

    description: OpenAPI document of the service; twins: see calls_of()
    folder: where tools may read files by name, None: nowhere; file_bytes_max: longest file [bytes]
    """

    description: dict[str, Any]
    file_bytes_max: int
    folder: Path | None = None
    twins: bool = False
    calls: dict[str, ToolCall] = field(init=False)
    tools: list[types.Tool] = field(init=False)

    def __post_init__(self) -> None:
        calls = calls_of(self.description, twins=self.twins)
        object.__setattr__(self, "calls", calls)
        object.__setattr__(self, "tools", list(_tools_of(calls.values())))


def _tools_of(calls: Iterable[ToolCall]) -> Iterable[types.Tool]:
    for call in calls:
        yield types.Tool(
            name=call.name,
            title=call.title,
            description=call.description,
            input_schema=call.schema,
            annotations=types.ToolAnnotations(
                read_only_hint=call.reads_only, idempotent_hint=call.reads_only, open_world_hint=False
            ),
        )


@asynccontextmanager
async def _no_lifespan(_server: Server[Any]) -> AsyncIterator[None]:
    yield


def create_server(toolbox: Toolbox, ask: Ask, lifespan: Any = _no_lifespan) -> Server[Any]:
    """A server whose tools are the calls of the service. ask: sends their requests; lifespan: around all of them"""

    async def list_tools(_context: Any, _parameters: Any) -> types.ListToolsResult:
        return types.ListToolsResult(tools=toolbox.tools)

    async def call_tool(_context: Any, parameters: types.CallToolRequestParams) -> types.CallToolResult:
        if (call := toolbox.calls.get(parameters.name)) is None:
            names = ", ".join(toolbox.calls)
            raise MCPError(INVALID_PARAMS, f"{parameters.name} is no tool of this door; it has {names}")
        return await answer(ask, call, parameters.arguments or {}, toolbox.folder, toolbox.file_bytes_max)

    async def list_resources(_context: Any, _parameters: Any) -> types.ListResourcesResult:
        return types.ListResourcesResult(resources=guide.resources())

    async def read_resource(_context: Any, parameters: types.ReadResourceRequestParams) -> types.ReadResourceResult:
        text = guide.read(str(parameters.uri))
        if text is None:
            raise MCPError(NO_RESOURCE, f"{parameters.uri} is no page of the guide")
        content = types.TextResourceContents(uri=parameters.uri, mime_type=guide.MARKDOWN, text=text)
        return types.ReadResourceResult(contents=[content])

    return Server(
        "bench-dragon",
        version=toolbox.description["info"]["version"],
        title="Bench Dragon",
        instructions=INSTRUCTIONS,
        lifespan=lifespan,
        on_list_tools=list_tools,
        on_call_tool=call_tool,
        on_list_resources=list_resources,
        on_read_resource=read_resource,
    )


async def serve_streams(server: Server[Any]) -> None:
    """Answer an assistant that started this process, until it closes the standard input."""
    async with stdio_server() as (incoming, outgoing):
        await server.run(incoming, outgoing, server.create_initialization_options())


def exchange(server: Server[Any], scope: Scope, body: bytes) -> tuple[int, list[tuple[bytes, bytes]], bytes]:
    """Status, headers and body of the response to one message over HTTP, in an event loop of this thread.

    scope: of the request that brought the message, whose body has been read
    """
    status, headers = 500, list[tuple[bytes, bytes]]()
    parts: list[bytes] = []

    async def receive() -> Message:
        return {"type": "http.request", "body": body, "more_body": False}

    async def send(message: Message) -> None:
        nonlocal status, headers
        if message["type"] == "http.response.start":
            status, headers = message["status"], list(message["headers"])
        parts.append(message.get("body", b""))

    async def run() -> None:
        manager = StreamableHTTPSessionManager(
            server, json_response=True, stateless=True, max_request_body_size=max(len(body), 1)
        )
        async with manager.run():
            await manager.handle_request(scope, receive, send)

    anyio.run(run)
    return status, headers, b"".join(parts)
