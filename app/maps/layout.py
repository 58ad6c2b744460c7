"""The venue and the path in a map, in metres, with the assumptions made."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from app.maps.choice import EVERYTHING, Choice
from app.maps.dance_parts import DanceParts, checked_venue, refuse_many_edges
from app.maps.features import (
    LINE_RADIUS,
    MARK,
    PATH,
    POINT_RADIUS,
    Drawing,
    MapFeature,
    Unit,
    area_of,
    holds_any,
    is_aside,
    kind_of,
    points_in,
    round_area,
    word_of,
)
from app.maps.lines import POINTS_APART, checked_path, is_along, length_of, thinned
from app.maps.tracks import APART, CHORD, walk_of
from app.wire.degrees import ACROSS_MAX, GRID_MAX, TURN, GeographicOrigin, Plane, middle_of, refuse_wide, unwrapped
from app.wire.fields import Coordinates
from app.wire.geojson import ASIDES, LANE, LANE_MAX, LANE_MIN, LANE_RADIUS, SQUARE
from app.wire.parts import is_cut, merged, whole_areas
from core import Dragon, InvalidValue
from core.checks import COORDINATE_MAX, SIZE_MIN
from core.language import Listed, counted, phrase, say
from core.names import NAME_MAX, is_printable
from core.quantities import Quantity, quantities
from core.shapes.engines import strip_of
from core.values import Floats

# Length that a path has less than its track from which on a note says so [m].
LOST = 0.5
# Largest number of things that a note names; a list of more ends in dots.
LISTED_MOST = 5
# Least share of the narrowest rectangle around it that an area has whose middle line is that of the rectangle.
STRIP_SHARE = 0.95
# Reason of a refusal of numbers that were taken for degrees.
GUESSED = phrase("its numbers look like degrees") + "; " + phrase("if they are metres, give the units metres")
# Free ground around everything drawn, if no polygon is the square [m].
AROUND = 20.0
# A map narrower than the longest bench is in degrees, if its numbers allow it: 350 km in degrees, only 3 m in metres. A
# request refuses metres by the same rule.
DEGREES_ACROSS = float(Dragon().lengths.max())


# State:  `drawing`, in degrees or metres; from it `features`, in metres and without marks, and `origin`.
class Reading:
    """Reads a venue and a path from a map, and notes its assumptions."""

    def __init__(
        self,
        drawing: Drawing,
        units: Coordinates | None,
        chord: float = CHORD,
        choice: Choice = EVERYTHING,
    ) -> None:
        """choice: its area is read, in metres as they are in the file, or around the middle of a map in degrees"""
        self.drawing, self.chord, self.notes, self.choice = drawing, chord, list[str](), choice
        self.assumed = dict[float, list[MapFeature]]()
        every = [one for one in drawing.features if one.role != MARK and any(one.rings)]
        self.features = [_closed(_with_role(one)) for one in every]
        if not self.features:
            raise _nothing_in(drawing) if choice.area is None else _nothing_reaches()
        self.origin, self.grid = drawing.origin, drawing.grid
        self.passages: Sequence[Mapping[str, Any]] | None = None
        self._lay_out(units)
        self.features = self._lanes()
        self.asides = [one for one in self.features if is_aside(one)]
        self.features = [one for one in self.features if not is_aside(one)]
        self._leave_out_small()
        self.features = [self._whole(one) for one in self.features]
        for kind, count in drawing.left_out.items():
            self.remark_on(count, "Left out: {count} {kind}.", "Left out: {count} {kind}s.", kind=word_of(kind))
        for kind, count in drawing.hidden.items():
            self.remark_on(
                count,
                "Left out, because hidden: {count} {kind}.",
                "Left out, because hidden: {count} {kind}s.",
                kind=word_of(kind),
            )

    def _lanes(self) -> list[MapFeature]:
        """The features, each lane as its middle line with a width; one that is an area of another shape is left out."""
        features, others = list[MapFeature](), list[MapFeature]()
        for one in self.features:
            if one.role != LANE:
                features.append(one)
            elif one.shape == "line" and len(set(one.rings[0])) > 1:
                known = one.radius is not None and LANE_MIN <= one.radius <= LANE_MAX
                features.append(one if known else replace(one, radius=LANE_RADIUS))
            elif one.shape == "polygon" and (strip := strip_of(np.array(one.rings[0]), STRIP_SHARE)) is not None:
                (a, b), width = strip
                middle = (float(a[0]), float(a[1])), (float(b[0]), float(b[1]))
                radius = min(max(0.5 * width, LANE_MIN), LANE_MAX)
                features.append(replace(one, shape="line", rings=(middle,), radius=radius))
            else:
                others.append(one)
        self.remark_on(
            len(others),
            "Left out: {count} emergency lane that is neither a line nor a rectangle: {names}.",
            "Left out: {count} emergency lanes that are neither lines nor rectangles: {names}.",
            names=_listed(others),
        )
        return features

    def parts(self) -> DanceParts:
        # Before anything is compared with every edge.
        refuse_many_edges(self.features, of_areas=True)
        lines = [one for one in self.features if one.shape == "line"]
        square = self._square()
        # A track that was walked is a path; the longest one is danced, unless a line is called path.
        path_lines = [one for one in lines if one.role == PATH]
        tracks = [one for one in lines if one.times is not None and one.role != PATH]
        paths = [*path_lines, *sorted(tracks, key=length_of, reverse=True)]
        # If no line has the role of the path, it is the longest line without a width; one of some centimetres is none.
        free = [one for one in lines if one.role is None and one.radius is None and _is_long(one)]
        danced = paths[:1] or ([max(free, key=length_of)] if free and not self._walls(free) else [])
        path = self._path(danced[0]) if danced else None
        if more := paths[1:]:
            if len(path_lines) == len(paths):
                self.remark(
                    "{count} lines are called path; the first is the path, and the others are left out.",
                    count=len(paths),
                )
            else:
                name = danced[0].name or say("track")
                self.remark(
                    "{count} lines are paths or tracks; one of them is the path: {name}.", count=len(paths), name=name
                )
        taken = [*danced, *more]
        others = [one for one in self.features if one is not square and not any(one is line for line in taken)]
        things = self._things(square, others)
        venue = checked_venue(things) if things else None
        things += self.asides if things else []
        if venue is not None:
            self._warn_of_small(np.array(venue.square.rings[0]))
        return DanceParts(path, venue, self.origin, None, self.notes, things, self.grid, self.passages)

    def _walls(self, free: list[MapFeature]) -> bool:
        """True if lines without a role are walls: there are several, so none of them is clearly the path."""
        if len(free) > 1:
            self.remark(
                "{free_count} lines have no role, so they are walls. Give the line of the dance the name `path`.",
                free_count=len(free),
            )
        return len(free) > 1

    def _lay_out(self, units: Coordinates | None) -> None:
        """Turn degrees into metres."""
        points = np.array(points_in(self.features))
        if not np.isfinite(points).all():
            raise InvalidValue("file", "must have finite coordinates")
        unit = self.drawing.unit
        guessed = units is None and unit is Unit.UNKNOWN
        if units is not None:
            unit = Unit.DEGREES if units == "degrees" else Unit.METRES
        elif guessed:
            unit = Unit.DEGREES if _look_like_degrees(points) else Unit.METRES
        if unit is not Unit.DEGREES:
            if unit is Unit.ASSUMED_METRES:
                self.remark("The file states no unit: its numbers are metres.")
            else:
                self.remark("Coordinates are in metres.")
            self._choose()
            self._leave_grid(np.array(points_in(self.features)))
            return
        if (np.abs(points) > (TURN, 90.0)).any():
            rule = "must have longitudes within 360 and latitudes within 90 degrees"
            if (np.abs(points[:, 0]) <= 90.0).all():
                rule = f"{rule}: longitude and latitude seem to be swapped"
            raise InvalidValue("file", rule)
        near = float(points[0, 0])
        self.features = [
            replace(one, rings=tuple(unwrapped(ring, near) for ring in one.rings)) for one in self.features
        ]
        # A square may be drawn in several parts.
        squares = [one.rings[0] for one in self.features if one.role == SQUARE]
        rings = [ring for one in self.features for ring in one.rings]
        self.origin = self.origin or middle_of(squares or rings)
        try:
            refuse_wide("file", rings, self.origin)
        except InvalidValue as error:
            raise error.because(GUESSED) if guessed else error from None
        plane = Plane(self.origin)
        if abs(self.origin.longitude) > 180.0:
            self.origin = GeographicOrigin((self.origin.longitude + 180.0) % 360.0 - 180.0, self.origin.latitude)
        # Parts of a square are joined later, wherever they meet.
        areas = [one.shape == "polygon" and one.role != SQUARE and is_cut(one.rings) for one in self.features]
        kinds = [(one.name, one.role) if cut else None for one, cut in zip(self.features, areas, strict=True)]
        moved = [one.moved(plane.metres) for one in self.features]
        whole = whole_areas([one.rings for one in moved], kinds)
        self.features = [replace(one, rings=rings) for one, rings in zip(moved, whole, strict=True) if rings]
        self._choose()
        east, north = self.origin.longitude, self.origin.latitude
        self.remark(
            "Longitude and latitude were converted to metres around {east:.6f}, {north:.6f}: x to the east, "
            "y to the north.",
            east=east,
            north=north,
        )

    def _choose(self) -> None:
        """Leave out what does not reach into the chosen area."""
        self.features = [one for one in self.features if self.choice.reaches(points_in([one]))]
        if not self.features:
            raise _nothing_reaches()

    def _warn_of_small(self, square: Floats) -> None:
        """Note a square that a request refuses, because its numbers may be degrees."""
        width, height = np.ptp(square, axis=0).tolist()
        if max(width, height) < DEGREES_ACROSS and np.abs(square).max() <= TURN:
            longest = f"{DEGREES_ACROSS:g} m"
            self.remark(
                "The square is {width:.3g} m by {height:.3g} m, narrower than a bench of {longest}: check refuses it.",
                width=width,
                height=height,
                longest=longest,
            )

    def _leave_grid(self, points: Floats) -> None:
        """Move a map with the coordinates of a survey grid to x = y = 0."""
        if self.drawing.grid is None:
            if np.abs(points).max() <= COORDINATE_MAX:
                return
            middle = next((np.array(one.rings[0]) for one in self.features if one.role == SQUARE), points)
            x, y = np.round(0.5 * (middle.min(axis=0) + middle.max(axis=0))).tolist()
            if max(abs(x), abs(y)) > GRID_MAX:
                got, most = Quantity(max(abs(x), abs(y)), "m", 6), Quantity(GRID_MAX, "m")
                raise InvalidValue("file", "must have coordinates of at most {most}", got=got, most=most)
            self.grid = (x, y)
        assert self.grid is not None
        x, y = self.grid
        across = float(np.ptp(points, axis=0).max())
        if across > ACROSS_MAX:
            values = quantities("km", 6, most=ACROSS_MAX / 1000.0) | quantities("km", 4, across=across / 1000.0)
            raise InvalidValue("file", "must be at most {most} across, got about {across}", **values)
        moved = np.array(self.grid)
        self.features = [one.moved(lambda places: places - moved) for one in self.features]
        self.remark(
            "The coordinates are those of a survey grid; x = y = 0 is its x {x:.10g} m, y {y:.10g} m.",
            x=x,
            y=y,
        )

    def _leave_out_small(self) -> None:
        """Leave out what is smaller than anything of a venue, and name it; the only square or path stays."""
        circles = [one for one in self.features if one.shape == "point" and _is_thin(one)]
        others = [one for one in self.features if _is_tiny(one)]
        left_out = {id(one) for one in (*circles, *others)}
        large = {one.role for one in self.features if id(one) not in left_out}
        others = [one for one in others if one.role not in (PATH, SQUARE) or one.role in large]
        left_out = {id(one) for one in (*circles, *others)}
        self.features = [one for one in self.features if id(one) not in left_out]
        self.remark_on(
            len(circles),
            "Left out: {count} circle with a radius of less than {least:g} m: {names}.",
            "Left out: {count} circles with a radius of less than {least:g} m: {names}.",
            least=SIZE_MIN,
            names=_listed(circles),
        )
        self.remark_on(
            len(others),
            "Left out: {count} shape of less than {least:g} m: {names}.",
            "Left out: {count} shapes of less than {least:g} m: {names}.",
            least=SIZE_MIN,
            names=_listed(others),
        )

    def _whole(self, one: MapFeature) -> MapFeature:
        """The same feature; a square that is a circle, or a line that is not closed, is a polygon."""
        if one.role != SQUARE or one.shape == "polygon":
            return one
        if one.shape == "point":
            return round_area(one)
        if one.radius is not None or len(one.rings[0]) < 3:
            return one
        self.remark("The line of the square does not end where it begins, so it was closed by a straight side.")
        return replace(one, shape="polygon", rings=((*one.rings[0], one.rings[0][0]),))

    def remark(self, template: str, /, **values: Any) -> None:
        """Note what was assumed or left out: a template in the language, with its values."""
        self.notes.append(say(template, **values))

    def remark_on(self, count: int, template: str, templates: str, /, **values: Any) -> None:
        """Note a number of things, if there are any; as counted()."""
        if count:
            self.notes.append(counted(count, template, templates, **values))

    def _square(self) -> MapFeature | None:
        """The square: the polygon with that role, else the one that holds a part of everything else."""
        polygons = [one for one in self.features if one.shape == "polygon"]
        squares = [one for one in polygons if one.role == SQUARE]
        first = next(iter(squares), None)
        if len(squares) > 1 and (rings := merged([one.rings for one in squares])) is not None:
            whole = replace(squares[0], rings=rings)
            self.remark(
                "The square is drawn in {square_count} parts that share edges.",
                square_count=len(squares),
            )
            self.features = [whole, *(one for one in self.features if not any(one is part for part in squares))]
            return whole
        if len(squares) > 1:
            self.remark(
                "{square_count} areas are called square; the first is the square, and the others are obstacles.",
                square_count=len(squares),
            )
        free = [one for one in polygons if one.role is None]
        if first or not free:
            return first
        largest = max(free, key=area_of)
        # The edge of a wide outline lies on the outline itself.
        others = (one for one in self.features if one.rings[0] != largest.rings[0])
        return largest if all(holds_any(largest.rings, one.rings[0]) for one in others) else None

    def _things(self, square: MapFeature | None, others: list[MapFeature]) -> list[MapFeature]:
        """The square and the obstacles."""
        obstacles = [self._obstacle(one) for one in others]
        for radius, without in self.assumed.items():
            self.remark_on(
                len(without),
                "{count} thing without a radius; {radius:g} m is assumed: {names}.",
                "{count} things without a radius; {radius:g} m is assumed: {names}.",
                radius=radius,
                names=_listed(without),
            )
        if square is None:
            if not obstacles:
                return []
            points = np.array(points_in(self.features))
            (left, low), (right, high) = (points.min(axis=0) - AROUND).tolist(), (points.max(axis=0) + AROUND).tolist()
            outline = ((left, low), (right, low), (right, high), (left, high), (left, low))
            square = MapFeature("polygon", (outline,), "square")
            self.remark(
                "No polygon is the square, so it ends {AROUND:g} m beyond everything. Name one `square`.",
                AROUND=AROUND,
            )
        names = _Names()
        square = replace(square, name=names.new(square.name or "square"), radius=None)
        things = (
            replace(one, name=names.new(one.name or say("obstacle {k}", k=k)))
            for k, one in enumerate(obstacles, start=1)
        )
        return [square, *things]

    def _obstacle(self, one: MapFeature) -> MapFeature:
        """An obstacle, with a radius if it is a point or a line."""
        if one.shape == "polygon":
            return replace(one, radius=None)
        radius = one.radius
        if radius is None or not 0.0 < radius < math.inf:
            radius = POINT_RADIUS if one.shape == "point" else LINE_RADIUS
            self.assumed.setdefault(radius, []).append(one)
        return replace(one, radius=radius)

    def _path(self, line: MapFeature) -> Mapping[str, Any]:
        points = np.array(line.rings[0])
        stored = self.drawing.path
        if stored is not None:
            if is_along(stored, points):
                return stored
            self.remark("The line of the path was edited, so the new path goes through the points of the line.")
        if line.times is not None:
            return self._walked(line)
        (kept, off), name = thinned(points), line.name or say("a line without a name")
        if len(kept) < 2:
            apart = Quantity(POINTS_APART, "m")
            raise InvalidValue("file", "must hold a path with at least two points {apart} apart", apart=apart)
        self.remark(
            "The path is a smooth curve through {kept_count} points: {name}.",
            kept_count=len(kept),
            name=name,
        )
        if off > 0.0:
            self.remark(
                "Of its {point_count} points the others are at most {off:.2f} m from the lines between these.",
                point_count=len(points),
                off=off,
            )
        path = {"kind": "waypoints", "points": kept.tolist()}
        checked_path(path)
        return path

    def _walked(self, line: MapFeature) -> Mapping[str, Any]:
        """The path along a track, with a note on how far it is from what was walked."""
        points, times = np.array(line.rings[0]), np.array(line.times)
        walk = walk_of(points, times, self.chord)
        name = line.name or say("a track without a name")
        if walk is None:
            length = Quantity(APART, "m")
            raise InvalidValue("file", "must hold a track with points at least {length} apart", length=length)
        self.passages = walk.passages
        self.remark(
            "The path is a smooth curve along the track {name}, {walk.length:.0f} m long, at most {walk.largest:.2f} m "
            "from what was walked.",
            name=name,
            walk=walk,
        )
        if walk.lost >= LOST:
            self.remark("It is {walk.lost:.1f} m shorter than the track.", walk=walk)
        if not walk.is_easy:
            self.remark(
                "Some bends stay tighter than {walk.radius:.1f} m, which a bench needs whose handles are "
                "{chord:.2f} m apart.",
                walk=walk,
                chord=self.chord,
            )
        if walk.passages is None:
            self.remark("The track has no times that grow.")
        else:
            until = walk.passages[-1]["until_time"]
            self.remark("It was walked in {until:.0f} s.", until=until)
        checked_path(walk.path)
        return walk.path


def _listed(things: Sequence[MapFeature]) -> str:
    """The names of the first things, and dots for more."""
    names = [one.name or kind_of(one) for one in things]
    return str(Listed([*names[:LISTED_MOST], *(["…"] if len(names) > LISTED_MOST else [])]))


def _is_thin(one: MapFeature) -> bool:
    """True for a radius that is too small for anything of a venue."""
    return one.radius is not None and one.radius < SIZE_MIN


def _is_tiny(one: MapFeature) -> bool:
    """True for a wall as good as without a width, and for a line without one and a polygon, all of whose points are as
    good as one."""
    if one.shape == "line" and one.role != PATH and _is_thin(one):
        return True
    if one.shape == "point" or one.radius is not None or one.times is not None:
        return False
    return bool(np.hypot(*np.ptp(np.array(one.rings[0]), axis=0)) < SIZE_MIN)


def _is_long(line: MapFeature) -> bool:
    """True for a line that may be a path."""
    return len(thinned(np.array(line.rings[0]))[0]) > 1


def _nothing_reaches() -> InvalidValue:
    """The refusal of an area of a map in which nothing is drawn."""
    return InvalidValue("area", "must be one into which something reaches")


def _nothing_in(drawing: Drawing) -> InvalidValue:
    """The refusal of a map in which nothing is drawn that can be seen."""
    count = sum(drawing.hidden.values())
    if not count:
        return InvalidValue("file", "must hold a polygon, a line or a point", got="none of these")
    hidden = Listed(
        counted(each, "{count} {kind}", "{count} {kind}s", kind=word_of(kind)) for kind, each in drawing.hidden.items()
    )
    if drawing.unit is Unit.DEGREES:  # KML, which has no layers
        why = "{hidden} is hidden; make it visible" if count == 1 else "{hidden} are hidden; make them visible"
        rule = f"must hold a polygon, a line or a point that is visible: {why}"
    else:
        why = (
            "{hidden} is hidden; show it or its layer"
            if count == 1
            else "{hidden} are hidden; show them or their layers"
        )
        rule = f"must show a polygon, a line or a point: {why}"
    return InvalidValue("file", rule, hidden=hidden)


def _look_like_degrees(points: Floats) -> bool:
    """True if coordinates are within the limits of degrees and too near to one another for metres."""
    east = np.abs(points[:, 0])
    if east.max() > 180.0 and (np.abs(points[:, 1]).max() > 90.0 or east.max() > TURN or not np.ptp(points[:, 0])):
        return False
    if (np.abs(points[:, 1]) > 180.0).any() or (np.abs(points) > 90.0).all(axis=1).any():
        return False
    near = np.array(unwrapped(tuple(map(tuple, points.tolist())), float(points[0, 0])))
    return bool(np.ptp(near, axis=0).max() < DEGREES_ACROSS)


class _Names:
    """Names of areas, each unique and valid in a venue."""

    def __init__(self) -> None:
        self.used: set[str] = set()

    def new(self, name: str) -> str:
        bare = "".join(one if is_printable(one) else " " for one in name)[: NAME_MAX - 8].strip() or "area"
        unique, k = bare, 2
        while unique in self.used:
            unique, k = f"{bare} {k}", k + 1
        self.used.add(unique)
        return unique


def _with_role(feature: MapFeature) -> MapFeature:
    """The same feature; one that is called a gate and is none in its shape has no role. Lanes have any shape here."""
    if feature.role == LANE or is_aside(feature) or feature.role not in ASIDES:
        return feature
    return replace(feature, role=None)


def _closed(feature: MapFeature) -> MapFeature:
    """The same feature with closed rings, because some programs leave out the last point of a polygon."""
    if feature.shape != "polygon":
        return feature
    rings = tuple(ring if ring[0] == ring[-1] else (*ring, ring[0]) for ring in feature.rings if ring)
    return replace(feature, rings=rings)
