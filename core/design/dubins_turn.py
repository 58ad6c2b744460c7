"""The turn with a straight piece between its arcs (a Dubins path): the shortest one of a scan.

An arc of radius r1 leads from the entry E into a line, the line into an arc of radius r2 that ends at the exit X. The
arcs turn in opposite directions, so the line is an inner tangent of their circles (L. E. Dubins, On curves of minimal
length with a constraint on average curvature, 1957). With complex numbers for points, t and u the directions at E and
X, and sigma = 1 for a first arc to the left, -1 for one to the right:
    C1 = E + i sigma r1 t,  C2 = X - i sigma r2 u,  w = C2 - C1,
    length of the line l = sqrt(|w|^2 - (r1 + r2)^2),  its direction h = w / (l - i sigma (r1 + r2)),
because the arcs meet the line at C1 - i sigma r1 h and C2 + i sigma r2 h. The arcs turn by the angles from t to h and
from h to u in their directions. There is none if the circles overlap, and l = 0 is a turn of two arcs.

Between the same ends a turn is the shorter the smaller its arcs are, so both are as tight as the ratio allows.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from core.contact.answer import Outcome
from core.contact.first_contact import contact_within
from core.dance import Dance
from core.design.turn_bounds import least_entry
from core.design.turn_circle import CheckedCircle, checked_circle
from core.design.turn_moves import least_bend
from core.display import WAY_MOST, Readable, display
from core.dragon import Dragon, chord_values
from core.errors import InvalidValue
from core.kernels import Budget, Halted
from core.language import say
from core.paths.following import bends_widely
from core.paths.pieces import LENGTH_MIN, Arc, Coil, Line, Piece
from core.paths.route import WAY_BEFORE, Route
from core.paths.turn import OUTSIDE
from core.quantities import Quantity, quantities
from core.questions import question_about, too_much
from core.values import Floats, Point

# Step of the grid of entry and exit radii, as a part of the circle's radius [1], and the width to which the shortest
# place of it is lowered [m].
GRID, WIDTH = 0.01, 1e-6
# Radius by which arcs are wider than the least one, for rounding [1].
WIDER = 1e-12
# Largest work [1], see core/kernels/constants.py. The contest's dragon takes 4e7 and 2 s.
DUBINS_WORK = 5e8
# Directions of the steps [rad]: close to one another, because shorter turns may lie in a narrow sector beside a border.
SECTORS = np.linspace(0.0, 2.0 * math.pi, 96, endpoint=False)


@dataclass(frozen=True, slots=True, repr=False)
class DubinsTurn(Readable):
    """A turn of arc, straight piece, arc that was danced without a contact.

    path: both coils and the three pieces, s = 0 at the entry
    length: length of the three [m]
    entry_radius: distance of the entry from the centre [m]
    exit_radius: distance of the exit from the centre [m]
    radii: radii of both arcs [m]
    straight: length of the straight piece [m]
    evaluations: number of tried dances

    >>> answer = dubins_turn(Dragon(5), 1.7)
    >>> round(answer.entry_radius, 3), [type(piece).__name__ for piece in answer.path.pieces]
    (4.257, ['Coil', 'Arc', 'Line', 'Arc', 'Coil'])
    """

    path: Route
    length: float
    entry_radius: float
    exit_radius: float
    radii: Point
    straight: float
    evaluations: int

    def _drawn_lines(self) -> list[Floats]:
        return [self.path.position(np.linspace(-WAY_BEFORE, self.length + WAY_BEFORE, WAY_MOST))]

    def _line(self) -> str:
        return say(
            "length {length}, {straight} of it straight, entry {entry}, exit {exit}",
            length=display(self.length, "m"), straight=display(self.straight, "m"),
            entry=display(self.entry_radius, "m"), exit=display(self.exit_radius, "m"),
        )  # fmt: skip


@question_about("dragon", Dragon)
def dubins_turn(
    dragon: Dragon,
    pitch: float,
    turning_radius: float = 4.5,
    ratio: float = 1.0,
    *,
    start_turns: float = 16.0,
    margin: float = 0.0,
    budget: Budget | None = None,
) -> DubinsTurn:
    """The shortest turn of arc, straight piece and arc inside the circle that was found on a grid of entries and exits.

    pitch, turning_radius, margin [m]; ratio: radius of the first arc over that of the second, of which the smaller one
    is as tight as benches can follow; start_turns: of the coils
    It is proven that nothing touches in it from one end of its coils to the other; not that no turn is shorter.
    budget: default: DUBINS_WORK
    raises: TooMuchWork; InvalidValue (turning_radius) if none of the tried turns can be danced

    >>> turn = dubins_turn(Dragon(20), 1.7)
    >>> round(turn.length, 3), round(turn.straight, 2)
    (8.224, 0.0)
    """
    circle = checked_circle(pitch, turning_radius, ratio, start_turns, margin)
    least = least_bend(dragon) * (1.0 + WIDER)
    radii = (least * max(1.0, ratio), least * max(1.0, 1.0 / ratio))
    work = (budget or Budget()).within(DUBINS_WORK)
    search = _Scan(dragon, circle, radii, work)
    try:
        turn = search.shortest()
    except Halted as halted:
        rule = (
            "must be smaller, or benches fewer: no turn was found {then}; the {benches} chords are {shortest} to "
            "{longest} long"
        )
        size = Quantity(circle.radius, "m")
        raise too_much(work, "turning_radius", rule, size, **chord_values(dragon)) from halted
    if turn is None:
        why = "in every turn with a straight piece that was tried inside it benches come within {margin}"
        values = quantities("m", got=circle.radius, margin=circle.margin)
        raise InvalidValue("turning_radius", f"must be larger, or the pitch: {why}", **values)
    return turn


class _Scan:
    """The turns of one dragon with arcs of given radii."""

    def __init__(self, dragon: Dragon, circle: CheckedCircle, radii: Point, budget: Budget) -> None:
        self.dragon, self.radii, self.budget = dragon, radii, budget
        self.pitch, self.radius, _, self.turns, self.margin = circle
        self.growth = circle.growth
        self.evaluations = 0

    def shortest(self) -> DubinsTurn | None:
        """The shortest turn of the grid that can be danced, lowered by steps that halve; None if there is none."""
        inner = least_entry(self.growth, self.radius, least_bend(self.dragon))
        radii = np.arange(self.radius, inner, -GRID * self.radius)
        ends = np.array(np.meshgrid(radii, radii)).reshape(2, -1)
        tried = []
        for sigma in (-1.0, 1.0):
            lengths = arcs_and_line(self.growth, ends, self.radii, sigma)[0]
            fits = np.flatnonzero(np.isfinite(lengths))
            tried += [(float(lengths[k]), (float(ends[0, k]), float(ends[1, k])), sigma) for k in fits]
        for length, place, sigma in sorted(tried):
            if self._proven(place, sigma) is not None:
                return self._lowered(length, place, sigma)
        return None

    def _lowered(self, length: float, place: tuple[float, float], sigma: float) -> DubinsTurn | None:
        """The turn at a place, made shorter by steps in all directions, down to WIDTH."""
        step = 0.5 * GRID * self.radius
        while step > WIDTH:
            around = np.array(place) + step * np.stack([np.cos(SECTORS), np.sin(SECTORS)], axis=-1)
            beside = np.minimum(around, self.radius)
            lengths = arcs_and_line(self.growth, beside.T, self.radii, sigma)[0]
            for k in np.argsort(lengths, kind="stable"):
                at = (float(beside[k, 0]), float(beside[k, 1]))
                if lengths[k] < length and self._proven(at, sigma) is not None:
                    length, place = float(lengths[k]), at
                    break
            else:
                step *= 0.5
        return self._proven(place, sigma)

    def _proven(self, place: tuple[float, float], sigma: float) -> DubinsTurn | None:
        """The turn at a place if it is inside the circle and proven free of contacts."""
        self.budget.afford()
        turn = self._turn(place, sigma)
        if turn is None or not bends_widely(self.dragon, turn.path):
            return None
        dance = Dance(self.dragon, turn.path)
        self.evaluations += 1
        for start, stop in ((0.0, None), (float(turn.path.begin), 0.0)):
            within = contact_within(self.budget, dance, margin=self.margin, start=start, stop=stop)
            if within.outcome is Outcome.UNDECIDED:
                self.budget.afford()  # nothing is left, or rounding hides whether benches touch
            if within.outcome is not Outcome.CLEAR:
                return None
        return turn

    def _turn(self, place: tuple[float, float], sigma: float) -> DubinsTurn | None:
        """The turn at a place; None if a piece is too short or leaves the circle."""
        a, b = place
        length, straight, first, second, c1, c2, h = (
            one[0] for one in arcs_and_line(self.growth, np.array([[a], [b]]), self.radii, sigma)
        )
        r1, r2 = self.radii
        if not math.isfinite(length) or min(r1 * first, straight, r2 * second) < LENGTH_MIN:
            return None
        begin, _ = _place(self.growth, a)
        joints = c1 - 1j * sigma * r1 * h, c2 + 1j * sigma * r2 * h
        arcs = (
            Arc(_point(c1), r1, float(np.angle(begin - c1)), float(sigma * first)),
            Arc(_point(c2), r2, float(np.angle(joints[1] - c2)), float(-sigma * second)),
        )
        if max(_extent(arc) for arc in arcs) > self.radius + OUTSIDE:
            return None
        pieces: list[Piece] = [
            Coil(self.pitch, self.turns, a / self.pitch), arcs[0], Line(_point(joints[0]), _point(joints[1])), arcs[1],
            Coil(self.pitch, b / self.pitch, self.turns, rotation=math.pi),
        ]  # fmt: skip
        path = Route(pieces, start=Route(pieces[:1]).end)
        return DubinsTurn(path, float(length), a, b, self.radii, float(straight), self.evaluations + 1)


def arcs_and_line(growth: float, ends: Floats, radii: Point, sigma: float) -> tuple[NDArray[Any], ...]:
    """Length, length of the line [m], both angles [rad], C1, C2 and the line's direction as complex numbers, each (N,).

    ends: radii of entry and exit [m], (2, N); not finite where the circles of the arcs overlap
    """
    (begin, t), (opposite, u) = _place(growth, ends[0]), _place(growth, ends[1])
    end, both = -opposite, sum(radii)
    # The exit is minus the place of the coil inwards, danced backwards, so the direction there is that of the coil.
    c1, c2 = begin + 1j * sigma * radii[0] * t, end - 1j * sigma * radii[1] * u
    w = c2 - c1
    with np.errstate(invalid="ignore"):
        line = np.sqrt(np.abs(w) ** 2 - both**2)
        h = w / (line - 1j * sigma * both)
        first = (sigma * np.angle(h / t)) % (2.0 * math.pi)
        second = (-sigma * np.angle(u / h)) % (2.0 * math.pi)
        length = radii[0] * first + line + radii[1] * second
    return length, line, first, second, c1, c2, h


def _place(growth: float, radius: float | Floats) -> tuple[Any, Any]:
    """Points of the coil inwards at radii [m], and the directions of travel there, as complex numbers."""
    theta = radius / growth
    return radius * np.exp(1j * theta), -np.exp(1j * theta) * (1.0 + 1j * theta) / np.hypot(1.0, theta)


def _extent(arc: Arc) -> float:
    """Largest distance of an arc from the origin [m]."""
    ends = [arc.start_angle, arc.start_angle + arc.sweep]
    points = [
        math.hypot(arc.centre[0] + arc.radius * math.cos(x), arc.centre[1] + arc.radius * math.sin(x)) for x in ends
    ]
    outwards = math.atan2(arc.centre[1], arc.centre[0])
    passed = math.copysign(1.0, arc.sweep) * (outwards - arc.start_angle) % (2.0 * math.pi)
    return max([*points, math.hypot(*arc.centre) + arc.radius] if passed <= abs(arc.sweep) else points)


def _point(z: complex) -> Point:
    return (float(z.real), float(z.imag))
