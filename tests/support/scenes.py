"""Rectangles for tests, and slow answers about their pairs."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from core import separation
from core.values import Floats

Pairs = NDArray[np.int64]
# Poses (n, 3) [m, m, rad], lengths and widths (n,) [m].
Scene = tuple[Floats, Floats, Floats]
LENGTH, WIDTH = 2.2, 0.3


def benches(*poses: tuple[float, float, float]) -> Scene:
    """Equal benches at the given poses."""
    return np.array(poses, dtype=float).reshape(-1, 3), np.full(len(poses), LENGTH), np.full(len(poses), WIDTH)


def crowd(count: int, seed: int, *, side: float, smallest: float = 0.05, largest: float = 5.0) -> Scene:
    """Benches of mixed sizes in a square."""
    random = np.random.default_rng(seed)
    pose = np.stack([*random.uniform(0.0, side, (2, count)), random.uniform(-4.0, 4.0, count)], axis=-1)
    size = 10 ** random.uniform(math.log10(smallest), math.log10(largest), (2, count))
    return pose, size[0], size[1]


def all_gaps(scene: Scene) -> Floats:
    """Oracle: the separation of every pair, (n, n) [m]."""
    pose, length, width = scene
    size = np.stack([length, width], axis=-1)
    return separation(pose[:, None], size[:, None], pose[None], size[None]).separation


def all_pairs(scene: Scene, margin: float = 0.0) -> Pairs:
    """Oracle: every pair within the margin, (N, 2)."""
    return np.argwhere(np.triu(all_gaps(scene) <= margin, k=1))


def unlinked_pairs(pose: Floats, size: Floats, margin: float = 0.0) -> set[tuple[int, int]]:
    """Oracle: every pair that shares no handle, one by one, within the margin."""
    gaps = separation(pose[:, None], size[:, None], pose[None], size[None]).separation
    return {(int(a), int(b)) for a, b in np.argwhere(np.triu(gaps <= margin, k=2))}
