"""The command bench-dragon grade: right and wrong parts of contest workbooks, and the error behind each wrong one."""

from __future__ import annotations

import csv
import errno
import hashlib
import io
from collections.abc import Iterator, Sequence
from contextlib import nullcontext
from pathlib import Path
from typing import Annotated

import typer

from app.command import show
from app.command.options import Json
from app.extras import require
from app.files.disk import checked_output, ending_of, write_whole
from app.files.workbooks import table_workbook
from app.grade.class_table import ClassRow, alike, rubric_of, scheme, team_most, team_points
from app.grade.judged import MISSING, WRONG
from app.grade.reading import FILE_MAX
from app.grade.report import (
    DiagnosisAnswer,
    FileAnswer,
    GradeAnswer,
    SheetAnswer,
    TypedAnswer,
    graded,
    short_causes,
    typed,
    unreadable,
)
from app.grade.words import Note, note, word
from app.processes.limits import READING_MAX, reading
from app.wire.fields import ESCAPED
from app.wire.labels import Heading, Part, TextTable
from app.wire.texts import text_to_cell
from core import Budget, InvalidValue, TooMuchWork
from core.language import Listed, say

# Endings of the files that are graded in a folder, and of those that are graded where a folder has no others: of what
# is handed in instead, for which there is a sentence.
ENDINGS = (".xlsx", ".xlsm", ".xls", ".csv")
INSTEAD = (".png", ".jpg", ".jpeg", ".pdf", ".doc", ".docx", ".numbers", ".et", ".ods")
SUMMARY = ("file", "workbook", "verdict", "cells", "right", "missing", "diagnosis", "decimals")


def grade(
    files: Annotated[
        list[Path] | None,
        typer.Argument(
            metavar="[FILE]...", help="result1.xlsx, result2.xlsx, result4.xlsx, or CSV; or folders of many students."
        ),
    ] = None,
    collision_time: Annotated[str | None, typer.Option(help="Answer to question 2: time of first contact [s]")] = None,
    pitch: Annotated[str | None, typer.Option(help="Answer to question 3: minimum pitch [m]")] = None,
    turn_length: Annotated[str | None, typer.Option(help="Answer to question 4: length of the turn [m]")] = None,
    speed: Annotated[str | None, typer.Option(help="Answer to question 5: maximum speed of the head [m/s]")] = None,
    summary: Annotated[
        Path | None, typer.Option(help="Write a .csv or .xlsx file with one line for each number and file.")
    ] = None,
    rubric: Annotated[
        Path | None,
        typer.Option(help="Points as a CSV that a teacher edits, as the page saves it: points of all teams."),
    ] = None,
    json: Json = False,
) -> None:
    """Right and wrong parts of a student's results, with the known error behind each wrong one. The exit code is 0."""
    if summary and checked_output("summary", summary, (".csv", ".xlsx")) == ".xlsx":
        require("xlsx", "summary", "xlsx")
    points = None if rubric is None else rubric_of(rubric.read_text("utf-8-sig", errors="replace"))
    grading = say("grading")
    numbers = {"collision_time": collision_time, "pitch": pitch, "turn_length": turn_length, "speed": speed}
    typed_numbers = {name: text for name, text in numbers.items() if text is not None}
    paths = list(_paths_of(files or []))
    if not paths and not typed_numbers:
        raise InvalidValue.in_words("files", "give at least one FILE or one number, such as --pitch 0.45")
    # A team has a folder, unless all files lie in one, or in the folder of the class itself.
    parents = {path.parent for path in paths}
    shared = {*(files or [])} | (parents if len(parents) == 1 else set())
    answers = [typed(name, text) for name, text in typed_numbers.items()]
    grades: list[FileAnswer] = []
    rows: list[ClassRow] = []
    refused = []
    with show.steps() if len(paths) > 1 else nullcontext(lambda what, share: None) as progress:
        for k, file in enumerate(paths):
            name = str(file).translate(ESCAPED)  # A name may come from a student.
            try:
                # One byte beyond the limit shows that the file is too long.
                with file.open("rb") as source:
                    data = source.read(FILE_MAX + 1)
            except OSError as error:
                refused.append(error)
                grades.append(unreadable(name, note("not_opened", why=_why(error))))
            else:
                grades.append(_graded(name, data))
                team = file.stem if file.parent in shared else file.parent.name
                rows.append(_row_of(file, team, grades[-1], data))
            progress(grading, (k + 1) / len(paths))
    if refused and len(refused) == len(paths) and not answers:
        raise refused[0]
    answer = GradeAnswer(files=grades, answers=answers)
    if summary:
        as_file = _workbook if ending_of(summary) == ".xlsx" else _csv
        write_whole(summary, as_file(answer))
    parts = [*_parts(answer), *(_teams(rows, points) if points else ()), *alike(rows)]
    show.print_result(answer, json, iter(parts))


def _why(error: OSError) -> Note | str | None:
    """Why a file cannot be opened."""
    code = {errno.ENOENT: "file_missing", errno.EACCES: "file_forbidden", errno.EISDIR: "file_folder"}.get(
        error.errno or 0
    )
    return note(code) if code else error.strerror


def _row_of(file: Path, team: str, graded: FileAnswer, data: bytes) -> ClassRow:
    """A file on the table of its class."""
    cells, right, missing = _counts(graded)
    return ClassRow(
        team.translate(ESCAPED),
        file.name.translate(ESCAPED),
        graded.workbook,
        graded.verdict,
        cells,
        right,
        missing,
        digest=hashlib.sha256(data).hexdigest(),
        rounded=sum(one.rounded for one in graded.sheets),
        unusual=tuple(graded.unusual),
    )


def _teams(rows: Sequence[ClassRow], rubric: dict[str, float]) -> Iterator[Part]:
    table, most = TextTable(word("class_sheet"), word("class_team"), word("class_points")), team_most(rows, rubric)
    for team, value in team_points(rows, rubric):
        table.add(team, word("class_points_of", points=f"{value:g}", most=f"{most:g}"))
    yield table
    yield scheme(rubric)


def _graded(name: str, data: bytes) -> FileAnswer:
    """The grade of one file; one that needs too much memory does not stop the grading of the others."""
    try:
        with reading():
            return graded(name, data, Budget())
    except TooMuchWork:
        return unreadable(name, note("memory", most=f"{READING_MAX / 1e6:.0f}"))


def _paths_of(files: list[Path]) -> Iterator[Path]:
    """Files to grade; those of a folder sorted by path. raises: InvalidValue for a folder without any"""
    for file in files:
        if file.is_dir():
            inside = sorted(path for path in file.rglob("*") if path.suffix.lower() in ENDINGS + INSTEAD)
            visible = [path for path in inside if not path.name.startswith(("~$", ".")) and path.is_file()]
            full = {path.parent for path in visible if path.suffix.lower() in ENDINGS}
            visible = [path for path in visible if path.suffix.lower() in ENDINGS or path.parent not in full]
            if not visible:
                words, values = "{folder} must hold a file that ends in {endings}", {"endings": Listed(ENDINGS)}
                raise InvalidValue.in_words("files", words, got="a folder without any", folder=str(file), **values)
            yield from visible
        else:
            yield file


def _heads() -> list[str]:
    return [word(f"column_{name}") for name in SUMMARY]


def _row(file: FileAnswer) -> list[str | int]:
    """Cells of a file under the heads of a summary."""
    errors = word("and_error").join(short_causes(file))
    verdict = word(file.verdict.value)
    return [file.file, file.workbook or "", verdict, *_counts(file), errors, _decimals(file)]


def _typed_row(one: TypedAnswer) -> list[str | int]:
    """Cells of a number under the heads of a summary; a limit that it breaks comes before the causes."""
    name = say("{name}: {text}", name=word(one.answer), text=f"{one.found:.12g} {one.unit}")
    reasons = word("and_error").join([*([one.breaks] if one.breaks else []), *short_causes(one)])
    return [name, "", word(one.verdict.value), "", "", "", reasons, ""]


def _rows(answer: GradeAnswer) -> list[list[str | int]]:
    numbers = (_typed_row(one) for one in answer.answers)
    return [*numbers, *(_row(file) for file in answer.files)]


def _csv(answer: GradeAnswer) -> bytes:
    sink = io.StringIO()
    writer = csv.writer(sink)
    writer.writerow(_heads())
    for name, *cells in _rows(answer):
        writer.writerow([text_to_cell(str(name)), *cells])
    return sink.getvalue().encode("utf-8-sig")


def _workbook(answer: GradeAnswer) -> bytes:
    return table_workbook(word("summary"), _heads(), _rows(answer))


def _counts(file: FileAnswer) -> tuple[int, int, int]:
    sheets = file.sheets
    return sum(one.cells for one in sheets), sum(one.right for one in sheets), sum(one.missing for one in sheets)


def _decimals(file: FileAnswer) -> int | str:
    """Number of decimals to which the numbers of a file are right, if they are rounded."""
    return min((one.decimals for one in file.sheets if one.decimals), default="")


def _parts(answer: GradeAnswer) -> Iterator[Part]:
    for one in answer.answers:
        yield from _typed(one)
    for file in answer.files:
        yield from _file(file)
    if len(answer.files) > 1:
        table = TextTable(word("summary"), *_heads())
        for file in answer.files:
            table.add(*(f"{cell:,}" if isinstance(cell, int) else cell for cell in _row(file)))
        yield table


def _typed(one: TypedAnswer) -> Iterator[Part]:
    yield Heading(say("{name}: {text}", name=one.title, text=one.headline))
    yield from (f"  {words}" for words in one.sentences)
    yield from _diagnosis([*one.diagnosis, *one.possible])
    yield ""


def _file(file: FileAnswer) -> Iterator[Part]:
    yield Heading(say("{name}: {text}", name=file.file, text=file.headline))
    yield from (f"  {one}" for one in file.notes)
    for sheet in file.sheets:
        yield from _sheet(sheet)
    yield from _diagnosis([*file.diagnosis, *file.possible])
    marks = {True: "+", False: "-", None: " "}
    yield from (f"  [{marks[one.met]}] {one.words}" for one in file.rubric)
    yield ""


def _sheet(sheet: SheetAnswer) -> Iterator[Part]:
    yield from (f"  {'  ' if k else ''}{one}" for k, one in enumerate(sheet.sentences))
    marks = set("".join(sheet.picture))
    # Marks that are all alike do not show where the errors are.
    if len(marks) > 1 and marks & {WRONG, MISSING}:
        yield from (f"    {line}" for line in sheet.picture)


def _diagnosis(diagnosis: Sequence[DiagnosisAnswer]) -> Iterator[Part]:
    for one in diagnosis:
        yield f"  > {one.words}"
        yield f"    {one.evidence}"
