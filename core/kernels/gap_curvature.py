"""Bounds on the second derivative of a gap along an axis, and from it on the least gap between two instants."""

import cython
from cython.cimports.libc.math import fabs, sqrt

if not cython.compiled:  # the .pxd imports the same names for the compiler
    from core.kernels.constants import *
    from core.kernels.records import Curvatures

# Gap of bench i along an axis e fixed in bench j: g = min over corners X of i of e . (X - M_j) - support of j, and
#   |(e . p)''| <= |X''| + |M_j''| + 2 omega_j |X' - M_j'| + (omega_j^2 + omega_j') |p|,  p = X - M_j:  call it K.
# The same bound in a frame that turns with bench j about the spiral's centre, where neighbouring rings hardly move:
# with Omega = omega_j (clockwise), xi = X' less the velocity Omega |X| of that rotation,
#   |(e . p)''| <= |X'' + Omega^2 X| + |M_j'' + Omega^2 M_j| + 2 Omega (|xi_X| + |xi_M|) + omega_j' |p|,
#   handle at radius r, b = growth:  |P'' + Omega^2 P| <= |s''| + |k s'^2 - Omega^2 r| + Omega^2 b,
#                                    |xi_P| <= |s' - Omega r| + Omega b   (the tangent leans by at most b / r),
#   corner of bench i:  |X'' + Omega^2 X| <= mean of its handles + (|Omega^2 - omega_i^2| + omega_i') rho,
#                       |xi_X| <= mean of its handles + |Omega - omega_i| rho.
# The smaller of the two bounds is used.
# A function with |g''| <= K stays above its chord minus K x (h - x) / 2, so its values at both ends bound it from
# below: two benches do not touch on [L, R] if this bound exceeds the margin for one axis. No step size is guessed.


def least_between(start, end, curvature, h):
    """Lower bound on an interval of width h of a function g with these end values and |g''| <= curvature."""
    rise = end - start
    sag = curvature * h * h
    if 2.0 * fabs(rise) >= sag:
        return start if start < end else end
    return 0.5 * (start + end) - 0.125 * sag - 0.5 * rise * rise / sag


def apart(a_low, a_high, b_low, b_high):
    """The largest difference between a number in [a_low, a_high] and one in [b_low, b_high]."""
    return a_high - b_low if a_high - b_low > b_high - a_low else b_high - a_low


def against_rotation(growth, k, omega_low, omega_high, motion):
    """Bounds on |xi| and |P'' + Omega^2 P| of handle k against a rotation Omega in [omega_low, omega_high]."""
    high = motion[k, RATE_HIGH]
    low = motion[k, RATE_LOW]
    r_low = growth * motion[k, THETA_LOW]
    r_high = growth * motion[k, THETA_HIGH]
    slip = apart(low, high, omega_low * r_low, omega_high * r_high) + omega_high * growth
    pull = apart(
        low * low * motion[k, CURVATURE_LOW] / growth,
        high * high * motion[k, CURVATURE_HIGH] / growth,
        omega_low * omega_low * r_low,
        omega_high * omega_high * r_high,
    )
    return slip, pull + motion[k, RATE_RATE] + omega_high * omega_high * growth


# Input:  bench i, in which the axis is fixed, bench j, the distance between their centres, and the bounds on their
#         motion.
# State:  `slips` and `pulls`, sums of |xi| and of |P'' + Omega^2 P|, against the rotation of bench i.
# Output: K: the lesser of the bound made of these sums and of resting_curvature(), the bound in the resting frame.
def axis_curvature(growth, i, j, distance, sizes, motion):
    """Bound K on the second derivative of a gap along an axis fixed in bench i to the corners of bench j [1/m]."""
    low = motion[i, OMEGA_LOW]
    high = motion[i, OMEGA]
    resting = resting_curvature(i, j, distance, sizes, motion)
    slips = pulls = 0.0
    if motion[j, RATE_LOW] <= 0.0 or motion[i, RATE_LOW] <= 0.0 or low <= 0.0 or motion[j, OMEGA_LOW] <= 0.0:
        return resting
    for side in range(2):
        slip, pull = against_rotation(growth, i + side, low, high, motion)
        slips += 0.5 * slip
        pulls += 0.5 * pull
        slip, pull = against_rotation(growth, j + side, low, high, motion)
        slips += 0.5 * slip
        pulls += 0.5 * pull
    slips += apart(low, high, motion[j, OMEGA_LOW], motion[j, OMEGA]) * sizes[j, RADIUS]
    pulls += motion[j, OMEGA_RATE] * sizes[j, RADIUS]
    pulls += sizes[j, RADIUS] * apart(
        low * low, high * high, motion[j, OMEGA_LOW] * motion[j, OMEGA_LOW], motion[j, OMEGA] * motion[j, OMEGA]
    )
    pulls += 2.0 * high * slips + motion[i, OMEGA_RATE] * (distance + sizes[j, RADIUS])
    return pulls if pulls < resting else resting


def resting_curvature(i, j, distance, sizes, motion):
    """axis_curvature() in the resting frame [1/m]."""
    return (
        motion[j, CORNER_PULL]
        + motion[i, CENTRE_PULL]
        + 2.0 * motion[i, OMEGA] * (motion[j, CORNER_SPEED] + motion[i, CENTRE_SPEED])
        + motion[i, OMEGA_PULL] * (distance + sizes[j, RADIUS])
    )


def centres_apart(interval, a, b):
    """Upper bound of the distance between the centres of benches a and b during an interval [m]."""
    dx = interval.before[b, MX] - interval.before[a, MX]
    dy = interval.before[b, MY] - interval.before[a, MY]
    moved = (interval.motion[a, CENTRE_SPEED] + interval.motion[b, CENTRE_SPEED]) * interval.h
    return sqrt(dx * dx + dy * dy) + moved


def curvature_along(scene, interval, i, j, distance):
    """axis_curvature() over an interval [1/m]."""
    return axis_curvature(scene.curve.growth, i, j, distance, scene.sizes, interval.motion)


def pair_curvatures(scene, interval, place, h, a, b):
    """Bounds on the second derivative of gaps of two benches while the head travels h from a place [1/m].

    b: a bench or an edge at rest
    returns: for axes fixed in bench a, and for axes fixed in b; FREE where no bound is known
    """
    if not interval.lay_out(place, h, b + 1 if b < scene.room else a + 1):
        return FREE, FREE
    distance = centres_apart(interval, a, b)
    return curvature_along(scene, interval, a, b, distance), curvature_along(scene, interval, b, a, distance)


def band_curvatures(scene, band, i, j, distance):
    """Bounds on the second derivatives of a gap along an axis of bench i over a band."""
    return Curvatures(
        axis_curvature(scene.curve.growth, i, j, distance, scene.sizes, band.low.motion),
        axis_curvature(band.high.scene.curve.growth, i, j, distance, scene.sizes, band.high.motion),
        shift_curvature(i, j, distance, scene.sizes, band.shifts),
    )


def shift_curvature(i, j, distance, sizes, shifts):
    """Bound K of band_march.py on the second derivative by the growth of a gap along a normal of bench i [rad^2/m]."""
    omega = shifts[i, SHIFT_OMEGA]
    return (
        shifts[i, SHIFT_PULL]
        + shifts[j, SHIFT_PULL]
        + 2.0 * omega * (shifts[i, SHIFT_CORNER] + shifts[j, SHIFT_CORNER])
        + omega * omega * (distance + sizes[i, RADIUS] + sizes[j, RADIUS])
    )


def band_between(band, start, end, high_start, high_end, curvatures):
    """Lower bound over a band of a gap with these values at the corners of the band [m]."""
    low = least_between(start, end, curvatures.low, band.low.h)
    low -= band.slack * (fabs(end - start) / band.low.h + curvatures.low * band.low.h)
    high = least_between(high_start, high_end, curvatures.high, band.high.h)
    high -= band.slack * (fabs(high_end - high_start) / band.high.h + curvatures.high * band.high.h)
    return least_between(low, high, curvatures.across, band.width)
