"""Gates on the border of a square, and the streets beyond them, in which a dragon stands before and after its dance."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from core.display import Readable
from core.errors import InvalidValue, Quantity, checked_angle, checked_list, checked_point, checked_type, quantities
from core.values import Floats, Point
from core.venue import Area, Venue

# Largest distance of a gate from the border [m]: coordinates that were measured with a tape or read from a map.
ON_BORDER = 0.25
# Largest angle between the heading of a gate and straight across the border [deg].
CROSSED_MOST = 80.0
# Most that a border leads ahead of those who enter, where a street joins it, per way beside them [1]: as a border does
# that is crossed with the largest heading that a gate may have. Walls of a channel behind a gate lead further ahead.
AHEAD_MOST = math.tan(math.radians(CROSSED_MOST))
# Largest difference of the distances of two sides from a gate at their corner [m].
AT_CORNER = 1e-9
# Largest number of gates [1].
GATES_MAX = 8


@dataclass(frozen=True)
class Gate(Readable):
    """A place on the border of the square, (x, y) [m], and the heading of those who enter there [rad]."""

    point: Point
    heading: float
    _units = {"heading": "rad"}  # noqa: RUF012 - a field of a dataclass may not be annotated here

    def __post_init__(self) -> None:
        object.__setattr__(self, "point", checked_point("gate.point", self.point))
        object.__setattr__(self, "heading", checked_angle("gate.heading", self.heading))

    @property
    def ahead(self) -> Point:
        """Unit vector of the heading."""
        return (math.cos(self.heading), math.sin(self.heading))


def checked_gates(gates: Sequence[Gate] | None, venue: Venue) -> tuple[Gate, ...]:
    """The gates, moved onto the border if they are a little off. raises: InvalidValue naming the gate"""
    every = checked_list("gates", () if gates is None else gates, "must be a list of gates")
    if len(every) > GATES_MAX:
        raise InvalidValue("gates", "must be at most {most} gates", got=len(every), most=GATES_MAX)
    for k, gate in enumerate(every):
        checked_type(f"gates.{k}", gate, Gate)
    return tuple(_on_border(f"gates.{k}", gate, venue.square) for k, gate in enumerate(every))


def _on_border(name: str, gate: Gate, square: Area) -> Gate:
    """The gate at the nearest place of the outer border. raises: InvalidValue"""
    ring = np.array(square.rings[0])
    a, b = ring[:-1], ring[1:]
    way = b - a
    squared = np.maximum((way * way).sum(axis=1), 1e-300)
    along = np.clip(((gate.point - a) * way).sum(axis=1) / squared, 0.0, 1.0)
    nearest = a + along[:, None] * way
    distance = np.hypot(*(nearest - gate.point).T)
    left = math.copysign(1.0, _signed_area(square.rings[0]))
    into = left * ((np.stack([-way[:, 1], way[:, 0]], axis=1) @ gate.ahead) / np.sqrt(squared))
    # At a corner the side counts that is crossed straighter.
    k = int(np.where(distance <= distance.min() + AT_CORNER, into, -math.inf).argmax())
    if distance[k] > ON_BORDER:
        rule = "must be on the border of the square: it is {off} from it, more than {most}"
        raise InvalidValue(f"{name}.point", rule, **quantities("m", 4, off=float(distance[k]), most=ON_BORDER))
    x, y = nearest[k].tolist()
    if into[k] < math.cos(math.radians(CROSSED_MOST)):
        rule = "must lead into the square, within 80 degrees of straight across its border"
        raise InvalidValue(f"{name}.heading", rule, got=Quantity(gate.heading, "rad", 6))
    return Gate((x, y), gate.heading)


def _signed_area(ring: tuple[Point, ...]) -> float:
    return sum(a[0] * b[1] - b[0] * a[1] for a, b in pairwise(ring))


def with_streets(venue: Venue, gates: Sequence[Gate], widths: tuple[float, float], length: float) -> Venue:
    """The venue with a straight street beyond every gate, whose dragon may stand there.

    widths: of a street, and where the border of the square has no room for it [m]; length: [m]
    raises: InvalidValue naming the gate whose street has no room on the border, or runs back into the square
    """
    rings = venue.square.rings
    for k, gate in enumerate(gates):
        place = f"gates.{k}.point"
        ring, width = _with_street(rings[0], gate, widths[0], length), widths[0]
        if ring is None:
            ring, width = _with_street(rings[0], gate, widths[1], length), widths[1]
        sizes = quantities("m", 4, width=width, length=length)
        if ring is None:
            rule = "must have {width} of border for its street, and the square is narrower there"
            raise InvalidValue(place, rule, width=sizes["width"])
        rings = (ring, *rings[1:])
        try:
            Area(venue.square.name, rings)
        except InvalidValue as error:
            rule = "must lead to a straight street, {width} wide and {length} long, that does not meet the square again"
            raise InvalidValue(place, rule, **sizes) from error
    return Venue(Area(venue.square.name, rings), venue.obstacles)


def _with_street(ring: tuple[Point, ...], gate: Gate, width: float, length: float) -> tuple[Point, ...] | None:
    """The ring with a street; None if the border does not reach both sides of the street.

    From the gate along the border both ways, the street begins where the border is half a width beside its axis. A ring
    that goes counter-clockwise leads to the right of those who enter.
    """
    points = np.array(ring[:-1] if _signed_area(ring) > 0.0 else ring[:0:-1])
    at, ahead = np.array(gate.point), np.array(gate.ahead)
    side = np.array([-ahead[1], ahead[0]])
    nearest = [_distance(a, b, at) for a, b in zip(points, np.roll(points, -1, axis=0), strict=True)]
    on = int(np.argmin(nearest))
    forwards, backwards = np.roll(points, -on - 1, axis=0), np.roll(points, -on - 1, axis=0)[::-1]
    right, first = _side(forwards, at, ahead, -side, 0.5 * width)
    left, last = _side(backwards, at, ahead, side, 0.5 * width)
    kept = forwards[first : len(points) - last]
    if right is None or left is None or not len(kept):
        return None
    back = at - length * ahead
    path = [*kept, left, back + 0.5 * width * side, back - 0.5 * width * side, right, kept[0]]
    return tuple((float(x), float(y)) for x, y in path)


def _distance(a: Floats, b: Floats, point: Floats) -> float:
    """Distance of a point from the line between two points [m]."""
    way = b - a
    along = min(max(float((point - a) @ way) / max(float(way @ way), 1e-300), 0.0), 1.0)
    return float(np.hypot(*(a + along * way - point)))


def _side(points: Floats, at: Floats, ahead: Floats, side: Floats, half: float) -> tuple[Floats | None, int]:
    """The place of the border, from a gate along these points, that is `half` to a side of it; and the next point.
    None without one, or if the border leads further ahead than AHEAD_MOST to it: the street would take away the walls
    of a channel behind the gate."""
    beside, before, reached = (points - at) @ side, at, 0.0
    for k, (point, offset) in enumerate(zip(points, beside.tolist(), strict=True)):
        if offset >= half:
            place: Floats = before + (half - reached) / (offset - reached) * (point - before)
            return (None, 0) if (place - at) @ ahead > AHEAD_MOST * half + AT_CORNER else (place, k)
        before, reached = point, offset
    return None, 0
