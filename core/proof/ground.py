"""The ground that a bench may cover while its two holes stray, in balls: polygons around it (14.), and their sides."""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import product

import numpy as np
from flint import acb, arb

from core.proof.pairs import TouchingLine, above, below
from core.values import Floats

# Sides of each polygon, evenly spaced [1]: as many as in the search, so that grounds apart there are apart here too.
SIDES = 64
# Samples of psi on either side of 0 (15.): supports are then too large by 2e-4 of the stray at most [1].
SAMPLES = 64
# Polygons of one ground: front end, middle, rear end, and one around all three. The pairs of polygons that one side
# keeps apart, and those that need nine.
PARTS, WHOLE = range(3), 3
AT_ONCE, ONE_BY_ONE = [(WHOLE, WHOLE)], list(product(PARTS, PARTS))

# The sides of a polygon by number, and the direction of each in doubles.
NUMBERS = np.arange(SIDES)
ROUGH_OUTWARDS = np.exp(1j * math.tau / SIDES * NUMBERS)


class BenchGround:
    """The ground of one kind of bench [m].

    outwards: SIDES unit vectors; supports, corners: (4, SIDES) of its polygons, corner k where sides k and k + 1 meet
    rough_supports, rough_corners: the same in doubles
    """

    def __init__(self, half_chord: arb, half_length: arb, half_width: arb, stray: arb) -> None:
        self.outwards = [(acb(2 * k) / SIDES).exp_pi_i() for k in range(SIDES)]
        motions = _motions(2 * half_chord, stray)
        spares = [_spare(2 * half_chord, stray, abs(acb(x, half_width))) for x in (half_length, half_chord)]
        # The ground is symmetric about its axis.
        left = [
            _supports(way, motions, stray, (half_chord, half_length, half_width))
            for way in self.outwards[: SIDES // 2 + 1]
        ]
        front, middle = ([values[part] + spare for values in left + left[-2:0:-1]] for part, spare in enumerate(spares))
        rear = front[SIDES // 2 :] + front[: SIDES // 2]
        whole = [a.max(b).max(c) for a, b, c in zip(front, middle, rear, strict=True)]
        self.supports = [front, middle, rear, whole]
        self.corners = [self._corners(supports) for supports in self.supports]
        self.rough_supports = np.array([[float(value) for value in row] for row in self.supports])
        self.rough_corners = np.array([[complex(value) for value in row] for row in self.corners])

    def _corners(self, supports: Sequence[arb]) -> list[acb]:
        step, sides = self.outwards[1], zip(self.outwards, supports, [*supports[1:], supports[0]], strict=True)
        return [way * acb(here, (after - here * step.real) / step.imag) for way, here, after in sides]


def _motions(chord: arb, stray: arb) -> list[tuple[arb, acb]]:
    """|q| / stray and exp(i phi / 2) at all samples of psi (15.)."""
    sines = [(arb(k) / (2 * SAMPLES)).sin_pi() for k in range(-SAMPLES, SAMPLES + 1)]
    halves = [sine * stray / chord for sine in sines]
    return [(abs(sine), acb((1 - half**2).sqrt(), half)) for sine, half in zip(sines, halves, strict=True)]


def _supports(
    way: acb, motions: Sequence[tuple[arb, acb]], stray: arb, half_sizes: tuple[arb, arb, arb]
) -> tuple[arb, arb]:
    """Largest distances that the front end and the middle of a bench reach in a direction, at the samples (15.) [m].

    half_sizes: half of the chord, of the length and of the width [m]
    """
    half_chord, half_length, half_width = half_sizes
    back, front, middle = way.conjugate(), arb("-inf"), arb("-inf")
    for q, half in motions:
        leaning = back * half
        along, across = abs(leaning.real), abs(leaning.imag)
        lens = along * (1 - q**2).nonnegative_part().sqrt() if q > across else 1 - q * across
        rotated = leaning * half
        beside = stray * lens + abs(rotated.imag) * half_width
        front = front.max(beside + (rotated.real * half_chord).max(rotated.real * half_length))
        middle = middle.max(beside + abs(rotated.real) * half_chord)
    return front, middle


def _spare(chord: arb, stray: arb, furthest: arb) -> arb:
    """Distance by which they may reach further between two samples (15.) [m]. furthest: of them from the middle [m]"""
    kappa = stray / chord
    steep = kappa / (1 - kappa**2).sqrt()
    second = stray * (1 + 2 * kappa + kappa**2 + steep) + furthest * (4 * kappa**2 + 2 * steep)
    return second * (arb.pi() / (2 * SAMPLES)) ** 2 / 8


class PolygonSide(TouchingLine):
    """A side of a polygon of one of two grounds a, b; a polygon of the other is beyond if its corners are.

    number: 0 to SIDES - 1 for the first ground's sides, from SIDES on for the second's; hulls: a polygon of each
    """

    def __init__(self, number: int, hulls: tuple[int, int], first: BenchGround, second: BenchGround) -> None:
        self.by_partner, side = number >= SIDES, number % SIDES
        own, other = (second, first) if self.by_partner else (first, second)
        mine, beyond = reversed(hulls) if self.by_partner else hulls
        self.rotation = own.outwards[side].conjugate()
        self.support = own.supports[mine][side]
        self._outwards, self._corners = other.outwards, other.corners[beyond]

    def corners(self, axis: acb) -> Sequence[acb]:
        """The corners of TouchingLine that 16. needs. axis: of the other bench, seen along the line's normal"""
        towards = -axis.conjugate()
        guess = round(math.atan2(float(towards.imag), float(towards.real)) * SIDES / math.tau)
        off = towards * self._outwards[guess % SIDES].conjugate()
        if not off.real > 0:
            return self._corners
        sectors = (off.imag / off.real).atan() * SIDES / (2 * arb.pi())
        first, last = math.floor(below(sectors)), math.floor(above(sectors))
        return [self._corners[(guess + k) % SIDES] for k in range(first, last + 1)]


def best_side(
    first: BenchGround, second: BenchGround, hulls: tuple[int, int], places: Sequence[tuple[complex, complex]]
) -> tuple[int, float]:
    """The side that keeps two polygons furthest apart in several places, and the least gap there [m], in doubles.

    places: centre and direction of the second bench in the frame of the first
    """
    least = np.full(2 * SIDES, np.inf)
    a, b = hulls
    for to, axis in places:
        least[:SIDES] = np.minimum(least[:SIDES], _gaps(first, a, second, b, to, axis))
        back = axis.conjugate()
        least[SIDES:] = np.minimum(least[SIDES:], _gaps(second, b, first, a, -back * to, back))
    best = int(least.argmax())
    return best, float(least[best])


def _gaps(own: BenchGround, mine: int, other: BenchGround, hull: int, to: complex, axis: complex) -> Floats:
    """Distance of a polygon beyond each side of another (SIDES,) [m]."""
    nearest = (NUMBERS + SIDES // 2 + math.floor(-math.atan2(axis.imag, axis.real) * SIDES / math.tau)) % SIDES
    corner = to + axis * other.rough_corners[hull, nearest]
    gaps: Floats = (ROUGH_OUTWARDS.conjugate() * corner).real - own.rough_supports[mine]
    return gaps
