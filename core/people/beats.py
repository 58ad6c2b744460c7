"""Beats: a drum gives the steps, and so the speed of the head and the count of every moment.

The music is a list of stretches of whole bars, each at one tempo; it begins at time 0. On each beat the head goes one
step, at a constant speed from beat to beat: speed = tempo step / 60. A step of 0 marks time: the drum goes on, and
nobody walks. After the last bar the dance goes on at its own speed, without a drum.

How each number is known: the beginning of a stretch and the time of a beat are sums of fractions, rounded once.
"""

from __future__ import annotations

import math
from bisect import bisect_right
from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import NamedTuple

import numpy as np

from core.checks import checked_count, checked_number, checked_type
from core.display import Readable
from core.errors import InvalidValue
from core.passages import PASSAGES_MAX, Passage
from core.quantities import Given, Quantity
from core.values import Floats

# Bars of a stretch, beats of a bar, tempo [beats/min] and step [m]: least and largest.
BARS, IN_BAR, TEMPO, STEP = (1, 10_000), (1, 16), (10.0, 400.0), (0.0, 3.0)
# Least step that is not 0 [m].
STEP_LEAST = 0.01


@dataclass(frozen=True, slots=True)
class Bars(Readable):
    """Bars at one tempo.

    bars: number of bars
    tempo: beats and steps a minute [beats/min]
    step: way of the head on each beat; 0: it marks time [m]
    beats: number of beats in a bar
    """

    bars: int
    tempo: float
    step: float
    beats: int = 4

    @property
    def speed(self) -> float:
        """Speed of the head [m/s]."""
        return float(Fraction(self.tempo) * Fraction(self.step) / 60)


class Count(NamedTuple):
    """A bar of the music and a beat in it, both from 1 on.

    >>> str(Count(17, 3))
    '17.3'
    """

    bar: int
    beat: int

    def __str__(self) -> str:
        return f"{self.bar}.{self.beat}"


class Music:
    """The beats of a dance. begins: times at which the stretches begin, and the last one ends [s]

    raises: InvalidValue, TooLarge

    >>> music = Music([Bars(2, 120.0, 0.5), Bars(4, 90.0, 0.0, beats=3)])
    >>> music.begins, music.passages[0].speed, str(music.count(5.4)), music.count(13.0)
    ([0.0, 4.0, 12.0], 1.0, '3.3', None)
    """

    def __init__(self, stretches: Sequence[Bars]) -> None:
        self.stretches = _checked(stretches)
        self._begins, self.bars = [Fraction(0)], [0]
        for one in self.stretches:
            self._begins.append(self._begins[-1] + Fraction(60 * one.bars * one.beats) / Fraction(one.tempo))
            self.bars.append(self.bars[-1] + one.bars)
        self.begins = [float(begin) for begin in self._begins]

    @property
    def passages(self) -> tuple[Passage, ...]:
        """The speeds of the head."""
        ends = zip(self.stretches, self.begins[1:], strict=True)
        return tuple(Passage(one.speed, until_time=end) for one, end in ends)

    def count(self, time: float) -> Count | None:
        """The beat nearest to a time [s]; None before the music and after it. Its end counts as the bar behind it."""
        k = min(bisect_right(self.begins, time), len(self.stretches)) - 1
        if k < 0 or time > self.begins[-1]:
            return None
        one = self.stretches[k]
        beat = math.floor((time - self.begins[k]) * one.tempo / 60.0 + 0.5)
        if beat >= one.bars * one.beats:
            return Count(self.bars[k + 1] + 1, 1)
        return Count(self.bars[k] + beat // one.beats + 1, beat % one.beats + 1)

    def beats(self, start: float, stop: float) -> tuple[Floats, list[bool]]:
        """Times of the beats from start to stop, (B,) [s], and which begin a bar; the end of the music is no beat."""
        times, first = list[float](), list[bool]()
        for k, one in enumerate(self.stretches):
            if self.begins[k + 1] <= start or self.begins[k] > stop:
                continue
            for beat in range(one.bars * one.beats):
                time = float(self._begins[k] + Fraction(60 * beat) / Fraction(one.tempo))
                if start <= time <= stop:
                    times.append(time)
                    first.append(beat % one.beats == 0)
        return np.array(times), first


def _checked(stretches: Sequence[Bars]) -> tuple[Bars, ...]:
    """The stretches, checked one by one. raises: InvalidValue"""
    checked_type("beats", stretches, (list, tuple))
    if not 1 <= len(stretches) <= PASSAGES_MAX:
        raise InvalidValue("beats", "must have from 1 to {most} entries", got=len(stretches), most=PASSAGES_MAX)
    return tuple(_checked_bars(f"beats.{k}", one) for k, one in enumerate(stretches))


def _checked_bars(name: str, one: Bars) -> Bars:
    if not isinstance(one, Bars):
        raise InvalidValue(name, "must be a Bars", got=Given(one))
    bars, beats = checked_count(f"{name}.bars", one.bars, *BARS), checked_count(f"{name}.beats", one.beats, *IN_BAR)
    tempo = checked_number(f"{name}.tempo", one.tempo, "steps a minute", *TEMPO)
    step = checked_number(f"{name}.step", one.step, "m", *STEP)
    if 0.0 < step < STEP_LEAST:
        rule, least = "must be 0, to mark time, or at least {least}", Quantity(STEP_LEAST, "m")
        raise InvalidValue(f"{name}.step", rule, got=Quantity(step, "m"), least=least)
    return Bars(bars, tempo, step, beats)
