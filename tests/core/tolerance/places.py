"""All places that one bench may have while its two holes stray, drawn at random: what hulls and bounds are held to."""

from __future__ import annotations

import numpy as np

from core.values import Floats


def random_strays(rng: np.random.Generator, chord: float, stray: float, count: int) -> Floats:
    """Strays (count, 2, 2) of the front and the rear hole of a bench along the x axis that keep its chord [m].

    Half of them have the middle on the edge of all places that the turn allows, half anywhere in them; half of the
    turns are the largest.
    """
    q = stray * np.sin(rng.uniform(-0.5 * np.pi, 0.5 * np.pi, count))
    q = np.where(rng.random(count) < 0.5, np.copysign(stray * (1.0 - 1e-12), q), q)
    half = np.arcsin(q / chord)
    along = np.stack([np.cos(half), np.sin(half)], axis=-1)
    across = np.stack([-along[:, 1], along[:, 0]], axis=-1)
    angle = rng.uniform(0.0, 2.0 * np.pi, count)
    way = np.stack([np.cos(angle), np.sin(angle)], axis=-1)
    lean = q * (way * across).sum(axis=-1)
    furthest = np.sqrt(np.maximum(lean * lean - q * q + stray * stray, 0.0)) - np.abs(lean)
    part = np.where(rng.random(count) < 0.5, 1.0, rng.random(count))
    middle = (furthest * part)[:, None] * way
    return np.stack([middle + q[:, None] * across, middle - q[:, None] * across], axis=1)


def moved_points(points: Floats, strays: Floats, chord: float) -> Floats:
    """Points (n, 2) of a bench along the x axis, from the middle of its chord, with its holes displaced: (count, n, 2).

    By the rigid motion itself: the new middle and the new direction of the chord.
    """
    front, rear = np.array([0.5 * chord, 0.0]) + strays[:, 0], np.array([-0.5 * chord, 0.0]) + strays[:, 1]
    along = (front - rear) / np.linalg.norm(front - rear, axis=-1, keepdims=True)
    across = np.stack([-along[:, 1], along[:, 0]], axis=-1)
    middle = 0.5 * (front + rear)
    return middle[:, None] + points[:, :1] * along[:, None] + points[:, 1:] * across[:, None]
