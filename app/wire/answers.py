"""What answers share: places, pairs, the end of a run, the engines' verdicts, and columns of numbers.

A trajectory has 200,000 numbers, so tables leave as columns of numpy through orjson, not cell by cell.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import orjson
from pydantic import Field

import core
from app.wire.models import Answer, measure
from core import Engine

Pair = tuple[int, int]
Point = tuple[float, float]
LEFT_OUT = (
    "Engines that were not asked, as they cannot judge this: the angle sum looks at corners alone, so it knows no "
    "margin, and at the start no benches that cross with no corner of one inside the other"
)


class Head(Answer):
    """Handle 0 at first contact."""

    theta: float | None = measure("rad", "Polar angle on a spiral, unwrapped; null on any other path")
    radius: float = measure("m", "Distance from the origin, where a spiral has its centre")
    x: float = measure("m")
    y: float = measure("m")


class Feature(Answer):
    """A corner or an edge of one bench."""

    bench: int = Field(description="Bench, 0 is the head")
    name: str = Field(
        description="Made of front, rear (towards the lower, higher handle), outer, inner (from the centre)"
    )


class End(Answer):
    """Where a run ends on which nothing comes nearer than the margin, or touches if it is 0."""

    reason: core.EndReason = Field(
        description="fold: a bench cannot follow any more; centre: the head arrived; end: the path ends; stop: the "
        "time asked for is over"
    )
    time: float = measure("s")
    theta: float | None = measure("rad", "Polar angle of the head then, on a spiral that folds or ends")
    bench: int | None = Field(description="The bench that folds; null if none does")


class Graze(Answer):
    """A local minimum of the clearance over time."""

    time: float = measure("s")
    clearance: float = measure("m")
    benches: Pair = Field(description="The pair")


class Verdict(Answer):
    """What an engine finds among the benches judged, neighbours aside."""

    before: bool | None = Field(
        description="Does it find any two overlapping, or nearer than the margin, just before? null for a contact "
        "at the start, before which there is nothing"
    )
    after: bool = Field(
        description="Does it find the reported pair overlapping, or nearer than the margin, just after, and no other "
        "but those of together? At the start others may be so too"
    )


class PairCheck(Answer):
    """Independent engines on the dance just before and just after; nearer than the margin counts as overlapping."""

    agree: bool = Field(description="Every engine asked finds nothing before, and after the reported pair alone")
    judged: list[int] = Field(
        description="The benches judged: all; of more than 2,000, or very crowded ones, those near the pair, or the "
        "pair; with cross_check=pair the pair"
    )
    engines: dict[Engine, Verdict] = Field(
        description="Each engine's verdict; angle_sum knows no margin, so it is asked only where that is 0"
    )
    together: list[Pair] = Field(
        description="Other pairs that come nearer than the margin, or touch if it is 0, with the reported one, as "
        "where a corner meets two benches of a straight row at once: apart just before, and hardly within the margin "
        "just after"
    )
    left_out: list[Engine] = Field(description=LEFT_OUT)


@dataclass(frozen=True, slots=True)
class Columns:
    """Columns of numpy; what is no array goes out as it is.

    decimals: of every column but time; None writes the shortest text that reads back as the same double
    """

    columns: dict[str, Any]
    decimals: int | None = None

    def to_json(self) -> bytes:
        """One JSON object."""
        return orjson.dumps(
            {name: self._ready(name, column) for name, column in self.columns.items()},
            option=orjson.OPT_SERIALIZE_NUMPY,
        )

    def _ready(self, name: str, column: Any) -> Any:
        if not isinstance(column, np.ndarray):
            return column
        # orjson writes null for NaN; a mistake of ours must be an error instead.
        assert np.isfinite(column).all(), f"{name} must be finite"
        if self.decimals is not None and name != "time":
            column = np.round(column, self.decimals) + 0.0
        return np.ascontiguousarray(column)
