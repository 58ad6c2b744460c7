"""Search: angles, rates, single pairs and marches, against a slow dance that shares no code."""

from __future__ import annotations

import numpy as np
import pytest

from core import Dragon, Spiral, Turn
from core.contact.near_graze import others_clear
from core.contact.search import ContactSearch, joined
from core.kernels import Ended
from core.kernels.results import Dip, Marched
from tests.support.slow_search import SlowDance, arc_length

DRAGON, SPIRAL = Dragon(30), Spiral()
SLOW = SlowDance.of(DRAGON, SPIRAL)
# The default dance first touches here, benches 0 and 8, and would have grazed with 0 and 11 before [m of head travel].
CONTACT, PAIR, GRAZING = 412.4738376822, (0, 8), (0, 11)
# Angles of the slow dance [rad], and difference quotients over 2 STEP [m] of them [1].
ANGLE, STEP, QUOTIENT = 1e-12, 1e-4, 1e-7
# The bottom of a dip is flat: places in it [m], gaps there [m].
FLAT, GAP = 1e-5, 1e-11


@pytest.mark.parametrize("travel", [-20.0, 0.0, 300.0, 432.0])
def test_the_head_is_where_a_root_of_the_arc_length_is(travel: float) -> None:
    search = ContactSearch(DRAGON, SPIRAL, 0.0)
    assert search.theta_at(travel) == pytest.approx(SLOW.head(travel), abs=ANGLE * 100.0)
    assert search.travel_at(search.theta_at(travel)) == pytest.approx(travel, abs=search.travel_rounding(travel))


@pytest.mark.parametrize("travel", [100.0, 400.0, 432.0])
def test_rates_are_difference_quotients_of_arc_lengths(travel: float) -> None:
    before, after = (arc_length(SLOW.thetas([SLOW.head(t)])[0]) for t in (travel - STEP, travel + STEP))
    rates = ContactSearch(DRAGON, SPIRAL, 0.0).rates(travel)
    np.testing.assert_allclose(rates, SLOW.growth * (before - after) / (2.0 * STEP), rtol=1e-5, atol=QUOTIENT)


def test_a_pair_parts_as_fast_as_its_gap_grows_and_turns_at_the_bottom_of_its_dip() -> None:
    search = ContactSearch(DRAGON, SPIRAL, 0.0)
    _, marched = search.march(CONTACT - 0.1, 0.0, start=405.0, dips=True)
    assert marched.graze is not None
    assert marched.graze.benches == GRAZING
    low, high = marched.graze.travel - 0.05, marched.graze.travel + 0.05
    travel, gap = SLOW.dip(low, high, GRAZING)
    assert marched.graze.gap == pytest.approx(gap, abs=GAP)
    assert search.bottom(low, high, GRAZING, 1e-10) == pytest.approx(travel, abs=FLAT)
    for place in (low, high):
        quotient = (SLOW.pair_gap(place + STEP, GRAZING) - SLOW.pair_gap(place - STEP, GRAZING)) / (2.0 * STEP)
        assert search.gap_rate(place, GRAZING) == pytest.approx(quotient, abs=QUOTIENT)


def test_all_pairs_but_the_touching_one_are_clear_and_it_is_followed_again_afterwards() -> None:
    search, stop = ContactSearch(DRAGON, SPIRAL, 0.0), CONTACT + 1e-3
    assert not others_clear(search, GRAZING, 400.0, stop)
    assert others_clear(search, PAIR, 400.0, stop)
    state, result = search.march(stop, 1e-10, start=400.0)
    assert (state, result.benches) == (Ended.TOUCHED, PAIR)
    assert result.touching == pytest.approx(CONTACT, abs=1e-9)
    assert result.graze is not None
    assert result.graze.benches == GRAZING
    assert search.surely_within(CONTACT + 1e-9, PAIR)
    assert not search.surely_within(CONTACT - 1e-9, PAIR)


def test_a_search_whose_work_is_done_gives_up() -> None:
    search = ContactSearch(Dragon(), Turn(1.7), 0.0, work=2e4)
    state, result, _ = search.approach(-50.0, 100.0, 1.0)
    assert state is Ended.STUCK
    assert -50.0 < result.proven < 100.0


EARLIER = Marched(3.0, None, (0, 0), 5, 0.25, Dip(0.02, 2.0, (0, 9)))


def test_a_march_that_goes_on_adds_its_steps_and_keeps_the_larger_bound_and_the_lower_graze() -> None:
    later = Marched(2.5, 4.0, (0, 8), 2, 0.125, Dip(0.03, 3.5, (1, 9)))
    assert joined(EARLIER, later) == Marched(3.0, 4.0, (0, 8), 7, 0.25, Dip(0.02, 2.0, (0, 9)))
    assert joined(EARLIER, later._replace(gap_curvature=0.5)).gap_curvature == 0.5


def test_a_march_without_a_graze_leaves_that_of_the_other() -> None:
    assert joined(EARLIER, Marched(6.0)).graze == EARLIER.graze
    assert joined(Marched(1.0), EARLIER).graze == EARLIER.graze
    assert joined(Marched(1.0), Marched(2.0)) == Marched(2.0)
