"""Search: single pairs and marches; the bottoms of dips: test_clearance.py."""

import pytest

from core import Dragon, Spiral
from core.contact.search import joined
from core.kernels import Ended
from core.kernels.results import Dip, Marched
from tests.support.near import assert_near
from tests.support.searches import search_on

# The default dance first touches here, benches 0 and 8, and would have grazed with 0 and 11 before [m of head travel].
CONTACT = 412.4738376822
PAIR = (0, 8)
GRAZING = (0, 11)


@pytest.fixture
def search():
    return search_on(Dragon(30), Spiral())


def test_all_pairs_but_the_touching_one_are_clear_and_it_is_followed_again_afterwards(search):
    stop = CONTACT + 1e-3
    assert not search.others_clear(GRAZING, 400.0, stop)
    assert search.others_clear(PAIR, 400.0, stop)
    result = search.march(stop, 1e-10, start=400.0)
    assert (result.ended, result.pair, result.graze.pair) == (Ended.TOUCHED, PAIR, GRAZING)
    assert_near(result.touching, CONTACT, 1e-9)
    assert search.surely_within(CONTACT + 1e-9, PAIR)
    assert not search.surely_within(CONTACT - 1e-9, PAIR)


def test_a_march_that_goes_on_adds_its_steps_and_keeps_the_larger_bound_and_the_lower_graze():
    earlier = Marched(Ended.REACHED, 3.0, None, (0, 0), 1e-9, 5, 50.0, 0.25, Dip(0.02, 2.0, (0, 9)))
    later = Marched(Ended.TOUCHED, 2.5, 4.0, (0, 8), 1e-10, 2, 25.0, 0.125, Dip(0.03, 3.5, (1, 9)))
    assert joined(earlier, later) == Marched(Ended.TOUCHED, 3.0, 4.0, (0, 8), 1e-10, 7, 75.0, 0.25, earlier.graze)
    assert joined(earlier, later._replace(gap_curvature=0.5)).gap_curvature == 0.5
    assert (
        joined(earlier, Marched(Ended.REACHED, 6.0)).graze
        == joined(Marched(Ended.REACHED, 1.0), earlier).graze
        == earlier.graze
    )
