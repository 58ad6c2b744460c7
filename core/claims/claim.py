"""Claims of certificates: each is a kind and the values that it is about, without words."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum
from typing import Self

from core.dance import Dance, EndReason
from core.display import Readable
from core.dragon import Dragon
from core.passages import Passage
from core.paths.path import PathSummary
from core.quantities import format_bound, format_number
from core.values import Interval, Pair, Point

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

    >>> from core import Spiral, first_contact
    >>> first_contact(Dance(Dragon(), Spiral())).certificate.claim.kind
    <ClaimKind.CONTACT: 'contact'>
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
    """Benches of a dragon.

    benches: number of benches
    lengths: the shortest and the longest length [m]
    widths: the smallest and the largest width [m]
    head_length: length of the head's bench; None for benches given one by one [m]
    body_length: length of every other bench; None without one, or for benches given one by one [m]
    width: width of every bench; None for benches given one by one [m]
    overhang: overhang of every bench; None for benches given one by one [m]

    >>> from core import Spiral, first_contact
    >>> summary = first_contact(Dance(Dragon(), Spiral())).certificate.claim.dance.dragon
    >>> summary.head_length, summary.body_length
    (3.41, 2.2)
    """

    benches: int
    lengths: Interval
    widths: Interval
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
    """A dance that a claim is about.

    dragon: the benches
    path: the path
    head_speed: speed of the head outside the passages [m/s]
    passages: passages with other speeds; none if there are more than six
    passage_count: number of all passages

    >>> from core import Spiral, first_contact
    >>> first_contact(Dance(Dragon(), Spiral())).certificate.claim.dance.dragon.benches
    223
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
    UNUSED: the two that limit the stray have one between them, and are assumed to stray independently.

    >>> [between.value for between in BenchBetween]
    ['held', 'unused']
    """

    HELD = "held"
    UNUSED = "unused"


@dataclass(frozen=True, slots=True, repr=False)
class ContactClaim(Readable):
    """Claim of a search for first contact.

    kind: kind of the claim
    dance: the dance
    margin: required clearance [m]
    stray: largest distance of a hole from its place [m]
    start: start of the search [s]
    clear_until: time until which no two benches come within the margin; None if none is proven [s]
    end: end of a run without a contact; None with one, or if undecided
    benches: two benches that are within the margin at that time; None without
    time: time at which these are certainly within the margin; None without [s]
    between: held: two benches with one between them were left out, because it is proven to hold them apart as people
        stray; None: all pairs count

    >>> from core import Spiral, first_contact
    >>> claim = first_contact(Dance(Dragon(), Spiral())).certificate.claim
    >>> claim.kind.value, claim.benches, round(claim.clear_until, 6)
    ('contact', (0, 8), 412.473838)
    """

    kind: ClaimKind
    dance: DanceSummary
    margin: float
    stray: float
    start: float
    clear_until: float | None = None
    end: EndReason | None = None
    benches: Pair | None = None
    time: float | None = None
    between: BenchBetween | None = None


@dataclass(frozen=True, slots=True, repr=False)
class PartSummary(Readable):
    """A part of a performance.

    name: name of the dragon; None without
    dance: its dance
    delay: time of the performance at time 0 of the dance [s]
    centre: centre of a spiral, x and y; 0, 0 for a route [m]
    rotation: rotation of a spiral; 0 for a route [rad]
    clockwise: direction of the dance on a spiral; true for a route

    >>> from core import Line, Part, Performance, Route, first_contact
    >>> streets = [Line((-40.0, 0.0), (40.0, 0.0)), Line((0.0, -40.0), (0.0, 40.0))]
    >>> crossing = Performance([Part(Dance(Dragon(5), Route([street])), delay=9.0) for street in streets])
    >>> first_contact(crossing).certificate.claim.parts[0].delay
    9.0
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

    kind: kind of the claim
    parts: the parts of the performance; none if there are more than six
    part_count: number of all parts
    bench_count: number of the benches of all parts
    margin: required clearance [m]
    stray: largest distance of a hole from its place [m]
    start: start of the search [s]
    clear_until: time until which no benches of two dragons come within the margin; None if none is proven [s]
    end: end without an encounter; None with one, or if undecided
    dragons: two dragons whose benches are within the margin at that time; None without
    benches: these benches, one of each dragon; None without
    time: time at which these are certainly within the margin; None without [s]

    >>> from core import Line, Part, Performance, Route, first_contact
    >>> streets = [Line((-40.0, 0.0), (40.0, 0.0)), Line((0.0, -40.0), (0.0, 40.0))]
    >>> crossing = Performance([Part(Dance(Dragon(5), Route([street]))) for street in streets])
    >>> claim = first_contact(crossing).certificate.claim
    >>> claim.part_count, claim.bench_count, claim.dragons
    (2, 10, (0, 1))
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
    dragons: Pair | None = None
    benches: Pair | None = None
    time: float | None = None


@dataclass(frozen=True, slots=True, repr=False)
class StrayClaim(Readable):
    """Claim of a tolerance to strays.

    kind: kind of the claim
    dance: the dance
    venue: whether the edges of a venue count
    start: start of the time asked about [s]
    stop: end of the time asked about [s]
    stray: stray that is proven safe; 0: no stray is known to be safe [m]
    touches: whether there is a contact with everybody in place
    between: part of the bench between two others. held: it holds them apart, which is used; unused: the two that limit
        the stray have one between them, and are assumed to stray independently; None: neither

    >>> from core import Spiral, tolerance
    >>> claim = tolerance(Dance(Dragon(40), Spiral()), stop=300.0).certificate.claim
    >>> claim.kind.value, round(claim.stray, 4)
    ('safe_stray', 0.0529)
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

    kind: kind of the claim
    contacts: number of samples with a contact
    samples: number of samples
    instants: number of instants of each sample
    step: time between two instants [s]
    confidence: probability that the limits hold
    union_bound: upper bound of the probability of the model; None without
    tolerance: stray that is proven safe; None or 0: none is known [m]
    within: number of samples without a larger stray

    >>> from core import Spiral, Wobble, contact_probability
    >>> claim = contact_probability(Dance(Dragon(5), Spiral()), Wobble(), 100, 1, start=380.0, stop=400.0).claim
    >>> claim.contacts, claim.samples, claim.confidence
    (0, 100, 0.95)
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

    kind: kind of the claim
    start: start of the time asked about [s]
    stop: end of the time asked about [s]
    excess: furthest that the polygons reach beyond ground that a bench covers [m]
    sizes: number of different sizes of benches
    length: length of the path that these pass [m]
    cells: number of stretches of the path, each with a bound on the motion

    >>> from core import Spiral, envelope
    >>> claim = envelope(Dance(Dragon(3), Spiral()), stop=10.0).certificate.claim
    >>> claim.start, claim.stop, claim.excess < 0.001
    (0.0, 10.0, True)
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

    kind: kind of the claim
    start: start of the time asked about [s]
    stop: end of the time asked about [s]
    benches: number of loose benches, the last ones
    reach: furthest that they come from the handle that still follows the path [m]
    stray: largest distance of that handle from its place [m]
    excess: furthest that the polygons go beyond the reach from places of the handle [m]

    >>> from core import Line, Route, tail_reach
    >>> tail_reach(Dance(Dragon(5), Route([Line((0.0, 0.0), (40.0, 0.0))])), 2).certificate.claim.benches
    2
    """

    kind: ClaimKind
    start: float
    stop: float
    benches: int
    reach: float
    stray: float
    excess: float


def format_safe(stray: float) -> str:
    """A stray that is proven safe [m], rounded down to 1e-12 m, so that it stays proven.

    >>> format_safe(0.8250000000000001), format_safe(0.02)
    ('0.825', '0.02')
    """
    return format_number(float(format_bound(stray, 12)))


Claim = ContactClaim | EncounterClaim | StrayClaim | ProbabilityClaim | GroundClaim | TailClaim
