"""Beats of a drum in requests, which give the speeds of a dance."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Annotated

from pydantic import Field

from app.wire.fields import AS_WHOLE, Wire, measure
from core.people.beats import BARS, IN_BAR, STEP, TEMPO, Bars, Music


class BarsBody(Wire, strict=True):
    """Bars at one tempo, from the end of those before, or from time 0; the head goes one step on each beat."""

    bars: Annotated[int, Field(ge=BARS[0], le=BARS[1]), AS_WHOLE] = Field(description="Number of bars")
    tempo: float = measure("beats/min", "Beats, and so steps, a minute", ge=TEMPO[0], le=TEMPO[1])
    step: float = measure("m", "Way of the head on each beat; 0: it marks time", ge=STEP[0], le=STEP[1])
    beats: Annotated[int, Field(ge=IN_BAR[0], le=IN_BAR[1]), AS_WHOLE] = Field(4, description="Beats in a bar")


def music_of(bodies: Sequence[BarsBody]) -> Music | None:
    """The music of a request; None without beats. raises: InvalidValue

    >>> music_of([BarsBody(bars=2, tempo=120.0, step=0.5)]).passages
    (Passage(speed=1.0, until_s=None, until_time=4.0),)
    """
    return Music([Bars(one.bars, one.tempo, one.step, one.beats) for one in bodies]) if bodies else None
