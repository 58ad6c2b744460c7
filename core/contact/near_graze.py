"""Two benches to 30 digits, for contacts so near a graze that the rounding of doubles hides their beginning.

The model is that of the kernels: their doubles (chords, the table of a route) are taken as exact, and the chain
is solved again in decimal arithmetic, starting from the kernels' result. Curves through waypoints are not covered,
because their arc length is itself a quadrature.

Sine, cosine and the separation are written out here, because the module decimal has none. mpmath would save 20 lines,
but it is one more requirement, and the same contacts would take 1.25 to 1.4 times as long (44 instead of 35 ms,
measured 2026-11-21). python-flint needs 0.6 microseconds for a sine with its cosine and 1.4 for an arc length, while
decimal needs 21 and 26 (measured 2026-11-22); but it takes 27 MB, it is not part of every installation, and one answer
should have one method.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager, suppress
from decimal import Decimal, localcontext
from itertools import product
from threading import Lock
from typing import NamedTuple

from core import kernels
from core.contact.search import Search
from core.kernels import NO_BRACKET, Budget, Ended
from core.kernels.constants import (
    ARC,
    ARC_ANGLE,
    ARC_RADIUS,
    CENTRE_X,
    CENTRE_Y,
    CHORD,
    COIL_ARC,
    COIL_GROWTH,
    COIL_ROTATION,
    CREST,
    CUBIC,
    HALF_WIDTH,
    LAG,
    LINE,
    LINE_DX,
    LINE_DY,
    LINE_X,
    LINE_Y,
    PIECE_KIND,
    S_START,
    SIGN,
    TX,
    UX,
)
from core.kernels.results import Marched
from core.sampling import falls_to_zero

# An angle has up to 6e5 rad, and its error is enlarged by the radius: at 1e5 m chords are met within 1e-36 m, with 40
# digits only within 1e-30 m. A near graze takes 12 % longer than with 40 digits (measured 2026-11-26).
DIGITS = 48
# Allowed error of a chord [m], and most steps towards it, of which three are enough except near a fold.
NEGLIGIBLE = Decimal("1e-34")
LINK_STEPS = 40
# Smallest term of a series [1]: the five doublings after it enlarge an error at most a thousandfold.
LAST_TERM = Decimal("1e-51")
# Largest error of a gap [m]: each of up to LAST_BENCH links has an error of at most NEGLIGIBLE, or nothing is claimed;
# a fold may enlarge it a hundred million times, and overhangs ten thousand times.
GAP_ROUNDING = Decimal("1e-20")
# Shortest interval of a proof [m].
SHORTEST = 1e-13
# Largest relative error of a travel that is divided by the head speed, in doubles, and multiplied again [1].
CLEAR_ROUNDING = 4.0 * kernels.ULP
TWO_PI = Decimal("6.2831853071795864769252867665590057683943387987502116419498891846156")
# Last bench of a pair in decimals, because each handle takes a third of a millisecond for each instant [1]; and most
# intervals before a proof is given up: about a second in all.
LAST_BENCH = 60
# Largest relative error of a bound on a second derivative, and of its product with h^2 [1].
CURVATURE_ROUNDING = 1e-12
INTERVALS_MAX = 60
# Columns of what a column of a piece has lost in rounding.
LOWS = {S_START: kernels.S_START_LOW, COIL_ARC: kernels.COIL_ARC_LOW, COIL_GROWTH: kernels.COIL_GROWTH_LOW}
# Groups of columns in a chain row of the kernels.
TANGENT, LINK = slice(TX, TX + 2), slice(UX, UX + 2)

Vector = tuple[Decimal, Decimal]


class Unsolved(ArithmeticError):
    """A link whose chord is not met within NEGLIGIBLE after LINK_STEPS."""


# Decimals hold Python's lock: several threads would not be faster together, and would make all others wait.
_ALONE = Lock()
# Time between two checks of the budget while another thread computes [s].
LOOK_SECONDS = 0.01


@contextmanager
def _alone(budget: Budget) -> Iterator[None]:
    """A context for one thread at a time. raises: Halted"""
    while not _ALONE.acquire(timeout=LOOK_SECONDS):
        budget.look()
    try:
        yield
    finally:
        _ALONE.release()


class Bench(NamedTuple):
    """Centre [m], unit vector towards the front, half length and half width [m]."""

    centre: Vector
    along: Vector
    half_length: Decimal
    half_width: Decimal


class BenchAxis(NamedTuple):
    """A unit vector fixed in the first (0) or the second (1) bench of a pair, by its parts along it and to its left.

    It points to the place of the other bench when the axis was chosen. A gap along it proves an interval clear only if
    it keeps its sign: a bench on one side at the start and on the other at the end has passed through.
    """

    owner: int
    along: Decimal
    left: Decimal


class ExactPair:
    """Two benches of a search: their places and their separation.

    can_follow: True if the path has no curve through waypoints, and the pair is not further back than LAST_BENCH
    """

    def __init__(self, search: Search, pair: tuple[int, int]) -> None:
        self.search, self.pair = search, pair
        path = search.path
        self.pieces = [[Decimal(number) for number in row] for row in path.as_route(path.end).table.tolist()]
        with localcontext() as context:
            context.prec = DIGITS
            for row, column in product(self.pieces, LOWS):
                row[column] += row[LOWS[column]]
        kinds = {int(row[PIECE_KIND]) for row in self.pieces}
        self.can_follow = pair[1] <= LAST_BENCH and not kinds & {CUBIC, CREST}

    def benches(self, travel: Decimal) -> tuple[Bench, Bench]:
        """The two benches with the head at a travel [m]. raises: Unsolved"""
        search = self.search
        search.place_leaders(float(travel), self.pair[1] + 1)
        rows, path = search.placed, search.path
        s, points = travel, [self._point(path.piece_at(rows[0]), travel)]
        for k in range(self.pair[1] + 1):
            chord, piece = Decimal(float(search.sizes[k, CHORD])), path.piece_at(rows[k + 1])
            s = Decimal(float(path.along(rows[k + 1, LAG])))
            slope = Decimal(float(rows[k + 1, TANGENT] @ rows[k, LINK]))
            for _ in range(LINK_STEPS):
                point = self._point(piece, s)
                excess = _distance(points[-1], point) - chord
                if abs(excess) < NEGLIGIBLE:
                    break
                s += excess / slope
            else:
                raise Unsolved(f"link {k}")
            points.append(point)
        first, second = (self._bench(k, points[k], points[k + 1]) for k in self.pair)
        return first, second

    def gap(self, travel: Decimal) -> Decimal:
        """Separation of the two less the margin [m]. raises: Unsolved"""
        self.search.budget.look()
        return exact_separation(*self.benches(travel))[0] - Decimal(self.search.margin)

    def stays_apart(self, start: float, stop: float) -> bool:
        """True if the two are proven to be further apart than the margin from one travel to another [m].

        raises: Unsolved
        """
        search, margin = self.search, Decimal(self.search.margin)
        a, b = self.pair
        tried = 0
        while start < stop:
            here = self.benches(Decimal(start))
            h = stop - start
            while True:
                self.search.budget.look()
                slack = search.travel_rounding(start, stop)
                place = search.place - start + slack
                curvatures = kernels.pair_curvatures(search.scene, search.probe, place, h + 2.0 * slack, a, b)
                if max(curvatures) >= kernels.FREE:
                    return False
                there = self.benches(Decimal(start + h))
                axis = exact_separation(*there)[1]
                least = min(exact_gap(*here, axis), exact_gap(*there, axis)) - margin
                if least > GAP_ROUNDING + Decimal((1.0 + CURVATURE_ROUNDING) * curvatures[axis.owner] * h * h / 8.0):
                    break
                h *= 0.5
                tried += 1
                if h < SHORTEST or tried > INTERVALS_MAX:
                    return False
            start = start + h if start + h < stop else stop
        return True

    def _bench(self, k: int, front: Vector, rear: Vector) -> Bench:
        chord, half_length, half_width = (
            Decimal(number) for number in self.search.sizes[k, CHORD : HALF_WIDTH + 1].tolist()
        )
        centre = ((front[0] + rear[0]) / 2, (front[1] + rear[1]) / 2)
        return Bench(centre, ((front[0] - rear[0]) / chord, (front[1] - rear[1]) / chord), half_length, half_width)

    def _point(self, piece: int, s: Decimal) -> Vector:
        """Point at arc length s of a row of the table, see core/kernels/constants.py."""
        row = self.pieces[piece]
        kind, u = row[PIECE_KIND], s - row[S_START]
        if kind == LINE:
            return row[LINE_X] + u * row[LINE_DX], row[LINE_Y] + u * row[LINE_DY]
        if kind == ARC:
            radius, angle = row[ARC_RADIUS], row[ARC_ANGLE] + row[SIGN] * u / row[ARC_RADIUS]
        else:
            theta = _theta((row[COIL_ARC] + row[SIGN] * u) / row[COIL_GROWTH])
            radius, angle = row[COIL_GROWTH] * theta, theta + row[COIL_ROTATION]
        cos, sin = _cos_sin(angle)
        return row[CENTRE_X] + radius * cos, row[CENTRE_Y] + radius * sin


def exact_separation(first: Bench, second: Bench) -> tuple[Decimal, BenchAxis]:
    """Signed separation of two rectangles [m], as in core.separation(), and the axis along which they have it."""
    faces = [(exact_gap(first, second, axis), axis) for axis in _FACES]
    gap, axis = max(faces)
    if gap <= 0:
        return gap, axis
    nearest = min(_nearest_corner(0, first, second), _nearest_corner(1, second, first))
    # If a corner faces an edge, both are equal; and the direction between touching points is only rounding.
    return nearest if nearest[0] - gap > GAP_ROUNDING else (gap, axis)


def exact_gap(first: Bench, second: Bench, axis: BenchAxis) -> Decimal:
    """Gap of two rectangles along an axis from its owner to the other one [m]; at most their separation."""
    own, other = (first, second) if axis.owner == 0 else (second, first)
    (x, y), (ux, uy) = _local(own, other.centre), other.along
    along, left = own.along[0] * ux + own.along[1] * uy, own.along[0] * uy - own.along[1] * ux
    reach = abs(axis.along) * own.half_length + abs(axis.left) * own.half_width
    reach += abs(axis.along * along + axis.left * left) * other.half_length
    reach += abs(axis.left * along - axis.along * left) * other.half_width
    return axis.along * x + axis.left * y - reach


_ONE, _NONE = Decimal(1), Decimal(0)
_NORMALS = ((_ONE, _NONE), (_NONE, _ONE), (-_ONE, _NONE), (_NONE, -_ONE))
_FACES = [BenchAxis(owner, *parts) for owner in (0, 1) for parts in _NORMALS]


def _nearest_corner(owner: int, own: Bench, other: Bench) -> tuple[Decimal, BenchAxis]:
    """Least distance from a corner of the other bench to this one [m], and its direction."""
    found = []
    for a in (-1, 1):
        for b in (-1, 1):
            ux, uy = other.along
            length, width = a * other.half_length, b * other.half_width
            x, y = _local(own, (other.centre[0] + length * ux - width * uy, other.centre[1] + length * uy + width * ux))
            dx = (abs(x) - own.half_length).max(_NONE).copy_sign(x)
            dy = (abs(y) - own.half_width).max(_NONE).copy_sign(y)
            gap = (dx * dx + dy * dy).sqrt()
            found.append((gap, BenchAxis(owner, dx / gap, dy / gap) if gap else _FACES[0]))
    return min(found)


def _local(bench: Bench, point: Vector) -> Vector:
    dx, dy = point[0] - bench.centre[0], point[1] - bench.centre[1]
    return dx * bench.along[0] + dy * bench.along[1], dy * bench.along[0] - dx * bench.along[1]


def _distance(a: Vector, b: Vector) -> Decimal:
    return ((a[0] - b[0]) ** 2 + (a[1] - b[1]) ** 2).sqrt()


def _theta(arc: Decimal) -> Decimal:
    """Polar angle of a spiral at an arc length from its centre, in units of growth.

    One step of Chebyshev's method from kernels.spiral_theta(), whose relative error is a few 1e-16. With f the excess
    of the arc length, f' = sqrt(1 + theta^2) and f'' = theta / f', the step is -f / f' (1 + f f'' / (2 f'^2)). The
    error after it is below the third power of the one before, divided by 2 theta^2 for large theta: 1e-39 at 1e5 turns.
    """
    theta = Decimal(kernels.spiral_theta(float(arc)))
    square = 1 + theta * theta
    root = square.sqrt()
    step = (_arc(theta) - arc) / root
    return theta - step * (1 + step * theta / (2 * square))


def _arc(theta: Decimal) -> Decimal:
    """Arc length of a spiral from its centre, in units of growth."""
    root = (1 + theta * theta).sqrt()
    return (theta * root + (theta + root).ln()) / 2


def _cos_sin(angle: Decimal) -> Vector:
    """Cosine and sine, by the series of the exponential for the angle reduced to [-pi, pi] and halved five times."""
    x = angle.remainder_near(TWO_PI) / 32
    cos, sin, term, k = Decimal(1), Decimal(0), Decimal(1), 0
    while abs(term) > LAST_TERM:
        k += 1
        term = term * x / k
        if k % 2:
            sin += term if k % 4 == 1 else -term
        else:
            cos += term if k % 4 == 0 else -term
    for _ in range(5):
        cos, sin = cos * cos - sin * sin, 2 * cos * sin
    return cos, sin


# From `proven` on the gap of the pair falls until it touches. The first instant t within the margin is found, by the
# false position, between an instant apart and one within. The interval before t is proven as in the kernels: along an
# axis fixed in one of the benches, with its sign, the gap is below its chord by at most K x (h - x) / 2, with the
# kernels' K, in as many intervals as necessary. All other pairs are marched over the same interval in doubles.
#
# The claims are about times, which are travels divided by the head speed in doubles: the pair is within the margin at
# the true travel of the later time, and apart until a little beyond that of the earlier one.
def narrowed(search: Search, found: Marched, half: float, head_speed: float = 1.0) -> Marched | None:
    """The wide bracket of a contact, narrowed to half width `half` [m]; None if that is not proven.

    found: result of Search.march() with `proven`, `touching` and the pair; so is the returned value, and its contact is
        at `touching` - `half`
    head_speed: speed that turns travels into times [m/s]
    """
    pair = ExactPair(search, found.benches)
    if found.touching is None or not pair.can_follow:
        return None
    if not others_clear(search, pair.pair, found.proven, found.touching):
        return None
    search.budget.take_time()
    with _alone(search.budget), localcontext() as context, suppress(Unsolved):
        context.prec = DIGITS
        low, high = Decimal(found.proven), Decimal(found.touching)
        above, below = pair.gap(low), pair.gap(high)
        if not above > GAP_ROUNDING or not below < -GAP_ROUNDING:
            return None
        contact = float(falls_to_zero(pair.gap, low, high, above, below, Decimal(half) / 1000))
        clear, touching = contact - half, contact + half
        later = Decimal(touching / head_speed) * Decimal(head_speed)
        beyond = clear + abs(clear) * CLEAR_ROUNDING
        if pair.gap(later) <= -GAP_ROUNDING and pair.stays_apart(found.proven, beyond):
            return found._replace(proven=clear, touching=touching)
    return None


def others_clear(search: Search, pair: tuple[int, int], start: float, stop: float) -> bool:
    """True if all pairs except one are proven clear between two travels [m]."""
    search.scene.left_out, search.scene.left_out_too = pair
    state, _ = search.march(stop, NO_BRACKET, start=start)
    search.scene.left_out = search.scene.left_out_too = kernels.NO_BENCH
    return state is Ended.REACHED
