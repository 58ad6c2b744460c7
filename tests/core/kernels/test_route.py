"""Routes: points on a table of pieces."""

from __future__ import annotations

import numpy as np
import pytest

from core import Arc, Clothoid, Coil, Line, Route, Waypoints, kernels
from core.error_free import paired

PATHS = {
    "line and arc": Route([Line((0.0, 0.0), (7.0, 0.0)), Arc((7.0, 3.0), 3.0, -0.5 * np.pi, 2.0)]),
    "coil": Route([Coil(1.3, 6.0, 2.0)]),
    "clothoids": Route([Clothoid((0, 0), 1.0, 0.0, 0.6, 9.0)]),
    "waypoints": Route([Waypoints(((0, 0), (6, 1), (11, 6), (9, 13), (2, 14)))]),
}
# Steps of difference quotients [m], and what these and rounding leave of a tangent [1] and of a curvature [1/m].
STEP, QUOTIENT, BEND_QUOTIENT = 1e-4, 2e-6, 1e-5


@pytest.mark.parametrize("name", PATHS)
def test_tangent_and_curvature_are_the_derivatives_of_the_points(name: str) -> None:
    table = PATHS[name].table
    s = np.linspace(0.05, PATHS[name].end - 0.05, 301)
    s = s[np.abs(s[:, None] - table[1:, kernels.S_START]).min(axis=1, initial=1.0) > 3.0 * STEP]
    points = np.empty((3, s.size, kernels.POINT_COLUMNS))
    for side in range(3):
        kernels.route_points(table, paired(s + (side - 1) * STEP), points[side])
    place, tangent = points[..., kernels.PX : kernels.PY + 1], points[1, :, kernels.TX : kernels.TY + 1]
    assert (place[2] - place[0]) / (2 * STEP) == pytest.approx(tangent, abs=QUOTIENT)
    heading = np.unwrap(np.arctan2(points[..., kernels.TY], points[..., kernels.TX]), axis=0)
    curvature = points[1, :, kernels.POINT_CURVATURE]
    assert (heading[2] - heading[0]) / (2 * STEP) == pytest.approx(curvature, abs=BEND_QUOTIENT)
