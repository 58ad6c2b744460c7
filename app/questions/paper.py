"""What the paper reports beside what this program computes, and why the two differ.

The paper: J. Yang, R. Xie, J. Cao, "Dynamic Simulation and Optimization Analysis of The Bench Dragon Performance".
Its own four numbers and its search range are typed in here; every other number is computed when asked for.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cache

import numpy as np
from pydantic import Field

from app.questions.question import Question
from app.settings import Settings
from app.wire.models import Answer, Wire
from core import (
    Dragon,
    FirstContact,
    Spiral,
    bench_poses,
    clearance_profile,
    first_contact,
    minimum_pitch,
    separation,
)
from core import trajectory as trajectory_of
from core.dance import Dance
from core.design.pitch_scan import stop_radius
from core.shapes.angle_sum import angle_sums, literal_corners
from core.shapes.rectangles import corners
from core.values import Floats

PAPER_LENGTH = 442.590256  # [m], eq. 2
PAPER_TIME = 406.43  # [s], figure 7
PAPER_RADIUS = 2.883  # [m], section 3.3
PAPER_PITCH = 0.474924  # [m], section 3.3
PAPER_RANGE = (0.30, 0.55)  # [m], section 3.3
TURNING_RADIUS = 4.5  # [m], section 2.5

# The angle sum [deg] that must count as 360 for the paper's time to come out.
LOOSE_ANGLE = 359.1
# Rounding of an angle sum [deg]: corners inside give 360 within 1e-12, corners 1e-9 m outside give less than this.
EXACT_ANGLE = 360.0 - 1e-6
# The head's neighbourhood: the ring around it has at most 34 benches, those further back are a ring further out.
RING_BENCHES = 40
# Steps of the searches for a first time [s] and for sign changes in the pitch [m], and where bisection stops.
TIME_STEP = 0.1
PITCH_STEP = 0.001
RESOLUTION = 1e-10
# Angle sums of the whole run at once would take 500 MB.
SUM_BATCHES = 20


# Poses (..., 3) and sizes (..., 2) -> corners (..., 4, 2).
Outline = Callable[[Floats, Floats], Floats]


class Nothing(Wire):
    """No parameters at all."""


class Evidence(Answer, frozen=True):
    """One computation that bears on a difference."""

    what: str = Field(description="What was computed")
    value: float = Field(description="In the unit given beside it")
    unit: str = Field(description="Unit of the value")


class PaperNumber(Answer, frozen=True):
    """One number that the paper reports, beside ours."""

    quantity: str = Field(description="What it measures")
    unit: str = Field(description="Unit of paper, ours and difference")
    source: str = Field(description="Where it stands in the paper")
    paper: float = Field(description="As the paper reports it, in the unit given beside it")
    ours: float = Field(description="As computed here, in the unit given beside it")
    difference: float = Field(description="Ours minus the paper's, in the unit given beside it")
    reason: str = Field(description="Why the two differ, as far as a computation shows it")
    evidence: list[Evidence] = Field(description="The computations")


class PaperTable(Answer):
    """The paper's reported numbers beside ours."""

    rows: list[PaperNumber] = Field(description="One for each number that the paper reports")


@cache
def comparison() -> tuple[PaperNumber, ...]:
    """The four numbers that the paper reports, for its own dragon and spiral."""
    found = first_contact(Dance(Dragon(), Spiral()))
    return (_arc_length(), _collision_time(found), _collision_radius(found), _minimum_pitch())


def _compared(
    quantity: str, unit: str, source: str, paper: float, ours: float, reason: str, evidence: list[Evidence]
) -> PaperNumber:
    difference = ours - paper
    return PaperNumber(
        quantity=quantity, unit=unit, source=source, paper=paper, ours=ours, difference=difference, reason=reason,
        evidence=evidence,
    )  # fmt: skip


def _fact(what: str, value: float, unit: str) -> Evidence:
    return Evidence(what=what, value=value, unit=unit)


def _arc_length() -> PaperNumber:
    length = Spiral().length
    return _compared(
        "arc length of the spiral", "m", "eq. 2", PAPER_LENGTH, length, "The same, to the paper's six decimals.", []
    )


def _collision_time(found: FirstContact) -> PaperNumber:
    assert found.time is not None
    loose = _first_time(corners, LOOSE_ANGLE)
    literal = _first_time(literal_corners, EXACT_ANGLE)
    there = clearance_profile(Dance(Dragon(), Spiral()), np.array([PAPER_TIME]))
    a, b = (int(bench) for bench in there.benches[0])
    gap = float(there.clearance[0])
    return _compared(
        "time of first contact", "s", "figure 7", PAPER_TIME, found.time,
        f"The paper's rule adds angles and calls 360 degrees a collision. Near an edge the sum nears 360 degrees "
        f"without a contact: it passes {LOOSE_ANGLE:g} degrees at {loose:.2f} s, where benches {a} and {b} are "
        f"{1000 * gap:.1f} mm apart. Rounding such a sum up to 360 gives the paper's time.",
        [
            _fact("largest angle sum at the paper's time", _largest_sum(corners, PAPER_TIME), "deg"),
            _fact(f"first time of an angle sum of {LOOSE_ANGLE:g} degrees", loose, "s"),
            _fact(f"clearance at the paper's time, benches {a} and {b}", gap, "m"),
            _fact("first time of an angle sum of 360 degrees", _first_time(corners, EXACT_ANGLE), "s"),
            _fact("the same with eq. 12 as printed: w/2 cos theta of the wrong sign in all four y", literal, "s"),
        ],
    )  # fmt: skip


def _collision_radius(found: FirstContact) -> PaperNumber:
    assert found.head is not None
    head = trajectory_of(Dance(Dragon(benches=1), Spiral()), [PAPER_TIME]).position[0, 0]
    radius = float(np.hypot(*head))
    # A spiral that starts at that radius is as long as the way that is left.
    passed = Spiral().length - Spiral(start_turns=PAPER_RADIUS / Spiral().pitch).length
    return _compared(
        "radius of the head at first contact", "m", "section 3.3", PAPER_RADIUS, found.head.radius,
        f"The paper's own numbers exclude each other: at its {PAPER_TIME:g} s the head is at {radius:.3f} m, and "
        f"it passes {PAPER_RADIUS:g} m at {passed:.2f} s. No reading was found that gives the paper's number.",
        [
            _fact("radius of the head at the paper's time", radius, "m"),
            _fact("time at which the head passes the paper's radius", passed, "s"),
        ],
    )  # fmt: skip


def _minimum_pitch() -> PaperNumber:
    found = minimum_pitch(Dragon(), turning_radius=TURNING_RADIUS)
    below, above = _bisected_radius()
    head = first_contact(Dance(Dragon(), Spiral(PAPER_PITCH))).head
    at_paper = head.radius if head else 0.0
    alone, head_alone = _circle_pitch(_any_touch_at_start), _circle_pitch(_head_touches_at_start)
    return _compared(
        "minimum pitch", "m", "section 3.3", PAPER_PITCH, found.pitch,
        f"The paper bisects the radius of first contact towards {TURNING_RADIUS:g} m, but that radius jumps from "
        f"{_contact_radius(below):.3f} to {_contact_radius(above):.3f} m at a pitch of {above:.7f} m: none gives "
        f"{TURNING_RADIUS:g} m, so the error that it drives to 1e-10 cannot vanish. At the paper's pitch the head "
        f"gets to {at_paper:.3f} m, well inside the circle. No reading was found that gives the paper's number.",
        [
            _fact("pitch at which a bisection of the radius ends", above, "m"),
            _fact("radius of first contact just below it", _contact_radius(below), "m"),
            _fact("radius of first contact just above it", _contact_radius(above), "m"),
            _fact("radius of first contact at the paper's pitch", at_paper, "m"),
            _fact("largest pitch at which the pose on the circle alone touches", alone, "m"),
            _fact("the same with the pairs of the head only, as in eqs. 14-17", head_alone, "m"),
        ],
    )  # fmt: skip


def _largest_sums(outline: Outline, times: Floats) -> Floats:
    """The paper's rule, eqs. 13-16: the largest angle sum between head and body benches at every time.

    outline: what makes the corners (..., 4, 2) from poses and sizes; times: (T,) [s]; returns (T,) [deg]
    """
    dragon = Dragon(benches=RING_BENCHES)
    poses = bench_poses(trajectory_of(Dance(dragon, Spiral()), times).position)
    outlines = outline(poses, np.stack([dragon.lengths, dragon.widths], axis=-1))
    head, body = outlines[:, :1], outlines[:, 2:]
    sums = np.maximum(angle_sums(body, head), angle_sums(head, body))
    return np.asarray(np.degrees(sums.max(axis=(1, 2))))


def _largest_sum(outline: Outline, time: float) -> float:
    return float(_largest_sums(outline, np.array([time]))[0])


@cache
def _sampled_sums(outline: Outline) -> tuple[Floats, Floats]:
    """Instants TIME_STEP apart over the whole run [s], and the largest angle sum at each [deg]."""
    times = np.arange(0.0, Dance(Dragon(), Spiral()).end.time, TIME_STEP)
    batches = np.array_split(times, SUM_BATCHES)
    return times, np.concatenate([_largest_sums(outline, batch) for batch in batches])


def _first_time(outline: Outline, angle: float) -> float:
    """First time [s] at which an angle sum reaches an angle [deg], among instants TIME_STEP apart, then bisected."""
    times, sums = _sampled_sums(outline)
    high = float(times[np.flatnonzero(sums >= angle)[0]])
    return _bisected(lambda time: _largest_sum(outline, time) >= angle, high - TIME_STEP, high)[1]


def _bisected(holds: Callable[[float], bool], low: float, high: float) -> tuple[float, float]:
    """Bracket of one change: holds(low) differs from holds(high), RESOLUTION apart."""
    before = holds(low)
    while high - low > RESOLUTION:
        middle = 0.5 * (low + high)
        low, high = (middle, high) if holds(middle) == before else (low, middle)
    return low, high


def _contact_radius(pitch: float) -> float:
    """Where the head of the default dragon stands at first contact, as a scan finds it [m]; 0 when nothing touches."""
    return stop_radius(Dragon(), Spiral(pitch)) or 0.0


def _bisected_radius() -> tuple[float, float]:
    """Section 3.3: bisect the pitch until the head stops at the circle; the two pitches where that ends."""
    return _bisected(lambda pitch: _contact_radius(pitch) <= TURNING_RADIUS, *PAPER_RANGE)


def _circle_pitch(touches: Callable[[Spiral], bool]) -> float:
    """The largest pitch in the paper's range at which the pose on the circle, without the way there, touches [m]."""

    def touching(pitch: float) -> bool:
        # On a spiral that starts at the circle the head is there at time 0.
        return touches(Spiral(pitch, TURNING_RADIUS / pitch))

    pitches = np.arange(*PAPER_RANGE, PITCH_STEP).tolist()
    last = max(k for k, pitch in enumerate(pitches) if touching(pitch))
    return _bisected(touching, pitches[last], pitches[last + 1])[0]


def _any_touch_at_start(path: Spiral) -> bool:
    return bool(clearance_profile(Dance(Dragon(), path), np.array([0.0])).clearance[0] <= 0.0)


def _head_touches_at_start(path: Spiral) -> bool:
    dragon = Dragon()
    poses = bench_poses(trajectory_of(Dance(dragon, path), [0.0]).position[0])
    sizes = np.stack([dragon.lengths, dragon.widths], axis=-1)
    return bool(separation(poses[0], sizes[0], poses[2:], sizes[2:]).separation.min() <= 0.0)


def paper(asked: Nothing, settings: Settings) -> PaperTable:
    """The paper's reported numbers beside ours, with the reason for each difference."""
    return PaperTable(rows=list(comparison()))


QUESTION = Question(paper, PaperTable, flat=Nothing)
