"""Handles by safe bisection: the next one, the fold near the centre at which a run ends, a leader's place."""

import cython
from cython.cimports.libc.math import cos, fabs, sin, sqrt

if not cython.compiled:  # the .pxd imports the same names for the compiler
    from core.kernels.constants import *

# Upper bound of the fold's delta, which is above pi [rad]; and the square of the shortest chord that folds, in units of
# growth [1]. Both are derived below; with more digits they are 4.876650491316303265 and 33.44973623331110255.
CREST_DELTA = 4.876650491316303
FOLDING_CHORD2 = 33.4497362333111
# Relative angle within which a follower counts as arrived [1].
ARRIVAL = 1e-12


# Handles at theta and theta + delta are a chord apart when, in units of growth,
#     f(delta) = delta^2 + 4 theta (theta + delta) sin^2(delta / 2) = chord^2,
#     f_delta / 2 = h(delta) = delta + theta (1 - cos delta) + theta (theta + delta) sin delta,
#     f_theta / 2 = (2 theta + delta) (1 - cos delta) >= 0.
# h > 0 on (0, pi], so a root there is the first. Beyond pi,
#     h' = 1 + 2 theta sin delta + theta (theta + delta) cos delta,
#     h'' = 3 theta cos delta - theta (theta + delta) sin delta
# has one zero on (pi, 2 pi), from - to +: h' falls, then rises to h'(2 pi) > 0, so h has one minimum after its last
# fall, and at most one zero before it: the first crest of f. A root lies before this crest, or there is none (the
# fold). As theta falls f falls, so the root grows: delta is a decreasing function of theta.


# Input:  a claim about an angle that holds at low and fails at high, with two numbers that it needs.
# State:  the bracket.
# Output: the bracket after 60 halvings, 2^60 times narrower: 0.05 ULP if it was 2 pi wide.
def halved(holds, low, high, theta, chord2):
    """Both ends of the narrow bracket around the angle up to which a claim holds."""
    for i in range(60):  # a number that the compiler knows: otherwise first_root() takes twice as long
        middle = 0.5 * (low + high)
        if holds(middle, theta, chord2):
            low = middle
        else:
            high = middle
    return low, high


def half_slope(theta, delta):
    """h(delta) = f_delta / 2."""
    return delta + theta * (1.0 - cos(delta)) + theta * (theta + delta) * sin(delta)


def slope_falls(delta, theta, chord2):
    """Whether h'' < 0."""
    return 3.0 * cos(delta) - (theta + delta) * sin(delta) < 0.0


def half_slope_falls(delta, theta, chord2):
    """Whether h' < 0."""
    return 1.0 + 2.0 * theta * sin(delta) + theta * (theta + delta) * cos(delta) < 0.0


def chord_grows(delta, theta, chord2):
    """Whether h > 0."""
    return half_slope(theta, delta) > 0.0


def chord_is_short(delta, theta, chord2):
    """Whether f < chord^2."""
    value = sin(0.5 * delta)
    return delta * delta + 4.0 * theta * (theta + delta) * value * value < chord2


def first_crest(theta):
    """The delta at which f first stops growing, in (pi, 2 pi]; 2 pi if it grows throughout."""
    low, _ = halved(slope_falls, PI, TWO_PI, theta, 0.0)
    low, _ = halved(half_slope_falls, low, TWO_PI, theta, 0.0)
    if half_slope(theta, low) >= 0.0:
        return TWO_PI
    low, _ = halved(chord_grows, PI, low, theta, 0.0)
    return low


def first_root(theta, chord2):
    """First root delta of f = chord2 in (0, 2 pi], by safe bisection; NO_ROOT when the chain folds."""
    low = 0.0
    high = PI
    if PI * PI + 4.0 * theta * (theta + PI) < chord2:
        low = PI
        high = first_crest(theta)
        if chord_is_short(high, theta, chord2):
            return NO_ROOT
    low, high = halved(chord_is_short, low, high, theta, chord2)
    return 0.5 * (low + high)


# The fold. On f = chord^2 theta is an explicit function of delta:
#     theta(delta) = -delta / 2 + sqrt(delta^2 / 4 + (chord^2 - delta^2) / (2 (1 - cos delta))).
# The chain follows this function from large theta (small delta) until theta stops falling. As f_theta > 0, that is
# where h = f_delta / 2 first vanishes along it: the fold. Up to delta = pi, h > 0. With chord <= pi the head reaches
# the centre, where delta = chord.
#
# There is at most one place to look, and it is found by bisection. With S = -sin delta > 0 and K = 1 - cos delta > 0,
# on pi < delta < 2 pi
#     -h = S theta^2 + (S delta - K) theta - delta
# has the product of its roots in theta negative: h vanishes at one theta > 0, call it H(delta), is positive below it
# and negative above. H grows without bound towards both ends, where S falls to 0: towards pi as K / S, towards 2 pi as
# sqrt(delta / S), because there K / S falls to 0 too. For a fixed theta, h is positive at pi and at 2 pi, and its slope
# h' falls, then rises to h'(2 pi) > 0, so h has at most two zeros: H takes no value more than twice. Hence
# H falls strictly up to its least value, at D, and rises strictly from there. For if a < b < D had H(a) < H(b), a value
# between these two would be taken before a, between a and b, between b and D and beyond D; if they had H(a) = H(b),
# that value would be taken at a, at b, and at D or beyond it. From D to 2 pi the same holds from the other side. Now
#     C(delta) = f(H(delta), delta)   has   C' = f_theta H' + f_delta = f_theta H',
# so it falls up to D too and rises from there: from no bound to C(D) and on to its limit (2 pi)^2. Along the chain
# chord^2 = f(theta(delta), delta), and f grows with theta, so
#     h(theta(delta), delta) > 0   <=>   theta(delta) < H(delta)   <=>   chord^2 < C(delta).
# Hence with chord^2 < C(D) h stays positive: no fold. With more, h changes sign once on (pi, D], from + to -, and this
# is its first change: the fold. (From D on it may change back, but the chain does not get that far.) D and C(D) are two
# constants.


def theta_of_delta(delta, chord2):
    """theta at which the first root is delta."""
    square = 0.25 * delta * delta + (chord2 - delta * delta) / (2.0 * (1.0 - cos(delta)))
    return sqrt(square) - 0.5 * delta if square > 0.0 else 0.0


def chord_unfolds(delta, theta, chord2):
    """Whether h(theta(delta), delta) > 0."""
    return half_slope(theta_of_delta(delta, chord2), delta) > 0.0


def fold_theta(chord2):
    """theta of the leading handle at which its bench folds; 0.0 if it never folds."""
    if chord2 < FOLDING_CHORD2:
        return 0.0
    low, _ = halved(chord_unfolds, PI, CREST_DELTA, 0.0, chord2)
    return theta_of_delta(low, chord2)


def arrives_later(leader, theta, chord2):
    """True if there is no root, the follower has stopped falling, or it is at or below theta."""
    delta = first_root(leader, chord2)
    s = sin(0.5 * delta)
    return not (
        delta > 0.0
        and leader + delta > theta
        and delta + leader * (leader + delta) * sin(delta) > 2.0 * (leader + delta) * s * s
    )


def previous_theta(theta, chord2):
    """theta of the leader whose follower, one chord behind, stands at theta; NO_ROOT if no follower gets that far in.

    The follower's theta falls with its leader's until T . u = 0 and rises afterwards, so the first arrival has the
    largest leader angle. The bisection seeks the border of "a root exists, the follower still falls and is above
    theta".
    """
    low, high = halved(arrives_later, 0.0, theta, theta, chord2)
    if low < 0.5 * (low + high) < high:  # a leader much nearer to the centre
        low, high = halved(arrives_later, low, high, theta, chord2)
    delta = first_root(high, chord2)
    if high < theta and delta > 0.0 and fabs(high + delta - theta) <= ARRIVAL * (1.0 + theta):
        return high
    return NO_ROOT
