"""Pairs of benches that may touch: all whose upright boxes come within the margin; no touching pair is missed.

A second step keeps those within the margin, by the exact separation of two rectangles.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import ArrayLike, NDArray

from core import kernels
from core.budget import Budget
from core.errors import InvalidValue, TooLarge
from core.shapes.rectangles import POSE, SIZE, checked_array, checked_columns, frames, frames_separation
from core.values import SIZE_MAX, Floats, checked_number

Pairs = NDArray[np.int64]

# Largest number of overlapping pairs in one answer: 10 for each of 100,000 benches; the search takes 200 MB for them.
PAIRS_MAX = 1_000_000
# Largest number of pairs of upright boxes that meet: under a second of search. 100,000 benches on a spiral of pitch
# 0.55 m have 340,000 such pairs without neighbours.
CANDIDATES_MAX = 20_000_000
# The same for the other engines; FCL takes about 5 microseconds for each pair.
CROSS_CANDIDATES_MAX = 2_000_000
# Additional reach of the search, as a part of the coordinates and sizes [1]: each of its few operations rounds by
# 1.1e-16, and so does the separation that it must not miss.
ROUNDING = 4e-15


def checked_benches(
    poses: ArrayLike, lengths: ArrayLike, widths: ArrayLike, margin: float
) -> tuple[Floats, Floats, float]:
    """Poses (n, 3), sizes (n, 2) length and width, and margin, as doubles within their limits.

    raises: InvalidValue with the field benches.K.x, y, heading, length or width, or margin
    """
    pose = checked_array("benches", poses, "(n, 3): x, y, heading", 3)
    if pose.ndim != 2:
        raise InvalidValue("benches", f"benches must have shape (n, 3): x, y, heading, got {pose.shape}")
    length = checked_array("lengths", lengths, "(n,)", None)
    width = checked_array("widths", widths, "(n,)", None)
    for name, column in (("lengths", length), ("widths", width)):
        if column.size != len(pose):
            raise InvalidValue(name, f"{name} must have one number for each of {len(pose)} benches, got {column.size}")
    checked_columns("benches", np.column_stack([pose, length, width]), POSE + SIZE)
    return pose, np.stack([length, width], axis=-1), checked_number("margin", margin, "m", 0.0, SIZE_MAX)


# If two rectangles are within the margin, so are their upright boxes along x and along y; so these boxes meet when they
# are grown by half the margin on every side.
def meeting_pairs(frame: Floats, margin: float, chained: bool, *, exact: bool, budget: Budget | None = None) -> Pairs:
    """Pairs (P, 2), a < b, whose upright boxes meet; if exact, only those within the margin, rounded up.

    frame: rows of rectangles.frames()
    raises: TooLarge with the field benches for more than PAIRS_MAX pairs or CANDIDATES_MAX meeting boxes if exact, for
        more than CROSS_CANDIDATES_MAX otherwise
    """
    half = np.abs(frame[:, 2:4]) * frame[:, 4:5] + np.abs(frame[:, 3:1:-1]) * frame[:, 5:6]
    scale = np.abs(frame[:, :2]).sum(axis=1) + frame[:, 4:].sum(axis=1) + margin
    half += 0.5 * margin + ROUNDING * scale[:, None]
    boxes = np.hstack([frame[:, :2] - half, frame[:, :2] + half])
    leaves = 1 << max(0, (-(-len(frame) // kernels.BOXES_PER_LEAF) - 1).bit_length())
    order = _tree_order(frame[:, :2], leaves)
    frame, boxes, tree = frame[order], boxes[order], np.empty((2 * leaves, kernels.BOX_COLUMNS))
    kernels.grow_tree(boxes, tree)
    most = (PAIRS_MAX, CANDIDATES_MAX) if exact else (CROSS_CANDIDATES_MAX, CROSS_CANDIDATES_MAX)
    words = "within the margin" if exact else "close by", "close by"
    budget = budget or Budget()
    meetings = kernels.Meetings(frame, boxes, tree, order, budget.halt)
    pairs = np.empty((2 * len(frame), 2), dtype=np.int64)
    while True:
        meetings.find(margin, exact, chained, *most, pairs)
        budget.afford(float(meetings.met))
        counts = (meetings.found, meetings.met)
        for count, limit, what in zip(counts, most, words, strict=True):
            if count > limit:
                message = f"benches must have at most {limit} pairs {what}, got more among {len(frame)}"
                raise TooLarge("benches", message)
        if meetings.found <= len(pairs):
            return pairs[: meetings.found]
        pairs = np.empty((meetings.found, 2), dtype=np.int64)


def _tree_order(centres: Floats, leaves: int) -> Pairs:
    """Order of the rows that puts near rows into groups of four: slices with equal counts along x, each sorted along y.

    Slices are made by rank, not by coordinate, so that one distant bench does not push all others into one slice.
    """
    strip = kernels.BOXES_PER_LEAF << (leaves.bit_length() // 2)
    strip_of = np.empty(len(centres), dtype=np.int64)
    strip_of[np.argsort(centres[:, 0], kind="stable")] = np.arange(len(centres)) // strip
    return np.lexsort((centres[:, 1], strip_of))


def pairs_within(poses: Floats, sizes: Floats, margin: float, chained: bool, budget: Budget) -> Iterator[Pairs]:
    """The pairs within the margin at each instant, by the separating axis. poses: (T, n, 3); sizes: (n, 2)"""
    reach = margin + ROUNDING * (margin + 2.0 * sizes.sum(axis=1).max(initial=0.0))
    for frame in frames(poses, sizes):
        pairs = meeting_pairs(frame, reach, chained, exact=True, budget=budget)
        yield pairs[frames_separation(frame[pairs[:, 0]], frame[pairs[:, 1]]).separation <= margin]


def pair_within(poses: Floats, sizes: Floats, margin: float) -> list[bool]:
    """True at each instant at which a single pair is within the margin. poses: (T, 2, 3); sizes: (2, 2)"""
    pairs, gaps = frames(poses, sizes), np.empty(len(poses))
    first, second = (np.ascontiguousarray(pairs[:, bench]) for bench in (0, 1))
    kernels.pair_gaps(first, second, kernels.NO_LIMIT, gaps)
    return [gap <= margin for gap in gaps.tolist()]
