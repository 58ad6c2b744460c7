"""Clearance between benches and the edges of a venue, and the time of the first contact."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from core import kernels
from core.contact.answer import Outcome
from core.contact.clearance import Pair, least_over
from core.contact.fold import moved_until
from core.contact.search import MARGIN_MAX, NEAR_WORK_BUDGET, Search
from core.dance import Clock, Dance
from core.dragon import Stray, checked_stray
from core.errors import InvalidValue, Quantity, asked_of, bound, checked_number, checked_type
from core.kernels import Budget, Ended
from core.motion.trajectory import trajectory
from core.paths.following import follows, tightest_bend
from core.paths.frame import Frame
from core.paths.route import Route
from core.paths.spiral import Spiral
from core.shapes.engines import inside
from core.shapes.rectangles import bench_poses
from core.shown import Readable, worded
from core.values import Floats, Point
from core.venue import Area, Venue

# Length of a spiral beyond the last instant, so that rounding cannot put that instant outside it [m].
SPARE = 1e-3
# Distance by which a computed place must be beyond a radius [m], and as a part of that radius [1]: places of handles
# are good to 1e-12 of their distance from the centre, on spirals of any length (trajectory()).
SURELY, SURELY_OF_RADIUS = 1e-9, 1e-11


@dataclass(frozen=True, slots=True, repr=False)
class Nearest(Readable):
    """Smallest distance between the benches and an area's edges, holes included.

    distance: the least one found [m], reached at `time` [s] by `bench`; 0 at the first touch
    at_least: proven lower bound [m], see LeastClearance; None if the search gave up first
    point: nearest point of the bench; wall: nearest point of the area (x, y) [m]
    """

    distance: float
    at_least: float | None
    time: float
    bench: int
    point: Point
    wall: Point


@dataclass(frozen=True, slots=True, repr=False)
class AreaClearance(Readable):
    """The benches and the edges of one area, by the name of the area.

    outcome: of the search for a bench within the margin; time: of the first one [s], None if clear or undecided
    time_bracket: (proven clear up to, within the margin at) [s]; if undecided up to the end; None if clear or at the
        start
    bench, point (x, y) [m]: the first bench within the margin, and its nearest point
    gap: between that bench and the edge at that time [m]: the margin to rounding, except for contact_at_start
    nearest: None if it was not requested
    """

    name: str
    outcome: Outcome
    time: float | None
    time_bracket: tuple[float, float] | None
    bench: int | None
    point: Point | None
    nearest: Nearest | None
    gap: float | None = None

    def _line(self) -> str:
        nearest = f", nearest {self.nearest._line()}" if self.nearest else ""
        return f"{self.name!r} {self.outcome.value}{nearest}"


@dataclass(frozen=True, slots=True, repr=False)
class Misplaced(Readable):
    """A bench that starts outside the square or in an obstacle: the area's name, the bench, its centre (x, y) [m]."""

    name: str
    bench: int
    point: Point


@dataclass(frozen=True, slots=True, repr=False)
class VenueClearance(Readable):
    """The benches in the venue.

    misplaced: the first bench that starts outside the square or in an obstacle; areas: the square, then the obstacles
    """

    misplaced: Misplaced | None
    areas: tuple[AreaClearance, ...]

    def _line(self) -> str:
        misplaced = f"{self.misplaced!r}; " if self.misplaced else ""
        known = [(area.nearest, area.name) for area in self.areas if area.nearest]
        if not known:
            return misplaced + "; ".join(area._line() for area in self.areas)
        near, name = min(known, key=lambda one: one[0].distance)
        distance, time = worded(near.distance, "m"), worded(near.time, "s")
        return f"{misplaced}nearest to {name!r}: bench {near.bench}, {distance} at {time}"

    def _rows(self) -> list[tuple[str, str]]:
        misplaced = self.misplaced._line() if self.misplaced else "none"
        return [("misplaced", misplaced), *((area.name, area._line()) for area in self.areas)]


@asked_of("dance", Dance, "the clearance between benches and venue was not found")
def venue_clearance(
    dance: Dance,
    venue: Venue,
    *,
    margin: float = 0.0,
    stray: float | Stray = 0.0,
    start: float | None = None,
    stop: float | None = None,
    nearest: bool = True,
    budget: Budget | None = None,
) -> VenueClearance:
    """Distance of the benches from the square's edges and from each obstacle, and the first time within the margin.

    An edge counts as a rectangle at rest without width: benches and edges are marched like pairs of benches, with the
    same proof. If a bench touches no edge, its centre stays inside or outside an area, as at the start.
    margin: [m]; stray: largest distance of every hole from its place [m]: then the ground that benches may cover counts
    start, stop: [s], None for dance.default_start and for the end of the run
    nearest: True also finds the least distance, which takes most of the time
    raises: InvalidValue, also (stop) for a spiral that becomes too tight for a chord, as most do shortly before their
        end; OutsideRun; TooMuchWork
    """
    checked_type("venue", venue, Venue)
    margin = checked_number("margin", margin, "m", 0.0, MARGIN_MAX)
    begin, until = dance.span(start, stop)
    clock, frame = dance.clock, dance.path.frame
    path = venue_route(dance.path, clock.travel(until))
    if not follows(dance.dragon, path):
        rule = "must be at most {last}, when the path becomes too tight for bench {bench}"
        last, bench = bound(venue_end(dance), 6, "s"), tightest_bend(dance.dragon)[1]
        raise InvalidValue("stop", rule, got=Quantity(until, "s"), last=last, bench=bench)
    strayed = checked_stray(stray, dance.dragon)
    share = NEAR_WORK_BUDGET / len(venue.areas)  # an area has a Search of its own: its edges, and its share of work
    areas = []
    for area in venue.areas:
        search = Search(dance.dragon, path, margin, own_edges(area, frame), work=share, budget=budget, stray=strayed)
        areas.append(_area_clearance(search, area.name, (begin, until), clock, frame, nearest))
    return VenueClearance(_misplaced(dance, venue, begin), tuple(areas))


def own_edges(area: Area, frame: Frame) -> Floats:
    """The edges of an area (E, 4) in the own frame of a path [m]."""
    return frame.back(area.edges.reshape(-1, 2, 2)).reshape(-1, 4)


def venue_route(path: Spiral | Route, stop: float) -> Route:
    """The path in its own frame up to a head travel [m]: a spiral as a coil."""
    return path.as_route(max(stop, 0.0) + SPARE)


def venue_end(dance: Dance) -> float:
    """Last time to which venue_clearance() can follow the dance [s]: a spiral may become too tight for a chord."""
    gentle = dance.path.gentle_end(2.0 * kernels.ROUTE_SINE_LIMIT / float(dance.dragon.chords.max()))
    return min(dance.end.time, dance.clock.time(gentle - 2.0 * SPARE))


def is_clear_beyond(
    dance: Dance, venue: Venue, *, margin: float, stray: float = 0.0, start: float, seen: float
) -> bool:
    """True if a spiral dance is proven to stay clear of the venue to its end, given that it is clear from start to
    `seen` [s].

    The head goes inwards, so the benches up to the first of the equal ones stay in the disc around the centre that the
    chords from the head to that bench span. Every other bench, once it has passed the start of the bench before it, is
    at a place where that one has been since the start, unless it moves back behind its own start (family lemma,
    core/kernels/repeats.py). So there is no new contact if all edges are outside the disc by more than the margin.
    """
    search = Search(dance.dragon, dance.path, margin, stray=stray)
    dragon = search.dragon
    frame, clock = dance.path.frame, dance.clock
    ends = np.linalg.norm(trajectory(dance.steady, dance.steady_times(np.array([start, seen]))).position, axis=-1)
    surely = SURELY + SURELY_OF_RADIUS * float(ends.max())
    if (ends[1, 1:] + surely > ends[0, :-1]).any():
        return False
    alike = dragon.uniform_from + 1
    search.resize(dragon.benches)
    search.place_leaders(clock.travel(seen), dragon.benches)
    arcs, _ = moved_until(search, dance.end.theta or 0.0)
    rates = np.hypot(1.0, search.placed[: dragon.benches + 1, kernels.THETA])
    outwards = arcs / rates  # radii grow by this part of an arc
    if (ends[1] + outwards + surely > ends[0])[alike:].any():
        return False
    reach = ends[1, 0] + dragon.chords[:alike].sum() + dragon.overhangs[:alike].max()
    reach += 0.5 * dragon.widths[:alike].max()
    edges = np.concatenate([own_edges(area, frame) for area in venue.areas])
    along = edges[:, 2:] - edges[:, :2]
    share = np.clip(-(edges[:, :2] * along).sum(axis=1) / (along**2).sum(axis=1), 0.0, 1.0)
    nearest = np.linalg.norm(edges[:, :2] + share[:, None] * along, axis=1).min()
    return bool(nearest > reach + margin + surely)


def _area_clearance(
    search: Search, name: str, span: tuple[float, float], clock: Clock, frame: Frame, with_nearest: bool
) -> AreaClearance:
    """The benches and one area between two times [s]. frame: of the search"""
    (begin, until), slowest = span, clock.slowest
    first, last, search.timing = clock.travel(begin), clock.travel(until), clock.rounding(until)
    state, found, half_bracket = search.approach(first, last, slowest)
    outcome, time, bracket, bench, point, gap = Outcome.CLEAR, None, None, None, None, None
    if state is Ended.STUCK:
        outcome, bracket = Outcome.UNDECIDED, (max(clock.time(found.proven), begin), until)
    elif state is not Ended.REACHED:
        at_start = state is Ended.TOUCHED_AT_START
        assert found.touching is not None
        travel = found.touching - (0.0 if at_start else half_bracket)
        outcome = Outcome.CONTACT_AT_START if at_start else Outcome.CONTACT
        time = begin if at_start else clock.time(travel)
        bracket = None if at_start else (max(clock.time(found.proven), begin), clock.time(found.touching))
        pair = found.benches
        bench, (point, _, gap) = pair[0], _witnesses(search, travel, pair, frame)
    if not with_nearest:
        return AreaClearance(name, outcome, time, bracket, bench, point, None, gap)
    (distance, travel, pair), at_least = least_over(search, first, last, slowest)
    nearest = Nearest(
        distance, at_least, max(clock.time(travel), begin), pair[0], *_witnesses(search, travel, pair, frame)[:2]
    )
    return AreaClearance(name, outcome, time, bracket, bench, point, nearest, gap)


def _witnesses(search: Search, travel: float, pair: Pair, frame: Frame) -> tuple[Point, Point, float]:
    """The points of a bench and an edge that are nearest to each other, and their separation [m]."""
    search.clearance(travel)
    kernels.meet(search.scene, *pair, search.placed)
    met = search.scene.met
    return frame.point(float(met.ax), float(met.ay)), frame.point(float(met.bx), float(met.by)), float(met.separation)


def _misplaced(dance: Dance, venue: Venue, begin: float) -> Misplaced | None:
    centres = bench_poses(trajectory(dance, [begin]).position[0])[:, :2]
    for area in venue.areas:
        wrong = np.flatnonzero(inside(area.rings, centres) != (area is venue.square))
        if wrong.size:
            x, y = centres[wrong[0]].tolist()
            return Misplaced(area.name, int(wrong[0]), (x, y))
    return None
