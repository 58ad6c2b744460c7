"""Routes: points on a table of pieces, and the chain of one instant. The table is described in constants.py."""

import cython
from cython.cimports.libc.math import asin, cos, fabs, sin, sqrt

if not cython.compiled:  # for the compiler the same stands in the .pxd
    from core.kernels.constants import *
    from core.kernels.spiral import next_arc, spiral_curvature, spiral_theta


def cubic_speed(pieces, p, t):
    """|r'(t)| of a cubic."""
    x = pieces[p, 6] + t * (2.0 * pieces[p, 7] + 3.0 * t * pieces[p, 8])
    y = pieces[p, 10] + t * (2.0 * pieces[p, 11] + 3.0 * t * pieces[p, 12])
    return sqrt(x * x + y * y)


def cubic_arc(pieces, p, t):
    """Arc length of a cubic from 0 to t, by Gauss-Legendre quadrature with eight points [m]."""
    return t * (
        0.1813418916891810
        * (cubic_speed(pieces, p, 0.4082826787521751 * t) + cubic_speed(pieces, p, 0.5917173212478249 * t))
        + 0.1568533229389436
        * (cubic_speed(pieces, p, 0.2372337950418355 * t) + cubic_speed(pieces, p, 0.7627662049581645 * t))
        + 0.1111905172266872
        * (cubic_speed(pieces, p, 0.1016667612931866 * t) + cubic_speed(pieces, p, 0.8983332387068134 * t))
        + 0.0506142681451881
        * (cubic_speed(pieces, p, 0.0198550717512319 * t) + cubic_speed(pieces, p, 0.9801449282487681 * t))
    )


def cubic_arcs(pieces, out):
    """Arc length of every row's cubic from 0 to its end [m]. out: (rows,)"""
    for p in range(pieces.shape[0]):
        out[p] = cubic_arc(pieces, p, pieces[p, 13])


def piece_of(pieces, s, near):
    """The piece that holds s, a joint the piece behind it: by steps that double from a near one, then halve."""
    low = near
    high = near
    step = 1
    while low > 0 and s <= pieces[low, S_START]:
        high = low - 1
        low = low - step if low > step else 0
        step *= 2
    while high < pieces.shape[0] - 1 and s > pieces[high, S_END]:
        low = high + 1
        high = high + step if high + step < pieces.shape[0] else pieces.shape[0] - 1
        step *= 2
    while low < high:
        middle = (low + high) // 2
        if s > pieces[middle, S_END]:
            low = middle + 1
        else:
            high = middle
    return low


def route_point(pieces, p, s):
    """x, y [m], unit tangent, curvature [1/m] at arc length s on piece p."""
    kind = cython.cast(cython.int, pieces[p, PIECE_KIND])
    u = s - pieces[p, S_START]
    if kind == LINE:
        return (pieces[p, 5] + u * pieces[p, 7], pieces[p, 6] + u * pieces[p, 8], pieces[p, 7], pieces[p, 8], 0.0)
    if kind == ARC:
        a = pieces[p, 8] + pieces[p, 9] * u / pieces[p, 7]
        c = cos(a)
        d = sin(a)
        return (
            pieces[p, 5] + pieces[p, 7] * c,
            pieces[p, 6] + pieces[p, 7] * d,
            -pieces[p, 9] * d,
            pieces[p, 9] * c,
            pieces[p, 9] / pieces[p, 7],
        )
    if kind == SPIRAL:
        return spiral_point(pieces, p, spiral_theta((pieces[p, 10] + pieces[p, 9] * u) / pieces[p, 7]))
    a = u / (pieces[p, S_END] - pieces[p, S_START]) * pieces[p, 13]
    for i in range(30):
        d = (cubic_arc(pieces, p, a) - u) / cubic_speed(pieces, p, a)
        a -= d
        if fabs(d) <= 1e-15 * pieces[p, 13]:
            break
    c = pieces[p, 6] + a * (2.0 * pieces[p, 7] + 3.0 * a * pieces[p, 8])
    d = pieces[p, 10] + a * (2.0 * pieces[p, 11] + 3.0 * a * pieces[p, 12])
    length = sqrt(c * c + d * d)
    return (
        pieces[p, 5] + a * (pieces[p, 6] + a * (pieces[p, 7] + a * pieces[p, 8])),
        pieces[p, 9] + a * (pieces[p, 10] + a * (pieces[p, 11] + a * pieces[p, 12])),
        c / length,
        d / length,
        (c * (2.0 * pieces[p, 11] + 6.0 * a * pieces[p, 12]) - d * (2.0 * pieces[p, 7] + 6.0 * a * pieces[p, 8]))
        / (length * length * length),
    )


def spiral_point(pieces, p, theta):
    """route_point() on a spiral piece at theta."""
    c = cos(theta + pieces[p, 8])
    d = sin(theta + pieces[p, 8])
    scale = pieces[p, 9] / sqrt(1.0 + theta * theta)
    return (
        pieces[p, 5] + pieces[p, 7] * theta * c,
        pieces[p, 6] + pieces[p, 7] * theta * d,
        scale * (c - theta * d),
        scale * (d + theta * c),
        pieces[p, 9] * spiral_curvature(theta) / pieces[p, 7],
    )


def route_points(pieces, s, out):
    """x, y, tangent x, y, curvature at every s. out: (S, 5)"""
    p = 0
    with cython.nogil:
        for i in range(s.shape[0]):
            p = piece_of(pieces, s[i], p)
            out[i, 0], out[i, 1], out[i, 2], out[i, 3], out[i, 4] = route_point(pieces, p, s[i])


def set_piece_theta(pieces, p, k, chain):
    """theta of handle k if it stands on a spiral."""
    if pieces[p, PIECE_KIND] == SPIRAL:
        chain[k, PIECE_THETA] = spiral_theta(
            (pieces[p, 10] + pieces[p, 9] * (-chain[k, PLACE] - pieces[p, S_START])) / pieces[p, 7]
        )


def start_route(pieces, s, chain):
    """Row 0 of a chain on a route: the head at s."""
    p = piece_of(pieces, s, 0)
    chain[0, PX], chain[0, PY], chain[0, TX], chain[0, TY], chain[0, CURVATURE] = route_point(pieces, p, s)
    chain[0, PLACE] = -s
    chain[0, PIECE] = p
    chain[0, RATE] = 1.0
    set_piece_theta(pieces, p, 0, chain)


# Next handle. Let |curvature| <= k with k chord < 2 (routes are refused otherwise). As long as k l <= pi the distance
# to the point l behind grows with l: its rate is the cosine of an angle <= k l / 2 (chord lemma, bounds.py). It reaches
# the chord before l = pi chord / 2 <= pi / k, so in [chord, pi chord / 2] there is one root, it is the first along the
# path, and whatever comes near further back along the path is never taken for it.


def extend_route(pieces, first, last, calm, sizes, chain):
    """Handles after `first` to the `last`, each the first point behind its leader at the bench's chord.

    returns: last, or where calm > 0 a handle before it that stands on the first piece
    """
    for k in range(first, last):
        if calm > 0.0 and chain[k, PIECE] <= 0.0:
            return k
        s = -chain[k, PLACE]
        p = cython.cast(cython.Py_ssize_t, chain[k, PIECE])
        chord = sizes[k, CHORD]
        low = chord
        high = 0.5 * PI * chord
        step = chord
        if k > 0 and sizes[k - 1, CHORD] == chord:
            step = chain[k, PLACE] - chain[k - 1, PLACE]
        if pieces[p, PIECE_KIND] == LINE:
            step = chord
        elif pieces[p, PIECE_KIND] == ARC:
            step = 2.0 * pieces[p, 7] * asin(0.5 * chord / pieces[p, 7])
        elif pieces[p, PIECE_KIND] == SPIRAL:
            # on an outward spiral the follower is further in: the same equation with theta negative
            theta = -pieces[p, 9] * chain[k, PIECE_THETA]
            distance = chord / pieces[p, 7]
            delta, arc = next_arc(theta, distance * distance, step / (pieces[p, 7] * sqrt(1.0 + theta * theta)))
            arc *= pieces[p, 7]
            if low <= arc <= high:
                step = arc
                if p == 0 or s - arc >= pieces[p, S_START]:
                    chain[k + 1, PIECE_THETA] = fabs(theta + delta)
                    (
                        chain[k + 1, PX],
                        chain[k + 1, PY],
                        chain[k + 1, TX],
                        chain[k + 1, TY],
                        chain[k + 1, CURVATURE],
                    ) = spiral_point(pieces, p, fabs(theta + delta))
                    chain[k + 1, PLACE] = step - s
                    chain[k + 1, PIECE] = p
                    finish_link(k, chord, chain)
                    continue
        for i in range(80):
            if not (low <= step <= high):
                step = 0.5 * (low + high)
            p = piece_of(pieces, s - step, p)
            (chain[k + 1, PX], chain[k + 1, PY], chain[k + 1, TX], chain[k + 1, TY], chain[k + 1, CURVATURE]) = (
                route_point(pieces, p, s - step)
            )
            dx = chain[k, PX] - chain[k + 1, PX]
            dy = chain[k, PY] - chain[k + 1, PY]
            distance = sqrt(dx * dx + dy * dy)
            slope = (dx * chain[k + 1, TX] + dy * chain[k + 1, TY]) / distance
            if distance < chord:
                low = step
            else:
                high = step
            if (
                fabs(distance - chord) <= 4e-16 * (chord + fabs(chain[k, PX]) + fabs(chain[k, PY]))
                or high - low <= 1e-15 * chord
            ):
                break
            step += (chord - distance) / slope if slope > 0.1 else 2.0 * high
        chain[k + 1, PLACE] = step - s
        chain[k + 1, PIECE] = p
        set_piece_theta(pieces, p, k + 1, chain)
        finish_link(k, chord, chain)
    return last


def finish_link(k, chord, chain):
    """Bench k between its placed handles, and the rate of the rear one by the rigid link."""
    ux = (chain[k, PX] - chain[k + 1, PX]) / chord
    uy = (chain[k, PY] - chain[k + 1, PY]) / chord
    chain[k, MX] = 0.5 * (chain[k, PX] + chain[k + 1, PX])
    chain[k, MY] = 0.5 * (chain[k, PY] + chain[k + 1, PY])
    chain[k, UX] = ux
    chain[k, UY] = uy
    chain[k + 1, RATE] = (
        chain[k, RATE] * (chain[k, TX] * ux + chain[k, TY] * uy) / (chain[k + 1, TX] * ux + chain[k + 1, TY] * uy)
    )
