"""The path of a dance from a line on a map."""

from __future__ import annotations

import math
from collections.abc import Mapping
from itertools import pairwise
from typing import Any

import numpy as np
from pydantic import TypeAdapter, ValidationError

from app.maps.features import MapFeature
from app.maps.marks import line_of
from app.wire.messages import fault_of
from app.wire.paths import POINTS_MAX, AnyPath
from core import InvalidValue, Route, Spiral
from core.errors import Parameter
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


def thinned(points: Floats) -> Floats:
    """Points that are far enough apart, evenly along the line, and at most as many as a path may have."""
    kept = [points[0]]
    for point in points[1:]:
        if np.hypot(*(point - kept[-1])) >= POINTS_APART:
            kept.append(point)
    if len(kept) <= POINTS_MAX:
        return np.array(kept)
    few: Floats = np.array(kept)[np.linspace(0, len(kept) - 1, POINTS_MAX).round().astype(int)]
    return few


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
