"""Exact signed separation of two oriented rectangles, with witness points and normal.

The derivation is in core/kernels/rectangles.py: the separating axis theorem for rectangles that meet; for rectangles
apart, the least distance from a corner of one to the other.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from core import kernels
from core.errors import InvalidValue, said
from core.kernels.constants import (
    FRAME_COLUMNS,
    FRAME_HALF_LENGTH,
    FRAME_UX,
    FRAME_UY,
    FRAME_X,
    FRAME_Y,
    NORMAL_X,
    NORMAL_Y,
    SEPARATION,
    SEPARATION_COLUMNS,
    WITNESS_AX,
    WITNESS_AY,
    WITNESS_BX,
    WITNESS_BY,
)
from core.shown import Shown, worded
from core.values import SIZE_MAX, SIZE_MIN, Floats

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

# Sides of the centre on which the corners lie, in units of (half length, half width).
CORNER_SIDES = np.array([[1.0, 1.0], [1.0, -1.0], [-1.0, -1.0], [-1.0, 1.0]])


@dataclass(frozen=True, slots=True, repr=False)
class Separation(Shown):
    """separation (...) [m]: > 0 apart, 0 touching, < 0 minus the penetration depth;
    witness_a, witness_b (..., 2) [m]; normal (..., 2) from a to b.

    Invariant: witness_b - witness_a == separation * normal, also in penetration.
    """

    separation: Floats
    witness_a: Floats
    witness_b: Floats
    normal: Floats

    def _line(self) -> str:
        if not self.separation.ndim:
            return worded(self.separation.item(), "m")
        return worded(self.separation, "m")


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
        raise InvalidValue(
            "poses_b", f"shapes of a and b must broadcast, got {a.shape[:-1]} and {b.shape[:-1]} rectangles"
        ) from error
    return frames_separation(np.broadcast_to(a, shape), np.broadcast_to(b, shape))


def frames_separation(a: Floats, b: Floats) -> Separation:
    """Signed separation of rectangles given as frames. a, b: (..., 6) as frames() returns, of equal shape."""
    shape = a.shape[:-1]
    out = np.empty((a.size // FRAME_COLUMNS, SEPARATION_COLUMNS))
    rows_a, rows_b = (np.require(frame, requirements=["C", "W"]).reshape(-1, FRAME_COLUMNS) for frame in (a, b))
    kernels.pair_separations(rows_a, rows_b, out)
    return Separation(
        separation=out[:, SEPARATION].reshape(shape),
        witness_a=out[:, WITNESS_AX : WITNESS_AY + 1].reshape(*shape, 2),
        witness_b=out[:, WITNESS_BX : WITNESS_BY + 1].reshape(*shape, 2),
        normal=out[:, NORMAL_X : NORMAL_Y + 1].reshape(*shape, 2),
    )


def frames(poses: Floats, sizes: Floats) -> Floats:
    """Rectangles in the form of the kernels: x, y, unit vector (x, y) along the length, half length, half width.

    poses: (..., 3) x [m], y [m], heading [rad]; sizes: (..., 2) length [m], width [m]; shapes broadcast
    returns: (..., 6), never a view
    """
    shape = np.broadcast_shapes(poses.shape[:-1], sizes.shape[:-1])
    out = np.empty((*shape, FRAME_COLUMNS))
    out[..., FRAME_X : FRAME_Y + 1] = poses[..., :2]
    out[..., FRAME_UX] = np.cos(poses[..., 2])
    out[..., FRAME_UY] = np.sin(poses[..., 2])
    out[..., FRAME_HALF_LENGTH:] = 0.5 * sizes
    return out


def corners(poses: Floats, sizes: Floats) -> Floats:
    """Corners (..., 4, 2) [m]: front-left, front-right, rear-right, rear-left.

    poses: (..., 3) x [m], y [m], heading [rad]; sizes: (..., 2) length [m], width [m]; shapes broadcast

    >>> corners(np.array([1.0, 0.0, 0.0]), np.array([2.0, 1.0])).tolist()
    [[2.0, 0.5], [2.0, -0.5], [0.0, -0.5], [0.0, 0.5]]
    """
    frame = frames(np.asarray(poses, dtype=np.float64), np.asarray(sizes, dtype=np.float64))[..., None, :]
    along = CORNER_SIDES[:, :1] * frame[..., 4:5] * frame[..., 2:4]
    left = CORNER_SIDES[:, 1:] * frame[..., 5:6] * (frame[..., 3:1:-1] * [-1.0, 1.0])
    return frame[..., :2] + along + left


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
            limit = f"from {low:g} to {high:g} {unit}"
            if not np.isfinite(column[k]):
                limit = "a finite number"
            elif low > 0.0 and column[k] <= 0.0:
                limit = "positive"
            raise InvalidValue(
                f"{subject}.{k}.{name}", f"{subject}[{k}].{name} must be {limit}, got {said(column[k])} {unit}"
            )


def checked_array(name: str, values: ArrayLike, shape: str, last: int | None) -> Floats:
    """The values as float64 with a last axis of that length (a plain list if None).

    raises: InvalidValue if they are no numbers or have another shape
    """
    try:
        array = np.asarray(values, dtype=np.float64)
    except (TypeError, ValueError) as error:
        raise InvalidValue(name, f"{name} must be numbers of shape {shape}") from error
    if (array.ndim != 1) if last is None else (array.shape[-1:] != (last,)):
        raise InvalidValue(name, f"{name} must have shape {shape}, got {array.shape}")
    return array


def _checked_frames(suffix: str, poses: ArrayLike, sizes: ArrayLike) -> Floats:
    pose = checked_array(f"poses{suffix}", poses, "(..., 3): x, y, heading", 3)
    size = checked_array(f"sizes{suffix}", sizes, "(..., 2): length, width", 2)
    checked_columns(f"poses{suffix}", pose.reshape(-1, 3), POSE)
    checked_columns(f"sizes{suffix}", size.reshape(-1, 2), SIZE)
    try:
        return frames(pose, size)
    except ValueError as error:
        raise InvalidValue(
            f"sizes{suffix}",
            f"poses{suffix} and sizes{suffix} must broadcast, got shapes {pose.shape} and {size.shape}",
        ) from error
