"""The venue and the path in a map, in metres, with the assumptions made."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, replace
from itertools import pairwise
from typing import Any
from unicodedata import category

import numpy as np
from pydantic import TypeAdapter, ValidationError

from app.files.words import Say
from app.maps import geojson
from app.maps.features import MARK, PATH, SQUARE, Drawing, MapFeature, area_of, holds
from app.maps.marks import line_of
from app.wire.degrees import Origin, Plane, middle_of, refuse_wide, unwrapped
from app.wire.geojson import outlined, read_things, venue_of
from app.wire.messages import fault_of
from app.wire.paths import POINTS_MAX, AnyPath
from app.wire.question import Coordinates
from core import InvalidValue, Route, Spiral, Venue
from core.errors import Parameter, Quantity
from core.names import NAME_MAX, NOT_PLAIN
from core.shown import counted
from core.values import Floats

# Radius of a point, and half of the width of a line, without a radius [m].
POINT_RADIUS, LINE_RADIUS = 0.5, 0.1
# Largest number of things that a note names; a list of more ends in dots.
NAMED = 5
# Free ground around everything drawn, if no polygon is the square [m].
AROUND = 20.0
# A map narrower than this is in degrees, if its numbers allow it: 22 km in degrees, only 0.2 m in metres [degrees].
DEGREES_ACROSS = 0.2
# Least distance between two points of a path [m]; and largest distance of a line from its stored path, beyond which the
# line was moved [m].
POINTS_APART, MOVED = 0.05, 0.01
# Approximate number of points of that line to compare [1].
TRIED = 200


@dataclass(frozen=True)
class DanceParts:
    """The parts of a dance in a file.

    path: in the form of a request; venue: in metres, the square first; origin: place of x = y = 0
    things: features of the venue, where trees and walls have a radius
    dance: the other fields of a file that describes a dance; notes: assumptions, and things left out
    """

    path: Mapping[str, Any] | None = None
    venue: Venue | None = None
    origin: Origin | None = None
    dance: Mapping[str, Any] | None = None
    notes: Sequence[str] = ()
    things: Sequence[MapFeature] = ()

    @property
    def geometry(self) -> dict[str, Any] | None:
        """The venue as GeoJSON in metres, in the form of a request."""
        if self.venue is None:
            return None
        origin = {} if self.origin is None else {"origin": asdict(self.origin)}
        return {"type": "FeatureCollection", **origin, "features": [_told(one) for one in self.things]}


def _told(one: MapFeature) -> dict[str, Any]:
    properties = {"name": one.name} | ({} if one.radius is None else {"radius": one.radius})
    return {"type": "Feature", "properties": properties, "geometry": geojson.geometry_of(one)}


def _checked(things: list[MapFeature]) -> Venue:
    """The venue of features, checked like a request, so that a request can use them."""
    told = {"type": "FeatureCollection", "features": [_told(one) for one in things]}
    try:
        return venue_of(outlined(read_things(told)))
    except InvalidValue as error:
        raise error.named("file") from error


def checked_path(path: object) -> Spiral | Route:
    """The path of core that a request describes. raises: InvalidValue"""
    try:
        found: Spiral | Route = TypeAdapter[Any](AnyPath).validate_python(path).to_path()
    except ValidationError as error:
        first = error.errors(include_url=False)[0]
        fault = fault_of({**first, "loc": ("file", "path", *first["loc"])}, None)
        told = {**fault.values, "file": Parameter("file")}
        why = f"{fault.template}: {fault.reason}".removesuffix(": ")
        raise InvalidValue.in_words("file", "{file} must describe a path", got=fault.got, reason=why, **told) from error
    return found


# State:  `drawing`, in degrees or metres; from it `features`, in metres and without marks, and `origin`.
class Reading:
    """Reads a venue and a path from a map, and notes its assumptions."""

    def __init__(self, drawing: Drawing, units: Coordinates | None, say: Say) -> None:
        self.drawing, self.say, self.notes = drawing, say, list[str]()
        self.assumed = dict[float, list[str]]()
        self.features = [_closed(one) for one in drawing.features if one.role != MARK]
        if not self.features:
            raise InvalidValue("file", "must hold a polygon, a line or a point", got="none of these")
        self.origin = drawing.origin
        self._lay_out(units)
        for kind, count in drawing.left_out.items():
            self.notes.append(say(f"Left out: {counted(count, kind)}.", f"未读取：{kind}，{count} 个。"))

    def found(self) -> DanceParts:
        lines = [one for one in self.features if one.shape == "line"]
        square = self._square()
        told = [one for one in lines if one.role == PATH]
        # If no line has the role of the path, it is the longest line without a width.
        free = [one for one in lines if one.role is None and one.radius is None]
        danced = told[:1] or ([max(free, key=_length)] if free and not self._walls(free) else [])
        path = self._path(danced[0]) if danced else None
        others = [one for one in self.features if one is not square and one not in danced]
        things = self._things(square, others)
        return DanceParts(path, _checked(things) if things else None, self.origin, None, self.notes, things)

    def _walls(self, free: list[MapFeature]) -> bool:
        """True if lines without a role are walls: there are several, so none of them is clearly the path."""
        if len(free) > 1:
            self._note(
                f"{len(free)} lines have no role, so they are walls. Give the line of the dance the name `path`.",
                f"有 {len(free)} 条线没有说明用途，均作为墙：请将要走的那条命名为 path。",
            )
        return len(free) > 1

    def _lay_out(self, units: Coordinates | None) -> None:
        """Turn degrees into metres."""
        points = np.array([point for one in self.features for ring in one.rings for point in ring])
        if not np.isfinite(points).all():
            raise InvalidValue("file", "must have finite coordinates")
        degrees = self.drawing.degrees if units is None else units == "degrees"
        if degrees is None:
            degrees = bool(np.ptp(points, axis=0).max() < DEGREES_ACROSS and (np.abs(points) <= 180.0).all())
        if not degrees:
            self._note("Coordinates are in metres.", "坐标以米为单位。")
            return
        if (np.abs(points) > (180.0, 90.0)).any():
            seems = ": longitude and latitude seem to be swapped" if (np.abs(points[:, 0]) <= 90.0).all() else ""
            raise InvalidValue("file", f"must have longitudes within 180 and latitudes within 90 degrees{seems}")
        near = float(points[0, 0])
        self.features = [
            replace(one, rings=tuple(unwrapped(ring, near) for ring in one.rings)) for one in self.features
        ]
        middle = next((one.rings for one in self.features if one.role == SQUARE), None)
        rings = [ring for one in self.features for ring in one.rings]
        self.origin = self.origin or middle_of(list(middle[:1]) if middle else rings)
        refuse_wide("file", rings, self.origin)
        plane = Plane(self.origin)
        self.features = [one.moved(plane.metres) for one in self.features]
        east, north = self.origin.longitude, self.origin.latitude
        self._note(
            f"Longitude and latitude were converted to metres around {east:.6f}, {north:.6f}: x to the east, y to the "
            "north.",
            f"经纬度以 {east:.6f}, {north:.6f} 为原点换算为米：x 向东，y 向北。",
        )

    def _note(self, english: str, chinese: str) -> None:
        self.notes.append(self.say(english, chinese))

    def _square(self) -> MapFeature | None:
        """The square: the polygon with that role, else the one that holds a part of everything else."""
        polygons = [one for one in self.features if one.shape == "polygon"]
        told = next((one for one in polygons if one.role == SQUARE), None)
        free = [one for one in polygons if one.role is None]
        if told or not free:
            return told
        largest = max(free, key=area_of)
        others = (one for one in self.features if one is not largest)
        return largest if all(any(holds(largest.rings, point) for point in one.rings[0]) for one in others) else None

    def _things(self, square: MapFeature | None, others: list[MapFeature]) -> list[MapFeature]:
        """The square and the obstacles."""
        obstacles = [self._obstacle(one) for one in others]
        for radius, without in self.assumed.items():
            listed = ", ".join(without[:NAMED]) + (", …" if len(without) > NAMED else "")
            english = f"{counted(len(without), 'thing')} without a radius; {radius:g} m is assumed: {listed}."
            self._note(english, f"{len(without)} 个图形没有给出半径，取 {radius:g} m：{listed}。")
        if square is None:
            if not obstacles:
                return []
            points = np.array([point for one in self.features for ring in one.rings for point in ring])
            (left, low), (right, high) = (points.min(axis=0) - AROUND).tolist(), (points.max(axis=0) + AROUND).tolist()
            outline = ((left, low), (right, low), (right, high), (left, high), (left, low))
            square = MapFeature("polygon", (outline,), "square")
            self._note(
                f"No polygon is the square, so it ends {AROUND:g} m beyond everything. Name one `square`.",
                f"没有多边形是广场：取所有图形外 {AROUND:g} m 为界。请将其中一个命名为 square。",
            )
        names = _Names()
        square = replace(square, name=names.new(square.name or "square"), radius=None)
        named = (replace(one, name=names.new(one.name or f"obstacle {k}")) for k, one in enumerate(obstacles, start=1))
        return [square, *named]

    def _obstacle(self, one: MapFeature) -> MapFeature:
        """An obstacle, with a radius if it is a point or a line."""
        name = one.name or one.role or one.shape
        if one.shape == "polygon":
            return replace(one, radius=None)
        radius = one.radius
        if radius is None or not 0.0 < radius < math.inf:
            radius = POINT_RADIUS if one.shape == "point" else LINE_RADIUS
            self.assumed.setdefault(radius, []).append(name)
        return replace(one, radius=radius)

    def _path(self, line: MapFeature) -> Mapping[str, Any]:
        points = np.array(line.rings[0])
        told = self.drawing.path
        if told is not None:
            if _is_along(told, points):
                return told
            self._note(
                "The line of the path was edited, so the new path goes through the points of the line.",
                "路径的线已被移动，因此路径改为通过其各点。",
            )
        kept, name = _thinned(points), line.name or self.say("a line without a name", "未命名的线")
        if len(kept) < 2:
            apart = Quantity(POINTS_APART, "m")
            raise InvalidValue("file", "must hold a path with at least two points {apart} apart", apart=apart)
        self._note(
            f"The path is a smooth curve through {len(kept)} points: {name}.",
            f"路径是通过 {len(kept)} 个点的光滑曲线：{name}。",
        )
        path = {"kind": "waypoints", "points": kept.tolist()}
        checked_path(path)
        return path


class _Names:
    """Names of areas, each unique and valid in a venue."""

    def __init__(self) -> None:
        self.given: set[str] = set()

    def new(self, name: str) -> str:
        plain = "".join(" " if category(one) in NOT_PLAIN else one for one in name)[: NAME_MAX - 8].strip() or "area"
        found, k = plain, 2
        while found in self.given:
            found, k = f"{plain} {k}", k + 1
        self.given.add(found)
        return found


def _closed(feature: MapFeature) -> MapFeature:
    """The same feature with closed rings, because some programs leave out the last point of a polygon."""
    if feature.shape != "polygon":
        return feature
    rings = tuple(ring if ring[0] == ring[-1] else (*ring, ring[0]) for ring in feature.rings if ring)
    return replace(feature, rings=rings)


def _length(line: MapFeature) -> float:
    return sum(math.dist(a, b) for a, b in pairwise(line.rings[0]))


def _thinned(points: Floats) -> Floats:
    """Points that are far enough apart, evenly along the line, and at most as many as a path may have."""
    kept = [points[0]]
    for point in points[1:]:
        if np.hypot(*(point - kept[-1])) >= POINTS_APART:
            kept.append(point)
    if len(kept) <= POINTS_MAX:
        return np.array(kept)
    few: Floats = np.array(kept)[np.linspace(0, len(kept) - 1, POINTS_MAX).round().astype(int)]
    return few


def _is_along(told: Mapping[str, Any], points: Floats) -> bool:
    """True if the line still follows the path that is stored with it."""
    try:
        path = checked_path(told)
    except InvalidValue:
        return False
    drawn = line_of(path, path.drawn_begin(points), path.end)
    begins, along = drawn[:-1], np.diff(drawn, axis=0)
    ends = np.hypot(*(points[[0, -1]] - drawn[[0, -1]]).T)
    for point in points[:: len(points) // TRIED + 1]:
        share = np.clip(((point - begins) * along).sum(axis=1) / (along**2).sum(axis=1), 0.0, 1.0)
        if np.hypot(*(begins + share[:, None] * along - point).T).min() > MOVED:
            return False
    return bool(ends.max() <= MOVED)
