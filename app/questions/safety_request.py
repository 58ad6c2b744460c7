"""What a safety sheet is asked for: the dance, its lanes, and what it rests on."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Self

import numpy as np
from pydantic import Field

import core
from app.plan.safety_answer import Assumption
from app.questions.plan import GatedDance
from app.wire.dances import PathFields
from app.wire.fields import Address, OneLine, Wire, measure
from app.wire.messages import checked
from app.wire.numbers import numbers_of
from app.wire.paths import Point as PointField
from app.wire.performances import SeveralFields
from core import Area, InvalidValue
from core.errors import Given, format_number
from core.language import say
from core.shapes.engines import lane_rings
from core.values import Floats

# Most lanes of a sheet, and most dragons whose numbers of benches stand on it.
LANES_MAX, DRAGONS_NAMED = 10, 6
# Benches that may be let go if the request does not say how many.
LOOSE = 3


class LaneBody(Wire, strict=True):
    """A lane to keep free, such as one for ambulances."""

    name: OneLine = Field(min_length=1, max_length=40, description="Its name")
    points: list[PointField] = measure("m", "Points of its middle line, x and y", min_length=2, max_length=50)
    width: float = measure("m", "Its width", 3.5, ge=0.5, le=50)

    @classmethod
    def of_text(cls, text: str) -> Self:
        """A lane as NAME,WIDTH,X,Y,X,Y,... raises: InvalidValue"""
        name, *rest = text.split(",")
        if len(rest) < 5 or len(rest) % 2 == 0 or not name:
            raise InvalidValue.in_words("lane", "--lane must be NAME,WIDTH,X,Y,X,Y,... [m]", got=Given(text))
        width, *places = numbers_of("lane", ",".join(rest), float)
        points = [list(pair) for pair in zip(places[::2], places[1::2], strict=True)]
        return checked(cls, {"name": name, "width": width, "points": points})

    @property
    def middle(self) -> Floats:
        """Points of its middle line (P, 2) [m]."""
        return np.array(self.points, dtype=np.float64)

    def to_area(self, field: str) -> Area:
        """The ground of it. raises: InvalidValue"""
        try:
            rings = lane_rings(self.middle, self.width)
            return Area(self.name, tuple(tuple((x, y) for x, y in ring.tolist()) for ring in rings))
        except (InvalidValue, ValueError) as error:
            raise InvalidValue(f"{field}.points", "must be a line with a length") from error


class SafetySheetRequest(SeveralFields, GatedDance, strict=True):
    """A dance, or several on one clock, as for /check, and what its sheet assumes and names."""

    lanes: list[LaneBody] = Field(
        [],
        max_length=LANES_MAX,
        fail_fast=True,
        description="Lanes to keep free, such as those for ambulances; those of the venue follow them",
    )
    spectators: float = measure(
        "m", "Distance at which people stand from all ground that benches may sweep", 1.0, ge=0, le=100
    )
    loose: int | None = Field(
        None, ge=1, description="Number of the last benches that may be let go; default: 3, or all of a shorter dragon"
    )
    reaction: float = measure("s", "Time from the call to stop until everybody stands", 2.0, ge=0, le=60)
    stopper: OneLine = Field("", max_length=80, description="Who stops the dance")
    date: OneLine = Field("", max_length=40, description="Date of the sheet; empty: a line to fill in")
    address: Address = Field(
        "", max_length=500, description="Address of the dance, which stands on the sheet as a code"
    )


def loose_of(request: SafetySheetRequest, dragon: core.Dragon) -> int:
    """Number of the last benches that may be let go."""
    return request.loose or min(LOOSE, dragon.benches)


def assumptions_of(request: SafetySheetRequest, dragons: Sequence[core.Dragon]) -> list[Assumption]:
    """What a sheet rests on, and which of it the request gives."""
    given = request.model_fields_set
    bodies: Sequence[PathFields] = request.dances or [request]
    own = {name for one in bodies for name in one.dragon.model_fields_set}
    moves = {name for one in bodies for name in one.model_fields_set}

    def each(values: Sequence[float]) -> str:
        """The value, or the least and the largest of several."""
        low, high = format_number(min(values)), format_number(max(values))
        return low if low == high else say("{low} to {high}", low=low, high=high)

    lengths = [float(one) for dragon in dragons for one in dragon.lengths]
    sizes = say("{low} to {high} m long", low=format_number(min(lengths)), high=format_number(max(lengths)))
    speed = say("no limit") if request.speed_limit is None else f"{format_number(request.speed_limit)} m/s"
    streets = say("none given") if request.venue is None else say("as drawn")
    benches = " + ".join(str(dragon.benches) for dragon in dragons[:DRAGONS_NAMED])
    if len(dragons) > DRAGONS_NAMED:
        benches += " + …"
    rows = [
        (say("benches"), benches, bool(own & {"benches", "lengths"})),
        (say("sizes of benches"), sizes, bool(own - {"benches", "names"})),
        (
            say("speed of the head"),
            f"{each([one.head_speed for one in bodies])} m/s",
            bool(moves & {"head_speed", "passages", "beats"}),
        ),
        (
            say("people stray at most"),
            f"{format_number(request.total_stray or 0.0)} m",
            bool(given & {"stray", "hole", "pin"}),
        ),
        (say("benches keep apart"), f"{format_number(request.margin)} m", "margin" in given),
        (say("speed limit"), speed, "speed_limit" in given),
        (say("square, streets and obstacles"), streets, request.venue is not None),
        (say("people stand back"), f"{format_number(request.spectators)} m", "spectators" in given),
        (
            say("last benches that may be let go"),
            str(max(loose_of(request, dragon) for dragon in dragons)),
            "loose" in given,
        ),
        (say("time to stop"), f"{format_number(request.reaction)} s", "reaction" in given),
    ]
    return [Assumption(label=label, text=text, yours=yours) for label, text, yours in rows]
