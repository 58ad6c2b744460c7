"""Exact signed separation of two oriented rectangles, with witness points and normal."""

from __future__ import annotations

from dataclasses import dataclass

from core.dragon import Floats


@dataclass(frozen=True, slots=True)
class Separation:
    """separation (...) [m]: > 0 apart, 0 touching, < 0 minus the penetration depth;
    witness_a, witness_b (..., 2) [m]; normal (..., 2) from a to b.

    Invariant: witness_b - witness_a == separation * normal, also in penetration.
    """

    separation: Floats
    witness_a: Floats
    witness_b: Floats
    normal: Floats


def separation(poses_a: Floats, sizes_a: Floats, poses_b: Floats, sizes_b: Floats) -> Separation:
    """Signed separation of rectangles a and b, pair by pair.

    poses: (..., 3) x [m], y [m], heading [rad]; sizes: (..., 2) length [m], width [m]; shapes broadcast
    """
    raise NotImplementedError


def corners(poses: Floats, sizes: Floats) -> Floats:
    """Corners (..., 4, 2) [m]: front-left, front-right, rear-right, rear-left."""
    raise NotImplementedError
