"""Benches that repeat, at the same places, the meetings of benches ahead of them; the chain of the other benches."""

import cython
from cython.cimports.libc.math import fabs

if not cython.compiled:  # the .pxd imports the same names for the compiler
    from core.kernels.bounds import followed_error
    from core.kernels.chain import chain_rounding, extend_chain, head_theta, start_chain
    from core.kernels.constants import *
    from core.kernels.records import Laid
    from core.kernels.rings import coil_place, coil_radius, coil_reach, drift, leaders_reach, radius_beyond
    from core.kernels.route import extend_route, stands_first, start_route
    from core.kernels.spiral import spiral_curvature

# A handle counts as having passed a place once it is this far beyond it, relative to 1 + |LAG| [1], and
# further than the errors of both. On a spiral where no handle is followed this is more than SLIP: that is at most
# u (32 n c + 16 r (theta - theta_0) + 2 r n) (spiral_error()), with n c <= r theta, an angle below
# u (48 theta + 2 n), n < 1e6.
PASSED_BY = 1e-9


# Input:  a scene, the place of the head, and the benches that may lead pairs.
# State:  the chain, laid out handle by handle.
# Output: the chain up to the last bench in reach of those that lead pairs now, and the record Laid.
def chain_between(scene, place, leaders, allowance, reversing, chain):
    """Fill in the chain of a head at a place as far as its leading benches reach; returns its extent, and their number.

    allowance: extra radius for motion during an interval [m], also added to the leading benches if they are `reversing`
    """
    if not scene.curve.is_spiral:
        return route_between(scene, place, leaders, allowance, chain)
    growth = scene.curve.growth
    theta = head_theta(scene.curve, place)
    start_chain(theta, chain)
    scene.turn_edges(chain)
    clear = scene.rings.clear_radius + (allowance if reversing else 0.0)
    k = extend_chain(growth, 0, leaders, clear, scene.sizes, chain)
    if k <= 0:
        return Laid(k, k)
    radius = leaders_reach(growth, growth * theta, growth * chain[k, THETA] + allowance, scene.rings)
    radius = radius_beyond(growth, radius + scene.margin, scene.rings) + allowance
    return Laid(extend_chain(growth, k, scene.room, radius, scene.sizes, chain), k)


def route_between(scene, place, leaders, allowance, chain):
    """chain_between() on a route: as far as rings.py says if the route begins with a coil inwards, else all benches."""
    start_route(scene.curve.pieces, -place, 0.0, chain)
    if scene.rings.clear_place >= FREE:
        return Laid(extend_route(scene.curve.pieces, 0, scene.room, FREE, scene.sizes, chain), leaders)
    leading = extend_route(scene.curve.pieces, 0, leaders, scene.rings.clear_place, scene.sizes, chain)
    if leading == 0:
        return Laid(0, 0)
    radius = coil_reach(scene.curve.pieces, leading, scene.sizes, chain) + scene.margin + allowance
    radius = radius_beyond(scene.curve.pieces[0, COIL_GROWTH], radius, scene.rings) + allowance
    until = coil_place(scene.curve.pieces, radius)
    k = extend_route(scene.curve.pieces, leading, scene.room, until, scene.sizes, chain)
    while k < scene.room and (  # a handle within rounding of that place
        not stands_first(scene.curve.pieces, k, chain)
        or coil_radius(scene.curve.pieces, chain[k, PX], chain[k, PY]) < radius
    ):
        k = extend_route(scene.curve.pieces, k, k + 1, FREE, scene.sizes, chain)
    return Laid(k, leading)


# The family lemma. Let m be the first of the benches that are alike to the tail (`leaders` = m + 1), and let lag_i(t)
# be the LAG of handle i with the head at travel t. The handle behind one at lag p is the first point behind p at
# its chord (spiral.py, route.py): a function N_i of p alone, and N_i = N for all i >= m. So all handles from i on, and
# with them the benches i and j > i, stand at N_i, N_(i+1) N_i, ... of lag_i: the separation of (i, j) is a function
# of lag_i alone, and for i >= m one of lag_i and j - i alone, g_(j - i)(lag_i). (m, m + j - i) is a pair too, as
# m + j - i <= j.
#
# Lags fall in the direction of travel, and are continuous in t. Let the pairs led by every bench that may touch be
# followed from `start` to T, and only those led by benches 0 to m from T to t, and let nothing come within the margin.
# Pairs led by 0 to m were followed throughout. For a pair (i, j), i > m, at t, and x = lag_i(t), it suffices that
# g_(j - i) was followed at x: in a pair led by some bench i' in [m, i], which has an outer bench i' + j - i <= j, at an
# instant with lag_i' = x. Bench m was followed over all lags between lag_m(start) and the least of lag_m until
# t, every other such i' over those between lag_i'(start) and lag_i'(T). If
#     passed():   lag_i'(T) <= lag_(i'-1)(start)   for all i' in (m, i],
# these stretches overlap, each with the one of the bench before it, and cover all from the least of lag_m to
# lag_i(start); and x >= lag_m(t), as no handle overtakes. So x is covered if
#     lag_i(t) <= lag_i(start),
# that is, if bench i is not further back than where it started. On a route this always holds: handles only go forward
# (route.py). On a spiral a handle reverses where the link before it stands across the path, near the fold: while one
# may stand behind its start (slid_back()), all pairs are followed again.
#
# Bench i leads no pair that may touch while lag_i >= clear, which is clear_place on a route and clear_radius / growth
# on a spiral. Let `opened` be the first bench that started there. Benches behind it need neither of the two conditions:
# x < clear lies before lag_opened(start), and benches m to `opened` cover that by passed() alone. (If m >= opened,
# bench m itself covers everything from clear on.) chain_between() leaves these benches out at the far end of every
# step. Where handles only go forward, they were beyond `clear` during the whole step; a handle that may reverse is
# kept among the leaders while it is within a drift of clear_radius (`reversing`).
#
# With edges at rest in place of the second bench the same holds for g(lag_i), the separation of a bench and an edge.


# Input:  the chain at the start (`opening`) and the chain now, with the benches from `first` on.
# State:  the handle compared with the start of the one before it.
# Output: whether these benches repeat what others met: passed(), and for a spiral not slid_back().
def passed(scene, first, last, placed, opening, chain):
    """Whether every handle from `first` to `last` has passed where its predecessor began, by more than rounding.

    The LAG of a handle that is SLIP along its path from its true place is off by at most SLIP / growth.
    """
    for i in range(first, last + 1):
        if i > placed or chain[i, LAG] + PASSED_BY * (1.0 + fabs(chain[i, LAG])) > opening[i - 1, LAG]:
            return False
    chain_rounding(scene.curve, last, scene.sizes, opening)
    if first <= last:
        chain_rounding(scene.curve, last, scene.sizes, chain)
    for i in range(first, last + 1):
        slip = (chain[i, SLIP] + opening[i - 1, SLIP]) / scene.curve.growth
        if chain[i, LAG] + slip > opening[i - 1, LAG]:
            return False
    return True


# A rate is at least the mean of its values at both ends less |s''| h / 2, and these values are good to
# followed_error(). Where no handle is followed, none reverses (RATE_LOW > 0).


def may_reverse(interval, k, error):
    """Whether handle k of a spiral may go backwards during an interval. error: of its rates at both ends [1]"""
    most = interval.motion[k, RATE_RATE] * interval.h + 2.0 * error
    return interval.motion[k, RATE_LOW] <= 0.0 and interval.before[k, RATE] + interval.after[k, RATE] <= most


def leader_may_reverse(interval, k):
    """may_reverse(), with the error of the rates computed from link to link."""
    error = 0.0
    if interval.motion[k, RATE_LOW] > 0.0:
        return False
    for i in range(1, k + 1):
        error = followed_error(i, error, interval.scene.sizes, interval.before, interval.after)
    return may_reverse(interval, k, error)


def slid_back(scene, interval, first, last, opening):
    """Whether a handle of a spiral from `first` to before `last` may have been behind its own start during an interval.

    Behind the last handle placed, curvature is within the chord lemma (bounds.py), so every handle there moves
    in the direction of its leader, and the answer for the last handle placed holds for all of them. Radii are off by
    less than SLIP, and by less than PASSED_BY of 1 + theta where no handle is followed.
    """
    growth = scene.curve.growth
    placed = interval.handles
    error = 0.0
    for k in range(min(last, placed + 1)):
        followed = interval.motion[k, RATE_LOW] <= 0.0
        if k > 0 and followed:
            error = followed_error(k, error, scene.sizes, interval.before, interval.after)
        if k < first and k < placed:
            continue
        low = growth * max(interval.before[k, THETA], interval.after[k, THETA])
        low += PASSED_BY * (growth + low) + opening[k, SLIP]
        if followed:
            low += max(interval.before[k, SLIP], interval.after[k, SLIP])
        if k > 0 and may_reverse(interval, k, error):
            low += drift(interval.motion[k - 1, HANDLE_SPEED], interval.h, growth, low)
        if low > growth * opening[k, THETA]:
            return True
    low = min(interval.before[placed, THETA], interval.after[placed, THETA])
    low -= drift(interval.motion[placed - 1, HANDLE_SPEED], interval.h, growth, growth * low) / growth
    return placed + 1 < last and 0.5 * spiral_curvature(low) * scene.rings.all_chord > SINE_LIMIT * growth
