"""Course: the points of a path for a drawing, with the bends that are too tight for a dragon."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from core.checks import checked_type
from core.display import WithArrays, display
from core.dragon import Dragon
from core.language import counted, say
from core.paths.following import Hindrance, following, least_radius, tightest_bend
from core.paths.route import Route
from core.paths.spiral import Spiral
from core.values import Floats

# Distance between drawn points [m], and their largest number: a path longer than 750 m is drawn more coarsely.
STEP, POINTS_MAX = 0.25, 3_000
# Points along a bend that is too tight.
BEND_POINTS = 24


@dataclass(frozen=True, slots=True, repr=False, eq=False)
class TightBend(WithArrays):
    """A part of a path that curves too tightly for a bench; for angles of benches see SharpestBend.

    start: start of the stretch, along the path [m]
    end: end of the stretch, along the path [m]
    points: points along it, x and y [m]
    radius: least radius there; of a curve through waypoints, at least this [m]
    least_radius: least radius that this bench can follow on bends of any length [m]
    bench: the first bench that cannot follow
    reason: what would happen to its rear handle

    >>> from core import Legs
    >>> course(Legs([(0, 0), (20, 0), (12, 20)], [0, 1], radius=0.5), Dragon()).bends[0].radius
    0.5
    """

    start: float
    end: float
    points: Floats
    radius: float
    least_radius: float
    bench: int
    reason: Hindrance

    def _line(self) -> str:
        values = {"radius": display(self.radius, "m"), "start": display(self.start), "end": display(self.end, "m")}
        return say("radius {radius} from s = {start} to {end}", **values)


@dataclass(frozen=True, slots=True, repr=False, eq=False)
class Course(WithArrays):
    """The points of a path for a drawing.

    s: arc length along the path of P points, 0 where the head is at time 0 [m]
    points: the points, (P, 2), x and y [m]
    length: length of the path [m]
    knots: arc length of each waypoint (for a rounded corner, of its middle); empty for other paths [m]
    bends: bends that are too tight, along the path

    >>> from core import Line
    >>> drawn = course(Route([Line((0.0, 0.0), (30.0, 0.0))]), Dragon(5))
    >>> drawn.length, drawn.bends
    (30.0, ())
    """

    s: Floats
    points: Floats
    length: float
    knots: Floats
    bends: tuple[TightBend, ...]

    def _line(self) -> str:
        bends = counted(len(self.bends), "{count} bend too tight", "{count} bends too tight")
        return f"{display(self.length, 'm')}, {bends}"


def course(path: Spiral | Route, dragon: Dragon) -> Course:
    """The path from its beginning to its end, and its bends that are too tight for the dragon.

    A bend is too tight where a bench that reaches over it would jump, stand across the path or go backwards
    (core/paths/following.py). On a spiral there is none: its dance ends in a fold.

    >>> from core import Legs
    >>> course(Legs([(0, 0), (20, 0), (12, 20)], [0, 1], radius=0.5), Dragon()).bends
    (<TightBend: radius 0.5 m from s = 19.2614835 to 20.2371349 m>,)
    """
    checked_type("path", path, (Spiral, Route))
    checked_type("dragon", dragon, Dragon)
    length = path.end - path.begin
    s = np.linspace(path.begin, path.end, min(int(length / STEP) + 2, POINTS_MAX))
    tight = path.tighter(tightest_bend(dragon)[0])
    obstacles = following(dragon, path.as_route(path.end)).obstacles if tight else ()
    bends = []
    for start, end, sharpest in tight:
        met = next((one for one in obstacles if one.rear <= end and one.s >= start), None)
        if met is not None:
            points = path.position(np.linspace(start, end, BEND_POINTS))
            radius, least = 1.0 / sharpest, least_radius(met.chord)
            bends.append(TightBend(start, end, points, radius, least, met.bench, met.reason))
    return Course(s, path.position(s), length, path.knots, tuple(bends))
