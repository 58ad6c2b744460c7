"""Positions on spirals and coils of up to 100,000 turns, against 50 digits."""

import flint
import numpy as np
import pytest
from flint import acb, arb

from core import Coil, Dance, Dragon, Line, Route, Spiral, trajectory
from tests.support.exact_chain import BITS, coil_handles
from tests.support.near import assert_near

# Of 10,000 turns a double knows the length to 1e-8 m and the angle to 4e-12 rad.
DRAGON = Dragon(12, head_length=2.5)
# Largest error of a position, in parts of what trajectory() states, and of a chord 30 km from the centre [m].
SMALL = 0.01
CHORD_ERROR = 2e-11


def assert_exact(places, exact):
    """No point is further from its exact place than a small part of what trajectory() states."""
    for place, there in zip(places, exact, strict=True):
        off = float(abs(acb(*place.tolist()) - there))
        assert off < SMALL * max(1e-11, 1e-12 * float(abs(there)))


@pytest.mark.parametrize("speed", [1.0, 1.3])
@pytest.mark.parametrize("pitch, turns", [(0.55, 16.0), (0.55, 1e3), (0.3, 1e4), (3.0, 1e4), (0.55, 1e5)])
def test_positions_on_long_spirals_are_as_good_as_stated(pitch, turns, speed):
    flint.ctx.prec = BITS  # also for the product of time and speed
    dance = Dance(DRAGON, Spiral(pitch, turns), speed)
    times = [*(dance.end.time * np.array([-0.1, 0.0, 0.3, 0.9, 0.999])).tolist(), dance.end.time - 20.0]
    for time, places in zip(times, trajectory(dance, times).position, strict=True):
        exact = coil_handles(pitch, turns, arb(time) * speed, DRAGON.chords)
        assert_exact(places, exact)


@pytest.mark.parametrize("rotation", [0.0, 2.0])
@pytest.mark.parametrize(
    "begin, end, start",
    [(1e4, 1.0, 0.0), (1e4, 1.0, 9.4e8), (1.0, 1e4, 0.0)],
    ids=["inwards, s from afar", "inwards, s from near the centre", "outwards"],
)
def test_positions_on_long_coils_are_as_good_as_stated(begin, end, rotation, start):
    path = Route([Coil(3.0, begin, end, rotation=rotation)], start=start)
    dance = Dance(DRAGON, path)
    for share in (0.0, 1e-6, 0.3, 0.9, 0.999999, 1.0):
        s = min(max(path.begin + share * (path.end - path.begin), dance.earliest + 1e-6), path.end)
        turns = begin if begin > end else -begin
        exact = coil_handles(3.0, turns, arb(s) + path.start, DRAGON.chords, rotation)
        assert_exact(trajectory(dance, s).position, exact)


def test_handles_cross_the_end_of_a_long_coil_as_well_as_they_do_elsewhere():
    """A line behind 10,000 turns, where s is 1e8 m: the joint closes and chords keep their lengths."""
    last = Route([Coil(0.4, 4.0, 3.0)])
    end = last.position(last.end)
    ahead = last.tangent(last.end)
    path = Route([Coil(0.4, 1e4, 3.0), Line(tuple(end), tuple(end + 40.0 * ahead))])
    places = trajectory(Dance(DRAGON, path), path.end - np.array([35.0, 22.0, 10.0, 1.0])).position
    for handles in places:
        assert_near(np.linalg.norm(np.diff(handles, axis=0), axis=-1), DRAGON.chords, CHORD_ERROR)
