"""Tables that flow over columns and sheets."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from app.plan.sheet import Sheet

# Height of a row and of a heading [mm], type of rows and of headings [pt], space between columns and blocks [mm].
ROW, HEADING = 4.0, 7.0
TYPE, HEADING_TYPE = 7.0, 9.0
COLUMN_SPACE, BLOCK_SPACE = 3.0, 7.0
# Least number of rows that must fit where a table begins.
ROWS_LEAST = 4
# Longest entry [mm]; a longer one is set smaller.
WIDEST = 45.0


@dataclass(frozen=True, slots=True)
class PlanTable:
    """A table: heading, names of the columns, rows of text. A column of words is aligned left, one of numbers right."""

    heading: str
    columns: Sequence[str]
    rows: Sequence[Sequence[str]]
    left: frozenset[int] = frozenset()


def widths_of(width: Callable[[str, float, bool], float], table: PlanTable) -> list[float]:
    """Width of each column [mm]. width: of a text, in type of a size [pt], and bold or not"""
    heads = [width(word, TYPE, True) for word in table.columns]
    widest = [max(width(word, TYPE, False) for word in set(column)) for column in zip(*table.rows, strict=True)]
    widths = [min(WIDEST, max(pair)) for pair in zip(heads, widest, strict=True)]
    wide = sum(widths) + COLUMN_SPACE * (len(widths) - 1)
    # A heading that is wider than all columns together makes them wider.
    more = max(0.0, width(table.heading, HEADING_TYPE, True) - wide)
    return [width + more / len(widths) for width in widths]


def draw_tables(tables: Sequence[PlanTable], new_sheet: Callable[[], Sheet]) -> list[Sheet]:
    """Draw tables in order, in blocks side by side, on as many sheets as they need."""
    sheets = [new_sheet()]
    room = sheets[0].paper.room
    left, bottom, most, top = room[0] + 3.0, room[1] + 3.0, room[2] - 3.0, room[3] - 3.0
    x, y, right = left, top, left
    for table in tables:
        if not table.rows:
            continue
        done, widths = 0, widths_of(sheets[0].width, table)
        wide = sum(widths) + COLUMN_SPACE * (len(widths) - 1)
        while done < len(table.rows):
            fits = int((y - bottom - HEADING - ROW) / ROW)
            if fits < min(ROWS_LEAST, len(table.rows) - done) or x + wide > most + 0.01:
                if y == top and x == left:
                    fits = max(1, fits)  # A table wider than a sheet fits on no new sheet either.
                else:
                    x, y = right + BLOCK_SPACE, top
                    if x + wide > most:
                        sheets.append(new_sheet())
                        x, y, right = left, top, left
                    continue
            left_over = len(table.rows) - done - fits
            if 0 < left_over < ROWS_LEAST < fits:  # Avoid a block of only a row or two.
                fits -= ROWS_LEAST
            some = table.rows[done : done + fits]
            y = _draw_block(sheets[-1], table, some, widths, (x, y))
            done, right = done + len(some), max(right, x + wide)
    return sheets


def _draw_block(
    sheet: Sheet, table: PlanTable, rows: Sequence[Sequence[str]], widths: Sequence[float], at: tuple[float, float]
) -> float:
    """Draw some rows of a table below and right of a corner; returns where the next block may begin."""
    x, y = at
    wide = sum(widths) + COLUMN_SPACE * (len(widths) - 1)
    sheet.words(x, y - 4.5, table.heading, HEADING_TYPE, within=wide, fontweight="bold")
    y -= HEADING + ROW
    for k, row in enumerate([table.columns, *rows]):
        if k % 2 == 0 and k:
            corners = [(x - 1.0, y - 1.1), (x + wide + 1.0, y - 1.1), (x + wide + 1.0, y + 2.9), (x - 1.0, y + 2.9)]
            sheet.shape(np.array(corners), facecolor="#F2F2F2", linewidth=0.0, zorder=0)
        place = x
        for column, (word, width) in enumerate(zip(row, widths, strict=True)):
            size, bold = TYPE, k == 0
            if (long := sheet.width(word, size, bold)) > width:
                size, long = size * width / long, width
            sheet.entry(place if column in table.left else place + width - long, y, word, size, bold=bold)
            place += width + COLUMN_SPACE
        if k == 0:
            sheet.line([(x - 1.0, y - 1.1), (x + wide + 1.0, y - 1.1)], linewidth=0.5)
        y -= ROW
    return y - 2.0
