"""Feasible pitches, computed a second time slowly and plainly: no code of core, every pair, dense samples of the way.

Handles are found and rectangles compared as in slow_search.py, and dips between samples are looked at again in finer
ones.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from tests.support.slow_search import arc_length, head_angle, next_delta, rectangles_gap

# Steps in which the way is sampled, each up to a distance outside the circle; both in shortest chords [1]. Small
# circles have two dips within a tenth of a chord near the circle.
STEPS = ((0.02, 2.0), (0.2, 30.0))
FAR_SAMPLES = 120
# The deepest dips, and the steepest stretches, as towards a fold, are sampled again, in ROUNDS rounds of SPLIT
# samples.
DIPS, STEEPEST, ROUNDS, SPLIT = 4, 3, 3, 24


@dataclass
class SlowWay:
    """One dragon on one spiral from its start to the circle, the head's place given by its angle."""

    lengths: np.ndarray
    widths: np.ndarray
    chords: np.ndarray
    pitch: float
    start_turns: float
    radius: float

    @classmethod
    def of(cls, dragon, pitch, start_turns, radius, *more):
        lengths, overhangs = np.array(dragon.lengths), np.array(dragon.overhangs)
        return cls(lengths, np.array(dragon.widths), lengths - 2.0 * overhangs, pitch, start_turns, radius, *more)

    @property
    def growth(self):
        return self.pitch / (2.0 * np.pi)

    def heads(self):
        """Angles of the head, from the circle outwards, at which the way is sampled."""
        circle, start = self.radius / self.growth, 2.0 * np.pi * self.start_turns
        if start <= circle:
            return np.array([circle])
        inner, outer = arc_length(circle), arc_length(start)
        near = np.concatenate([np.arange(0.0, end, step) for step, end in STEPS])
        near = inner + np.unique(near) * self.chords.min() / self.growth
        arcs = np.concatenate([near, np.geomspace(near[-1], max(outer, near[-1]), FAR_SAMPLES)[1:], [outer]])
        arcs = np.unique(arcs[arcs <= outer])
        return np.clip(head_angle(arcs), circle, start)

    def handles(self, heads):
        """(T, n + 1, 2) [m]; NaN from where the chain folds."""
        columns = [heads]
        for chord in self.chords:
            columns.append(columns[-1] + next_delta(columns[-1], chord / self.growth))
        theta = np.stack(columns, axis=1)
        return self.growth * theta[..., None] * np.stack([np.cos(theta), np.sin(theta)], axis=-1)

    def clearance(self, heads):
        """(T,) least separation of all pairs that share no handle [m]; -inf where the chain folds."""
        handles = self.handles(heads)
        best = np.full(heads.size, np.inf)
        centres = 0.5 * (handles[:, 1:] + handles[:, :-1])
        along = handles[:, :-1] - handles[:, 1:]
        along /= np.linalg.norm(along, axis=-1, keepdims=True)
        half_diagonals = 0.5 * np.hypot(self.lengths, self.widths)
        sides = 0.5 * np.stack([self.lengths, self.widths], axis=-1)
        for apart in range(2, self.chords.size):
            away = np.linalg.norm(centres[:, apart:] - centres[:, :-apart], axis=-1)
            near = away - half_diagonals[apart:] - half_diagonals[:-apart] < np.maximum(best, 0.0)[:, None]
            t, a = np.nonzero(near)
            if not t.size:
                continue
            b = a + apart
            exact = np.full(away.shape, np.inf)
            exact[t, a] = rectangles_gap(centres[t, a], along[t, a], sides[a], centres[t, b], along[t, b], sides[b])
            best = np.minimum(best, exact.min(axis=1))
        return np.where(np.isnan(handles).any(axis=(1, 2)), -np.inf, best)

    def least(self):
        """Least clearance on the way [m], as far as the samples show it; -inf where the chain folds."""
        heads = self.heads()
        gaps = self.clearance(heads)
        for _ in range(ROUNDS):
            before, after = np.append(np.inf, gaps[:-1]), np.append(gaps[1:], np.inf)
            dips = np.flatnonzero((gaps <= before) & (gaps <= after) & np.isfinite(gaps))
            dips = dips[gaps[dips].argsort()[:DIPS]]
            if not dips.size:
                break
            ends = [(heads[max(k - 1, 0)], heads[min(k + 1, heads.size - 1)]) for k in dips]
            steps = np.abs(np.diff(np.where(np.isfinite(gaps), gaps, 0.0)))
            ends += [(heads[k], heads[k + 1]) for k in steps.argsort()[-STEEPEST:]]
            finer = np.concatenate([np.linspace(low, high, SPLIT) for low, high in ends])
            more = self.clearance(finer)
            heads, first = np.unique(np.append(heads, finer), return_index=True)
            gaps = np.append(gaps, more)[first]
        return float(gaps.min())


@dataclass
class SlowWays(SlowWay):
    """Several equal dragons, each turned by a part of a turn: only benches of two dragons count."""

    dragons: int = 2

    def clearance(self, heads):
        """(T,) least separation of any two benches of two dragons [m]."""
        handles = self.handles(heads)
        centres = 0.5 * (handles[:, 1:] + handles[:, :-1])
        along = handles[:, :-1] - handles[:, 1:]
        along /= np.linalg.norm(along, axis=-1, keepdims=True)
        sides = 0.5 * np.stack([self.lengths, self.widths], axis=-1)
        half_diagonals = np.hypot(*sides.T)
        best = np.full(heads.size, np.inf)
        for k in range(1, self.dragons):
            c, s = np.cos(2.0 * np.pi * k / self.dragons), np.sin(2.0 * np.pi * k / self.dragons)
            turn = np.array([[c, s], [-s, c]])
            away = np.linalg.norm((centres @ turn)[:, None] - centres[:, :, None], axis=-1)
            spare = away - half_diagonals[:, None] - half_diagonals
            t, a, b = np.nonzero(spare <= np.maximum(spare.min(axis=(1, 2)), 0.0)[:, None, None] + half_diagonals.max())
            exact = np.full(away.shape, np.inf)
            turned = (centres @ turn)[t, b], (along @ turn)[t, b]
            exact[t, a, b] = rectangles_gap(centres[t, a], along[t, a], sides[a], *turned, sides[b])
            best = np.minimum(best, exact.min(axis=(1, 2)))
        return best
