"""Known shortcuts to the contest's four numbers, each recomputed to compare its result with a typed answer.

Input: the name of a number, its value and its rounding. Output: findings; none if no shortcut gives the value. State:
each shortcut is computed once in a process.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass, replace
from functools import cache

import numpy as np

import core
from app.grade import contacts
from app.grade.contacts import EXACT_ANGLE, LOOSE_ANGLE, RESOLUTION, TURNING_RADIUS
from app.grade.expected import PITCH, Motion, Workbook, contact_time, dance_of, of_dance, right_turn
from app.grade.geometry import geometries
from app.grade.labels import SPEED
from app.grade.words import Note, note
from core import BenchDragonError, Dance, Dragon, Spiral, Turn
from core.shapes.rectangles import corners, literal_corners

SPEED_LIMIT = 2.0  # [m/s], of the contest's question 5
# Steps of time in students' searches for an event [s], and for the highest speed or the graze of a pitch [s].
EVENT_STEPS = (0.001, 0.002, 0.005, 0.01, 0.02, 0.04, 0.05, 0.08, 0.1, 0.2, 0.25, 0.5, 1.0)
STEPS = (1.0, 0.5, 0.2, 0.1, 0.05, 0.02, 0.01)
# Largest half of the last digit, relative to the number, at which a shortcut is reported [1]: 1.3 has too few digits.
DIGITS_SHARE = 2e-3
# Steps of students' searches for the pitch [m].
PITCH_GRIDS = (0.01, 0.005, 0.001, 0.0005, 0.0001, 0.00005)
# A pitch that is too small by more than this counts as infeasible, not as rounded [m].
INFEASIBLE = 1e-5
# Most decimals of a number that was cut off.
TRUNCATED = (2, 3, 4, 5)
# The turn's speeds peak among the first handles, soon after the entry [s]; and the step in which they are sampled [s].
PEAK_BENCHES, PEAK_SPAN, PEAK_STEP = 30, 40.0, 0.01
# Errors of the turn that keep it smooth, so that samples show its highest speed.
SMOOTH = ("head_as_body", "body_as_head", "ratio_inverted", "equal_arcs_of_turn")
# Most shortcuts shown for one number.
FINDINGS_MOST = 3
# Other entries that students use [m]; a length of two decimals fits one of them by chance in one case of six.
ENTRIES = tuple(k / 50 for k in range(200, 225))
# Ratios of the arcs at which the shortest turn also answers question 4: the contest's, and that of the shortest of all.
RATIOS = (2.0, 1.0)


@dataclass(frozen=True)
class Finding:
    """A known error that explains a number. error: its name; said: the error in words; evidence: the numbers"""

    error: str
    said: Note
    evidence: Note


@dataclass(frozen=True)
class Shortcut:
    """Result of a shortcut. values: numbers in its words; exact: True if students hand in exactly this number"""

    error: str
    value: float
    values: dict[str, object]
    exact: bool = False

    def gives(self, value: float, half_unit: float) -> bool:
        if self.exact:
            return abs(self.value - value) < RESOLUTION
        return half_unit <= DIGITS_SHARE * value and abs(self.value - value) <= 1.02 * half_unit


UNITS = {"collision_time": "s", "pitch": "m", "speed": "m/s", "turn_length": "m"}


@cache
def right_answer(name: str) -> float:
    """The right value of one of UNITS, in its unit."""
    if name == "collision_time":
        return contact_time()
    if name == "pitch":
        return core.minimum_pitch(Dragon(), turning_radius=TURNING_RADIUS).pitch
    if name == "speed":
        return core.maximum_head_speed(dance_of(Workbook.RESULT4), SPEED_LIMIT).head_speed
    return right_turn().length


@cache
def shortest_length(ratio: float) -> float:
    """Length of the shortest turn at a ratio, which enters deeper inside the circle [m]."""
    return core.deepest_turn(Dragon(), PITCH, TURNING_RADIUS, ratio).turn.length


def accepted(name: str, value: float, half_unit: float) -> float | None:
    """The right value that a number agrees with, to its own digits; None for a wrong number.

    A pitch that was rounded down is wrong, because it is infeasible. Question 4 also accepts a shorter turn.
    """
    right = right_answer(name)
    if abs(right - value) <= 1.02 * half_unit and not (name == "pitch" and right - value > INFEASIBLE):
        return right
    if name == "turn_length" and half_unit <= DIGITS_SHARE * value:
        return next((one for one in map(shortest_length, RATIOS) if abs(one - value) <= 1.02 * half_unit), None)
    return None


def other_turn(length: float) -> Note:
    """Remark on one of the shortest turns."""
    ratio = next(ratio for ratio in RATIOS if shortest_length(ratio) == length)
    return note("other_turn", ratio=f"{ratio:g}", length=f"{right_answer('turn_length'):.7f}")


def explained(name: str, value: float, half_unit: float) -> list[Finding]:
    """Findings on one of UNITS.

    value: in its unit; half_unit: half of its last digit, in that unit
    """
    if accepted(name, value, half_unit) is not None:
        return []
    fits = [one for one in shortcuts(name) if one.gives(value, half_unit)]
    if name == "pitch":
        fits = [*_truncated(value, right_answer(name)), *fits] or [*_on_grid(value)]
    exact = [one for one in fits if one.exact]
    numbers = {"unit": UNITS[name], "right": f"{right_answer(name):.9g}", "value": f"{value:.9g}"}
    found = []
    for one in _by_error(exact or fits, value)[:FINDINGS_MOST]:
        words = "gives_on_grid" if "grid" in one.values else "gives"
        evidence = note(words, gives=f"{one.value:.9g}", **numbers, **one.values)
        found.append(Finding(one.error, note(f"error_{one.error}", **one.values), evidence))
    return found


def _by_error(fits: list[Shortcut], value: float) -> list[Shortcut]:
    """One shortcut for each error, the nearest first, with all steps that give the number."""
    found: dict[str, list[Shortcut]] = {}
    for one in sorted(fits, key=lambda one: round(abs(one.value - value), 9)):
        found.setdefault(one.error, []).append(one)
    merged = []
    for alike in found.values():
        steps = sorted((str(one.values["step"]) for one in alike if "step" in one.values), key=float)
        merged.append(replace(alike[0], values=alike[0].values | ({"step": " / ".join(steps)} if steps else {})))
    return merged


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
        yield Shortcut("time_steps", after, {"step": f"{step:g}"}, exact=True)
        yield Shortcut("time_steps_before", before, {"step": f"{step:g}"}, exact=True)
    for error, dragon in _other_dragons():
        if (time := core.first_contact(Dance(dragon, Spiral())).time) is not None:
            yield Shortcut(error, time, {})
    yield Shortcut(
        "loose_angle", contacts.angle_sum_time(corners, LOOSE_ANGLE), {"angle": f"{360.0 - LOOSE_ANGLE:.1f}"}
    )
    yield Shortcut("literal_corners", contacts.angle_sum_time(literal_corners, EXACT_ANGLE), {})


def _other_dragons() -> Iterator[tuple[str, Dragon]]:
    right = Dragon()
    yield "no_overhang", Dragon(head_length=float(right.chords[0]), body_length=float(right.chords[1]), overhang=0.0)
    yield "length_for_chord", Dragon(overhang=0.0)
    yield "head_as_body", Dragon(head_length=2.20)


def _pitches() -> Iterator[Shortcut]:
    yield Shortcut("pose_on_circle", contacts.circle_pitch(contacts.any_touch_at_start), {})
    yield Shortcut("pose_on_circle_head", contacts.circle_pitch(contacts.head_touches_at_start), {})
    yield Shortcut("one_corner", contacts.circle_pitch(contacts.corner_at_start), {})
    for step in STEPS[:4]:
        yield Shortcut("pitch_time_steps", contacts.stepped_pitch(step, right_answer("pitch")), {"step": f"{step:g}"})
    for error, dragon in _other_dragons():
        with suppress(BenchDragonError):
            yield Shortcut(error, core.minimum_pitch(dragon, turning_radius=TURNING_RADIUS).pitch, {})


def _truncated(value: float, right: float) -> Iterator[Shortcut]:
    """The right number, cut off and therefore too small to be feasible."""
    for decimals in TRUNCATED:
        cut = math.floor(right * 10.0**decimals) / 10.0**decimals
        if abs(cut - value) < RESOLUTION and cut < right:
            yield Shortcut("truncated", cut, {"decimals": decimals}, exact=True)


def _on_grid(value: float) -> Iterator[Shortcut]:
    """A pitch from a search in steps: the first of a grid above the right one, or above that of a shortcut."""
    for step in PITCH_GRIDS:
        for one in (Shortcut("pitch_steps", right_answer("pitch"), {}), *shortcuts("pitch")[:3]):
            if abs(math.ceil(one.value / step) * step - value) < RESOLUTION:
                yield Shortcut(one.error, one.value, {"grid": f"{step:g}"})
                return


def _speeds() -> Iterator[Shortcut]:
    dance = Dance(Dragon(PEAK_BENCHES), right_turn())
    right = of_dance(dance)
    for step in STEPS[:6]:
        yield Shortcut("speed_time_steps", _fastest(right, step), {"step": f"{step:g}"})
    for step in STEPS:
        times = np.arange(0.0, PEAK_SPAN, step)
        moved = np.linalg.norm(right(times + step)[..., :2] - right(times)[..., :2], axis=-1) / step
        yield Shortcut("forward_difference", SPEED_LIMIT / float(moved.max()), {"step": f"{step:g}"})
    for model in geometries(dance, np.zeros(1), None):
        if model.error in SMOOTH:
            yield Shortcut(model.error, _fastest(model.motion, PEAK_STEP), model.values)


def _fastest(motion: Motion, step: float) -> float:
    """The head speed at which no handle exceeds the limit at the instants of a grid [m/s]."""
    return SPEED_LIMIT / float(motion(np.arange(0.0, PEAK_SPAN, step))[..., SPEED].max())


def _lengths() -> Iterator[Shortcut]:
    yield Shortcut("arcs_not_tangent", math.pi * TURNING_RADIUS, {})
    for entry in ENTRIES:
        yield Shortcut("other_entry", Turn(PITCH, TURNING_RADIUS, entry_radius=entry).length, {"entry": f"{entry:g}"})
