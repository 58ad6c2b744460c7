"""Route: pieces joined into one path by arc length; the position and the tangent of every joint are checked."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from core import kernels
from core.budget import Budget, Halted
from core.errors import InvalidValue, said
from core.paths.cubics import cut
from core.paths.path import HeadState
from core.shown import REPR_MOST, TABLE_DIGITS, Shown, counted, worded
from core.values import Floats, checked_number, checked_size

# Coordinates beyond this lose the digits that the chords need [m].
COORDINATE_MAX = 1e5
# Largest distance from its start to which a route is drawn [m], and the number of points.
DRAWN = 2_000.0
DRAWN_POINTS = 20_000
# Largest gap [m] and kink [rad] of two joined pieces: rounding of coordinates up to 1 km.
JOINT_GAP = 1e-9
JOINT_KINK = 1e-9
# Least distance of two consecutive waypoints [m]: nearer ones are a slip of the hand.
WAYPOINT_GAP = 1e-3
# Least length of a piece [m]: the direction of a shorter one is lost in rounding.
LENGTH_MIN = 1e-6
# Angles beyond this lose the digits that the joints need [rad].
ANGLE_MAX = 1e6

# Kinds of pieces are listed one by one up to so many [1].
PIECES_LISTED = 6

Point = tuple[float, float]
_KINDS = {name: float(code) for code, name in enumerate(kernels.PIECE_KINDS)}


def checked_point(name: str, value: Any) -> Point:
    """The value as a point with both coordinates within COORDINATE_MAX.

    raises: InvalidValue
    """
    try:
        x, y = value
    except (TypeError, ValueError) as error:
        raise InvalidValue(name, f"{name} must be a point [x, y] in metres, got {value!r}") from error
    limits = (-COORDINATE_MAX, COORDINATE_MAX)
    return (checked_number(f"{name}.0", x, "m", *limits), checked_number(f"{name}.1", y, "m", *limits))


def _checked_angle(name: str, value: Any) -> float:
    return checked_number(name, value, "rad", -ANGLE_MAX, ANGLE_MAX)


def listed(name: str, value: Any, what: str) -> list[Any]:
    """The entries of a value that is a sequence and not a text.

    raises: InvalidValue naming the field and what it must be
    """
    try:
        if not isinstance(value, str | bytes | Mapping):
            return list(value)
    except TypeError:
        pass
    raise InvalidValue(name, f"{name} must be {what}, got {value!r}")


def _settle(piece: object, **checked: float | Point | tuple[Point, ...]) -> None:
    """Put checked values into a frozen piece."""
    for name, value in checked.items():
        object.__setattr__(piece, name, value)


def _row(kind: str, start: float, end: float, curvature: Point, *parameters: float, slope: float = 0.0) -> Floats:
    row = np.zeros((1, kernels.PIECE_COLUMNS))
    known = (_KINDS[kind], start, end, *curvature, *parameters)
    row[0, : len(known)], row[0, kernels.K_SLOPE] = known, slope
    return row


@dataclass(frozen=True)
class Line(Shown):
    """A straight piece from start to end, (x, y) [m]."""

    _units = {"start": "m", "end": "m"}  # noqa: RUF012

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
        return _row("line", s, s + length, (0.0, 0.0), x, y, dx, dy)


@dataclass(frozen=True)
class Arc(Shown):
    """Part of a circle: centre (x, y) [m], radius [m], start_angle [rad], sweep [rad].

    A positive sweep goes counter-clockwise.
    """

    centre: Point
    radius: float
    start_angle: float
    sweep: float

    def __post_init__(self) -> None:
        _settle(self, centre=checked_point("arc.centre", self.centre), radius=checked_size("arc.radius", self.radius))
        _settle(self, start_angle=_checked_angle("arc.start_angle", self.start_angle))
        _settle(self, sweep=_checked_angle("arc.sweep", self.sweep))

    def rows(self, name: str, s: float, budget: Budget) -> Floats:
        """Rows of the kernels' table from arc length s on."""
        (x, y), radius, angle, sweep = self.centre, self.radius, self.start_angle, self.sweep
        _refuse_short(name, radius * abs(sweep))
        sign = math.copysign(1.0, sweep)
        curvature = sign / radius
        return _row("arc", s, s + radius * abs(sweep), (curvature, curvature), x, y, radius, angle, sign)


@dataclass(frozen=True)
class Coil(Shown):
    """Part of an Archimedean spiral between two turns: inwards (clockwise) or outwards (counter-clockwise).

    pitch: [m]; start_turns, end_turns: turns from its centre, danced from the first to the second
    centre: (x, y) [m]; rotation: of the whole spiral [rad]
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
        _settle(self, rotation=_checked_angle("coil.rotation", self.rotation))

    def rows(self, name: str, s: float, budget: Budget) -> Floats:
        """Rows of the kernels' table from arc length s on."""
        growth = self.pitch / (2.0 * math.pi)
        start, end = 2.0 * math.pi * self.start_turns, 2.0 * math.pi * self.end_turns
        (x, y), rotation = self.centre, self.rotation
        arc, end_arc = growth * kernels.spiral_arc(start), growth * kernels.spiral_arc(end)
        _refuse_short(name, abs(end_arc - arc))
        sign = 1.0 if end > start else -1.0
        curvatures = (sign * kernels.spiral_curvature(start) / growth, sign * kernels.spiral_curvature(end) / growth)
        slope = kernels.steepest_bend(min(start, end)) / growth**2
        return _row("spiral", s, s + abs(end_arc - arc), curvatures, x, y, growth, rotation, sign, arc, slope=slope)


@dataclass(frozen=True, repr=False)
class Waypoints(Shown):
    """A smooth curve through points (x, y) [m]: the cubic spline over the length of its polygon, curvature-continuous.

    start_heading, end_heading: direction at its ends [rad]; None: no curvature at that end
    """

    points: tuple[Point, ...]
    start_heading: float | None = None
    end_heading: float | None = None

    def __post_init__(self) -> None:
        given = listed("waypoints.points", self.points, "a list of points [x, y] in metres")
        if len(given) < 2:
            raise InvalidValue("waypoints.points", f"waypoints.points must be at least 2 points, got {len(given)}")
        _settle(self, points=tuple(checked_point(f"waypoints.points.{k}", point) for k, point in enumerate(given)))
        for name in ("start_heading", "end_heading"):
            if (heading := getattr(self, name)) is not None:
                _settle(self, **{name: _checked_angle(f"waypoints.{name}", heading)})

    def __repr__(self) -> str:
        listed = f"Waypoints({self.points!r}, {self.start_heading!r}, {self.end_heading!r})"
        return listed if len(listed) <= REPR_MOST else super().__repr__()

    def _line(self) -> str:
        return f"{len(self.points)} points from {self.points[0]!r} to {self.points[-1]!r} m"

    def rows(self, name: str, s: float, budget: Budget) -> Floats:
        """Rows of the kernels' table from arc length s on: as many cubics as exact arc lengths need."""
        from scipy.interpolate import CubicSpline  # type: ignore[import-untyped]

        points = np.array(self.points)
        headings = (self._end(self.start_heading), self._end(self.end_heading))
        steps = np.hypot(*np.diff(points, axis=0).T)
        short = np.flatnonzero(steps < WAYPOINT_GAP)
        if short.size:
            k = int(short[0])
            raise InvalidValue(
                f"{name}.points.{k + 1}",
                f"{name}.points.{k + 1} must be at least {WAYPOINT_GAP:g} m from the point before it, "
                f"got {steps[k]:g} m",
            )
        knots = np.concatenate([[0.0], np.cumsum(steps)])
        spline = CubicSpline(knots, points, bc_type=headings)
        rows = cut(f"{name}.points", np.moveaxis(spline.c[::-1], 1, 0), np.diff(knots), budget)
        ends = np.cumsum([s, *rows[:, 2]])
        rows[:, 1], rows[:, 2] = ends[:-1], ends[1:]
        return rows

    @staticmethod
    def _end(heading: float | None) -> tuple[int, Floats]:
        if heading is None:
            return 2, np.zeros(2)
        return 1, np.array([math.cos(heading), math.sin(heading)])


Piece = Line | Arc | Coil | Waypoints


def _refuse_short(name: str, length: float) -> None:
    if length < LENGTH_MIN:
        raise InvalidValue(name, f"{name} must be at least {LENGTH_MIN:g} m long, got {length:g} m")


class Route(Shown):
    """Pieces joined into one path, s = 0 at `start` metres from the beginning of the first one.

    pieces: in the order they are danced; joints must agree within JOINT_GAP and JOINT_KINK
    table: rows for the kernels; joints: s of every joint [m]; begin, end: s of both ends [m]
    tail_begin: least s of a handle [m]; None if the first piece coils inwards: it continues outwards for the tail
    calm_beginning: the curvature does not fall along the first piece, so no handle there is faster than its leader
    slide: largest distance along the path of the head's point from its s, by rounding and at joints [m]
    raises: InvalidValue naming the piece or the joint and its gap; TooMuchWork
    """

    # For the kernels: places are minus s, and a search may look a little past the end.
    growth, place, limit = 1.0, 0.0, math.inf

    def __init__(self, pieces: Sequence[Piece], start: float = 0.0, *, budget: Budget | None = None) -> None:
        budget = budget or Budget()
        self.pieces: tuple[Piece, ...] = tuple(listed("path.pieces", pieces, "a list of pieces"))
        if not self.pieces:
            raise InvalidValue("path.pieces", "path.pieces must hold at least one piece")
        self.start = checked_number("path.start", start, "m", -1e9, 1e9)
        rows: list[Floats] = []
        joints, count, s = [], 0, -self.start
        for k, piece in enumerate(self.pieces):
            name = f"path.pieces.{k}"
            if not isinstance(piece, Piece):
                raise InvalidValue(name, f"{name} must be a Line, Arc, Coil or Waypoints, got {piece!r}")
            joints.append((s, count))
            try:
                budget.look()
                rows.append(piece.rows(name, s, budget))
            except Halted as halted:
                rule = "must come before fewer pieces, or have fewer points: the route was not laid out {then}"
                raise budget.too_much(name, rule, k, "") from halted
            rows[-1][:, kernels.PART] = k
            count, s = count + len(rows[-1]), float(rows[-1][-1, 2])
        self.table = np.concatenate(rows)
        self.joints = tuple(s for s, _ in joints[1:])
        self.begin, self.end = float(self.table[0, 1]), s
        first = self.pieces[0]
        inwards = isinstance(first, Coil) and first.start_turns > first.end_turns
        self.tail_begin = None if inwards else self.begin
        self.calm_beginning = inwards or isinstance(first, Line | Arc)
        self.slide = self._smooth()
        self.table.flags.writeable = False
        for k, (s, row) in enumerate(joints[1:], start=1):
            self._refuse_joint(k, s, row)

    # Two pieces that do not quite meet are blended, on the longer of the two, by a polynomial of degree 5 over a length
    # l of at most 1 m (BLEND in core/kernels/constants.py). It takes a gap g across the path, a kink k and a step d of
    # the curvature inside a part to zero. It stays within g + k l + d l^2 of the piece, its second derivative within
    # 10 g / l^2 + 6 k / l + 3 d, its third within 60 g / l^3 + 36 k / l^2 + 9 d / l. A piece may have one at either
    # end, hence twice that. A curve at some distance beside a bend has more curvature, by the square of the bend times
    # the distance. Gaps along the path displace the head alone.
    def _smooth(self) -> float:
        """Fill in the distance of the pieces from a smooth path; returns `slide` [m]."""
        table, misses, slides = self.table, np.zeros((len(self.table), kernels.MISS_COLUMNS)), np.zeros(len(self.table))
        kernels.joint_misses(table, misses)
        kernels.piece_slides(table, slides)
        across, along, kink, step = misses[1:].T
        lengths = table[:, 2] - table[:, 1]
        over = np.minimum(kernels.BLEND, np.maximum(lengths[1:], lengths[:-1]))
        step = np.where(table[1:, kernels.PART] == table[:-1, kernels.PART], step, 0.0)
        sharpest = np.abs(table[:, 3:5]).max()
        loose = 2.0 * np.max(across + (kink + step * over) * over, initial=0.0)
        bent = 2.0 * np.max((10.0 * across / over + 6.0 * kink) / over + 3.0 * step, initial=0.0)
        slope = 2.0 * np.max(((60.0 * across / over + 36.0 * kink) / over + 9.0 * step) / over, initial=0.0)
        table[:, kernels.LOOSE], table[:, kernels.BENT] = loose, bent + 2.0 * sharpest**2 * loose
        table[:, kernels.K_SLOPE] += slope
        return float(slides.max() + along.sum())

    def _refuse_joint(self, k: int, s: float, row: int) -> None:
        ends = np.empty((2, kernels.POINT_COLUMNS))
        for side, part in enumerate((self.table[:row], self.table[row:])):
            kernels.route_points(np.ascontiguousarray(part), np.array([s]), ends[side : side + 1])
        (x, y, tx, ty, _), (x2, y2, tx2, ty2, _) = ends
        gap = math.hypot(x2 - x, y2 - y)
        kink = abs(math.atan2(tx * ty2 - ty * tx2, tx * tx2 + ty * ty2))
        name = f"path.pieces.{k}"
        where = f"the joint of path.pieces[{k - 1}] and path.pieces[{k}]"
        if gap > JOINT_GAP:
            raise InvalidValue(
                name, f"{where} must close: ({x:.9g}, {y:.9g}) m is {gap:.3g} m from ({x2:.9g}, {y2:.9g}) m"
            )
        if kink > JOINT_KINK:
            raise InvalidValue(
                name, f"{where} must be smooth: at ({x:.9g}, {y:.9g}) m the direction turns by {kink:.3g} rad"
            )

    def __repr__(self) -> str:
        listed = f"Route({list(self.pieces)!r}, start={self.start!r})"
        return listed if len(listed) <= REPR_MOST else super().__repr__()

    def _line(self) -> str:
        kinds = ", ".join(type(piece).__name__ for piece in self.pieces[:4])
        more = ", ..." if len(self.pieces) > 4 else ""
        pieces = f"{counted(len(self.pieces), 'piece')} ({kinds}{more})"
        return f"{pieces}, s from {worded(self.begin)} to {worded(self.end, 'm')}"

    def _rows(self) -> list[tuple[str, str]]:
        rows = [(f"piece {k}", str(piece)) for k, piece in enumerate(self.pieces)]
        return [*rows, ("begin", worded(self.begin, "m", TABLE_DIGITS)), ("end", worded(self.end, "m", TABLE_DIGITS))]

    def _points(self, s: Floats | float) -> Floats:
        flat = np.ascontiguousarray(np.asarray(s, dtype=np.float64).reshape(-1))
        out = np.empty((flat.size, kernels.POINT_COLUMNS))
        kernels.route_points(self.table, flat, out)
        return out.reshape(*np.shape(s), kernels.POINT_COLUMNS)

    def position(self, s: Floats | float) -> Floats:
        """Points at arc length s. s: (...) [m]; returns (..., 2) x, y [m]."""
        return self._points(s)[..., 0:2]

    @property
    def curve(self) -> kernels.Curve:
        """The route as the kernels take it."""
        return kernels.route_curve(self.table)

    def head(self, s: float) -> HeadState:
        """The head at arc length s [m]."""
        x, y = self.position(s).tolist()
        return HeadState(None, math.hypot(x, y), x, y)

    def calm(self, curvature: float) -> float:
        """1 if no handle on the first piece is faster than its leader, else 0, as kernels.peak_rate() takes it."""
        return 1.0 if self.calm_beginning else 0.0

    def words(self) -> str:
        """The route in a sentence that names all that matters for a proof."""
        kinds = [type(piece).__name__.lower() for piece in self.pieces]
        listed = kinds if len(kinds) <= PIECES_LISTED else sorted(set(kinds))
        return f"a route from s = {said(self.begin)} m to {said(self.end)} m ({', '.join(listed)})"

    def drawn(self, reach: float) -> Floats:
        """Points (N, 2) [m] for a picture: the whole route, whatever the reach of the dragon."""
        s = np.linspace(max(self.begin, -DRAWN), min(self.end, DRAWN), DRAWN_POINTS)
        return self.position(s)

    def tangent(self, s: Floats | float) -> Floats:
        """Unit tangents in the direction of travel. s: (...) [m]; returns (..., 2)."""
        return self._points(s)[..., 2:4]

    def curvature(self, s: Floats | float) -> Floats:
        """Curvature, counter-clockwise positive. s: (...) [m]; returns (...) [1/m]."""
        return self._points(s)[..., 4]

    @cached_property
    def sharpest(self) -> tuple[float, float]:
        """The largest |curvature| [1/m], on a cubic its bound, and an s [m] where it occurs."""
        curvatures = np.abs(self.table[:, 3:5])
        row, end = np.unravel_index(int(curvatures.argmax()), curvatures.shape)
        return float(curvatures[row, end]), float(self.table[row, 1 + end])
