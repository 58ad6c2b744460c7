"""Every error as an RFC 9457 problem: what is wrong, where, and what to change."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from http import HTTPStatus
from itertools import islice
from typing import Any, get_type_hints

from fastapi import FastAPI, Request, Response
from fastapi.exceptions import RequestValidationError
from pydantic import BaseModel, Field
from starlette.exceptions import HTTPException
from starlette.routing import Match, Mount

from app.wire.dances import SHAPES
from app.wire.messages import message, shown
from core import BenchDragonError

PROBLEM_TYPE = "application/problem+json"
# More errors than this in one request are counted, not listed.
ERRORS_MAX = 20
# Longer details and places are cut [characters], so that a problem has less than 20 kB.
DETAIL_MAX, PLACE_MAX = 300, 200
# Titles by RFC 9110, which newer Pythons know by these names and older ones do not.
TITLES = {413: "Content Too Large", 414: "URI Too Long", 422: "Unprocessable Content"}
METHODS = ("DELETE", "GET", "PATCH", "POST", "PUT")
# What pydantic says of a union, though it is the field `kind` that is wrong.
UNION_ERRORS = frozenset({"union_tag_invalid", "union_tag_not_found"})


class ErrorItem(BaseModel):
    """One thing that is wrong."""

    pointer: str | None = Field(None, description="JSON pointer into the body")
    name: str | None = Field(None, description="Name of the query parameter or header")
    detail: str = Field(description="What is wrong and what to change")


class Problem(BaseModel):
    """RFC 9457 problem details."""

    type: str = Field(description="Stable identifier of the kind of problem")
    title: str = Field(description="The status in words")
    status: int = Field(description="HTTP status")
    detail: str = Field(description="What is wrong and what to change")
    errors: list[ErrorItem] = Field(description="Each thing that is wrong, with its place")


class Refused(HTTPException):
    """A request that the edge refuses; errors name the place."""

    def __init__(
        self, status: int, detail: str, errors: Sequence[ErrorItem] = (), headers: Mapping[str, str] | None = None
    ) -> None:
        super().__init__(status, detail, headers)
        self.errors = errors


def problem(
    status: int, code: str, detail: str, errors: Iterable[ErrorItem] = (), headers: Mapping[str, str] | None = None
) -> Response:
    """The answer to a request that failed."""
    body = Problem(
        type=f"urn:problem-type:bench-dragon:{code}",
        title=_title(status),
        status=status,
        detail=_plain(detail, 2 * DETAIL_MAX),
        errors=[
            ErrorItem(pointer=one.pointer, name=one.name and _plain(one.name, PLACE_MAX), detail=_plain(one.detail))
            for one in islice(errors, ERRORS_MAX)
        ],
    )
    return Response(
        body.model_dump_json(exclude_none=True),
        status,
        {"Cache-Control": "no-store", **(headers or {})},
        media_type=PROBLEM_TYPE,
    )


def _plain(text: str, most: int = DETAIL_MAX) -> str:
    """Text that may be sent: cut where it is long, without half characters."""
    text = text if len(text) <= most else f"{text[:most]}... ({len(text)} characters)"
    return text.encode(errors="replace").decode()


def _title(status: int) -> str:
    return TITLES.get(status) or HTTPStatus(status).phrase


def install(app: FastAPI) -> None:
    """Let the app answer every error with a problem."""
    app.add_exception_handler(BenchDragonError, core_problem)  # type: ignore[arg-type]
    app.add_exception_handler(RequestValidationError, validation_problem)  # type: ignore[arg-type]
    app.add_exception_handler(HTTPException, http_problem)  # type: ignore[arg-type]


async def core_problem(request: Request, error: BenchDragonError) -> Response:
    """A value that core, or a limit of the service, refuses."""
    place = tuple(int(part) if part.isdigit() else part for part in error.field.split("."))
    return problem(422, error.code, error.message, [await _item(request, place, error.message)])


async def validation_problem(request: Request, error: RequestValidationError) -> Response:
    """A request whose fields do not fit the schema, or a body that is no JSON."""
    found = error.errors()
    if found[0]["type"] == "json_invalid":
        position, why = found[0]["loc"][-1], found[0]["ctx"]["error"]
        detail = f"The body is not JSON: {why} at character {position}. Send an object such as {{}}."
        return problem(400, "broken-json", detail, [ErrorItem(pointer="", detail=detail)])
    if found[0]["loc"][0] == "path":
        return await http_problem(request, HTTPException(404))
    for one in found:
        one["loc"] = (*one["loc"], "kind") if one["type"] in UNION_ERRORS else one["loc"]
    asked = get_type_hints(request.scope["endpoint"]).get("wanted")
    items = [await _item(request, one["loc"][1:], message(one, asked)) for one in found[:ERRORS_MAX]]
    more = f" (and {len(found) - 1} more)" if len(found) > 1 else ""
    return problem(422, "invalid-value", items[0].detail + more, items)


async def http_problem(request: Request, error: HTTPException) -> Response:
    """An error of HTTP itself: no such path, method, media type and so on."""
    status, headers = error.status_code, dict(error.headers or {})
    detail, code = str(error.detail), _title(status).lower().replace(" ", "-")
    items: Sequence[ErrorItem] = getattr(error, "errors", ())
    if status == 404:
        detail = f"There is nothing at {shown(request.url.path)}: see /docs for all calls."
    elif status == 405:
        headers["Allow"] = ", ".join(sorted(_allowed(request)))
        if request.method == "OPTIONS":
            return Response(status_code=204, headers=headers)
        detail = f"{request.url.path} does not know {request.method}: use {headers['Allow']}."
    elif status == 400 and detail == "There was an error parsing the body":
        detail, code = "The body is not JSON in UTF-8. Send an object such as {}.", "broken-json"
        items = [ErrorItem(pointer="", detail=detail)]
    return problem(status, code, detail, items, headers)


def _allowed(request: Request) -> set[str]:
    """Every method that some call at this path knows."""
    found = {
        "GET" if isinstance(route, Mount) else method
        for method in METHODS
        for route in request.app.routes
        if route.matches({**request.scope, "method": method})[0] is Match.FULL
    }
    return found | {"OPTIONS"} | ({"HEAD"} if "GET" in found else set())


def server_problem() -> Response:
    """A mistake of ours; the log has the traceback, the client has not."""
    return problem(500, "internal-error", "The service failed on this request; the log of the service says why.")


async def _item(request: Request, place: Sequence[Any], detail: str) -> ErrorItem:
    if request.method in ("GET", "HEAD"):
        name = next((part for part in reversed(place) if isinstance(part, str)), "")
        return ErrorItem(name=name, detail=detail)
    body = await request.json() if await request.body() else {}
    return ErrorItem(pointer=pointer(place, body), detail=detail)


def pointer(place: Sequence[Any], body: Any) -> str:
    """JSON pointer to a place in a body, without names of shapes and indices into what is no list there.

    >>> pointer(("dragon", "uniform", "width"), {"dragon": {"width": -1}})
    '/dragon/width'
    """
    steps = []
    for step in place:
        if isinstance(step, int) and not isinstance(body, list):
            break
        if step in SHAPES and not (isinstance(body, dict) and step in body):
            continue
        if len(str(step)) > PLACE_MAX:
            break
        steps.append(str(step).replace("~", "~0").replace("/", "~1"))
        inside = isinstance(body, list) or (isinstance(body, dict) and step in body)
        body = body[step] if inside else None
    return _plain("".join(f"/{step}" for step in steps), ERRORS_MAX * PLACE_MAX)
