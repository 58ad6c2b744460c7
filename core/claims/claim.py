"""Claims of certificates: each is a kind and the values that it is about, without words."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum
from typing import Self

from core.dance import Dance, EndReason
from core.display import Readable
from core.dragon import Dragon
from core.errors import format_bound, format_number
from core.passages import Passage
from core.paths.path import PathSummary
from core.values import Point

# Most passages that a summary lists one by one [1], and most parts of a performance.
PASSAGES_LISTED, PARTS_LISTED = 6, 6


class ClaimKind(StrEnum):
    """Kind of a claim.

    CLEAR, CONTACT: no two benches come within the margin between two times; CONTACT: and two do soon after. In an
        EncounterClaim two benches are of different dragons
    CONTACT_AT_START: two benches are within the margin at the start
    UNDECIDED: no two come within the margin up to a time, and it is not decided whether any do after that
    SAFE_STRAY, NO_SAFE_STRAY: nothing touches while no hole strays further; no such stray is known
    CONTACT_PROBABILITY: of dances drawn at random; SWEPT_GROUND: of the polygons around all that benches sweep
    LOOSE_TAIL: of the polygons around all that loose benches can reach
    """

    CLEAR = "clear"
    CONTACT = "contact"
    CONTACT_AT_START = "contact_at_start"
    UNDECIDED = "undecided"
    SAFE_STRAY = "safe_stray"
    NO_SAFE_STRAY = "no_safe_stray"
    CONTACT_PROBABILITY = "contact_probability"
    SWEPT_GROUND = "swept_ground"
    LOOSE_TAIL = "loose_tail"


@dataclass(frozen=True, slots=True, repr=False)
class DragonSummary(Readable):
    """Benches of a dragon [m].

    lengths, widths: the smallest and the largest one
    head_length, body_length, width, overhang: None for benches that are not all alike behind the head; a dragon of one
        bench has no body_length
    """

    benches: int
    lengths: tuple[float, float]
    widths: tuple[float, float]
    head_length: float | None = None
    body_length: float | None = None
    width: float | None = None
    overhang: float | None = None

    @classmethod
    def of(cls, dragon: Dragon) -> Self:
        count, lengths, widths, overhangs = dragon.benches, dragon.lengths, dragon.widths, dragon.overhangs
        if dragon.uniform_from > 1 or widths[0] != widths[-1] or overhangs[0] != overhangs[-1]:
            return cls(count, (float(lengths.min()), float(lengths.max())), (float(widths.min()), float(widths.max())))
        head, body, width = float(lengths[0]), float(lengths[-1]), float(widths[0])
        extent = (min(head, body), max(head, body))
        return cls(count, extent, (width, width), head, body if count > 1 else None, width, float(overhangs[0]))


@dataclass(frozen=True, slots=True, repr=False)
class DanceSummary(Readable):
    """A dance.

    head_speed: outside the passages [m/s]; passages: those before that speed, none if there are more than
    PASSAGES_LISTED; passage_count: the number of all
    """

    dragon: DragonSummary
    path: PathSummary
    head_speed: float
    passages: tuple[Passage, ...]
    passage_count: int

    @classmethod
    def of(cls, dance: Dance) -> Self:
        passages, count = tuple(dance.passages), len(dance.passages)
        listed = passages if count <= PASSAGES_LISTED else ()
        return cls(DragonSummary.of(dance.dragon), dance.path.summary(), dance.clock.head_speed, listed, count)


class BenchBetween(StrEnum):
    """Part that the bench between two others plays in a safe stray. HELD: it holds them apart, which is used;
    UNUSED: the two that limit the stray have one between them, and are assumed to stray independently."""

    HELD = "held"
    UNUSED = "unused"


@dataclass(frozen=True, slots=True, repr=False)
class ContactClaim(Readable):
    """Claim of a search for first contact.

    margin, stray: [m]; start: of the search [s]; clear_until: time until which no two benches come within the margin
        [s]; None if none is proven
    end: why a run without a contact ends there; benches, time: two benches that are within the margin at a time [s]
    between: HELD if two benches with one between them were left out, because it holds them apart
    """

    kind: ClaimKind
    dance: DanceSummary
    margin: float
    stray: float
    start: float
    clear_until: float | None = None
    end: EndReason | None = None
    benches: tuple[int, int] | None = None
    time: float | None = None
    between: BenchBetween | None = None


@dataclass(frozen=True, slots=True, repr=False)
class PartSummary(Readable):
    """A part of a performance.

    name: of the dragon, None without; delay: time of the performance at time 0 of the dance [s]
    centre (x, y) [m], rotation [rad], clockwise: the place of a spiral; (0, 0), 0 and True for a route
    """

    name: str | None
    dance: DanceSummary
    delay: float
    centre: Point
    rotation: float
    clockwise: bool


@dataclass(frozen=True, slots=True, repr=False)
class EncounterClaim(Readable):
    """Claim of a search for the first encounter of two dragons.

    parts: of the performance, none if there are more than PARTS_LISTED; part_count, bench_count: number of all parts,
        and of their benches
    margin, stray, start, clear_until, end, benches, time: as in a ContactClaim; dragons: those of these two benches
    """

    kind: ClaimKind
    parts: tuple[PartSummary, ...]
    part_count: int
    bench_count: int
    margin: float
    stray: float
    start: float
    clear_until: float | None = None
    end: EndReason | None = None
    dragons: tuple[int, int] | None = None
    benches: tuple[int, int] | None = None
    time: float | None = None


@dataclass(frozen=True, slots=True, repr=False)
class StrayClaim(Readable):
    """Claim of a tolerance.

    venue: whether the edges of a venue count; start, stop: [s]; stray: proven safe [m], 0 if none is known to be
    touches: whether something touches without any stray; between: None without two benches with one between them
    """

    kind: ClaimKind
    dance: DanceSummary
    venue: bool
    start: float
    stop: float
    stray: float
    touches: bool
    between: BenchBetween | None


@dataclass(frozen=True, slots=True, repr=False)
class ProbabilityClaim(Readable):
    """Claim of a probability from dances drawn at random.

    confidence: of its limits; step: between two instants [s]; union_bound: upper bound of the probability, None without
    tolerance: stray within which nothing touches [m], None or 0 without; within: samples without a larger stray
    """

    kind: ClaimKind
    contacts: int
    samples: int
    instants: int
    step: float
    confidence: float
    union_bound: float | None
    tolerance: float | None
    within: int


@dataclass(frozen=True, slots=True, repr=False)
class GroundClaim(Readable):
    """Claim of an envelope: it holds all ground that benches cover between two times, and reaches little further.

    start, stop: [s]; excess: furthest that it reaches [m]; sizes: different benches; length: of path that they pass [m]
    cells: stretches of the path, each with a bound on the motion
    """

    kind: ClaimKind
    start: float
    stop: float
    excess: float
    sizes: int
    length: float
    cells: int


@dataclass(frozen=True, slots=True, repr=False)
class TailClaim(Readable):
    """Claim of the ground of a loose tail: it holds all that the last benches can reach when they are let go.

    start, stop: [s]; benches: loose ones; reach: of them from the handle that still follows [m]; stray: of that [m]
    excess: furthest that the polygons go beyond the reach from places of the handle [m]
    """

    kind: ClaimKind
    start: float
    stop: float
    benches: int
    reach: float
    stray: float
    excess: float
    _units = {"reach": "m"}  # noqa: RUF012 - a field of a dataclass may not be annotated here


def format_safe(stray: float) -> str:
    """A stray that is proven safe [m], rounded down to 1e-12 m, so that it stays proven.

    >>> format_safe(0.8250000000000001), format_safe(0.02)
    ('0.825', '0.02')
    """
    return format_number(float(format_bound(stray, 12)))


Claim = ContactClaim | EncounterClaim | StrayClaim | ProbabilityClaim | GroundClaim | TailClaim
