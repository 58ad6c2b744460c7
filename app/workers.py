"""The service in several processes on one port: the Python around each answer then runs on several cores."""

from __future__ import annotations

import socket

import uvicorn
from uvicorn.supervisors import Multiprocess


def listen(host: str, port: int) -> socket.socket:
    """A listening socket whose connections send at once.

    asyncio switches off Nagle's delay (TCP_NODELAY) only for sockets that name TCP as their protocol; with uvicorn's
    own shared socket the second packet of an answer waited for the client's delayed acknowledgement, 40 ms.
    raises: OSError when the port is taken or the address is not ours
    """
    family = socket.AF_INET6 if ":" in host else socket.AF_INET
    shared = socket.socket(family, socket.SOCK_STREAM, socket.IPPROTO_TCP)
    shared.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
    try:
        shared.bind((host, port))
    except OSError:
        shared.close()
        raise
    shared.set_inheritable(True)
    return shared


def serve(host: str, port: int, workers: int) -> None:
    """Serve until interrupted, in one process or in several."""
    if workers == 1:
        uvicorn.run("app.main:create_app", factory=True, host=host, port=port)
        return
    config = uvicorn.Config("app.main:create_app", factory=True, host=host, port=port, workers=workers)
    with listen(host, port) as shared:
        Multiprocess(config, sockets=[shared]).run()
