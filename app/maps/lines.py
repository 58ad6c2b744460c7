"""The path of a dance from a line on a map."""

from __future__ import annotations

import math
from collections.abc import Mapping
from heapq import heapify, heappop, heappush
from itertools import pairwise
from typing import Any

import numpy as np
from pydantic import TypeAdapter, ValidationError

from app.maps.features import MapFeature
from app.maps.marks import line_of
from app.wire.messages import fault_of
from app.wire.paths import POINTS_MAX, AnyPath
from core import InvalidValue, Route, Spiral
from core.quantities import Parameter
from core.values import Floats

# Least distance between two points of a path [m]; and largest distance of a line from its stored path, beyond which the
# line was moved [m].
POINTS_APART, MOVED = 0.05, 0.01
# Approximate number of points of that line to compare [1].
TRIED = 200


def checked_path(path: object) -> Spiral | Route:
    """The path of core that a request describes. raises: InvalidValue"""
    try:
        checked: Spiral | Route = TypeAdapter[Any](AnyPath).validate_python(path).to_path()
    except ValidationError as error:
        first = error.errors(include_url=False)[0]
        fault = fault_of({**first, "loc": ("file", "path", *first["loc"])}, None)
        values = {**fault.values, "file": Parameter("file")}
        why = f"{fault.template}: {fault.reason}".removesuffix(": ")
        raise InvalidValue.in_words(
            "file", "{file} must describe a path", got=fault.got, reason=why, **values
        ) from error
    return checked


def length_of(line: MapFeature) -> float:
    return sum(math.dist(a, b) for a, b in pairwise(line.rings[0]))


def thinned(points: Floats) -> tuple[Floats, float]:
    """Points of a line that are far enough apart, at most as many as a path may have; and how far the line is from the
    straight ways between them at most [m].

    Of too many, half are evenly spread, which keeps the curve through them near the line, and the others are those
    that are furthest from the line through the ones before (Douglas and Peucker).
    """
    every = points[far_apart(points, POINTS_APART)]
    if len(every) <= POINTS_MAX:
        return every, 0.0
    chosen = np.unique(np.linspace(0, len(every) - 1, POINTS_MAX // 2).round().astype(int)).tolist()
    parts = [(*furthest(every, a, b), a, b) for a, b in pairwise(chosen)]
    heapify(parts)
    while len(chosen) < POINTS_MAX and parts[0][0] < 0.0:
        _, middle, a, b = heappop(parts)
        chosen.append(middle)
        for ends in ((a, middle), (middle, b)):
            heappush(parts, (*furthest(every, *ends), *ends))
    return every[sorted(chosen)], -parts[0][0]


def far_apart(points: Floats, distance: float) -> list[int]:
    """Which points are at least at a distance [m] from the one before that counts, as the first one does."""
    kept = [0]
    for k, point in enumerate(points):
        if np.hypot(*(point - points[kept[-1]])) >= distance:
            kept.append(k)
    return kept


def furthest(points: Floats, a: int, b: int) -> tuple[float, int]:
    """The point between two others that is furthest from their line: its negative distance [m], and its number."""
    if b - a < 2:
        return 0.0, a
    way = points[b] - points[a]
    share = np.clip(((points[a + 1 : b] - points[a]) @ way) / max(float(way @ way), 1e-30), 0.0, 1.0)
    off = np.hypot(*(points[a] + share[:, None] * way - points[a + 1 : b]).T)
    k = int(off.argmax())
    return -float(off[k]), a + 1 + k


def is_along(stored: Mapping[str, Any], points: Floats) -> bool:
    """True if the line still follows the path that is stored with it."""
    try:
        path = checked_path(stored)
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
