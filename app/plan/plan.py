"""The plan of a dance as PDF: the map true to scale, the benches at three moments, the points to paint, the times.

The same dance gives the same bytes on the same fonts and versions of the libraries, because the file holds no date.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from importlib.resources import files

import numpy as np

import core
from app.files.typeset import Face, typeset
from app.plan.drawing import MapDrawing, Scale
from app.plan.ground import GroundMap, draw_benches, draw_ground, draw_grounds, legend_of, scale_for
from app.plan.paper import Paper, PaperName, Title
from app.plan.tables import Json, PlanTable, tables_sheet
from app.plan.timing import TimeFormat, points_of
from core.language import say
from core.values import Floats, Progress

# Most corners of a square and of another thing that stand in a table, and most rows of it.
SQUARE_CORNERS, THING_CORNERS, THINGS_MOST = 16, 6, 100


@dataclass(frozen=True, slots=True)
class Plan:
    """The content of a plan.

    face: of all text; names: of the benches; clock: format of times; title: of the block on every sheet
    times_note: what the times are
    """

    ground: GroundMap
    face: Face
    names: Sequence[str]
    clock: TimeFormat
    title: Title
    paper: PaperName
    budget: core.Budget
    times_note: str


@dataclass(frozen=True, slots=True)
class Together:
    """What stands before the plans of several dragons: one map of all of them, and where each bench is.

    performance: the dances; moments: three times of it [s]; names: of the dragons; clock: format of its times
    title: of the block on these sheets
    """

    performance: core.Performance
    moments: Sequence[float]
    names: Sequence[str]
    clock: TimeFormat
    title: Title


def plan_pdf(
    plans: Sequence[Plan],
    together: Together | None,
    progress: Progress,
) -> bytes:
    """The bytes of the plan of one dragon, or of several together and of each.

    raises: InvalidValue if it is too large for the paper at every scale; Halted once the budget is stopped
    """
    scales, first = [scale_for([plan.ground], plan.paper) for plan in plans], plans[0]
    sheets = [] if together is None else [*_together(plans, together)]
    for k, (plan, scale) in enumerate(zip(plans, scales, strict=True), start=1):
        sheets += [*_maps(plan, scale), _tables(plan, scale.paper)]
        progress(0.5 * k / len(plans))
    template = files("app.plan").joinpath("plan.typ").read_bytes()
    words = {"title": sheets[0]["title"], "paper": first.paper, "sheet": say("sheet")}
    data = typeset(template, first.face, {**words, "sheets": sheets}, first.budget)
    progress(1.0)
    return data


def _map(plan: Plan, title: Title, subtitle: str, drawing: MapDrawing, *shown: bool) -> Json:
    """A sheet with a map. shown: whether benches are on it, and whether several dragons are"""
    ratio, bar = drawing.scale.ratio, drawing.scale.bar
    marks, wide = ["0", f"{0.5 * bar:g}", f"{bar:g} m"], bar * 1000.0 / ratio
    note = say("print at 100 %: this bar is {wide:g} mm long", wide=wide)
    return {
        **title.sheet(subtitle, drawing.scale.paper),
        **drawing.to_json(),
        "bar": {"scale": f"1:{ratio}", "marks": marks, "wide": wide, "note": note},
        "legend": legend_of(drawing, plan.ground, *shown),
        "alt": say("Map, 1:{ratio}", ratio=ratio),
    }


def _tables(plan: Plan, paper: Paper) -> Json:
    """The sheets with tables."""
    block = plan.title.sheet(say("Points to paint, and times"), paper)
    tables = _events(plan), _gates(plan), _benches(plan), _marks(plan), _points(plan), _things(plan)
    return tables_sheet(plan.face, block, tables, _notes(plan))


def _together(plans: Sequence[Plan], together: Together) -> Iterator[Json]:
    """The map of all dragons, and the place of each bench at three moments."""
    grounds, first, title = [plan.ground for plan in plans], plans[0], together.title

    def drawn(benches: list[Floats]) -> MapDrawing:
        shown = np.concatenate(benches) if benches else None
        scale = scale_for(grounds, first.paper, shown)
        return draw_grounds(grounds, together.names, scale, first.face, first.budget)

    yield _map(first, title, say("Plan of the ground"), drawn([]), False, True)
    parts, moments = together.performance.parts, together.moments
    placed = core.trajectory(together.performance, moments, budget=first.budget)
    for t, time in enumerate(moments):
        benches = [
            core.bench_outlines(part.dance.dragon, result.position[t])
            for part, result in zip(parts, placed, strict=True)
        ]
        drawing = drawn(benches)
        for outlines, plan in zip(benches, plans, strict=True):
            draw_benches(drawing, outlines, plan.names, plan.ground.colour)
        yield _map(first, title, _places(together.clock.words(time)), drawing, True, True)


def _places(when: str) -> str:
    return say("Place of each bench at {when}", when=when)


def _maps(plan: Plan, scale: Scale) -> Iterator[Json]:
    """The map of one dragon, and the place of each of its benches at three moments."""
    ground, moments = plan.ground, plan.ground.timing.moments
    drawing = draw_ground(ground, scale, plan.face, plan.budget, numbers=True)
    yield _map(plan, plan.title, say("Plan of the ground"), drawing, False, False)
    for time, handles in zip(moments, core.trajectory(ground.dance, moments).position, strict=True):
        benches = core.bench_outlines(ground.dance.dragon, handles)
        shown = scale_for([ground], plan.paper, benches)
        drawing = draw_ground(ground, shown, plan.face, plan.budget, numbers=False)
        draw_benches(drawing, benches, plan.names)
        yield _map(plan, plan.title, _places(plan.clock.words(time)), drawing, True, False)


def _notes(plan: Plan) -> list[str]:
    """The meaning of the words in the tables."""
    place = f"{plan.ground.timing.start_place:.1f}"
    return [
        say("mark: length along the path from mark 0 [m]"),
        plan.times_note,
        say(
            "enters: the front handle passes {place} m, the place of the head at the start",
            place=place,
        ),
        say("bench columns: place of the front handle along the path"),
        say("–: not during the dance"),
    ]


def _points(plan: Plan) -> PlanTable:
    ground, marks = plan.ground, plan.ground.timing.marks
    spiral = [say("radius [m]"), say("angle [°]")]
    columns = [say("mark [m]"), "x [m]", "y [m]", *spiral]
    rows = [
        [name, *(f"{value:.3f}" for value in values[:3]), *(f"{value:.2f}" for value in values[3:])]
        for name, values in zip(marks.names, points_of(ground.dance, marks), strict=True)
    ]
    return PlanTable(say("Points to paint"), columns[: len(rows[0])], rows)


def _things(plan: Plan) -> PlanTable:
    """Where to measure from: the corners of what has few, and the middles of the rest."""
    rows = list[list[str]]()
    venue = plan.ground.venue
    for area in venue.areas if venue else ():
        most = SQUARE_CORNERS if venue and area is venue.square else THING_CORNERS
        corners = np.array(area.rings[0][:-1])
        middle = 0.5 * (corners.min(axis=0) + corners.max(axis=0))
        for x, y in corners if len(corners) <= most else [middle]:
            rows.append([area.name, f"{x:.3f}", f"{y:.3f}"])
    columns = [say("corner, or middle if round"), "x [m]", "y [m]"]
    return PlanTable(say("Where things stand"), columns, rows[:THINGS_MOST], frozenset({0}))


def _gates(plan: Plan) -> PlanTable:
    words = plan.clock.words
    rows = [[name, f"{s:.1f} m", words(head), words(tail)] for name, s, head, tail in plan.ground.timing.gates]
    columns = [say("gate"), say("along the path"), say("head"), say("tail")]
    return PlanTable(say("Head and tail at the gates"), columns, rows, frozenset({0}))


def _marks(plan: Plan) -> PlanTable:
    timing, words = plan.ground.timing, plan.clock.words
    passed = zip(timing.marks.names, timing.head, timing.tail, strict=True)
    rows = [[name, words(head), words(tail)] for name, head, tail in passed]
    columns = [say("mark [m]"), say("head"), say("tail")]
    return PlanTable(say("Head and tail at the marks"), columns, rows)


def _benches(plan: Plan) -> PlanTable:
    timing, words = plan.ground.timing, plan.clock.words
    moments = (say("at {time}", time=words(one)) for one in timing.moments)
    columns = [say("bench"), say("enters"), *moments]
    rows = [
        [name, words(passes), *(f"{place:.1f}" for place in places)]
        for name, passes, places in zip(plan.names, timing.passes, timing.handles[:, :-1].T.tolist(), strict=True)
    ]
    return PlanTable(say("Front handles of benches [m]"), columns, rows, frozenset({0}))


def _events(plan: Plan) -> PlanTable:
    """A few events of the dance with their times."""
    timing, words = plan.ground.timing, plan.clock.words
    last = timing.handles[-1]
    rows = [
        [say("the dance begins, head at"), f"{timing.start_place:.1f} m", words(timing.moments[0])],
        [say("the tail enters, at"), f"{timing.start_place:.1f} m", words(timing.tail_leaves)],
        *_speeds(plan),
        [say("the dance ends, head at"), f"{last[0]:.1f} m", words(timing.moments[-1])],
        [say("the dance ends, tail at"), f"{last[-1]:.1f} m", words(timing.moments[-1])],
    ]
    columns = [say("event"), say("along the path"), say("time")]
    return PlanTable(say("In short"), columns, rows, frozenset({0}))


def _speeds(plan: Plan) -> Iterator[list[str]]:
    """Times at which the head changes its speed, in a dance with passages."""
    dance, timing = plan.ground.dance, plan.ground.timing
    if not dance.passages:
        return
    first = timing.marks.first
    for one in dance.clock.periods(timing.moments[0], timing.moments[-1]):
        moves = say("from here at {one.speed:g} m/s", one=one)
        words = moves if one.speed else say("a pause begins")
        yield [words, f"{one.first - first:.1f} m", plan.clock.words(one.begin)]
