"""Queries and answers on the disk: arrays of NumPy, a table of CSV. docs/dragon-ccd.md describes both formats."""

from __future__ import annotations

import csv
import json
import os
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from benchmarks.ccd.dances import Record
from benchmarks.ccd.motion import Query
from benchmarks.ccd.queries import CLASSES, Known

# Columns of a query, as in Query and Known.
QUERY = Query._fields
TRUTH = ("kind", "depth", "low", "high")
WHOLE = {"dance": "i4", "kind": "i1", "corner_bench": "i2", "corner": "i1", "edge_bench": "i2", "edge": "i1"}
COLUMNS = ("dance", *QUERY, *TRUTH)
# Ends of a query: answered, not decided by the engine itself, a crash of its process, or no answer in time.
ENDS = ("answered", "undecided", "crash", "hang")
ANSWER = {"touches": "i1", "travel": "f8", "microseconds": "f8", "evaluations": "i4", "end": "i1"}


class Shard(NamedTuple):
    """Some queries with the dances that they are about. dances: by number; columns: by name, see COLUMNS"""

    dances: dict[int, Record]
    columns: dict[str, NDArray[Any]]

    def __len__(self) -> int:
        return len(self.columns["dance"])

    def query(self, k: int) -> Query:
        """One of the queries."""
        return Query(*(self.columns[name][k].item() for name in QUERY))

    def taken(self, rows: NDArray[np.int64]) -> Shard:
        """Some of the queries, with only their dances."""
        columns = {name: column[rows] for name, column in self.columns.items()}
        return Shard({number: self.dances[number] for number in np.unique(columns["dance"]).tolist()}, columns)


def shard_of(dances: dict[int, Record], known: list[Known]) -> Shard:
    """Queries with their truth as columns."""
    rows = [(each.dance, *each.query, each.kind, each.depth, each.low, each.high) for each in known]
    columns = list(zip(*rows, strict=True)) if rows else [()] * len(COLUMNS)
    return Shard(
        dances, {name: np.array(column, WHOLE.get(name, "f8")) for name, column in zip(COLUMNS, columns, strict=True)}
    )


def joined(shards: list[Shard]) -> Shard:
    """All queries of some shards."""
    dances = {number: record for shard in shards for number, record in shard.dances.items()}
    return Shard(dances, {name: np.concatenate([shard.columns[name] for shard in shards]) for name in COLUMNS})


def save(path: Path, arrays: dict[str, NDArray[Any]]) -> None:
    """Write a file of arrays completely or not at all."""
    half = path.with_suffix(".half.npz")
    np.savez_compressed(half, **arrays)
    os.replace(half, path)


def save_shard(path: Path, shard: Shard) -> None:
    """Write queries and, as texts of JSON, their dances."""
    records = [json.dumps({"number": number, **record}) for number, record in shard.dances.items()]
    save(path, {**shard.columns, "dances": np.array(records)})


def load(path: Path) -> dict[str, NDArray[Any]]:
    """The arrays of a file."""
    with np.load(path) as arrays:
        return dict(arrays)


def load_shard(path: Path) -> Shard:
    """The queries of a file."""
    arrays = load(path)
    records = map(json.loads, arrays.pop("dances").tolist())
    return Shard({record.pop("number"): record for record in records}, arrays)


def save_csv(path: Path, shard: Shard) -> None:
    """Write queries as CSV, classes by name, and the dances beside them, one a line of JSON."""
    with path.open("w", encoding="utf-8", newline="") as file:
        table = csv.writer(file, lineterminator="\n")
        table.writerow(COLUMNS)
        for k in range(len(shard)):
            row = {name: shard.columns[name][k].item() for name in COLUMNS}
            table.writerow([CLASSES[row["kind"]] if name == "kind" else row[name] for name in COLUMNS])
    lines = [json.dumps({"number": number, **record}) for number, record in shard.dances.items()]
    path.with_suffix(".dances.jsonl").write_text("\n".join([*lines, ""]), encoding="utf-8")
