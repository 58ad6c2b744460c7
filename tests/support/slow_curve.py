"""Natural splines through points, and their arc lengths by a fine quadrature: no code of core."""

import math
from itertools import pairwise

import numpy as np
from scipy.interpolate import CubicSpline

# Parts of each leg, and nodes of the quadrature in each [1].
PARTS = 64
NODES = 24


def spline_of(points):
    """The natural spline by chord lengths, and its knots."""
    knots = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1))])
    return CubicSpline(knots, points, bc_type="natural"), knots


def spline_length(spline, knots, end):
    """Arc length from its beginning to a parameter, by Gauss-Legendre on equal parts of each leg [m]."""
    legs = pairwise([*knots[knots < end], end])
    stops = np.concatenate([np.linspace(a, b, PARTS + 1)[:-1] for a, b in legs])
    widths = np.diff([*stops, end])
    nodes, weights = np.polynomial.legendre.leggauss(NODES)
    places = stops[:, None] + 0.5 * widths[:, None] * (1.0 + nodes)
    speeds = np.linalg.norm(spline.derivative()(places), axis=-1)
    return math.fsum((0.5 * widths * (speeds @ weights)).tolist())
