"""The command serve: the HTTP service and the web page."""

from __future__ import annotations

import sys
from typing import Annotated

import typer

from app.extras import require
from app.settings import WORKERS_MAX
from core.language import say


def serve(
    host: Annotated[str, typer.Option(help="Address to listen on.")] = "127.0.0.1",
    port: Annotated[int, typer.Option(min=0, max=65535, help="Port to listen on.")] = 8000,
    workers: Annotated[
        int | None,
        typer.Option(min=1, max=WORKERS_MAX, help="Processes that share the port; default: one for each core."),
    ] = None,
) -> None:
    """Start the HTTP service and the web page."""
    require("service", "serve", "serve")
    from app.service import workers as processes

    count = processes.process_count(workers)
    try:
        processes.serve(host, port, count)
    except OSError as taken:
        message = say(
            "Error: cannot listen on {host}:{port}: {why}; choose another --port",
            host=host,
            port=port,
            why=taken.strerror,
        )
        print(message, file=sys.stderr)
        raise typer.Exit(2) from taken
    except SystemExit as stop:  # The port is taken, or the address is not local; uvicorn has printed it.
        raise typer.Exit(2 if stop.code else 0) from stop
