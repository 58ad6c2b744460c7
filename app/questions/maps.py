"""The dance as a map: its square, its path and the chalk marks along it."""

from __future__ import annotations

import orjson
from pydantic import Field

from app.files.outlines import DXF_TYPE, GEOJSON_TYPE
from app.maps import dxf, geojson, kml
from app.maps.marks import MARKS_MAX, MarkedDance, drawing_of, in_degrees, marks_of, on_grid
from app.questions.check import FILE_OF_CHECK, DanceCheck
from app.wire import degrees
from app.wire.fields import Wire, check_limit, measure
from app.wire.paths import AnyPath
from app.wire.performances import SeveralFields
from app.wire.question import Command, FileFormat, Output, Question, Terms
from core import InvalidValue
from core.language import say

KML_TYPE = "application/vnd.google-earth.kml+xml"
# Time of a map of 1,400 m of path, measured 2026-11-22 [s].
SECONDS = 0.2


class MapFormat(FileFormat):
    """File format of a map."""

    GEOJSON = "geojson", GEOJSON_TYPE
    KML = "kml", KML_TYPE
    DXF = "dxf", DXF_TYPE


FORMS = tuple(one.media_type for one in MapFormat)


class OriginFields(Wire, strict=True):
    """A place on earth."""

    longitude: float = measure("degrees", "Longitude of x = y = 0, east positive", ge=-180, le=180)
    latitude: float = measure("degrees", "Latitude of x = y = 0, north positive", ge=-90, le=90)


class Marked(DanceCheck, strict=True):
    """A dance, as for /check, and the marks along its path."""

    spacing: float = measure("m", "Distance between the chalk marks along the path", 5.0, ge=0.5, le=1_000)
    origin: OriginFields | None = Field(
        None,
        description="Place of x = y = 0; null: as the venue states it. KML needs it; GeoJSON is in metres without it",
    )

    def origin_at(self, place: degrees.Place) -> degrees.GeographicOrigin | None:
        """The origin in the request, else that of the venue."""
        origin = self.origin
        return degrees.GeographicOrigin(origin.longitude, origin.latitude) if origin else place.origin


class MapsRequest(SeveralFields, Marked, strict=True):
    """The dance as a map, or several dances on one."""


def _one(request: MapsRequest, terms: Terms) -> tuple[list[MarkedDance], degrees.Place]:
    dance = request.to_dance(terms.settings.checked_benches_max)
    place = request.to_place(dance.dragon)
    marks = marks_of(dance, *dance.span(request.start, request.stop), request.spacing)
    return [MarkedDance(dance, marks, _fields_of(request.path))], place


def _several(request: MapsRequest, terms: Terms) -> tuple[list[MarkedDance], degrees.Place]:
    performance, place = request.to_placed(terms.settings)
    span, dances = performance.span(request.start, request.stop), []
    for k, (part, body) in enumerate(zip(performance.parts, request.dances or (), strict=True)):
        marks = marks_of(part.dance, *part.own_span(*span), request.spacing)
        dances.append(MarkedDance(part.dance, marks, _fields_of(body.path), k, part.name))
    check_limit(
        "spacing",
        "marks must be at most {most} here",
        sum(len(one.marks.s) for one in dances),
        MARKS_MAX,
        "set them further apart",
    )
    return dances, place


def _fields_of(path: AnyPath) -> dict[str, object]:
    return path.model_dump(mode="json", exclude_none=True)


def maps(request: MapsRequest, terms: Terms, form: str) -> bytes:
    """The square, the path and the chalk marks as GeoJSON, KML or DXF, which POST /places reads again."""
    dances, place = _one(request, terms) if request.dances is None else _several(request, terms)
    origin = request.origin_at(place)
    drawing = drawing_of(dances, place, origin)
    if form == DXF_TYPE:
        return dxf.written(on_grid(drawing))
    if form == GEOJSON_TYPE:
        return geojson.written(in_degrees(drawing) if origin else on_grid(drawing))
    if origin is None:
        words = "give the place of x = y = 0 as longitude and latitude, or a venue in degrees"
        raise InvalidValue("origin", f"must be known for KML, which is in degrees: {words}")
    return kml.written(in_degrees(drawing))


def _cost(request: MapsRequest, form: str) -> float:
    return SECONDS * len(request.dances or [None])


def _note(request: MapsRequest, data: bytes) -> str:
    """What is to be known of a map in metres."""
    if not data.startswith(b"{") or "origin" in orjson.loads(data):
        return ""
    return say("metres, not degrees: --longitude and --latitude of x = y = 0 give longitude and latitude")


QUESTION = Question(
    maps,
    None,
    None,
    MapsRequest,
    FORMS,
    _cost,
    at="/maps.{format}",
    formats=MapFormat,
    command=Command(
        "The square, the path and the chalk marks as a map.",
        lambda request: say("map"),
        file=FILE_OF_CHECK,
        outputs={
            "output": Output(
                "Write .geojson, .kml or .dxf (extra dxf).",
                {f".{one}": one.media_type for one in MapFormat},
                "dance.geojson",
                {".dxf": "dxf"},
                _note,
            )
        },
    ),
)
