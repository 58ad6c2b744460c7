"""The answer of a safety sheet, and the lanes that it is asked about."""

from __future__ import annotations

from typing import Self

import numpy as np
from pydantic import Field

import core
from app.wire.answers import MultiPolygon, Polygon
from app.wire.fields import Answer, OneLine, Wire, measure
from app.wire.messages import checked
from app.wire.numbers import numbers_of
from app.wire.paths import Point as PointField
from core import Area, InvalidValue, Judgement
from core.quantities import Given
from core.shapes.engines import lane_rings
from core.values import Floats, Point


class Assumption(Answer):
    """One value that the sheet rests on.

    label: what it is, in the language asked for
    text: the value with its unit
    yours: True: the request sets it; false: it is assumed, or is the default
    """

    label: str
    text: str
    yours: bool


class Approach(Answer):
    """How near a bench comes to another one, or to an edge of the venue, with everybody in place.

    distance: smallest distance found [m]
    at_least: proven lower bound; null: none was proven [m]
    time: time of the smallest distance [s]
    dragons: the dragon of each of these benches, in the order of the dances
    benches: the two benches, or the one that comes near the edge
    area: name of the area; null for two benches
    point: Place: of the bench's point, or between both benches, x and y [m]
    sentence: the same in a sentence
    """

    distance: float
    at_least: float | None
    time: float
    dragons: list[int]
    benches: list[int]
    area: str | None
    point: Point
    sentence: str


class Ground(Answer):
    """Ground as polygons.

    ground: GeoJSON geometry in metres
    area: area of it [m2]
    excess: Proven: no point of it is further than this beyond what it has to hold [m]
    """

    ground: Polygon | MultiPolygon
    area: float
    excess: float


class LooseTail(Ground):
    """The ground that the last benches can reach when they are let go.

    benches: number of loose benches, the last ones of each dragon
    reach: furthest that they come from the handle that still follows the path [m]
    beyond_spectators: True: they can reach people who stand where these may
    """

    benches: int
    reach: float
    beyond_spectators: bool


class LaneStay(Answer, of=core.Stay, leave=()):
    """A time during which benches of one dragon are in a lane.

    dragon: the dragon, in the order of the dances
    """

    dragon: int
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
    """A lane to keep free.

    name: its name
    width: its width [m]
    free_width: Proven: a strip of this width is never swept, all along it, around its middle line or along one of its
        sides; 0: none is known [m]
    stays: times at which benches are in it, those of people who stray included, dragon by dragon
    total: time during which any bench is in it [s]
    in_loose_reach: the last benches can reach it when they are let go
    """

    name: str
    width: float
    free_width: float
    stays: list[LaneStay]
    total: float
    in_loose_reach: bool


class GatePass(Answer):
    """One pass of a dragon through a gate.

    dragon: the dragon, in the order of the dances
    name: name of the gate
    head: time at which the head passes it; null: not in this time [s]
    tail: time at which the tail passes it; null: not in this time [s]
    lasts: from head to tail; null where one of these is missing [s]
    """

    dragon: int
    name: str
    head: float | None
    tail: float | None
    lasts: float | None

    @classmethod
    def between(cls, dragon: int, name: str, head: float | None, tail: float | None) -> Self:
        lasts = None if head is None or tail is None else tail - head
        return cls(dragon=dragon, name=name, head=head, tail=tail, lasts=lasts)


class FastestCarriers(Answer, of=core.HighestSpeed):
    """The fastest carriers.

    dragon: their dragon, in the order of the dances
    at_most: proven upper bound; null: none was proven [m/s]
    point: place of the first of them, x and y [m]
    """

    dragon: int
    speed: float
    at_most: float | None
    time: float
    handles: list[int]
    point: Point


class Stopping(Answer):
    """How far the dance goes on after the call to stop.

    reaction: time until everybody stands [s]
    distance: furthest that anybody goes on in that time, at the highest speed [m]
    """

    reaction: float
    distance: float


class SafetySheet(Answer):
    """What whoever permits a festival asks for. Nothing is proven for a dance that is danced otherwise.

    sentences: the verdict, and how it is known, in two sentences for a layman
    start: start of the time judged [s]
    stop: end of the time judged [s]
    assumptions: what it rests on
    approaches: the nearest approaches, nearest first
    swept: the ground that benches sweep with everybody in place
    spectators: ground to keep people out of, GeoJSON in metres: swept ground, stray, and the distance asked for
    loose_tail: the ground that the last benches can reach when they are let go
    lanes: the lanes to keep free, in the order of the request
    gates: passes of the gates, dragon by dragon in the order of its path
    fastest: the fastest carriers; null in a run to a fold, without a bound
    stopping: how far it goes on after the call to stop; null without a speed
    """

    verdict: Judgement = Field(description="passes, fails or undecided, as /check says it")
    sentences: list[str]
    start: float
    stop: float
    assumptions: list[Assumption]
    approaches: list[Approach]
    swept: Ground
    spectators: Polygon | MultiPolygon
    loose_tail: LooseTail
    lanes: list[Lane]
    gates: list[GatePass]
    fastest: FastestCarriers | None
    stopping: Stopping | None
