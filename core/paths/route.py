"""Route: pieces joined into one path by arc length; every joint is checked: smooth, or a corner of two lines."""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import cached_property
from typing import Any

import numpy as np

from core import kernels
from core.checks import checked_list, checked_number
from core.display import REPR_MOST, TABLE_DIGITS, WAY_MOST, Readable, display
from core.error_free import paired
from core.errors import InvalidValue
from core.kernels import Budget, Halted
from core.kernels.constants import (
    CORNER,
    CORNERED,
    K_END,
    K_START,
    LINE_DX,
    LINE_DY,
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
from core.language import counted, say
from core.paths.frame import WORLD
from core.paths.path import Columns, HeadState, PathSummary
from core.paths.pieces import Arc, Clothoid, Coil, Line, Piece
from core.quantities import Given, Parameter, Quantity, Value
from core.questions import too_much
from core.values import Floats, Interval

# Largest drawn distance from the start of a route [m], and number of points.
DRAWN = 2_000.0
DRAWN_POINTS = 20_000
# Length of the coils of a turn in the small picture of a notebook, before and behind it [m].
WAY_BEFORE = 60.0
# Largest gap [m] and kink [rad] of two joined pieces: rounding of coordinates up to 1 km.
JOINT_GAP = 1e-9
JOINT_KINK = 1e-9
# Least angle of a corner that no bench can follow [rad]: it would have to walk backwards out of it.
CORNER_END = 0.5 * math.pi
# Kink |T' - T| from which on a corner may have that angle and is measured [1].
CORNER_LOOK = 1.4
# Part by which the jump of a tangent counts as larger, for its rounding [1].
JUMP_SPARE = 1e-14
# Columns of the curvatures of a piece.
BENDS = slice(K_START, K_END + 1)
# Most pieces that are listed one by one [1].
PIECES_LISTED = 6


def too_sharp(name: str, angle: float) -> InvalidValue:
    """The error for a corner of an angle [rad]; name: of the point or piece that begins there"""
    words, why = "the corner at {corner} must turn by less than {limit}", "no bench can follow a sharper one"
    got, limit = (Quantity(math.degrees(one), "degrees", 6) for one in (angle, CORNER_END))
    return InvalidValue.in_words(name, words, reason=why, got=got, limit=limit, corner=Parameter(name))


class Route(Readable):
    """Pieces joined into one path, with s = 0 at `start` metres from the beginning of the first one.

    pieces: in the order of the dance; joints must agree within JOINT_GAP and JOINT_KINK, but two lines may meet at a
        corner of less than CORNER_END
    table: rows for the kernels; joints: s of every joint [m]; begin, end: s of both ends [m]
    tail_begin: least s of a handle [m]; None if the first piece coils inwards: it continues outwards for the tail
    calm_beginning: True if the curvature does not fall along the first piece, so no handle is faster than its leader
    slide: largest distance along the path between the head's point and its s, by rounding and at joints [m]
    followed: how dragons follow it, by the bytes of their chords: see following() in core/paths/following.py
    raises: InvalidValue naming the piece or the joint and its gap; TooMuchWork

    >>> corner = Route([Line((0, 0), (9, 0)), Arc((9, 2), 2.0, -math.pi / 2, math.pi / 2), Line((11, 2), (11, 9))])
    >>> round(corner.end, 4), round(corner.head(14.0).y, 3)
    (19.1416, 3.858)
    """

    # For the kernels: places are minus s, and a search may pass the end a little.
    growth, place, limit, block = 1.0, 0.0, math.inf, 1
    frame, spiral = WORLD, None

    @property
    def knots(self) -> Floats:
        """No points define a route of pieces."""
        return np.empty(0)

    def __init__(self, pieces: Sequence[Piece], start: float = 0.0, *, budget: Budget | None = None) -> None:
        budget = budget or Budget()
        self.pieces: tuple[Piece, ...] = tuple(checked_list("path.pieces", pieces, "must be a list of pieces"))
        if not self.pieces:
            raise InvalidValue("path.pieces", "must hold at least one piece")
        self.start = checked_number("path.start", start, "m", -1e9, 1e9)
        rows: list[Floats] = []
        joints, count, s, low = [], 0, -self.start, 0.0
        for k, piece in enumerate(self.pieces):
            name = f"path.pieces.{k}"
            if not isinstance(piece, Piece):
                raise InvalidValue(name, "must be a Line, Arc, Coil, Clothoid or Waypoints", got=Given(piece))
            joints.append((s, count))
            try:
                budget.look()
                rows.append(piece.rows(name, s, budget))
            except Halted as halted:
                rule = "must come after fewer pieces, or have fewer points: the route was not laid out {then}"
                raise too_much(budget, name, rule, k) from halted
            rows[-1][:, kernels.PART] = k
            rows[-1][:, [S_START_LOW, S_END_LOW]] += low
            count += len(rows[-1])
            s, low = float(rows[-1][-1, S_END]), float(rows[-1][-1, S_END_LOW])
        self.table = np.concatenate(rows)
        self.joints = tuple(s for s, _ in joints[1:])
        self.begin, self.end = float(self.table[0, S_START]), s
        first = self.pieces[0]
        inwards = isinstance(first, Coil) and first.start_turns > first.end_turns
        self.tail_begin = None if inwards else self.begin
        grows = isinstance(first, Clothoid) and first.grows
        self.calm_beginning = inwards or grows or isinstance(first, Line | Arc)
        self._lay_corners([row for _, row in joints[1:]])
        misses = np.zeros((len(self.table), kernels.MISS_COLUMNS))
        kernels.joint_misses(self.table, misses)
        gap, kink = misses[:, kernels.MISS_ACROSS] + misses[:, kernels.MISS_ALONG], misses[:, kernels.MISS_KINK]
        doubtful = (gap > JOINT_GAP) | (kink > JOINT_KINK) & ~((self.table[:, CORNER] > 0.0) & (kink < CORNER_LOOK))
        self.slide = self._smooth(misses)
        self.table.flags.writeable = False
        self.followed: dict[bytes, Any] = {}
        for k, (s, row) in enumerate(joints[1:], start=1):
            if doubtful[row]:
                self._refuse_joint(k, s, row)

    def _lay_corners(self, rows: list[int]) -> None:
        """Fill in the corners at the beginnings of rows."""
        lines = [
            row for k, row in enumerate(rows, start=1) if all(isinstance(p, Line) for p in self.pieces[k - 1 : k + 1])
        ]
        along = self.table[:, LINE_DX : LINE_DY + 1]
        jumps = np.hypot(*(along[lines] - along[[row - 1 for row in lines]]).T)
        corners = np.array(lines, dtype=np.int64)[jumps > JOINT_KINK]
        self.table[corners, CORNER] = jumps[jumps > JOINT_KINK] * (1.0 + JUMP_SPARE)
        self.table[:, CORNERED] = float(len(corners) > 0)

    # Two pieces that do not meet exactly are blended, on the longer one, by a polynomial of degree 5 over a length l of
    # at most 1 m (BLEND in core/kernels/constants.py). It reduces a gap g across the path, a kink k and a step d of the
    # curvature inside a part to zero. It stays within g + k l + d l^2 of the piece, its second derivative within
    # 10 g / l^2 + 6 k / l + 3 d, its third within 60 g / l^3 + 36 k / l^2 + 9 d / l. A piece may have one at both ends,
    # hence twice that. A curve at some distance beside a piece has more curvature, by the square of the curvature times
    # the distance. Gaps along the path displace only the head.
    def _smooth(self, misses: Floats) -> float:
        """Fill in the distance of the pieces from a smooth path; returns `slide` [m]."""
        table, slides = self.table, np.zeros(len(self.table))
        kernels.piece_slides(table, slides)
        across, along, kink, step = misses[1:].T
        corner = table[1:, CORNER] > 0.0
        kink[corner] = 0.0
        across[corner] = along[corner] = (across + along)[corner]
        lengths = table[:, S_END] - table[:, S_START]
        over = np.minimum(kernels.BLEND, np.maximum(lengths[1:], lengths[:-1]))
        step = np.where(table[1:, kernels.PART] == table[:-1, kernels.PART], step, 0.0)
        sharpest = np.abs(table[:, BENDS]).max()
        table[:, kernels.SHARPEST] = sharpest
        loose = 2.0 * np.max(across + (kink + step * over) * over, initial=0.0)
        bent = 2.0 * np.max((10.0 * across / over + 6.0 * kink) / over + 3.0 * step, initial=0.0)
        slope = 2.0 * np.max(((60.0 * across / over + 36.0 * kink) / over + 9.0 * step) / over, initial=0.0)
        table[:, kernels.LOOSE], table[:, kernels.CURVATURE_SLACK] = loose, bent + 2.0 * sharpest**2 * loose
        table[:, kernels.K_SLOPE] += slope
        return float(slides.max() + along.sum())

    def _refuse_joint(self, k: int, s: float, row: int) -> None:
        ends = np.empty((2, kernels.POINT_COLUMNS))
        place = np.array([[s, self.table[row, S_START_LOW]]])
        for side in range(2):
            kernels.route_points(self.table[row - 1 + side : row + side], place, ends[side : side + 1])
        (x, y, tx, ty, _), (x2, y2, tx2, ty2, _) = ends
        gap = math.hypot(x2 - x, y2 - y)
        kink = abs(math.atan2(tx * ty2 - ty * tx2, tx * tx2 + ty * ty2))
        name = f"path.pieces.{k}"
        values: dict[str, Value] = {"gap": Quantity(gap, "m", 3), "kink": Quantity(kink, "rad", 3)}
        values |= {"at": f"({x:.9g}, {y:.9g}) m", "other": f"({x2:.9g}, {y2:.9g}) m"}
        values |= {"before": Parameter(f"path.pieces.{k - 1}"), "after": Parameter(name)}
        if gap > JOINT_GAP:
            words, why = "the joint of {before} and {after} must close", "{at} is {gap} from {other}"
            raise InvalidValue.in_words(name, words, reason=why, **values)
        if kink >= CORNER_END and self.table[row, CORNER] > 0.0:
            raise too_sharp(name, kink)
        if kink > JOINT_KINK and self.table[row, CORNER] == 0.0:
            words, why = "the joint of {before} and {after} must be smooth", "at {at} the direction turns by {kink}"
            raise InvalidValue.in_words(name, words, reason=why, **values)

    @cached_property
    def corners(self) -> Floats:
        """s of every corner (N,) [m]."""
        corners: Floats = self.table[self.table[:, CORNER] > 0.0, S_START]
        return corners

    @property
    def _definition(self) -> tuple[object, ...]:
        """The values by which routes are equal or not."""
        return type(self), self.pieces, self.start

    def __eq__(self, other: object) -> bool:
        return self._definition == getattr(other, "_definition", None)

    def __hash__(self) -> int:
        return hash(self._definition)

    def __repr__(self) -> str:
        text = f"Route({list(self.pieces)!r}, start={self.start!r})"
        return text if len(text) <= REPR_MOST else super().__repr__()

    def _line(self) -> str:
        kinds = ", ".join(type(piece).__name__ for piece in self.pieces[:4])
        more = ", ..." if len(self.pieces) > 4 else ""
        pieces = counted(len(self.pieces), "{count} piece", "{count} pieces")
        values = {"kinds": kinds + more, "begin": display(self.begin), "end": display(self.end, "m")}
        return say("{pieces} ({kinds}), s from {begin} to {end}", pieces=pieces, **values)

    def _rows(self) -> list[tuple[str, str]]:
        lines = [f"{type(piece).__name__}: {piece._line()}" for piece in self.pieces[:PIECES_LISTED]]
        rows = [(say("piece {k}", k=k), line) for k, line in enumerate(lines)]
        more = len(self.pieces) - PIECES_LISTED
        rows += [(say("other pieces"), str(more))] if more > 0 else []
        return [
            *rows,
            ("begin", display(self.begin, "m", TABLE_DIGITS)),
            ("end", display(self.end, "m", TABLE_DIGITS)),
        ]

    def _points(self, s: Floats | float) -> Floats:
        flat = paired(np.asarray(s, dtype=np.float64).reshape(-1))
        out = np.empty((len(flat), kernels.POINT_COLUMNS))
        kernels.route_points(self.table, flat, out)
        return out.reshape(*np.shape(s), kernels.POINT_COLUMNS)

    def position(self, s: Floats | float) -> Floats:
        """Points at arc length s. s: (...) [m]; returns (..., 2) x, y [m]."""
        return self._points(s)[..., PX : PY + 1]

    @property
    def standard(self) -> Route:
        """The route itself, because it is computed in the world."""
        return self

    @property
    def curve(self) -> kernels.Curve:
        """The route in the form of the kernels."""
        return kernels.route_curve(self.table)

    def head(self, s: float) -> HeadState:
        """The head at arc length s [m]."""
        x, y = self.position(s).tolist()
        return HeadState(None, math.hypot(x, y), x, y)

    def handles(
        self, s: Floats, last: float, chords: Floats, head_speed: float, columns: Columns, budget: kernels.Budget
    ) -> int:
        """Fill in all handles, see Path; no bench folds on a route."""
        sizes = np.zeros((chords.size, kernels.SIZE_COLUMNS))
        sizes[:, kernels.CHORD] = chords
        chain = np.empty((chords.size + 1, kernels.CHAIN_COLUMNS))
        kernels.route_trajectory(self.table, s, head_speed, sizes, chain, *columns)
        return len(s)

    def lags(self, s: Floats, last: float) -> Floats:
        """Minus the arc lengths s (T,) [m]."""
        return -s

    def follow(self, lag: float, last: int, sizes: Floats, chain: Floats) -> None:
        """Fill in a chain up to handle `last`, with the head at minus its arc length [m]."""
        kernels.place_chain(self.curve, lag, last, sizes, chain)

    def along(self, lags: Floats) -> Floats:
        """Arc lengths [m] of lags (...)."""
        return -lags

    def piece_at(self, row: Floats) -> int:
        """Number of the piece of a handle, from its row of a chain."""
        return int(row[kernels.PIECE])

    def calm(self, curvature: float) -> float:
        """Minus the s up to which handles stand on the first piece itself, if its curvature does not fall [m]."""
        gentle = np.abs(self.table[0, BENDS]).max() * kernels.SINE_LIMIT <= curvature * kernels.ROUTE_SINE_LIMIT
        return kernels.BLEND - float(self.table[0, S_END]) if self.calm_beginning and gentle else kernels.FREE

    def summary(self) -> PathSummary:
        """The route by its ends and the kinds of its pieces."""
        kinds = [type(piece).__name__.lower() for piece in self.pieces]
        listed = kinds if len(kinds) <= PIECES_LISTED else sorted(set(kinds))
        return PathSummary("route", self.begin, self.end, pieces=tuple(listed))

    def gentle_lag(self, curvature: float) -> float:
        """Minus infinity, because no handle reverses on a route that a dance can follow."""
        return -math.inf

    def sharpest_before(self, s: float) -> float:
        """Upper bound of the |curvature| of the whole route [1/m]; infinity at a corner."""
        bends = float(self.sharpest[0] + np.abs(self.table[:, kernels.CURVATURE_SLACK]).max())
        return math.inf if len(self.corners) else bends

    def tighter(self, radius: float) -> list[tuple[float, float, float]]:
        """Stretches that may bend more tightly than a radius [m], see Path: rows of the table, joined if they meet, and
        corners, which are points."""
        table = self.table
        sharpest = np.abs(table[:, BENDS]).max(axis=1)
        tight = np.flatnonzero(sharpest * radius > 1.0)
        joined = np.split(tight, np.flatnonzero(np.diff(tight) > 1) + 1) if len(tight) else ()
        bends = [
            (float(table[rows[0], S_START]), float(table[rows[-1], S_END]), float(sharpest[rows].max()))
            for rows in joined
        ]
        return sorted([*bends, *((s, s, math.inf) for s in self.corners.tolist())])

    def last_lag(self, chord: float) -> float:
        """0, because no bench folds on a route that a dance can follow."""
        return 0.0

    def rear_way(self, s: float, way: float, chord: float, last: float) -> float:
        """FREE: no bound is known."""
        return kernels.FREE

    def as_route(self, stop: float) -> Route:
        """The route itself."""
        return self

    def drawn_between(self, low: float, high: float) -> Interval:
        """From low, if it is on the route, to the end of the route [m]."""
        return max(low, self.begin), self.end

    def drawn_begin(self, points: Floats) -> float:
        """The beginning of the route [m]."""
        return self.begin

    def drawn(self, reached: Floats) -> Floats:
        """Points (N, 2) [m] for a picture: always the whole route."""
        s = np.linspace(max(self.begin, -DRAWN), min(self.end, DRAWN), DRAWN_POINTS)
        return self.position(s)

    def _drawn_lines(self) -> list[Floats]:
        """The whole route; a turn, which alone has a length of its own, with a little of its coils."""
        stop = float(getattr(self, "length", math.inf))
        return [self.position(np.linspace(max(self.begin, -WAY_BEFORE), min(self.end, stop + WAY_BEFORE), WAY_MOST))]

    def tangent(self, s: Floats | float) -> Floats:
        """Unit tangents in the direction of travel. s: (...) [m]; returns (..., 2)."""
        return self._points(s)[..., TX : TY + 1]

    def curvature(self, s: Floats | float) -> Floats:
        """Curvature, counter-clockwise positive. s: (...) [m]; returns (...) [1/m]."""
        return self._points(s)[..., POINT_CURVATURE]

    @cached_property
    def sharpest(self) -> tuple[float, float]:
        """The largest |curvature| [1/m], for a cubic its bound, and the s [m] of it."""
        curvatures = np.abs(self.table[:, BENDS])
        row, end = np.unravel_index(int(curvatures.argmax()), curvatures.shape)
        return float(curvatures[row, end]), float(self.table[row, S_START + end])
