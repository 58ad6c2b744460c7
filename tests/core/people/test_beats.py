"""Beats: the head goes a step on each, every moment has its count, and what cannot be drummed is refused."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from core import Dance, Dragon, InvalidValue, Spiral
from core.people.beats import Bars, Music

pytestmark = pytest.mark.uncompiled

# Rounding of a place after some hundred steps [m], and of a time [s].
ROUNDING = 1e-11
STRETCHES = [Bars(3, 96.0, 0.6), Bars(2, 70.0, 0.0, beats=3), Bars(5, 133.0, 0.45, beats=2), Bars(1, 11.0, 3.0)]


def every_beat() -> list[tuple[float, int, int, float]]:
    """Time [s], bar, beat and way of the head until then [m] of each beat, added up one after the other."""
    beats, time, bar, way = [], 0.0, 0, 0.0
    for one in STRETCHES:
        for _ in range(one.bars):
            bar += 1
            for beat in range(1, one.beats + 1):
                beats.append((time, bar, beat, way))
                time, way = time + 60.0 / one.tempo, way + one.step
    return [*beats, (time, bar + 1, 1, way)]


def test_the_head_goes_one_step_on_each_beat() -> None:
    music = Music(STRETCHES)
    dance = Dance(Dragon(3), Spiral(), 1.0, music.passages)
    for time, _, _, way in every_beat():
        assert dance.clock.travel(time) == pytest.approx(way, abs=ROUNDING)
    end, _, _, way = every_beat()[-1]
    assert dance.clock.travel(end + 2.0) == pytest.approx(way + 2.0, abs=ROUNDING)


def test_every_moment_has_the_count_of_the_nearest_beat() -> None:
    music, beats = Music(STRETCHES), every_beat()
    times = np.array([time for time, *_ in beats])
    for time in np.arange(0.0137, times[-1], 0.11):
        _, bar, beat, _ = beats[int(np.abs(times - time).argmin())]
        assert music.count(float(time)) == (bar, beat)
    for time, bar, beat, _ in beats:
        assert music.count(min(time, music.begins[-1])) == (bar, beat)
    assert music.count(-1e-9) is None
    assert music.count(music.begins[-1] + 1e-9) is None


def test_beats_between_two_times_are_those_of_the_sum_and_bars_begin_with_the_first() -> None:
    music, beats = Music(STRETCHES), every_beat()[:-1]
    for start, stop in ((0.0, 1e3), (3.0, 12.0), (-5.0, 0.0), (20.0, 21.0), (1e3, 2e3)):
        times, first = music.beats(start, stop)
        inside = [(time, beat == 1) for time, _, beat, _ in beats if start <= time <= stop]
        assert times == pytest.approx([time for time, _ in inside], abs=ROUNDING)
        assert first == [begins for _, begins in inside]


@pytest.mark.parametrize(
    ("bars", "words"),
    [
        (Bars(16, 0.0, 0.6), "beats[0].tempo must be positive, got 0 steps a minute"),
        (Bars(16, math.nan, 0.6), "beats[0].tempo must be a finite number"),
        (Bars(16, 500.0, 0.6), "beats[0].tempo must be at most 400 steps a minute, got 500"),
        (Bars(0, 96.0, 0.6), "beats[0].bars must be"),
        (Bars(1.5, 96.0, 0.6), "beats[0].bars must be a whole number, got 1.5"),  # type: ignore[arg-type]
        (Bars(16, 96.0, -0.6), "beats[0].step must be zero or more, got -0.6 m"),
        (Bars(16, 96.0, 0.001), "beats[0].step must be 0, to mark time, or at least 0.01 m, got 0.001 m"),
        (Bars(16, 96.0, 0.6, beats=17), "beats[0].beats must be at most 16, got 17"),
        (96.0, "beats[0] must be a Bars, got 96.0"),
    ],
    ids=["tempo 0", "no tempo", "tempo 500", "no bars", "half a bar", "back", "tiny", "17 beats", "a number"],
)
def test_what_cannot_be_drummed_is_refused_in_one_sentence(bars: Any, words: str) -> None:
    with pytest.raises(InvalidValue) as caught:
        Music([bars])
    assert str(caught.value).startswith(words)


def test_music_has_at_least_one_bar() -> None:
    with pytest.raises(InvalidValue, match=r"^beats must have from 1 to 1000 entries, got 0$"):
        Music([])
