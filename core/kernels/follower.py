"""Proof that a bench can follow a route with any bends: its rear handle moves forwards, and never jumps."""

import cython
from cython.cimports.libc.math import fabs, sqrt

import core.kernels.constants as of_python  # only for results: compiled enums are plain numbers

if not cython.compiled:  # the .pxd imports the same names for the compiler
    from core.kernels.constants import *
    from core.kernels.corners import corners_between, cosines_past
    from core.kernels.route import first_behind, piece_of, route_point

# Let D(s, r) be the distance between the places s and r < s of a route, c the chord, u the direction from r to s, T the
# tangents. dD/ds = u . T(s) and dD/dr = -u . T(r), so D changes by at most 1 for each metre of either place. The rear
# handle of a bench with its front handle at s is at f(s), the largest r < s with D(s, r) = c.
#
# A slab: all s from a to b = a + h. Let r_a = f(a) and r_b = f(b), r_a <= r_b, and let e > 0 be such that on the box of
# all s in [a, b] and r in [r_a, r_b + e]
#     u . T(r) > 0 (1)   and   u . T(s) > 0 (2),
# and D(s, r) < c for all s in [a, b] and r in [r_b + e, s] (3). Then D falls with r in the box, and grows with s: for
# each s, D(s, r_a) >= D(a, r_a) = c >= D(s, r_b), so there is one root r in [r_a, r_b]; none is between r_b and r_b + e
# by (1), and none is nearer by (3): it is f(s). By the implicit function theorem f is differentiable with f' = u . T(s)
# / u . T(r) > 0. Slabs side by side share f at their common end. So the rear handle is where the first place behind is,
# it moves forwards without a jump, and its u . T is at least the bound of (1) on every box.
#
# Bounds on a box. With g_r = (P(s) - P(r)) . T(r) and g_s = (P(s) - P(r)) . T(s), D > 0 times the two cosines,
#     |dg_r/ds| = |T(s) . T(r)| <= 1,   |dg_r/dr| <= 1 + k_r D,   |dg_s/dr| <= 1,   |dg_s/ds| <= 1 + k_s D,
# with |curvature| <= k_r in the box's r, and <= k_s in its s. The values at the middle of the box, less these times
# half its sides, are lower bounds; at the follower itself D = c.
# (3): with m the middle of the slab, D(s, r) <= D(m, r) + h / 2. From r = m backwards, while the slack
# c - h / 2 - D(m, r) is positive, (3) holds for as many metres more.
#
# e: near the follower D(m, r_b + e) is c - e u . T(r) - h / 2 u . T(s), which needs to be below c - h / 2.
#
# At a corner T jumps: a box that holds one takes the least of the values with the tangent at its middle and with the
# directions of the lines beside its corners. Within the box the tangent is nowhere further than its whole side from one
# of these, in place of half.
#
# Rounding: places and points are good to SPARE beside LOOSE, far above their rounding on routes of less than 1e5 m.
SPARE = 1e-10
# Width of a slab over its chord: at first and at most, and so narrow that it fails [1].
SLAB, SLAB_LEAST = 0.02, 1e-8
# Factor of e over what it needs, and its least value over the width of a slab [1].
AHEAD, AHEAD_LEAST = 2.0, 0.5


def sharpest_between(pieces, low, high, p):
    """Upper bound of the |curvature| from one place to another [1/m]; p: a piece nearby."""
    p = piece_of(pieces, low, p)
    most = max(fabs(pieces[p, K_START]), fabs(pieces[p, K_END]))
    while p + 1 < pieces.shape[0] and pieces[p, S_END] < high:
        p += 1
        most = max(most, fabs(pieces[p, K_START]), fabs(pieces[p, K_END]))
    return most + pieces[0, CURVATURE_SLACK]


class Follower:
    """A bench of some chord on a route, and how far it is proven to follow it: see the top of this file.

    chord: [m]; least: least u . T at the rear handle that counts as followable [1]
    reached: place of the front handle up to which all is proven [m]; rear: of the rear one then [m]
    rear_cosine, front_cosine: proven lower bounds of u . T at both handles, where the proof was needed [1]
    longest: largest way along the route between both [m]; work: done so far [1]
    """

    def __init__(self, pieces, chord, least):
        self.pieces = pieces
        self.chord = chord
        self.least = least
        self.spare = SPARE + pieces[0, LOOSE]
        self.reached = self.rear = -FREE
        self.rear_cosine = self.front_cosine = 1.0
        self.longest = chord
        self.work = 0.0
        self.p = self.q = 0
        self.cornered = pieces[0, CORNERED] > 0.0

    def follow(self, start, stop, beyond, most_work):
        """Prove on from a place of the front handle to `stop`, or to where the rear handle is `beyond` [m].

        returns: how it ended, as Follows says; work stops it at most_work
        """
        with cython.nogil:
            ended = self.prove(start, stop, beyond, most_work)
        return of_python.Follows(ended)

    def prove(self, start, stop, beyond, most_work):
        """follow(), as the number of its result."""
        h = SLAB * self.chord
        self.reached = start
        self.rear = self.rear_of(start)
        if self.rear == -FREE:
            return Follows.NOWHERE
        ended = self.stands()
        while ended == Follows.PROVEN and self.reached < stop and self.rear < beyond:
            if self.work > most_work:
                return Follows.UNKNOWN
            h = min(h, SLAB * self.chord)
            failed = self.slab(min(h, stop - self.reached))
            if failed == Follows.PROVEN:
                h *= 2.0
            else:
                h *= 0.5
                if h < SLAB_LEAST * self.chord:
                    return failed
        return ended

    def rear_of(self, s):
        """f(s) [m], -FREE if it is not found."""
        self.p = piece_of(self.pieces, s, self.p)
        x, y, _, _, _ = route_point(self.pieces, self.p, s, 0.0)
        self.work += 4.0
        step, self.q = first_behind(self.pieces, self.p, s, 0.0, x, y, self.chord)
        return s - step if step != NO_ROOT else -FREE

    def stands(self):
        """Whether the bench stands as it may where the proof begins, so that a refusal there has its reason."""
        rear, front = self.cosines(self.reached, self.rear)
        if rear <= self.least:
            return Follows.SIDEWAYS
        return Follows.PROVEN if front > 0.0 else Follows.BACKWARDS

    def cosines(self, s, r):
        """u . T at r and at s, times D over the chord."""
        self.p = piece_of(self.pieces, s, self.p)
        self.q = piece_of(self.pieces, r, self.q)
        x, y, tx, ty, _ = route_point(self.pieces, self.p, s, 0.0)
        bx, by, ux, uy, _ = route_point(self.pieces, self.q, r, 0.0)
        self.work += 2.0
        dx = (x - bx) / self.chord
        dy = (y - by) / self.chord
        return dx * ux + dy * uy, dx * tx + dy * ty

    def slab(self, h):
        """Prove the slab of width h from `reached` on, and step to its end; returns the condition that fails."""
        a = self.reached
        b = a + h
        r = self.rear_of(b)
        if r == -FREE:
            return Follows.NOWHERE
        if fabs(r - self.rear) * self.least > h + self.spare:  # |f'| <= 1 / least
            return Follows.JUMPS
        if r < self.rear:
            return Follows.BACKWARDS
        rear, front = self.cosines(b, r)
        if rear <= self.least:
            return Follows.SIDEWAYS
        if front <= 0.0:
            return Follows.BACKWARDS
        if self.cornered:
            rear = max(self.past(rear, r, r + SLAB * self.chord, b, r), self.least)
        ahead = h * (0.5 * AHEAD * (1.0 - min(front, 1.0)) / rear + AHEAD_LEAST) + 4.0 * self.spare / rear
        near = r + ahead
        middle = a + 0.5 * h
        half = 0.5 * (near - self.rear)
        rear, front = self.cosines(middle, self.rear + half)
        most = self.chord + h + 2.0 * half  # of D on the box
        bend = sharpest_between(self.pieces, self.rear, near, self.q)
        if self.cornered:
            bend *= 2.0
            rear = self.past(rear, self.rear, near, middle, self.rear + half)
        rear -= (0.5 * h + half * (1.0 + bend * most) + 4.0 * self.spare) / self.chord
        if rear <= self.least:
            return Follows.SIDEWAYS
        bend = sharpest_between(self.pieces, a, b, self.p)
        if self.cornered:
            bend *= 2.0
            front = self.past(front, a, b, middle, self.rear + half)
        front -= (half + 0.5 * h * (1.0 + bend * most) + 4.0 * self.spare) / self.chord
        if front <= 0.0:
            return Follows.BACKWARDS
        if not self.nearer_are_near(middle, 0.5 * h, near):
            return Follows.JUMPS
        self.longest = max(self.longest, b - self.rear)
        self.rear_cosine = min(self.rear_cosine, rear)
        self.front_cosine = min(self.front_cosine, front)
        self.reached = b
        self.rear = r
        return Follows.PROVEN

    def past(self, cosine, low, high, s, r):
        """The least of a cosine and those of the lines beside the corners between two places, with u from r to s, times
        the distance over the chord."""
        first = piece_of(self.pieces, low - self.spare, self.q)
        last = piece_of(self.pieces, high + self.spare, first)
        if corners_between(self.pieces, first, last) == 0.0:
            return cosine
        x, y, _, _, _ = route_point(self.pieces, self.p, s, 0.0)
        bx, by, tx, ty, _ = route_point(self.pieces, self.q, r, 0.0)
        self.work += 2.0 + last - first
        least, _ = cosines_past(self.pieces, first, last, tx, ty, (x - bx) / self.chord, (y - by) / self.chord)
        return min(cosine, least)

    def nearer_are_near(self, middle, half, near):
        """Whether all places from `near` on are less than a chord from the places within `half` of the middle (3)."""
        p = piece_of(self.pieces, middle, self.p)
        x, y, _, _, _ = route_point(self.pieces, p, middle, 0.0)
        within = self.chord - half - self.spare
        r = middle - within
        while r > near:
            p = piece_of(self.pieces, r, p)
            bx, by, _, _, _ = route_point(self.pieces, p, r, 0.0)
            self.work += 1.0
            slack = within - sqrt((x - bx) * (x - bx) + (y - by) * (y - by))
            if slack <= self.spare:
                return False
            r -= slack
        return True
