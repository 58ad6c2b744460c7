"""Routes: points on a table of pieces, whose columns constants.py describes, and the chain of one instant."""

import cython
from cython.cimports.libc.math import asin, cos, fabs, sin, sqrt

if not cython.compiled:  # the .pxd imports the same names for the compiler
    from core.kernels.clothoid import clothoid_point
    from core.kernels.constants import *
    from core.kernels.double_double import coil_theta, quotient
    from core.kernels.spiral import next_arc


def two_sum(a, b):
    """two_sum() of double_double.py: the compiler inlines it only here, and a chain on a coil takes 5 % less time."""
    total = a + b
    added = total - a
    return total, (a - (total - added)) + (b - added)


def cubic_speed(pieces, p, t):
    """|r'(t)| of a cubic."""
    x = pieces[p, X1] + t * (2.0 * pieces[p, X2] + 3.0 * t * pieces[p, X3])
    y = pieces[p, Y1] + t * (2.0 * pieces[p, Y2] + 3.0 * t * pieces[p, Y3])
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
    """Fill in the arc length of every row's cubic from 0 to its end [m]. out: (rows,)"""
    for p in range(pieces.shape[0]):
        out[p] = cubic_arc(pieces, p, pieces[p, T_END])


def piece_of(pieces, s, near):
    """Number of the piece that holds s, at a joint the one behind it: by steps that double from `near`, then halve."""
    low = high = near
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


def route_point(pieces, p, s, low):
    """x, y [m], unit tangent, curvature [1/m] at arc length s + low on piece p."""
    kind = cython.cast(cython.int, pieces[p, PIECE_KIND])
    if kind == SPIRAL:
        theta, rest = theta_at(pieces, p, s, low)
        return spiral_point(pieces, p, theta, rest)
    u, rest = two_sum(s, -pieces[p, S_START])
    rest += low - pieces[p, S_START_LOW]
    if kind == ARC:
        return arc_point(pieces, p, u, rest)
    u += rest
    if kind == LINE:
        dx = pieces[p, LINE_DX]
        dy = pieces[p, LINE_DY]
        return pieces[p, LINE_X] + u * dx, pieces[p, LINE_Y] + u * dy, dx, dy, 0.0
    if kind == CLOTHOID:
        return clothoid_point(pieces, p, u)
    a = u / (pieces[p, S_END] - pieces[p, S_START]) * pieces[p, T_END]
    for i in range(30):
        d = (cubic_arc(pieces, p, a) - u) / cubic_speed(pieces, p, a)
        a -= d
        if fabs(d) <= 1e-15 * pieces[p, T_END]:
            break
    return cubic_point(pieces, p, a)


def cos_sin(angle, low):
    """cos and sin of angle + low, which rounding would take from a large angle [rad]."""
    c = cos(angle)
    d = sin(angle)
    return c - low * d, d + low * c


def arc_point(pieces, p, u, low):
    """route_point() on an arc, u + low from its beginning."""
    sign = pieces[p, SIGN]
    a, rest = quotient(sign * u, sign * low, pieces[p, ARC_RADIUS], 0.0)
    a, lost = two_sum(pieces[p, ARC_ANGLE], a)
    c, d = cos_sin(a, lost + rest)
    return (
        pieces[p, CENTRE_X] + pieces[p, ARC_RADIUS] * c,
        pieces[p, CENTRE_Y] + pieces[p, ARC_RADIUS] * d,
        -sign * d,
        sign * c,
        sign / pieces[p, ARC_RADIUS],
    )


def cubic_point(pieces, p, a):
    """route_point() on a cubic at a."""
    c = pieces[p, X1] + a * (2.0 * pieces[p, X2] + 3.0 * a * pieces[p, X3])
    d = pieces[p, Y1] + a * (2.0 * pieces[p, Y2] + 3.0 * a * pieces[p, Y3])
    length = sqrt(c * c + d * d)
    return (
        pieces[p, X0] + a * (pieces[p, X1] + a * (pieces[p, X2] + a * pieces[p, X3])),
        pieces[p, Y0] + a * (pieces[p, Y1] + a * (pieces[p, Y2] + a * pieces[p, Y3])),
        c / length,
        d / length,
        (c * (2.0 * pieces[p, Y2] + 6.0 * a * pieces[p, Y3]) - d * (2.0 * pieces[p, X2] + 6.0 * a * pieces[p, X3]))
        / (length * length * length),
    )


def theta_at(pieces, p, s, low):
    """theta on a spiral piece at arc length s + low, as a pair."""
    way, rest = two_sum(s, -pieces[p, S_START])
    rest += low - pieces[p, S_START_LOW]
    sign = pieces[p, SIGN]
    return coil_theta(
        pieces[p, COIL_GROWTH],
        pieces[p, COIL_GROWTH_LOW],
        pieces[p, COIL_ARC],
        pieces[p, COIL_ARC_LOW],
        sign * way,
        sign * rest,
    )


def spiral_point(pieces, p, theta, low):
    """route_point() on a spiral piece at theta + low."""
    a, rest = two_sum(theta, pieces[p, COIL_ROTATION])
    c, d = cos_sin(a, rest + low)
    square = 1.0 + theta * theta
    length = sqrt(square)
    scale = pieces[p, SIGN] / length
    return (
        pieces[p, CENTRE_X] + pieces[p, COIL_GROWTH] * theta * c,
        pieces[p, CENTRE_Y] + pieces[p, COIL_GROWTH] * theta * d,
        scale * (c - theta * d),
        scale * (d + theta * c),
        pieces[p, SIGN] * ((1.0 + square) / (square * length)) / pieces[p, COIL_GROWTH],  # spiral_curvature()
    )


def route_points(pieces, s, out):
    """Fill in the point at every s. s: (S, 2) pairs; out: (S, POINT_COLUMNS) PX, PY, TX, TY, POINT_CURVATURE"""
    p = 0
    with cython.nogil:
        for i in range(s.shape[0]):
            p = piece_of(pieces, s[i, HIGH], p)
            (out[i, PX], out[i, PY], out[i, TX], out[i, TY], out[i, POINT_CURVATURE]) = route_point(
                pieces, p, s[i, HIGH], s[i, LOW]
            )


def set_piece_theta(pieces, p, k, chain):
    """Fill in theta of handle k if it stands on a spiral."""
    if pieces[p, PIECE_KIND] == SPIRAL:
        chain[k, PIECE_THETA], chain[k, REST] = theta_at(pieces, p, -chain[k, PLACE], -chain[k, PLACE_REST])


def stands_first(pieces, k, chain):
    """Whether handle k stands on the first piece itself, not where the path leaves it to meet the next piece."""
    return chain[k, PIECE] <= 0.0 and chain[k, PLACE] >= first_place(pieces)


def first_place(pieces):
    """Place from which backwards handles stand on the first piece itself, as stands_first() says."""
    return BLEND - pieces[0, S_END]


def start_route(pieces, s, low, chain):
    """Fill in row 0 of a chain on a route: the head at s + low."""
    p = piece_of(pieces, s, 0)
    put_handle(0, route_point(pieces, p, s, low), chain)
    chain[0, PLACE] = -s
    chain[0, PLACE_REST] = -low
    chain[0, PIECE] = p
    chain[0, RATE] = 1.0
    chain[0, FILLED] = chain[0, SLIP] = 0.0
    set_piece_theta(pieces, p, 0, chain)


# Next handle. Let |curvature| <= k with k chord < 2. As long as k l <= pi the distance to the point l behind grows with
# l: its rate is the cosine of an angle <= k l / 2 (chord lemma, bounds.py). It reaches the chord before
# l = pi chord / 2 <= pi / k. So there is one root in [chord, pi chord / 2], and it is the first along the path, so a
# point further back that comes near is never taken for it. On sharper routes first_behind() seeks it from the front.
#
# Input:  a chain on a route up to handle `first` (start_route() lays out the head), the pieces, and the chords.
# State:  the links before this one on the same spiral: `alike`, their number (those of the same chord, plus one); d1 to
#         d5, the angles that they span, the last one first.
# Output: the rows of the handles up to the last one or the place `until`, and of the benches between them.
def extend_route(pieces, first, last, until, sizes, chain):
    """Place handles after `first` up to the `last`, each at the first point behind its leader at the bench's chord.

    returns: last, or a handle before it that stands at the place `until` or further back
    """
    alike = 0
    d1 = d2 = d3 = d4 = d5 = 0.0
    sharpest = 0.5 * pieces[0, SHARPEST] if pieces[0, CORNERED] == 0.0 else FREE
    for k in range(first, last):
        if chain[k, PLACE] >= until:
            return k
        s = -chain[k, PLACE]
        p = cython.cast(cython.Py_ssize_t, chain[k, PIECE])
        chord = sizes[k, CHORD]
        same = k > 0 and sizes[k - 1, CHORD] == chord
        tight = sharpest * chord > ROUTE_SINE_LIMIT
        step = chain[k, PLACE] - chain[k - 1, PLACE] if same else chord
        if pieces[p, PIECE_KIND] == LINE:
            step = chord
        elif pieces[p, PIECE_KIND] == ARC and not tight:
            step = 2.0 * pieces[p, ARC_RADIUS] * asin(0.5 * chord / pieces[p, ARC_RADIUS])
        elif pieces[p, PIECE_KIND] == SPIRAL:
            # on an outward spiral the follower is further in: the same equation with theta negative
            theta = -pieces[p, SIGN] * chain[k, PIECE_THETA]
            distance = chord / pieces[p, COIL_GROWTH]
            if alike > 0 and not same:
                alike = 1
            if alike > 5:
                delta = 5.0 * (d1 - d4) + 10.0 * (d3 - d2) + d5
            elif alike > 3:
                delta = 3.0 * (d1 - d2) + d3
            else:
                delta = step / (pieces[p, COIL_GROWTH] * sqrt(1.0 + theta * theta))
            delta, arc = next_arc(theta, distance * distance, delta)
            arc = arc * pieces[p, COIL_GROWTH] if delta > 0.0 else NO_ROOT
            if chord <= arc <= 0.5 * PI * chord:
                step = arc
                if p == 0 or s - arc >= pieces[p, S_START]:
                    rear, lost = two_sum(theta, delta - pieces[p, SIGN] * chain[k, REST])
                    chain[k + 1, PIECE_THETA] = fabs(rear)
                    chain[k + 1, REST] = lost if rear > 0.0 else -lost
                    put_handle(k + 1, spiral_point(pieces, p, fabs(rear), chain[k + 1, REST]), chain)
                    put_place(k, step, chain)
                    chain[k + 1, PIECE] = p
                    finish_link(k, chord, chain)
                    alike += 1
                    d5 = d4
                    d4 = d3
                    d3 = d2
                    d2 = d1
                    d1 = delta
                    continue
        alike = 0
        if tight:
            seek_first(pieces, k, p, chord, chain)
        else:
            seek_rear(pieces, k, p, step, chord, chain)
        finish_link(k, chord, chain)
    return last


def put_handle(k, point, chain):
    """Handle k at a point of the path, as route_point() returns it."""
    chain[k, PX], chain[k, PY], chain[k, TX], chain[k, TY], chain[k, CURVATURE] = point


def put_place(k, step, chain):
    """Place of handle k + 1, a step along the path behind handle k [m]."""
    chain[k + 1, PLACE], chain[k + 1, PLACE_REST] = two_sum(chain[k, PLACE], step + chain[k, PLACE_REST])


# Input:  a chain up to handle k, and a first guess of the step along the path to the next one.
# State:  `step`, and the bracket [low, high] of it.
# Output: where handle k + 1 stands, in its row.
def seek_rear(pieces, k, p, step, chord, chain):
    """Place handle k + 1 by Newton's method with bisections, starting a step along the path behind handle k [m].

    p: the piece of handle k, from which the search for the piece of handle k + 1 starts
    """
    low = chord
    high = 0.5 * PI * chord
    s = -chain[k, PLACE]
    for i in range(80):
        if not (low <= step <= high):
            step = 0.5 * (low + high)
        p = piece_of(pieces, s - step, p)
        put_handle(k + 1, route_point(pieces, p, s, -chain[k, PLACE_REST] - step), chain)
        dx = chain[k, PX] - chain[k + 1, PX]
        dy = chain[k, PY] - chain[k + 1, PY]
        distance = sqrt(dx * dx + dy * dy)
        slope = (dx * chain[k + 1, TX] + dy * chain[k + 1, TY]) / distance
        if distance < chord:
            low = step
        else:
            high = step
        close = 4e-16 * (chord + fabs(chain[k, PX]) + fabs(chain[k, PY]))
        if fabs(distance - chord) <= close or high - low <= 1e-15 * chord:
            break
        step += (chord - distance) / slope if slope > 0.1 else 2.0 * high
    put_place(k, step, chain)
    chain[k + 1, PIECE] = p
    set_piece_theta(pieces, p, k + 1, chain)


# The first place behind, for any curvature. With D the distance of the place x further back than one where it is
# D_0 < chord, D' = cos alpha <= 1 and |D''| <= |sin alpha| (k + |sin alpha| / D) <= k + 2 / D_0 while x <= D_0 / 2. So
# D < chord for all x below both chord - D_0 and the root of D_0 + D'_0 x + (k + 2 / D_0) x^2 / 2 = chord, as long as
# |curvature| <= k, which is known to the end of the piece. Such steps pass no root, and come to the first one as
# quickly as Newton's method.
FIRST_STEPS = 2000
# Part of the chord by which a step may pass the end of a piece [1]: the next curvature moves D by its square. No step
# passes a corner by more than its gap, which no curvature enters.
PASSED_END = 1e-9


# Input:  a point x, y of a route at s + low, and the piece p of some place behind it.
# State:  `step`, up to which no place is a chord away.
# Output: the step to the first place that is, NO_ROOT if none was found, and its piece.
def first_behind(pieces, p, s, low, x, y, chord):
    """Way back to the first place at the chord's distance from a point of a route [m], and the piece of that place."""
    step = chord
    for i in range(FIRST_STEPS):
        p = piece_of(pieces, s - step, p)
        bx, by, tx, ty, _ = route_point(pieces, p, s, low - step)
        dx = x - bx
        dy = y - by
        distance = sqrt(dx * dx + dy * dy)
        gap = chord - distance
        if gap <= 4e-16 * (chord + fabs(x) + fabs(y)):
            return step, p
        further = gap
        if distance > 0.0:
            slope = (dx * tx + dy * ty) / distance
            most = max(fabs(pieces[p, K_START]), fabs(pieces[p, K_END])) + pieces[p, CURVATURE_SLACK] + 2.0 / distance
            quick = min(2.0 * gap / (slope + sqrt(slope * slope + 2.0 * most * gap)), 0.5 * distance)
            if p > 0:
                passed = PASSED_END * chord if pieces[p, CORNER] == 0.0 else 0.0
                quick = min(quick, s - step - pieces[p, S_START] + passed)
            further = max(further, quick)
        if step + further == step:
            return step, p
        step += further
    return NO_ROOT, p


def seek_first(pieces, k, p, chord, chain):
    """Place handle k + 1 at the first place behind handle k; where there is none, somewhere behind it."""
    step, p = first_behind(pieces, p, -chain[k, PLACE], -chain[k, PLACE_REST], chain[k, PX], chain[k, PY], chord)
    if step == NO_ROOT:
        step = 0.5 * PI * chord
        p = piece_of(pieces, -chain[k, PLACE] - step, p)
    put_handle(k + 1, route_point(pieces, p, -chain[k, PLACE], -chain[k, PLACE_REST] - step), chain)
    put_place(k, step, chain)
    chain[k + 1, PIECE] = p
    set_piece_theta(pieces, p, k + 1, chain)


def finish_link(k, chord, chain):
    """Fill in bench k between its placed handles, and the rate of the rear one by the rigid link."""
    ux = (chain[k, PX] - chain[k + 1, PX]) / chord
    uy = (chain[k, PY] - chain[k + 1, PY]) / chord
    chain[k, MX] = 0.5 * (chain[k, PX] + chain[k + 1, PX])
    chain[k, MY] = 0.5 * (chain[k, PY] + chain[k + 1, PY])
    chain[k, UX] = ux
    chain[k, UY] = uy
    chain[k + 1, RATE] = (
        chain[k, RATE] * (chain[k, TX] * ux + chain[k, TY] * uy) / (chain[k + 1, TX] * ux + chain[k + 1, TY] * uy)
    )
