"""Rounding: largest distances of computed handles and benches from the true ones."""

import cython
from cython.cimports.libc.math import fabs, sqrt

if not cython.compiled:  # the .pxd imports the same names for the compiler
    from core.kernels.constants import *
    from core.kernels.corners import CORNER_NEAR, sided_cosines
    from core.kernels.route import cubic_point, cubic_speed, route_point, theta_at

# On a spiral. u = ULP is the unit of rounding: each operation and square root errs by a factor within 1 +- u, each sin
# and cos of the C library by 2 u of itself (one unit in the last place, as glibc and its peers promise). The doubles
# growth, chords and the head's theta are exact. The frame turns with the head, so the true handle k stands at theta[k],
# at the angle theta[k] - theta[0]. Computed are Theta[k] = THETA + REST and a vector e[k] = (COS, SIN).
#
# 1. Displacement. Let the computed handle, put on the spiral at Theta[k], be at most SLIP[k] along the path away from
# the true one. f is computed to 9 u f (its first term to 2 u; the second has theta + delta, two products, s twice with
# s to 2 u, a sum), chord^2 to 3 u, and f leaves out REST (at most u theta): f_theta u theta <= 2 u chord^2, as
# theta f_theta <= 2 f. In all f misses chord^2 by 14 u chord^2, and delta by 14 u chord^2 / f_delta. As the chord grows
# by T_b . u = cos alpha_b for each metre that b falls back, f_delta = 2 (chord / growth) length cos alpha_b with length
# = sqrt(1 + theta_b^2): b is displaced by growth length 14 u chord^2 / (growth^2 f_delta) = 7 u chord / cos alpha_b.
# Halley: with w = f f_delta_delta / f_delta^2 the residual after a step is f_delta step w^2 / 4 (1 +- w) and
# f_delta_delta_delta step^3 / 6. |w| <= HALLEY_STEP =: q, |step| <= q delta. From h'' above |f_delta_delta_delta|
# delta^2 / (6 f_delta) <= (3 theta + theta (theta + delta) sin delta) delta^2 / (6 h) <= pi^2 / 4 + pi^2 / 6, for h >=
# delta + theta (1 - cos delta) >= theta delta^2 2 / pi^2: so delta is off by at most q^3 delta (1/4 + 4.2) = 3.6e-17
# delta. The bisection of first_root() ends in a bracket of 2 pi / 2^60 = 0.05 u. Rounding of delta itself, of its steps
# and of the sum with REST: 2.1 u delta.
#     local = 7 u chord / cos alpha_b + growth length u (2.5 delta + 0.05).
# 2. From link to link a displacement is multiplied by the rate ratio cos alpha_a / cos alpha_b: at most 1 out on the
# spiral, more towards the fold. The larger of it and 1 is taken, so that SLIP never falls from handle to handle.
# 3. Second order. Both cosines are those of the computed handles, and differ by at most nu from those of the true ones:
# u turns by 1 / chord per metre of either handle; T_b by at most 2.2 / chord (curvature <= 1.0887 / r_b and chord
# <= 2 r_b), T_a by 13 / chord (chord <= growth (2 theta_a + 2 pi), which times the curvature at theta_a is below 13);
# and both are computed from points with the errors E, see 4, so
#     nu = (14 SLIP[a] + 3.2 SLIP[b] + E[a] + E[b]) / chord + 8 u.
# While nu <= cos alpha_b / 6 a factor 1 + 3 nu / cos alpha_b covers this, as (|cos alpha_a| + nu) / (cos alpha_b - nu)
# <= max(1, |ratio|) (1 + 1.2 * 2 nu / cos alpha_b); SLIP[b] without this factor is at most 1.5 times smaller. For a
# larger nu no bound is known: FREE.
# 4. Turning. e[k] turns by delta with s, c to 3.75 u s, 1.75 u (4 u s, 4 u where the library serves). For m = 2 s the
# matrix (rise, sine) is then good to 7.7 u m (12.2 u m), the four products and sums add 2.83 u m + u: each link adds an
# error of at most u (1 + 12 delta) to e. A point growth THETA e has two more products and no REST, 3 u:
#     E[k] = SLIP[k] + r[k] u (k + 4 + 12 (theta[k] - theta[0])).
# Row k holds it for both handles of bench k: ERROR = E[k + 1] >= E[k].
# 5. The direction (P_a - P_b) / chord of a bench is better than 2 E / chord, because most of E is common to both
# handles. If its leader is displaced by x <= SLIP[a] along the path, the whole link moves on and turns at omega = (|sin
# alpha_a| + |ratio sin alpha_b|) / chord =: lean / chord. Its rear handle then has the error `local` (2 and 3
# included), the frame has the error of e[a], and there remain the rotation of one link and the 3 u of each point:
#     SWAY[k] = u (k + 12 (theta[k] - theta[0])) + 4 u + (lean SLIP[a] + 2 local + (what 3 added) + r_b u (7 + 12
#     delta)) / chord


def slipped(slip, ratio, slope, local, spots, inverse):
    """Displacement of a rear handle [m], from that of its leader by 2 and 3 above; FREE where no bound is known.

    ratio: of their rates; slope: 1 / cos alpha_b; local: error that the link itself adds [m]; spots: sum of E - SLIP of
    both [m]; inverse: of the chord [1/m]
    """
    passed_on = slip * max(1.0, fabs(ratio)) + local
    more = ((64.0 * passed_on + 3.0 * spots) * inverse + 24.0 * ULP) * slope
    return passed_on + passed_on * more if 0.0 < more < 0.5 else FREE


def swayed(k, chain, ratio, local, spread, inverse):
    """Largest error of the direction of bench k in its frame, by 5 above [1].

    spread: errors of its computed points that are not common to both [m]; others as for slipped(), which must have
    filled in SLIP of both
    """
    ux = chain[k, UX]
    uy = chain[k, UY]
    slip = chain[k, SLIP]
    ratio = fabs(ratio)
    lean = fabs(chain[k, TX] * uy - chain[k, TY] * ux) + ratio * fabs(chain[k + 1, TX] * uy - chain[k + 1, TY] * ux)
    spread += chain[k + 1, SLIP] - slip * max(1.0, ratio) + local
    return (lean * slip + spread) * inverse + 4.0 * ULP


# Input:  a chain whose rounding is filled in up to handle FILLED.
# State:  the SLIP of the last handle, from which that of the next one follows (1 to 3 above).
# Output: SLIP of the handles, ERROR and SWAY of the benches between them; the same in route_rounding().
def spiral_rounding(growth, last, sizes, chain):
    """Fill in SLIP, ERROR and SWAY of a chain up to handle `last`."""
    first = cython.cast(cython.Py_ssize_t, chain[0, FILLED])
    for k in range(first, last):
        chord = sizes[k, CHORD]
        inverse = 1.0 / chord
        theta = chain[k + 1, THETA]
        delta = theta - chain[k, THETA]
        slope = 1.0 / (chain[k + 1, TX] * chain[k, UX] + chain[k + 1, TY] * chain[k, UY])
        ratio = (chain[k, TX] * chain[k, UX] + chain[k, TY] * chain[k, UY]) * slope
        turned = ULP * (k + 5.0 + 12.0 * (theta - chain[0, THETA]))
        local = ULP * (7.0 * chord * slope + growth * sqrt(1.0 + theta * theta) * (2.5 * delta + 0.05))
        radius = growth * theta
        chain[k + 1, SLIP] = slipped(chain[k, SLIP], ratio, slope, local, 2.0 * radius * turned, inverse)
        chain[k, ERROR] = chain[k + 1, SLIP] + radius * turned
        chain[k, SWAY] = turned + swayed(k, chain, ratio, local, radius * ULP * (7.0 + 12.0 * delta), inverse)
    chain[0, FILLED] = max(first, last)


# Away from the centre, where no angle between a tangent and a chord exceeds asin(SINE_LIMIT), cos alpha_b >= 0.243 and
# the ratios are at most 1 (bounds.py). So after n links with chords up to c, at r = r[n], with growth length <= r +
# growth, the sums above are at most
#     E = u (32 n c + (r + growth) (16 (theta[n] - theta[0]) + 1.1 n + 5)),  SWAY <= 2 E / shortest + 8 u.
# This needs no look at the chain and serves all but the few pairs that come near the margin. 7 / 0.243 = 28.8, 2.5 + 12
# = 14.5 and 1.05 leave a tenth for the factors of 3, which together stay below exp(n 64 E / (0.243 shortest)) < 1.03
# while n E <= SMALL shortest.


def spiral_error(growth, last, longest, chain):
    """E above, for the handles up to `last` [m]."""
    theta = chain[last, THETA]
    return ULP * (
        32.0 * last * longest + growth * (theta + 1.0) * (16.0 * (theta - chain[0, THETA]) + 1.1 * last + 5.0)
    )


# On a route. The assumptions above, SLIP, E and the second order serve here too. The table is exact. The path of the
# dance is the smooth one that its pieces nearly form: they may miss each other at a joint by up to 1e-9 m and rad, and
# the path leaves them by at most LOOSE, and only within BLEND of a joint (see Route). The place of a handle is defined
# by the numbers of its piece: s - S_START on a line and on a clothoid, on an arc the angle and on a spiral theta in
# double-double, t on a cubic. Its s is only where the search for it began. E - SLIP is the distance of the computed
# point from the point of the piece there:
#   line     one product and the sum:                                             u (|x| + |y| + |s - S_START|)
#   arc      cos and sin 3 u each with the low part, a product, the sum:          u (|x| + |y| + 6 radius)
#   spiral   the same, and growth theta:                                          u (|x| + |y| + 7 r)
#   clothoid 14 u of the way in both parts (clothoid.py), two products and a sum: u (|x| + |y| + 25 |s - S_START|)
#   cubic    the sum of |c_k| end^k, k >= 1, of both coordinates =: C:            u (|x| + |y| + 12 C)
# From link to link the distance of the computed points misses the chord by a difference that is measured, however the
# search for it ended, and by the points' own errors:
#     local = (|distance - chord| + (E - SLIP)[a] + (E - SLIP)[b] + 8 u chord) / cos alpha_b.
# A handle's tangent turns by the curvature k per metre, 2 / chord at most on all but sharper routes: there k / 2 stands
# for 1 / chord.
# A place that rounding puts beyond a joint is taken on the piece before the joint, extended that far: the error of its
# point is the square of that.
# The head's place is not exactly that of its s: slide_error() below, an error of the travel, not of the shape.
#   line     s - S_START, the same on a clothoid:                                 u |s - S_START|
#   arc      no more than the point itself, with |c| for both coordinates of the centre: u (8 radius + |c|)
#   spiral   the same, r <= sqrt(2 growth A); asinh, up to 14, in the arc lengths A of both ends and of the place; all
#            else is of double-double (double_double.py):          u (100 growth + 1e-6 A + 8 sqrt(2 growth A) + |c|)
#   cubic    |r'| end and the length are at most 3 C; the quadrature, a sum of 8, is good to 57 u C, and the Newton
#            steps that invert it end within 30 u C:                              100 u C
# The error of the quadrature itself, 1e-13 of the arc length (core/paths/cubics.py), is left out: s on a cubic is
# defined as the result of the quadrature.


def cubic_size(pieces, p):
    """C: sum of |c_k| end^k of both coordinates, k >= 1 [m]."""
    t = pieces[p, T_END]
    return t * (
        fabs(pieces[p, X1])
        + fabs(pieces[p, Y1])
        + t * (fabs(pieces[p, X2]) + fabs(pieces[p, Y2]) + t * (fabs(pieces[p, X3]) + fabs(pieces[p, Y3])))
    )


def spot_error(pieces, p, s, theta, x, y):
    """Largest distance between a computed point of piece p and the path's point [m]; theta: on a spiral."""
    kind = cython.cast(cython.int, pieces[p, PIECE_KIND])
    error = fabs(x) + fabs(y)
    if kind == LINE:
        error += fabs(s - pieces[p, S_START])
    elif kind == CLOTHOID:
        error += 25.0 * fabs(s - pieces[p, S_START])
    elif kind == ARC:
        error += 6.0 * pieces[p, ARC_RADIUS]
    elif kind == SPIRAL:
        error += 7.0 * pieces[p, COIL_GROWTH] * theta
    else:
        error += 12.0 * cubic_size(pieces, p)
    if s < pieces[p, S_START] + BLEND or s > pieces[p, S_END] - BLEND:
        return ULP * error + pieces[p, LOOSE]
    return ULP * error


def slide_error(pieces, p, s):
    """Largest distance along the path between a computed point of piece p and the point at s [m]."""
    kind = cython.cast(cython.int, pieces[p, PIECE_KIND])
    away = fabs(s - pieces[p, S_START])
    if kind == LINE or kind == CLOTHOID:
        return ULP * away
    if kind == ARC:
        return ULP * (8.0 * pieces[p, ARC_RADIUS] + fabs(pieces[p, CENTRE_X]) + fabs(pieces[p, CENTRE_Y]))
    if kind == SPIRAL:
        arc = fabs(pieces[p, COIL_ARC]) + away
        error = 100.0 * pieces[p, COIL_GROWTH] + 1e-6 * arc + 8.0 * sqrt(2.0 * pieces[p, COIL_GROWTH] * arc)
        return ULP * (error + fabs(pieces[p, CENTRE_X]) + fabs(pieces[p, CENTRE_Y]))
    return 100.0 * ULP * cubic_size(pieces, p)


def piece_end(pieces, p, s, low):
    """route_point() at either end of a piece, on a cubic without a search for t."""
    if pieces[p, PIECE_KIND] <= CLOTHOID:
        return route_point(pieces, p, s, low)
    return cubic_point(pieces, p, 0.0 if s == pieces[p, S_START] else pieces[p, T_END])


# Input:  a table of pieces.
# State:  the gaps at the joint before piece p, widened by the rounding of both pieces there.
# Output: a row of MISS_COLUMNS for every piece but the first.
def joint_misses(pieces, out):
    """Fill in upper bounds of the gap between every piece and the one before it: across and along the path [m], in
    direction [rad], in curvature [1/m]. out: (rows, MISS_COLUMNS), of which the first row stays as it is

    A tangent is good to 10 u; on a cubic to 15 u C / (|r'| end), and there the curvature is good to
    72 u (C / (|r'| end))^2 / C.
    """
    for p in range(1, pieces.shape[0]):
        s = pieces[p, S_START]
        low = pieces[p, S_START_LOW]
        x, y, tx, ty, curvature = piece_end(pieces, p - 1, s, low)
        x_on, y_on, tx_on, ty_on, curvature_on = piece_end(pieces, p, s, low)
        across = fabs(tx * (y_on - y) - ty * (x_on - x))
        along = fabs(tx * (x_on - x) + ty * (y_on - y))
        kink = sqrt((tx_on - tx) * (tx_on - tx) + (ty_on - ty) * (ty_on - ty)) + 20.0 * ULP
        step = fabs(curvature_on - curvature) + 10.0 * ULP * (fabs(curvature_on) + fabs(curvature))
        for q in range(p - 1, p + 1):
            theta = theta_at(pieces, q, s, low)[0] if pieces[q, PIECE_KIND] == SPIRAL else 0.0
            across += spot_error(pieces, q, s, theta, x, y)
            along += slide_error(pieces, q, s)
            if pieces[q, PIECE_KIND] == CLOTHOID:
                step += 4.0 * ULP * (fabs(pieces[q, K_START]) + fabs(pieces[q, K_END]))
            if pieces[q, PIECE_KIND] > CLOTHOID:
                size = cubic_size(pieces, q)
                ratio = size / (pieces[q, T_END] * cubic_speed(pieces, q, 0.0 if q == p else pieces[q, T_END]))
                kink += 15.0 * ULP * ratio
                step += 72.0 * ULP * ratio * ratio / size
        out[p, MISS_ACROSS] = across
        out[p, MISS_ALONG] = along
        out[p, MISS_KINK] = kink
        out[p, MISS_STEP] = step


def piece_slides(pieces, out):
    """Fill in the largest slide_error() on every piece [m]. out: (rows,)"""
    for p in range(pieces.shape[0]):
        out[p] = slide_error(pieces, p, pieces[p, S_END])


def route_rounding(pieces, last, sizes, chain):
    """Fill in SLIP, ERROR and SWAY of a chain up to handle `last`."""
    first = cython.cast(cython.Py_ssize_t, chain[0, FILLED])
    spot = chain_spot(pieces, first, chain)
    sharpest = pieces[0, SHARPEST] + pieces[0, CURVATURE_SLACK]
    cornered = pieces[0, CORNERED] > 0.0
    for k in range(first, last):
        chord = sizes[k, CHORD]
        inverse = max(1.0 / chord, 0.5 * sharpest)
        spots = spot
        spot = chain_spot(pieces, k + 1, chain)
        spots += spot
        slope = 1.0 / (chain[k + 1, TX] * chain[k, UX] + chain[k + 1, TY] * chain[k, UY])
        ratio = (chain[k, TX] * chain[k, UX] + chain[k, TY] * chain[k, UY]) * slope
        if cornered:  # the tangents of both sides, and an angle of u that may be any
            rear, _ = sided_cosines(pieces, k + 1, k, chain)
            _, front = sided_cosines(pieces, k, k, chain)
            slope = max(slope, 1.0 / rear) if rear > 0.0 else FREE
            ratio = max(fabs(ratio), front * slope)
        # u is the difference of the points over the chord; | |u| - 1 | <= 0.6 | |u|^2 - 1 | unless the link is far off
        u2 = chain[k, UX] * chain[k, UX] + chain[k, UY] * chain[k, UY]
        local = (chord * (0.6 * fabs(u2 - 1.0) + 8.0 * ULP) + spots) * slope
        chain[k + 1, SLIP] = slipped(chain[k, SLIP], ratio, slope, local, spots, inverse)
        chain[k, ERROR] = chain[k + 1, SLIP] + spots
        if k > 0:
            chain[k, ERROR] = max(chain[k, ERROR], chain[k - 1, ERROR])
        chain[k, SWAY] = swayed(k, chain, ratio, local, spots, inverse)
        if cornered:
            chain[k, SWAY] += (1.0 + ratio) * chain[k, SLIP] * inverse
            if chain[k + 1, SLIP] > CORNER_NEAR:
                chain[k + 1, SLIP] = FREE
    chain[0, FILLED] = max(first, last)


def chain_spot(pieces, k, chain):
    """spot_error() of handle k."""
    p = cython.cast(cython.Py_ssize_t, chain[k, PIECE])
    return spot_error(pieces, p, -chain[k, PLACE], chain[k, PIECE_THETA], chain[k, PX], chain[k, PY])
