"""What a map holds, whatever the form of its file: points, lines and polygons with a name, a role and a radius."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from itertools import pairwise
from typing import Literal

from app.wire.degrees import Origin
from core import InvalidValue
from core.venue import Ring

Shape = Literal["point", "line", "polygon"]
# What a feature is in a dance; other roles are taken as none.
SQUARE, OBSTACLE, PATH, MARK = "square", "obstacle", "path", "mark"
# Words that tell a role: as the property or the folder of a feature, as the name of its layer or its own.
WORDS = {
    SQUARE: ("square", "area", "venue", "ground", "广场", "场地"),
    OBSTACLE: ("obstacle", "obstacles", "tree", "trees", "wall", "walls", "building", "buildings", "障碍", "障碍物"),
    PATH: ("path", "route", "track", "路线", "路径"),
    MARK: ("mark", "marks", "chalk", "粉笔标记"),
}
ROLES = {word: role for role, words in WORDS.items() for word in words}
# Most points and most features of one map: more of them are no plan of a square.
POINTS_MAX, FEATURES_MAX = 100_000, 10_000


def role_of(*words: object) -> str | None:
    """The role that the first of these words tells; None if none of them tells one.

    >>> role_of(None, "Trees"), role_of("my house")
    ('obstacle', None)
    """
    told = (ROLES.get(word.strip().lower()) for word in words if isinstance(word, str))
    return next((role for role in told if role), None)


@dataclass(frozen=True, slots=True)
class Feature:
    """One thing on a map.

    rings: the point alone, the points of a line, or the closed rings of a polygon, the outer one first
    radius: of a round thing, or half of the width of a line [m]
    """

    shape: Shape
    rings: tuple[Ring, ...]
    name: str | None = None
    role: str | None = None
    radius: float | None = None
    properties: Mapping[str, object] = field(default_factory=dict)

    def placed(self, rings: tuple[Ring, ...]) -> Feature:
        """The same feature elsewhere."""
        return replace(self, rings=rings)


@dataclass(frozen=True, slots=True)
class Drawing:
    """A map as its file tells it.

    degrees: is it in longitude and latitude? None: its file does not say; then points are as they stand there
    origin: place of x = y = 0, where the file tells it
    path: the path as a request describes it, where this program wrote the file
    left_out: kinds of things that were not read, with how many
    """

    features: tuple[Feature, ...]
    degrees: bool | None
    origin: Origin | None = None
    path: Mapping[str, object] | None = None
    left_out: Mapping[str, int] = field(default_factory=dict)
    notes: tuple[tuple[str, str], ...] = ()


class Counted:
    """Features that are collected, and no more of them than a map may have."""

    def __init__(self) -> None:
        self.features: list[Feature] = []
        self.left_out: dict[str, int] = {}
        self._points = 0

    def add(self, feature: Feature) -> None:
        """raises: InvalidValue when there are too many"""
        self._points += sum(map(len, feature.rings))
        self.features.append(feature)
        if self._points > POINTS_MAX or len(self.features) > FEATURES_MAX:
            words = f"file must hold at most {FEATURES_MAX} features with {POINTS_MAX} points in all, got more"
            raise InvalidValue("file", f"{words}: leave out everything that does not belong to the square")

    def leave_out(self, kind: str) -> None:
        self.left_out[kind] = self.left_out.get(kind, 0) + 1


def shaped(points: Ring) -> tuple[Shape, tuple[Ring, ...]]:
    """A line, or the polygon that it encloses where it ends at its beginning."""
    return ("polygon", (points,)) if len(points) > 3 and points[0] == points[-1] else ("line", (points,))


def inner_point(rings: tuple[Ring, ...]) -> tuple[float, float]:
    """A point inside a polygon: the middle of its widest stretch at half of its height, for words and names."""
    heights = [y for _, y in rings[0]]
    # Off the middle, so that a side along it does no harm.
    level = min(heights) + 0.5001 * (max(heights) - min(heights))
    crossings = sorted(
        a[0] + (level - a[1]) / (b[1] - a[1]) * (b[0] - a[0])
        for ring in rings
        for a, b in pairwise(ring)
        if (a[1] > level) != (b[1] > level)
    )
    pairs = list(zip(crossings[::2], crossings[1::2], strict=True))
    left, right = max(pairs, key=lambda pair: pair[1] - pair[0], default=(rings[0][0][0],) * 2)
    return 0.5 * (left + right), level


def holds(rings: tuple[Ring, ...], point: tuple[float, float]) -> bool:
    """Does a polygon hold a point, its holes not counted?

    >>> holds((((0, 0), (4, 0), (4, 4), (0, 0)),), (3, 1))
    True
    """
    x, y = point
    crossed = (
        a[0] + (y - a[1]) / (b[1] - a[1]) * (b[0] - a[0]) > x
        for ring in rings
        for a, b in pairwise(ring)
        if (a[1] > y) != (b[1] > y)
    )
    return sum(crossed) % 2 == 1


def area_of(feature: Feature) -> float:
    """Area of a polygon, its holes not counted, or of a round thing."""
    if feature.shape == "point":
        return math.pi * (feature.radius or 0.0) ** 2
    return 0.5 * abs(sum(a[0] * b[1] - b[0] * a[1] for a, b in pairwise(feature.rings[0])))
