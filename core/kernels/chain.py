"""Either kind of path, and the chain of one instant on it.

`place` falls in the direction of travel: the arc length from the centre of a spiral, minus s on a route.
"""

import cython
from cython.cimports.libc.math import fabs

if not cython.compiled:  # for the compiler the same stands in the .pxd
    from core.kernels.constants import *
    from core.kernels.rounding import route_rounding, spiral_rounding
    from core.kernels.route import extend_route, start_route
    from core.kernels.spiral import extend_chain, spiral_theta, start_chain


class Curve:
    """A path. kind: ON_SPIRAL or ON_ROUTE; growth: of the spiral [m/rad], 1 on a route; pieces: the table of a route"""

    def __init__(self, kind, growth, pieces):
        self.kind = kind
        self.growth = growth
        self.pieces = pieces


def spiral_curve(growth):
    """The spiral of a growth [m/rad]."""
    return Curve(ON_SPIRAL, growth, None)


def route_curve(pieces):
    """The route of a table of pieces."""
    return Curve(ON_ROUTE, 1.0, pieces)


def extend(curve, first, last, sizes, chain):
    """Handles after `first` to the `last`; returns last, FOLDED at a fold."""
    if curve.kind == ON_SPIRAL:
        return extend_chain(curve.growth, first, last, FREE, sizes, chain)
    return extend_route(curve.pieces, first, last, FREE, sizes, chain)


def start(curve, place, chain):
    """Row 0 of a chain: the head at a place."""
    if curve.kind == ON_SPIRAL:
        start_chain(spiral_theta(place / curve.growth), chain)
    else:
        start_route(curve.pieces, -place, chain)


def place_chain(curve, place, last, sizes, chain):
    """The chain with its head at a place, up to handle `last`; returns last, FOLDED at a fold."""
    start(curve, place, chain)
    return extend(curve, 0, last, sizes, chain)


def chain_rounding(curve, last, sizes, chain):
    """Fills in SLIP, ERROR and SWAY of a chain up to handle `last`: largest errors of its handles and benches."""
    if curve.kind == ON_SPIRAL:
        spiral_rounding(curve.growth, last, sizes, chain)
    else:
        route_rounding(curve.pieces, last, sizes, chain)


def route_tail(pieces, s, benches, sizes, chain):
    """Place of the last handle with the head at s on a route [m]."""
    start_route(pieces, s, chain)
    extend_route(pieces, 0, benches, FREE, sizes, chain)
    return -chain[benches, PLACE]


def route_trajectory(pieces, s, head_speed, sizes, chain, position, velocity, speed):
    """spiral_trajectory() on a route. s: (T,) of the head [m]; chain: (n + 1, CHAIN_COLUMNS) scratch"""
    last = position.shape[1] - 1
    with cython.nogil:
        for row in range(s.shape[0]):
            start_route(pieces, s[row], chain)
            extend_route(pieces, 0, last, FREE, sizes, chain)
            for k in range(last + 1):
                position[row, k, 0] = chain[k, PX]
                position[row, k, 1] = chain[k, PY]
                velocity[row, k, 0] = head_speed * chain[k, RATE] * chain[k, TX]
                velocity[row, k, 1] = head_speed * chain[k, RATE] * chain[k, TY]
                speed[row, k] = head_speed * fabs(chain[k, RATE])
