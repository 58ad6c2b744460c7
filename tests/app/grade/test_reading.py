"""Workbooks of other tools are graded right in every cell; hostile and broken files get a clear word."""

import io
import re
import zipfile
from functools import cache
from threading import Timer

import openpyxl
import pytest

from app.grade.reading import FILE_MAX, grids_of
from app.grade.report import graded
from app.grade.workbook import ELEMENTS_MAX, UNPACKED_MAX
from core import Budget, TooMuchWork
from core.language import speaking
from tests.campaigns.libreoffice import FEW, SMALL
from tests.support import students
from tests.support.bombs import zipped
from tests.support.depth import often
from tests.support.students import (
    SPIRAL_TIMES,
    TURN_TIMES,
    by_xlsxwriter,
    few,
    rows_of,
    spiral,
    three,
    turn,
)

SHEETS = ("xl/worksheets/sheet1.xml", "xl/worksheets/sheet2.xml")


def grade(data, name="result1.xlsx"):
    return graded(name, data, Budget())


def by_openpyxl(sheets):
    book = openpyxl.Workbook(write_only=True)
    sink = io.BytesIO()
    for title, rows in sheets.items():
        sheet = book.create_sheet(title)
        for row in rows:
            sheet.append(row)
    book.save(sink)
    return sink.getvalue()


def by_pandas(sheets):
    """Tables by pandas, whose columns have names: bold heads with borders, labels as the index."""
    import pandas

    sink = io.BytesIO()
    with pandas.ExcelWriter(sink) as book:
        for title, [[_, *heads], *rows] in sheets.items():
            frame = pandas.DataFrame([row[1:] for row in rows], [row[0] for row in rows], heads)
            frame.to_excel(book, sheet_name=title)
    return sink.getvalue()


@pytest.mark.parametrize("writer", [by_openpyxl, by_pandas, None], ids=["openpyxl", "pandas", "libreoffice"])
def test_a_few_instants_of_other_tools_are_right(writer):
    """`make libreoffice` has LibreOffice write all of them."""
    spiralled = rows_of(spiral(SPIRAL_TIMES[:FEW]), SPIRAL_TIMES[:FEW])
    turned = rows_of(turn(TURN_TIMES[:FEW]), TURN_TIMES[:FEW])
    for name, sheets in {"result1": spiralled, "result2": three()[1], "result4": turned}.items():
        result = grade(writer(sheets) if writer else (SMALL / f"{name}.xlsx").read_bytes(), "upload")
        right = sum(sheet.right for sheet in result.sheets)
        assert result.workbook == name
        assert right == 3 * 224 * (1 if name == "result2" else FEW)


@cache
def small(change=lambda book: None):
    """A result1 of a few instants as openpyxl writes it, with a change to it."""
    book = openpyxl.load_workbook(io.BytesIO(by_openpyxl(few())))
    sink = io.BytesIO()
    change(book)
    book.save(sink)
    return sink.getvalue()


def repacked(data, change, **more):
    """A workbook with its parts changed."""
    sink = io.BytesIO()
    with zipfile.ZipFile(io.BytesIO(data)) as old, zipfile.ZipFile(sink, "w", zipfile.ZIP_DEFLATED) as new:
        for part in old.namelist():
            new.writestr(part, change(part, old.read(part)))
        for part, content in more.items():
            new.writestr(part, content)
    return sink.getvalue()


def with_part(name, content):
    return repacked(small(), lambda part, content: content, **{name: content})


def in_sheets(old, new):
    return lambda part, content: content.replace(old, new, 1) if part in SHEETS else content


def trap(place, text, coding="utf-8"):
    """A workbook one of whose sheets is this document."""
    return repacked(small(), lambda part, content: text.encode(coding) if part == SHEETS[place] else content)


def repeated(element, times):
    """A workbook whose sheets are the same element again and again."""
    start = b'<worksheet xmlns="http://schemas.openxmlformats.org/spreadsheetml/2006/main"><sheetData>'
    sheet = start + times * element + b"</sheetData></worksheet>"
    return repacked(small(), lambda part, content: sheet if part in SHEETS else content)


def strict():
    """A workbook in Excel's Strict Open XML."""
    old = b"http://schemas.openxmlformats.org/spreadsheetml/2006"
    new = b"http://purl.oclc.org/ooxml/spreadsheetml"
    return repacked(small(), lambda part, content: content.replace(old, new))


OLD = bytes.fromhex("d0cf11e0a1b11ae1") + bytes(2000)
ENTITIES = '<!DOCTYPE a [<!ENTITY b "bbbbbbbb"><!ENTITY c "&b;&b;&b;&b;">]><a>&c;</a>'
WIDE = f'<?xml version="1.0" encoding="utf-16"?>{ENTITIES}'
UNREADABLE = {
    "nothing": (lambda: b"", "The file is empty."),
    "100 MB": (lambda: b"PK" + bytes(FILE_MAX), "has more than 20 MB"),
    "zip bomb": (
        lambda: with_part("xl/media/big.bin", bytes(UNPACKED_MAX + 1)),
        "the limit of 100 MB",
    ),
    "encrypted": (
        lambda: OLD + "EncryptedPackage".encode("utf-16-le") + bytes(500),
        "without a password",
    ),
    "old format": (lambda: OLD, "an old format, such as .xls of Excel or .et of WPS"),
    "LibreOffice": (
        lambda: zipped({"META-INF/manifest.xml": "<a/>"}, zipfile.ZIP_STORED),
        "table of LibreOffice (.ods)",
    ),
    "Numbers": (lambda: zipped({"Index/Document.iwa": "words"}, zipfile.ZIP_STORED), "table of Numbers"),
    "a web page": (lambda: b"<html><table></table></html>", "is a web page"),
    "commas": (lambda: "\n".join(["handle,0 s,1 s", *["龙头x (m),8,8,8,7,8,6"] * 3]).encode(), "by semicolons"),
    "truncated": (lambda: small()[:-3000], "ends early or does not unpack"),
    "entities": (lambda: trap(0, ENTITIES), "xl/worksheets/sheet1.xml declares a document type"),
    "entities in UTF-16": (lambda: trap(1, WIDE, "utf-16"), "xl/worksheets/sheet2.xml declares a document type"),
    "too many elements": (lambda: repeated(b"<row/>", ELEMENTS_MAX), "more than 2,000,000 elements"),
    "a long row": (lambda: repeated(b"<c/>", 16_385), "a row of more than 16,384 cells"),
    "strict": (strict, "Strict Open XML: save it as an ordinary .xlsx"),
    "another archive": (lambda: zipped({"essay.txt": b"words"}, zipfile.ZIP_STORED), "not an .xlsx workbook"),
    "no sheets": (lambda: repacked(small(), lambda part, content: b"<nonsense/>"), "damaged and cannot be opened"),
    "a picture": (lambda: b"\x89PNG\r\n\x1a\n" + bytes(200), "is a picture, such as a screenshot"),
    "a photo of a phone": (lambda: b"\0\0\0\x18ftypheic" + bytes(200), "is a picture, such as a screenshot"),
    "a paper": (lambda: b"%PDF-1.7\n" + bytes(200), "is a PDF, not a workbook"),
    "nonsense": (lambda: b"\x01\x02" + bytes(200), "neither a workbook nor a table"),
    "prose": (lambda: "我们没有算出来，对不起。".encode(), "has the name of a workbook, but its content is text"),
}


SLOW = {"zip bomb", "too many elements"}


@pytest.mark.parametrize("name", often(UNREADABLE, UNREADABLE.keys() - SLOW))
def test_a_file_that_cannot_be_graded_gets_a_clear_word(name):
    data, words = UNREADABLE[name]
    result = grade(data())
    assert (result.verdict, result.diagnosis, result.sheets) == ("unreadable", [], [])
    assert words in result.notes[0]


def prefixed(part, content):
    """The names of elements that some libraries write: x:row, x:c, x:v."""
    return re.sub(rb"<(/?)(?=\w)", rb"<\1x:", content.replace(b"xmlns=", b"xmlns:x=")) if part in SHEETS else content


def without_places(part, content):
    return re.sub(rb'<(c|row) r="\w+"', rb"<\1", content) if part in SHEETS else content


def pronounced(part, content):
    """Text with the reading of a word as it was typed, which Excel keeps."""
    text = b'</t><rPh sb="0" eb="1"><t>head 9</t></rPh></si>'
    return content.replace(b"</t></si>", text) if part == "xl/sharedStrings.xml" else content


def linked_from_the_root(part, content):
    return content.replace(b'"worksheets', b'"/xl/worksheets') if part.endswith("workbook.xml.rels") else content


@pytest.mark.parametrize("change", [prefixed, without_places, pronounced, linked_from_the_root])
def test_the_same_workbook_is_read_however_it_is_written(change):
    simple = by_xlsxwriter({title: [["t", *rows[0][1:]], *rows[1:]] for title, rows in few().items()})
    data = repacked(simple, change)
    assert data != repacked(simple, lambda part, content: content)
    assert [sheet.right for sheet in grade(data).sheets] == [4 * 448, 4 * 224]


def test_an_invalid_number_is_text():
    infinite = in_sheets(b'<c r="C2" t="n"><v>', b'<c r="C2" t="n"><v>1e999</v></c><c r="Z2"><v>')
    sheet = grade(repacked(small(), infinite)).sheets[0]
    assert "C2 should hold a number, but holds the text “inf”." in sheet.notes
    assert sheet.right == 4 * 448 - 1


def test_a_csv_has_numbers_texts_and_blanks():
    words = ["-8.5", " 5. ", ".5e-3", "１２.5", "1_000", "inf", "nan", "1.2.3", "-", " "]
    [grid] = grids_of(",".join(words).encode(), Budget())[0]
    assert grid.rows == [[-8.5, 5.0, 0.0005, 12.5, *words[4:9], None]]


def test_macros_are_reported_and_not_run():
    result = grade(with_part("xl/vbaProject.bin", b"macro"))
    assert result.verdict == "incomplete"
    assert result.notes == ["The workbook holds macros: they were not run."]


def test_formulas_count_with_the_value_stored_with_them_or_are_reported():
    formula = b'<c r="C2"><f>4.4*2</f><v>'
    number = b'<c r="C2" t="n"><v>'
    result = grade(repacked(small(), in_sheets(number, formula)))
    # One in each sheet.
    assert result.notes == 2 * ["Cells with formulas: 1, the first is C2. The values stored with them were read."]
    assert result.sheets[0].right == 4 * 448
    result = grade(repacked(small(), in_sheets(number, formula + b'</v></c><c r="Z2"><v>')))
    assert result.notes[0].startswith("Cells with formulas but no stored value: 1, the first is C2. Open and save")
    assert result.sheets[0].right == 4 * 448 - 1


class Broken:
    """In the place of a budget: one in which a look fails, as a fault of the grader would."""

    def look(self):
        raise KeyError("lost")


def test_a_fault_in_one_file_is_reported_and_raises_nothing():
    result = graded("result1.csv", b"a,b", Broken())
    assert result.verdict == "unreadable"
    assert result.notes[0].startswith("The grader failed on this file (KeyError: 'lost')")


def test_merged_cells_are_reported():
    result = grade(small(lambda book: book["位置"].merge_cells("C2:E2")))
    assert result.notes == ["Merged ranges of cells: 1, the first is C2:E2. Only the first cell of each has a value."]
    assert result.sheets[0].right == 4 * 448 - 2


def with_cells(cells):
    """The grade of the positions with other values in some cells."""

    def change(book):
        for place, value in cells.items():
            cell = book["位置"][place]
            cell.value = value(cell.value) if callable(value) else value

    return grade(small(change)).sheets[0]


def test_text_in_number_cells_is_reported_with_its_place():
    texts = {"C3": "—", "D3": str, "E3": lambda value: str(value).replace(".", ","), "B3": "8.8_0"}
    sheet = with_cells({**texts, "B4": lambda value: f"{value} m"})
    assert "C3 should hold a number, but holds the text “—”." in sheet.notes
    assert "B3 should hold a number, but holds the text “8.8_0”." in sheet.notes
    assert "Numbers that are stored as text: 3, the first is in D3." in sheet.notes
    assert sheet.right == 4 * 448 - 2


@pytest.mark.parametrize("word", ["NaN", "#N/A", "无"])
def test_text_in_many_cells_is_reported_once_with_its_count(word):
    sheet = with_cells({f"{column}{row}": word for row in range(404, 450) for column in "BCDE"})
    assert sheet.notes[0] == f"184 cells hold the text “{word}” instead of a number, the first is B404."
    assert len(sheet.notes) == 2
    assert sheet.right == 4 * 402


def test_many_texts_are_counted_and_not_all_quoted():
    notes = with_cells({f"C{3 + k}": word for k, word in enumerate("abcdee")}).notes
    assert [note[:2] for note in notes[:3]] == ["C3", "C4", "C5"]
    assert notes[3] == "Further cells with text: 3."


def test_a_date_is_no_number():
    def change(book):
        book["位置"]["C2"].number_format = "yyyy-mm-dd"

    sheet = grade(small(change)).sheets[0]
    assert any(note.startswith("C2 should hold a number, but holds the text “1900-01-") for note in sheet.notes)
    assert sheet.right == 4 * 448 - 1


def test_a_sheet_without_end_is_cut_and_graded():
    def change(book):
        book["位置"].cell(1_048_576, 16_384, 1.0)

    assert grade(small(change)).sheets[0].right == 4 * 448


def test_wide_rows_without_end_are_cut_and_that_is_reported():
    """A single cell far to the right in each of many rows stands for as many blanks before it."""
    wide = [[None] * 999 + [k] for k in range(3_000)]
    result = grade(by_openpyxl(few() | {"速度": few()["速度"] + wide}))
    assert [sheet.right for sheet in result.sheets] == [4 * 448, 4 * 224]
    [note] = result.notes
    assert re.fullmatch(
        r"Of the sheet 速度 only the first 2,\d{3} rows were read, because the rows are too wide.", note
    )


def test_a_budget_ends_a_reading_that_has_begun():
    # The budget is checked between rows; here there are none, and openpyxl takes seconds for the other elements.
    data = repeated(b"<x/>", 500_000)
    budget = Budget()
    timer = Timer(0.1, budget.stop)
    timer.start()
    with pytest.raises(TooMuchWork):
        graded("result1.xlsx", data, budget)
    timer.join()


# The cells beside an index of all handles, or labels of three, and what is said of so few numbers.
FEW_NUMBERS = """
0,-5.39,-4.88,  wrong       Only 2 of 672 cells have a number (head); 223 handles have none, and their labels
0,,,            unreadable  labels for 224 handles, but no numbers beside them: fill in positions and speeds
0,-5.3,-4,1     wrong       Only 3 of 672 cells have a number (head)
"""


@pytest.mark.parametrize("row", FEW_NUMBERS.split("\n")[1:-1])
def test_a_table_that_is_nearly_empty_is_told_what_it_has_and_what_is_missing(row):
    line, verdict, words = row.split(maxsplit=2)
    table = "\n".join([",x,y,v", line, *(f"{k},,," for k in range(1, 224))])
    result = grade(table.encode(), "index.csv")
    assert result.verdict == verdict
    assert words in " ".join([*result.notes, *(one for sheet in result.sheets for one in sheet.notes)])
    with speaking("zh"):
        assert graded("index.csv", table.encode(), Budget()).verdict == verdict


def test_a_table_of_few_handles_is_told_which_are_missing():
    [said] = grade(
        "\n".join([",x (m),y (m)", "龙头,8.8,1", "第1节龙身,3.2,1", "第2节龙身,3.2,1"]).encode(), "few.csv"
    ).notes
    assert "(head; body 1; body 2); the table lacks 221 handles" in said


def test_numbers_of_one_decimal_are_told_to_have_too_few():
    rows = [f"{k},1.3,{k}.4,1" for k in range(224)]
    times = SPIRAL_TIMES[:4]
    position, speed = spiral(times)
    for data in ("\n".join([",x,y,v", *rows]).encode(), students.lines(((position + 0.3).round(1), speed), times)):
        [said] = grade(data, "index.csv").notes
        assert "too few decimals to tell why: at least 2 are necessary" in said
