"""A stretch of a path: the bottom of a dip on it, against a slow dance that shares no code."""

from core import Dragon, Spiral
from core.contact.search import ContactSearch
from core.contact.stretch import Stretch, least_on, overlap_beyond
from tests.support.near import assert_near
from tests.support.slow_search import SlowDance

SLOW = SlowDance.of(Dragon(30), Spiral())
# The default dance first touches here, and would have grazed with 0 and 11 before [m of head travel].
CONTACT = 412.4738376822
GRAZING = (0, 11)
BOTTOM = (409.0, 411.0)
FLAT = 1e-5
GAP = 1e-11
PROVEN = 1e-3


def test_the_least_gap_of_a_stretch_is_the_bottom_of_its_dip_and_proven_from_below():
    dip, at_least = least_on(Stretch(ContactSearch(Dragon(30), Spiral(), 0.0), BOTTOM, 1.0))
    travel, gap = SLOW.dip(*BOTTOM, GRAZING)
    assert dip.pair == GRAZING
    assert_near(dip.gap, gap, GAP)
    assert_near(dip.moment, travel, FLAT)
    assert 0.0 <= dip.gap - at_least <= PROVEN


def test_a_certain_contact_is_found_beyond_the_place_where_a_search_gave_up():
    search = ContactSearch(Dragon(30), Spiral(), 0.0)
    found = overlap_beyond(Stretch(search, (CONTACT - 5e-3, CONTACT + 1.0), 1.0))
    assert CONTACT <= found.touching <= CONTACT + 1.0
    assert overlap_beyond(Stretch(search, (400.0, 401.0), 1.0)) is None
