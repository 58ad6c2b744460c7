"""Several dragons on one clock, computed a second time slowly and plainly: no code of core, every pair of benches.

Each dragon follows its own slow path; its places are then turned, mirrored and moved as the path says. Only the times
at which a dance begins and ends are those of core.
"""

from itertools import combinations, pairwise

import numpy as np

from core import Spiral
from tests.support.slow_route import SlowRoute
from tests.support.slow_search import SlowDance, benches_of, in_plane, nearest


def travelled(dance, times):
    """Travels of the head (T,) at times (T,) of its own dance, whose passages end at given times [m]."""
    ends = [0.0, *(passage.until_time for passage in dance.passages)]
    travel = 0.0
    for (start, end), passage in zip(pairwise(ends), dance.passages, strict=True):
        travel = travel + passage.speed * (np.clip(times, start, end) - start)
    return travel + dance.head_speed * (np.maximum(times - ends[-1], 0.0) + np.minimum(times, 0.0))


class SlowPart:
    """One dragon: its handles at times of the performance."""

    def __init__(self, part):
        self.dance = part.dance
        self.delay = part.delay
        spiral = isinstance(part.dance.path, Spiral)
        self.slow = (SlowDance if spiral else SlowRoute).of(part.dance.dragon, part.dance.path)
        self.begin = part.dance.begin
        self.end = part.dance.end.time
        path = part.dance.path
        self.place = (path.centre, path.rotation, path.clockwise) if spiral else ((0.0, 0.0), 0.0, True)

    def handles(self, times):
        """(T, n + 1, 2) [m]"""
        own = self.slow.handles(travelled(self.dance, np.clip(times - self.delay, self.begin, self.end)))
        centre, rotation, clockwise = self.place
        places = own @ [1.0, 1.0j if clockwise else -1.0j] * np.exp(1j * rotation) + complex(*centre)
        return in_plane(places)


class SlowPerformance:
    """All dragons. chords: of all benches, over the highest speed of a head, by which a slow look chooses its steps."""

    def __init__(self, parts):
        self.parts = [SlowPart(part) for part in parts]
        fastest = max(max([p.speed for p in part.dance.passages] + [part.dance.head_speed]) for part in parts)
        self.chords = np.concatenate([part.slow.chords for part in self.parts]) / fastest

    def clearance(self, times):
        """(T,) least separation of benches of two dragons [m], and (T, 4) its dragons and benches."""
        times = np.asarray(times, dtype=float)
        best = np.full(len(times), np.inf)
        pairs = np.zeros((len(times), 4), dtype=int)
        placed = [benches_of(part.handles(times), part.slow.sides) for part in self.parts]
        for i, j in combinations(range(len(placed)), 2):
            gaps, benches = nearest(placed[i], placed[j])
            closer = gaps < best
            best[closer] = gaps[closer]
            pairs[closer] = np.hstack([np.broadcast_to([i, j], benches.shape), benches])[closer]
        return best, pairs
