"""Where a request goes and comes from: its target in absolute form as in origin form; and what a proxy in front says
of its client and scheme, and of the path under which the service stands there.

A proxy passes /dance/jobs on as /jobs; addresses in answers need the whole path. It follows from the setting
root_path, or from X-Forwarded-Prefix of a proxy that is trusted as for X-Forwarded-For (FORWARDED_ALLOW_IPS). A proxy
that passes on the whole path is understood where the setting names it.
"""

from __future__ import annotations

import os
import re
from typing import Any
from urllib.parse import unquote

from starlette.datastructures import Headers
from starlette.types import ASGIApp, Receive, Scope, Send
from uvicorn.middleware.proxy_headers import ProxyHeadersMiddleware

from app.service.middleware import Layer
from app.settings import ROOT_PATH, Settings

# A target in absolute form, its host and its path.
ABSOLUTE = re.compile(rb"https?://([^/]+)(/.*)?", re.IGNORECASE)
# Addresses of this machine, from which a proxy on it comes.
HERE = "127.0.0.1,::1"
# IPv4 on a socket of IPv6, which FORWARDED_ALLOW_IPS names as IPv4.
MAPPED = "::ffff:"


class Proxies(ProxyHeadersMiddleware):
    """The outermost layer: takes the client, scheme and root path of a request from its proxy, and its host from a
    target in absolute form: GET http://host/turn as GET /turn (RFC 9112, 3.2.2).

    The layers below see the path without the root; WholePath adds it for the router.
    """

    def __init__(self, app: ASGIApp, settings: Settings) -> None:
        super().__init__(app, os.environ.get("FORWARDED_ALLOW_IPS", HERE))  # type: ignore[arg-type]
        self.root = settings.root_path

    async def __call__(self, scope: Any, receive: Any, send: Any) -> None:
        if scope["type"] == "http":
            if match := ABSOLUTE.fullmatch(scope["raw_path"]):
                host, path = match[1], match[2] or b"/"
                headers = [(b"host", host), *(one for one in scope["headers"] if one[0] != b"host")]
                scope = {**scope, "raw_path": path, "path": unquote(path.decode("ascii")), "headers": headers}
            root = scope.get("root_path") or self.root
            client = scope.get("client")
            if client and client[0].startswith(MAPPED):
                client = (client[0].removeprefix(MAPPED), client[1])
            if client and client[0] in self.trusted_hosts:
                prefix = Headers(scope=scope).get("x-forwarded-prefix", "").rstrip("/")
                root = prefix if prefix and ROOT_PATH.fullmatch(prefix) else root
            scope = {**scope, "root_path": root, "client": client}
            if self.root and scope["path"].startswith(f"{self.root}/"):
                scope["path"] = scope["path"].removeprefix(self.root)
                scope["raw_path"] = scope["raw_path"].removeprefix(self.root.encode())
        await super().__call__(scope, receive, send)


class WholePath(Layer):
    """The innermost layer: gives the router the whole path, from which it takes the root away again."""

    async def answer(self, scope: Scope, receive: Receive, send: Send) -> None:
        scope["path"] = scope["root_path"] + scope["path"]
        await self.app(scope, receive, send)
