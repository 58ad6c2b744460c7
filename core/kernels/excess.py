"""When a handle is first faster than a limit, with a proof that none was before."""

import cython
from cython.cimports.libc.math import fabs

if not cython.compiled:  # for the compiler the same stands in the .pxd
    from core.kernels.chain import extend
    from core.kernels.constants import *
    from core.kernels.speed import fastest, lively_chain, rate_bound


# Input:  a run from start to stop, and the limit of every |rate|.
# State:  travel, up to which no |rate| exceeded `kept`; h, the step that is tried; both chains at its ends.
# Output: kept, all the way; exceeded, between `proven` and `found`, at most `width` apart; stuck, proven so far.
#
# No |rate| between the ends of a step exceeds rate_bound() (speed.py), so a step with a bound below the limit is
# passed, and any other halved. At `width` it is one of three. Its end exceeds the limit: then the first excess lies
# in this step or at its end, as no step before had one. Or its bound is below `kept`, a limit only so little higher
# that it counts as the same: then it is passed, a peak that just reaches the limit. Or neither: the search gives up.


def first_excess(
    growth, pieces, place, start, stop, step, limit, kept, width, budget, benches, calm, sizes, rows, motion, out
):
    """The first travel in [start, stop] at which a |rate| exceeds the limit.

    step: the first one tried [m]; budget: links followed before the search gives up; calm: as in speed.lively_chain()
    out: (5,) outcome (0 kept, 1 exceeded, 2 stuck), proven up to [m], found at [m], handle, its rate
    """
    before: cython.double[:, ::1] = rows[0]
    after: cython.double[:, ::1] = rows[1]
    travel = start
    h = step
    links = 0
    with cython.nogil:
        out[0] = 0.0
        out[2] = stop
        out[3] = 0.0
        out[4] = 0.0
        placed = lively_chain(growth, pieces, place - start, benches, calm, sizes, before)
        if placed >= 0:
            k = fastest(placed, before)
            if fabs(before[k, RATE]) > limit:
                out[0] = 1.0
                out[2] = start
                out[3] = k
                out[4] = fabs(before[k, RATE])
        while travel < stop and out[0] == 0.0:
            if h > stop - travel:
                h = stop - travel
            upper = FREE
            handles = lively_chain(growth, pieces, place - travel - h, benches, calm, sizes, after)
            if handles >= 0:
                links += handles
                if 0 <= placed < handles:
                    placed = extend(growth, pieces, placed, handles, sizes, before)
                if placed >= 0:
                    upper = rate_bound(growth, pieces, h, handles, benches, calm, sizes, before, after, motion)
            links += 1
            if links > budget:
                out[0] = 2.0
                break
            if upper > limit and h > width:
                h *= 0.5
                continue
            if handles >= 0:
                k = fastest(handles, after)
                if fabs(after[k, RATE]) > limit:
                    out[0] = 1.0
                    out[2] = travel + h
                    out[3] = k
                    out[4] = fabs(after[k, RATE])
                    break
            if upper > kept:
                out[0] = 2.0
                break
            travel += h
            placed = handles
            before, after = after, before
            h *= 1.5
        out[1] = travel
