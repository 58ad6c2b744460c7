#!/usr/bin/env python3
"""Verify a certificate of `bench-dragon prove`, trusting nothing of Bench Dragon: python verify.py CERTIFICATE

Exit code 0: the certificate proves the claim that is printed. 1: it does not, for the reason that is printed. 2:
wrong usage, or a file that cannot be read. Only the standard library is used. Floating point only guesses; whole
numbers decide. The verdict rests on the mathematics written down here, and on the code below, which is in this order:
arithmetic; benches on a spiral (1. to 8.); routes (9. to 13., 17.); strays (14. to 16.); the whole dragon (5.); the
claims; the form of a certificate.


The dance and the claims
------------------------
A handle at theta >= 0 (an angle that is not reduced by whole turns, [rad]) stands at distance b theta from the
centre, b = pitch / (2 pi), in the direction theta. The head, handle 0, starts at theta = 2 pi start_turns and walks
inwards along this spiral with head_speed. Bench k is a rectangle, length x width, with handles k and k + 1 on its
long middle line, each overhang from one end, so that they are chord = length - 2 overhang apart. Handle k + 1 is the
first point at that distance which one meets from handle k outwards along the spiral. Benches k and k + 1 share a
handle, and are not judged. Two other benches touch when their rectangles have a point in common, and overlap when
their interiors have; with a margin, "touch" is "come within the margin" and "overlap" is "be nearer than the margin".
All numbers are in metres, seconds and radians, and exactly those that stand in the certificate. The claims:
  collision-time  From the start to time - 1e-10 s nothing touches, and at time + 1e-10 s two benches overlap.
  contact         The same from `start` on, on any path.
  minimum-pitch   Every bench follows and nothing touches while the head walks from the start until it is
                  turning_radius from the centre. With a pitch 1e-6 m smaller, two benches overlap while the head is on
                  that way, or a bench folds before its end (no place is left for its rear handle), or the start lies
                  within that circle. (Of other pitches it says nothing.)
  clear           From start to stop nothing touches, on any path; and, if it says so, 1e-9 s later a bench has folded,
                  the head is at the centre, or the route has ended.
  tolerance       On a spiral: while every hole is within `stray` of its handle's place and every bench keeps its
                  chord, nothing touches from start to stop; and, if it says so, in one pose whose holes are within
                  `shown` of their places two benches overlap.
Paths are a spiral, a turn (13.), and a route: lines, arcs and coils, each moved so that it continues the one before
it in place and direction, as far as they miss one another by at most 1e-9; only a line may meet the line before it at
an angle, a corner. Beyond its ends a route continues. If it has corners, or bends more tightly than 9. allows, it is
also shown that every bench follows: its rear handle goes forwards and never jumps, at an angle from the bench whose
cosine is more than 0.0447 (87.438 degrees).

A certificate has `dragon`, runs of benches alike from the head on as [how many, length, width, overhang]; `claim`;
what the claim needs in `overlap` (6., 8., 16.); and the `sweeps`, u + 1 with u = `repeats_from` (5.): sweep a has the
bench a, and stretches [highest place, lowest place, faces] of its front handle (3.), with the angles of the faces 8 as
fourth entry. `versions` and `precision` say how it was made and prove nothing; `digest` tells accidents, for it is
easily made to fit.


Arithmetic
----------
An Interval has two whole numbers lo <= hi and stands for all reals from lo / 2^BITS to hi / 2^BITS. Every operation
rounds outwards, so that it encloses all results for all reals in its operands; x < y says that it holds for all of
them.
  log   log(y) = 2 log(sqrt y), and for 1 <= y <= 1 + 1/32 it is 2 (x + x^3/3 + x^5/5 + ...), x = (y - 1) / (y + 1),
        at most 1/65. After the term of x^21 less than x^23 / 22 is left, and that is less than a unit (2^-BITS).
  cos   At one point: k half turns are subtracted, |k| < 200,000, which leaves |t| < 1.571, and adds 200,000 times the
        width of PI, 3 units. Then 1 - t^2/2! + ... - t^42/42!, whose rest is below t^44/44! < 2^-151. Each term is the
        one before times -t^2 / (n (n + 1)), rounded twice: no term is off by more than 3 units. All this is below
        COSINE_ERROR. Over an interval cos lies between its values at the ends, and +-1 at the whole half turns
        inside.
  atan  atan x = 2 atan(x / (1 + sqrt(1 + x^2))), five times, which leaves |x| < 0.05; then x - x^3/3 + ... - x^23/23 +
        x^25/25, whose rest is below x^27/27, 60 units. Each term is rounded twice, by less than 3 units in all; all
        this is below ATAN_ERROR. arc sine x = atan(x / sqrt(1 - x^2)).
  root  A continuous function that rises takes a value between two places if it takes less at one and more at the
        other. If it rises all over an interval, from a point x of it, its root lies in x - value(x) / slope(interval),
        if that is inside of the interval (Newton).
A Moving number is a function of theta with its derivative, both as intervals; sums and products have the usual rules.


1. The next handle
------------------
The points of the spiral at theta and theta + d are b sqrt(F) apart, by the law of cosines, with
    F(theta, d) = theta^2 + (theta + d)^2 - 2 theta (theta + d) cos d = d^2 + 2 theta (theta + d) (1 - cos d).
So from a handle at theta to the next one the angle grows by the bend d: the first d > 0 with F(theta, d) = needed,
where needed = (chord / b)^2. The derivatives:
    F_theta = 2 (2 theta + d) (1 - cos d) >= 0
    F_d     = 2 d + 2 theta (1 - cos d) + 2 theta (theta + d) sin d, positive for 0 < d <= pi
    F_dd    = 2 + 4 theta sin d + 2 theta (theta + d) cos d
bend_at() encloses d by a smaller value at its lower end and a larger one at its upper end. That is the first root if
F rises up to the upper end: up to pi it does; beyond, if F_dd < 0 from pi to there and F_d > 0 there, then F_d falls
to that positive value. Where theta varies over [p, q], F grows with theta: nothing below d(q) is a root, and at d(p)
F has reached needed. So all bends lie between d(q) and d(p), which is what bend() encloses.

2. A row of benches over a stretch
----------------------------------
The front handle of bench a goes through all theta in [m, M]. The handles behind it are at theta[0] = theta and
theta[k + 1] = theta[k] + d(theta[k]). Let P be an interval with all theta[k], and D one with their bends (1.). If F_d
> 0 all over P x D, there is no other root in D; d is smooth, d' = -F_theta / F_d, and by the chain rule
    rate[0] = 1,   rate[k + 1] = rate[k] (1 + d'),   where rate[k] is the derivative of theta[k] with respect to theta.
Where a rate is not 0 all over the stretch, its function is monotone, and stays between its values at m and M.
Otherwise the mean value theorem says: it stays in its value at m + rate [0, M - m]. This holds for theta[k], and for
the turn theta[k] - theta, whose rate is rate[k] - 1. In the frame that turns with the front handle, handle k is at b
theta[k] (cos turn, sin turn). A bench has its centre at (front + rear) / 2 and the direction (front - rear) / chord.
At m and at M alone, all this is known to many digits.

3. Two benches apart all over a stretch
---------------------------------------
They do not touch if all four corners of one lie beyond one face of the other. The digit in faces names it: 0 to 3 the
front, left, rear and right face of bench a, 4 to 7 those of the bench behind; the first digit is for bench a + 2, the
next for a + 3, and so on. Let n point out of that face, half be its distance from the centre of its bench, D lead
from that centre to the centre of the other bench, with direction u, and left u = u turned left. Then the corners are
beyond by
    g = n.D - half +- (length / 2) n.u +- (width / 2) n.(left u).
Let D1 <= g' <= D2 on [m, M], w = M - m, g(m) > 0 and g(M) > 0. If D1 >= 0 or D2 <= 0, g is monotone, and positive. If
not, g >= g(m) + D1 (theta - m) and g >= g(M) - D2 (M - theta). For both to be <= 0 at one theta, w >= g(m) / -D1 +
g(M) / D2 is needed; hence g > 0 everywhere if D2 g(m) - D1 g(M) + D1 D2 w > 0. A stretch over which this is not shown
is halved, and its halves, a few times.

4. Benches that are far away
----------------------------
A point that divides a chord c between r1 and r2 from the centre as s : 1 - s is r from it, r^2 = s r1^2 + (1 - s)
r2^2 - s (1 - s) c^2 >= min(r1, r2)^2 - c^2 / 4. No point of a bench is farther than h = hypot(overhang, width / 2)
from its chord. Handles lie farther and farther out. So with c and h the largest of the dragon, all benches from
handle k on are apart from bench a if r[k]^2 - c^2 / 4 > (r[a + 1] + h[a] + h)^2: they lie outside a circle that has
bench a inside. And those handles exist: r[k] > c / 2 gives F(theta, pi) > 4 theta^2 > needed.

5. The whole dragon all the way
-------------------------------
Sweep 0 covers the head's way with stretches that join. Sweep a + 1 covers all places of handle a + 1 while handle a
passes the stretches of sweep a. Over each stretch bench a is shown apart from the benches a + 2, a + 3, ... one by
one, until all others are far or there are none. n benches have all their pairs in the sweeps 0 to n - 3. (One or two
have none; then u = 0, and sweep 0 shows that there is always a next handle.) But if the benches from u on are alike,
sweep u serves for all later ones. For all handles follow one spiral: with handle k at theta, k > u, the benches
behind it lie as those behind handle u do with handle u at theta, only that k - u of them are missing at the end.
Sweep u must then reach as far out as the handles u to n - 3 come: let P[u] be the largest
theta of handle u, and P[k + 1] = f(P[k]), f(theta) = theta + d(theta). No handle k >= u passes P[k]. Suppose theta[k]
<= P[k]. If f is shown to rise (rate[1] > 0) on all stretches from theta[k] up to P[k], then theta[k + 1] =
f(theta[k]) <= f(P[k]). Else f rises from theta[k] up to a stretch on which that is not shown; there, f is shown not
to pass P[u + 1], and P[u + 1] <= P[k + 1]. The lowest place of sweep u is that of handle u, for later handles are
farther out. A stretch wholly above P[u], ..., P[u + s - 1] is passed only by handles u + s and later, so that s
benches are missing there: bench u needs no pair with the last s benches.

6. The overlap
--------------
Two rectangles overlap if for each face of either, some corner of the other lies before it, not beyond or on it:
convex polygons whose interiors do not meet are separated by the line along an edge of one of them.
The head at an instant: from the centre to theta the spiral is
    b / 2 (theta sqrt(1 + theta^2) + log(theta + sqrt(1 + theta^2)))
long. This rises with theta; at the instant t it is head_speed t less than at the start.

7. Margins
----------
If all corners of a bench lie more than the margin beyond a line that touches the other bench, the benches are farther
apart than the margin, because their distance is no less than that of their projections onto its normal. Face 8 is such
a line, whose normal has a given angle with bench a. Two benches are nearer than the margin if they overlap, or if some
corner of one, x and y beyond the nearer of two opposite faces of the other (0 between them), has x^2 + y^2 < margin^2.

8. A fold
---------
Bench k folds while the head goes from M in to m. Until then all handles up to k follow continuously, and so does the
bend d of bench k, from d1 on. Let T be above all places of its front handle on that way. If F(T, D) < needed for some D
> d1, then F(theta, D) < needed for all theta <= T by 1.: d never equals D, so it stays below. If moreover at m, where
the front handle is at t, F(t, d) < needed for all d in [0, D], no root is left there. This is shown piece by piece,
from the middle of a piece by the mean value theorem.

9. Routes
---------
The place of a handle is z = -s, s the arc length, so that it falls as theta does; f(z) is the place of the next handle,
the first point behind at its chord c. Let the curvature be in [k1, k2] from there to here, K the larger of |k1| and
|k2|, k0 the least |curvature| (0 if the sign may change), and l the length between. With the direction of travel phi
and the direction psi of the chord, alpha = phi - psi at the front and beta = phi - psi at the rear.
If K l <= pi, then alpha and -beta lie in [k1 l / 2, k2 l / 2]: put the rear at 0 with phi(0) = 0, then the chord is V,
the integral of exp(i phi) over [0, l]. With h = k2 l / 2, Im(V exp(-i h)) is the integral over [0, l / 2] of sin(phi(t)
- h) + sin(phi(l - t) - h) = 2 sin(M) cos(N), |N| = |phi(t) - phi(l - t)| / 2 <= K l / 2 <= pi / 2, M = (phi(t) +
phi(l - t)) / 2 - h between -K l / 2 - h >= -pi and k2 l / 2 - h = 0: it is 0 or less. Likewise Im(V exp(-i k1 l / 2))
>= 0. So the argument of V, -beta, lies between the two; alpha by travelling backwards. The distance of the two points
grows with l by cos(beta), between cos(K l / 2) and cos(k0 l / 2); so a point behind at distance c with K l <= pi is
the first one, and (2 / k0) asin(k0 c / 2) <= l <= (2 / K) asin(K c / 2). Over a stretch with K c < 2 all along, f does
not fall: seen from the fixed point R = f(M) the distance of the point at z falls with z while K (R - z) <= pi, so at R
it is c or more, and f(z) does not exceed f(M). So handles between are enclosed by those at the two ends, and
    f' = cos(alpha) / cos(beta) > 0, for the chord keeps its length.
alpha and beta change by k - psi' and f' k - psi' for each metre of the front handle's way, psi' = (sin(alpha) - f'
sin(beta)) / c. No place of a stretch is farther than half of it from the nearer end, so they also differ from their
values there by at most this half times these rates. On one line or arc they do not change.

10. The motion of a bench on a route, as seen from another
----------------------------------------------------------
With the speed r of the front handle of a bench (r of the next one is f' r), its centre has the velocity v =
r (cos(alpha), (sin(alpha) + f' sin(beta)) / 2) in its own frame, and it turns at w = r psi'. Seen from bench a, in the
frame of a, bench b has its centre at q and the direction e:
    e' = i (w_b - w_a) e,   q' = e v_b - v_a - i w_a q,   |q|' <= |e v_b - v_a|.
Each encloses e and q from either end of the stretch through half of it. So 3. applies with g' from e, e', q and q'.

11. Circles
-----------
Face 9: two benches are apart if their centres are farther apart than the sum of their half diagonals. By the last of
10. this distance is never less than half the sum of its values at both ends, less half of |e v_b - v_a| times w.

12. The tail on a coil
----------------------
If the first piece of a route coils inwards, it continues outwards. From a handle on it outwards 4. holds if bench a is
inside the circle. A point of the way of its handle is no farther from the centre than half the sum of that way's length
and of its distances at both ends.

13. The turn
------------
Two arcs of radii r1 = ratio r2 and r2 lead from the coil inwards, at entry_radius with polar angle theta, to its copy
rotated by half a turn, at exit_radius (if there is none, at entry_radius), tangent to both and to one another. As
complex numbers, P(theta) = b theta exp(i theta) is a point of the coil and n = i exp(i theta) (1 + i theta) / sqrt(1 +
theta^2) the unit vector to the right of the direction of travel. With E, n1 of the entry and X, n2 of the coil at
exit_radius, the centres are E + r1 n1 and -X - r2 n2, and r1 + r2 apart: with A = E + X and B = ratio n1 + n2
    |A + r2 B| = (1 + ratio) r2,   so   r2 = |A|^2 / (sqrt(h^2 + ((1 + ratio)^2 - |B|^2) |A|^2) - h),   h = Re(A B*),
B* the conjugate of B.
With w the direction from the first centre to the second one, the first arc turns clockwise from -n1 to w, by the
argument of -n1 / w between 0 and a whole turn, the second one by that of -n2 / w, for it turns from -w to n2. The angle
of z is pi more than that of -z, which is 2 atan(y / (|z| + x)) for -z = x + i y.

14. Strays
----------
Let the two holes of a bench be within d of their places, d < c, and its chord c be kept. Its ground is the union of
all its possible places, in the frame of its nominal place. Two benches do not touch if their grounds do not meet, and
4. holds with h + d for h. Cut the bench across at its holes: each of the three parts is the convex hull of its corners
wherever it is, so a polygon of SIDES half planes, evenly spaced, that holds all places of its corners holds the part;
a fourth polygon, with the largest of the three supports in each direction, holds the ground.
Let the bench rotate by phi, q = c sin(phi / 2): one hole moves by m + i q exp(i phi / 2), the other by m - i q exp(i
phi / 2); the point p, counted from the middle of the chord, to m + exp(i phi) p. So |q| <= d, and m is in the lens of
two discs of radius d. In the direction e, with t the argument of exp(i phi / 2) / e, m comes as far as
    d - |q sin t|   where |q| <= d |sin t|,   else   |cos t| sqrt(d^2 - q^2).
The second is never more than the first, which is used where it is not decided. With q = d sin(psi), kappa = d / c,
kappa' = kappa / sqrt(1 - kappa^2): |phi'| <= 2 kappa and |phi''| <= 2 kappa'. So the second derivatives by psi are at
most d (1 + 2 kappa + kappa^2 + kappa') for m, on either range, and |p| (4 kappa^2 + 2 kappa') for exp(i phi) p. On
either side of psi = 0 values and slopes of the two ranges agree where they meet. So between two samples of psi that
are w apart nothing is more than K w^2 / 8 above the higher one, K the sum of these two bounds.

15. Two grounds apart
---------------------
In place of a face a stretch has one side of the fourth polygon of either ground, 0 to SIDES - 1 of the first and from
SIDES on of the second, or nine sides, for each of three polygons with each of three. With n the normal of the side,
let -n, seen from the other ground, lie between the directions of its sides k and k + 1: no point of that polygon is
farther along -n than the corner where these meet. So 3. needs the corners of all k that -n passes.

16. A pose
----------
It is given by its first handle and the heading of every bench, so that each chord is exact.

17. Tight bends and corners
---------------------------
Let D(z, y) be the distance of the points at the places z and y > z of a route, and u its direction from y to z; T is
the direction of travel, at a corner those on both sides. Where y grows, D grows at the rate u.T(y); where z grows, it
falls at the rate u.T(z). Each place y1 between z and y2 is *short* of y2 if D(z, y) < c all over some piece of the
route that holds y1, or D grows all over it: going from y2, where D <= c, piece by piece towards z, D stays below c. So
y2 with D = c is the first place behind, f(z), if all places between are short of it.
Over a stretch z in [m, M], let p = f(m) and q = f(M) with p <= q, u.T(z) > 0 and u.T(y) > 0 for all these z and all y
in [p, q], and let all places between m and p be short of p for all these z. Then D(z, p) <= D(m, p) = c = D(M, q) <=
D(z, q), and D grows from p to q: there is one place in [p, q] at the distance c, and none between z and p. So f(z) is
there, f is continuous and rises, handles between are enclosed by those at the two ends, and between corners f' =
cos(alpha) / cos(beta) > 0. As u.T(y) is cos(beta) at y = f(z) and u.T(z) is cos(alpha), angles and points of the whole
stretch enclose alpha and beta; the rates of 9. do so too, with the curvature at the handle, unless it passes a corner.
There the velocities of 10. jump, but places do not: 3. and 11. need the rates only between the jumps.
"""

import argparse
import hashlib
import json
import math
import re
import sys
from bisect import bisect_left
from fractions import Fraction
from functools import lru_cache

# COSINE_ERROR is in units, TIME_BRACKET in seconds, PITCH_STEP in metres.
BITS, UNIT, COSINE_ERROR, TIME_BRACKET, PITCH_STEP = 128, 1 << 128, 1 << 20, Fraction(1, 10**10), Fraction(1, 10**6)
END_BRACKET = Fraction(1, 10**9)  # [s], after which a run that is said to end is over
# Limits on the work: of the bytes and benches of a certificate, and of the bends (1.) that it needs; what is left.
BYTES_MOST, BENCHES_MOST, BENDS_MOST, LEFT = 1 << 24, 10_000_000, 5_000_000, [0]
# The largest angle of which a cosine is known [rad]; the error of the series of an arc tangent [units].
ANGLE_MOST, ATAN_ERROR = 600_000, 1 << 7
# A guess from floats is within this of its root [units].
NEAR = 1 << 102
# Pieces of an angle into which the proof of a fold (8.) may be cut.
PIECES_MOST = 10_000
MALFORMED = "the certificate is malformed"


class Refused(ValueError):
    """The certificate does not prove its claim."""


class Loose(Refused):
    """Not shown all over a stretch; it may be over each half."""


class Interval:
    """All reals from lo / UNIT to hi / UNIT."""

    def __init__(self, lo, hi):
        self.lo, self.hi = lo, hi

    def __add__(self, other):
        return Interval(self.lo + other.lo, self.hi + other.hi)

    def __sub__(self, other):
        return Interval(self.lo - other.hi, self.hi - other.lo)

    def __mul__(self, other):
        products = self.lo * other.lo, self.lo * other.hi, self.hi * other.lo, self.hi * other.hi
        return Interval(min(products) >> BITS, -(-max(products) >> BITS))

    def __truediv__(self, other):
        if other.lo <= 0:
            raise Loose("not proven: a divisor is not shown to be positive")
        lo, hi = self.lo << BITS, self.hi << BITS
        return Interval(min(lo // other.lo, lo // other.hi), -min(-hi // other.lo, -hi // other.hi))

    def __lt__(self, other):
        return self.hi < other.lo

    def __float__(self):
        return self.lo / UNIT

    def __abs__(self):
        low = 0 if self.lo <= 0 <= self.hi else min(abs(self.lo), abs(self.hi))
        return Interval(low, max(abs(self.lo), abs(self.hi)))


def exactly(number):
    """A whole number, a float or a fraction as it stands."""
    over, under = number.as_integer_ratio()
    return Interval((over << BITS) // under, -((-over << BITS) // under))


def hull(*values):
    return Interval(min(x.lo for x in values), max(x.hi for x in values))


def around(x):
    """All numbers up to the largest |x|."""
    most = max(abs(x.lo), abs(x.hi))
    return Interval(-most, most)


def sqrt(x):
    """Square root of an interval, for x >= 0."""
    return Interval(math.isqrt(x.lo << BITS), math.isqrt(x.hi << BITS) + 1)


ZERO, HALF, ONE, TWO = (exactly(number) for number in (0, 0.5, 1, 2))
# Shortest piece of a route, largest gap of a joint [m] or kink [rad].
SHORTEST, JOINED = exactly(1e-6), exactly(1e-9)
# Largest curvature times a chord for which 9. is used, cos(beta) that 17. needs [1], and the work that 17. may take.
GENTLE, FOLLOWS, PARTS_MOST, STEPS_MOST = exactly(Fraction("1.9980001")), exactly(Fraction("0.0447")), 2_000, 2_000
PI = exactly(Fraction(31415926535897932384626433832795028841971693993751, 10**49)) + Interval(-1, 1)


def log(y):
    """Natural logarithm of an interval, for y >= 1."""
    if y.hi > UNIT + (UNIT >> 5):
        return TWO * log(sqrt(y))
    x = total = power = (y - ONE) / (y + ONE)
    square = x * x
    for n in range(3, 23, 2):
        power = power * square
        total = total + power / exactly(n)
    return TWO * (total + Interval(0, 1))


def cos(x):
    if x.hi - x.lo > 6 * UNIT or abs(x.lo) > ANGLE_MOST * UNIT:
        return Interval(-UNIT, UNIT)
    half_turns = range(x.lo // PI.lo - 1, x.hi // PI.lo + 2)
    values = [-UNIT if k % 2 else UNIT for k in half_turns if x.lo - COSINE_ERROR <= k * PI.lo <= x.hi + COSINE_ERROR]
    for end in {x.lo, x.hi}:
        k = (2 * end + PI.lo) // (2 * PI.lo)
        square, total, term = (end - k * PI.lo) ** 2 >> BITS, 0, UNIT
        for n in range(1, 45, 2):
            total += term
            term = -(term * square >> BITS) // (n * (n + 1))
        values.append(-total if k % 2 else total)
    return Interval(min(values) - COSINE_ERROR, max(values) + COSINE_ERROR)


def sin(x):
    return cos(x - PI * HALF)


def atan(x):
    """Arc tangent of an interval, which rises."""
    return Interval(atan_at(x.lo).lo, atan_at(x.hi).hi)


def atan_at(place):
    x = Interval(place, place)
    for _ in range(5):
        x = x / (ONE + sqrt(ONE + abs(x) * abs(x)))
    total, term = x.lo, x.lo
    square = term * term >> BITS
    for n in range(3, 27, 2):
        term = -(term * square >> BITS)
        total += term // n
    return Interval((total - ATAN_ERROR) << 5, (total + ATAN_ERROR + x.hi - x.lo) << 5)


def arcsine(x):
    """Arc sine of an interval within (-1, 1)."""
    return atan(x / sqrt(ONE - abs(x) * abs(x)))


def root(rising, wanted, reached, most):
    """Guess, in floats, of the place at which a rising function takes a value. reached(x): True there and above."""
    scale, step = int(most * 2.0 ** (BITS - 56)), UNIT >> 40
    x = scale * bisect_left(range(1 << 56), True, key=lambda k: reached(k * most * 2.0**-56))
    value, further = (rising(Interval(end, end)).lo for end in (x, x + step))
    x += (wanted.lo - value) * step // max(1, further - value)
    for radius in (1 << 36, 1 << 56, 1 << 76, 1 << 96):
        low, high = (Interval(end, end) for end in (x - radius, x + radius))
        if x > radius and rising(low) < wanted < rising(high):
            return hull(low, high)
    raise Refused("not proven: there is no root where floats see one")


def double_above(place):
    """A double above place / UNIT, as units."""
    return exactly(math.nextafter(place / UNIT, math.inf)).hi


def newton(guess, value, slope):
    """The root near a guess of a function that rises there: twice a step of Newton's method in intervals."""
    for _ in range(2):
        guess = exactly(guess)
        near = Interval(guess.lo - NEAR, guess.hi + NEAR)
        found = guess - value(guess) / slope(near)
        if not near.lo < found.lo <= found.hi < near.hi:
            raise Loose("not proven: there is no root where floats see one")
        guess = Fraction(found.lo + found.hi, 2 * UNIT)
    return found


class Moving:
    """A number that depends on theta, and its derivative."""

    def __init__(self, value, rate=ZERO):
        self.value, self.rate = value, rate

    def __add__(self, other):
        return Moving(self.value + other.value, self.rate + other.rate)

    def __sub__(self, other):
        return Moving(self.value - other.value, self.rate - other.rate)

    def __mul__(self, other):
        return Moving(self.value * other.value, self.rate * other.value + self.value * other.rate)


class Bench:
    """Half its length and width, its chord, h of 4., needed of 1."""

    def __init__(self, length, width, overhang, growth):
        self.x, self.y = exactly(length) * HALF, exactly(width) * HALF
        self.chord = exactly(length) - TWO * exactly(overhang)
        self.reach = sqrt(exactly(overhang) * exactly(overhang) + self.y * self.y)
        self.needed = self.chord / growth * (self.chord / growth)


class Chain:
    """The dragon on a spiral: growth b, start, every bench, the longest chord, the largest h, the margin."""

    floor, gentle = 0, True

    def __init__(self, runs, pitch, turns, margin=0):
        self.margin = exactly(margin)
        self.growth, self.start = exactly(pitch) / (TWO * PI), TWO * PI * exactly(turns)
        kinds = {tuple(sizes): Bench(*sizes, self.growth) for _, *sizes in runs}
        self.benches = [kinds[tuple(sizes)] for count, *sizes in runs for _ in range(count)]
        self.chord = Interval(0, max(kind.chord.hi for kind in kinds.values()))
        self.reach = Interval(0, max(kind.reach.hi for kind in kinds.values()))

    def row(self, bench, low, high=None):
        return Row(self, bench, low, high)

    def places_behind(self, bench, theta, count):
        """The places of so many handles behind one, rounded up."""
        places = []
        for kind in self.benches[bench : bench + count]:
            theta = theta + bend(theta, kind)
            places.append(theta.hi)
        return places

    def arc(self, theta):
        slant = sqrt(ONE + theta * theta)
        return HALF * self.growth * (theta * slant + log(theta + slant))

    def theta_after(self, way):
        """Angle of the head after this way [rad]."""
        rest, most = self.arc(self.start) - way, 2.0 * float(self.start) + 1.0
        if not rest > ZERO:
            raise Refused("not proven: the claim reaches past the centre of the spiral")
        goal = 2.0 * float(rest) / float(self.growth)
        return root(self.arc, rest, lambda t: t * math.hypot(1.0, t) + math.asinh(t) >= goal, most)


def slopes(theta, d):
    """F_theta and F_d of 1."""
    rest, outer = TWO * (ONE - cos(d)), theta + d
    return (theta + outer) * rest, TWO * d + theta * (rest + TWO * outer * sin(d))


def curving(theta, d):
    """F_dd of 1."""
    return TWO + TWO * theta * (TWO * sin(d) + (theta + d) * cos(d))


def bend(theta, bench):
    """Angle d between two handles, see 1., for every theta of an interval [rad]."""
    LEFT[0] -= 1
    if theta.lo < 0 or LEFT[0] < 0:
        raise Loose("not proven: a handle may be past the centre, or this is too much work for this verifier")
    return hull(bend_at(theta.lo, bench), bend_at(theta.hi, bench))


@lru_cache(1 << 12)  # Stretches that join have a place in common.
def bend_at(place, bench):
    """d of 1., at theta = place / UNIT."""
    theta, t, goal = Interval(place, place), place / UNIT, float(bench.needed)

    def reached(d):
        passed = d > math.pi and d + 2.0 * t * math.sin(d / 2.0) ** 2 + t * (t + d) * math.sin(d) < 0.0
        return passed or d * d + 4.0 * t * (t + d) * math.sin(d / 2.0) ** 2 >= goal

    d = root(lambda d: d * d + TWO * theta * (theta + d) * (ONE - cos(d)), bench.needed, reached, 4.5)
    if not (d < PI or (curving(theta, hull(PI, d)) < ZERO and slopes(theta, Interval(d.hi, d.hi))[1] > ZERO)):
        raise Refused("not proven: the next handle is not shown to be the first behind")
    return d


def stays_positive(low, high, slope, width):
    """True if, by 3., what is positive at both ends and changes at these rates is positive between them."""
    least, most = Interval(slope.lo, slope.lo), Interval(slope.hi, slope.hi)
    return not slope.lo < 0 < slope.hi or most * low - least * high + least * most * width > ZERO


class Placed:
    """Benches placed one after the other: placed holds bench, centre and direction of each, in one frame."""

    def __init__(self, chain, bench):
        self.chain, self.bench, self.placed = chain, bench, []

    def gaps(self, partner, face, angle=0.0, margin=ZERO):
        """g of 3., for the four corners. partner: counted from the first bench; angle: of the normal, for face 8"""
        a, b = (partner, 0) if 4 <= face < 8 else (0, partner)
        (own, x_a, y_a, out_x, out_y), (other, x_b, y_b, along_x, along_y) = self.placed[a], self.placed[b]
        half = own.y if face % 2 else own.x
        for _ in range(face % 4):
            out_x, out_y = Moving(ZERO) - out_y, out_x
        if face == 8:
            c, s = cos(exactly(angle)), sin(exactly(angle))
            out_x, out_y = out_x * Moving(c) - out_y * Moving(s), out_y * Moving(c) + out_x * Moving(s)
            half = abs(c) * own.x + abs(s) * own.y
        to = out_x * (x_b - x_a) + out_y * (y_b - y_a) - Moving(half + margin)
        across = (out_x * along_x + out_y * along_y) * Moving(other.x)
        beside = (out_y * along_x - out_x * along_y) * Moving(other.y)
        return to + across + beside, to + across - beside, to - across - beside, to - across + beside

    def near(self, partner):
        """True if, by 7., this bench and a partner overlap, or are nearer than the margin; only at one place."""
        if all(any(gap.value < ZERO for gap in self.gaps(partner, face)) for face in range(8)):
            return True
        for here, there in ((0, partner), (partner, 0)):
            (own, x_a, y_a, ux, uy), (other, x_b, y_b, vx, vy) = (
                (bench, *(part.value for part in place)) for bench, *place in (self.placed[here], self.placed[there])
            )
            for length, width in ((1, 1), (1, -1), (-1, -1), (-1, 1)):
                along, across = other.x * exactly(length), other.y * exactly(width)
                x = x_b - x_a + vx * along - vy * across
                y = y_b - y_a + vy * along + vx * across
                beyond = abs(x * ux + y * uy) - own.x, abs(y * ux - x * uy) - own.y
                out_x, out_y = (Interval(max(0, way.lo), max(0, way.hi)) for way in beyond)
                if out_x * out_x + out_y * out_y < self.chain.margin * self.chain.margin:
                    return True
        return False


class Row(Placed):
    """The benches from one on, while the front handle of the first goes from low to high, or stays at low."""

    def __init__(self, chain, bench, low, high=None):
        super().__init__(chain, bench)
        self.width = high and high - low
        self.ends = [type(self)(chain, bench, end) for end in (low, high) if high]
        self.theta, self.turn, self.rate = hull(low, high or low), ZERO, ONE
        self.x, self.y = Moving(chain.growth * self.theta, chain.growth), Moving(ZERO)
        self.bends = []

    def grow(self):
        """Place the next bench."""
        bench, growth = self.chain.benches[self.bench + len(self.placed)], self.chain.growth
        bends = bend(self.theta, bench)
        self.bends.append(bends)
        by_theta, by_bend = slopes(self.theta, bends)
        self.rate *= ONE - by_theta / by_bend
        self.theta, self.turn, spin = self.theta + bends, self.turn + bends, self.rate - ONE
        if ends := [end.grow() for end in self.ends]:
            self.theta = self.passed(*(end.theta for end in ends), self.rate)
            self.turn = self.passed(*(end.turn for end in ends), spin)
        radius, sine, cosine = Moving(growth * self.theta, growth * self.rate), sin(self.turn), cos(self.turn)
        front_x, front_y, half, short = self.x, self.y, Moving(HALF), Moving(ONE / bench.chord)
        self.x, self.y = radius * Moving(cosine, (ZERO - sine) * spin), radius * Moving(sine, cosine * spin)
        if not self.placed:
            self.next = self.theta, self.rate > ZERO
        centre = (front_x + self.x) * half, (front_y + self.y) * half
        self.placed.append((bench, *centre, (front_x - self.x) * short, (front_y - self.y) * short))
        return self

    def passed(self, at_low, at_high, rate):
        """All values of what changes at this rate."""
        return hull(at_low, at_high) if rate > ZERO or rate < ZERO else at_low + rate * hull(ZERO, self.width)

    def apart(self, partner, face, angle):
        """Check by 3. that this bench and a partner are apart, by more than the margin, by one face."""
        pair = f"benches {self.bench} and {self.bench + partner} are not apart by face {face}"
        rows = (row.gaps(partner, face, angle, self.chain.margin) for row in (*self.ends, self))
        for low, high, between in zip(*rows, strict=True):
            low, high, slope = low.value, high.value, between.rate
            if not (low > ZERO and high > ZERO):
                raise Refused(f"not proven: {pair} at an end")
            if not stays_positive(low, high, slope, self.width):
                raise Loose(f"not proven: {pair} all over a stretch")

    @property
    def rear(self):
        """The places of the next handle, and whether they are shown to rise; one bench must be placed."""
        return self.next

    def all_far(self):
        """True if, by 4., this bench is apart from all benches that are not placed."""
        chain, nearest = self.chain, self.chain.growth * self.theta
        apart = chain.growth * self.next[0] + chain.benches[self.bench].reach + chain.reach + chain.margin
        return apart * apart < nearest * nearest - chain.chord * chain.chord * HALF * HALF


class Complex:
    """A point or a vector of the plane, as a complex number of intervals."""

    def __init__(self, x, y=ZERO):
        self.x, self.y = x, y

    def __add__(self, other):
        return Complex(self.x + other.x, self.y + other.y)

    def __sub__(self, other):
        return Complex(self.x - other.x, self.y - other.y)

    def __mul__(self, other):
        if isinstance(other, Interval):
            return Complex(self.x * other, self.y * other)
        return Complex(self.x * other.x - self.y * other.y, self.x * other.y + self.y * other.x)

    def __abs__(self):
        return sqrt(abs(self.x) * abs(self.x) + abs(self.y) * abs(self.y))

    def back(self):
        """The conjugate: the inverse of a direction."""
        return Complex(self.x, ZERO - self.y)

    def left(self):
        return Complex(ZERO - self.y, self.x)

    def joined(self, other):
        return Complex(hull(self.x, other.x), hull(self.y, other.y))


def pointing(angle):
    return Complex(cos(angle), sin(angle))


class Piece:
    """A line (radius None) or an arc of a route, 9.; its parameter is the place z itself. sign: 1 if it turns left.

    turn: the turn of a corner at its beginning, None without one
    """

    index, turn = 0, None

    def __init__(self, length, radius=None, sign=1):
        self.length, self.radius, self.sign = length, radius, exactly(sign)
        self.shift, self.rotation = Complex(ZERO), Complex(ONE)

    def param(self, z):
        return z

    place = param

    def point(self, t):
        way = self.high - t
        if self.radius is None:
            return self.shift + self.rotation * way
        angle = way / self.radius
        return self.shift + self.rotation * Complex(sin(angle), self.sign * (ONE - cos(angle))) * self.radius

    def tangent(self, t):
        return (
            self.rotation
            if self.radius is None
            else self.rotation * pointing(self.sign * (self.high - t) / self.radius)
        )

    def slope(self, t):
        return ONE

    def curvature(self, t):
        return ZERO if self.radius is None else self.sign / self.radius

    def sharpest(self):
        return abs(self.curvature(ZERO))

    def behind(self, t, bench):
        if self.radius is None:
            return t + bench.chord
        half = bench.chord * HALF / self.radius
        if not half < ONE:
            raise Loose("not proven: a bend is too tight for a bench")
        return t + TWO * arcsine(half) * self.radius


class Coil(Piece):
    """Part of the spiral r = b |t|: danced inwards for t > 0, outwards for t < 0, so that t falls."""

    def __init__(self, growth, first, last):
        super().__init__(ZERO)
        self.growth, self.first, self.last, self.inwards = growth, first, last, first > ZERO
        self.begun = self.arc(first)
        self.length = self.begun - self.arc(last)

    def theta(self, t):
        if not (t > ZERO if self.inwards else t < ZERO):
            raise Loose("not proven: a handle is not shown to be short of the centre of a coil")
        return abs(t)

    def arc(self, t):
        if t.lo < 0:
            return (
                ZERO - self.arc(abs(t))
                if t.hi <= 0
                else hull(ZERO - self.arc(Interval(0, -t.lo)), self.arc(Interval(0, t.hi)))
            )
        slant = sqrt(ONE + t * t)
        return HALF * self.growth * (t * slant + log(t + slant))

    def param(self, z):
        left = z - self.high + self.begun
        size = left if self.inwards else ZERO - left
        if not size > ZERO:
            raise Loose("not proven: a handle is not shown to be short of the centre of a coil")
        goal, t = 2.0 * float(size) / float(self.growth), 0.0
        for _ in range(60):
            t = t or math.sqrt(goal)
            t -= (t * math.hypot(1.0, t) + math.asinh(t) - goal) / (2.0 * math.hypot(1.0, t))
        t = newton(t, lambda t: self.arc(t) - size, self.slope)
        return t if self.inwards else ZERO - t

    def place(self, t):
        return self.high + self.arc(t) - self.begun

    def point(self, t):
        theta = self.theta(t)
        return self.shift + self.rotation * pointing(theta) * (self.growth * theta)

    def tangent(self, t):
        theta = self.theta(t)
        along = self.rotation * Complex(ONE, theta) * pointing(theta) * (ONE / sqrt(ONE + theta * theta))
        return Complex(ZERO) - along if self.inwards else along

    def slope(self, t):
        return self.growth * sqrt(ONE + abs(t) * abs(t))

    def curvature(self, t):
        size = self.bend(self.theta(t))
        return ZERO - size if self.inwards else size

    def bend(self, theta):
        square = ONE + theta * theta
        return (square + ONE) / (square * sqrt(square)) / self.growth

    def sharpest(self):
        return highest([self.bend(abs(end)) for end in (self.first, self.last)])

    def behind(self, t, bench):
        needed = bench.chord / self.growth * (bench.chord / self.growth)
        theta, goal = float(self.theta(t)) * (1 if self.inwards else -1), float(needed)
        most = 3.2 if self.inwards else min(3.2, -theta)

        def reached(k):
            d = k * most * 2.0**-52
            return d * d + 4.0 * theta * (theta + d) * math.sin(d / 2.0) ** 2 >= goal

        def excess(d):
            return d * d + TWO * t * (t + d) * (ONE - cos(d)) - needed

        guess = bisect_left(range(1 << 52), True, key=reached) * most * 2.0**-52
        return t + newton(guess, excess, lambda d: slopes(t, d)[1])


class Path:
    """Pieces in the order they are danced, each moved so that it continues the one before it.

    The piece with number `at` begins at s = -z, the first one at its shift and rotation.
    """

    def __init__(self, pieces, at, z, shift, rotation):
        self.pieces, high = pieces, z
        for piece in pieces[at:]:
            piece.high, piece.low = high, high - piece.length
            high = piece.low
        for piece in reversed(pieces[:at]):
            piece.low, piece.high = z, z + piece.length
            z = piece.high
        pieces[0].shift, pieces[0].rotation = shift, rotation
        for k, piece in enumerate(pieces[1:], 1):
            piece.index = k
            start, end = self.ends(k)
            piece.rotation = pieces[k - 1].tangent(end) * piece.tangent(start).back() * (piece.turn or Complex(ONE))
            piece.shift = pieces[k - 1].point(end) - piece.point(start)

    def ends(self, k):
        """The parameters on both sides of the joint before piece k: of k, and of the piece before it."""
        after, before = self.pieces[k], self.pieces[k - 1]
        return getattr(after, "first", after.high), getattr(before, "last", before.low)

    def holds(self, piece, z):
        first, last = piece.index == 0, piece.index == len(self.pieces) - 1
        return (first or z.hi <= piece.high.lo) and (last or z.lo >= piece.low.hi)

    def at(self, z):
        for piece in self.pieces:
            if self.holds(piece, z):
                return piece, piece.param(z)
        raise Loose("not proven: a handle is on a joint to the last digit")

    def curvature(self, front, rear):
        """All curvatures from one place back to another."""
        found = [piece.curvature(t) for piece, t in (front, rear)]
        for k in range(rear[0].index + 1, front[0].index + 1):
            start, end = self.ends(k)
            found += [self.pieces[k].curvature(start), self.pieces[k - 1].curvature(end)]
        return hull(*found)

    def behind(self, front, bench):
        """The first place behind at the chord of a bench, 9."""
        spend()
        piece, t = front
        try:
            rear = piece, piece.behind(t, bench)
            stays = self.holds(piece, piece.place(rear[1]))
        except Refused:
            stays = False
        if not stays:
            rear = self.on_earlier(front, bench.chord)
        length = rear[0].place(rear[1]) - piece.place(t)
        if self.gentle(front, rear, bench.chord):
            first = abs(self.curvature(front, rear)) * length < PI
        else:
            first = all_short(piece.point(t), self.parts(front, rear), bench.chord)
        if not (length > ZERO and first):
            raise Loose("not proven: a next handle is not shown to be the first behind")
        return rear

    def gentle(self, front, rear, chord):
        """True if 9. serves from one place back to another."""
        corners = [piece for piece in self.pieces[rear[0].index + 1 : front[0].index + 1] if piece.turn]
        return not corners and abs(self.curvature(front, rear)) * chord < GENTLE

    def parts(self, front, rear):
        """The pieces from one place back to another, with the parameters of all that is between."""
        found = []
        for piece in self.pieces[rear[0].index : front[0].index + 1]:
            ahead = front[1] if piece is front[0] else self.ends(piece.index + 1)[1]
            found.append((piece, hull(ahead, rear[1] if piece is rear[0] else self.ends(piece.index)[0])))
        return found

    def on_earlier(self, front, chord):
        """A place at a chord on a piece before that of the front handle."""
        point, z = front[0].point(front[1]), float(front[0].place(front[1]))
        for k in range(front[0].index - 1, -1, -1):
            piece = self.pieces[k]
            end = self.ends(k + 1)[1]
            t = middle_of(end)
            step = max(0.0, z + float(chord) - float(piece.low)) / float(piece.slope(t))
            guess = reaching(piece, point, float(chord), float(t) + step)
            t = None if guess is None else meeting(piece, point, chord, guess)
            if t and self.holds(piece, piece.place(t)):
                return piece, t
        raise Loose("not proven: no next handle is found across a joint")


def reaching(piece, point, chord, t):
    """Guess, in floats, of the first parameter from t on at which a piece is a chord away from a point."""
    least = min(chord, float(piece.length)) / 256.0
    for _ in range(STEPS_MOST):
        spend()
        left = chord - float(abs(piece.point(exactly(t)) - point))
        if left <= 0.0:
            return t
        if piece.index and float(piece.place(exactly(t))) > float(piece.high) + least:
            return None
        t += max(left, least) / float(piece.slope(exactly(t)))
    return None


def all_short(point, parts, chord):
    """True if all places of these parts are short of their end, for all these points, by 17."""
    left = list(parts)
    for _ in range(PARTS_MOST):
        if not left:
            return True
        spend()
        piece, t = left.pop()
        to, ahead = point - piece.point(t), piece.tangent(t)
        if not (abs(to) < chord or to.x * ahead.x + to.y * ahead.y > ZERO):
            middle = (t.lo + t.hi) >> 1
            left += [(piece, Interval(t.lo, middle)), (piece, Interval(middle, t.hi))]
    return False


def spend():
    LEFT[0] -= 1
    if LEFT[0] < 0:
        raise Refused("not proven: this is too much work for this verifier")


def middle_of(x):
    return Interval((x.lo + x.hi) >> 1, (x.lo + x.hi) >> 1)


def meeting(piece, point, chord, guess):
    """The parameter near a guess at which a piece passes a distance from a point; None if none is found."""

    def excess(t):
        to = piece.point(t) - point
        return abs(to.x) * abs(to.x) + abs(to.y) * abs(to.y) - chord * chord

    def slope(t):
        to, ahead = piece.point(t) - point, piece.tangent(t)
        return (ZERO - TWO) * (to.x * ahead.x + to.y * ahead.y) * piece.slope(t)

    try:
        for _ in range(40):
            here = exactly(guess)
            step = float(middle_of(excess(here))) / (float(middle_of(slope(here))) or 1.0)
            guess -= step
            if abs(step) < 1e-14:
                break
        return newton(guess, excess, slope)
    except Refused:
        return None


class RouteChain(Chain):
    """The dragon on a route. Its places are z = -s."""

    floor = -math.inf

    def __init__(self, runs, path, margin=0):
        super().__init__(runs, 1, 0, margin)
        self.path, self.poses = path, {}
        longest = Interval(self.chord.hi, self.chord.hi)
        self.gentle = all(not piece.turn and piece.sharpest() * longest < GENTLE for piece in path.pieces)

    def row(self, bench, low, high=None):
        return RouteRow(self, bench, low, high) if high else Pose(self, bench, low)

    def pose(self, bench, place):
        """A pose, remembered: stretches that join share one."""
        if len(self.poses) > 8:
            self.poses.clear()
        return self.poses.setdefault((bench, place.lo, place.hi), Pose(self, bench, place))

    def places_behind(self, bench, place, count):
        pose = Pose(self, bench, place)
        pose.grow_to(count)
        return [place.hi for place in pose.places[1 : count + 1]]


class Pose(Placed):
    """A bench and those behind it when its front handle is at a place of a route, in the world."""

    def __init__(self, chain, bench, place):
        super().__init__(chain, bench)
        self.handles = [chain.path.at(place)]
        self.points, self.places, self.tangents = [self.handles[0][0].point(self.handles[0][1])], [place], []
        self.seats, self.leans = [], {}  # centre and direction of each; its alpha and beta

    @property
    def theta(self):
        return self.places[-1]

    def grow_to(self, count):
        while len(self.placed) < count:
            self.grow()

    def grow(self):
        bench = self.chain.benches[self.bench + len(self.placed)]
        piece, t = self.chain.path.behind(self.handles[-1], bench)
        self.handles.append((piece, t))
        self.points.append(piece.point(t))
        self.places.append(piece.place(t))
        front, rear = self.points[-2:]
        centre, along = (front + rear) * HALF, (front - rear) * (ONE / bench.chord)
        self.seats.append((centre, along))
        self.placed.append((bench, *(Moving(part) for part in (centre.x, centre.y, along.x, along.y))))
        return self

    def seen(self, owner, other):
        """Centre and direction of one bench in the frame of another."""
        (centre, along), (to, axis) = self.seats[owner], self.seats[other]
        return along.back() * (to - centre), along.back() * axis

    def angles(self, k):
        """alpha and beta of bench k."""
        for piece, t in self.handles[len(self.tangents) : k + 2]:
            self.tangents.append(piece.tangent(t))
        if k not in self.leans:
            turned = [self.seats[k][1].back() * tangent for tangent in self.tangents[k : k + 2]]
            self.leans[k] = [atan(way.y / way.x) for way in turned]
        return self.leans[k]


class RouteRow:
    """The benches from one on, while the front handle of the first goes from low to high on a route, 9. and 10."""

    def __init__(self, chain, bench, low, high):
        self.chain, self.bench, self.width = chain, bench, high - low
        self.ends = [chain.pose(bench, low), chain.pose(bench, high)]
        self.speeds, self.placed, self.seen = [ONE], [], (None,)

    @property
    def rear(self):
        return hull(*(pose.places[1] for pose in self.ends)), True

    def grow(self):
        k = len(self.placed)
        for pose in self.ends:
            pose.grow_to(k + 1)
        low, high = self.ends
        bench, front, rear, speed = low.placed[k][0], low.handles[k], high.handles[k + 1], self.speeds[k]
        gentle = self.chain.path.gentle(front, rear, bench.chord)
        if gentle and front[0] is rear[0] and not isinstance(front[0], Coil):
            bent = front[0].curvature(ZERO)
            half = abs(bent) * bench.chord * HALF
            self.placed.append((Complex(speed * sqrt(ONE - half * half)), speed * bent))
            self.speeds.append(speed)
            return self
        if gentle:
            bent = self.chain.path.curvature(front, rear)
            alpha = half_angle(bent, bench.chord)
            alpha, beta = self.from_ends(k, (alpha, ZERO - alpha), (bent, bent), bench.chord)
        else:
            alpha, beta = self.from_ends(k, *self.followed(k, bench.chord), bench.chord)
            if not cos(beta) > FOLLOWS:
                raise Loose("not proven: a rear handle is not shown to go forwards")
        ratio = cos(alpha) / cos(beta)
        across = ratio * sin(beta)
        self.placed.append(
            (Complex(cos(alpha), (sin(alpha) + across) * HALF) * speed, speed * (sin(alpha) - across) / bench.chord)
        )
        self.speeds.append(speed * ratio)
        return self

    def followed(self, k, chord):
        """alpha and beta of bench k over the stretch by 17., and the curvatures at its handles, None past a corner."""
        path, (low, high) = self.chain.path, self.ends
        points, leans, bends = [], [], []
        parts = [path.parts(low.handles[i], high.handles[i]) for i in (k, k + 1)]
        for these in parts:
            point = these[0][0].point(these[0][1])
            for piece, t in these[1:]:
                point = point.joined(piece.point(t))
            points.append(point)
        back = (points[0] - points[1]).back()
        for these in parts:
            ways = [back * piece.tangent(t) for piece, t in these]
            leans.append(hull(*(atan(way.y / way.x) for way in ways)))  # refuses to divide where u.T may be 0
            cornered = any(piece.turn for piece, _ in these[1:])
            bends.append(None if cornered else hull(*(piece.curvature(t) for piece, t in these)))
        short = all_short(points[0], path.parts(low.handles[k], low.handles[k + 1]), chord)
        if not short or low.places[k + 1].hi > high.places[k + 1].lo:
            raise Loose("not proven: a bench is not shown to follow")
        return leans, bends

    def from_ends(self, k, wides, bends, chord):
        """alpha and beta of bench k between the ends, 9."""
        low, high = self.ends
        half_way = (high.places[k] - low.places[k]) * HALF
        alpha, beta = wides
        ratio = cos(alpha) / cos(beta)
        rotating = (sin(alpha) - ratio * sin(beta)) / chord
        found = []
        ends = zip(high.angles(k), low.angles(k), wides, (ONE, ratio), bends, strict=True)
        for first, last, wide, factor, bent in ends:
            near = wide if bent is None else hull(first, last) + around(factor * bent - rotating) * half_way
            found.append(Interval(max(near.lo, wide.lo), min(near.hi, wide.hi)))
        return found

    def all_far(self):
        """True if, by 12., this bench is apart from all benches that are not placed."""
        first, count = self.chain.path.pieces[0], len(self.placed)
        piece, t = self.ends[0].handles[count]
        if not (isinstance(first, Coil) and first.inwards and piece is first and count >= 2):
            return False
        if not abs(piece.curvature(t)) * self.chain.chord < GENTLE:
            return False
        outer = ZERO
        for k in (0, 1):
            high = self.ends[1].handles[k][1]
            if self.ends[1].handles[k][0] is first is self.ends[0].handles[k][0]:
                reached = first.growth * high
            else:
                away = [abs(pose.points[k] - first.shift) for pose in self.ends]
                reached = (away[0] + away[1] + self.ends[1].places[k] - self.ends[0].places[k]) * HALF
            outer = Interval(max(outer.lo, reached.lo), max(outer.hi, reached.hi))
        nearest, most = first.growth * Interval(t.lo, t.lo), self.chain.chord * HALF
        apart = outer + self.chain.benches[self.bench].reach + self.chain.reach + self.chain.margin
        return apart * apart < nearest * nearest - most * most

    def relative(self, partner):
        """e and v of 10."""
        if self.seen[0] != partner:
            (velocity, rate), (other, other_rate) = self.placed[0], self.placed[partner]
            turning = pointing((other_rate - rate) * hull(ZERO, self.width * HALF))
            low, high = (pose.seen(0, partner)[1] for pose in self.ends)
            along = (high * turning).joined(low * turning.back())
            self.seen = partner, along, along * other - velocity
        return self.seen[1:]

    def between(self, partner, velocity):
        """q of 10."""
        low, high = (pose.seen(0, partner)[0] for pose in self.ends)
        half = hull(ZERO, self.width * HALF)
        most = around(hull(abs(low), abs(high)) + abs(velocity) * self.width * HALF)
        place = Complex(most, most)
        for _ in range(3):
            move = velocity - place.left() * self.placed[0][1]
            place = (high + move * half).joined(low - move * half)
        return place

    def apart(self, partner, face, angle):
        """Check by 3., 10. and 11. that this bench and a partner are apart, by more than the margin."""
        pair = f"benches {self.bench} and {self.bench + partner} are not apart by face {face}"
        along, velocity = self.relative(partner)
        margin, low_pose = self.chain.margin, self.ends[0]
        if face == 9:
            low, high = (abs(pose.seen(0, partner)[0]) for pose in self.ends)
            sizes = [
                sqrt(bench.x * bench.x + bench.y * bench.y)
                for bench, *_ in (low_pose.placed[0], low_pose.placed[partner])
            ]
            if not low + high - abs(velocity) * self.width > TWO * (sizes[0] + sizes[1] + margin):
                raise Loose(f"not proven: {pair} all over a stretch")
            return
        place = self.between(partner, velocity)
        (velocity_a, rate_a), (velocity_b, rate_b) = self.placed[0], self.placed[partner]
        other = low_pose.placed[partner][0]
        if 4 <= face < 8:
            place, along = Complex(ZERO) - along.back() * place, along.back()
            velocity, rate_a, rate_b, other = along * velocity_a - velocity_b, rate_b, rate_a, low_pose.placed[0][0]
        quarter = (Complex(ONE), Complex(ZERO, ZERO - ONE), Complex(ZERO - ONE), Complex(ZERO, ONE))
        towards = pointing(exactly(angle)).back() if face == 8 else quarter[face % 4]
        to_move = towards * (velocity - place.left() * rate_a)
        axis_move = towards * along.left() * (rate_b - rate_a)
        gaps = (pose.gaps(partner, face, angle, margin) for pose in self.ends)
        signs = ((1, 1), (1, -1), (-1, -1), (-1, 1))
        for low, high, (length, width) in zip(*gaps, signs, strict=True):
            corner = Complex(other.x * exactly(length), other.y * exactly(width))
            if not (low.value > ZERO and high.value > ZERO):
                raise Refused(f"not proven: {pair} at an end")
            if not stays_positive(low.value, high.value, (to_move + axis_move * corner).x, self.width):
                raise Loose(f"not proven: {pair} all over a stretch")


def half_angle(bent, chord):
    """All alpha, and -beta, of a bench where the curvature is in an interval, 9."""
    sharpest = Interval(max(abs(bent.lo), abs(bent.hi)), max(abs(bent.lo), abs(bent.hi)))
    gentlest = 0 if bent.lo <= 0 <= bent.hi else min(abs(bent.lo), abs(bent.hi))
    lengths = []
    for most in (sharpest, Interval(gentlest, gentlest)):
        half = most * chord * HALF
        lengths.append(TWO * arcsine(half) / most if most > ZERO else chord)
    return bent * hull(*lengths) * HALF


# Sides of a polygon around a ground, and samples on either side of 0, 14.
SIDES, SAMPLES = 64, 64


class Ground:
    """The polygons of 14. around the front end, the middle and the rear end of a bench, and around all three.

    supports, corners: of each; corner k is where the sides k and k + 1 meet, in the frame of the bench
    """

    def __init__(self, bench, stray):
        self.bench, self.stray, self.kappa = bench, stray, stray / bench.chord
        if not self.kappa < ONE:
            raise Refused("not proven: the stray is not shown to be less than a chord")
        self.outwards = [pointing(TWO * PI * exactly(Fraction(k, SIDES))) for k in range(SIDES)]
        sines = [sin(PI * exactly(Fraction(k, 2 * SAMPLES))) for k in range(-SAMPLES, SAMPLES + 1)]
        motions = [(abs(sine), self.half_turn(sine * self.kappa)) for sine in sines]
        half_chord, front, middle = bench.chord * HALF, [], []
        spares = [self.spare(abs(Complex(x, bench.y))) for x in (bench.x, half_chord)]
        for way in self.outwards[: SIDES // 2 + 1]:  # the ground is symmetric about its axis
            reached = [self.reached(way.back() * half_turn, q, half_turn) for q, half_turn in motions]
            front.append(highest([end for end, _ in reached]) + spares[0])
            middle.append(highest([centre for _, centre in reached]) + spares[1])
        front, middle = (row + row[-2:0:-1] for row in (front, middle))
        rear = front[SIDES // 2 :] + front[: SIDES // 2]
        self.supports = [front, middle, rear, [highest(three) for three in zip(front, middle, rear, strict=True)]]
        self.corners = [self.corners_of(row) for row in self.supports]

    def half_turn(self, q):
        """exp(i phi / 2)"""
        return Complex(sqrt(ONE - abs(q) * abs(q)), q)

    def reached(self, leaning, q, half_turn):
        """Distances that the front end and the middle reach at one sample in a direction, seen along its normal."""
        along, across, rest = abs(leaning.x), abs(leaning.y), ONE - q * q
        lens = along * sqrt(Interval(max(0, rest.lo), max(0, rest.hi))) if across < q else ONE - q * across
        turned, half_chord = leaning * half_turn, self.bench.chord * HALF
        beside = self.stray * lens + abs(turned.y) * self.bench.y
        front = highest([turned.x * half_chord, turned.x * self.bench.x])
        return beside + front, beside + abs(turned.x) * half_chord

    def spare(self, furthest):
        """Distance by which they may reach further between two samples."""
        kappa, square = self.kappa, self.kappa * self.kappa
        steep, width = kappa / sqrt(ONE - square), PI / exactly(2 * SAMPLES)
        second = self.stray * (ONE + TWO * kappa + square + steep) + furthest * (TWO * TWO * square + TWO * steep)
        return second * width * width / exactly(8)

    def corners_of(self, supports):
        step, after = self.outwards[1], supports[1:] + supports[:1]
        return [
            way * Complex(here, (there - here * step.x) / step.y)
            for way, here, there in zip(self.outwards, supports, after, strict=True)
        ]


def highest(values):
    return Interval(max(value.lo for value in values), max(value.hi for value in values))


# The polygons that one side keeps apart, or nine: front end, middle and rear end of one and of the other.
WHOLES, PARTS = ((3, 3),), tuple((mine, other) for mine in range(3) for other in range(3))


class StrayRow(Row):
    """Row, for the grounds of the benches."""

    def apart(self, partner, sides, angle):
        """Check by 3. and 15. that the grounds of this bench and a partner are apart, by one side or by nine."""
        pair = f"the grounds of benches {self.bench} and {self.bench + partner} are not apart by sides {sides}"
        for number, hulls in zip(sides, WHOLES if len(sides) == 1 else PARTS, strict=True):
            corners = self.corners(partner, number, hulls)
            rows = (row.beyond(partner, number, hulls, corners) for row in (*self.ends, self))
            for low, high, between in zip(*rows, strict=True):
                low, high, slope = low.value, high.value, between.rate
                if not (low > ZERO and high > ZERO):
                    raise Refused(f"not proven: {pair} at an end")
                if not stays_positive(low, high, slope, self.width):
                    raise Loose(f"not proven: {pair} all over a stretch")

    def pair(self, partner, number):
        """The ground that has the side and the other one, with their benches as they are placed."""
        a, b = (partner, 0) if number >= SIDES else (0, partner)
        grounds = self.chain.grounds
        return grounds[self.placed[a][0]], self.placed[a][1:], grounds[self.placed[b][0]], self.placed[b][1:]

    def corners(self, partner, number, hulls):
        """Numbers of the corners of 15. that may be nearest to the side."""
        own, (_, _, ux, uy), other, (_, _, vx, vy) = self.pair(partner, number)
        along, axis = Complex(ux.value, uy.value), Complex(vx.value, vy.value)
        seen = own.outwards[number % SIDES].back() * along.back() * axis
        towards = Complex(ZERO) - seen.back()
        guess = round(math.atan2(float(towards.y), float(towards.x)) * SIDES / math.tau)
        off = towards * other.outwards[guess % SIDES].back()
        if not off.x > ZERO:
            return range(SIDES)
        sectors = atan(off.y / off.x) * exactly(SIDES) / (TWO * PI)
        return [(guess + k) % SIDES for k in range(sectors.lo >> BITS, (sectors.hi >> BITS) + 1)]

    def beyond(self, partner, number, hulls, corners):
        """g of 3. for these corners."""
        own, (x_a, y_a, ux, uy), other, (x_b, y_b, vx, vy) = self.pair(partner, number)
        mine, beyond = reversed(hulls) if number >= SIDES else hulls
        n = own.outwards[number % SIDES]
        nx, ny = Moving(n.x), Moving(n.y)
        out_x, out_y = ux * nx - uy * ny, uy * nx + ux * ny
        to = out_x * (x_b - x_a) + out_y * (y_b - y_a) - Moving(own.supports[mine][number % SIDES])
        along, across = out_x * vx + out_y * vy, out_y * vx - out_x * vy
        found = []
        for k in corners:
            corner = other.corners[beyond][k]
            found.append(to + along * Moving(corner.x) + across * Moving(corner.y))
        return found


class StrayChain(Chain):
    """The dragon on a spiral, whose holes may be away from their places."""

    def __init__(self, runs, pitch, turns, stray):
        super().__init__(runs, pitch, turns)
        self.grounds = {bench: Ground(bench, stray) for bench in set(self.benches)}
        self.margin = TWO * stray  # for 4.: no bench is farther from its chord than h + stray

    def row(self, bench, low, high=None):
        return StrayRow(self, bench, low, high)


def covered(chain, bench, low, high, faces, angles, places, halvings=3):
    """Angle of the next handle over a stretch in which these faces show this bench apart from the others [rad]."""
    try:
        row = chain.row(bench, low, high).grow()
        rear, rises = row.rear
        while len(row.placed) < min(len(faces) + 2, len(chain.benches) - bench):
            row.grow()
        # The benches that are missing at the end are as many as the places below this stretch.
        if not (bench + len(row.placed) + bisect_left(places, low.lo) >= len(chain.benches) or row.all_far()):
            raise Loose("not proven: pairs are missing")
        given = iter(angles)
        for partner, face in enumerate(faces, 2):
            row.apart(partner, face if type(face) is list else int(face), next(given) if face == "8" else 0.0)
        if not rises and len(places) > 1 and rear.hi > places[1]:
            raise Loose(f"not proven: handle {bench + 1} may turn back far outside")
        return rear
    except Loose:
        if not halvings:
            raise
    halves = (low, (low + high) * HALF), ((low + high) * HALF, high)
    return hull(*(covered(chain, bench, *half, faces, angles, places, halvings - 1) for half in halves))


def all_apart(chain, high, low, sweeps, repeats_from, follows=False):
    """Check by 5. that no two benches touch while the head goes in from high to low, or follow if they have no pair."""
    count, way = len(chain.benches), Interval(-double_above(-low.lo), double_above(high.hi))
    if repeats_from > max(0, count - 3) or (repeats_from < count - 3 and len(set(chain.benches[repeats_from:])) > 1):
        raise Refused(f"not proven: the benches from {repeats_from} on are not alike, or have no pairs")
    none = low > high or (count < 3 and not follows)
    if [sweep["bench"] for sweep in sweeps] != ([] if none else list(range(repeats_from + 1))):
        raise Refused(f"not proven: the sweeps are not those of benches 0 to {repeats_from}, each once, in this order")
    for bench, sweep in enumerate(sweeps):
        places, rears, end = [way.hi], [], None
        if bench == repeats_from:
            behind = chain.places_behind(bench, Interval(way.hi, way.hi), max(0, count - 3 - bench))
            places += [double_above(place) for place in behind]
        for k, (first, last, faces, *angles) in enumerate(sweep["stretches"]):
            name = f"sweeps[{bench}].stretches[{k}], theta from {first!r} to {last!r} rad"
            fits = len(faces) <= max(0, count - bench - 2) and chain.floor < last < first
            if isinstance(chain, StrayChain):
                fits = (
                    fits and type(faces) is list and all(len(these) in (1, 9) and max(these) < 128 for these in faces)
                )
            else:
                known = "01234567" + "8" * (chain.margin > ZERO) + "9" * (chain.floor < 0)
                fits = fits and type(faces) is str and set(faces) <= set(known)
                fits = fits and sum(map(len, angles)) == faces.count("8") and (chain.margin > ZERO or not angles)
            if not fits:
                raise Refused(f"{MALFORMED}: {name} with its faces is no stretch of this dragon")
            if first != end if rears else exactly(first).hi < places[-1]:
                raise Refused(f"not proven: the stretches do not join at {name}")
            try:
                rears.append(
                    covered(
                        chain,
                        bench,
                        exactly(last),
                        exactly(first),
                        faces,
                        [angle for these in angles for angle in these],
                        places,
                    )
                )
            except Refused as why:
                raise Refused(f"{why}, in {name}") from None
            end = last
        if not rears or exactly(end).lo > way.lo:
            raise Refused(f"not proven: the sweep of bench {bench} ends short of its way, at theta = {end!r} rad")
        lowest, highest_place = min(rear.lo for rear in rears), max(rear.hi for rear in rears)
        way = Interval(-double_above(-lowest), double_above(highest_place))


def overlapping(chain, head, a, b):
    """6., when the head is there."""
    if not 0 <= a < b - 1 < len(chain.benches) - 1:
        raise Refused(f"not proven: benches {a} and {b} are not two benches that share no handle")
    row = chain.row(0, head)
    while len(row.placed) < a:
        row.grow()
    row = chain.row(a, row.theta)
    while len(row.placed) <= b - a:
        row.grow()
    what = f"be nearer than {float(chain.margin)!r} m" if chain.margin > ZERO else "overlap"
    if not row.near(b - a):
        raise Refused(f"not proven: benches {a} and {b} are not shown to {what}")
    return f"benches {a} and {b} {what.replace('be ', 'are ')}"


def moved(theta, d):
    """F of 1."""
    return d * d + TWO * theta * (theta + d) * (ONE - cos(d))


def fold(chain, bench, before, after):
    """Check by 8. that a bench can no longer follow when the head goes from one theta to another."""
    fails = Refused(f"not proven: bench {bench} is not shown to fold")
    ends = [Row(chain, 0, before), Row(chain, 0, after)]
    for row, count in zip(ends, (bench + 1, bench), strict=True):
        while len(row.placed) < count:
            row.grow()
    over = Row(chain, 0, after, before) if bench else ends[0]
    while bench and len(over.placed) < bench:
        over.grow()
    highest = over.theta if bench else before
    lowest, needed, first = ends[1].theta, chain.benches[bench].needed, ends[0].bends[bench]
    wall = wall_beyond(float(lowest), float(first))
    if wall is None or not (first < exactly(wall) and moved(highest, exactly(wall)) < needed):
        raise fails
    pieces = [(0.0, wall)]
    for _ in range(PIECES_MOST):
        if not pieces:
            return
        low, high = pieces.pop()
        middle = (low + high) / 2.0
        piece, at = hull(exactly(low), exactly(high)), exactly(middle)
        if not moved(lowest, at) + slopes(lowest, piece)[1] * (piece - at) < needed:
            pieces += [(low, middle), (middle, high)]
    raise fails


def wall_beyond(theta, d):
    """Guess, in floats, of the first angle beyond d at which F stops falling; None if none is found."""
    for step in (0.01, 0.0001):
        falls, wall = False, d
        while wall < d + 7.0:
            slope = wall + theta * (1.0 - math.cos(wall)) + theta * (theta + wall) * math.sin(wall)
            if falls and slope > 0.0:
                return wall
            falls, wall = falls or slope < 0.0, wall + step
    return None


def folding(chain, before, after):
    """Check that some bench folds when the head goes from one theta to another; returns its number."""
    row = Row(chain, 0, after)
    try:
        while len(row.placed) < len(chain.benches):
            row.grow()
    except Refused:
        fold(chain, len(row.placed), before, after)
        return len(row.placed)
    raise Refused("not proven: every bench is shown to follow past the end that is claimed")


def never(chain):
    near = f"come nearer to one another than {float(chain.margin)!r} m" if chain.margin > ZERO else "touch"
    return f"no two benches except neighbours {near}"


def following(chain):
    forwards = ", where every rear handle goes forwards, less than 87.44 degrees off its bench, and never jumps"
    return "" if chain.gentle else forwards


def collision_time(runs, claim, overlap, *rest):
    path = {"kind": "spiral", "pitch": claim["pitch"], "start_turns": claim["start_turns"]}
    return contact(runs, claim | {"path": path, "start": 0.0}, overlap, *rest)


def contact(runs, claim, overlap, *rest):
    chain, place = danced(runs, claim)
    start, time = claim["start"], claim["time"]
    after, before = (place(Fraction(time) + step) for step in (TIME_BRACKET, -TIME_BRACKET))
    what = overlapping(chain, after, *overlap["benches"])
    if not chain.gentle:
        row = chain.row(0, after, before)  # between the two, too, every bench up to them follows
        while len(row.placed) <= overlap["benches"][1]:
            row.grow()
    all_apart(chain, place(Fraction(start)), before, *rest, follows=not chain.gentle)
    clear = f"{never(chain)} from {start!r} s to {time!r} - 1e-10 s, and"
    if time - TIME_BRACKET <= start:
        clear = "within 2e-10 s of the start"
    return f"{moving(claim)}{following(chain)}: {clear} {what} at {time!r} + 1e-10 s"


def clear_run(runs, claim, overlap, *rest):
    chain, place = danced(runs, claim)
    start, stop, until = claim["start"], claim["stop"], claim["until"]
    later, when = Fraction(stop) + END_BRACKET, f"before {stop!r} + 1e-9 s"
    if until == "end" and claim["path"]["kind"] != "spiral":
        if not place(later) < chain.path.pieces[-1].low:
            raise Refused("not proven: the route is not shown to end so soon")
        ending = {until: f", and the route ends {when}"}
    elif claim["path"]["kind"] != "spiral":
        ending = {"stop": ""}
    else:
        ending = {
            "stop": "",
            "fold": f", and bench %s folds {when}",
            "centre": f", and the head is at the centre {when}",
        }
    if until not in ending:
        raise Refused(f"{MALFORMED}: claim.until must be an end of this path, got {until}")
    if until == "fold":
        ending[until] %= folding(chain, place(Fraction(stop)), place(later))
    if until == "centre" and not chain.arc(chain.start) < exactly(later) * exactly(claim["head_speed"]):
        raise Refused("not proven: the head is not shown to reach the centre so soon")
    all_apart(chain, place(Fraction(start)), place(Fraction(stop)), *rest, follows=not chain.gentle)
    return f"{moving(claim)}{following(chain)}: {never(chain)} from {start!r} s to {stop!r} s{ending[until]}"


def tolerance(runs, claim, overlap, *rest):
    if not claim["start"] < claim["stop"]:
        raise Refused(f"{MALFORMED}: the claim ends before it begins")
    stray, speed, start, stop = (exactly(claim[name]) for name in ("stray", "head_speed", "start", "stop"))
    if claim["stray"] > 0.5 * min(length - 2.0 * overhang for _, length, _, overhang in runs):
        raise Refused(f"{MALFORMED}: claim.stray must be at most half of the shortest chord")
    chain = StrayChain(runs, claim["pitch"], claim["start_turns"], stray)
    stand(chain)
    kept = f"while every hole is within {claim['stray']!r} m of its place and every chord keeps its length"
    shown = ""
    if "shown" in claim:
        if not claim["start"] <= overlap["time"] <= claim["stop"]:
            raise Refused("not proven: the pose is not one of this time")
        head = chain.theta_after(exactly(overlap["time"]) * speed)
        a, b = verify_pose(chain, head, overlap, exactly(claim["shown"]))
        shown = f", and benches {a} and {b} overlap in a pose with strays below {claim['shown']!r} m"
        shown += f" at {overlap['time']!r} s"
    all_apart(chain, chain.theta_after(start * speed), chain.theta_after(stop * speed), *rest)
    span = f"from {claim['start']!r} s to {claim['stop']!r} s"
    return f"{moving(claim | {'path': claim})}: {kept}, no two benches except neighbours touch {span}{shown}"


def verify_pose(chain, head, pose, most):
    """Check by 16. that two benches overlap in a pose with strays below this; returns them."""
    (a, b), headings = pose["benches"], pose["headings"]
    if not (0 <= a < b - 1 < len(chain.benches) - 1 and len(headings) == len(chain.benches)):
        raise Refused("not proven: the pose is not one of this dragon, or its benches share a handle")
    row, turned = Row(chain, 0, head), pointing(head)
    handle, pair = Complex(*map(exactly, pose["head"])), Placed(chain, a)
    for k, heading in enumerate([*headings, None]):
        place = turned * Complex(row.x.value, row.y.value)
        if not abs(handle - place) < most:
            raise Refused(f"not proven: handle {k} of the pose is not shown to be so near to its place")
        if heading is not None:
            along, bench = pointing(exactly(heading)), chain.benches[k]
            rear = handle - along * bench.chord
            if k in (a, b):
                centre = (handle + rear) * HALF
                pair.placed.append((bench, *(Moving(part) for part in (centre.x, centre.y, along.x, along.y))))
            handle = rear
            row.grow()
    if not all(any(gap.value < ZERO for gap in pair.gaps(1, face)) for face in range(8)):
        raise Refused(f"not proven: benches {a} and {b} are not shown to overlap in the pose")
    return a, b


def danced(runs, claim):
    """The dragon on its path, and the place of its head at a time."""
    path, margin, speed = claim["path"], claim.get("margin", 0), exactly(claim["head_speed"])
    last = claim["stop" if "stop" in claim else "time"]
    from_start = claim["kind"] == "collision-time"
    if not (from_start or claim["start"] < last):
        raise Refused(f"{MALFORMED}: the claim ends before it begins")
    if path["kind"] == "spiral":
        chain = Chain(runs, path["pitch"], path["start_turns"], margin)
        if not from_start:
            stand(chain)
        return chain, lambda time: chain.theta_after(exactly(time) * speed)
    chain = RouteChain(runs, route_path(path) if path["kind"] == "route" else turn_path(path), margin)
    follow(chain, ZERO - exactly(claim["start"]) * speed, ZERO - exactly(last) * speed)
    return chain, lambda time: ZERO - exactly(time) * speed


def stand(chain):
    """Check that the whole dragon can stand at the start of the spiral: no claim is about another one."""
    row = Row(chain, 0, chain.start)
    while len(row.placed) < len(chain.benches):
        row.grow()


def follow(chain, start, stop):
    """Check that the whole dragon is on the route from a place of the head to another."""
    pieces = chain.path.pieces
    tail = chain.places_behind(0, start, len(chain.benches))[-1]
    coils = isinstance(pieces[0], Coil) and pieces[0].inwards
    rounding = abs(pieces[-1].low) * exactly(2.0**-50)  # the end of a route is known to a double
    if stop + rounding < pieces[-1].low or (not coils and Interval(tail, tail) > pieces[0].high):
        raise Refused(f"{MALFORMED}: the dragon is not on the path all the time")


def turn_path(path):
    """Two tangent arcs between two coils, by 13."""
    radii = [path["entry_radius"], path.get("exit_radius", path["entry_radius"])]
    if max(radii) > path["turning_radius"] or not path["start_turns"] * path["pitch"] > path["turning_radius"]:
        raise Refused(f"{MALFORMED}: the turn must be entered and left within its circle, from outside of it")
    growth, ratio = exactly(path["pitch"]) / (TWO * PI), exactly(path["ratio"])
    start, (inner, outer) = TWO * PI * exactly(path["start_turns"]), (exactly(radius) / growth for radius in radii)
    if not (inner < start and outer < start):
        raise Refused(f"{MALFORMED}: the coil does not begin outside the turn")
    (entry, n1), (opposite, n2) = ((pointing(t) * (growth * t), normal_of(t)) for t in (inner, outer))
    apart, both, sum_of = entry + opposite, n1 * ratio + n2, ONE + ratio
    level, squared = (apart * both.back()).x, abs(apart) * abs(apart)
    curved = sum_of * sum_of - abs(both) * abs(both)
    second = squared / (sqrt(level * level + curved * squared) - level)
    first, along = second * ratio, (apart + both * second) * (ONE / (second * sum_of))  # -w
    angles = [clockwise(normal * along.back()) for normal in (n1, n2)]
    low, high = (exactly(size) for size in SIZES)
    if any(r < low or r > high or r * angle < SHORTEST for r, angle in zip((first, second), angles, strict=True)):
        raise Refused(f"{MALFORMED}: an arc of the turn is too small or too large")
    arcs = [Piece(r * angle, r, sign) for r, angle, sign in zip((first, second), angles, (-1, 1), strict=True)]
    pieces = [Coil(growth, start, inner), *arcs, Coil(growth, ZERO - outer, ZERO - start)]
    if pieces[0].length > exactly(10**9):
        raise Refused(f"{MALFORMED}: the coil of the turn must be at most 1e9 m long")
    return Path(pieces, 1, ZERO, Complex(ZERO), Complex(ONE))


def normal_of(theta):
    """n of 13."""
    return (pointing(theta) * Complex(ONE, theta)).left() * (ONE / sqrt(ONE + theta * theta))


def clockwise(z):
    """The argument of z from 0 to a whole turn, by 13."""
    return PI + TWO * atan((ZERO - z.y) / (abs(z) - z.x))


def route_path(path):
    """The pieces, joined exactly; they must meet as they are written, within 1e-9 m and rad."""
    given, before = [piece_of(**piece) for piece in path["pieces"]], None
    for k, (piece, shift, rotation) in enumerate(given):
        piece.high, piece.low, piece.shift, piece.rotation = ZERO, ZERO - piece.length, shift, rotation
        start, end = getattr(piece, "first", piece.high), getattr(piece, "last", piece.low)
        ends = [(piece.point(t), piece.tangent(t)) for t in (start, end)]
        if piece.length < SHORTEST:
            raise Refused(f"{MALFORMED}: claim.path.pieces[{k}] is too short")
        if before and straight(piece) and straight(given[k - 1][0]) and not abs(ends[0][1] - before[1]) < JOINED:
            piece.turn = ends[0][1] * before[1].back()
            before = before[0], ends[0][1]
        if before and any(abs(to - at) > JOINED for to, at in zip(ends[0], before, strict=True)):
            raise Refused(f"{MALFORMED}: claim.path.pieces[{k}] does not begin where the piece before it ends")
        before, piece.shift, piece.rotation = ends[1], Complex(ZERO), Complex(ONE)
    return Path([piece for piece, _, _ in given], 0, exactly(path["start"]), *given[0][1:])


def straight(piece):
    return not isinstance(piece, Coil) and piece.radius is None


def piece_of(kind, **given):
    """A piece, its shift and its rotation."""
    if kind == "line":
        start, end = (Complex(*map(exactly, given[name])) for name in ("start", "end"))
        along = end - start
        return Piece(abs(along)), start, along * (ONE / abs(along))
    centre = Complex(*map(exactly, given["centre"]))
    if kind == "arc":
        radius, sweep, out = exactly(given["radius"]), exactly(given["sweep"]), pointing(exactly(given["start_angle"]))
        sign = 1 if given["sweep"] > 0 else -1
        return Piece(radius * abs(sweep), radius, sign), centre + out * radius, out.left() * exactly(sign)
    sign = exactly(-1 if given["end_turns"] > given["start_turns"] else 1)
    first, last = (sign * TWO * PI * exactly(given[name]) for name in ("start_turns", "end_turns"))
    return Coil(exactly(given["pitch"]) / (TWO * PI), first, last), centre, pointing(exactly(given["rotation"]))


def moving(claim):
    return f"{described(claim['path'])}, its head at {claim['head_speed']!r} m/s"


def described(path):
    if path.get("kind") in ("turn", "free_turn"):
        leaves = f" and leaves {path['exit_radius']!r} m from it" if "exit_radius" in path else ""
        entered = f"which it enters {path['entry_radius']!r} m from the centre at 0 s{leaves}"
        coils = f"spirals of pitch {path['pitch']!r} m and {path['start_turns']!r} turns"
        return f"on the turn of ratio {path['ratio']!r}, {entered}, between {coils}"
    if path.get("kind") == "route":
        pieces = [", ".join(f"{name} {value}" for name, value in piece.items()) for piece in path["pieces"]]
        return (
            f"on the route ({'; '.join(pieces)}), joined exactly, its s = 0 at {path['start']!r} m from its beginning"
        )
    return f"on the spiral of pitch {path['pitch']!r} m inwards from {path['start_turns']!r} turns"


def minimum_pitch(runs, claim, overlap, *rest):
    pitch, turns, radius = (Fraction(claim[name]) for name in ("pitch", "start_turns", "turning_radius"))
    margin, within = claim.get("margin", 0), "start_within_circle" in overlap
    chain, less = Chain(runs, pitch, turns, margin), Chain(runs, pitch - PITCH_STEP, turns, margin)
    if radius > pitch * turns or (within and radius <= (pitch - PITCH_STEP) * turns):
        raise Refused("not proven: the start lies within the circle, or does not lie within it with 1e-6 m less")
    what, circle = "the head starts nearer", exactly(radius) / less.growth
    if "folds" in overlap:
        before, after = (exactly(theta) for theta in overlap["head_theta"])
        bench = overlap["folds"]
        if not (bench < len(less.benches) and circle < after < before < less.start):
            raise Refused("not proven: the fold is not shown to be on the way to the circle with 1e-6 m less")
        fold(less, bench, before, after)
        what = f"bench {bench} cannot follow so far (it folds)"
    elif not within:
        head = exactly(overlap["head_theta"])
        if not circle < head < less.start:
            raise Refused("not proven: the overlap is not shown to be on the way to the circle with 1e-6 m less")
        what = overlapping(less, head, *overlap["benches"]) + " on the way"
    all_apart(chain, chain.start, exactly(radius) / chain.growth, *rest, follows=True)
    until = f"until the head is {float(radius)!r} m from the centre"
    return f"{described(claim)}: {never(chain)} {until}, and with a pitch 1e-6 m smaller {what}"


# The form of a member: an object of members, a list of (entry, entry, ...), one with at least one entry, [each], or one
# that may be empty, [each, each], or one of these.
WORDS = {str: "a text", dict: "an object", list: "a list", bool: "true"}
WORDS |= {int: "a whole number from 0 to 1e15", float: "a number from -1e15 to 1e15"}
MEMBERS = {"format": str, "precision": int, "repeats_from": int, "digest": str, "claim": dict, "sweeps": list}
MEMBERS |= {"versions": {"python-flint": str, "flint": str}, "dragon": [(int, float, float, float)]}
SPIRAL = {"pitch": float, "start_turns": float}
POINT = (float, float)
PIECES = {"line": {"start": POINT, "end": POINT}}
PIECES |= {"arc": {"centre": POINT, "radius": float, "start_angle": float, "sweep": float}}
PIECES |= {"coil": {"pitch": float, "start_turns": float, "end_turns": float, "centre": POINT, "rotation": float}}
PATHS = {"spiral": SPIRAL, "turn": SPIRAL | {"turning_radius": float, "ratio": float, "entry_radius": float}}
PATHS |= {"free_turn": PATHS["turn"] | {"exit_radius": float}, "route": {"start": float, "pieces": [dict]}}
DANCE = {"path": dict, "head_speed": float, "start": float}
CLAIMS = {
    "collision-time": (collision_time, SPIRAL | {"head_speed": float, "time": float}),
    "minimum-pitch": (minimum_pitch, SPIRAL | {"turning_radius": float}),
    "contact": (contact, DANCE | {"time": float}),
    "clear": (clear_run, DANCE | {"stop": float, "until": str}),
    "tolerance": (tolerance, SPIRAL | {"head_speed": float, "start": float, "stop": float, "stray": float}),
}
PAIR = {"benches": (int, int)}
POSE = PAIR | {"time": float, "head": (float, float), "headings": [float]}
PITCHES = ({"start_within_circle": bool}, {"folds": int, "head_theta": (float, float)}, PAIR | {"head_theta": float})
# The ranges of numbers: metres, turns and metres a second.
SIZES, RANGES = (1e-3, 1e4), {"pitch": (1e-3, 1e4), "turning_radius": (1e-3, 1e4), "head_speed": (1e-6, 1e4)}
RANGES |= {
    "start_turns": (5e-324, 1e5),
    "margin": (5e-324, 1e4),
    "precision": (53, 4096),
    "radius": (1e-3, 1e4),
    "stray": (5e-324, 1e4),
}
RANGES |= {"shown": (5e-324, 1e15), "ratio": (0.01, 100.0), "entry_radius": (1e-3, 1e4), "exit_radius": (1e-3, 1e4)}


def check_form(value, form, place):
    """Refuse a value that has not this form, naming the place."""
    if isinstance(form, dict) and isinstance(value, dict):
        for name in [*form, *value]:
            inside = f"{place}.{json.dumps(name)[1:-1][:40]}".removeprefix(".")
            if name not in value or name not in form:
                raise Refused(f"{MALFORMED}: {inside} is {'unknown' if name in value else 'missing'}")
            check_form(value[name], form[name], inside)
    elif type(value) is list and (
        (type(form) is list and (value or len(form) > 1)) or (type(form) is tuple and len(form) == len(value))
    ):
        for k, entry in enumerate(value):
            check_form(entry, form[k % len(form)], f"{place}[{k}]")
    elif type(value) not in (form, int if form is float else form) or not (
        form in (str, dict, list) or (value is True if form is bool else -1e15 * (form is float) <= value <= 1e15)
    ):
        want = f"a list of {len(form)}" if type(form) is tuple else WORDS[form if type(form) is type else type(form)]
        raise Refused(f"{MALFORMED}: {place or 'it'} must be {want}, got {json.dumps(value)[:40]}")


def check_claim(certificate):
    """Check the form and the ranges of all that a certificate holds; returns how its claim is proven."""
    claim = certificate.get("claim")
    kind = claim.get("kind") if isinstance(claim, dict) else None
    strays = kind == "tolerance"
    ends = "shown" in claim if strays else kind != "clear"
    check_form(certificate, MEMBERS | ({"overlap": dict} if ends else {}), "")
    if certificate["format"] != "bench-dragon proof 1" or kind not in list(CLAIMS):
        raise Refused(f"{MALFORMED}: its format or claim.kind is another")
    prove, form = CLAIMS[kind]
    more = {"shown" if strays else "margin": float}
    check_form(claim, form | {"kind": str} | (more if claim.keys() & more else {}), "claim")
    if "path" in claim:
        check_path(claim["path"])
    if ends:
        overlap = certificate["overlap"]
        which = 0 if overlap.keys() == {"start_within_circle"} else 1 if "folds" in overlap else 2
        check_form(overlap, POSE if strays else PITCHES[which] if kind == "minimum-pitch" else PAIR, "overlap")
    sweep = {"bench": int, "stretches": list}
    check_form(certificate["sweeps"], [sweep, sweep], "sweeps")
    for a, sweep in enumerate(certificate["sweeps"]):
        for k, stretch in enumerate(sweep["stretches"]):
            form = (float, float, [[int], [int]] if strays else str)
            if not strays and type(stretch) is list and len(stretch) == 4:
                form = (*form, [float, float])
            check_form(stretch, form, f"sweeps[{a}].stretches[{k}]")
    check_ranges(claim | {"precision": certificate["precision"]})
    return prove


def check_path(path):
    """Check the form and the ranges of a path."""
    if path.get("kind") not in list(PATHS):
        raise Refused(f"{MALFORMED}: claim.path.kind is another")
    check_form(path, PATHS[path["kind"]] | {"kind": str}, "claim.path")
    check_ranges(path if path["kind"] != "route" else {})
    for piece in path.get("pieces", ()):
        if piece.get("kind") not in list(PIECES):
            raise Refused(f"{MALFORMED}: a piece of the path has another kind")
        check_form(piece, PIECES[piece["kind"]] | {"kind": str}, "claim.path.pieces")
        check_ranges({name: value for name, value in piece.items() if name in ("pitch", "radius")})
        for name, value in piece.items():
            numbers, most = value if isinstance(value, list) else [value], PLACES.get(name, 1e5)
            if name != "kind" and (min(numbers) < (0 if name[-5:] == "turns" else -most) or max(numbers) > most):
                raise Refused(f"{MALFORMED}: {name} of a piece must be within {most:.5g}, got {value!r}")
    if abs(path.get("start", 0.0)) > 1e9:
        raise Refused(f"{MALFORMED}: claim.path.start must be within 1e9 m")


PLACES = {"start": 1e5, "end": 1e5, "centre": 1e5, "start_angle": 1e6, "sweep": 1e6, "rotation": 1e6}


def check_ranges(values):
    for name, value in values.items():
        low, high = RANGES.get(name, (-math.inf, math.inf))
        if name in RANGES and not low <= value <= high:
            raise Refused(f"{MALFORMED}: {name} must be from {low:.5g} to {high:.5g}, got {value!r}")


def check_dragon(runs):
    for k, (count, length, width, overhang) in enumerate(runs):
        low, high = SIZES
        fits = low <= length <= high and low <= width <= high and 0 <= overhang <= high
        if not (count >= 1 and fits and length - 2.0 * overhang >= low):
            raise Refused(f"{MALFORMED}: dragon[{k}] must be benches of 0.001 to 10000 m with room for a chord")
    if not 1 <= sum(run[0] for run in runs) <= BENCHES_MOST:
        raise Refused(f"{MALFORMED}: dragon must be 1 to {BENCHES_MOST} benches")


def text_of(value):
    """The text of which the digest is taken."""
    if isinstance(value, dict):
        return "{" + ",".join(f"{name!r}:{text_of(value[name])}" for name in sorted(value)) + "}"
    return "[" + ",".join(map(text_of, value)) + "]" if isinstance(value, list) else repr(value)


def verified(certificate):
    """Statement that the certificate proves, in words."""
    LEFT[0] = BENDS_MOST
    check_form(certificate, dict, "")
    prove = check_claim(certificate)
    runs, claim, overlap = certificate["dragon"], certificate["claim"], certificate.get("overlap", {})
    content = {name: value for name, value in certificate.items() if name != "digest"}
    if certificate["digest"] != hashlib.sha256(text_of(content).encode()).hexdigest():
        raise Refused("the certificate was changed after it was made: its digest does not fit")
    check_dragon(runs)
    statement = prove(runs, claim, overlap, certificate["sweeps"], certificate["repeats_from"])
    count = sum(run[0] for run in runs)
    sizes = "; ".join(f"{n} of {long!r} m by {wide!r} m, overhang {over!r} m" for n, long, wide, over in runs)
    dragon = f"A dragon of {count} bench{'es' * (count > 1)} ({sizes})"
    return re.sub(r"(\d)\.0\b", r"\1", f"{dragon} {statement}.")


def members(pairs):
    if len(dict(pairs)) != len(pairs):
        raise ValueError("a name stands twice in one object")
    return dict(pairs)


def read(place):
    """Bytes of a file, or of standard input for -. raises: OSError"""
    if place == "-":
        return sys.stdin.buffer.read(BYTES_MOST)
    with open(place, "rb") as file:
        return file.read(BYTES_MOST)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description="Verify a certificate of bench-dragon prove.")
    parser.add_argument("certificate")
    place = parser.parse_args().certificate
    try:
        print("Verified:", verified(json.loads(read(place), object_pairs_hook=members)))
    except OSError as why:
        parser.error(f"argument certificate: can't open '{place}': {why}")
    except RecursionError:
        parser.exit(1, f"Refused: {MALFORMED}: objects and lists are nested too deeply\n")
    except (ArithmeticError, ValueError) as why:
        what = "" if isinstance(why, Refused) else f"{MALFORMED}: it is no JSON of up to 16 MB: "
        parser.exit(1, f"Refused: {what}{why}\n")
