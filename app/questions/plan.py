"""The plan of a dance on paper."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import zip_longest
from typing import TYPE_CHECKING, Self

from pydantic import Field

import core
from app.files.tables import CSV_TYPE
from app.maps.marks import marks_of
from app.questions.check import FILE_OF_CHECK, verdict_of
from app.questions.maps import Marked
from app.wire.dances import clock_of, starting
from app.wire.degrees import Place
from app.wire.fields import Coordinate, OneLine, PaperSize, Wire, check_limit, measure
from app.wire.messages import checked
from app.wire.numbers import numbers_of
from app.wire.performances import SeveralFields
from app.wire.question import JSON, Command, ListOption, Output, Question, Terms
from core import Dance, FailureKind, InvalidValue, Judgement
from core.language import Language, counted, phrase, say
from core.motion.places import handle_places
from core.people.crew import places_near
from core.quantities import Given, Quantity, format_number
from core.questions import drawn
from core.shapes.engines import widened
from core.values import Interval

if TYPE_CHECKING:
    from app.files.typeset import Face
    from app.plan.paper import Title
    from app.plan.plan import Plan
    from app.plan.timing import TimeFormat, Timing

PDF_TYPE = "application/pdf"
# A file with sheets of paper, a table, or the answer.
SHEETS = Output(
    "Write a .pdf (extra paper), .csv or .json file.",
    {".pdf": PDF_TYPE, ".csv": CSV_TYPE, ".json": JSON},
    extras={".pdf": "paper"},
)
# Excess of the swept ground on paper [m]: 0.05 mm at 1:200.
EXCESS = 0.01
# Width of the zone to keep clear if there is no margin [m].
CLEAR = 0.5
# Time of the default dance's plan, measured 2026-11-29 [s].
SECONDS = 0.5
# Most gates of a plan, and longest name of one.
GATES_MAX, GATE_NAME_MAX = 20, 40
# Most dragons of a plan: all its sheets are laid out before the first one is written.
DRAGONS_MAX = 20
# Words for each kind of failure.
FAILURES = {
    FailureKind.CONTACT: phrase("benches touch or are too near"),
    FailureKind.VENUE: phrase("a bench is too near to the venue"),
    FailureKind.OUTSIDE: phrase("a bench starts outside the square or in an obstacle"),
    FailureKind.SPEED: phrase("a handle is too fast"),
    FailureKind.FOLDS: phrase("a bench cannot follow the path"),
    FailureKind.UNDECIDED: phrase("not decided"),
}


class PlanGate(Wire, strict=True):
    """A gate, or another place by name, whose passes the plan lists by the clock."""

    name: OneLine = Field(min_length=1, max_length=GATE_NAME_MAX, description="Its name")
    x: Coordinate = measure("m", "x of the place")
    y: Coordinate = measure("m", "y of the place")
    within: float = measure("m", "Largest distance of the path from the place where it passes it", 5.0, ge=0, le=100)

    @classmethod
    def of_text(cls, text: str) -> Self:
        """A gate as NAME,X,Y. raises: InvalidValue"""
        name, *place = text.rsplit(",", 2)
        if len(place) != 2 or not name:
            raise InvalidValue.in_words("gate", "--gate must be NAME,X,Y [m]", got=Given(text))
        return checked(cls, {"name": name, **dict(zip("xy", numbers_of("gate", ",".join(place), float), strict=True))})


GATES = {
    "gate": ListOption(
        "gates", "NAME,X,Y of a gate whose times the paper names; may be given several times.", PlanGate.of_text
    )
}


class GatedDance(Marked):
    """A dance, as for /check, its gates, and the words on its paper."""

    gates: list[PlanGate] = Field(
        [],
        max_length=GATES_MAX,
        fail_fast=True,
        description="Gates and other places by name: the paper shows when head and tail pass each",
    )
    title: OneLine = Field("", max_length=80, description="Title of the dance")
    paper: PaperSize = "A4"
    language: Language = Field(Language.ENGLISH, description="Language of the words: en or zh", strict=False)

    @property
    def heading(self) -> str:
        """The title of the paper."""
        return self.title or say("Bench dragon")


class DancePlan(GatedDance):
    """A dance, as for /check, and the look of its plan."""

    clear: float | None = measure(
        "m", "Width of the zone to keep clear around the swept ground; default: the margin, or 0.5 m without one", None,
        ge=0, le=100,
    )  # fmt: skip


class PlanRequest(SeveralFields, DancePlan):
    """A dance, or several on one clock, as for /check, and the look of its plan."""


def plan(request: PlanRequest, terms: Terms) -> bytes:
    """The dance on paper as PDF: a map true to scale, the place of each bench, the points to paint and the times."""
    from app.plan.plan import plan_pdf
    from app.plan.timing import TimeFormat

    if request.dances is not None:
        return _of_several(request, terms)
    dance = request.to_dance(terms.settings.checked_benches_max)
    request = starting(request, dance)
    place, clock = request.to_place(dance.dragon), TimeFormat(clock_of(request, dance), request.music)
    span = dance.span(request.start, request.stop)
    (passes,) = passes_of_gates(request, [dance], [span], terms.budget)
    timing = timing_of_marks(request, dance, span, passes, terms)
    swept = core.envelope(dance, start=span[0], stop=span[1], excess=EXCESS, budget=terms.budget)
    report = verdict_of(request, dance, place.venue, span[0], terms)
    verdict = verdict_words(report, clock.words), report.verdict is Judgement.PASSES
    common = _Common(request, place, verdict, _face(request, place, [dance.dragon], []), terms.budget)
    times = say("times: minutes:seconds, from time 0 of the dance")
    plans = [common.plan_of(dance, timing, swept, clock, times)]
    return drawn(dance, "the plan was not drawn", lambda: plan_pdf(plans, None, terms.progress))


def _of_several(request: PlanRequest, terms: Terms) -> bytes:
    """The plan of several dragons: all of them on one map, then the sheets of each."""
    from app.files.looks import colour_of
    from app.plan.plan import Together, plan_pdf
    from app.plan.timing import TimeFormat

    parts = request.dances or []
    check_limit(
        "dances", "dragons of a plan must be at most {most} here", len(parts), DRAGONS_MAX, "print some of them"
    )
    (performance, place), budget = request.to_placed(terms.settings), terms.budget
    request = starting(request, performance)
    start, stop = performance.span(request.start, request.stop)
    clock = TimeFormat(clock_of(request, performance))
    dances, spans = zip(*((part.dance, part.own_span(start, stop)) for part in performance.parts), strict=True)
    passes = passes_of_gates(request, dances, spans, budget)
    timings = [timing_of_marks(request, *one, terms) for one in zip(dances, spans, passes, strict=True)]
    grounds = core.envelope(performance, start=start, stop=stop, excess=EXCESS, budget=budget)
    report = core.quick_check(performance, start=start, stop=stop, budget=budget, **request.to_limits())
    verdict = verdict_words(report, clock.words), report.verdict is Judgement.PASSES
    names = list(map(performance.name_of, range(len(performance.parts))))
    common = _Common(request, place, verdict, _face(request, place, [one.dragon for one in dances], names), budget)
    times = say("times: minutes:seconds, from time 0 of the performance")
    plans = []
    for k, (part, timing, swept) in enumerate(zip(performance.parts, timings, grounds, strict=True)):
        own_clock = TimeFormat(clock.start_clock, parts[k].music, part.delay)
        colour = colour_of(performance, k)
        plans.append(common.plan_of(part.dance, timing, swept, own_clock, times, names[k], colour))
    benches = sum(one.dragon.benches for one in dances)
    facts = [
        say("{dance_count} dragons, {benches} benches", dance_count=len(dances), benches=benches),
        say("margin {margin} m", margin=format_number(request.margin)),
        _from_to(clock.words(start), clock.words(stop)),
        *_grid(place),
    ]
    moments = [start, 0.5 * (start + stop), stop]
    together = Together(performance, moments, names, clock, common.title_of(facts))
    return drawn(performance, "the plan was not drawn", lambda: plan_pdf(plans, together, terms.progress))


def timing_of_marks(
    request: GatedDance, dance: Dance, span: Interval, passes: list[tuple[str, float]], terms: Terms
) -> Timing:
    from app.plan.timing import timing_of

    return timing_of(dance, marks_of(dance, *span, request.spacing), *span, passes, terms.budget)


def _face(request: PlanRequest, place: Place, dragons: Sequence[core.Dragon], names: Sequence[str]) -> Face:
    """The face that has every character of the plan. names: of the dragons"""
    from app.files.typeset import face_for

    areas = place.venue.areas if place.venue else ()
    titles = [request.heading, *names]
    places = [*(one.name for one in request.gates), *(area.name for area in areas)]
    return face_for([*titles, *places, *(name for dragon in dragons for name in dragon.names)])


@dataclass(frozen=True, slots=True)
class _Common:
    """What the plans of all dragons of a request share. verdict: in words, and whether it passes"""

    request: PlanRequest
    place: Place
    verdict: tuple[str, bool]
    face: Face
    budget: core.Budget

    @property
    def geographic(self) -> bool:
        return self.request.origin_at(self.place) is not None

    def title_of(self, facts: list[str], name: str = "") -> Title:
        """The title block. name: of the dragon, empty if it is the only one, or for all of them"""
        from app.plan.paper import Title

        title = self.request.heading
        return Title(f"{title}: {name}" if name else title, facts, *self.verdict, self.geographic)

    def plan_of(
        self,
        dance: Dance,
        timing: Timing,
        swept: core.Envelope,
        clock: TimeFormat,
        times: str,
        name: str = "",
        colour: str = "",
    ) -> Plan:
        """The plan of a dragon. times: a note on what they are; name, colour: of one of several dragons"""
        from app.plan.ground import GroundMap
        from app.plan.plan import Plan
        from core.plots import BLUE

        request = self.request
        span = clock.words(timing.moments[0]), clock.words(timing.moments[-1])
        facts = [*_facts(dance, request.margin), _from_to(*span), *_grid(self.place)]
        width = request.clear if request.clear is not None else request.margin or CLEAR
        clear = widened(swept.polygons, width) if width else swept.polygons
        gates = [(one.name, one.x, one.y) for one in request.gates]
        venue = self.place.venue
        ground = GroundMap(dance, venue, swept.polygons, clear, width, timing, self.geographic, gates, colour or BLUE)
        numbers = [say("head"), *map(str, range(1, dance.dragon.benches))]
        names = [f"{number} {own}".rstrip() for number, own in zip_longest(numbers, dance.dragon.names, fillvalue="")]
        note = say("times: of the day") if clock.start_clock else times
        return Plan(ground, self.face, names, clock, self.title_of(facts, name), request.paper, self.budget, note)


def passes_of_gates(
    request: GatedDance,
    dances: Sequence[Dance],
    spans: Sequence[Interval],
    budget: core.Budget,
    others: Sequence[PlanGate] = (),
) -> list[list[tuple[str, float]]]:
    """For each dance, name and s [m] of each pass of a gate, in order along its path.

    others: gates besides those of the request, which may be off all paths
    raises: InvalidValue for a gate of the request off all paths
    """
    passes: list[list[tuple[str, float]]] = [[] for _ in dances]
    if not request.gates and not others:
        return passes
    walked = [handle_places(dance, span, budget=budget) for dance, span in zip(dances, spans, strict=True)]
    for k, gate in enumerate((*request.gates, *others)):
        near = [
            places_near(dance.path, (gate.x, gate.y), float(ends[0, -1]), float(ends[1, 0]), gate.within)
            for dance, ends in zip(dances, walked, strict=True)
        ]
        for own, places in zip(passes, near, strict=True):
            own += [(gate.name, s) for s in places]
        if not any(near) and k < len(request.gates):
            rule = "must be within {within} of the path that the dragon walks"
            raise InvalidValue(f"gates.{k}", rule, got=Given(gate.name), within=Quantity(gate.within, "m"))
    return [sorted(own, key=lambda one: one[1]) for own in passes]


def _from_to(start: str, stop: str) -> str:
    return say("from {start} to {stop}", start=start, stop=stop)


def _facts(dance: Dance, margin: float) -> list[str]:
    """The dance in lines of the title block."""
    dragon = dance.dragon
    length = float(dragon.chords.sum())
    moving = sorted({one.speed for one in dance.passages if one.speed > 0.0} | {dance.head_speed})
    speeds = format_number(moving[-1])
    if moving[0] < moving[-1]:
        speeds = say("{low} to {high}", low=format_number(moving[0]), high=speeds)
    pauses = sum(passage.speed == 0.0 for passage in dance.passages)
    paused = counted(pauses, " with {count} pause", " with {count} pauses") if pauses else ""
    return [
        say("{n} benches, {length:.1f} m from head to tail", n=dragon.benches, length=length),
        say("head at {speeds} m/s{paused}, margin {margin:g} m", speeds=speeds, paused=paused, margin=margin),
    ]


def _grid(place: Place) -> list[str]:
    """A line about the survey grid of the venue, if it has one."""
    if place.grid is None:
        return []
    x, y = (f"{one:.10g}" for one in place.grid)
    return [say("x = y = 0 is x {x} m, y {y} m of the survey grid", x=x, y=y)]


def verdict_words(report: core.Report | core.PerformanceReport, words: Callable[[float], str]) -> str:
    """The verdict of a check in a few words."""
    if not report.failures:
        return say("Checked: passes")
    first = report.failures[0]
    failure = say(FAILURES[first.kind])
    return say("Checked: {failure} at {time}", failure=failure, time=words(first.time))


def _cost(request: PlanRequest) -> float:
    return SECONDS * len(request.dances or [None])


QUESTION = Question(
    plan,
    None,
    body=PlanRequest,
    forms=(PDF_TYPE,),
    cost=_cost,
    at="/plan",
    command=Command(
        "A PDF to print, true to scale: map, place of each person, points to paint, times (extra paper).",
        lambda request: say("plan"),
        file=FILE_OF_CHECK,
        lists=GATES,
        outputs={"output": Output("Write a .pdf file.", {".pdf": PDF_TYPE}, "plan.pdf", {".pdf": "paper"})},
    ),
)
