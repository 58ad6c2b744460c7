"""Calls that need the token of the service, if it has one."""

from __future__ import annotations

from hmac import compare_digest

from fastapi import Request

from app.service.problems import Refused
from app.wire.problem import ErrorItem

TOKEN_SCHEME = {"token": {"type": "http", "scheme": "bearer", "description": "The token of a service that has one"}}
# Security entry of calls that may need the token, in the description of the service.
GUARDED: list[dict[str, list[str]]] = [{}, {"token": []}]


def guard(request: Request) -> None:
    """raises: Refused (401) without the token of this service, if it has one"""
    token = request.app.state.settings.token
    kind, _, given = request.headers.get("authorization", "").partition(" ")
    if token and not (kind.lower() == "bearer" and compare_digest(given.strip().encode(), token.encode())):
        detail = "Jobs and uploads need the token of this service: send the header Authorization: Bearer TOKEN."
        challenge = {"WWW-Authenticate": 'Bearer realm="bench-dragon"'}
        raise Refused(401, detail, [ErrorItem(name="Authorization", detail=detail)], challenge)
