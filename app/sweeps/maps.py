"""Maps of a sweep: one value against one or two parameters."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from app.files.drawing import canvas
from app.sweeps.spec import Range
from app.sweeps.table import Sweep, numbers_of
from core import InvalidValue
from core.plots import BLUE, GREY
from core.values import Floats

WIDTH, HEIGHT = 7.5, 5.5  # [inch]
LEVELS = 10
# Fewest points with contours.
CONTOUR_MIN = 3
# Size of the dots of sampled designs [points^2].
DOT = 9.0


def value_map(sweep: Sweep, value: str) -> Figure:
    """A value against the parameters: a line or dots for one, a heat map with contours for two.

    A design without the value stays blank.
    raises: InvalidValue if there is no row, no such column of numbers, or more than two parameters
    """
    spec, names = sweep.spec, list(sweep.spec.over)
    if len(names) > 2:
        words = "a map has one or two parameters, and this sweep has {count}"
        raise InvalidValue.in_words("output", words, count=len(names))
    table = sweep.table(["design", *names, value])
    numbers = numbers_of(sweep, table, value)
    places = [numbers_of(sweep, table, name) for name in names]
    figure = canvas(WIDTH, HEIGHT)
    axes = figure.add_subplot()
    if len(names) == 1:
        order = np.argsort(places[0], kind="stable")
        axes.plot(
            places[0][order], numbers[order], "." if spec.sampled else ".-", color=BLUE, markersize=3, linewidth=1
        )
        axes.set_ylabel(value)
    else:
        gridded = not spec.sampled
        draw = _draw_grid if gridded else _draw_samples
        mesh = draw(sweep, axes, table["design"].to_numpy(), places, numbers)
        figure.colorbar(mesh, ax=axes, label=value)
        axes.set_ylabel(names[1])
        _scale(axes.set_yscale, spec.over[names[1]])
    axes.set_xlabel(names[0])
    _scale(axes.set_xscale, spec.over[names[0]])
    axes.set_title(f"{value} of {spec.question}", fontsize=11)
    return figure


def _scale(setter: Any, axis: Range | list[Any]) -> None:
    if isinstance(axis, Range) and axis.scale == "log":
        setter("log")


def _draw_grid(sweep: Sweep, axes: Axes, design: Any, places: list[Floats], numbers: Floats) -> Any:
    columns, rows = sweep.spec.counts.values()
    grid = np.full((columns, rows), np.nan)
    grid.flat[design] = numbers
    x, y = (_axis_values(axis) for axis in sweep.spec.over.values())
    by_x, by_y = np.argsort(x), np.argsort(y)
    x, y, grid = x[by_x], y[by_y], grid[np.ix_(by_x, by_y)].T
    mesh = axes.pcolormesh(x, y, grid, cmap="cividis", shading="nearest", rasterized=True)
    if min(grid.shape) >= CONTOUR_MIN and _varies(numbers):
        lines = axes.contour(x, y, np.ma.masked_invalid(grid), LEVELS, colors="white", linewidths=0.6)
        axes.clabel(lines, fontsize=7)
    return mesh


def _draw_samples(sweep: Sweep, axes: Axes, design: Any, places: list[Floats], numbers: Floats) -> Any:
    finite = np.isfinite(numbers)
    x, y = (place[finite] for place in places)
    axes.plot(*(place[~finite] for place in places), "x", color=GREY, markersize=3)
    # Contours between samples need triangles with an area.
    if len(sweep.spec.sampled) == 2 and finite.sum() >= CONTOUR_MIN and _varies(numbers):
        axes.tricontour(x, y, numbers[finite], LEVELS, colors=GREY, linewidths=0.6)
    return axes.scatter(x, y, c=numbers[finite], s=DOT, cmap="cividis")


def _varies(numbers: Floats) -> bool:
    finite = numbers[np.isfinite(numbers)]
    return finite.size > 0 and bool(finite.min() < finite.max())


def _axis_values(axis: Range | list[Any]) -> Floats:
    return np.array(axis.grid() if isinstance(axis, Range) else axis, dtype=np.float64)
