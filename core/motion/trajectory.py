"""Position and velocity of every handle."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from core import plots
from core.dance import Clock, Dance, checked_instants
from core.display import display, format_range
from core.error_free import paired, two_product, two_sum
from core.kernels import Budget
from core.language import say
from core.paths.frame import WORLD
from core.performance import Part, Performance
from core.questions import or_about, question_about
from core.shapes.rectangles import bench_outlines
from core.tables import Column, Table
from core.values import Floats

if TYPE_CHECKING:
    import xarray
    from matplotlib.axes import Axes

# Work between two checks of a budget [1], see core/kernels/constants.py, in batches divided for them: 2 to 10 ms.
BATCH_WORK = 100_000

# Names along the last axis of positions and velocities.
AXES = ("x", "y")


@dataclass(frozen=True, slots=True, repr=False, eq=False)
class Trajectory(Table):
    """Columns of n + 1 handles at T instants, or at one, where (T,) is empty.

    time: instants, (T,) [s]
    position: places of the handles, (T, n + 1, 2) [m]
    velocity: their velocities, (T, n + 1, 2) [m/s]
    speed: their speeds, (T, n + 1) [m/s]
    dance: the dance itself; without it plot() has no benches

    >>> from core import Dragon, Spiral
    >>> trajectory(Dance(Dragon(), Spiral()), [0.0, 300.0])
    <Trajectory: 2 instants from 0 to 300 s; 224 handles, 0.99647754 to 1 m/s>
    """

    time: Floats
    position: Floats
    velocity: Floats
    speed: Floats
    dance: Dance | None = field(default=None, kw_only=True, repr=False, compare=False)

    def _line(self) -> str:
        speeds = f", {format_range(self.speed, 'm/s')}" if self.speed.size else ""
        handles = say("{count} handles", count=self.speed.shape[-1])
        return f"{instants(self.time)}; {handles}{speeds}"

    def _benches(self) -> tuple[Floats | None, tuple[int, ...]]:
        handles = self.position.reshape(-1, *self.position.shape[-2:])[-1:]
        return bench_outlines(self.dance.dragon, handles[0]) if self.dance and len(handles) else None, ()

    def columns(self) -> dict[str, Column]:
        """One row for each time and handle: time [s], handle, x, y [m], velocity_x, velocity_y, speed [m/s]."""
        handles = self.speed.shape[-1]
        return {
            "time": np.repeat(self.time, handles),
            "handle": np.tile(np.arange(handles), self.time.size),
            **{name: self.position[..., k].ravel() for k, name in enumerate(AXES)},
            **{f"velocity_{name}": self.velocity[..., k].ravel() for k, name in enumerate(AXES)},
            "speed": self.speed.ravel(),
        }

    def to_xarray(self) -> xarray.Dataset:
        """position [m], velocity [m/s] (time, handle, axis) and speed (time, handle) [m/s]; without the axis `time`
        for a single time.

        raises: ImportError without xarray, naming the extra
        """
        instant = ("time",) * self.time.ndim
        names = (*instant, "handle")
        variables = {"position": ((*names, "axis"), self.position), "velocity": ((*names, "axis"), self.velocity)}
        coordinates = {"time": (instant, self.time), "handle": np.arange(self.speed.shape[-1]), "axis": list(AXES)}
        variables |= {"speed": (names, self.speed)}
        return self._data_set(variables, coordinates)

    def plot(self, ax: Axes | None = None, *, instant: int = -1) -> Axes:
        """Plot the dance at one instant, every handle coloured by its speed.

        instant: index into the times; the last one by default
        returns: the given axes, or those of a new figure, in metres
        raises: ImportError without matplotlib, naming the extra; IndexError if there is no such instant
        """
        if not self.time.size:
            raise IndexError("there is no instant to plot: the trajectory was asked for at no time")
        axes = plots.wanted_axes(ax, "Trajectory.plot()")
        time = self.time.reshape(-1)[instant]
        handles, velocity, speed = (
            column.reshape(self.time.size, *column.shape[self.time.ndim :])[instant]
            for column in (self.position, self.velocity, self.speed)
        )
        if self.dance is None:
            plots.plan(axes)
        else:
            plots.draw_dance(axes, self.dance.path, handles, bench_outlines(self.dance.dragon, handles), 0.4)
        plots.draw_speeds(axes, handles, speed)
        centre = (0.0, 0.0) if self.dance is None else self.dance.path.frame.centre
        plots.mark_head(axes, handles[0], self._ahead(float(time), velocity[0]), centre)
        axes.set_title(say("Handles and their speeds at {time:g} s", time=time), fontsize=11)
        return axes

    def _ahead(self, time: float, velocity: Floats) -> Floats:
        """The head's direction of travel (2,); during a pause that of the path."""
        if self.dance is not None and not velocity.any():
            return self.dance.path.tangent(self.dance.clock.travel(time))
        ahead: Floats = velocity / np.hypot(*velocity)
        return ahead


def exact_travels(clock: Clock, times: Floats) -> Floats:
    """Travels of the head at times (T,) in double-double (T, 2) [m]; only those at the ends of passages are rounded."""
    k = np.searchsorted(clock.times, times, side="right") if clock.passages else np.ones(times.size, dtype=np.int64)
    node, speeds = np.maximum(k - 1, 0), np.array(clock.speeds)[k]
    since, lost = two_sum(times, -np.array(clock.times)[node])
    way, more = two_product(since, speeds)
    travel, rest = two_sum(np.array(clock.travels)[node], way)
    return paired(travel, rest + (more + lost * speeds))


@question_about("performance", Performance, "the trajectories were not computed")
def _trajectories(
    performance: Performance, times: ArrayLike, *, budget: Budget | None = None
) -> tuple[Trajectory, ...]:
    return tuple(_trajectory_of(part, times, budget) for part in performance.parts)


def _trajectory_of(part: Part, times: ArrayLike, budget: Budget | None) -> Trajectory:
    time = checked_instants(times)
    own = np.clip(time - part.delay, part.dance.begin, part.dance.end.time)
    placed = trajectory(part.dance, own, budget=budget)
    stands = (time < part.begin) | (time > part.end)
    velocity, speed = placed.velocity.copy(), placed.speed.copy()
    velocity[stands], speed[stands] = 0.0, 0.0
    dances = part.dance if part.delay == 0.0 and not stands.any() else None
    return replace(placed, time=time, velocity=velocity, speed=speed, dance=dances)


@or_about(Performance, _trajectories)
@question_about("dance", (Dance, Performance), "the trajectory was not computed")
def trajectory(dance: Dance, times: ArrayLike, *, budget: Budget | None = None) -> Trajectory:
    """Position and velocity of every handle at every time; of a Performance a Trajectory for each dragon.

    times: (T,) or one [s], 0 at the start; at negative times the head is on the outward extension of the spiral, or on
        the part of a route before its s = 0. In a performance a dragon stands before and after its dance, with velocity
        0; the Trajectory of a part without a delay is that of its dance, to the last bit, while it dances; others have
        no `dance` to plot
    returns: see Trajectory; positions up to 20 m from the centre are good to 1e-11 m, further ones to 1e-12 of that
        distance, on spirals and coils of up to 100,000 turns (off the origin also to the rounding of the coordinates);
        speeds to 1e-11 m/s up to 0.01 s before a fold; these come from the rigid links, not from differences;
        at a time when the head changes its speed, they are those after the change; a handle in a corner of a route has
        the velocity with which it comes there
    raises: OutsideRun (times) after the end of the run, or if the tail would be before the beginning of a route;
        TooMuchWork
    source: Yang et al., section 2.3, whose eqs. 6-7 divide a sum of speeds by 2 dt where a distance is meant

    >>> from core import Dragon, Spiral
    >>> dance = Dance(Dragon(), Spiral())
    >>> trajectory(dance, [0.0]).position[0, 1].round(6)
    array([8.363824, 2.826544])
    >>> trajectory(dance, 0.0).position.shape
    (224, 2)
    """
    dragon, time, budget = dance.dragon, dance.times(times), budget or Budget()
    travels, handles = exact_travels(dance.clock, time.reshape(-1)), dragon.benches + 1
    shape = (len(travels), handles)
    position, velocity, speed = np.empty((*shape, 2)), np.empty((*shape, 2)), np.empty(shape)
    block = dance.path.block
    batch = block * max(1, BATCH_WORK // (block * handles))
    for first in range(0, len(travels), batch):
        s, rows = travels[first : first + batch], slice(first, first + batch)
        budget.afford(float(handles * len(s)))
        columns = position[rows], velocity[rows], speed[rows]
        before_fold = dance.path.handles(s, dance.end.theta or 0.0, dragon.chords, dance.head_speed, columns, budget)
        budget.look()
        if before_fold < len(s):
            raise dance.after_the_end(time, first + before_fold)
    if dance.passages:
        share = dance.clock.speed(time.reshape(-1)) / dance.head_speed
        velocity *= share[:, None, None]
        speed *= share[:, None]
    if (frame := dance.path.frame) != WORLD:
        position, velocity = frame.points(position), frame.vectors(velocity)
    columns = position, velocity, speed
    return Trajectory(time, *(columns if time.ndim else (column[0] for column in columns)), dance=dance)


def instants(time: Floats) -> str:
    """Number and range of instants, in words.

    >>> instants(np.array([0.0, 1.0, 2.0]))
    '3 instants from 0 to 2 s'
    """
    if time.size == 1:
        return say("1 instant at {time}", time=display(time.item(0), "s"))
    if not time.size:
        return say("no instants")
    return say("{count} instants from {span}", count=time.size, span=format_range(time, "s"))
