"""Figures of a dance, each around the origin: a ring, a figure eight, a serpentine, a spiral in and out.

A figure is a shape with few sizes. A ring and an eight are closed and may be entered anywhere; a serpentine and a
spiral have a beginning and an end. A parade has no shape of its own: it is the way between two gates.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from enum import StrEnum
from functools import cached_property

import numpy as np

from core.errors import InvalidValue
from core.paths.pieces import Piece
from core.paths.route import Route
from core.paths.turn import Turn
from core.proposal.needs import Needs
from core.proposal.walks import Pose, Step, length_of, long_enough, mirrored, pieces_of

# Sizes to try, as multiples of the smallest one that holds the dragon [1].
SCALES = (1.03, 1.2, 1.45, 1.8, 2.4, 3.2)
# Length over width of rings, and the radius of their corners as a share of half the width [1].
RINGS = ((1.0, 1.0), (1.6, 1.0), (2.6, 1.0), (1.0, 0.4), (1.5, 0.4))
# Radii of the corners of tight rings, in tightest bends [1].
TIGHT_RADII = (1.001, 1.05, 1.12, 1.2, 1.3, 1.42, 1.56, 1.72)
# Distance of the middle of a lobe of an eight from the crossing, in radii of the lobe [1].
EIGHTS = (1.25, 1.42, 1.8)
# Lanes of a serpentine, and the radius of its turns in easy ones [1].
LANES, LANE_RADII = (3, 4, 5, 6, 8, 10), (1.0, 1.4)
# Room of a spiral's turn: its radius in pairs of tightest arcs [1].
TURNS = (1.02, 1.25, 1.5)
# Length of the dance of a serpentine or a spiral beyond that of the dragon, as a part of it, without gates [1].
DANCED = 0.4


class Figure(StrEnum):
    """Figure of a dance. SPIRAL: in and out, with the turn between; PARADE: from gate to gate.

    >>> [figure.value for figure in Figure]
    ['spiral', 'eight', 'serpentine', 'ring', 'parade']
    """

    SPIRAL = "spiral"
    EIGHT = "eight"
    SERPENTINE = "serpentine"
    RING = "ring"
    PARADE = "parade"


# Figures whose end is their beginning, so that they may be danced again and again.
CLOSED = frozenset({Figure.RING, Figure.EIGHT})


@dataclass(frozen=True)
class Shape:
    """A figure with its sizes, around the origin; see the functions below for what they mean."""

    figure: Figure
    sizes: tuple[float, ...]
    mirror: bool = False

    @cached_property
    def steps(self) -> list[Step] | None:
        """The steps of a figure without coils, from its first pose; None for a spiral, or for impossible sizes."""
        if self.figure is Figure.SPIRAL:
            return None
        steps = STEPS[self.figure](*self.sizes)
        return None if steps is None else mirrored(steps) if self.mirror else steps

    @property
    def first(self) -> Pose:
        """The pose at the beginning of the steps."""
        x, y, heading = FIRST[self.figure](*self.sizes)
        return (x, -y, -heading) if self.mirror else (x, y, heading)

    @property
    def closed(self) -> bool:
        """True if the end is the beginning."""
        return self.figure in CLOSED

    @cached_property
    def pieces(self) -> tuple[Piece, ...] | None:
        """The pieces, once around a closed figure; None for impossible sizes."""
        try:
            if self.figure is Figure.SPIRAL:
                outer, turning, pitch = self.sizes
                return Turn(pitch, turning, 1.0, start_turns=outer / pitch).pieces
            if self.steps is None or not long_enough(self.steps):
                return None
            return tuple(pieces_of(self.first, self.steps)[0])
        except InvalidValue:
            return None

    @cached_property
    def ends(self) -> tuple[Pose, Pose]:
        """The poses at the beginning and at the end of the pieces."""
        assert self.pieces is not None
        route = Route(self.pieces)
        ends = np.array([route.begin, route.end])
        points, tangents = route.position(ends), route.tangent(ends)
        first, last = ((float(x), float(y), math.atan2(v, u)) for (x, y), (u, v) in zip(points, tangents, strict=True))
        return first, last

    @property
    def round(self) -> bool:
        """True for a ring that is a circle."""
        return self.figure is Figure.RING and max(self.sizes) == min(self.sizes)

    @property
    def around(self) -> float:
        """Length once around a closed figure [m]."""
        return length_of(self.steps or [])

    @property
    def turns(self) -> float:
        """Turns of the head once around a closed figure, all bends added up [1]."""
        return sum(length * abs(curvature) for length, curvature in self.steps or []) / math.tau


def ring(half_length: float, half_width: float, corner: float) -> list[Step] | None:
    """A rectangle with round corners, counter-clockwise from the middle of its lower side. Sizes: [m]"""
    along, up = half_length - corner, half_width - corner
    if min(along, up) < -1e-9 or corner <= 0.0:
        return None
    bend = (0.5 * math.pi * corner, 1.0 / corner)
    side, end = max(along, 0.0), (2.0 * max(up, 0.0), 0.0)
    return [(side, 0.0), bend, end, bend, (2.0 * side, 0.0), bend, end, bend, (side, 0.0)]


def eight(radius: float, ratio: float) -> list[Step] | None:
    """Two arcs of a radius [m] and their inner tangents, from the crossing. ratio: middle of a lobe to it, in radii"""
    if ratio <= 1.0:
        return None
    line, angle = radius * math.sqrt(ratio * ratio - 1.0), math.asin(1.0 / ratio)
    lobe, bend = radius * (math.pi + 2.0 * angle), 1.0 / radius
    return [(line, 0.0), (lobe, bend), (2.0 * line, 0.0), (lobe, -bend), (line, 0.0)]


def serpentine(lanes: float, half_length: float, radius: float) -> list[Step] | None:
    """Straight lanes, up and down, with half circles between them. half_length: of a lane [m]; radius: [m]"""
    if half_length <= 0.0:
        return None
    steps: list[Step] = [(2.0 * half_length, 0.0)]
    for lane in range(1, round(lanes)):
        steps += [(math.pi * radius, (1.0 if lane % 2 else -1.0) / radius), (2.0 * half_length, 0.0)]
    return steps


STEPS: dict[Figure, Callable[..., list[Step] | None]] = {
    Figure.RING: ring,
    Figure.EIGHT: eight,
    Figure.SERPENTINE: serpentine,
}
FIRST: dict[Figure, Callable[..., Pose]] = {
    Figure.RING: lambda half_length, half_width, corner: (0.0, -half_width, 0.0),
    Figure.EIGHT: lambda radius, ratio: (0.0, 0.0, -math.asin(1.0 / ratio)),
    Figure.SERPENTINE: lambda lanes, half, radius: (-half, -(round(lanes) - 1) * radius, 0.0),
}


def shapes(figure: Figure, needs: Needs, widest: float, *, gated: bool) -> Iterator[Shape]:
    """Shapes of a figure that may hold the dragon, the smallest sizes first.

    widest: longest extent of the free ground [m]; gated: the dragon comes from a street, so it need not stand on the
    figure, but a closed figure must still be longer than it
    """
    return (shape for shape in SHAPES[figure](needs, widest, gated) if shape.pieces is not None)


def _rings(needs: Needs, widest: float, gated: bool) -> Iterator[Shape]:
    least = needs.length_along(max(needs.length / math.tau, needs.radii[0])) + needs.gap
    for scale in SCALES:
        around = max(scale * least, math.tau * needs.radii[0])
        for aspect, corner in RINGS:
            # Around = 4 (half length + half width) - (8 - 2 pi) corner radius.
            half = around / (4.0 * (aspect + 1.0) - (8.0 - math.tau) * corner)
            if half * corner >= needs.tight and 2.0 * aspect * half <= widest:
                yield Shape(Figure.RING, (aspect * half, half, corner * half))


def tight_rings(needs: Needs, widest: float) -> Iterator[Shape]:
    """Rings for a dragon that has no room on an easy bend, the tightest first. widest: see shapes()"""
    for radius in (scale * needs.tight for scale in TIGHT_RADII):
        least = needs.length_along(max(needs.length / math.tau, radius)) + needs.gap
        for aspect, corner in RINGS:
            half = radius / corner
            around = half * (4.0 * (aspect + 1.0) - (8.0 - math.tau) * corner)
            if around >= least and 2.0 * aspect * half <= widest:
                yield Shape(Figure.RING, (aspect * half, half, radius))


def _eights(needs: Needs, widest: float, gated: bool) -> Iterator[Shape]:
    for scale in SCALES[:4]:
        for ratio in EIGHTS:
            per_radius = math.pi + 2.0 * math.asin(1.0 / ratio) + 2.0 * math.sqrt(ratio * ratio - 1.0)
            radius = max(needs.radii[0], scale * (needs.length_along(needs.radii[0] * 2.0) + needs.gap) / per_radius)
            if 2.0 * radius * (1.0 + ratio) <= widest:
                yield Shape(Figure.EIGHT, (radius, ratio))


def _serpentines(needs: Needs, widest: float, gated: bool) -> Iterator[Shape]:
    for lanes in LANES:
        for wide in LANE_RADII:
            radius = wide * needs.radii[0]
            turns = (lanes - 1) * math.pi * radius
            least = 2.0 * radius if gated else (needs.length_along(radius) * (1.0 + DANCED) - turns) / (2.0 * lanes)
            for scale in SCALES[:4]:
                half = max(scale * least, radius)
                if max(2.0 * (half + radius), 2.0 * radius * (lanes - 1)) <= widest:
                    yield Shape(Figure.SERPENTINE, (float(lanes), half, radius))


def _spirals(needs: Needs, widest: float, gated: bool) -> Iterator[Shape]:
    apart = 2.0 * needs.straight_side + 2.0 * needs.free
    for wide in TURNS:
        turning = 2.0 * wide * needs.tight
        for room in (1.15, 1.4, 1.8, 2.4, 3.0):
            pitch = 2.0 * room * apart
            held = 1.5 * math.pi * turning if gated else needs.length_along(turning) * 1.05 + needs.gap
            outer = math.sqrt(turning**2 + held * pitch / math.pi)
            if 2.0 * outer <= widest:
                yield Shape(Figure.SPIRAL, (outer, turning, pitch))


SHAPES: dict[Figure, Callable[[Needs, float, bool], Iterator[Shape]]] = {
    Figure.RING: _rings,
    Figure.EIGHT: _eights,
    Figure.SERPENTINE: _serpentines,
    Figure.SPIRAL: _spirals,
    Figure.PARADE: lambda needs, widest, gated: iter(()),
}
