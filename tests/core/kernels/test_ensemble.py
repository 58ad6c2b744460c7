"""The benches of several dragons in one frame: their places, and bounds on their motion and on their gaps in time."""

import math

import numpy as np
import pytest

from core import Arc, Dance, Dragon, Part, Passage, Performance, Route, Spiral, bench_poses, trajectory
from core.contact.stage import Stage, clear_of_each_other
from core.kernels import spirals_least
from core.kernels.constants import CENTRE_PULL, CENTRE_SPEED, FREE, OMEGA
from tests.support.searches import search_on
from tests.support.slow_performance import SlowPerformance

# Instants within a step at which gaps and motions are measured [1], and what a difference quotient may miss [1].
INSTANTS = 41
QUOTIENT = 1e-4
PARTS = [
    Part(Dance(Dragon(12), Spiral(1.1, 5.0, (3.0, -2.0), 0.4), 1.2), 2.0),
    Part(Dance(Dragon(9, 3.0, 2.0), Spiral(1.1, 5.2, (3.0, -2.0), 3.1)), 1.0),
    Part(Dance(Dragon(7), Spiral(0.9, 4.0, (-5.0, 4.0), 1.0, clockwise=False), 0.7)),
    Part(Dance(Dragon(5), Route([Arc((3.0, -1.0), 9.0, 0.3, 5.0)]), 1.5, [Passage(0.8, until_time=30.0)]), -1.0),
]
STEPS = [(20.0, 20.6), (24.0, 24.05), (27.3, 28.5)]


def staged(begin, until):
    """The stage with everyone laid out at both ends of a step, and its bounds."""
    stage = Stage(Performance(PARTS), (10.0, 40.0), 0.0)
    assert stage.step(begin, until, stage.enter(begin, until))
    return stage


def poses(*times):
    """Poses (T, n, 3) of all benches, by the trajectory of each dance."""
    placed = [bench_poses(trajectory(part.dance, [part.own_time(time) for time in times]).position) for part in PARTS]
    return np.concatenate(placed, axis=1)


def rows_of(stage):
    """The row of each bench; the last handle of a dragon has one too."""
    return np.concatenate([np.arange(one.first, one.first + one.benches) for one in stage.players])


@pytest.mark.parametrize("begin, until", STEPS)
def test_the_motion_in_time_and_the_gaps_of_two_dragons_stay_within_their_bounds(begin, until):
    stage = staged(begin, until)
    times = np.linspace(begin, until, INSTANTS)
    step = (until - begin) / (INSTANTS - 1)
    x, y, heading = np.moveaxis(poses(*times.tolist()), -1, 0)
    speed = np.abs(np.diff(x + 1j * y, axis=0)).max(axis=0) / step
    turn = np.abs(np.diff(np.unwrap(heading, axis=0), axis=0)).max(axis=0) / step
    pull = np.abs(np.diff(x + 1j * y, 2, axis=0)).max(axis=0) / step**2
    bounds = stage.motion[rows_of(stage)].T
    assert (speed <= bounds[CENTRE_SPEED] * (1.0 + QUOTIENT)).all()
    assert (turn <= bounds[OMEGA] * (1.0 + QUOTIENT) + QUOTIENT).all()
    assert (pull <= bounds[CENTRE_PULL] * (1.0 + QUOTIENT) + QUOTIENT).all()
    assert (speed >= 0.5 * bounds[CENTRE_SPEED]).all()  # and the bounds are near
    least = stage.ensemble.least
    assert least < FREE  # some were near enough to be tried
    assert SlowPerformance(PARTS).clearance(times)[0].min() >= least


@pytest.mark.parametrize("count, pitch", [(2, 1.1), (3, 1.6), (2, 1.3)])
def test_further_out_in_one_spiral_no_gap_falls_below_the_ring_bound(count, pitch):
    angle = 2.0 * math.pi / count
    dragon = Dragon(60)
    rings = search_on(dragon, Spiral(pitch), copies=count).rings
    parts = [Part(Dance(dragon, Spiral(pitch, 9.0, rotation=angle * k), 1.0 + 0.1 * k)) for k in range(count)]
    growth = pitch / (2.0 * math.pi)
    stage = Stage(Performance(parts), (0.0, 30.0), 0.0)
    for time in np.linspace(0.0, 30.0, 7).tolist():
        stage.enter(time, 30.0)
        radius = min(float(part.dance.path.head(part.dance.clock.travel(time)).radius) for part in parts)
        assert stage.nearest()[0] >= spirals_least(growth, angle, radius, rings) > 0.0
    clear = clear_of_each_other(growth, angle, (dragon, dragon), 0.05)
    assert clear is not None
    assert 0.05 < spirals_least(growth, angle, clear, rings) < 0.052
    assert clear_of_each_other(growth, angle, (dragon, dragon), 2.0) is None
