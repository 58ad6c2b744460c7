"""The command mcp: the calls of the service as tools for an assistant that starts this program."""

from __future__ import annotations

import asyncio
from contextlib import asynccontextmanager
from pathlib import Path
from typing import Annotated, Any

import typer

from app.command.usage import path
from app.extras import require
from core.errors import InvalidValue
from core.quantities import Given

# The connection of an assistant that started this process.
LOCAL = ("127.0.0.1", 0)


def mcp(
    folder: Annotated[
        Path | None,
        typer.Option("--folder", parser=path, metavar="FOLDER", help="Tools may read its files by name."),
    ] = None,
    twins: Annotated[
        bool, typer.Option("--twins", help="Also the calls with a body that have a twin with flat arguments.")
    ] = False,
) -> None:
    """Answer an assistant that speaks MCP on the standard streams: every question is a tool.

    The service answers assistants at /mcp.
    """
    require("service", "mcp", "mcp")
    from anyio import sleep_forever

    from app.assistant.requests import asker
    from app.assistant.server import create_server, serve_streams
    from app.service.assistants import toolbox_of
    from app.service.main import create_app

    if folder and not folder.is_dir():
        raise InvalidValue.in_words("folder", "--folder must be a folder", got=Given(str(folder), str(folder)))
    service = create_app()
    settings = service.state.settings
    host = (settings.hosts or LOCAL[0]).split(",")[0]
    headers = [(b"host", host.encode())]
    if settings.token:
        headers.append((b"authorization", f"Bearer {settings.token}".encode()))
    connection: dict[str, Any] = {"type": "http", "asgi": {"version": "3.0"}, "http_version": "1.1", "scheme": "http"}

    @asynccontextmanager
    async def lifespan(_server: Any) -> Any:
        async with service.router.lifespan_context(service):
            yield

    async def end_of_connection() -> Any:
        await sleep_forever()  # The process ends with it.

    connection |= {"client": LOCAL, "server": LOCAL, "headers": headers}
    ask = asker(service, connection, end_of_connection)
    toolbox = toolbox_of(service, folder and folder.resolve(), twins=twins)
    asyncio.run(serve_streams(create_server(toolbox, ask, lifespan)))
