"""The highest speed of any handle over a run, with a proven upper bound."""

import cython
from cython.cimports.libc.math import fabs, sqrt

if not cython.compiled:  # the .pxd imports the same names for the compiler
    from core.kernels.constants import *
    from core.kernels.rates import BOUND_ROUNDING, climbs, fastest, lay_ahead, lively_chain, rate_bound
    from core.kernels.spiral import spiral_curvature

# Distance between samples near the centre of a spiral, where rates change ever faster: relative to the way that is left
# [1], and its least value relative to a step [1].
APPROACH = 0.25
LAST_SAMPLE = 1e-6
# Difference below which two rates count as equal [1].
NOISE = 1e-13
# Width to which the travel of a peak is found [m]: the height of a kink is then good to 1e-11.
PEAK_WIDTH = 1e-11
# Cost of an interval besides its links, in links [1]: its bounds, and a bisection where no Newton step converges.
INTERVAL_LINKS = 20
# Shortest step that is tried for the bound on the rest of the way alone, in chords [1].
LEAVING_STEP = 0.05
# Factor by which the excess of that bound over the rates must fall before the bound is tried again [1].
LEAVING_AGAIN = 0.5


def peaks_between(placed, handles, before, after):
    """Whether the rate of the fastest handle rises at the first of two chains, and does not rise at the second."""
    if placed == FOLDED or handles == FOLDED:
        return False
    a = fastest(placed, before)
    b = fastest(handles, after)
    return before[a, CLIMB] * before[a, RATE] > 0.0 >= after[b, CLIMB] * after[b, RATE]


# Way out. Let a route end with a spiral outwards, and let the benches from number m on have the same chord. At travel L
# let handle m stand at q on this spiral, at travel R let handle m + 1 stand at q or beyond, and let no rate exceed U on
# [L, R]. Then handles 0 to m are on the spiral, where curvature falls in the direction of travel: no handle is slower
# than the one before it (Vogt read backwards, bounds.py), so the rate of handle m is at least 1. By the chord lemma a
# link with front handle a and rear handle b multiplies rates by
#     cos alpha_a / cos alpha_b <= sqrt(1 - (k_a chord / 2)^2) / sqrt(1 - (k_b chord / 2)^2),   k_a <= k_b,
# where the roots of consecutive links of the same chord cancel. So no handle at q or beyond is faster than
#     E = product over the benches 0 to m of 1 / sqrt(1 - (k(q) chord / 2)^2).
# At any travel beyond R take a handle n that is not yet at q, and the last handle j < n that is at q or beyond: j >= m.
# Handle j + 1 is not at q yet, so handle j stands where handle m stood at an instant of [L, R], with the same benches
# behind it: the ratio of the rates of n and j is that of the handles m + n - j and m at that instant, at most U / 1.
# Hence
#     no rate exceeds E U from L on.
# Rounding. Places are good to SLIP, and the code checks that this is less than half of PLACE_SPARE. The curvature is
# taken PLACE_SPARE further back, because theta changes by less than 1 / growth per metre. Further than BLEND from its
# beginning the path is the spiral itself.


def way_out(pieces, alike, sizes, chain):
    """E above, with handle m = `alike` at q; FREE if q is not on a spiral outwards that ends the route."""
    p = pieces.shape[0] - 1
    if pieces[p, PIECE_KIND] != SPIRAL or pieces[p, SIGN] < 0.0 or chain[alike, PIECE] < p:
        return FREE
    if -chain[alike, PLACE] < pieces[p, S_START] + BLEND + PLACE_SPARE or chain[alike, SLIP] > 0.5 * PLACE_SPARE:
        return FREE
    growth = pieces[p, COIL_GROWTH]
    half_curvature = 0.5 * spiral_curvature(max(chain[alike, PIECE_THETA] - PLACE_SPARE / growth, 0.0)) / growth
    ratio = 1.0
    for k in range(alike + 1):
        sine = half_curvature * sizes[k, CHORD]
        if sine > SINE_LIMIT:
            return FREE
        ratio *= (1.0 + BOUND_ROUNDING) / sqrt(1.0 - sine * sine)
    return ratio


# Input:  a run from start to stop.
# State:  `rate`, the largest |rate| seen, and its `travel`. While sampling: the samples before and after that one.
#         While proving: the travel up to which `upper` bounds every |rate|; h, the step to try; the chains at both of
#         its ends; `links`, the number followed since the slack grew; E = `ratio` from the place `left` = q on,
#         FREE while no such place is known; `most` = U since then; `tried`, the E of the last try.
# Output: see Peak.
class Peak:
    """The largest |rate| of any handle over a run, with a proven upper bound.

    interval: of a scene with room for all benches; spare: rows for one more chain; calm: see lively_chain()
    alike: the first of the benches that have the same chord up to the last
    start, stop: the run [m of head travel]; rounding: largest error of a travel [m], by which the proven way begins
        before `start` and ends after `stop`
    rate: the largest |rate| [1], at `travel` [m]; upper: a bound on all rates, FREE if the proof was given up [1];
        intervals: number of intervals that were tried
    """

    def __init__(self, interval, spare, calm, alike, start, stop, rounding):
        self.interval = interval
        self.spare = spare
        self.calm = calm
        self.alike = alike
        self.start = start
        self.stop = stop
        self.rounding = rounding
        self.at = self.laid = 0
        self.ratio = self.tried = self.left = FREE
        self.most = 1.0
        self.rate = self.upper = self.travel = 0.0
        self.intervals = 0

    def sample(self, step):
        """Find the largest |rate|, by samples `step` apart [m], denser towards the centre of a spiral, then refined.

        Where rates hardly grow any more ("way out" above) only the end of the run is sampled; prove() finds larger
        rates.
        """
        scene = self.interval.scene
        low = high = last = travel = self.travel = self.start
        h = step
        self.rate = 0.0
        with cython.nogil:
            while True:
                rate = self.top_rate(scene, travel)
                if rate > self.rate:
                    self.rate = rate
                    self.travel = high = travel
                    low = last
                elif self.travel == last:
                    high = travel
                if travel >= self.stop:
                    break
                last = travel
                if scene.budget.stopped or scene.budget.left <= 0.0:
                    break
                left = self.stop - travel
                if scene.curve.is_spiral and h > APPROACH * left and left > LAST_SAMPLE * step:
                    h = APPROACH * left
                travel = travel + h if travel + h < self.stop and not self.gone(scene) else self.stop
            self.refine(scene, low, high, 0.0)

    def prove(self, step, slack, loosest, most_links):
        """Prove that no rate exceeds that of sample() by more than the slack, or find a larger one.

        The slack grows fourfold after every `most_links` links followed (an interval counts as INTERVAL_LINKS
        more), until the proof ends or is given up at `loosest`. step: the first one tried [m]
        """
        scene = self.interval.scene
        links = 0
        self.upper = self.rate
        self.intervals = 0
        travel = self.start - self.rounding
        self.ratio = FREE
        h = step
        end = self.stop + self.rounding
        if scene.curve.is_spiral and end > scene.place:  # the centre ends the way
            end = max(self.stop, scene.place)
        with cython.nogil:
            placed = lively_chain(
                scene.curve, scene.place - travel, scene.benches, self.calm, scene.sizes, self.interval.before
            )
            while travel < end:
                if scene.budget.uses_up(max(self.interval.handles, 0) + INTERVAL_LINKS):
                    self.upper = FREE
                    break
                self.intervals += 1
                h = min(h, end - travel)
                placed = lay_ahead(scene, self.interval, self.calm, placed, scene.place - travel - h)
                handles = self.interval.handles
                upper = FREE
                if handles != FOLDED:
                    if placed != FOLDED:
                        self.interval.widen(h, self.rounding)
                        upper = rate_bound(scene, self.interval, self.calm)
                    rate = fabs(self.interval.after[fastest(handles, self.interval.after), RATE])
                    self.keep(rate, travel + h, NOISE)
                links += max(handles, 0) + INTERVAL_LINKS
                if links > most_links:
                    links = 0
                    slack *= 4.0
                    if slack > loosest:
                        self.upper = FREE
                        break
                enough = self.rate + slack
                if self.ratio < FREE and h > LEAVING_STEP * scene.sizes[self.alike, CHORD]:
                    enough /= self.ratio
                if upper > enough and h > PEAK_WIDTH:
                    h *= 0.5
                    continue
                self.upper = max(self.upper, upper)
                if upper > self.rate * (1.0 + NOISE) and peaks_between(
                    placed, handles, self.interval.before, self.interval.after
                ):
                    self.refine(scene, travel, travel + h, NOISE)
                if not scene.curve.is_spiral and handles > self.alike and self.leaves(scene, upper, slack):
                    break
                travel += h
                placed = handles
                self.interval.swap()
                h *= 1.5
            self.upper = max(self.upper, self.rate)

    def leaves(self, scene, upper, slack):
        """Whether `upper` bounds the rates on all of the way to come, by those of the last steps ("way out" above)."""
        after = self.interval.after
        enough = self.rate + slack
        self.most = max(self.most, upper)
        if self.ratio * self.most > enough:
            ratio = way_out(scene.curve.pieces, self.alike, scene.sizes, after)
            self.ratio = FREE
            if ratio <= enough and ratio - 1.0 <= LEAVING_AGAIN * (self.tried - 1.0):
                self.ratio = self.tried = ratio
            self.left = -after[self.alike, PLACE]
            self.most = 1.0
            return False
        rear = self.alike + 1
        if after[rear, SLIP] > 0.5 * PLACE_SPARE or -after[rear, PLACE] < self.left + PLACE_SPARE:
            return False
        self.upper = max(self.upper, self.ratio * self.most)
        return True

    def gone(self, scene):
        """Whether handle alike + 1 of the sample has come to the first place of handle `alike` on its way out."""
        if scene.curve.is_spiral or self.laid <= self.alike:
            return False
        if self.ratio >= FREE:
            self.spare[self.alike, SLIP] = 0.0
            self.ratio = way_out(scene.curve.pieces, self.alike, scene.sizes, self.spare)
            self.left = -self.spare[self.alike, PLACE]
            return False
        return -self.spare[self.alike + 1, PLACE] >= self.left

    def top_rate(self, scene, travel):
        """The largest |rate| after a travel, 0 if the chain folds; sets self.at to the first handle that has it."""
        last = lively_chain(scene.curve, scene.place - travel, scene.benches, self.calm, scene.sizes, self.spare)
        scene.budget.spend(max(last, 0))
        self.at = fastest(last, self.spare)
        self.laid = last
        return fabs(self.spare[self.at, RATE]) if last != FOLDED else 0.0

    def refine(self, scene, low, high, noise):
        """Find the peak of the largest rate in [low, high], and keep it if it is larger by more than the noise.

        Method: bisection on whether the rate of the fastest handle still rises; it stops rising at a kink too.
        """
        while high - low > PEAK_WIDTH and not scene.budget.stopped:
            middle = 0.5 * (low + high)
            if middle <= low or middle >= high:
                break
            self.top_rate(scene, middle)
            climbs(scene.curve, self.at, scene.sizes, self.spare)
            if self.spare[self.at, CLIMB] * self.spare[self.at, RATE] > 0.0:
                low = middle
            else:
                high = middle
        self.keep(self.top_rate(scene, high), high, noise)

    def keep(self, rate, travel, noise):
        """Keep a rate as the largest if it exceeds the largest so far by more than the noise, within the run."""
        if rate > self.rate * (1.0 + noise) and self.start <= travel <= self.stop:
            self.rate = rate
            self.travel = travel
