"""Places of handles along the path, and times at which they pass a place."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from core.dance import Dance
from core.errors import question_about
from core.kernels import Budget
from core.kernels.constants import CHAIN_COLUMNS, CHORD, LAG, SIZE_COLUMNS
from core.values import Floats

# Travel of the head between two rows of a table of places [m], and largest number of rows.
STEP, ROWS_MAX = 0.25, 2_000


@question_about("dance", Dance)
def handle_places(dance: Dance, times: ArrayLike, *, budget: Budget | None = None) -> Floats:
    """Arc length s of every handle along the path.

    times: (T,) [s]; returns (T, n + 1) [m]
    raises: OutsideRun (times); TooMuchWork

    >>> from core import Dragon, Spiral
    >>> handle_places(Dance(Dragon(2), Spiral()), [0.0]).round(3)
    array([[ 0.   , -2.873, -4.525]])
    """
    instants = dance.times(np.asarray(times, dtype=np.float64)).reshape(-1)
    return _behind(dance, np.array([dance.clock.travel(time) for time in instants.tolist()]), budget or Budget())


@question_about("dance", Dance, "the places of the handles were not found")
def _behind(dance: Dance, travels: Floats, budget: Budget) -> Floats:
    """Arc lengths (T, n + 1) of all handles for travels (T,) of the head [m]. raises: TooMuchWork"""
    path, last = dance.path, dance.dragon.benches
    sizes, chain = np.zeros((last + 1, SIZE_COLUMNS)), np.zeros((last + 1, CHAIN_COLUMNS))
    sizes[:last, CHORD] = dance.dragon.chords
    rows = []
    for lag in path.lags(travels, dance.end.theta or 0.0).tolist():
        budget.afford(float(last))
        path.follow(lag, last, sizes, chain)
        rows.append(path.along(chain[:, LAG]))
    return np.array(rows)


class Passing:
    """Times at which handles first pass places on the path, between two instants [s].

    The place of a handle depends only on the head's travel. It is interpolated linearly between the rows of a table,
    STEP apart, with an error below a centimetre.
    raises: TooMuchWork
    """

    def __init__(self, dance: Dance, start: float, stop: float, *, budget: Budget | None = None) -> None:
        self.clock = dance.clock
        first, last = self.clock.travel(start), self.clock.travel(stop)
        self.travels = np.linspace(first, last, min(ROWS_MAX, int((last - first) / STEP) + 2))
        self.start, self.s = start, _behind(dance, self.travels, budget or Budget())

    def when(self, handle: int, s: float) -> float | None:
        """The first time at which a handle is at s [s]; None if it is not there between the two instants."""
        row = self.s[:, handle]
        passed = np.flatnonzero(row >= s)
        if not passed.size or (passed[0] == 0 and row[0] > s):
            return None
        k = int(passed[0])
        if k == 0:
            return self.start
        share = (s - row[k - 1]) / (row[k] - row[k - 1])
        return self.clock.time(float(self.travels[k - 1] + share * (self.travels[k] - self.travels[k - 1])))
