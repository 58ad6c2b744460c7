"""Known shortcuts to the contest's four numbers, each recomputed with its result.

Input: the name of a number. Output: the right one, and those of the shortcuts. State: each is computed once in a
process.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass, field
from functools import cache

import numpy as np

import core
from app.grade import contacts
from app.grade.contacts import EXACT_ANGLE, LOOSE_ANGLE, TURNING_RADIUS, StepKind
from app.grade.expected import Motion, Workbook, contact_time, dance_of, of_dance, right_turn
from app.grade.geometry import SheetClues, geometries
from app.grade.labels import SPEED
from app.grade.layout import TableKind
from app.grade.words import Note, Values
from core import BenchDragonError, Dance, Dragon, Spiral
from core.shapes.rectangles import corners, literal_corners

SPEED_LIMIT = 2.0  # [m/s], of the contest's question 5
# Steps of time in students' searches for an event [s], and for the highest speed or the graze of a pitch [s].
EVENT_STEPS = (0.001, 0.002, 0.005, 0.01, 0.02, 0.04, 0.05, 0.08, 0.1, 0.2, 0.25, 0.5, 1.0)
STEPS = (1.0, 0.5, 0.2, 0.1, 0.05, 0.02, 0.01)
# Steps of students' checks of the way to the circle: in time [s], radius [m] and angle of the head [rad], or numbers
# of equal parts from the start of the spiral to the circle, where radius and angle are the same.
PITCH_SAMPLES = {
    StepKind.TIME: (1.0, 0.5, 0.2, 0.1),
    StepKind.RADIUS: (0.1, 0.05, 0.02, 0.01, 0.005),
    StepKind.ANGLE: (0.5, 0.25, 0.2, 0.1, 0.05, 0.02, math.pi / 180.0),
    StepKind.PARTS: (99, 199, 499, 999),
}
# Steps of students' searches for the pitch [m].
PITCH_GRIDS = (0.01, 0.005, 0.001, 0.0005, 0.0001, 0.00005)
# The turn's speeds peak among the first handles, soon after the entry [s]; and the step in which they are sampled [s].
PEAK_BENCHES, PEAK_SPAN, PEAK_STEP = 30, 40.0, 0.01
# Errors of the turn that keep it smooth, so that samples show its highest speed.
SMOOTH = ("head_as_body", "body_as_head", "ratio_inverted", "equal_arcs_of_turn")


@dataclass(frozen=True)
class Finding:
    """A known error that explains numbers. error: its name; sentence: the error in words; evidence: the numbers

    chance: share of the numbers with as many digits that fit a known error too [1]; 0 for a sheet, whose digits decide
    kinds: of the sheets whose digits decide for it
    """

    error: str
    sentence: Note
    evidence: Note
    chance: float = 0.0
    kinds: frozenset[TableKind] = frozenset()


@dataclass(frozen=True)
class Shortcut:
    """Result of a shortcut. values: numbers in its words; exact: True if students hand in exactly this number"""

    error: str
    value: float
    values: Values = field(default_factory=dict)
    exact: bool = False


def _in_steps(error: str, value: float, step: float, *, exact: bool = False) -> Shortcut:
    """Result of a search in steps."""
    return Shortcut(error, value, {"step": f"{step:g}"}, exact)


UNITS = {"collision_time": "s", "pitch": "m", "speed": "m/s", "turn_length": "m"}


@cache
def right_answer(name: str) -> float:
    """The right value of one of UNITS, in its unit."""
    if name == "collision_time":
        return contact_time()
    if name == "pitch":
        return core.minimum_pitch(Dragon(), turning_radius=TURNING_RADIUS).pitch
    if name == "speed":
        return fastest().head_speed
    return right_turn().length


@cache
def fastest() -> core.MaximumHeadSpeed:
    """The answer to question 5."""
    return core.maximum_head_speed(dance_of(Workbook.RESULT4), SPEED_LIMIT)


@cache
def shortcuts(name: str) -> tuple[Shortcut, ...]:
    """The known shortcuts to one of UNITS, each with its result."""
    known = {"collision_time": _collision_times, "pitch": _pitches, "speed": _speeds, "turn_length": _lengths}
    return tuple(known[name]())


def _collision_times() -> Iterator[Shortcut]:
    right = contact_time()
    dance = dance_of(Workbook.RESULT2)
    for step in EVENT_STEPS:
        after, before = math.ceil(right / step) * step, math.floor(right / step) * step
        clear, touching = core.clearance_profile(dance, np.array([before, after])).clearance
        assert clear > 0.0 > touching
        yield _in_steps("time_steps", after, step, exact=True)
        yield _in_steps("time_steps_before", before, step, exact=True)
    for error, dragon in _other_dragons():
        if (time := core.first_contact(Dance(dragon, Spiral())).time) is not None:
            yield Shortcut(error, time)
    yield Shortcut(
        "loose_angle", contacts.angle_sum_time(corners, LOOSE_ANGLE), {"angle": f"{360.0 - LOOSE_ANGLE:.1f}"}
    )
    yield Shortcut("literal_corners", contacts.angle_sum_time(literal_corners, EXACT_ANGLE))


def _other_dragons() -> Iterator[tuple[str, Dragon]]:
    right = Dragon()
    yield "no_overhang", Dragon(head_length=float(right.chords[0]), body_length=float(right.chords[1]), overhang=0.0)
    yield "length_for_chord", Dragon(overhang=0.0)
    yield "head_as_body", Dragon(head_length=2.20)


def _pitches() -> Iterator[Shortcut]:
    rules = {
        "pose_on_circle": contacts.any_touch_at_start,
        "pose_on_circle_head": contacts.head_touches_at_start,
        "one_corner": contacts.corner_at_start,
    }
    for error, touches in rules.items():
        yield Shortcut(error, contacts.circle_pitch(touches))
    for sampled, steps in PITCH_SAMPLES.items():
        for step in steps:
            pitch = contacts.sampled_pitch(sampled, step, right_answer("pitch"))
            yield _in_steps(f"pitch_{sampled.value}_steps", pitch, step)
    for error, dragon in _other_dragons():
        with suppress(BenchDragonError):
            yield Shortcut(error, core.minimum_pitch(dragon, turning_radius=TURNING_RADIUS).pitch)


@cache
def pitch_grids() -> tuple[Shortcut, ...]:
    """Pitches from a search in steps: the first step above the right pitch, or above that of a shortcut."""
    starts = (Shortcut("pitch_steps", right_answer("pitch")), *shortcuts("pitch")[:3])
    results = []
    for one in starts:
        for step in PITCH_GRIDS:
            values = {"grid": f"{step:g}", "source": one.value}
            results.append(Shortcut(one.error, math.ceil(one.value / step) * step, values, exact=True))
    return tuple(results)


def _speeds() -> Iterator[Shortcut]:
    dance = Dance(Dragon(PEAK_BENCHES), right_turn())
    right = of_dance(dance)
    yield Shortcut("speed_ratio", fastest().speed_ratio)
    for step in STEPS[:6]:
        yield _in_steps("speed_time_steps", _fastest(right, step), step)
    for step in STEPS:
        times = np.arange(0.0, PEAK_SPAN, step)
        moved = np.linalg.norm(right(times + step)[..., :2] - right(times)[..., :2], axis=-1) / step
        yield _in_steps("forward_difference", SPEED_LIMIT / float(moved.max()), step)
    for model in geometries(dance, np.zeros(1), SheetClues()):
        if model.error in SMOOTH:
            yield Shortcut(model.error, _fastest(model.motion, PEAK_STEP), model.values)


def _fastest(motion: Motion, step: float) -> float:
    """The head speed at which no handle exceeds the limit at the instants of a grid [m/s]."""
    return SPEED_LIMIT / float(motion(np.arange(0.0, PEAK_SPAN, step))[..., SPEED].max())


def _lengths() -> Iterator[Shortcut]:
    yield Shortcut("arcs_not_tangent", math.pi * TURNING_RADIUS)
