"""The result of a march, and of two marches one after the other."""

from __future__ import annotations

from core.kernels.results import Dip, Marched

EARLIER = Marched(3.0, None, (0, 0), 5, 0.25, Dip(0.02, 2.0, (0, 9)))


def test_a_march_that_goes_on_adds_its_steps_and_keeps_the_larger_bound_and_the_lower_graze() -> None:
    later = Marched(2.5, 4.0, (0, 8), 2, 0.125, Dip(0.03, 3.5, (1, 9)))
    assert EARLIER.followed_by(later) == Marched(3.0, 4.0, (0, 8), 7, 0.25, Dip(0.02, 2.0, (0, 9)))
    assert EARLIER.followed_by(later._replace(bend=0.5)).bend == 0.5


def test_a_march_without_a_graze_leaves_that_of_the_other() -> None:
    assert EARLIER.followed_by(Marched(6.0)).graze == EARLIER.graze
    assert Marched(1.0).followed_by(EARLIER).graze == EARLIER.graze
    assert Marched(1.0).followed_by(Marched(2.0)) == Marched(2.0)
