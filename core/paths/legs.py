"""Legs: a route through points; each leg between two of them is a smooth curve or a straight line."""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import cached_property
from itertools import pairwise

import numpy as np

from core import kernels
from core.checks import SIZE_MAX, checked_list, checked_number, checked_size
from core.display import REPR_MOST, Readable
from core.errors import InvalidValue
from core.kernels import Budget
from core.paths.pieces import LENGTH_MIN, WAYPOINT_GAP, Arc, Line, Piece, Waypoints, checked_points, point_too_near
from core.paths.route import CORNER_END, Route, too_sharp
from core.quantities import Given
from core.values import Floats, Point

# Default radius of an arc at a corner [m].
RADIUS = 5.0
# Smallest angle between two straight legs that counts as a corner [rad]: joints may kink by ten times as much
# (JOINT_KINK).
CORNER_MIN = 1e-10
# Smallest half angle between two straight legs [rad]: a dragon cannot reverse on the spot.
BACK_MIN = 1e-3
# Largest share of a straight leg that a corner may take [1]: the direction of the rest must survive rounding.
CUT_MOST = 0.49
# Largest distance between the end of a cubic and its waypoint [m]: rounding, far below WAYPOINT_GAP.
AT_WAYPOINT = 1e-6


class Legs(Route):
    """A route through points, smooth everywhere but at corners without an arc.

    points: (x, y) [m]; straight: the legs that are straight, leg k from point k to point k + 1; the others are curves
    radius: of the arcs at corners between two straight legs [m]; smaller if a leg is too short for it; 0 leaves corners
        of less than CORNER_END as they are
    start_heading, end_heading: direction at an end with a curved leg [rad]; None: no curvature at that end
    start: distance of the head from the beginning at time 0 [m]
    raises: InvalidValue naming the point or the leg; TooMuchWork

    Consecutive curved legs are one smooth curve that leaves and enters the straight legs beside it in their direction.

    >>> [type(piece).__name__ for piece in Legs([(0, 0), (20, 0), (20, 20)], [0, 1]).pieces]
    ['Line', 'Arc', 'Line']
    """

    def __init__(
        self,
        points: Sequence[Point],
        straight: Sequence[int] = (),
        *,
        radius: float = RADIUS,
        start_heading: float | None = None,
        end_heading: float | None = None,
        start: float = 0.0,
        budget: Budget | None = None,
    ) -> None:
        self.points = checked_points("path.points", points)
        self.straight = _checked_legs(straight, len(self.points) - 1)
        self.radius = _checked_radius(radius)
        _refuse_near(self.points)
        self._headings = start_heading, end_heading
        pieces, firsts = self._laid_out(start_heading, end_heading)
        try:
            super().__init__(pieces, start, budget=budget)
        except InvalidValue as error:
            raise _by_point(error, firsts) from error

    def __repr__(self) -> str:
        arguments = f"{list(self.points)!r}, {sorted(self.straight)!r}, radius={self.radius!r}, start={self.start!r}"
        names = zip(("start_heading", "end_heading"), self._headings, strict=True)
        text = f"Legs({arguments}{''.join(f', {name}={value!r}' for name, value in names if value is not None)})"
        return text if len(text) <= REPR_MOST else Readable.__repr__(self)

    def rounded(self, radius: float) -> Legs:
        """The same legs with another radius [m] at their corners."""
        first, last = self._headings
        return Legs(self.points, sorted(self.straight), radius=radius, start_heading=first, end_heading=last)

    def _laid_out(self, start_heading: float | None, end_heading: float | None) -> tuple[list[Piece], list[int]]:
        """Lines, arcs and curves in the order of the dance, and the first point of each."""
        points, straight, last = self.points, self.straight, len(self.points) - 2
        pieces: list[Piece] = []
        firsts: list[int] = []
        k, begin = 0, points[0]
        while k <= last:
            if k not in straight:
                end = next((leg for leg in range(k, last + 1) if leg in straight), last + 1)
                headings = (
                    _heading(points[k - 1], points[k]) if k else start_heading,
                    _heading(points[end], points[end + 1]) if end <= last else end_heading,
                )
                pieces.append(Waypoints(points[k : end + 1], *headings))
                firsts.append(k)
                k, begin = end, points[end]
                continue
            corner = None
            if k + 1 in straight and self.radius == 0.0:
                _refuse_sharp(k + 1, points[k : k + 3])
            elif k + 1 in straight:
                corner = _rounded(k + 1, points[k], points[k + 1], points[k + 2], self.radius)
            pieces.append(Line(begin, points[k + 1] if corner is None else corner[0]))
            firsts.append(k)
            begin = points[k + 1]
            if corner is not None:
                firsts.append(k + 1)
                pieces.append(corner[1])
                begin = corner[2]
            k += 1
        return pieces, firsts

    @cached_property
    def knots(self) -> Floats:
        """s of every point (N,) [m]; for a rounded corner the middle of its arc."""
        places = [self.begin]
        ends = [self.begin, *self.joints, self.end]
        for k, (piece, (begin, end)) in enumerate(zip(self.pieces, pairwise(ends), strict=True)):
            if isinstance(piece, Arc):
                places.append(0.5 * (begin + end))
            elif isinstance(piece, Waypoints):
                places += self._between(k, piece.points[1:-1])
            if not isinstance(piece, Arc) and not isinstance(next(iter(self.pieces[k + 1 :]), None), Arc):
                places.append(end)
        knots = np.array(places)
        knots.flags.writeable = False
        return knots

    def _between(self, k: int, points: tuple[Point, ...]) -> list[float]:
        """s of the inner points of the curve in piece k [m], which are ends of cubics."""
        ends = self.table[self.table[:, kernels.PART] == k, kernels.S_END]
        places, between, row = self.position(ends), [], 0
        for x, y in points:
            row += int(np.argmax(np.hypot(*(places[row:] - (x, y)).T) < AT_WAYPOINT))
            between.append(float(ends[row]))
            row += 1
        return between


def _checked_radius(radius: float) -> float:
    """A radius of arcs, or 0 for none."""
    number = checked_number("path.radius", radius, "m", 0.0, SIZE_MAX)
    return number if number == 0.0 else checked_size("path.radius", number)


def _refuse_sharp(k: int, points: tuple[Point, ...]) -> None:
    """Refuse a corner in point k that no bench can follow. points: the three around it"""
    before, after = (_heading(*ends) for ends in pairwise(points))
    angle = abs(math.remainder(after - before, math.tau))
    if angle >= CORNER_END:
        raise too_sharp(f"path.points.{k}", angle)


def _checked_legs(straight: Sequence[int], legs: int) -> frozenset[int]:
    """The straight legs, each a whole number below the number of legs. raises: InvalidValue"""
    chosen = checked_list("path.straight", straight, "must be a list of legs")
    for k, leg in enumerate(chosen):
        name = f"path.straight.{k}"
        if checked_number(name, leg, "", 0, legs - 1) != int(leg):
            raise InvalidValue(name, "must be a whole number", got=Given(leg))
    return frozenset(map(int, chosen))


def _by_point(error: InvalidValue, firsts: list[int]) -> InvalidValue:
    """A refusal of one piece, with the numbers of the path's points instead of the piece's."""
    if not error.field.startswith("path.pieces."):
        return error
    first = firsts[int(error.field.split(".")[2])]
    points = {word: first + point for word, point in error.values.items() if isinstance(point, int)}
    return error.renamed(lambda _: "path.points", **points)


def _refuse_near(points: tuple[Point, ...]) -> None:
    for k, (a, b) in enumerate(pairwise(points), start=1):
        gap = math.dist(a, b)
        if gap < WAYPOINT_GAP:
            name = f"path.points.{k}"
            raise point_too_near(name, gap)


def _heading(a: Point, b: Point) -> float:
    return math.atan2(b[1] - a[1], b[0] - a[0])


# With phi the change of direction at b, an arc of radius r touches both legs at r tan(phi / 2) from b. A corner takes
# at most CUT_MOST of the length of a leg, so that a line remains between two corners.
def _rounded(k: int, a: Point, b: Point, c: Point, radius: float) -> tuple[Point, Arc, Point] | None:
    """The arc at the corner in point k, b, with its first and last point; None if the path is straight there.

    raises: InvalidValue if the path reverses there
    """
    into, out = math.dist(a, b), math.dist(b, c)
    u, v = ((b[0] - a[0]) / into, (b[1] - a[1]) / into), ((c[0] - b[0]) / out, (c[1] - b[1]) / out)
    angle = math.atan2(u[0] * v[1] - u[1] * v[0], u[0] * v[0] + u[1] * v[1])
    if abs(angle) < CORNER_MIN:
        return None
    if math.pi - abs(angle) < 2.0 * BACK_MIN:
        name = f"path.points.{k}"
        raise InvalidValue(name, "must not be where two straight legs turn back: make one of them a curve")
    half = math.tan(0.5 * abs(angle))
    cut = min(max(radius * half, LENGTH_MIN), CUT_MOST * min(into, out))
    arc_radius, side = cut / half, math.copysign(1.0, angle)
    begin, end = (b[0] - cut * u[0], b[1] - cut * u[1]), (b[0] + cut * v[0], b[1] + cut * v[1])
    centre = (begin[0] - side * arc_radius * u[1], begin[1] + side * arc_radius * u[0])
    from_centre = math.atan2(begin[1] - centre[1], begin[0] - centre[0])
    return begin, Arc(centre, arc_radius, from_centre, angle), end
