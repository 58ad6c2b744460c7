"""Wobbling dragons as they are laid out: joints and chords, how alike people stand, and what safe strays promise."""

import numpy as np

from core import Dance, Dragon, Spiral, bench_poses, overlaps, separation, trajectory
from core.kernels import Budget, Wobbler
from core.kernels.constants import BOX_COLUMNS, CHORD, HALF_LENGTH, MX, MY, UX, UY
from core.shapes.reach import gains
from tests.support.intervals import sizes_of
from tests.support.near import assert_near

DRAGON = Dragon.of([3.4, 2.2, 2.0, 2.2, 2.4] * 4, [0.3] * 20, [0.275] * 20)
NOMINAL = trajectory(Dance(DRAGON, Spiral()), np.arange(280.0, 300.0))
PLACES = NOMINAL.position
TANGENTS = NOMINAL.velocity / NOMINAL.speed[..., None]
SIZES = sizes_of(DRAGON)
NO_PLAY = np.zeros((20, 4))
NOT_SAFE = np.zeros((20, 20))
ALONG = 0.7
MEMORY = 0.9
MOST = 0.4


def wobbler(size, sizes):
    rows = len(sizes)
    chain = np.zeros((rows, UY + 1))
    boxes = np.zeros((rows, BOX_COLUMNS))
    flags = np.zeros((2, rows), dtype=np.int8)
    made = Wobbler(sizes, Budget(1e9), chain, boxes, *flags)
    made.lateral = size
    made.forward = 0.5 * size
    made.along = ALONG
    return made


def test_a_safe_stray_is_what_a_bench_and_its_nearest_have_between_them():
    safe = np.empty((20, 20))
    gain = gains(DRAGON)
    wobbler(0.05, SIZES).measure(MOST, gain, PLACES, safe)
    a, b = np.triu_indices(DRAGON.benches, 2)
    sizes = np.stack([DRAGON.lengths, DRAGON.widths], axis=1)
    for t in (0, 19):
        poses = bench_poses(PLACES[t])
        between = separation(poses[a], sizes[a], poses[b], sizes[b]).separation / (gain[a] + gain[b])
        least = [min(MOST, between[(a == k) | (b == k)].min()) for k in range(DRAGON.benches)]
        assert_near(safe[t], least, 2e-9)
        known = np.array(least) < MOST
        assert (safe[t] < least)[known].all()


def test_the_first_overlap_is_found_and_safe_strays_change_nothing():
    rng, made, safe, ends = np.random.default_rng(5), wobbler(0.06, SIZES), np.empty((20, 20)), []
    made.measure(MOST, gains(DRAGON), PLACES, safe)
    for _ in range(40):
        numbers = rng.standard_normal((20, 21, 2))
        results = []
        for strays in (safe, NOT_SAFE):
            state = np.zeros((21, 2))
            ends.append(made.dance(np.full(20, MEMORY), numbers, NO_PLAY, PLACES, TANGENTS, strays, state))
            results.append((ends[-1], ends[-1] < 20 and [made.first, made.second]))
        assert results[0] == results[1]
        x, y, ux, uy = np.asarray(made.chain)[:-1, [MX, MY, UX, UY]].T
        pairs = overlaps(np.stack([x, y, np.arctan2(uy, ux)], axis=-1), DRAGON.lengths, DRAGON.widths).pairs.tolist()
        assert results[0][1] in pairs if ends[-1] < 20 else pairs == []
    assert 10 < ends.count(20) < 70


def test_a_bench_of_a_block_within_the_most_strays_of_both_counts_for_a_safe_stray():
    """Eight benches out, eight around, eight back: 1.9 m lie between the first and the last, a stray of 0.95 m each."""
    way = 4.0 * np.arange(9.0)
    turned = np.linspace(0.0, np.pi, 9)[1:-1]
    dragon = Dragon(24, 1.0, 1.0, 0.3, 0.0)
    around = 32.0 + 9.0 * np.sin(turned) + 1.1j * (1.0 - np.cos(turned))
    along = np.concatenate([way, around, way[::-1] + 2.2j])
    safe = np.empty((1, 24))
    places = np.stack([along.real, along.imag], axis=-1)[None]
    wobbler(0.0, sizes_of(dragon)).measure(1.0, np.ones(24), places, safe)
    assert_near(safe[0, [*range(6), *range(-6, 0)]], 0.95, 2e-9)


def test_benches_that_overlap_in_their_places_touch_although_nobody_strays():
    """Their safe stray is 0, and so are the strays: opposite sides are 0.25 m apart and 0.3 m wide."""
    sizes = sizes_of(Dragon(4, 1.0, 1.0, 0.3, 0.0))
    chords = np.array([1.0, 0.25, 1.0, 0.25])
    sizes[:4, CHORD], sizes[:4, HALF_LENGTH] = chords, 0.5 * chords
    places = np.array([[[0.0, 0.0], [1.0, 0.0], [1.0, 0.25], [0.0, 0.25], [0.0, 0.0]]])
    made = wobbler(0.0, sizes)
    safe = np.ones((1, 4))
    state = np.zeros((5, 2))
    made.measure(MOST, np.ones(4), places, safe)
    assert safe[0, 0] == 0.0
    assert safe[0, 2] == 0.0
    assert made.dance(np.zeros(1), np.zeros((1, 5, 2)), NO_PLAY[:4], places, np.zeros((1, 5, 2)), safe, state) == 0
    assert (made.first, made.second, made.furthest) == (0, 2, 0.0)
