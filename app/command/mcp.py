"""The command mcp: the calls of the service as tools for an assistant."""

from __future__ import annotations

import asyncio
from pathlib import Path
from typing import Annotated, Any

import typer

from app.command.usage import path
from app.extras import require
from core.errors import Given, InvalidValue


def mcp(
    port: Annotated[
        int | None,
        typer.Option(
            min=0, max=65535, help="Answer over HTTP on this port, at /mcp; default: standard input and output."
        ),
    ] = None,
    host: Annotated[str, typer.Option(help="Address to listen on, with --port.")] = "127.0.0.1",
    folder: Annotated[
        Path | None,
        typer.Option("--folder", parser=path, metavar="FOLDER", help="Tools may read its files by name."),
    ] = None,
    twins: Annotated[
        bool, typer.Option("--twins", help="Also the calls with a body that have a twin with flat arguments.")
    ] = False,
) -> None:
    """Answer an assistant that speaks MCP: every question is a tool."""
    require("mcp", "mcp", "mcp")
    from app.assistant.server import create_server, serve_http, serve_streams

    if folder and not folder.is_dir():
        raise InvalidValue.in_words("folder", "--folder must be a folder", got=Given(str(folder), str(folder)))
    server: Any = create_server(folder=folder and folder.resolve(), twins=twins)
    if port is None:
        asyncio.run(serve_streams(server))
        return
    try:
        serve_http(server, host, port)
    except SystemExit as stop:  # The port is taken, or the address is not local; uvicorn has printed it.
        raise typer.Exit(2 if stop.code else 0) from stop
