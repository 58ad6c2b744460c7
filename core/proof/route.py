"""Routes in balls: lines, arcs and coils joined exactly, and the dragon on them with its head at one exact place."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import reduce
from itertools import pairwise

from flint import acb, arb

from core.dragon import Dragon
from core.proof.chain import GUESS_RADIUS, DragonOnPath, coil_arc, coil_slope, coil_theta, delta, newton
from core.proof.pairs import Benches, Unproven, above
from core.quantities import Quantity, format_number

# Newton steps towards a guess in doubles: each doubles the digits.
GUESS_STEPS = 40
# Largest number of steps backwards to the first point a chord away, of at least this part of the chord or the piece.
BACK_STEPS, BACK_PART = 2000, 1 / 256
# Largest curvature times chord for which 8. serves, a little more than that of every bend that is always followed;
# beyond it, and over corners, 18. does, with a cosine of more than this at the rear handle, that of 87.438 degrees [1].
GENTLE_MOST, REAR_COSINE_LEAST = "1.9980001", "0.0447"
# Largest number of parts of a path that are shown to be less than a chord away.
PARTS_MOST = 2000


def turned(angle: arb) -> acb:
    """The unit vector at an angle [rad]."""
    return (acb(0, 1) * angle).exp()


@dataclass
class Piece:
    """A line or an arc of one curvature [1/m], length [m]; its parameter is the place z = -s [m] itself.

    high, low: places where it begins and ends [m]; shift, rotation: its beginning in the world; index: in the route
    turn: by which its direction differs at its beginning from the end of the piece before it, 1 but at a corner
    A place falls as the dance goes on: the point is at high - z along the piece.
    """

    curvature: arb
    length: arb
    high: arb = field(default_factory=arb)
    low: arb = field(default_factory=arb)
    shift: acb = field(default_factory=acb)
    rotation: acb = field(default_factory=lambda: acb(1))
    turn: acb = field(default_factory=lambda: acb(1))
    index: int = 0

    def param(self, z: arb) -> arb:
        """The parameter at a place."""
        return z

    def place(self, t: arb) -> arb:
        """The place at a parameter [m]."""
        return t

    def point(self, t: arb) -> acb:
        """The point at a parameter [m]."""
        way = self.high - t
        if self.curvature == 0:
            return self.shift + self.rotation * way
        change = turned(self.curvature * way) - 1
        return self.shift + self.rotation * change / (acb(0, 1) * self.curvature)

    def tangent(self, t: arb) -> acb:
        """The direction of the dance at a parameter."""
        return self.rotation * turned(self.curvature * (self.high - t))

    def slope(self, t: arb) -> arb:
        """-ds / dt at a parameter [m]."""
        return arb(1)

    def curvature_at(self, t: arb) -> arb:
        """The curvature at a parameter [1/m]."""
        return self.curvature

    @property
    def sharpest(self) -> arb:
        """The largest |curvature| [1/m]."""
        return abs(self.curvature)

    def behind(self, t: arb, chord: arb) -> arb:
        """The parameter of the first point behind that is a chord away, if the piece is long and wide enough."""
        half = abs(self.curvature) * chord / 2
        if self.curvature == 0:
            return t + chord
        if not half < 1:
            raise Unproven("an arc is not shown to be wide enough for a bench")
        return t + 2 * half.asin() / abs(self.curvature)


@dataclass
class BallCoil(Piece):
    """Part of the spiral r = growth |t|: inwards for t > 0, outwards for t < 0, so that t falls as the dance goes on.

    growth [m/rad]; first, last: t where it begins and ends [rad]; it continues beyond both, but not past its centre
    """

    growth: arb = field(default_factory=arb)
    first: arb = field(default_factory=arb)
    last: arb = field(default_factory=arb)

    @classmethod
    def between(cls, growth: arb, first: arb, last: arb) -> BallCoil:
        """The coil from one t to another."""
        length = coil_arc(growth, first) - coil_arc(growth, last)
        return cls(arb(0), length, growth=growth, first=first, last=last)

    @property
    def inwards(self) -> bool:
        """Whether it is danced towards its centre."""
        return bool(self.first > 0)

    def _theta(self, t: arb) -> arb:
        if not (t > 0 if self.inwards else t < 0):
            raise Unproven("a handle is not shown to be short of the centre of a coil")
        return abs(t)

    def param(self, z: arb) -> arb:
        return coil_theta(self.growth, z - self.high + coil_arc(self.growth, self.first))

    def place(self, t: arb) -> arb:
        return self.high + coil_arc(self.growth, t) - coil_arc(self.growth, self.first)

    def point(self, t: arb) -> acb:
        theta = self._theta(t)
        return self.shift + self.rotation * self.growth * theta * turned(theta)

    def tangent(self, t: arb) -> acb:
        theta = self._theta(t)
        along = acb(1, theta) * turned(theta) / (1 + t**2).sqrt()
        return -self.rotation * along if self.inwards else self.rotation * along

    def slope(self, t: arb) -> arb:
        return coil_slope(self.growth, t)

    def curvature_at(self, t: arb) -> arb:
        size = self._bend(self._theta(t))
        return -size if self.inwards else size

    def _bend(self, theta: arb) -> arb:
        square = 1 + theta**2
        return (square + 1) / (square * square.sqrt()) / self.growth

    @property
    def sharpest(self) -> arb:
        return self._bend(abs(self.first)).max(self._bend(abs(self.last)))

    def behind(self, t: arb, chord: arb) -> arb:
        return t + delta(t, (chord / self.growth) ** 2)


class BallPath:
    """Pieces in the order they are danced, each moved so that it continues the one before in place and direction, but
    for the turn of a corner.

    anchor: (piece, place where it begins [m]); the first piece continues backwards, and the last one forwards
    """

    def __init__(self, pieces: Sequence[Piece], anchor: tuple[int, arb], shift: acb, rotation: acb) -> None:
        self.pieces = list(pieces)
        at, z = anchor
        for piece in self.pieces[at:]:
            piece.high, piece.low = z, z - piece.length
            z = piece.low
        z = anchor[1]
        for piece in reversed(self.pieces[:at]):
            piece.low, piece.high = z, z + piece.length
            z = piece.high
        self.pieces[0].shift, self.pieces[0].rotation = shift, rotation
        for k, (before, piece) in enumerate(pairwise(self.pieces), 1):
            piece.index = k
            start, end = self.ends(k)
            piece.rotation = piece.turn * before.tangent(end) / piece.tangent(start)
            piece.shift = before.point(end) - piece.point(start)

    def ends(self, k: int) -> tuple[arb, arb]:
        """The parameters on both sides of the joint before piece k: of k, and of the piece before it."""
        after, before = self.pieces[k], self.pieces[k - 1]
        start = after.first if isinstance(after, BallCoil) else after.high
        return start, before.last if isinstance(before, BallCoil) else before.low

    def holds(self, piece: Piece, z: arb) -> bool:
        """Whether this place is certainly on that piece. z: [m]"""
        first, last = piece.index == 0, piece.index == len(self.pieces) - 1
        return (first or z <= piece.high) and (last or z >= piece.low)

    def at(self, z: arb) -> tuple[Piece, arb]:
        """The piece that holds a place, and the parameter there. z: [m]"""
        for piece in self.pieces:
            if self.holds(piece, z):
                return piece, piece.param(z)
        raise Unproven("a handle is on a joint to the last digit")

    def curvature(self, front: tuple[Piece, arb], rear: tuple[Piece, arb]) -> tuple[arb, arb]:
        """Lower and upper bound of the curvature from a place back to another one [1/m]."""
        bends = [front[0].curvature_at(front[1]), rear[0].curvature_at(rear[1])]
        for k in range(rear[0].index + 1, front[0].index + 1):
            start, end = self.ends(k)
            bends += [self.pieces[k].curvature_at(start), self.pieces[k - 1].curvature_at(end)]
        hull = reduce(arb.union, bends)
        return hull.lower(), hull.upper()

    def gentle(self, front: tuple[Piece, arb], rear: tuple[Piece, arb], chord: arb) -> bool:
        """Whether 8. serves from a place back to another one: no bend is too tight for it, and no corner is there."""
        if any(self.pieces[k].turn != 1 for k in range(rear[0].index + 1, front[0].index + 1)):
            return False
        low, high = self.curvature(front, rear)
        return bool(abs(low).max(abs(high)) * chord < arb(GENTLE_MOST))

    def between(self, front: tuple[Piece, arb], rear: tuple[Piece, arb]) -> list[tuple[Piece, arb]]:
        """The pieces from a place back to another one, each with all its parameters there."""
        first, last, parts = front[0].index, rear[0].index, []
        for k in range(first, last - 1, -1):
            start = front[1] if k == first else self.ends(k + 1)[1]
            end = rear[1] if k == last else self.ends(k)[0]
            parts.append((self.pieces[k], start.union(end)))
        return parts

    @staticmethod
    def all_near(point: acb, parts: Sequence[tuple[Piece, arb]], chord: arb) -> bool:
        """Whether the end of these parts is the first place behind that can be a chord away from a point (18.)."""
        left = list(parts)
        for _ in range(PARTS_MOST):
            if not left:
                return True
            piece, t = left.pop()
            to = point - piece.point(t)
            if not (abs(to) < chord or (to * piece.tangent(t).conjugate()).real > 0):
                left += [(piece, t.lower().union(t.mid())), (piece, t.mid().union(t.upper()))]
        return False

    def behind(self, front: tuple[Piece, arb], chord: arb) -> tuple[Piece, arb]:
        """The first place behind that is a chord away (8., 18.), as piece and parameter."""
        piece, t = front
        try:
            rear = piece, piece.behind(t, chord)
            stays = self.holds(piece, piece.place(rear[1]))
        except Unproven:  # a coil is left before its centre, or an arc is narrower than a chord
            stays = False
        if not stays:
            rear = self._on_earlier(front, chord)
        length = rear[0].place(rear[1]) - piece.place(t)
        if self.gentle(front, rear, chord):
            low, high = self.curvature(front, rear)
            first = abs(low).max(abs(high)) * length < arb.pi()
        else:
            first = self.all_near(piece.point(t), self.between(front, rear), chord)
        if not (length > 0 and first):
            raise Unproven("a next handle is not shown to be the first behind")
        return rear

    def _on_earlier(self, front: tuple[Piece, arb], chord: arb) -> tuple[Piece, arb]:
        """The point a chord behind the front handle, on an earlier piece than the front handle."""
        point, z = front[0].point(front[1]), front[0].place(front[1])
        for k in range(front[0].index - 1, -1, -1):
            piece, end = self.pieces[k], self.ends(k + 1)[1]
            # Start at the place at which path and chord would have equal lengths.
            t = (end + (z + chord - piece.low).nonnegative_part() / piece.slope(end)).mid()
            guess = self._first_away(piece, point, chord, t)
            if guess is not None:
                t = self._meeting(piece, point, chord, guess)
                if self.holds(piece, piece.place(t)):
                    return piece, t
        raise Unproven("no next handle is found across a joint")

    def _first_away(self, piece: Piece, point: acb, chord: arb, t: arb) -> arb | None:
        """A guess of the first parameter of a piece from t on that is a chord away; None if there is none.

        A distance changes by no more than the way, so what is left of the chord is a step that misses nothing.
        """
        least = chord.min(piece.length) * BACK_PART
        for _ in range(BACK_STEPS):
            left = chord - abs(piece.point(t) - point)
            if not left > 0:
                return t
            if piece.index > 0 and piece.place(t) > piece.high + least:
                return None
            t = (t + left.max(least) / piece.slope(t)).mid()
        return None

    def _meeting(self, piece: Piece, point: acb, chord: arb, t: arb) -> arb:
        """The place near a guess at which |piece - point| grows beyond the chord: one interval Newton step."""
        for _ in range(GUESS_STEPS):
            to = piece.point(t) - point
            slope = -2 * (to.conjugate() * piece.tangent(t)).real * piece.slope(t)
            if not abs(slope) > 0:
                break
            step = (abs(to) ** 2 - chord**2) / slope
            t = (t - step).mid()
            if abs(step) < GUESS_RADIUS * GUESS_RADIUS:
                break
        around = t + arb(0, GUESS_RADIUS)
        to_around = piece.point(around) - point
        slope = -2 * (to_around.conjugate() * piece.tangent(around)).real * piece.slope(around)
        return newton(t, around, abs(piece.point(t) - point) ** 2 - chord**2, slope)


class RouteChain(DragonOnPath["RoutePose"]):
    """A dragon on a route. Its places are z = -s [m].

    gentle: whether 8. serves for all benches everywhere
    """

    floor = -math.inf

    def __init__(self, dragon: Dragon, path: BallPath, margin: float = 0.0) -> None:
        super().__init__(dragon, margin)
        self.path = path
        most = arb(GENTLE_MOST) / self.longest
        self.gentle = all(piece.turn == 1 and piece.sharpest < most for piece in path.pieces)

    @staticmethod
    def place_quantity(place: float) -> Quantity:
        """A place in a message."""
        return Quantity(-place, "m", text=f"s = {format_number(-place)} m")

    def place_after(self, way: arb) -> arb:
        """Place of the head after this way from s = 0. way: [m], negative before it; returns [m]."""
        return -way

    def pose_at(self, bench: int, place: arb) -> RoutePose:
        """A bench and those behind it when its front handle is at a place [m]."""
        return RoutePose(self, bench, place)

    def outermost(self, bench: int, highest: float) -> list[float]:
        """P[bench], ..., P[n - 3] of 6., rounded up. highest: P[bench] [m]"""
        pose = RoutePose(self, bench, arb(highest))
        pose.grow_to(self.count - 3 - bench)
        return [highest, *(above(pose.places[k]) for k in range(1, self.count - 2 - bench))]

    @property
    def centre(self) -> acb | None:
        """The centre of the first piece if it coils inwards; else None."""
        first = self.path.pieces[0]
        return first.shift if isinstance(first, BallCoil) and first.inwards else None

    def inner_circle(self, handle: tuple[Piece, arb]) -> arb | None:
        """Radius around the first piece's centre outside which every bench from this handle on lies (11.) [m], or None
        if no such circle is known."""
        piece, t = handle
        if not (isinstance(piece, BallCoil) and piece.index == 0 and piece.inwards):
            return None
        if not abs(piece.curvature_at(t)) * self.longest < arb(GENTLE_MOST):
            return None
        inner = (piece.growth * t.lower()) ** 2 - arb(self.longest) ** 2 / 4
        return inner.sqrt() - self.reach if inner > 0 else None


class RoutePose(Benches):
    """A bench and those behind it when its front handle is at a place z [m], in the world frame.

    handles: piece and parameter of each; points [m], places [m]; grown one by one
    """

    def __init__(self, chain: RouteChain, bench: int, z: arb) -> None:
        super().__init__(chain.sizes[bench:])
        self.chain, self.bench = chain, bench
        self.handles = [chain.path.at(z)]
        piece, t = self.handles[0]
        self.points, self.places = [piece.point(t)], [z]
        self._tangents: list[acb] = []

    def grow_to(self, count: int) -> None:
        """Place at least this number of benches, if the dragon has as many."""
        while len(self.centres) < min(count, len(self.sizes)):
            k = len(self.centres)
            self.handles.append(self.chain.path.behind(self.handles[k], self.sizes[k].chord))
            piece, t = self.handles[-1]
            self.points.append(piece.point(t))
            self.places.append(piece.place(t))
            self.centres.append((self.points[k] + self.points[k + 1]) / 2)
            self.along.append((self.points[k] - self.points[k + 1]) / self.sizes[k].chord)

    def far_from(self, count: int) -> bool:
        """False: no bound covers all benches of a route at once; comparing them pair by pair is quick (10.)."""
        return False

    def angles(self, k: int) -> tuple[arb, arb]:
        """From bench k's direction to the path's at its front and its rear handle [rad]."""
        for piece, t in self.handles[len(self._tangents) : k + 2]:
            self._tangents.append(piece.tangent(t))
        back = self.along[k].conjugate()
        return (back * self._tangents[k]).arg(), (back * self._tangents[k + 1]).arg()
