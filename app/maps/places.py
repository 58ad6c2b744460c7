"""The square, its obstacles and the path from a file of any format, in the form of a request."""

from __future__ import annotations

import codecs
from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from dataclasses import replace
from functools import partial
from math import isfinite
from pathlib import Path
from typing import Any, Self

import orjson

from app.files.markup import states_encoding
from app.maps import dxf, geojson, gpx, kml
from app.maps.benches import benches_of
from app.maps.choice import EVERYTHING, PARTLY, Choice, listed
from app.maps.dance_parts import DanceParts
from app.maps.features import (
    FEATURES_MAX,
    LEAVE_OUT,
    POINTS_MAX,
    Drawing,
    MapFeature,
    aside_features,
    edges_of,
    features_of,
)
from app.maps.layout import Reading
from app.maps.lines import checked_path
from app.maps.tracks import CHORD
from app.processes.limits import reading
from app.wire.degrees import Place, place_of
from app.wire.fields import Answer, Coordinates
from app.wire.texts import CHINESE, OLD_WORKBOOK, Unreadable, is_workbook, refuse_deep, toml_of, values_in
from core import BenchDragonError, Budget, Dragon, InvalidValue
from core.language import say
from core.quantities import Given, Parameter

# Longest file [bytes].
FILE_MAX = 20_000_000
# Longest file that describes a dance [bytes], the default length of a request. Each table of TOML takes 120 bytes for
# one in the file (measured 2026-11-26).
DANCE_MAX = 4_000_000
# Most objects and lists of GeoJSON, TOML or JSON: twice those of the largest map.
PARTS_MAX = 2 * (POINTS_MAX + 3 * FEATURES_MAX)
# What a refused drawing has too many of.
MANY = ("edges", "entities", "features")
MARKS_16 = (codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)


class DrawnLayer(Answer):
    """A layer of a DXF or GeoJSON on which something is drawn that is read.

    name: its name
    edges: edges of what is drawn on it, where trees and walls have those of outlines; a venue may have 5,000
    """

    name: str
    edges: int


class Places(Answer):
    """The parts of a dance in a map.

    path: path in the form of a request; null: the file has none
    venue: square and obstacles in the form of a request: GeoJSON in metres, the square first; its member `origin` is
        the place of x = y = 0, and `grid` the same on a survey grid, if known; null: the file has none
    dance: other fields of a file that describes a dance, unchanged; null: the file is a map
    passages: speeds at which a track was walked, from its first time on, in the form of a request; null: the path is no
        track, or has no times
    notes: assumptions, and things left out, in sentences
    layers: the layers of a drawing, if only_layers asks for them, and nothing else then; else null
    """

    path: dict[str, Any] | None
    venue: dict[str, Any] | None
    dance: dict[str, Any] | None
    passages: list[dict[str, Any]] | None
    notes: list[str]
    layers: list[DrawnLayer] | None = None

    @classmethod
    def of(cls, parts: DanceParts) -> Self:
        passages = None if parts.passages is None else list(parts.passages)
        own = {"venue": parts.geometry, "passages": passages, "notes": list(parts.notes)}
        return cls(path=parts.path, dance=parts.dance, **own)


def read_places(
    data: bytes, units: Coordinates | None, chord: float, choice: Choice, budget: Budget
) -> Places | BenchDragonError:
    """Content of a map, or its refusal, for another process. choice: of a drawing; that counts, its layers alone"""
    try:
        if choice.counts:
            return Places(path=None, venue=None, dance=None, passages=None, notes=[], layers=drawn_layers(data))
        return Places.of(places_of(data, units, budget, chord, choice))
    except BenchDragonError as error:
        return error


def drawn_layers(data: bytes) -> list[DrawnLayer]:
    """The layers of a DXF or GeoJSON that hold something, those of the most edges first. raises: InvalidValue"""
    start = _start(data)
    if is_drawing(start):
        edges = dxf.layers_of(data)
    elif start.startswith(b"{") and "type" in (content := _json(_in_utf8(start)[0])):
        edges = _edges_of_map(geojson.read(content, Choice(counts=True)))
    else:
        raise InvalidValue("file", "must be DXF or GeoJSON to have layers", got="another format")
    layers = sorted(edges.items(), key=lambda one: -one[1])
    return [DrawnLayer(name=name, edges=count) for name, count in layers]


def _edges_of_map(drawing: Drawing) -> dict[str, int]:
    """Edges in a venue of each layer of a map."""
    features: Sequence[MapFeature] = drawing.features
    with suppress(InvalidValue):  # A map that is too wide has layers that are not.
        features = Reading(drawing, None).features
    counts = Counter[str]()
    for one in features:
        counts[geojson.layer_of(one)] += edges_of(one)
    return counts


def _start(data: bytes) -> bytes:
    """The data from the first character on."""
    return data.lstrip(b"\xef\xbb\xbf \t\r\n")


def is_drawing(start: bytes) -> bool:
    """True for the beginning of a drawing, as DXF or in a form that is refused."""
    return start.startswith((b"0", b"999", b"AutoCAD", b"AC10"))


def _in_part(read: Callable[[], DanceParts], choice: Choice) -> DanceParts:
    """Square and path in a drawing, or in a part of it; too much of it is refused with advice to read a part."""
    try:
        parts = read()
    except InvalidValue as error:
        raise error.because(PARTLY) if any(word in error.template for word in MANY) else error from None
    notes = list(parts.notes)
    if choice.layers is not None:
        names = listed(choice.layers)
        notes.append(say("Only these layers were read: {names}.", names=names))
    if choice.area is not None:
        left, low, right, high = choice.area
        notes.append(
            say(
                "Only what reaches into x {left:g} to {right:g} m, y {low:g} to {high:g} m was read.",
                left=left,
                right=right,
                low=low,
                high=high,
            )
        )
    return replace(parts, notes=notes)


def places_of(
    data: bytes,
    units: Coordinates | None,
    budget: Budget | None = None,
    chord: float = CHORD,
    choice: Choice = EVERYTHING,
) -> DanceParts:
    """Square and path in a file: GeoJSON, KML, KMZ, GPX, DXF, or a dance as TOML or JSON, recognised by its first
    bytes; or the benches in a workbook.

    units: of its coordinates; None: as the file says, else degrees if the numbers allow it
    chord: longest distance of the handles of a bench, for which a track is smoothed [m]
    choice: part of a drawing that is read
    raises: InvalidValue at the field `file`, `layers` or `area`; MissingPackage
    """
    if not data.strip():
        words = "{field} must hold a map: GeoJSON, KML, DXF, or a dance as TOML or JSON"
        raise InvalidValue.in_words("file", words, got="nothing", field=Parameter("file"))
    if data.startswith(MARKS_16):
        data = _encoded(data, "utf-16")
    start = _start(data)
    if not is_drawing(start) and not start.startswith(b"{"):
        _refuse_part(choice)
    if data.startswith(OLD_WORKBOOK):
        raise InvalidValue("file", "must be saved as .xlsx or CSV", got="a workbook in an old or encrypted form")
    if is_workbook(data):
        csv, notes = benches_of(data, budget or Budget())
        return DanceParts(dance={"dragon": {"csv": csv}}, notes=notes)
    if is_drawing(start):
        return _in_part(lambda: Reading(dxf.read(data, choice), units, choice=choice).parts(), choice)
    is_archive = start.startswith(b"PK")
    if is_archive:
        start = kml.unpacked(data)
    is_xml = is_archive or start.startswith((b"<", b"\0<"))
    start, notes = (start, []) if is_xml and states_encoding(start) else _in_utf8(start)
    if is_xml:
        drawing = gpx.read(start) if gpx.is_gpx(start) else kml.read(start)
        parts = Reading(drawing, units, chord).parts()
    else:
        parts = _of_text(start, units, choice)
    return replace(parts, notes=[*notes, *parts.notes])


def _refuse_part(choice: Choice) -> None:
    """raises: InvalidValue for the choice of a part of what has no layers"""
    if not choice.is_all:
        rule = "must be left out: only DXF and GeoJSON are read in part"
        raise InvalidValue("layers" if choice.layers else "area", rule)


def _in_utf8(data: bytes) -> tuple[bytes, list[str]]:
    """Text in UTF-8, also of a file in GB 18030, and a note on that."""
    try:
        data.decode()
    except UnicodeDecodeError:
        with suppress(UnicodeDecodeError):
            text = data.decode(CHINESE)
            return text.encode(), [say("The file is not in UTF-8; it was read as GB 18030.")]
    return data, []


def _encoded(data: bytes, coding: str) -> bytes:
    try:
        return data.decode(coding).encode()
    except UnicodeError as error:
        raise InvalidValue("file", "must be text in UTF-16, as its first bytes say: save it as UTF-8") from error


def _of_geojson(content: Mapping[str, Any], units: Coordinates | None, choice: Choice) -> DanceParts:
    """Square and path in GeoJSON, or in a part of it, whose area lies around the middle of the whole map."""
    drawing = geojson.read(content, choice)
    if choice.layers is not None and choice.area is not None:
        with suppress(InvalidValue):  # of a map that is too wide for one middle
            whole = Reading(geojson.read(content, Choice(counts=True)), units)
            drawing = replace(drawing, origin=drawing.origin or whole.origin)
    return Reading(drawing, units, choice=choice).parts()


def _json(start: bytes) -> dict[str, Any]:
    """A JSON object, whose objects and lists are counted before any is made. raises: InvalidValue"""
    _refuse_many_parts(start)
    try:
        content: dict[str, Any] = orjson.loads(start)
    except orjson.JSONDecodeError as error:
        raise InvalidValue("file", "must be JSON without a fault: {why}", why=str(error)) from error
    return content


def _refuse_many_parts(start: bytes) -> None:
    parts = start.count(b"[") + start.count(b"{")
    if parts > PARTS_MAX:
        rule = f"must hold at most {{most}} objects and lists: {LEAVE_OUT}"
        raise InvalidValue("file", rule, got=parts, most=PARTS_MAX)


def _of_text(start: bytes, units: Coordinates | None, choice: Choice) -> DanceParts:
    """GeoJSON, or a dance as JSON or TOML."""
    if start.startswith(b"{"):
        content = _json(start)
        if "type" in content:
            return _in_part(partial(_of_geojson, content, units, choice), choice)
        _refuse_part(choice)
    _refuse_many_parts(start)
    _refuse_long(start)
    try:
        if start.startswith(b"{"):
            refuse_deep(content)
        else:
            content = toml_of(start)
    except Unreadable as error:
        why = error.of("file", "it")
        rule = f"must be GeoJSON, KML, KMZ, DXF, or a dance as TOML or JSON: {why.template}: {why.reason}"
        raise InvalidValue("file", rule.removesuffix(": "), got="none of these", **why.values) from error
    if wild := next((one for one in values_in(content) if isinstance(one, float) and not isfinite(one)), None):
        raise InvalidValue("file", "must have finite numbers", got=Given(wild))
    return _of_dance(content)


def _refuse_long(data: bytes) -> None:
    """Refuse a dance that is longer than a request may be, before it is read."""
    if len(data) > DANCE_MAX:
        raise InvalidValue("file", "must have at most {most} bytes if it is no map", got=len(data), most=DANCE_MAX)


def _of_dance(content: Mapping[str, Any]) -> DanceParts:
    """A file that describes a dance, as `check` takes it."""
    path, venue, notes = content.get("path"), content.get("venue"), []
    others = {name: value for name, value in content.items() if name not in ("path", "venue", "coordinates")}
    if path is not None:
        checked_path(path)
    place = None
    if isinstance(venue, str):
        notes.append(say("The venue is in another file: {venue}.", venue=venue))
    elif not isinstance(venue, Mapping | None):
        raise InvalidValue("file", "must have a venue that is GeoJSON or the name of a file", got=Given(venue))
    elif venue is not None:
        place = place_of(venue, content.get("coordinates"), Dragon())
    place = place or Place()
    things = [*features_of(place.things), *aside_features(place.asides)]
    return DanceParts(path, place.venue, place.origin, others, notes, things, place.grid)


def read_map(
    file: Path,
    units: Coordinates | None = None,
    chord: float = CHORD,
    choice: Choice = EVERYTHING,
) -> DanceParts:
    """The square and the path in a map; arguments as for places_of(). raises: InvalidValue, TooMuchWork, OSError"""
    data = map_data(file)
    with reading():
        return places_of(data, units, chord=chord, choice=choice)


def map_data(file: Path) -> bytes:
    """The bytes of a map. raises: InvalidValue for too many; OSError"""
    with file.open("rb") as source:
        data = source.read(FILE_MAX + 1)
    if len(data) > FILE_MAX:
        words = "{file} must have at most {most} bytes"
        raise InvalidValue.in_words("file", words, got="more", file=str(file), most=FILE_MAX)
    return data
