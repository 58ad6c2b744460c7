"""Where a figure fits: the places and rotations of its outline that leave most room to the edges of the free ground.

The outline itself is fitted, not a free circle or box around it, so that a ring may run around a well. Moving an
outline by a way changes its least clearance by at most this way. So a cell of places is dropped once the clearance in
its middle and half its diagonal do not reach what is needed, and divided otherwise.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from core.paths.route import Route
from core.proposal.figures import Shape
from core.proposal.free_ground import FreeGround, quartered
from core.proposal.needs import Needs
from core.proposal.walks import Pose
from core.values import Floats

# Distance of sampled points of a path [m], and their largest number.
STEP, POINTS_MAX = 0.4, 1_500
# Points of an outline, and cells of places kept at each division [1].
OUTLINE, KEPT = 48, 64
# Rotations within half a turn [1], cells along the longer side at the beginning, and divisions.
ROTATIONS, CELLS, DIVISIONS = 8, 8, 4


@dataclass(frozen=True)
class Sampled:
    """Points along a path: s (N,) [m], points (N, 2) [m], sides: ground that benches take beside it there (N,) [m]."""

    s: Floats
    points: Floats
    sides: Floats


def sampled(route: Route, needs: Needs, most: int = POINTS_MAX) -> Sampled:
    """Points along a path, with the room that benches need beside each: that of the sharpest bend within a chord."""
    s = np.linspace(route.begin, route.end, min(most, int((route.end - route.begin) / STEP) + 2))
    sides = needs.sides(route.curvature(s))
    reach = math.ceil(needs.chord / (s[1] - s[0]))
    wide = np.pad(sides, reach, mode="edge")
    windows = np.lib.stride_tricks.sliding_window_view(wide, 2 * reach + 1)
    return Sampled(s, route.position(s), windows.max(axis=1))


def base_rotation(ground: FreeGround) -> float:
    """Direction of the longest edge, which figures follow first [rad]."""
    x1, y1, x2, y2 = ground.edges[int(np.argmax(np.hypot(*(ground.edges[:, 2:] - ground.edges[:, :2]).T)))].tolist()
    return math.atan2(y2 - y1, x2 - x1)


def placements(ground: FreeGround, needs: Needs, shape: Shape, count: int) -> list[tuple[float, Pose]]:
    """Places of a shape with the room beside its benches there [m], the roomiest first; none without room.

    The poses are those of the shape's origin; the room is from the grid.
    """
    assert shape.pieces is not None
    outline = sampled(Route(shape.pieces), needs, OUTLINE)
    turns = base_rotation(ground) + math.pi / ROTATIONS * np.arange(1 if shape.round else ROTATIONS)
    cos, sin = np.cos(turns)[:, None], np.sin(turns)[:, None]
    x, y = outline.points.T
    turned = np.stack([cos * x - sin * y, sin * x + cos * y], axis=-1)
    low, high = ground.low, ground.high
    half = 0.5 * float((high - low).max()) / CELLS
    axes = [np.arange(a + half, b + half, 2.0 * half) for a, b in zip(low.tolist(), high.tolist(), strict=True)]
    middles = np.stack(np.meshgrid(*axes), axis=-1).reshape(-1, 2)
    which = np.repeat(np.arange(len(turns)), len(middles))
    centres = np.tile(middles, (len(turns), 1))
    best: list[tuple[float, Pose]] = []
    needed = needs.free - ground.node_error
    tx, ty = np.ascontiguousarray(turned[..., 0]), np.ascontiguousarray(turned[..., 1])
    for division in range(DIVISIONS + 1):
        field = ground.nearest_node(tx[which] + centres[:, :1], ty[which] + centres[:, 1:])
        room = (field - outline.sides).min(axis=1)
        order = np.argsort(-np.round(room, 6), kind="stable")
        if division == DIVISIONS:
            for k in order.tolist():
                if room[k] < needed or len(best) == count:
                    break
                pose = (float(centres[k, 0]), float(centres[k, 1]), float(turns[which[k]]))
                if all(_differ(pose, other, needs.chord) for _, other in best):
                    best.append((float(room[k]), pose))
            return best
        reach = half * math.sqrt(2.0)
        kept = order[room[order] + reach >= needed][:KEPT]
        if not len(kept):
            return []
        half *= 0.5
        which, centres = np.repeat(which[kept], 4), quartered(centres[kept], half)
    return best


def _differ(pose: Pose, other: Pose, way: float) -> bool:
    """True if two poses are different places or rotations for people."""
    return math.dist(pose[:2], other[:2]) > way or abs(math.remainder(pose[2] - other[2], math.pi)) > 0.3
