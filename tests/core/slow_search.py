"""First contact, computed a second time slowly and plainly: no code of core, every pair, tiny steps.

The head is found with scipy's brentq on the arc length, every next handle by plain bisection, many instants at once;
rectangles are compared corner by corner. Dips between two steps are looked at again in smaller ones.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.optimize import brentq, minimize_scalar
from shapely.geometry import Polygon

BISECTIONS = 58
# Times are found in so many rounds of SPLIT instants each: 40^8 is about 7e12.
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
    """Of two points of the spiral r = theta."""
    return delta**2 + 4.0 * theta * (theta + delta) * np.sin(0.5 * delta) ** 2


def first_rise(theta, chord):
    """(low, high) around the first delta at which the points are a chord apart; NaN where there is none."""
    low, high = np.zeros_like(theta), np.full_like(theta, np.pi)
    for k in np.flatnonzero(chord_squared(theta, high) < chord**2):
        delta = np.linspace(np.pi, 2.0 * np.pi, 400)
        value = chord_squared(theta[k], delta)
        crest = int(np.argmax(np.diff(value, append=-np.inf) < 0.0))
        lowest, highest = delta[max(crest - 1, 0)], delta[min(crest + 1, 399)]
        peak = minimize_scalar(
            lambda d, t=theta[k]: -chord_squared(t, d),
            bounds=(lowest, highest),
            method="bounded",
            options={"xatol": 1e-12},
        )
        top = peak.x if -peak.fun > value[crest] else delta[crest]
        low[k], high[k] = (np.pi, top) if chord_squared(theta[k], top) >= chord**2 else (np.nan, np.nan)
    return low, high


def next_theta(theta, chord):
    low, high = first_rise(theta, chord)
    for _ in range(BISECTIONS):
        middle = 0.5 * (low + high)
        short = chord_squared(theta, middle) < chord**2
        low, high = np.where(short, middle, low), np.where(short, high, middle)
    return theta + 0.5 * (low + high)


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
        left = (self.way - time) / self.growth
        return brentq(lambda t: arc_length(t) - left, 0.0, np.sqrt(2.0 * left) + 1.0, xtol=1e-15, rtol=9e-16)

    def thetas(self, heads):
        """(T, n + 1) angles for (T,) head angles; NaN from where the chain folds."""
        columns = [np.asarray(heads, dtype=float)]
        for chord in self.chords:
            columns.append(next_theta(columns[-1], chord / self.growth))
        return np.stack(columns, axis=1)

    def handles(self, times):
        """(T, n + 1, 2) [m]"""
        theta = self.thetas([self.head(time) for time in times])
        return self.growth * theta[..., None] * np.stack([np.cos(theta), np.sin(theta)], axis=-1)

    def folds(self, times):
        """(T,) whether a chord finds no place any more."""
        return np.isnan(self.thetas([self.head(time) for time in times])).any(axis=1)

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
        handles = self.handles([time])[0]
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

    def first_touch(self, margin=0.0, until=None):
        """Time and pair of the first instant with a separation <= margin, None if there is none."""
        stop = RUN * self.end() if until is None else until
        steps = 3 + int(stop / (STEP * self.chords.min()))
        last_two = np.empty(0)
        for times in np.array_split(np.linspace(0.0, stop, steps), 1 + steps // 400):
            reach = np.concatenate([last_two, times])
            last_two = times[-2:]
            gaps, pairs = self.clearance(reach)
            gaps -= margin
            if gaps[0] <= 0.0:
                return reach[0], tuple(pairs[0])
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
        found = minimize_scalar(
            lambda time: self.pair_gap(time, pair), bounds=(low, high), method="bounded", options={"xatol": 1e-9}
        )
        return found.x, found.fun


def first_time(low, high, holds):
    """Where something that does not hold at low, and holds at high, begins to hold, to the last bits."""
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
