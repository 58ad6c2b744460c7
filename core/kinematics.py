"""Where every handle and bench is, and how fast."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from enum import StrEnum

from core.dragon import Dragon, Floats
from core.paths import Spiral


class EndReason(StrEnum):
    """Why a run ends: a chord has no continuous solution any more, or the head is at the centre."""

    FOLD = "fold"
    CENTRE = "centre"


@dataclass(frozen=True, slots=True)
class RunEnd:
    """Where the run ends: reason, time [s], theta of the head [rad], the bench that cannot follow (None at the centre)."""

    reason: EndReason
    time: float
    theta: float
    bench: int | None


@dataclass(frozen=True, slots=True)
class Trajectory:
    """time (T,) [s]; position (T, n + 1, 2) [m]; velocity (T, n + 1, 2) [m/s]; speed (T, n + 1) [m/s]."""

    time: Floats
    position: Floats
    velocity: Floats
    speed: Floats


def trajectory(
    dragon: Dragon, path: Spiral, times: Floats | Sequence[float], *, head_speed: float = 1.0
) -> Trajectory:
    """Position and velocity of every handle at every time.

    times: (T,) [s], 0 at the start; negative times lie on the outward extension
    raises: OutsideRun (field 'times') after the end of the run; InvalidValue for head_speed or times
    """
    raise NotImplementedError


def run_end(dragon: Dragon, path: Spiral, *, head_speed: float = 1.0) -> RunEnd:
    """Where the run ends: the fold or the centre."""
    raise NotImplementedError


def bench_poses(handles: Floats) -> Floats:
    """Pose of every bench from the handles at its two ends."""
    raise NotImplementedError
