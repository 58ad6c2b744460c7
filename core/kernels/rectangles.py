"""Rectangles and pairs of poses: signed separation, witness points and normal."""

import cython
from cython.cimports.libc.math import fabs, sqrt

if not cython.compiled:  # the .pxd imports the same names for the compiler
    from core.kernels.constants import *
    from core.kernels.records import Rectangle, Relative

# A rectangle is its centre, the unit vector u along its length, its half length hl and half width hw; v is u turned
# left. FRONT_LEFT to REAR_LEFT are its corners, FRONT to LEFT its edges (constants.py).
#
# Everything is measured from one of the two centres, so that rectangles far from the origin lose no digits. In
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
# Error: a few ulp of the largest of the distance and the sizes.

# Sine of the largest angle between two edges that count as parallel [1]. Headings that should be equal differ by an ulp
# or two (4e-16 each), and a witness placed on an edge that counts as parallel misses it by 1e-15 of its length.
PARALLEL_SINE = 2e-15


class Witnesses:
    """Separation of two rectangles a and b with its witnesses: two points, the normal from a to b, features."""

    def __init__(self):
        self.separation = self.ax = self.ay = self.bx = self.by = self.nx = self.ny = 0.0
        self.feature_a = self.feature_b = 0

    def reverse(self):
        """Swap the roles of a and b."""
        self.ax, self.bx = self.bx, self.ax
        self.ay, self.by = self.by, self.ay
        self.nx = -self.nx
        self.ny = -self.ny
        self.feature_a, self.feature_b = self.feature_b, self.feature_a


def side_of(x):
    """1 from zero upwards, -1 below."""
    return 1.0 if x >= 0.0 else -1.0


def corner_at(along, left):
    """The corner on the given sides of the centre."""
    if along >= 0.0:
        return FRONT_LEFT if left >= 0.0 else FRONT_RIGHT
    return REAR_LEFT if left >= 0.0 else REAR_RIGHT


def seen_from(a, b):
    """Rectangle b in the frame of a."""
    dx = b.x - a.x
    dy = b.y - a.y
    return Relative(
        dx * a.ux + dy * a.uy, dy * a.ux - dx * a.uy, a.ux * b.ux + a.uy * b.uy, a.ux * b.uy - a.uy * b.ux,
        a.half_length, a.half_width, b.half_length, b.half_width,
    )  # fmt: skip


def face_gap(seen):
    """The larger gap along the normals of the rectangle from which the other is seen [m]."""
    lengthwise = fabs(seen.along) - seen.hl - (fabs(seen.c) * seen.other_hl + fabs(seen.s) * seen.other_hw)
    sideways = fabs(seen.left) - seen.hw - (fabs(seen.s) * seen.other_hl + fabs(seen.c) * seen.other_hw)
    return lengthwise if lengthwise >= sideways else sideways


def point_gap_squared(x, y, hl, hw):
    """Squared distance of a point in the rectangle's frame to the rectangle, 0 inside [m^2]."""
    beyond_x = max(fabs(x) - hl, 0.0)
    beyond_y = max(fabs(y) - hw, 0.0)
    return beyond_x * beyond_x + beyond_y * beyond_y


def corners_gap_squared(seen):
    """Least squared distance of the four corners of a rectangle from the rectangle that sees it [m^2]."""
    # half diagonals of the other to its front-left and front-right corners
    px = seen.c * seen.other_hl - seen.s * seen.other_hw
    py = seen.s * seen.other_hl + seen.c * seen.other_hw
    qx = seen.c * seen.other_hl + seen.s * seen.other_hw
    qy = seen.s * seen.other_hl - seen.c * seen.other_hw
    least = point_gap_squared(seen.along + px, seen.left + py, seen.hl, seen.hw)
    least = min(least, point_gap_squared(seen.along - px, seen.left - py, seen.hl, seen.hw))
    least = min(least, point_gap_squared(seen.along + qx, seen.left + qy, seen.hl, seen.hw))
    return min(least, point_gap_squared(seen.along - qx, seen.left - qy, seen.hl, seen.hw))


def pair_gap_within(a, b, limit):
    """Signed separation of two rectangles [m] if it is at most limit; else a value above limit, at most the separation.

    Where limit and separation differ by rounding alone, either case may apply.
    """
    b_seen = seen_from(a, b)
    from_a = face_gap(b_seen)
    if from_a > limit:
        return from_a
    a_seen = seen_from(b, a)
    from_b = face_gap(a_seen)
    if from_b > limit:
        return from_b
    if from_a <= 0.0 and from_b <= 0.0:
        return from_a if from_a >= from_b else from_b
    from_a = corners_gap_squared(b_seen)
    from_b = corners_gap_squared(a_seen)
    return sqrt(from_a if from_a <= from_b else from_b)


def pair_separation(a, b, out):
    """Fill out with the signed separation of two rectangles and its witnesses."""
    b_seen = seen_from(a, b)
    a_seen = seen_from(b, a)
    if face_gap(b_seen) >= face_gap(a_seen):
        if edge_witness(a, b_seen, out):
            return
    elif edge_witness(b, a_seen, out):
        out.reverse()
        return
    if corners_gap_squared(b_seen) <= corners_gap_squared(a_seen):
        corner_witness(a, b_seen, out)
    else:
        corner_witness(b, a_seen, out)
        out.reverse()


# In the two functions below rectangle `a` sees rectangle b; pair_separation() swaps the roles. Turn the frame so that
# the chosen face's outward normal is e, and f is to its left: the other's centre is (p, q) with
# p >= 0, its u is (ue, uf), hence its v is (-uf, ue). Its corner deepest against e lies along f at
# t = q - sign(ue) uf hl' + sign(uf) ue hw'; with an edge parallel to the face the whole stretch q +- (hw' or
# hl') is equally deep, and the witness is the middle of the part that it shares with the face.


# Input:  rectangle a, and b as a sees it.
# State:  the chosen face of a: e, half of its depth h and width w; q, ue and uf as above; t, the place along the face.
# Output: `out`, if these are the witnesses.
def edge_witness(a, seen, out):
    """Fill out for the face of a with the largest gap; False if the rectangles are apart and corners are nearest."""
    gap = fabs(seen.along) - seen.hl - (fabs(seen.c) * seen.other_hl + fabs(seen.s) * seen.other_hw)
    sideways = fabs(seen.left) - seen.hw - (fabs(seen.s) * seen.other_hl + fabs(seen.c) * seen.other_hw)
    side = side_of(seen.along)
    ex = side * a.ux
    ey = side * a.uy
    q = side * seen.left
    ue = side * seen.c
    uf = side * seen.s
    h = seen.hl
    w = seen.hw
    edge = FRONT if side > 0.0 else REAR
    if sideways > gap:
        gap = sideways
        side = side_of(seen.left)
        ex = -side * a.uy
        ey = side * a.ux
        q = -side * seen.along
        ue = side * seen.s
        uf = -side * seen.c
        h = seen.hw
        w = seen.hl
        edge = LEFT if side > 0.0 else RIGHT
    if fabs(uf) <= PARALLEL_SINE or fabs(ue) <= PARALLEL_SINE:
        half = seen.other_hl
        other_feature = LEFT if uf > 0.0 else RIGHT
        if fabs(uf) <= PARALLEL_SINE:
            half = seen.other_hw
            other_feature = REAR if ue > 0.0 else FRONT
        low = q - half if q - half > -w else -w
        high = q + half if q + half < w else w
        if gap > 0.0 and low > high:
            return False
        t = 0.5 * (low + high)
    else:
        other_feature = corner_at(-ue, uf)
        t = q - side_of(ue) * uf * seen.other_hl + side_of(uf) * ue * seen.other_hw
        if fabs(t) > w:
            if gap > 0.0:
                return False
            t = w if t > 0.0 else -w
    out.separation = gap
    out.ax = a.x + (h * ex - t * ey)
    out.ay = a.y + (h * ey + t * ex)
    out.bx = a.x + ((h + gap) * ex - t * ey)
    out.by = a.y + ((h + gap) * ey + t * ex)
    out.nx = ex
    out.ny = ey
    out.feature_a = edge
    out.feature_b = other_feature
    return True


# Input:  as for edge_witness().
# State:  the nearest corner (px, py) of b so far, in the frame of a, and its squared distance `least`; afterwards the
#         point of a that is nearest to it.
# Output: `out`.
def corner_witness(a, seen, out):
    """Fill out for the corner of the other that is nearest to a."""
    px = py = least = 0.0
    for k in range(4):
        l_side = seen.other_hl if k < REAR_RIGHT else -seen.other_hl
        w_side = seen.other_hw if k == FRONT_LEFT or k == REAR_LEFT else -seen.other_hw
        cx = seen.along + seen.c * l_side - seen.s * w_side
        cy = seen.left + seen.s * l_side + seen.c * w_side
        squared = point_gap_squared(cx, cy, seen.hl, seen.hw)
        if k == 0 or squared < least:
            least = squared
            px = cx
            py = cy
            out.feature_b = k
    side_x = side_of(px)
    side_y = side_of(py)
    beyond_x = fabs(px) - seen.hl
    beyond_y = fabs(py) - seen.hw
    gap = sqrt(least)
    out.feature_a = corner_at(px, py)
    if beyond_x > 0.0 and beyond_y > 0.0:
        nx = side_x * beyond_x / gap
        ny = side_y * beyond_y / gap
        px = side_x * seen.hl
        py = side_y * seen.hw
    elif beyond_x >= beyond_y:
        gap = beyond_x
        nx = side_x
        ny = 0.0
        px = side_x * seen.hl
        out.feature_a = FRONT if side_x > 0.0 else REAR
    else:
        gap = beyond_y
        nx = 0.0
        ny = side_y
        py = side_y * seen.hw
        out.feature_a = LEFT if side_y > 0.0 else RIGHT
    out.separation = gap
    out.ax = a.x + (px * a.ux - py * a.uy)
    out.ay = a.y + (px * a.uy + py * a.ux)
    out.bx = a.x + ((px + gap * nx) * a.ux - (py + gap * ny) * a.uy)
    out.by = a.y + ((px + gap * nx) * a.uy + (py + gap * ny) * a.ux)
    out.nx = nx * a.ux - ny * a.uy
    out.ny = nx * a.uy + ny * a.ux


def framed(frames, i):
    """The rectangle in row i of frames, whose columns are FRAME_X to FRAME_HALF_WIDTH."""
    return Rectangle(
        frames[i, FRAME_X], frames[i, FRAME_Y], frames[i, FRAME_UX], frames[i, FRAME_UY],
        frames[i, FRAME_HALF_LENGTH], frames[i, FRAME_HALF_WIDTH],
    )  # fmt: skip


def rows_gap_within(i, j, limit, frames):
    """pair_gap_within() of rows i and j of frames [m]: other modules call this once instead of three functions."""
    return pair_gap_within(framed(frames, i), framed(frames, j), limit)


def bench_of(i, sizes, chain):
    """The rectangle of bench i of a chain."""
    return Rectangle(
        chain[i, MX], chain[i, MY], chain[i, UX], chain[i, UY], sizes[i, HALF_LENGTH], sizes[i, HALF_WIDTH]
    )


def bench_gap_within(i, j, limit, sizes, chain):
    """pair_gap_within() of benches i and j of a chain [m]. limit: NO_LIMIT for the separation in any case"""
    return pair_gap_within(bench_of(i, sizes, chain), bench_of(j, sizes, chain), limit)


def row_separation(i, j, sizes, chain, out):
    """pair_separation() of benches i and j of a chain."""
    pair_separation(bench_of(i, sizes, chain), bench_of(j, sizes, chain), out)


def bench_separation(a, b, sizes, chain):
    """Separation of benches a and b of a chain, with its witnesses."""
    out = Witnesses()
    row_separation(a, b, sizes, chain, out)
    return out


def pair_separations(a, b, out):
    """pair_separation() row by row. a, b: (n, FRAME_COLUMNS); out: (n, SEPARATION_COLUMNS) SEPARATION to FEATURE_B."""
    met = Witnesses()
    with cython.nogil:
        for i in range(a.shape[0]):
            pair_separation(framed(a, i), framed(b, i), met)
            out[i, SEPARATION] = met.separation
            out[i, WITNESS_AX] = met.ax
            out[i, WITNESS_AY] = met.ay
            out[i, WITNESS_BX] = met.bx
            out[i, WITNESS_BY] = met.by
            out[i, NORMAL_X] = met.nx
            out[i, NORMAL_Y] = met.ny
            out[i, FEATURE_A] = met.feature_a
            out[i, FEATURE_B] = met.feature_b


def pair_gaps(a, b, limit, out):
    """pair_gap_within() row by row. a, b: (n, FRAME_COLUMNS); out: (n,)"""
    with cython.nogil:
        for i in range(a.shape[0]):
            out[i] = pair_gap_within(framed(a, i), framed(b, i), limit)
