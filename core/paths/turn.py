"""The turn: two tangent arcs from a coil inwards to a coil outwards, its rotation by half a revolution."""

from __future__ import annotations

import math

import numpy as np

from core import kernels
from core.errors import SIZE_MAX, SIZE_MIN, InvalidValue, Quantity, checked_number, checked_size, quantities
from core.paths.pieces import LENGTH_MIN, Arc, Coil
from core.paths.route import Route
from core.shown import TABLE_DIGITS, worded
from core.values import Floats, Point

RATIO_MIN = 0.01
RATIO_MAX = 100.0


# Places of the arcs.
# At the entry E, |E| = R, the direction of travel T makes the angle gamma with the circle, tan gamma = 1 / theta,
# where theta is the polar angle. By symmetry the dance leaves at -E in the same direction T. With n the normal to the
# right of T, the centres are C1 = E + r1 n and C2 = -E - r2 n, and the arcs touch if |C1 - C2| = r1 + r2 =: S:
#     |2 E + S n|^2 = S^2   =>   S = |E|^2 / (-E . n) = R / cos gamma = R sqrt(1 + theta^2) / theta,
# for every ratio; so r1 = S ratio / (1 + ratio), r2 = S / (1 + ratio). The triangles O C1 E and O C2 (-E) show that
# both arcs turn by the same angle alpha, so the length S alpha does not depend on the ratio either.
class Turn(Route):
    """Two tangent arcs, tangent to the incoming coil and to the outgoing one, its rotation by 180 degrees.

    A route of four pieces: the coil inwards, two arcs, first clockwise, then counter-clockwise, and the coil outwards;
    s = 0 at the entry.
    pitch [m]; turning_radius [m]; ratio: radius of the first arc over that of the second; start_turns: of both coils
    entry_radius: radius at the beginning of the turn [m], at most the turning radius, which is its default
    radii [m]; centres [m]; angles: turned on each arc [rad]; entry, tangent_point, exit [m]; length: of both arcs [m]
    raises: InvalidValue

    >>> [round(radius, 9) for radius in Turn(1.7).radii]
    [3.005417668, 1.502708834]
    """

    def __init__(
        self,
        pitch: float,
        turning_radius: float = 4.5,
        ratio: float = 2.0,
        *,
        start_turns: float = 16.0,
        entry_radius: float | None = None,
    ) -> None:
        pitch = checked_size("pitch", pitch)
        radius = checked_size("turning_radius", turning_radius)
        ratio = checked_number("ratio", ratio, "", RATIO_MIN, RATIO_MAX)
        inner = radius if entry_radius is None else checked_number("entry_radius", entry_radius, "m", 1e-3, radius)
        turns = checked_number("start_turns", start_turns, "turns", 0.0, 1e5, open_low=True)
        theta, outer = 2.0 * math.pi * inner / pitch, 2.0 * math.pi * turns
        coil = pitch / (2.0 * math.pi) * (kernels.spiral_arc(outer) - kernels.spiral_arc(theta))
        if turns * pitch <= radius or coil < LENGTH_MIN:
            rule, least = (
                "must be more than {least}, so that the coil begins outside the circle",
                radius / pitch,
            )
            raise InvalidValue("start_turns", rule, got=Quantity(turns, "turns"), least=Quantity(least, "turns", 6))
        cos, sin, stretch = math.cos(theta), math.sin(theta), math.hypot(1.0, theta)
        entry = inner * np.array([cos, sin])
        ahead = np.array([theta * sin - cos, -theta * cos - sin]) / stretch
        right = np.array([ahead[1], -ahead[0]])
        total = inner * stretch / theta
        radii = (total * ratio / (1.0 + ratio), total / (1.0 + ratio))
        first, second = entry + radii[0] * right, -entry - radii[1] * right
        middle = first + (second - first) * (radii[0] / total)
        start, end = _angle(entry - first), _angle(middle - first)
        begin, finish = _angle(middle - second), _angle(-entry - second)
        angles = ((start - end) % (2.0 * math.pi), (finish - begin) % (2.0 * math.pi))
        _refuse_arcs(radii, angles, ratio, radius, entry_radius)
        here = inner / pitch
        pieces = (
            Coil(pitch, turns, here),
            Arc(_point(first), radii[0], start, -angles[0]),
            Arc(_point(second), radii[1], begin, angles[1]),
            Coil(pitch, here, turns, rotation=math.pi),
        )
        try:
            super().__init__(pieces, start=Route(pieces).joints[0])
        except InvalidValue as error:  # every piece is valid, and every joint closes
            rule, long = "must be smaller: no route may be {coil} long before its s = 0", Quantity(coil, "m", 6)
            raise InvalidValue("start_turns", rule, got=Quantity(turns, "turns"), coil=long) from error
        self.pitch, self.turning_radius, self.ratio, self.entry_radius = pitch, radius, ratio, inner
        self.radii, self.centres, self.angles = radii, (_point(first), _point(second)), angles
        self.entry, self.tangent_point, self.exit = _point(entry), _point(middle), _point(-entry)
        self.length = radii[0] * angles[0] + radii[1] * angles[1]
        self.start_turns = turns

    @property
    def _given(self) -> tuple[object, ...]:
        return *super()._given, self.turning_radius

    def __repr__(self) -> str:
        deeper = f", entry_radius={self.entry_radius!r}" if self.entry_radius != self.turning_radius else ""
        given = f"{self.pitch!r}, {self.turning_radius!r}, {self.ratio!r}, start_turns={self.start_turns!r}{deeper}"
        return f"Turn({given})"

    def _rows(self) -> list[tuple[str, str]]:
        units = dict.fromkeys(("pitch", "turning_radius", "entry_radius", "radii", "length"), "m")
        units |= {"ratio": "", "angles": "rad"} | dict.fromkeys(("centres", "entry", "tangent_point", "exit"), "m")
        named = [(name, getattr(self, name), unit) for name, unit in units.items()]
        return [(name.replace("_", " "), worded(value, unit, TABLE_DIGITS)) for name, value, unit in named]


def _refuse_arcs(radii: Point, angles: Point, ratio: float, radius: float, entry_radius: float | None) -> None:
    """Refuse impossible arcs by the wrong parameter: the ratio if equal arcs would be possible."""
    shorter = min(r * angle for r, angle in zip(radii, angles, strict=True))
    if min(radii) >= SIZE_MIN and max(radii) <= SIZE_MAX and shorter >= LENGTH_MIN:
        return
    rule = "must leave arcs with radii from {low} to {high}, {least} long, not radii of {r1} and {r2}"
    rule += " and a shorter arc of {shorter}"
    told = quantities("", 6, low=SIZE_MIN, r1=radii[0])
    told |= quantities("m", 6, high=SIZE_MAX, least=LENGTH_MIN, r2=radii[1], shorter=shorter)
    equal = 0.5 * sum(radii)
    if SIZE_MIN <= equal <= SIZE_MAX and equal * min(angles) >= LENGTH_MIN:
        raise InvalidValue("ratio", rule, got=Quantity(ratio, ""), **told)
    name, given = ("turning_radius", radius) if entry_radius is None else ("entry_radius", entry_radius)
    raise InvalidValue(name, rule, got=Quantity(given, "m"), **told)


def _angle(vector: Floats) -> float:
    return math.atan2(vector[1], vector[0])


def _point(vector: Floats) -> Point:
    return (float(vector[0]), float(vector[1]))
