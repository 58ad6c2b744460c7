"""Lower bounds on the separation of any two benches over an interval of head travel, or over a band of pitches too."""

import cython
from cython.cimports.libc.math import isnan, sqrt

if not cython.compiled:  # the .pxd imports the same names for the compiler
    from core.kernels.constants import *
    from core.kernels.pairs import BAND_ROUNDING, any_rounding, proven_band_gap, proven_gap
    from core.kernels.records import PairBounds, Rounding
    from core.kernels.rings import RING_ROUNDING, coil_radius, drift, leaders_reach, radius_beyond
    from core.kernels.rounding import spiral_error
    from core.kernels.route import stands_first
    from core.kernels.scene import COPIED


# Input:  an interval whose chains are laid out, and the number of benches that lead pairs (`active`).
# State:  the least bound so far with its K and its pair; `widest`, the widest interval that these pairs would allow.
# Output: the record PairBounds.
#
# Each pair that is near enough gets a bound of its own from pair_least(), less the rounding of its gaps: one rough
# bound for all pairs where no handle had to be followed, else a bound for each pair (proven_gap()). Pairs too far apart
# at the beginning to come within the margin are skipped. On a spiral handles stand in order of their radius, so that
# once one bench is out of reach of bench i, all further ones are skipped.
def interval_least(scene, interval, active):
    """Proven least separation over an interval of all pairs led by the first `active` benches; NO_BOUND if too wide."""
    before: cython.double[:, ::1] = interval.before
    motion: cython.double[:, ::1] = interval.motion
    sizes: cython.double[:, ::1] = scene.sizes
    best = widest = FREE
    curvature = 0.0
    tried = a = b = 0
    if not interval.bound(False):
        return PairBounds(NO_BOUND, 0.0, 0, 0, 0.0, 0.0, 0)
    rounding = interval_rounding(scene, interval)
    interval.copy()
    others = 1 if scene.copies > 1 else 0  # the first copy of which benches count: of the dragon itself without copies
    reach = scene.margin * (1.0 + 1e-12) + 16.0 * (rounding.point + scene.wall_error)  # of centres
    if not stays_beyond(scene, interval, active, rounding.point):
        return PairBounds(NO_BOUND, 0.0, 0, 0, 0.0, 0.0, 0)
    for i in range(active):
        if scene.budget.stopped:
            return PairBounds(NO_BOUND, 0.0, 0, 0, 0.0, 0.0, 0)
        far = reach_of(scene, interval, i, rounding.point)
        first = i if scene.copies > 1 else i + scene.between + 1
        end = interval.handles
        if scene.edges > 0:  # they follow the last handle's row, which holds no bench
            first = scene.room + 1
            end = first + scene.edges
        for j in range(first, end):
            if far < FREE and innermost(scene, interval, j, motion[j, HANDLE_SPEED]) - rounding.point > far:
                break
            for copy in range(others, scene.copies):
                row = j + copy * scene.stride
                dx = before[row, MX] - before[i, MX]
                dy = before[row, MY] - before[i, MY]
                distance = (motion[i, CENTRE_SPEED] + motion[j, CENTRE_SPEED]) * interval.h
                square = dx * dx + dy * dy
                near = sizes[i, RADIUS] + sizes[j, RADIUS] + reach + distance
                if square > near * near or (i == scene.left_out and j == scene.left_out_too):
                    continue
                tried += 1
                least, k = proven_gap(scene, interval, i, row, distance + sqrt(square), rounding.gap)
                if isnan(least):
                    return PairBounds(NO_BOUND, 0.0, 0, 0, 0.0, 0.0, 0)
                width2 = 8.0 * (least - scene.margin) / k + interval.h * interval.h
                widest = min(widest, sqrt(width2) if width2 > 0.0 else 0.0)
                if least < best:
                    best = least
                    curvature = k
                    a = i
                    b = row
    return PairBounds(best, curvature, a, b, widest, rounding.point, tried)


def interval_rounding(scene, interval):
    """Largest errors of points and gaps of a bounded interval."""
    fast = scene.curve.is_spiral and scene.edges == 0 and scene.copies == 1
    if fast and interval.motion[interval.handles, RATE_LOW] > 0.0:
        error = spiral_error(scene.curve.growth, interval.handles, scene.rings.all_chord, interval.before)
        end = spiral_error(scene.curve.growth, interval.handles, scene.rings.all_chord, interval.after)
        error = max(error, end)
        gap = any_rounding(error, interval.handles, interval.h, scene.margin, scene.rings)
        if gap < FREE:
            return Rounding(error, gap)
    interval.round()
    error = max(interval.before[interval.handles - 1, ERROR], interval.after[interval.handles - 1, ERROR])
    return Rounding(error + copied_error(scene, interval), FREE)


def copied_error(scene, interval):
    """Largest error that turning adds to points of the copies [m]; |x| + |y| is below twice the outermost radius."""
    if scene.copies == 1:
        return 0.0
    outermost = max(interval.before[interval.handles, THETA], interval.after[interval.handles, THETA])
    return 2.0 * COPIED * scene.curve.growth * outermost


def innermost(scene, interval, k, rate):
    """Lower bound of the radius of handle k of a spiral during an interval [m]. rate: upper bound of its rate [1]"""
    inner = scene.curve.growth * min(interval.before[k, THETA], interval.after[k, THETA])
    return inner - drift(rate, interval.h, scene.curve.growth, inner)


def reach_of(scene, interval, i, error):
    """Radius of a spiral beyond which benches stay clear of bench i during an interval [m]; FREE on a route, and
    where benches meet edges at rest."""
    if not scene.curve.is_spiral or scene.edges > 0:
        return FREE
    growth = scene.curve.growth
    rate = interval.motion[i, HANDLE_SPEED]
    far = growth * max(interval.before[i + 1, THETA], interval.after[i + 1, THETA])
    far = far + drift(rate, interval.h, growth, far) + error
    low = innermost(scene, interval, i, rate)
    return radius_beyond(growth, leaders_reach(growth, low, far, scene.rings) + scene.margin, scene.rings)


def stays_beyond(scene, interval, leaders, error):
    """Whether benches that are not laid out stay out of reach of those that lead pairs, during an interval."""
    if interval.handles == scene.benches or scene.edges > 0:
        return True
    if not scene.curve.is_spiral:
        return coil_stays_beyond(scene, interval, leaders, error)
    growth = scene.curve.growth
    rear = growth * max(interval.before[leaders, THETA], interval.after[leaders, THETA])
    rear += drift(interval.motion[leaders - 1, HANDLE_SPEED], interval.h, growth, rear) + error
    head = growth * min(interval.before[0, THETA], interval.after[0, THETA])
    reach = leaders_reach(growth, head, rear, scene.rings)
    last = growth * min(interval.before[interval.handles, THETA], interval.after[interval.handles, THETA]) - error
    last -= drift(interval.motion[interval.handles - 1, HANDLE_SPEED], interval.h, growth, last)
    return last >= radius_beyond(growth, reach + scene.margin, scene.rings)


def coil_stays_beyond(scene, interval, leaders, error):
    """stays_beyond() on a route that begins with a coil.

    At any instant a leader's centre is at most h / 2 of travel from its place at one of the ends. The last handle goes
    inwards, so it is nearest to the centre at the far end. error: of points of the chains [m]; it includes u (|x| +
    |y|) and more (rounding.py), so that 8 times it covers the rounding of radii too
    """
    reach = 0.0
    for i in range(leaders):
        far = coil_radius(scene.curve.pieces, interval.before[i, MX], interval.before[i, MY])
        far = max(far, coil_radius(scene.curve.pieces, interval.after[i, MX], interval.after[i, MY]))
        reach = max(reach, far + (scene.sizes[i, RADIUS] + 0.5 * interval.h * interval.motion[i, CENTRE_SPEED]))
    reach = (reach + scene.margin) * (1.0 + RING_ROUNDING) + 8.0 * error
    reach = radius_beyond(scene.curve.pieces[0, COIL_GROWTH], reach, scene.rings) + 8.0 * error
    x = interval.after[interval.handles, PX]
    y = interval.after[interval.handles, PY]
    return (
        stands_first(scene.curve.pieces, interval.handles, interval.after)
        and coil_radius(scene.curve.pieces, x, y) >= reach
    )


def band_rounding(scene, band):
    """interval_rounding() of a band."""
    growth = scene.curve.growth
    growth_high = band.high.scene.curve.growth
    handles = band.low.handles
    if scene.copies == 1 and band.low.motion[handles, RATE_LOW] > 0.0 and band.high.motion[handles, RATE_LOW] > 0.0:
        error = spiral_error(growth, handles, scene.rings.all_chord, band.low.after)
        error = max(error, spiral_error(growth_high, handles, scene.rings.all_chord, band.high.after))
        error = max(error, spiral_error(growth_high, handles, scene.rings.all_chord, band.high.before))
        gap = any_rounding(error, handles, max(band.low.h, band.high.h), scene.margin, scene.rings)
        if gap < FREE:
            return Rounding(error, gap)
    band.low.round()
    band.high.round()
    error = max(band.low.before[handles - 1, ERROR], band.low.after[handles - 1, ERROR])
    error = max(error, max(band.high.before[handles - 1, ERROR], band.high.after[handles - 1, ERROR]))
    return Rounding(error + max(copied_error(scene, band.low), copied_error(band.high.scene, band.high)), FREE)


# Input:  a band whose four chains are laid out, with bounds on the motion and on the shift, and the number of benches
#         that lead pairs (`leaders`).
# State and output: as for interval_least().
def band_least(scene, band, leaders):
    """interval_least() over a band, of pairs led by the first `leaders` benches."""
    best = widest = FREE
    curvature = 0.0
    tried = a = b = 0
    growth = scene.curve.growth
    growth_high = band.high.scene.curve.growth
    rounding = band_rounding(scene, band)
    band.copy()
    others = 1 if scene.copies > 1 else 0
    error = rounding.point
    if error > CLEAR_SPARE * growth * band.low.after[leaders, THETA]:  # the spare length of the chains of a band
        return PairBounds(NO_BOUND, 0.0, 0, 0, 0.0, 0.0, 0)
    for i in range(leaders):
        if scene.budget.stopped:
            return PairBounds(NO_BOUND, 0.0, 0, 0, 0.0, 0.0, 0)
        beyond = growth_high * band.high.before[i + 1, THETA]
        beyond = leaders_reach(growth_high, growth * band.low.after[i, THETA], beyond, scene.rings)
        beyond = radius_beyond(growth_high, beyond + 2.0 * error + scene.margin, scene.rings) + error
        for j in range(i if scene.copies > 1 else i + 2, band.low.handles):
            if growth * band.low.after[j, THETA] > beyond:
                break  # handles stand in order, so all further ones lie outside too
            for copy in range(others, scene.copies):
                row = j + copy * scene.stride
                dx = band.low.after[row, MX] - band.low.after[i, MX]
                dy = band.low.after[row, MY] - band.low.after[i, MY]
                distance = sqrt(dx * dx + dy * dy)
                slack = (band.low.motion[i, CENTRE_SPEED] + band.low.motion[j, CENTRE_SPEED]) * band.low.h
                shifted = band.shifts[i, SHIFT_CENTRE] + band.shifts[j, SHIFT_CENTRE]
                slack += shifted * (growth_high - growth) * (1.0 + BAND_ROUNDING)
                slack += 16.0 * error
                if distance - slack > (scene.sizes[i, RADIUS] + scene.sizes[j, RADIUS] + scene.margin) * (1.0 + 1e-12):
                    continue  # far apart
                tried += 1
                least, k = proven_band_gap(scene, band, i, row, distance + slack, rounding.gap)
                if isnan(least):
                    return PairBounds(NO_BOUND, 0.0, 0, 0, 0.0, 0.0, 0)
                if least < best:
                    best = least
                    curvature = k
                    a = i
                    b = row
                width2 = 8.0 * (least - scene.margin) / k + band.low.h * band.low.h
                widest = min(widest, sqrt(width2) if width2 > 0.0 else 0.0)
    return PairBounds(best, curvature, a, b, widest, error, tried)
