"""The table of a sweep: all rows in the order of the designs, from the parts or from the joined file; its summary."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from itertools import chain
from pathlib import Path
from typing import TYPE_CHECKING, Any, BinaryIO

import numpy as np
import orjson
import pyarrow as pa
import pyarrow.compute as pc
import pyarrow.csv as pa_csv
import pyarrow.parquet as pq

import core
from app.files.tables import CSV_TYPE, PARQUET_TYPE
from app.sweeps import shards
from app.sweeps.columns import answer_columns
from app.sweeps.questions import QUESTIONS
from app.sweeps.run import SPEC_FILE, TABLE_FILE, missing_shards
from app.sweeps.spec import Spec
from app.wire.messages import known_units
from app.wire.question import JSON
from app.wire.texts import TO_CELL
from core import InvalidValue
from core.language import Listed, counted, say
from core.quantities import Given
from core.tables import data_frame, polars_frame
from core.values import Floats

if TYPE_CHECKING:
    import pandas
    import polars

# Rows in a group of the joined file: the smallest part that can be read.
GROUP = 100_000


def is_number(kind: pa.DataType) -> bool:
    return bool(pa.types.is_floating(kind) or pa.types.is_integer(kind))


@dataclass(frozen=True, slots=True)
class Sweep:
    """A sweep in its folder."""

    folder: Path
    spec: Spec

    @classmethod
    def open(cls, folder: Path) -> Sweep:
        """The sweep in a folder. raises: InvalidValue if it has none, or one of a different version"""
        file = folder / SPEC_FILE
        try:
            content = orjson.loads(file.read_bytes())
            version = content.pop("version")
            spec = Spec.model_validate(content | {"over": dict(content["over"])})
        except (OSError, ValueError, KeyError, TypeError) as error:
            words = "{folder} has no sweep: it holds no valid {file}"
            raise InvalidValue.in_words("folder", words, folder=str(folder), file=SPEC_FILE) from error
        if version != core.__version__:
            rule = "{folder} must be of this version, {ours}: run the sweep into a new folder"
            raise InvalidValue("folder", rule, got=str(version), folder=str(folder), ours=core.__version__)
        return cls(folder, spec)

    @property
    def missing(self) -> int:
        """Number of shards without rows."""
        return len(missing_shards(self.folder, self.spec))

    def tables(self, columns: Sequence[str] | None = None) -> Iterator[pa.Table]:
        """The available rows, shard by shard. columns: to read. raises: InvalidValue"""
        whole = self.folder / TABLE_FILE
        if whole.exists():
            with shards.refusing_damage(whole):
                yield from rows_of(whole, columns)
            return
        for shard in sorted(shards.parts(self.folder)):
            opened = shards.checked_part(self.folder, self.spec, shard)
            with shards.refusing_damage(self.folder / shards.part_name(shard)), opened:
                yield opened.read(columns=columns)

    def table(self, columns: Sequence[str] | None = None) -> pa.Table:
        """The available rows. raises: InvalidValue if there are none, or no such column"""
        tables = list(self.tables(columns))
        if not tables:
            words = "{folder} has no rows yet: run the sweep"
            raise InvalidValue.in_words("folder", words, folder=str(self.folder))
        for name in columns or ():
            if name not in tables[0].column_names:
                rule = "must be a column of the sweep: {numbers}"
                raise InvalidValue("value", rule, got=Given(name), numbers=self.numbers())
        return pa.concat_tables(tables)

    def numbers(self) -> Listed:
        """Names of the columns of numbers, for messages."""
        return Listed(field.name for field in next(self.tables()).schema if is_number(field.type))

    def to_dataframe(self, columns: Sequence[str] | None = None) -> pandas.DataFrame:
        """One row for each answered design. raises: ImportError without pandas, naming the extra; InvalidValue"""
        question = self.spec.asks if self.spec.question in QUESTIONS else None  # a caller's own is unknown here
        answered = answer_columns(question.answer) if question else ()
        units = known_units() | {column.name: column.unit for column in answered}
        return data_frame("Sweep.to_dataframe()", self._arrays(columns), units)

    def to_polars(self, columns: Sequence[str] | None = None) -> polars.DataFrame:
        """One row for each answered design. raises: ImportError without Polars, naming the extra; InvalidValue"""
        return polars_frame("Sweep.to_polars()", self._arrays(columns))

    def _arrays(self, columns: Sequence[str] | None) -> dict[str, np.ndarray[Any, Any]]:
        table = self.table(columns)
        return {name: table[name].to_numpy() for name in table.column_names}

    def compact(self) -> Path:
        """Join all parts into one file, which replaces them; its bytes do not depend on the division of work.

        raises: InvalidValue if parts are missing
        """
        whole = self.folder / TABLE_FILE
        if not whole.exists():
            self.save(whole, PARQUET_TYPE)
        for shard in shards.parts(self.folder):
            (self.folder / shards.part_name(shard)).unlink()
        return whole

    def to_csv(self, file: Path) -> None:
        """Write the table as CSV. raises: as save()"""
        self.save(file, CSV_TYPE)

    def save(self, file: Path, form: str) -> None:
        """Write the table as Parquet, CSV, JSON or Arrow, completely or not at all. form: media type

        raises: InvalidValue if parts are missing; OSError
        """
        self._check_complete()
        with shards.written(file) as sink:
            write_rows(sink, form, self.tables, self.spec.name)

    def _check_complete(self) -> None:
        if self.missing:
            words = "{folder} lacks {missing} of {shards}: run the sweep again"
            whole = counted(self.spec.shards, "{count} shard", "{count} shards")
            raise InvalidValue.in_words("folder", words, folder=str(self.folder), missing=self.missing, shards=whole)


def rows_of(file: Path, columns: Sequence[str] | None = None) -> Iterator[pa.Table]:
    """The rows of a joined file, group by group. columns: to read"""
    with pq.ParquetFile(file) as opened:
        for group in range(opened.num_row_groups):
            yield opened.read_row_group(group, columns=columns)


def cells_of(file: Path) -> int:
    """Number of cells of a joined file."""
    with pq.ParquetFile(file) as opened:
        return int(opened.metadata.num_rows * opened.metadata.num_columns)


Rows = Callable[[Sequence[str] | None], Iterator[pa.Table]]


def write_rows(sink: BinaryIO, form: str, rows: Rows, name: str) -> None:
    """Write rows as Parquet, CSV, JSON with a list for each column, or Arrow. form: media type

    rows: function of the names of columns, or None for all, that gives them; name: of the sweep, in its Parquet file
    """
    if form == JSON:
        for k, column in enumerate(next(rows(None)).column_names):
            sink.write((b"," if k else b"{") + orjson.dumps(column) + b":")
            sink.write(orjson.dumps(pa.concat_tables(rows([column]))[column].to_pylist()))
        sink.write(b"}")
        return
    open_writer: Callable[..., Any] = pa.ipc.new_file
    tables = rows(None)
    if form == PARQUET_TYPE:
        open_writer = partial(pq.ParquetWriter, compression="zstd")
        tables = (table.replace_schema_metadata({"bench-dragon sweep": name}) for table in _in_groups(tables))
    elif form == CSV_TYPE:
        open_writer = pa_csv.CSVWriter
        tables = map(without_formulas, tables)
    first = next(tables)
    with open_writer(sink, first.schema) as writer:
        for table in chain([first], tables):
            writer.write_table(table)


def _in_groups(tables: Iterator[pa.Table]) -> Iterator[pa.Table]:
    """The same rows in tables of at least GROUP rows, except the last."""
    held: list[pa.Table] = []
    for table in tables:
        held.append(table)
        if sum(one.num_rows for one in held) >= GROUP:
            yield pa.concat_tables(held).combine_chunks()
            held = []
    if held:
        yield pa.concat_tables(held).combine_chunks()


def numbers_of(sweep: Sweep, table: pa.Table, name: str) -> Floats:
    """A column as numbers, NaN where a row has none. raises: InvalidValue for a column without numbers"""
    column = table[name]
    if not is_number(column.type):
        raise InvalidValue(
            "value", "must be a column of numbers: {numbers}", got=Given(name, name), numbers=sweep.numbers()
        )
    numbers: Floats = column.cast(pa.float64()).to_numpy().astype(np.float64)
    return numbers


@dataclass(frozen=True, slots=True)
class Summary:
    """A sweep in a few lines.

    rows: number of designs answered so far; total: number of designs; errors: number of rows by code
    value: name of a column; least, greatest: its extreme values with their designs, None without a number
    """

    rows: int
    total: int
    errors: dict[str, int]
    value: str
    least: tuple[float, dict[str, Any]] | None
    greatest: tuple[float, dict[str, Any]] | None

    def lines(self) -> list[tuple[str, str]]:
        """Names and values as text."""
        lines = [(say("designs"), say("{rows} of {total}", rows=self.rows, total=self.total))]
        lines += [(say("error {code}", code=code), str(count)) for code, count in sorted(self.errors.items())]
        ends = (
            (say("least {value}", value=self.value), self.least),
            (say("greatest {value}", value=self.value), self.greatest),
        )
        for name, end in ends:
            if end is not None:
                place = Listed(f"{parameter} = {at}" for parameter, at in end[1].items())
                lines.append((name, say("{number} at {place}", number=end[0], place=place)))
        return lines


def summary(sweep: Sweep, value: str) -> Summary:
    """The sweep in a few lines. raises: InvalidValue if there is no row, or no such column of numbers"""
    table = sweep.table([*sweep.spec.over, "error.code", value])
    numbers = numbers_of(sweep, table, value)
    codes = Counter(code for code in table["error.code"].to_pylist() if code)
    least = greatest = None
    if np.isfinite(numbers).any():
        least, greatest = (
            (float(numbers[k]), {name: table[name][k].as_py() for name in sweep.spec.over})
            for k in (int(np.nanargmin(numbers)), int(np.nanargmax(numbers)))
        )
    return Summary(table.num_rows, sweep.spec.designs, dict(codes), value, least, greatest)


def without_formulas(table: pa.Table) -> pa.Table:
    """A table whose texts no spreadsheet takes for formulas: as text_to_cell()."""
    for k, field in enumerate(table.schema):
        if pa.types.is_string(field.type) or pa.types.is_large_string(field.type):
            cells = pc.replace_substring_regex(table.column(k), TO_CELL, r"\1'\2")
            table = table.set_column(k, field, cells)
    return table
