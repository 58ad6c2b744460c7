"""POST /mcp: the calls of the service as tools of an assistant (Model Context Protocol), one message a request.

Input: a message. Output: its response in JSON. State: none between messages. Argument: a message is read in a thread,
so that none holds the event loop; the call that it asks for is a request to the service itself, with the address, host
and token of the assistant, through the same layers, limits, lanes and deadlines as any other.
"""

from __future__ import annotations

import asyncio
from contextlib import ExitStack
from pathlib import Path
from threading import Lock
from typing import TYPE_CHECKING

from anyio import CapacityLimiter, to_thread
from fastapi import FastAPI, Request, Response

from app.logs import request_id
from app.service.bodies import LARGE_COST, refuse_parts, refuse_type
from app.service.clients import client_of
from app.service.lanes import Lanes
from app.service.request_limits import LARGE, MESSAGES
from app.settings import Settings

if TYPE_CHECKING:
    from app.assistant.requests import ServiceRequest, ServiceResponse
    from app.assistant.server import Toolbox

_making = Lock()


def toolbox_of(app: FastAPI, folder: Path | None = None, *, twins: bool = False) -> Toolbox:
    """What an assistant may call of a service; options: of the Toolbox"""
    from app.assistant.server import Toolbox

    settings: Settings = app.state.settings
    return Toolbox(app.openapi(), max(settings.grade_bytes_max, settings.places_bytes_max), folder, twins)


async def mcp(request: Request) -> Response:
    """The response to one message of an assistant."""
    refuse_type(request)
    body = await request.body()
    refuse_parts(request, body, values=True)
    lanes: Lanes = request.app.state.lanes
    client = client_of(request)
    with ExitStack() as slots:
        slots.enter_context(lanes.assistants.slot(LARGE_COST, client))
        if len(body) > LARGE:
            slots.enter_context(lanes.large_bodies.slot(LARGE_COST, client))
        loop = asyncio.get_running_loop()
        return await to_thread.run_sync(_response, request, body, loop, limiter=CapacityLimiter(1))


def _response(request: Request, body: bytes, loop: asyncio.AbstractEventLoop) -> Response:
    """The response to a message, of a thread without an event loop. loop: of the service"""
    from app.assistant.requests import asker
    from app.assistant.server import create_server, exchange

    name = (b"x-request-id", request_id.get().encode())
    headers = [*(header for header in request.scope["headers"] if header[0] != name[0]), name]
    ask = asker(request.app, {**request.scope, "headers": headers}, request.receive)

    async def ask_in_loop(call: ServiceRequest) -> ServiceResponse:
        return await asyncio.wrap_future(asyncio.run_coroutine_threadsafe(ask(call), loop))

    with _making:
        toolbox: Toolbox = request.app.state.toolbox or toolbox_of(request.app)
        request.app.state.toolbox = toolbox
    server = create_server(toolbox, ask_in_loop)
    status, response_headers, content = exchange(server, request.scope, body)
    response = Response(content, status)
    response.raw_headers = [*response_headers, (b"cache-control", b"no-store")]
    return response


def add_assistants(app: FastAPI) -> None:
    app.state.toolbox = None
    app.add_api_route(MESSAGES, mcp, methods=["POST"], include_in_schema=False)
