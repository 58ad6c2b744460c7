"""Beats: the head goes a step on each, every moment has its count, and what cannot be drummed is refused."""

import math

import numpy as np
import pytest

from core import Dance, Dragon, Spiral
from core.people.beats import Bars, Music
from tests.support.near import assert_near
from tests.support.refused import refused

pytestmark = pytest.mark.uncompiled

# Rounding of a place after some hundred steps [m], and of a time [s].
ROUNDING = 1e-11
STRETCHES = [Bars(3, 96.0, 0.6), Bars(2, 70.0, 0.0, beats=3), Bars(5, 133.0, 0.45, beats=2), Bars(1, 11.0, 3.0)]
MUSIC = Music(STRETCHES)


def every_beat():
    """Time [s], bar, beat and way of the head until then [m] of each beat, added up one after the other."""
    time = 0.0
    bar = 0
    way = 0.0
    for one in STRETCHES:
        for beat in range(one.bars * one.beats):
            bar += beat % one.beats == 0
            yield time, bar, beat % one.beats + 1, way
            time, way = time + 60.0 / one.tempo, way + one.step
    yield time, bar + 1, 1, way


*BEATS, END = every_beat()


def test_the_head_goes_one_step_on_each_beat():
    clock = Dance(Dragon(3), Spiral(), 1.0, MUSIC.passages).clock
    for time, _, _, way in [*BEATS, END, (END[0] + 2.0, 0, 0, END[3] + 2.0)]:
        assert_near(clock.travel(time), way, ROUNDING)


def test_every_moment_has_the_count_of_the_nearest_beat():
    times = np.array([time for time, *_ in [*BEATS, END]])
    for time in [*np.arange(0.0137, END[0], 0.11).tolist(), *times[:-1].tolist(), MUSIC.begins[-1]]:
        assert MUSIC.count(time) == [*BEATS, END][int(np.abs(times - time).argmin())][1:3]
    assert MUSIC.count(-1e-9) is MUSIC.count(MUSIC.begins[-1] + 1e-9) is None


@pytest.mark.parametrize("span", [(0.0, 1e3), (3.0, 12.0), (-5.0, 0.0), (20.0, 21.0), (1e3, 2e3)])
def test_beats_between_two_times_are_those_of_the_sum_and_bars_begin_with_the_first(span):
    times, first = MUSIC.beats(*span)
    inside = [(time, beat == 1) for time, _, beat, _ in BEATS if span[0] <= time <= span[1]]
    assert_near(times, [time for time, _ in inside], ROUNDING)
    assert first == [begins for _, begins in inside]


@pytest.mark.parametrize(
    "field, bars",
    [
        ("beats.0.tempo", [Bars(16, math.nan, 0.6)]),
        ("beats.0.bars", [Bars(0, 96.0, 0.6)]),
        ("beats.0.beats", [Bars(16, 96.0, 0.6, beats=17)]),
        ("beats", []),
    ],
)
def test_what_cannot_be_drummed_is_refused(field, bars):
    with refused(field):
        Music(bars)
