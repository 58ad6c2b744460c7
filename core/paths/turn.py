"""The turn: two tangent arcs from a coil inwards to a coil outwards, which is its rotation by half a revolution."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from core import kernels
from core.checks import SIZE_MAX, SIZE_MIN, checked_number, checked_size
from core.display import TABLE_DIGITS, display
from core.errors import InvalidValue
from core.language import say
from core.paths.pieces import LENGTH_MIN, Arc, Coil
from core.paths.route import Route
from core.quantities import Quantity, quantities
from core.values import Floats, Point

RATIO_MIN = 0.01
RATIO_MAX = 100.0
# Distance by which rounding may put an arc outside its circle [m].
OUTSIDE = 1e-9
# Least A to divide by [1]. With a smaller one, or without a root, the arcs are larger than any that is accepted.
LEAST_CURVED = 1e-30


# Places of the arcs.
# The entry is E, |E| = R, at the polar angle theta = 2 pi R / pitch; the dance travels there in the direction T, with
# the normal n to the right of it. The coil outwards is the coil inwards, reversed and reflected at the centre. So at
# an exit X, |X| = Q, at the angle phi = 2 pi Q / pitch of that coil, X is minus the place of the coil inwards at phi,
# and the direction T' there is the one of the coil inwards. The centres are C1 = E + r1 n and C2 = X - r2 n'. The arcs
# touch if |C1 - C2| = r1 + r2. With r1 = ratio r2, D = E - X and m = ratio n + n' this is
#     |D + r2 m|^2 = (1 + ratio)^2 r2^2   =>   A r2^2 - 2 B r2 - |D|^2 = 0,
#     A = (1 + ratio)^2 - |m|^2 = 2 ratio (1 - n . n') >= 0,   B = D . m.
# The product of its roots is -|D|^2 / A <= 0, so one root is positive (none if A = 0 and B >= 0):
#     r2 = |D|^2 / (sqrt(B^2 + A |D|^2) - B) = (sqrt(B^2 + A |D|^2) + B) / A,
# of which the first form has no cancellation for B < 0, the second none for B > 0.
#
# If the dance leaves at X = -E, then T' = T, A = 0 and
#     S := r1 + r2 = |E|^2 / (-E . n) = R sqrt(1 + theta^2) / theta,
# for every ratio; so r1 = S ratio / (1 + ratio), r2 = S / (1 + ratio). The triangles O C1 E and O C2 (-E) show that
# both arcs turn by the same angle alpha, so the length S alpha does not depend on the ratio either.
#
# Distance of an arc from the centre. Along a circle the distance from a point rises up to the furthest point and falls
# after it. So an arc is furthest from the centre at one of its ends, or at the furthest point of its circle, at
# |C| + r, if the arc passes it.
class Turn(Route):
    """Two tangent arcs, tangent to the incoming coil and to the outgoing one, its rotation by 180 degrees.

    A route of four pieces: the coil inwards, two arcs, first clockwise, then counter-clockwise, and the coil outwards;
    s = 0 at the entry.
    pitch [m]; turning_radius [m]; ratio: radius of the first arc over that of the second; start_turns: of both coils
    entry_radius: radius at the beginning of the turn [m], at most the turning radius, which is its default
    exit_radius: radius at the end of the turn [m], at most the turning radius; default: that of the entry, so that the
        dance leaves opposite to where it entered
    radii [m]; centres [m]; angles: turned on each arc [rad]; entry, tangent_point, exit [m]; length: of both arcs [m]
    raises: InvalidValue, also for arcs that leave the turning circle

    >>> [round(radius, 9) for radius in Turn(1.7).radii]
    [3.005417668, 1.502708834]
    >>> round(Turn(1.7, entry_radius=4.3, exit_radius=4.5).length, 6)
    11.899652
    """

    def __init__(
        self,
        pitch: float,
        turning_radius: float = 4.5,
        ratio: float = 2.0,
        *,
        start_turns: float = 16.0,
        entry_radius: float | None = None,
        exit_radius: float | None = None,
    ) -> None:
        pitch = checked_size("pitch", pitch)
        radius = checked_size("turning_radius", turning_radius)
        ratio = checked_number("ratio", ratio, "", RATIO_MIN, RATIO_MAX)
        inner = radius if entry_radius is None else checked_number("entry_radius", entry_radius, "m", 1e-3, radius)
        outer = inner if exit_radius is None else checked_number("exit_radius", exit_radius, "m", 1e-3, radius)
        turns = checked_number("start_turns", start_turns, "turns", 0.0, 1e5, open_low=True)
        coil = _coil_length(pitch, turns, radius, inner)
        arcs = _arcs(pitch, ratio, inner, outer)
        radii, (first, second), angles = arcs.radii, arcs.centres, arcs.angles
        _refuse_arcs(arcs, ratio, radius, entry_radius, exit_radius)
        pieces = (
            Coil(pitch, turns, inner / pitch),
            Arc(first, radii[0], arcs.starts[0], -angles[0]),
            Arc(second, radii[1], arcs.starts[1], angles[1]),
            Coil(pitch, outer / pitch, turns, rotation=math.pi),
        )
        try:
            super().__init__(pieces, start=Route(pieces[:1]).end)
        except InvalidValue as error:  # every piece is valid, and every joint closes
            rule, long = "must be smaller: no route may be {coil} long before its s = 0", Quantity(coil, "m", 6)
            raise InvalidValue("start_turns", rule, got=Quantity(turns, "turns"), coil=long) from error
        self.pitch, self.turning_radius, self.ratio = pitch, radius, ratio
        self.entry_radius, self.exit_radius, self.start_turns = inner, outer, turns
        self.radii, self.centres, self.angles = radii, (first, second), angles
        self.entry, self.tangent_point, self.exit = arcs.entry, arcs.tangent_point, arcs.exit
        self.length = radii[0] * angles[0] + radii[1] * angles[1]

    @property
    def _definition(self) -> tuple[object, ...]:
        return *super()._definition, self.turning_radius

    def __repr__(self) -> str:
        deeper = f", entry_radius={self.entry_radius!r}" if self.entry_radius != self.turning_radius else ""
        deeper += f", exit_radius={self.exit_radius!r}" if self.exit_radius != self.entry_radius else ""
        arguments = f"{self.pitch!r}, {self.turning_radius!r}, {self.ratio!r}, start_turns={self.start_turns!r}{deeper}"
        return f"Turn({arguments})"

    def _line(self) -> str:
        lengths = {name: display(getattr(self, name), "m") for name in ("length", "entry_radius", "exit_radius")}
        return say(
            "length {length}, entry {entry_radius}, exit {exit_radius}, ratio {ratio}",
            ratio=display(self.ratio), **lengths,
        )  # fmt: skip

    def _rows(self) -> list[tuple[str, str]]:
        units = dict.fromkeys(("pitch", "turning_radius", "entry_radius", "exit_radius", "radii", "length"), "m")
        units |= {"ratio": "", "angles": "rad"} | dict.fromkeys(("centres", "entry", "tangent_point", "exit"), "m")
        entries = [(name, getattr(self, name), unit) for name, unit in units.items()]
        return [(name.replace("_", " "), display(value, unit, TABLE_DIGITS)) for name, value, unit in entries]


class Arcs(NamedTuple):
    """Both arcs of a turn: radii, centres [m]; starts: directions from the centres to the beginnings [rad]; angles: the
    angles turned [rad]; entry, tangent_point, exit [m]."""

    radii: Point
    centres: tuple[Point, Point]
    starts: Point
    angles: Point
    entry: Point
    tangent_point: Point
    exit: Point

    @property
    def extent(self) -> float:
        """Largest distance of the arcs from the centre [m]."""
        furthest = [math.hypot(*point) for point in (self.entry, self.tangent_point, self.exit)]
        arcs = zip(self.centres, self.radii, self.starts, (-self.angles[0], self.angles[1]), strict=True)
        for (x, y), radius, start, sweep in arcs:
            passed = math.copysign(1.0, sweep) * (math.atan2(y, x) - start) % (2.0 * math.pi)
            if passed <= abs(sweep):
                furthest.append(math.hypot(x, y) + radius)
        return max(furthest)


def _arcs(pitch: float, ratio: float, inner: float, outer: float) -> Arcs:
    """The arcs from the entry at the radius `inner` to the exit at the radius `outer` [m]."""
    theta, phi = (2.0 * math.pi * radius / pitch for radius in (inner, outer))
    (entry, right), (opposite, back) = _place(inner, theta), _place(outer, phi)
    if outer == inner:
        total = inner * math.hypot(1.0, theta) / theta
        radii = (total * ratio / (1.0 + ratio), total / (1.0 + ratio))
    else:
        apart, both = entry + opposite, ratio * right + back
        curved, level, squared = 4.0 * ratio * _half_sine(theta, phi) ** 2, apart @ both, apart @ apart
        root = math.sqrt(level * level + curved * squared)
        least = float(squared / (root - level) if level < 0.0 else (root + level) / max(curved, LEAST_CURVED))
        radii = (ratio * least, least)
        total = radii[0] + radii[1]
    first, second = entry + radii[0] * right, -opposite - radii[1] * back
    middle = first + (second - first) * (radii[0] / total)
    start, end = _angle(entry - first), _angle(middle - first)
    begin, finish = _angle(middle - second), _angle(-opposite - second)
    angles = ((start - end) % (2.0 * math.pi), (finish - begin) % (2.0 * math.pi))
    centres = (_point(first), _point(second))
    return Arcs(radii, centres, (start, begin), angles, _point(entry), _point(middle), _point(-opposite))


def _place(radius: float, theta: float) -> tuple[Floats, Floats]:
    """Point of the coil inwards at theta [m], and the unit normal to the right of the direction of travel."""
    cos, sin, stretch = math.cos(theta), math.sin(theta), math.hypot(1.0, theta)
    ahead = np.array([theta * sin - cos, -theta * cos - sin]) / stretch
    return radius * np.array([cos, sin]), np.array([ahead[1], -ahead[0]])


def _half_sine(theta: float, phi: float) -> float:
    """Sine of half the angle between the directions of travel at two places: the direction at theta is theta + pi +
    atan theta."""
    return math.sin(0.5 * (theta - phi + math.atan(theta) - math.atan(phi)))


def _coil_length(pitch: float, turns: float, radius: float, inner: float) -> float:
    """Length of the coil up to the entry [m].

    raises: InvalidValue for coils that begin inside the circle, or so near to the entry that no piece remains
    """
    arcs = kernels.spiral_arc(2.0 * math.pi * turns) - kernels.spiral_arc(2.0 * math.pi * inner / pitch)
    coil = pitch / (2.0 * math.pi) * arcs
    if turns * pitch <= radius or coil < LENGTH_MIN:
        rule, least = "must be more than {least}, so that the coil begins outside the circle", radius / pitch
        raise InvalidValue("start_turns", rule, got=Quantity(turns, "turns"), least=Quantity(least, "turns", 6))
    return coil


def _refuse_arcs(
    arcs: Arcs, ratio: float, radius: float, entry_radius: float | None, exit_radius: float | None
) -> None:
    """Refuse impossible arcs, by the ratio if equal arcs would be possible, else by the exit, the entry or the circle;
    and arcs that leave the circle, which only a free exit makes possible."""
    radii, angles = arcs.radii, arcs.angles
    values = quantities("m", 6, high=SIZE_MAX, least=LENGTH_MIN)
    sizes = {"exit_radius": exit_radius, "entry_radius": entry_radius, "turning_radius": radius}
    name, got = next((name, Quantity(size, "m")) for name, size in sizes.items() if size is not None)
    shorter = min(r * angle for r, angle in zip(radii, angles, strict=True))
    if not (min(radii) >= SIZE_MIN and max(radii) <= SIZE_MAX and shorter >= LENGTH_MIN):
        rule = (
            "must leave arcs with radii from {low} to {high}, {least} long, not radii of {r1} and {r2} and a "
            "shorter arc of {shorter}"
        )
        values |= quantities("", 6, low=SIZE_MIN, r1=radii[0]) | quantities("m", 6, r2=radii[1], shorter=shorter)
        equal = 0.5 * sum(radii)
        if SIZE_MIN <= equal <= SIZE_MAX and equal * min(angles) >= LENGTH_MIN:
            name, got = "ratio", Quantity(ratio, "")
        raise InvalidValue(name, rule, got=got, **values)
    if exit_radius is not None and arcs.extent > radius + OUTSIDE:
        rule = "must leave the arcs inside the circle: they are up to {extent} from its centre, more than {radius}"
        values = quantities("m", 6, extent=arcs.extent, radius=radius)
        raise InvalidValue(name, rule, got=got, **values)


def _angle(vector: Floats) -> float:
    return math.atan2(vector[1], vector[0])


def _point(vector: Floats) -> Point:
    return (float(vector[0]), float(vector[1]))
