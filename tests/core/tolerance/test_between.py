"""Benches next but one: no pose within the bound touches, chords bend as the bound says, and a pose that does touch."""

from __future__ import annotations

import math

import numpy as np
import pytest

from core import Arc, Budget, Dance, Dragon, Line, Route, Spiral, bench_outlines, trajectory
from core.paths.following import follows
from core.tolerance.between import held_apart, sag_pulls, sags_of, smallest_circles, touching_pose
from core.tolerance.exhibit import exhibit
from core.values import Floats
from tests.support.depth import examples, some

CHORD_ERROR = 1e-12  # [m]
FAR = 9.0  # a stray above all that are found [m]


def hairpin(radius: float) -> Route:
    line, back = Line((0.0, 0.0), (40.0, 0.0)), Line((40.0, 2.0 * radius), (0.0, 2.0 * radius))
    return Route([line, Arc((40.0, radius), radius, -0.5 * math.pi, math.pi), back])


def held(dragon: Dragon, radius: float) -> float:
    return held_apart(Dance(dragon, hairpin(radius)), 0.0, FAR, Budget())


def strayed_threes(rng: np.random.Generator, chords: Floats, places: Floats, stray: float, count: int) -> list[Floats]:
    """Handles (N, 4, 2) of poses within the stray, many of them at its edge, for every three benches with chords (R, 3)
    and places (R, 4, 2); all in [m]."""
    seek, chords = places.mean(axis=1)[:, None, None], chords[:, None]
    entries: list[list[Floats]] = [[] for _ in places]
    moved = np.repeat(places[:, None], count, axis=1)
    for spread in (1.0, 1.0, 0.5, 0.3, 0.1):
        step = rng.normal(0.0, spread * stray, moved.shape)
        moved = moved + step + rng.uniform(0.0, 0.6, (*moved.shape[:2], 1, 1)) * (seek - moved)
        for _ in range(300):  # chords and discs, in turn
            for k in range(3):
                link = moved[..., k, :] - moved[..., k + 1, :]
                half = 0.5 * link * (chords[..., k] / np.hypot(link[..., 0], link[..., 1]) - 1.0)[..., None]
                moved[..., k, :] += half
                moved[..., k + 1, :] -= half
            off = moved - places[:, None]
            far = np.hypot(off[..., 0], off[..., 1])
            moved = places[:, None] + off * np.minimum(1.0, stray / np.maximum(far, 1e-9))[..., None]
        wrong = np.abs(np.linalg.norm(np.diff(moved, axis=2), axis=-1) - chords).max(axis=-1)
        for kept, poses, bad in zip(entries, moved, wrong, strict=True):
            kept.append(poses[bad < 1e-6])
    return [np.concatenate(kept) for kept in entries]


@pytest.mark.parametrize(
    ("radius", "dragon", "least"),
    [
        (2.2, Dragon(9), 0.5),
        pytest.param(1.5, Dragon(9, 2.2), 0.5, marks=pytest.mark.deep),
        pytest.param(6.0, Dragon(9, 1.2), 0.5, marks=pytest.mark.deep),
        (40.0, Dragon(9, 1.2, 1.2, 0.5), 0.1),
        (40.0, Dragon.of([1.3, 1.5, 1.2] * 3, [0.5, 0.4, 0.6] * 3, [0.28] * 9), 0.05),
    ],
    ids=["long head", "equal", "short head", "wide", "of three sizes"],
)
def test_no_pose_within_the_bound_touches(radius: float, dragon: Dragon, least: float) -> None:
    safe, rng = held(dragon, radius), np.random.default_rng(3)
    assert safe > least * dragon.chords.min()
    dance = Dance(dragon, hairpin(radius))
    cases = [(handles, k) for handles in trajectory(dance, [41.0, 42.5, 44.0]).position for k in (0, 1)]
    chords = np.array([dragon.chords[k : k + 3] for _, k in cases])
    places = np.array([handles[k : k + 4] for handles, k in cases])
    strayed = strayed_threes(rng, chords, places, 0.999 * safe, examples(120, 300))
    for (handles, k), poses in zip(cases, strayed, strict=True):
        rows = np.array([bench_outlines(dragon.leading(k + 3), np.concatenate([handles[:k], p])) for p in poses])
        assert not overlapping(rows[:, k], rows[:, k + 2]).any()
    assert sum(map(len, strayed)) > 1_000


def test_sags_are_those_of_the_handles() -> None:
    rng = np.random.default_rng(5)
    chords, joint_angles = rng.uniform(0.5, 3.0, (200, 3)), rng.uniform(-math.pi, math.pi, (200, 2))
    turned = np.exp(1j * joint_angles)
    front = chords[:, 1] + chords[:, 0] * turned[:, 0]
    handles = np.stack([front, chords[:, 1], 0.0 * front, -chords[:, 2] * turned[:, 1]], axis=1)
    along = np.concatenate([np.zeros((200, 1)), np.cumsum(chords, axis=1)], axis=1)
    for column, (i, j, k) in enumerate([(0, 1, 2), (1, 2, 3), (0, 1, 3), (0, 2, 3)]):
        part = (along[:, j] - along[:, i]) / (along[:, k] - along[:, i])
        sag = np.abs(handles[:, j] - (1.0 - part) * handles[:, i] - part * handles[:, k])
        assert sags_of(sag_pulls(chords), joint_angles)[:, column] == pytest.approx(sag, abs=1e-12)


def overlapping(a: Floats, b: Floats) -> Floats:
    """True for two rectangles (N, 4, 2) that overlap, so that no side of either separates them."""
    parted = np.zeros(len(a), dtype=bool)
    for sides in (a, b):
        for k in (0, 1):
            across = (sides[:, k + 1] - sides[:, k]) @ np.array([[0.0, 1.0], [-1.0, 0.0]])
            first, second = ((rows * across[:, None]).sum(axis=-1) for rows in (a, b))
            parted |= (first.max(axis=1) < second.min(axis=1)) | (second.max(axis=1) < first.min(axis=1))
    return ~parted


@pytest.mark.parametrize("radius", some([1.6, 2.0, 3.0, 10.0], 2))
def test_the_bound_is_not_above_what_a_pose_shows(radius: float) -> None:
    dragon = Dragon(9, 2.2)
    dance, safe = Dance(dragon, hairpin(radius)), held(dragon, radius)
    for time in np.linspace(40.0, 52.0, examples(3, 7)).tolist():
        handles = trajectory(dance, time).position
        pose = exhibit(dragon, handles, (1, 3), None, 0.0, safe, time)
        assert pose is not None
        assert pose.stray > safe
        chords = np.hypot(*np.diff(pose.handles, axis=0).T)
        assert np.abs(chords - dragon.chords).max() < CHORD_ERROR
        rows = bench_outlines(dragon, pose.handles)
        first, second = pose.benches  # of all threes in a row, those that fold with the least strays
        assert second == first + 2
        assert overlapping(rows[first][None], rows[second][None]).all()
        assert np.hypot(*(pose.handles - handles).T).max() == pose.stray
    assert safe > (0.7 if radius >= 3.0 else 0.5) * pose.stray


def test_a_pose_on_a_line_strays_little_more_than_must_be() -> None:
    """Another search (SLSQP from 30 starts, 2026-11-22) found 1.4326 m on a line, 1.0939 m on an arc of 1.45 m."""
    three = np.array([[1.65, 2.2, 0.3]] * 3)
    turn = 2.0 * math.asin(0.825 / 1.45)
    arc = 1.45 * np.array([[-math.sin(k * turn), 1.0 - math.cos(k * turn)] for k in range(4)])
    line = np.array([[-1.65 * k, 0.0] for k in range(4)])
    for places, least in ((line, 1.4326), (arc, 1.0939)):
        pose = touching_pose(three, places)
        assert pose is not None
        assert least - 1e-4 < np.hypot(*(pose - places).T).max() < 1.02 * least


def test_three_that_cannot_fold_onto_each_other_have_no_pose() -> None:
    three = np.array([[1.0, 1.0, 0.1], [9.0, 9.0, 0.1], [1.0, 1.0, 0.1]])
    assert touching_pose(three, np.array([[11.0, 0.0], [10.0, 0.0], [1.0, 0.0], [0.0, 0.0]])) is None


@pytest.mark.parametrize("radius", [1.44, 1.6, 2.5])
def test_two_chords_in_a_row_bend_by_no_more_than_two_half_arcs(radius: float) -> None:
    dragon = Dragon(12)
    dance = Dance(dragon, hairpin(radius))
    assert follows(dragon, dance.path)
    handles = trajectory(dance, np.linspace(dance.begin, dance.end.time, 4_000)).position
    along = np.diff(handles, axis=1) @ [1.0, 1j]
    joint_angles = np.abs(np.angle(along[:, 1:] / along[:, :-1]))
    leans = np.arcsin(dragon.chords / (2.0 * radius))
    most = leans[1:] + leans[:-1]
    assert (joint_angles.max(axis=0) <= most + 1e-9).all()
    assert (joint_angles.max(axis=0) > 0.85 * most).all()


def test_a_spiral_is_as_bent_as_where_its_head_ends() -> None:
    dragon, spiral = Dragon(30), Spiral(2.0)
    bounds = [
        held_apart(Dance(dragon, spiral), spiral.travel_to(radius), FAR, Budget()) for radius in (1.5, 2.0, 4.5, 9.0)
    ]
    assert bounds == sorted(bounds)
    assert 0.0 <= bounds[0] < bounds[-1] < 1.4326
    assert held_apart(Dance(dragon, spiral), spiral.length, FAR, Budget()) == 0.0


def test_dragons_of_too_many_sizes_get_no_bound() -> None:
    dragon = Dragon.of(np.linspace(2.0, 2.4, 200), [0.3] * 200, [0.2] * 200)
    assert held_apart(Dance(dragon, Spiral(3.0)), 1.0, FAR, Budget()) == 0.0


def test_the_smallest_circle_holds_all_four_and_three_or_two_on_its_edge() -> None:
    points = np.random.default_rng(0).normal(size=(500, 4, 2)) @ [1.0, 1j]
    radii, centres = smallest_circles(points)
    far = np.sort(np.abs(points - centres[:, None]), axis=1)
    assert np.abs(far[:, -1] - radii).max() < 1e-9
    assert np.abs(far[:, -2] - radii).max() < 1e-9
    opposite = np.abs(points[:, :, None] - points[:, None]).max(axis=(1, 2)) > 2.0 * radii * (1.0 - 1e-9)
    assert (opposite | (np.abs(far[:, -3] - radii) < 1e-9)).all()
