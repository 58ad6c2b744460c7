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

    speed_limit: SpeedLimit | None = measure(None, description="Of every handle; null: none", unit="m/s")
    start: Instant | None = measure(
        None, description="From when; null: the start of the dance, or when the whole dragon is on the path", unit="s"
    )
    stop: Instant | None = measure(None, description="Until when; null: the end of the run", unit="s")


class LeastClearance(Answer):
    """The least clearance over the dance."""

    distance: float = measure(description="The least that was met; 0 at the first touch", unit="m")
    at_least: float | None = measure(
        description="Proven: nothing comes nearer; null: the search gave up first", unit="m"
    )
    time: float = measure(description="When it is met", unit="s")
    benches: Pair = Field(description="The pair that is so near")


class Nearest(Answer):
    """How near the benches come to the edges of one area."""

    distance: float = measure(description="The least that was met; 0 at the first touch", unit="m")
    at_least: float | None = measure(
        description="Proven: no bench comes nearer; null: the search gave up first", unit="m"
    )
    time: float = measure(description="When it is met", unit="s")
    bench: int = Field(description="The bench that comes so near")
    point: Point = measure(description="The point of the bench, x and y", unit="m")
    wall: Point = measure(description="The point of the area, x and y", unit="m")


class AreaClearance(Answer):
    """The benches and the edges of the square or of one obstacle."""

    name: str = Field(description="Name of the area")
    outcome: Outcome = Field(description="Does a bench come nearer than the margin, or touch if it is 0?")
    time: float | None = measure(description="When first; null when clear or undecided", unit="s")
    time_bracket: Point | None = measure(
        description="Proven not to be so up to, nearer than the margin, or touching if it is 0, at", unit="s"
    )
    bench: int | None = Field(description="The first bench nearer than the margin")
    gap: float | None = measure(
        description="What is left then between it and the area: the margin, or less from the start on", unit="m"
    )
    point: Point | None = measure(description="Its point that is nearest then, x and y", unit="m")
    nearest: Nearest = Field(description="The least distance over the dance")


class Stray(Answer):
    """A bench that starts where it must not."""

    name: str = Field(description="The area: the square that it is outside of, or the obstacle that it is in")
    bench: int = Field(description="The bench")
    point: Point = measure(description="Its centre, x and y", unit="m")


class VenueClearance(Answer):
    """The benches and the venue."""

    stray: Stray | None = Field(description="The first bench that starts outside the square or in an obstacle")
    areas: list[AreaClearance] = Field(description="The square, then the obstacles")


class HighestSpeed(Answer):
    """The highest speed of any handle over continuous time."""

    speed: float = measure(description="The highest found", unit="m/s")
    speed_bracket: tuple[float, float | None] = measure(
        description="Found, proven not to be exceeded (null where that proof was given up)", unit="m/s"
    )
    time: float = measure(description="When it is reached", unit="s")
    handles: list[int] = Field(description="The handles that reach it together")


class SharpestBend(Answer):
    """The largest angle between two consecutive benches."""

    angle: float = measure(description="Between their headings", unit="rad")
    time: float = measure(description="When it is reached", unit="s")
    benches: Pair = Field(description="The two benches")


class Failure(Answer):
    """One thing that fails."""

    kind: core.FailureKind = Field(description="What fails")
    time: float = measure(
        description="When it first does; of what is undecided, proven good until then; of a speed, the first instant "
        "above the limit",
        unit="s",
    )
    benches: list[int] = Field(description="The benches at fault; of a speed: the handle")
    area: str | None = Field(description="The area of the venue; null where it has no part")
    message: str = Field(description="One sentence")
    time_bracket: Point | None = measure(
        description="Proven not to fail up to, failing at; null for a fold and for what fails from the start", unit="s"
    )
    head: Head | None = Field(description="The head at that time")
    peak_speed: float | None = measure(
        description="Of a speed: the highest over the dance; null where it grows without bound, towards a fold",
        unit="m/s",
    )
    peak_time: float | None = measure(description="Of a speed: when it is highest, or the time of the fold", unit="s")


class Origin(Answer):
    """A place on earth."""

    longitude: float = measure(description="Eastwards", unit="degrees")
    latitude: float = measure(description="Northwards", unit="degrees")


class Report(Answer):
    """Can the dragon dance this path here? Where benches touch, or fold, the dance stops."""

    verdict: core.Judgement = Field(
        description="passes: nothing fails; fails: something does for certain; undecided: neither is proven"
    )
    passed: bool = Field(description="The verdict is passes")
    failures: list[Failure] = Field(
        description="What fails, in order of time, until the dance stops; and what is undecided"
    )
    start: float = measure(description="Looked at from here", unit="s")
    stop: float = measure(description="Looked at until here", unit="s")
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
