"""Answers of the grader: a verdict for each file and sheet, explanations of the errors, and the rubric in words."""

from __future__ import annotations

from collections.abc import Sequence
from decimal import Decimal
from pathlib import PurePath
from typing import Any

from pydantic import Field

from app.extras import MissingPackage
from app.files.tables import handle_titles
from app.grade.cells import cell_name
from app.grade.decimals import decimals_of_file
from app.grade.diagnosis import diagnosed, why_unexplained
from app.grade.expected import KINDS, Workbook, cells_of
from app.grade.grid import UnreadableTable
from app.grade.handles import BENCHES
from app.grade.judged import (
    DECIMALS_OF_CONTEST,
    NAME_OF_WORKBOOK,
    JudgedSheet,
    Rating,
    judged,
    with_errors,
    workbook_of,
    worst_of,
)
from app.grade.layout import SHEETS, TableKind
from app.grade.names import readable_name
from app.grade.numbers import CERTAIN, graded_number
from app.grade.reading import ZIP, grids_of
from app.grade.rubric import rubric_of
from app.grade.seen_paths import judged_by_turn
from app.grade.sheets import tables_of
from app.grade.shortcuts import UNITS, Finding, right_answer
from app.grade.typed_number import plain_number
from app.grade.unusual import unusual_of
from app.grade.words import Note, note, word
from app.wire.fields import Answer
from core import Budget, InvalidValue, TooMuchWork
from core.kernels import Halted
from core.language import joined, say
from core.quantities import Quantity
from core.questions import too_much

# Endings of workbook files.
WORKBOOK_ENDINGS = (".xlsx", ".xlsm")
# What a turn differs in that question 4 allows.
OTHER_TURN = {"other_entry_radius", "equal_arcs_of_turn"}


class CellAnswer(Answer):
    """One wrong cell.

    sheet: title of the sheet
    cell: name of the cell, such as B3
    row: row, from 1
    column: column, from 1
    handle: name of the handle
    quantity: which number: x, y or speed
    time: instant [s]
    found: value in the cell, in m for x and y, in m/s for a speed
    expected: right value, in m for x and y, in m/s for a speed
    """

    sheet: str
    cell: str
    row: int
    column: int
    handle: str
    quantity: str
    time: float
    found: float
    expected: float


class SheetAnswer(Answer):
    """One sheet.

    sheet: title of the sheet
    holds: what it holds: position, speed, or contact: x, y and speed at first contact
    verdict: one of right, rounded, wrong, incomplete and unreadable
    decimals: decimals to which all cells that have numbers are right, if they are rounded; else null
    cells: cells that the contest requires
    right: cells that are right within 5.1e-7
    rounded: further cells that are right to their decimals, or to two
    missing: cells that are missing
    worst: the cell with the largest error; null if none is wrong
    first: the first wrong cell, row by row; null if none is wrong
    picture: places of the wrong cells: lines for some handles, the head first, with marks for some instants: `.`
        right, `o` rounded, `#` wrong, `?` missing
    notes: remarks for the reader, in words
    sentences: all of it for the reader, with these remarks
    """

    sheet: str
    holds: str
    verdict: Rating
    decimals: int | None
    cells: int
    right: int
    rounded: int = Field(default=0)
    missing: int
    worst: CellAnswer | None
    first: CellAnswer | None
    picture: list[str]
    notes: list[str]
    sentences: list[str] = Field(default=[])


class DiagnosisAnswer(Answer):
    """A known error that explains wrong numbers.

    error: name of the error
    words: the error in words
    evidence: the numbers that support it
    """

    error: str
    words: str
    evidence: str


class GuessAnswer(DiagnosisAnswer):
    """A known error that may explain a number, whose digits are too few to decide.

    probability: share of the numbers with as many digits, as near to the right one, that fit a known error
    """

    probability: float


class CriterionAnswer(Answer):
    """One point of the rubric.

    criterion: name of the point
    met: true if the point is met; null if the file does not show it
    words: the point and the finding, in words
    """

    criterion: str
    met: bool | None
    words: str


class FileAnswer(Answer):
    """One file.

    file: name of the file
    workbook: its name: result1, result2 or result4; null if unknown
    verdict: the worst verdict of all sheets
    diagnosis: errors that explain the wrong cells; empty if nothing fits
    possible: shortcuts that give the instant of result2, but not with digits enough for a diagnosis
    sheets: its sheets
    rubric: the rubric of the contest's reviewers
    notes: remarks for the reader, in words
    headline: the verdict in words
    unusual: some wrong numbers that no common error gives, by which the files of a class are compared: x, y or v,
        instant, number of the handle, and value
    finding: what was found, in a few words for a table; empty for a file that is right as it is asked for
    """

    file: str
    workbook: str | None
    verdict: Rating
    diagnosis: list[DiagnosisAnswer]
    possible: list[GuessAnswer] = Field(default=[])
    sheets: list[SheetAnswer]
    rubric: list[CriterionAnswer]
    notes: list[str]
    headline: str
    unusual: list[str] = Field(default=[])
    finding: str = Field(default="")


class TypedAnswer(Answer):
    """One number that was typed in.

    answer: what it answers: collision_time, pitch, speed or turn_length
    verdict: it is right, as far as its digits go; rounded, if it is off by less than its last digit; incomplete, if it
        has too few digits; infeasible, if it was rounded beyond a limit; or wrong
    breaks: the limit that the number breaks, and by how much, in words; null if none
    found: the given number, in `unit`
    expected: the right number, in `unit`
    unit: unit of both
    digits: significant digits of the given number, to which it is graded
    rounded: it is the right number, but to fewer decimals than the contest asks for, or rounded to another side
    notes: remarks for the reader, in words
    diagnosis: the shortcut that gives the number, if its digits tell it from chance; empty if nothing fits
    possible: the shortcut that gives the number, if its digits are too few for a diagnosis
    title: what it answers, and the number, in words
    headline: the verdict in words
    sentences: what else there is to say, with these remarks
    """

    answer: str
    verdict: Rating
    breaks: str | None = None
    found: float
    expected: float
    unit: str
    digits: int
    rounded: bool
    notes: list[str]
    diagnosis: list[DiagnosisAnswer]
    possible: list[GuessAnswer] = Field(default=[])
    title: str
    headline: str
    sentences: list[str]


class GradeAnswer(Answer):
    """The files in the order given, and the typed answers.

    files: one entry for each file
    answers: one entry for each number that was typed in
    """

    files: list[FileAnswer]
    answers: list[TypedAnswer]


def graded(name: str, data: bytes, budget: Budget) -> FileAnswer:
    """The grade of one file. name: of the file, which may say which workbook it is; raises: TooMuchWork"""
    readable, remark = readable_name(name)
    try:
        answer = _graded(readable, data, budget)
    except UnreadableTable as error:
        return unreadable(name, error.reason)
    except Halted as error:
        raise too_long(data, budget) from error
    except (MissingPackage, TooMuchWork, MemoryError):
        raise
    except Exception as error:  # An error of ours in one file must not stop the grading of the others.
        return unreadable(name, note("failed", why=f"{type(error).__name__}: {error}"[:120]))
    return answer.model_copy(update={"notes": [*answer.notes, str(remark)]}) if remark else answer


def unreadable(name: str, why: Note) -> FileAnswer:
    """The answer for a file that was not graded."""
    readable, remark = readable_name(name)
    notes = [str(one) for one in (why, remark) if one]
    return FileAnswer(
        file=readable, workbook=None, verdict=Rating.UNREADABLE, diagnosis=[], sheets=[], rubric=[], notes=notes,
        headline=word(Rating.UNREADABLE.value), finding=notes[0],
    )  # fmt: skip


def too_long(data: bytes, budget: Budget) -> TooMuchWork:
    """The error for a file whose budget was stopped before it was graded."""
    return too_much(budget, "name", "must name a smaller file: it was not graded {then}", Quantity(len(data), "bytes"))


def _graded(name: str, data: bytes, budget: Budget) -> FileAnswer:
    grids, notes = grids_of(data, budget)
    tables = tables_of(grids)
    if not tables:
        has_workbook_ending = PurePath(name).suffix.lower() in WORKBOOK_ENDINGS
        known = next((one for grid in grids for one in grid.notes if one.code == "curve"), note("no_table"))
        raise UnreadableTable(note("no_workbook") if has_workbook_ending and not data.startswith(ZIP) else known)
    workbook = workbook_of(tables, PurePath(name).stem)
    decimals = decimals_of_file([table.values for table in tables])
    judgements, own = judged_by_turn([judged(table, workbook, decimals) for table in tables], decimals, budget)
    findings = diagnosed(judgements, budget)
    judgements = with_errors(judgements, {kind for one in findings for kind in one.kinds})
    certain = [one for one in findings if one.chance <= CERTAIN]
    sheets = [_sheet(one) for one in judgements]
    lacking = (kind for kind in KINDS[workbook] if kind not in {table.kind for table in tables})
    sheets += [_lacking(kind, cells_of(workbook, kind)) for kind in lacking]
    rubric = rubric_of(judgements, certain)
    notes += [one for grid in grids for one in grid.notes]
    why: Note | None = None
    if (match := NAME_OF_WORKBOOK.search(PurePath(name).stem)) and match[1] != workbook.value[-1]:
        notes.append(note("named_otherwise", named=f"result{match[1]}", workbook=workbook.value))
    verdict = worst_of(sheet.verdict for sheet in sheets)
    if verdict is Rating.WRONG and not findings:
        notes.append(why := why_unexplained(judgements))
    if own:
        notes.append(own)
    elif workbook is Workbook.RESULT4 and verdict is Rating.WRONG and {one.error for one in findings} <= OTHER_TURN:
        notes.append(note("other_turn", length=f"{right_answer('turn_length'):.4f}"))
    answer = FileAnswer(
        file=name,
        workbook=workbook.value,
        verdict=verdict,
        diagnosis=_diagnoses(certain),
        possible=_guessed(findings),
        sheets=sheets,
        rubric=[CriterionAnswer(criterion=one.name, met=one.met, words=str(one.sentence)) for one in rubric],
        notes=[str(one) for one in notes],
        headline=_headline(verdict, judgements),
        unusual=unusual_of(judgements, findings),
    )
    return answer.model_copy(update={"finding": _finding(answer, why, own)})


def short_causes(one: FileAnswer | TypedAnswer) -> list[str]:
    """Short names of the known errors, those that are only possible last."""
    certain = [word(f"name_{cause.error}") for cause in one.diagnosis]
    possible = [word("may_be", error=word(f"name_{cause.error}")) for cause in one.possible]
    return [*certain, *possible]


def _finding(file: FileAnswer, why: Note | None, own: Note | None) -> str:
    """What was found, in a few words. why: wrong numbers have no cause; own: remark on a turn of the team's own"""
    found = [word(f"class_{own.code}")] if own else []
    if file.verdict is Rating.ROUNDED:
        found.append(file.headline)
    found += short_causes(file) or ([str(why)] if why else [])
    cells, missing = (sum(getattr(one, name) for one in file.sheets) for name in ("cells", "missing"))
    if missing:
        found.append(word("class_lacking", missing=f"{missing:,}", cells=f"{cells:,}"))
    return word("and_error").join(found)


def _headline(verdict: Rating, judgements: Sequence[JudgedSheet]) -> str:
    """The verdict on a file, with the decimals to which its numbers are right."""
    if verdict is not Rating.ROUNDED:
        return word(verdict.value)
    least = min((one for one in judgements if one.decimals is not None), key=lambda one: one.decimals or 0)
    return str(_to_decimals(least))


def _to_decimals(one: JudgedSheet) -> Note:
    """To how many decimals the numbers of a sheet are right."""
    words = "rounded_to_decimal" if one.decimals == 1 else "rounded_to_decimals"
    return note(words if one.is_rounded else "right_near", decimals=one.decimals, written=int(one.digits.max()))


def typed(name: str, text: str) -> TypedAnswer:
    """The grade of a typed number. name: one of UNITS; text: as typed, see plain_number(): its digits show its rounding

    raises: InvalidValue
    """
    number, reading = plain_number(name, text, UNITS[name])
    value, (_, digits, exponent) = float(number), Decimal(number).as_tuple()
    if not 0.0 < value < 1e6:
        raise InvalidValue(name, "must be more than 0 and less than 1e6", got=Quantity(value, UNITS[name]))
    decimals = -int(exponent)
    grade = graded_number(name, value, 0.5 * 10.0 ** -min(decimals, 12))
    ungraded = 0 if grade.verdict is Rating.WRONG else max(decimals - DECIMALS_OF_CONTEST, 0)
    count, breaks = len(digits) - ungraded, str(grade.breaks or "")
    notes = [str(one) for one in [*reading, *grade.notes]]
    headline, sentences = word(grade.headline or grade.verdict.value, digits=count), notes
    if grade.verdict is not Rating.RIGHT:
        sentences = [*notes, word("is_right", right=f"{right_answer(name):.9f}", unit=UNITS[name])]
    return TypedAnswer(
        answer=name,
        verdict=grade.verdict,
        breaks=breaks or None,
        found=value,
        expected=right_answer(name),
        unit=UNITS[name],
        digits=count,
        rounded=grade.rounded,
        notes=notes,
        diagnosis=_diagnoses([one for one in grade.findings if one.chance <= CERTAIN]),
        possible=_guessed(grade.findings),
        title=say("{name}: {text}", name=word(name), text=f"{value:.12g} {UNITS[name]}"),
        headline=word("and_breaks", verdict=headline, breaks=breaks) if breaks else headline,
        sentences=sentences,
    )


def _diagnoses(findings: Sequence[Finding]) -> list[DiagnosisAnswer]:
    return [DiagnosisAnswer(error=one.error, words=str(one.sentence), evidence=str(one.evidence)) for one in findings]


def _guessed(findings: Sequence[Finding]) -> list[GuessAnswer]:
    """The findings that are only guesses, with their chances."""
    return [
        GuessAnswer(
            error=one.error,
            words=word("may_be", error=str(one.sentence)),
            evidence=joined([str(one.evidence), word("chance", count=round(1.0 / one.chance))]),
            probability=one.chance,
        )
        for one in findings
        if one.chance > CERTAIN
    ]


def _sheet(one: JudgedSheet) -> SheetAnswer:
    worst, first, notes = one.worst(), one.first(), [*one.notes]
    is_rounded = one.verdict in (Rating.ROUNDED, Rating.INCOMPLETE) and one.decimals is not None
    said = _to_decimals(one) if is_rounded and one.verdict is Rating.ROUNDED else note(one.verdict.value)
    if is_rounded and one.verdict is Rating.INCOMPLETE:
        notes.append(note("given", count=f"{one.cells - one.missing:,}", how=_to_decimals(one)))
    return _worded(
        said,
        shows_cells=one.verdict is Rating.WRONG or (one.verdict is Rating.ROUNDED and not one.is_rounded),
        sheet=str(one.title),
        holds=one.table.kind.value,
        verdict=one.verdict,
        decimals=one.decimals if is_rounded else None,
        cells=one.cells,
        right=one.right,
        rounded=int(one.rounded.sum()),
        missing=one.missing,
        worst=worst and _cell(one, worst),
        first=first and _cell(one, first),
        picture=one.picture(),
        notes=[str(known) for known in notes],
    )


def _worded(said: Note, *, shows_cells: bool, **own: Any) -> SheetAnswer:
    """A sheet with its sentences. said: its verdict; shows_cells: with its worst and first cell; own: other fields"""
    sheet = SheetAnswer(**own)
    line = "sheet_line_rounded" if sheet.rounded else "sheet_line"
    counts = {name: f"{getattr(sheet, name):,}" for name in ("right", "rounded", "cells")}
    title = sheet.sheet or word(SHEETS[TableKind(sheet.holds)])
    sentences = [word(line, title=title, verdict=said, **counts), *sheet.notes]
    cells = {"only": sheet.first} if sheet.first == sheet.worst else {"worst": sheet.worst, "first": sheet.first}
    for name, cell in cells.items():
        if cell and shows_cells:
            values = {"found": f"{cell.found:.6f}", "expected": f"{cell.expected:.6f}", "time": f"{cell.time:.9g}"}
            quantity = word("quantity_speed") if cell.quantity == "speed" else cell.quantity
            sentences.append(word(f"{name}_cell", cell=cell.cell, handle=cell.handle, quantity=quantity, **values))
    return sheet.model_copy(update={"sentences": sentences})


def _cell(one: JudgedSheet, at: tuple[int, ...]) -> CellAnswer:
    t, h, c = at
    row, column = int(one.table.row[at]), int(one.table.column[at])
    return CellAnswer(
        sheet=str(one.title),
        cell=cell_name(row, column),
        row=row + 1,
        column=column + 1,
        handle=handle_titles(BENCHES)[one.handles[h]],
        quantity=("x", "y", "speed")[one.components[c]],
        time=float(one.times[t]),
        found=float(one.values[at]),
        expected=float(one.wanted[at]),
    )


def _lacking(kind: TableKind, cells: int) -> SheetAnswer:
    sentence = word("no_sheet", kind=word(SHEETS[kind]))
    return _worded(
        note("incomplete"), shows_cells=False, sheet="", holds=kind.value, verdict=Rating.INCOMPLETE, decimals=None,
        cells=cells, right=0, missing=cells, worst=None, first=None, picture=[], notes=[sentence],
    )  # fmt: skip
