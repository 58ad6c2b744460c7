"""The plan of a dance as PDF: the map true to scale, the benches at three moments, the points to paint, the times.

The same dance gives the same bytes on the same versions of the libraries, because the file holds no date.
"""

from __future__ import annotations

import io
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import matplotlib
from matplotlib.backends.backend_pdf import PdfPages

import core
from app.files.drawing import in_turn
from app.files.performances import colour_of
from app.plan.ground import GroundMap, draw_benches, draw_ground, draw_grounds, draw_legend, scale_for
from app.plan.sheet import BLOCK, MARGIN, Paper, PaperName, Scale, Sheet, Title, title_block
from app.plan.tables import PlanTable, draw_tables
from app.plan.timing import TimeFormat, points_of
from core.language import say

# Fonts as outlines of TrueType: every machine and every printer draws them alike, and the text can be searched.
FONTS: dict[Any, Any] = {"pdf.fonttype": 42, "hatch.linewidth": 0.4}


@dataclass(frozen=True, slots=True)
class Plan:
    """The content of a plan.

    family: fonts; names: of the benches; clock: format of times; title: of the block on every sheet
    times_note: what the times are
    """

    ground: GroundMap
    family: tuple[str, ...]
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


@dataclass(frozen=True, slots=True)
class _Page:
    """A sheet of a plan, its title and subtitle, the scale of its map (None: a sheet of tables), whether benches stand
    on it, and whether it shows several dragons."""

    plan: Plan
    title: Title
    sheet: Sheet
    subtitle: str
    scale: Scale | None = None
    benches: bool = False
    several: bool = False


def plan_pdf(
    plans: Sequence[Plan],
    together: Together | None,
    progress: Callable[[float], None] = lambda share: None,
) -> bytes:
    """The bytes of the plan of one dragon, or of several together and of each.

    raises: InvalidValue if it is too large for the paper at every scale; Halted once the budget is stopped
    """
    scales = [scale_for([plan.ground], plan.paper) for plan in plans]
    sink = io.BytesIO()

    def drawn() -> bytes:
        with matplotlib.rc_context({"font.family": plans[0].family, **FONTS}):
            pages = [] if together is None else [*_together(plans, together)]
            for plan, scale in zip(plans, scales, strict=True):
                pages += [*_maps(plan, scale), *_tables(plan, scale.paper)]
            metadata = {"Title": pages[0].title.title, "Creator": "Bench Dragon", "CreationDate": None}
            with PdfPages(sink, metadata=metadata) as file:
                for k, page in enumerate(pages, start=1):
                    cell = title_block(page.sheet, page.title, page.subtitle, f"{k}/{len(pages)}", page.scale)
                    if page.scale is not None:
                        look = {"benches": page.benches, "several": page.several}
                        draw_legend(page.sheet, page.plan.ground, *cell, MARGIN, **look)
                    else:
                        _notes(page.sheet, page.plan, *cell)
                    file.savefig(page.sheet.figure)
                    progress(k / len(pages))
        return sink.getvalue()

    return in_turn(drawn, plans[0].budget)


def _together(plans: Sequence[Plan], together: Together) -> Iterator[_Page]:
    """The map of all dragons, and the place of each bench at three moments."""
    grounds, first = [plan.ground for plan in plans], plans[0]
    scale = scale_for(grounds, first.paper)
    sheet = Sheet(scale.paper, first.family, first.budget)
    draw_grounds(sheet, grounds, together.names, scale)
    yield _Page(first, together.title, sheet, say("Plan of the ground"), scale, several=True)
    parts, moments = together.performance.parts, together.moments
    placed = core.performance_trajectory(together.performance, moments, budget=first.budget)
    for t, time in enumerate(moments):
        sheet = Sheet(scale.paper, first.family, first.budget)
        frame = draw_grounds(sheet, grounds, together.names, scale)
        for k, (part, result, plan) in enumerate(zip(parts, placed, plans, strict=True)):
            outlines = core.bench_outlines(part.dance.dragon, result.position[t])
            draw_benches(sheet, scale, outlines, plan.names, frame, colour_of(k))
        yield _Page(first, together.title, sheet, _places(together.clock.words(time)), scale, True, True)


def _places(when: str) -> str:
    return say("Place of each bench at {when}", when=when)


def _maps(plan: Plan, scale: Scale) -> Iterator[_Page]:
    ground, timing = plan.ground, plan.ground.timing
    sheet = Sheet(scale.paper, plan.family, plan.budget)
    draw_ground(sheet, ground, scale, numbers=True)
    yield _Page(plan, plan.title, sheet, say("Plan of the ground"), scale)
    dance = ground.dance
    for time, handles in zip(timing.moments, core.trajectory(dance, timing.moments).position, strict=True):
        sheet = Sheet(scale.paper, plan.family, plan.budget)
        frame = draw_ground(sheet, ground, scale, numbers=False)
        draw_benches(sheet, scale, core.bench_outlines(dance.dragon, handles), plan.names, frame)
        yield _Page(plan, plan.title, sheet, _places(plan.clock.words(time)), scale, True)


def _tables(plan: Plan, paper: Paper) -> Iterator[_Page]:
    tables = [_events(plan), _gates(plan), _benches(plan), _marks(plan), _points(plan)]
    for sheet in draw_tables(tables, lambda: Sheet(paper, plan.family, plan.budget)):
        sheet.frame(paper.room)
        yield _Page(plan, plan.title, sheet, say("Points to paint, and times"))


def _notes(sheet: Sheet, plan: Plan, left: float, right: float) -> None:
    """Write the meaning of the words in the tables."""
    place = f"{plan.ground.timing.start_place:.1f}"
    lines = [
        say("mark: length along the path from mark 0 [m]"),
        plan.times_note,
        say(
            "enters: the front handle passes {place} m, the place of the head at the start",
            place=place,
        ),
        say("bench columns: place of the front handle along the path"),
        say("–: not during the dance"),
    ]
    for k, line in enumerate(lines):
        sheet.words(left + 2.0, MARGIN + BLOCK - 5.0 - 4.3 * k, line, 6.5, within=right - left - 4.0)


def _points(plan: Plan) -> PlanTable:
    ground, marks = plan.ground, plan.ground.timing.marks
    spiral = [say("radius [m]"), say("angle [°]")]
    columns = [say("mark [m]"), "x [m]", "y [m]", *spiral]
    rows = [
        [name, *(f"{value:.3f}" for value in values[:3]), *(f"{value:.2f}" for value in values[3:])]
        for name, values in zip(marks.names, points_of(ground.dance, marks), strict=True)
    ]
    return PlanTable(say("Points to paint"), columns[: len(rows[0])], rows)


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
