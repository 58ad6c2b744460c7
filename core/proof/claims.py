"""Claims about a spiral: a collision time and a minimum pitch. Each has a statement, a way and an overlap."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from functools import cached_property
from typing import Any, ClassVar

from flint import arb

from core.checks import SIZE_MIN, checked_number, checked_size
from core.contact.search import MARGIN_MAX
from core.dance import checked_head_speed
from core.dragon import Dragon
from core.errors import ProofRefused
from core.language import phrase, say
from core.paths.spiral import Spiral, end_theta
from core.proof.chain import Chain, delta_guess
from core.proof.fold import verify_fold
from core.proof.pairs import Unfinished, Unproven, above, below
from core.proof.sweeps import AnyChain, SweepOverlap, proven_sweeps, searched_stretches
from core.proof.words import apart_words, contact_words, danced_words, dragon_words, near_words, spiral_words
from core.quantities import Quantity, Value, format_number, quantities
from core.sampling import bisect
from core.values import Progress

# Half the bracket around a collision time [s], and the step below a minimum pitch [m]: exact decimals, in balls.
TIME_BRACKET = "1e-10"
PITCH_STEP = "1e-6"
STEP: dict[str, Value] = {"step": Quantity(float(PITCH_STEP), "m", text=f"{PITCH_STEP} m")}
# A fold is proven between two places of the head, each at this relative distance from the place that doubles find [1].
# Doubles are within 1e-12 of it; if the fold only just exists, 12. finds no wall from farther away.
FOLD_WITHIN = (1e-9, 1e-11)


@dataclass(frozen=True)
class Claim:
    """A claim about a dragon.

    way: (highest, lowest) place of the head between which nothing may touch [rad], [m]
    find_overlap(): the record of an overlap that verify_overlap() verifies, returning the whole claim in words
    kind: name of the claim in certificates; search_share: fraction of a proof's work in find_overlap(); follows: see
        proven_sweeps()
    """

    kind: ClassVar[str]
    search_share: ClassVar[float] = 0.0
    dragon: Dragon

    @property
    def follows(self) -> bool:
        return False


@dataclass(frozen=True)
class SpiralClaim(Claim):
    """A claim about a dragon on a spiral."""

    pitch: float
    start_turns: float


@dataclass(frozen=True)
class CollisionTimeClaim(SpiralClaim):
    """Nothing touches in [0, time - 1e-10], and one pair strictly overlaps at time + 1e-10 [s].

    margin: [m]; if positive, nothing comes within it, and one pair is strictly nearer
    """

    kind: ClassVar[str] = "collision-time"
    head_speed: float
    time: float
    margin: float = 0.0

    def __post_init__(self) -> None:
        path, speed = Spiral(self.pitch, self.start_turns), checked_head_speed(self.head_speed)
        time = checked_number("time", self.time, "s", 0.0, path.length / speed)
        margin = checked_margin(self.margin)
        settle(self, pitch=path.pitch, start_turns=path.start_turns, head_speed=speed, time=time, margin=margin)

    @cached_property
    def chain(self) -> Chain:
        return Chain(self.dragon, arb(self.pitch), self.start_turns, self.margin)

    @property
    def _after(self) -> arb:
        return self.chain.place_after((self.time + arb(TIME_BRACKET)) * self.head_speed)

    @property
    def way(self) -> tuple[float, float]:
        before = self.chain.place_after((self.time - arb(TIME_BRACKET)) * self.head_speed)
        return above(self.chain.start), below(before)

    def find_overlap(self, progress: Progress) -> dict[str, Any]:
        return {"benches": near_pair(self.chain, self._after, self.time)}

    def verify_overlap(self, overlap: dict[str, Any]) -> str:
        a, b = overlap["benches"]
        verify_near(self.chain, self._after, a, b, when=soon_after(self.time))
        clear = bool(self.time - arb(TIME_BRACKET) > 0)
        words = contact_words([a, b], self.margin, 0.0, self.time, TIME_BRACKET, clear=clear)
        danced = danced_words(self.dragon, self.head_speed, spiral_words(self.pitch, self.start_turns))
        return say("{name}: {text}", name=danced, text=words)


@dataclass(frozen=True)
class MinimumPitchClaim(SpiralClaim):
    """Every bench follows and nothing touches on the head's way from the start to the circle; with 1e-6 m less one pair
    overlaps on it, or one bench folds.

    margin: as of CollisionTimeClaim
    """

    kind: ClassVar[str] = "minimum-pitch"
    search_share: ClassVar[float] = 0.5
    turning_radius: float
    margin: float = 0.0

    @property
    def follows(self) -> bool:
        return True

    def __post_init__(self) -> None:
        path, radius = Spiral(self.pitch, self.start_turns), checked_size("turning_radius", self.turning_radius)
        margin = checked_margin(self.margin)
        settle(self, pitch=path.pitch, start_turns=path.start_turns, turning_radius=radius, margin=margin)

    @cached_property
    def chain(self) -> Chain:
        return Chain(self.dragon, arb(self.pitch), self.start_turns, self.margin)

    @cached_property
    def _less(self) -> Chain:
        return Chain(self.dragon, self.pitch - arb(PITCH_STEP), self.start_turns, self.margin)

    @property
    def way(self) -> tuple[float, float]:
        return self._way(self.chain)

    def _way(self, chain: Chain) -> tuple[float, float]:
        circle = self.turning_radius / chain.growth
        if circle > chain.start:
            words = "with pitch {pitch} the start lies within the turning circle"
            raise ProofRefused.in_words("claim", words, pitch=Quantity(self.pitch, "m"))
        return above(chain.start), below(circle)

    def find_overlap(self, progress: Progress) -> dict[str, Any]:
        less = self._less
        circle = self.turning_radius / less.growth
        if circle > less.start:
            return {"start_within_circle": True}
        if fold := self._find_fold(below(less.start), above(circle)):
            return fold
        try:
            proven_sweeps(less, *self._way(less), less.repeats_from, searched_stretches(less), progress, follows=False)
        except SweepOverlap as overlap:
            theta = head_theta(less, overlap.a, overlap.place, below(circle), above(less.start))
            theta = max(min(theta, below(less.start)), above(circle))
            return {"benches": [overlap.a, overlap.b], "head_theta": theta}
        words = "{step} less than pitch {pitch} is free of contact too"
        if self.margin:
            words = "{step} less than pitch {pitch} keeps the margin of {margin} too"
        values = quantities("m", pitch=self.pitch, margin=self.margin) | STEP
        raise ProofRefused.in_words("claim", words, **values)

    def _find_fold(self, start: float, circle: float) -> dict[str, Any]:
        """The fold on the way with PITCH_STEP less, as doubles find it; empty if no bench folds [rad]."""
        less = Spiral(max(self.pitch - float(PITCH_STEP), SIZE_MIN), self.start_turns)
        theta, bench = end_theta(self.dragon, less)
        if bench is None or not circle < theta < start:
            return {}
        for within in FOLD_WITHIN:
            places = [min(start, theta * (1.0 + within)), max(circle, theta * (1.0 - within))]
            with suppress(Unproven):
                verify_fold(self._less, bench, *map(arb, places))
                break
        return {"folds": bench, "head_theta": places}

    def verify_overlap(self, overlap: dict[str, Any]) -> str:
        less = self._less
        circle = self.turning_radius / less.growth
        if "folds" in overlap:
            bench, (before, after) = overlap["folds"], overlap["head_theta"]
            if not (bench < less.count and circle <= after < before <= less.start):
                raise Unproven("bench {bench} is not shown to fold on the way with {step} less", bench=bench, **STEP)
            verify_fold(less, bench, arb(before), arb(after))
            ending = say("bench {bench} cannot follow so far (it folds)", bench=bench)
        elif "benches" in overlap:
            (a, b), theta = overlap["benches"], overlap["head_theta"]
            if not circle <= theta <= less.start:
                raise Unproven(NOT_SHOWN[False, False], a=a, b=b, **STEP)
            verify_near(less, arb(theta), a, b, **STEP)
            ending = say("{pair} on the way", pair=near_words([a, b], self.margin))
        else:
            if not circle > less.start:
                raise Unproven("the start is not shown to lie within the circle with {step} less", **STEP)
            ending = say("the start lies within the circle")
        turns, pitch, radius = map(format_number, (self.start_turns, self.pitch, self.turning_radius))
        return say(
            "{dragon} on the spiral inwards from {turns} turns: with pitch {pitch} m every bench follows and {apart} "
            "until the head is {radius} m from the centre, and with {step} m less {ending}. This says nothing of "
            "larger pitches.",
            dragon=dragon_words(self.dragon), turns=turns, pitch=pitch, apart=apart_words(self.margin), radius=radius,
            step=PITCH_STEP, ending=ending,
        )  # fmt: skip


def checked_margin(margin: float) -> float:
    """margin [m] if it lies in the allowed range."""
    return checked_number("margin", margin, "m", 0.0, MARGIN_MAX)


def settle(claim: object, **checked: float) -> None:
    """Put checked values into a claim."""
    for name, value in checked.items():
        object.__setattr__(claim, name, value)


def soon_after(time: float, bracket: str = TIME_BRACKET) -> Quantity:
    """The end of the bracket after a time in a message [s]."""
    return Quantity(time + float(bracket), "s", text=f"{format_number(time)} + {bracket} s")


def near_pair(chain: AnyChain, head: arb, time: float) -> list[int]:
    """Two benches a < b that strictly overlap, or are nearer than the margin, and are not neighbours.

    head: its place [rad], [m], soon after this time [s]; raises: ProofRefused if there are none
    """
    place = head
    for bench in range(chain.count - 2):
        pose = chain.pose_at(bench, place)
        pose.grow_to(2)
        for partner in range(2, chain.count - bench):
            if pose.far_from(partner):
                break
            pose.grow_to(partner + 1)
            if pose.within(partner, chain.margin):
                return [bench, bench + partner]
        place = pose.places[1]
    words = "no two benches overlap at {when}"
    if chain.margin > 0:
        words = "no two benches come nearer to one another than {margin} at {when}"
    values = {"margin": Quantity(float(chain.margin), "m"), "when": soon_after(time)}
    raise ProofRefused.in_words("claim", words, **values)


# What verify_near() cannot show, by whether there is a margin, and whether a time is given.
NOT_SHOWN = {
    (False, False): phrase("benches {a} and {b} are not shown to overlap on the way with {step} less"),
    (False, True): phrase("benches {a} and {b} are not shown to overlap at {when}"),
    (True, False): phrase("benches {a} and {b} are not shown to be nearer than {margin} on the way with {step} less"),
    (True, True): phrase("benches {a} and {b} are not shown to be nearer than {margin} at {when}"),
}


def verify_near(chain: AnyChain, head: arb, a: int, b: int, /, **values: Value) -> None:
    """Check that benches a < b strictly overlap, or are nearer than the margin, and are not neighbours.

    head: its place [rad], [m]; values: its time as `when`, or the step of the pitch; raises: Unproven
    """
    checked_pair(chain, a, b)
    pose = chain.pose_at(0, head)
    pose.grow_to(a)
    pose = chain.pose_at(a, pose.places[a])
    pose.grow_to(b - a + 1)
    if not pose.within(b - a, chain.margin):
        words = NOT_SHOWN[chain.margin > 0, "when" in values]
        values |= {"a": a, "b": b, "margin": Quantity(float(chain.margin), "m")}
        raise Unproven(words, **values)


def checked_pair(chain: AnyChain, a: int, b: int) -> tuple[int, int]:
    """Two benches a < b if they share no handle. raises: Unproven"""
    if not 0 <= a < b - 1 < chain.count - 1:
        words = "benches must be two of this dragon that share no handle, in order, got {a} and {b}"
        raise Unproven(words, a=a, b=b)
    return a, b


def head_theta(chain: Chain, handle: int, theta: float, low: float, high: float) -> float:
    """Place of the head, between low and high, when a handle is at theta, approximately [rad]."""

    def is_beyond(theta_handle: float) -> bool:
        for needed in chain.needed[:handle]:
            theta_handle += delta_guess(theta_handle, float(needed))
        return theta_handle > theta

    return bisect(is_beyond, low, high)[1] if handle else theta


@contextmanager
def refusing(field: str) -> Iterator[None]:
    """Turn Unproven into ProofRefused."""
    try:
        yield
    except Unfinished as why:
        raise ProofRefused.in_words(field, f"not proven: {why.template}", **why.values) from None
