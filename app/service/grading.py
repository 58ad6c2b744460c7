"""POST /grade: a workbook or CSV as the body, graded in the memory of a process; nothing of it is kept or logged.

The file is the whole body, not a part of a form, so that its length is limited before it is read, and any HTTP client
sends it with one option. Further numbers are in the query.
"""

from __future__ import annotations

from collections.abc import Callable, Coroutine
from typing import Annotated, Any

from fastapi import APIRouter, Depends, Query, Request, Response
from pydantic import Field

from app.files.tables import CSV_TYPE, XLSX_TYPE, Language
from app.grade.report import FileAnswer, GradeAnswer, graded, too_long, typed
from app.grade.shortcuts import UNITS
from app.service.bodies import WatchedRoute
from app.service.graders import Graders
from app.service.middleware import Lanes, client_of
from app.service.problems import Refused
from app.service.routes import FILE, refusals
from app.service.token import TOKEN, WITHOUT, guard
from app.settings import Settings
from app.wire.problem import ErrorItem
from app.wire.question import JSON, Wire, measure
from core import Budget
from core.kernels import Halted

FILE_TYPE = "application/octet-stream"
TYPES = (FILE_TYPE, XLSX_TYPE, CSV_TYPE)
# Estimated time of a file, for the Retry-After of a full lane [s].
COST = 1.0
STATUSES = (401, 413, 414, 415, 422, 429, 500, 503)
# A number as it was typed, because its digits show its rounding.
TYPED = r"^[0-9]{1,6}(\.[0-9]{1,15})?$"


class GradeQuery(Wire):
    """Query parameters beside the file."""

    name: str = Field("upload", min_length=1, max_length=200, description="Name of the file, as result1.xlsx")
    language: Language = Field(Language.ENGLISH, description="Language of the words: en or zh")
    collision_time: str | None = measure("s", "Time of first contact", None, pattern=TYPED)
    pitch: str | None = measure("m", "Minimum pitch", None, pattern=TYPED)
    turn_length: str | None = measure("m", "Length of the turn", None, pattern=TYPED)
    speed: str | None = measure("m/s", "Maximum speed of the head", None, pattern=TYPED)


class UploadRoute(WatchedRoute):
    """A call whose body is a file."""

    takes_file = True

    def seconds(self, settings: Settings) -> float:
        return settings.grade_seconds


router = APIRouter(tags=["Grading"], route_class=UploadRoute)


def file_body(types: tuple[str, ...]) -> Callable[[Request], Coroutine[Any, Any, bytes]]:
    """A function that returns the body of a request. It raises Refused: 401 without the token, 415 for another type."""

    async def uploaded(request: Request) -> bytes:
        data = await request.body()
        if data:
            guard(request)
        kind = request.headers.get("content-type", "").partition(";")[0].strip().lower()
        if data and kind not in types:
            known = " or ".join(types)
            detail = f"The body must be the file itself, of type {known}, got {kind or 'no Content-Type'}."
            item = ErrorItem(name="Content-Type", detail=detail)
            raise Refused(415, detail, [item], {"Accept-Post": ", ".join(types)})
        return data

    return uploaded


@router.post(
    "/grade",
    operation_id="grade",
    response_class=Response,
    dependencies=[TOKEN],
    responses={200: {"description": "The answer", "model": GradeAnswer, "content": {JSON: {}}}, **refusals(STATUSES)},
    openapi_extra={"security": WITHOUT, "requestBody": {"required": False, "content": {FILE_TYPE: FILE}}},
)
def grade(
    request: Request, data: Annotated[bytes, Depends(file_body(TYPES))], wanted: Annotated[GradeQuery, Query()]
) -> Response:
    """Right and wrong cells of a contest workbook, and the known error that explains the wrong ones."""
    given = {name: text for name in UNITS if (text := getattr(wanted, name)) is not None}
    if not data and not given:
        detail = "Send a workbook or CSV as the body, or a number such as pitch in the query."
        raise Refused(422, detail, [ErrorItem(name="name", detail=detail)])
    lanes: Lanes = request.app.state.lanes
    graders: Graders = request.app.state.graders
    with lanes.of(COST, JSON).taken(COST, client_of(request)):
        answers = [typed(name, text, wanted.language) for name, text in given.items()]
        files = [_graded(graders, data, wanted, request.state.budget)] if data else []
    answer = GradeAnswer(files=files, answers=answers)
    return Response(answer.to_json(), headers={"Cache-Control": "no-store"}, media_type=JSON)


def _graded(graders: Graders, data: bytes, wanted: GradeQuery, budget: Budget) -> FileAnswer:
    try:
        return graders.asked(budget, graded, wanted.name, data, wanted.language)
    except Halted:
        raise too_long(data, budget) from None
