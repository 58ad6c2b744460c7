"""Wobbling dragons as they are laid out: joints and chords, how alike people stand, and what safe strays promise."""

from __future__ import annotations

import numpy as np
import pytest

from core import Dance, Dragon, Spiral, bench_poses, kernels, overlaps, separation, trajectory
from core.shapes.reach import gains
from core.values import Floats

DRAGON = Dragon.of([3.4, 2.2, 2.0, 2.2, 2.4] * 4, [0.3] * 20, [0.275] * 20)
NOMINAL = trajectory(Dance(DRAGON, Spiral()), np.arange(280.0, 300.0))
PLACES, TANGENTS = NOMINAL.position, NOMINAL.velocity / NOMINAL.speed[..., None]
NO_PLAY, NOT_SAFE = np.zeros((20, 4)), np.zeros((20, 20))
ALONG, MEMORY, MOST = 0.7, 0.9, 0.4


def wobbler(size: float, along: float = ALONG) -> kernels.Wobbler:
    sizes = np.zeros((DRAGON.benches + 1, kernels.SIZE_COLUMNS))
    half = 0.5 * np.stack([DRAGON.lengths, DRAGON.widths, np.hypot(DRAGON.lengths, DRAGON.widths)], axis=1)
    sizes[:-1] = np.concatenate([DRAGON.chords[:, None], half], axis=1)
    chain, boxes = np.zeros((len(sizes), kernels.UY + 1)), np.zeros((len(sizes), kernels.BOX_COLUMNS))
    made = kernels.Wobbler(sizes, kernels.Budget(1e9), chain, boxes, *np.zeros((2, len(sizes)), dtype=np.int8))
    made.lateral, made.forward, made.along = size, 0.5 * size, along
    return made


def holes(chain: Floats) -> tuple[Floats, Floats]:
    """Front and rear holes (n, 2) of the benches as laid out [m]."""
    half = 0.5 * DRAGON.chords[:, None] * chain[:-1, kernels.UX : kernels.UY + 1]
    middle = chain[:-1, kernels.MX : kernels.MY + 1]
    return middle + half, middle - half


def test_chords_and_joints_are_kept_and_each_rear_hole_is_where_its_person_wants_it_as_nearly_as_can_be() -> None:
    rng = np.random.default_rng(3)
    made, state = wobbler(0.02), np.zeros((21, 2))
    play = rng.uniform(-0.004, 0.004, (20, 4))
    numbers = rng.standard_normal((1, 21, 2))
    made.dance(np.zeros(1), numbers, play, PLACES[:1], TANGENTS[:1], NOT_SAFE[:1], state)
    left = np.stack([-TANGENTS[0, :, 1], TANGENTS[0, :, 0]], axis=-1)
    wanted = PLACES[0] + 0.02 * state[:, :1] * left + 0.01 * state[:, 1:] * TANGENTS[0]
    front, rear = holes(made.chain)
    assert np.hypot(*(front - rear).T) == pytest.approx(DRAGON.chords, abs=1e-12)
    pins = np.concatenate([wanted[:1], rear - play[:, 2:]])
    assert front == pytest.approx(pins[:-1] + play[:, :2], abs=1e-12)
    way = wanted[1:] + play[:, 2:] - front
    assert rear == pytest.approx(front + way * (DRAGON.chords / np.hypot(*way.T))[:, None], abs=1e-12)
    strays = np.hypot(*np.concatenate([front - PLACES[0, :-1], rear - PLACES[0, 1:]]).T)
    assert made.furthest == pytest.approx(strays.max(), abs=1e-12)


def test_people_stand_alike_as_their_correlations_say() -> None:
    rng = np.random.default_rng(4)
    made, stood = wobbler(0.0), []
    memory = np.array([0.0, MEMORY, MEMORY])
    for _ in range(4_000):
        state, at = np.zeros((21, 2)), []
        for t in range(3):
            made.dance(memory[t : t + 1], rng.standard_normal((1, 21, 2)), NO_PLAY, PLACES, TANGENTS, NOT_SAFE, state)
            at.append(state.copy())
        stood.append(at)
    samples = np.array(stood)  # (samples, instants, people, 2)
    spread = 5.0 / np.sqrt(len(samples))  # five standard deviations of a correlation near 0, more of one near 1
    for instants, people in [(0, 0), (0, 1), (0, 3), (1, 0), (2, 0), (1, 1), (2, 2)]:
        alike = (samples[:, 0, 5] * samples[:, instants, 5 + people]).mean(axis=0)
        assert alike == pytest.approx(ALONG**people * MEMORY**instants, abs=2.0 * spread)
    assert abs((samples[:, 0, 5, 0] * samples[:, 0, 5, 1]).mean()) < spread


def test_a_safe_stray_is_what_a_bench_and_its_nearest_have_between_them() -> None:
    made, safe, gain = wobbler(0.05), np.empty((20, 20)), gains(DRAGON)
    made.measure(MOST, gain, PLACES, safe)
    a, b = np.triu_indices(DRAGON.benches, 2)
    sizes = np.stack([DRAGON.lengths, DRAGON.widths], axis=1)
    for t in (0, 19):
        poses = bench_poses(PLACES[t])
        between = separation(poses[a], sizes[a], poses[b], sizes[b]).separation / (gain[a] + gain[b])
        least = [min(MOST, between[(a == k) | (b == k)].min()) for k in range(DRAGON.benches)]
        assert safe[t] == pytest.approx(np.array(least), abs=2e-9)


def test_the_first_overlap_is_found_and_safe_strays_change_nothing() -> None:
    rng = np.random.default_rng(5)
    made, safe, clear = wobbler(0.06), np.empty((20, 20)), []
    made.measure(MOST, gains(DRAGON), PLACES, safe)
    for _ in range(40):
        numbers, answers = rng.standard_normal((20, 21, 2)), []
        for stray in (safe, NOT_SAFE):
            memory, state = np.full(20, MEMORY), np.zeros((21, 2))
            instants = made.dance(memory, numbers, NO_PLAY, PLACES, TANGENTS, stray, state)
            answers.append((instants, (made.first, made.second) if instants < 20 else None))
        assert answers[0] == answers[1]
        instants, pair = answers[0]
        # again up to the instant before, and one further
        state, before = np.zeros((21, 2)), min(instants, 19)
        for last in (before, before + 1):
            rows = slice(0 if last == before else before, last)
            part = [numbers[rows], NO_PLAY, PLACES[rows], TANGENTS[rows], safe[rows], state]
            made.dance(np.full(last - rows.start, MEMORY), *part)
            if last:
                result = overlapping(made.chain)
                assert (pair in result) if last == instants + 1 else not result
        clear.append(instants)
    assert 5 < sum(instants == 20 for instants in clear) < 35


def overlapping(chain: Floats) -> set[tuple[int, ...]]:
    """The pairs that overlap as the benches are laid out, from overlaps()."""
    front, rear = holes(chain)
    poses = np.concatenate([bench_poses(np.stack([one, other])) for one, other in zip(front, rear, strict=True)])
    return {tuple(pair) for pair in overlaps(poses, DRAGON.lengths, DRAGON.widths).pairs.tolist()}
