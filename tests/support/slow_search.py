"""First contact, computed a second time slowly and plainly: no code of core, every pair, tiny steps.

The head and every next handle are roots in a bracket, of many instants at once; rectangles are compared corner by
corner. Dips between two steps are looked at again in smaller ones.
"""

from dataclasses import dataclass

import numpy as np
from scipy.optimize import minimize_scalar

# A root is found to its last bits [1], in six or so steps of Newton's; by bisection alone it takes 53.
LAST_BITS = 3e-16
STEPS_MOST = 200
# Points on which the range of delta beyond half a turn is sampled [1].
CREST_POINTS = 100
# Rounds of SPLIT instants each in which a time is found: 40^8 is about 7e12.
ROUNDS = 8
# Steps of the head in the coarse pass, in shortest chords [1]; the smaller ones have SPLIT in two of these.
STEP = 0.12
SPLIT = 40
# Local minima of the clearance that are looked at again, and how often.
LOWEST = 4
REFINED = 3
# The last part of a run, where speeds grow without bound, is left out [1].
RUN = 1.0 - 1e-7


def in_plane(points):
    """Complex numbers as points (..., 2)."""
    return np.stack([points.real, points.imag], axis=-1)


def arc_length(theta):
    return 0.5 * (theta * np.sqrt(1.0 + theta**2) + np.arcsinh(theta))


def chord_squared(theta, delta):
    """Squared distance between two points of the spiral r = theta, delta apart in angle [rad]."""
    return delta**2 + 4.0 * theta * (theta + delta) * np.sin(0.5 * delta) ** 2


def root(rising, guess, low, high, within=LAST_BITS):
    """Zero of a function that rises from low to high: Newton's steps, and the middle if one leaves the bracket.

    rising: its value and its slope; within: the last step over the zero [1]; NaN where an end is NaN
    """
    at = np.clip(guess, low, high)
    for _ in range(STEPS_MOST):
        value, slope = rising(at)
        low, high = np.where(value < 0.0, at, low), np.where(value < 0.0, high, at)
        step = value / slope
        fine = ((low < at - step) & (at - step < high)) | (np.abs(step) <= within * at)
        step = np.where(fine, step, at - 0.5 * (low + high))
        at = at - step
        if not (np.abs(step) > within * at).any():
            break
    return at


def head_angle(arc):
    """Angle of the spiral r = theta at a length from the centre, where rounding may leave less than nothing."""
    arc = np.maximum(arc, 0.0)
    far = np.sqrt(2.0 * arc)
    return root(lambda theta: (arc_length(theta) - arc, np.hypot(1.0, theta)), far, 0.0 * far, far + 1.0)


def next_delta(theta, chord):
    """First delta at which points of r = theta are a chord apart; NaN where there is none before the first crest."""
    low = np.zeros_like(theta)
    high = np.full_like(theta, np.pi)
    beyond = np.flatnonzero(chord_squared(theta, high) < chord**2)
    if beyond.size:
        low[beyond], high[beyond] = np.pi, first_crest(theta[beyond])
        high[chord_squared(theta, high) < chord**2] = np.nan
    guess = chord / np.hypot(1.0, theta)
    return root(lambda delta: (chord_squared(theta, delta) - chord**2, slope(theta, delta)), guess, low, high)


def slope(theta, delta):
    """Derivative of chord_squared() by delta."""
    return 2.0 * (delta + 2.0 * theta * np.sin(0.5 * delta) ** 2 + theta * (theta + delta) * np.sin(delta))


def first_crest(theta):
    """First delta beyond half a turn from which on points come nearer again, or a whole turn."""
    deltas = np.linspace(np.pi, 2.0 * np.pi, CREST_POINTS)
    falls = slope(theta[:, None], deltas) < 0.0
    k = np.where(falls.any(axis=1), falls.argmax(axis=1), CREST_POINTS - 1)

    def falling(delta):
        bend = 2.0 * (1.0 + 2.0 * theta * np.sin(delta) + theta * (theta + delta) * np.cos(delta))
        return -slope(theta, delta), -bend

    return root(falling, deltas[k], deltas[k - 1], deltas[k])


def sizes_of(dragon):
    """Chords, lengths and widths of the benches."""
    lengths = np.array(dragon.lengths)
    return lengths - 2 * np.array(dragon.overhangs), lengths, np.array(dragon.widths)


@dataclass
class SlowDance:
    """One dragon on one spiral, head speed 1 m/s, so that time and travel are the same."""

    chords: np.ndarray
    lengths: np.ndarray
    widths: np.ndarray
    pitch: float
    start_turns: float

    @classmethod
    def of(cls, dragon, spiral):
        return cls(*sizes_of(dragon), spiral.pitch, spiral.start_turns)

    @property
    def growth(self):
        return self.pitch / (2.0 * np.pi)

    @property
    def way(self):
        return self.growth * arc_length(2.0 * np.pi * self.start_turns)

    def head(self, time):
        return head_angle((self.way - time) / self.growth)

    def thetas(self, heads, benches=None):
        """(T, n + 1) angles for (T,) head angles, of the first n benches or of all; NaN from where the chain folds."""
        columns = [np.asarray(heads, dtype=float)]
        for chord in self.chords[:benches]:
            columns.append(columns[-1] + next_delta(columns[-1], chord / self.growth))
        return np.stack(columns, axis=1)

    def handles_behind(self, heads, benches=None):
        """(T, n + 1, 2) for (T,) angles of the head [m]"""
        theta = self.thetas(heads, benches)
        return self.growth * theta[..., None] * np.stack([np.cos(theta), np.sin(theta)], axis=-1)

    def handles(self, times, benches=None):
        """(T, n + 1, 2) [m]"""
        return self.handles_behind(self.head(np.asarray(times)), benches)

    def folds(self, times):
        """(T,) whether a chord finds no place any more."""
        return np.isnan(self.thetas(self.head(np.asarray(times)))).any(axis=1)

    def end(self):
        """The last time at which the whole chain follows without a jump [s], good to about 1e-9."""
        times = np.linspace(0.0, self.way, 60)
        times[-1] -= 1e-12 * self.way
        folds = self.folds(times)
        if not folds.any():
            return self.way
        k = int(folds.argmax())
        return first_time(times[k - 1], times[k], self.folds)

    @property
    def sides(self):
        """Half lengths and half widths (n, 2) [m]."""
        return 0.5 * np.stack([self.lengths, self.widths], axis=-1)

    def clearance(self, times):
        """(T,) least separation [m] and (T, 2) its pair."""
        return nearest(benches_of(self.handles(times), self.sides))

    def pair_gap(self, time, pair):
        """Separation of one pair [m]."""
        handles = self.handles([time], max(pair) + 1)
        ends = [benches_of(handles[:, k : k + 2], self.sides[[k]]) for k in pair]
        return float(nearest(*ends)[0][0])

    def dip(self, low, high, pair):
        """Time and value of the least separation of one pair [s, m]."""
        result = minimize_scalar(
            lambda time: self.pair_gap(time, pair), bounds=(low, high), method="bounded", options={"xatol": 1e-9}
        )
        return result.x, result.fun


def first_time(low, high, holds):
    """Place, to the last bits, from which a condition holds that does not hold at low and holds at high."""
    for _ in range(ROUNDS):
        times = np.linspace(low, high, SPLIT + 1)
        k = max(1, int(np.argmax(holds(times))))
        low = times[k - 1]
        high = times[k]
    return high


def benches_of(handles, sides):
    """Middles and directions (..., n, 2) of benches between handles (..., n + 1, 2), and half lengths and widths."""
    along = handles[..., :-1, :] - handles[..., 1:, :]
    along /= np.linalg.norm(along, axis=-1, keepdims=True)
    return 0.5 * (handles[..., 1:, :] + handles[..., :-1, :]), along, sides


def corners_of(middle, along, sides):
    """Corners (..., n, 4, 2) of benches, one after another around each."""
    ahead = along * sides[:, :1]
    left = np.stack([-along[..., 1], along[..., 0]], axis=-1) * sides[:, 1:]
    return np.stack([middle + ahead + left, middle + ahead - left, middle - ahead - left, middle - ahead + left], -2)


def nearest(dragon, other=None):
    """(T,) least separation of benches of two dragons, or of one that share no handle [m], and (T, 2) the pair."""
    (middles, along, sides), (middles_b, along_b, sides_b) = dragon, other or dragon
    best = np.full(len(middles), np.inf)
    pairs = np.zeros((len(middles), 2), dtype=int)
    rows = np.arange(len(middles))
    for a in range(len(sides)):
        first = 0 if other else a + 2
        radii = np.linalg.norm(sides[a]) + np.linalg.norm(sides_b[first:], axis=-1)
        apart = np.linalg.norm(middles_b[:, first:] - middles[:, a, None], axis=-1)
        # No pair is nearer than its circles, nor the nearest one further than its middles.
        limit = np.fmin.reduce(apart, axis=1, initial=np.inf)
        t, b = np.nonzero(apart - radii < np.maximum(np.minimum(best, limit), 0.0)[:, None])
        if not t.size:
            continue
        exact = np.full(apart.shape, np.inf)
        box_a = (middles[t, a], along[t, a], sides[[a]])
        b_of_all = b + first
        exact[t, b] = rectangles_gap(*box_a, middles_b[t, b_of_all], along_b[t, b_of_all], sides_b[b_of_all])
        least = exact.argmin(axis=1)
        closer = exact[rows, least] < best
        best[closer] = exact[rows, least][closer]
        pairs[closer] = np.stack([np.full_like(least, a), least + first], axis=-1)[closer]
    return best, pairs


class Samples:
    """A function of time in samples that are closer around the lowest of them, and at the steepest ones if asked."""

    def __init__(self, measure, times, split=SPLIT, steepest=0):
        self.measure = measure
        self.times = np.asarray(times)
        self.values = measure(times)
        for _ in range(REFINED):
            self._refine(split, steepest)

    def _refine(self, split, steepest):
        edges = np.concatenate([[np.inf], self.values, [np.inf]])
        last = len(self.times) - 1
        low = np.flatnonzero((edges[:-2] >= self.values) & (self.values <= edges[2:]) & np.isfinite(self.values))
        brackets = [(max(k - 1, 0), min(k + 1, last)) for k in low[np.argsort(self.values[low])][:LOWEST]]
        steps = np.abs(np.diff(np.where(np.isfinite(self.values), self.values, 0.0)))
        brackets += [(k, k + 1) for k in np.argsort(steps)[len(steps) - steepest :]]
        if not low.size:
            return
        new = np.concatenate([np.linspace(*self.times[[*ends]], split + 1)[1:-1] for ends in brackets])
        self.times, first = np.unique(np.append(self.times, new), return_index=True)
        self.values = np.append(self.values, self.measure(new))[first]

    def least(self, until=np.inf):
        """Least value and its time, up to one."""
        k = int(np.argmin(np.where(self.times <= until, self.values, np.inf)))
        return float(self.values[k]), float(self.times[k])

    def at(self, time):
        """The value at a time."""
        return float(self.measure(np.array([time]))[0])


def rectangles_gap(ma, ua, ha, mb, ub, hb):
    """Signed separation of rectangles: centres, directions (N, 2), half lengths and widths (N, 2)."""
    facing = [face_gaps(ma, ua, ha, mb, ub, hb), face_gaps(mb, ub, hb, ma, ua, ha)]
    overlap = np.maximum(facing[0][0], facing[1][0])
    return np.where(overlap > 0.0, np.minimum(facing[0][1], facing[1][1]), overlap)


def face_gaps(ma, ua, ha, mb, ub, hb):
    """Largest gap along the face normals of a, and least distance of a corner of b to a."""
    axes = np.stack([ua, ua[:, ::-1] * [-1.0, 1.0]], axis=-1)
    corners = (corners_of(mb, ub, hb) - ma[:, None]) @ axes
    gaps = np.maximum(corners.min(axis=1), -corners.max(axis=1)) - ha
    distance = np.linalg.norm(np.maximum(np.abs(corners) - ha[:, None], 0.0), axis=-1).min(axis=1)
    return gaps.max(axis=-1), distance
