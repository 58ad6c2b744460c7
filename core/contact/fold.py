"""The last part of a run before a fold: a bound on how far benches still move, and so on their clearance.

Just before a fold the speeds of handles grow without bound, so the steps of a march shrink to nothing: about forty of
them go over a tenth of the remaining way. This bound takes their place.
"""

from __future__ import annotations

import heapq
import math

import numpy as np

from core import kernels
from core.contact.brackets import TOUCHES
from core.contact.search import ContactSearch, joined
from core.dance import RunEnd
from core.kernels import Ended
from core.kernels.constants import CHORD, EDGES_PER_WORK, ERROR, FREE, HALF_LENGTH, HALF_WIDTH, NO_BOUND, NO_ROOT, THETA
from core.kernels.results import Marched
from core.values import Floats

# Number of samples on the rest of the way to a fold, in which a graze would show [1].
WAY_SAMPLES = 12
# Largest number of parts into which the way to a fold is divided; each takes 0.1 to 0.3 ms.
FOLD_STRETCHES = 200
# Largest relative error of theta at a fold, and of the angle from leader to follower [1], see least_left().
THETA_ROUNDING = 1e-12
# Work of each part of the way, and of each bench in it [1].
STRETCH_WORK, FOLD_WORK = 1000.0, 20.0


# fold_stops() gives the travels at which the march may end, each with its distance from the fold. If the bound is not
# enough at a stop, a new march goes on to the next one. The way before that stop is clear. If the run begins where the
# ring bound clears all pairs (`rings_reach`), the new march need not follow all of them again: it starts at twice the
# distance of the stop from the fold, so that it also sees a graze at the stop. Otherwise the march is repeated from its
# own start, to the last stop at once.
def approach_fold(
    search: ContactSearch,
    begin: float,
    stops: list[tuple[float, float]],
    head_speed: float,
    end: RunEnd,
    first: Marched,
) -> Marched:
    """A march from a travel [m] to a fold, like ContactSearch.approach(); REACHED: clear up to the fold.

    stops: ContactSearch.fold_stops(); first: ContactSearch.approach() to the first of them
    The march goes on beyond a stop if the bound is not enough there, or if a graze that may lie ahead is narrower than
    all before it.
    """
    assert end.theta is not None
    start, opening, passed, result = begin, True, Marched(Ended.REACHED, begin), first
    (stop, way), *further = stops
    last = stops[-1][0]
    rings_reach = search.travel_at(search.clear_radius / search.growth) > begin
    while further:
        result = joined(passed, result)
        reached = result.ended is Ended.REACHED
        if result.ended in TOUCHES or (reached and _may_end_at(search, stop, last, result, end.theta)):
            return result
        if reached and rings_reach:
            start, opening, passed = stop - way, False, result
        else:
            further = further[-1:]
        (stop, way), *further = further
        result = search.approach(start, stop, head_speed, opening=opening)
    return ended_at_fold(search, joined(passed, result), last, end.theta)


def ended_at_fold(search: ContactSearch, result: Marched, last: float, theta: float) -> Marched:
    """A march up to `last`, the last travel before a fold [m], with its end at the fold itself."""
    if result.ended is not Ended.REACHED and not result.hidden:
        return result
    clear = clear_to_fold(search, min(result.proven, last), theta)
    return result._replace(ended=Ended.REACHED if clear else Ended.STUCK)


def _may_end_at(search: ContactSearch, early: float, last: float, result: Marched, theta: float) -> bool:
    """True if a march may end at a travel [m]: the way to the fold is clear, and samples show no narrower graze."""
    if search.pairs:
        least = least_left(search, early - search.travel_rounding(early), theta)
        return least > search.margin and not _dips_ahead(search, early, last, result)
    return True


def _dips_ahead(search: ContactSearch, early: float, last: float, result: Marched) -> bool:
    """True if samples between two travels [m] show a graze that is narrower than the one of the march before."""
    # Handles move as the square root of the way that is left, so for them these samples are evenly spaced.
    left = (last - early) * np.linspace(1.0, 0.0, WAY_SAMPLES) ** 2
    gaps = [search.clearance(travel, search.leaders)[0] for travel in (last - left).tolist()]
    known = result.graze.gap if result.graze is not None else FREE
    return any(
        before > gap <= after and gap < known for before, gap, after in zip(gaps, gaps[1:], gaps[2:], strict=False)
    )


def clear_to_fold(search: ContactSearch, travel: float, fold: float) -> bool:
    """True if all pairs stay further apart than the margin from a travel [m] to the fold, at theta `fold` [rad]."""
    least = least_to_fold(search, travel, fold)
    return least is not None and least > search.margin


# Towards the fold handles move as the square root of the remaining travel. So a part whose bound is too low is divided
# where a quarter of it remains: each side has about half of the motion. The bound of the whole part also holds for both
# sides.
def least_to_fold(search: ContactSearch, travel: float, fold: float) -> float | None:
    """Lower bound of all gaps from a travel to the fold, or the margin if they exceed it [m]; None if unknown.

    fold: theta of the head there [rad]
    The way is divided into up to FOLD_STRETCHES parts, until the bound exceeds the margin.
    """
    if not search.pairs:
        return FREE
    travel, last = travel - search.travel_rounding(travel), search.travel_at(fold)
    stretches = [(least_left(search, travel, fold), travel, last)]
    while stretches[0][0] <= search.margin and len(stretches) < FOLD_STRETCHES:
        least, start, stop = heapq.heappop(stretches)
        middle = stop - 0.25 * (stop - start)
        ends = (
            (start, middle, search.theta_at(middle)),
            (middle, stop, fold if stop == last else search.theta_at(stop)),
        )
        for begin, until, theta in ends:
            heapq.heappush(stretches, (max(least, least_left(search, begin, theta)), begin, until))
    least = stretches[0][0]
    return least if least > NO_BOUND else None


# While the head goes from a travel to a later one, theta of handle 0 is in [low_0, high_0] = [its last, its first].
# Follower and leader differ by delta(theta), which falls with theta (spiral.py), so theta of handle k + 1 is in
#     [low_k + delta(high_k), high_k + delta(low_k)],
# and where the curvature at low_k times half the chord is at most SINE_LIMIT (chord lemma, bounds.py) in
#     [low_k + delta(low_k), high_k + delta(high_k)],
# because there the follower moves in the direction of its leader. It also goes no further than its leader there (Vogt),
# so once this holds for all chords that follow, no handle behind moves further than this one. Handle k moves by at most
# D_k, the arc between the ends of its interval. A bench (front handle a, rear handle b, chord c) rotates by at most
#     angle = min((D_a + D_b) / c, curvature (D_a + D_b) / 2).
# The second holds under the lemma, which bounds omega by curvature (a' + b') / 2, with that at low_a. A point of the
# bench, at most o beyond a handle and w / 2 sideways, moves by at most
#     max(D_a, D_b) + (o + w / 2) angle.
# Edges at rest do not move: a gap to one of them loses only the motion of the bench.
# If there is no delta for low_k because the chord folds, or rounds to a fold, that of the fold itself, which is larger,
# takes its place.
#
# Rounding. Stretches meet at the same computed theta, so that nothing is left out. The first one begins before its
# travel, by the largest error of that travel. Every interval is wider at both ends by w = THETA_ROUNDING of theta. This
# covers the error of delta, near the fold too: a computed delta is the root for a chord^2 = f that is off by 14 u f
# (rounding.py). If theta f_theta >= 0.03 f, this is the root for a theta that is off by less than 500 u, far less than
# w. Otherwise, with s = sin(delta / 2), 4 theta (theta + delta) s^2 < 0.03 f and delta^2 > 0.97 f. Then f_delta / 2 >=
# delta for delta <= pi. From there to the crest s >= 0.64 and theta (theta + delta) |sin delta| <= 2 theta (theta +
# delta) s <= 0.12 delta, so f_delta / 2 >= 0.88 delta. So delta is off by 9 u of itself, again far less than w. The
# arcs, widened by growth w theta sqrt(1 + theta^2), and what follows from them are products and sums of terms >= 0. The
# largest error of a gap is gap_rounding(). It grows far less than the gap itself, so it is computed for the largest gap
# of any pair that may be the nearest.
def least_left(search: ContactSearch, travel: float, theta: float) -> float:
    """Lower bound of all gaps from a travel until the head is at theta, or the margin if they exceed it [m].

    For each pair it is the gap after that travel, less the remaining motion of both benches, found from their sizes.
    NO_BOUND: a bench without a place in `placed` could come near one that leads a pair.
    """
    search.spend(STRETCH_WORK + FOLD_WORK * search.room * (1.0 + len(search.edges) / EDGES_PER_WORK))
    gap, _ = search.clearance(travel)
    arcs, moved = moved_until(search, theta)
    reached = (1.0 if len(search.edges) else 2.0) * float(moved.max())  # edges stay at rest
    rounding = gap_rounding(search, travel, min(gap, FREE) + reached)
    arcs += search.placed[search.room - 1, ERROR]
    radii = search.growth * search.placed[: search.room + 1, THETA]
    outside = np.flatnonzero(radii[:-1] - arcs[:-1] >= search.clear_radius)
    leaders = int(outside[0]) if outside.size else search.room
    if search.room < search.dragon.benches:
        lead, rear = search.growth * theta * (1.0 - THETA_ROUNDING), float(radii[leaders] + arcs[leaders])
        reach = kernels.leaders_reach(search.growth, lead, rear, search.rings) + search.margin
        if radii[-1] - arcs[-1] < kernels.radius_beyond(search.growth, reach, search.rings):
            return NO_BOUND
    least = gap - reached
    if least <= search.margin:
        least = kernels.clearance_left(search.scene, leaders, search.room, search.placed, moved)
        search.budget.look()
    return float(least) - rounding


def moved_until(search: ContactSearch, theta: float) -> tuple[Floats, Floats]:
    """Bounds on the motion of each handle in `placed`, and any point of each bench, until the head is at theta [m]."""
    growth, benches = search.growth, search.room
    chords = search.sizes[:benches, CHORD]
    longest_behind = np.maximum.accumulate(chords[::-1])[::-1].tolist()
    low, high = theta * (1.0 - THETA_ROUNDING), float(search.placed[0, THETA]) * (1.0 + THETA_ROUNDING)
    arcs, curvatures = np.empty(benches + 1), np.full(benches, FREE)
    for k in range(benches + 1):
        search.budget.look()
        arcs[k] = growth * (high - low) * math.hypot(1.0, high)
        if k == benches:
            break
        curvature = kernels.spiral_curvature(low) / growth
        if 0.5 * curvature * longest_behind[k] <= kernels.SINE_LIMIT:
            arcs[k:], curvatures[k:] = arcs[k], curvature
            break
        inner, outer = _deltas(search.growth, low, high, float(chords[k]))
        if 0.5 * curvature * chords[k] <= kernels.SINE_LIMIT:
            inner, outer, curvatures[k] = outer, inner, curvature
        low, high = (low + inner) * (1.0 - THETA_ROUNDING), (high + outer) * (1.0 + THETA_ROUNDING)
    both = arcs[:-1] + arcs[1:]
    angles = both * np.minimum(1.0 / chords, 0.5 * curvatures)
    over = search.sizes[:benches, HALF_LENGTH] - 0.5 * chords + search.sizes[:benches, HALF_WIDTH]
    return arcs, np.maximum(arcs[:-1], arcs[1:]) + over * angles


def _deltas(growth: float, low: float, high: float, chord: float) -> tuple[float, float]:
    """delta of a follower whose leader is at high, and of one whose leader is at low [rad].

    Beyond a fold it is that of the fold.
    """
    chord2 = (chord / growth) ** 2
    inner, outer = (float(kernels.first_root(theta, chord2)) for theta in (high, low))
    if NO_ROOT in (inner, outer):
        fold = float(kernels.first_crest(kernels.fold_theta(chord2)))
        inner, outer = (fold if delta == NO_ROOT else delta for delta in (inner, outer))
    return inner, outer


def gap_rounding(search: ContactSearch, travel: float, within: float) -> float:
    """Largest error of gaps up to `within` [m] after a travel, see core/kernels/pairs.py [m]."""
    search.place_leaders(travel, search.room)
    kernels.chain_rounding(search.curve, search.room, search.sizes, search.placed)
    benches, edges = slice(search.room), slice(search.room + 1, None)
    error, sway = search.placed[benches, kernels.ERROR].max(), search.placed[benches, kernels.SWAY].max()
    radius = search.rings.all_radius
    if len(search.edges):
        error = max(error, search.scene.wall_error)
        sway = max(sway, search.placed[edges, kernels.SWAY].max())
        radius = max(radius, search.sizes[edges, kernels.RADIUS].max())
    reach = 4.0 * radius + within
    return float(2.0 * (2.0 * error + (2.0 * sway + 50.0 * kernels.ULP) * reach))
