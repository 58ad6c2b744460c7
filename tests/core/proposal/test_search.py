"""The search: moves never make a rating worse, figures take turns, and what fails is kept for the reason."""

from dataclasses import replace
from itertools import islice, pairwise

import pytest

from core import Budget, Dragon, Figure, Objective, Venue
from core.proposal.search import SAME, Wish, search_in
from tests.support.random_squares import box

HALL = Venue(box("hall", 0, 0, 26, 22), (box("tree", 8, 9, 1, 1),))


def search(objective=Objective.TOLERANCE):
    return search_in(HALL, Dragon(8), (), Wish(0.05, 0.0, None, objective), Budget())


@pytest.mark.parametrize("figure", [Figure.RING, Figure.SPIRAL])
def test_candidates_are_ranked_by_their_value_and_moves_never_make_one_worse(figure):
    there = search(Objective.DURATION)
    ranked = there.ranked(figure)
    values = [there.value(one.rating) for one in ranked]
    assert all(a >= b - SAME for a, b in pairwise(values))
    assert there.value(there.improved(ranked[0]).rating) >= values[0]
    assert there.spent.tried > 8


def test_every_figure_comes_once_before_any_comes_twice_and_progress_is_the_share_of_the_figures():
    shares = []
    proposals = search().proposals([Figure.RING, Figure.SERPENTINE], 3, shares.append)
    figures = [one.figure for one in islice(proposals, 3)]
    assert figures == [Figure.RING, Figure.SERPENTINE, Figure.RING]
    assert shares == [0.25, 0.5, 0.75, 1.0]


def test_a_dance_that_fails_is_kept_with_its_report():
    there = search()
    ranked = there.ranked(Figure.RING)
    strict = replace(there, wish=Wish(0.05, 2.0, None, Objective.TOLERANCE))
    assert strict.passing(ranked[-1]) is None
    assert strict.failed.nearest[1].failures
    assert strict.spent.checked == 1
