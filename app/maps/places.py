"""The square, its obstacles and the path from a file of any format, in the form of a request."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any, Self

import orjson
from pydantic import Field

from app.files.tables import Language
from app.files.words import Say
from app.maps import dxf, geojson, kml
from app.maps.features import features_of
from app.maps.layout import DanceParts, Reading, checked_path
from app.wire.degrees import Place, place_of
from app.wire.question import Answer, Coordinates
from app.wire.texts import Unreadable, toml_of
from core import BenchDragonError, Budget, Dragon, InvalidValue
from core.errors import Given, Parameter

# Longest file [bytes].
FILE_MAX = 20_000_000


class Places(Answer):
    """The parts of a dance in a map."""

    path: dict[str, Any] | None = Field(description="Path in the form of a request; null: the file has none")
    venue: dict[str, Any] | None = Field(
        description="Square and obstacles in the form of a request: GeoJSON in metres, the square first; its member "
        "`origin` is the place of x = y = 0, if it is known; null: the file has none"
    )
    dance: dict[str, Any] | None = Field(
        description="Other fields of a file that describes a dance, unchanged; null: the file is a map"
    )
    notes: list[str] = Field(description="Assumptions, and things left out, in sentences")

    @classmethod
    def of(cls, found: DanceParts) -> Self:
        return cls(path=found.path, venue=found.geometry, dance=found.dance, notes=list(found.notes))


def read_places(
    data: bytes, units: Coordinates | None, language: Language, budget: Budget
) -> Places | BenchDragonError:
    """Content of a map, or its refusal, for another process."""
    try:
        return Places.of(places_of(data, units, Say(language)))
    except BenchDragonError as error:
        return error


def places_of(data: bytes, units: Coordinates | None, say: Say) -> DanceParts:
    """Square and path in a file: GeoJSON, KML, KMZ, DXF, or a dance as TOML or JSON, recognised by its first bytes.

    units: of its coordinates; None: as the file says, else degrees if the numbers allow it
    raises: InvalidValue at the field `file`; MissingPackage
    """
    if not data.strip():
        words = "{field} must hold a map: GeoJSON, KML, DXF, or a dance as TOML or JSON"
        raise InvalidValue.in_words("file", words, got="nothing", field=Parameter("file"))
    start = data.lstrip(b"\xef\xbb\xbf \t\r\n")
    if start.startswith(b"PK"):
        return Reading(kml.read(kml.unpacked(data)), units, say).found()
    if start.startswith(b"<"):
        return Reading(kml.read(start), units, say).found()
    if start.startswith(b"{"):
        try:
            told = orjson.loads(start)
        except orjson.JSONDecodeError as error:
            raise InvalidValue("file", "must be JSON without a fault: {why}", why=str(error)) from error
        if "type" in told:
            return Reading(geojson.read(told), units, say).found()
        return _of_dance(told, say)
    if start.startswith((b"0", b"999", b"AutoCAD", b"AC10")):
        return Reading(dxf.read(data), units, say).found()
    try:
        return _of_dance(toml_of(data), say)
    except Unreadable as error:
        told = error.of("file", "it")
        rule = f"must be GeoJSON, KML, KMZ, DXF, or a dance as TOML or JSON: {told.template}: {told.reason}"
        raise InvalidValue("file", rule.removesuffix(": "), got="none of these", **told.values) from error


def _of_dance(told: Mapping[str, Any], say: Say) -> DanceParts:
    """A file that describes a dance, as `check` takes it."""
    path, venue, notes = told.get("path"), told.get("venue"), []
    others = {name: value for name, value in told.items() if name not in ("path", "venue", "coordinates")}
    if path is not None:
        checked_path(path)
    place = None
    if isinstance(venue, str):
        notes.append(say(f"The venue is in another file: {venue}.", f"场地在另一个文件中：{venue}。"))
    elif not isinstance(venue, Mapping | None):
        raise InvalidValue("file", "must have a venue that is GeoJSON or the name of a file", got=Given(venue))
    elif venue is not None:
        place = place_of(venue, told.get("coordinates"), Dragon())
    place = place or Place()
    return DanceParts(path, place.venue, place.origin, others, notes, features_of(place.things))


def read_map(file: Path, units: Coordinates | None = None, language: Language = Language.ENGLISH) -> DanceParts:
    """The square and the path in a map. raises: InvalidValue, OSError"""
    with file.open("rb") as source:
        data = source.read(FILE_MAX + 1)
    if len(data) > FILE_MAX:
        words = "{file} must have at most {most} bytes"
        raise InvalidValue.in_words("file", words, got="more", file=str(file), most=FILE_MAX)
    return places_of(data, units, Say(language))
