"""The last stretch before a fold: the bound on the motion left against a slow search."""

import numpy as np
import pytest

from core import Dance, Dragon, EndReason, Outcome, Spiral, first_contact
from core.contact.fold import least_left, least_to_fold
from tests.support.depth import thorough
from tests.support.random_dances import random_dance
from tests.support.searches import search_on
from tests.support.slow_search import SlowDance

# Rounding of a slow clearance [m].
ROUNDING = 1e-9
# Dances apart to their fold, whose last 1e-9 s were left open: the motion left was that of the longest overhang on the
# shortest chord, whichever benches they belong to.
TO_THE_FOLD = {
    "long overhang in the body": (
        Dragon.of([0.37, 8.61, 0.19, 0.09, 8.71, 0.86, 13.09], [0.1, 0.04, 0.06, 0.09, 0.08, 0.06, 0.3],
                  [0.0, 0.09, 0.0, 0.02, 0.0, 0.0, 2.65]),
        Spiral(5.8, 0.9),
    ),
    "three benches": (Dragon.of([8.33, 2.04, 3.45], [0.03, 0.16, 0.17], [0.03, 1.0, 0.0]), Spiral(8.87, 2.95)),
    "30 micrometres apart": (
        Dragon.of([0.042, 0.044, 6.737], [0.083, 0.145, 0.019], [0.0, 0.0, 0.0]), Spiral(4.391, 1.607)
    ),
}  # fmt: skip


@pytest.mark.parametrize("dragon, spiral", TO_THE_FOLD.values(), ids=TO_THE_FOLD)
def test_the_last_instants_before_a_fold_are_decided(dragon, spiral):
    contact = first_contact(Dance(dragon, spiral))
    end = Dance(dragon, spiral).end
    assert contact.outcome == Outcome.CLEAR
    assert contact.end == end
    times = end.time * (1.0 - 1e-9 * np.linspace(1.0, 0.0, 40)[:-1] ** 2)
    assert SlowDance.of(dragon, spiral).clearance(times)[0].min() > 0.0


@pytest.mark.parametrize("seed", [*range(501, 507), *thorough(507, 508, 509, *range(523, 529))])
def test_no_instant_before_a_fold_has_benches_nearer_than_the_bound_on_the_motion_left(seed):
    dance, slow = random_dance(seed)
    end = dance.end
    assert end.reason is EndReason.FOLD
    search = search_on(dance.dragon, dance.path)
    for left in (1e-3, 1e-5, 1e-7):
        travel = (1.0 - left) * end.time
        least = least_to_fold(search, travel, end.theta)
        gaps, _ = slow.clearance(end.time * (1.0 - left * np.linspace(1.0, 1e-3, 60) ** 2))
        assert least <= gaps.min() + ROUNDING
        assert least_left(search, travel - search.travel_rounding(travel), end.theta) <= least
