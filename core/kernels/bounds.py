"""Certified motion: upper bounds on the speed and rotation of handles and benches over an interval of head travel."""

import cython
from cython.cimports.libc.math import fabs, sqrt

if not cython.compiled:  # the .pxd imports the same names for the compiler
    from core.kernels.constants import *
    from core.kernels.corners import bench_has_corner, cornered_link, jumped, passes_corner
    from core.kernels.records import Cosines, LinkBounds
    from core.kernels.rounding import spiral_rounding
    from core.kernels.spiral import spiral_curvature
    from core.kernels.stretches import blur_of, link_stretch, parts_between

# The head's travel sigma [m] is the variable; ' is d / d sigma. On [L, R] of width h every quantity below is an
# upper (or _low lower) bound over the whole interval, from the curvature range [k_low, k_high] of the stretch
# that the two handles of a link (a leads, b follows, chord c, unit vector u from b to a) sweep.
#
# Chord lemma. Let b be the first point behind a at the chord c, l the length of the arc between them, and its curvature
# in [k_low, k_high], 0 <= k_low, k_high c < 2. Then k_high l < pi; the angles alpha_a from the chord to the tangent at
# a and alpha_b from the tangent at b to the chord lie in [k_low l / 2, k_high l / 2]; and
#   k_low c / 2 <= sin alpha <= k_high c / 2 at both ends.
# If the curvature lies in [-k, k] instead, k c < 2, the same holds with -k for k_low and k for k_high.
#
# Proof. Let phi(t) be the direction of the tangent at arc t in front of b, beta that of the chord, D the distance of
# both ends, as functions of l while b moves back from a (D = 0 and both angles 0 at first). Along the chord direction
#   D' = cos alpha_b,   and across it   0 = integral of sin(phi - beta) over the arc.
# Upper bounds, with k = k_high or the two-sided k, as long as k l < pi. Suppose the first l at which one of |alpha_a|,
# |alpha_b| is about to exceed k l / 2; say alpha_a > 0 does, the other cases are mirror images. Up to there D' >=
# cos(k l / 2) > 0, so D > 0 and the angles are continuous in l: just beyond it k l / 2 < alpha_a <= pi / 2. With t
# counted back from a, y(t) = phi - beta has y(0) = alpha_a and |y'| <= k, so |y - alpha_a| <= k l < pi, and z =
# pi / 2 - |y - pi / 2| has sin z = sin y, z(0) = alpha_a, |z'| <= k too: pi / 2 >= z >= alpha_a - k t >= -pi / 2. As
# sine rises there,
#   integral of sin y >= integral of sin(alpha_a - k t) = (cos(alpha_a - k l) - cos alpha_a) / k > 0,
# since |alpha_a - k l| < alpha_a: a contradiction. Hence also D >= integral of cos(k l / 2) = (2 / k) sin(k l / 2),
# which reaches 2 / k > c before k l = pi, and D grows until then: so a first point at the chord c exists there, it is
# the only one, and k c / 2 >= sin(k l / 2) >= sin alpha.
# Lower bounds, k_low >= 0. Now y falls from alpha_a to -alpha_b, both at most pi / 2. If alpha_a < k_low l / 2, then
# -pi / 2 <= y <= alpha_a - k_low t, and integral of sin y <= (cos(alpha_a - k_low l) - cos alpha_a) / k_low < 0, again
# a contradiction; alpha_b likewise. So D' <= cos(k_low l / 2), and k_low c / 2 <= sin(k_low l / 2) <= sin alpha.
# Vogt. Where curvature grows in the direction of travel, alpha_a >= alpha_b >= 0. For let x(t) = phi(t) - phi(0) at t
# in front of b; the turn over the last t before a is no less, so y there is at most alpha_a - x, while t in front of b
# phi - beta = x - alpha_b. If alpha_a < alpha_b, the sum of both sines is at most sin(alpha_a - x) + sin(x - alpha_b)
# < 0 for every t, all four angles being in [-pi / 2, pi / 2], but its integral is 0.
#
# With omega the rate at which u turns, in the sense in which the path bends:
#   rigid link        b' cos alpha_b = a' cos alpha_a                      (b', a' the rates ds / d sigma)
#   turning of u      omega = (a' sin alpha_a + b' sin alpha_b) / c        in [k_low b'_low, k_high a'_high]
#   angles            alpha_a' = k_a a' - omega, alpha_b' = omega - k_b b' so |alpha'| <= k_high a' - k_low b'_low
#   link, again       b'' cos alpha_b = a'' cos alpha_a - a' alpha_a' sin alpha_a + b' alpha_b' sin alpha_b
#   turning, again    omega' c = a'' sin alpha_a + a' alpha_a' cos alpha_a + b'' sin alpha_b + b' alpha_b' cos alpha_b
#   link, once more   b''' cos alpha_b = a''' cos alpha_a - 2 a'' alpha_a' sin alpha_a + 2 b'' alpha_b' sin alpha_b
#                       - a' (alpha_a'^2 cos alpha_a + alpha_a'' sin alpha_a) + b' (the same of b),
#                     alpha_a'' = k_a' a'^2 + k_a a'' - omega', alpha_b'' = omega' - k_b' b'^2 - k_b b'', k' = dk / ds
# omega = (a' sin alpha_a + b' sin alpha_b) / c, which is k (a' + b') / 2 for a k in [k_low, k_high]: the bounds of the
# second line hold where 0 <= b' <= a'. On an inward spiral that is so, by Vogt; on a route, where b' may exceed a',
# route_bounds() takes the larger of both.
#
# Where k_high c >= 2 (near the centre) the angles are followed from the nearer end of the interval instead: with a
# trial bound on b', |alpha'| <= k_high max(a', b') + omega bounds the cosines half an interval away, these bound b',
# and the trial is proven when that is below it (b' is continuous and below the trial at both ends).
#
# A handle accelerates by |P''| <= |s''| + k s'^2. A point X of a bench with centre M at distance rho:
#   |X'| <= |M'| + omega rho,  |X''| <= |M''| + (omega^2 + omega') rho.

# Trial bound on a followed handle's rate, as a multiple of the rate that both ends show [1]; any value > 1 is sound.
TRIAL = 1.5
# On a route the lemma bounds the ratio of a link's rates. Where that bound exceeds this [1], the cosines of the link's
# angles are also followed from the ends of the interval, because the excess multiplies from link to link.
RATIO_FOLLOWED = 1.001

# Rounding. The chains at both ends belong to heads that stand exactly where their doubles say (rounding.py), and h is
# at least the way between these two places (marching.py). Every input of the bounds is widened by its largest error, so
# that the results bound the true motion, for any number of links:
#   curvature    of a handle that is SLIP along the path from its true place: on a spiral |d k / d s| <= 2 k / growth,
#                as theta (4 + theta^2) / ((2 + theta^2) (1 + theta^2)^(3/2)) <= 2, so k is good to 2 SLIP / growth of
#                itself (up to the first handle that is followed SLIP <= spiral_error() with chords up to 2 r) besides a
#                few u; on a route to K_SLOPE SLIP + CURVATURE_SLACK. `widened` adds 32 u (benches + 8), so that k_high
#                and k_low also make up for the few u of sin_high, cos_low, cos_high and of differences like swing, even
#                where these are much smaller than their terms: d (1 - sin^2) = 2 sin^2 widened is more than its
#                rounding, 3 u, unless sin^2 < 1 / 170, and there cos is good to 3 u of itself.
#   cosines      followed from the ends: u of a link is off by SWAY or less, T by up to 13 SLIP / chord (rounding.py),
#                on a route, whose curvature is below 2 / chord, by 2.2 SLIP / chord, and by the rotation of the frame,
#                which SWAY includes too: `blur` = 2 SWAY + 13 (2.2) SLIP / chord + 16 u.
#   recurrences  from link to link are sums, products and quotients of terms >= 0, each good to u, and fewer than 30 for
#                each link: a factor LOOSEN (TIGHTEN for lower bounds) at each link keeps them above (below) the truth.
# A number computed from a motion row only once, not from link to link, is good to 1e-13 of itself; h makes up for that.
SPIRAL_SWAY = 13.0
LOOSEN = 1.0 + 4e-15
TIGHTEN = 1.0 - 4e-15
# Part by which the way over which jumps count is narrowed, for its rounding [1].
WIDTH_SPARE = 1e-9
# The sharpest bend that a chord can follow on a route, widened by its rounding [1].
ROUTE_SINE_ROUNDED = ROUTE_SINE_LIMIT * (1.0 + 1e-9)


def stand_between(k, before, after, widened, motion):
    """Fill in the ranges of theta and curvature of handle k of a spiral, if it does not reverse in the interval."""
    motion[k, THETA_LOW] = after[k, THETA]
    motion[k, THETA_HIGH] = before[k, THETA]
    motion[k, CURVATURE_LOW] = spiral_curvature(before[k, THETA]) * (1.0 - widened)
    motion[k, CURVATURE_HIGH] = spiral_curvature(after[k, THETA]) * (1.0 + widened)


def bench_bounds(k, rate_a, rate_b, omega, spin, pull, sizes, motion):
    """Bounds on the motion of bench k, from those of its handles (rates, pull) and of its direction (omega, spin)."""
    motion[k, CENTRE_SPEED] = 0.5 * (rate_a + rate_b)
    motion[k, CORNER_SPEED] = 0.5 * (rate_a + rate_b) + omega * sizes[k, RADIUS]
    motion[k, CENTRE_PULL] = pull
    motion[k, CORNER_PULL] = pull + spin * sizes[k, RADIUS]
    motion[k, OMEGA] = omega
    motion[k, OMEGA_PULL] = spin
    motion[k, HANDLE_SPEED] = rate_a if rate_a > rate_b else rate_b


def summed_widening(growth, benches, sizes, before, after):
    """Largest relative error of a curvature, from the sums that spiral_error() replaces [1]."""
    spiral_rounding(growth, benches, sizes, before)
    spiral_rounding(growth, benches, sizes, after)
    return 32.0 * ULP * (benches + 8.0) + 2.0 * max(before[benches, SLIP], after[benches, SLIP]) / growth


def curved_link(chord, k_low, k_high, rate_a, rate_low):
    """Bounds on a link by the chord lemma, from the range of its curvature and of its leader's rate."""
    sine = 0.5 * k_high * chord
    rear = sqrt(1.0 - sine * sine)
    front = sqrt(1.0 - 0.25 * k_low * k_low * chord * chord)
    rate_low *= TIGHTEN * rear / front
    swing = k_high * rate_a - k_low * rate_low
    return LinkBounds(front, rear, sine, rate_a, rate_low, k_high * rate_a, k_low * rate_low, swing, swing, False, True)


def followed_link(k, h, k_high, rate_a, chord, blur, before, after):
    """Bounds on a link whose angles are followed from the ends of the interval, as far as they are known.

    blur: error of the cosines of these angles at either end [1]
    """
    front, rear = link_cosines(k, before)
    front_end, rear_end = link_cosines(k, after)
    front = (fabs(front) if fabs(front) > fabs(front_end) else fabs(front_end)) + blur
    rear = (rear if rear < rear_end else rear_end) - blur
    if rear <= 0.0:
        return LinkBounds(front, rear, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, True, False)
    rate_b = rate_a * (TRIAL * front + h * rate_a * (k_high + 2.0 / chord)) / rear
    omega = (rate_a + rate_b) / chord
    swing_a = k_high * rate_a + omega
    swing_b = k_high * rate_b + omega
    front = min(front + 0.5 * h * swing_a, 1.0)
    rear -= 0.5 * h * swing_b
    bounded = not (rear <= 0.0 or rate_a * front > rate_b * rear)
    return LinkBounds(front, rear, 1.0, LOOSEN * rate_b, 0.0, omega, 0.0, swing_a, swing_b, True, bounded)


# Input:  the chains at both ends of an interval of width h, each with all handles up to `benches`.
# State:  rate_a, rate_low and second_a, the bounds on the rate of handle k and on its |s''|; `followed`, whether a link
#         before this one was followed; `summed`, whether the sums of spiral_rounding() are known; and `widened`, the
#         part by which curvatures are widened.
# Output: a motion row for every bench and the handle in front of it, see constants.py.
def motion_bounds(growth, h, benches, sizes, before, after, motion):
    """Bounds on the motion of the first benches over an interval of width h; False when h is too wide for any."""
    followed = False
    rate_a = rate_low = 1.0
    second_a = 0.0
    motion[0, RATE_HIGH] = motion[0, RATE_LOW] = 1.0
    motion[0, RATE_RATE] = 0.0
    summed = False
    outermost = max(before[benches, THETA], after[benches, THETA])
    error = ULP * (outermost + 1.0) * (66.0 * benches + 16.0 * (outermost - after[0, THETA]) + 5.0)
    slip = max(before[0, SLIP], after[0, SLIP])  # of the head, where it moves in time (ensemble.py)
    widened = 32.0 * ULP * (benches + 8.0) + 2.0 * error + 2.0 * slip / growth
    error = error * (growth * benches / SMALL) + slip * (benches / SMALL)
    outwards = (1.0 - widened) / growth
    inwards = (1.0 + widened) / growth
    for k in range(benches):
        chord = sizes[k, CHORD]
        if error > chord and not summed:  # spiral_error() does not cover such chords: compute the sums
            summed = True
            widened = summed_widening(growth, benches, sizes, before, after)
            outwards = (1.0 - widened) / growth
            inwards = (1.0 + widened) / growth
        stand_between(k, before, after, widened, motion)
        inner = after[k, THETA] if after[k, THETA] < before[k, THETA] else before[k, THETA]
        outer = before[k + 1, THETA] if after[k + 1, THETA] < before[k + 1, THETA] else after[k + 1, THETA]
        if followed:  # the handle may reverse between the ends: it goes no further in than its rate allows
            slid = 2.0 * rate_a * h / (growth * inner) if inner > 0.0 else FREE
            inner = max(inner - slid if slid <= 0.5 * inner else inner - rate_a * h / growth, 0.0)
        k_high = spiral_curvature(inner) * inwards
        if 0.5 * k_high * chord <= SINE_LIMIT:
            k_low = 0.0 if followed else spiral_curvature(outer) * outwards
            link = curved_link(chord, k_low, k_high, rate_a, rate_low)
        else:
            if not summed:  # the link that is followed needs the sums themselves
                summed = True
                widened = summed_widening(growth, benches, sizes, before, after)
                inwards = (1.0 + widened) / growth
                k_high = spiral_curvature(inner) * inwards
            followed = True
            blur = blur_of(k, SPIRAL_SWAY / chord, before, after)
            link = followed_link(k, h, k_high, rate_a, chord, blur, before, after)
            if not link.bounded:
                return False
        swung = rate_a * link.swing_front + link.rate * link.swing_rear
        second_b = LOOSEN * (link.cos_front * second_a + link.sine * swung) / link.cos_rear
        spin = link.omega * link.omega + (link.cos_front * swung + link.sine * (second_a + second_b)) / chord
        if link.followed:
            spin = link.omega * link.omega + (swung + second_a + second_b) / chord
        pull = 0.5 * (second_a + second_b + k_high * (rate_a * rate_a + link.rate * link.rate))
        bench_bounds(k, rate_a, link.rate, link.omega, spin, pull, sizes, motion)
        motion[k, OMEGA_LOW] = link.omega_low
        motion[k, OMEGA_RATE] = spin - link.omega * link.omega
        motion[k + 1, RATE_HIGH] = rate_a = link.rate
        motion[k + 1, RATE_LOW] = rate_low = link.rate_low
        motion[k + 1, RATE_RATE] = second_a = second_b
    stand_between(benches, before, after, widened, motion)
    return True


def link_cosines(k, chain):
    """Cosines of the angles between bench k and the tangents at its front and its rear handle."""
    return (
        chain[k, TX] * chain[k, UX] + chain[k, TY] * chain[k, UY],
        chain[k + 1, TX] * chain[k, UX] + chain[k + 1, TY] * chain[k, UY],
    )


def swing_bound(low, high, rate, rate_low, ratio, ratio_low):
    """Bound on |alpha'| of both angles of a link with curvatures in [low, high], from bounds on its leader's rate and
    on the ratio of the follower's rate to it."""
    fastest = rate * max(1.0, ratio)
    return high * fastest - low * (rate_low * min(1.0, ratio_low) if low > 0.0 else fastest)


def route_cosines(k, h, stretch, rate_a, rate_low, before, after):
    """Bounds on the cosines of both angles of a link: by the lemma, and followed from the ends where they are wide.

    rate_a, rate_low: bounds on the rate of its leader
    """
    low = stretch.low
    front_low = rear_low = sqrt(1.0 - stretch.sine * stretch.sine)
    front_high = rear_high = sqrt(1.0 - 0.25 * low * low * stretch.chord * stretch.chord) if low > 0.0 else 1.0
    if front_high > RATIO_FOLLOWED * rear_low:
        turned = swing_bound(low, stretch.high, rate_a, rate_low, front_high / rear_low, front_low / rear_high)
        turned = 0.5 * h * stretch.sine * turned + stretch.blur
        front, rear = link_cosines(k, before)
        front_end, rear_end = link_cosines(k, after)
        front_low = max(front_low, min(front, front_end) - turned)
        front_high = min(front_high, max(front, front_end) + turned)
        rear_low = max(rear_low, min(rear, rear_end) - turned)
        rear_high = min(rear_high, max(rear, rear_end) + turned)
    return Cosines(front_low, front_high, rear_low, rear_high)


def bound_climb(k, h, stretch, cosines, before, after, motion):
    """Lower the bounds on handle k + 1 of a route by its s'' at both ends, and fill in the rounding of rate and s''."""
    rate_a = motion[k, RATE_HIGH]
    rate_b = motion[k + 1, RATE_HIGH]
    second_b = motion[k + 1, RATE_RATE]
    turned = max(fabs(before[k + 1, CLIMB]), fabs(after[k + 1, CLIMB]))
    error_a = motion[k, RATE_ERROR]
    error_b = (error_a * cosines.front_high + 2.0 * stretch.blur * rate_b) / cosines.rear_low
    climb_error = motion[k, CLIMB_ERROR]
    widened = stretch.widened * (rate_a * rate_a + rate_b * rate_b)
    climb_error += 2.0 * stretch.blur * (motion[k, RATE_RATE] + turned) + widened
    lost = 8.0 * (rate_a + rate_b) * (error_a + error_b + stretch.blur * (rate_a + rate_b)) / stretch.chord
    climb_error += lost * max(1.0, stretch.sine)
    climb_error /= cosines.rear_low
    if motion[k + 1, CROSSED] == 0.0:
        motion[k + 1, RATE_RATE] = second_b = min(second_b, turned + climb_error + 0.5 * h * motion[k + 1, RATE_JERK])
    rate_b = min(rate_b, 0.5 * (before[k + 1, RATE] + after[k + 1, RATE] + h * second_b) + error_b)
    motion[k + 1, RATE_HIGH] = rate_b
    motion[k + 1, RATE_ERROR] = error_b
    motion[k + 1, CLIMB_ERROR] = climb_error


# Input:  as for motion_bounds(), on a table of pieces.
# State:  rate_low and third_a, bounds on the rate of handle k and on its |s'''|; the rest stands in its motion row.
# Output: a motion row for every bench and the handle in front of it, see constants.py.
def route_bounds(pieces, h, benches, sizes, before, after, climbing, motion):
    """motion_bounds() on a route. No handle reverses there. The chord lemma serves where k chord < 2; a link on sharper
    bends is followed from the ends of the interval, with 1 for its sines, and one at a corner as corners.py says.

    Where the curvature changes sign between two handles, the angles lie in [-k l / 2, k l / 2] for the larger |k|. The
    cosines of the angles are also followed from both ends of the interval, as near the centre of a spiral: |cos alpha|'
    <= sin alpha |alpha'|, and no instant is further than half an interval from the nearer end.
    climbing: the chains hold s'' too. Until a handle crosses into another part, its values at both ends and the bound
    on |s'''| bound s'', and so the rate, over the interval: these bounds do not grow from link to link. With angles
    good to `blur`, the rounding e of a rate obeys e_b cos alpha_b <= e_a cos alpha_a + 2 blur b', and the rounding d of
    s'', by rates.climbs(), obeys d_b cos alpha_b <= d_a + 2 blur (|a''| + |b''|) + widened (a'^2 + b'^2)
    + 8 (a' + b') (e_a + e_b + blur (a' + b')) / c
    """
    third_a = 0.0
    cornered = pieces[0, CORNERED] > 0.0
    # for the jumps, the way of a head that is not displaced: a member of an ensemble adds that to h
    width = (h - before[0, SLIP] - after[0, SLIP]) * (1.0 - WIDTH_SPARE)
    if cornered and width <= 0.0:
        return False
    motion[0, RATE_HIGH] = rate_low = 1.0
    motion[0, RATE_RATE] = motion[0, RATE_ERROR] = motion[0, CLIMB_ERROR] = 0.0
    motion[0, CROSSED] = parts_between(pieces, 0, before, after)
    if cornered:
        passes_corner(pieces, 0, before, after, motion)
    for k in range(benches):
        stretch = link_stretch(pieces, k, benches, sizes, before, after)
        high = stretch.high
        sine = stretch.sine
        rate_a = motion[k, RATE_HIGH]
        second_a = motion[k, RATE_RATE]
        bends = cornered and bench_has_corner(pieces, k, before, after)
        jumps = 0.0
        if sine <= ROUTE_SINE_ROUNDED and not bends:
            cosines = route_cosines(k, h, stretch, rate_a, rate_low, before, after)
            front = cosines.front_high
            rear = cosines.rear_low
            ratio_low = cosines.front_low / cosines.rear_high
            rate_b = LOOSEN * rate_a * front / rear
            omega = high * max(rate_a, rate_b)
            swing = swing_bound(stretch.low, high, rate_a, rate_low, front / rear, ratio_low)
        else:
            if bends:
                link = cornered_link(pieces, k, h, stretch, rate_a, before, after)
            else:
                link = followed_link(k, h, high, rate_a, stretch.chord, stretch.blur, before, after)
            if not link.bounded:
                return False
            if bends:
                jumps = 2.0 * jumped(pieces, k, rate_a, link.rate, before, after) / width
            cosines = Cosines(0.0, link.cos_front, link.cos_rear, 1.0)
            rear = link.cos_rear
            rate_b = LOOSEN * rate_a * link.cos_front / rear
            omega = link.omega
            swing = max(link.swing_front, link.swing_rear)
            front = sine = 1.0
        second_b = LOOSEN * (front * second_a + sine * swing * (rate_a + rate_b) + jumps) / rear
        # b' cos alpha_b = a' cos alpha_a <= rate_a front, which is more than rate_b front where b is the slower handle.
        both = rate_a + max(rate_a, rate_b)
        spin = omega * omega + (front * swing * both + sine * (second_a + second_b) + jumps) / stretch.chord
        pull = 0.5 * (second_a + second_b + high * (rate_a * rate_a + rate_b * rate_b) + jumps)
        bench_bounds(k, rate_a, rate_b, omega, spin, pull, sizes, motion)
        motion[k, OMEGA_LOW] = motion[k, RATE_LOW] = 0.0
        third_b = stretch.slope * (rate_a * rate_a * rate_a + rate_b * rate_b * rate_b)
        third_b += high * (rate_a * second_a + rate_b * second_b) + (spin - omega * omega) * (rate_a + rate_b)
        third_b = sine * (third_b + 2.0 * swing * (second_a + second_b))
        third_b = LOOSEN * (front * (third_a + swing * swing * both) + third_b) / rear
        motion[k + 1, RATE_HIGH] = rate_b
        motion[k + 1, RATE_RATE] = second_b
        motion[k + 1, RATE_JERK] = third_a = third_b
        if climbing:
            motion[k + 1, CROSSED] = motion[k, CROSSED] + parts_between(pieces, k + 1, before, after)
            if not cornered or not passes_corner(pieces, k + 1, before, after, motion):
                bound_climb(k, h, stretch, cosines, before, after, motion)
        rate_low = TIGHTEN * rate_low * cosines.front_low / cosines.rear_high
    return True


# Rates of followed handles. Both cosines are good to `blur`, so e_b cos alpha_b <= e_a cos alpha_a + 2 blur |b'| bounds
# the rounding e of a rate.


def followed_error(k, error, sizes, before, after):
    """Rounding of the rate of handle k of a spiral at either end of an interval, from that of the one before [1]."""
    blur = blur_of(k - 1, SPIRAL_SWAY / sizes[k - 1, CHORD], before, after)
    front, rear = link_cosines(k - 1, before)
    front_end, rear_end = link_cosines(k - 1, after)
    rear = min(rear, rear_end) - blur
    if rear <= 0.0:
        return FREE
    error *= max(fabs(front), fabs(front_end)) + blur
    return (error + 2.0 * blur * max(fabs(before[k, RATE]), fabs(after[k, RATE]))) / rear
