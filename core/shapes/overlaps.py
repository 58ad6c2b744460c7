"""Overlapping benches at one instant, found by four engines, with a comparison of the four; separation of rectangles.

Rectangles that users give are checked here.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from core.checks import SIZE_MAX, SIZE_MIN, checked_number
from core.display import Readable, WithArrays, display
from core.errors import InvalidValue
from core.kernels import Budget
from core.language import Listed, counted, say
from core.quantities import Given, Parameter, Value, from_to, quantities
from core.questions import question_about
from core.shapes.engines import JUDGES, Engine, able, engine_pairs
from core.shapes.rectangles import Pairs, Separation, frames, frames_separation
from core.values import Floats

# Largest value [m], far beyond any dance: a double resolves only 1e-7 m there.
POSITION_MAX = 1e9

# Lowest and highest value, and unit, of each number that describes a rectangle in the plane.
LIMITS = {
    "x": (-POSITION_MAX, POSITION_MAX, "m"),
    "y": (-POSITION_MAX, POSITION_MAX, "m"),
    "heading": (-np.inf, np.inf, "rad"),
    "length": (SIZE_MIN, SIZE_MAX, "m"),
    "width": (SIZE_MIN, SIZE_MAX, "m"),
}
POSE = ("x", "y", "heading")
SIZE = ("length", "width")


@dataclass(frozen=True, slots=True, repr=False, eq=False)
class Overlaps(WithArrays):
    """Pairs of benches that overlap or come within a margin.

    pairs: the pairs, (P, 2), a < b, sorted
    contact: exact separation, witnesses and normal of each pair

    >>> found = overlaps([[0, 0, 0], [0, 0.2, 0]], [2.2] * 2, [0.3] * 2, chained=False)
    >>> found.pairs.tolist(), found.contact.separation.round(3).tolist()
    ([[0, 1]], [-0.1])
    """

    pairs: Pairs
    contact: Separation

    def _line(self) -> str:
        pairs = counted(len(self.pairs), "{count} pair", "{count} pairs")
        return say("{pairs}, separation {gap}", pairs=pairs, gap=display(self.contact.separation, "m"))


@dataclass(frozen=True, slots=True, repr=False, eq=False)
class CrossCheck(WithArrays):
    """The pairs that independent engines find.

    agree: true if all engines that were asked found the same pairs
    pairs: pairs found by each engine
    only: for each engine its pairs that not all engines found
    missing: for each engine the pairs that another engine found and this one did not
    left_out: engines that cannot judge this margin; they appear in no other field

    >>> cross_check([[0, 0, 0], [3, 0, 0], [1, 0, 1.57]], [2.2] * 3, [0.3] * 3).pairs[Engine.FCL].tolist()
    [[0, 2]]
    """

    agree: bool
    pairs: dict[Engine, Pairs]
    only: dict[Engine, Pairs]
    missing: dict[Engine, Pairs]
    left_out: tuple[Engine, ...]

    def _line(self) -> str:
        counts = ", ".join(f"{engine.value} {len(pairs)}" for engine, pairs in self.pairs.items())
        if self.agree:
            return say("agree; pairs by engine: {counts}", counts=counts)
        return say("disagree; pairs by engine: {counts}", counts=counts)

    def _rows(self) -> list[tuple[str, str]]:
        counts = [
            (
                engine.value.replace("_", " "),
                say("{count} pairs, {only} not found by all", count=len(pairs), only=len(self.only[engine])),
            )
            for engine, pairs in self.pairs.items()
        ]
        return [("agree", display(self.agree)), *counts, ("left out", display(self.left_out))]


@dataclass(frozen=True, slots=True)
class Verdict(Readable):
    """Findings of one engine among the benches judged, without pairs of neighbours.

    before: whether it finds any two overlapping, or within the margin, just before; None for a contact at the start
    after: whether it finds the reported pair overlapping, or within the margin, just after, and no other pairs except
        those in together. For a contact at the start other pairs are allowed

    >>> from core import Dance, Dragon, Spiral, contact_check, first_contact
    >>> contact_check(first_contact(Dance(Dragon(), Spiral()))).engines[Engine.ANGLE_SUM]
    Verdict(before=False, after=True)
    """

    before: bool | None
    after: bool


@question_about("poses", object, "the overlapping pairs were not found")
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

    The engine finds the pairs; their separation is always the exact one of separation(). The angle-sum rule misses
    rectangles that cross without a corner inside, and accepts no margin; the other three engines miss no pair.

    poses: (n, 3) x [m], y [m], heading [rad]; lengths, widths: (n,) [m]
    raises: InvalidValue with the field benches.K.x, y, heading, length or width, margin or engine; TooLarge with the
        field benches if the overlapping pairs exceed PAIRS_MAX or the work exceeds CANDIDATES_MAX; TooMuchWork

    >>> overlaps([[0, 0, 0], [3, 0, 0], [1, 0, 1.57]], [2.2] * 3, [0.3] * 3).pairs
    array([[0, 2]])
    """
    pose, size, margin = checked_benches(poses, lengths, widths, margin)
    if not isinstance(engine, str) or engine not in list(Engine):
        raise InvalidValue("engine", "must be one of {engines}", got=Given(engine), engines=Listed(Engine))
    (pairs,) = engine_pairs(engine, pose[None], size, margin, chained=chained, budget=budget)
    frame = frames(pose, size)
    return Overlaps(pairs, frames_separation(frame[pairs[:, 0]], frame[pairs[:, 1]]))


@question_about("poses", object, "the overlapping pairs were not found by all engines")
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

    >>> answer = cross_check([[0, 0, 0], [3, 0, 0], [1, 0, 1.57]], [2.2] * 3, [0.3] * 3)
    >>> answer.agree, answer.pairs[Engine.SHAPELY].tolist()
    (True, [[0, 2]])
    """
    pose, size, margin = checked_benches(poses, lengths, widths, margin)
    pairs_of = {
        engine: engine_pairs(engine, pose[None], size, margin, chained=chained, budget=budget)[0]
        for engine in able(margin)
    }
    codes = {engine: pairs[:, 0] * len(pose) + pairs[:, 1] for engine, pairs in pairs_of.items()}
    some = np.unique(np.concatenate(list(codes.values())))
    every = some[np.all([np.isin(some, code) for code in codes.values()], axis=0)]

    def decoded(code: Pairs) -> Pairs:
        return np.stack(np.divmod(code, max(len(pose), 1)), axis=-1)

    return CrossCheck(
        agree=some.size == every.size,
        pairs=pairs_of,
        only={engine: decoded(np.setdiff1d(code, every)) for engine, code in codes.items()},
        missing={engine: decoded(np.setdiff1d(some, code)) for engine, code in codes.items()},
        left_out=tuple(engine for engine in Engine if engine not in pairs_of),
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
            raise InvalidValue("benches", "must have shape {shape}", got=str(pose.shape), shape="(2, 3): x, y, heading")
    checked_columns("benches", pose_after, POSE)
    poses = np.array([pose_before, pose_after])
    return {engine: Verdict(*JUDGES[engine](poses, size, margin)) for engine in able(margin)}


def separation(poses_a: ArrayLike, sizes_a: ArrayLike, poses_b: ArrayLike, sizes_b: ArrayLike) -> Separation:
    """Signed separation of rectangles a and b, pair by pair.

    Rectangles apart: the Euclidean distance and the nearest points. Overlapping rectangles: minus the length of the
    shortest translation that separates them, the deepest corner, and the point of the face above it. If parallel edges
    meet, the witnesses are the middle of their common stretch. The error is a few ulp of the larger of the sizes and
    the distance; witnesses also round by an ulp of their own coordinates.

    poses: (..., 3) x [m], y [m], heading [rad]; sizes: (..., 2) length [m], width [m]; shapes broadcast
    raises: InvalidValue for a shape that does not fit, a value that is not finite, or one outside LIMITS

    >>> separation([0.0, 0.0, 0.0], [2.0, 1.0], [3.0, 0.0, 0.0], [2.0, 1.0]).separation
    array(1.)
    """
    a = _checked_frames("_a", poses_a, sizes_a)
    b = _checked_frames("_b", poses_b, sizes_b)
    try:
        shape = np.broadcast_shapes(a.shape, b.shape)
    except ValueError as error:
        got = f"{a.shape[:-1]} and {b.shape[:-1]} rectangles"
        raise InvalidValue.in_words("poses_b", "shapes of a and b must broadcast", got=got) from error
    return frames_separation(np.broadcast_to(a, shape), np.broadcast_to(b, shape))


def checked_benches(
    poses: ArrayLike, lengths: ArrayLike, widths: ArrayLike, margin: float
) -> tuple[Floats, Floats, float]:
    """Poses (n, 3), sizes (n, 2) length and width, and margin, as doubles within their limits.

    raises: InvalidValue with the field benches.K.x, y, heading, length or width, or margin
    """
    pose = checked_array("benches", poses, "(n, 3): x, y, heading", 3)
    if pose.ndim != 2:
        raise InvalidValue("benches", "must have shape {shape}", got=str(pose.shape), shape="(n, 3): x, y, heading")
    length = checked_array("lengths", lengths, "(n,)", None)
    width = checked_array("widths", widths, "(n,)", None)
    for name, column in (("lengths", length), ("widths", width)):
        if column.size != len(pose):
            rule = "must have one number for each of {benches} benches"
            raise InvalidValue(name, rule, got=column.size, benches=len(pose))
    checked_columns("benches", np.column_stack([pose, length, width]), POSE + SIZE)
    return pose, np.stack([length, width], axis=-1), checked_number("margin", margin, "m", 0.0, SIZE_MAX)


def checked_columns(subject: str, columns: Floats, names: tuple[str, ...]) -> None:
    """Refuse the first value outside its LIMITS. columns: (n, len(names)).

    raises: InvalidValue with the field subject.row.name, the value, its unit and the limit
    """
    lows, highs = np.array([LIMITS[name][:2] for name in names]).T
    if (np.isfinite(columns) & (columns >= lows) & (columns <= highs)).all():
        return
    for name, column in zip(names, columns.T, strict=True):
        low, high, unit = LIMITS[name]
        wrong = np.flatnonzero(~(np.isfinite(column) & (column >= low) & (column <= high)))
        if wrong.size:
            k = int(wrong[0])
            rule = "must be from {least} to {most}"
            if not np.isfinite(column[k]):
                rule = "must be a finite number"
            elif low > 0.0 and column[k] <= 0.0:
                rule = "must be positive"
            values = from_to(unit, low, high) | quantities(unit, got=column[k])
            raise InvalidValue(f"{subject}.{k}.{name}", rule, **values)


def checked_array(name: str, values: ArrayLike, shape: str, last: int | None) -> Floats:
    """The values as float64 with a last axis of that length (a plain list if None).

    raises: InvalidValue if they are not numbers or have another shape
    """
    try:
        array = np.asarray(values, dtype=np.float64)
    except (TypeError, ValueError, OverflowError) as error:
        raise InvalidValue(name, "must be numbers of shape {shape}", shape=shape) from error
    if (array.ndim != 1) if last is None else (array.shape[-1:] != (last,)):
        raise InvalidValue(name, "must have shape {shape}", got=str(array.shape), shape=shape)
    return array


def _checked_frames(suffix: str, poses: ArrayLike, sizes: ArrayLike) -> Floats:
    pose = checked_array(f"poses{suffix}", poses, "(..., 3): x, y, heading", 3)
    size = checked_array(f"sizes{suffix}", sizes, "(..., 2): length, width", 2)
    checked_columns(f"poses{suffix}", pose.reshape(-1, 3), POSE)
    checked_columns(f"sizes{suffix}", size.reshape(-1, 2), SIZE)
    try:
        return frames(pose, size)
    except ValueError as error:
        words, got = "{poses} and {sizes} must broadcast", f"shapes {pose.shape} and {size.shape}"
        names: dict[str, Value] = {"poses": Parameter(f"poses{suffix}"), "sizes": Parameter(f"sizes{suffix}")}
        raise InvalidValue.in_words(f"sizes{suffix}", words, got=got, **names) from error
