"""Pieces of a route: lines, arcs, coils, clothoids, and smooth curves through waypoints."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from core import kernels
from core.checks import SIZE_MIN, checked_angle, checked_list, checked_number, checked_point, checked_size
from core.display import REPR_MOST, Readable
from core.error_free import two_product, two_sum
from core.errors import InvalidValue
from core.kernels import Budget
from core.kernels.constants import (
    COIL_ARC_LOW,
    COIL_GROWTH_LOW,
    K_END,
    K_RATE,
    K_SLOPE,
    K_START,
    LINE_DX,
    LINE_DY,
    LINE_X,
    LINE_Y,
    PIECE_KIND,
    POINT_CURVATURE,
    PX,
    PY,
    S_END,
    S_END_LOW,
    S_START,
    S_START_LOW,
    TX,
    TY,
)
from core.language import say
from core.paths.cubics import cut
from core.quantities import Quantity, quantities
from core.values import Floats, Point

# Least distance between two consecutive waypoints [m]: nearer ones are a mistake.
WAYPOINT_GAP = 1e-3
# Least length of a piece [m]: the direction of a shorter one is lost in rounding.
LENGTH_MIN = 1e-6
# Largest curvature at an end of a clothoid [1/m]: a radius of SIZE_MIN.
CURVATURE_MAX = 1.0 / SIZE_MIN
# Most that a clothoid turns at the sharper of its two curvatures [rad]: 4,000 rows ...
TURN_MAX = 1e3
# ... of which each turns by this so [rad]: core/kernels/clothoid.py builds on it.
ROW_TURN = 0.25

_KINDS = {name: float(code) for code, name in enumerate(kernels.PIECE_KINDS)}


def _settle(piece: object, **checked: float | Point | tuple[Point, ...]) -> None:
    """Put checked values into a frozen piece."""
    for name, value in checked.items():
        object.__setattr__(piece, name, value)


def point_too_near(name: str, gap: float) -> InvalidValue:
    """The error for a point at this distance from the one before it [m]."""
    rule, least = "must be at least {least} from the point before it", Quantity(WAYPOINT_GAP, "m", 6)
    return InvalidValue(name, rule, got=Quantity(gap, "m", 6), least=least)


def checked_points(name: str, value: object) -> tuple[Point, ...]:
    """The value as two points or more. raises: InvalidValue"""
    points = checked_list(name, value, "must be a list of points [x, y] in metres")
    if len(points) < 2:
        raise InvalidValue(name, "must be at least 2 points", got=len(points))
    return tuple(checked_point(f"{name}.{k}", point) for k, point in enumerate(points))


def _row(kind: str, start: float, length: Point, curvature: Point, *parameters: float, slope: float = 0.0) -> Floats:
    """The row of a piece from an arc length on. length: in double-double, so that the next piece begins at its end"""
    row = np.zeros((1, kernels.PIECE_COLUMNS))
    end, low = two_sum(start, length[0])
    known = (_KINDS[kind], start, end, *curvature, *parameters)
    row[0, : len(known)], row[0, kernels.K_SLOPE], row[0, S_END_LOW] = known, slope, low + length[1]
    return row


@dataclass(frozen=True)
class Line(Readable):
    """A straight piece.

    start: its start, x and y [m]
    end: its end, x and y [m]

    >>> from core import Route
    >>> Route([Line((0.0, 0.0), (3.0, 4.0))]).end
    5.0
    """

    start: Point
    end: Point

    def __post_init__(self) -> None:
        _settle(self, start=checked_point("line.start", self.start), end=checked_point("line.end", self.end))

    def rows(self, name: str, s: float, budget: Budget) -> Floats:
        """Rows of the kernels' table from arc length s on."""
        (x, y), end = self.start, self.end
        length = math.hypot(end[0] - x, end[1] - y)
        _refuse_short(name, length)
        dx, dy = (end[0] - x) / length, (end[1] - y) / length
        return _row("line", s, (length, 0.0), (0.0, 0.0), x, y, dx, dy)


@dataclass(frozen=True)
class Arc(Readable):
    """Part of a circle.

    centre: centre, x and y [m]
    radius: radius [m]
    start_angle: direction of its start from the centre [rad]
    sweep: angle that it sweeps, counter-clockwise positive [rad]

    >>> from core import Route
    >>> quarter = Arc(centre=(0.0, 0.0), radius=2.0, start_angle=0.0, sweep=math.pi / 2)
    >>> round(Route([quarter]).end, 6)
    3.141593
    """

    centre: Point
    radius: float
    start_angle: float
    sweep: float

    def __post_init__(self) -> None:
        _settle(self, centre=checked_point("arc.centre", self.centre), radius=checked_size("arc.radius", self.radius))
        _settle(self, start_angle=checked_angle("arc.start_angle", self.start_angle))
        _settle(self, sweep=checked_angle("arc.sweep", self.sweep))

    def rows(self, name: str, s: float, budget: Budget) -> Floats:
        """Rows of the kernels' table from arc length s on."""
        (x, y), radius, angle, sweep = self.centre, self.radius, self.start_angle, self.sweep
        _refuse_short(name, radius * abs(sweep))
        sign = math.copysign(1.0, sweep)
        curvature = sign / radius
        length = two_product(radius, abs(sweep))
        return _row("arc", s, length, (curvature, curvature), x, y, radius, angle, sign)


@dataclass(frozen=True)
class Coil(Readable):
    """Part of an Archimedean spiral: inwards (clockwise) or outwards (counter-clockwise).

    pitch: radial advance per full turn [m]
    start_turns: turns from its centre at its beginning [turns]
    end_turns: turns from its centre at its end [turns]
    centre: centre, x and y [m]
    rotation: rotation of the whole spiral [rad]

    >>> from core import Route
    >>> inwards = Coil(pitch=0.55, start_turns=4.0, end_turns=3.0)
    >>> round(Route([inwards]).end, 4)
    12.1077
    """

    pitch: float
    start_turns: float
    end_turns: float
    centre: Point = (0.0, 0.0)
    rotation: float = 0.0

    def __post_init__(self) -> None:
        _settle(self, pitch=checked_size("coil.pitch", self.pitch), centre=checked_point("coil.centre", self.centre))
        _settle(self, start_turns=checked_number("coil.start_turns", self.start_turns, "turns", 0.0, 1e5))
        _settle(self, end_turns=checked_number("coil.end_turns", self.end_turns, "turns", 0.0, 1e5))
        _settle(self, rotation=checked_angle("coil.rotation", self.rotation))

    def rows(self, name: str, s: float, budget: Budget) -> Floats:
        """Rows of the kernels' table from arc length s on."""
        growth, growth_low = kernels.growth_pair(self.pitch)
        start, end = 2.0 * math.pi * self.start_turns, 2.0 * math.pi * self.end_turns
        (x, y), rotation = self.centre, self.rotation
        arc, arc_low = kernels.coil_arc(self.pitch, self.start_turns)
        end_arc, end_low = kernels.coil_arc(self.pitch, self.end_turns)
        _refuse_short(name, abs(end_arc - arc))
        sign = 1.0 if end > start else -1.0
        way, lost = two_sum(end_arc, -arc)
        length = sign * way, sign * (lost + (end_low - arc_low))
        curvatures = (sign * kernels.spiral_curvature(start) / growth, sign * kernels.spiral_curvature(end) / growth)
        slope = kernels.steepest_curvature(min(start, end)) / growth**2
        row = _row("spiral", s, length, curvatures, x, y, growth, rotation, sign, arc, slope=slope)
        row[0, COIL_ARC_LOW], row[0, COIL_GROWTH_LOW] = arc_low, growth_low
        return row


@dataclass(frozen=True)
class Clothoid(Readable):
    """A curve whose curvature changes evenly along it.

    start: where it starts, x and y [m]
    heading: direction at its start [rad]
    start_curvature: curvature at its start, counter-clockwise positive [1/m]
    end_curvature: curvature at its end, counter-clockwise positive [1/m]
    length: length [m]
    end: where it ends, x and y [m]
    end_heading: direction at its end [rad]

    >>> ramp = Clothoid((0, 0), 0.0, 0.0, 0.5, 2.0)
    >>> [round(number, 9) for number in (*ramp.end, ramp.end_heading)]
    [1.950575376, 0.327428095, 0.5]
    """

    start: Point
    heading: float
    start_curvature: float
    end_curvature: float
    length: float

    def __post_init__(self) -> None:
        _settle(self, start=checked_point("clothoid.start", self.start))
        _settle(self, heading=checked_angle("clothoid.heading", self.heading))
        for name in ("start_curvature", "end_curvature"):
            curvature = checked_number(f"clothoid.{name}", getattr(self, name), "1/m", -CURVATURE_MAX, CURVATURE_MAX)
            _settle(self, **{name: curvature})
        _settle(self, length=checked_size("clothoid.length", self.length))
        if self._most_turned > TURN_MAX:
            rule = "must be at most {most}, where it would turn by {turn} at the larger of its curvatures"
            most, turn = self.length * TURN_MAX / self._most_turned, Quantity(TURN_MAX, "rad", 6)
            raise InvalidValue("clothoid.length", rule, turn=turn, **quantities("m", 6, got=self.length, most=most))

    @property
    def end(self) -> Point:
        """Where it ends (x, y) [m]."""
        x, y = self._joints[-1, PX : PY + 1].tolist()
        return x, y

    @property
    def end_heading(self) -> float:
        """Direction in which it ends [rad]."""
        return self.heading + 0.5 * (self.start_curvature + self.end_curvature) * self.length

    @property
    def grows(self) -> bool:
        """True if it only bends more and more to one side."""
        first, last = self.start_curvature, self.end_curvature
        return first * last >= 0.0 and abs(first) <= abs(last)

    @property
    def _most_turned(self) -> float:
        """Angle by which it would turn at the larger of its curvatures [rad]."""
        return max(abs(self.start_curvature), abs(self.end_curvature)) * self.length

    @cached_property
    def _places(self) -> Floats:
        """Where its rows meet, and its ends, along it (rows + 1,) [m]."""
        rows = max(1, math.ceil(self._most_turned / ROW_TURN))
        return self.length * (np.arange(rows + 1.0) / rows)

    @cached_property
    def _joints(self) -> Floats:
        """Its points there (rows + 1, POINT_COLUMNS)."""
        joints = np.empty((len(self._places), kernels.POINT_COLUMNS))
        bends = self.start_curvature, self.end_curvature, self.length
        kernels.clothoid_joints(*self.start, self.heading, *bends, self._places, joints)
        return joints

    def rows(self, name: str, s: float, budget: Budget) -> Floats:
        """Rows of the kernels' table from arc length s on."""
        joints, slope = self._joints, (self.end_curvature - self.start_curvature) / self.length
        rows = np.zeros((len(joints) - 1, kernels.PIECE_COLUMNS))
        budget.afford(float(len(rows)))
        rows[:, PIECE_KIND], rows[:, K_RATE], rows[:, K_SLOPE] = kernels.CLOTHOID, slope, abs(slope)
        rows[:, [LINE_X, LINE_Y, LINE_DX, LINE_DY, K_START]] = joints[:-1][:, [PX, PY, TX, TY, POINT_CURVATURE]]
        rows[:, K_END] = joints[1:, POINT_CURVATURE]
        ends, lost = two_sum(np.full(len(joints), s), self._places)
        rows[:, S_START], rows[:, S_END] = ends[:-1], ends[1:]
        rows[:, S_START_LOW], rows[:, S_END_LOW] = lost[:-1], lost[1:]
        return rows


@dataclass(frozen=True, repr=False)
class Waypoints(Readable):
    """A smooth curve through points: the cubic spline over the length of its polygon, curvature-continuous.

    points: the points, x and y [m]
    start_heading: direction at its start; None: no curvature there [rad]
    end_heading: direction at its end; None: no curvature there [rad]

    >>> from core import Route
    >>> round(Route([Waypoints(((0.0, 0.0), (10.0, 3.0), (20.0, 0.0)))]).end, 3)
    21.042
    """

    points: tuple[Point, ...]
    start_heading: float | None = None
    end_heading: float | None = None

    def __post_init__(self) -> None:
        _settle(self, points=checked_points("waypoints.points", self.points))
        for name in ("start_heading", "end_heading"):
            if (heading := getattr(self, name)) is not None:
                _settle(self, **{name: checked_angle(f"waypoints.{name}", heading)})

    def __repr__(self) -> str:
        text = f"Waypoints({self.points!r}, {self.start_heading!r}, {self.end_heading!r})"
        return text if len(text) <= REPR_MOST else super().__repr__()

    def _line(self) -> str:
        first, last = repr(self.points[0]), repr(self.points[-1])
        return say("{count} points from {first} to {last} m", count=len(self.points), first=first, last=last)

    def rows(self, name: str, s: float, budget: Budget) -> Floats:
        """Rows of the kernels' table from arc length s on: as many cubics as exact arc lengths need."""
        from scipy.interpolate import CubicSpline  # type: ignore[import-untyped]

        points = np.array(self.points)
        headings = (self._end(self.start_heading), self._end(self.end_heading))
        steps = np.hypot(*np.diff(points, axis=0).T)
        short = np.flatnonzero(steps < WAYPOINT_GAP)
        if short.size:
            k = int(short[0])
            raise point_too_near(f"{name}.points.{k + 1}", float(steps[k]))
        knots = np.concatenate([[0.0], np.cumsum(steps)])
        spline = CubicSpline(knots, points, bc_type=headings)
        rows = cut(f"{name}.points", np.moveaxis(spline.c[::-1], 1, 0), np.diff(knots), budget)
        lengths = rows[:, S_END].copy()
        ends = np.cumsum([s, *lengths])
        lost = np.cumsum(two_sum(ends[:-1], lengths)[1])
        rows[:, S_START], rows[:, S_END] = ends[:-1], ends[1:]
        rows[1:, S_START_LOW], rows[:, S_END_LOW] = lost[:-1], lost
        return rows

    @staticmethod
    def _end(heading: float | None) -> tuple[int, Floats]:
        if heading is None:
            return 2, np.zeros(2)
        return 1, np.array([math.cos(heading), math.sin(heading)])


Piece = Line | Arc | Coil | Clothoid | Waypoints


def _refuse_short(name: str, length: float) -> None:
    if length < LENGTH_MIN:
        least = Quantity(LENGTH_MIN, "m", 6)
        raise InvalidValue(name, "must be at least {least} long", got=Quantity(length, "m", 6), least=least)
