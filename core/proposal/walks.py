"""Paths of straight stretches and arcs as steps, and the shortest ones between two poses (Dubins).

A pose is x, y [m] and heading [rad]; a step is its length [m] and its curvature [1/m], counter-clockwise positive. With
the least radius r, a shortest path between two poses is one of six words of three steps, each a left or a right arc of
radius r or a line: LSL, RSR, LSR, RSL, RLR, LRL (L. E. Dubins, On curves of minimal length with a constraint on average
curvature, 1957). In units of r, with the first pose at the origin, d the distance to the second one, and alpha, beta
the headings relative to the line between them, the lengths follow from the closed triangle or tangent of the circles
(A. M. Shkel and V. Lumelsky, Classification of the Dubins set, 2001).
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence

from core.paths.pieces import LENGTH_MIN, Arc, Coil, Line, Piece
from core.values import Point

Pose = tuple[float, float, float]
Step = tuple[float, float]
# Shorter steps are left out, and ends of a path that are nearer to a pose meet it [m]: far below JOINT_GAP.
NOTHING = 1e-10
# Square of a line between two arcs to the same side below which rounding may make a whole turn of it [1].
ONE_ARC = 1e-10


def moved(pose: Pose, step: Step) -> Pose:
    """The pose after a step.

    >>> moved((0.0, 0.0, 0.0), (2.0, 0.0))
    (2.0, 0.0, 0.0)
    """
    (x, y, heading), (length, curvature) = pose, step
    half = 0.5 * length * curvature
    # A product with a tiny curvature rounds to a few steps of the least number; only its own quotient is right.
    chord = length * (math.sin(half) / half) if half else length
    return (x + chord * math.cos(heading + half), y + chord * math.sin(heading + half), heading + 2.0 * half)


def in_world(pose: Pose, local: Pose) -> Pose:
    """A pose that is given beside another one."""
    (x, y, turn), (u, v, heading) = pose, local
    cos, sin = math.cos(turn), math.sin(turn)
    return (x + cos * u - sin * v, y + sin * u + cos * v, heading + turn)


def pieces_of(pose: Pose, steps: Iterable[Step]) -> tuple[list[Piece], Pose]:
    """The pieces of a path from a pose, and the pose at its end. raises: InvalidValue for a step of almost no length"""
    pieces: list[Piece] = []
    for length, curvature in joined(steps):
        after = moved(pose, (length, curvature))
        if curvature == 0.0:
            pieces.append(Line(pose[:2], after[:2]))
        else:
            radius, side = 1.0 / abs(curvature), math.copysign(1.0, curvature)
            x, y, heading = pose
            centre = (x - side * radius * math.sin(heading), y + side * radius * math.cos(heading))
            pieces.append(Arc(centre, radius, heading - side * 0.5 * math.pi, length * curvature))
        pose = after
    return pieces, pose


def joined(steps: Iterable[Step]) -> list[Step]:
    """The steps without those of no length; consecutive ones of the same curvature become one."""
    kept: list[Step] = []
    for length, curvature in steps:
        if length <= NOTHING:
            continue
        if kept and kept[-1][1] == curvature:
            length += kept.pop()[0]
        kept.append((length, curvature))
    return kept


def long_enough(steps: Iterable[Step]) -> bool:
    """True if a route can be made of the steps."""
    return all(length >= LENGTH_MIN for length, _ in joined(steps))


def length_of(steps: Iterable[Step]) -> float:
    """Length of all steps [m]."""
    return sum(length for length, _ in steps)


def stretch(loop: Sequence[Step], start: float, length: float) -> list[Step]:
    """The steps of a closed path from a place on, round and round for a length [m]."""
    steps: list[Step] = []
    around = length_of(loop)
    skip, left = start % around, length
    while left > NOTHING:
        for one, curvature in loop:
            if skip >= one:
                skip -= one
                continue
            taken = min(one - skip, left)
            steps.append((taken, curvature))
            skip, left = 0.0, left - taken
            if left <= NOTHING:
                break
    return joined(steps)


def along(pose: Pose, loop: Sequence[Step], distance: float) -> Pose:
    """The pose on a closed path, at a distance from its beginning [m]."""
    for step in stretch(loop, 0.0, distance % length_of(loop)):
        pose = moved(pose, step)
    return pose


def mirrored(steps: Iterable[Step]) -> list[Step]:
    """The mirror image: left becomes right."""
    return [(length, -curvature) for length, curvature in steps]


def placed(pieces: Iterable[Piece], pose: Pose) -> list[Piece]:
    """Pieces rotated about the origin by the heading of a pose, and moved to its place."""
    turn = pose[2]

    def at(point: Point) -> Point:
        return in_world(pose, (*point, 0.0))[:2]

    result: list[Piece] = []
    for piece in pieces:
        if isinstance(piece, Line):
            result.append(Line(at(piece.start), at(piece.end)))
        elif isinstance(piece, Arc):
            result.append(Arc(at(piece.centre), piece.radius, piece.start_angle + turn, piece.sweep))
        elif isinstance(piece, Coil):
            turns = (piece.pitch, piece.start_turns, piece.end_turns)
            result.append(Coil(*turns, at(piece.centre), piece.rotation + turn))
    return result


def dubins(begin: Pose, end: Pose, radius: float) -> list[tuple[Step, Step, Step]]:
    """The paths of three steps between two poses with arcs of a radius [m], the shortest first.

    Those whose end misses the pose by NOTHING, by rounding, are left out: poses a few micrometres apart may have none.

    >>> [round(length, 3) for length, _ in dubins((0, 0, 0), (9, 0, 0), 2.0)[0]]
    [0.0, 9.0, 0.0]
    """
    dx, dy = end[0] - begin[0], end[1] - begin[1]
    d, theta = math.hypot(dx, dy) / radius, math.atan2(dy, dx)
    words = list(_words(d, begin[2] - theta, end[2] - theta))
    k = 1.0 / radius
    curvature = {"L": k, "S": 0.0, "R": -k}
    paths = []
    for word, lengths in words:
        first, middle, last = ((radius * part, curvature[letter]) for letter, part in zip(word, lengths, strict=True))
        if _gap(moved(moved(moved(begin, first), middle), last), end) < NOTHING:
            paths.append((first, middle, last))
    return sorted(paths, key=length_of)


def _words(d: float, alpha: float, beta: float) -> Iterator[tuple[str, tuple[float, float, float]]]:
    """Words with the lengths of their steps, in radii."""
    sa, sb, ca, cb, cab = math.sin(alpha), math.sin(beta), math.cos(alpha), math.cos(beta), math.cos(alpha - beta)
    for side in (1.0, -1.0):  # both arcs to the same side
        line = 2.0 + d * d - 2.0 * cab + side * 2.0 * d * (sa - sb)
        if line >= 0.0:
            toward = math.atan2(side * (cb - ca), d + side * (sa - sb))
            yield (
                "LSL" if side > 0.0 else "RSR",
                (_turn(side * (toward - alpha)), math.sqrt(line), _turn(side * (beta - toward))),
            )
        if line < ONE_ARC:
            yield "LSL" if side > 0.0 else "RSR", (_turn(side * (beta - alpha)), 0.0, 0.0)
    for side in (1.0, -1.0):  # to opposite sides
        line = d * d - 2.0 + 2.0 * cab + side * 2.0 * d * (sa + sb)
        if line >= 0.0:
            p = math.sqrt(line)
            toward = math.atan2(-side * (ca + cb), d + side * (sa + sb)) + side * math.atan2(2.0, p)
            yield (
                "LSR" if side > 0.0 else "RSL",
                (_turn(side * (toward - alpha)), p, _turn(side * (toward - beta))),
            )
    for side in (1.0, -1.0):  # three arcs
        cosine = (6.0 - d * d + 2.0 * cab + side * 2.0 * d * (sb - sa)) / 8.0
        if abs(cosine) <= 1.0:
            p = 2.0 * math.pi - math.acos(cosine)
            first = _turn(side * (math.atan2(side * (cb - ca), d + side * (sa - sb)) - alpha) + 0.5 * p)
            yield "LRL" if side > 0.0 else "RLR", (first, p, _turn(side * (beta - alpha) - first + p))


def _gap(pose: Pose, other: Pose) -> float:
    """Largest difference of two poses [m], [rad]."""
    turned = math.remainder(pose[2] - other[2], math.tau)
    return max(abs(pose[0] - other[0]), abs(pose[1] - other[1]), abs(turned))


def _turn(angle: float) -> float:
    """An angle in [0, 2 pi); 0 for one that rounding alone keeps from it [rad]."""
    turned = angle % (2.0 * math.pi)
    return 0.0 if 2.0 * math.pi - turned < 1e-12 else turned


def way_through(begin: Pose, end: Pose, channel: tuple[Pose, float]) -> float:
    """The straight ways from a pose to a channel, and from its end to another pose, in all [m]."""
    entry, length = channel
    return math.dist(begin[:2], entry[:2]) + math.dist(moved(entry, (length, 0.0))[:2], end[:2])
