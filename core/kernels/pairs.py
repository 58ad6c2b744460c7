"""Certified motion: lower bounds on the separation of two benches over an interval of head travel."""

import cython
from cython.cimports.libc.math import fabs, sqrt

if not cython.compiled:  # the .pxd imports the same names for the compiler
    from core.kernels.clearance import last_handle, meet
    from core.kernels.constants import *
    from core.kernels.faces import band_hulls, hulls_least, hulls_most
    from core.kernels.gap_curvature import band_between, band_curvatures, centres_apart, curvature_along, least_between

# Rounding. The centre of bench i is the mean of two handles, each good to E_i = ERROR; its direction is good to W_i =
# SWAY. So a gap along an axis fixed in bench i, and the separation of two benches, is good to
#     G = E_i + E_j + u (|M_i| + |M_j| + D) + (W_i + W_j + 40 u) (D + rho_i + rho_j),  D = |M_j - M_i|,
# as each corner of j is within rho_j of M_j, and within D + rho_j of M_i. The last term has room for the operations of
# gap_along(), pair_gap_within() and least_between(), fewer than 32 on lengths up to D + rho_i + rho_j in all, and for a
# corner axis whose length is 1 +- 8 u. A bound over an interval counts as proven only if it exceeds the margin by G.


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
    """The face normal of bench i with the largest gap to bench j, in i's frame; returns gap [m], along, left."""
    dx = chain[j, MX] - chain[i, MX]
    dy = chain[j, MY] - chain[i, MY]
    along = 1.0 if dx * chain[i, UX] + dy * chain[i, UY] > 0.0 else -1.0
    left = 1.0 if dy * chain[i, UX] - dx * chain[i, UY] > 0.0 else -1.0
    lengthwise = gap_along(i, j, along, 0.0, sizes, chain)
    sideways = gap_along(i, j, 0.0, left, sizes, chain)
    if sideways >= lengthwise:
        return sideways, 0.0, left
    return lengthwise, along, 0.0


# Within the margin for certain. The interval is so short that both benches hardly move. Two bounds serve:
#   any two points of the benches approach or part no faster than the sum of their speeds, so no separation or depth
#   exceeds the mean of its values at both ends by more than half of this sum times h;
#   the coordinates p, q of a corner X of j in the frame of i are gaps along axes fixed in i, so |p| stays below the
#   larger of its values at both ends plus K h^2 / 8. If both stay within i's half length and half width, X lies in i
#   throughout; otherwise the two excesses bound its distance from i.
# The first bound serves benches that overlap deeply or without a corner, the second those that just touch, even slowly.


def corner_most(interval, i, j, curvature):
    """Upper bound of the distance of a corner of bench j from bench i over an interval; 0 or less: inside [m]."""
    before: cython.double[:, ::1] = interval.before
    after: cython.double[:, ::1] = interval.after
    sizes: cython.double[:, ::1] = interval.scene.sizes
    h = interval.h
    best = FREE
    for corner in range(4):
        length = sizes[j, HALF_LENGTH] if corner < 2 else -sizes[j, HALF_LENGTH]
        width = sizes[j, HALF_WIDTH] if corner % 2 == 0 else -sizes[j, HALF_WIDTH]
        p, q = corner_in(i, j, length, width, before)
        p_end, q_end = corner_in(i, j, length, width, after)
        along = max(fabs(p), fabs(p_end)) + 0.125 * curvature * h * h - sizes[i, HALF_LENGTH]
        aside = max(fabs(q), fabs(q_end)) + 0.125 * curvature * h * h - sizes[i, HALF_WIDTH]
        excess2 = max(along, 0.0) * max(along, 0.0) + max(aside, 0.0) * max(aside, 0.0)
        best = min(best, max(along, aside) if along <= 0.0 and aside <= 0.0 else sqrt(excess2))
    return best


def corner_in(i, j, length, width, chain):
    """A corner of bench j, given along and left of its centre, in the frame of bench i [m]."""
    x = chain[j, MX] - chain[i, MX] + length * chain[j, UX] - width * chain[j, UY]
    y = chain[j, MY] - chain[i, MY] + length * chain[j, UY] + width * chain[j, UX]
    return x * chain[i, UX] + y * chain[i, UY], y * chain[i, UX] - x * chain[i, UY]


def pair_most(scene, interval, place, h, a, b):
    """Upper bound of the separation of benches a and b while the head travels h from a place [m]; 0 or less: touching.

    interval: scratch; b: a bench or an edge at rest; returns FREE where no bound is known
    """
    if not interval.lay_out(place, h, last_handle(scene, a, b)):
        return FREE
    distance = centres_apart(interval, a, b)
    meet(scene, a, b, interval.before)
    most = interval.motion[a, CORNER_SPEED] + interval.motion[b, CORNER_SPEED]
    if scene.kinds.some:  # the largest gap along an axis that turns with its bench
        most += (interval.motion[a, OMEGA] + interval.motion[b, OMEGA]) * distance
    most = scene.met.separation + most * h
    meet(scene, a, b, interval.after)
    most = 0.5 * (most + scene.met.separation)
    if scene.kinds.some:
        most = min(most, hulls_most(scene, interval, a, b, distance))
        return most + pair_rounding(a, b, distance, scene.sizes, interval.before, interval.after)
    curvature = curvature_along(scene, interval, a, b, distance)
    most = min(most, corner_most(interval, a, b, curvature))
    curvature = curvature_along(scene, interval, b, a, distance)
    most = min(most, corner_most(interval, b, a, curvature))
    return most + pair_rounding(a, b, distance, scene.sizes, interval.before, interval.after)


def pair_rounding(i, j, distance, sizes, before, after):
    """G above: largest error of computed gaps of two benches at either end [m]. distance: of their centres [m]"""
    around = fabs(before[i, MX]) + fabs(before[i, MY]) + fabs(before[j, MX]) + fabs(before[j, MY]) + distance
    turned = max(before[i, SWAY], after[i, SWAY]) + max(before[j, SWAY], after[j, SWAY])
    return (
        max(before[i, ERROR], after[i, ERROR])
        + max(before[j, ERROR], after[j, ERROR])
        + ULP * around
        + (turned + 40.0 * ULP) * (distance + sizes[i, RADIUS] + sizes[j, RADIUS])
    )


def any_rounding(error, handles, h, margin, rings):
    """Upper bound of pair_rounding() for all pairs not far apart, from spiral_error() [m]; FREE: none is known."""
    if handles * error > SMALL * rings.all_shortest:
        return FREE
    return 4.0 * error + (4.0 * error / rings.all_shortest + 60.0 * ULP) * (
        4.0 * rings.all_radius + fabs(margin) + 4.0 * h
    )


def axis_least(scene, interval, i, j, after_decides, curvature):
    """Proven least gap over the interval along the face normal of i that is best at one of its ends [m]."""
    if after_decides:
        gap, along, left = best_axis(i, j, scene.sizes, interval.after)
        return least_between(gap_along(i, j, along, left, scene.sizes, interval.before), gap, curvature, interval.h)
    gap, along, left = best_axis(i, j, scene.sizes, interval.before)
    return least_between(gap, gap_along(i, j, along, left, scene.sizes, interval.after), curvature, interval.h)


# Input:  an interval with bounds on its motion, two of its rows, and a gap that is enough.
# State:  `best`, the largest bound of the axes tried so far.
# Output: this bound, and K of the last axis; for a band the same in band_pair().
def pair_least(scene, interval, i, j, enough, distance):
    """Lower bound of the separation of benches i and j over the interval, without rounding [m].

    Tries axes until the bound of one exceeds `enough`, which is more than the margin.
    distance: upper bound of the distance between their centres [m]; returns: the bound, and K of the last axis [1/m]
    """
    back = curvature_along(scene, interval, j, i, distance)
    best = axis_least(scene, interval, j, i, True, back)
    if best > enough:
        return best, back
    best = max(best, axis_least(scene, interval, j, i, False, back))
    if best > enough:
        return best, back
    curvature = curvature_along(scene, interval, i, j, distance)
    best = max(best, axis_least(scene, interval, i, j, True, curvature))
    if best > enough:
        return best, curvature
    best = max(best, axis_least(scene, interval, i, j, False, curvature))
    if best <= enough and scene.kinds.some:
        return max(best, hulls_least(scene, interval, i, j, enough, curvature, back)), max(curvature, back)
    if best > enough or scene.margin <= 0.0:
        return best, curvature
    along, left = corner_axis(scene, i, j, interval.after)
    start = gap_along(i, j, along, left, scene.sizes, interval.before)
    end = gap_along(i, j, along, left, scene.sizes, interval.after)
    return max(best, least_between(start, end, curvature, interval.h)), curvature


def corner_axis(scene, i, j, chain):
    """Normal of benches i and j in the frame of bench i: the direction between two corners if these are nearest."""
    meet(scene, i, j, chain)
    return (
        scene.met.nx * chain[i, UX] + scene.met.ny * chain[i, UY],
        scene.met.ny * chain[i, UX] - scene.met.nx * chain[i, UY],
    )


def proven_gap(scene, interval, i, j, distance, rounding):
    """pair_least() less its rounding [m]. rounding: a bound for any gap, or FREE if this pair needs its own [m]"""
    allowance = rounding
    if rounding >= FREE:
        allowance = pair_rounding(i, j, distance, scene.sizes, interval.before, interval.after)
    least, curvature = pair_least(scene, interval, i, j, scene.margin + allowance, distance)
    if rounding < FREE:
        if not (scene.margin < least <= scene.margin + rounding):
            return least - rounding, curvature
        interval.round()
        allowance = pair_rounding(i, j, distance, scene.sizes, interval.before, interval.after)
    return least - allowance, curvature


# Pairs over a band of pitches: the largest relative error of shift_bounds(), and the part by which widths are enlarged
# to make up for it and for their own rounding, see band_march.py [1].
BAND_ROUNDING = 1e-9


def band_along(scene, band, i, j, along, left, curvatures):
    """Proven least gap along an axis of bench i over a band [m]."""
    start = gap_along(i, j, along, left, scene.sizes, band.low.before)
    end = gap_along(i, j, along, left, scene.sizes, band.low.after)
    high_start = gap_along(i, j, along, left, scene.sizes, band.high.before)
    high_end = gap_along(i, j, along, left, scene.sizes, band.high.after)
    return band_between(band, start, end, high_start, high_end, curvatures)


def band_pair(scene, band, i, j, enough, distance):
    """Lower bound of the separation of benches i and j over a band, without rounding [m].

    enough, distance: as for pair_least(); returns: the bound, and K along the path of the last axis tried [1/m]
    """
    best = NO_BOUND
    curvatures = band_curvatures(scene, band, j, i, distance)
    for trial in range(4):
        a = j if trial < 2 else i
        b = i if trial < 2 else j
        if trial == 2:
            curvatures = band_curvatures(scene, band, i, j, distance)
        if trial % 2 == 0:
            _, along, left = best_axis(a, b, scene.sizes, band.low.after)
        else:
            _, along, left = best_axis(a, b, scene.sizes, band.high.after)
        least = band_along(scene, band, a, b, along, left, curvatures)
        best = max(best, least)
        if best > enough:
            return best, curvatures.low
    if scene.kinds.some:
        return max(best, band_hulls(scene, band, i, j, enough, distance)), curvatures.low
    if scene.margin <= 0.0:
        return best, curvatures.low
    along, left = corner_axis(scene, i, j, band.low.after)
    least = band_along(scene, band, i, j, along, left, curvatures)
    return max(best, least), curvatures.low


def band_pair_rounding(scene, band, i, j, distance):
    """pair_rounding() over a band [m]."""
    return max(
        pair_rounding(i, j, distance, scene.sizes, band.low.before, band.low.after),
        pair_rounding(i, j, distance, scene.sizes, band.high.before, band.high.after),
    )


def proven_band_gap(scene, band, i, j, distance, rounding):
    """proven_gap() over a band."""
    allowance = rounding if rounding < FREE else band_pair_rounding(scene, band, i, j, distance)
    least, curvature = band_pair(scene, band, i, j, scene.margin + allowance, distance)
    if rounding < FREE:
        if not (scene.margin < least <= scene.margin + rounding):
            return least - rounding, curvature
        band.low.round()
        band.high.round()
        allowance = band_pair_rounding(scene, band, i, j, distance)
    return least - allowance, curvature
