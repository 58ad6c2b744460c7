"""The calls of the service: every question with query parameters, and with a body that has a dragon and a path.

A call has the name of its question, such as `collision_time`; the twin with a body is named `collision_time_of`.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from contextlib import suppress
from typing import Annotated, Any

from fastapi import APIRouter, Body, Path, Query, Response
from pydantic import ValidationError

from app.files.outlines import GEOJSON_TYPE
from app.files.tables import CSV_TYPE
from app.questions.registry import CALLS
from app.service.bodies import BodyReply, BodyRoute
from app.service.examples import EXAMPLES
from app.service.queries import QueryReply, QueryRoute
from app.service.reply import Reply
from app.wire.fields import Wire
from app.wire.problem import PROBLEM_TYPE
from app.wire.question import BYTES, JSON, Call, FileFormat

# The status of a job holds a problem, which brings the schema of problems into the description of the service.
PROBLEM = {PROBLEM_TYPE: {"schema": {"$ref": "#/components/schemas/Problem"}}}
FILE = {"schema": {"type": "string", "format": "binary"}}
# Stands first among the forms of a file: a generated client reads them all as the first form that it knows.
ANY_FILE = {BYTES: FILE}
# Schemas of the forms that are not plain files.
SCHEMAS = {JSON: {"schema": {}}, CSV_TYPE: {"schema": {"type": "string"}}, GEOJSON_TYPE: {"schema": {"type": "object"}}}
PROBLEMS = {
    400: "The body is not JSON",
    401: "The token of this service is missing",
    404: "There is no such format",
    406: "Accept asks for a media type that this call does not offer",
    413: "The body is too long",
    414: "The query is too long",
    415: "The body is not of a media type that this call takes",
    422: "A value is outside its limits, a name is unknown, or an instant lies after the end of the run",
    429: "This client has as many heavy computations running as it may",
    500: "The service failed",
    503: "The largest number of computations is running",
}
QUERY_STATUSES = (406, 414, 422, 429, 500, 503)
BODY_STATUSES = (400, 406, 413, 415, 422, 429, 500, 503)


def refusals(statuses: Iterable[int], reasons: Mapping[int, str] = PROBLEMS) -> dict[int | str, dict[str, Any]]:
    """Descriptions of problems. reasons: for each status"""
    return {status: {"description": reasons[status], "content": PROBLEM} for status in statuses}


def add_calls(router: APIRouter, calls: Iterable[Call] = CALLS.values()) -> None:
    """Add calls to the router of the service itself: FastAPI matches a request to a router that is included into
    another one twice, which takes 0.03 ms (2026-11-23)."""
    unchanged = {"description": "The client already has this answer (If-None-Match)"}
    for call in calls:
        question, method = call.question, call.method
        statuses = QUERY_STATUSES if method == "GET" else BODY_STATUSES
        content = {form: SCHEMAS.get(form, FILE) for form in question.forms}
        if question.model is None:
            content = ANY_FILE | content
        model: Any = question.model
        if question.several and method == "POST":
            model = model | question.several
        answer = {"description": "The answer", "content": content, "model": model}
        title = question.name.replace("_", " ").capitalize()
        router.add_api_route(
            question.path,
            _endpoint(call),
            methods=[method],
            operation_id=call.name,
            summary=title + (", in a body" if method == "POST" and question.flat else ""),
            description=question.summary,
            tags=["Figures" if question.model is None else "Questions"],
            response_class=Response,
            responses={200: answer, 304: unchanged, **refusals((404, *statuses) if question.formats else statuses)},
            openapi_extra={"security": []},
            route_class_override=BodyRoute if method == "POST" else None if question.formats else QueryRoute,
        )


def _endpoint(call: Call) -> Callable[..., Any]:
    """The function that FastAPI calls; its annotations describe the parameters."""

    def to_body(reply: Reply, inputs: Wire) -> Response:
        return reply(call, inputs)

    def figure_to_body(reply: Reply, format: FileFormat, inputs: Wire) -> Response:
        return reply(call, inputs, format)

    async def to_query(reply: Reply, inputs: Wire) -> Response:
        return await reply.to_query(call, inputs)

    async def figure_to_query(reply: Reply, format: FileFormat, inputs: Wire) -> Response:
        return await reply.to_query(call, inputs, format)

    figure, answer = (figure_to_query, to_query) if call.method == "GET" else (figure_to_body, to_body)
    endpoint: Callable[..., Any] = figure if call.question.formats else answer
    inputs: Any
    if call.method == "GET":
        replying, inputs = QueryReply, Annotated[call.request_type, Query()]
    else:
        example = EXAMPLES.get(f"POST {call.question.path}")
        # FastAPI gives the body a name, of which Pydantic warns unless its adapter is built at once, inside FastAPI.
        call.request_type.model_config["defer_build"] = False
        replying, inputs = BodyReply, Annotated[call.request_type, Body(examples=[example.body] if example else None)]
        with suppress(ValidationError):  # It is raised where a body is required; a missing one stands for the defaults.
            endpoint.__defaults__ = (call.request_type(),)
    endpoint.__name__ = call.name
    endpoint.__annotations__ |= {
        "reply": replying,
        "inputs": inputs,
        "format": Annotated[call.question.formats, Path(description="Format of the file")],
        "return": Response,
    }
    return endpoint
