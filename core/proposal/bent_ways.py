"""Bent ways: a leg through ground so narrow that only the right place of each bend leaves benches enough room.

A bench on a bend reaches far inside its path. Around a single corner of angle a, with straight stretches as long as
chords before and behind it, the bench of chord c that reaches furthest inside has both handles on these stretches,
c / (2 cos(a / 2)) before and behind the corner, as long as the bend begins nearer to the corner: for every radius up to
c / (2 sin(a / 2)), which is more than half a chord. So a sharper bend takes as much ground inside, and more outside.
What helps is where the straight stretches lie: the corners of a way on the grid are moved, and the radius of all bends
is changed, until the benches, measured one by one, have the most room. Where stretches are short, bends may become
tighter than half a chord; whether benches can follow them is what the check of the dance decides.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from itertools import pairwise

import numpy as np

from core.proposal.needs import Needs
from core.proposal.walks import Pose, Step, long_enough, moved
from core.values import Floats

# Ways that are measured first, with corners at random places between those on the grid and the edge outside them, and
# up to this part of a chord along [1]: the best ones are improved.
SAMPLES, IMPROVED, ALONG = 120, 2, 0.5
# What a way may lack before it is improved [m]: more is hardly ever gained.
HOPELESS = 0.35
# Room is summed up over benches as if those this much further from an edge counted 1 / e of the nearest [m], coarsely
# and then finely.
SOFT = (0.03, 0.01)
# Most ways that are measured in each of both, for each of their numbers [1].
TRIES = 40
# First step of a corner [m] and of the logarithm of the radius [1]; accuracy of both, and of the room [m].
MOVE, GROW, WIDTH, ROOM = 0.3, 0.3, 1e-3, 1e-4
# Largest logarithm of a radius [1].
LOGARITHM_MOST = 10.0
# Most of a stretch that one bend may take [1]; least angle that is a bend, and the largest one [rad]; shortest stretch
# between two bends [m]; what a way lacks that cannot be laid out [m].
CUT_MOST, BEND_LEAST, BEND_MOST, SHORTEST, NO_WAY = 0.49, 1e-6, 2.8, 1e-3, 10.0


def bent_ways(
    ends: tuple[Pose, Pose],
    line: Floats,
    outwards: Floats,
    needs: Needs,
    rooms: Callable[[Pose, Sequence[Step]], Floats],
    measured: int,
) -> Iterator[list[Step]]:
    """The steps of bent ways between two poses, each with the most room that was found from another beginning.

    line: corners of a way on the grid between both (N, 2) [m]
    outwards: from each of its N - 2 inner corners to the edge outside its bend (N - 2, 2) [m]
    rooms: room of benches all along steps from a pose [m], see core/proposal/channels.py
    measured: most ways of which they are measured [1]
    """
    from scipy.optimize import minimize  # type: ignore[import-untyped]

    def lack(numbers: Floats, soft: float) -> float:
        """What the nearest benches lack to an edge, nearly [m]."""
        steps = _steps(*ends, numbers)
        if steps is None:
            return NO_WAY
        room = rooms(ends[0], steps)
        least = float(room.min())
        return soft * math.log(float(np.exp((least - room) / soft).sum())) - least

    count = min(SAMPLES, measured // 2)
    every = _sampled(ends, line, outwards, needs, count)
    sampled = [(lack(numbers, SOFT[0]), k, numbers) for k, numbers in enumerate(every)]
    most = (measured - count) // (IMPROVED * len(SOFT))
    for least, _, numbers in sorted(sampled, key=lambda one: one[:2])[:IMPROVED]:
        if least > HOPELESS + needs.free:
            return
        for soft in SOFT:
            simplex = np.vstack([numbers, numbers + np.diag([MOVE] * (numbers.size - 1) + [GROW])])
            options = {
                "initial_simplex": simplex,
                "maxfev": min(TRIES * numbers.size, most),
                "xatol": WIDTH,
                "fatol": ROOM,
            }
            numbers = minimize(lack, numbers, (soft,), method="Nelder-Mead", options=options).x
        steps = _steps(*ends, numbers)
        if steps is not None and long_enough(steps):
            yield steps


def backwards(steps: Sequence[Step]) -> list[Step]:
    """The steps of the same way from its end to its beginning."""
    return [(length, -curvature) for length, curvature in reversed(steps)]


def _sampled(ends: tuple[Pose, Pose], line: Floats, outwards: Floats, needs: Needs, count: int) -> list[Floats]:
    """Numbers of ways at random: straight stretches at both ends [m], the corners between [m], the logarithm of the
    radius."""
    random = np.random.default_rng(0)
    corners, along = line[1:-1], line[2:] - line[:-2]
    if not len(corners):
        corners, outwards, along = line.mean(axis=0, keepdims=True), np.zeros((1, 2)), line[1:] - line[:-1]
    along = ALONG * needs.chord * along / np.hypot(*along.T)[:, None]
    most = [
        max(float(side * ((corner - pose[:2]) @ (math.cos(pose[2]), math.sin(pose[2])))), MOVE)
        for pose, corner, side in zip(ends, corners[[0, -1]], (1.0, -1.0), strict=True)
    ]
    radii = np.log([needs.tight, needs.radii[0]])
    ways = []
    for _ in range(count):
        parts = random.uniform([0.0, -1.0], [1.0, 1.0], (len(corners), 2))
        placed = corners + parts[:, :1] * outwards + parts[:, 1:] * along
        stretches = most * random.uniform(0.1, 1.0, 2)
        ways.append(np.array([*stretches, *placed.ravel(), random.uniform(*radii)]))
    return ways


def _steps(begin: Pose, end: Pose, numbers: Floats) -> list[Step] | None:
    """The steps of the way with these numbers; None if it has none. A bend is tighter than the radius where a stretch
    is too short for it."""
    first, last = float(numbers[0]), float(numbers[1])
    if min(first, last) < SHORTEST or abs(float(numbers[-1])) > LOGARITHM_MOST:
        return None
    corners = [moved(begin, (first, 0.0))[:2], *numbers[2:-1].reshape(-1, 2).tolist(), moved(end, (-last, 0.0))[:2]]
    ways = [(q[0] - p[0], q[1] - p[1]) for p, q in pairwise(corners)]
    lengths = [first, *(math.hypot(*way) for way in ways), last]
    headings = [begin[2], *(math.atan2(y, x) for x, y in ways), end[2]]
    turns = [math.remainder(after - before, math.tau) for before, after in pairwise(headings)]
    if min(lengths) < SHORTEST or max(map(abs, turns)) > BEND_MOST:
        return None
    steps: list[Step] = []
    cut, radius = 0.0, math.exp(float(numbers[-1]))
    for turn, (before, after) in zip(turns, pairwise(lengths), strict=True):
        slope = math.tan(0.5 * abs(turn))
        taken = min(radius * slope, CUT_MOST * min(before, after)) if slope > BEND_LEAST else 0.0
        steps.append((before - cut - taken, 0.0))
        if taken:
            steps.append((taken / slope * abs(turn), math.copysign(slope / taken, turn)))
        cut = taken
    return [*steps, (last - cut, 0.0)]
