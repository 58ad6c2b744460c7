"""Bounds on the motion of benches that reach over corners and pass them."""

import numpy as np

from core import Dance, Dragon, Legs, bench_outlines, kernels, trajectory
from core.kernels.constants import CHORD, CORNER_PULL, HALF_LENGTH, HALF_WIDTH, HANDLE_SPEED, RADIUS

PATH = Legs([(0.0, 0.0), (12.0, 0.0), (14.0, 3.0), (14.5, 3.0), (15.0, 5.0), (25.0, 4.0)], range(5), radius=0.0)
DRAGON = Dragon(3, 2.0, 1.6, 0.3, 0.2)
ROUNDING = 1e-12  # [m]


def bounded(s, h):
    """Bounds while the head goes h from s; None if that is too wide."""
    sizes = np.zeros((4, kernels.SIZE_COLUMNS))
    sizes[:3, CHORD], sizes[:3, HALF_LENGTH], sizes[:3, HALF_WIDTH] = DRAGON.chords, 0.5 * DRAGON.lengths, 0.15
    sizes[:3, RADIUS] = np.hypot(sizes[:3, HALF_LENGTH], sizes[:3, HALF_WIDTH])
    motion = np.zeros((4, kernels.MOTION_COLUMNS))
    before, after = np.zeros((2, 4, kernels.CHAIN_COLUMNS))
    scene = kernels.Scene(PATH.curve, 0.0, kernels.Rings(), sizes, 3, 0)
    return motion[:3] if kernels.Interval(scene, before, after, motion).lay_out(-s, h, 3) else None


def test_points_of_benches_stay_within_the_bound_of_their_second_derivative_and_speed_across_corners():
    rng = np.random.default_rng(69)
    known = 0
    for s, h in zip(rng.uniform(7.0, 24.0, 300), 10.0 ** rng.uniform(-4.0, -0.8, 300), strict=True):
        motion = bounded(s, h)
        if motion is None:
            continue
        known += 1
        x = np.linspace(0.0, h, 41)
        moved = trajectory(Dance(DRAGON, PATH), s + x)
        points = bench_outlines(DRAGON, moved.position)
        chords = points[0] + (points[-1] - points[0]) * (x / h)[:, None, None, None]
        sag = 0.5 * motion[:, CORNER_PULL] * (x * (h - x))[:, None]
        assert (np.linalg.norm(points - chords, axis=-1).max(axis=-1) <= sag + ROUNDING).all()
        assert (moved.speed[:, :-1].max(axis=0) <= motion[:, HANDLE_SPEED] + ROUNDING).all()
    assert known > 200
