"""Workbooks (.xlsx) as plain grids of cells, read by openpyxl after each part of the file was checked.

Nothing in a file is run or followed: macros and links are ignored, and a formula counts with its stored value. First
each part is unpacked in pieces, up to the limit, and must be as long as the directory says, because openpyxl trusts the
directory. Meanwhile the part is read for things that openpyxl does not report: document types, formulas, merged cells,
and more elements, or longer tags and rows, than fit into memory. A stopped budget ends the reading at the next piece,
the next access to the file, or between two rows.

A result1 takes 0.9 s, of which that first reading takes 0.2 s. calamine would take 0.1 s, but a cell in the last corner
of a sheet makes it allocate 550 GB, which ends the process (python-calamine 0.9.1; all measured 2026-11-22).
"""

from __future__ import annotations

import io
import re
import sys
import warnings
import zipfile
from collections.abc import Iterator
from contextlib import closing
from typing import TYPE_CHECKING, Any
from xml.parsers import expat

from app.extras import require
from app.files.archives import BadArchive, opened, pieces_of
from app.files.markup import TAG_MAX, LongTag, new_parser, parse
from app.grade.grid import Cell, Grid, UnreadableTable
from app.grade.words import Note, note
from core import Budget
from core.kernels import Halted

if TYPE_CHECKING:
    from openpyxl.workbook.workbook import Workbook

# Largest size of all unpacked parts of a file together [bytes], and largest number of parts.
UNPACKED_MAX, PARTS_MAX = 100_000_000, 500
# Most elements of all parts: result1 has 410,000. openpyxl keeps those of a row in memory, 300 bytes for each (measured
# 2026-11-22).
ELEMENTS_MAX = 2_000_000
# Largest sheet of a workbook: result1 has 449 x 302 cells, in either orientation, and 67,425 rows as a list; and the
# number of sheets.
ROWS_MAX, COLUMNS_MAX, SHEETS_MAX = 70_000, 1_000, 20
# Most cells of all sheets, with the blanks before the last one of each row: a list of result1 has 337,120.
CELLS_MAX = 2_000_000
# Parts by which the files of other programs are known.
PROGRAMS = {"META-INF/manifest.xml": "LibreOffice (.ods)", "Index/Document.iwa": "Numbers"}
MAIN, MACROS = "xl/workbook.xml", "xl/vbaProject.bin"
# Names of elements of a sheet, and the beginning of all names in Strict Open XML, which openpyxl cannot read.
ROW, CELL, FORMULA, VALUE, MERGED = (
    "http://schemas.openxmlformats.org/spreadsheetml/2006/main}" + name for name in ("row", "c", "f", "v", "mergeCell")
)
STRICT = "http://purl.oclc.org/ooxml/"
# The decimals that a number format shows, as in 0.00.
DECIMALS_SHOWN = re.compile(r"0\.(0+)")
# Most cells of a row in any spreadsheet program; openpyxl keeps those of a row in memory.
ROW_CELLS_MAX = 16_384


class _Watched(io.BytesIO):
    """Bytes whose reading ends when a budget is stopped."""

    def __init__(self, data: bytes, budget: Budget) -> None:
        super().__init__(data)
        self.budget = budget

    def read(self, size: int | None = -1) -> bytes:
        self.budget.look()
        return super().read(size)


def sheets_of(data: bytes, budget: Budget) -> tuple[list[Grid], list[Note]]:
    """The sheets of a workbook, and notes on the whole file.

    raises: UnreadableTable; MissingPackage without openpyxl; Halted when the budget ends
    """
    require("xlsx", "file", "A workbook")
    from openpyxl import load_workbook

    source = _Watched(data, budget)
    try:
        with opened(data, PARTS_MAX) as archive:
            notes = _refuse_traps(archive, budget)
        with warnings.catch_warnings():
            # openpyxl warns of things that it leaves out: styles, extensions, invalid dates.
            warnings.simplefilter("ignore")
            with closing(load_workbook(source, read_only=True, data_only=True, keep_links=False)) as book:
                return _sheets(book, budget), notes
    except (UnreadableTable, Halted, MemoryError):
        raise
    except BadArchive as error:
        raise UnreadableTable(_reason(error)) from error
    except Exception as error:  # openpyxl raises many kinds of errors for missing or invalid parts.
        raise UnreadableTable(note("broken", why=f"{type(error).__name__}: {error}"[:120])) from error


def _reason(error: BadArchive) -> Note:
    if error.code == "encrypted":
        return note("encrypted")
    if error.code == "method":
        return note("broken", why="a part is neither stored nor deflated")
    if error.code in ("bomb", "parts"):
        return note("bomb", most=f"{UNPACKED_MAX / 1e6:.0f}", parts=PARTS_MAX)
    return note("truncated")


def _refuse_traps(archive: zipfile.ZipFile, budget: Budget) -> list[Note]:
    """Notes on macros, formulas, merged cells.

    raises: UnreadableTable, BadArchive for an archive that is harmful or no workbook
    """
    parts, names = archive.infolist(), archive.namelist()
    if MAIN not in names:
        program = next((program for part, program in PROGRAMS.items() if part in names), None)
        raise UnreadableTable(note("other_program", program=program) if program else note("other_archive"))
    notes, elements, unpacked = [note("macros")] if MACROS in names else [], 0, 0

    def unpacking(part: zipfile.ZipInfo) -> Iterator[bytes]:
        nonlocal unpacked
        for piece in pieces_of(archive, part, UNPACKED_MAX - unpacked):
            budget.look()
            unpacked += len(piece)
            yield piece

    for part in parts:
        pieces = unpacking(part)
        remarks, more = _survey(part.filename, pieces, ELEMENTS_MAX - elements)
        notes, elements = notes + remarks, elements + more
        for _ in pieces:
            pass  # A part that is not XML, such as a picture, counts too.
    return notes


def _survey(part: str, pieces: Iterator[bytes], most: int) -> tuple[list[Note], int]:
    """Notes on formulas and merged cells of a part, and the number of its elements.

    raises: UnreadableTable for a declared document type, a long tag, and more elements than `most`
    """
    elements, cell, in_row = 0, "", 0
    seen: dict[str, list[str]] = {"formulas": [], "unstored": [], "merged": []}

    def refuse(*_: object) -> None:
        raise UnreadableTable(note("declared", part=part))

    def start(tag: str, attributes: dict[str, str]) -> None:
        nonlocal elements, cell, in_row
        elements += 1
        if elements > most:
            raise UnreadableTable(note("too_many_elements", most=f"{ELEMENTS_MAX:,}"))
        if tag == CELL:
            cell, in_row = attributes.get("r", ""), in_row + 1
            if in_row > ROW_CELLS_MAX:
                raise UnreadableTable(note("long_row", part=part, most=f"{ROW_CELLS_MAX:,}"))
        elif tag == ROW:
            in_row = 0
        elif tag == FORMULA:
            seen["unstored"].append(cell)
        elif tag == VALUE and seen["unstored"][-1:] == [cell]:
            parser.CharacterDataHandler = stored
        elif tag == MERGED:
            seen["merged"].append(attributes.get("ref", ""))
        elif part == MAIN and tag.startswith(STRICT):
            raise UnreadableTable(note("strict"))

    def stored(_: str) -> None:
        seen["formulas"].append(seen["unstored"].pop())
        parser.CharacterDataHandler = None

    def end(tag: str) -> None:
        if tag == VALUE:
            parser.CharacterDataHandler = None

    parser = new_parser(refuse, "}")
    parser.StartElementHandler, parser.EndElementHandler = start, end
    try:
        parse(parser, pieces)
    except expat.ExpatError:
        pass  # For example a picture. openpyxl itself refuses broken parts that it needs.
    except LongTag as error:
        raise UnreadableTable(note("long_tag", part=part, most=f"{TAG_MAX:,}")) from error
    except (LookupError, ValueError) as error:  # an encoding other than Unicode
        raise UnreadableTable(note("broken", why=f"{part}: {error}"[:120])) from error
    return [note(what, count=len(cells), cell=cells[0]) for what, cells in seen.items() if cells], elements


def _sheets(book: Workbook, budget: Budget) -> list[Grid]:
    grids: list[Grid] = []
    cells, characters = 0, 0
    for sheet in book.worksheets[:SHEETS_MAX]:
        # The cells decide the length of a row, because the stated size of a sheet may be wrong.
        sheet.reset_dimensions()
        grid = Grid(sheet.title, [])
        for row in sheet.iter_rows(max_row=ROWS_MAX, values_only=True):
            budget.look()
            cells += min(len(row), COLUMNS_MAX)
            if cells > CELLS_MAX:
                grid.notes.append(note("cut", title=sheet.title, rows=f"{len(grid.rows):,}"))
                break
            # One text that is stored once may stand in every cell.
            characters += sum(len(value) for value in row[:COLUMNS_MAX] if isinstance(value, str))
            if characters > UNPACKED_MAX:
                raise BadArchive("bomb")
            grid.rows.append([_cell(value) for value in row[:COLUMNS_MAX]])
        numbers = [value for line in grid.rows for value in line if isinstance(value, float)]
        # Only among whole numbers the formats tell how they were rounded: 1.00 is stored as 1.
        if 2 * sum(value.is_integer() for value in numbers) > len(numbers):
            lines = sheet.iter_rows(max_row=len(grid.rows))
            grid.words = [_as_written(line[:COLUMNS_MAX], budget) for line in lines]
        grids.append(grid)
    if not grids:
        raise ValueError("no sheets")
    return grids


def _as_written(line: tuple[Any, ...], budget: Budget) -> list[str]:
    """Whole numbers of a row with the decimals that their formats show, such as 1.00; other cells are empty."""
    budget.look()
    return [
        f"{cell.value:.{min(len(zeros[1]), 15)}f}"
        if isinstance(cell.value, int | float) and (zeros := DECIMALS_SHOWN.search(cell.number_format))
        else ""
        for cell in line
    ]


def _cell(value: object) -> Cell:
    """Content of a cell: a number, None for a blank, and text for anything else, such as dates and infinity."""
    if isinstance(value, (int, float)) and not isinstance(value, bool) and abs(value) <= sys.float_info.max:
        return float(value)
    return None if value is None else str(value).strip() or None
