"""Folds in balls: proofs that a bench cannot follow any further (12.)."""

from __future__ import annotations

import math

from flint import arb

from core.proof.chain import Chain, SpiralStretch, slopes, squared_chord
from core.proof.pairs import Unproven, above, below

# Largest number of pieces of an angle delta before a fold counts as not proven; 20 to 60 are usual.
FOLD_PIECES = 10_000
# Search for the wall of 12.: its steps and its reach [rad]. Where a fold barely exists, F falls only over a
# short distance.
WALL_STEPS, WALL_MOST = (0.01, 0.0001), 7.0


def folding(chain: Chain, before: arb, after: arb) -> int:
    """The bench that can no longer follow when the head goes from one theta to another [rad]. raises: Unproven"""
    pose = chain.pose_at(0, after)
    try:
        pose.grow_to(chain.count)
    except Unproven:
        bench = len(pose.deltas)
    else:
        raise Unproven("every bench is shown to follow past the end that is claimed")
    verify_fold(chain, bench, before, after)
    return bench


def verify_fold(chain: Chain, bench: int, before: arb, after: arb) -> None:
    """Check that this bench can no longer follow when the head goes from one theta to another [rad].

    raises: Unproven
    """
    pose = chain.pose_at(0, after)
    pose.grow_to(bench)
    highest = before
    if bench:
        stretch = SpiralStretch(chain, 0, below(after), above(before), chain.count)
        while len(stretch.placed) < bench:
            stretch.grow()
        highest = stretch.thetas[bench]
    needed, lowest = chain.needed[bench], pose.thetas[bench]
    start = chain.pose_at(0, before)
    start.grow_to(bench + 1)
    wall = _wall(float(lowest), float(start.deltas[bench]))
    if not (start.deltas[bench] < wall and squared_chord(highest, arb(wall)) < needed):
        raise Unproven("no bound is found on the angle from bench {bench} to the next handle", bench=bench)
    if not _stays_short(lowest, wall, needed):
        raise Unproven("bench {bench} is not shown to fold", bench=bench)


def _wall(theta: float, d: float) -> float:
    """Approximate first local minimum of F(theta, .) beyond d [rad]."""
    for step in WALL_STEPS:
        falls, wall = False, d
        while wall < d + WALL_MOST:
            slope = wall + theta * (1.0 - math.cos(wall)) + theta * (theta + wall) * math.sin(wall)
            if falls and slope > 0.0:
                return wall
            falls = falls or slope < 0.0
            wall += step
    raise Unproven("no bound is found on the angle to the next handle")


def _stays_short(theta: arb, wall: float, needed: arb) -> bool:
    """Whether F(theta, d) < needed for all d from 0 to the wall [rad]."""
    pieces = [(0.0, wall)]
    for _ in range(FOLD_PIECES):
        if not pieces:
            return True
        low, high = pieces.pop()
        hull, middle = arb(low).union(arb(high)), arb((low + high) / 2)
        if not squared_chord(theta, middle) + slopes(theta, hull)[1] * (hull - middle) < needed:
            pieces += [(low, float(middle)), (float(middle), high)]
    return False
