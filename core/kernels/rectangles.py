"""Rectangles and pairs of poses: signed separation, witness points and normal."""

import cython
from cython.cimports.libc.math import fabs, sqrt

if not cython.compiled:  # for the compiler the same stands in the .pxd
    from core.kernels.constants import *

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
PARALLEL_SINE = 2e-15


def side_of(x):
    """1 from zero upwards, -1 below."""
    return 1.0 if x >= 0.0 else -1.0


def corner_at(along, left):
    """The corner on the given sides of the centre."""
    if along >= 0.0:
        return 0 if left >= 0.0 else 1
    return 3 if left >= 0.0 else 2


def face_gap(along, left, c, s, hl, hw, other_hl, other_hw):
    """The larger gap along this rectangle's own normals; the other's centre (along, left), u = (c, s) [m]."""
    lengthwise = fabs(along) - hl - (fabs(c) * other_hl + fabs(s) * other_hw)
    sideways = fabs(left) - hw - (fabs(s) * other_hl + fabs(c) * other_hw)
    return lengthwise if lengthwise >= sideways else sideways


def point_gap_squared(x, y, hl, hw):
    """Squared distance of a point in the rectangle's frame to the rectangle, 0 inside [m^2]."""
    beyond_x = fabs(x) - hl
    beyond_y = fabs(y) - hw
    if beyond_x < 0.0:
        beyond_x = 0.0
    if beyond_y < 0.0:
        beyond_y = 0.0
    return beyond_x * beyond_x + beyond_y * beyond_y


def corners_gap_squared(along, left, c, s, hl, hw, other_hl, other_hw):
    """Least squared distance of the other's four corners to this rectangle, arguments as face_gap() [m^2]."""
    # half diagonals of the other to its front-left and front-right corners
    px = c * other_hl - s * other_hw
    py = s * other_hl + c * other_hw
    qx = c * other_hl + s * other_hw
    qy = s * other_hl - c * other_hw
    least = point_gap_squared(along + px, left + py, hl, hw)
    gap = point_gap_squared(along - px, left - py, hl, hw)
    if gap < least:
        least = gap
    gap = point_gap_squared(along + qx, left + qy, hl, hw)
    if gap < least:
        least = gap
    gap = point_gap_squared(along - qx, left - qy, hl, hw)
    if gap < least:
        least = gap
    return least


def pair_gap(ax, ay, aux, auy, ahl, ahw, bx, by, bux, buy, bhl, bhw):
    """Signed separation of two rectangles [m], as pair_separation() but without witnesses."""
    return pair_gap_within(ax, ay, aux, auy, ahl, ahw, bx, by, bux, buy, bhl, bhw, NO_LIMIT)


def pair_gap_within(ax, ay, aux, auy, ahl, ahw, bx, by, bux, buy, bhl, bhw, limit):
    """pair_gap() where it is at most limit >= 0, else some value above limit and not above pair_gap() [m].

    Where the two are equal but for rounding, either may come back.
    """
    dx = bx - ax
    dy = by - ay
    c = aux * bux + auy * buy
    s = aux * buy - auy * bux
    b_along = dx * aux + dy * auy
    b_left = dy * aux - dx * auy
    from_a = face_gap(b_along, b_left, c, s, ahl, ahw, bhl, bhw)
    if from_a > limit:
        return from_a
    a_along = -(dx * bux + dy * buy)
    a_left = -(dy * bux - dx * buy)
    from_b = face_gap(a_along, a_left, c, -s, bhl, bhw, ahl, ahw)
    if from_b > limit:
        return from_b
    if from_a <= 0.0 and from_b <= 0.0:
        return from_a if from_a >= from_b else from_b
    from_a = corners_gap_squared(b_along, b_left, c, s, ahl, ahw, bhl, bhw)
    from_b = corners_gap_squared(a_along, a_left, c, -s, bhl, bhw, ahl, ahw)
    return sqrt(from_a if from_a <= from_b else from_b)


def pair_separation(ax, ay, aux, auy, ahl, ahw, bx, by, bux, buy, bhl, bhw, out):
    """Signed separation, witness on a, witness on b, normal from a to b, and the features that realise it.

    out: (8,) separation, ax, ay, bx, by, nx, ny, 8 * feature of a + feature of b (corner 0..3 or edge 4..7)
    """
    dx = bx - ax
    dy = by - ay
    c = aux * bux + auy * buy
    s = aux * buy - auy * bux
    b_along = dx * aux + dy * auy
    b_left = dy * aux - dx * auy
    a_along = -(dx * bux + dy * buy)
    a_left = -(dy * bux - dx * buy)
    from_a = face_gap(b_along, b_left, c, s, ahl, ahw, bhl, bhw)
    from_b = face_gap(a_along, a_left, c, -s, bhl, bhw, ahl, ahw)
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


def edge_witness(x, y, ux, uy, hl, hw, along, left, c, s, other_hl, other_hw, out):
    """Fill out for the face with the largest gap; False when the rectangles are apart and corners are nearest."""
    gap = fabs(along) - hl - (fabs(c) * other_hl + fabs(s) * other_hw)
    sideways = fabs(left) - hw - (fabs(s) * other_hl + fabs(c) * other_hw)
    side = side_of(along)
    ex = side * ux
    ey = side * uy
    q = side * left
    ue = side * c
    uf = side * s
    h = hl
    w = hw
    edge = 4 if side > 0.0 else 6
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
    half = -1.0
    if fabs(uf) <= PARALLEL_SINE:
        half = other_hw
        other_feature = 6 if ue > 0.0 else 4
    elif fabs(ue) <= PARALLEL_SINE:
        half = other_hl
        other_feature = 7 if uf > 0.0 else 5
    else:
        other_feature = corner_at(-ue, uf)
    if half >= 0.0:
        low = q - half if q - half > -w else -w
        high = q + half if q + half < w else w
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


def corner_witness(x, y, ux, uy, hl, hw, along, left, c, s, other_hl, other_hw, out):
    """Fill out for the corner of the other that is nearest to this rectangle."""
    px = 0.0
    py = 0.0
    least = -1.0
    corner = 0
    for k in range(4):
        l_side = other_hl if k < 2 else -other_hl
        w_side = other_hw if k == 0 or k == 3 else -other_hw
        cx = along + c * l_side - s * w_side
        cy = left + s * l_side + c * w_side
        squared = point_gap_squared(cx, cy, hl, hw)
        if least < 0.0 or squared < least:
            least = squared
            px = cx
            py = cy
            corner = k
    side_x = side_of(px)
    side_y = side_of(py)
    beyond_x = fabs(px) - hl
    beyond_y = fabs(py) - hw
    gap = sqrt(least)
    feature = corner_at(px, py)
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


def reverse_pair(out):
    """Swap the roles of a and b in what pair_separation() wrote."""
    wx = out[1]
    wy = out[2]
    features = cython.cast(cython.int, out[7])
    out[1] = out[3]
    out[2] = out[4]
    out[3] = wx
    out[4] = wy
    out[5] = -out[5]
    out[6] = -out[6]
    out[7] = 8 * (features % 8) + features // 8


def pair_separations(a, b, out):
    """pair_separation() row by row. a, b: (n, 6) x, y, ux, uy, half length, half width; out: (n, 8)."""
    with cython.nogil:
        for i in range(a.shape[0]):
            pair_separation(
                a[i, 0], a[i, 1], a[i, 2], a[i, 3], a[i, 4], a[i, 5],
                b[i, 0], b[i, 1], b[i, 2], b[i, 3], b[i, 4], b[i, 5],
                out[i],
            )  # fmt: skip
