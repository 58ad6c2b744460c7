"""The target of a request: in absolute form as in origin form, and only at the hosts that the service is."""

from __future__ import annotations

import re
from urllib.parse import unquote

from starlette.datastructures import Headers
from starlette.types import ASGIApp, Receive, Scope, Send

from app.service.middleware import Layer
from app.service.problems import CLOSE, Refused
from app.settings import Settings
from app.wire.fields import short_json

# A target in absolute form, its host and its path.
ABSOLUTE = re.compile(rb"https?://([^/]+)(/.*)?", re.IGNORECASE)
# A host with or without a port, its name in group 1.
HOST = re.compile(r"([a-z0-9.-]+|\[[0-9a-f:.]+\])(?::[0-9]{1,5})?")
# Calls that answer under any host.
PROBES = ("/healthz", "/readyz")


class OriginForm(Layer):
    """Takes the target in absolute form as in origin form: GET http://host/turn as GET /turn (RFC 9112, 3.2.2).

    Its host then takes the place of the header Host.
    """

    async def answer(self, scope: Scope, receive: Receive, send: Send) -> None:
        if match := ABSOLUTE.fullmatch(scope["raw_path"]):
            host, path = match[1], match[2] or b"/"
            headers = [(b"host", host), *(one for one in scope["headers"] if one[0] != b"host")]
            scope = {**scope, "raw_path": path, "path": unquote(path.decode("ascii")), "headers": headers}
        await self.app(scope, receive, send)


class Hosts(Layer):
    """Answers 421 to a request for a host that the service is not, if a setting names those that it is.

    A page of a stranger can give its own name the address of this machine (DNS rebinding); its requests come under that
    name. Probes of health ask by whatever address there is, and their answers hold nothing.
    """

    def __init__(self, app: ASGIApp, settings: Settings) -> None:
        super().__init__(app)
        self.names = frozenset(settings.hosts.split(",")) if settings.hosts else None

    async def answer(self, scope: Scope, receive: Receive, send: Send) -> None:
        if self.names is None or scope["path"] in PROBES or self._name(scope) in self.names:
            return await self.app(scope, receive, send)
        words = "This service is not {host}: ask it under one of its names."
        got = Headers(scope=scope).get("host", "")
        refused = Refused(421, words, {"name": "Host"}, CLOSE, host=short_json(got) if got else "a host without a name")
        return await self.refuse(refused, scope, receive, send)

    @staticmethod
    def _name(scope: Scope) -> str:
        """The host of a request, without its port; empty if the header holds none."""
        match = HOST.fullmatch(Headers(scope=scope).get("host", "").lower())
        return match[1].rstrip(".") if match else ""
