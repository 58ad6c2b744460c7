"""Files as plain grids of cells, read without trust: a workbook or CSV, recognised by its content."""

from __future__ import annotations

import csv
import io
from contextlib import suppress

from app.grade.grid import Cell, Cells, Grid, UnreadableTable
from app.grade.words import Note, note
from app.grade.workbook import sheets_of
from app.wire.numbers import number_of
from core import Budget

# Longest file [bytes]; the contest's workbooks have 2 MB.
FILE_MAX = 20_000_000
# Most lines of a CSV; one for each handle and instant gives 67,425.
LINES_MAX, CELLS_MAX = 200_000, 1_000_000
# First bytes of a ZIP archive, and of the older container that also holds encrypted workbooks.
ZIP, OLE = b"PK", bytes.fromhex("d0cf11e0a1b11ae1")
ENCRYPTED = "EncryptedPackage".encode("utf-16-le")
# First bytes of pictures (PNG, JPEG, GIF, BMP; WebP and HEIC have a length before) and of a PDF.
PICTURES, PDF = (b"\x89PNG", b"\xff\xd8\xff", b"GIF8", b"BM"), b"%PDF"
BOXED_PICTURES = (b"WEBP", b"ftypheic", b"ftypheix", b"ftypavif", b"ftypmif1")
# Separators of cells, the usual one first, and the part of a file in which they are looked for [characters].
SEPARATORS, LOOKED_AT = ",;\t", 20_000
# Beginnings of a web page; and by how many times lines have more cells than their heads where a comma stands in most
# numbers too [1], fewest heads, and most lines that are looked at.
PAGES, COMMAS, HEADS_LEAST, LINES_LOOKED_AT = ("<html", "<!doctype", "<?xml"), 1.6, 3, 50
# Encodings to try: UTF-8, then that of Chinese versions of Excel.
CODINGS = ("utf-8-sig", "gb18030")


def grids_of(data: bytes, budget: Budget) -> tuple[list[Grid], list[Note]]:
    """The sheets of a file, and notes on the whole file.

    data: a workbook (.xlsx, .xlsm) or CSV
    raises: UnreadableTable; Halted when the budget ends
    """
    if len(data) > FILE_MAX:
        raise UnreadableTable(note("too_long", most=f"{FILE_MAX / 1e6:.0f}"))
    if not data.strip():
        raise UnreadableTable(note("empty"))
    if data.startswith(OLE):
        raise UnreadableTable(note("encrypted" if ENCRYPTED in data else "old_format"))
    if _is_picture(data):
        raise UnreadableTable(note("picture"))
    if data.startswith(PDF):
        raise UnreadableTable(note("document"))
    if data.startswith(ZIP):
        return sheets_of(data, budget)
    return [_of_csv(data, budget)], []


def _is_picture(data: bytes) -> bool:
    """Whether a file is a picture, which is no text: a table may begin with the letters BM."""
    return (data.startswith(PICTURES) and b"\0" in data) or any(one in data[4:12] for one in BOXED_PICTURES)


def _of_csv(data: bytes, budget: Budget) -> Grid:
    text = _decoded(data)
    if text[:LOOKED_AT].lstrip().lower().startswith(PAGES):
        raise UnreadableTable(note("web_page"))
    separator = _separator_of(text)
    decimal = "." if separator == "," else ","
    rows: Cells = []
    words: list[list[str]] = []
    cells = 0
    try:
        for line in csv.reader(io.StringIO(text, newline=""), delimiter=separator):
            budget.look()
            cells += len(line)
            if len(rows) >= LINES_MAX or cells > CELLS_MAX:
                raise UnreadableTable(note("too_many_cells", most=CELLS_MAX))
            rows.append([_number(word, decimal) for word in line])
            words.append(line)
    except csv.Error as error:
        raise UnreadableTable(note("no_csv")) from error
    if separator == "," and _has_two_commas(words):
        raise UnreadableTable(note("commas"))
    return Grid("", rows, words=words)


def _has_two_commas(words: list[list[str]]) -> bool:
    """True if a comma separates cells and stands in numbers: none has a point, and lines have nearly twice the cells
    that their heads name."""
    heads, *lines = words[:LINES_LOOKED_AT] or [[]]
    count = sum(map(bool, heads))
    has_points = any("." in cell for line in lines for cell in line[1:])
    is_wide = len(lines) > 1 and min(sum(map(bool, line)) for line in lines) >= COMMAS * count
    return count >= HEADS_LEAST and is_wide and not has_points


def _separator_of(text: str) -> str:
    """The separator of most of the first lines with one, because a title may stand above; a comma if no other is."""
    lines = [line for line in text[:LOOKED_AT].splitlines() if any(one in line for one in SEPARATORS)]
    counts = {one: sum(one in line for line in lines) for one in SEPARATORS[1:]}
    most = max(counts, key=counts.__getitem__)
    return most if 2 * counts[most] > len(lines) else SEPARATORS[0]


def _decoded(data: bytes) -> str:
    is_wide = data.startswith((b"\xff\xfe", b"\xfe\xff"))
    if b"\0" in data and not is_wide:
        raise UnreadableTable(note("no_csv"))
    for coding in ("utf-16",) if is_wide else CODINGS:
        with suppress(UnicodeDecodeError):
            return data.decode(coding)
    raise UnreadableTable(note("no_csv"))


def _number(word: str, decimal: str) -> Cell:
    """A number, a text, or None for a blank. decimal: "," if a comma may be the decimal point"""
    bare = word.strip()
    if not bare:
        return None
    pointed = bare.replace(decimal, ".")
    try:
        value = number_of(pointed)
    except ValueError:
        return word
    return word if pointed[-1].isalpha() else value  # inf and nan are words here
