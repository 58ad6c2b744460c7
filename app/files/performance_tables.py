"""Where the dragons of a performance are as a file: JSON, CSV, Arrow, or a workbook.

Each has what the file of one dragon has (tables.py), and the number of the dragon, in the order of the dances from 0.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from app.files.tables import (
    ARROW_TYPE,
    CSV_TYPE,
    XLSX_DECIMALS,
    XLSX_TYPE,
    arrow_bytes,
    columns_of,
    csv_head,
    csv_lines,
    own_names,
    refuse_large_sheets,
    text_entry,
    trajectory_sheets,
)
from app.files.workbooks import workbook
from app.wire.answers import Columns
from app.wire.question import JSON
from core import Performance, Trajectory


@dataclass(frozen=True, slots=True)
class PerformanceTable:
    """The content of a file.

    results: a trajectory of each dragon at the same times of the performance; decimals: of x, y and speed, as for one
    clock: time of day at time 0 of the performance, see time_of_day()
    """

    performance: Performance
    results: Sequence[Trajectory]
    decimals: int | None = None
    clock: str | None = None

    @property
    def names(self) -> list[tuple[str, ...]]:
        """Names of the benches of each dragon, empty for a dragon without."""
        return [part.dance.dragon.names for part in self.performance.parts]


def performance_json(table: PerformanceTable) -> bytes:
    """JSON: time (T,) [s], and for each dragon its name, x, y (T, H) [m] and speed (T, H) [m/s]."""
    dances = [
        {"name": part.name, "x": result.position[..., 0], "y": result.position[..., 1], "speed": result.speed}
        for part, result in zip(table.performance.parts, table.results, strict=True)
    ]
    return Columns({"time": table.results[0].time, "dances": dances}, table.decimals).to_json()


def performance_csv(table: PerformanceTable) -> Iterator[bytes]:
    """The CSV of each dragon, one after the other, with its number in a column before, and its name if any has one; in
    blocks of lines, each made on demand."""
    parts, benches_have_names = table.performance.parts, any(table.names)
    has_names = any(part.name for part in parts)
    yield b"dragon,dragon_name," if has_names else b"dragon,"
    yield csv_head(table.clock, has_names=benches_have_names)
    for k, (part, names, result) in enumerate(zip(parts, table.names, table.results, strict=True)):
        own = f"{k},".encode() + (text_entry(part.name or "") + b"," if has_names else b"")
        of_handles = own_names(result, own=names) if benches_have_names else ()
        for block in csv_lines(result, table.decimals, table.clock, of_handles):
            yield own + block[:-1].replace(b"\n", b"\n" + own) + b"\n"


def performance_arrow(table: PerformanceTable) -> bytes:
    """Arrow IPC file with the columns of one dragon after that of its number. raises: MissingPackage without pyarrow"""
    parts = [columns_of(result, slice(None), table.decimals) for result in table.results]
    numbers = [np.full(len(part["time"]), k, dtype=np.int32) for k, part in enumerate(parts)]
    together = {name: np.concatenate([part[name] for part in parts]) for name in parts[0]}
    return arrow_bytes({"dragon": np.concatenate(numbers)} | together)


def performance_xlsx(table: PerformanceTable) -> bytes:
    """Workbook with the two sheets of each dragon, whose number their names end in.

    raises: MissingPackage without xlsxwriter, TooLarge when the format has too few rows or columns
    """
    decimals = XLSX_DECIMALS if table.decimals is None else table.decimals
    sheets = []
    for k, (names, result) in enumerate(zip(table.names, table.results, strict=True)):
        refuse_large_sheets(result)
        sheets += [replace(sheet, title=f"{sheet.title} {k}") for sheet in trajectory_sheets(result, names)]
    return workbook(sheets, decimals)


# Function that makes the bytes of a file, whole or in blocks, by its media type.
WRITERS: dict[str, Callable[[PerformanceTable], bytes | Iterator[bytes]]] = {
    JSON: performance_json,
    CSV_TYPE: performance_csv,
    XLSX_TYPE: performance_xlsx,
    ARROW_TYPE: performance_arrow,
}
