"""The chalk marks along a path, and a dance as a map: its square, its path and its marks."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, replace

import numpy as np

from app.maps.features import Drawing, MapFeature, Unit, aside_features, features_of
from app.wire.degrees import GeographicOrigin, Place, Plane
from app.wire.fields import check_limit
from core import Dance
from core.motion.places import handle_places
from core.paths.path import Path
from core.values import Floats

# Most marks of one path.
MARKS_MAX = 2_000
# For the line that shows a path: largest distance of its points, and largest distance of the line from the path [m].
DRAWN_STEP, DRAWN_SAG = 0.5, 0.002
# Most points of a line.
POINTS_MAX = 20_000


@dataclass(frozen=True, slots=True)
class Marks:
    """Marks along a path, one every `spacing`.

    first: s of mark 0, where lengths on the ground begin [m]; s: of each mark (M,) [m]; points: (M, 2) [m]
    """

    spacing: float
    first: float
    s: Floats
    points: Floats

    @property
    def names(self) -> list[str]:
        """Name of each mark: its length along the path from the first one [m]."""
        return [mark_name(one) for one in (self.s - self.first).tolist()]


def first_mark(dance: Dance, tail: float, spacing: float) -> float:
    """s of mark 0 of a dance whose tail starts at a place [m]. A path with a beginning has mark 0 there."""
    begin = dance.path.tail_begin
    # On a spiral the tail may stand anywhere, so one mark is put where the head stands at time 0.
    return spacing * math.floor(tail / spacing) if begin is None else begin


def marks_before(length: float, spacing: float) -> int:
    """How many marks behind mark 0 stand on a length from there [m]."""
    return int(length / spacing + 1e-9)


def mark_name(s: float) -> str:
    """Name of the mark at a length along the path from the first one [m], to write beside it on the ground."""
    return f"{round(s, 3):g}"


def marks_of(dance: Dance, start: float, stop: float, spacing: float) -> Marks:
    """Marks from the place of the tail at `start` [s] to that of the head at `stop` [s].

    On a path with a beginning mark 0 is there. raises: TooLarge
    """
    tail, head = float(handle_places(dance, [start])[0, -1]), float(handle_places(dance, [stop])[0, 0])
    first = first_mark(dance, tail, spacing)
    low = first + spacing * np.floor((tail - first) / spacing)
    count = marks_before(head - low, spacing) + 1
    check_limit("spacing", "marks must be at most {most} here", count, MARKS_MAX, "set them further apart")
    s = low + spacing * np.arange(count)
    return Marks(spacing, first, s, dance.path.position(s))


def line_of(path: Path, low: float, high: float) -> Floats:
    """Points (N, 2) [m] of a line along a path from s = low to s = high [m], denser where the path curves."""
    s = np.linspace(low, high, min(POINTS_MAX, max(2, int((high - low) / 0.05) + 2)))
    bend = np.abs(path.curvature(s))
    # The middle of a chord of length h is h^2 curvature / 8 from its arc.
    steps = np.minimum(DRAWN_STEP, np.sqrt(8.0 * DRAWN_SAG / np.maximum(bend, 1e-9)))
    along = np.concatenate([[0.0], np.cumsum(np.diff(s) / (0.5 * (steps[1:] + steps[:-1])))])
    count = min(POINTS_MAX, int(along[-1]) + 2)
    points: Floats = path.position(np.interp(np.linspace(0.0, along[-1], count), along, s))
    return points


@dataclass(frozen=True, slots=True)
class MarkedDance:
    """A dance on a map: its marks, and its path as a request describes it.

    number, name: of one of several dragons; None for the only one, and for one without a name
    """

    dance: Dance
    marks: Marks
    path_fields: Mapping[str, object]
    number: int | None = None
    name: str | None = None

    def features(self) -> Iterator[MapFeature]:
        """The line of the path, and the marks; those of one of several dragons have its number and its name."""
        path, marks = self.dance.path, self.marks
        own = {} if self.number is None else {"dragon": self.number, "dragon_name": self.name}
        low, high = path.drawn_between(min(float(marks.s[0]), path.begin), path.end)
        line = tuple(map(tuple, line_of(path, low, high).tolist()))
        properties: dict[str, object] = {"path": self.path_fields, **own}
        yield MapFeature("line", (line,), self._full_name("path"), "path", properties=properties)
        for name, s, point in zip(marks.names, marks.s.tolist(), marks.points.tolist(), strict=True):
            properties = {"s": round(s, 6), "x": round(point[0], 4), "y": round(point[1], 4), **own}
            yield MapFeature("point", (((point[0], point[1]),),), self._full_name(name), "mark", properties=properties)

    def _full_name(self, name: str) -> str:
        """A name on the map; of one of several dragons, after its own name or its number."""
        return name if self.number is None else f"{self.name or self.number} {name}"


def drawing_of(dances: Iterable[MarkedDance], place: Place, origin: GeographicOrigin | None) -> Drawing:
    """The dances as a map in metres. place: the venue"""
    paths = (feature for one in dances for feature in one.features())
    features = [*features_of(place.things), *aside_features(place.asides), *paths]
    return Drawing(tuple(features), Unit.METRES, origin, grid=place.grid)


def in_degrees(drawing: Drawing) -> Drawing:
    """The map in longitude and latitude. It must be in metres and have an origin."""
    assert drawing.origin is not None
    plane = Plane(drawing.origin)

    def placed(points: Floats) -> Floats:
        """Places on earth, with longitudes within 180 degrees: on the date line they jump."""
        longitude, latitude = plane.degrees(points).T
        return np.column_stack([(longitude + 180.0) % 360.0 - 180.0, latitude])

    return replace(drawing, features=tuple(one.moved(placed) for one in drawing.features), unit=Unit.DEGREES)


def on_grid(drawing: Drawing) -> Drawing:
    """The map in metres with the coordinates of its survey grid, if it came from one."""
    if drawing.grid is None:
        return drawing
    grid = np.array(drawing.grid)
    return replace(drawing, features=tuple(one.moved(lambda points: points + grid) for one in drawing.features))
