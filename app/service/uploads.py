"""POST /grade and POST /places: a file as the body, read in the memory of another process; nothing of it is kept or
logged.

The file is the whole body, not a part of a form, so that its length is limited before it is read, and any HTTP client
sends it with one option. Further values are in the query.
"""

from __future__ import annotations

from collections.abc import Callable, Coroutine
from contextlib import AbstractContextManager
from dataclasses import replace
from typing import Annotated, Any

from fastapi import APIRouter, Depends, Query, Request, Response
from pydantic import BaseModel, Field

from app.files.tables import CSV_TYPE, XLSX_TYPE
from app.grade.report import GradeAnswer, graded, too_long, typed
from app.grade.shortcuts import UNITS
from app.maps.choice import Choice
from app.maps.places import Places, read_places
from app.maps.tracks import CHORD
from app.questions.maps import FORMS
from app.service.bodies import content_type, has_body, refuse_coded
from app.service.clients import client_of
from app.service.deadlines import WatchedRoute
from app.service.graders import Graders
from app.service.lanes import Lanes
from app.service.problems import CLOSE, Refused
from app.service.routes import FILE, refusals
from app.service.token import TOKEN, WITHOUT, guard
from app.settings import Settings
from app.wire.fields import Answer, Coordinates, OneLine, Wire, measure
from app.wire.question import BYTES, JSON, language_for
from core import BenchDragonError
from core.kernels import Halted
from core.language import Language, say, speaking
from core.quantities import Quantity
from core.questions import too_much

GRADED = (BYTES, XLSX_TYPE, CSV_TYPE)
# Accepted media types of maps; the form of a map follows from its first bytes, whichever of these is given.
MAPS = (
    *(BYTES, *FORMS, JSON, "application/vnd.google-earth.kmz", "application/toml", "application/dxf"),
    *("text/plain", "text/xml", "application/xml", XLSX_TYPE),
)
# Longest number that is typed [characters].
TYPED_MOST = 60
# Estimated time of a file, for the Retry-After of a full lane [s].
COST = 1.0
STATUSES = (401, 413, 414, 415, 422, 429, 500, 503)


class GradeQuery(Wire):
    """Query parameters beside the file."""

    name: OneLine = Field("upload", min_length=1, max_length=200, description="Name of the file, as result1.xlsx")
    language: Language = Field(Language.ENGLISH, description="Language of the words: en or zh")
    collision_time: str | None = measure("s", "Time of first contact", None, max_length=TYPED_MOST)
    pitch: str | None = measure("m", "Minimum pitch", None, max_length=TYPED_MOST)
    turn_length: str | None = measure("m", "Length of the turn", None, max_length=TYPED_MOST)
    speed: str | None = measure("m/s", "Maximum speed of the head", None, max_length=TYPED_MOST)


class PlacesQuery(Wire):
    """Query parameters beside the file."""

    name: OneLine | None = Field(
        None, max_length=200, description="Name of the file; its format is recognised from its first bytes"
    )
    units: Coordinates | None = Field(
        None,
        description="Unit of its coordinates: metres or degrees; default: as the file says, or recognised from them",
    )
    language: Language = Field(Language.ENGLISH, description="Language of the notes: en or zh")
    longest_chord: float = measure(
        "m", "Longest distance of the two handles of a bench, for which a walked track is smoothed", CHORD,
        ge=1e-3, le=50,
    )  # fmt: skip
    layers: OneLine | None = Field(
        None, max_length=2_000, description="Names of the layers of a DXF or GeoJSON that are read, with commas "
        "between them, and one that holds a comma in double quotation marks; default: all"
    )  # fmt: skip
    area: OneLine | None = measure(
        "m", "Of a DXF or GeoJSON, what reaches into this area is read: least x, least y, largest x, largest y, with "
        "commas between them; default: everything", None, max_length=200,
    )  # fmt: skip
    only_layers: bool = Field(
        False, description="Whether to answer with the layers of a DXF or GeoJSON and their edges alone"
    )

    def to_choice(self) -> Choice:
        """The part of a drawing that is read. raises: InvalidValue"""
        return replace(Choice.of(self.layers, self.area), counts=self.only_layers)


class UploadRoute(WatchedRoute):
    """A call whose body is a file, for which the service may want its token."""

    takes_file = True

    def refuse_head(self, request: Request) -> None:
        if has_body(request):
            try:
                guard(request)
            except Refused as refused:  # Nobody reads the body, so nothing can follow it.
                refused.headers = {**(refused.headers or {}), **CLOSE}
                raise


class GradeRoute(UploadRoute):
    """A call whose body is a file to grade."""

    def seconds(self, settings: Settings) -> float:
        return settings.grade_seconds


class MapRoute(UploadRoute):
    """A call whose body is a map."""

    def seconds(self, settings: Settings) -> float:
        return settings.places_seconds


def file_body(types: tuple[str, ...]) -> Callable[[Request], Coroutine[Any, Any, bytes]]:
    """A function that returns the body of a request. It raises Refused: 401 without the token, 415 for another type."""

    async def uploaded(request: Request) -> bytes:
        data = await request.body()
        if data:
            refuse_coded(request)
        kind = content_type(request)
        if data and kind not in types:
            names = say(" or ").join(types)
            words, place = "The body must be the file itself, of type {types}, got {type}.", {"name": "Content-Type"}
            values = {"types": names, "type": kind or "no Content-Type"}
            raise Refused(415, words, place, {"Accept-Post": ", ".join(types)}, **values)
        return data

    return uploaded


def description_of(name: str, model: type[BaseModel], *, required: bool) -> dict[str, Any]:
    """OpenAPI description of a call. required: whether it needs the file"""
    answer = {"description": "The answer", "model": model, "content": {JSON: {}}}
    body = {"required": required, "content": {BYTES: FILE}}
    return {
        "operation_id": name,
        "response_class": Response,
        "dependencies": [TOKEN],
        "responses": {200: answer, **refusals(STATUSES)},
        "openapi_extra": {"security": WITHOUT, "requestBody": body},
    }


def in_lane(request: Request) -> AbstractContextManager[None]:
    """A slot among the computations for one file. raises: Refused (429, 503)"""
    lanes: Lanes = request.app.state.lanes
    return lanes.files.slot(COST, client_of(request))


def reply_of(answer: Answer) -> Response:
    return Response(answer.to_json(), headers={"Cache-Control": "no-store"}, media_type=JSON)


grading = APIRouter(tags=["Grading"], route_class=GradeRoute)
maps = APIRouter(tags=["Maps"], route_class=MapRoute)


@grading.post("/grade", **description_of("grade", GradeAnswer, required=False))
def grade(
    request: Request, data: Annotated[bytes, Depends(file_body(GRADED))], inputs: Annotated[GradeQuery, Query()]
) -> Response:
    """Right and wrong cells of a contest workbook, and the known error that explains the wrong ones."""
    numbers = {name: text for name in UNITS if (text := getattr(inputs, name)) is not None}
    if not data and not numbers:
        words = "Send a workbook or CSV as the body, or a number such as pitch in the query."
        raise Refused(422, words, {"name": "name"})
    graders: Graders = request.app.state.graders
    budget = request.state.budget
    with in_lane(request), speaking(language_for(inputs)):
        answers = [typed(name, text) for name, text in numbers.items()]
        try:
            files = [graders.read(budget, graded, inputs.name, data)] if data else []
        except Halted:
            raise too_long(data, budget) from None
        except BenchDragonError as error:
            raise error.with_field("name") from error
    return reply_of(GradeAnswer(files=files, answers=answers))


@maps.post("/places", **description_of("places", Places, required=True))
def places(
    request: Request, data: Annotated[bytes, Depends(file_body(MAPS))], inputs: Annotated[PlacesQuery, Query()]
) -> Response:
    """The square, its obstacles and the path in a map: GeoJSON, KML, KMZ, DXF, or a dance as TOML or JSON.

    The benches in a workbook become `dance.dragon.csv`.
    """
    if not data:
        words = "The file is empty: send GeoJSON, KML, KMZ, DXF, or a dance as TOML or JSON; or a workbook of benches."
        raise Refused(422, words, {"name": "file"})
    graders: Graders = request.app.state.graders
    budget = request.state.budget
    with in_lane(request), speaking(language_for(inputs)):
        try:
            units, chord = inputs.units, inputs.longest_chord
            result = graders.read(budget, read_places, data, units, chord, inputs.to_choice())
        except Halted:
            raise too_much(
                budget, "file", "must be smaller: it was not read {then}", Quantity(len(data), "bytes")
            ) from None
    if isinstance(result, BenchDragonError):
        raise result
    return reply_of(result)
