"""Venues of random dances on spirals, up to the fold, and on routes, against dense poses compared by shapely.

`python -m tests.campaigns.hunt_venues SEED SECONDS`. Most obstacles have a corner next to a place that a bench
passes, many of them in the last metres before the fold; spirals stand anywhere, turned and mirrored.
"""

import math
from functools import partial

import numpy as np
import shapely

from core import Area, Dance, Judgement, Outcome, Part, Spiral, Venue, check, venue_clearance
from tests.campaigns import hunting
from tests.campaigns.hunt_contacts import GAP, blended_route, meeting_fault, random_dragon, random_margin
from tests.support.random_squares import closed
from tests.support.shared_dances import square
from tests.support.slow_performance import SlowPart
from tests.support.slow_search import RUN, Samples, benches_of, corners_of

# Number of poses on the way, evenly spaced in time and towards the fold in its square root.
POSES = 600
# Largest difference between a distance and its proven bound [m].
PROVEN = 1.1e-3
# Width of a bracket as it is promised [s].
NARROW = 1e-9
# Half the side of the square [m].
WIDE = 60.0


class SlowVenue(Samples):
    """Distances of all benches from one area at many times."""

    def __init__(self, part, boundary, times):
        self.part = part
        self.boundary = boundary
        super().__init__(self.distances, times)

    def distances(self, times):
        """(T,) least distance at times (T,) [m]; where they cross, minus the length of the boundary in a bench."""
        benches = shapely.polygons(corners_of(*benches_of(self.part.handles(times), self.part.slow.sides)))
        apart = shapely.distance(benches, self.boundary)
        cut = apart <= 0.0
        apart[cut] = -shapely.length(shapely.intersection(benches[cut], self.boundary))
        return apart.min(axis=1)


def random_obstacle(rng, part, times):
    """A triangle (3, 2) with a corner beside a bench or anywhere."""
    handles = part.handles(times[-1:] - (times[-1] - times[0]) * rng.uniform() ** 3)[0]
    slow = part.slow
    bench = int(min(rng.integers(0, 4), len(slow.chords) - 1))
    front = handles[bench]
    rear = handles[bench + 1]
    along = (front - rear) / np.linalg.norm(front - rear)
    left = np.array([-along[1], along[0]]) * rng.choice([-1.0, 1.0])
    length = 0.5 * slow.lengths[bench]
    width = 0.5 * slow.widths[bench]
    gap = 10.0 ** rng.uniform(-6.0, 0.0)
    is_beside = rng.uniform() < 0.5
    share = rng.uniform(-1.0, 1.0)
    ahead, aside = (length * share, width + gap) if is_beside else (length + gap, width * share)
    corner = 0.5 * (front + rear) + along * ahead + left * aside
    away = left if is_beside else along
    if rng.uniform() < 0.2:
        corner = rng.uniform(-1.0, 1.0, 2) * np.linalg.norm(handles[0]) * 1.5
    size = 10.0 ** rng.uniform(-2.5, 0.1)
    side = np.array([-away[1], away[0]]) * size * rng.uniform(0.05, 0.5)
    return np.stack([corner, corner + away * size + side, corner + away * 0.5 * size - side])


def random_case(seed, case):
    """dance, venue, margin, start, stop, and the slow look at the tree; raises: BenchDragonError for what is refused"""
    rng = hunting.generator(seed, case)
    dragon = random_dragon(rng, int(rng.choice([1, 2, 3, 5, 8, 12])))
    turns = rng.uniform(1.2, 5.0)
    pitch = float(rng.uniform(0.15, 1.2) * dragon.chords.max())
    centre = rng.uniform(-20.0, 20.0, 2)
    rotation = rng.uniform(-4.0, 4.0)
    clockwise = rng.uniform() < 0.5
    path = blended_route(rng, dragon) if case % 3 == 2 else Spiral(pitch, turns, tuple(centre), rotation, clockwise)
    dance = Dance(dragon, path)
    placed = SlowPart(Part(dance))
    end = RUN * min(placed.slow.end(), dance.end.time)  # the slow one may step over a fold beside the centre
    start = float(dance.begin + (end - dance.begin) * rng.choice([0.0, rng.uniform(0.0, 0.9)]))
    stop = None if rng.uniform() < 0.6 else float(start + (end - start) * rng.uniform(0.5, 1.0))
    until = end if stop is None else stop
    part = np.linspace(0.0, 1.0, POSES)
    times = np.unique(start + (until - start) * np.concatenate([part, 1.0 - (1.0 - part) ** 2]))
    triangle = random_obstacle(rng, placed, times)
    venue = Venue(square(WIDE).square, (Area("tree", (closed(triangle),)),))
    look = SlowVenue(placed, shapely.Polygon(triangle).boundary, times)
    return dance, venue, random_margin(rng, look, dragon), start, stop, look


def judged(dance, venue, margin, start, stop, look):
    """The kind of a clearance from the tree, and its fault in words."""
    tree = venue_clearance(dance, venue, margin=margin, start=start, stop=stop).areas[1]
    wrong = area_fault(tree, margin, look)
    if shapely.Polygon(venue.obstacles[0].rings[0]).boundary.distance(shapely.Point(tree.nearest.wall)) > GAP:
        wrong = wrong or f"{tree!r}, but its place is not on the tree"
    report = check(dance, venue=venue, margin=margin, start=start, stop=stop)
    tree = report.venue.areas[1]
    seen = look.least(report.stop)[0]
    if tree.nearest.at_least is not None and tree.nearest.distance > 0.0 and seen < tree.nearest.at_least - GAP:
        wrong = wrong or f"check until {report.stop}: {tree!r}, but the distance is {seen}"
    if report.verdict is Judgement.PASSES and seen < margin - GAP:
        wrong = wrong or f"check passes, but the distance is {seen}"
    if tree.overlapping is not None and tree.time_bracket[1] <= report.stop and report.verdict is not Judgement.FAILS:
        wrong = wrong or f"{tree!r}, but check says {report.verdict.value}"
    kind = tree.outcome.value
    if tree.outcome is Outcome.CONTACT and tree.time_bracket[1] - tree.time_bracket[0] > 1.01 * NARROW:
        kind += ", wide"
    if tree.nearest.at_least is None:
        kind += ", no bound"
    return kind, wrong and f"{wrong} in {dance!r}, {venue.obstacles[0].rings!r}, margin {margin!r}, {start}, {stop}"


def area_fault(tree, margin, look):
    """What is wrong with the clearance from one area."""
    low, there = look.least()
    nearest = tree.nearest
    if nearest.at_least is not None and nearest.distance > 0.0 and low < nearest.at_least - GAP:
        return f"{nearest!r}, but the distance is {low} at {there} s"
    if nearest.distance > 0.0 and abs(math.dist(nearest.point, nearest.wall) - nearest.distance) > GAP:
        return f"{nearest!r}, but its points are as far apart as {math.dist(nearest.point, nearest.wall)}"
    if max(low, 0.0) < nearest.distance - PROVEN:
        return f"{nearest!r}, but the distance is {low} at {there} s"
    if look.at(nearest.time) > nearest.distance + 1e3 * GAP:
        return f"{nearest!r}, but there it is {look.at(nearest.time)}"
    return meeting_fault(tree, margin, look, GAP, 1e2 * GAP)


fault = partial(hunting.unless_refused, judged, random_case)
hunt = partial(hunting.hunt, fault)

if __name__ == "__main__":
    hunting.main(hunt, "venues")
