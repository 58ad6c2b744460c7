"""Benches that are the union of three convex hulls each, in place of rectangles: separation, and proven gaps."""

import cython
from cython.cimports.libc.math import atan2, floor

if not cython.compiled:  # for the compiler the same stands in the .pxd
    from core.kernels.constants import *
    from core.kernels.records import Axis, Corner

# A bench of a scene with hulls covers the union of the three hulls of its kind (core/tolerance/reach.py), an edge at
# rest its segment. The hulls of a kind stand in DIRECTIONS rows each, one for each corner; corner k lies between the
# half planes of directions k and k + 1, which are even in the frame of the bench.
#
# Separation. Two convex polygons are apart exactly if one of them has a half plane beyond which the other lies; the
# largest of these gaps is at most their distance, and falls short of it by 1 - cos(pi / DIRECTIONS) = 0.0012 of it at
# most. That gap counts as the separation here, so a margin is kept for certain. The separation of two benches is the
# least of their hulls'. As gaps along axes that are fixed in one bench, all of these are what faces.py proves.
#
# Seen from bench i, direction m of bench j stands at the angle of m turned by that between both: the corner of i that
# is the furthest in it has the number of m shifted by one and the same number for all m, so that each gap is two
# products and no trigonometry.

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
    """A direction's number, from 0 to before DIRECTIONS."""
    k = k % DIRECTIONS
    return k + DIRECTIONS if k < 0 else k


def corner(kinds, first, k, half_length):
    """A corner of the hull in these rows; first < 0: of an edge at rest, whose half length is given."""
    if first >= 0:
        return Corner(kinds.hulls[first + k, HULL_X], kinds.hulls[first + k, HULL_Y])
    forward = k < DIRECTIONS // 4 or k >= DIRECTIONS - DIRECTIONS // 4  # up to the next direction, as a corner is
    return Corner(half_length if forward else -half_length, 0.0)


# Input:  two hulls, of benches or edges at rest in rows i and j; `edge`: 1 where that in i is an edge, 2 that in j.
# State:  the direction, of those fixed in i, with the largest gap so far, and that gap.
# Output: the record Axis.


def best_face(kinds, i, j, own, other, edge, sizes, chain):
    """The half plane of a hull of i beyond which a hull of j is furthest, and that gap [m]."""
    dx = chain[j, MX] - chain[i, MX]
    dy = chain[j, MY] - chain[i, MY]
    along = dx * chain[i, UX] + dy * chain[i, UY]
    left = dy * chain[i, UX] - dx * chain[i, UY]
    c = chain[i, UX] * chain[j, UX] + chain[i, UY] * chain[j, UY]
    s = chain[i, UX] * chain[j, UY] - chain[i, UY] * chain[j, UX]
    first = -1 if edge == 1 else first_corner(kinds, i, own)
    second = -1 if edge == 2 else first_corner(kinds, j, other)
    shift = sector(-s, c) + DIRECTIONS // 2
    best = -FREE
    found = 0
    for k in range(DIRECTIONS):
        x = kinds.directions[k, HULL_X]
        y = kinds.directions[k, HULL_Y]
        gap = x * along + y * left
        at = corner(kinds, first, k, sizes[i, HALF_LENGTH])
        gap -= x * at.x + y * at.y
        if gap <= best:
            continue
        at = corner(kinds, second, wrapped(k + shift), sizes[j, HALF_LENGTH])
        gap += (x * c + y * s) * at.x + (y * c - x * s) * at.y  # less the support in the opposite direction
        if gap > best:
            best = gap
            found = k
    return Axis(found, own, other, edge, best)


def face_witness(kinds, i, j, axis, sizes, chain):
    """The corner of j that is the furthest against an axis of i, from the centre of j, in the world [m]."""
    x = kinds.directions[axis.k, HULL_X]
    y = kinds.directions[axis.k, HULL_Y]
    ex = -(x * chain[i, UX] - y * chain[i, UY])
    ey = -(x * chain[i, UY] + y * chain[i, UX])
    along = ex * chain[j, UX] + ey * chain[j, UY]
    left = ey * chain[j, UX] - ex * chain[j, UY]
    second = -1 if axis.edge == 2 else first_corner(kinds, j, axis.other)
    nearest = sector(left, along)
    best = -FREE
    found = Corner(0.0, 0.0)
    for shift in range(-1, 2):  # the angle may be off by rounding
        at = corner(kinds, second, wrapped(nearest + shift), sizes[j, HALF_LENGTH])
        if along * at.x + left * at.y > best:
            best = along * at.x + left * at.y
            found = at
    return Corner(found.x * chain[j, UX] - found.y * chain[j, UY], found.x * chain[j, UY] + found.y * chain[j, UX])


def face_gap_along(kinds, i, j, axis, sizes, chain):
    """Gap beyond a half plane of a hull of i to a hull of j [m]."""
    x = kinds.directions[axis.k, HULL_X]
    y = kinds.directions[axis.k, HULL_Y]
    at = face_witness(kinds, i, j, axis, sizes, chain)
    dx = chain[j, MX] - chain[i, MX] + at.x
    dy = chain[j, MY] - chain[i, MY] + at.y
    at = corner(kinds, -1 if axis.edge == 1 else first_corner(kinds, i, axis.own), axis.k, sizes[i, HALF_LENGTH])
    return x * (dx * chain[i, UX] + dy * chain[i, UY] - at.x) + y * (dy * chain[i, UX] - dx * chain[i, UY] - at.y)


def hulls_gap(kinds, i, j, edge, sizes, chain, out):
    """Separation of the hulls in rows i and j [m], with its witnesses; edge: is j an edge at rest?"""
    best = FREE
    turned = False
    nearest = Axis(0, 0, 0, 0, FREE)
    for own in range(HULLS):
        for other in range(hulls_of(kinds, edge)):
            faced = best_face(kinds, i, j, own, other, 2 if edge else 0, sizes, chain)
            if faced.gap >= best:
                continue
            back = best_face(kinds, j, i, other, own, 1 if edge else 0, sizes, chain)
            if back.gap > faced.gap:
                if back.gap < best:
                    best = back.gap
                    nearest = back
                    turned = True
            else:
                best = faced.gap
                nearest = faced
                turned = False
    a = j if turned else i
    b = i if turned else j
    x = kinds.directions[nearest.k, HULL_X]
    y = kinds.directions[nearest.k, HULL_Y]
    at = face_witness(kinds, a, b, nearest, sizes, chain)
    out.separation = best
    out.nx = x * chain[a, UX] - y * chain[a, UY]
    out.ny = x * chain[a, UY] + y * chain[a, UX]
    out.bx = chain[b, MX] + at.x
    out.by = chain[b, MY] + at.y
    out.ax = out.bx - best * out.nx
    out.ay = out.by - best * out.ny
    if turned:
        out.reverse()
    return best
