"""Can the dragon dance this path here?"""

from __future__ import annotations

from typing import Self

from pydantic import Field

import core
from app.questions.collision_time import CollisionTime, Contact
from app.questions.question import Question
from app.settings import Settings
from app.wire import degrees
from app.wire.answers import Head, Pair, Point
from app.wire.dances import PlacedDance
from app.wire.models import Answer, Instant, SpeedLimit, measure
from core import Outcome


class CheckRequest(Contact, PlacedDance, strict=True):
    """Can this dragon dance this path here?"""

    speed_limit: SpeedLimit | None = measure("m/s", "Of every handle; null: none", None)
    start: Instant | None = measure(
        "s", "From when; null: the start of the dance, or when the whole dragon is on the path", None
    )
    stop: Instant | None = measure("s", "Until when; null: the end of the run", None)


class LeastClearance(Answer):
    """The least clearance over the dance."""

    distance: float = measure("m", "The least that was met; 0 at the first touch")
    at_least: float | None = measure("m", "Proven: nothing comes nearer; null: the search gave up first")
    time: float = measure("s", "When it is met")
    benches: Pair = Field(description="The pair that is so near")


class Nearest(Answer):
    """How near the benches come to the edges of one area."""

    distance: float = measure("m", "The least that was met; 0 at the first touch")
    at_least: float | None = measure("m", "Proven: no bench comes nearer; null: the search gave up first")
    time: float = measure("s", "When it is met")
    bench: int = Field(description="The bench that comes so near")
    point: Point = measure("m", "The point of the bench, x and y")
    wall: Point = measure("m", "The point of the area, x and y")


class AreaClearance(Answer):
    """The benches and the edges of the square or of one obstacle."""

    name: str = Field(description="Name of the area")
    outcome: Outcome = Field(description="Does a bench come nearer than the margin, or touch if it is 0?")
    time: float | None = measure("s", "When first; null when clear or undecided")
    time_bracket: Point | None = measure(
        "s", "Proven not to be so up to, nearer than the margin, or touching if it is 0, at"
    )
    bench: int | None = Field(description="The first bench nearer than the margin")
    gap: float | None = measure("m", "What is left then between it and the area: the margin, or less from the start on")
    point: Point | None = measure("m", "Its point that is nearest then, x and y")
    nearest: Nearest = Field(description="The least distance over the dance")


class Stray(Answer):
    """A bench that starts where it must not."""

    name: str = Field(description="The area: the square that it is outside of, or the obstacle that it is in")
    bench: int = Field(description="The bench")
    point: Point = measure("m", "Its centre, x and y")


class VenueClearance(Answer):
    """The benches and the venue."""

    stray: Stray | None = Field(description="The first bench that starts outside the square or in an obstacle")
    areas: list[AreaClearance] = Field(description="The square, then the obstacles")


class HighestSpeed(Answer):
    """The highest speed of any handle over continuous time."""

    speed: float = measure("m/s", "The highest found")
    speed_bracket: tuple[float, float | None] = measure(
        "m/s", "Found, proven not to be exceeded (null where that proof was given up)"
    )
    time: float = measure("s", "When it is reached")
    handles: list[int] = Field(description="The handles that reach it together")


class SharpestBend(Answer):
    """The largest angle between two consecutive benches."""

    angle: float = measure("rad", "Between their headings")
    time: float = measure("s", "When it is reached")
    benches: Pair = Field(description="The two benches")


class Failure(Answer):
    """One thing that fails."""

    kind: core.FailureKind = Field(description="What fails")
    time: float = measure(
        "s",
        "When it first does; of what is undecided, proven good until then; of a speed, the first instant "
        "above the limit",
    )
    benches: list[int] = Field(description="The benches at fault; of a speed: the handle")
    area: str | None = Field(description="The area of the venue; null where it has no part")
    message: str = Field(description="One sentence")
    time_bracket: Point | None = measure(
        "s", "Proven not to fail up to, failing at; null for a fold and for what fails from the start"
    )
    head: Head | None = Field(description="The head at that time")
    peak_speed: float | None = measure(
        "m/s", "Of a speed: the highest over the dance; null where it grows without bound, towards a fold"
    )
    peak_time: float | None = measure("s", "Of a speed: when it is highest, or the time of the fold")


class Origin(Answer):
    """A place on earth."""

    longitude: float = measure("degrees", "Eastwards")
    latitude: float = measure("degrees", "Northwards")


class Report(Answer):
    """Can the dragon dance this path here? Where benches touch, or fold, the dance stops."""

    verdict: core.Judgement = Field(
        description="passes: nothing fails; fails: something does for certain; undecided: neither is proven"
    )
    passed: bool = Field(description="The verdict is passes")
    failures: list[Failure] = Field(
        description="What fails, in order of time, until the dance stops; and what is undecided"
    )
    start: float = measure("s", "Looked at from here")
    stop: float = measure("s", "Looked at until here")
    first_contact: CollisionTime = Field(
        description="When two benches first come nearer than the margin, or touch if it is 0"
    )
    least_clearance: LeastClearance | None = Field(description="Of any two benches; null with fewer than three")
    venue: VenueClearance | None = Field(description="The benches and the venue; null without one")
    highest_speed: HighestSpeed | None = Field(description="Of any handle; null in a run to its fold, without bound")
    sharpest_bend: SharpestBend | None = Field(description="Between two consecutive benches; null for a single bench")

    origin: Origin | None = Field(description="Where x = y = 0 lies; null unless the venue was given in degrees")

    @classmethod
    def of(cls, found: core.Report, dance: core.Dance, asked: CheckRequest, origin: degrees.Origin | None) -> Self:
        return cls.known(found, first_contact=CollisionTime.of(found.first_contact, dance, asked), origin=origin)


def check(asked: CheckRequest, settings: Settings) -> Report:
    """Can the dragon dance this path here: first contact, least clearance, venue, speed, sharpest bend."""
    dance = asked.to_dance(settings.checked_benches_max)
    place = asked.to_place(dance.dragon)
    found = core.check(
        dance,
        venue=place.venue,
        margin=asked.margin,
        speed_limit=asked.speed_limit,
        start=asked.start,
        stop=asked.stop,
    )
    return Report.of(found, dance, asked, place.origin)


QUESTION = Question(check, Report, body=CheckRequest)
