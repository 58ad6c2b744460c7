"""First contact, computed a second time slowly and plainly: no code of core, every pair, tiny steps.

The head and every next handle are roots in a bracket, of many instants at once; rectangles are compared corner by
corner. Dips between two steps are looked at again in smaller ones.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.optimize import minimize_scalar
from shapely.geometry import Polygon

# A root is found to its last bits [1], in six or so steps of Newton's; by bisection alone it takes 53.
LAST_BITS, STEPS_MOST = 3e-16, 200
# Points on which the range of delta beyond half a turn is sampled, and rounds of that around the largest value [1].
CREST_POINTS, CREST_ROUNDS = 100, 4
# Rounds of SPLIT instants each in which a time is found: 40^8 is about 7e12.
ROUNDS = 8
# Steps of the head in the coarse pass, in shortest chords [1]; the smaller ones have SPLIT in two of these.
STEP = 0.12
SPLIT = 40
# Local minima of the clearance that are looked at again.
DIPS = 5
# The last part of a run, where speeds grow without bound, is left out [1].
RUN = 1.0 - 1e-7


def arc_length(theta):
    return 0.5 * (theta * np.sqrt(1.0 + theta**2) + np.arcsinh(theta))


def chord_squared(theta, delta):
    """Squared distance between two points of the spiral r = theta, delta apart in angle [rad]."""
    return delta**2 + 4.0 * theta * (theta + delta) * np.sin(0.5 * delta) ** 2


def root(rising, guess, low, high):
    """Zero of a function that rises from low to high: Newton's steps, and the middle if one leaves the bracket.

    rising: its value and its slope; NaN where an end is NaN
    """
    at = np.clip(guess, low, high)
    for _ in range(STEPS_MOST):
        value, slope = rising(at)
        low, high = np.where(value < 0.0, at, low), np.where(value < 0.0, high, at)
        step = value / slope
        fine = ((low < at - step) & (at - step < high)) | (np.abs(step) <= LAST_BITS * at)
        step = np.where(fine, step, at - 0.5 * (low + high))
        at = at - step
        if not (np.abs(step) > LAST_BITS * at).any():
            break
    return at


def head_angle(arc):
    """Angle of the spiral r = theta at a length from the centre, where rounding may leave less than nothing."""
    arc = np.maximum(arc, 0.0)
    far = np.sqrt(2.0 * arc)
    return root(lambda theta: (arc_length(theta) - arc, np.hypot(1.0, theta)), far, 0.0 * far, far + 1.0)


def next_delta(theta, chord):
    """First delta at which points of r = theta are a chord apart; NaN where there is none before the first crest."""
    low, high = np.zeros_like(theta), np.full_like(theta, np.pi)
    beyond = np.flatnonzero(chord_squared(theta, high) < chord**2)
    if beyond.size:
        low[beyond], high[beyond] = beyond_half_a_turn(theta[beyond], chord)

    def rising(delta):
        slope = delta + 2.0 * theta * np.sin(0.5 * delta) ** 2 + theta * (theta + delta) * np.sin(delta)
        return chord_squared(theta, delta) - chord**2, 2.0 * slope

    return root(rising, chord / np.hypot(1.0, theta), low, high)


def beyond_half_a_turn(theta, chord):
    """(low, high) around the first delta > pi; NaN where the distance falls again before it is a chord."""
    start, end = np.full_like(theta, np.pi), np.full_like(theta, 2.0 * np.pi)
    rows = np.arange(theta.size)
    for _ in range(CREST_ROUNDS):
        delta = start[:, None] + (end - start)[:, None] * np.linspace(0.0, 1.0, CREST_POINTS)
        value = chord_squared(theta[:, None], delta)
        falls = np.diff(value, axis=1) < 0.0
        crest = np.where(falls.any(axis=1), falls.argmax(axis=1), CREST_POINTS - 1)
        top, reached = delta[rows, crest], value[rows, crest] >= chord**2
        start = delta[rows, np.maximum(crest - 1, 0)]
        end = delta[rows, np.minimum(crest + 1, CREST_POINTS - 1)]
    return np.where(reached, np.pi, np.nan), np.where(reached, top, np.nan)


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
        lengths, overhangs = np.array(dragon.lengths), np.array(dragon.overhangs)
        return cls(lengths - 2 * overhangs, lengths, np.array(dragon.widths), spiral.pitch, spiral.start_turns)

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

    def handles(self, times, benches=None):
        """(T, n + 1, 2) [m]"""
        theta = self.thetas(self.head(np.asarray(times)), benches)
        return self.growth * theta[..., None] * np.stack([np.cos(theta), np.sin(theta)], axis=-1)

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

    def clearance(self, times):
        """(T,) least separation [m] and (T, 2) its pair."""
        handles = self.handles(times)
        best, pairs = np.full(len(times), np.inf), np.zeros((len(times), 2), dtype=int)
        centres = 0.5 * (handles[:, 1:] + handles[:, :-1])
        along = handles[:, :-1] - handles[:, 1:]
        along /= np.linalg.norm(along, axis=-1, keepdims=True)
        radii = 0.5 * np.hypot(self.lengths, self.widths)
        for apart in range(2, len(self.chords)):
            gap = np.linalg.norm(centres[:, apart:] - centres[:, :-apart], axis=-1) - radii[apart:] - radii[:-apart]
            t, a = np.nonzero(gap < np.maximum(best, 0.0)[:, None])
            if not t.size:
                continue
            b = a + apart
            sides = [np.stack([self.lengths[k], self.widths[k]], axis=-1) / 2.0 for k in (a, b)]
            exact = np.full(gap.shape, np.inf)
            exact[t, a] = rectangles_gap(centres[t, a], along[t, a], sides[0], centres[t, b], along[t, b], sides[1])
            least = exact.argmin(axis=1)
            value = exact[np.arange(len(times)), least]
            closer = value < best
            best[closer] = value[closer]
            pairs[closer] = np.stack([least, least + apart], axis=-1)[closer]
        return best, pairs

    def pair_gap(self, time, pair):
        """Separation of one pair [m], distances by shapely."""
        handles = self.handles([time], max(pair) + 1)[0]
        shapes = [self.polygon(handles, bench) for bench in pair]
        if shapes[0].intersection(shapes[1]).area > 0.0:
            centres = [0.5 * (handles[k] + handles[k + 1])[None] for k in pair]
            along = [(handles[k] - handles[k + 1])[None] / self.chords[k] for k in pair]
            sides = [np.array([[self.lengths[k], self.widths[k]]]) / 2.0 for k in pair]
            return float(rectangles_gap(centres[0], along[0], sides[0], centres[1], along[1], sides[1])[0])
        return float(shapes[0].distance(shapes[1]))

    def polygon(self, handles, bench):
        front, rear = handles[bench], handles[bench + 1]
        u = (front - rear) / np.linalg.norm(front - rear) * self.lengths[bench] / 2.0
        v = np.array([-u[1], u[0]]) * self.widths[bench] / self.lengths[bench]
        middle = 0.5 * (front + rear)
        return Polygon([middle + u + v, middle + u - v, middle - u - v, middle - u + v])

    def first_touch(self, margin=0.0):
        """Time and pair of the first instant with a separation <= margin, None if there is none."""
        gaps, pairs = self.clearance([0.0])
        if gaps[0] <= margin:
            return 0.0, tuple(pairs[0])
        stop = RUN * self.end()
        steps = 3 + int(stop / (STEP * self.chords.min()))
        last_two = np.empty(0)
        for times in np.array_split(np.linspace(0.0, stop, steps), 1 + steps // 400):
            reach = np.concatenate([last_two, times])
            last_two = times[-2:]
            gaps, pairs = self.clearance(reach)
            gaps -= margin
            touching = np.flatnonzero(gaps <= 0.0)
            last = touching[0] if touching.size else len(reach) - 1
            lows = [k for k in range(1, last) if gaps[k - 1] > gaps[k] <= gaps[k + 1]]
            brackets = [(reach[last - 1], reach[last])] if touching.size else []
            for k in sorted(lows, key=lambda k: gaps[k])[:DIPS]:
                fine = np.linspace(reach[k - 1], reach[k + 1], SPLIT + 1)
                inside = self.clearance(fine)[0] - margin
                if (inside <= 0.0).any():
                    k = int(np.argmax(inside <= 0.0))
                    brackets.append((fine[k - 1], fine[k]))
            if brackets:
                return self.crossing(*min(brackets), margin)
        return None

    def crossing(self, low, high, margin):
        time = first_time(low, high, lambda times: self.clearance(times)[0] <= margin)
        return time, tuple(self.clearance([time])[1][0])

    def dip(self, low, high, pair):
        """Time and value of the least separation of one pair [s, m], distances by shapely."""
        result = minimize_scalar(
            lambda time: self.pair_gap(time, pair), bounds=(low, high), method="bounded", options={"xatol": 1e-9}
        )
        return result.x, result.fun


def first_time(low, high, holds):
    """Place, to the last bits, from which a condition holds that does not hold at low and holds at high."""
    for _ in range(ROUNDS):
        times = np.linspace(low, high, SPLIT + 1)
        k = max(1, int(np.argmax(holds(times))))
        low, high = times[k - 1], times[k]
    return high


def rectangles_gap(ma, ua, ha, mb, ub, hb):
    """Signed separation of rectangles: centres, directions (N, 2), half lengths and widths (N, 2)."""
    facing = [face_gaps(ma, ua, ha, mb, ub, hb), face_gaps(mb, ub, hb, ma, ua, ha)]
    overlap = np.maximum(facing[0][0], facing[1][0])
    return np.where(overlap > 0.0, np.minimum(facing[0][1], facing[1][1]), overlap)


def face_gaps(ma, ua, ha, mb, ub, hb):
    """Largest gap along the face normals of a, and least distance of a corner of b to a."""
    left_a, left_b = (np.stack([-u[:, 1], u[:, 0]], axis=-1) for u in (ua, ub))
    beyond = []
    for i, j in ((1, 1), (1, -1), (-1, -1), (-1, 1)):
        corner = mb + i * hb[:, :1] * ub + j * hb[:, 1:] * left_b - ma
        beyond.append(np.stack([(corner * ua).sum(-1), (corner * left_a).sum(-1)], axis=-1))
    corners = np.stack(beyond)
    gaps = np.maximum(corners.min(axis=0), -corners.max(axis=0)) - ha
    distance = np.linalg.norm(np.maximum(np.abs(corners) - ha, 0.0), axis=-1).min(axis=0)
    return gaps.max(axis=-1), distance
