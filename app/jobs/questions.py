"""Which call answers a question: the one door from jobs to the questions of the service."""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import Any
from urllib.parse import urlencode

from fastapi.routing import APIRoute

from app import api, figure_calls
from app.jobs.call import Call
from app.reply import JSON

# By operation id.
ROUTES = {
    route.name: route
    for router in (api.router, figure_calls.router)
    for route in router.routes
    if isinstance(route, APIRoute)
}


def call_of(question: str, request: Mapping[str, Any], accept: str) -> Call:
    """The call that asks a question; what stands in the path of the call, such as the format of a figure, stands in
    the request. raises: KeyError for a question that is not known"""
    route, values = ROUTES[question], dict(request)
    path = route.path
    for name in route.param_convertors:
        path = path.replace(f"{{{name}}}", _text(values.pop(name, "")))
    if "GET" in (route.methods or ()):
        given = {name: _text(value) for name, value in values.items() if value is not None}
        return Call("GET", path, urlencode(given), accept, "", b"")
    return Call("POST", path, "", accept, JSON, json.dumps(values).encode())


def _text(value: Any) -> str:
    return value if isinstance(value, str) else json.dumps(value)
