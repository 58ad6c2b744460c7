"""Corners, where two lines of a route meet at an angle: what a bench does while it reaches over one or passes it."""

import cython
from cython.cimports.libc.math import fabs

if not cython.compiled:  # the .pxd imports the same names for the compiler
    from core.kernels.constants import *
    from core.kernels.records import LinkBounds

# A link whose handles a and b have a corner between them, or pass one, is beyond the chord lemma. With the names of
# bounds.py, let [0, h] be an interval of head travel, u(0) the direction of the bench at its beginning, a' <= A proven,
# and R a trial bound on b'. As long as b' <= R on [0, x],
#     u turns by at most x (A + R) / c from u(0), and
#     the tangent at a is within x k A of the tangent at its place at 0 or, if it passed corners, within x k A of the
#     direction behind or beyond one of them: between corners it turns by the curvature, at most k. At b with R.
# So cos alpha_a(x) is at most the largest, and cos alpha_b(x) at least the least, of u(0) . T over these tangents T, up
# to h times these rates. If the R that these cosines allow, A cos alpha_a / cos alpha_b, is at most the trial bound,
# b' cannot pass it first at any x < h, neither gradually nor by a jump at a corner: the trial is proven. The cosines
# then bound b' itself.
#
# Jumps. Where a handle passes a corner between unit tangents T and T', |T' - T| = J is the column CORNER. The jumps of
# the rates, of velocities, and of omega then add up over an interval to V at most, as follows from the equations of
# bounds.py: of b' cos alpha_b = a' cos alpha_a by V_b cos alpha_b <= V_a cos alpha_a + A J_a + B J_b, of P' = s' T by
# V_s + s' J, of omega c by A J_a + B J_b + V_a + V_b, with J_a and J_b the sums over the corners that a and b pass. Now
# let g have |g''| <= K but for jumps of g' of V in all. With the function G(x, y) <= x (h - x) / h of Green,
#     g(x) >= its chord - K x (h - x) / 2 - V x (h - x) / h = its chord - (K + 2 V / h) x (h - x) / 2,
# and |g(x)| <= (|g(0)| + |g(h)| + (K + 2 V / h) h) / 2 if |g'| <= K but for jumps of g. So bounds on second derivatives
# take jumps in as 2 V / h, and all that is linear in them stays true: route_bounds() does so.
#
# Rounding. A handle that is not further than its SLIP from a corner counts as on both sides of it: see sided_pieces().

# Trial bound as a multiple of the rate at the beginning [1]; any value > 1 is sound. The factor for the rounding of a
# link is LOOSEN of bounds.py.
TRIAL_CORNER = 1.5
LOOSEN_CORNER = 1.0 + 4e-15
# Distance from a corner within which the displacement of a handle counts with the tangents of both sides [m]; shorter
# than half of the shortest line. A handle displaced further has no known bound.
CORNER_NEAR = 1e-7


def sided_pieces(pieces, k, spare, chain):
    """First and last piece on which handle k stands, if it may be displaced across a corner by a distance `spare`."""
    p = cython.cast(cython.Py_ssize_t, chain[k, PIECE])
    s = -chain[k, PLACE]
    if pieces[p, CORNER] > 0.0 and s - spare < pieces[p, S_START]:
        return p - 1, p
    if p + 1 < pieces.shape[0] and pieces[p + 1, CORNER] > 0.0 and s + spare > pieces[p, S_END]:
        return p, p + 1
    return p, p


def displaced_by(k, chain):
    """Largest distance of handle k from its true place, with the rounding of that [m]."""
    return chain[k, SLIP] + 8.0 * ULP * fabs(chain[k, PLACE])


def passed_pieces(pieces, k, before, after):
    """First and last piece on which handle k stands during an interval."""
    first, _ = sided_pieces(pieces, k, displaced_by(k, before), before)
    _, last = sided_pieces(pieces, k, displaced_by(k, after), after)
    return first, last


def corners_between(pieces, first, last):
    """Sum of the jumps |T' - T| of the tangent from one piece to another [1]; 0 without a corner."""
    total = 0.0
    for p in range(first + 1, last + 1):
        total += pieces[p, CORNER]
    return total


def cosines_past(pieces, first, last, tx, ty, ux, uy):
    """Least and greatest u . T of a tangent and of the lines beside every corner from one piece to another."""
    low = high = ux * tx + uy * ty
    for p in range(first + 1, last + 1):
        if pieces[p, CORNER] > 0.0:
            for side in range(p - 1, p + 1):
                cosine = ux * pieces[side, LINE_DX] + uy * pieces[side, LINE_DY]
                low = min(low, cosine)
                high = max(high, cosine)
    return low, high


def sided_cosines(pieces, k, i, chain):
    """cosines_past() of the direction of bench i and the tangent at handle k, which may be displaced by CORNER_NEAR."""
    first, last = sided_pieces(pieces, k, CORNER_NEAR, chain)
    return cosines_past(pieces, first, last, chain[k, TX], chain[k, TY], chain[i, UX], chain[i, UY])


def bench_has_corner(pieces, k, before, after):
    """Whether bench k reaches over a corner, or passes one, during an interval."""
    first, _ = passed_pieces(pieces, k + 1, before, after)
    _, last = passed_pieces(pieces, k, before, after)
    return corners_between(pieces, first, last) > 0.0


# Input:  bench k over an interval of width h, the stretch of the path under it, and the rate A of its leader.
# State:  R, first the trial bound.
# Output: bounds on the link, by the argument at the top of this file.
def cornered_link(pieces, k, h, stretch, rate_a, before, after):
    """Bounds on a link that reaches over a corner or passes one, as far as they are known."""
    k_high = stretch.high
    chord = stretch.chord
    ux = before[k, UX]
    uy = before[k, UY]
    first, last = passed_pieces(pieces, k, before, after)
    _, front_start = cosines_past(pieces, first, last, before[k, TX], before[k, TY], ux, uy)
    first, last = passed_pieces(pieces, k + 1, before, after)
    rear_start, _ = cosines_past(pieces, first, last, before[k + 1, TX], before[k + 1, TY], ux, uy)
    front_start = min(front_start + stretch.blur, 1.0)
    rear_start -= stretch.blur
    if rear_start <= 0.0:
        return LinkBounds(1.0, rear_start, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, True, False)
    rate_b = rate_a * (TRIAL_CORNER * front_start + h * rate_a * (k_high + 2.0 / chord)) / rear_start
    turned = h * (rate_a + rate_b) / chord
    front = min(front_start + turned + h * k_high * rate_a, 1.0)
    rear = rear_start - turned - h * k_high * rate_b
    bounded = not (rear <= 0.0 or rate_a * front > rate_b * rear)
    if bounded:
        rate_b = min(rate_b, LOOSEN_CORNER * rate_a * front / rear)
    omega = (rate_a + rate_b) / chord
    swing_a = k_high * rate_a + omega
    swing_b = k_high * rate_b + omega
    return LinkBounds(front, rear, 1.0, rate_b, 0.0, omega, 0.0, swing_a, swing_b, True, bounded)


def passes_corner(pieces, k, before, after, motion):
    """Whether handle k or one before it passes a corner during an interval, which CROSSED then says; its rates at both
    ends, which may be those of either side of the corner, then bound nothing in between."""
    first, last = passed_pieces(pieces, k, before, after)
    if corners_between(pieces, first, last) > 0.0:
        motion[k, CROSSED] += CORNER_PARTS
    if motion[k, CROSSED] < CORNER_PARTS:
        return False
    motion[k, RATE_ERROR] = motion[k, CLIMB_ERROR] = FREE
    return True


def jumped(pieces, k, rate_a, rate_b, before, after):
    """A J_a + B J_b of bench k over an interval [1]."""
    first, last = passed_pieces(pieces, k, before, after)
    front = corners_between(pieces, first, last)
    first, last = passed_pieces(pieces, k + 1, before, after)
    return rate_a * front + rate_b * corners_between(pieces, first, last)
