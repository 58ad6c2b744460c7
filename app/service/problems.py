"""Every error as an RFC 9457 problem: the error, its place, and what to change."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from http import HTTPStatus
from typing import get_type_hints

from fastapi import FastAPI, Request, Response
from fastapi.exceptions import RequestValidationError
from starlette.exceptions import HTTPException
from starlette.routing import Match, Mount

from app.wire.faults import Placing, in_body, in_query, refused, unfit
from app.wire.messages import fault_of
from app.wire.problem import PROBLEM_TYPE, ErrorItem, Problem, problem_of, title
from app.wire.question import shown
from app.wire.texts import Unfit, Unreadable
from core import BenchDragonError, TooMuchWork

# Advice to a client whose answer takes too much work.
A_JOB = "Ask for it as a job, which may take longer: POST /jobs, or this request with the header Prefer: respond-async."
METHODS = ("DELETE", "GET", "PATCH", "POST", "PUT")


class Refused(HTTPException):
    """A request refused by the service; errors name the place."""

    def __init__(
        self, status: int, detail: str, errors: Sequence[ErrorItem] = (), headers: Mapping[str, str] | None = None
    ) -> None:
        super().__init__(status, detail, headers)
        self.errors = errors


def problem(
    status: int, code: str, detail: str, errors: Iterable[ErrorItem] = (), headers: Mapping[str, str] | None = None
) -> Response:
    """The answer to a request that failed."""
    return answer_of(problem_of(status, code, detail, errors), headers)


def answer_of(said: Problem, headers: Mapping[str, str] | None = None) -> Response:
    kept = {"Cache-Control": "no-store", **(headers or {})}
    return Response(said.to_json(), said.status, kept, media_type=PROBLEM_TYPE)


def install(app: FastAPI) -> None:
    """Let the app answer every error with a problem."""
    app.add_exception_handler(BenchDragonError, core_problem)  # type: ignore[arg-type]
    app.add_exception_handler(RequestValidationError, validation_problem)  # type: ignore[arg-type]
    app.add_exception_handler(HTTPException, http_problem)  # type: ignore[arg-type]


async def core_problem(request: Request, error: BenchDragonError) -> Response:
    """Answer to a value refused by core or by a limit of the service."""
    said = refused(error, await _placing(request))
    if isinstance(error, TooMuchWork) and not _takes_file(request):
        said.detail = f"{said.detail.removesuffix('.')}. {A_JOB}"
    return answer_of(said)


async def validation_problem(request: Request, error: RequestValidationError) -> Response:
    """Answer to a request whose fields do not fit the schema."""
    found = error.errors()
    if found[0]["loc"][0] == "path":
        name, detail = found[0]["loc"][-1], fault_of(found[0], None).message
        return problem(404, "not-found", detail, [ErrorItem(name=name, detail=detail)])
    return answer_of(unfit(found, get_type_hints(request.scope["endpoint"]).get("wanted"), await _placing(request)))


def unreadable(error: Unreadable) -> Response:
    """Answer to a body that cannot be read as JSON."""
    detail = f"The body {error}. Send an object such as {{}}."
    status, code = (422, "invalid-value") if isinstance(error, Unfit) else (400, "broken-json")
    return problem(status, code, detail, [ErrorItem(pointer="", detail=detail)])


def _takes_file(request: Request) -> bool:
    return getattr(request.scope.get("route"), "takes_file", False)


async def _placing(request: Request) -> Placing:
    # The body of a call that takes a file is not JSON, so the fault is in its query.
    if request.method in ("GET", "HEAD") or _takes_file(request):
        return in_query
    return in_body(await request.json() if await request.body() else {})


async def http_problem(request: Request, error: HTTPException) -> Response:
    """Answer to an error of HTTP itself: unknown path, method, media type and so on."""
    status, headers = error.status_code, dict(error.headers or {})
    detail, code = str(error.detail), title(status).lower().replace(" ", "-")
    items: Sequence[ErrorItem] = getattr(error, "errors", ())
    if status == 404 and detail == HTTPStatus.NOT_FOUND.phrase:
        detail = f"There is nothing at {shown(request.url.path)}: see /docs for all calls."
    elif status == 405:
        headers["Allow"] = ", ".join(sorted(_allowed(request)))
        if request.method == "OPTIONS":
            return Response(status_code=204, headers=headers)
        detail = f"{request.url.path} does not support {request.method}: use {headers['Allow']}."
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
    """Answer to an internal error; only the log has the traceback."""
    return problem(500, "internal-error", "The service failed on this request; its log has the reason.")
