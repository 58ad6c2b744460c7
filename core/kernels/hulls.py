"""Benches that are the union of three convex hulls each, in place of rectangles: separation, and proven gaps."""

import cython
from cython.cimports.libc.math import atan2, fabs, floor, sqrt

if not cython.compiled:  # for the compiler the same stands in the .pxd
    from core.kernels.constants import *
    from core.kernels.records import Axis, Corner, Faced, Hulls, View

# A bench of a scene with hulls covers the union of the three hulls of its kind (core/tolerance/reach.py), an edge at
# rest its segment. The hulls of a kind stand in DIRECTIONS rows each, one for each corner; corner k lies between the
# half planes of directions k and k + 1, which are even in the frame of the bench.
#
# Separation. Two convex polygons are apart exactly if one of them has a half plane beyond which the other lies; the
# largest of these gaps is at most their distance, and falls short of it by 1 - cos(pi / DIRECTIONS) = 0.0012 of it at
# most. That gap counts as the separation here, so a margin is kept for certain. The separation of two benches is the
# least of their hulls'. As gaps along axes that are fixed in one bench, all of these are what faces.py proves.
#
# Seen from bench i, direction m of bench j stands at the angle of m turned by that between both: the corner of j that
# is the furthest in it has the number of m shifted by one and the same number for all m, so that each gap is two
# products and no trigonometry. Where the angle is within rounding of a direction, a few u, the corner may be the one
# beside it, whose support is the same to that angle times a side: pair_rounding() (pairs.py) has room for it.
#
# The best half plane. The gap along a direction n, not scaled to length 1, is a concave function G of n that grows in
# proportion to its length. Let n, of length 1, lie between n1 and n2: n = a n1 + b n2, a + b > 1. If both gaps are
# positive, G(n) >= a G(n1) + b G(n2) > the lesser of them. So among the half planes whose gap is positive, gaps rise to
# one place and fall from it: going uphill from one of them ends at the largest of all.

STEP = TWO_PI / DIRECTIONS


class Kinds:
    """The hulls of a scene's benches; none of them where benches are rectangles.

    some: are there any?
    """

    def __init__(self):
        self.some = False
        self.alike = 0

    def lay(self, hulls, of, directions):
        """Take hulls.

        hulls: (kinds * HULLS * DIRECTIONS, 2) corners; of: (n,) which kind each of the leading benches is, the last
        entry for all behind it too; directions: (DIRECTIONS, 2) unit vectors
        """
        self.hulls = hulls
        self.of = of
        self.directions = directions
        self.alike = of.shape[0] - 1
        self.some = True


def hulls_of(kinds, edge):
    """How many hulls a bench, or an edge at rest, has."""
    return 1 if edge else HULLS


def first_corner(kinds, i, hull):
    """Row of the first corner of a hull of bench i."""
    return (kinds.of[i if i < kinds.alike else kinds.alike] * HULLS + hull) * DIRECTIONS


def sector(y, x):
    """Number of the direction at or before that of a vector."""
    return cython.cast(cython.Py_ssize_t, floor(atan2(y, x) / STEP))


def wrapped(k):
    """A direction's number, from 0 to before DIRECTIONS, of one from -DIRECTIONS to before 2 DIRECTIONS."""
    if k < 0:
        return k + DIRECTIONS
    return k - DIRECTIONS if k >= DIRECTIONS else k


def corner(kinds, first, k, half_length):
    """A corner of the hull in these rows; first < 0: of an edge at rest, whose half length is given."""
    if first >= 0:
        return Corner(kinds.hulls[first + k, HULL_X], kinds.hulls[first + k, HULL_Y])
    forward = k < DIRECTIONS // 4 or k >= DIRECTIONS - DIRECTIONS // 4  # up to the next direction, as a corner is
    return Corner(half_length if forward else -half_length, 0.0)


def hulls_in(kinds, i, j, own, other, edge, sizes):
    """Hull `own` of row i, against hull `other` of row j; edge: 1 where row i is an edge at rest, 2 where j is."""
    first = -1 if edge == 1 else first_corner(kinds, i, own)
    second = -1 if edge == 2 else first_corner(kinds, j, other)
    return Hulls(first, second, sizes[i, HALF_LENGTH], sizes[j, HALF_LENGTH])


def view_of(i, j, chain):
    """Row j as row i sees it."""
    dx = chain[j, MX] - chain[i, MX]
    dy = chain[j, MY] - chain[i, MY]
    c = chain[i, UX] * chain[j, UX] + chain[i, UY] * chain[j, UY]
    s = chain[i, UX] * chain[j, UY] - chain[i, UY] * chain[j, UX]
    shift = (sector(-s, c) + DIRECTIONS // 2) % DIRECTIONS  # in the rows whatever the numbers are
    shift = shift + DIRECTIONS if shift < 0 else shift
    return View(dx * chain[i, UX] + dy * chain[i, UY], dy * chain[i, UX] - dx * chain[i, UY], c, s, shift)


def view_back(view):
    """Row i as row j sees it, from view_of(i, j)."""
    shift = (sector(view.s, view.c) + DIRECTIONS // 2) % DIRECTIONS
    shift = shift + DIRECTIONS if shift < 0 else shift
    along = -(view.along * view.c + view.left * view.s)
    return View(along, view.along * view.s - view.left * view.c, view.c, -view.s, shift)


def facing(view, i, j, sizes):
    """The half plane across or along row i beyond which the rectangle around row j is furthest."""
    across = fabs(view.left) - sizes[i, HALF_WIDTH]
    across -= fabs(view.s) * sizes[j, HALF_LENGTH] + fabs(view.c) * sizes[j, HALF_WIDTH]
    along = fabs(view.along) - sizes[i, HALF_LENGTH]
    along -= fabs(view.c) * sizes[j, HALF_LENGTH] + fabs(view.s) * sizes[j, HALF_WIDTH]
    if across >= along:
        return DIRECTIONS // 4 if view.left > 0.0 else 3 * DIRECTIONS // 4
    return 0 if view.along > 0.0 else DIRECTIONS // 2


def gap_beyond(kinds, view, hulls, k):
    """Gap beyond half plane k of the first hull to the second [m]."""
    x = kinds.directions[k, HULL_X]
    y = kinds.directions[k, HULL_Y]
    own = corner(kinds, hulls.first, k, hulls.half_length)
    other = corner(kinds, hulls.second, wrapped(k + view.shift), hulls.other_half_length)
    gap = x * (view.along - own.x) + y * (view.left - own.y)
    return gap + (x * view.c + y * view.s) * other.x + (y * view.c - x * view.s) * other.y


def uphill(kinds, view, hulls, k, enough):
    """The half plane of the first hull where going uphill from half plane k ends, or one whose gap is enough."""
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
    found = 0
    for k in range(1, DIRECTIONS):
        gap = gap_beyond(kinds, view, hulls, k)
        if gap > best:
            best = gap
            found = k
    return Axis(found, best)


# Input:  two benches, or a bench and an edge at rest, in rows i and j; what counts as near.
# State:  the nearest pair of hulls so far, with its half plane.
# Output: the record Faced.
#
# A pair of hulls is passed over once any half plane shows it to be no nearer than the nearest so far: the one that
# faces the other bench, or those across the ends. Else the way goes uphill on both hulls. Where only one of them then
# has a positive gap, the best half plane of the other, if it has a better one, is one of the two around the opposite
# direction: the sides of both hulls together, in the order of their directions, are those of the difference of the
# hulls, and the two between which the nearest direction lies are neighbours there.


def nearest_hulls(kinds, i, j, edge, limit, sizes, chain):
    """The nearest hulls of rows i and j, where they are nearer than the limit; edge: is j an edge at rest?"""
    best = Faced(0, 0, 0, 0, limit)
    view = view_of(i, j, chain)
    back = view_back(view)
    start = facing(view, i, j, sizes)
    start_back = facing(back, j, i, sizes)
    others = hulls_of(kinds, edge)
    for n in range(HULLS * others):
        own = n % HULLS
        other = (n // HULLS + 1) % others  # first the middle, which most contacts are with
        hulls = hulls_in(kinds, i, j, own, other, 2 if edge else 0, sizes)
        if gap_beyond(kinds, view, hulls, start) >= best.gap:
            continue
        if gap_beyond(kinds, view, hulls, 0) >= best.gap:
            continue
        if gap_beyond(kinds, view, hulls, DIRECTIONS // 2) >= best.gap:
            continue
        hulls_back = hulls_in(kinds, j, i, other, own, 1 if edge else 0, sizes)
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
            best = Faced(axis_back.k, other, own, 1, axis_back.gap)
        else:
            best = Faced(axis.k, own, other, 0, axis.gap)
    return best


def nearest_corner(kinds, view, hulls, k):
    """The corner of the second hull that is furthest against half plane k of the first, in its own bench's frame."""
    x = kinds.directions[k, HULL_X]
    y = kinds.directions[k, HULL_Y]
    along = x * view.c + y * view.s
    left = y * view.c - x * view.s
    best = FREE
    found = Corner(0.0, 0.0)
    for shift in range(-1, 2):  # the angle may be off by rounding
        at = corner(kinds, hulls.second, wrapped(wrapped(k + view.shift) + shift), hulls.other_half_length)
        if along * at.x + left * at.y < best:
            best = along * at.x + left * at.y
            found = at
    return found


def hulls_met(kinds, i, j, edge, sizes, chain, out):
    """Fill in the separation of the hulls in rows i and j, with its witnesses; edge: is j an edge at rest?"""
    faced = nearest_hulls(kinds, i, j, edge, FREE, sizes, chain)
    a = j if faced.turned else i
    b = i if faced.turned else j
    hulls = hulls_faced(kinds, a, b, edge, faced, sizes)
    at = nearest_corner(kinds, view_of(a, b, chain), hulls, faced.k)
    x = kinds.directions[faced.k, HULL_X]
    y = kinds.directions[faced.k, HULL_Y]
    out.separation = faced.gap
    out.nx = x * chain[a, UX] - y * chain[a, UY]
    out.ny = x * chain[a, UY] + y * chain[a, UX]
    out.bx = chain[b, MX] + at.x * chain[b, UX] - at.y * chain[b, UY]
    out.by = chain[b, MY] + at.x * chain[b, UY] + at.y * chain[b, UX]
    out.ax = out.bx - faced.gap * out.nx
    out.ay = out.by - faced.gap * out.ny
    if faced.turned:
        out.reverse()


def hulls_faced(kinds, a, b, edge, faced, sizes):
    """The hulls that nearest_hulls() found; a: the row in which its half plane is fixed, b: the other."""
    at_rest = 0
    if edge:
        at_rest = 1 if faced.turned else 2
    return hulls_in(kinds, a, b, faced.own, faced.other, at_rest, sizes)


# Within the margin for certain, for hulls as for rectangles (pairs.py). Let X be a corner of the second hull. How far
# it is beyond half plane k of the first is a gap along an axis fixed in that one's bench, so it stays below the larger
# of its ends plus K h^2 / 8; call the largest of these bounds, over all k, E. If E <= 0, X stays in the first hull: the
# hulls overlap, and every gap is 0 or less. Else X stays in the polygon of the half planes moved out by E, whose
# corners are E / cos(STEP / 2) from those of the hull: no gap along an axis is more than that.


def corner_beyond(kinds, view, hulls, at):
    """How far a corner of the second hull, in its own bench's frame, is beyond the half planes of the first [m]."""
    x = view.along + view.c * at.x - view.s * at.y
    y = view.left + view.s * at.x + view.c * at.y
    most = -FREE
    for k in range(DIRECTIONS):
        own = corner(kinds, hulls.first, k, hulls.half_length)
        most = max(most, kinds.directions[k, HULL_X] * (x - own.x) + kinds.directions[k, HULL_Y] * (y - own.y))
    return most


# Input:  a bench, the stray, and samples of psi by sine and cosine; see core/tolerance/reach.py.
# State:  for each direction the largest value so far of the front end, and of the middle.
# Output: these.


def largest_supports(chord, overhang, half_width, stray, samples, directions, found):
    """Largest samples of the supports of all places of a bench's front end and of its middle.

    samples, directions: (2, m) and (2, k) sines and cosines, and unit vectors; found: (2, at most k) [m]
    """
    inner = 0.5 * chord
    outer = inner + overhang
    for m in range(samples.shape[1]):
        sine = samples[0, m]
        cosine = samples[1, m]
        half_sine = stray / chord * sine
        half_cosine = sqrt(1.0 - half_sine * half_sine)
        c = half_cosine * half_cosine - half_sine * half_sine
        s = 2.0 * half_sine * half_cosine
        sine = fabs(sine)
        for k in range(found.shape[1]):
            across = fabs(directions[1, k] * half_cosine - directions[0, k] * half_sine)
            tip = fabs(directions[0, k] * half_cosine + directions[1, k] * half_sine) * cosine
            moved = stray * (1.0 - sine * across if sine <= across else tip)
            along = directions[0, k] * c + directions[1, k] * s
            moved += fabs(directions[1, k] * c - directions[0, k] * s) * half_width
            found[0, k] = max(found[0, k], moved + max(along * inner, along * outer))
            found[1, k] = max(found[1, k], moved + fabs(along) * inner)
