"""Routes: points on a table of pieces, against ball arithmetic. Curvatures: tests/core/paths/test_path.py."""

import numpy as np
from flint import arb

from core import Route
from core.error_free import paired
from core.kernels import route_points
from core.kernels.constants import POINT_COLUMNS, PX, TX
from tests.support.exact_chain import ExactRoute
from tests.support.near import assert_near
from tests.support.random_routes import Pen

# [m], and of directions [1].
ROUNDING = 1e-13


def test_points_and_tangents_of_every_kind_of_piece_are_exact():
    pen = Pen()
    pen.line(7.0)
    pen.arc(3.0, 2.0)
    pen.coil(1.3, 6.0, 2.0)
    pen.clothoid(0.0, 0.6, 9.0)
    pen.waypoints([(6.0, 0.2), (7.0, 0.6), (7.0, 0.9)])
    route = Route(pen.pieces)
    s = np.linspace(0.0, route.end, 401)
    exact = ExactRoute(route.table)
    route_points(route.table, paired(s), points := np.empty((s.size, POINT_COLUMNS)))
    for at, row in zip(s.tolist(), points, strict=True):
        for column, place in zip((PX, TX), exact.point(arb(at)), strict=True):
            assert_near(row[column : column + 2], [float(place.real), float(place.imag)], ROUNDING)
