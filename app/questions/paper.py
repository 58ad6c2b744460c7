"""The paper's numbers beside those of this program, and why they differ.

The paper: J. Yang, R. Xie, J. Cao, "Dynamic Simulation and Optimization Analysis of The Bench Dragon Performance".
Its four numbers and its search range are constants here; every other number is computed on request.
"""

from __future__ import annotations

from functools import cache

import numpy as np
from pydantic import Field

from app.files.tables import Language
from app.grade.contacts import (
    EXACT_ANGLE,
    LOOSE_ANGLE,
    PITCH_RANGE,
    RESOLUTION,
    TURNING_RADIUS,
    angle_sum_time,
    any_touch_at_start,
    circle_pitch,
    head_touches_at_start,
    largest_sum,
)
from app.grade.report import DiagnosisAnswer, typed
from app.grade.words import say
from app.questions.question import Question, Terms
from app.wire.models import Answer, Wire
from core import Dance, Dragon, FirstContact, Spiral, clearance_profile, first_contact, minimum_pitch
from core import trajectory as trajectory_of
from core.design.pitch_scan import stop_radius
from core.sampling import bisected
from core.shapes.angle_sum import literal_corners
from core.shapes.rectangles import corners

PAPER_LENGTH = 442.590256  # [m], eq. 2
PAPER_TIME = 406.43  # [s], figure 7
PAPER_RADIUS = 2.883  # [m], section 3.3
PAPER_PITCH = 0.474924  # [m], section 3.3

# Numbers that others published: the place, the name of the number in app/grade/shortcuts.py, and the number.
PUBLISHED = (
    ("B. Zhang, Y. Shang, X. Lin, ICMMCT 2025, doi 10.25236/icmmct.2025.021", "collision_time", "412.478"),
    ("B. Zhang, Y. Shang, X. Lin, ICMMCT 2025, doi 10.25236/icmmct.2025.021", "pitch", "0.45035"),
    ("Z. Shi, Y. Wei, C. Zhang, AJST, article 30378, doi 10.54097/rq3xkw77", "pitch", "0.43"),
    ("housingscience, volume 46, number 4", "collision_time", "416"),
)


class Nothing(Wire):
    """A request without parameters."""


class Evidence(Answer, frozen=True):
    """One computation that bears on a difference."""

    what: str = Field(description="Quantity computed")
    value: float = Field(description="Value in that unit")
    unit: str = Field(description="Unit of the value")


class PaperNumber(Answer, frozen=True):
    """One number that the paper reports, beside ours."""

    quantity: str = Field(description="Name of the quantity")
    unit: str = Field(description="Unit of paper, ours and difference")
    source: str = Field(description="Place in the paper")
    paper: float = Field(description="Value in the paper, in that unit")
    ours: float = Field(description="Value computed here, in that unit")
    difference: float = Field(description="Our value minus the paper's, in that unit")
    reason: str = Field(description="Why the two differ, as far as computations show")
    evidence: list[Evidence] = Field(description="Computations behind the reason")


class PublishedNumber(Answer, frozen=True):
    """One number that others published about the contest's problem, beside ours."""

    quantity: str = Field(description="Name of the quantity")
    unit: str = Field(description="Unit of published, ours and difference")
    source: str = Field(description="Authors, place, year and DOI")
    published: float = Field(description="Value as published, in that unit")
    ours: float = Field(description="Value computed here, in that unit")
    difference: float = Field(description="Our value minus the published one, in that unit")
    diagnosis: list[DiagnosisAnswer] = Field(description="Known shortcuts that give it; empty where nothing fits")


class PaperTable(Answer):
    """The paper's reported numbers beside ours, and those of other publications."""

    rows: list[PaperNumber] = Field(description="One row for each number in the paper")
    literature: list[PublishedNumber] = Field(description="One row for each number published elsewhere")


@cache
def comparison() -> tuple[PaperNumber, ...]:
    """The four numbers that the paper reports, for its own dragon and spiral."""
    found = first_contact(Dance(Dragon(), Spiral()))
    return (_arc_length(), _collision_time(found), _collision_radius(found), _minimum_pitch())


@cache
def literature() -> tuple[PublishedNumber, ...]:
    """The numbers of other publications, each with the shortcut that gives it where one is known."""
    found = []
    for source, name, text in PUBLISHED:
        one = typed(name, text, Language.ENGLISH)
        found.append(
            PublishedNumber(
                quantity=say(name, Language.ENGLISH),
                unit=one.unit,
                source=source,
                published=one.found,
                ours=one.expected,
                difference=one.expected - one.found,
                diagnosis=one.diagnosis,
            )
        )
    return tuple(found)


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
    loose = angle_sum_time(corners, LOOSE_ANGLE)
    literal = angle_sum_time(literal_corners, EXACT_ANGLE)
    there = clearance_profile(Dance(Dragon(), Spiral()), np.array([PAPER_TIME]))
    a, b = (int(bench) for bench in there.benches[0])
    gap = float(there.clearance[0])
    return _compared(
        "time of first contact", "s", "figure 7", PAPER_TIME, found.time,
        f"The paper's rule adds angles and calls 360 degrees a collision. Near an edge the sum nears 360 degrees "
        f"without a contact: it passes {LOOSE_ANGLE:g} degrees at {loose:.2f} s, where benches {a} and {b} are "
        f"{1000 * gap:.1f} mm apart. Rounding such a sum up to 360 gives the paper's time.",
        [
            _fact("largest angle sum at the paper's time", largest_sum(corners, PAPER_TIME), "deg"),
            _fact(f"first time of an angle sum of {LOOSE_ANGLE:g} degrees", loose, "s"),
            _fact(f"clearance at the paper's time, benches {a} and {b}", gap, "m"),
            _fact("first time of an angle sum of 360 degrees", angle_sum_time(corners, EXACT_ANGLE), "s"),
            _fact("the same with eq. 12 as printed: w/2 cos theta of the wrong sign in all four y", literal, "s"),
        ],
    )  # fmt: skip


def _collision_radius(found: FirstContact) -> PaperNumber:
    assert found.head is not None
    head = trajectory_of(Dance(Dragon(benches=1), Spiral()), [PAPER_TIME]).position[0, 0]
    radius = float(np.hypot(*head))
    # The length of a spiral that starts at that radius equals the remaining way.
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
    alone, head_alone = circle_pitch(any_touch_at_start), circle_pitch(head_touches_at_start)
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


def _contact_radius(pitch: float) -> float:
    """Radius of the default dragon's head at first contact, as a scan finds it [m]; 0 without a contact."""
    return stop_radius(Dragon(), Spiral(pitch)) or 0.0


def _bisected_radius() -> tuple[float, float]:
    """The two pitches at which the bisection of section 3.3, for a head that stops at the circle, ends."""
    return bisected(lambda pitch: _contact_radius(pitch) <= TURNING_RADIUS, *PITCH_RANGE, width=RESOLUTION)


def paper(asked: Nothing, terms: Terms) -> PaperTable:
    """The paper's reported numbers beside ours, with the reason for each difference."""
    return PaperTable(rows=list(comparison()), literature=list(literature()))


QUESTION = Question(paper, PaperTable, flat=Nothing)
