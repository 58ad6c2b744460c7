"""A sweep as one call in Python."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import core
from app.sweeps import Range, Samples, sweep
from core import InvalidValue
from tests.support.odd_questions import LAND


def test_a_call_answers_and_the_same_call_goes_on(tmp_path: Path) -> None:
    pitches = np.linspace(0.5, 0.6, 5)
    result = sweep("collision_time", {"pitch": pitches}, tmp_path / "a", request={"benches": 40})
    frame = result.to_dataframe(["pitch", "time", "outcome"])
    for pitch, time in zip(frame["pitch"], frame["time"], strict=True):
        assert time == core.first_contact(core.Dance(core.Dragon(40), core.Spiral(pitch))).time
    assert list(frame["pitch"]) == pitches.tolist()
    again = sweep("collision_time", {"pitch": pitches}, tmp_path / "a", request={"benches": 40})
    assert again.table().equals(result.table())


def test_ranges_and_samples_are_given_as_such(tmp_path: Path) -> None:
    over = {"x": Range(start=1.0, stop=2.0), "y": Range(start=1.0, stop=4.0, count=4)}
    frame = sweep(LAND, over, tmp_path / "a", samples=Samples(count=8, sequence="philox")).to_dataframe()
    assert len(frame) == 32
    assert (frame["height"] == frame["x"] * frame["y"]).all()


def test_an_unknown_question_is_refused(tmp_path: Path) -> None:
    with pytest.raises(InvalidValue, match="question must be one of collision_time"):
        sweep("collision", {"pitch": [0.5]}, tmp_path)
    assert list(tmp_path.iterdir()) == []
