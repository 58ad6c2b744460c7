"""The search: moves never make a rating worse, figures take turns, and what fails is kept for the reason."""

from __future__ import annotations

import itertools

import pytest

from core import Budget, Dragon, Figure, Objective, Venue
from core.kernels import Halted
from core.proposal.search import SAME, Search, Wish
from tests.support.random_squares import box

HALL = Venue(box("hall", 0, 0, 26, 22), (box("tree", 8, 9, 1, 1),))


def search(benches: int = 8, **wish: object) -> Search:
    values = {"stray": 0.05, "margin": 0.0, "speed_limit": None, "objective": Objective.TOLERANCE, **wish}
    return Search(HALL, Dragon(benches), (), Wish(**values), Budget())  # type: ignore[arg-type]


@pytest.mark.parametrize("figure", [Figure.RING, Figure.SPIRAL])
def test_moves_never_make_a_rating_worse(figure: Figure) -> None:
    there = search()
    first = there.ranked(figure)[0]
    better = there.improved(first)
    assert there.value(better.rating) >= there.value(first.rating)
    assert there.tried > 8


def test_candidates_are_ranked_by_their_value() -> None:
    there = search(objective=Objective.DURATION)
    values = [there.value(one.rating) for one in there.ranked(Figure.RING)]
    assert all(a >= b - SAME for a, b in itertools.pairwise(values))


def test_every_figure_comes_once_before_any_comes_twice() -> None:
    proposals = search().proposals([Figure.RING, Figure.SERPENTINE], 3)
    assert [next(proposals).figure for _ in range(3)] == [Figure.RING, Figure.SERPENTINE, Figure.RING]


def test_a_dance_that_fails_is_kept_with_its_report() -> None:
    there = search(margin=0.0)
    ranked = there.ranked(Figure.RING)
    there.wish = Wish(0.05, 2.0, None, Objective.TOLERANCE)
    assert there.passing(ranked[-1]) is None
    assert there.nearest is not None
    assert there.nearest[1].failures
    assert there.checked == 1


def test_a_spent_budget_ends_the_search() -> None:
    there = Search(HALL, Dragon(8), (), Wish(0.05, 0.0, None, Objective.TOLERANCE), Budget(10.0))
    with pytest.raises(Halted):
        there.ranked(Figure.RING)


def test_progress_is_the_share_of_the_figures_that_were_tried() -> None:
    shares: list[float] = []
    list(search().proposals([Figure.RING, Figure.SERPENTINE], 0, shares.append))
    assert shares == [0.25, 0.5, 0.75, 1.0]
