"""The least distance over a stretch of the dance: found by sampling, proven by marching."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from core.contact.first_contact import DIP_WIDTH, PROFILE_STEP
from core.contact.search import NEAR_WORK_BUDGET, Search
from core.dance import Dance, RunEnd
from core.shown import Shown
from core.values import checked_type

# The least distance is proven to this [m]; to the next one where that takes more steps than a search may.
PROOF_WIDTHS = (1e-5, 1e-3)
# So many of the lowest samples are refined before the proof begins.
DIPS_REFINED = 5
# So often the proof may come upon something nearer; each time the distance falls by PROOF_WIDTHS[0] or more.
ROUNDS = 100

Pair = tuple[int, int]
# Gap [m], head travel [m], pair.
Dip = tuple[float, float, Pair]


@dataclass(frozen=True, slots=True, repr=False)
class LeastClearance(Shown):
    """The least clearance over a stretch of the dance.

    distance: the least found [m], met at `time` [s] by `benches`; 0 at the first touch if benches touch
    at_least: proven [m]: nothing comes nearer than this, which is PROOF_WIDTHS[0] below the distance or, where
        steps run short, PROOF_WIDTHS[1]; None where the search gave up first
    """

    distance: float
    at_least: float | None
    time: float
    benches: Pair


def least_clearance(dance: Dance, *, start: float = 0.0, stop: float | None = None) -> LeastClearance | None:
    """The least clearance between start and stop [s], None for the end of the run; None with fewer than three benches.

    raises: InvalidValue; OutsideRun for a stop after the end of the run
    """
    checked_type("dance", dance, Dance)
    begin, until = dance.span(start, stop)
    head_speed, end = dance.head_speed, dance.end
    if dance.dragon.benches < 3:
        return None
    to_fold = dance.nears_fold(until)
    search = Search(dance.dragon, dance.path, 0.0, work=NEAR_WORK_BUDGET)
    last = search.last_travel(until * head_speed, to_fold)
    fold = end if to_fold else None
    (distance, travel, pair), at_least = least_over(search, begin * head_speed, last, head_speed, fold)
    return LeastClearance(distance, at_least, travel / head_speed, pair)


# A sampled and refined gap is an upper bound of the least one, as it is met. A march whose margin is that gap less a
# width either ends, and so proves that nothing comes nearer, or meets a lower gap: then that one is refined, and the
# march goes on from there with the lower margin, since what was passed is clear of the higher one. A dip that ends
# between that margin and the gap is crossed in steps far shorter than it is wide, so the march refines it.
def least_over(
    search: Search, begin: float, until: float, head_speed: float, fold: RunEnd | None = None
) -> tuple[Dip, float | None]:
    """The least gap of the search's pairs between two travels of the head, and what is proven of it [m].

    A gap of 0 stands for the first touch. The search's margin is another one afterwards.
    fold: where the run ends, if right after `until` and at a fold. Steps shrink to nothing before it, where handles
        are fast without bound, so a bound on the motion left takes the place of the last ones: Search.least_to_fold()
    """
    best = _sampled(search, begin, until)
    proven_to, proven = begin, None
    for width in PROOF_WIDTHS:
        for _ in range(ROUNDS):
            if best[0] <= 0.0:
                return _first_touch(search, proven_to, until, head_speed, best)
            search.use(search.path, max(best[0] - width, 0.0))
            margin = search.margin
            state, found = search.march(until, 0.0, start=proven_to, dips=True)
            if found.graze is not None and found.graze.gap < best[0]:
                best = found.graze
            if state in ("reached", "stuck"):
                left = margin if state == "reached" else None
                if fold is not None:
                    left = search.least_to_fold(min(found.proven, until), fold)
                if left is not None and left >= margin:
                    return best, margin
                proven = max(proven or 0.0, left or 0.0) or None
                break
            proven_to = max(proven_to, found.proven)
            reach = PROFILE_STEP * search.extremes[1]
            touching = found.touching
            assert touching is not None
            best = min(best, _refined(search, max(begin, touching - reach), touching, min(until, touching + reach)))
    return best, proven


def _first_touch(search: Search, begin: float, until: float, head_speed: float, touching: Dip) -> tuple[Dip, float]:
    """Something touches for certain: when first; at the instant known where the search gives up."""
    search.use(search.path, 0.0)
    state, found, tolerance = search.approach(begin, until, head_speed)
    if not state.startswith("touched") or found.touching is None:
        return (0.0, *touching[1:]), 0.0
    return (0.0, found.touching - (tolerance if state == "touched" else 0.0), found.benches), 0.0


def _sampled(search: Search, begin: float, until: float) -> Dip:
    """The least of the dips seen in steps of PROFILE_STEP of the shortest chord, or fewer: see Search.samples()."""
    grid = np.linspace(begin, until, search.samples(until - begin, PROFILE_STEP * search.extremes[1])).tolist()
    leaders = min(search.dragon.uniform_from + 1, search.dragon.benches)
    gaps = np.array([search.clearance(travel, leaders)[0] for travel in grid])
    inner = 1 + np.flatnonzero((gaps[1:-1] <= gaps[:-2]) & (gaps[1:-1] <= gaps[2:]))
    deepest = inner[np.argsort(gaps[inner], kind="stable")[:DIPS_REFINED]]
    ends = [(gap, travel, pair) for travel in (begin, until) for gap, pair in (search.clearance(travel),)]
    return min(ends + [_refined(search, *grid[k - 1 : k + 2]) for k in deepest.tolist()])


def _refined(search: Search, low: float, middle: float, high: float) -> Dip:
    """The bottom of the dip that the middle travel lies in; a second time if another pair is nearer there."""
    gap, pair = search.clearance(middle)
    best = (gap, middle, pair)
    for _ in range(2):
        travel = search.bottom(low, high, best[2], DIP_WIDTH)
        gap, pair = search.clearance(travel)
        best = min(best, (gap, travel, pair))
    return best
