"""Positions on spirals and coils of up to 100,000 turns, against 50 digits."""

from __future__ import annotations

import math

import flint
import numpy as np
import pytest
from flint import arb

from core import Coil, Dance, Dragon, Line, Passage, Route, Spiral, trajectory
from tests.support.exact_chain import BITS, coil_handles

# Of 10,000 turns a double knows the length to 1e-8 m and the angle to 4e-12 rad.
DRAGON = Dragon(12, head_length=2.5)
# Largest error of a position, in parts of what trajectory() states, and of a chord 30 km from the centre [m].
SMALL, CHORD_ERROR = 0.01, 2e-11


def error_of(place: np.ndarray, exact: tuple[arb, arb]) -> float:
    """Distance of a point from its exact place, in parts of what trajectory() states."""
    x, y = (arb(float(number)) - other for number, other in zip(place, exact, strict=True))
    far = math.hypot(*map(float, exact))
    return math.hypot(float(x), float(y)) / max(1e-11, 1e-12 * far)


@pytest.mark.parametrize("speed", [1.0, 1.3])
@pytest.mark.parametrize(("pitch", "turns"), [(0.55, 16.0), (0.55, 1e3), (0.3, 1e4), (3.0, 1e4), (0.55, 1e5)])
def test_positions_on_long_spirals_are_as_good_as_stated(pitch: float, turns: float, speed: float) -> None:
    flint.ctx.prec = BITS  # also for the product of time and speed
    dance = Dance(DRAGON, Spiral(pitch, turns), speed)
    times = [*(dance.end.time * np.array([-0.1, 0.0, 0.3, 0.9, 0.999])).tolist(), dance.end.time - 20.0]
    for time, places in zip(times, trajectory(dance, times).position, strict=True):
        exact = coil_handles(pitch, turns, arb(time) * speed, DRAGON.chords)
        assert max(error_of(*both) for both in zip(places, exact, strict=True)) < SMALL
        head = dance.path.head(time * speed)
        if speed == 1.0:
            assert error_of(np.array([head.x, head.y]), exact[0]) < SMALL
            assert error_of(dance.path.position(time), exact[0]) < SMALL


@pytest.mark.parametrize("start", [0.0, 9.4e8], ids=["s from afar", "s from near the centre"])
@pytest.mark.parametrize("rotation", [0.0, 2.0])
@pytest.mark.parametrize(("begin", "end"), [(1e4, 1.0), (1.0, 1e4)], ids=["inwards", "outwards"])
def test_positions_on_long_coils_are_as_good_as_stated(begin: float, end: float, rotation: float, start: float) -> None:
    path = Route([Coil(3.0, begin, end, rotation=rotation)], start=start if begin > end else 0.0)
    dance = Dance(DRAGON, path)
    for share in (0.0, 1e-6, 0.3, 0.9, 0.999999, 1.0):
        s = max(path.begin + share * (path.end - path.begin), dance.earliest + 1e-6)
        s = min(s, path.end)
        places = trajectory(dance, [s]).position[0]
        turns = begin if begin > end else -begin
        exact = coil_handles(3.0, turns, arb(s) + path.start, DRAGON.chords, rotation)
        assert max(error_of(*both) for both in zip(places, exact, strict=True)) < SMALL


def test_handles_cross_the_end_of_a_long_coil_as_well_as_they_do_elsewhere() -> None:
    """A line behind 10,000 turns, where s is 1e8 m: the joint closes and chords keep their lengths."""
    last = Route([Coil(0.4, 4.0, 3.0)])
    end, ahead = last.position(last.end), last.tangent(last.end)
    path = Route([Coil(0.4, 1e4, 3.0), Line(tuple(end), tuple(end + 40.0 * ahead))])
    dance = Dance(DRAGON, path)
    for before in (35.0, 22.0, 10.0, 1.0):
        places = trajectory(dance, [path.end - before]).position[0]
        chords = np.linalg.norm(np.diff(places, axis=0), axis=-1)
        assert np.abs(chords - DRAGON.chords).max() < CHORD_ERROR


def test_a_pause_changes_no_place_on_a_long_spiral() -> None:
    """The places are those of the times, whose parts before and after the pause are exact."""
    spiral, passages = Spiral(0.3, 1e4), [Passage(0.7, until_time=1e8), Passage(0.0, until_time=1.1e8)]
    dance = Dance(DRAGON, spiral, 1.0, passages)
    time = 1.1e8 + (dance.end.time - 1.1e8) * 0.999
    way = arb(dance.clock.travels[1]) + (arb(time) - arb(1.1e8))
    exact = coil_handles(0.3, 1e4, way, DRAGON.chords)
    places = trajectory(dance, [time]).position[0]
    assert max(error_of(*both) for both in zip(places, exact, strict=True)) < SMALL
