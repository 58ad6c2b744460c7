"""POST /places: a map as the body, read in the memory of another process; nothing of it is kept or logged."""

from __future__ import annotations

from typing import Annotated

from fastapi import APIRouter, Depends, Query, Request, Response
from pydantic import Field

from app.files.tables import Language
from app.maps.places import Places, read_places
from app.questions.maps import FORMS
from app.service.graders import Graders
from app.service.grading import COST, FILE_TYPE, STATUSES, UploadRoute, file_body
from app.service.middleware import Lanes, client_of
from app.service.problems import Refused
from app.service.routes import FILE, refusals
from app.service.token import TOKEN, WITHOUT
from app.settings import Settings
from app.wire.problem import ErrorItem
from app.wire.question import JSON, Coordinates, Wire
from core.errors import too_much
from core.kernels import Halted

# Accepted media types; the form of a map follows from its first bytes, whichever of these is given.
TYPES = (
    FILE_TYPE,
    *FORMS,
    JSON,
    "application/vnd.google-earth.kmz",
    "application/toml",
    "application/dxf",
    "text/plain",
    "text/xml",
    "application/xml",
)


class PlacesQuery(Wire):
    """Query parameters beside the file."""

    name: str | None = Field(None, max_length=200, description="Name of the file; its form is told by its bytes")
    units: Coordinates | None = Field(
        None, description="Unit of its coordinates: metres or degrees; null: as the file says, or as they look"
    )
    language: Language = Field(Language.ENGLISH, description="Language of the notes: en or zh")


class MapRoute(UploadRoute):
    """A call whose body is a map."""

    def seconds(self, settings: Settings) -> float:
        return settings.places_seconds


router = APIRouter(tags=["Maps"], route_class=MapRoute)


@router.post(
    "/places",
    operation_id="places",
    response_class=Response,
    dependencies=[TOKEN],
    responses={200: {"description": "The answer", "model": Places, "content": {JSON: {}}}, **refusals(STATUSES)},
    openapi_extra={"security": WITHOUT, "requestBody": {"required": True, "content": {FILE_TYPE: FILE}}},
)
def places(
    request: Request, data: Annotated[bytes, Depends(file_body(TYPES))], wanted: Annotated[PlacesQuery, Query()]
) -> Response:
    """The square, its obstacles and the path in a map: GeoJSON, KML, KMZ, DXF, or a dance as TOML or JSON."""
    if not data:
        detail = "Send a map as the body: GeoJSON, KML, KMZ, DXF, or a dance as TOML or JSON."
        raise Refused(422, detail, [ErrorItem(name="file", detail=detail)])
    lanes: Lanes = request.app.state.lanes
    graders: Graders = request.app.state.graders
    budget = request.state.budget
    with lanes.of(COST, JSON).taken(COST, client_of(request)):
        try:
            found = graders.asked(budget, read_places, data, wanted.units, wanted.language)
        except Halted:
            raise too_much(budget, "file", "must be smaller: it was not read {then}", len(data), "bytes") from None
    if not isinstance(found, Places):
        refused, field, message = found
        raise refused.in_words(field, message)
    return Response(found.to_json(), headers={"Cache-Control": "no-store"}, media_type=JSON)
