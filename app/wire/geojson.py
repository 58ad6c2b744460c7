"""GeoJSON: the polygons of a venue by name, in any nesting of features and collections; and polygons written.

Read by hand, not by geojson-pydantic (2.2.0, measured on 2026-11-22). That package names three places for one missing
number, with its own classes in them (`FeatureCollection.features.0.geometry.Polygon.coordinates.0.1.Position2D.1`).
It accepts a feature without geometry, a name that is not a text, and coordinates of any size, so the checks below
would stay. It also reads all of 140,000 rings, in 1.7 s, before anyone can count them; here they are refused
within 0.1 s.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np

from app.wire.fields import short_json
from core import Area, InvalidValue, Venue
from core.checks import COORDINATE_MAX, checked_member, checked_number
from core.language import say
from core.names import checked_name
from core.proposal.gates import STREETS, GateUse
from core.quantities import Given
from core.shapes.engines import Polygons, thickened
from core.values import Point
from core.venue import EDGES_MAX, Ring, refuse_many_edges

# Name and rings.
Polygon = tuple[str, tuple[Ring, ...]]
# Name, the rings of a polygon or the points of a tree or a wall, and its radius, if it has one [m].
Thing = tuple[str, tuple[Ring, ...], float | None]
# Name if it has one, the field of its coordinates, the coordinates as given, half of its width, if it has one [m], and
# True for one of several polygons of a MultiPolygon.
RawPolygon = tuple[str | None, str, object, float | None, bool]
# Unit of coordinates, and the largest |x| and |y| in it.
Scale = tuple[str, float, float]
METRES: Scale = ("m", COORDINATE_MAX, COORDINATE_MAX)

# Name of the square.
SQUARE = "square"
# Roles of what stands in a venue for people, and the shape of each: a gate is a point of the border with the heading of
# those who enter; the square as it was before streets were added beyond its gates is a closed line; a lane to keep free
# is its middle line, with half of its width as its radius.
GATE, INNER_SQUARE, LANE = "gate", "square without streets", "emergency lane"
GATE_PROPERTIES = ("heading", "use", "street_width", "street_length")
ASIDES = {GATE: "Point", INNER_SQUARE: "LineString", LANE: "LineString"}
# Largest nesting depth [1]: a collection of features of collections of polygons.
DEPTH_MAX = 8
# Radius of a round obstacle, and half of the width of a wall [m].
RADIUS_MIN, RADIUS_MAX = 1e-3, 1e3
# Edges of a venue up to which a tree is a polygon as fine as the end of a wall; beyond, trees have only so many sides,
# which reach by at most TREE_REACH times the radius from the middle [1]: 500 trees fit.
FINE_EDGES, TREE_SIDES = 2_000, 8
TREE_REACH = 1.0001 / math.cos(math.pi / TREE_SIDES)
# Half of the width of a lane: least, that of one without a width, and largest [m]; and most points of its middle line.
LANE_MIN, LANE_RADIUS, LANE_MAX = 0.25, 1.75, 25.0
LANE_POINTS_MAX = 1000


class Aside(NamedTuple):
    """What stands in a venue for people: no bench can touch it.

    own: what is known of a gate: `heading` of those who enter [rad], its `use`, `street_width` and `street_length` [m]
    radius: half of the width of a lane [m]
    """

    role: str
    name: str | None
    points: Ring
    own: Mapping[str, float | str] = {}
    radius: float | None = None


class SentPart(NamedTuple):
    """A polygon, a tree or a wall of a venue as it was sent.

    name: None if it has none; radius: of a tree, or half of the width of a wall [m]; several: True for one of several
        polygons of a MultiPolygon
    """

    name: str | None
    rings: tuple[Ring, ...]
    radius: float | None
    several: bool


def read_things(geometry: object, scale: Scale = METRES) -> list[Thing]:
    """The polygons, trees and walls of a GeoJSON object, the square first.

    geometry: a Polygon, a MultiPolygon, a Feature of one, a GeometryCollection or a FeatureCollection of them. The
        square is the feature whose property `name` is "square", else the first polygon; the others are obstacles, named
        by their property `name`, else "obstacle 1" and so on. Heights are ignored. In metres a Feature of a Point or of
        a LineString whose property `radius` is positive is an obstacle too: a tree, or a wall of twice that width.
        Those that asides_in() returns are left out.
    raises: InvalidValue naming the member at fault; too many edges are refused before any coordinate is read
    """
    return named(parts_in(geometry, scale))


def parts_in(geometry: object, scale: Scale) -> list[SentPart]:
    """The same without names for those that have none."""
    polygons = _polygons("venue", geometry)
    whole = [k for k, one in enumerate(polygons) if one[3] is None]
    if not whole:
        raise InvalidValue("venue", "must hold at least one polygon, the square")
    refuse_many_edges(
        ring for _, _, rings, *_ in polygons if isinstance(rings, list) for ring in rings if isinstance(ring, list)
    )
    parts = [
        SentPart(name, _rings(field, rings, scale, radius), radius, several)
        for name, field, rings, radius, several in polygons
    ]
    square = next((k for k in whole if parts[k].name == SQUARE), whole[0])
    return [parts[square], *(one for k, one in enumerate(parts) if k != square)]


def named(parts: Sequence[SentPart]) -> list[Thing]:
    """The parts of a venue with a name each, the square first; those of a MultiPolygon are numbered."""
    names: list[str] = []
    for k, part in enumerate(parts):
        bare = unique = part.name or (say("obstacle {k}", k=k) if k else SQUARE)
        count = 1
        while part.several and unique in names:
            count += 1
            unique = f"{bare} {count}"
        names.append(unique)
    return [(name, part.rings, part.radius) for name, part in zip(names, parts, strict=True)]


def asides_in(geometry: object, scale: Scale = METRES, field: str = "venue") -> list[Aside]:
    """The gates, the lanes, and the square without streets, of GeoJSON that read_things() accepts.

    raises: InvalidValue
    """
    if not isinstance(geometry, Mapping):
        return []
    if is_aside(geometry):
        properties, shape = geometry["properties"], geometry["geometry"]
        name, own = properties.get("name"), dict(_of_gate(properties, f"{field}.properties"))
        points = [shape.get("coordinates")] if shape["type"] == "Point" else shape.get("coordinates")
        (ring,), role = _rings(f"{field}.geometry.coordinates", [points], scale, None), str(properties["role"])
        if role != LANE:
            return [Aside(role, name, ring, own)]
        if len(set(ring)) < 2:
            raise InvalidValue(f"{field}.geometry.coordinates", "must be a line with a length")
        if len(ring) > LANE_POINTS_MAX:
            rule = "must be at most {most} points"
            raise InvalidValue(f"{field}.geometry.coordinates", rule, got=len(ring), most=LANE_POINTS_MAX)
        half = properties.get("radius")
        half = LANE_RADIUS if half is None else half
        radius = checked_number(f"{field}.properties.radius", half, "m", LANE_MIN, LANE_MAX)
        return [Aside(role, name, ring, radius=radius)]
    members = ((name, geometry.get(name)) for name in ("features", "geometries"))
    every = (
        (f"{field}.{name}.{k}", one) for name, some in members if isinstance(some, list) for k, one in enumerate(some)
    )
    return [aside for where, one in every for aside in asides_in(one, scale, where)]


def gate_properties(properties: Mapping[str, Any]) -> dict[str, Any]:
    """Of these properties those that only gates have."""
    return {name: value for name in GATE_PROPERTIES if (value := properties.get(name)) is not None}


def _of_gate(properties: Mapping[str, Any], field: str) -> Iterator[tuple[str, float | str]]:
    """The properties that only gates have. field: of the properties. raises: InvalidValue"""
    for name, value in gate_properties(properties).items():
        if name == "use":
            yield name, checked_member(f"{field}.{name}", value, GateUse).value
        elif name == "heading":
            yield name, checked_number(f"{field}.{name}", value, "rad", -2.0 * math.pi, 2.0 * math.pi)
        else:
            yield name, checked_number(f"{field}.{name}", value, "m", *STREETS)


def is_aside(feature: Mapping[str, Any]) -> bool:
    """True for a Feature with one of the roles of ASIDES, in its shape and, but for a lane, without a radius."""
    properties, shape = feature.get("properties"), feature.get("geometry")
    if feature.get("type") != "Feature" or not isinstance(properties, Mapping) or not isinstance(shape, Mapping):
        return False
    role = properties.get("role")
    bare = role == LANE or properties.get("radius") is None
    return isinstance(role, str) and shape.get("type") == ASIDES.get(role, "") and bare


def outlined(things: Sequence[Thing]) -> list[Polygon]:
    """The things as polygons; that of a tree or a wall holds all within its radius, and reaches at most 2% further.

    Trees of a venue that has more than FINE_EDGES so reach up to TREE_REACH times their radius.
    raises: InvalidValue with the number of edges that even so are too many
    """
    outlines = [(name, _thick(rings[0], radius) if radius is not None else rings) for name, rings, radius in things]
    if edge_count(outlines) <= FINE_EDGES:
        return outlines
    trees = 0
    for k, (name, rings, radius) in enumerate(things):
        if radius is not None and len(set(rings[0])) == 1:
            outlines[k], trees = (name, _around(rings[0][0], radius)), trees + 1
    if trees and edge_count(outlines) > EDGES_MAX:
        rule = "must have at most {most} edges, of which {trees} trees have {sides} each"
        values = {"most": EDGES_MAX, "trees": trees, "sides": TREE_SIDES}
        raise InvalidValue("venue", rule, got=edge_count(outlines), **values)
    return outlines


def is_rough(thing: Thing, ring: Ring) -> bool:
    """True for a tree that counts as a polygon of TREE_SIDES, by its outline."""
    return thing[2] is not None and len(ring) == TREE_SIDES + 1


def edge_count(polygons: Sequence[Polygon]) -> int:
    """Number of edges of all polygons."""
    return sum(max(len(ring) - 1, 1) for _, rings in polygons for ring in rings)


def _thick(line: Ring, radius: float) -> tuple[Ring, ...]:
    """A polygon around the points of a tree or a wall."""
    (outline,) = thickened(np.array(line), radius)
    return tuple(tuple(map(tuple, ring.tolist())) for ring in outline)


def _around(middle: Point, radius: float) -> tuple[Ring, ...]:
    """A polygon of TREE_SIDES around a tree."""
    (x, y), far = middle, TREE_REACH * radius
    ways = [math.tau * k / TREE_SIDES for k in range(TREE_SIDES)]
    ring = [(x + far * math.cos(way), y + far * math.sin(way)) for way in ways]
    return ((*ring, ring[0]),)


def venue_of(polygons: Sequence[Polygon]) -> Venue:
    """The venue made of polygons in metres, the square first.

    raises: InvalidValue naming the polygon with the reason and the place
    """
    square, *obstacles = (Area(*polygon) for polygon in polygons)
    return Venue(square, tuple(obstacles))


def geometry_of(polygons: Polygons) -> dict[str, object]:
    """Polygons as a geometry, in metres."""
    several = [[ring.tolist() for ring in rings] for rings in polygons]
    if len(several) == 1:
        return {"type": "Polygon", "coordinates": several[0]}
    return {"type": "MultiPolygon", "coordinates": several}


def venue_geometry(venue: Venue, origin: Any = None) -> dict[str, object]:
    """A venue in metres, the square first. origin: its longitude and latitude [degrees], None if unknown"""
    features = [
        {
            "type": "Feature",
            "properties": {"name": area.name},
            "geometry": {"type": "Polygon", "coordinates": [[list(point) for point in ring] for ring in area.rings]},
        }
        for area in venue.areas
    ]
    place = {} if origin is None else {"origin": {"longitude": origin.longitude, "latitude": origin.latitude}}
    return {"type": "FeatureCollection", **place, "features": features}


def _polygons(field: str, geometry: object, depth: int = 0) -> list[RawPolygon]:
    """Every polygon of a GeoJSON object, in its order."""
    if depth > DEPTH_MAX:
        raise InvalidValue("venue", "must not nest objects deeper than {most}", most=DEPTH_MAX)
    if not isinstance(geometry, Mapping):
        raise InvalidValue(field, "must be a GeoJSON object", got=Given(geometry, short_json(geometry)))
    kind = geometry.get("type")
    if kind == "Polygon":
        return [(None, f"{field}.coordinates", geometry.get("coordinates"), None, False)]
    if kind == "MultiPolygon":
        several = _listed(f"{field}.coordinates", geometry.get("coordinates"), "polygon")
        return [(None, f"{field}.coordinates.{k}", one, None, True) for k, one in enumerate(several)]
    if kind == "Feature":
        properties = geometry.get("properties")
        name = properties.get("name") if isinstance(properties, Mapping) else None
        if name is not None:
            checked_name(f"{field}.properties.name", name)
        shape = geometry.get("geometry")
        if is_aside(geometry):
            return []
        if isinstance(shape, Mapping) and shape.get("type") in ("Point", "LineString"):
            value = properties.get("radius") if isinstance(properties, Mapping) else None
            radius = checked_number(f"{field}.properties.radius", value, "m", RADIUS_MIN, RADIUS_MAX)
            points = shape.get("coordinates")
            lines = [points] if shape["type"] == "LineString" else [[points, points]]
            return [(name, f"{field}.geometry.coordinates", lines, radius, False)]
        inner = _polygons(f"{field}.geometry", shape, depth + 1)
        return [(name or own, where, rings, width, several) for own, where, rings, width, several in inner]
    members = {"FeatureCollection": "features", "GeometryCollection": "geometries"}.get(str(kind))
    if members is None:
        rule = "must be Polygon, MultiPolygon, Feature, FeatureCollection or GeometryCollection"
        raise InvalidValue(f"{field}.type", rule, got=Given(kind))
    items = _listed(f"{field}.{members}", geometry.get(members))
    each = (_polygons(f"{field}.{members}.{k}", item, depth + 1) for k, item in enumerate(items))
    return [polygon for polygons in each for polygon in polygons]


def _rings(field: str, value: object, scale: Scale, radius: float | None) -> tuple[Ring, ...]:
    rings = _listed(field, value, "ring")
    read = tuple(
        tuple(
            _place(f"{field}.{k}.{i}", point, scale) for i, point in enumerate(_listed(f"{field}.{k}", ring, "point"))
        )
        for k, ring in enumerate(rings)
    )
    if radius is None:
        return read
    if scale != METRES:
        raise InvalidValue(field, "must be in metres, because its radius is, or be a Polygon", got=scale[0])
    if len(read[0]) < 2:
        raise InvalidValue(field, "must be at least 2 points", got=len(read[0]))
    return read


def _place(field: str, value: object, scale: Scale) -> Point:
    unit, *limits = scale
    numbers = _listed(field, value)
    if len(numbers) not in (2, 3):
        rule = "must be a position [x, y] in metres, got {count} numbers"
        if scale != METRES:
            rule = "must be a position [longitude, latitude] in degrees, got {count} numbers"
        raise InvalidValue(field, rule, count=len(numbers))
    x, y = (checked_number(f"{field}.{k}", numbers[k], unit, -limits[k], limits[k]) for k in range(2))
    return x, y


def _listed(field: str, value: object, entry: str = "") -> list[object]:
    """The value if it is a list; if the entry has a name, the list must not be empty."""
    if not isinstance(value, list):
        raise InvalidValue(field, "must be a list", got=Given(value, short_json(value)))
    if entry and not value:
        raise InvalidValue(field, "must hold at least one {entry}", entry=entry)
    return value
