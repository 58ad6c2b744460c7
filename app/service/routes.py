"""The calls of the service: every question over a query, and over a body with a dragon and a path.

A call is named as its question is, `collision_time`; over a body, where it can be asked both ways, `collision_time_of`.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Annotated, Any

from fastapi import APIRouter, Body, Query, Response
from pydantic import ValidationError

from app.files.tables import CSV_TYPE
from app.questions import QUESTIONS, Question
from app.questions.figures import Format
from app.service.bodies import BodyRoute
from app.service.examples import EXAMPLES
from app.service.problems import PROBLEM_TYPE
from app.service.reply import BodyReply, QueryReply, Reply
from app.wire.models import JSON, Wire

PROBLEM = {PROBLEM_TYPE: {"schema": {"$ref": "#/components/schemas/Problem"}}}
FILE = {"schema": {"type": "string", "format": "binary"}}
TEXT = {"schema": {"type": "string"}}
PROBLEMS = {
    400: "The body is not JSON",
    404: "There is no such format",
    406: "Accept asks for a form that this call does not answer in",
    413: "The body is too long",
    414: "The query is too long",
    415: "The body is not of type application/json",
    422: "A value is outside its limits, a name is unknown, or an instant lies after the end of the run",
    500: "The service failed",
    503: "As many computations run as may run at once",
}
QUERY_STATUSES = (406, 414, 422, 500, 503)
BODY_STATUSES = (400, 406, 413, 415, 422, 500, 503)


def router() -> APIRouter:
    """A call for every question and way to ask it."""
    found = APIRouter()
    for question in QUESTIONS.values():
        wanted: Any
        if question.flat:
            wanted = Annotated[question.flat, Query()]
            _add(found, question, "GET", question.name, QueryReply, wanted)
        if question.body:
            name = f"{question.name}_of" if question.flat else question.name
            example = EXAMPLES.get(f"POST {question.path}")
            wanted = Annotated[question.body, Body(examples=[example.body] if example else None)]
            _add(found, question, "POST", name, BodyReply, wanted, *_default(question.body))
    return found


def _default(body: type[Wire]) -> tuple[Wire, ...]:
    """What is asked where a request has no body; empty where it must have one."""
    try:
        return (body(),)
    except ValidationError:
        return ()


def _add(
    router: APIRouter, question: Question, method: str, name: str, replying: Any, wanted: Any, *default: Wire
) -> None:
    statuses = QUERY_STATUSES if method == "GET" else BODY_STATUSES
    if question.model is None:
        statuses = (404, *statuses)
    problems: dict[int | str, dict[str, Any]] = {
        status: {"description": PROBLEMS[status], "content": PROBLEM} for status in statuses
    }
    unchanged = {"description": "The client has this answer already (If-None-Match)"}
    content: dict[str, Any] = {form: TEXT if form == CSV_TYPE else FILE for form in question.forms if form != JSON}
    if question.model is not None:
        content = {JSON: {"example": EXAMPLES[f"{method} {question.path}"].answer}, **content}
    answer = {"description": "The answer", "content": content, "model": question.model}
    router.add_api_route(
        question.path,
        _endpoint(question, name, replying, wanted, default),
        methods=[method],
        operation_id=name,
        summary=name.removesuffix("_of").replace("_", " ").capitalize() + (", in a body" if method == "POST" else ""),
        description=question.summary,
        tags=["Figures" if question.model is None else "Questions"],
        response_class=Response,
        responses={200: answer, 304: unchanged, **problems},
        openapi_extra={"security": []},
        route_class_override=BodyRoute if method == "POST" else None,
    )


def _endpoint(
    question: Question, name: str, replying: Any, wanted: Any, default: tuple[Wire, ...]
) -> Callable[..., Response]:
    """What FastAPI calls, which reads its parameters from the annotations."""

    def answer(reply: Reply, wanted: Wire) -> Response:
        return reply(question, wanted)

    def figure(reply: Reply, format: Format, wanted: Wire) -> Response:
        return reply(question, wanted, format)

    endpoint = answer if question.model else figure
    endpoint.__name__, endpoint.__defaults__ = name, default
    endpoint.__annotations__ |= {"reply": replying, "wanted": wanted, "format": Format, "return": Response}
    return endpoint
