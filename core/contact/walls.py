"""Clearance between benches and the edges of a venue, and the time of the first contact."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from core import kernels
from core.checks import checked_number, checked_type
from core.contact.answer import Outcome
from core.contact.search import MARGIN_MAX, NEAR_WORK_BUDGET, ContactSearch, SearchInput, before_fold
from core.contact.stretch import Stretch, first_met, least_on
from core.dance import Dance
from core.display import Readable, display
from core.dragon import Stray, checked_stray
from core.kernels import Budget, Ended
from core.language import say
from core.motion.trajectory import trajectory
from core.paths.frame import Frame
from core.paths.route import Route
from core.questions import question_about
from core.shapes.engines import inside
from core.shapes.reach import gains
from core.shapes.rectangles import bench_poses
from core.values import Floats, Interval, Pair, Point
from core.venue import Area, Venue

# Distance of the samples of a route that dismiss far areas, at first, most of them [1], and rounding of places [m].
SAMPLE_STEP, SAMPLES_MOST, PLACED = 0.5, 20_000, 1e-6


@dataclass(frozen=True, slots=True, repr=False)
class Nearest(Readable):
    """Smallest distance between the benches and the edges of one area, holes included.

    distance: smallest distance found; 0 at the first touch [m]
    at_least: proven lower bound, as in a LeastClearance; None: the search gave up before proving one [m]
    time: time of the smallest distance [s]
    bench: the bench at that distance
    point: nearest point of the bench, x and y [m]
    wall: nearest point of the area, x and y [m]

    >>> from core import Dragon, Spiral
    >>> hall = Venue(Area("hall", (((-12, -12), (12, -12), (12, 12), (-12, 12), (-12, -12)),)))
    >>> nearest = venue_clearance(Dance(Dragon(20), Spiral()), hall).areas[0].nearest
    >>> round(nearest.distance, 3), nearest.bench
    (2.747, 16)
    """

    distance: float
    at_least: float | None
    time: float
    bench: int
    point: Point
    wall: Point


@dataclass(frozen=True, slots=True, repr=False)
class AreaClearance(Readable):
    """Distance between the benches and the edges of the square or of one obstacle.

    name: name of the area
    outcome: whether a bench comes within the margin, or touches if it is 0
    time: first such time; None when clear or undecided [s]
    time_bracket: two times: proven clear up to the first; within the margin at the second. If undecided, the second is
        the end of the search unless overlapping names a bench; None if clear or at the start [s]
    overlapping: if undecided: the bench that is certainly within the margin, or touches, at the second of these times;
        None if none is, or not undecided
    bench: the first bench within the margin, or touching if it is 0
    gap: distance to the area at that time: the margin to rounding, or less if it is nearer from the start [m]
    point: point of that bench nearest to the area, x and y [m]
    nearest: smallest distance over the dance; None without details

    >>> from core import Dragon, Spiral
    >>> hall = Venue(Area("hall", (((-12, -12), (12, -12), (12, 12), (-12, 12), (-12, -12)),)))
    >>> area = venue_clearance(Dance(Dragon(20), Spiral()), hall).areas[0]
    >>> area.name, area.outcome, area.time
    ('hall', <Outcome.CLEAR: 'clear'>, None)
    """

    name: str
    outcome: Outcome
    time: float | None
    time_bracket: Interval | None
    bench: int | None
    point: Point | None
    nearest: Nearest | None
    gap: float | None = None
    overlapping: int | None = None

    def _line(self) -> str:
        words = f"{self.name!r} {say(self.outcome.value)}"
        return say("{area}, nearest {nearest}", area=words, nearest=self.nearest._line()) if self.nearest else words


@dataclass(frozen=True, slots=True, repr=False)
class Misplaced(Readable):
    """A bench that starts outside the square or inside an obstacle.

    name: name of the square or of the obstacle
    bench: the bench
    point: centre of the bench, x and y [m]

    >>> from core import Dragon, Spiral
    >>> booth = Venue(Area("booth", (((-3, -3), (3, -3), (3, 3), (-3, 3), (-3, -3)),)))
    >>> venue_clearance(Dance(Dragon(5), Spiral()), booth).misplaced.name
    'booth'
    """

    name: str
    bench: int
    point: Point


@dataclass(frozen=True, slots=True, repr=False)
class VenueClearance(Readable):
    """Distances between the benches and the venue.

    misplaced: the first bench that starts outside the square or in an obstacle
    areas: the square, then the obstacles

    >>> from core import Dragon, Spiral
    >>> hall = Venue(Area("hall", (((-12, -12), (12, -12), (12, 12), (-12, 12), (-12, -12)),)))
    >>> [area.name for area in venue_clearance(Dance(Dragon(20), Spiral()), hall).areas]
    ['hall']
    """

    misplaced: Misplaced | None
    areas: tuple[AreaClearance, ...]

    def _line(self) -> str:
        misplaced = f"{self.misplaced!r}; " if self.misplaced else ""
        known = [(area.nearest, area.name) for area in self.areas if area.nearest]
        if not known:
            return misplaced + "; ".join(area._line() for area in self.areas)
        near, name = min(known, key=lambda one: one[0].distance)
        values = {"distance": display(near.distance, "m"), "time": display(near.time, "s")}
        words = say(
            "nearest to {name}: bench {bench}, {distance} at {time}", name=repr(name), bench=near.bench, **values
        )
        return misplaced + words

    def _rows(self) -> list[tuple[str, str]]:
        misplaced = self.misplaced._line() if self.misplaced else say("none")
        return [("misplaced", misplaced), *((area.name, area._line()) for area in self.areas)]


@question_about("dance", Dance, "the clearance between benches and venue was not found")
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
    same proof, on a spiral up to its fold. If a bench touches no edge, its centre stays inside or outside an area, as
    at the start. A bracket is as wide as one of first_contact(), and wider where a bench slowly meets a corner, of two
    edges at once.
    margin: [m]; stray: largest distance of every hole from its place [m]: then the ground that benches may cover counts
    start, stop: [s], None for dance.default_start and for the end of the run
    nearest: True also finds the least distance, which takes most of the time
    raises: InvalidValue; OutsideRun; TooMuchWork

    >>> from core import Dragon, Spiral
    >>> hall = Venue(Area("hall", (((-12, -12), (12, -12), (12, 12), (-12, 12), (-12, -12)),)))
    >>> venue_clearance(Dance(Dragon(20), Spiral()), hall).areas[0].outcome
    <Outcome.CLEAR: 'clear'>
    """
    checked_type("venue", venue, Venue)
    margin = checked_number("margin", margin, "m", 0.0, MARGIN_MAX)
    begin, until = dance.span(start, stop)
    frame, strayed = dance.path.frame, checked_stray(stray, dance.dragon)
    share = NEAR_WORK_BUDGET / len(venue.areas)  # each area has its own search: its edges, and its share of work
    is_beyond = _beyond_reach(dance, margin, strayed)
    areas = []
    for area in venue.areas:
        clearance = AreaClearance(area.name, Outcome.CLEAR, None, None, None, None, None)
        is_clear = is_beyond is not None and is_beyond(area)
        if nearest or not is_clear:
            sought = SearchInput(
                dance.dragon,
                dance.path,
                margin,
                own_edges(area, frame),
                stray=strayed,
                timing=dance.clock.rounding(until),
            )
            search = ContactSearch(sought, work=share, budget=budget)
            if not is_clear:
                clearance = _area_clearance(search, area.name, dance, (begin, until))
            if nearest:
                clearance = replace(clearance, nearest=_nearest(search, dance, (begin, until)))
        areas.append(clearance)
    return VenueClearance(_misplaced(dance, venue, begin), tuple(areas))


# Every point of a bench is within r = hypot(max(chord / 2, overhang), width / 2) of one of its two handles, and a stray
# moves it by at most its gain times that. Handles stand on the route, and no place of it is further from the nearest of
# samples h apart than h / 2. So a disc around an area is out of reach if its middle is further than r, the stray, the
# margin, h / 2 and its radius from all samples.
def _beyond_reach(dance: Dance, margin: float, stray: float) -> Callable[[Area], bool] | None:
    """Whether no bench comes near an area on a whole route, by a disc around the area; None on other paths."""
    route, dragon = dance.path, dance.dragon
    if not isinstance(route, Route) or route.tail_begin is None:
        return None
    count = max(2, min(SAMPLES_MOST, math.ceil((route.end - route.begin) / SAMPLE_STEP) + 1))
    samples, step = np.linspace(route.begin, route.end, count, retstep=True)
    points = route.position(samples)
    far = np.hypot(np.maximum(0.5 * dragon.chords, dragon.overhangs), 0.5 * dragon.widths) + stray * gains(dragon)
    least = float(far.max()) + margin + 0.5 * float(step) + route.slide + PLACED

    def is_beyond(area: Area) -> bool:
        corners = np.array(area.rings[0])
        middle = 0.5 * (corners.min(axis=0) + corners.max(axis=0))
        radius = np.hypot(*(corners - middle).T).max()
        return bool(np.hypot(*(points - middle).T).min() > least + radius)

    return is_beyond


def own_edges(area: Area, frame: Frame) -> Floats:
    """The edges of an area (E, 4) in the own frame of a path [m]."""
    return frame.back(area.edges.reshape(-1, 2, 2)).reshape(-1, 4)


def _area_clearance(search: ContactSearch, name: str, dance: Dance, span: Interval) -> AreaClearance:
    """The first time within the margin of an area between two times [s]."""
    (begin, until), clock = span, dance.clock
    result, certain = first_met(search, dance, span)
    outcome, time, bracket, bench, point, gap = Outcome.CLEAR, None, None, None, None, None
    overlapping = None
    if result.ended is Ended.STUCK:
        if certain is not None and certain.touching is not None:
            until, overlapping = clock.time(certain.touching), certain.pair[0]
        outcome, bracket = Outcome.UNDECIDED, (max(clock.time(result.proven), begin), until)
    elif result.ended is not Ended.REACHED:
        at_start = result.ended is Ended.TOUCHED_AT_START
        assert result.touching is not None
        travel = result.touching - (0.0 if at_start else result.half)
        outcome = Outcome.CONTACT_AT_START if at_start else Outcome.CONTACT
        time = begin if at_start else max(clock.time(travel), begin)
        bracket = None if at_start else (max(clock.time(result.proven), begin), clock.time(result.touching))
        bench, (point, _, gap) = result.pair[0], _witnesses(search, travel, result.pair, dance.path.frame)
    return AreaClearance(name, outcome, time, bracket, bench, point, None, gap, overlapping)


def _nearest(search: ContactSearch, dance: Dance, span: Interval) -> Nearest:
    """Smallest distance of a search between two times [s]."""
    (begin, until), clock = span, dance.clock
    fold = dance.end.theta if dance.nears_fold(until) else None
    last = clock.travel(until)
    first, last = clock.travel(begin), last if fold is None else before_fold(last)
    (distance, travel, pair), at_least = least_on(Stretch(search, (first, last), clock.slowest, fold))
    witnesses = _witnesses(search, travel, pair, dance.path.frame)
    return Nearest(distance, at_least, max(clock.time(travel), begin), pair[0], *witnesses[:2])


def _witnesses(search: ContactSearch, travel: float, pair: Pair, frame: Frame) -> tuple[Point, Point, float]:
    """The points of a bench and an edge that are nearest to each other, and their separation [m]."""
    search.clearance(travel)
    kernels.meet(search.scene, *pair, search.placed)
    met = search.scene.met
    theta = search.path.head(travel).theta or 0.0  # on a spiral the chain has its head at polar angle 0
    cos, sin = math.cos(theta), math.sin(theta)
    ends = [(float(x), float(y)) for x, y in ((met.ax, met.ay), (met.bx, met.by))]
    bench, wall = (frame.point(x * cos - y * sin, x * sin + y * cos) for x, y in ends)
    return bench, wall, float(met.separation)


def _misplaced(dance: Dance, venue: Venue, begin: float) -> Misplaced | None:
    centres = bench_poses(trajectory(dance, [begin]).position[0])[:, :2]
    for area in venue.areas:
        wrong = np.flatnonzero(inside(area.rings, centres) != (area is venue.square))
        if wrong.size:
            x, y = centres[wrong[0]].tolist()
            return Misplaced(area.name, int(wrong[0]), (x, y))
    return None
