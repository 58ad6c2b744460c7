"""Queries by design, each with its certified truth: contacts, grazes at chosen depths, and corners that stay far."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterator
from typing import NamedTuple

import numpy as np
from flint import arb
from numpy.random import Generator

from benchmarks.ccd.dances import KINDS, Record, generator, random_record
from benchmarks.ccd.motion import Query, Stage, beside
from benchmarks.ccd.pieces import Unproven, pieces_of
from benchmarks.ccd.truth import Track, covered, track
from core.kernels.constants import HALF_LENGTH, HALF_WIDTH, MX, MY, RADIUS
from core.values import Floats

CONTACT, GRAZE, FAR = range(3)
CLASSES = ("contact", "graze", "far")
# Largest number of queries of one dance in each class. Many dances have few grazes, so the others may give more, which
# balances the classes.
QUOTA = (36, 50, 34)
# Head ways of the queries [m], instants at which distances are looked at first, and the margins asked for [m].
SPANS = (0.03, 0.6)
SAMPLES = 65
MARGINS = (0.003, 0.8)
# Depths of grazes [m], as powers of ten: positive: clear by this; negative: nearer than the margin by this. Each pass
# of a corner gives DEPTHS_EACH of them, each with both signs.
DEPTHS = range(3, 10)
DEPTHS_EACH = 2
# Least change of the distance before and after a graze, and least further depth of a contact [m].
RISE = 1e-5
# Least and largest clearance of a far query [m]; relative width to which the depth of a graze is certified [1].
FAR_BY = (0.01, 1.0)
EXACT = 1e-3
# Largest number of queries of one stretch in each class; largest number of places of the head and of stretches tried in
# one dance: a dance with few near passes has fewer queries.
EACH_MOST = (6, 12, 3)
PLACES_MOST = 1000
WAYS_MOST = 60
# Distance ahead in which nearest passes are sought [m], number of instants there, share of stretches around a pass [1].
SCAN, SCANNED, AT_PASSES = 1.5, 61, 0.8
# A corner is beside an edge by at least this [m].
BESIDE = 0.005
# Pairs of benches nearer than this are asked about [m], led by one of the first benches.
NEAR = 0.5
LEADERS = 3
# Width to which the time of a contact and of the nearest pass is sought before it is certified [m].
SOUGHT = 1e-15

Way = tuple[float, float, tuple[int, int]]


class Known(NamedTuple):
    """A query with its truth.

    dance: its number; kind: of CLASSES; depth: by how much the corner stays clear, or, negative, comes nearer than the
        margin [m]: chosen for grazes, found for far ones, not a number for contacts
    low, high: clear up to the first, within the margin at the second travel [m]; not numbers if it stays clear
    """

    dance: int
    query: Query
    kind: int
    depth: float
    low: float
    high: float


def dance_queries(seed: int, number: int) -> tuple[Record, list[Known]]:
    """A random dance and its queries."""
    random = generator(seed, number)
    record = random_record(random, KINDS[number % len(KINDS)])
    return record, list(_queries(random, Stage(record), number))


def _queries(random: Generator, stage: Stage, number: int) -> Iterator[Known]:
    """Queries of one dance until all quotas are met, or too many ways were tried."""
    pieces, left, tried = pieces_of(stage), list(QUOTA), 0
    for _ in range(PLACES_MOST):
        if not any(left) or tried == WAYS_MOST:
            return
        way = _way(random, stage)
        if way is None:
            continue
        place, span, benches = way
        candidates = list(_candidates(random, stage, way, left))
        if not candidates:
            continue
        tried += 1
        try:
            expansions = covered(stage, pieces, place, span, max(benches) + 1)
        except Unproven:
            continue
        for kind, query, target in candidates:
            if left[kind]:
                try:
                    known = _certified(track(expansions, query, stage), number, query, kind, target)
                except Unproven:
                    continue
                if known is not None:
                    left[kind] -= 1
                    yield known


def _way(random: Generator, stage: Stage) -> Way | None:
    """A place of the head, how far it goes [m], and two benches that are near one another then.

    Where a corner passes its nearest to an edge within SCAN from there, the way is most often laid around that.
    """
    dance, search = stage.dance, stage.search
    span = math.exp(random.uniform(*np.log(SPANS)))
    begin, end = max(dance.begin, 0.0), dance.end.time - SCAN - SPANS[1] - 0.05
    if end <= begin + SPANS[1]:
        return None
    travel, benches = random.uniform(begin + SPANS[1], end), dance.dragon.benches
    rows = stage.lay(float(search.place - travel), benches)
    near = []
    for a in range(min(LEADERS, benches)):
        for b in range(a + 2, benches):
            apart = math.hypot(rows[a, MX] - rows[b, MX], rows[a, MY] - rows[b, MY])
            if apart < stage.sizes[a, RADIUS] + stage.sizes[b, RADIUS] + NEAR:
                near.append((a, b))
    if not near:
        return None
    pair = near[int(random.integers(len(near)))]
    passes = _passes(stage, travel, pair)
    if len(passes) and random.random() < AT_PASSES:
        travel = float(random.choice(passes)) - random.uniform(0.2, 0.8) * span
    return float(search.place - travel), span, pair


def _passes(stage: Stage, start: float, pair: tuple[int, int]) -> Floats:
    """Travels in the next SCAN at which some corner of one bench is nearest to an edge of the other beside it [m]."""
    travels = start + np.linspace(0.0, SCAN, SCANNED)
    rows = np.stack([stage.lay(float(stage.search.place - travel), max(pair) + 1).copy() for travel in travels])
    passes = []
    for order in (pair, pair[::-1]):
        along, out = beside(rows, stage.sizes, *order)
        halves = stage.sizes[order[1], [HALF_WIDTH, HALF_LENGTH, HALF_WIDTH, HALF_LENGTH]]
        usable = (np.abs(along) < halves - BESIDE) & (out > MARGINS[0]) & (out < MARGINS[1])
        least = (out[1:-1] < out[:-2]) & (out[1:-1] <= out[2:]) & usable[1:-1]
        passes.append(travels[1:-1][least.any(axis=(1, 2))])
    return np.concatenate(passes)


def _candidates(
    random: Generator, stage: Stage, way: Way, left: list[int]
) -> Iterator[tuple[int, Query, tuple[float, float]]]:
    """Queries on one stretch that meet a target in doubles: kind, query without margin, target.

    target: for a contact its travel and the least margin, for a graze the travel at which it is nearest and the depth,
    for a far query the same travel and the clearance [m]
    """
    place, span, pair = way
    travels = np.linspace(0.0, span, SAMPLES)
    rows = np.stack([stage.lay(place - travel, max(pair) + 1).copy() for travel in travels])
    taken: Counter[int] = Counter()
    features = [(*order, corner, edge) for order in (pair, pair[::-1]) for corner in range(4) for edge in range(4)]
    seen = {order: beside(rows, stage.sizes, *order) for order in (pair, pair[::-1])}
    for index in random.permutation(len(features)):
        corner_bench, edge_bench, corner, edge = features[index]
        along, distance = (part[:, corner, edge] for part in seen[corner_bench, edge_bench])
        half = stage.sizes[edge_bench, (HALF_WIDTH, HALF_LENGTH)[edge % 2]]
        if not (np.abs(along).max() < half - BESIDE and distance.min() > MARGINS[0]):
            continue
        query = Query(place, span, corner_bench, corner, edge_bench, edge, math.nan)
        for kind, target in _targets(random, travels, distance):
            if left[kind] and taken[kind] < EACH_MOST[kind]:
                taken[kind] += 1
                yield kind, query, target


def _targets(random: Generator, travels: Floats, distance: Floats) -> Iterator[tuple[int, tuple[float, float]]]:
    """The classes that the distances of a corner from an edge allow."""
    least = int(distance.argmin())
    lowest = float(distance[least])
    if not lowest < MARGINS[1]:
        return
    rise = float(min(distance[0], distance[-1])) - lowest
    if rise > RISE:
        depths = random.permutation([depth for depth in DEPTHS if 10.0**-depth < rise])[:DEPTHS_EACH]
        for depth in depths.tolist():
            for side in (-1, 1):
                yield GRAZE, (float(travels[least]), side * 10.0**-depth)
    new_low = np.flatnonzero(distance[1:-1] < np.minimum.accumulate(distance)[:-2]) + 1
    new_low = new_low[(distance[new_low] < MARGINS[1]) & (distance[new_low] > lowest + RISE)]
    if new_low.size:
        index = int(random.choice(new_low))
        near = travels[index] - random.random() * (travels[index] - travels[index - 1])
        yield CONTACT, (float(near), lowest + RISE)
    if lowest > MARGINS[0] + FAR_BY[0]:
        by = math.exp(random.uniform(*np.log((FAR_BY[0], min(FAR_BY[1], lowest - MARGINS[0])))))
        yield FAR, (float(travels[least]), by)


def _certified(seen: Track, number: int, query: Query, kind: int, target: tuple[float, float]) -> Known | None:
    """The query with its margin and its truth; None if the balls do not prove it."""
    near, depth = target
    if kind == CONTACT:
        least, margin, depth = depth, float(seen.out(near)), 0.0
    else:
        near = _nearest(seen, near, query.span)
        least, margin = MARGINS[0], float(seen.out(near) - depth)
    if not least <= margin <= MARGINS[1] or not seen.out(0.0) > margin + 0.1 * abs(min(depth, 0.0)):
        return None
    query = query._replace(margin=margin)
    if kind != CONTACT:  # nowhere nearer than this, and nearer than that somewhere
        floor, most = (arb(margin) + arb(depth) * (1 + side * EXACT * (1 if depth > 0 else -1)) for side in (-1, 1))
        if not (seen.clear(floor, 0.0, query.span) and seen.within(most, near)):
            return None
    if kind == FAR or depth > 0.0:
        return Known(number, query, kind, depth, math.nan, math.nan)
    bracket = seen.contact(arb(margin), near if kind == CONTACT else _first(seen, margin, near))
    return None if bracket is None else Known(number, query, kind, depth if kind == GRAZE else math.nan, *bracket)


def _nearest(seen: Track, near: float, span: float) -> float:
    """Travel at which the distance is least around a sample, by golden sections [m]."""
    step = span / (SAMPLES - 1)
    low, high = max(near - step, 0.0), min(near + step, span)
    ratio = (math.sqrt(5.0) - 1.0) / 2.0
    a, b = high - ratio * (high - low), low + ratio * (high - low)
    value_a, value_b = seen.out(a).mid(), seen.out(b).mid()
    while high - low > 1e-12:
        if value_a < value_b:
            high, b, value_b = b, a, value_a
            a = high - ratio * (high - low)
            value_a = seen.out(a).mid()
        else:
            low, a, value_a = a, b, value_b
            b = low + ratio * (high - low)
            value_b = seen.out(b).mid()
    return (low + high) / 2


def _first(seen: Track, margin: float, inside: float) -> float:
    """Travel at which the distance first falls to the margin, if it does so once before a travel inside [m]."""
    low, high = 0.0, inside
    while high - low > SOUGHT * 4 and low < (middle := (low + high) / 2) < high:
        if seen.out(middle).mid() > margin:
            low = middle
        else:
            high = middle
    return high
