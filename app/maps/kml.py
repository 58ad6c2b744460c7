"""Maps as KML, the format of map programs on phones, and as KMZ, its packed form.

The parser is plain expat, which builds no tree. A document type is refused, so a file can define no entities and
cannot grow in memory by them.
"""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from dataclasses import replace
from html import escape

import orjson

from app.files.archives import BadArchive, opened, pieces_of
from app.files.markup import read_document
from app.maps.features import (
    POINTS_MAX,
    Drawing,
    FeatureCollector,
    MapFeature,
    Shape,
    Unit,
    drawn_as,
    empty_kind,
    grid_of,
    origin_of,
    role_of,
)
from app.maps.gpx import seconds_of
from app.wire.geojson import GATE, INNER_SQUARE
from app.wire.numbers import number_of
from core import InvalidValue
from core.errors import Given
from core.language import phrase
from core.venue import Ring

# Deepest nesting of elements, the largest document in a KMZ file [bytes], and most parts of it, such as pictures.
DEPTH_MAX, UNPACKED_MAX, PARTS_MAX = 60, 20_000_000, 1_000
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
    stored, collector = reader.stored, reader.collector
    path = stored.get("path")
    return Drawing(
        tuple(collector.features),
        Unit.DEGREES,
        origin_of(stored.get("origin")),
        path if isinstance(path, dict) else None,
        collector.left_out,
        collector.hidden,
        grid_of(stored.get("grid")),
    )


# State:  `stack`, the names of the open elements; `folders`, the names of the open folders, and whether they are shown;
#         `name`, `data`, `visible` and `shapes` of the open placemark; `rings` of the open polygon; `text` of the open
#         element.
class _FeatureReader:
    """Collects the features of a document while expat reads it."""

    def __init__(self) -> None:
        self.collector, self.stored = FeatureCollector(), dict[str, object]()
        self.stack: list[str] = []
        self.folders: list[str] = []
        self.visible_folders: list[bool] = []
        self.name, self.visible = "", True
        self.data: dict[str, str] = {}
        self.shapes: list[tuple[Shape, tuple[Ring, ...]]] = []
        self.rings: list[Ring] = []
        self.track: list[tuple[float, float]] = []
        self.times: list[float] = []
        self.key, self.text, self.is_kml = "", list[str](), False

    def start(self, name: str, attributes: Mapping[str, str]) -> None:
        local = name.rpartition(" ")[2]
        self.is_kml = self.is_kml or local == "kml"
        self.stack.append(local)
        if len(self.stack) > DEPTH_MAX:
            raise InvalidValue("file", "must not nest elements deeper than {most}", most=DEPTH_MAX)
        self.text = []
        if local in ("Folder", "Document"):
            self.folders.append("")
            self.visible_folders.append(True)
        elif local == "Placemark":
            self.name, self.data, self.shapes, self.visible = "", {}, [], True
            self.track, self.times = [], []
        elif local in ("Data", "SimpleData"):
            self.key = attributes.get("name", "")
        elif local == "Polygon":
            self.rings = []
        if local in OTHERS:
            self.collector.leave_out(local)

    def take(self, text: str) -> None:
        self.text.append(text)

    def end(self, name: str) -> None:
        local, text = self.stack.pop(), "".join(self.text).strip()
        around = self.stack[-1] if self.stack else ""
        if local == "name" and around == "Placemark":
            self.name = text
        elif local == "name" and self.folders and around in ("Folder", "Document"):
            self.folders[-1] = text
        elif local == "visibility" and text == "0":
            if around == "Placemark":
                self.visible = False
            elif self.visible_folders and around in ("Folder", "Document"):
                self.visible_folders[-1] = False
        elif (local == "value" and around == "Data") or local == "SimpleData":
            self.data[self.key] = text
        elif local == "coordinates":
            self._place(_points(text))
        elif local == "when" and around == "Track":
            self.times.append(seconds_of(text))
        elif local == "coord" and around == "Track":
            self._walk(text)
        elif local == "Polygon" and self.rings:
            self.shapes.append(("polygon", tuple(self.rings)))
            self.rings = []
        elif local == "Placemark":
            self._finish()
        elif local in ("Folder", "Document"):
            self.folders.pop()
            self.visible_folders.pop()
        self.text = []

    def _place(self, points: Ring) -> None:
        around = next((one for one in reversed(self.stack) if one in SHAPES and one != "LinearRing"), self.stack[-1])
        if not points:
            self.collector.leave_out(empty_kind(around))
        elif "Polygon" in self.stack:
            self.rings.append(points)
        elif self.stack[-1] in SHAPES:
            shape = SHAPES[self.stack[-1]]
            self.shapes.append((shape, (points[:1] if shape == "point" else points,)))

    def _walk(self, text: str) -> None:
        """A place of a track, such as 120.1 30.2 12; one without a place has no text. raises: InvalidValue"""
        numbers = [_number(word) for word in text.split()[:2]]
        if len(numbers) == 2 and None not in numbers:
            self.track.append((numbers[0] or 0.0, numbers[1] or 0.0))
        elif text:
            raise InvalidValue("file", "must have places of a track such as 120.1 30.2 12", got=Given(text))
        else:
            self.times[len(self.track) : len(self.track) + 1] = []

    def _finish(self) -> None:
        data = self.data
        for key in ("path", "origin", "grid"):
            if value := _json(data.get(key, "")):
                self.stored.setdefault(key, value)  # the path that is read is the first one
        name = self.name or data.get("name") or None
        role = role_of(data.get("role"), name, *reversed(self.folders))
        heading = _number(data.get("heading", ""))
        own = {} if heading is None else {"heading": heading}
        feature = MapFeature("point", (), name, role, _number(data.get("radius", "")), own)
        for shape, rings in self.shapes:
            if not (self.visible and all(self.visible_folders)):
                self.collector.hide(shape)
                continue
            one = replace(feature, shape=shape, rings=rings)
            self.collector.add(drawn_as(one) if shape == "line" else one)
        if self.track and not (self.visible and all(self.visible_folders)):
            self.collector.hide("line")
        elif self.track:
            # Times come in the order of the places; of a file with fewer, none counts.
            times = tuple(self.times) if len(self.times) == len(self.track) else (math.nan,) * len(self.track)
            self.collector.add(replace(feature, shape="line", rings=(tuple(self.track),), times=times))


def _points(text: str) -> Ring:
    """Points of a text such as "120.1,30.2,0 120.2,30.2,0". raises: InvalidValue"""
    points: list[tuple[float, float]] = []
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
        numbers = [_number(part) for part in parts[:2]]
        if len(numbers) < 2 or None in numbers:
            raise InvalidValue("file", "must have coordinates such as 120.1,30.2 in degrees", got=Given(word))
        points.append((numbers[0] or 0.0, numbers[1] or 0.0))
    return tuple(points)


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
            grid = None if drawing.grid is None else dict(zip("xy", drawing.grid, strict=True))
            places = {name: one for name, one in (("origin", drawing.origin), ("grid", grid)) if one is not None}
            kept = {**places, "path": feature.properties["path"]}
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
