"""What a face of a certificate claims, measured on benches in doubles."""

from __future__ import annotations

import math

import numpy as np
import shapely
from flint import acb

from core.proof.pairs import Size
from core.values import Floats


def polygon(centre: acb, along: acb, size: Size) -> shapely.Polygon:
    """A bench in balls, as shapely has it."""
    corners = [complex(centre + along * corner) for corner in size.corners]
    return shapely.Polygon([(corner.real, corner.imag) for corner in corners])


def gap_by(face: str, direction: float, poses: Floats, sizes: Floats, shapes: Floats, a: int, b: int) -> float:
    """The distance that a letter of a certificate, or "far" for none, leaves between two benches [m].

    shapes: (n, 4, 2) corners of the benches with these poses and sizes
    """
    if face == "far":
        inner = shapely.Polygon(shapes[b]).distance(shapely.Point(0.0, 0.0))
        return float(inner - np.hypot(*shapes[a].T).max())
    if face == "9":
        return math.dist(poses[a, :2], poses[b, :2]) - (math.hypot(*sizes[a]) + math.hypot(*sizes[b])) / 2
    owner, other = (b, a) if face in "4567" else (a, b)
    angle = poses[owner, 2] + (direction if face == "8" else int(face) % 4 * math.pi / 2)
    normal = np.array([math.cos(angle), math.sin(angle)])
    return float((shapes[other] @ normal).min() - (shapes[owner] @ normal).max())
