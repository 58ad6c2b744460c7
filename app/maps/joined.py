"""Lines that meet at their ends as one line: four of them that close are the outline of an area."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Sequence
from dataclasses import replace
from math import dist

from app.maps.features import MARK, PATH, MapFeature, drawn_as
from app.wire.parts import APART, MeetingPoints
from core.values import Point


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
    corners = MeetingPoints(point for line in lines for point in (line[0], line[-1]))
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
