"""Benches that repeat what others met: the family lemma, and dances in which a body slides back behind its start."""

import numpy as np
import pytest

from core import Dance, Dragon, EndReason, Outcome, Spiral, Turn, first_contact, trajectory
from core.kernels.constants import THETA
from core.sampling import bisect
from tests.support.depth import some, thorough
from tests.support.near import assert_near
from tests.support.searches import search_on

# Two poses of one bench at one place of a path, found by two ways of the head [m], and two times of contact [s].
SAME = 1e-9
ACCURACY = 1e-9


@pytest.mark.parametrize("path", [Spiral(0.8, 8.0), Turn(1.7)], ids=["spiral", "turn"])
@pytest.mark.parametrize("first", [0, 1, 3])
def test_a_pair_of_equal_benches_repeats_in_place_what_the_first_of_them_met(path, first):
    """The family lemma: core/kernels/repeats.py."""
    lengths = np.full(40, 2.2)
    lengths[:first] = np.linspace(3.0, 2.5, first)
    dragon = Dragon.of(lengths, np.full(40, 0.3), np.full(40, 0.275))
    assert dragon.uniform_from == first
    rng = np.random.default_rng(first)
    search = search_on(dragon, path)

    def place(handle, time):
        search.place_leaders(time, 40)
        return float(search.placed[handle, THETA])

    for time in rng.uniform(20.0, 100.0, 8):
        i = int(rng.integers(first + 1, 30))
        here = place(i, time)
        earliest = time - 2.0 * float(dragon.chords[:i].sum())
        earlier = bisect(lambda at, here=here: place(first, at) <= here, earliest, time, width=SAME * 1e-3)[1]
        then, now = trajectory(Dance(dragon, path), [earlier, time]).position
        np.testing.assert_allclose(then[first : first + 41 - i], now[i:], rtol=0, atol=SAME)


@pytest.mark.parametrize("seed", [2, *thorough(*some((0, 1, *range(3, 12)), 4))])
def test_a_body_that_slides_back_behind_its_start_has_the_contacts_of_the_general_way(seed):
    """A head chord far longer than the body's: near its fold the body goes back by many links. The last bench is longer
    by a nanometre in the second dragon, so that all pairs are followed there."""
    rng = np.random.default_rng(seed)
    while True:
        chord = 10 ** rng.uniform(-1.0, -0.3)
        head = 10 ** rng.uniform(0.6, 1.0)
        dragon = Dragon(int(rng.integers(6, 30)), head, chord, 0.3 * chord, 0.0)
        spiral = Spiral(10 ** rng.uniform(0.5, 1.0), rng.uniform(2.0, 4.0))
        end = Dance(dragon, spiral).end
        if end.reason is not EndReason.FOLD:
            continue
        start = end.time - 10 ** rng.uniform(-0.5, 0.5)
        times = end.time - (end.time - start) * np.linspace(1.0, 0.0, 200) ** 2
        radii = np.linalg.norm(trajectory(Dance(dragon, spiral), times).position, axis=-1)[:, 3]
        if start > 0.0 and radii[-1] > radii[0] > radii.min() + chord:
            break
    lengths = np.array(dragon.lengths)
    lengths[-1] += 1e-9
    general = Dragon.of(lengths, dragon.widths, dragon.overhangs)
    family, every = (first_contact(Dance(each, spiral), start=start) for each in (dragon, general))
    assert family.outcome is every.outcome
    if family.outcome is Outcome.CONTACT:
        assert_near(family.time, every.time, ACCURACY)
