"""The question trajectory: positions and speeds of every handle at every instant."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from importlib.util import find_spec
from typing import Annotated, Any

from pydantic import Field

import core
from app.files import tables
from app.files.performance_tables import WRITERS, PerformanceTable
from app.settings import Settings
from app.wire.dances import DanceFields, TimedDance, TimeRange, clock_of, handles_of
from app.wire.fields import AS_WHOLE, Answer, measure
from app.wire.options import PathOptions
from app.wire.performances import SeveralDances
from app.wire.question import JSON, Command, Output, Question, Terms
from core.language import say


class DanceTrajectory(TimedDance):
    """Positions and speeds of every handle of a dragon at every instant."""

    decimals: Annotated[int, Field(ge=0, le=15), AS_WHOLE] | None = Field(
        None, description="Decimals of x, y and speed; default: all, and 6 in a workbook"
    )


class TrajectoryRequest(SeveralDances, DanceTrajectory):
    """Positions and speeds of every handle at every instant, of one dragon or of several."""


class TrajectoryTable(Answer):
    """Columns with one row per instant; a row has one entry per handle, head first (H = benches + 1 entries).

    time: instants, T entries [s]
    x: t rows of H entries [m]
    y: t rows of H entries [m]
    speed: t rows of H entries [m/s]
    """

    time: list[float]
    x: list[list[float]]
    y: list[list[float]]
    speed: list[list[float]]


class DragonTrajectory(Answer):
    """Positions and speeds of one of several dragons; H is its number of handles.

    name: its name; null without one
    x: t rows of H entries [m]
    y: t rows of H entries [m]
    speed: t rows of H entries; 0 before the dance of this dragon, and after it [m/s]
    """

    name: str | None
    x: list[list[float]]
    y: list[list[float]]
    speed: list[list[float]]


class PerformanceTrajectoryTable(Answer):
    """Tables of several dragons at the same instants.

    time: instants, T entries [s]
    dances: a table for each dragon, in the order of the dances
    """

    time: list[float]
    dances: list[DragonTrajectory]


class TrajectoryOptions(TimeRange, PathOptions):
    """The fields of a trajectory as options."""

    decimals: int | None = Field(
        None,
        ge=0,
        le=15,
        description="Decimals of x, y and speed; default: all (6 for xlsx and for the table on a terminal)",
    )
    times: str | None = measure("s", "Instants such as 0,60,120, instead of --start, --stop and --step", None)


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
ENDINGS = {tables.CSV_TYPE: ".csv", tables.XLSX_TYPE: ".xlsx", tables.ARROW_TYPE: ".arrow", JSON: ".json"}


def trajectory(request: DanceTrajectory, terms: Terms, form: str = JSON) -> bytes | Iterator[bytes]:
    """Position and speed of every handle at every instant."""
    cells_max = terms.settings.workbook_cells_max if form == tables.XLSX_TYPE else terms.settings.cells_max
    dance: core.Dance | core.Performance
    if isinstance(request, TrajectoryRequest) and request.dances is not None:
        dance = request.to_performance(terms.settings)
    else:
        dance = request.to_dance(terms.settings.benches_max)
    results = core.trajectory(dance, request.times_of(dance, cells_max), budget=terms.budget)
    return written(request, dance, results, form, request.decimals)


def written(
    request: DanceFields, dance: core.Dance | core.Performance, results: Any, form: str, decimals: int | None = None
) -> bytes | Iterator[bytes]:
    """The trajectory of a dance, or those of several, as a file, whole or in blocks. request: with its clock"""
    if isinstance(dance, core.Performance):
        return WRITERS[form](PerformanceTable(dance, results, decimals, clock_of(request, dance)))
    if form == tables.CSV_TYPE:
        return tables.csv_blocks(results, decimals, clock_of(request, dance))
    return FORMS[form](results, decimals)


def _cost(request: DanceTrajectory, form: str = JSON) -> float:
    return request.instants() * (request.benches + 1) * SECONDS_PER_CELL.get(form, 1e-7)


def _note(request: TrajectoryRequest, data: bytes) -> str:
    """How many handles and instants a file has."""
    settings = Settings()
    dances = request.to_dance(settings.benches_max) if request.dances is None else request.to_performance(settings)
    instants = len(request.times_of(dances, settings.cells_max))
    return say("{handles} handles at {instants} instants", handles=handles_of(dances), instants=instants)


def _warning(request: TrajectoryRequest) -> str:
    """That instants before the start of a spiral are asked for."""
    settings = Settings()
    if request.dances is not None or request.path.kind != "spiral":
        return ""
    if not (request.times_of(request.to_dance(settings.benches_max), settings.cells_max) < 0.0).any():
        return ""
    return say(
        "Warning: the dance begins at 0 s, and before it the head is on the outward extension of the same spiral; "
        "for the contest's turn give --path turn"
    )


QUESTION = Question(
    trajectory,
    TrajectoryTable,
    body=TrajectoryRequest,
    forms=tuple(FORMS),
    cost=_cost,
    several=PerformanceTrajectoryTable,
    command=Command(
        "Position and speed of every handle; of a FILE of several dragons, of each.",
        lambda request: say("trajectory"),
        options=TrajectoryOptions,
        outputs={
            "output": Output(
                "Write a .csv, .xlsx, .arrow or .json file.",
                {ending: form for form, ending in ENDINGS.items()},
                extras=tables.TABLE_EXTRAS,
                note=_note,
            )
        },
        warning=_warning,
    ),
)
