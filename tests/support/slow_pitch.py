"""Feasible pitches, computed a second time slowly and plainly: no code of core, every pair, dense samples of the way.

Handles are found and rectangles compared as in slow_search.py, and dips between samples are looked at again in finer
ones.
"""

from dataclasses import dataclass

import numpy as np

from tests.support.slow_search import Samples, SlowDance, arc_length, benches_of, head_angle, nearest, sizes_of

# Steps in which the way is sampled, each up to a distance outside the circle; both in shortest chords [1]. Small
# circles have two dips within a tenth of a chord near the circle.
STEPS = ((0.02, 2.0), (0.2, 30.0))
FAR_SAMPLES = 120
# The steepest stretches, as towards a fold, are sampled again too; samples of each stretch.
STEEPEST = 3
SPLIT = 25


@dataclass
class SlowWay(SlowDance):
    """One dragon on one spiral from its start to the circle, the head's place given by its angle."""

    radius: float

    @classmethod
    def of(cls, dragon, pitch, start_turns, radius, *more):
        return cls(*sizes_of(dragon), pitch, start_turns, radius, *more)

    def heads(self):
        """Angles of the head, from the circle outwards, at which the way is sampled."""
        circle = self.radius / self.growth
        start = 2.0 * np.pi * self.start_turns
        if start <= circle:
            return np.array([circle])
        inner = arc_length(circle)
        outer = arc_length(start)
        near = np.concatenate([np.arange(0.0, end, step) for step, end in STEPS])
        near = inner + np.unique(near) * self.chords.min() / self.growth
        arcs = np.concatenate([near, np.geomspace(near[-1], max(outer, near[-1]), FAR_SAMPLES)[1:], [outer]])
        arcs = np.unique(arcs[arcs <= outer])
        return np.clip(head_angle(arcs), circle, start)

    def gaps(self, heads):
        """(T,) least separation of all pairs that share no handle [m]; -inf where the chain folds."""
        handles = self.handles_behind(heads)
        gaps, _ = nearest(benches_of(handles, self.sides))
        return np.where(np.isnan(handles).any(axis=(1, 2)), -np.inf, gaps)

    def least(self):
        """Least clearance on the way [m], as far as the samples show it; -inf where the chain folds."""
        return float(Samples(self.gaps, self.heads(), SPLIT, STEEPEST).values.min())


@dataclass
class SlowWays(SlowWay):
    """Several equal dragons, each turned by a part of a turn: only benches of two dragons count."""

    dragons: int = 2

    def gaps(self, heads):
        """(T,) least separation of any two benches of two dragons [m]."""
        middles, along, sides = benches_of(self.handles_behind(heads), self.sides)
        best = np.full(heads.size, np.inf)
        for k in range(1, self.dragons):
            c = np.cos(2.0 * np.pi * k / self.dragons)
            s = np.sin(2.0 * np.pi * k / self.dragons)
            turn = np.array([[c, s], [-s, c]])
            best = np.minimum(best, nearest((middles, along, sides), (middles @ turn, along @ turn, sides))[0])
        return best
