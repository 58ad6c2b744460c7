"""Curves of a drawing as points: lines, arcs, ellipses, polylines with arcs, and splines.

The straight lines between the points are at most SAG from the curve. Their number is known before any is made, so a
circle as large as the solar system is refused at once. (ezdxf draws an arc as one cubic curve for each quarter, which
is 27 mm off at a radius of 100 m; measured 2026-11-26.)
"""

from __future__ import annotations

import math
from itertools import pairwise
from typing import Any

import numpy as np

from app.maps.features import LEAVE_OUT, POINTS_MAX
from core import InvalidValue
from core.quantities import Clause, Quantity
from core.values import Floats

# Largest distance of a curve from the straight lines that replace it [m].
SAG = 0.005
# Largest radius of an arc [m]: the arcs of a flat bulge in a side of 100 m have one of 1,000 km.
RADIUS_MAX = 1e9
# Highest degree of a spline; programs write 3, seldom 5. Most points through which one that has no control points goes:
# memory grows with the square of their number.
DEGREE_MAX, FIT_POINTS_MAX = 25, 1_000
# Vertex of a POLYLINE that does not lie on it: a control point of the curve that others follow.
CONTROL_POINT = 16


class Damaged(Exception):
    """A curve whose numbers do not fit together, or are too many, in words."""


def points_of(entity: Any, factor: float) -> Floats:
    """Points (N, 2) [m] along an entity. factor: metres in a unit of the drawing

    raises: InvalidValue for more points than a map may have, and for too large a radius; Damaged
    """
    match entity.dxftype():
        case "LINE":
            places = np.array([_xy(entity.dxf.start), _xy(entity.dxf.end)])
        case "ARC":
            start, end = math.radians(entity.dxf.start_angle), math.radians(entity.dxf.end_angle)
            sweep = (end - start) % (2.0 * math.pi) or 2.0 * math.pi
            centre, radius = entity.dxf.center, abs(float(entity.dxf.radius))
            flat = _xy(centre) + radius * _arc(start, sweep, radius, factor)
            places = _in_world(entity, flat, float(centre[2]))
        case "ELLIPSE":
            places = _ellipse(entity, factor)
        case "SPLINE":
            places = _spline(entity, SAG / factor)
        case _:
            places = _polyline(entity, factor)
    if not np.isfinite(places).all():
        raise Damaged
    metres: Floats = places * factor
    return metres


def _xy(point: Any) -> Floats:
    return np.array([float(point[0]), float(point[1])])


def _in_world(entity: Any, flat: Floats, height: float) -> Floats:
    """Points (N, 2) of points in the plane of an entity."""
    ocs = entity.ocs()
    if not ocs.transform:
        return flat
    return np.array([_xy(ocs.to_wcs((x, y, height))) for x, y in flat.tolist()])


def _checked_count(count: float) -> int:
    if not count <= POINTS_MAX:
        rule = f"must draw no curve that takes more than {{points}} points: {LEAVE_OUT}"
        raise InvalidValue("file", rule, got="more", points=POINTS_MAX)
    return max(1, math.ceil(count))


# The middle of a chord over the angle h is r (1 - cos(h / 2)) <= r h^2 / 8 from its arc.
def _arc(start: float, sweep: float, radius: float, factor: float) -> Floats:
    """Points (N, 2) of the circle of radius 1, from an angle over another [rad], as dense as an arc of a radius needs.

    raises: InvalidValue for too large a radius, and for too many points
    """
    if not radius * factor <= RADIUS_MAX:
        got, most = Quantity(radius * factor, "m", 6), Quantity(RADIUS_MAX, "m")
        raise InvalidValue("file", f"must have no arc of a radius over {{most}}: {LEAVE_OUT}", got=got, most=most)
    count = _checked_count(abs(sweep) * math.sqrt(radius / (8.0 * (SAG / factor))))
    angles = start + sweep * np.linspace(0.0, 1.0, count + 1)
    return np.stack([np.cos(angles), np.sin(angles)], axis=-1)


def _ellipse(entity: Any, factor: float) -> Floats:
    """The middle, plus cos t times the long half axis, plus sin t times the short one: a circle that is squeezed."""
    long = entity.dxf.major_axis
    short = entity.minor_axis
    start, end = float(entity.dxf.start_param), float(entity.dxf.end_param)
    if not math.isfinite(start + end):
        raise Damaged
    sweep = (end - start) % (2.0 * math.pi) or 2.0 * math.pi
    if abs(abs(end - start) - 2.0 * math.pi) < 1e-6:  # Files have six to sixteen digits.
        sweep = 2.0 * math.pi
    along = _arc(start, sweep, float(long.magnitude), factor)
    return _xy(entity.dxf.center) + along @ np.stack([_xy(long), _xy(short)])


def _polyline(entity: Any, factor: float) -> Floats:
    """Points of a polyline whose sides may be arcs: a bulge is the tangent of a quarter of the arc's angle."""
    if entity.dxftype() == "LWPOLYLINE":
        corners = [(np.array([x, y]), bulge) for x, y, bulge in entity.get_points("xyb")]
        height, closed, flat = float(entity.dxf.elevation), bool(entity.closed), True
    else:
        vertices = [one for one in entity.vertices if not one.dxf.flags & CONTROL_POINT]
        corners = [(_xy(one.dxf.location), float(one.dxf.get("bulge", 0.0))) for one in vertices]
        flat, closed = bool(entity.is_2d_polyline), bool(entity.is_closed)
        height = float(vertices[0].dxf.location[2]) if vertices else 0.0
    if not corners:
        return np.zeros((0, 2))
    if closed and len(corners) > 1:
        corners.append((corners[0][0], 0.0))
    parts, room = [corners[0][0][None]], 0
    for (a, bulge), (b, _) in pairwise(corners):
        parts.append(_side(a, b, bulge, factor))
        room += len(parts[-1])
        _checked_count(room)
    places = np.concatenate(parts)
    return _in_world(entity, places, height) if flat else places


def _side(a: Floats, b: Floats, bulge: float, factor: float) -> Floats:
    """Points from a to b without a itself."""
    chord = float(np.hypot(*(b - a)))
    if bulge == 0.0 or chord == 0.0:
        return b[None]
    sweep = 4.0 * math.atan(bulge)
    half = math.sin(0.5 * sweep)
    radius = 0.5 * chord / abs(half) if half else math.inf
    # As high as the arc is above its chord: a flat one is straight, however large its radius.
    if 0.5 * chord * abs(bulge) * factor < SAG:
        return b[None]
    left = np.array([a[1] - b[1], b[0] - a[0]]) / chord
    centre = 0.5 * (a + b) + left * (0.5 * chord / math.tan(0.5 * sweep))
    start = math.atan2(a[1] - centre[1], a[0] - centre[0])
    points = centre + radius * _arc(start, sweep, radius, factor)
    points[-1] = b
    return points[1:]


# A B-spline of degree p with control points P and knots u is a polynomial on each span [u[k], u[k + 1]], p <= k < n,
# and nothing outside u[p] .. u[n]. Its second derivative there is a mean of the control points of the second
# derivative, which are differences of P. A chord over a step h is at most h^2 / 8 times that from it.
def _spline(entity: Any, sag: float) -> Floats:
    if len(entity.fit_points) > FIT_POINTS_MAX and not len(entity.control_points):
        raise Damaged(Clause("SPLINE through more than {most} points", most=FIT_POINTS_MAX))
    tool = entity.construction_tool()
    control = np.array([[float(point.x), float(point.y), 1.0] for point in tool.control_points])
    knots, degree = np.array(tool.knots(), dtype=float), int(tool.order) - 1
    weights = tool.weights()
    if len(weights):
        control *= np.array(weights, dtype=float)[:, None]
    n = len(control)
    fits = 1 <= degree <= DEGREE_MAX and n > degree and len(knots) == n + degree + 1
    if not (fits and np.isfinite(knots).all() and np.isfinite(control).all() and (np.diff(knots) >= 0.0).all()):
        raise Damaged
    if not (control[:, 2] > 0.0).all():
        raise Damaged
    spans = [k for k in range(degree, n) if knots[k + 1] > knots[k]]
    middle = (control[:, :2] / control[:, 2:]).mean(axis=0)
    control[:, :2] -= middle * control[:, 2:]
    # Weights bend a curve more than its control points say: by the square of their ratio, where it was measured.
    uneven = float(control[:, 2].max() / control[:, 2].min()) ** 2
    bend = _second(control, knots, degree) / control[:, 2].min()
    counts = [
        uneven * (knots[k + 1] - knots[k]) * math.sqrt(bend[k - degree : k + 1].max(initial=0.0) / (8.0 * sag))
        for k in spans
    ]
    _checked_count(sum(counts) + len(spans))
    parts = [
        _on_span(control, knots, degree, k, np.linspace(knots[k], knots[k + 1], max(2, math.ceil(count) + 1)))
        for k, count in zip(spans, counts, strict=True)
    ]
    return np.concatenate(parts) + middle if parts else np.zeros((0, 2))


def _second(control: Floats, knots: Floats, degree: int) -> Floats:
    """Length of each control point of the second derivative, as long as the control points; 0 beyond."""
    points, lengths = control[:, :2], np.zeros(len(control))
    for k in range(2):
        p = degree - k
        if p < 1:
            return lengths
        last = len(points) + k
        apart = knots[k + p + 1 : last + p] - knots[k + 1 : last]
        steps = p * np.diff(points, axis=0) / np.where(apart > 0.0, apart, 1.0)[:, None]
        points = np.where(apart[:, None] > 0.0, steps, 0.0)
    lengths[: len(points)] = np.hypot(*points.T)
    return lengths


def _on_span(control: Floats, knots: Floats, degree: int, span: int, t: Floats) -> Floats:
    """Points of a spline at parameters (N,) in a span, by de Boor's algorithm."""
    points = np.repeat(control[span - degree : span + 1, None], len(t), axis=1)
    for level in range(1, degree + 1):
        for j in range(degree, level - 1, -1):
            low, high = knots[j + span - degree], knots[j + 1 + span - level]
            share = ((t - low) / (high - low))[:, None]
            points[j] = (1.0 - share) * points[j - 1] + share * points[j]
    places: Floats = points[degree, :, :2] / points[degree, :, 2:]
    return places
