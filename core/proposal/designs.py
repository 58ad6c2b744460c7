"""Designs: a shape at a place, with its ways from and to gates, laid out as one route on which a dragon dances."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace

from core.errors import InvalidValue
from core.paths.following import earliest_travel
from core.paths.pieces import Piece
from core.paths.route import Route
from core.proposal.figures import DANCED, Figure, Shape
from core.proposal.gates import Gate
from core.proposal.legs import LegFinder
from core.proposal.needs import Needs
from core.proposal.walks import Pose, Step, along, in_world, length_of, moved, pieces_of, placed, stretch

# Rounds of the head on a closed figure without gates, once the whole dragon stands on it [1].
ROUNDS = {Figure.RING: 2.0, Figure.EIGHT: 1.0}
# Places at which a closed figure may be entered or left; rotations of a spiral; and the shortest ways in and out that
# are combined [1].
DOORS, COMBINED = 12, 2
# A way that is blocked counts as this much longer [m], so that it is tried last.
BLOCKED = 1e4
# Length of a path in a street beyond that of the dragon, and of the street beyond the path and an overhang [m].
STAND_MORE, STREET_MORE = 0.2, 0.5


@dataclass(frozen=True)
class Design:
    """A dance before it is laid out.

    shape: None for a parade; pose: of its origin; gates: in and out, None without; doors: places on a closed figure at
    which it is entered and left, as parts of it; further: times around a closed figure beyond the usual ones
    """

    figure: Figure
    shape: Shape | None
    pose: Pose
    gates: tuple[Gate, Gate] | None = None
    doors: tuple[float, float] = (0.0, 0.0)
    further: int = 0

    @property
    def laps(self) -> float:
        """Times around a closed figure: once the whole dragon stands on it, or from gate to gate the whole ones; 1 for
        other figures."""
        return self.further + (1.0 if self.gates else ROUNDS.get(self.figure, 1.0))


def gate_poses(gate: Gate, lead: float) -> tuple[Pose, Pose]:
    """The pose of a head that has entered by a gate this far [m], and that of one that is about to leave by it."""
    x, y, heading = moved((*gate.point, gate.heading), (lead, 0.0))
    return (x, y, heading), (x, y, heading + math.pi)


def street_length(needs: Needs) -> float:
    """Length of a street in which the dragon stands [m]."""
    overhangs = needs.dragon.overhangs
    return stand_length(needs) + needs.free + STREET_MORE + float(max(overhangs[0], overhangs[-1]))


def stand_length(needs: Needs) -> float:
    """Length of a path in a street, from its beginning to the gate [m]."""
    return needs.length + STAND_MORE


def laid_out(design: Design, needs: Needs, ways: LegFinder) -> Route | None:
    """The route of a design, with s = 0 where the head stands when the whole dragon is on it; None if there is none."""
    try:
        pieces = _pieces(design, needs, ways)
        if pieces is None:
            return None
        route = Route(pieces)
        # Up to the next millimetre, so that rounding leaves the whole dragon on the path at time 0.
        ready = math.ceil(earliest_travel(needs.dragon, route, route.begin) * 1e3) / 1e3
        coil = route.joints[0] if design.figure is Figure.SPIRAL and design.gates is None else math.inf
        if ready > min(coil, route.end - DANCED * needs.length):
            return None
        return Route(pieces, start=ready)
    except InvalidValue:
        return None


def _pieces(design: Design, needs: Needs, ways: LegFinder) -> list[Piece] | None:
    shape, pose = design.shape, design.pose
    if shape is not None and shape.pieces is None:
        return None
    if design.gates is None:
        assert shape is not None
        if not shape.closed:
            return placed(shape.pieces or (), pose) or None
        around = shape.around
        if around < needs.length + needs.gap:
            return None
        standing = min(needs.length_along(around / math.tau), around - needs.gap)
        return pieces_of(in_world(pose, shape.first), stretch(shape.steps or (), 0.0, standing + design.laps * around))[
            0
        ]
    into, out = design.gates
    lead, street = needs.chord, stand_length(needs)
    if shape is None:
        # A square less than two chords across has room for a straight way alone.
        ends = [(near, gate_poses(into, near)[0], gate_poses(out, near)[1]) for near in (lead, 0.0)]
        found = ((near, begin, ways.around(begin, end)) for near, begin, end in ends)
        near, begin, steps = next((one for one in found if one[2] is not None), (0.0, ends[-1][1], None))
        if steps is None and (steps := ways.walk(begin, ends[-1][2])) is None:
            return None
        stand: Step = (street + near, 0.0)
        return pieces_of(moved(begin, (-street - near, 0.0)), [stand, *steps, stand])[0]
    begin, end = gate_poses(into, lead)[0], gate_poses(out, lead)[1]
    stand = (street + lead, 0.0)
    first = moved(begin, (-street - lead, 0.0))
    enter, leave = _doors(design)
    way_in, way_out = ways.around(begin, enter), ways.around(leave, end)
    if way_in is None or way_out is None:
        return None
    if shape.steps is not None:
        inner = _danced(shape, design)
        return pieces_of(first, [stand, *way_in, *inner, *way_out, stand])[0]
    before, _ = pieces_of(first, [stand, *way_in])
    after, _ = pieces_of(leave, [*way_out, stand])
    return [*before, *placed(shape.pieces or (), pose), *after]


def _danced(shape: Shape, design: Design) -> list[Step]:
    """The steps between the doors of a closed figure, once around at least; all steps of another one."""
    if not shape.closed:
        return list(shape.steps or ())
    around, (enter, leave) = shape.around, design.doors
    return stretch(shape.steps or (), enter * around, (design.laps + (leave - enter) % 1.0) * around)


def _doors(design: Design) -> tuple[Pose, Pose]:
    """The poses in the world at which the figure of a design is entered and left."""
    shape = design.shape
    assert shape is not None
    if not shape.closed:
        first, last = shape.ends
        return in_world(design.pose, first), in_world(design.pose, last)
    start = in_world(design.pose, shape.first)
    enter, leave = (along(start, shape.steps or (), part * shape.around) for part in design.doors)
    return enter, leave


def with_gates(design: Design, gates: tuple[Gate, Gate], needs: Needs, ways: LegFinder) -> Iterator[Design]:
    """The designs of a shape at a place with the shortest direct ways in and out, in both directions of the dance."""
    shape = design.shape
    assert shape is not None
    begin, end = gate_poses(gates[0], needs.chord)[0], gate_poses(gates[1], needs.chord)[1]
    mirrors = (shape,) if shape.figure is Figure.SPIRAL else (shape, replace(shape, mirror=not shape.mirror))
    for one in mirrors:
        turns = [design.pose[2] + part * math.tau for part in _parts(one)]
        each = [replace(design, shape=one, gates=gates, pose=(*design.pose[:2], turn)) for turn in turns]
        if one.closed:
            doors = [door / DOORS for door in range(DOORS)]
            places = [_doors(replace(each[0], doors=(door, door)))[0] for door in doors]
            enter = sorted((_way(ways, begin, place), door) for place, door in zip(places, doors, strict=True))
            leave = sorted((_way(ways, place, end), door) for place, door in zip(places, doors, strict=True))
            pairs = [(a + b, (first, last)) for a, first in enter[:COMBINED] for b, last in leave[:COMBINED]]
            yield from (replace(each[0], doors=pair) for _, pair in sorted(pairs))
            continue
        ends = [_doors(design) for design in each]
        ways_of = [(_way(ways, begin, first) + _way(ways, last, end), k) for k, (first, last) in enumerate(ends)]
        yield from (each[k] for _, k in sorted(ways_of)[:COMBINED])


def _parts(shape: Shape) -> list[float]:
    """Turns of a shape to try, as parts of a whole one: a spiral may be turned at will, an open figure by half."""
    if shape.figure is Figure.SPIRAL:
        return [part / DOORS for part in range(DOORS)]
    return [0.0] if shape.closed else [0.0, 0.5]


def _way(ways: LegFinder, begin: Pose, end: Pose) -> float:
    """Length of a direct leg [m]; without one, the distance as if it were BLOCKED metres longer."""
    steps = ways.leg(begin, end)
    return BLOCKED + math.dist(begin[:2], end[:2]) if steps is None else length_of(steps)
