"""What a pose that shows a contact must be, and overlaps of benches by shapely."""

import numpy as np
import shapely

from core import bench_outlines, trajectory
from tests.support.near import assert_near

CHORD_ERROR = 1e-12  # [m]


def overlap(outlines, others):
    """Areas (N,) that rectangles (N, 4, 2) share with others [m^2]."""
    return shapely.area(shapely.intersection(shapely.polygons(outlines), shapely.polygons(others)))


def assert_contact_shown(dance, pose):
    """The pose keeps every chord, no hole is further from its place than it says, and its two benches overlap."""
    assert_near(np.hypot(*np.diff(pose.handles, axis=0).T), dance.dragon.chords, CHORD_ERROR)
    assert np.hypot(*(pose.handles - trajectory(dance, pose.time).position).T).max() == pose.stray
    first, second = bench_outlines(dance.dragon, pose.handles)[list(pose.benches)]
    assert overlap(first, second) > 0.0
