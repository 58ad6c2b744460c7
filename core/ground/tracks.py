"""Tracks: the stretches of a path that the front handles of benches of one size pass.

The place of a bench follows from its chord and the place s of its front handle, because its rear handle is the first
point of the path behind that at the chord. So bench k sweeps the ground that a lone bench of its size sweeps while its
front handle passes all places of handle k. Benches of one size together sweep the ground of a lone one over the union
of these stretches. In a dance each bench follows the one before it, so that the stretches of a uniform body form one,
as long as the dragon and its way together. The cost of a sweep follows from this length, not from the number of benches
times the time.

The places of handle k + 1 are one chord behind those of handle k, and form an interval too. No handle reverses on a
route, nor on a spiral while half of the chord times the curvature is at most SINE_LIMIT (core/kernels/bounds.py), so
the ends of one interval give those of the next. Nearer to the centre of a spiral, let g(theta) = theta + delta(theta)
be the rear handle's angle. As delta falls with theta (core/kernels/spiral.py), on [a, b]
    a + delta(b) <= g <= b + delta(a),
and the equation of the chord gives
    g' = 1 - (2 theta + delta) (1 - cos delta) / (theta (1 - cos delta) + delta + theta (theta + delta) sin delta),
where all but the sine grow with theta and with delta up to pi, so that values at the ends bound g'. Where it keeps its
sign, g is largest and least at the ends, and elsewhere beyond them by at most |g'| (b - a), of the second order in
b - a. Intervals that may hold the least or the largest value are halved until their bound is within REVERSAL of g.
"""

from __future__ import annotations

import heapq
import math
from dataclasses import dataclass

import numpy as np

from core import kernels
from core.dance import Dance
from core.kernels.constants import CHAIN_COLUMNS, CHORD, LAG, SINE_LIMIT, SIZE_COLUMNS, SLIP
from core.paths.path import Path
from core.values import Floats

# Width to which places are found where a handle reverses [m].
REVERSAL = 1e-8
# Rounding of places, added to that of the chain: absolute [m], and relative to the longest way [1]; the latter exceeds
# TRAVEL_ROUNDING of core/contact/search.py.
PLACE_ROUNDING, WAY_ROUNDING = 1e-11, 1e-14


@dataclass(frozen=True, slots=True)
class Track:
    """The places that the front handles of all benches of one size pass.

    bench: the first of these benches; stretches: (low, high, spare) [m], in order and apart: every place from low to
    high; each of these two is at most `spare` outside the places that the handles really pass
    """

    bench: int
    stretches: tuple[tuple[float, float, float], ...]

    @property
    def length(self) -> float:
        """Total length of the stretches [m]."""
        return sum(high - low for low, high, _ in self.stretches)


def tracks(dance: Dance, begin: float, until: float) -> list[Track]:
    """The tracks of all sizes of benches between two travels of the head [m]."""
    dragon = dance.dragon
    lows, highs, spares = stretches(dance, begin, until)
    sizes = np.stack([dragon.chords, dragon.lengths, dragon.widths], axis=1)
    _, firsts, kinds = np.unique(sizes, axis=0, return_index=True, return_inverse=True)
    result = []
    for kind, bench in enumerate(firsts.tolist()):
        alike = np.flatnonzero(kinds.reshape(-1) == kind)
        alike = alike[np.argsort(lows[alike])]
        furthest = np.maximum.accumulate(highs[alike])
        apart = np.flatnonzero(lows[alike[1:]] > furthest[:-1]) + 1
        parts = np.split(alike, apart)
        ends = ((lows[part].min(), highs[part].max(), spares[part].max()) for part in parts)
        result.append(Track(bench, tuple((float(low), float(high), float(spare)) for low, high, spare in ends)))
    return result


def stretches(dance: Dance, begin: float, until: float) -> tuple[Floats, Floats, Floats]:
    """Least and largest place s of the front handle of every bench (n,), with the spare that both have (n,) [m]."""
    path, chords = dance.path, dance.dragon.chords
    spares = np.full(chords.size, PLACE_ROUNDING + path.slide)
    inner, outer = path.lags(np.array([until, begin]), dance.end.theta or 0.0).tolist()
    lags = [(inner, outer)]
    gentle = path.gentle_lag(2.0 * SINE_LIMIT / float(chords.max()))
    while len(lags) <= chords.size and lags[-1][0] < gentle:
        lags.append(_behind(path, *lags[-1], float(chords[len(lags) - 1]), gentle))
    turned = len(lags) - 1
    spares[1:] += REVERSAL if turned else 0.0
    ends = [_chain(path, lag, chords[turned:]) for lag in lags[-1]]
    front = np.array(lags[:turned]).reshape(-1, 2).T
    highs, lows = (path.along(np.concatenate([some, rest])) for some, (rest, _) in zip(front, ends, strict=True))
    spares += max(slip for _, slip in ends) + WAY_ROUNDING * max(np.abs([lows, highs]).max(), path.place)
    return lows - spares, highs + spares, 2.0 * spares


def _chain(path: Path, lag: float, chords: Floats) -> tuple[Floats, float]:
    """Lags of the front handles of benches (n,), the first one at `lag`, and the largest error of these handles [m]."""
    last = chords.size
    sizes, chain = np.zeros((last + 1, SIZE_COLUMNS)), np.zeros((last + 1, CHAIN_COLUMNS))
    sizes[:last, CHORD] = chords
    path.follow(lag, last, sizes, chain)
    kernels.chain_rounding(path.curve, last, sizes, chain)
    return chain[:last, LAG], float(chain[:last, SLIP].max(initial=0.0))


def _behind(path: Path, low: float, high: float, chord: float, gentle: float) -> tuple[float, float]:
    """Range of the polar angle of a rear handle on a spiral, to within REVERSAL; the front one is between two angles.

    low: the angle further in; gentle: angle from which outwards the rear handle does not reverse
    """
    chord2 = (chord / path.growth) ** 2
    low = max(low, path.last_lag(chord))
    bent = min(high, gentle)

    def delta(theta: float) -> float:
        return float(kernels.first_root(theta, chord2))

    def most(sign: float, a: float, b: float, at_a: float, at_b: float) -> float:
        """Upper bound of sign g on [a, b]."""
        coarse = b + at_a if sign > 0.0 else -(a + at_b)
        if at_a > math.pi:
            return coarse
        least, largest = _slopes(a, b, at_a, at_b)
        rise, fall = (largest, -least) if sign > 0.0 else (-least, largest)
        from_a = sign * (a + at_a) + max(rise, 0.0) * (b - a)
        from_b = sign * (b + at_b) + max(fall, 0.0) * (b - a)
        return min(coarse, from_a, from_b)

    def bound(sign: float) -> float:
        """Upper bound of sign g up to `bent`, at most the width of an interval above its largest value."""
        width = REVERSAL / (path.growth * (bent + 1.0))
        ends = low, bent, delta(low), delta(bent)
        heap = [(-most(sign, *ends), *ends)]
        while True:
            least, a, b, at_a, at_b = heapq.heappop(heap)
            if -least - max(sign * (a + at_a), sign * (b + at_b)) <= width:
                return -least
            middle = 0.5 * (a + b)
            at = delta(middle)
            for part in ((a, middle, at_a, at), (middle, b, at, at_b)):
                heapq.heappush(heap, (-most(sign, *part), *part))

    outer = bound(1.0)
    return -bound(-1.0), max(outer, high + delta(high)) if high > gentle else outer


def _slopes(a: float, b: float, at_a: float, at_b: float) -> tuple[float, float]:
    """Bounds of g' between two angles, where delta falls from `at_a`, at most pi, to `at_b`."""
    low, high = 1.0 - math.cos(at_b), 1.0 - math.cos(at_a)
    sines = math.sin(at_a), math.sin(at_b)
    highest = 1.0 if at_b < 0.5 * math.pi < at_a else max(sines)
    below = a * low + at_b + a * (a + at_b) * min(sines)
    above = b * high + at_a + b * (b + at_a) * highest
    return 1.0 - (2.0 * b + at_a) * high / below, 1.0 - (2.0 * a + at_b) * low / above
