"""Requests only for the hosts that the service is."""

from __future__ import annotations

import re

from starlette.datastructures import Headers
from starlette.types import ASGIApp, Receive, Scope, Send

from app.service.middleware import Layer
from app.service.problems import CLOSE, Refused
from app.settings import Settings
from app.wire.fields import short_json

# A host with or without a port, its name in group 1.
HOST = re.compile(r"([a-z0-9.-]+|\[[0-9a-f:.]+\])(?::[0-9]{1,5})?")
# Calls that answer under any host.
PROBES = ("/healthz", "/readyz")


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
