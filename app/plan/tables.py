"""Tables that flow over columns and sheets."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from app.plan.paper import MARGIN

if TYPE_CHECKING:
    from app.files.typeset import Face

# A sheet as the template takes it: its words, and the names of its pictures.
Json = dict[str, Any]
# Height of a row [mm], type of rows and of headings [pt], space between columns and blocks [mm].
ROW, TYPE, HEADING_TYPE = 4.0, 7.0, 9.0
COLUMN_SPACE, BLOCK_SPACE = 3.0, 7.0
# Space between a table and the frame of its sheet [mm].
PAD = 3.0
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


def tables_sheet(face: Face, block: Mapping[str, Any], tables: Iterable[PlanTable], notes: Sequence[str]) -> Json:
    """Tables side by side, which fill as many sheets as they need. block: of their title; notes: on them, in it"""
    words = [_table(face, one) for one in tables if one.rows]
    room, least = block["width"] - 2.0 * (MARGIN + PAD), max(sum(one["widths"]) for one in words)
    side_by_side = max(1, int((room + BLOCK_SPACE) / (least + BLOCK_SPACE)))
    return {**block, "tables": words, "side_by_side": side_by_side, "notes": notes}


def _table(face: Face, table: PlanTable) -> Json:
    """A table, the width of its columns and the height of a row [mm], None: as its words need."""
    widths = widths_of(face.width, table)
    words = {"heading": table.heading, "columns": table.columns, "rows": table.rows, "left": sorted(table.left)}
    return {**words, "widths": [COLUMN_SPACE + one for one in widths], "row": ROW if max(widths) < WIDEST else None}
