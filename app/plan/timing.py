"""Times of a plan: when head and tail pass each mark, and the place of each bench at three moments."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from app.maps.marks import Marks
from app.wire.clocks import minutes_and_seconds, time_of_day
from core import Budget, Dance
from core.motion.places import Passing, handle_places
from core.people.beats import Music
from core.values import Floats


@dataclass(frozen=True, slots=True)
class TimeFormat:
    """Format of times: minutes and seconds of the dance, or the time of day if it is known at time 0; with music, bar
    and beat before them.

    delay: time of the performance at time 0 of the dance, whose minutes and seconds it then is [s]; the time of day is
        known at time 0 of the performance
    music_begin: time at which the music begins [s]
    """

    start_clock: str | None = None
    music: Music | None = None
    delay: float = 0.0
    music_begin: float = 0.0

    def words(self, time: float | None) -> str:
        """A time [s]; a dash for None.

        >>> TimeFormat().words(72.46), TimeFormat().words(-4.19), TimeFormat().words(None)
        ('1:12.5', '-0:04.2', '–')
        >>> from core.people.beats import Bars
        >>> TimeFormat(music=Music([Bars(16, 96.0, 0.6)])).words(10.0)
        '5.1 0:10.0'
        """
        if time is None:
            return "–"
        return f"{self.count(time)} {self.clock(time)}".lstrip()

    def count(self, time: float) -> str:
        """Bar and beat nearest to a time [s]; empty outside the music."""
        count = self.music and self.music.count(time - self.music_begin)
        return str(count) if count else ""

    def clock(self, time: float) -> str:
        """A time [s] without bar and beat."""
        return self.of_day(time) or minutes_and_seconds(time + self.delay)

    def of_day(self, time: float) -> str | None:
        """The time of day at a time [s]; None if it is not known."""
        return None if self.start_clock is None else time_of_day(time + self.delay, self.start_clock)


@dataclass(frozen=True, slots=True)
class Timing:
    """marks: along the path; head, tail: times at which handle 0 and the last one pass each mark [s], None: never

    moments: three instants (3,) [s]; handles: places of all handles then (3, n + 1), from the first mark [m]
    passes: times at which the front handle of each bench passes the place of the head at the start [s]
    tail_leaves: time at which the tail passes that place [s], None: not before the end
    gates: name of each pass of a gate, its place from the first mark [m], and times of head and tail there [s]
    """

    marks: Marks
    head: list[float | None]
    tail: list[float | None]
    moments: list[float]
    handles: Floats
    passes: list[float | None]
    tail_leaves: float | None
    gates: list[tuple[str, float, float | None, float | None]]

    @property
    def start_place(self) -> float:
        """Place of the head at the start, along the path from the first mark [m]."""
        return float(self.handles[0, 0])


def timing_of(
    dance: Dance, marks: Marks, start: float, stop: float, gates: Sequence[tuple[str, float]], budget: Budget
) -> Timing:
    """The timing of a dance between two instants [s]. gates: name and s [m] of each pass. raises: TooMuchWork"""
    passing, last = Passing(dance, start, stop, budget=budget), dance.dragon.benches
    moments = [start, 0.5 * (start + stop), stop]
    handles = handle_places(dance, moments, budget=budget)
    begin = float(handles[0, 0])
    passes = [passing.when(k, begin) for k in range(last + 1)]
    head = [passing.when(0, s) for s in marks.s.tolist()]
    tail = [passing.when(last, s) for s in marks.s.tolist()]
    passed = [(name, s - marks.first, passing.when(0, s), passing.when(last, s)) for name, s in gates]
    return Timing(marks, head, tail, moments, handles - marks.first, passes[:-1], passes[-1], passed)


def points_of(dance: Dance, marks: Marks) -> list[tuple[float, ...]]:
    """Coordinates x, y of each mark [m], and on a spiral also its distance from the centre [m] and its angle from 0 to
    360 [degrees], counter-clockwise from the x axis."""
    spiral = dance.path.spiral
    if spiral is None:
        return [(x, y) for x, y in marks.points.tolist()]
    away = marks.points - np.array(spiral.centre)
    polar = np.stack([np.hypot(*away.T), np.degrees(np.arctan2(away[:, 1], away[:, 0]))], axis=1)
    polar[:, 1] = np.round(polar[:, 1], 2) % 360.0  # so that no angle is printed as 360.00
    return [tuple(row) for row in np.concatenate([marks.points, polar], axis=1).tolist()]
