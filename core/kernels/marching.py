"""Marching to first contact, by proven steps."""

import cython
from cython.cimports.libc.math import fabs

if not cython.compiled:  # for the compiler the same stands in the .pxd
    from core.kernels.bounds import followed_error
    from core.kernels.chain import chain_rounding, extend
    from core.kernels.clearance import bottom_between, contact_between, gap_at, row_clearance, row_gap
    from core.kernels.constants import *
    from core.kernels.pairs import interval_least, pair_most
    from core.kernels.records import Closest, Laid, Nearest
    from core.kernels.rings import coil_place, coil_radius, coil_reach, drift, leaders_reach, radius_beyond
    from core.kernels.route import extend_route, stands_first, start_route
    from core.kernels.spiral import extend_chain, spiral_curvature, spiral_theta, start_chain

# March.
#
# Input. A scene: a chain for every head travel, the margin, the bounds on rings; start and stop; which pairs must be
# followed (leaders, at_start); and how near a contact is to be bracketed (tolerance).
# State. `travel`; the interval with the chains at travel and at travel + h, of all handles that matter there; h, the
# step to try; `target`, the crossing that this step stops short of, -1 for none (one before travel 0 is bracketed by
# the step after it); `opening`, the chain at the start.
# Output. One of five ends, and what is known then: see March.
#
# Invariant, whenever the loop begins: no two benches that share no handle come within the margin in [start, travel].
# 1. A step is taken only if interval_least() leaves more than the margin, rounding allowed for, for every pair led by
# the first `active` benches at every instant of [travel, travel + h] (pairs.py). It needs no step small enough: between
# two ends a gap along an axis cannot fall further below its chord than K x (h - x) / 2, with K bounded over the very
# interval (bounds.py). So a graze cannot be stepped over: a dip within the interval that reached the margin would need
# a larger second derivative. Where the bound does not reach, the step is shortened, never taken.
# 2. Of the other pairs, those whose inner bench leads at clear_radius or further out are clear by the ring bound,
# and those whose outer bench stands beyond radius_beyond(leaders_reach()) lie outside all that the leaders can touch
# over the interval, which interval_least() checks with the handles' drift (rings.py). On a route all handles are laid
# out.
# 3. While at_start all benches are followed. Then only the pairs of the first `leaders` benches, of which the last, m =
# leaders - 1, is the first of the alike: bench i > m at a place, and all behind it, stand as bench i - 1 and all behind
# that did when handle i - 1 stood there, in the same benches (family lemma, core/contact/first_contact.py). passed()
# says that every handle i has come to where handle i - 1 began; so that was after the start, and clear by the invariant
# for i - 1, down to m. From there on it stays so, as no handle turns back before the one ahead does. A handle that
# began beyond `opened` is led by benches that 2 clears, until it is where a predecessor has been.
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
# bracketed this narrowly, a pair that closes slowly: a wider bracket may do. FREE: none was found.
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
# Handles have passed a place when they are this much beyond it, of 1 + |theta| or 1 + |s| [1], and beyond what both may
# be off by. On a spiral where no handle is followed it is more than SLIP alone: u (32 n c + 16 r (theta - theta_0) +
# 2 r n) at most (spiral_error()), with n c <= r theta, which is an angle below u (48 theta + 2 n), n < 1e6.
PASSED_BY = 1e-9
# Width of a crossing, as a part of the bracket that is proven around it [1].
CROSSING_WIDTH = 1e-3


def chain_between(scene, place, leaders, allowance, turning, chain):
    """The chain for a head at a place as far as its leading benches can touch, and how many of them can.

    allowance: extra radius for what moves during an interval [m], for those that lead too if they are `turning`
    """
    if scene.curve.kind == ON_ROUTE:
        return route_between(scene, place, leaders, allowance, chain)
    growth = scene.curve.growth
    theta = spiral_theta(place / growth)
    start_chain(theta, chain)
    clear = scene.rings.clear_radius + (allowance if turning else 0.0)
    k = extend_chain(growth, 0, leaders, clear, scene.sizes, chain)
    if k <= 0:
        return Laid(k, k)
    radius = leaders_reach(growth, growth * theta, growth * chain[k, THETA] + allowance, scene.rings)
    radius = radius_beyond(growth, radius + scene.margin, scene.rings) + allowance
    return Laid(extend_chain(growth, k, scene.room, radius, scene.sizes, chain), k)


def route_between(scene, place, leaders, allowance, chain):
    """chain_between() on a route: as far as rings.py says where it begins with a coil inwards, else all benches."""
    start_route(scene.curve.pieces, -place, chain)
    if scene.rings.clear_place >= FREE:
        return Laid(extend_route(scene.curve.pieces, 0, scene.room, FREE, scene.sizes, chain), leaders)
    leading = extend_route(scene.curve.pieces, 0, leaders, scene.rings.clear_place, scene.sizes, chain)
    if leading == 0:
        return Laid(0, 0)
    radius = coil_reach(scene.curve.pieces, leading, scene.sizes, chain) + scene.margin + allowance
    radius = radius_beyond(scene.curve.pieces[0, COIL_GROWTH], radius, scene.rings) + allowance
    until = coil_place(scene.curve.pieces, radius)
    k = extend_route(scene.curve.pieces, leading, scene.room, until, scene.sizes, chain)
    while k < scene.room and (  # a handle within rounding of that place
        not stands_first(scene.curve.pieces, k, chain)
        or coil_radius(scene.curve.pieces, chain[k, PX], chain[k, PY]) < radius
    ):
        k = extend_route(scene.curve.pieces, k, k + 1, FREE, scene.sizes, chain)
    return Laid(k, leading)


# The family lemma. Let m be the first of the benches that are alike to the tail (`leaders` = m + 1), and let place_i(t)
# be where handle i stands with the head at travel t. The handle behind one at place p is the first point behind p at
# its chord (spiral.py, route.py): a function N_i of p alone, and N_i = N for all i >= m. So all handles from i on, and
# with them the benches i and j > i, stand at N_i, N_(i+1) N_i, ... of place_i: the separation of (i, j) is a function
# of place_i alone, and for i >= m one of place_i and j - i alone, g_(j - i)(place_i). (m, m + j - i) is a pair too, as
# m + j - i <= j.
#
# Places fall in the direction of travel, and are continuous in t. Let all pairs led by every bench that may touch be
# followed from `start` to T, and only those led by benches 0 to m from then on to t; nothing came within the margin.
# Pairs led by 0 to m were followed throughout. For a pair (i, j), i > m, at t, and x = place_i(t), it suffices that
# g_(j - i) was followed at x: in a pair led by some bench i' in [m, i], which has an outer bench i' + j - i <= j, at an
# instant with place_i' = x. Bench m was followed over all places between place_m(start) and the least of place_m until
# t, every other such i' over those between place_i'(start) and place_i'(T). If
#     passed():   place_i'(T) <= place_(i'-1)(start)   for all i' in (m, i],
# these stretches overlap, each with the one of the bench before it, and cover all from the least of place_m to
# place_i(start); and x >= place_m(t), as no handle overtakes. So x is covered if
#     place_i(t) <= place_i(start),
# bench i not being further back than where it started. On a route that is always so: handles only go forward
# (route.py). On a spiral a handle turns back where the link before it stands across the path, near the fold: while one
# may stand behind its start (slid_back()), all pairs are followed again.
#
# Bench i leads no pair that may touch while place_i >= clear, which is clear_place on a route and clear_radius / growth
# on a spiral. So with `opened` the first bench that started there, benches behind it need neither of the two: x < clear
# lies before place_opened(start), and the benches m to `opened` cover that by passed() alone. (With m >= opened bench m
# itself covers all from clear on.) chain_between() leaves out those benches at the far end of every step. Where handles
# only go forward they have been out there all along it; one that may turn back is kept among the leaders while it is
# within a drift of clear_radius (`turning`).
#
# With edges at rest in place of the second bench the same holds of g(place_i), the separation of a bench and an edge.


def passed(scene, first, last, placed, opening, chain):
    """Has every handle from `first` to `last` passed where its predecessor began, by more than rounding?

    A handle that is SLIP from its true place along a spiral is off by SLIP / growth in theta at most.
    """
    for i in range(first, last + 1):
        if i > placed or chain[i, THETA] + PASSED_BY * (1.0 + fabs(chain[i, THETA])) > opening[i - 1, THETA]:
            return False
    chain_rounding(scene.curve, last, scene.sizes, opening)
    if first <= last:
        chain_rounding(scene.curve, last, scene.sizes, chain)
    for i in range(first, last + 1):
        slip = (chain[i, SLIP] + opening[i - 1, SLIP]) / scene.curve.growth
        if chain[i, THETA] + slip > opening[i - 1, THETA]:
            return False
    return True


# A rate is never below the mean of those at both ends by more than |s''| h / 2, and these are good to followed_error().
# Where no handle is followed none turns back (RATE_LOW > 0).


def turns_back(k, h, error, before, after, motion):
    """May handle k of a spiral go backwards during an interval? error: of its rates at both ends [1]"""
    return motion[k, RATE_LOW] <= 0.0 and before[k, RATE] + after[k, RATE] <= motion[k, RATE_RATE] * h + 2.0 * error


def may_turn(k, h, sizes, before, after, motion):
    """turns_back() without the error of the rates, which follows from link to link."""
    error = 0.0
    if motion[k, RATE_LOW] > 0.0:
        return False
    for i in range(1, k + 1):
        error = followed_error(i, error, sizes, before, after)
    return turns_back(k, h, error, before, after, motion)


def slid_back(scene, interval, first, last, opening):
    """May a handle of a spiral from `first` to before `last` have stood behind its own start during an interval?

    Behind the last handle placed every other moves in the direction of its leader, where links bend no more than the
    chord lemma asks (bounds.py): then what holds of that one holds of them. Radii are off by less than SLIP, and by
    less than PASSED_BY of 1 + theta where no handle is followed.
    """
    growth = scene.curve.growth
    placed = interval.handles
    error = 0.0
    for k in range(min(last, placed + 1)):
        followed = interval.motion[k, RATE_LOW] <= 0.0
        if k > 0 and followed:
            error = followed_error(k, error, scene.sizes, interval.before, interval.after)
        if k < first and k < placed:
            continue
        low = growth * max(interval.before[k, THETA], interval.after[k, THETA])
        low += PASSED_BY * (growth + low) + opening[k, SLIP]
        if followed:
            low += max(interval.before[k, SLIP], interval.after[k, SLIP])
        if k > 0 and turns_back(k, interval.h, error, interval.before, interval.after, interval.motion):
            low += drift(interval.motion[k - 1, HANDLE_SPEED], interval.h, growth, low)
        if low > growth * opening[k, THETA]:
            return True
    low = min(interval.before[placed, THETA], interval.after[placed, THETA])
    low -= drift(interval.motion[placed - 1, HANDLE_SPEED], interval.h, growth, growth * low) / growth
    return placed + 1 < last and 0.5 * spiral_curvature(low) * scene.rings.all_chord > BEND_LIMIT * growth


class March:
    """The head of a scene, marched by proven steps until a pair comes within the margin: see the top of this file.

    interval: the chains of a step; probe: an interval to look at a pair alone; opening: rows for the chain at the start
    proven: nothing touches up to here [m of head travel]; touching: a pair is within the margin here, FREE for none;
        first, second: that pair
    steps, work: what was done; bend: the largest K that proved a step [1/m]
    graze_gap: the least local minimum of the clearance on the way [m], FREE if none; graze_travel, graze_first,
        graze_second: where, and its pair
    """

    def __init__(self, interval, probe, opening):
        self.interval = interval
        self.probe = probe
        self.opening = opening
        self.start = self.stop = self.tolerance = self.rounding = self.budget = 0.0
        self.leaders = self.followers = self.active = self.placed = self.opened = 0
        self.at_start = self.opens = self.turning = self.grazes = False
        self.travel = self.h = self.target = self.allowed = 0.0
        self.floor = self.older_clearance = self.older_travel = self.last_travel = 0.0
        self.last = Closest(FREE, 0, 0)
        self.proven = self.touching = self.work = self.bend = 0.0
        self.graze_gap = self.graze_travel = 0.0
        self.first = self.second = self.steps = self.graze_first = self.graze_second = 0

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
        self.allowed = CLEAR_SPARE * scene.rings.clear_radius
        if scene.curve.kind == ON_ROUTE:
            self.allowed = 0.5 * PLACE_SPARE if scene.rings.clear_place < FREE else FREE
        self.travel = self.older_travel = self.last_travel = self.start
        self.h = scene.rings.shortest
        self.target = -1.0
        self.touching = FREE
        self.floor = self.graze_gap = FREE
        self.older_clearance = -FREE
        self.turning = False
        self.steps = 0
        self.bend = self.work = 0.0
        laid = chain_between(scene, scene.place - self.start, self.followers, self.h, False, self.interval.before)
        if laid.last == scene.room and scene.room < scene.benches:
            return CAPACITY
        if laid.last < 0:
            return STUCK
        self.placed = laid.last
        self.opened = laid.leading if laid.leading < scene.benches else scene.benches - 1
        self.opening[: self.placed + 1] = self.interval.before[: self.placed + 1]
        self.last = row_clearance(scene, laid.leading, self.placed, self.interval.before, self.interval.motion)
        if self.last.gap > scene.margin:
            return ADVANCED
        self.proven = self.start
        self.first = self.last.first
        self.second = self.last.second
        if not self.surely_within(scene, scene.place - self.start):
            return STUCK
        self.touching = self.start
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
        self.target = -1.0
        return REFUSED

    def try_step(self, scene, interval):
        """One step: ADVANCED if it is proven, REFUSED if it is to be shorter, else how the march ends."""
        outer = scene.curve.growth * interval.before[1, THETA] if scene.curve.kind == ON_SPIRAL else 0.0
        allowance = ALLOWANCE * drift(fabs(interval.before[1, RATE]) + 1.0, self.h, scene.curve.growth, outer)
        place = scene.place - self.travel - self.h
        laid = chain_between(scene, place, self.followers, allowance, self.turning, interval.after)
        if laid.last == scene.room and scene.room < scene.benches:
            return CAPACITY
        if laid.last < 0:
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
            if nearest.least == -FREE or nearest.error > self.allowed:
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
        if self.target > 0.0 and self.surely_within(scene, scene.place - self.target - self.tolerance):
            self.proven = self.travel
            self.touching = self.target + self.tolerance
            return TOUCHED
        self.target = -1.0
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
                self.target = -1.0
                return True
        return False

    def narrow(self, scene, interval, nearest):
        """A step whose bound does not exceed the margin: look for the contact that it may end in, or shorten it."""
        far = self.travel + self.h
        if row_gap(nearest.first, nearest.second, scene.sizes, interval.after) > scene.margin:
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
            self.touching = self.travel + self.h
            return TOUCHED
        width = CROSSING_WIDTH * self.tolerance
        self.target = contact_between(scene, self.travel, far, self.first, self.second, width, self.probe.before)
        self.touching = self.target
        way = self.target - self.tolerance - self.travel
        if way > self.rounding and way < self.h:
            self.h = way
            return REFUSED
        if self.target - self.tolerance <= self.travel:
            if self.surely_within(scene, scene.place - self.target - self.tolerance):
                self.touching = self.target + self.tolerance
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
            here = row_clearance(scene, self.active, interval.handles, interval.before, interval.motion)
        lowest = least if least < self.floor else self.floor
        self.floor = least
        dips = self.older_clearance > self.last.gap <= here.gap and lowest < self.graze_gap
        if dips and here.gap < FREE and self.older_travel < self.last_travel:
            travel = bottom_between(
                scene, self.older_travel, self.travel, self.last.first, self.last.second, DIP_WIDTH, self.probe.before
            )
            gap = gap_at(scene, scene.place - travel, self.last.first, self.last.second, self.probe.before)
            if gap < self.graze_gap:
                self.graze_gap = gap
                self.graze_travel = travel
                self.graze_first = self.last.first
                self.graze_second = self.last.second
        self.older_clearance = self.last.gap
        self.older_travel = self.last_travel
        self.last = here
        self.last_travel = self.travel
