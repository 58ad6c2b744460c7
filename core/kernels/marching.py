"""Marching to first contact, by proven steps."""

import cython
from cython.cimports.libc.math import fabs

if not cython.compiled:  # for the compiler the same stands in the .pxd
    from core.kernels.bounds import followed_error
    from core.kernels.chain import chain_rounding, extend
    from core.kernels.clearance import crossing, gap_at, row_clearance, row_gap
    from core.kernels.constants import *
    from core.kernels.pairs import interval_least, pair_most
    from core.kernels.rings import coil_place, coil_radius, coil_reach, drift, leaders_reach, radius_beyond
    from core.kernels.route import extend_route, stands_first, start_route
    from core.kernels.spiral import extend_chain, spiral_curvature, spiral_theta, start_chain

# March.
#
# Input. A chain for every head travel (growth or pieces, place, sizes), the margin, start and stop, which pairs must be
# followed (leaders, at_start, statics), the ring bound (ring), and how near a contact is to be bracketed (tolerance).
# State. `travel`; `before` and `after`, the chains at travel and at travel + h, of all handles that matter there;
# h, the step to try; `target`, the crossing that this step stops short of, -1 for none.
# Output. One of five ends, and in out what is known then.
#
# Invariant, whenever the loop begins: no two benches that share no handle come within the margin in [start, travel].
# 1. A step is taken only if interval_least() leaves more than the margin, rounding allowed for, for every pair led by
# the first `active` benches at every instant of [travel, travel + h] (pairs.py). It needs no step small enough: between
# two ends a gap along an axis cannot fall further below its chord than K x (h - x) / 2, with K bounded over the very
# interval (bounds.py). So a graze cannot be stepped over: a dip within the interval that reached the margin would need
# a larger second derivative. Where the bound does not reach, the step is shortened, never taken.
# 2. Of the other pairs, those whose inner bench leads at ring[RING_CLEAR] or further out are clear by the ring bound,
# and those whose outer bench stands beyond radius_beyond(leaders_reach()) lie outside all that the leaders can touch
# over the interval, which interval_least() checks with the handles' drift (rings.py). On a route all handles are laid
# out.
# 3. While at_start all benches are followed. Then only the pairs of the first `leaders` benches, of which the last, m =
# leaders - 1, is the first of the alike: bench i > m at a place, and all behind it, stand as bench i - 1 and all behind
# that did when handle i - 1 stood there, in the same benches (family lemma, core/contact/first_contact.py). passed()
# says that every handle i has come to where handle i - 1 began; so that was after the start, and clear by the invariant
# for i - 1, down to m. From there on it stays so, as no handle turns back before the one ahead does. A handle that
# began beyond `opened` is led by benches that 2 clears, until it is where a predecessor has been. 4. Consecutive steps
# share a chain to the last bit, so the intervals tile the way of the true head without a gap. What is not the same to
# the last bit is the travel: the head of the chain at `travel` has truly travelled within `rounding` of it. So h, which
# the bounds take for its true way, is widened by twice that, and the caller begins and ends the march beyond what it
# says of it by as much.
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
# PROVEN = travel, TOUCHING = target + tolerance. If travel is beyond target - tolerance already, the second condition
# suffices. An earlier crossing, of this pair or another, makes the step fail and is found instead. Without a bracket
# (tolerance <= 0) TOUCHING is the far end itself, if it is certain.
# TOUCHED_AT_START: the nearest pair is within the margin at the start, for certain. Where rounding hides that: STUCK.
# STUCK: h is below what could help (LEAST_STEP of the bracket, or rounding), the budget is spent, or the chain folds at
# the start. PROVEN = travel still holds. TOUCHING >= 0 is a crossing that could not be bracketed this narrowly, a
# pair that closes slowly: a wider bracket may do. -1: none was found.
# CAPACITY: more handles matter than there are rows; nothing is claimed.
# GRAZE_...: what was seen on the way, refined but not proven to be the least.

# Width to which the place of a graze is found [m]: 1e-10 s at 1 m/s.
DIP_WIDTH = 1e-10
# Shorter steps than this part of the bracket would get nowhere [1].
LEAST_STEP = 0.05
# Without a bracket to reach, a step this short means that the way is not clear enough to be proven [m].
LEAST_WAY = 1e-7
# The chain is laid out so many drifts further than the pose needs; if that is too little the step is halved [1].
ALLOWANCE = 2.0
# Widths are widened by this part of them, for the roundings of what a step computes once [1].
WIDTH_ROUNDING = 1e-12
# How far ahead a contact is looked for whose beginning rounding hides [m]: the widest bracket of
# core/contact/search.py, twice.
PEEK = 1e-4
# Handles have passed a place when they are this much beyond it, of 1 + |theta| or 1 + |s| [1], and beyond what both may
# be off by. On a spiral where no handle is followed it is more than SLIP alone: u (32 n c + 16 r (theta - theta_0) +
# 2 r n) at most (spiral_error()), with n c <= r theta, which is an angle below u (48 theta + 2 n), n < 1e6.
PASSED_BY = 1e-9
# A crossing is found this much closer than the bracket that is proven around it [1].
CROSSING_WIDTH = 1e-3


def chain_between(growth, pieces, place, leaders, benches, margin, allowance, turning, ring, sizes, chain, found):
    """The chain for a head at a place as far as its leading benches can touch; the last handle's index, -1 at a fold.

    found[0] = how many benches can be the inner one of a touching pair
    allowance: extra radius for what moves during an interval [m], for those too if they are `turning`
    """
    if pieces.shape[0] > 0:
        return route_between(pieces, place, leaders, benches, margin, allowance, ring, sizes, chain, found)
    theta = spiral_theta(place / growth)
    start_chain(theta, chain)
    k = extend_chain(growth, 0, leaders, ring[RING_CLEAR] + (allowance if turning else 0.0), sizes, chain)
    found[0] = k
    if k <= 0:
        return k
    radius = leaders_reach(growth, growth * theta, growth * chain[k, THETA] + allowance, ring)
    return extend_chain(growth, k, benches, radius_beyond(growth, radius + margin, ring) + allowance, sizes, chain)


def route_between(pieces, place, leaders, benches, margin, allowance, ring, sizes, chain, found):
    """chain_between() on a route: as far as rings.py says where it begins with a coil inwards, else all benches."""
    start_route(pieces, -place, chain)
    k = leaders
    if ring[RING_PLACE] < FREE:
        k = extend_route(pieces, 0, leaders, ring[RING_PLACE], sizes, chain)
    found[0] = k
    if ring[RING_PLACE] >= FREE:
        return extend_route(pieces, 0, benches, FREE, sizes, chain)
    if k == 0:
        return 0
    radius = radius_beyond(pieces[0, COIL_GROWTH], coil_reach(pieces, k, sizes, chain) + margin + allowance, ring) + allowance
    k = extend_route(pieces, k, benches, coil_place(pieces, radius), sizes, chain)
    while k < benches and (  # a handle within rounding of that place
        not stands_first(pieces, k, chain) or coil_radius(pieces, chain[k, PX], chain[k, PY]) < radius
    ):
        k = extend_route(pieces, k, k + 1, FREE, sizes, chain)
    return k


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
# Bench i leads no pair that may touch while place_i >= clear, RING_PLACE on a route, RING_CLEAR / growth on a spiral.
# So with `opened` the first bench that started there, benches behind it need neither of the two: x < clear lies before
# place_opened(start), and the benches m to `opened` cover that by passed() alone. (With m >= opened bench m itself
# covers all from clear on.) chain_between() leaves out those benches at the far end of every step. Where handles only
# go forward they have been out there all along it; one that may turn back is kept among the leaders while it is within
# a drift of RING_CLEAR (`turning`).
#
# With edges at rest in place of the second bench the same holds of g(place_i), the separation of a bench and an edge.


def passed(growth, pieces, first, last, placed, sizes, opening, chain):
    """Has every handle from `first` to `last` passed where its predecessor began, by more than rounding?

    A handle that is SLIP from its true place along a spiral is off by SLIP / growth in theta at most.
    """
    for i in range(first, last + 1):
        if i > placed or chain[i, THETA] + PASSED_BY * (1.0 + fabs(chain[i, THETA])) > opening[i - 1, THETA]:
            return False
    chain_rounding(growth, pieces, last, sizes, opening)
    if first <= last:
        chain_rounding(growth, pieces, last, sizes, chain)
    for i in range(first, last + 1):
        if chain[i, THETA] + (chain[i, SLIP] + opening[i - 1, SLIP]) / growth > opening[i - 1, THETA]:
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


def slid_back(growth, first, last, placed, h, ring, sizes, opening, before, after, motion):
    """May a handle of a spiral from `first` to before `last` have stood behind its own start during an interval?

    Behind the last handle placed every other moves in the direction of its leader, where links bend no more than the
    chord lemma asks (bounds.py): then what holds of that one holds of them. Radii are off by less than SLIP, and by
    less than PASSED_BY of 1 + theta where no handle is followed.
    """
    error = 0.0
    for k in range(min(last, placed + 1)):
        if k > 0 and motion[k, RATE_LOW] <= 0.0:
            error = followed_error(k, error, sizes, before, after)
        if k < first and k < placed:
            continue
        low = growth * max(before[k, THETA], after[k, THETA])
        low += PASSED_BY * (growth + low) + opening[k, SLIP]
        if motion[k, RATE_LOW] <= 0.0:
            low += max(before[k, SLIP], after[k, SLIP])
        if k > 0 and turns_back(k, h, error, before, after, motion):
            low += drift(motion[k - 1, HANDLE_SPEED], h, growth, low)
        if low > growth * opening[k, THETA]:
            return True
    low = min(before[placed, THETA], after[placed, THETA])
    low -= drift(motion[placed - 1, HANDLE_SPEED], h, growth, growth * low) / growth
    return placed + 1 < last and 0.5 * spiral_curvature(low) * ring[ALL_CHORD] > BEND_LIMIT * growth


def march(
    growth,
    pieces,
    place,
    start,
    stop,
    leaders,
    at_start,
    margin,
    tolerance,
    rounding,
    budget,
    benches,
    statics,
    ring,
    sizes,
    rows,
    motion,
    pair,
    out,
):
    """Advance the head from `start` to `stop` [m of travel] by proven steps, until a pair comes within the margin.

    place: at travel 0, see chain.py [m]; leaders: benches whose pairs must be followed; at_start: follow all pairs
    until every bench has passed the start of the one before it; tolerance: half width of the bracket around a
    contact [m], 0 or less for none: to end at any instant found to be within the margin, and with 0 without looking
    for grazes; rounding: what a travel may be off by [m]; budget: of WORK; benches: n; statics: edges at rest in the
    rows after the last handle's, on a route only; negative: these alone, without pairs of benches
    sizes: (R - 1, SIZE_COLUMNS) at least; rows: (4, R, CHAIN_COLUMNS), motion: (R, MOTION_COLUMNS) scratch; out:
        (MARCH_ENTRIES,)
    returns: REACHED, TOUCHED, TOUCHED_AT_START, STUCK (budget spent or interval at rounding) or CAPACITY (R too small)
    """
    before: cython.double[:, ::1] = rows[0]
    after: cython.double[:, ::1] = rows[1]
    spare: cython.double[:, ::1] = rows[2]
    opening: cython.double[:, ::1] = rows[3]
    scratch: cython.double[::1] = out[MARCH_ENTRIES:]
    edges = statics if statics >= 0 else -statics
    cap = before.shape[0] - 1 - edges
    first = leaders
    followers = benches if at_start else leaders
    solo = growth if pieces.shape[0] == 0 else 0.0
    travel = start
    h = ring[RING_SHORT]
    target = -1.0
    floor = FREE
    older_clearance = -FREE
    last_travel = start
    older_travel = start
    last_a = 0
    last_b = 0
    turning = False
    allowed = CLEAR_SPARE * ring[RING_CLEAR]
    if pieces.shape[0] > 0:
        allowed = 0.5 * PLACE_SPARE if ring[RING_PLACE] < FREE else FREE
    opens = at_start and solo > 0.0
    if cap > benches:
        cap = benches
    if followers > cap:
        followers = cap
    out[GRAZE_GAP] = FREE
    out[TOUCHING] = -1.0
    out[STEPS] = out[BEND] = out[WORK] = 0.0
    with cython.nogil:
        placed = chain_between(
            growth, pieces, place - start, followers, cap, margin, h, False, ring, sizes, before, pair
        )
        if placed == cap and cap < benches:
            return CAPACITY
        if placed < 0:
            return STUCK
        opened = pair[0] if pair[0] < benches else benches - 1
        opening[: placed + 1] = before[: placed + 1]
        last_clearance = row_clearance(solo, pair[0], placed, statics, sizes, before, motion, pair)
        if last_clearance <= margin:
            out[PROVEN] = out[TOUCHING] = start
            out[FIRST] = pair[1]
            out[SECOND] = pair[2]
            least = pair_most(
                growth, pieces, place - start + rounding, 2.0 * rounding, pair[1], pair[2], benches, sizes, spare,
                after, motion, scratch,
            )  # fmt: skip
            if least <= margin:
                return TOUCHED_AT_START
            out[TOUCHING] = -1.0
            return STUCK
        while travel < stop and (at_start or place - travel > ring[RING_END]):
            out[PROVEN] = travel
            if out[WORK] >= budget or h < rounding or h < (LEAST_STEP * tolerance if tolerance > 0.0 else LEAST_WAY):
                return STUCK
            out[STEPS] += 1.0
            out[WORK] += STEP_WORK
            if h > stop - travel:
                h = stop - travel
            handles = chain_between(
                growth,
                pieces,
                place - travel - h,
                followers,
                cap,
                margin,
                ALLOWANCE * drift(fabs(before[1, RATE]) + 1.0, h, growth, solo * before[1, THETA]),
                turning,
                ring,
                sizes,
                after,
                pair,
            )
            if handles == cap and cap < benches:
                return CAPACITY
            active = pair[0]
            if handles < 0:
                h *= 0.5
                target = -1.0
                continue
            out[WORK] += handles * (1.0 + edges / EDGES_PER_WORK)
            room = FREE
            least = FREE
            wide = h * (1.0 + WIDTH_ROUNDING) + 2.0 * rounding
            if active > 0:
                if placed < handles:
                    placed = extend(growth, pieces, placed, handles, sizes, before)
                least = interval_least(
                    growth,
                    pieces,
                    statics,
                    wide,
                    active,
                    handles,
                    benches,
                    margin,
                    ring,
                    sizes,
                    before,
                    after,
                    motion,
                    scratch,
                )
                room = 0.95 * scratch[3]
                out[WORK] += scratch[9]
                if scratch[4] > allowed:  # a bench beyond the clear radius or place might not be there
                    least = -FREE
            if least <= margin:
                if least == -FREE:
                    h *= 0.5
                    target = -1.0
                    continue
                a = cython.cast(cython.Py_ssize_t, scratch[1])
                b = cython.cast(cython.Py_ssize_t, scratch[2])
                far = travel + h
                if row_gap(a, b, sizes, after) > margin:
                    h *= 0.5 if room < 0.5 * h or room >= h else room / h
                    target = -1.0
                    if h >= tolerance:
                        continue
                    # within what rounding hides of a slow contact; the pair may be within the margin a little on
                    width = 2.0 * tolerance
                    while width <= PEEK and (
                        gap_at(growth, pieces, place - travel - width, benches, a, b, sizes, spare) > margin
                    ):
                        width *= 4.0
                    far = travel + width
                    if width > PEEK or far > stop:
                        continue
                if tolerance <= 0.0:
                    clearance = pair_most(
                        growth, pieces, place - travel - h + rounding, 2.0 * rounding, a, b, benches, sizes, spare,
                        after, motion, scratch,
                    )  # fmt: skip
                    if clearance > margin:
                        h *= 0.5
                        continue
                    out[TOUCHING] = travel + h
                    out[FIRST] = a
                    out[SECOND] = b
                    return TOUCHED
                target = crossing(
                    growth,
                    pieces,
                    place,
                    benches,
                    travel,
                    far,
                    a,
                    b,
                    margin,
                    CROSSING_WIDTH * tolerance,
                    False,
                    sizes,
                    spare,
                    scratch,
                )
                out[FIRST] = a
                out[SECOND] = b
                out[TOUCHING] = target
                if target - tolerance - travel > rounding and target - tolerance - travel < h:
                    h = target - tolerance - travel
                    continue
                if target - tolerance <= travel:
                    clearance = pair_most(
                        growth, pieces, place - target - tolerance + rounding, 2.0 * rounding, a, b, benches, sizes,
                        spare, after, motion, scratch,
                    )  # fmt: skip
                    if clearance <= margin:
                        out[TOUCHING] = target + tolerance
                        return TOUCHED
                h *= 0.5
                target = -1.0
                continue
            if solo > 0.0 and 0 < active < followers and may_turn(active, wide, sizes, before, after, motion):
                edge = growth * min(before[active, THETA], after[active, THETA])
                if edge - drift(motion[active - 1, HANDLE_SPEED], wide, growth, edge) < ring[RING_CLEAR]:
                    h *= 0.5 if turning else 1.0
                    turning = True
                    target = -1.0
                    continue
            if opens and not at_start and active > 0:
                if slid_back(growth, first, opened, handles, wide, ring, sizes, opening, before, after, motion):
                    at_start = True
                    followers = benches if benches < cap else cap
                    target = -1.0
                    continue
            travel += h
            placed = handles
            before, after = after, before
            if scratch[0] > out[BEND] and active > 0:
                out[BEND] = scratch[0]
            if target > 0.0:
                clearance = pair_most(
                    growth, pieces, place - target - tolerance + rounding, 2.0 * rounding,
                    cython.cast(cython.Py_ssize_t, out[FIRST]), cython.cast(cython.Py_ssize_t, out[SECOND]), benches,
                    sizes, spare, after, motion, scratch,
                )  # fmt: skip
                if clearance <= margin:
                    out[PROVEN] = travel
                    out[TOUCHING] = target + tolerance
                    return TOUCHED
            target = -1.0
            clearance = FREE
            if tolerance != 0.0:
                clearance = row_clearance(solo, active, handles, statics, sizes, before, motion, pair)
            lowest = least if least < floor else floor
            floor = least
            if older_clearance > last_clearance <= clearance and lowest < out[GRAZE_GAP]:
                if clearance < FREE and older_travel < last_travel:
                    lowest = crossing(
                        growth,
                        pieces,
                        place,
                        benches,
                        older_travel,
                        travel,
                        last_a,
                        last_b,
                        margin,
                        DIP_WIDTH,
                        True,
                        sizes,
                        spare,
                        scratch,
                    )
                    clearance_there = gap_at(growth, pieces, place - lowest, benches, last_a, last_b, sizes, spare)
                    if clearance_there < out[GRAZE_GAP]:
                        out[GRAZE_GAP] = clearance_there
                        out[GRAZE_TRAVEL] = lowest
                        out[GRAZE_FIRST] = last_a
                        out[GRAZE_SECOND] = last_b
            older_clearance = last_clearance
            older_travel = last_travel
            last_clearance = clearance
            last_travel = travel
            last_a = pair[1]
            last_b = pair[2]
            if at_start and passed(growth, pieces, first, opened, placed, sizes, opening, before):
                at_start = False
                followers = leaders if leaders < cap else cap
            h = room if room < 2.0 * h else 2.0 * h
        out[PROVEN] = stop
        return REACHED
