"""The safety sheet of a dance: what whoever permits a festival asks for, each number from a question of core."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any, Self

import numpy as np
from pydantic import Field

import core
from app.plan.safety_answer import (
    Approach,
    Assumption,
    FastestCarriers,
    GatePass,
    Ground,
    Lane,
    LooseTail,
    SafetySheet,
    Stopping,
)
from app.plan.timing import TimeFormat
from app.questions.check import FILE_OF_CHECK, limits_of, verdict_of
from app.questions.plan import GATES, PDF_TYPE, GatedDance, passes_of_gates, timing_of_marks
from app.wire.dances import clock_of, starting
from app.wire.degrees import Place
from app.wire.fields import Address, OneLine, Wire, measure
from app.wire.geojson import geometry_of
from app.wire.messages import checked
from app.wire.numbers import numbers_of
from app.wire.paths import Point as PointField
from app.wire.question import JSON, UNKNOWN_COST, Command, ListOption, Output, Question, Terms
from app.wire.readings import bench_words, failure_words, handles_words
from core import Area, Dance, FailureKind, InvalidValue, Judgement
from core.errors import Given, format_bound, format_number, question_about
from core.language import Listed, counted, joined, say, sense
from core.motion.places import Passing
from core.motion.trajectory import trajectory
from core.shapes.engines import Polygons, free_width, lane_rings, widened
from core.shapes.reach import gains
from core.shapes.rectangles import bench_poses
from core.values import Floats

if TYPE_CHECKING:
    from app.files.typeset import Face
    from app.plan.ground import GroundMap, SafetyLayers
    from app.plan.safety import SafetyWords

# Most lanes of a sheet, and approaches that it lists.
LANES_MAX, APPROACHES = 10, 5
# Benches that may be let go if the request does not say how many.
LOOSE = 3
# Excess of the swept ground, and distance from which on two approaches of benches are at different places [m].
EXCESS, APART = 0.01, 4.0


class LaneBody(Wire, strict=True):
    """A lane to keep free, such as one for ambulances."""

    name: OneLine = Field(min_length=1, max_length=40, description="Its name")
    points: list[PointField] = measure("m", "Points of its middle line, x and y", min_length=2, max_length=50)
    width: float = measure("m", "Its width", 3.5, ge=0.5, le=50)

    @classmethod
    def of_text(cls, text: str) -> Self:
        """A lane as NAME,WIDTH,X,Y,X,Y,... raises: InvalidValue"""
        name, *rest = text.split(",")
        if len(rest) < 5 or len(rest) % 2 == 0 or not name:
            raise InvalidValue.in_words("lane", "--lane must be NAME,WIDTH,X,Y,X,Y,... [m]", got=Given(text))
        width, *places = numbers_of("lane", ",".join(rest), float)
        points = [list(pair) for pair in zip(places[::2], places[1::2], strict=True)]
        return checked(cls, {"name": name, "width": width, "points": points})

    @property
    def middle(self) -> Floats:
        """Points of its middle line (P, 2) [m]."""
        return np.array(self.points, dtype=np.float64)

    def to_area(self, field: str) -> Area:
        """The ground of it. raises: InvalidValue"""
        try:
            rings = lane_rings(self.middle, self.width)
            return Area(self.name, tuple(tuple((x, y) for x, y in ring.tolist()) for ring in rings))
        except (InvalidValue, ValueError) as error:
            raise InvalidValue(f"{field}.points", "must be a line with a length") from error


class SafetySheetRequest(GatedDance, strict=True):
    """A dance, as for /check, and what its sheet assumes and names."""

    lanes: list[LaneBody] = Field(
        [], max_length=LANES_MAX, fail_fast=True, description="Lanes to keep free, such as those for ambulances"
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
    dance = request.to_dance(terms.settings.checked_benches_max)
    judged = _Judged.of(starting(request, dance), dance, terms)
    answer = judged.answer(terms)
    return answer if form == JSON else judged.drawn(answer, terms)


@dataclass(frozen=True)
class _Judged:
    """A dance with the verdict on it, and the stretch of it that the sheet is about."""

    request: SafetySheetRequest
    dance: Dance
    place: Place
    report: core.Report
    span: dict[str, Any]

    @classmethod
    def of(cls, request: SafetySheetRequest, dance: Dance, terms: Terms) -> Self:
        if request.loose is not None and request.loose > dance.dragon.benches:
            rule = "must be at most {most}, all benches of the dragon"
            raise InvalidValue("loose", rule, got=request.loose, most=dance.dragon.benches)
        place = request.to_place(dance.dragon)
        start = dance.span(request.start, request.stop)[0]
        report = verdict_of(request, dance, place.venue, start, terms)
        return cls(request, dance, place, report, {"start": start, "stop": report.stop, "budget": terms.budget})

    @cached_property
    def swept(self) -> core.Envelope:
        """The ground that benches sweep with everybody in place."""
        return core.envelope(self.dance, excess=EXCESS, **self.span)

    @cached_property
    def covered(self) -> Polygons:
        """The same as people stray."""
        dragon, stray = self.dance.dragon, self.request.to_stray()
        return widened(self.swept.polygons, float(gains(dragon).max()) * stray) if stray else self.swept.polygons

    @cached_property
    def closed(self) -> Polygons:
        """Ground to keep people out of."""
        away = self.request.spectators
        return widened(self.covered, away) if away else self.covered

    @cached_property
    def loose(self) -> core.TailReach:
        """The ground that the last benches can reach when they are let go."""
        benches = loose_of(self.request, self.dance.dragon)
        return core.tail_reach(self.dance, benches, stray=self.request.to_stray(), **self.span)

    @cached_property
    def lanes(self) -> list[Area]:
        """The lanes to keep free. raises: InvalidValue"""
        return [one.to_area(f"lanes.{k}") for k, one in enumerate(self.request.lanes)]

    def answer(self, terms: Terms) -> SafetySheet:
        request, report, swept, loose = self.request, self.report, self.swept, self.loose
        terms.progress(0.4)
        lanes = [self._lane(body, area) for body, area in zip(request.lanes, self.lanes, strict=True)]
        terms.progress(0.7)
        fastest = self._fastest()
        return SafetySheet(
            verdict=report.verdict,
            sentences=self.sentences(),
            start=self.span["start"],
            stop=self.span["stop"],
            assumptions=assumptions_of(request, self.dance.dragon),
            approaches=sorted(self._approaches(), key=lambda one: one.distance)[:APPROACHES],
            swept=Ground(ground=geometry_of(swept.polygons), area=swept.area, excess=swept.excess),
            spectators=geometry_of(self.closed),
            loose_tail=LooseTail.from_result(loose, ground=geometry_of(loose.polygons)),
            lanes=lanes,
            gates=self._gates(terms),
            fastest=fastest,
            stopping=fastest
            and Stopping(reaction=request.reaction, distance=request.reaction * (fastest.at_most or fastest.speed)),
        )

    def drawn(self, answer: SafetySheet, terms: Terms) -> bytes:
        """The sheet on paper as PDF. raises: TooMuchWork"""
        from app.files.looks import with_square
        from app.files.typeset import face_for
        from app.plan.ground import GroundMap, SafetyLayers
        from app.plan.safety import SafetyWords
        from app.plan.tables import Json

        request, dance, venue = self.request, self.dance, self.place.venue
        clock = TimeFormat(clock_of(request, dance), request.music)
        gates = [(one.name, one.x, one.y) for one in request.gates]
        timing = timing_of_marks(request, dance, (answer.start, answer.stop), [], terms)
        geographic, loose = request.origin_at(self.place) is not None, self.loose.polygons
        ground = GroundMap(
            dance, venue, self.swept.polygons, self.closed, request.spectators, timing, geographic, gates
        )
        lanes = [(one.name, [np.array(ring) for ring in one.rings]) for one in self.lanes]
        corners = np.concatenate([rings[0] for rings in (*self.closed, *loose)])
        layers = SafetyLayers(loose, lanes, with_square(venue, corners.min(axis=0), corners.max(axis=0)))
        title = request.title or say("Bench dragon")
        areas = [area.name for area in venue.areas] if venue else []
        names = [*areas, *(name for name, *_ in gates), *(name for name, _ in lanes), *dance.dragon.names]
        face = face_for([title, request.stopper, *names])

        def table(heading: str, columns: list[str], rows: list[list[str]], wide: list[float], left: list[int]) -> Json:
            return {"heading": heading, "columns": columns, "rows": rows, "widths": wide, "left": left}

        near = [
            [one.sentence, f"{one.distance:.2f}", clock.words(one.time), f"{one.point[0]:.1f}, {one.point[1]:.1f}"]
            for one in answer.approaches
        ]
        rests = [[one.label, one.text, say("yours") if one.yours else say("assumed")] for one in answer.assumptions]
        words = SafetyWords(
            title=title,
            subtitle=say("Safety sheet: {benches} benches, from {start} to {stop}", benches=dance.dragon.benches,
                         start=clock.words(answer.start), stop=clock.words(answer.stop)),
            verdict=answer.verdict.value,
            sentences=answer.sentences,
            date=request.date,
            address=request.address,
            approaches=table(
                say("Nearest approaches"), [say("what comes near"), say("gap [m]"), say("at"), "x, y [m]"], near,
                [2.4, 0.8, 1.0, 1.2], [0],
            ),
            assumptions=table(
                say("What this rests on"), [say("what"), say("value"), say("from")], rests, [2.0, 1.4, 0.9], [0, 1]
            ),
            lines=parts_of(answer, request, clock),
            paper=request.paper,
        )  # fmt: skip
        return _drawn(dance, words, (ground, layers), face, terms)

    def sentences(self) -> list[str]:
        """The verdict, and how it is known, for a layman."""
        request, report, dragon = self.request, self.report, self.dance.dragon
        if report.verdict is Judgement.PASSES:
            return [passed_words(request, self.place.venue is not None), known_words()]
        certain = report.verdict is Judgement.FAILS
        first = next(one for one in report.failures if not certain or one.kind is not FailureKind.UNDECIDED)
        failure = failure_words(first, dragon, limits_of(request, self.place.venue))
        if certain:
            fails = say("It cannot be danced like this: {failure}", failure=failure)
            return [fails, say("That is certain, at {time:.1f} s.", time=first.time)]
        undecided = say("It is not known whether it can be danced: {failure}", failure=failure)
        return [undecided, say("Up to {time} s nothing fails, which is proven.", time=format_bound(first.time, 1))]

    def _approaches(self) -> Iterator[Approach]:
        """How near benches come to each area, and at places apart to one another, with everybody in place."""
        if self.place.venue is not None:
            for area in core.venue_clearance(self.dance, self.place.venue, **self.span).areas:
                if (near := area.nearest) is not None:
                    bench = bench_words(near.bench, self.dance.dragon)
                    words = say("{bench} and {area}", bench=bench, area=area.name)
                    yield Approach.from_result(near, benches=[near.bench], area=area.name, sentence=words)
        if (least := core.least_clearance(self.dance, **self.span)) is None:
            return
        yield (nearest := self._of_benches(least.distance, least.at_least, least.time, least.benches))
        ends, places = [self.span["start"], self.span["stop"]], [nearest.point]
        grazes = core.clearance_profile(self.dance, ends, budget=self.span["budget"]).grazes
        for graze in sorted(grazes, key=lambda one: one.clearance):
            approach = self._of_benches(graze.clearance, None, graze.time, graze.benches)
            if all(math.dist(approach.point, place) > APART for place in places):
                places.append(approach.point)
                yield approach
            if len(places) == APPROACHES:
                return

    def _of_benches(self, gap: float, at_least: float | None, time: float, benches: tuple[int, int]) -> Approach:
        a, b = (bench_words(bench, self.dance.dragon) for bench in benches)
        centres = bench_poses(trajectory(self.dance, [time]).position[0])[list(benches), :2]
        x, y = centres.mean(axis=0).tolist()
        words = say("{a} and {b}", a=a, b=b)
        return Approach(
            distance=gap, at_least=at_least, time=time, benches=list(benches), area=None, point=[x, y], sentence=words
        )

    def _lane(self, body: LaneBody, area: Area) -> Lane:
        free, stays = free_width(self.covered, body.middle, body.width), list[core.Stay]()
        if free < body.width:
            found = core.stays(self.dance, area, stray=self.request.to_stray(), **self.span)
            stays = list(found.stays)
        total = sum(one.end - one.begin for one in stays)
        return Lane(name=body.name, width=body.width, free_width=free, stays=stays, total=total)

    def _gates(self, terms: Terms) -> list[GatePass]:
        start, stop = self.span["start"], self.span["stop"]
        (passes,) = passes_of_gates(self.request, [self.dance], [(start, stop)], terms.budget)
        passing, last = Passing(self.dance, start, stop, budget=terms.budget), self.dance.dragon.benches
        return [GatePass.between(name, passing.when(0, s), passing.when(last, s)) for name, s in passes]

    def _fastest(self) -> FastestCarriers | None:
        if (highest := self.report.highest_speed) is None:
            return None
        point = trajectory(self.dance, [highest.time]).position[0, highest.handles[0]].tolist()
        return FastestCarriers.from_result(highest, at_most=highest.speed_bracket[1], point=point)


@question_about("dance", Dance, "the safety sheet was not drawn")
def _drawn(dance: Dance, words: SafetyWords, map: tuple[GroundMap, SafetyLayers], face: Face, terms: Terms) -> bytes:
    """The bytes of the sheet. raises: TooMuchWork"""
    from app.plan.safety import safety_pdf

    return safety_pdf(words, *map, face, terms.budget)


def parts_of(answer: SafetySheet, request: SafetySheetRequest, clock: TimeFormat) -> list[tuple[str, list[str]]]:
    """The further parts of a sheet: heading and sentences of each."""
    tail, swept = answer.loose_tail, answer.swept
    ground = [
        say("Benches sweep {area:.0f} m2; people stand {away} m and more from it.", area=swept.area,
            away=format_number(request.spectators)),
        counted(tail.benches, "The last bench, let go, comes at most {reach} m from its front handle.",
                "The last {count} benches, let go, come at most {reach} m from the front handle of the first of them.",
                reach=format_bound(tail.reach, 1, up=True)),
    ]  # fmt: skip
    parts = [(say("Ground"), ground)]
    if answer.lanes:
        parts.append((say("Lanes to keep free"), [lane_words(one, clock) for one in answer.lanes]))
    if answer.gates:
        lines = [
            say(
                "{name}: head {head}, tail {tail}",
                name=one.name,
                head=clock.words(one.head),
                tail=clock.words(one.tail),
            )
            + ("" if one.lasts is None else say(", {seconds:.0f} s to pass", seconds=one.lasts))
            for one in answer.gates
        ]
        parts.append((say("Gates"), lines))
    if answer.fastest is not None and answer.stopping is not None:
        fastest, (x, y) = answer.fastest, answer.fastest.point
        lines = [
            say("Fastest: {handles} with {speed:.2f} m/s at {time}, at x {x:.1f} m, y {y:.1f} m.",
                handles=handles_words(fastest.handles), speed=fastest.speed, time=clock.words(fastest.time), x=x, y=y),
            say("After the call to stop, nobody goes further than {way} m.",
                way=format_bound(answer.stopping.distance, 1, up=True)),
        ]  # fmt: skip
        if request.stopper:
            lines.append(say("Who stops the dance: {name}", name=request.stopper))
        parts.append((say("Speed and stop"), lines))
    return parts


def lane_words(lane: Lane, clock: TimeFormat) -> str:
    """What is known of a lane, in a sentence."""
    name, width = lane.name, format_number(lane.width)
    if not lane.stays:
        return say("{name}, {width} m wide: no bench is ever in it.", name=name, width=width)
    stays = Listed(
        say("from {start} to {stop}", start=clock.words(one.begin), stop=clock.words(one.end)) for one in lane.stays[:4]
    )
    more = say(" and later") if len(lane.stays) > 4 else ""
    words = say(
        "{name}, {width} m wide: benches are in it {stays}{more}, {seconds:.0f} s in all.",
        name=name, width=width, stays=stays, more=more, seconds=lane.total,
    )  # fmt: skip
    free = format_bound(lane.free_width, 1)
    return joined([words, say("At least {free} m of its width stay free.", free=free) if float(free) else ""])


def passed_words(request: SafetySheetRequest, venue: bool) -> str:
    """That the dance passes, for a layman."""
    margin, parts = format_number(request.margin), list[str]()
    match bool(request.margin), venue:
        case False, False:
            parts = [say("no bench touches another")]
        case False, True:
            parts = [say("no bench touches another, an edge or an obstacle of the square")]
        case True, False:
            parts = [say("no bench comes within {margin} m of another", margin=margin)]
        case True, True:
            words = say(
                "no bench comes within {margin} m of another, an edge or an obstacle of the square", margin=margin
            )
            parts = [words]
    if request.speed_limit is not None:
        parts.append(say("nobody is faster than {limit} m/s", limit=format_number(request.speed_limit)))
    if stray := request.total_stray:
        parts.append(say("as long as everybody is within {stray} m of their place", stray=format_number(stray)))
    return say("It can be danced: {facts}.", facts=sense("clauses", ", ").join(parts))


def known_words() -> str:
    """How a verdict that passes is known, for a layman."""
    return say(
        "This is proven by computation for every instant, for benches, path and speeds as they stand below; "
        "whoever dances otherwise is not covered by it."
    )


def loose_of(request: SafetySheetRequest, dragon: core.Dragon) -> int:
    """Number of the last benches that may be let go."""
    return request.loose or min(LOOSE, dragon.benches)


def assumptions_of(request: SafetySheetRequest, dragon: core.Dragon) -> list[Assumption]:
    """What a sheet rests on, and which of it the request gives."""
    given, own = request.model_fields_set, request.dragon.model_fields_set
    longest, shortest = float(dragon.lengths.max()), float(dragon.lengths.min())
    sizes = say("{low} to {high} m long", low=format_number(shortest), high=format_number(longest))
    speed = say("no limit") if request.speed_limit is None else f"{format_number(request.speed_limit)} m/s"
    streets = say("none given") if request.venue is None else say("as drawn")
    rows = [
        (say("benches"), str(dragon.benches), bool(own & {"benches", "lengths"})),
        (say("sizes of benches"), sizes, bool(own - {"benches", "names"})),
        (
            say("speed of the head"),
            f"{format_number(request.head_speed)} m/s",
            bool(given & {"head_speed", "passages", "beats"}),
        ),
        (
            say("people stray at most"),
            f"{format_number(request.total_stray or 0.0)} m",
            bool(given & {"stray", "hole", "pin"}),
        ),
        (say("benches keep apart"), f"{format_number(request.margin)} m", "margin" in given),
        (say("speed limit"), speed, "speed_limit" in given),
        (say("square, streets and obstacles"), streets, request.venue is not None),
        (say("people stand back"), f"{format_number(request.spectators)} m", "spectators" in given),
        (say("last benches that may be let go"), str(loose_of(request, dragon)), "loose" in given),
        (say("time to stop"), f"{format_number(request.reaction)} s", "reaction" in given),
    ]
    return [Assumption(label=label, text=text, yours=yours) for label, text, yours in rows]


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
        "stopping.",
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
