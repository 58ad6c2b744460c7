"""Maps as DXF, the format of drawing programs, in metres or in the unit that the drawing states."""

from __future__ import annotations

import io
from collections.abc import Iterator, Mapping
from dataclasses import replace
from importlib import import_module
from math import dist
from typing import Any

import orjson

from app.extras import require
from app.files.outlines import dxf_bytes, new_dxf
from app.maps.features import LEAVE_OUT, Counted, Drawing, MapFeature, area_of, drawn_as, holds, inner_point, role_of
from app.wire.degrees import Origin
from core import InvalidValue
from core.errors import Quantity
from core.venue import Ring

# Metres in the units of $INSUNITS: inch, foot, mile, millimetre, centimetre, metre, kilometre, yard, decimetre.
UNITS = {1: 0.0254, 2: 0.3048, 3: 1609.344, 4: 0.001, 5: 0.01, 6: 1.0, 7: 1000.0, 10: 0.9144, 14: 0.1}
# Largest width of a drawing without a unit, which is taken as metres: 2 km. The same number in millimetres would be a
# square of 2 m, too small for a dance [1].
ACROSS_MAX = 2_000.0
# Largest distance of a curve from the straight lines that replace it [m].
FLATTENED = 0.005
# Deepest nesting of blocks, and most entities of a drawing; those of a block count each time it is used.
DEPTH_MAX, ENTITIES_MAX = 4, 20_000
CURVES = ("LINE", "LWPOLYLINE", "POLYLINE", "ARC", "CIRCLE", "ELLIPSE", "SPLINE")
TEXTS = ("TEXT", "MTEXT")
# Layer of each role, with its number in the colour index of AutoCAD: white or black, grey, blue, red.
LAYERS = {"square": ("SQUARE", 7), "obstacle": ("OBSTACLES", 8), "path": ("PATH", 5), "mark": ("MARKS", 1)}
# Record for values that no entity can hold: the path as a request describes it, the origin, and names by handle. A
# string of a record has at most 2,049 characters.
RECORD, CHUNK = "BENCH_DRAGON", 2_000
# Height of the text in a drawing, and side of the crosses at marks [m].
WORDS, CROSS = 0.3, 0.2


def read(data: bytes) -> Drawing:
    """The map in a drawing. raises: InvalidValue; MissingPackage"""
    require("dxf", "file", "DXF")
    if data.startswith(b"AutoCAD Binary DXF"):
        raise InvalidValue("file", "must be DXF as text: save it as ASCII DXF", got="binary DXF")
    if data.startswith(b"AC10"):
        raise InvalidValue("file", "must be DXF: save it as DXF", got="DWG")
    errors = import_module("ezdxf.lldxf.const")
    try:
        return _drawing(import_module("ezdxf.recover").read(io.BytesIO(data))[0])
    except InvalidValue:
        raise
    # Other errors that ezdxf raises for a faulty drawing.
    except (
        *(errors.DXFError, OSError, ValueError, ArithmeticError, LookupError, AttributeError, TypeError),
        *(AssertionError, RuntimeError),
    ) as error:
        rule, why = "must be DXF that can be read: {why}", str(error)[:200]
        raise InvalidValue("file", rule, why=why) from error


def _drawing(document: Any) -> Drawing:
    code = int(document.header.get("$INSUNITS", 0))
    factor = UNITS.get(code, 1.0)
    told = _told(document)
    reader = _Reader(factor, told)
    for entity in reader.entities(document.modelspace()):
        reader.take(entity)
    if code not in UNITS:
        _refuse_wide(reader.counted.features)
    origin, path = told.get("origin"), told.get("path")
    return Drawing(
        tuple(reader.named()),
        False if code in UNITS else None,
        Origin(origin["longitude"], origin["latitude"]) if isinstance(origin, dict) else None,
        path if isinstance(path, dict) else None,
        reader.counted.left_out,
    )


def _refuse_wide(features: list[MapFeature]) -> None:
    """Refuse a drawing without a unit that is too wide for metres."""
    points = [point for one in features for ring in one.rings for point in ring]
    across = max((max(column) - min(column) for column in zip(*points, strict=True)), default=0.0)
    if across > ACROSS_MAX:
        rule = "must state its unit: without one it is read in metres, and the drawing is {across} across"
        advice = ": set $INSUNITS, 4 for millimetres, or scale it to metres"
        raise InvalidValue("file", rule + advice, across=Quantity(across, "", 6))


def _told(document: Any) -> Mapping[str, Any]:
    """Content of this program's record in a drawing; empty without one."""
    try:
        record = document.rootdict.get(RECORD)
        told = orjson.loads("".join(tag.value for tag in record.tags if tag.code == 1))
    except (AttributeError, orjson.JSONDecodeError, TypeError):
        return {}
    return told if isinstance(told, dict) else {}


class _Reader:
    """Collects the features of a drawing, in metres."""

    def __init__(self, factor: float, told: Mapping[str, Any]) -> None:
        """told: by this program; names, and radii of walls [m], by handle"""
        self.factor, self.names = factor, told.get("names", {})
        self.radii = {handle: one for handle, one in told.get("radii", {}).items() if isinstance(one, float)}
        self.counted, self.texts = Counted(), list[tuple[str, tuple[float, float]]]()
        self.flat = import_module("ezdxf.path")
        self.seen = 0

    def entities(self, some: Any, depth: int = 0) -> Iterator[Any]:
        """Every entity; those of a block where the block is inserted."""
        for entity in some:
            self.seen += 1
            if self.seen > ENTITIES_MAX:
                rule = f"must draw at most {{most}} entities, counting a block at each use: {LEAVE_OUT}"
                raise InvalidValue("file", rule, got="more", most=ENTITIES_MAX)
            if entity.dxftype() == "INSERT" and depth < DEPTH_MAX:
                yield from self.entities(entity.virtual_entities(), depth + 1)
            else:
                yield entity

    def take(self, entity: Any) -> None:
        kind, layer = entity.dxftype(), str(entity.dxf.get("layer", ""))
        handle = str(entity.dxf.get("handle"))
        name, radius = self.names.get(handle), self.radii.get(handle)
        feature = MapFeature("point", (), name, role_of(layer, name), radius, properties={"layer": layer})
        if kind in TEXTS:
            words = entity.plain_text() if kind == "MTEXT" else str(entity.dxf.text)
            self.texts.append((words.strip(), self._place(entity.dxf.insert)))
        elif kind == "POINT":
            self.counted.add(replace(feature, rings=((self._place(entity.dxf.location),),)))
        elif kind == "CIRCLE":
            centre = self._place(entity.ocs().to_wcs(entity.dxf.center))
            self.counted.add(replace(feature, rings=((centre,),), radius=float(entity.dxf.radius) * self.factor))
        elif kind in CURVES:
            self._add_curve(entity, feature)
        elif entity.dxf.get("layer") != LAYERS["mark"][0]:
            self.counted.leave_out(kind)

    def _add_curve(self, entity: Any, feature: MapFeature) -> None:
        made = self.flat.make_path(entity)
        points = tuple(self._place(point) for point in made.flattening(FLATTENED / self.factor, segments=4))
        points = tuple(b for a, b in zip((None, *points), points, strict=False) if a != b)
        if len(points) < 2:
            return
        if getattr(entity, "is_closed", False) and points[0] != points[-1]:
            points = (*points, points[0])
        # A closing point that a program adds may differ from the first one in the last digits.
        if len(points) > 3 and dist(points[0], points[-1]) < FLATTENED:
            points = (*points[:-1], points[0])
        self.counted.add(drawn_as(replace(feature, rings=(points,))))

    def _place(self, point: Any) -> tuple[float, float]:
        return float(point[0]) * self.factor, float(point[1]) * self.factor

    def named(self) -> Iterator[MapFeature]:
        """The features, with holes in their polygons; each thing is named by the text inside it."""
        features = list(_with_holes(self.counted.features))
        words: dict[int, str] = {}
        for text, place in self.texts:
            around = [k for k, one in enumerate(features) if _is_in(one, place)]
            if text and around:  # Text inside a well is inside the court around it too.
                words.setdefault(min(around, key=lambda k: area_of(features[k])), text)
        for k, feature in enumerate(features):
            name, layer = feature.name or words.get(k), _layer_of(feature)
            own = layer if layer not in ("", "0") and role_of(layer) is None else None
            yield replace(feature, name=name or own, role=feature.role or role_of(name), properties={})


def _is_in(feature: MapFeature, place: tuple[float, float]) -> bool:
    if feature.shape == "polygon":
        return holds(feature.rings, place)
    return feature.shape == "point" and dist(feature.rings[0][0], place) <= (feature.radius or 0.0)


def _with_holes(features: list[MapFeature]) -> Iterator[MapFeature]:
    """The features; a ring on a layer of holes becomes a hole of the polygon around it."""
    holes = [one for one in features if _layer_of(one).endswith("_HOLES")]
    for feature in features:
        if feature in holes:
            continue
        near = [one for one in holes if feature.shape == "polygon" and holds(feature.rings[:1], one.rings[0][0])]
        own = (one.rings[0] for one in near if _layer_of(one).removesuffix("_HOLES") == _layer_of(feature))
        yield replace(feature, rings=(*feature.rings, *own))


def _layer_of(feature: MapFeature) -> str:
    return str(feature.properties.get("layer", ""))


def written(drawing: Drawing) -> bytes:
    """A drawing in metres: areas as closed polylines, the path and walls as polylines, trees and marks as circles, each
    with its text.

    raises: MissingPackage
    """
    document = new_dxf((f"{name}{holes}", colour) for name, colour in LAYERS.values() for holes in ("", "_HOLES"))
    space, names, radii = document.modelspace(), {}, {}
    told: dict[str, object] = {}
    for feature in drawing.features:
        layer = LAYERS[feature.role or "obstacle"][0]
        for k, ring in enumerate(feature.rings):
            entity = _drawn(space, feature, ring, f"{layer}_HOLES" if k else layer)
            if feature.name is not None and not k:
                names[entity.dxf.handle] = feature.name
            if feature.shape == "line" and feature.radius is not None:
                radii[entity.dxf.handle] = float(feature.radius)
        if feature.role in ("obstacle", "mark") and feature.name:
            point = inner_point(feature.rings) if feature.shape == "polygon" else feature.rings[0][0]
            x, y = point if feature.role == "obstacle" else (point[0] + CROSS, point[1] + CROSS)
            space.add_text(feature.name, dxfattribs={"layer": layer, "height": WORDS, "insert": (x, y)})
        if feature.role == "path":
            told["path"] = feature.properties["path"]
    if drawing.origin is not None:
        told["origin"] = drawing.origin
    text = orjson.dumps(told | {"names": names, "radii": radii}).decode()
    # The format is text in lines of limited length, and a character outside ASCII takes several places.
    text = text.encode("ascii", "backslashreplace").decode().replace("\\x", "\\u00")
    record = document.rootdict.add_xrecord(RECORD)
    record.reset([(1, text[k : k + CHUNK]) for k in range(0, len(text), CHUNK)])
    return dxf_bytes(document)


def _drawn(space: Any, feature: MapFeature, ring: Ring, layer: str) -> Any:
    attributes: dict[str, object] = {"layer": layer}
    if feature.shape == "point":
        return space.add_circle(ring[0], feature.radius or 0.5 * CROSS, dxfattribs=attributes)
    closed = feature.shape == "polygon"
    if feature.radius is not None:
        attributes["const_width"] = 2.0 * feature.radius
    return space.add_lwpolyline(ring[:-1] if closed else ring, close=closed, dxfattribs=attributes)
