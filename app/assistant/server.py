"""The server of the Model Context Protocol, over the standard streams or over HTTP."""

from __future__ import annotations

from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from pathlib import Path
from typing import Any

import uvicorn
from mcp import MCPError, types
from mcp.server import Server, ServerRequestContext
from mcp.server.stdio import stdio_server

from app.assistant import guide
from app.assistant.requests import answer
from app.assistant.tools import calls_of
from app.service.main import create_app
from app.service.version import VERSION

INSTRUCTIONS = (
    "Bench Dragon checks a dance of benches joined by handles that follow a curve: where everyone is and how fast, "
    "when two benches first touch, how tight the spiral may be, how far people may stray. Lengths are in metres, times "
    "in seconds, angles in radians. An argument that is left out takes the value of problem A of the contest CUMCM "
    "2024. Each answer says how it is known (certificate). Errors name the argument, its value, unit and limit. "
    "Long questions: ask_later gives a job, job_status and job_result its answer."
)
# Address under which calls over the standard streams count.
LOCAL = ("127.0.0.1", 0)
INVALID_PARAMS, NO_RESOURCE = -32602, -32002


def create_server(*, folder: Path | None = None, twins: bool = False) -> Server[Any]:
    """A server whose tools are the calls of the service.

    folder: where tools may read files by name; None: nowhere. twins: see calls_of()
    """
    service = create_app()
    calls = calls_of(service.openapi(), twins=twins)
    tools = [
        types.Tool(
            name=call.name,
            title=call.title,
            description=call.description,
            input_schema=call.schema,
            annotations=types.ToolAnnotations(
                read_only_hint=call.reads_only, idempotent_hint=call.reads_only, open_world_hint=False
            ),
        )
        for call in calls.values()
    ]

    async def list_tools(_context: Any, _parameters: Any) -> types.ListToolsResult:
        return types.ListToolsResult(tools=tools)

    async def call_tool(
        context: ServerRequestContext[Any], parameters: types.CallToolRequestParams
    ) -> types.CallToolResult:
        if parameters.name not in calls:
            raise MCPError(INVALID_PARAMS, f"{parameters.name} is no tool of this door; it has {', '.join(calls)}")
        headers: dict[str, str] = {}
        client = LOCAL
        if context.request is not None:  # over HTTP: the token and the address are those of the assistant
            if "authorization" in context.request.headers:
                headers["Authorization"] = context.request.headers["authorization"]
            client = tuple(context.request.client or LOCAL)
        elif token := service.state.settings.token:
            headers["Authorization"] = f"Bearer {token}"
        call = calls[parameters.name]
        return await answer(service, call, parameters.arguments or {}, headers, client, folder)

    async def list_resources(_context: Any, _parameters: Any) -> types.ListResourcesResult:
        return types.ListResourcesResult(resources=guide.resources())

    async def read_resource(_context: Any, parameters: types.ReadResourceRequestParams) -> types.ReadResourceResult:
        text = guide.read(str(parameters.uri))
        if text is None:
            raise MCPError(NO_RESOURCE, f"{parameters.uri} is no page of the guide")
        content = types.TextResourceContents(uri=parameters.uri, mime_type=guide.MARKDOWN, text=text)
        return types.ReadResourceResult(contents=[content])

    @asynccontextmanager
    async def lifespan(_server: Server[Any]) -> AsyncIterator[None]:
        async with service.router.lifespan_context(service):
            yield

    return Server(
        "bench-dragon",
        version=VERSION,
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


def serve_http(server: Server[Any], host: str, port: int) -> None:
    """Answer assistants at /mcp until a signal ends this process."""
    uvicorn.run(server.streamable_http_app(host=host, stateless_http=True, json_response=True), host=host, port=port)
