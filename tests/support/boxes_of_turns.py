"""Boxes of turns of the contest's pitch, around places where a turn crosses a coil and beside them."""

import math

import numpy as np

from core import InvalidValue, Turn
from core.design.turn_boxes import turns_in
from core.design.turn_moves import box_of

GROWTH = 1.7 / (2.0 * math.pi)
LEAST = 1.43 / 0.999  # [m]
SMALL = np.array([0.006, 0.006, 0.006])  # half widths of a box: [m], [rad], [1]
# Middles of boxes where the turn crosses a coil: entry and exit radius [m], ratio.
CROSSING = [(2.3, 4.45, 1.2), (4.46, 2.38, 1.2), (2.22, 4.45, 1.0), (4.4, 2.32, 1.0), (4.0, 2.4, 1.0)]


def box_at(entry, leaving, ratio, half):
    centre = np.array([entry, (leaving - entry) / GROWTH, math.log(ratio)])
    turns = turns_in(GROWTH, centre[:, None], half[:, None])
    return box_of(1.7, turns, 0, centre, half, LEAST), centre


def place_in(centres, halves, rng):
    """A random place in each box."""
    return centres + halves * rng.uniform(-1.0, 1.0, centres.shape)


def turn_at(point):
    """The turn at a point of a box that the benches can follow; None if there is none."""
    entry = float(point[0])
    leaving = float(point[0] + GROWTH * point[1])
    try:
        turn = Turn(1.7, 30.0, math.exp(point[2]), start_turns=40.0, entry_radius=entry, exit_radius=leaving)
    except InvalidValue:
        return None
    return turn if min(turn.radii) >= LEAST else None


def turns_drawn(centre, half, count, inner):
    """Turns that the benches can follow at random points of a box, of `count`.

    inner: part of the half widths by which the points are at least off the middle [1]
    """
    rng = np.random.default_rng(7)
    off = rng.choice([-1.0, 1.0], (count, 3)) * rng.uniform(inner, 1.0, (count, 3))
    turns = [turn_at(point) for point in centre + half * off]
    return [turn for turn in turns if turn is not None]
