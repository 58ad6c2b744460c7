"""Maps as GeoJSON, in degrees as in RFC 7946, or in metres.

Read by hand (see app/wire/geojson.py): a map of another program may have features without geometry and open rings.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import suppress
from dataclasses import replace
from typing import Any, TypeGuard

import orjson

from app.maps.choice import EVERYTHING, Choice
from app.maps.features import (
    PATH,
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
from app.wire.degrees import GEOGRAPHIC, crs_name
from app.wire.geojson import DEPTH_MAX
from app.wire.numbers import number_of
from core import InvalidValue
from core.language import Listed
from core.quantities import Given
from core.values import Point
from core.venue import Ring

# For each geometry: the shape of its parts, and the depth of its lists of points in its coordinates.
GEOMETRIES: dict[str, tuple[Shape, int]] = {
    "Point": ("point", 0),
    "MultiPoint": ("point", 1),
    "LineString": ("line", 1),
    "MultiLineString": ("line", 2),
    "Polygon": ("polygon", 2),
    "MultiPolygon": ("polygon", 3),
}
COLLECTIONS = {"FeatureCollection": "features", "GeometryCollection": "geometries"}


def read(document: Mapping[str, Any], choice: Choice = EVERYTHING) -> Drawing:
    """The map in a GeoJSON object, or the chosen layers of it. raises: InvalidValue at the member at fault

    choice: of its area nothing is said here, because that is in metres
    """
    collector, layers = FeatureCollector(is_limited=not choice.counts), dict[str, None]()
    for feature in _features("file", document, MapFeature("point", ()), collector):
        layers[layer_of(feature)] = None
        if choice.has_layer(layer_of(feature)):
            collector.add(feature)
    choice.refuse_unknown(layers)
    system = crs_name(document)
    geographic = system is not None and GEOGRAPHIC.search(system) is not None
    line: Mapping[str, object] = next((one.properties for one in collector.features if "path" in one.properties), {})
    unit = Unit.UNKNOWN if system is None else Unit.DEGREES if geographic else Unit.METRES
    # A map in metres has an origin only if this program wrote it.
    return collector.drawing(unit, {**line, "origin": document.get("origin")})


def layer_of(feature: MapFeature) -> str:
    """What stands for the layer of a feature: its property `layer`, or else its role, its name or its shape."""
    layer = _property(feature.properties, "layer")
    words = (layer if isinstance(layer, str) else None, feature.role, feature.name)
    return next((word.strip() for word in words if word and word.strip()), feature.shape)


def is_of_polygons(document: object) -> bool:
    """True if a GeoJSON object holds no points and no lines."""
    if isinstance(document, Mapping):
        inside = (document.get(name) for name in ("geometry", "features", "geometries"))
        lone = ("Point", "MultiPoint", "LineString", "MultiLineString", "MultiPolygon")
        return document.get("type") not in lone and all(map(is_of_polygons, inside))
    return not isinstance(document, list) or all(map(is_of_polygons, document))


def _is_number(value: object) -> TypeGuard[float]:
    return isinstance(value, (int, float)) and not isinstance(value, bool)


def _length(value: object) -> float | None:
    """A number; some programs write it as text."""
    if isinstance(value, str):
        with suppress(ValueError):
            return number_of(value)
    return float(value) if _is_number(value) else None


def _features(
    field: str, document: object, like: MapFeature, collector: FeatureCollector, depth: int = 0
) -> Iterator[MapFeature]:
    """Every feature of a GeoJSON object in its order; `like` has the name and the role of the object around it."""
    if depth > DEPTH_MAX:
        raise InvalidValue(field, "must not nest objects deeper than {most}", most=DEPTH_MAX)
    if document is None and depth:
        collector.leave_out(empty_kind("Feature"))
        return
    kind = document.get("type") if isinstance(document, Mapping) else None
    if not isinstance(document, Mapping) or not isinstance(kind, str):
        raise InvalidValue(field, "must be a GeoJSON object with a type", got=Given(document))
    if kind == "Feature":
        stated = document.get("properties")
        properties = {str(name): value for name, value in stated.items()} if isinstance(stated, Mapping) else {}
        name, radius, role, layer = (_property(properties, word) for word in ("name", "radius", "role", "layer"))
        own, role = name if isinstance(name, str) and name else None, role_of(role, name, layer)
        around = MapFeature("point", (), own, role, _length(radius), properties)
        yield from _features(f"{field}.geometry", document.get("geometry"), around, collector, depth + 1)
    elif kind in COLLECTIONS:
        member = COLLECTIONS[kind]
        for k, one in enumerate(_listed(f"{field}.{member}", document.get(member))):
            yield from _features(f"{field}.{member}.{k}", one, like, collector, depth + 1)
    elif kind in GEOMETRIES:
        shape, deep = GEOMETRIES[kind]
        for rings in _parts(f"{field}.coordinates", document.get("coordinates"), shape, deep):
            one = replace(like, shape=shape, rings=rings)
            yield drawn_as(one) if shape == "line" else one  # Some programs draw a polygon as a line.
    else:
        known = Listed([*GEOMETRIES, "Feature", *COLLECTIONS])
        raise InvalidValue(f"{field}.type", "must be one of {known}", got=Given(kind), known=known)


def _property(properties: Mapping[str, object], name: str) -> object:
    """The value of a property, however its name is written: other programs write NAME or Name."""
    return next((value for word, value in properties.items() if word.lower() == name and value is not None), None)


def _parts(field: str, value: object, shape: Shape, deep: int) -> Iterator[tuple[Ring, ...]]:
    """The rings of each single point, line or polygon in coordinates."""
    own = {"point": 0, "line": 1, "polygon": 2}[shape]
    if deep > own:
        for k, one in enumerate(_listed(field, value)):
            yield from _parts(f"{field}.{k}", one, shape, deep - 1)
    elif shape == "point":
        yield ((_point(field, value),),)
    elif shape == "line":
        yield (_ring(field, value),)
    else:
        yield tuple(_ring(f"{field}.{k}", ring) for k, ring in enumerate(_listed(field, value)))


def _ring(field: str, value: object) -> Ring:
    return tuple(_point(f"{field}.{k}", point) for k, point in enumerate(_listed(field, value)))


def _point(field: str, value: object) -> Point:
    numbers = _listed(field, value)
    if len(numbers) < 2 or not all(map(_is_number, numbers[:2])):
        raise InvalidValue(field, "must be a position of two numbers", got=Given(value))
    return float(numbers[0]), float(numbers[1])


def _listed(field: str, value: object) -> list[Any]:
    if not isinstance(value, list) or not value:
        raise InvalidValue(field, "must be a list with at least one entry", got=Given(value))
    return value


def written(drawing: Drawing) -> bytes:
    """A feature collection; the properties of the path's line hold the path as a request describes it."""
    grid = place_fields(grid=drawing.grid)
    features = [feature_of(one, _properties(one) | (grid if one.role == PATH else {})) for one in drawing.features]
    return orjson.dumps({"type": "FeatureCollection", **place_fields(drawing.origin), "features": features})


def _properties(feature: MapFeature) -> dict[str, object]:
    radius = {} if feature.radius is None else {"radius": feature.radius}
    return {"name": feature.name, "role": feature.role, **radius, **feature.properties}


def feature_of(feature: MapFeature, properties: Mapping[str, object]) -> dict[str, object]:
    """A feature with these properties, in the unit of its points."""
    return {"type": "Feature", "properties": properties, "geometry": _geometry_of(feature)}


def _geometry_of(feature: MapFeature) -> dict[str, object]:
    rings = [[list(point) for point in ring] for ring in feature.rings]
    if feature.shape == "polygon":
        return {"type": "Polygon", "coordinates": rings}
    if feature.shape == "point":
        return {"type": "Point", "coordinates": rings[0][0]}
    return {"type": "LineString", "coordinates": rings[0]}
