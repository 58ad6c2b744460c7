"""Wobbling dragons as they are laid out: joints and chords, how alike people stand, and what safe strays promise."""

import numpy as np
import pytest

from core import Dance, Dragon, Spiral, bench_poses, overlaps, separation, trajectory
from core.kernels import Budget, Wobbler
from core.kernels.constants import BOX_COLUMNS, MX, MY, UX, UY
from core.shapes.reach import gains
from tests.support.intervals import sizes_of

DRAGON = Dragon.of([3.4, 2.2, 2.0, 2.2, 2.4] * 4, [0.3] * 20, [0.275] * 20)
NOMINAL = trajectory(Dance(DRAGON, Spiral()), np.arange(280.0, 300.0))
PLACES, TANGENTS = NOMINAL.position, NOMINAL.velocity / NOMINAL.speed[..., None]
NO_PLAY, NOT_SAFE = np.zeros((20, 4)), np.zeros((20, 20))
ALONG, MEMORY, MOST = 0.7, 0.9, 0.4
ROUNDING = 1e-12  # [m]


def wobbler(size):
    chain, boxes, flags = np.zeros((21, UY + 1)), np.zeros((21, BOX_COLUMNS)), np.zeros((2, 21), dtype=np.int8)
    made = Wobbler(sizes_of(DRAGON), Budget(1e9), chain, boxes, *flags)
    made.lateral, made.forward, made.along = size, 0.5 * size, ALONG
    return made


def holes(chain):
    """Front and rear holes (2, n) of the benches as laid out [m]."""
    middle, along = (np.asarray(chain)[:-1, [x, y]] @ [1.0, 1.0j] for x, y in ((MX, MY), (UX, UY)))
    return middle + np.array([[0.5], [-0.5]]) * DRAGON.chords * along


def test_chords_and_joints_are_kept_and_each_rear_hole_is_where_its_person_wants_it_as_nearly_as_can_be():
    rng = np.random.default_rng(3)
    made, state = wobbler(0.02), np.zeros((21, 2))
    play = rng.uniform(-0.004, 0.004, (20, 4))
    made.dance(np.zeros(1), rng.standard_normal((1, 21, 2)), play, PLACES[:1], TANGENTS[:1], NOT_SAFE[:1], state)
    places, tangents = PLACES[0] @ [1.0, 1.0j], TANGENTS[0] @ [1.0, 1.0j]
    wanted = places + (0.02j * state[:, 0] + 0.01 * state[:, 1]) * tangents
    (front, rear), front_play, rear_play = holes(made.chain), play[:, :2] @ [1.0, 1.0j], play[:, 2:] @ [1.0, 1.0j]
    assert np.abs(front - rear) == pytest.approx(DRAGON.chords, abs=ROUNDING)
    pins = np.concatenate([wanted[:1], rear - rear_play])
    assert front == pytest.approx(pins[:-1] + front_play, abs=ROUNDING)
    way = wanted[1:] + rear_play - front
    assert rear == pytest.approx(front + way * DRAGON.chords / np.abs(way), abs=ROUNDING)
    strays = np.abs([front - places[:-1], rear - places[1:]])
    assert made.furthest == pytest.approx(strays.max(), abs=ROUNDING)


def test_people_stand_alike_as_their_correlations_say():
    rng = np.random.default_rng(4)
    made, stood = wobbler(0.0), []
    memory = np.array([0.0, MEMORY, MEMORY])
    for _ in range(4_000):
        state = np.zeros((21, 2))
        for t in range(3):
            made.dance(memory[t : t + 1], rng.standard_normal((1, 21, 2)), NO_PLAY, PLACES, TANGENTS, NOT_SAFE, state)
            stood.append(state.copy())
    samples = np.reshape(stood, (-1, 3, 21, 2))  # samples, instants, people, directions
    spread = 5.0 / np.sqrt(len(samples))  # five standard deviations of a correlation near 0, more of one near 1
    for instants, people in [(0, 0), (0, 1), (0, 3), (1, 0), (2, 0), (1, 1), (2, 2)]:
        alike = (samples[:, 0, 5] * samples[:, instants, 5 + people]).mean(axis=0)
        assert alike == pytest.approx(ALONG**people * MEMORY**instants, abs=2.0 * spread)
    assert abs((samples[:, 0, 5, 0] * samples[:, 0, 5, 1]).mean()) < spread


def test_a_safe_stray_is_what_a_bench_and_its_nearest_have_between_them():
    safe, gain = np.empty((20, 20)), gains(DRAGON)
    wobbler(0.05).measure(MOST, gain, PLACES, safe)
    a, b = np.triu_indices(DRAGON.benches, 2)
    sizes = np.stack([DRAGON.lengths, DRAGON.widths], axis=1)
    for t in (0, 19):
        poses = bench_poses(PLACES[t])
        between = separation(poses[a], sizes[a], poses[b], sizes[b]).separation / (gain[a] + gain[b])
        least = [min(MOST, between[(a == k) | (b == k)].min()) for k in range(DRAGON.benches)]
        assert safe[t] == pytest.approx(np.array(least), abs=2e-9)


def test_the_first_overlap_is_found_and_safe_strays_change_nothing():
    rng = np.random.default_rng(5)
    made, safe, clear = wobbler(0.06), np.empty((20, 20)), []
    made.measure(MOST, gains(DRAGON), PLACES, safe)

    def danced(rows, numbers, strays, state):
        memory = np.full(rows.stop - rows.start, MEMORY)
        parts = [part[rows] for part in (PLACES, TANGENTS, strays)]
        return made.dance(memory, numbers[rows], NO_PLAY, *parts, state), (made.first, made.second)

    for _ in range(40):
        numbers = rng.standard_normal((20, 21, 2))
        instants, pair = danced(slice(0, 20), numbers, safe, np.zeros((21, 2)))
        again = danced(slice(0, 20), numbers, NOT_SAFE, np.zeros((21, 2)))
        assert again[0] == instants
        assert again[1] == pair or instants == 20
        # Up to the instant before, and one further.
        state, before = np.zeros((21, 2)), min(instants, 19)
        for rows in (slice(0, before), slice(before, before + 1)):
            danced(rows, numbers, safe, state)
            if rows.stop:
                result = overlapping(made.chain)
                assert (pair in result) if rows.stop == instants + 1 else not result
        clear.append(instants)
    assert 5 < clear.count(20) < 35


def overlapping(chain):
    """The pairs that overlap as the benches are laid out, from overlaps()."""
    front, rear = holes(chain)
    centre, along = 0.5 * (front + rear), front - rear
    poses = np.stack([centre.real, centre.imag, np.angle(along)], axis=-1)
    return {tuple(pair) for pair in overlaps(poses, DRAGON.lengths, DRAGON.widths).pairs.tolist()}
