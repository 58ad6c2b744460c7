"""A sweep in a few lines."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass
from typing import Any

import numpy as np
import pyarrow as pa

from app.sweeps.table import Sweep, is_number
from core import InvalidValue
from core.values import Floats


def numbers_of(sweep: Sweep, table: pa.Table, name: str) -> Floats:
    """A column as numbers, NaN where a row has none. raises: InvalidValue for a column without numbers"""
    column = table[name]
    if not is_number(column.type):
        raise InvalidValue("value", f"must be a column of numbers, got {name}: {sweep.numbers()}")
    found: Floats = column.cast(pa.float64()).to_numpy().astype(np.float64)
    return found


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
        found = [("designs", f"{self.rows} of {self.total}")]
        found += [(f"error {code}", str(count)) for code, count in sorted(self.errors.items())]
        for word, end in (("least", self.least), ("greatest", self.greatest)):
            if end is not None:
                place = ", ".join(f"{name} = {at}" for name, at in end[1].items())
                found.append((f"{word} {self.value}", f"{end[0]} at {place}"))
        return found


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
