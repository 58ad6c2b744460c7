"""Every error as an RFC 9457 problem: the error, its place, and what to change."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from http import HTTPStatus
from typing import Self, get_type_hints

from fastapi import FastAPI, Request, Response
from fastapi.exceptions import RequestValidationError
from starlette.exceptions import HTTPException
from starlette.routing import Match, Mount

from app.wire.faults import Placing, in_body, in_query, misfit_problem, refusal_problem
from app.wire.fields import short_json
from app.wire.messages import fault_of
from app.wire.problem import PROBLEM_TYPE, ErrorItem, Problem, item_of, problem_of, title
from app.wire.texts import Unfit, Unreadable
from core import BenchDragonError, TooMuchWork
from core.language import phrase, say
from core.quantities import Parameter, Value

# Advice to a client whose answer takes too much work.
A_JOB = phrase(
    "Ask for it as a job, which may take longer: POST /jobs, or this request with the header Prefer: respond-async."
)
CLOSE = {"Connection": "close"}
METHODS = ("DELETE", "GET", "PATCH", "POST", "PUT")


class Refused(HTTPException):
    """A request refused by the service.

    template, got, reason, values: of BenchDragonError.in_words(); place: pointer into the body, or name of the wrong
    parameter or header
    """

    def __init__(
        self,
        status: int,
        template: str,
        place: Mapping[str, str] | None = None,
        headers: Mapping[str, str] | None = None,
        **values: Value,
    ) -> None:
        self.error = BenchDragonError.in_words("", template, **values)
        super().__init__(status, self.error.message, headers)
        self.errors = [] if place is None else [item_of(self.error, **place)]

    @classmethod
    def names(cls, names: Iterable[str], rule: str, advice: str) -> Self:
        """A refusal (422) of names in a query; rule: what is wrong with each; advice: what to do."""
        words = f"{{field}} {rule}"
        refused = [cls(422, words, {"name": name}, reason=advice, field=Parameter(name[:60])) for name in names]
        refused[0].errors = [item for one in refused for item in one.errors]
        return refused[0]


def problem(
    status: int,
    code: str,
    error: BenchDragonError | str,
    errors: Iterable[ErrorItem] = (),
    headers: Mapping[str, str] | None = None,
    **values: Value,
) -> Response:
    """The answer to a request that failed; see problem_of()."""
    return response_of(problem_of(status, code, error, errors, **values), headers)


def response_of(details: Problem, headers: Mapping[str, str] | None = None) -> Response:
    kept = {"Cache-Control": "no-store", **(headers or {})}
    return Response(details.to_json(), details.status, kept, media_type=PROBLEM_TYPE)


def install(app: FastAPI) -> None:
    """Let the app answer every error with a problem."""
    app.add_exception_handler(BenchDragonError, core_problem)  # type: ignore[arg-type]
    app.add_exception_handler(RequestValidationError, validation_problem)  # type: ignore[arg-type]
    app.add_exception_handler(HTTPException, http_problem)  # type: ignore[arg-type]


async def core_problem(request: Request, error: BenchDragonError) -> Response:
    """Answer to a value refused by core or by a limit of the service."""
    details = refusal_problem(error, await _placing(request))
    if isinstance(error, TooMuchWork) and not _takes_file(request):
        details.detail = details.detail.removesuffix(".") + say(". ") + say(A_JOB)
    return response_of(details)


async def validation_problem(request: Request, error: RequestValidationError) -> Response:
    """Answer to a request whose fields do not fit the schema."""
    faults = error.errors()
    if faults[0]["loc"][0] == "path":
        fault = fault_of(faults[0], None)
        return problem(404, "not-found", fault, [item_of(fault, name=faults[0]["loc"][-1])])
    return response_of(
        misfit_problem(faults, get_type_hints(request.scope["endpoint"]).get("inputs"), await _placing(request))
    )


def unreadable(error: Unreadable) -> Response:
    """Answer to a body that cannot be read as JSON."""
    reason = f"{error.reason}. Send an object such as {{}}." if error.reason else "send an object such as {}."
    fault = error.of("", "The body").because(reason)
    status, code = (422, "invalid-value") if isinstance(error, Unfit) else (400, "broken-json")
    return problem(status, code, fault, [item_of(fault, pointer="")])


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
    fault: BenchDragonError | str = error.error if isinstance(error, Refused) else str(error.detail)
    items, code = getattr(error, "errors", ()), title(status).lower().replace(" ", "-")
    path = request.url.path
    if status == 404 and fault == HTTPStatus.NOT_FOUND.phrase:
        fault = BenchDragonError.in_words(
            "", "There is nothing at {path}: see /docs for all calls.", path=short_json(path)
        )
    elif status == 405:
        headers["Allow"] = ", ".join(sorted(_allowed(request)))
        if request.method == "OPTIONS":
            return Response(status_code=204, headers=headers)
        words = {"path": path, "method": request.method, "methods": headers["Allow"]}
        fault = BenchDragonError.in_words("", "{path} does not support {method}: use {methods}.", **words)
    return problem(status, code, fault, items, headers)


def _allowed(request: Request) -> set[str]:
    """Every method that some call at this path knows."""
    # A folder of files has made its own path part of the root.
    root = request.scope.get("app_root_path", request.scope.get("root_path", ""))
    methods = {
        "GET" if isinstance(route, Mount) else method
        for method in METHODS
        for route in request.app.routes
        if route.matches({**request.scope, "root_path": root, "method": method})[0] is Match.FULL
    }
    return methods | {"OPTIONS"} | ({"HEAD"} if "GET" in methods else set())


def server_problem() -> Response:
    """Answer to an internal error; only the log has the traceback."""
    return problem(500, "internal-error", "The service failed on this request; its log has the reason.")
