"""Curvature of the stretch of a route that a bench sweeps over an interval of head travel."""

import cython
from cython.cimports.libc.math import fabs

if not cython.compiled:  # the .pxd imports the same names for the compiler
    from core.kernels.constants import *
    from core.kernels.records import Stretch

# Largest angle by which a handle displaced along a route turns its bench, times SLIP / chord [1]: see the rounding of
# bounds.py. Half the curvature stands for 1 / chord where it is larger.
ROUTE_TURN = 2.2


def steepest_curvature(theta):
    """Upper bound of |d curvature / d s| on a spiral from theta outwards, times the square of its growth.

    The function is theta (4 + theta^2) / (1 + theta^2)^3; its maximum is 1.09022, near 0.476, and it falls from there.
    """
    square = 1.0 + theta * theta
    return 1.0903 if theta < 0.5 else theta * (3.0 + square) / (square * square * square)


def blur_of(k, turned, before, after):
    """Largest error of the cosines of a link's angles at either end of an interval [1].

    turned: largest angle by which the tangent at either handle turns per metre of its displacement along the path [1/m]
    """
    slip = max(before[k + 1, SLIP], after[k + 1, SLIP])
    return 2.0 * max(before[k, SWAY], after[k, SWAY]) + turned * slip + 16.0 * ULP


def stretch_curvature(pieces, rear, k_rear, front, k_front):
    """Lowest and highest curvature from a place on piece `rear` to one on piece `front` [1/m].

    Within a piece it lies between its ends; for a crest the row holds bounds.
    """
    low = FREE
    high = -FREE
    for p in range(rear, front + 1):
        start = pieces[p, K_START]
        end = pieces[p, K_END]
        if pieces[p, PIECE_KIND] != CREST:
            if p == rear:
                start = k_rear
            if p == front:
                end = k_front
        low = min(low, start, end)
        high = max(high, start, end)
    return low, high


def reached_piece(pieces, k, way, chain):
    """The piece of handle k, or the next one that way (1: forwards) if rounding may hide that it crossed a joint."""
    p = cython.cast(cython.Py_ssize_t, chain[k, PIECE])
    s = -chain[k, PLACE]
    slip = chain[k, SLIP] + 8.0 * ULP * fabs(s)
    if way > 0.0 and p + 1 < pieces.shape[0] and s + slip > pieces[p, S_END]:
        return p + 1
    if way < 0.0 and p > 0 and s - slip < pieces[p, S_START]:
        return p - 1
    return p


def stretch_slope(pieces, k, rear, front, before, after):
    """Bound on |d curvature / d s| from the rear of bench k, on piece `rear`, to its front over an interval [1/m^2].

    Jumps of the curvature are left out. On a spiral the slope falls with theta, so that the value at the innermost
    handle serves (see steepest_curvature()).
    """
    slope = 0.0
    if rear == front and pieces[rear, PIECE_KIND] == SPIRAL:
        theta = min(before[k + 1, PIECE_THETA], after[k, PIECE_THETA])
        if theta >= 0.5:
            return steepest_curvature(theta) / (pieces[rear, COIL_GROWTH] * pieces[rear, COIL_GROWTH])
    for p in range(rear, front + 1):
        slope = max(slope, pieces[p, K_SLOPE])
    return slope


def parts_between(pieces, k, before, after):
    """Number of parts of the route by which handle k advances from the first chain to the second."""
    rear = cython.cast(cython.Py_ssize_t, before[k, PIECE])
    front = cython.cast(cython.Py_ssize_t, after[k, PIECE])
    return pieces[front, PART] - pieces[rear, PART]


def link_stretch(pieces, k, benches, sizes, before, after):
    """The stretch of a route that bench k sweeps over an interval: see Stretch in records.py."""
    chord = sizes[k, CHORD]
    p = reached_piece(pieces, k + 1, -1.0, before)
    q = reached_piece(pieces, k, 1.0, after)
    low, high = stretch_curvature(pieces, p, before[k + 1, CURVATURE], q, after[k, CURVATURE])
    slope = stretch_slope(pieces, k, p, q, before, after)
    widened = 32.0 * ULP * (benches + 8.0) / chord + pieces[0, CURVATURE_SLACK]
    widened += slope * max(before[k + 1, SLIP], after[k + 1, SLIP])
    high += widened
    low -= widened
    if high <= 0.0:
        low, high = -high, -low
    elif low < 0.0:
        high = high if high > -low else -low
        low = -high
    sine = 0.5 * high * chord
    blur = blur_of(k, ROUTE_TURN / chord * max(1.0, sine), before, after)
    return Stretch(chord, low, high, slope, widened, sine, blur)
