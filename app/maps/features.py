"""The content of a map in any format: points, lines and polygons with a name, a role and a radius."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass, field, replace
from enum import Enum, auto
from itertools import pairwise
from typing import Any, Literal

import numpy as np

from app.wire.degrees import GRID_MAX, GeographicOrigin
from app.wire.geojson import GATE, INNER_SQUARE, LANE, SQUARE, TREE_SIDES, Aside, Thing, outlined
from core import InvalidValue
from core.language import phrase, say, sense
from core.quantities import Clause, say_value
from core.values import Floats, Point
from core.venue import Ring

Shape = Literal["point", "line", "polygon"]
# Roles of features in a dance; any other role counts as none.
OBSTACLE, PATH, MARK = "obstacle", "path", "mark"
# Words that give a feature its role: as its property, its folder, its layer or its name.
WORDS = {
    SQUARE: ("square", "area", "venue", "ground", "广场", "场地"),
    OBSTACLE: ("obstacle", "obstacles", "tree", "trees", "wall", "walls", "building", "buildings", "障碍", "障碍物"),
    PATH: ("path", "route", "track", "路线", "路径"),
    MARK: ("mark", "marks", "chalk", "粉笔标记"),
    GATE: (GATE, "gates", "出入口"),
    INNER_SQUARE: (INNER_SQUARE,),
    LANE: (LANE, "emergency lanes", "fire lane", "fire lanes", "消防通道", "应急通道", "救护通道"),
}
ROLES = {word: role for role, words in WORDS.items() for word in words}
# Most points and most features of one map; a plan of a square has fewer.
POINTS_MAX, FEATURES_MAX = 100_000, 10_000
# Most of either in a drawing whose layers are counted: 100 MB.
COUNTED_MAX = 1_000_000
# Largest distance of a round square from the polygon in its place, and its largest radius [m].
ROUND, ROUND_MAX = 0.005, 1e5
# Radius of a point, and half of the width of a line, without a radius [m].
POINT_RADIUS, LINE_RADIUS = 0.5, 0.1
# Least sides of the outline of one point, and those of a line between two.
SIDES = (TREE_SIDES, 34)
# Advice for a map that is too large.
LEAVE_OUT = phrase("leave out everything that does not belong to the square")


def role_of(*words: object) -> str | None:
    """Role given by the first of these words that gives one; None without one.

    >>> role_of(None, "Trees"), role_of("my house")
    ('obstacle', None)
    """
    roles = (ROLES.get(word.strip().lower()) for word in words if isinstance(word, str))
    return next((role for role in roles if role), None)


@dataclass(frozen=True, slots=True)
class MapFeature:
    """One thing on a map.

    rings: the point alone, the points of a line, or the closed rings of a polygon, the outer one first
    radius: of a round thing, or half of the width of a line [m]
    times: of the points of a line that was walked [s], NaN where unknown; None for any other line
    """

    shape: Shape
    rings: tuple[Ring, ...]
    name: str | None = None
    role: str | None = None
    radius: float | None = None
    properties: Mapping[str, object] = field(default_factory=dict)
    times: tuple[float, ...] | None = None

    def moved(self, move: Callable[[Floats], Floats]) -> MapFeature:
        """The same feature elsewhere. move: function of points (N, 2)"""
        return replace(self, rings=tuple(tuple(map(tuple, move(np.array(ring)).tolist())) for ring in self.rings))


def points_in(features: Iterable[MapFeature]) -> list[Point]:
    """All points of features."""
    return [point for one in features for ring in one.rings for point in ring]


class Unit(Enum):
    """Unit of the coordinates in a file."""

    METRES = auto()
    DEGREES = auto()
    # The file does not say it, and its form has no degrees.
    ASSUMED_METRES = auto()
    # The file does not say it: the numbers may.
    UNKNOWN = auto()


@dataclass(frozen=True, slots=True)
class Drawing:
    """A map as it stands in its file.

    unit: of its coordinates, which are unchanged unless the file says the unit
    origin: place of x = y = 0, if the file gives it
    path: the path as a request describes it, if this program wrote the file
    left_out, hidden: kinds of things that were not read, or that cannot be seen, and their numbers
    grid: coordinates in the file of what is x = y = 0 in `path` [m]
    """

    features: tuple[MapFeature, ...]
    unit: Unit
    origin: GeographicOrigin | None = None
    path: Mapping[str, object] | None = None
    left_out: Mapping[str, int] = field(default_factory=dict)
    hidden: Mapping[str, int] = field(default_factory=dict)
    grid: Point | None = None


def origin_of(stated: object) -> GeographicOrigin | None:
    """The place of x = y = 0 in a file's own words; None if it gives none."""
    values = _numbers(stated, ("longitude", "latitude"), (180.0, 90.0))
    return None if values is None else GeographicOrigin(*values)


def grid_of(stated: object) -> Point | None:
    """The place of x = y = 0 on a survey grid, in a file's own words; None if it gives none."""
    return _numbers(stated, ("x", "y"), (GRID_MAX, GRID_MAX))


def place_fields(origin: GeographicOrigin | None = None, grid: Point | None = None) -> dict[str, Any]:
    """The places that origin_of() and grid_of() read, by their names in a file, as far as they are known."""
    places = {"origin": origin and asdict(origin), "grid": grid and dict(zip("xy", grid, strict=True))}
    return {name: place for name, place in places.items() if place}


def _numbers(stated: object, names: tuple[str, str], most: tuple[float, float]) -> tuple[float, float] | None:
    values = [stated.get(name) for name in names] if isinstance(stated, Mapping) else [None]
    if not all(isinstance(one, (int, float)) and not isinstance(one, bool) for one in values):
        return None
    x, y = map(float, values)  # type: ignore[arg-type]
    return (x, y) if abs(x) <= most[0] and abs(y) <= most[1] else None


class FeatureCollector:
    """Collector of features, with the limits of a map; to count what a drawing has, with a larger one of points."""

    def __init__(self, *, is_limited: bool = True) -> None:
        self.most = (FEATURES_MAX, POINTS_MAX) if is_limited else (COUNTED_MAX, COUNTED_MAX)
        self.features: list[MapFeature] = []
        self.left_out, self.hidden = Counter[str](), Counter[str]()
        self._points = 0

    def add(self, feature: MapFeature) -> None:
        """raises: InvalidValue when there are too many"""
        self._points += sum(map(len, feature.rings))
        self.features.append(feature)
        features, points = self.most
        if self._points > points or len(self.features) > features:
            rule = f"must hold at most {{features}} features with {{points}} points in all: {LEAVE_OUT}"
            raise InvalidValue("file", rule, got="more", features=features, points=points)

    def leave_out(self, kind: str) -> None:
        self.left_out[kind] += 1

    def hide(self, kind: str) -> None:
        self.hidden[kind] += 1

    def drawing(self, unit: Unit, stored: Mapping[str, object] | None = None) -> Drawing:
        """The map of these features. stored: what this program wrote into the file: path, origin and grid"""
        path, origin, grid = map((stored or {}).get, ("path", "origin", "grid"))
        return Drawing(
            tuple(self.features),
            unit,
            origin_of(origin),
            path if isinstance(path, Mapping) else None,
            self.left_out,
            self.hidden,
            grid_of(grid),
        )


def damaged_kind(kind: str) -> Clause:
    """What was left out because it cannot be read."""
    return Clause("damaged {kind}", kind=kind)


def empty_kind(kind: str) -> Clause:
    """What was left out because it has no points."""
    return Clause("empty {kind}", kind=kind)


def kind_of(one: MapFeature) -> str:
    """A word for a thing without a name: its role, or else its shape."""
    words = {
        SQUARE: say("square"),
        OBSTACLE: say("obstacle"),
        PATH: say("path"),
        GATE: say("gate"),
        INNER_SQUARE: say("square without streets"),
        LANE: say("emergency lane"),
    }
    if not one.role and one.shape == "point" and one.radius is not None:
        return sense("shape", "circle")
    return words[one.role] if one.role else word_of(one.shape)


def word_of(kind: str) -> str:
    """A word for a shape, or for what a format calls a kind of thing."""
    words = {
        "point": sense("shape", "point"),
        "line": sense("shape", "line"),
        "polygon": sense("shape", "polygon"),
    }
    return words.get(kind) or say_value(kind)


def drawn_as(line: MapFeature) -> MapFeature:
    """The feature of a line; if it ends at its beginning, the polygon inside it, unless it is a path or has a width."""
    (points,) = line.rings
    is_area = line.role not in (PATH, INNER_SQUARE) and line.radius is None
    closed = len(points) > 3 and points[0] == points[-1] and is_area
    return replace(line, shape="polygon" if closed else "line")


def round_area(circle: MapFeature) -> MapFeature:
    """The polygon in a circle: its corners are on the circle, and its sides at most ROUND inside of it."""
    radius = circle.radius or 0.0
    if not 0.0 < radius <= ROUND_MAX:
        return circle
    count = max(12, math.ceil(2.0 * math.pi * math.sqrt(radius / (8.0 * ROUND))))
    ((x, y),) = circle.rings[0]
    angles = (2.0 * math.pi * k / count for k in range(count))
    ring = tuple((x + radius * math.cos(angle), y + radius * math.sin(angle)) for angle in angles)
    return replace(circle, shape="polygon", rings=((*ring, ring[0]),), radius=None)


def features_of(things: Sequence[Thing]) -> list[MapFeature]:
    """The things of a venue as features, the square first."""
    return [
        MapFeature(*_form(rings, radius), name, OBSTACLE if k else SQUARE, radius)
        for k, (name, rings, radius) in enumerate(things)
    ]


def aside_features(asides: Sequence[Aside]) -> list[MapFeature]:
    """The gates, the lanes, and the square without streets, as features."""
    return [
        MapFeature(
            "point" if one.role == GATE else "line",
            (one.points,),
            one.name,
            one.role,
            one.radius,
            dict(one.own),
        )
        for one in asides
    ]


def edges_of(one: MapFeature) -> int:
    """Edges that a thing has in a venue: the sides of an area, or of the outline of a tree or a wall; a path, a mark, a
    gate, a lane and a square without streets have none."""
    if one.role in (PATH, MARK) or is_aside(one):
        return 0
    if one.shape == "polygon":
        return sum(max(len(ring) - 1, 1) for ring in one.rings)
    points = len(set(one.rings[0]))
    if points <= len(SIDES):  # most of a large drawing
        return SIDES[points - 1]
    radius = LINE_RADIUS if one.radius is None or not 0.0 < one.radius < math.inf else one.radius
    ((_, outline),) = outlined([("", one.rings, radius)])
    return sum(len(ring) - 1 for ring in outline)


def is_aside(one: MapFeature) -> bool:
    """True for a gate, a lane, and the square without streets, in the shapes that aside_features() gives them."""
    if one.role == LANE:
        return one.shape == "line"
    return (one.role, one.shape) in ((GATE, "point"), (INNER_SQUARE, "line")) and one.radius is None


def _form(rings: tuple[Ring, ...], radius: float | None) -> tuple[Shape, tuple[Ring, ...]]:
    if radius is None:
        return "polygon", rings
    return ("line", rings) if len(set(rings[0])) > 1 else ("point", (rings[0][:1],))


def inner_point(rings: tuple[Ring, ...]) -> Point:
    """A point inside a polygon for its name: the middle of its widest part at half of its height."""
    heights = [y for _, y in rings[0]]
    # Slightly beside the middle, because a side may lie exactly on it.
    level = min(heights) + 0.5001 * (max(heights) - min(heights))
    crossings = sorted(_crossings(rings, level))
    pairs = list(zip(crossings[::2], crossings[1::2], strict=True))
    left, right = max(pairs, key=lambda pair: pair[1] - pair[0], default=(rings[0][0][0],) * 2)
    return 0.5 * (left + right), level


def holds(rings: tuple[Ring, ...], point: Point) -> bool:
    """True if a point is inside a polygon and outside its holes.

    >>> holds((((0, 0), (4, 0), (4, 4), (0, 0)),), (3, 1))
    True
    """
    return sum(x > point[0] for x in _crossings(rings, point[1])) % 2 == 1


def holds_any(rings: tuple[Ring, ...], points: Ring) -> bool:
    """True if one of the points is inside a polygon and outside its holes, as holds() has it; for many points."""
    if holds(rings, points[0]):
        return True
    x, y = np.array(points).T
    inside = np.zeros(len(points), dtype=bool)
    for (ax, ay), (bx, by) in (side for ring in rings for side in pairwise(ring)):
        if ay != by:
            inside ^= ((ay > y) != (by > y)) & (ax + (y - ay) / (by - ay) * (bx - ax) > x)
    return bool(inside.any())


def _crossings(rings: tuple[Ring, ...], level: float) -> Iterator[float]:
    """x of every crossing of rings with a level y."""
    for a, b in (side for ring in rings for side in pairwise(ring)):
        if (a[1] > level) != (b[1] > level):
            yield a[0] + (level - a[1]) / (b[1] - a[1]) * (b[0] - a[0])


def area_of(feature: MapFeature) -> float:
    """Area of a polygon without its holes, or of a round thing."""
    if feature.shape == "point":
        return math.pi * (feature.radius or 0.0) ** 2
    return 0.5 * abs(sum(a[0] * b[1] - b[0] * a[1] for a, b in pairwise(feature.rings[0])))
