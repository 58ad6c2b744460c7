"""Gates on the border of a square, and the streets beyond them, in which a dragon stands before and after its dance."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from enum import StrEnum
from itertools import permutations

import numpy as np

from core.checks import checked_angle, checked_list, checked_member, checked_number, checked_point, checked_type
from core.display import Readable
from core.errors import InvalidValue
from core.quantities import Quantity, quantities
from core.values import Floats, Point
from core.venue import Area, Venue, twice_area

# Largest distance of a gate from the border [m]: coordinates that were measured with a tape or read from a map.
ON_BORDER = 0.25
# Largest angle between the heading of a gate and straight across the border [deg].
CROSSED_MOST = 80.0
# Most by which a border beside a gate leads into the square per way along it [1]: steeper is a wall, at 60 degrees
# within the least width of a street, and at 30 beyond it.
STEEPEST, STEEPEST_BEYOND = math.tan(math.radians(60.0)), math.tan(math.radians(30.0))
# Largest difference of the distances of two sides from a gate at their corner [m].
AT_CORNER = 1e-9
# Way between a street and a border that it passes [m].
PASSED = 1e-3
# Largest number of gates [1]; least and largest size of a street [m].
GATES_MAX = 8
STREETS = (0.1, 1e4)


class GateUse(StrEnum):
    """What a gate is for: IN and OUT are one-way, BOTH is for either.

    >>> [use.value for use in GateUse]
    ['in', 'out', 'both']
    """

    IN = "in"
    OUT = "out"
    BOTH = "both"

    def __repr__(self) -> str:
        """As a gate takes it."""
        return repr(self.value)


@dataclass(frozen=True)
class Gate(Readable):
    """A place on the border of the square, with a straight street beyond it.

    point: the place, x and y [m]
    heading: heading of those who enter there [rad]
    use: whether a dance may begin there, end there, or both
    street_width: width of the street; None for as wide as the dragon needs it [m]
    street_length: length of the street; None for as long as the dragon needs it [m]

    >>> Gate((20.0, 0.0), heading=math.pi / 2, street_width=4.0).use
    'both'
    """

    point: Point
    heading: float
    use: GateUse = GateUse.BOTH
    street_width: float | None = None
    street_length: float | None = None

    def __post_init__(self) -> None:
        object.__setattr__(self, "point", checked_point("gate.point", self.point))
        object.__setattr__(self, "heading", checked_angle("gate.heading", self.heading))
        object.__setattr__(self, "use", checked_member("gate.use", self.use, GateUse))
        for name in ("street_width", "street_length"):
            size = getattr(self, name)
            if size is not None:
                object.__setattr__(self, name, checked_number(f"gate.{name}", size, "m", *STREETS))

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
    if every and not ways_through(every):
        raise InvalidValue("gates", "must have a way in and a way out")
    return tuple(_on_border(f"gates.{k}", gate, venue.square) for k, gate in enumerate(every))


def ways_through(gates: Sequence[Gate]) -> list[tuple[Gate, Gate]]:
    """The gates by which a dance may enter and leave: two different ones, or where there are none, the same."""

    def suits(into: Gate, out: Gate) -> bool:
        return into.use is not GateUse.OUT and out.use is not GateUse.IN

    pairs = [pair for pair in permutations(gates, 2) if suits(*pair)]
    return pairs or [(gate, gate) for gate in gates if suits(gate, gate)]


def _on_border(name: str, gate: Gate, square: Area) -> Gate:
    """The gate at the nearest place of the outer border. raises: InvalidValue"""
    points = _counter_clockwise(square.rings[0])
    _, nearest, into = _crossed(points, gate)
    off = math.dist(nearest, gate.point)
    if off > ON_BORDER:
        rule = "must be on the border of the square: it is {off} from it, more than {most}"
        raise InvalidValue(f"{name}.point", rule, **quantities("m", 4, off=off, most=ON_BORDER))
    if float((into @ gate.ahead).max()) < math.cos(math.radians(CROSSED_MOST)):
        rule = "must lead into the square, within 80 degrees of straight across its border"
        raise InvalidValue(f"{name}.heading", rule, got=Quantity(gate.heading, "rad", 6))
    return replace(gate, point=nearest)


def _counter_clockwise(ring: tuple[Point, ...]) -> Floats:
    """The corners of a ring, each once, counter-clockwise [m]. Shape (corners, 2)."""
    return np.array(ring[:-1] if twice_area(ring) > 0.0 else ring[:0:-1])


def _crossed(points: Floats, gate: Gate) -> tuple[int, Point, Floats]:
    """Which side of these corners a gate crosses, its place there [m], and the unit vectors into the square.

    It is the nearest side; at a corner it is the one that is crossed straighter, and the vectors are those of both.
    """
    ways = np.roll(points, -1, axis=0) - points
    squared = np.maximum((ways * ways).sum(axis=1), 1e-300)
    along = np.clip(((gate.point - points) * ways).sum(axis=1) / squared, 0.0, 1.0)
    nearest = points + along[:, None] * ways
    distance = np.hypot(*(nearest - gate.point).T)
    into = np.stack([-ways[:, 1], ways[:, 0]], axis=1) / np.sqrt(squared)[:, None]
    there = distance <= distance.min() + AT_CORNER
    k = int(np.where(there, into @ gate.ahead, -math.inf).argmax())
    x, y = nearest[k].tolist()
    return k, (x, y), into[there]


def with_streets(venue: Venue, gates: Sequence[Gate], widths: tuple[float, float], length: float) -> Venue:
    """The venue with a straight street beyond every gate, whose dragon may stand there.

    The mouth of a street is the border beside its gate; where that bends steeply into the square, it is a wall, which
    a wide street ends behind.

    widths: of a street, and where there is no room for it [m]; length: [m]; a gate may have its own street
    raises: InvalidValue naming the gate whose street is too small for the dragon, has no room on the border, or runs
        back into the square
    """
    square, (wide, least), needed = venue.square, widths, length
    for k, gate in enumerate(gates):
        place = f"gates.{k}.point"
        for name, own, need in (("width", gate.street_width, least), ("length", gate.street_length, needed)):
            if own is not None and own < need:
                rule = "must be at least {least}, because the whole dragon stands in the street"
                got = Quantity(own, "m")
                raise InvalidValue(f"gates.{k}.street_{name}", rule, got=got, **quantities("m", 4, least=need))
        length = gate.street_length or needed
        for width in (wide, least) if gate.street_width is None else (gate.street_width,):
            ring = _with_street(square.rings[0], gate, width, least, length)
            area = None if ring is None else _area(square.name, (ring, *square.rings[1:]))
            if area is not None:
                break
        sizes = quantities("m", 4, width=width, length=length)
        if ring is None:
            rule = "must have {width} of border for its street, and the square is narrower there"
            raise InvalidValue(place, rule, width=sizes["width"])
        if area is None:
            rule = "must lead to a straight street, {width} wide and {length} long, that does not meet the square again"
            raise InvalidValue(place, rule, **sizes)
        square = area
    return Venue(square, venue.obstacles)


def _area(name: str, rings: tuple[tuple[Point, ...], ...]) -> Area | None:
    """An area with these rings; None if they meet."""
    try:
        return Area(name, rings)
    except InvalidValue:
        return None


def _with_street(
    ring: tuple[Point, ...], gate: Gate, width: float, least: float, length: float
) -> tuple[Point, ...] | None:
    """The ring with a street; None if the gate's side of the square is narrower than the least width [m].

    A ring that goes counter-clockwise leads to the right of those who enter.
    """
    points = _counter_clockwise(ring)
    on, _, into = _crossed(points, gate)
    at, ahead = np.array(gate.point), np.array(gate.ahead)
    side, across = np.array([-ahead[1], ahead[0]]), into.sum(axis=0)
    across /= np.hypot(*across)
    forwards = np.roll(points, -on - 1, axis=0)
    right, first = _side(forwards, at, ahead, -side, across, (0.5 * width, 0.5 * least))
    left, last = _side(forwards[::-1], at, ahead, side, across, (0.5 * width, 0.5 * least))
    kept = forwards[first : len(points) - last]
    if not right or not left or not len(kept):
        return None
    back = at - length * ahead
    path = [*kept, *left[::-1], back + 0.5 * width * side, back - 0.5 * width * side, *right, kept[0]]
    return tuple((float(x), float(y)) for x, y in path)


# From the gate along the border, the street begins where the border is half a width beside its axis. But where the
# border becomes steep before, and beside the least width, a wall begins: the street stands behind it, on the line that
# the gate's border has, or where the wall leads back across that line, behind the wall.
def _side(
    points: Floats, at: Floats, ahead: Floats, side: Floats, into: Floats, halves: tuple[float, float]
) -> tuple[list[Floats], int]:
    """The places by which a side of a street joins the border, from its full width on, and the next of these points.

    points: of the border, from the gate on; into: unit vector straight across the border at the gate
    halves: half the width of the street, and the least one up to a wall [m]
    returns: no places if the border does not reach the width, or a wall is nearer than the least
    """
    half, least = halves
    along = np.array([-into[1], into[0]]) * math.copysign(1.0, into[0] * side[1] - into[1] * side[0])
    beside, frame = (points - at) @ side, (points - at) @ np.stack([along, into], axis=1)
    wall: Floats | None = None
    before, reached, last, kept, depth = at, 0.0, np.zeros(2), 0, 0.0
    for k, (point, offset, place) in enumerate(zip(points, beside.tolist(), frame, strict=True)):
        run, rise = (place - last).tolist()
        if wall is None and rise > AT_CORNER and rise > STEEPEST_BEYOND * run:
            if reached < least and rise > STEEPEST * run:
                return [], 0
            if max(reached, offset) >= least:
                begun = (least - reached) / (offset - reached) if reached < least else 0.0
                wall, kept = before + begun * (point - before), k
                reached, last = max(reached, least), last + begun * (place - last)
                depth, before, rise = max(-float(last[1]), 0.0), wall, float(place[1] - last[1])
        share = min((half - reached) / (offset - reached), 1.0) if offset >= half else 1.0
        if wall is None and offset >= half:
            return [before + share * (point - before)], k
        depth = max(depth, -float(last[1] + share * rise))
        if wall is not None and offset >= half:
            break
        before, reached, last = point, offset, place
    if wall is None:
        return [], 0
    down = depth + PASSED if depth > 0.0 else 0.0
    corner = at - down * into + (half + down * float(into @ side)) / float(along @ side) * along
    behind = (float((wall - at) @ into) + down) / float(ahead @ into)
    return [corner, *([wall - behind * ahead] if behind > AT_CORNER else []), wall], kept
