"""A stretch of a path: a contact beyond its end; the least gap on it: test_clearance.py."""

from core import Dragon, Spiral
from core.contact.stretch import Stretch, overlap_beyond
from tests.support.searches import search_on

# The default dance first touches here [m of head travel].
CONTACT = 412.4738376822


def test_a_certain_contact_is_found_beyond_the_place_where_a_search_gave_up():
    search = search_on(Dragon(30), Spiral())
    found = overlap_beyond(Stretch(search, (CONTACT - 5e-3, CONTACT + 1.0), 1.0))
    assert CONTACT <= found.touching <= CONTACT + 1.0
    assert overlap_beyond(Stretch(search, (400.0, 401.0), 1.0)) is None
