"""When a handle is first faster than a limit, with a proof that none was before."""

import cython

if not cython.compiled:  # for the compiler the same stands in the .pxd
    from core.kernels.chain import extend
    from core.kernels.constants import *
    from core.kernels.speed import certain_rate, lively_chain, rate_bound


# Input:  a run from start to stop, and the limit of every |rate|.
# State:  travel, up to which no |rate| exceeded `kept`; h, the step that is tried; both chains at its ends.
# Output: kept, all the way; exceeded, between `proven` and `found`, at most `width` apart; stuck, proven so far.
#
# No |rate| between the ends of a step exceeds rate_bound() (speed.py), so a step with a bound below the limit is
# passed, and any other halved. At `width` it is one of three. Its end exceeds the limit: then the first excess lies
# in this step or at its end, as no step before had one. Or its bound is below `kept`, a limit only so little higher
# that it counts as the same: then it is passed, a peak that just reaches the limit. Or neither: the search gives up.
#
# Rounding. The way begins before `start` and ends after `stop` by what a travel may be off by, and `proven` is so much
# before what was passed. A step ends `rounding` after the travel at which it is asked for an excess, so that this one
# lies in the step whatever its end is off by, and there the limit is exceeded for certain (certain_rate()).


def first_excess(
    growth, pieces, place, start, stop, step, limit, kept, width, rounding, budget, benches, calm, sizes, rows, motion,
    out
):  # fmt: skip
    """The first travel in [start, stop] at which a |rate| exceeds the limit.

    step: the first one tried [m]; rounding: what a travel may be off by [m]; budget: links followed before the search
    gives up; calm: as in speed.lively_chain()
    out: (5,) outcome (0 kept, 1 exceeded, 2 stuck), proven up to [m], found at [m], handle, its rate
    """
    before: cython.double[:, ::1] = rows[0]
    after: cython.double[:, ::1] = rows[1]
    travel = start - rounding
    end = stop + rounding
    h = 2.0 * rounding
    links = 0
    with cython.nogil:
        if pieces.shape[0] == 0 and end > place:  # no further than the centre
            end = max(stop, place)
        out[0] = 0.0
        out[2] = stop
        out[3] = 0.0
        out[4] = 0.0
        placed = lively_chain(growth, pieces, place - travel, benches, calm, sizes, before)
        while travel < end:
            if h > end - travel:
                h = end - travel
            upper = FREE
            rate = 1.0
            k = 0
            handles = lively_chain(growth, pieces, place - travel - h, benches, calm, sizes, after)
            if handles >= 0:
                links += handles
                if 0 <= placed < handles:
                    placed = extend(growth, pieces, placed, handles, sizes, before)
                if placed >= 0:
                    upper = rate_bound(
                        growth, pieces, h, rounding, handles, benches, calm, sizes, before, after, motion
                    )
                    if upper < FREE:
                        rate, k = certain_rate(pieces, rounding, handles, after, motion)
            links += 1
            if links > budget:
                out[0] = 2.0
                break
            if upper > limit and h > width:
                h *= 0.5
                continue
            if rate > limit:
                out[0] = 1.0
                out[2] = min(max(travel + h - rounding, start), stop)
                out[3] = k
                out[4] = rate
                break
            if upper > kept:
                out[0] = 2.0
                break
            placed = handles
            before, after = after, before
            opened = travel < start
            travel += h
            h = step if opened else 1.5 * h
        out[1] = min(max(travel - rounding, start), stop)
