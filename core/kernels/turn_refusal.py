"""Turns that no bench can dance, by boxes: one bench that cannot follow, or a place where the path meets itself."""

import cython
from cython.cimports.libc.math import cos, fabs, sin, sqrt

if not cython.compiled:  # the .pxd imports the same names for the compiler
    from core.kernels.constants import *
    from core.kernels.spiral import spiral_arc, spiral_curvature, spiral_theta

# A box holds turns of two tangent arcs between two coils (core/paths/turn.py); one of them is the nominal one. s = 0 is
# the tangent point M of both arcs, and the frame is that of M: the x axis is the direction of travel there. So a half
# of a turn, from M on or back, is an arc and its coil, which both bend to one side, and depends on the radius of the
# arc, its length and the radius at which the coil begins alone.
#
# How far the turns of a box differ. For x metres from M let H(x) bound the integral of the difference of the curvatures
# from 0 to x. Directions differ by at most H(x), points by at most its integral. On the arcs the difference is that of
# 1 / r; where one turn is on its arc and the other on its coil, at most the larger curvature, over at most the
# difference of the arc's lengths; on the coils at most COIL_SLOPE / r^2 times the difference of the radii at one x,
# which is that of the coils' beginnings and growth / r of that of the arcs' lengths (core/design/turn_moves.py), and at
# most that itself; and with t = r / growth, |dk / dr| growth^2 = t (t^2 + 4) (1 + t^2)^(-5/2) is less than COIL_MOST.
# Beyond both arcs also: directions differ by the difference of the arcs' angles, and of the coils; the ends of the
# arcs, r (sin a, 1 - cos a), by at most 2 dr + r da, points beyond by the difference of the arcs' lengths more and by
# the directions times the way. Points never differ by more than 2 for each metre.
#
# A bench that cannot follow. f(s) is the rear handle's place with the front handle at s: the largest r < s at the
# distance of the chord c (follower.py). Every bench passes all places. No turn of the box can be danced if
#   stuck: for some s, f(s) is in [low, high] in all turns, because all places from high to s are nearer than c, and low
#       is as far; and on this interval, in all turns, either u . T at the rear handle is `least` or less everywhere, or
#       u . T at the front handle is 0 or less: such a bench stands across the path, or would go backwards;
#   jump: for some r, the first s ahead at the distance c is in [low, high] in all turns, because all places from r to
#       low are nearer than c, and high is as far; and a place between r and low is further than c from all of [low,
#       high]. f moves from below r to above it without jumps, so it is r at some s, at the distance c and not before
#       that first one; and at that one a nearer place is as far as c, so f was above r already.
# That all places between two are nearer than c is shown by steps: a distance changes by at most 1 for each metre.
#
# A path that meets itself. One handle of a bench stands at p, and |P(p) - P(o)| is d or less in all turns, with o on a
# coil, and both handles of every bench over o too. The chord of the bench over o is at most k l^2 / 8 from P(o), where
# k bounds the curvature there and l = c / sqrt(1 - (k c / 2)^2) is more than the longest way under its chord, 2 asin(k
# c / 2) / k (Schur: a curve that bends less than a circle has the longer chord). The first bench holds the points
# within the least of half its width and its overhang of its handle; that one those within half its width of its chord.
# So they overlap if d + k l^2 / 8 is less than both together. That bench is neither the first one nor its neighbour:
# the other handle of the first is enclosed as above, and a place between it and o is further from it than the
# neighbour's chord. The first bench is the head with its front handle at p, and o is on the coil inwards; or it is one
# far behind with its rear handle at p, and o is on the coil outwards: where a bench follows, its front handle is at the
# first place ahead.
COIL_SLOPE, COIL_MOST = 1.2, 1.3
# Rounding of points and distances [m]: they are below 1e3 m.
SPARE = 1e-9
# Most steps of a proof that places are near; its last step over the chord [1].
STEPS, LAST_STEP = 80, 1e-5
# Number of tried places of a handle, of tried places between, of halvings of the best place.
PLACES, BETWEEN, HALVINGS = 40, 24, 8
# Number of parts of such a stretch that are looked at one by one.
PARTS = 6
# Longest stretch over the chord in which a handle's place is enclosed [1].
ENCLOSED = 0.8
# Furthest that front handles are tried beyond M, and rear ones behind the entry, over the chord [1].
BEYOND = 1.6
# Longest way along the path that is looked at for a handle, over the chord [1].
FURTHEST = 4.0
# Most by which points of turns of a box may differ for a search, over the chord [1].
MOVES_MOST = 0.4
# A proof is looked for that would hold if points differed by this part as much; then smaller boxes have it [1].
AHEAD = 0.25
# Least cosine, sine or distance over the chord that is looked for: others are better, less proofs hold on smaller
# boxes.
DEEP = -0.1
# Calls after which one is looked for again, where there was none, and where one was found.
AGAIN, UNTIL = 3.0, 6.0
NO_PROOF, BLOCKED, LEAPS, MEETS = 0, 1, 2, 3


class TurnBox:
    """The turns of a box, taken from a row of TURN_BOX columns, and the proofs that none of them can be danced.

    growth: of the coils [m/rad]; least: least u . T at a rear handle that counts as followable [1]
    work: places computed so far [1]
    """

    def __init__(self, growth, least):
        self.growth = growth
        self.least = least
        self.work = 0.0
        self.scale = 1.0
        self.radius = [0.0] * 2
        self.begin = [0.0] * 2
        self.bend = [0.0] * 2
        self.low = [0.0] * 2
        self.high = [0.0] * 2
        self.longer = [0.0] * 2
        self.coil = [0.0] * 2
        self.inner = [0.0] * 2
        self.sharpest = [0.0] * 2
        self.curved = [0.0] * 2
        self.spread = [0.0] * 2
        self.unlike = [0.0] * 2
        self.past = [0.0] * 2
        self.end = [0.0] * 2
        self.theta = [0.0] * 2
        self.arc = [0.0] * 2
        self.cosine = [0.0] * 2
        self.sine = [0.0] * 2
        self.x = [0.0] * 2
        self.y = [0.0] * 2

    def take(self, rows, n):
        """Begin with box n."""
        for k in range(2):
            self.radius[k] = rows[n, TURN_RADIUS + k]
            self.begin[k] = rows[n, TURN_RADIUS + k] * rows[n, TURN_ANGLE + k]
            self.bend[k] = rows[n, TURN_BEND + k]
            self.low[k] = rows[n, TURN_LOW + k]
            self.high[k] = rows[n, TURN_HIGH + k]
            self.longer[k] = rows[n, TURN_LONGER + k]
            self.coil[k] = rows[n, TURN_COIL + k]
            inner = self.coil[k] - rows[n, TURN_COIL_LESS + k]
            self.inner[k] = inner
            self.curved[k] = spiral_curvature(inner / self.growth) / self.growth
            self.sharpest[k] = max(rows[n, TURN_SHARPEST + k], self.curved[k])
            self.spread[k] = rows[n, TURN_COIL_LESS + k] + self.longer[k] * min(self.growth / inner, 1.0)
            self.unlike[k] = self.spread[k] * min(COIL_SLOPE / (inner * inner), COIL_MOST / (self.growth * self.growth))
            self.past[k] = rows[n, TURN_FURTHER + k] + self.longer[k] * self.curved[k]
            wide = 2.0 * rows[n, TURN_WIDER + k] + self.radius[k] * rows[n, TURN_FURTHER + k]
            self.end[k] = wide + self.longer[k]
            theta = self.coil[k] / self.growth
            angle = rows[n, TURN_ANGLE + k]
            size = sqrt(1.0 + theta * theta)
            self.theta[k] = theta
            self.arc[k] = spiral_arc(theta)
            # The direction outwards there is (1 + i theta) / size; it is turned into that of the arc's end.
            self.cosine[k] = (cos(angle) + theta * sin(angle)) / size
            self.sine[k] = (sin(angle) - theta * cos(angle)) / size
            self.x[k] = self.radius[k] * sin(angle)
            self.y[k] = self.radius[k] * (1.0 - cos(angle))

    def half(self, k, way):
        """Point and direction away from M, `way` metres from it on half k, which begins along the x axis."""
        self.work += 1.0
        if way <= self.begin[k]:
            turned = way / self.radius[k]
            c = cos(turned)
            s = sin(turned)
            return self.radius[k] * s, self.radius[k] * (1.0 - c), c, s
        theta = spiral_theta(self.arc[k] + (way - self.begin[k]) / self.growth)
        phi = theta - self.theta[k]
        c = cos(phi)
        s = sin(phi)
        x = self.growth * (theta * c - self.theta[k])
        y = self.growth * theta * s
        size = sqrt(1.0 + theta * theta)
        dx = (c - theta * s) / size
        dy = (s + theta * c) / size
        c = self.cosine[k]
        s = self.sine[k]
        return self.x[k] + x * c - y * s, self.y[k] + x * s + y * c, dx * c - dy * s, dx * s + dy * c

    def place(self, s):
        """Point and direction of travel at s."""
        if s >= 0.0:
            return self.half(1, s)
        x, y, tx, ty = self.half(0, -s)
        return -x, -y, tx, ty

    def turned(self, s):
        """Most by which the direction at s differs from the nominal one, in a box `scale` times as large [rad]."""
        return self.scale * self.turned_whole(s)

    def moved(self, s):
        """Most by which the point at s differs from the nominal one, in a box `scale` times as large [m]."""
        return self.scale * self.moved_whole(s)

    def bent(self, k, way):
        """The integral of the difference of the curvatures from M to `way` on half k, at most [rad]."""
        most = self.bend[k] * min(way, self.high[k])
        if way > self.low[k]:
            most += self.sharpest[k] * self.longer[k] + self.unlike[k] * (way - self.low[k])
        return most

    def turned_whole(self, s):
        """Most by which the direction at s differs from the nominal one [rad]."""
        k = 1 if s >= 0.0 else 0
        way = fabs(s)
        most = self.bent(k, way)
        if way >= self.high[k]:
            most = min(most, self.past[k] + self.unlike[k] * (way - self.low[k]))
        return most

    def carried(self, k, way, turned):
        """Most by which the point `way` from M on half k differs [m]. turned: as directions beyond the arc do [rad]"""
        near = min(way, self.low[k])
        return min(0.5 * self.bend[k] * near, 2.0) * near + (way - near) * min(turned, 2.0)

    def moved_whole(self, s):
        """Most by which the point at s differs from the nominal one [m]."""
        k = 1 if s >= 0.0 else 0
        way = fabs(s)
        most = self.carried(k, way, self.turned_whole(s))
        if way > self.low[k]:
            far = max(way, self.high[k])
            beyond = self.end[k] + (far - self.low[k]) * self.turned_whole(far if s >= 0.0 else -far)
            most = min(most, beyond + 2.0 * (far - way))
        return most

    def joint(self, k, first, last):
        """The furthest way of the places from first to last on half k that is on the arc in some turns and on the coil
        in others [m]; below 0 if there is none. Only there turned() and moved() may fall as the way grows."""
        near, far = (max(first, 0.0), last) if k == 1 else (max(-last, 0.0), -first)
        return min(far, self.high[k]) if far > self.low[k] and near < self.high[k] else -1.0

    def turned_over(self, first, last):
        """Most by which a direction at a place from first to last differs from the nominal one [rad]."""
        most = max(self.turned(first), self.turned(last))
        for k in range(2):
            way = self.joint(k, first, last)
            if way > 0.0:
                most = max(most, self.scale * self.bent(k, way))
        return most

    def moved_over(self, first, last):
        """Most by which a point at a place from first to last differs from the nominal one [m]."""
        most = max(self.moved(first), self.moved(last))
        for k in range(2):
            way = self.joint(k, first, last)
            if way > 0.0:
                most = max(most, self.scale * self.carried(k, way, self.bent(k, way)))
        return most

    def near_until(self, s, chord, sign):
        """Last of the places from s on (sign 1) or back (-1) of which all are shown to be nearer than the chord."""
        x, y, _, _ = self.place(s)
        own = self.moved(s) + SPARE
        r = s
        for i in range(STEPS):
            bx, by, _, _ = self.place(r)
            room = chord - sqrt((x - bx) * (x - bx) + (y - by) * (y - by)) - own
            slack = room - self.moved_over(min(r, r + sign * room), max(r, r + sign * room))
            if slack < LAST_STEP * chord:
                break
            r += sign * slack
            if fabs(r - s) > FURTHEST * chord:
                break
        return r

    def far_from(self, s, r, chord, sign):
        """A place beyond r that is at least a chord away from s in all turns, -FREE if there is none soon."""
        x, y, _, _ = self.place(s)
        own = self.moved(s) + SPARE
        step = LAST_STEP * chord
        while step <= ENCLOSED * chord:
            far = r + sign * step
            bx, by, _, _ = self.place(far)
            missing = chord - sqrt((x - bx) * (x - bx) + (y - by) * (y - by)) + own + self.moved(far)
            if missing <= 0.0:
                return far
            step += max(missing, 0.3 * step)
        return -FREE

    def stuck(self, s, chord):
        """Least cosine or sine by which a bench with its front handle at s may stand in some turn, over what it needs
        to follow, [1]: 0 or less if it is stuck in all; 2 if it is unknown."""
        high = self.near_until(s, chord, -1.0)
        low = self.far_from(s, high, chord, -1.0)
        if low == -FREE:
            return 2.0
        x, y, tx, ty = self.place(s)
        error = self.moved(s) + self.moved_over(low, high) + SPARE
        aslant = self.turned_over(low, high)
        across = self.turned(s)
        half = 0.5 * (high - low) / PARTS
        most = chord + high - low + error
        worst = -2.0
        for i in range(PARTS):
            r = low + (2 * i + 1) * half
            bx, by, ux, uy = self.place(r)
            k = 1 if r >= 0.0 else 0
            bend = self.sharpest[k] if fabs(r) - half < self.high[k] else self.curved[k]
            if fabs(r) < half:
                bend = max(self.sharpest[0], self.sharpest[1])
            rear = (x - bx) * ux + (y - by) * uy + half * (1.0 + bend * most) + error + most * aslant
            front = (x - bx) * tx + (y - by) * ty + half + error + most * across
            worst = max(worst, min(rear / chord - self.least, front / chord))
            if worst > 1.0:
                break
        return worst

    def jump(self, r, chord):
        """Chord less the least distance of a nearer place, over the chord, where a rear handle at r has its first front
        handle: below 0 if it must jump in all turns; 2 if it is unknown."""
        low = self.near_until(r, chord, 1.0)
        high = self.far_from(r, low, chord, 1.0)
        if high == -FREE:
            return 2.0
        half = 0.5 * (high - low) / PARTS
        error = self.moved_over(low, high) + half + SPARE
        worst = -2.0
        for i in range(PARTS):
            s = low + (2 * i + 1) * half
            worst = max(worst, chord + error - self.furthest(s, r, low))
            if worst >= 0.0:
                break
        return worst / chord

    def furthest(self, s, r, end):
        """Greatest distance that a place between r and `end` has from s at least, in all turns [m]."""
        x, y, _, _ = self.place(s)
        most = 0.0
        at = r
        step = (end - r) / BETWEEN
        for i in range(1, BETWEEN):
            bx, by, _, _ = self.place(r + i * step)
            distance = sqrt((x - bx) * (x - bx) + (y - by) * (y - by)) - self.moved(r + i * step)
            if distance > most:
                most = distance
                at = r + i * step
        for i in range(HALVINGS):
            step *= 0.5
            for sign in range(-1, 2, 2):
                bx, by, _, _ = self.place(at + sign * step)
                distance = sqrt((x - bx) * (x - bx) + (y - by) * (y - by)) - self.moved(at + sign * step)
                if distance > most:
                    most = distance
                    at += sign * step
                    break
        return most

    def meets(self, at, over, sign, benches):
        """Distance of the places of a handle and of a bench over another place, less what overlaps [m]: below 0 if the
        path meets itself there in all turns; 2 if it is unknown.

        sign: -1 if it is the head's front handle and the other bench is behind, 1 if a rear handle and it is ahead
        benches: row of refuse_turns()
        """
        k = 0 if sign < 0.0 else 1
        first = benches[k]
        chord = benches[2]
        way = fabs(over)
        if way - 1.5 * chord < self.high[k] or fabs(over - at) > benches[5]:
            return 2.0
        radius = self.growth * spiral_theta(self.arc[k] + (way - 1.5 * chord - self.begin[k]) / self.growth)
        radius -= self.spread[k]
        if radius <= 0.5 * chord:
            return 2.0
        bend = spiral_curvature(radius / self.growth) / self.growth
        half = 0.5 * bend * chord
        if half >= 0.74:  # so that its way is less than 1.5 chords
            return 2.0
        x, y, _, _ = self.place(at)
        bx, by, _, _ = self.place(over)
        distance = sqrt((x - bx) * (x - bx) + (y - by) * (y - by)) + self.moved(at) + self.moved(over) + SPARE
        excess = distance + 0.125 * bend * chord * chord / (1.0 - half * half) - benches[3 + k]
        if excess >= 0.0:
            return excess
        low = self.near_until(at, first, sign)
        high = self.far_from(at, low, first, sign)
        if high == -FREE or (over - high) * sign <= 0.0:
            return 2.0
        x, y, _, _ = self.place(0.5 * (low + high))
        own = 0.5 * fabs(high - low) + self.moved_over(min(low, high), max(low, high)) + SPARE
        for i in range(1, BETWEEN):
            between = high + (over - high) * i / BETWEEN
            bx, by, _, _ = self.place(between)
            if sqrt((x - bx) * (x - bx) + (y - by) * (y - by)) - own - self.moved(between) >= chord:
                return excess
        return 2.0

    def meeting(self, sign, benches):
        """Two places at which meets() is below 0; the first is FREE if none was found."""
        other = 0 if sign < 0.0 else 1
        own = 1 - other
        step = (self.begin[own] + 2.0 * benches[2]) / PLACES
        around = TWO_PI * (self.coil[0] + self.coil[1])
        near = self.high[other] + 1.5 * benches[2]
        for i in range(PLACES):
            at = -sign * (i + 0.5) * step
            way = near
            while way < near + around:
                distance = self.between(at, sign * way)
                if distance < step:
                    place, over = self.nearest(at, sign * way, 0.5 * step)
                    if self.meets(place, over, sign, benches) < 0.0:
                        return place, over
                way += max(0.7 * distance, step)
        return FREE, FREE

    def between(self, s, r):
        """Distance of two places in the nominal turn [m]."""
        x, y, _, _ = self.place(s)
        bx, by, _, _ = self.place(r)
        return sqrt((x - bx) * (x - bx) + (y - by) * (y - by))

    def nearest(self, s, r, step):
        """Two places nearby that are nearer to each other."""
        least = self.between(s, r)
        for i in range(HALVINGS):
            for sign in range(-1, 2, 2):
                distance = self.between(s + sign * step, r)
                if distance < least:
                    least = distance
                    s += sign * step
                distance = self.between(s, r + sign * step)
                if distance < least:
                    least = distance
                    r += sign * step
            step *= 0.6
        return s, r


def refuse_turns(boxes, chords, benches, hints, box):
    """Which boxes hold no turn that can be danced: their kind of proof in `hints` is above NO_PROOF.

    boxes: (N, TURN_BOX); chords: (K,) of the kinds of benches [m]; benches: chords of the head and of the last bench,
    the longest chord behind the head, what overlaps where the head or the last bench meets another one, and the way
    that the dragon covers at least [m]
    hints: (N, PROOF_COLUMNS) of the proof of a larger box, and of its own; kinds are negative where smaller boxes may
    have one
    """
    for n in range(boxes.shape[0]):
        box.take(boxes, n)
        if hints[n, PROOF_KIND] and holds(box, chords, benches, hints, n):
            hints[n, PROOF_KIND] = fabs(hints[n, PROOF_KIND])
        elif hints[n, PROOF_WAIT] > 0.0:
            hints[n, PROOF_WAIT] -= 1.0
            hints[n, PROOF_KIND] = -fabs(hints[n, PROOF_KIND])
        else:
            box.scale = AHEAD
            is_found = search(box, chords, benches, hints, n)
            box.scale = 1.0
            hints[n, PROOF_WAIT] = AGAIN
            if is_found and not holds(box, chords, benches, hints, n):
                hints[n, PROOF_KIND] = -hints[n, PROOF_KIND]
                hints[n, PROOF_WAIT] = UNTIL


def holds(box, chords, benches, hints, n):
    """Whether the proof that is remembered of box n is one."""
    kind = cython.cast(cython.Py_ssize_t, fabs(hints[n, PROOF_KIND]))
    if kind == BLOCKED:
        return box.stuck(hints[n, PROOF_AT], chords[cython.cast(cython.Py_ssize_t, hints[n, PROOF_OF])]) <= 0.0
    if kind == LEAPS:
        return box.jump(hints[n, PROOF_AT], chords[cython.cast(cython.Py_ssize_t, hints[n, PROOF_OF])]) < 0.0
    return box.meets(hints[n, PROOF_AT], hints[n, PROOF_OVER], hints[n, PROOF_OF], benches) < 0.0


def search(box, chords, benches, hints, n):
    """Whether a proof for box n was found, in its hints."""
    hints[n, PROOF_KIND] = NO_PROOF
    best = 2.0
    for k in range(chords.shape[0]):
        chord = chords[k]
        if box.moved(-box.begin[0] - 0.5 * chord) + box.moved(box.begin[1] + 0.5 * chord) > MOVES_MOST * chord:
            continue
        at, found = least_stuck(box, chord)
        if found < best:
            best = found
            hints[n, PROOF_KIND] = BLOCKED
            hints[n, PROOF_OF] = k
            hints[n, PROOF_AT] = at
        start = -box.begin[0] - BEYOND * chord
        step = (box.begin[1] - start) / PLACES
        for i in range(PLACES):
            if best < DEEP:
                return True
            r = start + (i + 0.5) * step
            found = box.jump(r, chord)
            if found < best:
                best = found
                hints[n, PROOF_KIND] = LEAPS
                hints[n, PROOF_OF] = k
                hints[n, PROOF_AT] = r
    if best < 0.0:
        return True
    hints[n, PROOF_KIND] = NO_PROOF
    if best > 1.5:
        return False
    for sign in range(-1, 2, 2):
        at, over = box.meeting(sign, benches)
        if at < FREE:
            hints[n, PROOF_KIND] = MEETS
            hints[n, PROOF_OF] = sign
            hints[n, PROOF_AT] = at
            hints[n, PROOF_OVER] = over
            return True
    return False


def least_stuck(box, chord):
    """The place of a front handle at which TurnBox.stuck() is least, or DEEP, and its value."""
    start = -box.begin[0]
    step = (box.begin[1] + BEYOND * chord - start) / PLACES
    best = 2.0
    at = start
    for i in range(PLACES):
        s = start + (i + 0.5) * step
        found = box.stuck(s, chord)
        if found < best:
            best = found
            at = s
        if best < DEEP:
            return at, best
    step *= 0.5
    for i in range(HALVINGS):
        for sign in range(-1, 2, 2):
            found = box.stuck(at + sign * step, chord)
            if found < best:
                best = found
                at += sign * step
                break
        if best < DEEP:
            break
        step *= 0.5
    return at, best
