"""The curve of tolerance against pitch: each of its points, its rise, and what is refused."""

import numpy as np
import pytest

from core import Budget, Dance, Dragon, Spiral, TooMuchWork, minimum_pitch, tolerance, tolerance_curve
from core.tolerance.curve import time_on_circle
from tests.support.near import assert_near

DRAGON = Dragon(benches=30)


def test_the_tolerance_rises_with_the_pitch_and_is_the_inverse_of_the_minimum_pitch():
    strays = [0.01, 0.03]
    pitches = [minimum_pitch(DRAGON, start_turns=10.0, stray=stray).pitch for stray in strays]
    curve = tolerance_curve(DRAGON, pitches, start_turns=10.0)
    assert (np.diff(curve.stray) > 0.0).all()
    assert curve.stray == pytest.approx(strays, rel=1e-3)
    dances = [Dance(DRAGON, Spiral(pitch, 10.0)) for pitch in pitches]
    assert [tolerance(dance, stop=time_on_circle(dance, 4.5)).stray for dance in dances] == curve.stray.tolist()
    assert set(curve.to_dataframe()["limited_by"]) == {"benches"}


def test_the_head_is_on_the_circle_at_that_time():
    dance = Dance(DRAGON, Spiral(0.6, 10.0), head_speed=2.0)
    assert_near(dance.path.head(2.0 * time_on_circle(dance, 4.0)).radius, 4.0, 1e-12)


def test_pitches_that_are_too_many_for_the_budget_are_reported_with_how_many_were_answered():
    budget = Budget()

    def stop(share):
        budget.stop("in the time given")

    with pytest.raises(TooMuchWork, match=r"pitches must be fewer, got 3: .* for only 1 "):
        tolerance_curve(Dragon(6), [0.5, 0.6, 0.7], progress=stop, budget=budget)
