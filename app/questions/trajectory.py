"""The question trajectory: positions and speeds of every handle at every instant."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from importlib.util import find_spec
from typing import Annotated

from pydantic import Field

import core
from app.files import tables
from app.wire.dances import TimedDance, clock_of
from app.wire.question import AS_WHOLE, JSON, Answer, Question, Terms, measure


class TrajectoryRequest(TimedDance):
    """Positions and speeds of every handle at every instant."""

    decimals: Annotated[int, Field(ge=0, le=15), AS_WHOLE] | None = Field(
        None, description="Decimals of x, y and speed; default: all, and 6 in a workbook"
    )


class TrajectoryTable(Answer):
    """Columns with one row per instant; a row has one entry per handle, head first (H = benches + 1 entries)."""

    time: list[float] = measure("s", "Instants, T entries")
    x: list[list[float]] = measure("m", "T rows of H entries")
    y: list[list[float]] = measure("m", "T rows of H entries")
    speed: list[list[float]] = measure("m/s", "T rows of H entries")


# Forms of a trajectory: media type -> function of the trajectory and the decimals.
FORMS: dict[str, Callable[[core.Trajectory, int | None], bytes | Iterator[bytes]]] = {
    JSON: tables.trajectory_json,
    tables.CSV_TYPE: tables.csv_blocks,
    tables.XLSX_TYPE: tables.trajectory_xlsx,
}
# Time to compute one cell and to write it, measured 2026-11-22 [s].
SECONDS_PER_CELL = {JSON: 1.5e-7, tables.CSV_TYPE: 1e-6, tables.XLSX_TYPE: 6e-6}
if find_spec("pyarrow"):
    FORMS[tables.ARROW_TYPE] = tables.trajectory_arrow


def trajectory(request: TrajectoryRequest, terms: Terms, form: str = JSON) -> bytes | Iterator[bytes]:
    """Position and speed of every handle at every instant."""
    cells_max = terms.settings.workbook_cells_max if form == tables.XLSX_TYPE else terms.settings.cells_max
    dance = request.to_dance(terms.settings.benches_max)
    result = core.trajectory(dance, request.times_of(dance, cells_max), budget=terms.budget)
    if form == tables.CSV_TYPE:
        return tables.csv_blocks(result, request.decimals, clock_of(request, dance))
    return FORMS[form](result, request.decimals)


def _cost(request: TrajectoryRequest, form: str = JSON) -> float:
    return request.instants() * (request.benches + 1) * SECONDS_PER_CELL.get(form, 1e-7)


QUESTION = Question(trajectory, TrajectoryTable, body=TrajectoryRequest, forms=tuple(FORMS), cost=_cost)
