"""A sweep as one call in Python."""

import numpy as np

import core
from app.sweeps import Range, Samples, sweep
from tests.support.odd_questions import LAND
from tests.support.refused import refused


def test_a_call_answers_and_the_same_call_goes_on(tmp_path):
    over = {"pitch": np.linspace(0.5, 0.6, 5)}
    request = {"benches": 40}
    result, again = (sweep("collision_time", over, tmp_path / "a", request=request) for _ in range(2))
    dances = [core.Dance(core.Dragon(40), core.Spiral(pitch)) for pitch in over["pitch"]]
    assert list(result.to_dataframe(["time"])["time"]) == [core.first_contact(dance).time for dance in dances]
    assert again.table().equals(result.table())


def test_ranges_and_samples_are_given_as_such(tmp_path):
    over = {"x": Range(start=1.0, stop=2.0), "y": Range(start=1.0, stop=4.0, count=4)}
    assert len(sweep(LAND, over, tmp_path / "a", samples=Samples(count=8)).to_dataframe()) == 32


def test_an_unknown_question_is_refused_and_makes_no_folder(tmp_path):
    with refused("question"):
        sweep("collision", {"pitch": [0.5]}, tmp_path)
    assert list(tmp_path.iterdir()) == []
