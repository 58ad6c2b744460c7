"""The paper's numbers beside those of this program, and why they differ.

The paper: J. Yang, R. Xie, J. Cao, "Dynamic Simulation and Optimization Analysis of The Bench Dragon Performance".
Its four numbers and its search range are constants here; every other number is computed on request.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache

import numpy as np
from pydantic import Field

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
from app.grade.words import word
from app.wire.fields import Answer, Wire
from app.wire.labels import Heading, Part, TextTable, value_text
from app.wire.question import Command, Question, Terms
from core import (
    Budget,
    Dance,
    Dragon,
    FirstContact,
    Spiral,
    TooMuchWork,
    clearance_profile,
    first_contact,
    minimum_pitch,
)
from core import trajectory as trajectory_of
from core.design.pitch_scan import Stops
from core.kernels import Halted
from core.language import Language, say
from core.sampling import bisect
from core.shapes.rectangles import corners, literal_corners

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


class PaperQuery(Wire):
    """The language of the words."""

    language: Language = Field(Language.ENGLISH, description="Language of the words")


class Evidence(Answer, frozen=True):
    """One computation that bears on a difference.

    what: quantity computed
    value: value in that unit
    unit: unit of the value
    """

    what: str
    value: float
    unit: str


class PaperNumber(Answer, frozen=True):
    """One number that the paper reports, beside ours.

    quantity: name of the quantity
    unit: unit of paper, ours and difference
    source: place in the paper
    paper: value in the paper, in that unit
    ours: value computed here, in that unit
    difference: our value minus the paper's, in that unit
    reason: reason for the difference, as far as computations show it
    evidence: computations behind the reason
    """

    quantity: str
    unit: str
    source: str
    paper: float
    ours: float
    difference: float
    reason: str
    evidence: list[Evidence]


class PublishedNumber(Answer, frozen=True):
    """One number that others published about the contest's problem, beside ours.

    quantity: name of the quantity
    unit: unit of published, ours and difference
    source: authors, place, year and DOI
    published: value as published, in that unit
    ours: value computed here, in that unit
    difference: our value minus the published one, in that unit
    diagnosis: known shortcuts that give it; empty where nothing fits
    """

    quantity: str
    unit: str
    source: str
    published: float
    ours: float
    difference: float
    diagnosis: list[DiagnosisAnswer]


class PaperTable(Answer):
    """The paper's reported numbers beside ours, and those of other publications.

    rows: one row for each number in the paper
    literature: one row for each number published elsewhere
    """

    rows: list[PaperNumber]
    literature: list[PublishedNumber]


@dataclass(frozen=True)
class _Number:
    """A number of the paper beside ours, without words: name is that of its words, evidence of those of its facts."""

    name: str
    unit: str
    paper: float
    ours: float
    values: dict[str, float]
    evidence: dict[str, tuple[float, str]]

    def in_words(self) -> PaperNumber:
        def words(code: str) -> str:
            return word(f"paper_{self.name}{code}", **self.values)

        return PaperNumber(
            quantity=words(""),
            unit=self.unit,
            source=words("_at"),
            paper=self.paper,
            ours=self.ours,
            difference=self.ours - self.paper,
            reason=words("_why"),
            evidence=[Evidence(what=words(f"_{fact}"), value=v, unit=u) for fact, (v, u) in self.evidence.items()],
        )


def comparison(budget: Budget) -> Iterator[PaperNumber]:
    """The four numbers that the paper reports, for its own dragon and spiral. raises: Halted between two of them"""
    for number in (_length, _collision_time, _collision_radius, _minimum_pitch):
        budget.look()
        yield number().in_words()


def literature(budget: Budget) -> Iterator[PublishedNumber]:
    """The numbers of other publications, each with the shortcut that gives it where one is known. raises: Halted"""
    for source, name, text in PUBLISHED:
        budget.look()
        one = typed(name, text)
        yield PublishedNumber(
            quantity=word(name),
            unit=one.unit,
            source=source,
            published=one.found,
            ours=one.expected,
            difference=one.expected - one.found,
            diagnosis=one.diagnosis,
        )


@cache
def _contact() -> FirstContact:
    return first_contact(Dance(Dragon(), Spiral()))


@cache
def _length() -> _Number:
    return _Number("length", "m", PAPER_LENGTH, Spiral().length, {}, {})


@cache
def _collision_time() -> _Number:
    contact = _contact()
    assert contact.time is not None
    loose = angle_sum_time(corners, LOOSE_ANGLE)
    there = clearance_profile(Dance(Dragon(), Spiral()), np.array([PAPER_TIME]))
    a, b = (int(bench) for bench in there.benches[0])
    gap = float(there.clearance[0])
    evidence = {
        "largest": (largest_sum(corners, PAPER_TIME), "deg"),
        "loose": (loose, "s"),
        "gap": (gap, "m"),
        "exact": (angle_sum_time(corners, EXACT_ANGLE), "s"),
        "literal": (angle_sum_time(literal_corners, EXACT_ANGLE), "s"),
    }
    values = {"angle": LOOSE_ANGLE, "loose": loose, "a": a, "b": b, "gap": 1000 * gap}
    return _Number("time", "s", PAPER_TIME, contact.time, values, evidence)


@cache
def _collision_radius() -> _Number:
    contact = _contact()
    assert contact.head is not None
    head = trajectory_of(Dance(Dragon(benches=1), Spiral()), [PAPER_TIME]).position[0, 0]
    radius = float(np.hypot(*head))
    # The length of a spiral that starts at that radius equals the remaining way.
    passed = Spiral().length - Spiral(start_turns=PAPER_RADIUS / Spiral().pitch).length
    evidence = {"there": (radius, "m"), "passed": (passed, "s")}
    values = {"time": PAPER_TIME, "radius": radius, "paper": PAPER_RADIUS, "passed": passed}
    return _Number("radius", "m", PAPER_RADIUS, contact.head.radius, values, evidence)


@cache
def _minimum_pitch() -> _Number:
    result = minimum_pitch(Dragon(), turning_radius=TURNING_RADIUS)
    # The bisection of section 3.3, for a head that stops at the circle.
    just_below, jump = bisect(lambda pitch: _contact_radius(pitch) <= TURNING_RADIUS, *PITCH_RANGE, width=RESOLUTION)
    below, above = _contact_radius(just_below), _contact_radius(jump)
    head = first_contact(Dance(Dragon(), Spiral(PAPER_PITCH))).head
    reached = head.radius if head else 0.0
    evidence = {
        "jump": (jump, "m"),
        "below": (below, "m"),
        "above": (above, "m"),
        "reached": (reached, "m"),
        "alone": (circle_pitch(any_touch_at_start), "m"),
        "head": (circle_pitch(head_touches_at_start), "m"),
    }
    values = {"circle": TURNING_RADIUS, "below": below, "above": above, "jump": jump, "reached": reached}
    return _Number("pitch", "m", PAPER_PITCH, result.pitch, values, evidence)


def _contact_radius(pitch: float) -> float:
    """Radius of the default dragon's head at first contact, as a scan finds it [m]; 0 without a contact."""
    return Stops(Dragon(), 0.0).radius(Spiral(pitch)) or 0.0


def paper(request: PaperQuery, terms: Terms) -> PaperTable:
    """The paper's reported numbers beside ours, with the reason for each difference.

    raises: TooMuchWork once the budget is stopped; what was computed is kept for the next call
    """
    try:
        return PaperTable(rows=list(comparison(terms.budget)), literature=list(literature(terms.budget)))
    except Halted as halted:
        words, advice = "the paper was not recomputed {then}", "ask again, for what was computed is kept"
        error = TooMuchWork.in_words("language", words, reason=advice, then=terms.budget.then)
        error.stopped = True
        raise error from halted


def _parts(answer: PaperTable, request: Wire) -> Iterator[Part]:
    """The numbers side by side, then each reason with its evidence; then the numbers of other publications."""

    def words(code: str) -> str:
        return word(f"paper_{code}")

    table = TextTable(words("title"), *map(words, ("quantity", "paper", "ours", "difference")))
    for one in answer.rows:
        name = f"{one.quantity} [{one.unit}], {one.source}"
        table.add(name, str(one.paper), value_text(one.ours), f"{one.difference:+.6f}")
    yield table
    for one in answer.rows:
        yield Heading(one.quantity)
        yield one.reason
        yield from (f"  {fact.what}: {value_text(fact.value)} {fact.unit}" for fact in one.evidence)
        yield ""
    others = TextTable(words("others"), *map(words, ("quantity", "published", "ours", "difference")))
    for other in answer.literature:
        difference = f"{other.difference:+.6f}"
        others.add(f"{other.quantity} [{other.unit}]", str(other.published), value_text(other.ours), difference)
    yield others
    for other in answer.literature:
        yield Heading(f"{other.published} {other.unit}: {other.source}")
        yield from [f"{error.words} {error.evidence}" for error in other.diagnosis] or [words("unknown")]
        yield ""


QUESTION = Question(
    paper,
    PaperTable,
    flat=PaperQuery,
    command=Command(
        "The paper's numbers beside those of this program, with the reason for each difference.",
        lambda request: say("recomputing the paper"),
        _parts,
    ),
)
