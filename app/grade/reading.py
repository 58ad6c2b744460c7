"""Workbooks and CSV files as plain grids of cells, read without trust.

Nothing in a file is run or followed: macros and links are left alone, formulas count with the value that was stored
with them, and every size is checked before anything is unpacked.
"""

from __future__ import annotations

import csv
import io
import re
import unicodedata
import zipfile
import zlib
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from app.extras import require
from app.grade.words import Note, note
from core import BenchDragonError, Budget
from core.budget import Halted

if TYPE_CHECKING:
    from openpyxl.workbook.workbook import Workbook

# Longest file [bytes]; the contest's workbooks have 2 MB. What its parts unpack to, together [bytes], and their number.
FILE_MAX, UNPACKED_MAX, PARTS_MAX = 20_000_000, 100_000_000, 500
# Largest sheet of a workbook: result1 has 449 x 302 cells, in either orientation; and the number of sheets.
ROWS_MAX, COLUMNS_MAX, SHEETS_MAX = 2_000, 1_000, 20
# Lines of a CSV: one for each handle and instant is 67,425.
LINES_MAX, CELLS_MAX = 200_000, 1_000_000
# First bytes of a ZIP archive, and of the older container that also holds encrypted workbooks.
ZIP, OLE = b"PK", bytes.fromhex("d0cf11e0a1b11ae1")
ENCRYPTED = "EncryptedPackage".encode("utf-16-le")
FORMULA = re.compile(rb'<c\b[^>]*?\br="([A-Z]+[0-9]+)"[^>]*>\s*<(?:\w+:)?f[\s>/]')
MERGED = re.compile(rb'<(?:\w+:)?mergeCell [^>]*?ref="([A-Z0-9:]+)"')
DECLARED = re.compile(rb"<!(?:DOCTYPE|ENTITY)")
NUMBER = re.compile(r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?")
# What Chinese versions of Excel write, after UTF-8.
CODINGS = ("utf-8-sig", "gb18030")

Cell = float | str | None


class Unreadable(Exception):
    """A file that cannot be graded. said: why, and what to change"""

    def __init__(self, said: Note) -> None:
        super().__init__(said.code)
        self.said = said


@dataclass
class Grid:
    """Cells of one sheet, row by row; rows may differ in length. notes: what a reader should know of them"""

    title: str
    rows: list[list[Cell]]
    notes: list[Note] = field(default_factory=list)


def plain(text: str) -> str:
    """Text without blanks at its ends, with half-width brackets, letters and digits, and the plain minus sign.

    >>> plain(" 龙尾（后） ")
    '龙尾(后)'
    """
    return unicodedata.normalize("NFKC", text).replace("\u2212", "-").strip()


def grids_of(data: bytes, budget: Budget) -> tuple[list[Grid], list[Note]]:
    """The sheets of a file, and notes on the whole file.

    data: a workbook (.xlsx, .xlsm) or CSV, told apart by its content
    raises: Unreadable; TooMuchWork when the budget ends
    """
    if len(data) > FILE_MAX:
        raise Unreadable(note("too_long", size=f"{len(data) / 1e6:.1f}", most=f"{FILE_MAX / 1e6:.0f}"))
    if not data.strip():
        raise Unreadable(note("empty"))
    if data.startswith(OLE):
        raise Unreadable(note("encrypted" if ENCRYPTED in data else "old_format"))
    if data.startswith(ZIP):
        return _of_workbook(data, budget)
    return [_of_csv(data)], []


def _of_workbook(data: bytes, budget: Budget) -> tuple[list[Grid], list[Note]]:
    require("xlsx", "file", "A workbook")
    from openpyxl import load_workbook

    try:
        with zipfile.ZipFile(io.BytesIO(data)) as archive:
            notes = _refuse_traps(archive)
        book = load_workbook(io.BytesIO(data), read_only=True, data_only=True, keep_links=False)
        try:
            return _sheets(book, budget), notes
        finally:
            book.close()
    except (zipfile.BadZipFile, zlib.error, EOFError) as error:
        raise Unreadable(note("truncated")) from error
    except (Unreadable, BenchDragonError, Halted):
        raise
    except Exception as error:  # openpyxl has no error of its own for parts that are missing or hold nonsense.
        raise Unreadable(note("broken", why=f"{type(error).__name__}: {error}"[:120])) from error


def _refuse_traps(archive: zipfile.ZipFile) -> list[Note]:
    """Notes on macros, formulas and merged cells. raises: Unreadable for an archive that is no workbook or a trap"""
    parts = archive.infolist()
    names = {part.filename for part in parts}
    if any(part.flag_bits & 1 for part in parts):
        raise Unreadable(note("encrypted"))
    unpacked = sum(part.file_size for part in parts)
    if unpacked > UNPACKED_MAX or len(parts) > PARTS_MAX:
        sizes = {"size": f"{unpacked / 1e6:.0f}", "parts": len(parts), "most": f"{UNPACKED_MAX / 1e6:.0f}"}
        raise Unreadable(note("bomb", **sizes))
    if "xl/workbook.xml" not in names:
        raise Unreadable(note("other_archive"))
    found = [note("macros")] if "xl/vbaProject.bin" in names else []
    for part in parts:
        if not part.filename.endswith((".xml", ".rels")):
            continue
        text = archive.read(part)
        if DECLARED.search(text):
            raise Unreadable(note("declared", part=part.filename))
        if part.filename.startswith("xl/worksheets/"):
            if formulas := FORMULA.findall(text):
                found.append(note("formulas", count=len(formulas), cell=formulas[0].decode()))
            if merged := MERGED.findall(text):
                found.append(note("merged", count=len(merged), cell=merged[0].decode()))
    return found


def _sheets(book: Workbook, budget: Budget) -> list[Grid]:
    sheets = [sheet for sheet in book.worksheets if hasattr(sheet, "iter_rows")][:SHEETS_MAX]
    found = []
    for sheet in sheets:
        rows = []
        for row in sheet.iter_rows(max_row=ROWS_MAX, max_col=COLUMNS_MAX, values_only=True):
            budget.look()
            rows.append([value if type(value) is float else _cell(value) for value in row])
        found.append(Grid(sheet.title, rows))
    return found


def _cell(value: object) -> Cell:
    if isinstance(value, bool) or not isinstance(value, int | float | str | None):
        return str(value)
    if isinstance(value, int):
        return float(value) if abs(value) < 2**53 else str(value)
    return value


def _of_csv(data: bytes) -> Grid:
    text = _decoded(data)
    first = text.partition("\n")[0]
    separator = max(",;\t", key=first.count)
    rows: list[list[Cell]] = []
    cells = 0
    try:
        for line in csv.reader(io.StringIO(text, newline=""), delimiter=separator):
            cells += len(line)
            if len(rows) >= LINES_MAX or cells > CELLS_MAX:
                raise Unreadable(note("too_many_cells", most=CELLS_MAX))
            rows.append([_number(word) for word in line])
    except csv.Error as error:
        raise Unreadable(note("no_csv")) from error
    return Grid("", rows)


def _decoded(data: bytes) -> str:
    if data.startswith((b"\xff\xfe", b"\xfe\xff")):
        codings: tuple[str, ...] = ("utf-16",)
    elif b"\0" in data:
        raise Unreadable(note("no_csv"))
    else:
        codings = CODINGS
    for coding in codings:
        try:
            return data.decode(coding)
        except UnicodeDecodeError:
            continue
    raise Unreadable(note("no_csv"))


def _number(word: str) -> Cell:
    """A number, a text, or None for a blank."""
    said = word.strip()
    return float(said) if NUMBER.fullmatch(said) else word if said else None
