"""The least separation over an interval: a way is proven up to the least of its samples, and no further."""

from __future__ import annotations

import math

import numpy as np
import pytest
import shapely

from core import Dance, Dragon, Line, Route, Spiral, Turn, bench_poses, kernels, trajectory
from core.contact.search import ContactSearch
from core.design.pitch_bands import Bands
from core.kernels import Ended
from core.shapes.rectangles import corners

# Samples of a way [1], and the depth of a dip between two of them below both [m].
SAMPLES, BETWEEN = 400, 1e-4
# A margin above the least sample by this is met there [m].
ABOVE = 1e-9
# The default dance first touches here, benches 0 and 8 [m of head travel].
CONTACT = 412.4738376822


def random_dragon(seed: int) -> Dragon:
    rng = np.random.default_rng(seed)
    lengths, overhangs = rng.uniform(1.2, 2.4, 30), rng.uniform(0.0, 0.25, 30)
    return Dragon.of(lengths, rng.uniform(0.1, 0.35, 30), overhangs)


@pytest.mark.parametrize("path", [Spiral(0.7, 7.0), Turn(1.4)], ids=["spiral", "turn"])
@pytest.mark.parametrize("seed", range(4))
def test_a_way_is_proven_for_margins_below_its_least_sample_only(seed: int, path: Spiral | Route) -> None:
    dragon = random_dragon(seed)
    start = float(np.random.default_rng(seed).uniform(0.0, 40.0))
    search = ContactSearch(dragon, path, -1.0)
    search.resize(dragon.benches)
    least = min(search.clearance(travel)[0] for travel in np.linspace(start, start + 4.0, SAMPLES))
    below, above = (ContactSearch(dragon, path, least + more) for more in (-BETWEEN, ABOVE))
    assert below.march(start + 4.0, 0.0, start=start)[0] is Ended.REACHED
    assert above.march(start + 4.0, 0.0, start=start)[0] is not Ended.REACHED


def test_edges_at_rest_are_met_where_shapely_measures_them() -> None:
    dragon, route = random_dragon(9), Route([Line((-80.0, 0.0), (40.0, 0.0))], 80.0)
    edges = np.array([[3.0, 1.2, 9.0, 0.9], [12.0, -2.0, 12.5, -0.7]])
    times = np.linspace(0.0, 8.0, SAMPLES)
    poses = bench_poses(trajectory(Dance(dragon, route), times).position)
    shapes = shapely.polygons(corners(poses, np.stack([dragon.lengths, dragon.widths], axis=-1)))
    least = min(shapely.distance(shapes, shapely.LineString(edge.reshape(2, 2))).min() for edge in edges)
    below, above = (ContactSearch(dragon, route, least + more, edges) for more in (-5e-3, ABOVE))
    assert below.march(8.0, 0.0)[0] is Ended.REACHED
    assert above.march(8.0, 0.0)[0] is not Ended.REACHED


def test_with_too_few_rows_for_the_benches_in_reach_a_march_ends_at_capacity_and_misses_nothing() -> None:
    """The rings around the head hold some 130 benches: as few rows, and one would be missing from a pair."""
    search, ended = ContactSearch(Dragon(600), Spiral(), 0.0), set()
    for rows in (3, 9, 60, 120, 160, 300):
        search.resize(rows)
        march = kernels.March(search.interval, search.probe, search.opening)
        ended.add(march.run(380.0, 420.0, 2, True, 1e-10, False, 1e-12, 1e7))
        result = march.result()
        assert result.proven < CONTACT
        assert result.touching is None or result.benches == (0, 8)
    assert ended == {Ended.CAPACITY, Ended.TOUCHED}


@pytest.mark.parametrize("low", [0.44, 0.5, 0.56])
def test_a_band_of_pitches_is_proven_for_margins_below_its_least_sample_only(low: float) -> None:
    high, least = low + 1e-3, math.inf
    search = ContactSearch(Dragon(40), Spiral(low), -1.0)
    for pitch in np.linspace(low, high, 9):
        search.use(Spiral(pitch), -1.0)
        radii = np.linspace(4.5, 6.0, SAMPLES)
        least = min(least, *(search.clearance(search.travel_at(r / search.growth))[0] for r in radii))
    for more, reached in ((-2e-3, True), (ABOVE, False)):
        search.use(Spiral(low), least + more)
        band = Bands(search, 4.5, 16.0, least + more).march_to(high / (2.0 * math.pi))
        ended = band.run(6.0, 4.5, 2, 1e-12, 1e-9, 1e7)
        assert (ended is Ended.REACHED) is reached
