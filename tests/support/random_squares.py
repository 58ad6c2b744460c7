"""Random squares with obstacles and gates, random dragons, and proposals judged by samples with shapely."""

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
import shapely

import core
from core import Area, Dragon, Gate, Venue, bench_outlines, trajectory

# Distance of two samples of a dance [s], and rounding of distances at coordinates of some hundred metres [m].
STEP = 0.1
ROUNDING = 1e-9


@dataclass(frozen=True)
class Case:
    """What an organiser asks for."""

    venue: Venue
    dragon: Dragon
    gates: tuple[Gate, ...]
    limits: dict[str, Any]

    def proposals(self, **more):
        return core.propose(self.venue, self.dragon, gates=self.gates, **{**self.limits, **more})

    def answer(self):
        """The proposals, or the refusal."""
        try:
            return self.proposals()
        except core.InvalidValue as error:
            return error


def closed(points):
    return tuple((float(x), float(y)) for x, y in [*points, points[0]])


def box(name, x, y, width, height):
    """A rectangle from its lower left corner."""
    return Area(name, (closed([(x, y), (x + width, y), (x + width, y + height), (x, y + height)]),))


def random_case(seed):
    """A square of 4 to 9 corners with up to ten obstacles, up to three gates, and a dragon of 2 to 60 benches."""
    random = np.random.default_rng(seed)
    corners = int(random.integers(4, 10))
    size = random.uniform(8.0, 45.0)
    angles = np.sort(random.uniform(0.0, math.tau, corners)) if random.random() < 0.5 else np.arange(corners)
    gaps = np.diff(angles, append=angles[0] + math.tau)  # around the centre, so that no side crosses another one
    angles = angles if gaps.min() >= 0.0 and gaps.max() < 3.0 else np.linspace(0.3, 5.8, corners)
    radii = size * random.uniform(0.6, 1.0, corners)
    ring = np.stack([radii * np.cos(angles), random.uniform(0.5, 1.0) * radii * np.sin(angles)], axis=-1)
    square = Area("square", (closed(ring),))
    obstacles = []
    for k in range(int(random.integers(0, 11))):
        place = random.uniform(-size, size, 2)
        around = np.linspace(0.0, math.tau, int(random.integers(3, 9)), False)
        radius = random.uniform(0.2, 0.15 * size) if random.random() < 0.3 else random.uniform(0.2, 0.8)
        obstacles.append(
            Area(f"obstacle {k}", (closed(place + radius * np.stack([np.cos(around), np.sin(around)], 1)),))
        )
    gates = []
    for _ in range(int(random.choice([0, 0, 1, 2, 3]))):
        side = int(random.integers(0, corners))
        a = ring[side]
        b = ring[(side + 1) % corners]
        way = b - a
        heading = math.atan2(way[0], -way[1]) + random.uniform(-0.5, 0.5)  # inwards is to the left
        x, y = (a + random.uniform(0.3, 0.7) * way).tolist()
        gates.append(Gate((x, y), heading))
    dragon = Dragon(int(random.integers(2, 61)), random.uniform(2.0, 3.5), random.uniform(1.6, 2.3))
    limits = {"stray": float(random.choice([0.0, 0.05, 0.1])), "margin": float(random.choice([0.0, 0.0, 0.2]))}
    if random.random() < 0.3:
        limits["speed_limit"] = random.uniform(0.5, 1.5)
    return Case(Venue(square, tuple(obstacles)), dragon, tuple(gates), limits)


def polygon(area):
    return shapely.Polygon(area.rings[0], area.rings[1:])


def refuted(case, proposal):
    """What a dense sampling of a proposal finds wrong; empty if nothing.

    Both holes of a bench may stray the same way, so every bench has the stray to the edges, two benches have it twice.
    """
    stray = case.limits["stray"]
    margin = case.limits["margin"]
    limit = case.limits.get("speed_limit")
    dance = proposal.dance
    report = proposal.report
    if not report.passed or report.start != 0.0 or report.stop != dance.end.time:
        return "the report does not pass from time 0 to the end"
    motion = trajectory(dance, np.append(np.arange(0.0, report.stop, STEP), report.stop))
    if limit is not None and motion.speed.max() > limit * (1.0 + 1e-5):
        return "a handle is too fast"
    benches = shapely.polygons(bench_outlines(dance.dragon, motion.position))
    square = polygon(proposal.venue.square)
    if not shapely.contains(square, benches).all():
        return "a bench leaves the square and its streets"
    edges = [square.boundary, *map(polygon, proposal.venue.obstacles)]
    if min(shapely.distance(edge, benches).min() for edge in edges) < margin + stray - ROUNDING:
        return "a bench comes too near to an edge"
    for row in benches:
        tree = shapely.STRtree(row)
        first, second = tree.query(row, predicate="dwithin", distance=margin + 2.0 * stray - ROUNDING)
        if (abs(first - second) > 1).any():
            return "two benches come too near to each other"
    if proposal.gates:
        own = polygon(case.venue.square)
        middles = motion.position[[0, -1]].mean(axis=1)
        if shapely.contains_xy(own, middles).any():
            return "the dragon does not stand in a street at the beginning or at the end"
    return ""


def free_ground(venue):
    """Oracle: the square without its obstacles, and the radius of the widest circle in it [m]."""
    free = polygon(venue.square).difference(shapely.union_all([polygon(one) for one in venue.obstacles]))
    circles = [shapely.maximum_inscribed_circle(part, tolerance=1e-4) for part in shapely.get_parts(free)]
    return free, max(circle.length for circle in circles)


def wrong_reason(case, result):
    """What is wrong with a reason by other means; empty if nothing."""
    reason = result.reason
    assert reason is not None
    have = reason.have or 0.0
    need = reason.need or 0.0
    if reason.kind is core.ReasonKind.FAILS:
        nearest = reason.failure is not None and reason.figure is not None
        return "" if nearest and have in (1.0, need) else f"no failure of a nearest dance: {reason.message}"
    if not have < need and reason.kind is not core.ReasonKind.BENCHES:
        return f"{have} is not less than {need}"
    if reason.kind is core.ReasonKind.WIDTH:
        # Within the triangles of the free ground lies no wider circle than the polygon has.
        _, widest = free_ground(case.venue)
        return "" if 2.0 * widest <= have + 1e-2 and have <= 2.0 * widest + 0.05 else f"the widest circle: {2 * widest}"
    if reason.kind is core.ReasonKind.STRAY:
        again = case.proposals(stray=0.98 * have)
        return "" if again.proposals else "no dance with the smaller stray"
    if reason.kind is core.ReasonKind.BENCHES:
        from core.proposal.propose import with_benches

        shorter = Case(case.venue, with_benches(case.dragon, int(have)), case.gates, case.limits)
        return "" if have < need and shorter.proposals(count=1).proposals else "no dance of the shorter dragon"
    return ""
