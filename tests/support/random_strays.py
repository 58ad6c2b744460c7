"""All places that one bench may have while its two holes stray, drawn at random: what hulls and bounds are held to."""

import numpy as np


def random_strays(rng, chord, stray, count):
    """Strays (count, 2, 2) of the front and the rear hole of a bench along the x axis that keep its chord [m].

    Half of them have the middle on the edge of all places that the turn allows, half anywhere in them; half of the
    turns are the largest.
    """
    q = stray * np.sin(rng.uniform(-0.5 * np.pi, 0.5 * np.pi, count))
    q = np.where(rng.random(count) < 0.5, np.copysign(stray * (1.0 - 1e-12), q), q)
    angle = rng.uniform(0.0, 2.0 * np.pi, count)
    way = np.stack([np.cos(angle), np.sin(angle)], axis=-1)
    part = np.where(rng.random(count) < 0.5, 1.0, rng.random(count))
    return strays_of(q, (2.0 * stray * part)[:, None] * way, chord, stray, part)


def strays_of(q, middle, chord, stray, part=1.0):
    """Strays (N, 2, 2) of both holes of a bench that is turned by 2 asin(q / chord) and whose middle moves (N, 2) [m].

    A turn or a middle that goes too far is taken back to `part` of what the discs of both holes allow.
    """
    q = np.clip(q, -stray, stray)
    half = np.arcsin(q / chord)
    across = np.stack([-np.sin(half), np.cos(half)], axis=-1)
    length = np.maximum(np.hypot(middle[:, 0], middle[:, 1]), 1e-300)
    lean = q * (middle * across).sum(axis=-1) / length
    furthest = part * (np.sqrt(np.maximum(lean * lean - q * q + stray * stray, 0.0)) - np.abs(lean))
    kept = np.minimum(1.0, furthest / length)[:, None] * middle
    return np.stack([kept + q[:, None] * across, kept - q[:, None] * across], axis=1)


def moved_points(points, strays, chord):
    """Points (n, 2) of a bench along the x axis, from the middle of its chord, with its holes displaced: (count, n, 2).

    By the rigid motion itself: the new middle and the new direction of the chord.
    """
    front = np.array([0.5 * chord, 0.0]) + strays[:, 0]
    rear = np.array([-0.5 * chord, 0.0]) + strays[:, 1]
    along = (front - rear) / np.linalg.norm(front - rear, axis=-1, keepdims=True)
    across = np.stack([-along[:, 1], along[:, 0]], axis=-1)
    middle = 0.5 * (front + rear)
    return middle[:, None] + points[:, :1] * along[:, None] + points[:, 1:] * across[:, None]
