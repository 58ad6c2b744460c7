"""The least separation over an interval, with too few rows. Bounds: tests/core/contact/test_clearance.py."""

from core import Dragon, Spiral
from core.contact.search import ContactSearch
from core.kernels import Ended, March

# The default dance first touches here, benches 0 and 8 [m of head travel].
CONTACT = 412.4738376822


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
