"""Workbooks: sheets of numbers, with a name for every row and every column.

XlsxWriter writes everything except the numbers: the parts of the file, the number format, widths and frozen panes. The
numbers are most of the work: this module writes their XML row by row instead of cell by cell (benchmarks/workbooks.py).
"""

from __future__ import annotations

import io
import re
import zipfile
from collections.abc import Sequence
from dataclasses import dataclass
from datetime import datetime
from decimal import ROUND_HALF_UP, Decimal
from typing import Any
from unicodedata import east_asian_width
from xml.sax.saxutils import escape

import numpy as np
import orjson

from app.extras import require
from core.values import Floats

# Fixed date in every workbook, so that equal tables have equal bytes.
CREATED = datetime(2024, 9, 5)
# Widths of the columns [characters].
LABEL_WIDTH, NUMBER_WIDTH = 20, 12
# Of a table: by how much a column is wider than its longest cell, for the button of its filter, and the widest column,
# in which longer cells are wrapped [characters].
SPARE, WIDEST = 4, 60
# zlib's fastest level: a fifth of the time for 1.6 MB instead of 1.4 MB (measured 2026-11-22).
QUICKEST = 1
# A scaled number with a fraction this near to one half is rounded in decimal arithmetic, because the scaling may have
# rounded it across the half. A product below 1e11 is off by less than 1e-5.
NEAR_HALF = 1e-4
# Number of the format in the style sheet that XlsxWriter writes for the only format of a workbook.
STYLE = 1
# Empty rows and the range of an empty sheet, as XlsxWriter writes them; they are replaced.
NO_ROWS, RANGE = b"<sheetData/>", re.compile(rb'<dimension ref="[^"]*"/>')


@dataclass(frozen=True)
class Worksheet:
    """title; columns: C names; rows: R names; numbers: (R, C)"""

    title: str
    columns: Sequence[str]
    rows: Sequence[str]
    numbers: Floats


def rounded_away(values: Floats, decimals: int) -> Floats:
    """The values rounded to this number of decimals, halves away from zero as in the contest and in spreadsheets.

    Never -0.0. NumPy rounds halves to even, and takes a value for a half if only its product with 10^decimals is one.

    >>> rounded_away(np.array([0.0078125, -0.0078125, -1e-9]), 6)
    array([ 0.007813, -0.007813,  0.      ])
    """
    scaled = np.abs(values) * 10.0**decimals
    whole = np.floor(scaled + 0.5)
    step = Decimal(1).scaleb(-decimals)
    result: Floats = np.copysign(whole / 10.0**decimals, values)
    for k in np.flatnonzero(np.abs(scaled - np.floor(scaled) - 0.5) < NEAR_HALF):
        result.flat[k] = float(Decimal(float(values.flat[k])).quantize(step, ROUND_HALF_UP))
    return result + 0.0


def workbook(sheets: Sequence[Worksheet], decimals: int) -> bytes:
    """The bytes of an xlsx file; equal sheets give equal bytes.

    decimals: of every number, in its value and in its format
    raises: MissingPackage without xlsxwriter
    """
    require("xlsx", "format", "xlsx")
    names = [f"xl/worksheets/sheet{k}.xml" for k in range(1, len(sheets) + 1)]
    sink = io.BytesIO()
    with (
        zipfile.ZipFile(io.BytesIO(_without_numbers(sheets, decimals))) as empty,
        zipfile.ZipFile(sink, "w", zipfile.ZIP_DEFLATED, compresslevel=QUICKEST) as full,
    ):
        for part in empty.infolist():
            data = empty.read(part)
            if part.filename in names:
                data = _with_cells(data, sheets[names.index(part.filename)], decimals)
            part.compress_type = zipfile.ZIP_DEFLATED
            full.writestr(part, data, compresslevel=QUICKEST)
    return sink.getvalue()


def table_workbook(title: str, columns: Sequence[str], rows: Sequence[Sequence[str | float]]) -> bytes:
    """The bytes of an xlsx file with one sheet of texts and numbers; a text is never a formula.

    columns: C names; rows: each of C cells
    raises: MissingPackage without xlsxwriter
    """
    require("xlsx", "format", "xlsx")
    import xlsxwriter

    sink = io.BytesIO()
    with xlsxwriter.Workbook(sink, {"in_memory": True, "strings_to_formulas": False, "strings_to_urls": False}) as book:
        book.set_properties({"created": CREATED})
        page: Any = book.add_worksheet(title)
        page.freeze_panes(1, 0)
        page.autofilter(0, 0, len(rows), len(columns) - 1)
        wrapped = book.add_format({"text_wrap": True, "valign": "top"})
        for k, row in enumerate([columns, *rows]):
            page.write_row(k, 0, row)
        for k, cells in enumerate(zip(columns, *rows, strict=True)):
            page.set_column(k, k, min(max(map(_width_of, cells)) + SPARE, WIDEST), wrapped)
    return sink.getvalue()


def _width_of(cell: str | float) -> int:
    """Width of a cell [characters]; a Chinese character is as wide as two others."""
    return sum(2 if east_asian_width(letter) in "FW" else 1 for letter in str(cell))


def _without_numbers(sheets: Sequence[Worksheet], decimals: int) -> bytes:
    import xlsxwriter

    sink = io.BytesIO()
    with xlsxwriter.Workbook(sink, {"in_memory": True}) as book:
        book.set_properties({"created": CREATED})
        number = book.add_format({"num_format": "0." + "0" * decimals if decimals else "0"})
        for sheet in sheets:
            page: Any = book.add_worksheet(sheet.title)
            page.freeze_panes(1, 1)
            page.set_column(0, 0, LABEL_WIDTH)
            page.set_column(1, max(len(sheet.columns), 1), NUMBER_WIDTH, number)
    return sink.getvalue()


def _with_cells(page: bytes, sheet: Worksheet, decimals: int) -> bytes:
    """The sheet's XML with its rows."""
    letters = [letters_of(k).encode() for k in range(len(sheet.columns) + 1)]
    rows = [_row(1, letters, [b"", *map(_text, sheet.columns)])]
    numbers = np.ascontiguousarray(rounded_away(sheet.numbers, decimals))
    for k, (label, row) in enumerate(zip(sheet.rows, numbers, strict=True), start=2):
        values = orjson.dumps(row, option=orjson.OPT_SERIALIZE_NUMPY)[1:-1].split(b",")
        rows.append(_row(k, letters, [_text(label), *(b' s="%d"><v>%b</v></c>' % (STYLE, v) for v in values)]))
    page, ranges = RANGE.subn(b'<dimension ref="A1:%b%d"/>' % (letters[-1], len(sheet.rows) + 1), page)
    before, place, after = page.partition(NO_ROWS)
    assert ranges == 1, page[:500]
    assert place == NO_ROWS, page[:500]
    return b"".join([before, b"<sheetData>", *rows, b"</sheetData>", after])


def _text(words: str) -> bytes:
    """XML of a text cell after its address."""
    return f' t="inlineStr"><is><t xml:space="preserve">{escape(words)}</t></is></c>'.encode()


def _row(number: int, letters: Sequence[bytes], cells: Sequence[bytes]) -> bytes:
    """XML of one row; empty cells are left out."""
    place = b"%d" % number
    cells_xml = [b'<c r="%b%b"%b' % (letter, place, cell) for letter, cell in zip(letters, cells, strict=True) if cell]
    return b'<row r="%b">%b</row>' % (place, b"".join(cells_xml))


def letters_of(column: int) -> str:
    """Name of a column, counted from 0.

    >>> [letters_of(k) for k in (0, 25, 26, 301, 701, 702)]
    ['A', 'Z', 'AA', 'KP', 'ZZ', 'AAA']
    """
    name, rest = "", column + 1
    while rest:
        rest, letter = divmod(rest - 1, 26)
        name = chr(ord("A") + letter) + name
    return name
