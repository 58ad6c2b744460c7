"""Lines that meet at their ends as one line: four of them that close are the outline of an area."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Sequence
from dataclasses import replace
from itertools import pairwise
from math import dist

import numpy as np

from app.maps.features import MARK, PATH, MapFeature, drawn_as
from core.values import Floats, Point

# Largest distance of two ends that meet [m]; drawing programs write six to sixteen digits.
APART = 0.005


def joined(features: Sequence[MapFeature]) -> list[MapFeature]:
    """The features; lines of one layer that close, and those of the path that meet, become one where the first stood.

    A line with a name, a width or a role of its own stays. Where three lines meet, nobody can say which follow one
    another, so they stay too.
    """
    groups = defaultdict[tuple[object, ...], list[int]](list)
    for k, one in enumerate(features):
        if one.shape == "line" and one.radius is None and one.role != MARK and not (one.name and one.role != PATH):
            groups[one.properties.get("layer"), one.role, one.name].append(k)
    instead: dict[int, MapFeature] = {}
    gone = set[int]()
    for (_, role, _), members in groups.items():
        for chain in _chains([features[k].rings[0] for k in members]):
            points, places = _along(features, [(members[k], back) for k, back in chain])
            if len(chain) == 1 or not (role == PATH or points[0] == points[-1]):
                continue
            first = min(places)
            instead[first] = drawn_as(replace(features[first], rings=(points,)))
            gone |= set(places) - {first}
    return [instead.get(k, one) for k, one in enumerate(features) if k not in gone]


def _along(features: Sequence[MapFeature], chain: Iterable[tuple[int, bool]]) -> tuple[tuple[Point, ...], list[int]]:
    points: list[Point] = []
    places = []
    for place, back in chain:
        ring = features[place].rings[0]
        points += (ring[::-1] if back else ring)[1 if points else 0 :]
        places.append(place)
    if len(places) > 1 and dist(points[0], points[-1]) < APART:
        points[-1] = points[0]
    return tuple(points), places


def _chains(lines: Sequence[Sequence[Point]]) -> list[list[tuple[int, bool]]]:
    """Lines that follow one another, each with True if it is walked backwards."""
    corners = _MeetingPoints(point for line in lines for point in (line[0], line[-1]))
    ends = [(corners.at[2 * k], corners.at[2 * k + 1]) for k in range(len(lines))]
    meeting = defaultdict[int, list[int]](list)
    for k, (a, b) in enumerate(ends):
        if a != b:
            meeting[a].append(k)
            meeting[b].append(k)
    left = {k for k, (a, b) in enumerate(ends) if a != b}
    chains = []
    # First those that begin where no other line, or more than one, meets them; then the rings.
    starts = [(k, end) for k in sorted(left) for end in (0, 1) if len(meeting[ends[k][end]]) != 2]
    for k, end in [*starts, *((k, 0) for k in sorted(left))]:
        if k not in left:
            continue
        chain = []
        while k in left:
            left.discard(k)
            chain.append((k, end == 1))
            corner = ends[k][1 - end]
            following = [other for other in meeting[corner] if other in left]
            if len(meeting[corner]) != 2 or not following:
                break
            k = following[0]
            end = 0 if ends[k][0] == corner else 1
        chains.append(chain)
    return chains


class _MeetingPoints:
    """Numbers of points, `at`, and `places` by these numbers; points less than APART from one another have the same."""

    def __init__(self, points: Iterable[Point]) -> None:
        self.at: list[int] = []
        self.places: list[Point] = []
        cells = defaultdict[tuple[int, int], list[tuple[Point, int]]](list)
        for point in points:
            x, y = round(point[0] / APART), round(point[1] / APART)
            near = (one for i in (-1, 0, 1) for j in (-1, 0, 1) for one in cells.get((x + i, y + j), ()))
            number = next((k for other, k in near if dist(other, point) < APART), None)
            if number is None:
                number = len(self.places)
                self.places.append(point)
                cells[x, y].append((point, number))
            self.at.append(number)


def merged(areas: Sequence[MapFeature]) -> MapFeature | None:
    """One area of several that share edges, whose sides may be divided differently; None if they do not make one.

    Sides are divided at the corners of the others that lie on them. What two areas walk in opposite directions is
    inside. The rest is the outline and holes, which are walked clockwise.
    """
    rings = [_counter_clockwise(ring, k > 0) for one in areas for k, ring in enumerate(one.rings)]
    corners = _MeetingPoints(point for ring in rings for point in ring[:-1])
    places, at = corners.places, iter(corners.at)
    every = np.array(places)
    ways: set[tuple[int, int]] = set()
    for ring in rings:
        numbers = [next(at) for _ in ring[:-1]]
        for a, b in pairwise([*numbers, numbers[0]]):
            ways.update(pairwise(_divided(a, b, every)))
    outer = {(a, b) for (a, b) in ways if (b, a) not in ways and a != b}
    after = dict(outer)
    if len(after) < len(outer):  # areas that touch in a corner
        return None
    loops: list[tuple[Point, ...]] = []
    while after:
        first, following = after.popitem()
        loop = [first]
        while following != first:
            loop.append(following)
            if following not in after:
                return None
            following = after.pop(following)
        loops.append(tuple(places[k] for k in [*loop, first]))
    outlines = [loop for loop in loops if _twice_area(loop) > 0.0]
    if len(outlines) != 1:
        return None
    return replace(areas[0], rings=(outlines[0], *(loop for loop in loops if loop is not outlines[0])))


def _divided(a: int, b: int, places: Floats) -> list[int]:
    """A side from corner to corner, with the corners on it in order. places: of all corners (N, 2) [m]"""
    way, away = places[b] - places[a], places - places[a]
    length = max(float(np.hypot(*way)), APART)
    along, off = away @ way / length, np.abs(away @ [way[1], -way[0]]) / length
    on = np.flatnonzero((along > APART) & (along < length - APART) & (off < APART))
    return [a, *on[np.argsort(along[on])].tolist(), b]


def _twice_area(ring: Sequence[Point]) -> float:
    return sum(a[0] * b[1] - b[0] * a[1] for a, b in pairwise(ring))


def _counter_clockwise(ring: Sequence[Point], is_hole: bool) -> Sequence[Point]:
    return ring if (_twice_area(ring) > 0.0) != is_hole else ring[::-1]
