"""A trajectory as a file: JSON, CSV, Arrow, or a workbook laid out like the contest's result1.xlsx.

The same trajectory gives the same bytes, so an answer may carry a strong ETag.
"""

from __future__ import annotations

import io
from collections.abc import Iterator, Sequence

import numpy as np
import orjson

from app.extras import require
from app.files.workbooks import Worksheet, workbook
from app.wire.answers import Columns
from app.wire.clocks import time_of_day
from app.wire.texts import text_to_cell
from core import TooLarge, Trajectory
from core.language import say, sense
from core.values import Floats

# Optional part of the program that a file with this ending needs.
TABLE_EXTRAS = {".xlsx": "xlsx", ".arrow": "arrow"}
COLUMNS = ("time", "handle", "x", "y", "speed")
# Handles in the tables that the contest requires, beside the rear one of the tail.
PAPER_HANDLES = (0, 1, 51, 101, 151, 201)
# Further columns, if benches have names or if the time of day at time 0 is given.
NAME, CLOCK = "name", "clock"
CSV_TYPE = "text/csv"
# Cells that become lines of CSV in one block: 2 MB of text, and 10 MB of memory in between.
CSV_BLOCK = 20_000
XLSX_TYPE = "application/vnd.openxmlformats-officedocument.spreadsheetml.sheet"
ARROW_TYPE = "application/vnd.apache.arrow.file"
PARQUET_TYPE = "application/vnd.apache.parquet"

# Decimals that the contest requires.
XLSX_DECIMALS = 6
# Limits of the format; the first row and column hold names.
XLSX_ROWS_MAX = 1_048_576
XLSX_COLUMNS_MAX = 16_384


def handle_names(benches: int) -> list[str]:
    """Name of every handle: that of the bench behind it; the last handle is at the rear of the tail.

    returns: benches + 1 names; a single bench is the head

    >>> handle_names(4)
    ['head', 'body 1', 'body 2', 'tail', 'tail (rear)']
    """
    name = say("body {k}")
    body = [name.format(k=k) for k in range(1, benches - 1)]
    head, tail, rear = say("head"), say("tail"), say("tail (rear)")
    return [head, *body, tail, rear] if benches > 1 else [head, rear]


def handle_titles(benches: int) -> list[str]:
    """Name of every handle beside a drawing or in a sentence: in Chinese it says which handle of the bench it is.

    >>> handle_titles(3)
    ['head', 'body 1', 'tail', 'tail (rear)']
    """
    names = handle_names(benches)
    front, rear = sense("handle", "{bench}"), sense("handle", "{bench} (rear)")
    last = names[-2] if benches > 1 else names[0]
    return [*(front.format(bench=name) for name in names[:-1]), rear.format(bench=last)]


def own_names(result: Trajectory, own: Sequence[str] | None = None) -> list[str]:
    """Name of every handle: the name that its bench was given, else that of handle_names().

    own: names of the benches, empty without; None: those of the dance of the result
    """
    names = handle_names(result.speed.shape[-1] - 1)
    if own is None:
        own = result.dance.dragon.names if result.dance else ()
    own_of_handles = [*own, say("{name} (rear)", name=own[-1]) if own and own[-1] else ""]
    return [name or known for name, known in zip(own_of_handles, names, strict=True)] if own else names


def _rounded(column: Floats, decimals: int | None) -> Floats:
    # Adding zero turns a rounded -0.0 into 0.0.
    return column if decimals is None else np.round(column, decimals) + 0.0


def columns_of(result: Trajectory, rows: slice, decimals: int | None) -> dict[str, np.ndarray]:
    """time, handle, x, y, speed of some instants, each (T * H,): instants in order, handles in order within each."""
    position, speed = result.position[rows], result.speed[rows]
    instants, handles = speed.shape
    values = (
        np.repeat(result.time[rows], handles),
        np.tile(np.arange(handles, dtype=np.int32), instants),
        _rounded(position[..., 0].ravel(), decimals),
        _rounded(position[..., 1].ravel(), decimals),
        _rounded(speed.ravel(), decimals),
    )
    return dict(zip(COLUMNS, values, strict=True))


def trajectory_json(result: Trajectory, decimals: int | None = None) -> bytes:
    """JSON columns time (T,) [s]; x, y (T, H) [m]; speed (T, H) [m/s]."""
    x, y = result.position[..., 0], result.position[..., 1]
    return Columns({"time": result.time, "x": x, "y": y, "speed": result.speed}, decimals).to_json()


def csv_blocks(result: Trajectory, decimals: int | None = None, start_clock: str | None = None) -> Iterator[bytes]:
    """CSV with the columns time [s], handle, x [m], y [m], speed [m/s], and name and clock if they are known; in blocks
    of lines, each made on demand.

    decimals: of x, y and speed; None writes the shortest text that reads back as the same double
    start_clock: time of day at time 0, see time_of_day()
    """
    has_names = bool(result.dance and result.dance.dragon.names)
    yield csv_head(start_clock, has_names=has_names)
    yield from csv_lines(result, decimals, start_clock, own_names(result) if has_names else ())


def csv_head(start_clock: str | None, *, has_names: bool) -> bytes:
    """The first line of the CSV: the names of its columns."""
    added = [column for column, known in ((NAME, has_names), (CLOCK, start_clock)) if known]
    return ",".join([*COLUMNS, *added]).encode() + b"\n"


def csv_lines(
    result: Trajectory, decimals: int | None, start_clock: str | None, names: Sequence[str]
) -> Iterator[bytes]:
    """The other lines of the CSV in blocks. names: of the handles, for a column of their own; empty: without it"""
    instants, handles = result.speed.shape
    entries = [text_entry(name) for name in names]
    rows = max(CSV_BLOCK // handles, 1)
    for first in range(0, instants, rows):
        columns = [
            orjson.dumps(np.ascontiguousarray(column), option=orjson.OPT_SERIALIZE_NUMPY)[1:-1].split(b",")
            for column in columns_of(result, slice(first, first + rows), decimals).values()
        ]
        times = result.time[first : first + rows].tolist()
        if entries:
            columns.append(entries * len(times))
        if start_clock:
            columns.append([word for time in times for word in [time_of_day(time, start_clock).encode()] * handles])
        yield b"\n".join(map(b",".join, zip(*columns, strict=True))) + b"\n"


def text_entry(text: str) -> bytes:
    """Text as an entry of CSV."""
    text = text_to_cell(text)
    return ('"' + text.replace('"', '""') + '"' if set(text) & {",", '"'} else text).encode()


def trajectory_arrow(result: Trajectory, decimals: int | None = None) -> bytes:
    """Arrow IPC file with the columns of the CSV.

    raises: MissingPackage without pyarrow
    """
    return arrow_bytes(columns_of(result, slice(None), decimals))


def arrow_bytes(columns: dict[str, np.ndarray]) -> bytes:
    """Arrow IPC file with these columns. raises: MissingPackage without pyarrow"""
    require("arrow", "format", "Arrow")
    import pyarrow

    table = pyarrow.table(columns)
    sink = io.BytesIO()
    with pyarrow.ipc.new_file(sink, table.schema) as writer:
        writer.write_table(table)
    return sink.getvalue()


def trajectory_xlsx(result: Trajectory, decimals: int | None = None) -> bytes:
    """Workbook with a sheet of positions and a sheet of speeds: handles as rows, instants as columns.

    Positions have two rows for each handle, x above y.
    decimals: None gives XLSX_DECIMALS
    raises: MissingPackage without xlsxwriter, TooLarge when the format has too few rows or columns
    """
    refuse_large_sheets(result)
    return workbook(trajectory_sheets(result), XLSX_DECIMALS if decimals is None else decimals)


def refuse_large_sheets(result: Trajectory) -> None:
    """raises: TooLarge for a trajectory that has more rows or columns than a sheet may have"""
    instants, handles = result.speed.shape
    if 2 * handles + 1 > XLSX_ROWS_MAX or instants + 1 > XLSX_COLUMNS_MAX:
        words, got = "xlsx holds at most {handles} handles and {instants} instants", f"{handles} and {instants}"
        most = {"handles": (XLSX_ROWS_MAX - 1) // 2, "instants": XLSX_COLUMNS_MAX - 1}
        raise TooLarge.in_words("format", words, got=got, reason="ask for csv", **most)


def trajectory_sheets(result: Trajectory, own: Sequence[str] | None = None) -> list[Worksheet]:
    """Positions, with two rows for each handle, x above y, and speeds: handles as rows, instants as columns.

    own: as for own_names()
    """
    instants, handles = result.speed.shape
    names = own_names(result, own)
    times = [f"{instant:.12g} s" for instant in result.time.tolist()]
    positions = result.position.transpose(1, 2, 0).reshape(2 * handles, instants)
    place, speed = say("{name} {axis} (m)"), say("{name} (m/s)")
    axes = [place.format(name=name, axis=axis) for name in names for axis in "xy"]
    # The contest's own workbooks have one blank after the head and the rear of the tail.
    ends = (names[0], names[-1])
    speeds = [f"{name} (m/s)" if name in ends else speed.format(name=name) for name in names]
    return [
        Worksheet(say("positions"), times, axes, positions),
        Worksheet(say("speeds"), times, speeds, result.speed.T),
    ]


def instant_sheet(result: Trajectory) -> Worksheet:
    """A row for each handle at the only instant of a trajectory: x, y and speed."""
    handles = result.speed.shape[-1]
    columns = [say("x (m)"), say("y (m)"), say("speed (m/s)")]
    numbers = np.column_stack([result.position.reshape(handles, 2), result.speed.reshape(handles)])
    return Worksheet("Sheet1", columns, own_names(result), numbers)
