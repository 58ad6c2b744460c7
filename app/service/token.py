"""Calls that need the token of the service, if it has one."""

from __future__ import annotations

from hmac import compare_digest

from fastapi import Request, Security
from fastapi.security import HTTPBearer

from app.service.problems import Refused

# Security of a call that may need the token, in the schema; guard() reads the token. The empty second entry says that a
# service may have none.
TOKEN = Security(HTTPBearer(scheme_name="token", description="The token of a service that has one", auto_error=False))
WITHOUT: list[dict[str, list[str]]] = [{}]


def guard(request: Request) -> None:
    """raises: Refused (401) without the token of this service, if it has one"""
    token = request.app.state.settings.token
    kind, _, credentials = request.headers.get("authorization", "").partition(" ")
    if token and not (kind.lower() == "bearer" and compare_digest(credentials.strip().encode(), token.encode())):
        words = "Jobs and uploads need the token of this service: send the header Authorization: Bearer TOKEN."
        challenge = {"WWW-Authenticate": 'Bearer realm="bench-dragon"'}
        raise Refused(401, words, {"name": "Authorization"}, challenge)
