"""Upper bounds on the rates of handles over an interval of head travel, in metres per metre of head travel."""

import cython
from cython.cimports.libc.math import fabs

if not cython.compiled:  # the .pxd imports the same names for the compiler
    from core.kernels.bounds import LOOSEN, SPIRAL_SWAY, followed_error, link_cosines
    from core.kernels.chain import extend, extend_chain, start
    from core.kernels.constants import *
    from core.kernels.rings import drift
    from core.kernels.route import extend_route
    from core.kernels.spiral import spiral_curvature
    from core.kernels.stretches import blur_of, steepest_curvature


# Rates are Lipschitz: |d rate / d sigma| = |s''| is bounded over an interval (bounds.py), so between two ends a rate is
# at most (start + end + bound h) / 2, and never above its own bound over the interval.
#
# Calm handles. Where curvature does not fall in the direction of travel and the lemma holds, |b'| <= |a'| (Vogt,
# bounds.py): on an inward spiral, a line, an arc. On a route handles only go forward. So if handle n stands on such a
# first piece at the end of an interval, it stood there throughout, and no handle behind it is faster. On a spiral this
# holds from a radius outwards; the chain is laid out to twice this radius, so that handle n may drift by half its own.


def lively_chain(curve, place, last, calm, sizes, chain):
    """Fill in a chain up to the first calm handle, or the last; returns that handle's number, FOLDED at a fold.

    place: of the head [m]; calm: LAG from which backwards handles are calm, FREE if none are
    """
    start(curve, place, chain)
    if curve.is_spiral:
        return extend_chain(curve.growth, 0, last, 2.0 * (curve.growth * calm), sizes, chain)
    return extend_route(curve.pieces, 0, last, calm, sizes, chain)


def fastest(benches, chain):
    """Number of the handle with the largest |rate|, the first one of equals."""
    best = 0
    for k in range(1, benches + 1):
        if fabs(chain[k, RATE]) > fabs(chain[best, RATE]):
            best = k
    return best


def climbs(curve, last, sizes, chain):
    """Fill in d rate / d sigma of the handles of a chain [1/m], and on a spiral, which bends clockwise, curvatures.

    From the second derivative of D = P_a - P_b, with |D| constant, N to the left of T and signed curvature:
    b'' (D . T_b) = |D'|^2 + D . (a'' T_a + k_a a'^2 N_a - k_b b'^2 N_b),  D' = a' T_a - b' T_b.
    """
    second = 0.0
    chain[0, CLIMB] = 0.0
    if curve.is_spiral:
        for i in range(last + 1):
            chain[i, CURVATURE] = -spiral_curvature(chain[i, THETA]) / curve.growth
    for i in range(last):
        a = chain[i, RATE]
        b = chain[i + 1, RATE]
        x = a * chain[i, TX] - b * chain[i + 1, TX]
        y = a * chain[i, TY] - b * chain[i + 1, TY]
        second = (
            (x * x + y * y) / sizes[i, CHORD]
            + chain[i, UX] * (second * chain[i, TX] - chain[i, CURVATURE] * a * a * chain[i, TY])
            + chain[i, UY] * (second * chain[i, TY] + chain[i, CURVATURE] * a * a * chain[i, TX])
            + chain[i + 1, CURVATURE] * b * b * (chain[i, UX] * chain[i + 1, TY] - chain[i, UY] * chain[i + 1, TX])
        ) / (chain[i, UX] * chain[i + 1, TX] + chain[i, UY] * chain[i + 1, TY])
        chain[i + 1, CLIMB] = second


# Within a part rates are smooth: with |r''| <= J a rate stays below its chord plus J h^2 / 8; and where its slope at an
# end exceeds J h, it rises or falls throughout, so that it is largest at an end. (An error d of a slope changes this
# bound, and all bounds below, by d h at most.) Where one handle crosses one joint at x = y in [0, h], r stays below
# p = r_0 + s_0 x + J h^2 / 2 for x <= y and below q = r_h + s_h (x - h) + J h^2 / 2 for x >= y. If s_0 >= J h and
# s_h <= -J h, r rises up to y and falls from there, so that its largest value is r(y) <= min(p(y), q(y)), which is
# largest where p and q cross.
#
# On a spiral J follows from the results of motion_bounds(), by "link, once more" in bounds.py, for handles no further
# in than `inner`. There |alpha'| <= swing = k_high s' + omega for either handle, so that half an interval from the
# nearer end a lower bound of the cosine of alpha_b is known; sines and the other cosine count as 1. A rate may change
# its sign, but if it rises or falls throughout, its absolute value is largest at an end too.
#
# Rounding. The results of motion_bounds() hold as they are; the error of the handle is subtracted from `inner`, and
# `blur` from the cosine. Curvature, its slope and all that follows are sums and products of terms >= 0, with fewer than
# 60 roundings for each link, and LOOSEN twice makes up for these.


# Input:  a bounded interval of a spiral, from motion_bounds().
# State:  `jerk`, the bound on |s'''| of handle k.
# Output: RATE_JERK of the handles.
def spiral_jerks(growth, interval):
    """Fill in bounds on |s'''| of the handles of a spiral over an interval [1/m^2]; FREE where a link may fold."""
    before: cython.double[:, ::1] = interval.before
    after: cython.double[:, ::1] = interval.after
    motion: cython.double[:, ::1] = interval.motion
    h = interval.h
    jerk = 0.0
    for k in range(interval.handles):
        rate_a = motion[k, RATE_HIGH]
        rate_b = motion[k + 1, RATE_HIGH]
        inner = min(before[k, THETA], after[k, THETA])
        inner = max(inner - (rate_a * h + max(before[k, SLIP], after[k, SLIP])) / growth, 0.0)
        curvature = spiral_curvature(inner) / growth
        slope = steepest_curvature(inner) / (growth * growth)
        swing_a = curvature * rate_a + motion[k, OMEGA]
        swing_b = curvature * rate_b + motion[k, OMEGA]
        cosine = before[k + 1, TX] * before[k, UX] + before[k + 1, TY] * before[k, UY]
        cosine = min(cosine, after[k + 1, TX] * after[k, UX] + after[k + 1, TY] * after[k, UY])
        cosine -= 0.5 * h * swing_b + blur_of(k, SPIRAL_SWAY / interval.scene.sizes[k, CHORD], before, after)
        if cosine <= 0.0 or jerk >= FREE:
            motion[k + 1, RATE_JERK] = jerk = FREE
            continue
        jerk += 2.0 * (swing_a * motion[k, RATE_RATE] + swing_b * motion[k + 1, RATE_RATE])
        jerk += rate_a * (swing_a * swing_a + slope * rate_a * rate_a + curvature * motion[k, RATE_RATE])
        jerk += rate_b * (swing_b * swing_b + slope * rate_b * rate_b + curvature * motion[k + 1, RATE_RATE])
        jerk = LOOSEN * LOOSEN * (jerk + (rate_a + rate_b) * motion[k, OMEGA_RATE]) / cosine
        motion[k + 1, RATE_JERK] = jerk


def smooth_bound(start, start_slope, end, end_slope, jerk, h, kink):
    """Upper bound of a rate between two ends, with |second derivative| <= jerk and at most one kink."""
    most = max(start, end)
    if not kink:
        if fabs(start_slope) >= jerk * h or fabs(end_slope) >= jerk * h:
            return most
        return most + 0.125 * jerk * h * h
    if start_slope >= jerk * h and end_slope <= -jerk * h and start_slope > end_slope:
        x = min(max((end - start - end_slope * h) / (start_slope - end_slope), 0.0), h)
        most = max(most, min(start + start_slope * x, end + end_slope * (x - h)))
    else:
        most = max(start + max(start_slope, 0.0) * h, end + max(-end_slope, 0.0) * h)
    return most + 0.5 * jerk * h * h


# Rounding. Rates and slopes at the ends are good to RATE_ERROR and CLIMB_ERROR, on a route by route_bounds(), on a
# spiral by spiral_errors(). On a spiral no rate exceeds 1 unless a handle is followed. Numbers computed from these only
# once are good to BOUND_ROUNDING of themselves, and for the bounds h is widened by the errors of both travels
# (scene.py).
# Rounding cannot make a handle count as calm that is not: on a spiral the lemma holds up to a sine of 1, and only sines
# up to SINE_LIMIT count as calm; on a route stands_first() leaves BLEND to spare.
#
# The rounding d of a slope. By climbs(), divided by the chord, with e the rounding of a rate, curvature good to
# `widened` (|d k / d s| <= 2 k / growth, bounds.py), directions good to `blur`, and D' good to
# q = e_a + e_b + blur (|a'| + |b'|):
#     d_b cos alpha_b <= d_a + 2 blur (|a''| + |b''|) + 4 (|a'| + |b'|) q / c
#                        + for both handles (widened + 2 blur k) s'^2 + 4 k |s'| e.
# Each product of two inexact factors counts twice, which covers the errors of both factors and its own rounding, as
# blur >= 16 u.
BOUND_ROUNDING = 1e-14  # [1]


# Input:  the chains at both ends of an interval, with climbs().
# State:  `error` and `climb`, e and d above, of handle k.
# Output: RATE_ERROR and CLIMB_ERROR of the handles.
def spiral_errors(growth, handles, sizes, before, after, motion):
    """Fill in RATE_ERROR and CLIMB_ERROR of the handles of a spiral; FREE where no bound is known."""
    error = climb = 0.0
    motion[0, RATE_ERROR] = motion[0, CLIMB_ERROR] = 0.0
    for k in range(handles):
        chord = sizes[k, CHORD]
        blur = blur_of(k, SPIRAL_SWAY / chord, before, after)
        _, rear = link_cosines(k, before)
        _, rear_end = link_cosines(k, after)
        rear = min(rear, rear_end) - blur
        rate_a = max(fabs(before[k, RATE]), fabs(after[k, RATE]))
        rate_b = max(fabs(before[k + 1, RATE]), fabs(after[k + 1, RATE]))
        error_a = error
        error = followed_error(k + 1, error, sizes, before, after)
        if rear <= 0.0 or climb >= FREE or not (error < FREE):
            motion[k + 1, RATE_ERROR] = motion[k + 1, CLIMB_ERROR] = error = climb = FREE
            continue
        slip = max(before[k + 1, SLIP], after[k + 1, SLIP])
        curvature = spiral_curvature(min(before[k, THETA], after[k, THETA])) / growth
        widened = curvature * (32.0 * ULP + 4.0 * slip / growth) + 2.0 * blur * curvature
        climb += 2.0 * blur * max(fabs(before[k, CLIMB]), fabs(after[k, CLIMB]))
        climb += 2.0 * blur * max(fabs(before[k + 1, CLIMB]), fabs(after[k + 1, CLIMB]))
        climb += 4.0 * (rate_a + rate_b) * (error_a + error + blur * (rate_a + rate_b)) / chord
        climb += widened * (rate_a * rate_a + rate_b * rate_b) + 4.0 * curvature * (rate_a * error_a + rate_b * error)
        climb /= rear
        motion[k + 1, RATE_ERROR] = error
        motion[k + 1, CLIMB_ERROR] = climb


# Input:  an interval whose chains are laid out, and from where handles are calm.
# State:  `upper`, the largest bound on a rate so far, at first 1, the rate of the head.
# Output: `upper`, widened by its rounding, or FREE.
def rate_bound(scene, interval, calm):
    """Upper bound of every |rate| over an interval whose chains are laid out; FREE if the interval is too wide."""
    handles = interval.handles
    upper = 1.0
    if handles == 0:
        return upper
    climbs(scene.curve, handles, scene.sizes, interval.before)
    climbs(scene.curve, handles, scene.sizes, interval.after)
    if not interval.bound(True):
        return FREE
    if scene.curve.is_spiral:
        if handles < scene.benches:
            inner = scene.curve.growth * min(interval.before[handles, THETA], interval.after[handles, THETA])
            rate = interval.motion[handles - 1, HANDLE_SPEED]
            if inner - drift(rate, interval.h, scene.curve.growth, inner) < scene.curve.growth * calm:
                return FREE
        if interval.motion[handles, RATE_LOW] > 0.0:
            return upper
        spiral_errors(scene.curve.growth, handles, scene.sizes, interval.before, interval.after, interval.motion)
        spiral_jerks(scene.curve.growth, interval)
    for k in range(1, handles + 1):
        upper = max(upper, handle_bound(scene, interval, k, upper))
    return upper * (1.0 + BOUND_ROUNDING) if upper > 1.0 else upper


def handle_bound(scene, interval, k, enough):
    """Upper bound of the |rate| of handle k over a bounded interval, sharpened only while it exceeds `enough`."""
    h = interval.h
    start = interval.before[k, RATE]
    end = interval.after[k, RATE]
    error = interval.motion[k, RATE_ERROR]
    jerk = interval.motion[k, RATE_JERK]
    bound = 0.5 * (fabs(start) + fabs(end) + interval.motion[k, RATE_RATE] * h) + error
    bound = min(bound, interval.motion[k, RATE_HIGH])
    kink = False
    if scene.curve.is_spiral:
        start = fabs(start)
        end = fabs(end)
    elif bound > enough and interval.motion[k, CROSSED] <= 1.0:
        kink = interval.motion[k, CROSSED] > 0.0
    else:
        return bound
    smooth = smooth_bound(start, interval.before[k, CLIMB], end, interval.after[k, CLIMB], jerk, h, kink)
    return min(bound, smooth + error + interval.motion[k, CLIMB_ERROR] * h)


def certain_rate(interval, rounding):
    """Lower bound of one handle's |rate| over the last 2 `rounding` [m] of a bounded interval, and that handle.

    The bound is at least 1, the rate of the head itself.
    """
    best = 1.0
    at = 0
    if interval.motion[interval.handles, RATE_LOW] <= 0.0:
        for k in range(1, interval.handles + 1):
            rate = fabs(interval.after[k, RATE]) - interval.motion[k, RATE_ERROR]
            rate -= 2.0 * rounding * interval.motion[k, RATE_RATE]
            if rate > best:
                best = rate
                at = k
    return best, at


def lay_ahead(scene, interval, calm, placed, place):
    """Lay out the end of an interval with its head at a place, and its beginning up to the same handle.

    placed: the last handle of its beginning so far; returns: the last handle of its beginning afterwards
    interval.handles: set to the last handle of its end, FOLDED at a fold
    """
    interval.handles = lively_chain(scene.curve, place, scene.benches, calm, scene.sizes, interval.after)
    if FOLDED < placed < interval.handles:
        return extend(scene.curve, placed, interval.handles, scene.sizes, interval.before)
    return placed
