"""Certified motion: how near two benches come at most over an interval of head travel."""

import cython
from cython.cimports.libc.math import fabs, sqrt

if not cython.compiled:  # for the compiler the same stands in the .pxd
    from core.kernels.bounds import motion_bounds, route_bounds
    from core.kernels.chain import chain_rounding, place_chain
    from core.kernels.constants import *
    from core.kernels.rectangles import pair_separation
    from core.kernels.rings import drift, leaders_reach, radius_beyond, stays_beyond
    from core.kernels.spiral import spiral_error, spiral_rounding

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


def row_separation(i, j, sizes, chain, out):
    """pair_separation() of benches i and j of a chain."""
    pair_separation(
        chain[i, MX], chain[i, MY], chain[i, UX], chain[i, UY], sizes[i, HALF_LENGTH], sizes[i, HALF_WIDTH],
        chain[j, MX], chain[j, MY], chain[j, UX], chain[j, UY], sizes[j, HALF_LENGTH], sizes[j, HALF_WIDTH],
        out,
    )  # fmt: skip


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


def lay_out(growth, pieces, place, h, last, sizes, before, after, motion):
    """The chains up to handle `last` with the head at a place and h further on, and bounds on the motion between them.

    False where no bound is known
    """
    if place_chain(growth, pieces, place, last, sizes, before) < 0:
        return False
    if place_chain(growth, pieces, place - h, last, sizes, after) < 0:
        return False
    chain_rounding(growth, pieces, last, sizes, before)
    chain_rounding(growth, pieces, last, sizes, after)
    if pieces.shape[0] > 0:
        return route_bounds(pieces, h, last, sizes, before, after, False, motion)
    return motion_bounds(growth, h, last, sizes, before, after, motion)


def pair_bends(growth, pieces, place, h, a, b, sizes, rows, motion, out):
    """Bounds on the second derivative of gaps of two benches while the head travels h from a place [1/m].

    out: (2,) along axes fixed in bench a, and in bench b; False where no bound is known
    """
    before: cython.double[:, ::1] = rows[0]
    after: cython.double[:, ::1] = rows[1]
    if not lay_out(growth, pieces, place, h, b + 1, sizes, before, after, motion):
        return False
    dx = before[b, MX] - before[a, MX]
    dy = before[b, MY] - before[a, MY]
    dx = sqrt(dx * dx + dy * dy) + (motion[a, CENTRE_SPEED] + motion[b, CENTRE_SPEED]) * h
    out[0] = axis_bend(growth, a, b, dx, sizes, motion)
    out[1] = axis_bend(growth, b, a, dx, sizes, motion)
    return True


# Within the margin for certain. Over an interval too short to matter, so that both benches hardly move:
#   any points of the two approach or part by no more than their speeds together, so no separation, nor depth, exceeds
#   the mean of those at both ends by more than half of that times h;
#   the coordinates p, q of a corner X of j in the frame of i are gaps along axes fixed in i, so |p| stays below the
#   larger of its ends plus K h^2 / 8. Where both stay within i's half length and width X lies in i all along; else X is
#   no further from i than the two excesses make it.
# The first serves benches that overlap deep or without a corner, the second ones that touch, slowly too.


def corner_most(i, j, bend, h, sizes, before, after):
    """No more than this lies between bench i and a corner of bench j over an interval; 0 or less: inside [m]."""
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


def pair_most(growth, pieces, place, h, a, b, benches, sizes, before, after, motion, out):
    """Where this is at most a margin >= 0, benches a and b stay within it while the head travels h from a place [m].

    b: beyond `benches` an edge at rest; before, after: scratch rows; out: (8,) scratch; FREE where no bound is known
    """
    last = b + 1 if b < benches else a + 1
    if not lay_out(growth, pieces, place, h, last, sizes, before, after, motion):
        return FREE
    dx = before[b, MX] - before[a, MX]
    dy = before[b, MY] - before[a, MY]
    dx = sqrt(dx * dx + dy * dy) + (motion[a, CENTRE_SPEED] + motion[b, CENTRE_SPEED]) * h
    row_separation(a, b, sizes, before, out)
    most = out[0] + (motion[a, CORNER_SPEED] + motion[b, CORNER_SPEED]) * h
    row_separation(a, b, sizes, after, out)
    most = 0.5 * (most + out[0])
    most = min(most, corner_most(a, b, axis_bend(growth, a, b, dx, sizes, motion), h, sizes, before, after))
    most = min(most, corner_most(b, a, axis_bend(growth, b, a, dx, sizes, motion), h, sizes, before, after))
    return most + pair_rounding(a, b, dx, sizes, before, after)


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


def any_rounding(error, handles, h, margin, ring):
    """pair_rounding() of any pair that is not far apart, or more, from spiral_error() [m]; 0 if that does not serve."""
    if handles * error > SMALL * ring[ALL_SHORT]:
        return 0.0
    return 4.0 * error + (4.0 * error / ring[ALL_SHORT] + 60.0 * ULP) * (
        4.0 * ring[ALL_RADIUS] + fabs(margin) + 4.0 * h
    )


def axis_least(i, j, after_decides, bend, h, sizes, before, after):
    """Proven least gap over the interval along the face normal of i that is best at one of its ends [m]."""
    if after_decides:
        gap, along, left = best_axis(i, j, sizes, after)
        return least_between(gap_along(i, j, along, left, sizes, before), gap, bend, h)
    gap, along, left = best_axis(i, j, sizes, before)
    return least_between(gap, gap_along(i, j, along, left, sizes, after), bend, h)


def pair_least(growth, i, j, margin, enough, distance, h, sizes, before, after, motion, out):
    """A proven lower bound of the separation of benches i and j over the interval, but for rounding [m].

    Tries axes until one exceeds what is enough, the margin and more; out[0] is the bound K of the last one.
    distance: no further are their centres apart [m]
    """
    out[0] = axis_bend(growth, j, i, distance, sizes, motion)
    best = axis_least(j, i, True, out[0], h, sizes, before, after)
    if best > enough:
        return best
    least = axis_least(j, i, False, out[0], h, sizes, before, after)
    if least > best:
        best = least
    if best > enough:
        return best
    out[0] = axis_bend(growth, i, j, distance, sizes, motion)
    least = axis_least(i, j, True, out[0], h, sizes, before, after)
    if least > best:
        best = least
    if best > enough:
        return best
    least = axis_least(i, j, False, out[0], h, sizes, before, after)
    if least > best:
        best = least
    if best > enough or margin <= 0.0:
        return best
    # two corners nearest each other: the direction between them, fixed in bench i
    row_separation(i, j, sizes, after, out[1:])
    turn_x = out[6] * after[i, UX] + out[7] * after[i, UY]
    turn_y = out[7] * after[i, UX] - out[6] * after[i, UY]
    least = least_between(
        gap_along(i, j, turn_x, turn_y, sizes, before), gap_along(i, j, turn_x, turn_y, sizes, after), out[0], h
    )
    return least if least > best else best


def interval_least(
    growth, pieces, statics, h, active, handles, benches, margin, ring, sizes, before, after, motion, out
):
    """Proven least separation over an interval of all pairs led by the first `active` benches [m]; -FREE: too wide.

    out: (14,) [0] K of the least pair, [1] and [2] that pair, [3] the widest interval the same pairs would allow [m],
    [4] what points may be off by [m], [9] the pairs tried; the rest is scratch
    """
    edges = statics if statics >= 0 else -statics
    best = FREE
    bend = 0.0
    room = FREE
    tried = 0
    out[9] = 0.0
    a = 0
    b = 0
    if pieces.shape[0] > 0:
        chain_rounding(growth, pieces, handles, sizes, before)
        chain_rounding(growth, pieces, handles, sizes, after)
        if not route_bounds(pieces, h, handles, sizes, before, after, False, motion):
            return -FREE
    elif not motion_bounds(growth, h, handles, sizes, before, after, motion):
        return -FREE
    # What points and gaps may be off by: roughly for all, where no handle had to be followed, or pair by pair.
    error = 0.0
    rounding = 0.0
    if pieces.shape[0] == 0 and motion[handles, RATE_LOW] > 0.0:
        error = spiral_error(growth, handles, ring[ALL_CHORD], before)
        error = max(error, spiral_error(growth, handles, ring[ALL_CHORD], after))
        rounding = any_rounding(error, handles, h, margin, ring)
    roughly = rounding > 0.0
    filled = not roughly
    if filled:
        chain_rounding(growth, pieces, handles, sizes, before)
        chain_rounding(growth, pieces, handles, sizes, after)
        error = max(before[handles - 1, ERROR], after[handles - 1, ERROR])
    # of centres; an edge at rest that is near has coordinates hardly larger than the bench, whose rounding ERROR covers
    reach = margin * (1.0 + 1e-12) + 16.0 * error
    if handles < benches and pieces.shape[0] > 0:
        if not stays_beyond(pieces, active, handles, h, margin, error, ring, sizes, before, after, motion):
            return -FREE
    elif handles < benches:  # those left out must stay outside the reach of the leaders
        high = before[active, THETA] if before[active, THETA] > after[active, THETA] else after[active, THETA]
        high *= growth
        high += drift(motion[active - 1, HANDLE_SPEED], h, growth, high) + error
        low = before[0, THETA] if before[0, THETA] < after[0, THETA] else after[0, THETA]
        high = leaders_reach(growth, growth * low, high, ring)
        low = before[handles, THETA] if before[handles, THETA] < after[handles, THETA] else after[handles, THETA]
        low = growth * low - error
        if low - drift(motion[handles - 1, HANDLE_SPEED], h, growth, low) < radius_beyond(growth, high + margin, ring):
            return -FREE
    for i in range(active):
        far = FREE
        if pieces.shape[0] == 0:
            far = before[i + 1, THETA] if before[i + 1, THETA] > after[i + 1, THETA] else after[i + 1, THETA]
            far = growth * far + drift(motion[i, HANDLE_SPEED], h, growth, growth * far) + error
            low = before[i, THETA] if before[i, THETA] < after[i, THETA] else after[i, THETA]
            low = growth * low - drift(motion[i, HANDLE_SPEED], h, growth, growth * low)
            far = radius_beyond(growth, leaders_reach(growth, low, far, ring) + margin, ring)
        for j in range(i + 2 if statics >= 0 else handles + 1, handles + 1 + edges):
            if j == handles:  # the last handle's row holds no bench; after it stand the edges at rest
                continue
            if far < FREE:
                low = before[j, THETA] if before[j, THETA] < after[j, THETA] else after[j, THETA]
                if growth * low - drift(motion[j, HANDLE_SPEED], h, growth, growth * low) - error > far:
                    break  # handles stand in order, so all further ones lie outside too
            dx = before[j, MX] - before[i, MX]
            dy = before[j, MY] - before[i, MY]
            distance = (motion[i, CENTRE_SPEED] + motion[j, CENTRE_SPEED]) * h
            square = dx * dx + dy * dy
            width = sizes[i, RADIUS] + sizes[j, RADIUS] + reach + distance
            if square > width * width or (i == ring[LEFT_OUT] and j == ring[LEFT_OUT_TOO]):
                continue
            tried += 1
            distance += sqrt(square)
            least = rounding if roughly else pair_rounding(i, j, distance, sizes, before, after)
            least = pair_least(growth, i, j, margin, margin + least, distance, h, sizes, before, after, motion, out)
            if roughly and not (margin < least <= margin + rounding):
                least -= rounding
            else:
                if not filled:
                    chain_rounding(growth, pieces, handles, sizes, before)
                    chain_rounding(growth, pieces, handles, sizes, after)
                    filled = True
                least -= pair_rounding(i, j, distance, sizes, before, after)
            if least != least:  # no number is no bound
                return -FREE
            width = 8.0 * (least - margin) / out[0] + h * h
            width = sqrt(width) if width > 0.0 else 0.0
            if width < room:
                room = width
            if least < best:
                best = least
                bend = out[0]
                a = i
                b = j
    out[0] = bend
    out[1] = a
    out[2] = b
    out[3] = room
    out[4] = error
    out[9] = tried
    return best


# What a strip of pitches needs of its pairs, see strips.py: shift_bounds() adds up terms >= 0, at most 60 roundings a
# bench, which this part of the strip's width makes up for [1].
STRIP_ROUNDING = 1e-9


def strip_along(i, j, along, left, bends, widths, sizes, before, after, before_high, after_high):
    """Proven least gap along an axis of bench i over a rectangle of (r_0, b) [m]."""
    start = gap_along(i, j, along, left, sizes, before)
    end = gap_along(i, j, along, left, sizes, after)
    low = least_between(start, end, bends[0], widths[0])
    low -= widths[3] * (fabs(end - start) / widths[0] + bends[0] * widths[0])
    start = gap_along(i, j, along, left, sizes, before_high)
    end = gap_along(i, j, along, left, sizes, after_high)
    high = least_between(start, end, bends[1], widths[1])
    high -= widths[3] * (fabs(end - start) / widths[1] + bends[1] * widths[1])
    return least_between(low, high, bends[2], widths[2])


def strip_pair(
    low, high, i, j, distance, margin, enough, h_low, h_high, sizes, before, after, before_high, after_high, motion,
    motion_high, shifts, out
):  # fmt: skip
    """A proven lower bound of the separation of benches i and j over a rectangle of (r_0, b), but for rounding [m].

    enough: as for pair_least(); distance: no further are their centres apart [m]; out[0]: the bend along the path of
    the last axis tried
    """
    best = -FREE
    bends: tuple[cython.double, cython.double, cython.double]
    widths: tuple[cython.double, cython.double, cython.double, cython.double] = (
        h_low,
        h_high,
        (high - low) * (1.0 + STRIP_ROUNDING),
        4.0 * ULP * low * before[0, THETA] * before[0, THETA],
    )
    for trial in range(4):
        a = j if trial < 2 else i
        b = i if trial < 2 else j
        least = shifts[a, SHIFT_TURN]
        least = (
            shifts[a, SHIFT_PULL]
            + shifts[b, SHIFT_PULL]
            + 2.0 * least * (shifts[a, SHIFT_CORNER] + shifts[b, SHIFT_CORNER])
            + least * least * (distance + sizes[a, RADIUS] + sizes[b, RADIUS])
        )
        bends = (
            axis_bend(low, a, b, distance, sizes, motion),
            axis_bend(high, a, b, distance, sizes, motion_high),
            least,
        )
        out[0] = bends[0]
        least, along, left = best_axis(a, b, sizes, after if trial % 2 == 0 else after_high)
        least = strip_along(a, b, along, left, bends, widths, sizes, before, after, before_high, after_high)
        if least > best:
            best = least
        if best > enough:
            return best
    if margin <= 0.0:
        return best
    # two corners nearest each other: the direction between them, fixed in bench i
    row_separation(i, j, sizes, after, out[1:])
    along = out[6] * after[i, UX] + out[7] * after[i, UY]
    left = out[7] * after[i, UX] - out[6] * after[i, UY]
    least = strip_along(i, j, along, left, bends, widths, sizes, before, after, before_high, after_high)
    return least if least > best else best


def strip_rounding(low, high, handles, sizes, before, after, before_high, after_high):
    """chain_rounding() of the four chains of a rectangle."""
    spiral_rounding(low, handles, sizes, before)
    spiral_rounding(low, handles, sizes, after)
    spiral_rounding(high, handles, sizes, before_high)
    spiral_rounding(high, handles, sizes, after_high)


def strip_least(
    low, high, leaders, handles, margin, h_low, h_high, ring, sizes, before, after, before_high, after_high, motion,
    motion_high, shifts, out
):  # fmt: skip
    """interval_least() over a rectangle of (r_0, b), of pairs led by the first `leaders` benches.

    out: [1] to [3], [9]
    """
    error = 0.0
    rounding = 0.0
    if motion[handles, RATE_LOW] > 0.0 and motion_high[handles, RATE_LOW] > 0.0:
        error = max(
            spiral_error(low, handles, ring[ALL_CHORD], after), spiral_error(high, handles, ring[ALL_CHORD], after_high)
        )
        error = max(error, spiral_error(high, handles, ring[ALL_CHORD], before_high))
        rounding = any_rounding(error, handles, max(h_low, h_high), margin, ring)
    roughly = rounding > 0.0
    filled = not roughly
    if filled:
        strip_rounding(low, high, handles, sizes, before, after, before_high, after_high)
        error = max(before[handles - 1, ERROR], after[handles - 1, ERROR])
        error = max(error, max(before_high[handles - 1, ERROR], after_high[handles - 1, ERROR]))
    if error > CLEAR_SPARE * low * after[leaders, THETA]:  # what strip() lays the chains out further by
        return -FREE
    best = FREE
    room = FREE
    tried = 0
    out[9] = 0.0
    a = 0
    b = 0
    for i in range(leaders):
        beyond = leaders_reach(high, low * after[i, THETA], high * before_high[i + 1, THETA], ring)
        beyond = radius_beyond(high, beyond + 2.0 * error + margin, ring) + error
        for j in range(i + 2, handles):
            if low * after[j, THETA] > beyond:
                break  # handles stand in order, so all further ones lie outside too
            dx = after[j, MX] - after[i, MX]
            dy = after[j, MY] - after[i, MY]
            distance = sqrt(dx * dx + dy * dy)
            slack = (motion[i, CENTRE_SPEED] + motion[j, CENTRE_SPEED]) * h_low
            slack += (shifts[i, SHIFT_CENTRE] + shifts[j, SHIFT_CENTRE]) * (high - low) * (1.0 + STRIP_ROUNDING)
            slack += 16.0 * error
            if distance - slack > (sizes[i, RADIUS] + sizes[j, RADIUS] + margin) * (1.0 + 1e-12):
                continue  # far apart
            tried += 1
            distance += slack
            least = rounding
            if not roughly:
                least = max(
                    pair_rounding(i, j, distance, sizes, before, after),
                    pair_rounding(i, j, distance, sizes, before_high, after_high),
                )
            least = strip_pair(
                low, high, i, j, distance, margin, margin + least, h_low, h_high, sizes, before, after, before_high,
                after_high, motion, motion_high, shifts, out,
            )  # fmt: skip
            if roughly and not (margin < least <= margin + rounding):
                least -= rounding
            else:
                if not filled:
                    strip_rounding(low, high, handles, sizes, before, after, before_high, after_high)
                    filled = True
                least -= max(
                    pair_rounding(i, j, distance, sizes, before, after),
                    pair_rounding(i, j, distance, sizes, before_high, after_high),
                )
            if least != least:
                return -FREE
            if least < best:
                best = least
                a = i
                b = j
            least = 8.0 * (least - margin) / out[0] + h_low * h_low
            least = sqrt(least) if least > 0.0 else 0.0
            if least < room:
                room = least
    out[1] = a
    out[2] = b
    out[3] = room
    out[9] = tried
    return best
