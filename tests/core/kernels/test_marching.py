"""A march: how it ends. What it proves of the way: test_nearest.py."""

from core import Dragon, Spiral
from core.kernels import Ended, March
from tests.support.searches import search_on

HALF_BRACKET = 1e-10
ROUNDING = 1e-12
# The default dance first touches here [m of head travel].
CONTACT = 412.4738376822


def forty():
    return search_on(Dragon(40), Spiral())


def marched(search, work=1e7):
    """A march past the contact."""
    march = March(search.interval, search.probe, search.opening)
    return march.run(380.0, 420.0, 2, True, HALF_BRACKET, True, ROUNDING, work)


def test_without_work_a_march_is_stuck_and_keeps_what_it_has_proven():
    result = marched(forty(), work=200.0)
    assert result.ended is Ended.STUCK
    assert 380.0 < result.proven < CONTACT
    assert result.touching is None
