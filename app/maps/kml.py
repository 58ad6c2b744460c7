"""Maps as KML, the format of map programs on phones, and as KMZ, its packed form.

The parser is plain expat, which builds no tree. A document type is refused, so a file can define no entities and
cannot grow in memory by them.
"""

from __future__ import annotations

import math
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from html import escape

import orjson

from app.files.archives import BadArchive, opened, pieces_of
from app.files.markup import Reader, read_document
from app.maps.features import (
    POINTS_MAX,
    Drawing,
    FeatureCollector,
    MapFeature,
    Shape,
    Unit,
    drawn_as,
    empty_kind,
    place_fields,
    role_of,
)
from app.maps.gpx import seconds_of
from app.wire.geojson import GATE, INNER_SQUARE, LANE, gate_properties
from app.wire.numbers import number_of
from core import InvalidValue
from core.language import phrase
from core.quantities import Given
from core.values import Point
from core.venue import Ring

# The largest document in a KMZ file [bytes], and most parts of it, such as pictures.
UNPACKED_MAX, PARTS_MAX = 20_000_000, 1_000
# Rules for KMZ files, by the codes of BadArchive.
REFUSED = {
    "broken": "must be a KMZ file that can be unpacked: {why}",
    "encrypted": "must be a KMZ file without a password",
    "method": "must be a KMZ file that can be unpacked: its parts must be stored or deflated",
    "parts": "must be a KMZ file of at most {parts} parts",
    "bomb": "must unpack to at most {most} bytes, got more",
}
SHAPES: dict[str, Shape] = {"Point": "point", "LineString": "line", "Polygon": "polygon", "LinearRing": "line"}
# Elements with geometry that this program does not use.
OTHERS = ("GroundOverlay", "PhotoOverlay", "ScreenOverlay", "NetworkLink", "Model")
# Colours of the lines, aabbggrr, by role; a style has its role as its name, with a dash for each space.
COLOURS = {
    "square": "ff000000",
    "obstacle": "ff7f7f7f",
    "path": "ffb27200",
    "mark": "ff005ed5",
    GATE: "ff3f8f1f",
    INNER_SQUARE: "ff000000",
    LANE: "ffb27200",
}
FAULT = "must be KML, got {fault} in line {line}"
FORBIDDEN = phrase("file must not have a document type or entities") + ": " + phrase("save it again as plain KML")


def unpacked(data: bytes) -> bytes:
    """The document in a KMZ file. raises: InvalidValue"""
    try:
        with opened(data, PARTS_MAX) as archive:
            documents = [one for one in archive.infolist() if one.filename.lower().endswith(".kml")]
            if not documents:
                raise InvalidValue("file", "must be a KMZ file with a .kml document", got="an archive without one")
            return b"".join(pieces_of(archive, documents[0], UNPACKED_MAX))
    except BadArchive as error:
        words, limits = REFUSED[error.code], {"most": UNPACKED_MAX, "parts": PARTS_MAX}
        raise InvalidValue("file", words, why=error.why, **limits) from error


def read(data: bytes) -> Drawing:
    """The map in a KML document, always in degrees. raises: InvalidValue with the line at fault"""
    reader = _FeatureReader()
    read_document(data, reader, FAULT, FORBIDDEN)
    if not reader.is_kml:
        raise InvalidValue("file", "must be KML", got="XML of another kind")
    return reader.collector.drawing(Unit.DEGREES, reader.stored)


@dataclass
class _Level:
    """An open folder, document or placemark."""

    name: str = ""
    is_visible: bool = True


# State:  `levels`, from the document down to the open placemark; `data`, `shapes`, `track` and `times` of that one;
#         `rings` of the open polygon.
class _FeatureReader(Reader):
    """Collects the features of a document while expat reads it."""

    def __init__(self) -> None:
        super().__init__()
        self.collector, self.stored = FeatureCollector(), dict[str, object]()
        self.levels: list[_Level] = []
        self.data: dict[str, str] = {}
        self.shapes: list[tuple[Shape, tuple[Ring, ...]]] = []
        self.rings: list[Ring] = []
        self.track: list[Point] = []
        self.times: list[float] = []
        self.key, self.is_kml = "", False

    def begin(self, name: str, attributes: Mapping[str, str]) -> None:
        self.is_kml = self.is_kml or name == "kml"
        if name in ("Folder", "Document", "Placemark"):
            self.levels.append(_Level())
        if name == "Placemark":
            self.data, self.shapes, self.track, self.times = {}, [], [], []
        elif name in ("Data", "SimpleData"):
            self.key = attributes.get("name", "")
        elif name == "Polygon":
            self.rings = []
        if name in OTHERS:
            self.collector.leave_out(name)

    def finish(self, name: str, text: str) -> None:
        match name, self.around:
            case "name", "Folder" | "Document" | "Placemark":
                self.levels[-1].name = text
            case "visibility", "Folder" | "Document" | "Placemark" if text == "0":
                self.levels[-1].is_visible = False
            case ("value", "Data") | ("SimpleData", _):
                self.data[self.key] = text
            case "coordinates", _:
                self._place(_points(text))
            case "when", "Track":
                self.times.append(seconds_of(text))
            case "coord", "Track":
                self._walk(text)
            case "Polygon", _ if self.rings:
                self.shapes.append(("polygon", tuple(self.rings)))
                self.rings = []
            case "Placemark", _:
                self._add()
                self.levels.pop()
            case "Folder" | "Document", _:
                self.levels.pop()

    def _place(self, points: Ring) -> None:
        if not points:
            kinds = (one for one in reversed(self.stack) if one in SHAPES and one != "LinearRing")
            self.collector.leave_out(empty_kind(next(kinds, self.around)))
        elif "Polygon" in self.stack:
            self.rings.append(points)
        elif shape := SHAPES.get(self.around):
            self.shapes.append((shape, (points[:1] if shape == "point" else points,)))

    def _walk(self, text: str) -> None:
        """A place of a track, such as 120.1 30.2 12; one without a place has no text. raises: InvalidValue"""
        if place := _place_in(text.split()):
            self.track.append(place)
        elif text:
            raise InvalidValue("file", "must have places of a track such as 120.1 30.2 12", got=Given(text))
        else:
            self.times[len(self.track) : len(self.track) + 1] = []

    def _add(self) -> None:
        data = self.data
        for key in ("path", "origin", "grid"):
            if value := _json(data.get(key, "")):
                self.stored.setdefault(key, value)  # the path that is read is the first one
        *around, level = self.levels
        name = level.name or data.get("name") or None
        role = role_of(data.get("role"), name, *(one.name for one in reversed(around)))
        read = {key: text if key == "use" else _number(text) for key, text in gate_properties(data).items()}
        own = {key: value for key, value in read.items() if value is not None}
        feature = MapFeature("point", (), name, role, _number(data.get("radius", "")), own)
        things = [replace(feature, shape=shape, rings=rings) for shape, rings in self.shapes]
        if self.track:
            # Times come in the order of the places; of a file with fewer, none counts.
            times = tuple(self.times) if len(self.times) == len(self.track) else (math.nan,) * len(self.track)
            things.append(replace(feature, shape="line", rings=(tuple(self.track),), times=times))
        for one in things:
            if all(level.is_visible for level in self.levels):
                self.collector.add(drawn_as(one) if one.shape == "line" and one.times is None else one)
            else:
                self.collector.hide(one.shape)


def _points(text: str) -> Ring:
    """Points of a text such as "120.1,30.2,0 120.2,30.2,0". raises: InvalidValue"""
    points: list[Point] = []
    if text.count(",") > 3 * POINTS_MAX:
        raise InvalidValue("file", "must draw no line of more than {most} points", most=POINTS_MAX)
    for word in text.split():
        parts = word.split(",")
        if len(parts) > 3:
            rule = (
                "must have a space between two points, as in 120.1,30.2 120.3,30.4: here commas join more than three "
                "numbers"
            )
            raise InvalidValue("file", rule, got=Given(word))
        place = _place_in(parts)
        if place is None:
            raise InvalidValue("file", "must have coordinates such as 120.1,30.2 in degrees", got=Given(word))
        points.append(place)
    return tuple(points)


def _place_in(words: Sequence[str]) -> Point | None:
    """Longitude and latitude, in the first two words; None if they are no numbers."""
    try:
        longitude, latitude = map(number_of, words[:2])
    except ValueError:
        return None
    return longitude, latitude


def _number(text: str) -> float | None:
    try:
        return number_of(text)
    except ValueError:
        return None


def _json(text: str) -> Mapping[str, object] | None:
    try:
        value = orjson.loads(text)
    except orjson.JSONDecodeError:
        return None
    return value if isinstance(value, dict) else None


def written(drawing: Drawing) -> bytes:
    """A document with a placemark for each feature; the path's placemark holds the path and its places as data."""
    parts = ['<?xml version="1.0" encoding="UTF-8"?>\n<kml xmlns="http://www.opengis.net/kml/2.2"><Document>\n']
    for role, colour in COLOURS.items():
        parts.append(
            f'<Style id="{_style(role)}"><LineStyle><color>{colour}</color><width>2</width></LineStyle>'
            f"<PolyStyle><color>40{colour[2:]}</color></PolyStyle></Style>\n"
        )
    for feature in drawing.features:
        data_of: dict[str, object] = {"role": feature.role}
        if feature.radius is not None:
            data_of["radius"] = feature.radius
        data_of |= {name: value for name, value in feature.properties.items() if name != "path"}
        if feature.role == "path":
            kept = {**place_fields(drawing.origin, drawing.grid), "path": feature.properties["path"]}
            data_of |= {name: orjson.dumps(value).decode() for name, value in kept.items()}
        data = "".join(f'<Data name="{name}"><value>{_words(str(one))}</value></Data>' for name, one in data_of.items())
        parts.append(
            f"<Placemark><name>{_words(feature.name or '')}</name><styleUrl>#{_style(feature.role or '')}</styleUrl>"
            f"<ExtendedData>{data}</ExtendedData>{_geometry(feature)}</Placemark>\n"
        )
    return "".join([*parts, "</Document></kml>\n"]).encode()


def _style(role: str) -> str:
    return role.replace(" ", "-")


def _words(text: str) -> str:
    """A text as XML, without the two characters that XML forbids."""
    return escape(re.sub("[\ufffe\uffff]", "", text), quote=False)


def _geometry(feature: MapFeature) -> str:
    lists = [" ".join(f"{x!r},{y!r}" for x, y in ring) for ring in feature.rings]
    if feature.shape == "polygon":
        outer, *inner = (f"<LinearRing><coordinates>{one}</coordinates></LinearRing>" for one in lists)
        holes = "".join(f"<innerBoundaryIs>{one}</innerBoundaryIs>" for one in inner)
        return f"<Polygon><outerBoundaryIs>{outer}</outerBoundaryIs>{holes}</Polygon>"
    kind = "Point" if feature.shape == "point" else "LineString"
    return f"<{kind}><coordinates>{lists[0]}</coordinates></{kind}>"
