"""Marching to first contact, by proven steps."""

import cython
from cython.cimports.libc.math import fabs

from core.kernels.results import Dip

if not cython.compiled:  # the .pxd imports the same names for the compiler
    from core.kernels.chain import extend
    from core.kernels.clearance import bottom_between, contact_between, gap_at, row_clearance, row_gap
    from core.kernels.constants import *
    from core.kernels.nearest import interval_least
    from core.kernels.pairs import pair_most
    from core.kernels.records import Closest, PairBounds
    from core.kernels.repeats import chain_between, leader_may_reverse, passed, slid_back
    from core.kernels.rings import drift
    from core.kernels.scene import MarchState

# March: conservative advancement (Mirtich, Impulse-based dynamic simulation of rigid body systems, PhD thesis, Berkeley
# 1996; for links in a row Zhang, Redon, Lee and Kim, Continuous collision detection for articulated models using Taylor
# models and temporal culling, SIGGRAPH 2007). A step is as long as a bound on the motion proves that nothing touches,
# and the steps end at the first contact, which the field calls the time of impact. The classical step is the gap over a
# bound on the speed at which it closes. Here the gap is known at both ends of a step, and its second derivative is
# bounded in between, so a step is about as long as the root of the gap.
#
# Input. A scene: a chain for every head travel, the margin, the bounds on rings; start and stop; the pairs that must be
# followed (leaders, at_start); and half the width of the bracket around a contact (half_bracket).
# State. `travel`; the interval with the chains at travel and at travel + h, up to the last handle that matters there;
# h, the step to try; `aims`, whether this step stops short of a contact, and `target`, the travel of that contact;
# `opening`, the chain at the start.
# Output. The record Marched, with how it ended: see "Ends" below.
#
# Invariant, whenever the loop begins: no two benches that share no handle come within the margin in [start, travel].
# 1. A step is taken only if interval_least() proves more than the margin, after rounding, for every pair led by the
# first `active` benches at every instant of [travel, travel + h] (nearest.py, gap_curvature.py). The proof does not
# depend on the size of the step: between two ends a gap along an axis cannot fall further below its chord than
# K x (h - x) / 2, where K is a bound over this same interval (bounds.py). So a graze cannot be stepped over: a dip
# within the interval that reached the margin would need a larger second derivative. A step that this bound does not
# prove is shortened, never taken.
# 2. Of the other pairs, those whose inner bench leads at clear_radius or further out are clear by the ring bound,
# and those whose outer bench stands beyond radius_beyond(leaders_reach()) lie outside all that the leaders can touch
# over the interval, which interval_least() checks with the handles' drift (rings.py). On a route all handles are laid
# out, except on a coil at its beginning (rings.py).
# 3. While at_start all benches are followed; afterwards only the pairs of the first `leaders` benches. The last of
# these leaders, m = leaders - 1, is the first of the benches that are alike. When handle i > m is at a place, bench i
# and all behind it stand as bench i - 1 and all behind that stood when handle i - 1 was at this place, and these
# benches are equal (family lemma, repeats.py). passed() says that every handle i has come to the place where handle i -
# 1 began. So handle i - 1 was there after the start, and clear by the invariant for i - 1, and so on down to m. This
# stays true, because no handle reverses before the one ahead of it does. A bench behind `opened` leads no pair that
# may touch, by 2, until its handle comes to a place where a predecessor has been.
# 4. Consecutive steps share a chain to the last bit, so the intervals tile the way of the true head without a gap. The
# travel is not exact to the last bit: the head of the chain at `travel` has truly travelled within `rounding` of it. So
# h, which the bounds take for the true way, is widened by twice `rounding`, and the caller begins and ends the march
# that much beyond the span that it claims.
#
# The choice of h only decides how soon a proof succeeds. It is at most twice the last step, and at most 0.95 of the
# width at which the same bounds would just have proven the pairs of the last interval. After a refused step
# it is this width if that lies between half the step and the step, else half the step.
#
# Ends.
# REACHED: travel >= stop, so the invariant is the claim.
# TOUCHED: the pair with the least bound is within the margin at the far end of a refused step. crossing() finds a
# `target` before that end (or, where steps are short already, at most PEEK beyond it) where the gap of this pair falls
# to the margin. The next step ends at target - half_bracket. If it is proven for all pairs, and the pair is within the
# margin for certain around target + half_bracket, for all true travels within `rounding` of it (pair_most()), the first
# contact of all lies between: proven = travel, touching = target + half_bracket. If travel is beyond
# target - half_bracket already, the second condition suffices. An earlier crossing, of this pair or another, makes the
# step fail and is found instead. Without a bracket (NO_BRACKET) touching is the far end itself, if the contact there is
# certain.
# TOUCHED_AT_START: the nearest pair is within the margin at the start, for certain. Where rounding hides that: STUCK.
# STUCK: h is too short to help (LEAST_STEP of the bracket, or rounding), most_work is done, the scene's budget is
# stopped, or the chain folds at the start. proven = travel still holds. touching is then a crossing of a pair that
# closes too slowly for this bracket: a wider bracket may succeed.
# CAPACITY: more handles matter than there are rows; nothing is claimed.
# graze_...: the least dip seen on the way, refined but not proven to be the least of all.

# Width to which the place of a graze is found [m]: 1e-10 s at 1 m/s.
DIP_WIDTH = 1e-10
# Shortest useful step, relative to the bracket [1].
LEAST_STEP = 0.05
# Shortest useful step without a bracket [m]: below it the way is not clear enough to be proven.
LEAST_WAY = 1e-7
# Number of drifts by which the chain is laid out further than the pose needs [1]; if they are too few, the step is
# halved.
ALLOWANCE = 2.0
# Distance ahead at which a contact is looked for whose beginning rounding hides [m]: twice the widest bracket of
# core/contact/search.py.
PEEK = 1e-4
# Width of a crossing, relative to the bracket that is proven around it [1].
CROSSING_WIDTH = 1e-3


class March(MarchState):
    """A march of a scene's head, by proven steps, until a pair comes within the margin: see the top of this file.

    interval: the chains of a step; probe: an interval to look at one pair; opening: rows for the chain at the start
    gap_curvature: the largest K that proved a step [1/m]; grazed: whether the clearance had a local minimum on the way;
        graze_...: the least of these
    """

    def __init__(self, interval, probe, opening):
        super().__init__()
        self.interval = interval
        self.probe = probe
        self.opening = opening
        self.start = self.stop = self.half_bracket = self.rounding = self.most_work = 0.0
        self.leaders = self.followers = self.active = self.placed = self.opened = 0
        self.at_start = self.opens = self.reversing = self.grazes = self.grazed = self.aims = False
        self.travel = self.h = self.target = self.allowance = 0.0
        self.floor = self.older_clearance = self.older_travel = self.last_travel = 0.0
        self.last = Closest(FREE, 0, 0)
        self.gap_curvature = self.graze_gap = self.graze_travel = 0.0
        self.graze_first = self.graze_second = 0

    def run(self, start, stop, leaders, at_start, half_bracket, grazes, rounding, most_work):
        """Advance the head from `start` to `stop` [m of travel]; returns a Marched.

        leaders: number of benches whose pairs must be followed; at_start: follow all pairs until every bench has passed
            the start of the one before it
        half_bracket: half the width of the bracket around a contact [m], or NO_BRACKET; grazes: note the least graze
        rounding: largest error of a travel [m]; most_work: work after which the march gives up
        """
        self.start = start
        self.stop = stop
        self.leaders = leaders
        self.at_start = at_start
        self.half_bracket = half_bracket
        self.grazes = grazes
        self.rounding = rounding
        self.most_work = most_work
        with cython.nogil:
            self.march(self.interval.scene)
        graze = None
        if self.grazed:
            graze = Dip(float(self.graze_gap), float(self.graze_travel), (self.graze_first, self.graze_second))
        return self.result(self.gap_curvature, graze)

    def march(self, scene):
        """Take steps to the end."""
        step = self.open(scene)
        while step != Step.ENDED and self.travel < self.stop and (self.at_start or self.repeats_ahead(scene)):
            self.proven = self.travel
            if self.work >= self.most_work or scene.budget.stopped:
                return self.end(Ended.STUCK)
            if self.h < self.rounding or self.h < self.least_step():
                return self.end(Ended.STUCK)
            self.steps += 1
            self.work += STEP_WORK
            self.h = min(self.h, self.stop - self.travel)
            step = self.try_step(scene, self.interval)
        if step != Step.ENDED:
            self.proven = self.stop
            self.end(Ended.REACHED)
        return Step.ENDED

    def repeats_ahead(self, scene):
        """Whether the head is still before rings.end_place, beyond which nothing touches (rings.py)."""
        return scene.place - self.travel > scene.rings.end_place

    def least_step(self):
        """Shortest useful step [m]."""
        return LEAST_STEP * self.half_bracket if self.half_bracket != NO_BRACKET else LEAST_WAY

    def open(self, scene):
        """Lay out the chain at the start; returns ADVANCED, or ENDED for a contact, a fold or too few rows there."""
        self.followers = scene.room if self.at_start else min(self.leaders, scene.room)
        self.opens = self.at_start and scene.curve.is_spiral
        self.allowance = CLEAR_SPARE * scene.rings.clear_radius
        if not scene.curve.is_spiral:
            self.allowance = 0.5 * PLACE_SPARE if scene.rings.clear_place < FREE else FREE
        self.travel = self.older_travel = self.last_travel = self.start
        self.h = scene.rings.shortest
        self.begin(self.start)
        self.aims = self.reversing = self.grazed = False
        self.floor = self.graze_gap = FREE
        self.older_clearance = -FREE
        self.gap_curvature = 0.0
        laid = chain_between(scene, scene.place - self.start, self.followers, self.h, False, self.interval.before)
        if laid.last == scene.room and scene.room < scene.benches:
            return self.end(Ended.CAPACITY)
        if laid.last == FOLDED:
            return self.end(Ended.STUCK)
        self.placed = laid.last
        self.opened = laid.leading if laid.leading < scene.benches else scene.benches - 1
        self.opening[: self.placed + 1] = self.interval.before[: self.placed + 1]
        self.last = row_clearance(
            scene, laid.leading, self.placed, Closest(FREE, 0, 0), self.interval.before, self.interval.motion
        )
        if self.last.gap > scene.margin:
            return Step.ADVANCED
        self.first = self.last.first
        self.second = self.last.second
        if not self.surely_within(scene, scene.place - self.start):
            return self.end(Ended.STUCK)
        self.meet(self.start)
        return self.end(Ended.TOUCHED_AT_START)

    def surely_within(self, scene, place):
        """Whether the pair `first`, `second` is within the margin with the head at a place, whatever its rounding."""
        return (
            pair_most(scene, self.probe, place + self.rounding, 2.0 * self.rounding, self.first, self.second)
            <= scene.margin
        )

    def refuse(self, part):
        """Make this part of the step the next one, without stopping short of a crossing."""
        self.h *= part
        self.aims = False
        return Step.REFUSED

    def try_step(self, scene, interval):
        """Try one step; returns ADVANCED if it is proven, ENDED at the end of the march, else REFUSED: try again."""
        outer = scene.curve.growth * interval.before[1, THETA] if scene.curve.is_spiral else 0.0
        allowance = ALLOWANCE * drift(fabs(interval.before[1, RATE]) + 1.0, self.h, scene.curve.growth, outer)
        place = scene.place - self.travel - self.h
        laid = chain_between(scene, place, self.followers, allowance, self.reversing, interval.after)
        if laid.last == scene.room and scene.room < scene.benches:
            return self.end(Ended.CAPACITY)
        if laid.last == FOLDED:
            return self.refuse(0.5)
        self.active = laid.leading
        interval.handles = laid.last
        self.work += laid.last * (1.0 + scene.edges / EDGES_PER_WORK)
        interval.widen(self.h, self.rounding)
        nearest = PairBounds(FREE, 0.0, 0, 0, FREE, 0.0, 0)
        if self.active > 0:
            if self.placed < interval.handles:
                self.placed = extend(scene.curve, self.placed, interval.handles, scene.sizes, interval.before)
            nearest = interval_least(scene, interval, self.active)
            self.work += nearest.tried
            # a bench beyond the clear radius or place might not be there
            if nearest.least == NO_BOUND or nearest.error > self.allowance:
                return self.refuse(0.5)
            if nearest.least <= scene.margin:
                return self.narrow(scene, interval, nearest)
            if scene.curve.is_spiral and self.must_follow(scene, interval):
                return Step.REFUSED
        self.travel += self.h
        self.placed = interval.handles
        interval.swap()
        if self.active > 0:
            self.gap_curvature = max(self.gap_curvature, nearest.gap_curvature)
        if self.aims and self.surely_within(scene, scene.place - self.target - self.half_bracket):
            self.proven = self.travel
            self.meet(self.target + self.half_bracket)
            return self.end(Ended.TOUCHED)
        self.aims = False
        self.note_graze(scene, interval, nearest.least)
        if self.at_start and passed(scene, self.leaders, self.opened, self.placed, self.opening, interval.before):
            self.at_start = False
            self.followers = min(self.leaders, scene.room)
        self.h = min(0.95 * nearest.width, 2.0 * self.h)
        return Step.ADVANCED

    def must_follow(self, scene, interval):
        """Whether more benches must be followed over this step, because a handle of the spiral may reverse.

        The first bench behind the leaders may come within the clear radius (`reversing`), or one may stand behind its
        own start: then all pairs are followed again.
        """
        k = self.active
        h = interval.h
        if k < self.followers and leader_may_reverse(interval, k):
            edge = scene.curve.growth * min(interval.before[k, THETA], interval.after[k, THETA])
            edge -= drift(interval.motion[k - 1, HANDLE_SPEED], h, scene.curve.growth, edge)
            if edge < scene.rings.clear_radius:
                self.refuse(0.5 if self.reversing else 1.0)
                self.reversing = True
                return True
        if self.opens and not self.at_start:
            if slid_back(scene, interval, self.leaders, self.opened, self.opening):
                self.at_start = True
                self.followers = scene.room
                self.aims = False
                return True
        return False

    def narrow(self, scene, interval, nearest):
        """After a step whose bound does not exceed the margin: look for a contact at its end, or shorten it."""
        end = self.travel + self.h
        if row_gap(scene, nearest.first, nearest.second, interval.after) > scene.margin:
            width = 0.95 * nearest.width
            self.refuse(0.5 if width < 0.5 * self.h or width >= self.h else width / self.h)
            if self.h >= self.half_bracket:
                return Step.REFUSED
            end = self.peek(scene, nearest.first, nearest.second)
            if end > self.stop:
                return Step.REFUSED
        self.first = nearest.first
        self.second = nearest.second
        if self.half_bracket == NO_BRACKET:
            if not self.surely_within(scene, scene.place - self.travel - self.h):
                self.h *= 0.5
                return Step.REFUSED
            self.meet(self.travel + self.h)
            return self.end(Ended.TOUCHED)
        width = CROSSING_WIDTH * self.half_bracket
        self.target = contact_between(scene, self.travel, end, self.first, self.second, width, self.probe.before)
        self.aims = True
        self.meet(self.target)
        way = self.target - self.half_bracket - self.travel
        if way > self.rounding and way < self.h:
            self.h = way
            return Step.REFUSED
        if self.target - self.half_bracket <= self.travel:
            if self.surely_within(scene, scene.place - self.target - self.half_bracket):
                self.meet(self.target + self.half_bracket)
                return self.end(Ended.TOUCHED)
        return self.refuse(0.5)

    def peek(self, scene, a, b):
        """A travel a little ahead at which a pair is within the margin, else FREE: rounding hides a slow contact."""
        width = 2.0 * self.half_bracket
        while width <= PEEK:
            if gap_at(scene, scene.place - self.travel - width, a, b, self.probe.before) <= scene.margin:
                return self.travel + width
            width *= 4.0
        return FREE

    def note_graze(self, scene, interval, least):
        """Note a local minimum of the clearance at the last three travels; least: the bound of the step just taken."""
        here = Closest(FREE, 0, 0)
        if self.grazes:
            if scene.kinds.some and self.last.gap < FREE:  # of hulls few are worth a look once a near pair is known
                if self.last.first < self.active and (self.last.second < interval.handles or scene.edges > 0):
                    gap = row_gap(scene, self.last.first, self.last.second, interval.before)
                    here = Closest(gap, self.last.first, self.last.second)
            here = row_clearance(scene, self.active, interval.handles, here, interval.before, interval.motion)
        lowest = least if least < self.floor else self.floor
        self.floor = least
        dips = self.older_clearance > self.last.gap <= here.gap and lowest < self.graze_gap
        if dips and here.gap < FREE and self.older_travel < self.last_travel:
            travel = bottom_between(
                scene, self.older_travel, self.travel, self.last.first, self.last.second, DIP_WIDTH, self.probe.before
            )
            gap = gap_at(scene, scene.place - travel, self.last.first, self.last.second, self.probe.before)
            if gap < self.graze_gap:
                self.grazed = True
                self.graze_gap = gap
                self.graze_travel = travel
                self.graze_first = self.last.first
                self.graze_second = self.last.second
        self.older_clearance = self.last.gap
        self.older_travel = self.last_travel
        self.last = here
        self.last_travel = self.travel
