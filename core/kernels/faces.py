"""How near two benches that are unions of hulls come at most, over an interval of head travel or over a band."""

import cython

if not cython.compiled:  # for the compiler the same stands in the .pxd
    from core.kernels.bends import band_bends, band_between, bend_along, least_between
    from core.kernels.constants import *
    from core.kernels.hulls import best_face, face_gap_along, hulls_of
    from core.kernels.records import Turned

# Of two benches that are unions of hulls all pairs of these must be apart, each along an axis of its own.


def hulls_least(scene, interval, i, j, enough, distance):
    """pair_least() of benches with hulls, without the rectangles around them [m]; 0 or less once it does not serve."""
    edge = j > scene.room
    best = FREE
    bend = bend_along(scene, interval, i, j, distance)
    bend_back = bend_along(scene, interval, j, i, distance)
    for own in range(hulls_of(scene.kinds, False)):
        for other in range(hulls_of(scene.kinds, edge)):
            gap = face_least(scene, interval, j, i, Turned(other, own, 1 if edge else 0, bend_back), enough)
            if gap <= enough:
                gap = max(gap, face_least(scene, interval, i, j, Turned(own, other, 2 if edge else 0, bend), enough))
            best = min(best, gap)
            if best <= scene.margin:
                return best
    return best


def face_least(scene, interval, i, j, pair, enough):
    """Proven least gap over an interval of two hulls along one of the axes fixed in i that are best at its ends [m]."""
    faced = best_face(scene.kinds, i, j, pair.own, pair.other, pair.edge, scene.sizes, interval.after)
    gap = face_gap_along(scene.kinds, i, j, faced, scene.sizes, interval.before)
    best = least_between(gap, faced.gap, pair.bend, interval.h)
    if best > enough:
        return best
    faced = best_face(scene.kinds, i, j, pair.own, pair.other, pair.edge, scene.sizes, interval.before)
    gap = face_gap_along(scene.kinds, i, j, faced, scene.sizes, interval.after)
    return max(best, least_between(faced.gap, gap, pair.bend, interval.h))


def band_hulls(scene, band, i, j, enough, distance):
    """band_pair() of benches with hulls, without the rectangles around them [m]; the margin or less: no bound."""
    best = FREE
    bends = band_bends(scene, band, i, j, distance)
    bends_back = band_bends(scene, band, j, i, distance)
    for own in range(hulls_of(scene.kinds, False)):
        for other in range(hulls_of(scene.kinds, False)):
            gap = band_face(scene, band, j, i, Turned(other, own, 0, 0.0), enough, bends_back)
            if gap <= enough:
                gap = max(gap, band_face(scene, band, i, j, Turned(own, other, 0, 0.0), enough, bends))
            best = min(best, gap)
            if best <= scene.margin:
                return best
    return best


def band_face(scene, band, i, j, pair, enough, bends):
    """Proven least gap over a band of two hulls along one of the axes fixed in i that are best at two corners [m]."""
    faced = best_face(scene.kinds, i, j, pair.own, pair.other, 0, scene.sizes, band.low.after)
    best = band_face_along(scene, band, i, j, faced, bends)
    if best > enough:
        return best
    faced = best_face(scene.kinds, i, j, pair.own, pair.other, 0, scene.sizes, band.high.after)
    return max(best, band_face_along(scene, band, i, j, faced, bends))


def band_face_along(scene, band, i, j, axis, bends):
    """band_along() of two hulls [m]."""
    start = face_gap_along(scene.kinds, i, j, axis, scene.sizes, band.low.before)
    end = face_gap_along(scene.kinds, i, j, axis, scene.sizes, band.low.after)
    high_start = face_gap_along(scene.kinds, i, j, axis, scene.sizes, band.high.before)
    high_end = face_gap_along(scene.kinds, i, j, axis, scene.sizes, band.high.after)
    return band_between(band, start, end, high_start, high_end, bends)
