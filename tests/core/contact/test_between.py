"""Benches next but one: no pose within the bound touches, chords bend as the bound says, and a pose that does touch."""

import math

import numpy as np
import pytest

from core import Arc, Budget, Dance, Dragon, Line, Route, Spiral, bench_poses, sharpest_bend, trajectory
from core.contact.between import held_apart, sag_pulls, sags_of, touching_pose
from core.shapes.rectangles import corners
from tests.support.depth import examples
from tests.support.near import assert_near
from tests.support.scenes import lengths_and_widths
from tests.support.shown_poses import overlap
from tests.support.slow_search import in_plane

FAR = 9.0  # a stray above all that are found [m]


def on_hairpin(dragon, radius):
    """A dance out and back, and the bound for it."""
    line = Line((0.0, 0.0), (40.0, 0.0))
    back = Line((40.0, 2.0 * radius), (0.0, 2.0 * radius))
    dance = Dance(dragon, Route([line, Arc((40.0, radius), radius, -0.5 * math.pi, math.pi), back]))
    return dance, held_apart(dance, 0.0, FAR, Budget())


def strayed_threes(rng, chords, places, stray):
    """Handles (N, 4, 2) of poses of three benches within the stray, many of them at its edge; all in [m].

    places: (R, 4) nominal ones, as complex numbers
    """
    places, kept = np.repeat(places, examples(120, 300), axis=0), []
    seek = places.mean(axis=1, keepdims=True)
    moved = places
    for spread in (1.0, 1.0, 0.5, 0.3, 0.1):
        step = rng.normal(0.0, spread * stray, (*places.shape, 2)) @ [1.0, 1j]
        moved = moved + step + rng.uniform(0.0, 0.6, (len(places), 1)) * (seek - moved)
        for _ in range(300):  # chords and discs, in turn
            for k, chord in enumerate(chords.tolist()):
                link = moved[:, k] - moved[:, k + 1]
                half = 0.5 * link * (chord / abs(link) - 1.0)
                moved[:, k] += half
                moved[:, k + 1] -= half
            off = moved - places
            moved = places + off * np.minimum(1.0, stray / np.maximum(abs(off), 1e-9))
        wrong = abs(abs(np.diff(moved, axis=1)) - chords).max(axis=1)
        kept.append(moved[wrong < 1e-6])
    poses = np.concatenate(kept)
    return in_plane(poses)


@pytest.mark.parametrize(
    "radius, dragon, least",
    [
        (2.2, Dragon(9), 0.5),
        pytest.param(1.5, Dragon(9, 2.2), 0.5, marks=pytest.mark.deep),
        pytest.param(6.0, Dragon(9, 1.2), 0.5, marks=pytest.mark.deep),
        (40.0, Dragon(9, 1.2, 1.2, 0.5), 0.1),
        (40.0, Dragon.of([1.3, 1.5, 1.2] * 3, [0.5, 0.4, 0.6] * 3, [0.28] * 9), 0.05),
    ],
    ids=["long head", "equal", "short head", "wide", "of three sizes"],
)
def test_no_pose_within_the_bound_touches(radius, dragon, least):
    (dance, safe), rng, count = on_hairpin(dragon, radius), np.random.default_rng(3), 0
    assert safe > least * dragon.chords.min()
    places = trajectory(dance, [41.0, 42.5, 44.0]).position @ [1.0, 1j]
    for k in (0, 1):
        poses = strayed_threes(rng, dragon.chords[k : k + 3], places[:, k : k + 4], 0.999 * safe)
        sizes = lengths_and_widths(dragon)[k : k + 3]
        first, _, last = np.moveaxis(corners(bench_poses(poses), sizes), 1, 0)
        assert overlap(first, last).max() == 0.0
        count += len(poses)
    assert count > 1_000


def test_sags_are_those_of_the_handles():
    rng = np.random.default_rng(5)
    chords = rng.uniform(0.5, 3.0, (200, 3))
    joint_angles = rng.uniform(-math.pi, math.pi, (200, 2))
    steps = chords * np.exp(1j * np.insert(joint_angles, 1, 0.0, axis=1))
    handles, along = (np.insert(part.cumsum(axis=1), 0, 0.0, axis=1).T for part in (-steps, chords))
    sags = sags_of(sag_pulls(chords), joint_angles).T
    for sag, (i, j, k) in zip(sags, [(0, 1, 2), (1, 2, 3), (0, 1, 3), (0, 2, 3)], strict=True):
        line = handles[i] + (along[j] - along[i]) / (along[k] - along[i]) * (handles[k] - handles[i])
        assert_near(sag, abs(handles[j] - line), 1e-12)


def test_a_pose_on_a_line_strays_little_more_than_must_be():
    """Another search (SLSQP from 30 starts, 2026-11-22) found 1.4326 m on a line, 1.0939 m on an arc of 1.45 m."""
    three = np.array([[1.65, 2.2, 0.3]] * 3)
    turn = 2.0 * math.asin(0.825 / 1.45)
    for places, least in (
        (-1.65 * np.arange(4.0), 1.4326),
        (1.45j * (1.0 - np.exp(1j * turn * np.arange(4.0))), 1.0939),
    ):
        places = in_plane(places)
        assert least - 1e-4 < np.hypot(*(touching_pose(three, places) - places).T).max() < 1.02 * least


def test_three_that_cannot_fold_onto_each_other_have_no_pose():
    three = np.array([[1.0, 1.0, 0.1], [9.0, 9.0, 0.1], [1.0, 1.0, 0.1]])
    assert touching_pose(three, np.array([[11.0, 0.0], [10.0, 0.0], [1.0, 0.0], [0.0, 0.0]])) is None


@pytest.mark.parametrize("radius", [1.44, 1.6, 2.5])
def test_two_chords_in_a_row_bend_by_no_more_than_two_half_arcs(radius):
    dance, _ = on_hairpin(Dragon(12), radius)
    bend = sharpest_bend(dance, start=dance.begin)
    most = float(np.arcsin(dance.dragon.chords[:2] / (2.0 * radius)).sum())
    assert bend.benches == (0, 1)
    assert 0.85 * most < bend.angle <= most + 1e-9


def test_a_spiral_is_as_bent_as_where_its_head_ends():
    dance = Dance(Dragon(30), Spiral(2.0))
    ends = (0.0, 1.5, 2.0, 4.5, 9.0)
    bounds = [held_apart(dance, dance.path.travel_to(radius), FAR, Budget()) for radius in ends]
    assert bounds[0] == 0.0
    assert bounds == sorted(bounds)
    assert bounds[1] < bounds[-1] < 1.4326


def test_dragons_of_too_many_sizes_get_no_bound():
    dragon = Dragon.of(np.linspace(2.0, 2.4, 200), [0.3] * 200, [0.2] * 200)
    assert held_apart(Dance(dragon, Spiral(3.0)), 1.0, FAR, Budget()) == 0.0
