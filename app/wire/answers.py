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
from app.wire.question import Answer, measure
from core import Engine

Pair = tuple[int, int]
Point = tuple[float, float]
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


class Head(Answer):
    """Handle 0 at first contact."""

    theta: float | None = measure("rad", "Polar angle on a spiral, unwrapped; null on any other path")
    radius: float = measure("m", "Distance from the origin, which is the centre of a spiral")
    x: float = measure("m")
    y: float = measure("m")


class Feature(Answer):
    """A corner or an edge of one bench."""

    bench: int = Field(description="Number of the bench; 0 is the head")
    name: str = Field(
        description="front or rear (towards the lower or higher handle), outer or inner (seen from the centre), or both"
    )


class End(Answer):
    """End of a run on which no two benches come within the margin, or touch if it is 0."""

    reason: core.EndReason = Field(
        description="fold: a bench cannot follow any more; centre: the head reaches the centre; end: the path ends; "
        "stop: the requested time ends"
    )
    time: float = measure("s")
    theta: float | None = measure("rad", "Polar angle of the head at that time, on a spiral that folds or ends")
    bench: int | None = Field(description="The bench that folds; null if none does")


class Graze(Answer):
    """A local minimum of the clearance over time."""

    time: float = measure("s")
    clearance: float = measure("m")
    benches: Pair = Field(description="The pair")


class Polygon(Answer):
    """A polygon as in GeoJSON."""

    type: Literal["Polygon"] = Field(description="Polygon")
    coordinates: list[list[Point]] = measure("m", "Its outer ring, then its holes: closed, points x and y")


class MultiPolygon(Answer):
    """Several polygons as in GeoJSON."""

    type: Literal["MultiPolygon"] = Field(description="MultiPolygon")
    coordinates: list[list[list[Point]]] = measure("m", "The rings of each polygon: closed, points x and y")


class Verdict(Answer):
    """Findings of one engine among the benches judged, without pairs of neighbours."""

    before: bool | None = Field(
        description="Whether it finds any two overlapping, or within the margin, just before; null for a contact "
        "at the start"
    )
    after: bool = Field(
        description="Whether it finds the reported pair overlapping, or within the margin, just after, and no "
        "other pairs except those in together. For a contact at the start other pairs are allowed"
    )


class PairCheck(Answer):
    """Verdicts of independent engines just before and just after; within the margin counts as overlapping."""

    agree: bool = Field(description="True if every engine asked finds nothing before, and only the reported pair after")
    judged: list[int] = Field(
        description="Benches judged: all, or only those near the pair, or the pair, if there are more than 2,000 or "
        "they are very crowded; with cross_check=pair only the pair"
    )
    engines: dict[Engine, Verdict] = Field(
        description="Verdict of each engine; angle_sum cannot judge a margin, so it is asked only if the margin is 0"
    )
    together: list[Pair] = Field(
        description="Other pairs that come within the margin, or touch if it is 0, at the same time as the "
        "reported one, as when a corner meets two benches of a straight row at once: apart just before, and barely "
        "within the margin just after"
    )
    left_out: list[Engine] = Field(description=LEFT_OUT)


class DragonPair(Answer):
    """Two benches of two dragons."""

    dragons: Pair = Field(description="The dragons, in the order of the dances")
    benches: Pair = Field(description="A bench of each")

    @classmethod
    def of(cls, pair: tuple[Pair, Pair]) -> Self:
        return cls(dragons=pair[0], benches=pair[1])


class EncounterCheck(Answer):
    """Verdicts of independent engines on the benches of several dragons; within the margin counts as overlapping."""

    agree: bool = Field(description="True if every engine asked finds nothing before, and only the reported pair after")
    judged: list[list[int]] = Field(
        description="Benches judged, a list for each dragon: all, or only those near the pair if there are more than "
        "2,000 or they are very crowded; with cross_check=pair or a stray only the pair"
    )
    engines: dict[Engine, Verdict] = Field(
        description="Verdict of each engine; angle_sum cannot judge a margin, so it is asked only if the margin is 0"
    )
    together: list[DragonPair] = Field(
        description="Other pairs that come within the margin, or touch if it is 0, at the same time as the reported one"
    )
    left_out: list[Engine] = Field(description=LEFT_OUT)

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
