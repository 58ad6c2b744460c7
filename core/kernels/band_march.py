"""March of all pitches between two at once: a band of pitches, proven clear."""

import cython
from cython.cimports.libc.math import cos, sin, sqrt

if not cython.compiled:  # the .pxd imports the same names for the compiler
    from core.kernels.chain import extend_chain, start_chain
    from core.kernels.clearance import row_gap
    from core.kernels.constants import *
    from core.kernels.nearest import band_least
    from core.kernels.pairs import BAND_ROUNDING
    from core.kernels.rings import leaders_reach, radius_beyond
    from core.kernels.scene import Band, MarchState
    from core.kernels.spiral import spiral_arc, spiral_theta

# Shortest step in which handles may move backwards before a band is given up, relative to the head's radius [1].
BACKWARDS_WITHIN = 1e-3
# Work of a step relative to one of a march [1]: it lays out four chains, at 0.6 us for each handle in all.
CHAIN_WORK = 5.0

# The separation of two benches is now a function of the head's radius r_0 and of the growth b. Below, ' is d / db at a
# fixed r_0, seen in the frame in which the head stands at angle 0: handle k stands at rho = r_0 + b psi, angle psi,
# P = rho R(psi), with unit vectors R outwards and T = R turned left, delta = psi_b - psi_a for a link whose front
# handle is a and rear handle b, u the unit vector from b to a, c its chord.
#
# First derivatives. With f(rho_a, delta, b) = b^2 delta^2 + 2 rho_a (rho_a + b delta) (1 - cos delta) = c^2 and
# a = rho',
#     a_b = a_a (1 - b f_rho / f_delta) + z,    z = 2 rho_a rho_b delta sin delta / f_delta,
#     delta' = -(f_rho a_a + f_b) / f_delta,
# in which, with the angles alpha between the path and the chord at both handles,
#     F = f_delta / 2 = b^2 delta + b rho_a (1 - cos delta) + rho_a rho_b sin delta = c sqrt(b^2 + rho_b^2) cos alpha_b,
#     f_rho / 2 = (rho_a + rho_b) (1 - cos delta),    f_b / 2 = b delta^2 + rho_a delta (1 - cos delta),
#     F - b f_rho / 2 = b^2 delta cos delta - b rho_a (1 - cos delta) + rho_a rho_b sin delta
#                     = c sqrt(b^2 + rho_a^2) cos alpha_a  =: A.
# While delta < pi and no handle reverses (F > 0, A >= 0) 1 - b f_rho / f_delta = A / F is in [0, 1], and, as
# F >= b^2 delta + rho_a rho_b sin delta, 0 <= z <= Z = delta m / (1 + m) with m = rho_a rho_b / b^2. So with
# g_b = g_a + Z 0 <= a_b <= g_b <= psi_b and delta' <= 0: radii grow with b, angles fall. Further
#     |delta'| <= ((2 g_a + delta) t + (b / rho_a) delta^2 / sin delta) / rho_a,  as F >= rho_a rho_b sin delta,
#     |delta'| <= ((g_a (rho_a + rho_b) + rho_a delta) (1 - cos delta) + b delta^2) / F,
# t = tan(delta / 2); the lesser of both is D, and |psi_b'| <= Q_b = Q_a + D.
# Radii also grow with r_0, and angles fall, so over r_0 in [r_L, r_R] and b in [b_L, b_R] the angles, and the least
# radii, are those at (r_L, b_L) and the largest radii those at (r_R, b_R). That needs no more than F > 0 and A >= 0 on
# the rectangle, link by link: delta, a first root, falls wherever f grows, with rho_a and with b; so it lies between
# its values at the two corners once rho_a does, these bound F and A (rho_b = rho_a + b delta), and F > 0, A >= 0 make
# rho_b grow too.
#
# Turning. In the frame that turns with handle a, P_a' = a_a R_a and P_b' = a_b R_b + rho_b delta' T_b, so u turns at
# psi_a' + w / c with, as T_a . u = -rho_b sin delta / c, T_b . u = -rho_a sin delta / c, rho_a sin delta <= c,
#     |w| <= |a_b - a_a| + a_a b delta min(1 / rho_a, delta / c) + rho_b |delta'| q,
#     |a_b - a_a| <= max(Z, a_a b f_rho / f_delta),   b f_rho / f_delta <= 2 b t / rho_a,
#     q = |R_b . u| = (b delta + rho_a (1 - cos delta)) / c.
#
# Second derivatives. P'' = psi'' S + B, S = b R + rho T, B = (2 psi' - rho psi'^2) R + 2 a psi' T. From |P_a - P_b| = c
#     psi_b'' S_b . u = psi_a'' S_a . u + (B_a - B_b) . u + |P_a' - P_b'|^2 / c,
# in which, written out with psi_b' = psi_a' + delta', all that a common rotation psi_a' contributes cancels:
#     E = 2 psi_a' (R_a - R_b) . u + w^2 / c + (rho_b delta'^2 - 2 delta') R_b . u - 2 a_b delta' T_b . u,
#     |E| <= 2 Q_a delta + w^2 / c + (rho_b D + 2) D q + 2 g_b D.
# S points along the path, |S_a| <= |S_b|, and S . u = -|S| cos alpha with cos alpha_a <= cos alpha_b (Vogt: neither
# angle exceeds pi / 2, so arc and chord bound a convex figure, and the arc is curved more at its inner end a).
# So for y = |psi''| |S|:  y_b <= y_a + |E| / cos alpha_b, where cos alpha_b is F / (c sqrt(b^2 + rho_b^2)); and, while
# that is below 1, sin alpha_b <= k c / 2, where k = (rho^2 + 2 b^2) / (rho^2 + b^2)^(3/2) is at most
# 2 / (1.5^(3/2) rho) < 1.0887 / rho for every b. Then
#     |P'| <= sqrt(g^2 + rho^2 Q^2),   |P''| <= y + sqrt((2 Q + rho Q^2)^2 + 4 g^2 Q^2).
# A corner is (1/2 + x / c) P_a + (1/2 - x / c) P_b, |x| = half length, plus half a width across u, and |u''| is at most
# 2 |P''| / c: it accelerates by at most (length + width) / c times its handles.
#
# The gap along an axis e. At each r_0 let e turn evenly from a normal of bench m at b_L to the same normal at b_R, at a
# rate kappa <= |u_m'| then. For corners X of i and Y of j, p = Y - X,
#     |(e . p)''| <= |X''| + |Y''| + 2 kappa (|X'| + |Y'|) + kappa^2 |p|  =: K,
# so the gap is at least what least_between() makes of its least values on b = b_L and on b = b_R, K and b_R - b_L;
# these come from both ends of the step in r_0 by gap_curvature.py. Four gaps prove a whole rectangle of (r_0, b).


# Rounding. Gaps are as good as pairs.py says. For the bounds above, widths are widened by the error of a travel and by
# BAND_ROUNDING (pairs.py) of themselves. The radii at which the chains of b_L and of b_R begin and end a step are equal
# to within a rounding of theta, a travel of theta u r each. So the least values on b = b_L and on b = b_R are lowered
# by the change of the gaps over 4 theta u r beyond both ends, which their mean slope and the curvature over the step
# bound.
#
# shift_bounds() is good to BAND_ROUNDING of its results. It adds up products of terms >= 0, with fewer than
# 60 roundings for each bench. These terms are angles between handles, with errors of 2 SLIP / r, at most 1e-12 of
# themselves (rounding.py) up to a radius of some 2,000 chords, and sines and tangents of half these angles, whose
# errors are at most 1e3 times larger because delta stays ACROSS below pi. Further out angles are small, where a tangent
# enlarges nothing: 3e-10 at 6e5 chords, and the bounds for rings and straight lines answer before a band is marched.
# The only difference is `front`, A above, of which only the sign matters: it must exceed BAND_ROUNDING of its terms.
# sqrt(1 - c^2) has 4e-5 c^2 to spare under the root: 2 / 1.5^(3/2) is that much less than SPIRAL_CURVATURE_MOST.
ACROSS = 1e-3  # [rad]


# Input:  the growths `low` and `high` of a band; the chain at (r_L, b_L), `inner`, and that at (r_R, b_R), `outer`.
# State:  of the handle in front, in the symbols above: `grown` is g, `slides` Q, `path_pull` y, `speed` |P'|.
# Output: a row of shifts for each of the first benches.
def shift_bounds(low, high, benches, sizes, inner, outer, shifts):
    """Fill in bounds on the shift of the first benches with the growth.

    returns: False if a handle may reverse on the rectangle, because there are no bounds then
    """
    grown = slides = path_pull = speed = 0.0
    for k in range(benches):
        chord = sizes[k, CHORD]
        delta = inner[k + 1, THETA] - inner[k, THETA]
        least = outer[k + 1, THETA] - outer[k, THETA]
        if delta >= PI - ACROSS:
            return False
        s = sin(0.5 * delta)
        c = cos(0.5 * delta)
        versine = 2.0 * s * s
        rho = low * inner[k, THETA]
        rho_far = high * outer[k, THETA]
        rho_b = high * outer[k + 1, THETA]
        sines = min(sin(least), 2.0 * s * c) * (rho * (rho + low * least))
        half_least = sin(0.5 * least)
        slope = low * low * least + 2.0 * low * rho * half_least * half_least + sines
        wound = low * low * least if versine < 1.0 else high * high * delta
        front = wound * (1.0 - versine) - high * rho_far * versine + sines
        if front <= BAND_ROUNDING * (high * rho_far * versine + sines) or slope <= 0.0:
            return False
        m = rho_far * rho_b / (low * low)
        extra = delta * m / (1.0 + m)
        lean = (high * delta + rho_far * versine) / chord
        slide = ((2.0 * grown + delta) * s / c + high * delta * delta / (2.0 * s * c * rho)) / rho
        parts = 2.0 * grown * high * s / (c * rho)
        f_rho = versine * (rho_far + rho_far + high * delta)
        if grown * high * f_rho < parts * slope:
            parts = grown * high * f_rho / slope
        f_rest = grown * f_rho + versine * rho_far * delta + high * delta * delta
        if f_rest < slide * slope:
            slide = f_rest / slope
        arm = delta * rho if delta * rho < chord else chord
        w = (extra if extra > parts else parts) + grown * high * delta * arm / (rho * chord) + rho_b * slide * lean
        shifts[k, SHIFT_OMEGA] = slides + w / chord
        sine_b = 0.5 * SPIRAL_CURVATURE_MOST * chord / rho
        cos_b = sqrt(1.0 - sine_b * sine_b) if sine_b < 1.0 else 0.0
        cos_slope = slope / (chord * sqrt(high * high + (rho_far + high * delta) * (rho_far + high * delta)))
        e = 2.0 * slides * delta + w * w / chord + (rho_b * slide + 2.0) * slide * lean + 2.0 * (grown + extra) * slide
        path_pull += e / (cos_b if cos_b > cos_slope else cos_slope)
        slides += slide
        grown += extra
        speed_b = sqrt(grown * grown + rho_b * rho_b * slides * slides)
        shifts[k, SHIFT_CENTRE] = 0.5 * (speed + speed_b)
        shifts[k, SHIFT_CORNER] = 0.5 * (speed + speed_b) + shifts[k, SHIFT_OMEGA] * sizes[k, RADIUS]
        outwards = slides * (2.0 + rho_b * slides)
        aside = 2.0 * grown * slides
        pull = 2.0 * (path_pull + sqrt(outwards * outwards + aside * aside))
        shifts[k, SHIFT_PULL] = pull * (sizes[k, HALF_LENGTH] + sizes[k, HALF_WIDTH]) / chord
        speed = speed_b
    return True


# Input:  a band of growths (low, high: their intervals), the head radii from `outer` to `inner`, and the number of
#         benches that lead pairs (leaders).
# State:  `radius` and `place` of the head at the lowest growth; h, the travel to try there; `placed`, the last handle
#         that the chains at the beginning have; `bounded`, whether bounds were known in the last step.
# Output: the record Marched.
class BandMarch(MarchState):
    """All growths between two at once, proven clear while the head goes inwards.

    A pair that meets does so at the lowest growth.
    """

    def __init__(self, low, high, shifts):
        super().__init__()
        self.band = Band(low, high, shifts)
        self.leaders = self.placed = 0
        self.radius = self.place = self.h = self.rounding = 0.0
        self.bounded = True

    def run(self, outer, inner, leaders, rounding, least_step, most_work):
        """Prove that no pair led by the first `leaders` benches touches while the head goes from `outer` to `inner`.

        outer, inner: head radii [m]; rounding: largest error of a travel of the head [m]; least_step: head travel below
        which it gives up [m]; most_work: work after which it gives up
        returns: a Marched that is REACHED; TOUCHED at the lowest growth; STUCK: not provable in one band; UNBOUNDED or
        BENCH_FOLDED: perhaps not provable in any band, because a handle may move backwards or a bench folds; CAPACITY
        """
        low = self.band.low.scene.curve.growth
        self.begin(outer)
        self.radius = outer
        self.place = low * spiral_arc(outer / low)
        self.h = self.band.low.scene.rings.shortest
        self.leaders = self.placed = leaders
        self.rounding = rounding
        self.bounded = True
        with cython.nogil:
            self.march(self.band.low.scene, self.band, inner, least_step, most_work)
        return self.result()

    def march(self, scene, band, inner, least_step, most_work):
        """Take steps to the end."""
        if self.leaders > scene.room:
            return self.end(Ended.CAPACITY)
        start_chain(self.radius / scene.curve.growth, band.low.before)
        start_chain(self.radius / band.high.scene.curve.growth, band.high.before)
        if extend_chain(scene.curve.growth, 0, self.leaders, FREE, scene.sizes, band.low.before) == FOLDED:
            return self.end(Ended.BENCH_FOLDED)
        if extend_chain(band.high.scene.curve.growth, 0, self.leaders, FREE, scene.sizes, band.high.before) == FOLDED:
            return self.end(Ended.BENCH_FOLDED)
        while self.radius > inner:
            self.proven = self.radius
            if not self.bounded and self.h < BACKWARDS_WITHIN * self.radius:
                return self.end(Ended.UNBOUNDED)
            if self.h < least_step or self.work >= most_work or scene.budget.stopped:
                return self.end(Ended.STUCK)
            self.steps += 1
            if self.try_step(band, inner) == Step.ENDED:
                return Step.ENDED
        self.proven = self.radius
        return self.end(Ended.REACHED)

    def try_step(self, band, inner):
        """Try one step inwards; REFUSED if the next one must be shorter."""
        low = band.low.scene.curve.growth
        high = band.high.scene.curve.growth
        next_radius = low * spiral_theta((self.place - self.h) / low)
        if next_radius <= inner:
            next_radius = inner
            self.h = self.place - low * spiral_arc(inner / low)
        h_high = high * (spiral_arc(self.radius / high) - spiral_arc(next_radius / high))
        if self.lay_out(band, next_radius) == Step.ENDED:
            return Step.ENDED
        self.work += CHAIN_WORK * (STEP_WORK + band.low.handles)
        band.low.h = self.h * (1.0 + BAND_ROUNDING) + 2.0 * self.rounding
        band.high.h = h_high * (1.0 + BAND_ROUNDING) + 2.0 * self.rounding
        band.width = (high - low) * (1.0 + BAND_ROUNDING)
        band.slack = 4.0 * ULP * low * band.low.before[0, THETA] * band.low.before[0, THETA]
        self.bounded = band.low.bound(False) and band.high.bound(False) and shift_bounds(
            low, high, band.low.handles, band.low.scene.sizes, band.low.after, band.high.before, band.shifts
        )  # fmt: skip
        if self.bounded:
            nearest = band_least(band.low.scene, band, self.leaders)
            self.bounded = nearest.least != NO_BOUND
        if not self.bounded:
            self.h *= 0.5
            return Step.REFUSED
        width = 0.95 * nearest.width
        self.work += nearest.tried
        if nearest.least <= band.low.scene.margin:
            if row_gap(band.low.scene, nearest.first, nearest.second, band.low.after) <= band.low.scene.margin:
                self.first = nearest.first
                self.second = nearest.second
                self.meet(next_radius)
                return self.end(Ended.TOUCHED)
            self.h *= 0.5 if width < 0.5 * self.h or width >= self.h else width / self.h
            return Step.REFUSED
        self.radius = next_radius
        self.place -= self.h
        self.placed = band.low.handles
        band.low.swap()
        band.high.swap()
        self.h = min(width, 2.0 * self.h)
        return Step.ADVANCED

    def lay_out(self, band, next_radius):
        """Lay out the four chains of a step, as far as the leaders reach; returns ADVANCED or ENDED."""
        low = band.low.scene.curve.growth
        high = band.high.scene.curve.growth
        start_chain(next_radius / low, band.low.after)
        start_chain(next_radius / high, band.high.after)
        if extend_chain(low, 0, self.leaders, FREE, band.low.scene.sizes, band.low.after) == FOLDED:
            return self.end(Ended.BENCH_FOLDED)
        rear = high * band.high.before[self.leaders, THETA]
        slack = CLEAR_SPARE * high * band.high.before[self.leaders, THETA]
        beyond = leaders_reach(high, next_radius, rear + slack, band.low.scene.rings) + band.low.scene.margin
        beyond = radius_beyond(high, beyond, band.low.scene.rings) + slack
        room = band.low.scene.room
        handles = extend_chain(low, self.leaders, room, beyond, band.low.scene.sizes, band.low.after)
        if handles == FOLDED:
            return self.end(Ended.BENCH_FOLDED)
        if handles == room and room < band.low.scene.benches:
            return self.end(Ended.CAPACITY)
        if extend_chain(high, 0, handles, FREE, band.low.scene.sizes, band.high.after) == FOLDED:
            return self.end(Ended.BENCH_FOLDED)
        if self.placed < handles:
            if extend_chain(low, self.placed, handles, FREE, band.low.scene.sizes, band.low.before) == FOLDED:
                return self.end(Ended.BENCH_FOLDED)
            if extend_chain(high, self.placed, handles, FREE, band.low.scene.sizes, band.high.before) == FOLDED:
                return self.end(Ended.BENCH_FOLDED)
            self.placed = handles
        band.low.handles = band.high.handles = handles
        return Step.ADVANCED
