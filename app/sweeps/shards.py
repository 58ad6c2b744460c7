"""Shards: parts of a sweep with consecutive designs, and their files in a folder."""

from __future__ import annotations

import os
import re
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any, BinaryIO

import orjson
import pyarrow as pa
import pyarrow.parquet as pq

import core
from app.files.flush import flush_folder, new_file
from app.sweeps.columns import TYPES, Column, answer_columns, value_type
from app.sweeps.designs import designs
from app.sweeps.questions import SweepQuestion, refusal
from app.sweeps.spec import Range, Spec, with_values
from core import BenchDragonError, InvalidValue
from core.language import phrase

PART = re.compile(r"part-(\d{6})\.parquet")
TEMPORARY = ".part-"
# Error code for a design whose process died at each attempt.
KILLED = "killed"
KILLED_MESSAGE = phrase("the process that answered this design died at each attempt")


class OtherVersion(BenchDragonError):
    """A worker runs a different version from the one that began the sweep."""

    code = "other-version"


@dataclass(frozen=True, slots=True)
class ShardPiece:
    """Designs from `start` to before `stop` of one shard of a sweep: the unit of work of an engine."""

    spec: Spec
    question: SweepQuestion
    version: str
    shard: int
    start: int
    stop: int

    @classmethod
    def whole(cls, spec: Spec, question: SweepQuestion, shard: int) -> ShardPiece:
        """A whole shard."""
        return cls(spec, question, core.__version__, shard, *spec.shard(shard))

    def halves(self) -> tuple[ShardPiece, ShardPiece]:
        """The two halves of a piece, which must have more than one design."""
        middle = (self.start + self.stop) // 2
        own = (self.spec, self.question, self.version, self.shard)
        return ShardPiece(*own, self.start, middle), ShardPiece(*own, middle, self.stop)

    def answer(self) -> bytes:
        """The rows of all designs, as an Arrow stream; a refused or failed design gives a row with its error.

        raises: OtherVersion
        """
        if core.__version__ != self.version:
            words = "must be {version} on every worker, as at the start of the sweep"
            raise OtherVersion("bench-dragon", words, got=core.__version__, version=self.version)
        question, request = self.question, self.spec.request
        columns, parameters = kept_columns(self.spec, question), designs(self.spec, self.start, self.stop)
        nothing = (None,) * len(columns)
        rows: list[tuple[Any, ...]] = []
        for values in zip(*parameters.values(), strict=True):
            try:
                answer = question.answer_to(with_values(request, dict(zip(parameters, values, strict=True))))
                rows.append((None, None, *(column.value(answer) for column in columns)))
            except Exception as error:
                rows.append((*refusal(error), *nothing))
        return _stream(self._table(parameters, rows, columns))

    def killed_row(self) -> bytes:
        """The row of a single design whose process died."""
        columns = kept_columns(self.spec, self.question)
        parameters = designs(self.spec, self.start, self.stop)
        return _stream(self._table(parameters, [(KILLED, KILLED_MESSAGE, *(None,) * len(columns))], columns))

    def _table(self, parameters: dict[str, list[Any]], rows: list[tuple[Any, ...]], columns: list[Column]) -> pa.Table:
        """The table of the piece. rows: code and message of the error, then a value for each column"""
        kinds = {"error.code": pa.string(), "error.message": pa.string()}
        kinds |= {column.name: TYPES[column.kind] for column in columns}
        arrays = {"design": pa.array(range(self.start, self.stop), pa.int64())}
        arrays |= {name: _parameter(self.spec, name, values) for name, values in parameters.items()}
        for (name, kind), values in zip(kinds.items(), zip(*rows, strict=True), strict=True):
            arrays[name] = pa.array(values, kind)
        return pa.table(arrays)


def kept_columns(spec: Spec, question: SweepQuestion) -> list[Column]:
    """The columns of the answer, except those that repeat a parameter of the sweep."""
    return [column for column in answer_columns(question.answer, question.left_out) if column.name not in spec.over]


def _parameter(spec: Spec, name: str, values: list[Any]) -> pa.Array:
    """The values of a parameter, in the common type of its values in the sweep; JSON for several types."""
    axis = spec.over[name]
    if isinstance(axis, Range):
        return pa.array(values, pa.float64())
    kind = value_type(axis)
    if kind is str and not all(isinstance(value, str) for value in axis):
        values = [orjson.dumps(value).decode() for value in values]
    return pa.array(values, TYPES[kind])


def _stream(table: pa.Table) -> bytes:
    sink = pa.BufferOutputStream()
    with pa.ipc.new_stream(sink, table.schema) as writer:
        writer.write_table(table)
    return bytes(sink.getvalue())


def part_name(shard: int) -> str:
    """Name of the file of a shard."""
    return f"part-{shard:06d}.parquet"


def write_part(folder: Path, spec: Spec, shard: int, pieces: Iterable[bytes]) -> None:
    """Write the file of a shard from its pieces in order; its bytes do not depend on the division into pieces.

    raises: OSError
    """
    tables = [pa.ipc.open_stream(piece).read_all() for piece in pieces]
    table = pa.concat_tables(tables).combine_chunks()
    marked = table.replace_schema_metadata({"bench-dragon sweep": spec.name, "bench-dragon shard": str(shard)})
    sink = pa.BufferOutputStream()
    pq.write_table(marked, sink, compression="zstd")
    write_durably(folder / part_name(shard), bytes(sink.getvalue()))


def write_durably(file: Path, data: bytes) -> None:
    """Write a file completely or not at all; it is safe on the disk after the return."""
    with written(file) as sink:
        sink.write(data)


@contextmanager
def written(file: Path) -> Iterator[BinaryIO]:
    """A file to write to; it gets its name, safe on the disk, when it is complete. raises: OSError"""
    target = file.resolve()
    with new_file(target.parent, TEMPORARY, target) as sink:
        yield sink
    flush_folder(target.parent)


def parts(folder: Path) -> set[int]:
    """The shards whose files are in a folder."""
    matches = (PART.fullmatch(name) for name in os.listdir(folder))
    return {int(match[1]) for match in matches if match}


@contextmanager
def refusing_damage(file: Path) -> Iterator[None]:
    """Context in which a file is opened and read. raises: InvalidValue for one that is damaged or of another kind;
    OSError of the system"""
    try:
        yield
    except (pa.ArrowException, OSError, UnicodeDecodeError) as error:
        if isinstance(error, OSError) and error.errno is not None:  # it cannot be read at all
            raise
        words = "{file} is damaged or not part of a sweep: remove it and run the sweep again"
        raise InvalidValue.in_words("folder", words, file=str(file)) from error


def checked_part(folder: Path, spec: Spec, shard: int) -> pq.ParquetFile:
    """The file of a shard. raises: InvalidValue for a file of another sweep, or an incomplete one"""
    file = folder / part_name(shard)
    with refusing_damage(file):
        opened = pq.ParquetFile(file)
    if (opened.schema_arrow.metadata or {}).get(b"bench-dragon sweep") != spec.name.encode():
        opened.close()
        words = "{file} belongs to another sweep: remove it and run the sweep again"
        raise InvalidValue.in_words("folder", words, file=str(file))
    return opened
