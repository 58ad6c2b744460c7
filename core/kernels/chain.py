"""Either kind of path.

`place` falls in the direction of travel: the arc length from the centre of a spiral, minus s on a route. A path
without pieces is the spiral of that growth.
"""

import cython
from cython.cimports.libc.math import fabs

if not cython.compiled:  # for the compiler the same stands in the .pxd
    from core.kernels.constants import *
    from core.kernels.route import extend_route, route_rounding, start_route
    from core.kernels.spiral import extend_chain, spiral_rounding, spiral_theta, start_chain


def extend(growth, pieces, first, last, sizes, chain):
    """Handles after `first` to the `last`; returns last, -1 at a fold."""
    if pieces.shape[0] == 0:
        return extend_chain(growth, first, last, FREE, sizes, chain)
    return extend_route(pieces, first, last, FREE, sizes, chain)


def place_chain(growth, pieces, place, last, sizes, chain):
    """The chain with its head at a place, up to handle `last`; returns last, -1 at a fold."""
    if pieces.shape[0] == 0:
        start_chain(spiral_theta(place / growth), chain)
    else:
        start_route(pieces, -place, chain)
    return extend(growth, pieces, 0, last, sizes, chain)


def chain_rounding(growth, pieces, last, sizes, chain):
    """Fills in SLIP, ERROR and SWAY of a chain up to handle `last`: what its handles and benches may be off by."""
    if pieces.shape[0] == 0:
        spiral_rounding(growth, last, sizes, chain)
    else:
        route_rounding(pieces, last, sizes, chain)


def route_tail(pieces, s, benches, sizes, chain):
    """Where the last handle stands with the head at s on a route [m]."""
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
