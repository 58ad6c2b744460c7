"""The least separation over an interval: a way is proven up to the least of its samples, and no further."""

import numpy as np
import pytest

from core import Dragon, Spiral, Turn
from core.contact.search import ContactSearch
from core.kernels import Ended, March

# Samples of a way [1], and the depth of a dip between two of them below both [m].
SAMPLES, BETWEEN = 400, 1e-4
# A margin above the least sample by this is met there [m].
ABOVE = 1e-9
# The default dance first touches here, benches 0 and 8 [m of head travel].
CONTACT = 412.4738376822


def random_dragon(seed):
    rng = np.random.default_rng(seed)
    lengths, overhangs = rng.uniform(1.2, 2.4, 30), rng.uniform(0.0, 0.25, 30)
    return Dragon.of(lengths, rng.uniform(0.1, 0.35, 30), overhangs)


@pytest.mark.parametrize("path", [Spiral(0.7, 7.0), Turn(1.4)], ids=["spiral", "turn"])
@pytest.mark.parametrize("seed", range(4))
def test_a_way_is_proven_for_margins_below_its_least_sample_only(seed, path):
    dragon = random_dragon(seed)
    start = float(np.random.default_rng(seed).uniform(0.0, 40.0))
    search = ContactSearch(dragon, path, -1.0)
    search.resize(dragon.benches)
    least = min(search.clearance(travel)[0] for travel in np.linspace(start, start + 4.0, SAMPLES))
    below, above = (ContactSearch(dragon, path, least + more) for more in (-BETWEEN, ABOVE))
    assert below.march(start + 4.0, 0.0, start=start)[0] is Ended.REACHED
    assert above.march(start + 4.0, 0.0, start=start)[0] is not Ended.REACHED


def test_with_too_few_rows_for_the_benches_in_reach_a_march_ends_at_capacity_and_misses_nothing():
    """The rings around the head hold some 130 benches: as few rows, and one would be missing from a pair."""
    search, ended = ContactSearch(Dragon(600), Spiral(), 0.0), set()
    for rows in (3, 9, 60, 120, 160, 300):
        search.resize(rows)
        march = March(search.interval, search.probe, search.opening)
        ended.add(march.run(380.0, 420.0, 2, True, 1e-10, False, 1e-12, 1e7))
        result = march.result()
        assert result.proven < CONTACT
        assert result.touching is None or result.benches == (0, 8)
    assert ended == {Ended.CAPACITY, Ended.TOUCHED}
