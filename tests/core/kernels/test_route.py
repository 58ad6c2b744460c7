"""Routes: points on a table of pieces."""

from __future__ import annotations

import numpy as np
import pytest

from core import Arc, Clothoid, Coil, Line, Route, Waypoints, kernels
from core.error_free import paired
from core.kernels.constants import POINT_COLUMNS, POINT_CURVATURE, PX, PY, S_START, TX, TY

# Steps of difference quotients [m], and what these and rounding leave of a tangent [1] and of a curvature [1/m].
STEP, QUOTIENT, BEND_QUOTIENT = 1e-4, 2e-6, 1e-5


@pytest.mark.parametrize(
    "pieces",
    [
        [Line((0.0, 0.0), (7.0, 0.0)), Arc((7.0, 3.0), 3.0, -0.5 * np.pi, 2.0)],
        [Coil(1.3, 6.0, 2.0)],
        [Clothoid((0, 0), 1.0, 0.0, 0.6, 9.0)],
        [Waypoints(((0, 0), (6, 1), (11, 6), (9, 13), (2, 14)))],
    ],
    ids=["line and arc", "coil", "clothoid", "waypoints"],
)
def test_tangent_and_curvature_are_the_derivatives_of_the_points(pieces: list[Line | Arc]) -> None:
    route = Route(pieces)
    s = np.linspace(0.05, route.end - 0.05, 301)
    s = s[np.abs(s[:, None] - route.table[1:, S_START]).min(axis=1, initial=1.0) > 3.0 * STEP]
    points = np.empty((3, s.size, POINT_COLUMNS))
    for side in range(3):
        kernels.route_points(route.table, paired(s + (side - 1) * STEP), points[side])
    place, tangent = points[..., [PX, PY]], points[..., [TX, TY]]
    assert (place[2] - place[0]) / (2 * STEP) == pytest.approx(tangent[1], abs=QUOTIENT)
    heading = np.unwrap(np.arctan2(tangent[..., 1], tangent[..., 0]), axis=0)
    curvature = points[1, :, POINT_CURVATURE]
    assert (heading[2] - heading[0]) / (2 * STEP) == pytest.approx(curvature, abs=BEND_QUOTIENT)
