# cython: language_level=3, boundscheck=False, wraparound=False, cdivision=True, initializedcheck=False
"""The compiled loops, in Cython's pure-Python mode: the same file runs uncompiled, slower.

Only loops live here. Angles are in radians, lengths on a spiral in units of its growth unless a name
says otherwise; no function allocates. -1.0 inside this file means "no such root" and never leaves core.
"""

import cython
from cython.cimports.libc.math import asin, asinh, cos, fabs, sin, sqrt

COMPILED = cython.compiled

PI = cython.declare(cython.double, 3.141592653589793)
TWO_PI = cython.declare(cython.double, 6.283185307179586)
# Halley's error after a step e is about e^3 / (4 scale^2), scale the less of delta and of f_delta / |f_delta_delta|,
# which falls to 0 at the crest of f: a step of 1e-5 of the scale leaves 3e-17 of it [1].
HALLEY_STEP = cython.declare(cython.double, 1e-5)
# Up to this half angle the Taylor sums of half_sine() and half_cosine() leave out less than 3e-17 [rad].
SERIES_LIMIT = cython.declare(cython.double, 0.5)
# The fold is searched in this many steps of delta from pi to 2 pi, then bisected.
FOLD_SAMPLES = cython.declare(cython.int, 256)
# A follower counts as arrived within this relative angle (60 bisections leave 1e-16) [1].
ARRIVAL = cython.declare(cython.double, 1e-12)


# -- the spiral -------------------------------------------------------------------------------------
# r = growth theta. Arc length from the centre, in units of growth: (theta sqrt(1 + theta^2) + asinh theta) / 2.
# Its derivative sqrt(1 + theta^2) increases, so Newton from theta = sqrt(2 arc) >= the root falls monotonically.


@cython.ccall
@cython.nogil
@cython.exceptval(check=False)
def spiral_arc(theta: cython.double) -> cython.double:
    """Arc length from the centre to theta, in units of growth."""
    return 0.5 * (theta * sqrt(1.0 + theta * theta) + asinh(theta))


@cython.ccall
@cython.nogil
@cython.exceptval(check=False)
def spiral_theta(arc: cython.double) -> cython.double:
    """Polar angle at an arc length from the centre, in units of growth (0 for a negative one)."""
    if arc <= 0.0:
        return 0.0
    theta: cython.double = sqrt(2.0 * arc)
    step: cython.double
    i: cython.int
    for i in range(60):
        step = (spiral_arc(theta) - arc) / sqrt(1.0 + theta * theta)
        theta -= step
        if fabs(step) <= 1e-15 * theta:
            break
    return theta


@cython.ccall
@cython.exceptval(check=False)
def spiral_thetas(arcs: cython.double[::1], thetas: cython.double[::1]) -> cython.void:
    """Polar angle for every arc length from the centre, in units of growth."""
    i: cython.Py_ssize_t
    with cython.nogil:
        for i in range(arcs.shape[0]):
            thetas[i] = spiral_theta(arcs[i])


# -- the next handle on the spiral ------------------------------------------------------------------
# Handles at theta and theta + delta are a chord apart when, in units of growth,
#     f(delta) = delta^2 + 4 theta (theta + delta) sin^2(delta / 2) = chord^2,
#     f_delta / 2 = h(delta) = delta + theta (1 - cos delta) + theta (theta + delta) sin delta,
#     f_theta / 2 = (2 theta + delta) (1 - cos delta) >= 0.
# h > 0 on (0, pi], so a root there is the first. Beyond pi,
#     h' = 1 + 2 theta sin delta + theta (theta + delta) cos delta,
#     h'' = 3 theta cos delta - theta (theta + delta) sin delta
# has one zero on (pi, 2 pi), from - to +: h' falls, then rises to h'(2 pi) > 0, so h has one least value after
# its last fall, and at most one zero before it: the first crest of f. A root lies before that crest, or there is
# none (the fold). As theta falls f falls, so the root grows: delta is a decreasing function of theta.


@cython.cfunc
@cython.inline
@cython.nogil
@cython.exceptval(check=False)
def half_sine(half: cython.double) -> cython.double:
    """sin of a half angle up to SERIES_LIMIT, by its series."""
    z: cython.double = half * half
    z2: cython.double = z * z
    head: cython.double = -1.0 / 6.0 + z * (1.0 / 120.0)
    tail: cython.double = -1.0 / 5040.0 + z * (1.0 / 362880.0) + z2 * (-1.0 / 39916800.0 + z * (1.0 / 6227020800.0))
    return half + half * z * (head + z2 * tail)


@cython.cfunc
@cython.inline
@cython.nogil
@cython.exceptval(check=False)
def half_cosine(half: cython.double) -> cython.double:
    """cos of a half angle up to SERIES_LIMIT, by its series."""
    z: cython.double = half * half
    z2: cython.double = z * z
    head: cython.double = -1.0 / 2.0 + z * (1.0 / 24.0) + z2 * (-1.0 / 720.0 + z * (1.0 / 40320.0))
    tail: cython.double = -1.0 / 3628800.0 + z * (1.0 / 479001600.0) + z2 * (-1.0 / 87178291200.0)
    return 1.0 + z * (head + z2 * z2 * tail)


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def half_slope(theta: cython.double, delta: cython.double) -> cython.double:
    """h(delta) = f_delta / 2."""
    return delta + theta * (1.0 - cos(delta)) + theta * (theta + delta) * sin(delta)


@cython.ccall
@cython.nogil
@cython.exceptval(check=False)
def first_crest(theta: cython.double) -> cython.double:
    """Where f first stops growing with delta, in (pi, 2 pi]; 2 pi if it grows throughout."""
    low: cython.double = PI
    high: cython.double = TWO_PI
    middle: cython.double
    i: cython.int
    for i in range(60):
        middle = 0.5 * (low + high)
        if 3.0 * cos(middle) - (theta + middle) * sin(middle) < 0.0:
            low = middle
        else:
            high = middle
    high = TWO_PI
    for i in range(60):
        middle = 0.5 * (low + high)
        if 1.0 + 2.0 * theta * sin(middle) + theta * (theta + middle) * cos(middle) < 0.0:
            low = middle
        else:
            high = middle
    if half_slope(theta, low) >= 0.0:
        return TWO_PI
    high = low
    low = PI
    for i in range(60):
        middle = 0.5 * (low + high)
        if half_slope(theta, middle) > 0.0:
            low = middle
        else:
            high = middle
    return low


@cython.ccall
@cython.nogil
@cython.exceptval(check=False)
def first_root(theta: cython.double, chord2: cython.double) -> cython.double:
    """First root delta of f = chord2 in (0, 2 pi], by safe bisection; -1.0 when the chain folds."""
    low: cython.double = 0.0
    high: cython.double = PI
    delta: cython.double
    value: cython.double
    i: cython.int
    if PI * PI + 4.0 * theta * (theta + PI) < chord2:
        low = PI
        high = first_crest(theta)
        value = sin(0.5 * high)
        if high * high + 4.0 * theta * (theta + high) * value * value < chord2:
            return -1.0
    for i in range(60):
        delta = 0.5 * (low + high)
        value = sin(0.5 * delta)
        if delta * delta + 4.0 * theta * (theta + delta) * value * value < chord2:
            low = delta
        else:
            high = delta
    return 0.5 * (low + high)


@cython.cfunc
@cython.inline
@cython.nogil
@cython.exceptval(check=False)
def halley_step(
    theta: cython.double, chord2: cython.double, delta: cython.double, s: cython.double, c: cython.double
) -> tuple[cython.double, cython.double, cython.double]:
    """What Halley's iteration takes off delta, f_delta and f_delta_delta; s, c: sin and cos of delta / 2."""
    product: cython.double = 2.0 * theta * (theta + delta)
    value: cython.double = delta * delta + 2.0 * product * s * s - chord2
    slope: cython.double = 2.0 * (delta + 2.0 * theta * s * s + product * s * c)
    curve: cython.double = 2.0 + 8.0 * theta * s * c + product * (1.0 - 2.0 * s * s)
    return 2.0 * value * slope / (2.0 * slope * slope - value * curve), slope, curve


@cython.cfunc
@cython.inline
@cython.nogil
@cython.exceptval(check=False)
def next_handle(
    theta: cython.double, chord2: cython.double, guess: cython.double
) -> tuple[cython.double, cython.double, cython.double]:
    """delta, sin(delta / 2), cos(delta / 2) of the next handle; delta -1.0 when the chain folds.

    Halley's iteration from the guess; whatever leaves (0, pi] goes to the safe root.
    """
    delta: cython.double = guess
    half: cython.double
    s: cython.double
    c: cython.double
    slope: cython.double
    curve: cython.double
    step: cython.double
    i: cython.int
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


@cython.cfunc
@cython.inline
@cython.nogil
@cython.exceptval(check=False)
def theta_ratio(theta: cython.double, delta: cython.double, s: cython.double, c: cython.double) -> cython.double:
    """d theta[k+1] / d theta[k] = (f_delta - f_theta) / f_delta: the rigid link (T[k] . u) / (T[k+1] . u)."""
    sine: cython.double = 2.0 * s * c
    rise: cython.double = 2.0 * s * s
    shared: cython.double = delta + theta * (theta + delta) * sine
    return (shared - (theta + delta) * rise) / (shared + theta * rise)


@cython.cfunc
@cython.inline
@cython.nogil
@cython.exceptval(check=False)
def first_guess(theta: cython.double, chord2: cython.double) -> cython.double:
    """A start for next_handle without history: f = chord^2 with 4 sin^2(delta / 2) = delta^2 (1 - delta^2 / 12)."""
    delta: cython.double = sqrt(chord2 / (1.0 + theta * theta))
    delta = delta if delta < 3.0 else 3.0
    delta = sqrt(chord2 / (1.0 + theta * (theta + delta) * (1.0 - delta * delta / 12.0)))
    return delta if delta < 3.0 else 3.0


# Time lanes. A handle needs the handle before it, an instant needs no other: a block of LANES instants advances handle
# by handle together. The loops over lanes that compute have no branch, and gcc -O3 makes SIMD code of each
# (-fopt-info-vec). A lane that one Halley step leaves open, or that the series do not cover, is done by next_handle,
# whose first step is the same to the last bit: no lane's digits depend on its neighbours or on its place in the block.
# The number of lanes stays a variable, because gcc unrolls a fixed one before it can vectorise it (0.85 ms for
# 0.6 ms below), and so that one instant costs one.
# Measured on 301 x 224 with SSE2, 2026-11-21: 1.23 ms (3.2 ms one instant after the other). Of it 0.58 ms is this loop
# (perf: the Halley step 70 %, positions and velocities 13 %, ratio and rotation 11 %) and 0.5 ms the operating system,
# which gives the tables 2.7 MB of fresh memory. AVX2 would save 0.2 ms; 4 lanes cost 0.07 ms more, 16 gain nothing.
LANES_PER_BLOCK = 8
LANES = cython.declare(cython.Py_ssize_t, LANES_PER_BLOCK)
Lanes = cython.typedef(cython.double[8])  # LANES_PER_BLOCK, which the C compiler wants as a literal


@cython.cfunc
@cython.inline
@cython.nogil
@cython.exceptval(check=False)
def next_handles(
    lanes: cython.Py_ssize_t,
    chord2: cython.double,
    theta: Lanes,
    guess: Lanes,
    delta: Lanes,
    sine: Lanes,
    cosine: Lanes,
) -> cython.Py_ssize_t:
    """next_handle() in every lane; returns how many lanes stand before the first that folds."""
    lane: cython.Py_ssize_t
    half: cython.double
    s: cython.double
    c: cython.double
    step: cython.double
    slope: cython.double
    curve: cython.double
    reached: cython.double
    for lane in range(lanes):
        half = 0.5 * guess[lane]
        s = half_sine(half)
        c = half_cosine(half)
        step, slope, curve = halley_step(theta[lane], chord2, guess[lane], s, c)
        reached = guess[lane] - step
        delta[lane] = (
            reached
            if (half <= SERIES_LIMIT)
            & (slope > 0.0)
            & (reached > 0.0)
            & (reached <= PI)
            & (fabs(step) <= HALLEY_STEP * reached)
            & (fabs(step * curve) <= HALLEY_STEP * slope)
            else -1.0
        )
        step *= -0.5
        sine[lane] = s + step * (c - 0.5 * step * s)
        cosine[lane] = c - step * (s + 0.5 * step * c)
    for lane in range(lanes):
        if delta[lane] < 0.0:
            delta[lane], sine[lane], cosine[lane] = next_handle(theta[lane], chord2, guess[lane])
            if delta[lane] < 0.0:
                return lane
    return lanes


@cython.cfunc
@cython.inline
@cython.nogil
@cython.exceptval(check=False)
def write_handles(
    lanes: cython.Py_ssize_t,
    row: cython.Py_ssize_t,
    k: cython.Py_ssize_t,
    growth: cython.double,
    theta: Lanes,
    x: Lanes,
    y: Lanes,
    rate: Lanes,
    position: cython.double[:, :, ::1],
    velocity: cython.double[:, :, ::1],
    speed: cython.double[:, ::1],
) -> cython.void:
    """Handle k of every lane into the tables, from `row` on; x, y: the unit vector at theta, rate: d theta / d time."""
    lane: cython.Py_ssize_t
    px = cython.declare(Lanes)
    py = cython.declare(Lanes)
    vx = cython.declare(Lanes)
    vy = cython.declare(Lanes)
    pace = cython.declare(Lanes)
    for lane in range(lanes):
        px[lane] = growth * theta[lane] * x[lane]
        py[lane] = growth * theta[lane] * y[lane]
        vx[lane] = rate[lane] * (x[lane] - theta[lane] * y[lane])
        vy[lane] = rate[lane] * (y[lane] + theta[lane] * x[lane])
        pace[lane] = fabs(rate[lane]) * sqrt(1.0 + theta[lane] * theta[lane])
    for lane in range(lanes):
        position[row + lane, k, 0] = px[lane]
        position[row + lane, k, 1] = py[lane]
        velocity[row + lane, k, 0] = vx[lane]
        velocity[row + lane, k, 1] = vy[lane]
        speed[row + lane, k] = pace[lane]


@cython.ccall
@cython.exceptval(check=False)
def spiral_trajectory(
    growth: cython.double,
    thetas: cython.double[::1],
    chords: cython.const[cython.double][::1],
    head_speed: cython.double,
    position: cython.double[:, :, ::1],
    velocity: cython.double[:, :, ::1],
    speed: cython.double[:, ::1],
) -> cython.Py_ssize_t:
    """Position, velocity and speed of every handle for every head angle; returns the first row that folds, or -1.

    thetas: (T,) head angles; chords: (n,) [m]; position, velocity: (T, n + 1, 2); speed: (T, n + 1)
    """
    row: cython.Py_ssize_t = 0
    k: cython.Py_ssize_t
    lane: cython.Py_ssize_t
    lanes: cython.Py_ssize_t
    standing: cython.Py_ssize_t
    alike: cython.Py_ssize_t
    theta = cython.declare(Lanes)
    x = cython.declare(Lanes)
    y = cython.declare(Lanes)
    rate = cython.declare(Lanes)
    guess = cython.declare(Lanes)
    d1 = cython.declare(Lanes)
    d2 = cython.declare(Lanes)
    d3 = cython.declare(Lanes)
    delta = cython.declare(Lanes)
    sine = cython.declare(Lanes)
    cosine = cython.declare(Lanes)
    turn: cython.double
    rise: cython.double
    across: cython.double
    with cython.nogil:
        while row < thetas.shape[0]:
            lanes = thetas.shape[0] - row
            if lanes > LANES:
                lanes = LANES
            standing = lanes
            for lane in range(lanes):
                theta[lane] = thetas[row + lane]
                x[lane] = cos(theta[lane])
                y[lane] = sin(theta[lane])
                rate[lane] = -head_speed / sqrt(1.0 + theta[lane] * theta[lane])
                d1[lane] = d2[lane] = d3[lane] = 0.0
            alike = 0
            for k in range(chords.shape[0]):
                write_handles(standing, row, k, growth, theta, x, y, rate, position, velocity, speed)
                alike = alike + 1 if k > 0 and chords[k] == chords[k - 1] else 0
                if alike > 2:
                    for lane in range(standing):
                        guess[lane] = 3.0 * (d1[lane] - d2[lane]) + d3[lane]
                else:
                    for lane in range(standing):
                        guess[lane] = first_guess(theta[lane], (chords[k] / growth) * (chords[k] / growth))
                standing = next_handles(
                    standing, (chords[k] / growth) * (chords[k] / growth), theta, guess, delta, sine, cosine
                )
                for lane in range(standing):
                    rate[lane] *= theta_ratio(theta[lane], delta[lane], sine[lane], cosine[lane])
                    turn = 2.0 * sine[lane] * cosine[lane]
                    rise = 2.0 * sine[lane] * sine[lane]
                    across = x[lane] - (x[lane] * rise + y[lane] * turn)
                    y[lane] = y[lane] - (y[lane] * rise - x[lane] * turn)
                    x[lane] = across
                    theta[lane] += delta[lane]
                    d3[lane] = d2[lane]
                    d2[lane] = d1[lane]
                    d1[lane] = delta[lane]
            write_handles(standing, row, chords.shape[0], growth, theta, x, y, rate, position, velocity, speed)
            if standing < lanes:
                return row + standing
            row += lanes
    return -1


# -- where a run ends -------------------------------------------------------------------------------
# On f = chord^2, theta is an explicit function of delta:
#     theta(delta) = -delta / 2 + sqrt(delta^2 / 4 + (chord^2 - delta^2) / (2 (1 - cos delta))).
# The chain follows it from large theta (delta small) until theta stops falling, h = 0: the fold. A fold needs
# delta > pi; with chord <= pi the head reaches the centre, where delta = chord.


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def theta_of_delta(delta: cython.double, chord2: cython.double) -> cython.double:
    """theta at which the first root is delta."""
    square: cython.double = 0.25 * delta * delta + (chord2 - delta * delta) / (2.0 * (1.0 - cos(delta)))
    return sqrt(square) - 0.5 * delta if square > 0.0 else 0.0


@cython.ccall
@cython.nogil
@cython.exceptval(check=False)
def fold_theta(chord2: cython.double) -> cython.double:
    """theta of the leading handle at which its bench folds; 0.0 when it never does."""
    if chord2 <= PI * PI:
        return 0.0
    low: cython.double = PI
    end: cython.double = sqrt(chord2)
    if end > TWO_PI:
        end = TWO_PI
    high: cython.double = PI
    delta: cython.double
    i: cython.int
    for i in range(1, FOLD_SAMPLES):
        delta = PI + (end - PI) * i / FOLD_SAMPLES
        if half_slope(theta_of_delta(delta, chord2), delta) <= 0.0:
            high = delta
            break
        low = delta
    if high == PI:
        return 0.0
    for i in range(60):
        delta = 0.5 * (low + high)
        if half_slope(theta_of_delta(delta, chord2), delta) > 0.0:
            low = delta
        else:
            high = delta
    return theta_of_delta(low, chord2)


@cython.ccall
@cython.nogil
@cython.exceptval(check=False)
def previous_theta(theta: cython.double, chord2: cython.double) -> cython.double:
    """theta of the handle one chord further in whose follower stands at theta; -1.0 if none got that far.

    The follower falls with its leader until T . u = 0 and rises after it, so the first arrival is the largest
    leader angle: the border of "a root exists, the follower still falls, and stands outside theta".
    """
    low: cython.double = 0.0
    high: cython.double = theta
    leader: cython.double
    delta: cython.double
    s: cython.double
    i: cython.int
    for i in range(100):
        leader = 0.5 * (low + high)
        delta = first_root(leader, chord2)
        s = sin(0.5 * delta)
        if (
            delta > 0.0
            and leader + delta > theta
            and delta + leader * (leader + delta) * sin(delta) > 2.0 * (leader + delta) * s * s
        ):
            high = leader
        else:
            low = leader
    delta = first_root(high, chord2)
    if high < theta and delta > 0.0 and fabs(high + delta - theta) <= ARRIVAL * (1.0 + theta):
        return high
    return -1.0


# -- rectangles and pairs of poses --
# A rectangle is its centre, the unit vector u along its length, half length hl and half width hw; v is u turned
# left. Corners count 0 front-left, 1 front-right, 2 rear-right, 3 rear-left; edges 4 front, 5 right, 6 rear,
# 7 left.
#
# Everything is measured from one of the two centres, so that rectangles far from the origin lose nothing. In
# the frame of a, with d = b - a, the other centre is (d.ua, d.va) and its u is (c, s), c = ua.ub, s = ua x ub;
# in the frame of b the other centre is (-d.ub, -d.vb) and its u is (c, -s).
#
# Gap along a face normal (separating axis theorem): the other's half extent along u is |c| hl' + |s| hw', along
# v |s| hl' + |c| hw', so beyond the front or rear face the gap is |d.u| - hl - (|c| hl' + |s| hw'), and so on.
# Let g be the largest of the four. Each gap is a lower bound of the distance, and
#   g <= 0: the rectangles meet. The depth is the distance from the origin to the boundary of the Minkowski
#       difference, whose edges are those of a and b, so it is -g; the foot lies on that edge, so an edge of
#       the one and a corner of the other (or a shared stretch of two parallel edges) realise it.
#   g > 0, nearest points a corner and an inner point of an edge: the distance is that edge's gap, and any
#       other gap is at most distance * (m.n) < distance, so it is g.
#   g > 0, else: two corners are nearest. The least of the eight distances from a corner to the other rectangle
#       is the distance in either case; taking all eight keeps a wrong choice between near-equal gaps harmless.
# Error: a few ulp of the larger of the distance and the sizes.

# Edges whose directions differ by less than this sine count as parallel: headings that should be equal differ by
# an ulp or two (4e-16 each), and a witness so placed is off the edge by 1e-15 of its length [1].
PARALLEL_SINE = cython.declare(cython.double, 2e-15)
# Beyond every distance: the squares of two coordinates would overflow [m].
NO_LIMIT = cython.declare(cython.double, 1e154)


@cython.cfunc
@cython.inline
@cython.nogil
@cython.exceptval(check=False)
def side_of(x: cython.double) -> cython.double:
    """1 from zero upwards, -1 below."""
    return 1.0 if x >= 0.0 else -1.0


@cython.cfunc
@cython.inline
@cython.nogil
@cython.exceptval(check=False)
def corner_at(along: cython.double, left: cython.double) -> cython.int:
    """The corner on the given sides of the centre."""
    if along >= 0.0:
        return 0 if left >= 0.0 else 1
    return 3 if left >= 0.0 else 2


@cython.cfunc
@cython.inline
@cython.nogil
@cython.exceptval(check=False)
def face_gap(
    along: cython.double,
    left: cython.double,
    c: cython.double,
    s: cython.double,
    hl: cython.double,
    hw: cython.double,
    other_hl: cython.double,
    other_hw: cython.double,
) -> cython.double:
    """The larger gap along this rectangle's own normals; the other's centre (along, left), u = (c, s) [m]."""
    lengthwise: cython.double = fabs(along) - hl - (fabs(c) * other_hl + fabs(s) * other_hw)
    sideways: cython.double = fabs(left) - hw - (fabs(s) * other_hl + fabs(c) * other_hw)
    return lengthwise if lengthwise >= sideways else sideways


@cython.cfunc
@cython.inline
@cython.nogil
@cython.exceptval(check=False)
def point_gap_squared(x: cython.double, y: cython.double, hl: cython.double, hw: cython.double) -> cython.double:
    """Squared distance of a point in the rectangle's frame to the rectangle, 0 inside [m^2]."""
    beyond_x: cython.double = fabs(x) - hl
    beyond_y: cython.double = fabs(y) - hw
    if beyond_x < 0.0:
        beyond_x = 0.0
    if beyond_y < 0.0:
        beyond_y = 0.0
    return beyond_x * beyond_x + beyond_y * beyond_y


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def corners_gap_squared(
    along: cython.double,
    left: cython.double,
    c: cython.double,
    s: cython.double,
    hl: cython.double,
    hw: cython.double,
    other_hl: cython.double,
    other_hw: cython.double,
) -> cython.double:
    """Least squared distance of the other's four corners to this rectangle, arguments as face_gap() [m^2]."""
    # half diagonals of the other to its front-left and front-right corners
    px: cython.double = c * other_hl - s * other_hw
    py: cython.double = s * other_hl + c * other_hw
    qx: cython.double = c * other_hl + s * other_hw
    qy: cython.double = s * other_hl - c * other_hw
    least: cython.double = point_gap_squared(along + px, left + py, hl, hw)
    gap: cython.double = point_gap_squared(along - px, left - py, hl, hw)
    if gap < least:
        least = gap
    gap = point_gap_squared(along + qx, left + qy, hl, hw)
    if gap < least:
        least = gap
    gap = point_gap_squared(along - qx, left - qy, hl, hw)
    if gap < least:
        least = gap
    return least


@cython.ccall
@cython.nogil
@cython.exceptval(check=False)
def pair_gap(
    ax: cython.double,
    ay: cython.double,
    aux: cython.double,
    auy: cython.double,
    ahl: cython.double,
    ahw: cython.double,
    bx: cython.double,
    by: cython.double,
    bux: cython.double,
    buy: cython.double,
    bhl: cython.double,
    bhw: cython.double,
) -> cython.double:
    """Signed separation of two rectangles [m], as pair_separation() but without witnesses."""
    return pair_gap_within(ax, ay, aux, auy, ahl, ahw, bx, by, bux, buy, bhl, bhw, NO_LIMIT)


@cython.ccall
@cython.nogil
@cython.exceptval(check=False)
def pair_gap_within(
    ax: cython.double,
    ay: cython.double,
    aux: cython.double,
    auy: cython.double,
    ahl: cython.double,
    ahw: cython.double,
    bx: cython.double,
    by: cython.double,
    bux: cython.double,
    buy: cython.double,
    bhl: cython.double,
    bhw: cython.double,
    limit: cython.double,
) -> cython.double:
    """pair_gap() where it is at most limit >= 0, else some value above limit and not above pair_gap() [m].

    Where the two are equal but for rounding, either may come back.
    """
    dx: cython.double = bx - ax
    dy: cython.double = by - ay
    c: cython.double = aux * bux + auy * buy
    s: cython.double = aux * buy - auy * bux
    b_along: cython.double = dx * aux + dy * auy
    b_left: cython.double = dy * aux - dx * auy
    from_a: cython.double = face_gap(b_along, b_left, c, s, ahl, ahw, bhl, bhw)
    if from_a > limit:
        return from_a
    a_along: cython.double = -(dx * bux + dy * buy)
    a_left: cython.double = -(dy * bux - dx * buy)
    from_b: cython.double = face_gap(a_along, a_left, c, -s, bhl, bhw, ahl, ahw)
    if from_b > limit:
        return from_b
    if from_a <= 0.0 and from_b <= 0.0:
        return from_a if from_a >= from_b else from_b
    from_a = corners_gap_squared(b_along, b_left, c, s, ahl, ahw, bhl, bhw)
    from_b = corners_gap_squared(a_along, a_left, c, -s, bhl, bhw, ahl, ahw)
    return sqrt(from_a if from_a <= from_b else from_b)


@cython.ccall
@cython.nogil
@cython.exceptval(check=False)
def pair_separation(
    ax: cython.double,
    ay: cython.double,
    aux: cython.double,
    auy: cython.double,
    ahl: cython.double,
    ahw: cython.double,
    bx: cython.double,
    by: cython.double,
    bux: cython.double,
    buy: cython.double,
    bhl: cython.double,
    bhw: cython.double,
    out: cython.double[::1],
) -> cython.void:
    """Signed separation, witness on a, witness on b, normal from a to b, and the features that realise it.

    out: (8,) separation, ax, ay, bx, by, nx, ny, 8 * feature of a + feature of b (corner 0..3 or edge 4..7)
    """
    dx: cython.double = bx - ax
    dy: cython.double = by - ay
    c: cython.double = aux * bux + auy * buy
    s: cython.double = aux * buy - auy * bux
    b_along: cython.double = dx * aux + dy * auy
    b_left: cython.double = dy * aux - dx * auy
    a_along: cython.double = -(dx * bux + dy * buy)
    a_left: cython.double = -(dy * bux - dx * buy)
    from_a: cython.double = face_gap(b_along, b_left, c, s, ahl, ahw, bhl, bhw)
    from_b: cython.double = face_gap(a_along, a_left, c, -s, bhl, bhw, ahl, ahw)
    if from_a >= from_b:
        if edge_witness(ax, ay, aux, auy, ahl, ahw, b_along, b_left, c, s, bhl, bhw, out):
            return
    elif edge_witness(bx, by, bux, buy, bhl, bhw, a_along, a_left, c, -s, ahl, ahw, out):
        reverse_pair(out)
        return
    from_a = corners_gap_squared(b_along, b_left, c, s, ahl, ahw, bhl, bhw)
    from_b = corners_gap_squared(a_along, a_left, c, -s, bhl, bhw, ahl, ahw)
    if from_a <= from_b:
        corner_witness(ax, ay, aux, auy, ahl, ahw, b_along, b_left, c, s, bhl, bhw, out)
    else:
        corner_witness(bx, by, bux, buy, bhl, bhw, a_along, a_left, c, -s, ahl, ahw, out)
        reverse_pair(out)


# In the two functions below the rectangle at (x, y) plays a, the other plays b; reverse_pair() swaps the roles.
# Turn the frame so that the chosen face's outward normal is e, f to its left: the other's centre is (p, q) with
# p >= 0, its u is (ue, uf), hence its v is (-uf, ue). Its corner deepest against e lies along f at
# t = q - sign(ue) uf hl' + sign(uf) ue hw'; with an edge parallel to the face the whole stretch q +- (hw' or
# hl') is equally deep, and the middle of what it shares with the face is taken.


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def edge_witness(
    x: cython.double,
    y: cython.double,
    ux: cython.double,
    uy: cython.double,
    hl: cython.double,
    hw: cython.double,
    along: cython.double,
    left: cython.double,
    c: cython.double,
    s: cython.double,
    other_hl: cython.double,
    other_hw: cython.double,
    out: cython.double[::1],
) -> cython.bint:
    """Fill out for the face with the largest gap; False when the rectangles are apart and corners are nearest."""
    gap: cython.double = fabs(along) - hl - (fabs(c) * other_hl + fabs(s) * other_hw)
    sideways: cython.double = fabs(left) - hw - (fabs(s) * other_hl + fabs(c) * other_hw)
    side: cython.double = side_of(along)
    ex: cython.double = side * ux
    ey: cython.double = side * uy
    q: cython.double = side * left
    ue: cython.double = side * c
    uf: cython.double = side * s
    h: cython.double = hl
    w: cython.double = hw
    edge: cython.int = 4 if side > 0.0 else 6
    if sideways > gap:
        gap = sideways
        side = side_of(left)
        ex = -side * uy
        ey = side * ux
        q = -side * along
        ue = side * s
        uf = -side * c
        h = hw
        w = hl
        edge = 7 if side > 0.0 else 5
    t: cython.double
    half: cython.double = -1.0
    other_feature: cython.int
    if fabs(uf) <= PARALLEL_SINE:
        half = other_hw
        other_feature = 6 if ue > 0.0 else 4
    elif fabs(ue) <= PARALLEL_SINE:
        half = other_hl
        other_feature = 7 if uf > 0.0 else 5
    else:
        other_feature = corner_at(-ue, uf)
    if half >= 0.0:
        low: cython.double = q - half if q - half > -w else -w
        high: cython.double = q + half if q + half < w else w
        if gap > 0.0 and low > high:
            return False
        t = 0.5 * (low + high)
    else:
        t = q - side_of(ue) * uf * other_hl + side_of(uf) * ue * other_hw
        if fabs(t) > w:
            if gap > 0.0:
                return False
            t = w if t > 0.0 else -w
    out[0] = gap
    out[1] = x + (h * ex - t * ey)
    out[2] = y + (h * ey + t * ex)
    out[3] = x + ((h + gap) * ex - t * ey)
    out[4] = y + ((h + gap) * ey + t * ex)
    out[5] = ex
    out[6] = ey
    out[7] = 8 * edge + other_feature
    return True


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def corner_witness(
    x: cython.double,
    y: cython.double,
    ux: cython.double,
    uy: cython.double,
    hl: cython.double,
    hw: cython.double,
    along: cython.double,
    left: cython.double,
    c: cython.double,
    s: cython.double,
    other_hl: cython.double,
    other_hw: cython.double,
    out: cython.double[::1],
) -> cython.void:
    """Fill out for the corner of the other that is nearest to this rectangle."""
    px: cython.double = 0.0
    py: cython.double = 0.0
    least: cython.double = -1.0
    corner: cython.int = 0
    k: cython.int
    for k in range(4):
        l_side: cython.double = other_hl if k < 2 else -other_hl
        w_side: cython.double = other_hw if k == 0 or k == 3 else -other_hw
        cx: cython.double = along + c * l_side - s * w_side
        cy: cython.double = left + s * l_side + c * w_side
        squared: cython.double = point_gap_squared(cx, cy, hl, hw)
        if least < 0.0 or squared < least:
            least = squared
            px = cx
            py = cy
            corner = k
    side_x: cython.double = side_of(px)
    side_y: cython.double = side_of(py)
    beyond_x: cython.double = fabs(px) - hl
    beyond_y: cython.double = fabs(py) - hw
    gap: cython.double = sqrt(least)
    feature: cython.int = corner_at(px, py)
    nx: cython.double
    ny: cython.double
    if beyond_x > 0.0 and beyond_y > 0.0:
        nx = side_x * beyond_x / gap
        ny = side_y * beyond_y / gap
        px = side_x * hl
        py = side_y * hw
    elif beyond_x >= beyond_y:
        gap = beyond_x
        nx = side_x
        ny = 0.0
        px = side_x * hl
        feature = 4 if side_x > 0.0 else 6
    else:
        gap = beyond_y
        nx = 0.0
        ny = side_y
        py = side_y * hw
        feature = 7 if side_y > 0.0 else 5
    out[0] = gap
    out[1] = x + (px * ux - py * uy)
    out[2] = y + (px * uy + py * ux)
    out[3] = x + ((px + gap * nx) * ux - (py + gap * ny) * uy)
    out[4] = y + ((px + gap * nx) * uy + (py + gap * ny) * ux)
    out[5] = nx * ux - ny * uy
    out[6] = nx * uy + ny * ux
    out[7] = 8 * feature + corner


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def reverse_pair(out: cython.double[::1]) -> cython.void:
    """Swap the roles of a and b in what pair_separation() wrote."""
    wx: cython.double = out[1]
    wy: cython.double = out[2]
    features: cython.int = cython.cast(cython.int, out[7])
    out[1] = out[3]
    out[2] = out[4]
    out[3] = wx
    out[4] = wy
    out[5] = -out[5]
    out[6] = -out[6]
    out[7] = 8 * (features % 8) + features // 8


@cython.ccall
@cython.exceptval(check=False)
def pair_separations(a: cython.double[:, ::1], b: cython.double[:, ::1], out: cython.double[:, ::1]) -> cython.void:
    """pair_separation() row by row. a, b: (n, 6) x, y, ux, uy, half length, half width; out: (n, 8)."""
    i: cython.Py_ssize_t
    with cython.nogil:
        for i in range(a.shape[0]):
            pair_separation(
                a[i, 0], a[i, 1], a[i, 2], a[i, 3], a[i, 4], a[i, 5],
                b[i, 0], b[i, 1], b[i, 2], b[i, 3], b[i, 4], b[i, 5],
                out[i],
            )  # fmt: skip


# Broad phase: the rectangles' upright boxes, ordered so that neighbours in the list lie near each other, hang in
# fours from a complete binary tree: node 1 is the root, node k has the children 2 k and 2 k + 1, node leaves + k
# holds rows 4 k to 4 k + 3. A walk that needs no stack: down to 2 k where the node's box is met, else on to k + 1
# and up while that is a left child (even), for its parent has the same first leaf. Starting row i's walk at its
# own leaf meets every later row once, and every pair whose boxes meet.
BOXES_PER_LEAF = 4
LEAF = cython.declare(cython.Py_ssize_t, BOXES_PER_LEAF)


@cython.cfunc
@cython.inline
@cython.nogil
@cython.exceptval(check=False)
def boxes_meet(
    a: cython.double[:, ::1], i: cython.Py_ssize_t, b: cython.double[:, ::1], j: cython.Py_ssize_t
) -> cython.bint:
    """Whether row i of a and row j of b, both x low, y low, x high, y high, meet or touch."""
    return a[i, 0] <= b[j, 2] and b[j, 0] <= a[i, 2] and a[i, 1] <= b[j, 3] and b[j, 1] <= a[i, 3]


@cython.ccall
@cython.exceptval(check=False)
def grow_tree(boxes: cython.double[:, ::1], tree: cython.double[:, ::1]) -> cython.void:
    """Fill the tree over the boxes. boxes: (n, 4); tree: (2 leaves, 4), leaves a power of two >= n / 4."""
    leaves: cython.Py_ssize_t = tree.shape[0] // 2
    k: cython.Py_ssize_t
    i: cython.Py_ssize_t
    with cython.nogil:
        for k in range(tree.shape[0]):
            tree[k, 0] = tree[k, 1] = NO_LIMIT
            tree[k, 2] = tree[k, 3] = -NO_LIMIT
        for i in range(boxes.shape[0]):
            widen(tree, leaves + i // LEAF, boxes, i)
        for k in range(tree.shape[0] - 1, 1, -1):
            widen(tree, k // 2, tree, k)


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def widen(
    tree: cython.double[:, ::1], k: cython.Py_ssize_t, boxes: cython.double[:, ::1], i: cython.Py_ssize_t
) -> cython.void:
    """Widen node k so that it holds box i."""
    axis: cython.int
    for axis in range(2):
        if boxes[i, axis] < tree[k, axis]:
            tree[k, axis] = boxes[i, axis]
        if boxes[i, axis + 2] > tree[k, axis + 2]:
            tree[k, axis + 2] = boxes[i, axis + 2]


@cython.ccall
@cython.exceptval(check=False)
def meeting_pairs(
    frames: cython.double[:, ::1],
    boxes: cython.double[:, ::1],
    tree: cython.double[:, ::1],
    order: cython.longlong[::1],
    margin: cython.double,
    exact: cython.bint,
    chained: cython.bint,
    limits: cython.longlong[::1],
    pairs: cython.longlong[:, ::1],
    counts: cython.longlong[::1],
) -> cython.void:
    """Pairs whose boxes meet; with exact, only those whose separation is at most the margin.

    frames (n, 6), boxes (n, 4), order (n,): rows in the tree's order, and each row's own number
    chained: leave out pairs of consecutive numbers
    limits: (2,) the search stops once it has found more pairs, or met more boxes, than these
    pairs: (capacity, 2), a < b, filled as far as it goes; counts: (2,) pairs found and boxes met
    """
    leaves: cython.Py_ssize_t = tree.shape[0] // 2
    capacity: cython.Py_ssize_t = pairs.shape[0]
    found: cython.longlong = 0
    met: cython.longlong = 0
    a: cython.longlong
    b: cython.longlong
    i: cython.Py_ssize_t
    j: cython.Py_ssize_t
    k: cython.Py_ssize_t
    last: cython.Py_ssize_t
    with cython.nogil:
        for i in range(boxes.shape[0]):
            if found > limits[0] or met > limits[1]:
                break
            k = leaves + i // LEAF
            while True:
                if boxes_meet(tree, k, boxes, i):
                    if k < leaves:
                        k = 2 * k
                        continue
                    j = (k - leaves) * LEAF
                    last = j + LEAF if j + LEAF < boxes.shape[0] else boxes.shape[0]
                    if j <= i:
                        j = i + 1
                    while j < last:
                        if boxes_meet(boxes, i, boxes, j):
                            met += 1
                            a = order[i] if order[i] < order[j] else order[j]
                            b = order[j] if order[i] < order[j] else order[i]
                            if not (chained and b - a == 1) and (not exact or rows_gap(frames, i, j, margin) <= margin):
                                if found < capacity:
                                    pairs[found, 0] = a
                                    pairs[found, 1] = b
                                found += 1
                        j += 1
                k += 1
                while k % 2 == 0:
                    k = k // 2
                if k == 1:
                    break
    counts[0] = found
    counts[1] = met


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def rows_gap(
    frames: cython.double[:, ::1], i: cython.Py_ssize_t, j: cython.Py_ssize_t, limit: cython.double
) -> cython.double:
    """pair_gap_within() of two rows of frames."""
    return pair_gap_within(
        frames[i, 0], frames[i, 1], frames[i, 2], frames[i, 3], frames[i, 4], frames[i, 5],
        frames[j, 0], frames[j, 1], frames[j, 2], frames[j, 3], frames[j, 4], frames[j, 5],
        limit,
    )  # fmt: skip


# -- certified motion -------------------------------------------------------------------------------
# The head's travel sigma [m] is the variable; ' is d / d sigma. On [L, R] of width h every quantity below is an
# upper (or _low lower) bound over the whole interval, from the curvature range [k_low, k_high] of the stretch
# that the two handles of a link (a leads, b follows, chord c, unit vector u from b to a) sweep.
#
# Chord lemma. Let the arc from b to a have curvature in [k_low, k_high], 0 <= k_low, and k_high c < 2. A chord of
# an arc of length l, curvature at most k and k l <= pi is at least (2 / k) sin(k l / 2) (Schur), and the first
# root is met before k l = pi; so l lies between those of circles of curvature k_low and k_high. The direction of
# the chord is the average of the tangents, so the angles alpha between tangents and chord lie in
# [k_low l / 2, k_high l / 2]: k_low c / 2 <= sin alpha <= k_high c / 2 at both ends.
#   rigid link        b' cos alpha_b = a' cos alpha_a                      (b', a' the rates ds / d sigma)
#   turning of u      omega = (a' sin alpha_a + b' sin alpha_b) / c        in [k_low b'_low, k_high a'_high]
#   angles            alpha_a' = k_a a' - omega, alpha_b' = omega - k_b b' so |alpha'| <= k_high a' - k_low b'_low
#   link, again       b'' cos alpha_b = a'' cos alpha_a - a' alpha_a' sin alpha_a + b' alpha_b' sin alpha_b
#   turning, again    omega' c = a'' sin alpha_a + a' alpha_a' cos alpha_a + b'' sin alpha_b + b' alpha_b' cos alpha_b
#   link, once more   b''' cos alpha_b = a''' cos alpha_a - 2 a'' alpha_a' sin alpha_a + 2 b'' alpha_b' sin alpha_b
#                       - a' (alpha_a'^2 cos alpha_a + alpha_a'' sin alpha_a) + b' (the same of b),
#                     alpha_a'' = k_a' a'^2 + k_a a'' - omega', alpha_b'' = omega' - k_b' b'^2 - k_b b'', k' = dk / ds
# On an inward spiral curvature grows in the direction of travel, so alpha_a >= alpha_b (Vogt) and |b'| <= |a'|.
#
# Where k_high c >= 2 (near the centre) the angles are followed from the nearer end of the interval instead: with a
# trial bound on b', |alpha'| <= k_high max(a', b') + omega bounds the cosines half an interval away, these bound b',
# and the trial is proven when that is below it (b' is continuous and below the trial at both ends).
#
# A handle accelerates by |P''| <= |s''| + k s'^2. A point X of a bench with centre M at distance rho:
#   |X'| <= |M'| + omega rho,  |X''| <= |M''| + (omega^2 + omega') rho.
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

# Columns of a chain row, one for each handle. On a spiral the frame is one in which the head stands at polar angle 0.
COS = cython.declare(cython.int, 0)  # of the polar angle; on a route
SIN = cython.declare(cython.int, 1)
PX = cython.declare(cython.int, 0)  # the position instead [m]
PY = cython.declare(cython.int, 1)
TX = cython.declare(cython.int, 2)  # unit tangent in the direction of travel
TY = cython.declare(cython.int, 3)
THETA = cython.declare(cython.int, 4)  # on a route
PLACE = cython.declare(cython.int, 4)  # minus the arc length s instead [m]: both fall in the direction of travel
RATE = cython.declare(cython.int, 5)  # d s / d sigma
# and, for the bench behind that handle, its centre and direction
MX = cython.declare(cython.int, 6)
MY = cython.declare(cython.int, 7)
UX = cython.declare(cython.int, 8)
UY = cython.declare(cython.int, 9)
# and on a route the handle's curvature [1/m], piece, and theta if that is a spiral
CURVATURE = cython.declare(cython.int, 10)
PIECE = cython.declare(cython.int, 11)
PIECE_THETA = cython.declare(cython.int, 12)
CLIMB = cython.declare(cython.int, 13)  # d rate / d sigma [1/m], where climbs() filled it in
CHAIN_COLUMNS = 14

# Columns of a motion row, one for each bench: bounds over an interval.
CENTRE_SPEED = cython.declare(cython.int, 0)
CORNER_SPEED = cython.declare(cython.int, 1)
CENTRE_PULL = cython.declare(cython.int, 2)
CORNER_PULL = cython.declare(cython.int, 3)
TURN = cython.declare(cython.int, 4)
TURN_PULL = cython.declare(cython.int, 5)  # omega^2 + omega'
HANDLE_SPEED = cython.declare(cython.int, 6)  # of the faster of its two handles
TURN_LOW = cython.declare(cython.int, 7)
TURN_RATE = cython.declare(cython.int, 8)  # |omega'|
# and of the handle in front of it
RATE_HIGH = cython.declare(cython.int, 9)
RATE_LOW = cython.declare(cython.int, 10)
RATE_RATE = cython.declare(cython.int, 11)  # |s''|
THETA_HIGH = cython.declare(cython.int, 12)
THETA_LOW = cython.declare(cython.int, 13)
RATE_JERK = cython.declare(cython.int, 14)  # |s'''| on a route, where no handle up to it crosses into another part
MOTION_COLUMNS = 15

# Columns of a size row, one for each bench.
CHORD = cython.declare(cython.int, 0)
HALF_LENGTH = cython.declare(cython.int, 1)
HALF_WIDTH = cython.declare(cython.int, 2)
RADIUS = cython.declare(cython.int, 3)
SIZE_COLUMNS = 4

# The chord lemma is used up to this k_high c / 2; beyond it the angles are followed [1].
LEMMA_LIMIT = cython.declare(cython.double, 0.97)
BEND_LIMIT = 0.97
# Trial bound on a followed handle's rate, as a multiple of what the ends show [1]; any value > 1 is sound.
TRIAL = cython.declare(cython.double, 1.5)
# On a route the cosines of a link's angles are followed from the ends of the interval where the lemma leaves its rates
# a ratio of more than this [1]: what it leaves multiplies from link to link.
RATIO_FOLLOWED = cython.declare(cython.double, 1.001)
# Larger than any step or distance, and so is its square no overflow [m].
FREE = cython.declare(cython.double, 1e150)


@cython.ccall
@cython.nogil
@cython.exceptval(check=False)
def spiral_curvature(theta: cython.double) -> cython.double:
    """Curvature of the spiral times its growth, falling with theta."""
    square: cython.double = 1.0 + theta * theta
    return (1.0 + square) / (square * sqrt(square))


@cython.ccall
@cython.nogil
@cython.exceptval(check=False)
def steepest_bend(theta: cython.double) -> cython.double:
    """No |d curvature / d s| of the spiral from theta outwards exceeds this over the square of its growth.

    It is theta (4 + theta^2) / (1 + theta^2)^3, which is at most 1.09022, near 0.476, and falls from there.
    """
    square: cython.double = 1.0 + theta * theta
    return 1.0903 if theta < 0.5 else theta * (3.0 + square) / (square * square * square)


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def start_chain(theta: cython.double, chain: cython.double[:, ::1]) -> cython.void:
    """Row 0: the head at polar angle 0."""
    length: cython.double = sqrt(1.0 + theta * theta)
    chain[0, COS] = 1.0
    chain[0, SIN] = 0.0
    chain[0, TX] = -1.0 / length
    chain[0, TY] = -theta / length
    chain[0, THETA] = theta
    chain[0, RATE] = 1.0


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def extend_chain(
    growth: cython.double,
    first: cython.Py_ssize_t,
    last: cython.Py_ssize_t,
    radius: cython.double,
    sizes: cython.double[:, ::1],
    chain: cython.double[:, ::1],
) -> cython.Py_ssize_t:
    """Handles after `first` until one stands at `radius` [m] or is the `last`; returns its index, -1 at a fold."""
    k: cython.Py_ssize_t
    theta: cython.double
    delta: cython.double = 0.0
    s: cython.double
    c: cython.double
    x: cython.double
    y: cython.double
    turn: cython.double
    rise: cython.double
    length: cython.double
    chord: cython.double
    reach: cython.double
    k = first
    while k < last and growth * chain[k, THETA] < radius:
        theta = chain[k, THETA]
        chord = sizes[k, CHORD]
        reach = (chord / growth) * (chord / growth)
        if k > 2 and sizes[k - 1, CHORD] == chord and sizes[k - 2, CHORD] == chord and sizes[k - 3, CHORD] == chord:
            delta = 3.0 * (theta - chain[k - 1, THETA] - chain[k - 1, THETA] + chain[k - 2, THETA])
            delta += chain[k - 2, THETA] - chain[k - 3, THETA]
        else:
            delta = first_guess(theta, reach)
        delta, s, c = next_handle(theta, reach, delta)
        if delta < 0.0:
            return -1
        turn = 2.0 * s * c
        rise = 2.0 * s * s
        x = chain[k, COS]
        y = chain[k, SIN]
        chain[k + 1, COS] = x - (x * rise + y * turn)
        chain[k + 1, SIN] = y - (y * rise - x * turn)
        chain[k + 1, THETA] = theta + delta
        x = growth * theta * x
        y = growth * theta * y
        theta += delta
        length = sqrt(1.0 + theta * theta)
        c = chain[k + 1, COS]
        s = chain[k + 1, SIN]
        chain[k + 1, TX] = (theta * s - c) / length
        chain[k + 1, TY] = -(theta * c + s) / length
        c = growth * theta * c
        s = growth * theta * s
        chain[k, MX] = 0.5 * (x + c)
        chain[k, MY] = 0.5 * (y + s)
        chain[k, UX] = (x - c) / chord
        chain[k, UY] = (y - s) / chord
        chain[k + 1, RATE] = (
            chain[k, RATE]
            * (chain[k, TX] * chain[k, UX] + chain[k, TY] * chain[k, UY])
            / (chain[k + 1, TX] * chain[k, UX] + chain[k + 1, TY] * chain[k, UY])
        )
        k += 1
    return k


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def motion_bounds(
    growth: cython.double,
    h: cython.double,
    benches: cython.Py_ssize_t,
    sizes: cython.double[:, ::1],
    before: cython.double[:, ::1],
    after: cython.double[:, ::1],
    motion: cython.double[:, ::1],
) -> cython.bint:
    """Bounds on the motion of the first benches over an interval of width h; False when h is too wide for any."""
    k: cython.Py_ssize_t
    followed: cython.bint = False
    chord: cython.double
    inner: cython.double
    outer: cython.double
    k_high: cython.double
    k_low: cython.double
    sin_high: cython.double
    cos_high: cython.double
    cos_low: cython.double
    omega: cython.double
    swing_a: cython.double
    swing_b: cython.double
    pull: cython.double
    spin: cython.double
    rate_a: cython.double = 1.0
    rate_low: cython.double = 1.0
    rate_b: cython.double
    second_a: cython.double = 0.0
    second_b: cython.double
    motion[0, RATE_HIGH] = motion[0, RATE_LOW] = 1.0
    motion[0, RATE_RATE] = 0.0
    for k in range(benches):
        chord = sizes[k, CHORD]
        motion[k, THETA_LOW] = after[k, THETA]
        motion[k, THETA_HIGH] = before[k, THETA]
        inner = after[k, THETA] if after[k, THETA] < before[k, THETA] else before[k, THETA]
        outer = before[k + 1, THETA] if after[k + 1, THETA] < before[k + 1, THETA] else after[k + 1, THETA]
        if followed:  # the handle may turn back between the ends: it goes no further in than its rate allows
            swing_a = 2.0 * rate_a * h / (growth * inner) if inner > 0.0 else FREE
            inner = inner - swing_a if swing_a <= 0.5 * inner else inner - rate_a * h / growth
            if inner < 0.0:
                inner = 0.0
        k_high = spiral_curvature(inner) / growth
        sin_high = 0.5 * k_high * chord
        if sin_high <= LEMMA_LIMIT:
            k_low = 0.0 if followed else spiral_curvature(outer) / growth
            cos_low = sqrt(1.0 - sin_high * sin_high)
            cos_high = sqrt(1.0 - 0.25 * k_low * k_low * chord * chord)
            rate_low *= cos_low / cos_high
            rate_b = rate_a
            swing_a = swing_b = k_high * rate_a - k_low * rate_low
            omega = k_high * rate_a
        else:
            followed = True
            rate_low = 0.0
            swing_a = before[k, TX] * before[k, UX] + before[k, TY] * before[k, UY]
            swing_b = after[k, TX] * after[k, UX] + after[k, TY] * after[k, UY]
            cos_high = fabs(swing_a) if fabs(swing_a) > fabs(swing_b) else fabs(swing_b)
            swing_a = before[k + 1, TX] * before[k, UX] + before[k + 1, TY] * before[k, UY]
            swing_b = after[k + 1, TX] * after[k, UX] + after[k + 1, TY] * after[k, UY]
            cos_low = swing_a if swing_a < swing_b else swing_b
            if cos_low <= 0.0:
                return False
            rate_b = rate_a * (TRIAL * cos_high + h * rate_a * (k_high + 2.0 / chord)) / cos_low
            omega = (rate_a + rate_b) / chord
            swing_a = k_high * rate_a + omega
            swing_b = k_high * rate_b + omega
            cos_high += 0.5 * h * swing_a
            if cos_high > 1.0:
                cos_high = 1.0
            cos_low -= 0.5 * h * swing_b
            if cos_low <= 0.0 or rate_a * cos_high > rate_b * cos_low:
                return False
            sin_high = 1.0
        second_b = (cos_high * second_a + sin_high * (rate_a * swing_a + rate_b * swing_b)) / cos_low
        spin = (
            omega * omega
            + (cos_high * (rate_a * swing_a + rate_b * swing_b) + sin_high * (second_a + second_b)) / chord
        )
        if sin_high == 1.0:
            spin = omega * omega + (rate_a * swing_a + rate_b * swing_b + second_a + second_b) / chord
        pull = 0.5 * (second_a + second_b + k_high * (rate_a * rate_a + rate_b * rate_b))
        motion[k, CENTRE_SPEED] = 0.5 * (rate_a + rate_b)
        motion[k, CORNER_SPEED] = 0.5 * (rate_a + rate_b) + omega * sizes[k, RADIUS]
        motion[k, CENTRE_PULL] = pull
        motion[k, CORNER_PULL] = pull + spin * sizes[k, RADIUS]
        motion[k, TURN] = omega
        motion[k, TURN_PULL] = spin
        motion[k, HANDLE_SPEED] = rate_a if rate_a > rate_b else rate_b
        motion[k, TURN_LOW] = 0.0 if followed else k_low * rate_low
        motion[k, TURN_RATE] = spin - omega * omega
        motion[k + 1, RATE_HIGH] = rate_b
        motion[k + 1, RATE_LOW] = rate_low
        motion[k + 1, RATE_RATE] = second_b
        motion[k + 1, THETA_LOW] = after[k + 1, THETA]
        motion[k + 1, THETA_HIGH] = before[k + 1, THETA]
        rate_a = rate_b
        second_a = second_b
    return True


@cython.cfunc
@cython.inline
@cython.nogil
@cython.exceptval(check=False)
def gap_along(
    i: cython.Py_ssize_t,
    j: cython.Py_ssize_t,
    along: cython.double,
    left: cython.double,
    sizes: cython.double[:, ::1],
    chain: cython.double[:, ::1],
) -> cython.double:
    """Gap between benches i and j along the unit vector (along, left) of bench i's frame, pointing to j [m]."""
    ex: cython.double = along * chain[i, UX] - left * chain[i, UY]
    ey: cython.double = along * chain[i, UY] + left * chain[i, UX]
    return (
        ex * (chain[j, MX] - chain[i, MX])
        + ey * (chain[j, MY] - chain[i, MY])
        - fabs(along) * sizes[i, HALF_LENGTH]
        - fabs(left) * sizes[i, HALF_WIDTH]
        - fabs(ex * chain[j, UX] + ey * chain[j, UY]) * sizes[j, HALF_LENGTH]
        - fabs(ey * chain[j, UX] - ex * chain[j, UY]) * sizes[j, HALF_WIDTH]
    )


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def best_axis(
    i: cython.Py_ssize_t,
    j: cython.Py_ssize_t,
    sizes: cython.double[:, ::1],
    chain: cython.double[:, ::1],
) -> tuple[cython.double, cython.double, cython.double]:
    """The face normal of bench i with the largest gap to bench j, in i's frame: gap [m], along, left."""
    dx: cython.double = chain[j, MX] - chain[i, MX]
    dy: cython.double = chain[j, MY] - chain[i, MY]
    along: cython.double = 1.0 if dx * chain[i, UX] + dy * chain[i, UY] > 0.0 else -1.0
    left: cython.double = 1.0 if dy * chain[i, UX] - dx * chain[i, UY] > 0.0 else -1.0
    lengthwise: cython.double = gap_along(i, j, along, 0.0, sizes, chain)
    sideways: cython.double = gap_along(i, j, 0.0, left, sizes, chain)
    if sideways >= lengthwise:
        return sideways, 0.0, left
    return lengthwise, along, 0.0


@cython.cfunc
@cython.inline
@cython.nogil
@cython.exceptval(check=False)
def least_between(start: cython.double, end: cython.double, bend: cython.double, h: cython.double) -> cython.double:
    """Least value on an interval of width h of a function with the given end values and |second derivative| <= bend."""
    rise: cython.double = end - start
    sag: cython.double = bend * h * h
    if 2.0 * fabs(rise) >= sag:
        return start if start < end else end
    return 0.5 * (start + end) - 0.125 * sag - 0.5 * rise * rise / sag


@cython.cfunc
@cython.inline
@cython.nogil
@cython.exceptval(check=False)
def apart(a_low: cython.double, a_high: cython.double, b_low: cython.double, b_high: cython.double) -> cython.double:
    """The largest difference between a number in [a_low, a_high] and one in [b_low, b_high]."""
    return a_high - b_low if a_high - b_low > b_high - a_low else b_high - a_low


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def against_rotation(
    growth: cython.double,
    k: cython.Py_ssize_t,
    turn_low: cython.double,
    turn_high: cython.double,
    motion: cython.double[:, ::1],
) -> tuple[cython.double, cython.double]:
    """Bounds on |xi| and |P'' + Omega^2 P| of handle k against a rotation Omega in [turn_low, turn_high]."""
    high: cython.double = motion[k, RATE_HIGH]
    low: cython.double = motion[k, RATE_LOW]
    r_low: cython.double = growth * motion[k, THETA_LOW]
    r_high: cython.double = growth * motion[k, THETA_HIGH]
    slip: cython.double = apart(low, high, turn_low * r_low, turn_high * r_high) + turn_high * growth
    pull: cython.double = apart(
        low * low * spiral_curvature(motion[k, THETA_HIGH]) / growth,
        high * high * spiral_curvature(motion[k, THETA_LOW]) / growth,
        turn_low * turn_low * r_low,
        turn_high * turn_high * r_high,
    )
    return slip, pull + motion[k, RATE_RATE] + turn_high * turn_high * growth


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def axis_bend(
    growth: cython.double,
    i: cython.Py_ssize_t,
    j: cython.Py_ssize_t,
    distance: cython.double,
    sizes: cython.double[:, ::1],
    motion: cython.double[:, ::1],
) -> cython.double:
    """Bound K on the second derivative of a gap along an axis fixed in bench i to the corners of bench j [1/m]."""
    low: cython.double = motion[i, TURN_LOW]
    high: cython.double = motion[i, TURN]
    plain: cython.double = plain_bend(i, j, distance, sizes, motion)
    slip: cython.double
    pull: cython.double
    slips: cython.double = 0.0
    pulls: cython.double = 0.0
    side: cython.int
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


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def plain_bend(
    i: cython.Py_ssize_t,
    j: cython.Py_ssize_t,
    distance: cython.double,
    sizes: cython.double[:, ::1],
    motion: cython.double[:, ::1],
) -> cython.double:
    """axis_bend() in the resting frame [1/m]."""
    return (
        motion[j, CORNER_PULL]
        + motion[i, CENTRE_PULL]
        + 2.0 * motion[i, TURN] * (motion[j, CORNER_SPEED] + motion[i, CENTRE_SPEED])
        + motion[i, TURN_PULL] * (distance + sizes[j, RADIUS])
    )


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def axis_least(
    i: cython.Py_ssize_t,
    j: cython.Py_ssize_t,
    after_decides: cython.bint,
    bend: cython.double,
    h: cython.double,
    sizes: cython.double[:, ::1],
    before: cython.double[:, ::1],
    after: cython.double[:, ::1],
) -> cython.double:
    """Proven least gap over the interval along the face normal of i that is best at one of its ends [m]."""
    gap: cython.double
    along: cython.double
    left: cython.double
    if after_decides:
        gap, along, left = best_axis(i, j, sizes, after)
        return least_between(gap_along(i, j, along, left, sizes, before), gap, bend, h)
    gap, along, left = best_axis(i, j, sizes, before)
    return least_between(gap, gap_along(i, j, along, left, sizes, after), bend, h)


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def pair_least(
    growth: cython.double,
    i: cython.Py_ssize_t,
    j: cython.Py_ssize_t,
    margin: cython.double,
    h: cython.double,
    sizes: cython.double[:, ::1],
    before: cython.double[:, ::1],
    after: cython.double[:, ::1],
    motion: cython.double[:, ::1],
    out: cython.double[::1],
) -> cython.double:
    """A proven lower bound of the separation of benches i and j over the interval [m]; FREE when they are far.

    Tries axes until one exceeds the margin; out[0] is the bound K of the last one.
    """
    dx: cython.double = before[j, MX] - before[i, MX]
    dy: cython.double = before[j, MY] - before[i, MY]
    drift: cython.double = (motion[i, CENTRE_SPEED] + motion[j, CENTRE_SPEED]) * h
    square: cython.double = dx * dx + dy * dy
    far: cython.double = sizes[i, RADIUS] + sizes[j, RADIUS] + margin + drift
    least: cython.double
    best: cython.double
    distance: cython.double
    turn_x: cython.double
    turn_y: cython.double
    if square > far * far:
        return FREE
    distance = sqrt(square) + drift
    out[0] = axis_bend(growth, j, i, distance, sizes, motion)
    best = axis_least(j, i, True, out[0], h, sizes, before, after)
    if best > margin:
        return best
    least = axis_least(j, i, False, out[0], h, sizes, before, after)
    if least > best:
        best = least
    if best > margin:
        return best
    out[0] = axis_bend(growth, i, j, distance, sizes, motion)
    least = axis_least(i, j, True, out[0], h, sizes, before, after)
    if least > best:
        best = least
    if best > margin:
        return best
    least = axis_least(i, j, False, out[0], h, sizes, before, after)
    if least > best:
        best = least
    if best > margin or margin <= 0.0:
        return best
    # two corners nearest each other: the direction between them, fixed in bench i
    pair_separation(
        after[i, MX],
        after[i, MY],
        after[i, UX],
        after[i, UY],
        sizes[i, HALF_LENGTH],
        sizes[i, HALF_WIDTH],
        after[j, MX],
        after[j, MY],
        after[j, UX],
        after[j, UY],
        sizes[j, HALF_LENGTH],
        sizes[j, HALF_WIDTH],
        out[1:],
    )
    turn_x = out[6] * after[i, UX] + out[7] * after[i, UY]
    turn_y = out[7] * after[i, UX] - out[6] * after[i, UY]
    least = least_between(
        gap_along(i, j, turn_x, turn_y, sizes, before), gap_along(i, j, turn_x, turn_y, sizes, after), out[0], h
    )
    return least if least > best else best


# -- routes -----------------------------------------------------------------------------------------
# A route is a table of pieces joined by arc length s. One row a piece, curvature counter-clockwise positive:
#   KIND, S_START, S_END, curvature at both ends, then
#   line   x, y, dx, dy                     at S_START, unit direction
#   arc    centre x, y, radius, angle, sign  angle at S_START, sign + counter-clockwise
#   spiral centre x, y, growth, rotation, sign, arc   sign + outwards, arc length from its centre at S_START
#   cubic  x0..x3, y0..y3, end              r(t) = sum of c_k t^k for t in [0, end], its curvature monotonic
#   crest  the same for a cubic with a crest of curvature in it: in place of both ends lower and upper bounds
# The first piece also serves before S_START and the last one after S_END.
#
# Next handle. Let |curvature| <= k with k chord < 2 (routes are refused otherwise). As long as k l <= pi the
# distance to the
# point l behind grows with l: its rate is the cosine of an angle <= k l / 2 (chord lemma, below). It reaches the chord
# before l = pi chord / 2 <= pi / k, so in [chord, pi chord / 2] there is one root, it is the first along the path, and
# whatever comes near further back along the path is never taken for it.

PIECE_KIND = cython.declare(cython.int, 0)
S_START = cython.declare(cython.int, 1)
S_END = cython.declare(cython.int, 2)
K_START = cython.declare(cython.int, 3)
K_END = cython.declare(cython.int, 4)
K_SLOPE = cython.declare(cython.int, 14)  # bound on |d curvature / d s| [1/m^2]
PART = cython.declare(cython.int, 15)  # within a part of the route curvature has no jump
PIECE_COLUMNS = 16
LINE = cython.declare(cython.int, 0)
ARC = cython.declare(cython.int, 1)
SPIRAL = cython.declare(cython.int, 2)
CREST = cython.declare(cython.int, 4)
PIECE_KINDS = ("line", "arc", "spiral", "cubic", "crest")


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def cubic_speed(pieces: cython.const[cython.double][:, ::1], p: cython.Py_ssize_t, t: cython.double) -> cython.double:
    """|r'(t)| of a cubic."""
    x: cython.double = pieces[p, 6] + t * (2.0 * pieces[p, 7] + 3.0 * t * pieces[p, 8])
    y: cython.double = pieces[p, 10] + t * (2.0 * pieces[p, 11] + 3.0 * t * pieces[p, 12])
    return sqrt(x * x + y * y)


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def cubic_arc(pieces: cython.const[cython.double][:, ::1], p: cython.Py_ssize_t, t: cython.double) -> cython.double:
    """Arc length of a cubic from 0 to t, by Gauss-Legendre quadrature with eight points [m]."""
    return t * (
        0.1813418916891810
        * (cubic_speed(pieces, p, 0.4082826787521751 * t) + cubic_speed(pieces, p, 0.5917173212478249 * t))
        + 0.1568533229389436
        * (cubic_speed(pieces, p, 0.2372337950418355 * t) + cubic_speed(pieces, p, 0.7627662049581645 * t))
        + 0.1111905172266872
        * (cubic_speed(pieces, p, 0.1016667612931866 * t) + cubic_speed(pieces, p, 0.8983332387068134 * t))
        + 0.0506142681451881
        * (cubic_speed(pieces, p, 0.0198550717512319 * t) + cubic_speed(pieces, p, 0.9801449282487681 * t))
    )


@cython.ccall
@cython.nogil
@cython.exceptval(check=False)
def cubic_arcs(pieces: cython.const[cython.double][:, ::1], out: cython.double[::1]) -> cython.void:
    """Arc length of every row's cubic from 0 to its end [m]. out: (rows,)"""
    p: cython.Py_ssize_t
    for p in range(pieces.shape[0]):
        out[p] = cubic_arc(pieces, p, pieces[p, 13])


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def piece_of(
    pieces: cython.const[cython.double][:, ::1], s: cython.double, near: cython.Py_ssize_t
) -> cython.Py_ssize_t:
    """The piece that holds s, a joint the piece behind it: by steps that double from a near one, then halve."""
    low: cython.Py_ssize_t = near
    high: cython.Py_ssize_t = near
    middle: cython.Py_ssize_t
    step: cython.Py_ssize_t = 1
    while low > 0 and s <= pieces[low, S_START]:
        high = low - 1
        low = low - step if low > step else 0
        step *= 2
    while high < pieces.shape[0] - 1 and s > pieces[high, S_END]:
        low = high + 1
        high = high + step if high + step < pieces.shape[0] else pieces.shape[0] - 1
        step *= 2
    while low < high:
        middle = (low + high) // 2
        if s > pieces[middle, S_END]:
            low = middle + 1
        else:
            high = middle
    return low


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def route_point(
    pieces: cython.const[cython.double][:, ::1], p: cython.Py_ssize_t, s: cython.double
) -> tuple[cython.double, cython.double, cython.double, cython.double, cython.double]:
    """x, y [m], unit tangent, curvature [1/m] at arc length s on piece p."""
    kind: cython.int = cython.cast(cython.int, pieces[p, PIECE_KIND])
    u: cython.double = s - pieces[p, S_START]
    a: cython.double
    c: cython.double
    d: cython.double
    length: cython.double
    i: cython.int
    if kind == LINE:
        return (
            pieces[p, 5] + u * pieces[p, 7],
            pieces[p, 6] + u * pieces[p, 8],
            pieces[p, 7],
            pieces[p, 8],
            0.0,
        )
    if kind == ARC:
        a = pieces[p, 8] + pieces[p, 9] * u / pieces[p, 7]
        c = cos(a)
        d = sin(a)
        return (
            pieces[p, 5] + pieces[p, 7] * c,
            pieces[p, 6] + pieces[p, 7] * d,
            -pieces[p, 9] * d,
            pieces[p, 9] * c,
            pieces[p, 9] / pieces[p, 7],
        )
    if kind == SPIRAL:
        return spiral_point(pieces, p, spiral_theta((pieces[p, 10] + pieces[p, 9] * u) / pieces[p, 7]))
    a = u / (pieces[p, S_END] - pieces[p, S_START]) * pieces[p, 13]
    for i in range(30):
        d = (cubic_arc(pieces, p, a) - u) / cubic_speed(pieces, p, a)
        a -= d
        if fabs(d) <= 1e-15 * pieces[p, 13]:
            break
    c = pieces[p, 6] + a * (2.0 * pieces[p, 7] + 3.0 * a * pieces[p, 8])
    d = pieces[p, 10] + a * (2.0 * pieces[p, 11] + 3.0 * a * pieces[p, 12])
    length = sqrt(c * c + d * d)
    return (
        pieces[p, 5] + a * (pieces[p, 6] + a * (pieces[p, 7] + a * pieces[p, 8])),
        pieces[p, 9] + a * (pieces[p, 10] + a * (pieces[p, 11] + a * pieces[p, 12])),
        c / length,
        d / length,
        (c * (2.0 * pieces[p, 11] + 6.0 * a * pieces[p, 12]) - d * (2.0 * pieces[p, 7] + 6.0 * a * pieces[p, 8]))
        / (length * length * length),
    )


@cython.cfunc
@cython.inline
@cython.nogil
@cython.exceptval(check=False)
def spiral_point(
    pieces: cython.const[cython.double][:, ::1], p: cython.Py_ssize_t, theta: cython.double
) -> tuple[cython.double, cython.double, cython.double, cython.double, cython.double]:
    """route_point() on a spiral piece at theta."""
    c: cython.double = cos(theta + pieces[p, 8])
    d: cython.double = sin(theta + pieces[p, 8])
    scale: cython.double = pieces[p, 9] / sqrt(1.0 + theta * theta)
    return (
        pieces[p, 5] + pieces[p, 7] * theta * c,
        pieces[p, 6] + pieces[p, 7] * theta * d,
        scale * (c - theta * d),
        scale * (d + theta * c),
        pieces[p, 9] * spiral_curvature(theta) / pieces[p, 7],
    )


@cython.ccall
@cython.exceptval(check=False)
def route_points(
    pieces: cython.const[cython.double][:, ::1], s: cython.const[cython.double][::1], out: cython.double[:, ::1]
) -> cython.void:
    """x, y, tangent x, y, curvature at every s. out: (S, 5)"""
    i: cython.Py_ssize_t
    p: cython.Py_ssize_t = 0
    with cython.nogil:
        for i in range(s.shape[0]):
            p = piece_of(pieces, s[i], p)
            out[i, 0], out[i, 1], out[i, 2], out[i, 3], out[i, 4] = route_point(pieces, p, s[i])


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def set_piece_theta(
    pieces: cython.const[cython.double][:, ::1],
    p: cython.Py_ssize_t,
    k: cython.Py_ssize_t,
    chain: cython.double[:, ::1],
) -> cython.void:
    """theta of handle k if it stands on a spiral."""
    if pieces[p, PIECE_KIND] == SPIRAL:
        chain[k, PIECE_THETA] = spiral_theta(
            (pieces[p, 10] + pieces[p, 9] * (-chain[k, PLACE] - pieces[p, S_START])) / pieces[p, 7]
        )


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def start_route(
    pieces: cython.const[cython.double][:, ::1], s: cython.double, chain: cython.double[:, ::1]
) -> cython.void:
    """Row 0 of a chain on a route: the head at s."""
    p: cython.Py_ssize_t = piece_of(pieces, s, 0)
    chain[0, PX], chain[0, PY], chain[0, TX], chain[0, TY], chain[0, CURVATURE] = route_point(pieces, p, s)
    chain[0, PLACE] = -s
    chain[0, PIECE] = p
    chain[0, RATE] = 1.0
    set_piece_theta(pieces, p, 0, chain)


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def extend_route(
    pieces: cython.const[cython.double][:, ::1],
    first: cython.Py_ssize_t,
    last: cython.Py_ssize_t,
    sizes: cython.double[:, ::1],
    chain: cython.double[:, ::1],
) -> cython.Py_ssize_t:
    """Handles after `first` to the `last`, each the first point behind its leader at the bench's chord.

    returns: last
    """
    k: cython.Py_ssize_t
    p: cython.Py_ssize_t
    i: cython.int
    s: cython.double
    chord: cython.double
    step: cython.double
    low: cython.double
    high: cython.double
    distance: cython.double
    slope: cython.double
    dx: cython.double
    dy: cython.double
    theta: cython.double
    delta: cython.double
    half: cython.double
    for k in range(first, last):
        s = -chain[k, PLACE]
        p = cython.cast(cython.Py_ssize_t, chain[k, PIECE])
        chord = sizes[k, CHORD]
        low = chord
        high = 0.5 * PI * chord
        step = chord
        if k > 0 and sizes[k - 1, CHORD] == chord:
            step = chain[k, PLACE] - chain[k - 1, PLACE]
        if pieces[p, PIECE_KIND] == LINE:
            step = chord
        elif pieces[p, PIECE_KIND] == ARC:
            step = 2.0 * pieces[p, 7] * asin(0.5 * chord / pieces[p, 7])
        elif pieces[p, PIECE_KIND] == SPIRAL:
            # on an outward spiral the follower is further in: the same equation with theta negative
            theta = -pieces[p, 9] * chain[k, PIECE_THETA]
            delta, half, _ = next_handle(
                theta,
                (chord / pieces[p, 7]) * (chord / pieces[p, 7]),
                step / (pieces[p, 7] * sqrt(1.0 + theta * theta)),
            )
            if delta > 0.0 and theta * (theta + delta) > 0.0:
                half = pieces[p, 7] * (spiral_arc(theta + delta) - spiral_arc(theta))
                if low <= half <= high:
                    step = half
                    if p == 0 or s - half >= pieces[p, S_START]:
                        chain[k + 1, PIECE_THETA] = fabs(theta + delta)
                        (
                            chain[k + 1, PX],
                            chain[k + 1, PY],
                            chain[k + 1, TX],
                            chain[k + 1, TY],
                            chain[k + 1, CURVATURE],
                        ) = spiral_point(pieces, p, fabs(theta + delta))
                        chain[k + 1, PLACE] = step - s
                        chain[k + 1, PIECE] = p
                        finish_link(k, chord, chain)
                        continue
        for i in range(80):
            if not (low <= step <= high):
                step = 0.5 * (low + high)
            p = piece_of(pieces, s - step, p)
            (
                chain[k + 1, PX],
                chain[k + 1, PY],
                chain[k + 1, TX],
                chain[k + 1, TY],
                chain[k + 1, CURVATURE],
            ) = route_point(pieces, p, s - step)
            dx = chain[k, PX] - chain[k + 1, PX]
            dy = chain[k, PY] - chain[k + 1, PY]
            distance = sqrt(dx * dx + dy * dy)
            slope = (dx * chain[k + 1, TX] + dy * chain[k + 1, TY]) / distance
            if distance < chord:
                low = step
            else:
                high = step
            if (
                fabs(distance - chord) <= 4e-16 * (chord + fabs(chain[k, PX]) + fabs(chain[k, PY]))
                or high - low <= 1e-15 * chord
            ):
                break
            step += (chord - distance) / slope if slope > 0.1 else 2.0 * high
        chain[k + 1, PLACE] = step - s
        chain[k + 1, PIECE] = p
        set_piece_theta(pieces, p, k + 1, chain)
        finish_link(k, chord, chain)
    return last


@cython.cfunc
@cython.inline
@cython.nogil
@cython.exceptval(check=False)
def finish_link(k: cython.Py_ssize_t, chord: cython.double, chain: cython.double[:, ::1]) -> cython.void:
    """Bench k between its placed handles, and the rate of the rear one by the rigid link."""
    ux: cython.double = (chain[k, PX] - chain[k + 1, PX]) / chord
    uy: cython.double = (chain[k, PY] - chain[k + 1, PY]) / chord
    chain[k, MX] = 0.5 * (chain[k, PX] + chain[k + 1, PX])
    chain[k, MY] = 0.5 * (chain[k, PY] + chain[k + 1, PY])
    chain[k, UX] = ux
    chain[k, UY] = uy
    chain[k + 1, RATE] = (
        chain[k, RATE] * (chain[k, TX] * ux + chain[k, TY] * uy) / (chain[k + 1, TX] * ux + chain[k + 1, TY] * uy)
    )


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def stretch_curvature(
    pieces: cython.const[cython.double][:, ::1],
    rear: cython.Py_ssize_t,
    k_rear: cython.double,
    front: cython.Py_ssize_t,
    k_front: cython.double,
) -> tuple[cython.double, cython.double]:
    """Lowest and highest curvature from a place on piece `rear` to one on piece `front` [1/m].

    Within a piece it lies between its ends; for a crest the row holds bounds.
    """
    p: cython.Py_ssize_t
    start: cython.double
    end: cython.double
    low: cython.double = FREE
    high: cython.double = -FREE
    for p in range(rear, front + 1):
        start = pieces[p, K_START]
        end = pieces[p, K_END]
        if pieces[p, PIECE_KIND] != CREST:
            if p == rear:
                start = k_rear
            if p == front:
                end = k_front
        low = start if start < low else low
        low = end if end < low else low
        high = start if start > high else high
        high = end if end > high else high
    return low, high


@cython.cfunc
@cython.inline
@cython.nogil
@cython.exceptval(check=False)
def stretch_slope(
    pieces: cython.const[cython.double][:, ::1],
    k: cython.Py_ssize_t,
    before: cython.double[:, ::1],
    after: cython.double[:, ::1],
) -> cython.double:
    """Bound on |d curvature / d s| from the rear of bench k to its front over an interval, jumps left out [1/m^2].

    On a spiral it falls with theta, so that the innermost handle's serves (see steepest_bend()).
    """
    rear: cython.Py_ssize_t = cython.cast(cython.Py_ssize_t, before[k + 1, PIECE])
    front: cython.Py_ssize_t = cython.cast(cython.Py_ssize_t, after[k, PIECE])
    p: cython.Py_ssize_t
    theta: cython.double
    slope: cython.double = 0.0
    if rear == front and pieces[rear, PIECE_KIND] == SPIRAL:
        theta = min(before[k + 1, PIECE_THETA], after[k, PIECE_THETA])
        if theta >= 0.5:
            return steepest_bend(theta) / (pieces[rear, 7] * pieces[rear, 7])
    for p in range(rear, front + 1):
        slope = max(slope, pieces[p, K_SLOPE])
    return slope


@cython.cfunc
@cython.inline
@cython.nogil
@cython.exceptval(check=False)
def link_cosines(k: cython.Py_ssize_t, chain: cython.double[:, ::1]) -> tuple[cython.double, cython.double]:
    """Cosines of the angles between bench k and the tangents at its front and its rear handle."""
    return (
        chain[k, TX] * chain[k, UX] + chain[k, TY] * chain[k, UY],
        chain[k + 1, TX] * chain[k, UX] + chain[k + 1, TY] * chain[k, UY],
    )


@cython.cfunc
@cython.inline
@cython.nogil
@cython.exceptval(check=False)
def swing_bound(
    low: cython.double,
    high: cython.double,
    rate: cython.double,
    rate_low: cython.double,
    ratio: cython.double,
    ratio_low: cython.double,
) -> cython.double:
    """Bound on |alpha'| of both angles of a link with curvatures in [low, high], from the rates of its leader and the
    follower's ratio to them."""
    fastest: cython.double = rate * max(1.0, ratio)
    return high * fastest - low * (rate_low * min(1.0, ratio_low) if low > 0.0 else fastest)


@cython.cfunc
@cython.inline
@cython.nogil
@cython.exceptval(check=False)
def parts_between(
    pieces: cython.const[cython.double][:, ::1],
    k: cython.Py_ssize_t,
    before: cython.double[:, ::1],
    after: cython.double[:, ::1],
) -> cython.double:
    """How many parts further on handle k stands in the second of two chains."""
    rear: cython.Py_ssize_t = cython.cast(cython.Py_ssize_t, before[k, PIECE])
    front: cython.Py_ssize_t = cython.cast(cython.Py_ssize_t, after[k, PIECE])
    return pieces[front, PART] - pieces[rear, PART]


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def route_bounds(
    pieces: cython.const[cython.double][:, ::1],
    h: cython.double,
    benches: cython.Py_ssize_t,
    sizes: cython.double[:, ::1],
    before: cython.double[:, ::1],
    after: cython.double[:, ::1],
    climbing: cython.bint,
    motion: cython.double[:, ::1],
) -> cython.bint:
    """motion_bounds() on a route. The chord lemma serves throughout, as no handle turns back where k chord < 2.

    Where the curvature changes sign between two handles the angles lie in [-k l / 2, k l / 2] for the larger |k|. The
    cosines of the angles are also followed from both ends of the interval, as near the centre of a spiral: |cos alpha|'
    <= sin alpha |alpha'|, and half an interval is the most that lies between an instant and the nearer end.
    climbing: the chains hold s'' too, which with |s'''| bounds it from both ends, until a handle crosses into another
    part, and with it the rate: so no bound grows from link to link
    """
    k: cython.Py_ssize_t
    chord: cython.double
    low: cython.double
    high: cython.double
    sin_high: cython.double
    front: cython.double
    front_end: cython.double
    front_low: cython.double
    front_high: cython.double
    rear: cython.double
    rear_end: cython.double
    rear_low: cython.double
    rear_high: cython.double
    turned: cython.double
    omega: cython.double
    swing: cython.double
    spin: cython.double
    pull: cython.double
    rate_a: cython.double = 1.0
    rate_b: cython.double
    rate_low: cython.double = 1.0
    low_b: cython.double
    second_a: cython.double = 0.0
    second_b: cython.double
    third_a: cython.double = 0.0
    third_b: cython.double
    crossed: cython.double = parts_between(pieces, 0, before, after)
    for k in range(benches):
        chord = sizes[k, CHORD]
        low, high = stretch_curvature(
            pieces,
            cython.cast(cython.Py_ssize_t, before[k + 1, PIECE]),
            before[k + 1, CURVATURE],
            cython.cast(cython.Py_ssize_t, after[k, PIECE]),
            after[k, CURVATURE],
        )
        if high <= 0.0:
            low, high = -high, -low
        elif low < 0.0:
            high = high if high > -low else -low
            low = -high
        sin_high = 0.5 * high * chord
        if sin_high > LEMMA_LIMIT:
            return False
        front_low = rear_low = sqrt(1.0 - sin_high * sin_high)
        front_high = rear_high = sqrt(1.0 - 0.25 * low * low * chord * chord) if low > 0.0 else 1.0
        if front_high > RATIO_FOLLOWED * rear_low:
            turned = swing_bound(low, high, rate_a, rate_low, front_high / rear_low, front_low / rear_high)
            turned *= 0.5 * h * sin_high
            front, rear = link_cosines(k, before)
            front_end, rear_end = link_cosines(k, after)
            front_low = max(front_low, min(front, front_end) - turned)
            front_high = min(front_high, max(front, front_end) + turned)
            rear_low = max(rear_low, min(rear, rear_end) - turned)
            rear_high = min(rear_high, max(rear, rear_end) + turned)
        rate_b = rate_a * front_high / rear_low
        low_b = rate_low * front_low / rear_high
        omega = high * max(rate_a, rate_b)
        swing = swing_bound(low, high, rate_a, rate_low, front_high / rear_low, front_low / rear_high)
        second_b = (front_high * second_a + sin_high * swing * (rate_a + rate_b)) / rear_low
        spin = omega * omega + (front_high * swing * (rate_a + rate_b) + sin_high * (second_a + second_b)) / chord
        pull = 0.5 * (second_a + second_b + high * (rate_a * rate_a + rate_b * rate_b))
        motion[k, CENTRE_SPEED] = 0.5 * (rate_a + rate_b)
        motion[k, CORNER_SPEED] = 0.5 * (rate_a + rate_b) + omega * sizes[k, RADIUS]
        motion[k, CENTRE_PULL] = pull
        motion[k, CORNER_PULL] = pull + spin * sizes[k, RADIUS]
        motion[k, TURN] = omega
        motion[k, TURN_PULL] = spin
        motion[k, TURN_LOW] = motion[k, RATE_LOW] = 0.0
        motion[k, HANDLE_SPEED] = rate_a if rate_a > rate_b else rate_b
        third_b = stretch_slope(pieces, k, before, after) * (rate_a * rate_a * rate_a + rate_b * rate_b * rate_b)
        third_b += high * (rate_a * second_a + rate_b * second_b) + (spin - omega * omega) * (rate_a + rate_b)
        third_b = sin_high * (third_b + 2.0 * swing * (second_a + second_b))
        third_b = (front_high * (third_a + swing * swing * (rate_a + rate_b)) + third_b) / rear_low
        if climbing:
            crossed += parts_between(pieces, k + 1, before, after)
            if crossed == 0.0:
                turned = max(fabs(before[k + 1, CLIMB]), fabs(after[k + 1, CLIMB]))
                second_b = min(second_b, turned + 0.5 * h * third_b)
            rate_b = min(rate_b, 0.5 * (before[k + 1, RATE] + after[k + 1, RATE] + h * second_b))
        motion[k + 1, RATE_HIGH] = rate_b
        motion[k + 1, RATE_RATE] = second_b
        motion[k + 1, RATE_JERK] = third_b
        rate_a = rate_b
        rate_low = low_b
        second_a = second_b
        third_a = third_b
    return True


# -- either kind of path ----------------------------------------------------------------------------
# `place` falls in the direction of travel: the arc length from the centre of a spiral, minus s on a route. A path
# without pieces is the spiral of that growth.


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def extend(
    growth: cython.double,
    pieces: cython.const[cython.double][:, ::1],
    first: cython.Py_ssize_t,
    last: cython.Py_ssize_t,
    sizes: cython.double[:, ::1],
    chain: cython.double[:, ::1],
) -> cython.Py_ssize_t:
    """Handles after `first` to the `last`; returns last, -1 at a fold."""
    if pieces.shape[0] == 0:
        return extend_chain(growth, first, last, FREE, sizes, chain)
    return extend_route(pieces, first, last, sizes, chain)


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def place_chain(
    growth: cython.double,
    pieces: cython.const[cython.double][:, ::1],
    place: cython.double,
    last: cython.Py_ssize_t,
    sizes: cython.double[:, ::1],
    chain: cython.double[:, ::1],
) -> cython.Py_ssize_t:
    """The chain with its head at a place, up to handle `last`; returns last, -1 at a fold."""
    if pieces.shape[0] == 0:
        start_chain(spiral_theta(place / growth), chain)
    else:
        start_route(pieces, -place, chain)
    return extend(growth, pieces, 0, last, sizes, chain)


@cython.ccall
@cython.nogil
@cython.exceptval(check=False)
def route_tail(
    pieces: cython.const[cython.double][:, ::1],
    s: cython.double,
    benches: cython.Py_ssize_t,
    sizes: cython.double[:, ::1],
    chain: cython.double[:, ::1],
) -> cython.double:
    """Where the last handle stands with the head at s on a route [m]."""
    start_route(pieces, s, chain)
    extend_route(pieces, 0, benches, sizes, chain)
    return -chain[benches, PLACE]


@cython.ccall
@cython.exceptval(check=False)
def route_trajectory(
    pieces: cython.const[cython.double][:, ::1],
    s: cython.double[::1],
    head_speed: cython.double,
    sizes: cython.double[:, ::1],
    chain: cython.double[:, ::1],
    position: cython.double[:, :, ::1],
    velocity: cython.double[:, :, ::1],
    speed: cython.double[:, ::1],
) -> cython.void:
    """spiral_trajectory() on a route. s: (T,) of the head [m]; chain: (n + 1, CHAIN_COLUMNS) scratch"""
    row: cython.Py_ssize_t
    k: cython.Py_ssize_t
    last: cython.Py_ssize_t = position.shape[1] - 1
    with cython.nogil:
        for row in range(s.shape[0]):
            start_route(pieces, s[row], chain)
            extend_route(pieces, 0, last, sizes, chain)
            for k in range(last + 1):
                position[row, k, 0] = chain[k, PX]
                position[row, k, 1] = chain[k, PY]
                velocity[row, k, 0] = head_speed * chain[k, RATE] * chain[k, TX]
                velocity[row, k, 1] = head_speed * chain[k, RATE] * chain[k, TY]
                speed[row, k] = head_speed * fabs(chain[k, RATE])


# -- marching to first contact ----------------------------------------------------------------------

# How march() ended.
REACHED = cython.declare(cython.int, 0)
TOUCHED = cython.declare(cython.int, 1)
TOUCHED_AT_START = cython.declare(cython.int, 2)
STUCK = cython.declare(cython.int, 3)
CAPACITY = cython.declare(cython.int, 4)
MARCH_STATES = ("reached", "touched", "touched_at_start", "stuck", "capacity")

# Entries of the ring array: what is known of all benches that can be the outer one of a pair [m].
RING_CLEAR = cython.declare(cython.int, 0)  # no pair whose inner bench leads at this radius or more can touch
RING_CHORD = cython.declare(cython.int, 1)  # longest chord
RING_SHORT = cython.declare(cython.int, 2)  # shortest chord
RING_OVERHANG = cython.declare(cython.int, 3)
RING_HALF_WIDTH = cython.declare(cython.int, 4)
# and of all benches
ALL_CHORD = cython.declare(cython.int, 5)
ALL_OVERHANG = cython.declare(cython.int, 6)
ALL_HALF_WIDTH = cython.declare(cython.int, 7)
# and a pair that a march leaves out, -1 for none
LEFT_OUT = cython.declare(cython.int, 8)
LEFT_OUT_TOO = cython.declare(cython.int, 9)
RING_ENTRIES = 10

# Entries of march()'s result.
PROVEN = cython.declare(cython.int, 0)  # nothing touches up to here [m of head travel]
TOUCHING = cython.declare(cython.int, 1)  # a pair is within the margin here
FIRST = cython.declare(cython.int, 2)
SECOND = cython.declare(cython.int, 3)
STEPS = cython.declare(cython.int, 4)
BEND = cython.declare(cython.int, 5)
GRAZE_GAP = cython.declare(cython.int, 6)  # the least local minimum of the clearance on the way [m], FREE if none
GRAZE_TRAVEL = cython.declare(cython.int, 7)
GRAZE_FIRST = cython.declare(cython.int, 8)
GRAZE_SECOND = cython.declare(cython.int, 9)
MARCH_ENTRIES = cython.declare(cython.int, 10)
MARCH_FIELDS = (
    "proven",
    "touching",
    "first",
    "second",
    "steps",
    "bend",
    "graze_gap",
    "graze_travel",
    "graze_first",
    "graze_second",
)
# Rates that differ by less are equal [1].
NOISE = cython.declare(cython.double, 1e-13)
# Width to which the place of a peak is found [m]: a kink's height is then good to 1e-11.
PEAK_WIDTH = cython.declare(cython.double, 1e-11)
# Width to which the place of a graze is found [m]: 1e-10 s at 1 m/s.
DIP_WIDTH = cython.declare(cython.double, 1e-10)
# Shorter steps than this part of the bracket would get nowhere [1].
LEAST_STEP = cython.declare(cython.double, 0.05)
# Without a bracket to reach, a step this short means that the way is not clear enough to be proven [m].
LEAST_WAY = cython.declare(cython.double, 1e-7)
# The chain is laid out so many drifts further than the pose needs; if that is too little the step is halved [1].
ALLOWANCE = cython.declare(cython.double, 2.0)
# A crossing is found this much closer than the bracket that is proven around it [1].
CROSSING_WIDTH = cython.declare(cython.double, 1e-3)


# A point at distance x along the extended centre line of a bench from the foot of the perpendicular from the
# spiral's centre has radius^2 = d^2 + x^2. With handles at radii r_a < r_b and x0 = (r_b^2 - r_a^2) / (2 c) they
# stand at x0 -+ c / 2. Where 0 <= x0 <= c: d^2 >= r_a^2 - c^2 / 4, and no point of the bench is further out than
# sqrt(r_b^2 + o (c + 2 x0) + o^2) + w / 2. A chord is at least (2 / pi) delta sqrt(r_a r_b), so
# x0 <= (pi / 4) growth (q + 1 / q), q^2 = r_b / r_a = 1 + delta / theta, which is below 1.67 growth once
# delta <= theta. Otherwise the triangle inequality serves.


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def settled(growth: cython.double, radius: cython.double, ring: cython.double[::1]) -> cython.bint:
    """Do all benches led from this radius outwards have 0 <= x0 <= 1.67 growth <= c?"""
    return (
        ring[RING_SHORT] >= 1.67 * growth
        and radius * radius >= 1.5708 * ring[RING_CHORD] * growth
        and radius >= 0.5 * ring[RING_CHORD]
    )


@cython.ccall
@cython.nogil
@cython.exceptval(check=False)
def radius_beyond(growth: cython.double, radius: cython.double, ring: cython.double[::1]) -> cython.double:
    """A radius such that every bench led from there or further out lies wholly outside `radius` [m]."""
    target: cython.double = radius + ring[RING_HALF_WIDTH]
    beyond: cython.double = sqrt(target * target + 0.25 * ring[RING_CHORD] * ring[RING_CHORD])
    if settled(growth, beyond, ring):
        return beyond
    beyond = 0.5 * ring[RING_CHORD]
    return target + (beyond if beyond > ring[RING_OVERHANG] else ring[RING_OVERHANG])


@cython.ccall
@cython.nogil
@cython.exceptval(check=False)
def leaders_reach(
    growth: cython.double, lead: cython.double, rear: cython.double, ring: cython.double[::1]
) -> cython.double:
    """No point of benches led from radius `lead` or more, rear handles at `rear` or less, is further out [m]."""
    chord: cython.double = ring[ALL_CHORD]
    overhang: cython.double = ring[ALL_OVERHANG]
    if lead >= 0.5 * chord and lead * lead >= 1.5708 * chord * growth:
        return sqrt(rear * rear + overhang * (chord + 3.34 * growth + overhang)) + ring[ALL_HALF_WIDTH]
    return rear + overhang + ring[ALL_HALF_WIDTH]


# Rings. A foot is at most max(c / 2, 1.67 growth) from the front handle of its chord, so d^2 >= r_a^2 - max(...)^2 also
# where it lies beyond that handle. Let E = |X| - growth psi for a point X of a bench at unwrapped polar angle psi: how
# far it lies outside the curve itself. Along the centre line e(x) = sqrt(d^2 + x^2) - growth (psi_foot + atan(x / d))
# vanishes at both handles and 0 <= e'' = d^2 / rho^3 + 2 growth d x / rho^4 <= q = 1 / d + 2 growth x_max / d^3 (for
# d > 2 growth), so between the handles e >= -q c^2 / 8 and on an overhang o e <= q o (o + c) / 2. Sideways
# |dE / dy| <= sqrt(1 + (growth / rho)^2).
# Hence -I <= E <= O with the bows O and I below, both falling as 1 / r. Points X, Y of two benches whose polar angles
# differ by 2 pi m + x, m >= 1, |x| <= pi, are apart radially by at least G + growth x, G = pitch - O - I, and sideways
# by at least 2 rho |x| / pi: together G / sqrt(1 + (pi growth / 2 rho)^2). With m = 0 at least one bench lies between
# them: its angle less the two overhangs' angles remains, each at most (o + x_b w / 2 d) / (d - w / 2), and a chord
# spans at least c / sqrt(growth^2 + r_b^2); at an angle x they are at least 2 rho sin(x / 2) apart. No angle is larger
# than that of the whole dragon, overhangs included, where a chord spans at most 2 asin(c / 2 r): while that is less
# than 2 pi, 2 rho sin(x / 2) at that angle takes the place of the bound with m >= 1. Every term grows with r, so the
# bound holds from r outwards.


# For a range of growths: G is concave in growth (its only curved terms are -growth^2 and -sqrt(1 + growth^2 /
# rho^2)), so it is at least the lesser of its values at both ends; everything else falls with growth.


@cython.ccall
@cython.nogil
@cython.exceptval(check=False)
def ring_least(
    growth_low: cython.double,
    growth: cython.double,
    radius: cython.double,
    chord: cython.double,
    shortest: cython.double,
    overhang: cython.double,
    half_width: cython.double,
    outer_chord: cython.double,
    outer_half_width: cython.double,
    total: cython.double = 1e150,
) -> cython.double:
    """Lower bound of the separation of any two non-neighbours whose inner bench leads at `radius` or further out [m].

    It holds for every growth in [growth_low, growth] [m/rad]. chord, overhang, half_width: the largest of all benches;
    shortest: chord of those that can lie between two others; outer_...: over those that can be the outer one; total: at
    least the sum of all chords, where that may help; -1e150 where the bound says nothing.
    """
    foot: cython.double = 0.5 * chord if 0.5 * chord > 1.67 * growth else 1.67 * growth
    d2: cython.double = radius * radius - foot * foot
    d: cython.double
    rho: cython.double
    q: cython.double
    x_rear: cython.double
    gap: cython.double = FREE
    bows: cython.double
    at: cython.double = growth_low
    same_turn: cython.double
    spread: cython.double
    end: cython.int
    if d2 <= 0.0 or radius * radius < 1.5708 * chord * growth:
        return -FREE
    d = sqrt(d2)
    rho = d - (half_width if half_width > outer_half_width else outer_half_width)
    if d <= 2.0 * growth or rho <= 0.0:
        return -FREE
    for end in range(2):
        x_rear = 0.5 * chord + 1.67 * at
        q = 1.0 / d + 2.0 * at * (x_rear + overhang) / (d * d2)
        bows = 0.5 * q * overhang * (overhang + chord) + 0.125 * q * outer_chord * outer_chord
        bows += (half_width + outer_half_width) * sqrt(1.0 + at * at / (rho * rho))
        if TWO_PI * at - bows < gap:
            gap = TWO_PI * at - bows
        at = growth
    gap /= sqrt(1.0 + PI * PI * growth * growth / (4.0 * rho * rho))
    x_rear = 0.5 * chord + 1.67 * growth
    same_turn = radius + PI * growth * chord / radius
    same_turn = shortest * rho / sqrt(growth * growth + same_turn * same_turn)
    spread = 2.0 * (overhang + x_rear * half_width / d) / rho
    same_turn = same_turn / rho - spread
    if same_turn <= 0.0:
        return -FREE
    same_turn = 2.0 * rho * sin(0.5 * same_turn) if same_turn < PI else 2.0 * rho
    spread += total * asin(0.5 * chord / radius) / (0.5 * chord)
    if spread < TWO_PI:
        spread = 2.0 * rho * sin(0.5 * spread) if spread > PI else 2.0 * rho
        if spread > gap:
            gap = spread
    if gap <= 0.0:
        return -FREE
    return gap if gap < same_turn else same_turn


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def chain_between(
    growth: cython.double,
    pieces: cython.const[cython.double][:, ::1],
    place: cython.double,
    leaders: cython.Py_ssize_t,
    benches: cython.Py_ssize_t,
    margin: cython.double,
    allowance: cython.double,
    ring: cython.double[::1],
    sizes: cython.double[:, ::1],
    chain: cython.double[:, ::1],
    found: cython.Py_ssize_t[::1],
) -> cython.Py_ssize_t:
    """The chain for a head at a place as far as its leading benches can touch; the last handle's index, -1 at a fold.

    found[0] = how many benches can be the inner one of a touching pair
    allowance: extra radius for what moves during an interval [m]
    """
    k: cython.Py_ssize_t
    radius: cython.double
    theta: cython.double
    if pieces.shape[0] > 0:
        found[0] = leaders
        return place_chain(growth, pieces, place, benches, sizes, chain)
    theta = spiral_theta(place / growth)
    start_chain(theta, chain)
    k = extend_chain(growth, 0, leaders, ring[RING_CLEAR], sizes, chain)
    found[0] = k
    if k <= 0:
        return k
    radius = leaders_reach(growth, growth * theta, growth * chain[k, THETA] + allowance, ring)
    return extend_chain(growth, k, benches, radius_beyond(growth, radius + margin, ring) + allowance, sizes, chain)


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def drift(rate: cython.double, h: cython.double, growth: cython.double, radius: cython.double) -> cython.double:
    """How far a handle's radius changes while it travels rate * h along the spiral [m]."""
    radial: cython.double = 2.0 * rate * h * growth / radius if radius > 0.0 else FREE
    return radial if radial <= 0.5 * radius else rate * h


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def interval_least(
    growth: cython.double,
    pieces: cython.const[cython.double][:, ::1],
    statics: cython.Py_ssize_t,
    h: cython.double,
    active: cython.Py_ssize_t,
    handles: cython.Py_ssize_t,
    benches: cython.Py_ssize_t,
    margin: cython.double,
    ring: cython.double[::1],
    sizes: cython.double[:, ::1],
    before: cython.double[:, ::1],
    after: cython.double[:, ::1],
    motion: cython.double[:, ::1],
    out: cython.double[::1],
) -> cython.double:
    """Proven least separation over an interval of all pairs led by the first `active` benches [m]; -FREE: too wide.

    out: (14,) [0] K of the least pair, [1] and [2] that pair, [3] the widest interval the same pairs would allow [m],
    [4] the least gap at the far end; the rest is scratch
    """
    edges: cython.Py_ssize_t = statics if statics >= 0 else -statics
    i: cython.Py_ssize_t
    j: cython.Py_ssize_t
    least: cython.double
    best: cython.double = FREE
    bend: cython.double = 0.0
    room: cython.double = FREE
    width: cython.double
    far: cython.double
    low: cython.double
    high: cython.double
    a: cython.Py_ssize_t = 0
    b: cython.Py_ssize_t = 0
    if pieces.shape[0] > 0:
        if not route_bounds(pieces, h, handles, sizes, before, after, False, motion):
            return -FREE
    elif not motion_bounds(growth, h, handles, sizes, before, after, motion):
        return -FREE
    if handles < benches:  # those left out must stay outside the reach of the leaders
        high = before[active, THETA] if before[active, THETA] > after[active, THETA] else after[active, THETA]
        high *= growth
        high += drift(motion[active - 1, HANDLE_SPEED], h, growth, high)
        low = before[0, THETA] if before[0, THETA] < after[0, THETA] else after[0, THETA]
        high = leaders_reach(growth, growth * low, high, ring)
        low = before[handles, THETA] if before[handles, THETA] < after[handles, THETA] else after[handles, THETA]
        low *= growth
        if low - drift(motion[handles - 1, HANDLE_SPEED], h, growth, low) < radius_beyond(growth, high + margin, ring):
            return -FREE
    for i in range(active):
        far = FREE
        if pieces.shape[0] == 0:
            far = before[i + 1, THETA] if before[i + 1, THETA] > after[i + 1, THETA] else after[i + 1, THETA]
            far = growth * far + drift(motion[i, HANDLE_SPEED], h, growth, growth * far)
            low = before[i, THETA] if before[i, THETA] < after[i, THETA] else after[i, THETA]
            low = growth * low - drift(motion[i, HANDLE_SPEED], h, growth, growth * low)
            far = radius_beyond(growth, leaders_reach(growth, low, far, ring) + margin, ring)
        for j in range(i + 2 if statics >= 0 else handles + 1, handles + 1 + edges):
            if j == handles:  # the last handle's row holds no bench; after it stand the edges at rest
                continue
            if far < FREE:
                low = before[j, THETA] if before[j, THETA] < after[j, THETA] else after[j, THETA]
                if growth * low - drift(motion[j, HANDLE_SPEED], h, growth, growth * low) > far:
                    break  # handles stand in order, so all further ones lie outside too
            least = pair_least(growth, i, j, margin, h, sizes, before, after, motion, out)
            if least >= FREE or (i == ring[LEFT_OUT] and j == ring[LEFT_OUT_TOO]):
                continue
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
    return best


@cython.cfunc
@cython.inline
@cython.nogil
@cython.exceptval(check=False)
def row_gap(
    i: cython.Py_ssize_t, j: cython.Py_ssize_t, sizes: cython.double[:, ::1], chain: cython.double[:, ::1]
) -> cython.double:
    """Separation of benches i and j of a chain [m]."""
    return pair_gap(
        chain[i, MX],
        chain[i, MY],
        chain[i, UX],
        chain[i, UY],
        sizes[i, HALF_LENGTH],
        sizes[i, HALF_WIDTH],
        chain[j, MX],
        chain[j, MY],
        chain[j, UX],
        chain[j, UY],
        sizes[j, HALF_LENGTH],
        sizes[j, HALF_WIDTH],
    )


# Benches this many in a row share one upright box, so that most of what is far apart is passed over together.
BLOCK = cython.declare(cython.Py_ssize_t, 8)


@cython.cfunc
@cython.inline
@cython.nogil
@cython.exceptval(check=False)
def block_boxes(
    benches: cython.Py_ssize_t,
    sizes: cython.double[:, ::1],
    chain: cython.double[:, ::1],
    boxes: cython.double[:, ::1],
) -> cython.Py_ssize_t:
    """Box around every block of benches: x from, x to, y from, y to [m]; returns how many there are."""
    block: cython.Py_ssize_t
    k: cython.Py_ssize_t
    blocks: cython.Py_ssize_t = (benches + BLOCK - 1) // BLOCK
    for block in range(blocks):
        boxes[block, 0] = boxes[block, 2] = FREE
        boxes[block, 1] = boxes[block, 3] = -FREE
        for k in range(block * BLOCK, block * BLOCK + BLOCK if block + 1 < blocks else benches):
            boxes[block, 0] = min(boxes[block, 0], chain[k, MX] - sizes[k, RADIUS])
            boxes[block, 1] = max(boxes[block, 1], chain[k, MX] + sizes[k, RADIUS])
            boxes[block, 2] = min(boxes[block, 2], chain[k, MY] - sizes[k, RADIUS])
            boxes[block, 3] = max(boxes[block, 3], chain[k, MY] + sizes[k, RADIUS])
    return blocks


@cython.cfunc
@cython.inline
@cython.nogil
@cython.exceptval(check=False)
def least_with(
    i: cython.Py_ssize_t,
    first: cython.Py_ssize_t,
    end: cython.Py_ssize_t,
    best: cython.double,
    sizes: cython.double[:, ::1],
    chain: cython.double[:, ::1],
    pair: cython.Py_ssize_t[::1],
) -> cython.double:
    """The lesser of best and the separations of row i from rows first to end - 1 [m]; the pair, where that is less."""
    j: cython.Py_ssize_t
    dx: cython.double
    dy: cython.double
    far: cython.double
    for j in range(first, end):
        dx = chain[j, MX] - chain[i, MX]
        dy = chain[j, MY] - chain[i, MY]
        far = sizes[i, RADIUS] + sizes[j, RADIUS] + max(best, 0.0)
        if dx * dx + dy * dy <= far * far:
            far = row_gap(i, j, sizes, chain)
            if far < best:
                best = far
                pair[1] = i
                pair[2] = j
    return best


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def row_clearance(
    active: cython.Py_ssize_t,
    handles: cython.Py_ssize_t,
    statics: cython.Py_ssize_t,
    sizes: cython.double[:, ::1],
    chain: cython.double[:, ::1],
    boxes: cython.double[:, ::1],
    pair: cython.Py_ssize_t[::1],
) -> cython.double:
    """Least separation among the pairs led by the first `active` benches, and that pair [m]; FREE without pairs.

    boxes: (handles / BLOCK, 4) at least, scratch
    """
    i: cython.Py_ssize_t
    a: cython.Py_ssize_t
    b: cython.Py_ssize_t
    blocks: cython.Py_ssize_t
    first: cython.Py_ssize_t
    dx: cython.double
    dy: cython.double
    far: cython.double
    best: cython.double = FREE
    b = handles + 1 + (statics if statics >= 0 else -statics)
    for i in range(active):  # the last handle's row holds no bench; after it stand the edges at rest
        best = least_with(i, handles + 1, b, best, sizes, chain, pair)
    if statics < 0:
        return best
    if active > 0:  # a first value to compare with
        best = least_with(0, 2, handles, best, sizes, chain, pair)
    blocks = block_boxes(handles, sizes, chain, boxes)
    for a in range((active + BLOCK - 1) // BLOCK):
        for b in range(a, blocks):
            dx = max(boxes[b, 0] - boxes[a, 1], boxes[a, 0] - boxes[b, 1], 0.0)
            dy = max(boxes[b, 2] - boxes[a, 3], boxes[a, 2] - boxes[b, 3], 0.0)
            if dx * dx + dy * dy > max(best, 0.0) * max(best, 0.0):
                continue
            for i in range(a * BLOCK, min(a * BLOCK + BLOCK, active)):
                far = sizes[i, RADIUS] + max(best, 0.0)
                dx = max(boxes[b, 0] - chain[i, MX], chain[i, MX] - boxes[b, 1], 0.0)
                dy = max(boxes[b, 2] - chain[i, MY], chain[i, MY] - boxes[b, 3], 0.0)
                if dx * dx + dy * dy <= far * far:
                    first = max(i + 2, b * BLOCK)
                    best = least_with(i, first, min(b * BLOCK + BLOCK, handles), best, sizes, chain, pair)
    return best


@cython.ccall
@cython.nogil
@cython.exceptval(check=False)
def clearance_at(
    growth: cython.double,
    pieces: cython.const[cython.double][:, ::1],
    place: cython.double,
    benches: cython.Py_ssize_t,
    leaders: cython.Py_ssize_t,
    statics: cython.Py_ssize_t,
    sizes: cython.double[:, ::1],
    chain: cython.double[:, ::1],
    boxes: cython.double[:, ::1],
    pair: cython.Py_ssize_t[::1],
) -> cython.double:
    """Clearance with the head at a place over all pairs led by the first `leaders` benches [m]; the pair in pair[1],
    pair[2]; FREE without pairs.

    chain: (n + 1, CHAIN_COLUMNS), boxes: (n / BLOCK, 4) scratch; pair[0]: the last handle placed, -1 if the chain folds
    """
    pair[0] = place_chain(growth, pieces, place, benches, sizes, chain)
    if pair[0] < 0:
        return FREE
    return row_clearance(leaders, benches, statics, sizes, chain, boxes, pair)


@cython.ccall
@cython.nogil
@cython.exceptval(check=False)
def gap_at(
    growth: cython.double,
    pieces: cython.const[cython.double][:, ::1],
    place: cython.double,
    benches: cython.Py_ssize_t,
    a: cython.Py_ssize_t,
    b: cython.Py_ssize_t,
    sizes: cython.double[:, ::1],
    chain: cython.double[:, ::1],
) -> cython.double:
    """Separation of bench a and bench (or, beyond the last handle's row, edge at rest) b with the head at a place [m].

    FREE if the chain folds.
    """
    if place_chain(growth, pieces, place, b + 1 if b < benches else a + 1, sizes, chain) < 0:
        return FREE
    return row_gap(a, b, sizes, chain)


@cython.ccall
@cython.nogil
@cython.exceptval(check=False)
def gap_rate_at(
    growth: cython.double,
    pieces: cython.const[cython.double][:, ::1],
    place: cython.double,
    benches: cython.Py_ssize_t,
    a: cython.Py_ssize_t,
    b: cython.Py_ssize_t,
    sizes: cython.double[:, ::1],
    chain: cython.double[:, ::1],
    out: cython.double[::1],
) -> cython.double:
    """How fast benches a and b part per metre of head travel: normal . (velocity of witness b - of witness a) [1].

    A bench moves with its handles: its centre by their mean, and it turns at omega = u x (a' T_a - b' T_b) / chord.
    """
    k: cython.Py_ssize_t
    side: cython.int
    rate: cython.double = 0.0
    vx: cython.double
    vy: cython.double
    omega: cython.double
    if gap_at(growth, pieces, place, benches, a, b, sizes, chain) >= FREE:
        return 0.0
    pair_separation(
        chain[a, MX],
        chain[a, MY],
        chain[a, UX],
        chain[a, UY],
        sizes[a, HALF_LENGTH],
        sizes[a, HALF_WIDTH],
        chain[b, MX],
        chain[b, MY],
        chain[b, UX],
        chain[b, UY],
        sizes[b, HALF_LENGTH],
        sizes[b, HALF_WIDTH],
        out,
    )
    for side in range(2):
        k = b if side else a
        if k > benches:
            continue
        vx = chain[k, RATE] * chain[k, TX] - chain[k + 1, RATE] * chain[k + 1, TX]
        vy = chain[k, RATE] * chain[k, TY] - chain[k + 1, RATE] * chain[k + 1, TY]
        omega = (chain[k, UX] * vy - chain[k, UY] * vx) / sizes[k, CHORD]
        vx = 0.5 * (chain[k, RATE] * chain[k, TX] + chain[k + 1, RATE] * chain[k + 1, TX])
        vy = 0.5 * (chain[k, RATE] * chain[k, TY] + chain[k + 1, RATE] * chain[k + 1, TY])
        vx -= omega * (out[2 + 2 * side] - chain[k, MY])
        vy += omega * (out[1 + 2 * side] - chain[k, MX])
        rate += (2 * side - 1) * (out[5] * vx + out[6] * vy)
    return rate


@cython.ccall
@cython.nogil
@cython.exceptval(check=False)
def crossing(
    growth: cython.double,
    pieces: cython.const[cython.double][:, ::1],
    place: cython.double,
    benches: cython.Py_ssize_t,
    low: cython.double,
    high: cython.double,
    a: cython.Py_ssize_t,
    b: cython.Py_ssize_t,
    margin: cython.double,
    tolerance: cython.double,
    of_rate: cython.bint,
    sizes: cython.double[:, ::1],
    chain: cython.double[:, ::1],
    out: cython.double[::1],
) -> cython.double:
    """Head travel from a place, in [low, high], at which benches a, b come within the margin, or (of_rate) stop
    approaching [m].

    The Illinois form of the false position with a bisection now and then, until the bracket is below the tolerance;
    its later end. Apart (approaching) at low and within the margin (parting) at high.
    """
    above: cython.double = 1.0
    below: cython.double = -1.0
    middle: cython.double
    value: cython.double
    last: cython.int = 0
    i: cython.int
    if not of_rate:
        above = gap_at(growth, pieces, place - low, benches, a, b, sizes, chain) - margin
        below = gap_at(growth, pieces, place - high, benches, a, b, sizes, chain) - margin
    for i in range(100):
        if high - low <= tolerance:
            break
        middle = low + (high - low) * above / (above - below)
        if not (low < middle < high) or i % 4 == 3:
            middle = 0.5 * (low + high)
        if of_rate:
            value = -gap_rate_at(growth, pieces, place - middle, benches, a, b, sizes, chain, out)
        else:
            value = gap_at(growth, pieces, place - middle, benches, a, b, sizes, chain) - margin
        if value > 0.0:
            low = middle
            above = value
            if last == 1:
                below *= 0.5
            last = 1
        else:
            high = middle
            below = value
            if last == -1:
                above *= 0.5
            last = -1
    return high


@cython.ccall
@cython.nogil
@cython.exceptval(check=False)
def pair_bends(
    growth: cython.double,
    pieces: cython.const[cython.double][:, ::1],
    place: cython.double,
    h: cython.double,
    a: cython.Py_ssize_t,
    b: cython.Py_ssize_t,
    sizes: cython.double[:, ::1],
    rows: cython.double[:, :, ::1],
    motion: cython.double[:, ::1],
    out: cython.double[::1],
) -> cython.bint:
    """Bounds on the second derivative of gaps of two benches while the head travels h from a place [1/m].

    out: (2,) along axes fixed in bench a, and in bench b; False where no bound is known
    """
    before: cython.double[:, ::1] = rows[0]
    after: cython.double[:, ::1] = rows[1]
    dx: cython.double
    dy: cython.double
    if place_chain(growth, pieces, place, b + 1, sizes, before) < 0:
        return False
    if place_chain(growth, pieces, place - h, b + 1, sizes, after) < 0:
        return False
    if pieces.shape[0] > 0:
        if not route_bounds(pieces, h, b + 1, sizes, before, after, False, motion):
            return False
    elif not motion_bounds(growth, h, b + 1, sizes, before, after, motion):
        return False
    dx = before[b, MX] - before[a, MX]
    dy = before[b, MY] - before[a, MY]
    dx = sqrt(dx * dx + dy * dy) + (motion[a, CENTRE_SPEED] + motion[b, CENTRE_SPEED]) * h
    out[0] = axis_bend(growth, a, b, dx, sizes, motion)
    out[1] = axis_bend(growth, b, a, dx, sizes, motion)
    return True


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def passed(
    first: cython.Py_ssize_t,
    last: cython.Py_ssize_t,
    placed: cython.Py_ssize_t,
    opening: cython.double[:, ::1],
    chain: cython.double[:, ::1],
) -> cython.bint:
    """Has every handle from `first` to `last` passed where its predecessor began?

    last: the first bench that began where none can touch, whose predecessor began where they can: from there outwards
    nothing needs to be followed
    """
    i: cython.Py_ssize_t
    for i in range(first, last + 1):
        if i > placed or chain[i, THETA] > opening[i - 1, THETA]:
            return False
    return True


@cython.ccall
@cython.exceptval(check=False)
def march(
    growth: cython.double,
    pieces: cython.const[cython.double][:, ::1],
    place: cython.double,
    start: cython.double,
    stop: cython.double,
    leaders: cython.Py_ssize_t,
    at_start: cython.bint,
    margin: cython.double,
    tolerance: cython.double,
    rounding: cython.double,
    budget: cython.Py_ssize_t,
    benches: cython.Py_ssize_t,
    statics: cython.Py_ssize_t,
    ring: cython.double[::1],
    sizes: cython.double[:, ::1],
    rows: cython.double[:, :, ::1],
    motion: cython.double[:, ::1],
    pair: cython.Py_ssize_t[::1],
    out: cython.double[::1],
) -> cython.int:
    """Advance the head from `start` to `stop` [m of travel] by proven steps, until a pair comes within the margin.

    place: at travel 0, see above [m]; leaders: benches whose pairs must be followed; at_start: follow all pairs
    until every bench has passed the start of the one before it; tolerance: half width of the bracket around a
    contact [m], 0 or less for none: to end at any instant found to be within the margin, and with 0 without looking
    for grazes; rounding: what a computed gap may be off by [m]; budget: steps; benches: n; statics: edges at rest in
    the rows after the last handle's, on a route only; negative: these alone, without pairs of benches
    sizes: (R - 1, SIZE_COLUMNS) at least; rows: (4, R, CHAIN_COLUMNS), motion: (R, MOTION_COLUMNS) scratch; out:
        (MARCH_ENTRIES,)
    returns: REACHED, TOUCHED, TOUCHED_AT_START, STUCK (budget spent or interval at rounding) or CAPACITY (R too small)
    """
    before: cython.double[:, ::1] = rows[0]
    after: cython.double[:, ::1] = rows[1]
    spare: cython.double[:, ::1] = rows[2]
    opening: cython.double[:, ::1] = rows[3]
    scratch: cython.double[::1] = out[MARCH_ENTRIES:]
    edges: cython.Py_ssize_t = statics if statics >= 0 else -statics
    room: cython.double
    cap: cython.Py_ssize_t = before.shape[0] - 1 - edges
    first: cython.Py_ssize_t = leaders
    followers: cython.Py_ssize_t = benches if at_start else leaders
    placed: cython.Py_ssize_t
    opened: cython.Py_ssize_t
    handles: cython.Py_ssize_t
    active: cython.Py_ssize_t
    travel: cython.double = start
    h: cython.double = ring[RING_SHORT]
    target: cython.double = -1.0
    least: cython.double
    floor: cython.double = FREE
    clearance: cython.double
    last_clearance: cython.double
    older_clearance: cython.double = -FREE
    last_travel: cython.double = start
    older_travel: cython.double = start
    last_a: cython.Py_ssize_t = 0
    last_b: cython.Py_ssize_t = 0
    a: cython.Py_ssize_t
    b: cython.Py_ssize_t
    lowest: cython.double
    clearance_there: cython.double
    if cap > benches:
        cap = benches
    if followers > cap:
        followers = cap
    out[GRAZE_GAP] = FREE
    out[TOUCHING] = -1.0
    out[STEPS] = out[BEND] = 0.0
    with cython.nogil:
        placed = chain_between(growth, pieces, place - start, followers, cap, margin, h, ring, sizes, before, pair)
        if placed == cap and cap < benches:
            return CAPACITY
        if placed < 0:
            return STUCK
        opened = pair[0] if pair[0] < benches else benches - 1
        opening[: placed + 1] = before[: placed + 1]
        last_clearance = row_clearance(pair[0], placed, statics, sizes, before, motion, pair)
        if last_clearance <= margin:
            out[PROVEN] = out[TOUCHING] = start
            out[FIRST] = pair[1]
            out[SECOND] = pair[2]
            return TOUCHED_AT_START
        while travel < stop:
            out[PROVEN] = travel
            if out[STEPS] >= budget or h < rounding or h < (LEAST_STEP * tolerance if tolerance > 0.0 else LEAST_WAY):
                return STUCK
            out[STEPS] += 1.0
            if h > stop - travel:
                h = stop - travel
            handles = chain_between(
                growth,
                pieces,
                place - travel - h,
                followers,
                cap,
                margin,
                ALLOWANCE * drift(fabs(before[1, RATE]) + 1.0, h, growth, growth * before[1, THETA]),
                ring,
                sizes,
                after,
                pair,
            )
            if handles == cap and cap < benches:
                return CAPACITY
            active = pair[0]
            if handles < 0:
                h *= 0.5
                target = -1.0
                continue
            room = FREE
            least = FREE
            if active > 0:
                if placed < handles:
                    placed = extend(growth, pieces, placed, handles, sizes, before)
                least = interval_least(
                    growth,
                    pieces,
                    statics,
                    h,
                    active,
                    handles,
                    benches,
                    margin,
                    ring,
                    sizes,
                    before,
                    after,
                    motion,
                    scratch,
                )
                room = 0.95 * scratch[3]
            if least <= margin + rounding:
                if least == -FREE:
                    h *= 0.5
                    target = -1.0
                    continue
                a = cython.cast(cython.Py_ssize_t, scratch[1])
                b = cython.cast(cython.Py_ssize_t, scratch[2])
                if row_gap(a, b, sizes, after) > margin:
                    h *= 0.5 if room < 0.5 * h or room >= h else room / h
                    target = -1.0
                    continue
                if tolerance <= 0.0:
                    out[TOUCHING] = travel + h
                    out[FIRST] = a
                    out[SECOND] = b
                    return TOUCHED
                target = crossing(
                    growth,
                    pieces,
                    place,
                    benches,
                    travel,
                    travel + h,
                    a,
                    b,
                    margin,
                    CROSSING_WIDTH * tolerance,
                    False,
                    sizes,
                    spare,
                    scratch,
                )
                out[FIRST] = a
                out[SECOND] = b
                out[TOUCHING] = target
                if target - tolerance - travel > rounding and target - tolerance - travel < h:
                    h = target - tolerance - travel
                    continue
                if (
                    target - tolerance <= travel
                    and gap_at(growth, pieces, place - target - tolerance, benches, a, b, sizes, spare) <= margin
                ):
                    out[TOUCHING] = target + tolerance
                    return TOUCHED
                h *= 0.5
                target = -1.0
                continue
            travel += h
            placed = handles
            before, after = after, before
            if scratch[0] > out[BEND] and active > 0:
                out[BEND] = scratch[0]
            if (
                target > 0.0
                and gap_at(
                    growth,
                    pieces,
                    place - target - tolerance,
                    benches,
                    cython.cast(cython.Py_ssize_t, out[FIRST]),
                    cython.cast(cython.Py_ssize_t, out[SECOND]),
                    sizes,
                    spare,
                )
                <= margin
            ):
                out[PROVEN] = travel
                out[TOUCHING] = target + tolerance
                return TOUCHED
            target = -1.0
            clearance = FREE
            if tolerance != 0.0:
                clearance = row_clearance(active, handles, statics, sizes, before, motion, pair)
            lowest = least if least < floor else floor
            floor = least
            if older_clearance > last_clearance <= clearance and lowest < out[GRAZE_GAP]:
                if clearance < FREE and older_travel < last_travel:
                    lowest = crossing(
                        growth,
                        pieces,
                        place,
                        benches,
                        older_travel,
                        travel,
                        last_a,
                        last_b,
                        margin,
                        DIP_WIDTH,
                        True,
                        sizes,
                        spare,
                        scratch,
                    )
                    clearance_there = gap_at(growth, pieces, place - lowest, benches, last_a, last_b, sizes, spare)
                    if clearance_there < out[GRAZE_GAP]:
                        out[GRAZE_GAP] = clearance_there
                        out[GRAZE_TRAVEL] = lowest
                        out[GRAZE_FIRST] = last_a
                        out[GRAZE_SECOND] = last_b
            older_clearance = last_clearance
            older_travel = last_travel
            last_clearance = clearance
            last_travel = travel
            last_a = pair[1]
            last_b = pair[2]
            if at_start and passed(first, opened, placed, opening, before):
                at_start = False
                followers = leaders if leaders < cap else cap
            h = room if room < 2.0 * h else 2.0 * h
        out[PROVEN] = travel
        return REACHED


# -- marching all pitches between two at once -------------------------------------------------------
# The separation of two benches is now a function of the head's radius r_0 and of the growth b. Below, ' is d / db at a
# fixed r_0, seen in the frame in which the head stands at angle 0: handle k stands at rho = r_0 + b psi, angle psi,
# P = rho R(psi), with unit vectors R outwards and T = R turned left, delta = psi_b - psi_a for a link whose front
# handle is a and rear handle b, u the unit vector from b to a, c its chord.
#
# First derivatives. With f(rho_a, delta, b) = b^2 delta^2 + 2 rho_a (rho_a + b delta) (1 - cos delta) = c^2 and
# a = rho',
#     a_b = a_a (1 - b f_rho / f_delta) + 2 rho_a rho_b delta sin delta / f_delta,
#     delta' = -(f_rho a_a + f_b) / f_delta.
# While no handle turns back (k c / 2 < 1, k the curvature) 1 - b f_rho / f_delta is the rate of a link, in [0, 1], and
# the last term is in [0, delta], so 0 <= a_k <= psi_k and delta' <= 0: radii grow with b, angles fall. With
# f_delta >= 2 rho_a rho_b sin delta and t = tan(delta / 2),
#     |delta'| <= ((2 psi_a + delta) t + (b / rho_a) delta^2 / sin delta) / rho_a  =: D,   |psi_b'| <= Q_b = Q_a + D.
# Radii also grow with r_0, and angles fall, so over r_0 in [r_L, r_R] and b in [b_L, b_R] the angles, and the least
# radii, are those at (r_L, b_L) and the largest radii those at (r_R, b_R).
#
# Turning. In the frame that turns with handle a, P_a' = a_a R_a and P_b' = a_b R_b + rho_b delta' T_b, so u turns at
# psi_a' + w / c with, as T_a . u = -rho_b sin delta / c, T_b . u = -rho_a sin delta / c, rho_a sin delta <= c,
#     |w| <= |a_b - a_a| + a_a b delta / rho_a + rho_b |delta'| q,   |a_b - a_a| <= max(delta, 2 a_a b t / rho_a),
#     q = |R_b . u| = (b delta + rho_a (1 - cos delta)) / c.
#
# Second derivatives. P'' = psi'' S + B, S = b R + rho T, B = (2 psi' - rho psi'^2) R + 2 a psi' T. From |P_a - P_b| = c
#     psi_b'' S_b . u = psi_a'' S_a . u + (B_a - B_b) . u + |P_a' - P_b'|^2 / c,
# in which, written out with psi_b' = psi_a' + delta', all that a common rotation psi_a' contributes cancels:
#     E = 2 psi_a' (R_a - R_b) . u + w^2 / c + (rho_b delta'^2 - 2 delta') R_b . u - 2 a_b delta' T_b . u,
#     |E| <= 2 Q_a delta + w^2 / c + (rho_b D + 2) D q + 2 psi_b D.
# S points along the path, |S_a| <= |S_b|, and S . u = -|S| cos alpha with cos alpha_a <= cos alpha_b (above), so for
# y = |psi''| |S|:  y_b <= y_a + |E| / cos alpha_b,  sin alpha_b <= k c / 2, and k = (rho^2 + 2 b^2) / (rho^2 +
# b^2)^(3/2) is at most 2 / (1.5^(3/2) rho) < 1.0887 / rho for every b. Then
#     |P'| <= sqrt(psi^2 + rho^2 Q^2),   |P''| <= y + sqrt((2 Q + rho Q^2)^2 + 4 psi^2 Q^2).
# A corner is (1/2 + x / c) P_a + (1/2 - x / c) P_b, |x| = half length, plus half a width across u, and |u''| is at most
# 2 |P''| / c: it accelerates by at most (length + width) / c times its handles.
#
# The gap along an axis e. At each r_0 let e turn evenly from a normal of bench m at b_L to the same normal at b_R, at a
# rate kappa <= |u_m'| then. For corners X of i and Y of j, p = Y - X,
#     |(e . p)''| <= |X''| + |Y''| + 2 kappa (|X'| + |Y'|) + kappa^2 |p|  =: K,
# so the gap is at least what least_between() makes of its least values on b = b_L and on b = b_R, K and b_R - b_L;
# these come from both ends of the step in r_0 by "certified motion". Four gaps prove a whole rectangle of (r_0, b).

# Columns of a shift row, one for each bench: bounds per growth.
SHIFT_CENTRE = cython.declare(cython.int, 0)  # |M'|
SHIFT_CORNER = cython.declare(cython.int, 1)  # |X'|
SHIFT_PULL = cython.declare(cython.int, 2)  # |X''| [rad/m]
SHIFT_TURN = cython.declare(cython.int, 3)  # |u'| [rad/m]
SHIFT_COLUMNS = 4
# Above the largest curvature of any spiral at a radius, times that radius: 2 / 1.5^(3/2) = 1.08866 [1].
CURVATURE_MOST = cython.declare(cython.double, 1.0887)
SPIRAL_CURVATURE_MOST = 1.0887


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def shift_bounds(
    low: cython.double,
    high: cython.double,
    benches: cython.Py_ssize_t,
    sizes: cython.double[:, ::1],
    inner: cython.double[:, ::1],
    outer: cython.double[:, ::1],
    shifts: cython.double[:, ::1],
) -> cython.void:
    """Bounds on how the first benches shift with the growth; inner: the chain at (r_L, b_L), outer: at (r_R, b_R)."""
    k: cython.Py_ssize_t
    chord: cython.double
    psi: cython.double = 0.0
    delta: cython.double
    s: cython.double
    c: cython.double
    rho: cython.double
    rho_b: cython.double
    lean: cython.double
    swing: cython.double
    slide: cython.double
    slides: cython.double = 0.0
    path_pull: cython.double = 0.0
    speed: cython.double = 0.0
    speed_b: cython.double
    for k in range(benches):
        chord = sizes[k, CHORD]
        delta = inner[k + 1, THETA] - inner[k, THETA]
        s = sin(0.5 * delta)
        c = cos(0.5 * delta)
        rho = low * inner[k, THETA]
        rho_b = high * outer[k + 1, THETA]
        lean = (high * delta + 2.0 * high * outer[k, THETA] * s * s) / chord
        slide = ((2.0 * psi + delta) * s / c + high * delta * delta / (2.0 * s * c * rho)) / rho
        swing = 2.0 * psi * high * s / (c * rho)
        swing = (delta if delta > swing else swing) + psi * high * delta / rho + rho_b * slide * lean
        shifts[k, SHIFT_TURN] = slides + swing / chord
        c = 0.5 * CURVATURE_MOST * chord / rho
        path_pull += (
            2.0 * slides * delta
            + swing * swing / chord
            + (rho_b * slide + 2.0) * slide * lean
            + 2.0 * (psi + delta) * slide
        ) / sqrt(1.0 - c * c)
        slides += slide
        psi += delta
        speed_b = sqrt(psi * psi + rho_b * rho_b * slides * slides)
        shifts[k, SHIFT_CENTRE] = 0.5 * (speed + speed_b)
        shifts[k, SHIFT_CORNER] = 0.5 * (speed + speed_b) + shifts[k, SHIFT_TURN] * sizes[k, RADIUS]
        s = slides * (2.0 + rho_b * slides)
        c = 2.0 * psi * slides
        shifts[k, SHIFT_PULL] = (
            2.0 * (path_pull + sqrt(s * s + c * c)) * (sizes[k, HALF_LENGTH] + sizes[k, HALF_WIDTH]) / chord
        )
        speed = speed_b


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def strip_along(
    i: cython.Py_ssize_t,
    j: cython.Py_ssize_t,
    along: cython.double,
    left: cython.double,
    bends: tuple[cython.double, cython.double, cython.double],
    widths: tuple[cython.double, cython.double, cython.double],
    sizes: cython.double[:, ::1],
    before: cython.double[:, ::1],
    after: cython.double[:, ::1],
    before_high: cython.double[:, ::1],
    after_high: cython.double[:, ::1],
) -> cython.double:
    """Proven least gap along an axis of bench i over a rectangle of (r_0, b) [m]."""
    low: cython.double = least_between(
        gap_along(i, j, along, left, sizes, before),
        gap_along(i, j, along, left, sizes, after),
        bends[0],
        widths[0],
    )
    high: cython.double = least_between(
        gap_along(i, j, along, left, sizes, before_high),
        gap_along(i, j, along, left, sizes, after_high),
        bends[1],
        widths[1],
    )
    return least_between(low, high, bends[2], widths[2])


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def strip_pair(
    low: cython.double,
    high: cython.double,
    i: cython.Py_ssize_t,
    j: cython.Py_ssize_t,
    margin: cython.double,
    h_low: cython.double,
    h_high: cython.double,
    sizes: cython.double[:, ::1],
    before: cython.double[:, ::1],
    after: cython.double[:, ::1],
    before_high: cython.double[:, ::1],
    after_high: cython.double[:, ::1],
    motion: cython.double[:, ::1],
    motion_high: cython.double[:, ::1],
    shifts: cython.double[:, ::1],
    out: cython.double[::1],
) -> cython.double:
    """A proven lower bound of the separation of benches i and j over a rectangle of (r_0, b) [m]; FREE: far apart.

    out[0]: the bend along the path of the last axis tried
    """
    best: cython.double = -FREE
    least: cython.double
    along: cython.double
    left: cython.double
    a: cython.Py_ssize_t
    b: cython.Py_ssize_t
    trial: cython.int
    bends: tuple[cython.double, cython.double, cython.double]
    widths: tuple[cython.double, cython.double, cython.double] = (h_low, h_high, high - low)
    dx: cython.double = after[j, MX] - after[i, MX]
    dy: cython.double = after[j, MY] - after[i, MY]
    distance: cython.double = sqrt(dx * dx + dy * dy)
    slack: cython.double = (motion[i, CENTRE_SPEED] + motion[j, CENTRE_SPEED]) * h_low
    slack += (shifts[i, SHIFT_CENTRE] + shifts[j, SHIFT_CENTRE]) * (high - low)
    if distance - slack > sizes[i, RADIUS] + sizes[j, RADIUS] + margin:
        return FREE
    distance += slack
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
        if best > margin:
            return best
    if margin <= 0.0:
        return best
    # two corners nearest each other: the direction between them, fixed in bench i
    pair_separation(
        after[i, MX],
        after[i, MY],
        after[i, UX],
        after[i, UY],
        sizes[i, HALF_LENGTH],
        sizes[i, HALF_WIDTH],
        after[j, MX],
        after[j, MY],
        after[j, UX],
        after[j, UY],
        sizes[j, HALF_LENGTH],
        sizes[j, HALF_WIDTH],
        out[1:],
    )
    along = out[6] * after[i, UX] + out[7] * after[i, UY]
    left = out[7] * after[i, UX] - out[6] * after[i, UY]
    least = strip_along(i, j, along, left, bends, widths, sizes, before, after, before_high, after_high)
    return least if least > best else best


@cython.ccall
@cython.exceptval(check=False)
def strip(
    low: cython.double,
    high: cython.double,
    outer: cython.double,
    inner: cython.double,
    leaders: cython.Py_ssize_t,
    margin: cython.double,
    rounding: cython.double,
    least_step: cython.double,
    budget: cython.Py_ssize_t,
    benches: cython.Py_ssize_t,
    ring: cython.double[::1],
    sizes: cython.double[:, ::1],
    rows: cython.double[:, :, ::1],
    motions: cython.double[:, :, ::1],
    shifts: cython.double[:, ::1],
    out: cython.double[::1],
) -> cython.int:
    """Prove, for all growths in [low, high] at once, that nothing touches while the head goes from `outer` to `inner`.

    Of pairs led by the first `leaders` benches; outer, inner: head radii [m]. No chord may be so long that
    CURVATURE_MOST chord / (2 inner) reaches 1.
    least_step: head travel below which it gives up [m]; budget: steps; others as for march(), motions: (2, R,
    MOTION_COLUMNS), shifts: (R, SHIFT_COLUMNS) scratch; out: (MARCH_ENTRIES,) and scratch, PROVEN and TOUCHING as head
    radii [m]
    returns: REACHED; TOUCHED with growth `low`; STUCK: not provable in one strip; CAPACITY
    """
    before: cython.double[:, ::1] = rows[0]
    after: cython.double[:, ::1] = rows[1]
    before_high: cython.double[:, ::1] = rows[2]
    after_high: cython.double[:, ::1] = rows[3]
    motion: cython.double[:, ::1] = motions[0]
    motion_high: cython.double[:, ::1] = motions[1]
    scratch: cython.double[::1] = out[MARCH_ENTRIES:]
    cap: cython.Py_ssize_t = rows.shape[1] - 1
    placed: cython.Py_ssize_t = leaders
    handles: cython.Py_ssize_t
    i: cython.Py_ssize_t
    j: cython.Py_ssize_t
    a: cython.Py_ssize_t = 0
    b: cython.Py_ssize_t = 0
    radius: cython.double = outer
    next_radius: cython.double
    place: cython.double = low * spiral_arc(outer / low)
    h: cython.double = ring[RING_SHORT]
    h_high: cython.double
    beyond: cython.double
    least: cython.double
    best: cython.double
    room: cython.double
    if cap > benches:
        cap = benches
    if leaders > cap:
        return CAPACITY
    out[STEPS] = 0.0
    out[TOUCHING] = -1.0
    with cython.nogil:
        start_chain(outer / low, before)
        start_chain(outer / high, before_high)
        extend_chain(low, 0, leaders, FREE, sizes, before)
        extend_chain(high, 0, leaders, FREE, sizes, before_high)
        while radius > inner:
            out[PROVEN] = radius
            if h < least_step or out[STEPS] >= budget:
                return STUCK
            out[STEPS] += 1.0
            next_radius = low * spiral_theta((place - h) / low)
            if next_radius <= inner:
                next_radius = inner
                h = place - low * spiral_arc(inner / low)
            h_high = high * (spiral_arc(radius / high) - spiral_arc(next_radius / high))
            start_chain(next_radius / low, after)
            start_chain(next_radius / high, after_high)
            extend_chain(low, 0, leaders, FREE, sizes, after)
            beyond = leaders_reach(high, next_radius, high * before_high[leaders, THETA], ring) + margin
            beyond = radius_beyond(high, beyond, ring)
            handles = extend_chain(low, leaders, cap, beyond, sizes, after)
            if handles < 0:
                return STUCK
            if handles == cap and cap < benches:
                return CAPACITY
            extend_chain(high, 0, handles, FREE, sizes, after_high)
            if placed < handles:
                extend_chain(low, placed, handles, FREE, sizes, before)
                extend_chain(high, placed, handles, FREE, sizes, before_high)
                placed = handles
            if not (
                motion_bounds(low, h, handles, sizes, before, after, motion)
                and motion_bounds(high, h_high, handles, sizes, before_high, after_high, motion_high)
            ):
                h *= 0.5
                continue
            shift_bounds(low, high, handles, sizes, after, before_high, shifts)
            best = room = FREE
            for i in range(leaders):
                beyond = leaders_reach(high, low * after[i, THETA], high * before_high[i + 1, THETA], ring)
                beyond = radius_beyond(high, beyond + margin, ring)
                for j in range(i + 2, handles):
                    if low * after[j, THETA] > beyond:
                        break  # handles stand in order, so all further ones lie outside too
                    least = strip_pair(
                        low,
                        high,
                        i,
                        j,
                        margin,
                        h,
                        h_high,
                        sizes,
                        before,
                        after,
                        before_high,
                        after_high,
                        motion,
                        motion_high,
                        shifts,
                        scratch,
                    )
                    if least >= FREE:
                        continue
                    if least < best:
                        best = least
                        a = i
                        b = j
                    least = 8.0 * (least - margin) / scratch[0] + h * h
                    least = sqrt(least) if least > 0.0 else 0.0
                    if least < room:
                        room = least
            room *= 0.95
            if best <= margin + rounding:
                if row_gap(a, b, sizes, after) <= margin:
                    out[TOUCHING] = next_radius
                    out[FIRST] = a
                    out[SECOND] = b
                    return TOUCHED
                h *= 0.5 if room < 0.5 * h or room >= h else room / h
                continue
            radius = next_radius
            place -= h
            placed = handles
            before, after = after, before
            before_high, after_high = after_high, before_high
            h = room if room < 2.0 * h else 2.0 * h
        out[PROVEN] = radius
        return REACHED


# -- the highest speed ------------------------------------------------------------------------------
# Rates are Lipschitz: |d rate / d sigma| = |s''| is bounded over an interval as above, so between two ends a rate is
# at most (start + end + bound h) / 2, and never above its own bound over the interval.
#
# Calm handles. Where curvature does not fall in the direction of travel and the lemma holds, |b'| <= |a'| (Vogt,
# above): on an inward spiral, a line, an arc. On a route handles only go forward, so if handle n stands on such a first
# piece at the end of an interval it did so all along, and no handle behind it is faster than it. On a spiral that holds
# from a radius outwards; the chain is laid out to twice that radius, so that handle n may drift by half of its own.


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def lively_chain(
    growth: cython.double,
    pieces: cython.const[cython.double][:, ::1],
    place: cython.double,
    last: cython.Py_ssize_t,
    calm: cython.double,
    sizes: cython.double[:, ::1],
    chain: cython.double[:, ::1],
) -> cython.Py_ssize_t:
    """The chain with its head at a place up to the first calm handle, or the last; returns that one, -1 at a fold.

    calm: on a spiral the radius from which handles are calm [m]; on a route > 0 if its first piece is calm
    """
    k: cython.Py_ssize_t = 0
    if pieces.shape[0] == 0:
        start_chain(spiral_theta(place / growth), chain)
        return extend_chain(growth, 0, last, 2.0 * calm, sizes, chain)
    start_route(pieces, -place, chain)
    while k < last and (chain[k, PIECE] > 0.0 or calm <= 0.0):
        k = extend_route(pieces, k, k + 1, sizes, chain)
    return k


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def fastest(benches: cython.Py_ssize_t, chain: cython.double[:, ::1]) -> cython.Py_ssize_t:
    """The handle with the largest |rate|, the first of equals."""
    k: cython.Py_ssize_t
    best: cython.Py_ssize_t = 0
    for k in range(1, benches + 1):
        if fabs(chain[k, RATE]) > fabs(chain[best, RATE]):
            best = k
    return best


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def top_rate(
    growth: cython.double,
    pieces: cython.const[cython.double][:, ::1],
    place: cython.double,
    benches: cython.Py_ssize_t,
    calm: cython.double,
    sizes: cython.double[:, ::1],
    chain: cython.double[:, ::1],
) -> tuple[cython.double, cython.Py_ssize_t]:
    """The largest |rate| with the head at a place, and the first handle that has it; 0 if the chain folds."""
    k: cython.Py_ssize_t = lively_chain(growth, pieces, place, benches, calm, sizes, chain)
    if k < 0:
        return 0.0, 0
    k = fastest(k, chain)
    return fabs(chain[k, RATE]), k


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def climbs(last: cython.Py_ssize_t, sizes: cython.double[:, ::1], chain: cython.double[:, ::1]) -> cython.void:
    """Fills in d rate / d sigma of the handles of a chain on a route [1/m].

    With D = P_a - P_b twice differentiated, |D| constant, N to the left of T and signed curvature:
    b'' (D . T_b) = |D'|^2 + D . (a'' T_a + k_a a'^2 N_a - k_b b'^2 N_b),  D' = a' T_a - b' T_b.
    """
    i: cython.Py_ssize_t
    second: cython.double = 0.0
    a: cython.double
    b: cython.double
    x: cython.double
    y: cython.double
    chain[0, CLIMB] = 0.0
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


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def refined_peak(
    growth: cython.double,
    pieces: cython.const[cython.double][:, ::1],
    place: cython.double,
    low: cython.double,
    high: cython.double,
    benches: cython.Py_ssize_t,
    calm: cython.double,
    sizes: cython.double[:, ::1],
    chain: cython.double[:, ::1],
) -> cython.double:
    """Head travel in [low, high] where the largest rate peaks [m].

    On a route by bisection on whether the fastest handle still gains (also where it stops at a kink), on a spiral,
    where rates only grow towards the centre, the better end.
    """
    middle: cython.double
    k: cython.Py_ssize_t
    if pieces.shape[0] == 0:
        return high
    while high - low > PEAK_WIDTH:
        middle = 0.5 * (low + high)
        _, k = top_rate(growth, pieces, place - middle, benches, calm, sizes, chain)
        climbs(k, sizes, chain)
        if chain[k, CLIMB] > 0.0:
            low = middle
        else:
            high = middle
    return high


# Within a part rates are smooth: with |r''| <= J a rate stays below its chord plus J h^2 / 8. Where one handle crosses
# one joint at x = y in [0, h], r stays below p = r_0 + s_0 x + J h^2 / 2 for x <= y and below q = r_h + s_h (x - h) +
# J h^2 / 2 for x >= y. If s_0 >= J h and s_h <= -J h it rises up to y and falls from there, so that its largest value
# r(y) <= min(p(y), q(y)), which is largest where p and q cross.


@cython.cfunc
@cython.inline
@cython.nogil
@cython.exceptval(check=False)
def smooth_bound(
    start: cython.double,
    start_slope: cython.double,
    end: cython.double,
    end_slope: cython.double,
    jerk: cython.double,
    h: cython.double,
    kink: cython.bint,
) -> cython.double:
    """No rate with these ends, |second derivative| <= jerk and at most this one kink exceeds this between them."""
    x: cython.double
    most: cython.double = max(start, end)
    if not kink:
        return most + 0.125 * jerk * h * h
    if start_slope >= jerk * h and end_slope <= -jerk * h and start_slope > end_slope:
        x = min(max((end - start - end_slope * h) / (start_slope - end_slope), 0.0), h)
        most = max(most, min(start + start_slope * x, end + end_slope * (x - h)))
    else:
        most = max(start + max(start_slope, 0.0) * h, end + max(-end_slope, 0.0) * h)
    return most + 0.5 * jerk * h * h


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def rate_bound(
    growth: cython.double,
    pieces: cython.const[cython.double][:, ::1],
    h: cython.double,
    handles: cython.Py_ssize_t,
    benches: cython.Py_ssize_t,
    calm: cython.double,
    sizes: cython.double[:, ::1],
    before: cython.double[:, ::1],
    after: cython.double[:, ::1],
    motion: cython.double[:, ::1],
) -> cython.double:
    """No |rate| exceeds this over an interval, between two chains placed up to `handles`; FREE when it is too wide."""
    k: cython.Py_ssize_t
    bound: cython.double
    upper: cython.double = 1.0
    crossed: cython.double = 0.0
    if handles == 0:
        return upper
    if pieces.shape[0] > 0:
        climbs(handles, sizes, before)
        climbs(handles, sizes, after)
        if not route_bounds(pieces, h, handles, sizes, before, after, True, motion):
            return FREE
        crossed = parts_between(pieces, 0, before, after)
    elif not motion_bounds(growth, h, handles, sizes, before, after, motion):
        return FREE
    elif handles < benches:
        bound = before[handles, THETA] if before[handles, THETA] < after[handles, THETA] else after[handles, THETA]
        bound *= growth
        if bound - drift(motion[handles - 1, HANDLE_SPEED], h, growth, bound) < calm:
            return FREE
    for k in range(1, handles + 1):
        bound = 0.5 * (fabs(before[k, RATE]) + fabs(after[k, RATE]) + motion[k, RATE_RATE] * h)
        if motion[k, RATE_HIGH] < bound:
            bound = motion[k, RATE_HIGH]
        if pieces.shape[0] > 0:
            crossed += parts_between(pieces, k, before, after)
            if bound > upper and crossed <= 1.0:
                bound = min(
                    bound,
                    smooth_bound(
                        before[k, RATE],
                        before[k, CLIMB],
                        after[k, RATE],
                        after[k, CLIMB],
                        motion[k, RATE_JERK],
                        h,
                        crossed > 0.0,
                    ),
                )
        if bound > upper:
            upper = bound
    return upper


@cython.cfunc
@cython.inline
@cython.nogil
@cython.exceptval(check=False)
def peaks_between(
    placed: cython.Py_ssize_t,
    handles: cython.Py_ssize_t,
    pieces: cython.const[cython.double][:, ::1],
    before: cython.double[:, ::1],
    after: cython.double[:, ::1],
) -> cython.bint:
    """Does the fastest handle of a route climb at the first of two chains, and not at the second?"""
    if pieces.shape[0] == 0 or placed < 0 or handles < 0:
        return False
    return before[fastest(placed, before), CLIMB] > 0.0 >= after[fastest(handles, after), CLIMB]


@cython.ccall
@cython.exceptval(check=False)
def peak_rate(
    growth: cython.double,
    pieces: cython.const[cython.double][:, ::1],
    place: cython.double,
    start: cython.double,
    stop: cython.double,
    step: cython.double,
    tolerance: cython.double,
    budget: cython.Py_ssize_t,
    benches: cython.Py_ssize_t,
    calm: cython.double,
    sizes: cython.double[:, ::1],
    rows: cython.double[:, :, ::1],
    motion: cython.double[:, ::1],
    out: cython.double[::1],
) -> cython.void:
    """The largest |rate| of any handle while the head travels from start to stop [m], and a proven upper bound.

    Samples every `step`, refines around the best, then proves interval after interval that no rate exceeds the best by
    more than the tolerance, which doubles after every `budget` links followed, so that the proof always ends; a rate
    found above it becomes the best. out: (4,) rate, upper bound, travel, intervals; calm: as in lively_chain()
    """
    before: cython.double[:, ::1] = rows[0]
    after: cython.double[:, ::1] = rows[1]
    spare: cython.double[:, ::1] = rows[2]
    placed: cython.Py_ssize_t
    handles: cython.Py_ssize_t
    travel: cython.double = start
    best: cython.double = 0.0
    at: cython.double = start
    rate: cython.double
    upper: cython.double
    h: cython.double
    peak: cython.double
    links: cython.Py_ssize_t = 0
    with cython.nogil:
        while travel <= stop:
            rate, _ = top_rate(growth, pieces, place - travel, benches, calm, sizes, spare)
            if rate > best:
                best = rate
                at = travel
            travel += step
        h = at - step if at - step > start else start
        travel = at + step if at + step < stop else stop
        travel = refined_peak(growth, pieces, place, h, travel, benches, calm, sizes, spare)
        rate, _ = top_rate(growth, pieces, place - travel, benches, calm, sizes, spare)
        if rate > best:
            best = rate
            at = travel
        out[1] = best
        out[3] = 0.0
        travel = start
        h = step
        placed = lively_chain(growth, pieces, place - start, benches, calm, sizes, before)
        while travel < stop:
            out[3] += 1.0
            if h > stop - travel:
                h = stop - travel
            upper = FREE
            handles = lively_chain(growth, pieces, place - travel - h, benches, calm, sizes, after)
            if handles >= 0:
                if 0 <= placed < handles:
                    placed = extend(growth, pieces, placed, handles, sizes, before)
                if placed >= 0:
                    upper = rate_bound(growth, pieces, h, handles, benches, calm, sizes, before, after, motion)
                rate = fabs(after[fastest(handles, after), RATE])
                if rate > best * (1.0 + NOISE):
                    best = rate
                    at = travel + h
            links += handles
            if links > budget:
                links = 0
                tolerance *= 2.0
            if upper > best + tolerance and h > PEAK_WIDTH:
                h *= 0.5
                continue
            if upper > out[1]:
                out[1] = upper
            if upper > best * (1.0 + NOISE) and peaks_between(placed, handles, pieces, before, after):
                peak = refined_peak(growth, pieces, place, travel, travel + h, benches, calm, sizes, spare)
                rate, _ = top_rate(growth, pieces, place - peak, benches, calm, sizes, spare)
                if rate > best * (1.0 + NOISE):
                    best = rate
                    at = peak
            travel += h
            placed = handles
            before, after = after, before
            h *= 1.5
        out[0] = best
        if best > out[1]:
            out[1] = best
        out[2] = at
