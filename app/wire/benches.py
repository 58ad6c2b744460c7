"""Benches measured one by one: a table as text, each bench a line, as spreadsheets copy and save it."""

from __future__ import annotations

import csv
import io
import re
from collections.abc import Iterable
from functools import cached_property
from typing import Annotated, Any, NamedTuple

from pydantic import AfterValidator
from pydantic_core import PydanticCustomError

from app.wire.fields import LENGTHS, OVERHANGS, WIDTHS, Wire, check_limit, measure
from app.wire.numbers import number_of
from app.wire.texts import text_of_cell
from core import Dragon, InvalidValue
from core.quantities import Given, Parameter, Quantity, from_to, quantities

# Separators of columns; a table uses the first of these that stands in its first line.
SEPARATORS = "\t;,"
# Names that each column may have; messages use the first one. A column of another name is refused.
WORDS = {
    "name": ("name", "名称", "姓名"),
    "length": ("length", "长度", "长"),
    "width": ("width", "宽度", "宽"),
    "overhang": ("overhang", "孔心距板头", "孔距", "端距"),
}
# Most lines of a table [1]: reading 100,000 takes a second.
LINES_MAX = 200_000
STATED = re.compile(r"sep=([\t;,])")
SIZES = {"length": LENGTHS, "width": WIDTHS, "overhang": OVERHANGS}


class BenchTable(NamedTuple):
    """The columns of a table of benches, head first [m]; lines: number of each one's line"""

    names: list[str]
    lengths: list[float]
    widths: list[float]
    overhangs: list[float]
    lines: list[int]

    def to_dragon(self) -> Dragon:
        """raises: InvalidValue naming the line"""
        for k, (length, overhang) in enumerate(zip(self.lengths, self.overhangs, strict=True)):
            if not overhang < 0.5 * length:
                values = quantities("m", got=overhang, length=length)
                raise _line_error(self.lines[k], "overhang must be less than half of the length, {length}", **values)
        return Dragon.of(self.lengths, self.widths, self.overhangs).named(self.names if any(self.names) else ())


def bench_table(text: str) -> BenchTable:
    """A table with the columns name (which may be missing), length, width and overhang [m], in any order.

    Columns are separated by tabs, semicolons or commas; with semicolons or tabs a decimal comma is read too. Empty
    lines are left out. Without names of columns, the columns are length, width and overhang, after the name if there
    are four.
    raises: InvalidValue, whose message begins with the number of the line

    >>> bench_table("name,length,width,overhang\\nZhou,3.41,0.3,0.275\\n").lengths
    [3.41]
    """
    lines = text.removeprefix("\N{ZERO WIDTH NO-BREAK SPACE}").splitlines()
    if len(lines) > LINES_MAX:
        raise InvalidValue("dragon.csv", "must have at most {most} lines", got=len(lines), most=LINES_MAX)
    first = next((k for k, line in enumerate(lines) if line.strip()), None)
    if first is None:
        raise _line_error(1, "must be the names of columns name,length,width,overhang", got="nothing")
    if stated := STATED.fullmatch(lines[first].strip(" ")):  # Excel states the separator in a line of its own.
        following = (k for k in range(first + 1, len(lines)) if lines[k].strip())
        first = next(following, first)
    separator = stated[1] if stated else next((mark for mark in SEPARATORS if mark in lines[first]), ",")
    heads = _cells(lines[first], separator)
    is_bench = _holds_sizes(heads, separator != ",")
    columns = [*WORDS][-len(heads) :] if is_bench else _columns(heads, first + 1)
    begin = first if is_bench else first + 1
    table = BenchTable([], [], [], [], [])
    for number, line in enumerate(lines[begin:], start=begin + 1):
        cells = _cells(line, separator)
        if not any(cells):
            continue
        if len(cells) > len(columns) and not any(cells[len(columns) :]):
            cells = cells[: len(columns)]
        if len(cells) != len(columns):
            rule = "must have {count} entries, as the first line has"
            raise _line_error(number, rule, got=len(cells), count=len(columns))
        row = dict(zip(columns, cells, strict=True))
        table.names.append(text_of_cell(row.get("name", "")))
        for column, sizes in zip(SIZES, table[1:4], strict=True):
            sizes.append(_size(column, row[column], number, separator != ","))
        table.lines.append(number)
    if not table.lines:
        raise _line_error(first + 2, "must be the first bench, the head", got="nothing")
    return table


def _holds_sizes(cells: list[str], comma: bool) -> bool:
    """True for the cells of a bench in a table without names of columns: three numbers, alone or after a name."""
    return len(cells) in (3, 4) and all(_number(cell, comma) is not None for cell in cells[-3:])


def _number(word: str, comma: bool) -> float | None:
    try:
        return number_of(word.replace(",", ".") if comma else word)
    except ValueError:
        return None


def _cells(line: str, separator: str) -> list[str]:
    try:
        return [cell.strip() for cell in next(csv.reader(io.StringIO(line), delimiter=separator), [])]
    except csv.Error:  # one entry of more than 131,072 characters
        return [line]


def _columns(words: Iterable[str], number: int) -> list[str]:
    """The columns that the first line names."""
    columns = []
    for word in words:
        heading = word.partition("[")[0].partition("(")[0].strip().lower()
        column = next((column for column, known in WORDS.items() if heading in known), None)
        if column is None or column in columns:
            rule = "a column must be named once" if column else "a column must be name, length, width or overhang"
            raise _line_error(number, rule, got=Given(word))
        columns.append(column)
    if missing := [column for column in SIZES if column not in columns]:
        raise _line_error(number, "the column {column} is missing", column=missing[0])
    return columns


def _size(column: str, word: str, number: int, comma: bool) -> float:
    """An entry as a size in metres."""
    size = _number(word, comma)
    if size is None:
        raise _line_error(number, "{field} must be a number in metres", got=Given(word), field=Parameter(column))
    low, high = SIZES[column]
    if low <= size <= high:
        return size
    values = from_to("m", low, high) | quantities("m", got=size, m=size / 100)
    values |= {"field": Parameter(column), "cm": Quantity(size, "cm")}
    hint = "lengths are in metres, and {cm} is {m}" if low <= size / 100 <= high else ""
    raise _line_error(number, "{field} must be from {least} to {most}", reason=hint, **values)


def _line_error(line: int, words: str, **values: Any) -> InvalidValue:
    return InvalidValue.in_words("dragon.csv", f"line {{line}}: {words}", line=line, **values)


def _checked_table(text: str) -> str:
    try:
        bench_table(text).to_dragon()
    except InvalidValue as error:
        raise PydanticCustomError("benches", "no table of benches", {"error": error}) from error
    return text


class BenchCsv(Wire, strict=True):
    """A dragon bench by bench as text, as spreadsheets save and copy it: a line for each bench, head first."""

    csv: Annotated[str, AfterValidator(_checked_table)] = measure(
        "",
        "First line: the names of the columns length, width, overhang [m] and, if benches have names, "
        "name; then a line for each bench. Columns are separated by commas, semicolons or tabs",
        label="Benches measured one by one",
    )

    @cached_property
    def table(self) -> BenchTable:
        return bench_table(self.csv)

    @property
    def benches(self) -> int:
        return len(self.table.lines)

    def to_dragon(self, benches_max: int) -> Dragon:
        """raises: TooLarge, InvalidValue"""
        check_limit(
            "dragon.csv", "benches must be at most {most} here", self.benches, benches_max, "shorten the dragon"
        )
        return self.table.to_dragon()
