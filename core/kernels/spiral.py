"""The spiral: arc length, the next handle, and the trajectory.

r = growth theta. Arc length from the centre, in units of growth: (theta sqrt(1 + theta^2) + asinh theta) / 2.
Its derivative sqrt(1 + theta^2) increases, so Newton from theta = sqrt(2 arc) >= the root falls monotonically.
"""

import cython
from cython.cimports.libc.math import asinh, atanh, cos, fabs, sin, sqrt

if not cython.compiled:  # the .pxd imports the same names for the compiler
    from core.kernels.constants import *
    from core.kernels.fold import first_root

COMPILED = cython.compiled

# Largest last step of Halley's iteration, relative to delta and to f_delta / |f_delta_delta| [1]: the error that
# remains is below 0.32 ULP of delta, see rounding.py.
HALLEY_STEP = 2e-6
# Largest half angle at which the Taylor sums of half_sine() and half_cosine() are good to 5e-17 of themselves [rad].
SERIES_LIMIT = 0.5


def spiral_arc(theta):
    """Arc length from the centre to theta, in units of growth."""
    return 0.5 * (theta * sqrt(1.0 + theta * theta) + asinh(theta))


def spiral_theta(arc):
    """Polar angle at an arc length from the centre, in units of growth (0 for a negative one)."""
    if arc <= 0.0:
        return 0.0
    theta = sqrt(2.0 * arc)
    for i in range(60):
        step = (spiral_arc(theta) - arc) / sqrt(1.0 + theta * theta)
        theta -= step
        if fabs(step) <= 1e-15 * theta:
            break
    return theta


def half_sine(half):
    """sin of a half angle up to SERIES_LIMIT, by its series."""
    z = half * half
    z2 = z * z
    head = -1.0 / 6.0 + z * (1.0 / 120.0)
    tail = -1.0 / 5040.0 + z * (1.0 / 362880.0) + z2 * (-1.0 / 39916800.0 + z * (1.0 / 6227020800.0))
    return half + half * z * (head + z2 * tail)


def half_cosine(half):
    """cos of a half angle up to SERIES_LIMIT, by its series."""
    z = half * half
    z2 = z * z
    head = -1.0 / 2.0 + z * (1.0 / 24.0) + z2 * (-1.0 / 720.0 + z * (1.0 / 40320.0))
    tail = -1.0 / 3628800.0 + z * (1.0 / 479001600.0) + z2 * (-1.0 / 87178291200.0)
    return 1.0 + z * (head + z2 * z2 * tail)


# The next handle is at the first root of f (fold.py).


def halley_step(theta, chord2, delta, s, c):
    """Step that Halley's iteration subtracts from delta, f_delta and f_delta_delta; s, c: sin and cos of delta / 2."""
    product = 2.0 * theta * (theta + delta)
    value = delta * delta + 2.0 * product * s * s - chord2
    slope = 2.0 * (delta + 2.0 * theta * s * s + product * s * c)
    curve = 2.0 + 8.0 * theta * s * c + product * (1.0 - 2.0 * s * s)
    return 2.0 * value * slope / (2.0 * slope * slope - value * curve), slope, curve


def next_handle(theta, chord2, guess):
    """delta, sin(delta / 2), cos(delta / 2) of the next handle; delta is NO_ROOT when the chain folds.

    Method: Halley's iteration from the guess; if it leaves (0, pi], the safe first_root().
    """
    delta = guess
    for i in range(12):
        half = 0.5 * delta
        if half <= SERIES_LIMIT:
            s = half_sine(half)
            c = half_cosine(half)
        else:
            s = sin(half)
            c = cos(half)
        step, slope, curve = halley_step(theta, chord2, delta, s, c)
        delta -= step
        if not (0.0 < delta <= PI) or slope <= 0.0:
            break
        if fabs(step) <= HALLEY_STEP * delta and fabs(step * curve) <= HALLEY_STEP * slope:
            step *= -0.5
            return delta, s + step * (c - 0.5 * step * s), c - step * (s + 0.5 * step * c)
    delta = first_root(theta, chord2)
    return delta, sin(0.5 * delta), cos(0.5 * delta)


def next_arc(theta, chord2, guess):
    """delta of the next handle and the arc to it, in units of growth; delta is NO_ROOT when the chain folds or turns at
    the centre.
    """
    delta, _, _ = next_handle(theta, chord2, guess)
    if delta > 0.0 and theta * (theta + delta) > 0.0:
        return delta, arc_between(fabs(theta), fabs(theta + delta), delta)
    return NO_ROOT, 0.0


def arc_between(a, b, delta):
    """Arc between two polar angles that are delta apart, in units of growth, without cancellation.

    With l = sqrt(1 + theta^2), l_b - l_a = (b - a) (b + a) / (l_b + l_a), and asinh b - asinh a is the logarithm of
    q = (b + l_b) / (a + l_a), or 2 atanh y, y = (q - 1) / (q + 1): up to 0.05 by its series.
    """
    far = max(a, b)
    near = min(a, b)
    length = sqrt(1.0 + near * near)
    rise = delta * (far + near) / (sqrt(1.0 + far * far) + length)
    y = (delta + rise) / (2.0 * (near + length) + delta + rise)
    if y > 0.05:
        return 0.5 * (far * rise + delta * length + 2.0 * atanh(y))
    z = y * y
    series = z * (1.0 / 3.0 + z * (1.0 / 5.0 + z * (1.0 / 7.0 + z * (1.0 / 9.0 + z * (1.0 / 11.0)))))
    return 0.5 * (far * rise + delta * length) + y + y * series


def theta_ratio(theta, delta, s, c):
    """d theta[k+1] / d theta[k] = (f_delta - f_theta) / f_delta: the rigid link (T[k] . u) / (T[k+1] . u)."""
    sine = 2.0 * s * c
    rise = 2.0 * s * s
    shared = delta + theta * (theta + delta) * sine
    return (shared - (theta + delta) * rise) / (shared + theta * rise)


def first_guess(theta, chord2):
    """First guess of next_handle() with no history: f = chord^2, 4 sin^2(delta / 2) = delta^2 (1 - delta^2 / 12)."""
    delta = sqrt(chord2 / (1.0 + theta * theta))
    delta = delta if delta < 3.0 else 3.0
    delta = sqrt(chord2 / (1.0 + theta * (theta + delta) * (1.0 - delta * delta / 12.0)))
    return delta if delta < 3.0 else 3.0


# Time lanes. A handle depends on the handle before it, but an instant depends on no other. So a block of LANES instants
# advances together, handle by handle. The loops over lanes that compute have no branch, and gcc makes SIMD code of
# each (-fopt-info-vec). A lane that one Halley step leaves open, or that the series do not cover, is solved by
# next_handle(), whose first step is the same to the last bit: so the digits of a lane depend neither on its neighbours
# nor on its place in the block. The number of lanes stays a variable because gcc unrolls a loop of fixed length before
# it can vectorise it (0.85 ms instead of the 0.6 ms below), and because one instant should cost only one lane.
# Measured on 301 x 224 with SSE2, 2026-11-21: 1.23 ms (3.2 ms one instant after the other), of which this loop takes
# 0.58 ms and fresh memory for the tables 0.5 ms. AVX2 would save 0.2 ms; 4 lanes cost 0.07 ms more, 16 gain nothing.
LANES_PER_BLOCK = 8
LANES = LANES_PER_BLOCK
Lanes = cython.typedef(cython.double[8])  # LANES_PER_BLOCK, which the C compiler wants as a literal


class Block:
    """LANES instants that advance together, handle by handle: the state of the handle that each of them has come to.

    standing: number of lanes that no fold has stopped; theta: polar angle; x, y: the unit vector there; rate: d theta /
    d time; guess: of the next delta; d1, d2, d3: the last three deltas; delta, sine, cosine: the next delta, and sin
    and cos of its half
    """

    def __init__(self, growth):
        self.growth = growth
        self.standing = 0
        self.theta = [0.0] * 8
        self.x = [0.0] * 8
        self.y = [0.0] * 8
        self.rate = [0.0] * 8
        self.guess = [0.0] * 8
        self.d1 = [0.0] * 8
        self.d2 = [0.0] * 8
        self.d3 = [0.0] * 8
        self.delta = [0.0] * 8
        self.sine = [0.0] * 8
        self.cosine = [0.0] * 8

    def start(self, row, thetas, head_speed):
        """Place the heads of the instants from `row` on; returns the number of lanes."""
        lanes = min(thetas.shape[0] - row, LANES)
        self.standing = lanes
        for lane in range(lanes):
            self.theta[lane] = thetas[row + lane, HIGH]
            cosine = cos(self.theta[lane])
            sine = sin(self.theta[lane])
            self.x[lane] = cosine - thetas[row + lane, LOW] * sine
            self.y[lane] = sine + thetas[row + lane, LOW] * cosine
            self.rate[lane] = -head_speed / sqrt(1.0 + self.theta[lane] * self.theta[lane])
            self.d1[lane] = self.d2[lane] = self.d3[lane] = 0.0
        return lanes

    def expect(self, chord2, alike):
        """Guess delta in every lane that stands; alike: whether the last three links have this chord too."""
        if alike:
            for lane in range(self.standing):
                self.guess[lane] = 3.0 * (self.d1[lane] - self.d2[lane]) + self.d3[lane]
        else:
            for lane in range(self.standing):
                self.guess[lane] = first_guess(self.theta[lane], chord2)

    def solve(self, chord2):
        """Solve for delta in every lane that stands; from the first lane that folds on, none stands any more."""
        for lane in range(self.standing):
            half = 0.5 * self.guess[lane]
            s = half_sine(half)
            c = half_cosine(half)
            step, slope, curve = halley_step(self.theta[lane], chord2, self.guess[lane], s, c)
            reached = self.guess[lane] - step
            self.delta[lane] = (
                reached
                if (half <= SERIES_LIMIT)
                & (slope > 0.0)
                & (reached > 0.0)
                & (reached <= PI)
                & (fabs(step) <= HALLEY_STEP * reached)
                & (fabs(step * curve) <= HALLEY_STEP * slope)
                else NO_ROOT
            )
            step *= -0.5
            self.sine[lane] = s + step * (c - 0.5 * step * s)
            self.cosine[lane] = c - step * (s + 0.5 * step * c)
        for lane in range(self.standing):
            if self.delta[lane] == NO_ROOT:
                self.delta[lane], self.sine[lane], self.cosine[lane] = next_handle(
                    self.theta[lane], chord2, self.guess[lane]
                )
                if self.delta[lane] == NO_ROOT:
                    self.standing = lane
                    break

    def advance(self):
        """Advance to the next handle, by the delta that solve() found."""
        for lane in range(self.standing):
            self.rate[lane] *= theta_ratio(self.theta[lane], self.delta[lane], self.sine[lane], self.cosine[lane])
            sine = 2.0 * self.sine[lane] * self.cosine[lane]
            rise = 2.0 * self.sine[lane] * self.sine[lane]
            across = self.x[lane] - (self.x[lane] * rise + self.y[lane] * sine)
            self.y[lane] = self.y[lane] - (self.y[lane] * rise - self.x[lane] * sine)
            self.x[lane] = across
            self.theta[lane] += self.delta[lane]
            self.d3[lane] = self.d2[lane]
            self.d2[lane] = self.d1[lane]
            self.d1[lane] = self.delta[lane]


def write_handles(block, row, k, position, velocity, speed):
    """Write handle k of every lane that stands into the tables, from `row` on."""
    px = cython.declare(Lanes)
    py = cython.declare(Lanes)
    vx = cython.declare(Lanes)
    vy = cython.declare(Lanes)
    pace = cython.declare(Lanes)
    for lane in range(block.standing):
        px[lane] = block.growth * block.theta[lane] * block.x[lane]
        py[lane] = block.growth * block.theta[lane] * block.y[lane]
        vx[lane] = block.rate[lane] * (block.x[lane] - block.theta[lane] * block.y[lane])
        vy[lane] = block.rate[lane] * (block.y[lane] + block.theta[lane] * block.x[lane])
        pace[lane] = fabs(block.rate[lane]) * sqrt(1.0 + block.theta[lane] * block.theta[lane])
    for lane in range(block.standing):
        position[row + lane, k, X] = px[lane]
        position[row + lane, k, Y] = py[lane]
        velocity[row + lane, k, X] = vx[lane]
        velocity[row + lane, k, Y] = vy[lane]
        speed[row + lane, k] = pace[lane]


# Input:  a growth, the angle of the head at every instant in double-double, the chords, and the speed of the head.
# State:  `row`, the first instant of the block; `block`, the state of its lanes at handle k; `alike`, the number of
#         equal chords up to this one, whose deltas predict the next one.
# Output: a row of each table for every instant before a fold, and their number.
def spiral_trajectory(growth, thetas, chords, head_speed, position, velocity, speed, budget):
    """Fill in position, velocity and speed of every handle for every head angle; returns how many rows precede a fold.

    thetas: (T, 2) head angles, pairs; chords: (n,) [m]; position, velocity: (T, n + 1, 2); speed: (T, n + 1)
    budget: ends it before it is done, as if no row folded
    """
    row = 0
    block = Block(growth)
    with cython.nogil:
        while row < thetas.shape[0]:
            lanes = block.start(row, thetas, head_speed)
            alike = 0
            for k in range(chords.shape[0]):
                if budget.stopped:
                    return thetas.shape[0]
                write_handles(block, row, k, position, velocity, speed)
                alike = alike + 1 if k > 0 and chords[k] == chords[k - 1] else 0
                chord2 = (chords[k] / growth) * (chords[k] / growth)
                block.expect(chord2, alike > 2)
                block.solve(chord2)
                block.advance()
            write_handles(block, row, chords.shape[0], position, velocity, speed)
            if block.standing < lanes:
                return row + block.standing
            row += lanes
    return thetas.shape[0]


def spiral_curvature(theta):
    """Curvature of the spiral times its growth, falling with theta."""
    square = 1.0 + theta * theta
    return (1.0 + square) / (square * sqrt(square))
