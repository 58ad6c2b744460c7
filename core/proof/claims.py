"""The two claims: what each says, which way has to be swept, and which overlap has to be shown."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from functools import cached_property
from typing import Any, ClassVar

from flint import arb

from core.dragon import Dragon, checked_number, checked_size
from core.errors import ProofRefused
from core.kinematics import checked_head_speed
from core.paths import Spiral
from core.proof.chain import Chain, Pose, Unproven, above, below, bend_guess
from core.proof.sweeps import Overlap, Progress, found, swept

# Half the bracket around a collision time [s], and the step below a minimum pitch [m]: exact decimals, in balls.
TIME_BRACKET = "1e-10"
PITCH_STEP = "1e-6"
# Halvings that bring the head's theta to the last digit of a double.
HALVINGS = 60


@dataclass(frozen=True)
class CollisionTime:
    """Nothing touches in [0, time - 1e-10], and one pair strictly overlaps at time + 1e-10 [s].

    way: (highest, lowest) theta of the head between which nothing may touch [rad]
    find_overlap(): the record of an overlap that check_overlap() verifies, returning the whole claim in words
    search_share: how much of the work of a proof find_overlap() is
    """

    kind: ClassVar[str] = "collision-time"
    search_share: ClassVar[float] = 0.0
    dragon: Dragon
    pitch: float
    start_turns: float
    head_speed: float
    time: float

    def __post_init__(self) -> None:
        path, speed = Spiral(self.pitch, self.start_turns), checked_head_speed(self.head_speed)
        time = checked_number("time", self.time, "s", 0.0, path.length / speed)
        _set(self, pitch=path.pitch, start_turns=path.start_turns, head_speed=speed, time=time)

    @cached_property
    def chain(self) -> Chain:
        return Chain(self.dragon, arb(self.pitch), self.start_turns)

    @property
    def _after(self) -> arb:
        return self.chain.theta_after((self.time + arb(TIME_BRACKET)) * self.head_speed)

    @property
    def way(self) -> tuple[float, float]:
        before = self.chain.theta_after((self.time - arb(TIME_BRACKET)) * self.head_speed)
        return above(self.chain.start), below(before)

    def find_overlap(self, progress: Progress) -> dict[str, Any]:
        chain, theta = self.chain, self._after
        for bench in range(chain.count - 2):
            pose = Pose(chain, bench, theta)
            pose.grow(2)
            while bench + len(pose.bends) < chain.count and not chain.far(bench, pose.thetas[1], pose.thetas[-1]):
                pose.grow()
                partner = len(pose.bends) - 1
                if pose.overlapping(partner):
                    return {"benches": [bench, bench + partner]}
            theta = pose.thetas[1]
        raise ProofRefused("claim", f"no two benches overlap at {self.time!r} + {TIME_BRACKET} s")

    def check_overlap(self, overlap: dict[str, Any]) -> str:
        a, b = overlap["benches"]
        if not overlapping(self.chain, self._after, a, b):
            raise Unproven(f"benches {a} and {b} are not shown to overlap at {self.time!r} + {TIME_BRACKET} s")
        return (
            f"Of {self.chain.count} benches no two but neighbours touch before {self.time!r} - {TIME_BRACKET} s, "
            f"and benches {a} and {b} overlap at {self.time!r} + {TIME_BRACKET} s."
        )


@dataclass(frozen=True)
class MinimumPitch:
    """Nothing touches on the head's way from the start to the circle; with 1e-6 m less one pair overlaps on it.

    way, find_overlap(), check_overlap(), search_share: as of CollisionTime
    """

    kind: ClassVar[str] = "minimum-pitch"
    search_share: ClassVar[float] = 0.5
    dragon: Dragon
    pitch: float
    start_turns: float
    turning_radius: float

    def __post_init__(self) -> None:
        path, radius = Spiral(self.pitch, self.start_turns), checked_size("turning_radius", self.turning_radius)
        _set(self, pitch=path.pitch, start_turns=path.start_turns, turning_radius=radius)

    @cached_property
    def chain(self) -> Chain:
        return Chain(self.dragon, arb(self.pitch), self.start_turns)

    @cached_property
    def _less(self) -> Chain:
        return Chain(self.dragon, self.pitch - arb(PITCH_STEP), self.start_turns)

    @property
    def way(self) -> tuple[float, float]:
        return self._way(self.chain)

    def _way(self, chain: Chain) -> tuple[float, float]:
        circle = self.turning_radius / chain.growth
        if circle > chain.start:
            raise ProofRefused("claim", f"with pitch {self.pitch!r} m the start lies within the turning circle")
        return above(chain.start), below(circle)

    def find_overlap(self, progress: Progress) -> dict[str, Any]:
        less = self._less
        circle = self.turning_radius / less.growth
        if circle > less.start:
            return {"start_within_circle": True}
        try:
            swept(less, *self._way(less), less.repeats_from, found(less), progress)
        except Overlap as overlap:
            theta = head_theta(less, overlap.a, overlap.theta, below(circle), above(less.start))
            theta = max(min(theta, below(less.start)), above(circle))
            return {"benches": [overlap.a, overlap.b], "head_theta": theta}
        raise ProofRefused("claim", f"{PITCH_STEP} m less than pitch {self.pitch!r} m is free of contact too")

    def check_overlap(self, overlap: dict[str, Any]) -> str:
        less = self._less
        circle = self.turning_radius / less.growth
        if "benches" in overlap:
            (a, b), theta = overlap["benches"], overlap["head_theta"]
            if not (circle <= theta <= less.start and overlapping(less, arb(theta), a, b)):
                raise Unproven(f"benches {a} and {b} are not shown to overlap on the way with {PITCH_STEP} m less")
            why = f"benches {a} and {b} overlap on the way"
        else:
            if not circle > less.start:
                raise Unproven(f"the start is not shown to lie within the circle with {PITCH_STEP} m less")
            why = "the start lies within the circle"
        return (
            f"With pitch {self.pitch!r} m no two of {less.count} benches but neighbours touch until the head is "
            f"{self.turning_radius!r} m from the centre, and with {PITCH_STEP} m less {why}."
        )


def _set(claim: object, **checked: float) -> None:
    for name, value in checked.items():
        object.__setattr__(claim, name, value)


def overlapping(chain: Chain, head: arb, a: int, b: int) -> bool:
    """Do benches a < b, no neighbours, strictly overlap when the head is there? head: [rad]"""
    if not 0 <= a < b - 1 < chain.count - 1:
        raise Unproven(f"benches {a} and {b} are no pair")
    pose = Pose(chain, 0, head)
    pose.grow(a)
    pose = Pose(chain, a, pose.thetas[-1])
    pose.grow(b - a + 1)
    return pose.overlapping(b - a)


def head_theta(chain: Chain, handle: int, theta: float, low: float, high: float) -> float:
    """Where the head is, between low and high, when a handle is at theta, about [rad]."""
    for _ in range(HALVINGS if handle else 0):
        theta_handle = middle = (low + high) / 2
        for size in chain.sizes[:handle]:
            theta_handle += bend_guess(theta_handle, float(size.needed))
        low, high = (low, middle) if theta_handle > theta else (middle, high)
    return high if handle else theta


@contextmanager
def refusing(field: str) -> Iterator[None]:
    """Turn what is not proven into ProofRefused."""
    try:
        yield
    except (Overlap, Unproven) as why:
        raise ProofRefused(field, f"not proven: {why}") from None


Claim = CollisionTime | MinimumPitch
