"""Lower bounds on the separation of benches that are unions of hulls, over an interval of head travel or a band."""

import cython
from cython.cimports.libc.math import cos

if not cython.compiled:  # the .pxd imports the same names for the compiler
    from core.kernels.constants import *
    from core.kernels.gap_curvature import band_between, band_curvatures, curvature_along, least_between
    from core.kernels.hulls import (
        STEP,
        best_beyond,
        corner_beyond,
        facing,
        gap_beyond,
        hulls_in,
        nearest_corner,
        nearest_hulls,
        uphill,
        view_of,
    )  # fmt: skip
    from core.kernels.records import Views

# Two benches that are unions of hulls are apart if every pair of these hulls is, each along an axis of its own. For
# most pairs of hulls, the half plane that faces the other bench, or those at its ends, already shows that another pair
# is nearer.


# Input:  two benches, or a bench and an edge at rest; an interval, with K along axes fixed in either; and a gap that is
#         enough.
# State:  `best`, the least bound of the pairs of hulls so far; `start` and `end`, the views at both ends.
# Output: `best`; the first pair with a bound of the margin or less ends the search.
def hulls_least(scene, interval, i, j, enough, curvature, curvature_back):
    """pair_least() of benches with hulls, without the rectangles around them [m]; 0 or less: no bound.

    curvature, curvature_back: K along axes fixed in i and in j [1/m]
    """
    h = interval.h
    edge = scene.edges > 0 and j > scene.room
    best = FREE
    start = view_of(j, i, interval.before)
    end = view_of(j, i, interval.after)
    k = facing(end, j, i, scene.sizes)
    for n in range(HULLS if edge else HULLS * HULLS):
        own = n % HULLS
        other = AT_REST if edge else (n // HULLS + 1) % HULLS
        hulls = hulls_in(scene.kinds, j, i, other, own, scene.sizes)
        if face_along(scene.kinds, start, end, hulls, k, curvature_back, h) >= best:
            continue
        if face_along(scene.kinds, start, end, hulls, 0, curvature_back, h) >= best:
            continue
        if face_along(scene.kinds, start, end, hulls, DIRECTIONS // 2, curvature_back, h) >= best:
            continue
        gap = face_least(scene.kinds, start, end, hulls, k, curvature_back, h, enough)
        if gap <= enough:
            swapped = hulls_in(scene.kinds, i, j, own, other, scene.sizes)
            gap = max(gap, swapped_least(scene, interval, i, j, swapped, curvature, enough))
            if gap <= scene.margin:
                axis = best_beyond(scene.kinds, end, hulls)
                gap = max(gap, face_along(scene.kinds, start, end, hulls, axis.k, curvature_back, h))
        best = min(best, gap)
        if best <= scene.margin:
            break
    return best


def swapped_least(scene, interval, i, j, hulls, curvature, enough):
    """face_least() along axes fixed in i; where that proves nothing, along the best axis at the interval's end [m]."""
    start = view_of(i, j, interval.before)
    end = view_of(i, j, interval.after)
    k = facing(end, i, j, scene.sizes)
    gap = face_least(scene.kinds, start, end, hulls, k, curvature, interval.h, enough)
    if gap <= scene.margin:
        axis = best_beyond(scene.kinds, end, hulls)
        gap = max(gap, face_along(scene.kinds, start, end, hulls, axis.k, curvature, interval.h))
    return gap


def face_along(kinds, start, end, hulls, k, curvature, h):
    """Proven least gap over an interval beyond half plane k [m]; start, end: the views at its ends."""
    return least_between(gap_beyond(kinds, start, hulls, k), gap_beyond(kinds, end, hulls, k), curvature, h)


def face_least(kinds, start, end, hulls, k, curvature, h, enough):
    """Proven least gap over an interval beyond one of the two half planes uphill from k at its ends [m]."""
    axis = uphill(kinds, end, hulls, k, FREE)
    best = least_between(gap_beyond(kinds, start, hulls, axis.k), axis.gap, curvature, h)
    if best > enough:
        return best
    axis = uphill(kinds, start, hulls, axis.k, FREE)
    return max(best, least_between(axis.gap, gap_beyond(kinds, end, hulls, axis.k), curvature, h))


def hulls_most(scene, interval, a, b, distance):
    """Upper bound of the separation of benches a and b over an interval, without rounding [m]; 0 or less: touching.

    See corner_beyond(); distance: upper bound of the distance between their centres [m]
    """
    faced = nearest_hulls(scene.kinds, a, b, scene.edges > 0 and b > scene.room, FREE, scene.sizes, interval.after)
    i = b if faced.swapped else a
    j = a if faced.swapped else b
    hulls = hulls_in(scene.kinds, i, j, faced.own, faced.other, scene.sizes)
    view = view_of(i, j, interval.after)
    at = nearest_corner(scene.kinds, view, hulls, faced.k)
    most = corner_beyond(scene.kinds, view, hulls, at)
    most = max(most, corner_beyond(scene.kinds, view_of(i, j, interval.before), hulls, at))
    most += 0.125 * curvature_along(scene, interval, i, j, distance) * interval.h * interval.h
    return most / cos(0.5 * STEP) if most > 0.0 else most


def views_of(i, j, band):
    """Bench j as bench i sees it at the corners of a band."""
    return Views(
        view_of(i, j, band.low.before),
        view_of(i, j, band.low.after),
        view_of(i, j, band.high.before),
        view_of(i, j, band.high.after),
    )


def band_hulls(scene, band, i, j, enough, distance):
    """band_pair() of benches with hulls, without the rectangles around them [m]; no bound where the margin or less."""
    best = FREE
    curvatures = band_curvatures(scene, band, i, j, distance)
    curvatures_back = band_curvatures(scene, band, j, i, distance)
    views = views_of(j, i, band)
    k = facing(views.low_end, j, i, scene.sizes)
    for n in range(HULLS * HULLS):
        own = n % HULLS
        other = (n // HULLS + 1) % HULLS
        hulls = hulls_in(scene.kinds, j, i, other, own, scene.sizes)
        if band_beyond(scene.kinds, band, views, hulls, k, curvatures_back) >= best:
            continue
        if band_beyond(scene.kinds, band, views, hulls, 0, curvatures_back) >= best:
            continue
        if band_beyond(scene.kinds, band, views, hulls, DIRECTIONS // 2, curvatures_back) >= best:
            continue
        gap = band_face(scene, band, views, hulls, k, curvatures_back, enough)
        if gap <= enough:
            hulls = hulls_in(scene.kinds, i, j, own, other, scene.sizes)
            gap = max(gap, band_swapped(scene, band, i, j, hulls, curvatures, enough))
        best = min(best, gap)
        if best <= scene.margin:
            break
    return best


def band_swapped(scene, band, i, j, hulls, curvatures, enough):
    """band_face() along axes fixed in i [m]."""
    views = views_of(i, j, band)
    return band_face(scene, band, views, hulls, facing(views.low_end, i, j, scene.sizes), curvatures, enough)


def band_face(scene, band, views, hulls, k, curvatures, enough):
    """Proven least gap over a band beyond one of the half planes uphill from k at two of its corners [m]; where these
    show nothing, beyond the best half plane of all at the first of these corners."""
    axis = uphill(scene.kinds, views.low_end, hulls, k, FREE)
    best = band_beyond(scene.kinds, band, views, hulls, axis.k, curvatures)
    if best > enough:
        return best
    axis = uphill(scene.kinds, views.high_end, hulls, axis.k, FREE)
    best = max(best, band_beyond(scene.kinds, band, views, hulls, axis.k, curvatures))
    if best <= scene.margin:
        axis = best_beyond(scene.kinds, views.low_end, hulls)
        best = max(best, band_beyond(scene.kinds, band, views, hulls, axis.k, curvatures))
    return best


def band_beyond(kinds, band, views, hulls, k, curvatures):
    """Proven least gap over a band beyond half plane k [m]."""
    start = gap_beyond(kinds, views.low_start, hulls, k)
    end = gap_beyond(kinds, views.low_end, hulls, k)
    high_start = gap_beyond(kinds, views.high_start, hulls, k)
    high_end = gap_beyond(kinds, views.high_end, hulls, k)
    return band_between(band, start, end, high_start, high_end, curvatures)
