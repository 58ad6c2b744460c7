"""The command mcp: the calls of the service as tools for an assistant."""

from __future__ import annotations

import asyncio
from pathlib import Path
from typing import Annotated, Any

import typer

from app.command.usage import path
from app.extras import require


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

    server: Any = create_server(folder=folder and folder.resolve(), twins=twins)
    if port is None:
        asyncio.run(serve_streams(server))
    else:
        serve_http(server, host, port)
