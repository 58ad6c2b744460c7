"""When do two benches first touch, or come nearer than a margin?"""

from __future__ import annotations

from typing import Self

from pydantic import Field

import core
from app.questions.question import UNKNOWN_COST, Question
from app.settings import Settings
from app.wire.answers import End, Feature, Graze, Head, Pair, PairCheck, Point
from app.wire.dances import DanceFields, DanceQuery, UniformDragon
from app.wire.models import Answer, CrossCheck, Instant, Margin, Wire, measure
from app.wire.paths import SpiralPath
from core import Dance, Outcome

# Of longer dragons only the benches near the contact are judged.
JUDGED_MOST = 2_000


class Contact(Wire):
    """What counts as a contact, and who judges it."""

    margin: Margin = 0.0
    cross_check: CrossCheck = "dragon"


class CollisionQuery(Contact, DanceQuery):
    """When do two benches first touch, or come nearer than a margin?"""


class CollisionRequest(Contact, DanceFields, strict=True):
    """When do two benches first touch, or come nearer than a margin, on any path?"""

    start: Instant | None = measure(
        "s", "From when; null: the start of the dance, or when the whole dragon is on the path", None
    )
    stop: Instant | None = measure("s", "Until when; null: the end of the run", None)


class Certificate(Answer):
    """How the answer is known."""

    method: str = Field(description="The whole claim, and how it is proven, in sentences")
    steps: int = Field(description="Proven steps taken")
    clear_until: float | None = measure(
        "s",
        "Nothing comes nearer than the margin, or touches if it is 0, from the start to here; null where "
        "no time is proven clear: benches touch, or are nearer, at the start, or it is not decided from there on",
    )
    bound: float = measure("1/m", "Largest bound on the second derivative of a gap that a step used")
    least_clearance: Graze | None = Field(description="Narrowest graze before the contact, or over the whole run")


class CollisionTime(Answer):
    """When two benches that share no handle first come nearer than the margin, or touch if it is 0."""

    outcome: Outcome = Field(
        description="How the search ended; contact is the first time at which two benches are nearer than the margin, "
        "or touch if it is 0"
    )
    margin: float = measure("m", "Clearance that was asked for; 0 asks for a touch")
    time: float | None = measure(
        "s", "When first nearer than the margin, or touching if it is 0; null when clear or undecided"
    )
    time_bracket: Point | None = measure(
        "s", "Proven not to be so up to, nearer than the margin, or overlapping if it is 0, at"
    )
    head: Head | None = Field(description="The head at that time")
    benches: Pair | None = Field(description="The pair that is so near")
    gap: float | None = measure(
        "m", "Between the two then: the margin, or less where they are nearer from the start on"
    )
    corner: Feature | None = Field(description="The corner that is nearest, or touches")
    edge: Feature | None = Field(description="The edge that it is nearest to, or touches")
    point: Point | None = measure("m", "Where that corner is, x and y")
    end: End | None = Field(description="Where the run ends, when clear")
    certificate: Certificate = Field(description="How the answer is known")
    cross_check: PairCheck | None = Field(
        description="Engines on the dance 1e-6 m of travel before and after, at the start at once and after; null "
        "without a contact, and when not asked for"
    )

    @classmethod
    def of(cls, contact: core.FirstContact, dance: Dance, asked: Contact) -> Self:
        check = None
        if asked.cross_check != "none":
            check = core.contact_check(contact, dance, margin=asked.margin, whole=asked.cross_check == "dragon")
        return cls.known(contact, margin=asked.margin, cross_check=check)


def collision_time(asked: CollisionQuery | CollisionRequest, settings: Settings) -> CollisionTime:
    """When two benches that share no handle first touch or come nearer than a margin, and how that is known."""
    dance, start, stop = asked.to_dance(asked.most_benches(settings)), 0.0, None
    if isinstance(asked, CollisionRequest):
        start, stop = dance.begin if asked.start is None else asked.start, asked.stop
    found = core.first_contact(dance, margin=asked.margin, start=start, stop=stop)
    return CollisionTime.of(found, dance, asked)


def _cost(asked: CollisionQuery | CollisionRequest) -> float:
    """A search on a spiral does not grow with the benches; a judgement of the whole dragon does."""
    if isinstance(asked, CollisionRequest):
        repeats = isinstance(asked.path, SpiralPath) and isinstance(asked.dragon, UniformDragon)
        if not repeats:
            return UNKNOWN_COST
    judged = min(asked.benches, JUDGED_MOST) if asked.cross_check == "dragon" else 0
    return 0.005 + 5e-5 * judged + 2e-6 * asked.benches


QUESTION = Question(collision_time, CollisionTime, flat=CollisionQuery, body=CollisionRequest, cost=_cost)
