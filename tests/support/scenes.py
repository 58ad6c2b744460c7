"""Rectangles for tests, and slow answers about their pairs."""

import math

import numpy as np
import shapely

from core import separation

LENGTH = 2.2
WIDTH = 0.3


def benches(*poses):
    """Equal benches at these poses: a scene, which is poses (n, 3) [m, m, rad], lengths and widths (n,) [m]."""
    return np.array(poses, dtype=float).reshape(-1, 3), np.full(len(poses), LENGTH), np.full(len(poses), WIDTH)


def lengths_and_widths(dragon):
    """Sizes (n, 2) of its benches [m]."""
    return np.stack([dragon.lengths, dragon.widths], axis=-1)


def crowd(count, seed, *, side, smallest=0.05, largest=5.0):
    """Benches of mixed sizes in a square."""
    random = np.random.default_rng(seed)
    pose = np.stack([*random.uniform(0.0, side, (2, count)), random.uniform(-4.0, 4.0, count)], axis=-1)
    size = 10 ** random.uniform(math.log10(smallest), math.log10(largest), (2, count))
    return pose, size[0], size[1]


def all_gaps(scene):
    """Oracle: the separation of every pair, (n, n) [m]."""
    pose, length, width = scene
    size = np.stack([length, width], axis=-1)
    return separation(pose[:, None], size[:, None], pose[None], size[None]).separation


def all_pairs(scene, margin=0.0):
    """Oracle: every pair within the margin, (N, 2)."""
    return np.argwhere(np.triu(all_gaps(scene) <= margin, k=1))


def unlinked_pairs(pose, size, margin):
    """Oracle: every pair that shares no handle within the margin."""
    return {(a, b) for a, b in all_pairs((pose, *size.T), margin).tolist() if b > a + 1}


def outside(points, pose, size):
    """How far a point lies outside a rectangle: 0 on its boundary, negative within. (..., 2) -> (...) [m]."""
    offset = points - pose[..., :2]
    cos = np.cos(pose[..., 2])
    sin = np.sin(pose[..., 2])
    along = np.abs(offset[..., 0] * cos + offset[..., 1] * sin) - size[..., 0] / 2
    across = np.abs(offset[..., 1] * cos - offset[..., 0] * sin) - size[..., 1] / 2
    return np.maximum(along, across)


def random_pairs(count, seed):
    """Rectangles near each other, a third of them at multiples of 45 degrees: poses and sizes of both of each pair."""
    random = np.random.default_rng(seed)
    pose = random.uniform(-1.0, 1.0, (2, count, 3)) * [3.0, 3.0, math.pi]
    square_on = random.random((2, count)) < 1 / 3
    pose[square_on, 2] = random.integers(0, 8, square_on.sum()) * math.pi / 4
    size = random.uniform(0.1, 3.0, (2, count, 2))
    return pose[0], size[0], pose[1], size[1]


def near_pairs(count, seed, margin, within):
    """Pairs of rectangles 2 k, 2 k + 1, each pair in its own cell, two thirds of them within a distance of the margin.

    returns: the scene and the separation of each pair (count,) [m]
    """
    pose_a, size_a, pose_b, size_b = random_pairs(count, seed)
    random = np.random.default_rng(seed)
    near = random.random(count) < 2 / 3
    wanted = margin + within * random.choice([0.0, 0.1, -0.1, 0.2, -0.2, 1.0, -1.0], count)
    result = separation(pose_a, size_a, pose_b, size_b)
    pose_b[near, :2] -= ((result.separation - wanted)[:, None] * result.normal)[near]
    cell = 20.0 * np.stack(np.divmod(np.arange(count), math.isqrt(count)), axis=-1)
    for pose in (pose_a, pose_b):
        pose[:, :2] += cell
    poses, sizes = (np.stack(pair, axis=1).reshape(2 * count, -1) for pair in ((pose_a, pose_b), (size_a, size_b)))
    return (poses, *sizes.T), separation(pose_a, size_a, pose_b, size_b).separation


def minkowski_separation(a, b):
    """Oracle: signed distance from the origin to the boundary of the Minkowski difference of two corner lists."""
    difference = (b[:, :, None] - a[:, None, :]).reshape(-1, 16, 2)
    hull = shapely.convex_hull(shapely.multipoints(difference))
    origin = shapely.points(0.0, 0.0)
    return shapely.distance(shapely.boundary(hull), origin) * np.where(shapely.intersects(hull, origin), -1.0, 1.0)
