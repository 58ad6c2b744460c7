"""Parts that answers share: places, pairs, the end of a run, the engines' verdicts, and columns of numbers.

A trajectory has 200,000 numbers, so orjson writes tables as whole numpy columns, not cell by cell.
"""

from __future__ import annotations

import threading
from dataclasses import dataclass
from typing import Any, Literal, Self

import numpy as np
import orjson
from pydantic import Field

import core
from app.wire.fields import Answer, measure
from core import Engine
from core.values import Pair, Point

LEFT_OUT = (
    "Engines that were not asked because they cannot judge this case: the angle sum sees only corners inside a "
    "bench, so it cannot judge a margin or, at the start, benches that cross without a corner inside the other"
)
# Field of an answer that people read.
SENTENCES: Any = Field(description="The answer in sentences for people")
# Field of an answer that allows for a stray.
TOTAL_STRAY: Any = measure(
    "m", "Largest distance of a hole from its place, by people and by play, in this answer; null: none was asked for"
)


class Polygon(Answer):
    """A polygon as in GeoJSON.

    type: polygon
    coordinates: its outer ring, then its holes: closed, points x and y [m]
    """

    type: Literal["Polygon"]
    coordinates: list[list[Point]]


class MultiPolygon(Answer):
    """Several polygons as in GeoJSON.

    type: multiPolygon
    coordinates: the rings of each polygon: closed, points x and y [m]
    """

    type: Literal["MultiPolygon"]
    coordinates: list[list[list[Point]]]


class DragonPair(Answer):
    """Two benches of two dragons.

    dragons: the dragons, in the order of the dances
    benches: a bench of each
    """

    dragons: Pair
    benches: Pair

    @classmethod
    def of(cls, pair: tuple[Pair, Pair]) -> Self:
        return cls(dragons=pair[0], benches=pair[1])


class OwnedFeature(Answer, of=core.Feature):
    """A corner or an edge of one bench of one dragon.

    dragon: number of the dragon, in the order of the dances
    """

    bench: int
    name: str
    dragon: int


class EncounterCheck(Answer, of=core.EncounterCheck, leave=()):
    """Verdicts of independent engines on the benches of several dragons; within the margin counts as overlapping."""

    agree: bool
    judged: list[list[int]]
    engines: dict[Engine, core.Verdict]
    together: list[DragonPair]
    left_out: list[Engine]

    @classmethod
    def of(cls, check: core.EncounterCheck) -> Self:
        return cls.from_result(check, together=[DragonPair.of(pair) for pair in check.together])


# orjson holds the interpreter while it writes, 40 ms for the largest answer: several in turn let others in between.
_WRITING = threading.Lock()


@dataclass(frozen=True, slots=True)
class Columns:
    """Columns as numpy arrays; other values are written unchanged.

    decimals: of every column except time; None writes the shortest text that reads back as the same double
    """

    columns: dict[str, Any]
    decimals: int | None = None

    def to_json(self) -> bytes:
        ready = {name: self._ready(name, column) for name, column in self.columns.items()}
        with _WRITING:
            return orjson.dumps(ready, option=orjson.OPT_SERIALIZE_NUMPY)

    def _ready(self, name: str, column: Any) -> Any:
        if isinstance(column, list):
            return [self._ready(name, one) for one in column]
        if isinstance(column, dict):
            return {inner: self._ready(inner, one) for inner, one in column.items()}
        if not isinstance(column, np.ndarray):
            return column
        # orjson writes null for NaN; a mistake of ours must be an error instead.
        assert np.isfinite(column).all(), f"{name} must be finite"
        if self.decimals is not None and name != "time":
            column = np.round(column, self.decimals) + 0.0
        return np.ascontiguousarray(column)
