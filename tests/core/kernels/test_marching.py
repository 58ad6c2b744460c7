"""A march: how it ends. What it proves of the way: test_nearest.py."""

from core import Dragon, Spiral
from core.contact.search import ContactSearch
from core.kernels import Ended, March

HALF_BRACKET = 1e-10
ROUNDING = 1e-12
# The default dance first touches here [m of head travel].
CONTACT = 412.4738376822


def forty():
    return ContactSearch(Dragon(40), Spiral(), 0.0)


def marched(search, work=1e7):
    """The end of a march past the contact, and its result."""
    march = March(search.interval, search.probe, search.opening)
    return march.run(380.0, 420.0, 2, True, HALF_BRACKET, True, ROUNDING, work), march.result()


def test_without_work_a_march_is_stuck_and_keeps_what_it_has_proven():
    ended, result = marched(forty(), work=200.0)
    assert ended is Ended.STUCK
    assert 380.0 < result.proven < CONTACT
    assert result.touching is None
