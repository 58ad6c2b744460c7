"""Poses that seek a contact: two benches of the default dragon, every chord kept, all holes within a little less than
the answer of tolerance().

`python -m tests.campaigns.adversaries` says how near a million of them come. Half of those drawn at random turn as
far as the stray allows, half have the middle on the edge of all places for their turn. The nearest ones are then
varied at random, by less and less. Poses beyond the stray are taken back to its edge.
"""

import math

import numpy as np

from core import Dance, Dragon, Spiral, bench_poses, clearance_profile, tolerance, trajectory
from core.shapes.rectangles import frames, frames_separation
from tests.support.random_strays import random_strays, strays_of
from tests.support.scenes import lengths_and_widths

CIRCLE = 4.5  # radius of the turning circle [m]
# Poses drawn at random for a place; those of them that are varied, and how often [1].
DRAWS = 80_000
VARIED = 150
VARIANTS = 50
# Rounds of variants; size of the first as a part of the stray, and factor from each to the next [1].
ROUNDS = 16
FIRST = 0.3
SHRINK = 0.6
# Random times, and poses of the two nearest benches at each of them [1].
ANY_TIMES = 30
ANY_DRAWS = 1_000


def to_circle(pitch):
    """The default dragon on a spiral, and when its head is on the circle [s]."""
    spiral = Spiral(pitch)
    theta = CIRCLE / spiral.growth
    length = 0.5 * spiral.growth * (theta * math.hypot(1.0, theta) + math.asinh(theta))
    return Dance(Dragon(), spiral), spiral.length - length


class PairAtTime:
    """Two benches of a dance at a time. stray: largest distance of their holes from their places [m]"""

    def __init__(self, dance, time, pair, stray):
        handles = trajectory(dance, time).position
        bench = list(pair)
        self.stray = stray
        self.handles = np.array([handles[k : k + 2] for k in pair])
        self.chords = dance.dragon.chords[bench].tolist()
        self.sizes = lengths_and_widths(dance.dragon)[bench]
        heading = bench_poses(self.handles)[:, 0, 2]
        cosine = np.cos(heading)
        sine = np.sin(heading)
        self.turns = np.moveaxis(np.array([[cosine, sine], [-sine, cosine]]), -1, 0)

    def gaps(self, strays):
        """Gaps (N,) with the holes displaced in the benches' own frames: strays (N, bench, hole, 2) [m]."""
        both = []
        for k in range(2):
            poses = bench_poses(self.handles[k] + strays[:, k] @ self.turns[k])[:, 0]
            both.append(frames(poses, np.broadcast_to(self.sizes[k], (len(poses), 2))))
        return frames_separation(*both).separation

    def drawn(self, rng, count):
        """Strays (count, 2, 2, 2) at random."""
        return np.stack([random_strays(rng, chord, self.stray, count) for chord in self.chords], axis=1)

    def laid(self, shapes):
        """Strays of shapes (..., bench, 3): q and the middle of each, see random_strays.py."""
        parts = [strays_of(shapes[:, k, 0], shapes[:, k, 1:], self.chords[k], self.stray) for k in range(2)]
        return np.stack(parts, axis=1)

    def vary(self, rng, shapes, sought):
        """Vary the best shapes so far by less and less. sought: gets their gaps"""
        for k in range(ROUNDS):
            off = rng.normal(0.0, FIRST * SHRINK**k * self.stray, (VARIANTS, *shapes.shape))
            off[0] = 0.0
            strays = self.laid((shapes + off).reshape(-1, 2, 3))
            sought.append(self.gaps(strays))
            shapes = _shapes(strays[np.argsort(sought[-1])[:VARIED]])


def _shapes(strays):
    """q and the middle (N, bench, 3) of strays."""
    middle = 0.5 * strays.sum(axis=2)
    half = 0.5 * (strays[:, :, 0] - strays[:, :, 1])
    q = np.copysign(np.hypot(half[..., 0], half[..., 1]), half[..., 1])
    return np.concatenate([q[..., None], middle], axis=-1)


def seek(dance, known, part=0.999, draws=DRAWS):
    """Gaps [m] of poses of a default dance with this part of its tolerance, where and when benches are the nearest."""
    assert known.time is not None
    stray = part * known.stray
    rng = np.random.default_rng(7)
    sought = []
    at = known.time
    for time, pair in [(at, (0, 19)), (at - 1.0, (0, 19)), (known.stop, (0, 18)), (322.9, (0, 17)), (320.0, (1, 20))]:
        place = PairAtTime(dance, time, pair, stray)
        strays = place.drawn(rng, draws)
        sought.append(place.gaps(strays))
        place.vary(rng, _shapes(strays[np.argsort(sought[-1])[:VARIED]]), sought)
    others = clearance_profile(dance, rng.uniform(0.0, known.stop, ANY_TIMES))
    for time, (a, b) in zip(others.time.tolist(), others.benches.tolist(), strict=True):
        place = PairAtTime(dance, time, (a, b), stray)
        sought.append(place.gaps(place.drawn(rng, ANY_DRAWS)))
    return np.concatenate(sought)


def main():
    dance, stop = to_circle(0.55)
    known = tolerance(dance, stop=stop)
    gaps = seek(dance, known)
    result = "none touches" if gaps.min() > 0.0 else "some touch"
    most = 0.999 * known.stray
    print(f"{gaps.size} poses with strays up to {most:.6f} m: {result}; the nearest gap is {gaps.min():.2e} m")


if __name__ == "__main__":
    main()
