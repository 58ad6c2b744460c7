"""Benches that are unions of three convex hulls instead of rectangles: their separation, and proven gaps."""

import cython
from cython.cimports.libc.math import atan2, fabs, floor, sqrt

if not cython.compiled:  # the .pxd imports the same names for the compiler
    from core.kernels.constants import *
    from core.kernels.records import Axis, Corner, Faced, Hulls, View

# In a scene with hulls a bench covers the union of the three hulls of its kind (core/shapes/reach.py), and an edge
# at rest covers its segment. Each hull of a kind takes DIRECTIONS rows, one for each corner; corner k lies between the
# half planes of directions k and k + 1, which are evenly spaced in the frame of the bench.
#
# Separation. Two convex polygons are apart exactly if one of them has a half plane beyond which the other lies. The
# largest of these gaps is at most their distance, and at most 1 - cos(pi / DIRECTIONS) = 0.0012 of the distance below
# it. This gap counts as the separation here, so that a margin is kept for certain. The separation of two benches is the
# least one of their hulls. All these gaps are along axes fixed in one bench, and such gaps are what faces.py proves.
#
# Seen from bench i, the directions of bench j are turned by the angle between both benches. So the number of the corner
# of j that is furthest in direction m is m plus a shift that is the same for all m, and each gap takes two products and
# no trigonometry. Where the angle is within rounding of a direction, a few u, the corner may be the next one; its
# support differs by that angle times a side at most, for which pair_rounding() (pairs.py) has room.
#
# The best half plane. The gap along a direction n, not scaled to length 1, is a concave function G of n that grows in
# proportion to its length. Let n, of length 1, lie between n1 and n2: n = a n1 + b n2, a + b > 1. If both gaps are
# positive, G(n) >= a G(n1) + b G(n2) > the lesser of them. So among the half planes whose gap is positive, gaps rise to
# one place and fall from it: going uphill from one of them ends at the largest of all.

STEP = TWO_PI / DIRECTIONS


class Kinds:
    """The hulls of a scene's benches; some: whether there are any, because benches may be rectangles."""

    def __init__(self):
        self.some = False
        self.alike = 0

    def lay(self, hulls, of, directions):
        """Set the hulls.

        hulls: (kinds * HULLS * DIRECTIONS, 2) corners; of: (n,) kind of each of the leading benches, where the last
        entry holds for all benches behind too; directions: (DIRECTIONS, 2) unit vectors
        """
        self.hulls = hulls
        self.of = of
        self.directions = directions
        self.alike = of.shape[0] - 1
        self.some = True


def first_corner(kinds, i, hull):
    """Row of the first corner of a hull of bench i, or AT_REST."""
    if hull == AT_REST:
        return AT_REST
    return (kinds.of[i if i < kinds.alike else kinds.alike] * HULLS + hull) * DIRECTIONS


def sector(y, x):
    """Number of the last direction that is not beyond that of a vector."""
    return cython.cast(cython.Py_ssize_t, floor(atan2(y, x) / STEP))


def wrapped(k):
    """Number of a direction, in [0, DIRECTIONS), from one in [-DIRECTIONS, 2 DIRECTIONS)."""
    if k < 0:
        return k + DIRECTIONS
    return k - DIRECTIONS if k >= DIRECTIONS else k


def corner(kinds, first, k, half_length):
    """Corner k of the hull whose rows begin at `first`; of an edge of this half length if that is AT_REST."""
    if first != AT_REST:
        return Corner(kinds.hulls[first + k, X], kinds.hulls[first + k, Y])
    forward = k < DIRECTIONS // 4 or k >= DIRECTIONS - DIRECTIONS // 4  # a corner serves up to the next direction
    return Corner(half_length if forward else -half_length, 0.0)


def hulls_in(kinds, i, j, own, other, sizes):
    """Hull `own` of row i and hull `other` of row j, AT_REST in the row of an edge at rest."""
    first = first_corner(kinds, i, own)
    return Hulls(first, first_corner(kinds, j, other), sizes[i, HALF_LENGTH], sizes[j, HALF_LENGTH])


def view_of(i, j, chain):
    """Row j in the frame of row i."""
    dx = chain[j, MX] - chain[i, MX]
    dy = chain[j, MY] - chain[i, MY]
    c = chain[i, UX] * chain[j, UX] + chain[i, UY] * chain[j, UY]
    s = chain[i, UX] * chain[j, UY] - chain[i, UY] * chain[j, UX]
    shift = (sector(-s, c) + DIRECTIONS // 2) % DIRECTIONS  # a valid row, even if the numbers are not finite
    shift = shift + DIRECTIONS if shift < 0 else shift
    return View(dx * chain[i, UX] + dy * chain[i, UY], dy * chain[i, UX] - dx * chain[i, UY], c, s, shift)


def view_back(view):
    """Row i in the frame of row j, from view_of(i, j)."""
    shift = (sector(view.s, view.c) + DIRECTIONS // 2) % DIRECTIONS
    shift = shift + DIRECTIONS if shift < 0 else shift
    along = -(view.along * view.c + view.left * view.s)
    return View(along, view.along * view.s - view.left * view.c, view.c, -view.s, shift)


def facing(view, i, j, sizes):
    """Number of the half plane across or along row i beyond which the rectangle around row j is furthest."""
    across = fabs(view.left) - sizes[i, HALF_WIDTH]
    across -= fabs(view.s) * sizes[j, HALF_LENGTH] + fabs(view.c) * sizes[j, HALF_WIDTH]
    along = fabs(view.along) - sizes[i, HALF_LENGTH]
    along -= fabs(view.c) * sizes[j, HALF_LENGTH] + fabs(view.s) * sizes[j, HALF_WIDTH]
    if across >= along:
        return DIRECTIONS // 4 if view.left > 0.0 else 3 * DIRECTIONS // 4
    return 0 if view.along > 0.0 else DIRECTIONS // 2


def gap_beyond(kinds, view, hulls, k):
    """Gap beyond half plane k of the first hull to the second [m]."""
    x = kinds.directions[k, X]
    y = kinds.directions[k, Y]
    own = corner(kinds, hulls.first, k, hulls.half_length)
    other = corner(kinds, hulls.second, wrapped(k + view.shift), hulls.other_half_length)
    gap = x * (view.along - own.x) + y * (view.left - own.y)
    return gap + (x * view.c + y * view.s) * other.x + (y * view.c - x * view.s) * other.y


def uphill(kinds, view, hulls, k, enough):
    """The half plane of the first hull reached uphill from half plane k, or the first one whose gap is enough."""
    best = gap_beyond(kinds, view, hulls, k)
    for side in range(2):
        step = 1 - 2 * side
        ahead = wrapped(k + step)
        gap = gap_beyond(kinds, view, hulls, ahead)
        if gap > best:
            while gap > best and best < enough:
                best = gap
                k = ahead
                ahead = wrapped(k + step)
                gap = gap_beyond(kinds, view, hulls, ahead)
            break
    return Axis(k, best)


def best_beyond(kinds, view, hulls):
    """The half plane of the first hull beyond which the second is furthest."""
    best = gap_beyond(kinds, view, hulls, 0)
    side = 0
    for k in range(1, DIRECTIONS):
        gap = gap_beyond(kinds, view, hulls, k)
        if gap > best:
            best = gap
            side = k
    return Axis(side, best)


# Input:  two benches, or a bench and an edge at rest, in rows i and j; the limit below which they count as near.
# State:  the nearest pair of hulls so far, with its half plane.
# Output: the record Faced.
#
# A pair of hulls is skipped once a half plane shows it to be no nearer than the nearest pair so far: the half plane
# that faces the other bench, or one across the ends. Otherwise the search goes uphill on both hulls. Where only one of
# them then has a positive gap, a better half plane of the other must be one of the two around the opposite direction:
# the sides of both hulls together, in the order of their directions, are those of the difference of the hulls, and the
# two between which the nearest direction lies are neighbours there.
def nearest_hulls(kinds, i, j, edge, limit, sizes, chain):
    """The nearest hulls of rows i and j, if they are nearer than the limit; edge: whether j is an edge at rest."""
    best = Faced(0, 0, 0, False, limit)
    view = view_of(i, j, chain)
    back = view_back(view)
    start = facing(view, i, j, sizes)
    start_back = facing(back, j, i, sizes)
    for n in range(HULLS if edge else HULLS * HULLS):
        own = n % HULLS
        other = AT_REST if edge else (n // HULLS + 1) % HULLS  # the middle first, because most contacts are with it
        hulls = hulls_in(kinds, i, j, own, other, sizes)
        if gap_beyond(kinds, view, hulls, start) >= best.gap:
            continue
        if gap_beyond(kinds, view, hulls, 0) >= best.gap:
            continue
        if gap_beyond(kinds, view, hulls, DIRECTIONS // 2) >= best.gap:
            continue
        hulls_back = hulls_in(kinds, j, i, other, own, sizes)
        axis_back = uphill(kinds, back, hulls_back, start_back, best.gap)
        if axis_back.gap >= best.gap:
            continue
        axis = uphill(kinds, view, hulls, start, best.gap)
        if axis.gap <= 0.0 and axis_back.gap <= 0.0:
            axis = best_beyond(kinds, view, hulls)
            axis_back = best_beyond(kinds, back, hulls_back)
        elif axis.gap <= 0.0:
            axis = uphill(kinds, view, hulls, wrapped(axis_back.k + back.shift), best.gap)
        elif axis_back.gap <= 0.0:
            axis_back = uphill(kinds, back, hulls_back, wrapped(axis.k + view.shift), best.gap)
        if max(axis.gap, axis_back.gap) >= best.gap:
            continue
        if axis_back.gap > axis.gap:
            best = Faced(axis_back.k, other, own, True, axis_back.gap)
        else:
            best = Faced(axis.k, own, other, False, axis.gap)
    return best


def hulls_near(kinds, edge, limit, sizes, chain, near):
    """Mark whether rows k and m + k are nearer than the limit [m], for each k of m; edge: the second are at rest."""
    for k in range(near.shape[0]):
        near[k] = nearest_hulls(kinds, k, near.shape[0] + k, edge, limit, sizes, chain).gap < limit


def nearest_corner(kinds, view, hulls, k):
    """The corner of the second hull that is deepest against half plane k of the first, in its own bench's frame."""
    x = kinds.directions[k, X]
    y = kinds.directions[k, Y]
    along = x * view.c + y * view.s
    left = y * view.c - x * view.s
    best = FREE
    deepest = Corner(0.0, 0.0)
    for shift in range(-1, 2):  # rounding of the angle may point to the next corner
        at = corner(kinds, hulls.second, wrapped(wrapped(k + view.shift) + shift), hulls.other_half_length)
        if along * at.x + left * at.y < best:
            best = along * at.x + left * at.y
            deepest = at
    return deepest


def hulls_met(kinds, i, j, edge, sizes, chain, out):
    """Fill in the separation of the hulls in rows i and j, with its witnesses; edge: whether j is an edge at rest."""
    faced = nearest_hulls(kinds, i, j, edge, FREE, sizes, chain)
    a = j if faced.swapped else i
    b = i if faced.swapped else j
    hulls = hulls_in(kinds, a, b, faced.own, faced.other, sizes)
    at = nearest_corner(kinds, view_of(a, b, chain), hulls, faced.k)
    x = kinds.directions[faced.k, X]
    y = kinds.directions[faced.k, Y]
    out.separation = faced.gap
    out.nx = x * chain[a, UX] - y * chain[a, UY]
    out.ny = x * chain[a, UY] + y * chain[a, UX]
    out.bx = chain[b, MX] + at.x * chain[b, UX] - at.y * chain[b, UY]
    out.by = chain[b, MY] + at.x * chain[b, UY] + at.y * chain[b, UX]
    out.ax = out.bx - faced.gap * out.nx
    out.ay = out.by - faced.gap * out.ny
    if faced.swapped:
        out.reverse()


# Within the margin for certain, for hulls as for rectangles (pairs.py). Let X be a corner of the second hull. Its
# distance beyond half plane k of the first hull is a gap along an axis fixed in the first bench, so it stays below the
# larger of its values at both ends plus K h^2 / 8; let E be the largest of these bounds over all k. If E <= 0, X stays
# in the first hull: the hulls overlap, and every gap is 0 or less. If E > 0, X stays in the polygon of the half planes
# moved out by E, whose corners are E / cos(STEP / 2) from those of the hull: no gap along an axis is more than that.


def corner_beyond(kinds, view, hulls, at):
    """Largest distance of a corner of the second hull, in its bench's frame, beyond a half plane of the first [m]."""
    x = view.along + view.c * at.x - view.s * at.y
    y = view.left + view.s * at.x + view.c * at.y
    most = -FREE
    for k in range(DIRECTIONS):
        own = corner(kinds, hulls.first, k, hulls.half_length)
        most = max(most, kinds.directions[k, X] * (x - own.x) + kinds.directions[k, Y] * (y - own.y))
    return most


# Input:  a bench, the stray, the samples of psi, and the directions; see core/shapes/reach.py.
# State:  for each direction the largest value so far for the front end, and for the middle.
# Output: these values.
def largest_supports(chord, overhang, half_width, stray, samples, directions, largest):
    """Largest samples of the supports of all places of a bench's front end and of its middle.

    samples: (2, m) rows SINE, COSINE; directions: (2, k) unit vectors, rows X, Y
    largest: (2, at most k) rows FRONT_END, MIDDLE [m]
    Rows take 7.0 us, columns as in Kinds 8.2 us (measured 2026-11-23).
    """
    inner = 0.5 * chord
    outer = inner + overhang
    for m in range(samples.shape[1]):
        half_sine = stray / chord * samples[SINE, m]
        half_cosine = sqrt(1.0 - half_sine * half_sine)
        c = half_cosine * half_cosine - half_sine * half_sine
        s = 2.0 * half_sine * half_cosine
        sine = fabs(samples[SINE, m])
        for k in range(largest.shape[1]):
            x = directions[X, k]
            y = directions[Y, k]
            across = fabs(y * half_cosine - x * half_sine)
            tip = fabs(x * half_cosine + y * half_sine) * samples[COSINE, m]
            moved = stray * (1.0 - sine * across if sine <= across else tip)
            along = x * c + y * s
            moved += fabs(y * c - x * s) * half_width
            largest[FRONT_END, k] = max(largest[FRONT_END, k], moved + max(along * inner, along * outer))
            largest[MIDDLE, k] = max(largest[MIDDLE, k], moved + fabs(along) * inner)
