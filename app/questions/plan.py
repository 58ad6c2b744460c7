"""The plan of a dance on paper."""

from __future__ import annotations

from collections.abc import Callable
from itertools import zip_longest
from typing import TYPE_CHECKING, Literal

from pydantic import Field

import core
from app.files.tables import Language
from app.files.words import Say
from app.maps.marks import marks_of
from app.questions.check import verdict_of
from app.questions.maps import Marked
from app.wire.dances import clock_of
from app.wire.degrees import Place
from app.wire.question import Coordinate, Question, Terms, Wire, measure
from core import Dance, FailureKind, InvalidValue, Judgement
from core.display import format_count
from core.errors import Given, Quantity, format_number, question_about
from core.motion.places import handle_places
from core.people.crew import places_near
from core.shapes.engines import widened

if TYPE_CHECKING:
    from app.plan.plan import Plan

PDF_TYPE = "application/pdf"
# Excess of the swept ground on paper [m]: 0.05 mm at 1:200.
EXCESS = 0.01
# Width of the zone to keep clear if there is no margin [m].
CLEAR = 0.5
# Time of the default dance's plan, measured 2026-11-22 [s].
SECONDS = 4.0
# First character of Unicode that needs a Chinese font, approximately.
FIRST_CHINESE = "\u2e80"
# Most gates of a plan.
GATES_MAX = 20
# Words for each kind of failure.
FAILURES = {
    FailureKind.CONTACT: ("benches touch or are too near", "板凳相碰或过近"),
    FailureKind.VENUE: ("a bench is too near to the venue", "板凳距场地边界或障碍物过近"),
    FailureKind.OUTSIDE: ("a bench starts outside the square or in an obstacle", "有板凳起始于场外或障碍物内"),
    FailureKind.SPEED: ("a handle is too fast", "把手速度超限"),
    FailureKind.FOLDS: ("a bench cannot follow the path", "板凳无法继续沿路线前进"),
    FailureKind.UNDECIDED: ("not decided", "未能判定"),
}


class PlanGate(Wire, strict=True):
    """A gate, or another place by name, whose passes the plan lists by the clock."""

    name: str = Field(min_length=1, max_length=40, description="Its name")
    x: Coordinate = measure("m", "x of the place")
    y: Coordinate = measure("m", "y of the place")
    within: float = measure("m", "Largest distance of the path from the place where it passes it", 5.0, ge=0, le=100)


class PlanRequest(Marked):
    """A dance, as for /check, and the look of its plan."""

    paper: Literal["A4", "A3"] = Field("A4", description="Size of the paper")
    clear: float | None = measure(
        "m", "Width of the zone to keep clear around the swept ground; default: the margin, or 0.5 m without one", None,
        ge=0, le=100,
    )  # fmt: skip
    gates: list[PlanGate] = Field(
        [],
        max_length=GATES_MAX,
        fail_fast=True,
        description="Gates and other places by name: the plan shows them, and when head and tail pass each",
    )
    title: str = Field("", max_length=80, description="Title of the plan")
    language: Language = Field(Language.ENGLISH, description="Language of the words: en or zh", strict=False)


def plan(request: PlanRequest, terms: Terms) -> bytes:
    """The dance on paper as PDF: a map true to scale, the place of each bench, the points to paint and the times."""
    from app.files.fonts import families
    from app.plan.ground import GroundMap
    from app.plan.plan import Plan
    from app.plan.sheet import Title
    from app.plan.timing import TimeFormat, timing_of

    dance, budget, say = request.to_dance(terms.settings.checked_benches_max), terms.budget, Say(request.language)
    place, clock = request.to_place(dance.dragon), TimeFormat(clock_of(request, dance), request.music)
    start, stop = dance.span(request.start, request.stop)
    marks = marks_of(dance, start, stop, request.spacing)
    timing = timing_of(dance, marks, start, stop, _gates(request, dance, start, stop, budget), budget)
    swept = core.envelope(dance, start=start, stop=stop, excess=EXCESS, budget=budget).polygons
    width = request.clear if request.clear is not None else request.margin or CLEAR
    clear = widened(swept, width) if width else swept
    geographic = request.origin_at(place) is not None
    report = verdict_of(request, dance, place.venue, start, terms)
    title = Title(
        request.title or say("Bench dragon", "板凳龙"),
        [*_facts(dance, request.margin, start, stop, clock.words, say), *_grid(place, say)],
        verdict_words(report, clock.words, say),
        report.verdict is Judgement.PASSES,
        geographic,
    )
    gates = [(one.name, one.x, one.y) for one in request.gates]
    ground = GroundMap(dance, place.venue, swept, clear, width, timing, geographic, gates)
    numbers = [say("head", "龙头"), *map(str, range(1, dance.dragon.benches))]
    names = [f"{number} {own}".rstrip() for number, own in zip_longest(numbers, dance.dragon.names, fillvalue="")]
    texts = "".join(
        [
            title.title,
            *names,
            *(one.name for one in request.gates),
            *(area.name for area in (place.venue.areas if place.venue else ())),
        ]
    )
    # Chinese names may stand in an English plan.
    family = families(Language.CHINESE if max(texts) >= FIRST_CHINESE else request.language)
    return _drawn(dance, Plan(ground, family, names, clock, title, request.paper, budget), say, terms)


def _gates(
    request: PlanRequest, dance: Dance, start: float, stop: float, budget: core.Budget
) -> list[tuple[str, float]]:
    """Name and s [m] of each pass of a gate, in order along the path. raises: InvalidValue for a gate off the path"""
    if not request.gates:
        return []
    ends = handle_places(dance, [start, stop], budget=budget)
    passes = []
    for k, gate in enumerate(request.gates):
        near = places_near(dance.path, (gate.x, gate.y), float(ends[0, -1]), float(ends[1, 0]), gate.within)
        if not near:
            rule = "must be within {within} of the path that the dragon walks"
            raise InvalidValue(f"gates.{k}", rule, got=Given(gate.name), within=Quantity(gate.within, "m"))
        passes += [(gate.name, s) for s in near]
    return sorted(passes, key=lambda one: one[1])


@question_about("dance", Dance, "the plan was not drawn")
def _drawn(dance: Dance, plan: Plan, say: Say, terms: Terms) -> bytes:
    """The bytes of the plan of a dance. raises: TooMuchWork"""
    from app.plan.plan import plan_pdf

    return plan_pdf(plan, say, terms.progress)


def _facts(
    dance: Dance, margin: float, start: float, stop: float, words: Callable[[float], str], say: Say
) -> list[str]:
    """The dance in lines of the title block."""
    dragon = dance.dragon
    length = float(dragon.chords.sum())
    moving = sorted({one.speed for one in dance.passages if one.speed > 0.0} | {dance.head_speed})
    english, chinese = (
        to.join(format_number(one) for one in sorted({moving[0], moving[-1]})) for to in (" to ", " 至 ")
    )
    pauses, n = sum(one.speed == 0.0 for one in dance.passages), dragon.benches
    paused, stopped = (f" with {format_count(pauses, 'pause')}", f"，停顿 {pauses} 次") if pauses else ("", "")
    return [
        say(f"{n} benches, {length:.1f} m from head to tail", f"{n} 节板凳，全长 {length:.1f} m"),
        say(
            f"head at {english} m/s{paused}, margin {format_number(margin)} m",
            f"龙头速度 {chinese} m/s{stopped}，间距 {format_number(margin)} m",
        ),
        say(f"from {words(start)} to {words(stop)}", f"时间 {words(start)} 至 {words(stop)}"),
    ]


def _grid(place: Place, say: Say) -> list[str]:
    """A line about the survey grid of the venue, if it has one."""
    if place.grid is None:
        return []
    x, y = (f"{one:.10g}" for one in place.grid)
    return [say(f"x = y = 0 is x {x} m, y {y} m of the survey grid", f"x = y = 0 为测量坐标 x {x} m，y {y} m")]


def verdict_words(report: core.Report, words: Callable[[float], str], say: Say) -> str:
    """The verdict of a check in a few words."""
    if not report.failures:
        return say("Checked: passes", "检查：通过")
    first = report.failures[0]
    failure = say(*FAILURES[first.kind])
    return say(f"Checked: {failure} at {words(first.time)}", f"检查：{words(first.time)} {failure}")


QUESTION = Question(plan, None, body=PlanRequest, forms=(PDF_TYPE,), cost=lambda request: SECONDS, at="/plan")
