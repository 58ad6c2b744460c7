"""The safety sheet of a dance: what whoever permits a festival asks for, each number from a question of core."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any, Self

import numpy as np
from pydantic import Field

import core
from app.plan.assumptions import assumptions_of
from app.plan.safety_answer import (
    Approach,
    Assumption,
    FastestCarriers,
    GatePass,
    Ground,
    Lane,
    LaneBody,
    LaneStay,
    LooseTail,
    SafetySheet,
    Stopping,
)
from app.plan.safety_words import (
    benches_words,
    cautions,
    known_words,
    part_on_stopping,
    parts_on_ground,
    passed_words,
    together,
)
from app.plan.timing import TimeFormat
from app.questions.check import FILE_OF_CHECK, limits_of, verdict_of, verdict_together
from app.questions.plan import (
    GATE_NAME_MAX,
    GATES,
    GATES_MAX,
    PDF_TYPE,
    GatedDance,
    PlanGate,
    passes_of_gates,
    timing_of_marks,
)
from app.wire.dances import clock_of, starting
from app.wire.degrees import Place
from app.wire.fields import Address, OneLine, measure
from app.wire.geojson import GATE, INNER_SQUARE, geometry_of
from app.wire.geojson import LANE as LANE_ROLE
from app.wire.performances import SeveralFields
from app.wire.question import JSON, UNKNOWN_COST, Command, ListOption, Output, Question, Terms
from app.wire.readings import dragons_failure_words, failure_words
from core import Area, FailureKind, InvalidValue, Judgement, Part, Performance
from core.language import joined, say
from core.motion.places import Passing
from core.motion.trajectory import trajectory
from core.quantities import Parameter, format_bound
from core.questions import drawn
from core.shapes.engines import Polygons, area_of, free_width, holds_all, inside, merged, widened
from core.shapes.reach import gains
from core.shapes.rectangles import bench_poses
from core.values import Pair

if TYPE_CHECKING:
    from app.plan.ground import SafetyLayers
    from app.plan.safety import SafetyWords

# Most lanes of a sheet, and approaches that it lists.
LANES_MAX, APPROACHES = 10, 5
# Benches that may be let go if the request does not say how many.
LOOSE = 3
# Excess of the swept ground, and distance from which on two approaches of benches are at different places [m].
EXCESS, APART = 0.01, 4.0
# Distance from which on an approach is none, such as that to the border of an endless plain [m].
FAR = 1000.0
# Points of a path at which it is looked at whether it leads through a gate [1].
GATE_SAMPLES = 41


class SafetySheetRequest(SeveralFields, GatedDance, strict=True):
    """A dance, or several on one clock, as for /check, and what its sheet assumes and names."""

    lanes: list[LaneBody] = Field(
        [],
        max_length=LANES_MAX,
        fail_fast=True,
        description="Lanes to keep free, such as those for ambulances; those of the venue follow them",
    )
    spectators: float = measure(
        "m", "Distance at which people stand from all ground that benches may sweep", 1.0, ge=0, le=100
    )
    loose: int | None = Field(
        None, ge=1, description="Number of the last benches that may be let go; default: 3, or all of a shorter dragon"
    )
    reaction: float = measure("s", "Time from the call to stop until everybody stands", 2.0, ge=0, le=60)
    stopper: OneLine = Field("", max_length=80, description="Who stops the dance")
    date: OneLine = Field("", max_length=40, description="Date of the sheet; empty: a line to fill in")
    address: Address = Field(
        "", max_length=500, description="Address of the dance, which stands on the sheet as a code"
    )


def safety_sheet(request: SafetySheetRequest, terms: Terms, form: str = JSON) -> SafetySheet | bytes:
    """One page for whoever permits a festival: verdict, nearest approaches, ground to keep free, lanes, stopping."""
    judged = _Judged.of(request, terms)
    answer = judged.answer(terms)
    return answer if form == JSON else judged.drawn(answer, terms)


@dataclass(frozen=True)
class _Judged:
    """Dances on one clock with the verdict on them, and the stretch of each that the sheet is about.

    start, stop: of the performance [s]; spans: start, stop and budget of each dance by itself
    """

    request: SafetySheetRequest
    performance: Performance
    place: Place
    report: core.Report | core.PerformanceReport
    start: float
    stop: float
    spans: list[dict[str, Any]]

    @classmethod
    def of(cls, request: SafetySheetRequest, terms: Terms) -> Self:
        """raises: TooLarge, InvalidValue"""
        budget = terms.budget
        if request.dances is None:
            dance = request.to_dance(terms.settings.checked_benches_max)
            request, place = starting(request, dance), request.to_place(dance.dragon)
            _refuse_more_than(request.loose, [dance.dragon])
            start = dance.span(request.start, request.stop)[0]
            report = verdict_of(request, dance, place.venue, start, terms)
            span = {"start": start, "stop": report.stop, "budget": budget}
            return cls(request, Performance([Part(dance)]), place, report, start, report.stop, [span])
        performance, place = request.to_placed(terms.settings)
        request = starting(request, performance)
        _refuse_more_than(request.loose, [part.dance.dragon for part in performance.parts])
        report_of_all = verdict_together(request, performance, terms)
        spans = []
        for part, own in zip(performance.parts, report_of_all.reports, strict=True):
            first, last = part.own_span(report_of_all.start, report_of_all.stop)
            spans.append({"start": first, "stop": own.stop if own else last, "budget": budget})
        return cls(request, performance, place, report_of_all, report_of_all.start, report_of_all.stop, spans)

    @property
    def dances(self) -> list[tuple[int, Part, dict[str, Any]]]:
        """Number, dance and span of each dragon."""
        return [(k, part, self.spans[k]) for k, part in enumerate(self.performance.parts)]

    @cached_property
    def swept(self) -> list[core.Envelope]:
        """The ground that benches of each dragon sweep with everybody in place."""
        return [core.envelope(part.dance, excess=EXCESS, **span) for _, part, span in self.dances]

    @cached_property
    def covered(self) -> Polygons:
        """The ground of all of them as people stray."""
        stray = self.request.to_stray()
        return merged(
            widened(swept.polygons, float(gains(part.dance.dragon).max()) * stray) if stray else swept.polygons
            for swept, (_, part, _) in zip(self.swept, self.dances, strict=True)
        )

    @cached_property
    def closed(self) -> Polygons:
        """Ground to keep people out of."""
        away = self.request.spectators
        return widened(self.covered, away) if away else self.covered

    @cached_property
    def loose(self) -> list[core.TailReach]:
        """The ground that the last benches of each dragon can reach when they are let go."""
        return [
            core.tail_reach(
                part.dance, loose_of(self.request, part.dance.dragon), stray=self.request.to_stray(), **span
            )
            for _, part, span in self.dances
        ]

    @cached_property
    def lanes(self) -> list[tuple[LaneBody, Area]]:
        """The lanes to keep free, those of the venue last, and the ground of each. raises: InvalidValue"""
        own = [(one, one.to_area(f"lanes.{k}")) for k, one in enumerate(self.request.lanes)]
        drawn = [one for one in self.place.asides if one.role == LANE_ROLE]
        if len(own) + len(drawn) > LANES_MAX:
            rule = "must have at most {most} lanes in all, with those of {lanes}"
            raise InvalidValue("venue", rule, got=len(own) + len(drawn), most=LANES_MAX, lanes=Parameter("lanes"))
        for k, one in enumerate(drawn, start=1):
            name, points = one.name or say("lane {k}", k=k), [list(point) for point in one.points]
            lane = LaneBody.model_construct(name=name, points=points, width=2.0 * (one.radius or 0.0))
            own.append((lane, lane.to_area("venue")))
        return own

    @cached_property
    def venue_gates(self) -> list[PlanGate]:
        """The gates that are drawn in the venue."""
        drawn = [one for one in self.place.asides if one.role == GATE]
        return [
            PlanGate(name=(one.name or say("gate {k}", k=k))[:GATE_NAME_MAX], x=one.points[0][0], y=one.points[0][1])
            for k, one in enumerate(drawn[:GATES_MAX], start=1)
        ]

    @property
    def inner(self) -> np.ndarray | None:
        """Corners of the square without the streets that were added beyond its gates [m]; None if none were added."""
        rings = [one.points for one in self.place.asides if one.role == INNER_SQUARE]
        return np.array(rings[0]) if rings else None

    def answer(self, terms: Terms) -> SafetySheet:
        request, swept, loose = self.request, self.swept, self.loose
        ground, reached = merged(one.polygons for one in swept), merged(one.polygons for one in loose)
        terms.progress(0.4)
        lanes = [self._lane(body, area) for body, area in self.lanes]
        terms.progress(0.7)
        fastest = self._fastest()
        return SafetySheet(
            verdict=self.report.verdict,
            sentences=self.sentences(),
            start=self.start,
            stop=self.stop,
            assumptions=self._assumptions(),
            approaches=self._approaches(),
            swept=Ground(ground=geometry_of(ground), area=area_of(ground), excess=max(one.excess for one in swept)),
            spectators=geometry_of(self.closed),
            loose_tail=LooseTail(
                ground=geometry_of(reached),
                area=area_of(reached),
                excess=max(one.excess for one in loose),
                benches=max(one.benches for one in loose),
                reach=max(one.reach for one in loose),
                beyond_spectators=not holds_all(self.closed, reached),
            ),
            lanes=lanes,
            gates=self._gates(terms),
            fastest=fastest,
            stopping=fastest
            and Stopping(reaction=request.reaction, distance=request.reaction * (fastest.at_most or fastest.speed)),
        )

    def drawn(self, answer: SafetySheet, terms: Terms) -> bytes:
        """The sheet on paper as PDF. raises: TooMuchWork"""
        from app.files.looks import colour_of
        from app.files.typeset import face_for
        from app.plan.ground import GroundMap
        from app.plan.safety import safety_pdf
        from core.plots import BLUE

        request, performance, venue = self.request, self.performance, self.place.venue
        gates = [(one.name, one.x, one.y) for one in (*request.gates, *self.venue_gates)]
        geographic = request.origin_at(self.place) is not None
        grounds = []
        for (k, part, span), swept in zip(self.dances, self.swept, strict=True):
            colour = colour_of(performance, k) if len(performance.parts) > 1 else BLUE
            timing = timing_of_marks(request, part.dance, (span["start"], span["stop"]), [], terms)
            grounds.append(
                GroundMap(
                    part.dance,
                    venue,
                    swept.polygons,
                    self.closed,
                    request.spectators,
                    timing,
                    geographic,
                    gates,
                    colour,
                )
            )
        layers, words = self._layers(answer), self._words(answer)
        areas = [area.name for area in venue.areas] if venue else []
        benches = [name for part in performance.parts for name in part.dance.dragon.names]
        names = [*areas, *(name for name, *_ in gates), *(name for name, _ in layers.lanes), *benches, *layers.dragons]
        face = face_for([words.title, request.stopper, *names])
        sheet = words, grounds, layers, face, terms.budget
        return drawn(performance, "the safety sheet was not drawn", lambda: safety_pdf(*sheet))

    def _layers(self, answer: SafetySheet) -> SafetyLayers:
        """What the map of the sheet shows besides the ground."""
        from app.files.looks import with_square
        from app.plan.ground import SafetyLayers

        performance = self.performance
        dragons = [performance.name_of(k) for k in range(len(performance.parts))] if len(performance.parts) > 1 else []
        loose = merged(one.polygons for one in self.loose)
        lanes = [(one.name, [np.array(ring) for ring in one.rings]) for _, one in self.lanes]
        corners = np.concatenate([rings[0] for rings in (*self.closed, *loose)])
        box = with_square(self.place.venue, corners.min(axis=0), corners.max(axis=0))
        return SafetyLayers(loose, lanes, box, dragons, [one.point for one in answer.approaches])

    def _words(self, answer: SafetySheet) -> SafetyWords:
        """The words of the sheet."""
        from app.plan.safety import SafetyWords

        request, performance, clock = self.request, self.performance, self.clock
        near = [
            [
                str(number), one.sentence, f"{one.distance:.2f}", clock.words(one.time),
                f"{one.point[0]:.1f}, {one.point[1]:.1f}",
            ]
            for number, one in enumerate(answer.approaches, start=1)
        ]  # fmt: skip
        rests = [[one.label, one.text, say("as set") if one.yours else say("assumed")] for one in answer.assumptions]
        span_words = {"start": clock.words(answer.start), "stop": clock.words(answer.stop)}
        count = sum(part.dance.dragon.benches for part in performance.parts)
        subtitle = say("Safety sheet: {benches} benches, from {start} to {stop}", benches=count, **span_words)
        if len(performance.parts) > 1:
            subtitle = say(
                "Safety sheet: {dance_count} dragons, {benches} benches, from {start} to {stop}",
                dance_count=len(performance.parts), benches=count, **span_words,
            )  # fmt: skip
        verdict, known = answer.sentences
        return SafetyWords(
            title=request.heading,
            subtitle=subtitle,
            verdict=answer.verdict.value,
            sentences=[verdict, joined([known, *cautions(answer, nobody_strays=not request.total_stray)])],
            date=request.date,
            address=request.address,
            approaches=_table(
                say("Nearest approaches"), ["", say("what comes near"), say("gap [m]"), say("at"), "x, y [m]"], near,
                [0.25, 2.3, 0.8, 0.9, 1.1],
            ),
            assumptions=_table(
                say("What this rests on"), [say("what"), say("value"), say("from")], rests, [2.0, 1.4, 0.9]
            ),
            left=parts_on_ground(answer, performance, clock, request.spectators),
            right=[part_on_stopping(answer, performance, clock, request.stopper)],
            paper=request.paper,
        )  # fmt: skip

    @property
    def clock(self) -> TimeFormat:
        """The format of times."""
        one = self.request.dances is None
        subject = self.performance.parts[0].dance if one else self.performance
        return TimeFormat(clock_of(self.request, subject), self.request.music)

    def sentences(self) -> list[str]:
        """The verdict, and how it is known, for a layman."""
        request, report, venue = self.request, self.report, self.place.venue
        if report.verdict is Judgement.PASSES:
            stray = request.total_stray or 0.0
            return [passed_words(request.margin, request.speed_limit, stray, venue is not None), known_words()]
        certain = report.verdict is Judgement.FAILS
        first = next(one for one in report.failures if not certain or one.kind is not FailureKind.UNDECIDED)
        words, dragon = limits_of(request, venue), self.performance.parts[0].dance.dragon
        failure = (
            failure_words(first, dragon, words)
            if isinstance(first, core.Failure)
            else dragons_failure_words(first, self.performance, words)
        )
        if certain:
            fails = say("It cannot be danced like this: {failure}", failure=failure)
            return [fails, say("That is certain, at {time}.", time=self.clock.words(first.time))]
        undecided = say("It is not known whether it can be danced: {failure}", failure=failure)
        return [undecided, say("Up to {time} s nothing fails, which is proven.", time=format_bound(first.time, 1))]

    def _approaches(self) -> list[Approach]:
        """The nearest approach to each area, of two benches of a dragon, and of two dragons, with everybody in place;
        further ones of two benches, at places apart, where these are fewer than APPROACHES. Nearest first."""

        def gap(one: Approach) -> float:
            return one.distance

        areas, further = dict[str, Approach](), list[Approach]()
        of_benches, of_dragons = list[Approach](), list[Approach]()
        for k, part, span in self.dances:
            for name, one in self._of_areas(k, part, span):
                areas[name] = min(areas.get(name, one), one, key=gap)
            if (least := core.least_clearance(part.dance, **span)) is not None:
                of_benches.append(self._of_benches((k, k), least, least.distance, part.delay, least.at_least))
                ends = [span["start"], span["stop"]]
                for graze in core.clearance_profile(part.dance, ends, budget=span["budget"]).grazes:
                    further.append(self._of_benches((k, k), graze, graze.clearance, part.delay))
        if len(self.performance.parts) > 1:
            ends, budget = [self.start, self.stop], self.spans[0]["budget"]
            if met := core.least_clearance(self.performance, start=self.start, stop=self.stop, budget=budget):
                of_dragons.append(self._of_benches(met.dragons, met, met.distance, 0.0, met.at_least))
                for near in core.clearance_profile(self.performance, ends, budget=budget).grazes:
                    further.append(self._of_benches(near.dragons, near, near.clearance))

        nearest = [*areas.values(), *(min(some, key=gap) for some in (of_benches, of_dragons) if some)]
        nearest = sorted(nearest, key=gap)[:APPROACHES]
        for one in sorted([*of_benches, *of_dragons, *further], key=gap):
            known = [other.point for other in nearest if other.area is None]
            if len(nearest) < APPROACHES and all(math.dist(one.point, point) > APART for point in known):
                nearest.append(one)
        return sorted(nearest, key=gap)

    def _of_areas(self, k: int, part: Part, span: dict[str, Any]) -> Iterator[tuple[str, Approach]]:
        """How near benches of a dragon come to each area, with its name."""
        if self.place.venue is None:
            return
        for area in core.venue_clearance(part.dance, self.place.venue, **span).areas:
            if (near := area.nearest) is not None and near.distance < FAR:
                (bench,) = benches_words([near.bench], [k], self.performance)
                words = say("{bench} and {area}", bench=bench, area=area.name)
                if area.name == self.place.venue.square.name:
                    words = say("{bench} and the edge of {area}", bench=bench, area=area.name)
                yield area.name, Approach(
                    distance=near.distance, at_least=near.at_least, time=near.time + part.delay, dragons=[k],
                    benches=[near.bench], area=area.name, point=near.point, sentence=words,
                )  # fmt: skip

    def _of_benches(
        self, dragons: Pair, near: Any, gap: float, delay: float = 0.0, at_least: float | None = None
    ) -> Approach:
        """An approach of two benches. near: has their numbers and the time of the dance [s]; delay: of that [s]"""
        parts, time, benches = self.performance.parts, near.time + delay, list(near.benches)
        centres = [
            bench_poses(trajectory(parts[k].dance, [parts[k].own_time(time)]).position[0])[bench, :2]
            for k, bench in zip(dragons, benches, strict=True)
        ]
        x, y = np.mean(centres, axis=0).tolist()
        a, b = benches_words(benches, dragons, self.performance)
        return Approach(
            distance=gap, at_least=at_least, time=time, dragons=list(dragons), benches=benches, area=None,
            point=[x, y], sentence=say("{a} and {b}", a=a, b=b),
        )  # fmt: skip

    def _lane(self, body: LaneBody, area: Area) -> Lane:
        free, stays = free_width(self.covered, body.middle, body.width), list[LaneStay]()
        if free < body.width:
            stray, budget = self.request.to_stray(), self.spans[0]["budget"]
            each = core.stays(self.performance, area, stray=stray, start=self.start, stop=self.stop, budget=budget)
            stays = [LaneStay.from_result(one, dragon=k) for k, found in enumerate(each) for one in found.stays]
        total = sum(end - begin for begin, end in together([(one.begin, one.end) for one in stays]))
        reached = free_width(merged(one.polygons for one in self.loose), body.middle, body.width) < body.width
        return Lane(
            name=body.name, width=body.width, free_width=free, stays=stays, total=total, in_loose_reach=reached
        )  # fmt: skip

    def _gates(self, terms: Terms) -> list[GatePass]:
        dances = [part.dance for part in self.performance.parts]
        ends = [(span["start"], span["stop"]) for span in self.spans]
        every = passes_of_gates(self.request, dances, ends, terms.budget, self.venue_gates)
        gates, within = list[GatePass](), {one.name: one.within for one in self.venue_gates}
        for (k, part, _), span, passes in zip(self.dances, ends, every, strict=True):
            passing = Passing(part.dance, *span, budget=terms.budget)
            for name, s in passes:
                if name in within and not self._leads_through(part.dance.path, s, within[name]):
                    continue
                times = (passing.when(handle, s) for handle in (0, part.dance.dragon.benches))
                head, tail = (None if time is None else time + part.delay for time in times)
                gates.append(GatePass.between(k, name, head, tail))
        return gates

    def _assumptions(self) -> list[Assumption]:
        dragons = [part.dance.dragon for part in self.performance.parts]
        loose = max(loose_of(self.request, dragon) for dragon in dragons)
        return assumptions_of(self.request, dragons, loose, has_added_streets=self.inner is not None)

    def _leads_through(self, path: Any, s: float, within: float) -> bool:
        """True if a path that comes near a gate of the square at s leads into or out of the square there.

        Where no streets were added, no path leaves the square: each is taken as a passage. s, within: [m]
        """
        if self.inner is None:
            return True
        points = path.position(np.linspace(max(s - within, path.begin), min(s + within, path.end), GATE_SAMPLES))
        is_in = inside([self.inner], points)
        return bool(is_in.any() and not is_in.all())

    def _fastest(self) -> FastestCarriers | None:
        """The fastest carriers of all dragons that move; None where one of these has no highest speed."""
        reports = [self.report] if isinstance(self.report, core.Report) else self.report.reports
        moving = [(k, one.highest_speed) for k, one in enumerate(reports) if one is not None]
        if not moving or any(highest is None for _, highest in moving):
            return None
        k, highest = max(((k, one) for k, one in moving if one), key=lambda pair: pair[1].speed)
        part = self.performance.parts[k]
        point = trajectory(part.dance, [highest.time]).position[0, highest.handles[0]].tolist()
        most = [one.speed_bracket[1] for _, one in moving if one]
        at_most = None if None in most else max(one for one in most if one is not None)
        return FastestCarriers(
            dragon=k, speed=highest.speed, at_most=at_most, time=highest.time + part.delay,
            handles=list(highest.handles), point=point,
        )  # fmt: skip


def _table(heading: str, columns: list[str], rows: list[list[str]], widths: list[float]) -> dict[str, Any]:
    """A table of the sheet, whose first two columns begin at the left."""
    return {"heading": heading, "columns": columns, "rows": rows, "widths": widths, "left": [0, 1]}


def _refuse_more_than(loose: int | None, dragons: Sequence[core.Dragon]) -> None:
    """raises: InvalidValue for more loose benches than the shortest dragon has"""
    least = min(dragon.benches for dragon in dragons)
    if loose is not None and loose > least:
        raise InvalidValue("loose", "must be at most {most}, all benches of the dragon", got=loose, most=least)


def loose_of(request: SafetySheetRequest, dragon: core.Dragon) -> int:
    """Number of the last benches that may be let go."""
    return request.loose or min(LOOSE, dragon.benches)


def _cost(request: SafetySheetRequest, form: str = JSON) -> float:
    return UNKNOWN_COST


LANE = ListOption(
    "lanes",
    "NAME,WIDTH,X,Y,X,Y,... of a lane to keep free and its middle; may be given several times.",
    LaneBody.of_text,
)
QUESTION = Question(
    safety_sheet,
    SafetySheet,
    None,
    SafetySheetRequest,
    (JSON, PDF_TYPE),
    _cost,
    at="/safety-sheet",
    command=Command(
        "One page for whoever permits a festival: verdict, nearest approaches, ground and lanes to keep free, "
        "stopping.\n\nOf a FILE of several dragons, one page for all of them.",
        lambda request: say("safety sheet"),
        file=FILE_OF_CHECK,
        lists={"lane": LANE} | GATES,
        outputs={
            "output": Output(
                "Write a .pdf or .json file.",
                {".pdf": PDF_TYPE, ".json": JSON},
                "safety-sheet.pdf",
                {".pdf": "paper"},
            )
        },
    ),
)
