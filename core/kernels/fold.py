"""The fold near the centre at which a run ends, and the earlier places of handles."""

import cython
from cython.cimports.libc.math import cos, fabs, sin, sqrt

if not cython.compiled:  # the .pxd imports the same names for the compiler
    from core.kernels.constants import *
    from core.kernels.spiral import first_root, half_slope

# Upper bound of the fold's delta, which is above pi [rad]; and the square of the shortest chord that folds, in units of
# growth [1]. Both are derived below; with more digits they are 4.876650491316303265 and 33.44973623331110255.
CREST_DELTA = 4.876650491316303
FOLDING_CHORD2 = 33.4497362333111
# Relative angle within which a follower counts as arrived [1]; 60 bisections leave 1e-16.
ARRIVAL = 1e-12


# On f = chord^2 (spiral.py), theta is an explicit function of delta:
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
# h' falls, then rises to h'(2 pi) > 0 (spiral.py), so h has at most two zeros: H takes no value more than twice. Hence
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


def fold_theta(chord2):
    """theta of the leading handle at which its bench folds; 0.0 if it never folds."""
    if chord2 < FOLDING_CHORD2:
        return 0.0
    low = PI
    high = CREST_DELTA
    for i in range(60):
        delta = 0.5 * (low + high)
        if half_slope(theta_of_delta(delta, chord2), delta) > 0.0:
            low = delta
        else:
            high = delta
    return theta_of_delta(low, chord2)


def previous_theta(theta, chord2):
    """theta of the leader whose follower, one chord behind, stands at theta; NO_ROOT if no follower gets that far in.

    The follower's theta falls with its leader's until T . u = 0 and rises afterwards, so the first arrival has the
    largest leader angle. The bisection seeks the border of "a root exists, the follower still falls and is above
    theta".
    """
    low = 0.0
    high = theta
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
    return NO_ROOT
