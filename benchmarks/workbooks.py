"""Time to write the contest's result1.xlsx: ours beside XlsxWriter cell by cell, and its mode for constant memory.

python -m benchmarks.workbooks
"""

from __future__ import annotations

import io
import time
from collections.abc import Callable

import xlsxwriter

from app.files.tables import XLSX_DECIMALS, trajectory_sheets
from app.files.workbooks import Worksheet, rounded_away, workbook
from core import Dance, Dragon, Spiral, trajectory
from core.language import speaking

ROUNDS = 2


def cell_by_cell(sheets: list[Worksheet], options: dict[str, bool]) -> bytes:
    """The same workbook, written by XlsxWriter alone."""
    sink = io.BytesIO()
    with xlsxwriter.Workbook(sink, options) as book:
        number = book.add_format({"num_format": "0." + "0" * XLSX_DECIMALS})
        for sheet in sheets:
            page = book.add_worksheet(sheet.title)
            page.freeze_panes(1, 1)
            page.set_column(1, len(sheet.columns), 12, number)
            page.write_row(0, 1, sheet.columns)
            rows = rounded_away(sheet.numbers, XLSX_DECIMALS).tolist()
            for k, (label, row) in enumerate(zip(sheet.rows, rows, strict=True), start=1):
                page.write_string(k, 0, label)
                for column, value in enumerate(row, start=1):
                    page.write_number(k, column, value, number)
    return sink.getvalue()


def main() -> None:
    with speaking("zh"):
        sheets = trajectory_sheets(trajectory(Dance(Dragon(), Spiral()), range(301)))
    ways: dict[str, Callable[[], bytes]] = {
        "ours": lambda: workbook(sheets, XLSX_DECIMALS),
        "XlsxWriter in memory": lambda: cell_by_cell(sheets, {"in_memory": True}),
        "XlsxWriter constant_memory": lambda: cell_by_cell(sheets, {"constant_memory": True}),
    }
    best = dict.fromkeys(ways, float("inf"))
    for _ in range(ROUNDS):
        for name, write in ways.items():
            begun = time.process_time()
            write()
            best[name] = min(best[name], time.process_time() - begun)
    for name, seconds in best.items():
        print(f"{name:28} {seconds:6.3f} s of CPU, {seconds / best['ours']:5.1f} x ours")


if __name__ == "__main__":
    main()
