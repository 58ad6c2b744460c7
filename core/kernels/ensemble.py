"""Several dragons in one frame: their benches at an instant, and over an interval of time that is proven for all."""

import cython
from cython.cimports.libc.math import cos, fabs, isnan, sin, sqrt

if not cython.compiled:  # the .pxd imports the same names for the compiler
    from core.kernels.chain import chain_rounding, place_chain
    from core.kernels.clearance import beyond_box, boxes_apart, least_with, meet, row_gap, speed_along
    from core.kernels.constants import *
    from core.kernels.pairs import pair_rounding, proven_gap
    from core.kernels.records import Closest

# Time. Between two changes of speed the head of member k travels at a constant speed v_k, and v_k times a derivative by
# its travel is a derivative by time. Let n be an axis fixed in bench a, X a corner of bench b, p = X - M_a: then
#     g = n . p - support of a,   |g''| <= |n''| |p| + 2 |n'| |p'| + |p''|,
#     |n'| = v_a omega_a,   |n''| <= v_a^2 (omega_a^2 + omega_a'),   |p'| <= v_a |M_a'| + v_b |X'|,
#     |p''| <= v_a^2 |M_a''| + v_b^2 |X''|,
# where ' is by time on the left, by each head's own travel on the right. That is K of gap_curvature.py for rows of
# motion whose first derivatives are multiplied by v and whose second ones by v^2. So the rows of all members stand in
# one scene, in which time takes the place of the travel, and the functions on pairs of benches serve unchanged.
#
# Turning frame. The second bound of gap_curvature.py asks of the two benches only that radii and senses of rotation
# are about one centre: for any two points P and Q and any constant C, the terms of P - Q are those of P - C less those
# of Q - C. So it serves between members on spirals that share their centre and their sense (`turns`). The radii of
# their handles and the curvatures there are scaled to the growth of the scene, which is the largest: a tangent leans
# by at most growth / r. All others have OMEGA_LOW = 0, for which the plain bound serves.
#
# Places. A chain on a spiral has its head at polar angle 0. A member's row is turned by its head's angle, then
# mirrored and turned and moved as its path is: the product of the two rotations has entries good to 9 u, and a
# coordinate, with the sum of two products and of the centre, to 12 u (|x| + |y|) + u |X|. TURNED and MOVED exceed both
# coordinates' errors together.
#
# Rounding. The time of an instant is exact; the head of member k then truly is within `slip` of its computed place,
# along the path. That is the SLIP of handle 0, from which rounding.py derives those of all others with all orders: a
# displacement is passed on from link to link whatever caused it. So ERROR and SWAY hold for the true motion in time,
# and so do the bounds on motion, whose inputs they widen (bounds.py), over h = v (t_1 - t_0) + 2 slip and more.
# Numbers that are scaled here are good to a few u, for which SCALED makes room.
#
# Which pairs. The boxes around BENCHES_PER_BLOCK benches hold them over the whole interval: a centre is never further
# than half of (its speed times the interval) from its place at one of both ends. For a pair in boxes that meet, let
# d be the vector between the centres: |d''| <= the sum of both pulls =: q, so that d stays within q h^2 / 8 of the line
# between its values at both ends. If that line keeps further from 0 than both radii, the margin and q h^2 / 8, the
# benches keep apart. Blocks of two members on spirals of one growth, centre and sense are skipped where both keep
# outside the radius from which spirals_least() exceeds the margin.
TURNED = 32.0 * ULP
MOVED = 4.0 * ULP
SCALED = 1e-9
BENCHES_PER_BLOCK = 8
# Columns of a block: its first row, the row after its last, its member, and the first block of the next member.
BLOCK_FIRST, BLOCK_END, BLOCK_MEMBER, BLOCK_NEXT = range(4)
# Column of a box after Y_HIGH: a radius outside which the front handles of its benches stay [m].
BOX_INNER = 4
# The chains of a member and of the ensemble: at both ends of the interval, and at another instant.
BEFORE, AFTER, PROBED = range(3)
# Least K by which a width is divided [m/s^2].
LEAST_CURVATURE = 1e-30


class Member:
    """One dragon of an ensemble.

    interval: of its own head's travel, in the own frame of its path; probed: a third chain of the same rows
    first: row of its head among all; benches: their number; it has one row more, of its last handle
    x, y: place of the origin of its path [m]; ux, uy: direction of the x axis there; side: -1.0 for a mirror image
    turns: whether it is on a spiral whose centre and sense it shares with others
    """

    def __init__(self, interval, probed, first, benches, place, turns):
        self.interval = interval
        self.probed = probed
        self.first = first
        self.benches = benches
        self.x, self.y, self.ux, self.uy, self.side = place
        self.turns = turns

    def own(self, which):
        """The chain in the own frame."""
        if which == BEFORE:
            return self.interval.before
        return self.interval.after if which == AFTER else self.probed

    def lay(self, scene, place, slip, last, own):
        """Lay out a chain of the member's scene with the head at a place; False if a bench folds."""
        if place_chain(scene.curve, place, last, scene.sizes, own) == FOLDED:
            return False
        own[0, SLIP] = slip
        chain_rounding(scene.curve, last, scene.sizes, own)
        return True

    def put(self, speed, last, own, rows):
        """Fill in the rows of all from a chain, up to handle `last`; speed: of the head [m/s]"""
        c = 1.0
        s = 0.0
        if self.interval.scene.curve.is_spiral:
            c = cos(own[0, THETA])
            s = sin(own[0, THETA])
        xx = self.ux * c - self.side * self.uy * s
        xy = -self.ux * s - self.side * self.uy * c
        yx = self.uy * c + self.side * self.ux * s
        yy = self.side * self.ux * c - self.uy * s
        for k in range(last + 1):
            row = self.first + k
            rows[row, RATE] = speed * own[k, RATE]
            rows[row, TX] = xx * own[k, TX] + xy * own[k, TY]
            rows[row, TY] = yx * own[k, TX] + yy * own[k, TY]
            if k < last:
                rows[row, MX] = self.x + (xx * own[k, MX] + xy * own[k, MY])
                rows[row, MY] = self.y + (yx * own[k, MX] + yy * own[k, MY])
                rows[row, UX] = xx * own[k, UX] + xy * own[k, UY]
                rows[row, UY] = yx * own[k, UX] + yy * own[k, UY]
                error = TURNED * (fabs(own[k, MX]) + fabs(own[k, MY]))
                rows[row, ERROR] = own[k, ERROR] + error + MOVED * (fabs(rows[row, MX]) + fabs(rows[row, MY]))
                rows[row, SWAY] = own[k, SWAY] + TURNED * (fabs(own[k, UX]) + fabs(own[k, UY]))

    def still(self, growth, own, motion):
        """Fill in the rows of a member that stands: no motion, and on a spiral a radius for each."""
        motion[self.first : self.first + self.benches + 1] = 0.0
        for k in range(self.benches if self.turns else 0):
            radius = self.interval.scene.curve.growth * own[k, THETA] - own[k, SLIP]
            motion[self.first + k, THETA_LOW] = radius * (1.0 - SCALED) / growth

    def scale(self, growth, speed, motion):
        """Fill in the bounds on the motion in time, from those on the motion along the path.

        growth: of the scene [m/rad]; speed: of the head [m/s]
        """
        own: cython.double[:, ::1] = self.interval.motion
        before: cython.double[:, ::1] = self.interval.before
        after: cython.double[:, ::1] = self.interval.after
        first_order = speed * (1.0 + SCALED)
        second_order = speed * speed * (1.0 + SCALED)
        own_growth = self.interval.scene.curve.growth
        for k in range(self.benches + 1):
            row = self.first + k
            motion[row, RATE_HIGH] = first_order * own[k, RATE_HIGH]
            motion[row, RATE_RATE] = second_order * own[k, RATE_RATE]
            motion[row, RATE_LOW] = motion[row, OMEGA_LOW] = motion[row, THETA_LOW] = 0.0
            if self.turns and own[k, RATE_LOW] > 0.0:
                slip = max(before[k, SLIP], after[k, SLIP])
                motion[row, RATE_LOW] = speed * (1.0 - SCALED) * own[k, RATE_LOW]
                motion[row, THETA_LOW] = (own_growth * own[k, THETA_LOW] - slip) * (1.0 - SCALED) / growth
                motion[row, THETA_HIGH] = (own_growth * own[k, THETA_HIGH] + slip) * (1.0 + SCALED) / growth
                motion[row, CURVATURE_LOW] = own[k, CURVATURE_LOW] * (1.0 - SCALED) * growth / own_growth
                motion[row, CURVATURE_HIGH] = own[k, CURVATURE_HIGH] * (1.0 + SCALED) * growth / own_growth
            if k < self.benches:
                if self.turns:
                    motion[row, OMEGA_LOW] = speed * (1.0 - SCALED) * own[k, OMEGA_LOW]
                motion[row, CENTRE_SPEED] = first_order * own[k, CENTRE_SPEED]
                motion[row, CORNER_SPEED] = first_order * own[k, CORNER_SPEED]
                motion[row, HANDLE_SPEED] = first_order * own[k, HANDLE_SPEED]
                motion[row, OMEGA] = first_order * own[k, OMEGA]
                motion[row, CENTRE_PULL] = second_order * own[k, CENTRE_PULL]
                motion[row, CORNER_PULL] = second_order * own[k, CORNER_PULL]
                motion[row, OMEGA_PULL] = second_order * own[k, OMEGA_PULL]
                motion[row, OMEGA_RATE] = second_order * own[k, OMEGA_RATE]


class Ensemble:
    """The benches of several dragons over an interval of time.

    interval: of time, with the rows of all members; probed: a third chain of these rows
    members: see Member; blocks: (B, 4) of the columns above; scratch: boxes (B, 5) of these, and (rows, 4) of rows
    clear: (members, members) radii outside which two members keep apart [m], FREE where there is none
    after bound(): least, a proven lower bound of the gaps of all pairs of benches of two members [m], FREE if none is
        near, NO_BOUND if the interval is too long; curvature, first, second: its K [m/s^2] and its pair; width: the
        longest interval for which the same bounds would have proven all pairs [s]
    after nearest(): gap [m] and first, second
    tried: pairs that were near enough to be tried
    """

    def __init__(self, interval, probed, members, blocks, scratch, clear):
        self.interval = interval
        self.probed = probed
        self.members = members
        self.blocks = blocks
        self.boxes, self.spans = scratch
        self.clear = clear
        self.least = self.curvature = self.width = self.gap = 0.0
        self.first = self.second = self.tried = 0

    def rows(self, which):
        """The rows of all members at one of the three instants."""
        if which == BEFORE:
            return self.interval.before
        return self.interval.after if which == AFTER else self.probed

    def stand(self, k, which, place, slip, speed, last):
        """Lay out member k with its head at a place, up to handle `last`; False if a bench folds.

        slip: largest distance of the head from that place [m]; speed: of the head [m/s]
        """
        member: Member = self.members[k]
        with cython.nogil:
            own: cython.double[:, ::1] = member.own(which)
            laid = member.lay(member.interval.scene, place, slip, last, own)
            if laid:
                member.put(speed, last, own, self.rows(which))
        return laid

    def rest(self, k):
        """Let member k stand over the interval as it does before it."""
        member: Member = self.members[k]
        with cython.nogil:
            end = member.first + member.benches + 1
            member.interval.after[:] = member.interval.before
            self.interval.after[member.first : end] = self.interval.before[member.first : end]
            member.still(self.interval.scene.curve.growth, member.interval.before, self.interval.motion)

    def move(self, k, h, speed):
        """Bound the motion of member k over the interval; False where no bound is known.

        h: upper bound of the way of its head [m]; speed: of that [m/s]
        """
        member: Member = self.members[k]
        with cython.nogil:
            member.interval.h = h
            member.interval.handles = member.benches
            bounded = member.interval.bound(False)
            if bounded:
                member.scale(self.interval.scene.curve.growth, speed, self.interval.motion)
        return bounded

    def advance(self):
        """Go on at the end of the interval."""
        self.interval.swap()
        for member in self.members:
            cython.cast(Member, member).interval.swap()

    def bound(self, h):
        """Bound the gaps of all pairs of benches of two members over the interval. h: its length [s]"""
        with cython.nogil:
            self.interval.h = h
            self.bound_pairs(self.interval.scene)

    # Input:  the rows of all at both ends, with bounds on their motion.
    # State:  the least bound so far; `width`, the longest interval that the pairs so far allow.
    # Output: the attributes that bound() fills.
    def bound_pairs(self, scene):
        """Body of bound()."""
        before: cython.double[:, ::1] = self.interval.before
        after: cython.double[:, ::1] = self.interval.after
        motion: cython.double[:, ::1] = self.interval.motion
        spans: cython.double[:, ::1] = self.spans
        boxes: cython.double[:, ::1] = self.boxes
        h = self.interval.h
        self.least = self.width = FREE
        self.curvature = 0.0
        self.first = self.second = self.tried = 0
        self.lay_boxes(before, after, motion, spans, boxes)
        within = scene.margin * (1.0 + 1e-12)
        for a in range(self.blocks.shape[0]):
            if scene.budget.stopped:
                self.least = NO_BOUND
                return
            for b in range(self.blocks[a, BLOCK_NEXT], self.blocks.shape[0]):
                if spans_apart(a, boxes, b, boxes, within) or self.rings_clear(a, b):
                    continue
                for i in range(self.blocks[a, BLOCK_FIRST], self.blocks[a, BLOCK_END]):
                    if spans_apart(i, spans, b, boxes, within):
                        continue
                    for j in range(self.blocks[b, BLOCK_FIRST], self.blocks[b, BLOCK_END]):
                        if not spans_apart(i, spans, j, spans, within):
                            if not stay_apart(scene, i, j, h, before, after, motion):
                                self.bound_pair(scene, i, j)
                if self.least == NO_BOUND:
                    return

    def bound_pair(self, scene, i, j):
        """Take one pair into the bounds."""
        h = self.interval.h
        self.tried += 1
        gap, k = proven_gap(scene, self.interval, i, j, self.centres_apart(scene, i, j), FREE)
        if isnan(gap):
            self.least = NO_BOUND
        width2 = 8.0 * (gap - scene.margin) / max(k, LEAST_CURVATURE) + h * h
        self.width = min(self.width, sqrt(width2) if width2 > 0.0 else 0.0)
        if gap < self.least:
            self.least = gap
            self.curvature = k
            self.first = i
            self.second = j

    def centres_apart(self, scene, i, j):
        """Upper bound of the distance between the centres of two rows over the interval [m]."""
        dx = self.interval.before[j, MX] - self.interval.before[i, MX]
        dy = self.interval.before[j, MY] - self.interval.before[i, MY]
        ex = self.interval.after[j, MX] - self.interval.after[i, MX]
        ey = self.interval.after[j, MY] - self.interval.after[i, MY]
        pull = self.interval.motion[i, CENTRE_PULL] + self.interval.motion[j, CENTRE_PULL]
        most = sqrt(max(dx * dx + dy * dy, ex * ex + ey * ey))
        return most + 0.125 * pull * self.interval.h * self.interval.h

    def lay_boxes(self, before, after, motion, spans, boxes):
        """Fill in the upright boxes that hold every bench, and those of every block, over the interval."""
        growth = self.interval.scene.curve.growth
        h = self.interval.h
        for b in range(self.blocks.shape[0]):
            empty_box(b, boxes)
            for i in range(self.blocks[b, BLOCK_FIRST], self.blocks[b, BLOCK_END]):
                error = max(before[i, ERROR], after[i, ERROR])
                spare = self.interval.scene.sizes[i, RADIUS] + 0.5 * motion[i, CENTRE_SPEED] * h
                spare = spare * (1.0 + 1e-12) + 8.0 * error
                spans[i, X_LOW] = min(before[i, MX], after[i, MX]) - spare
                spans[i, X_HIGH] = max(before[i, MX], after[i, MX]) + spare
                spans[i, Y_LOW] = min(before[i, MY], after[i, MY]) - spare
                spans[i, Y_HIGH] = max(before[i, MY], after[i, MY]) + spare
                boxes[b, X_LOW] = min(boxes[b, X_LOW], spans[i, X_LOW])
                boxes[b, X_HIGH] = max(boxes[b, X_HIGH], spans[i, X_HIGH])
                boxes[b, Y_LOW] = min(boxes[b, Y_LOW], spans[i, Y_LOW])
                boxes[b, Y_HIGH] = max(boxes[b, Y_HIGH], spans[i, Y_HIGH])
                boxes[b, BOX_INNER] = min(boxes[b, BOX_INNER], growth * motion[i, THETA_LOW])

    def rings_clear(self, a, b):
        """Whether the benches of two blocks are apart because both wind outside the radius from which all are."""
        radius = self.clear[self.blocks[a, BLOCK_MEMBER], self.blocks[b, BLOCK_MEMBER]]
        return self.boxes[a, BOX_INNER] >= radius and self.boxes[b, BOX_INNER] >= radius

    def nearest(self, which, a, b):
        """Find the nearest two benches of two members at an instant. a, b: a pair to begin with, or 0 and 0"""
        with cython.nogil:
            self.find_nearest(self.interval.scene, a, b, self.rows(which))

    # Input:  the rows of all at an instant.
    # State:  the nearest pair so far.
    # Output: the attributes that nearest() fills.
    def find_nearest(self, scene, a, b, rows):
        """Body of nearest()."""
        boxes: cython.double[:, ::1] = self.boxes
        best = Closest(row_gap(scene, a, b, rows) if a != b else FREE, a, b)
        for block in range(self.blocks.shape[0]):
            empty_box(block, boxes)
            for i in range(self.blocks[block, BLOCK_FIRST], self.blocks[block, BLOCK_END]):
                hold(block, rows[i, MX], rows[i, MY], scene.sizes[i, RADIUS], boxes)
        for block in range(self.blocks.shape[0]):
            if scene.budget.stopped:
                break
            for other in range(self.blocks[block, BLOCK_NEXT], self.blocks.shape[0]):
                if boxes_apart(block, other, max(best.gap, 0.0), boxes):
                    continue
                first = self.blocks[other, BLOCK_FIRST]
                end = self.blocks[other, BLOCK_END]
                for i in range(self.blocks[block, BLOCK_FIRST], self.blocks[block, BLOCK_END]):
                    if not beyond_box(i, other, scene.sizes[i, RADIUS] + max(best.gap, 0.0), boxes, rows):
                        best = least_with(scene, i, first, end, best, rows)
        self.gap = best.gap
        self.first = best.first
        self.second = best.second

    def separation(self, which, a, b):
        """Separation of two rows at an instant [m]."""
        return row_gap(self.interval.scene, a, b, self.rows(which))

    def rounding(self, which, a, b):
        """Largest error of that separation [m]."""
        rows: cython.double[:, ::1] = self.rows(which)
        dx = rows[b, MX] - rows[a, MX]
        dy = rows[b, MY] - rows[a, MY]
        return pair_rounding(a, b, sqrt(dx * dx + dy * dy), self.interval.scene.sizes, rows, rows)

    def rate(self, which, a, b):
        """Rate at which two rows part at an instant [m/s]."""
        with cython.nogil:
            speed = self.parting(self.interval.scene, a, b, self.rows(which))
        return float(speed)  # outside the block, which holds no objects

    def parting(self, scene, a, b, rows):
        """Body of rate()."""
        meet(scene, a, b, rows)
        speed = speed_along(scene, b, scene.met.bx, scene.met.by, rows)
        return speed - speed_along(scene, a, scene.met.ax, scene.met.ay, rows)

    def left(self, moved):
        """Lower bound of the gaps of all pairs at the start of the interval, less the ways of both benches [m].

        moved: (rows,) the largest way of any point of each bench [m]
        """
        with cython.nogil:
            least = self.least_left(self.interval.scene, moved)
        return float(least)  # outside the block, which holds no objects

    def least_left(self, scene, moved):
        """Body of left()."""
        rows: cython.double[:, ::1] = self.interval.before
        least = FREE
        for a in range(self.blocks.shape[0]):
            empty_box(a, self.boxes)
            for i in range(self.blocks[a, BLOCK_FIRST], self.blocks[a, BLOCK_END]):
                reach = (scene.sizes[i, RADIUS] + moved[i]) * (1.0 + 1e-12) + 8.0 * rows[i, ERROR]
                hold(a, rows[i, MX], rows[i, MY], reach, self.boxes)
        within = scene.margin * (1.0 + 1e-12)
        for a in range(self.blocks.shape[0]):
            for b in range(self.blocks[a, BLOCK_NEXT], self.blocks.shape[0]):
                if boxes_apart(a, b, within, self.boxes):
                    continue
                for i in range(self.blocks[a, BLOCK_FIRST], self.blocks[a, BLOCK_END]):
                    for j in range(self.blocks[b, BLOCK_FIRST], self.blocks[b, BLOCK_END]):
                        gap = row_gap(scene, i, j, rows) - moved[i] - moved[j]
                        least = min(least, gap - self.rounding(BEFORE, i, j))
        return least


def spans_apart(a, boxes, b, other, within):
    """Whether row a of some boxes and row b of others are further apart than `within` along an axis [m]."""
    return (
        boxes[a, X_LOW] - other[b, X_HIGH] > within
        or other[b, X_LOW] - boxes[a, X_HIGH] > within
        or boxes[a, Y_LOW] - other[b, Y_HIGH] > within
        or other[b, Y_LOW] - boxes[a, Y_HIGH] > within
    )


def stay_apart(scene, i, j, h, before, after, motion):
    """Whether two rows keep further apart than the margin, whatever their directions, by the way of their centres."""
    dx = before[j, MX] - before[i, MX]
    dy = before[j, MY] - before[i, MY]
    ex = after[j, MX] - after[i, MX]
    ey = after[j, MY] - after[i, MY]
    near = scene.sizes[i, RADIUS] + scene.sizes[j, RADIUS] + scene.margin
    near += 0.125 * (motion[i, CENTRE_PULL] + motion[j, CENTRE_PULL]) * h * h
    error = max(before[i, ERROR], after[i, ERROR]) + max(before[j, ERROR], after[j, ERROR])
    near = near * (1.0 + 1e-12) + 4.0 * error
    square = near * near
    if dx * dx + dy * dy <= square or ex * ex + ey * ey <= square:
        return False
    lx = ex - dx
    ly = ey - dy
    if dx * lx + dy * ly >= 0.0 or ex * lx + ey * ly <= 0.0:
        return True
    across = dx * ly - dy * lx
    return across * across > square * (lx * lx + ly * ly)


def empty_box(b, boxes):
    """Begin a box."""
    boxes[b, X_LOW] = boxes[b, Y_LOW] = boxes[b, BOX_INNER] = FREE
    boxes[b, X_HIGH] = boxes[b, Y_HIGH] = -FREE


def hold(b, x, y, spare, boxes):
    """Widen a box so that it holds everything up to a distance from a point."""
    boxes[b, X_LOW] = min(boxes[b, X_LOW], x - spare)
    boxes[b, X_HIGH] = max(boxes[b, X_HIGH], x + spare)
    boxes[b, Y_LOW] = min(boxes[b, Y_LOW], y - spare)
    boxes[b, Y_HIGH] = max(boxes[b, Y_HIGH], y + spare)
