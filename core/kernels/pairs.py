"""Certified motion: lower bounds on the separation of two benches over an interval of head travel."""

import cython
from cython.cimports.libc.math import fabs, sqrt

if not cython.compiled:  # for the compiler the same stands in the .pxd
    from core.kernels.clearance import last_handle
    from core.kernels.constants import *
    from core.kernels.records import Bends, Nearest, Rounding
    from core.kernels.rectangles import row_separation
    from core.kernels.rings import RING_ROUNDING, coil_radius, drift, leaders_reach, radius_beyond
    from core.kernels.route import stands_first
    from core.kernels.spiral import spiral_error

# Gap of bench i along an axis e fixed in bench j: g = min over corners X of i of e . (X - M_j) - support of j, and
#   |(e . p)''| <= |X''| + |M_j''| + 2 omega_j |X' - M_j'| + (omega_j^2 + omega_j') |p|,  p = X - M_j:  call it K.
# The same in a frame that turns with bench j about the spiral's centre, where neighbouring rings hardly move: with
# Omega = omega_j (clockwise), xi = X' less the velocity Omega |X| of that rotation,
#   |(e . p)''| <= |X'' + Omega^2 X| + |M_j'' + Omega^2 M_j| + 2 Omega (|xi_X| + |xi_M|) + omega_j' |p|,
#   handle at radius r, b = growth:  |P'' + Omega^2 P| <= |s''| + |k s'^2 - Omega^2 r| + Omega^2 b,
#                                    |xi_P| <= |s' - Omega r| + Omega b   (the tangent leans by at most b / r),
#   corner of bench i:  |X'' + Omega^2 X| <= mean of its handles + (|Omega^2 - omega_i^2| + omega_i') rho,
#                       |xi_X| <= mean of its handles + |Omega - omega_i| rho.
# The smaller of the two bounds is used.
# A function with |g''| <= K stays above its chord minus K x (h - x) / 2, so its least value follows from both ends:
# two benches do not touch on [L, R] if that exceeds the margin for one axis. No step size is guessed.
#
# Rounding. The centre of bench i is the mean of two handles, each good to E_i = ERROR; its direction is good to W_i =
# SWAY. So a gap along an axis fixed in bench i, and the separation of two benches, is good to
#     G = E_i + E_j + u (|M_i| + |M_j| + D) + (W_i + W_j + 40 u) (D + rho_i + rho_j),  D = |M_j - M_i|,
# as each corner of j is within rho_j of M_j, and within D + rho_j of M_i. The last term has room for the operations of
# gap_along(), pair_gap() and least_between(), fewer than 32 on lengths up to D + rho_i + rho_j in all, and for a corner
# axis whose length is 1 +- 8 u. An interval proves nothing unless what it leaves exceeds the margin by G.


def gap_along(i, j, along, left, sizes, chain):
    """Gap between benches i and j along the unit vector (along, left) of bench i's frame, pointing to j [m]."""
    ex = along * chain[i, UX] - left * chain[i, UY]
    ey = along * chain[i, UY] + left * chain[i, UX]
    return (
        ex * (chain[j, MX] - chain[i, MX])
        + ey * (chain[j, MY] - chain[i, MY])
        - fabs(along) * sizes[i, HALF_LENGTH]
        - fabs(left) * sizes[i, HALF_WIDTH]
        - fabs(ex * chain[j, UX] + ey * chain[j, UY]) * sizes[j, HALF_LENGTH]
        - fabs(ey * chain[j, UX] - ex * chain[j, UY]) * sizes[j, HALF_WIDTH]
    )


def best_axis(i, j, sizes, chain):
    """The face normal of bench i with the largest gap to bench j, in i's frame: gap [m], along, left."""
    dx = chain[j, MX] - chain[i, MX]
    dy = chain[j, MY] - chain[i, MY]
    along = 1.0 if dx * chain[i, UX] + dy * chain[i, UY] > 0.0 else -1.0
    left = 1.0 if dy * chain[i, UX] - dx * chain[i, UY] > 0.0 else -1.0
    lengthwise = gap_along(i, j, along, 0.0, sizes, chain)
    sideways = gap_along(i, j, 0.0, left, sizes, chain)
    if sideways >= lengthwise:
        return sideways, 0.0, left
    return lengthwise, along, 0.0


def least_between(start, end, bend, h):
    """Least value on an interval of width h of a function with the given end values and |second derivative| <= bend."""
    rise = end - start
    sag = bend * h * h
    if 2.0 * fabs(rise) >= sag:
        return start if start < end else end
    return 0.5 * (start + end) - 0.125 * sag - 0.5 * rise * rise / sag


def apart(a_low, a_high, b_low, b_high):
    """The largest difference between a number in [a_low, a_high] and one in [b_low, b_high]."""
    return a_high - b_low if a_high - b_low > b_high - a_low else b_high - a_low


def against_rotation(growth, k, turn_low, turn_high, motion):
    """Bounds on |xi| and |P'' + Omega^2 P| of handle k against a rotation Omega in [turn_low, turn_high]."""
    high = motion[k, RATE_HIGH]
    low = motion[k, RATE_LOW]
    r_low = growth * motion[k, THETA_LOW]
    r_high = growth * motion[k, THETA_HIGH]
    slip = apart(low, high, turn_low * r_low, turn_high * r_high) + turn_high * growth
    pull = apart(
        low * low * motion[k, CURVATURE_LOW] / growth,
        high * high * motion[k, CURVATURE_HIGH] / growth,
        turn_low * turn_low * r_low,
        turn_high * turn_high * r_high,
    )
    return slip, pull + motion[k, RATE_RATE] + turn_high * turn_high * growth


def axis_bend(growth, i, j, distance, sizes, motion):
    """Bound K on the second derivative of a gap along an axis fixed in bench i to the corners of bench j [1/m]."""
    low = motion[i, TURN_LOW]
    high = motion[i, TURN]
    plain = plain_bend(i, j, distance, sizes, motion)
    slips = 0.0
    pulls = 0.0
    if motion[j, RATE_LOW] <= 0.0 or motion[i, RATE_LOW] <= 0.0 or low <= 0.0 or motion[j, TURN_LOW] <= 0.0:
        return plain
    for side in range(2):
        slip, pull = against_rotation(growth, i + side, low, high, motion)
        slips += 0.5 * slip
        pulls += 0.5 * pull
        slip, pull = against_rotation(growth, j + side, low, high, motion)
        slips += 0.5 * slip
        pulls += 0.5 * pull
    slips += apart(low, high, motion[j, TURN_LOW], motion[j, TURN]) * sizes[j, RADIUS]
    pulls += motion[j, TURN_RATE] * sizes[j, RADIUS]
    pulls += sizes[j, RADIUS] * apart(
        low * low, high * high, motion[j, TURN_LOW] * motion[j, TURN_LOW], motion[j, TURN] * motion[j, TURN]
    )
    pulls += 2.0 * high * slips + motion[i, TURN_RATE] * (distance + sizes[j, RADIUS])
    return pulls if pulls < plain else plain


def plain_bend(i, j, distance, sizes, motion):
    """axis_bend() in the resting frame [1/m]."""
    return (
        motion[j, CORNER_PULL]
        + motion[i, CENTRE_PULL]
        + 2.0 * motion[i, TURN] * (motion[j, CORNER_SPEED] + motion[i, CENTRE_SPEED])
        + motion[i, TURN_PULL] * (distance + sizes[j, RADIUS])
    )


def centres_apart(interval, a, b):
    """Upper bound of the distance between the centres of benches a and b during an interval [m]."""
    dx = interval.before[b, MX] - interval.before[a, MX]
    dy = interval.before[b, MY] - interval.before[a, MY]
    moved = (interval.motion[a, CENTRE_SPEED] + interval.motion[b, CENTRE_SPEED]) * interval.h
    return sqrt(dx * dx + dy * dy) + moved


def bend_along(scene, interval, i, j, distance):
    """axis_bend() over an interval [1/m]."""
    return axis_bend(scene.curve.growth, i, j, distance, scene.sizes, interval.motion)


def pair_bends(scene, interval, place, h, a, b):
    """Bounds on the second derivative of gaps of two benches while the head travels h from a place [1/m].

    returns: along axes fixed in bench a, and in bench b; FREE where no bound is known
    """
    if not interval.lay_out(place, h, b + 1):
        return FREE, FREE
    distance = centres_apart(interval, a, b)
    return bend_along(scene, interval, a, b, distance), bend_along(scene, interval, b, a, distance)


# Within the margin for certain. Over an interval too short to matter, so that both benches hardly move:
#   any points of the two approach or part by no more than their speeds together, so no separation, nor depth, exceeds
#   the mean of those at both ends by more than half of that times h;
#   the coordinates p, q of a corner X of j in the frame of i are gaps along axes fixed in i, so |p| stays below the
#   larger of its ends plus K h^2 / 8. Where both stay within i's half length and width X lies in i all along; else X is
#   no further from i than the two excesses make it.
# The first serves benches that overlap deep or without a corner, the second ones that touch, slowly too.


def corner_most(i, j, bend, h, sizes, before, after):
    """Upper bound of the distance of a corner of bench j from bench i over an interval; 0 or less: inside [m]."""
    best = FREE
    for corner in range(4):
        length = sizes[j, HALF_LENGTH] if corner < 2 else -sizes[j, HALF_LENGTH]
        width = sizes[j, HALF_WIDTH] if corner % 2 == 0 else -sizes[j, HALF_WIDTH]
        p, q = corner_in(i, j, length, width, before)
        p_end, q_end = corner_in(i, j, length, width, after)
        p = max(fabs(p), fabs(p_end)) + 0.125 * bend * h * h - sizes[i, HALF_LENGTH]
        q = max(fabs(q), fabs(q_end)) + 0.125 * bend * h * h - sizes[i, HALF_WIDTH]
        p_end = max(p, 0.0)
        q_end = max(q, 0.0)
        best = min(best, max(p, q) if p <= 0.0 and q <= 0.0 else sqrt(p_end * p_end + q_end * q_end))
    return best


def corner_in(i, j, length, width, chain):
    """A corner of bench j, given along and left of its centre, in the frame of bench i [m]."""
    x = chain[j, MX] - chain[i, MX] + length * chain[j, UX] - width * chain[j, UY]
    y = chain[j, MY] - chain[i, MY] + length * chain[j, UY] + width * chain[j, UX]
    return x * chain[i, UX] + y * chain[i, UY], y * chain[i, UX] - x * chain[i, UY]


def pair_most(scene, interval, place, h, a, b):
    """Benches a and b stay within any margin >= 0 of at least this while the head travels h from a place [m].

    interval: scratch; b: a bench or an edge at rest; FREE where no bound is known
    """
    if not interval.lay_out(place, h, last_handle(scene, a, b)):
        return FREE
    distance = centres_apart(interval, a, b)
    row_separation(a, b, scene.sizes, interval.before, scene.met)
    most = scene.met.separation + (interval.motion[a, CORNER_SPEED] + interval.motion[b, CORNER_SPEED]) * h
    row_separation(a, b, scene.sizes, interval.after, scene.met)
    most = 0.5 * (most + scene.met.separation)
    bend = bend_along(scene, interval, a, b, distance)
    most = min(most, corner_most(a, b, bend, h, scene.sizes, interval.before, interval.after))
    bend = bend_along(scene, interval, b, a, distance)
    most = min(most, corner_most(b, a, bend, h, scene.sizes, interval.before, interval.after))
    return most + pair_rounding(a, b, distance, scene.sizes, interval.before, interval.after)


def pair_rounding(i, j, distance, sizes, before, after):
    """G above: computed gaps of two benches at either end are off by no more than this [m]; distance: of centres."""
    around = fabs(before[i, MX]) + fabs(before[i, MY]) + fabs(before[j, MX]) + fabs(before[j, MY]) + distance
    turned = max(before[i, SWAY], after[i, SWAY]) + max(before[j, SWAY], after[j, SWAY])
    return (
        max(before[i, ERROR], after[i, ERROR])
        + max(before[j, ERROR], after[j, ERROR])
        + ULP * around
        + (turned + 40.0 * ULP) * (distance + sizes[i, RADIUS] + sizes[j, RADIUS])
    )


def any_rounding(error, handles, h, margin, rings):
    """pair_rounding() of any pair that is not far apart, or more, from spiral_error() [m]; 0 if that does not serve."""
    if handles * error > SMALL * rings.all_shortest:
        return 0.0
    return 4.0 * error + (4.0 * error / rings.all_shortest + 60.0 * ULP) * (
        4.0 * rings.all_radius + fabs(margin) + 4.0 * h
    )


def axis_least(scene, interval, i, j, after_decides, bend):
    """Proven least gap over the interval along the face normal of i that is best at one of its ends [m]."""
    if after_decides:
        gap, along, left = best_axis(i, j, scene.sizes, interval.after)
        return least_between(gap_along(i, j, along, left, scene.sizes, interval.before), gap, bend, interval.h)
    gap, along, left = best_axis(i, j, scene.sizes, interval.before)
    return least_between(gap, gap_along(i, j, along, left, scene.sizes, interval.after), bend, interval.h)


def pair_least(scene, interval, i, j, enough, distance):
    """A proven lower bound of the separation of benches i and j over the interval, but for rounding [m].

    Tries axes until one exceeds what is enough, the margin and more. distance: no further are their centres apart [m]
    returns: the bound, and the bound K of the last axis [1/m]
    """
    bend = bend_along(scene, interval, j, i, distance)
    best = axis_least(scene, interval, j, i, True, bend)
    if best > enough:
        return best, bend
    best = max(best, axis_least(scene, interval, j, i, False, bend))
    if best > enough:
        return best, bend
    bend = bend_along(scene, interval, i, j, distance)
    best = max(best, axis_least(scene, interval, i, j, True, bend))
    if best > enough:
        return best, bend
    best = max(best, axis_least(scene, interval, i, j, False, bend))
    if best > enough or scene.margin <= 0.0:
        return best, bend
    along, left = corner_axis(scene, i, j, interval.after)
    start = gap_along(i, j, along, left, scene.sizes, interval.before)
    end = gap_along(i, j, along, left, scene.sizes, interval.after)
    return max(best, least_between(start, end, bend, interval.h)), bend


def corner_axis(scene, i, j, chain):
    """Where two corners are nearest each other, the direction between them, in the frame of bench i."""
    row_separation(i, j, scene.sizes, chain, scene.met)
    return (
        scene.met.nx * chain[i, UX] + scene.met.ny * chain[i, UY],
        scene.met.ny * chain[i, UX] - scene.met.nx * chain[i, UY],
    )


# Input:  an interval whose chains are laid out, and how many benches lead pairs (`active`).
# State:  the least bound so far with its K and its pair; `room`, the widest interval that the pairs so far would allow.
# Output: the record Nearest.
#
# Each pair that is near enough gets a bound of its own from pair_least(), less what its gaps may be off by: roughly for
# all, where no handle had to be followed, or pair by pair (proven_gap()). Those too far apart at the beginning to come
# within the margin are passed over, and on a spiral all further ones once one is out of reach of bench i, as handles
# stand in order.


def interval_least(scene, interval, active):
    """Proven least separation over an interval of all pairs led by the first `active` benches; -FREE: too wide."""
    before: cython.double[:, ::1] = interval.before
    motion: cython.double[:, ::1] = interval.motion
    sizes: cython.double[:, ::1] = scene.sizes
    best = FREE
    bend = 0.0
    room = FREE
    tried = 0
    a = 0
    b = 0
    if not interval.bound(False):
        return Nearest(-FREE, 0.0, 0, 0, 0.0, 0.0, 0)
    rounding = interval_rounding(scene, interval)
    # of centres; an edge at rest that is near has coordinates hardly larger than the bench, whose rounding ERROR covers
    reach = scene.margin * (1.0 + 1e-12) + 16.0 * rounding.point
    if not stays_beyond(scene, interval, active, rounding.point):
        return Nearest(-FREE, 0.0, 0, 0, 0.0, 0.0, 0)
    for i in range(active):
        if scene.halt.stopped:
            return Nearest(-FREE, 0.0, 0, 0, 0.0, 0.0, 0)
        far = reach_of(scene, interval, i, rounding.point)
        first = i + 2
        end = interval.handles
        if scene.against == EDGES:  # after the last handle's row, which holds no bench
            first = interval.handles + 1
            end = first + scene.edges
        for j in range(first, end):
            if far < FREE and innermost(scene, interval, j, motion[j, HANDLE_SPEED]) - rounding.point > far:
                break
            dx = before[j, MX] - before[i, MX]
            dy = before[j, MY] - before[i, MY]
            distance = (motion[i, CENTRE_SPEED] + motion[j, CENTRE_SPEED]) * interval.h
            square = dx * dx + dy * dy
            width = sizes[i, RADIUS] + sizes[j, RADIUS] + reach + distance
            if square > width * width or (i == scene.left_out and j == scene.left_out_too):
                continue
            tried += 1
            least, k = proven_gap(scene, interval, i, j, distance + sqrt(square), rounding.gap)
            if least != least:  # no number is no bound
                return Nearest(-FREE, 0.0, 0, 0, 0.0, 0.0, 0)
            width = 8.0 * (least - scene.margin) / k + interval.h * interval.h
            room = min(room, sqrt(width) if width > 0.0 else 0.0)
            if least < best:
                best = least
                bend = k
                a = i
                b = j
    return Nearest(best, bend, a, b, room, rounding.point, tried)


def interval_rounding(scene, interval):
    """Largest errors of points and gaps of a bounded interval."""
    if scene.curve.kind == ON_SPIRAL and interval.motion[interval.handles, RATE_LOW] > 0.0:
        error = spiral_error(scene.curve.growth, interval.handles, scene.rings.all_chord, interval.before)
        end = spiral_error(scene.curve.growth, interval.handles, scene.rings.all_chord, interval.after)
        error = max(error, end)
        gap = any_rounding(error, interval.handles, interval.h, scene.margin, scene.rings)
        if gap > 0.0:
            return Rounding(error, gap)
    interval.round()
    error = max(interval.before[interval.handles - 1, ERROR], interval.after[interval.handles - 1, ERROR])
    return Rounding(error, 0.0)


def proven_gap(scene, interval, i, j, distance, rounding):
    """pair_least(), less what it may be off by. rounding: of any gap, 0 where only the sums of this pair serve [m]"""
    allowed = rounding
    if rounding <= 0.0:
        allowed = pair_rounding(i, j, distance, scene.sizes, interval.before, interval.after)
    least, bend = pair_least(scene, interval, i, j, scene.margin + allowed, distance)
    if rounding > 0.0:
        if not (scene.margin < least <= scene.margin + rounding):
            return least - rounding, bend
        interval.round()
        allowed = pair_rounding(i, j, distance, scene.sizes, interval.before, interval.after)
    return least - allowed, bend


def innermost(scene, interval, k, rate):
    """Lower bound of the radius of handle k of a spiral, no faster than the rate, during an interval [m]."""
    inner = scene.curve.growth * min(interval.before[k, THETA], interval.after[k, THETA])
    return inner - drift(rate, interval.h, scene.curve.growth, inner)


def reach_of(scene, interval, i, error):
    """Benches led from beyond this radius of a spiral stay clear of bench i during an interval [m]; FREE on a route."""
    if scene.curve.kind == ON_ROUTE:
        return FREE
    growth = scene.curve.growth
    rate = interval.motion[i, HANDLE_SPEED]
    far = growth * max(interval.before[i + 1, THETA], interval.after[i + 1, THETA])
    far = far + drift(rate, interval.h, growth, far) + error
    low = innermost(scene, interval, i, rate)
    return radius_beyond(growth, leaders_reach(growth, low, far, scene.rings) + scene.margin, scene.rings)


def stays_beyond(scene, interval, leaders, error):
    """Do the benches that were not laid out stay beyond the reach of those that lead pairs, during an interval?"""
    if interval.handles == scene.benches:
        return True
    if scene.curve.kind == ON_ROUTE:
        return coil_stays_beyond(scene, interval, leaders, error)
    growth = scene.curve.growth
    high = growth * max(interval.before[leaders, THETA], interval.after[leaders, THETA])
    high += drift(interval.motion[leaders - 1, HANDLE_SPEED], interval.h, growth, high) + error
    low = growth * min(interval.before[0, THETA], interval.after[0, THETA])
    high = leaders_reach(growth, low, high, scene.rings)
    low = growth * min(interval.before[interval.handles, THETA], interval.after[interval.handles, THETA]) - error
    low -= drift(interval.motion[interval.handles - 1, HANDLE_SPEED], interval.h, growth, low)
    return low >= radius_beyond(growth, high + scene.margin, scene.rings)


def coil_stays_beyond(scene, interval, leaders, error):
    """stays_beyond() on a route that begins with a coil.

    A leader's centre is at most h / 2 of travel from where it stands at one of the ends. The last handle goes inwards,
    so it is nearest to the centre at the far end. error: of points of the chains [m], which has u (|x| + |y|) and more
    in it (route.py), so that 8 times that covers the roundings of radii too
    """
    reach = 0.0
    for i in range(leaders):
        far = coil_radius(scene.curve.pieces, interval.before[i, MX], interval.before[i, MY])
        far = max(far, coil_radius(scene.curve.pieces, interval.after[i, MX], interval.after[i, MY]))
        far += scene.sizes[i, RADIUS] + 0.5 * interval.h * interval.motion[i, CENTRE_SPEED]
        if far > reach:
            reach = far
    reach = (reach + scene.margin) * (1.0 + RING_ROUNDING) + 8.0 * error
    reach = radius_beyond(scene.curve.pieces[0, COIL_GROWTH], reach, scene.rings) + 8.0 * error
    x = interval.after[interval.handles, PX]
    y = interval.after[interval.handles, PY]
    return (
        stands_first(scene.curve.pieces, interval.handles, interval.after)
        and coil_radius(scene.curve.pieces, x, y) >= reach
    )


# What a strip of pitches needs of its pairs, see strips.py: shift_bounds() adds up terms >= 0, at most 60 roundings a
# bench, which this part of the strip's width makes up for [1].
STRIP_ROUNDING = 1e-9


def band_along(scene, band, i, j, along, left, bends):
    """Proven least gap along an axis of bench i over a band [m]."""
    start = gap_along(i, j, along, left, scene.sizes, band.low.before)
    end = gap_along(i, j, along, left, scene.sizes, band.low.after)
    low = least_between(start, end, bends.low, band.low.h)
    low -= band.slack * (fabs(end - start) / band.low.h + bends.low * band.low.h)
    start = gap_along(i, j, along, left, scene.sizes, band.high.before)
    end = gap_along(i, j, along, left, scene.sizes, band.high.after)
    high = least_between(start, end, bends.high, band.high.h)
    high -= band.slack * (fabs(end - start) / band.high.h + bends.high * band.high.h)
    return least_between(low, high, bends.across, band.width)


def band_bends(scene, band, i, j, distance):
    """Bounds on the second derivatives of a gap along an axis of bench i over a band."""
    turn = band.shifts[i, SHIFT_TURN]
    return Bends(
        axis_bend(scene.curve.growth, i, j, distance, scene.sizes, band.low.motion),
        axis_bend(band.high.scene.curve.growth, i, j, distance, scene.sizes, band.high.motion),
        band.shifts[i, SHIFT_PULL]
        + band.shifts[j, SHIFT_PULL]
        + 2.0 * turn * (band.shifts[i, SHIFT_CORNER] + band.shifts[j, SHIFT_CORNER])
        + turn * turn * (distance + scene.sizes[i, RADIUS] + scene.sizes[j, RADIUS]),
    )


def band_pair(scene, band, i, j, enough, distance):
    """A proven lower bound of the separation of benches i and j over a band, but for rounding [m].

    enough, distance: as for pair_least(); returns: the bound, and the bend along the path of the last axis tried [1/m]
    """
    best = -FREE
    bends = band_bends(scene, band, j, i, distance)
    for trial in range(4):
        a = j if trial < 2 else i
        b = i if trial < 2 else j
        if trial == 2:
            bends = band_bends(scene, band, i, j, distance)
        if trial % 2 == 0:
            _, along, left = best_axis(a, b, scene.sizes, band.low.after)
        else:
            _, along, left = best_axis(a, b, scene.sizes, band.high.after)
        least = band_along(scene, band, a, b, along, left, bends)
        if least > best:
            best = least
        if best > enough:
            return best, bends.low
    if scene.margin <= 0.0:
        return best, bends.low
    along, left = corner_axis(scene, i, j, band.low.after)
    least = band_along(scene, band, i, j, along, left, bends)
    return (least if least > best else best), bends.low


def band_rounding(scene, band):
    """interval_rounding() of a band."""
    growth = scene.curve.growth
    growth_high = band.high.scene.curve.growth
    handles = band.low.handles
    if band.low.motion[handles, RATE_LOW] > 0.0 and band.high.motion[handles, RATE_LOW] > 0.0:
        error = spiral_error(growth, handles, scene.rings.all_chord, band.low.after)
        error = max(error, spiral_error(growth_high, handles, scene.rings.all_chord, band.high.after))
        error = max(error, spiral_error(growth_high, handles, scene.rings.all_chord, band.high.before))
        gap = any_rounding(error, handles, max(band.low.h, band.high.h), scene.margin, scene.rings)
        if gap > 0.0:
            return Rounding(error, gap)
    band.low.round()
    band.high.round()
    error = max(band.low.before[handles - 1, ERROR], band.low.after[handles - 1, ERROR])
    error = max(error, max(band.high.before[handles - 1, ERROR], band.high.after[handles - 1, ERROR]))
    return Rounding(error, 0.0)


def band_pair_rounding(scene, band, i, j, distance):
    """pair_rounding() over a band [m]."""
    return max(
        pair_rounding(i, j, distance, scene.sizes, band.low.before, band.low.after),
        pair_rounding(i, j, distance, scene.sizes, band.high.before, band.high.after),
    )


def proven_band_gap(scene, band, i, j, distance, rounding):
    """proven_gap() over a band."""
    allowed = rounding if rounding > 0.0 else band_pair_rounding(scene, band, i, j, distance)
    least, bend = band_pair(scene, band, i, j, scene.margin + allowed, distance)
    if rounding > 0.0:
        if not (scene.margin < least <= scene.margin + rounding):
            return least - rounding, bend
        band.low.round()
        band.high.round()
        allowed = band_pair_rounding(scene, band, i, j, distance)
    return least - allowed, bend


def band_least(scene, band, leaders):
    """interval_least() over a band, of pairs led by the first `leaders` benches."""
    best = FREE
    bend = 0.0
    room = FREE
    tried = 0
    a = 0
    b = 0
    growth = scene.curve.growth
    growth_high = band.high.scene.curve.growth
    rounding = band_rounding(scene, band)
    error = rounding.point
    if error > CLEAR_SPARE * growth * band.low.after[leaders, THETA]:  # what a strip lays the chains out further by
        return Nearest(-FREE, 0.0, 0, 0, 0.0, 0.0, 0)
    for i in range(leaders):
        if scene.halt.stopped:
            return Nearest(-FREE, 0.0, 0, 0, 0.0, 0.0, 0)
        beyond = growth_high * band.high.before[i + 1, THETA]
        beyond = leaders_reach(growth_high, growth * band.low.after[i, THETA], beyond, scene.rings)
        beyond = radius_beyond(growth_high, beyond + 2.0 * error + scene.margin, scene.rings) + error
        for j in range(i + 2, band.low.handles):
            if growth * band.low.after[j, THETA] > beyond:
                break  # handles stand in order, so all further ones lie outside too
            dx = band.low.after[j, MX] - band.low.after[i, MX]
            dy = band.low.after[j, MY] - band.low.after[i, MY]
            distance = sqrt(dx * dx + dy * dy)
            slack = (band.low.motion[i, CENTRE_SPEED] + band.low.motion[j, CENTRE_SPEED]) * band.low.h
            slack += (
                (band.shifts[i, SHIFT_CENTRE] + band.shifts[j, SHIFT_CENTRE])
                * (growth_high - growth)
                * (1.0 + STRIP_ROUNDING)
            )
            slack += 16.0 * error
            if distance - slack > (scene.sizes[i, RADIUS] + scene.sizes[j, RADIUS] + scene.margin) * (1.0 + 1e-12):
                continue  # far apart
            tried += 1
            least, k = proven_band_gap(scene, band, i, j, distance + slack, rounding.gap)
            if least != least:
                return Nearest(-FREE, 0.0, 0, 0, 0.0, 0.0, 0)
            if least < best:
                best = least
                bend = k
                a = i
                b = j
            width = 8.0 * (least - scene.margin) / k + band.low.h * band.low.h
            room = min(room, sqrt(width) if width > 0.0 else 0.0)
    return Nearest(best, bend, a, b, room, error, tried)
