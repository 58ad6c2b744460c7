"""Marching to first contact, by proven steps."""

import cython
from cython.cimports.libc.math import fabs

if not cython.compiled:  # for the compiler the same stands in the .pxd
    from core.kernels.chain import extend
    from core.kernels.clearance import bottom_between, contact_between, gap_at, row_clearance, row_gap
    from core.kernels.constants import *
    from core.kernels.nearest import interval_least
    from core.kernels.pairs import pair_most
    from core.kernels.records import Closest, Nearest
    from core.kernels.repeats import chain_between, may_turn, passed, slid_back
    from core.kernels.rings import drift
    from core.kernels.scene import Found

# March.
#
# Input. A scene: a chain for every head travel, the margin, the bounds on rings; start and stop; which pairs must be
# followed (leaders, at_start); and how near a contact is to be bracketed (tolerance).
# State. `travel`; the interval with the chains at travel and at travel + h, of all handles that matter there; h, the
# step to try; `aims`, whether this step stops short of a contact, and `target`, where that is; `opening`, the chain at
# the start.
# Output. One of five ends, and what is known then: see Found and March.
#
# Invariant, whenever the loop begins: no two benches that share no handle come within the margin in [start, travel].
# 1. A step is taken only if interval_least() proves more than the margin, after rounding, for every pair led by the
# first `active` benches at every instant of [travel, travel + h] (nearest.py, bends.py). The proof assumes nothing of
# the size of the step: between two ends a gap along an axis cannot fall further below its chord than K x (h - x) / 2,
# with K bounded over the very interval (bounds.py). So a graze cannot be stepped over: a dip within the interval that
# reached the margin would need a larger second derivative. Where the bound does not reach, the step is shortened, never
# taken.
# 2. Of the other pairs, those whose inner bench leads at clear_radius or further out are clear by the ring bound,
# and those whose outer bench stands beyond radius_beyond(leaders_reach()) lie outside all that the leaders can touch
# over the interval, which interval_least() checks with the handles' drift (rings.py). On a route all handles are laid
# out.
# 3. While at_start all benches are followed. Then only the pairs of the first `leaders` benches, of which the last, m =
# leaders - 1, is the first of the alike: bench i > m at a place, and all behind it, stand as bench i - 1 and all behind
# that did when handle i - 1 stood there, in the same benches (family lemma, repeats.py). passed() says that every
# handle i has come to where handle i - 1 began; so that was after the start, and clear by the invariant for i - 1, down
# to m. From there on it stays so, as no handle turns back before the one ahead does. A handle that began beyond
# `opened` is led by benches that 2 clears, until it is where a predecessor has been.
# 4. Consecutive steps share a chain to the last bit, so the intervals tile the way of the true head without a gap. What
# is not the same to the last bit is the travel: the head of the chain at `travel` has truly travelled within `rounding`
# of it. So h, which the bounds take for its true way, is widened by twice that, and the caller begins and ends the
# march beyond what it says of it by as much.
#
# How h is chosen only decides how soon a proof succeeds: at most twice the last step, and at most 0.95 of the width at
# which the same bounds would just have proven the pairs of the last interval (`room`), both after a step taken and,
# where that is a shorter one, after a step refused; else half.
#
# Ends.
# REACHED: travel >= stop, so the invariant is the claim.
# TOUCHED: the pair of the least bound is within the margin at the far end of a refused step; crossing() finds a
# `target` up to there (or, where steps are short already, up to PEEK on) where its gap falls to the margin. The next
# step ends at target - tolerance. If it is proven, for all pairs, and the pair is within the margin for certain around
# target + tolerance, for all true travels within `rounding` of it (pair_most()), the first contact of all lies between:
# proven = travel, touching = target + tolerance. If travel is beyond target - tolerance already, the second condition
# suffices. An earlier crossing, of this pair or another, makes the step fail and is found instead. Without a bracket
# (tolerance 0) touching is the far end itself, if it is certain.
# TOUCHED_AT_START: the nearest pair is within the margin at the start, for certain. Where rounding hides that: STUCK.
# STUCK: h is below what could help (LEAST_STEP of the bracket, or rounding), the budget is spent, the scene's halt is
# stopped, or the chain folds at the start. proven = travel still holds. touching is then a crossing that could not be
# bracketed this narrowly, a pair that closes slowly: a wider bracket may do.
# CAPACITY: more handles matter than there are rows; nothing is claimed.
# graze_...: what was seen on the way, refined but not proven to be the least.

# Width to which the place of a graze is found [m]: 1e-10 s at 1 m/s.
DIP_WIDTH = 1e-10
# Shortest useful step, as a part of the bracket [1].
LEAST_STEP = 0.05
# Without a bracket to reach, a step this short means that the way is not clear enough to be proven [m].
LEAST_WAY = 1e-7
# The chain is laid out so many drifts further than the pose needs; if that is too little the step is halved [1].
ALLOWANCE = 2.0
# How far ahead a contact is looked for whose beginning rounding hides [m]: the widest bracket of
# core/contact/search.py, twice.
PEEK = 1e-4
# Width of a crossing, as a part of the bracket that is proven around it [1].
CROSSING_WIDTH = 1e-3


class March(Found):
    """The head of a scene, marched by proven steps until a pair comes within the margin: see the top of this file.

    interval: the chains of a step; probe: an interval to look at a pair alone; opening: rows for the chain at the start
    bend: the largest K that proved a step [1/m]
    grazed: the clearance had a local minimum on the way; graze_gap: the least one [m]; graze_travel, graze_first,
        graze_second: where, and its pair
    """

    def __init__(self, interval, probe, opening):
        super().__init__()
        self.interval = interval
        self.probe = probe
        self.opening = opening
        self.start = self.stop = self.tolerance = self.rounding = self.budget = 0.0
        self.leaders = self.followers = self.active = self.placed = self.opened = 0
        self.at_start = self.opens = self.turning = self.grazes = self.grazed = self.aims = False
        self.travel = self.h = self.target = self.allowance = 0.0
        self.floor = self.older_clearance = self.older_travel = self.last_travel = 0.0
        self.last = Closest(FREE, 0, 0)
        self.bend = self.graze_gap = self.graze_travel = 0.0
        self.graze_first = self.graze_second = 0

    def run(self, start, stop, leaders, at_start, tolerance, grazes, rounding, budget):
        """Advance the head from `start` to `stop` [m of travel]; how that ended: REACHED to CAPACITY.

        leaders: benches whose pairs must be followed; at_start: follow all pairs until every bench has passed the start
            of the one before it
        tolerance: half width of the bracket around a contact [m], 0 for none: to end at any instant found to be within
            the margin; grazes: note the least one on the way
        rounding: what a travel may be off by [m]; budget: of work
        """
        self.start = start
        self.stop = stop
        self.leaders = leaders
        self.at_start = at_start
        self.tolerance = tolerance
        self.grazes = grazes
        self.rounding = rounding
        self.budget = budget
        with cython.nogil:
            state = self.open(self.interval.scene)
            if state != ADVANCED:
                return state
            while self.travel < stop and (self.at_start or self.repeats_ahead(self.interval.scene)):
                self.proven = self.travel
                if self.work >= budget or self.interval.scene.halt.stopped:
                    return STUCK
                if self.h < rounding or self.h < self.least_step():
                    return STUCK
                self.steps += 1
                self.work += STEP_WORK
                self.h = min(self.h, stop - self.travel)
                state = self.try_step(self.interval.scene, self.interval)
                if state != ADVANCED and state != REFUSED:
                    return state
            self.proven = stop
            return REACHED

    def repeats_ahead(self, scene):
        """May something still touch that no body repeats from further back?"""
        return scene.place - self.travel > scene.rings.end_place

    def least_step(self):
        """Shortest useful step [m]."""
        return LEAST_STEP * self.tolerance if self.tolerance > 0.0 else LEAST_WAY

    def open(self, scene):
        """Lay out the chain at the start: ADVANCED if no pair is within the margin there, else how the march ends."""
        self.followers = scene.room if self.at_start else min(self.leaders, scene.room)
        self.opens = self.at_start and scene.curve.kind == ON_SPIRAL
        self.allowance = CLEAR_SPARE * scene.rings.clear_radius
        if scene.curve.kind == ON_ROUTE:
            self.allowance = 0.5 * PLACE_SPARE if scene.rings.clear_place < FREE else FREE
        self.travel = self.older_travel = self.last_travel = self.start
        self.h = scene.rings.shortest
        self.begin(self.start)
        self.aims = self.turning = self.grazed = False
        self.floor = self.graze_gap = FREE
        self.older_clearance = -FREE
        self.bend = 0.0
        laid = chain_between(scene, scene.place - self.start, self.followers, self.h, False, self.interval.before)
        if laid.last == scene.room and scene.room < scene.benches:
            return CAPACITY
        if laid.last == FOLDED:
            return STUCK
        self.placed = laid.last
        self.opened = laid.leading if laid.leading < scene.benches else scene.benches - 1
        self.opening[: self.placed + 1] = self.interval.before[: self.placed + 1]
        self.last = row_clearance(
            scene, laid.leading, self.placed, Closest(FREE, 0, 0), self.interval.before, self.interval.motion
        )
        if self.last.gap > scene.margin:
            return ADVANCED
        self.first = self.last.first
        self.second = self.last.second
        if not self.surely_within(scene, scene.place - self.start):
            return STUCK
        self.meet(self.start)
        return TOUCHED_AT_START

    def surely_within(self, scene, place):
        """Is the pair `first`, `second` within the margin with the head at a place, whatever that is off by?"""
        return (
            pair_most(scene, self.probe, place + self.rounding, 2.0 * self.rounding, self.first, self.second)
            <= scene.margin
        )

    def refuse(self, part):
        """Try this part of the step next, without stopping short of a crossing."""
        self.h *= part
        self.aims = False
        return REFUSED

    def try_step(self, scene, interval):
        """One step: ADVANCED if it is proven, REFUSED if it is to be shorter, else how the march ends."""
        outer = scene.curve.growth * interval.before[1, THETA] if scene.curve.kind == ON_SPIRAL else 0.0
        allowance = ALLOWANCE * drift(fabs(interval.before[1, RATE]) + 1.0, self.h, scene.curve.growth, outer)
        place = scene.place - self.travel - self.h
        laid = chain_between(scene, place, self.followers, allowance, self.turning, interval.after)
        if laid.last == scene.room and scene.room < scene.benches:
            return CAPACITY
        if laid.last == FOLDED:
            return self.refuse(0.5)
        self.active = laid.leading
        interval.handles = laid.last
        self.work += laid.last * (1.0 + scene.edges / EDGES_PER_WORK)
        interval.widen(self.h, self.rounding)
        nearest = Nearest(FREE, 0.0, 0, 0, FREE, 0.0, 0)
        if self.active > 0:
            if self.placed < interval.handles:
                self.placed = extend(scene.curve, self.placed, interval.handles, scene.sizes, interval.before)
            nearest = interval_least(scene, interval, self.active)
            self.work += nearest.tried
            # a bench beyond the clear radius or place might not be there
            if nearest.least == -FREE or nearest.error > self.allowance:
                return self.refuse(0.5)
            if nearest.least <= scene.margin:
                return self.narrow(scene, interval, nearest)
            if scene.curve.kind == ON_SPIRAL and self.must_follow(scene, interval):
                return REFUSED
        self.travel += self.h
        self.placed = interval.handles
        interval.swap()
        if self.active > 0:
            self.bend = max(self.bend, nearest.bend)
        if self.aims and self.surely_within(scene, scene.place - self.target - self.tolerance):
            self.proven = self.travel
            self.meet(self.target + self.tolerance)
            return TOUCHED
        self.aims = False
        self.note_graze(scene, interval, nearest.least)
        if self.at_start and passed(scene, self.leaders, self.opened, self.placed, self.opening, interval.before):
            self.at_start = False
            self.followers = min(self.leaders, scene.room)
        room = 0.95 * nearest.room
        self.h = room if room < 2.0 * self.h else 2.0 * self.h
        return ADVANCED

    def must_follow(self, scene, interval):
        """Must more benches be followed over this step, as a handle of the spiral may turn back?

        The first one behind the leaders may come within the clear radius (`turning`), or one may stand behind its own
        start: then all pairs are followed again.
        """
        k = self.active
        h = interval.h
        if k < self.followers and may_turn(k, h, scene.sizes, interval.before, interval.after, interval.motion):
            edge = scene.curve.growth * min(interval.before[k, THETA], interval.after[k, THETA])
            edge -= drift(interval.motion[k - 1, HANDLE_SPEED], h, scene.curve.growth, edge)
            if edge < scene.rings.clear_radius:
                self.refuse(0.5 if self.turning else 1.0)
                self.turning = True
                return True
        if self.opens and not self.at_start:
            if slid_back(scene, interval, self.leaders, self.opened, self.opening):
                self.at_start = True
                self.followers = scene.room
                self.aims = False
                return True
        return False

    def narrow(self, scene, interval, nearest):
        """A step whose bound does not exceed the margin: look for the contact that it may end in, or shorten it."""
        far = self.travel + self.h
        if row_gap(scene, nearest.first, nearest.second, interval.after) > scene.margin:
            room = 0.95 * nearest.room
            self.refuse(0.5 if room < 0.5 * self.h or room >= self.h else room / self.h)
            if self.h >= self.tolerance:
                return REFUSED
            far = self.peek(scene, nearest.first, nearest.second)
            if far > self.stop:
                return REFUSED
        self.first = nearest.first
        self.second = nearest.second
        if self.tolerance <= 0.0:
            if not self.surely_within(scene, scene.place - self.travel - self.h):
                self.h *= 0.5
                return REFUSED
            self.meet(self.travel + self.h)
            return TOUCHED
        width = CROSSING_WIDTH * self.tolerance
        self.target = contact_between(scene, self.travel, far, self.first, self.second, width, self.probe.before)
        self.aims = self.target > 0.0  # a contact before travel 0 is bracketed by the step after it
        self.meet(self.target)
        way = self.target - self.tolerance - self.travel
        if way > self.rounding and way < self.h:
            self.h = way
            return REFUSED
        if self.target - self.tolerance <= self.travel:
            if self.surely_within(scene, scene.place - self.target - self.tolerance):
                self.meet(self.target + self.tolerance)
                return TOUCHED
        return self.refuse(0.5)

    def peek(self, scene, a, b):
        """A travel a little ahead at which a pair is within the margin, as rounding hides a slow contact; else FREE."""
        width = 2.0 * self.tolerance
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
