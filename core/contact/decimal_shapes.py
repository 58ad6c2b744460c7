"""Rectangles, coils and clothoids in decimals: separations, points and angles to 30 digits.

Sine, cosine and the separation are written out here, because the module decimal has none. mpmath would save 20 lines,
but it is one more requirement, and the same contacts would take 1.25 to 1.4 times as long (44 instead of 35 ms,
measured 2026-11-21). python-flint needs 0.6 microseconds for a sine with its cosine and 1.4 for an arc length, while
decimal needs 21 and 26 (measured 2026-11-22); but it takes 27 MB, it is not part of every installation, and one answer
should have one method.
"""

from __future__ import annotations

from decimal import Decimal
from typing import NamedTuple

from core import kernels

# An angle has up to 6e5 rad, and its error is enlarged by the radius: at 1e5 m chords are met within 1e-36 m, with 40
# digits only within 1e-30 m. A near graze takes 12 % longer than with 40 digits (measured 2026-11-26).
DIGITS = 48
# Smallest term of a series [1]: the five doublings after it enlarge an error at most a thousandfold.
LAST_TERM = Decimal("1e-51")
# Largest error of a gap [m]: each of up to LAST_BENCH links has an error of at most NEGLIGIBLE, or nothing is claimed;
# a fold may enlarge it a hundred million times, and overhangs ten thousand times.
GAP_ROUNDING = Decimal("1e-20")
TWO_PI = Decimal("6.2831853071795864769252867665590057683943387987502116419498891846156")

Vector = tuple[Decimal, Decimal]


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
CORNERS = ((-1, -1), (-1, 1), (1, -1), (1, 1))
_FACES = [BenchAxis(owner, *parts) for owner in (0, 1) for parts in _NORMALS]


# Distance from a rectangle is a convex function of the place, and so is the larger of the two excesses inside of it. So
# on the chord of a corner's way neither exceeds the larger of its values at both ends.
def beyond(ends: list[tuple[Bench, Bench]], corner: tuple[int, int], bend: Decimal) -> Decimal:
    """Upper bound of the distance of a corner of the second rectangle from the first between two instants [m].

    bend: most by which a coordinate leaves the chord between its values at both ends [m]
    """
    inside, outside = [], []
    for own, other in ends:
        x, y = _local(own, corner_of(other, corner))
        dx, dy = abs(x) - own.half_length, abs(y) - own.half_width
        inside.append(max(dx, dy))
        outside.append((dx.max(_NONE) ** 2 + dy.max(_NONE) ** 2).sqrt())
    within = max(inside) + bend
    return within if within <= 0 else max(outside) + 2 * bend


def crosses(ends: list[tuple[Bench, Bench]], bend: Decimal) -> bool:
    """True if an edge (first) lies between two corners of a rectangle (second) from one instant to another.

    bend: as for beyond()
    """
    sides: set[bool] = set()
    for corner in CORNERS:
        places = [_local(edge, corner_of(bench, corner)) for edge, bench in ends]
        along = max(abs(x) for x, _ in places) + bend <= ends[0][0].half_length
        left, right = min(y for _, y in places) >= bend, max(y for _, y in places) <= -bend
        if along and left is not right:
            sides.add(left)
    return len(sides) == 2


def corner_of(bench: Bench, corner: tuple[int, int]) -> Vector:
    """A corner of a rectangle: front or rear (1, -1), left or right."""
    ux, uy = bench.along
    length, width = corner[0] * bench.half_length, corner[1] * bench.half_width
    return bench.centre[0] + length * ux - width * uy, bench.centre[1] + length * uy + width * ux


def _nearest_corner(owner: int, own: Bench, other: Bench) -> tuple[Decimal, BenchAxis]:
    """Least distance from a corner of the other bench to this one [m], and its direction."""
    gaps = []
    for corner in CORNERS:
        x, y = _local(own, corner_of(other, corner))
        dx = (abs(x) - own.half_length).max(_NONE).copy_sign(x)
        dy = (abs(y) - own.half_width).max(_NONE).copy_sign(y)
        gap = (dx * dx + dy * dy).sqrt()
        gaps.append((gap, BenchAxis(owner, dx / gap, dy / gap) if gap else _FACES[0]))
    return min(gaps)


def _local(bench: Bench, point: Vector) -> Vector:
    dx, dy = point[0] - bench.centre[0], point[1] - bench.centre[1]
    return dx * bench.along[0] + dy * bench.along[1], dy * bench.along[0] - dx * bench.along[1]


def distance(a: Vector, b: Vector) -> Decimal:
    return ((a[0] - b[0]) ** 2 + (a[1] - b[1]) ** 2).sqrt()


def coil_theta(arc: Decimal) -> Decimal:
    """Polar angle of a spiral at an arc length from its centre, in units of growth.

    One step of Chebyshev's method from kernels.spiral_theta(), whose relative error is a few 1e-16. With f the excess
    of the arc length, f' = sqrt(1 + theta^2) and f'' = theta / f', the step is -f / f' (1 + f f'' / (2 f'^2)). The
    error after it is below the third power of the one before, divided by 2 theta^2 for large theta: 1e-39 at 1e5 turns.
    """
    theta = Decimal(kernels.spiral_theta(float(arc)))
    square = 1 + theta * theta
    root = square.sqrt()
    step = (coil_arc(theta) - arc) / root
    return theta - step * (1 + step * theta / (2 * square))


def coil_arc(theta: Decimal) -> Decimal:
    """Arc length of a spiral from its centre, in units of growth."""
    root = (1 + theta * theta).sqrt()
    return (theta * root + (theta + root).ln()) / 2


def cos_sin(angle: Decimal) -> Vector:
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


def clothoid_way(p: Decimal, q: Decimal) -> Vector:
    """The integral of e^(i (p x + q x^2 / 2)) from 0 to 1, by the series of core/kernels/clothoid.py."""
    term, before, total, n = (Decimal(1), Decimal(0)), (Decimal(0), Decimal(0)), (Decimal(1), Decimal(0)), 0
    while max(map(abs, (*term, *before))) > LAST_TERM:
        a, b = p / (n + 2), q * n / ((n + 1) * (n + 2))
        term, before = (-(a * term[1] + b * before[1]), a * term[0] + b * before[0]), term
        total, n = (total[0] + term[0], total[1] + term[1]), n + 1
    return total
