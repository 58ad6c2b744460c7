"""Marching to first contact, by proven steps."""

import cython
from cython.cimports.libc.math import fabs

if not cython.compiled:  # for the compiler the same stands in the .pxd
    from core.kernels.chain import extend, place_chain
    from core.kernels.clearance import crossing, gap_at, row_clearance, row_gap
    from core.kernels.constants import *
    from core.kernels.pairs import interval_least, pair_most
    from core.kernels.rings import drift, leaders_reach, radius_beyond
    from core.kernels.spiral import extend_chain, spiral_theta, start_chain

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
# A crossing is found this much closer than the bracket that is proven around it [1].
CROSSING_WIDTH = 1e-3


def chain_between(growth, pieces, place, leaders, benches, margin, allowance, ring, sizes, chain, found):
    """The chain for a head at a place as far as its leading benches can touch; the last handle's index, -1 at a fold.

    found[0] = how many benches can be the inner one of a touching pair
    allowance: extra radius for what moves during an interval [m]
    """
    if pieces.shape[0] > 0:
        found[0] = leaders
        return place_chain(growth, pieces, place, benches, sizes, chain)
    theta = spiral_theta(place / growth)
    start_chain(theta, chain)
    k = extend_chain(growth, 0, leaders, ring[RING_CLEAR], sizes, chain)
    found[0] = k
    if k <= 0:
        return k
    radius = leaders_reach(growth, growth * theta, growth * chain[k, THETA] + allowance, ring)
    return extend_chain(growth, k, benches, radius_beyond(growth, radius + margin, ring) + allowance, sizes, chain)


def passed(first, last, placed, opening, chain):
    """Has every handle from `first` to `last` passed where its predecessor began?

    last: the first bench that began where none can touch, whose predecessor began where they can: from there outwards
    nothing needs to be followed
    """
    for i in range(first, last + 1):
        if i > placed or chain[i, THETA] > opening[i - 1, THETA]:
            return False
    return True


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
    for grazes; rounding: what a travel may be off by [m]; budget: steps; benches: n; statics: edges at rest in
    the rows after the last handle's, on a route only; negative: these alone, without pairs of benches
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
    if cap > benches:
        cap = benches
    if followers > cap:
        followers = cap
    out[GRAZE_GAP] = FREE
    out[TOUCHING] = -1.0
    out[STEPS] = out[BEND] = 0.0
    with cython.nogil:
        placed = chain_between(growth, pieces, place - start, followers, cap, margin, h, ring, sizes, before, pair)
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
                growth, pieces, place - start + rounding, 2.0 * rounding, pair[1], pair[2], benches, sizes, spare, after,
                motion, scratch,
            )  # fmt: skip
            if least <= margin:
                return TOUCHED_AT_START
            out[TOUCHING] = -1.0
            return STUCK
        while travel < stop:
            out[PROVEN] = travel
            if out[STEPS] >= budget or h < rounding or h < (LEAST_STEP * tolerance if tolerance > 0.0 else LEAST_WAY):
                return STUCK
            out[STEPS] += 1.0
            if h > stop - travel:
                h = stop - travel
            handles = chain_between(
                growth,
                pieces,
                place - travel - h,
                followers,
                cap,
                margin,
                ALLOWANCE * drift(fabs(before[1, RATE]) + 1.0, h, growth, growth * before[1, THETA]),
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
            room = FREE
            least = FREE
            if active > 0:
                if placed < handles:
                    placed = extend(growth, pieces, placed, handles, sizes, before)
                least = interval_least(
                    growth,
                    pieces,
                    statics,
                    h * (1.0 + WIDTH_ROUNDING) + 2.0 * rounding,
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
            if least <= margin:
                if least == -FREE:
                    h *= 0.5
                    target = -1.0
                    continue
                a = cython.cast(cython.Py_ssize_t, scratch[1])
                b = cython.cast(cython.Py_ssize_t, scratch[2])
                if row_gap(a, b, sizes, after) > margin:
                    h *= 0.5 if room < 0.5 * h or room >= h else room / h
                    target = -1.0
                    continue
                if tolerance <= 0.0:
                    clearance = pair_most(
                        growth, pieces, place - travel - h + rounding, 2.0 * rounding, a, b, benches, sizes, spare, after,
                        motion, scratch,
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
                    travel + h,
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
            if at_start and passed(first, opened, placed, opening, before):
                at_start = False
                followers = leaders if leaders < cap else cap
            h = room if room < 2.0 * h else 2.0 * h
        out[PROVEN] = travel
        return REACHED
