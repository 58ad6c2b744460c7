"""Pictures of several dragons: all of them at one instant, and the surroundings of an encounter."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import PolyCollection
from matplotlib.figure import Figure
from matplotlib.patches import Polygon

from app.files.drawing import canvas, draw_venue
from app.files.figures import figure_file
from app.files.looks import colour_of
from core import Budget, FirstEncounter, OutsideRun, Performance, bench_outlines, trajectory
from core.display import display
from core.language import say
from core.plots import ENLARGED_MARGINS, ENLARGED_WIDTHS, PALE, SHAPES_MAX, plan
from core.questions import question_about
from core.values import Floats

# Most dragons whose names stand in the legend [1].
LEGEND_MOST = 12
# Time before the end of a performance at which it is drawn if no dragons meet [s].
BEFORE_END = 1e-3


@question_about("performance", Performance, "the figure was not drawn")
def encounter_figure(
    performance: Performance,
    encounter: FirstEncounter | None,
    *,
    time: float | None = None,
    format: str = "svg",
    budget: Budget | None = None,
) -> bytes:
    """All dragons at the time of their encounter, and the two benches that meet enlarged; or at a time [s].

    encounter: may be None if a time is given; without one that meets, they are drawn just before the end of the search
    raises: OutsideRun for a time after a fold
    """
    meets = encounter is not None and encounter.benches is not None
    if time is None:
        time = _time_of(performance, encounter)
    elif time > performance.end.time and performance.end.dragon is not None:
        _refuse(performance, time)
    handles = [trajectory(part.dance, [part.own_time(time)], budget=budget).position[0] for part in performance.parts]
    outlines = [bench_outlines(part.dance.dragon, own) for part, own in zip(performance.parts, handles, strict=True)]
    title = say("At {time}", time=display(time, "s")) if encounter is None else repr(encounter)[1:-1].partition(": ")[2]

    def drawn() -> Figure:
        figure = canvas(11.0 if meets else 7.2, 6.0)
        axes = figure.add_subplot(1, 2, 1) if meets else figure.add_subplot()
        _draw(axes, performance, handles, outlines)
        if meets and encounter is not None:
            near = figure.add_subplot(1, 2, 2)
            _draw_pair(near, encounter, outlines)
            axes.indicate_inset_zoom(near, edgecolor="black", linewidth=0.8)
        figure.suptitle(title, fontsize=11, parse_math=False)
        return figure

    return figure_file(drawn, format, budget)


def _refuse(performance: Performance, time: float) -> None:
    try:
        performance.span(stop=time)
    except OutsideRun as error:
        raise error.with_field("time") from error


def _time_of(performance: Performance, encounter: FirstEncounter | None) -> float:
    """The time of the encounter, else just before the end of the search [s]."""
    if encounter is not None and encounter.time is not None:
        return encounter.time
    if encounter is not None and encounter.time_bracket is not None:
        return encounter.time_bracket[0]
    end = performance.end if encounter is None or encounter.end is None else encounter.end
    return max(end.time - BEFORE_END, performance.begin)


def _draw(axes: Axes, performance: Performance, handles: list[Floats], outlines: list[Floats]) -> None:
    """Every path, pale, every bench in the colour of its dragon, every head as a ring."""
    plan(axes)
    for k, part in enumerate(performance.parts):
        colour = colour_of(performance, k)
        axes.plot(*part.dance.path.drawn(handles[k]).T, color=PALE, linewidth=0.6, zorder=1)
        style: dict[str, Any] = {"facecolor": colour, "edgecolor": "white", "linewidth": 0.2, "zorder": 2}
        axes.add_collection(PolyCollection(list(outlines[k]), rasterized=len(outlines[k]) > SHAPES_MAX, **style))
        axes.plot(
            *handles[k][0], marker="o", markersize=8, markerfacecolor="none", markeredgecolor=colour, linestyle="none",
            zorder=3, label=performance.name_of(k),
        )  # fmt: skip
    draw_venue(axes, performance.venue, handles)
    axes.autoscale_view()
    if 1 < len(performance.parts) <= LEGEND_MOST:
        legend = axes.legend(loc="upper right", fontsize=9, framealpha=0.95)
        for text in legend.get_texts():
            text.set_parse_math(False)


def _draw_pair(axes: Axes, encounter: FirstEncounter, outlines: list[Floats]) -> None:
    """The surroundings of the point where two benches meet, one of them hatched."""
    dragons, benches, point = encounter.dragons, encounter.benches, encounter.point
    assert dragons is not None
    assert benches is not None
    assert point is not None
    plan(axes)
    parts = encounter.performance.parts
    for own in outlines:
        axes.add_collection(PolyCollection(list(own), facecolor="white", edgecolor=PALE, linewidth=0.8, zorder=2))
    for dragon, bench, hatch in zip(dragons, benches, ("", "////"), strict=True):
        label = say("bench {bench} of {dragon}", bench=bench, dragon=encounter.performance.name_of(dragon))
        style: dict[str, Any] = {"facecolor": colour_of(encounter.performance, dragon), "hatch": hatch, "label": label}
        axes.add_patch(
            Polygon(outlines[dragon][bench], edgecolor="black", alpha=0.85, linewidth=0.6, zorder=3, **style)
        )
    dot = {"marker": "o", "markersize": 9, "markerfacecolor": "white", "markeredgecolor": "black", "zorder": 4}
    axes.plot(*point, linestyle="none", label=f"({point[0]:.6f} m, {point[1]:.6f} m)", **dot)  # type: ignore[arg-type]
    width = max(parts[k].dance.dragon.widths[bench] for k, bench in zip(dragons, benches, strict=True))
    half = max(ENLARGED_WIDTHS * float(width), ENLARGED_MARGINS * encounter.margin)
    x, y = np.array(point).tolist()
    axes.set(xlim=(x - half, x + half), ylim=(y - half, y + half))
    for text in axes.legend(loc="upper right", fontsize=9, framealpha=0.95).get_texts():
        text.set_parse_math(False)
