"""The answer of a safety sheet, and the lanes that it is asked about."""

from __future__ import annotations

from typing import Self

import numpy as np
from pydantic import Field

import core
from app.wire.answers import MultiPolygon, Point, Polygon
from app.wire.fields import Answer, OneLine, Wire, measure
from app.wire.messages import checked
from app.wire.numbers import numbers_of
from app.wire.paths import Point as PointField
from core import Area, InvalidValue, Judgement
from core.quantities import Given
from core.shapes.engines import lane_rings
from core.values import Floats


class Assumption(Answer):
    """One value that the sheet rests on."""

    label: str = Field(description="What it is, in the language asked for")
    text: str = Field(description="The value with its unit")
    yours: bool = Field(description="True: the request sets it; false: it is assumed, or is the default")


class Approach(Answer):
    """How near a bench comes to another one, or to an edge of the venue, with everybody in place."""

    distance: float = measure("m", "Smallest distance found")
    at_least: float | None = measure("m", "Proven lower bound; null: none was proven")
    time: float = measure("s", "Time of the smallest distance")
    dragons: list[int] = Field(description="The dragon of each of these benches, in the order of the dances")
    benches: list[int] = Field(description="The two benches, or the one that comes near the edge")
    area: str | None = Field(description="Name of the area; null for two benches")
    point: Point = measure("m", "Place: of the bench's point, or between both benches, x and y")
    sentence: str = Field(description="The same in a sentence")


class Ground(Answer):
    """Ground as polygons."""

    ground: Polygon | MultiPolygon = Field(description="GeoJSON geometry in metres")
    area: float = measure("m2", "Area of it")
    excess: float = measure("m", "Proven: no point of it is further than this beyond what it has to hold")


class LooseTail(Ground):
    """The ground that the last benches can reach when they are let go."""

    benches: int = Field(description="Number of loose benches, the last ones of each dragon")
    reach: float = measure("m", "Furthest that they come from the handle that still follows the path")
    beyond_spectators: bool = Field(description="True: they can reach people who stand where these may")


class LaneStay(Answer, of=core.Stay, leave=()):
    """A time during which benches of one dragon are in a lane."""

    dragon: int = Field(description="The dragon, in the order of the dances")
    begin: float
    end: float


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


class Lane(Answer):
    """A lane to keep free."""

    name: str = Field(description="Its name")
    width: float = measure("m", "Its width")
    free_width: float = measure(
        "m",
        "Proven: a strip of this width is never swept, all along it, around its middle line or along one of its sides; "
        "0: none is known",
    )
    stays: list[LaneStay] = Field(
        description="Times at which benches are in it, those of people who stray included, dragon by dragon"
    )
    total: float = measure("s", "Time during which any bench is in it")
    in_loose_reach: bool = Field(description="The last benches can reach it when they are let go")


class GatePass(Answer):
    """One pass of a dragon through a gate."""

    dragon: int = Field(description="The dragon, in the order of the dances")
    name: str = Field(description="Name of the gate")
    head: float | None = measure("s", "Time at which the head passes it; null: not in this time")
    tail: float | None = measure("s", "Time at which the tail passes it; null: not in this time")
    lasts: float | None = measure("s", "From head to tail; null where one of these is missing")

    @classmethod
    def between(cls, dragon: int, name: str, head: float | None, tail: float | None) -> Self:
        lasts = None if head is None or tail is None else tail - head
        return cls(dragon=dragon, name=name, head=head, tail=tail, lasts=lasts)


class FastestCarriers(Answer, of=core.HighestSpeed):
    """The fastest carriers."""

    dragon: int = Field(description="Their dragon, in the order of the dances")
    speed: float
    at_most: float | None = measure("m/s", "Proven upper bound; null: none was proven")
    time: float
    handles: list[int]
    point: Point = measure("m", "Place of the first of them, x and y")


class Stopping(Answer):
    """How far the dance goes on after the call to stop."""

    reaction: float = measure("s", "Time until everybody stands")
    distance: float = measure("m", "Furthest that anybody goes on in that time, at the highest speed")


class SafetySheet(Answer):
    """What whoever permits a festival asks for. Nothing is proven for a dance that is danced otherwise."""

    verdict: Judgement = Field(description="passes, fails or undecided, as /check says it")
    sentences: list[str] = Field(description="The verdict, and how it is known, in two sentences for a layman")
    start: float = measure("s", "Start of the time judged")
    stop: float = measure("s", "End of the time judged")
    assumptions: list[Assumption] = Field(description="What it rests on")
    approaches: list[Approach] = Field(description="The nearest approaches, nearest first")
    swept: Ground = Field(description="The ground that benches sweep with everybody in place")
    spectators: Polygon | MultiPolygon = Field(
        description="Ground to keep people out of, GeoJSON in metres: swept ground, stray, and the distance asked for"
    )
    loose_tail: LooseTail = Field(description="The ground that the last benches can reach when they are let go")
    lanes: list[Lane] = Field(description="The lanes to keep free, in the order of the request")
    gates: list[GatePass] = Field(description="Passes of the gates, dragon by dragon in the order of its path")
    fastest: FastestCarriers | None = Field(
        description="The fastest carriers; null in a run to a fold, without a bound"
    )
    stopping: Stopping | None = Field(description="How far it goes on after the call to stop; null without a speed")
