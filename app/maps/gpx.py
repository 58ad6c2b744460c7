"""Tracks as GPX, the format of receivers and phones: tracks with their times, routes as lines, waypoints as points.

They are read as KML is: see app/files/markup.py.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from datetime import datetime

from app.files.markup import Reader, read_document
from app.maps.features import Drawing, FeatureCollector, MapFeature, Unit, empty_kind, role_of
from app.wire.numbers import number_of
from core import InvalidValue
from core.language import phrase
from core.quantities import Given
from core.values import Point

# Bytes in which the first element of a document is looked for, and its tag; zeros are of UTF-16.
HEAD, ROOT = 4_096, re.compile(rb"<(\w+:)?gpx[\s>]")
FAULT = "must be GPX, got {fault} in line {line}"
FORBIDDEN = phrase("file must not have a document type or entities") + ": " + phrase("save it again as plain GPX")
# Elements of a point; and what they are points of, of which a waypoint has one.
POINTS, LINES = ("trkpt", "rtept", "wpt"), ("trk", "rte", "wpt")


def is_gpx(data: bytes) -> bool:
    """True if an XML document is GPX."""
    return ROOT.search(data[:HEAD].replace(b"\0", b"")) is not None


def seconds_of(text: str) -> float:
    """The time of a text such as 2026-11-27T07:30:00Z, in seconds since 1970; NaN if it is none."""
    try:
        return datetime.fromisoformat(text.strip()).timestamp()
    except (ValueError, OverflowError):
        return float("nan")


def read(data: bytes) -> Drawing:
    """The tracks, routes and waypoints of a document, in degrees. raises: InvalidValue with the line at fault"""
    reader = _TrackReader()
    read_document(data, reader, FAULT, FORBIDDEN)
    return reader.collector.drawing(Unit.DEGREES)


# State:  `points`, `times` and `name` of the open track, route or waypoint.
class _TrackReader(Reader):
    """Collects the tracks of a document while expat reads it. The segments of a track are one line."""

    def __init__(self) -> None:
        super().__init__()
        self.collector, self.name = FeatureCollector(), ""
        self.points: list[Point] = []
        self.times: list[float] = []

    def begin(self, name: str, attributes: Mapping[str, str]) -> None:
        if name in LINES:
            self.points, self.times, self.name = [], [], ""
        if name in POINTS:
            self.points.append((_degrees(attributes, "lon"), _degrees(attributes, "lat")))
            self.times.append(float("nan"))

    def finish(self, name: str, text: str) -> None:
        if name == "time" and self.around in POINTS:
            self.times[-1] = seconds_of(text)
        elif name == "name" and self.around in LINES:
            self.name = text
        elif name in LINES:
            self._add(name)

    def _add(self, kind: str) -> None:
        if not self.points:
            return self.collector.leave_out(empty_kind(kind))
        name = self.name or None
        if kind == "wpt":
            return self.collector.add(MapFeature("point", (tuple(self.points[:1]),), name, role_of(name)))
        times = tuple(self.times) if kind == "trk" else None
        return self.collector.add(MapFeature("line", (tuple(self.points),), name, role_of(name), times=times))


def _degrees(attributes: Mapping[str, str], name: str) -> float:
    text = attributes.get(name, "")
    try:
        return number_of(text)
    except ValueError as error:
        rule = "must have points with lat and lon in degrees"
        raise InvalidValue("file", rule, got=Given(text)) from error
