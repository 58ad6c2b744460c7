"""Claims of certificates: what is known, as a kind and values, for programs that word it themselves."""

from __future__ import annotations

from typing import Literal

from pydantic import Field

from app.wire.question import Answer, measure
from core import EndReason
from core.claims.claim import BenchBetween, ClaimKind

Pair = tuple[int, int]
KIND = Field(description="Kind of the claim")


class ClaimedDragon(Answer):
    """The benches that a claim is about."""

    benches: int = Field(description="Number of benches")
    lengths: tuple[float, float] = measure("m", "The shortest and the longest length")
    widths: tuple[float, float] = measure("m", "The smallest and the largest width")
    head_length: float | None = measure("m", "Length of the head's bench; null for benches given one by one")
    body_length: float | None = measure("m", "Length of every other bench; null without one, or if given one by one")
    width: float | None = measure("m", "Width of every bench; null for benches given one by one")
    overhang: float | None = measure("m", "Overhang of every bench; null for benches given one by one")


class ClaimedPath(Answer):
    """The path that a claim is about."""

    kind: Literal["spiral", "route"] = Field(description="spiral, or route: any other path")
    begin: float = measure("m", "Smallest arc length of the head; 0 is its place at time 0")
    end: float = measure("m", "Largest arc length of the head")
    pitch: float | None = measure("m", "Pitch of a spiral; null on a route")
    start_turns: float | None = measure("turns", "Turns from the centre to the start of a spiral; null on a route")
    pieces: list[str] = Field(
        description="Kinds of the pieces of a route, in order; of more than six pieces only the different kinds"
    )


class ClaimedPassage(Answer):
    """A part of the dance with one speed of the head."""

    speed: float = measure("m/s", "Speed of the head, 0 for a pause")
    until_s: float | None = measure("m", "Arc length of the head at its end; null if a time ends it")
    until_time: float | None = measure("s", "Time of its end; null if a place ends it")


class ClaimedDance(Answer):
    """The dance that a claim is about."""

    dragon: ClaimedDragon = Field(description="The benches")
    path: ClaimedPath = Field(description="The path")
    head_speed: float = measure("m/s", "Speed of the head outside the passages")
    passages: list[ClaimedPassage] = Field(description="Passages with other speeds; none if there are more than six")
    passage_count: int = Field(description="Number of all passages")


class ContactClaim(Answer):
    """Claim of a search for first contact."""

    kind: ClaimKind = KIND
    dance: ClaimedDance = Field(description="The dance")
    margin: float = measure("m", "Required clearance")
    stray: float = measure("m", "Largest distance of a hole from its place")
    start: float = measure("s", "Start of the search")
    clear_until: float | None = measure(
        "s", "Time until which no two benches come within the margin; null if none is proven"
    )
    end: EndReason | None = Field(description="End of a run without a contact; null with one, or if undecided")
    benches: Pair | None = Field(description="Two benches that are within the margin at that time; null without")
    time: float | None = measure("s", "Time at which these are certainly within the margin; null without")
    between: BenchBetween | None = Field(
        description="held: two benches with one between them were left out, because it is proven to hold them apart as "
        "people stray; null: all pairs count"
    )


class ClaimedPart(Answer):
    """A part of the performance that a claim is about."""

    name: str | None = Field(description="Name of the dragon; null without")
    dance: ClaimedDance = Field(description="Its dance")
    delay: float = measure("s", "Time of the performance at time 0 of the dance")
    centre: tuple[float, float] = measure("m", "Centre of a spiral; 0, 0 for a route")
    rotation: float = measure("rad", "Rotation of a spiral; 0 for a route")
    clockwise: bool = Field(description="Direction of the dance on a spiral; true for a route")


class EncounterClaim(Answer):
    """Claim of a search for the first encounter of two dragons."""

    kind: ClaimKind = KIND
    parts: list[ClaimedPart] = Field(description="The parts of the performance; none if there are more than six")
    part_count: int = Field(description="Number of all parts")
    bench_count: int = Field(description="Number of the benches of all parts")
    margin: float = measure("m", "Required clearance")
    stray: float = measure("m", "Largest distance of a hole from its place")
    start: float = measure("s", "Start of the search")
    clear_until: float | None = measure(
        "s", "Time until which no benches of two dragons come within the margin; null if none is proven"
    )
    end: EndReason | None = Field(description="End without an encounter; null with one, or if undecided")
    dragons: Pair | None = Field(
        description="Two dragons whose benches are within the margin at that time; null without"
    )
    benches: Pair | None = Field(description="These benches, one of each dragon; null without")
    time: float | None = measure("s", "Time at which these are certainly within the margin; null without")


class StrayClaim(Answer):
    """Claim of a tolerance to strays."""

    kind: ClaimKind = KIND
    dance: ClaimedDance = Field(description="The dance")
    venue: bool = Field(description="Whether the edges of a venue count")
    start: float = measure("s", "Start of the time asked about")
    stop: float = measure("s", "End of the time asked about")
    stray: float = measure("m", "Proven safe; 0: no stray is known to be safe")
    touches: bool = Field(description="Whether there is a contact with everybody in place")
    between: BenchBetween | None = Field(
        description="Part of the bench between two others. held: it holds them apart, which is used; unused: the two "
        "that limit the stray have one between them, and are assumed to stray independently; null: neither"
    )


class ProbabilityClaim(Answer):
    """Claim of a probability from dances drawn at random."""

    kind: ClaimKind = KIND
    contacts: int = Field(description="Number of samples with a contact")
    samples: int = Field(description="Number of samples")
    instants: int = Field(description="Number of instants of each sample")
    step: float = measure("s", "Time between two instants")
    confidence: float = Field(description="Probability that the limits hold")
    union_bound: float | None = Field(description="Upper bound of the probability of the model; null without")
    tolerance: float | None = measure("m", "Stray that is proven safe; null or 0: none is known")
    within: int = Field(description="Number of samples without a larger stray")


class GroundClaim(Answer):
    """Claim of an envelope."""

    kind: ClaimKind = KIND
    start: float = measure("s", "Start of the time asked about")
    stop: float = measure("s", "End of the time asked about")
    excess: float = measure("m", "Furthest that the polygons reach beyond ground that a bench covers")
    sizes: int = Field(description="Number of different sizes of benches")
    length: float = measure("m", "Length of the path that these pass")
    cells: int = Field(description="Number of stretches of the path, each with a bound on the motion")


class TailClaim(Answer):
    """Claim of the ground of a loose tail."""

    kind: ClaimKind = KIND
    start: float = measure("s", "Start of the time asked about")
    stop: float = measure("s", "End of the time asked about")
    benches: int = Field(description="Number of loose benches, the last ones")
    reach: float = measure("m", "Furthest that they come from the handle that still follows the path")
    stray: float = measure("m", "Largest distance of that handle from its place")
    excess: float = measure("m", "Furthest that the polygons go beyond the reach from places of the handle")
