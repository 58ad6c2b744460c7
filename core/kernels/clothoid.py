"""Clothoids: the way from the beginning of a row to a place on it.

A clothoid is a curve whose curvature changes evenly with its arc length (Euler's spiral, a Cornu spiral, a transition
curve of railways). Its places are Fresnel integrals. Here they are a power series on rows so short that no digits
cancel; differences of Fresnel integrals lose them all where the curvature hardly changes.
"""

import cython
from cython.cimports.libc.math import cos, fabs, sin

if not cython.compiled:  # the .pxd imports the same names for the compiler
    from core.kernels.constants import *
    from core.kernels.double_double import quotient, two_product, two_sum

# Where two terms in a row are smaller than this, the rest of the series is too [1]: see below.
LAST_TERM = 1e-18


# Along a row of length l the curvature is k + c v at v from its beginning, so the direction has turned by
# k v + c v^2 / 2. With x = v / u, p = k u and q = c u^2 the way up to u, in the row's own direction, is u times
#     g(1),   g(x) = integral from 0 to x of f,   f(x) = e^(i (p x + q x^2 / 2)).
# f' = i (p + q x) f, so with g = x (w_0 + w_1 x + w_2 x^2 + ...) and f = w_0 + 2 w_1 x + 3 w_2 x^2 + ...
#     w_0 = 1,   w_-1 = 0,   w_(n+1) = i (p / (n + 2) w_n + q n / ((n + 1) (n + 2)) w_(n-1)).
# Rows are so short that |k| l <= ROW_TURN = 1/4 at both ends (pieces.py). Hence |p| <= 1/4, |q| <= 1/2 and
# |p x + q x^2 / 2| <= 1/4.
#
# End. Let M be the larger of |w_n| and |w_(n-1)|. Both factors are below 1/4 in sum from n = 1 on, so the next two
# terms are at most M / 4, the two after them at most M / 16, and so on: what is left out is at most 2/3 M <= 1e-18.
#
# Rounding, u = ULP. |w_n| <= W_n, where the sum of W_n x^(n+1) is the integral of e^(x / 4 + x^2 / 4); the sum of
# (n + 1) W_n is below 1.65, that of W_n from n = 1 on is from 0.22 to 0.25. p is good to u and q to 2 u, so both
# factors are good to 4 u; a product and a sum add 2 u. So either part of w_n is off by at most 6 u n W_n, in sum by
# 2.6 u. Fewer than 30 sums of at most 0.25 add 7.5 u; the last one, with 1, and the product with the way u add 2.5 u.
# In all the way is off by less than 14 u of itself in either part.
def clothoid_way(p, q):
    """g(1) above: the integral of e^(i (p x + q x^2 / 2)) from 0 to 1, as two numbers [1].

    p: curvature at the beginning times the length; q: change of the curvature times the length [rad]
    """
    x = 1.0
    y = 0.0
    x_before = 0.0
    y_before = 0.0
    x_sum = 0.0
    y_sum = 0.0
    n = 0.0
    while n < 40.0:
        a = p / (n + 2.0)
        b = q * n / ((n + 1.0) * (n + 2.0))
        x_next = -(a * y + b * y_before)
        y_next = a * x + b * x_before
        x_before = x
        y_before = y
        x = x_next
        y = y_next
        x_sum += x
        y_sum += y
        n += 1.0
        if fabs(x) + fabs(y) + fabs(x_before) + fabs(y_before) < LAST_TERM:
            break
    return 1.0 + x_sum, y_sum


# Beyond its ends a clothoid goes on with the curvature of that end. So the curvature of a route stays between those of
# its pieces wherever a loop looks a little beyond an end. On a circle of curvature k a way v turns by k v, and its
# chord is v sin(k v / 2) / (k v / 2) long, in the direction half way.
def clothoid_point(pieces, p, u):
    """route_point() on a clothoid, u from its beginning."""
    length = (pieces[p, S_END] - pieces[p, S_START]) + (pieces[p, S_END_LOW] - pieces[p, S_START_LOW])
    way = min(max(u, 0.0), length)
    curvature = pieces[p, K_START] + pieces[p, K_RATE] * way
    turned = way * (pieces[p, K_START] + 0.5 * pieces[p, K_RATE] * way)
    x, y = clothoid_way(pieces[p, K_START] * way, pieces[p, K_RATE] * way * way)
    x *= way
    y *= way
    if u != way:
        half = 0.5 * curvature * (u - way)
        chord = (u - way) * (sin(half) / half if half != 0.0 else 1.0)
        x += chord * cos(turned + half)
        y += chord * sin(turned + half)
        turned += 2.0 * half
    c = cos(turned)
    d = sin(turned)
    dx = pieces[p, LINE_DX]
    dy = pieces[p, LINE_DY]
    return (
        pieces[p, LINE_X] + (dx * x - dy * y),
        pieces[p, LINE_Y] + (dx * y + dy * x),
        dx * c - dy * d,
        dx * d + dy * c,
        curvature,
    )


# The direction at v is heading + v (first + slope v / 2): in double-double, because 1 km of curvature 1 / m turns by
# 1,000 rad, which a double knows to 1e-13. A place is the sum of the ways of all rows before it, each good to 25 u of
# its own length, with what rounding takes from the sum.
def clothoid_joints(x, y, heading, first, last, length, places, out):
    """Fill in the points of a clothoid where its rows meet, and at both ends.

    x, y: its start [m]; heading: its direction there [rad]; first, last: its curvature at either end [1/m]
    length, places: (rows + 1,), from 0 to its length [m]; out: (rows + 1, POINT_COLUMNS), as for route_points()
    """
    change, change_low = two_sum(last, -first)
    slope, slope_low = quotient(change, change_low, length, 0.0)
    x_low = 0.0
    y_low = 0.0
    for k in range(places.shape[0]):
        v = places[k]
        bend, bend_low = two_product(0.5 * slope, v)
        bend_low += 0.5 * slope_low * v
        bend, lost = two_sum(first, bend)
        turned, low = two_product(bend, v)
        low += (bend_low + lost) * v
        turned, lost = two_sum(heading, turned)
        low += lost
        c = cos(turned)
        d = sin(turned)
        out[k, PX] = x + x_low
        out[k, PY] = y + y_low
        out[k, TX] = c - low * d
        out[k, TY] = d + low * c
        out[k, POINT_CURVATURE] = first + slope * v
        if k + 1 < places.shape[0]:
            way = places[k + 1] - v
            along, left = clothoid_way(out[k, POINT_CURVATURE] * way, slope * way * way)
            x, lost = two_sum(x, (out[k, TX] * along - out[k, TY] * left) * way)
            x_low += lost
            y, lost = two_sum(y, (out[k, TX] * left + out[k, TY] * along) * way)
            y_low += lost
    out[places.shape[0] - 1, POINT_CURVATURE] = last
