"""A dragon on a route: the bends that every bench can follow, and the head's travel when the whole dragon has room."""

from __future__ import annotations

import math
from dataclasses import dataclass
from enum import StrEnum

import numpy as np

from core import kernels
from core.dragon import Dragon
from core.errors import InvalidValue
from core.kernels.constants import K_END, K_START, LAG, PIECE_KIND, REAR_COSINE_LEAST, S_END, S_START, Follows
from core.language import phrase, say
from core.paths.route import Route
from core.quantities import Quantity, quantities, say_value
from core.sampling import bisect
from core.values import Floats, Interval

# Width of the bracket around the earliest travel of the head: absolute [m], and relative to it [1].
ROOM_WIDTH = 1e-9
# Longest arc under a chord on bends of no less than half the chord, over the chord [1].
ARC_MOST = 0.5 * math.pi
# Largest distance by which a proof begins before the first place of a front handle [m].
BEGIN_WIDTH = 1e-9
# Work of the proof for all benches [1]; 1e6 take 0.15 s (measured 2026-11-30). Work for a part of a bend beside that of
# its slabs [1].
WORK_MOST, WORK_OF_PART = 3e7, 40.0


class Hindrance(StrEnum):
    """Reason why a bench cannot follow a bend: its rear handle would go across the bench, go backwards, or jump to a
    nearer place; no place behind is a chord away; or the work did not suffice to tell.

    >>> from core import Legs, course
    >>> drawn = course(Legs([(0, 0), (20, 0), (12, 20)], [0, 1], radius=0.5), Dragon())
    >>> drawn.bends[0].reason
    <Hindrance.BACKWARDS: 'backwards'>
    """

    SIDEWAYS = "sideways"
    BACKWARDS = "backwards"
    JUMPS = "jumps"
    NOWHERE = "nowhere"
    UNKNOWN = "unknown"

    @property
    def template(self) -> str:
        """The reason as the template of a clause."""
        return CLAUSES[self]

    @property
    def words(self) -> str:
        """The reason as a clause in words."""
        return say(self.template, limit=say_value(degrees_most()))


CLAUSES = {
    Hindrance.SIDEWAYS: phrase("the rear handle would go at more than {limit} to the bench"),
    Hindrance.BACKWARDS: phrase("the rear handle would have to go backwards"),
    Hindrance.JUMPS: phrase("the rear handle would have to jump to a nearer place of the path"),
    Hindrance.NOWHERE: phrase("no place of the path behind is as far away as the rear handle"),
    Hindrance.UNKNOWN: phrase("it was not decided within the work that one question may take"),
}


def degrees_most() -> Quantity:
    """Largest angle between a bench and the path at its rear handle that counts as followable [degrees]."""
    return Quantity(math.degrees(math.acos(REAR_COSINE_LEAST)), "degrees", 4)


@dataclass(frozen=True, slots=True)
class Obstacle:
    """Where a bench cannot follow a route.

    bench: the first one that would come there; chord: its chord [m]
    s, rear: places of its handles up to which it follows [m]; reason: what fails beyond
    angle: between the bench and the path at its rear handle then [rad]
    """

    bench: int
    chord: float
    s: float
    rear: float
    reason: Hindrance
    angle: float


@dataclass(frozen=True, slots=True)
class Following:
    """How a dragon follows a route.

    obstacles: where it cannot, at most one for each bend and chord; the first bench's first. None if all benches follow
        to the end
    arc: longest way along the path under a bench [m]
    rear_cosine, front_cosine: proven lower bounds of u . T at the handles on bends tighter than half a chord [1]
    """

    obstacles: tuple[Obstacle, ...]
    arc: float
    rear_cosine: float
    front_cosine: float


def bends_widely(dragon: Dragon, path: Route) -> bool:
    """True if every radius is at least half of every chord over ROUTE_SINE_LIMIT, which suffices to follow it, and no
    corner is there."""
    longest = float(dragon.chords[: dragon.uniform_from + 1].max())
    return bool(0.5 * path.sharpest[0] * longest <= kernels.ROUTE_SINE_LIMIT and not len(path.corners))


def follows(dragon: Dragon, path: Route) -> bool:
    """True if every bench is proven to follow every bend of the route, see core/kernels/follower.py."""
    return bends_widely(dragon, path) or not following(dragon, path).obstacles


def longest_arc(dragon: Dragon, path: Route) -> float:
    """Upper bound of the way along a route between both handles of a bench [m]; infinity if one cannot follow."""
    if bends_widely(dragon, path):
        return ARC_MOST * float(dragon.chords[: dragon.uniform_from + 1].max())
    found = following(dragon, path)
    return math.inf if found.obstacles else found.arc


def tightest_bend(dragon: Dragon) -> tuple[float, int]:
    """The least radius of a bend that every bench can follow, however long it is [m], and the bench that needs it."""
    bench = int(dragon.chords[: dragon.uniform_from + 1].argmax())
    return least_radius(float(dragon.chords[bench])), bench


def least_radius(chord: float) -> float:
    """The least radius of a bend that a bench of this chord can follow, however long it is [m]. chord: [m]"""
    return 0.5 * chord / kernels.ROUTE_SINE_LIMIT


# Benches of one chord are alike: a handle of any of them may stand wherever the path is, from its beginning for the
# last one to where the first of them is when the head is at the end. Only bends tighter than half the chord, and the
# places from which a bench reaches over them, need a proof: elsewhere the chord lemma serves (core/kernels/bounds.py).
def following(dragon: Dragon, path: Route) -> Following:
    """How a dragon follows a route, remembered with the route."""
    key = dragon.chords[: dragon.uniform_from + 1].tobytes() + dragon.benches.to_bytes(8)
    if key not in path.followed:
        path.followed[key] = _followed(dragon, path)
    found: Following = path.followed[key]
    return found


def _followed(dragon: Dragon, path: Route) -> Following:
    chords = dragon.chords[: dragon.uniform_from + 1]
    arc, rear, front = ARC_MOST * float(chords.max()), 1.0, 1.0
    obstacles: list[Obstacle] = []
    kinds, firsts = np.unique(chords, return_index=True)
    left = WORK_MOST
    # From the front handle of each bench to the last handle: chords span at least as much of the path [m]. A path that
    # is too short for the dragon is judged as one that will be longer, while a person draws it.
    behind = np.cumsum(dragon.chords[::-1])[::-1]
    has_room = path.tail_begin is not None and path.begin + float(behind[0]) <= path.end
    for first, chord in sorted(zip(firsts.tolist(), kinds.tolist(), strict=True)):
        proof = kernels.Follower(path.table, chord, REAR_COSINE_LEAST)
        end = _front_most(chords, first, path)
        earliest, proven = _first_front(path, chord), -math.inf
        alike = behind[dragon.chords == chord]
        if has_room:
            earliest = max(earliest, path.begin + float(alike[-1]))
        parts = _tight_parts(path, least_radius(chord))
        left -= WORK_OF_PART * len(parts)
        for start, stop in parts:
            begin = max(start, earliest, proven)
            if begin < end and stop > proof.rear:
                ended = proof.follow(begin, end, stop, max(left, 0.0))
                if len(path.corners) and ended is Follows.PROVEN:
                    proven = proof.reached
                if ended is not Follows.PROVEN:
                    # The first bench that surely comes there from behind, or else the last one.
                    ahead = int((ARC_MOST * alike > proof.reached - path.begin).sum()) if has_room else 0
                    bench = int(np.flatnonzero(dragon.chords == chord)[min(ahead, alike.size - 1)])
                    obstacles.append(_obstacle(bench, chord, path, proof, Hindrance[ended.name]))
        left -= proof.work
        arc, rear, front = max(arc, proof.longest), min(rear, proof.rear_cosine), min(front, proof.front_cosine)
        if obstacles:  # where this bench stops, those behind it do too
            break
    return Following(tuple(obstacles), arc, rear, front)


def _front_most(chords: Floats, bench: int, path: Route) -> float:
    """Place of a bench's front handle when the head is at the end of the path [m], if those before it follow."""
    sizes, chain = np.zeros((bench, kernels.SIZE_COLUMNS)), np.empty((bench + 1, kernels.CHAIN_COLUMNS))
    sizes[:, kernels.CHORD] = chords[:bench]
    path.follow(-path.end, bench, sizes, chain)
    return -float(chain[bench, LAG])


def _tight_parts(path: Route, radius: float) -> list[Interval]:
    """Ends of the parts of a route that bend more tightly than a radius [m], BEGIN_WIDTH too long where a row of the
    table does so only in part: its |curvature| rises or falls there."""
    table, most, parts = path.table, 1.0 / radius, path.tighter(radius)
    rows = np.searchsorted(table[:, S_START], [part[0] for part in parts])
    ends = np.searchsorted(table[:, S_END], [part[1] for part in parts])

    def edge(row: Floats, gentle: int, tight: int, column: int) -> float:
        low, high = float(row[gentle]), float(row[tight])
        if row[PIECE_KIND] == kernels.CREST or abs(row[column]) > most:
            return low
        while abs(high - low) > BEGIN_WIDTH:
            middle = 0.5 * (low + high)
            low, high = (low, middle) if abs(path.curvature(middle)) > most else (middle, high)
        return low

    return [
        (start, stop)  # a corner
        if start == stop
        else (edge(table[row], S_START, S_END, K_START), edge(table[end], S_END, S_START, K_END))
        for row, end, (start, stop, _) in zip(rows, ends, parts, strict=True)
    ]


def _first_front(path: Route, chord: float) -> float:
    """The first place a chord away from the beginning of the path [m]; its end if there is none."""
    if path.tail_begin is None:
        return path.begin
    begin, s = path.position(path.tail_begin), path.tail_begin
    while s < path.end and (gap := chord - math.dist(path.position(s), begin)) > BEGIN_WIDTH:
        s += gap
    return min(s, path.end)


def _obstacle(bench: int, chord: float, path: Route, proof: kernels.Follower, reason: Hindrance) -> Obstacle:
    rear = proof.reached if reason is Hindrance.NOWHERE else proof.rear
    bench_way, along = path.position(proof.reached) - path.position(rear), path.tangent(rear)
    angle = math.acos(max(-1.0, min(1.0, float(bench_way @ along) / chord)))
    return Obstacle(bench, chord, proof.reached, rear, reason, angle)


def earliest_travel(dragon: Dragon, path: Route, tail_begin: float) -> float:
    """Travel of the head when the last handle is at the beginning of the path [m].

    A chord spans at least its own length of the path, and at most longest_arc(). These bounds, and the end of the path,
    give the interval for a bisection of the travel of the head.
    """
    sizes = np.zeros((dragon.benches, kernels.SIZE_COLUMNS))
    sizes[:, kernels.CHORD] = dragon.chords
    chain = np.empty((dragon.benches + 1, kernels.CHAIN_COLUMNS))

    def has_room(s: float) -> bool:
        path.follow(float(path.lags(np.array([min(s, path.end)]), 0.0)[0]), dragon.benches, sizes, chain)
        return float(path.along(chain[dragon.benches, kernels.LAG])) >= tail_begin

    low, straight = tail_begin, float(dragon.chords.sum())
    wide = bends_widely(dragon, path)
    high = low + (ARC_MOST * straight if wide else longest_arc(dragon, path) * dragon.benches)
    if not has_room(high):
        rule = (
            "is too short for the whole dragon, which takes {least} of it from handle 0 to handle {last} "
            "(more along bends)"
        )
        values = quantities("m", 9, got=path.end - path.begin, least=straight)
        raise InvalidValue("path", rule, last=dragon.benches, **values)
    return min(bisect(has_room, low, high, width=ROOM_WIDTH, relative=ROOM_WIDTH)[1], path.end)
