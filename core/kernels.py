# cython: language_level=3, boundscheck=False, wraparound=False, cdivision=True, initializedcheck=False
"""The compiled loops, in Cython's pure-Python mode: the same file runs uncompiled, slower.

Only loops live here. Angles are in radians, lengths on a spiral in units of its growth unless a name
says otherwise; no function allocates. -1.0 inside this file means "no such root" and never leaves core.
"""

import cython
from cython.cimports.libc.math import asinh, cos, fabs, sin, sqrt

COMPILED = cython.compiled

PI = cython.declare(cython.double, 3.141592653589793)
TWO_PI = cython.declare(cython.double, 6.283185307179586)
# Halley's error after a step e is about e^3 / delta^2, so a relative step of 1e-5 leaves 1e-15 [1].
HALLEY_STEP = cython.declare(cython.double, 1e-5)
# Below this half angle the Taylor sums of half_angle() are exact to 1e-17 [rad].
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
def half_angle(half: cython.double) -> tuple[cython.double, cython.double]:
    """sin and cos of a half angle, by their series where that is exact."""
    if fabs(half) > SERIES_LIMIT:
        return sin(half), cos(half)
    z: cython.double = half * half
    s: cython.double = 1.0 - z / 6.0 * (
        1.0 - z / 20.0 * (1.0 - z / 42.0 * (1.0 - z / 72.0 * (1.0 - z / 110.0 * (1.0 - z / 156.0))))
    )
    c: cython.double = 1.0 - z / 2.0 * (
        1.0 - z / 12.0 * (1.0 - z / 30.0 * (1.0 - z / 56.0 * (1.0 - z / 90.0 * (1.0 - z / 132.0 * (1.0 - z / 182.0)))))
    )
    return half * s, c


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def half_slope(theta: cython.double, delta: cython.double) -> cython.double:
    """h(delta) = f_delta / 2."""
    return delta + theta * (1.0 - cos(delta)) + theta * (theta + delta) * sin(delta)


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def first_crest(theta: cython.double) -> cython.double:
    """Where f first stops growing, in (pi, 2 pi]; 2 pi if it grows throughout."""
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
def next_handle(
    theta: cython.double, chord2: cython.double, guess: cython.double
) -> tuple[cython.double, cython.double, cython.double]:
    """delta, sin(delta / 2), cos(delta / 2) of the next handle; delta -1.0 when the chain folds.

    Halley's iteration from the guess; whatever leaves (0, pi] goes to the safe root.
    """
    delta: cython.double = guess
    s: cython.double
    c: cython.double
    value: cython.double
    slope: cython.double
    curve: cython.double
    step: cython.double
    product: cython.double
    i: cython.int
    for i in range(12):
        s, c = half_angle(0.5 * delta)
        product = 2.0 * theta * (theta + delta)
        value = delta * delta + 2.0 * product * s * s - chord2
        slope = 2.0 * (delta + 2.0 * theta * s * s + product * s * c)
        curve = 2.0 + 8.0 * theta * s * c + product * (1.0 - 2.0 * s * s)
        step = 2.0 * value * slope / (2.0 * slope * slope - value * curve)
        delta -= step
        if not (0.0 < delta <= PI) or slope <= 0.0:
            break
        if fabs(step) <= HALLEY_STEP * delta:
            step *= -0.5
            return delta, s + step * (c - 0.5 * step * s), c - step * (s + 0.5 * step * c)
    delta = first_root(theta, chord2)
    return delta, sin(0.5 * delta), cos(0.5 * delta)


@cython.cfunc
@cython.inline
@cython.nogil
@cython.exceptval(check=False)
def theta_ratio(
    theta: cython.double, delta: cython.double, s: cython.double, c: cython.double
) -> cython.double:
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
    """A start for next_handle without history: the chord as an arc of the circle through theta + half a step."""
    delta: cython.double = sqrt(chord2 / (1.0 + theta * theta))
    delta = sqrt(chord2 / (1.0 + theta * (theta + delta)))
    if delta > 3.0:
        return 3.0
    return delta


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
    row: cython.Py_ssize_t
    k: cython.Py_ssize_t
    theta: cython.double
    delta: cython.double
    s: cython.double
    c: cython.double
    x: cython.double
    y: cython.double
    turn: cython.double
    rate: cython.double
    chord: cython.double
    chord2: cython.double
    d1: cython.double
    d2: cython.double
    d3: cython.double
    guess: cython.double
    alike: cython.int
    with cython.nogil:
        for row in range(thetas.shape[0]):
            theta = thetas[row]
            x = cos(theta)
            y = sin(theta)
            rate = -head_speed / sqrt(1.0 + theta * theta)
            chord = -1.0
            chord2 = d1 = d2 = d3 = guess = 0.0
            alike = 0
            for k in range(chords.shape[0] + 1):
                position[row, k, 0] = growth * theta * x
                position[row, k, 1] = growth * theta * y
                velocity[row, k, 0] = rate * (x - theta * y)
                velocity[row, k, 1] = rate * (y + theta * x)
                speed[row, k] = fabs(rate) * sqrt(1.0 + theta * theta)
                if k == chords.shape[0]:
                    break
                if chords[k] != chord:
                    chord = chords[k]
                    chord2 = (chord / growth) * (chord / growth)
                    alike = 0
                    guess = first_guess(theta, chord2)
                elif alike == 1:
                    guess = d1
                elif alike == 2:
                    guess = 2.0 * d1 - d2
                else:
                    guess = 3.0 * (d1 - d2) + d3
                alike += 1
                delta, s, c = next_handle(theta, chord2, guess)
                if delta < 0.0:
                    return row
                rate *= theta_ratio(theta, delta, s, c)
                turn = 2.0 * s * c
                s = 2.0 * s * s
                c = x - (x * s + y * turn)
                y = y - (y * s - x * turn)
                x = c
                theta += delta
                d3 = d2
                d2 = d1
                d1 = delta
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

# Edges whose directions differ by less than this sine count as parallel: along a bench the difference is then
# below the rounding of a coordinate, while headings that should be equal differ by about 1e-16 [1].
PARALLEL_SINE = cython.declare(cython.double, 1e-14)
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
def point_gap_squared(
    x: cython.double, y: cython.double, hl: cython.double, hw: cython.double
) -> cython.double:
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
    """pair_gap() where it is at most limit >= 0, else any value above limit and not above pair_gap() [m]."""
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
def pair_separations(
    a: cython.double[:, ::1], b: cython.double[:, ::1], out: cython.double[:, ::1]
) -> cython.void:
    """pair_separation() row by row. a, b: (n, 6) x, y, ux, uy, half length, half width; out: (n, 8)."""
    i: cython.Py_ssize_t
    with cython.nogil:
        for i in range(a.shape[0]):
            pair_separation(
                a[i, 0], a[i, 1], a[i, 2], a[i, 3], a[i, 4], a[i, 5],
                b[i, 0], b[i, 1], b[i, 2], b[i, 3], b[i, 4], b[i, 5],
                out[i],
            )  # fmt: skip
