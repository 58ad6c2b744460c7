"""Errors of computed gaps against their bounds: random chains in doubles and to 50 digits.

python -m tests.campaigns.rounding_sweep 10000 [SEED] compares this many gaps and prints the largest and the median
error, in parts of its bound; exit code 1 where one exceeds its bound.
"""

import sys
from collections import defaultdict
from itertools import pairwise

import numpy as np
from flint import acb, arb

from core import Dance, Dragon, InvalidValue, Route, Spiral, Turn, kernels
from core.checks import SIZE_MAX, SIZE_MIN
from core.kernels.constants import ERROR, HALF_LENGTH, HALF_WIDTH, MX, MY, PX, PY, RADIUS, SWAY, UX, UY
from tests.campaigns import hunting
from tests.support.exact_chain import ExactRoute, separation, spiral_handles
from tests.support.random_routes import Pen
from tests.support.searches import search_on

# Gaps compared in every chain, half of them of pairs behind the head.
PAIRS = 20
# Chains of a hundred that are as long as LINKS; the others have up to MODERATE links.
LONG = 2
LINKS = 2_000
MODERATE = 60
# Pieces, centres and rotations of random routes [m], [rad].
EXTENT = 30.0


def random_dragon(rng, links, chord):
    """Alike behind the head or bench by bench; overhangs up to many chords."""
    chords = np.full(links, chord)
    if rng.random() < 0.4:
        chords = chord * 10 ** rng.uniform(-0.7, 0.0, links)
    overhangs = chords * 10 ** rng.uniform(-2.0, 0.3) * (rng.random(links) < 0.8)
    if rng.random() < 0.2:
        overhangs = np.minimum(20.0 * overhangs, 0.49 * (SIZE_MAX - chords))
    width = max(10 ** rng.uniform(-1.5, 0.0) * chord, SIZE_MIN)
    return Dragon.of(chords + 2.0 * overhangs, np.full(links, width), overhangs)


def links_of(rng):
    return LINKS if rng.random() < 0.01 * LONG else int(rng.integers(3, MODERATE))


def random_spiral(rng):
    """A search, and a theta of the head: anywhere, far out, or near where the run ends."""
    while True:
        links = links_of(rng)
        growth = 10 ** rng.uniform(-3.0, 1.0)
        dragon = random_dragon(rng, links, max(growth * 10 ** rng.uniform(-0.7, 2.0), 0.02))
        spiral = Spiral(2.0 * np.pi * growth, 10 ** rng.uniform(1.0, 3.5))
        try:
            end = Dance(dragon, spiral).end.theta or 0.0
        except InvalidValue:
            continue
        theta = end + 10 ** rng.uniform(-6.0, 0.0) if rng.random() < 0.3 else rng.uniform(end, spiral.start_theta)
        if theta > 0.0 and (dragon.chords / growth / (1.0 + theta)).max() < 3.0:
            return search_on(dragon, spiral), float(theta)


def random_route(rng):
    """A search, and an s of the head with the whole dragon on the route."""
    while True:
        links = links_of(rng) if rng.random() < 0.5 else int(rng.integers(3, 20))
        path = random_path(rng)
        dragon = random_dragon(rng, links, 10 ** rng.uniform(-0.7, 0.0) / path.sharpest[0] if path.sharpest[0] else 1.0)
        try:
            end = Dance(dragon, path).end.time
            begin = max(Dance(dragon, path, 1.0).earliest, path.begin)
        except InvalidValue:
            continue
        if begin < end:
            return search_on(dragon, path), rng.uniform(begin, end)


def random_path(rng):
    """A turn, or a line and up to four pieces of any kind; curvatures jump between them, or go on."""
    if rng.random() < 0.2:
        return Turn(*rng.uniform((1.4, 4.0, 1.0), (2.5, 6.0, 2.5)).tolist())
    pen = Pen(complex(*rng.uniform(-EXTENT, EXTENT, 2)), rng.uniform(-9.0, 9.0))
    bend = 0.0
    pen.line(rng.uniform(20.0, 90.0))
    for kind in rng.choice(["line", "arc", "coil", "clothoid", "waypoints"], rng.integers(1, 5)):
        last = rng.uniform(-0.5, 0.5)
        sizes = {
            "line": (20.0,),
            "arc": (rng.uniform(2.0, 9.0), 5.0 * last),
            "coil": (10 ** rng.uniform(-0.5, 0.5), *rng.uniform(2.0, 30.0, 2).tolist()),
            "clothoid": (bend, last, 10 ** rng.uniform(-1.0, 1.2)),
            "waypoints": (rng.uniform((4.0, -0.7), (9.0, 0.7), (8, 2)).tolist(),),
        }
        getattr(pen, kind)(*sizes[kind])
        bend = last if kind == "clothoid" else 0.0
    return Route(pen.pieces, start=rng.uniform(0.0, 100.0))


def compare(errors, search, head, rng):
    """Adds the errors of one chain over their bounds, by what they are of; its head is at theta or s."""
    dragon = search.dragon
    growth = search.growth
    search.resize(dragon.benches)
    sizes = search.sizes
    chain = search.placed
    if isinstance(search.path, Spiral):
        kernels.start_chain(head, chain)
        assert kernels.extend_chain(growth, 0, dragon.benches, kernels.FREE, sizes, chain) == dragon.benches
        handles = spiral_handles(growth, head, dragon.chords)
    else:
        kernels.place_chain(search.curve, -head, dragon.benches, sizes, chain)
        exact = ExactRoute(search.path.table)
        place = arb(head)
        point, tangent = exact.point(place)
        slide = ((acb(*chain[0, [PX, PY]].tolist()) - point) * tangent.conjugate()).real
        errors["slides"].append(abs(float(slide)) / search.path.slide)
        handles = exact.handles(place + slide, dragon.chords)
    kernels.chain_rounding(search.curve, dragon.benches, sizes, chain)
    if chain[dragon.benches - 1, ERROR] >= kernels.FREE:  # within about 1e-12 m of a fold, where nothing is claimed
        return
    benches = list(pairwise(handles))
    for k in rng.integers(0, dragon.benches, PAIRS).tolist():
        _compare_bench(errors, chain[k], benches[k], dragon.chords[k])
    for a, b in _pairs(rng, dragon.benches, PAIRS):
        size = sizes[[a, b]]
        apart = float(np.hypot(*(chain[b, MX : MY + 1] - chain[a, MX : MY + 1])))
        bound = kernels.pair_rounding(a, b, apart, sizes, chain, chain)
        frames = np.hstack([chain[[a, b], MX : UY + 1], size[:, HALF_LENGTH : HALF_WIDTH + 1]])
        kernels.pair_gaps(frames[:1], frames[1:], kernels.NO_LIMIT, gap := np.empty(1))
        true = separation(benches[a], benches[b], (size[0, :RADIUS], size[1, :RADIUS]))
        errors["gaps"].append(abs(float(true - gap[0])) / bound)


def _compare_bench(errors, row, bench, chord):
    front, rear = bench
    centre = float(abs((front + rear) / 2 - acb(*row[[MX, MY]].tolist())))
    direction = float(abs((front - rear) / chord - acb(*row[[UX, UY]].tolist())))
    errors["points"].append(centre / (row[ERROR] + kernels.ULP * (abs(row[MX]) + abs(row[MY]))))
    errors["directions"].append(direction / row[SWAY])


def _pairs(rng, benches, count):
    for k in range(count):
        a = int(rng.integers(0, min(3, benches - 2))) if k % 2 else int(rng.integers(0, benches - 2))
        yield a, int(rng.integers(a + 2, min(benches, a + 2 + (40 if k % 4 < 2 else benches))))


def sweep(gaps, seed):
    """Errors of a number of gaps, of chains on spirals and routes in turn, over their bounds."""
    rng = np.random.default_rng(seed)
    errors = defaultdict(list)
    chains = 0
    while len(errors["gaps"]) < gaps:
        chains += 1
        compare(errors, *(random_spiral(rng) if chains % 2 else random_route(rng)), rng)
    return errors


if __name__ == "__main__":
    result = sweep(*hunting.arguments(10_000, 0))
    for name, ratios in result.items():
        most = np.max(ratios)
        middle = np.median(ratios)
        print(f"{name:>10}: {len(ratios)} compared, error over bound {most:.3g}, median {middle:.3g}")
    sys.exit(int(max(map(max, result.values())) > 1.0))
