"""A march: how it ends, against samples of every pair."""

from __future__ import annotations

import numpy as np

from core import Dragon, Spiral, kernels
from core.contact.search import ContactSearch
from core.kernels import Ended

HALF_BRACKET, WORK, ROUNDING = 1e-10, 1e7, 1e-12
DRAGON, SPIRAL = Dragon(40), Spiral()
# The default dance first touches here [m of head travel].
CONTACT = 412.4738376822


def march_of(search: ContactSearch) -> kernels.March:
    return kernels.March(search.interval, search.probe, search.opening)


def ended(
    march: kernels.March, start: float, stop: float, half_bracket: float = HALF_BRACKET, budget: float = WORK
) -> Ended:
    return march.run(start, stop, 2, True, half_bracket, True, ROUNDING, budget)


def test_a_way_that_is_proven_is_clear_at_every_sample() -> None:
    search = ContactSearch(DRAGON, SPIRAL, 0.05)
    march = march_of(search)
    assert ended(march, 300.0, 380.0) is Ended.REACHED
    assert march.result()[:2] == (380.0, None)
    assert all(search.clearance(travel)[0] > 0.05 for travel in np.linspace(300.0, 380.0, 500))


def test_a_contact_is_bracketed_by_a_clear_and_a_touching_instant() -> None:
    search = ContactSearch(DRAGON, SPIRAL, 0.0)
    march = march_of(search)
    assert ended(march, 380.0, 420.0) is Ended.TOUCHED
    result = march.result()
    assert result.touching is not None
    assert result.proven <= CONTACT <= result.touching <= result.proven + 3.0 * HALF_BRACKET
    assert result.benches == (0, 8)
    place = search.place - result.proven + 1e-6
    assert kernels.gap_at(search.scene, place, 0, 8, search.probed) > 0.0
    assert kernels.gap_at(search.scene, search.place - result.touching, 0, 8, search.probed) <= 0.0
    # the dip before it, seen on the way
    assert result.graze is not None
    assert 0.0 < result.graze.gap < 0.001
    assert result.graze.benches == (0, 11)


def test_a_march_from_within_a_contact_ends_where_it_starts() -> None:
    march = march_of(ContactSearch(DRAGON, SPIRAL, 0.0))
    assert ended(march, 413.0, 420.0) is Ended.TOUCHED_AT_START
    result = march.result()
    assert result.proven == result.touching == 413.0
    assert result.steps == 0


def test_without_work_a_march_is_stuck_and_keeps_what_it_has_proven() -> None:
    march = march_of(ContactSearch(DRAGON, SPIRAL, 0.0))
    assert ended(march, 380.0, 420.0, budget=200.0) is Ended.STUCK
    assert 380.0 < march.result().proven < CONTACT
    assert march.result().touching is None


def test_a_dragon_with_too_few_rows_ends_at_capacity() -> None:
    search = ContactSearch(DRAGON, SPIRAL, 0.0)
    search.resize(3)
    assert ended(march_of(search), 380.0, 420.0) is Ended.CAPACITY


def test_a_pair_that_is_left_out_is_not_found() -> None:
    search = ContactSearch(DRAGON, SPIRAL, 0.0)
    search.scene.left_out, search.scene.left_out_too = 0, 8
    march = march_of(search)
    assert ended(march, 380.0, 420.0) is Ended.TOUCHED
    result = march.result()
    assert result.benches != (0, 8)
    assert result.touching is not None
    assert result.touching > CONTACT
