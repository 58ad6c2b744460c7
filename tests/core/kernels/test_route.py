"""Routes: points on a table of pieces, against ball arithmetic. Curvatures: tests/core/paths/test_path.py."""

import numpy as np
import pytest
from flint import arb

from core import Arc, Clothoid, Coil, Line, Route, Waypoints
from core.error_free import paired
from core.kernels import route_points
from core.kernels.constants import POINT_COLUMNS, PX, TX
from tests.support.exact_chain import ExactRoute

# [m], and of directions [1].
ROUNDING = 1e-13


@pytest.mark.parametrize(
    "route",
    [
        Route([Line((0.0, 0.0), (7.0, 0.0)), Arc((7.0, 3.0), 3.0, -0.5 * np.pi, 2.0)]),
        Route([Coil(1.3, 6.0, 2.0)]),
        Route([Clothoid((0, 0), 1.0, 0.0, 0.6, 9.0)]),
        Route([Waypoints(((0, 0), (6, 1), (11, 6), (9, 13), (2, 14)))]),
    ],
    ids=["line and arc", "coil", "clothoid", "waypoints"],
)
def test_points_and_tangents_of_every_kind_of_piece_are_exact(route):
    s, exact = np.linspace(0.0, route.end, 101), ExactRoute(route.table)
    route_points(route.table, paired(s), points := np.empty((s.size, POINT_COLUMNS)))
    for at, row in zip(s.tolist(), points, strict=True):
        point, tangent = exact.point(arb(at))
        assert row[PX : PX + 2] == pytest.approx([*map(float, point)], abs=ROUNDING)
        assert row[TX : TX + 2] == pytest.approx([*map(float, tangent)], abs=ROUNDING)
