"""The least separation over an interval, with too few rows. Bounds: tests/core/contact/test_clearance.py."""

import math

from core import Arc, Dance, Dragon, Line, Route, Spiral, clearance_profile, first_contact
from core.kernels import Ended, March
from tests.support.near import assert_near
from tests.support.searches import search_on

# The default dance first touches here, benches 0 and 8 [m of head travel].
CONTACT = 412.4738376822


def test_with_too_few_rows_for_the_benches_in_reach_a_march_ends_at_capacity_and_misses_nothing():
    """The rings around the head hold some 130 benches: as few rows, and one would be missing from a pair."""
    search = search_on(Dragon(600), Spiral())
    ended = set()
    for rows in (3, 9, 60, 120, 160, 300):
        search.resize(rows)
        march = March(search.interval, search.probe, search.opening)
        result = march.run(380.0, 420.0, 2, True, 1e-10, False, 1e-12, 1e7)
        ended.add(result.ended)
        assert result.proven < CONTACT
        assert result.touching is None or result.pair == (0, 8)
    assert ended == {Ended.CAPACITY, Ended.TOUCHED}


def test_a_head_that_comes_back_against_its_tail_touches_it_and_does_not_overlap():
    """A loop leads back onto the lane, on which both benches of the pair are as fast."""
    third = math.pi / 3.0
    lane = [(-140.0, 0.0), (0.0, 0.0)]
    right = Arc((0.0, -20.0), 20.0, 1.5 * third, -third)
    back = Arc((0.0, 20.0), 20.0, -0.5 * third, -third)
    loop = Arc((20.0 * math.sqrt(3.0), 0.0), 20.0, -2.5 * third, 5.0 * third)
    dance = Dance(Dragon(94), Route([Line(*lane), right, loop, back, Line(*lane[::-1])]))
    met = first_contact(dance, start=276.0)
    assert_near(clearance_profile(dance, met.time).clearance, 0.0, 1e-9)
