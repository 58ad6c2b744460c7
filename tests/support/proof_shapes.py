"""Benches in balls as shapes of shapely."""

import shapely


def polygon(centre, along, size):
    """A bench in balls, as shapely has it."""
    corners = [complex(centre + along * corner) for corner in size.corners]
    return shapely.Polygon([(corner.real, corner.imag) for corner in corners])
