"""Routes: points on a table of pieces, and the chain of one instant. The table is described in constants.py."""

import cython
from cython.cimports.libc.math import asin, cos, fabs, sin, sqrt

if not cython.compiled:  # for the compiler the same stands in the .pxd
    from core.kernels.constants import *
    from core.kernels.spiral import next_arc, slipped, spiral_arc, spiral_curvature, spiral_theta, swayed


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
    """Arc length of every row's cubic from 0 to its end [m]. out: (rows,)"""
    for p in range(pieces.shape[0]):
        out[p] = cubic_arc(pieces, p, pieces[p, T_END])


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
        return (
            pieces[p, LINE_X] + u * pieces[p, LINE_DX],
            pieces[p, LINE_Y] + u * pieces[p, LINE_DY],
            pieces[p, LINE_DX],
            pieces[p, LINE_DY],
            0.0,
        )
    if kind == ARC:
        a = pieces[p, ARC_ANGLE] + pieces[p, SIGN] * u / pieces[p, ARC_RADIUS]
        c = cos(a)
        d = sin(a)
        return (
            pieces[p, CENTRE_X] + pieces[p, ARC_RADIUS] * c,
            pieces[p, CENTRE_Y] + pieces[p, ARC_RADIUS] * d,
            -pieces[p, SIGN] * d,
            pieces[p, SIGN] * c,
            pieces[p, SIGN] / pieces[p, ARC_RADIUS],
        )
    if kind == SPIRAL:
        return spiral_point(pieces, p, theta_at(pieces, p, s))
    a = u / (pieces[p, S_END] - pieces[p, S_START]) * pieces[p, T_END]
    for i in range(30):
        d = (cubic_arc(pieces, p, a) - u) / cubic_speed(pieces, p, a)
        a -= d
        if fabs(d) <= 1e-15 * pieces[p, T_END]:
            break
    return cubic_point(pieces, p, a)


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


def theta_at(pieces, p, s):
    """theta on a spiral piece at arc length s."""
    return spiral_theta((pieces[p, COIL_ARC] + pieces[p, SIGN] * (s - pieces[p, S_START])) / pieces[p, COIL_GROWTH])


def spiral_point(pieces, p, theta):
    """route_point() on a spiral piece at theta."""
    c = cos(theta + pieces[p, COIL_ROTATION])
    d = sin(theta + pieces[p, COIL_ROTATION])
    scale = pieces[p, SIGN] / sqrt(1.0 + theta * theta)
    return (
        pieces[p, CENTRE_X] + pieces[p, COIL_GROWTH] * theta * c,
        pieces[p, CENTRE_Y] + pieces[p, COIL_GROWTH] * theta * d,
        scale * (c - theta * d),
        scale * (d + theta * c),
        pieces[p, SIGN] * spiral_curvature(theta) / pieces[p, COIL_GROWTH],
    )


def route_points(pieces, s, out):
    """The point at every s. out: (S, POINT_COLUMNS) PX, PY, TX, TY, POINT_CURVATURE"""
    p = 0
    with cython.nogil:
        for i in range(s.shape[0]):
            p = piece_of(pieces, s[i], p)
            (out[i, PX], out[i, PY], out[i, TX], out[i, TY], out[i, POINT_CURVATURE]) = route_point(pieces, p, s[i])


def set_piece_theta(pieces, p, k, chain):
    """theta of handle k if it stands on a spiral."""
    if pieces[p, PIECE_KIND] == SPIRAL:
        chain[k, PIECE_THETA] = theta_at(pieces, p, -chain[k, PLACE])


def stands_first(pieces, k, chain):
    """Does handle k stand on the first piece, where that is not led together with the next one?"""
    return chain[k, PIECE] <= 0.0 and chain[k, PLACE] >= first_place(pieces)


def first_place(pieces):
    """The place from which backwards handles stand on the first piece, where that is not led together with the next."""
    return BLEND - pieces[0, S_END]


def start_route(pieces, s, chain):
    """Row 0 of a chain on a route: the head at s."""
    p = piece_of(pieces, s, 0)
    put_handle(0, route_point(pieces, p, s), chain)
    chain[0, PLACE] = -s
    chain[0, PIECE] = p
    chain[0, RATE] = 1.0
    chain[0, FILLED] = chain[0, SLIP] = 0.0
    set_piece_theta(pieces, p, 0, chain)


# Rounding, as in spiral.py, whose assumptions, SLIP, E and second order serve here too. The table is exact, and the
# path danced is the smooth one that its pieces nearly are: they may miss each other at a joint by up to 1e-9 m and
# rad, so it runs within LOOSE of them, and within BLEND of a joint only (see Route). Where a handle stands is
# said by the double of its piece, s - S_START on a line, the angle on an arc, theta on a spiral, t on a cubic: its s is
# only where the search for it began. E - SLIP is what the computed point lacks to the piece's there:
#   line     one product and the sum:                                             u (|x| + |y| + |s - S_START|)
#   arc      cos and sin 2 u each, a product, the sum:                            u (|x| + |y| + 5 radius)
#   spiral   the same, growth theta, and theta + rotation to u unless that is 0:  u (|x| + |y| + r (6 + |angle|))
#   cubic    the sum of |c_k| end^k, k >= 1, of both coordinates =: C:            u (|x| + |y| + 12 C)
# From link to link the distance of the computed points misses the chord by what is seen, however the search for it
# ended, and by the points' own errors:
#     local = (|distance - chord| + (E - SLIP)[a] + (E - SLIP)[b] + 8 u chord) / cos alpha_b.
# A place that is rounded beyond a joint stands on the piece before it, produced by as little: its point is off by the
# square of that.
# The head's double is not quite that of its s: slide_error() below, an error of the travel, not of the shape.
#   line     s - S_START:                                                         u |s - S_START|
#   arc      that, the division, the angle:                                       u (3 |s - S_START| + radius |angle|)
#   spiral   that, the division by growth, the inverse of the arc length A:       10 u A
#   cubic    |r'| end and the length are at most 3 C; the quadrature, a sum of 8, is good to 57 u C, and the Newton
#            steps that invert it end within 30 u C:                              100 u C
# What the quadrature lacks to the true arc length of a cubic, 1e-13 of it (core/paths/cubics.py), is left out: s on a
# cubic is what the quadrature says.


def cubic_size(pieces, p):
    """C: sum of |c_k| end^k of both coordinates, k >= 1 [m]."""
    t = pieces[p, T_END]
    return t * (
        fabs(pieces[p, X1])
        + fabs(pieces[p, Y1])
        + t * (fabs(pieces[p, X2]) + fabs(pieces[p, Y2]) + t * (fabs(pieces[p, X3]) + fabs(pieces[p, Y3])))
    )


def spot_error(pieces, p, s, theta, x, y):
    """No more than this lies between a computed point of piece p and the path's [m]; theta: on a spiral."""
    kind = cython.cast(cython.int, pieces[p, PIECE_KIND])
    error = fabs(x) + fabs(y)
    if kind == LINE:
        error += fabs(s - pieces[p, S_START])
    elif kind == ARC:
        error += 5.0 * pieces[p, ARC_RADIUS]
    elif kind == SPIRAL:
        error += (
            pieces[p, COIL_GROWTH]
            * theta
            * (6.0 if pieces[p, COIL_ROTATION] == 0.0 else 6.0 + fabs(theta + pieces[p, COIL_ROTATION]))
        )
    else:
        error += 12.0 * cubic_size(pieces, p)
    if s < pieces[p, S_START] + BLEND or s > pieces[p, S_END] - BLEND:
        return ULP * error + pieces[p, LOOSE]
    return ULP * error


def slide_error(pieces, p, s):
    """No more than this lies between a computed point of piece p and that of s along the path [m]."""
    kind = cython.cast(cython.int, pieces[p, PIECE_KIND])
    away = fabs(s - pieces[p, S_START])
    if kind == LINE:
        return ULP * away
    if kind == ARC:
        return ULP * (4.0 * away + pieces[p, ARC_RADIUS] * fabs(pieces[p, ARC_ANGLE]))
    if kind == SPIRAL:
        return 10.0 * ULP * (fabs(pieces[p, COIL_ARC]) + away)
    return 100.0 * ULP * cubic_size(pieces, p)


def piece_end(pieces, p, s):
    """route_point() at either end of a piece, on a cubic without a search for t."""
    if pieces[p, PIECE_KIND] <= SPIRAL:
        return route_point(pieces, p, s)
    return cubic_point(pieces, p, 0.0 if s == pieces[p, S_START] else pieces[p, T_END])


def joint_misses(pieces, out):
    """By how much every piece misses the one before it at most: across and along the path [m], direction [rad],
    curvature [1/m]. out: (rows, MISS_COLUMNS), of which the first row is left alone

    A tangent is good to 10 u, and to u |angle| more on a turned spiral; on a cubic to 15 u C / (|r'| end), where
    curvature is good to 72 u (C / (|r'| end))^2 / C.
    """
    for p in range(1, pieces.shape[0]):
        s = pieces[p, S_START]
        x, y, tx, ty, bend = piece_end(pieces, p - 1, s)
        x_on, y_on, tx_on, ty_on, bend_on = piece_end(pieces, p, s)
        across = fabs(tx * (y_on - y) - ty * (x_on - x))
        along = fabs(tx * (x_on - x) + ty * (y_on - y))
        kink = sqrt((tx_on - tx) * (tx_on - tx) + (ty_on - ty) * (ty_on - ty)) + 20.0 * ULP
        step = fabs(bend_on - bend) + 10.0 * ULP * (fabs(bend_on) + fabs(bend))
        for q in range(p - 1, p + 1):
            theta = theta_at(pieces, q, s) if pieces[q, PIECE_KIND] == SPIRAL else 0.0
            across += spot_error(pieces, q, s, theta, x, y)
            along += slide_error(pieces, q, s)
            if pieces[q, PIECE_KIND] == SPIRAL and pieces[q, COIL_ROTATION] != 0.0:
                kink += ULP * fabs(theta + pieces[q, COIL_ROTATION])
            if pieces[q, PIECE_KIND] > SPIRAL:
                theta = cubic_size(pieces, q)
                bend = theta / (pieces[q, T_END] * cubic_speed(pieces, q, 0.0 if q == p else pieces[q, T_END]))
                kink += 15.0 * ULP * bend
                step += 72.0 * ULP * bend * bend / theta
        out[p, MISS_ACROSS] = across
        out[p, MISS_ALONG] = along
        out[p, MISS_KINK] = kink
        out[p, MISS_STEP] = step


def piece_slides(pieces, out):
    """The largest slide_error() on every piece [m]. out: (rows,)"""
    for p in range(pieces.shape[0]):
        out[p] = slide_error(pieces, p, pieces[p, S_END])


# Next handle. Let |curvature| <= k with k chord < 2 (routes are refused otherwise). As long as k l <= pi the distance
# to the point l behind grows with l: its rate is the cosine of an angle <= k l / 2 (chord lemma, bounds.py). It reaches
# the chord before l = pi chord / 2 <= pi / k, so in [chord, pi chord / 2] there is one root, it is the first along the
# path, and whatever comes near further back along the path is never taken for it.


def extend_route(pieces, first, last, until, sizes, chain):
    """Handles after `first` to the `last`, each the first point behind its leader at the bench's chord.

    returns: last, or a handle before it that stands at the place `until` or further back
    """
    # the links before this one on its spiral: how many (since its chord came up, that and one more), what they turned
    # by, the last one first, and the arc where they end
    alike = 0
    d1 = d2 = d3 = d4 = d5 = begin = 0.0
    for k in range(first, last):
        if chain[k, PLACE] >= until:
            return k
        s = -chain[k, PLACE]
        p = cython.cast(cython.Py_ssize_t, chain[k, PIECE])
        chord = sizes[k, CHORD]
        same = k > 0 and sizes[k - 1, CHORD] == chord
        step = chain[k, PLACE] - chain[k - 1, PLACE] if same else chord
        if pieces[p, PIECE_KIND] == LINE:
            step = chord
        elif pieces[p, PIECE_KIND] == ARC:
            step = 2.0 * pieces[p, ARC_RADIUS] * asin(0.5 * chord / pieces[p, ARC_RADIUS])
        elif pieces[p, PIECE_KIND] == SPIRAL:
            # on an outward spiral the follower is further in: the same equation with theta negative
            theta = -pieces[p, SIGN] * chain[k, PIECE_THETA]
            distance = chord / pieces[p, COIL_GROWTH]
            if alike == 0:
                begin = spiral_arc(theta)
            elif not same:
                alike = 1
            if alike > 5:
                delta = 5.0 * (d1 - d4) + 10.0 * (d3 - d2) + d5
            elif alike > 3:
                delta = 3.0 * (d1 - d2) + d3
            else:
                delta = step / (pieces[p, COIL_GROWTH] * sqrt(1.0 + theta * theta))
            delta, rear = next_arc(theta, distance * distance, delta)
            arc = (rear - begin) * pieces[p, COIL_GROWTH] if delta > 0.0 else -1.0
            if chord <= arc <= 0.5 * PI * chord:
                step = arc
                if p == 0 or s - arc >= pieces[p, S_START]:
                    chain[k + 1, PIECE_THETA] = fabs(theta + delta)
                    put_handle(k + 1, spiral_point(pieces, p, fabs(theta + delta)), chain)
                    chain[k + 1, PLACE] = step - s
                    chain[k + 1, PIECE] = p
                    finish_link(k, chord, chain)
                    alike += 1
                    d5 = d4
                    d4 = d3
                    d3 = d2
                    d2 = d1
                    d1 = delta
                    begin = rear
                    continue
        alike = 0
        seek_rear(pieces, k, p, step, chord, chain)
        finish_link(k, chord, chain)
    return last


def put_handle(k, point, chain):
    """Handle k at a point of the path, as route_point() returns it."""
    chain[k, PX], chain[k, PY], chain[k, TX], chain[k, TY], chain[k, CURVATURE] = point


def seek_rear(pieces, k, p, step, chord, chain):
    """Place handle k + 1 by Newton's method with bisections, from a step along the path behind handle k [m].

    p: the piece of handle k, from which the search for that of handle k + 1 sets out
    """
    low = chord
    high = 0.5 * PI * chord
    s = -chain[k, PLACE]
    for i in range(80):
        if not (low <= step <= high):
            step = 0.5 * (low + high)
        p = piece_of(pieces, s - step, p)
        put_handle(k + 1, route_point(pieces, p, s - step), chain)
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


def route_rounding(pieces, last, sizes, chain):
    """Fills in SLIP, ERROR and SWAY of a chain up to handle `last`."""
    first = cython.cast(cython.Py_ssize_t, chain[0, FILLED])
    spot = chain_spot(pieces, first, chain)
    for k in range(first, last):
        chord = sizes[k, CHORD]
        inverse = 1.0 / chord
        spots = spot
        spot = chain_spot(pieces, k + 1, chain)
        spots += spot
        slope = 1.0 / (chain[k + 1, TX] * chain[k, UX] + chain[k + 1, TY] * chain[k, UY])
        ratio = (chain[k, TX] * chain[k, UX] + chain[k, TY] * chain[k, UY]) * slope
        # u is the difference of the points over the chord; | |u| - 1 | <= 0.6 | |u|^2 - 1 | unless all is lost anyway
        local = chain[k, UX] * chain[k, UX] + chain[k, UY] * chain[k, UY]
        local = (chord * (0.6 * fabs(local - 1.0) + 8.0 * ULP) + spots) * slope
        chain[k + 1, SLIP] = slipped(chain[k, SLIP], ratio, slope, local, spots, inverse)
        chain[k, ERROR] = chain[k + 1, SLIP] + spots
        if k > 0:
            chain[k, ERROR] = max(chain[k, ERROR], chain[k - 1, ERROR])
        chain[k, SWAY] = swayed(k, chain, ratio, local, spots, inverse)
    chain[0, FILLED] = max(first, last)


def chain_spot(pieces, k, chain):
    """spot_error() of handle k."""
    p = cython.cast(cython.Py_ssize_t, chain[k, PIECE])
    return spot_error(pieces, p, -chain[k, PLACE], chain[k, PIECE_THETA], chain[k, PX], chain[k, PY])
