"""How a path suits a dragon, from points along it: room to the edges, room between its own strands, length and turns.

This is a quick estimate that chooses which dances are worth a check. Two points of a path can be covered at once if
they are no further apart along it than the dragon is long.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from core.paths.route import Route
from core.proposal.footprint import DENSE, SPAN, room_beside, standing
from core.proposal.free_ground import FreeGround
from core.proposal.needs import Needs
from core.proposal.places import Sampled, sampled

# Points of a path that are nearer along it than this many chords are not two strands [1].
STRANDS = 2.5


@dataclass(frozen=True)
class PathRating:
    """venue: stray that the edges allow by the estimate [m]; own: that the strands allow [m]; length: of the path [m];
    turns: that the head makes along it [1]"""

    venue: float
    own: float
    length: float
    turns: float

    @property
    def stray(self) -> float:
        """Stray that a dance on the path may allow [m], below 0 if none."""
        return min(self.venue, self.own)


def rated(
    ground: FreeGround,
    needs: Needs,
    route: Route,
    streets: tuple[float, float] = (0.0, 0.0),
    *,
    closely: bool = False,
) -> PathRating:
    """The rating of a path.

    streets: lengths of its straight ends in streets, where there is room [m]
    closely: the room to the edges is measured bench by bench, where one width beside the path is not there
    """
    path = sampled(route, needs)
    inside = (path.s > route.begin + streets[0]) & (path.s < route.end - streets[1])
    points, sides = path.points[inside], path.sides[inside]
    roughly = ground.nearest_node(*points.T) - sides
    near = roughly <= roughly.min(initial=math.inf) + 2.0 * ground.node_error  # the others have more room
    room = ground.clearance(points[near]) - sides[near] - needs.margin
    if closely and room.min(initial=math.inf) < needs.gain * needs.stray:
        dense = np.linspace(route.begin, route.end, math.ceil((route.end - route.begin) / DENSE) + 2)
        fronts = path.s[inside]
        benches = standing(dense, route.position(dense), fronts[fronts > route.begin + SPAN * needs.chord], needs.chord)
        room = room_beside(ground, needs, *benches) - needs.margin
    turned = np.abs(route.curvature(path.s)).mean() * (route.end - route.begin) / math.tau
    venue = float(room.min(initial=math.inf)) / needs.gain
    return PathRating(venue, strands(path, needs) / (2.0 * needs.gain), route.end - route.begin, float(turned))


def strands(path: Sampled, needs: Needs) -> float:
    """Least room between benches on two strands of a path that are covered at once, without the margin [m]."""
    step = float(path.s[1] - path.s[0])
    first = math.ceil(STRANDS * needs.chord / step)
    last = min(len(path.s) - 1, math.ceil((needs.length * 1.05 + needs.gap) / step))
    least = math.inf
    x, y = path.points.T
    for offset in range(first, last + 1):
        apart = np.hypot(x[offset:] - x[:-offset], y[offset:] - y[:-offset]) - path.sides[offset:]
        least = min(least, float((apart - path.sides[:-offset]).min()))
    return least - needs.margin
