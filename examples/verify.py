#!/usr/bin/env python3
"""Verify a certificate of `bench-dragon prove`, trusting nothing of Bench Dragon: python verify.py CERTIFICATE

Exit code 0: the certificate proves the claim that is printed. 1: it does not, for the reason that is printed. 2:
wrong usage, or a file that cannot be read. 3: the claim is of a kind that is not judged here: this says nothing about
whether it is true; `bench-dragon prove --check` judges it. Only the standard library is used. Floating point only
guesses; whole numbers decide. The verdict rests on the mathematics written down here, and on the code below.


The dance and the claims
------------------------
A handle at theta >= 0 (an angle that is not reduced by whole turns, [rad]) stands at distance b theta from the
centre, b = pitch / (2 pi), in the direction theta. The head, handle 0, starts at theta = 2 pi start_turns and walks
inwards along this spiral with head_speed. Bench k is a rectangle, length x width, with handles k and k + 1 on its
long middle line, each overhang from one end, so that they are chord = length - 2 overhang apart. Handle k + 1 is the
first point at that distance which one meets from handle k outwards along the spiral. Benches k and k + 1 share a
handle, and are not judged. Two other benches touch when their rectangles have a point in common, and overlap when
their interiors have. All numbers are in metres, seconds and radians, and exactly those that stand in the certificate.
The claims:
  collision-time  From the start to time - 1e-10 s nothing touches, and at time + 1e-10 s two benches overlap.
  minimum-pitch   Nothing touches while the head walks from the start until it is turning_radius from the centre. With
                  a pitch 1e-6 m smaller, two benches overlap while the head is on that way, or the start lies within
                  that circle. (Of other pitches it says nothing.)
Not judged are claims with a margin, clear runs, strays, other paths, and minimum pitches below which a bench folds.

A certificate has `dragon`, runs of benches alike from the head on as [how many, length, width, overhang]; `claim`;
the benches in `overlap` (6.), with head_theta for a pitch; and the `sweeps`, u + 1 with u = `repeats_from` (5.):
sweep a has the bench a, and stretches [highest theta, lowest theta, faces] of its front handle (3.). `versions` and
`precision` say how it was made and prove nothing; `digest` tells accidents, for it is easily made to fit.


Arithmetic
----------
An Interval has two whole numbers lo <= hi and stands for all reals from lo / 2^BITS to hi / 2^BITS. Every operation
rounds outwards, so that it encloses all results for all reals in its operands; x < y says that it holds for all of
them.
  log   log(y) = 2 log(sqrt y), and for 1 <= y <= 2 it is 2 (x + x^3/3 + x^5/5 + ...), x = (y - 1) / (y + 1) <= 1/2.
        After the term of x^129 less than x^131 / 98 is left, and that is less than a unit (2^-BITS).
  cos   At one point: k half turns are subtracted, |k| <= 320, which leaves |t| < 1.571, and adds 320 times the width
        of PI, 3 units. Then 1 - t^2/2! + ... - t^42/42!, whose rest is below t^44/44! < 2^-151. Each term is the one
        before times -t^2 / (n (n + 1)), rounded twice: no term is off by more than 3 units. All this is below
        COSINE_ERROR. Over an interval cos lies between its values at the ends, and +-1 at the whole half turns
        inside.
  root  A continuous function that rises takes a value between two places if it takes less at one and more at the
        other.
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
"""

import argparse
import hashlib
import json
import math
from bisect import bisect_left
from fractions import Fraction
from functools import lru_cache

# COSINE_ERROR is in units, TIME_BRACKET in seconds, PITCH_STEP in metres.
BITS, UNIT, COSINE_ERROR, TIME_BRACKET, PITCH_STEP = 128, 1 << 128, 1 << 12, Fraction(1, 10**10), Fraction(1, 10**6)
# Limits on the work: of the bytes and benches of a certificate, and of the bends (1.) that it needs.
BYTES_MOST, BENCHES_MOST, BENDS_LEFT = 1 << 24, 10_000_000, iter(range(5_000_000))
NEVER, MALFORMED = "no two benches except neighbours touch", "the certificate is malformed"
KNOWN = "this verifier judges only collision times and minimum pitches, at margin 0 and without a fold"


class Refused(ValueError):
    """The certificate does not prove its claim."""


class NotJudged(Refused):
    """The claim may be proven, but is of a kind that this verifier does not know."""


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


def exactly(number):
    """A whole number, a float or a fraction as it stands."""
    over, under = number.as_integer_ratio()
    return Interval((over << BITS) // under, -((-over << BITS) // under))


def hull(x, y):
    return Interval(min(x.lo, y.lo), max(x.hi, y.hi))


def sqrt(x):
    """Square root of an interval, for x >= 0."""
    return Interval(math.isqrt(x.lo << BITS), math.isqrt(x.hi << BITS) + 1)


ZERO, HALF, ONE, TWO = (exactly(number) for number in (0, 0.5, 1, 2))
PI = exactly(Fraction(31415926535897932384626433832795028841971693993751, 10**49)) + Interval(-1, 1)


def log(y):
    """Natural logarithm of an interval, for y >= 1."""
    if y.hi > 2 * UNIT:
        return TWO * log(sqrt(y))
    x = total = power = (y - ONE) / (y + ONE)
    for n in range(3, 131, 2):
        power = power * x * x
        total = total + power / exactly(n)
    return TWO * (total + Interval(0, 1))


def cos(x):
    if x.hi - x.lo > 6 * UNIT or abs(x.lo) > 999 * UNIT:
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
    """The dragon on a spiral: growth b, start, every bench, the longest chord, the largest h."""

    def __init__(self, runs, pitch, turns):
        self.growth, self.start = exactly(pitch) / (TWO * PI), TWO * PI * exactly(turns)
        kinds = {tuple(sizes): Bench(*sizes, self.growth) for _, *sizes in runs}
        self.benches = [kinds[tuple(sizes)] for count, *sizes in runs for _ in range(count)]
        self.chord = Interval(0, max(kind.chord.hi for kind in kinds.values()))
        self.reach = Interval(0, max(kind.reach.hi for kind in kinds.values()))

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
    if theta.lo < 0 or next(BENDS_LEFT, None) is None:
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


class Row:
    """The benches from one on, while the front handle of the first goes from low to high, or stays at low."""

    def __init__(self, chain, bench, low, high=None):
        self.chain, self.bench, self.width = chain, bench, high and high - low
        self.ends = [Row(chain, bench, end) for end in (low, high) if high]
        self.theta, self.turn, self.rate = hull(low, high or low), ZERO, ONE
        self.x, self.y = Moving(chain.growth * self.theta, chain.growth), Moving(ZERO)
        self.placed = []  # bench, centre, direction

    def grow(self):
        """Place the next bench."""
        bench, growth = self.chain.benches[self.bench + len(self.placed)], self.chain.growth
        bends = bend(self.theta, bench)
        by_theta, by_bend = slopes(self.theta, bends)
        self.rate *= ONE - by_theta / by_bend
        self.theta, self.turn, spin = self.theta + bends, self.turn + bends, self.rate - ONE
        if ends := [end.grow() for end in self.ends]:
            self.theta = self.passed(*(end.theta for end in ends), self.rate)
            self.turn = self.passed(*(end.turn for end in ends), spin)
        radius, sine, cosine = Moving(growth * self.theta, growth * self.rate), sin(self.turn), cos(self.turn)
        front_x, front_y, half, short = self.x, self.y, Moving(HALF), Moving(ONE / bench.chord)
        self.x, self.y = radius * Moving(cosine, (ZERO - sine) * spin), radius * Moving(sine, cosine * spin)
        centre = (front_x + self.x) * half, (front_y + self.y) * half
        self.placed.append((bench, *centre, (front_x - self.x) * short, (front_y - self.y) * short))
        return self

    def passed(self, at_low, at_high, rate):
        """All values of what changes at this rate."""
        return hull(at_low, at_high) if rate > ZERO or rate < ZERO else at_low + rate * hull(ZERO, self.width)

    def gaps(self, partner, face):
        """g of 3., for the four corners. partner: counted from the first bench."""
        a, b = (0, partner) if face < 4 else (partner, 0)
        (own, x_a, y_a, out_x, out_y), (other, x_b, y_b, along_x, along_y) = self.placed[a], self.placed[b]
        for _ in range(face % 4):
            out_x, out_y = Moving(ZERO) - out_y, out_x
        to = out_x * (x_b - x_a) + out_y * (y_b - y_a) - Moving(own.y if face % 2 else own.x)
        across = (out_x * along_x + out_y * along_y) * Moving(other.x)
        beside = (out_y * along_x - out_x * along_y) * Moving(other.y)
        return to + across + beside, to + across - beside, to - across - beside, to - across + beside

    def apart(self, partner, face):
        """Check by 3. of the docstring that this bench and a partner are apart, by one face."""
        pair = f"benches {self.bench} and {self.bench + partner} are not apart by face {face}"
        for low, high, between in zip(*(row.gaps(partner, face) for row in (*self.ends, self)), strict=True):
            low, high, slope = low.value, high.value, between.rate
            if not (low > ZERO and high > ZERO):
                raise Refused(f"not proven: {pair} at an end")
            least, most = Interval(slope.lo, slope.lo), Interval(slope.hi, slope.hi)
            if slope.lo < 0 < slope.hi and not most * low - least * high + least * most * self.width > ZERO:
                raise Loose(f"not proven: {pair} all over a stretch")

    def all_far(self, rear):
        """True if, by 4., this bench is apart from all benches that are not placed."""
        chain, nearest = self.chain, self.chain.growth * self.theta
        apart = chain.growth * rear + chain.benches[self.bench].reach + chain.reach
        return apart * apart < nearest * nearest - chain.chord * chain.chord * HALF * HALF


def covered(chain, bench, low, high, faces, places, halvings=3):
    """Angle of the next handle over a stretch in which these faces show this bench apart from the others [rad]."""
    try:
        row = Row(chain, bench, low, high).grow()
        rear, rises = row.theta, row.rate > ZERO
        while len(row.placed) < min(len(faces) + 2, len(chain.benches) - bench):
            row.grow()
        # The benches that are missing at the end are as many as the places below this stretch.
        if not (bench + len(row.placed) + bisect_left(places, low.lo) >= len(chain.benches) or row.all_far(rear)):
            raise Loose("not proven: pairs are missing")
        for partner, face in enumerate(faces, 2):
            row.apart(partner, int(face))
        if not rises and len(places) > 1 and rear.hi > places[1]:
            raise Loose(f"not proven: handle {bench + 1} may turn back far outside")
        return rear
    except Loose:
        if not halvings:
            raise
    halves = (low, (low + high) * HALF), ((low + high) * HALF, high)
    return hull(*(covered(chain, bench, *half, faces, places, halvings - 1) for half in halves))


def all_apart(chain, high, low, sweeps, repeats_from):
    """Check by 5. that no two benches touch while the head goes in from high to low."""
    count, way = len(chain.benches), hull(low, high)
    if repeats_from > max(0, count - 3) or (repeats_from < count - 3 and len(set(chain.benches[repeats_from:])) > 1):
        raise Refused(f"not proven: the benches from {repeats_from} on are not alike, or have no pairs")
    if [sweep["bench"] for sweep in sweeps] != list(range(repeats_from + 1)) and (sweeps or not low > high):
        raise Refused(f"not proven: the sweeps are not those of benches 0 to {repeats_from}, each once, in this order")
    for bench, sweep in enumerate(sweeps):
        theta, places, rears, end = Interval(way.hi, way.hi), [way.hi], [], None
        for kind in chain.benches[bench : max(0, count - 3)] if bench == repeats_from else ():
            theta = theta + bend(theta, kind)
            places.append(theta.hi)
        for k, (first, last, faces) in enumerate(sweep["stretches"]):
            name = f"sweeps[{bench}].stretches[{k}], theta from {first!r} to {last!r} rad"
            if not (last < first and len(faces) <= max(0, count - bench - 2) and set(faces) <= set("01234567")):
                raise Refused(f"{MALFORMED}: {name} with its faces is no stretch of this dragon")
            if first != end if rears else exactly(first).lo < theta.hi:
                raise Refused(f"not proven: the stretches do not join at {name}")
            try:
                rears.append(covered(chain, bench, exactly(last), exactly(first), faces, places))
            except Refused as why:
                raise Refused(f"{why}, in {name}") from None
            end = last
        if not rears or exactly(end).hi > way.lo:
            raise Refused(f"not proven: the sweep of bench {bench} ends short of its way, at theta = {end!r} rad")
        way = Interval(min(rear.lo for rear in rears), max(rear.hi for rear in rears))


def overlapping(chain, head, a, b):
    """6., when the head is there."""
    if not 0 <= a < b - 1 < len(chain.benches) - 1:
        raise Refused(f"not proven: benches {a} and {b} are not two benches that share no handle")
    for bench in chain.benches[:a]:
        head = head + bend(head, bench)
    row = Row(chain, a, head)
    while len(row.placed) <= b - a:
        row.grow()
    if not all(any(gap.value < ZERO for gap in row.gaps(b - a, face)) for face in range(8)):
        raise Refused(f"not proven: benches {a} and {b} are not shown to overlap")
    return f"benches {a} and {b} overlap"


def collision_time(runs, claim, overlap, *rest):
    chain, speed, time = Chain(runs, claim["pitch"], claim["start_turns"]), claim["head_speed"], claim["time"]
    before, after = (exactly(Fraction(time) + off) * exactly(speed) for off in (-TIME_BRACKET, TIME_BRACKET))
    what = overlapping(chain, chain.theta_after(after), *overlap["benches"])
    all_apart(chain, chain.start, chain.theta_after(before), *rest)
    clear = f"{NEVER} from 0 s to {time!r} - 1e-10 s, and" if time > TIME_BRACKET else "within 2e-10 s of the start"
    return f", its head at {speed!r} m/s: {clear} {what} at {time!r} + 1e-10 s"


def minimum_pitch(runs, claim, overlap, *rest):
    pitch, turns, radius = (Fraction(claim[name]) for name in ("pitch", "start_turns", "turning_radius"))
    chain, less, what = Chain(runs, pitch, turns), Chain(runs, pitch - PITCH_STEP, turns), "the head starts nearer"
    if radius > pitch * turns or ("benches" not in overlap and radius <= (pitch - PITCH_STEP) * turns):
        raise Refused("not proven: the start lies within the circle, or does not lie within it with 1e-6 m less")
    if "benches" in overlap:
        if not exactly(radius) / less.growth < (head := exactly(overlap["head_theta"])) < less.start:
            raise Refused("not proven: the overlap is not shown to be on the way to the circle with 1e-6 m less")
        what = overlapping(less, head, *overlap["benches"]) + " on the way"
    all_apart(chain, chain.start, exactly(radius) / chain.growth, *rest)
    return f": {NEVER} until the head is {float(radius)!r} m from the centre, and with a pitch 1e-6 m smaller {what}"


# The form of a member: an object of members, [each entry], (entry, entry, ...), or one of these.
WORDS = {str: "a text", dict: "an object", list: "a list", bool: "true"}
WORDS |= {int: "a whole number from 0 to 1e15", float: "a number from 0 to 1e15"}
MEMBERS = {"format": str, "precision": int, "repeats_from": int, "digest": str, "claim": dict, "overlap": dict}
MEMBERS |= {"versions": {"python-flint": str, "flint": str}, "dragon": [(int, float, float, float)]}
MEMBERS |= {"sweeps": [{"bench": int, "stretches": [(float, float, str)]}]}
SPIRAL, PAIR = {"kind": str, "pitch": float, "start_turns": float}, {"benches": (int, int)}
CLAIMS = {"collision-time": (collision_time, SPIRAL | {"head_speed": float, "time": float}, PAIR)}
CLAIMS |= {"minimum-pitch": (minimum_pitch, SPIRAL | {"turning_radius": float}, PAIR | {"head_theta": float})}


def check_form(value, form, place):
    """Refuse a value that has not this form, naming the place."""
    if isinstance(form, dict) and isinstance(value, dict):
        for name in [*form, *value]:
            inside = f"{place}.{json.dumps(name)[1:-1][:40]}".removeprefix(".")
            if name not in value or name not in form:
                raise Refused(f"{MALFORMED}: {inside} is {'unknown' if name in value else 'missing'}")
            check_form(value[name], form[name], inside)
    elif type(value) is list and (type(form) is list or (type(form) is tuple and len(form) == len(value))):
        for k, entry in enumerate(value):
            check_form(entry, form[k % len(form)], f"{place}[{k}]")
    elif type(value) not in (form, int if form is float else form) or not (form in (str, dict) or 0 <= value <= 1e15):
        want = f"a list of {len(form)}" if type(form) is tuple else WORDS[form if type(form) is type else type(form)]
        raise Refused(f"{MALFORMED}: {place or 'it'} must be {want}, got {json.dumps(value)[:40]}")


def verified(certificate, not_judged=("margin", "folds", "clear", "contact", "tolerance")):
    """Statement that the certificate proves, in words."""
    check_form(certificate, dict, "")
    inside = [item for part in certificate.values() if isinstance(part, dict) for item in part.items()]
    if other := {name: value for name, value in inside if name in not_judged or value in not_judged}:
        raise NotJudged(f"not judged: {KNOWN}, and this certificate has {json.dumps(other)[:60]}")
    check_form(certificate, MEMBERS, "")
    runs, claim, overlap = (certificate[name] for name in ("dragon", "claim", "overlap"))
    if certificate["format"] != "bench-dragon proof 1" or claim.get("kind") not in list(CLAIMS):
        raise Refused(f"{MALFORMED}: its format or claim.kind is another")
    prove, claim_form, overlap_form = CLAIMS[claim["kind"]]
    check_form(claim, claim_form, "claim")
    within = prove is minimum_pitch and "start_within_circle" in overlap
    check_form(overlap, {"start_within_circle": bool} if within else overlap_form, "overlap")
    told, text = certificate.pop("digest"), json.dumps(certificate, sort_keys=True, separators=(",", ":"))
    if told != hashlib.sha256(text.replace('"', "'").replace(":true", ":True").encode()).hexdigest():
        raise Refused("the certificate was changed after it was made: its digest does not fit")
    usable = all(count >= 1 and length > 2 * Fraction(overhang) for count, length, _, overhang in runs)
    if not usable or not 1 <= (count := sum(run[0] for run in runs)) <= BENCHES_MOST:
        raise Refused(f"{MALFORMED}: dragon must be 1 to {BENCHES_MOST} benches with room for a chord")
    statement = prove(runs, claim, overlap, certificate["sweeps"], certificate["repeats_from"])
    sizes = "; ".join(f"{n} of {long!r} m by {wide!r} m, overhang {over!r} m" for n, long, wide, over in runs)
    dragon = f"A dragon of {count} bench{'es' * (count > 1)} ({sizes}) on the spiral of pitch {claim['pitch']!r} m"
    return f"{dragon} inwards from {claim['start_turns']!r} turns{statement}; the margin is 0 m.".replace(".0 ", " ")


def members(pairs):
    if len(dict(pairs)) != len(pairs):
        raise ValueError("a name stands twice in one object")
    return dict(pairs)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description="Verify a certificate of bench-dragon prove.")
    parser.add_argument("certificate", type=argparse.FileType("rb"))
    try:
        data = parser.parse_args().certificate.read(BYTES_MOST)
        print("Verified:", verified(json.loads(data, object_pairs_hook=members)))
    except (ArithmeticError, RecursionError, ValueError) as why:
        what = "" if isinstance(why, Refused) else f"{MALFORMED}: it is no JSON of up to 16 MB: "
        parser.exit(3 if isinstance(why, NotJudged) else 1, f"Refused: {what}{why}\n")
