"""The turn with clothoids: two arcs whose curvature leads into one another evenly, and from and to the coils."""

from __future__ import annotations

import math
from functools import cached_property

import numpy as np

from core.checks import SIZE_MIN, checked_number
from core.errors import InvalidValue
from core.paths.pieces import Clothoid
from core.paths.route import Route
from core.paths.turn import OUTSIDE, Turn
from core.quantities import quantities
from core.values import Floats, Point

# Longest step in which the clothoids grow from the arcs of a turn [m], and most of Newton's steps in each.
GROWTH, NEWTON_STEPS = 0.5, 20
# Longest step of Newton's [1], and the distance that closes the turn [m] and [rad]: far below JOINT_GAP.
NEWTON_MOST, CLOSED = 0.7, 1e-11
# Steps of the difference quotients for Newton's [m] and [1/m]; longest clothoid [m].
QUOTIENT, LONGEST = 1e-6, 100.0
# Samples of the distance from the centre, along the turn and around the furthest ones [1].
SAMPLES = 2_001


# Where the curvature jumps, handles behind are the fastest: from one arc of a turn to the other by 1 / r1 + 1 / r2.
# Five clothoids take the place of the two arcs: from the coil to the curvature -1 / r1 over `ends`, the first arc, to
# 1 / r2 over `middle`, the second arc, to the coil over `ends`. With r1 = ratio r2 there are three unknowns, 1 / r2 and
# the lengths of both arcs; and three conditions: the place of the exit, and the direction there. Newton's iteration
# starts from the turn of two arcs, and the clothoids grow in steps up to their lengths.
class ClothoidTurn(Route):
    """Two arcs that clothoids join to one another and to the coils, inwards and outwards, of a Turn.

    pitch, turning_radius, ratio, start_turns, entry_radius, exit_radius: as for a Turn, whose arcs these begin from
    middle: length of the clothoid between the arcs [m]; ends: of those between arc and coil [m]; 0: the curvature jumps
        there, by less than between the arcs of a Turn
    radii, centres, angles: of both arcs [m], [m], [rad]; entry, exit: where the turn begins and ends [m];
    tangent_point: where its curvature changes its sign [m]; length: from the entry, where s = 0, to the exit [m]
    raises: InvalidValue, also where no such turn is found, or where it leaves the circle

    >>> turn = ClothoidTurn(1.7, ratio=1.0, middle=4.0, ends=0.5)
    >>> round(turn.length, 6), [round(radius, 6) for radius in turn.radii]
    (13.410237, [2.097519, 2.097519])
    """

    def __init__(
        self,
        pitch: float,
        turning_radius: float = 4.5,
        ratio: float = 2.0,
        *,
        middle: float,
        ends: float = 0.0,
        start_turns: float = 16.0,
        entry_radius: float | None = None,
        exit_radius: float | None = None,
    ) -> None:
        arcs = Turn(
            pitch, turning_radius, ratio, start_turns=start_turns, entry_radius=entry_radius, exit_radius=exit_radius
        )
        self.middle = checked_number("middle", middle, "m", SIZE_MIN, LONGEST)
        self.ends = checked_number("ends", ends, "m", 0.0, LONGEST)
        if 0.0 < self.ends < SIZE_MIN:
            raise InvalidValue("ends", "must be 0, or {low} or more", **quantities("m", got=self.ends, low=SIZE_MIN))
        self.pitch, self.turning_radius, self.ratio = arcs.pitch, arcs.turning_radius, arcs.ratio
        self.entry_radius, self.exit_radius, self.start_turns = arcs.entry_radius, arcs.exit_radius, arcs.start_turns
        first, last = arcs.pieces[0], arcs.pieces[-1]
        coils = Route([first]), Route([last])
        self._ways = _state(coils[0], coils[0].end), _state(coils[1], coils[1].begin)
        bends = np.array([1.0 / arcs.radii[1], *np.multiply(arcs.radii, arcs.angles)])
        steps = math.ceil(max(self.middle, 2.0 * self.ends) / GROWTH)
        for k in range(1, steps + 1):
            bends = self._closed(bends, k / steps)
        between = self._pieces(bends, 1.0)
        super().__init__((first, *between, last), start=coils[0].end)
        self.radii = self.ratio / float(bends[0]), 1.0 / float(bends[0])
        self.length = math.fsum(piece.length for piece in between)
        self._settle_arcs(between[1 if self.ends else 0 :])
        if self.extent > self.turning_radius + OUTSIDE:
            rule, got = "must hold the turn, which is up to {extent} from its centre", self.turning_radius
            raise InvalidValue("turning_radius", rule, **quantities("m", 6, got=got, extent=self.extent))

    def _settle_arcs(self, pieces: list[Clothoid]) -> None:
        """Set what a Turn has too. pieces: the first arc, the clothoid between the arcs, the second arc, and others"""
        first, middle, second, *_ = pieces
        self.centres = _centre(first), _centre(second)
        self.angles = first.length / self.radii[0], second.length / self.radii[1]
        before = self.ends + first.length + middle.length * self.radii[1] / (self.radii[0] + self.radii[1])
        self.entry, self.tangent_point, self.exit = (_point(self.position(s)) for s in (0.0, before, self.length))

    @property
    def _definition(self) -> tuple[object, ...]:
        return *super()._definition, self.turning_radius

    def __repr__(self) -> str:
        ways = ("middle", "ends", "start_turns", "entry_radius", "exit_radius")
        arguments = ", ".join(f"{name}={getattr(self, name)!r}" for name in ways)
        return f"ClothoidTurn({self.pitch!r}, {self.turning_radius!r}, {self.ratio!r}, {arguments})"

    def _pieces(self, bends: Floats, share: float) -> list[Clothoid]:
        """The pieces between the coils. bends: curvature of the second arc [1/m], lengths of both [m]; share: of the
        lengths of the clothoids"""
        (x, y, heading, begin), (_, _, _, finish) = self._ways
        sharp, first, second = bends.tolist()
        middle, place = max(share * self.middle, SIZE_MIN), (x, y)
        ends = max(share * self.ends, SIZE_MIN) if self.ends else 0.0
        left, right = sharp, -sharp / self.ratio
        pieces = []
        for start, end, length in (
            (begin, right, ends),
            (right, right, first),
            (right, left, middle),
            (left, left, second),
            (left, finish, ends),
        ):
            if length > 0.0:
                pieces.append(Clothoid(place, heading, start, end, length))
                place, heading = pieces[-1].end, pieces[-1].end_heading
        return pieces

    def _gap(self, bends: Floats, share: float) -> Floats:
        """How far the end of the pieces is from the exit (3,) [m], [m] and [rad]."""
        last = self._pieces(bends, share)[-1]
        x, y, heading, _ = self._ways[1]
        return np.array([last.end[0] - x, last.end[1] - y, math.remainder(last.end_heading - heading, 2.0 * math.pi)])

    def _closed(self, bends: Floats, share: float) -> Floats:
        """The bends whose pieces end at the exit, from a guess. raises: InvalidValue if none are found"""
        for _ in range(NEWTON_STEPS):
            gap = self._gap(bends, share)
            if np.abs(gap).max() < CLOSED:
                return bends
            moved = [self._gap(bends + QUOTIENT * unit, share) - gap for unit in np.eye(3)]
            slopes = np.stack(moved, axis=1) / QUOTIENT
            if abs(np.linalg.det(slopes)) < CLOSED:
                break
            step = np.linalg.solve(slopes, gap)
            bends = bends - step * min(1.0, NEWTON_MOST / np.abs(step).max())
            if bends.min() < SIZE_MIN or bends[0] > 1.0 / SIZE_MIN:
                break
        rule = "must be shorter: no turn between these coils is found with clothoids of {length} and {ends}"
        lengths = quantities("m", 6, got=self.middle, length=self.middle * share, ends=self.ends * share)
        raise InvalidValue("middle", rule, **lengths)

    # Between two samples at a distance h the distance from the centre exceeds both by at most
    # (curvature + 1 / distance) h^2 / 8: below 1e-11 m once the samples around the furthest ones are refined.
    @cached_property
    def extent(self) -> float:
        """Largest distance of the turn from the centre [m]."""
        step = self.length / (SAMPLES - 1)
        samples = np.linspace(0.0, self.length, SAMPLES)
        far = np.hypot(*self.position(samples).T)
        crests = samples[1:-1][(far[1:-1] >= far[:-2]) & (far[1:-1] >= far[2:])]
        near = np.clip(crests[:, None] + np.linspace(-step, step, SAMPLES), 0.0, self.length)
        return float(max(far.max(), np.hypot(*np.moveaxis(self.position(near), -1, 0)).max(initial=0.0)))


def _centre(arc: Clothoid) -> Point:
    """Centre of a clothoid of one curvature [m]."""
    (x, y), radius = arc.start, 1.0 / arc.start_curvature
    return x - radius * math.sin(arc.heading), y + radius * math.cos(arc.heading)


def _point(place: Floats) -> Point:
    x, y = place.tolist()
    return x, y


def _state(route: Route, s: float) -> tuple[float, float, float, float]:
    """x, y [m], heading [rad] and curvature [1/m] of a route at an arc length."""
    (x, y), (tx, ty) = route.position(s).tolist(), route.tangent(s).tolist()
    return x, y, math.atan2(ty, tx), float(route.curvature(s))
