"""Workbooks of other tools are graded right in every cell; hostile and broken files get a clear word."""

from __future__ import annotations

import io
import json
import shutil
import subprocess
import zipfile
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import openpyxl
import pytest
import xlsxwriter

from app.files.tables import Language
from app.grade.reading import FILE_MAX, UNPACKED_MAX
from app.grade.report import FileAnswer, graded
from core import Budget, TooMuchWork
from tests.app.grade import students
from tests.app.grade.students import CONTACT, SPIRAL_TIMES, TURN_TIMES, spiral, turn

ROOT = Path(__file__).parents[3]
# Cells of the three workbooks.
ALL_CELLS = 338_016
SHEETS = ("xl/worksheets/sheet1.xml", "xl/worksheets/sheet2.xml")


def grade(data: bytes, name: str = "result1.xlsx") -> FileAnswer:
    return graded(name, data, Language.ENGLISH, Budget())


def by_xlsxwriter() -> Iterator[bytes]:
    yield students.workbook(spiral(), SPIRAL_TIMES)
    yield students.contact_workbook(spiral(np.array([CONTACT])))
    yield students.workbook(turn(), TURN_TIMES)


def by_openpyxl(folder: Path) -> Iterator[bytes]:
    """The same files, read and written again by openpyxl."""
    for data in by_xlsxwriter():
        sink = io.BytesIO()
        openpyxl.load_workbook(io.BytesIO(data)).save(sink)
        yield sink.getvalue()


def by_libreoffice(folder: Path) -> Iterator[bytes]:
    """The same files, read and written again by LibreOffice."""
    for k, data in enumerate(by_xlsxwriter()):
        (folder / f"{k}.xlsx").write_bytes(data)
    out = folder / "out"
    command = ["soffice", f"-env:UserInstallation=file://{folder}/profile", "--headless", "--convert-to", "xlsx"]
    files = [str(folder / f"{k}.xlsx") for k in range(3)]
    subprocess.run([*command, "--outdir", str(out), *files], check=True, capture_output=True, timeout=300)
    for k in range(3):
        yield (out / f"{k}.xlsx").read_bytes()


WRITERS: dict[str, Callable[[Path], Iterator[bytes]]] = {
    "XlsxWriter": lambda folder: by_xlsxwriter(),
    "openpyxl": by_openpyxl,
}
if shutil.which("soffice"):
    WRITERS["LibreOffice"] = by_libreoffice


@pytest.mark.parametrize("writer", WRITERS)
def test_workbooks_of_other_tools_are_right_in_all_cells(writer: str, tmp_path: Path) -> None:
    found = [grade(data, "upload") for data in WRITERS[writer](tmp_path)]
    assert [file.workbook for file in found] == ["result1", "result2", "result4"]
    sheets = [sheet for file in found for sheet in file.sheets]
    assert {sheet.verdict for sheet in sheets} == {"right"}
    assert sum(sheet.right for sheet in sheets) == sum(sheet.cells for sheet in sheets) == ALL_CELLS


def small(change: Callable[[Any], None] | None = None, times: int = 4) -> bytes:
    """A result1 of a few instants, as openpyxl writes it, with a change to it."""
    book = openpyxl.Workbook()
    for sheet, title, kind, rows in zip(
        (book.active, book.create_sheet()), ("位置", "速度"), ("position", "speed"),
        students.sheets(spiral(SPIRAL_TIMES[:times])), strict=True,
    ):  # fmt: skip
        sheet.title = title
        sheet.append([None, *(f"{t} s" for t in range(times))])
        for label, row in zip(students.labels(kind), rows.tolist(), strict=True):
            sheet.append([label, *row])
    if change:
        change(book)
    sink = io.BytesIO()
    book.save(sink)
    return sink.getvalue()


def repacked(data: bytes, change: Callable[[str, bytes], bytes], **more: bytes) -> bytes:
    """A workbook with its parts changed."""
    sink = io.BytesIO()
    with zipfile.ZipFile(io.BytesIO(data)) as old, zipfile.ZipFile(sink, "w", zipfile.ZIP_DEFLATED) as new:
        for part in old.namelist():
            new.writestr(part, change(part, old.read(part)))
        for part, content in more.items():
            new.writestr(part, content)
    return sink.getvalue()


def in_sheets(old: bytes, new: bytes) -> Callable[[str, bytes], bytes]:
    return lambda part, content: content.replace(old, new, 1) if part in SHEETS else content


def test_a_few_right_instants_are_incomplete() -> None:
    found = grade(small())
    assert found.verdict == "incomplete"
    position, speed = found.sheets
    assert (position.right, position.missing) == (4 * 448, 297 * 448)
    assert (speed.right, speed.missing) == (4 * 224, 297 * 224)
    assert position.picture == ["." * 4] * 14


def zip_bomb() -> bytes:
    return repacked(small(), lambda part, content: content, **{"xl/media/big.bin": bytes(UNPACKED_MAX + 1)})


def encrypted() -> bytes:
    return bytes.fromhex("d0cf11e0a1b11ae1") + bytes(2000) + "EncryptedPackage".encode("utf-16-le") + bytes(500)


def entities() -> bytes:
    trap = b'<?xml version="1.0"?><!DOCTYPE a [<!ENTITY b "bbbbbbbb"><!ENTITY c "&b;&b;&b;&b;">]><a>&c;</a>'
    return repacked(small(), lambda part, content: trap if part == SHEETS[0] else content)


UNREADABLE = {
    "nothing": (lambda: b"", "The file is empty."),
    "100 MB": (lambda: b"PK" + bytes(FILE_MAX), "at most 20 MB are read"),
    "zip bomb": (zip_bomb, "would unpack to 100 MB"),
    "encrypted": (encrypted, "encrypted: save it without a password"),
    "old format": (lambda: bytes.fromhex("d0cf11e0a1b11ae1") + bytes(2000), "old format .xls"),
    "truncated": (lambda: small()[:-3000], "ends early or does not unpack"),
    "entities": (entities, "declares a document type in xl/worksheets/sheet1.xml"),
    "another archive": (lambda: zipped("essay.txt", b"words"), "an archive but no .xlsx workbook"),
    "no sheets": (lambda: repacked(small(), lambda part, content: b"<nonsense/>"), "damaged and cannot be opened"),
    "a picture": (lambda: b"\x89PNG\r\n\x1a\n" + bytes(200), "neither a workbook nor a table"),
    "prose": (lambda: "我们没有算出来，对不起。".encode(), "No sheet has labels"),
}


def zipped(name: str, content: bytes) -> bytes:
    sink = io.BytesIO()
    with zipfile.ZipFile(sink, "w") as archive:
        archive.writestr(name, content)
    return sink.getvalue()


@pytest.mark.parametrize("name", UNREADABLE)
def test_a_file_that_cannot_be_graded_gets_a_clear_word(name: str) -> None:
    data, words = UNREADABLE[name]
    found = grade(data())
    assert (found.verdict, found.diagnosis, found.sheets) == ("unreadable", [], [])
    assert words in found.notes[0]


def test_macros_are_told_and_not_run() -> None:
    found = grade(repacked(small(), lambda part, content: content, **{"xl/vbaProject.bin": b"macro"}))
    assert found.verdict == "incomplete"
    assert found.notes == ["The workbook holds macros: they were not run."]


def test_formulas_count_with_the_value_stored_with_them() -> None:
    found = grade(repacked(small(), in_sheets(b'<c r="C2" t="n"><v>', b'<c r="C2"><f>4.4*2</f><v>')))
    # One in each sheet.
    assert found.notes == 2 * ["1 cells hold formulas, the first is C2: the values stored with them were read."]
    assert found.sheets[0].right == 4 * 448


def test_merged_cells_are_told() -> None:
    found = grade(small(lambda book: book["位置"].merge_cells("C2:E2")))
    assert found.notes == ["1 ranges of cells are merged, the first is C2:E2: only its first cell has a value."]
    assert found.sheets[0].right == 4 * 448 - 2


def test_text_in_number_cells_is_told_with_its_place() -> None:
    def change(book: Any) -> None:
        book["位置"]["C3"] = "—"
        book["位置"]["D3"] = str(book["位置"]["D3"].value)

    sheet = grade(small(change)).sheets[0]
    assert "C3 should hold a number and holds the text “—”." in sheet.notes
    assert "The number in D3 is stored as text." in sheet.notes
    assert sheet.right == 4 * 448 - 1


def test_a_sheet_without_end_is_cut_and_graded() -> None:
    def change(book: Any) -> None:
        book["位置"].cell(1_048_576, 16_384, 1.0)

    assert grade(small(change)).sheets[0].right == 4 * 448


def test_a_budget_ends_the_reading() -> None:
    budget = Budget()
    budget.stop("now")
    with pytest.raises(TooMuchWork):
        graded("result1.xlsx", small(), Language.ENGLISH, budget)


def rows_of(data: bytes) -> dict[str, list[list[Any]]]:
    book = openpyxl.load_workbook(io.BytesIO(data))
    return {sheet.title: [list(row) for row in sheet.iter_rows(values_only=True)] for sheet in book}


def written(sheets: dict[str, list[list[Any]]]) -> bytes:
    sink = io.BytesIO()
    with xlsxwriter.Workbook(sink, {"in_memory": True}) as book:
        for title, rows in sheets.items():
            sheet = book.add_worksheet(title)
            for k, row in enumerate(rows):
                sheet.write_row(k, 0, row)
    return sink.getvalue()


def changed(change: Callable[[list[list[Any]]], list[list[Any]]]) -> bytes:
    return written({title: change(rows) for title, rows in rows_of(small()).items()})


def transposed(rows: list[list[Any]]) -> list[list[Any]]:
    return [list(row) for row in zip(*rows, strict=True)]


def full_width(rows: list[list[Any]]) -> list[list[Any]]:
    return [[str(row[0] or "").replace("(", "（ ").replace(")", " ）"), *row[1:]] for row in rows]


def in_centimetres(rows: list[list[Any]]) -> list[list[Any]]:
    return [rows[0], *([row[0], *(100.0 * value for value in row[1:])] for row in rows[1:])]


def bare_times(rows: list[list[Any]]) -> list[list[Any]]:
    return [[None, *range(len(rows[0]) - 1)], *rows[1:]]


def below_a_title(rows: list[list[Any]]) -> list[list[Any]]:
    return [["问题一的结果"], [], *rows]


LAYOUTS = [transposed, full_width, bare_times, below_a_title]


@pytest.mark.parametrize("change", LAYOUTS, ids=lambda change: change.__name__)
def test_other_layouts_are_recognised(change: Any) -> None:
    found = grade(changed(change))
    assert [sheet.right for sheet in found.sheets] == [4 * 448, 4 * 224], found


def test_positions_in_centimetres_are_read_as_such() -> None:
    sheets = rows_of(small())
    found = grade(written({**sheets, "位置": in_centimetres(sheets["位置"])}))
    assert found.sheets[0].right == 4 * 448
    assert "The numbers are in cm: they were read as such." in found.sheets[0].notes


def test_a_handle_too_many_is_told_and_the_others_are_graded() -> None:
    sheets = rows_of(small())
    for title, lines in (("位置", 2), ("速度", 1)):
        rows = sheets[title]
        extra = [[label.replace("龙尾（后）", "龙尾（后）（后）"), *row] for label, *row in rows[-lines:]]
        sheets[title] = rows + extra
    found = grade(written(sheets))
    assert [sheet.right for sheet in found.sheets] == [4 * 448, 4 * 224]


def test_a_handle_too_few_is_missing_and_the_others_are_right() -> None:
    sheets = rows_of(small())
    found = grade(written({"位置": sheets["位置"][:101] + sheets["位置"][103:], "速度": sheets["速度"]}))
    position = found.sheets[0]
    assert (position.verdict, position.right) == ("incomplete", 4 * 446)


def test_a_missing_sheet_makes_the_workbook_incomplete() -> None:
    sheets = rows_of(small())
    found = grade(written({"位置": sheets["位置"]}))
    assert found.sheets[1].notes == ["The sheet of the speeds is missing."]
    assert found.verdict == "incomplete"


@pytest.mark.parametrize("coding", ["utf-8-sig", "gb18030", "utf-16"])
def test_csv_of_a_sheet_is_graded(coding: str) -> None:
    [sheet] = grade(wide_csv().encode(coding), "result1.csv").sheets
    assert (sheet.verdict, sheet.right) == ("right", 301 * 448)


def test_csv_with_a_line_for_each_handle_and_instant_is_graded() -> None:
    position, speed = spiral(SPIRAL_TIMES[:3])
    lines = ["time,handle,x,y,speed"]
    lines += [f"{t},{h},{position[t, h, 0]},{position[t, h, 1]},{speed[t, h]}" for t in range(3) for h in range(224)]
    found = grade("\n".join(lines).encode(), "dance.csv")
    assert [(sheet.holds, sheet.right) for sheet in found.sheets] == [("position", 3 * 448), ("speed", 3 * 224)]


def wide_csv(decimals: int = 6) -> str:
    """The positions of result1 as CSV."""
    lines = [",".join(["", *(f"{t:g} s" for t in SPIRAL_TIMES)])]
    points = spiral()[0].transpose(1, 2, 0).reshape(-1, 301)
    rows = zip(students.labels("position"), points, strict=True)
    return "\r\n".join(lines + [",".join([label, *(f"{value:.{decimals}f}" for value in row)]) for label, row in rows])


@pytest.mark.parametrize("decimals", [5, 4, 3, 2])
def test_rounded_results_are_named_with_their_decimals(decimals: int) -> None:
    found = grade(wide_csv(decimals).encode(), "result1.csv")
    [sheet] = found.sheets
    assert (sheet.verdict, sheet.decimals, found.diagnosis) == ("rounded", decimals, [])


def test_results_with_one_decimal_are_wrong() -> None:
    assert grade(wide_csv(1).encode(), "result1.csv").verdict == "wrong"


def test_the_labels_of_the_contest_are_recognised() -> None:
    labels = json.loads((ROOT / "tests/reference/contest_workbooks.json").read_text())["workbooks"]
    for title, rows in rows_of(small()).items():
        [told] = [sheet for sheet in labels["result1"] if sheet["title"] == title]
        exact = [[label, *row[1:]] for label, row in zip(told["first_column"], rows, strict=True)]
        [sheet, *_] = grade(written({title: exact})).sheets
        assert sheet.right == 4 * (len(rows) - 1)
