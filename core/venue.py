"""Venue: the square and its obstacles."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise

import numpy as np

from core.checks import checked_list, checked_point, checked_type
from core.display import Readable, format_range
from core.errors import InvalidValue
from core.language import Phrases, say
from core.names import checked_name
from core.quantities import Given, Value
from core.shapes.engines import polygon_fault
from core.values import Floats, Point

Ring = tuple[Point, ...]

# Largest number of edges in a venue, because each costs as much as a bench at rest: 5,000 of one obstacle beside 223
# benches take a quick check 1.3 s (2026-11-30). Those between equal points count.
EDGES_MAX = 5_000
# Form of the rings of an area, for messages.
WORDS = "must be a list of rings of points [x, y] in metres"
# Words in messages for the faults that polygon_fault() finds.
FAULTS: Phrases = {
    "self-intersection": "a self-intersection at {at}",
    "ring self-intersection": "a ring that touches itself at {at}",
    "hole lies outside shell": "a hole outside the outer ring at {at}",
    "holes are nested": "a hole inside another hole at {at}",
    "interior is disconnected": "an inside cut in two by rings that touch at {at}",
    "too few points in geometry component": "a ring of fewer than three different points at {at}",
}


def twice_area(ring: Sequence[Point]) -> float:
    """Twice the area in a closed ring, above zero where it goes counter-clockwise [m^2]."""
    return sum(a[0] * b[1] - b[0] * a[1] for a, b in pairwise(ring))


def refuse_many_edges(rings: Iterable[Sequence[object]]) -> None:
    """Refuse more edges than EDGES_MAX, counted by the lengths of the rings alone. raises: InvalidValue"""
    edges = sum(max(len(ring) - 1, 1) for ring in rings)
    if edges > EDGES_MAX:
        raise InvalidValue("venue", "must have at most {most} edges", got=edges, most=EDGES_MAX)


@dataclass(frozen=True, repr=False)
class Area(Readable):
    """A polygon: the square, or an obstacle in it.

    name: its name
    rings: the outer ring, then the holes; each closed, at least 4 points, x and y [m]

    raises: InvalidValue with the reason and the place of a fault. Too many edges are refused first, because the time of
        the check grows faster than their number.

    >>> Area("square", (((0, 0), (40, 0), (40, 30), (0, 30), (0, 0)),))
    <Area: 'square', 4 points, x 0 to 40 m, y 0 to 30 m>
    """

    name: str
    rings: tuple[Ring, ...]

    def __post_init__(self) -> None:
        checked_name("venue", self.name, "venue: the name of a polygon")
        rings = [
            checked_list(f"venue.{k}", ring, WORDS) for k, ring in enumerate(checked_list("venue", self.rings, WORDS))
        ]
        if not rings:
            raise self._refused("venue: {polygon} must have at least one ring")
        refuse_many_edges(rings)
        points = [[checked_point(f"venue.{k}.{i}", at) for i, at in enumerate(ring)] for k, ring in enumerate(rings)]
        object.__setattr__(self, "rings", tuple(map(tuple, points)))
        for ring in self.rings:
            if len(ring) < 4 or ring[0] != ring[-1]:
                got = f"{len(ring)}, from {ring[:1]} to {ring[-1:]}"
                raise self._refused("venue: a ring of {polygon} must be closed and have at least 4 points", got)
        if flaw := polygon_fault(self.rings):
            reason, x, y = flaw
            fault, at = FAULTS.get(reason, f"a fault ({reason}) at {{at}}"), f"({x:g}, {y:g}) m"
            words = f"venue: {{polygon}} must be a valid polygon, got {fault}"
            raise self._refused(words, at=at)

    def _refused(self, words: str, got: Value | None = None, **values: Value) -> InvalidValue:
        return InvalidValue.in_words("venue", words, got=got, polygon=Given(self.name, repr(self.name)), **values)

    def _line(self) -> str:
        x, y = np.array(self.rings[0]).T
        points = sum(map(len, self.rings)) - len(self.rings)
        values = {"x": format_range(x, "m"), "y": format_range(y, "m")}
        return say("{name}, {count} points, x {x}, y {y}", name=repr(self.name), count=points, **values)

    def _drawn_lines(self) -> list[Floats]:
        return [np.array(ring) for ring in self.rings]

    @cached_property
    def edges(self) -> Floats:
        """x, y, x, y [m] of every edge with a positive length, (E, 4)."""
        edges = np.array([(*a, *b) for ring in self.rings for a, b in pairwise(ring) if a != b])
        return edges.reshape(-1, 4)


@dataclass(frozen=True, repr=False)
class Venue(Readable):
    """The square with its holes, and the obstacles in it.

    square: the square
    obstacles: the obstacles

    >>> Venue(Area("square", (((0, 0), (9, 0), (9, 9), (0, 0)),))).square.edges.shape
    (3, 4)
    """

    square: Area
    obstacles: tuple[Area, ...] = ()

    def __post_init__(self) -> None:
        checked_type("venue", self.square, Area)
        for area in checked_list("venue", self.obstacles, "must be a list of areas"):
            checked_type("venue", area, Area)
        refuse_many_edges(ring for area in self.areas for ring in area.rings)
        names = [area.name for area in self.areas]
        for k, name in enumerate(names):
            if name in names[:k]:
                polygon = Given(name, repr(name))
                raise InvalidValue("venue", "must give each polygon its own name, got {polygon} twice", polygon=polygon)

    def _line(self) -> str:
        names = ", ".join(repr(area.name) for area in self.obstacles) or say("none")
        return say("{square}; obstacles: {names}", square=self.square._line(), names=names)

    def _drawn_lines(self) -> list[Floats]:
        return [way for area in self.areas for way in area._drawn_lines()]

    @property
    def areas(self) -> tuple[Area, ...]:
        """The square, then the obstacles."""
        return (self.square, *self.obstacles)
