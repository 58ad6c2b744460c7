"""Where every handle and bench is, and how fast."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from core import kernels
from core.dance import Dance
from core.errors import InvalidValue
from core.paths.route import Route
from core.values import Floats, checked_type


@dataclass(frozen=True, slots=True)
class Trajectory:
    """time (...) [s]; position (..., n + 1, 2) [m]; velocity (..., n + 1, 2) [m/s]; speed (..., n + 1) [m/s].

    ... is (T,) for a list of times and nothing for one time.
    """

    time: Floats
    position: Floats
    velocity: Floats
    speed: Floats


def trajectory(dance: Dance, times: Floats | Sequence[float] | float) -> Trajectory:
    """Position and velocity of every handle at every time.

    times: (T,) or one [s], 0 at the start; at negative times the head is on the outward extension of the spiral, or on
        the part of a route before its s = 0
    returns: see Trajectory; positions good to 1e-12 m, speeds from the rigid links, never from differences
    raises: OutsideRun (times) after the end of the run, or where the tail would stand before the beginning of a route
    source: Yang et al., section 2.3, whose eqs. 6-7 divide a sum of speeds by 2 dt where a distance is meant

    >>> trajectory(Dance(Dragon(), Spiral()), [0.0]).position[0, 1].round(6)
    array([8.363824, 2.826544])
    >>> trajectory(Dance(Dragon(), Spiral()), 0.0).position.shape
    (224, 2)
    """
    checked_type("dance", dance, Dance)
    dragon, path, head_speed = dance.dragon, dance.path, dance.head_speed
    asked = dance.times(times)
    time = asked.reshape(-1)
    shape = (time.size, dragon.benches + 1)
    columns = position, velocity, speed = np.empty((*shape, 2)), np.empty((*shape, 2)), np.empty(shape)
    if isinstance(path, Route):
        sizes = np.zeros((dragon.benches, kernels.SIZE_COLUMNS))
        sizes[:, 0] = dragon.chords
        chain = np.empty((dragon.benches + 1, kernels.CHAIN_COLUMNS))
        kernels.route_trajectory(path.table, time * head_speed, head_speed, sizes, chain, position, velocity, speed)
        return Trajectory(asked, *(column.reshape(*asked.shape, *column.shape[1:]) for column in columns))
    head = np.maximum(path.theta(time * head_speed), dance.end.theta or 0.0)
    folded = kernels.spiral_trajectory(path.growth, head, dragon.chords, head_speed, position, velocity, speed)
    if folded >= 0:
        raise dance.after_the_end(asked, folded)
    return Trajectory(asked, *(column.reshape(*asked.shape, *column.shape[1:]) for column in columns))


def bench_poses(handles: Floats) -> Floats:
    """Pose of every bench from the handles at its two ends.

    handles: (..., n + 1, 2) [m], head first, world frame
    returns: (..., n, 3) x [m], y [m], heading [rad] in [-pi, pi], from rear to front handle
    source:  Yang et al., section 2.4.1, steps 1-2
    raises:  InvalidValue (handles)

    >>> bench_poses(np.array([[2.0, 0.0], [0.0, 0.0]]))
    array([[1., 0., 0.]])
    """
    handles = _checked_handles(handles)
    front, rear = handles[..., :-1, :], handles[..., 1:, :]
    middle = 0.5 * (front + rear)
    along = front - rear
    heading = np.arctan2(along[..., 1], along[..., 0])
    return np.concatenate([middle, heading[..., None]], axis=-1)


def _checked_handles(handles: object) -> Floats:
    try:
        places = np.asarray(handles)
    except ValueError as error:
        raise InvalidValue("handles", "handles must be places of shape (..., n + 1, 2) in metres") from error
    if places.dtype.kind not in "iuf" or places.ndim < 2 or places.shape[-1] != 2:
        words = "handles must be places of shape (..., n + 1, 2) in metres"
        raise InvalidValue("handles", f"{words}, got {places.dtype.name} of shape {places.shape}")
    return places.astype(np.float64, copy=False)
