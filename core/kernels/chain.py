"""A path of either kind, and the chain of handles at one instant on a spiral (on a route: core/kernels/route.py).

`place` falls in the direction of travel: the arc length from the centre of a spiral, minus s on a route.
"""

import cython
from cython.cimports.libc.math import fabs, sqrt

if not cython.compiled:  # the .pxd imports the same names for the compiler
    from core.kernels.constants import *
    from core.kernels.double_double import coil_theta
    from core.kernels.rounding import route_rounding, spiral_rounding
    from core.kernels.route import extend_route, start_route
    from core.kernels.spiral import first_guess, next_handle


class Curve:
    """A path. is_spiral: else a route; pieces: the table of a route

    growth: of the spiral [m/rad], 1 on a route: metres along the path for each unit of LAG, at least
    growth_low, place_low: what growth and the origin of places on a spiral have lost in rounding [m/rad], [m]
    """

    def __init__(self, is_spiral, growth, growth_low, place_low, pieces):
        self.is_spiral = is_spiral
        self.growth = growth
        self.growth_low = growth_low
        self.place_low = place_low
        self.pieces = pieces


def spiral_curve(growth, growth_low=0.0, place_low=0.0):
    """The spiral of a growth [m/rad]."""
    return Curve(True, growth, growth_low, place_low, None)


def route_curve(pieces):
    """The route of a table of pieces."""
    return Curve(False, 1.0, 0.0, 0.0, pieces)


def head_theta(curve, place):
    """Polar angle of the head on a spiral at a place."""
    return coil_theta(curve.growth, curve.growth_low, place, curve.place_low, 0.0, 0.0)[0]


def start_chain(theta, chain):
    """Row 0: the head at polar angle 0."""
    length = sqrt(1.0 + theta * theta)
    chain[0, COS] = 1.0
    chain[0, SIN] = 0.0
    chain[0, TX] = -1.0 / length
    chain[0, TY] = -theta / length
    chain[0, THETA] = theta
    chain[0, REST] = 0.0
    chain[0, RATE] = 1.0
    chain[0, FILLED] = chain[0, SLIP] = 0.0


# Input:  a chain on a spiral up to handle `first` (start_chain() lays out the head), the growth, and the chords.
# State:  k, the last handle placed; `alike`, the number of equal chords up to it, whose deltas predict the next one.
# Output: the rows of the handles up to a radius or the last one, and of the benches between them; that handle's
#         number.
def extend_chain(growth, first, last, radius, sizes, chain):
    """Place handles after `first` up to one at `radius` [m] or the `last`; returns its number, FOLDED at a fold."""
    delta = 0.0
    k = first
    alike = 0
    while alike < 5 and alike < first < last and sizes[first - 1 - alike, CHORD] == sizes[first, CHORD]:
        alike += 1
    while k < last and growth * chain[k, THETA] < radius:
        theta = chain[k, THETA]
        chord = sizes[k, CHORD]
        inverse = 1.0 / chord
        chord2 = (chord / growth) * (chord / growth)
        if k > first:
            alike = alike + 1 if sizes[k - 1, CHORD] == chord else 0
        if alike > 4:
            delta = 5.0 * (theta - chain[k - 1, THETA] - (chain[k - 3, THETA] - chain[k - 4, THETA]))
            delta += 10.0 * (chain[k - 2, THETA] - chain[k - 3, THETA] - (chain[k - 1, THETA] - chain[k - 2, THETA]))
            delta += chain[k - 4, THETA] - chain[k - 5, THETA]
        elif alike > 2:
            delta = 3.0 * (theta - chain[k - 1, THETA] - (chain[k - 1, THETA] - chain[k - 2, THETA]))
            delta += chain[k - 2, THETA] - chain[k - 3, THETA]
        else:
            delta = first_guess(theta, chord2)
        delta, s, c = next_handle(theta, chord2, delta)
        if delta == NO_ROOT:
            return FOLDED
        sine = 2.0 * s * c
        versine = 2.0 * s * s
        cos_a = chain[k, COS]
        sin_a = chain[k, SIN]
        chain[k + 1, COS] = cos_b = cos_a - (cos_a * versine + sin_a * sine)
        chain[k + 1, SIN] = sin_b = sin_a - (sin_a * versine - cos_a * sine)
        rest = delta + chain[k, REST]
        rear = theta + rest
        added = rear - theta
        chain[k + 1, REST] = (theta - (rear - added)) + (rest - added)
        chain[k + 1, THETA] = rear
        inverse_length = 1.0 / sqrt(1.0 + rear * rear)
        chain[k + 1, TX] = (rear * sin_b - cos_b) * inverse_length
        chain[k + 1, TY] = -(rear * cos_b + sin_b) * inverse_length
        x = growth * theta * cos_a
        y = growth * theta * sin_a
        x_b = growth * rear * cos_b
        y_b = growth * rear * sin_b
        chain[k, MX] = 0.5 * (x + x_b)
        chain[k, MY] = 0.5 * (y + y_b)
        chain[k, UX] = (x - x_b) * inverse
        chain[k, UY] = (y - y_b) * inverse
        chain[k + 1, RATE] = (
            chain[k, RATE]
            * (chain[k, TX] * chain[k, UX] + chain[k, TY] * chain[k, UY])
            / (chain[k + 1, TX] * chain[k, UX] + chain[k + 1, TY] * chain[k, UY])
        )
        k += 1
    return k


def extend(curve, first, last, sizes, chain):
    """Place handles after `first` up to the `last`; returns last, FOLDED at a fold."""
    if curve.is_spiral:
        return extend_chain(curve.growth, first, last, FREE, sizes, chain)
    return extend_route(curve.pieces, first, last, FREE, sizes, chain)


def start(curve, place, chain):
    """Fill in row 0 of a chain: the head at a place."""
    if curve.is_spiral:
        start_chain(head_theta(curve, place), chain)
    else:
        start_route(curve.pieces, -place, 0.0, chain)


def place_chain(curve, place, last, sizes, chain):
    """Fill in the chain with its head at a place, up to handle `last`; returns last, FOLDED at a fold."""
    start(curve, place, chain)
    return extend(curve, 0, last, sizes, chain)


def chain_rounding(curve, last, sizes, chain):
    """Fill in SLIP, ERROR and SWAY of a chain up to handle `last`: the largest errors of its handles and benches."""
    if curve.is_spiral:
        spiral_rounding(curve.growth, last, sizes, chain)
    else:
        route_rounding(curve.pieces, last, sizes, chain)


def route_trajectory(pieces, s, head_speed, sizes, chain, position, velocity, speed):
    """spiral_trajectory() on a route. s: (T, 2) of the head, pairs [m]; chain: (n + 1, CHAIN_COLUMNS) scratch"""
    last = position.shape[1] - 1
    with cython.nogil:
        for row in range(s.shape[0]):
            start_route(pieces, s[row, HIGH], s[row, LOW], chain)
            extend_route(pieces, 0, last, FREE, sizes, chain)
            for k in range(last + 1):
                position[row, k, X] = chain[k, PX]
                position[row, k, Y] = chain[k, PY]
                velocity[row, k, X] = head_speed * chain[k, RATE] * chain[k, TX]
                velocity[row, k, Y] = head_speed * chain[k, RATE] * chain[k, TY]
                speed[row, k] = head_speed * fabs(chain[k, RATE])
