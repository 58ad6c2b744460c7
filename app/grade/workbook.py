"""Workbooks (.xlsx) as plain grids of cells, read without trust.

Input: the bytes of a file. Output: its sheets, and notes on the whole. State: that of one parser (expat). Nothing in a
file is run or followed: macros and links are left alone, formulas count with the value that was stored with them, and
every size is checked before anything is unpacked.

Argument: one pass over each part, in pieces. Between two pieces a budget may end it and other threads run; what is kept
has at most ROWS_MAX x COLUMNS_MAX cells a sheet, wherever a file says that its cells are. A result1 takes 0.4 s, and
1.1 s with openpyxl; calamine takes 0.1 s, but asks for 550 GB where one cell stands in the last corner of a sheet, and
the process dies of it (python-calamine 0.9.1; all measured 2026-11-22).
"""

from __future__ import annotations

import io
import zipfile
import zlib
from math import isfinite
from posixpath import join, normpath
from xml.parsers import expat

from app.grade.grid import Cell, Grid, Unreadable
from app.grade.words import Note, note
from core import Budget

# What the parts of a file unpack to, together [bytes], and their number.
UNPACKED_MAX, PARTS_MAX = 100_000_000, 500
# Largest sheet of a workbook: result1 has 449 x 302 cells, in either orientation; and the number of sheets.
ROWS_MAX, COLUMNS_MAX, SHEETS_MAX = 2_000, 1_000, 20
# The parser takes pieces of this length [bytes].
PIECE = 1 << 16
# A column has no more letters than these.
LETTERS_MAX, DIGITS = 3, "0123456789"
MAIN, LINKS = "xl/workbook.xml", "xl/_rels/workbook.xml.rels"

Attributes = dict[str, str]


def sheets_of(data: bytes, budget: Budget) -> tuple[list[Grid], list[Note]]:
    """The sheets of a workbook, and notes on the whole file. raises: Unreadable; Halted when the budget ends"""
    try:
        with zipfile.ZipFile(io.BytesIO(data)) as archive:
            _refuse_traps(archive)
            return _sheets(archive, budget)
    except (zipfile.BadZipFile, zlib.error, EOFError) as error:
        raise Unreadable(note("truncated")) from error
    except (expat.ExpatError, LookupError, ValueError, NotImplementedError) as error:
        raise Unreadable(note("broken", why=f"{type(error).__name__}: {error}"[:120])) from error


def _refuse_traps(archive: zipfile.ZipFile) -> None:
    """raises: Unreadable for an archive that is no workbook, or a trap"""
    parts = archive.infolist()
    if any(part.flag_bits & 1 for part in parts):
        raise Unreadable(note("encrypted"))
    unpacked = sum(part.file_size for part in parts)
    if unpacked > UNPACKED_MAX or len(parts) > PARTS_MAX:
        sizes = {"size": f"{unpacked / 1e6:.0f}", "parts": len(parts), "most": f"{UNPACKED_MAX / 1e6:.0f}"}
        raise Unreadable(note("bomb", **sizes))
    if MAIN not in archive.namelist():
        raise Unreadable(note("other_archive"))


def _sheets(archive: zipfile.ZipFile, budget: Budget) -> tuple[list[Grid], list[Note]]:
    listed, linked = _Elements("sheet"), _Elements("Relationship")
    _parse(archive, MAIN, listed, budget)
    _parse(archive, LINKS, linked, budget)
    parts = {one["Id"]: (one["Type"], normpath(join("/xl", one["Target"]))[1:]) for one in linked.found}
    texts, notes = _Texts(), [note("macros")] if "xl/vbaProject.bin" in archive.namelist() else []
    for kind, part in parts.values():
        if kind.endswith("/sharedStrings"):
            _parse(archive, part, texts, budget)
    grids = []
    for one in listed.found[:SHEETS_MAX]:
        kind, part = parts[next(value for name, value in one.items() if name.endswith("}id"))]
        if kind.endswith("/worksheet"):
            cells = _Cells(texts.found)
            _parse(archive, part, cells, budget)
            grids.append(Grid(one["name"], cells.grid()))
            notes += cells.notes()
    if not grids:
        raise ValueError("no sheets")
    return grids, notes


def _parse(archive: zipfile.ZipFile, part: str, handlers: _Elements | _Texts, budget: Budget) -> None:
    """Give every element of a part to its handlers."""

    def refuse(*_: object) -> None:
        raise Unreadable(note("declared", part=part))

    parser = expat.ParserCreate(namespace_separator="}")
    parser.buffer_text = True
    parser.StartDoctypeDeclHandler = refuse
    parser.StartElementHandler = handlers.start
    if isinstance(handlers, _Texts):
        parser.EndElementHandler, parser.CharacterDataHandler = handlers.end, handlers.words.append
    with archive.open(part) as source:
        while piece := source.read(PIECE):
            budget.look()
            parser.Parse(piece)
    parser.Parse(b"", True)


class _Elements:
    """Handler that finds all elements of one name. found: their attributes"""

    def __init__(self, name: str) -> None:
        self.name = "}" + name
        self.found: list[Attributes] = []

    def start(self, tag: str, given: Attributes) -> None:
        if tag.endswith(self.name):
            self.found.append(given)


class _Texts:
    """Handlers of shared strings. found: texts; words: pieces of the present one, from `spoken` on how it sounds"""

    def __init__(self) -> None:
        self.found: list[str] = []
        self.words: list[str] = []
        self.spoken = 0

    def start(self, tag: str, given: Attributes) -> None:
        if tag.endswith("}si"):
            self.words.clear()
        elif tag.endswith("}rPh"):
            self.spoken = len(self.words)

    def end(self, tag: str) -> None:
        if tag.endswith("}rPh"):
            del self.words[self.spoken :]
        elif tag.endswith("}si"):
            self.found.append("".join(self.words))


class _Cells(_Texts):
    """Handlers of a sheet. A row or cell without a place follows the one before; one beyond the largest is left out."""

    def __init__(self, shared: list[str]) -> None:
        super().__init__()
        self.shared = shared
        self.rows: dict[int, list[Cell]] = {}
        self.row, self.column, self.given = -1, -1, Attributes()
        self.columns: dict[str, int] = {}
        # Formulas and merged cells: how many, and where the first is.
        self.seen = {"formulas": (0, ""), "merged": (0, "")}
        # Names of most elements, known from the first one on.
        self.cell = self.value = ""

    def start(self, tag: str, given: Attributes) -> None:
        if tag == self.cell:
            self.given = given
            self.words.clear()
        elif tag == self.value:
            pass
        elif tag.endswith("}row"):
            self.row, self.column = int(given.get("r", self.row + 2)) - 1, -1
        elif tag.endswith("}f"):
            self._count("formulas", self.given.get("r", ""))
        elif tag.endswith("}mergeCell"):
            self._count("merged", given["ref"])
        elif tag.endswith("}worksheet"):
            self.cell, self.value = (tag.removesuffix("worksheet") + name for name in "cv")
        else:
            super().start(tag, given)

    def end(self, tag: str) -> None:
        if tag == self.cell:
            self._keep(self.given.get("r", "").rstrip(DIGITS), "".join(self.words).strip())
        elif tag == self.value:
            pass
        elif tag.endswith("}f"):
            self.words.clear()
        else:
            super().end(tag)

    def _keep(self, letters: str, text: str) -> None:
        """Put what a cell holds where it belongs. letters: of its column"""
        self.column = self.columns[letters] if letters in self.columns else self._new_column(letters)
        if text and self.row < ROWS_MAX and self.column < COLUMNS_MAX:
            row = self.rows.setdefault(self.row, [])
            if self.column >= len(row):
                row += [None] * (self.column + 1 - len(row))
            row[self.column] = self._value(self.given.get("t", "n"), text)

    def _new_column(self, letters: str) -> int:
        """The column with these letters, the next one without; from 0."""
        if not letters:
            return self.column + 1
        if len(letters) > LETTERS_MAX:
            return COLUMNS_MAX
        found = 0
        for letter in letters:
            found = 26 * found + ord(letter) - ord("A") + 1
        self.columns[letters] = found - 1
        return found - 1

    def _count(self, what: str, place: str) -> None:
        count, first = self.seen[what]
        self.seen[what] = (count + 1, first or place)

    def _value(self, kind: str, text: str) -> Cell:
        """What a cell of this type holds. A number that is none, such as infinity, stays text."""
        if kind == "n" and isfinite(number := float(text)):
            return number
        return self.shared[int(text)] if kind == "s" else text

    def grid(self) -> list[list[Cell]]:
        return [self.rows.get(k, []) for k in range(max(self.rows, default=-1) + 1)]

    def notes(self) -> list[Note]:
        return [note(what, count=count, cell=first) for what, (count, first) in self.seen.items() if count]
