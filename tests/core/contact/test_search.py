"""Search: single pairs and marches; the bottoms of dips: test_clearance.py."""

import pytest

from core import Dragon, Spiral
from core.contact.near_graze import others_clear
from core.contact.search import ContactSearch, joined
from core.kernels import Ended
from core.kernels.results import Dip, Marched
from tests.support.near import assert_near

# The default dance first touches here, benches 0 and 8, and would have grazed with 0 and 11 before [m of head travel].
CONTACT = 412.4738376822
PAIR = (0, 8)
GRAZING = (0, 11)


@pytest.fixture
def search():
    return ContactSearch(Dragon(30), Spiral(), 0.0)


def test_all_pairs_but_the_touching_one_are_clear_and_it_is_followed_again_afterwards(search):
    stop = CONTACT + 1e-3
    assert not others_clear(search, GRAZING, 400.0, stop)
    assert others_clear(search, PAIR, 400.0, stop)
    state, result = search.march(stop, 1e-10, start=400.0)
    assert (state, result.benches, result.graze.pair) == (Ended.TOUCHED, PAIR, GRAZING)
    assert_near(result.touching, CONTACT, 1e-9)
    assert search.surely_within(CONTACT + 1e-9, PAIR)
    assert not search.surely_within(CONTACT - 1e-9, PAIR)


def test_a_march_that_goes_on_adds_its_steps_and_keeps_the_larger_bound_and_the_lower_graze():
    earlier = Marched(3.0, None, (0, 0), 5, 0.25, Dip(0.02, 2.0, (0, 9)))
    later = Marched(2.5, 4.0, (0, 8), 2, 0.125, Dip(0.03, 3.5, (1, 9)))
    assert joined(earlier, later) == Marched(3.0, 4.0, (0, 8), 7, 0.25, earlier.graze)
    assert joined(earlier, later._replace(gap_curvature=0.5)).gap_curvature == 0.5
    assert joined(earlier, Marched(6.0)).graze == joined(Marched(1.0), earlier).graze == earlier.graze
