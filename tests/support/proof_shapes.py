"""Benches in balls as shapes of shapely."""

from __future__ import annotations

import shapely
from flint import acb

from core.proof.pairs import Size


def polygon(centre: acb, along: acb, size: Size) -> shapely.Polygon:
    """A bench in balls, as shapely has it."""
    corners = [complex(centre + along * corner) for corner in size.corners]
    return shapely.Polygon([(corner.real, corner.imag) for corner in corners])
