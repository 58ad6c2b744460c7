"""Overlapping benches at one instant, found by four engines, with a comparison of the four."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from core.budget import Budget, bounded
from core.errors import InvalidValue
from core.shapes.broad_phase import Pairs, checked_benches
from core.shapes.engines import JUDGES, Engine, able, found_pairs
from core.shapes.rectangles import POSE, Separation, checked_array, checked_columns, frames, frames_separation
from core.shown import Shown, counted, worded


@dataclass(frozen=True, slots=True, repr=False)
class Overlaps(Shown):
    """pairs (P, 2), a < b, sorted; contact: exact separation, witnesses and normal of each pair (P, ...)."""

    pairs: Pairs
    contact: Separation

    def _line(self) -> str:
        return f"{counted(len(self.pairs), 'pair')}, separation {worded(self.contact.separation, 'm')}"


@dataclass(frozen=True, slots=True, repr=False)
class CrossCheck(Shown):
    """pairs: found by each engine; agree: True if all are equal; only: for each engine its pairs that not all engines
    found; missing: for each engine the pairs that another engine found and this one did not
    left_out: engines that cannot judge this margin; they appear in no other field
    """

    agree: bool
    pairs: dict[Engine, Pairs]
    only: dict[Engine, Pairs]
    missing: dict[Engine, Pairs]
    left_out: tuple[Engine, ...]

    def _line(self) -> str:
        found = ", ".join(f"{engine.value} {len(pairs)}" for engine, pairs in self.pairs.items())
        return f"{'agree' if self.agree else 'disagree'}; pairs by engine: {found}"

    def _rows(self) -> list[tuple[str, str]]:
        counts = [
            (engine.value, f"{counted(len(pairs), 'pair')}, {len(self.only[engine])} not found by all")
            for engine, pairs in self.pairs.items()
        ]
        return [("agree", worded(self.agree)), *counts, ("left out", worded(self.left_out))]


@dataclass(frozen=True, slots=True)
class Verdict(Shown):
    """True if an engine finds the pair overlapping just before, and just after first contact; None: no time before."""

    before: bool | None
    after: bool


@bounded("which of them overlap was not found")
def overlaps(
    poses: ArrayLike,
    lengths: ArrayLike,
    widths: ArrayLike,
    *,
    engine: Engine = Engine.SEPARATING_AXIS,
    margin: float = 0.0,
    chained: bool = True,
    budget: Budget | None = None,
) -> Overlaps:
    """All pairs with separation <= margin; if chained, without neighbours in the chain.

    The engine finds the pairs; their separation is always the exact one of rectangles.py. The angle-sum rule misses
    rectangles that cross without a corner inside, and accepts no margin; the other three engines miss no pair.

    poses: (n, 3) x [m], y [m], heading [rad]; lengths, widths: (n,) [m]
    raises: InvalidValue with the field benches.K.x, y, heading, length or width, margin or engine; TooLarge with the
        field benches if the overlapping pairs exceed PAIRS_MAX or the work exceeds CANDIDATES_MAX; TooMuchWork

    >>> overlaps([[0, 0, 0], [3, 0, 0], [1, 0, 1.57]], [2.2] * 3, [0.3] * 3).pairs
    array([[0, 2]])
    """
    pose, size, margin = checked_benches(poses, lengths, widths, margin)
    if not isinstance(engine, str) or engine not in list(Engine):
        words = ", ".join(Engine)
        raise InvalidValue("engine", f"engine must be one of {words}, got {engine!r:.60}")
    (pairs,) = found_pairs(engine, pose[None], size, margin, chained=chained, budget=budget)
    frame = frames(pose, size)
    return Overlaps(pairs, frames_separation(frame[pairs[:, 0]], frame[pairs[:, 1]]))


@bounded("which of them overlap was not found by all engines")
def cross_check(
    poses: ArrayLike,
    lengths: ArrayLike,
    widths: ArrayLike,
    *,
    margin: float = 0.0,
    chained: bool = True,
    budget: Budget | None = None,
) -> CrossCheck:
    """The verdicts of the four engines at one instant (three if the margin is not 0).

    poses, lengths, widths, raises: as overlaps(), with CROSS_CANDIDATES_MAX
    """
    pose, size, margin = checked_benches(poses, lengths, widths, margin)
    found = {
        engine: found_pairs(engine, pose[None], size, margin, chained=chained, budget=budget)[0]
        for engine in able(margin)
    }
    codes = {engine: pairs[:, 0] * len(pose) + pairs[:, 1] for engine, pairs in found.items()}
    some = np.unique(np.concatenate(list(codes.values())))
    every = some[np.all([np.isin(some, code) for code in codes.values()], axis=0)]

    def decoded(code: Pairs) -> Pairs:
        return np.stack(np.divmod(code, max(len(pose), 1)), axis=-1)

    return CrossCheck(
        agree=some.size == every.size,
        pairs=found,
        only={engine: decoded(np.setdiff1d(code, every)) for engine, code in codes.items()},
        missing={engine: decoded(np.setdiff1d(some, code)) for engine, code in codes.items()},
        left_out=tuple(engine for engine in Engine if engine not in found),
    )


def verdicts(
    before: ArrayLike, after: ArrayLike, lengths: ArrayLike, widths: ArrayLike, *, margin: float = 0.0
) -> dict[Engine, Verdict]:
    """Each engine's verdict on one pair just before and just after contact (no angle sum if the margin is not 0).

    before, after: (2, 3) poses of the two benches; lengths, widths: (2,) [m]
    raises: InvalidValue as overlaps(), and with the field benches if they are not two

    >>> verdicts([[0, 0, 0], [0, 0.4, 0]], [[0, 0, 0], [0, 0.2, 0]], [2.2] * 2, [0.3] * 2)[Engine.FCL]
    Verdict(before=False, after=True)
    """
    pose_before, size, margin = checked_benches(before, lengths, widths, margin)
    pose_after = checked_array("benches", after, "(2, 3): x, y, heading", 3)
    for pose in (pose_before, pose_after):
        if pose.shape != (2, 3):
            raise InvalidValue("benches", f"benches must have shape (2, 3): x, y, heading, got {pose.shape}")
    checked_columns("benches", pose_after, POSE)
    poses = np.array([pose_before, pose_after])
    return {engine: Verdict(*JUDGES[engine](poses, size, margin)) for engine in able(margin)}
