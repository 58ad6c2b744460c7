"""The ground that benches cover on a path, measured bench by bench instead of by one width beside it.

On a bend a bench reaches far inside the path and little outside, which one width for both sides leaves out. Here the
bench itself stands on the path, with both handles on it, and its rectangle is compared with every edge: its corners
with the edges, and the ends of the edges with the rectangle. That is the distance of the two unless an edge crosses it
with both ends outside, as a thin wall may; so this too selects what is worth a check.
"""

from __future__ import annotations

import math

import numpy as np

from core.proposal.free_ground import PAIRS_AT_ONCE, FreeGround
from core.proposal.needs import Needs
from core.values import Floats

# Distance of points of a path between which a handle is placed [m].
DENSE = 0.1
# Rounds that place the rear handle, of which each leaves at most 0.6 of the error [1].
ROUNDS = 14
# Longest way along a path between both handles of a bench, in chords [1]: half a circle.
SPAN = 0.5 * math.pi


def standing(s: Floats, points: Floats, fronts: Floats, chord: float) -> tuple[Floats, Floats]:
    """The front handles (M, 2) of benches at places on a path, and their rear handles (M, 2) [m].

    s, points: dense points (N, 2) of the path and their places (N,) [m]; fronts: places of front handles (M,), SPAN
    chords behind the beginning at least [m]
    """

    def at(places: Floats) -> Floats:
        return np.stack([np.interp(places, s, points[:, 0]), np.interp(places, s, points[:, 1])], axis=-1)

    front, back = at(fronts), np.full(len(fronts), chord)
    for _ in range(ROUNDS):
        back = np.clip(back + chord - np.hypot(*(front - at(fronts - back)).T), chord, SPAN * chord)
    return front, at(fronts - back)


def room_beside(ground: FreeGround, needs: Needs, front: Floats, rear: Floats) -> Floats:
    """Distance of the longest and widest bench between handles (M, 2) from the nearest edge (M,) [m]: below 0 where a
    corner is outside the free ground, or an end of an edge within the bench."""
    step = max(1, PAIRS_AT_ONCE // (4 * len(ground.edges)))
    parts = [_room(ground, needs, front[k : k + step], rear[k : k + step]) for k in range(0, len(front), step)]
    return np.concatenate(parts) if parts else np.empty(0)


def _room(ground: FreeGround, needs: Needs, front: Floats, rear: Floats) -> Floats:
    middle, way = 0.5 * (front + rear), front - rear
    ahead = way / np.hypot(*way.T)[:, None]
    side = np.stack([-ahead[:, 1], ahead[:, 0]], axis=-1)
    length, width = 0.5 * needs.chord + needs.overhang, needs.straight_side
    corners = [middle + a * length * ahead + b * width * side for a in (-1.0, 1.0) for b in (-1.0, 1.0)]
    of_corners = ground.clearance(np.concatenate(corners)).reshape(4, -1).min(axis=0)
    apart = ground.edges[:, :2] - middle[:, None]
    beyond = np.abs((apart * ahead[:, None]).sum(axis=-1)) - length
    beside = np.abs((apart * side[:, None]).sum(axis=-1)) - width
    outside = np.hypot(np.maximum(beyond, 0.0), np.maximum(beside, 0.0))
    of_ends = (outside + np.minimum(np.maximum(beyond, beside), 0.0)).min(axis=1)
    room: Floats = np.minimum(of_corners, of_ends)
    return room
