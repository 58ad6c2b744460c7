"""Small pictures of the five answers, as lines that the page draws."""

from __future__ import annotations

from collections.abc import Sequence
from enum import StrEnum

import numpy as np

import core
from app.wire.fields import Answer
from core import Budget, Dance, Dragon, bench_outlines
from core.language import say
from core.values import Floats, Point

# Ground around a first contact that its picture shows [m].
AROUND = 2.6
# Pitches of the staircase, around the least one [1], and their number.
STAIRS, STEPS = (0.85, 1.35), 56
# Way of the head around the turn whose speeds are drawn [m], and the number of samples.
WAY, SAMPLES = (-4.0, 34.0), 220
# Distance between two points of a path [m], and decimals of a point: a pixel of a picture is larger.
PATH_STEP, DECIMALS = 0.15, 3
# Handles whose speeds are drawn, of which the first one that is fastest comes last.
BESIDE = (1, 8)


class Role(StrEnum):
    """What a line is: it gives the line its look."""

    PATH = "path"
    BENCH = "bench"
    HEAD = "head"
    TOUCHED = "touched"
    FIRST_ARC = "first_arc"
    SECOND_ARC = "second_arc"
    CURVE = "curve"
    PALE = "pale"
    LIMIT = "limit"
    MARK = "mark"


class Stroke(Answer):
    """One line of a picture.

    role: what it is
    points: its points, x and y: of a map in m, of a curve in the units of its axes [m or 1]
    """

    role: Role
    points: list[Point]


class Picture(Answer):
    """A picture of an answer, as lines.

    words: what it shows
    equal: whether it is a map, with one scale for x and y; else a curve
    strokes: its lines, from the back to the front
    """

    words: str
    equal: bool
    strokes: list[Stroke]


def _stroke(role: Role, points: Floats | Sequence[Point]) -> Stroke:
    return Stroke(
        role=role, points=[(x, y) for x, y in np.round(np.asarray(points, dtype=np.float64), DECIMALS).tolist()]
    )


def of_motion(motion: core.Trajectory, time: float) -> Picture:
    """Every handle at one instant. motion: with that instant last"""
    handles = motion.position[-1]
    words = say("The dragon at {time:g} s, the head in red", time=time)
    return Picture(words=words, equal=True, strokes=[_stroke(Role.BENCH, handles[1:]), _stroke(Role.HEAD, handles[:2])])


def of_contact(contact: core.FirstContact, handles: Floats, dragon: Dragon) -> Picture:
    """The benches around a first contact. handles: (H, 2) [m]"""
    assert contact.point is not None
    point, (a, b) = np.array(contact.point), contact.benches or (0, 0)
    outlines = bench_outlines(dragon, handles)
    near = np.abs(outlines - point).max(axis=-1).min(axis=-1) < AROUND
    roles = {a: Role.HEAD, b: Role.TOUCHED}
    rings = np.concatenate([outlines, outlines[:, :1]], axis=1)
    strokes = [_stroke(roles.get(k, Role.BENCH), rings[k]) for k in np.flatnonzero(near).tolist() if k not in roles]
    strokes += [_stroke(role, rings[k]) for k, role in roles.items()]
    words = say("Benches {a} and {b} where they touch", a=a, b=b)
    return Picture(words=words, equal=True, strokes=[*strokes, _stroke(Role.MARK, [contact.point])])


def of_pitch(minimum: core.MinimumPitch, radius: float, dragon: Dragon, budget: Budget) -> Picture:
    """How near to the centre the head comes, against the pitch. radius: of the turning circle [m]"""
    pitches = minimum.pitch * np.linspace(*STAIRS, STEPS)
    scan = core.pitch_scan(dragon, pitches, locate=False, budget=budget)
    stairs = np.stack([scan.pitch, scan.radius], axis=-1)
    top = float(scan.radius.max(initial=radius))
    strokes = [
        _stroke(Role.LIMIT, [(pitches[0], radius), (pitches[-1], radius)]),
        _stroke(Role.MARK, [(minimum.pitch, 0.0), (minimum.pitch, top)]),
        _stroke(Role.PALE, stairs),
        *(_stroke(Role.CURVE, stairs[a:b]) for a, b in scan.pieces if b - a > 1),
    ]
    return Picture(
        words=say("Where the head stops, against the pitch: dashed the circle, red the answer"),
        equal=False,
        strokes=strokes,
    )


def of_turn(turn: core.Turn) -> Picture:
    """The two arcs between the coils, in their circle."""
    middle, reach = turn.radii[0] * turn.angles[0], 3.0 * turn.turning_radius
    pieces = [
        (Role.PATH, -reach, 0.0),
        (Role.PATH, turn.length, turn.length + reach),
        (Role.FIRST_ARC, 0.0, middle),
        (Role.SECOND_ARC, middle, turn.length),
    ]
    angles = np.linspace(0.0, 2.0 * np.pi, 73)
    circle = turn.turning_radius * np.stack([np.cos(angles), np.sin(angles)], axis=-1)
    lines = [_stroke(role, turn.position(np.linspace(a, b, max(2, int((b - a) / PATH_STEP))))) for role, a, b in pieces]
    words = say("The turn in its circle: the first arc in red, the second one in blue")
    return Picture(words=words, equal=True, strokes=[_stroke(Role.LIMIT, circle), *lines])


def of_speed(fastest: core.MaximumHeadSpeed, dragon: Dragon, turn: core.Turn, budget: Budget) -> Picture:
    """Speeds of some handles over that of the head, against its way through the turn."""
    peak = fastest.time_at_unit_head_speed
    travel = np.unique([*np.linspace(*WAY, SAMPLES), peak])
    rates = core.trajectory(Dance(dragon, turn), travel, budget=budget).speed
    first = fastest.handles[0]
    curves = [(Role.PALE, k) for k in BESIDE if k <= dragon.benches and k != first] + [(Role.CURVE, first)]
    strokes = [
        _stroke(Role.LIMIT, [(WAY[0], fastest.speed_ratio), (WAY[1], fastest.speed_ratio)]),
        *(_stroke(role, np.stack([travel, rates[:, k]], axis=-1)) for role, k in curves),
        _stroke(Role.MARK, [(peak, fastest.speed_ratio)]),
    ]
    words = say("Speed of handle {k} over that of the head, on the way through the turn", k=first)
    return Picture(words=words, equal=False, strokes=strokes)
