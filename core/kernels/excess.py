"""First time at which a handle is faster than a limit, with a proof that none was before."""

import cython

import core.kernels.constants as of_python  # only for results: compiled enums are plain numbers

if not cython.compiled:  # the .pxd imports the same names for the compiler
    from core.kernels.constants import *
    from core.kernels.rates import certain_rate, lay_ahead, lively_chain, rate_bound


# Input:  a run from start to stop, and the limit of every |rate|.
# State:  travel, up to which no |rate| exceeded `kept`; h, the step to try; both chains at its ends.
# Output: KEPT all the way; EXCEEDED between `proven` and `exceeded`, at most `width` apart; else UNDECIDED, proven so
#         far.
#
# No |rate| between the ends of a step exceeds rate_bound() (rates.py). So a step with a bound below the limit is
# passed, and any other step is halved. A step of `width` ends in one of three ways. If the limit is exceeded at its
# end, the first excess lies in this step or at its end, because no step before had one. If its bound is below `kept`, a
# limit so little higher that it counts as the same, the step is passed: its peak just reaches the limit. Otherwise the
# search gives up.
#
# Rounding. The way begins before `start` and ends after `stop` by the error of a travel, and `proven` lies by as much
# before the last step passed. A step ends `rounding` after the travel at which an excess is looked for. So this travel
# lies in the step, whatever the error of its end, and there the limit is exceeded for certain (certain_rate()).
class Excess:
    """The first travel in a run at which a |rate| exceeds a limit.

    interval: of a scene with room for all benches; calm: as in rates.lively_chain()
    proven: travel before which no |rate| exceeds the limit that counts as the same [m]; exceeded: travel at which one
        exceeds it, or the end of the run [m]; handle, rate: that handle and its rate
    """

    def __init__(self, interval, calm):
        self.interval = interval
        self.calm = calm
        self.proven = self.exceeded = self.rate = 0.0
        self.handle = 0

    def run(self, start, stop, step, limit, kept, width, rounding, most_links):
        """Search from start to stop [m of head travel]; returns how it ended.

        step: the first one tried [m]; limit, kept, width: see above; rounding: largest error of a travel [m];
        most_links: number of links followed before the search gives up
        """
        scene = self.interval.scene
        travel = start - rounding
        end = stop + rounding
        h = 2.0 * rounding
        links = 0
        outcome = Judged.KEPT
        self.exceeded = stop
        self.handle = 0
        self.rate = 0.0
        with cython.nogil:
            if scene.curve.is_spiral and end > scene.place:  # the centre ends the way
                end = max(stop, scene.place)
            placed = lively_chain(
                scene.curve, scene.place - travel, scene.benches, self.calm, scene.sizes, self.interval.before
            )
            while travel < end:
                h = min(h, end - travel)
                upper = FREE
                rate = 1.0
                k = 0
                placed = lay_ahead(scene, self.interval, self.calm, placed, scene.place - travel - h)
                if self.interval.handles != FOLDED:
                    links += self.interval.handles
                    if placed != FOLDED:
                        self.interval.widen(h, rounding)
                        upper = rate_bound(scene, self.interval, self.calm)
                        if upper < FREE:
                            rate, k = certain_rate(self.interval, rounding)
                links += 1
                if links > most_links or scene.budget.uses_up(max(self.interval.handles, 0) + 1):
                    outcome = Judged.UNDECIDED
                    break
                if upper > limit and h > width:
                    h *= 0.5
                    continue
                if rate > limit:
                    outcome = Judged.EXCEEDED
                    self.exceeded = min(max(travel + h - rounding, start), stop)
                    self.handle = k
                    self.rate = rate
                    break
                if upper > kept:
                    outcome = Judged.UNDECIDED
                    break
                placed = self.interval.handles
                self.interval.swap()
                opened = travel < start
                travel += h
                h = step if opened else 1.5 * h
        self.proven = min(max(travel - rounding, start), stop)
        return of_python.Judged(outcome)
