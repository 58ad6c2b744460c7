"""One area of several parts: those that share edges, and those that are cut at the date line."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Hashable, Iterable, Sequence
from itertools import pairwise
from math import dist

import numpy as np

from core.values import Floats, Point
from core.venue import Ring, twice_area

# The rings of an area, the outer one first.
Rings = tuple[Ring, ...]
# Largest distance of two points that meet [m]; drawing programs write six to sixteen digits.
APART = 0.005


def whole_areas(areas: Sequence[Rings], kinds: Sequence[Hashable]) -> list[Rings | None]:
    """The areas; several of one kind that make one area are that where the first stood, and None elsewhere.

    areas: in metres; kinds: of each, None for one that stays as it is
    """
    whole: list[Rings | None] = list(areas)
    for kind in dict.fromkeys(one for one in kinds if one is not None):
        places = [k for k, other in enumerate(kinds) if other == kind]
        if len(places) > 1 and (one := merged([areas[k] for k in places])) is not None:
            for k in places:
                whole[k] = None
            whole[places[0]] = one
    return whole


def is_cut(rings: Rings) -> bool:
    """True for an area with a side on the date line. Its rings are in degrees."""
    return any(abs(a[0]) == abs(b[0]) == 180.0 and a != b for a, b in pairwise(rings[0]))


class MeetingPoints:
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


def merged(areas: Sequence[Rings]) -> Rings | None:
    """The rings of one area of several that share edges, whose sides may be divided differently; else None.

    Sides are divided at the corners of the others that lie on them. What two areas walk in opposite directions is
    inside. The rest is the outline and holes, which are walked clockwise.
    """
    rings = [_counter_clockwise(ring, k > 0) for area in areas for k, ring in enumerate(area)]
    corners = MeetingPoints(point for ring in rings for point in ring[:-1])
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
    outlines = [loop for loop in loops if twice_area(loop) > 0.0]
    if len(outlines) != 1:
        return None
    return (outlines[0], *(loop for loop in loops if loop is not outlines[0]))


def _divided(a: int, b: int, places: Floats) -> list[int]:
    """A side from corner to corner, with the corners on it in order. places: of all corners (N, 2) [m]"""
    way, away = places[b] - places[a], places - places[a]
    length = max(float(np.hypot(*way)), APART)
    along, off = away @ way / length, np.abs(away @ [way[1], -way[0]]) / length
    on = np.flatnonzero((along > APART) & (along < length - APART) & (off < APART))
    return [a, *on[np.argsort(along[on])].tolist(), b]


def _counter_clockwise(ring: Sequence[Point], is_hole: bool) -> Sequence[Point]:
    return ring if (twice_area(ring) > 0.0) != is_hole else ring[::-1]
