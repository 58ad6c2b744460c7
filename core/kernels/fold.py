"""Where a run ends: the fold near the centre, and who stood where before."""

import cython
from cython.cimports.libc.math import cos, fabs, sin, sqrt

if not cython.compiled:  # for the compiler the same stands in the .pxd
    from core.kernels.constants import *
    from core.kernels.spiral import first_root, half_slope

# The fold is searched in this many steps of delta from pi to 2 pi, then bisected.
FOLD_SAMPLES = 256
# A follower counts as arrived within this relative angle (60 bisections leave 1e-16) [1].
ARRIVAL = 1e-12


# On f = chord^2, theta is an explicit function of delta:
#     theta(delta) = -delta / 2 + sqrt(delta^2 / 4 + (chord^2 - delta^2) / (2 (1 - cos delta))).
# The chain follows it from large theta (delta small) until theta stops falling, h = 0: the fold. A fold needs
# delta > pi; with chord <= pi the head reaches the centre, where delta = chord.


def theta_of_delta(delta, chord2):
    """theta at which the first root is delta."""
    square = 0.25 * delta * delta + (chord2 - delta * delta) / (2.0 * (1.0 - cos(delta)))
    return sqrt(square) - 0.5 * delta if square > 0.0 else 0.0


def fold_theta(chord2):
    """theta of the leading handle at which its bench folds; 0.0 when it never does."""
    if chord2 <= PI * PI:
        return 0.0
    low = PI
    end = sqrt(chord2)
    if end > TWO_PI:
        end = TWO_PI
    high = PI
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


def previous_theta(theta, chord2):
    """theta of the handle one chord further in whose follower stands at theta; -1.0 if none got that far.

    The follower falls with its leader until T . u = 0 and rises after it, so the first arrival is the largest
    leader angle: the border of "a root exists, the follower still falls, and stands outside theta".
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
    return -1.0
