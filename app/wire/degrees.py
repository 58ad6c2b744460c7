"""Longitude and latitude, distinguished from metres and projected onto a plane in metres.

Core knows only metres. GeoJSON (RFC 7946) uses degrees: read as metres, a square of 200 m would be 2 mm wide.
"""

from __future__ import annotations

import math
import re
from collections.abc import Hashable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from app.wire.fields import Coordinates
from app.wire.geojson import (
    METRES,
    SQUARE,
    TREE_REACH,
    Aside,
    Polygon,
    Scale,
    SentPart,
    Thing,
    asides_in,
    is_rough,
    named,
    outlined,
    parts_in,
    venue_of,
)
from app.wire.parts import is_cut, whole_areas
from core import Dragon, InvalidValue, Venue
from core.checks import checked_number
from core.language import phrase, say
from core.quantities import Given, Parameter, quantities
from core.values import Floats, Point
from core.venue import Ring

# The ellipsoid of WGS 84: half of its long axis [m], and its flattening [1]. CGCS2000 differs by 0.1 mm.
AXIS = 6_378_137.0
FLATTENING = 1 / 298.257223563
# Largest extent of a venue in degrees [m]: 10 km from its middle the plane shortens lengths by one part in a million.
ACROSS_MAX = 20_000.0
# Largest coordinate on a survey grid [m]: with its zone in front, an easting of CGCS2000 has eight digits.
GRID_MAX = 1e8
# Names of coordinate systems whose coordinates are longitude and latitude: CRS84, and by their EPSG numbers WGS 84,
# CGCS2000, ETRS89 and NAD83.
GEOGRAPHIC = re.compile(r"CRS:?84|\bEPSG:+[\d.]*:*(?:4326|4979|4490|4258|4269)$", re.IGNORECASE)

# Programs go on beyond 180 where a map reaches over the date line: 181 is -179.
TURN = 360.0
DEGREES: Scale = ("degrees", TURN, 90.0)
LATITUDE_FIRST: Scale = ("degrees", 90.0, 180.0)
# Steps of Newton's method from a plane back to the ellipsoid; 10 km from the middle each step adds four digits.
STEPS = 4
SWAPPED = phrase("longitude comes first and latitude second, and here they look swapped")


@dataclass(frozen=True, slots=True)
class GeographicOrigin:
    """Place of x = y = 0 [degrees]."""

    longitude: float
    latitude: float


# The plane touches the ellipsoid at O. A point P at longitude l and latitude p is, from the centre of the earth,
# (n cos p cos l, n cos p sin l, n (1 - e2) sin p) with n = AXIS / sqrt(1 - e2 sin^2 p) and e2 = f (2 - f). East and
# north of O are the projections of P - O on the unit vectors (-sin l0, cos l0, 0) and
# (-sin p0 cos l0, -sin p0 sin l0, cos p0).
class Plane:
    """The plane that touches the earth at an origin: x to the east, y to the north [m]."""

    def __init__(self, origin: GeographicOrigin) -> None:
        self.origin = origin
        l0, p0 = math.radians(origin.longitude), math.radians(origin.latitude)
        self.middle = _from_centre(np.array([[origin.longitude, origin.latitude]]))
        east = [-math.sin(l0), math.cos(l0), 0.0]
        north = [-math.sin(p0) * math.cos(l0), -math.sin(p0) * math.sin(l0), math.cos(p0)]
        self.axes = np.array([east, north])

    def metres(self, places: Floats) -> Floats:
        """Points (N, 2) [m] of places (N, 2), longitude and latitude [degrees]."""
        projected: Floats = (_from_centre(places) - self.middle) @ self.axes.T
        return projected

    def degrees(self, points: Floats) -> Floats:
        """Places (N, 2), longitude and latitude [degrees], of points (N, 2) [m]; the inverse of metres()."""
        middle = np.array([self.origin.longitude, self.origin.latitude])
        squared = FLATTENING * (2.0 - FLATTENING)
        sine = math.sin(math.radians(self.origin.latitude))
        across = AXIS / math.sqrt(1.0 - squared * sine**2)
        along = across * (1.0 - squared) / (1.0 - squared * sine**2)
        scale = np.radians([across * math.sqrt(1.0 - sine**2), along])
        places: Floats = middle + points / scale
        for _ in range(STEPS):
            places = places + (points - self.metres(places)) / scale
        return places


@dataclass(frozen=True, slots=True)
class Place:
    """A venue in metres; the place of its origin on earth, and on a survey grid [m], if they are known; the things it
    was made of, and what else stands in it for people.
    """

    venue: Venue | None = None
    origin: GeographicOrigin | None = None
    things: Sequence[Thing] = ()
    grid: Point | None = None
    asides: Sequence[Aside] = ()

    def words(self) -> list[str]:
        """How much wider than they are trees count, if there are many."""
        areas = () if self.venue is None else self.venue.areas
        rough = sum(is_rough(thing, area.rings[0]) for thing, area in zip(self.things, areas, strict=True))
        more = math.ceil(100.0 * (TREE_REACH - 1.0))
        words = phrase("Each of the {count} trees counts as an octagon around it, with corners {more}% further out.")
        return [say(words, count=rough, more=more)] if rough else []


def place_of(geometry: Mapping[str, object], coordinates: Coordinates | None, dragon: Dragon) -> Place:
    """The venue in a GeoJSON object.

    coordinates: unit of its coordinates; None: as its member `crs` says, otherwise metres
    raises: InvalidValue, also for metres that must be degrees: all coordinates may be degrees, in either order,
        and the square is narrower than a bench
    """
    system_name = crs_name(geometry)
    for member in ("geometry", "features", "geometries"):
        _refuse_systems_inside(f"venue.{member}", geometry.get(member))
    geographic = system_name is not None and GEOGRAPHIC.search(system_name) is not None
    if coordinates is None and system_name is not None and not geographic:
        words = "give longitude and latitude without crs, or true metres with coordinates 'metres' beside the venue"
        raise InvalidValue("venue.crs", f"must be left out or name CRS84: {words}", got=Given(system_name))
    if system_name is not None and coordinates == ("metres" if geographic else "degrees"):
        rule = "must agree with {crs}: {system} is something else"
        if geographic:
            rule = "must agree with {crs}: {system} is longitude and latitude"
        crs, system = Parameter("venue.crs"), Given(system_name)
        raise InvalidValue("coordinates", rule, got=Given(coordinates), crs=crs, system=system)
    if coordinates == "degrees" or geographic:
        return _projected(_in_degrees(geometry), asides_in(geometry, DEGREES))
    parts = parts_in(geometry, METRES)
    things = named(_joined(parts, _kinds(parts, [False] * len(parts))))
    polygons = outlined(things)
    _refuse_degrees(polygons, float(dragon.lengths.max()))
    origin, grid = _stated_origin(geometry.get("origin")), _stated_grid(geometry.get("grid"))
    return Place(venue_of(polygons), origin, things, grid, asides_in(geometry))


def _stated_origin(member: object) -> GeographicOrigin | None:
    """Place of x = y = 0, from the member `origin` of a venue in metres. raises: InvalidValue"""
    if member is None:
        return None
    if not isinstance(member, Mapping) or set(member) != {"longitude", "latitude"}:
        raise InvalidValue("venue.origin", "must have longitude and latitude in degrees, or be left out")
    limits = {"longitude": 0.5 * TURN, "latitude": DEGREES[2]}
    places = (checked_number(f"venue.origin.{name}", member[name], "degrees", -m, m) for name, m in limits.items())
    return GeographicOrigin(*places)


def _stated_grid(member: object) -> Point | None:
    """Place of x = y = 0 on a survey grid [m], from the member `grid` of a venue in metres. raises: InvalidValue"""
    if member is None:
        return None
    if not isinstance(member, Mapping) or set(member) != {"x", "y"}:
        raise InvalidValue("venue.grid", "must have x and y in metres, or be left out")
    x, y = (checked_number(f"venue.grid.{name}", member[name], "m", -GRID_MAX, GRID_MAX) for name in "xy")
    return x, y


def crs_name(geometry: Mapping[str, object]) -> str | None:
    """Name of the coordinate system in GeoJSON of 2008; None without one."""
    system = geometry.get("crs") if isinstance(geometry, Mapping) else None
    if system is None:
        return None
    properties = system.get("properties") if isinstance(system, Mapping) else None
    name = properties.get("name") if isinstance(properties, Mapping) else None
    if not isinstance(name, str):
        raise InvalidValue("venue.crs", "must be left out, or name a coordinate system in properties.name")
    return name


def _refuse_systems_inside(field: str, part: object) -> None:
    """Refuse a coordinate system named in an inner object, where it would be ignored."""
    if isinstance(part, Mapping):
        if part.get("crs") is not None:
            words = "its coordinate system is that of the whole venue: name it in venue.crs"
            raise InvalidValue(f"{field}.crs", f"must be left out: {words}")
        for member in ("geometry", "features", "geometries"):
            _refuse_systems_inside(f"{field}.{member}", part.get(member))
    elif isinstance(part, list):
        for k, item in enumerate(part):
            _refuse_systems_inside(f"{field}.{k}", item)


def _in_degrees(geometry: Mapping[str, object]) -> list[SentPart]:
    """The parts of a venue in degrees. raises: InvalidValue, with a hint if longitude and latitude look swapped"""
    try:
        return parts_in(geometry, DEGREES)
    except InvalidValue as error:
        try:
            parts_in(geometry, LATITUDE_FIRST)
        except InvalidValue:
            raise error from None
        raise error.because(SWAPPED) from error


def _kinds(parts: Sequence[SentPart], are_cut: Sequence[bool]) -> list[Hashable]:
    """What the parts of one area share: those of the square their name, those that are cut too; None for others."""
    return [
        (one.name,) if one.radius is None and (cut or one.name == SQUARE) else None
        for one, cut in zip(parts, are_cut, strict=True)
    ]


def _joined(parts: Sequence[SentPart], kinds: Sequence[Hashable]) -> list[SentPart]:
    """The parts in metres, where those of a kind that make one area are that."""
    whole = whole_areas([one.rings for one in parts], kinds)
    return [one._replace(rings=rings) for one, rings in zip(parts, whole, strict=True) if rings is not None]


def _bounds(rings: list[Ring]) -> tuple[float, float, float, float]:
    """Least x and y, largest x and y."""
    xs, ys = zip(*(point for ring in rings for point in ring), strict=True)
    return min(xs), min(ys), max(xs), max(ys)


def _refuse_degrees(polygons: list[Polygon], longest: float) -> None:
    places = [point for _, rings in polygons for ring in rings for point in ring]
    in_order = all(abs(x) <= TURN and abs(y) <= 90.0 for x, y in places)
    swapped = all(abs(x) <= 90.0 and abs(y) <= 180.0 for x, y in places)
    if not places or not (in_order or swapped):
        return
    left, low, right, high = _bounds([polygons[0][1][0]])
    if max(right - left, high - low) >= longest:
        return
    rule = (
        "must be in metres, got what looks like longitude and latitude, a square of {width} by {height}, "
        "narrower than a bench of {length}"
    )
    advice = 'give "coordinates": "degrees" beside the venue, in TOML coordinates = "degrees", to have it in metres'
    if not in_order:
        rule = (
            "must be in metres, got what looks like latitude and longitude in that order, a square of {width} by "
            "{height}, narrower than a bench of {length}"
        )
        advice = (
            f'{SWAPPED}; put them in order, and give "coordinates": "degrees" beside the venue, in TOML '
            'coordinates = "degrees", to have it in metres'
        )
    values = quantities("", 6, width=right - left, height=high - low) | quantities("m", 6, length=longest)
    raise InvalidValue("venue", f"{rule}: {advice}", **values)


def _projected(parts: list[SentPart], asides: list[Aside]) -> Place:
    near = parts[0].rings[0][0][0]
    parts = [one._replace(rings=tuple(unwrapped(ring, near) for ring in one.rings)) for one in parts]
    are_cut = [is_cut(one.rings) for one in parts]
    # A square may be drawn in several parts.
    kinds = _kinds(parts, are_cut)
    squares = [one.rings[0] for one, kind in zip(parts, kinds, strict=True) if kind is not None and kind == kinds[0]]
    origin = middle_of(squares or [parts[0].rings[0]])
    refuse_wide("venue", [ring for one in parts for ring in one.rings], origin)
    plane = Plane(origin)

    def placed(ring: Ring) -> Ring:
        return tuple(map(tuple, plane.metres(np.array(ring)).tolist()))

    metres = [one._replace(rings=tuple(map(placed, one.rings))) for one in parts]
    things = named(_joined(metres, kinds))
    where = GeographicOrigin((origin.longitude + 180.0) % 360.0 - 180.0, origin.latitude)
    beside = [one._replace(points=placed(unwrapped(one.points, near))) for one in asides]
    return Place(venue_of(outlined(things)), where, things, asides=beside)


def middle_of(rings: list[Ring]) -> GeographicOrigin:
    """The middle of the box around rings in degrees."""
    left, low, right, high = _bounds(rings)
    return GeographicOrigin(0.5 * (left + right), 0.5 * (low + high))


def refuse_wide(field: str, rings: list[Ring], origin: GeographicOrigin) -> None:
    """raises: InvalidValue for rings in degrees that are more than ACROSS_MAX across"""
    left, low, right, high = _bounds(rings)
    across = AXIS * math.radians(max((right - left) * math.cos(math.radians(origin.latitude)), high - low))
    if across > ACROSS_MAX:
        values = quantities("km", 6, most=ACROSS_MAX / 1000.0) | quantities("km", 4, across=across / 1000.0)
        raise InvalidValue(field, "must be at most {most} across, got about {across}", **values)


def unwrapped(ring: Ring, near: float) -> Ring:
    """The ring with all longitudes within half a turn of a given one, because they jump at the date line."""
    return tuple((near + (x - near + 180.0) % 360.0 - 180.0, y) for x, y in ring)


def _from_centre(places: Floats) -> Floats:
    """Positions (N, 3) of places (N, 2) on the ellipsoid, relative to the centre of the earth [m]."""
    long, lat = np.radians(places).T
    squared = FLATTENING * (2.0 - FLATTENING)
    n = AXIS / np.sqrt(1.0 - squared * np.sin(lat) ** 2)
    across = n * np.cos(lat)
    return np.stack([across * np.cos(long), across * np.sin(long), n * (1.0 - squared) * np.sin(lat)], axis=-1)
