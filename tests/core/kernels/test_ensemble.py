"""The benches of several dragons in one frame: their places, and bounds on their motion and on their gaps in time."""

from __future__ import annotations

import math

import numpy as np
import pytest

from core import Arc, Dance, Dragon, Part, Passage, Performance, Route, Spiral, bench_poses, kernels, trajectory
from core.kernels.constants import CENTRE_PULL, CENTRE_SPEED, MX, MY, OMEGA, UX, UY
from core.performance.stage import AFTER, BEFORE, PROBED, Stage, clear_of_each_other
from core.shapes.rectangles import frames, frames_separation

# Places of benches [m], and directions [1].
SAME_PLACE = 1e-11
# Instants within a step at which gaps and motions are measured [1], and what a difference quotient may miss [1].
INSTANTS, QUOTIENT = 41, 1e-4
PARTS = [
    Part(Dance(Dragon(12), Spiral(1.1, 5.0, (3.0, -2.0), 0.4), 1.2), 2.0),
    Part(Dance(Dragon(9, 3.0, 2.0), Spiral(1.1, 5.2, (3.0, -2.0), 3.1)), 1.0),
    Part(Dance(Dragon(7), Spiral(0.9, 4.0, (-5.0, 4.0), 1.0, clockwise=False), 0.7)),
    Part(Dance(Dragon(5), Route([Arc((3.0, -1.0), 9.0, 0.3, 5.0)]), 1.5, [Passage(0.8, until_time=30.0)]), -1.0),
]
STEPS = [(20.0, 20.6), (24.0, 24.05), (27.3, 28.5)]


def staged(begin: float, until: float) -> Stage:
    """The stage with everyone laid out at both ends of a step, and its bounds."""
    stage = Stage(Performance(PARTS), (10.0, 40.0), 0.0)
    assert stage.step(begin, until, stage.enter(begin, until))
    return stage


def poses(times: list[float]) -> np.ndarray:
    """Poses (T, n, 3) of all benches, row by row, by the trajectory of each dance."""
    columns = []
    for part in PARTS:
        placed = bench_poses(trajectory(part.dance, [part.own_time(time) for time in times]).position)
        columns += [placed, np.zeros((len(times), 1, 3))]  # a row for the last handle
    return np.concatenate(columns, axis=1)


def benches(stage: Stage) -> np.ndarray:
    return np.concatenate([np.arange(one.first, one.first + one.benches) for one in stage.players])


@pytest.mark.parametrize("which", [BEFORE, AFTER, PROBED])
def test_every_bench_stands_where_its_own_dance_puts_it(which: int) -> None:
    begin, until = STEPS[0]
    stage, time = staged(begin, until), {BEFORE: begin, AFTER: until, PROBED: 22.0}[which]
    for k in range(len(PARTS) if which == PROBED else 0):
        stage.stand(k, PROBED, time, 0.0)
    rows, known = stage.chains[which], poses([time])[0]
    own = benches(stage)
    np.testing.assert_allclose(rows[own][:, [MX, MY]], known[own, :2], rtol=0, atol=SAME_PLACE)
    directions = np.stack([np.cos(known[own, 2]), np.sin(known[own, 2])], axis=-1)
    np.testing.assert_allclose(rows[own][:, [UX, UY]], directions, rtol=0, atol=SAME_PLACE)


@pytest.mark.parametrize(("begin", "until"), STEPS)
def test_the_motion_in_time_stays_within_its_bounds(begin: float, until: float) -> None:
    stage = staged(begin, until)
    own, step = benches(stage), (until - begin) / (INSTANTS - 1)
    known = poses(np.linspace(begin, until, INSTANTS).tolist())[:, own]
    speed = np.linalg.norm(np.diff(known[..., :2], axis=0), axis=-1).max(axis=0) / step
    turn = np.abs(np.unwrap(known[..., 2], axis=0)[1:] - np.unwrap(known[..., 2], axis=0)[:-1]).max(axis=0) / step
    pull = np.linalg.norm(np.diff(known[..., :2], 2, axis=0), axis=-1).max(axis=0) / step**2
    bounds = stage.motion[own]
    assert (speed <= bounds[:, CENTRE_SPEED] * (1.0 + QUOTIENT)).all()
    assert (turn <= bounds[:, OMEGA] * (1.0 + QUOTIENT) + QUOTIENT).all()
    assert (pull <= bounds[:, CENTRE_PULL] * (1.0 + QUOTIENT) + QUOTIENT).all()
    assert (speed >= 0.5 * bounds[:, CENTRE_SPEED]).all()  # and the bounds are near


@pytest.mark.parametrize(("begin", "until"), STEPS)
def test_no_gap_of_two_dragons_falls_below_the_bound_of_a_step(begin: float, until: float) -> None:
    stage = staged(begin, until)
    own, owner = benches(stage), stage.owner
    sizes = np.concatenate([np.stack([part.dance.dragon.lengths, part.dance.dragon.widths], -1) for part in PARTS])
    frame = frames(poses(np.linspace(begin, until, INSTANTS).tolist())[:, own], sizes)
    a, b = np.triu_indices(len(own), 1)
    two = owner[own[a]] != owner[own[b]]
    gaps = frames_separation(frame[:, a[two]], frame[:, b[two]]).separation
    least = stage.ensemble.least
    assert least < kernels.FREE  # some were near enough to be tried
    assert gaps.min() >= least


def test_the_nearest_benches_are_those_of_all_pairs() -> None:
    stage = staged(*STEPS[0])
    gap, a, b = stage.nearest()
    own, owner = benches(stage), stage.owner
    sizes = np.concatenate([np.stack([part.dance.dragon.lengths, part.dance.dragon.widths], -1) for part in PARTS])
    frame = frames(poses([STEPS[0][0]])[:, own], sizes)[0]
    i, j = np.triu_indices(len(own), 1)
    two = owner[own[i]] != owner[own[j]]
    i, j = i[two], j[two]
    gaps = frames_separation(frame[i], frame[j]).separation
    k = int(gaps.argmin())
    assert gap == pytest.approx(gaps[k], rel=0, abs=SAME_PLACE)
    assert (a, b) == (int(own[i[k]]), int(own[j[k]]))
    assert stage.nearest(a, b) == (gap, a, b)


def test_a_rate_is_the_difference_quotient_of_the_gap() -> None:
    stage = staged(*STEPS[0])
    _, a, b = stage.nearest()
    ahead = 1e-5
    quotient = (stage.gap(20.0 + ahead, a, b) - stage.gap(20.0 - ahead, a, b)) / (2.0 * ahead)
    assert stage.gap_rate(20.0, a, b) == pytest.approx(quotient, rel=1e-5, abs=1e-8)


@pytest.mark.parametrize(("count", "pitch"), [(2, 1.1), (3, 1.6), (2, 1.3)])
def test_further_out_in_one_spiral_no_gap_falls_below_the_ring_bound(count: int, pitch: float) -> None:
    parts = [
        Part(Dance(Dragon(60), Spiral(pitch, 9.0, rotation=2.0 * math.pi * k / count), 1.0 + 0.1 * k))
        for k in range(count)
    ]
    growth, angle = pitch / (2.0 * math.pi), 2.0 * math.pi / count
    rings = kernels.Rings()
    dragon = parts[0].dance.dragon
    columns = (np.ascontiguousarray(getattr(dragon, name)) for name in ("chords", "overhangs", "widths", "lengths"))
    rings.measure(*columns, 1, 0)
    stage = Stage(Performance(parts), (0.0, 30.0), 0.0)
    for time in np.linspace(0.0, 30.0, 7).tolist():
        stage.enter(time, 30.0)
        radius = min(float(part.dance.path.head(part.dance.clock.travel(time)).radius) for part in parts)
        least = kernels.spirals_least(growth, angle, radius, rings)
        assert least > 0.0
        assert stage.nearest()[0] >= least
    clear = clear_of_each_other(growth, angle, (dragon, dragon), 0.05)
    assert clear is not None
    assert 0.05 < kernels.spirals_least(growth, angle, clear, rings) < 0.052
    assert clear_of_each_other(growth, angle, (dragon, dragon), 2.0) is None
