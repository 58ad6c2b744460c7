"""Double-double arithmetic: the arc length of a spiral and its inverse, with twice the digits of a double.

A pair (high, low) stands for high + low. Sums and products of doubles with their rounding errors: T. J. Dekker, A
floating-point technique for extending the available precision, Numerische Mathematik 18 (1971), which holds as long as
no product is fused with a sum (setup.py).

Why: ten thousand turns of 0.3 m are 1e8 m long, of which a double knows 1.5e-8 m, and their angle of 6e4 rad only to
4e-12 rad. Places near the centre, and directions anywhere, would be wrong by as much.
"""

import cython
from cython.cimports.libc.math import asinh, fabs, log, sqrt

if not cython.compiled:  # the .pxd imports the same names for the compiler
    from core.kernels.constants import *
    from core.kernels.spiral import spiral_arc

# 2^27 + 1, which splits a double in two halves of 26 bits [1].
SPLITTER = 134217729.0
# What 2 pi is more than TWO_PI [1].
TWO_PI_LOW = 2.4492935982947064e-16
# Largest last step of Newton's iteration in doubles, relative to theta [1]: it leaves half its square, and the step in
# double-double half the square of that, 1e-25.
NEWTON_STEP = 1e-6
# Arc length from which the first guess of its inverse is within 1 % [1], in units of growth.
GUESSED = 8.0


def two_sum(a, b):
    """a + b in doubles, and what rounding took from it."""
    total = a + b
    added = total - a
    return total, (a - (total - added)) + (b - added)


def two_product(a, b):
    """a b in doubles, and what rounding took from it."""
    product = a * b
    c = SPLITTER * a
    a_high = c - (c - a)
    a_low = a - a_high
    c = SPLITTER * b
    b_high = c - (c - b)
    b_low = b - b_high
    return product, ((a_high * b_high - product) + a_high * b_low + a_low * b_high) + a_low * b_low


def quotient(a, a_low, b, b_low):
    """A pair over a pair."""
    high = a / b
    product, lost = two_product(high, b)
    return two_sum(high, (((a - product) - lost) + (a_low - high * b_low)) / b)


# arc = (theta l + asinh theta) / 2, l = sqrt(1 + theta^2). theta^2, l and their product are pairs. asinh needs none:
# its error is at most 2 ULP asinh theta, below 4e-15, which displaces a point by less than 4e-15 growth.
def arc_pair(theta, low):
    """spiral_arc() of theta + low as a pair."""
    square, lost = two_product(theta, theta)
    under, rest = two_sum(square, 1.0)
    rest += lost + 2.0 * theta * low
    length = sqrt(under)
    square, lost = two_product(length, length)
    length_low = ((under - square) - lost + rest) / (2.0 * length)
    product, lost = two_product(theta, length)
    lost += theta * length_low + low * length
    total, rest = two_sum(product, asinh(theta))
    return two_sum(0.5 * total, 0.5 * (rest + lost + low / length))


# The first guess: l = theta + 1 / (2 theta) - ... and asinh theta = log(2 theta) + ... give
# theta^2 = 2 arc - 1/2 - log(2 theta) + ..., and log(2 theta) is about log(8 arc) / 2.
def theta_pair(arc, low):
    """Polar angle at an arc length from the centre, in units of growth, as a pair (0 for a negative one)."""
    if arc <= 0.0:
        return 0.0, 0.0
    theta = sqrt(2.0 * arc - 0.5 - 0.5 * log(8.0 * arc) if arc > GUESSED else 2.0 * arc)
    for i in range(60):
        step = (spiral_arc(theta) - arc) / sqrt(1.0 + theta * theta)
        theta -= step
        if fabs(step) <= NEWTON_STEP * theta:
            break
    high, rest = arc_pair(theta, 0.0)
    return two_sum(theta, ((arc - high) + (low - rest)) / sqrt(1.0 + theta * theta))


def growth_pair(pitch):
    """pitch / (2 pi) as a pair [m/rad]."""
    growth = pitch / TWO_PI
    product, lost = two_product(growth, TWO_PI)
    return growth, ((pitch - product) - lost - growth * TWO_PI_LOW) / TWO_PI


def coil_arc(pitch, turns):
    """Arc length of a spiral from its centre to a number of turns as a pair [m]."""
    growth, growth_low = growth_pair(pitch)
    theta, low = two_product(TWO_PI, turns)
    arc, arc_low = arc_pair(theta, low + TWO_PI_LOW * turns)
    product, lost = two_product(growth, arc)
    return two_sum(product, lost + growth * arc_low + growth_low * arc)


def coil_theta(growth, growth_low, arc, arc_low, way, way_low):
    """Polar angle as a pair where a coil from an arc length from its centre has gone a way outwards [m]."""
    total, rest = two_sum(arc, way)
    total, rest = quotient(total, rest + (arc_low + way_low), growth, growth_low)
    return theta_pair(total, rest)


def spiral_thetas(growth, growth_low, length, length_low, s, thetas):
    """Fill in the polar angle at every s of a spiral. s, thetas: (S, 2) pairs; length: from start to centre [m]"""
    with cython.nogil:
        for i in range(s.shape[0]):
            thetas[i, HIGH], thetas[i, LOW] = coil_theta(
                growth, growth_low, length, length_low, -s[i, HIGH], -s[i, LOW]
            )
