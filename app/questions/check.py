"""Answers about a turn, the speed limit and a whole dance."""

from __future__ import annotations

from typing import Self

from pydantic import Field

import core
from app.wire import degrees
from app.wire.answers import Answer, CollisionTime, Head, Pair, Point
from app.wire.requests import CheckRequest
from core import Dragon, Outcome, Route, Spiral


class Turn(Answer):
    """Two tangent arcs between two coils: the first clockwise, the second counter-clockwise."""

    pitch: float = Field(description="Of both coils [m]")
    turning_diameter: float = Field(description="Diameter of the circle in which the turn lies [m]")
    ratio: float = Field(description="Radius of the first arc over that of the second")
    entry_radius: float = Field(description="Distance of the entry from the centre [m]")
    radii: Point = Field(description="Radii of both arcs [m]")
    centres: tuple[Point, Point] = Field(description="Centres of both arcs, x and y [m]")
    angles: Point = Field(description="Angle turned on each arc [rad]")
    entry: Point = Field(description="Where the first arc begins, x and y [m]")
    tangent_point: Point = Field(description="Where the two arcs meet, x and y [m]")
    exit: Point = Field(description="Where the second arc ends, x and y [m]")
    length: float = Field(description="Of both arcs together [m]")

    @classmethod
    def of(cls, found: core.Turn) -> Self:
        return cls.known(found, turning_diameter=2 * found.turning_radius)


class ShortestTurn(Turn):
    """The turn whose entry lies as deep inside the circle as this dragon can dance."""

    entry_bracket: Point = Field(description="Entry radii: infeasible, feasible [m]")
    limited_by: core.TurnLimit = Field(
        description="bend: a chord cannot follow; contact: benches come nearer than the margin, or touch if it is 0; "
        "centre: nothing down to the centre"
    )
    benches: Pair | None = Field(
        description="The pair that comes nearer than the margin, or touches, just below; null if none does"
    )
    time: float | None = Field(description="When, at a head speed of 1 m/s; 0 is the entry into the turn [s]")
    scan_step: float = Field(
        description="Entries down from the circle were tried this far apart, each one proven: a narrower range of "
        "infeasible ones is not excluded [m]"
    )
    evaluations: int = Field(description="Entries tried")

    @classmethod
    def of_shortest(cls, found: core.ShortestTurn) -> Self:
        return cls.known(found, **Turn.of(found.turn).model_dump())


class MaximumHeadSpeed(Answer):
    """The largest constant head speed at which no handle ever exceeds the limit."""

    head_speed: float = Field(description="[m/s]")
    head_speed_bracket: tuple[float | None, float] = Field(
        description="Proven to keep the limit (null where that proof was given up), found to reach it [m/s]"
    )
    speed_ratio: float = Field(description="Highest speed of a handle over that of the head")
    handles: list[int] = Field(description="The handles that reach the limit together")
    time: float = Field(description="When they do, at that head speed; 0 is the entry into the turn [s]")
    time_at_unit_head_speed: float = Field(description="The same at a head speed of 1 m/s [s]")


class LeastClearance(Answer):
    """The least clearance over the dance."""

    distance: float = Field(description="The least that was met; 0 at the first touch [m]")
    at_least: float | None = Field(description="Proven: nothing comes nearer; null: the search gave up first [m]")
    time: float = Field(description="When it is met [s]")
    benches: Pair = Field(description="The pair that is so near")


class Nearest(Answer):
    """How near the benches come to the edges of one area."""

    distance: float = Field(description="The least that was met; 0 at the first touch [m]")
    at_least: float | None = Field(description="Proven: no bench comes nearer; null: the search gave up first [m]")
    time: float = Field(description="When it is met [s]")
    bench: int = Field(description="The bench that comes so near")
    point: Point = Field(description="The point of the bench, x and y [m]")
    wall: Point = Field(description="The point of the area, x and y [m]")


class AreaClearance(Answer):
    """The benches and the edges of the square or of one obstacle."""

    name: str = Field(description="Name of the area")
    outcome: Outcome = Field(description="Does a bench come nearer than the margin, or touch if it is 0?")
    time: float | None = Field(description="When first; null when clear or undecided [s]")
    time_bracket: Point | None = Field(
        description="Proven not to be so up to, nearer than the margin, or touching if it is 0, at [s]"
    )
    bench: int | None = Field(description="The first bench nearer than the margin")
    gap: float | None = Field(
        description="What is left then between it and the area: the margin, or less from the start on [m]"
    )
    point: Point | None = Field(description="Its point that is nearest then, x and y [m]")
    nearest: Nearest = Field(description="The least distance over the dance")


class Stray(Answer):
    """A bench that starts where it must not."""

    name: str = Field(description="The area: the square that it is outside of, or the obstacle that it is in")
    bench: int = Field(description="The bench")
    point: Point = Field(description="Its centre, x and y [m]")


class VenueClearance(Answer):
    """The benches and the venue."""

    stray: Stray | None = Field(description="The first bench that starts outside the square or in an obstacle")
    areas: list[AreaClearance] = Field(description="The square, then the obstacles")


class HighestSpeed(Answer):
    """The highest speed of any handle over continuous time."""

    speed: float = Field(description="The highest found [m/s]")
    speed_bracket: tuple[float, float | None] = Field(
        description="Found, proven not to be exceeded (null where that proof was given up) [m/s]"
    )
    time: float = Field(description="When it is reached [s]")
    handles: list[int] = Field(description="The handles that reach it together")


class SharpestBend(Answer):
    """The largest angle between two consecutive benches."""

    angle: float = Field(description="Between their headings [rad]")
    time: float = Field(description="When it is reached [s]")
    benches: Pair = Field(description="The two benches")


class Failure(Answer):
    """One thing that fails."""

    kind: core.FailureKind = Field(description="What fails")
    time: float = Field(
        description="When it first does; of what is undecided, proven good until then; of a speed, the first instant "
        "above the limit [s]"
    )
    benches: list[int] = Field(description="The benches at fault; of a speed: the handle")
    area: str | None = Field(description="The area of the venue; null where it has no part")
    message: str = Field(description="One sentence")
    time_bracket: Point | None = Field(
        description="Proven not to fail up to, failing at; null for a fold and for what fails from the start [s]"
    )
    head: Head | None = Field(description="The head at that time")
    peak_speed: float | None = Field(
        description="Of a speed: the highest over the dance; null where it grows without bound, towards a fold [m/s]"
    )
    peak_time: float | None = Field(description="Of a speed: when it is highest, or the time of the fold [s]")


class Origin(Answer):
    """A place on earth."""

    longitude: float = Field(description="Eastwards [degrees]")
    latitude: float = Field(description="Northwards [degrees]")


class Report(Answer):
    """Can the dragon dance this path here? Where benches touch, or fold, the dance stops."""

    verdict: core.Judgement = Field(
        description="passes: nothing fails; fails: something does for certain; undecided: neither is proven"
    )
    passed: bool = Field(description="The verdict is passes")
    failures: list[Failure] = Field(
        description="What fails, in order of time, until the dance stops; and what is undecided"
    )
    start: float = Field(description="Looked at from here [s]")
    stop: float = Field(description="Looked at until here [s]")
    first_contact: CollisionTime = Field(
        description="When two benches first come nearer than the margin, or touch if it is 0"
    )
    least_clearance: LeastClearance | None = Field(description="Of any two benches; null with fewer than three")
    venue: VenueClearance | None = Field(description="The benches and the venue; null without one")
    highest_speed: HighestSpeed | None = Field(description="Of any handle; null in a run to its fold, without bound")
    sharpest_bend: SharpestBend | None = Field(description="Between two consecutive benches; null for a single bench")

    origin: Origin | None = Field(description="Where x = y = 0 lies; null unless the venue was given in degrees")

    @classmethod
    def of(
        cls,
        found: core.Report,
        dragon: Dragon,
        path: Spiral | Route,
        wanted: CheckRequest,
        origin: degrees.Origin | None = None,
    ) -> Self:
        contact = CollisionTime.of(found.first_contact, dragon, path, wanted)
        return cls.known(found, first_contact=contact, origin=origin)
